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
    /// Mass of the footing, ≥ 0; moves only in directions with a spring \[kg\].
    pub mass: f64,
    /// Hysteresis of the rotational spring; its initial stiffness is `rotational_stiffness`.
    pub rotational_hinge: Option<Hysteresis>,
    /// Hysteresis of the horizontal spring; its initial stiffness is `horizontal_stiffness`.
    pub horizontal_hinge: Option<Hysteresis>,
    /// Bearings and a mat under the whole building, instead of all of the above.
    pub isolation: Option<Isolation>,
    /// Rigid foundation on the soil of the model, instead of all of the above.
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
            && self.isolation.is_none()
            && self.foundation.is_none()
    }

    /// Whether it can lift off the ground.
    #[must_use]
    pub fn lifts(&self) -> bool {
        self.uplift || self.foundation.is_some_and(|own| own.uplift.is_some())
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
