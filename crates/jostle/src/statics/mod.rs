//! Nonlinear statics of one building: under its weight, and pushed sideways to collapse.
//!
//! Springs that yield are straight between corners, so the building is linear from one corner to the next. [`Walk`]
//! goes from corner to corner and lands on each: no step size, no iteration for equilibrium (theory, Eqs. X1 to X4).

mod bilinear;
mod pattern;
mod pushover;
mod walk;

pub use bilinear::Bilinear;
pub use pattern::LoadPattern;
pub use pushover::{
    NothingToPush, PushDirection, PushEnd, PushEvent, PushEventKind, PushPoint, PushSettings,
    PushedBuilding, Pushover, pushover,
};
pub use walk::{Reached, Walk, WalkError};

use crate::hysteresis::HysteresisMemory;
use crate::system::BuildingSystem;

/// A building under its own weight.
#[derive(Clone, Debug, PartialEq)]
pub struct Settled {
    /// Displacement of every degree of freedom \[m, rad\].
    pub displacement: Vec<f64>,
    /// What springs that yield remember.
    pub springs: Vec<HysteresisMemory>,
}

/// Lets the weight of a building come on gradually, `gravity` ≥ 0 \[m/s²\]; hinges may crack and yield meanwhile.
///
/// # Errors
/// [`WalkError`] when the building cannot carry it.
pub fn settle(building: &BuildingSystem, gravity: f64) -> Result<Settled, WalkError> {
    let weight = building.equations.vertical_mass.iter();
    let pattern = weight.map(|mass| -mass * gravity).collect();
    let mut walk = Walk::loaded(building, pattern);
    while walk.load() < 1.0 {
        walk.find_rates()?;
        walk.advance((1.0 - walk.load()) / walk.load_rate())?;
    }
    Ok(Settled {
        displacement: walk.displacement().to_vec(),
        springs: walk.memories().to_vec(),
    })
}
