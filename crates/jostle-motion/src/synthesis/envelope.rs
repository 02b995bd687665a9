//! Envelopes of motions over time.

use crate::fault::{MotionFault, within};

/// `(t/t₁)²` until t₁, 1 until t₂, `exp(−c (t − t₂))` afterwards, with the last twentieth of the duration faded to
/// zero by half a cosine.
///
/// P. C. Jennings, G. W. Housner, N. C. Tsai (1968), Simulated earthquake motions, Caltech.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Envelope {
    /// End of the rise \[s\].
    pub rise: f64,
    /// Beginning of the decay \[s\].
    pub decay: f64,
    /// Rate of the decay, ≥ 0 \[1/s\].
    pub rate: f64,
    /// End of the motion \[s\].
    pub duration: f64,
}

impl Envelope {
    /// An envelope for a duration, > 0 \[s\]: rise over an eighth (at most 6 s), decay from 45 % on, to a twentieth
    /// of the strength at the end.
    #[must_use]
    pub fn of_duration(duration: f64) -> Self {
        Self {
            rise: (duration / 8.0).min(6.0),
            decay: 0.45 * duration,
            rate: 3.0 / (0.55 * duration),
            duration,
        }
    }

    pub(crate) fn check(&self) -> Result<(), MotionFault> {
        let ordered = 0.0 < self.rise && self.rise <= self.decay && self.decay <= self.duration;
        within(
            "the rise of the envelope",
            "between 0 and its decay",
            self.rise,
            ordered,
        )?;
        within(
            "the rate of decay",
            "at or above zero",
            self.rate,
            self.rate >= 0.0,
        )
    }

    /// Strength at a time, between 0 and 1 \[–\].
    #[must_use]
    pub fn at(&self, t: f64) -> f64 {
        let left = (self.duration - t) / (0.05 * self.duration);
        let fade = if left >= 1.0 {
            1.0
        } else {
            0.5 - 0.5 * libm::cos(std::f64::consts::PI * left.max(0.0))
        };
        fade * if t < self.rise {
            (t / self.rise).powi(2)
        } else if t <= self.decay {
            1.0
        } else {
            libm::exp(-self.rate * (t - self.decay))
        }
    }
}
