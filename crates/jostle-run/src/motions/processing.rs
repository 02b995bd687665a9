//! Steps from a recorded to a usable motion.

use jostle_motion::{Accelerogram, Butterworth, butterworth};

use super::wrong;
use crate::error::RunError;

/// What is done to a motion, in this order.
#[derive(Clone, Debug, PartialEq)]
pub struct Processing {
    /// Keep from this time on, ≥ 0 \[s\].
    pub from: Option<f64>,
    /// Keep until this time \[s\].
    pub to: Option<f64>,
    /// Subtract a polynomial of this degree fitted to the acceleration.
    pub detrend: Option<usize>,
    /// Subtract the derivative of a polynomial of this degree fitted to the velocity.
    pub detrend_velocity: Option<usize>,
    /// Corner of a high-pass filter without phase shift, > 0 \[Hz\].
    pub high_pass: Option<f64>,
    /// Corner of a low-pass filter without phase shift, > 0 \[Hz\].
    pub low_pass: Option<f64>,
    /// Order of both filters: 2, 4, 6 or 8.
    pub order: usize,
    /// New time step, > 0 \[s\].
    pub resample: Option<f64>,
    /// Time at rest before the motion, ≥ 0 \[s\].
    pub pad_before: Option<f64>,
    /// Time at rest after the motion, ≥ 0 \[s\].
    pub pad_after: Option<f64>,
    /// Correct the motion so that velocity and displacement end at zero.
    pub at_rest: bool,
    /// Factor.
    pub scale: Option<f64>,
    /// Peak acceleration, > 0 \[m/s²\].
    pub pga: Option<f64>,
}

impl Default for Processing {
    /// Nothing.
    fn default() -> Self {
        Self {
            from: None,
            to: None,
            detrend: None,
            detrend_velocity: None,
            high_pass: None,
            low_pass: None,
            order: 4,
            resample: None,
            pad_before: None,
            pad_after: None,
            at_rest: false,
            scale: None,
            pga: None,
        }
    }
}

impl Processing {
    /// The processed motion.
    ///
    /// # Errors
    /// [`RunError::Argument`] for a number outside its range.
    pub fn apply(&self, mut motion: Accelerogram) -> Result<Accelerogram, RunError> {
        if self.from.is_some() || self.to.is_some() {
            let end = self.to.unwrap_or(motion.duration());
            motion = motion.cut(self.from.unwrap_or(0.0), end).map_err(wrong)?;
        }
        if let Some(degree) = self.detrend {
            motion = motion.without_polynomial(degree).map_err(wrong)?;
        }
        if let Some(degree) = self.detrend_velocity {
            motion = motion.without_velocity_trend(degree).map_err(wrong)?;
        }
        let (low, high, order) = (self.high_pass, self.low_pass, self.order);
        if low.is_some() || high.is_some() {
            motion = butterworth(&motion, &Butterworth { low, high, order }).map_err(wrong)?;
        }
        if let Some(step) = self.resample {
            motion = motion.resampled(step).map_err(wrong)?;
        }
        if self.pad_before.is_some() || self.pad_after.is_some() {
            let [before, after] =
                [self.pad_before, self.pad_after].map(|duration| duration.unwrap_or(0.0));
            motion = motion.padded(before, after).map_err(wrong)?;
        }
        if self.at_rest {
            motion = motion.ending_at_rest();
        }
        if let Some(factor) = self.scale {
            motion = motion.scaled(factor).map_err(wrong)?;
        }
        if let Some(pga) = self.pga {
            if pga <= 0.0 {
                return Err(RunError::Argument(
                    "--pga must be greater than zero".to_owned(),
                ));
            }
            motion = motion.scaled_to_peak(pga).map_err(wrong)?;
        }
        Ok(motion)
    }
}
