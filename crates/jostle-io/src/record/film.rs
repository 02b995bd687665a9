//! Pairs of time and acceleration, as digitised from film: times are equally spaced only nearly, or not at all.

use crate::record::RecordOptions;
use crate::record::contents::{Peak, largest};
use crate::record::error::RecordError;
use crate::record::fixed::{Block, Fixed};
use crate::record::formats::RecordFormat;
use crate::record::lines::LineMap;
use crate::record::lines::Lines;

/// Pairs of time and acceleration.
pub(crate) struct Film {
    first_line: usize,
    /// Times and accelerations in turn.
    pairs: Vec<f64>,
    lines: LineMap,
}

/// Printed times have three decimals \[s\].
const TIME_DIGIT: f64 = 1e-3;

impl Film {
    /// Reads a number of pairs, printed in these columns.
    pub(crate) fn read(
        lines: &mut Lines<'_>,
        count: usize,
        fixed: Fixed,
        format: RecordFormat,
    ) -> Result<Self, RecordError> {
        let first_line = lines.number() + 1;
        let block = fixed.read(lines, 2 * count.min(1 << 30), format)?;
        let mut times = block.values.iter().step_by(2).enumerate();
        let mut before = f64::NEG_INFINITY;
        if let Some((at, time)) =
            times.find(|(_, time)| std::mem::replace(&mut before, **time) >= **time)
        {
            return Err(RecordError::TimeNotRising {
                line: block.lines.line_of(2 * at),
                found: *time,
            });
        }
        Ok(Self {
            first_line,
            pairs: block.values,
            lines: block.lines,
        })
    }

    fn times(&self) -> impl Iterator<Item = f64> {
        self.pairs.iter().step_by(2).copied()
    }

    fn accelerations(&self) -> Vec<f64> {
        self.pairs.iter().skip(1).step_by(2).copied().collect()
    }

    /// The last time \[s\].
    pub(crate) fn end(&self) -> f64 {
        self.times().last().unwrap_or(0.0)
    }

    /// Compares the pairs with the peak that the header states.
    pub(crate) fn check_peak(&self, peak: Peak, format: RecordFormat) -> Result<(), RecordError> {
        let found = largest(&self.accelerations());
        if (found - peak.value.abs()).abs() <= 1.001 * peak.digit {
            return Ok(());
        }
        Err(RecordError::Peak {
            format,
            line: peak.line,
            stated: peak.value,
            found,
        })
    }

    /// Step and accelerations: unchanged if the times are equally spaced to their last digit; interpolated linearly
    /// if the options give a step.
    pub(crate) fn equally_spaced(
        self,
        options: &RecordOptions,
    ) -> Result<(f64, Block), RecordError> {
        let count = self.pairs.len() / 2;
        if count < 2 {
            return Err(RecordError::TooFew { found: count });
        }
        let (start, end) = (self.times().next().unwrap_or(0.0), self.end());
        let mean = (end - start) / (count - 1) as f64;
        let step = nearest_round(mean);
        let off = |(at, time): (usize, f64)| (time - start - at as f64 * step).abs() > TIME_DIGIT;
        if !self.times().enumerate().any(off)
            && options.step.is_none_or(|s| (s / step - 1.0).abs() < 1e-6)
        {
            let block = Block {
                values: self.accelerations(),
                lines: LineMap::default(),
            };
            return Ok((step, block));
        }
        let Some(step) = options.step.filter(|step| *step >= 0.1 * mean) else {
            let steps = || self.times().zip(self.times().skip(1)).map(|(a, b)| b - a);
            let round = |value: f64| (1e6 * value).round() / 1e6;
            return Err(RecordError::FilmTimes {
                line: self.first_line,
                least: round(steps().fold(f64::INFINITY, f64::min)),
                greatest: round(steps().fold(0.0, f64::max)),
                suggested: step,
            });
        };
        Ok((step, self.interpolated(start, end, step)))
    }

    /// Straight lines between the pairs.
    fn interpolated(&self, start: f64, end: f64, step: f64) -> Block {
        let points = ((end - start) / step + 1e-9).floor() as usize + 1;
        let mut values = Vec::with_capacity(points);
        let mut at = 0;
        for point in 0..points {
            let time = start + point as f64 * step;
            while 2 * at + 4 < self.pairs.len() && self.pairs[2 * at + 2] < time {
                at += 1;
            }
            let (t0, a0) = (self.pairs[2 * at], self.pairs[2 * at + 1]);
            let (t1, a1) = (self.pairs[2 * at + 2], self.pairs[2 * at + 3]);
            let part = ((time - t0) / (t1 - t0)).clamp(0.0, 1.0);
            values.push(a0 + part * (a1 - a0));
        }
        Block {
            values,
            lines: self.lines.clone(),
        }
    }
}

/// The usual step next to this one: 0.005 for 0.004999.
fn nearest_round(step: f64) -> f64 {
    let digits = format!("{step:.1e}");
    digits.parse().unwrap_or(step)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn interpolation_follows_the_straight_lines() {
        let film = Film {
            first_line: 1,
            pairs: vec![0.0, 0.0, 0.3, 3.0, 0.4, 2.0, 1.0, -4.0],
            lines: LineMap::default(),
        };
        let block = film.interpolated(0.0, 1.0, 0.1);
        let wanted = [0.0, 1.0, 2.0, 3.0, 2.0, 1.0, 0.0, -1.0, -2.0, -3.0, -4.0];
        assert_eq!(block.values.len(), wanted.len());
        for (found, wanted) in block.values.iter().zip(wanted) {
            assert!((found - wanted).abs() < 1e-12, "{found}, not {wanted}");
        }
    }
}
