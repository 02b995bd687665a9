//! Accelerations at instants that are not equally spaced, such as those of a floor, and their response spectra.
//!
//! Rows of a simulation are close together in contact and far apart in free vibration. Between two rows the acceleration is
//! taken as a straight line. The velocity of the floor is known as well; what the line misses of its change,
//!
//! ```text
//! J = Δv − h (a₀ + a₁)/2                                                            (1)
//! ```
//!
//! acts as an impulse, half of it at either end of the interval. So the momentum that a floor transfers is exact, also if its
//! velocity jumps. For a smooth acceleration the impulses remove the leading error of the line: the error of the response is of
//! fourth order in h instead of second. The oscillators move exactly under both, by Eq. (3) of `oscillator`.

use crate::Accelerogram;
use crate::fault::MotionFault;
use crate::oscillator::{Advance, Oscillator};
use crate::spectrum::{ResponseSpectrum, check_ranges, curve};

/// Oscillators that are advanced together.
const LANES: usize = 8;
/// Least number of parts of an interval in a period.
const PARTS_PER_PERIOD: f64 = 20.0;
/// Oscillators that would need more parts of the longest interval follow the acceleration as if they were rigid.
const MOST_PARTS: f64 = 10_000.0;
/// Lengths of intervals whose coefficients are kept.
const KEPT: usize = 24;
/// Relative difference of lengths that share coefficients \[–\].
const SAME_LENGTH: f64 = 1e-9;

/// Acceleration of a point over time, with straight lines between instants and impulses in the intervals.
#[derive(Clone, Debug, PartialEq)]
pub struct UnevenMotion {
    time: Vec<f64>,
    acceleration: Vec<f64>,
    /// One fewer than instants \[m/s\].
    impulse: Vec<f64>,
}

impl UnevenMotion {
    /// A motion from its instants \[s\], which do not decrease, and as many finite accelerations \[m/s²\], at least two.
    ///
    /// # Errors
    /// [`MotionFault`] when a number is not usable.
    pub fn new(time: Vec<f64>, acceleration: Vec<f64>) -> Result<Self, MotionFault> {
        let impulse = vec![0.0; time.len().saturating_sub(1)];
        Self::checked(time, acceleration, impulse)
    }

    /// A motion whose change of velocity is known: impulses follow from Eq. (1). `acceleration` \[m/s²\] is the total one,
    /// `velocity` \[m/s\] is relative to a ground with the acceleration `ground` \[m/s²\].
    ///
    /// # Errors
    /// [`MotionFault`] when a number is not usable, or when the lists differ in length.
    pub fn with_velocity(
        time: Vec<f64>,
        acceleration: Vec<f64>,
        velocity: &[f64],
        ground: &[f64],
    ) -> Result<Self, MotionFault> {
        let impulse = (1..time.len().min(acceleration.len()))
            .map(|i| {
                let relative =
                    |i: usize| acceleration[i] - ground.get(i).copied().unwrap_or(f64::NAN);
                let line = 0.5 * (time[i] - time[i - 1]) * (relative(i - 1) + relative(i));
                let velocity = |i: usize| velocity.get(i).copied().unwrap_or(f64::NAN);
                velocity(i) - velocity(i - 1) - line
            })
            .collect();
        Self::checked(time, acceleration, impulse)
    }

    fn checked(
        time: Vec<f64>,
        acceleration: Vec<f64>,
        impulse: Vec<f64>,
    ) -> Result<Self, MotionFault> {
        if time.len() < 2 || acceleration.len() != time.len() {
            return Err(MotionFault::TooFew {
                found: acceleration.len().min(time.len()),
            });
        }
        let usable = |i: usize| {
            time[i].is_finite()
                && acceleration[i].is_finite()
                && (i == 0 || time[i] >= time[i - 1] && impulse[i - 1].is_finite())
        };
        if let Some(index) = (0..time.len()).find(|i| !usable(*i)) {
            return Err(MotionFault::NotFinite { index });
        }
        Ok(Self {
            time,
            acceleration,
            impulse,
        })
    }

    /// Greatest magnitude of the acceleration at the instants, impulses not included \[m/s²\].
    #[must_use]
    pub fn peak(&self) -> f64 {
        let values = self.acceleration.iter();
        values.fold(0.0, |peak: f64, a| peak.max(a.abs()))
    }

    /// The same with every second instant and the same changes of velocity: to see what the spacing of instants does.
    #[must_use]
    pub fn every_second(&self) -> Self {
        let last = self.time.len() - 1;
        let kept: Vec<usize> = (0..=last).filter(|i| i % 2 == 0 || *i == last).collect();
        let impulse = kept.windows(2).map(|pair| {
            let exact: f64 = (pair[0]..pair[1]).map(|i| self.change(i)).sum();
            let ends = self.acceleration[pair[0]] + self.acceleration[pair[1]];
            exact - 0.5 * (self.time[pair[1]] - self.time[pair[0]]) * ends
        });
        Self {
            time: kept.iter().map(|i| self.time[*i]).collect(),
            acceleration: kept.iter().map(|i| self.acceleration[*i]).collect(),
            impulse: impulse.collect(),
        }
    }

    /// Change of velocity in an interval \[m/s\].
    fn change(&self, interval: usize) -> f64 {
        let length = self.time[interval + 1] - self.time[interval];
        0.5 * length * (self.acceleration[interval] + self.acceleration[interval + 1])
            + self.impulse[interval]
    }

    /// Equally spaced means of the acceleration over one `step` \[s\] around every instant, by exact integration: short
    /// peaks and impulses keep their change of velocity, and nothing moves in time. A frequency f is reduced to
    /// sin(πf step)/(πf step). The first and the last mean cover half a step.
    ///
    /// # Errors
    /// [`MotionFault`] when the step is not positive or makes too many values.
    pub fn averaged(&self, step: f64) -> Result<Accelerogram, MotionFault> {
        if !(step.is_finite() && step > 0.0) {
            return Err(MotionFault::Step { step });
        }
        let (first, last) = (self.time[0], self.time[self.time.len() - 1]);
        let points = ((last - first) / step).floor() + 1.0;
        crate::accelerogram::check_points(points)?;
        let mut integral = Integral::new(self);
        let mut before = (first, 0.0);
        let mut means = Vec::with_capacity(points as usize);
        for index in 0..points as usize {
            let end = (first + (index as f64 + 0.5) * step).min(last);
            let velocity = integral.until(end);
            let width = end - before.0;
            let mean = if width > 0.0 {
                (velocity - before.1) / width
            } else {
                self.acceleration[self.acceleration.len() - 1]
            };
            means.push(mean);
            before = (end, velocity);
        }
        Accelerogram::new(step, means)
    }
}

/// The velocity that a motion has gained since its beginning.
struct Integral<'a> {
    motion: &'a UnevenMotion,
    interval: usize,
    velocity: f64,
}

impl<'a> Integral<'a> {
    fn new(motion: &'a UnevenMotion) -> Self {
        Self {
            motion,
            interval: 0,
            velocity: 0.0,
        }
    }

    /// Velocity gained until an instant, not before those asked for earlier \[m/s\].
    fn until(&mut self, time: f64) -> f64 {
        let motion = self.motion;
        while self.interval < motion.impulse.len() && motion.time[self.interval + 1] <= time {
            self.velocity += motion.change(self.interval);
            self.interval += 1;
        }
        let i = self.interval;
        if i == motion.impulse.len() {
            return self.velocity;
        }
        let (length, passed) = (motion.time[i + 1] - motion.time[i], time - motion.time[i]);
        let (a0, a1) = (motion.acceleration[i], motion.acceleration[i + 1]);
        // Impulses are spread over their interval, for the sum of both halves to arrive at its end.
        let share = passed / length;
        self.velocity + passed * (a0 + 0.5 * share * (a1 - a0)) + share * motion.impulse[i]
    }
}

/// Response spectra of a motion at unequal instants: peaks within the motion, between instants too.
///
/// Periods must be ≥ 0 \[s\] (0 is the rigid oscillator: PSA and SA are the peak of the acceleration), damping ratios in
/// `0..1` \[–\]. Free vibration after the last instant is not included.
///
/// # Errors
/// [`MotionFault::Range`] for a period or damping ratio out of range.
pub fn uneven_spectrum(
    motion: &UnevenMotion,
    periods: &[f64],
    dampings: &[f64],
) -> Result<ResponseSpectrum, MotionFault> {
    check_ranges(periods, dampings)?;
    let longest = motion.time.windows(2).map(|pair| pair[1] - pair[0]);
    let longest = longest.fold(0.0, f64::max);
    let oscillators: Vec<Oscillator> = dampings
        .iter()
        .flat_map(|&damping| {
            let of = move |&period| Oscillator { period, damping };
            periods.iter().map(of)
        })
        .collect();
    let mut peaks = vec![[motion.peak(); 2]; oscillators.len()];
    let mut order: Vec<usize> = (0..oscillators.len()).collect();
    order.retain(|&i| longest * PARTS_PER_PERIOD <= MOST_PARTS * oscillators[i].period);
    // Neighbours in this order need about the same number of parts.
    order.sort_by(|&i, &j| oscillators[j].period.total_cmp(&oscillators[i].period));
    let arch = pulp::Arch::new();
    for group in order.chunks(LANES) {
        let chosen: [Oscillator; LANES] =
            std::array::from_fn(|lane| oscillators[group[lane.min(group.len() - 1)]]);
        let mut sweep = Sweep::new(motion, &chosen);
        arch.dispatch(Pass(&mut sweep));
        for (lane, &i) in group.iter().enumerate() {
            peaks[i] = [sweep.pseudo[lane], sweep.total[lane]];
        }
    }
    let curves = dampings.iter().enumerate().map(|(i, &damping)| {
        let peaks = &peaks[i * periods.len()..(i + 1) * periods.len()];
        curve(damping, periods, peaks)
    });
    Ok(ResponseSpectrum {
        periods: periods.to_vec(),
        curves: curves.collect(),
    })
}

/// Coefficients for parts of an interval of one length.
#[derive(Clone)]
struct Coefficients {
    length: f64,
    parts: usize,
    a: [f64; LANES],
    b: [f64; LANES],
    d: [f64; LANES],
    /// `p` and `q` of [`Advance`] over the phase of a part, to stand before the change of acceleration in it.
    p: [f64; LANES],
    q: [f64; LANES],
    theta: [f64; LANES],
}

impl Coefficients {
    fn new(oscillators: &[Oscillator; LANES], length: f64) -> Self {
        let shortest = oscillators.iter().map(|o| o.period);
        let shortest = shortest.fold(f64::INFINITY, f64::min);
        let parts = (length * PARTS_PER_PERIOD / shortest).ceil().max(1.0);
        let theta = oscillators.map(|o| o.circular_frequency() * length / parts);
        let advance: [Advance; LANES] =
            std::array::from_fn(|l| Advance::over(theta[l], oscillators[l].damping));
        Self {
            length,
            parts: parts as usize,
            a: advance.map(|one| one.a),
            b: advance.map(|one| one.b),
            d: advance.map(|one| one.d),
            p: std::array::from_fn(|l| advance[l].p / theta[l]),
            q: std::array::from_fn(|l| advance[l].q / theta[l]),
            theta,
        }
    }
}

/// Oscillators on their way through a motion.
struct Sweep<'a> {
    motion: &'a UnevenMotion,
    oscillators: &'a [Oscillator; LANES],
    omega: [f64; LANES],
    /// 2ζ.
    z2: [f64; LANES],
    x: [f64; LANES],
    v: [f64; LANES],
    pseudo: [f64; LANES],
    total: [f64; LANES],
    kept: Vec<Coefficients>,
    /// The coefficients that are replaced next.
    oldest: usize,
}

/// A pass through the motion, compiled for every register width.
struct Pass<'s, 'a>(&'s mut Sweep<'a>);

impl pulp::WithSimd for Pass<'_, '_> {
    type Output = ();

    #[inline(always)]
    fn with_simd<S: pulp::Simd>(self, _: S) {
        self.0.run();
    }
}

impl<'a> Sweep<'a> {
    fn new(motion: &'a UnevenMotion, oscillators: &'a [Oscillator; LANES]) -> Self {
        Self {
            motion,
            oscillators,
            omega: oscillators.map(|o| o.circular_frequency()),
            z2: oscillators.map(|o| 2.0 * o.damping),
            // At rest u = u̇ = 0, but x = a.
            x: [motion.acceleration[0]; LANES],
            v: [0.0; LANES],
            pseudo: [0.0; LANES],
            total: [0.0; LANES],
            kept: Vec::with_capacity(KEPT),
            oldest: 0,
        }
    }

    #[inline(always)]
    fn run(&mut self) {
        let motion = self.motion;
        for (i, impulse) in motion.impulse.iter().enumerate() {
            let (a0, a1) = (motion.acceleration[i], motion.acceleration[i + 1]);
            let length = motion.time[i + 1] - motion.time[i];
            self.strike(0.5 * impulse, a0);
            if length > 0.0 {
                let place = self.coefficients(length);
                // Not borrowed, because the state of the same oscillators changes.
                let coefficients = self.kept[place].clone();
                self.advance(&coefficients, a0, a1);
            } else {
                self.x.iter_mut().for_each(|x| *x += a1 - a0);
            }
            self.strike(0.5 * impulse, a1);
        }
    }

    /// A sudden change of the velocity of the floor.
    #[inline(always)]
    fn strike(&mut self, impulse: f64, acceleration: f64) {
        for l in 0..LANES {
            self.v[l] -= self.omega[l] * impulse;
            let y = self.x[l] - acceleration;
            let w = (y + self.z2[l] * self.v[l]).abs();
            let y = y.abs();
            self.pseudo[l] = if y > self.pseudo[l] {
                y
            } else {
                self.pseudo[l]
            };
            self.total[l] = if w > self.total[l] { w } else { self.total[l] };
        }
    }

    /// Where the coefficients of a length are kept; steps of a grid differ in their last digits only.
    fn coefficients(&mut self, length: f64) -> usize {
        let same = |known: &Coefficients| (known.length - length).abs() <= SAME_LENGTH * length;
        if let Some(place) = self.kept.iter().position(same) {
            return place;
        }
        let new = Coefficients::new(self.oscillators, length);
        if self.kept.len() < KEPT {
            self.kept.push(new);
            return self.kept.len() - 1;
        }
        let place = self.oldest;
        self.kept[place] = new;
        self.oldest = (place + 1) % KEPT;
        place
    }

    /// Through one interval, with peaks of the cubic through values and slopes at the ends of its parts.
    #[inline(always)]
    fn advance(&mut self, c: &Coefficients, a0: f64, a1: f64) {
        let change = (a1 - a0) / c.parts as f64;
        for part in 0..c.parts {
            let (from, to) = (a0 + part as f64 * change, a0 + (part + 1) as f64 * change);
            let (x, v) = (self.x, self.v);
            let mut values = [[0.0; LANES]; 4];
            let mut slopes = [[0.0; LANES]; 4];
            for l in 0..LANES {
                let z2 = self.z2[l];
                let nx = c.a[l] * x[l] + c.b[l] * v[l] + c.p[l] * change;
                let nv = c.d[l] * v[l] - c.b[l] * x[l] + c.q[l] * change;
                self.x[l] = nx;
                self.v[l] = nv;
                let (y0, y1) = (x[l] - from, nx - to);
                values[0][l] = y0;
                values[1][l] = y1;
                values[2][l] = y0 + z2 * v[l];
                values[3][l] = y1 + z2 * nv;
                slopes[0][l] = v[l];
                slopes[1][l] = nv;
                slopes[2][l] = v[l] - z2 * (x[l] + z2 * v[l]);
                slopes[3][l] = nv - z2 * (nx + z2 * nv);
                let (y, w) = (y1.abs(), values[3][l].abs());
                self.pseudo[l] = if y > self.pseudo[l] {
                    y
                } else {
                    self.pseudo[l]
                };
                self.total[l] = if w > self.total[l] { w } else { self.total[l] };
            }
            for l in 0..LANES {
                for (first, greatest) in [(0, &mut self.pseudo[l]), (2, &mut self.total[l])] {
                    let ends = [values[first][l], values[first + 1][l]];
                    let slopes = [slopes[first][l], slopes[first + 1][l]];
                    let near = ends[0].abs().max(ends[1].abs()) > NEAR * *greatest;
                    if near && slopes[0] * slopes[1] < 0.0 {
                        *greatest = greatest.max(between(ends, slopes, c.theta[l]).abs());
                    }
                }
            }
        }
    }
}

/// Part of the greatest value until then from which on a peak between two ends can exceed it: over a twentieth of a period
/// a cosine falls to 0.95 of its peak \[–\].
const NEAR: f64 = 0.9;

/// The extreme of the cubic with these values and slopes at its ends, whose slopes have opposite signs.
fn between(values: [f64; 2], slopes: [f64; 2], width: f64) -> f64 {
    let (m0, m1) = (slopes[0] * width, slopes[1] * width);
    let rise = values[1] - values[0];
    // y(s) = y₀ + m₀ s + c₂ s² + c₃ s³, y′(0) = m₀ and y′(1) = m₁ of opposite signs: one zero of y′ in 0..1.
    let (c2, c3) = (3.0 * rise - 2.0 * m0 - m1, m0 + m1 - 2.0 * rise);
    let root = (c2 * c2 - 3.0 * c3 * m0).max(0.0).sqrt();
    let q = -(c2 + root.copysign(c2));
    let candidates = [m0 / q, q / (3.0 * c3)];
    let inside = candidates.into_iter().find(|s| (0.0..=1.0).contains(s));
    let s = inside.unwrap_or(m0 / (m0 - m1));
    values[0] + s * (m0 + s * (c2 + s * c3))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{Reading, response_spectrum};

    /// Equal steps give the spectrum of the recursion for equal steps, which reads its peaks in another way.
    #[test]
    fn equal_steps_agree_with_the_spectrum_of_an_accelerogram() {
        let step = 0.01;
        let values: Vec<f64> = (0..600)
            .map(|i| {
                let t = step * f64::from(i);
                (7.0 * t).sin() * (0.3 + t).ln() + 0.4 * (31.0 * t).cos()
            })
            .collect();
        let time = (0..600).map(|i| step * f64::from(i)).collect();
        let uneven = UnevenMotion::new(time, values.clone()).expect("usable");
        let even = Accelerogram::new(step, values).expect("usable");
        let periods = [0.0, 0.03, 0.05, 0.1, 0.2, 0.5, 0.9, 2.0, 4.0];
        let dampings = [0.0, 0.02, 0.05, 0.3];
        let found = uneven_spectrum(&uneven, &periods, &dampings).expect("in range");
        let known =
            response_spectrum(&even, &periods, &dampings, Reading::Between).expect("in range");
        for (a, b) in found.curves.iter().zip(&known.curves) {
            for i in 0..periods.len() {
                for (a, b) in [
                    (a.pseudo_acceleration[i], b.pseudo_acceleration[i]),
                    (a.total_acceleration[i], b.total_acceleration[i]),
                ] {
                    // A cubic over a twentieth of a period is within (2π/20)⁴/384 of a sine.
                    assert!((a / b - 1.0).abs() < 3e-5, "T = {} s: {a} {b}", periods[i]);
                }
            }
        }
    }

    /// Duhamel: a jump of the velocity of the support by J starts free vibration u = −(J/ω_d) e^{−ζωt} sin ω_d t.
    #[test]
    fn a_jump_of_velocity_starts_free_vibration() {
        let jump = 0.7;
        // The floor stands, moves at constant speed from the tenth row on, and stays without acceleration.
        let time: Vec<f64> = (0..2000).map(|i| 0.002 * f64::from(i)).collect();
        let rest = vec![0.0; time.len()];
        let velocity: Vec<f64> = (0..2000).map(|i| if i < 10 { 0.0 } else { jump }).collect();
        let motion =
            UnevenMotion::with_velocity(time, rest.clone(), &velocity, &rest).expect("usable");
        let periods = [0.05, 0.2, 1.0];
        for zeta in [0.0, 0.05, 0.2] {
            let found = uneven_spectrum(&motion, &periods, &[zeta]).expect("in range");
            for (period, got) in periods.iter().zip(&found.curves[0].pseudo_acceleration) {
                let omega = std::f64::consts::TAU / period;
                let root = (1.0_f64 - zeta * zeta).sqrt();
                // The first peak of the sine: tan ω_d t = √(1−ζ²)/ζ.
                let at = (root / zeta).atan() / (omega * root);
                let peak = omega * omega * jump / (omega * root)
                    * (-zeta * omega * at).exp()
                    * (omega * root * at).sin();
                // The jump is spread over an interval of 2 ms, half at either end: cos(ωh/2) ≈ 1 − (ωh)²/8.
                let spread = (omega * 0.002_f64).powi(2) / 8.0;
                assert!(
                    (got / peak - 1.0).abs() < 1.2 * spread + 1e-4,
                    "{period} {zeta}: {got} {peak}"
                );
            }
        }
    }

    /// Halving the spacing of a smooth acceleration divides the error by four, and by sixteen if the velocity is known.
    #[test]
    fn the_error_of_a_smooth_motion_is_of_fourth_order_with_velocities() {
        let period = 0.1;
        let omega = 40.0;
        let exact = |t: f64| (omega * t).sin() * (1.0 - (-3.0 * t).exp());
        let velocity = |t: f64| {
            // ∫ (1 − e^{−3t}) sin ωt dt
            let w = omega;
            -(w * t).cos() / w
                + 1.0 / w
                + ((-3.0 * t).exp() * (3.0 * (w * t).sin() + w * (w * t).cos()) - w) / (9.0 + w * w)
        };
        let spectrum = |rows: usize, known: bool| {
            // Unequal rows: their lengths go up and down by a third.
            let at = |i: usize| {
                let share = i as f64 / rows as f64;
                2.0 * (share
                    + (0.33 / std::f64::consts::TAU / 8.0)
                        * (std::f64::consts::TAU * 8.0 * share).sin())
            };
            let time: Vec<f64> = (0..=rows).map(at).collect();
            let total: Vec<f64> = time.iter().map(|t| exact(*t)).collect();
            let v: Vec<f64> = time.iter().map(|t| velocity(*t)).collect();
            let ground = vec![0.0; time.len()];
            let motion = match known {
                true => UnevenMotion::with_velocity(time, total, &v, &ground),
                false => UnevenMotion::new(time, total),
            };
            let motion = motion.expect("usable");
            let found = uneven_spectrum(&motion, &[period], &[0.05]).expect("in range");
            found.curves[0].pseudo_acceleration[0]
        };
        let best = spectrum(64_000, true);
        for (known, order, first) in [(false, 4.0, 1e-2), (true, 16.0, 3e-5)] {
            let errors: Vec<f64> = [500, 1000, 2000]
                .iter()
                .map(|rows| (spectrum(*rows, known) / best - 1.0).abs())
                .collect();
            assert!(errors[0] < first, "{known}: {errors:?}");
            for pair in errors.windows(2) {
                let ratio = pair[0] / pair[1] / order;
                assert!((0.8..1.25).contains(&ratio), "{known}: {errors:?}");
            }
        }
    }

    /// Half the instants, and the same changes of velocity.
    #[test]
    fn every_second_instant_keeps_the_change_of_velocity() {
        let time: Vec<f64> = (0..101)
            .map(|i| 0.01 * f64::from(i) + 0.002 * f64::from(i % 3))
            .collect();
        let values: Vec<f64> = time.iter().map(|t| (9.0 * t).sin()).collect();
        let motion = UnevenMotion::new(time, values).expect("usable");
        let coarse = motion.every_second();
        assert_eq!(coarse.time.len(), 51);
        let sum = |motion: &UnevenMotion| {
            (0..motion.impulse.len())
                .map(|i| motion.change(i))
                .sum::<f64>()
        };
        assert!((sum(&motion) - sum(&coarse)).abs() < 1e-13);
    }

    /// The mean of a sine over a step is the sine times sin(πf h)/(πf h), and an impulse keeps its change of velocity.
    #[test]
    fn means_keep_phase_and_change_of_velocity() {
        let (f, h) = (5.0, 0.02);
        let time: Vec<f64> = (0..20_001).map(|i| 1e-4 * f64::from(i)).collect();
        let values: Vec<f64> = time
            .iter()
            .map(|t| (std::f64::consts::TAU * f * t).sin())
            .collect();
        let motion = UnevenMotion::new(time, values).expect("usable");
        let means = motion.averaged(h).expect("usable");
        let gain = (std::f64::consts::PI * f * h).sin() / (std::f64::consts::PI * f * h);
        for (i, got) in means.acceleration().iter().enumerate().skip(1).take(95) {
            let known = gain * (std::f64::consts::TAU * f * h * i as f64).sin();
            assert!((got - known).abs() < 1e-5, "{i}: {got} {known}");
        }
        let rows: Vec<f64> = (0..101).map(|i| 0.01 * f64::from(i)).collect();
        let none = vec![0.0; 101];
        let jump: Vec<f64> = (0..101).map(|i| if i < 40 { 0.0 } else { 0.3 }).collect();
        let struck = UnevenMotion::with_velocity(rows, none.clone(), &jump, &none).expect("usable");
        let means = struck.averaged(0.004).expect("usable");
        let gained: f64 = means.acceleration().iter().map(|a| 0.004 * a).sum();
        assert!((gained - 0.3).abs() < 1e-12, "{gained}");
    }

    #[test]
    fn unusable_motions_are_refused() {
        for (time, values) in [
            (vec![0.0], vec![0.0]),
            (vec![0.0, 1.0], vec![0.0]),
            (vec![1.0, 0.0], vec![0.0, 0.0]),
            (vec![0.0, 1.0], vec![0.0, f64::NAN]),
        ] {
            assert!(UnevenMotion::new(time, values).is_err());
        }
    }
}
