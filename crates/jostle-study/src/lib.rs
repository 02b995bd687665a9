//! Many cases of one model: varied keys, design of the cases, a resumable runner, and statistics of the results.
//!
//! [`Study::new`] checks a [`jostle_io::StudyFile`]; [`run()`] computes what is not finished yet into a folder, a
//! partitioned Parquet dataset with one row a case. Every number of a row depends on the study and the number of the
//! case alone: not on threads, order, processes or interruptions.

#![cfg_attr(not(test), deny(clippy::disallowed_methods))] // bits of results depend on no processor

mod case;
pub mod classes;
pub mod dataset;
mod design;
mod key_words;
mod layout;
mod measures;
mod ready_made;
mod results;
mod row;
mod runner;
pub mod sampling;
mod single;
pub mod size;
pub mod statistics;
mod study;
pub mod suite;
mod varied;
mod verified;

pub use dataset::{of_folder, settle};
pub use design::{CaseDesign, Choice, DesignError};
pub use jostle_run::{
    CaseCache, CaseError, CriticalGap, GapError, GapProgress, GapSearch, GapSettings, RuleGap,
    critical_gaps, search_gaps,
};
pub use layout::{Column, Kind, Layout, Named};
pub use ready_made::{Incidence, incidence, ready_made, ready_made_names};
pub use results::finish;
pub use row::{Row, Status};
pub use runner::{Done, Progress, RunSettings, run, run_folder};
pub use single::run_case;
pub use study::{Study, StudyError};
pub use varied::{Varied, varied};
