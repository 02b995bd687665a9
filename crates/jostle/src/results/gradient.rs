//! How peaks change with the numbers of a model.

use serde::Serialize;

/// The derivative of a peak with respect to a number of the model file.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Gradient {
    /// The peak, by its path in `summary.json`, such as `gaps[0].peak_force_n`.
    pub of: String,
    /// The number, by its path in the model file, such as `gap[0].width`.
    pub by: String,
    /// The peak itself, at the tolerance of these runs, 1e-6 or that of the model if it is less.
    pub peak: f64,
    /// The number itself, in SI.
    pub at: f64,
    /// Derivative, in the unit of the peak over the unit of the number in SI.
    pub value: f64,
    /// Difference of the derivative from that of half the step: what it may be wrong by, in the same unit.
    pub error: f64,
    /// Greatest change of the number, to either side and in SI, up to which the peak stays within 1 % of the straight line. Changes
    /// of 0.1 to 50 % are tried; 0 if the line fails at the first.
    pub valid_within: f64,
}

impl Gradient {
    /// Relative change of the peak for one of the number: its derivative times the number over the peak \[–\]; zero for a peak
    /// of zero.
    #[must_use]
    pub fn elasticity(&self) -> f64 {
        if self.peak == 0.0 {
            return 0.0;
        }
        self.value * self.at / self.peak
    }
}
