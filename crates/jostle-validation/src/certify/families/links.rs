//! Two shear buildings with links of every law between them and inside.

use serde_json::{Map, Value, json};

use super::{Random, damping, gaps, motion, rule, shear, storeys};
use crate::certify::random::digits;

const LAWS: [&str; 6] = [
    "viscous", "maxwell", "friction", "yielding", "cable", "stopper",
];

pub(super) fn draw(random: &mut Random) -> Value {
    let height = digits(random.between(2.8, 4.0));
    let count = if random.chance(0.25) { 1 } else { 2 };
    let (mut buildings, mut periods, mut least) = (Vec::new(), Vec::new(), usize::MAX);
    let mut inside = Vec::new();
    for k in 1..=count {
        let name = format!("B{k}");
        let (mut tree, period) = shear(random, &name, height, 6);
        let n = storeys(&tree);
        least = least.min(n);
        periods.push(period);
        let weight = tree["mass"].as_array().map_or(0.0, |all| {
            9.81 * all.iter().filter_map(Value::as_f64).sum::<f64>()
        });
        let stiffness = tree["stiffness"][0].as_f64().unwrap_or(1e8);
        tree.insert("damping".into(), damping(random, n));
        if count == 1 || random.chance(0.4) {
            let mut link = link(random, weight / n as f64, stiffness);
            let pairs: Vec<[usize; 2]> = (1..=n)
                .filter(|_| random.chance(0.6))
                .map(|floor| [floor - 1, floor])
                .collect();
            let pairs = if pairs.is_empty() {
                vec![[0, 1]]
            } else {
                pairs
            };
            link.insert("between".into(), json!([name, name]));
            link.insert("floors".into(), json!(pairs));
            inside.push(Value::Object(link));
        }
        buildings.push(Value::Object(tree));
    }
    let mut links = inside;
    if count == 2 && (links.is_empty() || random.chance(0.7)) {
        let mass = buildings[0]["mass"][0].as_f64().unwrap_or(1e5);
        let stiffness = buildings[0]["stiffness"][0].as_f64().unwrap_or(1e8);
        let mut link = link(random, 9.81 * mass, stiffness);
        link.insert("between".into(), json!(["B1", "B2"]));
        if random.chance(0.4) {
            link.insert("floors".into(), json!([[least, least]]));
        }
        links.push(Value::Object(link));
    }
    let pounds = count == 2 && random.chance(0.5);
    let gaps = if pounds {
        gaps(random, count, false)
    } else {
        Vec::new()
    };
    json!({"motion": motion(random, periods[0], 15.0), "building": buildings, "gap": gaps, "link": links})
}

/// A link beside a storey of this weight and stiffness.
fn link(random: &mut Random, weight: f64, stiffness: f64) -> Map<String, Value> {
    let law = LAWS[random.below(LAWS.len())];
    let mut tree = Map::new();
    tree.insert("law".into(), json!(law));
    let link_stiffness = digits(stiffness * random.scaled(0.02, 1.0));
    // At 0.2 m/s a tenth of the weight.
    let dashpot = |random: &mut Random, exponent: f64| {
        digits(weight * random.scaled(0.02, 0.3) / 0.2_f64.powf(exponent))
    };
    match law {
        "viscous" => {
            let exponent = digits(random.between(0.3, 1.8));
            tree.insert("exponent".into(), json!(exponent));
            tree.insert("damping".into(), json!(dashpot(random, exponent)));
            if random.chance(0.5) {
                let spring = digits(stiffness * random.scaled(0.2, 3.0));
                tree.insert("stiffness".into(), json!(spring));
            }
        }
        "maxwell" => {
            tree.insert("damping".into(), json!(dashpot(random, 1.0)));
            tree.insert("stiffness".into(), json!(link_stiffness));
        }
        "friction" => {
            let slips = digits(weight * random.scaled(0.01, 0.2));
            tree.insert("slip_force".into(), json!(slips));
            let sticks = digits(stiffness * random.scaled(0.2, 3.0));
            tree.insert("stick_stiffness".into(), json!(sticks));
        }
        "yielding" => {
            let mut hinge = rule(random);
            let yields = weight * random.scaled(0.02, 0.3);
            if hinge["rule"] != json!("bilinear") {
                let share = random.between(0.2, 0.6);
                hinge.insert("cracking".into(), json!(digits(share * yields)));
            }
            hinge.insert("yield".into(), json!(digits(yields)));
            tree.insert("hinge".into(), Value::Object(hinge));
            tree.insert("stiffness".into(), json!(link_stiffness));
        }
        "cable" => {
            tree.insert("stiffness".into(), json!(link_stiffness));
            tree.insert("slack".into(), json!(random.scaled(0.0005, 0.02)));
        }
        _ => {
            tree.insert("stiffness".into(), json!(link_stiffness));
            tree.insert("gap".into(), json!(random.scaled(0.0005, 0.02)));
            if random.chance(0.6) {
                tree.insert("damping".into(), json!(dashpot(random, 1.0)));
            }
        }
    }
    tree
}
