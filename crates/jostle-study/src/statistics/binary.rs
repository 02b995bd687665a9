//! Regression of binary outcomes on the logarithm of an intensity.

use super::fragility::FitError;
use crate::sampling::{normal_cdf, normal_quantile};

/// The share of outcomes as a function F of z = a + b ln x; F(−z) = 1 − F(z) for both.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Link {
    /// Φ(z).
    Probit,
    /// 1/(1 + exp(−z)).
    Logit,
}

/// Iterations of the search.
const MOST_STEPS: usize = 200;

/// Differences of the likelihood below this share of it are rounding.
const FLAT: f64 = 1e-13;

impl Link {
    /// ln F(z), also far below zero.
    fn ln_share(self, z: f64) -> f64 {
        match self {
            Self::Probit if z > -30.0 => libm::log(normal_cdf(z)),
            Self::Probit => {
                -0.5 * z * z - libm::log(-z) - 0.5 * libm::log(2.0 * std::f64::consts::PI)
            }
            Self::Logit if z > 0.0 => -libm::log1p(libm::exp(-z)),
            Self::Logit => z - libm::log1p(libm::exp(z)),
        }
    }

    /// The derivative of ln F, by logarithms: no division of zero by zero in the tails.
    fn slope(self, z: f64) -> f64 {
        match self {
            Self::Probit => {
                let ln_density = -0.5 * z * z - 0.5 * libm::log(2.0 * std::f64::consts::PI);
                libm::exp(ln_density - self.ln_share(z))
            }
            Self::Logit => libm::exp(self.ln_share(-z)),
        }
    }

    /// F⁻¹(p), 0 < p < 1.
    fn inverse(self, p: f64) -> f64 {
        match self {
            Self::Probit => normal_quantile(p),
            Self::Logit => libm::log(p / (1.0 - p)),
        }
    }
}

/// Greatest likelihood of P(event | x) = F(a + b ln x); b > 0.
///
/// # Errors
/// [`FitError`] when no unique maximum exists or b is not positive.
pub(super) fn regress(outcomes: &[(f64, bool)], link: Link) -> Result<[f64; 2], FitError> {
    let used: Vec<(f64, bool)> = outcomes
        .iter()
        .filter(|(x, _)| *x > 0.0 && x.is_finite())
        .map(|(x, event)| (libm::log(*x), *event))
        .collect();
    let events = used.iter().filter(|(_, event)| *event).count();
    if used.len() < 3 {
        return Err(FitError::TooFew { cases: used.len() });
    }
    if events == 0 || events == used.len() {
        return Err(FitError::OneSided {
            events,
            cases: used.len(),
        });
    }
    let without = used.iter().filter(|(_, event)| !*event).map(|(x, _)| *x);
    let with = used.iter().filter(|(_, event)| *event).map(|(x, _)| *x);
    let (below, above) = (
        without.fold(f64::NEG_INFINITY, f64::max),
        with.fold(f64::INFINITY, f64::min),
    );
    if below < above {
        return Err(FitError::Separated {
            below: libm::exp(below),
            above: libm::exp(above),
        });
    }
    // Standardised abscissas keep the equations well conditioned.
    let n = used.len() as f64;
    let mean = used.iter().map(|(x, _)| x).sum::<f64>() / n;
    let spread = (used.iter().map(|(x, _)| (x - mean).powi(2)).sum::<f64>() / n).sqrt();
    if spread <= 1e-12 {
        return Err(FitError::TooFew { cases: 1 });
    }
    let standard: Vec<(f64, bool)> = used
        .iter()
        .map(|(x, event)| ((x - mean) / spread, *event))
        .collect();
    let [a, b] = greatest(&standard, link).ok_or(FitError::NoMaximum)?;
    if b <= 1e-9 {
        return Err(FitError::Falling);
    }
    Ok([a - b * mean / spread, b / spread])
}

fn likelihood(data: &[(f64, bool)], [a, b]: [f64; 2], link: Link) -> f64 {
    data.iter()
        .map(|(x, event)| {
            let z = a + b * x;
            link.ln_share(if *event { z } else { -z })
        })
        .sum()
}

/// Fisher scoring with halved steps.
fn greatest(data: &[(f64, bool)], link: Link) -> Option<[f64; 2]> {
    let events = data.iter().filter(|(_, event)| *event).count() as f64;
    let mut p = [link.inverse(events / data.len() as f64), 0.0];
    let mut value = likelihood(data, p, link);
    for _ in 0..MOST_STEPS {
        let (mut slope, mut information) = ([0.0; 2], [0.0; 3]);
        for (x, event) in data {
            let z = p[0] + p[1] * x;
            let (up, down) = (link.slope(z), link.slope(-z));
            let score = if *event { up } else { -down };
            let weight = up * down;
            slope[0] += score;
            slope[1] += score * x;
            information[0] += weight;
            information[1] += weight * x;
            information[2] += weight * x * x;
        }
        let determinant = information[0] * information[2] - information[1] * information[1];
        if determinant.is_nan() || determinant <= 0.0 {
            return None;
        }
        let step = [
            (information[2] * slope[0] - information[1] * slope[1]) / determinant,
            (information[0] * slope[1] - information[1] * slope[0]) / determinant,
        ];
        let mut share = 1.0;
        loop {
            let tried = [p[0] + share * step[0], p[1] + share * step[1]];
            let reached = likelihood(data, tried, link);
            // Near the top the likelihood is flat to rounding, and the full step is right.
            if reached >= value - FLAT * value.abs() || share < 1e-10 {
                p = tried;
                value = reached;
                break;
            }
            share *= 0.5;
        }
        let moved = share * step[0].abs().max(step[1].abs());
        if moved < 1e-11 * (1.0 + p[0].abs() + p[1].abs()) {
            return p.iter().all(|x| x.is_finite()).then_some(p);
        }
    }
    None
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Two intensities and two unknowns: a logistic curve passes through both observed shares.
    #[test]
    fn two_stripes_have_a_closed_form() {
        let mut outcomes = Vec::new();
        for (x, events, of) in [(1.0, 3, 20), (2.0, 14, 20)] {
            outcomes.extend((0..of).map(|i| (x, i < events)));
        }
        let [a, b] = regress(&outcomes, Link::Logit).unwrap_or_else(|error| panic!("{error}"));
        let (first, second) = ((3.0_f64 / 17.0).ln(), (14.0_f64 / 6.0).ln());
        assert!((a - first).abs() < 1e-9, "{a}");
        assert!((b - (second - first) / 2.0_f64.ln()).abs() < 1e-9, "{b}");
    }
}
