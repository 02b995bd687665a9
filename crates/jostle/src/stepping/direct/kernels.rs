//! The loops over all displacements of a building in a step, compiled for the widest available registers and chosen
//! at run time. Operations are not fused, so the bits are the same on every processor.

use pulp::NullaryFnOnce;

use super::integrator::{BuildingCoefficients, Coefficients};
use crate::simd;
use crate::structure::Equations;

/// Loads of the incremental step, without contacts and residual (theory, Eq. N3).
pub(super) struct Loads<'a> {
    pub(super) equations: &'a Equations,
    pub(super) own: &'a BuildingCoefficients,
    /// Change of the ground acceleration \[m/s²\].
    pub(super) change: f64,
    pub(super) velocity: &'a [f64],
    pub(super) acceleration: &'a [f64],
    pub(super) out: &'a mut [f64],
}

impl NullaryFnOnce for Loads<'_> {
    type Output = ();

    #[inline(always)]
    fn call(self) {
        let n = self.out.len();
        let (v, a) = (&self.velocity[..n], &self.acceleration[..n]);
        let mass = &self.equations.mass[..n];
        let driven = &self.equations.driven_mass[..n];
        let [l_v, l_a] = [self.own.l_v, self.own.l_a];
        for k in 0..n {
            self.out[k] = -mass[k] * (l_v * v[k] + l_a * a[k]) - driven[k] * self.change;
        }
    }
}

/// Displacements, velocities and accelerations at the end of the step (theory, Eq. N4).
pub(super) struct Advance<'a> {
    pub(super) equations: &'a Equations,
    pub(super) k: &'a Coefficients,
    pub(super) shift: f64,
    /// y, then the displacement over the step.
    pub(super) increment: &'a mut [f64],
    pub(super) displacement: &'a mut [f64],
    pub(super) velocity: &'a mut [f64],
    pub(super) acceleration: &'a mut [f64],
}

impl NullaryFnOnce for Advance<'_> {
    /// Σ m Δu of the driven masses, and Σ m Δu².
    type Output = [f64; 2];

    #[inline(always)]
    fn call(self) -> [f64; 2] {
        let n = self.increment.len();
        let increment = &mut self.increment[..n];
        let u = &mut self.displacement[..n];
        let v = &mut self.velocity[..n];
        let a = &mut self.acceleration[..n];
        let Coefficients {
            a: by_mass,
            c,
            b_v,
            b_a,
            d_v,
            d_a,
            ..
        } = *self.k;
        for k in 0..n {
            let (v0, a0) = (v[k], a[k]);
            let rate_term = d_v * v0 + d_a * a0;
            let change = increment[k] - self.shift * rate_term;
            increment[k] = change;
            u[k] += change;
            v[k] = v0 + c * change + rate_term;
            a[k] = a0 + by_mass * change + (b_v * v0 + b_a * a0);
        }
        [
            simd::dot(&self.equations.driven_mass, increment),
            simd::weighted_square(&self.equations.mass, increment),
        ]
    }
}
