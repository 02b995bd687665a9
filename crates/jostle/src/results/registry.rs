//! Every reported number: all lists of quantities in one.

use serde::Serialize;

use super::comparison::{HistoryScore, ImpactScore};
use super::floor_spectra::{self, FilterSummary, FloorSpectra, FloorSpectrum};
use super::ground::{GroundInPlan, GroundSummary};
use super::in_plan::{BuildingInPlan, FloorInPlan};
use super::response::{BuildingResponse, FloorResponse};
use super::summary::{
    AcceptanceSummary, AcrossSummary, AxialFailureSummary, BuildingSummary, CapacitySummary,
    ContactSummary, EnergySummary, ExceededSummary, FloorSummary, ForcesSummary, FoundationSummary,
    GapSummary, HingeSummary, ImpactSummary, IsolationInPlan, IsolationSummary, JointRatio,
    JointSummary, LinkFloorSummary, LinkSummary, MemberComparison, MotionSummary, PromiseSummary,
    RatioPlace, RatioSummary, SectionSummary, ShearFailure, ShearFailureSummary, SpringSummary,
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

fn entries<T>(quantities: &[Quantity<T>]) -> Vec<Entry> {
    let entry = |quantity: &Quantity<T>| Entry {
        name: quantity.name,
        unit: quantity.unit.symbol,
        meaning: quantity.meaning,
        places: quantity.places,
    };
    quantities.iter().map(entry).collect()
}

/// All owners with their numbers, in the order of the documentation.
#[must_use]
#[rustfmt::skip]
pub fn owners() -> Vec<Owner> {
    let owner = |title, key, table, study, entries: &[Vec<Entry>]| Owner { title, key, table, study, entries: entries.concat() };
    vec![
        owner("Ground motion", "motion", None, "", &[entries(MotionSummary::QUANTITIES)]),
        owner("All gaps together", "", None, "", &[entries(Summary::POUNDING)]),
        owner("Buildings", "buildings[]", Some("buildings.parquet"), "J1.", &[entries(BuildingSummary::QUANTITIES), entries(BuildingResponse::QUANTITIES)]),
        owner("Buildings in plan", "buildings[]", None, "A.", &[entries(BuildingInPlan::QUANTITIES)]),
        owner("Floors", "buildings[].floors[]", Some("floors.parquet"), "J1.floor3.", &[entries(FloorSummary::QUANTITIES), entries(FloorResponse::QUANTITIES)]),
        owner("Floors in plan", "buildings[].floors[]", None, "A.floor3.", &[entries(FloorInPlan::QUANTITIES)]),
        owner("Bearings", "buildings[].isolation", None, "J1.isolation_", &[entries(IsolationSummary::QUANTITIES)]),
        owner("Bearings in plan", "buildings[].isolation", None, "A.isolation_", &[entries(IsolationInPlan::QUANTITIES)]),
        owner("Foundations", "buildings[].foundation", None, "", &[entries(FoundationSummary::QUANTITIES)]),
        owner("Ground under a building", "buildings[].ground", None, "", &[entries(GroundSummary::QUANTITIES)]),
        owner("Ground in plan", "buildings[].ground", None, "", &[entries(GroundInPlan::QUANTITIES)]),
        owner("Hinges of a building", "buildings[].hinges", None, "", &[entries(HingeSummary::QUANTITIES)]),
        owner("Hinges", "buildings[].hinges.list[]", Some("hinges.parquet"), "", &[entries(SpringSummary::QUANTITIES)]),
        owner("Columns that fail in shear", "buildings[].shear_failures", None, "J1.shear_failures_", &[entries(ShearFailureSummary::QUANTITIES)]),
        owner("Failures in shear", "buildings[].shear_failures.list[]", None, "", &[entries(ShearFailure::QUANTITIES)]),
        owner("Sections of columns and beams", "buildings[].members[].ends[]", None, "", &[entries(SectionSummary::QUANTITIES)]),
        owner("Sections of space frames", "buildings[].members[].ends[]", None, "", &[entries(AcrossSummary::QUANTITIES)]),
        owner("Columns and beams with contact and without", "buildings[].members[].compared", None, "", &[entries(MemberComparison::QUANTITIES)]),
        owner("Struck points of columns", "buildings[].members[].struck[]", None, "", &[entries(StruckSummary::QUANTITIES)]),
        owner("Forces of members at the worst instant", "buildings[].members[].at_worst[]", None, "", &[entries(ForcesSummary::QUANTITIES)]),
        owner("Capacity of members", "buildings[].capacity", None, "J1.capacity_", &[entries(CapacitySummary::QUANTITIES)]),
        owner("Worst member", "buildings[].capacity.worst", None, "", &[entries(ExceededSummary::QUANTITIES)]),
        owner("Demand over capacity of a member", "buildings[].members[].ratio", None, "", &[entries(RatioSummary::QUANTITIES)]),
        owner("Greatest bending of a member against its capacity", "buildings[].members[].ratio.bending_at", None, "", &[entries(RatioPlace::QUANTITIES)]),
        owner("Rotations against accepted ones", "buildings[].members[].acceptance[]", None, "", &[entries(AcceptanceSummary::QUANTITIES)]),
        owner("Axial failure of columns", "buildings[].members[].axial_failure", None, "", &[entries(AxialFailureSummary::QUANTITIES)]),
        owner("Joints of beams and columns", "buildings[].joints[]", None, "", &[entries(JointSummary::QUANTITIES)]),
        owner("Shear of joints over capacity", "buildings[].joints[].ratio", None, "", &[entries(JointRatio::QUANTITIES)]),
        owner("Gaps", "gaps[]", None, "J1-J2.", &[entries(GapSummary::QUANTITIES), entries(GapSummary::WITHOUT_CONTACT)]),
        owner("Contacts", "gaps[].contacts[]", None, "J1-J2.floor5-5.", &[entries(ContactSummary::QUANTITIES)]),
        owner("Impacts", "gaps[].contacts[].impacts[]", Some("impacts.parquet"), "", &[entries(ImpactSummary::QUANTITIES)]),
        owner("Links", "links[]", None, "J1-J2.link.", &[entries(LinkSummary::QUANTITIES)]),
        owner("Linked floors", "links[].floors[]", None, "", &[entries(LinkFloorSummary::QUANTITIES)]),
        owner("Walls", "walls[]", None, "", &[entries(WallSummary::QUANTITIES)]),
        owner("Floor spectra", "floor_spectra", None, "", &[entries(FloorSpectra::QUANTITIES)]),
        owner("Filter of floor accelerations", "floor_spectra.filter", None, "", &[entries(FilterSummary::QUANTITIES)]),
        owner("Floors with spectra", "floor_spectra.floors[]", None, "", &[entries(FloorSpectrum::QUANTITIES), entries(floor_spectra::FloorResponse::QUANTITIES)]),
        owner("Energies", "energy", None, "energy_", &[entries(EnergySummary::QUANTITIES)]),
        owner("Accuracy", "promise", None, "", &[entries(PromiseSummary::QUANTITIES)]),
        owner("Work", "work", None, "", &[entries(WorkSummary::QUANTITIES)]),
        owner("Histories compared with measurements", "compare.json: columns[].score", None, "", &[entries(HistoryScore::QUANTITIES)]),
        owner("Impacts compared with measurements", "compare.json: impacts[].score", None, "", &[entries(ImpactScore::QUANTITIES)]),
    ]
}
