//! The files of a run: written beside each other first, then put in place together.

use std::io;
use std::path::{Path, PathBuf};

use jostle::History;
use jostle_io::{
    OutputError, write_atomically, write_buildings_parquet, write_capacity_parquet,
    write_floor_spectra_parquet, write_floors_parquet, write_hinges_parquet, write_history_parquet,
    write_impacts_parquet, write_members_parquet, write_summary_json,
};

use crate::error::RunError;
use crate::replace::{FileKind, may_write};
use crate::results::Results;

const SUMMARY: &str = "summary.json";
const HISTORY: &str = "history.parquet";
const BUILDINGS: &str = "buildings.parquet";
const FLOORS: &str = "floors.parquet";
const IMPACTS: &str = "impacts.parquet";
const HINGES: &str = "hinges.parquet";
const MEMBERS: &str = "members.parquet";
const CAPACITY: &str = "capacity.parquet";
const FLOOR_SPECTRA: &str = "floor_spectra.parquet";
const REPORT: &str = "report.html";

/// The files of a run.
const FILES: [(&str, FileKind); 10] = [
    (SUMMARY, FileKind::SUMMARY),
    (HISTORY, FileKind::TABLE),
    (BUILDINGS, FileKind::TABLE),
    (FLOORS, FileKind::TABLE),
    (IMPACTS, FileKind::TABLE),
    (HINGES, FileKind::TABLE),
    (MEMBERS, FileKind::TABLE),
    (FLOOR_SPECTRA, FileKind::TABLE),
    (CAPACITY, FileKind::TABLE),
    (REPORT, FileKind::REPORT),
];

/// Files of an earlier run in a folder, which a run replaces.
///
/// # Errors
/// [`RunError::Kept`] if jostle did not write one of them and `force` is false, [`RunError::Output`] if it cannot be read.
pub fn earlier_files(folder: &Path, force: bool) -> Result<Vec<&'static str>, RunError> {
    let mut earlier = Vec::new();
    for (name, kind) in FILES {
        if may_write(&folder.join(name), Some(kind), force)? {
            earlier.push(name);
        }
    }
    Ok(earlier)
}

/// Which files to write beside `summary.json`.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Content {
    /// `history.parquet`, `buildings.parquet`, `floors.parquet`, `impacts.parquet`, if buildings yield `hinges.parquet`, and if members are asked for `members.parquet`,
    /// and if capacities are known `capacity.parquet`.
    /// If floor spectra are asked for, `floor_spectra.parquet` is written in any case, beside `summary.json`.
    pub tables: bool,
    /// `report.html`.
    pub report: bool,
}

impl Content {
    /// Tables and report.
    pub const ALL: Self = Self {
        tables: true,
        report: true,
    };
    /// Tables without a report.
    pub const TABLES: Self = Self {
        tables: true,
        report: false,
    };
    /// The report without tables.
    pub const REPORT: Self = Self {
        tables: false,
        report: true,
    };
}

impl Results<'_> {
    /// Writes `summary.json` and the files asked for into a folder that exists. Either all are replaced or, if one of
    /// them cannot be written, none. With tables, files of an earlier run that this one does not write are removed.
    ///
    /// # Errors
    /// [`OutputError`] with path and reason.
    pub fn write(&self, folder: &Path, content: Content) -> Result<(), OutputError> {
        let mut staged = Staged::new(folder)?;
        if content.tables {
            self.write_tables(&mut staged)?;
        }
        // Not among the tables: the run without contact, which comes later, belongs into them.
        staged.add(BUILDINGS, |path| {
            write_buildings_parquet(path, self.summary)
        })?;
        staged.add(FLOORS, |path| write_floors_parquet(path, self.summary))?;
        if let Some(found) = &self.summary.floor_spectra {
            staged.add(FLOOR_SPECTRA, |path| {
                write_floor_spectra_parquet(path, self.summary, found)
            })?;
        }
        if let Some(report) = content.report.then(|| self.report()).flatten() {
            staged.add(REPORT, |path| write_atomically(path, report.as_bytes()))?;
        }
        staged.add(SUMMARY, |path| write_summary_json(path, self.summary))?;
        // What could not be read back is zero in the files.
        let histories = self.history.into_iter().chain(self.without_contact);
        let mut faults = histories.filter_map(History::fault);
        if let Some(reason) = faults.next().or(self.outcome.history_fault()) {
            return Err(OutputError::Encoding {
                path: folder.join(HISTORY),
                reason: reason.to_owned(),
            });
        }
        staged.put_in_place(content.tables)
    }

    fn write_tables(&self, staged: &mut Staged) -> Result<(), OutputError> {
        let model = &self.prepared.input.model;
        let (summary, outcome) = (self.summary, self.outcome);
        if let Some(history) = self.history.filter(|all| !all.columns().is_empty()) {
            staged.add(HISTORY, |path| {
                write_history_parquet(path, model, summary, history)
            })?;
        }
        staged.add(IMPACTS, |path| write_impacts_parquet(path, summary))?;
        if !outcome.state.springs.is_empty() {
            let system = &self.prepared.system;
            staged.add(HINGES, |path| {
                write_hinges_parquet(path, system, outcome, summary)
            })?;
        }
        if let Some(members) = &outcome.member_history {
            let system = &self.prepared.system;
            staged.add(MEMBERS, |path| {
                write_members_parquet(path, system, members, summary)
            })?;
        }
        if summary
            .buildings
            .iter()
            .any(|building| building.capacity.is_some())
        {
            staged.add(CAPACITY, |path| write_capacity_parquet(path, summary))?;
        }
        Ok(())
    }
}

/// Files written to a folder of their own inside the folder that they belong to.
struct Staged {
    folder: PathBuf,
    aside: tempfile::TempDir,
    names: Vec<&'static str>,
}

impl Staged {
    fn new(folder: &Path) -> Result<Self, OutputError> {
        let prefix = jostle_io::part_prefix();
        let mut builder = tempfile::Builder::new();
        let aside = builder
            .prefix(&prefix)
            .suffix(jostle_io::PART_SUFFIX)
            .tempdir_in(if folder == Path::new("") {
                Path::new(".")
            } else {
                folder
            })
            .map_err(unwritable(folder))?;
        Ok(Self {
            folder: folder.to_owned(),
            aside,
            names: Vec::new(),
        })
    }

    /// Writes a file aside; errors name the place where it belongs.
    fn add(
        &mut self,
        name: &'static str,
        write: impl FnOnce(&Path) -> Result<(), OutputError>,
    ) -> Result<(), OutputError> {
        let path = self.folder.join(name);
        write(&self.aside.path().join(name)).map_err(|error| match error {
            OutputError::Io { error, .. } => OutputError::Io { path, error },
            OutputError::Encoding { reason, .. } => OutputError::Encoding { path, reason },
            other => other,
        })?;
        self.names.push(name);
        Ok(())
    }

    /// Replaces what is in the folder; `alone` removes all other files of an earlier run, which may be of another model.
    fn put_in_place(self, alone: bool) -> Result<(), OutputError> {
        // A folder of such a name would stop the files after the first.
        for name in &self.names {
            let path = self.folder.join(name);
            if path.is_dir() {
                return Err(unwritable(&path)(io::ErrorKind::IsADirectory.into()));
            }
        }
        for name in &self.names {
            let path = self.folder.join(name);
            jostle_io::put_in_place(&self.aside.path().join(name), &path)?;
        }
        let others = FILES
            .iter()
            .filter(|(name, _)| alone && !self.names.contains(name));
        for (name, kind) in others {
            let path = self.folder.join(name);
            if may_write(&path, Some(*kind), false).is_ok_and(|exists| exists) {
                std::fs::remove_file(&path).map_err(unwritable(&path))?;
            }
        }
        self.aside.close().map_err(unwritable(&self.folder))
    }
}

fn unwritable(path: &Path) -> impl Fn(io::Error) -> OutputError {
    let path = path.to_owned();
    move |error| OutputError::Io {
        path: path.clone(),
        error,
    }
}
