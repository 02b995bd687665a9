//! Concrete in compression, without tension: a fibre of a section.
//!
//! The curve of first loading rises as a parabola to the strength at a strain ε₀, falls straight to a residual strength at an ultimate
//! strain, and stays there (Kent and Park, 1971; Scott, Park and Priestley, 1982). Unloading and reloading follow one straight
//! line from the greatest compression ε to a strain that stays (Karsan and Jirsa, 1969; OpenSees' `Concrete01`):
//!
//! ```text
//! εₚ / ε₀ = 0.145 η² + 0.13 η  (η < 2),  0.707 (η − 2) + 0.834  (beyond),  η = ε / ε₀
//! ```
//!
//! with a slope of at most E₀ = 2 f / ε₀; a crack opens there. The parabola is a polygon with [`CHORDS`] chords of equal work: all
//! springs have straight lines with exact corners.

use super::backbone::{Backbone, Side};
use super::memory::{HysteresisMemory, Response};

/// Chords of the parabola. They differ from it by 1/(6 n²) of the strength at most, less than 2·10⁻⁴.
const CHORDS: usize = 32;

/// How concrete falls beyond its strength.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ConcreteFall {
    /// Residual strength over strength, 0…1 \[–\].
    pub residual: f64,
    /// Ultimate strain over that at the strength, > 1 \[–\].
    pub ultimate: f64,
}

impl ConcreteFall {
    /// The first number out of range.
    pub(super) fn fault(&self) -> Option<String> {
        let Self { residual, ultimate } = *self;
        if !(0.0..=1.0).contains(&residual) {
            return Some(format!(
                "the residual strength must lie between 0 and the strength, found {residual} times the strength"
            ));
        }
        (!(ultimate > 1.0 && ultimate.is_finite())).then(|| {
            format!(
                "the ultimate strain must be greater than the strain at the strength, found {ultimate} times it"
            )
        })
    }
}

/// A fibre: compressions and forces are positive here.
struct Fibre {
    strength: f64,
    /// Compression at the strength.
    peak: f64,
    fall: ConcreteFall,
    /// E₀ A / L.
    initial: f64,
}

/// A straight line of force over compression.
#[derive(Clone, Copy)]
struct Line {
    /// Where it has no force.
    zero: f64,
    slope: f64,
}

impl Fibre {
    fn new(backbone: &Backbone, fall: &ConcreteFall) -> Self {
        let top = backbone.side(Side::Negative).yielding;
        Self {
            strength: top.force,
            peak: top.deformation,
            fall: *fall,
            initial: backbone.initial(),
        }
    }

    fn ultimate(&self) -> f64 {
        self.fall.ultimate * self.peak
    }

    /// Compression and force at a corner of the polygon.
    fn corner(&self, index: usize) -> [f64; 2] {
        let n = CHORDS as f64;
        let share = index as f64 / n;
        // As much work below the chords as below the parabola.
        let raised = if index == 0 || index == CHORDS {
            0.0
        } else {
            1.0 / (6.0 * n * n)
        };
        let force = self.strength * (share * (2.0 - share) + raised);
        [share * self.peak, force]
    }

    /// Number of the chord that goes on from a compression below that at the strength.
    fn chord(&self, compression: f64) -> usize {
        let guess = (compression / self.peak * CHORDS as f64) as usize;
        let mut chord = guess.min(CHORDS - 1);
        while chord > 0 && self.corner(chord)[0] > compression {
            chord -= 1;
        }
        while chord < CHORDS - 1 && self.corner(chord + 1)[0] <= compression {
            chord += 1;
        }
        chord
    }

    /// Force of first loading, and the slope that goes on from there.
    fn first_loading(&self, compression: f64) -> [f64; 2] {
        let residual = self.fall.residual * self.strength;
        if compression < self.peak {
            let chord = self.chord(compression);
            let [[from, low], [to, high]] = [self.corner(chord), self.corner(chord + 1)];
            let slope = (high - low) / (to - from);
            [low + slope * (compression - from), slope]
        } else if compression < self.ultimate() {
            let slope = (residual - self.strength) / (self.ultimate() - self.peak);
            [self.strength + slope * (compression - self.peak), slope]
        } else {
            [residual, 0.0]
        }
    }

    /// Work of first loading.
    fn work_of_loading(&self, compression: f64) -> f64 {
        let trapezium = |[from, low]: [f64; 2], to: f64, high: f64| 0.5 * (low + high) * (to - from);
        let force = self.first_loading(compression)[0];
        if compression < self.peak {
            let chord = self.chord(compression);
            let before = self.work_to_corner(chord);
            return before + trapezium(self.corner(chord), compression, force);
        }
        let rising = self.work_to_corner(CHORDS);
        let falling_to = compression.min(self.ultimate());
        let at = self.first_loading(falling_to)[0];
        rising
            + trapezium([self.peak, self.strength], falling_to, at)
            + self.fall.residual * self.strength * (compression - falling_to)
    }

    fn work_to_corner(&self, index: usize) -> f64 {
        let (n, i) = (CHORDS as f64, index as f64);
        // Forces of the inner corners, then half of the last one.
        let last = self.corner(index)[1];
        let inner = (i - 1.0).max(0.0);
        let sum = inner * (inner + 1.0) / n - inner * (inner + 1.0) * (2.0 * inner + 1.0) / (6.0 * n * n)
            + inner / (6.0 * n * n);
        self.peak / n * (self.strength * sum + 0.5 * last)
    }

    /// The line of unloading and reloading below the greatest compression so far.
    fn unloading(&self, greatest: f64) -> Line {
        let [force, _] = self.first_loading(greatest);
        let ratio = greatest.min(self.ultimate()) / self.peak;
        let stays = if ratio < 2.0 {
            (0.145 * ratio + 0.13) * ratio
        } else {
            0.707 * (ratio - 2.0) + 0.834
        };
        let zero = stays * self.peak;
        let slope = force / (greatest - zero);
        if greatest > zero && slope <= self.initial {
            return Line { zero, slope };
        }
        Line {
            zero: greatest - force / self.initial,
            slope: self.initial,
        }
    }
}

fn greatest(memory: &HysteresisMemory) -> f64 {
    memory.extremes[Side::Negative.index()]
}

pub(super) fn respond(
    backbone: &Backbone,
    fall: &ConcreteFall,
    memory: &HysteresisMemory,
    deformation: f64,
) -> Response {
    let fibre = Fibre::new(backbone, fall);
    let (known, from, to) = (greatest(memory), -memory.deformation, -deformation);
    let line = fibre.unloading(known);
    let on_line = |at: f64| {
        let beyond = (at.min(known) - line.zero).max(0.0);
        0.5 * line.slope * beyond * beyond
    };
    let closing = to > from;
    let mut work = on_line(to) - on_line(from);
    // Where it stands on a corner, the line ahead counts.
    let [force, tangent] = if to > known || to == known && closing {
        work += fibre.work_of_loading(to) - fibre.work_of_loading(known);
        fibre.first_loading(to)
    } else if to > line.zero || to == line.zero && closing {
        [line.slope * (to - line.zero), line.slope]
    } else {
        [0.0, 0.0]
    };
    Response {
        force: -force,
        tangent,
        work,
        memory: *memory,
    }
}

/// Deformation at the end of the line on which it moves to a side.
pub(super) fn next_corner(
    backbone: &Backbone,
    fall: &ConcreteFall,
    memory: &HysteresisMemory,
    towards: Side,
) -> f64 {
    let fibre = Fibre::new(backbone, fall);
    let (known, here) = (greatest(memory), -memory.deformation);
    let line = fibre.unloading(known);
    let corner = match towards {
        Side::Positive if here > line.zero => line.zero,
        Side::Positive => f64::NEG_INFINITY,
        Side::Negative if here < line.zero => line.zero,
        Side::Negative if here < known => known,
        Side::Negative if here < fibre.peak => fibre.corner(fibre.chord(here) + 1)[0],
        Side::Negative if here < fibre.ultimate() => fibre.ultimate(),
        Side::Negative => f64::INFINITY,
    };
    -corner
}

/// Slope of unloading; zero where a crack is open.
pub(super) fn unloading_stiffness(
    backbone: &Backbone,
    fall: &ConcreteFall,
    memory: &HysteresisMemory,
) -> f64 {
    if memory.force == 0.0 {
        return 0.0;
    }
    Fibre::new(backbone, fall).unloading(greatest(memory)).slope
}
