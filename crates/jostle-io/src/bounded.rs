//! Reading files without trusting their size: devices and pipes state none, and some never end.

use std::fs::File;
use std::io::{self, Read};
use std::path::Path;

/// The bytes of a file, pipe or device, or nothing when there are more than `most`.
///
/// # Errors
/// When the file cannot be opened or read.
pub(crate) fn read_at_most(path: &Path, most: usize) -> io::Result<Option<Vec<u8>>> {
    let file = File::open(path)?;
    let stated = usize::try_from(file.metadata()?.len()).unwrap_or(usize::MAX);
    if stated > most {
        return Ok(None);
    }
    let mut bytes = Vec::with_capacity(stated + 1);
    file.take(most as u64 + 1).read_to_end(&mut bytes)?;
    Ok((bytes.len() <= most).then_some(bytes))
}
