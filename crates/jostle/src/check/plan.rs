//! Faults of buildings with plans, and of gaps between them.

use super::{Faults, each, given, plan_frames, space_frame};
use crate::contact::LawKind;
use crate::interface::plan_contacts::MOST_POINTS;
use crate::interface::{Touched, columns_not_met, faces_of_gap};
use crate::model::{
    Base, Building, ColumnLine, Gap, Link, Model, PlanArea, PlanColumn, PlanPoint, Structure,
    Tiers, Wall,
};

/// Whether all buildings have plans, or none has.
pub(super) fn check_space(faults: &mut Faults, model: &Model) {
    if !model.is_in_space() {
        for (path, link) in each(&model.links, "link") {
            faults.require(link.at.is_none(), format!("{path}.at"), || {
                "is for buildings with a plan; leave it out".into()
            });
        }
        return;
    }
    for (path, building) in each(&model.buildings, "building") {
        let has_plan = matches!(building.structure, Structure::Tiers(_));
        faults.require(has_plan, format!("{path}.plan"), || {
            "is missing: other buildings have one, and a model is either in space or in one plane; give it a plan, or remove plan from the others".into()
        });
    }
    for (path, link) in each(&model.links, "link") {
        check_place(faults, &path, link);
    }
    check_overlaps(faults, model);
}

/// Points between which a link acts.
fn check_place(faults: &mut Faults, path: &str, link: &Link) {
    let field = format!("{path}.at");
    let Some([from, to]) = link.at else {
        faults.add(
            field,
            "is missing: among buildings with plans a link needs both of its ends, such as at = [[\"10 m\", \"4 m\"], [\"10.1 m\", \"4 m\"]]",
        );
        return;
    };
    let finite = [from, to]
        .iter()
        .flatten()
        .all(|coordinate| coordinate.is_finite());
    faults.require(finite, field.as_str(), || "must be finite".into());
    faults.require(!finite || from != to, field, || {
        "names one point twice: the force of a link acts along the line between its ends".into()
    });
}

pub(super) fn check_tiers(faults: &mut Faults, path: &str, tiers: &Tiers, building: &Building) {
    let n = tiers.floors.len();
    let at = |field: &str| format!("{path}.{field}");
    faults.require(n >= 1, at("mass"), || "needs at least one floor".into());
    let has_frames =
        !tiers.frames.is_empty() || tiers.space_frame.is_some() || tiers.matrices.is_some();
    for (field, count) in [
        ("stiffness", tiers.storeys.len()),
        ("storey_height", tiers.storey_heights.len()),
    ] {
        let none = (has_frames || !tiers.yielding.is_empty()) && field == "stiffness" && count == 0;
        faults.require(count == n || none, at(field), || {
            format!("has {count} entries for {n} floors; give one per storey from the ground up")
        });
    }
    let mut plans_are_sound = true;
    for (index, floor) in tiers.floors.iter().enumerate() {
        let of_floor = |field: &str| {
            if n > 1 {
                format!("{path}.{field}[{index}]")
            } else {
                at(field)
            }
        };
        faults.positive(floor.mass, of_floor("mass"), "kg");
        faults.positive(floor.polar_mass, of_floor("polar_mass"), "kg.m2");
        if let Some(problem) = polygon_fault(&floor.plan) {
            faults.add(of_floor("plan"), problem);
            plans_are_sound = false;
            continue;
        }
        faults.require(
            is_inside_hull(floor.centre, &floor.plan),
            of_floor("mass_centre"),
            || {
                match &tiers.matrices {
                    None => "lies outside the plan; measure it from the same origin as the corners of the plan".into(),
                    Some(_) => format!(
                        "lies outside the plan, at {:.3?} m by the mass matrix; check the place of the reference point (at of its port) and the signs of the entries between displacements and the rotation",
                        floor.centre
                    ),
                }
            },
        );
        let reach = floor.plan.iter().map(|corner| {
            (corner[0] - floor.centre[0]).powi(2) + (corner[1] - floor.centre[1]).powi(2)
        });
        let most = floor.mass * reach.fold(0.0, f64::max);
        faults.require(floor.polar_mass <= most, of_floor("polar_mass"), || {
            format!(
                "is {:.4e} kg.m2, more than {most:.4e} kg.m2, which all mass in the farthest corner has; check its unit",
                floor.polar_mass
            )
        });
    }
    for (index, spring) in tiers.yielding.iter().enumerate() {
        faults.require(
            spring.storey < n && spring.at.iter().all(|value| value.is_finite()),
            at(&format!("yielding[{index}]")),
            || {
                format!(
                    "must have a storey from 0 to {} and a place that is finite, found storey {} at {:?}",
                    n.saturating_sub(1),
                    spring.storey,
                    spring.at
                )
            },
        );
    }
    let together = (0..n).filter_map(|index| Some((index, tiers.initial_storey(index)?)));
    // What a plan with a fault leaves unknown is no other fault.
    let known = |value: f64| plans_are_sound || !value.is_nan();
    for (index, storey) in together {
        let field = if n > 1 {
            format!("{path}.stiffness[{index}]")
        } else {
            at("stiffness")
        };
        for (key, value, unit) in [
            ("x", storey.stiffness[0], "N/m"),
            ("y", storey.stiffness[1], "N/m"),
            ("torsion", storey.stiffness[2], "N.m/rad"),
        ] {
            let usable = value.is_finite() && (value > 0.0 || has_frames && value == 0.0);
            let usable = usable || !known(value);
            let remedy = match key {
                "torsion" => "; with elements, put two of them at different points",
                _ => "",
            };
            faults.require(usable, format!("{field}.{key}"), || {
                format!("must be greater than 0 {unit}, found {value}{remedy}")
            });
        }
        faults.require(
            (storey.centre.iter()).all(|value| value.is_finite() || !known(*value)),
            at("eccentricity"),
            || "must be finite".into(),
        );
    }
    plan_frames::check_plan_frames(faults, path, tiers, building);
    space_frame::check_space_frame(faults, path, tiers, building);
    given::check_floor_matrices(faults, path, tiers, building);
    check_plan_base(faults, &at("base"), tiers, &building.base);
    faults.require(
        tiers.bearings.is_empty() || building.base.isolation.is_some(),
        at("isolation.bearings"),
        || {
            "are those of an isolated building, and this one has no isolation; leave them out"
                .into()
        },
    );
    faults.require(building.hinges.is_none(), at("hinges"), || {
        "are those of frames and of storeys in one plane; a building with a plan has its own, Tiers::yielding".into()
    });
}

/// Faults of the springs under a building with a plan.
fn check_plan_base(faults: &mut Faults, path: &str, tiers: &Tiers, base: &Base) {
    for (key, given) in [
        ("horizontal_hinge", base.horizontal_hinge.is_some()),
        ("rotational_hinge", base.rotational_hinge.is_some()),
        ("vertical_stiffness", base.vertical_stiffness.is_some()),
        ("uplift", base.uplift),
    ] {
        faults.require(!given, format!("{path}.{key}"), || {
            "is not possible for a building with a plan yet; leave it out, or give it to the base of a frame".into()
        });
    }
    faults.require(
        base.isolation.is_none() || base.torsional_stiffness.is_none() && base.across.is_none(),
        path,
        || "cannot be combined with isolation; keep one of them".into(),
    );
    let [along, across] = base.in_plan();
    let pairs = [
        (
            "horizontal",
            [along.horizontal_stiffness, across.horizontal_stiffness],
            [along.horizontal_damping, across.horizontal_damping],
            ["N/m", "N.s/m"],
        ),
        (
            "rotational",
            [along.rotational_stiffness, across.rotational_stiffness],
            [along.rotational_damping, across.rotational_damping],
            ["N.m/rad", "N.m.s/rad"],
        ),
    ];
    for (name, stiffness, damping, units) in pairs {
        let field = format!("{path}.across.{name}_stiffness");
        faults.require(stiffness[0].is_some() == stiffness[1].is_some(), field.as_str(), || {
            "is rigid in one direction only; give a spring in both, a stiff one where it hardly moves, or in none".into()
        });
        if base.across.is_some() {
            if let Some(stiffness) = stiffness[1] {
                faults.positive(stiffness, field, units[0]);
            }
            let field = format!("{path}.across.{name}_damping");
            faults.not_negative(damping[1], field.as_str(), units[1]);
            faults.require(stiffness[1].is_some() || damping[1] == 0.0, field, || {
                format!("has nothing to do where the base is rigid; add {name}_stiffness")
            });
        }
    }
    for (index, frame) in tiers.frames.iter().enumerate() {
        let sways = frame.base.horizontal_stiffness.is_some();
        let at = format!(
            "{}frame[{index}].base.horizontal_stiffness",
            path.trim_end_matches("base")
        );
        faults.require(base.is_fixed() || !sways, at, || {
            "has nothing to do on a base that moves as a whole and holds the feet of the frame; leave it out".into()
        });
    }
}

/// What is wrong with a polygon.
fn polygon_fault(plan: &[PlanPoint]) -> Option<String> {
    if plan.len() < 3 {
        return Some(format!(
            "has {} corners; a plan needs at least three",
            plan.len()
        ));
    }
    if plan.iter().flatten().any(|value| !value.is_finite()) {
        return Some("has corners that are not finite".into());
    }
    let n = plan.len();
    let next = |index: usize| plan[(index + 1) % n];
    for (index, corner) in plan.iter().enumerate() {
        let end = next(index);
        if libm::hypot(end[0] - corner[0], end[1] - corner[1]) < 1e-6 {
            return Some(format!(
                "has two equal corners, {} and {}; remove one",
                index + 1,
                (index + 1) % n + 1
            ));
        }
    }
    for i in 0..n {
        for j in i + 1..n {
            let neighbours = j == i + 1 || (i == 0 && j == n - 1);
            if !neighbours && cross([plan[i], next(i)], [plan[j], next(j)]) {
                return Some(format!(
                    "crosses itself: the edges after corners {} and {} intersect",
                    i + 1,
                    j + 1
                ));
            }
        }
    }
    let area = PlanArea::new(plan).area;
    if area < -1e-9 {
        let reversed: Vec<String> = plan
            .iter()
            .rev()
            .map(|[x, y]| format!("[\"{x} m\", \"{y} m\"]"))
            .collect();
        return Some(format!(
            "has clockwise corners; give them counter-clockwise: [{}]",
            reversed.join(", ")
        ));
    }
    (area < 1e-9).then(|| "has no area".into())
}

/// On which side of a line a point lies.
fn side([a, b]: [PlanPoint; 2], p: PlanPoint) -> f64 {
    (b[0] - a[0]) * (p[1] - a[1]) - (b[1] - a[1]) * (p[0] - a[0])
}

/// Whether two segments intersect.
fn cross(first: [PlanPoint; 2], second: [PlanPoint; 2]) -> bool {
    let apart = |line: [PlanPoint; 2], ends: [PlanPoint; 2]| {
        side(line, ends[0]) * side(line, ends[1]) <= 0.0
    };
    apart(first, second) && apart(second, first)
}

/// Whether a point lies within the convex hull of corners: on no line through two of them are all corners on its far side.
pub(super) fn is_inside_hull(point: PlanPoint, plan: &[PlanPoint]) -> bool {
    let pairs = plan
        .iter()
        .flat_map(|a| plan.iter().map(move |b| [*a, *b]))
        .filter(|[a, b]| a != b);
    for line in pairs {
        let all_left = plan.iter().all(|corner| side(line, *corner) >= -1e-9);
        if all_left && side(line, point) < -1e-9 {
            return false;
        }
    }
    point.iter().all(|value| value.is_finite())
}

/// Whether two polygons overlap: edges intersect, or a corner of one lies within the other.
fn overlap(first: &[PlanPoint], second: &[PlanPoint]) -> bool {
    let edges = |plan: &[PlanPoint]| -> Vec<[PlanPoint; 2]> {
        let next = plan.iter().cycle().skip(1);
        plan.iter().zip(next).map(|(a, b)| [*a, *b]).collect()
    };
    let strictly = |a: [PlanPoint; 2], b: [PlanPoint; 2]| {
        let apart = |line: [PlanPoint; 2], ends: [PlanPoint; 2]| {
            let sides = ends.map(|end| side(line, end));
            sides[0] * sides[1] < 0.0 && sides.iter().all(|side| side.abs() > 1e-9)
        };
        apart(a, b) && apart(b, a)
    };
    let (a, b) = (edges(first), edges(second));
    a.iter()
        .any(|one| b.iter().any(|other| strictly(*one, *other)))
        || just_inside(second).any(|point| contains(first, &point))
        || just_inside(first).any(|point| contains(second, &point))
}

/// How far inside of an edge a point is looked at \[m\].
const INSIDE: f64 = 1e-6;

/// A point inside of every edge of a plan, beside its middle: plans may share corners and sides.
fn just_inside(plan: &[PlanPoint]) -> impl Iterator<Item = PlanPoint> {
    let next = plan.iter().cycle().skip(1);
    plan.iter().zip(next).map(|(a, b)| {
        let along = [b[0] - a[0], b[1] - a[1]];
        let share = INSIDE / libm::hypot(along[0], along[1]);
        [
            0.5 * (a[0] + b[0]) - share * along[1],
            0.5 * (a[1] + b[1]) + share * along[0],
        ]
    })
}

/// Whether a point lies inside a polygon, not on its edge.
fn contains(plan: &[PlanPoint], point: &PlanPoint) -> bool {
    let next = plan.iter().cycle().skip(1);
    let mut inside = false;
    for (a, b) in plan.iter().zip(next) {
        if side([*a, *b], *point).abs() < 1e-9 {
            return false;
        }
        if (a[1] > point[1]) != (b[1] > point[1]) {
            let x = a[0] + (point[1] - a[1]) / (b[1] - a[1]) * (b[0] - a[0]);
            inside ^= point[0] < x;
        }
    }
    inside
}

/// Plans of two buildings that overlap at a common height.
fn check_overlaps(faults: &mut Faults, model: &Model) {
    for (index, building) in model.buildings.iter().enumerate() {
        for other in &model.buildings[..index] {
            let (Structure::Tiers(tiers), Structure::Tiers(others)) =
                (&building.structure, &other.structure)
            else {
                continue;
            };
            let common = tiers.floors.iter().zip(&others.floors);
            let sound = |plan: &[PlanPoint]| polygon_fault(plan).is_none();
            for (floor, (a, b)) in common.enumerate() {
                if floor == 0 {
                    let pair = [(tiers, building), (others, other)];
                    check_foundations_apart(faults, index, pair);
                }
                if sound(&a.plan) && sound(&b.plan) && overlap(&a.plan, &b.plan) {
                    faults.add(
                        format!("building[{index}].at"),
                        format!(
                            "puts floor {} into that of \"{}\": their plans overlap; move one of the buildings",
                            floor + 1,
                            other.name
                        ),
                    );
                    break;
                }
            }
        }
    }
}

/// Foundations of two buildings that overlap; those of the second are known to be sound.
fn check_foundations_apart(faults: &mut Faults, index: usize, pair: [(&Tiers, &Building); 2]) {
    let plans = pair.map(|(tiers, building)| {
        building.base.foundation?;
        Some(tiers.carrier(&building.base)?.tier.plan)
    });
    let [Some(one), Some(other)] = plans else {
        return;
    };
    let sound = [&one, &other]
        .iter()
        .all(|plan| polygon_fault(plan).is_none());
    faults.require(
        !(sound && overlap(&one, &other)),
        format!("building[{index}].foundation"),
        || {
            format!(
                "overlaps the foundation of \"{}\": foundations are centred below the plan of the lowest floor",
                pair[1].1.name
            )
        },
    );
}

/// Faults of a gap between two buildings with plans.
pub(super) fn check_plan_gap(faults: &mut Faults, path: &str, gap: &Gap, model: &Model) {
    let last = model.buildings.len();
    let between = match gap.between {
        [Some(a), Some(b)] if a != b && a.min(b) < last && a.max(b) < last + model.walls.len() => {
            [a, b]
        }
        [None, _] | [_, None] => {
            faults.add(
                format!("{path}.between"),
                "names a wall without a place on the site; add a [[wall]] with name, from and to, and name it",
            );
            return;
        }
        _ => {
            faults.add(
                format!("{path}.between"),
                "must name two different buildings, or a building and a wall",
            );
            return;
        }
    };
    let contact = gap.in_plan;
    faults.require(
        (2..=MOST_POINTS).contains(&contact.points),
        format!("{path}.points"),
        || {
            format!(
                "must lie between 2 and {MOST_POINTS}, found {}; 5 suits most models, 3 is faster",
                contact.points
            )
        },
    );
    faults.positive(contact.reach, format!("{path}.reach"), "m");
    check_friction(faults, path, gap);
    faults.require(gap.widths.len() == 1, format!("{path}.width"), || {
        "takes one value between buildings with a plan".into()
    });
    if contact.points < 2 || contact.reach <= 0.0 || contact.reach.is_nan() {
        return;
    }
    if overlaps_wall(model, between) {
        faults.add(
            format!("{path}.between"),
            "has the building inside of the wall: it is solid on the right of the way from its point from to its point to; exchange them, or move one of the two",
        );
        return;
    }
    let touches = faces_of_gap(model, gap).is_none_or(|faces| !faces.is_empty());
    faults.require(touches, format!("{path}.reach"), || {
        let [a, b] = between.map(|side| match model.buildings.get(side) {
            Some(building) => &building.name,
            None => &model.walls[side - last].name,
        });
        format!(
            "of {} m finds no edges of \"{a}\" and \"{b}\" that face each other at a common floor (parallel within 0.1 rad), nor columns before such an edge; check at and plan, or raise reach",
            contact.reach
        )
    });
    for (entry, both) in columns_not_met(model, gap) {
        let problem = match both {
            true => "lies between floors on both sides; name a floor on one of them".to_owned(),
            false => format!(
                "lies between floors, where no column stands within reach = {} m and the common width of two edges that are parallel within 0.1 rad; leave the point out, or check at, plan and reach",
                contact.reach
            ),
        };
        faults.add(format!("{path}.floors[{entry}]"), problem);
    }
    for side in between.into_iter().filter(|side| *side < last) {
        check_struck(faults, path, (model, gap), side);
    }
}

/// Whether the columns of a building can bear what a gap says of them where they are struck between floors.
fn check_struck(faults: &mut Faults, path: &str, (model, gap): (&Model, &Gap), building: usize) {
    let building_model = &model.buildings[building];
    let Structure::Tiers(tiers) = &building_model.structure else {
        return;
    };
    let name = &building_model.name;
    let faces = faces_of_gap(model, gap).unwrap_or_default().into_iter();
    let struck = faces.flat_map(|(touched, _)| {
        let sides = gap.between.into_iter().zip(touched);
        sides.filter_map(|(side, touched)| match touched {
            Touched::Column(column, _) if side == Some(building) => Some(column),
            Touched::Column(..) | Touched::Floor(_) => None,
        })
    });
    let struck: Vec<PlanColumn> = struck.collect();
    if !struck.is_empty()
        && let Some(problem) = space_frame::fault_of_column_masses(tiers)
    {
        faults.add(
            format!("{path}.floors"),
            format!("hits columns of \"{name}\", {problem}"),
        );
    }
    for column in struck {
        let ColumnLine::OfFrame([frame, _]) = column.line else {
            continue;
        };
        let frame = &tiers.frames[frame];
        if gap.in_plan.per_length {
            faults.add(
                format!("{path}.stiffness_per_length"),
                format!(
                    "is multiplied by the width of a column that is hit, and those of frame {} of \"{name}\" have none; give stiffness, or describe \"{name}\" as a space frame",
                    frame.name
                ),
            );
            return;
        }
        if !frame.is_along_an_axis() {
            faults.add(
                format!("{path}.floors"),
                format!(
                    "hits columns of frame {} of \"{name}\", which stands neither along x nor across: masses between floors would couple both directions; leave these points out, or describe \"{name}\" as a space frame",
                    frame.name
                ),
            );
            return;
        }
    }
}

/// Whether a floor of the building lies inside of the wall of a gap, if it has one.
fn overlaps_wall(model: &Model, between: [usize; 2]) -> bool {
    let wall = between.iter().find_map(|side| model.wall(Some(*side)));
    let building = between.iter().find_map(|side| model.buildings.get(*side));
    let (Some(solid), Some(building)) = (wall.and_then(Wall::plan), building) else {
        return false;
    };
    let Structure::Tiers(tiers) = &building.structure else {
        return false;
    };
    let mut plans = tiers.floors.iter().map(|floor| &floor.plan);
    plans.any(|plan| polygon_fault(plan).is_none() && overlap(plan, &solid))
}

/// Faults of friction along the faces of a gap.
fn check_friction(faults: &mut Faults, path: &str, gap: &Gap) {
    let contact = gap.in_plan;
    faults.require(
        (0.0..1.0).contains(&contact.friction),
        format!("{path}.friction"),
        || {
            format!(
                "must lie between 0 and 1, 1 excluded, found {}; concrete on concrete has some 0.4",
                contact.friction
            )
        },
    );
    if let Some(stiffness) = contact.tangential_stiffness {
        let at = format!("{path}.tangential_stiffness");
        faults.positive(stiffness, at.clone(), "N/m");
        faults.require(contact.friction != 0.0, at, || {
            "is for faces with friction; add friction = 0.4, or remove it".into()
        });
    }
    if contact.friction > 0.0 {
        let law = gap.law.kind;
        faults.require(
            law != LawKind::Restitution,
            format!("{path}.friction"),
            || {
                format!(
                    "needs a contact force, which the law {} does not have; choose another law",
                    law.name()
                )
            },
        );
        let is_rubber = matches!(law, LawKind::Rubber(_));
        faults.require(
            !is_rubber || contact.tangential_stiffness.is_some(),
            format!("{path}.tangential_stiffness"),
            || "has no usual value for rubber; add tangential_stiffness = \"50 MN/m\"".into(),
        );
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn polygons_are_judged() {
        let square = vec![[0.0, 0.0], [4.0, 0.0], [4.0, 4.0], [0.0, 4.0]];
        assert_eq!(polygon_fault(&square), None);
        let clockwise: Vec<PlanPoint> = square.iter().rev().copied().collect();
        let said = polygon_fault(&clockwise).expect("a fault");
        assert!(
            said.contains("counter-clockwise: [[\"0 m\", \"0 m\"]"),
            "{said}"
        );
        let bow = vec![[0.0, 0.0], [4.0, 4.0], [4.0, 0.0], [0.0, 4.0]];
        assert!(
            polygon_fault(&bow)
                .expect("a fault")
                .contains("crosses itself")
        );
        assert!(polygon_fault(&square[..2]).is_some());
        assert!(polygon_fault(&[[0.0, 0.0], [0.0, 0.0], [1.0, 1.0]]).is_some());
        assert!(is_inside_hull([2.0, 2.0], &square) && !is_inside_hull([5.0, 2.0], &square));
        let beside: Vec<PlanPoint> = square.iter().map(|[x, y]| [x + 4.0, *y]).collect();
        assert!(!overlap(&square, &beside));
        let into: Vec<PlanPoint> = square.iter().map(|[x, y]| [x + 3.9, y + 1.0]).collect();
        assert!(overlap(&square, &into));
        let within = vec![[1.0, 1.0], [2.0, 1.0], [2.0, 2.0], [1.0, 2.0]];
        assert!(overlap(&square, &within) && overlap(&within, &square));
    }
}
