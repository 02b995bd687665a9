//! The functions φ_k(z) = ∫₀¹ e^{z(1−s)} s^{k−1}/(k−1)! ds of exponential integrators.

use super::C64;

/// Highest degree of the polynomials that loads are over a step.
pub(super) const DEGREE: usize = 8;
/// e^z, φ₁ … φ_{DEGREE+1}.
pub(super) type Phi = [C64; DEGREE + 2];

/// 1/k!.
const INVERSE_FACTORIAL: [f64; 11] = [
    1.0,
    1.0,
    1.0 / 2.0,
    1.0 / 6.0,
    1.0 / 24.0,
    1.0 / 120.0,
    1.0 / 720.0,
    1.0 / 5040.0,
    1.0 / 40_320.0,
    1.0 / 362_880.0,
    1.0 / 3_628_800.0,
];

/// k!.
pub(super) const FACTORIAL: [f64; DEGREE + 1] =
    [1.0, 1.0, 2.0, 6.0, 24.0, 120.0, 720.0, 5040.0, 40_320.0];

/// e^z and φ₁ … φ_`last`; Re z ≤ 0. The series of the last one converges without cancellation where |z| is not large,
/// and the recursion downwards is stable there; elsewhere that upwards is.
pub(super) fn phi(z: C64, last: usize, out: &mut Phi) {
    let exp = z.exp();
    out[0] = exp;
    if z.norm_sqr() < ((last + 1) * (last + 1)) as f64 {
        let mut term = C64::new(INVERSE_FACTORIAL[last], 0.0);
        let mut sum = term;
        for m in 1..80 {
            term *= z / (last + m) as f64;
            sum += term;
            if term.norm_sqr() < 1e-36 * sum.norm_sqr() {
                break;
            }
        }
        out[last] = sum;
        for k in (1..last).rev() {
            out[k] = z * out[k + 1] + INVERSE_FACTORIAL[k];
        }
    } else {
        for k in 0..last {
            out[k + 1] = (out[k] - INVERSE_FACTORIAL[k]) / z;
        }
    }
}

/// ∫₀^t e^{λ(t−τ)} (τ/h)^k dτ for k = 0 … `last`, where t = s h.
pub(super) fn moments(phi: &Phi, s: f64, h: f64, last: usize, out: &mut [C64; DEGREE + 1]) {
    let mut power = s * h;
    for k in 0..=last {
        out[k] = phi[k + 1] * (power * FACTORIAL[k]);
        power *= s;
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Against Simpson's rule with many points.
    #[test]
    fn as_quadrature_finds_them() {
        for z in [
            C64::new(-0.01, 0.1),
            C64::new(-3.0, 4.0),
            C64::new(-0.1, 9.9),
            C64::new(-10.5, 0.0),
            C64::new(-2.0, 30.0),
        ] {
            let mut all = [C64::new(0.0, 0.0); DEGREE + 2];
            phi(z, DEGREE + 1, &mut all);
            let n = 20_000;
            for k in 1..=DEGREE + 1 {
                let f = |s: f64| {
                    (z * (1.0 - s)).exp() * s.powi(k as i32 - 1) * INVERSE_FACTORIAL[k - 1]
                };
                let mut sum = f(0.0) + f(1.0);
                for i in 1..n {
                    sum += f(i as f64 / n as f64) * if i % 2 == 1 { 4.0 } else { 2.0 };
                }
                let expected = sum / (3 * n) as f64;
                let error = (all[k] - expected).norm() / expected.norm();
                assert!(error < 1e-10, "z = {z}, k = {k}: {error}");
            }
        }
    }
}
