//! Sobol's sequence (Sobol' 1967) with the direction numbers of Joe and Kuo (2008), shifted at random.

use sobol::Sobol;
use sobol::params::JoeKuoD6;

use super::stream::Stream;

/// A Sobol sequence whose binary digits are shifted by a random number in every dimension, which keeps its evenness
/// and moves it off the corners.
pub struct SobolSequence {
    /// By dimension, direction numbers and shift.
    dimensions: Vec<(Vec<u64>, u64)>,
}

/// Most dimensions.
pub(crate) const MOST_DIMENSIONS: usize = 100;
const BITS: usize = 53;
const SHIFT: u64 = 3;

impl SobolSequence {
    /// At most 100 dimensions; further ones are left out.
    #[must_use]
    pub fn new(dimensions: usize, seed: u64) -> Self {
        let count = dimensions.min(MOST_DIMENSIONS);
        let directions = Sobol::<f64>::init_direction_vals(count, BITS, &JoeKuoD6::minimal());
        let with_shift = directions
            .into_iter()
            .enumerate()
            .map(|(dimension, numbers)| {
                let shift = Stream::new(seed, SHIFT, dimension as u64).bits();
                (numbers, shift)
            });
        Self {
            dimensions: with_shift.collect(),
        }
    }

    /// The point of a sample, each coordinate inside `0..1`.
    #[must_use]
    pub fn point(&self, sample: u64) -> Vec<f64> {
        // In the order of Gray's code, as Antonov and Saleev (1979) have it.
        let gray = sample ^ (sample >> 1);
        let coordinate = |(numbers, shift): &(Vec<u64>, u64)| {
            let chosen = numbers.iter().enumerate();
            let chosen = chosen.filter(|(bit, _)| gray >> bit & 1 == 1);
            let bits = chosen.fold(*shift, |sum, (_, number)| sum ^ number);
            ((bits >> 12) as f64 + 0.5) / (1_u64 << 52) as f64
        };
        self.dimensions.iter().map(coordinate).collect()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Every elementary interval of a block of 2ᵏ points holds its share in one dimension, and in the first two
    /// dimensions every box of volume 2⁻ᵏ holds one point: they form a (0, k, 2) net, which shifts do not change.
    #[test]
    fn blocks_of_points_are_as_even_as_they_should_be() {
        let sequence = SobolSequence::new(8, 42);
        let points: Vec<Vec<f64>> = (0..256).map(|i| sequence.point(i)).collect();
        for dimension in 0..8 {
            let mut seen = [0; 256];
            points
                .iter()
                .for_each(|p| seen[(p[dimension] * 256.0) as usize] += 1);
            assert_eq!(seen, [1; 256], "dimension {dimension}");
        }
        for split in 0..=8 {
            let (rows, columns) = (1 << split, 256 >> split);
            let mut seen = vec![0; 256];
            for p in &points {
                let (row, column) = (p[0] * f64::from(rows), p[1] * f64::from(columns));
                seen[row as usize * columns as usize + column as usize] += 1;
            }
            assert_eq!(seen, vec![1; 256], "boxes of 1/{rows} by 1/{columns}");
        }
    }

    /// ∫ Π (1 + (xᵢ − ½)) = 1 in six dimensions: far closer than at random.
    #[test]
    fn a_smooth_integral_converges_faster_than_at_random() {
        let sequence = SobolSequence::new(6, 1);
        let n = 1 << 12;
        let mean = (0..n)
            .map(|i| sequence.point(i).iter().map(|x| 0.5 + x).product::<f64>())
            .sum::<f64>()
            / n as f64;
        // The standard error at random would be √((13/12)⁶ − 1) / √4096 = 0.0123.
        assert!((mean - 1.0).abs() < 0.001, "{mean}");
    }
}
