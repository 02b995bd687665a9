//! The histories of a run: rows as recorded, transposed when a column is first accessed.

use std::sync::{Mutex, MutexGuard, PoisonError};

use jostle::{Column, History};
use numpy::{PyArray1, PyArray2, PyArrayMethods};
use pyo3::prelude::*;
use pyo3::sync::PyOnceLock;
use pyo3::types::IntoPyDict;

/// Histories in one of two layouts: rows for reports, or columns owned by NumPy.
pub(crate) struct Histories {
    pub(crate) columns: Vec<Column>,
    /// `None` after `table` is set.
    rows: Mutex<Option<History>>,
    /// One row per column of the history.
    table: PyOnceLock<Py<PyArray2<f64>>>,
}

impl Histories {
    pub(crate) fn new(history: Option<History>) -> Self {
        let history = history.unwrap_or_else(|| History::new(Vec::new()));
        Self {
            columns: history.columns().to_vec(),
            rows: Mutex::new(Some(history)),
            table: PyOnceLock::new(),
        }
    }

    /// The histories as a read-only NumPy table, one row per recorded quantity.
    pub(crate) fn table(&self, py: Python<'_>) -> PyResult<Py<PyArray2<f64>>> {
        let table = self.table.get_or_try_init(py, || {
            let values = match &*self.rows() {
                Some(history) => by_column(history),
                // Another thread was quicker, and this one will find its table.
                None => Vec::new(),
            };
            shared(py, self.columns.len(), values)
        })?;
        self.rows().take();
        Ok(table.clone_ref(py))
    }

    /// The history as it was recorded.
    pub(crate) fn history(&self, py: Python<'_>) -> PyResult<History> {
        if let Some(history) = &*self.rows() {
            return Ok(history.clone());
        }
        let table = self.table(py)?;
        let table = table.bind(py).try_readonly()?;
        let (table, columns) = (table.as_slice()?, self.columns.len());
        let rows = table.len() / columns.max(1);
        let values = (0..rows).flat_map(|row| (0..columns).map(move |c| table[c * rows + row]));
        Ok(History::from_rows(self.columns.clone(), values.collect()))
    }

    fn rows(&self) -> MutexGuard<'_, Option<History>> {
        self.rows.lock().unwrap_or_else(PoisonError::into_inner)
    }
}

/// The values of a history, column after column.
fn by_column(history: &History) -> Vec<f64> {
    let (rows, columns) = (history.len(), history.columns().len());
    let mut values = vec![0.0; rows * columns];
    for row in 0..rows {
        for (column, value) in history.row(row).iter().enumerate() {
            values[column * rows + row] = *value;
        }
    }
    values
}

fn shared(py: Python<'_>, columns: usize, values: Vec<f64>) -> PyResult<Py<PyArray2<f64>>> {
    let rows = values.len() / columns.max(1);
    let flat = PyArray1::from_vec(py, values);
    flat.call_method("setflags", (), Some(&[("write", false)].into_py_dict(py)?))?;
    Ok(flat.reshape([columns, rows])?.unbind())
}
