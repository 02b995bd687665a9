//! Files of results: written whole or not at all.

use std::fs::File;
use std::io::Write;
use std::path::{Path, PathBuf};
use std::time::Duration;

use jostle::Summary;

/// Why a result file could not be written.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum OutputError {
    /// The file system refused.
    #[error("{}: cannot be written: {error}", path.display())]
    Io {
        /// The file.
        path: PathBuf,
        /// The reason.
        error: std::io::Error,
    },
    /// The table could not be encoded.
    #[error("{}: cannot be encoded: {reason}", path.display())]
    Encoding {
        /// The file.
        path: PathBuf,
        /// The reason.
        reason: String,
    },
}

/// Ends of names of what is being written.
pub const PART_SUFFIX: &str = ".part";

/// Begins of the names of what this process is writing: they say whose it is.
#[must_use]
pub fn part_prefix() -> String {
    format!(".jostle-{}-", std::process::id())
}

/// Removes what processes that were killed left behind in a folder while they wrote: what bears the number of a process
/// that is gone, and is older than `age`.
pub fn remove_leftovers(folder: &Path, age: Duration) {
    let entries = std::fs::read_dir(folder).into_iter().flatten().flatten();
    for entry in entries {
        let name = entry.file_name();
        let owner = name.to_str().and_then(owner);
        if !owner.is_some_and(is_gone) {
            continue;
        }
        let old = |found: std::fs::Metadata| {
            let changed = found.modified().ok()?;
            Some(changed.elapsed().unwrap_or_default() >= age)
        };
        if !entry.metadata().ok().and_then(old).unwrap_or(false) {
            continue;
        }
        // Whoever else removes it at the same time is welcome.
        let _ = match entry.file_type() {
            Ok(kind) if kind.is_dir() => std::fs::remove_dir_all(entry.path()),
            _ => std::fs::remove_file(entry.path()),
        };
    }
}

/// The process that a name of something being written bears.
fn owner(name: &str) -> Option<u32> {
    let inside = name.strip_prefix(".jostle-")?.strip_suffix(PART_SUFFIX)?;
    inside.split_once('-')?.0.parse().ok()
}

/// Whether there is no such process. Where that cannot be told there is one.
fn is_gone(process: u32) -> bool {
    let processes = Path::new("/proc");
    process != std::process::id()
        && processes.join("self").exists()
        && !processes.join(process.to_string()).exists()
}

/// Writes a file under a temporary name in the same folder, then renames it, so that a reader sees the old file
/// or the new one, never a part.
///
/// # Errors
/// [`OutputError::Io`] with path and reason.
pub fn write_atomically(path: &Path, bytes: &[u8]) -> Result<(), OutputError> {
    write_atomically_by(path, |file| file.write_all(bytes))
}

/// The same for contents that come piece by piece.
pub(crate) fn write_atomically_by(
    path: &Path,
    contents: impl FnOnce(&mut File) -> std::io::Result<()>,
) -> Result<(), OutputError> {
    let write = || -> std::io::Result<()> {
        let elsewhere = std::env::temp_dir();
        let folder = match path.parent() {
            // Beside a device there may be no room for files.
            _ if is_stream(path) => &elsewhere,
            Some(parent) if parent != Path::new("") => parent,
            _ => Path::new("."),
        };
        let prefix = part_prefix();
        let mut builder = tempfile::Builder::new();
        builder.prefix(&prefix).suffix(PART_SUFFIX);
        readable_by_all(&mut builder);
        let mut file = builder.tempfile_in(folder)?;
        contents(file.as_file_mut())?;
        file.as_file().sync_all()?;
        persist(file.into_temp_path(), path)
    };
    write().map_err(|error| OutputError::Io {
        path: path.to_owned(),
        error,
    })
}

/// How often and how long \[ms\] to try. On Windows a file cannot be replaced while a virus scanner or an indexer has it
/// open, which is over in a moment.
const TRIES: (u32, u64) = if cfg!(windows) { (10, 50) } else { (1, 0) };

/// Moves a finished file to its place on the same file system, where it replaces an earlier one.
///
/// # Errors
/// [`OutputError::Io`] with the place and the reason; the file is then gone.
pub fn put_in_place(file: &Path, path: &Path) -> Result<(), OutputError> {
    let moved = tempfile::TempPath::try_from_path(file).and_then(|file| persist(file, path));
    moved.map_err(|error| OutputError::Io {
        path: path.to_owned(),
        error,
    })
}

/// Whether a path is that of a device or a pipe, into which a file is written and which it never replaces.
fn is_stream(path: &Path) -> bool {
    std::fs::metadata(path).is_ok_and(|found| !found.is_file() && !found.is_dir())
}

fn persist(mut file: tempfile::TempPath, path: &Path) -> std::io::Result<()> {
    if is_stream(path) {
        return std::fs::copy(&file, path).map(|_| ());
    }
    let mut left = TRIES.0;
    loop {
        left -= 1;
        match file.persist(path) {
            Ok(()) => return Ok(()),
            Err(failed)
                if left > 0 && failed.error.kind() == std::io::ErrorKind::PermissionDenied =>
            {
                file = failed.path;
                std::thread::sleep(Duration::from_millis(TRIES.1));
            }
            Err(failed) => return Err(failed.error),
        }
    }
}

/// Temporary files are private by default; results follow the user's umask.
#[cfg(unix)]
fn readable_by_all(builder: &mut tempfile::Builder<'_, '_>) {
    use std::os::unix::fs::PermissionsExt;
    builder.permissions(std::fs::Permissions::from_mode(0o666));
}

#[cfg(not(unix))]
fn readable_by_all(_: &mut tempfile::Builder<'_, '_>) {}

/// Text of `summary.json`, with a final line break.
#[must_use]
pub fn summary_json(summary: &Summary) -> String {
    // Plain structs of numbers and strings always serialise.
    let text = serde_json::to_string_pretty(summary).unwrap_or_default();
    text + "\n"
}

/// Writes `summary.json`.
///
/// # Errors
/// [`OutputError`] with path and reason.
pub fn write_summary_json(path: &Path, summary: &Summary) -> Result<(), OutputError> {
    write_atomically(path, summary_json(summary).as_bytes())
}
