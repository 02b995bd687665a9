//! `jostle compare` on files: what it writes and prints, and what it refuses.

use std::fmt::Write as _;
use std::fs;
use std::path::Path;

use crate::common::{complained, folder, jostle, printed};
use serde_json::Value;

const MODEL: &str = r#"
title = "One tower"
[[building]]
name = "A"
kind = "shear"
mass = ["40 t"]
stiffness = ["20 MN/m"]
storey_height = "3 m"
"#;

const MAP: &str = r#"
table_acceleration = "A0"
[[column]]
measured = "D1"
computed = "A.floor1.displacement_m"
"#;

/// A table that moves with a sine of 1 Hz, and a sensor at rest.
fn workplace() -> tempfile::TempDir {
    let place = folder();
    let mut text = String::from("Test 1\nrow 2\nrow 3\nTime\tA0\tD1\nsec\tg\tmm\nrow 6\n");
    for k in 0..400 {
        let t = 0.01 * f64::from(k);
        let _ = writeln!(
            text,
            "{t:.2}\t{:.6}\t0.0",
            0.1 * (std::f64::consts::TAU * t).sin()
        );
    }
    let write = |name: &str, text: &str| fs::write(place.path().join(name), text).expect("written");
    write("tower.toml", MODEL);
    write("map.toml", MAP);
    write("test.asc", &text);
    place
}

const ARGUMENTS: [&str; 7] = [
    "compare",
    "tower.toml",
    "test.asc",
    "--map",
    "map.toml",
    "--out",
    "out",
];

#[test]
fn three_files_are_written_and_the_scores_are_printed() {
    let place = workplace();
    let output = jostle(place.path(), &ARGUMENTS);
    assert!(output.status.success(), "{}", complained(&output));
    let text = printed(&output);
    for part in [
        "One tower",
        "test.asc",
        "A.floor1.displacement_m",
        "out/compare.html",
    ] {
        assert!(text.contains(part), "{part}: {text}");
    }
    let read = |name: &str| fs::read(place.path().join("out").join(name)).expect(name);
    let json: Value = serde_json::from_slice(&read("compare.json")).expect("JSON");
    // Measured nothing: no ratio, no correlation, and no number that is not one.
    assert_eq!(json["columns"][0]["score"]["peak_ratio"], Value::Null);
    assert!(
        json["columns"][0]["score"]["peak_computed"]
            .as_f64()
            .expect("a number")
            > 1e-4
    );
    assert_eq!(&read("compare.parquet")[..4], b"PAR1");
    let page = String::from_utf8(read("compare.html")).expect("UTF-8");
    assert!(
        page.contains("– comparison</title>")
            && !page.contains("http:")
            && !page.contains("https:"),
        "the page is offline"
    );
    // Its own files are replaced, others are not.
    assert!(jostle(place.path(), &ARGUMENTS).status.success());
    fs::write(place.path().join("out/compare.json"), "my notes").expect("written");
    let refused = jostle(place.path(), &ARGUMENTS);
    assert_eq!(refused.status.code(), Some(2));
    assert!(
        complained(&refused).contains("--force"),
        "{}",
        complained(&refused)
    );
    // JSON alone writes nothing.
    let bare = jostle(
        place.path(),
        &[
            "compare",
            "tower.toml",
            "test.asc",
            "--map",
            "map.toml",
            "--json",
        ],
    );
    let json: Value = serde_json::from_str(&printed(&bare)).expect("JSON");
    assert_eq!(json["data"]["file"], "test.asc");
    assert!(!Path::new(&place.path().join("jostle-out")).exists());
}

#[test]
fn wrong_input_is_refused_with_its_place() {
    let place = workplace();
    let changed = |name: &str, from: &str, to: &str| {
        let path = place.path().join(name);
        let kept = fs::read_to_string(&path).expect("a file");
        fs::write(&path, kept.replacen(from, to, 1)).expect("written");
        let output = jostle(place.path(), &ARGUMENTS);
        fs::write(&path, kept).expect("written");
        assert_eq!(output.status.code(), Some(2), "{to}");
        complained(&output)
    };
    for (name, from, to, parts) in [
        (
            "map.toml",
            "\"D1\"",
            "\"D2\"",
            &["map.toml:4:", "no column \"D2\"", "did you mean \"D1\"?"][..],
        ),
        (
            "test.asc",
            "0.05\t",
            "0.05\tx",
            &["test.asc:12:", "column 2 (A0)"],
        ),
        (
            "test.asc",
            "sec\tg",
            "sec\tfoo",
            &["unit \"foo\" in line 5 of test.asc"],
        ),
        (
            "test.asc",
            "0.05\t",
            "0.055\t",
            &["test.asc:12:", "time 0.055 s"],
        ),
        (
            "map.toml",
            "table_acceleration",
            "table_accelaration",
            &["did you mean \"table_acceleration\"?"],
        ),
    ] {
        let error = changed(name, from, to);
        for part in parts {
            assert!(error.contains(part), "{to}: expected {part:?} in\n{error}");
        }
    }
    let missing = jostle(
        place.path(),
        &["compare", "tower.toml", "no.asc", "--map", "map.toml"],
    );
    assert!(
        complained(&missing).contains("no.asc: cannot be read"),
        "{}",
        complained(&missing)
    );
}
