//! Small dense least squares, in one thread and a fixed order: the bits of a seeded motion must not depend on the
//! processor, which optimised libraries do not guarantee.

/// Solves a symmetric positive definite system by Cholesky's method; only the lower triangle is read, and
/// overwritten.
pub(crate) fn solve(matrix: &mut [Vec<f64>], mut x: Vec<f64>) -> Vec<f64> {
    let n = x.len();
    for i in 0..n {
        for j in 0..=i {
            let (above, below) = matrix.split_at_mut(i);
            let row = &mut below[0];
            if j < i {
                row[j] = (row[j] - dot(&row[..j], &above[j][..j])) / above[j][j];
            } else {
                let pivot = row[i] - dot(&row[..i], &row[..i]);
                row[i] = pivot.max(f64::MIN_POSITIVE).sqrt();
            }
        }
    }
    for i in 0..n {
        x[i] = (x[i] - dot(&matrix[i][..i], &x[..i])) / matrix[i][i];
    }
    for i in (0..n).rev() {
        let sum: f64 = (i + 1..n).map(|k| matrix[k][i] * x[k]).sum();
        x[i] = (x[i] - sum) / matrix[i][i];
    }
    x
}

/// Scalar product of two slices of equal length, in eight sums that a processor can compute at once.
pub(crate) fn dot(a: &[f64], b: &[f64]) -> f64 {
    let mut sums = [0.0; 8];
    let (first, second) = (a.chunks_exact(8), b.chunks_exact(8));
    let rest: f64 = first
        .remainder()
        .iter()
        .zip(second.remainder())
        .map(|(a, b)| a * b)
        .sum();
    for (a, b) in first.zip(second) {
        for lane in 0..8 {
            sums[lane] += a[lane] * b[lane];
        }
    }
    sums.iter().sum::<f64>() + rest
}

/// Coefficients of the polynomial in `0..=1` that fits equally spaced values best, with powers from `lowest` to
/// `degree`; lower ones are zero.
pub(crate) fn fit_polynomial(values: &[f64], lowest: usize, degree: usize) -> Vec<f64> {
    let last = (values.len() - 1) as f64;
    let powers = |i: usize| -> Vec<f64> {
        let x = i as f64 / last;
        (lowest..=degree).map(|k| x.powi(k as i32)).collect()
    };
    let basis = orthonormal(&(0..values.len()).map(powers).collect::<Vec<_>>());
    let mut coefficients = vec![0.0; degree + 1];
    for (vector, combination) in basis {
        let amount: f64 = vector.iter().zip(values).map(|(e, v)| e * v).sum();
        for (k, c) in combination.iter().enumerate() {
            coefficients[lowest + k] += amount * c;
        }
    }
    coefficients
}

/// Orthonormal vectors of the columns, each with its coefficients in them: Gram–Schmidt, twice.
fn orthonormal(rows: &[Vec<f64>]) -> Vec<(Vec<f64>, Vec<f64>)> {
    let columns = rows.first().map_or(0, Vec::len);
    let mut basis: Vec<(Vec<f64>, Vec<f64>)> = Vec::new();
    for k in 0..columns {
        let mut vector: Vec<f64> = rows.iter().map(|row| row[k]).collect();
        let mut combination = vec![0.0; columns];
        combination[k] = 1.0;
        for _ in 0..2 {
            for (other, theirs) in &basis {
                let amount: f64 = other.iter().zip(&vector).map(|(a, b)| a * b).sum();
                vector
                    .iter_mut()
                    .zip(other)
                    .for_each(|(v, o)| *v -= amount * o);
                combination
                    .iter_mut()
                    .zip(theirs)
                    .for_each(|(c, t)| *c -= amount * t);
            }
        }
        let norm = vector.iter().map(|v| v * v).sum::<f64>().sqrt();
        // More powers than values.
        if norm > 1e-12 {
            vector.iter_mut().for_each(|v| *v /= norm);
            combination.iter_mut().for_each(|c| *c /= norm);
            basis.push((vector, combination));
        }
    }
    basis
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn known_systems_are_solved() {
        let matrix = [
            vec![4.0, 1.0, -0.5],
            vec![1.0, 3.0, 0.2],
            vec![-0.5, 0.2, 2.0],
        ];
        let x = [0.7, -1.1, 2.0];
        let right = matrix.iter().map(|row| dot(row, &x)).collect();
        let found = solve(&mut matrix.clone(), right);
        for (found, wanted) in found.iter().zip(x) {
            assert!((found - wanted).abs() < 1e-14, "{found} for {wanted}");
        }
    }

    #[test]
    fn polynomials_are_found_again() {
        let wanted = [0.0, 2.0, -3.0, 0.0, 1.5];
        let value = |i: i32| {
            let x = f64::from(i) / 200.0;
            wanted.iter().rev().fold(0.0, |sum, c| sum * x + c)
        };
        let values: Vec<f64> = (0..=200).map(value).collect();
        for (lowest, degree) in [(0, 4), (1, 6), (0, 8)] {
            let found = fit_polynomial(&values, lowest, degree);
            for (k, c) in found.iter().enumerate() {
                let wanted = wanted.get(k).unwrap_or(&0.0);
                assert!((c - wanted).abs() < 1e-8, "{k}: {c} for {wanted}");
            }
        }
    }
}
