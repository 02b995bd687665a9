//! Columns of printed times, and the step between them.

use crate::record::{RecordError, number};

/// Printed times: equally spaced, but for the rounding of their last digit.
pub(crate) struct Times {
    lines: Vec<usize>,
    values: Vec<f64>,
    /// Unit of the last printed digit.
    digits: Vec<f64>,
    /// The first time \[s\].
    pub(crate) first: f64,
}

impl Times {
    /// Reads printed times, each with its line, in a unit of this many seconds.
    pub(crate) fn read<'t>(
        cells: impl Iterator<Item = (usize, &'t str)>,
        unit: f64,
    ) -> Result<Self, RecordError> {
        let mut times = Self {
            lines: Vec::new(),
            values: Vec::new(),
            digits: Vec::new(),
            first: 0.0,
        };
        for (line, text) in cells {
            times.lines.push(line);
            times.values.push(unit * number(line, text)?);
            times.digits.push(unit * last_digit(text));
        }
        times.first = times.values.first().copied().unwrap_or(0.0);
        Ok(times)
    }

    /// The common step, freed from the rounding of the printed times.
    pub(crate) fn step(&self) -> Result<f64, RecordError> {
        let count = self.values.len();
        let (Some(last), Some(digit), true) = (self.values.last(), self.digits.last(), count >= 2)
        else {
            return Err(RecordError::TooFew { found: count });
        };
        if let Some(before) = self.values.windows(2).position(|pair| pair[1] <= pair[0]) {
            return Err(RecordError::TimeNotRising {
                line: self.lines[before + 1],
                found: self.values[before + 1],
            });
        }
        let first_digit = self.digits.first().copied().unwrap_or(0.0);
        let intervals = (count - 1) as f64;
        let step = (last - self.first) / intervals;
        // Times printed too coarsely to tell a rounded step from a lost line must be exact.
        let rounding = |digit: f64| {
            if digit <= 0.25 * step {
                0.51 * digit
            } else {
                0.0
            }
        };
        let ends = rounding(*digit) + rounding(first_digit);
        for (i, time) in self.values.iter().enumerate() {
            let expected = self.first + i as f64 * step;
            let allowed = ends + rounding(self.digits[i]) + 1e-6 * step + 1e-9 * time.abs();
            if (time - expected).abs() > allowed {
                return Err(self.culprit(i, expected));
            }
        }
        Ok(simplest(step, (ends / intervals).max(1e-12 * step)))
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
            line: self.lines[at],
            found: self.values[at],
            expected: simplest(expected, 1e-9 * expected.abs()),
        }
    }
}

/// Unit of the last printed digit: 0.01 for `1.25`, 1e-4 for `1.25e-2`.
fn last_digit(text: &str) -> f64 {
    let lower = text
        .to_ascii_lowercase()
        .replace('d', "e")
        .replace(',', ".");
    let (mantissa, exponent) = lower.split_once('e').unwrap_or((&lower, "0"));
    let decimals = mantissa.split_once('.').map_or(0, |(_, d)| d.len());
    let exponent: i32 = exponent.parse().unwrap_or(0);
    let decimals = i32::try_from(decimals).unwrap_or(i32::MAX);
    10f64.powi(exponent.saturating_sub(decimals).clamp(-300, 300))
}

/// The number of fewest digits within `uncertainty` of a value: 0.02 for 0.019999999.
fn simplest(value: f64, uncertainty: f64) -> f64 {
    (0..15)
        .filter_map(|digits| format!("{value:.digits$e}").parse::<f64>().ok())
        .find(|rounded| (rounded - value).abs() <= uncertainty)
        .unwrap_or(value)
}
