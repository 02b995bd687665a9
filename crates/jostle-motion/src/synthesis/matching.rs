//! Time-domain matching of a motion to a spectrum.
//!
//! Every controlled oscillator i has its peak Rᵢ at a time tᵢ. The derivative of the response at tᵢ with respect to
//! the ground acceleration of sample m is known exactly, gᵢₘ: the response to a hat function of acceleration,
//! time-reversed from tᵢ. The smallest change of the motion that brings all these answers to the target,
//!
//! ```text
//! Σₘ gᵢₘ δaₘ = ± (S_target(Tᵢ) − |Rᵢ|),   Σₘ (δaₘ/wₘ)² → min
//! δaₘ = wₘ² Σᵢ gᵢₘ bᵢ,   Σⱼ (Σₘ gᵢₘ wₘ² gⱼₘ) bⱼ = ± (S_target(Tᵢ) − |Rᵢ|)
//! ```
//!
//! is a sum of waves that are the answers of the oscillators run backwards: the method of P. Lilhanand and
//! W. S. Tseng (1988), Proc. 9th World Conf. Earthquake Eng. II, 819–824. The weight w is the strength of the motion
//! over a few seconds about m, so that quiet parts stay quiet. Peaks move to other times as the motion changes, so
//! this is repeated; where the spectrum is worst between controlled periods, further ones are controlled.

use super::wavelet::Wavelet;
use crate::Accelerogram;
use crate::fault::{MotionFault, within};
use crate::filter::{Butterworth, butterworth};
use crate::least_squares::{dot, solve};
use crate::oscillator::{Advance, Oscillator, State};
use crate::peaks::{Extreme, Response, peak_responses};
use crate::spectrum::spaced_periods;
use crate::target::TargetSpectrum;

/// Target of the matching.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct MatchSettings {
    /// First and last period, the first at least four steps \[s\].
    pub periods: [f64; 2],
    /// Damping ratio \[–\].
    pub damping: f64,
    /// Largest relative difference that is good enough, on a grid finer than that of the controls \[–\].
    pub tolerance: f64,
    /// Peak ground acceleration of the result; `None` leaves it free \[m/s²\].
    pub peak: Option<f64>,
}

impl Default for MatchSettings {
    /// 0.05 to 4 s with 5 % damping, to 5 %.
    fn default() -> Self {
        Self {
            periods: [0.05, 4.0],
            damping: 0.05,
            tolerance: 0.05,
            peak: None,
        }
    }
}

/// A matched motion.
#[derive(Clone, Debug, PartialEq)]
pub struct Matched {
    /// The motion: it ends at rest where it began and has the peak asked for.
    pub motion: Accelerogram,
    /// Largest relative difference of its spectrum, peaks between samples included \[–\].
    pub misfit: f64,
    /// Where that is \[s\].
    pub worst_period: f64,
    /// Rounds of matching.
    pub rounds: usize,
}

/// Distance of checked periods, as a logarithm: a tenth of the width of a resonance with 5 % damping.
const SPACING: f64 = 0.01;
/// Every how many of them one is controlled from the beginning.
const EVERY: usize = 4;
/// Largest number of iterations.
const ROUNDS: usize = 80;
/// Matching ends at this fraction of the tolerance; below it a period needs no separate control.
const ENOUGH: f64 = 0.5;
/// Added to the diagonal of one: near neighbours are nearly dependent. More shortens the step (Levenberg 1944).
const FIRST_CAUTION: f64 = 2e-2;
/// A change that makes the merit worse by this factor is undone.
const HARM: f64 = 30.0;
/// Regularisation at which steps become negligible.
const MOST_CAUTION: f64 = 100.0;
/// Tolerance of a located peak \[–\].
const PEAK_TOLERANCE: f64 = 1e-12;
/// Half the time over which the strength of a motion is taken \[s\].
const AROUND: f64 = 2.0;

impl MatchSettings {
    pub(crate) fn check(&self, target: &TargetSpectrum, step: f64) -> Result<(), MotionFault> {
        let [first, last] = self.periods;
        within(
            "the shortest matched period",
            "at or above four steps",
            first,
            first >= 4.0 * step,
        )?;
        if first >= last {
            return Err(MotionFault::Order {
                smaller: "the shortest matched period",
                larger: "the longest",
                found: [first, last],
            });
        }
        let good = (1e-4..=1.0).contains(&self.tolerance);
        within(
            "the tolerance of matching",
            "between 0.0001 and 1",
            self.tolerance,
            good,
        )?;
        if let Some(peak) = self.peak {
            within("the peak acceleration", "above zero", peak, peak > 0.0)?;
        }
        target.acceleration(first, self.damping)?;
        target.acceleration(last, self.damping).map(drop)
    }

    /// The checked periods.
    fn grid(&self) -> Vec<f64> {
        let [first, last] = self.periods;
        let parts = (libm::log(last / first) / SPACING).ceil().max(1.0) as usize;
        spaced_periods(first, last, parts + 1)
    }
}

/// Changes a motion as little as wavelets allow so that its spectrum follows the target.
///
/// The result lasts as long, has velocity and displacement zero at its end, the peak ground acceleration asked for,
/// and a spectrum within the tolerance at every period of the range.
///
/// # Errors
/// [`MotionFault::NoMatch`] with the best misfit when the tolerance is not met; others when a number is out of range.
pub fn match_spectrum(
    seed: &Accelerogram,
    target: &TargetSpectrum,
    settings: &MatchSettings,
) -> Result<Matched, MotionFault> {
    // The long periods of a record may change too, so that the rest changes less.
    match_above(seed, target, settings, 0.5 / settings.periods[1])
}

/// The same with changes above a frequency only \[Hz\].
pub(super) fn match_above(
    seed: &Accelerogram,
    target: &TargetSpectrum,
    settings: &MatchSettings,
    corner: f64,
) -> Result<Matched, MotionFault> {
    settings.check(target, seed.step())?;
    if seed.peak() == 0.0 {
        return Err(MotionFault::Zero);
    }
    let grid = settings.grid();
    let oscillators = with_damping(&grid, settings.damping);
    let wanted = wanted(target, &grid, settings.damping)?;
    let mut controlled: Vec<bool> = (0..grid.len())
        .map(|i| i % EVERY == 0 || i + 1 == grid.len())
        .collect();
    let attempt = |motion: &Accelerogram| -> Result<Attempt, MotionFault> {
        let motion = finish(motion, settings)?;
        let responses = peak_responses(&motion, &oscillators);
        Ok(Attempt {
            misses: misses(&responses, &wanted),
            responses,
            peak_is_met: settings
                .peak
                .is_none_or(|peak| (motion.peak() / peak - 1.0).abs() < 1e-9),
            motion,
        })
    };
    let mut now = attempt(&first_guess(seed, &oscillators, &wanted)?)?;
    let mut best: Option<Matched> = None;
    let mut caution = FIRST_CAUTION;
    for round in 0..ROUNDS {
        let (at, misfit) = worst(&now.misses);
        if now.peak_is_met && best.as_ref().is_none_or(|best| misfit < best.misfit) {
            best = Some(Matched {
                motion: now.motion.clone(),
                misfit,
                worst_period: grid[at],
                rounds: round,
            });
            if misfit < ENOUGH * settings.tolerance {
                break;
            }
        }
        control_more(&mut controlled, &now.misses, ENOUGH * settings.tolerance);
        let controls: Vec<Control> = (0..grid.len())
            .filter(|&i| controlled[i])
            .map(|i| Control {
                oscillator: oscillators[i],
                peak: now.responses[i].pseudo_acceleration,
                wanted: wanted[i],
            })
            .collect();
        let change = improve(&now.motion, &controls, caution)?;
        let change = without_long_waves(&change, corner)?;
        let pairs = now.motion.acceleration().iter().zip(change.acceleration());
        let next = attempt(&now.motion.with(pairs.map(|(a, d)| a + d).collect())?)?;
        // Peaks may have moved so far that the change did harm. A little harm is a way out of a corner; after much, a
        // smaller change from the same place is tried.
        let worse = next.merit() / now.merit();
        if worse < 1.0 {
            caution = (0.3 * caution).max(FIRST_CAUTION);
        } else {
            caution *= 2.0;
        }
        if worse < HARM {
            now = next;
        }
        if caution > MOST_CAUTION {
            break;
        }
    }
    match best {
        Some(best) if best.misfit <= settings.tolerance => Ok(best),
        best => Err(MotionFault::NoMatch {
            misfit: 100.0 * best.as_ref().map_or(f64::INFINITY, |best| best.misfit),
            period: best.map_or(0.0, |best| best.worst_period),
        }),
    }
}

/// A motion on the way and how its spectrum lies.
struct Attempt {
    motion: Accelerogram,
    responses: Vec<Response>,
    misses: Vec<f64>,
    peak_is_met: bool,
}

impl Attempt {
    /// Smaller is better: the largest differences count most.
    fn merit(&self) -> f64 {
        self.misses.iter().map(|miss| miss.powi(4)).sum()
    }
}

/// Largest relative difference of the spectrum of a motion from a target over the periods to match, and where it is.
///
/// # Errors
/// When the target does not speak of these periods or this damping.
pub fn misfit(
    motion: &Accelerogram,
    target: &TargetSpectrum,
    settings: &MatchSettings,
) -> Result<(f64, f64), MotionFault> {
    let grid = settings.grid();
    let wanted = wanted(target, &grid, settings.damping)?;
    let responses = peak_responses(motion, &with_damping(&grid, settings.damping));
    let (at, misfit) = worst(&misses(&responses, &wanted));
    Ok((misfit, grid[at]))
}

/// Relative differences from the target.
fn misses(responses: &[Response], wanted: &[f64]) -> Vec<f64> {
    let pairs = responses.iter().zip(wanted);
    pairs
        .map(|(response, wanted)| response.pseudo_acceleration.value.abs() / wanted - 1.0)
        .collect()
}

/// Index and magnitude of the largest.
fn worst(misses: &[f64]) -> (usize, f64) {
    let mut found = (0, 0.0);
    for (i, miss) in misses.iter().enumerate() {
        if miss.abs() > found.1 {
            found = (i, miss.abs());
        }
    }
    found
}

/// Controls the periods where the difference is largest among their neighbours.
fn control_more(controlled: &mut [bool], misses: &[f64], enough: f64) {
    let size = |i: usize| misses.get(i).map_or(0.0, |miss| miss.abs());
    for (i, control) in controlled.iter_mut().enumerate() {
        let before = i.checked_sub(1).map_or(0.0, size);
        *control |= size(i) > enough && size(i) >= before && size(i) >= size(i + 1);
    }
}

fn with_damping(periods: &[f64], damping: f64) -> Vec<Oscillator> {
    let one = |&period| Oscillator { period, damping };
    periods.iter().map(one).collect()
}

fn wanted(target: &TargetSpectrum, periods: &[f64], damping: f64) -> Result<Vec<f64>, MotionFault> {
    periods
        .iter()
        .map(|&t| target.acceleration(t, damping))
        .collect()
}

/// The seed motion times the factor that makes the mean logarithmic difference from the target zero.
fn first_guess(
    seed: &Accelerogram,
    oscillators: &[Oscillator],
    wanted: &[f64],
) -> Result<Accelerogram, MotionFault> {
    let responses = peak_responses(seed, oscillators);
    let logarithms = responses.iter().zip(wanted).map(|(response, wanted)| {
        libm::log(
            wanted
                / response
                    .pseudo_acceleration
                    .value
                    .abs()
                    .max(f64::MIN_POSITIVE),
        )
    });
    seed.scaled(libm::exp(logarithms.sum::<f64>() / wanted.len() as f64))
}

/// An oscillator, its peak, and the magnitude that this should have.
struct Control {
    oscillator: Oscillator,
    peak: Extreme,
    wanted: f64,
}

/// One round: the smallest change of the motion that mends all controlled peaks.
fn improve(
    motion: &Accelerogram,
    controls: &[Control],
    caution: f64,
) -> Result<Accelerogram, MotionFault> {
    let (h, n) = (motion.step(), motion.points());
    let strength = strength(motion);
    // Rows g w over the target, made unit vectors.
    let mut waves = Vec::new();
    let mut missing = Vec::new();
    for control in controls {
        let mut wave = answer(&control.oscillator, h, control.peak.at, n);
        wave.iter_mut().zip(&strength).for_each(|(g, w)| *g *= w);
        let size = dot(&wave, &wave).sqrt().max(f64::MIN_POSITIVE);
        wave.iter_mut().for_each(|g| *g /= size);
        let short = control.wanted - control.peak.value.abs();
        let short = short.clamp(-0.4 * control.wanted, 0.4 * control.wanted);
        missing.push(short * control.peak.value.signum() / size);
        waves.push(wave);
    }
    let mut products: Vec<Vec<f64>> = waves
        .iter()
        .enumerate()
        .map(|(i, one)| {
            let with = |other: &Vec<f64>| {
                let both = one.len().min(other.len());
                dot(&one[..both], &other[..both])
            };
            waves[..=i].iter().map(with).collect()
        })
        .collect();
    for (i, row) in products.iter_mut().enumerate() {
        row[i] += caution;
    }
    let amounts = solve(&mut products, missing);
    let mut values = vec![0.0; n];
    for (wave, amount) in waves.iter().zip(&amounts) {
        for ((a, g), w) in values.iter_mut().zip(wave).zip(&strength) {
            *a += amount * w * g;
        }
    }
    Accelerogram::new(h, values)
}

/// Takes away waves below a frequency \[Hz\]: they are not asked for and would be most of the displacement.
pub(super) fn without_long_waves(
    motion: &Accelerogram,
    corner: f64,
) -> Result<Accelerogram, MotionFault> {
    let filter = Butterworth {
        low: Some(corner.min(0.2 / motion.step())),
        high: None,
        order: 4,
    };
    butterworth(motion, &filter)
}

/// Root mean square of the acceleration about every sample, relative to the largest, and zero at both ends.
fn strength(motion: &Accelerogram) -> Vec<f64> {
    let a = motion.acceleration();
    let reach = ((AROUND / motion.step()) as usize).clamp(1, a.len());
    let mut sums = vec![0.0];
    for a in a {
        sums.push(sums[sums.len() - 1] + a * a);
    }
    let square = |i: usize| {
        let (first, behind) = (i.saturating_sub(reach), (i + reach).min(a.len()));
        (sums[behind] - sums[first]).max(0.0) / (behind - first) as f64
    };
    let squares: Vec<f64> = (0..a.len()).map(square).collect();
    let largest = squares.iter().fold(f64::MIN_POSITIVE, |m, s| m.max(*s));
    let last = (a.len() - 1) as f64;
    let end = |i: usize| (20.0 * libm::sin(std::f64::consts::PI * i as f64 / last)).clamp(0.0, 1.0);
    squares
        .iter()
        .enumerate()
        .map(|(i, s)| end(i) * (s / largest).sqrt())
        .collect()
}

/// By how much the pseudo-acceleration ω²u at a time changes with the ground acceleration of every sample until
/// then: the answer to a hat that peaks there.
fn answer(oscillator: &Oscillator, h: f64, at: f64, points: usize) -> Vec<f64> {
    let theta = oscillator.circular_frequency() * h;
    let last = ((at / h).floor() as usize).min(points - 1);
    let share = at / h - last as f64;
    let (step, part) = (
        Advance::over(theta, oscillator.damping),
        Advance::over(share * theta, oscillator.damping),
    );
    // The hat begins at sample 0 and peaks at sample 1; k counts samples before `at`.
    let mut state = State { x: 0.0, v: 0.0 };
    let mut weights = vec![0.0; (last + 2).min(points)];
    for k in 0..=last + 1 {
        let (sigma, ground) = match k {
            0 => (1.0 / theta, share),
            1 => (-1.0 / theta, 1.0 - share),
            _ => (0.0, 0.0),
        };
        let peak = last + 1 - k;
        if peak < weights.len() {
            weights[peak] = part.apply(state, sigma).x - ground;
        }
        state = step.apply(state, sigma);
    }
    weights
}

/// Brings the end to rest and the peak to its value.
fn finish(motion: &Accelerogram, settings: &MatchSettings) -> Result<Accelerogram, MotionFault> {
    let motion = motion.ending_at_rest();
    let Some(peak) = settings.peak else {
        return Ok(motion);
    };
    let (h, n) = (motion.step(), motion.points());
    let mut values = motion.into_acceleration();
    // The largest value alone, again and again: lowered to a little below the peak if too large, raised to the peak if
    // too small. Waves as short as this hardly touch the matched periods.
    let period = (0.8 * settings.periods[0]).max(4.0 * h);
    for _ in 0..1000 {
        let (at, value) = largest(&values);
        let excess = value.abs() - peak;
        if excess.abs() <= PEAK_TOLERANCE * peak {
            break;
        }
        let change = if excess > 0.0 {
            excess + 0.003 * peak
        } else {
            excess
        };
        let wavelet = Wavelet::new(h, n, period, h * at as f64);
        let ordinate = at
            .checked_sub(wavelet.range.start)
            .and_then(|i| wavelet.values.get(i));
        let ordinate = ordinate
            .copied()
            .filter(|candidate| *candidate > 0.1)
            .unwrap_or(1.0);
        wavelet.add(&mut values, -change * value.signum() / ordinate);
    }
    Accelerogram::new(h, values)
}

fn largest(values: &[f64]) -> (usize, f64) {
    let mut found = (0, 0.0_f64);
    for (i, &value) in values.iter().enumerate() {
        if value.abs() > found.1.abs() {
            found = (i, value);
        }
    }
    found
}
