//! Faults of isolation and of walls.

use super::plan::is_inside_hull;
use super::{Faults, each};
use crate::model::{
    Base, Building, Damping, Isolation, Isolator, IsolatorDamping, Model, PlanPoint,
    SlidingSurface, Structure, Tiers, WALL,
};

/// Least distance of two bearings that keep a mat from turning \[m\].
const LEAST_APART: f64 = 1e-2;

/// Faults of the isolation of a building.
pub(super) fn check_isolation(faults: &mut Faults, path: &str, building: &Building) {
    let Some(isolation) = &building.base.isolation else {
        return;
    };
    let text = format!("{path}.isolation");
    let plain = Base {
        isolation: Some(*isolation),
        elevation: building.base.elevation,
        ..Base::default()
    };
    faults.require(building.base == plain, text.as_str(), || {
        "cannot be combined with base: the bearings are the base; leave out base".into()
    });
    match &building.structure {
        Structure::Frame(_) | Structure::Shear(_) => {}
        Structure::Given(_) => faults.add(
            text.as_str(),
            "is for frames, shear buildings and buildings with a plan; leave it out",
        ),
        Structure::Tiers(tiers) => check_isolation_in_plan(faults, path, isolation, tiers),
    }
    faults.require(
        !matches!(building.damping, Damping::AllModes { .. }),
        format!("{path}.damping.modes"),
        || "\"all\" is not possible for an isolated building; name one or two modes of the building fixed on its mat".into(),
    );
    faults.positive(isolation.mat_mass, format!("{text}.mat_mass"), "kg");
    if let Some(weight) = isolation.weight {
        faults.positive(weight, format!("{text}.weight"), "N");
    }
    check_isolator(faults, &text, isolation);
    check_bounds(faults, &text, isolation);
    if let Some(limit) = isolation.limit {
        faults.positive(limit, format!("{text}.limit"), "m");
    }
    for (side, stop) in ["left", "right"].into_iter().zip(isolation.stops) {
        let Some(stop) = stop else { continue };
        faults.positive(stop.at, format!("{text}.stop.{side}.at"), "m");
        faults.positive(
            stop.stiffness,
            format!("{text}.stop.{side}.stiffness"),
            "N/m",
        );
        if let Some(limit) = isolation.limit {
            faults.require(stop.at < limit, format!("{text}.stop.{side}.at"), || {
                format!(
                    "must be less than limit ({limit} m), found {} m: the stop would never be reached within the limit",
                    stop.at
                )
            });
        }
    }
}

/// What bearings of a building with a plan cannot do.
fn check_isolation_in_plan(faults: &mut Faults, path: &str, isolation: &Isolation, tiers: &Tiers) {
    let text = format!("{path}.isolation");
    for (frame_path, frame) in each(&tiers.frames, "frame") {
        faults.require(
            frame.base.is_fixed(),
            format!("{path}.{frame_path}.base"),
            || {
                "cannot be combined with isolation: columns are fixed to the mat; leave out base"
                    .into()
            },
        );
    }
    let [left, right] = isolation.stops;
    faults.require(left == right, format!("{text}.stop"), || {
        "is a ring under a building with a plan, the same all round: give at and stiffness instead of left and right, or moat walls ([[wall]] with from and to)".into()
    });
    let places = &tiers.bearings;
    let at = format!("{text}.bearings");
    faults.require(
        places.iter().flatten().all(|value| value.is_finite()),
        at.as_str(),
        || "must be finite".into(),
    );
    let Some(floor) = tiers.floors.first() else {
        return;
    };
    for (index, place) in places.iter().enumerate() {
        faults.require(
            is_inside_hull(*place, &floor.plan),
            format!("{at}[{index}]"),
            || "lies outside the plan of the lowest floor; measure it from the same origin as the corners of the plan".into(),
        );
    }
    let apart = |place: &PlanPoint| {
        let first = places[0];
        libm::hypot(place[0] - first[0], place[1] - first[1]) > LEAST_APART
    };
    faults.require(
        places.is_empty() || places.iter().any(apart),
        at.as_str(),
        || {
            "must be at two different points at least: otherwise nothing keeps the mat from turning"
                .into()
        },
    );
}

/// Faults of the range of the properties of bearings.
fn check_bounds(faults: &mut Faults, path: &str, isolation: &Isolation) {
    let Some(bounds) = isolation.bounds else {
        return;
    };
    for (key, factors, within) in [
        ("lower", bounds.lower, 0.0..=1.0),
        ("upper", bounds.upper, 1.0..=f64::MAX),
    ] {
        let is_sound = |factor: f64| factor > 0.0 && within.contains(&factor);
        let sound = is_sound(factors.stiffness) && is_sound(factors.strength);
        faults.require(sound, format!("{path}.bounds.{key}"), || match key {
            "lower" => "must be above 0 and at most 1: it multiplies the properties of the bearings, as in bounds = { lower = 0.85, upper = 1.3 }".into(),
            _ => "must be at least 1: it multiplies the properties of the bearings, as in bounds = { lower = 0.85, upper = 1.3 }".into(),
        });
    }
}

fn check_isolator(faults: &mut Faults, path: &str, isolation: &Isolation) {
    match isolation.damping {
        IsolatorDamping::Coefficient(damping) => {
            faults.not_negative(damping, format!("{path}.damping"), "N.s/m");
        }
        IsolatorDamping::Ratio(ratio) => {
            faults.require(
                (0.0..1.0).contains(&ratio),
                format!("{path}.damping_ratio"),
                || format!("must lie between 0 and 1 (0.15 is 15 % of critical), found {ratio}"),
            );
            let linear = matches!(isolation.isolator, Isolator::Linear { .. });
            faults.require(linear, format!("{path}.damping_ratio"), || {
                "is for kind = \"linear\": other bearings have no single stiffness; give damping in N.s/m".into()
            });
        }
    }
    match isolation.isolator {
        Isolator::Linear { stiffness } => {
            faults.positive(stiffness, format!("{path}.stiffness"), "N/m");
        }
        Isolator::LeadRubber {
            stiffness,
            yield_force,
            post_yield,
        } => {
            faults.positive(stiffness, format!("{path}.stiffness"), "N/m");
            faults.positive(yield_force, format!("{path}.yield"), "N");
            faults.require(
                (0.0..1.0).contains(&post_yield),
                format!("{path}.post_yield"),
                || format!("must be at least 0 and less than 1, found {post_yield}"),
            );
        }
        Isolator::HighDampingRubber {
            stiffness,
            damping_ratio,
            displacement,
            yield_displacement,
        } => {
            faults.positive(stiffness, format!("{path}.stiffness"), "N/m");
            faults.positive(displacement, format!("{path}.displacement"), "m");
            faults.positive(
                yield_displacement,
                format!("{path}.yield_displacement"),
                "m",
            );
            faults.require(
                yield_displacement < displacement,
                format!("{path}.yield_displacement"),
                || {
                    format!(
                        "must be less than displacement ({displacement} m), found {yield_displacement} m; it is about 0.05 to 0.1 of the height of the rubber"
                    )
                },
            );
            // Beyond, the loop would be wider than that of friction alone.
            let most = 2.0 / std::f64::consts::PI * (1.0 - yield_displacement / displacement);
            faults.require(
                damping_ratio > 0.0 && damping_ratio < most,
                format!("{path}.damping_ratio"),
                || {
                    format!(
                        "must be greater than 0 and less than {most:.3}, that of a loop without hardening; found {damping_ratio}"
                    )
                },
            );
        }
        Isolator::Pendulum {
            radius,
            friction,
            slip_displacement,
        } => {
            faults.positive(radius, format!("{path}.radius"), "m");
            faults.positive(slip_displacement, format!("{path}.slip_displacement"), "m");
            let field = format!("{path}.friction");
            faults.require(
                friction.slow > 0.0 && friction.slow.is_finite(),
                field.as_str(),
                || format!("must be greater than zero, found {}", friction.slow),
            );
            faults.require(
                friction.fast >= friction.slow && friction.fast < 1.0,
                field.as_str(),
                || {
                    format!(
                        "must lie between slow and 1 at high speed, found slow = {} and fast = {}",
                        friction.slow, friction.fast
                    )
                },
            );
            faults.not_negative(friction.rate, format!("{field}.rate"), "s/m");
        }
        Isolator::DoublePendulum {
            surfaces,
            slip_displacement,
        } => check_surfaces(faults, path, &surfaces, slip_displacement),
        Isolator::TriplePendulum {
            surfaces,
            slip_displacement,
        } => {
            check_surfaces(faults, path, &surfaces, slip_displacement);
            check_order_of_surfaces(faults, path, &surfaces);
        }
    }
}

/// Faults of the surfaces of a pendulum of several, one by one.
fn check_surfaces(faults: &mut Faults, path: &str, surfaces: &[SlidingSurface], slip: f64) {
    faults.positive(slip, format!("{path}.slip_displacement"), "m");
    for (index, surface) in surfaces.iter().enumerate() {
        let at = |key: &str| format!("{path}.{key}[{index}]");
        faults.positive(surface.radius, at("radius"), "m");
        faults.positive(surface.capacity, at("capacity"), "m");
        faults.require(
            surface.friction > 0.0 && surface.friction < 1.0,
            at("friction"),
            || {
                format!(
                    "must be greater than zero and less than one, found {}",
                    surface.friction
                )
            },
        );
    }
}

/// The stages of a triple pendulum are in series only in this order of friction and radii (Fenz and Constantinou, 2008).
fn check_order_of_surfaces(faults: &mut Faults, path: &str, surfaces: &[SlidingSurface; 4]) {
    let [lower, below, above, upper] = surfaces;
    let [first, last] = [below, above].map(|inner| inner.friction);
    faults.require(
        first == last && first < lower.friction && lower.friction <= upper.friction,
        format!("{path}.friction"),
        || {
            format!(
                "must be equal on both inner surfaces, greater on the lower bowl and not less on the upper one, as in friction = [0.04, 0.015, 0.015, 0.08]; found [{}, {first}, {last}, {}]",
                lower.friction, upper.friction
            )
        },
    );
    faults.require(
        lower.radius > below.radius && upper.radius > above.radius,
        format!("{path}.radius"),
        || {
            format!(
                "must be greater on each bowl than on the inner surface beside it, as in radius = [\"2.1 m\", \"0.3 m\", \"0.3 m\", \"2.1 m\"]; found [{}, {}, {}, {}] m",
                lower.radius, below.radius, above.radius, upper.radius
            )
        },
    );
}

/// Faults of the walls of a model.
pub(super) fn check_walls(faults: &mut Faults, model: &Model) {
    for (index, (path, wall)) in each(&model.walls, "wall").enumerate() {
        let name = format!("{path}.name");
        faults.require(!wall.name.trim().is_empty(), name.as_str(), || {
            "must not be empty".into()
        });
        faults.require(wall.name != WALL, name.as_str(), || {
            format!(
                "\"{WALL}\" stands for a rigid wall in gaps and links; give the wall another name"
            )
        });
        let taken = model.buildings.iter().any(|other| other.name == wall.name)
            || model.walls[..index]
                .iter()
                .any(|other| other.name == wall.name);
        faults.require(!taken, name.as_str(), || {
            format!(
                "a building or another wall is called \"{}\" too; give every one its own name",
                wall.name
            )
        });
        faults.not_negative(wall.damping, format!("{path}.damping"), "N.s/m");
        faults.not_negative(wall.mass, format!("{path}.mass"), "kg");
        match wall.stiffness {
            Some(stiffness) => {
                faults.positive(stiffness, format!("{path}.stiffness"), "N/m");
                faults.require(wall.mass > 0.0, format!("{path}.mass"), || {
                    "is needed, because a force acts on it at once; a cantilever of mass m struck at its top has 33 m/140".into()
                });
            }
            None => faults.require(
                wall.damping == 0.0 && wall.mass == 0.0,
                format!("{path}.stiffness"),
                || "is needed for a wall with damping or mass; without it the wall is rigid".into(),
            ),
        }
        match (model.is_in_space(), wall.line) {
            (false, None) => {}
            (false, Some(_)) => faults.add(
                format!("{path}.from"),
                "is for walls among buildings with a plan; remove from and to",
            ),
            (true, None) => faults.add(
                format!("{path}.from"),
                "is needed among buildings with a plan: add from and to, the ends of its face, solid on the right of the way",
            ),
            (true, Some(_)) => {
                let finite = wall.line.iter().flatten().flatten().all(|v| v.is_finite());
                faults.require(
                    finite && wall.plan().is_some(),
                    format!("{path}.to"),
                    || "must be another point than from".into(),
                );
            }
        }
    }
}
