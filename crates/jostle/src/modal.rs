//! Natural modes of a building.

use std::f64::consts::PI;

use faer::{Mat, Side};

use crate::stepping::{NotPositive, StepEquations};
use crate::system::BuildingSystem;
use crate::transfer::riccati::{RiccatiFactor, RiccatiSweep};

/// A mode counts as lateral from this share of the horizontal effective mass on \[–\].
pub const LATERAL_SHARE: f64 = 0.01;

/// One natural mode.
#[derive(Clone, Debug, PartialEq)]
pub struct Mode {
    /// Circular frequency ω \[rad/s\].
    pub circular_frequency: f64,
    /// Share of the vibrating mass that the mode carries horizontally \[–\].
    pub effective_mass_ratio_x: f64,
    /// Share of the vibrating mass that the mode carries vertically \[–\].
    pub effective_mass_ratio_y: f64,
    /// Horizontal participation factor φᵀM r, for the mass-normalised shape \[kg^½\].
    pub participation: f64,
    /// Mass-normalised shape φ (φᵀMφ = 1) at the floors, from the ground up \[kg^−½\].
    pub floors: Vec<f64>,
}

impl Mode {
    /// Period 2π/ω \[s\].
    #[must_use]
    pub fn period(&self) -> f64 {
        2.0 * PI / self.circular_frequency
    }

    /// Whether the mode is lateral: it carries at least 1 % of the mass horizontally.
    #[must_use]
    pub fn is_lateral(&self) -> bool {
        self.effective_mass_ratio_x >= LATERAL_SHARE
    }
}

/// All modes of a building, longest period first.
///
/// Through the flexibility of the massive degrees of freedom: M^½ (K⁻¹)_mm M^½ has the eigenvalues 1/ω²
/// (theory, Eq. M1), so that the lowest modes are the most accurate ones and massless rotations need no
/// condensation of their own.
///
/// # Errors
/// [`NotPositive`] when the building can move without deforming.
pub fn modes(building: &BuildingSystem) -> Result<Vec<Mode>, NotPositive> {
    let equations = &building.equations;
    let sweep = RiccatiSweep::of(building);
    let mut factor = RiccatiFactor::default();
    sweep.factorize(1.0, 0.0, &mut factor)?;
    let massive: Vec<usize> = (0..equations.len())
        .filter(|&dof| equations.mass[dof] > 0.0)
        .collect();
    let root: Vec<f64> = massive
        .iter()
        .map(|&dof| equations.mass[dof].sqrt())
        .collect();
    let mut flexibility = Mat::zeros(massive.len(), massive.len());
    let mut column = vec![0.0; equations.len()];
    for (j, &dof) in massive.iter().enumerate() {
        column.fill(0.0);
        column[dof] = root[j];
        sweep.solve(&factor, &mut column);
        for (i, &row) in massive.iter().enumerate().skip(j) {
            flexibility[(i, j)] = root[i] * column[row];
        }
    }
    let eigen = flexibility
        .self_adjoint_eigen(Side::Lower)
        .map_err(|_| NotPositive { dof: 0 })?;
    let total = equations.total_mass();
    let shapes = (0..massive.len()).rev().map(|k| {
        let mut shape = vec![0.0; equations.len()];
        for (i, &dof) in massive.iter().enumerate() {
            shape[dof] = eigen.U()[(i, k)] / root[i];
        }
        let carried = |mass: &[f64]| shape.iter().zip(mass).map(|(s, m)| s * m).sum::<f64>();
        let (x, y) = (
            carried(&equations.driven_mass),
            carried(&equations.vertical_mass),
        );
        // The sign in which the mode sways to the right with the ground.
        let sign = if x < 0.0 { -1.0 } else { 1.0 };
        Mode {
            circular_frequency: 1.0 / eigen.S()[k].sqrt(),
            effective_mass_ratio_x: x * x / total,
            effective_mass_ratio_y: y * y / total,
            participation: sign * x,
            floors: building
                .floors
                .iter()
                .map(|floor| sign * shape[floor.dof - building.offset])
                .collect(),
        }
    });
    Ok(shapes
        .filter(|mode| mode.circular_frequency.is_finite() && mode.circular_frequency > 0.0)
        .collect())
}
