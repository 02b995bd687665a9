//! Measures of intensity and duration.

use crate::accelerogram::STANDARD_GRAVITY;
use crate::fourier::mean_period;
use crate::integration::{Peak, displacement, peak_of, velocity};
use crate::spectrum::{Reading, response_spectrum, spaced_periods};
use crate::{Accelerogram, MotionFault};

/// Measures of a motion.
#[derive(Clone, Debug, PartialEq)]
pub struct Measures {
    /// Number of values.
    pub points: usize,
    /// Time step \[s\].
    pub step: f64,
    /// Time of the last value \[s\].
    pub duration: f64,
    /// Peak ground acceleration \[m/s²\].
    pub pga: Peak,
    /// Peak ground velocity, of the values at samples \[m/s\].
    pub pgv: Peak,
    /// Peak ground displacement, of the values at samples, without any correction of the baseline \[m\].
    pub pgd: Peak,
    /// Arias intensity `π/(2g) ∫a² dt` by the trapezoidal rule, g = 9.80665 m/s² \[m/s\].
    pub arias: f64,
    /// Cumulative absolute velocity `∫|a| dt` by the trapezoidal rule \[m/s\].
    pub cav: f64,
    /// When the Arias intensity has reached 5 % and 95 %: the significant duration lies between \[s\].
    pub d5_95: [f64; 2],
    /// The same for 5 % and 75 % \[s\].
    pub d5_75: [f64; 2],
    /// Root mean square of the acceleration between 5 % and 95 % of the Arias intensity \[m/s²\].
    pub rms: f64,
    /// Period at which the pseudo-acceleration with 5 % damping is greatest, among 300 from 0.02 to 10 s \[s\].
    pub predominant_period: f64,
    /// Mean period T_m of the Fourier amplitudes \[s\]: see [`mean_period`].
    pub mean_period: f64,
    /// Housner intensity `∫PSV dT` from 0.1 to 2.5 s with 5 % damping \[m\].
    pub housner: f64,
}

/// All measures of a motion.
///
/// # Errors
/// [`MotionFault::Zero`] for a motion without acceleration.
pub fn measures(motion: &Accelerogram) -> Result<Measures, MotionFault> {
    if motion.peak() == 0.0 {
        return Err(MotionFault::Zero);
    }
    let h = motion.step();
    let husid = husid(motion);
    let arias = husid.last().copied().unwrap_or(0.0);
    let reached = |share: f64| crossing(h, &husid, share * arias);
    let (t5, t75, t95) = (reached(0.05), reached(0.75), reached(0.95));
    let periods = spaced_periods(0.02, 10.0, 300);
    let spectrum = response_spectrum(motion, &periods, &[0.05], Reading::Steps)?;
    let strongest = spectrum.curves[0]
        .pseudo_acceleration
        .iter()
        .enumerate()
        .max_by(|a, b| a.1.total_cmp(b.1));
    Ok(Measures {
        points: motion.points(),
        step: motion.step(),
        duration: motion.duration(),
        pga: peak_of(h, motion.acceleration()),
        pgv: peak_of(h, &velocity(motion)),
        pgd: peak_of(h, &displacement(motion)),
        arias,
        cav: trapezoid(h, motion.acceleration().iter().map(|a| a.abs())),
        d5_95: [t5, t95],
        d5_75: [t5, t75],
        rms: (0.9 * arias * 2.0 * STANDARD_GRAVITY / std::f64::consts::PI / (t95 - t5)).sqrt(),
        predominant_period: strongest.map_or(0.0, |(i, _)| periods[i]),
        mean_period: mean_period(motion),
        housner: housner(motion)?,
    })
}

/// Arias intensity until every sample \[m/s\]: `π/(2g) ∫a² dt` by the trapezoidal rule (Arias 1970; the curve of
/// Husid 1969).
#[must_use]
pub fn husid(motion: &Accelerogram) -> Vec<f64> {
    let factor = std::f64::consts::PI / (2.0 * STANDARD_GRAVITY);
    let mut sum = 0.0;
    let mut curve = vec![0.0];
    for pair in motion.acceleration().windows(2) {
        sum += 0.5 * motion.step() * (pair[0] * pair[0] + pair[1] * pair[1]);
        curve.push(factor * sum);
    }
    curve
}

/// When a rising curve reaches a level, on straight lines.
fn crossing(step: f64, curve: &[f64], level: f64) -> f64 {
    let after = curve
        .partition_point(|value| *value < level)
        .clamp(1, curve.len() - 1);
    let (low, high) = (curve[after - 1], curve[after]);
    let share = if high > low {
        (level - low) / (high - low)
    } else {
        0.0
    };
    step * ((after - 1) as f64 + share.clamp(0.0, 1.0))
}

fn trapezoid(step: f64, values: impl Iterator<Item = f64> + Clone) -> f64 {
    let next = values.clone().skip(1);
    0.5 * step * values.zip(next).map(|(a, b)| a + b).sum::<f64>()
}

fn housner(motion: &Accelerogram) -> Result<f64, MotionFault> {
    let step = 0.02;
    let periods: Vec<f64> = (0..=120).map(|i| 0.1 + step * f64::from(i)).collect();
    let spectrum = response_spectrum(motion, &periods, &[0.05], Reading::Steps)?;
    Ok(trapezoid(
        step,
        spectrum.curves[0].pseudo_velocity.iter().copied(),
    ))
}
