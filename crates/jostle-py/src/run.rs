//! One analysis, with the interpreter free for others, and what it leaves behind.

use std::ops::ControlFlow;
use std::path::PathBuf;
use std::time::{Duration, Instant};

use jostle::stepping::{Progress, find_sensitivity};
use jostle::{
    Column, EnergyTerm, GroundMotion, Outcome, Plan, Pounding, RunEnd, Settings, Summary, simulate,
};
use jostle_io::{
    history_names, impact_columns, member_columns, member_history_columns, summary_json,
    write_atomically, write_history_parquet, write_impacts_parquet, write_members_parquet,
    write_summary_json,
};
use jostle_report::Page;
use numpy::PyArray2;
use pyo3::exceptions::{PyFileExistsError, PyKeyboardInterrupt};
use pyo3::prelude::*;

use crate::error::output_error;
use crate::histories::Histories;
use crate::model::Model;
use crate::table::Table;

/// How often a run looks for Ctrl-C and reports its progress.
const LOOK_UP: Duration = Duration::from_millis(50);

/// A finished run: its numbers and its histories.
#[pyclass(frozen, module = "jostle._jostle")]
pub(crate) struct Run {
    model: Model,
    motion: GroundMotion,
    plan: Plan,
    /// Without its histories.
    outcome: Outcome,
    wall: f64,
    histories: Histories,
    interrupted: bool,
    warning: Option<String>,
}

/// Runs a model from rest. `observer` is called with the time reached and the time to reach, a few times a second.
#[pyfunction]
#[pyo3(signature = (model, pounding=true, record_interval=None, force=false, observer=None))]
pub(crate) fn run(
    py: Python<'_>,
    model: &Model,
    pounding: bool,
    record_interval: Option<f64>,
    force: bool,
    observer: Option<Py<PyAny>>,
) -> PyResult<Run> {
    let model = model.clone();
    let (motion, plan, warning) = py.detach(|| model.plan(force))?;
    let settings = Settings {
        pounding: if pounding {
            Pounding::Included
        } else {
            Pounding::Excluded
        },
        record_interval,
    };
    let mut stopped: Option<PyErr> = None;
    let mut interrupted_later: Option<PyErr> = None;
    let mut looked = Instant::now();
    let look_up = |progress: Progress| {
        if looked.elapsed() < LOOK_UP {
            return ControlFlow::Continue(());
        }
        looked = Instant::now();
        match Python::attach(|py| heed(py, observer.as_ref(), progress)) {
            Ok(()) => ControlFlow::Continue(()),
            Err(error) => {
                stopped = Some(error);
                ControlFlow::Break(())
            }
        }
    };
    let (mut outcome, wall) = py.detach(|| {
        let started = Instant::now();
        let mut outcome = simulate(&model.system, &motion, &plan, settings, look_up);
        let wall = started.elapsed().as_secs_f64();
        find_sensitivity(
            &model.system,
            &motion,
            &plan,
            &mut outcome,
            |_| match Python::attach(|py| py.check_signals()) {
                Ok(()) => ControlFlow::Continue(()),
                Err(error) => {
                    interrupted_later = Some(error);
                    ControlFlow::Break(())
                }
            },
        );
        (outcome, wall)
    });
    let interrupted = match stopped.or(interrupted_later) {
        Some(error) if error.is_instance_of::<PyKeyboardInterrupt>(py) => true,
        Some(error) => return Err(error),
        None => false,
    };
    Ok(Run {
        histories: Histories::new(outcome.history.take()),
        model,
        motion,
        plan,
        outcome,
        wall,
        interrupted,
        warning,
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
        let twin = without_contact.map(|run| &run.outcome);
        let mut summary = Summary::of(&jostle::Run {
            model: &self.model.input.model,
            system: &self.model.system,
            motion: &self.motion,
            plan: &self.plan,
            outcome: &self.outcome,
            without_contact: twin.filter(|twin| twin.end == RunEnd::Completed),
            wall: self.wall,
        });
        self.model.input.add_notes(&mut summary);
        summary
    }

    fn page(&self, py: Python<'_>, without_contact: Option<&Self>) -> PyResult<String> {
        let history = self.histories.history(py)?;
        let without = without_contact
            .filter(|run| run.outcome.end == RunEnd::Completed && !run.histories.columns.is_empty())
            .map(|run| run.histories.history(py))
            .transpose()?;
        let summary = self.summary(without_contact);
        Ok(py.detach(|| {
            jostle_report::render(&Page {
                methods: &[],
                model: &self.model.input.model,
                motion: &self.motion,
                summary: &summary,
                history: &history,
                without_contact: without.as_ref(),
                springs: self.outcome.spring_history.as_ref(),
                sections: &[],
            })
        }))
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
        self.outcome.end == RunEnd::Completed
    }

    /// Why the analysis failed, if it did.
    #[getter]
    fn failure(&self) -> Option<String> {
        match &self.outcome.end {
            RunEnd::Failed(error) => Some(error.to_string()),
            RunEnd::Completed | RunEnd::Stopped => None,
        }
    }

    /// What was run although it is expected to lose digits, if so.
    #[getter]
    fn warning(&self) -> Option<String> {
        self.warning.clone()
    }

    /// Reasons not to trust the numbers.
    #[getter]
    fn doubts(&self) -> Vec<String> {
        self.summary(None).warnings
    }

    /// One row per recorded quantity.
    #[getter]
    fn histories(&self, py: Python<'_>) -> PyResult<Py<PyArray2<f64>>> {
        self.histories.table(py)
    }

    /// What the rows are: kind, index of the building, contact or energy term, and floor.
    #[getter]
    fn rows(&self) -> Vec<(&'static str, usize, usize)> {
        let row = |column: &Column| match *column {
            Column::Time => ("time", 0, 0),
            Column::GroundAcceleration => ("ground_acceleration", 0, 0),
            Column::Displacement { building, floor } => ("displacement", building, floor),
            Column::Velocity { building, floor } => ("velocity", building, floor),
            Column::TotalAcceleration { building, floor } => {
                ("total_acceleration", building, floor)
            }
            Column::ContactForce { contact } => ("force", contact, 0),
            Column::LinkForce { link } => ("link", link, 0),
            Column::Energy(term) => (energy_name(term), 0, 0),
        };
        self.histories.columns.iter().map(row).collect()
    }

    /// The text of summary.json.
    #[pyo3(signature = (without_contact=None))]
    fn summary_json(&self, without_contact: Option<&Self>) -> String {
        summary_json(&self.summary(without_contact))
    }

    /// The summary as the command line prints it.
    #[pyo3(signature = (without_contact=None))]
    fn text(&self, without_contact: Option<&Self>) -> String {
        jostle_cli::summary_text(&self.summary(without_contact))
    }

    /// What happened, in a sentence or two.
    fn verdict(&self) -> String {
        jostle_report::verdict(&self.summary(None))
    }

    /// The report page.
    #[pyo3(signature = (without_contact=None))]
    fn report(&self, py: Python<'_>, without_contact: Option<&Self>) -> PyResult<String> {
        self.page(py, without_contact)
    }

    /// Writes a page to a file, whole or not at all; replaces pages of jostle, and everything else only with `force`.
    #[staticmethod]
    #[pyo3(signature = (path, text, force=false))]
    fn write(py: Python<'_>, path: PathBuf, text: &str, force: bool) -> PyResult<()> {
        jostle_cli::may_replace_report(&path, force).map_err(must_stay)?;
        py.detach(|| write_atomically(&path, text.as_bytes()))
            .map_err(|error| output_error(&error))
    }

    /// Raises `FileExistsError` if a folder holds files with the names of results that no run wrote.
    #[staticmethod]
    #[pyo3(signature = (folder, force=false))]
    fn check_folder(folder: PathBuf, force: bool) -> PyResult<()> {
        jostle_cli::may_replace_run(&folder, force).map_err(must_stay)
    }

    /// Writes summary, tables and report into a folder that exists and was checked.
    #[pyo3(signature = (folder, report, without_contact=None))]
    fn save(
        &self,
        py: Python<'_>,
        folder: PathBuf,
        report: bool,
        without_contact: Option<&Self>,
    ) -> PyResult<()> {
        let page = report.then(|| self.page(py, without_contact)).transpose()?;
        let history = self.histories.history(py)?;
        let (summary, model) = (self.summary(without_contact), &self.model.input.model);
        py.detach(|| {
            if !history.columns().is_empty() {
                let path = folder.join("history.parquet");
                write_history_parquet(&path, model, &summary, &history)?;
            }
            write_impacts_parquet(&folder.join("impacts.parquet"), &summary)?;
            if let Some(members) = &self.outcome.member_history {
                let path = folder.join("members.parquet");
                write_members_parquet(&path, &self.model.system, members, &summary)?;
            }
            if let Some(page) = page {
                write_atomically(&folder.join("report.html"), page.as_bytes())?;
            }
            write_summary_json(&folder.join("summary.json"), &summary)
        })
        .map_err(|error| output_error(&error))
    }

    /// The histories as a table, columns as in history.parquet.
    fn history_table(&self, py: Python<'_>) -> PyResult<Table> {
        let names = history_names(
            &self.model.input.model,
            &self.summary(None),
            &self.histories.columns,
        );
        Ok(Table::of_histories(names, self.histories.table(py)?))
    }

    /// Greatest forces of columns and beams as a table, of one building or of all.
    #[pyo3(signature = (building=None))]
    fn member_table(&self, building: Option<usize>) -> Table {
        Table::of_columns(member_columns(&self.summary(None), building))
    }

    /// Histories of members as a table, columns as in members.parquet; `None` if no member was named.
    fn member_history_table(&self) -> Option<Table> {
        let history = self.outcome.member_history.as_ref()?;
        let columns = member_history_columns(&self.model.system, history);
        Some(Table::of_columns(columns))
    }

    /// The impacts as a table, columns as in impacts.parquet.
    fn impact_table(&self) -> Table {
        Table::of_columns(impact_columns(&self.summary(None)))
    }
}

fn must_stay(why: String) -> PyErr {
    PyFileExistsError::new_err(why.replace("add --force", "pass force=True"))
}

fn energy_name(term: EnergyTerm) -> &'static str {
    match term {
        EnergyTerm::Input => "energy_input",
        EnergyTerm::Kinetic => "energy_kinetic",
        EnergyTerm::Strain => "energy_strain",
        EnergyTerm::Damped => "energy_damped",
        EnergyTerm::Hysteretic => "energy_hysteretic",
        EnergyTerm::Contact => "energy_contact",
    }
}
