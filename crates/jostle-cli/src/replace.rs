//! Files that exist where one is to be written: never lost without being asked for.

use std::io::{Read, Seek, SeekFrom};
use std::path::Path;

use jostle_io::OutputError;

use crate::failure::Failure;

/// How much of the beginning and of the end of a file is read to see what it is \[bytes\].
const LOOK: u64 = 8192;

/// A kind of file that jostle writes.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Kind {
    /// What it is, as in "is no summary of jostle".
    pub(crate) name: &'static str,
    /// All of this stands in its first or last kilobytes.
    pub(crate) marks: &'static [&'static str],
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
