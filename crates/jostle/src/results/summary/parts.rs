//! Braces and struts of frames.

use serde::Serialize;

use crate::quantity::{Quantity, Unit};

/// A brace, or a strut of an infill panel.
#[derive(Clone, Debug, Serialize, PartialEq)]
pub struct PartSummary {
    /// Name: `BUILDING.brace.STOREY.BAY`, with the way it rises from left to right, `up` or `down`, where two cross.
    pub name: String,
    /// `brace` or `infill`.
    pub kind: &'static str,
    /// Greatest tension, zero if there is none \[N\].
    pub force_max_n: f64,
    /// Greatest compression as a negative force, zero if there is none \[N\].
    pub force_min_n: f64,
    /// Greatest elongation, ≥ 0 \[m\].
    pub deformation_max: f64,
    /// Greatest shortening as a magnitude, ≥ 0 \[m\].
    pub deformation_min: f64,
    /// Energy dissipated \[J\].
    pub dissipated_j: f64,
}

#[rustfmt::skip]
impl PartSummary {
    /// Its numbers.
    pub const QUANTITIES: &[Quantity<Self>] = &[
        Quantity::<Self>::real("force_max_n", Unit::N, "greatest tension", |p| p.force_max_n),
        Quantity::<Self>::real("force_min_n", Unit::N, "greatest compression, negative", |p| p.force_min_n),
        Quantity::<Self>::real("deformation_max", Unit::M, "greatest elongation", |p| p.deformation_max),
        Quantity::<Self>::real("deformation_min", Unit::M, "greatest shortening", |p| p.deformation_min),
        Quantity::<Self>::real("dissipated_j", Unit::J, "energy dissipated", |p| p.dissipated_j),
    ];
}
