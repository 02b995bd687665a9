//! Files that exist where one is to be written: never lost without being asked for.

use std::io::{Read, Seek, SeekFrom};
use std::path::{Path, PathBuf};

use jostle_io::{OutputError, write_atomically};

use crate::failure::Failure;
use crate::terminal;

/// How much of the beginning and of the end of a file is read to see what it is \[bytes\].
const LOOK: u64 = 8192;

/// A kind of file that jostle writes.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Kind {
    /// Its type, as in "is no summary of jostle".
    pub(crate) name: &'static str,
    /// Texts that its first or last kilobytes contain.
    pub(crate) marks: &'static [&'static str],
}

impl Kind {
    /// Tables in Parquet.
    pub(crate) const TABLE: Self = Self {
        name: "table of jostle",
        marks: &["PAR1", "jostle "],
    };
    /// Summaries of runs.
    pub(crate) const SUMMARY: Self = Self {
        name: "summary of jostle",
        marks: &["\"title\":", "\"jostle\":", "\"motion\":"],
    };
    /// Reports of runs, and pages of collisions and motions.
    pub(crate) const REPORT: Self = Self {
        name: "report of jostle",
        marks: &["<html", " – jostle</title>"],
    };
    /// Pages of sections.
    pub(crate) const SECTIONS: Self = Self {
        name: "page of sections that jostle wrote",
        marks: &["<html", " – sections</title>"],
    };
    /// Pages of `jostle method`.
    pub(crate) const METHOD: Self = Self {
        name: "page of jostle method",
        marks: &["<html", " – the method</title>"],
    };
    /// Pages, curves and numbers of `jostle pushover`.
    pub(crate) const PUSHOVER_PAGE: Self = Self {
        name: "page of jostle pushover",
        marks: &["<html", " – pushover</title>"],
    };
    /// See [`Self::PUSHOVER_PAGE`].
    pub(crate) const PUSHOVER_CURVES: Self = Self {
        name: "table of jostle pushover",
        marks: &["building,direction,point,roof_displacement_m,roof_drift,"],
    };
    /// See [`Self::PUSHOVER_PAGE`].
    pub(crate) const PUSHOVER_NUMBERS: Self = Self {
        name: "result of jostle pushover",
        marks: &["\"curves\":", "\"jostle\":", "\"title\":"],
    };
    /// Curves of `jostle collide`.
    pub(crate) const COLLISION_CURVES: Self = Self {
        name: "table of jostle collide",
        marks: &["law,time_s,indentation_m,rate_m_s,force_n\n"],
    };
    /// Spectra of `jostle motion spectrum`.
    pub(crate) const SPECTRA: Self = Self {
        name: "table of jostle motion spectrum",
        marks: &["period_s,sd_", "pct_m,psv_"],
    };
}

/// A file that may be written.
#[derive(Clone, Debug)]
pub(crate) struct Target {
    /// Where.
    pub(crate) path: PathBuf,
    replaces: bool,
}

impl Target {
    /// See [`may_write`]; asked before any work is done or any other file is written.
    ///
    /// # Errors
    /// The file must stay, or cannot be read.
    pub(crate) fn new(path: &Path, kind: Kind, force: bool) -> Result<Self, Failure> {
        Ok(Self {
            path: path.to_owned(),
            replaces: may_write(path, Some(kind), force)?,
        })
    }

    /// The same for an option that may be absent.
    ///
    /// # Errors
    /// As [`Self::new`].
    pub(crate) fn of_option(
        path: Option<&PathBuf>,
        kind: Kind,
        force: bool,
    ) -> Result<Option<Self>, Failure> {
        path.map(|path| Self::new(path, kind, force)).transpose()
    }

    /// Writes the file whole and reports if it replaced one.
    ///
    /// # Errors
    /// The file cannot be written; it is then as it was before.
    pub(crate) fn write(&self, text: &str) -> Result<(), Failure> {
        write_atomically(&self.path, text.as_bytes())?;
        self.written();
        Ok(())
    }

    /// Reports if the file, written by other means, replaced one.
    pub(crate) fn written(&self) {
        if self.replaces {
            terminal::remark(&format!("replaced: {}", self.path.display()));
        }
    }
}

/// Whether writing `path` replaces a file that is not empty.
///
/// Files of `kind` may be replaced; all others, and everything if no kind is given, only with `force`.
///
/// # Errors
/// The file must stay, or cannot be read.
pub(crate) fn may_write(path: &Path, kind: Option<Kind>, force: bool) -> Result<bool, Failure> {
    let shown = path.display();
    let io = |error| {
        Failure::from(OutputError::Io {
            path: path.to_owned(),
            error,
        })
    };
    let ends = match std::fs::metadata(path) {
        Err(error) if error.kind() == std::io::ErrorKind::NotFound => return Ok(false),
        Err(error) => return Err(io(error)),
        Ok(found) if found.is_dir() => {
            return Err(Failure::Input(format!(
                "{shown} is a folder; name a file in it"
            )));
        }
        // Devices, such as /dev/null, lose nothing.
        Ok(found) if !found.is_file() || found.len() == 0 => return Ok(false),
        Ok(_) if force => return Ok(true),
        Ok(found) => ends(path, found.len()).map_err(io)?,
    };
    match kind {
        Some(kind) if kind.marks.iter().all(|mark| ends.contains(mark)) => Ok(true),
        Some(kind) => Err(Failure::Input(format!(
            "{shown} exists already and is no {}; choose another name or folder, or add --force to replace it",
            kind.name
        ))),
        None => Err(Failure::Input(format!(
            "{shown} exists already; choose another name or folder, or add --force to replace it"
        ))),
    }
}

/// The beginning and the end of a file, as far as they are text.
fn ends(path: &Path, len: u64) -> std::io::Result<String> {
    let mut file = std::fs::File::open(path)?;
    let mut bytes = Vec::new();
    file.by_ref().take(LOOK).read_to_end(&mut bytes)?;
    file.seek(SeekFrom::Start(len.saturating_sub(LOOK)))?;
    file.take(LOOK).read_to_end(&mut bytes)?;
    Ok(String::from_utf8_lossy(&bytes).into_owned())
}
