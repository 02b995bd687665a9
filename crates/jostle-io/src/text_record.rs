//! Records as one or more columns of text: CSV, tabs or spaces, with or without times.
//!
//! Unit and step come from comments (`# unit = g`, `# step = 0.02 s`, `# gravity = 9.81 m/s2`), from the header
//! row (`time_s,acceleration_g` or `time (s), acc (g)`), from the times, or from the options. What is stated
//! nowhere is asked for, never guessed.

use crate::quantity::{Dimension, STANDARD_GRAVITY, parse_quantity, shorten};
use crate::record::{
    Record, RecordError, RecordOptions, Series, acceleration_unit, number, numbered_lines,
    option_unit,
};
use crate::times::Times;

/// What comments and the header row say.
#[derive(Default)]
struct Header {
    unit: Option<(String, f64)>,
    step: Option<f64>,
    /// Size of the unit `g` in this file \[m/s²\].
    gravity: Option<f64>,
    time_column: Option<usize>,
    acceleration_column: Option<usize>,
    /// Size of the unit of the times \[s\].
    time_unit: Option<f64>,
}

/// A line of numbers, as text.
struct Row<'t> {
    line: usize,
    cells: Vec<&'t str>,
}

/// Lines without numbers accepted before the data.
const MOST_HEADER_ROWS: usize = 50;

/// Reads columns of text.
///
/// # Errors
/// [`RecordError`] when a line cannot be understood, times are not equally spaced, or unit or step are
/// stated nowhere.
pub(crate) fn parse_text(text: &str, options: &RecordOptions) -> Result<Record, RecordError> {
    let (mut header, rows) = split(text)?;
    apply_options(&mut header, options)?;
    let Some(first) = rows.first() else {
        return Err(RecordError::TooFew { found: 0 });
    };
    let columns = first.cells.len();
    if let Some(row) = rows.iter().find(|row| row.cells.len() != columns) {
        return Err(RecordError::Ragged {
            line: row.line,
            found: row.cells.len(),
            expected: columns,
        });
    }
    let acceleration = acceleration_column(&header, options, first)?;
    let times = read_times(&header, &rows, acceleration)?;

    let mut series = Series {
        values: Vec::with_capacity(rows.len()),
        lines: rows.iter().map(|row| row.line).collect(),
        unit: header.unit.clone(),
    };
    for row in &rows {
        series
            .values
            .push(number(row.line, cell(row, acceleration))?);
    }
    let step = match times {
        Some((first_time, step)) => {
            if let Some(stated) = header.step.filter(|s| (s / step - 1.0).abs() > 1e-3) {
                return Err(RecordError::StepConflict {
                    found: step,
                    stated,
                });
            }
            // A record whose first value is one step after the origin starts at rest.
            if (first_time / step - 1.0).abs() < 1e-3 {
                series.values.insert(0, 0.0);
                series.lines.insert(0, first.line);
            }
            step
        }
        None => header.step.ok_or(RecordError::StepUnknown)?,
    };
    series.into_record(step)
}

/// Separates comments and header rows from rows of numbers.
fn split(text: &str) -> Result<(Header, Vec<Row<'_>>), RecordError> {
    let mut header = Header::default();
    let mut rows: Vec<Row<'_>> = Vec::new();
    let mut header_rows = 0;
    let mut column_names = None;
    for (line, content) in numbered_lines(text) {
        if let Some(comment) = comment(content) {
            read_comment(&mut header, line, comment)?;
        } else if !content.is_empty() {
            let cells = cells(content);
            let first = cells.first().copied().unwrap_or("");
            if rows.is_empty() && number(line, first).is_err() {
                header_rows += 1;
                if header_rows > MOST_HEADER_ROWS {
                    return Err(RecordError::NotANumber {
                        line,
                        found: shorten(first),
                    });
                }
                column_names = Some((line, content));
            } else {
                rows.push(Row { line, cells });
            }
        }
    }
    // The header row nearest to the numbers names the columns.
    if let Some((line, content)) = column_names {
        read_column_names(&mut header, line, content)?;
    }
    Ok((header, rows))
}

fn comment(line: &str) -> Option<&str> {
    ["#", "%", "//", "!"]
        .iter()
        .find_map(|mark| line.strip_prefix(mark))
}

/// Cells of a line: between semicolons, else commas, else blanks.
fn cells(line: &str) -> Vec<&str> {
    let separated = |separator: char| {
        let line = line.strip_suffix(separator).unwrap_or(line);
        line.split(separator).map(str::trim).collect()
    };
    if line.contains(';') {
        separated(';')
    } else if line.contains(',') {
        separated(',')
    } else {
        line.split_whitespace().collect()
    }
}

fn cell<'r>(row: &'r Row<'_>, column: usize) -> &'r str {
    row.cells.get(column).copied().unwrap_or("")
}

/// `unit = g`, `step = 0.02 s` (or `dt`), `gravity = 9.81 m/s2`; other comments say nothing.
fn read_comment(header: &mut Header, line: usize, comment: &str) -> Result<(), RecordError> {
    let Some((key, value)) = comment.split_once(['=', ':']) else {
        return Ok(());
    };
    let value = value.trim();
    match key.trim().to_lowercase().as_str() {
        "unit" | "units" => header.unit = Some(read_unit(line, value)?),
        "step" | "dt" | "time step" => {
            let step = parse_quantity(value, Dimension::Time);
            header.step = Some(step.map_err(|_| bad_number(line, value))?);
        }
        "gravity" => {
            let gravity = parse_quantity(value, Dimension::Acceleration).ok();
            let near = gravity.filter(|g| (9.7..=9.9).contains(g));
            header.gravity = Some(near.ok_or_else(|| bad_number(line, value))?);
        }
        _ => {}
    }
    Ok(())
}

fn bad_number(line: usize, text: &str) -> RecordError {
    RecordError::NotANumber {
        line,
        found: shorten(text),
    }
}

fn read_unit(line: usize, text: &str) -> Result<(String, f64), RecordError> {
    let bad = || RecordError::Unit {
        line,
        found: shorten(text),
    };
    Ok((text.to_owned(), acceleration_unit(text).ok_or_else(bad)?))
}

/// `time_s,acceleration_g`, `time (s), acc (g)`, `t a`.
fn read_column_names(header: &mut Header, line: usize, content: &str) -> Result<(), RecordError> {
    let names = if content.contains([',', ';']) || !content.contains(['(', '[']) {
        cells(content)
    } else {
        // `time (s)  acc (g)`: the blanks before brackets separate nothing.
        content
            .split_inclusive([')', ']'])
            .map(str::trim)
            .filter(|name| !name.is_empty())
            .collect()
    };
    for (column, name) in names.iter().enumerate() {
        let lower = name.trim_matches('"').to_lowercase();
        let (word, unit) = split_unit(&lower);
        let is_time = matches!(word, "t" | "time" | "times");
        let is_acceleration = matches!(word, "a" | "ag" | "a_g" | "acc" | "accel")
            || word.starts_with("acceleration")
            || word.starts_with("ground_acceleration")
            || word.starts_with("ground acceleration");
        if is_time && header.time_column.is_none() {
            header.time_column = Some(column);
            header.time_unit = match unit {
                None => None,
                Some(unit) => {
                    let size = parse_quantity(&format!("1 {unit}"), Dimension::Time);
                    Some(size.map_err(|_| bad_number(line, unit))?)
                }
            };
        } else if is_acceleration && header.acceleration_column.is_none() {
            header.acceleration_column = Some(column);
            if let (Some(unit), None) = (unit, &header.unit) {
                header.unit = Some(read_unit(line, unit)?);
            }
        }
    }
    Ok(())
}

/// `acc (g)` as `acc` and `g`; `acceleration_cm_s2` as `acceleration` and `cm_s2`.
fn split_unit(name: &str) -> (&str, Option<&str>) {
    let name = name.trim();
    if let Some((word, unit)) = name.split_once(['(', '[']) {
        let unit = unit.trim_end_matches([')', ']']).trim();
        return (word.trim(), (!unit.is_empty()).then_some(unit));
    }
    if matches!(name, "a_g" | "ground_acceleration") {
        return (name, None);
    }
    match name.split_once('_') {
        Some(("ground", rest)) => match rest.split_once('_') {
            Some((word, unit)) if word.starts_with("acc") => ("acceleration", Some(unit)),
            _ => (name, None),
        },
        Some((word, unit)) => (word, Some(unit)),
        None => (name, None),
    }
}

fn apply_options(header: &mut Header, options: &RecordOptions) -> Result<(), RecordError> {
    header.unit = option_unit(options)?.or(header.unit.take());
    if let Some(step) = options.step {
        header.step = Some(step);
    }
    // A record made with another value of g keeps it.
    if let (Some((_, size)), Some(gravity)) = (&mut header.unit, header.gravity)
        && *size == STANDARD_GRAVITY
    {
        *size = gravity;
    }
    Ok(())
}

/// Index of the column that holds the acceleration.
fn acceleration_column(
    header: &Header,
    options: &RecordOptions,
    first: &Row<'_>,
) -> Result<usize, RecordError> {
    let (line, columns) = (first.line, first.cells.len());
    let column = match (options.column, header.acceleration_column, columns) {
        (Some(wanted), ..) => {
            wanted
                .checked_sub(1)
                .filter(|c| *c < columns)
                .ok_or(RecordError::NoColumn {
                    line,
                    wanted,
                    columns,
                })?
        }
        (None, Some(column), _) if column < columns => column,
        (None, _, 1) => 0,
        (None, _, 2) => 1,
        _ => return Err(RecordError::WhichColumn { line, columns }),
    };
    Ok(column)
}

/// First time and step of the column of times, if there is one: the one named so, else the first.
fn read_times(
    header: &Header,
    rows: &[Row<'_>],
    acceleration: usize,
) -> Result<Option<(f64, f64)>, RecordError> {
    let columns = rows.first().map_or(0, |row| row.cells.len());
    let column = header.time_column.unwrap_or(0);
    if columns < 2 || column == acceleration {
        return Ok(None);
    }
    let unit = header.time_unit.unwrap_or(1.0);
    let cells = rows.iter().map(|row| (row.line, cell(row, column)));
    let times = Times::read(cells, unit).and_then(|times| Ok((times.first, times.step()?)));
    // With a stated step, a first column without a name need not be times.
    if times.is_err() && header.time_column.is_none() && header.step.is_some() {
        return Ok(None);
    }
    times.map(Some)
}
