//! Runs from rest to the end of the motion.

use std::ops::ControlFlow;

use jostle::{
    Analysis, GroundMotion, Model, Outcome, Plan, Run, RunEnd, Settings, Summary, System, simulate,
};

/// Assembles a model.
///
/// # Panics
/// If the model has faults.
#[must_use]
#[track_caller]
pub fn assembled(model: &Model) -> System {
    System::assemble(model).unwrap_or_else(|faults| panic!("{faults:?}"))
}

/// Chooses steps.
///
/// # Panics
/// If there are none.
#[must_use]
#[track_caller]
pub fn planned(system: &System, motion: &GroundMotion, analysis: &Analysis) -> Plan {
    Plan::choose(system, motion, analysis).unwrap_or_else(|faults| panic!("{faults:?}"))
}

/// Runs to the end of the motion, with a history at an interval (0 for every step) or without \[s\].
///
/// # Panics
/// If the end is not reached.
#[must_use]
#[track_caller]
pub fn completed(
    system: &System,
    motion: &GroundMotion,
    plan: &Plan,
    record_interval: Option<f64>,
) -> Outcome {
    let settings = Settings {
        record_interval,
        ..Settings::default()
    };
    let outcome = simulate(
        system,
        motion,
        plan,
        settings,
        |_| ControlFlow::Continue(()),
    );
    assert_eq!(
        outcome.end,
        RunEnd::Completed,
        "the run must reach its end, {plan:?}\n{:?}",
        system.contacts
    );
    outcome
}

/// Assembles a model, chooses steps and runs it; arguments and panics as above.
#[must_use]
#[track_caller]
pub fn run(
    model: &Model,
    motion: &GroundMotion,
    record_interval: Option<f64>,
) -> (System, Outcome) {
    let system = assembled(model);
    let plan = planned(&system, motion, &model.analysis);
    let outcome = completed(&system, motion, &plan, record_interval);
    (system, outcome)
}

/// The same with the summary of the run, and a history of every step.
#[must_use]
#[track_caller]
pub fn run_and_summary(model: &Model, motion: &GroundMotion) -> (System, Outcome, Summary) {
    let system = assembled(model);
    let plan = planned(&system, motion, &model.analysis);
    let outcome = completed(&system, motion, &plan, Some(0.0));
    let summary = Summary::new(&Run {
        model,
        system: &system,
        motion,
        plan: &plan,
        outcome: &outcome,
        without_contact: None,
        wall: 0.0,
    });
    (system, outcome, summary)
}
