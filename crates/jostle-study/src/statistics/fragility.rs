//! Lognormal fragility by maximum likelihood.

use super::binary::{Link, regress};
use crate::sampling::{normal_cdf, normal_quantile};

/// P(event | x) = Φ(ln(x/θ)/β).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Lognormal {
    /// θ, the intensity with probability one half, > 0.
    pub median: f64,
    /// β, > 0 \[–\].
    pub dispersion: f64,
}

impl Lognormal {
    /// Probability of the event at an intensity ≥ 0.
    #[must_use]
    pub fn probability(&self, intensity: f64) -> f64 {
        if intensity <= 0.0 {
            return 0.0;
        }
        normal_cdf(libm::log(intensity / self.median) / self.dispersion)
    }

    /// Intensity at which the event has this probability, between 0 and 1.
    #[must_use]
    pub fn intensity(&self, probability: f64) -> f64 {
        self.median * libm::exp(self.dispersion * normal_quantile(probability))
    }
}

/// An intensity without digits that say nothing.
fn short(intensity: f64) -> f64 {
    (1e6 * intensity).round() / 1e6
}

/// Why no curve could be fitted.
#[derive(Clone, Copy, Debug, PartialEq, thiserror::Error)]
pub enum FitError {
    /// Too little to go by.
    #[error("{cases} usable cases are too few")]
    TooFew {
        /// Cases with an intensity greater than zero and a known outcome.
        cases: usize,
    },
    /// The event always or never happens.
    #[error("the event occurs in {}", one_sided(*events, *cases))]
    OneSided {
        /// Cases with the event.
        events: usize,
        /// All cases.
        cases: usize,
    },
    /// Every intensity without the event lies below every one with it: β tends to zero.
    #[error(
        "the event never happens up to {} and always from {} on: there is no scatter to fit; the median lies between",
        short(*below),
        short(*above)
    )]
    Separated {
        /// Greatest intensity without the event.
        below: f64,
        /// Least intensity with it.
        above: f64,
    },
    /// The same of a logistic regression: the intensities of both outcomes do not overlap.
    #[error(
        "{what}: none up to {} and all from {} on, so that there is no scatter for a logistic regression; the chance of it turns from 0 to 1 in between",
        short(*below),
        short(*above)
    )]
    NoOverlap {
        /// The event.
        what: &'static str,
        /// Greatest intensity without it.
        below: f64,
        /// Least intensity with it.
        above: f64,
    },
    /// The event becomes rarer with the intensity.
    #[error("the event does not become likelier with the intensity")]
    Falling,
    /// The search failed.
    #[error("no curve was fitted: at too few intensities do both outcomes occur; add intensities")]
    NoMaximum,
}

fn one_sided(events: usize, cases: usize) -> String {
    match events {
        0 => format!("none of {cases} cases: add higher intensities"),
        _ => format!("all {cases} cases: add lower intensities"),
    }
}

/// Fits θ and β to outcomes (intensity, event) by maximum likelihood,
///
/// ```text
/// ln L = Σ ln Φ(zᵢ) over events + Σ ln (1 − Φ(zᵢ)) over the others,   zᵢ = ln(xᵢ/θ)/β          (ST3)
/// ```
/// which at equal intensities is the binomial likelihood of stripes (Shinozuka et al. 2000; Baker 2015, Eq. 11).
/// Found as a probit regression on ln x by Fisher scoring with halved steps; the likelihood is concave there.
///
/// # Errors
/// [`FitError`] when no unique maximum exists.
pub fn fit_lognormal(outcomes: &[(f64, bool)]) -> Result<Lognormal, FitError> {
    let [a, b] = regress(outcomes, Link::Probit)?;
    Ok(Lognormal {
        median: libm::exp(-a / b),
        dispersion: 1.0 / b,
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::sampling::Stream;

    /// Two intensities and two unknowns: the fitted curve must pass through both observed shares, which gives θ and β
    /// by hand.
    #[test]
    fn two_stripes_have_a_closed_form() {
        let mut outcomes = Vec::new();
        for (x, events, of) in [(1.0, 3, 20), (2.0, 14, 20)] {
            outcomes.extend((0..of).map(|i| (x, i < events)));
        }
        let fit = fit_lognormal(&outcomes).unwrap_or_else(|error| panic!("{error}"));
        let (z1, z2) = (normal_quantile(3.0 / 20.0), normal_quantile(14.0 / 20.0));
        let dispersion = 2.0_f64.ln() / (z2 - z1);
        let median = (-z1 * dispersion).exp();
        assert!((fit.dispersion / dispersion - 1.0).abs() < 1e-9, "{fit:?}");
        assert!((fit.median / median - 1.0).abs() < 1e-9, "{fit:?}");
    }

    /// Outcomes drawn from a known curve: θ = 0.8, β = 0.45; tolerances are four standard errors of 20 000 draws.
    #[test]
    fn a_known_curve_is_found_again() {
        let truth = Lognormal {
            median: 0.8,
            dispersion: 0.45,
        };
        let mut stream = Stream::new(11, 99, 0);
        let outcomes: Vec<(f64, bool)> = (0..20_000)
            .map(|i| {
                let x = 0.2 * f64::from(1 + i % 10);
                (x, stream.open_uniform() < truth.probability(x))
            })
            .collect();
        let fit = fit_lognormal(&outcomes).unwrap_or_else(|error| panic!("{error}"));
        assert!((fit.median / 0.8).ln().abs() < 0.03, "{fit:?}");
        assert!((fit.dispersion - 0.45).abs() < 0.03, "{fit:?}");
        // No other pair is likelier: the maximum is one.
        let score = |fit: Lognormal| -> f64 {
            outcomes
                .iter()
                .map(|(x, event)| {
                    let p = fit.probability(*x);
                    if *event { p.ln() } else { (1.0 - p).ln() }
                })
                .sum()
        };
        for (dm, db) in [(1.001, 1.0), (0.999, 1.0), (1.0, 1.001), (1.0, 0.999)] {
            let other = Lognormal {
                median: fit.median * dm,
                dispersion: fit.dispersion * db,
            };
            assert!(
                score(other) < score(fit),
                "{other:?} is likelier than {fit:?}"
            );
        }
    }

    #[test]
    fn what_cannot_be_fitted_is_said() {
        let one_sided = fit_lognormal(&[(1.0, false), (2.0, false), (3.0, false)]);
        assert_eq!(
            one_sided,
            Err(FitError::OneSided {
                events: 0,
                cases: 3
            })
        );
        let separated = fit_lognormal(&[(1.0, false), (2.0, false), (3.0, true)]);
        assert!(
            matches!(separated, Err(FitError::Separated { .. })),
            "{separated:?}"
        );
        let falling: Vec<(f64, bool)> = (0..40)
            .map(|i| (f64::from(1 + i % 4), i % 4 < 2 || i > 36))
            .collect();
        assert_eq!(fit_lognormal(&falling), Err(FitError::Falling));
        assert_eq!(fit_lognormal(&[]), Err(FitError::TooFew { cases: 0 }));
    }

    #[test]
    fn probability_and_intensity_are_inverse() {
        let curve = Lognormal {
            median: 2.5,
            dispersion: 0.3,
        };
        for p in [0.01, 0.16, 0.5, 0.84, 0.99] {
            assert!((curve.probability(curve.intensity(p)) - p).abs() < 1e-9);
        }
        assert_eq!(curve.probability(0.0), 0.0);
    }
}
