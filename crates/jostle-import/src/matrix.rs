//! Symmetric matrices of a few hundred rows.

/// Whether a symmetric matrix is positive definite, by Cholesky's factors.
pub(crate) fn positive_definite(matrix: &[Vec<f64>]) -> bool {
    let n = matrix.len();
    let mut l = vec![vec![0.0_f64; n]; n];
    for i in 0..n {
        for j in 0..=i {
            let below: f64 = l[i][..j].iter().zip(&l[j]).map(|(a, b)| a * b).sum();
            let rest = matrix[i][j] - below;
            if i > j {
                l[i][j] = rest / l[j][j];
            } else if rest > 0.0 && rest.is_finite() {
                l[i][i] = rest.sqrt();
            } else {
                return false;
            }
        }
    }
    true
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
