//! Values of a distribution at given probabilities.

use jostle_io::{Distribution, Shape};

/// Φ(z).
pub(crate) fn normal_cdf(z: f64) -> f64 {
    0.5 * libm::erfc(-z / std::f64::consts::SQRT_2)
}

/// Φ⁻¹(p), 0 < p < 1, to about 1e-16 (M. J. Wichura, 1988, Appl. Stat. 37, 477–484, algorithm AS 241).
pub(crate) fn normal_quantile(p: f64) -> f64 {
    let q = p - 0.5;
    if q.abs() <= 0.425 {
        return q * ratio(&MIDDLE, 0.425 * 0.425 - q * q);
    }
    let r = (-libm::log(if q < 0.0 { p } else { 1.0 - p })).sqrt();
    let z = if r <= 5.0 {
        ratio(&OUTER, r - 1.6)
    } else {
        ratio(&FAR, r - 5.0)
    };
    z.copysign(q)
}

/// Numerator and denominator of AS 241 near the middle, further out, and far out, from the highest power.
type Coefficients = [[f64; 8]; 2];

#[rustfmt::skip]
const MIDDLE: Coefficients = [
    [2.509_080_928_730_122_6e3, 3.343_057_558_358_813e4, 6.726_577_092_700_87e4, 4.592_195_393_154_987e4,
     1.373_169_376_550_946e4, 1.971_590_950_306_551_3e3, 1.331_416_678_917_843_8e2, 3.387_132_872_796_366_5],
    [5.226_495_278_852_854e3, 2.872_908_573_572_194_3e4, 3.930_789_580_009_271e4, 2.121_379_430_158_659_7e4,
     5.394_196_021_424_751e3, 6.871_870_074_920_579e2, 4.231_333_070_160_091e1, 1.0],
];
#[rustfmt::skip]
const OUTER: Coefficients = [
    [7.745_450_142_783_414e-4, 2.272_384_498_926_918_4e-2, 2.417_807_251_774_506e-1, 1.270_458_252_452_368_4,
     3.647_848_324_763_204_5, 5.769_497_221_460_691, 4.630_337_846_156_546, 1.423_437_110_749_683_5],
    [1.050_750_071_644_416_9e-9, 5.475_938_084_995_345e-4, 1.519_866_656_361_645_7e-2, 1.481_039_764_274_800_8e-1,
     6.897_673_349_851e-1, 1.676_384_830_183_803_8, 2.053_191_626_637_759, 1.0],
];
#[rustfmt::skip]
const FAR: Coefficients = [
    [2.010_334_399_292_288e-7, 2.711_555_568_743_487_6e-5, 1.242_660_947_388_078_4e-3, 2.653_218_952_657_612_4e-2,
     2.965_605_718_285_048_7e-1, 1.784_826_539_917_291_3, 5.463_784_911_164_114, 6.657_904_643_501_103],
    [2.044_263_103_389_939_8e-15, 1.421_511_758_316_446e-7, 1.846_318_317_510_054_8e-5, 7.868_691_311_456_133e-4,
     1.487_536_129_085_061_5e-2, 1.369_298_809_227_358e-1, 5.998_322_065_558_88e-1, 1.0],
];

/// A ratio of polynomials.
fn ratio(coefficients: &Coefficients, x: f64) -> f64 {
    let [above, below] = coefficients.map(|powers| {
        powers
            .iter()
            .fold(0.0, |sum, coefficient| sum * x + coefficient)
    });
    above / below
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
                    libm::log(x / median) / dispersion
                } else {
                    f64::NEG_INFINITY
                }
            };
            let z = normal_quantile(inside(p, low.map(score), high.map(score)));
            within(median * libm::exp(dispersion * z))
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

    /// Φ(Φ⁻¹(p)) = p from one end to the other.
    #[test]
    fn quantile_and_share_are_inverse() {
        // An error ε of z changes the share by the factor z² ε: four roundings on the way there and back.
        let holds = |p: f64| {
            let z = normal_quantile(p);
            let limit = 4.0 * f64::EPSILON * (1.0 + z * z);
            let off = (normal_cdf(z) / p - 1.0).abs();
            assert!(off < limit, "{p:e}: {z}, {off:e} of {limit:e}");
        };
        for exponent in 1..=300 {
            holds(10.0_f64.powi(-exponent));
        }
        for step in 1..1000 {
            let p = f64::from(step) / 1000.0;
            holds(p);
            assert!(
                (normal_quantile(p) + normal_quantile(1.0 - p)).abs() < 1e-14,
                "{p}"
            );
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
