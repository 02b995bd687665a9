//! The one way in which files are opened for reading: what may be opened, what is no plain file, how much is read, and
//! which files a model turned out to name.

use std::collections::{BTreeMap, BTreeSet};
use std::fs::File;
use std::io::{self, Read};
use std::path::{Component, Path, PathBuf};
use std::sync::{Arc, Mutex, PoisonError};

/// Why a file is not read.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum FileError {
    /// The file system refused.
    #[error("cannot be read: {0}")]
    Io(#[from] io::Error),
    /// A folder, a pipe, a device.
    #[error("is {0}, not a file")]
    NotAFile(&'static str),
    /// More bytes than files of its kind need.
    #[error("has more than {}, the most that is read of such a file", size(*most))]
    TooLarge {
        /// Limit \[bytes\].
        most: usize,
    },
    /// More bytes than the file system states, as in `/proc`.
    #[error("has more bytes than its size states")]
    Grows,
    /// Not among the files that may be read.
    #[error(
        "is outside the folder of the model, the only one that is read here; copy the file into that folder, or name it in the model file and start again"
    )]
    Outside,
}

/// A number of bytes in words.
fn size(bytes: usize) -> String {
    match bytes {
        0..1024 => format!("{bytes} bytes"),
        1024..0x10_0000 => format!("{} KiB", bytes >> 10),
        _ => format!("{} MiB", bytes >> 20),
    }
}

/// The files that a model or a study may name: a folder from which relative names start, what may be read, and a report
/// of the names that were asked for. Clones share the report.
#[derive(Clone, Debug)]
pub struct Files {
    folder: PathBuf,
    allowed: Allowed,
    /// Files in memory that come before those of the machine, by the name that the model has for them.
    beside: Arc<BTreeMap<String, Vec<u8>>>,
    asked: Arc<Mutex<BTreeSet<String>>>,
}

/// What may be read.
#[derive(Clone, Debug, PartialEq)]
enum Allowed {
    Everything,
    /// Files of this folder, and these; all without links.
    Within(Arc<(PathBuf, Vec<PathBuf>)>),
    /// Files in memory, by the name that the model has for them.
    Held(Arc<BTreeMap<String, Vec<u8>>>),
}

impl PartialEq for Files {
    /// Whether the same names lead to the same files.
    fn eq(&self, other: &Self) -> bool {
        self.folder == other.folder && self.allowed == other.allowed && self.beside == other.beside
    }
}

impl Files {
    /// Every file of the machine; relative names start from this folder.
    #[must_use]
    pub fn beside(folder: &Path) -> Self {
        Self::new(folder, Allowed::Everything)
    }

    /// Only these files, by name, and none of the machine.
    #[must_use]
    pub fn held(files: BTreeMap<String, Vec<u8>>) -> Self {
        Self::new(Path::new(""), Allowed::Held(Arc::new(files)))
    }

    /// In words, from where relative names start.
    pub(crate) fn place_in_words(&self) -> String {
        match (&self.allowed, self.folder.as_os_str().is_empty()) {
            (Allowed::Held(_), _) => "among the given files".to_owned(),
            (_, true) => "in the current folder".to_owned(),
            (_, false) => format!("in the folder {}", self.folder.display()),
        }
    }

    fn new(folder: &Path, allowed: Allowed) -> Self {
        Self {
            folder: folder.to_owned(),
            allowed,
            beside: Arc::default(),
            asked: Arc::default(),
        }
    }

    /// The same with further files in memory, such as motions that a program has computed; they come first.
    #[must_use]
    pub fn with(&self, files: BTreeMap<String, Vec<u8>>) -> Self {
        Self {
            beside: Arc::new(files),
            ..self.afresh()
        }
    }

    /// The same folder, from which only its own files are read, and files with these names.
    #[must_use]
    pub fn confined(&self, names: &[String]) -> Self {
        if self.allowed != Allowed::Everything {
            return self.afresh();
        }
        let folder = or_here(&self.folder);
        let within = folder.canonicalize().unwrap_or_else(|_| folder.to_owned());
        let names = names.iter();
        let named = names.filter_map(|name| self.folder.join(name).canonicalize().ok());
        let allowed = Allowed::Within(Arc::new((within, named.collect())));
        Self {
            beside: Arc::clone(&self.beside),
            ..Self::new(&self.folder, allowed)
        }
    }

    /// The same permissions; relative names start from this folder, itself relative to the present one.
    #[must_use]
    pub fn starting_in(&self, folder: &Path) -> Self {
        Self {
            folder: self.folder.join(folder),
            ..self.afresh()
        }
    }

    /// The same with a report of its own, which is empty.
    #[must_use]
    pub fn afresh(&self) -> Self {
        Self {
            asked: Arc::default(),
            ..self.clone()
        }
    }

    /// The folder from which relative names start.
    #[must_use]
    pub fn folder(&self) -> &Path {
        &self.folder
    }

    /// Names of files that were asked for so far, as written, whether they were there or not; sorted.
    #[must_use]
    pub fn asked(&self) -> Vec<String> {
        let asked = self.asked.lock().unwrap_or_else(PoisonError::into_inner);
        asked.iter().cloned().collect()
    }

    /// The path of a name for messages.
    #[must_use]
    pub fn shown(&self, name: &str) -> PathBuf {
        self.folder.join(name)
    }

    /// The bytes of a file, at most `most`.
    ///
    /// # Errors
    /// [`FileError`].
    pub fn read(&self, name: &str, most: usize) -> Result<Vec<u8>, FileError> {
        self.note(name);
        let held = match &self.allowed {
            Allowed::Held(files) => files.get(name),
            _ => None,
        };
        match self.beside.get(name).or(held) {
            Some(bytes) if bytes.len() > most => Err(FileError::TooLarge { most }),
            Some(bytes) => Ok(bytes.clone()),
            None if matches!(self.allowed, Allowed::Held(_)) => {
                Err(io::Error::from(io::ErrorKind::NotFound).into())
            }
            None => read_file(&self.place(name)?, most),
        }
    }

    /// Whether there is something of this name.
    ///
    /// # Errors
    /// [`FileError::Outside`] for a name that may not be read, whether it exists or not.
    pub(crate) fn has(&self, name: &str) -> Result<bool, FileError> {
        self.note(name);
        match &self.allowed {
            _ if self.beside.contains_key(name) => Ok(true),
            Allowed::Held(files) => Ok(files.contains_key(name)),
            _ => Ok(self.place(name)?.exists()),
        }
    }

    /// Whether a name is a folder that may be read.
    pub(crate) fn folder_of(&self, name: &str) -> Option<PathBuf> {
        let folder = match &self.allowed {
            Allowed::Held(_) => return None,
            _ => self.place(name).ok()?,
        };
        folder.is_dir().then_some(folder)
    }

    /// Names of what lies beside a name, up to 10,000; none where that folder may not be read.
    #[must_use]
    pub fn names_beside(&self, name: &str) -> Vec<String> {
        let parent = Path::new(name).parent().unwrap_or(Path::new(""));
        let inside = match &self.allowed {
            Allowed::Held(files) => return files.keys().cloned().collect(),
            _ => self.folder.join(parent),
        };
        let inside = or_here(&inside);
        let Ok(found) = inside.canonicalize() else {
            return Vec::new();
        };
        if let Allowed::Within(within) = &self.allowed
            && !found.starts_with(&within.0)
        {
            return Vec::new();
        }
        let entries = std::fs::read_dir(found).into_iter().flatten().flatten();
        entries
            .take(10_000)
            .map(|entry| entry.file_name().to_string_lossy().into_owned())
            .collect()
    }

    fn note(&self, name: &str) {
        let mut asked = self.asked.lock().unwrap_or_else(PoisonError::into_inner);
        if !asked.contains(name) {
            asked.insert(name.to_owned());
        }
    }

    /// The path of a name that may be read.
    fn place(&self, name: &str) -> Result<PathBuf, FileError> {
        let path = self.folder.join(name);
        let Allowed::Within(within) = &self.allowed else {
            return Ok(path);
        };
        let (folder, named) = &**within;
        match path.canonicalize() {
            Ok(found) if found.starts_with(folder) || named.contains(&found) => Ok(found),
            Ok(_) => Err(FileError::Outside),
            // There is none: only a name that stays in the folder may say so.
            Err(_) => {
                let stays =
                    |part: Component<'_>| matches!(part, Component::Normal(_) | Component::CurDir);
                let stays = Path::new(name).components().all(stays);
                stays.then_some(path).ok_or(FileError::Outside)
            }
        }
    }
}

/// A folder as the file system takes it: the empty path is the current folder.
fn or_here(folder: &Path) -> &Path {
    if folder == Path::new("") {
        Path::new(".")
    } else {
        folder
    }
}

/// A plain file, to be read piece by piece. Pipes, devices and folders are refused before they are opened.
///
/// # Errors
/// [`FileError`].
pub fn open_file(path: &Path) -> Result<File, FileError> {
    plain(&std::fs::metadata(path)?)?;
    let file = File::open(path)?;
    plain(&file.metadata()?)?;
    Ok(file)
}

/// The bytes of a plain file, at most `most`. Pipes, devices and folders are refused before they are opened.
///
/// # Errors
/// [`FileError`].
pub fn read_file(path: &Path, most: usize) -> Result<Vec<u8>, FileError> {
    let file = open_file(path)?;
    let found = file.metadata()?;
    let stated = usize::try_from(found.len()).unwrap_or(usize::MAX);
    if stated > most {
        return Err(FileError::TooLarge { most });
    }
    let mut bytes = Vec::with_capacity(stated + 1);
    file.take(stated as u64 + 1).read_to_end(&mut bytes)?;
    if bytes.len() > stated {
        return Err(FileError::Grows);
    }
    Ok(bytes)
}

/// The text of a plain file, without a byte-order mark.
///
/// # Errors
/// [`FileError`]; text that is not UTF-8 is [`FileError::Io`].
pub fn read_text_file(path: &Path, most: usize) -> Result<String, FileError> {
    let bytes = read_file(path, most)?;
    let text = String::from_utf8(bytes);
    let mut text =
        text.map_err(|_| io::Error::new(io::ErrorKind::InvalidData, "it is not UTF-8"))?;
    if text.starts_with('\u{feff}') {
        text.remove(0);
    }
    Ok(text)
}

/// Refuses what is no plain file.
///
/// # Errors
/// [`FileError::NotAFile`].
pub fn plain(found: &std::fs::Metadata) -> Result<(), FileError> {
    if found.is_file() {
        return Ok(());
    }
    Err(FileError::NotAFile(kind(found)))
}

#[cfg(unix)]
fn kind(found: &std::fs::Metadata) -> &'static str {
    use std::os::unix::fs::FileTypeExt;
    let kind = found.file_type();
    if kind.is_dir() {
        "a folder"
    } else if kind.is_fifo() {
        "a named pipe"
    } else if kind.is_socket() {
        "a socket"
    } else {
        "a device"
    }
}

#[cfg(not(unix))]
fn kind(found: &std::fs::Metadata) -> &'static str {
    if found.is_dir() {
        "a folder"
    } else {
        "a device"
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn only_the_folder_and_what_was_named_is_read() {
        let outer = tempfile::tempdir().expect("a folder");
        let inner = outer.path().join("inner");
        std::fs::create_dir(&inner).expect("a folder");
        for name in ["outside", "named", "inner/own"] {
            std::fs::write(outer.path().join(name), name).expect("a file");
        }
        let open = Files::beside(&inner);
        assert!(open.read("../outside", 100).is_ok());
        assert_eq!(open.asked(), ["../outside"]);
        let files = open.confined(&["../named".to_owned()]);
        assert!(files.asked().is_empty());
        assert_eq!(files.read("own", 100).expect("own"), b"inner/own");
        assert_eq!(files.read("../named", 100).expect("named"), b"named");
        for name in ["../outside", "../nothing", "/etc/passwd", "/etc/nothing"] {
            assert!(
                matches!(files.read(name, 100), Err(FileError::Outside)),
                "{name}"
            );
            assert!(matches!(files.has(name), Err(FileError::Outside)));
        }
        assert!(files.names_beside("../x").is_empty());
        assert_eq!(files.names_beside("x"), ["own"]);
        // Once confined, always confined.
        let again = files.confined(&["../outside".to_owned()]);
        assert!(again.read("../outside", 100).is_err());
    }

    #[test]
    fn files_in_memory_are_the_only_ones() {
        let files = Files::held(BTreeMap::from([("a.csv".to_owned(), vec![1, 2, 3])]));
        assert_eq!(files.read("a.csv", 3).expect("held"), [1, 2, 3]);
        assert!(matches!(
            files.read("a.csv", 2),
            Err(FileError::TooLarge { most: 2 })
        ));
        assert!(files.read("/etc/passwd", 1 << 20).is_err());
        assert!(files.has("/etc/passwd").is_ok_and(|there| !there));
    }
}
