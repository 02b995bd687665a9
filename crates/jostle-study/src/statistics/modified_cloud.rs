//! Modified cloud analysis: a straight line through the logarithms of the demands that have one, and logistic
//! regressions for the cases without demand and for those that collapse.

use super::binary::{Link, regress};
use super::cloud::{CloudFit, fit_cloud};
use super::fragility::{FitError, Lognormal};

/// P = 1/(1 + exp(−(α₀ + α₁ ln x))).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Logistic {
    /// α₀.
    pub intercept: f64,
    /// α₁ > 0.
    pub slope: f64,
}

impl Logistic {
    /// Probability at an intensity ≥ 0.
    #[must_use]
    pub fn probability(&self, intensity: f64) -> f64 {
        1.0 / (1.0 + libm::exp(-(self.intercept + self.slope * libm::log(intensity))))
    }
}

/// A fit to a cloud with zeros and collapses.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ModifiedCloud {
    /// Probability of a demand greater than zero without collapse; `None` if every case has one.
    pub nonzero: Option<Logistic>,
    /// Probability of collapse; `None` if no case collapses.
    pub collapse: Option<Logistic>,
    /// The demands greater than zero.
    pub cloud: CloudFit,
}

/// A fragility curve of three parts.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct MixedCurve {
    nonzero: Option<Logistic>,
    collapse: Option<Logistic>,
    /// Of the cases with demand.
    exceeding: Lognormal,
    /// The lognormal curve through the intensities at Φ(−1), one half and Φ(1), as far as one can be.
    pub equivalent: Lognormal,
}

/// Φ(1).
const ONE_DEVIATION: f64 = 0.841_344_746_068_542_9;
/// Halvings of an interval in a search.
const HALVINGS: usize = 200;

/// Fits a cloud (intensity, demand) in which demands may be zero, and infinite where a building collapses.
///
/// ```text
/// P(D > d | x) = P_C(x) + (1 − P_C(x)) P_N(x) Φ((ln a + b ln x − ln d)/β)                     (ST4a)
/// ```
/// with logistic P_C (collapse) and P_N (demand greater than zero without collapse). The first two factors are those
/// of Jalayer, Ebrahimian, Miano, Manfredi and Sezen (2017), doi:10.1002/eqe.2922; P_N is the same step for demands
/// that have no logarithm. Both follow from the theorem of total probability.
///
/// # Errors
/// [`FitError`] when one of the three parts cannot be fitted.
pub fn fit_modified_cloud(cloud: &[(f64, f64)]) -> Result<ModifiedCloud, FitError> {
    let collapses: Vec<(f64, bool)> = cloud.iter().map(|(x, d)| (*x, d.is_infinite())).collect();
    let standing: Vec<(f64, f64)> = cloud
        .iter()
        .copied()
        .filter(|(_, d)| d.is_finite())
        .collect();
    let demands: Vec<(f64, bool)> = standing.iter().map(|(x, d)| (*x, *d > 0.0)).collect();
    Ok(ModifiedCloud {
        nonzero: logistic(&demands, true, "demand greater than zero")?,
        collapse: logistic(&collapses, false, "collapse")?,
        cloud: fit_cloud(&standing)?,
    })
}

/// A logistic curve; `None` if all outcomes are what they are usually.
fn logistic(
    outcomes: &[(f64, bool)],
    usual: bool,
    what: &'static str,
) -> Result<Option<Logistic>, FitError> {
    if outcomes.iter().all(|(_, event)| *event == usual) {
        return Ok(None);
    }
    match regress(outcomes, Link::Logit) {
        Ok([intercept, slope]) => Ok(Some(Logistic { intercept, slope })),
        Err(FitError::Separated { below, above }) => {
            Err(FitError::NoOverlap { what, below, above })
        }
        Err(error) => Err(error),
    }
}

impl ModifiedCloud {
    /// The fragility curve of a threshold > 0.
    ///
    /// # Errors
    /// [`FitError::Falling`] when demand does not grow with intensity, [`FitError::NoMaximum`] without scatter.
    pub fn fragility(&self, threshold: f64) -> Result<MixedCurve, FitError> {
        let exceeding = self.cloud.fragility(threshold)?;
        let mut curve = MixedCurve {
            nonzero: self.nonzero,
            collapse: self.collapse,
            exceeding,
            equivalent: exceeding,
        };
        let at = |p| curve.intensity(p).ok_or(FitError::NoMaximum);
        let (low, median, high) = (at(1.0 - ONE_DEVIATION)?, at(0.5)?, at(ONE_DEVIATION)?);
        curve.equivalent = Lognormal {
            median,
            dispersion: 0.5 * libm::log(high / low),
        };
        Ok(curve)
    }
}

impl MixedCurve {
    /// Probability of the event at an intensity ≥ 0.
    #[must_use]
    pub fn probability(&self, intensity: f64) -> f64 {
        if intensity <= 0.0 {
            return 0.0;
        }
        let collapse = self
            .collapse
            .map_or(0.0, |part| part.probability(intensity));
        let nonzero = self.nonzero.map_or(1.0, |part| part.probability(intensity));
        collapse + (1.0 - collapse) * nonzero * self.exceeding.probability(intensity)
    }

    /// Intensity at which the event has a probability between 0 and 1: the curve rises all the way.
    fn intensity(&self, probability: f64) -> Option<f64> {
        let start = libm::log(self.exceeding.median);
        let p = |ln: f64| self.probability(libm::exp(ln));
        let (mut low, mut high, mut reach) = (start, start, 1.0);
        while p(low) > probability && reach < 1e3 {
            low -= reach;
            reach *= 2.0;
        }
        reach = 1.0;
        while p(high) < probability && reach < 1e3 {
            high += reach;
            reach *= 2.0;
        }
        if p(low) > probability || p(high) < probability {
            return None;
        }
        for _ in 0..HALVINGS {
            let middle = 0.5 * (low + high);
            if p(middle) < probability {
                low = middle;
            } else {
                high = middle;
            }
        }
        Some(libm::exp(0.5 * (low + high)))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::sampling::{Stream, normal_cdf, normal_quantile};

    /// α₀, α₁ of demand and of collapse, then ln a, b, β.
    const NONZERO: [f64; 2] = [2.0, 2.5];
    const COLLAPSE: [f64; 2] = [-3.0, 4.0];
    const LINE: [f64; 3] = [0.7, 1.2, 0.3];

    /// The true probability of a demand above a threshold.
    fn truth(x: f64, threshold: f64, collapses: bool) -> f64 {
        let share = |[a, b]: [f64; 2]| 1.0 / (1.0 + (-(a + b * x.ln())).exp());
        let collapse = if collapses { share(COLLAPSE) } else { 0.0 };
        let z = (LINE[0] + LINE[1] * x.ln() - threshold.ln()) / LINE[2];
        collapse + (1.0 - collapse) * share(NONZERO) * normal_cdf(z)
    }

    fn cloud(count: u64, collapses: bool, seed: u64) -> Vec<(f64, f64)> {
        let mut stream = Stream::new(seed, 96, 0);
        let one = |_| {
            let x = 0.1 * (3.4 * stream.open_uniform()).exp();
            let draws = [0; 3].map(|_| stream.open_uniform());
            let share = |[a, b]: [f64; 2]| 1.0 / (1.0 + (-(a + b * x.ln())).exp());
            if collapses && draws[0] < share(COLLAPSE) {
                return (x, f64::INFINITY);
            }
            if draws[1] > share(NONZERO) {
                return (x, 0.0);
            }
            (
                x,
                (LINE[0] + LINE[1] * x.ln() + LINE[2] * normal_quantile(draws[2])).exp(),
            )
        };
        (0..count).map(one).collect()
    }

    /// Drawn from known parts, the curve comes back; the plain cloud, which drops the zeros, lies far above it.
    #[test]
    fn a_known_cloud_with_zeros_is_found_again() {
        for collapses in [false, true] {
            let drawn = cloud(20_000, collapses, 5);
            let zeros = drawn.iter().filter(|(_, d)| *d == 0.0).count();
            assert!(zeros > 6000, "{zeros}");
            let fit = fit_modified_cloud(&drawn).unwrap_or_else(|error| panic!("{error}"));
            assert_eq!(fit.collapse.is_some(), collapses);
            let nonzero = fit.nonzero.unwrap_or_else(|| panic!("no zeros"));
            // Some four standard errors of 20 000 draws.
            assert!((nonzero.intercept - NONZERO[0]).abs() < 0.15, "{fit:?}");
            assert!((nonzero.slope - NONZERO[1]).abs() < 0.15, "{fit:?}");
            let threshold = 0.5;
            let curve = fit
                .fragility(threshold)
                .unwrap_or_else(|error| panic!("{error}"));
            let mut bias: f64 = 0.0;
            let plain = fit_cloud(&drawn).and_then(|fit| fit.fragility(threshold));
            let plain = plain.unwrap_or_else(|error| panic!("{error}"));
            for k in 0..40 {
                let x = 0.1 * (3.4 * f64::from(k) / 39.0).exp();
                let expected = truth(x, threshold, collapses);
                let found = curve.probability(x);
                assert!((found - expected).abs() < 0.02, "{x}: {found} {expected}");
                bias = bias.max(plain.probability(x) - expected);
            }
            assert!(bias > 0.2, "the plain cloud is {bias} too high at most");
            // Against counting, without any model.
            let near: Vec<bool> = drawn
                .iter()
                .filter(|(x, _)| (x / 0.5).ln().abs() < 0.1)
                .map(|(_, d)| *d > threshold)
                .collect();
            let share = near.iter().filter(|event| **event).count() as f64 / near.len() as f64;
            assert!((share - curve.probability(0.5)).abs() < 0.05, "{share}");
            let equivalent = curve.equivalent;
            assert!((curve.probability(equivalent.median) - 0.5).abs() < 1e-9);
        }
    }

    #[test]
    fn without_zeros_it_is_the_cloud() {
        let drawn: Vec<(f64, f64)> = cloud(500, false, 9)
            .into_iter()
            .filter(|(_, d)| *d > 0.0)
            .collect();
        let plain = fit_cloud(&drawn).and_then(|fit| fit.fragility(0.5));
        let mixed = fit_modified_cloud(&drawn).and_then(|fit| fit.fragility(0.5));
        let (plain, mixed) = (
            plain.unwrap_or_else(|e| panic!("{e}")),
            mixed.unwrap_or_else(|e| panic!("{e}")),
        );
        assert!((mixed.equivalent.median / plain.median - 1.0).abs() < 1e-9);
        assert!((mixed.equivalent.dispersion / plain.dispersion - 1.0).abs() < 1e-9);
        assert_eq!(mixed.probability(0.7), plain.probability(0.7));
    }

    #[test]
    fn zeros_that_end_at_one_intensity_are_said() {
        let drawn: Vec<(f64, f64)> = (1..20)
            .map(|k| {
                let x = f64::from(k);
                (
                    x,
                    if k < 8 {
                        0.0
                    } else {
                        x * (1.0 + 0.1 * f64::from(k % 3))
                    },
                )
            })
            .collect();
        match fit_modified_cloud(&drawn) {
            Err(FitError::NoOverlap { what, below, above }) => {
                assert!(what.contains("demand"));
                assert!((below - 7.0).abs() < 1e-9 && (above - 8.0).abs() < 1e-9);
            }
            other => panic!("{other:?}"),
        }
        let zeros: Vec<(f64, f64)> = (1..9).map(|k| (f64::from(k), 0.0)).collect();
        assert!(fit_modified_cloud(&zeros).is_err());
    }
}
