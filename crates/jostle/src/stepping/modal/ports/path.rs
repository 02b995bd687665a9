//! The path of a contact over a part of a step: the quintic through displacement, rate and acceleration of both ends.

/// Parts in which crossings are sought.
const PARTS: u32 = 8;
/// Bisections: all bits of a share of a step.
const BISECTIONS: u32 = 52;

/// Closing over the part [x₀, 1] of a step, x its share of the step \[m\].
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Path {
    /// Coefficients in y = (x − x₀)/(1 − x₀).
    coefficients: [f64; 6],
    from: f64,
    /// Length of the part \[s\].
    length: f64,
}

impl Path {
    /// Through value, rate and second derivative at `from` and at the end of a step of length `step` \[s\].
    pub(super) fn between(from: f64, step: f64, start: [f64; 3], end: [f64; 3]) -> Self {
        let length = step * (1.0 - from);
        let [c0, c1, c2] = [
            start[0],
            start[1] * length,
            0.5 * start[2] * length * length,
        ];
        let value = end[0] - c0 - c1 - c2;
        let rate = end[1] * length - c1 - 2.0 * c2;
        let bend = end[2] * length * length - 2.0 * c2;
        Self {
            coefficients: [
                c0,
                c1,
                c2,
                10.0 * value - 4.0 * rate + 0.5 * bend,
                -15.0 * value + 7.0 * rate - bend,
                6.0 * value - 3.0 * rate + 0.5 * bend,
            ],
            from,
            length,
        }
    }

    fn local(&self, x: f64) -> f64 {
        (x - self.from) / (1.0 - self.from)
    }

    pub(super) fn value(&self, x: f64) -> f64 {
        let (c, y) = (&self.coefficients, self.local(x));
        c[0] + y * (c[1] + y * (c[2] + y * (c[3] + y * (c[4] + y * c[5]))))
    }

    /// \[m/s\].
    pub(super) fn rate(&self, x: f64) -> f64 {
        let (c, y) = (&self.coefficients, self.local(x));
        let sum = c[1] + y * (2.0 * c[2] + y * (3.0 * c[3] + y * (4.0 * c[4] + y * 5.0 * c[5])));
        sum / self.length
    }

    /// \[m/s²\].
    pub(super) fn bend(&self, x: f64) -> f64 {
        let (c, y) = (&self.coefficients, self.local(x));
        let sum = 2.0 * c[2] + y * (6.0 * c[3] + y * (12.0 * c[4] + y * 20.0 * c[5]));
        sum / (self.length * self.length)
    }

    /// Third derivative \[m/s³\].
    pub(super) fn jerk(&self, x: f64) -> f64 {
        let (c, y) = (&self.coefficients, self.local(x));
        let sum = 6.0 * c[3] + y * (24.0 * c[4] + y * 60.0 * c[5]);
        sum / (self.length * self.length * self.length)
    }

    /// The first crossing of zero after `after`, upwards with `sign` 1, downwards with −1. A part whose ends lie on one side
    /// is looked into where its slope turns.
    pub(super) fn crossing(&self, after: f64, sign: f64) -> Option<f64> {
        let (mut before, mut height) = (after, sign * self.value(after));
        for part in 1..=PARTS {
            let mut x = after + (1.0 - after) * f64::from(part) / f64::from(PARTS);
            let mut here = sign * self.value(x);
            let mut crosses = here > 0.0 && (height <= 0.0 || part > 1);
            let turns = sign * self.rate(before) > 0.0 && sign * self.rate(x) < 0.0;
            if !crosses && here <= 0.0 && height <= 0.0 && turns {
                let top = bisect(before, x, |at| sign * self.rate(at) <= 0.0);
                if sign * self.value(top) > 0.0 {
                    (x, here, crosses) = (top, sign * self.value(top), true);
                }
            }
            if crosses {
                return Some(bisect(before, x, |at| sign * self.value(at) > 0.0));
            }
            (before, height) = (x, here);
        }
        None
    }
}

/// The instant from which `holds` is true, between one at which it is not and one at which it is.
pub(super) fn bisect(mut low: f64, mut high: f64, holds: impl Fn(f64) -> bool) -> f64 {
    for _ in 0..BISECTIONS {
        let middle = 0.5 * (low + high);
        if holds(middle) {
            high = middle;
        } else {
            low = middle;
        }
    }
    high
}
