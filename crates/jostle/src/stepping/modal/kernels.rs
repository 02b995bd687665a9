//! The loops over modes, compiled for the widest registers at hand and chosen at run time. Nothing is fused or
//! reordered between register widths, so that the bits are the same on every processor.

use pulp::{NullaryFnOnce, Simd, WithSimd};

/// Watched displacements taken at once.
pub(super) const ROWS: usize = 4;
/// Modes taken at once.
const LANES: usize = 8;

/// out = a q + b q̇ + c p₀ + d p₁, mode by mode.
pub(super) struct Combine<'a> {
    pub(super) factors: &'a [Vec<f64>; 4],
    pub(super) of: [&'a [f64]; 4],
    pub(super) out: &'a mut [f64],
}

impl NullaryFnOnce for Combine<'_> {
    type Output = ();

    #[inline(always)]
    fn call(self) {
        let n = self.out.len();
        let ([a, b, c, d], [q, v, p0, p1]) = (self.factors, self.of);
        let (a, b, c, d) = (&a[..n], &b[..n], &c[..n], &d[..n]);
        let (q, v, p0, p1) = (&q[..n], &v[..n], &p0[..n], &p1[..n]);
        for i in 0..n {
            self.out[i] = (a[i] * q[i] + b[i] * v[i]) + (c[i] * p0[i] + d[i] * p1[i]);
        }
    }
}

/// What two lists of modal values of one building show at its watched displacements.
pub(super) struct Show<'a> {
    /// Block after block of rows, mode by mode.
    pub(super) blocks: &'a [[f64; ROWS]],
    pub(super) modal: [&'a [f64]; 2],
    pub(super) watched: [&'a mut [f64]; 2],
}

impl WithSimd for Show<'_> {
    type Output = ();

    #[inline(always)]
    fn with_simd<S: Simd>(self, simd: S) {
        let [a, b] = self.modal;
        let [first, second] = self.watched;
        let blocks = self.blocks.chunks_exact(a.len().max(1));
        let places = first.chunks_mut(ROWS).zip(second.chunks_mut(ROWS));
        for (block, (first, second)) in blocks.zip(places) {
            // As many registers as a block needs, however wide they are.
            let mut sums = [[simd.splat_f64s(0.0); ROWS]; 2];
            for ((shape, a), b) in block.iter().zip(a).zip(b) {
                let (shape, _) = S::as_simd_f64s(shape);
                let (a, b) = (simd.splat_f64s(*a), simd.splat_f64s(*b));
                for (register, shape) in shape.iter().enumerate() {
                    let [u, v] = [&sums[0][register], &sums[1][register]];
                    let (u, v) = (
                        simd.add_f64s(*u, simd.mul_f64s(*shape, a)),
                        simd.add_f64s(*v, simd.mul_f64s(*shape, b)),
                    );
                    (sums[0][register], sums[1][register]) = (u, v);
                }
            }
            for (sums, out) in sums.iter().zip([first, second]) {
                let mut values = [0.0; ROWS];
                let (registers, _) = S::as_mut_simd_f64s(&mut values);
                let count = registers.len();
                registers.copy_from_slice(&sums[..count]);
                out.copy_from_slice(&values[..out.len()]);
            }
        }
    }
}

/// Sum of a quadratic form in four values over all modes: upper triangle row by row.
pub(super) struct Quadratic<'a> {
    pub(super) form: &'a [Vec<f64>; 10],
    pub(super) of: [&'a [f64]; 4],
}

impl WithSimd for Quadratic<'_> {
    type Output = f64;

    #[inline(always)]
    fn with_simd<S: Simd>(self, simd: S) -> f64 {
        let n = self.of[0].len();
        let whole = n - n % LANES;
        let mut lanes = [0.0; LANES];
        let (sums, _) = S::as_mut_simd_f64s(&mut lanes);
        let registers = sums.len();
        // Lists cut into registers: so many of them are one group of lanes. One by one: mapping arrays is not inlined.
        let [a, b, c, d] = self.of;
        let [aa, ab, ac, ad, bb, bc, bd, cc, cd, dd] = self.form;
        let count = cut::<S>(a, whole).len();
        let of = [
            &cut::<S>(a, whole)[..count],
            &cut::<S>(b, whole)[..count],
            &cut::<S>(c, whole)[..count],
            &cut::<S>(d, whole)[..count],
        ];
        let squares = [
            &cut::<S>(aa, whole)[..count],
            &cut::<S>(bb, whole)[..count],
            &cut::<S>(cc, whole)[..count],
            &cut::<S>(dd, whole)[..count],
        ];
        let products = [
            &cut::<S>(ab, whole)[..count],
            &cut::<S>(ac, whole)[..count],
            &cut::<S>(ad, whole)[..count],
            &cut::<S>(bc, whole)[..count],
            &cut::<S>(bd, whole)[..count],
            &cut::<S>(cd, whole)[..count],
        ];
        for at in 0..count {
            let [a, b, c, d] = [of[0][at], of[1][at], of[2][at], of[3][at]];
            let [aa, bb] = [squares[0][at], squares[1][at]];
            let [cc, dd] = [squares[2][at], squares[3][at]];
            let [ab, ac, ad] = [products[0][at], products[1][at], products[2][at]];
            let [bc, bd, cd] = [products[3][at], products[4][at], products[5][at]];
            let (times, plus) = (|x, y| simd.mul_f64s(x, y), |x, y| simd.add_f64s(x, y));
            let by_a = plus(
                plus(times(aa, a), times(ab, b)),
                plus(times(ac, c), times(ad, d)),
            );
            let by_b = plus(times(bb, b), plus(times(bc, c), times(bd, d)));
            let by_c = plus(times(cc, c), times(cd, d));
            let sum = plus(
                plus(times(a, by_a), times(b, by_b)),
                plus(times(c, by_c), times(times(dd, d), d)),
            );
            sums[at % registers] = simd.add_f64s(sums[at % registers], sum);
        }
        let term = |i: usize| {
            let [a, b, c, d] = [a[i], b[i], c[i], d[i]];
            a * ((aa[i] * a + ab[i] * b) + (ac[i] * c + ad[i] * d))
                + b * (bb[i] * b + (bc[i] * c + bd[i] * d))
                + (c * (cc[i] * c + cd[i] * d) + dd[i] * d * d)
        };
        let rest: f64 = (whole..n).map(term).sum();
        lanes.iter().sum::<f64>() + rest
    }
}

/// The first `whole` values, register by register.
#[inline(always)]
fn cut<S: Simd>(list: &[f64], whole: usize) -> &[S::f64s] {
    S::as_simd_f64s(&list[..whole]).0
}

#[cfg(test)]
mod tests {
    use pulp::{Arch, Scalar};

    use super::*;

    fn list(n: usize, seed: f64) -> Vec<f64> {
        (0..n).map(|i| (seed + 1.7 * i as f64).sin()).collect()
    }

    /// The same bits in wide registers as in narrow ones, and the right sums.
    #[test]
    fn register_width_does_not_show() {
        for n in [1, 3, 8, 23, 42] {
            let of: Vec<Vec<f64>> = (0..4).map(|k| list(n, f64::from(k))).collect();
            let of: [&[f64]; 4] = std::array::from_fn(|k| &of[k][..]);
            let form: [Vec<f64>; 10] = std::array::from_fn(|k| list(n, 9.0 + k as f64));
            let wide = Arch::new().dispatch(Quadratic { form: &form, of });
            let narrow = Quadratic { form: &form, of }.with_simd(Scalar::new());
            assert_eq!(wide.to_bits(), narrow.to_bits(), "{n} modes");
            let mut plain = 0.0;
            for i in 0..n {
                let mut entry = 0;
                for row in 0..4 {
                    for column in row..4 {
                        plain += form[entry][i] * of[row][i] * of[column][i];
                        entry += 1;
                    }
                }
            }
            assert!((wide - plain).abs() < 1e-12 * n as f64);
            for watched in [1, 4, 5, 10] {
                let rows: Vec<Vec<f64>> = (0..watched).map(|w| list(n, 30.0 + w as f64)).collect();
                let blocks: Vec<[f64; ROWS]> = (0..watched)
                    .step_by(ROWS)
                    .flat_map(|start| {
                        let rows = &rows;
                        (0..n).map(move |m| {
                            std::array::from_fn(|r| rows.get(start + r).map_or(0.0, |row| row[m]))
                        })
                    })
                    .collect();
                let show = |wide: bool| {
                    let mut out = [vec![0.0; watched], vec![0.0; watched]];
                    let [first, second] = &mut out;
                    let show = Show {
                        blocks: &blocks,
                        modal: [of[0], of[1]],
                        watched: [first, second],
                    };
                    if wide {
                        Arch::new().dispatch(show);
                    } else {
                        show.with_simd(Scalar::new());
                    }
                    out
                };
                assert_eq!(show(true), show(false));
                for (row, got) in rows.iter().zip(&show(true)[1]) {
                    let plain: f64 = row.iter().zip(of[1]).map(|(a, b)| a * b).sum();
                    assert!((got - plain).abs() < 1e-13 * n as f64);
                }
            }
        }
    }
}
