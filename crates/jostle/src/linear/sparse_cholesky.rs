//! A general sparse symmetric elimination: minimum degree ordering, then LDLᵀ row by row along the elimination tree.
//!
//! It does not use buildings or transfer paths, so it can check the Riccati recursion.

use std::collections::BTreeSet;

/// No parent: the root of an elimination tree.
const ROOT: usize = usize::MAX;

/// Order of elimination and pattern of a symmetric matrix.
#[derive(Clone, Debug)]
pub(crate) struct Pattern {
    /// Position of each row in the elimination order.
    place: Vec<usize>,
    /// Upper triangle of the reordered matrix: rows of every column, and where each given entry is added.
    starts: Vec<usize>,
    rows: Vec<usize>,
    slots: Vec<usize>,
    /// Parent in the elimination tree.
    parents: Vec<usize>,
    /// Where every column of L starts.
    factor_starts: Vec<usize>,
}

/// L with a unit diagonal, and D.
#[derive(Clone, Debug, Default)]
pub(crate) struct SparseFactor {
    rows: Vec<usize>,
    values: Vec<f64>,
    diagonal: Vec<f64>,
}

/// The row whose pivot is not positive.
pub(crate) struct NoPivot(pub(crate) usize);

impl Pattern {
    /// The pattern of a matrix of this order with the given entries (row, column); either triangle may be given, not both.
    pub(crate) fn new(order: usize, entries: &[(usize, usize)]) -> Self {
        let place = minimum_degree(order, entries);
        let reordered = |&(row, column): &(usize, usize)| {
            let (a, b) = (place[row], place[column]);
            (a.max(b), a.min(b))
        };
        let mut sorted: Vec<(usize, usize)> = entries.iter().map(reordered).collect();
        sorted.sort_unstable();
        sorted.dedup();
        let starts = (0..=order).map(|column| sorted.partition_point(|entry| entry.0 < column));
        let starts: Vec<usize> = starts.collect();
        let slots = entries.iter().map(reordered);
        let slots = slots.map(|entry| sorted.partition_point(|other| *other < entry));
        let slots = slots.collect();
        let rows = sorted.into_iter().map(|(_, row)| row).collect();
        let mut pattern = Self {
            place,
            starts,
            rows,
            slots,
            parents: vec![ROOT; order],
            factor_starts: Vec::new(),
        };
        let mut counts = vec![0; order];
        let mut seen = vec![ROOT; order];
        for column in 0..order {
            seen[column] = column;
            for entry in pattern.starts[column]..pattern.starts[column + 1] {
                let mut row = pattern.rows[entry];
                while seen[row] != column {
                    if pattern.parents[row] == ROOT {
                        pattern.parents[row] = column;
                    }
                    counts[row] += 1;
                    seen[row] = column;
                    row = pattern.parents[row];
                }
            }
        }
        let mut total = 0;
        pattern.factor_starts = std::iter::once(0)
            .chain(counts.into_iter().map(|count| {
                total += count;
                total
            }))
            .collect();
        pattern
    }

    /// Factorises the matrix whose entries have these values, in the order in which they were given to [`Pattern::new`];
    /// entries given several times are summed (T. A. Davis, 2005, ACM Trans. Math. Softw. 31, 587–591).
    pub(crate) fn factorize(
        &self,
        values: impl Iterator<Item = f64>,
        factor: &mut SparseFactor,
    ) -> Result<(), NoPivot> {
        let order = self.place.len();
        let mut matrix = vec![0.0; self.rows.len()];
        for (slot, value) in self.slots.iter().zip(values) {
            matrix[*slot] += value;
        }
        let entries = self.factor_starts[order];
        factor.rows.resize(entries, 0);
        factor.values.resize(entries, 0.0);
        factor.diagonal.resize(order, 0.0);
        let mut ends = self.factor_starts[..order].to_vec();
        let mut row_of_l = vec![0.0; order];
        let mut seen = vec![ROOT; order];
        // Columns that meet the row, and the way along the tree from one entry.
        let (mut met, mut path) = (Vec::with_capacity(order), Vec::with_capacity(order));
        for k in 0..order {
            seen[k] = k;
            met.clear();
            for entry in self.starts[k]..self.starts[k + 1] {
                let mut row = self.rows[entry];
                row_of_l[row] += matrix[entry];
                while seen[row] != k {
                    path.push(row);
                    seen[row] = k;
                    row = self.parents[row];
                }
                // Reversed twice: descendants before ancestors.
                met.extend(path.drain(..).rev());
            }
            let mut pivot = std::mem::take(&mut row_of_l[k]);
            for &column in met.iter().rev() {
                let value = std::mem::take(&mut row_of_l[column]);
                let range = self.factor_starts[column]..ends[column];
                for (row, entry) in factor.rows[range.clone()].iter().zip(&factor.values[range]) {
                    row_of_l[*row] -= entry * value;
                }
                let scaled = value / factor.diagonal[column];
                pivot -= scaled * value;
                factor.rows[ends[column]] = k;
                factor.values[ends[column]] = scaled;
                ends[column] += 1;
            }
            if pivot <= 0.0 || !pivot.is_finite() {
                let row = self.place.iter().position(|place| *place == k);
                return Err(NoPivot(row.unwrap_or(k)));
            }
            factor.diagonal[k] = pivot;
        }
        Ok(())
    }

    /// Solves A x = b; `b` becomes `x`.
    pub(crate) fn solve(&self, factor: &SparseFactor, load: &mut [f64]) {
        let order = self.place.len();
        let mut x = vec![0.0; order];
        for (value, place) in load.iter().zip(&self.place) {
            x[*place] = *value;
        }
        let column = |k: usize| {
            let range = self.factor_starts[k]..self.factor_starts[k + 1];
            factor.rows[range.clone()].iter().zip(&factor.values[range])
        };
        for k in 0..order {
            let value = x[k];
            column(k).for_each(|(row, entry)| x[*row] -= entry * value);
        }
        for k in (0..order).rev() {
            let sum: f64 = column(k).map(|(row, entry)| entry * x[*row]).sum();
            x[k] = x[k] / factor.diagonal[k] - sum;
        }
        for (value, place) in load.iter_mut().zip(&self.place) {
            *value = x[*place];
        }
    }
}

/// Eliminates at each step the row with the fewest neighbours left, which become neighbours of each other (W. F.
/// Tinney, J. W. Walker, 1967, Proc. IEEE 55, 1801–1809). Returns the position of each row in the elimination
/// order.
fn minimum_degree(order: usize, entries: &[(usize, usize)]) -> Vec<usize> {
    let mut neighbours = vec![BTreeSet::new(); order];
    for &(row, column) in entries.iter().filter(|(row, column)| row != column) {
        neighbours[row].insert(column);
        neighbours[column].insert(row);
    }
    let degrees = neighbours.iter().map(BTreeSet::len);
    let mut left: BTreeSet<(usize, usize)> = degrees
        .enumerate()
        .map(|(row, degree)| (degree, row))
        .collect();
    let mut place = vec![0; order];
    for step in 0..order {
        let Some((_, row)) = left.pop_first() else {
            break;
        };
        place[row] = step;
        let clique = std::mem::take(&mut neighbours[row]);
        for &other in &clique {
            let before = neighbours[other].len();
            neighbours[other].remove(&row);
            neighbours[other].extend(clique.iter().filter(|next| **next != other));
            let after = neighbours[other].len();
            if after != before {
                left.remove(&(before, other));
                left.insert((after, other));
            }
        }
    }
    place
}

#[cfg(test)]
mod tests {
    use nalgebra::{DMatrix, DVector};

    use super::*;

    /// A grid with some long-range couplings, against a full library elimination.
    #[test]
    fn solves_what_a_library_solves() {
        for (wide, high) in [(1, 1), (1, 7), (4, 5), (9, 8)] {
            let n = wide * high;
            let mut entries = Vec::new();
            let mut values = Vec::new();
            let mut full = DMatrix::<f64>::zeros(n, n);
            let mut add = |row: usize, column: usize, value: f64| {
                entries.push((row, column));
                values.push(value);
                full[(row, column)] += value;
                if row != column {
                    full[(column, row)] += value;
                }
            };
            for k in 0..n {
                add(k, k, 4.0 + 0.1 * (k as f64).sin());
                // Given twice: summed.
                add(k, k, 0.5);
                if k % wide > 0 {
                    add(k, k - 1, -1.0);
                }
                if k >= wide {
                    add(k - wide, k, -0.9);
                }
                if k > 10 && k % 7 == 0 {
                    add(k, k - 9, -0.2);
                }
            }
            let right: Vec<f64> = (0..n).map(|k| (1.7 * k as f64).cos()).collect();
            let pattern = Pattern::new(n, &entries);
            let mut factor = SparseFactor::default();
            // Twice, as factors are used again.
            for scale in [3.0, 1.0] {
                let scaled = values.iter().map(|value| scale * value);
                assert!(pattern.factorize(scaled, &mut factor).is_ok());
            }
            let mut answer = right.clone();
            pattern.solve(&factor, &mut answer);
            let library = full.cholesky().expect("definite");
            let expected = library.solve(&DVector::from_column_slice(&right));
            for (k, value) in answer.iter().enumerate() {
                assert!((value - expected[k]).abs() < 1e-13, "{n}: {k}");
            }
        }
    }

    /// A chain and a star cause no fill-in.
    #[test]
    fn trees_are_eliminated_without_fill() {
        let chain: Vec<(usize, usize)> = (1..50).map(|k| (k, k - 1)).collect();
        let star: Vec<(usize, usize)> = (1..50).map(|k| (0, k)).collect();
        for entries in [chain, star] {
            assert_eq!(Pattern::new(50, &entries).factor_starts[50], 49);
        }
    }

    #[test]
    fn the_row_without_resistance_is_named() {
        let pattern = Pattern::new(3, &[(0, 0), (1, 1), (2, 2), (2, 1)]);
        let values = [1.0, 1.0, 1.0, -1.0];
        let failed = pattern.factorize(values.into_iter(), &mut SparseFactor::default());
        assert!(matches!(failed, Err(NoPivot(1 | 2))));
        let values = [-1.0, 1.0, 2.0, -1.0];
        let failed = pattern.factorize(values.into_iter(), &mut SparseFactor::default());
        assert!(matches!(failed, Err(NoPivot(0))));
    }
}
