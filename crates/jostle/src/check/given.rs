//! Faults of a building given by matrices.

use super::{Faults, each};
use crate::linear::cholesky::Cholesky;
use crate::model::{Base, Building, Given};

/// Greatest difference of two entries that should be equal, as a share of the greatest entry.
const SYMMETRY: f64 = 1e-9;

pub(super) fn check_given(faults: &mut Faults, path: &str, given: &Given, building: &Building) {
    let floors = given.mass.len();
    faults.require(floors >= 1, format!("{path}.mass"), || {
        "a building given by matrices needs at least one floor".into()
    });
    let heights = given.storey_heights.len();
    faults.require(heights == floors, format!("{path}.storey_height"), || {
        format!("has {heights} entries for {floors} floors; give one per storey from the ground up")
    });
    for (field, mass) in each(&given.mass, &format!("{path}.mass")) {
        faults.positive(*mass, field, "kg");
    }
    if let Err(problem) = check_stiffness(&given.stiffness, floors) {
        faults.add(format!("{path}.stiffness"), problem);
    }
    faults.require(
        building.base == Base::default(),
        format!("{path}.base"),
        || "is not possible for a building given by matrices; make the base part of its stiffness matrix".into(),
    );
    for (key, asked) in [
        ("gravity", building.gravity.preload),
        ("p_delta", building.gravity.p_delta),
    ] {
        faults.require(!asked, format!("{path}.{key}"), || {
            "is not possible for a building given by matrices; make P-Delta part of its stiffness matrix".into()
        });
    }
}

/// What is wrong with a stiffness matrix; rows and columns count from 1, as floors do.
fn check_stiffness(rows: &[Vec<f64>], floors: usize) -> Result<(), String> {
    if rows.len() != floors {
        return Err(format!(
            "has {} rows for {floors} floors; condense the matrix at the floors",
            rows.len()
        ));
    }
    let mut greatest = 0.0_f64;
    for (i, row) in rows.iter().enumerate() {
        if row.len() != floors {
            return Err(format!(
                "has {} entries in row {} for {floors} floors; the matrix must be square",
                row.len(),
                i + 1
            ));
        }
        for (j, entry) in row.iter().enumerate() {
            if !entry.is_finite() {
                return Err(format!(
                    "must be finite, found {entry} in row {}, column {}",
                    i + 1,
                    j + 1
                ));
            }
            greatest = greatest.max(entry.abs());
        }
    }
    for (i, row) in rows.iter().enumerate() {
        for (j, entry) in row[..i].iter().enumerate() {
            let mirrored = rows[j][i];
            if (entry - mirrored).abs() > SYMMETRY * greatest {
                let (i, j) = (i + 1, j + 1);
                return Err(format!(
                    "must be symmetric, found {entry:e} N/m in row {i}, column {j} and {mirrored:e} N/m in row {j}, column {i}"
                ));
            }
        }
    }
    let lower = rows.iter().enumerate();
    let lower = lower.map(|(i, row)| row[..=i].to_vec()).collect();
    match Cholesky::new(lower) {
        Some(_) => Ok(()),
        None => Err(
            "must be positive definite: some displacement of the floors meets no resistance; hold the base of the model before its matrix is condensed".into(),
        ),
    }
}
