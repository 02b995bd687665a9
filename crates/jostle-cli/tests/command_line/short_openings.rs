//! Faces that part for a few milliseconds and meet again make two impacts, however long the steps.

use crate::common::{complained, folder, jostle, printed};

const TOWERS: &str = r#"
[motion]
record = "el-centro-1940-ns"
pga = "0.21 g"
duration = "1.5 s"

[[building]]
name = "heavy"
kind = "shear"
storeys = 4
mass = "367.8 t"
stiffness = "253.34 MN/m"
storey_height = "3 m"

[[building]]
name = "light"
kind = "shear"
storeys = 5
mass = "72.2 t"
stiffness = "241.33 MN/m"
storey_height = "3 m"

[[gap]]
between = ["heavy", "light"]
width = "2.4 mm"
law = "modified-kelvin"
stiffness = "324 MN/m"
restitution = 0.42
"#;

/// Start and end of all impacts \[s\].
fn impacts(solver: &str, tolerance: &str) -> Vec<[f64; 2]> {
    let folder = folder();
    let path = folder.path().join("towers.toml");
    let analysis = format!("\n[analysis]\nsolver = \"{solver}\"\ntolerance = {tolerance}\n");
    std::fs::write(&path, format!("{TOWERS}{analysis}")).expect("a model");
    let output = jostle(
        folder.path(),
        &["run", "towers.toml", "--json", "--no-report"],
    );
    assert!(output.status.success(), "{}", complained(&output));
    let summary: serde_json::Value = serde_json::from_str(&printed(&output)).expect("a summary");
    let contacts = summary["gaps"][0]["contacts"].as_array().expect("contacts");
    let lists = contacts
        .iter()
        .filter_map(|contact| contact["impacts"].as_array());
    let mut found: Vec<[f64; 2]> = lists
        .flatten()
        .map(|impact| ["start_s", "end_s"].map(|name| impact[name].as_f64().expect(name)))
        .collect();
    found.sort_by(|a, b| a[0].total_cmp(&b[0]));
    found
}

#[test]
fn a_short_opening_makes_two_impacts() {
    let fine = impacts("riccati", "1e-5");
    assert_eq!(fine.len(), 6);
    for (solver, tolerance) in [("riccati", "1e-3"), ("modal", "1e-2"), ("modal", "1e-3")] {
        let found = impacts(solver, tolerance);
        assert_eq!(found.len(), fine.len(), "{solver}, {tolerance}: {found:?}");
        for (got, wanted) in found.iter().flatten().zip(fine.iter().flatten()) {
            let apart = (got - wanted).abs();
            assert!(
                apart < 5e-4,
                "{solver}, {tolerance}: {got} against {wanted} s"
            );
        }
    }
}
