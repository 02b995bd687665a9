//! The faces of a gap between two buildings with plans.

use super::contact_points::point_pairs;
use super::plan_contacts::{PlanFace, plan_faces};
use crate::linear::sort_by_key;
use crate::model::{Gap, Model, PlanPoint, Structure};

/// Plans on one side of a gap, from the ground up, with the heights of the floors above the common datum; that of a wall stands for every height.
struct Side {
    /// Number of the first plan: 0 for a mat and for a wall, 1 for a floor.
    first: usize,
    plans: Vec<Vec<PlanPoint>>,
    heights: Vec<f64>,
}

impl Side {
    fn new(model: &Model, side: Option<usize>) -> Option<Self> {
        if let Some(wall) = model.wall(side) {
            return Some(Self {
                first: 0,
                plans: vec![wall.plan()?],
                heights: Vec::new(),
            });
        }
        let building = model.buildings.get(side?)?;
        match &building.structure {
            Structure::Tiers(tiers) => {
                let floors = tiers.floors.iter().map(|floor| floor.plan.clone());
                // The mat has the plan of the lowest floor.
                let isolated = building.base.isolation.is_some();
                let lowest = tiers.floors.first().map(|floor| floor.plan.clone());
                let mat = isolated.then_some(lowest).flatten();
                let heights = mat.as_ref().map(|_| building.base.elevation).into_iter();
                Some(Self {
                    first: usize::from(mat.is_none()),
                    heights: heights.chain(building.floor_levels()).collect(),
                    plans: mat.into_iter().chain(floors).collect(),
                })
            }
            _ => None,
        }
    }

    /// Index of the floor at a height; 0 for a wall, which has none.
    fn floor(&self, height: Option<f64>) -> Option<usize> {
        match height {
            Some(_) => self
                .heights
                .iter()
                .position(|candidate| Some(*candidate) == height),
            None => self.heights.is_empty().then_some(0),
        }
    }
}

/// Faces of a gap with the numbers of their floors, from the lowest up, 0 for a mat and for a wall; `None` where its buildings or
/// floors do not fit.
pub(crate) fn faces_of_gap(model: &Model, gap: &Gap) -> Option<Vec<([usize; 2], PlanFace)>> {
    let [a, b] = gap.between;
    let sides = [Side::new(model, a)?, Side::new(model, b)?];
    let neighbours = model.neighbours(gap.between);
    let pairs = point_pairs(&gap.floors, neighbours, gap.level_tolerance).ok()?;
    let mut found = Vec::new();
    for pair in pairs {
        let [Some(i), Some(j)] = [0, 1].map(|side: usize| sides[side].floor(pair[side])) else {
            continue;
        };
        let plans = (sides[0].plans.get(i)?, sides[1].plans.get(j)?);
        let faces = plan_faces(plans.0, plans.1, &gap.in_plan);
        let numbers = [sides[0].first + i, sides[1].first + j];
        found.extend(faces.into_iter().map(|face| (numbers, face)));
    }
    sort_by_key(&mut found, |(floors, _)| *floors);
    Some(found)
}

/// Least distance of the plans at the contact points of a gap \[m\]; `None` if it has none.
#[must_use]
pub fn narrowest_gap(model: &Model, gap: usize) -> Option<f64> {
    narrowest(&faces_of_gap(model, model.gaps.get(gap)?)?)
}

/// Least distance of faces and corners \[m\]. Of two corners that pass each other one may already be behind the other; then
/// the distance along the other normal counts.
pub(crate) fn narrowest(faces: &[([usize; 2], PlanFace)]) -> Option<f64> {
    let of_face = |face: &PlanFace| {
        let is_behind = face.ends.iter().any(|end| end.is_indentation);
        let points = face.points.iter().map(|point| point.gap);
        points
            .filter(|gap| !is_behind || *gap >= 0.0)
            .min_by(f64::total_cmp)
    };
    let gaps = faces.iter().filter_map(|(_, face)| of_face(face));
    gaps.min_by(f64::total_cmp)
}
