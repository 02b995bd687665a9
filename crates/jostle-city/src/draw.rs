//! What nobody knows and is drawn: gaps, and the scatter of buildings and contacts.

use jostle_classes::{lognormal, uniform};

use crate::neighbours::Pair;

/// How gaps are drawn.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct GapWidths {
    /// Median \[m\], > 0.
    pub median: f64,
    /// Standard deviation of the logarithm \[–\].
    pub scatter: f64,
    /// Share of pairs with one wall in common \[–\].
    pub party_wall: f64,
}

/// Maps place walls to about half a metre: a gap is no wider than the distance on the map and this \[m\].
const MAP_ERROR: f64 = 0.5;
/// Draws after which the widest gap possible is taken.
const TRIES: u64 = 64;

impl GapWidths {
    /// The width of a pair in a draw \[m\]; `None` where the buildings share a wall and cannot hit each other.
    #[must_use]
    pub fn draw(&self, pair: u64, distance: f64, draw: u64) -> Option<f64> {
        if self.party_wall > 0.0 && uniform(pair, draw, "party wall") < self.party_wall {
            return None;
        }
        let widest = distance + MAP_ERROR;
        let tries = (0..TRIES).map(|again| {
            self.median * lognormal(pair, draw.wrapping_add(again << 32), "gap", self.scatter)
        });
        Some(
            tries
                .into_iter()
                .find(|candidate| *candidate <= widest)
                .unwrap_or(widest),
        )
    }

    /// Probability that a gap is narrower than a closing of the free buildings \[m\]: they collide.
    #[must_use]
    pub fn probability_below(&self, closing: f64, distance: f64) -> f64 {
        if closing <= 0.0 {
            return 0.0;
        }
        let widest = distance + MAP_ERROR;
        let below = |width: f64| {
            if self.scatter <= 0.0 {
                return if self.median < width { 1.0 } else { 0.0 };
            }
            let score = libm::log(width / self.median) / self.scatter;
            0.5 * libm::erfc(-score / std::f64::consts::SQRT_2)
        };
        let all = below(widest);
        if closing >= widest || all <= 0.0 {
            return 1.0 - self.party_wall;
        }
        (1.0 - self.party_wall) * below(closing) / all
    }
}

/// A number that belongs to a name, the same on every machine (FNV-1a).
#[must_use]
pub fn number_of(name: &str) -> u64 {
    name.bytes().fold(0xcbf2_9ce4_8422_2325, |all, byte| {
        (all ^ u64::from(byte)).wrapping_mul(0x0000_0100_0000_01b3)
    })
}

/// The same of two buildings of a pair, whichever is named first in the inventory.
pub(crate) fn number_of_pair(ids: &[u64], pair: &Pair) -> u64 {
    let [a, b] = pair.buildings.map(|at| ids[at]);
    let (low, high) = (a.min(b), a.max(b));
    low.rotate_left(17) ^ high.wrapping_mul(0x9e37_79b9_7f4a_7c15)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn drawn_gaps_have_their_distribution() {
        let gaps = GapWidths {
            median: 0.2,
            scatter: 0.8,
            party_wall: 0.1,
        };
        let drawn: Vec<Option<f64>> = (0..40_000).map(|pair| gaps.draw(pair, 0.1, 3)).collect();
        let walls = drawn.iter().filter(|drawn| drawn.is_none()).count() as f64 / 4e4;
        assert!((walls - 0.1).abs() < 0.005, "{walls}");
        assert!(drawn.iter().flatten().all(|own| *own <= 0.6));
        for closing in [0.05, 0.2, 0.4, 0.6] {
            let below = drawn
                .iter()
                .flatten()
                .filter(|drawn| **drawn < closing)
                .count() as f64
                / 4e4;
            let expected = gaps.probability_below(closing, 0.1);
            assert!(
                (below - expected).abs() < 0.008,
                "{closing}: {below} {expected}"
            );
        }
        // A gap that cannot be narrow enough is as wide as can be.
        let wide = GapWidths {
            median: 50.0,
            scatter: 0.1,
            party_wall: 0.0,
        };
        assert_eq!(wide.draw(1, 0.1, 1), Some(0.6));
        assert_eq!(wide.probability_below(0.6, 0.1), 1.0);
    }
}
