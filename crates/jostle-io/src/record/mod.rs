//! Ground-motion records in files: equally spaced accelerations in SI.
//!
//! `formats` turns bytes into [`contents::Contents`]: channels of raw values with the data of the header.
//! The code common to all formats is here: units, scale, checks, the choice of a channel.

mod channel;
mod clock;
mod contents;
mod error;
mod film;
mod fixed;
mod formats;
mod header;
mod layout;
mod lines;
pub(crate) mod measured;
mod units;
mod widths;

use std::path::Path;

pub use channel::{Channel, Direction};
pub use error::RecordError;
pub use formats::RecordFormat;
pub(crate) use formats::{HEADER_ROWS, Times, check_text};
pub use layout::{RecordContent, RecordLayout};
pub(crate) use lines::{Lines, check_end, number, without_fill};
pub(crate) use units::{acceleration_unit, time_unit};

use crate::files::{FileError, Files, read_file};
use contents::Contents;

/// No earthquake comes near this; larger numbers are a mistaken unit \[m/s²\].
pub(crate) const GREATEST_ACCELERATION: f64 = 100.0;

/// Equally spaced ground accelerations; the first value is at time zero.
#[derive(Clone, Debug, PartialEq)]
pub struct Record {
    /// Time step, > 0 \[s\].
    pub step: f64,
    /// Ground acceleration, at least two values \[m/s²\].
    pub acceleration: Vec<f64>,
}

impl Record {
    /// A record from given values, in a unit of acceleration such as `g`, `step` seconds apart. Errors count values
    /// as lines, from 1.
    ///
    /// # Errors
    /// [`RecordError`] as for a file of these values.
    pub fn from_values(values: &[f64], unit: &str, step: f64) -> Result<Self, RecordError> {
        if let Some(at) = values.iter().position(|value| !value.is_finite()) {
            return Err(RecordError::NotANumber {
                line: at + 1,
                found: values[at].to_string(),
            });
        }
        let options = RecordOptions {
            unit: Some(unit.to_owned()),
            ..RecordOptions::default()
        };
        let mut numbers = lines::LineMap::default();
        for at in 1..=values.len() {
            numbers.note(at, 1);
        }
        let trace = contents::Trace {
            name: "values".to_owned(),
            direction: Direction::Unknown,
            unit: units::option_unit(&options)?,
            step: Some(step),
            values: values.to_vec(),
            lines: numbers,
            peak: None,
        };
        let mut contents = Contents::new(RecordFormat::Columns, contents::Scale::Settled);
        contents.traces.push(trace);
        contents.into_record(0, &options)
    }
}

/// Data that the user adds to a file.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct RecordOptions {
    /// Unit of the acceleration, such as `g` or `cm/s2`.
    pub unit: Option<String>,
    /// Time step \[s\].
    pub step: Option<f64>,
    /// Column of the acceleration, counted from 1.
    pub column: Option<usize>,
    /// Channel of a file with several: a number, the name in the file, `H1`, `H2`, `up`, `N-S`, an azimuth.
    pub component: Option<String>,
    /// Factor on the numbers of the file before `unit`: the size of one count, 1/sensitivity.
    pub scale: Option<f64>,
    /// Whether the mean is removed; `None` keeps it, asks if counts have a large one, and follows the rule of
    /// formats that have one (K-NET).
    pub remove_mean: Option<bool>,
    /// Format of the file; `None` recognises it from the content.
    pub format: Option<RecordFormat>,
    /// Layout of the lines, for columns of text and, in part, AT2.
    pub layout: RecordLayout,
}

/// Data that a file states.
#[derive(Clone, Debug, PartialEq)]
pub struct RecordInfo {
    /// Format in which it was read.
    pub format: RecordFormat,
    /// Name or code of the station, or nothing.
    pub station: String,
    /// Name of the earthquake, or nothing.
    pub event: String,
    /// Date and time as the file writes them, or nothing.
    pub date: String,
    /// Its channels of acceleration.
    pub channels: Vec<Channel>,
    /// Index of the channel that the options choose; `None` when they leave it open.
    pub chosen: Option<usize>,
}

impl RecordInfo {
    /// The channel that the options choose.
    #[must_use]
    pub fn channel(&self) -> Option<&Channel> {
        self.channels.get(self.chosen?)
    }
}

/// Largest record file \[bytes\].
const LARGEST_FILE: usize = 64 << 20;

/// Reads a record file; the format is recognised from the content.
///
/// # Errors
/// [`RecordError`] naming the line and what would be right.
pub fn read_record(path: &Path, options: &RecordOptions) -> Result<Record, RecordError> {
    parse_record(&read_bytes(path)?, options)
}

/// Reads a record file and the data that it states.
///
/// # Errors
/// As [`read_record`].
pub fn read_record_and_info(
    path: &Path,
    options: &RecordOptions,
) -> Result<(Record, RecordInfo), RecordError> {
    parse_record_and_info(&read_bytes(path)?, options)
}

/// Reads the data that a record file states, without choosing a channel.
///
/// # Errors
/// [`RecordError`] when the file cannot be read in its format.
pub fn describe_record(path: &Path, options: &RecordOptions) -> Result<RecordInfo, RecordError> {
    parse_info(&read_bytes(path)?, options)
}

/// Reads a record from the bytes of a file.
///
/// Uses eight bytes per value actually present, regardless of the count in the header.
///
/// # Errors
/// [`RecordError`] naming the line and what would be right.
pub fn parse_record(bytes: &[u8], options: &RecordOptions) -> Result<Record, RecordError> {
    parse_record_and_info(bytes, options).map(|(record, _)| record)
}

/// Reads a record and the data that the file states from bytes.
///
/// # Errors
/// As [`parse_record`].
pub fn parse_record_and_info(
    bytes: &[u8],
    options: &RecordOptions,
) -> Result<(Record, RecordInfo), RecordError> {
    let contents = parse_contents(bytes, options)?;
    let channels = contents.channels();
    let index = channel::choose(&channels, options.component.as_deref(), contents.format)?;
    let info = info(&contents, channels, Some(index));
    let record = contents.into_record(index, options)?;
    Ok((record, info))
}

/// Reads the data that a file states from its bytes, without choosing a channel.
///
/// # Errors
/// As [`describe_record`].
pub fn parse_info(bytes: &[u8], options: &RecordOptions) -> Result<RecordInfo, RecordError> {
    let contents = parse_contents(bytes, options)?;
    let channels = contents.channels();
    let chosen = channel::choose(&channels, options.component.as_deref(), contents.format).ok();
    Ok(info(&contents, channels, chosen))
}

fn info(contents: &Contents, channels: Vec<Channel>, chosen: Option<usize>) -> RecordInfo {
    RecordInfo {
        format: contents.format,
        station: contents.station.clone(),
        event: contents.event.clone(),
        date: contents.date.clone(),
        channels,
        chosen,
    }
}

fn read_bytes(path: &Path) -> Result<Vec<u8>, RecordError> {
    if path.is_dir() {
        return Err(RecordError::Folder {
            records: records_in(path)?,
        });
    }
    Ok(read_file(path, LARGEST_FILE)?)
}

/// Reads a record of a model.
///
/// # Errors
/// As [`read_record`].
pub(crate) fn read_record_of(
    files: &Files,
    name: &str,
    options: &RecordOptions,
) -> Result<Record, RecordError> {
    if let Some(folder) = files.folder_of(name) {
        return Err(RecordError::Folder {
            records: records_in(&folder)?,
        });
    }
    parse_record(&files.read(name, LARGEST_FILE)?, options)
}

impl From<FileError> for RecordError {
    fn from(error: FileError) -> Self {
        match error {
            FileError::TooLarge { .. } => Self::TooLarge,
            other => Self::File(other),
        }
    }
}

/// Files of a folder looked at for records, and records named in a message.
const FOLDER_FILES: usize = 100;
const NAMED_RECORDS: usize = 8;

/// Names of files in a folder that can be read as records, in order; one more than are named if there are more.
fn records_in(folder: &Path) -> Result<Vec<String>, RecordError> {
    let entries = std::fs::read_dir(folder).map_err(FileError::Io)?;
    let mut paths: Vec<_> = entries
        .flatten()
        .map(|entry| entry.path())
        .filter(|path| path.is_file())
        .take(10_000)
        .collect();
    paths.sort();
    let readable = |path: &std::path::PathBuf| {
        let bytes = read_file(path, LARGEST_FILE);
        bytes.is_ok_and(|bytes| parse_info(&bytes, &RecordOptions::default()).is_ok())
    };
    let name = |path: std::path::PathBuf| Some(path.file_name()?.to_string_lossy().into_owned());
    let records = paths.into_iter().take(FOLDER_FILES).filter(readable);
    Ok(records.filter_map(name).take(NAMED_RECORDS + 1).collect())
}

fn parse_contents(bytes: &[u8], options: &RecordOptions) -> Result<Contents, RecordError> {
    check_size(bytes.len())?;
    options.layout.check()?;
    let format = match options.format {
        Some(format) => format,
        // What the user says about lines holds for columns of text.
        None if !options.layout.is_empty() && !options.layout.is_widths_only() => {
            RecordFormat::Columns
        }
        None => RecordFormat::detect(bytes)?,
    };
    let has_lines = match format {
        RecordFormat::Columns => true,
        RecordFormat::At2 => options.layout.is_widths_only(),
        _ => false,
    };
    if !options.layout.is_empty() && !has_lines {
        return Err(RecordError::LayoutOfFormat { format });
    }
    let contents = format.read(bytes, options)?;
    contents.check_peaks()?;
    Ok(contents)
}

fn check_size(size: usize) -> Result<(), RecordError> {
    if size > LARGEST_FILE {
        return Err(RecordError::TooLarge);
    }
    Ok(())
}
