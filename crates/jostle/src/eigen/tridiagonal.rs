//! Eigenvalues of small symmetric tridiagonal matrices.

/// Eigenvalues of the matrix with this diagonal and next diagonal, and the given matrix, column after column, times that of
/// its eigenvectors. Implicit QL iteration with Wilkinson's shift.
///
/// A unit matrix gives full eigenvectors; a single row of it costs one order less.
#[inline(always)]
pub(super) fn eigen(diagonal: &[f64], next: &[f64], columns: &mut [f64]) -> Vec<f64> {
    let n = diagonal.len();
    let height = columns.len() / n.max(1);
    let mut d = diagonal.to_vec();
    let mut e = next[..n.saturating_sub(1)].to_vec();
    e.push(0.0);
    for low in 0..n {
        // Converges cubically; the limit only guards against NaN.
        for _ in 0..100 {
            let negligible =
                |m: usize| e[m].abs() <= f64::EPSILON * (d[m].abs() + d[m + 1].abs()) * 0.5;
            let high = (low..n - 1).find(|&m| negligible(m)).unwrap_or(n - 1);
            if high == low {
                break;
            }
            let slope = (d[low + 1] - d[low]) / (2.0 * e[low]);
            let mut g =
                d[high] - d[low] + e[low] / (slope + libm::hypot(slope, 1.0).copysign(slope));
            let (mut sine, mut cosine, mut passed) = (1.0, 1.0, 0.0);
            let mut split = false;
            for i in (low..high).rev() {
                let (f, b) = (sine * e[i], cosine * e[i]);
                let r = hypotenuse(f, g);
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
                let pair = &mut columns[i * height..(i + 2) * height];
                let (one, other) = pair.split_at_mut(height);
                for (a, b) in one.iter_mut().zip(other) {
                    (*a, *b) = (cosine * *a - sine * *b, sine * *a + cosine * *b);
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

/// √(a² + b²), computed directly if squares neither underflow nor overflow.
#[inline(always)]
fn hypotenuse(a: f64, b: f64) -> f64 {
    let square = a * a + b * b;
    if (1e-280..1e300).contains(&square) {
        square.sqrt()
    } else {
        libm::hypot(a, b)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// 2 on the diagonal, −1 beside it: 2 − 2 cos(jπ/(n+1)), sines for eigenvectors.
    #[test]
    fn second_difference_has_its_known_eigenvalues_and_sines() {
        let n = 30;
        let unit = |i: usize| f64::from(u8::from(i.is_multiple_of(n + 1)));
        let mut columns: Vec<f64> = (0..n * n).map(unit).collect();
        let values = eigen(&vec![2.0; n], &vec![-1.0; n - 1], &mut columns);
        let mut order: Vec<usize> = (0..n).collect();
        order.sort_by(|a, b| values[*a].total_cmp(&values[*b]));
        for (k, &place) in order.iter().enumerate() {
            let angle = (k + 1) as f64 * std::f64::consts::PI / (n + 1) as f64;
            let expected = 2.0 - 2.0 * angle.cos();
            assert!(
                (values[place] - expected).abs() < 4e-15,
                "eigenvalue {k}: {} instead of {expected}",
                values[place]
            );
            let norm = (2.0 / (n + 1) as f64).sqrt();
            let column = &columns[place * n..][..n];
            let sign = column[0].signum();
            for (i, value) in column.iter().enumerate() {
                let expected = norm * ((i + 1) as f64 * angle).sin();
                let got = sign * value;
                assert!(
                    (got - expected).abs() < 1e-13,
                    "eigenvector {k}, row {i}: {got} instead of {expected}"
                );
            }
        }
    }

    #[test]
    fn separate_blocks_and_single_numbers_are_no_trouble() {
        let mut row = [1.0, 0.0, 0.0];
        let mut values = eigen(&[3.0, 1.0, 2.0], &[0.0, 0.0], &mut row);
        values.sort_by(f64::total_cmp);
        assert_eq!(values, [1.0, 2.0, 3.0]);
        assert_eq!(row, [1.0, 0.0, 0.0]);
        assert_eq!(eigen(&[5.0], &[], &mut []), [5.0]);
    }
}
