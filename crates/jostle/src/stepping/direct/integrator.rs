//! The step in incremental form (theory, Eqs. N2 to N4).

use crate::linear::StepMatrix;
use crate::model::Integrator;
use crate::structure::Equations;

impl Integrator {
    pub(crate) fn coefficients(&self, step: f64) -> Coefficients {
        let (beta, gamma) = (self.beta, self.gamma);
        Coefficients {
            step,
            a: 1.0 / (beta * step * step),
            c: gamma / (beta * step),
            b_v: -1.0 / (beta * step),
            b_a: -0.5 / beta,
            d_v: -gamma / beta,
            d_a: step * (1.0 - 0.5 * gamma / beta),
            inertia: (1.0 - self.alpha_m) / (1.0 - self.alpha_f),
            unbalanced: 1.0 / (1.0 - self.alpha_f),
            carried: -self.alpha_f / (1.0 - self.alpha_f),
            left: (self.alpha_f - self.alpha_m) / (1.0 - self.alpha_f),
        }
    }
}

/// Δv = c Δu + D′ and Δa = a Δu + B′, with D′ = d_v v + d_a a and B′ = b_v v + b_a a. The residual at the start, R,
/// has the weight `unbalanced` in the step and becomes `carried`·R + `left`·M Δa at its end (theory, Eq. N4).
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(crate) struct Coefficients {
    pub(crate) step: f64,
    pub(crate) a: f64,
    pub(crate) c: f64,
    pub(crate) b_v: f64,
    pub(crate) b_a: f64,
    pub(crate) d_v: f64,
    pub(crate) d_a: f64,
    /// Weight of inertia relative to all other forces: 1 unless equilibrium is shifted.
    inertia: f64,
    pub(crate) unbalanced: f64,
    pub(crate) carried: f64,
    pub(crate) left: f64,
}

/// The same for one building: K̂ = κ K + K′ + c C′ + g M, y = Δu + s D′,
/// load = −M (l_v v + l_a a) + s K′ D′ − (1 − s c) C′ D′ + Δp.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(crate) struct BuildingCoefficients {
    pub(crate) stiffness: f64,
    pub(crate) mass: f64,
    pub(crate) dashpots: f64,
    pub(crate) shift: f64,
    pub(crate) l_v: f64,
    pub(crate) l_a: f64,
    /// 1 − s c.
    pub(crate) dashpot_load: f64,
}

impl Coefficients {
    pub(crate) fn of_building(&self, equations: &Equations) -> BuildingCoefficients {
        let (alpha, beta) = (equations.alpha, equations.beta);
        let stiffness = 1.0 + beta * self.c;
        let mass = self.inertia * self.a + alpha * self.c;
        let shift = beta / stiffness;
        let through_velocity = alpha - mass * shift;
        BuildingCoefficients {
            stiffness,
            mass,
            dashpots: self.c,
            shift,
            l_v: self.inertia * self.b_v + through_velocity * self.d_v,
            l_a: self.inertia * self.b_a + through_velocity * self.d_a,
            dashpot_load: 1.0 - shift * self.c,
        }
    }
}

impl BuildingCoefficients {
    /// K̂ of the step.
    pub(crate) fn matrix(&self) -> StepMatrix {
        StepMatrix {
            stiffness: self.stiffness,
            mass: self.mass,
            dashpots: self.dashpots,
        }
    }
}
