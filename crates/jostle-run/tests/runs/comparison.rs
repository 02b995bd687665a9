//! A run's own histories, written as measurements in other units and at another rate, compared with a run.

use std::collections::{BTreeSet, HashMap};
use std::fmt::Write as _;
use std::ops::ControlFlow;
use std::path::Path;

use jostle::{Column, Settings};
use jostle_io::{ComparisonMap, Format, MeasuredTable, history_names, read_model_text};
use jostle_run::{Comparison, Measurements, Opened, prepare_comparison};
use jostle_testkit::two_towers;

const MODEL: &str = concat!(
    r#"
title = "Two towers"
[motion]
record = "el-centro-1940-ns"
pga = "3 m/s2"
duration = "12 s"
"#,
    two_towers!(3, 2),
    "[analysis]\ntolerance = 1e-5\n",
);

const MAP: &str = r#"
table_acceleration = "A0"
start = "5 s"
[[column]]
measured = "DA2"
computed = "A.floor2.displacement_m"
relative_to = "D0"
[[column]]
measured = "DB2"
computed = "B.floor2.displacement_m"
reverse = true
zero = "3 ms"
[[column]]
measured = "AA3"
computed = "A.floor3.total_acceleration_m_s2"
[[impacts]]
closing = ["CA2", "CB2"]
contact = "A-B.floor2-2"
window = "2 ms"
separation = "10 ms"
[[impacts]]
sensor = "S2"
level = 0.5
contact = "A-B"
window = "2 ms"
separation = "10 ms"
"#;

/// Sampling of the synthetic measurements \[s\]; a fifth of that of the record divided by two.
const STEP: f64 = 0.0004;
/// Times of the data begin here \[s\].
const BEFORE: f64 = 5.0;

fn opened() -> Opened {
    let input = read_model_text("towers.toml", MODEL, Format::Toml, Path::new(""));
    Opened::new(input.unwrap_or_else(|error| panic!("{error}")), "towers")
        .unwrap_or_else(|error| panic!("{error}"))
}

/// Densely recorded histories of a run, at equal instants.
fn histories() -> (Vec<f64>, HashMap<String, Vec<f64>>, Vec<f64>) {
    let prepared = opened().prepare().unwrap_or_else(|error| panic!("{error}"));
    let settings = Settings {
        record_interval: Some(0.25 * STEP),
        ..Settings::default()
    };
    let outcome = prepared.step(settings, |_| ControlFlow::Continue(()));
    let summary = prepared.summary(&outcome, None, 0.0);
    let history = outcome
        .history
        .as_ref()
        .unwrap_or_else(|| panic!("no history"));
    let names = history_names(&prepared.input.model, &summary, history.columns());
    let instants = history.column(Column::TIME).unwrap_or_default();
    let count = (prepared.motion.duration / STEP).round() as usize + 1;
    let time: Vec<f64> = (0..count).map(|k| k as f64 * STEP).collect();
    let resampled = |values: &[f64]| -> Vec<f64> {
        let at = |t: &f64| {
            let after = instants
                .partition_point(|instant| instant <= t)
                .clamp(1, instants.len() - 1);
            let (t0, t1) = (instants[after - 1], instants[after]);
            let share = if t1 > t0 {
                ((t - t0) / (t1 - t0)).clamp(0.0, 1.0)
            } else {
                1.0
            };
            values[after - 1] + share * (values[after] - values[after - 1])
        };
        time.iter().map(at).collect()
    };
    let columns = names.into_iter().zip(history.columns());
    let mut named: HashMap<String, Vec<f64>> = columns
        .map(|(name, column)| {
            (
                name,
                resampled(&history.column(*column).unwrap_or_default()),
            )
        })
        .collect();
    // The motion itself, exactly.
    let ground = time
        .iter()
        .map(|t| prepared.motion.acceleration(*t))
        .collect();
    named.insert("ground".into(), ground);
    let contact = &summary.gaps[0].contacts[1];
    (
        time,
        named,
        contact
            .impacts
            .iter()
            .map(|impact| impact.start_s)
            .collect(),
    )
}

/// A file of measurements: accelerations in g, displacements in inches, the table moving below.
fn asc(time: &[f64], named: &HashMap<String, Vec<f64>>, scale: f64, sensor_late: usize) -> String {
    let (g, inch) = (9.80665, 0.0254);
    let mut text = String::from(
        "Test 12, two towers\n2026-01-20\nChannel\t1\t2\t3\t4\t5\t6\t7\t8\n\
         Time\tA0\tD0\tDA2\tDB2\tAA3\tCA2\tCB2\tS2\nsec\tg\tin\tinch\tinches\tg\tmm\tmm\tvolts\n\
         Place\ttable\ttable\tA\tB\tA\tA\tB\tgap\n",
    );
    let get = |name: &str, k: usize| named[name][k];
    // A record before the test at rest.
    let rest = (BEFORE / STEP).round() as usize;
    for k in 0..10 {
        let _ = writeln!(
            text,
            "{:.4}\t0\t0\t0\t0.3\t0\t0\t0\t0",
            (rest - 10 + k) as f64 * STEP
        );
    }
    for (k, t) in time.iter().enumerate() {
        let table = 0.01 * (3.0 * t).sin();
        let force = |k: usize| get("A-B.floor2-2.force_n", k);
        let late = k.checked_sub(sensor_late).map_or(0.0, force);
        let _ = writeln!(
            text,
            "{:.4}\t{:.12e}\t{:.12e}\t{:.12e}\t{:.12e}\t{:.12e}\t{:.12e}\t{:.12e}\t{}",
            BEFORE + t,
            get("ground", k) / g,
            table / inch,
            (scale * get("A.floor2.displacement_m", k) + table) / inch,
            -scale * get("B.floor2.displacement_m", k) / inch + 0.3,
            scale * get("A.floor3.total_acceleration_m_s2", k) / g,
            1e3 * get("A.floor2.displacement_m", k),
            1e3 * get("B.floor2.displacement_m", k),
            if late > 0.0 { 5.0 } else { 0.0 }
        );
    }
    text
}

fn compared(text: &str, map: &str) -> Result<Comparison, String> {
    let table = MeasuredTable::parse(text.as_bytes()).map_err(|error| error.to_string())?;
    let map =
        ComparisonMap::parse("map.toml", map, Format::Toml).map_err(|error| error.to_string())?;
    let data = Measurements {
        table: &table,
        name: "test12.asc",
        map: &map,
        map_name: "map.toml",
    };
    let prepared = prepare_comparison(&opened(), data).map_err(|error| error.to_string())?;
    let run = prepared.run(&mut |_, _| ControlFlow::Continue(()));
    Ok(run
        .map_err(|error| error.to_string())?
        .unwrap_or_else(|| panic!("stopped")))
}

#[test]
fn a_run_agrees_with_its_own_histories() {
    let (time, named, starts) = histories();
    let found =
        compared(&asc(&time, &named, 1.0, 0), MAP).unwrap_or_else(|error| panic!("{error}"));
    for column in &found.columns {
        let score = &column.score;
        let correlation = score.correlation.unwrap_or(0.0);
        let difference = score.rms_difference.unwrap_or(1.0);
        let ratio = score.peak_ratio.unwrap_or(0.0);
        println!(
            "{}: {correlation:.9} {difference:.2e} {ratio:.6}",
            column.computed_name
        );
        // Straight lines between rows a quarter of a sampling interval apart.
        assert!(
            (ratio - 1.0).abs() < 1e-5 && 1.0 - correlation < 1e-9 && difference < 1e-5,
            "{}: {ratio} {correlation} {difference}",
            column.computed_name
        );
    }
    assert!(starts.len() > 3, "{} impacts", starts.len());
    for impacts in &found.impacts {
        let score = &impacts.score;
        assert_eq!(
            score.matched_count, score.measured_count,
            "{}: {:?} {:?}",
            impacts.sign, impacts.measured, impacts.computed
        );
        assert!(
            score.time_difference_peak_s.unwrap_or(1.0) < STEP,
            "{}: {score:?}",
            impacts.sign
        );
    }
    // By the closing of the displacements all impacts of the contact are found.
    let closing = &found.impacts[0].score;
    assert_eq!(closing.matched_count, closing.computed_count);
    assert_eq!(found.start, BEFORE);
    every_number_is_in_the_registry(&found);
    assert_eq!(found.time.len(), time.len());
}

/// The scores in `compare.json` are those that the registry lists, and the other way round.
fn every_number_is_in_the_registry(found: &Comparison) {
    let json = found.json();
    for (list, title) in [
        ("columns", "Histories compared with measurements"),
        ("impacts", "Impacts compared with measurements"),
    ] {
        let owner = jostle::results::registry::owners();
        let owner = owner.into_iter().find(|owner| owner.title == title);
        let owner = owner.unwrap_or_else(|| panic!("{title}"));
        let names: BTreeSet<&str> = owner.entries.iter().map(|entry| entry.name).collect();
        for scored in json[list].as_array().into_iter().flatten() {
            let score = scored["score"].as_object().map(|score| score.keys());
            let keys: BTreeSet<&str> = score.into_iter().flatten().map(String::as_str).collect();
            assert_eq!(keys, names, "{title}");
        }
    }
}

#[test]
fn a_perturbed_test_scores_as_computed_by_hand() {
    let (time, named, _) = histories();
    // Measured 0.8 of the computed values: ratio 1/0.8, correlation unchanged, difference 0.2/0.8. Sensors that
    // answer 4 ms late miss a window of 2 ms.
    let found =
        compared(&asc(&time, &named, 0.8, 10), MAP).unwrap_or_else(|error| panic!("{error}"));
    for column in &found.columns {
        let score = &column.score;
        assert!(
            (score.peak_ratio.unwrap_or(0.0) - 1.25).abs() < 2e-3,
            "{score:?}"
        );
        assert!(
            (score.rms_difference.unwrap_or(0.0) - 0.25).abs() < 2e-3,
            "{score:?}"
        );
        assert!(score.correlation.unwrap_or(0.0) > 0.9999, "{score:?}");
    }
    let late = &found.impacts[1].score;
    assert!(
        late.measured_count > 3 && late.matched_count == 0,
        "{late:?}"
    );
    // A window of 5 ms finds them, 4 ms late: computed less measured is −4 ms.
    let wide = MAP.replace(
        "level = 0.5\ncontact = \"A-B\"\nwindow = \"2 ms\"",
        "level = 0.5\ncontact = \"A-B.floor2-2\"\nwindow = \"5 ms\"",
    );
    let found =
        compared(&asc(&time, &named, 0.8, 10), &wide).unwrap_or_else(|error| panic!("{error}"));
    let late = &found.impacts[1].score;
    assert_eq!(late.matched_count, late.measured_count);
    assert!(
        (late.time_difference_mean_s.unwrap_or(0.0) + 0.004).abs() < STEP,
        "{late:?}"
    );
}

#[test]
fn the_table_can_be_measured_by_its_displacement() {
    let (time, _, _) = histories();
    // Five whole periods. d = −(a/ω²) sin ωt has the second difference −d (2 − 2 cos ωh)/h², here within (ωh)²/12 of ω².
    let omega = 9.0;
    let mut text = String::from("t\n1\nTime\tD0\tD1\nsec\tmm\tmm\nb\nc\n");
    for t in time.iter().take(8728) {
        let d = -1e3 * 2.0 / (omega * omega) * (omega * t).sin();
        let _ = writeln!(text, "{t:.4}\t{d:.15e}\t{d:.6e}");
    }
    let map = "table_displacement = \"D0\"\nlow_pass = \"40 Hz\"\n[[column]]\nmeasured = \"D1\"\ncomputed = \"A.floor1.displacement_m\"\n";
    let found = compared(&text, map).unwrap_or_else(|error| panic!("{error}"));
    let pga = found.summary.motion.pga_m_s2;
    assert!((pga / 2.0 - 1.0).abs() < 0.01, "{pga}");
}

#[test]
fn faults_stand_at_their_lines() {
    let (time, named, _) = histories();
    let text = asc(
        &time[..100],
        &HashMap::from_iter(named.iter().map(|(k, v)| (k.clone(), v[..100].to_vec()))),
        1.0,
        0,
    );
    let fault = |from: &str, to: &str| {
        let changed = MAP.replacen(from, to, 1);
        assert_ne!(changed, MAP, "{from}");
        match compared(&text, &changed) {
            Ok(_) => panic!("accepted: {to}"),
            Err(error) => error,
        }
    };
    for (from, to, parts) in [
        (
            "\"DA2\"",
            "\"DA3\"",
            &[
                "map.toml:5:",
                "column[0].measured",
                "no column \"DA3\"",
                "did you mean",
                "AA3 [g]",
            ][..],
        ),
        (
            "\"A0\"",
            "\"D0\"",
            &[
                "map.toml:2:",
                "table_acceleration",
                "D0",
                "is a length [in]",
                "an acceleration is needed",
            ],
        ),
        (
            "\"A0\"",
            "\"S2\"",
            &["map.toml:2:", "volts", "line 5 of test12.asc", "not known"],
        ),
        (
            "A.floor2.displacement_m",
            "A.floor2.displacement",
            &[
                "map.toml:6:",
                "did you mean \"A.floor2.displacement_m\"?",
                "Results: time_s",
            ],
        ),
        (
            "A.floor2.displacement_m",
            "A.floor9.displacement_m",
            &["no result \"A.floor9.displacement_m\""],
        ),
        (
            "A.floor2.displacement_m",
            "A.floor2.total_acceleration_m_s2",
            &["map.toml:5:", "is a length"],
        ),
        (
            "A.floor2.displacement_m",
            "energy_input_j",
            &["map.toml:6:", "results in J cannot be compared"],
        ),
        (
            "start",
            "strat",
            &[
                "map.toml:3:",
                "unknown key \"strat\"",
                "did you mean \"start\"?",
            ],
        ),
        (
            "\"5 s\"",
            "\"9 s\"",
            &[
                "map.toml:3:",
                "start: 9 s lies outside the data of test12.asc",
            ],
        ),
        (
            "start = \"5 s\"",
            "start = \"5 s\"\nend = \"5.00001 s\"",
            &["map.toml:4:", "end: ", "three are needed at least"],
        ),
        (
            "start = \"5 s\"",
            "start = \"5 s\"\nlow_pass = \"90 kHz\"",
            &["map.toml:4:", "low_pass: "],
        ),
        ("\"5 s\"", "\"5 m\"", &["map.toml:3:", "expected a time"]),
        (
            "A-B.floor2-2",
            "A-C",
            &["no gap or contact \"A-C\"", "A-B.floor1-1"],
        ),
        ("level = 0.5", "", &["impacts[1].level", "is missing"]),
        (
            "sensor = \"S2\"",
            "sensor = \"S2\"\nacceleration = \"AA3\"\nabove = \"2 g\"",
            &["exclude each other"],
        ),
        (
            "[\"CA2\", \"CB2\"]",
            "[\"CA2\"]",
            &["impacts[0].closing", "left and right"],
        ),
        (
            "window = \"2 ms\"",
            "window = \"0 ms\"",
            &["impacts[0].window"],
        ),
        (
            "table_acceleration = \"A0\"",
            "",
            &["table_acceleration", "is missing", "table_displacement"],
        ),
    ] {
        let error = fault(from, to);
        for part in parts {
            assert!(error.contains(part), "{to}: expected {part:?} in\n{error}");
        }
    }
}
