//! What a building stands on.

use super::{Foundation, Isolation};
use crate::hysteresis::Hysteresis;

/// Springs and dashpots under every column of a frame, or under a shear building as a whole. All rigid is the
/// default: the building is fixed to the ground.
///
/// These dashpots are the only damping of a base: Rayleigh damping of the building does not act on it.
///
/// ```
/// use jostle::{Base, Gravity};
///
/// // Springs under a shear building; it starts from rest under self weight, with P-Delta.
/// let base = Base { horizontal_stiffness: Some(500e6), horizontal_damping: 2e6, ..Base::default() };
/// assert!(!base.is_fixed());
/// let gravity = Gravity { preload: true, p_delta: true };
/// assert_ne!(gravity, Gravity::default());
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Default)]
pub struct Base {
    /// Moment per rotation, > 0; `None` is rigid; frames only \[N·m/rad\].
    pub rotational_stiffness: Option<f64>,
    /// Force per horizontal displacement, > 0; `None` is rigid \[N/m\].
    pub horizontal_stiffness: Option<f64>,
    /// Force per vertical displacement, > 0; `None` is rigid; frames only \[N/m\].
    pub vertical_stiffness: Option<f64>,
    /// Moment per angular velocity, ≥ 0; needs a rotational stiffness \[N·m·s/rad\].
    pub rotational_damping: f64,
    /// Force per horizontal velocity, ≥ 0; needs a horizontal stiffness \[N·s/m\].
    pub horizontal_damping: f64,
    /// Force per vertical velocity, ≥ 0; needs a vertical stiffness \[N·s/m\].
    pub vertical_damping: f64,
    /// Moment per rotation about the vertical axis, > 0; `None` is rigid; buildings with a plan only \[N·m/rad\].
    pub torsional_stiffness: Option<f64>,
    /// Moment per angular velocity about the vertical axis, ≥ 0; needs a torsional stiffness \[N·m·s/rad\].
    pub torsional_damping: f64,
    /// Springs and dashpots across the row, under a building with a plan; `None`: as those along it.
    pub across: Option<AcrossBase>,
    /// Mass of the footing, ≥ 0; moves only in directions with a spring \[kg\].
    pub mass: f64,
    /// Hysteresis of the rotational spring; its initial stiffness is `rotational_stiffness`.
    pub rotational_hinge: Option<Hysteresis>,
    /// Hysteresis of the horizontal spring; its initial stiffness is `horizontal_stiffness`.
    pub horizontal_hinge: Option<Hysteresis>,
    /// Bearings and a mat under the whole building, instead of all of the above.
    pub isolation: Option<Isolation>,
    /// Rigid foundation on the soil of the model, instead of all of the above. Of a building with a plan, assembly adds the springs and
    /// dashpots of the soil under it.
    pub foundation: Option<Foundation>,
    /// Whether the vertical springs bear compression alone, so that feet of columns lift off; needs `vertical_stiffness`.
    pub uplift: bool,
    /// Height of the base above the common datum, either sign: floors of neighbours face each other by their heights above it \[m\].
    pub elevation: f64,
}

impl Base {
    /// Whether the base is rigid.
    #[must_use]
    pub fn is_fixed(&self) -> bool {
        self.rotational_stiffness.is_none()
            && self.horizontal_stiffness.is_none()
            && self.vertical_stiffness.is_none()
            && self.torsional_stiffness.is_none()
            && self.across.is_none_or(|base| base.is_rigid())
            && self.isolation.is_none()
            && self.foundation.is_none()
    }

    /// Springs and dashpots of both horizontal directions: along the row, then across.
    #[must_use]
    pub fn in_plan(&self) -> [AcrossBase; 2] {
        let along = AcrossBase {
            horizontal_stiffness: self.horizontal_stiffness,
            horizontal_damping: self.horizontal_damping,
            rotational_stiffness: self.rotational_stiffness,
            rotational_damping: self.rotational_damping,
        };
        [along, self.across.unwrap_or(along)]
    }

    /// Mass of what carries the whole building and moves against the ground: a mat on bearings, or a footing on springs; `None` if the
    /// building stands on the ground \[kg\].
    #[must_use]
    pub fn carrying_mass(&self) -> Option<f64> {
        let carrier = self.isolation.map(|isolation| isolation.mat_mass);
        let carrier = carrier.or(self.foundation.map(|foundation| foundation.mass));
        carrier.or((!self.is_fixed()).then_some(self.mass))
    }

    /// Whether a building with a plan rocks on it.
    #[must_use]
    pub fn rocks_in_plan(&self) -> bool {
        self.in_plan()
            .iter()
            .all(|plan| plan.rotational_stiffness.is_some())
    }

    /// Whether it can lift off the ground.
    #[must_use]
    pub fn lifts(&self) -> bool {
        self.uplift
            || self
                .foundation
                .is_some_and(|foundation| foundation.uplift.is_some())
    }
}

/// Springs and dashpots of a base across the row, each with the meaning that it has in [`Base`] along it.
#[derive(Clone, Copy, Debug, PartialEq, Default)]
pub struct AcrossBase {
    /// Force per displacement across, > 0; `None` is rigid \[N/m\].
    pub horizontal_stiffness: Option<f64>,
    /// Force per velocity across, ≥ 0 \[N·s/m\].
    pub horizontal_damping: f64,
    /// Moment per rotation that moves floors across, > 0; `None` is rigid \[N·m/rad\].
    pub rotational_stiffness: Option<f64>,
    /// Moment per angular velocity of that rotation, ≥ 0 \[N·m·s/rad\].
    pub rotational_damping: f64,
}

impl AcrossBase {
    /// Whether it has no spring.
    #[must_use]
    pub fn is_rigid(&self) -> bool {
        self.horizontal_stiffness.is_none() && self.rotational_stiffness.is_none()
    }
}

/// Motion against which mass-proportional damping α acts.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Default)]
pub enum MassDamping {
    /// Relative to the foundation or mat that carries the building, if there is one: a rigid motion on it is not damped.
    #[default]
    Support,
    /// Relative to the ground, on every mass and rotary inertia.
    Ground,
}
