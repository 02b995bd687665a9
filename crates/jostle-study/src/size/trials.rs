//! Finished trials on disk: appended one by one, and read back by the next search.

use std::path::{Path, PathBuf};

use super::SizeProblem;
use super::evaluate::Evaluated;
use crate::dataset::{Claim, Journal};
use crate::row::Row;
use crate::study::StudyError;
use jostle_run::{FileKind, RunError, may_write};

/// Name of the journal.
const JOURNAL: &str = "trials.journal";
/// Files that a search writes.
pub(super) const TABLE: &str = "trials.parquet";
pub(super) const NUMBERS: &str = "size.json";
pub(super) const PAGE: &str = "size.html";

/// Files of an earlier search in a folder, which another one replaces.
///
/// # Errors
/// [`RunError::Kept`] if jostle did not write one of them and `force` is false, [`RunError::Output`] if it cannot be read.
pub fn earlier_size_files(folder: &Path, force: bool) -> Result<Vec<&'static str>, RunError> {
    let mut earlier = Vec::new();
    for (name, kind) in [
        (TABLE, FileKind::TABLE),
        (NUMBERS, FileKind::SIZE_NUMBERS),
        (PAGE, FileKind::SIZE_PAGE),
    ] {
        if may_write(&folder.join(name), Some(kind), force)? {
            earlier.push(name);
        }
    }
    Ok(earlier)
}

/// What was tried, and what came of it.
type Trial = (Vec<f64>, Evaluated);

/// The open journal of a search; no other process can use it as long as this lives.
pub(super) struct Store {
    /// `None` on a file system without locks: such a search cannot be continued.
    journal: Option<Journal>,
    next: u64,
}

impl Store {
    /// Opens the journal in a folder and returns the trials in it.
    pub(super) fn open(
        folder: &Path,
        problem: &SizeProblem,
    ) -> Result<(Self, Vec<Trial>), StudyError> {
        std::fs::create_dir_all(folder).map_err(|error| unwritable(folder, &error))?;
        let path: PathBuf = folder.join(JOURNAL);
        let keep = |_: &[u8]| {
            Err(std::io::Error::other(
                "it belongs to another search; choose another --out, or remove the file to begin anew",
            ))
        };
        let claim = Journal::claim(&path, &problem.fingerprint, &keep);
        let claim = claim.map_err(|error| match error.kind() {
            std::io::ErrorKind::Other => StudyError::Folder(format!("{}: {error}", path.display())),
            _ => unwritable(&path, &error),
        })?;
        let Claim::Ours(journal, rows) = claim else {
            return Err(StudyError::Folder(format!(
                "{}: another process searches in this folder",
                folder.display()
            )));
        };
        let count = problem.variables.len();
        let values = problem.quantities.len() * problem.shaking.len();
        let read = |row: Row| {
            let point: Option<Vec<f64>> = row.numbers.iter().take(count).copied().collect();
            let quantities: Vec<Option<f64>> = row.numbers.get(count..)?.to_vec();
            (quantities.len() == values).then_some(())?;
            let found = Evaluated {
                status: row.status,
                reason: row.reason,
                quantities,
            };
            Some((point?, found))
        };
        let next = rows.len() as u64;
        let finished = rows.into_iter().filter_map(read).collect();
        let journal = journal.ok();
        Ok((Self { journal, next }, finished))
    }

    /// Adds a finished trial.
    pub(super) fn append(&mut self, point: &[f64], found: &Evaluated) -> Result<(), StudyError> {
        let numbers = point.iter().map(|x| Some(*x));
        let row = Row {
            case: self.next,
            status: found.status,
            reason: found.reason.clone(),
            numbers: numbers.chain(found.quantities.iter().copied()).collect(),
            texts: Vec::new(),
        };
        self.next += 1;
        let Some(journal) = &mut self.journal else {
            return Ok(());
        };
        let path = journal.path().to_owned();
        journal
            .append(&row)
            .map_err(|error| unwritable(&path, &error))
    }
}

fn unwritable(path: &Path, error: &std::io::Error) -> StudyError {
    StudyError::Output(format!("{}: {error}", path.display()))
}
