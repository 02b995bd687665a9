//! Metadata of columns of text: comments, and the rows of names and units.

use crate::quantity::{Dimension, parse_quantity, shorten};
use crate::record::RecordOptions;
use crate::record::error::RecordError;
use crate::record::units::{acceleration_unit, is_other_unit, option_unit, time_unit, wrong_unit};
use jostle::statics::STANDARD_GRAVITY;

/// Data of comments and the header rows.
#[derive(Clone, Default)]
pub(super) struct Header {
    pub(super) unit: Option<(String, f64)>,
    pub(super) step: Option<f64>,
    /// Size of the unit `g` in this file \[m/s²\].
    pub(super) gravity: Option<f64>,
    pub(super) time_column: Option<usize>,
    pub(super) acceleration_column: Option<usize>,
    /// Size of the unit of the times \[s\].
    pub(super) time_unit: Option<f64>,
    /// Name of the column of accelerations.
    pub(super) name: String,
    /// Whether the component asked for is that column.
    pub(super) is_chosen: bool,
    /// Whether further columns are named like accelerations.
    pub(super) has_rivals: bool,
    /// Columns that a row names.
    pub(super) names: usize,
    /// Number of values that a comment states, and its line.
    pub(super) points: Option<(usize, usize)>,
}

/// A header row with its line.
pub(super) struct HeaderRow {
    pub(super) line: usize,
    pub(super) cells: Vec<String>,
}

impl HeaderRow {
    pub(super) fn new(line: usize, cells: &[&str]) -> Self {
        let cells = cells.iter().map(|cell| (*cell).to_owned()).collect();
        Self { line, cells }
    }
}

/// `unit = g`, `step = 0.02 s` (or `dt`), `gravity = 9.81 m/s2`; other comments are ignored.
pub(super) fn read_comment(
    header: &mut Header,
    line: usize,
    comment: &str,
) -> Result<(), RecordError> {
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
        "points" | "npts" => {
            let points = value.parse().map_err(|_| bad_number(line, value))?;
            header.points = Some((points, line));
        }
        _ => {}
    }
    Ok(())
}

pub(super) fn bad_number(line: usize, text: &str) -> RecordError {
    RecordError::NotANumber {
        line,
        found: shorten(text),
    }
}

fn read_unit(line: usize, text: &str) -> Result<(String, f64), RecordError> {
    let size = acceleration_unit(text).ok_or_else(|| wrong_unit(line, text))?;
    Ok((text.to_owned(), size))
}

/// Where the unit of a column is written.
#[derive(Clone, Copy, PartialEq)]
enum Written {
    /// In brackets behind the name, or in the row of units.
    Apart,
    /// Behind the name and an underscore, which may also mean something else.
    Underscore,
}

/// A column with its name and unit as written.
struct Column {
    /// Name without unit, in small letters.
    word: String,
    /// Whole name in small letters.
    whole: String,
    unit: Option<(String, Written, usize)>,
}

/// `time_s,acceleration_g`, `time (s), acc (g)`, `t a`; units may stand in a row of their own.
///
/// If a component is requested, the column whose name begins so holds the acceleration; a column requested by number
/// has the unit that is written for it.
pub(super) fn read_columns(
    header: &mut Header,
    names: Option<&HeaderRow>,
    units: Option<&HeaderRow>,
    columns: usize,
    options: &RecordOptions,
) -> Result<(), RecordError> {
    // A title has as many cells as it happens to have words. Above a single column it may name the unit.
    let fits = |row: &&HeaderRow| row.cells.len() == columns || columns == 1;
    let names = names.filter(fits);
    let units = units.filter(|row| row.cells.len() == columns);
    header.names = names.map_or(0, |row| row.cells.len());
    let count = header.names.max(units.map_or(0, |row| row.cells.len()));
    let table: Vec<Column> = (0..count).map(|at| column(names, units, at)).collect();

    let component = options
        .component
        .as_deref()
        .map(|name| name.trim().to_lowercase());
    for (at, column) in table.iter().enumerate() {
        let word = column.word.as_str();
        let is_time = matches!(
            word,
            "t" | "time" | "times" | "zeit" | "tiempo" | "zaman" | "temps" | "tempo"
        ) || header.time_column.is_none() && at == 0 && is_time_unit(column);
        let is_wanted = component
            .as_deref()
            .is_some_and(|c| [word, &column.whole].contains(&c));
        let is_acceleration = is_wanted
            || matches!(word, "a" | "ag" | "a_g" | "acc" | "accel")
            || word.starts_with("acceleration")
            || word.starts_with("ground_acceleration")
            || word.starts_with("ground acceleration");
        if is_time && header.time_column.is_none() {
            header.time_column = Some(at);
            header.time_unit = match &column.unit {
                None => None,
                Some((unit, _, line)) => {
                    let size = time_unit(unit);
                    Some(size.ok_or_else(|| bad_number(*line, unit))?)
                }
            };
        } else if is_acceleration && header.acceleration_column.is_some() && !is_wanted {
            header.has_rivals = true;
        } else if is_acceleration {
            header.acceleration_column = Some(at);
            header.is_chosen = is_wanted;
        }
    }
    // The only acceleration by its unit.
    let by_unit = |column: &Column| {
        let unit = column.unit.as_ref();
        unit.is_some_and(|(unit, written, _)| {
            *written == Written::Apart && acceleration_unit(unit).is_some()
        })
    };
    if header.acceleration_column.is_none() {
        let mut found = (0..table.len()).filter(|at| by_unit(&table[*at]));
        if let (Some(only), None) = (found.next(), found.next()) {
            header.acceleration_column = Some(only);
        }
    }
    let by_number = options.column.and_then(|column| column.checked_sub(1));
    let read = by_number.or(header.acceleration_column);
    let Some(column) = read.and_then(|at| table.get(at)) else {
        return Ok(());
    };
    // A choice by name is met by any further check of the component.
    header.name = match &options.component {
        Some(component) if header.is_chosen => component.trim().to_owned(),
        _ => column.word.clone(),
    };
    if let (Some((unit, written, line)), None) = (&column.unit, &header.unit) {
        // Chosen by number or by its whole name, a column may end in something else than a unit.
        let chosen = by_number.is_some() || header.is_chosen;
        let overruled = options.unit.is_some() && !is_other_unit(unit);
        header.unit = match read_unit(*line, unit) {
            Ok(unit) => Some(unit),
            Err(_) if overruled => None,
            Err(_) if chosen && (*written == Written::Underscore || !is_other_unit(unit)) => None,
            Err(error) => return Err(error),
        };
    }
    Ok(())
}

fn is_time_unit(column: &Column) -> bool {
    let unit = column.unit.as_ref();
    unit.is_some_and(|(unit, written, _)| *written == Written::Apart && time_unit(unit).is_some())
}

/// One column of the rows of names and units.
fn column(names: Option<&HeaderRow>, units: Option<&HeaderRow>, at: usize) -> Column {
    let name = names.and_then(|row| row.cells.get(at));
    let whole = name.map(|name| name.trim_matches('"').trim().to_lowercase());
    let whole = whole.unwrap_or_default();
    let (word, inside) = split_unit(&whole);
    let line = names.map_or(0, |row| row.line);
    let inside = inside.map(|(unit, written)| (unit.to_owned(), written, line));
    let below = units.and_then(|row| {
        let unit = row.cells.get(at)?.trim();
        (!unit.is_empty()).then(|| (unit.to_owned(), Written::Apart, row.line))
    });
    Column {
        word: word.to_owned(),
        unit: below.or(inside),
        whole,
    }
}

/// `acc (g)` as `acc` and `g`; `acceleration_cm_s2` as `acceleration` and `cm_s2`.
fn split_unit(name: &str) -> (&str, Option<(&str, Written)>) {
    let name = name.trim();
    if let Some((word, unit)) = name.split_once(['(', '[']) {
        let unit = unit.trim_end_matches([')', ']']).trim();
        return (
            word.trim(),
            (!unit.is_empty()).then_some((unit, Written::Apart)),
        );
    }
    if matches!(name, "a_g" | "ground_acceleration") {
        return (name, None);
    }
    match name.split_once('_') {
        Some(("ground", rest)) => match rest.split_once('_') {
            Some((word, unit)) if word.starts_with("acc") => {
                ("acceleration", Some((unit, Written::Underscore)))
            }
            _ => (name, None),
        },
        Some((word, unit)) => (word, Some((unit, Written::Underscore))),
        None => (name, None),
    }
}

pub(super) fn apply_options(
    header: &mut Header,
    options: &RecordOptions,
) -> Result<(), RecordError> {
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
