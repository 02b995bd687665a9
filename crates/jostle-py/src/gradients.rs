//! Derivatives of peaks.

use jostle_io::Overrides;
use jostle_run::GradientRequest;
use pyo3::exceptions::PyKeyboardInterrupt;
use pyo3::prelude::*;

use crate::base::{Base, tree_of};
use crate::error::{input_error, run_error};
use crate::watch::watched;

/// Derivatives of the peaks of a model by numbers of its text, as JSON.
#[pyfunction]
#[pyo3(signature = (base, by, observer=None))]
pub(crate) fn gradients(
    py: Python<'_>,
    base: Base,
    by: Vec<String>,
    observer: Option<Py<PyAny>>,
) -> PyResult<String> {
    let tree = tree_of(base).map_err(|error| input_error(&error))?;
    let request = GradientRequest::new(tree, &by, &Overrides::default()).map_err(run_error)?;
    let found = watched(py, observer.as_ref(), |watch| {
        request.gradients(&|| watch.stops(), &|done, of| {
            watch.note(done as f64, of as f64);
        })
    })?;
    let found = found
        .map_err(run_error)?
        .ok_or_else(|| PyKeyboardInterrupt::new_err(""))?;
    Ok(serde_json::to_string(&found).unwrap_or_default())
}
