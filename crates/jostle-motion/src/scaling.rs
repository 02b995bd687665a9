//! Factors that scale a motion to a design spectrum.

use crate::Accelerogram;
use crate::fault::{MotionFault, within};
use crate::spectrum::{Reading, response_spectrum, spaced_periods};
use crate::target::TargetSpectrum;

/// Where a motion and a spectrum shall agree.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum MatchAt {
    /// At one period \[s\].
    Period(f64),
    /// On average between two periods, the first smaller, both > 0 \[s\]: the geometric mean over equal ratios of
    /// period.
    Range(f64, f64),
}

/// Periods of a range.
const POINTS: usize = 100;

/// The factor on a motion for which its pseudo-acceleration agrees with the target.
///
/// # Errors
/// [`MotionFault`] when a period or damping ratio is out of range, or the motion is zero throughout.
pub fn match_factor(
    motion: &Accelerogram,
    target: &TargetSpectrum,
    at: MatchAt,
    damping: f64,
) -> Result<f64, MotionFault> {
    let periods = match at {
        MatchAt::Period(period) => vec![period],
        MatchAt::Range(first, last) => {
            within("the shortest period", "above zero", first, first > 0.0)?;
            if first >= last {
                return Err(MotionFault::Order {
                    smaller: "the shortest period",
                    larger: "the longest",
                    found: [first, last],
                });
            }
            spaced_periods(first, last, POINTS)
        }
    };
    let spectrum = response_spectrum(motion, &periods, &[damping], Reading::Between)?;
    let mut sum = 0.0;
    for (value, &period) in spectrum.curves[0].pseudo_acceleration.iter().zip(&periods) {
        if *value == 0.0 {
            return Err(MotionFault::Zero);
        }
        sum += libm::log(target.acceleration(period, damping)? / value);
    }
    Ok(libm::exp(sum / periods.len() as f64))
}
