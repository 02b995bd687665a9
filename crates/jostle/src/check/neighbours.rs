//! Faults of gaps and links.

use std::collections::BTreeMap;

use super::plan::check_plan_gap;
use super::{Faults, each};
use crate::contact::{ContactLaw, ForceLaw, LawKind};
use crate::interface::contact_points::{crowded, point_pairs};
use crate::model::{FloorPairs, Gap, Level, Link, LinkLaw, Model};

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
        .filter(|(_, link)| !link.is_inside())
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
    let walls = between.map(|side| model.wall(side).is_some());
    let inside = |side: Option<usize>| side.is_some_and(|building| building <= last);
    let problem = match between {
        [_, other] if walls[0] && inside(other) => return true,
        [other, _] if walls[1] && inside(other) => return true,
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

/// Whether both sides are buildings, or a building and a wall with a name.
fn two_in_space(
    faults: &mut Faults,
    path: &str,
    between: [Option<usize>; 2],
    model: &Model,
) -> bool {
    let count = model.buildings.len();
    let known = |side: Option<usize>| side.is_some_and(|side| side < count + model.walls.len());
    let is_building = |side: Option<usize>| side.is_some_and(|side| side < count);
    let sound = between.into_iter().all(known) && between.into_iter().any(is_building);
    faults.require(sound, format!("{path}.between"), || {
        "names no two buildings of the model, nor a building and a wall of it".into()
    });
    sound
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
    if gap.law.kind.uses_restitution() {
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
    check_link_law(faults, path, link);
    faults.positive(link.level_tolerance, format!("{path}.level_tolerance"), "m");
    if let [Some(one), Some(other)] = link.between
        && one == other
    {
        check_inside(faults, path, one, link, model);
    } else if model.is_in_space() && two_in_space(faults, path, link.between, model)
        || !model.is_in_space() && check_between(faults, path, link.between, model)
    {
        check_floors(
            faults,
            path,
            link.between,
            &link.floors,
            link.level_tolerance,
            model,
        );
        check_ends_at_floors(faults, path, link, model);
    }
}

/// In space links end at floors.
fn check_ends_at_floors(faults: &mut Faults, path: &str, link: &Link, model: &Model) {
    if !model.is_in_space() {
        return;
    }
    let sides = model.neighbours(link.between);
    let pairs = point_pairs(&link.floors, sides, link.level_tolerance).unwrap_or_default();
    for (pair, side) in pairs.iter().flat_map(|pair| [(pair, 0), (pair, 1)]) {
        let (Some(building), Some(height)) = (sides[side], pair[side]) else {
            continue;
        };
        let base = Some(building.base.elevation).filter(|_| building.base.isolation.is_some());
        let mut floors = building.floor_levels().into_iter().chain(base);
        faults.require(floors.any(|floor| floor == height), format!("{path}.floors"), || {
            format!(
                "ends on a column of \"{}\" at {height:.3} m, between its floors: links between buildings with a plan end at floors; name one, or raise level_tolerance",
                building.name
            )
        });
    }
}

/// Least and greatest exponent of viscous dampers \[–\].
const EXPONENTS: [f64; 2] = [0.1, 2.0];

/// Parameters of the law of a link.
fn check_link_law(faults: &mut Faults, path: &str, link: &Link) {
    let name = link.law.name();
    let at = |key: &str| format!("{path}.{key}");
    let none = |faults: &mut Faults, key: &str, value: f64| {
        faults.require(value == 0.0, at(key), || {
            format!("has no meaning for law = \"{name}\"; leave it out")
        });
    };
    let needed = |faults: &mut Faults, key: &str, value: f64, unit: &str| {
        faults.require(value.is_finite() && value > 0.0, at(key), || {
            format!("must be greater than 0 for law = \"{name}\", found {value} {unit}")
        });
    };
    match &link.law {
        LinkLaw::Linear => {
            faults.not_negative(link.stiffness, at("stiffness"), "N/m");
            faults.not_negative(link.damping, at("damping"), "N.s/m");
            faults.require(
                link.stiffness != 0.0 || link.damping != 0.0,
                at("stiffness"),
                || {
                    "and damping are both zero: nothing links the buildings; give one of them"
                        .into()
                },
            );
        }
        LinkLaw::Viscous { exponent } => {
            let [least, most] = EXPONENTS;
            faults.require((least..=most).contains(exponent), at("exponent"), || {
                format!("must lie between {least} and {most}, found {exponent}")
            });
            needed(faults, "damping", link.damping, "N.(s/m)^exponent");
            faults.not_negative(link.stiffness, at("stiffness"), "N/m");
        }
        LinkLaw::Maxwell => {
            needed(faults, "stiffness", link.stiffness, "N/m");
            needed(faults, "damping", link.damping, "N.s/m");
        }
        LinkLaw::Friction {
            slip_force,
            stick_stiffness,
        } => {
            needed(faults, "slip_force", *slip_force, "N");
            needed(faults, "stick_stiffness", *stick_stiffness, "N/m");
            none(faults, "stiffness", link.stiffness);
            none(faults, "damping", link.damping);
        }
        LinkLaw::Yielding(_) => {
            none(faults, "stiffness", link.stiffness);
            none(faults, "damping", link.damping);
        }
        LinkLaw::Cable { slack } => {
            needed(faults, "stiffness", link.stiffness, "N/m");
            none(faults, "damping", link.damping);
            faults.not_negative(*slack, at("slack"), "m");
        }
        LinkLaw::Stopper { gap } => {
            needed(faults, "stiffness", link.stiffness, "N/m");
            faults.not_negative(link.damping, at("damping"), "N.s/m");
            faults.not_negative(*gap, at("gap"), "m");
        }
    }
}

/// A link between two floors of one building.
fn check_inside(faults: &mut Faults, path: &str, building: usize, link: &Link, model: &Model) {
    let Some(building) = model.buildings.get(building) else {
        faults.add(format!("{path}.between"), "names no building");
        return;
    };
    let name = &building.name;
    let FloorPairs::Listed(pairs) = &link.floors else {
        faults.add(
            format!("{path}.floors"),
            format!(
                "must list pairs of floors for a link inside \"{name}\", such as [[0, 1], [1, 2]]; 0 is its base"
            ),
        );
        return;
    };
    faults.require(!pairs.is_empty(), format!("{path}.floors"), || {
        "is empty; list pairs of floors, such as [[0, 1]]".into()
    });
    let roof = building.floors();
    for (entry, pair) in pairs.iter().enumerate() {
        let field = format!("{path}.floors[{entry}]");
        let [Level::Floor(low), Level::Floor(high)] = *pair else {
            faults.add(
                field,
                "must name two floors by their numbers; 0 is the base",
            );
            continue;
        };
        let highest = low.max(high);
        faults.require(highest <= roof, field.clone(), || {
            format!("floor {highest} does not exist: \"{name}\" has floors 1 to {roof}, and 0 is its base")
        });
        faults.require(low != high, field.clone(), || {
            "names the same floor twice; a link needs two".into()
        });
        faults.require(!pairs[..entry].contains(pair), field, || {
            "is listed twice; keep one".into()
        });
    }
}

/// Masses between which a formula is tried \[kg\].
const TRIED_MASS: f64 = 1e5;

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
        LawKind::Dashpot(dashpot) => {
            faults.not_negative(dashpot.damping, format!("{path}.damping"), "N.s/m");
        }
        LawKind::BilinearGiven(constants) => {
            let second = constants.second_stiffness;
            let at = format!("{path}.second_stiffness");
            faults.positive(second, at.clone(), "N/m");
            faults.require(second < law.stiffness, at, || {
                format!(
                    "must be less than stiffness, {} N/m, found {second} N/m; a contact that does not yield is law = \"linear\"",
                    law.stiffness
                )
            });
            faults.positive(constants.yield_indentation, format!("{path}.yield"), "m");
        }
        LawKind::Crushing(crush) => {
            faults.positive(crush.force, format!("{path}.crush.force"), "N");
            let share = crush.hardening;
            let (most, text, over) = match crush.hertzian {
                true => (
                    2.0 / 3.0,
                    "2/3 for the law hertz",
                    "that where the face begins to crush",
                ),
                false => (1.0, "1", "the contact stiffness"),
            };
            faults.require(
                (0.0..most).contains(&share),
                format!("{path}.crush.hardening"),
                || format!("must be at least 0 and below {text}, found {share}; it is the stiffness while crushing over {over}"),
            );
        }
        LawKind::Formula(formula) => {
            // The masses that collide differ from contact to contact; the damping that follows from them scales with their root.
            let tried = law.between(TRIED_MASS, TRIED_MASS);
            if let (ForceLaw::Formula(tried), true) = (tried, law.stiffness > 0.0)
                && let Some(problem) = tried.fault()
            {
                faults.add(
                    format!("{path}.formula"),
                    format!("\"{formula}\" {problem}"),
                );
            }
        }
        LawKind::Linear
        | LawKind::Kelvin
        | LawKind::KelvinNoTension
        | LawKind::ModifiedKelvin(_)
        | LawKind::Hertz
        | LawKind::HertzDamp
        | LawKind::Ye
        | LawKind::Jankowski
        | LawKind::Restitution => {}
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
