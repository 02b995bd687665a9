//! The numbers of a run in the shape of `summary.json`: names carry their units. Every part lists its numbers below it, one line
//! each.

use serde::Serialize;

use super::contact_sensitivity::ContactSensitivity;
use super::floor_spectra::FloorSpectra;
use super::in_plan::{BuildingInPlan, FloorInPlan, PlanContactSummary};
use super::response::{Amplification, BuildingResponse, FloorResponse};
use crate::quantity::{Quantity, Unit};

/// Results of a run without histories.
///
/// ```
/// use std::ops::ControlFlow;
///
/// use jostle::{Run, Settings, Summary, simulate};
/// # mod towers { include!(concat!(env!("CARGO_MANIFEST_DIR"), "/examples/two_towers/pair.rs")); }
/// # let model = towers::pair(0.02);
/// # let wave = (0..=300).map(|i| 3.0 * (0.09 * f64::from(i)).sin()).collect();
/// # let motion = jostle::GroundMotion::sampled("sine", 0.01, wave);
/// # let system = jostle::System::assemble(&model).map_err(|faults| faults[0].clone())?;
/// # let plan = jostle::Plan::choose(&system, &motion, &model.analysis).map_err(|faults| faults[0].clone())?;
///
/// let outcome = simulate(&system, &motion, &plan, Settings::default(), |_| ControlFlow::Continue(()));
/// let summary = Summary::new(&Run {
///     model: &model,
///     system: &system,
///     motion: &motion,
///     plan: &plan,
///     outcome: &outcome,
///     without_contact: None,
///     wall: 0.0,
/// });
/// let roof = &summary.buildings[0].floors[2].response;
/// assert!(roof.displacement_max_m > 0.0 && roof.storey_shear_peak_n > 0.0);
/// assert!(summary.promise.met == Some(true));
/// # Ok::<(), jostle::ModelFault>(())
/// ```
#[derive(Clone, Debug, Serialize, PartialEq)]
pub struct Summary {
    /// Title of the model.
    pub title: String,
    /// Version of jostle.
    pub jostle: String,
    /// Ground motion.
    pub motion: MotionSummary,
    /// Buildings from left to right.
    pub buildings: Vec<BuildingSummary>,
    /// Gaps, in the order of the model.
    pub gaps: Vec<GapSummary>,
    /// Links, in the order of the model.
    pub links: Vec<LinkSummary>,
    /// Energies at the end.
    pub energy: EnergySummary,
    /// Whether the errors of reported peaks are within the tolerance.
    pub promise: PromiseSummary,
    /// How results depend on the contact; absent unless asked for.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub contact_sensitivity: Option<ContactSensitivity>,
    /// Response spectra of floors; absent unless asked for.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub floor_spectra: Option<FloorSpectra>,
    /// Work done.
    pub work: WorkSummary,
    /// Reason if the run did not reach the end of the motion.
    pub ended_early: Option<String>,
    /// Warnings about the results.
    pub warnings: Vec<String>,
    /// Notes on the results.
    pub notes: Vec<String>,
}

#[rustfmt::skip]
impl Summary {
    /// Numbers of all gaps together; none if there is no gap.
    pub const POUNDING: &[Quantity<Self>] = &[
        Quantity::<Self>::whole("impact_count", "impacts of all gaps", |s| s.gaps.iter().map(|gap| gap.impact_count).sum()).not_in_summary().in_study(),
        Quantity::<Self>::real("peak_force_n", Unit::N, "greatest force of any contact", |s| s.gaps.iter().map(|gap| gap.peak_force_n).fold(0.0, f64::max)).not_in_summary().in_study(),
        Quantity::<Self>::optional("first_impact_s", Unit::S, "instant of the first impact", |s| s.gaps.iter().filter_map(|gap| gap.first_impact_s).min_by(f64::total_cmp)).not_in_summary().in_study(),
        Quantity::<Self>::real("impulse_n_s", Unit::NS, "time integral of all contact forces", |s| s.gaps.iter().fold(0.0, |sum, gap| sum + gap.impulse_n_s())).not_in_summary().in_study(),
        Quantity::<Self>::real("closing_peak_m", Unit::M, "greatest closing of any contact", |s| s.gaps.iter().map(GapSummary::closing_peak_m).fold(0.0, f64::max)).not_in_summary().in_study(),
    ];
}

/// Ground motion as used.
#[derive(Clone, Debug, Serialize, PartialEq)]
pub struct MotionSummary {
    /// Name.
    pub name: String,
    /// Points of the record; 0 for analytic waves.
    pub points: usize,
    /// Sampling step; 0 for analytic waves \[s\].
    pub step_s: f64,
    /// Peak as used \[m/s²\].
    pub pga_m_s2: f64,
    /// Factor on the record, negative when reversed \[–\].
    pub scale: f64,
    /// Length of the analysis \[s\].
    pub duration_s: f64,
}

#[rustfmt::skip]
impl MotionSummary {
    /// Its numbers.
    pub const QUANTITIES: &[Quantity<Self>] = &[
        Quantity::<Self>::whole("points", "values of the record; 0 for analytic waves", |m| m.points),
        Quantity::<Self>::real("step_s", Unit::S, "time step of the record; 0 for analytic waves", |m| m.step_s),
        Quantity::<Self>::real("pga_m_s2", Unit::M_S2, "peak ground acceleration, after scaling", |m| m.pga_m_s2).in_study(),
        Quantity::<Self>::real("scale", Unit::NONE, "factor on the record, negative if reversed", |m| m.scale),
        Quantity::<Self>::real("duration_s", Unit::S, "length of the analysis", |m| m.duration_s),
    ];
}

/// One building.
#[derive(Clone, Debug, Default, Serialize, PartialEq)]
pub struct BuildingSummary {
    /// Name.
    pub name: String,
    /// Vibrating mass \[kg\].
    pub mass_kg: f64,
    /// Periods of the lateral modes (at least 1 % of the horizontal effective mass), longest first \[s\].
    pub periods_s: Vec<f64>,
    /// Rayleigh damping in use: mass coefficient \[1/s\].
    pub rayleigh_alpha_per_s: f64,
    /// Rayleigh damping in use: stiffness coefficient \[s\].
    pub rayleigh_beta_s: f64,
    /// Floors from the ground up.
    pub floors: Vec<FloorSummary>,
    /// Its peaks, and what is left at the end.
    #[serde(flatten)]
    pub response: BuildingResponse,
    /// Peaks across the row and in torsion; absent in one plane.
    #[serde(flatten)]
    pub in_plan: Option<BuildingInPlan>,
    /// The same in the run without contact, if it exists.
    pub without_contact: Option<BuildingResponse>,
    /// The former over the latter, if that run exists.
    pub amplification: Option<Amplification>,
    /// Hinge counts.
    pub hinges: HingeSummary,
    /// Columns and beams, storey by storey from the ground up, columns first; absent unless asked for.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub members: Vec<MemberSummary>,
    /// Members beyond their capacity; absent unless capacities are known.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub capacity: Option<CapacitySummary>,
}

#[rustfmt::skip]
impl BuildingSummary {
    /// Numbers that do not depend on the motion.
    pub const QUANTITIES: &[Quantity<Self>] = &[
        Quantity::<Self>::real("mass_kg", Unit::KG, "vibrating mass", |b| b.mass_kg),
        Quantity::<Self>::optional("period_s", Unit::S, "period of the first lateral mode", |b| b.periods_s.first().copied()).not_in_summary().in_study(),
        Quantity::<Self>::real("rayleigh_alpha_per_s", Unit::PER_S, "Rayleigh damping: coefficient of the mass", |b| b.rayleigh_alpha_per_s),
        Quantity::<Self>::real("rayleigh_beta_s", Unit::S, "Rayleigh damping: coefficient of the stiffness", |b| b.rayleigh_beta_s),
    ];
}

/// Greatest forces of one column or beam.
#[derive(Clone, Debug, Serialize, PartialEq)]
pub struct MemberSummary {
    /// `J1.column.LINE.STOREY` or `J1.beam.FLOOR.SPAN`, counted from 1.
    pub name: String,
    /// Foot and head of a column, left and right end of a beam.
    pub ends: Vec<SectionSummary>,
    /// Points of a column between its ends where a neighbour can strike it, from the lowest up.
    pub struck: Vec<StruckSummary>,
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
}

/// Greatest demand over capacity of a member by one rule.
#[derive(Clone, Debug, Serialize, PartialEq)]
pub struct RatioSummary {
    /// Name of the rule, as in model files.
    pub rule: &'static str,
    /// Shear over shear capacity; `null` where the rule has none \[–\].
    pub shear: Option<f64>,
    /// Moment over moment capacity under the axial force of the same instant \[–\].
    pub bending: f64,
    /// Where and when the greatest ratio of shear occurred.
    pub shear_at: Option<RatioPlace>,
    /// Where and when the greatest ratio of bending occurred.
    pub bending_at: RatioPlace,
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
    /// Capacity then, in the same unit.
    pub capacity: f64,
    /// Axial compression then, negative in tension \[N\].
    pub compression_n: f64,
    /// First instant at which the demand exceeded the capacity anywhere in the member; `null` if it did not \[s\].
    pub exceeded_s: Option<f64>,
    /// Impact on the building during which the ratio was greatest; `null` if none was in progress.
    pub impact: Option<ImpactPlace>,
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

/// Members of a building beyond their capacity by the governing rule.
#[derive(Clone, Debug, Serialize, PartialEq)]
pub struct CapacitySummary {
    /// Name of the governing rule.
    pub rule: &'static str,
    /// Number of members with a known capacity.
    pub rated: usize,
    /// Number of members beyond it, in shear or in bending.
    pub exceeded: usize,
    /// The first member beyond its capacity; `null` if there is none.
    pub first: Option<ExceededSummary>,
    /// The member with the greatest ratio.
    pub worst: ExceededSummary,
}

/// A member beyond its capacity, or nearest to it.
#[derive(Clone, Debug, Serialize, PartialEq)]
pub struct ExceededSummary {
    /// Name of the member.
    pub member: String,
    /// `shear` or `bending`.
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

/// Greatest forces at one section of a member.
#[derive(Clone, Copy, Debug, Serialize, PartialEq)]
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
}

#[rustfmt::skip]
impl SectionSummary {
    /// Its numbers.
    pub const QUANTITIES: &[Quantity<Self>] = &[
        Quantity::<Self>::real("axial_max_n", Unit::N, "greatest axial force, positive in tension", |s| s.axial_max_n),
        Quantity::<Self>::real("axial_min_n", Unit::N, "least axial force, negative in compression", |s| s.axial_min_n),
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
        Quantity::<Self>::whole("impact_count", "impacts on the point", |s| s.impact_count),
        Quantity::<Self>::real("peak_force_n", Unit::N, "greatest contact force on it", |s| s.peak_force_n),
    ];
}

/// Numbers of hinges, or storeys of a shear building, beyond the elastic range, and their peaks.
#[derive(Clone, Debug, Default, Serialize, PartialEq)]
pub struct HingeSummary {
    /// Total number.
    pub total: usize,
    /// Cracked or beyond.
    pub cracked: usize,
    /// Yielded.
    pub yielded: usize,
    /// When the first one yielded; `None` if none did \[s\].
    pub first_yield_s: Option<f64>,
    /// Greatest ductility of any of them \[–\].
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
        Quantity::<Self>::whole("total", "places that can crack or yield", |h| h.total),
        Quantity::<Self>::whole("cracked", "those that cracked", |h| h.cracked),
        Quantity::<Self>::whole("yielded", "those that yielded", |h| h.yielded),
        Quantity::<Self>::optional("first_yield_s", Unit::S, "instant of the first yield", |h| h.first_yield_s),
        Quantity::<Self>::real("ductility", Unit::NONE, "greatest ductility of any of them", |h| h.ductility),
        Quantity::<Self>::real("dissipated_j", Unit::J, "energy that they dissipated", |h| h.dissipated_j),
    ];
}

/// One hinge, or one storey of a shear building.
#[derive(Clone, Debug, Serialize, PartialEq)]
pub struct SpringSummary {
    /// Position as text.
    pub place: String,
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

#[rustfmt::skip]
impl SpringSummary {
    /// Its numbers.
    pub const QUANTITIES: &[Quantity<Self>] = &[
        Quantity::<Self>::whole("index", "number among the hinges of the building, from 0", |s| s.index).not_in_table(),
        Quantity::<Self>::optional("cracked_s", Unit::S, "instant of cracking; 0 if self weight alone causes it", |s| s.cracked_s),
        Quantity::<Self>::optional("yielded_s", Unit::S, "instant of yielding; 0 if self weight alone causes it", |s| s.yielded_s),
        Quantity::<Self>::real("deformation_max", Unit::RAD_OR_M, "greatest deformation of the positive side", |s| s.deformation_max),
        Quantity::<Self>::real("deformation_min", Unit::RAD_OR_M, "greatest deformation of the negative side", |s| s.deformation_min),
        Quantity::<Self>::real("ductility", Unit::NONE, "greatest rotation of the member end over that at yield; of storeys, deformation over that at yield", |s| s.ductility),
        Quantity::<Self>::real("peak_force", Unit::NM_OR_N, "greatest moment; of storeys, shear", |s| s.peak_force),
        Quantity::<Self>::real("dissipated_j", Unit::J, "energy dissipated", |s| s.dissipated_j),
    ];
}

/// One floor.
#[derive(Clone, Debug, Default, Serialize, PartialEq)]
pub struct FloorSummary {
    /// Floor, from 1.
    pub floor: usize,
    /// Height above the base \[m\].
    pub height_m: f64,
    /// Its peaks, and what is left at the end.
    #[serde(flatten)]
    pub response: FloorResponse,
    /// Peaks across the row and in rotation; absent in one plane.
    #[serde(flatten)]
    pub in_plan: Option<FloorInPlan>,
    /// The same in the run without contact, if it exists.
    pub without_contact: Option<FloorResponse>,
    /// The former over the latter, if that run exists.
    pub amplification: Option<Amplification>,
}

#[rustfmt::skip]
impl FloorSummary {
    /// Where it is.
    pub const QUANTITIES: &[Quantity<Self>] = &[
        Quantity::<Self>::whole("floor", "floor, from 1", |f| f.floor),
        Quantity::<Self>::real("height_m", Unit::M, "height above the base", |f| f.height_m),
    ];
}

/// One gap and its contacts.
#[derive(Clone, Debug, Serialize, PartialEq)]
pub struct GapSummary {
    /// Names of the left and the right building; `wall` is a rigid wall.
    pub between: [String; 2],
    /// Width at rest, the least of its contacts \[m\].
    pub width_m: f64,
    /// Smallest distance, negative if there was indentation \[m\].
    pub clearance_m: f64,
    /// Contact law.
    pub law: String,
    /// Restitution of free masses under this law \[–\].
    pub free_restitution: f64,
    /// Contacts from the lowest up.
    pub contacts: Vec<ContactSummary>,
    /// Impacts of all contacts.
    pub impact_count: usize,
    /// Impacts of one contact that follow each other sooner count as one \[s\].
    pub minimum_separation_s: f64,
    /// Intervals in which at least one contact is in impact.
    pub pounding_count: usize,
    /// Those of them in which two or more contacts were in impact at the same instant.
    pub multiple_pounding_count: usize,
    /// Most contacts in impact at one instant.
    pub most_at_once: usize,
    /// Greatest force of any contact \[N\].
    pub peak_force_n: f64,
    /// Greatest sum of the forces of all contacts at one instant \[N\].
    pub total_force_peak_n: f64,
    /// Its instant; `null` without an impact \[s\].
    pub total_force_peak_at_s: Option<f64>,
    /// Instant of the first impact \[s\].
    pub first_impact_s: Option<f64>,
    /// Greatest closing of any contact when the buildings pass through each other, less what it is wider than the
    /// others: the smallest gap without pounding; `null` when that run was not made \[m\].
    pub closing_without_contact_m: Option<f64>,
}

#[rustfmt::skip]
impl GapSummary {
    /// Its numbers.
    pub const QUANTITIES: &[Quantity<Self>] = &[
        Quantity::<Self>::real("width_m", Unit::M, "width at rest, the least of its contacts", |g| g.width_m).in_study(),
        Quantity::<Self>::real("clearance_m", Unit::M, "smallest distance during the run; negative: indentation", |g| g.clearance_m),
        Quantity::<Self>::real("free_restitution", Unit::NONE, "restitution of free masses under the contact law", |g| g.free_restitution),
        Quantity::<Self>::whole("impact_count", "impacts of all its contacts", |g| g.impact_count).in_study(),
        Quantity::<Self>::real("minimum_separation_s", Unit::S, "impacts of one contact that follow each other sooner count as one", |g| g.minimum_separation_s),
        Quantity::<Self>::whole("pounding_count", "intervals in which at least one contact is in impact", |g| g.pounding_count).in_study(),
        Quantity::<Self>::whole("multiple_pounding_count", "those with impacts at two or more contacts at once", |g| g.multiple_pounding_count),
        Quantity::<Self>::whole("most_at_once", "greatest number of contacts in impact at one instant", |g| g.most_at_once).in_study(),
        Quantity::<Self>::real("peak_force_n", Unit::N, "greatest force of any of its contacts", |g| g.peak_force_n).in_study(),
        Quantity::<Self>::real("total_force_peak_n", Unit::N, "greatest sum of the forces of all its contacts at one instant", |g| g.total_force_peak_n).in_study(),
        Quantity::<Self>::optional("total_force_peak_at_s", Unit::S, "its instant; absent without an impact", |g| g.total_force_peak_at_s),
        Quantity::<Self>::optional("first_impact_s", Unit::S, "instant of the first impact", |g| g.first_impact_s).in_study(),
        Quantity::<Self>::real("impulse_n_s", Unit::NS, "time integral of the forces of all its contacts", Self::impulse_n_s).not_in_summary().in_study(),
        Quantity::<Self>::real("closing_peak_m", Unit::M, "greatest closing of any of its contacts", Self::closing_peak_m).not_in_summary().in_study(),
    ];

    /// Numbers of the run without contact; in studies if they ask for it.
    pub const WITHOUT_CONTACT: &[Quantity<Self>] = &[
        Quantity::<Self>::optional("closing_without_contact_m", Unit::M, "greatest closing without contact: the smallest gap without pounding; in studies with `without_contact = true`", |g| g.closing_without_contact_m).in_study(),
    ];
}

impl GapSummary {
    /// Time integral of the forces of all contacts \[N·s\].
    #[must_use]
    pub fn impulse_n_s(&self) -> f64 {
        // An empty sum would be −0.
        let contacts = self.contacts.iter();
        contacts.fold(0.0, |sum, contact| sum + contact.impulse_n_s)
    }

    /// Greatest closing of any contact, at least zero \[m\].
    #[must_use]
    pub fn closing_peak_m(&self) -> f64 {
        let contacts = self.contacts.iter();
        contacts
            .map(|contact| contact.closing_peak_m)
            .fold(0.0, f64::max)
    }
}

/// One contact.
#[derive(Clone, Debug, Serialize, PartialEq)]
pub struct ContactSummary {
    /// Left and right floor, from 1; `null` for a point between floors.
    pub floors: [Option<usize>; 2],
    /// Height above the base \[m\].
    pub height_m: f64,
    /// Where it is in plan; absent in one plane.
    #[serde(flatten)]
    pub in_plan: Option<PlanContactSummary>,
    /// Width at rest, the least of its points \[m\].
    pub width_m: f64,
    /// Greatest closing u_left − u_right \[m\].
    pub closing_peak_m: f64,
    /// Its instant \[s\].
    pub closing_peak_at_s: f64,
    /// Number of impacts.
    pub impact_count: usize,
    /// Greatest force \[N\].
    pub peak_force_n: f64,
    /// Its instant; `null` without an impact \[s\].
    pub peak_force_at_s: Option<f64>,
    /// Time integral of the force \[N·s\].
    pub impulse_n_s: f64,
    /// Impacts in order of time.
    pub impacts: Vec<ImpactSummary>,
}

#[rustfmt::skip]
impl ContactSummary {
    /// Its numbers.
    pub const QUANTITIES: &[Quantity<Self>] = &[
        Quantity::<Self>::real("height_m", Unit::M, "height above the base", |c| c.height_m),
        Quantity::<Self>::real("width_m", Unit::M, "width at rest", |c| c.width_m),
        Quantity::<Self>::whole("impact_count", "impacts", |c| c.impact_count).in_study(),
        Quantity::<Self>::real("peak_force_n", Unit::N, "greatest force", |c| c.peak_force_n).in_study(),
        Quantity::<Self>::optional("peak_force_at_s", Unit::S, "its instant; absent without an impact", |c| c.peak_force_at_s),
        Quantity::<Self>::real("impulse_n_s", Unit::NS, "time integral of the force", |c| c.impulse_n_s).in_study(),
        Quantity::<Self>::real("closing_peak_m", Unit::M, "greatest closing", |c| c.closing_peak_m).in_study(),
        Quantity::<Self>::real("closing_peak_at_s", Unit::S, "its instant", |c| c.closing_peak_at_s),
    ];
}

/// Springs and dashpots between two neighbours.
#[derive(Clone, Debug, Serialize, PartialEq)]
pub struct LinkSummary {
    /// Names of the left and the right building; `wall` is a rigid wall.
    pub between: [String; 2],
    /// Stiffness of each \[N/m\].
    pub stiffness_n_m: f64,
    /// Damping of each \[N·s/m\].
    pub damping_n_s_m: f64,
    /// Greatest force of any of them, either sign \[N\].
    pub peak_force_n: f64,
    /// Energy dissipated in their dashpots \[J\].
    pub dissipated_j: f64,
    /// One by one, from the lowest up.
    pub floors: Vec<LinkFloorSummary>,
}

#[rustfmt::skip]
impl LinkSummary {
    /// Its numbers.
    pub const QUANTITIES: &[Quantity<Self>] = &[
        Quantity::<Self>::real("stiffness_n_m", Unit::N_PER_M, "stiffness of each spring", |l| l.stiffness_n_m),
        Quantity::<Self>::real("damping_n_s_m", Unit::NS_PER_M, "damping of each dashpot", |l| l.damping_n_s_m),
        Quantity::<Self>::real("peak_force_n", Unit::N, "greatest force of any of them", |l| l.peak_force_n),
        Quantity::<Self>::real("dissipated_j", Unit::J, "energy dissipated in the dashpots", |l| l.dissipated_j),
    ];
}

/// One spring and dashpot between two points.
#[derive(Clone, Copy, Debug, Serialize, PartialEq)]
pub struct LinkFloorSummary {
    /// Left and right floor, from 1; `null` for a point between floors, and for a wall.
    pub floors: [Option<usize>; 2],
    /// Height above the base \[m\].
    pub height_m: f64,
    /// Force of greatest magnitude, positive in compression \[N\].
    pub peak_force_n: f64,
    /// Its instant \[s\].
    pub peak_force_at_s: f64,
    /// Greatest change of length, either sign \[m\].
    pub peak_stroke_m: f64,
    /// Energy dissipated in its dashpot \[J\].
    pub dissipated_j: f64,
}

#[rustfmt::skip]
impl LinkFloorSummary {
    /// Its numbers.
    pub const QUANTITIES: &[Quantity<Self>] = &[
        Quantity::<Self>::real("height_m", Unit::M, "height above the base", |l| l.height_m),
        Quantity::<Self>::real("peak_force_n", Unit::N, "force of greatest magnitude, positive in compression", |l| l.peak_force_n),
        Quantity::<Self>::real("peak_force_at_s", Unit::S, "its instant", |l| l.peak_force_at_s),
        Quantity::<Self>::real("peak_stroke_m", Unit::M, "greatest change of length", |l| l.peak_stroke_m),
        Quantity::<Self>::real("dissipated_j", Unit::J, "energy dissipated in the dashpot", |l| l.dissipated_j),
    ];
}

/// One impact.
#[derive(Clone, Copy, Debug, Serialize, PartialEq)]
pub struct ImpactSummary {
    /// Instant of first contact \[s\].
    pub start_s: f64,
    /// Last instant of force \[s\].
    pub end_s: f64,
    /// Greatest force \[N\].
    pub peak_force_n: f64,
    /// Its instant \[s\].
    pub peak_force_at_s: f64,
    /// Greatest indentation \[m\].
    pub peak_indentation_m: f64,
    /// Closing rate at first contact \[m/s\].
    pub impact_speed_m_s: f64,
    /// Opening rate at the end, zero when the run ended first \[m/s\].
    pub separation_speed_m_s: f64,
    /// Separation ÷ impact speed \[–\].
    pub realised_restitution: f64,
    /// Time integral of the force \[N·s\].
    pub impulse_n_s: f64,
    /// Energy dissipated by the contact \[J\].
    pub dissipated_j: f64,
    /// Whether it ended before the end of the run.
    pub finished: bool,
    /// Closed episodes counted as this one impact.
    pub touches: usize,
    /// Greatest number of contacts of the gap in impact at one instant of it, itself included.
    pub simultaneous: usize,
    /// Centre of pressure at the greatest force, on the site; absent in one plane \[m\].
    #[serde(skip_serializing_if = "Option::is_none")]
    pub centre_m: Option<[f64; 2]>,
}

#[rustfmt::skip]
impl ImpactSummary {
    /// Its numbers.
    pub const QUANTITIES: &[Quantity<Self>] = &[
        Quantity::<Self>::real("start_s", Unit::S, "instant of first contact", |i| i.start_s),
        Quantity::<Self>::real("end_s", Unit::S, "last instant of force", |i| i.end_s),
        Quantity::<Self>::real("duration_s", Unit::S, "time from first contact to the last instant of force", |i| i.end_s - i.start_s).not_in_summary(),
        Quantity::<Self>::real("peak_force_n", Unit::N, "greatest force", |i| i.peak_force_n),
        Quantity::<Self>::real("peak_force_at_s", Unit::S, "its instant", |i| i.peak_force_at_s),
        Quantity::<Self>::real("peak_indentation_m", Unit::M, "greatest indentation", |i| i.peak_indentation_m),
        Quantity::<Self>::real("impact_speed_m_s", Unit::M_S, "closing rate at first contact", |i| i.impact_speed_m_s),
        Quantity::<Self>::real("separation_speed_m_s", Unit::M_S, "opening rate at the end; 0 if the run ended first", |i| i.separation_speed_m_s),
        Quantity::<Self>::real("realised_restitution", Unit::NONE, "separation speed ÷ impact speed", |i| i.realised_restitution),
        Quantity::<Self>::real("impulse_n_s", Unit::NS, "time integral of the force", |i| i.impulse_n_s),
        Quantity::<Self>::real("dissipated_j", Unit::J, "energy dissipated by the contact", |i| i.dissipated_j),
        Quantity::<Self>::whole("finished", "whether it ended within the run", |i| usize::from(i.finished)),
        Quantity::<Self>::whole("touches", "closed episodes counted as this one impact", |i| i.touches),
        Quantity::<Self>::whole("simultaneous", "greatest number of contacts of the gap in impact at one instant of it", |i| i.simultaneous),
    ];
}

/// Energies at the end of the run \[J\].
#[derive(Clone, Copy, Debug, Default, Serialize, PartialEq)]
pub struct EnergySummary {
    /// Work of the ground motion.
    pub input_j: f64,
    /// Kinetic energy.
    pub kinetic_j: f64,
    /// Strain energy.
    pub strain_j: f64,
    /// Dissipated by viscous damping, that of links included.
    pub damped_j: f64,
    /// The part of links.
    pub links_j: f64,
    /// Energy of hinges.
    pub hysteretic_j: f64,
    /// Energy of contacts.
    pub contact_j: f64,
    /// |input − sum of the others| / input at the end \[–\].
    pub imbalance: f64,
    /// Greatest imbalance over time, relative to the greatest energy until then \[–\].
    pub worst_imbalance: f64,
}

#[rustfmt::skip]
impl EnergySummary {
    /// Its numbers.
    pub const QUANTITIES: &[Quantity<Self>] = &[
        Quantity::<Self>::real("input_j", Unit::J, "work of the ground motion", |e| e.input_j).in_study(),
        Quantity::<Self>::real("kinetic_j", Unit::J, "kinetic energy", |e| e.kinetic_j),
        Quantity::<Self>::real("strain_j", Unit::J, "strain energy", |e| e.strain_j),
        Quantity::<Self>::real("damped_j", Unit::J, "dissipated by viscous damping, that of links included", |e| e.damped_j).in_study(),
        Quantity::<Self>::real("links_j", Unit::J, "the part of links", |e| e.links_j),
        Quantity::<Self>::real("hysteretic_j", Unit::J, "energy of hinges", |e| e.hysteretic_j).in_study(),
        Quantity::<Self>::real("contact_j", Unit::J, "energy of contacts", |e| e.contact_j).in_study(),
        Quantity::<Self>::real("imbalance", Unit::NONE, "energy imbalance at the end, relative to the input", |e| e.imbalance).in_study(),
        Quantity::<Self>::real("worst_imbalance", Unit::NONE, "greatest imbalance over time, relative to the greatest energy until then", |e| e.worst_imbalance).in_study(),
    ];
}

/// Whether the errors of all reported peaks, relative to the greatest of their kind in the building or gap, stay within the
/// tolerance.
#[derive(Clone, Copy, Debug, Default, Serialize, PartialEq)]
pub struct PromiseSummary {
    /// Estimated error of peaks \[–\].
    pub tolerance: f64,
    /// Whether the estimate stays within the tolerance; `null` where there is none, as for buildings that yield.
    pub met: Option<bool>,
    /// Estimated error of the least accurate peak of a building, contact forces and impulses not included: from
    /// omitted shapes and values between steps in modal stepping, of from frequency errors of the steps otherwise;
    /// `null` where it is not estimated \[–\].
    pub residual: Option<f64>,
    /// Instant from which results depend on contacts made or missed within the tolerance; `null` if none do \[s\].
    pub sensitive_from_s: Option<f64>,
}

#[rustfmt::skip]
impl PromiseSummary {
    /// Its numbers.
    pub const QUANTITIES: &[Quantity<Self>] = &[
        Quantity::<Self>::real("tolerance", Unit::NONE, "tolerance of peaks", |p| p.tolerance),
        Quantity::<Self>::optional("met", Unit::NONE, "whether the estimate stays within the tolerance", |p| p.met.map(|met| f64::from(u8::from(met)))),
        Quantity::<Self>::optional("residual", Unit::NONE, "estimated error of the least accurate peak of a building", |p| p.residual),
        Quantity::<Self>::optional("sensitive_from_s", Unit::S, "instant from which results depend on contacts made or missed within the tolerance", |p| p.sensitive_from_s),
    ];
}

impl PromiseSummary {
    /// The promise and its estimate in one line. Contact forces and impulses have no estimate of their own.
    #[must_use]
    pub fn in_words(&self) -> String {
        let tolerance = self.tolerance;
        let estimate = match (self.residual, self.met) {
            (Some(residual), Some(true)) => format!(
                "estimated error of floor peaks and shears {residual:.1e} of the greatest of their kind, within the tolerance {tolerance:e}"
            ),
            (Some(residual), _) => format!(
                "estimated error of floor peaks and shears {residual:.1e} of the greatest of their kind, beyond the tolerance {tolerance:e}"
            ),
            (None, _) => {
                "not estimated: buildings yield, or the integrator is not the usual one".to_owned()
            }
        };
        match self.sensitive_from_s {
            Some(from) => format!(
                "accuracy: {estimate}; sensitive from t = {from:.3} s, holds for peaks before it"
            ),
            None => format!("accuracy: {estimate}"),
        }
    }
}

/// Work done, and the time it took.
#[derive(Clone, Copy, Debug, Default, Serialize, PartialEq)]
pub struct WorkSummary {
    /// Solver, as spelt in model files.
    pub solver: &'static str,
    /// Accepted steps.
    pub steps: u64,
    /// Accepted steps with a closed contact.
    pub contact_steps: u64,
    /// Steps repeated at an event.
    pub repeated_steps: u64,
    /// Factorisations.
    pub factorizations: u64,
    /// Solutions.
    pub solves: u64,
    /// Newton iterations.
    pub iterations: u64,
    /// Iterations on springs that yield, one per trial step.
    pub outer_iterations: u64,
    /// Steps halved because those did not converge.
    pub halved_steps: u64,
    /// Multiply-adds spent on the forces of contacts and links.
    pub coupling_operations: u64,
    /// Shapes used by modal stepping; 0 for other solvers.
    pub shapes: u64,
    /// Runs repeated by modal stepping with more shapes or finer steps, to meet the tolerance.
    pub repeated_runs: u64,
    /// Regular free-vibration step \[s\].
    pub step_s: f64,
    /// Smallest regular step in contact; `null` without contact \[s\].
    pub contact_step_s: Option<f64>,
    /// Wall time of the stepping \[s\].
    pub wall_s: f64,
}

#[rustfmt::skip]
impl WorkSummary {
    /// Its numbers.
    pub const QUANTITIES: &[Quantity<Self>] = &[
        Quantity::<Self>::whole("steps", "accepted steps", |w| w.steps as usize).in_study(),
        Quantity::<Self>::whole("contact_steps", "those with a closed contact", |w| w.contact_steps as usize).in_study(),
        Quantity::<Self>::whole("repeated_steps", "steps repeated at an event", |w| w.repeated_steps as usize),
        Quantity::<Self>::whole("factorizations", "factorisations", |w| w.factorizations as usize).in_study(),
        Quantity::<Self>::whole("solves", "solutions", |w| w.solves as usize).in_study(),
        Quantity::<Self>::whole("iterations", "Newton iterations on contact forces", |w| w.iterations as usize).in_study(),
        Quantity::<Self>::whole("outer_iterations", "iterations on springs that yield, one per trial step", |w| w.outer_iterations as usize),
        Quantity::<Self>::whole("halved_steps", "steps halved because those did not converge", |w| w.halved_steps as usize),
        Quantity::<Self>::whole("coupling_operations", "multiply-adds spent on the forces of contacts and links", |w| w.coupling_operations as usize),
        Quantity::<Self>::whole("shapes", "shapes of modal stepping; 0 for other solvers", |w| w.shapes as usize),
        Quantity::<Self>::whole("repeated_runs", "runs repeated with more shapes or finer steps", |w| w.repeated_runs as usize),
        Quantity::<Self>::real("step_s", Unit::S, "regular free-vibration step", |w| w.step_s),
        Quantity::<Self>::optional("contact_step_s", Unit::S, "smallest regular step in contact", |w| w.contact_step_s),
        Quantity::<Self>::real("wall_s", Unit::S, "wall time of the stepping", |w| w.wall_s),
    ];
}
