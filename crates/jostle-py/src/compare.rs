//! Comparisons with shake-table tests, with the GIL released.

use std::ops::ControlFlow;
use std::path::PathBuf;
use std::time::{Duration, Instant};

use jostle_io::{ComparisonMap, Format, MeasuredTable, Values};
use jostle_run::{Measurements, earlier_comparison, prepare_comparison};
use pyo3::exceptions::PyKeyboardInterrupt;
use pyo3::prelude::*;

use crate::error::{argument_error, input_error, run_error};
use crate::model::Model;
use crate::table::Table;

/// Interval at which a run checks for Ctrl-C.
const LOOK_UP: Duration = Duration::from_millis(50);

/// Results of a comparison.
#[pyclass(frozen, module = "jostle._jostle")]
pub(crate) struct Comparison(jostle_run::Comparison);

/// Runs a model on the table motion of a file of measurements and compares. The map is a path, or the text of one as JSON.
#[pyfunction]
#[pyo3(signature = (model, data, map_path=None, map_text=None, folder=None, force=false))]
pub(crate) fn compare(
    py: Python<'_>,
    model: &Model,
    data: PathBuf,
    map_path: Option<PathBuf>,
    map_text: Option<&str>,
    folder: Option<PathBuf>,
    force: bool,
) -> PyResult<Comparison> {
    let map = match (&map_path, map_text) {
        (Some(path), _) => ComparisonMap::load(path),
        (None, text) => ComparisonMap::parse("map", text.unwrap_or("{}"), Format::Json),
    };
    let map = map.map_err(|error| input_error(&error))?;
    let name = data.display().to_string();
    let table =
        MeasuredTable::read(&data).map_err(|error| argument_error(format!("{name}{error}")))?;
    if let Some(folder) = &folder {
        earlier_comparison(folder, force).map_err(run_error)?;
    }
    let mut stopped: Option<PyErr> = None;
    let mut looked = Instant::now();
    let mut watch = |_, _| {
        if looked.elapsed() < LOOK_UP {
            return ControlFlow::Continue(());
        }
        looked = Instant::now();
        match Python::attach(|py| py.check_signals()) {
            Ok(()) => ControlFlow::Continue(()),
            Err(error) => {
                stopped = Some(error);
                ControlFlow::Break(())
            }
        }
    };
    let compared = py.detach(|| {
        let shown = map_path
            .as_ref()
            .map_or_else(|| "map".to_owned(), |path| path.display().to_string());
        let data = Measurements {
            table: &table,
            name: &name,
            map: &map,
            map_name: &shown,
        };
        let compared = prepare_comparison(&model.opened, data)?.run(&mut watch)?;
        if let (Some(folder), Some(compared)) = (&folder, &compared) {
            compared.write(folder)?;
        }
        Ok(compared)
    });
    if let Some(error) = stopped {
        return Err(error);
    }
    let compared = compared.map_err(run_error)?;
    compared
        .map(Comparison)
        .ok_or_else(|| PyKeyboardInterrupt::new_err(()))
}

#[pymethods]
impl Comparison {
    /// The text of compare.json.
    fn json(&self) -> String {
        self.0.json().to_string()
    }

    /// Measured and computed histories at the measured instants.
    fn table(&self) -> Table {
        let columns = self.0.table().into_iter();
        Table::of_columns(
            columns
                .map(|(name, values)| (name, Values::Real(values)))
                .collect(),
        )
    }

    /// The comparison as the command line prints it.
    fn text(&self) -> String {
        jostle_run::plain(&self.0.describe(None))
    }

    /// The page.
    fn page(&self) -> String {
        self.0.page()
    }
}
