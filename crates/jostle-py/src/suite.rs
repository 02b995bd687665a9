//! Suites of records, with the GIL released.

use std::path::PathBuf;
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::{Mutex, PoisonError};
use std::time::Duration;

use jostle_study::suite::GoverningRule;
use jostle_study::suite::{SuiteOptions, SuiteProgress, SuiteResults, earlier_suite_files};
use pyo3::exceptions::PyKeyboardInterrupt;
use pyo3::prelude::*;

use crate::error::{AnalysisError, argument_error, run_error};
use crate::model::Model;
use crate::table::Table;

/// Interval at which a suite checks for Ctrl-C and reports progress.
const LOOK_UP: Duration = Duration::from_millis(50);

/// Results of a suite.
#[pyclass(frozen, module = "jostle._jostle")]
pub(crate) struct Suite(SuiteResults);

/// Runs a model under every one of its records. `observer` is called with the share that is done and 1.
#[pyfunction]
#[pyo3(signature = (model, folder=None, governing=None, report=true, sensitivity=false, jobs=None, force=false, observer=None))]
#[allow(
    clippy::too_many_arguments,
    reason = "they are those of the Python function"
)]
pub(crate) fn run_suite(
    py: Python<'_>,
    model: &Model,
    folder: Option<PathBuf>,
    governing: Option<&str>,
    report: bool,
    sensitivity: bool,
    jobs: Option<usize>,
    force: bool,
    observer: Option<Py<PyAny>>,
) -> PyResult<Suite> {
    let rule = match governing {
        Some(name) => Some(GoverningRule::from_name(name).ok_or_else(|| {
            argument_error(format!(
                "governing: expected one of {}, found {name:?}",
                GoverningRule::NAMES.join(", ")
            ))
        })?),
        None => None,
    };
    let count = model.opened.input.records().len();
    if count < 2 {
        return Err(argument_error(
            "a suite needs a model with several records, motion={\"record\": [\"a.at2\", \"b.at2\"]}; run takes one",
        ));
    }
    let suite = py.detach(|| jostle_study::suite::Suite::new(&model.opened, rule));
    let suite = suite.map_err(run_error)?;
    if let Some(folder) = &folder {
        earlier_suite_files(&suite, folder, force).map_err(run_error)?;
    }
    let options = SuiteOptions {
        report,
        sensitivity,
        jobs,
    };
    let halt = AtomicBool::new(false);
    let latest: Mutex<Option<SuiteProgress>> = Mutex::new(None);
    let mut stopped: Option<PyErr> = None;
    let done = py.detach(|| {
        std::thread::scope(|scope| {
            let work = scope.spawn(|| {
                let stop = || halt.load(Ordering::Relaxed);
                let note = |progress: SuiteProgress| {
                    *latest.lock().unwrap_or_else(PoisonError::into_inner) = Some(progress);
                };
                suite.run(folder.as_deref(), &options, &stop, &note)
            });
            // Signals reach Python in its own thread only.
            while !work.is_finished() {
                std::thread::sleep(LOOK_UP / 10);
                if stopped.is_some() {
                    continue;
                }
                let progress = *latest.lock().unwrap_or_else(PoisonError::into_inner);
                if let Err(error) = Python::attach(|py| heed(py, observer.as_ref(), progress)) {
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
    let done = done.map_err(|_| AnalysisError::new_err("the suite failed inside"))?;
    let done = done.map_err(|error| argument_error(error.to_string()))?;
    done.results
        .map(Suite)
        .ok_or_else(|| PyKeyboardInterrupt::new_err(()))
}

/// Lets Ctrl-C and the observer stop a suite.
fn heed(
    py: Python<'_>,
    observer: Option<&Py<PyAny>>,
    progress: Option<SuiteProgress>,
) -> PyResult<()> {
    py.check_signals()?;
    if let (Some(observer), Some(progress)) = (observer, progress) {
        observer.call1(py, (progress.share, 1.0))?;
    }
    Ok(())
}

#[pymethods]
impl Suite {
    /// The text of suite.json.
    fn json(&self) -> String {
        self.0.json()
    }

    /// The summary of a record as the text of its summary.json, by its number from 0.
    fn record_json(&self, record: usize) -> PyResult<String> {
        let found = self.0.records.get(record);
        found
            .map(|record| record.text.clone())
            .ok_or_else(|| argument_error(format!("there is no record {record}")))
    }

    /// One row per record.
    fn table(&self) -> Table {
        Table::of_columns(self.0.columns())
    }

    /// One row per quantity.
    fn statistics(&self) -> Table {
        Table::of_columns(self.0.statistics_columns())
    }

    /// The suite as the command line prints it.
    fn text(&self) -> String {
        self.0.plain_text()
    }
}
