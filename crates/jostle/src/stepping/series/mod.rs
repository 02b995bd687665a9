//! Shear buildings that yield: every displacement as a power series in time, from one change of stiffness to the next
//! (theory, "Shear buildings that yield").
//!
//! Between two corners of its springs a building is linear, and between two points of a record the ground acceleration is a
//! straight line. The displacements are then analytic in time, and a dozen powers give them to rounding without any matrix
//! being factorised. Changes of springs are roots of polynomials. Contact forces are parabolas over short steps, as in
//! modal stepping. [`refusals`] lists what is not supported.

mod building_motion;
mod contacts;
mod operators;
mod peaks;
mod power_series;
mod push;
mod spring_line;
mod stepper;

pub(super) use stepper::run;

use crate::model::Integrator;
use crate::motion::GroundMotion;
use crate::state::State;
use crate::stepping::outcome::{OnProgress, Outcome, RunEnd, Settings, StepError};
use crate::stepping::plan::Plan;
use crate::system::System;
use operators::Operators;
use power_series::LANES;

/// Reasons why series stepping does not support the buildings; empty if it does.
#[must_use]
pub fn refusals(system: &System, integrator: Integrator) -> Vec<String> {
    let mut reasons = Vec::new();
    if system.is_in_space() {
        reasons.push("buildings with a plan move in more than one direction".to_owned());
    }
    for building in &system.buildings {
        let name = &building.name;
        if building.foundation.is_some() {
            reasons.push(format!(
                "\"{name}\" stands on a foundation, whose rotation acts on all storeys"
            ));
        }
        if building.equations.mass.contains(&0.0) {
            reasons.push(format!(
                "\"{name}\" has degrees of freedom without mass, as frames do"
            ));
        }
        if Operators::new(&building.equations).reach > LANES {
            reasons.push(format!(
                "\"{name}\" couples displacements that are far apart"
            ));
        }
        if building.modal_damping.is_some() {
            reasons.push(format!("\"{name}\" has damping in all modes"));
        }
        if !building.rest.displacement.is_empty() {
            reasons.push(format!(
                "\"{name}\" starts under its weight: leave out gravity"
            ));
        }
        if !building.members.forms.is_empty() {
            reasons.push(format!("forces of members of \"{name}\" are asked for"));
        }
        let mut springs = building.equations.springs.iter();
        if springs.any(|spring| spring.hysteresis.rule().depends_on_rate()) {
            reasons.push(format!("friction of \"{name}\" may depend on speed"));
        }
    }
    if !system.links.is_empty() {
        reasons.push("links are not supported".to_owned());
    }
    if system.frictions().next().is_some() {
        reasons.push("contacts with friction are not supported".to_owned());
    }
    if integrator != Integrator::default() {
        reasons.push("motion is advanced exactly: leave out the integrator".to_owned());
    }
    reasons
}

/// Radians of the fastest motion in a step.
const RADIANS_PER_STEP: f64 = 2.0;

/// The longest step in which no building turns more than once \[s\].
pub(super) fn longest_step(system: &System) -> f64 {
    let rates = system.buildings.iter();
    let rates = rates.map(|building| Operators::new(&building.equations).rate);
    RADIANS_PER_STEP / rates.fold(0.0, f64::max)
}

/// Most repetitions with finer steps in contact.
const MOST_REPEATS: u64 = 4;

/// Runs a system from a state with the steps of the plan, and again with finer ones in contact while the estimated error
/// exceeds the tolerance.
pub(super) fn simulate(
    system: &System,
    motion: &GroundMotion,
    plan: &Plan,
    settings: Settings,
    state: State,
    observer: &mut OnProgress<'_>,
) -> Outcome {
    if let Some(reason) = refusals(system, plan.integrator).into_iter().next() {
        return Outcome::not_begun(system, StepError::Unsuited { reason });
    }
    let (mut plan, mut repeats) = (*plan, 0);
    loop {
        let mut outcome = run(system, motion, &plan, settings, state.clone(), observer);
        outcome.work.repeated_runs = repeats;
        let within = outcome
            .accuracy
            .is_none_or(|accuracy| accuracy.residual <= accuracy.tolerance);
        let settled = within || repeats == MOST_REPEATS || !plan.chooses_contact_steps();
        if settled || outcome.end != RunEnd::Completed {
            return outcome;
        }
        repeats += 1;
        plan = plan.with_finer_contacts();
    }
}
