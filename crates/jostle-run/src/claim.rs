//! A folder that one run writes into at a time.

use std::fs::{File, OpenOptions};
use std::io::ErrorKind;
use std::path::{Path, PathBuf};
use std::time::Duration;

use fs4::{FileExt, TryLockError};

use crate::error::RunError;

/// Name of the file that is locked while a folder is written.
const NAME: &str = ".jostle-claim";
/// Attempts to lock a file that nobody removes in between.
const TRIES: usize = 10;

/// A claim to a folder; it ends with this or with the process.
#[derive(Debug)]
pub struct FolderClaim {
    /// `None` on a file system without locks.
    locked: Option<(File, PathBuf)>,
}

impl FolderClaim {
    /// Claims a folder that exists, and removes what killed runs left in it.
    ///
    /// # Errors
    /// [`RunError::Kept`] while another run writes into it.
    pub fn new(folder: &Path) -> Result<Self, RunError> {
        let path = folder.join(NAME);
        for _ in 0..TRIES {
            let mut options = OpenOptions::new();
            let opened = options.create(true).append(true).open(&path);
            // Without a place for the claim, the files themselves will say why they cannot be written.
            let Ok(file) = opened else { break };
            match FileExt::try_lock(&file) {
                Ok(()) if is_at(&file, &path) => {
                    jostle_io::remove_leftovers(folder, Duration::ZERO);
                    return Ok(Self {
                        locked: Some((file, path)),
                    });
                }
                // The run before removed it in between.
                Ok(()) => {}
                Err(TryLockError::WouldBlock) => {
                    return Err(RunError::Kept(format!(
                        "another run is writing into {}; wait for its end, or choose another folder with --out",
                        folder.display()
                    )));
                }
                Err(TryLockError::Error(_)) => {
                    // A file system without locks: nothing to claim with.
                    let _ = std::fs::remove_file(&path);
                    break;
                }
            }
        }
        Ok(Self { locked: None })
    }
}

impl Drop for FolderClaim {
    fn drop(&mut self) {
        if let Some((file, path)) = self.locked.take() {
            // Removed while it is locked, so that nobody has it by then.
            let _ = std::fs::remove_file(path);
            drop(file);
        }
    }
}

/// Whether a file is the one at a path.
#[cfg(unix)]
fn is_at(file: &File, path: &Path) -> bool {
    use std::os::unix::fs::MetadataExt;
    let place = |found: std::fs::Metadata| (found.dev(), found.ino());
    match (file.metadata(), std::fs::metadata(path)) {
        (Ok(metadata), Ok(there)) => place(metadata) == place(there),
        (_, Err(error)) => error.kind() != ErrorKind::NotFound,
        _ => true,
    }
}

/// Whether a file is the one at a path: elsewhere, what is open is not removed.
#[cfg(not(unix))]
fn is_at(_: &File, path: &Path) -> bool {
    let found = std::fs::metadata(path);
    found.map_or_else(|error| error.kind() != ErrorKind::NotFound, |_| true)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_folder_is_claimed_once_and_leftovers_go() {
        let folder = tempfile::tempdir().expect("a folder");
        let path = folder.path();
        let leftover = path.join(format!("{}own.part", jostle_io::part_prefix()));
        // No process has this number.
        let dead = path.join(".jostle-4294967295-dead.part");
        std::fs::create_dir(&dead).expect("a folder");
        for file in [&leftover, &path.join("summary.json"), &dead.join("x")] {
            std::fs::write(file, "x").expect("a file");
        }
        let first = FolderClaim::new(path).expect("free");
        assert!(!cfg!(target_os = "linux") || !dead.exists());
        assert!(leftover.exists() && path.join("summary.json").exists());
        let second = FolderClaim::new(path).expect_err("taken").to_string();
        assert!(second.contains("another run"), "{second}");
        drop(first);
        assert!(!path.join(NAME).exists());
        drop(FolderClaim::new(path).expect("free again"));
    }
}
