//! Buildings in space on the command line: faces and site of `check`, and the study of the angle of incidence.

use std::path::Path;

use crate::common::{complained, folder, jostle, printed};

const TOWERS: &str = r#"
title = "Two in space"
[motion]
record = "el-centro-1940-ns"
pga = "0.3 g"
duration = "5 s"
across = { kind = "sine", amplitude = "1 m/s2", period = "0.6 s", duration = "5 s" }
[[building]]
name = "West"
kind = "shear"
plan = [["0 m", "0 m"], ["20 m", "0 m"], ["20 m", "8 m"], ["9 m", "8 m"], ["9 m", "15 m"], ["0 m", "15 m"]]
mass = ["250 t", "250 t"]
storey_height = "3.2 m"
stiffness = { x = "160 MN/m", y = "185 MN/m" }
[[building]]
name = "East"
kind = "shear"
plan = ["12 m", "9 m"]
at = ["20.02 m", "2 m"]
mass = ["120 t", "120 t"]
storey_height = "3.2 m"
stiffness = "250 MN/m"
[[gap]]
between = ["West", "East"]
"#;

fn workplace() -> tempfile::TempDir {
    let folder = folder();
    std::fs::write(folder.path().join("towers.toml"), TOWERS).expect("a file");
    folder
}

fn read(path: &Path) -> String {
    std::fs::read_to_string(path).unwrap_or_else(|error| panic!("{}: {error}", path.display()))
}

#[test]
fn check_lists_faces_by_their_edges_and_draws_the_site() {
    let folder = workplace();
    let output = jostle(folder.path(), &["check", "towers.toml"]);
    assert!(output.status.success(), "{}", complained(&output));
    let text = printed(&output);
    for part in [
        "no.  kind  West      East",
        "1  face  edge 2–3  edge 4–1  1 to 2  6.000 m  20.0 mm  +1.000, +0.000  20.010 m, 5.000 m",
        "The model is valid.",
        "→ jostle-out/towers/site.svg",
    ] {
        assert!(text.contains(part), "\"{part}\" should stand in:\n{text}");
    }
    let drawing = read(&folder.path().join("jostle-out/towers/site.svg"));
    assert!(drawing.starts_with("<svg ") && drawing.contains("1: 20.0 mm"));
    // Its own file is replaced, another one is not.
    let again = jostle(folder.path(), &["check", "towers.toml"]);
    assert!(again.status.success(), "{}", complained(&again));
    std::fs::write(folder.path().join("site.svg"), "mine, and long enough").expect("a file");
    let arguments = ["check", "towers.toml", "--out", "."];
    let kept = jostle(folder.path(), &arguments);
    assert_eq!(kept.status.code(), Some(2));
    assert!(
        complained(&kept).contains("--force"),
        "{}",
        complained(&kept)
    );
    assert_eq!(
        read(&folder.path().join("site.svg")),
        "mine, and long enough"
    );
}

#[test]
fn models_in_one_plane_have_no_site() {
    let folder = folder();
    let output = jostle(folder.path(), &["check", "paper", "--out", "site"]);
    assert_eq!(output.status.code(), Some(2));
    assert!(
        complained(&output).contains("plans"),
        "{}",
        complained(&output)
    );
    let output = jostle(folder.path(), &["check", "paper"]);
    assert!(output.status.success());
    assert!(!folder.path().join("jostle-out").exists());
}

/// A case of the study has the numbers of a run at its angle.
#[test]
fn angles_are_those_of_runs() {
    let folder = workplace();
    let arguments = ["study", "angles", "towers.toml", "--step", "60deg"];
    let output = jostle(folder.path(), &arguments);
    assert!(output.status.success(), "{}", complained(&output));
    assert!(
        printed(&output).contains("6 of 6 cases finished"),
        "{}",
        printed(&output)
    );
    let out = folder.path().join("jostle-out/towers-angles");
    let table = read(&out.join("cases.csv"));
    let mut lines = table.lines();
    let heads: Vec<&str> = lines.next().expect("heads").split(',').collect();
    let cells: Vec<&str> = lines.nth(2).expect("case 2").split(',').collect();
    let cell = |name: &str| {
        let at = heads.iter().position(|head| *head == name);
        cells[at.unwrap_or_else(|| panic!("{name} in {heads:?}"))].parse::<f64>()
    };
    let arguments = ["run", "towers.toml", "--angle", "120deg", "--json"];
    let run: serde_json::Value =
        serde_json::from_str(&printed(&jostle(folder.path(), &arguments))).expect("JSON");
    let near = |name: &str, value: &serde_json::Value| {
        let (a, b) = (cell(name).expect(name), value.as_f64().expect(name));
        assert!((a - b).abs() <= 1e-6 * b.abs(), "{name}: {a} against {b}");
    };
    near("peak_force_n", &run["gaps"][0]["peak_force_n"]);
    near(
        "West.base_torque_peak_n_m",
        &run["buildings"][0]["base_torque_peak_n_m"],
    );
    let floor = &run["buildings"][1]["floors"][1];
    near("East.floor2.rotation_max_rad", &floor["rotation_max_rad"]);
    assert!(read(&out.join("report.html")).contains("Greatest contact force"));
    assert!(out.join("worst_angles.csv").is_file());
    // The same command finds everything done.
    let again = jostle(
        folder.path(),
        &["study", "angles", "towers.toml", "--step", "60deg"],
    );
    assert!(
        printed(&again).contains("6 of 6 cases finished\n"),
        "{}",
        printed(&again)
    );
}

#[test]
fn options_of_angles_are_checked() {
    let folder = workplace();
    let refused = |arguments: &[&str], part: &str| {
        let output = jostle(folder.path(), arguments);
        assert_eq!(output.status.code(), Some(2), "{arguments:?}");
        let text = complained(&output);
        assert!(
            text.contains(part),
            "{arguments:?}: \"{part}\" should stand in:\n{text}"
        );
    };
    let angles = ["study", "angles", "towers.toml"];
    let with = |more: &[&'static str]| [&angles[..], more].concat();
    refused(&with(&["--step", "0deg"]), "the step must be above 0");
    refused(&with(&["--step", "5 mm"]), "--step");
    refused(&with(&["--from", "90deg", "--to", "10deg"]), "is no range");
    refused(
        &with(&["--quantity", "West.torsion"]),
        "there is no column \"West.torsion\"",
    );
    refused(&["study", "angles", "paper"], "have no plan");
    refused(&["study", "angles"], "name a model");
    refused(
        &["study", "gap-sweep", "towers.toml", "--step", "5deg"],
        "jostle study angles",
    );
    refused(
        &["study", "towers.toml", "towers.toml"],
        "only ready-made studies take a model",
    );
}
