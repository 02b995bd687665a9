//! The numbers of a run in the shape of `summary.json`: names carry their units.

use serde::Serialize;

use super::contact_sensitivity::ContactSensitivity;

/// Results of a run without histories.
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
    /// Work done.
    pub work: WorkSummary,
    /// Reason if the run did not reach the end of the motion.
    pub ended_early: Option<String>,
    /// Warnings about the results.
    pub warnings: Vec<String>,
    /// Notes on the results.
    pub notes: Vec<String>,
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

/// One building.
#[derive(Clone, Debug, Serialize, PartialEq)]
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
    /// Greatest elastic base shear, either sign \[N\].
    pub base_shear_peak_n: f64,
    /// The same of the run without contact, if it exists.
    pub without_contact: Option<BuildingWithoutContact>,
    /// Roof displacement at the end \[m\].
    pub residual_roof_displacement_m: f64,
    /// Hinge counts.
    pub hinges: HingeSummary,
    /// Columns and beams, storey by storey from the ground up, columns first; absent unless asked for.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub members: Vec<MemberSummary>,
    /// Members beyond their capacity; absent unless capacities are known.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub capacity: Option<CapacitySummary>,
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

/// Peaks of one floor.
#[derive(Clone, Copy, Debug, Serialize, PartialEq)]
pub struct FloorSummary {
    /// Floor, from 1.
    pub floor: usize,
    /// Height above the base \[m\].
    pub height_m: f64,
    /// Greatest displacement to the right \[m\].
    pub displacement_max_m: f64,
    /// Its instant \[s\].
    pub displacement_max_at_s: f64,
    /// Greatest displacement to the left \[m\].
    pub displacement_min_m: f64,
    /// Its instant \[s\].
    pub displacement_min_at_s: f64,
    /// Greatest total acceleration, either sign \[m/s²\].
    pub total_acceleration_peak_m_s2: f64,
    /// Greatest drift ratio of the storey below, either sign \[–\].
    pub storey_drift_peak: f64,
    /// Greatest shear of the storey below, either sign: the horizontal forces above its base \[N\].
    pub storey_shear_peak_n: f64,
    /// Greatest moment of these forces about the base of the storey below, either sign \[N·m\].
    pub overturning_moment_peak_n_m: f64,
    /// Drift ratio of the storey below at the end, positive to the right \[–\].
    pub residual_drift: f64,
    /// The same peaks of the run without contact, if it exists.
    pub without_contact: Option<FloorWithoutContact>,
}

/// Peaks of one floor without contact; meanings as in [`FloorSummary`].
#[derive(Clone, Copy, Debug, Serialize, PartialEq)]
#[allow(missing_docs, reason = "the names of FloorSummary")]
pub struct FloorWithoutContact {
    pub displacement_max_m: f64,
    pub displacement_max_at_s: f64,
    pub displacement_min_m: f64,
    pub displacement_min_at_s: f64,
    pub total_acceleration_peak_m_s2: f64,
    pub storey_drift_peak: f64,
    pub storey_shear_peak_n: f64,
    pub overturning_moment_peak_n_m: f64,
}

/// Peaks of one building without contact.
#[derive(Clone, Copy, Debug, Serialize, PartialEq)]
pub struct BuildingWithoutContact {
    /// Greatest elastic base shear, either sign \[N\].
    pub base_shear_peak_n: f64,
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
    /// Instant of the first impact \[s\].
    pub first_impact_s: Option<f64>,
    /// Greatest closing of any contact when the buildings pass through each other, less what it is wider than the
    /// others: the smallest gap without pounding; `null` when that run was not made \[m\].
    pub closing_without_contact_m: Option<f64>,
}

/// One contact.
#[derive(Clone, Debug, Serialize, PartialEq)]
pub struct ContactSummary {
    /// Left and right floor, from 1; `null` for a point between floors.
    pub floors: [Option<usize>; 2],
    /// Height above the base \[m\].
    pub height_m: f64,
    /// Width at rest \[m\].
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
