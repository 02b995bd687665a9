//! The engine of the live page, for a notebook.

use std::ops::ControlFlow;
use std::sync::atomic::{AtomicU64, Ordering};
use std::sync::{Mutex, MutexGuard, PoisonError};

use jostle_live::{Answer, Engine, Local, widget_page};
use pyo3::prelude::*;
use pyo3::types::PyBytes;

use crate::base::{Base, tree_of};
use crate::error::{argument_error, input_error};

/// An open model whose requests are answered in this process.
#[pyclass(frozen, module = "jostle._jostle")]
pub(crate) struct Live {
    local: Mutex<Local>,
    /// Number of times that runs were stopped.
    stops: AtomicU64,
}

impl Live {
    fn local(&self) -> MutexGuard<'_, Local> {
        self.local.lock().unwrap_or_else(PoisonError::into_inner)
    }
}

#[pymethods]
impl Live {
    /// Takes a model from its text and files.
    #[new]
    fn new(base: Base) -> PyResult<Self> {
        let tree = tree_of(base).map_err(|error| input_error(&error))?;
        let engine = Engine::with_files(tree.name(), tree.text(), tree.files().clone())
            .map_err(|error| input_error(&error))?;
        Ok(Self {
            local: Mutex::new(Local::new(engine)),
            stops: AtomicU64::new(0),
        })
    }

    /// First message of a page.
    fn hello(&self, py: Python<'_>) -> Py<PyAny> {
        to_python(py, py.detach(|| self.local().hello()))
    }

    /// Answers a request of a page: a text, bytes, or nothing.
    fn answer(&self, py: Python<'_>, request: &str) -> PyResult<Option<Py<PyAny>>> {
        let answer = py.detach(|| {
            let stops = self.stops.load(Ordering::Relaxed);
            let watch = |_| {
                if self.stops.load(Ordering::Relaxed) == stops {
                    ControlFlow::Continue(())
                } else {
                    ControlFlow::Break(())
                }
            };
            self.local().answer(request, &watch)
        });
        let answer = answer.map_err(argument_error)?;
        Ok(answer.map(|answer| to_python(py, answer)))
    }

    /// Next point of the curve; `None` when there is nothing more to compute.
    fn more(&self, py: Python<'_>) -> Option<Py<PyAny>> {
        let answer = py.detach(|| self.local().more());
        answer.map(|answer| to_python(py, answer))
    }

    /// Accuracy of the latest run, once it is known whether its results are sensitive; `None` if there is nothing to find.
    fn accuracy(&self, py: Python<'_>) -> Option<Py<PyAny>> {
        let answer = py.detach(|| {
            let stops = self.stops.load(Ordering::Relaxed);
            let watch = || {
                if self.stops.load(Ordering::Relaxed) == stops {
                    ControlFlow::Continue(())
                } else {
                    ControlFlow::Break(())
                }
            };
            self.local().accuracy(&watch)
        });
        answer.map(|answer| to_python(py, answer))
    }

    /// Stops the run under way.
    fn stop(&self) {
        self.stops.fetch_add(1, Ordering::Relaxed);
    }

    /// Text of the model file.
    #[getter]
    fn text(&self, py: Python<'_>) -> String {
        py.detach(|| self.local().text().to_owned())
    }

    /// Keys of the model, each with its value as in the file.
    fn values(&self, py: Python<'_>) -> Vec<(String, Option<String>)> {
        py.detach(|| self.local().values())
    }

    /// Sets one value as typed in a model file.
    fn set(&self, py: Python<'_>, path: &str, typed: &str) -> PyResult<()> {
        py.detach(|| self.local().set(path, typed))
            .map_err(argument_error)
    }
}

/// The page of a notebook as HTML.
#[pyfunction]
pub(crate) fn live_page(name: &str) -> String {
    widget_page(name)
}

fn to_python(py: Python<'_>, answer: Answer) -> Py<PyAny> {
    match answer {
        Answer::Text(text) => pyo3::types::PyString::new(py, &text).into_any().unbind(),
        Answer::Binary(bytes) => PyBytes::new(py, &bytes).into_any().unbind(),
    }
}
