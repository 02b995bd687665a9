//! Drawn buildings joined by links of every law, and with dampers between their own floors.

use jostle::Solver;
use serde_json::{Value, json};

use super::drawing::{RULES, frame, gap_in_plane, hinge, random, shaking, shear, storey_hinges};
use super::pinned::Pinned;
use crate::certify::{Random, digits};

/// Length of the motion \[s\].
const DURATION: f64 = 3.0;

/// Every model.
pub(super) fn models() -> Vec<Pinned> {
    let models = (1..=12).map(|number| {
        let mut random = random(4, number);
        let tree = row(&mut random, number);
        let solvers: &[Solver] = match number {
            1 | 2 => &[Solver::Modal, Solver::Riccati, Solver::Stiffness],
            _ if number.is_multiple_of(2) => &[Solver::Riccati, Solver::Stiffness],
            _ => &[Solver::Riccati],
        };
        Pinned::drawn(format!("linked-{number}"), &tree, solvers)
    });
    models.collect()
}

fn row(random: &mut Random, number: usize) -> Value {
    let mut left = shear(random, "A", 3);
    let mut right = if number.is_multiple_of(3) {
        frame(random, "B", 3)
    } else {
        shear(random, "B", 3)
    };
    let mut link = law(random, number);
    if number == 12 {
        left["damper"] = json!([with(link.clone(), "floors", json!([[0, 1], [1, 2]]))]);
        right["hinges"] = storey_hinges(random, "takeda");
        if right["kind"] == json!("frame") {
            right = shear(random, "B", 3);
        }
        let other = law(random, 4);
        right["damper"] = json!([with(other, "floors", json!([1, 3]))]);
        link = law(random, 1);
    }
    let floors = match random.below(3) {
        0 => json!("common"),
        1 => json!([[2, 2], [3, 3]]),
        _ => json!([[1, 1], [3, 3]]),
    };
    link["between"] = json!(["A", "B"]);
    link["floors"] = floors;
    let gap = gap_in_plane(random, ["A", "B"]);
    let mut output = json!({"links": number.is_multiple_of(2)});
    if number % 4 == 1 {
        output["floor_spectra"] =
            json!({"floors": ["A.floor.3"], "periods": [0.05, 0.2, 0.5, 1.0]});
    }
    json!({
        "motion": shaking(random, DURATION), "building": [left, right], "gap": [gap], "link": [link], "output": output,
    })
}

fn with(mut table: Value, key: &str, value: Value) -> Value {
    table[key] = value;
    table
}

/// Law 1 to 12 of a link.
fn law(random: &mut Random, number: usize) -> Value {
    let stiffness = random.scaled(1e7, 8e7);
    let force = random.scaled(3e4, 1e5);
    match number {
        1 => json!({"stiffness": stiffness, "damping": random.scaled(1e5, 1e6)}),
        2 => json!({"law": "linear", "damping": random.scaled(1e5, 2e6)}),
        3 => json!({"law": "viscous", "damping": random.scaled(5e4, 2e5), "exponent": 0.35}),
        4 => {
            json!({"law": "viscous", "damping": random.scaled(5e4, 2e5), "exponent": 0.5, "stiffness": 1e8})
        }
        5 => json!({"law": "viscous", "damping": random.scaled(2e5, 1e6), "exponent": 1.5}),
        6 => json!({"law": "maxwell", "damping": random.scaled(2e5, 1e6), "stiffness": stiffness}),
        7 => json!({"law": "friction", "slip_force": force, "stick_stiffness": stiffness}),
        8 => {
            json!({"law": "cable", "stiffness": stiffness, "slack": digits(random.between(0.001, 0.01))})
        }
        9 => {
            json!({"law": "stopper", "stiffness": stiffness, "gap": digits(random.between(0.001, 0.01))})
        }
        _ => {
            let rule = RULES[random.below(RULES.len() - 1)];
            json!({"law": "yielding", "stiffness": stiffness, "hinge": hinge(random, rule, force)})
        }
    }
}
