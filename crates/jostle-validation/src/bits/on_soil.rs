//! Drawn buildings on foundations that sway and rock, alone and coupled through the soil.

use jostle::Solver;
use serde_json::{Value, json};

use super::drawing::{
    frame, gap_in_plane, random, shaking, shear, shorten_if_lasting, storey_hinges,
};
use super::pinned::Pinned;
use crate::certify::{Random, digits};

/// Length of the motion \[s\].
const DURATION: f64 = 3.0;
/// The same with contacts of the momentum law \[s\].
const DURATION_IF_LASTING: f64 = 1.2;

/// Every model.
pub(super) fn models() -> Vec<Pinned> {
    let models = (1..=12).map(|number| {
        let mut random = random(3, number);
        let mut tree = row(&mut random, number);
        shorten_if_lasting(&mut tree, DURATION_IF_LASTING);
        let solvers = [Solver::Riccati, Solver::Stiffness];
        let solvers = &solvers[..if number.is_multiple_of(2) { 2 } else { 1 }];
        Pinned::drawn(format!("soil-{number}"), &tree, solvers)
    });
    models.collect()
}

fn row(random: &mut Random, number: usize) -> Value {
    let count = if number.is_multiple_of(4) { 3 } else { 2 };
    let given = number.is_multiple_of(3);
    let still = number % 3 == 1;
    let names = &["A", "B", "C"][..count];
    let buildings = names.iter().enumerate().map(|(index, name)| {
        let storeys = random.whole(1, 4);
        let mut building = if index == 1 && number.is_multiple_of(2) {
            frame(random, name, storeys)
        } else {
            shear(random, name, storeys)
        };
        building["p_delta"] = json!(random.chance(0.3));
        if number > 9 && index == 0 {
            building["hinges"] = storey_hinges(random, "bilinear");
        }
        // The foundation of a frame is no longer than the frame, lest it reach below a neighbour.
        let spans = building["spans"].as_array().map_or(12.0, |spans| {
            spans.iter().filter_map(Value::as_f64).sum::<f64>()
        });
        building["foundation"] = json!({
            "length": digits(spans * random.between(0.7, 0.95)), "width": digits(random.between(8.0, 14.0)),
            "mass": random.scaled(6e4, 2e5),
        });
        if still && index == 0 {
            building["foundation"]["embedment"] = json!(digits(random.between(0.5, 2.0)));
        }
        building
    });
    let buildings: Vec<Value> = buildings.collect();
    let soil = if given {
        json!({"coupling": matrices(random, count)})
    } else {
        json!({
            "shear_wave_velocity": digits(random.between(100.0, 300.0)), "density": 1800,
            "poisson_ratio": digits(random.between(0.25, 0.45)), "damping": digits(random.between(0.0, 0.1)),
            "coupling": if still { "none" } else { "static" },
        })
    };
    let gaps: Vec<Value> = names
        .windows(2)
        .map(|pair| gap_in_plane(random, [pair[0], pair[1]]))
        .collect();
    json!({"motion": shaking(random, DURATION), "soil": soil, "building": buildings, "gap": gaps})
}

/// Springs and dashpots over sway and rocking of every foundation, with entries between all of them.
fn matrices(random: &mut Random, count: usize) -> Value {
    let size = 2 * count;
    let mut matrix = |sway: f64, rocking: f64| {
        let scale = |k: usize| if k.is_multiple_of(2) { sway } else { rocking };
        let mut rows = vec![vec![0.0; size]; size];
        for i in 0..size {
            rows[i][i] = digits(scale(i) * random.between(0.9, 1.1));
            for j in 0..i {
                let between = 0.12 * (scale(i) * scale(j)).sqrt() * random.between(-1.0, 1.0);
                rows[i][j] = digits(between);
                rows[j][i] = rows[i][j];
            }
        }
        json!(rows)
    };
    json!({"stiffness": matrix(1.1e9, 4e10), "damping": matrix(4e7, 5e8)})
}
