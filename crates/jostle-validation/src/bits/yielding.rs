//! Drawn buildings whose storeys, hinges and columns yield or fail, by every rule.

use jostle::Solver;
use serde_json::{Value, json};

use super::drawing::{
    RULES, frame, frame_hinges, gap_in_plane, random, shaking, shear, shorten_if_lasting,
    storey_hinges,
};
use super::pinned::Pinned;
use crate::certify::Random;

/// Length of the motion \[s\].
const DURATION: f64 = 3.0;
/// The same for frames \[s\].
const DURATION_OF_FRAMES: f64 = 2.0;
/// The same with contacts of the momentum law \[s\].
const DURATION_IF_LASTING: f64 = 1.0;
/// Rules for the shear strength of columns.
const SHEAR_RULES: [&str; 5] = ["gb50010", "en1998-3", "asce41", "aci318", "sezen-moehle"];

/// Every model.
pub(super) fn models() -> Vec<Pinned> {
    let storeys = RULES.iter().zip(1..).map(|(rule, number)| {
        let mut random = random(6, number);
        let mut buildings = [shear(&mut random, "A", 3), shear(&mut random, "B", 4)];
        buildings[0]["hinges"] = storey_hinges(&mut random, rule);
        buildings[1]["hinges"] = storey_hinges(&mut random, RULES[number % RULES.len()]);
        buildings[1]["p_delta"] = json!(number.is_multiple_of(2));
        let tree = whole(&mut random, &buildings, DURATION);
        let solvers = [Solver::Series, Solver::Riccati, Solver::Stiffness];
        Pinned::drawn(format!("storeys-{rule}"), &tree, &solvers)
    });
    let frames = RULES.iter().zip(1..).map(|(rule, number)| {
        let mut random = random(7, number);
        let mut buildings = [frame(&mut random, "A", 2), shear(&mut random, "B", 3)];
        buildings[0]["hinges"] = frame_hinges(&mut random, rule);
        if number.is_multiple_of(2) {
            buildings[0]["hinges"]["initial"] = json!("rigid");
            buildings[0]["p_delta"] = json!(true);
        }
        let mut tree = whole(&mut random, &buildings, DURATION_OF_FRAMES);
        tree["output"] = json!({"members": ["A.column.1.1", "A.beam.2.1"]});
        let solvers = [Solver::Riccati, Solver::Stiffness];
        let solvers = &solvers[..if number.is_multiple_of(2) { 2 } else { 1 }];
        Pinned::drawn(format!("hinges-{rule}"), &tree, solvers)
    });
    let failing = SHEAR_RULES.iter().zip(1..).map(|(rule, number)| {
        let mut tree = reinforced(&mut random(8, number), rule, number);
        shorten_if_lasting(&mut tree, DURATION_IF_LASTING);
        Pinned::drawn(format!("reinforced-{rule}"), &tree, &[Solver::Riccati])
    });
    let elastic = (1..=2).map(|number| {
        let mut tree = reinforced(&mut random(9, number), SHEAR_RULES[number], number);
        for building in 0..2 {
            if let Some(keys) = tree["building"][building].as_object_mut() {
                keys.remove("hinges");
                keys.remove("shear_failure");
            }
        }
        tree["output"] = json!({"capacity": SHEAR_RULES});
        let solvers = [Solver::Modal, Solver::Riccati];
        Pinned::drawn(format!("capacity-{number}"), &tree, &solvers)
    });
    let bases = (1..=3).map(|number| {
        let mut random = random(10, number);
        let mut buildings = [frame(&mut random, "A", 2), shear(&mut random, "B", 2)];
        base(&mut random, &mut buildings, number);
        let tree = whole(&mut random, &buildings, DURATION_OF_FRAMES);
        Pinned::drawn(format!("base-{number}"), &tree, &[Solver::Riccati])
    });
    storeys
        .chain(frames)
        .chain(failing)
        .chain(elastic)
        .chain(bases)
        .collect()
}

fn whole(random: &mut Random, buildings: &[Value], duration: f64) -> Value {
    let gap = gap_in_plane(random, ["A", "B"]);
    json!({"motion": shaking(random, duration), "building": buildings, "gap": [gap]})
}

/// Springs below feet that yield.
fn base(random: &mut Random, buildings: &mut [Value; 2], number: usize) {
    let rule = RULES[number];
    let [turning, swaying] = [1.5e5, 8e4].map(|yields| super::drawing::hinge(random, rule, yields));
    buildings[0]["base"] = json!({"rotational_stiffness": 1e8, "rotational_hinge": turning});
    buildings[1]["base"] =
        json!({"horizontal_stiffness": 8e7, "horizontal_hinge": swaying, "mass": 2e4});
}

/// Reinforced frames with few ties beside stronger ones, whose floors strike columns.
fn reinforced(random: &mut Random, rule: &str, number: usize) -> Value {
    let mut buildings = [frame(random, "A", 2), frame(random, "B", 2)];
    for (building, ties) in buildings.iter_mut().zip(["d8 @ 200 mm", "d10 @ 100 mm"]) {
        if let Some(keys) = building.as_object_mut() {
            keys.remove("elastic_modulus");
        }
        building["column"] = json!({
            "width": 0.4, "depth": 0.4, "concrete": "C30", "steel": "HRB400", "bars": "8 d22", "ties": ties,
        });
        building["beam"] = json!({
            "width": 0.25, "depth": 0.5, "concrete": "C30", "steel": "HRB400", "bars": "3 d22 top, 3 d22 bottom",
            "ties": ties,
        });
    }
    buildings[0]["hinges"] = json!({"rule": "takeda", "from": "section"});
    buildings[0]["shear_failure"] = json!({"rule": rule, "residual": 0.1});
    let all = number % 2 == 1;
    if all {
        buildings[1]["storey_height"] = json!(3.7);
    }
    let mut tree = whole(random, &buildings, DURATION_OF_FRAMES);
    if all {
        tree["gap"][0]["floors"] = json!("all");
    }
    tree["output"] = json!({"capacity": [rule]});
    tree
}
