//! Confidence bands by the bootstrap (Efron 1979).

use jostle::linear::quantile;

use super::curve::Curve;
use super::fragility::FitError;
use crate::sampling::Stream;

/// A band around a fitted curve, point by point.
#[derive(Clone, Debug, PartialEq)]
pub struct Band {
    /// Lower limit of the probability at every intensity asked for \[–\].
    pub low: Vec<f64>,
    /// Upper limit.
    pub high: Vec<f64>,
    /// Resamples that could be fitted.
    pub fitted: usize,
    /// Limits of the median.
    pub median: [f64; 2],
    /// Limits of the dispersion.
    pub dispersion: [f64; 2],
}

const BOOTSTRAP: u64 = 6;

/// Draws whole groups with replacement (all cases of a record belong together: they are not independent), fits each
/// resample, and takes the percentiles in between which `confidence` of the curves lie. `None` when fewer than half
/// of the resamples, or fewer than ten, could be fitted.
pub fn bootstrap_band<T: Copy, C: Into<Curve>>(
    groups: &[Vec<T>],
    resamples: usize,
    confidence: f64,
    seed: u64,
    at: &[f64],
    fit: impl Fn(&[T]) -> Result<C, FitError>,
) -> Option<Band> {
    let mut curves: Vec<Curve> = Vec::new();
    for number in 0..resamples {
        let mut stream = Stream::new(seed, BOOTSTRAP, number as u64);
        let mut sample: Vec<T> = Vec::new();
        for _ in groups {
            let drawn = stream.below(groups.len() as u64) as usize;
            sample.extend(&groups[drawn]);
        }
        curves.extend(fit(&sample).map(Into::into));
    }
    if curves.len() < 10 || 2 * curves.len() < resamples {
        return None;
    }
    let tail = 0.5 * (1.0 - confidence);
    let limits = |mut values: Vec<f64>| {
        values.sort_by(f64::total_cmp);
        [quantile(&values, tail), quantile(&values, 1.0 - tail)]
    };
    let bands: Vec<[f64; 2]> = at
        .iter()
        .map(|x| limits(curves.iter().map(|curve| curve.probability(*x)).collect()))
        .collect();
    Some(Band {
        low: bands.iter().map(|band| band[0]).collect(),
        high: bands.iter().map(|band| band[1]).collect(),
        fitted: curves.len(),
        median: limits(
            curves
                .iter()
                .map(|curve| curve.equivalent().median)
                .collect(),
        ),
        dispersion: limits(
            curves
                .iter()
                .map(|curve| curve.equivalent().dispersion)
                .collect(),
        ),
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::statistics::{Lognormal, fit_lognormal};

    /// Of 200 samples from a known curve, the 90 % band of the median should hold the truth in about 180.
    /// Four standard deviations of a binomial count of 80 are 11; bootstrap bands of 120 cases are a little narrow.
    #[test]
    fn bands_hold_the_truth_about_as_often_as_they_say() {
        let held = held_by_bands(80);
        assert!((60..=79).contains(&held), "{held} of 80");
    }

    /// Four standard deviations of a binomial count of 200 are 17.
    #[test]
    #[ignore = "takes half a minute; part of check-all"]
    fn many_bands_hold_the_truth_about_as_often_as_they_say() {
        let held = held_by_bands(200);
        assert!((160..=196).contains(&held), "{held} of 200");
    }

    fn held_by_bands(bands: u64) -> usize {
        let truth = Lognormal {
            median: 1.0,
            dispersion: 0.4,
        };
        let mut held = 0;
        for number in 0..bands {
            let mut stream = Stream::new(21, 97, number);
            let groups: Vec<Vec<(f64, bool)>> = (0..120)
                .map(|i| {
                    let x = 0.4 + 0.2 * f64::from(i % 8);
                    vec![(x, stream.open_uniform() < truth.probability(x))]
                })
                .collect();
            let band = bootstrap_band(&groups, 200, 0.9, number, &[1.0], fit_lognormal);
            let band = band.unwrap_or_else(|| panic!("no band"));
            held += usize::from(band.median[0] <= 1.0 && 1.0 <= band.median[1]);
        }
        held
    }
}
