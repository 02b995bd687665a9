//! The folder of a study: a manifest, parts of the table, and journals of unfinished parts.

mod journal;
mod manifest;
mod part;
mod reading;
mod set_aside;

use std::path::{Path, PathBuf};

pub(crate) use journal::{Claim, Journal, no_journal, owner_of};
pub(crate) use manifest::settle_for_part;
pub use manifest::{of_folder, settle};
pub(crate) use part::{PartFault, cases_of, verify, write as write_part};
pub use reading::{Table, missing_parts, read_columns};
pub(crate) use reading::{read_part, visit_parts};
pub(crate) use set_aside::{keep_copy, set_aside, strangers};

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
