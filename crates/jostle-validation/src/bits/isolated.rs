//! Drawn buildings on bearings, in one plane and with plans, some before moat walls.

use jostle::Solver;
use serde_json::{Value, json};

use super::drawing::{
    frame, gap_in_plan, gap_in_plane, in_plan, random, shaking, shaking_in_plan, shear,
};
use super::pinned::Pinned;
use crate::certify::{Random, digits};

/// Length of the motion \[s\].
const DURATION: f64 = 3.0;

/// Every model.
pub(super) fn models() -> Vec<Pinned> {
    let models = (1..=12).map(|number| {
        let mut random = random(2, number);
        let tree = if number <= 6 {
            in_one_plane(&mut random, number)
        } else {
            with_plan(&mut random, number)
        };
        let solvers = [Solver::Riccati, Solver::Stiffness];
        let solvers = &solvers[..if number.is_multiple_of(2) { 2 } else { 1 }];
        Pinned::drawn(format!("isolated-{number}"), &tree, solvers)
    });
    models.collect()
}

/// Bearings of kind 1 to 6.
fn bearings(random: &mut Random, kind: usize) -> Value {
    let mat = random.scaled(5e4, 1.5e5);
    let radius = digits(random.between(1.0, 2.5));
    match kind {
        1 => json!({
            "kind": "lead-rubber", "mat_mass": mat, "stiffness": random.scaled(2e7, 6e7),
            "yield": random.scaled(8e4, 3e5), "post_yield": 0.1, "damping": random.scaled(5e4, 2e5),
        }),
        2 => {
            json!({"kind": "friction-pendulum", "mat_mass": mat, "radius": radius, "friction": 0.05})
        }
        3 => json!({
            "kind": "friction-pendulum", "mat_mass": mat, "radius": radius, "slip_displacement": 0.002,
            "friction": {"slow": 0.03, "fast": digits(random.between(0.05, 0.09)), "rate": 50},
        }),
        4 => json!({
            "kind": "linear", "mat_mass": mat, "stiffness": random.scaled(3e6, 1e7), "damping_ratio": 0.12,
        }),
        5 => json!({
            "kind": "lead-rubber", "mat_mass": mat, "stiffness": random.scaled(2e7, 6e7),
            "yield": random.scaled(5e4, 2e5), "post_yield": 0.05, "stop": {"at": 0.02, "stiffness": 4e7},
        }),
        _ => json!({
            "kind": "friction-pendulum", "mat_mass": mat, "radius": radius, "friction": 0.02,
            "limit": 0.02,
        }),
    }
}

/// A neighbour, or a moat wall that gives way or does not.
fn in_one_plane(random: &mut Random, number: usize) -> Value {
    let storeys = random.whole(2, 4);
    let mut building = if number == 4 {
        frame(random, "A", 2)
    } else {
        shear(random, "A", storeys)
    };
    building["isolation"] = bearings(random, number);
    let mut buildings = vec![building];
    let mut walls = Vec::new();
    let mut gap = if number % 2 == 1 {
        let mut wall = json!({"name": "moat"});
        if number != 5 {
            wall = json!({"name": "moat", "stiffness": 1.2e8, "damping": 1.2e6, "mass": 25e3});
        }
        walls.push(wall);
        let mut gap = gap_in_plane(random, ["A", "moat"]);
        gap["floors"] = json!([[0, "wall"]]);
        gap
    } else {
        buildings.push(shear(random, "B", 3));
        gap_in_plane(random, ["A", "B"])
    };
    if gap["law"] == json!("restitution") {
        gap["law"] = json!("kelvin");
    }
    let mut tree =
        json!({"motion": shaking(random, DURATION), "building": buildings, "gap": [gap]});
    if !walls.is_empty() {
        tree["wall"] = json!(walls);
    }
    tree
}

/// The same kinds of bearings below plans, most before two moat walls.
fn with_plan(random: &mut Random, number: usize) -> Value {
    let mut plan = in_plan(random, "A", 2, [12.0, 9.0], [0.0, 0.0]);
    plan["isolation"] = bearings(random, number - 6);
    if number.is_multiple_of(2) {
        plan["isolation"]["bearings"] = json!([[1, 1], [11, 1], [11, 8], [1, 8], [6, 4.5]]);
    }
    let width = random.scaled(0.005, 0.02);
    let motion = shaking_in_plan(random, DURATION / 2.0);
    if number == 10 {
        let neighbour = in_plan(random, "B", 2, [8.0, 8.0], [12.0 + width, 0.5]);
        let gap = gap_in_plan(random, ["A", "B"]);
        return json!({"motion": motion, "building": [plan, neighbour], "gap": [gap]});
    }
    let wall =
        |name: &str, from: [f64; 2], to: [f64; 2]| json!({"name": name, "from": from, "to": to});
    let walls = [
        wall("right", [12.0 + width, -1.0], [12.0 + width, 10.0]),
        wall("upper", [13.0, 9.0 + width], [-1.0, 9.0 + width]),
    ];
    let gaps = ["right", "upper"].map(|name| {
        let mut gap = gap_in_plan(random, ["A", name]);
        gap["floors"] = json!([[0, "wall"]]);
        gap
    });
    json!({"motion": motion, "building": [plan], "wall": walls, "gap": gaps})
}
