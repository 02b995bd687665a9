//! Many cases of one model: what varies, how cases are made of it, how they are run without losing any, and what
//! they say together.
//!
//! [`Study::new`] checks a [`jostle_io::StudyFile`]; [`run()`] computes what is not finished yet into a folder, a
//! partitioned Parquet dataset with one row a case. Every number of a row depends on the study and the number of the
//! case alone: not on threads, order, processes or interruptions.

mod case;
pub mod dataset;
mod design;
mod layout;
mod measures;
mod row;
mod runner;
pub mod sampling;
mod single;
mod study;

pub use case::{CaseError, Prepared, Ran, Workshop};
pub use design::{CaseDesign, Choice, DesignError};
pub use layout::{Column, Kind, Layout, Named};
pub use row::{Row, Status};
pub use runner::{Done, Progress, RunSettings, run, run_folder};
pub use single::run_case;
pub use study::{Study, StudyError};
