//! `jostle run --gradients` against closed forms and against runs of the program with other numbers.

use std::path::Path;

use serde_json::Value;

use crate::common::{complained, folder, jostle, printed};

/// Two buildings of one and of two storeys; 3 mm apart they hit.
const PAIR: &str = r#"
[motion]
record = "el-centro-1940-ns"
pga = "0.2 g"
duration = "6 s"
[[building]]
name = "A"
kind = "shear"
mass = ["40 t"]
stiffness = "20 MN/m"
storey_height = "3 m"
damping = { alpha = 0.9 }
[[building]]
name = "B"
kind = "shear"
mass = ["30 t", "30 t"]
stiffness = ["9 MN/m", "9 MN/m"]
storey_height = "3 m"
damping = { alpha = 0.6 }
[[gap]]
between = ["A", "B"]
width = "WIDTH"
"#;

fn json(folder: &Path, arguments: &[&str]) -> Value {
    let output = jostle(folder, arguments);
    assert!(output.status.success(), "{}", complained(&output));
    serde_json::from_str(&printed(&output)).expect("JSON")
}

fn write(folder: &Path, name: &str, width: &str) {
    std::fs::write(folder.join(name), PAIR.replace("WIDTH", width)).expect("written");
}

fn of<'s>(summary: &'s Value, of: &str, by: &str) -> &'s Value {
    let all = summary["gradients"].as_array().expect("gradients");
    let found = all
        .iter()
        .find(|summary| summary["of"] == of && summary["by"] == by);
    found.unwrap_or_else(|| panic!("no gradient of {of} by {by}"))
}

#[test]
fn peaks_of_elastic_buildings_grow_with_the_motion_as_it_does() {
    let folder = folder();
    write(folder.path(), "far.toml", "2 m");
    let summary = json(
        folder.path(),
        &[
            "run",
            "far.toml",
            "--json",
            "--no-report",
            "--gradients",
            "motion.pga",
        ],
    );
    for path in [
        "buildings[1].base_shear_peak_n",
        "buildings[1].drift_peak",
        "buildings[1].floors[1].total_acceleration_peak_m_s2",
        "buildings[0].floors[0].displacement_max_m",
    ] {
        let gradient = of(&summary, path, "motion.pga");
        let number = |key: &str| gradient[key].as_f64().expect("a number");
        assert!((number("at") - 0.2 * 9.806_65).abs() < 1e-9, "{gradient}");
        let elasticity = number("value") * number("at") / number("peak");
        assert!((elasticity - 1.0).abs() < 1e-6, "{path}: {elasticity}");
        assert!(
            (number("valid_within") - 0.5 * number("at")).abs() < 1e-9,
            "{gradient}"
        );
    }
    // No gap closes: its force is zero, and stays so.
    let force = of(&summary, "gaps[0].peak_force_n", "motion.pga");
    assert_eq!(
        (force["value"].as_f64(), force["peak"].as_f64()),
        (Some(0.0), Some(0.0))
    );
}

#[test]
fn the_derivative_of_a_force_is_that_of_runs_beside_it() {
    let folder = folder();
    write(folder.path(), "near.toml", "10 mm");
    let summary = json(
        folder.path(),
        &[
            "run",
            "near.toml",
            "--json",
            "--no-report",
            "--gradients",
            "gap[0].width,building[0].stiffness",
        ],
    );
    // Five points of separate runs at another step; the stiffness by its factor in the text.
    let text = PAIR.replace("WIDTH", "10 mm") + "[analysis]\ntolerance = 1e-6\n";
    let peak = |text: String| {
        std::fs::write(folder.path().join("other.toml"), text).expect("written");
        let found = json(
            folder.path(),
            &["run", "other.toml", "--json", "--no-report"],
        );
        found["gaps"][0]["peak_force_n"].as_f64().expect("a number")
    };
    let step = 4e-3;
    let slope = |of: &dyn Fn(f64) -> f64| {
        let at = |share: f64| of(1.0 + share * step);
        (8.0 * (at(1.0) - at(-1.0)) - (at(2.0) - at(-2.0))) / (12.0 * step)
    };
    let by_gap = slope(&|factor| peak(text.replace("10 mm", &format!("{} mm", 10.0 * factor))));
    let by_stiffness =
        slope(&|factor| peak(text.replace("20 MN/m", &format!("{} MN/m", 20.0 * factor))));
    for (path, at, wanted) in [
        ("gap[0].width", 0.01, by_gap),
        ("building[0].stiffness", 20e6, by_stiffness),
    ] {
        let gradient = of(&summary, "gaps[0].peak_force_n", path);
        let value = gradient["value"].as_f64().expect("a number") * at;
        assert!(
            (value - wanted).abs() <= 2e-3 * wanted.abs(),
            "{path}: {value} {wanted}"
        );
        // The line holds where it is said to hold.
        let reach = gradient["valid_within"].as_f64().expect("a number") / at;
        assert!(reach > 0.0, "{gradient}");
    }
    let gradient = of(&summary, "gaps[0].peak_force_n", "gap[0].width");
    let number = |key: &str| gradient[key].as_f64().expect("a number");
    let change = number("valid_within");
    let there = peak(text.replace("10 mm", &format!("{} mm", 1e3 * (0.01 + change))));
    let straight = number("peak") + number("value") * change;
    assert!(
        (there - straight).abs() <= 0.0101 * number("peak"),
        "{there} {straight}"
    );
}

#[test]
fn paths_that_lead_to_no_number_are_refused() {
    let folder = folder();
    write(folder.path(), "near.toml", "10 mm");
    for (path, wanted) in [
        ("gap[0].widt", "--gradients gap[0].widt"),
        ("motion.scale", "write the number into the model file"),
        ("building[0].name", "--gradients building[0].name"),
        ("gap[7].width", "--gradients gap[7].width"),
    ] {
        let output = jostle(folder.path(), &["run", "near.toml", "--gradients", path]);
        assert_eq!(output.status.code(), Some(2), "{path}");
        let text = complained(&output);
        assert!(text.contains(wanted), "{wanted}: {text}");
    }
}
