//! The histories of a run, and the table that NumPy sees.

use jostle::History;
use numpy::{PyArray1, PyArray2, PyArrayMethods};
use pyo3::exceptions::PyOSError;
use pyo3::prelude::*;
use pyo3::sync::PyOnceLock;
use pyo3::types::IntoPyDict;

/// Histories as they were recorded, and as a table once it was asked for.
pub(crate) struct Histories {
    pub(crate) history: History,
    /// One row per column of the history.
    table: PyOnceLock<Py<PyArray2<f64>>>,
}

impl Histories {
    pub(crate) fn new(history: Option<History>) -> Self {
        Self {
            history: history.unwrap_or_else(|| History::new(Vec::new())),
            table: PyOnceLock::new(),
        }
    }

    /// The histories as a read-only NumPy table, one row per recorded quantity.
    pub(crate) fn table(&self, py: Python<'_>) -> PyResult<Py<PyArray2<f64>>> {
        let table = self.table.get_or_try_init(py, || {
            let columns = self.history.columns();
            let mut values = Vec::with_capacity(columns.len() * self.history.len());
            for column in columns {
                values.extend(self.history.column(*column).unwrap_or_default());
            }
            match self.history.fault() {
                Some(reason) => Err(PyOSError::new_err(reason.to_owned())),
                None => shared(py, columns.len(), values),
            }
        })?;
        Ok(table.clone_ref(py))
    }
}

fn shared(py: Python<'_>, columns: usize, values: Vec<f64>) -> PyResult<Py<PyArray2<f64>>> {
    let rows = values.len() / columns.max(1);
    let flat = PyArray1::from_vec(py, values);
    flat.call_method("setflags", (), Some(&[("write", false)].into_py_dict(py)?))?;
    Ok(flat.reshape([columns, rows])?.unbind())
}
