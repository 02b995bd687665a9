//! When a building that yields has collapsed.

use super::outcome::StepError;
use super::runner::RunState;

/// Looks at the drift ratios so far of a run, those of a building with the storeys, from 0. Elastic buildings may lean as far as they like:
/// their numbers are those of their model.
///
/// # Errors
/// [`StepError::Collapse`] with the first building that has collapsed by now.
pub(super) fn check_collapse<D: Iterator<Item = (usize, f64)>>(
    run: &RunState<'_>,
    drifts: impl Fn(usize) -> D,
) -> Result<(), StepError> {
    for (index, building) in run.system.buildings.iter().enumerate() {
        if building.equations.springs.is_empty() {
            continue;
        }
        let worst = drifts(index).max_by(|a, b| a.1.total_cmp(&b.1));
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
