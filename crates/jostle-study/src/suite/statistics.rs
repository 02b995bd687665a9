//! Mean, spread and governing value of one quantity over the records of a suite.

use jostle::linear::quantile;
use jostle_motion::GoverningStatistic;
use serde::Serialize;

/// One quantity over all records.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct QuantityStatistics {
    /// Name, with its unit at the end.
    pub name: String,
    /// One value per record, in their order; `null` for records that did not reach their end.
    pub values: Vec<Option<f64>>,
    /// Arithmetic mean.
    pub mean: f64,
    /// Sample standard deviation, with n − 1; `null` for a single value.
    pub standard_deviation: Option<f64>,
    /// Least value.
    pub minimum: f64,
    /// Greatest value.
    pub maximum: f64,
    /// Record of the greatest value, from 0.
    pub maximum_record: usize,
    /// Median.
    pub median: f64,
    /// 16 % quantile, linear between the ordered values.
    pub p16: f64,
    /// 84 % quantile.
    pub p84: f64,
    /// Governing value by the rule of the suite.
    pub governing: f64,
}

impl QuantityStatistics {
    /// Statistics of the values that exist; `None` if there are none.
    #[must_use]
    pub fn new(
        name: String,
        values: Vec<Option<f64>>,
        statistic: GoverningStatistic,
    ) -> Option<Self> {
        let known: Vec<f64> = values.iter().flatten().copied().collect();
        let count = known.len() as f64;
        let mean = known.iter().sum::<f64>() / count;
        let squares = known.iter().map(|value| (value - mean).powi(2));
        let deviation = (known.len() > 1).then(|| (squares.sum::<f64>() / (count - 1.0)).sqrt());
        let mut ordered = known.clone();
        ordered.sort_by(f64::total_cmp);
        let maximum = *ordered.last()?;
        Some(Self {
            name,
            mean,
            standard_deviation: deviation,
            minimum: ordered[0],
            maximum,
            maximum_record: values.iter().position(|value| *value == Some(maximum))?,
            median: quantile(&ordered, 0.5),
            p16: quantile(&ordered, 0.16),
            p84: quantile(&ordered, 0.84),
            governing: statistic.value(&known)?,
            values,
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Values of R: `x <- c(2, 4, 4, 4, 5, 5, 7, 9); mean(x); sd(x); quantile(x, c(.16, .5, .84))` gives 5, 2.13809, 4,
    /// 4.5 and 6.76.
    #[test]
    fn statistics_are_those_of_r() {
        let values = [2.0, 4.0, 4.0, 4.0, 5.0, 5.0, 7.0, 9.0].map(Some).to_vec();
        let found = QuantityStatistics::new("x".into(), values, GoverningStatistic::Mean);
        let found = found.expect("values");
        let deviation = found.standard_deviation.expect("eight values");
        for (got, known) in [
            (found.mean, 5.0),
            (deviation, 2.138_089_935_299_395),
            (found.p16, 4.0),
            (found.median, 4.5),
            (found.p84, 6.76),
            (found.governing, 5.0),
        ] {
            assert!((got - known).abs() < 1e-12, "{got} {known}");
        }
        assert_eq!((found.maximum, found.maximum_record), (9.0, 7));
    }

    #[test]
    fn records_that_failed_are_left_out() {
        let values = vec![None, Some(3.0), Some(1.0), None];
        let found = QuantityStatistics::new("x".into(), values, GoverningStatistic::Maximum);
        let found = found.expect("values");
        assert_eq!(
            (found.mean, found.governing, found.maximum_record),
            (2.0, 3.0, 1)
        );
        assert!(
            QuantityStatistics::new("x".into(), vec![None], GoverningStatistic::Mean).is_none()
        );
    }
}
