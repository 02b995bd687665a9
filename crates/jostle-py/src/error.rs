//! Errors as Python exceptions, with the text of the command line in the names of Python.

use jostle_io::{InputError, OutputError};
use jostle_run::RunError;
use jostle_study::StudyError;
use pyo3::PyErr;
use pyo3::exceptions::{PyFileExistsError, PyOSError};

pyo3::import_exception!(jostle._errors, ModelError);
pyo3::import_exception!(jostle._errors, AnalysisError);

/// A fault: path, problem, remedy, line, column.
type FaultParts = (String, String, Option<String>, Option<usize>, Option<usize>);

/// A wrong input, with its faults one by one.
pub(crate) fn input_error(error: &InputError) -> PyErr {
    let parts = error.faults.iter().map(|fault| {
        let place = fault.place.as_ref();
        (
            in_python(&fault.path),
            in_python(&fault.problem),
            fault.remedy.as_deref().map(in_python),
            place.map(|place| place.line),
            place.map(|place| place.column),
        )
    });
    let parts: Vec<FaultParts> = parts.collect();
    ModelError::new_err((in_python(&error.to_string()), parts))
}

/// A wrong argument.
pub(crate) fn argument_error(text: impl Into<String>) -> PyErr {
    ModelError::new_err(in_python(&text.into()))
}

/// A file that could not be written.
pub(crate) fn output_error(error: &OutputError) -> PyErr {
    PyOSError::new_err(in_python(&error.to_string()))
}

/// Whatever a function of the command line reports.
pub(crate) fn run_error(error: RunError) -> PyErr {
    match error {
        RunError::Input(error) => input_error(&error),
        RunError::Output(error) => output_error(&error),
        RunError::Analysis(text) => AnalysisError::new_err(in_python(&text)),
        RunError::Kept(text) => PyFileExistsError::new_err(in_python(&text)),
        RunError::Record(problem) => argument_error(format!("motion: {problem}")),
        other => argument_error(other.to_string()),
    }
}

/// Phrases about options, and what they are in Python.
const PHRASES: [(&str, &str); 9] = [
    ("jostle run --force runs", "force=True runs"),
    ("add --force to", "pass force=True to"),
    ("--force", "force=True"),
    ("--accept-unusual", "analysis={\"accept_unusual\": True}"),
    ("or --record", "or change the motion"),
    ("chosen with --record", "chosen with motion="),
    ("\"jostle gap\"", "critical_gap"),
    (
        "jostle run, jostle gap, a study and run_suite of Python take",
        "run_suite, critical_gap and Study take",
    ),
    ("\"jostle run --sensitivity\"", "run(…, sensitivity=True)"),
];

/// Why a study cannot be read or run.
pub(crate) fn study_error(error: &StudyError) -> PyErr {
    match error {
        StudyError::Input(errors) => match &errors[..] {
            [only] => input_error(only),
            _ => argument_error(error.to_string()),
        },
        StudyError::Output(_) => PyOSError::new_err(error.to_string()),
        _ => argument_error(error.to_string()),
    }
}

/// A message of the command line in the names of Python: `--mass-ratios` is `mass_ratios`.
pub(crate) fn in_python(text: &str) -> String {
    let text = PHRASES
        .iter()
        .fold(text.to_owned(), |text, (old, new)| text.replace(old, new));
    let mut said = String::with_capacity(text.len());
    let mut rest = &text[..];
    while let Some(at) = rest.find("--") {
        let (before, after) = rest.split_at(at);
        said.push_str(before);
        let option = &after[2..];
        let end =
            option.find(|c: char| !(c.is_ascii_lowercase() || c.is_ascii_digit() || c == '-'));
        let (name, left) = option.split_at(end.unwrap_or(option.len()));
        if name.starts_with(|c: char| c.is_ascii_lowercase()) {
            said.push_str(&name.replace('-', "_"));
        } else {
            said.push_str("--");
            said.push_str(name);
        }
        rest = left;
    }
    said + rest
}
