//! Buildings and floors.

use serde::Serialize;

use super::capacity::CapacitySummary;
use super::foundation::FoundationSummary;
use super::hinges::HingeSummary;
use super::isolation::{Floors, IsolationSummary};
use super::joints::JointSummary;
use super::members::MemberSummary;
use super::panels::PanelsSummary;
use super::parts::PartSummary;
use super::rotation_levels::RotationLevelsSummary;
use super::sections::FibreSummary;
use super::shear_failure::ShearFailureSummary;
use super::strains::StrainsSummary;
use crate::quantity::{Quantity, Unit};
use crate::results::ground::GroundSummary;
use crate::results::in_plan::{BuildingInPlan, FloorInPlan};
use crate::results::response::{Amplification, BuildingResponse, FloorResponse};

/// One building.
#[derive(Clone, Debug, Default, Serialize, PartialEq)]
pub struct BuildingSummary {
    /// Name.
    pub name: String,
    /// Vibrating mass \[kg\].
    pub mass_kg: f64,
    /// Periods of the lateral modes (at least 1 % of the horizontal effective mass), longest first \[s\].
    pub periods_s: Vec<f64>,
    /// Periods of the modes with most of the mass along x and across; 0 where none moves that way \[s\].
    #[serde(skip)]
    pub fundamental_periods_s: [f64; 2],
    /// Rayleigh damping in use: mass coefficient \[1/s\].
    pub rayleigh_alpha_per_s: f64,
    /// Rayleigh damping in use: stiffness coefficient \[s\].
    pub rayleigh_beta_s: f64,
    /// Floors from the ground up; the mat of an isolated building is floor 0.
    pub floors: Floors,
    /// Its bearings; absent if it has none.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub isolation: Option<IsolationSummary>,
    /// Its foundation on soil; absent if it has none.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub foundation: Option<FoundationSummary>,
    /// The ground under it; absent where one ground is under all.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub ground: Option<GroundSummary>,
    /// Its peaks, and what is left at the end.
    #[serde(flatten)]
    pub response: BuildingResponse,
    /// Peaks across the row and in torsion; absent in one plane.
    #[serde(flatten)]
    pub in_plan: Option<BuildingInPlan>,
    /// The same in the run without contact, if it exists.
    pub without_contact: Option<BuildingResponse>,
    /// Its peaks across the row and in torsion in that run; absent in one plane.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub without_contact_in_plan: Option<BuildingInPlan>,
    /// The former over the latter, if that run exists.
    pub amplification: Option<Amplification>,
    /// Hinge counts.
    pub hinges: HingeSummary,
    /// Columns that failed in shear; absent if none can.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub shear_failures: Option<ShearFailureSummary>,
    /// Members against stated limits of the rotation of their hinges; absent without limits.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub rotation_levels: Option<RotationLevelsSummary>,
    /// Share of the moment at the base that axial forces of coupled walls bear, without that of self weight: the greatest of their moment
    /// about the middle of the walls over the greatest of all; absent without coupling beams \[–\].
    #[serde(skip_serializing_if = "Option::is_none")]
    pub degree_of_coupling: Option<f64>,
    /// Braces, struts, walls and coupling beams; absent if it has none.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub parts: Vec<PartSummary>,
    /// Its infill panels together; absent without any.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub panels: Option<PanelsSummary>,
    /// Ends of columns that are made of fibres, by the strains that they passed; absent where none is judged.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub strains: Option<StrainsSummary>,
    /// Ends of columns that are made of fibres, storey by storey; absent if it has none.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub sections: Vec<FibreSummary>,
    /// Columns and beams, storey by storey from the ground up, columns first; absent unless asked for.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub members: Vec<MemberSummary>,
    /// Beam–column joints, floor by floor from the ground up; absent unless their capacities are known.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub joints: Vec<JointSummary>,
    /// Members beyond their capacity; absent unless capacities are known.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub capacity: Option<CapacitySummary>,
}

impl BuildingSummary {
    /// Greatest drift ratio of any storey anywhere: along the row, and at the corners of a plan \[–\].
    #[must_use]
    pub fn greatest_drift(&self) -> f64 {
        let corner = self.in_plan.map_or(0.0, |plan| plan.drift_corner_peak);
        self.response.drift_peak.max(corner)
    }
}

#[rustfmt::skip]
impl BuildingSummary {
    /// Numbers that do not depend on the motion.
    pub const QUANTITIES: &[Quantity<Self>] = &[
        Quantity::<Self>::real("mass_kg", Unit::KG, "mass that moves relative to the ground, with the mat, the foundation and the base", |b| b.mass_kg),
        Quantity::<Self>::optional("period_s", Unit::S, "period of the first lateral mode", |b| b.periods_s.first().copied()).not_in_summary().in_study(),
        Quantity::<Self>::real("rayleigh_alpha_per_s", Unit::PER_S, "Rayleigh damping: coefficient of the mass", |b| b.rayleigh_alpha_per_s),
        Quantity::<Self>::real("rayleigh_beta_s", Unit::S, "Rayleigh damping: coefficient of the stiffness", |b| b.rayleigh_beta_s),
        Quantity::<Self>::optional("degree_of_coupling", Unit::NONE, "peak base moment from axial forces of coupled walls ÷ peak total base moment; absent without coupling beams", |b| b.degree_of_coupling).not_in_table(),
    ];
}

/// One floor.
#[derive(Clone, Debug, Default, Serialize, PartialEq)]
pub struct FloorSummary {
    /// Floor, from 1; 0 is the mat of an isolated building.
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
    /// Peaks across the row and in rotation of the run without contact, if it exists.
    #[serde(skip)]
    pub without_contact_in_plan: Option<FloorInPlan>,
    /// The former over the latter, if that run exists.
    pub amplification: Option<Amplification>,
}

impl FloorSummary {
    /// Greatest drift ratio of the storey below anywhere: along the row, and at the corners of a plan \[–\].
    #[must_use]
    pub fn greatest_drift(&self) -> f64 {
        let corner = self
            .in_plan
            .map_or(0.0, |plan| plan.storey_drift_corner_peak);
        self.response.storey_drift_peak.max(corner)
    }

    /// Greatest displacement of the centre of mass in a horizontal direction, either sign, without contact if that run exists \[m\].
    ///
    /// Along neither axis it is a bound: the greatest displacements along both, at whatever instants.
    #[must_use]
    pub fn displacement_peak_m(&self, [x, across]: [f64; 2]) -> f64 {
        let along = self.without_contact.as_ref().unwrap_or(&self.response);
        let without_contact = self
            .without_contact_in_plan
            .as_ref()
            .or(self.in_plan.as_ref());
        let sideways = without_contact.map_or(0.0, |without_contact| {
            without_contact
                .displacement_across_max_m
                .max(-without_contact.displacement_across_min_m)
        });
        x.abs() * along.displacement_peak_m() + across.abs() * sideways
    }
}

#[rustfmt::skip]
impl FloorSummary {
    /// Where it is.
    pub const QUANTITIES: &[Quantity<Self>] = &[
        Quantity::<Self>::whole("floor", "floor number, from 1; 0 is the mat of an isolated building", |f| f.floor),
        Quantity::<Self>::real("height_m", Unit::M, "height above the base", |f| f.height_m),
    ];
}
