//! What is wrong with an inventory or a folder of a city.

use std::path::Path;

/// Why a step of a city's study cannot be done.
#[derive(Debug, thiserror::Error)]
pub enum CityError {
    /// The inventory, the city file or a folder of an earlier step is not as it must be; the text names the file, the
    /// row, the column and the remedy.
    #[error("{0}")]
    Input(String),
    /// A file cannot be written.
    #[error(transparent)]
    Output(#[from] jostle_io::OutputError),
    /// A row of buildings cannot be stepped.
    #[error("{0}")]
    Analysis(String),
    /// Stopped; what was finished is kept.
    #[error("stopped")]
    Stopped,
}

impl CityError {
    /// A fault of a file.
    pub(crate) fn of(path: &Path, problem: impl std::fmt::Display) -> Self {
        Self::Input(format!("{}: {problem}", path.display()))
    }

    /// A folder that an earlier step has not written.
    pub(crate) fn lacks(path: &Path, step: &str) -> Self {
        Self::Input(format!(
            "{} is missing: run `jostle city {step}` first",
            path.display()
        ))
    }
}
