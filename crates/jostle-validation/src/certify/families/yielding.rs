//! Shear buildings whose storeys yield, alone, before a wall or in a row.

use serde_json::{Value, json};

use super::{Random, damping, gaps, hinges, motion, shear, storeys};
use crate::certify::random::digits;

pub(super) fn draw(random: &mut Random) -> Value {
    let height = digits(random.between(2.8, 4.0));
    let count = [1, 2, 2, 2, 3][random.below(5)];
    let (mut buildings, mut first) = (Vec::new(), None);
    for k in 1..=count {
        let (mut tree, period) = shear(random, &format!("B{k}"), height, 8);
        first.get_or_insert(period);
        let mut damping = damping(random, storeys(&tree));
        // One of a row may stay elastic.
        if k == 1 || random.chance(0.75) {
            tree.insert("hinges".into(), hinges(random, height));
            if random.chance(0.3) {
                damping["yielding"] = json!(["none", "tangent"][random.below(2)]);
            }
        }
        if random.chance(0.2) {
            tree.insert("p_delta".into(), json!(true));
        }
        tree.insert("damping".into(), damping);
        buildings.push(Value::Object(tree));
    }
    let wall = count == 1 && random.chance(0.4);
    let gaps = gaps(random, count, wall);
    json!({"motion": motion(random, first.unwrap_or(1.0), 15.0), "building": buildings, "gap": gaps})
}
