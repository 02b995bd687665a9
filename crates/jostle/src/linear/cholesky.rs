//! Cholesky factors of small full matrices.

use pulp::NullaryFnOnce;

use crate::simd::{add, dot, in_wide_registers};

/// L of A = L Lᵀ, rows of the lower triangle.
pub(crate) struct Cholesky {
    rows: Vec<Vec<f64>>,
}

impl Cholesky {
    /// Factorises a symmetric matrix given by the rows of its lower triangle; `None` if it is not positive definite.
    pub(crate) fn new(lower: Vec<Vec<f64>>) -> Option<Self> {
        let rows = in_wide_registers(lower.len(), Factorize(lower))?;
        Some(Self { rows })
    }

    /// Solves A x = b for several right-hand sides; each becomes its solution.
    pub(crate) fn solve(&self, right: &mut [Vec<f64>]) {
        let rows = &self.rows;
        in_wide_registers(rows.len(), Solve { rows, right });
    }
}

struct Factorize(Vec<Vec<f64>>);

impl NullaryFnOnce for Factorize {
    type Output = Option<Vec<Vec<f64>>>;

    #[inline(always)]
    fn call(self) -> Self::Output {
        let mut rows = self.0;
        for i in 0..rows.len() {
            let (done, rest) = rows.split_at_mut(i);
            let row = &mut rest[0];
            for (j, other) in done.iter().enumerate() {
                row[j] = (row[j] - dot(&row[..j], &other[..j])) / other[j];
            }
            let square = row[i] - dot(&row[..i], &row[..i]);
            if square <= 0.0 || !square.is_finite() {
                return None;
            }
            row[i] = square.sqrt();
        }
        Some(rows)
    }
}

struct Solve<'a> {
    rows: &'a [Vec<f64>],
    right: &'a mut [Vec<f64>],
}

impl NullaryFnOnce for Solve<'_> {
    type Output = ();

    #[inline(always)]
    fn call(self) {
        for x in self.right {
            for (i, row) in self.rows.iter().enumerate() {
                x[i] = (x[i] - dot(&row[..i], &x[..i])) / row[i];
            }
            for (i, row) in self.rows.iter().enumerate().rev() {
                x[i] /= row[i];
                let value = x[i];
                add(&mut x[..i], -value, &row[..i]);
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use nalgebra::DMatrix;

    use super::*;

    fn lower(n: usize, entry: impl Fn(usize, usize) -> f64) -> Vec<Vec<f64>> {
        let row = |i| (0..=i).map(|j| entry(i, j)).collect();
        (0..n).map(row).collect()
    }

    #[test]
    fn solves_what_a_library_solves() {
        for n in [1, 2, 5, 16, 17, 40] {
            let entry = |i: usize, j: usize| {
                let distance = i.abs_diff(j) as f64;
                (-0.3 * distance).exp() + f64::from(u8::from(i == j))
            };
            let mut right: Vec<Vec<f64>> = (0..3)
                .map(|k| (0..n).map(|i| (1.7 * (i + k) as f64).sin()).collect())
                .collect();
            let library = DMatrix::from_fn(n, n, entry).cholesky().expect("definite");
            let expected = library.solve(&DMatrix::from_fn(n, 3, |i, k| right[k][i]));
            Cholesky::new(lower(n, entry))
                .expect("definite")
                .solve(&mut right);
            for (k, answer) in right.iter().enumerate() {
                for (i, value) in answer.iter().enumerate() {
                    assert!((value - expected[(i, k)]).abs() < 1e-13, "{n}: {i}, {k}");
                }
            }
        }
    }

    #[test]
    fn indefinite_matrices_are_refused() {
        let swapped = |i: usize, j: usize| f64::from(u8::from(i != j));
        assert!(Cholesky::new(lower(2, swapped)).is_none());
        assert!(Cholesky::new(lower(20, |_, _| 1.0)).is_none());
        assert!(Cholesky::new(lower(1, |_, _| f64::NAN)).is_none());
        assert!(Cholesky::new(Vec::new()).is_some());
    }
}
