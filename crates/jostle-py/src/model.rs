//! Models: read, checked and assembled once, then shared.

use std::path::PathBuf;
use std::sync::Arc;

use jostle::{GroundMotion, Plan, System};
use jostle_io::{Format, Input, InputError, Overrides};
use pyo3::prelude::*;

use crate::describe::describe;
use crate::error::{AnalysisError, argument_error, input_error};
use crate::matrices::{Matrices, matrices};
use crate::motion::Motion;

/// A model ready to run.
#[pyclass(frozen, module = "jostle._jostle")]
#[derive(Clone)]
pub(crate) struct Model {
    pub(crate) input: Arc<Input>,
    pub(crate) system: Arc<System>,
    /// Whether the ground motion was given separately from the model.
    other_record: bool,
}

impl Model {
    fn assemble(mut input: Input) -> Result<Self, InputError> {
        let system = System::assemble(&input.model).map_err(|faults| input.faults(faults))?;
        input.note_system(&system);
        Ok(Self {
            input: Arc::new(input),
            system: Arc::new(system),
            other_record: false,
        })
    }

    /// The ground motion and the steps to take through it; `force` steps even where digits are lost, and then
    /// says so.
    pub(crate) fn plan(&self, force: bool) -> PyResult<(GroundMotion, Plan, Option<String>)> {
        let input = &self.input;
        let motion = input
            .ground_motion()
            .map_err(|error| match &error.faults[..] {
                [fault] if self.other_record => {
                    argument_error(format!("motion: {}", fault.problem))
                }
                _ => input_error(&error),
            })?;
        let plan = Plan::choose(&self.system, &motion, &input.model.analysis)
            .map_err(|faults| input_error(&input.faults(faults)))?;
        let refusal = plan.check_digits(&self.system).err();
        match refusal.map(|refusal| refusal.to_string()) {
            Some(refusal) if !force => {
                let problem = format!("{refusal}; force=True runs it anyway");
                Err(input_error(&input.fault("analysis.solver", problem)))
            }
            refusal => Ok((motion, plan, refusal)),
        }
    }
}

#[pymethods]
impl Model {
    /// Reads a model file.
    #[staticmethod]
    fn load(py: Python<'_>, path: PathBuf) -> PyResult<Self> {
        let read = || Self::assemble(jostle_io::read_model_file(&path)?);
        py.detach(read).map_err(|error| input_error(&error))
    }

    /// Reads the text of a model file; errors show its lines only if it is a text that the user wrote.
    #[staticmethod]
    fn read(
        py: Python<'_>,
        name: &str,
        text: &str,
        json: bool,
        base: PathBuf,
        lines: bool,
    ) -> PyResult<Self> {
        let format = if json { Format::Json } else { Format::Toml };
        let read = || Self::assemble(jostle_io::read_model_text(name, text, format, &base)?);
        py.detach(read).map_err(|mut error| {
            if !lines {
                error.faults.iter_mut().for_each(|fault| fault.place = None);
            }
            input_error(&error)
        })
    }

    /// A built-in model.
    #[staticmethod]
    fn builtin(py: Python<'_>, name: &str) -> PyResult<Self> {
        py.detach(|| Self::assemble(jostle_io::builtin_model(name)?))
            .map_err(|error| input_error(&error))
    }

    /// The same model with the given changes; a record by name keeps the scaling of the model.
    #[pyo3(signature = (gap=None, pga=None, motion=None, record=None))]
    fn changed(
        &self,
        py: Python<'_>,
        gap: Option<f64>,
        pga: Option<f64>,
        motion: Option<&Motion>,
        record: Option<String>,
    ) -> PyResult<Self> {
        let mut input = Input::clone(&self.input);
        if let Some(motion) = motion {
            input.motion = Some(motion.spec.clone());
        }
        let other_record = motion.is_none() && (self.other_record || record.is_some());
        input
            .apply(&Overrides { pga, gap, record })
            .map_err(|error| argument_error(error.to_string()))?;
        if gap.is_some() {
            let changed = py.detach(|| Self::assemble(input));
            let changed = changed.map_err(|error| input_error(&error))?;
            return Ok(Self {
                other_record,
                ..changed
            });
        }
        Ok(Self {
            input: Arc::new(input),
            system: Arc::clone(&self.system),
            other_record,
        })
    }

    #[getter]
    fn title(&self) -> &str {
        &self.input.model.title
    }

    /// The text of the model file.
    #[getter]
    fn text(&self) -> &str {
        self.input.text()
    }

    #[getter]
    fn warnings(&self) -> Vec<String> {
        self.input.warnings.clone()
    }

    /// The records that a run may choose from; empty unless there are several.
    #[getter]
    fn records(&self) -> Vec<String> {
        self.input.records().to_vec()
    }

    /// The sampled ground motion; `None` if the model has none.
    fn motion(&self, py: Python<'_>) -> PyResult<Option<Motion>> {
        let Some(spec) = self.input.motion.clone() else {
            return Ok(None);
        };
        // The error of the model's own motion shows its line.
        py.detach(|| Motion::of(spec))
            .map(Some)
            .or_else(|_| self.plan(true).map(|_| None))
    }

    /// Buildings and gaps as JSON.
    fn describe(&self) -> String {
        describe(&self.input.model, &self.system).to_string()
    }

    /// Masses, stiffness, damping, driven masses and floors of a building, by its index.
    fn matrices<'py>(&self, py: Python<'py>, building: usize) -> PyResult<Matrices<'py>> {
        matrices(py, &self.system, building)
    }

    /// Contacts as (gap, left degree of freedom, right one, width), counted through all buildings; none is a wall.
    fn contacts(&self) -> Vec<(usize, Option<usize>, Option<usize>, f64)> {
        let contacts = self.system.contacts.iter();
        contacts
            .map(|contact| {
                let [left, right] = contact.ports.0.map(|face| face.map(|f| f.dof));
                (contact.gap, left, right, contact.width)
            })
            .collect()
    }

    /// Springs and dampers between buildings as (left degree of freedom, right one, stiffness, damping).
    fn links(&self) -> Vec<(Option<usize>, Option<usize>, f64, f64)> {
        let links = self.system.links.iter();
        links
            .map(|link| {
                let [left, right] = link.ports.0.map(|face| face.map(|f| f.dof));
                (left, right, link.stiffness, link.damping)
            })
            .collect()
    }

    /// Capacity curves as the JSON of `jostle pushover`.
    #[pyo3(signature = (building, pattern, direction, drift))]
    fn pushover(
        &self,
        py: Python<'_>,
        building: Option<&str>,
        pattern: &str,
        direction: &str,
        drift: f64,
    ) -> PyResult<String> {
        let title = &self.input.model.title;
        py.detach(|| {
            jostle_cli::pushover_json(title, &self.system, building, pattern, direction, drift)
        })
        .map_err(argument_error)
    }

    /// Natural modes as the JSON of `jostle modes`.
    fn modes(&self, py: Python<'_>, count: usize) -> PyResult<String> {
        let modes = py.detach(|| jostle_cli::modes_json(&self.system, count));
        modes
            .map(|modes| modes.to_string())
            .map_err(AnalysisError::new_err)
    }
}
