//! Files that were verified and have not changed since.

use std::collections::HashMap;
use std::path::{Path, PathBuf};
use std::sync::{Mutex, PoisonError};
use std::time::{Duration, SystemTime};

/// Files that were verified, as they were then.
#[derive(Debug, Default)]
pub(crate) struct Verified(Mutex<HashMap<PathBuf, Stamp>>);

/// What a file that is changed does not keep: its length, the time of its last change, and its place on the disk.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Stamp(u64, SystemTime, u64);

/// Age from which the time of the last change tells every later change: clocks of file systems tick slowly.
const OLD: Duration = Duration::from_secs(2);

impl Stamp {
    /// That of a file now; `None` if it is gone, or too young for a stamp.
    pub(crate) fn of(path: &Path) -> Option<Self> {
        let found = std::fs::metadata(path).ok()?;
        let changed = found.modified().ok()?;
        let is_old = changed.elapsed().is_ok_and(|age| age >= OLD);
        is_old.then(|| Self(found.len(), changed, place(&found)))
    }
}

#[cfg(unix)]
fn place(found: &std::fs::Metadata) -> u64 {
    std::os::unix::fs::MetadataExt::ino(found)
}

#[cfg(not(unix))]
fn place(_: &std::fs::Metadata) -> u64 {
    0
}

impl Verified {
    /// Whether a file was verified with this stamp.
    pub(crate) fn holds(&self, path: &Path, stamp: Option<Stamp>) -> bool {
        let known = self.0.lock().unwrap_or_else(PoisonError::into_inner);
        stamp.is_some() && known.get(path) == stamp.as_ref()
    }

    /// Notes that a file was verified, with its stamp before it was read.
    pub(crate) fn note(&self, path: PathBuf, stamp: Option<Stamp>) {
        if let Some(stamp) = stamp {
            let mut known = self.0.lock().unwrap_or_else(PoisonError::into_inner);
            known.insert(path, stamp);
        }
    }
}
