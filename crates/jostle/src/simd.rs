//! Sums in eight fixed lanes: the same bits on every processor, and fast with wide registers.

use pulp::{Arch, NullaryFnOnce, Simd};

const LANES: usize = 8;
/// Length of lists above which dispatch to wide registers pays.
const WORTH_IT: usize = 16;

/// Runs loops over lists of this length, compiled for the widest available registers if that pays. Operations must
/// not be fused or reordered in them, so the bits are the same in both cases.
#[inline]
pub(crate) fn in_wide_registers<Loops: NullaryFnOnce>(
    length: usize,
    loops: Loops,
) -> Loops::Output {
    // One call, because every call compiles the loops for all registers.
    let arch = if length < WORTH_IT {
        Arch::Scalar
    } else {
        Arch::new()
    };
    arch.dispatch(loops)
}

/// [`weighted_square`] in the widest available registers.
pub(crate) fn wide_weighted_square(weights: &[f64], x: &[f64]) -> f64 {
    in_wide_registers(x.len(), WeightedSquare { weights, x })
}

struct WeightedSquare<'a> {
    weights: &'a [f64],
    x: &'a [f64],
}

impl NullaryFnOnce for WeightedSquare<'_> {
    type Output = f64;

    #[inline(always)]
    fn call(self) -> f64 {
        weighted_square(self.weights, self.x)
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

/// axpy: `to[k] += factor * of[k]`.
#[inline(always)]
pub(crate) fn add(to: &mut [f64], factor: f64, vector: &[f64]) {
    for (value, part) in to.iter_mut().zip(vector) {
        *value += factor * part;
    }
}

/// Vectors processed at once.
const TOGETHER: usize = 4;

/// Products of many vectors with one.
#[inline(always)]
pub(crate) fn dots<S: Simd>(simd: S, vectors: &[Vec<f64>], with: &[f64], products: &mut [f64]) {
    let (fours, rest) = vectors.as_chunks::<TOGETHER>();
    let (of_fours, of_rest) = products.as_chunks_mut::<TOGETHER>();
    let whole = with.len() - with.len() % LANES;
    let cut = |list| S::as_simd_f64s(list).0;
    let (registers, left) = (cut(&with[..whole]), &with[whole..]);
    for ([a, b, c, d], products) in fours.iter().zip(of_fours) {
        let [own_a, own_b] = [cut(&a[..whole]), cut(&b[..whole])];
        let [own_c, own_d] = [cut(&c[..whole]), cut(&d[..whole])];
        // As many registers as the lanes need at any width.
        let mut sums = [[simd.splat_f64s(0.0); LANES]; TOGETHER];
        let used = LANES / S::F64_LANES;
        for first in (0..registers.len()).step_by(used) {
            for r in 0..used {
                let (at, with) = (first + r, registers[first + r]);
                let add = |sum: &mut S::f64s, factor| {
                    *sum = simd.add_f64s(*sum, simd.mul_f64s(factor, with));
                };
                add(&mut sums[0][r], own_a[at]);
                add(&mut sums[1][r], own_b[at]);
                add(&mut sums[2][r], own_c[at]);
                add(&mut sums[3][r], own_d[at]);
            }
        }
        let rests = [&a[whole..], &b[whole..], &c[whole..], &d[whole..]];
        for ((product, sums), rest) in products.iter_mut().zip(&sums).zip(rests) {
            let mut lanes = [0.0; LANES];
            S::as_mut_simd_f64s(&mut lanes)
                .0
                .copy_from_slice(&sums[..used]);
            let rest: f64 = rest.iter().zip(left).map(|(a, b)| a * b).sum();
            *product = lanes.iter().sum::<f64>() + rest;
        }
    }
    for (vector, product) in rest.iter().zip(of_rest) {
        *product = dot(vector, with);
    }
}

/// Subtracts multiples of many vectors from one.
#[inline(always)]
pub(crate) fn subtract_all(vectors: &[Vec<f64>], times: &[f64], from: &mut [f64]) {
    let (fours, rest) = vectors.as_chunks::<TOGETHER>();
    let (times_fours, times_rest) = times.as_chunks::<TOGETHER>();
    for ([a, b, c, d], times) in fours.iter().zip(times_fours) {
        let pairs = a.iter().zip(b).zip(c.iter().zip(d));
        for (value, ((a, b), (c, d))) in from.iter_mut().zip(pairs) {
            *value -= (times[0] * a + times[1] * b) + (times[2] * c + times[3] * d);
        }
    }
    for (vector, times) in rest.iter().zip(times_rest) {
        add(from, -times, vector);
    }
}

#[cfg(test)]
mod tests {
    use pulp::{Scalar, WithSimd};

    use super::*;

    struct Dots<'a>(&'a [Vec<f64>], &'a [f64], &'a mut [f64]);

    impl WithSimd for Dots<'_> {
        type Output = ();

        #[inline(always)]
        fn with_simd<S: Simd>(self, simd: S) {
            dots(simd, self.0, self.1, self.2);
        }
    }

    #[test]
    fn lanes_add_up() {
        let a: Vec<f64> = (1..=19).map(f64::from).collect();
        let b = vec![2.0; 19];
        assert_eq!(dot(&a, &b), 380.0);
        assert_eq!(weighted_square(&b, &a), 2.0 * 2470.0);
        assert_eq!(wide_weighted_square(&b, &a), 2.0 * 2470.0);
    }

    #[test]
    fn many_vectors_are_as_good_as_one() {
        let list = |k: usize| {
            (0..19)
                .map(|i| ((3 + i * k) % 7) as f64)
                .collect::<Vec<f64>>()
        };
        for count in [0, 1, 4, 6, 9] {
            let vectors: Vec<Vec<f64>> = (0..count).map(list).collect();
            let with = list(11);
            let (mut products, mut narrow) = (vec![0.0; count], vec![0.0; count]);
            Arch::new().dispatch(Dots(&vectors, &with, &mut products));
            dots(Scalar::new(), &vectors, &with, &mut narrow);
            assert_eq!(products, narrow);
            let mut left = with.clone();
            subtract_all(&vectors, &products, &mut left);
            let mut expected = with.clone();
            for (vector, product) in vectors.iter().zip(&products) {
                // Whole numbers, so that sums are exact in any order.
                assert_eq!(*product, dot(vector, &with));
                for (value, part) in expected.iter_mut().zip(vector) {
                    *value -= product * part;
                }
            }
            assert_eq!(left, expected);
        }
    }
}
