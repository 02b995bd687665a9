//! Cloud analysis: a straight line through the logarithms of demand and intensity.

use super::fragility::{FitError, Lognormal};

/// ln D = ln a + b ln x + ε with standard deviation β of ε.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct CloudFit {
    /// ln a.
    pub intercept: f64,
    /// b.
    pub slope: f64,
    /// β, with n − 2 degrees of freedom \[–\].
    pub scatter: f64,
    /// Cases used: those with demand and intensity greater than zero.
    pub cases: usize,
}

/// Fits a cloud (intensity, demand) by least squares of logarithms (Cornell et al. 2002; Jalayer 2003).
///
/// # Errors
/// [`FitError`] when there are fewer than three usable cases, or all at one intensity.
pub fn fit_cloud(cloud: &[(f64, f64)]) -> Result<CloudFit, FitError> {
    let used: Vec<(f64, f64)> = cloud
        .iter()
        .filter(|(x, d)| *x > 0.0 && *d > 0.0 && x.is_finite() && d.is_finite())
        .map(|(x, d)| (libm::log(*x), libm::log(*d)))
        .collect();
    if used.len() < 3 {
        return Err(FitError::TooFew { cases: used.len() });
    }
    let n = used.len() as f64;
    let mean = |of: &dyn Fn(&(f64, f64)) -> f64| used.iter().map(of).sum::<f64>() / n;
    let (mx, my) = (mean(&|p| p.0), mean(&|p| p.1));
    let (sxx, sxy) = (
        mean(&|p| (p.0 - mx).powi(2)),
        mean(&|p| (p.0 - mx) * (p.1 - my)),
    );
    if sxx <= 1e-20 {
        return Err(FitError::TooFew { cases: 1 });
    }
    let slope = sxy / sxx;
    let intercept = my - slope * mx;
    let rest = used
        .iter()
        .map(|(x, y)| (y - intercept - slope * x).powi(2))
        .sum::<f64>();
    Ok(CloudFit {
        intercept,
        slope,
        scatter: (rest / (n - 2.0)).sqrt(),
        cases: used.len(),
    })
}

impl CloudFit {
    /// P(D > d | x) = Φ((ln a + b ln x − ln d)/β) as a lognormal curve in x.
    ///
    /// # Errors
    /// [`FitError::Falling`] when demand does not grow with intensity, [`FitError::NoMaximum`] without scatter.
    pub fn fragility(&self, threshold: f64) -> Result<Lognormal, FitError> {
        if self.slope <= 0.0 {
            return Err(FitError::Falling);
        }
        if self.scatter <= 0.0 {
            return Err(FitError::NoMaximum);
        }
        Ok(Lognormal {
            median: libm::exp((libm::log(threshold) - self.intercept) / self.slope),
            dispersion: self.scatter / self.slope,
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::sampling::{Stream, normal_quantile};

    #[test]
    fn a_known_cloud_is_found_again() {
        let mut stream = Stream::new(3, 98, 0);
        let cloud: Vec<(f64, f64)> = (0..5000)
            .map(|_| {
                let x = 0.1 * (3.0 * stream.open_uniform()).exp();
                let noise = 0.3 * normal_quantile(stream.open_uniform());
                (x, 2.0 * x.powf(1.2) * noise.exp())
            })
            .collect();
        let fit = fit_cloud(&cloud).unwrap_or_else(|error| panic!("{error}"));
        // Four standard errors of 5000 cases.
        assert!(
            (fit.slope - 1.2).abs() < 4.0 * 0.3 / (0.866 * 5000f64.sqrt()),
            "{fit:?}"
        );
        assert!(
            (fit.scatter - 0.3).abs() < 4.0 * 0.3 / 10_000f64.sqrt(),
            "{fit:?}"
        );
        let curve = fit.fragility(0.7).unwrap_or_else(|error| panic!("{error}"));
        let median = (0.7_f64 / 2.0).powf(1.0 / 1.2);
        assert!((curve.median / median).ln().abs() < 0.02, "{curve:?}");
        assert!((curve.dispersion - 0.25).abs() < 0.02, "{curve:?}");
    }

    /// Three points on a line but one: the least-squares line by hand.
    #[test]
    fn three_points_by_hand() {
        let e = std::f64::consts::E;
        let fit = fit_cloud(&[(1.0, 1.0), (e, e), (e * e, e.powi(3))]);
        let fit = fit.unwrap_or_else(|error| panic!("{error}"));
        assert!((fit.slope - 1.5).abs() < 1e-12 && (fit.intercept + 1.0 / 6.0).abs() < 1e-12);
        assert!(
            (fit.scatter - (1.0_f64 / 6.0).sqrt()).abs() < 1e-12,
            "{fit:?}"
        );
    }
}
