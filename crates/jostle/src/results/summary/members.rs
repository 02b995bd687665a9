//! Columns and beams.

use serde::Serialize;

use super::capacity::{AcceptanceSummary, AxialFailureSummary, RatioSummary};
use crate::quantity::{Quantity, Unit};
use crate::structure::MemberPlace;

/// Greatest forces of one column or beam.
#[derive(Clone, Debug, Default, Serialize, PartialEq)]
pub struct MemberSummary {
    /// `J1.column.LINE.STOREY` or `J1.beam.FLOOR.SPAN`, counted from 1; `J1.FRAME.column.LINE.STOREY` and so on where frames
    /// stand in a plan; `J1.column.X.Y.STOREY`, `J1.beam_x.FLOOR.X.Y` and `J1.beam_y.FLOOR.X.Y` in a space frame.
    pub name: String,
    /// Where it is in its building.
    #[serde(skip)]
    pub place: Option<MemberPlace>,
    /// Number of its frame, from 0, where several stand in a plan.
    #[serde(skip)]
    pub frame: Option<usize>,
    /// Name of the column that two frames share, whose axial forces are those of both frames together; absent for others.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub shared_column: Option<String>,
    /// Foot and head of a column, left and right end of a beam.
    pub ends: Vec<SectionSummary>,
    /// Points of a column between its ends where a neighbour can strike it, from the lowest up.
    pub struck: Vec<StruckSummary>,
    /// Its greatest forces with contact, without, and their ratios; absent where there was no run without contact.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub compared: Option<MemberComparison>,
    /// Forces of both ends, then below and above every struck point, when the building had its greatest ratio of demand to
    /// capacity (`capacity.worst.at_s` of the building, or the end of that step); empty where no capacity is known.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub at_worst: Vec<ForcesSummary>,
    /// Greatest demand over capacity by the governing rule; absent where the capacity is unknown.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub ratio: Option<RatioSummary>,
    /// The same by every other rule.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub other_ratios: Vec<RatioSummary>,
    /// Rotations of yielding ends against the limits of codes; empty where hinges or limits are unknown.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub acceptance: Vec<AcceptanceSummary>,
    /// Drift at which a column that failed in shear would lose its axial load; absent if unknown.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub axial_failure: Option<AxialFailureSummary>,
}

impl MemberSummary {
    /// Greatest contact force on its struck points; 0 without an impact \[N\].
    #[must_use]
    pub fn struck_force_n(&self) -> f64 {
        let forces = self.struck.iter().map(|point| point.peak_force_n);
        forces.fold(0.0, f64::max)
    }

    /// Greatest ratio of demand to capacity, in bending or shear; `None` where no capacity is known \[–\].
    #[must_use]
    pub fn greatest_ratio(&self) -> Option<f64> {
        let ratio = self.ratio.as_ref()?;
        Some(ratio.bending.max(ratio.shear.unwrap_or(0.0)))
    }
}

/// Greatest forces of a member over all its sections, with and without contact.
#[derive(Clone, Copy, Debug, Serialize, PartialEq)]
pub struct MemberComparison {
    /// Greatest compression with contact; 0 if it was always in tension \[N\].
    pub compression_peak_n: f64,
    /// Greatest shear with contact, either sign \[N\].
    pub shear_peak_n: f64,
    /// Greatest moment with contact, either sign \[N·m\].
    pub moment_peak_n_m: f64,
    /// The same without contact \[N\].
    pub compression_peak_without_contact_n: f64,
    /// The same without contact \[N\].
    pub shear_peak_without_contact_n: f64,
    /// The same without contact \[N·m\].
    pub moment_peak_without_contact_n_m: f64,
    /// Shear with contact over that without; `null` where the latter is zero \[–\].
    pub shear_amplification: Option<f64>,
    /// The same of moments \[–\].
    pub moment_amplification: Option<f64>,
}

#[rustfmt::skip]
impl MemberComparison {
    /// Its numbers.
    pub const QUANTITIES: &[Quantity<Self>] = &[
        Quantity::<Self>::real("compression_peak_n", Unit::N, "peak compression with contact", |m| m.compression_peak_n),
        Quantity::<Self>::real("shear_peak_n", Unit::N, "peak shear with contact", |m| m.shear_peak_n),
        Quantity::<Self>::real("moment_peak_n_m", Unit::NM, "peak moment with contact", |m| m.moment_peak_n_m),
        Quantity::<Self>::real("compression_peak_without_contact_n", Unit::N, "peak compression without contact", |m| m.compression_peak_without_contact_n),
        Quantity::<Self>::real("shear_peak_without_contact_n", Unit::N, "peak shear without contact", |m| m.shear_peak_without_contact_n),
        Quantity::<Self>::real("moment_peak_without_contact_n_m", Unit::NM, "peak moment without contact", |m| m.moment_peak_without_contact_n_m),
        Quantity::<Self>::optional("shear_amplification", Unit::NONE, "ratio of peak shear with contact to that without", |m| m.shear_amplification),
        Quantity::<Self>::optional("moment_amplification", Unit::NONE, "ratio of peak moment with contact to that without", |m| m.moment_amplification),
    ];
}

/// Forces at one section of a member at an instant.
#[derive(Clone, Copy, Debug, Serialize, PartialEq)]
pub struct ForcesSummary {
    /// `foot`, `head`, `left`, `right`, `below` or `above`.
    pub at: &'static str,
    /// Height above the base \[m\].
    pub height_m: f64,
    /// Axial force, positive in tension \[N\].
    pub axial_n: f64,
    /// Shear, with its sign \[N\].
    pub shear_n: f64,
    /// Moment, with its sign \[N·m\].
    pub moment_n_m: f64,
    /// Shear in the plane across, of a member of a space frame; absent for others \[N\].
    #[serde(skip_serializing_if = "Option::is_none")]
    pub shear_across_n: Option<f64>,
    /// Moment in the plane across, likewise \[N·m\].
    #[serde(skip_serializing_if = "Option::is_none")]
    pub moment_across_n_m: Option<f64>,
}

#[rustfmt::skip]
impl ForcesSummary {
    /// Its numbers.
    pub const QUANTITIES: &[Quantity<Self>] = &[
        Quantity::<Self>::real("height_m", Unit::M, "height above the base", |f| f.height_m),
        Quantity::<Self>::real("axial_n", Unit::N, "axial force, positive in tension", |f| f.axial_n),
        Quantity::<Self>::real("shear_n", Unit::N, "shear, with its sign", |f| f.shear_n),
        Quantity::<Self>::real("moment_n_m", Unit::NM, "moment, with its sign", |f| f.moment_n_m),
        Quantity::<Self>::optional("shear_across_n", Unit::N, "shear in the plane across, for a member of a space frame", |f| f.shear_across_n),
        Quantity::<Self>::optional("moment_across_n_m", Unit::NM, "moment in the plane across, for a member of a space frame", |f| f.moment_across_n_m),
    ];
}

/// Greatest forces at one section of a member.
#[derive(Clone, Copy, Debug, Default, Serialize, PartialEq)]
pub struct SectionSummary {
    /// `foot`, `head`, `left`, `right`, `below` or `above`.
    pub at: &'static str,
    /// Greatest axial force, positive in tension \[N\].
    pub axial_max_n: f64,
    /// Least axial force, negative in compression \[N\].
    pub axial_min_n: f64,
    /// Greatest shear, either sign \[N\].
    pub shear_peak_n: f64,
    /// Greatest moment, either sign \[N·m\].
    pub moment_peak_n_m: f64,
    /// Forces across, of a member of a space frame.
    #[serde(flatten)]
    pub across: Option<AcrossSummary>,
}

/// Greatest forces at a section of a member of a space frame, beside those in its first plane.
#[derive(Clone, Copy, Debug, Serialize, PartialEq)]
pub struct AcrossSummary {
    /// Greatest shear in the plane across, either sign \[N\].
    pub shear_across_peak_n: f64,
    /// Greatest moment in the plane across, either sign \[N·m\].
    pub moment_across_peak_n_m: f64,
    /// Greatest torque, either sign \[N·m\].
    pub torque_peak_n_m: f64,
}

#[rustfmt::skip]
impl AcrossSummary {
    /// Its numbers.
    pub const QUANTITIES: &[Quantity<Self>] = &[
        Quantity::<Self>::real("shear_across_peak_n", Unit::N, "greatest shear in the plane across", |s| s.shear_across_peak_n),
        Quantity::<Self>::real("moment_across_peak_n_m", Unit::NM, "greatest moment in the plane across", |s| s.moment_across_peak_n_m),
        Quantity::<Self>::real("torque_peak_n_m", Unit::NM, "greatest torque", |s| s.torque_peak_n_m),
    ];
}

#[rustfmt::skip]
impl SectionSummary {
    /// Its numbers.
    pub const QUANTITIES: &[Quantity<Self>] = &[
        Quantity::<Self>::real("axial_max_n", Unit::N, "greatest axial force, positive in tension", |s| s.axial_max_n),
        Quantity::<Self>::real("axial_min_n", Unit::N, "smallest axial force, negative in compression", |s| s.axial_min_n),
        Quantity::<Self>::real("shear_peak_n", Unit::N, "greatest shear", |s| s.shear_peak_n),
        Quantity::<Self>::real("moment_peak_n_m", Unit::NM, "greatest moment", |s| s.moment_peak_n_m),
    ];
}

/// A point of a column between its ends where a neighbour can strike it.
#[derive(Clone, Copy, Debug, Serialize, PartialEq)]
pub struct StruckSummary {
    /// Height above the base \[m\].
    pub height_m: f64,
    /// Number of impacts on it.
    pub impact_count: usize,
    /// Greatest contact force on it \[N\].
    pub peak_force_n: f64,
    /// Just below the point.
    pub below: SectionSummary,
    /// Just above it.
    pub above: SectionSummary,
}

#[rustfmt::skip]
impl StruckSummary {
    /// Its numbers.
    pub const QUANTITIES: &[Quantity<Self>] = &[
        Quantity::<Self>::real("height_m", Unit::M, "height above the base", |s| s.height_m),
        Quantity::<Self>::whole("impact_count", "number of impacts on the point", |s| s.impact_count),
        Quantity::<Self>::real("peak_force_n", Unit::N, "greatest contact force on the point", |s| s.peak_force_n),
    ];
}
