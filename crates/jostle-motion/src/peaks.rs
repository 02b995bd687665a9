//! Peaks of many oscillators at once, between samples too.
//!
//! Steps longer than a tenth of the period are divided. One pass of [`crate::lanes`] stores, for every block of
//! steps, the state at its beginning and the largest magnitudes at the ends of the divided steps. The excess
//! between these ends is bounded by h²/8 times the largest second derivative; only blocks whose largest value comes
//! within this bound of the largest of all are walked again, and there every change of sign of the derivative is
//! located in the exact solution by Newton's method.

use crate::Accelerogram;
use crate::lanes::{BLOCK, BlockPeaks, Lanes, advance_all};
use crate::oscillator::{Advance, Oscillator, State};

/// An extreme value with its sign, and when it is reached.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Extreme {
    /// The value of greatest magnitude \[m/s²\].
    pub value: f64,
    /// When it is reached \[s\].
    pub at: f64,
}

/// Extremes of one oscillator within the record.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Response {
    /// `ω² u`, u relative to the ground \[m/s²\].
    pub pseudo_acceleration: Extreme,
    /// `−(ω² u + 2ζω u̇)`, the acceleration including the ground \[m/s²\].
    pub total_acceleration: Extreme,
}

/// Steps per period in which extremes are looked for between the ends.
const STEPS_PER_PERIOD: f64 = 10.0;
/// Steps per period whose ends are taken for the extremes.
const READ_STEPS_PER_PERIOD: f64 = 20.0;

/// Extreme responses of oscillators at rest when the motion begins, exact for its straight lines.
///
/// Damping ratios must lie in `0..1`. A period of 0 is the rigid oscillator.
#[must_use]
pub fn peak_responses(motion: &Accelerogram, oscillators: &[Oscillator]) -> Vec<Response> {
    let ground = Ground::from_motion(motion);
    let mut responses = vec![ground.rigid(); oscillators.len()];
    advance_all(
        motion,
        oscillators,
        STEPS_PER_PERIOD,
        |i, lane, lanes, blocks| {
            responses[i] = blocks.refine(lanes, lane, motion, &ground);
        },
    );
    responses
}

/// Largest magnitudes of pseudo- and total acceleration at the ends of steps, at least twenty per period.
pub(crate) fn peaks_at_steps(motion: &Accelerogram, oscillators: &[Oscillator]) -> Vec<[f64; 2]> {
    let mut peaks = vec![[motion.peak(); 2]; oscillators.len()];
    advance_all(
        motion,
        oscillators,
        READ_STEPS_PER_PERIOD,
        |i, lane, _, blocks| {
            peaks[i] = blocks.largest(lane);
        },
    );
    peaks
}

/// Properties of the ground motion for the bounds.
struct Ground {
    peak: Extreme,
    /// Largest change in one step \[m/s²\].
    change: f64,
}

impl Ground {
    fn from_motion(motion: &Accelerogram) -> Self {
        let mut peak = Extreme::default();
        for (i, &a) in motion.acceleration().iter().enumerate() {
            peak.raise(a, || motion.step() * i as f64);
        }
        let pairs = motion.acceleration().windows(2);
        Self {
            peak,
            change: pairs.fold(0.0, |most: f64, pair| most.max((pair[1] - pair[0]).abs())),
        }
    }

    fn rigid(&self) -> Response {
        let Extreme { value, at } = self.peak;
        Response {
            pseudo_acceleration: Extreme { value: -value, at },
            total_acceleration: self.peak,
        }
    }
}

impl Extreme {
    fn raise(&mut self, value: f64, at: impl FnOnce() -> f64) {
        if value.abs() > self.value.abs() {
            *self = Self { value, at: at() };
        }
    }
}

impl BlockPeaks {
    /// The extremes of one lane, between the ends of cut steps too.
    fn refine(
        &self,
        lanes: &Lanes,
        lane: usize,
        motion: &Accelerogram,
        ground: &Ground,
    ) -> Response {
        let [pseudo, total] = self.largest(lane);
        let [below_pseudo, below_total] = between(lanes, lane, [pseudo, total], ground);
        let mut response = Response::default();
        let part = Part {
            lane,
            theta: lanes.theta[lane],
            z2: lanes.z2[lane],
            enough: [pseudo - below_pseudo, total - below_total],
        };
        for (index, block) in self.blocks.iter().enumerate() {
            if block.pseudo[lane] >= part.enough[0] || block.total[lane] >= part.enough[1] {
                let start = State {
                    x: block.x[lane],
                    v: block.v[lane],
                };
                walk_again(lanes, &part, motion, index * BLOCK, start, &mut response);
            }
        }
        response
    }
}

/// How far an extreme can lie above the values at the ends of its part: `θ²/8 max|d²/dθ²|`, by Eq. (2) of the
/// oscillator and with a tenth added to magnitudes that are themselves known at ends only.
fn between(lanes: &Lanes, lane: usize, [pseudo, total]: [f64; 2], ground: &Ground) -> [f64; 2] {
    let (theta, z2) = (lanes.theta[lane], lanes.z2[lane]);
    let peak = ground.peak.value.abs();
    let sigma = ground.change / (lanes.parts as f64 * theta);
    // |x + 2ζv| = |total − ground|, and |2ζv| = |total − pseudo|.
    let curvature = 1.1 * total + peak;
    let of_total = (1.0 - z2 * z2).abs() * curvature + 1.1 * (total + pseudo) + z2 * sigma;
    [curvature, of_total].map(|second| theta * theta / 8.0 * second)
}

/// Walks a block again and locates the extremes in its parts.
fn walk_again(
    lanes: &Lanes,
    part: &Part,
    motion: &Accelerogram,
    first: usize,
    start: State,
    response: &mut Response,
) {
    let lane = part.lane;
    let values = motion.acceleration();
    let last = (first + BLOCK).min(values.len() - 1);
    let length = motion.step() / lanes.parts as f64;
    let mut state = start;
    for (offset, pair) in values[first..=last].windows(2).enumerate() {
        let change = (pair[1] - pair[0]) / lanes.parts as f64;
        for step in 0..lanes.parts {
            let a0 = pair[0] + step as f64 * change;
            let next = State {
                x: lanes.a[lane] * state.x + lanes.b[lane] * state.v + lanes.p[lane] * change,
                v: lanes.d[lane] * state.v - lanes.b[lane] * state.x + lanes.q[lane] * change,
            };
            let begin = motion.step() * (first + offset) as f64 + length * step as f64;
            let mut consider = |state: State, a: f64, share: f64| {
                let at = || begin + share * length;
                let [pseudo, total] = part.values(state, a);
                response.pseudo_acceleration.raise(pseudo, at);
                response.total_acceleration.raise(total, at);
            };
            consider(next, a0 + change, 1.0);
            let (from, to) = (part.values(state, a0), part.values(next, a0 + change));
            for (which, slope) in [Part::pseudo_slope, Part::total_slope]
                .into_iter()
                .enumerate()
            {
                let high = from[which].abs().max(to[which].abs()) >= part.enough[which];
                if high && slope(part, state) * slope(part, next) < 0.0 {
                    let (share, there) = part.turning(state, next, change, slope);
                    consider(there, a0 + share * change, share);
                }
            }
            state = next;
        }
    }
}

/// One cut step of one oscillator.
struct Part {
    lane: usize,
    theta: f64,
    z2: f64,
    /// Magnitudes of [`Part::values`] near which the overall extreme may lie.
    enough: [f64; 2],
}

impl Part {
    /// Pseudo-acceleration and total acceleration.
    fn values(&self, state: State, ground: f64) -> [f64; 2] {
        let pseudo = state.x - ground;
        [pseudo, -(pseudo + self.z2 * state.v)]
    }

    /// d(ω²u)/dθ.
    fn pseudo_slope(&self, state: State) -> f64 {
        state.v
    }

    /// d(ω²u + 2ζωu̇)/dθ.
    fn total_slope(&self, state: State) -> f64 {
        state.v - self.z2 * (state.x + self.z2 * state.v)
    }

    /// Where a slope vanishes, as a share of the part, and the state there.
    fn turning(
        &self,
        start: State,
        end: State,
        change: f64,
        slope: fn(&Self, State) -> f64,
    ) -> (f64, State) {
        let sigma = change / self.theta;
        let (mut low, mut high) = (0.0, 1.0);
        let (at_start, at_end) = (slope(self, start), slope(self, end));
        let mut share = at_start / (at_start - at_end);
        let mut there = start;
        for _ in 0..12 {
            there = Advance::over(share * self.theta, 0.5 * self.z2).apply(start, sigma);
            let value = slope(self, there);
            if value * at_start > 0.0 {
                low = share;
            } else {
                high = share;
            }
            // The slopes are linear in the state, so their rates are the slopes of the rate of the state.
            let rate = State {
                x: there.v + sigma,
                v: -there.x - self.z2 * there.v,
            };
            let newton = share - value / (slope(self, rate) * self.theta);
            // The value has no slope here: an error of the place counts by its square.
            if (newton - share).abs() < 1e-10 {
                break;
            }
            share = if newton > low && newton < high {
                newton
            } else {
                0.5 * (low + high)
            };
        }
        (share, there)
    }
}
