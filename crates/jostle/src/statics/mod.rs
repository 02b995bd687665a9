//! Nonlinear statics of one building: self weight, and pushover to collapse.
//!
//! Springs that yield are linear between corners, so the building is linear from one corner to the next. [`Walk`]
//! goes from corner to corner and ends exactly at each: no step size, no equilibrium iteration (theory, Eqs. X1 to
//! X4).

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
    /// State of the springs that yield.
    pub springs: Vec<HysteresisMemory>,
}

/// Applies the self weight of a building gradually, `gravity` ≥ 0 \[m/s²\]; hinges may crack and yield.
///
/// # Errors
/// [`WalkError`] if the building cannot carry it.
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
