//! One run of jostle compared with the reference.

use std::ops::ControlFlow;
use std::sync::Arc;

use jostle::stepping::find_sensitivity;
use jostle::{
    GroundMotion, Plan, Pounding, Run, RunEnd, Settings, Solver, Summary, System, simulate,
};
use jostle_io::Input;

use super::quantities::values_of;
use super::truth::{Truth, errors, true_peaks};

/// Cuts that are tried before a run that is still sensitive counts as warned.
const MOST_CUTS: usize = 4;
/// By how much the perturbed reference of a cut motion ends sooner: an impact at the very end is in one run or in the other
/// \[s\].
const ENDS_SOONER: f64 = 1e-4;
/// Shortest motion that a cut leaves \[s\].
const LEAST_CUT: f64 = 0.01;

/// The promised numbers of one run held against the reference.
#[derive(Clone, Debug)]
pub struct Held {
    /// Solver.
    pub solver: &'static str,
    /// Tolerance.
    pub tolerance: f64,
    /// The reference: that of the model, or of the cut motion.
    pub truth: Arc<Truth>,
    /// Error over the scale of every quantity whose reference is certain, in the order of the quantities.
    pub errors: Vec<Option<f64>>,
    /// Values of the run.
    pub got: Vec<f64>,
    /// Whether the run, cut if it was sensitive, warned that its peaks may be off.
    pub warned: bool,
    /// What the run warned of, or that it called itself sensitive, although all its numbers are certain and within the tolerance.
    pub false_alarm: Option<String>,
    /// Where the motion was cut, as the run was sensitive from there \[s\].
    pub cut: Option<f64>,
    /// Why it failed, if so.
    pub failed: Option<String>,
    /// Wall time \[s\].
    pub seconds: f64,
}

/// Whether a summary says that its peaks may be off.
fn warns(summary: &Summary) -> bool {
    let promise = serde_json::to_value(summary).ok();
    let met = promise.and_then(|value| {
        value
            .pointer("/promise/met")
            .and_then(serde_json::Value::as_bool)
    });
    let said = summary.warnings.iter().chain(&summary.notes);
    met == Some(false) || said.into_iter().any(|text| text.contains("sensitive"))
}

/// What a summary says against its peaks.
fn alarm(summary: &Summary) -> Option<String> {
    if let Some(from) = summary.promise.sensitive_from_s {
        return Some(format!("sensitive from {from:.3} s"));
    }
    let said = summary.warnings.iter().chain(&summary.notes);
    let said = said.filter(|text| text.contains("sensitive") || text.contains("tolerance"));
    let said: Vec<&str> = said.map(String::as_str).collect();
    warns(summary).then(|| said.join("; "))
}

/// One run: its summary, why it failed, and its wall time \[s\].
struct Ran {
    summary: Summary,
    failed: Option<String>,
    seconds: f64,
}

fn ran(
    input: &Input,
    system: &System,
    motion: &GroundMotion,
    solver: Solver,
    tolerance: f64,
) -> Result<Ran, String> {
    let mut model = input.model.clone();
    model.analysis.tolerance = tolerance;
    model.analysis.solver = Some(solver);
    let plan = Plan::choose(system, motion, &model.analysis).map_err(|faults| {
        let problems = faults.iter().map(|fault| fault.problem.clone());
        problems.collect::<Vec<_>>().join("; ")
    })?;
    let begun = std::time::Instant::now();
    let settings = Settings {
        pounding: Pounding::Included,
        record_interval: None,
        ..Settings::default()
    };
    let mut outcome = simulate(system, motion, &plan, settings, |_| {
        ControlFlow::Continue(())
    });
    let seconds = begun.elapsed().as_secs_f64();
    find_sensitivity(system, motion, &plan, None, &mut outcome, |_| {
        ControlFlow::Continue(())
    });
    let summary = Summary::new(&Run {
        model: &model,
        system,
        motion,
        plan: &plan,
        outcome: &outcome,
        without_contact: None,
        wall: seconds,
    });
    let failed = match &outcome.end {
        RunEnd::Completed => None,
        other => Some(format!("{other:?}")),
    };
    Ok(Ran {
        summary,
        failed,
        seconds,
    })
}

/// Longest elastic contact at 0.3 m/s: what a cut run leaves out before the sensitive instant \[s\].
fn margin(system: &System) -> f64 {
    let contacts = system.contacts.iter();
    let durations =
        contacts.map(|contact| contact.law.elastic_duration(contact.effective_mass(), 0.3));
    durations.fold(0.0, f64::max)
}

/// Runs a model and holds its peaks to the reference: of the whole motion, or before the instant from which the run
/// calls itself sensitive.
pub(super) fn hold(
    input: &Input,
    system: &System,
    motion: &GroundMotion,
    truth: &Arc<Truth>,
    solver: Solver,
    tolerance: f64,
) -> Result<Held, String> {
    let mut run = ran(input, system, motion, solver, tolerance)?;
    let seconds = run.seconds;
    let false_alarm = alarm(&run.summary).filter(|_| {
        let all = errors(truth, &values_of(&run.summary, system), tolerance);
        let mut all = all.iter();
        run.failed.is_none() && all.all(|error| error.is_some_and(|error| error <= tolerance))
    });
    let mut truth = truth.clone();
    let mut cut = None;
    for _ in 0..MOST_CUTS {
        let Some(from) = run.summary.promise.sensitive_from_s else {
            break;
        };
        let end = from - margin(system);
        if run.failed.is_some() || cut.is_some_and(|cut| end >= cut) {
            break;
        }
        cut = Some(end.max(0.0));
        let mut shorter = motion.clone();
        shorter.duration = end;
        // Nothing happens, and nothing is promised, before the first points of the motion.
        let promised = end > LEAST_CUT;
        let again = promised.then(|| ran(input, system, &shorter, solver, tolerance));
        let Some(Ok(again)) = again else {
            truth = Arc::default();
            break;
        };
        run = again;
        let mut sooner = shorter.clone();
        sooner.duration = end - ENDS_SOONER;
        match true_peaks(system, [&shorter, &sooner]) {
            Ok((peaks, ..)) => truth = Arc::new(peaks),
            Err(why) => run.failed = Some(format!("no reference up to {end:.3} s: {why}")),
        }
    }
    let got = if truth.quantities.is_empty() {
        Vec::new()
    } else {
        values_of(&run.summary, system)
    };
    Ok(Held {
        solver: solver.name(),
        tolerance,
        errors: errors(&truth, &got, tolerance),
        truth,
        got,
        warned: warns(&run.summary),
        false_alarm,
        cut,
        failed: run.failed,
        seconds,
    })
}
