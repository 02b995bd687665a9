//! Records as columns of text: CSV, tabs or spaces, with or without times, one value on a line or several.
//!
//! Unit and step come from comments (`# unit = g`, `# step = 0.02 s`, `# gravity = 9.81 m/s2`), from the header rows
//! (`time_s,acceleration_g`, `time (s), acc (g)`, or names above units), from a first line with the number of values
//! and the step, from the times, or from the options. Missing data are asked for, never guessed, and a line that is
//! neither comment, header nor numbers is an error.

mod header;
mod row;
mod survey;
mod table;
mod times;

use crate::record::RecordOptions;
use crate::record::channel::Direction;
use crate::record::contents::{Contents, Scale, Trace};
use crate::record::error::RecordError;
use crate::record::formats::RecordFormat;
use crate::record::layout::RecordContent;
use crate::record::lines::{LineMap, check_end, number};

use header::{Header, apply_options};
use survey::Survey;
use table::{Head, Table, Window};
pub(crate) use times::Times;

/// The numbers that are read.
enum Reading {
    /// All of them.
    Values,
    /// Times and accelerations in turn.
    Pairs(Times),
    /// One column, and the times of another.
    Column(usize, Option<Times>),
}

/// Reads columns of text.
///
/// # Errors
/// [`RecordError`] when a line cannot be understood, times are not equally spaced, or unit, step or the meaning of
/// several numbers on a line are stated nowhere.
pub(crate) fn read(bytes: &[u8], options: &RecordOptions) -> Result<Contents, RecordError> {
    let window = Window::new(bytes, options)?;
    let mut table = Table::scan(&window, options)?;
    if window.reaches_end() {
        check_end(bytes)?;
    }
    let mut header = std::mem::take(&mut table.header);
    apply_options(&mut header, options)?;
    if table.numbers == 0 {
        return Err(RecordError::TooFew { found: 0 });
    }
    let head = table.count_and_step(options);
    if let Some(head) = &head {
        table.leave_out(head.lines);
        header.step = agreed_step(head.step, header.step)?;
    }
    let reading = reading(&window, &table, &header, head.as_ref(), options)?;
    let (values, lines) = values(&window, &table, &reading)?;
    if let Some((stated, line)) = header.points
        && stated != values.len()
    {
        return Err(RecordError::Count {
            line,
            stated,
            found: values.len(),
        });
    }
    finish(header, reading, values, lines)
}

/// The step of a first line and that of a comment or an option, which may not differ.
fn agreed_step(found: Option<f64>, stated: Option<f64>) -> Result<Option<f64>, RecordError> {
    if let (Some(found), Some(stated)) = (found, stated)
        && (stated / found - 1.0).abs() > 1e-3
    {
        return Err(RecordError::StepConflict { found, stated });
    }
    Ok(stated.or(found))
}

/// Joins values, step and unit.
fn finish(
    header: Header,
    reading: Reading,
    mut values: Vec<f64>,
    mut lines: LineMap,
) -> Result<Contents, RecordError> {
    let times = match reading {
        Reading::Values | Reading::Column(_, None) => None,
        Reading::Pairs(times) | Reading::Column(_, Some(times)) => Some(times),
    };
    let step = match times {
        Some(times) => {
            let step = times.step_given(header.step)?;
            agreed_step(Some(step), header.step)?;
            // A record whose first value is one step after the origin starts at rest.
            if times.begin_after(step) {
                values.insert(0, 0.0);
                lines.prepend();
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
        values,
        lines,
        peak: None,
    });
    Ok(contents)
}

/// Decides which numbers are accelerations and which are times.
fn reading(
    window: &Window<'_>,
    table: &Table,
    header: &Header,
    head: Option<&Head>,
    options: &RecordOptions,
) -> Result<Reading, RecordError> {
    let layout = &options.layout;
    let content = layout.content().or(head.and_then(|head| head.content));
    let columns = table.columns();
    if let Some(stated) = layout.per_line {
        table.check_per_line(stated)?;
    }
    match content {
        Some(RecordContent::Values) => {
            refuse_column(options, 1)?;
            table.check_first_number(header, options)?;
            return Ok(Reading::Values);
        }
        Some(RecordContent::Pairs) => {
            refuse_column(options, 2)?;
            let times = pair_times(window, table, header)?;
            return Ok(Reading::Pairs(times));
        }
        Some(RecordContent::Columns) | None => {}
    }
    if columns >= 4 && columns.is_multiple_of(2) && content.is_none() {
        let mut survey = Survey::default();
        table.rows(window, |_, cells| {
            survey.note(cells);
            Ok(())
        })?;
        if survey.has_rising_pairs()
            && options.column.is_none_or(|column| column == 2)
            && let Ok(times) = pair_times(window, table, header)
            && times.step_given(header.step).is_ok()
        {
            return Ok(Reading::Pairs(times));
        }
    }
    if columns == 1 {
        table.check_rows(header, false)?;
        if content.is_none() {
            table.check_first_number(header, options)?;
        }
        return match options.column {
            Some(wanted) if wanted != 1 => Err(no_column(table, wanted)),
            _ => Ok(Reading::Values),
        };
    }
    column_reading(window, table, header, options)
}

/// The column of accelerations of a table of several, and its times.
fn column_reading(
    window: &Window<'_>,
    table: &Table,
    header: &Header,
    options: &RecordOptions,
) -> Result<Reading, RecordError> {
    let columns = table.columns();
    let is_stated = options.layout.content == Some(RecordContent::Columns);
    let time_column = header.time_column.unwrap_or(0);
    let is_clear = header.is_chosen || !header.has_rivals;
    let named = header
        .acceleration_column
        .filter(|column| *column < columns && is_clear);
    let wanted = match options.column {
        Some(wanted) => {
            let at = wanted.checked_sub(1).filter(|at| *at < columns);
            Some(at.ok_or_else(|| no_column(table, wanted))?)
        }
        None => named,
    };

    let mut times = Times::with_capacity(table.row_count(), header.time_unit.unwrap_or(1.0));
    let mut survey = Survey::default();
    let mut unreadable = None;
    table.rows(window, |line, cells| {
        survey.note(cells);
        if unreadable.is_none() {
            let cell = cells.get(time_column).copied().unwrap_or("");
            unreadable = times.push(line, cell).err();
        }
        Ok(())
    })?;
    let found = match unreadable {
        Some(error) => Err(error),
        None => times.step_given(header.step).map(|_| ()),
    };
    let has_times = wanted != Some(time_column) && found.is_ok();
    if !is_stated && !has_times && survey.continues() {
        return Err(RecordError::Continued {
            line: table.first_line(),
            count: columns,
            last: None,
        });
    }
    table.check_rows(header, !has_times && !is_stated)?;
    if has_times {
        let column = wanted.or((columns == 2).then_some(1 - time_column.min(1)));
        let column = column.ok_or(RecordError::WhichColumn {
            line: table.first_line(),
            columns,
        })?;
        return Ok(Reading::Column(column, Some(times)));
    }
    // Times that are not equally spaced are times all the same.
    let are_times = header.time_column.is_some() || times.rise() && !is_stated;
    match (found, wanted) {
        (Err(error), _) if wanted != Some(time_column) && are_times => Err(error),
        (_, Some(column)) if header.step.is_some() || column == time_column => {
            Ok(Reading::Column(column, None))
        }
        (Err(error), Some(_)) if table.row_count() < 3 => Err(error),
        (_, Some(_)) => Err(RecordError::StepUnknown),
        (_, None) if table.row_count() < 4 => Err(RecordError::WhichColumn {
            line: table.first_line(),
            columns,
        }),
        (_, None) => Err(RecordError::ColumnsOrValues {
            line: table.first_line(),
            count: columns,
        }),
    }
}

/// The times of pairs of time and acceleration.
fn pair_times(window: &Window<'_>, table: &Table, header: &Header) -> Result<Times, RecordError> {
    let unit = header.time_unit.unwrap_or(1.0);
    let mut times = Times::with_capacity(table.numbers / 2 + 1, unit);
    table.rows(window, |line, cells| {
        if !cells.len().is_multiple_of(2) {
            return Err(RecordError::Ragged {
                line,
                found: cells.len(),
                expected: cells.len() + 1,
            });
        }
        cells
            .iter()
            .step_by(2)
            .try_for_each(|cell| times.push(line, cell))
    })?;
    Ok(times)
}

/// The accelerations in the unit of the file, and their lines.
fn values(
    window: &Window<'_>,
    table: &Table,
    reading: &Reading,
) -> Result<(Vec<f64>, LineMap), RecordError> {
    let count = match reading {
        Reading::Values => table.numbers,
        Reading::Pairs(_) => table.numbers / 2,
        Reading::Column(..) => table.row_count(),
    };
    let mut values = Vec::with_capacity(count);
    let mut lines = LineMap::default();
    table.rows(window, |line, cells| {
        let before = values.len();
        let mut push = |cell: &&str| number(line, cell).map(|value| values.push(value));
        match reading {
            Reading::Values => cells.iter().try_for_each(&mut push)?,
            Reading::Pairs(_) => cells.iter().skip(1).step_by(2).try_for_each(&mut push)?,
            Reading::Column(column, _) => push(cells.get(*column).unwrap_or(&""))?,
        }
        lines.note(line, values.len() - before);
        Ok(())
    })?;
    Ok((values, lines))
}

/// Refuses a column for numbers that are not in columns, unless it is the place of the acceleration.
fn refuse_column(options: &RecordOptions, place: usize) -> Result<(), RecordError> {
    match options.column {
        Some(column) if column != place => Err(RecordError::Layout {
            problem: format!(
                "column = {column} does not go with numbers that continue from line to line; omit one of them"
            ),
        }),
        _ => Ok(()),
    }
}

fn no_column(table: &Table, wanted: usize) -> RecordError {
    RecordError::NoColumn {
        line: table.first_line(),
        wanted,
        columns: table.columns(),
    }
}
