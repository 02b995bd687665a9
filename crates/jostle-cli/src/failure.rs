//! Failures of commands, and their exit codes.

use jostle_io::{InputError, OutputError};
use jostle_run::RunError;

/// Why a command did not do what it was asked.
#[derive(Debug)]
pub(crate) enum Failure {
    /// The input is wrong.
    Input(String),
    /// The analysis failed, or its results could not be written.
    Analysis(String),
    /// The user stopped it.
    Stopped,
}

impl std::fmt::Display for Failure {
    fn fmt(&self, formatter: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        match self {
            Self::Input(text) | Self::Analysis(text) => formatter.write_str(text),
            Self::Stopped => formatter.write_str("stopped"),
        }
    }
}

impl From<InputError> for Failure {
    fn from(error: InputError) -> Self {
        Self::Input(error.to_string())
    }
}

impl From<OutputError> for Failure {
    fn from(error: OutputError) -> Self {
        Self::Analysis(error.to_string())
    }
}

impl From<RunError> for Failure {
    fn from(error: RunError) -> Self {
        match error {
            RunError::Record(problem) => Self::Input(format!("--record: {problem}")),
            RunError::Output(_) | RunError::Analysis(_) => Self::Analysis(error.to_string()),
            _ => Self::Input(error.to_string()),
        }
    }
}
