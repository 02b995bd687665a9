//! Faults of a building given by matrices.

use super::{Faults, each};
use crate::linear::sparse_cholesky::{NoPivot, Pattern, SparseFactor};
use crate::model::{Base, Building, Given, MatrixEntry, Tiers, displacement_in_words};

const MOST: usize = Given::MOST_DISPLACEMENTS;

pub(super) fn check_given(faults: &mut Faults, path: &str, given: &Given, building: &Building) {
    let n = given.len();
    let at = |field: &str| format!("{path}.{field}");
    faults.require((1..=MOST).contains(&n), at("matrices"), || {
        format!(
            "has {n} displacements; between 1 and {MOST} are possible: condense the model at fewer"
        )
    });
    let floors = given.floors.len();
    faults.require(floors >= 1, at("ports"), || {
        "a building given by matrices needs at least one floor".into()
    });
    let heights = given.storey_heights.len();
    faults.require(heights == floors, at("storey_height"), || {
        format!("has {heights} entries for {floors} floors; give one per storey from the ground up")
    });
    for (what, count) in [
        ("influence", given.influence.len()),
        ("heights", given.heights.len()),
    ] {
        faults.require(count == n, at("matrices"), || {
            format!("there are {what} for {count} displacements, but masses for {n}")
        });
    }
    for (field, mass) in each(&given.mass, &at("mass")) {
        faults.require(mass.is_finite() && *mass >= 0.0, field, || {
            format!("must be zero or greater, found {mass} kg")
        });
    }
    for value in given.influence.iter().chain(&given.heights) {
        faults.require(value.is_finite(), at("matrices"), || {
            format!("influence and heights must be finite, found {value}")
        });
    }
    if given.influence.len() == n && given.heights.len() == n {
        check_floors(faults, path, given);
    }
    match check_matrix(&given.stiffness, n) {
        Err(problem) => faults.add(at("stiffness"), problem),
        Ok(()) if (1..=MOST).contains(&n) => check_definite(faults, at("stiffness"), given),
        Ok(()) => {}
    }
    match check_matrix(&given.damping, n) {
        Err(problem) => faults.add(at("damping"), problem),
        Ok(()) => check_dissipates(faults, at("damping"), &given.damping, n),
    }
    let base = Base {
        elevation: 0.0,
        ..building.base
    };
    faults.require(base == Base::default(), at("base"), || {
        "is not possible for a building given by matrices; make the base part of its stiffness matrix".into()
    });
    check_gravity(faults, path, building);
}

fn check_gravity(faults: &mut Faults, path: &str, building: &Building) {
    for (key, asked) in [
        ("gravity", building.gravity.preload),
        ("p_delta", building.gravity.p_delta),
    ] {
        faults.require(!asked, format!("{path}.{key}"), || {
            "is not possible for a building given by matrices; make P-Delta part of its stiffness matrix".into()
        });
    }
}

/// Matrices over the floors of a building in plan.
pub(super) fn check_floor_matrices(
    faults: &mut Faults,
    path: &str,
    tiers: &Tiers,
    building: &Building,
) {
    let Some(matrices) = &tiers.matrices else {
        return;
    };
    let n = 3 * tiers.floors.len();
    let at = |field: &str| format!("{path}.{field}");
    faults.require((1..=MOST).contains(&n), at("matrices"), || {
        format!(
            "has {n} displacements of floors; between 3 and {MOST} are possible: leave out floors"
        )
    });
    let before = faults.0.len();
    for (field, rows) in [
        ("stiffness", &matrices.stiffness),
        ("damping", &matrices.damping),
    ] {
        let none = field == "damping" && rows.is_empty();
        let fits = rows.len() == n
            && rows
                .iter()
                .enumerate()
                .all(|(row, candidate)| candidate.len() == row + 1);
        faults.require(fits || none, at(field), || {
            format!("needs the lower triangle of a matrix of {n} rows, three for each floor")
        });
        let mut values = rows.iter().flatten();
        faults.require(values.all(|value| value.is_finite()), at(field), || {
            "must be finite".into()
        });
    }
    if faults.0.len() == before {
        let rows = matrices.damping.iter().enumerate();
        let entries = rows.flat_map(|(row, values)| {
            let columns = values.iter().enumerate();
            columns.map(move |(column, &value)| (row, column, value))
        });
        let entries: Vec<MatrixEntry> = entries.collect();
        check_dissipates(faults, at("damping"), &entries, n);
    }
    if faults.0.len() == before
        && let Some(place) = matrices.loose()
    {
        faults.add(
            at("stiffness"),
            format!(
                "must be positive definite: {} can move without resistance; hold the base of the model before its matrices are written, and check signs and units of rotations",
                displacement_in_words(place)
            ),
        );
    }
    check_gravity(faults, path, building);
}

fn check_floors(faults: &mut Faults, path: &str, given: &Given) {
    let mut height = 0.0;
    for (index, (&dof, storey)) in given.floors.iter().zip(&given.storey_heights).enumerate() {
        let floor = index + 1;
        height += storey;
        let field = || format!("{path}.ports");
        if dof >= given.len() {
            faults.add(
                field(),
                format!(
                    "floor {floor} is displacement {}, of {}",
                    dof + 1,
                    given.len()
                ),
            );
            continue;
        }
        faults.require(!given.floors[..index].contains(&dof), field(), || {
            format!(
                "floor {floor} is displacement {}, as a floor below it is",
                dof + 1
            )
        });
        faults.require(given.influence[dof] == 1.0, field(), || {
            format!(
                "floor {floor} is displacement {}, which moves by {} when the ground moves by 1; a floor must move with the ground",
                dof + 1,
                given.influence[dof]
            )
        });
        faults.require(given.mass[dof] > 0.0, field(), || {
            format!("floor {floor} is displacement {}, which has no mass; a floor that can be hit needs mass", dof + 1)
        });
        faults.require((given.heights[dof] - height).abs() <= 1e-6 * height.abs(), field(), || {
            format!("floor {floor} is {height} m high by the storeys, and {} m by the heights of the displacements", given.heights[dof])
        });
    }
}

fn check_matrix(entries: &[MatrixEntry], n: usize) -> Result<(), String> {
    for &(row, column, value) in entries {
        if row >= n || column > row {
            return Err(format!(
                "has an entry in row {}, column {}; rows up to {n} and the lower triangle are possible",
                row + 1,
                column + 1
            ));
        }
        if !value.is_finite() {
            return Err(format!(
                "must be finite, found {value} in row {}, column {}",
                row + 1,
                column + 1
            ));
        }
    }
    Ok(())
}

/// A pivot of C may be below zero by this part of its greatest entry: rounding \[–\].
const ROUNDING: f64 = 1e-9;

/// A damping matrix that gains energy in some motion is a slip of sign or of units of its entries.
fn check_dissipates(faults: &mut Faults, path: String, damping: &[MatrixEntry], n: usize) {
    let greatest = damping
        .iter()
        .fold(0.0_f64, |most, damping| most.max(damping.2.abs()));
    if greatest == 0.0 || !(1..=MOST).contains(&n) {
        return;
    }
    let diagonal = (0..n).map(|dof| (dof, dof, ROUNDING * greatest));
    let entries: Vec<MatrixEntry> = damping.iter().copied().chain(diagonal).collect();
    let places: Vec<(usize, usize)> = entries.iter().map(|entry| (entry.0, entry.1)).collect();
    let pattern = Pattern::new(n, &places);
    let mut factor = SparseFactor::default();
    if let Err(NoPivot(dof)) = pattern.factorize(entries.iter().map(|entry| entry.2), &mut factor) {
        faults.add(
            path,
            format!(
                "must be positive semidefinite: displacement {} gains energy as it moves; check signs and units of its entries",
                dof + 1
            ),
        );
    }
}

fn check_definite(faults: &mut Faults, path: String, given: &Given) {
    // Rows without entries need a place on the diagonal.
    let diagonal = (0..given.len()).map(|dof| (dof, dof, 0.0));
    let entries: Vec<MatrixEntry> = given.stiffness.iter().copied().chain(diagonal).collect();
    let places: Vec<(usize, usize)> = entries.iter().map(|entry| (entry.0, entry.1)).collect();
    let pattern = Pattern::new(given.len(), &places);
    let mut factor = SparseFactor::default();
    if let Err(NoPivot(dof)) = pattern.factorize(entries.iter().map(|entry| entry.2), &mut factor) {
        faults.add(
            path,
            format!(
                "must be positive definite: displacement {} can move without resistance; hold the base of the model before its matrices are written, and leave out displacements without stiffness",
                dof + 1
            ),
        );
    }
}
