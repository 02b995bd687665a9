//! Keys of `summary.json` and the lists of quantities are the same, and so are their values.

use std::collections::BTreeSet;
use std::ops::ControlFlow;
use std::path::Path;

use jostle::results::floor_spectra::{self, FilterSummary, FloorSpectra, FloorSpectrum};
use jostle::results::registry::{Owner, owners};
use jostle::results::response::{BuildingResponse, FloorResponse};
use jostle::results::summary::{
    AcceptanceSummary, AxialFailureSummary, CapacitySummary, ContactSummary, EnergySummary,
    ExceededSummary, ForcesSummary, GapSummary, HingeSummary, ImpactSummary, JointRatio,
    JointSummary, LinkFloorSummary, LinkSummary, MemberComparison, RatioPlace, RatioSummary,
    SectionSummary, SpringSummary, WorkSummary,
};
use jostle::{Quantity, Summary};
use jostle_io::{Format, ModelTree};
use jostle_run::CaseCache;
use serde::Serialize;
use serde_json::Value;

/// A storey that yields beside a frame with members, with a gap and a link.
const MODEL: &str = r#"
title = "Everything that has numbers"
[motion]
record = "el-centro-1940-ns"
pga = "0.5 g"
duration = "4 s"
[[building]]
name = "A"
kind = "shear"
mass = ["40 t", "40 t"]
stiffness = "30 MN/m"
storey_height = "3 m"
hinges = { rule = "peak-oriented", cracking = "4 mm", yield = "12 mm", post_cracking = 0.3, post_yield = 0.05 }
[[building]]
name = "B"
storeys = 3
storey_height = "3.6 m"
spans = ["5 m"]
column = { width = "400 mm", depth = "400 mm", steel = "HRB400", bars = "12 d20", ties = "d10 @ 150 mm" }
beam = { width = "250 mm", depth = "500 mm", steel = "HRB400", bars = "4 d25 top, 3 d25 bottom", ties = "d8 @ 150 mm" }
concrete = "C30"
beam_mass = "3 t/m"
hinges = { rule = "peak-oriented", from = "section" }
gravity = true
[[gap]]
between = ["A", "B"]
width = "5 mm"
floors = [[1, "3 m"]]
[[link]]
between = ["A", "B"]
floors = [[1, "3 m"]]
damping = "100 kN.s/m"
[output]
members = true
capacity = ["gb50010", "asce41", "en1998-3"]
floor_spectra = true
"#;

/// Two buildings in space.
const IN_SPACE: &str = r#"
motion = { record = "el-centro-1940-ns", pga = "0.3 g", duration = "3 s" }
[[building]]
name = "A"
kind = "shear"
plan = ["10 m", "8 m"]
mass = "150 t"
stiffness = "20 MN/m"
storey_height = "3 m"
[[building]]
name = "B"
kind = "shear"
plan = ["9 m", "7 m"]
mass = "100 t"
stiffness = "90 MN/m"
storey_height = "3 m"
[[gap]]
between = ["A", "B"]
width = "10 mm"
"#;

/// A building on bearings before a wall that gives way.
const FAILING: &str = include_str!("../../../../examples/columns_that_fail_in_shear.toml");
const BRACED: &str = include_str!("../../../../examples/braced_and_infilled_frames.toml");
const SPACE_FRAME: &str = include_str!("../../../jostle-validation/data/space/S8_space_frame.toml");

const ISOLATED: &str = r#"
motion = { record = "el-centro-1940-ns", pga = "0.5 g", duration = "3 s" }
[[building]]
name = "A"
kind = "shear"
mass = ["100 t", "100 t"]
stiffness = "200 MN/m"
storey_height = "3 m"
[building.isolation]
kind = "lead-rubber"
mat_mass = "100 t"
stiffness = "40 MN/m"
yield = "200 kN"
post_yield = 0.1
[[wall]]
name = "moat"
stiffness = "120 MN/m"
mass = "25 t"
[[gap]]
between = ["A", "moat"]
floors = [[0, "wall"]]
width = "10 mm"
"#;

/// A building that sways and rocks on its foundation.
const FOUNDED: &str = r#"
motion = { record = "el-centro-1940-ns", pga = "0.5 g", duration = "3 s" }
[soil]
shear_wave_velocity = "150 m/s"
density = "1800 kg/m3"
poisson_ratio = 0.33
[[building]]
name = "A"
kind = "shear"
mass = ["100 t", "100 t"]
stiffness = "200 MN/m"
storey_height = "3 m"
foundation = { length = "12 m", width = "10 m", mass = "100 t" }
"#;

/// Columns that are compared with their capacity under both moments.
const RATED_IN_SPACE: &str = r#"
motion = { record = "el-centro-1940-ns", pga = "0.9 g", duration = "3 s", angle = "30 deg" }
output = { members = true }
[[building]]
name = "A"
kind = "space-frame"
storeys = 1
storey_height = "3.2 m"
lines_x = ["0 m", "6 m"]
lines_y = ["0 m", "5 m"]
elastic_modulus = "30 GPa"
mass = "60 t"
column = { size = ["400 mm", "400 mm"], concrete = "C30", steel = "HRB400", bars = "12 d20", ties = "d10 @ 100 mm" }
beam_x = { width = "300 mm", depth = "600 mm" }
beam_y = { width = "300 mm", depth = "600 mm" }
"#;

/// Two buildings that the motion reaches one after the other.
const DELAYED: &str = r#"
motion = { record = "el-centro-1940-ns", pga = "0.5 g", duration = "3 s" }
[[building]]
name = "A"
kind = "shear"
mass = ["100 t", "100 t"]
stiffness = "200 MN/m"
storey_height = "3 m"
[[building]]
name = "B"
kind = "shear"
mass = ["100 t", "100 t"]
stiffness = "100 MN/m"
storey_height = "3 m"
motion = { arrival = "40 ms" }
[[gap]]
between = ["A", "B"]
width = "5 mm"
"#;

/// A building in space on bearings.
const ISOLATED_IN_SPACE: &str = r#"
motion = { record = "el-centro-1940-ns", pga = "0.5 g", duration = "3 s" }
[[building]]
name = "A"
kind = "shear"
plan = ["10 m", "8 m"]
mass = ["100 t", "100 t"]
stiffness = "200 MN/m"
storey_height = "3 m"
[building.isolation]
kind = "lead-rubber"
mat_mass = "100 t"
stiffness = "40 MN/m"
yield = "200 kN"
post_yield = 0.1
stop = { at = "30 mm", stiffness = "60 MN/m" }
[[wall]]
name = "moat"
from = ["10.01 m", "-1 m"]
to = ["10.01 m", "9 m"]
[[gap]]
between = ["A", "moat"]
floors = [[0, "wall"]]
"#;

/// Coupled walls.
const WALLED: &str = r#"
motion = { record = "el-centro-1940-ns", pga = "0.5 g", duration = "3 s" }
[[building]]
name = "W"
storeys = 2
storey_height = "3 m"
spans = ["5 m"]
concrete = "C30"
floor_mass = "60 t"
wall = [
  { line = 1, length = "2 m", thickness = "200 mm", hinge = { rule = "bilinear", stiffness = "20 GN.m/rad", yield = "400 kN.m", post_yield = 0.02 } },
  { line = 2, length = "2 m", thickness = "200 mm" },
]
coupling_beam = [{ between = [1, 2], width = "200 mm", depth = "600 mm" }]
rotation_limit = [{ of = "columns", measure = "chord", limits = { io = 1e-4, cp = 0.05 } }]
"#;

/// A building whose foundation lifts off.
const LIFTING: &str = r#"
motion = { record = "el-centro-1940-ns", pga = "0.5 g", duration = "3 s" }
[[building]]
name = "L"
kind = "shear"
mass = ["100 t", "100 t"]
stiffness = "200 MN/m"
storey_height = "3 m"
gravity = true
foundation = { length = "4 m", width = "6 m", mass = "100 t", uplift = true, springs = 5, vertical_stiffness = "800 MN/m" }
"#;

/// A portal whose column feet are fibres.
const FIBRED: &str = r#"
motion = { record = "el-centro-1940-ns", pga = "0.5 g", duration = "3 s" }
[[building]]
name = "F"
storeys = 1
storey_height = "3 m"
spans = ["4 m"]
column = { width = "400 mm", depth = "400 mm", concrete = "C30", steel = "HRB400", bars = "8 d20" }
beam = { EI = "100 MN.m2" }
floor_mass = "60 t"
axial = "flexible"
elastic_modulus = "30 GPa"
gravity = true
hinges = { rule = "fibre", length = "0.3 m", fibres = 8, ends = "base", limits = { spalling = 1e-4 } }
"#;

/// The same of a space frame.
const FIBRED_IN_SPACE: &str = r#"
motion = { record = "el-centro-1940-ns", pga = "0.5 g", duration = "3 s" }
[[building]]
name = "S"
kind = "space-frame"
storeys = 1
lines_x = [0, 5]
lines_y = [0]
plan = [[-1, -2], [6, -2], [6, 2], [-1, 2]]
column = { size = [0.4, 0.4], concrete = "C30", steel = "HRB400", bars = "8 d20" }
beam_x = { width = 0.3, depth = 0.5 }
concrete = "C30"
mass = "60 t"
gravity = true
hinges = { rule = "fibre", length = "0.3 m", fibres = 5, ends = "base" }
"#;

fn summary() -> Summary {
    summary_of(MODEL)
}

fn summary_of(model: &str) -> Summary {
    let tree = ModelTree::parse("m", model, Format::Toml, Path::new(""))
        .unwrap_or_else(|error| panic!("{error}"));
    let input = tree.input().unwrap_or_else(|error| panic!("{error}"));
    let prepared = CaseCache::default()
        .assemble(input)
        .unwrap_or_else(|error| panic!("{error}"));
    let settings = prepared.settings(false);
    let mut ran = prepared.run(settings, &mut |_, _| ControlFlow::Continue(()));
    ran.run_without_contact(settings, &mut |_, _| ControlFlow::Continue(()));
    ran.summary()
}

/// Numbers that few objects have.
const RARE: [&str; 9] = [
    "closing_peak_ground_m",
    "crushed_depth_m",
    "degree_of_coupling",
    "equivalent_restitution",
    "friction_j",
    "ground_j",
    "pga_across_m_s2",
    "soil_j",
    "vertical_displacement_peak_m",
];

/// Keys of objects that may be `null`.
const OBJECTS: [&str; 4] = ["first", "first_joint", "impact", "shear_at"];

/// All objects at a path such as `gaps[].contacts[]`.
fn objects<'v>(root: &'v Value, key: &str) -> Vec<&'v Value> {
    let mut found = vec![root];
    for part in key.split('.').filter(|part| !part.is_empty()) {
        let name = part.trim_end_matches("[]");
        let values = found
            .into_iter()
            .map(|value| value.get(name).unwrap_or(&Value::Null));
        found = if name == part {
            values.collect()
        } else {
            values
                .flat_map(|list| list.as_array().into_iter().flatten())
                .collect()
        };
    }
    found.retain(|value| value.is_object());
    found
}

#[test]
fn every_number_of_the_summary_is_in_the_registry_and_the_other_way_round() {
    let plane = serde_json::to_value(summary()).expect("a summary is JSON");
    let space = serde_json::to_value(summary_of(IN_SPACE)).expect("a summary is JSON");
    let in_space = |owner: &&Owner| owner.title.ends_with("in plan");
    let isolated = serde_json::to_value(summary_of(ISOLATED)).expect("a summary is JSON");
    let pendulums = ISOLATED.replace(
        "kind = \"lead-rubber\"\nmat_mass = \"100 t\"\nstiffness = \"40 MN/m\"\nyield = \"200 kN\"\npost_yield = 0.1",
        "kind = \"double-friction-pendulum\"\nmat_mass = \"100 t\"\nradius = [2, 3]\nfriction = [0.03, 0.05]\ncapacity = [0.2, 0.3]",
    );
    let pendulums = serde_json::to_value(summary_of(&pendulums)).expect("a summary is JSON");
    let isolated_in_space = serde_json::to_value(summary_of(ISOLATED_IN_SPACE));
    let isolated_in_space = isolated_in_space.expect("a summary is JSON");
    let founded = serde_json::to_value(summary_of(FOUNDED)).expect("a summary is JSON");
    let founded_in_space = FOUNDED.replace(
        "stiffness = \"200 MN/m\"",
        "plan = [\"12 m\", \"10 m\"]\nstiffness = { x = \"200 MN/m\", y = \"200 MN/m\", torsion = \"9 GN.m/rad\" }",
    );
    let founded_in_space = serde_json::to_value(summary_of(&founded_in_space));
    let founded_in_space = founded_in_space.expect("a summary is JSON");
    let rated_in_space = serde_json::to_value(summary_of(RATED_IN_SPACE));
    let rated_in_space = rated_in_space.expect("a summary is JSON");
    let delayed = serde_json::to_value(summary_of(DELAYED)).expect("a summary is JSON");
    let delayed_in_space = IN_SPACE.replacen(
        "[[building]]\n",
        "[[building]]\nmotion = { arrival = \"40 ms\" }\n",
        1,
    );
    let delayed_in_space = serde_json::to_value(summary_of(&delayed_in_space));
    let delayed_in_space = delayed_in_space.expect("a summary is JSON");
    let failing = serde_json::to_value(summary_of(
        &FAILING.replace("pga = \"0.4 g\"", "pga = \"0.4 g\"\nduration = \"3 s\""),
    ));
    let failing = failing.expect("a summary is JSON");
    let space_frame = format!("{SPACE_FRAME}\n[output]\nmembers = true\n");
    let space_frame = serde_json::to_value(summary_of(&space_frame)).expect("a summary is JSON");
    let fibred_in_space = serde_json::to_value(summary_of(FIBRED_IN_SPACE));
    let fibred_in_space = fibred_in_space.expect("a summary is JSON");
    let yields =
        "EA = \"630 MN\"\nhinge = { rule = \"bilinear\", yield = \"700 kN\", post_yield = 0.02 }";
    let buckles = "profile = \"HEB120\"\nhinge = { rule = \"buckling\", curve = \"c\", yield_strength = \"275 MPa\" }";
    let braced = BRACED.replace(yields, buckles);
    let panel = "width = \"1.4 m\"\n";
    let across =
        "out_of_plane = { strength = \"4 kPa\", density = \"1400 kg/m3\", remove = true }\n";
    let braced = braced.replace(panel, &format!("{panel}{across}"));
    let parts = [&braced[..], WALLED, LIFTING, FIBRED];
    let parts =
        parts.map(|text| serde_json::to_value(summary_of(text)).expect("a summary is JSON"));
    let all = owners();
    // Numbers of other files have their own tests.
    let in_summary = |owner: &&Owner| !owner.key.is_empty() && !owner.key.contains(": ");
    for owner in all.iter().filter(in_summary) {
        if owner.title == "Bearings in plan" {
            let same_key = all.iter().filter(|other| other.key == owner.key);
            compare(&isolated_in_space, &same_key.collect::<Vec<_>>());
        } else if owner.title == "Ground in plan" {
            let same_key = all.iter().filter(|other| other.key == owner.key);
            compare(&delayed_in_space, &same_key.collect::<Vec<_>>());
        } else if owner.title == "Foundations in plan" {
            let same_key = all.iter().filter(|other| other.key == owner.key);
            compare(&founded_in_space, &same_key.collect::<Vec<_>>());
        } else if in_space(&owner) {
            // The same objects have the numbers of one plane as well.
            let same_key = all.iter().filter(|other| other.key == owner.key);
            compare(&space, &same_key.collect::<Vec<_>>());
        } else if owner.title == "Stages of pendulums" {
            compare(&pendulums, &[owner]);
        } else if matches!(owner.title, "Bearings" | "Walls") {
            compare(&isolated, &[owner]);
        } else if matches!(owner.title, "Columns that fail in shear" | "Shear failures") {
            compare(&failing, &[owner]);
        } else if owner.title == "Sections of space frames" {
            // The same objects have the numbers of the other plane as well.
            let same_key = all.iter().filter(|other| other.key == owner.key);
            compare(&space_frame, &same_key.collect::<Vec<_>>());
        } else if owner.title == "Ends of fibre columns of space frames" {
            // The same objects have the numbers of the plane along as well.
            let same_key = all.iter().filter(|other| other.key == owner.key);
            compare(&fibred_in_space, &same_key.collect::<Vec<_>>());
        } else if matches!(
            owner.key,
            "buildings[].parts[]"
                | "buildings[].panels"
                | "buildings[].strains"
                | "buildings[].sections[]"
                | "buildings[].sections[].limits[]"
        ) || owner.key.starts_with("buildings[].rotation_levels")
        {
            compare_together(&parts, owner);
        } else if owner.title == "Member forces at the time of the greatest ratio"
            || owner.title == "Greatest bending ratio of a member"
        {
            // Members of plane frames have no forces of the other plane.
            compare_together(&[plane.clone(), rated_in_space.clone()], owner);
        } else if owner.title == "Ground under a building" {
            compare(&delayed, &[owner]);
        } else if owner.title == "Foundations" {
            compare(&founded, &[owner]);
        } else {
            compare(&plane, &[owner]);
        }
    }
}

/// Compares the numbers of all objects of a key with the lists of their owners.
fn compare(summary: &Value, owners: &[&Owner]) {
    let title = owners[0].title;
    let found = objects(summary, owners[0].key);
    assert!(!found.is_empty(), "the model has no {title}");
    let entries = owners.iter().flat_map(|owner| &owner.entries);
    let names = entries.filter(|entry| entry.places.summary);
    let names: BTreeSet<&str> = names.map(|entry| entry.name).collect();
    for object in found {
        let fields = object.as_object().expect("an object");
        let numbers = fields
            .iter()
            .filter(|(_, value)| value.is_number() || value.is_boolean() || value.is_null())
            .filter(|(key, _)| !OBJECTS.contains(&&key[..]));
        let keys: BTreeSet<&str> = numbers.map(|(key, _)| &key[..]).collect();
        let mut expected = names.clone();
        expected.retain(|name| !RARE.contains(name) || keys.contains(name));
        assert_eq!(keys, expected, "{title}");
    }
}

/// Compares a list with all objects of its owner together, of which none has every number: walls have no settlement.
fn compare_together(summaries: &[Value], owner: &Owner) {
    let found = summaries
        .iter()
        .flat_map(|summary| objects(summary, owner.key));
    let keys: BTreeSet<&str> = found
        .flat_map(|object| object.as_object().expect("an object"))
        .filter(|(_, value)| value.is_number())
        .map(|(key, _)| &key[..])
        .collect();
    let names = owner.entries.iter().filter(|entry| entry.places.summary);
    let names: BTreeSet<&str> = names.map(|entry| entry.name).collect();
    assert_eq!(keys, names, "{}", owner.title);
}

#[test]
fn names_end_with_their_units_and_occur_once() {
    for owner in owners() {
        let names: BTreeSet<&str> = owner.entries.iter().map(|entry| entry.name).collect();
        assert_eq!(names.len(), owner.entries.len(), "{}", owner.title);
    }
    fn check<T>(quantities: &[Quantity<T>]) {
        for quantity in quantities {
            assert!(
                quantity.name.ends_with(quantity.unit.suffix),
                "{}",
                quantity.name
            );
            let plain = quantity.unit.suffix.is_empty();
            let units = ["_m", "_s", "_n", "_j", "_kg", "_m_s2"];
            let bare = units.iter().all(|unit| !quantity.name.ends_with(unit));
            assert!(!plain || bare, "{} has no unit", quantity.name);
        }
    }
    check(BuildingResponse::QUANTITIES);
    check(FloorResponse::QUANTITIES);
    check(GapSummary::QUANTITIES);
    check(ContactSummary::QUANTITIES);
    check(ImpactSummary::QUANTITIES);
    check(HingeSummary::QUANTITIES);
    check(SpringSummary::QUANTITIES);
    check(SectionSummary::QUANTITIES);
    check(LinkSummary::QUANTITIES);
    check(LinkFloorSummary::QUANTITIES);
    check(EnergySummary::QUANTITIES);
    check(WorkSummary::QUANTITIES);
}

/// Compares what a list reads with the JSON of its owner.
fn same<T: Serialize>(quantities: &[Quantity<T>], owner: &T) {
    let json = serde_json::to_value(owner).expect("JSON");
    for quantity in quantities.iter().filter(|quantity| quantity.places.summary) {
        let written = match &json[quantity.name] {
            Value::Bool(yes) => Some(f64::from(u8::from(*yes))),
            value => value.as_f64(),
        };
        assert_eq!(quantity.value(owner), written, "{}", quantity.name);
    }
}

#[test]
fn lists_read_the_values_of_the_summary() {
    let summary = summary();
    for building in &summary.buildings {
        same(BuildingResponse::QUANTITIES, &building.response);
        same(HingeSummary::QUANTITIES, &building.hinges);
        building
            .hinges
            .list
            .iter()
            .for_each(|spring| same(SpringSummary::QUANTITIES, spring));
        for floor in &building.floors {
            same(FloorResponse::QUANTITIES, &floor.response);
        }
        let ends = building.members.iter().flat_map(|member| &member.ends);
        ends.for_each(|end| same(SectionSummary::QUANTITIES, end));
        if let Some(capacity) = &building.capacity {
            same(CapacitySummary::QUANTITIES, capacity);
            same(ExceededSummary::QUANTITIES, &capacity.worst);
        }
        for joint in &building.joints {
            same(JointSummary::QUANTITIES, joint);
            let ratios = joint.ratio.iter().chain(&joint.other_ratios);
            for ratio in ratios {
                same(JointRatio::QUANTITIES, ratio);
                same(RatioPlace::QUANTITIES, &ratio.shear_at);
            }
        }
        for member in &building.members {
            let compared = member.compared.iter();
            compared.for_each(|comparison| same(MemberComparison::QUANTITIES, comparison));
            let worst = member.at_worst.iter();
            worst.for_each(|forces| same(ForcesSummary::QUANTITIES, forces));
            let ratios = member.ratio.iter().chain(&member.other_ratios);
            for ratio in ratios {
                same(RatioSummary::QUANTITIES, ratio);
                same(RatioPlace::QUANTITIES, &ratio.bending_at);
            }
            let accepted = member.acceptance.iter();
            accepted.for_each(|acceptance| same(AcceptanceSummary::QUANTITIES, acceptance));
            let failures = member.axial_failure.iter();
            failures.for_each(|failure| same(AxialFailureSummary::QUANTITIES, failure));
        }
    }
    for gap in &summary.gaps {
        same(GapSummary::QUANTITIES, gap);
        gap.contacts
            .iter()
            .for_each(|contact| same(ContactSummary::QUANTITIES, contact));
        let impacts = gap.contacts.iter().flat_map(|contact| &contact.impacts);
        impacts.for_each(|impact| same(ImpactSummary::QUANTITIES, impact));
    }
    for link in &summary.links {
        same(LinkSummary::QUANTITIES, link);
        link.floors
            .iter()
            .for_each(|floor| same(LinkFloorSummary::QUANTITIES, floor));
    }
    let spectra = summary.floor_spectra.as_ref().expect("asked for");
    same(FloorSpectra::QUANTITIES, spectra);
    same(FilterSummary::QUANTITIES, &spectra.filter);
    for floor in &spectra.floors {
        same(FloorSpectrum::QUANTITIES, floor);
        same(floor_spectra::FloorResponse::QUANTITIES, &floor.response);
    }
    same(EnergySummary::QUANTITIES, &summary.energy);
    same(WorkSummary::QUANTITIES, &summary.work);
}

#[test]
fn amplifications_are_ratios_to_the_run_without_contact() {
    let summary = serde_json::to_value(summary()).expect("a summary is JSON");
    let mut compared = 0;
    for owner in objects(&summary, "buildings[].floors[]")
        .into_iter()
        .chain(objects(&summary, "buildings[]"))
    {
        let ratios = owner["amplification"].as_object().expect("it was compared");
        for (stem, ratio) in ratios {
            let unit = ["", "_m", "_n", "_n_m", "_m_s2"];
            let read = |from: &Value| {
                let mut values = unit
                    .iter()
                    .filter_map(|unit| from.get(format!("{stem}{unit}")));
                values.next_back().and_then(Value::as_f64)
            };
            let without = read(&owner["without_contact"]).unwrap_or(0.0);
            let wanted = read(owner).map(|with| (with / without).abs());
            assert_eq!(ratio.as_f64(), wanted.filter(|_| without != 0.0), "{stem}");
            compared += usize::from(ratio.is_number());
        }
    }
    assert!(compared > 40, "{compared}");
}
