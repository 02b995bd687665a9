//! `jostle run` of a model with several records: every record as on its own, statistics, governing values, resuming.

use std::fs;
use std::path::Path;
use std::time::SystemTime;

use crate::common::{complained, folder, jostle, printed};
use jostle_testkit::two_towers;
use serde_json::Value;

const TOWERS: &str = concat!(
    r#"
title = "Two towers"
[motion]
record = ["el-centro-1940-ns", "nanjing-artificial", "noise.csv"]
pga = "3 m/s2"
"#,
    two_towers!(3, 2),
    "[analysis]\ntolerance = 0.01\n",
);

fn workplace() -> tempfile::TempDir {
    let place = folder();
    let made = jostle(
        place.path(),
        &["motion", "synth", "noise", "--pga", "1", "-o", "noise.csv"],
    );
    assert!(made.status.success(), "{}", complained(&made));
    fs::write(place.path().join("towers.toml"), TOWERS).expect("written");
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

fn json_at(path: &Path) -> Value {
    serde_json::from_str(&fs::read_to_string(path).expect("a file")).expect("JSON")
}

const FOLDERS: [&str; 3] = ["01-el-centro-1940-ns", "02-nanjing-artificial", "03-noise"];

/// All files of a folder and their bytes, in order.
fn files(folder: &Path) -> Vec<(String, Vec<u8>)> {
    let mut all = Vec::new();
    let mut open = vec![folder.to_path_buf()];
    while let Some(next) = open.pop() {
        for entry in fs::read_dir(next).expect("a folder").flatten() {
            let path = entry.path();
            if path.is_dir() {
                open.push(path);
            } else {
                let name = path.strip_prefix(folder).expect("inside");
                all.push((name.display().to_string(), fs::read(&path).expect("read")));
            }
        }
    }
    all.sort();
    all
}

#[test]
fn every_record_is_as_on_its_own() {
    let place = workplace();
    let said = good(place.path(), &["run", "towers.toml", "--out", "suite"]);
    for part in ["3 motions", "el-centro-1940-ns", "governing", "suite.html"] {
        assert!(said.contains(part), "{part} is missing:\n{said}");
    }
    for (record, record_folder) in ["el-centro-1940-ns", "nanjing-artificial", "noise.csv"]
        .into_iter()
        .zip(FOLDERS)
    {
        let arguments = ["run", "towers.toml", "--record", record, "--out", "one"];
        good(place.path(), &arguments);
        let suite = place.path().join("suite").join(record_folder);
        let [mut a, mut b] = [suite.clone(), place.path().join("one")]
            .map(|folder| json_at(&folder.join("summary.json")));
        for summary in [&mut a, &mut b] {
            summary["work"]["wall_s"] = Value::Null;
            // Alone it is one record, in the suite one of three.
            let checks = summary["checks"].as_array_mut().expect("a list");
            checks.retain(|check| check["id"] != "A12");
        }
        assert!(a == b, "{record}: another summary");
        for table in ["history.parquet", "impacts.parquet"] {
            let [a, b] = [suite.join(table), place.path().join("one").join(table)]
                .map(|path| fs::read(path).expect("written"));
            assert!(a == b, "{record}: another {table}");
        }
        assert!(suite.join("report.html").exists());
    }
    let page = fs::read_to_string(place.path().join("suite/suite.html")).expect("written");
    for folder in FOLDERS {
        assert!(
            page.contains(&format!("href=\"{folder}/report.html\"")),
            "{folder}"
        );
    }
}

/// Statistics recomputed here from the summaries, and the rules with their numbers of records.
#[test]
fn statistics_are_those_of_the_summaries() {
    let place = workplace();
    let arguments = [
        "run",
        "towers.toml",
        "--out",
        "suite",
        "--governing",
        "en1998",
    ];
    good(place.path(), &arguments);
    let suite = json_at(&place.path().join("suite/suite.json"));
    assert_eq!(suite["governing"]["rule"], "en1998");
    assert_eq!(suite["governing"]["statistic"], "maximum");
    assert_eq!(suite["governing"]["met"], true);
    let summaries = FOLDERS
        .map(|folder| json_at(&place.path().join("suite").join(folder).join("summary.json")));
    let known: [(&str, Vec<f64>); 3] = [
        (
            "A-B.peak_force_n",
            summaries
                .iter()
                .map(|s| s["gaps"][0]["peak_force_n"].as_f64().expect("a force"))
                .collect(),
        ),
        (
            "B.floor2.displacement_peak_m",
            summaries
                .iter()
                .map(|s| {
                    let floor = &s["buildings"][1]["floors"][1];
                    let most = floor["displacement_max_m"].as_f64().expect("a number");
                    most.max(-floor["displacement_min_m"].as_f64().expect("a number"))
                })
                .collect(),
        ),
        (
            "A.without_contact.base_shear_peak_n",
            summaries
                .iter()
                .map(|s| {
                    s["buildings"][0]["without_contact"]["base_shear_peak_n"]
                        .as_f64()
                        .expect("a number")
                })
                .collect(),
        ),
    ];
    for (name, values) in known {
        let found = suite["quantities"].as_array().into_iter().flatten();
        let found = found.into_iter().find(|q| q["name"] == name).expect(name);
        let number = |key: &str| found[key].as_f64().expect("a number");
        let mean = values.iter().sum::<f64>() / 3.0;
        let squares: f64 = values.iter().map(|v| (v - mean) * (v - mean)).sum();
        let most = values.iter().copied().fold(0.0, f64::max);
        assert!((number("mean") / mean - 1.0).abs() < 1e-14, "{name}");
        assert!(
            (number("standard_deviation") / (squares / 2.0).sqrt() - 1.0).abs() < 1e-12,
            "{name}"
        );
        assert_eq!(
            (number("maximum"), number("governing")),
            (most, most),
            "{name}"
        );
    }
    for (rule, statistic, met, part) in [
        (
            "gb50011",
            "maximum",
            true,
            "GB 50011-2010 (2016), clause 5.1.2",
        ),
        (
            "asce7",
            "maximum",
            false,
            "at least eleven motions are required",
        ),
        ("mean", "mean", true, "the mean of 3 motions"),
    ] {
        let text = good(
            place.path(),
            &[
                "run",
                "towers.toml",
                "--json",
                "--no-report",
                "--governing",
                rule,
            ],
        );
        let suite: Value = serde_json::from_str(&text).expect("nothing but JSON");
        assert_eq!(suite["governing"]["statistic"], statistic, "{rule}");
        assert_eq!(suite["governing"]["met"], met, "{rule}");
        assert!(
            suite["governing"]["text"]
                .as_str()
                .is_some_and(|text| text.contains(part)),
            "{suite}"
        );
        assert_eq!(
            suite["warnings"].as_array().map(Vec::len),
            Some(usize::from(!met))
        );
    }
    let refused = jostle(place.path(), &["run", "towers.toml", "--governing", "ec8"]);
    assert_eq!(refused.status.code(), Some(2));
}

#[test]
fn the_code_of_the_match_and_the_key_of_the_file_give_the_rule() {
    let place = workplace();
    let matched = TOWERS.replace(
        "pga = \"3 m/s2\"",
        "match = { spectrum = { code = \"en1998\", ground = \"B\", ag = \"0.2 g\" }, at = \"0.6 s\" }",
    );
    let rule = |text: &str| {
        fs::write(place.path().join("own.toml"), text).expect("written");
        let text = good(place.path(), &["run", "own.toml", "--json", "--no-report"]);
        let suite: Value = serde_json::from_str(&text).expect("JSON");
        suite["governing"]["rule"]
            .as_str()
            .unwrap_or_default()
            .to_owned()
    };
    assert_eq!(rule(TOWERS), "maximum");
    assert_eq!(rule(&matched), "en1998");
    let named = matched.replace("[motion]", "[motion]\ngoverning = \"gb50011\"");
    assert_eq!(rule(&named), "gb50011");
}

#[test]
fn threads_do_not_change_a_byte_and_finished_records_are_kept() {
    let place = workplace();
    good(
        place.path(),
        &["run", "towers.toml", "--out", "many", "--jobs", "3"],
    );
    good(
        place.path(),
        &["run", "towers.toml", "--out", "one", "--jobs", "1"],
    );
    let (many, one) = (place.path().join("many"), place.path().join("one"));
    assert!(
        files(&many) == files(&one),
        "another number of threads, other bytes"
    );
    // One record is as if its run had been interrupted.
    fs::remove_file(many.join(FOLDERS[1]).join("finished.json")).expect("removed");
    let times = || -> Vec<SystemTime> {
        let written = FOLDERS.map(|folder| fs::metadata(many.join(folder).join("summary.json")));
        written
            .map(|file| file.and_then(|file| file.modified()).expect("a time"))
            .to_vec()
    };
    let before = times();
    std::thread::sleep(std::time::Duration::from_millis(20));
    let said = jostle(place.path(), &["run", "towers.toml", "--out", "many"]);
    assert!(
        complained(&said).contains("2 records were finished already"),
        "{}",
        complained(&said)
    );
    let after = times();
    assert!(
        before[0] == after[0] && before[2] == after[2],
        "finished records were run again"
    );
    assert!(
        before[1] < after[1],
        "the unfinished record was not run again"
    );
    assert!(files(&many) == files(&one), "resuming changed bytes");
    // Another model is another suite.
    good(
        place.path(),
        &["run", "towers.toml", "--out", "many", "--gap", "30mm"],
    );
    assert!(times().iter().zip(&after).all(|(now, then)| now > then));
}

#[test]
fn faults_of_records_and_foreign_files_are_refused() {
    let place = workplace();
    fs::create_dir_all(place.path().join("suite")).expect("made");
    fs::write(place.path().join("suite/suite.json"), "mine").expect("written");
    let kept = jostle(place.path(), &["run", "towers.toml", "--out", "suite"]);
    assert_eq!(kept.status.code(), Some(2), "{}", complained(&kept));
    assert!(
        complained(&kept).contains("suite.json exists already"),
        "{}",
        complained(&kept)
    );
    fs::remove_file(place.path().join("noise.csv")).expect("removed");
    let lost = jostle(place.path(), &["run", "towers.toml"]);
    assert_eq!(lost.status.code(), Some(2));
    for part in ["towers.toml:4", "there is no record \"noise.csv\""] {
        assert!(
            complained(&lost).contains(part),
            "{part}:\n{}",
            complained(&lost)
        );
    }
    let single = jostle(
        place.path(),
        &[
            "run",
            "towers.toml",
            "--record",
            "nanjing-artificial",
            "--jobs",
            "2",
        ],
    );
    assert_eq!(single.status.code(), Some(2));
    assert!(complained(&single).contains("--jobs: goes with a model of several records"));
}
