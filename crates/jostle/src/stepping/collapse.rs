//! When a building that yields has collapsed.

use super::outcome::StepError;
use super::plan_drifts::PlanDrifts;
use super::runner::RunState;
use crate::history::FloorPeaks;

/// Looks at the drifts so far of a run, building by building, in space at the corners as well. Elastic buildings may lean as far as they like:
/// their numbers are those of their model.
///
/// # Errors
/// [`StepError::Collapse`] with the first building that has collapsed by now.
pub(super) fn check_collapse(
    run: &RunState<'_>,
    floors: &[Vec<FloorPeaks>],
    in_plan: &[PlanDrifts],
) -> Result<(), StepError> {
    for (index, (building, floors)) in run.system.buildings.iter().zip(floors).enumerate() {
        if building.equations.springs.is_empty() {
            continue;
        }
        // Along x, and across in space; rotations have no drift ratio.
        let count = building.floors.len();
        let storeys = floors.iter().take(2 * count).enumerate();
        let storeys = storeys.map(|(storey, peaks)| (storey % count, peaks.storey_drift));
        let corners = in_plan.get(index).into_iter().flat_map(PlanDrifts::corners);
        let all = storeys.chain(corners.enumerate());
        let worst = all.max_by(|a, b| a.1.total_cmp(&b.1));
        if let Some((storey, drift)) = worst.filter(|(_, drift)| *drift > run.plan.collapse_drift) {
            return Err(StepError::Collapse {
                building: building.name.clone(),
                storey: storey + 1,
                drift,
                time: run.time,
            });
        }
    }
    Ok(())
}
