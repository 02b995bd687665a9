//! The folder of a study: a manifest, parts of the table, and journals of parts under way.

mod journal;
mod manifest;
mod reading;

use std::path::{Path, PathBuf};

pub(crate) use journal::{Claim, Journal};
pub(crate) use manifest::Manifest;
pub(crate) use reading::read_part;
pub use reading::{Table, read_columns};

/// Where the parts of a table of cases lie.
#[must_use]
pub fn part_path(folder: &Path, first_case: u64) -> PathBuf {
    folder
        .join("cases")
        .join(format!("part-{first_case:010}.parquet"))
}

/// Journals of parts under way.
pub(crate) fn journal_path(folder: &Path, first_case: u64) -> PathBuf {
    folder
        .join("under-way")
        .join(format!("part-{first_case:010}.journal"))
}
