//! Places where plans can touch, as the geometry found them: equal ones of several floors together.

use crate::{format, message};
use jostle::interface::{Contact, PlanContactKind, PlanPart};
use jostle::{Model, PlanPoint, Summary, System};

/// A face or a corner of two buildings, of all floors where it is the same.
#[derive(Clone, Debug, PartialEq)]
pub struct SitePlace {
    /// Index of the gap in the model.
    pub gap_index: usize,
    /// Indices of the buildings; walls are counted on from them.
    pub between: [usize; 2],
    /// Floors of both, from 1, from the lowest up; `None` of a wall.
    pub floors: Vec<[Option<usize>; 2]>,
    /// Face or corner.
    pub kind: PlanContactKind,
    /// What touches, of either building.
    pub parts: [PlanPart; 2],
    /// Unit normal from the first building to the second.
    pub normal: PlanPoint,
    /// Middle of the face, or the corner, on the site \[m\].
    pub middle: PlanPoint,
    /// Length of the face; zero for a corner \[m\].
    pub overlap: f64,
    /// Least and greatest distance of its points at rest \[m\].
    pub gap: [f64; 2],
    /// Greatest force of any floor; zero without a run \[N\].
    pub peak_force: f64,
    /// Greatest slip of any floor during an impact; `None` without friction or a run \[m\].
    pub slip: Option<f64>,
}

/// Places closer than this are the same \[m\].
const SAME: f64 = 1e-6;

impl SitePlace {
    /// All places of a model with plans, in the order in which the geometry found them; none in one plane.
    #[must_use]
    pub fn of_system(model: &Model, system: &System) -> Vec<Self> {
        let mut places = Vec::new();
        let mut contacts = system.contacts.iter().peekable();
        while let Some(first) = contacts.next() {
            let Some(first_plan) = first.plan else {
                continue;
            };
            let same = |next: &&Contact| next.plan.is_some_and(|plan| plan.face == first_plan.face);
            let (mut last, mut gap) = (first_plan.at, [first.width; 2]);
            while let Some(next) = contacts.next_if(same) {
                last = next.plan.map_or(last, |plan| plan.at);
                gap = [gap[0].min(next.width), gap[1].max(next.width)];
            }
            let gaps = model.gaps.get(first.gap).map(|gap| gap.between);
            let Some([Some(a), Some(b)]) = gaps else {
                continue;
            };
            add(
                &mut places,
                Self {
                    gap_index: first.gap,
                    between: [a, b],
                    floors: vec![system.floors_of(&first.ports)],
                    kind: first_plan.kind,
                    parts: first_plan.parts,
                    normal: first_plan.normal,
                    middle: [0, 1].map(|axis| 0.5 * (first_plan.at[axis] + last[axis])),
                    overlap: first_plan.overlap,
                    gap,
                    peak_force: 0.0,
                    slip: None,
                },
            );
        }
        places
    }

    /// Those of a run, with their forces.
    pub(crate) fn of_run(model: &Model, summary: &Summary) -> Vec<Self> {
        let mut places = Vec::new();
        for (index, (gap, model_gap)) in summary.gaps.iter().zip(&model.gaps).enumerate() {
            for contact in &gap.contacts {
                let (Some(plan), [Some(a), Some(b)]) = (contact.in_plan, model_gap.between) else {
                    continue;
                };
                add(
                    &mut places,
                    Self {
                        gap_index: index,
                        between: [a, b],
                        floors: vec![contact.floors],
                        kind: plan.kind,
                        parts: plan.parts,
                        normal: plan.normal,
                        middle: plan.plan_m,
                        overlap: plan.overlap_m,
                        gap: [contact.width_m; 2],
                        peak_force: contact.peak_force_n,
                        slip: plan.sliding.map(|sliding| sliding.slip_peak_m),
                    },
                );
            }
        }
        places
    }

    fn is_like(&self, other: &Self) -> bool {
        let near = |a: PlanPoint, b: PlanPoint| (a[0] - b[0]).hypot(a[1] - b[1]) <= SAME;
        self.gap_index == other.gap_index
            && self.kind == other.kind
            && self.parts == other.parts
            && near(self.middle, other.middle)
            && near(self.normal, other.normal)
            && (self.overlap - other.overlap).abs() <= SAME
    }

    /// Floors in words: `1 to 3`, or pairs where they differ.
    #[must_use]
    pub fn floors_in_words(&self) -> String {
        let floor = |pair: &[Option<usize>; 2]| pair[0].or(pair[1]).unwrap_or(0);
        let same = self.floors.iter().all(|pair| match pair {
            [Some(a), Some(b)] => a == b,
            // Of a wall every height is the same.
            _ => true,
        });
        let steps = self.floors.windows(2);
        let follow = steps.map(|pair| floor(&pair[1]).checked_sub(floor(&pair[0])));
        let follow = follow.into_iter().all(|step| step == Some(1));
        match &self.floors[..] {
            [only] if same => floor(only).to_string(),
            [first, .., last] if same && follow => message::low_to_high(floor(first), floor(last)),
            pairs if same => {
                let words = pairs.iter().map(|pair| floor(pair).to_string());
                words.collect::<Vec<_>>().join(", ")
            }
            pairs => {
                let word = |number: Option<usize>| {
                    number.map_or("–".to_owned(), |number| number.to_string())
                };
                let words = pairs
                    .iter()
                    .map(|[a, b]| format!("{} | {}", word(*a), word(*b)));
                words.collect::<Vec<_>>().join(", ")
            }
        }
    }

    /// One width, or a range where the edges are not parallel.
    #[must_use]
    pub fn gap_in_words(&self) -> String {
        let [least, most] = self.gap;
        if most - least < 5e-5 {
            format::LENGTH.text(least, 1)
        } else {
            message::to_mm(
                format::LENGTH.number(least, 1),
                format::LENGTH.number(most, 1),
            )
        }
    }

    /// What touches of either building, with corners counted from 1; `face` of a wall.
    #[must_use]
    pub fn parts_in_words(&self, model: &Model) -> [String; 2] {
        let floors = self.floors.first().copied().unwrap_or_default();
        [0, 1].map(|side| part_of(model, self.between[side], floors[side], self.parts[side]))
    }
}

/// A part of a building or a wall in words. Floors count from 1; 0 is a mat.
pub(crate) fn part_of(model: &Model, side: usize, floor: Option<usize>, part: PlanPart) -> String {
    let Some(building) = model.buildings.get(side) else {
        return match part {
            // The plan of a wall begins behind it; its face is its third edge.
            PlanPart::Edge(2) => message::face().into(),
            PlanPart::Edge(_) => message::side().into(),
            PlanPart::Corner(_) | PlanPart::Column(_) => message::end().into(),
        };
    };
    let plan = match (&building.structure, floor) {
        (jostle::Structure::Tiers(tiers), Some(floor)) => {
            // A mat, floor 0, has the plan of the lowest floor.
            tiers.floors.get(floor.saturating_sub(1))
        }
        _ => None,
    };
    let frames = match &building.structure {
        jostle::Structure::Tiers(tiers) => &tiers.frames[..],
        _ => &[],
    };
    let frames: Vec<String> = frames.iter().map(|frame| frame.name.clone()).collect();
    part_in_words(part, plan.map_or(0, |floor| floor.plan.len()), &frames)
}

/// `corner 3`, or `edge 2–3`; corners count from 1. `frames`: names of those at lines.
fn part_in_words(part: PlanPart, corners: usize, frames: &[String]) -> String {
    match part {
        PlanPart::Corner(index) => message::corner_index(index + 1),
        PlanPart::Edge(index) => {
            let next = if index + 1 == corners { 0 } else { index + 1 };
            message::edge_index_next(index + 1, next + 1)
        }
        PlanPart::Column(line) => message::column_at_line(line.name(frames)),
    }
}

fn add(places: &mut Vec<SitePlace>, place: SitePlace) {
    match places.iter_mut().find(|known| known.is_like(&place)) {
        Some(known) => {
            known.gap = [
                known.gap[0].min(place.gap[0]),
                known.gap[1].max(place.gap[1]),
            ];
            known.peak_force = known.peak_force.max(place.peak_force);
            known.slip = match (known.slip, place.slip) {
                (Some(slip), Some(other)) => Some(slip.max(other)),
                (slip, other) => slip.or(other),
            };
            known.floors.extend(place.floors);
        }
        None => places.push(place),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn parts_and_floors_have_names() {
        assert_eq!(part_in_words(PlanPart::Edge(1), 4, &[]), "edge 2–3");
        assert_eq!(part_in_words(PlanPart::Edge(3), 4, &[]), "edge 4–1");
        assert_eq!(part_in_words(PlanPart::Corner(0), 4, &[]), "corner 1");
        let place = |floors: &[[Option<usize>; 2]]| SitePlace {
            gap_index: 0,
            between: [0, 1],
            floors: floors.to_vec(),
            kind: PlanContactKind::Face,
            parts: [PlanPart::Edge(0); 2],
            normal: [1.0, 0.0],
            middle: [0.0; 2],
            overlap: 1.0,
            gap: [0.02; 2],
            peak_force: 0.0,
            slip: None,
        };
        let words = |floors: &[[usize; 2]]| {
            let pairs: Vec<_> = floors.iter().map(|pair| pair.map(Some)).collect();
            place(&pairs).floors_in_words()
        };
        assert_eq!(words(&[[1, 1], [2, 2], [3, 3]]), "1 to 3");
        assert_eq!(words(&[[2, 2]]), "2");
        assert_eq!(words(&[[2, 1], [4, 2]]), "2 | 1, 4 | 2");
        assert_eq!(words(&[[1, 1], [3, 3]]), "1, 3");
        let wall = place(&[[None, Some(1)], [None, Some(2)]]);
        assert_eq!(wall.floors_in_words(), "1 to 2");
    }
}
