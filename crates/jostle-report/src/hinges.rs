//! Cracking and yielding: places, selected loops, the table in order of yielding.

use jostle::hysteresis::{Backbone, Hysteresis, HysteresisRule, Side};
use jostle::linear::sort_by;
use jostle::model::{Building, Structure};
use jostle::results::summary::{BuildingSummary, SpringSummary};
use jostle::structure::{BaseMotion, Discretization, MemberEnd, MemberPlace, SpringPlace};
use maud::{Markup, html};

use crate::damage::{Damage, damage};
use crate::format::Shown;
use crate::message;
use crate::{Page, format};

/// Loops shown.
const LOOPS: usize = 6;
/// Rows of the table before the reader asks for all, and at most.
const FIRST_ROWS: usize = 20;
const MOST_ROWS: usize = 400;

/// A spring that can yield, in the order of its building's springs.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Place {
    /// Index of the building.
    pub(crate) building: usize,
    /// Index among the springs of all buildings.
    pub(crate) spring: usize,
    /// Index among the springs of its building.
    pub(crate) index: usize,
    /// Where it is.
    pub(crate) at: SpringPlace,
    /// Its rule.
    pub(crate) hysteresis: Hysteresis,
}

impl Place {
    /// Whether it is a brace that buckles, which does not crack.
    pub(crate) fn buckles(&self) -> bool {
        matches!(self.hysteresis.rule(), HysteresisRule::Buckling(_))
    }
}

/// Every hinge of the buildings, from the left building on; springs of bearings, shear of columns and fibres are shown elsewhere.
pub(crate) fn places(page: &Page) -> Vec<Place> {
    let buildings = page.system.buildings.iter().enumerate();
    let places = buildings.flat_map(|(building, system)| {
        let springs = system.equations.springs.iter();
        let springs = springs
            .zip(&system.discretization.spring_places)
            .enumerate();
        let hinges = springs.filter(|(_, (_, at))| at.is_hinge());
        hinges.map(move |(index, (spring, at))| Place {
            building,
            spring: system.spring_offset + index,
            index,
            at: *at,
            hysteresis: spring.hysteresis,
        })
    });
    places.collect()
}

/// Whether a place moves sideways, in m and N, and does not turn.
pub(crate) fn slides(at: SpringPlace) -> bool {
    matches!(
        at,
        SpringPlace::Storey { .. }
            | SpringPlace::Shear { .. }
            | SpringPlace::PlanStorey { .. }
            | SpringPlace::Element { .. }
            | SpringPlace::Diagonal { .. }
            | SpringPlace::Sliding { .. }
            | SpringPlace::Footing { .. }
            | SpringPlace::Base {
                motion: BaseMotion::Sliding,
                ..
            }
    )
}

/// How far up its storey a column is struck, in thousandths.
fn thousandths(page: &Page, place: &Place) -> usize {
    let Discretization {
        stick_model,
        floors,
        ..
    } = &page.system.buildings[place.building].discretization;
    let level = |node: usize| stick_model.nodes[node].y;
    let mut hinges = stick_model.hinges.iter();
    let hinges = hinges.by_ref().filter(|hinge| hinge.hysteresis.is_some());
    let Some(height) = hinges.map(|hinge| level(hinge.ends[0])).nth(place.index) else {
        return 0;
    };
    let above = floors.iter().position(|floor| level(*floor) > height);
    let ends = above.map(|floor| {
        [
            floor
                .checked_sub(1)
                .map_or(0.0, |below| level(floors[below])),
            level(floors[floor]),
        ]
    });
    ends.map_or(0, |[low, high]| {
        (1e3 * (height - low) / (high - low)).round() as usize
    })
}

/// Kind, level, line and end of a place, for the scripts; the end of a struck point is how far up its storey it is, in thousandths.
pub(crate) fn coordinates(page: &Page, place: &Place) -> (char, usize, usize, usize) {
    let last = |end| usize::from(end == MemberEnd::Last);
    match place.at {
        SpringPlace::Column { storey, line, end } => ('c', storey, line, last(end)),
        SpringPlace::Struck { frame, member, .. } => match (frame, member) {
            (None, MemberPlace::Column { line, storey }) => {
                ('m', storey, line, thousandths(page, place))
            }
            (
                _,
                MemberPlace::Column { storey: level, .. } | MemberPlace::Beam { floor: level, .. },
            ) => ('s', level, 0, 0),
            (_, MemberPlace::InSpace(place)) => ('s', place.storey() + 1, 0, 0),
        },
        SpringPlace::Beam { floor, bay, end } => ('b', floor, bay, last(end)),
        SpringPlace::Shear {
            frame, member, end, ..
        } => match (frame, member) {
            (None, MemberPlace::Column { line, storey }) => ('v', storey, line, last(end)),
            (
                _,
                MemberPlace::Column { storey: level, .. } | MemberPlace::Beam { floor: level, .. },
            ) => ('s', level, 0, 0),
            (_, MemberPlace::InSpace(place)) => ('s', place.storey() + 1, 0, last(end)),
        },
        SpringPlace::Fibre {
            frame,
            member,
            end,
            point,
            ..
        }
        | SpringPlace::Surface {
            frame,
            member,
            end,
            point,
            ..
        } => match (frame.or(point), member) {
            (None, MemberPlace::Column { line, storey }) => ('c', storey, line, last(end)),
            (None, MemberPlace::Beam { floor, span }) => ('b', floor, span, last(end)),
            (
                _,
                MemberPlace::Column { storey: level, .. } | MemberPlace::Beam { floor: level, .. },
            ) => ('s', level, 0, 0),
            (_, MemberPlace::InSpace(place)) => ('s', place.storey() + 1, 0, last(end)),
        },
        SpringPlace::Storey { storey }
        | SpringPlace::PlanStorey { storey, .. }
        | SpringPlace::Element { storey, .. }
        | SpringPlace::ColumnInPlan { storey, .. }
        | SpringPlace::BeamInPlan { floor: storey, .. } => ('s', storey, 0, 0),
        // Of a plane frame: the lines of its lower and its upper end.
        SpringPlace::Diagonal { frame: None, place } if place.line.is_none() => {
            let [low, high] = place.lines();
            ('d', place.storey, low + 1, high + 1)
        }
        SpringPlace::Diagonal { place, .. } => ('s', place.storey, 0, 0),
        SpringPlace::Sliding { frame, member } => match (frame, member) {
            (None, MemberPlace::Column { line, storey }) => ('v', storey, line, 0),
            (None, MemberPlace::Beam { floor, span }) => ('b', floor, span, 0),
            (
                _,
                MemberPlace::Column { storey: level, .. } | MemberPlace::Beam { floor: level, .. },
            ) => ('s', level, 0, 0),
            (_, MemberPlace::InSpace(place)) => ('s', place.storey() + 1, 0, 0),
        },
        SpringPlace::InSpace { place, end, .. } => ('s', place.storey() + 1, 0, last(end)),
        SpringPlace::Base { line, motion } => {
            ('f', 0, line, usize::from(motion == BaseMotion::Sliding))
        }
        SpringPlace::Footing { line, spring } => ('g', 0, line.unwrap_or(0), spring),
        SpringPlace::Bearings
        | SpringPlace::BearingInPlan { .. }
        | SpringPlace::Ring { .. }
        | SpringPlace::Stop { .. } => ('i', 0, 0, 0),
    }
}

/// Every spring that cracked, with its place: by time of yielding, then of cracking.
pub(crate) fn in_order<'a>(page: &Page<'a>, places: &[Place]) -> Vec<(Place, &'a SpringSummary)> {
    let mut found = Vec::new();
    for (index, building) in page.summary.buildings.iter().enumerate() {
        let places: Vec<&Place> = places.iter().filter(|p| p.building == index).collect();
        for spring in &building.hinges.list {
            let place = places.iter().find(|place| place.index == spring.index);
            if let Some(place) = place {
                found.push((**place, spring));
            }
        }
    }
    let never = f64::INFINITY;
    let key = |s: &SpringSummary| [s.yielded_s.unwrap_or(never), s.cracked_s.unwrap_or(never)];
    sort_by(&mut found, |(_, a), (_, b)| {
        let (a, b) = (key(a), key(b));
        a[0].total_cmp(&b[0]).then(a[1].total_cmp(&b[1]))
    });
    found
}

/// The springs whose loops are worth showing: in turn the next of greatest ductility and of greatest dissipation.
pub(crate) fn worst<'a>(order: &[(Place, &'a SpringSummary)]) -> Vec<(Place, &'a SpringSummary)> {
    let ranked = |of: fn(&SpringSummary) -> f64| {
        let mut ranked: Vec<usize> = (0..order.len()).collect();
        sort_by(&mut ranked, |a, b| {
            of(order[*b].1).total_cmp(&of(order[*a].1))
        });
        ranked
    };
    let rankings = [ranked(|s| s.ductility), ranked(|s| s.dissipated_j)];
    let mut chosen: Vec<usize> = Vec::new();
    for turn in 0..LOOPS.min(order.len()) {
        let next = rankings[turn % 2].iter().find(|i| !chosen.contains(i));
        chosen.extend(next);
    }
    sort_by(&mut chosen, |a, b| {
        order[*b].1.ductility.total_cmp(&order[*a].1.ductility)
    });
    chosen.into_iter().map(|index| order[index]).collect()
}

/// Corners of a backbone out to the greatest deformations, as (deformation, force) from the negative side on.
pub(crate) fn outline(backbone: &Backbone, reach: [f64; 2]) -> Vec<[f64; 2]> {
    let mut points = Vec::new();
    for side in Side::BOTH {
        let (curve, sign) = (backbone.side(side), side.sign());
        let end = reach[side.index()].max(1.2 * curve.yielding.deformation);
        let corners = [
            [curve.cracking.deformation, curve.cracking.force],
            [curve.yielding.deformation, curve.yielding.force],
            [end, curve.force_at(end)],
        ];
        let signed = corners.map(|[x, y]| [sign * x, sign * y]);
        match side {
            Side::Positive => points.extend(signed),
            Side::Negative => {
                let outwards: Vec<_> = signed.into_iter().rev().collect();
                points.splice(0..0, outwards);
            }
        }
    }
    points.insert(3, [0.0, 0.0]);
    points
}

/// Names a place, its building first where there are several.
pub(crate) fn name(page: &Page, place: &Place) -> String {
    let building = &page.model.buildings[place.building];
    let label = match &building.structure {
        Structure::Tiers(tiers) => {
            let frames = tiers.frames.iter().map(|frame| frame.name.clone());
            place
                .at
                .named(&tiers.element_names, &frames.collect::<Vec<_>>())
        }
        _ => place.at.to_string(),
    };
    if page.model.buildings.len() > 1 {
        format!("{}, {label}", building.name)
    } else {
        label
    }
}

/// The section of the page, if anything can yield.
pub(crate) fn section(page: &Page) -> Option<Markup> {
    let places = places(page);
    if places.is_empty() {
        return None;
    }
    let order = in_order(page, &places);
    let loops = page.springs.is_some() && !order.is_empty() && page.history.len() > 1;
    Some(html! {
        section #hinges {
            h2 { (message::cracking_and_yielding_title()) }
            @for (model, own) in page.model.buildings.iter().zip(&page.summary.buildings) {
                @if own.hinges.total > 0 { p { (sentence(model, own)) } }
            }
            @if loops {
                p.quiet {
                    (message::hinges_with_the_largest_ductility())
                }
                div #loops.multiples {}
            }
            @if !order.is_empty() { (table(page, &order)) }
        }
    })
}

fn sentence(model: &Building, building: &BuildingSummary) -> String {
    let all = damage(Some(model), building);
    let all: Vec<String> = all.iter().map(Damage::sentence).collect();
    let residual = building.response.residual_roof_displacement_m.abs();
    message::damage_of_building(
        &building.name,
        all.join("; "),
        format::energy(building.hinges.dissipated_j),
        message::residual_displacement_of_the_roof(format::millimetres(residual)),
    )
}

fn table(page: &Page, order: &[(Place, &SpringSummary)]) -> Markup {
    let storeys = order.iter().any(|(place, _)| slides(place.at));
    let members = order.iter().any(|(place, _)| !slides(place.at));
    let [length, force, moment] = [format::LENGTH, format::FORCE, format::MOMENT].map(Shown::name);
    let [deformation, force] = match (members, storeys) {
        (true, false) => ["mrad".to_owned(), moment.to_owned()],
        (false, true) => [length.to_owned(), force.to_owned()],
        _ => [format!("mrad; {length}"), format!("{moment}; {force}")],
    };
    let energy = format::ENERGY.name();
    let buckles = order.iter().any(|(place, _)| place.buckles());
    let columns = [
        (message::cracked(), "s"),
        (
            match buckles {
                true => message::yielded_or_buckled(),
                false => message::yielded(),
            },
            "s",
        ),
        (message::ductility(), ""),
        (message::greatest_positive(), &deformation[..]),
        (message::greatest_negative(), &deformation[..]),
        (message::peak(), &force[..]),
        (message::dissipated(), energy),
    ];
    let all = order.len();
    let shown = &order[..all.min(MOST_ROWS)];
    html! {
        @if all > MOST_ROWS {
            p.quiet { (message::the_first_of_in_order(MOST_ROWS, all)) }
        }
        div.scroll {
            table #hinge-table.clipped[shown.len() > FIRST_ROWS] {
                caption.quiet { @if buckles { (message::in_order_of_yielding_or_buckling()) } @else { (message::in_order_of_yielding()) } }
                thead { tr {
                    th.number scope="col" { (message::ordinal()) }
                    th scope="col" { (message::where_word()) }
                    @for (name, unit) in columns {
                        th.number scope="col" { (name) @if !unit.is_empty() { br; span.unit { "[" (unit) "]" } } }
                    }
                } }
                tbody {
                    @for (i, (place, spring)) in shown.iter().enumerate() {
                        tr.beyond[i >= FIRST_ROWS] {
                            td.number { (i + 1) }
                            td { (name(page, place)) }
                            @for value in cells(spring, place) { td.number { (value) } }
                        }
                    }
                }
            }
        }
        @if shown.len() > FIRST_ROWS {
            button.wide.unfold type="button" data-table="hinge-table" { (message::show_all_places(shown.len())) }
        }
    }
}

fn cells(spring: &SpringSummary, place: &Place) -> [String; 7] {
    let slides = slides(place.at);
    // A hinge that turns has radians and moments.
    let deformation = |value: f64| match slides {
        true => format::significant(format::LENGTH.of(value), 3),
        false => format::significant(value * 1e3, 3),
    };
    let force = if slides {
        format::FORCE
    } else {
        format::MOMENT
    };
    let instant =
        |t: Option<f64>| t.map_or_else(|| format::NOTHING.into(), |t| format::fixed(t, 3));
    [
        instant(spring.cracked_s.filter(|_| !place.buckles())),
        instant(spring.yielded_s),
        format::significant(spring.ductility, 3),
        deformation(spring.deformation_max),
        deformation(spring.deformation_min),
        format::significant(force.of(spring.peak_force), 4),
        format::significant(format::ENERGY.of(spring.dissipated_j), 3),
    ]
}

#[cfg(test)]
mod tests {
    use jostle::hysteresis::{Corners, HysteresisRule};

    use super::*;

    fn spring(index: usize, ductility: f64, dissipated: f64) -> SpringSummary {
        SpringSummary {
            place: String::new(),
            at: None,
            index,
            cracked_s: Some(1.0),
            yielded_s: None,
            deformation_max: 0.0,
            deformation_min: 0.0,
            ductility,
            peak_force: 0.0,
            dissipated_j: dissipated,
        }
    }

    fn backbone() -> Backbone {
        let positive = Corners {
            cracking: 100.0,
            yielding: 250.0,
            post_cracking: 0.3,
            post_yield: 0.0,
        };
        let negative = Corners {
            yielding: 400.0,
            ..positive
        };
        Backbone::from_forces(1e5, positive, negative).expect("sound")
    }

    #[test]
    fn outline_runs_from_end_to_end_through_zero() {
        let points = outline(&backbone(), [0.05, 0.0]);
        assert_eq!(points.len(), 7);
        assert!(points.windows(2).all(|pair| pair[0][0] < pair[1][0]));
        assert_eq!(points[3], [0.0, 0.0]);
        assert_eq!(points[6], [0.05, 250.0]);
        assert_eq!(points[0][1], -400.0);
        assert!((points[4][0] - 1e-3).abs() < 1e-12 && (points[5][0] - 6e-3).abs() < 1e-12);
    }

    #[test]
    fn loops_are_chosen_by_ductility_and_by_energy_in_turn() {
        let hysteresis = Hysteresis::new(HysteresisRule::PeakOriented, backbone()).expect("sound");
        let place = |spring: usize| Place {
            building: 0,
            spring,
            index: spring,
            at: SpringPlace::Storey { storey: spring + 1 },
            hysteresis,
        };
        // Ductility falls, energy rises with the index.
        let springs: Vec<SpringSummary> = (0..20)
            .map(|i| spring(i, 20.0 - i as f64, i as f64))
            .collect();
        let order: Vec<(Place, &SpringSummary)> =
            springs.iter().map(|s| (place(s.index), s)).collect();
        let chosen: Vec<usize> = worst(&order).iter().map(|(_, s)| s.index).collect();
        assert_eq!(chosen, [0, 1, 2, 17, 18, 19]);
        assert_eq!(worst(&order[..2]).len(), 2);
        assert!(worst(&[]).is_empty());
    }
}
