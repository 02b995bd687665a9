//! The numbers of a run in the shape of `summary.json`: names carry their units. Every part lists its numbers below it, one line
//! each.

mod accuracy;
mod building;
mod capacity;
mod checks;
mod energy;
mod foundation;
mod gaps;
mod hinges;
mod isolation;
mod joints;
mod links;
mod members;
mod panels;
mod parts;
mod rotation_levels;
mod sections;
mod shear_failure;
mod strains;

pub use super::ground::{GroundInPlan, GroundSummary};
pub use accuracy::{PromiseSummary, WorkSummary};
pub use building::{BuildingSummary, FloorSummary};
pub use capacity::{
    AcceptanceSummary, AxialFailureSummary, CapacitySummary, ExceededSummary, ImpactPlace,
    LevelSummary, RatioPlace, RatioSummary,
};
pub use checks::{Finding, Grade};
pub use energy::EnergySummary;
pub use foundation::{FoundationAcross, FoundationSummary};
pub use gaps::{ContactSummary, GapSummary, ImpactSummary};
pub use hinges::{HingeSummary, SpringSummary};
pub use isolation::{Floors, IsolationInPlan, IsolationSummary, StageSummary, WallSummary};
pub use joints::{JointRatio, JointSummary};
pub use links::{LinkFloorSummary, LinkSummary};
pub use members::{
    AcrossSummary, ForcesSummary, MemberComparison, MemberSummary, SectionSummary, StruckSummary,
};
pub use panels::{PanelDamageSummary, PanelsSummary};
pub use parts::PartSummary;
pub use rotation_levels::{MemberLevel, ReachedLevel, RotationLevelsSummary};
pub use sections::{FibreAcrossSummary, FibreSummary, StrainLimitSummary};
pub use shear_failure::{ShearFailure, ShearFailureSummary};
pub use strains::StrainsSummary;

use serde::Serialize;

use crate::quantity::{Quantity, Unit};
use crate::results::contact_sensitivity::ContactSensitivity;
use crate::results::floor_spectra::FloorSpectra;
use crate::results::gradient::Gradient;
use crate::results::isolation_bounds::IsolationBounds;

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
    /// Commit of jostle; `None` where it is not known.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub build: Option<String>,
    /// Ground motion.
    pub motion: MotionSummary,
    /// Buildings from left to right.
    pub buildings: Vec<BuildingSummary>,
    /// Gaps, in the order of the model.
    pub gaps: Vec<GapSummary>,
    /// Links, in the order of the model.
    pub links: Vec<LinkSummary>,
    /// Walls with names, in the order of the model; absent if there is none.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub walls: Vec<WallSummary>,
    /// Energies at the end.
    pub energy: EnergySummary,
    /// Whether the errors of reported peaks are within the tolerance.
    pub promise: PromiseSummary,
    /// How results depend on the contact; absent unless asked for.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub contact_sensitivity: Option<ContactSensitivity>,
    /// Derivatives of peaks; absent unless asked for.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub gradients: Vec<Gradient>,
    /// Peaks over the range of the properties of bearings; absent where the model states none.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub isolation_bounds: Option<IsolationBounds>,
    /// Response spectra of floors; absent unless asked for.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub floor_spectra: Option<FloorSpectra>,
    /// Work done.
    pub work: WorkSummary,
    /// Checks that the model or the results did not pass, worst first ([`crate::judgement::judge`]).
    pub checks: Vec<Finding>,
    /// Checks that the model silences; absent if it silences none.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub silenced_checks: Vec<String>,
    /// Reason if the run did not reach the end of the motion.
    pub ended_early: Option<String>,
    /// Warnings about the results.
    pub warnings: Vec<String>,
    /// Notes on the results.
    pub notes: Vec<String>,
}

#[rustfmt::skip]
impl Summary {
    /// Gap needed of a gap over nominal properties and bounds of bearings, where these were run without contact \[m\].
    #[must_use]
    pub fn gap_needed_at_bounds_m(&self, gap: usize) -> Option<f64> {
        let bounds = self.isolation_bounds.as_ref()?.gaps.get(gap)?;
        Some(bounds.closing_without_contact_m.as_ref()?.envelope)
    }

    /// Gap needed of a gap, over the bounds of bearings where they are known; `None` without a run without contact \[m\].
    #[must_use]
    pub fn gap_needed_m(&self, gap: usize) -> Option<f64> {
        let nominal = || self.gaps.get(gap)?.closing_without_contact_m;
        self.gap_needed_at_bounds_m(gap).or_else(nominal)
    }

    /// Numbers of all gaps together; none if there is no gap.
    pub const POUNDING: &[Quantity<Self>] = &[
        Quantity::<Self>::whole("impact_count", "impacts of all gaps", |s| s.gaps.iter().map(|gap| gap.impact_count).sum()).not_in_summary().in_study(),
        Quantity::<Self>::real("peak_force_n", Unit::N, "greatest force of any contact", |s| s.gaps.iter().map(|gap| gap.peak_force_n).fold(0.0, f64::max)).not_in_summary().in_study(),
        Quantity::<Self>::optional("first_impact_s", Unit::S, "time of the first impact", |s| s.gaps.iter().filter_map(|gap| gap.first_impact_s).min_by(f64::total_cmp)).not_in_summary().in_study(),
        Quantity::<Self>::real("impulse_n_s", Unit::NS, "time integral of all contact forces", |s| s.gaps.iter().fold(0.0, |sum, gap| sum + gap.impulse_n_s())).not_in_summary().in_study(),
        Quantity::<Self>::real("closing_peak_m", Unit::M, "greatest closing of any contact", |s| s.gaps.iter().map(GapSummary::closing_peak_m).fold(0.0, f64::max)).not_in_summary().in_study(),
    ];

    /// What the checks found.
    pub const CHECKS: &[Quantity<Self>] = &[
        Quantity::<Self>::whole("result_checks", "number of result checks, B1 to B12, that gave a note or a warning", |s| s.checks.iter().filter(|check| check.id.starts_with('B') && check.grade >= Grade::Note).count()).not_in_summary().in_study(),
        Quantity::<Self>::whole("accuracy_met", "1 if the estimated errors are within the tolerance, otherwise 0", |s| usize::from(s.promise.met == Some(true))).not_in_summary().in_study(),
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
    /// Name of the motion at a right angle to it; `None` if there is none.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub across: Option<String>,
    /// Its peak as used \[m/s²\].
    #[serde(skip_serializing_if = "Option::is_none")]
    pub pga_across_m_s2: Option<f64>,
    /// Factor on the record, negative when reversed \[–\].
    pub scale: f64,
    /// Length of the analysis \[s\].
    pub duration_s: f64,
}

#[rustfmt::skip]
impl MotionSummary {
    /// Its numbers.
    pub const QUANTITIES: &[Quantity<Self>] = &[
        Quantity::<Self>::whole("points", "number of values in the record; 0 for analytic waves", |m| m.points),
        Quantity::<Self>::real("step_s", Unit::S, "time step of the record; 0 for analytic waves", |m| m.step_s),
        Quantity::<Self>::real("pga_m_s2", Unit::M_S2, "peak ground acceleration, after scaling", |m| m.pga_m_s2).in_study(),
        Quantity::<Self>::optional("pga_across_m_s2", Unit::M_S2, "peak ground acceleration across, after scaling", |m| m.pga_across_m_s2),
        Quantity::<Self>::real("scale", Unit::NONE, "scale factor of the record, negative if reversed", |m| m.scale),
        Quantity::<Self>::real("duration_s", Unit::S, "length of the analysis", |m| m.duration_s),
    ];
}
