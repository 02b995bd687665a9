//! B2 and B8: drifts of storeys, at their peak and at the end.

use super::record::lost;
use super::yielding::structure_yields;
use super::{Known, Tally};
use crate::results::summary::Summary;

/// Greatest drift of storeys, in space at corners as well.
pub(super) fn peak(known: &Known<'_>, tally: &mut Tally<'_>) {
    let Some((summary, _)) = known.results else {
        return;
    };
    for building in &summary.buildings {
        for floor in &building.floors {
            let drift = floor.greatest_drift();
            tally.add(drift, || {
                let place = format!("{}, storey {}", building.name, floor.floor);
                let beyond = match drift > super::table::OUTSIDE_DRIFT {
                    true => {
                        ": outside the model, which assumes small displacements and no strength loss"
                    }
                    false => "",
                };
                let text = format!("{place}: a drift of {:.1} %{beyond}", 100.0 * drift);
                (place, text)
            });
        }
    }
}

/// Share of the Arias intensity after the end beyond which a drift is that of a building in motion \[–\].
const SHAKING_AFTER: f64 = 0.25;

/// Drift at the end of buildings that yield; elastic ones are still swinging, and so are all in a run that ended early or cut its record.
pub(super) fn residual(known: &Known<'_>, tally: &mut Tally<'_>) {
    if lost(known) > SHAKING_AFTER {
        return;
    }
    let complete = |(summary, _): &(&Summary, _)| summary.ended_early.is_none();
    let Some((summary, _)) = known.results.filter(complete) else {
        return;
    };
    for (model, building) in known.model.buildings.iter().zip(&summary.buildings) {
        if !structure_yields(model) {
            continue;
        }
        for floor in &building.floors {
            let drift = floor.response.residual_drift.abs();
            tally.add(drift, || {
                let place = format!("{}, storey {}", building.name, floor.floor);
                let text = format!("{place}: the residual drift is {:.2} %", 100.0 * drift);
                (place, text)
            });
        }
    }
}
