//! Dashpots that grow with the indentation to many times what would be critical.

use crate::common::{complained, folder, jostle, printed};

/// Greatest force of the example's frames, 4 mm apart, under a law of restitution 0.01 \[N\].
fn greatest_force(solver: &str, tolerance: &str) -> f64 {
    let example = concat!(
        env!("CARGO_MANIFEST_DIR"),
        "/../../examples/five_and_ten_storeys.toml"
    );
    let example = std::fs::read_to_string(example).expect("the example");
    let (buildings, _) = example.split_once("[[gap]]").expect("a gap");
    let (before, after) = buildings.split_once("[motion]").expect("a motion");
    let after: String = after
        .lines()
        .filter(|line| !line.starts_with("pga") && !line.starts_with("duration"))
        .flat_map(|line| [line, "\n"])
        .collect();
    let model = format!(
        r#"{before}[motion]
pga = "100 cm/s2"
duration = "6 s"{after}
[[gap]]
between = ["Low", "High"]
width = "4 mm"
law = "modified-kelvin"
variant = "ye"
stiffness = "5.62e8 N/m"
restitution = 0.01

[analysis]
solver = "{solver}"
tolerance = {tolerance}
"#
    );
    let folder = folder();
    std::fs::write(folder.path().join("frames.toml"), model).expect("a model");
    let output = jostle(
        folder.path(),
        &["run", "frames.toml", "--json", "--no-report"],
    );
    assert!(output.status.success(), "{}", complained(&output));
    let summary: serde_json::Value = serde_json::from_str(&printed(&output)).expect("a summary");
    // Many impacts hang on each other; nothing else is to be said.
    let warnings = summary["warnings"].as_array().expect("a list");
    let others = warnings.iter().filter_map(serde_json::Value::as_str);
    let others: Vec<&str> = others
        .filter(|text| !text.starts_with("sensitive"))
        .collect();
    assert!(others.is_empty(), "{others:?}");
    let contacts = summary["gaps"][0]["contacts"].as_array().expect("contacts");
    let forces = contacts
        .iter()
        .filter_map(|contact| contact["peak_force_n"].as_f64());
    forces.fold(0.0, f64::max)
}

/// The force at the end of a step then has nothing to do with the one foreseen at its start; built upon, it grew without
/// bounds.
#[test]
fn modal_steps_do_not_build_on_what_they_cannot_foresee() {
    let expected = greatest_force("riccati", "1e-3");
    for tolerance in ["1e-3", "1e-2"] {
        let found = greatest_force("modal", tolerance);
        assert!(
            (found / expected - 1.0).abs() < 5e-3,
            "{tolerance}: {found} against {expected} N"
        );
    }
}
