//! Correlation of normal scores: the Gaussian copula (Nataf 1962; Nelsen 2006, §2.3).

use super::quantile::{normal_cdf, normal_quantile};

/// Correlates independent numbers between 0 and 1 and leaves each of them evenly distributed.
#[derive(Debug)]
pub struct Copula {
    /// Lower triangle of the Cholesky factor, row by row; empty when nothing is correlated.
    factor: Vec<Vec<f64>>,
}

/// The correlations contradict each other.
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
#[error("the correlations contradict each other: their matrix is not positive definite")]
pub struct CopulaError;

impl Copula {
    /// From the correlations of pairs of dimensions; all others are zero.
    ///
    /// # Errors
    /// [`CopulaError`] when no variables can have these correlations.
    pub fn new(dimensions: usize, pairs: &[([usize; 2], f64)]) -> Result<Self, CopulaError> {
        if pairs.is_empty() {
            return Ok(Self { factor: Vec::new() });
        }
        let mut matrix = vec![vec![0.0; dimensions]; dimensions];
        (0..dimensions).for_each(|i| matrix[i][i] = 1.0);
        for ([a, b], value) in pairs {
            matrix[*a][*b] = *value;
            matrix[*b][*a] = *value;
        }
        let mut factor: Vec<Vec<f64>> = Vec::new();
        for (i, row) in matrix.iter().enumerate() {
            let mut factor_row: Vec<f64> = Vec::new();
            for j in 0..i {
                let done: f64 = factor_row.iter().zip(&factor[j]).map(|(a, b)| a * b).sum();
                factor_row.push((row[j] - done) / factor[j][j]);
            }
            let pivot = 1.0 - factor_row.iter().map(|x| x * x).sum::<f64>();
            if pivot <= 1e-12 {
                return Err(CopulaError);
            }
            factor_row.push(pivot.sqrt());
            factor.push(factor_row);
        }
        Ok(Self { factor })
    }

    /// Correlates a point in place.
    pub fn apply(&self, point: &mut [f64]) {
        if self.factor.is_empty() {
            return;
        }
        let scores: Vec<f64> = point.iter().map(|u| normal_quantile(*u)).collect();
        for (u, row) in point.iter_mut().zip(&self.factor) {
            // Uncorrelated factors keep their bits.
            if row[..row.len() - 1].iter().any(|x| *x != 0.0) {
                let z: f64 = row.iter().zip(&scores).map(|(a, b)| a * b).sum();
                *u = normal_cdf(z).clamp(f64::MIN_POSITIVE, 1.0 - f64::EPSILON / 2.0);
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::sampling::SobolSequence;

    #[test]
    fn scores_have_the_correlation_and_margins_stay_even() {
        let copula = Copula::new(3, &[([0, 2], 0.7)]).unwrap_or_else(|e| panic!("{e}"));
        let sequence = SobolSequence::new(3, 9);
        let n = 1 << 13;
        let (mut product, mut square, mut mean) = (0.0, 0.0, 0.0);
        for i in 0..n {
            let mut p = sequence.point(i);
            copula.apply(&mut p);
            let z = [normal_quantile(p[0]), normal_quantile(p[2])];
            product += z[0] * z[1] / n as f64;
            square += z[1] * z[1] / n as f64;
            mean += p[2] / n as f64;
        }
        assert!((product - 0.7).abs() < 0.005, "{product}");
        assert!((square - 1.0).abs() < 0.005, "{square}");
        assert!((mean - 0.5).abs() < 0.002, "{mean}");
    }

    #[test]
    fn impossible_correlations_are_refused() {
        let pairs = [([0, 1], 0.9), ([1, 2], 0.9), ([0, 2], -0.9)];
        assert_eq!(Copula::new(3, &pairs).err(), Some(CopulaError));
    }
}
