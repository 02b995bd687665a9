//! Sums in eight fixed lanes: the same bits everywhere, and fast where the processor has lanes.

use pulp::{Arch, NullaryFnOnce};

const LANES: usize = 8;
/// Length of lists from which on wide registers are worth being asked for.
const WORTH_IT: usize = 16;

/// Runs loops over lists of this length, compiled for the widest registers at hand where that pays. Nothing may be fused
/// or reordered in them: the bits are the same either way.
#[inline]
pub(crate) fn in_wide_registers<Loops: NullaryFnOnce>(
    length: usize,
    loops: Loops,
) -> Loops::Output {
    if length < WORTH_IT {
        loops.call()
    } else {
        Arch::new().dispatch(loops)
    }
}

/// Σ aᵢ bᵢ.
#[inline(always)]
pub(crate) fn dot(a: &[f64], b: &[f64]) -> f64 {
    sum(a, b, |a, b| a * b)
}

/// Σ wᵢ xᵢ².
#[inline(always)]
pub(crate) fn weighted_square(weights: &[f64], x: &[f64]) -> f64 {
    sum(weights, x, |w, x| w * x * x)
}

#[inline(always)]
fn sum(a: &[f64], b: &[f64], term: impl Fn(f64, f64) -> f64) -> f64 {
    let mut lanes = [0.0; LANES];
    let (whole_a, whole_b) = (a.chunks_exact(LANES), b.chunks_exact(LANES));
    let rest: f64 = whole_a
        .remainder()
        .iter()
        .zip(whole_b.remainder())
        .map(|(a, b)| term(*a, *b))
        .sum();
    for (a, b) in whole_a.zip(whole_b) {
        for lane in 0..LANES {
            lanes[lane] += term(a[lane], b[lane]);
        }
    }
    lanes.iter().sum::<f64>() + rest
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn lanes_add_up() {
        let a: Vec<f64> = (1..=19).map(f64::from).collect();
        let b = vec![2.0; 19];
        assert_eq!(dot(&a, &b), 380.0);
        assert_eq!(weighted_square(&b, &a), 2.0 * 2470.0);
    }
}
