//! Capacity curves of a model as JSON.

use jostle::System;
use jostle::pushover::{
    LoadPattern, PushDirection, PushSettings, PushedBuilding, Pushover, pushover as push,
};
use jostle::system::BuildingSystem;

use crate::error::RunError;

/// Capacity curves of one building or of all, as the JSON of `jostle pushover`.
///
/// # Errors
/// [`RunError::Argument`] with the name of the option first, [`RunError::Analysis`] if the modes of a building are not found.
pub fn pushover_json(
    title: &str,
    system: &System,
    building: Option<&str>,
    pattern: &str,
    direction: &str,
    drift: f64,
) -> Result<String, RunError> {
    let drift = checked_drift(drift, &drift.to_string())?;
    let buildings = chosen_buildings(system.structures(), building)?;
    let pattern = match pattern {
        "first-mode" => LoadPattern::FirstMode,
        "uniform" => LoadPattern::Uniform,
        "triangular" => LoadPattern::Triangular,
        other => {
            return Err(RunError::Argument(format!(
                "--pattern: expected first-mode, uniform or triangular, found \"{other}\""
            )));
        }
    };
    let directions: &[PushDirection] = match direction {
        "right" => &[PushDirection::Right],
        "left" => &[PushDirection::Left],
        "both" => &[PushDirection::Right, PushDirection::Left],
        other => {
            return Err(RunError::Argument(format!(
                "--direction: expected right, left or both, found \"{other}\""
            )));
        }
    };
    let pushed = pushed_buildings(&buildings, directions, pattern, drift)?;
    Ok(jostle_io::pushover_json(title, &pushed))
}

/// Pushes buildings in every direction given, to a roof displacement of `drift` times the height.
///
/// # Errors
/// [`RunError::Analysis`] with the name of the building.
pub fn pushed_buildings<'a>(
    buildings: &[&'a BuildingSystem],
    directions: &[PushDirection],
    pattern: LoadPattern,
    drift: f64,
) -> Result<Vec<PushedBuilding<'a>>, RunError> {
    let mut pushed = Vec::new();
    for &building in buildings {
        let curves = directions.iter().map(|&direction| {
            let settings = PushSettings {
                pattern,
                direction,
                drift,
            };
            push(building, settings)
        });
        let curves: Result<Vec<Pushover>, _> = curves.collect();
        pushed.push(PushedBuilding {
            building,
            curves: curves.map_err(|problem| {
                RunError::Analysis(format!("\"{}\": {problem}", building.name))
            })?,
        });
    }
    Ok(pushed)
}

/// A drift to push to, if it lies in its range; `text` is what was written for it.
///
/// # Errors
/// [`RunError::Argument`] with the name of the option first.
pub fn checked_drift(drift: f64, text: &str) -> Result<f64, RunError> {
    if drift > 0.0 && drift <= 0.5 {
        Ok(drift)
    } else {
        Err(RunError::Argument(format!(
            "--drift: must lie above 0 and be at most 0.5 (the roof displacement over the height), found {text}"
        )))
    }
}

/// The building of a name, or all.
///
/// # Errors
/// [`RunError::Argument`] with the names that there are.
pub fn chosen_buildings<'a>(
    buildings: &'a [BuildingSystem],
    name: Option<&str>,
) -> Result<Vec<&'a BuildingSystem>, RunError> {
    let Some(name) = name else {
        return Ok(buildings.iter().collect());
    };
    let found = buildings.iter().find(|building| building.name == name);
    found.map(|building| vec![building]).ok_or_else(|| {
        let names = buildings
            .iter()
            .map(|building| format!("\"{}\"", building.name));
        let names: Vec<String> = names.collect();
        RunError::Argument(format!(
            "--building: there is no building \"{name}\" in the model; it has {}",
            names.join(", ")
        ))
    })
}
