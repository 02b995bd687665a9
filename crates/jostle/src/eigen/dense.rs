//! All modes from an eigenvalue solver for full matrices, an independent check.

use super::Mode;
use super::lateral::Flexibility;
use crate::linear::NotPositive;
use crate::linear::sort_by;
use crate::structure::AssembledBuilding;
use crate::structure::StepEquations;
use crate::transfer::riccati::RiccatiSweep;

/// All modes of a building, longest period first, from an eigenvalue solver for full symmetric matrices, such as that
/// of a library.
///
/// `eigen` is given the rows of the lower triangle and returns the eigenvalues with their eigenvectors, in any order,
/// or `None` if it fails.
///
/// M^½ (K⁻¹)_mm M^½ has the eigenvalues 1/ω² (theory, Eq. M1), so that the lowest modes are the most accurate ones.
/// Its cost grows with the cube of the number of masses. For a double frequency the shapes are those of the solver.
///
/// # Errors
/// [`NotPositive`] when the building can move without deforming, or `eigen` fails.
pub fn modes_dense(
    building: &AssembledBuilding,
    eigen: impl FnOnce(&[Vec<f64>]) -> Option<Vec<(f64, Vec<f64>)>>,
) -> Result<Vec<Mode>, NotPositive> {
    let sweep = RiccatiSweep::new(building);
    let mut flexibility = Flexibility::along(building, &sweep)?;
    let n = flexibility.len();
    if n == 0 {
        return Ok(Vec::new());
    }
    let mut lower: Vec<Vec<f64>> = (0..n).map(|i| vec![0.0; i + 1]).collect();
    for j in 0..n {
        let column = flexibility.column(j);
        for i in j..n {
            lower[i][j] = column[i];
        }
    }
    let mut pairs = eigen(&lower).ok_or(NotPositive { dof: 0 })?;
    pairs.retain(|(value, _)| *value > 0.0);
    sort_by(&mut pairs, |a, b| b.0.total_cmp(&a.0));
    let modes = pairs.into_iter().map(|(value, shape)| {
        let shape = flexibility.with_massless(&shape, value);
        Mode::new(building, 1.0 / value, shape)
    });
    Ok(modes.collect())
}
