//! Records as one or more columns of text: CSV, tabs or spaces, with or without times.
//!
//! Unit and step come from comments (`# unit = g`, `# step = 0.02 s`, `# gravity = 9.81 m/s2`), from the header row
//! (`time_s,acceleration_g` or `time (s), acc (g)`), from the times, or from the options. Missing data are asked
//! for, never guessed.

mod header;
mod times;

use crate::record::RecordOptions;
use crate::record::channel::Direction;
use crate::record::contents::{Contents, Scale, Trace};
use crate::record::error::RecordError;
use crate::record::formats::RecordFormat;
use crate::record::lines::{LineMap, Lines, check_end, number};

use header::{Header, apply_options, bad_number, read_column_names, read_comment};
pub(crate) use times::Times;

/// Lines without numbers accepted before the data.
const MOST_HEADER_ROWS: usize = 50;

/// The numbers of the file, and their layout.
struct Table {
    columns: usize,
    /// Column of the accelerations.
    acceleration: usize,
    values: Vec<f64>,
    lines: LineMap,
    /// The column of times, if there is one, or why it cannot be read.
    times: Option<Result<Times, RecordError>>,
    time_column: usize,
}

/// Reads columns of text.
///
/// # Errors
/// [`RecordError`] when a line cannot be understood, times are not equally spaced, or unit or step are
/// stated nowhere.
pub(crate) fn read(bytes: &[u8], options: &RecordOptions) -> Result<Contents, RecordError> {
    let (mut header, table) = read_table(bytes, options)?;
    check_end(bytes)?;
    apply_options(&mut header, options)?;
    let Some(mut table) = table else {
        return Err(RecordError::TooFew { found: 0 });
    };
    if let Some((stated, line)) = header.points
        && stated != table.values.len()
    {
        return Err(RecordError::Count {
            line,
            stated,
            found: table.values.len(),
        });
    }
    let times = match table.times.take() {
        None => None,
        Some(times) => {
            let times = times.and_then(|times| Ok((times.first, times.step()?)));
            // With a stated step, a first column without a name need not be times.
            if times.is_err() && header.time_column.is_none() && header.step.is_some() {
                None
            } else {
                Some(times?)
            }
        }
    };
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
                table.values.insert(0, 0.0);
                table.lines.prepend();
            }
            Some(step)
        }
        None => header.step,
    };
    let mut contents = Contents::new(RecordFormat::Columns, Scale::Settled);
    contents.traces.push(Trace {
        direction: Direction::parse(&header.name),
        name: header.name,
        unit: header.unit,
        step,
        values: table.values,
        lines: table.lines,
        peak: None,
    });
    Ok(contents)
}

/// Reads comments, header rows and numbers.
fn read_table(
    bytes: &[u8],
    options: &RecordOptions,
) -> Result<(Header, Option<Table>), RecordError> {
    let mut header = Header::default();
    let mut table: Option<Table> = None;
    let mut header_rows = 0;
    let mut column_names = None;
    let mut lines = Lines::new(bytes);
    while let Some(line) = lines.next() {
        let (number_of_line, content) = (line.number, line.text.trim());
        if let Some(comment) = comment(content) {
            // Behind the first numbers, a mark in place of a digit is damage.
            let row = table.as_ref().map(|table| table.columns);
            if comment.starts_with(|c: char| c.is_ascii_digit() || matches!(c, '.' | '-'))
                && row == Some(cells(comment).count())
            {
                let found = cells(content).next().unwrap_or(content);
                return Err(bad_number(number_of_line, found));
            }
            read_comment(&mut header, number_of_line, comment)?;
            continue;
        }
        if content.is_empty() {
            continue;
        }
        if let Some(table) = &mut table {
            table.push(number_of_line, content)?;
            continue;
        }
        let first = cells(content).next().unwrap_or("");
        if number(number_of_line, first).is_err() {
            header_rows += 1;
            if header_rows > MOST_HEADER_ROWS {
                return Err(bad_number(number_of_line, first));
            }
            column_names = Some((number_of_line, content.to_owned()));
            continue;
        }
        // The header row nearest to the numbers names the columns.
        if let Some((line, content)) = column_names.take() {
            read_column_names(&mut header, line, &content, options.component.as_deref())?;
        }
        let rows = lines.lines_left() + 1;
        let mut opened = Table::open(&header, options, number_of_line, content, rows)?;
        opened.push(number_of_line, content)?;
        table = Some(opened);
    }
    Ok((header, table))
}

impl Table {
    /// A table for rows like this one.
    fn open(
        header: &Header,
        options: &RecordOptions,
        line: usize,
        row: &str,
        rows: usize,
    ) -> Result<Self, RecordError> {
        let columns = cells(row).count();
        let acceleration = acceleration_column(header, options, line, columns)?;
        let time_column = header.time_column.unwrap_or(0);
        let has_times = columns >= 2 && time_column != acceleration;
        let unit = header.time_unit.unwrap_or(1.0);
        Ok(Self {
            columns,
            acceleration,
            values: Vec::with_capacity(rows),
            lines: LineMap::default(),
            times: has_times.then(|| Ok(Times::with_capacity(rows, unit))),
            time_column,
        })
    }

    /// Appends a row of numbers.
    fn push(&mut self, line: usize, row: &str) -> Result<(), RecordError> {
        let (mut found, mut time, mut acceleration) = (0, "", "");
        for cell in cells(row) {
            if found == self.time_column {
                time = cell;
            }
            if found == self.acceleration {
                acceleration = cell;
            }
            found += 1;
        }
        if found != self.columns {
            return Err(RecordError::Ragged {
                line,
                found,
                expected: self.columns,
            });
        }
        if let Some(times @ Ok(_)) = &mut self.times
            && let Ok(read) = times
            && let Err(error) = read.push(line, time)
        {
            *times = Err(error);
        }
        self.values.push(number(line, acceleration)?);
        self.lines.note(line, 1);
        Ok(())
    }
}

fn comment(line: &str) -> Option<&str> {
    ["#", "%", "//", "!"]
        .iter()
        .find_map(|mark| line.strip_prefix(mark))
}

/// Cells of a line: between semicolons, else commas, else blanks.
fn cells(line: &str) -> impl Iterator<Item = &str> {
    let separator = [';', ','].into_iter().find(|mark| line.contains(*mark));
    let line = separator.map_or(line, |mark| line.strip_suffix(mark).unwrap_or(line));
    let split = separator.map(|mark| line.split(mark).map(str::trim));
    let blank = separator.is_none().then(|| line.split_whitespace());
    split
        .into_iter()
        .flatten()
        .chain(blank.into_iter().flatten())
}

/// Index of the column that holds the acceleration.
fn acceleration_column(
    header: &Header,
    options: &RecordOptions,
    line: usize,
    columns: usize,
) -> Result<usize, RecordError> {
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
        (None, Some(column), _) if column < columns && (header.is_chosen || !header.has_rivals) => {
            column
        }
        (None, _, 1) => 0,
        (None, None, 2) => 1,
        _ => return Err(RecordError::WhichColumn { line, columns }),
    };
    Ok(column)
}
