//! The loops over modes, compiled for the widest available registers and chosen at run time. Operations are not
//! fused or reordered between register widths, so the bits are the same on every processor.

use pulp::{NullaryFnOnce, Simd, WithSimd};

use super::response::{INPUTS, PRODUCTS};
use crate::motion::Ground;
use crate::simd;

/// Monitored displacements processed at once.
pub(super) const ROWS: usize = 8;
/// Modes processed at once.
pub(super) const LANES: usize = 8;

/// Σ factors of (q₀, q̇₀, p₀, p₁, b), mode by mode.
pub(super) struct Combine<'a> {
    pub(super) factors: &'a [Vec<f64>; INPUTS],
    pub(super) of: [&'a [f64]; INPUTS],
    pub(super) out: &'a mut [f64],
}

impl NullaryFnOnce for Combine<'_> {
    type Output = ();

    #[inline(always)]
    fn call(self) {
        let n = self.out.len();
        let ([a, b, c, d, e], [q, v, p0, p1, bend]) = (self.factors, self.of);
        let (a, b, c, d, e) = (&a[..n], &b[..n], &c[..n], &d[..n], &e[..n]);
        let (q, v, p0, p1, bend) = (&q[..n], &v[..n], &p0[..n], &p1[..n], &bend[..n]);
        for i in 0..n {
            let by_loads = (c[i] * p0[i] + d[i] * p1[i]) + e[i] * bend[i];
            self.out[i] = (a[i] * q[i] + b[i] * v[i]) + by_loads;
        }
    }
}

/// Work of loads on damped modes over a step minus their change of energy \[J\].
pub(super) struct Unkept<'a> {
    pub(super) damping: &'a [f64],
    pub(super) stiffness: &'a [f64],
    pub(super) step: f64,
    /// q₀, q̇₀, p₀, p₁ and b, then q₁ and q̇₁, ∫q and ∫τq.
    pub(super) of: [&'a [f64]; INPUTS],
    pub(super) end: [&'a [f64]; 2],
    pub(super) area: &'a [f64],
    pub(super) moment: &'a [f64],
}

impl Unkept<'_> {
    #[inline(always)]
    fn of_mode(&self, i: usize) -> f64 {
        let ([q0, v0, p0, p1, bend], [q1, v1]) = (self.of, self.end);
        let (area, moment) = (self.area[i], self.moment[i]);
        let turned = (p1[i] - p0[i]) * area + bend[i] * (2.0 * moment - area);
        let put_in = p1[i] * q1[i] - p0[i] * q0[i] - turned / self.step;
        let kinetic = v1[i] * v1[i] - v0[i] * v0[i];
        let strain = self.stiffness[i] * (q1[i] * q1[i] - q0[i] * q0[i]);
        if self.damping[i] > 0.0 {
            put_in - 0.5 * (kinetic + strain)
        } else {
            0.0
        }
    }
}

impl NullaryFnOnce for Unkept<'_> {
    type Output = f64;

    #[inline(always)]
    fn call(self) -> f64 {
        let n = self.damping.len();
        let ([q0, v0, p0, p1, bend], [q1, v1]) = (self.of, self.end);
        // All of one length, to avoid bounds checks.
        let cut = Self {
            stiffness: &self.stiffness[..n],
            of: [&q0[..n], &v0[..n], &p0[..n], &p1[..n], &bend[..n]],
            end: [&q1[..n], &v1[..n]],
            area: &self.area[..n],
            moment: &self.moment[..n],
            ..self
        };
        let whole = n - n % LANES;
        let mut lanes = [0.0; LANES];
        for first in (0..whole).step_by(LANES) {
            for lane in 0..LANES {
                lanes[lane] += cut.of_mode(first + lane);
            }
        }
        let mut rest = 0.0;
        for mode in whole..n {
            rest += cut.of_mode(mode);
        }
        lanes.iter().sum::<f64>() + rest
    }
}

/// axpy for several lists.
pub(super) struct AddUp<'a, const N: usize> {
    pub(super) factor: f64,
    pub(super) of: [&'a [f64]; N],
    pub(super) to: [&'a mut [f64]; N],
}

impl<const N: usize> NullaryFnOnce for AddUp<'_, N> {
    type Output = ();

    #[inline(always)]
    fn call(self) {
        for (to, of) in self.to.into_iter().zip(self.of) {
            simd::add(to, self.factor, of);
        }
    }
}

/// Monitored displacements of one building from lists of modal values.
pub(super) struct Show<'a, const N: usize> {
    /// Block after block of rows, mode by mode.
    pub(super) blocks: &'a [[f64; ROWS]],
    pub(super) modal: [&'a [f64]; N],
    /// Padded to whole blocks.
    pub(super) watched: [&'a mut [f64]; N],
}

impl<const N: usize> WithSimd for Show<'_, N> {
    type Output = ();

    #[inline(always)]
    fn with_simd<S: Simd>(self, simd: S) {
        let Self {
            blocks,
            modal,
            mut watched,
        } = self;
        let n = modal[0].len();
        for (at, block) in blocks.chunks_exact(n.max(1)).enumerate() {
            // As many registers as a block needs at any width.
            let mut sums = [[simd.splat_f64s(0.0); ROWS]; N];
            for (mode, shape) in block.iter().enumerate() {
                let (shape, _) = S::as_simd_f64s(shape);
                for (sums, list) in sums.iter_mut().zip(&modal) {
                    let value = simd.splat_f64s(list[mode]);
                    for (sum, shape) in sums.iter_mut().zip(shape) {
                        *sum = simd.add_f64s(*sum, simd.mul_f64s(*shape, value));
                    }
                }
            }
            for (sums, out) in sums.iter().zip(&mut watched) {
                let (places, _) = S::as_mut_simd_f64s(&mut out[at * ROWS..][..ROWS]);
                for (place, sum) in places.iter_mut().zip(sums) {
                    *place = *sum;
                }
            }
        }
    }
}

/// Factors of [`LANES`] modes for free-vibration steps of one length, where loads follow from `N` components of the ground
/// acceleration a alone.
#[derive(Clone, Copy, Debug)]
pub(super) struct Lanes<const N: usize> {
    /// Of (q₀, q̇₀) in q₁ and in q̇₁.
    pub(super) displacement: [[f64; LANES]; 2],
    pub(super) velocity: [[f64; LANES]; 2],
    /// Of the dissipated energy: q₀², q₀q̇₀, q̇₀².
    pub(super) damped: [[f64; LANES]; 3],
    pub(super) driven: [DrivenLanes; N],
    pub(super) damping: [f64; LANES],
    pub(super) stiffness: [f64; LANES],
}

/// What one component of the ground acceleration contributes.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct DrivenLanes {
    /// Of (a₀, a₁) in q₁ and in q̇₁.
    pub(super) displacement: [[f64; LANES]; 2],
    pub(super) velocity: [[f64; LANES]; 2],
    /// Of the dissipated energy: q₀a₀, q₀a₁, q̇₀a₀, q̇₀a₁.
    pub(super) damped: [[f64; LANES]; 4],
    /// Of Γ ∫q dt: q₀ and q̇₀.
    pub(super) area: [[f64; LANES]; 2],
    pub(super) participation: [f64; LANES],
}

impl<const N: usize> Default for Lanes<N> {
    fn default() -> Self {
        Self {
            displacement: Default::default(),
            velocity: Default::default(),
            damped: Default::default(),
            driven: [DrivenLanes::default(); N],
            damping: Default::default(),
            stiffness: Default::default(),
        }
    }
}

/// Sums over modes of a step, lane by lane.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Sums {
    /// Dissipated energy without the products of ground accelerations \[J\].
    pub(super) damped: [f64; LANES],
    /// Γ ∫q dt of every component without the parts of ground accelerations.
    pub(super) area: [[f64; LANES]; 2],
    /// Γ q₁ of every component.
    pub(super) moved: [[f64; LANES]; 2],
    /// 2 T and 2 U at the end \[J\].
    pub(super) kinetic: [f64; LANES],
    pub(super) strain: [f64; LANES],
}

/// Several free-vibration steps, for all modes, under `N` components of the ground motion.
pub(super) struct Ahead<'a, const N: usize> {
    pub(super) lanes: &'a [Lanes<N>],
    /// Ground acceleration at the start and after every step.
    pub(super) ground: &'a [Ground],
    /// q₀ and q̇₀.
    pub(super) start: [&'a [f64]; 2],
    /// q, q̇, q̈ and jerk without load, step after step.
    pub(super) modal: [&'a mut [f64]; 4],
    pub(super) sums: &'a mut [Sums],
}

impl<const N: usize> WithSimd for Ahead<'_, N> {
    type Output = ();

    #[inline(always)]
    fn with_simd<S: Simd>(self, simd: S) {
        let stride = self.lanes.len() * LANES;
        let (times, plus) = (
            |x, y| simd.mul_f64s(x, y),
            |x: S::f64s, y: S::f64s| simd.add_f64s(x, y),
        );
        let [out_q, out_v, out_a, out_j] = self.modal;
        for (group, lane) in self.lanes.iter().enumerate() {
            let first = group * LANES;
            let registers = one::<S>(&lane.stiffness).len();
            for r in 0..registers {
                let factor = |list: &[f64; LANES]| one::<S>(list)[r];
                let at = |list: &[f64]| S::as_simd_f64s(&list[first..first + LANES]).0[r];
                let (mut q0, mut v0) = (at(self.start[0]), at(self.start[1]));
                let (damping, stiffness) = (factor(&lane.damping), factor(&lane.stiffness));
                for (k, (ground, sums)) in self.ground.windows(2).zip(&mut *self.sums).enumerate() {
                    let two = |[a, b]: [&[f64; LANES]; 2], x, y| {
                        plus(times(factor(a), x), times(factor(b), y))
                    };
                    let mut q1 = two(lane.displacement.each_ref(), q0, v0);
                    let mut v1 = two(lane.velocity.each_ref(), q0, v0);
                    let [aa, ab, bb] = lane.damped.each_ref();
                    let mut by_q = two([aa, ab], q0, v0);
                    let mut by_v = times(factor(bb), v0);
                    let mut pushed = simd.splat_f64s(0.0);
                    for (axis, driven) in lane.driven.iter().enumerate() {
                        let g0 = simd.splat_f64s(ground[0][axis]);
                        let g1 = simd.splat_f64s(ground[1][axis]);
                        q1 = plus(q1, two(driven.displacement.each_ref(), g0, g1));
                        v1 = plus(v1, two(driven.velocity.each_ref(), g0, g1));
                        let [q_first, q_last, v_first, v_last] = driven.damped.each_ref();
                        by_q = plus(by_q, two([q_first, q_last], g0, g1));
                        by_v = plus(by_v, two([v_first, v_last], g0, g1));
                        let load = times(factor(&driven.participation), g1);
                        pushed = if axis == 0 { load } else { plus(pushed, load) };
                    }
                    let strained = times(stiffness, q1);
                    let a1 =
                        simd.sub_f64s(simd.neg_f64s(plus(pushed, times(damping, v1))), strained);
                    let j1 = simd.neg_f64s(plus(times(damping, a1), times(stiffness, v1)));
                    let add = |sum: &mut [f64; LANES], value: S::f64s| {
                        let place = &mut S::as_mut_simd_f64s(sum).0[r];
                        *place = plus(*place, value);
                    };
                    add(&mut sums.damped, plus(times(q0, by_q), times(v0, by_v)));
                    for (axis, driven) in lane.driven.iter().enumerate() {
                        add(&mut sums.area[axis], two(driven.area.each_ref(), q0, v0));
                        add(
                            &mut sums.moved[axis],
                            times(factor(&driven.participation), q1),
                        );
                    }
                    add(&mut sums.kinetic, times(v1, v1));
                    add(&mut sums.strain, times(strained, q1));
                    let here = k * stride + first;
                    let put = |list: &mut [f64], value: S::f64s| {
                        S::as_mut_simd_f64s(&mut list[here..here + LANES]).0[r] = value;
                    };
                    put(out_q, q1);
                    put(out_v, v1);
                    put(out_a, a1);
                    put(out_j, j1);
                    (q0, v0) = (q1, v1);
                }
            }
        }
    }
}

/// Peaks of monitored quantities so far, which are limits for detection; infinite for padding.
#[derive(Clone, Debug, Default)]
pub(super) struct Limits {
    /// Of displacements, and of the base shear in both directions \[m, N\].
    pub(super) high: Vec<f64>,
    pub(super) low: Vec<f64>,
    /// Of storey drifts times storey heights, and of total accelerations \[m, m/s²\].
    pub(super) drift: Vec<f64>,
    pub(super) acceleration: Vec<f64>,
}

/// Whether a step may exceed a limit, block by block of monitored quantities: a cubic between its ends leaves their
/// range by no more than `beyond` times the sum of its end slopes.
pub(super) struct Exceeds<'a, const N: usize> {
    pub(super) limits: &'a Limits,
    /// At both ends: displacements, velocities, accelerations, and jerk without load.
    pub(super) ends: [[&'a [f64]; 4]; 2],
    pub(super) driven: [&'a [f64]; N],
    /// Share of every component of the ground acceleration in total accelerations; any lists if there is one component alone,
    /// all of which every quantity sees.
    pub(super) moved: [&'a [f64]; N],
    /// Ground acceleration at both ends, and its slope, of every component.
    pub(super) ground: [[f64; N]; 2],
    pub(super) ground_rate: [f64; N],
    pub(super) beyond: f64,
    pub(super) seen: &'a mut [bool],
}

impl<const N: usize> WithSimd for Exceeds<'_, N> {
    /// Whether any block may.
    type Output = bool;

    #[inline(always)]
    fn with_simd<S: Simd>(self, simd: S) -> bool {
        let places = self.seen.len() * ROWS;
        let [[u0, v0, a0, l0], [u1, v1, a1, l1]] = self.ends;
        let Limits {
            high,
            low,
            drift,
            acceleration,
        } = self.limits;
        let count = places / S::F64_LANES;
        let (below_u0, below_u1) = (below::<S>(u0, count), below::<S>(u1, count));
        let (below_v0, below_v1) = (below::<S>(v0, count), below::<S>(v1, count));
        let (u0, v0, a0, l0) = (
            own::<S>(u0, count),
            own::<S>(v0, count),
            own::<S>(a0, count),
            own::<S>(l0, count),
        );
        let (u1, v1, a1, l1) = (
            own::<S>(u1, count),
            own::<S>(v1, count),
            own::<S>(a1, count),
            own::<S>(l1, count),
        );
        let (high, low) = (own::<S>(high, count), own::<S>(low, count));
        let driven = self.driven.map(|list| own::<S>(list, count));
        let shares = self.moved.map(|list| own::<S>(list, count));
        let (drift, acceleration) = (own::<S>(drift, count), own::<S>(acceleration, count));
        let [g0, g1] = self.ground.map(|ground| ground.map(|g| simd.splat_f64s(g)));
        let slope = self.ground_rate.map(|rate| simd.splat_f64s(rate));
        let beyond = simd.splat_f64s(self.beyond);
        let mut any = false;
        let registers = ROWS / S::F64_LANES;
        for (block, seen) in self.seen.iter_mut().enumerate() {
            *seen = false;
            for at in block * registers..(block + 1) * registers {
                let reach = out_of(simd, beyond, v0[at], v1[at]);
                let above = simd.add_f64s(simd.max_f64s(u0[at], u1[at]), reach);
                let under = simd.sub_f64s(simd.min_f64s(u0[at], u1[at]), reach);
                let moved = simd.or_m64s(
                    simd.greater_than_f64s(above, high[at]),
                    simd.less_than_f64s(under, low[at]),
                );
                let (mut rate0, mut rate1) = (l0[at], l1[at]);
                let (mut then, mut now) = (a0[at], a1[at]);
                for axis in 0..N {
                    let seen_share = |value: S::f64s| match N {
                        1 => value,
                        _ => simd.mul_f64s(shares[axis][at], value),
                    };
                    let slope_seen = seen_share(slope[axis]);
                    let free =
                        simd.sub_f64s(slope_seen, simd.mul_f64s(slope[axis], driven[axis][at]));
                    (rate0, rate1) = (simd.add_f64s(rate0, free), simd.add_f64s(rate1, free));
                    then = simd.add_f64s(then, seen_share(g0[axis]));
                    now = simd.add_f64s(now, seen_share(g1[axis]));
                }
                let reach = out_of(simd, beyond, rate0, rate1);
                let total = simd.add_f64s(greater(simd, then, now), reach);
                let shaken = simd.greater_than_f64s(total, acceleration[at]);
                // The lowest one has no limit relative to a floor below.
                let (then, now, rate0, rate1) = if at == 0 {
                    (
                        simd.rotate_right_f64s(u0[0], 1),
                        simd.rotate_right_f64s(u1[0], 1),
                        simd.rotate_right_f64s(v0[0], 1),
                        simd.rotate_right_f64s(v1[0], 1),
                    )
                } else {
                    let at = at - 1;
                    (below_u0[at], below_u1[at], below_v0[at], below_v1[at])
                };
                let (then, now) = (simd.sub_f64s(u0[at], then), simd.sub_f64s(u1[at], now));
                let (rate0, rate1) = (simd.sub_f64s(v0[at], rate0), simd.sub_f64s(v1[at], rate1));
                let reach = out_of(simd, beyond, rate0, rate1);
                let total = simd.add_f64s(greater(simd, then, now), reach);
                let apart = simd.greater_than_f64s(total, drift[at]);
                let found = simd.or_m64s(simd.or_m64s(moved, shaken), apart);
                *seen |= simd.first_true_m64s(found) < S::F64_LANES;
            }
            any |= *seen;
        }
        any
    }
}

/// Several registers of a list.
#[inline(always)]
fn own<S: Simd>(list: &[f64], count: usize) -> &[S::f64s] {
    &S::as_simd_f64s(list).0[..count]
}

/// For each of them after the first, the values shifted by one.
#[inline(always)]
fn below<S: Simd>(list: &[f64], count: usize) -> &[S::f64s] {
    &S::as_simd_f64s(&list[S::F64_LANES - 1..]).0[..count - 1]
}

/// Largest excess of cubics with these end slopes over the range of their ends.
#[inline(always)]
fn out_of<S: Simd>(simd: S, beyond: S::f64s, before: S::f64s, after: S::f64s) -> S::f64s {
    let slopes = simd.add_f64s(simd.abs_f64s(before), simd.abs_f64s(after));
    simd.mul_f64s(beyond, slopes)
}

/// The greater magnitude of two.
#[inline(always)]
fn greater<S: Simd>(simd: S, a: S::f64s, b: S::f64s) -> S::f64s {
    simd.max_f64s(simd.abs_f64s(a), simd.abs_f64s(b))
}

/// [`LANES`] values, register by register.
#[inline(always)]
fn one<S: Simd>(list: &[f64; LANES]) -> &[S::f64s] {
    S::as_simd_f64s(list).0
}

/// Sum of a quadratic form in (q₀, q̇₀, p₀, p₁, b) over all modes: upper triangle row by row.
pub(super) struct Quadratic<'a> {
    pub(super) form: &'a [Vec<f64>; PRODUCTS],
    pub(super) of: [&'a [f64]; INPUTS],
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
        // Lists divided into registers, several of which form a group of lanes. Written out, because mapping arrays
        // is not inlined.
        let [a, b, c, d, e] = self.of;
        let [aa, ab, ac, ad, ae, bb, bc, bd, be, cc, cd, ce, dd, de, ee] = self.form;
        let count = whole / S::F64_LANES;
        let of = [
            own::<S>(a, count),
            own::<S>(b, count),
            own::<S>(c, count),
            own::<S>(d, count),
            own::<S>(e, count),
        ];
        let squares = [
            own::<S>(aa, count),
            own::<S>(bb, count),
            own::<S>(cc, count),
            own::<S>(dd, count),
            own::<S>(ee, count),
        ];
        let products = [
            own::<S>(ab, count),
            own::<S>(ac, count),
            own::<S>(ad, count),
            own::<S>(ae, count),
            own::<S>(bc, count),
            own::<S>(bd, count),
            own::<S>(be, count),
            own::<S>(cd, count),
            own::<S>(ce, count),
            own::<S>(de, count),
        ];
        for at in 0..count {
            let [a, b, c, d, e] = [of[0][at], of[1][at], of[2][at], of[3][at], of[4][at]];
            let [aa, bb, cc] = [squares[0][at], squares[1][at], squares[2][at]];
            let [dd, ee] = [squares[3][at], squares[4][at]];
            let [ab, ac, ad] = [products[0][at], products[1][at], products[2][at]];
            let [ae, bc, bd] = [products[3][at], products[4][at], products[5][at]];
            let [be, cd] = [products[6][at], products[7][at]];
            let [ce, de] = [products[8][at], products[9][at]];
            let (times, plus) = (|x, y| simd.mul_f64s(x, y), |x, y| simd.add_f64s(x, y));
            let by_a = plus(
                plus(times(aa, a), times(ab, b)),
                plus(plus(times(ac, c), times(ad, d)), times(ae, e)),
            );
            let by_b = plus(
                times(bb, b),
                plus(plus(times(bc, c), times(bd, d)), times(be, e)),
            );
            let by_c = plus(plus(times(cc, c), times(cd, d)), times(ce, e));
            let by_d = plus(times(dd, d), times(de, e));
            let sum = plus(
                plus(times(a, by_a), times(b, by_b)),
                plus(plus(times(c, by_c), times(d, by_d)), times(times(ee, e), e)),
            );
            sums[at % registers] = simd.add_f64s(sums[at % registers], sum);
        }
        let term = |i: usize| {
            let [a, b, c, d, e] = [a[i], b[i], c[i], d[i], e[i]];
            let by_a = (aa[i] * a + ab[i] * b) + ((ac[i] * c + ad[i] * d) + ae[i] * e);
            let by_b = bb[i] * b + ((bc[i] * c + bd[i] * d) + be[i] * e);
            let by_c = (cc[i] * c + cd[i] * d) + ce[i] * e;
            let by_d = dd[i] * d + de[i] * e;
            (a * by_a + b * by_b) + ((c * by_c + d * by_d) + ee[i] * e * e)
        };
        let rest: f64 = (whole..n).map(term).sum();
        lanes.iter().sum::<f64>() + rest
    }
}

#[cfg(test)]
mod tests {
    use pulp::{Arch, Scalar};

    use super::*;

    fn list(n: usize, seed: f64) -> Vec<f64> {
        (0..n).map(|i| (seed + 1.7 * i as f64).sin()).collect()
    }

    /// Several steps at once have the same bits in wide and narrow registers.
    #[test]
    fn nor_does_it_in_steps_ahead() {
        let values = |seed: f64| std::array::from_fn(|lane| (seed + 1.7 * lane as f64).sin());
        let lanes: Vec<Lanes<2>> = (0..3)
            .map(|group| {
                let at = |k: usize| f64::from(group) + 0.37 * k as f64;
                let driven = |axis: usize| DrivenLanes {
                    displacement: std::array::from_fn(|k| values(at(k + 2 + 20 * axis))),
                    velocity: std::array::from_fn(|k| values(at(k + 6 + 20 * axis))),
                    damped: std::array::from_fn(|k| values(at(k + 11 + 20 * axis))),
                    area: std::array::from_fn(|k| values(at(k + 15 + 20 * axis))),
                    participation: values(at(17 + 20 * axis)),
                };
                Lanes {
                    displacement: std::array::from_fn(|k| values(at(k))),
                    velocity: std::array::from_fn(|k| values(at(k + 4))),
                    damped: std::array::from_fn(|k| values(at(k + 8))),
                    driven: std::array::from_fn(driven),
                    damping: values(at(18)),
                    stiffness: values(at(19)),
                }
            })
            .collect();
        let (n, steps) = (lanes.len() * LANES, 5);
        let (q, v) = (list(n, 0.3), list(n, 0.9));
        let [along, across] = [2.0, 4.0].map(|seed| list(steps + 1, seed));
        let ground: Vec<Ground> = along
            .into_iter()
            .zip(across)
            .map(|(x, y)| [x, y, 0.0])
            .collect();
        let ahead = |wide: bool| {
            let mut modal = [(); 4].map(|()| vec![0.0; n * steps]);
            let mut sums = vec![Sums::default(); steps];
            let [a, b, c, d] = &mut modal;
            let ahead = Ahead {
                lanes: &lanes,
                ground: &ground,
                start: [&q, &v],
                modal: [a, b, c, d],
                sums: &mut sums,
            };
            if wide {
                Arch::new().dispatch(ahead);
            } else {
                ahead.with_simd(Scalar::new());
            }
            let sums = sums.iter().flat_map(|sums| {
                let Sums {
                    damped,
                    area,
                    moved,
                    kinetic,
                    strain,
                } = sums;
                let [[a, b], [c, d]] = [area, moved];
                [damped, a, b, c, d, kinetic, strain].into_iter().flatten()
            });
            let mut all: Vec<f64> = sums.copied().collect();
            all.extend(modal.concat());
            all
        };
        let (wide, narrow) = (ahead(true), ahead(false));
        assert_eq!(wide, narrow);
        assert!(wide.iter().any(|value| *value != 0.0));
    }

    /// The same bits in wide and narrow registers, and correct sums.
    #[test]
    fn register_width_does_not_show() {
        for n in [1, 3, 8, 23, 42] {
            let of: Vec<Vec<f64>> = (0..5).map(|k| list(n, f64::from(k))).collect();
            let of: [&[f64]; INPUTS] = std::array::from_fn(|k| &of[k][..]);
            let form: [Vec<f64>; PRODUCTS] = std::array::from_fn(|k| list(n, 9.0 + k as f64));
            let wide = Arch::new().dispatch(Quadratic { form: &form, of });
            let narrow = Quadratic { form: &form, of }.with_simd(Scalar::new());
            assert_eq!(wide.to_bits(), narrow.to_bits(), "{n} modes");
            let mut plain = 0.0;
            for i in 0..n {
                let mut entry = 0;
                for row in 0..INPUTS {
                    for column in row..INPUTS {
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
                    let places = watched.div_ceil(ROWS) * ROWS;
                    let mut out = [vec![0.0; places], vec![0.0; places]];
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

    /// Every block is tested separately; its floor below may be in the previous block.
    #[test]
    fn exceeding_is_seen_block_by_block() {
        let n = 3 * ROWS;
        let [then, now]: [[Vec<f64>; 4]; 2] =
            [0.2, 0.7].map(|at| std::array::from_fn(|k| list(n, at + 3.0 * k as f64)));
        let driven = list(n, 5.0);
        let ends = [&then, &now].map(|lists| lists.each_ref().map(|list| &list[..]));
        let ([g0, g1], ground_rate, beyond) = ([0.3, -0.4], 0.9, 0.15);
        let most = |a: f64, b: f64, slopes: [f64; 2]| {
            a.max(b) + beyond * (slopes[0].abs() + slopes[1].abs())
        };
        let free = |i: usize| ground_rate * (1.0 - driven[i]);
        let high = |i: usize| most(then[0][i], now[0][i], [then[1][i], now[1][i]]);
        let low = |i: usize| -most(-then[0][i], -now[0][i], [then[1][i], now[1][i]]);
        let drift = |i: usize| {
            let part = |list: &Vec<f64>| list[i] - list[i - 1];
            let [a, b] = [&then[0], &now[0]].map(|list| part(list).abs());
            most(a, b, [part(&then[1]), part(&now[1])])
        };
        let acceleration = |i: usize| {
            let (a, b) = ((then[2][i] + g0).abs(), (now[2][i] + g1).abs());
            most(a, b, [then[3][i] + free(i), now[3][i] + free(i)])
        };
        let widest = |i: usize| if i == 0 { f64::INFINITY } else { drift(i) };
        // Slightly above the reached values everywhere, except for one quantity at one point.
        for place in 0..n {
            for quantity in 0..4 {
                let gap = |i: usize, k: usize| {
                    if (i, k) == (place, quantity) {
                        -1e-9
                    } else {
                        1e-9
                    }
                };
                let limits = Limits {
                    high: (0..n).map(|i| high(i) + gap(i, 0)).collect(),
                    low: (0..n).map(|i| low(i) - gap(i, 1)).collect(),
                    drift: (0..n).map(|i| widest(i) + gap(i, 2)).collect(),
                    acceleration: (0..n).map(|i| acceleration(i) + gap(i, 3)).collect(),
                };
                let mut expected = vec![false; n / ROWS];
                expected[place / ROWS] = (place, quantity) != (0, 2);
                for wide in [false, true] {
                    let mut seen = vec![false; n / ROWS];
                    let exceeds = Exceeds {
                        limits: &limits,
                        ends,
                        driven: [&driven],
                        moved: [&driven],
                        ground: [[g0], [g1]],
                        ground_rate: [ground_rate],
                        beyond,
                        seen: &mut seen,
                    };
                    let any = if wide {
                        Arch::new().dispatch(exceeds)
                    } else {
                        exceeds.with_simd(Scalar::new())
                    };
                    assert_eq!(seen, expected, "{place}, {quantity}, {wide}");
                    assert_eq!(any, seen.contains(&true));
                }
            }
        }
    }
}
