//! Options without a unit, models that cannot be meant, and what the commands say of them.

use std::path::Path;

use crate::common::{complained, folder, jostle, printed};
use serde_json::Value;

const FRAMES: &str = r#"
title = "Frames"

[motion]
record = "el-centro-1940-ns"
pga = "2 m/s2"
duration = "3 s"

[[building]]
name = "A"
storeys = 3
storey_height = "3.2 m"
spans = ["6 m"]
column = { width = "500 mm", depth = "500 mm" }
beam = { width = "300 mm", depth = "600 mm" }
elastic_modulus = "30 GPa"
beam_mass = "3600 kg/m"

[[building]]
name = "B"
storey_height = ["3.2 m", "3.6 m", "3.2 m"]
spans = ["4 m"]
column = { width = "500 mm", depth = "500 mm" }
beam = { width = "300 mm", depth = "600 mm" }
elastic_modulus = "30 GPa"
beam_mass = "3600 kg/m"

[[gap]]
between = ["A", "B"]
width = "20 mm"
"#;

fn write(folder: &Path, text: &str) {
    std::fs::write(folder.join("m.toml"), text).expect("a file");
}

/// The complaint of a command that must end with exit code 2 and print nothing.
fn refused(folder: &Path, arguments: &[&str]) -> String {
    let output = jostle(folder, arguments);
    let shown = complained(&output);
    assert_eq!(output.status.code(), Some(2), "{arguments:?}: {shown}");
    assert_eq!(printed(&output), "", "{arguments:?}");
    shown
}

#[test]
fn quantities_of_options_need_a_unit() {
    let folder = folder();
    let cases: &[(&[&str], &[&str])] = &[
        (&["run", "--pga", "0.35"], &["--pga:", "--pga 0.35g"]),
        (&["run", "--pga", "220"], &["--pga:", "--pga 220cm/s2"]),
        (&["run", "--gap", "100"], &["--gap:", "--gap 100mm"]),
        (&["check", "--gap", "100"], &["--gap:", "--gap 100mm"]),
        (&["gap", "--pga", "0.35"], &["--pga:", "--pga 0.35g"]),
        (
            &["gap", "--tolerance", "0.1"],
            &["--tolerance:", "--tolerance 0.1mm"],
        ),
        (
            &["export", "--to", "openseespy", "--gap", "100"],
            &["--gap:", "--gap 100mm"],
        ),
        (
            &["run", "--gap", "100 m"],
            &["a gap of 100 m", "is it 100 mm?"],
        ),
    ];
    for (arguments, parts) in cases {
        let shown = refused(folder.path(), arguments);
        for part in *parts {
            assert!(shown.contains(part), "\"{part}\" in {shown}");
        }
    }
    assert!(
        !folder.path().join("jostle-out").exists(),
        "nothing is written"
    );
    // Zero is zero in every unit, and collide takes numbers in SI.
    for arguments in [
        &["check", "--gap", "0", "--pga", "0.35g"][..],
        &[
            "collide", "--m1", "40e3", "--m2", "60e3", "--speed", "0.5", "--json",
        ],
    ] {
        let output = jostle(folder.path(), arguments);
        assert!(
            output.status.success(),
            "{arguments:?}: {}",
            complained(&output)
        );
    }
}

#[test]
fn warnings_reach_check_run_and_gap_and_leave_json_alone() {
    let folder = folder();
    write(folder.path(), FRAMES);
    let part = "gap[0].floors: floors 2, 3 of \"A\" and floor 2 of \"B\" stand beside";
    let output = jostle(folder.path(), &["check", "m.toml"]);
    assert!(printed(&output).contains(part), "{}", printed(&output));

    let output = jostle(folder.path(), &["run", "m.toml", "--json", "--no-report"]);
    assert!(
        complained(&output).contains(part),
        "{}",
        complained(&output)
    );
    let summary: Value = serde_json::from_str(&printed(&output)).expect("nothing but JSON");
    let noted = |value: &Value| {
        let notes = value["notes"].as_array().expect("notes");
        notes
            .iter()
            .any(|note| note.as_str().is_some_and(|note| note.contains(part)))
    };
    assert!(noted(&summary), "{}", summary["notes"]);
    assert_eq!(summary["warnings"], serde_json::json!([]));

    let output = jostle(folder.path(), &["run", "m.toml", "--out", "r"]);
    assert!(
        complained(&output).contains(part),
        "{}",
        complained(&output)
    );
    assert!(
        !printed(&output).contains(part),
        "said once: {}",
        printed(&output)
    );
    let text = std::fs::read_to_string(folder.path().join("r/summary.json")).expect("a summary");
    assert!(noted(&serde_json::from_str(&text).expect("JSON")));

    let arguments = ["gap", "m.toml", "--json", "--no-outcomes"];
    let output = jostle(folder.path(), &arguments);
    assert!(
        complained(&output).contains(part),
        "{}",
        complained(&output)
    );
    let found: Value = serde_json::from_str(&printed(&output)).expect("nothing but JSON");
    assert!(noted(&found), "{found}");
}

#[test]
fn all_floors_see_impacts_that_common_floors_leave_out() {
    let folder = folder();
    let impacts = |text: &str| {
        write(folder.path(), text);
        let output = jostle(folder.path(), &["run", "m.toml", "--json", "--no-report"]);
        let summary: Value = serde_json::from_str(&printed(&output)).expect("JSON");
        let noted = complained(&output).contains("gap[0].floors");
        (
            summary["gaps"][0]["impact_count"]
                .as_u64()
                .expect("a count"),
            noted,
        )
    };
    let narrow = FRAMES.replace("20 mm", "2 mm");
    let (common, noted) = impacts(&narrow);
    assert!(noted);
    let (all, noted) = impacts(&format!("{narrow}floors = \"all\"\n"));
    assert!(!noted);
    assert!(
        all > common,
        "{all} impacts with all floors, {common} with common ones"
    );
}

#[test]
fn an_indentation_that_concrete_does_not_allow_is_noted() {
    let folder = folder();
    let soft = FRAMES.replace("20 mm", "2 mm").replace("2 m/s2", "10 m/s2")
        + "floors = \"all\"\nlaw = \"linear\"\nstiffness = \"200 kN/m\"\n";
    write(folder.path(), &soft);
    let output = jostle(folder.path(), &["run", "m.toml", "--no-report"]);
    let summary = folder.path().join("jostle-out/m/summary.json");
    let told = std::fs::read_to_string(summary).expect("it is written");
    let found: Value = serde_json::from_str(&told).expect("JSON");
    let checks = found["checks"].as_array().expect("a list").iter();
    let mut deep = checks.filter(|check| check["name"] == "indentation");
    assert_eq!(
        deep.next().map(|own| &own["grade"]),
        Some(&Value::from("warning")),
        "{told}"
    );
    let warned = complained(&output);
    assert!(
        warned.contains("gap[0].stiffness: the contact is softer than a storey"),
        "{warned}"
    );
}

#[test]
fn a_run_that_would_not_end_is_refused_with_its_cause() {
    let folder = folder();
    let endless = FRAMES.replace(
        "beam_mass = \"3600 kg/m\"\n\n[[building]]",
        "beam_mass = \"3600 kg/m\"\nstiffness_factor = 99999999999999999999999\n\n[[building]]",
    );
    assert_ne!(endless, FRAMES);
    write(folder.path(), &endless);
    let shown = refused(folder.path(), &["check", "m.toml"]);
    assert!(
        shown.contains("building[0].stiffness_factor: a stiffness factor of 1e23"),
        "{shown}"
    );

    // A shear building has no such factor; its stiffness is the cause.
    let shear = "[motion]\nrecord = \"el-centro-1940-ns\"\n[[building]]\nname = \"Stiff\"\nkind = \"shear\"\nmass = [\"40 t\", \"40 t\"]\nstiffness = \"60e20 MN/m\"\nstorey_height = 3\n";
    write(folder.path(), shear);
    for command in [&["check", "m.toml"][..], &["run", "m.toml"]] {
        let shown = refused(folder.path(), command);
        for part in [
            "m.toml:3:",
            "building[0]: the run would take",
            "a lateral period of \"Stiff\" is",
            "storey stiffnesses up to 6.00e27 N/m",
            "accept_unusual = true under [analysis]",
        ] {
            assert!(shown.contains(part), "\"{part}\" in {shown}");
        }
    }
    let meant = jostle(folder.path(), &["check", "m.toml", "--accept-unusual"]);
    assert!(meant.status.success(), "{}", complained(&meant));
    assert!(!printed(&meant).contains(" 0.0000"), "{}", printed(&meant));
}

#[test]
fn numbers_that_cannot_be_computed_are_errors_with_their_cause() {
    let folder = folder();
    // A beam of 10 000 km is so flexible that the periods are lost in rounding.
    let wide = "[motion]\nrecord = \"el-centro-1940-ns\"\n[[building]]\nname = \"High\"\nstoreys = 10\nstorey_height = \"3.2 m\"\nspans = [\"6 m\", \"3 m\", \"1e7 m\"]\ncolumn = { width = \"600 mm\", depth = \"600 mm\" }\nbeam = { width = \"300 mm\", depth = \"600 mm\" }\nconcrete = \"C40\"\nbeam_mass = \"4500 kg/m\"\n";
    write(folder.path(), wide);
    let shown = refused(folder.path(), &["check", "m.toml"]);
    assert!(
        shown.contains("building[0].spans[2]: a span of 1e7 m"),
        "{shown}"
    );
    for command in ["check", "run"] {
        let shown = refused(folder.path(), &[command, "m.toml", "--accept-unusual"]);
        assert!(
            shown.contains("building[0]: the period of lateral mode"),
            "{shown}"
        );
        assert!(shown.contains("(beam of floor 1, span 3)"), "{shown}");
        assert!(!shown.contains("NaN"), "{shown}");
    }
}

#[test]
fn check_names_the_modes_that_are_damped() {
    let folder = folder();
    write(folder.path(), FRAMES);
    let told = printed(&jostle(folder.path(), &["check", "m.toml"]));
    assert!(
        told.contains("Rayleigh damping 5 % in lateral modes 1 and 3: α ="),
        "{told}"
    );
}
