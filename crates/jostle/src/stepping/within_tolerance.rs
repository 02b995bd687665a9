//! Direct runs at two step sizes, whose difference measures the error of every reported peak.

use std::ops::ControlFlow;

use super::direct::run_directly;
use super::outcome::{Accuracy, Outcome, Progress, RunEnd, Settings};
use super::peak_change::change_of_peaks;
use super::plan::Plan;
use crate::motion::GroundMotion;
use crate::state::State;
use crate::structure::StepEquations;
use crate::system::System;

/// Largest number of refinements.
const MOST_REFINEMENTS: u64 = 4;
/// Margin of the measured error: errors of single peaks fall less regularly than the square of the step.
const MARGIN: f64 = 1.5;
/// Fraction of the tolerance that refined steps aim at.
const AIM: f64 = 0.5;
/// Least and greatest factors by which steps are refined at a time.
const REFINEMENT: [f64; 2] = [1.4, 3.0];
/// Fraction of the error that may remain after a refinement; otherwise refinement stops.
const LEFT_OVER: f64 = 0.8;

/// Weight of the energy imbalance in the error of a peak.
const LOST: f64 = 0.25;

/// Contribution of rounding to the error: motion with the energy of the imbalance, relative to all motion \[–\].
///
/// Steps balance their energy exactly, apart from rounding. Very short steps lose digits, and two of them may lose
/// them alike.
fn rounding(outcome: &Outcome) -> f64 {
    LOST * outcome.energy.imbalance().sqrt()
}

/// Runs an elastic system with automatic steps twice, the second time with steps half as long, and refines them
/// further while the error of the finer run exceeds the tolerance. Other systems run once.
///
/// Average acceleration is of second order: where steps shrink by the factor r, the error of the finer run is the difference
/// of both over r² − 1 (L. F. Richardson, 1911, Phil. Trans. R. Soc. A 210, 307–357).
pub(super) fn within_tolerance<E: StepEquations>(
    system: &System,
    motion: &GroundMotion,
    plan: &Plan,
    settings: Settings,
    state: State,
    mut observer: impl FnMut(Progress) -> ControlFlow<()>,
) -> Outcome {
    let mut run = |plan: &Plan| {
        run_directly::<E>(system, motion, plan, settings, state.clone(), &mut observer)
    };
    if !plan.is_automatic(system, motion) || plan.frequency_error(system, motion).is_none() {
        return run(plan);
    }
    let mut fine = *plan;
    let coarser = plan.refined(0.5, motion);
    let mut coarse = if coarser.step > plan.step * (1.0 + 1e-9) {
        coarser
    } else {
        fine = plan.refined(2.0, motion);
        *plan
    };
    let mut before = run(&coarse);
    if before.end == RunEnd::Stopped {
        return before;
    }
    let mut last = f64::INFINITY;
    let mut refinements = 0;
    loop {
        let mut outcome = run(&fine);
        outcome.work.repeated_runs = refinements;
        if outcome.end != RunEnd::Completed {
            // If a refinement is stopped or fails, the previous run is kept.
            return if refinements > 0 { before } else { outcome };
        }
        let ratio = coarse.step / fine.step;
        let change = if before.end == RunEnd::Completed {
            change_of_peaks(system, [&before, &outcome])
        } else {
            1.0
        };
        let rounding = rounding(&outcome);
        let residual = MARGIN * change / (ratio * ratio - 1.0) + rounding;
        let tolerance = plan.tolerance();
        outcome.accuracy = Some(Accuracy {
            tolerance,
            residual,
            doubtful_from: None,
            sensitive_from: None,
        });
        let converges = residual < LEFT_OVER * last && rounding < AIM * tolerance;
        if residual <= tolerance || refinements == MOST_REFINEMENTS || !converges {
            return outcome;
        }
        let [least, most] = REFINEMENT;
        let wanted = (residual / (AIM * tolerance)).sqrt().clamp(least, most);
        let finer = fine.refined(wanted, motion);
        // The product of transfer matrices loses its digits at short steps.
        if finer.check_digits(system).is_err() {
            return outcome;
        }
        refinements += 1;
        last = residual;
        (before, coarse, fine) = (outcome, fine, finer);
    }
}
