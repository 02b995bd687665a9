//! Reproducible random numbers: the stream of ChaCha with 8 rounds, started from the seed, and own transformations,
//! so that results do not depend on the version of a library.

use rand_chacha::ChaCha8Rng;
use rand_chacha::rand_core::{Rng, SeedableRng};

/// A stream of random numbers.
pub(crate) struct Random(ChaCha8Rng);

impl Random {
    /// The seed fills the first eight bytes of the key, least significant first; the rest is zero.
    pub(crate) fn new(seed: u64) -> Self {
        let mut key = [0; 32];
        key[..8].copy_from_slice(&seed.to_le_bytes());
        Self(ChaCha8Rng::from_seed(key))
    }

    /// Evenly in `0..1`, in steps of 2⁻⁵³.
    pub(crate) fn uniform(&mut self) -> f64 {
        (self.0.next_u64() >> 11) as f64 / (1_u64 << 53) as f64
    }

    /// Two independent standard normal numbers (Box and Muller 1958).
    pub(crate) fn normal_pair(&mut self) -> [f64; 2] {
        let radius = (-2.0 * libm::log(1.0 - self.uniform())).sqrt();
        let (sine, cosine) = libm::sincos(std::f64::consts::TAU * self.uniform());
        [radius * cosine, radius * sine]
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_stream_is_that_of_its_definition() {
        // The key stream of ChaCha8 for a key and nonce of zeros begins with these published bytes.
        let mut random = Random::new(0);
        let bytes = random.0.next_u64().to_le_bytes();
        assert_eq!(bytes, [0x3e, 0x00, 0xef, 0x2f, 0x89, 0x5f, 0x40, 0xd6]);
    }

    #[test]
    fn normal_numbers_have_mean_and_spread() {
        let mut random = Random::new(7);
        let numbers: Vec<f64> = (0..50_000).flat_map(|_| random.normal_pair()).collect();
        let mean = numbers.iter().sum::<f64>() / 1e5;
        let variance = numbers.iter().map(|x| x * x).sum::<f64>() / 1e5;
        // Three standard errors.
        assert!(mean.abs() < 3.0 / 1e5_f64.sqrt(), "{mean}");
        assert!(
            (variance - 1.0).abs() < 3.0 * (2.0 / 1e5_f64).sqrt(),
            "{variance}"
        );
    }
}
