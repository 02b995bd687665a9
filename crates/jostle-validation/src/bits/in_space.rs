//! Drawn buildings in space: beside each other, around corners, with friction, frames and walls in plan, springs that yield.

use jostle::Solver;
use serde_json::{Value, json};

use super::drawing::{
    RULES, STOREY, frame_hinges, gap_in_plan, hinge, in_plan, random, shaking_in_plan,
};
use super::pinned::Pinned;
use crate::certify::{Random, digits};

/// Length of the motion \[s\].
const DURATION: f64 = 2.0;
/// The same for space frames, which take long \[s\].
const DURATION_OF_FRAMES: f64 = 1.2;

/// Every model.
pub(super) fn models() -> Vec<Pinned> {
    let models = (1..=26).map(|number| {
        let mut random = random(1, number);
        let (kind, tree): (&str, Value) = match number {
            1..=4 => ("beside", beside(&mut random)),
            5..=7 => ("walls", walls(&mut random)),
            8..=9 => ("l-shape", l_shape(&mut random)),
            10..=12 => ("corners", corners(&mut random)),
            13..=15 => ("friction", friction(&mut random, number)),
            16..=18 => ("yielding", yielding(&mut random, number)),
            19 | 20 => ("frames", frames(&mut random, number == 20)),
            21 | 22 => ("space-frame", space_frames(&mut random, number == 22)),
            23 => ("around-a-corner", around_a_corner(&mut random)),
            24 => ("upper-storeys", upper_storeys(&mut random)),
            25 => ("struck-columns", struck_columns(&mut random)),
            _ => ("struck-lines", struck_lines(&mut random)),
        };
        let solvers: &[Solver] = match number {
            16..=18 | 20 | 22 | 26 => &[Solver::Riccati, Solver::Stiffness],
            _ if number.is_multiple_of(3) => &[Solver::Modal, Solver::Riccati, Solver::Stiffness],
            _ => &[Solver::Modal, Solver::Riccati],
        };
        Pinned::drawn(format!("space-{number}-{kind}"), &tree, solvers)
    });
    models.collect()
}

fn whole(random: &mut Random, duration: f64, buildings: &[Value], gaps: &[Value]) -> Value {
    json!({"motion": shaking_in_plan(random, duration), "building": buildings, "gap": gaps})
}

/// Distance of neighbours \[m\].
fn apart(random: &mut Random) -> f64 {
    random.scaled(0.003, 0.025)
}

fn pair(random: &mut Random) -> [Value; 2] {
    let left = [digits(random.between(8.0, 16.0)), 10.0];
    let x = left[0] + apart(random);
    let y = digits(random.between(-4.0, 4.0));
    let (first, second) = (random.whole(2, 4), random.whole(1, 3));
    [
        in_plan(random, "A", first, left, [0.0, 0.0]),
        in_plan(random, "B", second, [9.0, 8.0], [x, y]),
    ]
}

/// Two rectangles whose faces touch.
fn beside(random: &mut Random) -> Value {
    let pair = pair(random);
    let gap = gap_in_plan(random, ["A", "B"]);
    whole(random, DURATION, &pair, &[gap])
}

/// The same, the right one of columns and walls at points.
fn walls(random: &mut Random) -> Value {
    let mut pair = pair(random);
    stand_on_elements(random, &mut pair[1]);
    pair[0]["p_delta"] = json!(random.chance(0.5));
    let mut gap = gap_in_plan(random, ["A", "B"]);
    gap["points"] = json!(random.whole(2, 7));
    whole(random, DURATION, &pair, &[gap])
}

/// Columns and walls at points instead of storey springs.
fn stand_on_elements(random: &mut Random, building: &mut Value) {
    let elements = [[0.4, 0.4], [8.6, 0.5], [8.5, 7.6], [0.5, 7.5]].map(|at| {
        json!({"at": at, "stiffness": {"x": random.scaled(2e7, 6e7), "y": random.scaled(2e7, 6e7)}})
    });
    if let Some(keys) = building.as_object_mut() {
        keys.remove("stiffness");
        keys.remove("eccentricity");
    }
    building["element"] = json!(elements);
}

/// An L-shaped plan, with the neighbour in its recess.
fn l_shape(random: &mut Random) -> Value {
    let width = apart(random);
    let mut left = in_plan(random, "A", 3, [16.0, 14.0], [0.0, 0.0]);
    left["plan"] = json!([[0, 0], [16, 0], [16, 6], [8, 6], [8, 14], [0, 14]]);
    let right = in_plan(random, "B", 2, [7.0, 7.0], [8.0 + width, 6.0 + width]);
    let gap = gap_in_plan(random, ["A", "B"]);
    whole(random, DURATION, &[left, right], &[gap])
}

/// Corners that pass each other.
fn corners(random: &mut Random) -> Value {
    let (x, y) = (10.0 + apart(random), 8.0 + random.scaled(0.001, 0.01));
    let left = in_plan(random, "A", 2, [10.0, 8.0], [0.0, 0.0]);
    let right = in_plan(random, "B", 2, [9.0, 9.0], [x, y]);
    let mut gap = gap_in_plan(random, ["A", "B"]);
    gap["width"] = json!((y - 8.0).min(x - 10.0));
    gap["law"] = json!("linear");
    gap["stiffness"] = json!(random.scaled(5e7, 3e8));
    if let Some(keys) = gap.as_object_mut() {
        keys.remove("restitution");
        keys.remove("restitution_is");
    }
    whole(random, DURATION, &[left, right], &[gap])
}

/// Faces that stick and slide.
fn friction(random: &mut Random, number: usize) -> Value {
    let pair = pair(random);
    let mut gap = gap_in_plan(random, ["A", "B"]);
    gap["friction"] = json!(digits(random.between(0.1, 0.6)));
    if number == 15 {
        gap["tangential_stiffness"] = json!(random.scaled(5e7, 5e8));
    }
    whole(random, DURATION, &pair, &[gap])
}

/// Storeys and elements that yield along x, across, or both.
fn yielding(random: &mut Random, number: usize) -> Value {
    let mut pair = pair(random);
    let mut rule = RULES[random.below(5)];
    let yields = digits(random.between(0.004, 0.01));
    pair[0]["hinges"] = hinge(random, rule, yields);
    stand_on_elements(random, &mut pair[1]);
    rule = RULES[number - 15];
    let mut hinge = hinge(random, rule, yields);
    if number == 17 {
        hinge["x"] = json!({"yield": digits(0.8 * yields)});
        hinge["y"] = json!({"yield": yields});
    }
    pair[1]["element"][0]["hinges"] = hinge;
    pair[1]["element"][0]["name"] = json!("core");
    let gap = gap_in_plan(random, ["A", "B"]);
    whole(random, DURATION, &pair, &[gap])
}

/// Plane frames at lines of a plan.
fn frames(random: &mut Random, yields: bool) -> Value {
    let width = apart(random);
    let mut line = |at: Value, direction: &str| {
        let depth = digits(random.between(0.45, 0.6));
        let mut frame = json!({
            "at": at, "direction": direction, "spans": [5, 5], "column": {"width": depth, "depth": depth},
            "beam": {"width": 0.3, "depth": 0.5}, "elastic_modulus": 3e10, "axial": {"columns": "flexible"},
        });
        if yields {
            frame["hinges"] = frame_hinges(random, "takeda");
        }
        frame
    };
    let frames = [
        line(json!([[0, 0], [0, 10]]), "x"),
        line(json!([[0, 0], [10, 0]]), "y"),
    ];
    let office = json!({
        "name": "A", "kind": "frame", "plan": [10, 10], "at": [0, 0], "storey_height": STOREY,
        "mass": [7e4, 6e4], "frame": frames, "damping": {"alpha": 0.4, "beta": 0.002},
    });
    let right = in_plan(random, "B", 2, [8.0, 7.0], [10.0 + width, 1.0]);
    let gap = gap_in_plan(random, ["A", "B"]);
    whole(random, DURATION_OF_FRAMES, &[office, right], &[gap])
}

/// Columns and beams in space.
fn space_frames(random: &mut Random, yields: bool) -> Value {
    let width = apart(random);
    let mut office = json!({
        "name": "A", "kind": "space-frame", "lines_x": [0, 6, 11], "lines_y": [0, 5], "at": [0, 0],
        "storey_height": STOREY, "mass": [8e4, 7e4], "mass_centre": [5.2, 2.8], "elastic_modulus": 2.8e10,
        "torsion_factor": 0.2, "shear": "flexible",
        "column": [{"size": [0.45, 0.4]}, {"size": [0.6, 0.55], "x": 1, "y": 1}],
        "beam_x": {"width": 0.3, "depth": 0.5}, "beam_y": {"width": 0.25, "depth": 0.45},
        "damping": {"alpha": 0.4, "beta": 0.002},
    });
    if yields {
        office["hinges"] = frame_hinges(random, "peak-oriented");
    }
    let right = in_plan(random, "B", 2, [8.0, 7.0], [11.0 + width, -1.0]);
    let mut gap = gap_in_plan(random, ["A", "B"]);
    gap["friction"] = json!(0.3);
    let mut tree = whole(random, DURATION_OF_FRAMES, &[office, right], &[gap]);
    tree["output"] = json!({"members": ["A.column.1.1.1", "A.column.2.2.2"]});
    tree
}

/// The same with floors beside them at other heights.
fn struck_columns(random: &mut Random) -> Value {
    let mut tree = space_frames(random, false);
    tree["building"][1]["storey_height"] = json!(2.2);
    tree["gap"][0]["floors"] = json!([["2.2 m", 1], ["4.4 m", 2]]);
    tree
}

/// Frames at lines that yield, whose columns stand beside floors at other heights.
fn struck_lines(random: &mut Random) -> Value {
    let mut tree = frames(random, true);
    tree["building"][0]["frame"][0]["at"] = json!([[0, 0], [0, 5], [0, 10]]);
    tree["building"][0]["frame"][0]["density"] = json!(2400);
    tree["building"][1]["storey_height"] = json!(2.2);
    tree["gap"][0]["floors"] = json!([["2.2 m", 1], ["4.4 m", 2]]);
    tree["output"] = json!({"members": true});
    tree
}

/// A neighbour beside and one behind, with one gap for all.
fn around_a_corner(random: &mut Random) -> Value {
    let (beside, behind) = (apart(random), apart(random));
    let buildings = [
        in_plan(random, "A", 2, [12.0, 10.0], [0.0, 0.0]),
        in_plan(random, "B", 3, [10.0, 7.0], [12.0 + beside, 2.0]),
        in_plan(random, "C", 1, [10.0, 12.0], [1.0, 10.0 + behind]),
    ];
    let mut gap = gap_in_plan(random, ["A", "B"]);
    if let Some(keys) = gap.as_object_mut() {
        keys.remove("between");
    }
    gap["between"] = json!("all");
    whole(random, DURATION, &buildings, &[gap])
}

/// Plans that differ from floor to floor, and other storey heights beside them.
fn upper_storeys(random: &mut Random) -> Value {
    let mut pair = pair(random);
    pair[0] = in_plan(random, "A", 2, [12.0, 10.0], [0.0, 0.0]);
    pair[0]["plan"] = json!([{"size": [12, 10]}, {"corners": [[0, 0], [12, 0], [12, 6], [0, 6]]}]);
    let x = 12.0 + apart(random);
    pair[1] = in_plan(random, "B", 2, [9.0, 8.0], [x, 1.0]);
    let gap = gap_in_plan(random, ["A", "B"]);
    whole(random, DURATION, &pair, &[gap])
}
