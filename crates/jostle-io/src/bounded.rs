//! Reading files without trusting their size: devices and pipes state none, and some never end.

#[cfg(not(target_family = "wasm"))]
use std::fs::File;
use std::io;
#[cfg(not(target_family = "wasm"))]
use std::io::Read;
use std::path::Path;
#[cfg(target_family = "wasm")]
use std::{
    collections::BTreeMap,
    path::PathBuf,
    sync::{Mutex, PoisonError},
};

/// Files of a page without a server: WebAssembly has no file system.
#[cfg(target_family = "wasm")]
static FILES: Mutex<BTreeMap<PathBuf, Vec<u8>>> = Mutex::new(BTreeMap::new());

/// Keeps a file in memory, under the path by which a model names it.
#[cfg(target_family = "wasm")]
pub fn provide_file(path: &Path, bytes: Vec<u8>) {
    let mut files = FILES.lock().unwrap_or_else(PoisonError::into_inner);
    files.insert(path.to_owned(), bytes);
}

/// Whether there is a file or folder at a path.
pub(crate) fn exists(path: &Path) -> bool {
    #[cfg(target_family = "wasm")]
    {
        let files = FILES.lock().unwrap_or_else(PoisonError::into_inner);
        files.contains_key(path)
    }
    #[cfg(not(target_family = "wasm"))]
    path.exists()
}

/// The bytes of a file, pipe or device, or nothing when there are more than `most`.
///
/// # Errors
/// When the file cannot be opened or read.
pub(crate) fn read_at_most(path: &Path, most: usize) -> io::Result<Option<Vec<u8>>> {
    #[cfg(target_family = "wasm")]
    {
        let files = FILES.lock().unwrap_or_else(PoisonError::into_inner);
        let bytes = files.get(path).ok_or(io::ErrorKind::NotFound)?;
        return Ok((bytes.len() <= most).then(|| bytes.clone()));
    }
    #[cfg(not(target_family = "wasm"))]
    read_from_disk(path, most)
}

#[cfg(not(target_family = "wasm"))]
fn read_from_disk(path: &Path, most: usize) -> io::Result<Option<Vec<u8>>> {
    let file = File::open(path)?;
    let stated = usize::try_from(file.metadata()?.len()).unwrap_or(usize::MAX);
    if stated > most {
        return Ok(None);
    }
    let mut bytes = Vec::with_capacity(stated + 1);
    file.take(most as u64 + 1).read_to_end(&mut bytes)?;
    Ok((bytes.len() <= most).then_some(bytes))
}
