//! Springs and dashpots of the soil under the foundation of a building with a plan.

use std::f64::consts::TAU;

use super::{AcrossBase, Base, Foundation, FoundationSprings, HalfSpace, PlanPoint, Uplift};

/// Springs and dashpots under a rigid rectangle that moves in both horizontal directions, rocks both ways and turns.
///
/// ```
/// use jostle::{Foundation, HalfSpace};
///
/// let soil = HalfSpace { shear_wave_velocity: 200.0, density: 1800.0, poisson_ratio: 0.33, damping: 0.05 };
/// let mat = Foundation::rectangle(16.0, 10.0, 200e3);
/// let springs = soil.springs_in_plan(&mat, [0.6, 0.5]);
/// // It rocks along its longer side against more.
/// assert!(springs.along.rocking_stiffness > springs.across.rocking_stiffness);
/// let base = springs.base(&mat);
/// assert_eq!(base.torsional_stiffness, Some(springs.torsion[0]));
/// ```
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct PlanFoundationSprings {
    /// Sway along x, and rocking that moves floors along x.
    pub along: FoundationSprings,
    /// The same across.
    pub across: FoundationSprings,
    /// Moment per rotation and per angular velocity about the vertical axis \[N·m/rad, N·m·s/rad\].
    pub torsion: [f64; 2],
}

impl HalfSpace {
    /// Stiffness of a rigid rectangle at the surface against rotation about its vertical axis, K = G B³ (4.25 q^2.45 + 4.06) with half sides
    /// L ≥ B and q = L/B (A. Pais and E. Kausel, 1988) \[N·m/rad\].
    #[must_use]
    pub fn torsional_stiffness(&self, foundation: &Foundation) -> f64 {
        let b = 0.5 * foundation.length.min(foundation.width);
        let q = foundation.slenderness();
        self.shear_modulus() * b * b * b * (4.25 * libm::pow(q, 2.45) + 4.06)
    }

    /// Springs and dashpots of a foundation whose building sways along x and across with these periods, > 0 \[s\]. In torsion the spring is
    /// that at rest at the surface, and the dashpot what the soil dissipates itself at the shorter period, unless the foundation has its
    /// own.
    #[must_use]
    pub fn springs_in_plan(
        &self,
        foundation: &Foundation,
        [along, across]: [f64; 2],
    ) -> PlanFoundationSprings {
        let stiffness = foundation
            .torsional_stiffness
            .unwrap_or_else(|| self.torsional_stiffness(foundation));
        let omega = TAU / along.min(across);
        let damping = foundation
            .torsional_damping
            .unwrap_or(2.0 * self.damping * stiffness / omega);
        PlanFoundationSprings {
            along: self.springs(foundation, along),
            across: self.springs(&foundation.turned(), across),
            torsion: [stiffness, damping],
        }
    }
}

impl PlanFoundationSprings {
    /// A base with these springs under the foundation; a stiffness of zero in sway or torsion holds it. It rises if the foundation can lift
    /// off.
    #[must_use]
    pub fn base(&self, foundation: &Foundation) -> Base {
        let or_held = |stiffness: f64| Some(stiffness).filter(|stiffness| *stiffness > 0.0);
        let [along, across] = [&self.along, &self.across].map(|springs| AcrossBase {
            horizontal_stiffness: or_held(springs.sway_stiffness),
            horizontal_damping: springs.sway_damping,
            rotational_stiffness: Some(springs.rocking_stiffness),
            rotational_damping: springs.rocking_damping,
        });
        let [torsional_stiffness, torsional_damping] = self.torsion;
        Base {
            horizontal_stiffness: along.horizontal_stiffness,
            horizontal_damping: along.horizontal_damping,
            rotational_stiffness: along.rotational_stiffness,
            rotational_damping: along.rotational_damping,
            across: Some(across),
            vertical_stiffness: foundation.uplift.map(|_| self.along.vertical_stiffness),
            vertical_damping: match foundation.uplift {
                Some(_) => self.along.vertical_damping,
                None => 0.0,
            },
            torsional_stiffness: or_held(torsional_stiffness),
            torsional_damping,
            foundation: Some(*foundation),
            ..Base::default()
        }
    }
}

impl Foundation {
    /// The same foundation seen along its width: length and width, and numbers of contact springs, exchanged, with the rotary inertia of
    /// a thin plate.
    #[must_use]
    pub fn turned(&self) -> Self {
        Self {
            length: self.width,
            width: self.length,
            rotary_inertia: self.mass * self.width * self.width / 12.0,
            uplift: self.uplift.map(|uplift| Uplift {
                springs: uplift.springs_across.unwrap_or(uplift.springs),
                springs_across: Some(uplift.springs),
                ..uplift
            }),
            ..*self
        }
    }

    /// Its corners, counter-clockwise, about a point of the site \[m\].
    #[must_use]
    pub fn corners(&self, [x, y]: PlanPoint) -> Vec<PlanPoint> {
        let (a, b) = (0.5 * self.length, 0.5 * self.width);
        vec![
            [x - a, y - b],
            [x + a, y - b],
            [x + a, y + b],
            [x - a, y + b],
        ]
    }
}
