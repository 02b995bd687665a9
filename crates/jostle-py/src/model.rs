//! Models: read, checked and assembled once, then shared.

use std::collections::HashMap;
use std::path::PathBuf;

use jostle_io::{Input, InputError, Overrides};
use jostle_run::{Opened, Prepared};
use pyo3::prelude::*;

use crate::base::tree_of;
use crate::describe::describe;
use crate::error::{AnalysisError, argument_error, in_python, input_error, run_error};
use crate::matrices::{Matrices, matrices};
use crate::motion::Motion;
use crate::tools::{Sections, section_answer};

/// A model ready to run.
#[pyclass(frozen, module = "jostle._jostle")]
#[derive(Clone)]
pub(crate) struct Model {
    pub(crate) opened: Opened,
}

impl Model {
    fn assemble(input: Input) -> Result<Self, InputError> {
        let opened = Opened::new(input, "model")?;
        Ok(Self { opened })
    }

    /// The model with its ground motion and steps; `force` runs it even where digits are expected to be lost.
    pub(crate) fn prepare(&self, force: bool) -> PyResult<Prepared> {
        let prepared = self.opened.prepare().map_err(run_error)?;
        if !force {
            let checked = prepared.check_digits(Some("force=True runs it anyway"));
            checked.map_err(|error| input_error(&error))?;
        }
        Ok(prepared)
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
    #[pyo3(signature = (name, text, json, base, lines, files=None))]
    fn read(
        py: Python<'_>,
        name: &str,
        text: &str,
        json: bool,
        base: PathBuf,
        lines: bool,
        files: Option<HashMap<String, String>>,
    ) -> PyResult<Self> {
        let base = (
            name.to_owned(),
            text.to_owned(),
            json,
            base,
            files.unwrap_or_default(),
        );
        let read = || Self::assemble(tree_of(base)?.input()?);
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
    #[pyo3(signature = (gap=None, pga=None, motion=None, record=None, angle=None))]
    fn changed(
        &self,
        py: Python<'_>,
        gap: Option<f64>,
        pga: Option<f64>,
        motion: Option<&Motion>,
        record: Option<String>,
        angle: Option<f64>,
    ) -> PyResult<Self> {
        let mut input = Input::clone(&self.opened.input);
        if let Some(motion) = motion {
            input.replace_motion(motion.spec.clone());
        }
        let other_record = motion.is_none() && (self.opened.other_record || record.is_some());
        input
            .apply(&Overrides {
                pga,
                gap,
                record,
                angle,
            })
            .map_err(|error| argument_error(error.to_string()))?;
        let mut opened = if gap.is_some() {
            py.detach(|| Opened::new(input, &*self.opened.name))
                .map_err(|error| input_error(&error))?
        } else {
            self.opened.with_input(input)
        };
        opened.other_record = other_record;
        Ok(Self { opened })
    }

    #[getter]
    fn title(&self) -> &str {
        &self.opened.input.model.title
    }

    /// The text of the model file.
    #[getter]
    fn text(&self) -> &str {
        self.opened.input.text()
    }

    #[getter]
    fn warnings(&self) -> Vec<String> {
        let warnings = self.opened.input.warnings.iter();
        warnings.map(|text| in_python(text)).collect()
    }

    /// The records that a run may choose from; empty unless there are several.
    #[getter]
    fn records(&self) -> Vec<String> {
        self.opened.input.records().to_vec()
    }

    /// The sampled ground motion; `None` if the model has none.
    fn motion(&self, py: Python<'_>) -> PyResult<Option<Motion>> {
        let Some(spec) = self.opened.input.motion.clone() else {
            return Ok(None);
        };
        // The error of the model's own motion shows its line.
        py.detach(|| Motion::from_spec(spec))
            .map(Some)
            .or_else(|_| self.prepare(true).map(|_| None))
    }

    /// Widths of every gap: one, or one per contact.
    fn widths(&self) -> Vec<Vec<f64>> {
        let gaps = self.opened.input.model.gaps.iter();
        gaps.map(|gap| gap.widths.clone()).collect()
    }

    /// What `jostle check` finds, as JSON.
    fn check(&self, py: Python<'_>) -> PyResult<String> {
        let found = py.detach(|| jostle_run::check(&self.opened));
        let mut found = found.map_err(run_error)?;
        found.text = in_python(&jostle_run::plain(&found.text));
        for texts in [&mut found.warnings, &mut found.notes] {
            texts.iter_mut().for_each(|text| *text = in_python(text));
        }
        serde_json::to_string(&found).map_err(|error| argument_error(error.to_string()))
    }

    /// The accuracy of every solver on the buildings: the text and the page of `jostle method`.
    fn methods(&self, py: Python<'_>) -> PyResult<(String, String)> {
        let surveys = py.detach(|| jostle_run::survey_methods(&self.opened.system));
        let surveys = surveys.map_err(run_error)?;
        let text = jostle_run::plain(&jostle_run::methods_text(&surveys));
        let page = jostle_report::render_method(&self.opened.input.model.title, &surveys);
        Ok((text, page))
    }

    /// Reinforced members: JSON, text and page of `jostle section`.
    fn sections(&self, py: Python<'_>) -> PyResult<Sections> {
        let input = &self.opened.input;
        let found = py.detach(|| jostle_run::sections(input, "the model"));
        Ok(section_answer(
            &input.model.title,
            &found.map_err(run_error)?,
        ))
    }

    /// The script for OpenSeesPy, and how that program differs.
    fn script(&self, py: Python<'_>) -> PyResult<(String, Vec<String>)> {
        let exported = py.detach(|| jostle_run::export_script(&self.opened));
        let exported = exported.map_err(run_error)?;
        Ok((exported.text, exported.remarks))
    }

    /// Writes the matrices of every building into a folder; returns the files, the list of buildings last.
    fn export_matrices(
        &self,
        py: Python<'_>,
        folder: PathBuf,
        force: bool,
    ) -> PyResult<Vec<PathBuf>> {
        py.detach(|| jostle_run::export_matrices(&self.opened, &folder, force))
            .map_err(run_error)
    }

    /// Buildings and gaps as JSON.
    fn describe(&self) -> String {
        describe(&self.opened.input.model, &self.opened.system).to_string()
    }

    /// Masses, stiffness, damping, driven masses and floors of a building, by its index.
    fn matrices<'py>(&self, py: Python<'py>, building: usize) -> PyResult<Matrices<'py>> {
        matrices(py, &self.opened.system, building)
    }

    /// Contacts as (gap, left degree of freedom, right one, width), counted through all buildings; none is a wall.
    fn contacts(&self) -> Vec<(usize, Option<usize>, Option<usize>, f64)> {
        let contacts = self.opened.system.contacts.iter();
        contacts
            .map(|contact| {
                let [left, right] = contact
                    .ports
                    .0
                    .each_ref()
                    .map(|face| face.as_ref().and_then(|f| f.row.only()));
                (contact.gap, left, right, contact.width)
            })
            .collect()
    }

    /// Springs and dampers between buildings as (left degree of freedom, right one, stiffness, damping).
    fn links(&self) -> Vec<(Option<usize>, Option<usize>, f64, f64)> {
        let links = self.opened.system.links.iter();
        links
            .map(|link| {
                let [left, right] = link
                    .ports
                    .0
                    .each_ref()
                    .map(|face| face.as_ref().and_then(|f| f.row.only()));
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
        let title = &self.opened.input.model.title;
        py.detach(|| {
            jostle_run::pushover_json(
                title,
                &self.opened.system,
                building,
                pattern,
                direction,
                drift,
            )
        })
        .map_err(|error| argument_error(error.to_string()))
    }

    /// Natural modes as the JSON of `jostle modes`.
    fn modes(&self, py: Python<'_>, count: usize) -> PyResult<String> {
        let system = &self.opened.system;
        let listed = py.detach(|| jostle_run::list_modes(system, count));
        listed
            .map(|listed| jostle_run::modes_json(&listed, count).to_string())
            .map_err(|error| AnalysisError::new_err(error.to_string()))
    }
}
