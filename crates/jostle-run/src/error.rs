//! Errors of a run: a model that cannot be run, or results that cannot be written.

use jostle_io::{InputError, OutputError};

/// What went wrong between a model file and its results.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum RunError {
    /// The model, its motion or its steps are wrong; the faults have their lines.
    #[error("{0}")]
    Input(#[from] InputError),
    /// A value given apart from the model file is wrong.
    #[error("{0}")]
    Argument(String),
    /// The record named apart from the model file cannot be used: the problem alone, without the name of the option.
    #[error("{0}")]
    Record(String),
    /// A file that jostle did not write must not be replaced.
    #[error("{0}")]
    Kept(String),
    /// A file of results cannot be written.
    #[error("{0}")]
    Output(#[from] OutputError),
    /// The analysis failed.
    #[error("{0}")]
    Analysis(String),
}
