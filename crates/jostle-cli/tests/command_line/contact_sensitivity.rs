//! `jostle run --sensitivity` against runs of model files whose contact was changed by hand.

use crate::common::{complained, folder, jostle, printed};
use serde_json::Value;

fn model(law: &str, stiffness: f64, restitution: f64) -> String {
    format!(
        r#"
[motion]
kind = "sine"
amplitude = "3 m/s2"
period = "0.7 s"
duration = "4 s"
[[building]]
name = "a"
kind = "shear"
mass = ["40 t", "40 t", "30 t"]
stiffness = ["30 MN/m", "30 MN/m", "30 MN/m"]
storey_height = 3
[[building]]
name = "b"
kind = "shear"
mass = ["60 t", "60 t"]
stiffness = ["90 MN/m", "80 MN/m"]
storey_height = 3
[[gap]]
between = ["a", "b"]
width = "10 mm"
law = "{law}"
stiffness = {stiffness}
restitution = {restitution}
"#
    )
}

fn run(text: &str, more: &[&str]) -> Value {
    let folder = folder();
    std::fs::write(folder.path().join("model.toml"), text).expect("a file");
    let output = jostle(
        folder.path(),
        &[&["run", "model.toml", "--json"], more].concat(),
    );
    assert!(output.status.success(), "{}", complained(&output));
    serde_json::from_str(&printed(&output)).expect("JSON")
}

fn number(value: &Value) -> f64 {
    value.as_f64().expect("a number")
}

#[test]
fn the_report_shows_the_spread() {
    let folder = folder();
    std::fs::write(folder.path().join("model.toml"), model("kelvin", 2e8, 0.6)).expect("a file");
    let arguments = ["run", "model.toml", "--out", "out", "--sensitivity"];
    let output = jostle(folder.path(), &arguments);
    assert!(output.status.success(), "{}", complained(&output));
    let read = |name: &str| {
        std::fs::read_to_string(folder.path().join("out").join(name)).expect("a result")
    };
    let summary: Value = serde_json::from_str(&read("summary.json")).expect("JSON");
    let gap = &summary["contact_sensitivity"]["gaps"][0];
    let report = read("report.html");
    let shown = report.split("id=\"spread\"").nth(1).expect("the section");
    let shown = shown.split("</section>").next().expect("its end");
    for bound in ["peak_force_min_n", "peak_force_max_n"] {
        // Four digits of kN, with a thin space between thousands.
        let force = number(&gap[bound]) / 1e3;
        let digits = 3 - force.log10().floor() as i32;
        let text = format!("{force:.*}", usize::try_from(digits.max(0)).expect("few"));
        let plain = shown.replace('\u{202f}', "");
        assert!(plain.contains(&format!(">{text}<")), "{bound}: {text}");
    }
}

#[test]
fn every_variant_is_the_run_with_that_contact() {
    let (k, e) = (2e8, 0.6);
    let summary = run(&model("kelvin", k, e), &["--sensitivity", "--no-report"]);
    let spread = &summary["contact_sensitivity"];
    // Hertz's F = k^0.4 (5 m v²/4)^0.6 at 0.4 m/s with 40 t against 60 t, and the spring with that force; a slab of 150 mm.
    let (mass, speed) = (24e3_f64, 0.4_f64);
    let energy = mass * speed * speed;
    let force = 2e9_f64.powf(0.4) * (1.25 * energy).powf(0.6);
    let (low, high) = (force * force / energy, 0.15 * 30e9);
    for (variant, stiffness) in [(0, low), (1, high), (2, k), (3, k)] {
        let found = number(&spread["variants"][variant]["stiffnesses"][0]);
        assert!(
            (found / stiffness - 1.0).abs() < 1e-9,
            "{found} {stiffness}"
        );
    }
    let by_hand = [(low, e), (high, e), (k, e - 0.15), (k, e + 0.15)];
    let others = by_hand.map(|(k, e)| run(&model("kelvin", k, e), &["--no-report"]));
    let force = |run: &Value| number(&run["gaps"][0]["peak_force_n"]);
    let mut forces = vec![force(&summary)];
    for (variant, other) in spread["variants"]
        .as_array()
        .expect("a list")
        .iter()
        .zip(&others)
    {
        let found = number(&variant["peak_force_n"]);
        assert!((found / force(other) - 1.0).abs() < 1e-9, "{variant}");
        assert_eq!(variant["impact_count"], other["gaps"][0]["impact_count"]);
        forces.push(found);
    }
    assert_eq!(forces.len(), 5);
    let gap = &spread["gaps"][0];
    let greatest = forces.iter().copied().fold(0.0, f64::max);
    let least = forces.iter().copied().fold(f64::INFINITY, f64::min);
    assert_eq!(number(&gap["peak_force_max_n"]), greatest);
    assert_eq!(number(&gap["peak_force_min_n"]), least);
    assert!(greatest > 1.3 * least, "the stiffness matters: {forces:?}");
    // Storey drifts of the second building, by hand.
    let drifts = |run: &Value| -> Vec<f64> {
        let floors = run["buildings"][1]["floors"].as_array().expect("floors");
        floors
            .iter()
            .map(|floor| number(&floor["storey_drift_peak"]))
            .collect()
    };
    let own_drifts = drifts(&summary);
    let scale = own_drifts.iter().copied().fold(0.0, f64::max);
    let changes = others.iter().flat_map(|other| {
        let pairs = drifts(other).into_iter().zip(own_drifts.clone());
        pairs
            .map(|(a, b)| (a - b).abs() / scale)
            .collect::<Vec<_>>()
    });
    let expected = changes.fold(0.0, f64::max);
    let found = number(&spread["buildings"][1]["storey_drift"]);
    assert!(
        expected > 1e-3 && (found - expected).abs() < 1e-9,
        "{found} {expected}"
    );
}

#[test]
fn elastic_laws_vary_in_stiffness_only_and_the_text_says_the_spread() {
    let summary = run(
        &model("linear", 2e8, 1.0),
        &["--sensitivity", "--no-report"],
    );
    let variants = summary["contact_sensitivity"]["variants"]
        .as_array()
        .expect("a list");
    assert_eq!(variants.len(), 2);
    let plain = run(&model("linear", 2e8, 1.0), &["--no-report"]);
    assert!(plain.get("contact_sensitivity").is_none());
    let folder = folder();
    std::fs::write(folder.path().join("model.toml"), model("kelvin", 2e8, 0.6)).expect("a file");
    let output = jostle(
        folder.path(),
        &["run", "model.toml", "--sensitivity", "--no-report"],
    );
    let text = printed(&output);
    assert!(
        text.contains("restitution ± 0.15") && text.contains("displacements change by up to"),
        "{text}"
    );
    let written = std::fs::read_to_string(folder.path().join("jostle-out/model/summary.json"));
    assert!(
        written
            .expect("it is there")
            .contains("contact_sensitivity")
    );
}

#[test]
fn without_a_gap_the_run_says_that_there_is_nothing_to_vary() {
    let text = model("kelvin", 2e8, 0.6);
    let (before, rest) = text.split_once("[[building]]").expect("buildings");
    let (first, _) = rest.split_once("[[building]]").expect("two");
    let summary = run(
        &format!("{before}[[building]]{first}"),
        &["--sensitivity", "--no-report"],
    );
    let warnings = summary["warnings"].to_string();
    assert!(warnings.contains("the model has no gap"), "{warnings}");
    assert!(summary.get("contact_sensitivity").is_none());
}
