//! Tables for NumPy, and for pandas, polars and pyarrow through the Arrow PyCapsule interface.

use std::sync::Arc;

use arrow_array::ffi::FFI_ArrowSchema;
use arrow_array::ffi_stream::FFI_ArrowArrayStream;
use arrow_array::{
    ArrayRef, BinaryArray, Float64Array, Int32Array, RecordBatch, RecordBatchIterator,
    RecordBatchOptions, StringArray,
};
use arrow_schema::{ArrowError, DataType, Field, Schema};
use jostle_io::Values;
use numpy::{PyArray1, PyArray2, PyArrayMethods, PyUntypedArrayMethods};
use pyo3::exceptions::PyRuntimeError;
use pyo3::prelude::*;
use pyo3::types::PyCapsule;

/// A table of columns with names.
#[pyclass(frozen, module = "jostle._jostle")]
pub(crate) struct Table {
    names: Vec<String>,
    columns: Columns,
}

enum Columns {
    /// Rows of a shared array.
    Histories(Py<PyArray2<f64>>),
    /// Owned columns.
    Own(Vec<Values>),
}

impl Table {
    pub(crate) fn of_histories(names: Vec<String>, histories: Py<PyArray2<f64>>) -> Self {
        Self {
            names,
            columns: Columns::Histories(histories),
        }
    }

    pub(crate) fn of_columns(columns: Vec<(impl Into<String>, Values)>) -> Self {
        let (names, columns) = columns
            .into_iter()
            .map(|(name, values)| (name.into(), values))
            .unzip();
        Self {
            names,
            columns: Columns::Own(columns),
        }
    }

    fn schema(&self) -> Schema {
        let field = |(index, name): (usize, &String)| {
            let (kind, nullable) = match &self.columns {
                Columns::Histories(_) => (DataType::Float64, false),
                Columns::Own(columns) => match &columns[index] {
                    Values::Real(_) => (DataType::Float64, false),
                    Values::Instant(_) => (DataType::Float64, true),
                    Values::Whole(_) => (DataType::Int32, true),
                    Values::Text(_) => (DataType::Utf8, false),
                    Values::Bytes(_) => (DataType::Binary, false),
                },
            };
            Field::new(name, kind, nullable)
        };
        Schema::new(self.names.iter().enumerate().map(field).collect::<Vec<_>>())
    }

    fn batch(&self, py: Python<'_>) -> PyResult<RecordBatch> {
        let columns: Vec<ArrayRef> = match &self.columns {
            Columns::Histories(histories) => {
                let histories = histories.bind(py).try_readonly()?;
                let rows = self.rows(py);
                let values = histories.as_slice()?.chunks(rows.max(1));
                let columns = values.map(|values| -> ArrayRef {
                    Arc::new(Float64Array::from_iter_values(values.iter().copied()))
                });
                columns.collect()
            }
            Columns::Own(columns) => columns
                .iter()
                .map(|values| -> ArrayRef {
                    match values {
                        Values::Real(values) => Arc::new(Float64Array::from(values.clone())),
                        Values::Instant(values) => Arc::new(Float64Array::from(values.clone())),
                        Values::Whole(values) => Arc::new(Int32Array::from(values.clone())),
                        Values::Text(values) => {
                            Arc::new(StringArray::from_iter_values(values.iter()))
                        }
                        Values::Bytes(values) => {
                            Arc::new(BinaryArray::from_iter_values(values.iter()))
                        }
                    }
                })
                .collect(),
        };
        let options = RecordBatchOptions::new().with_row_count(Some(self.rows(py)));
        RecordBatch::try_new_with_options(Arc::new(self.schema()), columns, &options)
            .map_err(|error| failed(&error))
    }

    fn rows(&self, py: Python<'_>) -> usize {
        match &self.columns {
            Columns::Histories(histories) => histories.bind(py).shape()[1],
            Columns::Own(columns) => columns.first().map_or(0, Values::len),
        }
    }
}

#[pymethods]
impl Table {
    #[getter]
    fn names(&self) -> Vec<String> {
        self.names.clone()
    }

    /// A table of columns, each with its kind as [`Self::kind`] names it.
    #[staticmethod]
    fn of(columns: Vec<(String, String, Bound<'_, PyAny>)>) -> PyResult<Self> {
        let column = |(name, kind, values): (String, String, Bound<'_, PyAny>)| {
            let values = match kind.as_str() {
                "optional" => Values::Instant(values.extract()?),
                "whole" => Values::Whole(values.extract()?),
                "text" => Values::Text(values.extract()?),
                "bytes" => Values::Bytes(values.extract()?),
                _ => Values::Real(values.extract()?),
            };
            Ok((name, values))
        };
        let columns: PyResult<Vec<_>> = columns.into_iter().map(column).collect();
        Ok(Self::of_columns(columns?))
    }

    /// The table of these rows, in this order.
    fn taken(&self, py: Python<'_>, rows: Vec<usize>) -> PyResult<Self> {
        fn pick<T: Clone>(values: &[T], rows: &[usize]) -> Vec<T> {
            rows.iter()
                .filter_map(|row| values.get(*row).cloned())
                .collect()
        }
        let columns = match &self.columns {
            Columns::Histories(histories) => {
                let histories = histories.bind(py).try_readonly()?;
                let count = self.rows(py).max(1);
                let values = histories.as_slice()?.chunks(count);
                values
                    .map(|history| Values::Real(pick(history, &rows)))
                    .collect()
            }
            Columns::Own(columns) => columns
                .iter()
                .map(|values| match values {
                    Values::Real(real) => Values::Real(pick(real, &rows)),
                    Values::Instant(instant) => Values::Instant(pick(instant, &rows)),
                    Values::Whole(histories) => Values::Whole(pick(histories, &rows)),
                    Values::Text(histories) => Values::Text(pick(histories, &rows)),
                    Values::Bytes(bytes) => Values::Bytes(pick(bytes, &rows)),
                })
                .collect(),
        };
        Ok(Self {
            names: self.names.clone(),
            columns: Columns::Own(columns),
        })
    }

    /// What a column has: `real`, `optional` (numbers that may be absent), `whole`, `text` or `bytes`.
    fn kind(&self, index: usize) -> PyResult<&'static str> {
        match &self.columns {
            Columns::Histories(_) => Ok("real"),
            Columns::Own(columns) => match columns.get(index) {
                Some(Values::Real(_)) => Ok("real"),
                Some(Values::Instant(_)) => Ok("optional"),
                Some(Values::Whole(_)) => Ok("whole"),
                Some(Values::Text(_)) => Ok("text"),
                Some(Values::Bytes(_)) => Ok("bytes"),
                None => Err(pyo3::exceptions::PyIndexError::new_err(index)),
            },
        }
    }

    fn __len__(&self, py: Python<'_>) -> usize {
        self.rows(py)
    }

    /// A column: an array of numbers, or a list of texts or of numbers that may be absent.
    fn column<'py>(&self, py: Python<'py>, index: usize) -> PyResult<Bound<'py, PyAny>> {
        match &self.columns {
            Columns::Histories(histories) => histories.bind(py).get_item(index),
            Columns::Own(columns) => match columns.get(index) {
                Some(Values::Real(values)) => Ok(PyArray1::from_slice(py, values).into_any()),
                Some(Values::Instant(values)) => Ok(values.clone().into_pyobject(py)?),
                Some(Values::Whole(values)) => Ok(values.clone().into_pyobject(py)?),
                Some(Values::Text(values)) => Ok(values.clone().into_pyobject(py)?),
                Some(Values::Bytes(values)) => Ok(values.clone().into_pyobject(py)?),
                None => Err(pyo3::exceptions::PyIndexError::new_err(index)),
            },
        }
    }

    /// The table as a stream of the Arrow C interface.
    #[pyo3(signature = (requested_schema=None))]
    fn __arrow_c_stream__<'py>(
        &self,
        py: Python<'py>,
        requested_schema: Option<Bound<'py, PyAny>>,
    ) -> PyResult<Bound<'py, PyCapsule>> {
        // A request is a wish; the columns have one natural type.
        drop(requested_schema);
        let batch = self.batch(py)?;
        let schema = batch.schema();
        let reader = RecordBatchIterator::new([Ok(batch)], schema);
        let stream = FFI_ArrowArrayStream::new(Box::new(reader));
        PyCapsule::new_with_value(py, stream, c"arrow_array_stream")
    }

    /// The columns and their types as a schema of the Arrow C interface.
    fn __arrow_c_schema__<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyCapsule>> {
        let schema = FFI_ArrowSchema::try_from(&self.schema()).map_err(|error| failed(&error))?;
        PyCapsule::new_with_value(py, schema, c"arrow_schema")
    }
}

fn failed(error: &ArrowError) -> PyErr {
    PyRuntimeError::new_err(error.to_string())
}
