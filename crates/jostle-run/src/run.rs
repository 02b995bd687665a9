//! The runs of a model.

use std::time::Instant;

use jostle::results::contact_sensitivity::ContactSensitivity;
use jostle::results::gradient::Gradient;
use jostle::{Outcome, Pounding, RunEnd, Settings, StepError, Summary};

use crate::floor_spectra::{RunFloorSpectra, combine, filter_floors};
use crate::isolation_bounds::{RunsAtBounds, add_bounds};
use crate::observer::{Observer, Stage};
use crate::prepared::{Prepared, without_contact};
use crate::results::Results;

/// A model that was run.
pub struct Ran {
    /// What was run.
    pub prepared: Prepared,
    /// The result.
    pub outcome: Outcome,
    /// The same without contact, if that was run.
    pub without_contact: Option<Outcome>,
    /// Time that the run with contact took \[s\].
    pub wall: f64,
    /// The same with other contacts, or why not, if these were run.
    pub contact_sensitivity: Option<Result<ContactSensitivity, String>>,
    /// Derivatives of its peaks, if they were asked for.
    pub gradients: Vec<Gradient>,
    /// The same at the bounds of bearings, or why not, if the model states any.
    pub isolation_bounds: Option<Result<RunsAtBounds, String>>,
    /// Spectra of floors, or why not, if they were asked for.
    pub floor_spectra: Option<Result<RunFloorSpectra, String>>,
    /// Those of the run without contact.
    pub floor_spectra_without: Option<Result<RunFloorSpectra, String>>,
}

impl Prepared {
    /// Runs the model from rest and, with contact, finds out whether its results are sensitive.
    #[must_use]
    pub fn run(self, settings: Settings, observer: &mut Observer<'_>) -> Ran {
        let stage = match settings.pounding {
            Pounding::Included => Stage::Pounding,
            Pounding::Excluded => Stage::WithoutContact,
        };
        let settings = self.with_rows_for_spectra(settings);
        let started = Instant::now();
        let mut outcome = self.step(settings, |progress| observer(stage, progress));
        let wall = started.elapsed().as_secs_f64();
        let floor_spectra = self.finish_histories(&mut outcome);
        if stage == Stage::Pounding {
            self.find_sensitivity(&mut outcome, |progress| {
                observer(Stage::Sensitivity, progress)
            });
        }
        Ran {
            floor_spectra,
            floor_spectra_without: None,
            prepared: self,
            outcome,
            without_contact: None,
            wall,
            contact_sensitivity: None,
            gradients: Vec::new(),
            isolation_bounds: None,
        }
    }

    /// What follows from the histories of a run, which has failed if they cannot be read back: peaks of filtered accelerations, and
    /// spectra of floors.
    pub fn finish_histories(
        &self,
        outcome: &mut Outcome,
    ) -> Option<Result<RunFloorSpectra, String>> {
        filter_floors(self.input.floor_spectra.as_ref(), outcome);
        let spectra = self.floor_spectra(outcome);
        if let Some(reason) = outcome.history_fault() {
            let (time, reason) = (outcome.state.time, reason.to_owned());
            outcome.end = RunEnd::Failed(StepError::HistoryNotKept { time, reason });
        }
        spectra
    }
}

impl Ran {
    /// Runs the same without contact, if there is a gap and the run with contact came to its end.
    pub fn run_without_contact(&mut self, settings: Settings, observer: &mut Observer<'_>) {
        if self.prepared.compares(&self.outcome) {
            let settings = without_contact(self.prepared.with_rows_for_spectra(settings));
            let watch = |progress| observer(Stage::WithoutContact, progress);
            let mut outcome = self.prepared.step(settings, watch);
            let spectra = self.prepared.finish_histories(&mut outcome);
            if outcome.end == RunEnd::Completed {
                self.floor_spectra_without = spectra;
            }
            self.without_contact = Some(outcome);
        }
    }

    /// Runs the model at both bounds of its bearings, if it states any and the run came to its end. `apart`: without contact as well.
    pub fn run_isolation_bounds(&mut self, apart: bool, observer: &mut Observer<'_>) {
        if self.outcome.end == RunEnd::Completed {
            self.isolation_bounds = self.prepared.run_at_bounds(apart, observer);
        }
    }

    /// The numbers of the run.
    #[must_use]
    pub fn summary(&self) -> Summary {
        let without = self.without_contact.as_ref();
        let mut summary = self.prepared.summary(&self.outcome, without, self.wall);
        self.add_variants(&mut summary);
        self.add_floor_spectra(&mut summary, self.floor_spectra_without.as_ref());
        summary
    }

    /// Adds what came out of other contacts and of the bounds of bearings to the numbers of the run, or why it is missing.
    pub fn add_variants(&self, summary: &mut Summary) {
        match &self.contact_sensitivity {
            Some(Ok(found)) => summary.contact_sensitivity = Some(found.clone()),
            Some(Err(problem)) => summary.warnings.push(format!(
                "results cannot be compared with those of other contacts: {problem}"
            )),
            None => {}
        }
        summary.gradients.clone_from(&self.gradients);
        if let Some(found) = &self.isolation_bounds {
            add_bounds(summary, found);
        }
        if self.has_variants() {
            self.prepared.judge(summary);
        }
    }

    /// Whether runs with other contacts, with other numbers or at the bounds of bearings were made, or tried.
    #[must_use]
    pub fn has_variants(&self) -> bool {
        self.contact_sensitivity.is_some()
            || self.isolation_bounds.is_some()
            || !self.gradients.is_empty()
    }

    /// Adds the spectra of floors to the numbers of the run, or why they are missing. `without`: those of the run without
    /// contact.
    pub fn add_floor_spectra(
        &self,
        summary: &mut Summary,
        without: Option<&Result<RunFloorSpectra, String>>,
    ) {
        let Some(request) = &self.prepared.input.floor_spectra else {
            return;
        };
        match &self.floor_spectra {
            Some(Ok(found)) => {
                let without = without.and_then(|found| found.as_ref().ok());
                let (spectra, warning) = combine(request, summary, found, without);
                summary.warnings.extend(warning);
                summary.floor_spectra = Some(spectra);
            }
            Some(Err(problem)) => summary
                .warnings
                .push(format!("there are no floor spectra: {problem}")),
            None => {}
        }
    }

    /// What the files of the run are written from.
    #[must_use]
    pub fn results<'a>(&'a self, summary: &'a Summary) -> Results<'a> {
        let without = self.without_contact.as_ref();
        Results {
            prepared: &self.prepared,
            outcome: &self.outcome,
            summary,
            history: self.outcome.history.as_ref(),
            without_contact: without.and_then(Results::comparable),
            methods: &[],
        }
    }
}
