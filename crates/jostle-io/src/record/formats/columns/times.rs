//! Columns of printed times, and the step between them.

use crate::record::clock::Clock;
use crate::record::error::RecordError;
use crate::record::lines::{LineMap, last_digit, number, simplest};

/// Rounding of a time that was computed in 32-bit reals, over its magnitude: two units of the last place, as
/// begin + i·step has two roundings \[–\].
const SINGLE: f64 = 2.0 * f32::EPSILON as f64;

/// Greatest difference of two roundings, over the last digit \[–\].
const ROUNDED: f64 = 1.02;

/// The step, or the frequency, of fewest digits within `uncertainty` of a step: 1/256 s for 0.003906; of equally
/// simple ones the step.
fn simplest_step(step: f64, uncertainty: f64) -> f64 {
    let as_step = simplest(step, uncertainty);
    let frequency = simplest(1.0 / step, uncertainty / (step * step));
    let digits = |value: f64| {
        let mantissa = format!("{value:e}");
        mantissa.split('e').next().map_or(0, str::len)
    };
    let inverse = 1.0 / frequency;
    let fits = (inverse - step).abs() <= uncertainty;
    if fits && digits(frequency) < digits(as_step) {
        inverse
    } else {
        as_step
    }
}

/// Printed times: equally spaced except for the rounding of their last digit.
#[derive(Default)]
pub(crate) struct Times {
    lines: LineMap,
    values: Vec<f64>,
    /// Unit of the last printed digit, as a power of ten of a second or of `unit`.
    digits: Vec<i16>,
    /// Unit of the printed times \[s\].
    unit: f64,
    /// The first time; 0 for times of day \[s\].
    pub(crate) first: f64,
    /// The first time of day, and midnights since then, for times of day.
    clock: Option<(Clock, f64)>,
}

/// A day \[s\].
const DAY: f64 = 86_400.0;

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
        let (value, digit) = match Clock::parse(text) {
            Some(clock) => (self.since_first(clock), clock.digit / self.unit),
            None => (self.unit * number(line, text)?, last_digit(text)),
        };
        if self.values.is_empty() {
            self.first = value;
        }
        self.values.push(value);
        self.digits.push(libm::log10(digit).round() as i16);
        self.lines.note(line, 1);
        Ok(())
    }

    /// Time from the first time of day; a time without a date that is half a day earlier than the one before it is
    /// that of the next day \[s\].
    fn since_first(&mut self, clock: Clock) -> f64 {
        let (first, midnights) = self.clock.get_or_insert((clock, 0.0));
        let within = clock.seconds - first.seconds;
        if let (Some(day), Some(first)) = (clock.day, first.day) {
            return DAY * (day - first) as f64 + within;
        }
        let last = self.values.last().copied().unwrap_or(0.0);
        if within + DAY * *midnights < last - 0.5 * DAY {
            *midnights += 1.0;
        }
        within + DAY * *midnights
    }

    /// Whether the times rise throughout, as times do.
    pub(crate) fn rise(&self) -> bool {
        self.values.len() >= 3 && self.values.windows(2).all(|pair| pair[1] > pair[0])
    }

    /// Whether a record with this step begins one step after its origin, to the digits printed.
    pub(crate) fn begin_after(&self, step: f64) -> bool {
        let digit = self.digit(0);
        let rounding = if digit < 0.5 * step {
            0.51 * digit
        } else {
            0.0
        };
        self.clock.is_none() && (self.first - step).abs() < (1e-3 * step).max(rounding)
    }

    /// Unit of the last printed digit of a time \[s\].
    fn digit(&self, at: usize) -> f64 {
        self.digits
            .get(at)
            .map_or(0.0, |d| self.unit * 10f64.powi(i32::from(*d)))
    }

    /// The common step, freed from the rounding of the printed times.
    pub(crate) fn step(&self) -> Result<f64, RecordError> {
        self.step_given(None)
    }

    /// The same; times that are rounded too coarsely to show their step need only agree with the one stated.
    pub(crate) fn step_given(&self, stated: Option<f64>) -> Result<f64, RecordError> {
        self.own_step().or_else(|error| {
            let agrees = |step: &f64| self.values.len() >= 2 && self.follow(*step);
            stated.filter(agrees).ok_or(error)
        })
    }

    fn own_step(&self) -> Result<f64, RecordError> {
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
        let ends = precise.or_else(|unequal| self.equal_steps(step, &single).map_err(|_| unequal));
        match ends {
            Ok(ends) => Ok(simplest_step(step, (ends / intervals).max(1e-12 * step))),
            Err(unequal) => match self.rounded_step(step) {
                Some(step) => Ok(step),
                None => Err(self.too_coarse(step).unwrap_or(unequal)),
            },
        }
    }

    /// A simple step whose instants are the printed times, rounded. A lost line would move all later times by a step,
    /// which two digits show.
    fn rounded_step(&self, mean: f64) -> Option<f64> {
        let digit = self.finest_digit();
        let uncertainty = ROUNDED * digit / (self.values.len() - 1) as f64;
        let step = simplest_step(mean, uncertainty);
        (step >= 2.1 * digit && self.follow(step)).then_some(step)
    }

    /// The error that asks for the step if times differ from equal steps by no more than their rounding.
    fn too_coarse(&self, mean: f64) -> Option<RecordError> {
        let digit = self.finest_digit();
        // One longer interval is a lost line.
        let first = self.values[1] - self.values[0];
        let intervals = self.values.windows(2).map(|pair| pair[1] - pair[0]);
        let others = intervals.filter(|interval| (interval - first).abs() > 0.5 * digit);
        let uncertainty = ROUNDED * digit / (self.values.len() - 1) as f64;
        let suggested = simplest_step(mean, uncertainty);
        if digit < 0.13 * mean || others.count() < 3 || !self.follow(suggested) {
            return None;
        }
        Some(RecordError::RoundedTimes {
            digit: simplest(digit, 1e-9 * digit),
            suggested,
        })
    }

    /// Whether all times are multiples of a step after one instant, rounded to their digits.
    fn follow(&self, step: f64) -> bool {
        let rest = |(i, time): (usize, &f64)| time - i as f64 * step;
        let rests = || self.values.iter().enumerate().map(rest);
        let least = rests().fold(f64::INFINITY, f64::min);
        let most = rests().fold(f64::NEG_INFINITY, f64::max);
        let largest = self.values.last().map_or(0.0, |last| last.abs());
        most - least <= ROUNDED * self.finest_digit() + 1e-9 * largest
    }

    /// Unit of the last digit of the times; programs that print no zeros at the end show it in some of them \[s\].
    fn finest_digit(&self) -> f64 {
        let digits = (0..self.values.len()).map(|at| self.digit(at));
        digits.fold(f64::INFINITY, f64::min)
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
