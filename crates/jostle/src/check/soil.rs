//! Faults of foundations and of the soil under them.

use super::{Faults, each};
use crate::eigen::symmetric;
use crate::model::{
    Base, Building, Damping, GroundSprings, MassDamping, Model, SoilCoupling, Solver, Structure,
};

/// Entries of a matrix that differ by less than this, relative to the diagonal, count as equal.
const SAME: f64 = 1e-9;

/// Faults of the foundation of a building.
pub(super) fn check_foundation(faults: &mut Faults, path: &str, building: &Building) {
    let Some(foundation) = &building.base.foundation else {
        return;
    };
    let text = format!("{path}.foundation");
    let plain = Base {
        foundation: Some(*foundation),
        elevation: building.base.elevation,
        ..Base::default()
    };
    faults.require(building.base == plain, text.as_str(), || {
        "cannot be combined with base or isolation: the soil is the base; leave out one of them"
            .into()
    });
    let (has_floors, has_plan) = match &building.structure {
        Structure::Frame(_) | Structure::Shear(_) => (true, false),
        Structure::Tiers(tiers) => (tiers.matrices.is_none(), true),
        Structure::Given(_) => (false, false),
    };
    faults.require(has_floors, text.as_str(), || {
        "is for frames and shear buildings, with a plan or without; leave it out".into()
    });
    if let Some(uplift) = &foundation.uplift {
        faults.require(
            has_plan || uplift.springs_across.is_none(),
            format!("{text}.springs_across"),
            || "is for buildings with a plan, which rock across too; leave it out".into(),
        );
    }
    if let Some(stiffness) = foundation.torsional_stiffness {
        faults.positive(stiffness, format!("{text}.torsional_stiffness"), "N.m/rad");
    }
    if let Some(damping) = foundation.torsional_damping {
        faults.not_negative(damping, format!("{text}.torsional_damping"), "N.m.s/rad");
    }
    for (key, given) in [
        ("torsional_stiffness", foundation.torsional_stiffness),
        ("torsional_damping", foundation.torsional_damping),
    ] {
        faults.require(has_plan || given.is_none(), format!("{text}.{key}"), || {
            "is for buildings with a plan, which turn; leave it out".into()
        });
    }
    if let Structure::Frame(frame) = &building.structure {
        let rises = foundation.uplift.is_some();
        faults.require(rises || !frame.axial.columns_flexible, text.as_str(), || {
            "requires axially rigid columns: leave out columns = \"flexible\", or write uplift = true".into()
        });
    }
    faults.require(
        !matches!(building.damping, Damping::AllModes { .. }),
        format!("{path}.damping.modes"),
        || "\"all\" is not possible for a building on a foundation, whose dashpots couple its modes; name one or two modes of the building on rigid ground".into(),
    );
    faults.positive(foundation.length, format!("{text}.length"), "m");
    faults.positive(foundation.width, format!("{text}.width"), "m");
    faults.not_negative(foundation.embedment, format!("{text}.embedment"), "m");
    faults.positive(foundation.mass, format!("{text}.mass"), "kg");
    faults.positive(
        foundation.rotary_inertia,
        format!("{text}.rotary_inertia"),
        "kg.m2",
    );
}

/// Faults of a foundation, or of feet of columns, that can lift off.
pub(super) fn check_uplift(faults: &mut Faults, path: &str, building: &Building) {
    let base = &building.base;
    faults.require(
        !base.lifts() || building.gravity.preload,
        format!("{path}.gravity"),
        || "is needed where the building can lift off: no weight holds it down; write gravity = true, or leave out uplift".into(),
    );
    faults.require(
        building.mass_damping == MassDamping::Support || base.foundation.is_some(),
        format!("{path}.damping.relative_to"),
        || "is for buildings on a foundation; leave it out".into(),
    );
    faults.require(
        !base.uplift || base.vertical_stiffness.is_some(),
        format!("{path}.base.vertical_stiffness"),
        || "is needed where columns can lift off: that of the ground under each".into(),
    );
    let foundation = base.foundation;
    let Some(uplift) = foundation.and_then(|foundation| foundation.uplift) else {
        return;
    };
    let text = format!("{path}.foundation");
    let held = uplift.ground.is_some()
        && foundation.is_some_and(|foundation| {
            foundation.torsional_stiffness.is_none() && foundation.torsional_damping.is_some()
        });
    faults.require(
        !held,
        format!("{path}.foundation.torsional_damping"),
        || "has nothing to do where the foundation cannot turn; add torsional_stiffness".into(),
    );
    let across = uplift.springs_across.unwrap_or(uplift.springs);
    for (key, count) in [("springs", uplift.springs), ("springs_across", across)] {
        faults.require(
            (2..=MOST_SPRINGS).contains(&count),
            format!("{text}.{key}"),
            || {
                format!(
                    "must lie between 2 and {MOST_SPRINGS}, found {count}: one spring cannot hold a foundation that rocks"
                )
            },
        );
    }
    let has_plan = matches!(building.structure, Structure::Tiers(_));
    let all = uplift.springs.saturating_mul(across);
    faults.require(
        !has_plan || all <= MOST_IN_PLAN,
        format!("{text}.springs"),
        || {
            format!(
                "must be at most {MOST_IN_PLAN} in all, found {} times {across}; 5 to 11 along a side are usual",
                uplift.springs
            )
        },
    );
    if let Some(ends) = uplift.ends {
        faults.positive(ends, format!("{text}.ends"), "");
    }
    if let Some(ground) = &uplift.ground {
        let GroundSprings {
            vertical_stiffness,
            vertical_damping,
            sway,
        } = *ground;
        faults.positive(
            vertical_stiffness,
            format!("{text}.vertical_stiffness"),
            "N/m",
        );
        faults.not_negative(
            vertical_damping,
            format!("{text}.vertical_damping"),
            "N.s/m",
        );
        if let Some([stiffness, damping]) = sway {
            faults.positive(stiffness, format!("{text}.sway_stiffness"), "N/m");
            faults.not_negative(damping, format!("{text}.sway_damping"), "N.s/m");
        }
    }
    if let Some(bearing) = &uplift.bearing {
        faults.positive(bearing.strength, format!("{text}.bearing_strength"), "Pa");
        faults.require(
            (0.0..1.0).contains(&bearing.hardening),
            format!("{text}.bearing_hardening"),
            || {
                format!(
                    "must be at least 0 and less than 1, found {}",
                    bearing.hardening
                )
            },
        );
    }
}

/// Most contact springs of a foundation.
const MOST_SPRINGS: usize = 200;
/// Most contact springs of a foundation in plan.
const MOST_IN_PLAN: usize = 2000;

/// Faults of the soil, and of foundations beside each other.
pub(super) fn check_soil(faults: &mut Faults, model: &Model) {
    let foundation = |index: usize| model.buildings[index].base.foundation;
    let all = (0..model.buildings.len()).filter(|&index| foundation(index).is_some());
    let all: Vec<usize> = all.collect();
    let lifts = |index: usize| foundation(index).and_then(|foundation| foundation.uplift);
    let has_springs = |index: usize| lifts(index).is_some_and(|lift| lift.ground.is_some());
    let founded = all.iter().copied().filter(|index| !has_springs(*index));
    let founded: Vec<usize> = founded.collect();
    let can_step = match model.analysis.solver {
        None | Some(Solver::Riccati | Solver::Stiffness) => true,
        Some(Solver::Product | Solver::Modal | Solver::Series) => false,
    };
    faults.require(
        can_step || all.is_empty(),
        "analysis.solver",
        || "cannot step buildings on foundations: take \"riccati\" or \"stiffness\", or leave it out".into(),
    );
    let Some(soil) = &model.soil else {
        for index in founded {
            let remedy = match lifts(index) {
                Some(_) => {
                    "needs [soil] or springs of its own: add vertical_stiffness, or [soil] with shear_wave_velocity, density and poisson_ratio"
                }
                None => "needs [soil]: add its shear_wave_velocity, density and poisson_ratio",
            };
            faults.add(format!("building[{index}].foundation"), remedy);
        }
        return;
    };
    for index in all.into_iter().filter(|index| lifts(*index).is_some()) {
        faults.require(
            soil.coupling == SoilCoupling::None,
            format!("building[{index}].foundation"),
            || {
                "cannot lift off where foundations act on each other; leave out coupling, or uplift"
                    .into()
            },
        );
    }
    let in_plan = |index: usize| matches!(model.buildings[index].structure, Structure::Tiers(_));
    for index in founded.iter().copied().filter(|index| in_plan(*index)) {
        faults.require(soil.coupling == SoilCoupling::None, "soil.coupling", || {
            format!(
                "is for foundations in one plane, and \"{}\" has a plan: leave coupling out",
                model.buildings[index].name
            )
        });
    }
    faults.require(!founded.is_empty(), "soil", || {
        "carries no foundation: give a building a foundation, or leave out [soil]".into()
    });
    if let Some(ground) = &soil.half_space {
        faults.positive(
            ground.shear_wave_velocity,
            "soil.shear_wave_velocity",
            "m/s",
        );
        faults.positive(ground.density, "soil.density", "kg/m3");
        faults.require(
            (0.0..0.5).contains(&ground.poisson_ratio),
            "soil.poisson_ratio",
            || {
                format!(
                    "must be at least 0 and less than 0.5, found {}; saturated soil has about 0.45 to 0.49",
                    ground.poisson_ratio
                )
            },
        );
        faults.require((0.0..1.0).contains(&ground.damping), "soil.damping", || {
            format!(
                "must lie between 0 and 1 (0.05 is 5 %), found {}",
                ground.damping
            )
        });
    }
    for left in 0..model.buildings.len().saturating_sub(1) {
        let neighbours = [left, left + 1].map(|index| model.buildings[index].base.foundation);
        if let ([Some(_), Some(_)], Ok(distance)) = (neighbours, model.between_foundations(left)) {
            faults.require(
                distance >= 0.0 || distance.is_nan(),
                format!("building[{}].foundation.length", left + 1),
                || {
                    format!(
                        "overlaps the foundation of \"{}\" by {:.3} m: foundations are centred below their buildings",
                        model.buildings[left].name, -distance
                    )
                },
            );
        }
    }
    match &soil.coupling {
        SoilCoupling::None => need_half_space(faults, model),
        SoilCoupling::Static => {
            need_half_space(faults, model);
            check_static(faults, model, &founded);
        }
        SoilCoupling::Given { stiffness, damping } => {
            for (name, matrix, least) in
                [("stiffness", stiffness, SAME), ("damping", damping, -SAME)]
            {
                check_matrix(
                    faults,
                    &format!("soil.coupling.{name}"),
                    matrix,
                    2 * founded.len(),
                    least,
                );
            }
        }
    }
    if soil.coupling != SoilCoupling::None {
        for index in founded {
            faults.require(
                !model.buildings[index].gravity.preload,
                format!("building[{index}].gravity"),
                || "is not possible where foundations act on each other; leave out gravity, or coupling".into(),
            );
        }
    }
}

fn need_half_space(faults: &mut Faults, model: &Model) {
    let known = model
        .soil
        .as_ref()
        .is_some_and(|soil| soil.half_space.is_some());
    faults.require(known, "soil", || {
        "needs shear_wave_velocity, density and poisson_ratio, unless coupling gives matrices"
            .into()
    });
}

/// Static coupling is that of foundations on the surface, a known distance apart.
fn check_static(faults: &mut Faults, model: &Model, founded: &[usize]) {
    faults.require(founded.len() > 1, "soil.coupling", || {
        "\"static\" needs two foundations; leave it out".into()
    });
    for &index in founded {
        let embedment = model.buildings[index]
            .base
            .foundation
            .map(|foundation| foundation.embedment);
        faults.require(
            embedment.is_none_or(|depth| depth == 0.0),
            format!("building[{index}].foundation.embedment"),
            || "must be 0 where coupling = \"static\": the flexibility between foundations is that of the surface".into(),
        );
    }
    let (Some(&first), Some(&last)) = (founded.first(), founded.last()) else {
        return;
    };
    for left in first..last {
        match model.between_foundations(left) {
            Ok(distance) => faults.require(distance != 0.0, "soil.coupling", || {
                format!(
                    "\"static\" needs a clear distance between foundations; those of \"{}\" and \"{}\" touch",
                    model.buildings[left].name,
                    model.buildings[left + 1].name
                )
            }),
            Err(problem) => faults.add("soil.coupling", problem),
        }
    }
}

/// Whether a matrix has the right size, is symmetric, and has eigenvalues of at least a part of its diagonal.
fn check_matrix(faults: &mut Faults, path: &str, matrix: &[Vec<f64>], size: usize, least: f64) {
    let square = matrix.len() == size && matrix.iter().all(|row| row.len() == size);
    if !square {
        let rows = matrix.len();
        faults.add(
            path,
            format!(
                "must have {size} rows of {size} numbers, for u and theta of every foundation from left to right; found {rows} rows"
            ),
        );
        return;
    }
    for (row, (field, entries)) in each(matrix, path).enumerate() {
        for (column, value) in entries.iter().enumerate() {
            if !value.is_finite() {
                faults.add(format!("{field}[{column}]"), "must be a finite number");
                return;
            }
            let other = matrix[column][row];
            let scale = (matrix[row][row].abs() * matrix[column][column].abs()).sqrt();
            if (value - other).abs() > SAME * scale.max(value.abs()) {
                faults.add(
                    format!("{field}[{column}]"),
                    format!("must equal the entry across the diagonal, {other}, found {value}: the matrix is not symmetric"),
                );
                return;
            }
        }
    }
    let definite = least > 0.0;
    let diagonal: Vec<f64> = (0..size).map(|row| matrix[row][row]).collect();
    let sound = |value: &f64| {
        if definite {
            *value > 0.0
        } else {
            *value >= 0.0
        }
    };
    if let Some(row) = diagonal.iter().position(|value| !sound(value)) {
        let wanted = if definite {
            "greater than zero"
        } else {
            "at least zero"
        };
        faults.add(
            format!("{path}[{row}][{row}]"),
            format!("must be {wanted}, found {}", diagonal[row]),
        );
        return;
    }
    let lower: Vec<Vec<f64>> = (0..size)
        .map(|row| {
            let scaled = |column: usize| {
                let scale = (diagonal[row] * diagonal[column]).sqrt();
                match scale > 0.0 {
                    true => matrix[row][column] / scale,
                    false => matrix[row][column],
                }
            };
            (0..=row).map(scaled).collect()
        })
        .collect();
    let (values, _) = symmetric::eigen(&lower);
    let smallest = values.iter().copied().fold(f64::INFINITY, f64::min);
    if smallest.is_nan() || smallest < least {
        let wanted = if definite {
            "positive definite"
        } else {
            "positive semidefinite"
        };
        faults.add(
            path,
            format!(
                "is not {wanted}: scaled to a diagonal of ones, its smallest eigenvalue is {smallest:.3}; entries between foundations must not exceed those of each"
            ),
        );
    }
}
