//! Natural modes of a building.
//!
//! There are three methods. [`modes`] divides the spectrum by counting negative pivots of the Riccati recursion and
//! cannot miss a mode. [`lateral_modes`] computes only those excited by horizontal ground motion and is fast enough
//! for every assembly. [`modes_dense`] uses an eigenvalue solver for full matrices, as a check.

mod dense;
mod lateral;
mod slicing;
mod spectrum;
pub(crate) mod symmetric;
mod tridiagonal;

use std::f64::consts::PI;

use crate::structure::{AssembledBuilding, Equations};

pub use dense::modes_dense;
pub use lateral::lateral_modes;
pub(crate) use lateral::{lateral_modes_along, sway_modes, vertical_modes_along};
pub use slicing::modes;
pub use spectrum::{LogDeterminant, Spectrum, log_determinant, number_of_modes};

/// Least share of the horizontal effective mass of a lateral mode \[–\].
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
    /// Share of the vibrating mass that the mode carries across the row; 0 in one plane \[–\].
    pub effective_mass_ratio_across: f64,
    /// Share of the polar mass that turns with the mode; 0 in one plane \[–\].
    pub effective_mass_ratio_torsion: f64,
    /// Horizontal participation factor φᵀM r, for the mass-normalised shape \[kg^½\].
    pub participation: f64,
    /// Mass-normalised shape φ (φᵀMφ = 1) at the floors, from the ground up \[kg^−½\].
    pub floors: Vec<f64>,
    /// Mass-normalised shape at all degrees of freedom of the building, massless ones included \[kg^−½\].
    pub shape: Vec<f64>,
}

impl Mode {
    /// Period 2π/ω \[s\].
    #[must_use]
    pub fn period(&self) -> f64 {
        2.0 * PI / self.circular_frequency
    }

    /// Whether the mode is lateral: it carries at least 1 % of the mass horizontally, along x or across.
    #[must_use]
    pub fn is_lateral(&self) -> bool {
        self.effective_mass_ratio_x
            .max(self.effective_mass_ratio_across)
            >= LATERAL_SHARE
    }

    /// Whether it carries at least 1 % of the mass along the row.
    #[must_use]
    pub fn is_along(&self) -> bool {
        self.effective_mass_ratio_x >= LATERAL_SHARE
    }

    /// Whether half of its kinetic energy, or more, is that of displacements on which the ground acts through this driven mass \[kg\].
    pub(crate) fn moves_mostly(&self, equations: &Equations, driven: &[f64]) -> bool {
        let moved = equations.mass.iter().zip(driven).zip(&self.shape);
        let moved = moved.filter(|((_, driven), _)| **driven > 0.0);
        // Shapes have a mass of 1 kg.
        moved
            .map(|((mass, _), displacement)| mass * displacement * displacement)
            .sum::<f64>()
            >= 0.5
    }

    /// A mode from ω² and a shape of any scale.
    fn new(building: &AssembledBuilding, squared_frequency: f64, mut shape: Vec<f64>) -> Self {
        let equations = &building.equations;
        let along = |mass: &[f64]| mass.iter().zip(&shape).map(|(m, s)| m * s).sum::<f64>();
        let (x, y) = (
            along(&equations.driven_mass),
            along(&equations.vertical_mass),
        );
        let across = along(&equations.driven_across);
        let turning = along(&equations.driven_turning);
        // Sign: positive participation along x, or across where that is greater.
        let norm = inner(&equations.mass, &shape, &shape).sqrt();
        let sign = if across.abs() > x.abs() { across } else { x };
        let scale = if sign < 0.0 { -1.0 / norm } else { 1.0 / norm };
        for value in &mut shape {
            *value *= scale;
        }
        let (x, y, total) = (x * scale, y * scale, equations.total_mass());
        // Nothing of a building in one plane moves across or turns.
        let ratio = |participation: f64, moved: f64| match moved > 0.0 {
            true => (participation * scale).powi(2) / moved,
            false => 0.0,
        };
        Self {
            circular_frequency: squared_frequency.sqrt(),
            effective_mass_ratio_x: x * x / equations.moved_mass[0],
            effective_mass_ratio_y: y * y / total,
            effective_mass_ratio_across: ratio(across, equations.moved_mass[1]),
            effective_mass_ratio_torsion: ratio(turning, equations.polar_mass),
            participation: x,
            floors: building.floor_dofs.iter().map(|&dof| shape[dof]).collect(),
            shape,
        }
    }
}

/// aᵀ M b.
fn inner(mass: &[f64], a: &[f64], b: &[f64]) -> f64 {
    mass.iter().zip(a).zip(b).map(|((m, a), b)| m * a * b).sum()
}
