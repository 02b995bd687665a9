//! What the commands print and write.

use std::path::Path;

#[cfg(unix)]
use crate::common::command;
use crate::common::{complained, folder, jostle, printed};
use serde_json::Value;

fn summary_of(folder: &Path) -> Value {
    let text = std::fs::read_to_string(folder.join("summary.json")).expect("summary.json is there");
    serde_json::from_str(&text).expect("summary.json is JSON")
}

#[test]
fn run_without_a_model_runs_the_example_and_writes_everything() {
    let folder = folder();
    let output = jostle(folder.path(), &["run"]);
    assert!(output.status.success(), "{}", complained(&output));
    let text = printed(&output);
    for part in [
        "J1",
        "J2",
        "1 impact",
        "No code selected",
        "jostle-out/paper/report.html",
    ] {
        assert!(text.contains(part), "\"{part}\" should stand in:\n{text}");
    }
    assert!(
        text.lines().count() <= 24,
        "the summary should fit one screen:\n{text}"
    );
    assert!(!text.contains('\u{1b}'), "no colours in a pipe");
    assert_eq!(complained(&output), "", "no progress bar in a pipe");
    let results = folder.path().join("jostle-out/paper");
    for file in [
        "summary.json",
        "history.parquet",
        "impacts.parquet",
        "report.html",
    ] {
        let size = std::fs::metadata(results.join(file)).expect(file).len();
        assert!(size > 100, "{file} has {size} bytes");
    }
    let size = std::fs::metadata(results.join("report.html"))
        .expect("report")
        .len();
    assert!(size < 1_000_000, "the report has {size} bytes");
}

#[test]
fn a_folder_with_the_name_of_the_example_does_not_hide_it() {
    let folder = folder();
    std::fs::create_dir(folder.path().join("paper")).expect("a folder");
    for arguments in [
        &["run", "--json"][..],
        &["run", "paper", "--json", "--accept-unusual"],
    ] {
        let output = jostle(folder.path(), arguments);
        assert!(output.status.success(), "{}", complained(&output));
    }
}

#[test]
fn summary_has_the_shape_of_the_contract() {
    let folder = folder();
    let output = jostle(
        folder.path(),
        &["run", "--json", "--pga", "70 cm/s2", "--gap", "10 mm"],
    );
    assert!(output.status.success(), "{}", complained(&output));
    let summary: Value = serde_json::from_str(&printed(&output)).expect("nothing but JSON");
    assert!(
        !folder.path().join("jostle-out").exists(),
        "--json alone writes no files"
    );
    let pointers = [
        "/title",
        "/jostle",
        "/motion/name",
        "/motion/points",
        "/motion/step_s",
        "/motion/pga_m_s2",
        "/motion/scale",
        "/buildings/0/name",
        "/buildings/0/mass_kg",
        "/buildings/0/periods_s/0",
        "/buildings/0/base_shear_peak_n",
        "/buildings/0/residual_roof_displacement_m",
        "/buildings/0/hinges/cracked",
        "/buildings/0/hinges/yielded",
        "/buildings/0/floors/4/floor",
        "/buildings/0/floors/4/height_m",
        "/buildings/0/floors/4/displacement_max_m",
        "/buildings/0/floors/4/displacement_max_at_s",
        "/buildings/0/floors/4/displacement_min_m",
        "/buildings/0/floors/4/displacement_min_at_s",
        "/buildings/0/floors/4/total_acceleration_peak_m_s2",
        "/buildings/0/floors/4/storey_drift_peak",
        "/gaps/0/between/1",
        "/gaps/0/width_m",
        "/gaps/0/impact_count",
        "/gaps/0/peak_force_n",
        "/gaps/0/first_impact_s",
        "/gaps/0/contacts/4/floors/0",
        "/gaps/0/contacts/4/height_m",
        "/gaps/0/contacts/4/closing_peak_m",
        "/gaps/0/contacts/4/closing_peak_at_s",
        "/gaps/0/contacts/4/impact_count",
        "/gaps/0/contacts/4/peak_force_n",
        "/gaps/0/contacts/4/peak_force_at_s",
        "/gaps/0/contacts/4/impulse_n_s",
        "/gaps/0/contacts/4/impacts/0/start_s",
        "/gaps/0/contacts/4/impacts/0/end_s",
        "/gaps/0/contacts/4/impacts/0/peak_force_n",
        "/gaps/0/contacts/4/impacts/0/impact_speed_m_s",
        "/gaps/0/contacts/4/impacts/0/separation_speed_m_s",
        "/gaps/0/contacts/4/impacts/0/impulse_n_s",
        "/energy/input_j",
        "/energy/kinetic_j",
        "/energy/strain_j",
        "/energy/damped_j",
        "/energy/hysteretic_j",
        "/energy/contact_j",
        "/energy/imbalance",
        "/work/steps",
        "/work/contact_steps",
        "/work/factorizations",
        "/work/solves",
        "/work/iterations",
        "/work/wall_s",
    ];
    for pointer in pointers {
        assert!(
            summary
                .pointer(pointer)
                .is_some_and(|value| !value.is_null()),
            "{pointer} is missing"
        );
    }
    // OpenSees on the same model: 2, 8 and 11 impacts on floors 3, 4 and 5.
    let counts: Vec<_> = (0..5)
        .map(|i| summary["gaps"][0]["contacts"][i]["impact_count"].as_u64())
        .collect();
    assert_eq!(counts, [0, 0, 2, 8, 11].map(Some));
}

#[test]
fn same_input_gives_the_same_files() {
    let folders = [folder(), folder()];
    for folder in &folders {
        let output = jostle(folder.path(), &["run", "--out", "r", "--no-report"]);
        assert!(output.status.success(), "{}", complained(&output));
        assert!(
            !folder.path().join("r/report.html").exists(),
            "--no-report writes no report"
        );
    }
    for file in ["history.parquet", "impacts.parquet"] {
        let [a, b] = folders
            .each_ref()
            .map(|folder| std::fs::read(folder.path().join("r").join(file)).expect(file));
        assert!(a == b, "{file} should be the same, byte for byte");
    }
    let [mut a, mut b] = folders
        .each_ref()
        .map(|folder| summary_of(&folder.path().join("r")));
    a["work"]["wall_s"] = Value::Null;
    b["work"]["wall_s"] = Value::Null;
    assert_eq!(a, b);
}

#[test]
fn every_template_checks_and_runs() {
    for template in jostle_io::TEMPLATE_NAMES {
        let folder = folder();
        let output = jostle(folder.path(), &["new", "mine", "--template", template]);
        assert!(output.status.success(), "{}", complained(&output));
        let path = folder.path().join("mine.toml");
        let text = std::fs::read_to_string(&path).expect("it was written");
        let brief = text.replacen("[motion]\n", "[motion]\nduration = \"3 s\"\n", 1);
        std::fs::write(&path, brief).expect("a file");
        for arguments in [
            vec!["check", "mine.toml"],
            vec!["run", "mine.toml", "--no-report"],
            vec!["modes", "mine.toml"],
        ] {
            let output = jostle(folder.path(), &arguments);
            assert!(
                output.status.success(),
                "{arguments:?} of {template}: {}",
                complained(&output)
            );
        }
        let again = jostle(folder.path(), &["new", "mine"]);
        assert_eq!(
            again.status.code(),
            Some(2),
            "an existing file is not overwritten"
        );
        assert!(
            complained(&again).contains("mine.toml exists already"),
            "{}",
            complained(&again)
        );
    }
}

#[test]
fn modes_as_json_list_lateral_periods_and_all_modes() {
    let folder = folder();
    let output = jostle(folder.path(), &["modes", "--json", "--count", "8"]);
    let modes: Value = serde_json::from_str(&printed(&output)).expect("nothing but JSON");
    let building = &modes["buildings"][0];
    assert_eq!(building["name"], "J1");
    for (index, period) in [0.84054, 0.27110, 0.15542].into_iter().enumerate() {
        let got = building["periods_s"][index].as_f64().expect("a period");
        assert!(
            (got / period - 1.0).abs() < 1e-4,
            "lateral period {index}: {got} instead of {period}"
        );
    }
    assert_eq!(building["modes"].as_array().map(Vec::len), Some(8));
    assert!(
        building["modes"][0]["effective_mass_ratio_x"]
            .as_f64()
            .is_some_and(|ratio| ratio > 0.8)
    );
    assert!(building["modes"][3]["effective_mass_ratio_y"].is_number());
}

#[test]
fn schema_is_json() {
    let output = jostle(folder().path(), &["schema"]);
    let schema: Value = serde_json::from_str(&printed(&output)).expect("nothing but JSON");
    assert!(schema["properties"]["building"].is_object(), "{schema}");
}

#[cfg(unix)]
#[test]
fn interrupt_keeps_what_was_computed() {
    let folder = folder();
    let paper = jostle_io::model_text("paper").expect("the example");
    let slow = "[analysis]\nstep = \"5e-6 s\"\ncontact_step = \"5e-6 s\"\n\n[motion]";
    let model = paper.replacen("[motion]", slow, 1);
    assert!(model.contains(slow), "the example has a motion");
    std::fs::write(folder.path().join("long.toml"), model).expect("a file");
    let mut run = command(folder.path(), &["run", "long.toml", "--out", "r"]);
    let child = run
        .stdout(std::process::Stdio::piped())
        .stderr(std::process::Stdio::piped())
        .spawn()
        .expect("it starts");
    std::thread::sleep(std::time::Duration::from_secs(2));
    let kill = std::process::Command::new("kill")
        .args(["-INT", &child.id().to_string()])
        .status();
    assert!(
        kill.is_ok_and(|status| status.success()),
        "the signal is sent"
    );
    let output = child.wait_with_output().expect("it ends");
    assert_eq!(output.status.code(), Some(130), "{}", complained(&output));
    let summary = summary_of(&folder.path().join("r"));
    let reason = summary["ended_early"]
        .as_str()
        .expect("it says that it ended early")
        .to_owned();
    assert!(reason.starts_with("stopped at t = "), "{reason}");
    assert!(
        summary["work"]["steps"]
            .as_u64()
            .is_some_and(|steps| steps > 0)
    );
    assert!(
        folder.path().join("r/history.parquet").exists()
            && folder.path().join("r/report.html").exists()
    );
}

#[cfg(unix)]
#[test]
fn interrupt_without_contact_keeps_the_finished_run() {
    let folder = folder();
    let paper = jostle_io::model_text("paper").expect("the example");
    let slow =
        "[analysis]\nstep = \"2e-5 s\"\ncontact_step = \"2e-5 s\"\n\n[motion]\nduration = \"3 s\"";
    let model = paper.replacen("[motion]", slow, 1);
    std::fs::write(folder.path().join("slow.toml"), model).expect("a file");
    let mut run = command(folder.path(), &["run", "slow.toml", "--out", "r"]);
    let mut child = run
        .stdout(std::process::Stdio::piped())
        .stderr(std::process::Stdio::piped())
        .spawn()
        .expect("it starts");
    // What the run with contact found is written before the other one begins.
    while !folder.path().join("r/summary.json").exists() {
        assert_eq!(
            child.try_wait().expect("a status"),
            None,
            "it ended too early"
        );
        std::thread::sleep(std::time::Duration::from_millis(2));
    }
    let kill = std::process::Command::new("kill")
        .args(["-INT", &child.id().to_string()])
        .status();
    assert!(
        kill.is_ok_and(|status| status.success()),
        "the signal is sent"
    );
    let output = child.wait_with_output().expect("it ends");
    assert_eq!(output.status.code(), Some(130), "{}", complained(&output));
    // On a slow machine a line before says how long the run takes.
    assert_eq!(
        complained(&output).lines().last(),
        Some("stopped in the run without contact; the run with contact is complete and is in r")
    );
    let summary = summary_of(&folder.path().join("r"));
    assert!(summary["ended_early"].is_null(), "{summary}");
    let notes = summary["notes"].as_array().expect("notes");
    assert!(
        notes.iter().any(|note| {
            let note = note.as_str().unwrap_or_default();
            note.starts_with("the run without contact was interrupted at t = ")
                && note.ends_with(" s of 3.000 s; there is no comparison with it")
        }),
        "{notes:?}"
    );
    assert!(printed(&output).contains("the run without contact was interrupted"));
    for name in ["history.parquet", "impacts.parquet", "report.html"] {
        assert!(folder.path().join("r").join(name).exists(), "{name}");
    }
}

#[test]
fn method_shows_where_the_product_fails_and_riccati_does_not() {
    let folder = folder();
    let output = jostle(folder.path(), &["method", "--out", "m"]);
    assert!(output.status.success(), "{}", complained(&output));
    let text = printed(&output);
    // (n − 1)(6m + 3) unknowns: two and three spans, five and ten storeys.
    assert!(
        text.contains("66 unknowns") && text.contains("189 unknowns"),
        "{text}"
    );
    assert!(
        text.contains("lost"),
        "at small steps the product has no digit left:\n{text}"
    );
    let page = std::fs::read_to_string(folder.path().join("m/method.html")).expect("a page");
    assert!(page.contains("total transfer equation"));
}

#[test]
fn the_product_is_refused_where_it_would_lose_its_digits() {
    let folder = folder();
    let paper = jostle_io::model_text("paper").expect("the example");
    let model = paper.replacen(
        "[motion]",
        "[analysis]\nsolver = \"product\"\n\n[motion]",
        1,
    );
    std::fs::write(folder.path().join("m.toml"), model).expect("a file");
    let refused = jostle(folder.path(), &["run", "m.toml"]);
    assert_eq!(refused.status.code(), Some(2));
    for part in ["analysis.solver", "digits", "riccati", "--force"] {
        assert!(
            complained(&refused).contains(part),
            "{}",
            complained(&refused)
        );
    }
    // Forced, it runs into nonsense, and says so: by its energies, and by failing where numbers overflow.
    let forced = jostle(folder.path(), &["run", "m.toml", "--force", "--no-report"]);
    let said = printed(&forced) + &complained(&forced);
    assert!(said.contains("do not trust this run"), "{said}");
}

/// A shear building that yields and leans.
const SWAYING: &str = r#"title = "swaying"
[[building]]
name = "S"
kind = "shear"
mass = ["60 t", "50 t"]
stiffness = ["60 MN/m", "50 MN/m"]
storey_height = ["4 m", "3 m"]
p_delta = true
hinges = { rule = "peak-oriented", cracking = "4 mm", yield = "15 mm", post_cracking = 0.4, post_yield = 0.005 }
"#;

const PANELS: &str = r#"
[[building]]
name = "P"
storeys = 2
storey_height = "3.3 m"
spans = ["6 m"]
concrete = "C30"
column = { width = "400 mm", depth = "400 mm" }
beam = { width = "300 mm", depth = "500 mm" }
floor_mass = "30 t"
[[building.infill]]
modulus = "4 GPa"
thickness = "200 mm"
width = "mainstone"
"#;

/// Struts of panels bear compression alone: half of them crack and reach their strength; those without a strength do nothing.
#[test]
fn a_pushover_counts_struts_by_what_becomes_of_them() {
    let strength = "strength = { rule = \"bertoldi\", compression = \"4 MPa\", shear = \"0.3 MPa\", sliding = \"0.2 MPa\" }\n";
    let pushed = |more: &str| {
        let folder = folder();
        std::fs::write(folder.path().join("p.toml"), format!("{PANELS}{more}")).expect("a file");
        let output = jostle(
            folder.path(),
            &["pushover", "p.toml", "--direction", "right"],
        );
        assert!(output.status.success(), "{}", complained(&output));
        printed(&output)
    };
    let text = pushed(strength);
    assert!(
        text.contains("2 of 4 infill struts crack, 2 reach their strength"),
        "{text}"
    );
    assert!(!text.contains("none") && !text.contains("hinges"), "{text}");
    let text = pushed("");
    assert!(
        text.contains("its infill struts have no strength"),
        "{text}"
    );
    assert!(
        !text.contains("first yield") && !text.contains("hinges"),
        "{text}"
    );
}

#[test]
fn pushover_tells_strength_and_writes_the_curve() {
    let folder = folder();
    std::fs::write(folder.path().join("s.toml"), SWAYING).expect("a model file");
    let output = jostle(
        folder.path(),
        &[
            "pushover",
            "s.toml",
            "--direction",
            "both",
            "--drift",
            "3 %",
            "--pattern",
            "uniform",
        ],
    );
    assert!(output.status.success(), "{}", complained(&output));
    let text = printed(&output);
    for part in [
        "pushed to the left",
        "first yield",
        "FEMA 356",
        "storey 1",
        "pushover.html",
    ] {
        assert!(text.contains(part), "\"{part}\" should stand in:\n{text}");
    }
    let results = folder.path().join("jostle-out/s");
    let table = std::fs::read_to_string(results.join("pushover.csv")).expect("a table");
    let header = table.lines().next().expect("a header");
    assert!(
        header.starts_with("building,direction,point,roof_displacement_m,roof_drift,base_shear_n")
    );
    assert!(header.ends_with("storey1_drift,storey2_drift,events"));
    assert!(table.contains("storey 1 yields"), "{table}");
    let json = std::fs::read_to_string(results.join("pushover.json")).expect("JSON");
    let json: Value = serde_json::from_str(&json).expect("JSON");
    let curves = json["curves"].as_array().expect("curves");
    assert_eq!(curves.len(), 2);
    // By hand: storey 1 carries all of the load, and P-Delta takes (60 t + 50 t) g / 4 m from it.
    let force = 60e6 * (0.004 + 0.4 * 0.011) - 110e3 * 9.80665 / 4.0 * 0.015;
    let yields = curves[0]["first_yield"]["base_shear_n"]
        .as_f64()
        .expect("a number");
    assert!((yields / force - 1.0).abs() < 1e-12, "{yields} {force}");
    assert_eq!(curves[0]["peak"], curves[1]["peak"]);
    assert_eq!(curves[0]["end"]["target_reached"], Value::Bool(true));
}

#[test]
fn pushover_says_what_is_wrong() {
    let folder = folder();
    for (arguments, remedy) in [
        (["--building", "J9"], "it has \"J1\", \"J2\""),
        (["--drift", "0"], "must lie above 0"),
        (["--drift", "3 mm"], "--drift"),
    ] {
        let output = jostle(folder.path(), &[&["pushover"], &arguments[..]].concat());
        assert_eq!(output.status.code(), Some(2));
        assert!(
            complained(&output).contains(remedy),
            "{}",
            complained(&output)
        );
    }
    let elastic = jostle(folder.path(), &["pushover", "--json"]);
    assert!(elastic.status.success());
    let json: Value = serde_json::from_str(&printed(&elastic)).expect("nothing but JSON");
    assert_eq!(json["curves"][0]["hinges"], 0);
    assert!(!folder.path().join("jostle-out").exists());
}

const WALLED: &str = r#"
title = "Between walls"
[motion]
kind = "sine"
amplitude = "3 m/s2"
period = "0.6 s"
duration = "4 s"
[[building]]
name = "A"
kind = "shear"
mass = ["90 t", "90 t"]
stiffness = "60 MN/m"
storey_height = "3 m"
[[building]]
name = "B"
kind = "shear"
mass = ["90 t", "90 t", "90 t"]
stiffness = "90 MN/m"
storey_height = "3 m"
[[gap]]
between = ["A", "B"]
width = ["20 mm", "10 mm"]
[[gap]]
between = ["wall", "A"]
width = "15 mm"
floors = [["wall", 2]]
[[link]]
between = ["A", "B"]
floors = [[2, 2]]
damping = "600 kN.s/m"
stiffness = "2 MN/m"
"#;

#[test]
fn walls_widths_and_links_are_described_and_computed() {
    let folder = folder();
    std::fs::write(folder.path().join("m.toml"), WALLED).expect("written");
    let text = printed(&jostle(folder.path(), &["check", "m.toml"]));
    for part in [
        "A ↔ B",
        "gap 20.0, 10.0 mm, 2 contacts at 3.00, 6.00 m",
        "wall ↔ A",
        "gap 15.0 mm, 1 contact at 6.00 m",
        "colliding masses at the highest contact: a rigid wall and 90.0 t",
        "A ↔ B",
        "1 link at 6.00 m with 2 MN/m and 600 kN·s/m",
    ] {
        assert!(text.contains(part), "\"{part}\" should stand in:\n{text}");
    }
    let output = jostle(folder.path(), &["run", "m.toml", "--out", "out"]);
    assert!(output.status.success(), "{}", complained(&output));
    let text = printed(&output);
    for part in [
        "wall ↔ A, 15.0 mm apart",
        "A ↔ B, 1 link: peak ",
        "kJ dissipated",
    ] {
        assert!(text.contains(part), "\"{part}\" should stand in:\n{text}");
    }
    let summary = summary_of(&folder.path().join("out"));
    assert_eq!(
        summary["gaps"][1]["between"],
        serde_json::json!(["wall", "A"])
    );
    assert_eq!(summary["gaps"][0]["contacts"][1]["width_m"], 0.01);
    let (link, energy) = (&summary["links"][0], &summary["energy"]);
    let number = |value: &Value| value.as_f64().expect("a number");
    assert!(number(&link["peak_force_n"]) > 0.0);
    assert!((number(&link["dissipated_j"]) / number(&energy["links_j"]) - 1.0).abs() < 1e-9);
    // The contract: what was put in is the sum of the five.
    let names = [
        "kinetic_j",
        "strain_j",
        "damped_j",
        "hysteretic_j",
        "contact_j",
    ];
    let sum: f64 = names.iter().map(|name| number(&energy[*name])).sum();
    assert!((sum / number(&energy["input_j"]) - 1.0).abs() < 1e-9);
}

/// A low frame beside a tower whose slabs strike its columns.
const SLABS_AGAINST_COLUMNS: &str = r#"
title = "Slabs against columns"

[motion]
record = "el-centro-1940-ns"
pga = "0.3 g"
duration = "4 s"

[[building]]
name = "Low"
kind = "frame"
storeys = 2
storey_height = "3.2 m"
spans = ["6 m", "6 m"]
column = { width = "500 mm", depth = "500 mm" }
beam = { width = "300 mm", depth = "600 mm" }
concrete = "C30"
beam_mass = "4500 kg/m"

[[building]]
name = "Tower"
kind = "frame"
storeys = 2
storey_height = ["4.4 m", "3.2 m"]
spans = ["5 m"]
column = { width = "300 mm", depth = "300 mm" }
beam = { width = "300 mm", depth = "600 mm" }
concrete = "C30"
beam_mass = "4500 kg/m"

[[gap]]
between = ["Low", "Tower"]
width = "2 mm"
floors = [["4.4 m", 1], [2, "6.4 m"]]
"#;

#[test]
fn forces_of_members_are_there_when_asked_for() {
    let folder = folder();
    let write = |name: &str, text: &str| {
        std::fs::write(folder.path().join(name), text).expect("written");
    };
    write("plain.toml", SLABS_AGAINST_COLUMNS);
    let summary = |args: &[&str]| -> Value {
        let output = jostle(folder.path(), args);
        assert!(output.status.success(), "{}", complained(&output));
        serde_json::from_str(&printed(&output)).expect("a summary")
    };
    let silent = summary(&["run", "plain.toml", "--json"]);
    assert!(silent["buildings"][0].get("members").is_none());
    let all = summary(&["run", "plain.toml", "--json", "--members"]);
    let low = &all["buildings"][0];
    let members = low["members"].as_array().expect("asked for");
    assert_eq!(members.len(), 2 * 3 + 2 * 2);
    assert_eq!(members[0]["name"], "Low.column.1.1");
    assert_eq!(members[0]["ends"][0]["at"], "foot");
    let named = |name: &str| members.iter().find(|m| m["name"] == name).expect("there");
    let struck = named("Low.column.3.2")["struck"]
        .as_array()
        .expect("a list");
    assert_eq!(struck.len(), 1);
    assert_eq!(struck[0]["height_m"], 4.4);
    let hits = all["gaps"][0]["contacts"][0]["impact_count"].as_u64();
    assert!(hits > Some(0));
    assert_eq!(struck[0]["impact_count"].as_u64(), hits);
    assert_eq!(
        struck[0]["peak_force_n"],
        all["gaps"][0]["contacts"][0]["peak_force_n"]
    );
    for side in ["below", "above"] {
        assert!(struck[0][side]["shear_peak_n"].as_f64() > Some(1e3));
    }
    // The other results are as they were.
    let base = |summary: &Value| summary["buildings"][1]["base_shear_peak_n"].as_f64();
    let (a, b) = (
        base(&silent).expect("a number"),
        base(&all).expect("a number"),
    );
    assert!((a / b - 1.0).abs() < 1e-3, "{a} and {b}");

    let list = "\n[output]\nmembers = [\"Low.column.3.2\", \"Low.beam.2.1\"]\n";
    write("named.toml", &format!("{SLABS_AGAINST_COLUMNS}{list}"));
    let output = jostle(folder.path(), &["run", "named.toml", "--out", "named"]);
    assert!(output.status.success(), "{}", complained(&output));
    let table = std::fs::metadata(folder.path().join("named/members.parquet")).expect("written");
    assert!(table.len() > 1000);
    let report = std::fs::read_to_string(folder.path().join("named/report.html")).expect("written");
    assert!(report.contains("Columns and beams of Low") && report.contains("Low.column.3.2"));
}

#[test]
fn members_that_do_not_exist_are_refused() {
    let folder = folder();
    for (value, expected) in [
        (
            "[\"Low.column.4.1\"]",
            "is no member of \"Low\"; it has Low.column.LINE.STOREY with line 1…3 and storey 1…2",
        ),
        ("[\"Lwo.beam.1.1\"]", "begins with the name of no building"),
        ("[\"Tower.beam.1.01\"]", "is no member of \"Tower\""),
        ("3", "expected true, false or a list of members"),
    ] {
        let text = format!("{SLABS_AGAINST_COLUMNS}\n[output]\nmembers = {value}\n");
        std::fs::write(folder.path().join("wrong.toml"), text).expect("written");
        let output = jostle(folder.path(), &["run", "wrong.toml"]);
        assert_eq!(output.status.code(), Some(2));
        let said = complained(&output);
        assert!(
            said.contains(expected) && said.contains("output.members"),
            "{said}"
        );
    }
}
