//! Faults of gaps and links.

use std::collections::BTreeMap;

use super::plan::check_plan_gap;
use super::{Faults, each};
use crate::contact::{ContactLaw, LawKind};
use crate::interface::contact_points::{crowded, point_pairs};
use crate::model::{FloorPairs, Gap, Link, Model};

pub(super) fn check_neighbours(faults: &mut Faults, model: &Model) {
    for (index, (path, gap)) in each(&model.gaps, "gap").enumerate() {
        check_gap(faults, &path, gap, model);
        let twin = model.gaps[..index].iter().position(|other| other == gap);
        if let Some(twin) = twin {
            faults.add(
                format!("{path}.between"),
                format!("repeats gap[{twin}] in every respect; keep one"),
            );
        }
    }
    for (path, link) in each(&model.links, "link") {
        check_link(faults, &path, link, model);
    }
    check_room(faults, model);
}

/// Points of different gaps and links that nearly coincide on one side of a building.
fn check_room(faults: &mut Faults, model: &Model) {
    if model.is_in_space() {
        return;
    }
    let gaps = each(&model.gaps, "gap")
        .map(|(path, gap)| (path, gap.between, &gap.floors, gap.level_tolerance));
    let links = each(&model.links, "link")
        .map(|(path, link)| (path, link.between, &link.floors, link.level_tolerance));
    let mut met: BTreeMap<(usize, usize), Vec<f64>> = BTreeMap::new();
    for (path, between, floors, tolerance) in gaps.chain(links) {
        let Ok(pairs) = point_pairs(floors, model.neighbours(between), tolerance) else {
            continue;
        };
        for pair in pairs {
            for side in 0..2 {
                let (Some(building), Some(height)) = (between[side], pair[side]) else {
                    continue;
                };
                let port = met.entry((building, side)).or_default();
                if let Some(problem) = crowded(height, port.iter().copied()) {
                    faults.add(format!("{path}.floors"), problem);
                }
                port.push(height);
            }
        }
    }
}

/// Whether both sides are neighbours in the row, or a building at its end and a wall.
fn check_between(
    faults: &mut Faults,
    path: &str,
    between: [Option<usize>; 2],
    model: &Model,
) -> bool {
    let last = model.buildings.len().wrapping_sub(1);
    let problem = match between {
        [Some(left), Some(right)] if right == left + 1 && right <= last => return true,
        [None, Some(0)] if !model.buildings.is_empty() => return true,
        [Some(left), None] if left == last => return true,
        [None, Some(_)] => "a wall on the left stands before the first building",
        [Some(_), None] => "a wall on the right stands behind the last building",
        [None, None] => "must name a building on at least one side",
        _ => "must name two neighbouring buildings",
    };
    faults.add(format!("{path}.between"), problem);
    false
}

fn check_gap(faults: &mut Faults, path: &str, gap: &Gap, model: &Model) {
    faults.require(!gap.widths.is_empty(), format!("{path}.width"), || {
        "is empty; give one width, or one per contact".into()
    });
    let several = gap.widths.len() > 1;
    for (index, width) in gap.widths.iter().enumerate() {
        let field = if several {
            format!("{path}.width[{index}]")
        } else {
            format!("{path}.width")
        };
        faults.require(width.is_finite() && *width >= 0.0, field, || {
            format!("must not be negative, found {width} m; touching buildings have a gap of zero")
        });
    }
    let separation = gap.minimum_separation;
    faults.require(
        separation.is_finite() && separation >= 0.0,
        format!("{path}.minimum_separation"),
        || format!("must not be negative, found {separation} s"),
    );
    faults.positive(gap.level_tolerance, format!("{path}.level_tolerance"), "m");
    if model.is_in_space() {
        check_plan_gap(faults, path, gap, model);
    } else if !check_between(faults, path, gap.between, model) {
        return;
    }
    faults.positive(
        gap.law.stiffness,
        format!("{path}.stiffness"),
        if gap.law.kind.is_hertzian() {
            "N/m^1.5"
        } else {
            "N/m"
        },
    );
    let e = gap.law.restitution;
    if gap.law.kind.is_dissipative() {
        faults.require(e > 0.0 && e <= 1.0, format!("{path}.restitution"), || {
            format!("must be greater than 0 and at most 1, found {e}")
        });
        let least = gap.law.least_restitution();
        faults.require(e > least, format!("{path}.restitution"), || {
            format!(
                "cannot be realised by {} below {least:.4}; use hertz-damp, or a larger value",
                gap.law.kind.name()
            )
        });
    }
    check_shape(faults, path, &gap.law);
    if let Some(contacts) = check_floors(
        faults,
        path,
        gap.between,
        &gap.floors,
        gap.level_tolerance,
        model,
    ) {
        let widths = gap.widths.len();
        faults.require(
            widths <= 1 || widths == contacts,
            format!("{path}.width"),
            || {
                format!(
                    "has {widths} entries for {contacts} contacts; give one width, or one per contact, in the order of floors or from the lowest up"
                )
            },
        );
    }
}

fn check_link(faults: &mut Faults, path: &str, link: &Link, model: &Model) {
    faults.not_negative(link.stiffness, format!("{path}.stiffness"), "N/m");
    faults.not_negative(link.damping, format!("{path}.damping"), "N.s/m");
    faults.require(
        link.stiffness != 0.0 || link.damping != 0.0,
        format!("{path}.stiffness"),
        || "and damping are both zero: nothing links the buildings; give one of them".into(),
    );
    faults.positive(link.level_tolerance, format!("{path}.level_tolerance"), "m");
    if check_between(faults, path, link.between, model) {
        check_floors(
            faults,
            path,
            link.between,
            &link.floors,
            link.level_tolerance,
            model,
        );
    }
}

/// Parameters of individual laws.
fn check_shape(faults: &mut Faults, path: &str, law: &ContactLaw) {
    match law.kind {
        LawKind::Bilinear(shape) => {
            let a = shape.yield_share;
            faults.require(a > 0.0 && a < 0.5, format!("{path}.yield_share"), || {
                format!("must lie between 0 and 0.5, found {a}")
            });
            if let Some(speed) = shape.design_speed {
                faults.positive(speed, format!("{path}.design_speed"), "m/s");
            }
        }
        LawKind::Rubber(bumper) => {
            faults.positive(bumper.thickness, format!("{path}.thickness"), "m");
            let n = bumper.exponent;
            faults.require((1.0..=6.0).contains(&n), format!("{path}.exponent"), || {
                format!("must lie between 1 and 6, found {n}")
            });
        }
        _ => {}
    }
}

/// The number of pairs of points, if they all fit.
fn check_floors(
    faults: &mut Faults,
    path: &str,
    between: [Option<usize>; 2],
    floors: &FloorPairs,
    tolerance: f64,
    model: &Model,
) -> Option<usize> {
    // Faults of the buildings are told by themselves.
    let heights = model.neighbours(between).into_iter().flatten();
    if heights
        .flat_map(|building| building.storey_heights())
        .any(|height| !(height.is_finite() && *height > 0.0))
    {
        return None;
    }
    match point_pairs(floors, model.neighbours(between), tolerance) {
        Ok(pairs) => Some(pairs.len()),
        Err(misfits) => {
            for misfit in misfits {
                let field = match misfit.entry {
                    Some(entry) => format!("{path}.floors[{entry}]"),
                    None => format!("{path}.floors"),
                };
                faults.add(field, misfit.problem);
            }
            None
        }
    }
}
