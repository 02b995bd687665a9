//! Metadata of columns of text: comments, and the row of names.

use super::cells;
use crate::quantity::{Dimension, parse_quantity, shorten};
use crate::record::RecordOptions;
use crate::record::error::RecordError;
use crate::record::units::{acceleration_unit, option_unit};
use jostle::statics::STANDARD_GRAVITY;

/// Data of comments and the header row.
#[derive(Default)]
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
    /// Number of values that a comment states, and its line.
    pub(super) points: Option<(usize, usize)>,
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
    let bad = || RecordError::Unit {
        line,
        found: shorten(text),
    };
    Ok((text.to_owned(), acceleration_unit(text).ok_or_else(bad)?))
}

/// `time_s,acceleration_g`, `time (s), acc (g)`, `t a`.
///
/// If a component is requested, the column whose name begins so holds the acceleration.
pub(super) fn read_column_names(
    header: &mut Header,
    line: usize,
    content: &str,
    component: Option<&str>,
) -> Result<(), RecordError> {
    let names: Vec<_> = if content.contains([',', ';']) || !content.contains(['(', '[']) {
        cells(content).collect()
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
        let is_wanted = component
            .is_some_and(|c| [word, lower.as_str()].contains(&c.trim().to_lowercase().as_str()));
        let is_acceleration = is_wanted
            || matches!(word, "a" | "ag" | "a_g" | "acc" | "accel")
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
        } else if is_acceleration && header.acceleration_column.is_some() && !is_wanted {
            header.has_rivals = true;
        } else if is_acceleration {
            header.acceleration_column = Some(column);
            header.is_chosen = is_wanted;
            // A choice by name is met by any further check of the component.
            header.name = match component {
                Some(component) if is_wanted => component.trim().to_owned(),
                _ => word.to_owned(),
            };
            if let (Some(unit), None) = (unit, &header.unit) {
                header.unit = match read_unit(line, unit) {
                    // A column chosen by its whole name may end in something else than a unit.
                    Err(_) if is_wanted => None,
                    unit => Some(unit?),
                };
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
