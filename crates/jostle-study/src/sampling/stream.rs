//! Reproducible random numbers: ChaCha with 8 rounds, one stream for every purpose and number.

use rand_chacha::ChaCha8Rng;
use rand_chacha::rand_core::{Rng, SeedableRng};

/// A stream of random numbers, fixed by seed, purpose and number.
pub struct Stream(ChaCha8Rng);

impl Stream {
    /// The key holds the seed and the purpose, least significant byte first; `number` is the stream of the cipher.
    #[must_use]
    pub fn new(seed: u64, purpose: u64, number: u64) -> Self {
        let mut key = [0; 32];
        key[..8].copy_from_slice(&seed.to_le_bytes());
        key[8..16].copy_from_slice(&purpose.to_le_bytes());
        let mut generator = ChaCha8Rng::from_seed(key);
        generator.set_stream(number);
        Self(generator)
    }

    /// Evenly in `0..1` in steps of 2⁻⁵³, neither 0 nor 1: half a step is added.
    pub fn open_uniform(&mut self) -> f64 {
        ((self.0.next_u64() >> 12) as f64 + 0.5) / (1_u64 << 52) as f64
    }

    /// The next 64 bits.
    pub fn bits(&mut self) -> u64 {
        self.0.next_u64()
    }

    /// A whole number below `bound`, > 0, each equally likely.
    pub fn below(&mut self, bound: u64) -> u64 {
        // The last incomplete round of numbers is thrown away.
        let limit = u64::MAX - u64::MAX % bound;
        loop {
            let bits = self.0.next_u64();
            if bits < limit {
                return bits % bound;
            }
        }
    }
}
