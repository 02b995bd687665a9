//! From a system, a motion and a plan to the outcome of a run.

use std::ops::ControlFlow;

use super::direct::{run_directly, within_tolerance};
use super::outcome::{OnProgress, Outcome, Progress, Settings, StepError};
use super::plan::Plan;
use super::{modal, series};
use crate::history::Storage;
use crate::model::Solver;
use crate::motion::GroundMotion;
use crate::state::State;
use crate::system::System;

/// Runs a system from rest through a ground motion. `observer` is called now and then and may stop the run.
///
/// The answer depends on nothing but the arguments, bit for bit.
///
/// ```
/// use std::ops::ControlFlow;
///
/// use jostle::{Settings, simulate};
/// # mod towers { include!(concat!(env!("CARGO_MANIFEST_DIR"), "/examples/two_towers/pair.rs")); }
/// # let model = towers::pair(0.02);
/// # let wave = (0..=300).map(|i| 3.0 * (0.09 * f64::from(i)).sin()).collect();
/// # let motion = jostle::GroundMotion::sampled("sine", 0.01, wave);
/// # let system = jostle::System::assemble(&model).map_err(|faults| faults[0].clone())?;
/// # let plan = jostle::Plan::choose(&system, &motion, &model.analysis).map_err(|faults| faults[0].clone())?;
///
/// let outcome = simulate(&system, &motion, &plan, Settings::default(), |_| ControlFlow::Continue(()));
/// assert!(!outcome.impacts.is_empty());
/// assert!(outcome.energy.worst_imbalance < 1e-6);
/// # Ok::<(), jostle::ModelFault>(())
/// ```
pub fn simulate(
    system: &System,
    motion: &GroundMotion,
    plan: &Plan,
    settings: Settings,
    observer: impl FnMut(Progress) -> ControlFlow<()>,
) -> Outcome {
    simulate_from(
        system,
        motion,
        plan,
        settings,
        State::at_rest_on(system, motion),
        observer,
    )
}

/// Runs a system from a given state at time zero. Where that state is not in equilibrium, the missing load
/// appears within the first step. [`Solver::Modal`] takes displacements and velocities of masses from the state, with the
/// energy of these as input; it begins with open contacts, and from rest where links act.
pub fn simulate_from(
    system: &System,
    motion: &GroundMotion,
    plan: &Plan,
    settings: Settings,
    state: State,
    mut observer: impl FnMut(Progress) -> ControlFlow<()>,
) -> Outcome {
    step_through(system, motion, plan, settings, state, &mut observer)
}

/// [`simulate_from`] for any observer.
fn step_through(
    system: &System,
    motion: &GroundMotion,
    plan: &Plan,
    settings: Settings,
    state: State,
    observer: &mut OnProgress<'_>,
) -> Outcome {
    if plan.vertical != motion.is_vertical() {
        let reason = "the steps were chosen for another motion".to_owned();
        return Outcome::not_begun(system, StepError::Unsuited { reason });
    }
    if plan.solver != Solver::Modal
        && let Some(building) = system.buildings.iter().find(|b| b.modal_damping.is_some())
    {
        let reason = format!(
            "\"{}\" has damping in all modes, which only modal stepping knows",
            building.name
        );
        return Outcome::not_begun(system, StepError::Unsuited { reason });
    }
    match plan.solver {
        Solver::Modal if !modal::is_rest(&state) => {
            modal::simulate_from(system, motion, plan, settings, &state, observer)
        }
        Solver::Modal => match modal::Reduction::new(system, plan) {
            Ok(shapes) => {
                modal::simulate_with(system, motion, plan, settings, &shapes, None, observer)
            }
            Err(error) => Outcome::not_begun(system, error),
        },
        Solver::Series => series::simulate(system, motion, plan, settings, state, observer),
        Solver::Riccati | Solver::Stiffness | Solver::Product => {
            within_tolerance(system, motion, plan, settings, state, observer)
        }
    }
}

/// Runs a system from rest without an estimate of the error, with the steps and shapes of an outcome: of the same
/// system, or of one with other gap widths. `shapes`: those with which the outcome began, if they are at hand.
pub(super) fn simulate_like(
    outcome: &Outcome,
    system: &System,
    motion: &GroundMotion,
    plan: &Plan,
    shapes: Option<&modal::Reduction>,
    observer: &mut OnProgress<'_>,
) -> Outcome {
    let plan = &plan.with_step(outcome.free_step);
    // Power series take shorter steps where a history wants its rows.
    let shorter = outcome.free_step.filter(|step| *step < plan.step);
    let settings = Settings {
        record_interval: shorter.filter(|_| plan.solver == Solver::Series),
        storage: Storage::NOWHERE,
        ..Settings::default()
    };
    let rest = || State::at_rest_on(system, motion);
    match plan.solver {
        Solver::Modal => {
            let refined = &outcome.refined;
            if let Some(shapes) = shapes {
                return modal::simulate_as(refined, system, motion, plan, shapes, observer);
            }
            match modal::Reduction::new(system, plan) {
                Ok(reduction) => {
                    modal::simulate_as(refined, system, motion, plan, &reduction, observer)
                }
                Err(error) => Outcome::not_begun(system, error),
            }
        }
        Solver::Series => series::run(system, motion, plan, settings, rest(), observer),
        Solver::Riccati | Solver::Stiffness | Solver::Product => {
            run_directly(system, motion, plan, settings, rest(), observer)
        }
    }
}
