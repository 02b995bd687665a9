//! Tables of measurements of shake tables, in the NEES `.asc` layout: names, units and values of all columns.
//!
//! A record takes one acceleration from such a file (`record/formats/nees`); comparisons take several columns of any
//! unit from it.

use std::path::Path;

use crate::files::read_file;
use crate::nearest::nearest;
use crate::quantity::{Dimension, shorten};
use crate::record::{
    HEADER_ROWS, Lines, RecordError, Times, acceleration_unit, check_end, check_text, number,
    time_unit, without_fill,
};
use crate::unit::Unit;

/// One column of measurements.
#[derive(Clone, Debug, PartialEq)]
pub struct MeasuredColumn {
    /// Name as in the file.
    pub name: String,
    /// Unit as in the file.
    pub unit: String,
    /// Dimension and size of the unit in SI, if it is known.
    pub size: Option<(Dimension, f64)>,
    /// Values in the unit of the file.
    pub values: Vec<f64>,
}

/// A table of measurements at equal time steps.
#[derive(Clone, Debug, PartialEq)]
pub struct MeasuredTable {
    /// First header row with words, which usually names the test; may be empty.
    pub title: String,
    /// The first instant \[s\].
    pub start: f64,
    /// Time step, > 0 \[s\].
    pub step: f64,
    /// Columns without that of the times, in the order of the file.
    pub columns: Vec<MeasuredColumn>,
    /// Line of the row of units, from 1.
    pub unit_row: usize,
}

/// Largest file of measurements \[bytes\].
const LARGEST_FILE: usize = 512 << 20;
/// Columns named in a message.
const MOST_LISTED: usize = 40;
/// Dimensions that columns may have, the most usual first.
const DIMENSIONS: [Dimension; 7] = [
    Dimension::Length,
    Dimension::Acceleration,
    Dimension::Speed,
    Dimension::Force,
    Dimension::Moment,
    Dimension::Time,
    Dimension::Dimensionless,
];

/// The header rows: where names and units stand, and how cells are separated.
pub(crate) struct Header {
    names: Vec<String>,
    units: Vec<String>,
    unit_row: usize,
    /// Size of the unit of the times \[s\].
    time_unit: f64,
    title: String,
    separator: Separator,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Separator {
    Mark(char),
    Blanks,
}

impl Separator {
    /// Tabs, else commas or semicolons, else blanks.
    fn of(row: &str) -> Self {
        let marks = ['\t', ';', ','].into_iter();
        marks
            .map(Self::Mark)
            .find(|mark| mark.cells(row).count() > 1)
            .unwrap_or(Self::Blanks)
    }

    /// Cells of a row; a separator at its end begins no further cell.
    fn cells(self, row: &str) -> impl Iterator<Item = &str> {
        let (marked, blank) = match self {
            Self::Mark(mark) => {
                let row = row.strip_suffix(mark).unwrap_or(row);
                (Some(row.split(mark).map(str::trim)), None)
            }
            Self::Blanks => (None, Some(row.split_whitespace())),
        };
        marked
            .into_iter()
            .flatten()
            .chain(blank.into_iter().flatten())
    }
}

/// Finds names and units among the header rows.
///
/// # Errors
/// [`RecordError::MeasuredHeader`] naming the row that is missing.
pub(crate) fn find_header(bytes: &[u8]) -> Result<Header, RecordError> {
    let rows: Vec<_> = Lines::new(bytes)
        .take(HEADER_ROWS)
        .map(|line| line.text)
        .collect();
    let wrong = |problem: &str| RecordError::MeasuredHeader {
        problem: problem.to_owned(),
    };
    if rows.len() < HEADER_ROWS {
        return Err(wrong("the file has fewer than six rows"));
    }
    let is_names = |row: &&str| {
        let first = Separator::of(row).cells(row).next().unwrap_or("");
        let word = bare(first).to_lowercase();
        (word == "time" || word.starts_with("time ") || word.starts_with("time("))
            && Separator::of(row).cells(row).count() > 1
    };
    let texts: Vec<&str> = rows.iter().map(AsRef::as_ref).collect();
    let names_at = texts.iter().position(is_names);
    let Some(names_at) = names_at else {
        return Err(wrong(
            "none of the first six rows names the columns, beginning with Time",
        ));
    };
    let separator = Separator::of(texts[names_at]);
    let names: Vec<String> = separator
        .cells(texts[names_at])
        .map(|name| bare(name).to_owned())
        .collect();
    let units_at = (0..HEADER_ROWS).find(|at| {
        let cells: Vec<&str> = separator.cells(texts[*at]).collect();
        let time = cells.first().and_then(|unit| time_unit(unit));
        *at != names_at && time.is_some() && cells.len() > 1
    });
    let Some(units_at) = units_at else {
        return Err(wrong(
            "none of the first six rows states the units of the columns, beginning with that of the times, such as sec",
        ));
    };
    let units: Vec<String> = separator
        .cells(texts[units_at])
        .map(|unit| bare(unit).to_owned())
        .collect();
    let time_unit = units
        .first()
        .and_then(|unit| time_unit(unit))
        .unwrap_or(1.0);
    if units.len() != names.len() {
        return Err(RecordError::Ragged {
            line: units_at + 1,
            found: units.len(),
            expected: names.len(),
        });
    }
    // A table with two header rows has numbers here.
    let both = names_at.max(units_at);
    let is_data = |at: &usize| {
        let cells = || separator.cells(texts[*at]);
        *at > both && cells().count() == names.len() && cells().all(|cell| number(0, cell).is_ok())
    };
    if let Some(at) = (0..HEADER_ROWS).find(is_data) {
        return Err(wrong(&format!("line {} holds numbers already", at + 1)));
    }
    let title = texts
        .iter()
        .enumerate()
        .find(|(at, row)| *at != names_at && *at != units_at && !row.trim().is_empty());
    let title = title.map_or("", |(_, row)| {
        row.split('\t')
            .map(str::trim)
            .find(|cell| !cell.is_empty())
            .unwrap_or("")
    });
    Ok(Header {
        title: shorten(title),
        names,
        units,
        unit_row: units_at + 1,
        time_unit,
        separator,
    })
}

impl Header {
    /// Whether a row has a number for every name.
    pub(crate) fn begins_with(&self, row: &str) -> bool {
        let cells = || self.separator.cells(row);
        cells().count() == self.names.len() && cells().all(|cell| number(0, cell).is_ok())
    }
}

/// A cell without quotes and brackets around it.
fn bare(cell: &str) -> &str {
    cell.trim()
        .trim_matches('"')
        .trim()
        .trim_start_matches(['(', '['])
        .trim_end_matches([')', ']'])
        .trim()
}

/// Dimension and size of a unit in the spellings of laboratories.
fn unit_size(text: &str) -> Option<(Dimension, f64)> {
    if let Some(size) = acceleration_unit(text) {
        return Some((Dimension::Acceleration, size));
    }
    if let Some(size) = time_unit(text) {
        return Some((Dimension::Time, size));
    }
    let lower = text.to_lowercase();
    let plain = match lower.as_str() {
        "inch" | "inches" | "in." => "in",
        "feet" | "foot" | "ft." => "ft",
        "millimeter" | "millimeters" | "millimetre" | "millimetres" => "mm",
        "in/sec" | "inch/sec" | "in/s" => "in/s",
        "mm/sec" => "mm/s",
        "cm/sec" => "cm/s",
        "m/sec" => "m/s",
        "kips" | "kip" => "kip",
        _ => text,
    };
    let unit = Unit::parse(plain).ok().filter(|_| !plain.is_empty())?;
    let fits = |dimension: &Dimension| unit.has_dimension(dimension.exponents());
    let dimension = DIMENSIONS.into_iter().find(fits)?;
    Some((dimension, unit.factor))
}

impl MeasuredTable {
    /// Reads a file in the NEES `.asc` layout.
    ///
    /// # Errors
    /// [`RecordError`] with line and column; it follows the name of the file.
    pub fn read(path: &Path) -> Result<Self, RecordError> {
        if path.is_dir() {
            return Err(RecordError::Folder {
                records: Vec::new(),
            });
        }
        Self::parse(&read_file(path, LARGEST_FILE)?)
    }

    /// The same from the bytes of a file.
    ///
    /// # Errors
    /// As [`Self::read`].
    pub fn parse(bytes: &[u8]) -> Result<Self, RecordError> {
        let bytes = without_fill(bytes);
        check_text(bytes)?;
        let header = find_header(bytes)?;
        let count = header.names.len();
        let mut lines = Lines::new(bytes);
        let rows = lines.lines_left().saturating_sub(HEADER_ROWS);
        // A row takes two bytes per cell at least.
        let rows = rows.min(lines.bytes_left() / (2 * count).max(1) + 1);
        let mut values: Vec<Vec<f64>> = vec![Vec::with_capacity(rows); count - 1];
        let mut times = Times::with_capacity(rows, header.time_unit);
        let mut blank: Option<usize> = None;
        for line in lines.by_ref().skip(HEADER_ROWS) {
            if line.text.trim().is_empty() {
                blank.get_or_insert(line.number);
                continue;
            }
            // Lines are counted from the header on.
            if let Some(blank) = blank {
                return Err(RecordError::MeasuredCell {
                    line: blank,
                    column: 1,
                    name: header.names[0].clone(),
                    found: String::new(),
                });
            }
            let found = header.separator.cells(&line.text).count();
            if found != count {
                return Err(RecordError::Ragged {
                    line: line.number,
                    found,
                    expected: count,
                });
            }
            for (at, cell) in header.separator.cells(&line.text).enumerate() {
                let pushed = match at {
                    0 => times.push(line.number, cell),
                    at => number(line.number, cell).map(|value| values[at - 1].push(value)),
                };
                pushed.map_err(|_| RecordError::MeasuredCell {
                    line: line.number,
                    column: at + 1,
                    name: header.names[at].clone(),
                    found: shorten(cell),
                })?;
            }
        }
        check_end(bytes)?;
        let (start, step) = (times.first, times.step()?);
        let columns = header.names.into_iter().zip(header.units).skip(1);
        Ok(Self {
            title: header.title,
            start,
            step,
            columns: columns
                .zip(values)
                .map(|((name, unit), values)| MeasuredColumn {
                    size: unit_size(&unit),
                    name,
                    unit,
                    values,
                })
                .collect(),
            unit_row: header.unit_row,
        })
    }

    /// Number of instants, two at least.
    #[must_use]
    pub fn points(&self) -> usize {
        self.columns.first().map_or(0, |column| column.values.len())
    }

    /// The column of this name, or of this number: 1 is the first one after the times.
    ///
    /// # Errors
    /// What is wrong, with the columns that there are and the one spelt most like it.
    pub fn column(&self, wanted: &str) -> Result<&MeasuredColumn, String> {
        let wanted = wanted.trim();
        let named = || self.columns.iter().filter(|column| column.name == wanted);
        match (named().count(), named().next()) {
            (1, Some(column)) => return Ok(column),
            (0, _) => {}
            (count, _) => {
                return Err(format!(
                    "{count} columns are named \"{}\"; say which one by its number, counted from 1 after the times",
                    shorten(wanted)
                ));
            }
        }
        let number = wanted.parse::<usize>().ok();
        let by_number = number.and_then(|number| self.columns.get(number.checked_sub(1)?));
        if let Some(column) = by_number {
            return Ok(column);
        }
        let names = || self.columns.iter().map(|column| column.name.as_str());
        let near = match nearest(wanted, names()) {
            Some(name) => format!("; did you mean \"{name}\"?"),
            None => ".".to_owned(),
        };
        Err(format!(
            "there is no column \"{}\" in the data{near} Columns: {}",
            shorten(wanted),
            self.list()
        ))
    }

    /// Names and units of all columns, for messages.
    #[must_use]
    pub fn list(&self) -> String {
        let shown = self.columns.iter().take(MOST_LISTED);
        let shown: Vec<String> = shown
            .map(|column| format!("{} [{}]", column.name, column.unit))
            .collect();
        let more = self.columns.len().saturating_sub(MOST_LISTED);
        match more {
            0 => shown.join(", "),
            _ => format!("{}, and {more} more", shown.join(", ")),
        }
    }
}
