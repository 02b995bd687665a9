//! Fragility of classes of buildings with pounding: pairs of classes, batches of runs, curves, files.

mod cases;
mod check;
mod curves;
mod files;
mod pair;
mod run;
mod shared;
mod words;

pub use check::Checked;
pub use curves::{Fragility, STATES};
pub use files::{FILES, write_classes};
pub use run::{Case, ClassesResults, Demand, count_rows, run_classes};

use jostle_io::InputError;

/// Why classes cannot be run.
#[derive(Debug, thiserror::Error)]
pub enum ClassesError {
    /// The file is wrong.
    #[error(transparent)]
    Input(#[from] InputError),
    /// A row cannot be stepped, or not be run again in full.
    #[error("{0}")]
    Analysis(String),
}
