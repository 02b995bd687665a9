//! Files that are not part of a study are moved aside, so that readers of `cases/*.parquet` do not include them;
//! nothing is deleted.

use std::collections::HashSet;
use std::ffi::OsString;
use std::io;
use std::path::{Path, PathBuf};

use super::part_path;
use crate::study::Study;

/// Folder of files that were set aside.
const FOLDER: &str = "set-aside";

/// Moves a file into the folder `set-aside`, with a label in its name, and returns where it is now. `None` if
/// another process has moved it.
pub(crate) fn set_aside(folder: &Path, path: &Path, label: &str) -> io::Result<Option<PathBuf>> {
    let target = free_name(folder, path, label)?;
    match std::fs::rename(path, &target) {
        Ok(()) => Ok(Some(target)),
        Err(error) if error.kind() == io::ErrorKind::NotFound => Ok(None),
        Err(error) => Err(error),
    }
}

/// Copies a file that is about to be rewritten, and returns the path of the copy.
pub(crate) fn keep_copy(
    folder: &Path,
    path: &Path,
    label: &str,
    bytes: &[u8],
) -> io::Result<PathBuf> {
    let target = free_name(folder, path, label)?;
    std::fs::write(&target, bytes)?;
    Ok(target)
}

/// `part-….damaged.parquet` in the folder `set-aside`, numbered if that name is taken.
fn free_name(folder: &Path, path: &Path, label: &str) -> io::Result<PathBuf> {
    let folder = folder.join(FOLDER);
    std::fs::create_dir_all(&folder)?;
    let named = |number: usize| {
        let mut name = OsString::from(path.file_stem().unwrap_or_default());
        name.push(format!(".{label}"));
        if number > 1 {
            name.push(format!("-{number}"));
        }
        if let Some(extension) = path.extension() {
            name.push(".");
            name.push(extension);
        }
        folder.join(name)
    };
    let mut number = 1;
    while named(number).exists() {
        number += 1;
    }
    Ok(named(number))
}

/// Parquet files among the parts whose names belong to no part of the study, sorted.
pub(crate) fn strangers(study: &Study, folder: &Path) -> Vec<PathBuf> {
    let part_path: HashSet<PathBuf> = (0..study.parts())
        .map(|part| part_path(folder, study.part(part).start))
        .collect();
    let entries = std::fs::read_dir(folder.join("cases"));
    let paths = entries.into_iter().flatten().flatten();
    let mut strangers: Vec<PathBuf> = paths
        .map(|entry| entry.path())
        .filter(|path| {
            path.extension().is_some_and(|e| e == "parquet") && !part_path.contains(path)
        })
        .collect();
    strangers.sort();
    strangers
}
