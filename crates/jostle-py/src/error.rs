//! Errors as Python exceptions, with the text of the command line.

use jostle_io::{InputError, OutputError};
use pyo3::PyErr;
use pyo3::exceptions::PyOSError;

pyo3::import_exception!(jostle._errors, ModelError);
pyo3::import_exception!(jostle._errors, AnalysisError);

/// A fault: path, problem, remedy, line, column.
type FaultParts = (String, String, Option<String>, Option<usize>, Option<usize>);

/// A wrong input, with its faults one by one.
pub(crate) fn input_error(error: &InputError) -> PyErr {
    let parts = error.faults.iter().map(|fault| {
        let place = fault.place.as_ref();
        (
            fault.path.clone(),
            fault.problem.clone(),
            fault.remedy.clone(),
            place.map(|place| place.line),
            place.map(|place| place.column),
        )
    });
    let parts: Vec<FaultParts> = parts.collect();
    ModelError::new_err((error.to_string(), parts))
}

/// A wrong argument.
pub(crate) fn argument_error(text: impl Into<String>) -> PyErr {
    ModelError::new_err(text.into())
}

/// A file that could not be written.
pub(crate) fn output_error(error: &OutputError) -> PyErr {
    PyOSError::new_err(error.to_string())
}
