//! Values of a distribution at given probabilities.

use jostle_io::{Distribution, Shape};
use statrs::distribution::{ContinuousCDF, Normal};

/// Φ(z).
pub(crate) fn normal_cdf(z: f64) -> f64 {
    0.5 * statrs::function::erf::erfc(-z / std::f64::consts::SQRT_2)
}

/// Φ⁻¹(p), 0 < p < 1.
pub(crate) fn normal_quantile(p: f64) -> f64 {
    Normal::standard().inverse_cdf(p)
}

/// The value below which a share `p` of the distribution lies, in its own unit; truncation cuts the shares outside
/// away. 0 < p < 1.
#[must_use]
pub fn quantile(distribution: &Distribution, p: f64) -> f64 {
    let (low, high) = (distribution.low, distribution.high);
    let within = |x: f64| {
        x.max(low.unwrap_or(f64::NEG_INFINITY))
            .min(high.unwrap_or(f64::INFINITY))
    };
    match distribution.shape {
        Shape::Uniform { from, to } => from + p * (to - from),
        Shape::Normal { mean, deviation } => {
            let score = |x: f64| (x - mean) / deviation;
            within(mean + deviation * normal_quantile(inside(p, low.map(score), high.map(score))))
        }
        Shape::LogNormal { median, dispersion } => {
            let score = |x: f64| {
                if x > 0.0 {
                    (x / median).ln() / dispersion
                } else {
                    f64::NEG_INFINITY
                }
            };
            let z = normal_quantile(inside(p, low.map(score), high.map(score)));
            within(median * (dispersion * z).exp())
        }
    }
}

/// The probability of the whole normal distribution that answers to `p` of what lies between two scores.
fn inside(p: f64, low: Option<f64>, high: Option<f64>) -> f64 {
    let from = low.map_or(0.0, normal_cdf);
    let to = high.map_or(1.0, normal_cdf);
    (from + p * (to - from)).clamp(f64::MIN_POSITIVE, 1.0 - f64::EPSILON / 2.0)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn plain(shape: Shape) -> Distribution {
        Distribution {
            shape,
            low: None,
            high: None,
            unit: String::new(),
            unit_size: 1.0,
        }
    }

    /// Tabulated values of Φ⁻¹ (Abramowitz and Stegun 1964, table 26.5).
    #[test]
    fn normal_quantiles_are_those_of_the_tables() {
        for (p, z) in [
            (0.5, 0.0),
            (0.975, 1.95996),
            (0.9, 1.28155),
            (0.01, -2.32635),
        ] {
            assert!((normal_quantile(p) - z).abs() < 1e-5, "{p}");
            assert!((normal_cdf(z) - p).abs() < 1e-5, "{z}");
        }
    }

    #[test]
    fn lognormal_has_its_median_and_dispersion() {
        let d = plain(Shape::LogNormal {
            median: 3.0,
            dispersion: 0.4,
        });
        assert!((quantile(&d, 0.5) - 3.0).abs() < 1e-12);
        let one = normal_cdf(1.0);
        assert!((quantile(&d, one) / (3.0 * 0.4_f64.exp()) - 1.0).abs() < 1e-9);
    }

    /// The mean of a truncated normal distribution, by midpoint sum and by its formula.
    #[test]
    fn truncation_keeps_the_shape_inside() {
        let mut d = plain(Shape::Normal {
            mean: 1.0,
            deviation: 2.0,
        });
        d.low = Some(0.0);
        d.high = Some(4.0);
        let n = 20_000;
        let mean = (0..n)
            .map(|i| quantile(&d, (f64::from(i) + 0.5) / f64::from(n)))
            .sum::<f64>()
            / f64::from(n);
        let density = |z: f64| (-0.5 * z * z).exp() / (2.0 * std::f64::consts::PI).sqrt();
        let (a, b) = (-0.5, 1.5);
        let expected = 1.0 + 2.0 * (density(a) - density(b)) / (normal_cdf(b) - normal_cdf(a));
        assert!((mean - expected).abs() < 1e-6, "{mean} {expected}");
        assert!(quantile(&d, 1e-12) >= 0.0 && quantile(&d, 1.0 - 1e-12) <= 4.0);
    }
}
