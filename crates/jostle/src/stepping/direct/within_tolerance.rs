//! Direct runs at two step sizes, whose difference measures the error of every reported peak.

use super::run_directly;
use crate::interface::LinkElement;
use crate::motion::GroundMotion;
use crate::state::State;
use crate::stepping::outcome::{Accuracy, OnProgress, Outcome, RunEnd, Settings, StepError};
use crate::stepping::peak_change::{change_of_parts, change_of_peaks};
use crate::stepping::plan::Plan;
use crate::stepping::sensitivity::first_parted;
use crate::system::{BuildingSystem, System};

/// Largest number of refinements.
const MOST_REFINEMENTS: u64 = 4;
/// Margin of the measured error: errors of single peaks fall less regularly than a power of the step.
const MARGIN: f64 = 1.5;
/// Fraction of the tolerance that refined steps aim at.
const AIM: f64 = 0.5;
/// Least and greatest factors by which steps are refined at a time.
const REFINEMENT: [f64; 2] = [2.0, 3.0];
/// Fraction of the error of second order that may remain after a refinement; otherwise it was in vain.
const LEFT_OVER: f64 = 0.8;
/// Least and greatest order of convergence; average acceleration is of second order.
const ORDERS: [f64; 2] = [0.75, 2.0];

/// Greatest duration of a run relative to one with the steps that were chosen, if its tolerance asks for finer ones: both runs that
/// measure the error, and all refinements.
pub(in crate::stepping) fn longest() -> f64 {
    let refined = |times: u64| libm::pow(REFINEMENT[1], times as f64);
    1.5 + (1..=MOST_REFINEMENTS).map(refined).sum::<f64>()
}

/// Whether forces have corners.
fn has_corners(system: &System) -> bool {
    let yields = |building: &BuildingSystem| !building.equations.springs.is_empty();
    system.buildings.iter().any(yields) || !system.links.iter().all(LinkElement::is_linear)
}

/// Factor by which steps are coarsened for comparison. Where forces have corners, accelerations are greatest there; steps twice as long
/// would miss a corner by the same instants.
fn coarsened(system: &System) -> f64 {
    if has_corners(system) { 0.62 } else { 0.5 }
}

/// Refinements in vain, one after the other, before refinement stops. Where forces have corners, two runs may miss the same short event, and
/// the third then seems to be as far off as they are.
fn most_in_vain(system: &System) -> u32 {
    if has_corners(system) { 2 } else { 1 }
}

/// Whether a run ended because its steps were too long for what yields or touches.
fn diverged(outcome: &Outcome) -> bool {
    use StepError::{ContactDiverged, SpringsDiverged};
    matches!(
        outcome.end,
        RunEnd::Failed(SpringsDiverged { .. } | ContactDiverged { .. })
    )
}

/// Weight of the energy imbalance in the error of a peak.
const LOST: f64 = 0.1;

/// Contribution of rounding to the error: motion with the energy of the imbalance, relative to all motion \[–\].
///
/// Steps balance their energy exactly, apart from rounding and the quadrature of contact forces. The latter falls with
/// the step; what rises is rounding. Very short steps lose digits, and two runs may lose the same ones.
fn rounding([coarse, fine]: [&Outcome; 2]) -> f64 {
    let [before, after] = [coarse, fine].map(|outcome| outcome.energy.imbalance());
    LOST * (after - before).max(0.0).sqrt()
}

/// Change of peaks between two runs, and the ratio of their steps.
#[derive(Clone, Copy)]
struct Change {
    change: f64,
    ratio: f64,
}

impl Change {
    fn between(system: &System, runs: [&Outcome; 2], plans: [&Plan; 2]) -> Self {
        let completed = runs.iter().all(|run| run.end == RunEnd::Completed);
        Self {
            change: if completed {
                change_of_peaks(system, runs).max(change_of_parts(system, runs))
            } else {
                1.0
            },
            ratio: plans[0].step / plans[1].step,
        }
    }

    /// Error of the finer run, if errors fall with this power of the step.
    fn error(self, order: f64) -> f64 {
        self.change / (libm::pow(self.ratio, order) - 1.0)
    }

    /// Order of convergence, from this change and the next one of finer runs.
    fn order(self, next: Self) -> f64 {
        let errors_fit = |order: f64| {
            let from_this = self.error(order);
            let from_next = next.error(order) * libm::pow(next.ratio, order);
            from_this <= from_next
        };
        let [mut least, mut greatest] = ORDERS;
        if !errors_fit(greatest) {
            return greatest;
        }
        for _ in 0..30 {
            let middle = 0.5 * (least + greatest);
            *(if errors_fit(middle) {
                &mut greatest
            } else {
                &mut least
            }) = middle;
        }
        least
    }
}

/// Runs a system with automatic steps twice, the second time with shorter ones, and refines them further while the error of the finer
/// run exceeds the tolerance. With given steps it runs as asked. Where the elongation of periods does not tell the error, it runs once
/// more with other steps.
///
/// Average acceleration is of second order: where steps shrink by the factor r, the error of the finer run is the difference
/// of both over r² − 1 (L. F. Richardson, 1911, Phil. Trans. R. Soc. A 210, 307–357). Accelerations of modes that a step does
/// not resolve fall more slowly. So two runs decide only if the error would be within the tolerance at first order too;
/// otherwise a third one gives the order (P. J. Roache, 1994, J. Fluids Eng. 116, 405–413).
pub(in crate::stepping) fn within_tolerance(
    system: &System,
    motion: &GroundMotion,
    plan: &Plan,
    settings: Settings,
    state: State,
    observer: &mut OnProgress<'_>,
) -> Outcome {
    let mut run =
        |plan: &Plan| run_directly(system, motion, plan, settings, state.clone(), observer);
    if !plan.is_automatic(system, motion) {
        let outcome = run(plan);
        let known = outcome.accuracy.is_some() || outcome.end != RunEnd::Completed;
        return if known {
            outcome
        } else {
            with_error(system, motion, plan, outcome, &mut run)
        };
    }
    let mut fine = *plan;
    let coarsened = coarsened(system);
    let coarser = plan.refined(coarsened, motion);
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
    let tolerance = plan.tolerance();
    let mut known: Option<Change> = None;
    let (mut last, mut refinements, mut further_runs) = (f64::INFINITY, 0, 0);
    let (mut in_vain, most_in_vain) = (0, most_in_vain(system));
    loop {
        let mut outcome = run(&fine);
        outcome.work.repeated_runs = further_runs;
        if outcome.end != RunEnd::Completed {
            // If a refinement is stopped or fails, the previous run is kept.
            if refinements > 0 && before.end == RunEnd::Completed {
                before.interrupted = outcome.end == RunEnd::Stopped;
                return before;
            }
            // Springs and contacts that long steps cannot resolve may follow shorter ones.
            let finer = fine.refined(REFINEMENT[1], motion);
            if !diverged(&outcome)
                || refinements == MOST_REFINEMENTS
                || finer.check_digits(system).is_err()
            {
                return outcome;
            }
            refinements += 1;
            further_runs += 1;
            (before, coarse, fine) = (outcome, fine, finer);
            continue;
        }
        let change = Change::between(system, [&before, &outcome], [&coarse, &fine]);
        let rounding = rounding([&before, &outcome]);
        let first = MARGIN * change.error(ORDERS[1]) + rounding;
        let in_doubt = first <= tolerance && change.error(1.0) + rounding > tolerance;
        if known.is_none() && in_doubt {
            let coarser = coarse.refined(coarsened, motion);
            let coarsest = run(&coarser);
            outcome.interrupted = coarsest.end == RunEnd::Stopped;
            further_runs += 1;
            outcome.work.repeated_runs = further_runs;
            if coarsest.end == RunEnd::Completed && coarser.step > coarse.step {
                known = Some(Change::between(
                    system,
                    [&coarsest, &before],
                    [&coarser, &coarse],
                ));
            }
        }
        let order = known.map_or(ORDERS[1], |known| known.order(change));
        let residual = MARGIN * change.error(order) + rounding;
        outcome.accuracy = Some(Accuracy {
            tolerance,
            residual,
            // Impacts that differ between the two step sizes, and all that follows them, are not resolved.
            doubtful_from: (residual > tolerance)
                .then(|| first_parted(system, [&outcome, &before], tolerance))
                .flatten(),
            sensitive_from: None,
        });
        in_vain = if first < LEFT_OVER * last {
            0
        } else {
            in_vain + 1
        };
        let converges = in_vain < most_in_vain && rounding < AIM * tolerance;
        if residual <= tolerance || refinements == MOST_REFINEMENTS || !converges {
            return outcome;
        }
        last = first;
        let [least, most] = REFINEMENT;
        let wanted = libm::pow(residual / (AIM * tolerance), order.recip());
        let finer = fine.refined(wanted.clamp(least, most), motion);
        // The product of transfer matrices loses its digits at short steps.
        if finer.check_digits(system).is_err() {
            return outcome;
        }
        refinements += 1;
        further_runs += 1;
        known = Some(change);
        (before, coarse, fine) = (outcome, fine, finer);
    }
}

/// The outcome of given steps with its error, from a run with longer steps, or with steps half as long where those of a record leave
/// no longer ones.
fn with_error(
    system: &System,
    motion: &GroundMotion,
    plan: &Plan,
    mut outcome: Outcome,
    run: &mut dyn FnMut(&Plan) -> Outcome,
) -> Outcome {
    let coarser = plan.refined(coarsened(system), motion);
    let is_longer = coarser.step > plan.step * (1.0 + 1e-9);
    let other_plan = if is_longer {
        coarser
    } else {
        plan.refined(2.0, motion)
    };
    let other = run(&other_plan);
    if other.end == RunEnd::Stopped {
        // The run that was asked for is complete; only its error is not known.
        outcome.interrupted = true;
        return outcome;
    }
    outcome.work.repeated_runs = 1;
    let order = ORDERS[1];
    let residual = if is_longer {
        let change = Change::between(system, [&other, &outcome], [&other_plan, plan]);
        change.error(order)
    } else {
        let change = Change::between(system, [&outcome, &other], [plan, &other_plan]);
        change.error(order) * libm::pow(change.ratio, order)
    };
    let (tolerance, residual) = (plan.tolerance(), MARGIN * residual);
    outcome.accuracy = Some(Accuracy {
        tolerance,
        residual,
        doubtful_from: (residual > tolerance)
            .then(|| first_parted(system, [&outcome, &other], tolerance))
            .flatten(),
        sensitive_from: None,
    });
    outcome
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_order_follows_from_three_runs() {
        for order in [0.8, 1.0, 1.7, 2.0] {
            let error = |step: f64| step.powf(order);
            let change = |coarse: f64, fine: f64| Change {
                change: error(coarse) - error(fine),
                ratio: coarse / fine,
            };
            let (first, second) = (change(4.0, 2.0), change(2.0, 0.7));
            assert!((first.order(second) - order).abs() < 1e-6);
            assert!((second.error(order) - error(0.7)).abs() < 1e-12);
        }
    }

    #[test]
    fn the_order_stays_within_its_bounds() {
        let of = |change: f64| Change { change, ratio: 2.0 };
        assert_eq!(of(1.0).order(of(1e-3)), ORDERS[1]);
        assert!((of(1e-3).order(of(1.0)) - ORDERS[0]).abs() < 1e-6);
    }
}
