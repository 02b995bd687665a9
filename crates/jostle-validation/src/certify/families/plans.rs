//! Buildings with a plan: eccentric, elastic or with elements or storeys that yield, whose faces or corners touch.

use serde_json::{Map, Value, json};

use super::{Random, damping, hinges, law, motion, shear, storeys};
use crate::certify::models::gap;
use crate::certify::random::digits;

pub(super) fn draw(random: &mut Random) -> Value {
    let height = digits(random.between(2.8, 4.0));
    let count = if random.chance(0.3) { 1 } else { 2 };
    let yields = random.chance(0.5);
    let (mut buildings, mut first) = (Vec::new(), None);
    // The side of the first that the second meets: its place and its length.
    let mut side = [0.0; 2];
    for k in 1..=count {
        let (mut tree, period) = shear(random, &format!("B{k}"), height, 4);
        first.get_or_insert(period);
        let [width, depth] = [0, 1].map(|_| digits(random.between(8.0, 20.0)));
        // The narrow sides meet somewhere; a turned plan touches with a corner.
        let turned = k == 2 && random.chance(0.35);
        let room = digits(random.scaled(0.001, 0.04));
        let mut plan = [[0.0, 0.0], [width, 0.0], [width, depth], [0.0, depth]];
        if turned {
            let angle = random.between(-0.6, 0.6);
            let (sin, cos) = f64::sin_cos(angle);
            plan = plan.map(|[x, y]| [digits(cos * x - sin * y), digits(sin * x + cos * y)]);
        }
        let at = if k == 1 {
            side = [width, depth];
            [0.0, 0.0]
        } else {
            let mut first = plan[0];
            for corner in plan {
                if corner[0] < first[0] {
                    first = corner;
                }
            }
            let across = if turned {
                // The corner meets the side somewhere.
                side[1] * random.between(0.1, 0.9) - first[1]
            } else {
                random.between(-3.0, 3.0)
            };
            [side[0] + room - first[0], digits(across)]
        };
        tree.insert("plan".into(), json!(plan));
        tree.insert("at".into(), json!(at));
        let along = tree["stiffness"].as_array().cloned().unwrap_or_default();
        let along: Vec<f64> = along.iter().filter_map(Value::as_f64).collect();
        let damped = damping(random, storeys(&tree));
        tree.insert("damping".into(), damped);
        if random.chance(0.5) {
            let each = along.iter().map(|k| {
                let y = digits(k * random.between(0.7, 1.4));
                json!({"x": k, "y": y})
            });
            let each: Vec<Value> = each.collect();
            tree.insert("stiffness".into(), json!(each));
            let [x, y] = [width, depth].map(|side| digits(side * random.between(-0.15, 0.15)));
            tree.insert("eccentricity".into(), json!([x, y]));
            if yields && random.chance(0.8) {
                tree.insert("hinges".into(), hinges(random, height));
            }
        } else {
            tree.remove("stiffness");
            let places = [[0.1, 0.1], [0.9, 0.15], [0.85, 0.9], [0.1, 0.85]];
            let mut elements = Vec::new();
            let corner = plan[0];
            let axes = [
                [plan[1][0] - corner[0], plan[1][1] - corner[1]],
                [plan[3][0] - corner[0], plan[3][1] - corner[1]],
            ];
            let shares: Vec<[f64; 2]> = places
                .iter()
                .map(|_| [random.scaled(0.1, 0.5), random.scaled(0.1, 0.5)])
                .collect();
            let rule = hinges(random, height);
            for (place, share) in places.iter().zip(&shares) {
                let at = [0, 1].map(|axis: usize| {
                    digits(corner[axis] + place[0] * axes[0][axis] + place[1] * axes[1][axis])
                });
                let [x, y] = share.map(|share| digits(along[0] * share));
                let mut element = Map::new();
                element.insert("at".into(), json!(at));
                element.insert("stiffness".into(), json!({"x": x, "y": y}));
                if yields && random.chance(0.6) {
                    element.insert("hinges".into(), rule.clone());
                }
                elements.push(Value::Object(element));
            }
            tree.insert("element".into(), json!(elements));
        }
        buildings.push(Value::Object(tree));
    }
    let mut gaps = Vec::new();
    if count == 2 {
        let law = law(random);
        let mut gap = gap(random, ["B1", "B2"], law);
        if let Some(keys) = gap.as_object_mut() {
            keys.remove("width");
        }
        gaps.push(gap);
    }
    let mut motion = motion(random, first.unwrap_or(1.0), 10.0);
    motion["angle"] = json!(format!("{} deg", random.whole(10, 80)));
    if random.chance(0.4) {
        motion["across"] = json!({
            "kind": "sine", "amplitude": random.scaled(0.3, 2.0),
            "period": digits(first.unwrap_or(1.0) * random.between(0.7, 1.3)), "duration": motion["duration"],
        });
    }
    json!({"motion": motion, "building": buildings, "gap": gaps})
}
