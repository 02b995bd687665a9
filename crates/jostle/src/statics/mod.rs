//! Statics of one building: under its weight, and along its equilibrium path.
//!
//! Springs that yield are straight between corners, so the building is linear from one corner to the next. [`EquilibriumPath`]
//! goes from corner to corner and lands on each: no step size, no iteration for equilibrium (theory, Eqs. X1 to X4).

mod equilibrium_path;
mod gravity;

pub use equilibrium_path::{EquilibriumPath, PathError, Reached};
pub use gravity::{Collapse, STANDARD_GRAVITY, compressions, static_displacement, under_gravity};

use crate::hysteresis::HysteresisMemory;
use crate::structure::AssembledBuilding;

/// A building under its own weight.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Settled {
    /// Displacement of every degree of freedom \[m, rad\].
    pub displacement: Vec<f64>,
    /// What springs that yield remember.
    pub springs: Vec<HysteresisMemory>,
}

/// Lets the weight of a building come on gradually, `gravity` ≥ 0 \[m/s²\]; hinges may crack and yield meanwhile.
///
/// # Errors
/// [`PathError`] when the building cannot carry it.
pub fn settle(building: &AssembledBuilding, gravity: f64) -> Result<Settled, PathError> {
    let weight = building.equations.vertical_mass.iter();
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
