//! Beam–column joints.

use serde::Serialize;

use super::capacity::RatioPlace;
use crate::quantity::{Quantity, Unit};

/// Shear in the core of one joint.
#[derive(Clone, Debug, Serialize, PartialEq)]
pub struct JointSummary {
    /// `J1.joint.LINE.FLOOR`, counted from 1.
    pub name: String,
    /// Greatest shear, either sign \[N\].
    pub shear_peak_n: f64,
    /// Greatest demand over capacity by the governing rule; absent where it has none for joints.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub ratio: Option<JointRatio>,
    /// The same by every other rule.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub other_ratios: Vec<JointRatio>,
}

#[rustfmt::skip]
impl JointSummary {
    /// Its numbers.
    pub const QUANTITIES: &[Quantity<Self>] = &[
        Quantity::<Self>::real("shear_peak_n", Unit::N, "peak shear of the joint core", |j| j.shear_peak_n),
    ];
}

/// Greatest shear of a joint over its capacity by one rule.
#[derive(Clone, Debug, Serialize, PartialEq)]
pub struct JointRatio {
    /// Name of the rule, as in model files.
    pub rule: &'static str,
    /// Shear over shear capacity \[–\].
    pub shear: f64,
    /// Where and when it occurred.
    pub shear_at: RatioPlace,
}

#[rustfmt::skip]
impl JointRatio {
    /// Its numbers.
    pub const QUANTITIES: &[Quantity<Self>] = &[
        Quantity::<Self>::real("shear", Unit::NONE, "greatest ratio of shear to shear capacity under the simultaneous compression", |r| r.shear),
    ];
}
