//! One analysis with the GIL released, and its results.

use std::ops::ControlFlow;
use std::path::PathBuf;
use std::time::{Duration, Instant};

use jostle::method::MethodSurvey;
use jostle::stepping::Progress;
use jostle::{Column, Pounding, RunEnd, Settings, Summary};
use jostle_io::{
    building_columns, capacity_columns, floor_columns, floor_spectra_columns, history_names,
    impact_columns, member_columns, member_history_columns, summary_json, write_atomically,
};
use jostle_run::{
    Content, FileKind, Paper, Ran, Results, STORAGE, Stage, earlier_files, find_chromium,
    may_write, print_pdf, survey_methods,
};
use numpy::PyArray2;
use pyo3::exceptions::PyKeyboardInterrupt;
use pyo3::prelude::*;

use crate::error::{
    AnalysisError, argument_error, in_python, input_error, output_error, run_error,
};
use crate::histories::Histories;
use crate::model::Model;
use crate::table::Table;

/// Interval at which a run checks for Ctrl-C and reports progress.
const LOOK_UP: Duration = Duration::from_millis(50);

/// A finished run: summary and histories.
#[pyclass(frozen, module = "jostle._jostle")]
pub(crate) struct Run {
    /// The outcome is without its histories.
    ran: Ran,
    histories: Histories,
    interrupted: bool,
}

/// Runs a model from rest. `observer` is called with the current and the final time, a few times per second. `apart`: a run without
/// contact follows, so that bounds of bearings are run without it as well.
#[pyfunction]
#[pyo3(signature = (model, pounding=true, record_interval=None, force=false, observer=None, sensitivity=false, apart=false))]
#[allow(
    clippy::too_many_arguments,
    reason = "they are those of the Python function"
)]
pub(crate) fn run(
    py: Python<'_>,
    model: &Model,
    pounding: bool,
    record_interval: Option<f64>,
    force: bool,
    observer: Option<Py<PyAny>>,
    sensitivity: bool,
    apart: bool,
) -> PyResult<Run> {
    let prepared = py.detach(|| model.prepare(force))?;
    let settings = Settings {
        pounding: if pounding {
            Pounding::Included
        } else {
            Pounding::Excluded
        },
        record_interval,
        storage: STORAGE,
    };
    if !force {
        let remedy = Some("a longer record_interval needs less, and force=True runs it anyway");
        let checked = prepared.check_histories(settings, false, remedy);
        checked.map_err(|error| input_error(&error))?;
    }
    let mut stopped: Option<PyErr> = None;
    let mut looked = Instant::now();
    let mut look_up = |stage: Stage, progress: Progress| {
        if looked.elapsed() < LOOK_UP {
            return ControlFlow::Continue(());
        }
        looked = Instant::now();
        // The time of the runs for sensitivity would begin at zero again.
        let observer = observer.as_ref();
        let observer =
            observer.filter(|_| matches!(stage, Stage::Pounding | Stage::WithoutContact));
        match Python::attach(|py| heed(py, observer, progress)) {
            Ok(()) => ControlFlow::Continue(()),
            Err(error) => {
                stopped = Some(error);
                ControlFlow::Break(())
            }
        }
    };
    let mut ran = py.detach(|| {
        let mut ran = prepared.run(settings, &mut look_up);
        if sensitivity && pounding {
            ran.run_other_contacts(&mut look_up);
        }
        if pounding {
            ran.run_isolation_bounds(apart, &mut look_up);
        }
        ran
    });
    let interrupted = match stopped {
        Some(error) if error.is_instance_of::<PyKeyboardInterrupt>(py) => true,
        Some(error) => return Err(error),
        None => false,
    };
    Ok(Run {
        histories: Histories::new(ran.outcome.history.take()),
        ran,
        interrupted,
    })
}

/// Lets Ctrl-C and the observer stop a run.
fn heed(py: Python<'_>, observer: Option<&Py<PyAny>>, progress: Progress) -> PyResult<()> {
    py.check_signals()?;
    if let Some(observer) = observer {
        observer.call1(py, (progress.time, progress.duration))?;
    }
    Ok(())
}

impl Run {
    fn summary(&self, without_contact: Option<&Self>) -> Summary {
        let without = without_contact.filter(|run| run.ran.outcome.end == RunEnd::Completed);
        let without_contact = without_contact.map(|run| &run.ran.outcome);
        let Ran {
            prepared,
            outcome,
            wall,
            ..
        } = &self.ran;
        let mut summary = prepared.summary(outcome, without_contact, *wall);
        self.ran.add_variants(&mut summary);
        let spectra = without.and_then(|run| run.ran.floor_spectra.as_ref());
        self.ran.add_floor_spectra(&mut summary, spectra);
        summary
    }

    /// Shows what the files of the run are written from to a function, with the interpreter free for others.
    fn with_results<T: Send>(
        &self,
        py: Python<'_>,
        without_contact: Option<&Self>,
        methods: &[MethodSurvey],
        show: impl FnOnce(&Results<'_>) -> T + Send,
    ) -> T {
        let history = &self.histories.history;
        let without = without_contact
            .filter(|run| run.ran.outcome.end == RunEnd::Completed)
            .map(|run| &run.histories.history)
            .filter(|history| !history.columns().is_empty());
        let summary = self.summary(without_contact);
        py.detach(|| {
            show(&Results {
                prepared: &self.ran.prepared,
                outcome: &self.ran.outcome,
                summary: &summary,
                history: Some(history),
                without_contact: without,
                methods,
            })
        })
    }
}

impl Run {
    /// The accuracy of every solver on the buildings, if it is wanted.
    fn methods(&self, py: Python<'_>, wanted: bool) -> PyResult<Vec<MethodSurvey>> {
        if !wanted {
            return Ok(Vec::new());
        }
        let system = &self.ran.prepared.system;
        py.detach(|| survey_methods(system)).map_err(run_error)
    }
}

#[pymethods]
impl Run {
    #[getter]
    fn interrupted(&self) -> bool {
        self.interrupted
    }

    #[getter]
    fn completed(&self) -> bool {
        self.ran.outcome.end == RunEnd::Completed
    }

    /// Why the analysis failed, if it did.
    #[getter]
    fn failure(&self) -> Option<String> {
        match &self.ran.outcome.end {
            RunEnd::Failed(error) => Some(error.to_string()),
            RunEnd::Completed | RunEnd::Stopped => None,
        }
    }

    /// The warning if the run is expected to lose digits.
    #[getter]
    fn warning(&self) -> Option<String> {
        self.ran.prepared.lost_digits().as_deref().map(in_python)
    }

    /// Warnings about the results.
    #[getter]
    fn doubts(&self) -> Vec<String> {
        let warnings = self.summary(None).warnings;
        warnings.iter().map(|text| in_python(text)).collect()
    }

    /// One row per recorded quantity.
    #[getter]
    fn histories(&self, py: Python<'_>) -> PyResult<Py<PyArray2<f64>>> {
        self.histories.table(py)
    }

    /// Meaning of the rows: owner and name of the quantity, index of the building, contact or link, and floor.
    #[getter]
    fn rows(&self) -> Vec<(&'static str, &'static str, usize, usize)> {
        let row = |column: &Column| {
            let (recorded, [index, floor]) = (column.recorded(), column.place());
            (recorded.owner, recorded.name, index, floor)
        };
        self.histories.history.columns().iter().map(row).collect()
    }

    /// The text of summary.json.
    #[pyo3(signature = (without_contact=None))]
    fn summary_json(&self, without_contact: Option<&Self>) -> String {
        summary_json(&self.summary(without_contact))
    }

    /// The summary as the command line prints it.
    #[pyo3(signature = (without_contact=None))]
    fn text(&self, without_contact: Option<&Self>) -> String {
        jostle_run::summary_text(&self.summary(without_contact), &self.ran.prepared.input)
    }

    /// The verdict in a sentence or two.
    fn verdict(&self) -> String {
        jostle_report::verdict(&self.summary(None))
    }

    /// The report page; `method` adds the accuracy of every solver.
    #[pyo3(signature = (without_contact=None, method=false))]
    fn report(
        &self,
        py: Python<'_>,
        without_contact: Option<&Self>,
        method: bool,
    ) -> PyResult<String> {
        let methods = self.methods(py, method)?;
        let report = self.with_results(py, without_contact, &methods, |results| results.report());
        Ok(report.unwrap_or_default())
    }

    /// Writes a page to a file completely or not at all; replaces pages of jostle, and other files only with `force`.
    #[staticmethod]
    #[pyo3(signature = (path, text, force=false))]
    fn write(py: Python<'_>, path: PathBuf, text: &str, force: bool) -> PyResult<()> {
        may_write(&path, Some(FileKind::REPORT), force).map_err(run_error)?;
        py.detach(|| write_atomically(&path, text.as_bytes()))
            .map_err(|error| output_error(&error))
    }

    /// Writes the numbers as an Excel workbook, completely or not at all; replaces workbooks of jostle, and other files only
    /// with `force`.
    #[pyo3(signature = (path, without_contact=None, force=false))]
    fn workbook(
        &self,
        py: Python<'_>,
        path: PathBuf,
        without_contact: Option<&Self>,
        force: bool,
    ) -> PyResult<()> {
        may_write(&path, Some(FileKind::WORKBOOK), force).map_err(run_error)?;
        let summary = self.summary(without_contact);
        let bytes = py.detach(|| jostle_run::workbook(&summary));
        let bytes = bytes.map_err(AnalysisError::new_err)?;
        py.detach(|| write_atomically(&path, &bytes))
            .map_err(|error| output_error(&error))
    }

    /// Prints a page to a PDF file by a Chromium of this machine.
    #[staticmethod]
    #[pyo3(signature = (path, page, paper, force=false))]
    fn print(py: Python<'_>, path: PathBuf, page: &str, paper: &str, force: bool) -> PyResult<()> {
        let size = Paper::from_name(paper).ok_or_else(|| {
            let known = Paper::NAMES.join(", ");
            argument_error(format!("paper: expected one of {known}, found {paper:?}"))
        })?;
        may_write(&path, Some(FileKind::PDF), force).map_err(run_error)?;
        let chromium = find_chromium().map_err(|error| argument_error(error.to_string()))?;
        py.detach(|| print_pdf(&chromium, page, &path, size))
            .map_err(run_error)
    }

    /// Raises `FileExistsError` if a folder contains files with names of results that jostle did not write.
    #[staticmethod]
    #[pyo3(signature = (folder, force=false))]
    fn check_folder(folder: PathBuf, force: bool) -> PyResult<()> {
        earlier_files(&folder, force).map(drop).map_err(run_error)
    }

    /// Writes summary, tables and report into a folder that exists and was checked.
    #[pyo3(signature = (folder, report, without_contact=None, method=false))]
    fn save(
        &self,
        py: Python<'_>,
        folder: PathBuf,
        report: bool,
        without_contact: Option<&Self>,
        method: bool,
    ) -> PyResult<()> {
        let methods = self.methods(py, method)?;
        let content = Content {
            tables: true,
            report,
        };
        self.with_results(py, without_contact, &methods, |results| {
            results.write(&folder, content)
        })
        .map_err(|error| output_error(&error))
    }

    /// The histories as a table, columns as in history.parquet.
    fn history_table(&self, py: Python<'_>) -> PyResult<Table> {
        let names = history_names(
            &self.ran.prepared.input.model,
            &self.summary(None),
            self.histories.history.columns(),
        );
        Ok(Table::of_histories(names, self.histories.table(py)?))
    }

    /// Response spectra of floors as a table; `None` if they were not asked for.
    #[pyo3(signature = (without_contact=None))]
    fn floor_spectra_table(&self, without_contact: Option<&Self>) -> Option<Table> {
        let found = self.summary(without_contact).floor_spectra?;
        Some(Table::of_columns(floor_spectra_columns(&found)))
    }

    /// Peaks of buildings as a table, columns as in buildings.parquet.
    #[pyo3(signature = (without_contact=None))]
    fn building_table(&self, without_contact: Option<&Self>) -> Table {
        Table::of_columns(building_columns(&self.summary(without_contact)))
    }

    /// Peaks of floors as a table, columns as in floors.parquet.
    #[pyo3(signature = (without_contact=None))]
    fn floor_table(&self, without_contact: Option<&Self>) -> Table {
        Table::of_columns(floor_columns(&self.summary(without_contact)))
    }

    /// Greatest forces of columns and beams as a table, of one building or of all.
    #[pyo3(signature = (building=None))]
    fn member_table(&self, building: Option<usize>) -> Table {
        Table::of_columns(member_columns(&self.summary(None), building))
    }

    /// Demands over capacities as a table, columns as in capacity.parquet, of one building or of all.
    #[pyo3(signature = (building=None))]
    fn capacity_table(&self, building: Option<usize>) -> Table {
        Table::of_columns(capacity_columns(&self.summary(None), building))
    }

    /// Histories of members as a table, columns as in members.parquet; `None` if no member was named.
    fn member_history_table(&self) -> Option<Table> {
        let history = self.ran.outcome.member_history.as_ref()?;
        let columns = member_history_columns(&self.ran.prepared.system, history);
        Some(Table::of_columns(columns))
    }

    /// The impacts as a table, columns as in impacts.parquet.
    fn impact_table(&self) -> Table {
        Table::of_columns(impact_columns(&self.summary(None)))
    }
}
