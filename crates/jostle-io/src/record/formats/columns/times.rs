//! Columns of printed times, and the step between them.

use crate::record::error::RecordError;
use crate::record::lines::{LineMap, last_digit, number, simplest};

/// Rounding of a time that was computed in 32-bit reals, over its magnitude: two units of the last place, as
/// begin + i·step has two roundings \[–\].
const SINGLE: f64 = 2.0 * f32::EPSILON as f64;

/// Printed times: equally spaced except for the rounding of their last digit.
#[derive(Default)]
pub(crate) struct Times {
    lines: LineMap,
    values: Vec<f64>,
    /// Unit of the last printed digit, as a power of ten of a second or of `unit`.
    digits: Vec<i16>,
    /// Unit of the printed times \[s\].
    unit: f64,
    /// The first time \[s\].
    pub(crate) first: f64,
}

impl Times {
    /// Capacity for a number of times, printed in a unit of given seconds.
    pub(crate) fn with_capacity(count: usize, unit: f64) -> Self {
        Self {
            values: Vec::with_capacity(count),
            digits: Vec::with_capacity(count),
            unit,
            ..Self::default()
        }
    }

    /// Appends a printed time.
    pub(crate) fn push(&mut self, line: usize, text: &str) -> Result<(), RecordError> {
        let value = self.unit * number(line, text)?;
        if self.values.is_empty() {
            self.first = value;
        }
        self.values.push(value);
        self.digits.push(last_digit(text).log10().round() as i16);
        self.lines.note(line, 1);
        Ok(())
    }

    /// Unit of the last printed digit of a time \[s\].
    fn digit(&self, at: usize) -> f64 {
        self.digits
            .get(at)
            .map_or(0.0, |d| self.unit * 10f64.powi(i32::from(*d)))
    }

    /// The common step, freed from the rounding of the printed times.
    pub(crate) fn step(&self) -> Result<f64, RecordError> {
        let count = self.values.len();
        let (Some(last), true) = (self.values.last(), count >= 2) else {
            return Err(RecordError::TooFew { found: count });
        };
        if let Some(before) = self.values.windows(2).position(|pair| pair[1] <= pair[0]) {
            return Err(RecordError::TimeNotRising {
                line: self.lines.line_of(before + 1),
                found: self.values[before + 1],
            });
        }
        let intervals = (count - 1) as f64;
        let step = (last - self.first) / intervals;
        // If rounding is too coarse to distinguish a rounded step from a lost line, times must be exact.
        let fine = |rounding: f64| {
            if rounding <= 0.13 * step {
                rounding
            } else {
                0.0
            }
        };
        let printed = |i: usize| fine(0.51 * self.digit(i));
        let single = |i: usize| fine(SINGLE * self.values[i].abs()) + printed(i);
        let precise = self.equal_steps(step, &printed);
        // Many programs keep times in 32 bits and print digits that these do not have.
        let ends = match precise {
            Ok(ends) => ends,
            Err(unequal) => self.equal_steps(step, &single).map_err(|_| unequal)?,
        };
        Ok(simplest(step, (ends / intervals).max(1e-12 * step)))
    }

    /// Possible effect of rounding between the ends \[s\], if every time is a whole number of steps after the
    /// first, except for its `rounding` and that of the ends.
    fn equal_steps(&self, step: f64, rounding: &dyn Fn(usize) -> f64) -> Result<f64, RecordError> {
        let ends = rounding(self.values.len() - 1) + rounding(0);
        for (i, time) in self.values.iter().enumerate() {
            let expected = self.first + i as f64 * step;
            let allowed = ends + rounding(i) + 1e-6 * step + 1e-9 * time.abs();
            if (time - expected).abs() > allowed {
                return Err(self.culprit(i, expected));
            }
        }
        Ok(ends)
    }

    /// The first time that does not continue the first step, rather than the one at `index`, which only
    /// differs from the mean step.
    fn culprit(&self, index: usize, expected: f64) -> RecordError {
        let step = self.values.get(1).map_or(0.0, |second| second - self.first);
        let continued = |i: usize| self.first + i as f64 * step;
        let jump = (2..self.values.len())
            .find(|i| (self.values[*i] - continued(*i)).abs() > 0.5 * step)
            .map(|i| (i, continued(i)));
        let (at, expected) = jump.unwrap_or((index, expected));
        RecordError::UnequalStep {
            line: self.lines.line_of(at),
            found: self.values[at],
            expected: simplest(expected, 1e-9 * expected.abs()),
        }
    }
}
