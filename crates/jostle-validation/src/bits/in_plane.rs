//! Models in one plane whose buildings do not yield: random ones, every contact law, the built-in examples.

use jostle::Solver;
use jostle_io::builtin_model;
use serde_json::{Value, json};

use super::pinned::{Pinned, shorten};
use crate::certify::draw;

/// Random models, of a seed that nothing else uses.
const DRAWN: u64 = 48;
const SEED: u64 = 2024;
/// Longest motion of a drawn model \[s\].
const LONGEST: f64 = 2.0;
/// The same of models with many short steps \[s\].
const LONGEST_OF_SLOW: f64 = 1.2;
/// Those models: buildings that come to rest against each other.
const SLOW: [u64; 2] = [23, 39];
/// Every law, with features that random models seldom have.
const LAWS: [&str; 12] = [
    r#""law": "linear", "stiffness": 4e8"#,
    r#""law": "kelvin", "stiffness": 4e8, "restitution": 0.6"#,
    r#""law": "kelvin-no-tension", "stiffness": 4e8, "restitution": 0.6"#,
    r#""law": "modified-kelvin", "stiffness": 4e8, "restitution": 0.6"#,
    r#""law": "modified-kelvin", "variant": "mahmoud-jankowski", "stiffness": 4e8, "restitution": 0.6"#,
    r#""law": "hertz", "stiffness": 3e9"#,
    r#""law": "hertz-damp", "stiffness": 3e9, "restitution": 0.6"#,
    r#""law": "ye", "stiffness": 3e9, "restitution": 0.6"#,
    r#""law": "jankowski", "stiffness": 3e9, "restitution": 0.6"#,
    r#""law": "bilinear", "stiffness": 2e9, "restitution": 0.6"#,
    r#""law": "restitution", "restitution": 0.6"#,
    r#""law": "rubber", "stiffness": 3e7, "thickness": 0.02, "restitution": 0.5"#,
];
const TOWERS: &str = r#"{"motion": {"record": "el-centro-1940-ns", "pga": 3.4, "duration": 3},
"building": [
  {"name": "A", "kind": "shear", "mass": [4e4, 4e4, 3e4], "stiffness": [3e7, 3e7, 2e7], "storey_height": 3.2},
  {"name": "B", "kind": "shear", "mass": [6e4, 6e4, 5e4], "stiffness": [9e7, 9e7, 8e7], "storey_height": 3.2}],
"gap": [{"between": ["A", "B"], "width": 0.02, LAW}]}"#;

/// Every model.
pub(super) fn models() -> Vec<Pinned> {
    let drawn = (1..=DRAWN).map(|number| {
        let drawn = draw(SEED, number);
        let mut tree = drawn.tree;
        if drawn.pulse.is_some() {
            // The record of a pulse is no file.
            tree["motion"] =
                json!({"kind": "ricker", "amplitude": 4, "period": 0.8, "duration": LONGEST});
        }
        let length = tree["motion"]["duration"].as_f64().unwrap_or(LONGEST);
        let slow = SLOW.contains(&number);
        let longest = if slow { LONGEST_OF_SLOW } else { LONGEST };
        tree["motion"]["duration"] = json!(length.min(longest));
        let solvers = [Solver::Modal, Solver::Riccati, Solver::Stiffness];
        let solvers = &solvers[..if number.is_multiple_of(6) { 3 } else { 2 }];
        Pinned::drawn(format!("drawn-{number}"), &tree, solvers)
    });
    let laws = LAWS.iter().zip(1..).map(|(law, number)| {
        let tree: Value = serde_json::from_str(&TOWERS.replace("LAW", law)).unwrap_or_default();
        Pinned::drawn(
            format!("law-{number}"),
            &tree,
            &[Solver::Modal, Solver::Riccati],
        )
    });
    let builtin = [("paper", 5.0), ("paper-inelastic", 2.5)].map(|(name, duration)| Pinned {
        name: name.to_owned(),
        input: builtin_model(name)
            .map(|mut input| {
                shorten(&mut input, duration);
                input
            })
            .map_err(|error| error.to_string()),
        solvers: vec![Solver::Modal, Solver::Riccati, Solver::Stiffness],
    });
    drawn.chain(laws).chain(builtin).collect()
}
