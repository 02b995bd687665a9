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

use super::backbone::{Backbone, Corners, Quantity, Side, SpringFault};
use super::memory::{HysteresisMemory, Response};
use super::rule::{Hysteresis, HysteresisRule};

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

impl Hysteresis {
    /// A fibre of concrete that bears compression alone: its strength \[N\], the compression at it \[m\], and how it falls beyond. It
    /// starts with the slope 2 strength / compression.
    ///
    /// # Errors
    /// Numbers that are not positive, or a fall out of range.
    pub fn concrete(
        strength: f64,
        compression: f64,
        fall: ConcreteFall,
    ) -> Result<Self, Vec<SpringFault>> {
        // Two chords replace the parabola: through the point at half of the strength, with the initial slope.
        let corners = Corners {
            cracking: 0.5 * strength,
            yielding: strength,
            post_cracking: 1.0 / 3.0,
            post_yield: 0.0,
        };
        let initial = 2.0 * strength / compression;
        let backbone = Backbone::from_forces(initial, corners, corners)?.without_tension();
        match fall.fault() {
            None => Ok(Self {
                rule: HysteresisRule::Concrete(fall),
                backbone,
            }),
            Some(problem) => Err(vec![SpringFault {
                quantity: Quantity::Rule,
                side: None,
                problem,
            }]),
        }
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
        let trapezium =
            |[from, low]: [f64; 2], to: f64, high: f64| 0.5 * (low + high) * (to - from);
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
        let sum = inner * (inner + 1.0) / n
            - inner * (inner + 1.0) * (2.0 * inner + 1.0) / (6.0 * n * n)
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

/// Force and slope at a trial deformation.
#[inline]
pub(super) fn answer(
    backbone: &Backbone,
    fall: &ConcreteFall,
    memory: &HysteresisMemory,
    deformation: f64,
) -> [f64; 2] {
    let fibre = Fibre::new(backbone, fall);
    let (known, to) = (greatest(memory), -deformation);
    let closing = deformation < memory.deformation;
    // Where it stands on a corner, the line ahead counts.
    if to > known || to == known && closing {
        let [force, slope] = fibre.first_loading(to);
        return [-force, slope];
    }
    let line = fibre.unloading(known);
    if to > line.zero || to == line.zero && closing {
        return [-line.slope * (to - line.zero), line.slope];
    }
    [0.0, 0.0]
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
    let mut work = on_line(to) - on_line(from);
    if to > known {
        work += fibre.work_of_loading(to) - fibre.work_of_loading(known);
    }
    let [force, tangent] = answer(backbone, fall, memory, deformation);
    Response {
        force,
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

#[cfg(test)]
mod tests {
    use super::*;

    const FALL: ConcreteFall = ConcreteFall {
        residual: 0.2,
        ultimate: 6.0,
    };
    /// 30 MPa, 0.002, over an area and a length of one.
    const STRENGTH: f64 = 30e6;
    const PEAK: f64 = 0.002;

    fn fibre() -> Hysteresis {
        Hysteresis::concrete(STRENGTH, PEAK, FALL).expect("sound")
    }

    /// Concrete01 of OpenSees as its manual describes it, written anew: strains and stresses are positive in compression.
    struct Manual {
        greatest: f64,
    }

    impl Manual {
        fn envelope(strain: f64) -> f64 {
            let (residual, ultimate) = (0.2 * STRENGTH, 6.0 * PEAK);
            if strain <= PEAK {
                STRENGTH * (2.0 * strain / PEAK - (strain / PEAK).powi(2))
            } else if strain <= ultimate {
                STRENGTH + (residual - STRENGTH) / (ultimate - PEAK) * (strain - PEAK)
            } else {
                residual
            }
        }

        fn stress(&mut self, strain: f64) -> f64 {
            if strain >= self.greatest {
                self.greatest = strain;
                return Self::envelope(strain.max(0.0));
            }
            let eta = self.greatest.min(6.0 * PEAK) / PEAK;
            let stays = PEAK
                * if eta < 2.0 {
                    0.145 * eta * eta + 0.13 * eta
                } else {
                    0.707 * (eta - 2.0) + 0.834
                };
            let top = Self::envelope(self.greatest);
            let elastic = self.greatest - top * PEAK / (2.0 * STRENGTH);
            let zero = stays.min(elastic);
            if strain <= zero {
                0.0
            } else {
                top * (strain - zero) / (self.greatest - zero)
            }
        }
    }

    /// The polygon lies within 2·10⁻⁴ of the strength of the manual's curve on a cyclic path that cracks, crushes and falls to the residual
    /// strength, in parts of any length.
    #[test]
    fn follows_the_manual_of_concrete01() {
        let fibre = fibre();
        let (mut memory, mut manual) = (HysteresisMemory::default(), Manual { greatest: 0.0 });
        let (mut worst, mut crushed): (f64, f64) = (0.0, 0.0);
        for i in 0..20_000 {
            let x = f64::from(i);
            let strain = 7e-7 * x * (0.01 * x).sin() + 1e-4 * (0.37 * x).sin();
            memory = fibre.respond(&memory, -strain).memory;
            let apart = (-memory.force() - manual.stress(strain)).abs();
            worst = worst.max(apart / STRENGTH);
            crushed = crushed.max(strain);
        }
        assert!(
            crushed > 6.0 * PEAK,
            "it never lost its strength: {crushed}"
        );
        assert!(worst < 2e-4, "{worst:e} of the strength apart");
    }

    /// Work is the integral of the force, whether the way is taken at once or in small parts.
    #[test]
    fn work_is_the_area_under_the_force() {
        let fibre = fibre();
        let turns = [
            0.0, -0.0011, -0.0003, -0.0031, 0.001, -0.0009, -0.02, 0.0, -0.021,
        ];
        let (mut once, mut sum_once) = (HysteresisMemory::default(), 0.0);
        let (mut parts, mut sum_parts) = (HysteresisMemory::default(), 0.0);
        for ends in turns.windows(2) {
            let whole = fibre.respond(&once, ends[1]);
            sum_once += whole.work;
            once = whole.memory;
            let count = 20_000;
            for part in 1..=count {
                let share = f64::from(part) / f64::from(count);
                let to = (1.0 - share) * ends[0] + share * ends[1];
                let before = parts.force();
                let change = to - parts.deformation();
                let response = fibre.respond(&parts, to);
                parts = response.memory;
                sum_parts += 0.5 * (before + parts.force()) * change;
            }
            assert_eq!(once, parts, "to {}", ends[1]);
            let close = 1e-6 * STRENGTH * PEAK;
            assert!(
                (sum_once - sum_parts).abs() < close,
                "{sum_once} {sum_parts}"
            );
        }
        let dissipated = sum_once - fibre.recoverable_energy(&once);
        assert!(dissipated > 0.0);
    }

    /// Between two corners the force is a straight line, and its slope changes at each.
    #[test]
    fn corners_bound_straight_lines() {
        let fibre = fibre();
        let mut memory = HysteresisMemory::default();
        let mut corners = 0;
        for turn in [-0.0017, 0.001, -0.013, -0.004, 0.0005, -0.014] {
            let towards = Side::from_change(turn - memory.deformation());
            loop {
                let corner = fibre.next_corner(&memory, towards);
                let end = match towards {
                    Side::Positive => corner.min(turn),
                    Side::Negative => corner.max(turn),
                };
                let here = memory;
                let middle = fibre.respond(&here, 0.5 * (here.deformation() + end));
                memory = fibre.respond(&here, end).memory;
                let expected = 0.5 * (here.force() + memory.force());
                assert!(
                    (middle.force - expected).abs() < 1e-9 * STRENGTH,
                    "towards {end}"
                );
                if end == turn {
                    break;
                }
                corners += 1;
            }
        }
        assert!(corners > CHORDS, "{corners}");
    }
}
