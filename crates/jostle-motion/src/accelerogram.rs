//! One horizontal component of ground acceleration at equal steps.

use crate::MotionFault;

/// Standard acceleration of gravity \[m/s²\].
pub const STANDARD_GRAVITY: f64 = 9.806_65;

/// Ground acceleration at `0, step, 2·step, …`, with straight lines between the values.
///
/// Every value is finite and there are at least two of them; everything computed in this crate takes the
/// straight lines at their word.
#[derive(Clone, Debug, PartialEq)]
pub struct Accelerogram {
    step: f64,
    acceleration: Vec<f64>,
}

impl Accelerogram {
    /// A motion from its step, > 0 \[s\], and at least two finite values \[m/s²\].
    ///
    /// # Errors
    /// [`MotionFault`] when the step, the number of values or a value is not usable.
    pub fn new(step: f64, acceleration: Vec<f64>) -> Result<Self, MotionFault> {
        if !(step.is_finite() && step > 0.0) {
            return Err(MotionFault::Step { step });
        }
        if acceleration.len() < 2 {
            return Err(MotionFault::TooFew {
                found: acceleration.len(),
            });
        }
        if let Some(index) = acceleration.iter().position(|a| !a.is_finite()) {
            return Err(MotionFault::NotFinite { index });
        }
        Ok(Self { step, acceleration })
    }

    /// The same step with other values, which stay finite as those before were: for operations inside the crate.
    pub(crate) fn with(&self, acceleration: Vec<f64>) -> Result<Self, MotionFault> {
        Self::new(self.step, acceleration)
    }

    /// Time step \[s\].
    #[must_use]
    pub fn step(&self) -> f64 {
        self.step
    }

    /// Ground acceleration \[m/s²\].
    #[must_use]
    pub fn acceleration(&self) -> &[f64] {
        &self.acceleration
    }

    /// The values, given away \[m/s²\].
    #[must_use]
    pub fn into_acceleration(self) -> Vec<f64> {
        self.acceleration
    }

    /// Number of values, at least two.
    #[must_use]
    pub fn points(&self) -> usize {
        self.acceleration.len()
    }

    /// Time of the last value \[s\].
    #[must_use]
    pub fn duration(&self) -> f64 {
        self.step * (self.points() - 1) as f64
    }

    /// Peak ground acceleration, ≥ 0 \[m/s²\].
    #[must_use]
    pub fn peak(&self) -> f64 {
        self.acceleration
            .iter()
            .fold(0.0, |peak: f64, a| peak.max(a.abs()))
    }
}

/// Most values of a motion.
pub(crate) const MOST_POINTS: usize = 1 << 24;

/// Refuses motions with too many points.
pub(crate) fn check_points(points: f64) -> Result<(), MotionFault> {
    if points <= MOST_POINTS as f64 {
        Ok(())
    } else {
        Err(MotionFault::TooMany {
            points: points as usize,
            most: MOST_POINTS,
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn unusable_motions_are_refused() {
        for (step, values) in [
            (0.0, vec![0.0, 1.0]),
            (f64::NAN, vec![0.0, 1.0]),
            (0.01, vec![0.0]),
            (0.01, vec![0.0, f64::INFINITY]),
        ] {
            assert!(Accelerogram::new(step, values).is_err(), "step {step}");
        }
    }
}
