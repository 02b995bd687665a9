//! Latin hypercube sampling (McKay, Beckman and Conover 1979).

use super::stream::Stream;

/// A Latin hypercube: in every dimension, each of n equal intervals holds one sample, at a random place.
pub struct LatinHypercube {
    /// By dimension, the interval of every sample.
    intervals: Vec<Vec<u32>>,
    seed: u64,
}

const SHUFFLE: u64 = 1;
const PLACE: u64 = 2;

impl LatinHypercube {
    /// Shuffles the intervals: 4 bytes per sample and dimension. `samples` ≤ 2³².
    #[must_use]
    pub fn new(samples: u64, dimensions: usize, seed: u64) -> Self {
        let shuffled = |dimension: usize| {
            let mut stream = Stream::new(seed, SHUFFLE, dimension as u64);
            let mut order: Vec<u32> = (0..samples.min(1 << 32)).map(|i| i as u32).collect();
            // Fisher and Yates, from the end.
            for last in (1..order.len()).rev() {
                order.swap(last, stream.below(last as u64 + 1) as usize);
            }
            order
        };
        Self {
            intervals: (0..dimensions).map(shuffled).collect(),
            seed,
        }
    }

    /// The point of a sample.
    #[must_use]
    pub fn point(&self, sample: u64) -> Vec<f64> {
        let mut stream = Stream::new(self.seed, PLACE, sample);
        self.intervals
            .iter()
            .map(|order| {
                let interval = order.get(sample as usize).copied().unwrap_or(0);
                (f64::from(interval) + stream.open_uniform()) / order.len() as f64
            })
            .collect()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_interval_holds_one_sample_in_every_dimension() {
        let cube = LatinHypercube::new(97, 3, 5);
        for dimension in 0..3 {
            let mut seen = vec![0; 97];
            for sample in 0..97 {
                let u = cube.point(sample)[dimension];
                assert!(u > 0.0 && u < 1.0);
                seen[(u * 97.0) as usize] += 1;
            }
            assert_eq!(seen, vec![1; 97], "dimension {dimension}");
        }
        let correlation: f64 = (0..97)
            .map(|i| {
                let p = cube.point(i);
                12.0 * (p[0] - 0.5) * (p[1] - 0.5) / 97.0
            })
            .sum();
        // Three standard errors of independent columns.
        assert!(correlation.abs() < 3.0 / 97f64.sqrt(), "{correlation}");
    }
}
