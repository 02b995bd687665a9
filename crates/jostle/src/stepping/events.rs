//! When a contact closes or opens inside a step: the cubic Hermite interpolant of its indentation.

use crate::history::Extreme;

/// Cubic through two values and two slopes over one step (theory, Eq. H1).
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Cubic {
    pub(crate) start: f64,
    pub(crate) end: f64,
    /// Slopes times the step.
    pub(crate) start_rise: f64,
    pub(crate) end_rise: f64,
}

/// Direction of a crossing of zero.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Crossing {
    Upwards,
    Downwards,
}

impl Cubic {
    pub(crate) fn new(start: f64, start_slope: f64, end: f64, end_slope: f64, step: f64) -> Self {
        Self {
            start,
            end,
            start_rise: start_slope * step,
            end_rise: end_slope * step,
        }
    }

    /// Sum of two cubics over the same step.
    pub(crate) fn plus(&self, other: &Self) -> Self {
        Self {
            start: self.start + other.start,
            end: self.end + other.end,
            start_rise: self.start_rise + other.start_rise,
            end_rise: self.end_rise + other.end_rise,
        }
    }

    /// Value at a fraction of the step.
    pub(crate) fn value(&self, at: f64) -> f64 {
        let [c0, c1, c2, c3] = self.powers();
        c0 + at * (c1 + at * (c2 + at * c3))
    }

    /// Slope times the step at a fraction of the step.
    pub(crate) fn rise(&self, at: f64) -> f64 {
        let [_, c1, c2, c3] = self.powers();
        c1 + at * (2.0 * c2 + at * 3.0 * c3)
    }

    /// Second derivative times the squared step at a fraction of the step.
    pub(crate) fn curvature(&self, at: f64) -> f64 {
        let [_, _, c2, c3] = self.powers();
        2.0 * c2 + 6.0 * c3 * at
    }

    fn powers(&self) -> [f64; 4] {
        let jump = self.end - self.start;
        [
            self.start,
            self.start_rise,
            3.0 * jump - 2.0 * self.start_rise - self.end_rise,
            self.start_rise + self.end_rise - 2.0 * jump,
        ]
    }

    /// Fractions of the step, in order, where the slope vanishes strictly inside it.
    pub(crate) fn turning_points(&self) -> impl Iterator<Item = f64> {
        let [_, c1, c2, c3] = self.powers();
        let discriminant = c2 * c2 - 3.0 * c1 * c3;
        let mut points = [f64::NAN; 2];
        if discriminant >= 0.0 {
            // The stable pair of roots of c1 + 2 c2 t + 3 c3 t².
            let q = -(c2 + c2.signum() * discriminant.sqrt());
            points = [q / (3.0 * c3), c1 / q];
            if points[0] > points[1] {
                points.swap(0, 1);
            }
        }
        points
            .into_iter()
            .filter(|point| *point > 0.0 && *point < 1.0)
    }

    /// Fraction of the step where the value first crosses zero in the given direction. The start counts as lying
    /// before the crossing.
    pub(crate) fn first_crossing(&self, crossing: Crossing) -> Option<f64> {
        let sign = if crossing == Crossing::Upwards {
            1.0
        } else {
            -1.0
        };
        let arrived = |at: f64| sign * self.value(at) > 0.0;
        // Between two turning points the value crosses zero at most once.
        let mut before = 0.0;
        for at in self.turning_points().chain([1.0]) {
            let there = if at == 1.0 {
                sign * self.end > 0.0
            } else {
                arrived(at)
            };
            if there {
                return Some(bisect(before, at, arrived));
            }
            before = at;
        }
        None
    }

    /// Whether the value certainly stays below zero in the whole step: a cubic leaves the range of its ends by no
    /// more than 4/27 of the sum of its end increments.
    pub(crate) fn stays_below_zero(&self) -> bool {
        self.start.max(self.end) + 0.15 * (self.start_rise.abs() + self.end_rise.abs()) < 0.0
    }

    /// Greatest value inside the step, if the cubic has a maximum there.
    pub(crate) fn peak(&self, start_time: f64, step: f64) -> Option<Extreme> {
        if self.start_rise <= 0.0 || self.end_rise >= 0.0 {
            return None;
        }
        // Of c1 + 2 c2 t + 3 c3 t², positive at 0 and negative at 1, the one root in between.
        let [_, c1, c2, c3] = self.powers();
        let root = (c2 * c2 - 3.0 * c1 * c3).max(0.0).sqrt();
        let at = if c2 <= 0.0 {
            c1 / (root - c2)
        } else {
            (c2 + root) / (-3.0 * c3)
        };
        let at = at.clamp(0.0, 1.0);
        Some(Extreme {
            value: self.value(at),
            at: start_time + at * step,
        })
    }
}

/// First point where `reached` holds, given that it does at `high`.
pub(crate) fn bisect(mut low: f64, mut high: f64, reached: impl Fn(f64) -> bool) -> f64 {
    for _ in 0..60 {
        let middle = 0.5 * (low + high);
        if middle <= low || middle >= high {
            break;
        }
        if reached(middle) {
            high = middle;
        } else {
            low = middle;
        }
    }
    high
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn cubic_reproduces_a_cubic() {
        let f = |t: f64| 2.0 - 3.0 * t + t * t * t;
        let slope = |t: f64| -3.0 + 3.0 * t * t;
        let (a, h) = (0.4, 1.7);
        let cubic = Cubic::new(f(a), slope(a), f(a + h), slope(a + h), h);
        for at in [0.0, 0.3, 0.9, 1.0] {
            assert!((cubic.value(at) - f(a + at * h)).abs() < 1e-13);
            assert!((cubic.rise(at) - h * slope(a + at * h)).abs() < 1e-12);
        }
        // It decreases, has a minimum of 0 at t = 1, and increases.
        assert_eq!(cubic.peak(a, h), None);
    }

    #[test]
    fn a_peak_is_where_the_slope_turns() {
        let mut found = 0;
        for i in 0..2000 {
            let value = |k: f64| (f64::from(i) * k).sin();
            let (rise, fall) = (value(1.3).abs() + 1e-6, -value(2.7).abs() - 1e-6);
            let cubic = Cubic::new(value(0.7), rise, 0.1 * value(5.1), fall, 1.0);
            let Some(peak) = cubic.peak(0.0, 1.0) else {
                continue;
            };
            found += 1;
            let at = bisect(0.0, 1.0, |at| cubic.rise(at) <= 0.0);
            // The accuracy of both roots follows from the slope there.
            assert!((cubic.value(at) - peak.value).abs() < 1e-14, "{cubic:?}");
            assert!((at - peak.at).abs() < 1e-9, "{cubic:?}: {at}, {peak:?}");
        }
        assert_eq!(found, 2000);
    }

    #[test]
    fn what_stays_below_never_crosses() {
        let mut below = 0;
        for i in 0..5000 {
            let value = |k: f64| (f64::from(i) * k).sin();
            let ends = [value(0.7) - 0.8, value(1.1) - 0.8];
            let cubic = Cubic::new(ends[0], 3.0 * value(2.3), ends[1], 3.0 * value(3.1), 1.0);
            if cubic.stays_below_zero() {
                below += 1;
                let highest = (0..=1000).map(|at| cubic.value(f64::from(at) / 1000.0));
                assert!(highest.fold(f64::NEG_INFINITY, f64::max) < 0.0, "{cubic:?}");
            }
        }
        assert!(below > 500, "{below}");
    }

    #[test]
    fn a_touch_between_two_open_ends_is_found() {
        // −0.1 + t(1 − t): open at both ends, closed from 0.1127 to 0.8873.
        let cubic = Cubic::new(-0.1, 1.0, -0.1, -1.0, 1.0);
        let touch = cubic.first_crossing(Crossing::Upwards).expect("it closes");
        assert!((touch - (0.5 - 0.15_f64.sqrt())).abs() < 1e-15, "{touch}");
        let peak = cubic.peak(0.0, 1.0).expect("it turns");
        assert!((peak.value - 0.15).abs() < 1e-15 && (peak.at - 0.5).abs() < 1e-7);
    }

    #[test]
    fn leaving_is_no_touch() {
        assert_eq!(
            Cubic::new(1e-15, -1.0, -0.5, -0.2, 1.0).first_crossing(Crossing::Upwards),
            None
        );
        assert_eq!(
            Cubic::new(-0.3, 0.0, -0.3, 0.0, 1.0).first_crossing(Crossing::Upwards),
            None
        );
    }
}
