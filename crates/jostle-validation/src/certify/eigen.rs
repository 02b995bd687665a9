//! Eigenvalues and eigenvectors of a real matrix that need not be symmetric, from its real Schur form A = Q T Qᵀ.

use nalgebra::{DMatrix, DVector};

use super::C64;

/// Eigenvalues and, as columns, eigenvectors of unit length; both of a conjugate pair. `None` if the iteration does not
/// converge.
///
/// T has blocks of one or two rows on its diagonal. Back substitution through (T − λ 1) x = 0 from the block of λ upwards
/// gives x, and the eigenvector is Q x (Golub and Van Loan, Matrix Computations, 7.6.4).
pub(super) fn eigen(matrix: DMatrix<f64>) -> Option<(Vec<C64>, DMatrix<C64>)> {
    let n = matrix.nrows();
    let (q, t) = matrix
        .try_schur(f64::EPSILON, 100 * (n + 1))
        .map(|schur| schur.unpack())?;
    let (mut values, mut vectors) = (Vec::new(), Vec::new());
    // Divisors that vanish, of equal eigenvalues, are replaced.
    let least = f64::EPSILON * t.amax().max(f64::MIN_POSITIVE);
    let mut add = |value: C64, first: usize, x: &mut [C64]| {
        substitute(&t, value, first, least, x);
        let full = |i: usize| (0..n).map(|j| x[j] * q[(i, j)]).sum();
        let vector: DVector<C64> = DVector::from_fn(n, |i, _| full(i)).normalize();
        values.push(value);
        vectors.push(vector);
        if value.im != 0.0 {
            values.push(value.conj());
            vectors.push(vectors[vectors.len() - 1].conjugate());
        }
    };
    let mut k = 0;
    while k < n {
        let mut x = vec![C64::new(0.0, 0.0); n];
        if k + 1 == n || t[(k + 1, k)] == 0.0 {
            x[k] = C64::new(1.0, 0.0);
            add(C64::new(t[(k, k)], 0.0), k, &mut x);
            k += 1;
            continue;
        }
        let (a, b, c, d) = (t[(k, k)], t[(k, k + 1)], t[(k + 1, k)], t[(k + 1, k + 1)]);
        let half = 0.5 * (a - d);
        let value = C64::new(0.5 * (a + d), (-(half * half + b * c)).max(0.0).sqrt());
        if b.abs() >= c.abs() {
            (x[k], x[k + 1]) = (C64::new(1.0, 0.0), (value - a) / b);
        } else {
            (x[k], x[k + 1]) = ((value - d) / c, C64::new(1.0, 0.0));
        }
        add(value, k, &mut x);
        k += 2;
    }
    Some((values, DMatrix::from_columns(&vectors)))
}

/// Entries of x above row `first` of the block of `value`.
fn substitute(t: &DMatrix<f64>, value: C64, first: usize, least: f64, x: &mut [C64]) {
    let pivot = |p: C64| {
        if p.norm() < least {
            C64::new(least, 0.0)
        } else {
            p
        }
    };
    let mut i = first;
    while i > 0 {
        i -= 1;
        let load = |row: usize, x: &[C64]| -> C64 {
            let entries = (row + 1..x.len()).map(|j| x[j] * t[(row, j)]);
            -entries.sum::<C64>()
        };
        let below = load(i, x);
        let one = t[(i, i)] - value;
        if i == 0 || t[(i, i - 1)] == 0.0 {
            x[i] = below / pivot(one);
            continue;
        }
        // Two rows at once, by Cramer's rule.
        let above = load(i - 1, x);
        let other = t[(i - 1, i - 1)] - value;
        let (across, back) = (t[(i - 1, i)], t[(i, i - 1)]);
        let determinant = one * other - across * back;
        let determinant = if determinant.norm() < least * least {
            C64::new(least * least, 0.0)
        } else {
            determinant
        };
        x[i] = (other * below - above * back) / determinant;
        x[i - 1] = (one * above - below * across) / determinant;
        i -= 1;
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// By the definition A v = λ v, and by the trace: simple and equal values, alone and in blocks that do not couple.
    #[test]
    fn as_the_definition_asks() {
        let full = |i: usize, j: usize| (1.3 * (i + 1) as f64 * (j + 2) as f64).sin();
        let turning = |i: usize, j: usize| match (i + 1 == j, j + 1 == i) {
            (true, _) if i.is_multiple_of(2) => 2.0 + i as f64,
            (_, true) if j.is_multiple_of(2) => -2.0 - j as f64,
            _ => 0.0,
        };
        let damped = |i: usize, j: usize| turning(i, j) - 0.1 * full(i, 3) * full(j, 3);
        let diagonal = |i: usize, j: usize| f64::from(u8::from(i == j)) * (1.0 + (i / 2) as f64);
        for n in [1, 2, 3, 4, 9, 10, 41] {
            for entry in [
                &full as &dyn Fn(usize, usize) -> f64,
                &turning,
                &damped,
                &diagonal,
            ] {
                let matrix = DMatrix::from_fn(n, n, entry);
                let size = matrix.norm();
                let (values, vectors) = eigen(matrix.clone()).expect("it converges");
                assert_eq!((values.len(), vectors.shape()), (n, (n, n)));
                let sum: C64 = values.iter().sum();
                assert!((sum - matrix.trace()).norm() <= 1e-13 * size, "{n}");
                let images = matrix.map(|entry| C64::new(entry, 0.0)) * &vectors;
                for (k, value) in values.iter().enumerate() {
                    let error = (images.column(k) - vectors.column(k) * *value).norm();
                    assert!(error <= 1e-13 * size, "{n}, {k}: {error}");
                }
                let inverse = vectors.lu().try_inverse().expect("independent");
                assert!(inverse.iter().all(|entry| entry.norm() < 1e3), "{n}");
            }
        }
    }
}
