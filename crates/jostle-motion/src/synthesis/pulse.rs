//! Near-fault velocity pulses.

use std::f64::consts::{PI, TAU};

use super::points;
use crate::Accelerogram;
use crate::fault::{MotionFault, within};
use crate::integration;

/// Shape of a pulse.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum PulseShape {
    /// The pulse of Mavroeidis and Papageorgiou.
    Mavroeidis(Mavroeidis),
    /// A cycloidal pulse of Makris.
    Makris(Makris),
}

/// `v = A/2 [1 + cos(2πf t/γ)] cos(2πf t + ν)` for `|t| ≤ γ/(2f)`, t from its centre.
///
/// G. P. Mavroeidis, A. S. Papageorgiou (2003), Bull. Seismol. Soc. Am. 93, 1099–1131, Eq. (3).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Mavroeidis {
    /// Oscillations in the pulse, γ > 1 \[–\].
    pub gamma: f64,
    /// Phase ν \[rad\].
    pub phase: f64,
}

/// Cycloidal pulses: `A`, a forward motion that stays; `B`, forth and back; `C(n)`, n cycles.
///
/// ```text
/// A     v = V/2 (1 − cos ωt),                  0 ≤ t ≤ T
/// B     v = V sin ωt,                          0 ≤ t ≤ T
/// C_n   v = V [sin(ωt + φ) − sin φ],           0 ≤ t ≤ (n + ½ − φ/π) T
/// ```
///
/// N. Makris (1997), Earthquake Engng Struct. Dyn. 26, 571–591. φ is chosen so that the displacement of `C_n` ends
/// at zero: `cos[(2n+1)π − φ] + [(2n+1)π − 2φ] sin φ − cos φ = 0`.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Makris {
    /// Forward.
    A,
    /// Forward and back.
    B,
    /// n cycles, n from 1 to 20.
    C(u32),
}

impl PulseShape {
    /// Length in periods \[–\].
    fn length(&self) -> f64 {
        match self {
            Self::Mavroeidis(pulse) => pulse.gamma,
            Self::Makris(Makris::A | Makris::B) => 1.0,
            Self::Makris(Makris::C(n)) => f64::from(*n) + 0.5 - cycloid_phase(*n) / PI,
        }
    }

    /// Velocity, in units of V, at a phase from the beginning \[rad\].
    fn velocity(&self, theta: f64) -> f64 {
        match self {
            Self::Mavroeidis(Mavroeidis { gamma, phase }) => {
                let x = theta - PI * gamma;
                0.5 * (1.0 + libm::cos(x / gamma)) * libm::cos(x + phase)
            }
            Self::Makris(Makris::A) => 0.5 * (1.0 - libm::cos(theta)),
            Self::Makris(Makris::B) => libm::sin(theta),
            Self::Makris(Makris::C(n)) => {
                let phi = cycloid_phase(*n);
                libm::sin(theta + phi) - libm::sin(phi)
            }
        }
    }

    /// Final displacement, in units of V/ω.
    fn offset(&self) -> f64 {
        match self {
            // Simpson's rule on an entire function over few cycles: exact to rounding.
            Self::Mavroeidis(Mavroeidis { gamma, .. }) => {
                let (parts, end) = (4096, TAU * gamma);
                let weight = |i: i32| match i {
                    0 | 4096 => 1.0,
                    _ if i % 2 == 1 => 4.0,
                    _ => 2.0,
                };
                let h = end / f64::from(parts);
                let sum: f64 = (0..=parts)
                    .map(|i| weight(i) * self.velocity(h * f64::from(i)))
                    .sum();
                sum * h / 3.0
            }
            Self::Makris(Makris::A) => PI,
            Self::Makris(_) => 0.0,
        }
    }

    fn check(&self) -> Result<(), MotionFault> {
        match self {
            Self::Mavroeidis(Mavroeidis { gamma, phase }) => {
                within(
                    "gamma",
                    "above 1 and up to 50",
                    *gamma,
                    *gamma > 1.0 && *gamma <= 50.0,
                )?;
                within("the phase", "a finite number", *phase, true)
            }
            Self::Makris(Makris::C(n)) => {
                let good = (1..=20).contains(n);
                within(
                    "the number of cycles",
                    "between 1 and 20",
                    f64::from(*n),
                    good,
                )
            }
            Self::Makris(_) => Ok(()),
        }
    }
}

/// Smallest positive φ of a pulse `C_n` \[rad\], by bisection: the function is negative at zero, positive at π/6.
fn cycloid_phase(n: u32) -> f64 {
    let whole = (2.0 * f64::from(n) + 1.0) * PI;
    let f =
        |phi: f64| libm::cos(whole - phi) + (whole - 2.0 * phi) * libm::sin(phi) - libm::cos(phi);
    let (mut low, mut high) = (0.0, PI / 6.0);
    for _ in 0..60 {
        let middle = 0.5 * (low + high);
        if f(middle) < 0.0 {
            low = middle;
        } else {
            high = middle;
        }
    }
    0.5 * (low + high)
}

/// A pulse with a peak velocity at its samples, > 0 \[m/s\], and a period, at least ten steps \[s\], after a rest
/// `before` and with a rest `after` it, ≥ 0 \[s\].
///
/// The amplitude A or V of the formula follows from the peak: V for `A` and `B`, peak/(1 + sin φ) for `C(n)`, A for
/// a Mavroeidis pulse with ν = 0. Every sample is the mean acceleration over one step around it, so that jumps take
/// one step and the samples add up to the velocity of the formula. A change below 1 % makes velocity and
/// displacement end exactly as in the formula.
///
/// # Errors
/// [`MotionFault`] when a number is out of range.
pub fn near_fault_pulse(
    shape: &PulseShape,
    velocity: f64,
    period: f64,
    step: f64,
    [before, after]: [f64; 2],
) -> Result<Accelerogram, MotionFault> {
    shape.check()?;
    within("the peak velocity", "above zero", velocity, velocity > 0.0)?;
    within(
        "the period of a pulse",
        "at or above ten steps",
        period,
        period >= 10.0 * step,
    )?;
    let length = shape.length() * period;
    // Half a step of the last sample lies after the end of the pulse.
    let n = points(step, (length / step + 0.5).ceil() * step)?;
    let omega = TAU / period;
    let formula = |t: f64| {
        if (0.0..=length).contains(&t) {
            velocity * shape.velocity(omega * t)
        } else {
            0.0
        }
    };
    let value = |i: usize| {
        let t = step * i as f64;
        (formula(t + 0.5 * step) - formula(t - 0.5 * step)) / step
    };
    let end = [0.0, velocity / omega * shape.offset()];
    let pulse = Accelerogram::new(step, (0..n).map(value).collect())?;
    // The jump at either end begins or ends one step outside.
    let pulse = pulse
        .padded(step, step)?
        .ending_with(end)
        .padded(before, after)?;
    let peak = largest(&integration::velocity(&pulse));
    pulse.scaled(velocity / peak)
}

fn largest(values: &[f64]) -> f64 {
    values
        .iter()
        .fold(0.0, |most: f64, value| most.max(value.abs()))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::integration::{displacement, velocity};

    #[test]
    fn phases_of_cycles_are_those_published() {
        // N. Makris, S.-P. Chang (2000), Earthquake Engng Struct. Dyn. 29, 85–107: 0.0697 π and 0.0410 π.
        assert!(
            (cycloid_phase(1) / PI - 0.0697).abs() < 5e-5,
            "{}",
            cycloid_phase(1) / PI
        );
        assert!(
            (cycloid_phase(2) / PI - 0.0410).abs() < 5e-5,
            "{}",
            cycloid_phase(2) / PI
        );
    }

    const SHAPES: [PulseShape; 8] = [
        PulseShape::Mavroeidis(Mavroeidis {
            gamma: 2.0,
            phase: 0.0,
        }),
        PulseShape::Mavroeidis(Mavroeidis {
            gamma: 1.7,
            phase: 0.6,
        }),
        PulseShape::Mavroeidis(Mavroeidis {
            gamma: 3.0,
            phase: PI,
        }),
        PulseShape::Makris(Makris::A),
        PulseShape::Makris(Makris::B),
        PulseShape::Makris(Makris::C(1)),
        PulseShape::Makris(Makris::C(2)),
        PulseShape::Makris(Makris::C(7)),
    ];

    #[test]
    fn peak_velocities_are_those_asked_for() {
        for shape in SHAPES {
            // Down to the fewest steps in a period.
            for (period, step) in [(2.0, 0.005), (0.83, 0.01), (1.0, 0.1)] {
                let motion = near_fault_pulse(&shape, 0.8, period, step, [1.0, 5.0]).unwrap();
                let peak = largest(&velocity(&motion));
                assert!(
                    (peak - 0.8).abs() < 1e-12,
                    "{shape:?}, T = {period} s, step {step} s: {peak}"
                );
            }
        }
    }

    #[test]
    fn velocities_are_those_of_the_formula() {
        for shape in SHAPES {
            let (peak, period, step) = (0.8, 2.0, 0.005);
            let motion = near_fault_pulse(&shape, peak, period, step, [1.0, 2.0]).unwrap();
            let v = velocity(&motion);
            let omega = TAU / period;
            let end = shape.length() * TAU;
            let greatest = (0..=20_000).fold(0.0_f64, |most, i| {
                most.max(shape.velocity(end * f64::from(i) / 20_000.0).abs())
            });
            let amplitude = peak / greatest;
            let worst = v.iter().enumerate().fold(0.0_f64, |worst, (i, v)| {
                let t = step * i as f64 - 1.0 - step;
                let inside = t >= 0.0 && t <= shape.length() * period;
                let exact = if inside {
                    amplitude * shape.velocity(omega * t)
                } else {
                    0.0
                };
                worst.max((v - exact).abs())
            });
            // Where the acceleration jumps by V ω, the velocity is off by V ω h/4 = 0.0031 m/s at one sample.
            assert!(worst < 0.0035, "{shape:?}: {worst}");
            assert!(v[v.len() - 1].abs() < 1e-9, "{shape:?} ends at rest");
            let end = displacement(&motion)[v.len() - 1];
            let wanted = amplitude / omega * shape.offset();
            assert!((end - wanted).abs() < 1e-4, "{shape:?}: {end} for {wanted}");
        }
    }
}
