//! Demand over capacity of members.

use serde::Serialize;

use crate::quantity::{Quantity, Unit};

/// Greatest demand over capacity of a member by one rule.
#[derive(Clone, Debug, Serialize, PartialEq)]
pub struct RatioSummary {
    /// Name of the rule, as in model files.
    pub rule: &'static str,
    /// Shear over shear capacity, of a column of a space frame the vector of both shears; `null` where the rule has none \[–\].
    pub shear: Option<f64>,
    /// Moment over moment capacity under the axial force of the same instant, of a column of a space frame the vector of both
    /// moments \[–\].
    pub bending: f64,
    /// Where and when the greatest ratio of shear occurred.
    pub shear_at: Option<RatioPlace>,
    /// Where and when the greatest ratio of bending occurred.
    pub bending_at: RatioPlace,
}

#[rustfmt::skip]
impl RatioSummary {
    /// Its numbers.
    pub const QUANTITIES: &[Quantity<Self>] = &[
        Quantity::<Self>::optional("shear", Unit::NONE, "greatest ratio of shear to shear capacity; absent if the rule has none", |r| r.shear),
        Quantity::<Self>::real("bending", Unit::NONE, "greatest ratio of moment to moment capacity under the simultaneous axial force", |r| r.bending),
    ];
}

/// Where and when a ratio was greatest.
#[derive(Clone, Debug, Serialize, PartialEq)]
pub struct RatioPlace {
    /// `foot`, `head`, `left`, `right`; `below` or `above` a struck point.
    pub at: &'static str,
    /// Height above the base \[m\].
    pub height_m: f64,
    /// Instant \[s\].
    pub at_s: f64,
    /// Shear \[N\] or moment \[N·m\] then, with its sign.
    pub demand: f64,
    /// The same in the plane across, of a column of a space frame; absent for others.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub demand_across: Option<f64>,
    /// Capacity then, in the same unit; of demands in two planes, in the direction of both together.
    pub capacity: f64,
    /// Axial compression then, negative in tension \[N\].
    pub compression_n: f64,
    /// First instant at which the demand exceeded the capacity anywhere in the member; `null` if it did not \[s\].
    pub exceeded_s: Option<f64>,
    /// Impact on the building during which the ratio was greatest; `null` if none was in progress.
    pub impact: Option<ImpactPlace>,
}

#[rustfmt::skip]
impl RatioPlace {
    /// Its numbers.
    pub const QUANTITIES: &[Quantity<Self>] = &[
        Quantity::<Self>::real("height_m", Unit::M, "height above the base of the section with the greatest ratio", |p| p.height_m),
        Quantity::<Self>::real("at_s", Unit::S, "time of the greatest ratio", |p| p.at_s),
        Quantity::<Self>::real("demand", Unit::NM_OR_N, "moment or shear at this time, with its sign", |p| p.demand),
        Quantity::<Self>::optional("demand_across", Unit::NM_OR_N, "moment or shear in the plane across at this time, for a column of a space frame", |p| p.demand_across),
        Quantity::<Self>::real("capacity", Unit::NM_OR_N, "capacity at this time; for demands in two planes, in the direction of their resultant", |p| p.capacity),
        Quantity::<Self>::real("compression_n", Unit::N, "axial compression at this time, negative in tension", |p| p.compression_n),
        Quantity::<Self>::optional("exceeded_s", Unit::S, "time at which the member first exceeds its capacity; absent if it never does", |p| p.exceeded_s),
    ];
}

/// An impact, as a place and an instant.
#[derive(Clone, Debug, Serialize, PartialEq)]
pub struct ImpactPlace {
    /// Names of the left and the right building; `wall` is a rigid wall.
    pub between: [String; 2],
    /// Left and right floor, from 1; `null` for a point between floors, and for a wall.
    pub floors: [Option<usize>; 2],
    /// Height above the base \[m\].
    pub height_m: f64,
    /// Instant of first contact \[s\].
    pub start_s: f64,
    /// Whether it strikes the member itself between its ends; `null` where no member is meant, or its forces are not followed.
    pub on_member: Option<bool>,
}

/// Greatest rotation of the ends of a member against the limits of a rule.
#[derive(Clone, Debug, Serialize, PartialEq)]
pub struct AcceptanceSummary {
    /// Name of the rule: `en1998-3`, `asce41`, or `section` for crushing of the section.
    pub rule: &'static str,
    /// `plastic`: beyond yield of the hinge; `chord`: of hinge and member together.
    pub measure: &'static str,
    /// Greatest rotation of both ends, either sign \[rad\].
    pub rotation_rad: f64,
    /// The end: `foot`, `head`, `left` or `right`.
    pub at: &'static str,
    /// Levels in rising order, with the greatest rotation of each.
    pub limits: Vec<LevelSummary>,
    /// The lowest level whose limit is kept; `null` beyond all of them.
    pub level: Option<&'static str>,
}

#[rustfmt::skip]
impl AcceptanceSummary {
    /// Its numbers.
    pub const QUANTITIES: &[Quantity<Self>] = &[
        Quantity::<Self>::real("rotation_rad", Unit::RAD, "peak rotation of either end", |a| a.rotation_rad),
    ];
}

/// A level of performance and its greatest rotation.
#[derive(Clone, Copy, Debug, Serialize, PartialEq)]
pub struct LevelSummary {
    /// `IO`, `LS`, `CP`; `DL`, `SD`, `NC`; `crushing`.
    pub level: &'static str,
    /// Greatest rotation \[rad\].
    pub rotation_rad: f64,
}

/// Drift at axial failure of a column after shear failure.
#[derive(Clone, Copy, Debug, Serialize, PartialEq)]
pub struct AxialFailureSummary {
    /// Drift ratio at axial failure under the greatest compression of the run \[–\].
    pub drift: f64,
    /// Greatest compression of the run \[N\].
    pub compression_n: f64,
    /// Greatest drift ratio of the storey over it \[–\].
    pub ratio: f64,
}

#[rustfmt::skip]
impl AxialFailureSummary {
    /// Its numbers.
    pub const QUANTITIES: &[Quantity<Self>] = &[
        Quantity::<Self>::real("drift", Unit::NONE, "drift ratio at axial failure under the greatest compression", |a| a.drift),
        Quantity::<Self>::real("compression_n", Unit::N, "greatest compression", |a| a.compression_n),
        Quantity::<Self>::real("ratio", Unit::NONE, "ratio of the peak drift ratio of the storey to the drift at axial failure", |a| a.ratio),
    ];
}

/// Members of a building beyond their capacity by the governing rule.
#[derive(Clone, Debug, Serialize, PartialEq)]
pub struct CapacitySummary {
    /// Name of the governing rule.
    pub rule: &'static str,
    /// Number of members with a known capacity.
    pub rated: usize,
    /// Number of members beyond it, in shear or in bending.
    pub exceeded: usize,
    /// Those of them beyond it in shear, which do not just yield in bending.
    pub exceeded_in_shear: usize,
    /// The first member beyond its capacity; `null` if there is none.
    pub first: Option<ExceededSummary>,
    /// The member with the greatest ratio.
    pub worst: ExceededSummary,
    /// Number of beam–column joints with a known capacity by the governing rule.
    pub joints_rated: usize,
    /// Number of joints beyond it.
    pub joints_exceeded: usize,
    /// The first joint beyond its capacity; `null` if there is none.
    pub first_joint: Option<ExceededSummary>,
}

#[rustfmt::skip]
impl CapacitySummary {
    /// Its numbers.
    pub const QUANTITIES: &[Quantity<Self>] = &[
        Quantity::<Self>::whole("rated", "members with a known capacity", |c| c.rated),
        Quantity::<Self>::whole("exceeded", "members that exceed their capacity, in shear or in bending", |c| c.exceeded).in_study(),
        Quantity::<Self>::whole("exceeded_in_shear", "members that exceed their capacity in shear", |c| c.exceeded_in_shear).in_study(),
        Quantity::<Self>::whole("joints_rated", "joints with a known capacity", |c| c.joints_rated),
        Quantity::<Self>::whole("joints_exceeded", "joints that exceed their shear capacity", |c| c.joints_exceeded).in_study(),
        Quantity::<Self>::real("ratio", Unit::NONE, "greatest ratio of demand to capacity of any member", |c| c.worst.ratio).not_in_summary().in_study(),
        Quantity::<Self>::optional("first_s", Unit::S, "time at which a member first exceeds its capacity; absent if none does", |c| c.first.as_ref().map(|first| first.at_s)).not_in_summary().in_study(),
    ];
}

/// A member beyond its capacity, or nearest to it.
#[derive(Clone, Debug, Serialize, PartialEq)]
pub struct ExceededSummary {
    /// Name of the member.
    pub member: String,
    /// `shear` or `bending`; of a joint `shear`.
    pub kind: &'static str,
    /// Section of the member.
    pub at: &'static str,
    /// Instant: of the first excess, or of the greatest ratio \[s\].
    pub at_s: f64,
    /// Greatest ratio there \[–\].
    pub ratio: f64,
    /// Impact on the building in progress at the instant; `null` if there was none.
    pub impact: Option<ImpactPlace>,
}

#[rustfmt::skip]
impl ExceededSummary {
    /// Its numbers.
    pub const QUANTITIES: &[Quantity<Self>] = &[
        Quantity::<Self>::real("at_s", Unit::S, "time of the greatest ratio, or of the first exceedance", |e| e.at_s),
        Quantity::<Self>::real("ratio", Unit::NONE, "greatest ratio of demand to capacity there", |e| e.ratio),
    ];
}
