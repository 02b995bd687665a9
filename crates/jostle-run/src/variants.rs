//! The same run with another model: what runs with other contacts and at the bounds of bearings share.

use std::sync::Arc;

use jostle::{Model, ModelFault, Plan, RunEnd, Settings, Summary, System};

use crate::observer::{Observer, Stage};
use crate::prepared::{Prepared, without_contact};

impl Prepared {
    /// The same with another model, which `assemble` puts together; `None` if it is the same model. `words` say what is different.
    pub(crate) fn with_model(
        &self,
        model: Model,
        words: &str,
        assemble: impl FnOnce(&Model) -> Result<System, Vec<ModelFault>>,
    ) -> Result<Option<Self>, String> {
        if model == self.input.model {
            return Ok(None);
        }
        let mut input = (*self.input).clone();
        input.model = model;
        let refused = |faults: Vec<ModelFault>| {
            let problems: Vec<String> = faults.iter().map(ToString::to_string).collect();
            format!("{words}: {}", problems.join("; "))
        };
        let system = assemble(&input.model).map_err(refused)?;
        let plan = Plan::choose(&system, &self.motion, &input.model.analysis).map_err(refused)?;
        Ok(Some(Self {
            input: Arc::new(input),
            system: Arc::new(system),
            motion: self.motion.clone(),
            plan,
            shapes: None,
        }))
    }

    /// The numbers of a run of it, or why there are none; `apart` says whether it is also run without contact.
    pub(crate) fn run_variant(
        &self,
        words: &str,
        apart: bool,
        stage: Stage,
        observer: &mut Observer<'_>,
    ) -> Result<Summary, String> {
        let mut run = |settings: Settings| {
            let outcome = self.step(settings, |progress| observer(stage, progress));
            match outcome.end_of_all() {
                RunEnd::Completed => Ok(outcome),
                RunEnd::Stopped => Err("they were interrupted".to_owned()),
                RunEnd::Failed(error) => Err(format!("{words}: {error}")),
            }
        };
        let settings = self.settings(false);
        let outcome = run(settings)?;
        let without = apart.then(|| run(without_contact(settings))).transpose()?;
        Ok(self.summary(&outcome, without.as_ref(), 0.0))
    }
}
