//! Studies of many cases, and the smallest gap, with the GIL released.

use std::collections::HashMap;
use std::path::PathBuf;
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::{Arc, Mutex, PoisonError};
use std::time::Duration;

use jostle::separation::{Code, JointSystem};
use jostle_io::{InputError, StudyFile};
use jostle_study::dataset::{missing_parts, read_columns};
use jostle_study::{GapError, GapSettings, Incidence, Progress, RunSettings, StudyError};
use pyo3::exceptions::PyKeyboardInterrupt;
use pyo3::prelude::*;

use crate::base::{Base, format_of, tree_of};
use crate::error::{AnalysisError, argument_error, in_python, input_error, study_error};
use crate::model::Model;
use crate::watch::watched;

/// Interval at which a study checks for Ctrl-C and reports progress.
const LOOK_UP: Duration = Duration::from_millis(50);

/// A study, checked against its models.
#[pyclass(frozen, module = "jostle._jostle")]
#[derive(Clone)]
pub(crate) struct Study(Arc<jostle_study::Study>);

/// Numbers and texts of columns.
type Columns = (
    HashMap<String, Vec<Option<f64>>>,
    HashMap<String, Vec<String>>,
);

#[pymethods]
impl Study {
    /// Reads the text of a study file; `base` is name, text, whether it is JSON, and folder of another base model.
    #[staticmethod]
    #[pyo3(signature = (name, text, json, folder, base=None, any_build=false))]
    fn read(
        py: Python<'_>,
        name: &str,
        text: &str,
        json: bool,
        folder: PathBuf,
        base: Option<Base>,
        any_build: bool,
    ) -> PyResult<Self> {
        py.detach(|| {
            let file = base
                .map(tree_of)
                .transpose()
                .and_then(|base| StudyFile::parse(name, text, format_of(json), &folder, base));
            let study = file
                .map_err(|error: InputError| StudyError::from(error))
                .and_then(jostle_study::Study::new);
            study.map(|mut study| {
                study.any_build = any_build;
                Self(Arc::new(study))
            })
        })
        .map_err(|error| study_error(&error))
    }

    #[getter]
    fn title(&self) -> &str {
        &self.0.file.title
    }

    #[getter]
    fn warnings(&self) -> Vec<String> {
        self.0.warnings.iter().map(|text| in_python(text)).collect()
    }

    /// What varies, in sentences.
    #[getter]
    fn varied(&self) -> Vec<String> {
        let varied = jostle_study::varied(&self.0).into_iter();
        varied.map(|one| one.text().to_string()).collect()
    }

    #[getter]
    fn cases(&self) -> u64 {
        self.0.design.cases
    }

    #[getter]
    fn parts(&self) -> u64 {
        self.0.parts()
    }

    #[getter]
    fn columns(&self) -> Vec<String> {
        self.0
            .layout
            .names()
            .into_iter()
            .map(str::to_owned)
            .collect()
    }

    #[getter]
    fn seed(&self) -> u64 {
        self.0.file.design.seed
    }

    /// Numbers of the parts missing in a folder: unfinished, damaged, or of another study.
    fn missing(&self, py: Python<'_>, folder: PathBuf) -> Vec<u64> {
        py.detach(|| missing_parts(&self.0, &folder))
    }

    /// Makes the folder ready for this study, or makes sure that it holds this one.
    fn settle(&self, py: Python<'_>, folder: PathBuf) -> PyResult<()> {
        py.detach(|| jostle_study::settle(&self.0, &folder))
            .map_err(|error| study_error(&error))
    }

    /// Runs the unfinished cases, of the part `only` alone if it is given; returns cases finished, cases computed, cases to finish, failed cases, and whether
    /// every part of the whole study is there. `remark` is called with remarks about the folder.
    #[pyo3(signature = (folder, jobs=None, shard=0, shards=1, observer=None, remark=None, only=None))]
    #[allow(
        clippy::too_many_arguments,
        reason = "they are those of the Python function"
    )]
    fn run(
        &self,
        py: Python<'_>,
        folder: PathBuf,
        jobs: Option<usize>,
        shard: u64,
        shards: u64,
        observer: Option<Py<PyAny>>,
        remark: Option<Py<PyAny>>,
        only: Option<u64>,
    ) -> PyResult<(u64, u64, u64, u64, bool)> {
        let study = Arc::clone(&self.0);
        let settings = RunSettings {
            jobs,
            shard,
            shards,
            only,
        };
        let remarks: Mutex<Vec<String>> = Mutex::default();
        let done = watched(py, observer.as_ref(), |watch| {
            let keep = |text: &str| {
                let mut remarks = remarks.lock().unwrap_or_else(PoisonError::into_inner);
                remarks.push(text.to_owned());
            };
            let note =
                |progress: Progress| watch.note(progress.finished as f64, progress.cases as f64);
            jostle_study::run(&study, &folder, &settings, &|| watch.stops(), &note, &keep)
        });
        if let Some(remark) = remark {
            for text in remarks.into_inner().unwrap_or_else(PoisonError::into_inner) {
                remark.call1(py, (text,))?;
            }
        }
        let done = done?.map_err(|error| study_error(&error))?;
        let Progress {
            finished,
            computed,
            cases,
        } = done.progress;
        Ok((finished, computed, cases, done.failed, done.complete))
    }

    /// Writes the report and its tables.
    #[pyo3(signature = (folder, csv=false))]
    fn finish(&self, py: Python<'_>, folder: PathBuf, csv: bool) -> PyResult<String> {
        py.detach(|| jostle_study::finish(&self.0, &folder, csv))
            .map_err(|error| study_error(&error))
    }

    /// Columns of the finished table.
    fn read_columns(
        &self,
        py: Python<'_>,
        folder: PathBuf,
        names: Vec<String>,
    ) -> PyResult<Columns> {
        let names: Vec<&str> = names.iter().map(|name| &name[..]).collect();
        let table = py
            .detach(|| read_columns(&self.0, &folder, &names))
            .map_err(|error| study_error(&error))?;
        Ok((
            table.numbers.into_iter().collect(),
            table.texts.into_iter().collect(),
        ))
    }

    /// Runs one case with its histories into a folder.
    fn run_case(&self, py: Python<'_>, case: u64, folder: PathBuf) -> PyResult<()> {
        if case >= self.0.design.cases {
            return Err(argument_error(format!(
                "case: there is no case {case}; there are {}, counted from 0",
                self.0.design.cases
            )));
        }
        py.detach(|| jostle_study::run_case(&self.0, case, &folder, &|| false))
            .map_err(|error| study_error(&error))?;
        Ok(())
    }
}

/// Text of the study of the angle of incidence of a model, and what should be known about it. Angles are in degrees.
#[pyfunction]
pub(crate) fn incidence(
    py: Python<'_>,
    base: Base,
    start: f64,
    stop: f64,
    step: f64,
    quantities: Vec<String>,
) -> PyResult<(String, Vec<String>)> {
    // 30°, not 30.000000000000004°.
    let rounded = |degrees: f64| (degrees * 1e9).round() / 1e9;
    let wanted = Incidence {
        from: rounded(start),
        to: rounded(stop),
        step: rounded(step),
        quantities,
    };
    if let Err(problem) = wanted.angles() {
        return Err(argument_error(format!("start, stop, step: {problem}")));
    }
    py.detach(|| jostle_study::incidence(tree_of(base)?, &wanted))
        .map(|(file, notes)| (file.text().to_owned(), notes))
        .map_err(|error| input_error(&error))
}

/// Text of a ready-made study of a model, and what it leaves out and why.
#[pyfunction]
pub(crate) fn ready_made(
    py: Python<'_>,
    name: &str,
    base: Base,
) -> PyResult<(String, Vec<String>)> {
    py.detach(|| jostle_study::ready_made(name, Some(tree_of(base)?)))
        .map(|(file, notes)| (file.text().to_owned(), notes))
        .map_err(|error| input_error(&error))
}

/// Names of the ready-made studies.
#[pyfunction]
pub(crate) fn ready_made_names() -> Vec<&'static str> {
    jostle_study::ready_made_names()
}

/// The smallest gaps without pounding, as the JSON of `jostle gap`.
#[pyfunction]
pub(crate) fn critical_gaps(
    py: Python<'_>,
    model: &Model,
    tolerance: f64,
    system: Option<&str>,
    codes: Vec<String>,
    outcomes: bool,
    curve: usize,
) -> PyResult<String> {
    let system = match system {
        None => None,
        Some(name) => Some(JointSystem::named(name).ok_or_else(|| {
            let names = JointSystem::ALL.map(JointSystem::name).join(", ");
            argument_error(format!("system: expected one of {names}, found {name:?}"))
        })?),
    };
    let mut shown = Vec::new();
    for name in codes {
        shown.push(Code::named(&name).ok_or_else(|| {
            let names = Code::ALL.map(Code::name).join(", ");
            argument_error(format!("codes: expected some of {names}, found {name:?}"))
        })?);
    }
    if !(tolerance.is_finite() && tolerance >= 1e-9) {
        return Err(argument_error("tolerance: must be at least 1e-9 m"));
    }
    let prepared = model.prepare(false)?;
    let mut inputs = prepared.input.codes.clone();
    if let Some(system) = system {
        inputs.system = Some(system);
    }
    if !shown.is_empty() {
        inputs.shown = shown;
    }
    let settings = GapSettings {
        tolerance,
        codes: inputs,
        outcomes,
        reversed: true,
        curve,
    };
    let halt = AtomicBool::new(false);
    let mut stopped: Option<PyErr> = None;
    let found = py.detach(|| {
        std::thread::scope(|scope| {
            let work = scope.spawn(|| {
                let stop = || halt.load(Ordering::Relaxed);
                let (model, motion) = (&prepared.input.model, &prepared.motion);
                jostle_study::critical_gaps(model, motion, &settings, &stop)
            });
            while !work.is_finished() {
                std::thread::sleep(LOOK_UP / 10);
                if stopped.is_none()
                    && let Err(error) = Python::attach(|py| py.check_signals())
                {
                    stopped = Some(error);
                    halt.store(true, Ordering::Relaxed);
                }
            }
            work.join()
        })
    });
    if let Some(error) = stopped {
        return Err(error);
    }
    let found = found.map_err(|_| AnalysisError::new_err("the search failed inside"))?;
    let gaps = found.map_err(|error| match error {
        GapError::Stopped => PyKeyboardInterrupt::new_err(()),
        GapError::Run(_) => AnalysisError::new_err(error.to_string()),
        _ => input_error(&prepared.input.fault("gap", error.to_string())),
    })?;
    serde_json::to_string(&gaps).map_err(|error| AnalysisError::new_err(error.to_string()))
}
