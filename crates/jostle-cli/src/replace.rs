//! Files that commands write to paths that the user names.

use std::path::{Path, PathBuf};

use jostle_io::write_atomically;
use jostle_run::{FileKind, may_write};

use crate::failure::Failure;
use crate::terminal;

/// A file that may be written.
#[derive(Clone, Debug)]
pub(crate) struct Target {
    /// Where.
    pub(crate) path: PathBuf,
    replaces: bool,
}

impl Target {
    /// See [`jostle_run::may_write`]; asked before any work is done or any other file is written.
    ///
    /// # Errors
    /// The file must stay, or cannot be read.
    pub(crate) fn new(path: &Path, kind: FileKind, force: bool) -> Result<Self, Failure> {
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
        kind: FileKind,
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
