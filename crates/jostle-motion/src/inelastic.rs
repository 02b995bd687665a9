//! Inelastic spectra of constant ductility.
//!
//! A bilinear oscillator of unit mass: stiffness ω² until the displacement u_y, then αω² with kinematic hardening;
//! viscous damping 2ζω throughout. Steps of at most a two-hundredth of the period by Newmark's method with constant
//! average acceleration; within a step the bilinear force is solved exactly, because its two branches are straight.

use crate::Accelerogram;
use crate::fault::{MotionFault, within};
use crate::oscillator::Oscillator;
use crate::peaks::peak_responses;

/// Strengths that hold the ductility at given values.
#[derive(Clone, Debug, PartialEq)]
pub struct DuctilitySpectrum {
    /// Natural periods of small vibration \[s\].
    pub periods: Vec<f64>,
    /// Ductility μ = peak displacement over u_y \[–\].
    pub ductility: f64,
    /// Pseudo-acceleration at yield, ω² u_y: base shear at yield per mass \[m/s²\].
    pub yield_acceleration: Vec<f64>,
    /// Elastic pseudo-acceleration over it: the strength reduction factor \[–\].
    pub reduction: Vec<f64>,
    /// Peak displacement μ u_y \[m\].
    pub displacement: Vec<f64>,
}

/// Steps per period.
const STEPS_PER_PERIOD: f64 = 200.0;
/// Ratio of neighbouring strengths on the way down.
const DOWN: f64 = 0.93;
/// Smallest strength tried, of the elastic one \[–\].
const WEAKEST: f64 = 1e-4;

/// The largest strength, at or below the elastic one, with which the ductility is reached.
///
/// Ductility may rise and fall with strength; the largest strength counts (A. K. Chopra, Dynamics of Structures,
/// section 7.5.3). Periods lie between 0.01 and 100 s, ductility between 1 and 50, damping in `0..1`, the ratio of
/// post-yield stiffness α in `0..1`. Where even a ten-thousandth of the elastic strength does not reach the
/// ductility, the values are NaN.
///
/// # Errors
/// [`MotionFault`] when a number is out of range or the motion is zero throughout.
pub fn ductility_spectrum(
    motion: &Accelerogram,
    periods: &[f64],
    ductility: f64,
    damping: f64,
    post_yield: f64,
) -> Result<DuctilitySpectrum, MotionFault> {
    within(
        "the ductility",
        "between 1 and 50",
        ductility,
        (1.0..=50.0).contains(&ductility),
    )?;
    within(
        "a damping ratio",
        "from 0 to below 1",
        damping,
        (0.0..1.0).contains(&damping),
    )?;
    within(
        "the post-yield ratio",
        "from 0 to below 1",
        post_yield,
        (0.0..1.0).contains(&post_yield),
    )?;
    if motion.peak() == 0.0 {
        return Err(MotionFault::Zero);
    }
    let mut spectrum = DuctilitySpectrum {
        periods: periods.to_vec(),
        ductility,
        yield_acceleration: Vec::new(),
        reduction: Vec::new(),
        displacement: Vec::new(),
    };
    for &period in periods {
        within(
            "a period",
            "between 0.01 and 100 s",
            period,
            (0.01..=100.0).contains(&period),
        )?;
        let oscillator = Oscillator { period, damping };
        let elastic = peak_responses(motion, &[oscillator])[0]
            .pseudo_acceleration
            .value
            .abs();
        let share = strength(motion, &oscillator, post_yield, elastic, ductility);
        let omega = oscillator.circular_frequency();
        spectrum.yield_acceleration.push(share * elastic);
        spectrum.reduction.push(1.0 / share);
        spectrum
            .displacement
            .push(ductility * share * elastic / (omega * omega));
    }
    Ok(spectrum)
}

/// Strength over the elastic one; NaN if there is none.
fn strength(
    motion: &Accelerogram,
    oscillator: &Oscillator,
    post_yield: f64,
    elastic: f64,
    ductility: f64,
) -> f64 {
    if ductility == 1.0 {
        return 1.0;
    }
    let omega2 = oscillator.circular_frequency().powi(2);
    let demand = |share: f64| {
        let at_yield = share * elastic / omega2;
        peak_displacement(motion, oscillator, post_yield, at_yield) / at_yield
    };
    let mut high = 1.0;
    let mut low = DOWN;
    while demand(low) < ductility {
        high = low;
        low *= DOWN;
        if low < WEAKEST {
            return f64::NAN;
        }
    }
    for _ in 0..24 {
        let middle = 0.5 * (low + high);
        if demand(middle) < ductility {
            high = middle;
        } else {
            low = middle;
        }
    }
    0.5 * (low + high)
}

/// Peak displacement of a bilinear oscillator that yields at a displacement `at_yield`, both relative to the ground \[m\].
///
/// The period is that of small vibration, between 0.01 and 100 s, the damping lies in `0..1`, the ratio of post-yield
/// stiffness in `0..1`.
///
/// # Errors
/// [`MotionFault`] when a number is out of range.
pub fn bilinear_displacement(
    motion: &Accelerogram,
    oscillator: &Oscillator,
    post_yield: f64,
    at_yield: f64,
) -> Result<f64, MotionFault> {
    let (period, damping) = (oscillator.period, oscillator.damping);
    within(
        "a period",
        "between 0.01 and 100 s",
        period,
        (0.01..=100.0).contains(&period),
    )?;
    within(
        "a damping ratio",
        "from 0 to below 1",
        damping,
        (0.0..1.0).contains(&damping),
    )?;
    within(
        "the post-yield ratio",
        "from 0 to below 1",
        post_yield,
        (0.0..1.0).contains(&post_yield),
    )?;
    within(
        "the displacement at yield",
        "above zero",
        at_yield,
        at_yield > 0.0 && at_yield.is_finite(),
    )?;
    Ok(peak_displacement(motion, oscillator, post_yield, at_yield))
}

/// Peak displacement of a bilinear oscillator that yields at a displacement \[m\].
#[must_use]
pub(crate) fn peak_displacement(
    motion: &Accelerogram,
    oscillator: &Oscillator,
    post_yield: f64,
    at_yield: f64,
) -> f64 {
    let (h0, values) = (motion.step(), motion.acceleration());
    let parts = (h0 * STEPS_PER_PERIOD / oscillator.period).ceil().max(1.0) as usize;
    let h = h0 / parts as f64;
    let omega = oscillator.circular_frequency();
    let (k, c) = (omega * omega, 2.0 * oscillator.damping * omega);
    let inertia = 4.0 / (h * h) + 2.0 * c / h;
    // Force = α k u + (1 − α) k z, with |z| ≤ u_y.
    let (soft, stiff) = (inertia + post_yield * k, inertia + k);
    let hidden = (1.0 - post_yield) * k;
    let (mut u, mut v, mut a, mut z) = (0.0_f64, 0.0, -values[0], 0.0_f64);
    let mut peak = 0.0_f64;
    for pair in values.windows(2) {
        let change = (pair[1] - pair[0]) / parts as f64;
        for part in 1..=parts {
            let ground = pair[0] + change * part as f64;
            let load = -ground + (4.0 / (h * h)) * u + (4.0 / h) * v + a + c * (2.0 / h * u + v);
            // Either z follows u, or it stays at its limit.
            let trial = (load - hidden * (z - u)) / stiff;
            let moved = z + trial - u;
            let next = if moved.abs() <= at_yield {
                z = moved;
                trial
            } else {
                z = at_yield.copysign(moved);
                (load - hidden * z) / soft
            };
            let speed = 2.0 / h * (next - u) - v;
            a = 4.0 / (h * h) * (next - u) - 4.0 / h * v - a;
            (u, v) = (next, speed);
            peak = peak.max(u.abs());
        }
    }
    peak
}

#[cfg(test)]
mod tests {
    use super::*;

    fn shaking() -> Accelerogram {
        let value = |i: i32| {
            let t = 0.01 * f64::from(i);
            (-((t - 6.0) / 3.0).powi(2)).exp() * ((9.0 * t).sin() + 0.7 * (23.0 * t).cos()) * 3.0
        };
        Accelerogram::new(0.01, (0..1500).map(value).collect()).unwrap()
    }

    /// Fourth-order Runge–Kutta with tiny steps and the force as a differential equation knows nothing of Newmark's
    /// method.
    fn by_runge_kutta(motion: &Accelerogram, period: f64, z: f64, alpha: f64, uy: f64) -> f64 {
        let w = std::f64::consts::TAU / period;
        let (mut u, mut v, mut s, mut peak) = (0.0_f64, 0.0_f64, 0.0_f64, 0.0_f64);
        let parts = 400;
        let h = motion.step() / f64::from(parts);
        for pair in motion.acceleration().windows(2) {
            for part in 0..parts {
                let ground = |x: f64| {
                    pair[0] + (pair[1] - pair[0]) * (f64::from(part) + x) / f64::from(parts)
                };
                let rate = |[u, v, s]: [f64; 3], x: f64| {
                    let slips = s.abs() >= uy && s * v > 0.0;
                    let force = alpha * w * w * u + (1.0 - alpha) * w * w * s;
                    [
                        v,
                        -ground(x) - 2.0 * z * w * v - force,
                        if slips { 0.0 } else { v },
                    ]
                };
                let add = |y: [f64; 3], k: [f64; 3], f: f64| [0, 1, 2].map(|i| y[i] + f * k[i]);
                let y = [u, v, s];
                let k1 = rate(y, 0.0);
                let k2 = rate(add(y, k1, h / 2.0), 0.5);
                let k3 = rate(add(y, k2, h / 2.0), 0.5);
                let k4 = rate(add(y, k3, h), 1.0);
                [u, v, s] =
                    [0, 1, 2].map(|i| y[i] + h / 6.0 * (k1[i] + 2.0 * (k2[i] + k3[i]) + k4[i]));
                s = s.clamp(-uy, uy);
                peak = peak.max(u.abs());
            }
        }
        peak
    }

    #[test]
    fn runge_and_kutta_agree() {
        let motion = shaking();
        for (period, z, alpha, uy) in [
            (0.5, 0.05, 0.0, 0.01),
            (1.0, 0.02, 0.1, 0.02),
            (0.2, 0.0, 0.05, 0.003),
        ] {
            let ours = peak_displacement(&motion, &Oscillator { period, damping: z }, alpha, uy);
            let theirs = by_runge_kutta(&motion, period, z, alpha, uy);
            // Newmark's method with 200 steps in a period lengthens it by (2π/200)²/12 = 1e-4.
            assert!(
                (ours / theirs - 1.0).abs() < 4e-3,
                "T = {period}: {ours} for {theirs}"
            );
        }
    }

    #[test]
    fn the_ductility_asked_for_is_reached() {
        let motion = shaking();
        let periods = [0.1, 0.3, 0.7, 1.5];
        for ductility in [1.0, 2.0, 6.0] {
            let spectrum = ductility_spectrum(&motion, &periods, ductility, 0.05, 0.02).unwrap();
            for (k, &period) in periods.iter().enumerate() {
                let oscillator = Oscillator {
                    period,
                    damping: 0.05,
                };
                let at_yield =
                    spectrum.yield_acceleration[k] / oscillator.circular_frequency().powi(2);
                let found = peak_displacement(&motion, &oscillator, 0.02, at_yield) / at_yield;
                assert!(
                    (found / ductility - 1.0).abs() < 2e-3,
                    "T = {period}: {found}"
                );
                assert!(spectrum.reduction[k] >= 1.0);
            }
        }
    }

    #[test]
    fn a_suddenly_applied_acceleration_has_its_closed_form() {
        // A suddenly applied acceleration a, elastic: ω²u = 2a. Yielding at f: the work a u_m equals ½ f u_y +
        // f (u_m − u_y), so that f = a μ/(μ − ½).
        let motion = Accelerogram::new(0.01, vec![1.0; 3000]).unwrap();
        for ductility in [1.5, 2.0, 5.0] {
            let spectrum = ductility_spectrum(&motion, &[1.0], ductility, 0.0, 0.0).unwrap();
            let exact = ductility / (ductility - 0.5);
            let error = spectrum.yield_acceleration[0] / exact - 1.0;
            assert!(error.abs() < 1e-3, "μ = {ductility}: {error}");
        }
    }
}
