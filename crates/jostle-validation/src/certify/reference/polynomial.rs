//! Polynomials of the share of a step, by their coefficients or by their values at the Chebyshev points.

use nalgebra::SMatrix;

use super::super::C64;
use super::super::phi::{DEGREE, FACTORIAL};

pub(super) const NODES: usize = DEGREE + 1;
pub(super) const ZERO: C64 = C64::new(0.0, 0.0);
pub(super) type Poly = [f64; NODES];

pub(super) fn horner(poly: &Poly, s: f64) -> f64 {
    poly.iter().rev().fold(0.0, |sum, c| sum * s + c)
}

pub(super) fn slope(poly: &Poly, s: f64) -> f64 {
    (1..NODES)
        .rev()
        .fold(0.0, |sum, k| sum * s + k as f64 * poly[k])
}

pub(super) fn real_dot(row: &[C64], q: &[C64]) -> f64 {
    row.iter()
        .zip(q)
        .map(|(c, q)| c.re * q.re - c.im * q.im)
        .sum()
}

pub(super) fn inverse(matrix: &[[f64; NODES]; NODES]) -> [[f64; NODES]; NODES] {
    let matrix = SMatrix::<f64, NODES, NODES>::from_fn(|i, j| matrix[i][j]);
    let inverse = matrix.full_piv_lu().try_inverse().expect("distinct nodes");
    std::array::from_fn(|i| std::array::from_fn(|j| inverse[(i, j)]))
}

pub(super) fn apply(matrix: &[[f64; NODES]; NODES], values: &Poly) -> Poly {
    std::array::from_fn(|i| (0..NODES).map(|j| matrix[i][j] * values[j]).sum())
}

/// Top of the cubic between two values with slopes, as a share of the way and a value.
pub(super) fn hermite_top(x0: f64, v0: f64, x1: f64, v1: f64, h: f64) -> Option<(f64, f64)> {
    if !(v0 > 0.0 && v1 < 0.0) {
        return None;
    }
    let (a, b) = (v0 * h, v1 * h);
    let d = x1 - x0;
    // x = x0 + a s + c s² + e s³.
    let (c, e) = (3.0 * d - 2.0 * a - b, a + b - 2.0 * d);
    let rate = |s: f64| a + s * (2.0 * c + s * 3.0 * e);
    let (mut low, mut high) = (0.0, 1.0);
    for _ in 0..40 {
        let middle = 0.5 * (low + high);
        if rate(middle) > 0.0 {
            low = middle;
        } else {
            high = middle;
        }
    }
    Some((low, x0 + low * (a + low * (c + low * e))))
}

const _: () = assert!(FACTORIAL.len() == NODES);
