//! The motion of the table from measurements.

use std::ops::Range;

use jostle::GroundMotion;
use jostle_io::{Dimension, TableMotion};
use jostle_motion::{Accelerogram, Butterworth, butterworth};

use super::Measurements;
use crate::error::RunError;

/// Greatest acceleration of a table \[m/s²\].
const GREATEST: f64 = 100.0;
/// Order of the low-pass.
const ORDER: usize = 4;

/// The rows of the data that the run covers, three at least.
pub(super) fn rows(data: Measurements<'_>) -> Result<Range<usize>, RunError> {
    let table = data.table;
    let points = table.points();
    let last_instant = table.start + (points.max(1) - 1) as f64 * table.step;
    let row = |instant: f64| (instant - table.start) / table.step;
    let outside = |key: &str, instant: f64| {
        let problem = format!(
            "{instant} s lies outside the data of {}, from {} s to {last_instant:.6} s",
            data.name, table.start
        );
        RunError::from(data.map.fault_at(key, problem))
    };
    let first = match data.map.start {
        None => 0,
        Some(start) if (-1e-6..(points as f64 - 1.0)).contains(&row(start)) => {
            (row(start) - 1e-6).ceil().max(0.0) as usize
        }
        Some(start) => return Err(outside("start", start)),
    };
    let end = match data.map.end {
        None => points,
        Some(end) if row(end) > 0.0 && row(end) <= points as f64 - 1.0 + 1e-6 => {
            ((row(end) + 1e-6).floor() as usize + 1).min(points)
        }
        Some(end) => return Err(outside("end", end)),
    };
    if end < first + 3 {
        let problem = format!(
            "{} rows of {} lie between start and end; three are needed at least",
            end.saturating_sub(first),
            data.name
        );
        return Err(data.map.fault_at("end", problem).into());
    }
    Ok(first..end)
}

/// The motion of the table over some rows, and remarks on how it was found.
pub(super) fn table_motion(
    data: Measurements<'_>,
    rows: Range<usize>,
) -> Result<(GroundMotion, Vec<String>), RunError> {
    let (map, step) = (data.map, data.table.step);
    let mut notes = Vec::new();
    let (named, mut acceleration) = match &map.table {
        TableMotion::Acceleration(column) => {
            (column, data.values(column, Dimension::Acceleration, &rows)?)
        }
        TableMotion::Displacement(column) => {
            let displacement = data.values(column, Dimension::Length, &rows)?;
            if map.low_pass.is_none() {
                notes.push(format!(
                    "the displacement {} is differentiated twice without a filter, which amplifies its noise; low_pass = \"25 Hz\" removes high frequencies",
                    column.name
                ));
            }
            (column, second_differences(&displacement, step))
        }
    };
    if map.reverse {
        acceleration.iter_mut().for_each(|value| *value = -*value);
    }
    if map.low_pass.is_some() {
        let filter = Butterworth {
            low: None,
            high: map.low_pass,
            order: ORDER,
        };
        let filtered = Accelerogram::new(step, acceleration)
            .and_then(|motion| butterworth(&motion, &filter))
            .map_err(|fault| map.fault_at("low_pass", fault.to_string()))?;
        acceleration = filtered.into_acceleration();
    }
    let peak = acceleration.iter().fold(0.0, |m: f64, a| m.max(a.abs()));
    if peak > GREATEST {
        let problem = format!(
            "the table would reach an acceleration of {peak:.3e} m/s²; is the unit of the column right?"
        );
        return Err(map.fault(named, problem).into());
    }
    let first = acceleration.first().copied().unwrap_or(0.0).abs();
    if first > 0.05 * peak {
        notes.push(format!(
            "the table accelerates by {first:.3} m/s² at the start of the run, {:.0} % of its peak; the run begins from rest: choose start before the motion",
            100.0 * first / peak
        ));
    }
    Ok((GroundMotion::sampled(data.name, step, acceleration), notes))
}

/// Second central differences; the ends repeat their neighbours.
fn second_differences(values: &[f64], step: f64) -> Vec<f64> {
    let inner = values
        .windows(3)
        .map(|three| (three[2] - 2.0 * three[1] + three[0]) / (step * step));
    let inner: Vec<f64> = inner.collect();
    let first = inner.first().copied();
    let last = inner.last().copied();
    first.into_iter().chain(inner).chain(last).collect()
}

#[cfg(test)]
mod tests {
    use super::second_differences;

    #[test]
    fn a_parabola_has_one_acceleration() {
        let values: Vec<f64> = (0..6).map(|k| 1.5 * f64::from(k * k) * 0.01).collect();
        let found = second_differences(&values, 0.1);
        assert_eq!(found.len(), 6);
        assert!(found.iter().all(|a| (a - 3.0).abs() < 1e-9), "{found:?}");
    }
}
