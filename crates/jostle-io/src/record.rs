//! Ground-motion records in files: equally spaced accelerations in SI.

use std::path::Path;

use crate::at2;
use crate::motion_spec::GREATEST_ACCELERATION;
use crate::quantity::{Dimension, STANDARD_GRAVITY, parse_quantity};
use crate::text_record;

/// Equally spaced ground accelerations; the first value is at time zero.
#[derive(Clone, Debug, PartialEq)]
pub struct Record {
    /// Time step, > 0 \[s\].
    pub step: f64,
    /// Ground acceleration, at least two values \[m/s²\].
    pub acceleration: Vec<f64>,
}

/// What a user adds when a file does not say it itself.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct RecordOptions {
    /// Unit of the acceleration, such as `g` or `cm/s2`.
    pub unit: Option<String>,
    /// Time step \[s\].
    pub step: Option<f64>,
    /// Column of the acceleration, counted from 1.
    pub column: Option<usize>,
}

/// What is wrong with a record. Displays as `:line: problem`, to stand behind the name of the file.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum RecordError {
    /// The file cannot be read.
    #[error(": cannot be read: {0}")]
    Io(#[from] std::io::Error),
    /// More bytes than any record needs.
    #[error(": the file has {mebibytes} MiB; a record may have at most 64 MiB")]
    TooLarge {
        /// Size.
        mebibytes: usize,
    },
    /// Not a text.
    #[error(
        ": this is no plain text file; export the record as AT2, CSV or columns of text in UTF-8"
    )]
    Binary,
    /// Too few values.
    #[error(": a record needs at least two values, found {found}")]
    TooFew {
        /// Values found.
        found: usize,
    },
    /// A value that is no number.
    #[error(":{line}: \"{found}\" is not a number")]
    NotANumber {
        /// Line, from 1.
        line: usize,
        /// The text.
        found: String,
    },
    /// A value beyond any earthquake.
    #[error(
        ":{line}: an acceleration of {value} {unit} is beyond any earthquake; is the unit right?"
    )]
    TooStrong {
        /// Line, from 1.
        line: usize,
        /// Value as in the file.
        value: f64,
        /// Unit in use.
        unit: String,
    },
    /// The header counts other than there are.
    #[error(":{line}: the header announces {stated} values, the file has {found}; is it complete?")]
    Count {
        /// Line of the header, from 1.
        line: usize,
        /// Announced.
        stated: usize,
        /// Found.
        found: usize,
    },
    /// Header without count and step.
    #[error(
        ": no header line with NPTS and DT in the first {lines} lines, as in \"NPTS= 4000, DT= .0100 SEC\""
    )]
    NoHeader {
        /// Lines looked at.
        lines: usize,
    },
    /// Header line that cannot be understood.
    #[error(
        ":{line}: cannot read the number of values and the time step from \"{found}\"; expected a line such as \"NPTS= 4000, DT= .0100 SEC\""
    )]
    Header {
        /// Line, from 1.
        line: usize,
        /// The text.
        found: String,
    },
    /// A record format that is not read yet.
    #[error(
        ": this looks like a record in {format} format, which is not read; export it as PEER AT2, CSV or columns of text"
    )]
    OtherFormat {
        /// Name of the format.
        format: &'static str,
    },
    /// A unit asked for that is none of acceleration.
    #[error(": unit = \"{found}\" is not an acceleration; say \"g\" or \"cm/s2\", for example")]
    OptionUnit {
        /// The text.
        found: String,
    },
    /// A unit in the file that is none of acceleration.
    #[error(
        ":{line}: the unit \"{found}\" is not an acceleration; records of velocity or displacement cannot be used"
    )]
    Unit {
        /// Line, from 1.
        line: usize,
        /// The text.
        found: String,
    },
    /// The unit is stated nowhere.
    #[error(
        ": which unit do the accelerations have (largest number: {largest})? Say it with unit = \"g\" or unit = \"cm/s2\" beside record, or in the file's first line as # unit = g"
    )]
    UnitUnknown {
        /// Largest number of the file, as a help.
        largest: f64,
    },
    /// The time step is stated nowhere.
    #[error(
        ": which time step do the values have? Say it with step = \"0.01 s\" beside record, or in the file's first line as # step = 0.01 s"
    )]
    StepUnknown,
    /// A time step that cannot be used.
    #[error(": the time step of {step} s is not usable; it must lie between 1e-6 s and 10 s")]
    Step {
        /// The step.
        step: f64,
    },
    /// Times that are not equally spaced.
    #[error(
        ":{line}: time {found} s where {expected} s was expected; time steps must be equal, resample the record"
    )]
    UnequalStep {
        /// Line, from 1.
        line: usize,
        /// Time found \[s\].
        found: f64,
        /// Time expected \[s\].
        expected: f64,
    },
    /// A time that is not later than the one before.
    #[error(":{line}: time {found} s does not come after the time before it")]
    TimeNotRising {
        /// Line, from 1.
        line: usize,
        /// Time found \[s\].
        found: f64,
    },
    /// The file's times contradict the stated step.
    #[error(
        ": the times of the file have a step of {found} s, but step = {stated} s was asked for; leave step away"
    )]
    StepConflict {
        /// Step of the file.
        found: f64,
        /// Step of the option.
        stated: f64,
    },
    /// Which of several columns?
    #[error(
        ":{line}: {columns} columns; which one holds the acceleration? Say it with column = 2 beside record"
    )]
    WhichColumn {
        /// Line, from 1.
        line: usize,
        /// Columns found.
        columns: usize,
    },
    /// The column asked for does not exist.
    #[error(":{line}: there is no column {wanted}; the line has {columns}")]
    NoColumn {
        /// Line, from 1.
        line: usize,
        /// Column asked for.
        wanted: usize,
        /// Columns found.
        columns: usize,
    },
    /// Lines of different length.
    #[error(":{line}: expected {expected} columns as on the lines before, found {found}")]
    Ragged {
        /// Line, from 1.
        line: usize,
        /// Columns found.
        found: usize,
        /// Columns of the first line.
        expected: usize,
    },
    /// Far too many numbers for g.
    #[error(
        ": the largest number is {largest}, surely not g; say the right unit, for example unit = \"cm/s2\""
    )]
    SurelyNotG {
        /// Largest number of the file.
        largest: f64,
    },
}

/// Largest record file \[bytes\].
const LARGEST_FILE: usize = 64 << 20;

/// Reads a record file; the format is told from its content.
///
/// # Errors
/// [`RecordError`] naming the line and what would be right.
pub fn read_record(path: &Path, options: &RecordOptions) -> Result<Record, RecordError> {
    let size = usize::try_from(std::fs::metadata(path)?.len()).unwrap_or(usize::MAX);
    check_size(size)?;
    parse_record(&std::fs::read(path)?, options)
}

/// Reads a record from the bytes of a file: PEER AT2 when one of the first lines says `NPTS`, else columns
/// of text.
///
/// # Errors
/// [`RecordError`] naming the line and what would be right.
pub fn parse_record(bytes: &[u8], options: &RecordOptions) -> Result<Record, RecordError> {
    check_size(bytes.len())?;
    if bytes.contains(&0) {
        return Err(RecordError::Binary);
    }
    // Station names in old headers come in many encodings; only the numbers matter.
    let text = String::from_utf8_lossy(bytes);
    let text = text.strip_prefix('\u{feff}').unwrap_or(&text);
    let record = if at2::is_at2(text) {
        at2::parse_at2(text, options)
    } else if let Some(format) = other_format(text) {
        Err(RecordError::OtherFormat { format })
    } else {
        text_record::parse_text(text, options)
    }?;
    check_step(record.step)?;
    Ok(record)
}

/// Well-known formats whose columns of numbers would be misread, told by how they begin.
fn other_format(text: &str) -> Option<&'static str> {
    let first = text.lines().next().unwrap_or("");
    let second = text.lines().nth(1).unwrap_or("");
    if first.starts_with("Origin Time") {
        Some("K-NET or KiK-net")
    } else if first.starts_with("EVENT_NAME:") {
        Some("ESM (DYNA)")
    } else if first.contains("(Format v") {
        Some("COSMOS")
    } else if first.contains("orrected accelerogram") {
        Some("CSMIP")
    } else if first.contains("ACCELEROGRAM") && second.starts_with('*') {
        Some("USGS SMC")
    } else {
        None
    }
}

fn check_size(size: usize) -> Result<(), RecordError> {
    if size > LARGEST_FILE {
        return Err(RecordError::TooLarge {
            mebibytes: size >> 20,
        });
    }
    Ok(())
}

fn check_step(step: f64) -> Result<(), RecordError> {
    if (1e-6..=10.0).contains(&step) {
        Ok(())
    } else {
        Err(RecordError::Step { step })
    }
}

/// Lines with their numbers from 1; old files end lines with `\r` alone or `\r\r\n`.
pub(crate) fn numbered_lines(text: &str) -> impl Iterator<Item = (usize, &str)> {
    let end = if text.contains('\n') { '\n' } else { '\r' };
    text.split(end).enumerate().map(|(i, line)| {
        (
            i + 1,
            line.trim_matches(|c: char| c == '\r' || c.is_whitespace()),
        )
    })
}

/// A finite number; Fortran exponents (`1.5D-3`) and decimal commas are understood.
pub(crate) fn number(line: usize, text: &str) -> Result<f64, RecordError> {
    let parsed = text.parse::<f64>();
    match parsed.or_else(|_| text.replace(['D', 'd'], "e").replace(',', ".").parse()) {
        Ok(value) if value.is_finite() => Ok(value),
        _ => Err(RecordError::NotANumber {
            line,
            found: crate::quantity::shorten(text),
        }),
    }
}

/// Size of an acceleration unit in the many spellings of record headers: `G`, `CM/SEC/SEC`, `cm/sec**2`,
/// `m_s2`. `None` when it is no acceleration.
pub(crate) fn acceleration_unit(text: &str) -> Option<f64> {
    let plain = text
        .trim()
        .trim_matches(|c: char| matches!(c, '(' | ')' | '[' | ']' | '.' | ',' | ';' | ':' | '"'))
        .to_lowercase()
        .replace("sec", "s")
        .replace("**", "^")
        .replace("m_s", "m/s")
        .replace("mps2", "m/s2")
        .replace("m/ss", "m/s/s");
    let size = parse_quantity(&format!("1 {plain}"), Dimension::Acceleration).ok()?;
    (!plain.is_empty() && size > 0.0).then_some(size)
}

/// The unit that the user adds, with its size.
pub(crate) fn option_unit(options: &RecordOptions) -> Result<Option<(String, f64)>, RecordError> {
    let Some(text) = &options.unit else {
        return Ok(None);
    };
    let size = acceleration_unit(text).ok_or_else(|| RecordError::OptionUnit {
        found: crate::quantity::shorten(text),
    })?;
    Ok(Some((text.clone(), size)))
}

/// Raw values of a file, where they stand, and their unit.
pub(crate) struct Series {
    pub(crate) values: Vec<f64>,
    /// Line of every value.
    pub(crate) lines: Vec<usize>,
    /// Name and size of the unit.
    pub(crate) unit: Option<(String, f64)>,
}

impl Series {
    /// Converts to SI after the checks that every format shares.
    pub(crate) fn into_record(self, step: f64) -> Result<Record, RecordError> {
        let largest = self.values.iter().fold(0.0, |m: f64, v| m.max(v.abs()));
        if self.values.len() < 2 {
            return Err(RecordError::TooFew {
                found: self.values.len(),
            });
        }
        let (unit, size) = self.unit.ok_or(RecordError::UnitUnknown { largest })?;
        let is_g = (size / STANDARD_GRAVITY - 1.0).abs() < 0.01;
        if is_g && largest > 20.0 {
            return Err(RecordError::SurelyNotG { largest });
        }
        let beyond = |value: &f64| (value * size).abs() > GREATEST_ACCELERATION;
        if let Some(at) = self.values.iter().position(beyond) {
            return Err(RecordError::TooStrong {
                line: self.lines.get(at).copied().unwrap_or(0),
                value: self.values[at],
                unit,
            });
        }
        check_step(step)?;
        Ok(Record {
            step,
            acceleration: self.values.iter().map(|value| value * size).collect(),
        })
    }
}
