//! A part of the table as a file: written with a checksum, verified before use.
//!
//! The seal is the SHA-256 of all bytes of the file, in which its own 64 digits count as zeros. It is the last of the
//! notes in the footer of the Parquet file, so that a part carries it wherever it is copied, and any other reader
//! ignores it.

use std::io;
use std::path::Path;

use bytes::Bytes;
use jostle_io::{FileError, OutputError, encode_values_parquet, read_file, write_atomically};
use parquet::errors::ParquetError;
use parquet::file::reader::{FileReader, SerializedFileReader};
use sha2::{Digest, Sha256};

use super::reading::read_rows;
use super::{Table, part_path};
use crate::row::Row;
use crate::study::{Study, StudyError, hex};
use crate::verified::Stamp;

/// Largest part \[bytes\].
const LARGEST: usize = 1 << 30;
/// Key of the fingerprint of the study.
const STUDY: &str = "study_sha256";
/// Key of the seal.
const SEAL: &str = "seal_sha256";
/// Digits of a SHA-256.
const DIGITS: usize = 64;
/// Between key and value in the footer (Thrift compact protocol): field 2, text, length of the value.
const BETWEEN: [u8; 2] = [0x18, DIGITS as u8];
/// Leading digits of a fingerprint in messages.
const SHOWN: usize = 12;

/// Why the file of a part does not hold it.
#[derive(Debug, thiserror::Error)]
pub(crate) enum PartFault {
    /// There is none.
    #[error("is missing")]
    Absent,
    /// The file system refused.
    #[error("cannot be read: {0}")]
    Unreadable(io::Error),
    /// It is not what was written.
    #[error("is damaged: {0}")]
    Damaged(String),
    /// Whole, but of another study.
    #[error(
        "belongs to another study (its fingerprint begins with {found}, that of this study with {own})"
    )]
    OtherStudy {
        /// First digits of the fingerprint in the file.
        found: String,
        /// First digits of this study.
        own: String,
    },
    /// Whole and of this study, but another of its parts.
    #[error("holds {found} of this study instead of {wanted}")]
    OtherCases {
        /// Cases in the file.
        found: String,
        /// Cases that it should hold.
        wanted: String,
    },
}

impl PartFault {
    /// For the name under which such a file is set aside; `None` if there is no file to set aside.
    pub(crate) fn label(&self) -> Option<&'static str> {
        match self {
            Self::Absent | Self::Unreadable(_) => None,
            Self::Damaged(_) => Some("damaged"),
            Self::OtherStudy { .. } => Some("other-study"),
            Self::OtherCases { .. } => Some("other-cases"),
        }
    }
}

/// Cases in words: `case 7`, `cases 16 to 31`.
pub(crate) fn cases_in_words(first: u64, last: u64) -> String {
    if first == last {
        format!("case {first}")
    } else {
        format!("cases {first} to {last}")
    }
}

/// The cases of a part in words.
pub(crate) fn cases_of(study: &Study, part: u64) -> String {
    let cases = study.part(part);
    cases_in_words(cases.start, cases.end - 1)
}

/// Writes a part with its seal.
pub(crate) fn write(
    study: &Study,
    folder: &Path,
    part: u64,
    rows: &[Row],
) -> Result<(), StudyError> {
    let path = part_path(folder, study.part(part).start);
    let facts = [
        (STUDY, study.fingerprint.clone()),
        (SEAL, "0".repeat(DIGITS)),
    ];
    let encoded = encode_values_parquet(&study.file.title, &facts, study.layout.columns(rows));
    let sealed = encoded.and_then(|mut bytes| {
        seal(&mut bytes).ok_or_else(|| "the footer has no place for the checksum".to_owned())?;
        Ok(bytes)
    });
    let bytes = sealed.map_err(|reason| OutputError::Encoding {
        path: path.clone(),
        reason,
    })?;
    write_atomically(&path, &bytes)?;
    Ok(())
}

/// Whether the file of a part is whole, of this study, and that part. What was verified and has not changed since is not read again.
pub(crate) fn verify(study: &Study, folder: &Path, part: u64) -> Result<(), PartFault> {
    let path = part_path(folder, study.part(part).start);
    let stamp = Stamp::of(&path);
    if study.verified.holds(&path, stamp) {
        return Ok(());
    }
    let checked = match read_file(&path, LARGEST) {
        Ok(bytes) => check(study, part, bytes.into()),
        Err(FileError::Io(error)) if error.kind() == io::ErrorKind::NotFound => {
            Err(PartFault::Absent)
        }
        Err(FileError::Io(error)) => Err(PartFault::Unreadable(error)),
        Err(other) => Err(PartFault::Damaged(format!("it {other}"))),
    };
    checked?;
    study.verified.note(path, stamp);
    Ok(())
}

/// Whether bytes are whole, of this study, and that part.
fn check(study: &Study, part: u64, bytes: Bytes) -> Result<(), PartFault> {
    let damaged = |why: &str| Err(PartFault::Damaged(why.to_owned()));
    if bytes.is_empty() {
        return damaged("it is empty");
    }
    let Some(at) = find_seal(&bytes) else {
        return damaged("it has no checksum, or ends too early");
    };
    if bytes.get(at..at + DIGITS) != Some(digits(&bytes, at).as_bytes()) {
        return damaged("its contents do not match its checksum");
    }
    let contents = contents(&bytes).map_err(|error| PartFault::Damaged(error.to_string()))?;
    let short = |text: &str| text.chars().take(SHOWN).collect::<String>();
    if contents.study.as_ref() != Some(&study.fingerprint) {
        return Err(PartFault::OtherStudy {
            found: short(&contents.study.unwrap_or_default()),
            own: short(&study.fingerprint),
        });
    }
    let wanted = study.part(part).map(|case| Some(case as f64));
    if !wanted.eq(contents.cases.iter().copied()) {
        let ends = (contents.cases.first(), contents.cases.last());
        return Err(PartFault::OtherCases {
            found: match ends {
                (Some(Some(first)), Some(Some(last))) => {
                    cases_in_words(*first as u64, *last as u64)
                }
                _ => "no cases".to_owned(),
            },
            wanted: cases_of(study, part),
        });
    }
    Ok(())
}

/// Metadata of a file.
struct Contents {
    study: Option<String>,
    cases: Vec<Option<f64>>,
}

fn contents(bytes: &Bytes) -> Result<Contents, ParquetError> {
    let reader = SerializedFileReader::new(bytes.clone())?;
    let notes = reader.metadata().file_metadata().key_value_metadata();
    let study = notes
        .into_iter()
        .flatten()
        .find(|note| note.key == STUDY)
        .and_then(|note| note.value.clone());
    let mut table = Table::default();
    read_rows(bytes.clone(), &["case"], &mut table)?;
    Ok(Contents {
        study,
        cases: table.column("case").to_vec(),
    })
}

/// Replaces the placeholder zeros by the seal; `None` if there are none.
fn seal(bytes: &mut [u8]) -> Option<()> {
    let at = find_seal(bytes)?;
    let digits = digits(bytes, at);
    bytes
        .get_mut(at..at + DIGITS)?
        .copy_from_slice(digits.as_bytes());
    Some(())
}

/// Start of the digits of the seal: after the last occurrence of its key.
fn find_seal(bytes: &[u8]) -> Option<usize> {
    let mark = [SEAL.as_bytes(), &BETWEEN].concat();
    let at = bytes.windows(mark.len()).rposition(|here| here == mark)?;
    let digits = at + mark.len();
    (digits + DIGITS <= bytes.len()).then_some(digits)
}

/// The digits that the seal at a place must have.
fn digits(bytes: &[u8], at: usize) -> String {
    let mut hash = Sha256::new();
    hash.update(&bytes[..at]);
    hash.update([b'0'; DIGITS]);
    hash.update(&bytes[at + DIGITS..]);
    hex(&hash.finalize())
}

#[cfg(test)]
mod tests {
    use jostle_io::{Format, StudyFile};

    use super::*;

    #[test]
    fn every_flipped_bit_and_every_cut_is_noticed() {
        let text =
            "base = \"paper\"\n[[vary]]\npath = \"gap[0].width\"\nvalues = [0.01, 0.02, 0.03]\n";
        let file = StudyFile::parse("s.toml", text, Format::Toml, Path::new(""), None);
        let study = Study::new(file.unwrap_or_else(|error| panic!("{error}")));
        let study = study.unwrap_or_else(|error| panic!("{error}"));
        let folder = tempfile::tempdir().unwrap_or_else(|error| panic!("{error}"));
        std::fs::create_dir(folder.path().join("cases")).unwrap_or_else(|error| panic!("{error}"));
        let rows: Vec<Row> = (0..3)
            .map(|case| crate::case::blank(&study, case))
            .collect();
        write(&study, folder.path(), 0, &rows).unwrap_or_else(|error| panic!("{error}"));
        let whole = std::fs::read(part_path(folder.path(), 0));
        let mut bytes = whole.unwrap_or_else(|error| panic!("{error}"));
        let passes = |bytes: &[u8]| check(&study, 0, Bytes::copy_from_slice(bytes)).is_ok();
        assert!(passes(&bytes));
        for at in 0..bytes.len() {
            bytes[at] ^= 1 << (at % 8);
            assert!(!passes(&bytes), "byte {at}");
            bytes[at] ^= 1 << (at % 8);
        }
        for length in (0..bytes.len()).step_by(5) {
            assert!(!passes(&bytes[..length]), "{length} bytes");
        }
        bytes.push(0);
        assert!(!passes(&bytes), "a byte more");
    }
}
