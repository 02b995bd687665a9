//! Scaling, cutting, padding, resampling, baselines.

use crate::Accelerogram;
use crate::accelerogram::check_points;
use crate::fault::{MotionFault, within};
use crate::filter::low_pass;
use crate::integration::{end_of, velocity_of};
use crate::least_squares::fit_polynomial;

impl Accelerogram {
    /// The motion times a factor.
    ///
    /// # Errors
    /// When the factor is not finite.
    pub fn scaled(&self, factor: f64) -> Result<Self, MotionFault> {
        self.with(self.acceleration().iter().map(|a| factor * a).collect())
    }

    /// The motion scaled to a peak ground acceleration, > 0 \[m/s²\].
    ///
    /// # Errors
    /// [`MotionFault::Zero`] for a motion without acceleration.
    pub fn scaled_to_peak(&self, peak: f64) -> Result<Self, MotionFault> {
        if self.peak() == 0.0 {
            return Err(MotionFault::Zero);
        }
        self.scaled(peak / self.peak())
    }

    /// The part between two times, to the nearest samples; time restarts at zero \[s\].
    ///
    /// # Errors
    /// When less than two samples are left.
    pub fn cut(&self, from: f64, to: f64) -> Result<Self, MotionFault> {
        let index = |t: f64| {
            (t / self.step())
                .round()
                .clamp(0.0, self.points() as f64 - 1.0) as usize
        };
        within("a cut", "at finite times", from + to, true)?;
        if from >= to {
            return Err(MotionFault::Order {
                smaller: "the beginning of the cut",
                larger: "its end",
                found: [from, to],
            });
        }
        self.with(self.acceleration()[index(from)..=index(to)].to_vec())
    }

    /// The motion with rest before and after it, each ≥ 0, to whole steps \[s\].
    ///
    /// # Errors
    /// When a length is negative or far too long.
    pub fn padded(&self, before: f64, after: f64) -> Result<Self, MotionFault> {
        within(
            "padding",
            "at or above zero",
            before.min(after),
            before >= 0.0 && after >= 0.0,
        )?;
        let [before, after] = [before, after].map(|t| (t / self.step()).round());
        let points = before + after + self.points() as f64;
        check_points(points)?;
        let mut values = vec![0.0; before as usize];
        values.extend_from_slice(self.acceleration());
        values.resize(points as usize, 0.0);
        self.with(values)
    }

    /// The motion with another step, > 0 \[s\].
    ///
    /// A smaller step reads the straight lines between samples, so a whole fraction of the step gives the same
    /// motion. A larger step first filters frequencies that it cannot represent: zero-phase Butterworth of order 8
    /// at 0.4 of the new sampling frequency.
    ///
    /// # Errors
    /// When the step is not positive, longer than half the motion, or so small that the motion becomes too long.
    pub fn resampled(&self, step: f64) -> Result<Self, MotionFault> {
        if !(step.is_finite() && step > 0.0) {
            return Err(MotionFault::Step { step });
        }
        let points = (self.duration() / step * (1.0 + 1e-12)).floor() + 1.0;
        check_points(points)?;
        let smooth;
        let source = if step > self.step() * (1.0 + 1e-9) {
            smooth = low_pass(self, 0.4 / step, 8)?;
            &smooth
        } else {
            self
        };
        let a = source.acceleration();
        let value = |i: usize| {
            let position = i as f64 * step / self.step();
            // A whole number of steps must not fall a rounding short of its sample.
            let nearest = position.round();
            let position = if (position - nearest).abs() < 1e-9 * nearest.max(1.0) {
                nearest
            } else {
                position
            };
            let at = (position.floor() as usize).min(a.len() - 2);
            a[at] + (position - at as f64) * (a[at + 1] - a[at])
        };
        Self::new(step, (0..points as usize).map(value).collect())
    }

    /// The motion less the polynomial of a degree ≤ 8 that fits its acceleration best.
    ///
    /// # Errors
    /// When the degree is too high.
    pub fn without_polynomial(&self, degree: usize) -> Result<Self, MotionFault> {
        check_degree(degree)?;
        let trend = fit_polynomial(self.acceleration(), 0, degree);
        let share = |i: usize| i as f64 / (self.points() - 1) as f64;
        let value = |(i, a): (usize, &f64)| a - polynomial(&trend, share(i));
        self.with(self.acceleration().iter().enumerate().map(value).collect())
    }

    /// The motion less the derivative of the polynomial without constant, of a degree from 1 to 8, that fits its
    /// velocity best: for records whose velocity drifts.
    ///
    /// # Errors
    /// When the degree is zero or too high.
    pub fn without_velocity_trend(&self, degree: usize) -> Result<Self, MotionFault> {
        check_degree(degree)?;
        within(
            "the degree of a velocity trend",
            "between 1 and 8",
            degree as f64,
            degree >= 1,
        )?;
        let velocity = velocity_of(self.step(), self.acceleration());
        let trend = fit_polynomial(&velocity, 1, degree);
        let slope: Vec<f64> = (1..trend.len())
            .map(|k| k as f64 * trend[k] / self.duration())
            .collect();
        let share = |i: usize| i as f64 / (self.points() - 1) as f64;
        let value = |(i, a): (usize, &f64)| a - polynomial(&slope, share(i));
        self.with(self.acceleration().iter().enumerate().map(value).collect())
    }

    /// The motion with the smallest smooth correction that gives zero velocity and displacement at its end:
    /// `sin²(πt/D) (c₀ + c₁ t/D)` of the acceleration, so that velocity and displacement are zero at the end.
    #[must_use]
    pub fn ending_at_rest(&self) -> Self {
        self.ending_with([0.0, 0.0])
    }

    /// The same for a given final velocity and displacement \[m/s, m\].
    pub(crate) fn ending_with(&self, end: [f64; 2]) -> Self {
        let mut values = self.acceleration().to_vec();
        let last = (values.len() - 1) as f64;
        let window = |i: usize| libm::sin(std::f64::consts::PI * i as f64 / last).powi(2);
        let basis: [Vec<f64>; 2] = [
            (0..values.len()).map(window).collect(),
            (0..values.len())
                .map(|i| window(i) * i as f64 / last)
                .collect(),
        ];
        // Twice: the second pass removes rounding errors.
        for _ in 0..2 {
            let [v, u] = end_of(self.step(), &values);
            let [[v0, u0], [v1, u1]] = [0, 1].map(|k| end_of(self.step(), &basis[k]));
            let determinant = v0 * u1 - v1 * u0;
            if determinant == 0.0 {
                break;
            }
            let (dv, du) = (v - end[0], u - end[1]);
            let c0 = (dv * u1 - v1 * du) / determinant;
            let c1 = (v0 * du - dv * u0) / determinant;
            for (i, value) in values.iter_mut().enumerate() {
                *value -= c0 * basis[0][i] + c1 * basis[1][i];
            }
        }
        // Finite numbers of a finite motion.
        self.with(values).unwrap_or_else(|_| self.clone())
    }
}

/// Σ cₖ xᵏ.
fn polynomial(coefficients: &[f64], x: f64) -> f64 {
    coefficients.iter().rev().fold(0.0, |sum, c| sum * x + c)
}

fn check_degree(degree: usize) -> Result<(), MotionFault> {
    within(
        "the degree of a polynomial",
        "between 0 and 8",
        degree as f64,
        degree <= 8,
    )
}
