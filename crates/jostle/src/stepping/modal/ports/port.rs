//! A contact as a port: its law along the path of a step, touch and release within it, and the moments of its force.

use super::influence::Moments;
use super::path::{Path, bisect};
use crate::contact::{ForceLaw, Memory};

/// Closed pieces of a contact within one step.
pub(super) const MOST_PIECES: usize = 4;

/// Gauss' rule of eight points on [0, 1].
const GAUSS: [(f64, f64); 8] = [
    (0.019_855_071_751_231_88, 0.050_614_268_145_188_13),
    (0.101_666_761_293_186_64, 0.111_190_517_226_687_24),
    (0.237_233_795_041_835_5, 0.156_853_322_938_943_64),
    (0.408_282_678_752_175_1, 0.181_341_891_689_181),
    (0.591_717_321_247_825, 0.181_341_891_689_181),
    (0.762_766_204_958_164_5, 0.156_853_322_938_943_64),
    (0.898_333_238_706_813_4, 0.111_190_517_226_687_24),
    (0.980_144_928_248_768_1, 0.050_614_268_145_188_13),
];
/// Samples between which corners of the force are sought, and peaks.
const SAMPLES: u32 = 24;

/// A stretch of a step over which a contact is closed.
#[derive(Clone, Copy, Debug)]
pub(super) struct Piece {
    pub(super) from: f64,
    pub(super) to: f64,
    /// Whether it begins with a touch, and whether it ends with a release.
    pub(super) touches: bool,
    pub(super) releases: bool,
    pub(super) path: Path,
    pub(super) memory: Memory,
    /// Memory at its end.
    pub(super) after: Memory,
    /// ∫ F dx \[N\].
    pub(super) mean: f64,
}

/// A contact within an iteration over a step.
#[derive(Clone, Debug)]
pub(super) struct Port {
    pub(super) law: ForceLaw,
    /// Whether it is closed, with what memory and force, at the start of the step.
    pub(super) closed: Option<Memory>,
    pub(super) force: f64,
    /// Closing, its rate and acceleration at the start.
    pub(super) start: [f64; 3],
    /// What the iteration has found.
    pub(super) moments: Moments,
    pub(super) end_force: f64,
    pub(super) end_closed: Option<Memory>,
    pub(super) pieces: [Option<Piece>; MOST_PIECES],
    /// Whether it would touch again after the last piece that fits.
    pub(super) overflows: bool,
    /// The path while open.
    pub(super) open: Path,
}

impl Port {
    pub(super) fn new(law: ForceLaw) -> Self {
        Self {
            law,
            closed: None,
            force: 0.0,
            start: [0.0; 3],
            moments: [0.0; 3],
            end_force: 0.0,
            end_closed: None,
            pieces: [None; MOST_PIECES],
            overflows: false,
            open: Path::default(),
        }
    }

    /// The first guess: the force stays.
    pub(super) fn begin(&mut self) {
        self.moments = [self.force, 0.0, 0.0];
        self.end_force = self.force;
    }

    /// Nothing touches over the step.
    pub(super) fn follow_nothing(&mut self) {
        self.moments = [0.0; 3];
        self.pieces = [None; MOST_PIECES];
        self.overflows = false;
        self.end_closed = None;
        self.end_force = 0.0;
    }

    /// Finds pieces, moments and the force at the end, from the motion at the end of a step of length `step` with the forces
    /// of before, `self_motion` what its moments are of it, and `lightness` its acceleration by a unit force \[1/kg\].
    pub(super) fn follow(
        &mut self,
        step: f64,
        end: [f64; 3],
        self_motion: [f64; 3],
        lightness: f64,
    ) {
        let without = [
            end[0] - self_motion[0],
            end[1] - self_motion[1],
            end[2] - self_motion[2],
        ];
        self.open = Path::between(0.0, step, self.start, without);
        self.pieces = [None; MOST_PIECES];
        self.overflows = false;
        self.end_closed = None;
        self.end_force = 0.0;
        let mut next = match self.closed {
            Some(memory) => Some(Piece {
                from: 0.0,
                to: 1.0,
                touches: false,
                releases: false,
                path: Path::between(0.0, step, self.start, end),
                memory,
                after: memory,
                mean: 0.0,
            }),
            None if self.start[0] >= 0.0 && self.start[1] > 0.0 => {
                Some(self.touch(0.0, &self.open, step, end, lightness))
            }
            None => self
                .open
                .crossing(0.0, 1.0)
                .filter(|at| *at < 1.0)
                .map(|at| self.touch(at, &self.open, step, end, lightness)),
        };
        let mut sums = [0.0; 3];
        for index in 0..=MOST_PIECES {
            let Some(mut piece) = next.take() else { break };
            if index == MOST_PIECES {
                self.overflows = true;
                break;
            }
            let release = piece.path.crossing(piece.from, -1.0);
            if let Some(at) = release.filter(|at| *at < 1.0) {
                piece.to = at;
                piece.releases = true;
            }
            self.sum_up(&mut piece, &mut sums);
            if piece.releases {
                next = self.touch_again(&piece, step, end, lightness);
            } else {
                self.end_force = self.law.follow(end[0], end[1], &piece.after).force;
                self.law.remember(end[0], end[1], &mut piece.after);
                self.end_closed = Some(piece.after);
            }
            self.pieces[index] = Some(piece);
        }
        for (k, sum) in sums.iter().enumerate() {
            self.moments[k] = (2 * k + 1) as f64 * sum;
        }
    }

    /// A piece that begins where a path closes.
    fn touch(&self, at: f64, path: &Path, step: f64, end: [f64; 3], lightness: f64) -> Piece {
        let rate = path.rate(at).max(0.0);
        let memory = self.law.touch(rate);
        let start = [0.0, rate, path.bend(at) - lightness * self.law.onset(rate)];
        Piece {
            from: at,
            to: 1.0,
            touches: true,
            releases: false,
            path: Path::between(at, step, start, end),
            memory,
            after: memory,
            mean: 0.0,
        }
    }

    /// The next piece, where the contact touches again after a release within the step: along its flight without force, which,
    /// if it does not close but the step ends closed, leads to that end.
    fn touch_again(
        &self,
        released: &Piece,
        step: f64,
        end: [f64; 3],
        lightness: f64,
    ) -> Option<Piece> {
        let at = released.to;
        let rate = released.path.rate(at);
        let last = self
            .law
            .follow(f64::MIN_POSITIVE, rate, &released.after)
            .force;
        let bend = released.path.bend(at) + lightness * last;
        let jerk = self.open.jerk(at);
        let left = step * (1.0 - at);
        let flight_end = [
            left * (rate + left * (0.5 * bend + left * jerk / 6.0)),
            rate + left * (bend + 0.5 * left * jerk),
            bend + left * jerk,
        ];
        let start = [0.0, rate, bend];
        let after = at + 1e-6 * (1.0 - at);
        let mut flight = Path::between(at, step, start, flight_end);
        let mut touch = flight.crossing(after, 1.0);
        if touch.is_none() && end[0] > 0.0 {
            flight = Path::between(at, step, start, end);
            touch = flight.crossing(after, 1.0);
        }
        let touch = touch.filter(|at| *at < 1.0)?;
        Some(self.touch(touch, &flight, step, end, lightness))
    }

    /// Adds ∫ F P_k dx of a piece, in parts between corners of its force.
    fn sum_up(&self, piece: &mut Piece, sums: &mut [f64; 3]) {
        let mut memory = piece.memory;
        let mut from = piece.from;
        let mut bent = piece.touches;
        while from < piece.to {
            let to = self.corner(piece, from, &memory).unwrap_or(piece.to);
            let power = match (bent, self.law.starts_steeply()) {
                (false, _) => 1,
                (true, false) => 2,
                (true, true) => 4,
            };
            for (at, weight) in GAUSS {
                let share = match power {
                    1 => at,
                    2 => at * at,
                    _ => at * at * at * at,
                };
                let x = from + (to - from) * share;
                let stretch = f64::from(power) * share / at;
                let [value, rate] = [piece.path.value(x), piece.path.rate(x)];
                let force = self.law.follow(value, rate, &memory).force;
                self.law.remember(value, rate, &mut memory);
                let part = weight * stretch * (to - from) * force;
                let y = 2.0 * x - 1.0;
                piece.mean += part;
                sums[0] += part;
                sums[1] += part * y;
                sums[2] += part * 0.5 * (3.0 * y * y - 1.0);
            }
            (from, bent) = (to, false);
        }
        piece.after = memory;
    }

    /// Where the slope of the force jumps within a piece after `from`: where the motion turns, or where the force is cut.
    fn corner(&self, piece: &Piece, from: f64, memory: &Memory) -> Option<f64> {
        let (turn, cut) = (
            self.law.has_corner_at_turn(),
            self.law.has_corner_at_release(),
        );
        if !(turn || cut) {
            return None;
        }
        let pushes = |x: f64| {
            self.law
                .follow(piece.path.value(x), piece.path.rate(x), memory)
                .force
                > 0.0
        };
        let width = piece.to - from;
        // What lies within rounding of the start is the corner just found.
        let mut before = from + 1e-9 * width;
        for part in 1..SAMPLES {
            let x = from + width * f64::from(part) / f64::from(SAMPLES);
            if turn && piece.path.rate(before) > 0.0 && piece.path.rate(x) <= 0.0 {
                return Some(bisect(before, x, |at| piece.path.rate(at) <= 0.0));
            }
            if cut && pushes(before) && !pushes(x) {
                return Some(bisect(before, x, |at| !pushes(at)));
            }
            before = x;
        }
        None
    }

    /// Greatest force over a piece \[N\].
    pub(super) fn greatest(&self, piece: &Piece) -> f64 {
        let width = piece.to - piece.from;
        let mut memory = piece.memory;
        let mut at_samples = [0.0_f64; SAMPLES as usize + 1];
        let (mut top, mut kept) = (f64::NEG_INFINITY, memory);
        for (index, sample) in at_samples.iter_mut().enumerate() {
            let x = piece.from + width * index as f64 / f64::from(SAMPLES);
            let [value, rate] = [piece.path.value(x), piece.path.rate(x)];
            let value = value.max(f64::MIN_POSITIVE);
            *sample = self.law.follow(value, rate, &memory).force;
            self.law.remember(value, rate, &mut memory);
            if *sample > top {
                (top, kept) = (*sample, memory);
            }
        }
        let place = at_samples.iter().position(|force| *force == top);
        let Some(place) = place.filter(|place| *place > 0 && *place < SAMPLES as usize) else {
            return top;
        };
        // Thirds of the samples on either side.
        let share = |index: f64| piece.from + width * index / f64::from(SAMPLES);
        let (mut low, mut high) = (share(place as f64 - 1.0), share(place as f64 + 1.0));
        let force = |x: f64| {
            self.law
                .follow(piece.path.value(x), piece.path.rate(x), &kept)
                .force
        };
        for _ in 0..60 {
            let third = (high - low) / 3.0;
            if force(low + third) < force(high - third) {
                low += third;
            } else {
                high -= third;
            }
        }
        top.max(force(0.5 * (low + high)))
    }
}
