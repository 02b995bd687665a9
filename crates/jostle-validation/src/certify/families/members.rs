//! Low frames with parts that yield, buckle, crush or lift off: braces, infill panels, walls, feet of columns; alone,
//! before a wall or beside a shear building.

use serde_json::{Map, Value, json};

use super::{Random, damping, gaps, motion, rule, shear, storeys};
use crate::certify::random::digits;

pub(super) fn draw(random: &mut Random) -> Value {
    let height = digits(random.between(2.8, 3.8));
    let (first, period) = frame(random, height);
    let mut buildings = vec![first];
    let beside = random.chance(0.5);
    if beside {
        let (mut tree, _) = shear(random, "B2", height, 3);
        let damping = damping(random, storeys(&tree));
        tree.insert("damping".into(), damping);
        buildings.push(Value::Object(tree));
    }
    let wall = !beside && random.chance(0.5);
    let gaps = gaps(random, buildings.len(), wall);
    json!({"motion": motion(random, period, 8.0), "building": buildings, "gap": gaps})
}

/// Adds parts of a kind to a frame.
type Part = fn(&mut Random, &mut Map<String, Value>);

/// A frame with one kind of these parts, and about its first period \[s\].
fn frame(random: &mut Random, height: f64) -> (Value, f64) {
    let storeys = random.whole(1, 3);
    let spans = random.whole(1, 2);
    let spans: Vec<f64> = (0..spans)
        .map(|_| digits(random.between(4.0, 7.0)))
        .collect();
    let side = digits(random.between(0.35, 0.6));
    let mut tree = Map::new();
    let mut put = |key: &str, value: Value| tree.insert(key.into(), value);
    put("name", json!("B1"));
    put("kind", json!("frame"));
    put("storeys", json!(storeys));
    put("storey_height", json!(height));
    put("spans", json!(spans));
    put("column", json!({"width": side, "depth": side}));
    put(
        "beam",
        json!({"width": 0.3, "depth": digits(random.between(0.45, 0.7))}),
    );
    put("elastic_modulus", json!(3e10));
    put("floor_mass", json!(random.scaled(1.5e4, 9e4)));
    put("column_segments", json!(1));
    put("beam_segments", json!(1));
    put("p_delta", json!(random.chance(0.2)));
    // Masses alone are damped: what has none follows without delay.
    put(
        "damping",
        json!({"alpha": digits(random.between(0.1, 1.5)), "beta": 0}),
    );
    let parts: [Part; 4] = [braces, panels, walls, feet];
    parts[random.below(parts.len())](random, &mut tree);
    (Value::Object(tree), digits(0.12 * storeys as f64 + 0.1))
}

/// Braces that yield alike both ways, or buckle.
fn braces(random: &mut Random, tree: &mut Map<String, Value>) {
    let direction = ["up", "down", "both"][random.below(3)];
    let mut brace = json!({"bay": 1, "direction": direction});
    if random.chance(0.5) {
        brace["profile"] = json!(["HEB100", "HEB120", "HEB140"][random.below(3)]);
        brace["hinge"] = json!({"rule": "buckling", "curve": "c", "yield_strength": "275 MPa"});
    } else {
        brace["EA"] = json!(random.scaled(1e8, 6e8));
        brace["hinge"] = spring(random, 3e4, 4e5);
    }
    tree.insert("brace".into(), json!([brace]));
}

/// Panels that crack, crush and pinch, or stay elastic; of two rules, or with corners of their own.
fn panels(random: &mut Random, tree: &mut Map<String, Value>) {
    let mut panel = json!({"bay": 1});
    if random.chance(0.4) {
        panel["stiffness"] = json!(random.scaled(2e7, 2e8));
    } else {
        panel["modulus"] = json!(random.scaled(2e9, 6e9));
        panel["thickness"] = json!(digits(random.between(0.12, 0.3)));
        panel["width"] = json!(["mainstone", "paulay-priestley", "holmes"][random.below(3)]);
        panel["force"] = json!(random.scaled(5e4, 4e5));
        if random.chance(0.4) {
            panel["opening"] = json!(digits(random.between(0.05, 0.4)));
        }
    }
    tree.insert("infill".into(), json!([panel]));
}

/// A wall at the first line that yields at its foot, or at every storey.
fn walls(random: &mut Random, tree: &mut Map<String, Value>) {
    let mut hinge = spring(random, 4e5, 4e6);
    hinge["initial"] = json!(random.scaled(20.0, 100.0));
    if random.chance(0.3) {
        hinge["ends"] = json!("all");
    }
    let wall = json!({
        "line": 1, "length": digits(random.between(1.5, 3.0)), "thickness": 0.2,
        "stiffness_factor": digits(random.between(0.3, 1.0)), "hinge": hinge,
    });
    tree.insert("wall".into(), json!([wall]));
}

/// Feet of columns that lift off.
fn feet(random: &mut Random, tree: &mut Map<String, Value>) {
    tree.insert("axial".into(), json!("flexible"));
    tree.insert("gravity".into(), json!(true));
    tree.insert(
        "base".into(),
        json!({"vertical_stiffness": random.scaled(8e7, 1e9), "uplift": true}),
    );
}

/// A rule with its corners, yield between these.
fn spring(random: &mut Random, least: f64, most: f64) -> Value {
    let mut tree = rule(random);
    let yields = random.scaled(least, most);
    if tree["rule"] != json!("bilinear") {
        let share = random.between(0.3, 0.7);
        tree.insert("cracking".into(), json!(digits(share * yields)));
    }
    tree.insert("yield".into(), json!(yields));
    Value::Object(tree)
}
