//! Braces and struts of frames, and foundations that lift off.

use serde::Serialize;

use crate::quantity::{Quantity, Unit};

/// A brace, a strut of an infill panel, or the ground under a foundation, which bears compression alone.
#[derive(Clone, Debug, Serialize, PartialEq)]
pub struct PartSummary {
    /// Name: `BUILDING.brace.STOREY.BAY`, with the way it rises from left to right, `up` or `down`, where two cross;
    /// `BUILDING.footing`, with the column line where every column has its own.
    pub name: String,
    /// `brace`, `infill` or `footing`.
    pub kind: &'static str,
    /// Greatest tension, zero if there is none \[N\].
    pub force_max_n: f64,
    /// Greatest compression as a negative force, zero if there is none \[N\].
    pub force_min_n: f64,
    /// Greatest elongation; of a footing the greatest rise above the ground as it was, of any contact spring, ≥ 0 \[m\].
    pub deformation_max: f64,
    /// Greatest shortening as a magnitude; of a footing its greatest sinking, ≥ 0 \[m\].
    pub deformation_min: f64,
    /// Energy dissipated \[J\].
    pub dissipated_j: f64,
    /// Of a footing: share of the run in which a contact spring bears nothing, the greatest of all springs, 0…1 \[–\].
    pub lifted_share: Option<f64>,
    /// Of a foundation: greatest force of a contact spring over the area of its strip \[Pa\].
    pub pressure_max_pa: Option<f64>,
    /// Of a footing: settlement of the ground at the end of the run, the greatest of all springs, ≥ 0 \[m\].
    pub settlement_m: Option<f64>,
}

#[rustfmt::skip]
impl PartSummary {
    /// Its numbers.
    pub const QUANTITIES: &[Quantity<Self>] = &[
        Quantity::<Self>::real("force_max_n", Unit::N, "greatest tension; of a footing 0", |p| p.force_max_n),
        Quantity::<Self>::real("force_min_n", Unit::N, "greatest compression, negative; of a footing that of a contact spring", |p| p.force_min_n),
        Quantity::<Self>::real("deformation_max", Unit::M, "greatest elongation; of a footing the greatest rise above the ground as it was", |p| p.deformation_max),
        Quantity::<Self>::real("deformation_min", Unit::M, "greatest shortening; of a footing its greatest sinking", |p| p.deformation_min),
        Quantity::<Self>::real("dissipated_j", Unit::J, "energy dissipated", |p| p.dissipated_j),
        Quantity::<Self>::optional("lifted_share", Unit::NONE, "of a footing: share of the run in which a contact spring bears nothing, the greatest of all", |p| p.lifted_share),
        Quantity::<Self>::optional("pressure_max_pa", Unit::PA, "of a foundation: greatest force of a contact spring over the area of its strip", |p| p.pressure_max_pa),
        Quantity::<Self>::optional("settlement_m", Unit::M, "of a footing: settlement of the ground at the end of the run, the greatest of all contact springs", |p| p.settlement_m),
    ];
}
