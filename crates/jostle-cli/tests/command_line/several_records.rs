//! Models that list several records: a study and the search for the gap take all, and a study says whether they serve.
//! Runs of all records are in `suite.rs`.

use std::path::Path;

use crate::common::{complained, folder, jostle, printed};
use jostle_testkit::two_towers;
use serde_json::Value;

const TOWERS: &str = concat!(
    r#"
[motion]
record = ["el-centro-1940-ns", "nanjing-artificial", "noise.csv"]
"#,
    two_towers!(3, 2),
    "[analysis]\ntolerance = 0.01\n",
);
const SPECTRUM: &str = r#"spectrum = { code = "gb50011", intensity = 7, site = "II", group = 1 }"#;
const CODE: [&str; 8] = [
    "--code",
    "gb50011",
    "--intensity",
    "7",
    "--site",
    "II",
    "--group",
    "1",
];

/// A folder with the towers, their third record and a study.
fn workplace(study: &str) -> tempfile::TempDir {
    let place = folder();
    let made = jostle(
        place.path(),
        &["motion", "synth", "noise", "--pga", "1", "-o", "noise.csv"],
    );
    assert!(made.status.success(), "{}", complained(&made));
    for (name, text) in [("towers.toml", TOWERS), ("study.toml", study)] {
        std::fs::write(place.path().join(name), text).expect("written");
    }
    place
}

fn good(folder: &Path, arguments: &[&str]) -> String {
    let output = jostle(folder, arguments);
    assert!(
        output.status.success(),
        "{arguments:?}: {}",
        complained(&output)
    );
    printed(&output)
}

fn json_of(folder: &Path, arguments: &[&str]) -> Value {
    serde_json::from_str(&good(folder, arguments)).expect("JSON")
}

fn selection_of(folder: &Path) -> Value {
    let text = std::fs::read_to_string(folder.join("out/selection.json")).expect("selection.json");
    serde_json::from_str(&text).expect("JSON")
}

#[test]
fn a_run_takes_the_one_asked_for_and_a_check_reads_all() {
    let place = workplace("");
    let arguments = ["run", "towers.toml", "--record", "noise.csv", "--json"];
    let summary = json_of(place.path(), &arguments);
    assert_eq!(summary["motion"]["name"], "noise");
    let checked = good(place.path(), &["check", "towers.toml"]);
    for part in ["el-centro-1940-ns", "nanjing-artificial", "noise", "valid"] {
        assert!(checked.contains(part), "{part} is missing:\n{checked}");
    }
    assert!(
        json_of(place.path(), &["modes", "towers.toml", "--json"])["buildings"].is_array(),
        "modes need no record"
    );
    std::fs::remove_file(place.path().join("noise.csv")).expect("removed");
    let lost = jostle(place.path(), &["check", "towers.toml"]);
    assert_eq!(lost.status.code(), Some(2));
    assert!(complained(&lost).contains("there is no record \"noise.csv\""));
}

#[test]
fn the_search_for_the_gap_takes_all() {
    let place = workplace("");
    let arguments = ["gap", "towers.toml", "--no-outcomes", "--json"];
    let found = json_of(place.path(), &arguments);
    let motions: Vec<&str> = found["gaps"]
        .as_array()
        .into_iter()
        .flatten()
        .filter_map(|gap| gap["motion"].as_str())
        .collect();
    assert_eq!(
        motions,
        ["el-centro-1940-ns", "nanjing-artificial", "noise"]
    );
    assert_eq!(found["sets"][0]["records"], 3);
}

#[test]
fn a_study_says_of_its_records_what_the_command_says() {
    let study = format!(
        "base = \"towers.toml\"\n[selection]\n{SPECTRUM}\nperiods = [\"0.8 s\", 0.25]\nmass_ratios = [0.8, 0.12]\n"
    );
    let place = workplace(&study);
    let said = good(place.path(), &["study", "study.toml", "--out", "out"]);
    let mut arguments = vec![
        "motion",
        "select",
        "--natural",
        "el-centro-1940-ns,noise.csv",
        "--artificial",
        "nanjing-artificial",
        "--periods",
        "0.8,0.25",
        "--mass-ratios",
        "0.8,0.12",
        "--json",
    ];
    arguments.extend(CODE);
    let output = jostle(place.path(), &arguments);
    // The set does not meet the clause.
    assert_eq!(output.status.code(), Some(1), "{}", complained(&output));
    let mut command: Value = serde_json::from_str(&printed(&output)).expect("nothing but JSON");
    let checked = selection_of(place.path());
    let mut ours = checked["structures"][0].clone();
    assert_eq!(checked["passes"], command["passes"]);
    // The command lists recorded motions first, and calls files by their stems.
    let sorted = |value: &mut Value| {
        let motions = value["motions"].as_array_mut().expect("motions");
        for motion in motions.iter_mut() {
            let name = motion["name"].as_str().unwrap_or_default().to_owned();
            motion["name"] = name.trim_end_matches(".csv").into();
        }
        motions.sort_by_key(|motion| motion["name"].to_string());
    };
    sorted(&mut ours);
    sorted(&mut command);
    assert_eq!(ours["motions"], command["motions"]);
    for key in [
        "periods_s",
        "code_m_s2",
        "enough",
        "mean_agrees",
        "base_shear_agrees",
        "long_enough",
        "passes",
    ] {
        assert_eq!(ours[key], command[key], "{key}");
    }
    // The order of a sum moves its last digit.
    for k in 0..2 {
        let [ours, theirs] = [&ours, &command].map(|of| of["mean_m_s2"][k].as_f64().unwrap_or(0.0));
        assert!((ours / theirs - 1.0).abs() < 1e-12, "{ours} {theirs}");
    }

    let page = std::fs::read_to_string(place.path().join("out/report.html")).expect("a report");
    for part in [
        "Selection of ground motions",
        "Main periods",
        "2 recorded and 1 artificial",
        "selection.json",
    ] {
        assert!(page.contains(part), "{part} is missing");
    }
    assert!(said.contains("GB 50011, clause 5.1.2"), "{said}");
    let rows = std::fs::read_to_string(place.path().join("out/selection.csv")).expect("a table");
    assert_eq!(rows.lines().count(), 1 + 3 * 2, "{rows}");
}

#[test]
fn main_periods_are_those_of_every_building() {
    let study = format!(
        "base = \"towers.toml\"\n[selection]\n{SPECTRUM}\nartificial = [\"noise.csv\"]\n[[vary]]\npath = \"gap[0].width\"\nvalues = [0.01, 0.02]\n"
    );
    let place = workplace(&study);
    let said = good(place.path(), &["study", "study.toml", "--out", "out"]);
    assert!(said.contains("for A, B."), "{said}");
    let checked = selection_of(place.path());
    let modes = json_of(place.path(), &["modes", "towers.toml", "--json"]);
    for (index, name) in ["A", "B"].into_iter().enumerate() {
        let structure = &checked["structures"][index];
        assert_eq!(structure["structure"], name);
        // One recorded motion is too few.
        assert_eq!(structure["enough"], false);
        let periods = structure["periods_s"].as_array().expect("periods");
        assert!(!periods.is_empty() && periods.len() <= 3, "{periods:?}");
        for (k, period) in periods.iter().enumerate() {
            let known = modes["buildings"][index]["periods_s"][k].as_f64();
            let ratio = period.as_f64().unwrap_or(0.0) / known.unwrap_or(1.0);
            assert!((ratio - 1.0).abs() < 1e-9, "{name}: {period}");
        }
    }
}

#[test]
fn matched_records_are_checked_unasked_and_others_are_not() {
    let place = workplace("base = \"towers.toml\"\n");
    good(place.path(), &["study", "study.toml", "--out", "plain"]);
    assert!(!place.path().join("plain/selection.json").exists());
    let matched =
        format!("]\nmatch = {{ {SPECTRUM}, at = \"0.5 s\" }}\n[[building]]\nname = \"A\"");
    let model = TOWERS.replace("]\n[[building]]\nname = \"A\"", &matched);
    std::fs::write(place.path().join("towers.toml"), model).expect("written");
    good(place.path(), &["study", "study.toml", "--out", "out"]);
    let checked = selection_of(place.path());
    let peaks: Vec<f64> = checked["structures"][0]["motions"]
        .as_array()
        .into_iter()
        .flatten()
        .filter_map(|motion| motion["pga_m_s2"].as_f64())
        .collect();
    assert_eq!(peaks.len(), 3);
    assert!(
        peaks.iter().any(|peak| (peak - 0.35).abs() > 0.01),
        "{peaks:?}"
    );
    let page = std::fs::read_to_string(place.path().join("out/report.html")).expect("a report");
    assert!(page.contains("scaled by match of the model"));
}

#[test]
fn wrong_selections_name_the_key() {
    for (wrong, part) in [
        ("", "selection.spectrum: is missing"),
        (
            "spectrum = { code = \"gb50011\", intensity = 5 }",
            "selection.spectrum.intensity: must be one of 6",
        ),
        (
            &format!("{SPECTRUM}\nartificial = [\"taft.at2\"]"),
            "selection.artificial: the study has no record \"taft.at2\"",
        ),
        (
            &format!("{SPECTRUM}\nperiods = [1, 2]\nmass_ratios = [1]"),
            "selection.mass_ratios: 1 values for 2 periods",
        ),
        (
            &format!("{SPECTRUM}\npga = 1\nunscaled = true"),
            "selection.pga: cannot be combined with unscaled",
        ),
        (
            &format!("{SPECTRUM}\ndamping = 1.5"),
            "selection.damping: must lie from 0 to below 1",
        ),
        (
            &format!("{SPECTRUM}\nperiod = [1]"),
            "did you mean \"periods\"",
        ),
    ] {
        let place = workplace(&format!("base = \"towers.toml\"\n[selection]\n{wrong}\n"));
        let output = jostle(place.path(), &["study", "study.toml", "--check"]);
        assert_eq!(output.status.code(), Some(2), "{wrong}");
        let text = complained(&output);
        assert!(text.contains(part), "{wrong}:\n{text}");
    }
}
