//! Scatter that belongs to a building and a draw, whatever was drawn before.

use std::f64::consts::PI;

/// A lognormal factor of median 1 and logarithmic deviation `sigma`, from the building's id, the number of the draw
/// and the name of what varies: order and threads do not matter.
#[must_use]
pub fn lognormal(id: u64, draw: u64, what: &str, sigma: f64) -> f64 {
    let state = hash(id, draw, what);
    let (one, two) = (unit(mixed(state)), unit(mixed(state ^ 1)));
    // Box and Muller.
    let normal = (-2.0 * libm::log(one)).sqrt() * libm::cos(2.0 * PI * two);
    libm::exp(sigma * normal)
}

/// A number between 0 and 1, from the same.
#[must_use]
pub fn uniform(id: u64, draw: u64, what: &str) -> f64 {
    unit(mixed(hash(id, draw, what)))
}

fn hash(id: u64, draw: u64, what: &str) -> u64 {
    what.bytes().fold(mixed(id ^ mixed(draw)), |state, byte| {
        mixed(state ^ u64::from(byte))
    })
}

fn unit(bits: u64) -> f64 {
    ((bits >> 11) as f64 + 0.5) / (1_u64 << 53) as f64
}

/// SplitMix64.
const fn mixed(value: u64) -> u64 {
    let z = value.wrapping_add(0x9e37_79b9_7f4a_7c15);
    let z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
    let z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
    z ^ (z >> 31)
}

#[cfg(test)]
mod tests {
    use super::lognormal;

    #[test]
    fn factors_have_their_median_and_scatter() {
        let logs: Vec<f64> = (0..20_000)
            .map(|id| lognormal(id, 3, "stiffness", 0.25).ln())
            .collect();
        let mean = logs.iter().sum::<f64>() / 2e4;
        let spread = (logs.iter().map(|log| (log - mean).powi(2)).sum::<f64>() / 2e4).sqrt();
        assert!(mean.abs() < 0.006, "{mean}");
        assert!((spread - 0.25).abs() < 0.005, "{spread}");
        assert_ne!(
            lognormal(1, 2, "stiffness", 0.25),
            lognormal(2, 1, "stiffness", 0.25)
        );
        assert_ne!(
            lognormal(1, 2, "stiffness", 0.25),
            lognormal(1, 2, "strength", 0.25)
        );
    }
}
