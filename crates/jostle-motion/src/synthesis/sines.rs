//! Sines with random phases under an envelope, with amplitudes scaled iteratively to the spectrum.
//!
//! ```text
//! a(t) = E(t) Σₖ Aₖ cos(2π fₖ t + φₖ),   Aₖ ← Aₖ S_target(1/fₖ)/S(1/fₖ)
//! ```
//!
//! D. A. Gasparini, E. H. Vanmarcke (1976), Simulated earthquake motions compatible with prescribed response
//! spectra, MIT R76-4. [`super::match_spectrum`] removes the misfit that remains after some iterations.

use num_complex::Complex64;

use super::matching::{MatchSettings, Matched, match_above, without_long_waves};
use super::random::Random;
use super::{Envelope, points};
use crate::fourier::inverse;
use crate::oscillator::Oscillator;
use crate::peaks::peak_responses;
use crate::spectrum::spaced_periods;
use crate::target::TargetSpectrum;
use crate::{Accelerogram, MotionFault};

/// Parameters of a motion of sines.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SineSettings {
    /// Time step, > 0 \[s\].
    pub step: f64,
    /// Growth and fading; also the duration.
    pub envelope: Envelope,
    /// Seed of the phases.
    pub seed: u64,
    /// Target of the matching.
    pub matching: MatchSettings,
}

/// Rounds of raising and lowering amplitudes; later ones gain nothing.
const ROUNDS: usize = 8;
/// Phases that are tried.
const DRAWS: usize = 8;
/// Periods at which amplitudes are compared.
const CONTROLS: usize = 80;

/// A wave of sines matched to a spectrum; see [`super::match_spectrum`] for what is guaranteed. When the first phases of the
/// seed cannot be matched, the next are drawn, up to eight times.
///
/// # Errors
/// [`MotionFault`] when a number is out of range or the spectrum cannot be reached.
pub fn spectrum_compatible(
    target: &TargetSpectrum,
    settings: &SineSettings,
) -> Result<Matched, MotionFault> {
    let mut random = Random::new(settings.seed);
    let mut best = Err(MotionFault::Zero);
    for _ in 0..DRAWS {
        let wave = draw(target, settings, &mut random)?;
        match (
            match_above(
                &wave,
                target,
                &settings.matching,
                corner(&settings.matching),
            ),
            &best,
        ) {
            (Ok(matched), _) => return Ok(matched),
            (
                Err(MotionFault::NoMatch { misfit, period }),
                Err(MotionFault::NoMatch { misfit: least, .. }),
            ) if misfit < *least => best = Err(MotionFault::NoMatch { misfit, period }),
            (Err(_), Err(MotionFault::NoMatch { .. })) => {}
            (failure, _) => best = failure,
        }
    }
    best
}

/// The wave of sines before it is matched in time: near the spectrum, to some 10 %.
///
/// # Errors
/// [`MotionFault`] when a number is out of range.
pub fn sine_wave(
    target: &TargetSpectrum,
    settings: &SineSettings,
) -> Result<Accelerogram, MotionFault> {
    draw(target, settings, &mut Random::new(settings.seed))
}

/// A wave with the next phases of a stream.
fn draw(
    target: &TargetSpectrum,
    settings: &SineSettings,
    random: &mut Random,
) -> Result<Accelerogram, MotionFault> {
    settings.envelope.check()?;
    settings.matching.check(target, settings.step)?;
    let (h, n) = (
        settings.step,
        points(settings.step, settings.envelope.duration)?,
    );
    let MatchSettings {
        periods: [first, last],
        damping,
        ..
    } = settings.matching;
    let half = n / 2 + 1;
    let phases: Vec<f64> = (0..half)
        .map(|_| std::f64::consts::TAU * random.uniform())
        .collect();
    let controls = spaced_periods(first, last, CONTROLS);
    let oscillators: Vec<Oscillator> = controls
        .iter()
        .map(|&period| Oscillator { period, damping })
        .collect();
    let wanted: Vec<f64> = controls
        .iter()
        .map(|&period| target.acceleration(period, damping))
        .collect::<Result<_, _>>()?;
    let envelope: Vec<f64> = (0..n).map(|i| settings.envelope.at(h * i as f64)).collect();
    // Beyond the matched periods the sines fade out, so that velocity and displacement stay moderate.
    let mut amplitudes: Vec<f64> = (0..half)
        .map(|k| {
            let f = k as f64 / (n as f64 * h);
            let low = (2.0 * f * last).clamp(0.0, 1.0).powi(4);
            let high = (2.0 - f * first / 1.5).clamp(0.0, 1.0);
            let at = if f > 0.0 {
                (1.0 / f).clamp(first, last)
            } else {
                last
            };
            // A white band of frequencies makes a spectrum that grows as √f.
            low * high * interpolate(&controls, &wanted, at) / f.max(0.1).sqrt()
        })
        .collect();
    let mut motion = Accelerogram::new(h, vec![0.0; n])?;
    for _ in 0..ROUNDS {
        let spectrum: Vec<Complex64> = amplitudes
            .iter()
            .zip(&phases)
            .map(|(a, phase)| {
                let (sine, cosine) = libm::sincos(*phase);
                Complex64::new(a * cosine, a * sine)
            })
            .collect();
        let mut wave = inverse(&spectrum, n);
        wave.iter_mut().zip(&envelope).for_each(|(a, e)| *a *= e);
        motion = without_long_waves(&Accelerogram::new(h, wave)?, corner(&settings.matching))?;
        let ratios: Vec<f64> = peak_responses(&motion, &oscillators)
            .iter()
            .zip(&wanted)
            .map(|(response, wanted)| wanted / response.pseudo_acceleration.value.abs())
            .collect();
        for (k, amplitude) in amplitudes.iter_mut().enumerate().skip(1) {
            let period = (n as f64 * h / k as f64).clamp(first, last);
            *amplitude *= interpolate(&controls, &ratios, period);
        }
    }
    Ok(motion.ending_at_rest())
}

/// Below this frequency the waves have nothing \[Hz\]: with 4/3 of the longest matched period, displacements stay
/// as small as the spectrum permits.
fn corner(matching: &MatchSettings) -> f64 {
    0.75 / matching.periods[1]
}

/// On straight lines over the logarithm of the period, which must lie within.
fn interpolate(periods: &[f64], values: &[f64], period: f64) -> f64 {
    let after = periods
        .partition_point(|t| *t <= period)
        .clamp(1, periods.len() - 1);
    let (t0, t1) = (periods[after - 1], periods[after]);
    let share = libm::log(period / t0) / libm::log(t1 / t0);
    values[after - 1] + share * (values[after] - values[after - 1])
}
