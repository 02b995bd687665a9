//! Square matrices whose pattern is symmetric, stored row by row between the first and the last entry of a row.

use std::ops::Range;

/// A square matrix with a symmetric pattern: every row from its first to its last column that may differ from zero.
#[derive(Clone, Debug, Default)]
pub(crate) struct Envelope {
    columns: Vec<Range<usize>>,
    /// Where every row starts among the values.
    starts: Vec<usize>,
    values: Vec<f64>,
    /// Rows that are eliminated together, by column.
    packed: Vec<[f64; SIDE_BY_SIDE]>,
}

impl Envelope {
    /// Sets the pattern from the first column of every row, at most its own index, and all entries to zero.
    pub(crate) fn reset(&mut self, first_columns: impl Iterator<Item = usize>) {
        self.columns.clear();
        self.columns
            .extend(first_columns.enumerate().map(|(row, first)| first..row + 1));
        for row in 0..self.columns.len() {
            for column in self.columns[row].start..row {
                self.columns[column].end = row + 1;
            }
        }
        self.fill_with_zeros();
    }

    /// Takes over the pattern of another matrix, and sets all entries to zero.
    pub(crate) fn reset_like(&mut self, other: &Self) {
        self.columns.clone_from(&other.columns);
        self.fill_with_zeros();
    }

    fn fill_with_zeros(&mut self) {
        self.starts.clear();
        let mut total = 0;
        for columns in &self.columns {
            self.starts.push(total);
            total += columns.len();
        }
        self.values.clear();
        self.values.resize(total, 0.0);
    }

    /// Number of rows.
    pub(crate) fn size(&self) -> usize {
        self.columns.len()
    }

    /// Number of stored entries.
    pub(crate) fn stored(&self) -> usize {
        self.values.len()
    }

    /// Columns of a row that may differ from zero.
    #[inline]
    pub(crate) fn columns(&self, row: usize) -> Range<usize> {
        self.columns[row].clone()
    }

    #[inline]
    fn place(&self, row: usize, column: usize) -> usize {
        self.starts[row] + column - self.columns[row].start
    }

    /// The stored entries of a row.
    #[inline]
    pub(crate) fn row(&self, row: usize) -> &[f64] {
        &self.values[self.starts[row]..][..self.columns[row].len()]
    }

    /// An entry within the envelope.
    #[inline]
    pub(crate) fn get(&self, row: usize, column: usize) -> f64 {
        self.values[self.place(row, column)]
    }

    #[inline]
    pub(crate) fn set(&mut self, row: usize, column: usize, value: f64) {
        let place = self.place(row, column);
        self.values[place] = value;
    }

    /// Row times vector.
    #[inline]
    pub(crate) fn times(&self, row: usize, vector: impl Fn(usize) -> f64) -> f64 {
        let values = &self.values[self.starts[row]..];
        let terms = self.columns(row).zip(values);
        terms.map(|(column, value)| value * vector(column)).sum()
    }

    /// Replaces the lower half by L and D of A = L D Lᵀ, without row exchanges, since A is positive definite. What fills
    /// in stays within the envelope (A. Jennings, 1966, Comput. J. 9, 281–285). Returns the multiply-adds.
    pub(crate) fn factorize(&mut self) -> u64 {
        let mut operations = 0;
        let mut packed = std::mem::take(&mut self.packed);
        let mut row = 0;
        while row < self.size() {
            // Left of the diagonal block, rows that begin at the same column are eliminated together.
            let first = self.columns[row].start;
            let rows = self.rows_alike(row);
            let known = if rows == SIDE_BY_SIDE { row } else { first };
            if known > first {
                packed.clear();
                packed.extend((first..row).map(|column| {
                    std::array::from_fn::<f64, SIDE_BY_SIDE, _>(|r| self.get(row + r, column))
                }));
                for column in first..row {
                    let from = first.max(self.columns[column].start);
                    let above = &self.row(column)[from - self.columns[column].start..];
                    let (before, current) = packed[from - first..].split_at_mut(column - from);
                    let sums = sums_of_products(before, above);
                    for (entry, sum) in current[0].iter_mut().zip(sums) {
                        *entry -= sum;
                    }
                    operations += (SIDE_BY_SIDE * (column - from)) as u64;
                }
                for (column, entries) in (first..row).zip(&packed) {
                    for (r, entry) in entries.iter().enumerate() {
                        self.set(row + r, column, *entry);
                    }
                }
            }
            for row in row..row + rows {
                operations += self.finish_row(row, known);
            }
            row += rows;
        }
        self.packed = packed;
        operations
    }

    /// Rows from this one that begin at the same column: [`SIDE_BY_SIDE`] of them, or one.
    fn rows_alike(&self, row: usize) -> usize {
        let first = self.columns[row].start;
        match self.columns.get(row..row + SIDE_BY_SIDE) {
            Some(rows) if rows.iter().all(|row| row.start == first) => SIDE_BY_SIDE,
            _ => 1,
        }
    }

    /// Eliminates a row whose entries of L D left of a column are known, and divides it by the pivots. Returns the multiply-adds.
    fn finish_row(&mut self, row: usize, known: usize) -> u64 {
        let mut operations = 0;
        let first = self.columns[row].start;
        for column in known..row {
            let from = first.max(self.columns[column].start);
            let sum: f64 = (from..column)
                .map(|k| self.get(row, k) * self.get(column, k))
                .sum();
            // Not yet divided by its pivot: L D.
            self.set(row, column, self.get(row, column) - sum);
            operations += (column - from) as u64;
        }
        let mut pivot = self.get(row, row);
        for column in first..row {
            let scaled = self.get(row, column);
            let coupling = scaled / self.get(column, column);
            pivot -= scaled * coupling;
            self.set(row, column, coupling);
        }
        self.set(row, row, pivot);
        operations + 2 * (row - first) as u64
    }

    /// Solves with the factors of [`Envelope::factorize`].
    pub(crate) fn solve(&self, vector: &mut [f64]) {
        let mut row = 0;
        while row < self.size() {
            let first = self.columns[row].start;
            let rows = self.rows_alike(row);
            let mut known = [0.0; SIDE_BY_SIDE];
            if rows == SIDE_BY_SIDE {
                let entries: [&[f64]; SIDE_BY_SIDE] =
                    std::array::from_fn(|r| &self.row(row + r)[..row - first]);
                for (k, value) in vector[first..row].iter().enumerate() {
                    for (sum, entries) in known.iter_mut().zip(entries) {
                        *sum += entries[k] * value;
                    }
                }
            }
            let before = if rows == SIDE_BY_SIDE { row } else { first };
            for (row, mut known) in (row..row + rows).zip(known) {
                for k in before..row {
                    known += self.get(row, k) * vector[k];
                }
                vector[row] -= known;
            }
            row += rows;
        }
        for row in 0..self.size() {
            vector[row] /= self.get(row, row);
        }
        for row in (0..self.size()).rev() {
            let first = self.columns[row].start;
            for k in first..row {
                vector[k] -= self.get(row, k) * vector[row];
            }
        }
    }
}

/// Rows that are eliminated together, so that their sums do not wait for one another.
const SIDE_BY_SIDE: usize = 8;

/// Products of several rows, given by column, with another row; each sum in the order of the columns.
#[inline]
fn sums_of_products(rows: &[[f64; SIDE_BY_SIDE]], other: &[f64]) -> [f64; SIDE_BY_SIDE] {
    let mut sums = [0.0; SIDE_BY_SIDE];
    for (entries, factor) in rows.iter().zip(other) {
        for (sum, entry) in sums.iter_mut().zip(entries) {
            *sum += entry * factor;
        }
    }
    sums
}

/// A square matrix with room beside an envelope for what row exchanges move and fill.
#[derive(Clone, Debug, Default)]
pub(crate) struct PivotedEnvelope {
    size: usize,
    /// Most columns left of the diagonal in the envelope; rows have twice as many on the right.
    reach: usize,
    width: usize,
    /// Last column of every row that may differ from zero.
    last: Vec<usize>,
    values: Vec<f64>,
}

impl PivotedEnvelope {
    /// Takes over the envelope of a matrix, and sets all entries to zero.
    pub(crate) fn reset_like(&mut self, pattern: &Envelope) {
        self.size = pattern.size();
        let reaches = pattern.columns.iter().enumerate();
        let reach = reaches.map(|(row, columns)| row - columns.start).max();
        self.reach = reach.unwrap_or(0);
        self.width = (3 * self.reach + 1).min(self.size);
        self.last.clear();
        self.last
            .extend(pattern.columns.iter().map(|columns| columns.end - 1));
        self.values.clear();
        self.values.resize(self.size * self.width, 0.0);
    }

    #[inline]
    fn place(&self, row: usize, column: usize) -> usize {
        // Rows of a full matrix all begin with column 0.
        let first = if self.width == self.size {
            0
        } else {
            row.saturating_sub(self.reach)
        };
        row * self.width + column - first
    }

    /// Sets an entry of the envelope.
    #[inline]
    pub(crate) fn set(&mut self, row: usize, column: usize, value: f64) {
        let place = self.place(row, column);
        self.values[place] = value;
    }

    /// Entries of a row in some columns of the envelope.
    #[inline]
    pub(crate) fn row_mut(&mut self, row: usize, columns: Range<usize>) -> &mut [f64] {
        let first = self.place(row, columns.start);
        &mut self.values[first..first + columns.len()]
    }

    /// Replaces the right-hand side by the solution, with row exchanges, and destroys the matrix. Returns the
    /// multiply-adds; `None` if the matrix is singular.
    pub(crate) fn eliminate(&mut self, side: &mut [f64]) -> Option<u64> {
        let n = self.size;
        let mut operations = 0;
        for pivot in 0..n {
            let below = n.min(pivot + self.reach + 1);
            let size = |row: usize| self.values[self.place(row, pivot)].abs();
            // The last of the greatest.
            let (mut best, mut greatest) = (pivot, size(pivot));
            for row in pivot + 1..below {
                let size = size(row);
                if size >= greatest || size.is_nan() {
                    (best, greatest) = (row, size);
                }
            }
            if best != pivot {
                let last = self.last[pivot].max(self.last[best]);
                for column in pivot..=last {
                    let (a, b) = (self.place(pivot, column), self.place(best, column));
                    self.values.swap(a, b);
                }
                self.last.swap(pivot, best);
                side.swap(pivot, best);
            }
            let place = self.place(pivot, pivot);
            if self.values[place] == 0.0 {
                return None;
            }
            let (divisor, reached) = (self.values[place], self.last[pivot]);
            let right = reached - pivot;
            for row in pivot + 1..below {
                let at = self.place(row, pivot);
                let entry = self.values[at];
                if entry == 0.0 {
                    continue;
                }
                let share = entry / divisor;
                if share == 0.0 {
                    continue;
                }
                self.last[row] = self.last[row].max(reached);
                let (above, rest) = self.values.split_at_mut(at);
                let above = &above[place + 1..=place + right];
                for (value, above) in rest[1..=right].iter_mut().zip(above) {
                    *value -= share * above;
                }
                side[row] -= share * side[pivot];
                operations += right as u64 + 2;
            }
        }
        for row in (0..n).rev() {
            let place = self.place(row, row);
            let right = self.last[row] - row;
            let known = self.values[place + 1..=place + right].iter();
            let known: f64 = known.zip(&side[row + 1..]).map(|(a, x)| a * x).sum();
            side[row] = (side[row] - known) / self.values[place];
            operations += right as u64 + 1;
        }
        Some(operations)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Rows of a band, of an arrow, and of two separate blocks.
    fn patterns() -> [Vec<usize>; 4] {
        [
            vec![0],
            vec![0, 0, 0, 1, 2, 3, 4],
            vec![0, 1, 2, 3, 0],
            vec![0, 0, 1, 3, 3, 4],
        ]
    }

    #[test]
    fn factors_solve_what_they_were_made_of() {
        for firsts in patterns() {
            let mut matrix = Envelope::default();
            matrix.reset(firsts.iter().copied());
            let n = matrix.size();
            let mut full = vec![vec![0.0; n]; n];
            for (i, row) in full.iter_mut().enumerate() {
                for j in matrix.columns(i) {
                    if matrix.columns(i.max(j)).start > i.min(j) {
                        // Right of the diagonal a row has room for the columns between, too.
                        continue;
                    }
                    row[j] = if i == j {
                        6.0 + i as f64
                    } else {
                        1.0 / (i.abs_diff(j) + i.min(j) + 1) as f64
                    };
                    matrix.set(i, j, row[j]);
                }
            }
            let exact: Vec<f64> = (0..n).map(|i| (i as f64 - 2.5) * 0.7).collect();
            let product = |row: &Vec<f64>| row.iter().zip(&exact).map(|(a, x)| a * x).sum();
            let mut vector: Vec<f64> = full.iter().map(product).collect();
            for (i, expected) in vector.iter().enumerate() {
                assert!((matrix.times(i, |j| exact[j]) - expected).abs() < 1e-14);
            }
            matrix.factorize();
            matrix.solve(&mut vector);
            for (found, exact) in vector.iter().zip(&exact) {
                assert!((found - exact).abs() < 1e-14, "{firsts:?}");
            }
        }
    }

    /// Rows that are eliminated together have the bits of rows eliminated one by one, before and behind rows that begin elsewhere.
    #[test]
    fn rows_together_have_the_bits_of_rows_alone() {
        let firsts = (0..41_usize).map(|row| match row {
            0..20 => 0,
            20..25 => row - 3,
            _ => 2,
        });
        let mut matrix = Envelope::default();
        matrix.reset(firsts);
        for i in 0..matrix.size() {
            for j in matrix.columns(i).start..=i {
                let value = 1.0 / (3.0 + libm::sin((7 * i + 3 * j) as f64));
                matrix.set(i, j, if i == j { 50.0 + value } else { value });
            }
        }
        let side: Vec<f64> = (0..matrix.size()).map(|i| libm::cos(i as f64)).collect();
        let mut alone = matrix.clone();
        let operations: u64 = (0..alone.size())
            .map(|row| alone.finish_row(row, alone.columns[row].start))
            .sum();
        assert_eq!(matrix.factorize(), operations);
        for row in 0..matrix.size() {
            assert_eq!(matrix.row(row), alone.row(row), "{row}");
        }
        let mut found = side.clone();
        matrix.solve(&mut found);
        let mut known = side;
        for row in 0..alone.size() {
            let columns = alone.columns(row).start..row;
            let sum: f64 = columns.map(|k| alone.get(row, k) * known[k]).sum();
            known[row] -= sum;
        }
        for row in 0..alone.size() {
            known[row] /= alone.get(row, row);
        }
        for row in (0..alone.size()).rev() {
            for k in alone.columns(row).start..row {
                known[k] -= alone.get(row, k) * known[row];
            }
        }
        assert_eq!(found, known);
    }

    #[test]
    fn work_grows_with_the_length_of_a_band_only_once() {
        let operations = |size: usize| {
            let mut band = Envelope::default();
            band.reset((0..size).map(|row: usize| row.saturating_sub(4)));
            (0..size).for_each(|i| band.set(i, i, 1.0));
            band.factorize()
        };
        let [a, b, c] = [100, 200, 300].map(operations);
        assert_eq!(b - a, c - b);
    }

    fn pivoted(pattern: &Envelope, entry: impl Fn(usize, usize) -> f64) -> PivotedEnvelope {
        let mut matrix = PivotedEnvelope::default();
        matrix.reset_like(pattern);
        for row in 0..pattern.size() {
            for column in pattern.columns(row) {
                matrix.set(row, column, entry(row, column));
            }
        }
        matrix
    }

    #[test]
    fn elimination_exchanges_rows() {
        let mut full = Envelope::default();
        full.reset([0, 0, 0].into_iter());
        // x = (2, −1, 3); the first pivot is zero.
        let entries = [[0.0, 2.0, 1.0], [1.0, -1.0, 2.0], [4.0, 1.0, -3.0]];
        let mut side = vec![1.0, 9.0, -2.0];
        let found = pivoted(&full, |i, j| entries[i][j]).eliminate(&mut side);
        assert!(found.is_some());
        for (found, exact) in side.iter().zip([2.0, -1.0, 3.0]) {
            assert!((found - exact).abs() < 1e-14, "{side:?}");
        }
        let mut two = Envelope::default();
        two.reset([0, 0].into_iter());
        let singular = |i: usize, _: usize| 1.0 + i as f64;
        assert!(pivoted(&two, singular).eliminate(&mut [1.0, 1.0]).is_none());
    }

    /// Unsymmetric matrices of every pattern, and long bands of all widths, with small and with zero pivots.
    #[test]
    fn exchanged_rows_stay_within_their_room() {
        let bands = (1..6).map(|reach| {
            (0..40)
                .map(|row: usize| row.saturating_sub(reach))
                .collect()
        });
        for firsts in patterns().into_iter().chain(bands) {
            let mut pattern = Envelope::default();
            pattern.reset(firsts.iter().copied());
            let n = pattern.size();
            let entry = |i: usize, j: usize| {
                let small = if i == j { 1e-3 } else { 1.0 };
                small * (1.3 * (i + 1) as f64 * (j + 2) as f64).sin() + f64::from(u8::from(n == 1))
            };
            let exact: Vec<f64> = (0..n).map(|i| 1.0 + (i % 7) as f64).collect();
            let product = |i: usize| pattern.columns(i).map(|j| entry(i, j) * exact[j]).sum();
            let mut side: Vec<f64> = (0..n).map(product).collect();
            let found = pivoted(&pattern, entry).eliminate(&mut side);
            assert!(found.is_some(), "{firsts:?}");
            for (found, exact) in side.iter().zip(&exact) {
                assert!((found - exact).abs() < 1e-8, "{firsts:?}: {found} {exact}");
            }
        }
    }
}
