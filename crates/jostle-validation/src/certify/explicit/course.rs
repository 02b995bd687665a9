//! The course of one number over a step, from values, rates and their derivatives at both ends.

/// A polynomial of degree five; rates are a cubic of their own, which short steps do not spoil by rounding.
#[derive(Clone, Copy)]
pub(super) struct Course {
    value: [f64; 6],
    rate: [f64; 4],
    step: f64,
}

impl Course {
    pub(super) fn new([x0, v0, a0]: [f64; 3], [x1, v1, a1]: [f64; 3], h: f64) -> Self {
        let d = x1 - x0;
        let (p, q) = (h * v0, h * v1);
        let (r, s) = (h * h * a0, h * h * a1);
        let e = v1 - v0;
        Self {
            value: [
                x0,
                p,
                0.5 * r,
                10.0 * d - 6.0 * p - 4.0 * q - 1.5 * r + 0.5 * s,
                -15.0 * d + 8.0 * p + 7.0 * q + 1.5 * r - s,
                6.0 * d - 3.0 * (p + q) - 0.5 * r + 0.5 * s,
            ],
            rate: [
                v0,
                h * a0,
                3.0 * e - h * (2.0 * a0 + a1),
                h * (a0 + a1) - 2.0 * e,
            ],
            step: h,
        }
    }

    pub(super) fn value(&self, s: f64) -> f64 {
        self.value.iter().rev().fold(0.0, |sum, c| sum * s + c)
    }

    pub(super) fn rate(&self, s: f64) -> f64 {
        self.rate.iter().rev().fold(0.0, |sum, c| sum * s + c)
    }

    /// Derivative of the rate.
    pub(super) fn turn(&self, s: f64) -> f64 {
        let [_, a, b, c] = self.rate;
        if self.step > 0.0 {
            (a + s * (2.0 * b + s * 3.0 * c)) / self.step
        } else {
            0.0
        }
    }
}

/// Samples of a step in which events are looked for.
const PARTS: usize = 8;

/// The first share of a step from which on a function is below zero; 0 if it is so at once and `at_once` says that this counts.
pub(super) fn first_below(at_once: bool, function: impl Fn(f64) -> f64) -> Option<f64> {
    let mut before = function(0.0);
    for part in 1..=PARTS {
        let s = part as f64 / PARTS as f64;
        let now = function(s);
        if now < 0.0 {
            let (mut low, mut high) = ((part - 1) as f64 / PARTS as f64, s);
            if before < 0.0 || part == 1 && before <= 0.0 {
                return at_once.then_some(low);
            }
            for _ in 0..60 {
                let middle = 0.5 * (low + high);
                if function(middle) < 0.0 {
                    high = middle;
                } else {
                    low = middle;
                }
            }
            return Some(high);
        }
        before = now;
    }
    None
}

/// Greatest value of the quartic through five values at equal distances.
pub(super) fn top(y: &[f64; 5]) -> f64 {
    // Newton's form on 0, 1, 2, 3, 4.
    let d1: [f64; 4] = std::array::from_fn(|k| y[k + 1] - y[k]);
    let d2: [f64; 3] = std::array::from_fn(|k| d1[k + 1] - d1[k]);
    let d3: [f64; 2] = std::array::from_fn(|k| d2[k + 1] - d2[k]);
    let d4 = d3[1] - d3[0];
    let value = |t: f64| {
        y[0] + t
            * (d1[0] + (t - 1.0) / 2.0 * (d2[0] + (t - 2.0) / 3.0 * (d3[0] + (t - 3.0) / 4.0 * d4)))
    };
    let mut best = 0;
    for k in 1..5 {
        if y[k] > y[best] {
            best = k;
        }
    }
    let mut low = (best as f64 - 1.0).max(0.0);
    let mut high = (best as f64 + 1.0).min(4.0);
    // Golden section is enough: the error of the place counts squared.
    let golden = 0.618_033_988_749_894_9;
    for _ in 0..24 {
        let (a, b) = (high - golden * (high - low), low + golden * (high - low));
        if value(a) > value(b) {
            high = b;
        } else {
            low = a;
        }
    }
    value(0.5 * (low + high)).max(y[best])
}
