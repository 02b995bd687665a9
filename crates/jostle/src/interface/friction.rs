//! Coulomb friction at a point of a face of two buildings in space.

use super::PortPair;
use crate::contact::{ContactLaw, hertz_indentation};

/// Impact speed at whose depth a Hertz spring gives its stiffness against sliding \[m/s\].
const TYPICAL_SPEED: f64 = 0.5;
/// Stiffness against sliding over that against pressing, 2(1 − ν)/(2 − ν) for ν = 0.2 (R. D. Mindlin, 1949, J. Appl.
/// Mech. 16, 259) \[–\].
const SLIDING_OVER_PRESSING: f64 = 1.6 / 1.8;

/// Stiffness of a face against sliding while it sticks, where none is given (theory, Eq. Z14): 2(1 − ν)/(2 − ν) = 0.89
/// times that of the law; times the tangent 3/2 k √δ at the depth of an elastic impact at 0.5 m/s for laws of Hertz
/// \[N/m\].
#[must_use]
pub fn sticking_stiffness(law: &ContactLaw, effective_mass: f64) -> f64 {
    let pressing = if law.kind.is_hertzian() {
        let depth = hertz_indentation(law.stiffness, effective_mass, TYPICAL_SPEED);
        1.5 * law.stiffness * depth.sqrt()
    } else {
        law.stiffness
    };
    SLIDING_OVER_PRESSING * pressing
}

/// A floor that moves as a rigid body, as a point of a contact sees it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct PushedFloor {
    /// Lever arm of a push along the normal, (c − o) × n, and of one along the face \[m\].
    pub(crate) levers: [f64; 2],
    /// Share of the mass in W_nn and in W_nt: n·M⁻¹n and n·M⁻¹t \[1/kg\].
    pub(crate) inverse_masses: [f64; 2],
    /// Polar mass, > 0 \[kg·m²\].
    pub(crate) polar_mass: f64,
}

/// Coefficient of friction below which forces at a point are unique while it slips, W_nn/|W_nt| (theory, Eq. Z17):
/// a friction force F μ must press the floors together less than F parts them. Infinite where friction does not press
/// \[–\].
pub(crate) fn unique_below(floors: impl Iterator<Item = PushedFloor>) -> f64 {
    let (mut normal, mut mixed) = (0.0, 0.0);
    for floor in floors {
        let [across, along] = floor.levers;
        normal += floor.inverse_masses[0] + across * across / floor.polar_mass;
        mixed += floor.inverse_masses[1] + across * along / floor.polar_mass;
    }
    if mixed == 0.0 {
        return f64::INFINITY;
    }
    (normal / mixed).abs()
}

/// Friction along a face at one of its points.
#[derive(Clone, Debug, PartialEq)]
pub struct Friction {
    /// Its law.
    pub law: Coulomb,
    /// Displacement along the face, the normal turned by +90°.
    pub ports: PortPair,
    /// Coefficient below which the forces of this point are unique in any short step, W_nn/|W_nt|, > 0 \[–\].
    pub unique_below: f64,
}

/// Coulomb friction with a spring that sticks before it slips (theory, Eq. Z13).
///
/// The slip s grows as the first building moves along t against the second. The force is T = k (s − s₀) while |T| ≤ μ F.
/// Beyond that it is ±μ F, and s₀ = s − T/k follows the slip. T pushes the first building by −T t and the second by +T t.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Coulomb {
    /// Coefficient μ, at least 0 and below 1 \[–\].
    pub coefficient: f64,
    /// Stiffness k while it sticks, > 0 \[N/m\].
    pub stiffness: f64,
}

impl Coulomb {
    /// Force at a slip \[N\], and whether it sticks; from the slip s₀ without force \[m\] and the contact force \[N\].
    #[must_use]
    #[inline]
    pub fn force(&self, slip: f64, origin: f64, pressed: f64) -> (f64, bool) {
        let (bound, tried) = (
            self.coefficient * pressed.max(0.0),
            self.stiffness * (slip - origin),
        );
        if tried.abs() <= bound {
            (tried, true)
        } else {
            (bound.copysign(tried), false)
        }
    }

    /// The slip s₀ without force where a slip has a force \[m\].
    #[must_use]
    #[inline]
    pub fn origin(&self, slip: f64, force: f64) -> f64 {
        slip - force / self.stiffness
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const FRICTION: Coulomb = Coulomb {
        coefficient: 0.5,
        stiffness: 1e6,
    };

    /// A slip forth and back under a constant force: sticks, slips, sticks while it turns, slips back; the loop encloses
    /// 4 μF (s_max − μF/k).
    #[test]
    fn a_loop_dissipates_what_coulomb_says() {
        let (mut origin, mut before, mut work) = (0.0, (0.0, 0.0), 0.0);
        let mut stuck = 0;
        let n = 40_000;
        for i in 1..=2 * n {
            // Two periods; the second begins on the loop.
            let slip = 3e-3 * (4.0 * std::f64::consts::PI * f64::from(i) / f64::from(2 * n)).sin();
            let (force, sticks) = FRICTION.force(slip, origin, 1e3);
            origin = FRICTION.origin(slip, force);
            if i > n {
                work += 0.5 * (force + before.1) * (slip - before.0);
                stuck += u32::from(sticks);
            }
            before = (slip, force);
            assert!(force.abs() <= 500.0);
        }
        let expected = 4.0 * 500.0 * (3e-3 - 500.0 / 1e6);
        assert!(
            (work - expected).abs() < 1e-6 * expected,
            "{work} {expected}"
        );
        assert!(stuck > 0);
    }

    #[test]
    fn an_open_face_has_no_friction() {
        assert_eq!(FRICTION.force(1.0, 0.0, 0.0).0, 0.0);
        assert_eq!(FRICTION.force(-1.0, 0.0, -5.0).0, 0.0);
    }
}
