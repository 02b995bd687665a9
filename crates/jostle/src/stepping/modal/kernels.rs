//! The loops over modes, compiled for the widest registers at hand and chosen at run time. Nothing is fused or
//! reordered between register widths, so that the bits are the same on every processor.

use pulp::NullaryFnOnce;

/// Watched displacements taken at once.
pub(super) const ROWS: usize = 4;
/// Modes taken at once.
const LANES: usize = 8;

/// out = a q + b q̇ + c p₀ + d p₁, mode by mode.
pub(super) struct Combine<'a> {
    pub(super) factors: [&'a [f64]; 4],
    pub(super) of: [&'a [f64]; 4],
    pub(super) out: &'a mut [f64],
}

impl NullaryFnOnce for Combine<'_> {
    type Output = ();

    #[inline(always)]
    fn call(self) {
        let n = self.out.len();
        let [a, b, c, d] = self.factors.map(|list| &list[..n]);
        let [q, v, p0, p1] = self.of.map(|list| &list[..n]);
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

impl NullaryFnOnce for Show<'_> {
    type Output = ();

    #[inline(always)]
    fn call(self) {
        let [a, b] = self.modal;
        let [first, second] = self.watched;
        let blocks = self.blocks.chunks_exact(a.len().max(1));
        let places = first.chunks_mut(ROWS).zip(second.chunks_mut(ROWS));
        for (block, (first, second)) in blocks.zip(places) {
            let (mut u, mut v) = ([0.0; ROWS], [0.0; ROWS]);
            for ((shape, a), b) in block.iter().zip(a).zip(b) {
                for row in 0..ROWS {
                    u[row] += shape[row] * a;
                    v[row] += shape[row] * b;
                }
            }
            first.copy_from_slice(&u[..first.len()]);
            second.copy_from_slice(&v[..second.len()]);
        }
    }
}

/// Sum of a quadratic form in four values over all modes: upper triangle row by row.
pub(super) struct Quadratic<'a> {
    pub(super) form: [&'a [f64]; 10],
    pub(super) of: [&'a [f64]; 4],
}

impl NullaryFnOnce for Quadratic<'_> {
    type Output = f64;

    #[inline(always)]
    fn call(self) -> f64 {
        let n = self.of[0].len();
        let [a, b, c, d] = self.of.map(|list| &list[..n]);
        let [aa, ab, ac, ad, bb, bc, bd, cc, cd, dd] = self.form.map(|list| &list[..n]);
        let term = |i: usize| {
            a[i] * ((aa[i] * a[i] + ab[i] * b[i]) + (ac[i] * c[i] + ad[i] * d[i]))
                + b[i] * (bb[i] * b[i] + (bc[i] * c[i] + bd[i] * d[i]))
                + (c[i] * (cc[i] * c[i] + cd[i] * d[i]) + dd[i] * d[i] * d[i])
        };
        let mut sums = [0.0; LANES];
        let whole = n - n % LANES;
        for start in (0..whole).step_by(LANES) {
            for (lane, sum) in sums.iter_mut().enumerate() {
                *sum += term(start + lane);
            }
        }
        let rest: f64 = (whole..n).map(term).sum();
        sums.iter().sum::<f64>() + rest
    }
}
