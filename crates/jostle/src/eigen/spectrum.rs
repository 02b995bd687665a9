//! Number of modes below a frequency, and the determinant that vanishes at each of them.

use crate::linear::{NotPositive, StepMatrix};
use crate::structure::AssembledBuilding;
use crate::structure::StepEquations;
use crate::transfer::riccati::{Inertia, RiccatiFactor, RiccatiSweep};

/// Magnification of rounding in the elimination above which a shift is moved away from the resonance that causes
/// it.
const TRUSTED_GROWTH: f64 = 1e4;

/// The Riccati recursion of K − ω²M of one building.
///
/// Its negative pivots are the modes below ω (Sylvester; theory, Eq. M3). This is the count of Wittrick and
/// Williams with their number of modes with all joints fixed, J₀, equal to zero: masses are at nodes only, and the
/// members between them are massless.
#[derive(Clone, Debug)]
pub struct Spectrum {
    pub(super) sweep: RiccatiSweep,
    pub(super) factor: RiccatiFactor,
}

impl Spectrum {
    /// Prepares a building.
    ///
    /// # Errors
    /// [`NotPositive`] when the building can move without deforming.
    pub fn new(building: &AssembledBuilding) -> Result<Self, NotPositive> {
        let sweep = RiccatiSweep::new(building);
        let mut factor = RiccatiFactor::default();
        sweep.factorize(
            &StepMatrix::STATIC,
            &building.equations.initial_tangents(),
            &mut factor,
        )?;
        Ok(Self { sweep, factor })
    }

    /// Number of modes with a circular frequency below this one \[rad/s\].
    ///
    /// If a part of the path resonates with its end fixed, a pivot vanishes. Its sign does not matter, but later
    /// pivots lose digits; the count is then made at a nearby frequency, at most 10⁻⁹ times the frequency away.
    #[must_use]
    pub fn below(&mut self, circular_frequency: f64) -> usize {
        let shift = circular_frequency * circular_frequency;
        let aside = (0..6).flat_map(|k| {
            let part = 1e-14 * 10_f64.powi(k);
            [1.0 - part, 1.0 + part]
        });
        let shifts = std::iter::once(1.0).chain(aside).map(|part| part * shift);
        self.count_at_best(shifts).1
    }

    /// The first reliable shift ω², or else the best of them, and the count there.
    pub(super) fn count_at_best(&mut self, shifts: impl Iterator<Item = f64>) -> (f64, usize) {
        let mut best = (0.0, 0, f64::INFINITY);
        for shift in shifts {
            let Inertia { negative, growth } = self.factorize(shift);
            if growth < best.2 {
                best = (shift, negative, growth);
            }
            if growth <= TRUSTED_GROWTH {
                break;
            }
        }
        (best.0, best.1)
    }

    pub(super) fn factorize(&mut self, shift: f64) -> Inertia {
        self.sweep.factorize_shifted(shift, &mut self.factor)
    }

    /// Determinant of K − ω²M at a circular frequency \[rad/s\]; see [`log_determinant`].
    #[must_use]
    pub fn log_determinant(&mut self, circular_frequency: f64) -> LogDeterminant {
        let negative = self
            .factorize(circular_frequency * circular_frequency)
            .negative;
        LogDeterminant {
            sign: if negative.is_multiple_of(2) {
                1.0
            } else {
                -1.0
            },
            logarithm: self
                .factor
                .pivots()
                .iter()
                .map(|d| libm::log(d.abs()))
                .sum(),
        }
    }
}

/// Number of modes of a building: its degrees of freedom with mass.
#[must_use]
pub fn number_of_modes(building: &AssembledBuilding) -> usize {
    let mass = &building.equations.mass;
    mass.iter().filter(|mass| **mass > 0.0).count()
}

/// A determinant too large or too small for a number.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct LogDeterminant {
    /// +1 or −1 \[–\].
    pub sign: f64,
    /// Natural logarithm of its magnitude \[–\].
    pub logarithm: f64,
}

/// Determinant of K − ω²M at a circular frequency \[rad/s\], the product of all Riccati pivots. Apart from a factor
/// that does not vanish it is the determinant of the total transfer equation without loads, whose zeros are the
/// natural frequencies.
///
/// Searching modes by its sign is unreliable:
/// - a double frequency does not change it, and a symmetric structure may have many;
/// - two modes between neighbouring samples are not visible for any spacing;
/// - its magnitude spans hundreds of decades, hence the logarithm.
///
/// [`Spectrum::below`] costs the same and has none of these problems; [`modes`](super::modes) builds on it.
///
/// # Errors
/// [`NotPositive`] when the building can move without deforming.
pub fn log_determinant(
    building: &AssembledBuilding,
    circular_frequency: f64,
) -> Result<LogDeterminant, NotPositive> {
    Ok(Spectrum::new(building)?.log_determinant(circular_frequency))
}
