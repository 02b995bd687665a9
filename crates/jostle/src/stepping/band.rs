//! Banded square matrices: the coupling of contacts and links in a row.

/// A matrix stored by rows, `reach` entries on either side of the diagonal.
#[derive(Clone, Debug, Default)]
pub(super) struct Band {
    size: usize,
    reach: usize,
    values: Vec<f64>,
}

impl Band {
    /// Sets a new size and all entries to zero.
    pub(super) fn reset(&mut self, size: usize, reach: usize) {
        self.size = size;
        self.reach = reach.min(size.saturating_sub(1));
        self.values.clear();
        self.values.resize(size * (2 * self.reach + 1), 0.0);
    }

    pub(super) fn size(&self) -> usize {
        self.size
    }

    pub(super) fn reach(&self) -> usize {
        self.reach
    }

    /// Columns of a row that may differ from zero.
    #[inline]
    pub(super) fn columns(&self, row: usize) -> std::ops::Range<usize> {
        row.saturating_sub(self.reach)..(row + self.reach + 1).min(self.size)
    }

    #[inline]
    fn place(&self, row: usize, column: usize) -> usize {
        row * (2 * self.reach + 1) + self.reach + column - row
    }

    /// An entry within the band.
    #[inline]
    pub(super) fn get(&self, row: usize, column: usize) -> f64 {
        self.values[self.place(row, column)]
    }

    #[inline]
    pub(super) fn set(&mut self, row: usize, column: usize, value: f64) {
        let place = self.place(row, column);
        self.values[place] = value;
    }

    /// Row times vector.
    #[inline]
    pub(super) fn times(&self, row: usize, vector: impl Fn(usize) -> f64) -> f64 {
        self.columns(row)
            .map(|column| self.get(row, column) * vector(column))
            .sum()
    }

    /// Replaces the lower half by L and D of A = L D Lᵀ, without row exchanges, since A is positive definite.
    /// Returns the multiply-adds.
    pub(super) fn factorize(&mut self) -> u64 {
        let mut operations = 0;
        for row in 0..self.size {
            let first = row.saturating_sub(self.reach);
            for column in first..row {
                let from = first.max(column.saturating_sub(self.reach));
                let known: f64 = (from..column)
                    .map(|k| self.get(row, k) * self.get(column, k))
                    .sum();
                // Not yet divided by its pivot: L D.
                self.set(row, column, self.get(row, column) - known);
                operations += (column - from) as u64;
            }
            let mut pivot = self.get(row, row);
            for column in first..row {
                let scaled = self.get(row, column);
                let coupling = scaled / self.get(column, column);
                pivot -= scaled * coupling;
                self.set(row, column, coupling);
            }
            operations += 2 * (row - first) as u64;
            self.set(row, row, pivot);
        }
        operations
    }

    /// Solves with the factors of [`Band::factorize`].
    pub(super) fn solve(&self, vector: &mut [f64]) {
        for row in 0..self.size {
            let first = row.saturating_sub(self.reach);
            let known: f64 = (first..row).map(|k| self.get(row, k) * vector[k]).sum();
            vector[row] -= known;
        }
        for row in 0..self.size {
            vector[row] /= self.get(row, row);
        }
        for row in (0..self.size).rev() {
            let first = row.saturating_sub(self.reach);
            for k in first..row {
                vector[k] -= self.get(row, k) * vector[row];
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn factors_solve_what_they_were_made_of() {
        for (size, reach) in [(1, 0), (5, 1), (9, 3), (6, 5)] {
            let entry = |i: usize, j: usize| {
                let apart = i.abs_diff(j);
                if apart == 0 {
                    6.0 + i as f64
                } else if apart <= reach {
                    1.0 / (apart + i.min(j) + 1) as f64
                } else {
                    0.0
                }
            };
            let mut band = Band::default();
            band.reset(size, reach);
            for i in 0..size {
                for j in band.columns(i) {
                    band.set(i, j, entry(i, j));
                }
            }
            let exact: Vec<f64> = (0..size).map(|i| (i as f64 - 2.5) * 0.7).collect();
            let mut vector: Vec<f64> = (0..size)
                .map(|i| (0..size).map(|j| entry(i, j) * exact[j]).sum())
                .collect();
            let products: Vec<f64> = (0..size).map(|i| band.times(i, |j| exact[j])).collect();
            assert!(
                products
                    .iter()
                    .zip(&vector)
                    .all(|(p, v)| (p - v).abs() < 1e-14)
            );
            band.factorize();
            band.solve(&mut vector);
            for (found, exact) in vector.iter().zip(&exact) {
                assert!((found - exact).abs() < 1e-14, "{size}, {reach}");
            }
        }
    }

    #[test]
    fn work_grows_with_the_length_of_the_row_only_once() {
        let operations = |size: usize| {
            let mut band = Band::default();
            band.reset(size, 4);
            (0..size).for_each(|i| band.set(i, i, 1.0));
            band.factorize()
        };
        let [a, b, c] = [100, 200, 300].map(operations);
        assert_eq!(b - a, c - b);
    }
}
