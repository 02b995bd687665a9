//! Shear buildings on bearings, beside a fixed neighbour or alone.

use serde_json::{Map, Value, json};

use super::{Random, damping, gaps, motion, shear, storeys};
use crate::certify::random::digits;

pub(super) fn draw(random: &mut Random) -> Value {
    let height = digits(random.between(2.8, 4.0));
    let (mut tree, _) = shear(random, "B1", height, 6);
    let masses = tree["mass"].as_array().cloned().unwrap_or_default();
    let above: f64 = masses.iter().filter_map(Value::as_f64).sum();
    let mat = digits(above / masses.len() as f64 * random.between(0.5, 1.5));
    let whole = above + mat;
    let period = random.scaled(1.2, 3.5);
    let slow = whole * (2.0 * std::f64::consts::PI / period).powi(2);
    let mut isolation = Map::new();
    isolation.insert("mat_mass".into(), json!(mat));
    match random.below(4) {
        0 => {
            isolation.insert("kind".into(), json!("linear"));
            isolation.insert("stiffness".into(), json!(digits(slow)));
            isolation.insert("damping_ratio".into(), json!(random.scaled(0.02, 0.3)));
        }
        1 => {
            let post = random.scaled(0.05, 0.2);
            isolation.insert("kind".into(), json!("lead-rubber"));
            isolation.insert("stiffness".into(), json!(digits(slow / post)));
            isolation.insert("post_yield".into(), json!(post));
            let yields = 9.81 * whole * random.scaled(0.02, 0.12);
            isolation.insert("yield".into(), json!(digits(yields)));
        }
        rising => {
            isolation.insert("kind".into(), json!("friction-pendulum"));
            isolation.insert("radius".into(), json!(random.scaled(0.5, 3.0)));
            let fast = random.scaled(0.02, 0.12);
            let friction = if rising == 3 {
                json!({"slow": digits(fast * random.between(0.3, 0.8)), "fast": fast, "rate": random.scaled(15.0, 100.0)})
            } else {
                json!(fast)
            };
            isolation.insert("friction".into(), friction);
            isolation.insert(
                "slip_displacement".into(),
                json!(random.scaled(0.0005, 0.003)),
            );
        }
    }
    if isolation["kind"] != json!("linear") && random.chance(0.3) {
        isolation.insert("damping".into(), json!(digits(0.1 * (slow * whole).sqrt())));
    }
    if random.chance(0.35) {
        let stop = json!({"at": random.scaled(0.02, 0.15), "stiffness": digits(slow * random.scaled(2.0, 30.0))});
        let one = random.below(3);
        let stops = match one {
            0 => json!({"left": stop}),
            1 => json!({"right": stop}),
            _ => stop,
        };
        isolation.insert("stop".into(), stops);
    }
    tree.insert("damping".into(), damping(random, storeys(&tree)));
    tree.insert("isolation".into(), Value::Object(isolation));
    let mut buildings = vec![Value::Object(tree)];
    if random.chance(0.6) {
        let (mut other, _) = shear(random, "B2", height, 6);
        other.insert("damping".into(), damping(random, storeys(&other)));
        buildings.push(Value::Object(other));
    }
    let wall = buildings.len() == 1 && random.chance(0.4);
    let gaps = gaps(random, buildings.len(), wall);
    json!({"motion": motion(random, period, 15.0), "building": buildings, "gap": gaps})
}
