//! Full matrices of a few dozen rows, and their elimination with partial pivoting.

use std::ops::{Index, IndexMut};

/// A full matrix, stored row by row.
#[derive(Clone, Debug, Default)]
pub(crate) struct FullMatrix {
    columns: usize,
    entries: Vec<f64>,
}

impl FullMatrix {
    pub(crate) fn zeros(rows: usize, columns: usize) -> Self {
        Self {
            columns,
            entries: vec![0.0; rows * columns],
        }
    }

    /// Makes it a matrix of zeros, in the storage it has.
    pub(crate) fn reset(&mut self, rows: usize, columns: usize) {
        self.columns = columns;
        self.entries.clear();
        self.entries.resize(rows * columns, 0.0);
    }

    pub(crate) fn rows(&self) -> usize {
        self.entries.len().checked_div(self.columns).unwrap_or(0)
    }

    pub(crate) fn is_finite(&self) -> bool {
        self.entries.iter().all(|entry| entry.is_finite())
    }

    fn row(&self, row: usize) -> &[f64] {
        &self.entries[row * self.columns..][..self.columns]
    }

    /// This matrix times the first rows of another.
    pub(crate) fn times(&self, other: &Self) -> Self {
        let mut product = Self::zeros(self.rows(), other.columns);
        if other.columns > 0 {
            let rows = product.entries.chunks_exact_mut(other.columns);
            for (row, to) in rows.enumerate() {
                for (k, factor) in self.row(row).iter().enumerate() {
                    for (value, entry) in to.iter_mut().zip(other.row(k)) {
                        *value += factor * entry;
                    }
                }
            }
        }
        product
    }
}

impl Index<(usize, usize)> for FullMatrix {
    type Output = f64;

    fn index(&self, (row, column): (usize, usize)) -> &f64 {
        &self.entries[row * self.columns + column]
    }
}

impl IndexMut<(usize, usize)> for FullMatrix {
    fn index_mut(&mut self, (row, column): (usize, usize)) -> &mut f64 {
        &mut self.entries[row * self.columns + column]
    }
}

/// P A = L U of a square matrix, L with a unit diagonal. Solutions of a singular matrix are not finite.
#[derive(Clone, Debug, Default)]
pub(crate) struct PivotedLu {
    factors: FullMatrix,
    /// The row of A that each row of L U comes from.
    source: Vec<usize>,
    /// Columns of every row of L U, outside of which it is zero.
    envelope: Vec<[usize; 2]>,
}

impl PivotedLu {
    pub(crate) fn new(matrix: FullMatrix) -> Self {
        let mut lu = Self {
            factors: matrix,
            ..Self::default()
        };
        lu.eliminate();
        lu
    }

    /// Factorises the matrix that `fill` writes over n rows of zeros, in the storage at hand.
    pub(crate) fn refactor(&mut self, n: usize, fill: impl FnOnce(&mut FullMatrix)) {
        self.factors.reset(n, n);
        fill(&mut self.factors);
        self.eliminate();
    }

    fn eliminate(&mut self) {
        let Self {
            factors: matrix,
            source,
            envelope,
        } = self;
        let n = matrix.rows();
        source.clear();
        source.extend(0..n);
        for step in 0..n {
            let mut pivot = step;
            for row in step + 1..n {
                if matrix[(row, step)].abs() > matrix[(pivot, step)].abs() {
                    pivot = row;
                }
            }
            if pivot != step {
                source.swap(pivot, step);
                for column in 0..n {
                    matrix.entries.swap(pivot * n + column, step * n + column);
                }
            }
            let (done, below) = matrix.entries.split_at_mut((step + 1) * n);
            let top = &done[step * n + step..];
            let end = top.len() - top.iter().rev().take_while(|value| **value == 0.0).count();
            for row in below.chunks_exact_mut(n) {
                if row[step] == 0.0 {
                    continue;
                }
                let factor = row[step] / top[0];
                row[step] = factor;
                let above = &top[1.min(end)..end];
                for (value, above) in row[step + 1..].iter_mut().zip(above) {
                    *value -= factor * above;
                }
            }
        }
        envelope.clear();
        envelope.extend((0..n).map(|index| {
            let row = matrix.row(index);
            let filled = |value: &f64| *value != 0.0;
            let first = row.iter().position(filled).unwrap_or(index);
            let last = row.iter().rposition(filled).unwrap_or(index);
            [first.min(index), last.max(index) + 1]
        }));
    }

    /// Solves A x = b.
    pub(crate) fn solve(&self, right: &[f64]) -> Vec<f64> {
        let mut x = Vec::with_capacity(right.len());
        self.solve_into(right, &mut x);
        x
    }

    /// Solves A x = b into a list.
    pub(crate) fn solve_into(&self, right: &[f64], x: &mut Vec<f64>) {
        x.clear();
        x.extend(self.source.iter().map(|row| right[*row]));
        let sum = |row: &[f64], x: &[f64]| row.iter().zip(x).map(|(a, b)| a * b).sum::<f64>();
        for i in 0..x.len() {
            let first = self.envelope[i][0];
            x[i] -= sum(&self.factors.row(i)[first..i], &x[first..]);
        }
        for i in (0..x.len()).rev() {
            let row = &self.factors.row(i)[..self.envelope[i][1]];
            x[i] = (x[i] - sum(&row[i + 1..], &x[i + 1..])) / row[i];
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn filled(rows: usize, columns: usize, entry: impl Fn(usize, usize) -> f64) -> FullMatrix {
        let mut matrix = FullMatrix::zeros(rows, columns);
        for row in 0..rows {
            for column in 0..columns {
                matrix[(row, column)] = entry(row, column);
            }
        }
        matrix
    }

    #[test]
    fn products_are_known() {
        let a = filled(2, 2, |i, j| (1 + 2 * i + j) as f64);
        let b = filled(3, 1, |i, _| (i + 5) as f64);
        let product = a.times(&b);
        assert_eq!([product[(0, 0)], product[(1, 0)]], [17.0, 39.0]);
    }

    /// A zero on the diagonal, entries of very different size, and the residual of the solution.
    #[test]
    fn rows_are_swapped_where_pivots_are_small() {
        for n in [1, 2, 3, 9, 30] {
            let entry = |i: usize, j: usize| {
                let scale = 10_f64.powi((i % 5) as i32 - 2);
                scale
                    * (1.3 * (i + 1) as f64 * (j + 2) as f64).sin()
                    * f64::from(u8::from(i != j || n == 1))
            };
            let matrix = filled(n, n, entry);
            let expected: Vec<f64> = (0..n).map(|i| 1.0 + i as f64).collect();
            let right: Vec<f64> = (0..n)
                .map(|i| (0..n).map(|j| entry(i, j) * expected[j]).sum())
                .collect();
            let answer = PivotedLu::new(matrix).solve(&right);
            for (a, b) in answer.iter().zip(&expected) {
                assert!((a - b).abs() < 1e-10 * n as f64, "{n}: {a} {b}");
            }
        }
    }

    #[test]
    fn singular_matrices_have_no_finite_solution() {
        let answer = PivotedLu::new(filled(2, 2, |_, _| 1.0)).solve(&[1.0, 2.0]);
        assert!(answer.iter().all(|value| !value.is_finite()));
    }
}
