//! Every reported number: all lists of quantities in one.

use serde::Serialize;

use super::comparison::{HistoryScore, ImpactScore};
use super::floor_spectra::{self, FilterSummary, FloorSpectra, FloorSpectrum};
use super::ground::{GroundInPlan, GroundSummary};
use super::in_plan::{BuildingInPlan, FloorInPlan};
use super::response::{BuildingResponse, FloorResponse};
use super::summary::{
    AcceptanceSummary, AcrossSummary, AxialFailureSummary, BuildingSummary, CapacitySummary,
    ContactSummary, EnergySummary, ExceededSummary, FibreAcrossSummary, FibreSummary, FloorSummary,
    ForcesSummary, FoundationAcross, FoundationSummary, GapSummary, HingeSummary, ImpactSummary,
    IsolationInPlan, IsolationSummary, JointRatio, JointSummary, LinkFloorSummary, LinkSummary,
    MemberComparison, MemberLevel, MotionSummary, PanelsSummary, PartSummary, PromiseSummary,
    RatioPlace, RatioSummary, ReachedLevel, RotationLevelsSummary, SectionSummary, ShearFailure,
    ShearFailureSummary, SpringSummary, StageSummary, StrainLimitSummary, StrainsSummary,
    StruckSummary, Summary, WallSummary, WorkSummary,
};
use crate::quantity::{Places, Quantity};

/// What has numbers: a floor, a building, an impact.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Owner {
    /// Its name, in the plural.
    pub title: &'static str,
    /// Where it stands in `summary.json`, or in another file whose name precedes it; empty for the file itself.
    pub key: &'static str,
    /// The table with one row for each, if there is one.
    pub table: Option<&'static str>,
    /// How its columns in studies begin, by example.
    pub study: &'static str,
    /// Its numbers, in the order of tables.
    pub entries: Vec<Entry>,
}

/// A number of an owner, without the function that reads it.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
pub struct Entry {
    /// Name.
    pub name: &'static str,
    /// Symbol of its unit.
    pub unit: &'static str,
    /// Meaning, in one line.
    pub meaning: &'static str,
    /// Where it appears.
    #[serde(flatten)]
    pub places: Places,
}

impl Entry {
    const fn new<T>(quantity: &Quantity<T>) -> Self {
        Self {
            name: quantity.name,
            unit: quantity.unit.symbol,
            meaning: quantity.meaning,
            places: quantity.places,
        }
    }
}

/// The entries of a list that is not empty.
const fn entries<T, const N: usize>(quantities: &[Quantity<T>]) -> [Entry; N] {
    let mut entries = [Entry::new(&quantities[0]); N];
    let mut index = 1;
    while index < N {
        entries[index] = Entry::new(&quantities[index]);
        index += 1;
    }
    entries
}

/// The entries of a list of quantities, as constant data: code that collects them would be compiled once for every list.
macro_rules! entries {
    ($quantities:expr) => {
        const { &entries::<_, { $quantities.len() }>($quantities) }
    };
}

/// Title, key, table, columns in studies and lists of numbers of an owner.
type Row = (
    &'static str,
    &'static str,
    Option<&'static str>,
    &'static str,
    &'static [&'static [Entry]],
);

#[rustfmt::skip]
const OWNERS: &[Row] = &[
    ("Ground motion", "motion", None, "", &[entries!(MotionSummary::QUANTITIES)]),
    ("The whole run", "", None, "", &[entries!(Summary::POUNDING), entries!(Summary::CHECKS)]),
    ("Buildings", "buildings[]", Some("buildings.parquet"), "J1.", &[entries!(BuildingSummary::QUANTITIES), entries!(BuildingResponse::QUANTITIES)]),
    ("Buildings in plan", "buildings[]", None, "A.", &[entries!(BuildingInPlan::QUANTITIES)]),
    ("Floors", "buildings[].floors[]", Some("floors.parquet"), "J1.floor3.", &[entries!(FloorSummary::QUANTITIES), entries!(FloorResponse::QUANTITIES)]),
    ("Floors in plan", "buildings[].floors[]", None, "A.floor3.", &[entries!(FloorInPlan::QUANTITIES)]),
    ("Bearings", "buildings[].isolation", None, "J1.isolation_", &[entries!(IsolationSummary::QUANTITIES)]),
    ("Bearings in plan", "buildings[].isolation", None, "A.isolation_", &[entries!(IsolationInPlan::QUANTITIES)]),
    ("Stages of pendulums", "buildings[].isolation.stages[]", None, "", &[entries!(StageSummary::QUANTITIES)]),
    ("Foundations", "buildings[].foundation", None, "", &[entries!(FoundationSummary::QUANTITIES)]),
    ("Foundations in plan", "buildings[].foundation", None, "", &[entries!(FoundationAcross::QUANTITIES)]),
    ("Ground under a building", "buildings[].ground", None, "", &[entries!(GroundSummary::QUANTITIES)]),
    ("Ground in plan", "buildings[].ground", None, "", &[entries!(GroundInPlan::QUANTITIES)]),
    ("Hinges of a building", "buildings[].hinges", None, "", &[entries!(HingeSummary::QUANTITIES)]),
    ("Hinges", "buildings[].hinges.list[]", Some("hinges.parquet"), "", &[entries!(SpringSummary::QUANTITIES)]),
    ("Columns that fail in shear", "buildings[].shear_failures", None, "J1.shear_failures_", &[entries!(ShearFailureSummary::QUANTITIES)]),
    ("Shear failures", "buildings[].shear_failures.list[]", None, "", &[entries!(ShearFailure::QUANTITIES)]),
    ("Members with rotation limits", "buildings[].rotation_levels", None, "J1.rotation_levels_", &[entries!(RotationLevelsSummary::QUANTITIES)]),
    ("Rotation levels of members", "buildings[].rotation_levels.list[]", None, "", &[entries!(MemberLevel::QUANTITIES)]),
    ("Limits of rotation levels", "buildings[].rotation_levels.list[].limits[]", None, "", &[entries!(ReachedLevel::QUANTITIES)]),
    ("Braces, struts, walls, coupling beams and foundations with uplift", "buildings[].parts[]", None, "", &[entries!(PartSummary::QUANTITIES)]),
    ("Infill panels of a building", "buildings[].panels", None, "J1.panels_", &[entries!(PanelsSummary::QUANTITIES)]),
    ("Strain limits exceeded by fibre columns", "buildings[].strains", None, "J1.strains_", &[entries!(StrainsSummary::QUANTITIES)]),
    ("Ends of fibre columns", "buildings[].sections[]", None, "", &[entries!(FibreSummary::QUANTITIES)]),
    ("Ends of fibre columns of space frames", "buildings[].sections[]", None, "", &[entries!(FibreAcrossSummary::QUANTITIES)]),
    ("Strain limits of fibres", "buildings[].sections[].limits[]", None, "", &[entries!(StrainLimitSummary::QUANTITIES)]),
    ("Sections of columns and beams", "buildings[].members[].ends[]", None, "", &[entries!(SectionSummary::QUANTITIES)]),
    ("Sections of space frames", "buildings[].members[].ends[]", None, "", &[entries!(AcrossSummary::QUANTITIES)]),
    ("Columns and beams with and without contact", "buildings[].members[].compared", None, "", &[entries!(MemberComparison::QUANTITIES)]),
    ("Impact points on columns", "buildings[].members[].struck[]", None, "", &[entries!(StruckSummary::QUANTITIES)]),
    ("Member forces at the time of the greatest ratio", "buildings[].members[].at_worst[]", None, "", &[entries!(ForcesSummary::QUANTITIES)]),
    ("Capacity of members", "buildings[].capacity", None, "J1.capacity_", &[entries!(CapacitySummary::QUANTITIES)]),
    ("Worst member", "buildings[].capacity.worst", None, "", &[entries!(ExceededSummary::QUANTITIES)]),
    ("Demand-to-capacity ratio of a member", "buildings[].members[].ratio", None, "", &[entries!(RatioSummary::QUANTITIES)]),
    ("Greatest bending ratio of a member", "buildings[].members[].ratio.bending_at", None, "", &[entries!(RatioPlace::QUANTITIES)]),
    ("Rotations compared with limits", "buildings[].members[].acceptance[]", None, "", &[entries!(AcceptanceSummary::QUANTITIES)]),
    ("Axial failure of columns", "buildings[].members[].axial_failure", None, "", &[entries!(AxialFailureSummary::QUANTITIES)]),
    ("Joints of beams and columns", "buildings[].joints[]", None, "", &[entries!(JointSummary::QUANTITIES)]),
    ("Shear ratio of joints", "buildings[].joints[].ratio", None, "", &[entries!(JointRatio::QUANTITIES)]),
    ("Gaps", "gaps[]", None, "J1-J2.", &[entries!(GapSummary::QUANTITIES), entries!(GapSummary::WITHOUT_CONTACT)]),
    ("Contacts", "gaps[].contacts[]", None, "J1-J2.floor5-5.", &[entries!(ContactSummary::QUANTITIES)]),
    ("Impacts", "gaps[].contacts[].impacts[]", Some("impacts.parquet"), "", &[entries!(ImpactSummary::QUANTITIES)]),
    ("Links", "links[]", None, "J1-J2.link.", &[entries!(LinkSummary::QUANTITIES)]),
    ("Linked floors", "links[].floors[]", None, "", &[entries!(LinkFloorSummary::QUANTITIES)]),
    ("Walls", "walls[]", None, "", &[entries!(WallSummary::QUANTITIES)]),
    ("Floor spectra", "floor_spectra", None, "", &[entries!(FloorSpectra::QUANTITIES)]),
    ("Filter of floor accelerations", "floor_spectra.filter", None, "", &[entries!(FilterSummary::QUANTITIES)]),
    ("Floors with spectra", "floor_spectra.floors[]", None, "", &[entries!(FloorSpectrum::QUANTITIES), entries!(floor_spectra::FloorResponse::QUANTITIES)]),
    ("Energies", "energy", None, "energy_", &[entries!(EnergySummary::QUANTITIES)]),
    ("Accuracy", "promise", None, "", &[entries!(PromiseSummary::QUANTITIES)]),
    ("Work", "work", None, "", &[entries!(WorkSummary::QUANTITIES)]),
    ("Histories compared with measurements", "compare.json: columns[].score", None, "", &[entries!(HistoryScore::QUANTITIES)]),
    ("Impacts compared with measurements", "compare.json: impacts[].score", None, "", &[entries!(ImpactScore::QUANTITIES)]),
];

/// All owners with their numbers, in the order of the documentation.
#[must_use]
pub fn owners() -> Vec<Owner> {
    let rows = OWNERS.iter();
    rows.map(|&(title, key, table, study, lists)| Owner {
        title,
        key,
        table,
        study,
        entries: lists.concat(),
    })
    .collect()
}
