//! How the lines of a table continue each other: instants with columns, values that continue from line to line, or
//! pairs of time and acceleration.

use crate::record::lines::number;

/// Whether one of two distances is usually smaller than another, whatever their size: mean and spread of their
/// difference over their sum.
#[derive(Default)]
struct Closer {
    count: f64,
    sum: f64,
    squares: f64,
}

impl Closer {
    fn note(&mut self, one: f64, other: f64) {
        let both = one + other;
        if both > 0.0 {
            let part = (other - one) / both;
            self.count += 1.0;
            self.sum += part;
            self.squares += part * part;
        }
    }

    /// Whether the first distance is smaller, to four standard errors.
    fn is_certain(&self) -> bool {
        if self.count < 6.0 {
            return false;
        }
        let mean = self.sum / self.count;
        let variance = (self.squares / self.count - mean * mean).max(0.0);
        mean > 0.05 && mean > 4.0 * (variance / self.count).sqrt()
    }
}

/// Distances between neighbours of a table of numbers.
///
/// If values continue from line to line, the end of a line is closer to the begin of the next line than the begins of
/// both lines are, and neighbours on a line are closer than neighbours in a column. In columns of different quantities
/// neither is so, and in columns of almost equal ones only the second.
#[derive(Default)]
pub(super) struct Survey {
    before: Vec<f64>,
    across_lines: Closer,
    within_lines: Closer,
    /// Whether every second number, from the first on, rises throughout, and over how many.
    last_time: Option<f64>,
    times: usize,
    is_unordered: bool,
}

impl Survey {
    /// Adds a line.
    pub(super) fn note(&mut self, cells: &[&str]) {
        let row = cells.iter().map(|cell| number(0, cell).unwrap_or(f64::NAN));
        let row: Vec<f64> = row.collect();
        for time in row.iter().step_by(2) {
            self.is_unordered |= self.last_time.is_some_and(|last| *time <= last) || time.is_nan();
            self.last_time = Some(*time);
            self.times += 1;
        }
        if row.len() == self.before.len() && row.len() > 1 {
            let end = self.before[row.len() - 1];
            self.across_lines
                .note((row[0] - end).abs(), (row[0] - self.before[0]).abs());
            let within: f64 = row.windows(2).map(|pair| (pair[1] - pair[0]).abs()).sum();
            let below = row.iter().zip(&self.before).skip(1);
            let below: f64 = below.map(|(value, above)| (value - above).abs()).sum();
            self.within_lines.note(within, below);
        }
        self.before = row;
    }

    /// Whether the numbers of a line continue from line to line.
    pub(super) fn continues(&self) -> bool {
        self.across_lines.is_certain() && self.within_lines.is_certain()
    }

    /// Whether every second number, from the first on, rises throughout.
    pub(super) fn has_rising_pairs(&self) -> bool {
        !self.is_unordered && self.times >= 4
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn survey(rows: &[Vec<f64>]) -> Survey {
        let mut survey = Survey::default();
        for row in rows {
            let cells: Vec<String> = row.iter().map(|value| format!("{value:.6}")).collect();
            survey.note(&cells.iter().map(String::as_str).collect::<Vec<_>>());
        }
        survey
    }

    fn shaking(i: usize, phase: f64) -> f64 {
        let t = 0.01 * i as f64;
        (-(t - 2.0).powi(2)).exp()
            * ((14.0 * t + phase).sin() + 0.6 * (37.0 * t + 2.0 * phase).sin())
    }

    #[test]
    fn wrapped_values_continue_and_columns_do_not() {
        for per_line in [2, 3, 5, 8, 10] {
            let values: Vec<f64> = (0..600).map(|i| shaking(i, 0.0)).collect();
            let rows: Vec<_> = values.chunks_exact(per_line).map(<[f64]>::to_vec).collect();
            assert!(survey(&rows).continues(), "{per_line} on a line");
        }
        let columns = |make: &dyn Fn(usize) -> Vec<f64>| (0..400).map(make).collect::<Vec<_>>();
        let three = columns(&|i| vec![shaking(i, 0.0), shaking(i, 1.0), 0.3 * shaking(i, 2.0)]);
        let equal = columns(&|i| vec![shaking(i, 0.0), 1.0001 * shaking(i, 0.0)]);
        let quantities = columns(&|i| vec![shaking(i, 0.0), 30.0 * shaking(i, 1.5), 4.0]);
        let timed = columns(&|i| vec![0.01 * i as f64, shaking(i, 0.0)]);
        for (what, rows) in [
            ("components", three),
            ("almost equal", equal),
            ("quantities", quantities),
            ("timed", timed),
        ] {
            assert!(!survey(&rows).continues(), "{what}");
        }
    }

    #[test]
    fn noise_is_no_evidence() {
        let mut state = 1_u64;
        let mut noise = || {
            state = state
                .wrapping_mul(6_364_136_223_846_793_005)
                .wrapping_add(1);
            (state >> 33) as f64 / f64::from(u32::MAX)
        };
        for _ in 0..50 {
            let rows: Vec<Vec<f64>> = (0..300).map(|_| vec![noise(), noise(), noise()]).collect();
            assert!(!survey(&rows).continues());
        }
    }
}
