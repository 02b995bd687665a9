//! Filtered white noise under an envelope.

use num_complex::Complex64;

use super::random::Random;
use super::{Envelope, points};
use crate::Accelerogram;
use crate::fault::{MotionFault, within};
use crate::fourier::inverse;

/// Power spectral density of the ground, up to a factor.
///
/// ```text
/// S = (1 + 4ζ_g²r²)/[(1 − r²)² + 4ζ_g²r²] · s⁴/[(1 − s²)² + 4ζ_f²s²],   r = ω/ω_g,  s = ω/ω_f
/// ```
///
/// The first factor is that of K. Kanai (1957) and H. Tajimi (1960), the second, which keeps displacements bounded,
/// of R. W. Clough and J. Penzien (1975).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct GroundFilter {
    /// Frequency of the ground ω_g/2π, > 0 \[Hz\].
    pub frequency: f64,
    /// Its damping ζ_g, > 0 \[–\].
    pub damping: f64,
    /// Frequency and damping of the second filter, > 0 \[Hz, –\]; `None` is the spectrum of Kanai and Tajimi alone.
    pub high_pass: Option<[f64; 2]>,
}

impl GroundFilter {
    /// Power spectral density at a frequency \[Hz\], relative to that of the noise \[–\].
    #[must_use]
    pub fn density(&self, frequency: f64) -> f64 {
        let r2 = (frequency / self.frequency).powi(2);
        let damping = 4.0 * self.damping.powi(2) * r2;
        let ground = (1.0 + damping) / ((1.0 - r2).powi(2) + damping);
        let high = self.high_pass.map_or(1.0, |[corner, damping]| {
            let s2 = (frequency / corner).powi(2);
            s2 * s2 / ((1.0 - s2).powi(2) + 4.0 * damping.powi(2) * s2)
        });
        ground * high
    }
}

/// Parameters of a stochastic motion.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct StochasticSettings {
    /// Time step, > 0 \[s\].
    pub step: f64,
    /// Growth and fading; also the duration.
    pub envelope: Envelope,
    /// Seed of the noise.
    pub seed: u64,
    /// The ground.
    pub filter: GroundFilter,
    /// Peak ground acceleration, > 0 \[m/s²\].
    pub peak: f64,
}

/// Gaussian noise with the density of a [`GroundFilter`], under an envelope, ending at rest, scaled to its peak.
///
/// # Errors
/// [`MotionFault`] when a number is out of range.
pub fn stochastic(settings: &StochasticSettings) -> Result<Accelerogram, MotionFault> {
    settings.envelope.check()?;
    let filter = &settings.filter;
    let [corner, damping] = filter.high_pass.unwrap_or([1.0, 1.0]);
    for (what, value) in [
        ("the frequency of the ground", filter.frequency),
        ("the damping of the ground", filter.damping),
        ("the frequency of the high-pass", corner),
        ("the damping of the high-pass", damping),
        ("the peak acceleration", settings.peak),
    ] {
        within(what, "above zero", value, value > 0.0)?;
    }
    let (h, n) = (
        settings.step,
        points(settings.step, settings.envelope.duration)?,
    );
    let mut random = Random::new(settings.seed);
    let mut spectrum = vec![Complex64::default(); n / 2 + 1];
    for (k, value) in spectrum.iter_mut().enumerate().skip(1) {
        let amplitude = filter.density(k as f64 / (n as f64 * h)).sqrt();
        let [re, im] = random.normal_pair();
        *value = amplitude * Complex64::new(re, im);
    }
    let mut values = inverse(&spectrum, n);
    for (i, a) in values.iter_mut().enumerate() {
        *a *= settings.envelope.at(h * i as f64);
    }
    Accelerogram::new(h, values)?
        .ending_at_rest()
        .scaled_to_peak(settings.peak)
}
