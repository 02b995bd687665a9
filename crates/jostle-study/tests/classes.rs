//! Fragility of classes against direct counts, closed forms and runs of the full solver.

use std::path::Path;

use jostle_io::{ClassesFile, Format};
use jostle_study::classes::{ClassesResults, FILES, run_classes, write_classes};

/// Two types with equal floors, two motions.
const EVEN: &str = r#"
title = "A < B & C"
[class]
types = ["C1"]
storeys = [2]
level = "low"
[neighbour]
types = ["C3"]
storeys = [3]
level = "pre"
[pair]
gaps = ["2 mm", "20 mm", "2 m"]
[motion]
record = ["el-centro-1940-ns", "nanjing-artificial"]
[intensity]
measure = "PGA"
levels = ["0.05 g", "0.08 g", "0.1 g", "0.13 g", "0.16 g", "0.2 g", "0.25 g", "0.3 g", "0.36 g", "0.43 g", "0.5 g", "0.6 g", "0.8 g", "1.1 g", "1.5 g"]
[run]
draws = 4
sample = 6
resamples = 50
stiffness_scatter = 0.5
strength_scatter = 0.7
"#;

fn file(text: &str) -> ClassesFile {
    ClassesFile::parse("classes.toml", text, Format::Toml, Path::new(""))
        .unwrap_or_else(|error| panic!("{error}"))
}

fn results(text: &str, jobs: usize) -> ClassesResults {
    let done = run_classes(&file(text), Some(jobs), &|| false, &|_, _| {});
    let done = done.unwrap_or_else(|error| panic!("{error}"));
    done.expect("nothing stopped it")
}

#[test]
fn classes_agree_with_counts_and_with_the_full_solver() {
    let results = results(EVEN, 2);
    assert_eq!(results.cases.len(), 2 * 15 * 4 * 3);
    // A gap of 2 m never closes, and changes nothing.
    for case in &results.cases {
        assert_eq!(case.impacts > 0, case.force > 0.0, "{case:?}");
        assert!(case.impacts == 0 || case.closing > case.gap, "{case:?}");
        assert!(
            case.impacts > 0 || case.closing < case.gap * 1.001,
            "{case:?}"
        );
        if case.gap >= case.closing {
            assert_eq!(case.with, case.alone, "{case:?}");
        }
    }
    // Curves count the same cases.
    for curve in &results.curves {
        let of = results
            .cases
            .iter()
            .filter(|case| case.pair == curve.pair && case.gap == curve.gap.unwrap_or(0.002));
        let drift = |case: &jostle_study::classes::Case| {
            if curve.gap.is_some() {
                case.with.drift
            } else {
                case.alone.drift
            }
        };
        for &(level, cases, reached) in &curve.counts {
            let there: Vec<f64> = of
                .clone()
                .filter(|case| case.intensity == level)
                .map(drift)
                .collect();
            assert_eq!(cases, there.len());
            assert_eq!(
                reached,
                there
                    .iter()
                    .filter(|results| **results >= curve.threshold)
                    .count()
            );
        }
    }
    // Worse states are rarer, and the wide gap has the curves of none.
    for states in results.curves.chunks(4) {
        assert!(
            states
                .windows(2)
                .all(|pair| pair[0].reached >= pair[1].reached)
        );
    }
    let moved = (0..results.curves.len()).filter(|at| results.curves[*at].gap == Some(2.0));
    for factor in moved.filter_map(|at| results.pounding_factor(at)) {
        assert_eq!(factor, 1.0);
    }
    let fitted = results
        .curves
        .iter()
        .filter(|curve| curve.fit.is_ok())
        .count();
    assert!(fitted >= 10, "{fitted} of {}", results.curves.len());
    // The full solver steps the same cases.
    assert_eq!(results.checked.len(), 6);
    let [drift, force] = results.worst_deviations();
    assert!(drift < 1e-2 && force < 3e-2, "{drift} {force}");
}

#[test]
fn threads_change_no_bit_and_a_stop_leaves_nothing() {
    let [one, three] = [1, 3].map(|jobs| results(EVEN, jobs));
    assert_eq!(one.cases, three.cases);
    assert_eq!(one.curves, three.curves);
    assert_eq!(one.checked, three.checked);
    let stopped = run_classes(&file(EVEN), Some(1), &|| true, &|_, _| {});
    assert!(stopped.unwrap_or_else(|error| panic!("{error}")).is_none());
}

#[test]
fn files_are_complete_and_nrml_has_moments_of_the_intensity() {
    let folder = tempfile::tempdir().expect("a folder");
    let results = results(EVEN, 2);
    let left_out = write_classes(folder.path(), &file(EVEN), &results);
    let left_out = left_out.unwrap_or_else(|error| panic!("{error}"));
    for (name, _) in FILES {
        assert!(folder.path().join(name).is_file(), "{name}");
    }
    let read = |name: &str| std::fs::read_to_string(folder.path().join(name)).expect("a text");
    let xml = read("fragility.xml");
    assert!(xml.contains("A &lt; B &amp; C"));
    let functions = xml.matches("<fragilityFunction").count();
    assert!(functions > 0, "{left_out:?}");
    let names = xml.split("<fragilityFunction id=\"").skip(1);
    for name in names.filter_map(|name| name.split('"').next()) {
        let fits = |c: char| c.is_ascii_alphanumeric() || "_-:".contains(c);
        assert!(name.len() <= 75 && name.chars().all(fits), "{name}");
    }
    let rows = read("pelicun.csv").lines().count() - 1;
    let groups = results.curves.len() / 4;
    assert_eq!(
        (functions, rows),
        (groups - left_out.len(), functions),
        "{left_out:?}"
    );
    // Median = mean/√(1 + (deviation/mean)²), the inverse that OpenQuake uses; Pelicun has it as it is.
    let number = |line: &str, key: &str| -> f64 {
        let after = line.split(&format!("{key}=\"")).nth(1).expect("the key");
        let text = after.split('"').next();
        text.and_then(|split| split.parse().ok()).expect("a number")
    };
    let params = xml.lines().filter(|line| line.contains("<params"));
    let medians: Vec<f64> = params
        .map(|line| {
            let (mean, deviation) = (number(line, "mean"), number(line, "stddev"));
            mean / (1.0 + (deviation / mean).powi(2)).sqrt()
        })
        .collect();
    let table = read("pelicun.csv");
    let cells = table
        .lines()
        .skip(1)
        .flat_map(|row| [7, 11, 15, 19].map(|at| row.split(',').nth(at)));
    let other: Vec<f64> = cells
        .map(|cell| cell.and_then(|cell| cell.parse().ok()).expect("a median"))
        .collect();
    assert_eq!(medians.len(), other.len());
    for (a, b) in medians.iter().zip(&other) {
        assert!((a / b - 1.0).abs() < 1e-12, "{a} {b}");
    }
    // Worse states have greater medians, so that no curves cross.
    for states in medians.chunks(4) {
        assert!(
            states.windows(2).all(|pair| pair[0] < pair[1]),
            "{states:?}"
        );
    }
}

#[test]
fn types_that_are_not_understood_stand_at_their_line() {
    let wrong = EVEN.replace("[\"C3\"]", "[\"C3\", \"X9\"]");
    let error = run_classes(&file(&wrong), Some(1), &|| false, &|_, _| {});
    let error = error.expect_err("no such type").to_string();
    assert!(error.contains("classes.toml:8"), "{error}");
    assert!(
        error.contains("neighbour.types[1]") && error.contains("\"X9\""),
        "{error}"
    );
}

#[test]
fn scaled_motions_have_their_intensity() {
    // With Sa(T1) of 0.3 g the elastic base shear coefficient does not depend on the record's own strength: the scale of a
    // record of twice the size is half.
    let text = EVEN
        .replace("\"PGA\"", "\"Sa(T1)\"")
        .replace("draws = 4", "draws = 1");
    let twice = text.replace("[intensity]", "scale = 2.0\n[intensity]");
    let (once, twice) = (results(&text, 2), results(&twice, 2));
    for (a, b) in once.cases.iter().zip(&twice.cases) {
        assert!((a.scale / b.scale - 2.0).abs() < 1e-9);
        assert!((a.alone.drift / b.alone.drift - 1.0).abs() < 1e-4);
    }
}
