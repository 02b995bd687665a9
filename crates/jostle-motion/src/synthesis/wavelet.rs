//! Wavelets that change a motion without changing its final velocity and displacement.

use std::f64::consts::{PI, TAU};
use std::ops::Range;

/// A cosine under one arch of cos², minus the part that would cause a residual velocity or displacement.
pub(crate) struct Wavelet {
    /// Samples it covers.
    pub(crate) range: Range<usize>,
    /// Values there \[–\].
    pub(crate) values: Vec<f64>,
}

/// Periods from the centre to either end: with one period, the lobes next to the centre are half as large, so that
/// trimming many peaks one after the other converges.
const REACH: f64 = 1.0;

impl Wavelet {
    /// A wavelet of a period, largest near a time `centre` \[s\], within a motion of `points` values.
    ///
    /// Near the ends of the motion the arch is cut short on that side.
    pub(crate) fn new(step: f64, points: usize, period: f64, centre: f64) -> Self {
        let end = step * (points - 1) as f64;
        let centre = centre.clamp(3.0 * step, (end - 3.0 * step).max(3.0 * step));
        let reach = (REACH * period).max(3.0 * step);
        let (left, right) = (reach.min(centre), reach.min(end - centre));
        let first = ((centre - left) / step).ceil().max(0.0) as usize;
        let last = (((centre + right) / step).floor() as usize).min(points - 1);
        let arch = |t: f64| {
            let side = if t < 0.0 { left } else { right };
            libm::cos(0.5 * PI * t / side).powi(2)
        };
        let times = || (first..=last).map(|m| step * m as f64 - centre);
        let mut values: Vec<f64> = times()
            .map(|t| arch(t) * libm::cos(TAU * t / period))
            .collect();
        // Between first and last all samples count fully: Σ w leaves a velocity, Σ w t a displacement.
        let sums = |weights: &[f64]| {
            let pairs = weights.iter().zip(times());
            pairs.fold([0.0, 0.0], |[s, m], (w, t)| [s + w, m + w * t])
        };
        let flat: Vec<f64> = times().map(arch).collect();
        let tilted: Vec<f64> = times().map(|t| arch(t) * t).collect();
        let ([s, m], [s0, m0], [s1, m1]) = (sums(&values), sums(&flat), sums(&tilted));
        let determinant = s0 * m1 - s1 * m0;
        if determinant != 0.0 {
            let c0 = (s * m1 - s1 * m) / determinant;
            let c1 = (s0 * m - s * m0) / determinant;
            for (i, value) in values.iter_mut().enumerate() {
                *value -= c0 * flat[i] + c1 * tilted[i];
            }
        }
        Self {
            range: first..last + 1,
            values,
        }
    }

    /// Adds a multiple to a motion.
    pub(crate) fn add(&self, motion: &mut [f64], amount: f64) {
        for (a, w) in motion[self.range.clone()].iter_mut().zip(&self.values) {
            *a += amount * w;
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::integration::end_of;

    #[test]
    fn a_wavelet_leaves_nothing_behind() {
        for centre in [0.05, 0.4, 7.0, 19.9] {
            for period in [0.05, 0.3, 4.0] {
                let mut motion = vec![0.0; 2001];
                Wavelet::new(0.01, 2001, period, centre).add(&mut motion, 1.0);
                let [v, u] = end_of(0.01, &motion);
                let largest = motion.iter().fold(0.0_f64, |m, a| m.max(a.abs()));
                assert!(
                    v.abs() < 1e-12 && u.abs() < 1e-10,
                    "{centre} {period}: {v} {u}"
                );
                assert!(
                    (0.2..4.0).contains(&largest),
                    "{centre} {period}: {largest}"
                );
            }
        }
    }
}
