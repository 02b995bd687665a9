//! Artificial motions: a seed and parameters in, the same bits out.

mod coherency;
mod envelope;
mod matching;
mod pulse;
mod random;
mod recipe;
mod sines;
mod stochastic;
mod wavelet;

pub use coherency::{Coherency, coherent_with};
pub use envelope::Envelope;
pub use matching::{MatchSettings, Matched, match_spectrum, misfit};
pub use pulse::{Makris, Mavroeidis, PulseShape, near_fault_pulse};
pub use recipe::{RECIPES, Recipe, recipe};
pub use sines::{SineSettings, sine_wave, spectrum_compatible};
pub use stochastic::{GroundFilter, StochasticSettings, stochastic};

use crate::accelerogram::check_points;
use crate::fault::{MotionFault, within};

/// Number of values of a motion of a duration, which must be at least ten steps \[s\].
pub(crate) fn points(step: f64, duration: f64) -> Result<usize, MotionFault> {
    if !(step.is_finite() && step > 0.0) {
        return Err(MotionFault::Step { step });
    }
    let steps = (duration / step).round();
    within(
        "the duration",
        "at or above ten steps",
        duration,
        steps >= 10.0,
    )?;
    check_points(steps + 1.0)?;
    Ok(steps as usize + 1)
}
