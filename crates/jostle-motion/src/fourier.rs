//! Fourier transforms of motions.

use num_complex::Complex64;

use crate::Accelerogram;
use crate::transform::transform;

/// Fourier amplitudes of a motion.
#[derive(Clone, Debug, PartialEq)]
pub struct FourierSpectrum {
    /// Frequencies from 0 to that of Nyquist \[Hz\].
    pub frequency: Vec<f64>,
    /// Magnitude of `∫a e^{−2πift} dt` \[m/s\].
    pub amplitude: Vec<f64>,
}

/// Fourier amplitude spectrum of a motion, padded with zeros so that frequencies lie at most `spacing` apart.
///
/// `spacing` must be positive \[Hz\]; the padded length is a power of two of at most 2²² values.
#[must_use]
pub fn fourier_spectrum(motion: &Accelerogram, spacing: f64) -> FourierSpectrum {
    let wanted = (1.0 / (spacing * motion.step()))
        .ceil()
        .clamp(2.0, MOST as f64) as usize;
    let length = wanted.max(motion.points()).next_power_of_two();
    let values = forward(motion.acceleration(), length);
    let half = length / 2 + 1;
    FourierSpectrum {
        frequency: (0..half)
            .map(|k| k as f64 / (length as f64 * motion.step()))
            .collect(),
        amplitude: values[..half]
            .iter()
            .map(|c| libm::hypot(c.re, c.im) * motion.step())
            .collect(),
    }
}

/// Longest padded length.
const MOST: usize = 1 << 22;

/// Mean period `Σ C²/f / Σ C²` over 0.25 Hz ≤ f ≤ 20 Hz, frequencies at most 0.05 Hz apart \[s\].
///
/// E. M. Rathje, N. A. Abrahamson, J. D. Bray (1998), J. Geotech. Geoenviron. Eng. 124, 150–159.
#[must_use]
pub fn mean_period(motion: &Accelerogram) -> f64 {
    let spectrum = fourier_spectrum(motion, 0.05);
    let (mut weighted, mut whole) = (0.0, 0.0);
    for (f, c) in spectrum.frequency.iter().zip(&spectrum.amplitude) {
        if (0.25..=20.0).contains(f) {
            weighted += c * c / f;
            whole += c * c;
        }
    }
    if whole > 0.0 { weighted / whole } else { 0.0 }
}

/// Transform of real values, padded with zeros.
pub(crate) fn forward(values: &[f64], length: usize) -> Vec<Complex64> {
    let mut buffer: Vec<Complex64> = values.iter().map(|&v| Complex64::new(v, 0.0)).collect();
    buffer.resize(length, Complex64::default());
    transform(&mut buffer, -1.0);
    buffer
}

/// Real values from the coefficients of the frequencies 0 to Nyquist, normalised: the inverse of [`forward`].
pub(crate) fn inverse(half: &[Complex64], length: usize) -> Vec<f64> {
    let mut buffer = half[..length / 2 + 1].to_vec();
    buffer.extend((1..length.div_ceil(2)).rev().map(|k| half[k].conj()));
    transform(&mut buffer, 1.0);
    buffer.iter().map(|c| c.re / length as f64).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn there_and_back() {
        let values: Vec<f64> = (0..16).map(|i| f64::from(i * i % 7) - 2.5).collect();
        let back = inverse(&forward(&values, 16), 16);
        for (a, b) in values.iter().zip(&back) {
            assert!((a - b).abs() < 1e-13, "{a} became {b}");
        }
    }

    #[test]
    fn a_sine_has_its_period_as_mean() {
        let (step, f) = (0.01, 2.5);
        let sine = |i: i32| (std::f64::consts::TAU * f * step * f64::from(i)).sin();
        let motion = Accelerogram::new(step, (0..8000).map(sine).collect()).unwrap();
        let mean = mean_period(&motion);
        assert!((mean - 0.4).abs() < 2e-3, "{mean}");
        let spectrum = fourier_spectrum(&motion, 0.1);
        let peak = spectrum.amplitude.iter().cloned().fold(0.0, f64::max);
        assert!(peak < 40.0 && peak > 25.0, "half the duration: {peak}");
    }
}
