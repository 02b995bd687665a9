//! Files that exist where one is to be written: jostle replaces its own, and others only if asked to.

use std::io::{Read, Seek, SeekFrom};
use std::path::Path;

use jostle_io::OutputError;

use crate::error::RunError;

/// How much of the beginning and of the end of a file is read to see what it is \[bytes\].
const LOOK: u64 = 8192;

/// Longest footer of a Parquet file that is read \[bytes\].
const LONGEST_FOOTER: u64 = 64 << 20;

/// Member of a workbook that says who wrote it.
const PROPERTIES: &str = "docProps/core.xml";

/// Largest workbook that is looked into \[bytes\].
const LARGEST_WORKBOOK: usize = 256 << 20;

/// A kind of file that jostle writes.
#[derive(Clone, Copy, Debug)]
pub struct FileKind {
    /// Its type, as in "is no summary of jostle".
    pub name: &'static str,
    /// Texts that its first or last kilobytes contain.
    pub marks: &'static [&'static str],
}

impl FileKind {
    /// Tables in Parquet.
    pub const TABLE: Self = Self {
        name: "table of jostle",
        marks: &["PAR1", "jostle "],
    };
    /// Summaries of runs.
    pub const SUMMARY: Self = Self {
        name: "summary of jostle",
        marks: &["\"title\":", "\"jostle\":", "\"motion\":"],
    };
    /// Reports of runs, and pages of collisions and motions.
    pub const REPORT: Self = Self {
        name: "report of jostle",
        marks: &["<html", " – jostle</title>"],
    };
    /// Excel workbooks of results; see `PROPERTIES`.
    pub const WORKBOOK: Self = Self {
        name: "workbook of jostle",
        marks: &[
            "<cp:coreProperties",
            "<dc:title>Results of jostle</dc:title>",
        ],
    };
    /// Reports printed by a browser.
    pub const PDF: Self = Self {
        name: "report of jostle",
        marks: &["%PDF-", "Skia/PDF"],
    };
    /// Live pages with their engine inside.
    pub const LIVE_PAGE: Self = Self {
        name: "live page of jostle",
        marks: &["<html", " – jostle live</title>"],
    };
    /// Drawings of the site.
    pub const SITE: Self = Self {
        name: "drawing of jostle",
        marks: &["<svg ", "class=\"site\""],
    };
    /// Pages of sections.
    pub const SECTIONS: Self = Self {
        name: "page of sections that jostle wrote",
        marks: &["<html", " – sections</title>"],
    };
    /// Pages of `jostle method`.
    pub const METHOD: Self = Self {
        name: "page of jostle method",
        marks: &["<html", " – the method</title>"],
    };
    /// Pages, curves and numbers of `jostle pushover`.
    pub const PUSHOVER_PAGE: Self = Self {
        name: "page of jostle pushover",
        marks: &["<html", " – pushover</title>"],
    };
    /// See [`Self::PUSHOVER_PAGE`].
    pub const PUSHOVER_CURVES: Self = Self {
        name: "table of jostle pushover",
        marks: &["building,direction,point,roof_displacement_m,roof_drift,"],
    };
    /// See [`Self::PUSHOVER_PAGE`].
    pub const PUSHOVER_NUMBERS: Self = Self {
        name: "result of jostle pushover",
        marks: &["\"curves\":", "\"jostle\":", "\"title\":"],
    };
    /// Pages of `jostle size`.
    pub const SIZE_PAGE: Self = Self {
        name: "page of jostle size",
        marks: &["<html", " – sizing</title>"],
    };
    /// Numbers of `jostle size`.
    pub const SIZE_NUMBERS: Self = Self {
        name: "result of jostle size",
        marks: &["\"minimise\":", "\"keep\":", "\"jostle\":"],
    };
    /// Pages, numbers and tables of `jostle gap`.
    pub const GAP_PAGE: Self = Self {
        name: "page of jostle gap",
        marks: &["<html", " – gap needed</title>"],
    };
    /// See [`Self::GAP_PAGE`].
    pub const GAP_NUMBERS: Self = Self {
        name: "result of jostle gap",
        marks: &["\"gaps\":", "\"jostle\":", "\"title\":"],
    };
    /// See [`Self::GAP_PAGE`].
    pub const GAP_RULES: Self = Self {
        name: "table of jostle gap",
        marks: &["left,right,motion,pga_m_s2,needed_m,"],
    };
    /// See [`Self::GAP_PAGE`].
    pub const GAP_CURVES: Self = Self {
        name: "table of jostle gap",
        marks: &["left,right,motion,pga_m_s2,width_m,"],
    };
    /// Pages of `jostle compare`.
    pub const COMPARISON_PAGE: Self = Self {
        name: "page of jostle compare",
        marks: &["<html", " – comparison</title>"],
    };
    /// Numbers of `jostle compare`.
    pub const COMPARISON_NUMBERS: Self = Self {
        name: "result of jostle compare",
        marks: &["\"columns\":", "\"table_motion\":", "\"jostle\":"],
    };
    /// Curves of `jostle collide`.
    pub const COLLISION_CURVES: Self = Self {
        name: "table of jostle collide",
        marks: &["law,time_s,indentation_m,rate_m_s,force_n\n"],
    };
    /// Spectra of `jostle motion spectrum`.
    pub const SPECTRA: Self = Self {
        name: "table of jostle motion spectrum",
        marks: &["period_s,sd_", "pct_m,psv_"],
    };
}

/// Whether writing `path` replaces a file that is not empty.
///
/// Files of `kind` may be replaced; all others, and everything if no kind is given, only with `force`.
///
/// # Errors
/// [`RunError::Kept`] if the file must stay, [`RunError::Output`] if it cannot be read.
pub fn may_write(path: &Path, kind: Option<FileKind>, force: bool) -> Result<bool, RunError> {
    let shown = path.display();
    let io = |error| {
        RunError::from(OutputError::Io {
            path: path.to_owned(),
            error,
        })
    };
    let ends = match std::fs::metadata(path) {
        Err(error) if error.kind() == std::io::ErrorKind::NotFound => return Ok(false),
        Err(error) => return Err(io(error)),
        Ok(found) if found.is_dir() => {
            return Err(RunError::Kept(format!(
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
        Some(kind) => Err(RunError::Kept(format!(
            "{shown} exists already and is no {}; choose another name or folder, or add --force to replace it",
            kind.name
        ))),
        None => Err(RunError::Kept(format!(
            "{shown} exists already; choose another name or folder, or add --force to replace it"
        ))),
    }
}

/// The beginning and the end of a file, as far as they are text.
fn ends(path: &Path, len: u64) -> std::io::Result<String> {
    let mut file = std::fs::File::open(path)?;
    let mut bytes = Vec::new();
    file.by_ref().take(LOOK).read_to_end(&mut bytes)?;
    let mut end = Vec::new();
    file.seek(SeekFrom::Start(len.saturating_sub(LOOK)))?;
    file.by_ref().take(LOOK).read_to_end(&mut end)?;
    if let Some(&[a, b, c, d, b'P', b'A', b'R', b'1']) = end.last_chunk() {
        // Of a table with many columns the footer is longer.
        let footer = u64::from(u32::from_le_bytes([a, b, c, d])).min(LONGEST_FOOTER) + 8;
        end.clear();
        file.seek(SeekFrom::Start(len.saturating_sub(footer)))?;
        file.take(footer).read_to_end(&mut end)?;
    }
    if bytes.starts_with(b"PK\x03\x04")
        && let Ok(whole) = jostle_io::read_file(path, LARGEST_WORKBOOK)
        && let Some(text) = jostle_io::archive_text(&whole, PROPERTIES, LOOK)
    {
        end.extend(text.into_bytes());
    }
    bytes.append(&mut end);
    Ok(String::from_utf8_lossy(&bytes).into_owned())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn tables_of_many_columns_are_known() {
        let folder = tempfile::tempdir().expect("a folder");
        let path = folder.path().join("history.parquet");
        let columns = (0..5000).map(|index| (format!("column{index}"), vec![0.0, 1.0]));
        jostle_io::write_columns_parquet(&path, "wide", columns.collect()).expect("a table");
        assert!(may_write(&path, Some(FileKind::TABLE), false).expect("of jostle"));
        assert!(may_write(&path, Some(FileKind::SUMMARY), false).is_err());
        std::fs::write(&path, b"PAR1 of another program \xff\xff\xff\x7fPAR1").expect("a file");
        assert!(may_write(&path, Some(FileKind::TABLE), false).is_err());
    }
}
