//! Columns that fail in shear.

use serde::Serialize;

use super::capacity::ImpactPlace;
use crate::quantity::{Quantity, Unit};

/// Columns of a building that can fail in shear, and those that did.
#[derive(Clone, Debug, Serialize, PartialEq)]
pub struct ShearFailureSummary {
    /// Number of columns that can fail.
    pub total: usize,
    /// Number of columns that failed.
    pub failed: usize,
    /// When the first one failed; `None` if none did \[s\].
    pub first_s: Option<f64>,
    /// Energy that they dissipated \[J\].
    pub dissipated_j: f64,
    /// Those that failed, in the order of time.
    pub list: Vec<ShearFailure>,
}

#[rustfmt::skip]
impl ShearFailureSummary {
    /// Its numbers.
    pub const QUANTITIES: &[Quantity<Self>] = &[
        Quantity::<Self>::whole("total", "columns that can fail in shear", |f| f.total),
        Quantity::<Self>::whole("failed", "number of these that failed", |f| f.failed).in_study(),
        Quantity::<Self>::optional("first_s", Unit::S, "time of the first failure; absent if none failed", |f| f.first_s).in_study(),
        Quantity::<Self>::real("dissipated_j", Unit::J, "energy dissipated by all of these", |f| f.dissipated_j),
    ];
}

/// A column that failed in shear.
#[derive(Clone, Debug, Serialize, PartialEq)]
pub struct ShearFailure {
    /// Name of the column: `J1.column.LINE.STOREY`, `A.FRAME.column.LINE.STOREY` or `A.column.X.Y.STOREY`.
    pub column: String,
    /// Along which lines of a space frame it failed, `x` or `y`; absent for other columns.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub along: Option<&'static str>,
    /// Where it failed: `foot` or `head`.
    pub at: &'static str,
    /// Instant of failure; 0 if self weight alone causes it \[s\].
    pub failed_s: f64,
    /// Strength when it failed, lowered by the ductility of its hinges by then \[N\].
    pub strength_n: f64,
    /// Greatest displacement in its failed section, either direction \[m\].
    pub slip_peak_m: f64,
    /// Strength left at the end over that at failure \[–\].
    pub strength_left: f64,
    /// Energy dissipated there \[J\].
    pub dissipated_j: f64,
    /// The strongest impact on the building in progress when it failed; `null` if there was none.
    pub impact: Option<ImpactPlace>,
}

#[rustfmt::skip]
impl ShearFailure {
    /// Its numbers.
    pub const QUANTITIES: &[Quantity<Self>] = &[
        Quantity::<Self>::real("failed_s", Unit::S, "time of shear failure; 0 if self weight alone causes it", |f| f.failed_s),
        Quantity::<Self>::real("strength_n", Unit::N, "shear strength at failure, reduced for the ductility of its hinges at that time", |f| f.strength_n),
        Quantity::<Self>::real("slip_peak_m", Unit::M, "peak displacement in the failed section", |f| f.slip_peak_m),
        Quantity::<Self>::real("strength_left", Unit::NONE, "ratio of strength at the end to that at failure", |f| f.strength_left),
        Quantity::<Self>::real("dissipated_j", Unit::J, "energy dissipated in the failed section", |f| f.dissipated_j),
    ];
}
