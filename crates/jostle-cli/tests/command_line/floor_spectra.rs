//! `--floor-spectra` and `[output] floor_spectra`, as a user meets them.

use std::fs;

use crate::common::{complained, folder, jostle, printed};
use serde_json::Value;

const TOWERS: &str = r#"
[motion]
record = "el-centro-1940-ns"
[[building]]
name = "A"
kind = "shear"
mass = ["40 t", "40 t"]
stiffness = ["20 MN/m", "20 MN/m"]
storey_height = "3 m"
[[building]]
name = "B"
kind = "shear"
mass = ["60 t"]
stiffness = ["90 MN/m"]
storey_height = "3 m"
[[gap]]
between = ["A", "B"]
width = "10 mm"
"#;

#[test]
fn spectra_are_in_every_file_when_asked_for_and_nowhere_else() {
    let place = folder();
    fs::write(place.path().join("plain.toml"), TOWERS).expect("written");
    let run = |arguments: &[&str]| {
        let output = jostle(place.path(), arguments);
        assert!(output.status.success(), "{}", complained(&output));
        printed(&output)
    };
    run(&["run", "plain.toml", "--out", "without"]);
    let said = run(&["run", "plain.toml", "--out", "with", "--floor-spectra"]);
    assert!(
        said.contains("floor spectra") && said.contains("below 25 Hz"),
        "{said}"
    );
    let read = |folder: &str, name: &str| fs::read_to_string(place.path().join(folder).join(name));
    let plain: Value =
        serde_json::from_str(&read("without", "summary.json").expect("written")).expect("JSON");
    assert!(plain.get("floor_spectra").is_none());
    assert!(!place.path().join("without/floor_spectra.parquet").exists());
    assert!(
        !read("without", "report.html")
            .expect("written")
            .contains("id=\"floor-spectra\"")
    );
    let asked: Value =
        serde_json::from_str(&read("with", "summary.json").expect("written")).expect("JSON");
    let spectra = &asked["floor_spectra"];
    assert_eq!(spectra["periods_s"].as_array().map(Vec::len), Some(100));
    assert_eq!(spectra["floors"].as_array().map(Vec::len), Some(3));
    let floor = &spectra["floors"][1];
    assert_eq!(
        (&floor["building"], &floor["floor"]),
        (&"A".into(), &2.into())
    );
    for run in [floor, &floor["without_contact"]] {
        let values = run["spectra"][0]["pseudo_acceleration_m_s2"]
            .as_array()
            .expect("a curve");
        // Towards short periods the spectrum is the peak of the floor.
        let rigid = values[0].as_f64().expect("a number")
            / run["peak_acceleration_m_s2"].as_f64().expect("a number");
        assert!(rigid > 0.5 && rigid < 2.5, "{rigid}");
    }
    assert!(place.path().join("with/floor_spectra.parquet").exists());
    assert!(
        read("with", "report.html")
            .expect("written")
            .contains("id=\"floor-spectra\"")
    );
    // The file asks for less.
    let model_text = format!(
        "{TOWERS}[output]\nfloor_spectra = {{ floors = [\"A.floor.2\", \"B\"], damping = [0.02, 0.05], periods = [\"0.1 s\", 0.5], low_pass = \"33 Hz\", order = 2 }}\n"
    );
    fs::write(place.path().join("own.toml"), model_text).expect("written");
    let text = run(&["run", "own.toml", "--json"]);
    let spectra = &serde_json::from_str::<Value>(&text).expect("JSON")["floor_spectra"];
    assert_eq!(spectra["floors"].as_array().map(Vec::len), Some(2));
    assert_eq!(spectra["floors"][0]["spectra"][1]["damping"], 0.05);
    assert_eq!(spectra["filter"]["corner_hz"], 33.0);
    assert_eq!(spectra["filter"]["order"], 2);
}

#[test]
fn faults_are_reported_all_at_once() {
    let place = folder();
    let wrong = format!(
        "{TOWERS}[output]\nfloor_spectra = {{ floors = [\"A.floor.3\", \"C\", \"D.floor.1\"], damping = [0.05, 1.5], periods = [\"0.1 m\", \"0.1 ms\"], low_pass = 0, order = 3 }}\n"
    );
    fs::write(place.path().join("wrong.toml"), wrong).expect("written");
    let refused = jostle(place.path(), &["run", "wrong.toml"]);
    assert_eq!(refused.status.code(), Some(2));
    let text = complained(&refused);
    for part in [
        "output.floor_spectra.floors[0]",
        "\"A\" has floors 1 to 2, found \"3\"",
        "\"C\" is neither a building nor a floor",
        "there is no building \"D\"; there are A, B",
        "must lie from 0 to below 1, found 1.5",
        "expected a time",
        "must be 0 or lie between 0.002 s and 1000 s",
        "must be greater than zero",
        "must be 2, 4, 6 or 8, found 3",
    ] {
        assert!(text.contains(part), "{part} is missing:\n{text}");
    }
}
