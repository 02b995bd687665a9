//! Eigenvalues of small symmetric tridiagonal matrices.

/// Eigenvalues of the matrix with this diagonal and next diagonal, and the given rows times the matrix of its
/// eigenvectors. Implicit QL iteration with Wilkinson's shift.
///
/// With the rows of a unit matrix one gets whole eigenvectors; a single row of it costs one order less.
pub(super) fn eigen(diagonal: &[f64], next: &[f64], rows: &mut [Vec<f64>]) -> Vec<f64> {
    let n = diagonal.len();
    let mut d = diagonal.to_vec();
    let mut e = next[..n.saturating_sub(1)].to_vec();
    e.push(0.0);
    for low in 0..n {
        // Converges cubically; the limit only guards against numbers that are not.
        for _ in 0..100 {
            let negligible =
                |m: usize| e[m].abs() <= f64::EPSILON * (d[m].abs() + d[m + 1].abs()) * 0.5;
            let high = (low..n - 1).find(|&m| negligible(m)).unwrap_or(n - 1);
            if high == low {
                break;
            }
            let slope = (d[low + 1] - d[low]) / (2.0 * e[low]);
            let mut g = d[high] - d[low] + e[low] / (slope + slope.hypot(1.0).copysign(slope));
            let (mut sine, mut cosine, mut passed) = (1.0, 1.0, 0.0);
            let mut split = false;
            for i in (low..high).rev() {
                let (f, b) = (sine * e[i], cosine * e[i]);
                let r = f.hypot(g);
                e[i + 1] = r;
                if r == 0.0 {
                    d[i + 1] -= passed;
                    split = true;
                    break;
                }
                (sine, cosine) = (f / r, g / r);
                let from = d[i + 1] - passed;
                let along = (d[i] - from) * sine + 2.0 * cosine * b;
                passed = sine * along;
                d[i + 1] = from + passed;
                g = cosine * along - b;
                for row in &mut *rows {
                    let (a, b) = (row[i], row[i + 1]);
                    row[i + 1] = sine * a + cosine * b;
                    row[i] = cosine * a - sine * b;
                }
            }
            if split {
                e[high] = 0.0;
                continue;
            }
            d[low] -= passed;
            e[low] = g;
            e[high] = 0.0;
        }
    }
    d
}

#[cfg(test)]
mod tests {
    use super::*;

    /// 2 on the diagonal, −1 beside it: 2 − 2 cos(jπ/(n+1)), sines for eigenvectors.
    #[test]
    fn second_difference_has_its_known_eigenvalues_and_sines() {
        let n = 30;
        let mut rows: Vec<Vec<f64>> = (0..n)
            .map(|i| (0..n).map(|j| f64::from(u8::from(i == j))).collect())
            .collect();
        let values = eigen(&vec![2.0; n], &vec![-1.0; n - 1], &mut rows);
        let mut order: Vec<usize> = (0..n).collect();
        order.sort_by(|a, b| values[*a].total_cmp(&values[*b]));
        for (k, &column) in order.iter().enumerate() {
            let angle = (k + 1) as f64 * std::f64::consts::PI / (n + 1) as f64;
            let expected = 2.0 - 2.0 * angle.cos();
            assert!(
                (values[column] - expected).abs() < 4e-15,
                "eigenvalue {k}: {} instead of {expected}",
                values[column]
            );
            let norm = (2.0 / (n + 1) as f64).sqrt();
            let sign = rows[0][column].signum();
            for (i, row) in rows.iter().enumerate() {
                let expected = norm * ((i + 1) as f64 * angle).sin();
                let got = sign * row[column];
                assert!(
                    (got - expected).abs() < 1e-13,
                    "eigenvector {k}, row {i}: {got} instead of {expected}"
                );
            }
        }
    }

    #[test]
    fn separate_blocks_and_single_numbers_are_no_trouble() {
        let mut rows = vec![vec![1.0, 0.0, 0.0]];
        let mut values = eigen(&[3.0, 1.0, 2.0], &[0.0, 0.0], &mut rows);
        values.sort_by(f64::total_cmp);
        assert_eq!(values, [1.0, 2.0, 3.0]);
        assert_eq!(rows[0], [1.0, 0.0, 0.0]);
        assert_eq!(eigen(&[5.0], &[], &mut []), [5.0]);
    }
}
