//! When a building that yields has collapsed.

use super::outcome::StepError;
use crate::history::FloorPeaks;
use crate::system::System;

/// Storey drift from which a building that yields or leans has collapsed \[–\].
const COLLAPSE_DRIFT: f64 = 0.25;

/// Looks at the drifts so far, building by building. Elastic buildings may lean as far as they like: their numbers are those of
/// their model.
///
/// # Errors
/// [`StepError::Collapse`] with the first building that has collapsed at `time` \[s\].
pub(super) fn check_collapse(
    system: &System,
    floors: &[Vec<FloorPeaks>],
    time: f64,
) -> Result<(), StepError> {
    for (building, floors) in system.buildings.iter().zip(floors) {
        if building.equations.springs.is_empty() {
            continue;
        }
        // Along x, and across in space; rotations have no drift ratio.
        let count = building.floors.len();
        let storeys = floors.iter().take(2 * count).enumerate();
        let worst = storeys.max_by(|a, b| a.1.storey_drift.total_cmp(&b.1.storey_drift));
        if let Some((storey, peaks)) = worst.filter(|(_, p)| p.storey_drift > COLLAPSE_DRIFT) {
            return Err(StepError::Collapse {
                building: building.name.clone(),
                storey: storey % count + 1,
                drift: peaks.storey_drift,
                time,
            });
        }
    }
    Ok(())
}
