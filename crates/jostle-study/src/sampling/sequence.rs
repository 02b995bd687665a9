//! Sobol's sequence (Sobol' 1967) with the direction numbers of Joe and Kuo (2008), shifted at random.

use super::joe_kuo;
use super::stream::Stream;

/// A Sobol sequence whose binary digits are shifted by a random number in every dimension, which keeps its evenness
/// and moves it off the corners.
pub struct SobolSequence {
    /// By dimension, direction numbers and shift.
    dimensions: Vec<(Vec<u64>, u64)>,
}

/// Most dimensions.
pub(crate) const MOST_DIMENSIONS: usize = joe_kuo::DIMENSIONS.len() + 1;
const BITS: usize = 53;
const SHIFT: u64 = 3;

impl SobolSequence {
    /// At most 100 dimensions; further ones are left out.
    #[must_use]
    pub fn new(dimensions: usize, seed: u64) -> Self {
        let count = dimensions.min(MOST_DIMENSIONS);
        let with_shift = (0..count).map(|dimension| {
            let shift = Stream::new(seed, SHIFT, dimension as u64).bits();
            (directions(dimension), shift)
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

/// Direction numbers of a dimension counted from 0, as fractions of 2⁶⁴ (P. Bratley, B. L. Fox, 1988, ACM Trans. Math.
/// Softw. 14, 88–100).
fn directions(dimension: usize) -> Vec<u64> {
    let fraction = |bit: usize, number: u64| number << (63 - bit);
    let Some(&(polynomial, first)) = dimension
        .checked_sub(1)
        .map(|row| &joe_kuo::DIMENSIONS[row])
    else {
        return (0..BITS).map(|bit| fraction(bit, 1)).collect();
    };
    let degree = first.len();
    let given = first.iter().enumerate();
    let mut numbers: Vec<u64> = given.map(|(bit, number)| fraction(bit, *number)).collect();
    for bit in degree..BITS {
        let mut number = numbers[bit - degree] ^ (numbers[bit - degree] >> degree);
        for back in 1..degree {
            if polynomial >> (degree - 1 - back) & 1 == 1 {
                number ^= numbers[bit - back];
            }
        }
        numbers.push(number);
    }
    numbers
}

#[cfg(test)]
mod tests {
    use super::*;

    /// All direction numbers of 100 dimensions, as a second program finds them from the authors' file (FNV-1a of the
    /// 5300 words): a seed keeps its points.
    #[test]
    fn direction_numbers_are_those_published() {
        let words = (0..MOST_DIMENSIONS).flat_map(directions);
        let hash = words.fold(0xcbf2_9ce4_8422_2325, |hash: u64, word| {
            (hash ^ word).wrapping_mul(0x100_0000_01b3)
        });
        assert_eq!(hash, 0x4f4e_6289_3892_cdb5);
    }

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
