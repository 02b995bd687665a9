//! Models in one plane whose buildings do not yield: random ones, every contact law, the built-in examples.

use jostle::Solver;
use jostle_io::{Format, Input, builtin_model, read_model_text};
use serde_json::{Value, json};

use crate::certify::draw;

/// Random models, of a seed that nothing else uses.
const DRAWN: u64 = 48;
const SEED: u64 = 2024;
/// Longest motion of a drawn model \[s\].
const LONGEST: f64 = 4.0;
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
const TOWERS: &str = r#"{"motion": {"record": "el-centro-1940-ns", "pga": 3.4, "duration": 5},
"building": [
  {"name": "A", "kind": "shear", "mass": [4e4, 4e4, 3e4], "stiffness": [3e7, 3e7, 2e7], "storey_height": 3.2},
  {"name": "B", "kind": "shear", "mass": [6e4, 6e4, 5e4], "stiffness": [9e7, 9e7, 8e7], "storey_height": 3.2}],
"gap": [{"between": ["A", "B"], "width": 0.02, LAW}]}"#;

/// A model to run by a solver.
pub(super) struct Case {
    /// Model and solver.
    pub(super) name: String,
    /// The model; `None` if the reader refuses it.
    pub(super) input: Option<Input>,
    /// The solver.
    pub(super) solver: Solver,
}

fn read(tree: &Value) -> Option<Input> {
    read_model_text("bits", &tree.to_string(), Format::Json, "".as_ref()).ok()
}

/// Every model under every solver.
pub(super) fn cases() -> Vec<Case> {
    let mut cases = Vec::new();
    let mut add = |name: String, input: Option<Input>, solver: Solver| {
        cases.push(Case {
            name: format!("{name} {}", solver.name()),
            input,
            solver,
        });
    };
    for number in 1..=DRAWN {
        let mut tree = draw(SEED, number).tree;
        let longest = tree["motion"]["duration"].as_f64().unwrap_or(LONGEST);
        tree["motion"]["duration"] = json!(longest.min(LONGEST));
        let input = read(&tree);
        let name = format!("drawn-{number}");
        add(name.clone(), input.clone(), Solver::Modal);
        add(name.clone(), input.clone(), Solver::Riccati);
        if number % 6 == 0 {
            add(name.clone(), input.clone(), Solver::Stiffness);
        }
    }
    for (number, law) in LAWS.iter().enumerate() {
        let tree = serde_json::from_str(&TOWERS.replace("LAW", law)).ok();
        let input = tree.and_then(|tree: Value| read(&tree));
        for solver in [Solver::Modal, Solver::Riccati] {
            add(format!("law-{}", number + 1), input.clone(), solver);
        }
    }
    for (name, duration) in [("paper", 8.0), ("paper-inelastic", 3.0)] {
        let input = builtin_model(name).map(|mut input| {
            if let Some(motion) = &mut input.motion {
                motion.duration = Some(duration);
            }
            input
        });
        let input = input.ok();
        for solver in [Solver::Modal, Solver::Riccati, Solver::Stiffness] {
            add(name.to_owned(), input.clone(), solver);
        }
    }
    cases
}
