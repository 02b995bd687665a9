//! Velocity pulses near a fault, after G. P. Mavroeidis and A. S. Papageorgiou (2003), as records.

use std::f64::consts::PI;

use jostle::GroundMotion;

/// v = ½ A (1 + cos(2π τ/(γ T))) cos(2π τ/T + ν) while |τ| ≤ ½ γ T, τ being counted from the middle of the pulse.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Pulse {
    /// Greatest velocity A \[m/s\].
    pub velocity: f64,
    /// Period T \[s\].
    pub period: f64,
    /// Oscillations γ > 1 \[–\].
    pub oscillations: f64,
    /// Phase ν \[rad\].
    pub phase: f64,
}

/// Step of the record \[s\].
pub(super) const STEP: f64 = 0.01;

impl Pulse {
    /// Ground acceleration from its first instant on, to a micrometre per second squared \[m/s²\].
    #[must_use]
    pub fn values(&self) -> Vec<f64> {
        let length = self.oscillations * self.period;
        let count = (length / STEP).ceil() as usize;
        let acceleration = |k: usize| {
            let from_middle = k as f64 * STEP - 0.5 * length;
            if from_middle.abs() > 0.5 * length {
                return 0.0;
            }
            let slow = 2.0 * PI * from_middle / length;
            let quick = 2.0 * PI * from_middle / self.period + self.phase;
            -self.velocity * PI / length
                * (slow.sin() * quick.cos() + self.oscillations * quick.sin() * (1.0 + slow.cos()))
        };
        let values = (0..=count).map(acceleration);
        values.map(|value| (value * 1e6).round() * 1e-6).collect()
    }

    /// The record, followed by free vibration up to `duration` \[s\].
    #[must_use]
    pub fn motion(&self, duration: f64) -> GroundMotion {
        let mut motion = GroundMotion::sampled("pulse", STEP, self.values());
        motion.duration = duration;
        motion
    }

    /// The record as a file of one column.
    #[must_use]
    pub fn text(&self) -> String {
        let lines = self.values().into_iter();
        lines.map(|value| format!("{value:.6}\n")).collect()
    }
}
