//! Extremes of a quantity within a step, from its value and rate at both ends.

use super::events::Cubic;
use crate::history::{Extreme, Peak};

/// The largest excess of a cubic over the range of its ends, in steps times the sum of its end slopes: 4/27.
pub(super) const BEYOND: f64 = 0.15;

/// Updates the extremes of a displacement with a step between (value, slope) at its ends.
#[inline]
pub(super) fn take_extremes(peak: &mut Peak, [then, now]: [(f64, f64); 2], start: f64, step: f64) {
    let greatest = greatest_in_step(then, now, start, step);
    if greatest.value > peak.greatest.value {
        peak.greatest = greatest;
    }
    let least = greatest_in_step((-then.0, -then.1), (-now.0, -now.1), start, step);
    if -least.value < peak.least.value {
        peak.least = Extreme {
            value: -least.value,
            at: least.at,
        };
    }
}

/// Greatest value in a step between (value, slope) at its ends.
pub(super) fn greatest_in_step(
    then: (f64, f64),
    now: (f64, f64),
    start: f64,
    step: f64,
) -> Extreme {
    let end = Extreme {
        value: now.0,
        at: start + step,
    };
    if then.1 <= 0.0 || now.1 >= 0.0 {
        return end;
    }
    Cubic::new(then.0, then.1, now.0, now.1, step)
        .peak(start, step)
        .unwrap_or(end)
}
