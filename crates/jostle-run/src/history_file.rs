//! [`STORAGE`]: where the histories of runs are kept, in memory up to a bound and in temporary files beyond.

use jostle::history::Storage;

/// Where the histories of runs are kept. Beyond `IN_MEMORY` each goes to a temporary file, of which nothing stays behind when the
/// process is killed. In WebAssembly, which has no files, all are in memory.
#[cfg(not(target_family = "wasm"))]
pub const STORAGE: Storage = Storage {
    store: || Box::new(on_disk::HistoryFile::default()),
    ..Storage::MEMORY
};
/// Where the histories of runs are kept. WebAssembly has no files.
#[cfg(target_family = "wasm")]
pub const STORAGE: Storage = Storage::MEMORY;

/// Folder of the temporary files, and its free space, where it can be known \[bytes\].
pub(crate) fn room_for_histories() -> Option<(std::path::PathBuf, f64)> {
    #[cfg(not(target_family = "wasm"))]
    {
        let folder = on_disk::temporary_folder();
        let free = fs4::available_space(&folder).ok()? as f64;
        Some((folder, free))
    }
    #[cfg(target_family = "wasm")]
    None
}

/// Full blocks of a history that stay in memory.
const BLOCKS_IN_MEMORY: usize = 4;

/// Most memory of a history \[bytes\]: full blocks, the newest rows, and these once more on their way to the file.
pub(crate) const IN_MEMORY: f64 = ((BLOCKS_IN_MEMORY + 2) * Storage::MEMORY.block) as f64;

#[cfg(not(target_family = "wasm"))]
mod on_disk {
    use std::fs::File;
    use std::io::{self, Read, Seek, SeekFrom, Write};
    use std::path::{Path, PathBuf};
    use std::sync::{Mutex, PoisonError};

    use jostle::history::BlockStore;

    use super::BLOCKS_IN_MEMORY;

    /// Numbers that are written at a time.
    const AT_ONCE: usize = 8192;

    /// The folder of temporary files: that of the environment, or the one that Unix has for large files, because `/tmp` is
    /// often in memory.
    pub(crate) fn temporary_folder() -> PathBuf {
        let large = Path::new("/var/tmp");
        if cfg!(unix) && std::env::var_os("TMPDIR").is_none() && large.is_dir() {
            return large.to_owned();
        }
        std::env::temp_dir()
    }

    /// Blocks of equal length: the first in memory, the others in a file without a name.
    #[derive(Debug, Default)]
    pub(super) struct HistoryFile {
        first: Vec<Vec<f64>>,
        beyond: Option<Mutex<File>>,
        bytes: Vec<u8>,
    }

    impl HistoryFile {
        /// Appends a block to the file, which begins with the first one.
        fn append(&mut self, block: &[f64]) -> io::Result<()> {
            let file = match &mut self.beyond {
                Some(file) => file,
                None => {
                    let file = tempfile::tempfile_in(temporary_folder())?;
                    self.beyond.insert(Mutex::new(file))
                }
            };
            let file = file.get_mut().unwrap_or_else(PoisonError::into_inner);
            file.seek(SeekFrom::End(0))?;
            for numbers in block.chunks(AT_ONCE) {
                self.bytes.clear();
                let bytes = numbers.iter().flat_map(|number| number.to_le_bytes());
                self.bytes.extend(bytes);
                file.write_all(&self.bytes)?;
            }
            Ok(())
        }

        fn read_file(&self, at: usize, numbers: &mut [f64]) -> io::Result<()> {
            let Some(file) = &self.beyond else {
                return Err(io::ErrorKind::NotFound.into());
            };
            let mut bytes = vec![0; 8 * numbers.len()];
            let mut file = file.lock().unwrap_or_else(PoisonError::into_inner);
            file.seek(SeekFrom::Start(8 * at as u64))?;
            file.read_exact(&mut bytes)?;
            let known = bytes.as_chunks().0.iter();
            let pairs = numbers.iter_mut().zip(known);
            pairs.for_each(|(number, bytes)| *number = f64::from_le_bytes(*bytes));
            Ok(())
        }
    }

    impl BlockStore for HistoryFile {
        fn add(&mut self, block: Vec<f64>) -> Result<(), String> {
            if self.first.len() < BLOCKS_IN_MEMORY {
                self.first.push(block);
                return Ok(());
            }
            self.append(&block).map_err(|error| {
                format!(
                    "a temporary file in {} cannot be written: {error}; free space there, set TMPDIR to a folder with more, or write a longer interval under [output]",
                    temporary_folder().display()
                )
            })
        }

        fn read(&self, block: usize, first: usize, numbers: &mut [f64]) -> Result<(), String> {
            if let Some(known) = self.first.get(block) {
                numbers.copy_from_slice(&known[first..first + numbers.len()]);
                return Ok(());
            }
            let length = self.first[0].len();
            let at = (block - self.first.len()) * length + first;
            self.read_file(at, numbers).map_err(|error| {
                format!(
                    "a temporary file in {} cannot be read: {error}; run again, with TMPDIR set to a folder on another disk",
                    temporary_folder().display()
                )
            })
        }
    }
}
