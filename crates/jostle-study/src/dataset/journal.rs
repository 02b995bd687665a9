//! Finished cases of an unfinished part: appended one by one, and read back after a crash.
//!
//! The file of the journal is also the claim to its part. The lock on it belongs to the process: it is gone when the
//! process is, however it ended.

use std::fs::{File, OpenOptions};
use std::io::{Read, Seek, SeekFrom, Write};
use std::path::{Path, PathBuf};
use std::time::Duration;

use fs4::{FileExt, TryLockError};

use crate::row::Row;

/// A claim to a part.
pub(crate) enum Claim {
    /// It is ours, with the rows that were finished before; without a journal if there are no locks here, for this reason.
    Ours(Result<Journal, std::io::Error>, Vec<Row>),
    /// Another process computes it.
    Taken,
}

/// An open journal; the part is claimed as long as this lives.
pub(crate) struct Journal {
    file: File,
    path: PathBuf,
}

/// Largest journal \[bytes\].
const LARGEST: u64 = 1 << 30;

/// Why what lies in the place of a journal cannot be one; `None` for a plain file and for nothing.
pub(crate) fn no_journal(path: &Path) -> Option<String> {
    let found = std::fs::metadata(path).ok()?;
    match jostle_io::plain(&found) {
        Err(error) => Some(error.to_string()),
        Ok(()) if found.len() > LARGEST => Some("is larger than a journal can be".to_owned()),
        Ok(()) => None,
    }
}

/// Header of a journal: prevents reading that of another study.
const HEAD: usize = 64;

impl Journal {
    /// Claims a part for the study with this fingerprint of 64 characters. `keep` gets the journal of another study
    /// before it is rewritten.
    pub(crate) fn claim(
        path: &Path,
        fingerprint: &str,
        keep: &dyn Fn(&[u8]) -> std::io::Result<()>,
    ) -> std::io::Result<Claim> {
        if let Some(folder) = path.parent() {
            // The process that finished the last part of all has removed it.
            std::fs::create_dir_all(folder)?;
        }
        let mut file = OpenOptions::new()
            .read(true)
            .write(true)
            .create(true)
            .truncate(false)
            .open(path)?;
        match FileExt::try_lock(&file) {
            Ok(()) => {}
            Err(TryLockError::WouldBlock) => return Ok(Claim::Taken),
            Err(TryLockError::Error(error)) => {
                // Two processes cannot share a journal without locks. Rows are the same whoever computes them, and parts
                // are written whole, so that only work is lost.
                let rows = Self::finished(path, fingerprint);
                if file.metadata()?.len() == 0 {
                    let _ = std::fs::remove_file(path);
                }
                return Ok(Claim::Ours(Err(error), rows));
            }
        }
        let mut bytes = Vec::new();
        (&file).take(LARGEST).read_to_end(&mut bytes)?;
        let (rows, good) = if bytes.get(..HEAD) == Some(fingerprint.as_bytes()) {
            records(&bytes)
        } else {
            if bytes.len() > HEAD {
                keep(&bytes)?;
            }
            (Vec::new(), 0)
        };
        // A record that was half written when the process died is cut off.
        file.set_len(good as u64)?;
        file.seek(SeekFrom::Start(good as u64))?;
        if good == 0 {
            file.write_all(fingerprint.as_bytes())?;
        }
        let journal = Self {
            file,
            path: path.to_owned(),
        };
        Ok(Claim::Ours(Ok(journal), rows))
    }

    /// Says in a file beside the journal who has it; nothing depends on it.
    pub(crate) fn name_owner(&self) {
        let _ = std::fs::write(owner_path(&self.path), owner());
    }

    /// The rows that a journal of this study holds, whoever has it.
    pub(crate) fn finished(path: &Path, fingerprint: &str) -> Vec<Row> {
        let bytes = jostle_io::read_file(path, LARGEST as usize).unwrap_or_default();
        match bytes.get(..HEAD) == Some(fingerprint.as_bytes()) {
            true => records(&bytes).0,
            false => Vec::new(),
        }
    }

    /// Adds a finished case, in one write.
    pub(crate) fn append(&mut self, row: &Row) -> std::io::Result<()> {
        let payload = row.encode();
        let mut record = Vec::with_capacity(payload.len() + 8);
        record.extend((payload.len() as u32).to_le_bytes());
        record.extend(crc32fast::hash(&payload).to_le_bytes());
        record.extend(payload);
        self.file.write_all(&record)
    }

    /// Removes the journal of a part that is finished, and gives up the claim.
    pub(crate) fn remove(self) -> std::io::Result<()> {
        let _ = std::fs::remove_file(owner_path(&self.path));
        match std::fs::remove_file(&self.path) {
            // Another process removed it before this one got the lock.
            Err(error) if error.kind() == std::io::ErrorKind::NotFound => Ok(()),
            other => other,
        }
    }

    pub(crate) fn path(&self) -> &Path {
        &self.path
    }
}

/// Where the owner of a journal is named.
fn owner_path(journal: &Path) -> PathBuf {
    journal.with_extension("owner")
}

/// This process in words.
fn owner() -> String {
    let hosts = ["HOSTNAME", "COMPUTERNAME"].into_iter();
    let host = hosts.filter_map(|name| std::env::var(name).ok()).next();
    let host = host.map_or_else(String::new, |host| format!(" on {host}"));
    format!("process {}{host}", std::process::id())
}

/// Who computes a part, in words, and how long ago it finished a case.
pub(crate) fn owner_of(journal: &Path) -> (String, Option<Duration>) {
    let owner = jostle_io::read_text_file(&owner_path(journal), 4096);
    let changed = std::fs::metadata(journal).and_then(|found| found.modified());
    let idle = changed.ok().and_then(|time| time.elapsed().ok());
    (owner.unwrap_or_else(|_| "another process".into()), idle)
}

/// The whole records of a journal and the bytes up to the end of the last of them.
fn records(bytes: &[u8]) -> (Vec<Row>, usize) {
    let (mut rows, mut good) = (Vec::new(), HEAD);
    while let Some(head) = bytes.get(good..good + 8) {
        let number = |at: usize| {
            let bytes = [head[at], head[at + 1], head[at + 2], head[at + 3]];
            u32::from_le_bytes(bytes)
        };
        let end = good + 8 + number(0) as usize;
        let Some(payload) = bytes.get(good + 8..end) else {
            break;
        };
        if crc32fast::hash(payload) != number(4) {
            break;
        }
        let Some(row) = Row::decode(payload) else {
            break;
        };
        rows.push(row);
        good = end;
    }
    (rows, good)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::row::Status;

    fn row(case: u64) -> Row {
        Row {
            case,
            status: Status::Completed,
            reason: String::new(),
            numbers: vec![Some(case as f64), None],
            texts: vec!["el-centro".into()],
        }
    }

    fn ours(path: &Path) -> (Journal, Vec<Row>) {
        match Journal::claim(path, &"a".repeat(64), &|_| Ok(())) {
            Ok(Claim::Ours(Ok(journal), rows)) => (journal, rows),
            Ok(Claim::Taken) => panic!("taken"),
            Ok(Claim::Ours(Err(error), _)) | Err(error) => panic!("{error}"),
        }
    }

    #[test]
    fn whole_records_survive_wherever_the_file_is_cut() {
        let folder = tempfile::tempdir().unwrap_or_else(|error| panic!("{error}"));
        let path = folder.path().join("j");
        let (mut journal, rows) = ours(&path);
        assert!(rows.is_empty());
        for case in 0..3 {
            journal
                .append(&row(case))
                .unwrap_or_else(|error| panic!("{error}"));
        }
        drop(journal);
        let whole = std::fs::read(&path).unwrap_or_else(|error| panic!("{error}"));
        let record = (whole.len() - HEAD) / 3;
        for length in 0..=whole.len() {
            std::fs::write(&path, &whole[..length]).unwrap_or_else(|error| panic!("{error}"));
            let (mut journal, rows) = ours(&path);
            let expected = length.saturating_sub(HEAD) / record;
            let expected: Vec<Row> = (0..expected as u64).map(row).collect();
            assert_eq!(rows, expected, "cut after {length} bytes");
            // And it continues from there.
            journal
                .append(&row(9))
                .unwrap_or_else(|error| panic!("{error}"));
            drop(journal);
            let (_, rows) = ours(&path);
            assert_eq!(rows.len(), expected.len() + 1, "cut after {length} bytes");
        }
        // Damage inside ends what can be trusted.
        let mut damaged = whole.clone();
        damaged[HEAD + record + 20] ^= 1;
        std::fs::write(&path, &damaged).unwrap_or_else(|error| panic!("{error}"));
        assert_eq!(ours(&path).1, [row(0)]);
    }

    #[test]
    fn a_part_is_claimed_once_and_by_its_own_study() {
        let folder = tempfile::tempdir().unwrap_or_else(|error| panic!("{error}"));
        let path = folder.path().join("j");
        let (mut journal, _) = ours(&path);
        journal
            .append(&row(0))
            .unwrap_or_else(|error| panic!("{error}"));
        let second = Journal::claim(&path, &"a".repeat(64), &|_| Ok(()));
        assert!(matches!(second, Ok(Claim::Taken)), "claimed twice");
        drop(journal);
        let before = std::fs::read(&path).unwrap_or_else(|error| panic!("{error}"));
        let kept = std::cell::RefCell::new(Vec::new());
        let keep = |bytes: &[u8]| {
            kept.borrow_mut().extend_from_slice(bytes);
            Ok(())
        };
        match Journal::claim(&path, &"b".repeat(64), &keep) {
            Ok(Claim::Ours(_, rows)) => assert!(rows.is_empty(), "rows of another study"),
            _ => panic!("the claim was not given up"),
        }
        assert!(
            *kept.borrow() == before,
            "the rows of the other study are kept"
        );
    }
}
