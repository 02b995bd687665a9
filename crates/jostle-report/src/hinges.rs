//! Cracking and yielding: places, selected loops, the table in order of yielding.

use jostle::SpacePlace;
use jostle::hysteresis::{Backbone, Hysteresis, Side};
use jostle::linear::sort_by;
use jostle::model::{Building, Hinges, Model, Structure};
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

/// Every spring of the model that can yield, from the left building on.
pub(crate) fn places(model: &Model) -> Vec<Place> {
    let (mut places, mut count) = (Vec::new(), 0);
    for (index, building) in model.buildings.iter().enumerate() {
        if !building.may_yield() {
            continue;
        }
        for (number, at) in Discretization::new(building)
            .spring_places
            .into_iter()
            .enumerate()
        {
            if let Some(hysteresis) = hysteresis_of(building, at) {
                places.push(Place {
                    building: index,
                    spring: count,
                    index: number,
                    at,
                    hysteresis,
                });
            }
            // Springs of bearings and shear of columns count, but are shown elsewhere.
            count += 1;
        }
    }
    places
}

fn hysteresis_of(building: &Building, at: SpringPlace) -> Option<Hysteresis> {
    let frame_of = |frame: Option<usize>| match (&building.structure, frame) {
        (Structure::Frame(frame), None) => Some(frame),
        (Structure::Tiers(tiers), Some(frame)) => Some(&tiers.frames.get(frame - 1)?.frame),
        _ => None,
    };
    match at {
        SpringPlace::Diagonal { frame, place } => {
            // Struts that lift off are no hinges.
            let in_space = match &building.structure {
                Structure::Tiers(tiers) if frame.is_none() => tiers.space_frame.as_ref(),
                _ => None,
            };
            let mut diagonals = match in_space {
                Some(frame) => frame.diagonals.iter(),
                None => frame_of(frame)?.diagonals.iter(),
            };
            let diagonal = diagonals.find(|diagonal| diagonal.place == place)?;
            return diagonal.hysteresis.filter(|_| at.is_hinge());
        }
        SpringPlace::Sliding { frame, member } => {
            let frame = frame_of(frame)?;
            return match member {
                MemberPlace::Column { line, storey } => frame.wall([storey - 1, line - 1])?.shear,
                MemberPlace::Beam { floor, span } => {
                    frame.coupling_beam([floor - 1, span - 1])?.shear
                }
                MemberPlace::InSpace(_) => None,
            };
        }
        SpringPlace::Column { storey, line, end }
        | SpringPlace::ColumnInPlan {
            storey, line, end, ..
        } => {
            let frame = match at {
                SpringPlace::ColumnInPlan { frame, .. } => Some(frame),
                _ => None,
            };
            if let Some(wall) = frame_of(frame)?.wall([storey - 1, line - 1]) {
                return wall.hinge_at(storey, end == MemberEnd::Last);
            }
        }
        _ => {}
    }
    if let SpringPlace::Base { motion, .. } = at {
        return match motion {
            BaseMotion::Rocking => building.base.rotational_hinge,
            BaseMotion::Sliding => building.base.horizontal_hinge,
        };
    }
    if let Structure::Tiers(tiers) = &building.structure {
        let mut springs = tiers.yielding.iter();
        let location = match at {
            SpringPlace::PlanStorey { storey, axis } => (None, storey, axis),
            SpringPlace::Element {
                element,
                storey,
                axis,
            } => (Some(element - 1), storey, axis),
            SpringPlace::ColumnInPlan {
                frame,
                storey,
                line,
                ..
            } => {
                let hinges = &tiers.frames.get(frame - 1)?.hinges;
                return hinges.columns.get(storey - 1)?.get(line - 1).copied();
            }
            SpringPlace::InSpace { place, axis, .. } => {
                let frame = tiers.space_frame.as_ref()?;
                let mut members = frame.members.iter();
                let member = members.find(|member| member.place == place)?;
                let plane = match place {
                    SpacePlace::Column { .. } => axis.index(),
                    SpacePlace::BeamX { .. } | SpacePlace::BeamY { .. } => 0,
                };
                return member.hinges[plane];
            }
            SpringPlace::BeamInPlan {
                frame, floor, bay, ..
            } => {
                let hinges = &tiers.frames.get(frame - 1)?.hinges;
                return hinges.beams.get(floor - 1)?.get(bay - 1).copied();
            }
            _ => return None,
        };
        let found =
            springs.find(|spring| (spring.element, spring.storey + 1, spring.axis) == location);
        return found.map(|spring| spring.hysteresis);
    }
    match (building.hinges.as_ref()?, at) {
        (Hinges::Frame(hinges), SpringPlace::Column { storey, line, .. }) => {
            hinges.columns.get(storey - 1)?.get(line - 1).copied()
        }
        (Hinges::Frame(hinges), SpringPlace::Beam { floor, bay, .. }) => {
            hinges.beams.get(floor - 1)?.get(bay - 1).copied()
        }
        (Hinges::Storeys(springs), SpringPlace::Storey { storey }) => {
            springs.get(storey - 1).copied()
        }
        _ => None,
    }
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

/// Kind, level, line and end of a place, for the scripts.
pub(crate) fn coordinates(at: SpringPlace) -> (char, usize, usize, usize) {
    let last = |end| usize::from(end == MemberEnd::Last);
    match at {
        SpringPlace::Column { storey, line, end } => ('c', storey, line, last(end)),
        SpringPlace::Beam { floor, bay, end } => ('b', floor, bay, last(end)),
        SpringPlace::Shear { storey, line, end } => ('v', storey, line, last(end)),
        SpringPlace::Fibre { member, end, .. } => match member {
            MemberPlace::Column { line, storey } => ('c', storey, line, last(end)),
            MemberPlace::InSpace(place) => ('s', place.storey() + 1, 0, last(end)),
            MemberPlace::Beam { floor, span } => ('b', floor, span, last(end)),
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
    let places = places(page.model);
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
    let columns = [
        (message::cracked(), "s"),
        (message::yielded(), "s"),
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
                caption.quiet { (message::in_order_of_yielding()) }
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
                            @for value in cells(spring, slides(place.at)) { td.number { (value) } }
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

fn cells(spring: &SpringSummary, slides: bool) -> [String; 7] {
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
        instant(spring.cracked_s),
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
