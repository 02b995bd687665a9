//! Eigenvectors of small symmetric matrices, the same to the bit on every processor.

use pulp::NullaryFnOnce;

use super::tridiagonal;
use crate::linear::sort_by;
use crate::simd::{dot, in_wide_registers};

/// Eigenvalues, rising, and the eigenvector of length one of each, of a symmetric matrix given by its lower triangle row by
/// row. Householder's reflections (A. S. Householder, 1958, J. ACM 5, 339–342) make it tridiagonal.
///
/// Libraries fuse and reorder operations depending on the registers, so their shapes would differ between
/// processors.
pub(crate) fn eigen(lower: &[Vec<f64>]) -> (Vec<f64>, Vec<Vec<f64>>) {
    in_wide_registers(lower.len(), Eigen(lower))
}

/// Eigenvalues and eigenvectors, in no order, of a flexibility whose displacements are partly held: what remains of it when forces at
/// those keep them at rest. Their components are zero.
pub(crate) fn held(lower: &[Vec<f64>], held: &[bool]) -> Vec<(f64, Vec<f64>)> {
    let n = lower.len();
    let at = |rows: &[Vec<f64>], i: usize, j: usize| rows[i.max(j)][i.min(j)];
    let mut rest = lower.to_vec();
    for hold in (0..n).filter(|hold| held[*hold]) {
        let column: Vec<f64> = (0..n).map(|row| at(&rest, row, hold)).collect();
        let pivot = column[hold];
        for (i, row) in rest.iter_mut().enumerate() {
            for (value, entry) in row.iter_mut().zip(&column) {
                *value -= column[i] * entry / pivot;
            }
        }
    }
    let kept: Vec<usize> = (0..n).filter(|dof| !held[*dof]).collect();
    let part = kept.iter().enumerate();
    let part: Vec<Vec<f64>> = part
        .map(|(row, &i)| kept[..=row].iter().map(|&j| at(&rest, i, j)).collect())
        .collect();
    let (values, vectors) = eigen(&part);
    let pairs = values.into_iter().zip(vectors).map(|(value, vector)| {
        let mut whole = vec![0.0; n];
        for (&dof, vector) in kept.iter().zip(vector) {
            whole[dof] = vector;
        }
        (value, whole)
    });
    pairs.collect()
}

struct Eigen<'a>(&'a [Vec<f64>]);

impl NullaryFnOnce for Eigen<'_> {
    type Output = (Vec<f64>, Vec<Vec<f64>>);

    #[inline(always)]
    fn call(self) -> Self::Output {
        found(self.0)
    }
}

/// See [`eigen`]; compiled for the available registers.
#[inline(always)]
fn found(lower: &[Vec<f64>]) -> (Vec<f64>, Vec<Vec<f64>>) {
    let n = lower.len();
    let mut matrix = vec![vec![0.0; n]; n];
    for (i, row) in lower.iter().enumerate() {
        for (j, value) in row.iter().enumerate() {
            matrix[i][j] = *value;
            matrix[j][i] = *value;
        }
    }
    let mut next = Vec::with_capacity(n);
    // Each reflection acts on the rows below its own.
    let mut mirrors: Vec<Vec<f64>> = Vec::with_capacity(n);
    let mut product = vec![0.0; n];
    for k in 0..n.saturating_sub(1) {
        let mut mirror = matrix[k][k + 1..].to_vec();
        let left = -norm(&mirror).copysign(mirror[0]);
        next.push(left);
        mirror[0] -= left;
        let norm = norm(&mirror);
        if norm == 0.0 {
            mirrors.push(Vec::new());
            continue;
        }
        mirror.iter_mut().for_each(|v| *v /= norm);
        let rows = &mut matrix[k + 1..];
        for (product, row) in product.iter_mut().zip(&*rows) {
            *product = dot(&row[k + 1..], &mirror);
        }
        let product = &mut product[..mirror.len()];
        let twice = dot(product, &mirror);
        for (product, v) in product.iter_mut().zip(&mirror) {
            *product = 2.0 * (*product - twice * v);
        }
        for ((row, v), p) in rows.iter_mut().zip(&mirror).zip(&*product) {
            for ((value, q), w) in row[k + 1..].iter_mut().zip(&*product).zip(&mirror) {
                *value -= v * q + p * w;
            }
        }
        mirrors.push(mirror);
    }
    let mut turn = vec![0.0; n * n];
    for k in 0..n {
        turn[k * n + k] = 1.0;
    }
    for (k, mirror) in mirrors.iter().enumerate().rev() {
        for column in turn.chunks_exact_mut(n).skip(k + 1) {
            let part = 2.0 * dot(&column[n - mirror.len()..], mirror);
            let below = column[n - mirror.len()..].iter_mut();
            below.zip(mirror).for_each(|(value, v)| *value -= part * v);
        }
    }
    let diagonal: Vec<f64> = (0..n).map(|i| matrix[i][i]).collect();
    let values = tridiagonal::eigen(&diagonal, &next, &mut turn);
    let mut order: Vec<usize> = (0..n).collect();
    sort_by(&mut order, |a, b| values[*a].total_cmp(&values[*b]));
    let vector = |k: &usize| turn[k * n..][..n].to_vec();
    (
        order.iter().map(|k| values[*k]).collect(),
        order.iter().map(vector).collect(),
    )
}

#[inline(always)]
fn norm(vector: &[f64]) -> f64 {
    dot(vector, vector).sqrt()
}

#[cfg(test)]
mod tests {
    use nalgebra::DMatrix;

    use super::*;

    /// Values against a library, vectors against their definition; blocks that do not couple and equal values among them.
    #[test]
    fn as_a_library_finds_them() {
        let full = |i: usize, j: usize| (1.3 * (i + 1) as f64 * (j + 2) as f64).sin();
        let graded = |i: usize, j: usize| full(i, j) * 10_f64.powf(0.2 * (i + j) as f64);
        let blocks = |i: usize, j: usize| {
            if i == j {
                2.0
            } else {
                f64::from(u8::from(i == j + 3))
            }
        };
        assert_eq!(eigen(&[]), (Vec::new(), Vec::new()));
        for n in [1, 2, 3, 10, 35] {
            for entry in [&full as &dyn Fn(usize, usize) -> f64, &graded, &blocks] {
                let lower: Vec<Vec<f64>> = (0..n)
                    .map(|i| (0..=i).map(|j| entry(i, j)).collect())
                    .collect();
                let at = |i: usize, j: usize| lower[i.max(j)][i.min(j)];
                let (values, vectors) = eigen(&lower);
                let mut library = DMatrix::from_fn(n, n, at).symmetric_eigenvalues();
                library.as_mut_slice().sort_by(f64::total_cmp);
                let size = values.iter().fold(0.0, |size: f64, v| size.max(v.abs()));
                for k in 0..n {
                    assert!((values[k] - library[k]).abs() <= 1e-13 * size, "{n}, {k}");
                    for i in 0..n {
                        let image: f64 = (0..n).map(|j| at(i, j) * vectors[k][j]).sum();
                        let error = (image - values[k] * vectors[k][i]).abs();
                        assert!(error <= 1e-13 * size, "{n}, {k}, {i}: {error}");
                        let product: f64 =
                            vectors[k].iter().zip(&vectors[i]).map(|(a, b)| a * b).sum();
                        let expected = f64::from(u8::from(i == k));
                        assert!((product - expected).abs() <= 1e-13, "{n}: {k}, {i}");
                    }
                }
            }
        }
    }
}
