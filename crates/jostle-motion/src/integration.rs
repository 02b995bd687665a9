//! Ground velocity and displacement, exact for piecewise linear acceleration.
//!
//! ```text
//! v₁ = v₀ + h (a₀ + a₁)/2        u₁ = u₀ + h v₀ + h² (2 a₀ + a₁)/6
//! ```

use crate::Accelerogram;

/// A peak and when it is reached.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Peak {
    /// Greatest magnitude, ≥ 0.
    pub value: f64,
    /// When it is reached first \[s\].
    pub at: f64,
}

/// Ground velocity at every sample, from rest \[m/s\].
#[must_use]
pub fn velocity(motion: &Accelerogram) -> Vec<f64> {
    velocity_of(motion.step(), motion.acceleration())
}

/// Ground displacement at every sample, from rest \[m\].
#[must_use]
pub fn displacement(motion: &Accelerogram) -> Vec<f64> {
    let (h, a) = (motion.step(), motion.acceleration());
    let mut u = vec![0.0; a.len()];
    let mut v = 0.0;
    for i in 1..a.len() {
        u[i] = u[i - 1] + h * v + h * h * (2.0 * a[i - 1] + a[i]) / 6.0;
        v += 0.5 * h * (a[i - 1] + a[i]);
    }
    u
}

pub(crate) fn velocity_of(h: f64, a: &[f64]) -> Vec<f64> {
    let mut v = vec![0.0; a.len()];
    for i in 1..a.len() {
        v[i] = v[i - 1] + 0.5 * h * (a[i - 1] + a[i]);
    }
    v
}

/// Velocity and displacement at the last sample \[m/s, m\].
pub(crate) fn end_of(h: f64, a: &[f64]) -> [f64; 2] {
    let (mut v, mut u) = (0.0, 0.0);
    for pair in a.windows(2) {
        u += h * v + h * h * (2.0 * pair[0] + pair[1]) / 6.0;
        v += 0.5 * h * (pair[0] + pair[1]);
    }
    [v, u]
}

/// The greatest of equally spaced values.
pub(crate) fn peak_of(h: f64, values: &[f64]) -> Peak {
    let mut peak = Peak {
        value: 0.0,
        at: 0.0,
    };
    for (i, value) in values.iter().enumerate() {
        if value.abs() > peak.value {
            peak = Peak {
                value: value.abs(),
                at: h * i as f64,
            };
        }
    }
    peak
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn straight_lines_integrate_to_cubics() {
        // a = t on 0..=2: v = t²/2, u = t³/6.
        let motion = Accelerogram::new(0.5, (0..5).map(|i| 0.5 * f64::from(i)).collect()).unwrap();
        let (v, u) = (velocity(&motion), displacement(&motion));
        for (i, t) in [0.0, 0.5, 1.0, 1.5, 2.0_f64].into_iter().enumerate() {
            assert!((v[i] - t * t / 2.0).abs() < 1e-15, "v({t})");
            assert!((u[i] - t.powi(3) / 6.0).abs() < 1e-15, "u({t})");
        }
        let [end_v, end_u] = end_of(0.5, motion.acceleration());
        assert!((end_v - v[4]).abs() < 1e-15 && (end_u - u[4]).abs() < 1e-15);
    }
}
