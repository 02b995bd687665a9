//! Quantiles of samples.

/// Quantile of values in ascending order at a share of 0 to 1, linear between neighbours; NaN of none.
///
/// R. J. Hyndman and Y. Fan, 1996, Am. Stat. 50, 361–365, type 7: the default of R and of NumPy.
///
/// ```
/// use jostle::linear::quantile;
///
/// assert_eq!(quantile(&[1.0, 2.0, 4.0, 8.0], 0.5), 3.0);
/// ```
#[must_use]
pub fn quantile<T: Copy + Into<f64>>(ordered: &[T], share: f64) -> f64 {
    let Some(last) = ordered.len().checked_sub(1) else {
        return f64::NAN;
    };
    let place = share * last as f64;
    let below = (place.floor() as usize).min(last);
    let [low, high] = [below, (below + 1).min(last)].map(|at| ordered[at].into());
    low + (place - below as f64) * (high - low)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// R: `quantile(c(2, 4, 4, 4, 5, 5, 7, 9), c(0, .16, .5, .84, 1))` gives 2, 4, 4.5, 6.76 and 9.
    #[test]
    fn quantiles_are_those_of_r() {
        let values = [2.0_f32, 4.0, 4.0, 4.0, 5.0, 5.0, 7.0, 9.0];
        for (share, known) in [
            (0.0, 2.0),
            (0.16, 4.0),
            (0.5, 4.5),
            (0.84, 6.76),
            (1.0, 9.0),
        ] {
            assert!((quantile(&values, share) - known).abs() < 1e-12, "{share}");
        }
    }

    #[test]
    fn few_values_have_quantiles() {
        assert_eq!(quantile(&[1.0, 2.0, 4.0], 0.75), 3.0);
        assert_eq!(quantile(&[7.0], 0.05), 7.0);
        assert!(quantile::<f64>(&[], 0.5).is_nan());
    }
}
