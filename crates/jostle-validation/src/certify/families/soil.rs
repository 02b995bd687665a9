//! Shear buildings on foundations on soil.

use serde_json::{Value, json};

use super::{Random, damping, gaps, hinges, motion, shear, storeys};
use crate::certify::random::digits;

pub(super) fn draw(random: &mut Random) -> Value {
    let height = digits(random.between(2.8, 4.0));
    let count = if random.chance(0.3) { 1 } else { 2 };
    let (mut buildings, mut first) = (Vec::new(), None);
    let embedded = random.chance(0.3);
    for k in 1..=count {
        let (mut tree, period) = shear(random, &format!("B{k}"), height, 7);
        first.get_or_insert(period);
        tree.insert("damping".into(), damping(random, storeys(&tree)));
        if random.chance(0.3) {
            tree.insert("hinges".into(), hinges(random, height));
        }
        let mass = tree["mass"][0].as_f64().unwrap_or(1e5);
        // Some 0.6 t for every square metre of a floor.
        let side = (mass / 600.0).sqrt().clamp(5.0, 30.0);
        let mut foundation = json!({
            "length": digits(side * random.between(0.8, 1.25)),
            "width": digits(side * random.between(0.8, 1.25)),
            "mass": digits(mass * random.between(0.8, 2.5)),
        });
        if embedded {
            foundation["embedment"] = json!(digits(random.between(0.5, 3.0)));
        }
        tree.insert("foundation".into(), foundation);
        buildings.push(Value::Object(tree));
    }
    let coupled = count == 2 && !embedded && random.chance(0.5);
    let wall = count == 1 && random.chance(0.4);
    let gaps = gaps(random, count, wall);
    json!({
        "motion": motion(random, first.unwrap_or(1.0), 12.0),
        "soil": {
            "shear_wave_velocity": random.scaled(80.0, 400.0),
            "density": digits(random.between(1600.0, 2100.0)),
            "poisson_ratio": digits(random.between(0.25, 0.45)),
            "damping": digits(random.between(0.0, 0.1)),
            "coupling": if coupled { "static" } else { "none" },
        },
        "building": buildings,
        "gap": gaps,
    })
}
