//! Runs of a model as the command line makes them, and their results as a tree.

use std::ops::ControlFlow;
use std::sync::Arc;

use jostle::Solver;
use jostle::system::BuildingSystem;
use jostle_io::Input;
use jostle_run::{Opened, Prepared};
use serde_json::{Value, json};

use super::histories;

/// Least tolerance of direct steps: at 1e-3 they are three times as many, take most of the time and pin nothing else.
const OF_DIRECT: f64 = 1e-2;

/// The summary of a model with and without contact, with forces of members where there are any, and its histories.
pub(super) fn run(input: &Input, solver: Solver) -> Value {
    let prepared = prepare(input, solver, true).or_else(|| prepare(input, solver, false));
    let Some(prepared) = prepared else {
        return json!({ "refused": true });
    };
    let settings = prepared.settings(true);
    let mut go_on = |_, _| ControlFlow::Continue(());
    let mut ran = prepared.run(settings, &mut go_on);
    ran.run_without_contact(settings, &mut go_on);
    let mut tree = serde_json::to_value(ran.summary()).unwrap_or_default();
    leave_out(&mut tree);
    tree["history"] = histories::describe(&ran.outcome);
    if let Some(without) = &ran.without_contact {
        tree["history_without_contact"] = histories::describe_in_short(without);
    }
    tree
}

/// What differs from run to run, or with the version.
fn leave_out(tree: &mut Value) {
    if let Some(keys) = tree.as_object_mut() {
        keys.remove("jostle");
        keys.remove("build");
    }
    if let Some(work) = tree["work"].as_object_mut() {
        work.remove("wall_s");
    }
}

/// A model ready to run; `None` if it is refused.
fn prepare(input: &Input, solver: Solver, members: bool) -> Option<Prepared> {
    let mut opened = Opened::new(input.clone(), "pinned").ok()?;
    let input = Arc::make_mut(&mut opened.input);
    let analysis = &mut input.model.analysis;
    analysis.solver = Some(solver);
    if matches!(
        solver,
        Solver::Riccati | Solver::Stiffness | Solver::Product
    ) {
        analysis.tolerance = analysis.tolerance.max(OF_DIRECT);
    }
    if members {
        input.ask_for_members();
        let model = &input.model;
        model.check().ok()?;
        Arc::make_mut(&mut opened.system).follow_members(&model.analysis.members);
    }
    let mut prepared = opened.prepare().ok()?;
    prepared.check_digits(None).ok()?;
    // One run each, and one for its error: refining steps would take most of the time and pin the same steps again.
    let yields = |system: &BuildingSystem| !system.equations.springs.is_empty();
    prepared.plan.is_given |= prepared.system.buildings.iter().any(yields);
    Some(prepared)
}
