//! Eigenvectors of small symmetric matrices, the same to the bit on every processor.

use super::tridiagonal;

/// Eigenvalues, rising, and the eigenvector of length one of each, of a symmetric matrix given by its lower triangle row by
/// row. Householder's reflections (A. S. Householder, 1958, J. ACM 5, 339–342) make it tridiagonal.
///
/// Libraries fuse and reorder as registers allow, and shapes found with them would differ between processors.
pub(crate) fn eigen(lower: &[Vec<f64>]) -> (Vec<f64>, Vec<Vec<f64>>) {
    let n = lower.len();
    let mut matrix = vec![vec![0.0; n]; n];
    let mut turn = vec![vec![0.0; n]; n];
    for (i, row) in lower.iter().enumerate() {
        turn[i][i] = 1.0;
        for (j, value) in row.iter().enumerate() {
            matrix[i][j] = *value;
            matrix[j][i] = *value;
        }
    }
    let (mut mirror, mut product) = (vec![0.0; n], vec![0.0; n]);
    for k in 0..n.saturating_sub(2) {
        let rest = k + 1..n;
        for i in rest.clone() {
            mirror[i] = matrix[i][k];
        }
        let length = norm(&mirror[rest.clone()]);
        let left = -length.copysign(mirror[k + 1]);
        mirror[k + 1] -= left;
        let own = norm(&mirror[rest.clone()]);
        if own == 0.0 {
            continue;
        }
        mirror[rest.clone()].iter_mut().for_each(|v| *v /= own);
        let along = |row: &[f64], mirror: &[f64]| -> f64 {
            let terms = row[rest.clone()].iter().zip(&mirror[rest.clone()]);
            terms.map(|(a, v)| a * v).sum()
        };
        for i in rest.clone() {
            product[i] = along(&matrix[i], &mirror);
        }
        let twice = along(&product, &mirror);
        for i in rest.clone() {
            product[i] = 2.0 * (product[i] - twice * mirror[i]);
        }
        for i in rest.clone() {
            for j in rest.clone() {
                matrix[i][j] -= mirror[i] * product[j] + product[i] * mirror[j];
            }
        }
        (matrix[k + 1][k], matrix[k][k + 1]) = (left, left);
        for row in &mut turn {
            let part = 2.0 * along(row, &mirror);
            for i in rest.clone() {
                row[i] -= part * mirror[i];
            }
        }
    }
    let diagonal: Vec<f64> = (0..n).map(|i| matrix[i][i]).collect();
    let next: Vec<f64> = (1..n).map(|i| matrix[i][i - 1]).collect();
    let values = tridiagonal::eigen(&diagonal, &next, &mut turn);
    let mut order: Vec<usize> = (0..n).collect();
    order.sort_by(|a, b| values[*a].total_cmp(&values[*b]));
    let vector = |k: &usize| turn.iter().map(|row| row[*k]).collect();
    (
        order.iter().map(|k| values[*k]).collect(),
        order.iter().map(vector).collect(),
    )
}

fn norm(vector: &[f64]) -> f64 {
    vector.iter().map(|v| v * v).sum::<f64>().sqrt()
}

#[cfg(test)]
mod tests {
    use faer::{Mat, Side};

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
                let library = Mat::from_fn(n, n, at)
                    .self_adjoint_eigen(Side::Lower)
                    .expect("a finite matrix");
                let size = values.iter().fold(0.0, |size: f64, v| size.max(v.abs()));
                for k in 0..n {
                    assert!(
                        (values[k] - library.S()[k]).abs() <= 1e-13 * size,
                        "{n}, {k}"
                    );
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
