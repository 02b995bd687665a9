//! Hinges.

use serde::Serialize;

use crate::quantity::{Quantity, Unit};
use crate::structure::SpringPlace;

/// Numbers of hinges, or storeys of a shear building, beyond the elastic range, and their peaks.
#[derive(Clone, Debug, Default, Serialize, PartialEq)]
pub struct HingeSummary {
    /// Total number.
    pub total: usize,
    /// Cracked or beyond.
    pub cracked: usize,
    /// Whether none of them can crack before it yields; `cracked` then counts those that yielded.
    #[serde(skip)]
    pub without_cracking: bool,
    /// Yielded.
    pub yielded: usize,
    /// When the first one yielded; `None` if none did \[s\].
    pub first_yield_s: Option<f64>,
    /// Greatest ductility of any of them that is no brace \[–\].
    pub ductility: f64,
    /// Energy that they dissipated \[J\].
    pub dissipated_j: f64,
    /// Those that left the elastic range, in the order in which they yielded, then as they cracked.
    pub list: Vec<SpringSummary>,
}

#[rustfmt::skip]
impl HingeSummary {
    /// Its numbers.
    pub const QUANTITIES: &[Quantity<Self>] = &[
        Quantity::<Self>::whole("total", "hinges and springs that can crack or yield", |h| h.total),
        Quantity::<Self>::whole("cracked", "number of these that cracked", |h| h.cracked),
        Quantity::<Self>::whole("yielded", "number of these that yielded", |h| h.yielded),
        Quantity::<Self>::optional("first_yield_s", Unit::S, "time of first yield", |h| h.first_yield_s),
        Quantity::<Self>::real("ductility", Unit::NONE, "greatest ductility of any of these, braces left out", |h| h.ductility),
        Quantity::<Self>::real("dissipated_j", Unit::J, "energy dissipated by all of these", |h| h.dissipated_j),
    ];
}

/// One hinge, or one storey of a shear building.
#[derive(Clone, Debug, Serialize, PartialEq)]
pub struct SpringSummary {
    /// Position as text.
    pub place: String,
    /// The same; `None` for what has none.
    #[serde(skip)]
    pub at: Option<SpringPlace>,
    /// Number among the springs of the building that can yield, from 0.
    pub index: usize,
    /// Time of cracking; 0 if self weight alone causes it \[s\].
    pub cracked_s: Option<f64>,
    /// Time of yielding; 0 if self weight alone causes it \[s\].
    pub yielded_s: Option<f64>,
    /// Greatest deformation of the positive side (tension at the bottom of a beam, on the right side of a column),
    /// ≥ 0 \[rad; m for storeys\].
    pub deformation_max: f64,
    /// Greatest deformation of the negative side, ≥ 0 \[rad; m for storeys\].
    pub deformation_min: f64,
    /// Greatest rotation of the member end over that at yield: of the hinge and of the member bent in double
    /// curvature together; for storeys the greatest deformation over that of yield \[–\].
    pub ductility: f64,
    /// Greatest force, either sign \[N·m; N for storeys\].
    pub peak_force: f64,
    /// Energy dissipated \[J\].
    pub dissipated_j: f64,
}

impl SpringSummary {
    /// Whether it is a brace.
    #[must_use]
    pub fn is_brace(&self) -> bool {
        self.at.as_ref().is_some_and(SpringPlace::is_brace)
    }
}

#[rustfmt::skip]
impl SpringSummary {
    /// Its numbers.
    pub const QUANTITIES: &[Quantity<Self>] = &[
        Quantity::<Self>::whole("index", "index among the hinges of the building, from 0", |s| s.index).not_in_table(),
        Quantity::<Self>::optional("cracked_s", Unit::S, "time of cracking; 0 if self weight alone causes it", |s| s.cracked_s),
        Quantity::<Self>::optional("yielded_s", Unit::S, "time of yielding; 0 if self weight alone causes it", |s| s.yielded_s),
        Quantity::<Self>::real("deformation_max", Unit::RAD_OR_M, "greatest deformation in the positive direction", |s| s.deformation_max),
        Quantity::<Self>::real("deformation_min", Unit::RAD_OR_M, "greatest deformation in the negative direction, as a magnitude", |s| s.deformation_min),
        Quantity::<Self>::real("ductility", Unit::NONE, "ratio of peak rotation of the member end to yield rotation; for storeys, of peak to yield deformation", |s| s.ductility),
        Quantity::<Self>::real("peak_force", Unit::NM_OR_N, "peak moment; for storeys, peak shear", |s| s.peak_force),
        Quantity::<Self>::real("dissipated_j", Unit::J, "energy dissipated", |s| s.dissipated_j),
    ];
}
