//! Nonlinear statics of one building: self weight, and pushover to collapse.
//!
//! Springs that yield are linear between corners, so the building is linear from one corner to the next. [`EquilibriumPath`]
//! goes from corner to corner and ends exactly at each: no step size, no equilibrium iteration (theory, Eqs. X1 to
//! X4).

mod equilibrium_path;
mod gravity;
mod members_at_rest;
mod stiffness_at;

pub use crate::model::STANDARD_GRAVITY;
pub use equilibrium_path::{EquilibriumPath, PathError, Reached};
pub use gravity::{Collapse, compressions, static_displacement, under_gravity};
pub use members_at_rest::compressions_of_members;
pub use stiffness_at::stiffness_at;

use crate::hysteresis::HysteresisMemory;
use crate::structure::AssembledBuilding;

/// A building under its own weight.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Settled {
    /// Displacement of every degree of freedom \[m, rad\].
    pub displacement: Vec<f64>,
    /// State of the springs that yield.
    pub springs: Vec<HysteresisMemory>,
}

/// Applies the self weight of a building gradually, `gravity` ≥ 0 \[m/s²\]; hinges may crack and yield.
///
/// # Errors
/// [`PathError`] when the building cannot carry it.
pub fn settle(building: &AssembledBuilding, gravity: f64) -> Result<Settled, PathError> {
    let weight = building.equations.weighing_mass.iter();
    let pattern = weight.map(|mass| -mass * gravity).collect();
    let mut path = EquilibriumPath::loaded(building, pattern);
    while path.load() < 1.0 {
        path.find_rates()?;
        path.advance((1.0 - path.load()) / path.load_rate())?;
    }
    Ok(Settled {
        displacement: path.displacement().to_vec(),
        springs: path.memories().to_vec(),
    })
}
