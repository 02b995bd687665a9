//! Drawn rows on grounds that move apart, shaken upwards, before walls, and of buildings given by matrices or modes.

use jostle::Solver;
use serde_json::{Value, json};

use super::drawing::{
    STOREY, frame, gap_in_plan, gap_in_plane, in_plan, random, shaking, shaking_in_plan, shear,
    storey_hinges,
};
use super::pinned::Pinned;
use crate::certify::{Random, digits};

/// Length of the motion \[s\].
const DURATION: f64 = 2.5;
/// The same of frames shaken upwards, which take long \[s\].
const DURATION_OF_SLOW: f64 = 1.2;

/// Draws the tree of a model.
type Draw = fn(&mut Random) -> Value;

/// Every model.
pub(super) fn models() -> Vec<Pinned> {
    let kinds: [(&str, Draw); 12] = [
        ("matrices", matrices),
        ("matrices-with-damping", matrices_with_damping),
        ("modes", modes),
        ("arrival", arrival),
        ("velocity", velocity),
        ("coherency", coherency),
        ("record", other_record),
        ("waves", waves),
        ("waves-and-friction", waves_and_friction),
        ("upwards", upwards),
        ("upwards-yielding", upwards_yielding),
        ("walls", walls),
    ];
    let models = kinds.into_iter().zip(1..).map(|((kind, draw), number)| {
        let mut random = random(5, number);
        let tree = draw(&mut random);
        let solvers = [Solver::Modal, Solver::Riccati, Solver::Stiffness];
        let solvers = &solvers[..if number.is_multiple_of(2) { 3 } else { 2 }];
        Pinned::drawn(format!("ground-{kind}"), &tree, solvers)
    });
    models.collect()
}

fn whole(random: &mut Random, buildings: &[Value]) -> Value {
    let gap = gap_in_plane(random, ["A", "B"]);
    json!({"motion": shaking(random, DURATION), "building": buildings, "gap": [gap]})
}

/// A building by its matrices, with a rotation that has little mass.
fn given(random: &mut Random, name: &str) -> Value {
    let [k, m] = [random.scaled(4e7, 1e8), random.scaled(4e4, 1e5)];
    let turning = 6.0 * k;
    let stiffness = [
        [2.0 * k, -k, 0.2 * k],
        [-k, k, 0.1 * k],
        [0.2 * k, 0.1 * k, turning],
    ];
    json!({
        "name": name, "kind": "given",
        "matrices": {"stiffness": stiffness, "mass": [m, 0.8 * m, 2.0 * m], "influence": [1, 1, 0]},
        "ports": {"1": {"dof": 1, "height": STOREY}, "2": {"dof": 2, "height": 2.0 * STOREY}},
        "damping": {"ratio": digits(random.between(0.02, 0.06)), "modes": [1]},
    })
}

fn matrices(random: &mut Random) -> Value {
    let buildings = [given(random, "A"), shear(random, "B", 3)];
    whole(random, &buildings)
}

fn matrices_with_damping(random: &mut Random) -> Value {
    let mut building = given(random, "A");
    let c = random.scaled(2e5, 8e5);
    building["matrices"]["damping"] =
        json!([[2.0 * c, -c, 0.0], [-c, 1.2 * c, 0.0], [0.0, 0.0, 3.0 * c]]);
    if let Some(keys) = building.as_object_mut() {
        keys.remove("damping");
    }
    let buildings = [building, frame(random, "B", 2)];
    whole(random, &buildings)
}

fn modes(random: &mut Random) -> Value {
    let building = json!({
        "name": "A", "kind": "given", "mass": [9e4, 8e4, 7e4], "storey_height": STOREY,
        "periods": [digits(random.between(0.4, 0.7)), digits(random.between(0.12, 0.2))],
        "shapes": [[0.35, 0.7, 1.0], [0.9, 0.6, -0.885]], "damping": {"ratio": 0.05, "modes": [1, 2]},
    });
    let buildings = [building, shear(random, "B", 3)];
    whole(random, &buildings)
}

/// Arrivals one after the other, at a link as well.
fn arrival(random: &mut Random) -> Value {
    let mut buildings = [shear(random, "A", 3), frame(random, "B", 2)];
    buildings[1]["motion"] = json!({"arrival": digits(random.between(0.02, 0.1))});
    let mut tree = whole(random, &buildings);
    tree["link"] =
        json!([{"between": ["A", "B"], "floors": [[1, 1]], "stiffness": 2e7, "damping": 3e5}]);
    tree
}

/// Waves along the row, below yielding storeys.
fn velocity(random: &mut Random) -> Value {
    let mut buildings = [shear(random, "A", 3), shear(random, "B", 2)];
    buildings[0]["position"] = json!(0);
    buildings[1]["position"] = json!(digits(random.between(10.0, 30.0)));
    buildings[1]["hinges"] = storey_hinges(random, "peak-oriented");
    let mut tree = whole(random, &buildings);
    tree["motion"]["apparent_velocity"] = json!(digits(random.between(150.0, 500.0)));
    tree
}

fn coherency(random: &mut Random) -> Value {
    let mut buildings = [shear(random, "A", 3), shear(random, "B", 2)];
    buildings[0]["position"] = json!(0);
    buildings[1]["position"] = json!(digits(random.between(10.0, 30.0)));
    let gap = gap_in_plane(random, ["A", "B"]);
    let motion = json!({
        "record": "el-centro-1940-ns", "scale": 1.5, "duration": DURATION, "baseline": "as-recorded",
        "coherency": {"alpha": 0.1, "shear_wave_velocity": 250, "seed": 7},
    });
    json!({"motion": motion, "building": buildings, "gap": [gap]})
}

/// Another motion below one building.
fn other_record(random: &mut Random) -> Value {
    let mut buildings = [shear(random, "A", 3), shear(random, "B", 2)];
    buildings[1]["motion"] =
        json!({"kind": "ricker", "amplitude": 3.5, "period": 0.7, "centre": 1.0, "arrival": 0.05});
    let mut tree = whole(random, &buildings);
    tree["motion"]["baseline"] = json!("as-recorded");
    tree
}

fn plans(random: &mut Random) -> [Value; 2] {
    let width = random.scaled(0.004, 0.02);
    [
        in_plan(random, "A", 2, [11.0, 9.0], [0.0, 0.0]),
        in_plan(random, "B", 3, [9.0, 8.0], [11.0 + width, 1.5]),
    ]
}

/// Waves through plans.
fn waves(random: &mut Random) -> Value {
    let buildings = plans(random);
    let gap = gap_in_plan(random, ["A", "B"]);
    let mut motion = shaking_in_plan(random, DURATION / 2.0);
    motion["apparent_velocity"] = json!(digits(random.between(150.0, 500.0)));
    motion["wave_angle"] = json!(digits(random.between(0.1, 1.0)));
    json!({"motion": motion, "building": buildings, "gap": [gap]})
}

fn waves_and_friction(random: &mut Random) -> Value {
    let mut tree = waves(random);
    tree["gap"][0]["friction"] = json!(0.35);
    tree
}

/// Frames under their weight, shaken upwards as well.
fn upwards(random: &mut Random) -> Value {
    let mut buildings = [frame(random, "A", 2), frame(random, "B", 3)];
    for building in &mut buildings {
        building["axial"] = json!({"columns": "flexible"});
        building["gravity"] = json!(true);
    }
    let mut tree = whole(random, &buildings);
    tree["motion"]["duration"] = json!(DURATION_OF_SLOW);
    tree["motion"]["vertical"] = json!({"scale": 0.67});
    tree
}

fn upwards_yielding(random: &mut Random) -> Value {
    let mut tree = upwards(random);
    tree["building"][1]["hinges"] = super::drawing::frame_hinges(random, "bilinear");
    tree["motion"]["vertical"] = json!({"kind": "sine", "amplitude": 2, "period": 0.2});
    tree["building"][1]["gravity"] = json!(false);
    tree
}

/// A rigid wall at one end, one that gives way at the other.
fn walls(random: &mut Random) -> Value {
    let buildings = [shear(random, "A", 3), frame(random, "B", 2)];
    let mut tree = whole(random, &buildings);
    tree["wall"] = json!([{"name": "retaining", "stiffness": 9e7, "damping": 8e5, "mass": 2e4}]);
    let mut first = gap_in_plane(random, ["wall", "A"]);
    first["floors"] = json!([["wall", 1], ["wall", 3]]);
    first["width"] = json!([0.006, 0.012]);
    let mut last = gap_in_plane(random, ["B", "retaining"]);
    last["floors"] = json!([[1, "wall"]]);
    last["law"] = json!("hertz-damp");
    last["stiffness"] = json!(2e9);
    last["restitution"] = json!(0.6);
    let gaps = [first, tree["gap"][0].clone(), last];
    tree["gap"] = json!(gaps);
    tree
}
