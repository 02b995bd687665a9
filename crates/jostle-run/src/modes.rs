//! Natural modes as JSON.

use jostle::System;
use jostle::eigen::{self, Mode};
use jostle::system::BuildingSystem;
use serde_json::{Value, json};

use crate::error::RunError;

/// Buildings with their modes, from the longest period down.
pub type ListedModes<'a> = Vec<(&'a BuildingSystem, Vec<Mode>)>;

/// Up to `count` modes of every building.
///
/// # Errors
/// Names the building whose modes were not found, and why.
pub fn list_modes(system: &System, count: usize) -> Result<ListedModes<'_>, RunError> {
    let modes = system.structures().iter().map(|building| {
        let modes = eigen::modes(building.alone(), count).map_err(|problem| {
            RunError::Analysis(format!("no modes of \"{}\": {problem}", building.name))
        })?;
        Ok((building, modes))
    });
    modes.collect()
}

/// The JSON of `jostle modes`: listed modes, and as many lateral periods.
#[must_use]
pub fn modes_json(listed: &ListedModes<'_>, count: usize) -> Value {
    let buildings: Vec<Value> = listed
        .iter()
        .map(|(building, modes)| as_json(building, modes, count))
        .collect();
    json!({ "buildings": buildings })
}

fn as_json(building: &BuildingSystem, modes: &[Mode], count: usize) -> Value {
    let mode = |mode: &Mode| {
        json!({
            "period_s": mode.period(),
            "circular_frequency_rad_s": mode.circular_frequency,
            "effective_mass_ratio_x": mode.effective_mass_ratio_x,
            "effective_mass_ratio_y": mode.effective_mass_ratio_y,
            "effective_mass_ratio_across": mode.effective_mass_ratio_across,
            "effective_mass_ratio_torsion": mode.effective_mass_ratio_torsion,
            "lateral": mode.is_lateral(),
            "floor_shape": floor_shape(mode),
        })
    };
    json!({
        "name": building.name,
        "periods_s": building.lateral_modes().take(count).map(Mode::period).collect::<Vec<_>>(),
        "modes": modes.iter().map(mode).collect::<Vec<_>>(),
    })
}

/// Horizontal shape at the floors from the ground up, scaled so that the floor that moves most moves by ±1.
#[must_use]
pub fn floor_shape(mode: &Mode) -> Vec<f64> {
    let largest = mode.floors.iter().fold(0.0_f64, |largest, value| {
        if value.abs() > largest.abs() {
            *value
        } else {
            largest
        }
    });
    let scale = if largest == 0.0 {
        0.0
    } else {
        1.0 / largest.abs()
    };
    mode.floors.iter().map(|value| value * scale).collect()
}
