//! Hinges of steel members without a yield moment: that of their profile, by hand; a frame that is pushed until it collapses.

use jostle::hysteresis::{Hysteresis, HysteresisRule, Side};
use jostle::pushover::{PushSettings, pushover};
use jostle::{FrameHinges, Hinges, SpacePlace, Structure};
use jostle_testkit::files::{refusal, sound};
use jostle_testkit::runs::assembled;

/// Plastic moments of S355 from Z in tables of ArcelorMittal: HEB 300 about both axes, IPE 400 \[N·m\].
const HEB: [f64; 2] = [355e6 * 1868.7e-6, 355e6 * 870.1e-6];
const IPE: f64 = 355e6 * 1307.1e-6;
/// Axial force at which a HEB 300 of S355 yields, 149.08 cm² \[N\].
const SQUASH: f64 = 355e6 * 149.08e-4;

/// Properties from sizes agree with the tables within this.
const AS_IN_TABLES: f64 = 2e-3;

fn yields(spring: &Hysteresis) -> f64 {
    let [a, b] = Side::BOTH.map(|side| spring.backbone().side(side).yielding.force);
    assert_eq!(a, b);
    a
}

#[track_caller]
fn near(found: f64, due: f64, within: f64) {
    assert!((found / due - 1.0).abs() < within, "{found} for {due}");
}

const HINGES: &str = "hinges = { rule = \"bilinear\", initial = \"rigid\", column = { post_yield = 0.0 }, beam = { post_yield = 0.0 } }";

/// A portal; `load`: on its columns.
fn portal(load: &str, hinges: &str) -> String {
    format!(
        r#"[[building]]
kind = "frame"
storeys = 1
storey_height = "3.5 m"
spans = ["6 m"]
column = {{ profile = "HEB300", yield_strength = "355 MPa" }}
beam = {{ profile = "IPE400", yield_strength = "355 MPa" }}
density = 0
floor_mass = "10 t"
floor_load = "{load}"
p_delta = false
{hinges}
"#
    )
}

fn hinges_of(text: &str) -> FrameHinges {
    match &sound(text).model.buildings[0].hinges {
        Some(Hinges::Frame(hinges)) => hinges.clone(),
        other => panic!("{other:?}"),
    }
}

/// Sway of a portal with feet that are fixed: two hinges at the feet and two in the beam, H h = 2 M_c + 2 M_b. Under 4 MN on the columns
/// those of the feet are 1.18 (1 − N/N_pl) of the plastic moment and weaker than the beam at the heads.
#[test]
fn a_portal_collapses_as_limit_analysis_says() {
    for load in [200e3, 6e6] {
        let text = portal(&format!("{load} N"), HINGES);
        let hinges = hinges_of(&text);
        let compression = 0.5 * (load + 10e3 * 9.80665);
        let left = (1.18 * (1.0 - compression / SQUASH)).min(1.0);
        let [column, beam] = [left * HEB[0], IPE];
        assert_eq!(hinges.columns[0][0].rule(), HysteresisRule::Bilinear);
        near(yields(&hinges.columns[0][1]), column, AS_IN_TABLES);
        near(yields(&hinges.beams[0][0]), beam, AS_IN_TABLES);
        // The elastic stiffness is that of the whole section.
        let initial = hinges.beams[0][0].backbone().initial();
        near(initial, 1e5 * 210e9 * 23_128e-8 / 6.0, AS_IN_TABLES);
        let system = assembled(&sound(&text).model);
        let settings = PushSettings {
            drift: 0.03,
            ..PushSettings::default()
        };
        let pushed = pushover(&system.buildings[0], settings).expect("it bears");
        let due = (2.0 * column + 2.0 * beam.min(column)) / 3.5;
        near(pushed.peak().base_shear, due, 1e-2);
    }
}

/// `axial_load` replaces the weight, as for columns with bars.
#[test]
fn a_load_in_numbers_replaces_the_weight() {
    let text = portal("200 kN", HINGES);
    let text = text.replacen("\"355 MPa\"", "\"355 MPa\", axial_load = \"2.5 MN\"", 1);
    let left = 1.18 * (1.0 - 2.5e6 / SQUASH);
    near(
        yields(&hinges_of(&text).columns[0][0]),
        left * HEB[0],
        AS_IN_TABLES,
    );
}

/// Moments that are given stay, side by side with those of the profile.
#[test]
fn given_moments_stay() {
    let hinges = "hinges = { rule = \"peak-oriented\", column = { yield = \"300 kN.m\", cracking = \"100 kN.m\", post_cracking = 0.3, post_yield = 0.02 }, beam = { cracking = \"100 kN.m\", post_cracking = 0.3, post_yield = 0.02, negative = { yield = \"200 kN.m\" } } }";
    let hinges = hinges_of(&portal("0 N", hinges));
    assert_eq!(yields(&hinges.columns[0][0]), 300e3);
    let beam = hinges.beams[0][0].backbone();
    near(beam.side(Side::Positive).yielding.force, IPE, AS_IN_TABLES);
    assert_eq!(beam.side(Side::Negative).yielding.force, 200e3);
    assert_eq!(beam.side(Side::Positive).cracking.force, 100e3);
}

/// `from = "section"` takes steel as well, with 1 % of the member end after yield.
#[test]
fn sections_of_steel_give_hinges() {
    let hinges = "hinges = { rule = \"bilinear\", from = \"section\" }";
    let found = hinges_of(&portal("200 kN", hinges));
    near(yields(&found.columns[0][0]), HEB[0], AS_IN_TABLES);
    let beam = found.beams[0][0];
    near(yields(&beam), IPE, AS_IN_TABLES);
    let end = 6.0 * 210e9 * 23_128e-8 / 6.0;
    let after = beam.backbone().side(Side::Positive).post_yield;
    near(1.0 / (1.0 / after + 1.0 / end), 0.01 * end, AS_IN_TABLES);
    // Columns of concrete and beams of steel.
    let mixed = portal("200 kN", &hinges.replace("bilinear", "takeda"));
    let mixed = mixed.replace(
        "profile = \"HEB300\", yield_strength = \"355 MPa\"",
        "width = 0.5, depth = 0.5, concrete = \"C30\", steel = \"HRB400\", bars = \"12 d20\"",
    );
    let mixed = hinges_of(&mixed);
    assert!(mixed.columns[0][0].cracks() && !mixed.beams[0][0].cracks());
    near(yields(&mixed.beams[0][0]), IPE, AS_IN_TABLES);
}

const FRAMES: &str = r#"[[building]]
kind = "frame"
plan = ["6 m", "12 m"]
mass = "100 t"
storey_height = "3.5 m"
stiffness = { x = "1 MN/m", y = "60 MN/m" }
[[building.frame]]
name = "F"
at = [[0, 0], [0, 12]]
spans = ["6 m"]
column = { profile = "HEB300", yield_strength = "355 MPa" }
beam = { profile = "IPE400", yield_strength = "355 MPa" }
beam_mass = "50 t/m"
"#;

/// Frames at lines: the weight of 50 t/m rests on two columns each, that of the floor on four.
#[test]
fn columns_of_frames_at_lines_know_their_weight() {
    let input = sound(&format!("{FRAMES}{HINGES}\n"));
    let Structure::Tiers(tiers) = &input.model.buildings[0].structure else {
        panic!("a plan");
    };
    let weight = (0.5 * 50e3 * 6.0 + 0.25 * 100e3) * 9.80665;
    let left = 1.18 * (1.0 - weight / SQUASH);
    assert_eq!(tiers.frames.len(), 2);
    for frame in &tiers.frames {
        for column in &frame.hinges.columns[0] {
            near(yields(column), left * HEB[0], AS_IN_TABLES);
        }
        near(yields(&frame.hinges.beams[0][0]), IPE, AS_IN_TABLES);
    }
}

const SPACE: &str = r#"[[building]]
kind = "space-frame"
lines_x = [0, 6]
lines_y = [0, 5]
storey_height = "3.5 m"
mass = "100 t"
floor_load = "8 MN"
density = 0
column = [{ profile = "HEB300", yield_strength = "355 MPa" }, { x = 2, profile = "HEB300", axis = "weak", yield_strength = "355 MPa" }]
beam_x = { profile = "IPE400", yield_strength = "355 MPa" }
beam_y = { profile = "IPE400", yield_strength = "355 MPa" }
"#;

/// Columns of space frames yield about both axes, whichever is the first, under a quarter of the weight; rigid floors spread it evenly.
#[test]
fn columns_of_space_frames_yield_about_both_axes() {
    let input = sound(&format!("{SPACE}{HINGES}\n"));
    let Structure::Tiers(tiers) = &input.model.buildings[0].structure else {
        panic!("a plan");
    };
    let frame = tiers.space_frame.as_ref().expect("a space frame");
    let members = &input.members.profiled;
    let mut columns = 0;
    for member in &frame.members {
        let [first, second] = member.hinges.each_ref().map(Option::as_ref);
        let SpacePlace::Column { line, .. } = member.place else {
            near(yields(first.expect("a beam")), IPE, AS_IN_TABLES);
            assert!(second.is_none());
            continue;
        };
        let name = member.place.to_string();
        let known = members.iter().find(|known| known.name == name);
        let compression = known.expect("steel").compression;
        near(compression, 0.25 * (8e6 + 100e3 * 9.80665), 0.05);
        let left = 1.18 * (1.0 - compression / SQUASH);
        let [x, y] = match line[0] {
            0 => HEB,
            _ => [HEB[1], HEB[0]],
        };
        near(yields(first.expect("along")), left * x, AS_IN_TABLES);
        near(yields(second.expect("across")), left * y, AS_IN_TABLES);
        columns += 1;
    }
    assert_eq!(columns, 4);
    // A hinge of its own, and one plane alone.
    let own = SPACE.replace(
        "axis = \"weak\",",
        "axis = \"weak\", hinge = { y = { post_yield = 0.01 } },",
    );
    let own = sound(&format!("{own}{HINGES}\n"));
    let Structure::Tiers(tiers) = &own.model.buildings[0].structure else {
        panic!("a plan");
    };
    let frame = tiers.space_frame.as_ref().expect("a space frame");
    let alone = |member: &&jostle::SpaceMember| matches!(member.place, SpacePlace::Column { line, .. } if line[0] == 1);
    let member = frame.members.iter().find(alone).expect("there");
    assert!(member.hinges[0].is_none());
    assert!(yields(&member.hinges[1].expect("across")) > 0.6 * HEB[0]);
}

#[test]
fn what_has_no_moment_says_what_is_missing() {
    let says = |text: &str, expected: &[&str]| {
        let found = refusal(text);
        for part in expected {
            assert!(found.contains(part), "{part} is not in {found}");
        }
    };
    let weak = ", yield_strength = \"355 MPa\"";
    let portal = |hinges: &str| portal("200 kN", hinges);
    // No member has a strength: the key itself.
    let text = portal(HINGES).replace(weak, "");
    says(
        &text,
        &[
            "building[0].hinges.column.yield",
            "is missing",
            "yield_strength",
        ],
    );
    // Some have.
    let text = portal(HINGES).replace("spans = [\"6 m\"]", "spans = [\"6 m\", \"6 m\"]");
    let text = text.replace(
        "beam = { profile = \"IPE400\", yield_strength = \"355 MPa\" }",
        "beam = [{ profile = \"IPE400\", yield_strength = \"355 MPa\" }, { bay = 2, profile = \"IPE300\" }]",
    );
    says(
        &text,
        &[
            "hinges.beam",
            "beam 2 of storey 1 no yield_strength",
            "add yield",
        ],
    );
    // A post-yield slope is still needed.
    let text = portal(&HINGES.replace("post_yield = 0.0", ""));
    says(&text, &["hinges.column.post_yield", "is missing"]);
    // More than the profile bears.
    let text = portal(HINGES).replace("200 kN", "11 MN");
    says(
        &text,
        &["column 1 of storey 1", "axial load of 5553 kN", "5292 kN"],
    );
    let text = portal("hinges = { rule = \"bilinear\", from = \"section\" }");
    says(
        &text.replace("200 kN", "11 MN"),
        &["hinges: column 1 of storey 1", "axial load of 5553 kN"],
    );
    says(
        &text.replace(weak, ""),
        &[
            "no column has bars or yield_strength",
            "yield_strength = \"355 MPa\"",
        ],
    );
    let space = format!("{SPACE}{HINGES}\n");
    says(
        &space.replace("8 MN", "22 MN"),
        &["hinges.column", "column.1.1.1", "exceeds the 5292 kN"],
    );
    says(
        &space.replace(weak, ""),
        &["hinges.column.yield", "yield_strength"],
    );
    says(
        &space.replace(
            "axis = \"weak\", yield_strength = \"355 MPa\"",
            "axis = \"weak\"",
        ),
        &["hinges.column", "column.2.1.1 no yield_strength"],
    );
    let lines = format!("{FRAMES}{HINGES}\n");
    says(
        &lines.replace("50 t/m", "200 t/m"),
        &["frame[0].hinges.column", "column 1 of storey 1", "exceeds"],
    );
}
