//! All modes at once from a library, the independent check.

use faer::{Mat, Side};

use super::Mode;
use super::lateral::Flexibility;
use crate::stepping::{NotPositive, StepEquations};
use crate::system::BuildingSystem;
use crate::transfer::riccati::RiccatiSweep;

/// All modes of a building, longest period first, from a dense eigenvalue solver.
///
/// M^½ (K⁻¹)_mm M^½ has the eigenvalues 1/ω² (theory, Eq. M1), so that the lowest modes are the most accurate
/// ones. Its cost grows with the cube of the number of masses. Within a double frequency the shapes are whatever
/// the library returns.
///
/// # Errors
/// [`NotPositive`] when the building can move without deforming.
pub fn modes_dense(building: &BuildingSystem) -> Result<Vec<Mode>, NotPositive> {
    let sweep = RiccatiSweep::of(building);
    let mut flexibility = Flexibility::along(building, &sweep)?;
    let n = flexibility.len();
    if n == 0 {
        return Ok(Vec::new());
    }
    let mut matrix = Mat::zeros(n, n);
    for j in 0..n {
        let column = flexibility.column(j);
        for i in j..n {
            matrix[(i, j)] = column[i];
        }
    }
    let eigen = matrix
        .self_adjoint_eigen(Side::Lower)
        .map_err(|_| NotPositive { dof: 0 })?;
    let mut modes = Vec::new();
    for k in (0..n).rev() {
        let shape: Vec<f64> = (0..n).map(|i| eigen.U()[(i, k)]).collect();
        if eigen.S()[k] > 0.0 {
            let shape = flexibility.with_massless(&shape, eigen.S()[k]);
            modes.push(Mode::of(building, 1.0 / eigen.S()[k], shape));
        }
    }
    Ok(modes)
}
