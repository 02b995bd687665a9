//! A model with everything that its runs need.

use std::ops::ControlFlow;
use std::sync::Arc;

use jostle::judgement::{Known, judge};
use jostle::stepping::{Progress, find_sensitivity, modal};
use jostle::{
    GroundMotion, Outcome, Plan, Pounding, RunEnd, Settings, Solver, Summary, System, simulate,
};
use jostle_io::{Input, InputError};

use crate::history_file::STORAGE;

/// A model, its ground motion and its steps.
pub struct Prepared {
    /// The model file; its warnings include that of an unusual motion.
    pub input: Arc<Input>,
    /// The assembled equations of motion.
    pub system: Arc<System>,
    /// Its ground motion.
    pub motion: GroundMotion,
    /// Its steps.
    pub plan: Plan,
    /// Shapes for modal stepping, if it is used.
    pub shapes: Option<Arc<modal::Reduction>>,
}

impl Prepared {
    /// Puts together what belongs to one model, and adds the warning of an unusual motion to those of the model.
    #[must_use]
    pub fn new(
        mut input: Arc<Input>,
        system: Arc<System>,
        motion: GroundMotion,
        plan: Plan,
        shapes: Option<Arc<modal::Reduction>>,
    ) -> Self {
        if let Some(warning) = input.unusual_motion(&motion) {
            Arc::make_mut(&mut input).warnings.push(warning);
        }
        Self {
            input,
            system,
            motion,
            plan,
            shapes,
        }
    }

    /// Why the solver is expected to lose too many digits, if it is.
    #[must_use]
    pub fn lost_digits(&self) -> Option<String> {
        let checked = self.plan.check_digits(&self.system);
        checked.err().map(|refusal| refusal.to_string())
    }

    /// Refuses a solver that is expected to lose too many digits; `remedy` says how to run it all the same.
    ///
    /// # Errors
    /// The refusal, at the solver of the model file.
    pub fn check_digits(&self, remedy: Option<&str>) -> Result<(), InputError> {
        let Some(refusal) = self.lost_digits() else {
            return Ok(());
        };
        let problem = match remedy {
            Some(remedy) => format!("{refusal}; {remedy}"),
            None => refusal,
        };
        Err(self.input.fault("analysis.solver", problem))
    }

    /// Settings of a run with contact. Energies are audited where histories are recorded, so these are recorded even if
    /// nobody reads them. Modal and series stepping audit in every step, and rows cost them time: without
    /// `histories` they record none.
    #[must_use]
    pub fn settings(&self, histories: bool) -> Settings {
        let audits_anyway = matches!(self.plan.solver, Solver::Modal | Solver::Series);
        let recorded = histories || !audits_anyway;
        let interval = self.input.model.analysis.row_interval;
        Settings {
            record_interval: recorded.then_some(interval),
            storage: STORAGE,
            ..Settings::default()
        }
    }

    /// Steps the model once; `watch` is called with the time reached, and can stop it.
    #[must_use]
    pub fn step(
        &self,
        settings: Settings,
        watch: impl FnMut(Progress) -> ControlFlow<()>,
    ) -> Outcome {
        let (system, motion, plan) = (&self.system, &self.motion, &self.plan);
        match &self.shapes {
            Some(shapes) => modal::simulate(system, motion, plan, settings, shapes, watch),
            None => simulate(system, motion, plan, settings, watch),
        }
    }

    /// Notes in a finished outcome from when on its answers depend on contacts made or missed within the tolerance.
    pub fn find_sensitivity(
        &self,
        outcome: &mut Outcome,
        watch: impl FnMut(Progress) -> ControlFlow<()>,
    ) {
        let (system, motion, plan) = (&self.system, &self.motion, &self.plan);
        find_sensitivity(system, motion, plan, self.shapes.as_deref(), outcome, watch);
    }

    /// Whether results can be compared with a run without contact: there is a gap, and the run came to its end.
    #[must_use]
    pub fn compares(&self, outcome: &Outcome) -> bool {
        !self.system.contacts.is_empty() && outcome.end == RunEnd::Completed
    }

    /// The numbers of a run, with the notes on the model. `without_contact` is the same run without contact, if it was made,
    /// and `wall` the time that the run took \[s\].
    #[must_use]
    pub fn summary(
        &self,
        outcome: &Outcome,
        without_contact: Option<&Outcome>,
        wall: f64,
    ) -> Summary {
        let mut summary = Summary::new(&jostle::Run {
            model: &self.input.model,
            system: &self.system,
            motion: &self.motion,
            plan: &self.plan,
            outcome,
            without_contact: without_contact.filter(|run| run.end == RunEnd::Completed),
            wall,
        });
        summary.build = jostle_report::BUILD.map(str::to_owned);
        self.input.add_notes(&mut summary);
        let missing = without_contact.and_then(|run| not_compared(run, self.motion.duration));
        summary.notes.extend(missing);
        self.judge(&mut summary);
        summary
    }

    /// Runs all checks of the model and of its results.
    pub fn judge(&self, summary: &mut Summary) {
        let stated = &self.input.stated;
        summary.checks = judge(&Known {
            model: &self.input.model,
            system: &self.system,
            motion: Some(&self.motion),
            stated,
            results: Some((summary, &self.input.codes)),
        });
        summary.silenced_checks = stated
            .silenced
            .iter()
            .map(|&name| name.to_owned())
            .collect();
    }
}

/// The settings of a run without contact beside one with these.
pub(crate) fn without_contact(settings: Settings) -> Settings {
    Settings {
        pounding: Pounding::Excluded,
        ..settings
    }
}

/// Why nothing is compared with a run without contact, if it did not reach its end.
fn not_compared(without: &Outcome, duration: f64) -> Option<String> {
    let reason = match &without.end {
        RunEnd::Completed => return None,
        RunEnd::Stopped => format!(
            "was interrupted at t = {:.3} s of {duration:.3} s",
            without.state.time
        ),
        RunEnd::Failed(error) => format!("failed: {error}"),
    };
    Some(format!(
        "the run without contact {reason}; there is no comparison with it"
    ))
}
