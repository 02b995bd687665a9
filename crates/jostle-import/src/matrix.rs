//! Symmetric matrices: Cholesky's factors inside an envelope, and symmetry.

/// A symmetric matrix of which each row begins at its first entry: its lower triangle.
pub(crate) struct Envelope {
    firsts: Vec<usize>,
    rows: Vec<Vec<f64>>,
}

impl Envelope {
    /// Zeros from these columns to the diagonal.
    pub(crate) fn new(firsts: Vec<usize>) -> Self {
        let rows = firsts.iter().enumerate();
        let rows = rows
            .map(|(row, first)| vec![0.0; row + 1 - first])
            .collect();
        Self { firsts, rows }
    }

    /// Adds to an entry of the lower triangle, which must lie in the envelope.
    pub(crate) fn add(&mut self, row: usize, column: usize, value: f64) {
        self.rows[row][column - self.firsts[row]] += value;
    }

    pub(crate) fn diagonal(&self, row: usize) -> f64 {
        self.rows[row].last().copied().unwrap_or_default()
    }

    /// Replaces the matrix by its factor; the first row whose pivot is at most `least` of its diagonal is the error.
    ///
    /// # Errors
    /// A row that the others leave without stiffness.
    pub(crate) fn factorize(&mut self, least: f64) -> Result<(), usize> {
        for row in 0..self.rows.len() {
            let first = self.firsts[row];
            let (done, remaining) = self.rows.split_at_mut(row);
            let entries = &mut remaining[0];
            let diagonal = entries[row - first];
            for column in first..row {
                let shared = first.max(self.firsts[column]);
                let above = &done[column][shared - self.firsts[column]..];
                let (pivot, above) = above.split_last().unwrap_or((&1.0, &[]));
                let below = &entries[shared - first..column - first];
                let sum: f64 = below.iter().zip(above).map(|(a, b)| a * b).sum();
                entries[column - first] = (entries[column - first] - sum) / pivot;
            }
            let rest = diagonal
                - entries[..row - first]
                    .iter()
                    .map(|entry| entry * entry)
                    .sum::<f64>();
            if !(rest > least * diagonal && rest.is_finite()) {
                return Err(row);
            }
            entries[row - first] = rest.sqrt();
        }
        Ok(())
    }

    /// Solves with the factor, in place.
    pub(crate) fn solve(&self, values: &mut [f64]) {
        for (row, (entries, first)) in self.rows.iter().zip(&self.firsts).enumerate() {
            let sum: f64 = entries
                .iter()
                .zip(&values[*first..row])
                .map(|(a, b)| a * b)
                .sum();
            values[row] = (values[row] - sum) / entries[row - first];
        }
        for (row, (entries, first)) in self.rows.iter().zip(&self.firsts).enumerate().rev() {
            values[row] /= entries[row - first];
            let value = values[row];
            values[*first..row]
                .iter_mut()
                .zip(entries)
                .for_each(|(other, one)| *other -= one * value);
        }
    }
}

/// Whether a symmetric matrix is positive definite.
pub(crate) fn positive_definite(matrix: &[Vec<f64>]) -> bool {
    let mut envelope = Envelope::new(vec![0; matrix.len()]);
    for (row, matrix) in matrix.iter().enumerate() {
        (0..=row).for_each(|column| envelope.add(row, column, matrix[column]));
    }
    envelope.factorize(0.0).is_ok()
}

/// Makes a matrix symmetric and returns the greatest difference of two entries, in parts of √(F_ii F_jj).
pub(crate) fn symmetrise(matrix: &mut [Vec<f64>]) -> f64 {
    let mut most = 0.0_f64;
    for i in 0..matrix.len() {
        for j in 0..i {
            let size = (matrix[i][i] * matrix[j][j]).abs().sqrt();
            let difference = (matrix[i][j] - matrix[j][i]).abs();
            // Not a number where both are zero.
            most = most.max(if difference == 0.0 {
                0.0
            } else {
                difference / size
            });
            let mean = 0.5 * (matrix[i][j] + matrix[j][i]);
            matrix[i][j] = mean;
            matrix[j][i] = mean;
        }
    }
    most
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn definite_and_symmetric() {
        let mut matrix = vec![vec![4.0, 1.0], vec![3.0, 4.0]];
        assert_eq!(symmetrise(&mut matrix), 0.5);
        assert_eq!(matrix, [[4.0, 2.0], [2.0, 4.0]]);
        assert!(positive_definite(&matrix));
        assert!(!positive_definite(&[vec![1.0, 2.0], vec![2.0, 1.0]]));
        assert!(!positive_definite(&[vec![f64::NAN]]));
    }
}
