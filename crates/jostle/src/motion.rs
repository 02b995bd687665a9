//! Ground motion: horizontal ground acceleration as a function of time.

mod grounds;

pub(crate) use grounds::Side;
pub use grounds::{GroundPath, GroundPoint, Grounds, OwnGround};

use std::f64::consts::PI;

/// Horizontal ground acceleration a_g(t), positive to the right; zero outside `0..=duration`.
///
/// ```
/// use jostle::{GroundMotion, Wave};
///
/// let record = GroundMotion::sampled("three values", 0.02, vec![0.0, 1.0, -0.5]);
/// assert_eq!(record.duration, 0.04);
/// assert!((record.acceleration(0.01) - 0.5).abs() < 1e-15); // straight lines between values
///
/// let wave = Wave::Sine { amplitude: 2.0, period: 0.7 };
/// let sine = GroundMotion { name: "sine".into(), scale: 1.5, duration: 8.0, wave, bearing: None, grounds: None };
/// assert!((sine.peak() - 3.0).abs() < 1e-12);
/// ```
#[derive(Clone, Debug, PartialEq)]
pub struct GroundMotion {
    /// Name shown on summaries.
    pub name: String,
    /// Factor on the wave below, sign included \[–\].
    pub scale: f64,
    /// Length of the analysis \[s\].
    pub duration: f64,
    /// The shape before scaling.
    pub wave: Wave,
    /// Direction in plan and motion across it, for buildings in space.
    pub bearing: Option<Box<Bearing>>,
    /// Ground that differs under the buildings, and vertical shaking; `None` is one ground under all, shaken along the row.
    pub grounds: Option<Box<Grounds>>,
}

/// Ground acceleration along x, across, and upwards \[m/s²\].
pub type Ground = [f64; 3];

/// Direction of a ground motion in plan, and the motion at a right angle to it.
#[derive(Clone, Debug, PartialEq)]
pub struct Bearing {
    /// Angle from x to the motion, counter-clockwise \[rad\].
    pub angle: f64,
    /// The motion across, a right angle counter-clockwise from the first; it has no bearing of its own.
    pub across: Option<GroundMotion>,
}

/// Shape of a ground motion before scaling.
///
/// ```
/// use jostle::{GroundMotion, Wave};
///
/// let wave = Wave::Ricker { amplitude: 3.0, period: 0.6, centre: 0.9 };
/// let pulse = GroundMotion { name: "pulse".into(), scale: 1.0, duration: 2.0, wave, bearing: None, grounds: None };
/// assert!((pulse.acceleration(0.9) - 3.0).abs() < 1e-12);
/// ```
#[derive(Clone, Debug, PartialEq)]
pub enum Wave {
    /// Values at `0, step, 2·step, …`, linear between them.
    Sampled {
        /// Sampling step, > 0 \[s\].
        step: f64,
        /// Ground acceleration \[m/s²\].
        acceleration: Vec<f64>,
    },
    /// `amplitude · sin(2π t / period)`, evaluated exactly.
    Sine {
        /// Amplitude \[m/s²\].
        amplitude: f64,
        /// Period, > 0 \[s\].
        period: f64,
    },
    /// Ricker pulse `amplitude · (1 − 2π²τ²) exp(−π²τ²)`, `τ = (t − centre) / period`.
    Ricker {
        /// Peak acceleration at the centre \[m/s²\].
        amplitude: f64,
        /// Period of the strongest harmonic, > 0 \[s\].
        period: f64,
        /// Time of the peak \[s\].
        centre: f64,
    },
}

impl GroundMotion {
    /// A motion from equally spaced values, unscaled, as long as its record.
    #[must_use]
    pub fn sampled(name: &str, step: f64, acceleration: Vec<f64>) -> Self {
        let duration = step * acceleration.len().saturating_sub(1) as f64;
        Self {
            name: name.to_owned(),
            scale: 1.0,
            duration,
            wave: Wave::Sampled { step, acceleration },
            bearing: None,
            grounds: None,
        }
    }

    /// The same with the other sign of everything horizontal: records have two, and no earthquake tells which one a site sees.
    #[must_use]
    pub fn reversed(&self) -> Self {
        let mut other = self.clone();
        other.scale = -other.scale;
        if let Some(across) = other
            .bearing
            .as_mut()
            .and_then(|bearing| bearing.across.as_mut())
        {
            *across = across.reversed();
        }
        for ground in other
            .grounds
            .iter_mut()
            .flat_map(|grounds| &mut grounds.own)
        {
            ground.motion = ground.motion.as_ref().map(Self::reversed);
        }
        other
    }

    /// Ground acceleration along x and across at time `t`: a₁ cos φ − a₂ sin φ and a₁ sin φ + a₂ cos φ; none upwards, which [`Grounds`]
    /// have \[m/s²\].
    #[must_use]
    pub fn components(&self, t: f64) -> Ground {
        let first = self.acceleration(t);
        let Some(bearing) = &self.bearing else {
            return [first, 0.0, 0.0];
        };
        let across = bearing.across.as_ref();
        let second = across.map_or(0.0, |motion| motion.acceleration(t));
        let (sin, cos) = libm::sincos(bearing.angle);
        [first * cos - second * sin, first * sin + second * cos, 0.0]
    }

    /// Ground acceleration at time `t` \[m/s²\].
    #[must_use]
    pub fn acceleration(&self, t: f64) -> f64 {
        if t < 0.0 || t > self.duration * (1.0 + 1e-12) {
            return 0.0;
        }
        self.scale
            * match &self.wave {
                Wave::Sampled { step, acceleration } => interpolate(acceleration, t / step),
                Wave::Sine { amplitude, period } => amplitude * libm::sin(2.0 * PI * t / period),
                Wave::Ricker {
                    amplitude,
                    period,
                    centre,
                } => {
                    let tau = PI * (t - centre) / period;
                    amplitude * (1.0 - 2.0 * tau * tau) * libm::exp(-tau * tau)
                }
            }
    }

    /// Peak ground acceleration within the duration, scale included \[m/s²\].
    #[must_use]
    pub fn peak(&self) -> f64 {
        self.scale.abs() * self.unscaled_peak()
    }

    /// Peak of the wave within the duration, before scaling \[m/s²\].
    #[must_use]
    pub fn unscaled_peak(&self) -> f64 {
        match &self.wave {
            Wave::Sampled { step, acceleration } => {
                let last = (self.duration / step * (1.0 + 1e-12)).floor() as usize;
                acceleration
                    .iter()
                    .take(last.saturating_add(1))
                    .fold(0.0, |peak: f64, a| peak.max(a.abs()))
            }
            Wave::Sine { amplitude, period } => {
                if self.duration >= 0.25 * period {
                    amplitude.abs()
                } else {
                    (amplitude * libm::sin(2.0 * PI * self.duration / period)).abs()
                }
            }
            Wave::Ricker { amplitude, .. } => amplitude.abs(),
        }
    }

    /// Sampling step of a record, the finer one of two components; `None` for analytic waves \[s\].
    #[must_use]
    pub fn step(&self) -> Option<f64> {
        let along = match self.wave {
            Wave::Sampled { step, .. } => Some(step),
            _ => None,
        };
        let across = self.across().and_then(Self::step);
        along
            .zip(across)
            .map(|(along, across)| along.min(across))
            .or(along)
            .or(across)
    }

    /// Shortest period of an analytic wave; `None` for records \[s\].
    #[must_use]
    pub fn period(&self) -> Option<f64> {
        let along = match self.wave {
            Wave::Sampled { .. } => None,
            Wave::Sine { period, .. } | Wave::Ricker { period, .. } => Some(period),
        };
        let across = self.across().and_then(Self::period);
        along
            .zip(across)
            .map(|(along, across)| along.min(across))
            .or(along)
            .or(across)
    }

    /// The component across, if there is one.
    #[must_use]
    pub fn across(&self) -> Option<&Self> {
        self.bearing.as_ref()?.across.as_ref()
    }

    /// Number of record points; 0 for analytic waves.
    #[must_use]
    pub fn points(&self) -> usize {
        match &self.wave {
            Wave::Sampled { acceleration, .. } => acceleration.len(),
            _ => 0,
        }
    }
}

/// Linear interpolation at a fractional index; zero past the last value.
fn interpolate(values: &[f64], position: f64) -> f64 {
    let before = position.floor();
    let fraction = position - before;
    let index = before as usize;
    match (values.get(index), values.get(index + 1)) {
        (Some(a), Some(b)) => a + fraction * (b - a),
        (Some(a), None) if fraction < 1e-9 => *a,
        _ => 0.0,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn record_is_straight_between_points_and_zero_outside() {
        let motion = GroundMotion::sampled("r", 0.5, vec![0.0, 2.0, -4.0]);
        assert_eq!(motion.duration, 1.0);
        for (t, a) in [
            (-0.1, 0.0),
            (0.25, 1.0),
            (0.5, 2.0),
            (0.75, -1.0),
            (1.0, -4.0),
            (1.1, 0.0),
        ] {
            assert!(
                (motion.acceleration(t) - a).abs() < 1e-14,
                "a_g({t}) should be {a}"
            );
        }
        assert_eq!(motion.peak(), 4.0);
    }

    #[test]
    fn peak_respects_the_cut() {
        let mut motion = GroundMotion::sampled("r", 0.5, vec![0.0, 2.0, -4.0]);
        motion.duration = 0.5;
        assert_eq!(motion.peak(), 2.0);
    }

    #[test]
    fn ricker_peaks_at_its_centre() {
        let motion = GroundMotion {
            name: "pulse".into(),
            scale: -2.0,
            duration: 4.0,
            wave: Wave::Ricker {
                amplitude: 1.5,
                period: 0.5,
                centre: 1.0,
            },
            bearing: None,
            grounds: None,
        };
        assert_eq!(motion.acceleration(1.0), -3.0);
        assert_eq!(motion.peak(), 3.0);
    }
}
