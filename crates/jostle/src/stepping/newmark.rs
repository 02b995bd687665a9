//! The Newmark step in incremental form (theory, Eqs. N2 and N3).

use crate::equations::Equations;

/// Newmark's family; (¼, ½) is the default, unconditionally stable and free of numerical damping.
///
/// Second order only for γ = ½; γ > ½ dissipates energy and so spoils the restitution of impacts.
/// The energy balance holds for (¼, ½). N. M. Newmark (1959), J. Eng. Mech. Div. ASCE 85, 67–94.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Newmark {
    /// β > 0 \[–\].
    pub beta: f64,
    /// γ ≥ ½ \[–\].
    pub gamma: f64,
}

impl Default for Newmark {
    fn default() -> Self {
        Self {
            beta: 0.25,
            gamma: 0.5,
        }
    }
}

/// Δv = c Δu + D′ and Δa = a Δu + B′, with D′ = d_v v + d_a a and B′ = b_v v + b_a a.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(crate) struct Coefficients {
    pub(crate) step: f64,
    pub(crate) a: f64,
    pub(crate) c: f64,
    pub(crate) b_v: f64,
    pub(crate) b_a: f64,
    pub(crate) d_v: f64,
    pub(crate) d_a: f64,
}

/// The same for one building: K̂ = κ K + g M, y = Δu + s D′, load = −M (l_v v + l_a a) + Δp.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(crate) struct BuildingCoefficients {
    pub(crate) stiffness_factor: f64,
    pub(crate) mass_factor: f64,
    pub(crate) shift: f64,
    pub(crate) l_v: f64,
    pub(crate) l_a: f64,
}

impl Newmark {
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
        }
    }
}

impl Coefficients {
    pub(crate) fn of_building(&self, equations: &Equations) -> BuildingCoefficients {
        let (alpha, beta) = (equations.alpha, equations.beta);
        let stiffness_factor = 1.0 + beta * self.c;
        let mass_factor = self.a + alpha * self.c;
        let shift = beta / stiffness_factor;
        let through_velocity = alpha - mass_factor * shift;
        BuildingCoefficients {
            stiffness_factor,
            mass_factor,
            shift,
            l_v: self.b_v + through_velocity * self.d_v,
            l_a: self.b_a + through_velocity * self.d_a,
        }
    }
}
