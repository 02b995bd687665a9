//! Random models of rarer kinds: rubber, pulses, springs below feet, and columns struck between floors.

use serde_json::{Map, Value, json};

use super::models::{Drawn, LAWS, building, gap, motion, usual};
use super::pulse::{Pulse, STEP};
use super::random::{Random, digits};

/// Separates the random numbers of these kinds from those of all others, so that the others stay what they are.
const STREAM: u64 = 0x6a09_e667_f3bc_c908;
/// Share of the models that is of each kind.
const SHARE: f64 = 0.04;

/// Model `number` of a seed, if it is of such a kind.
pub(super) fn more(seed: u64, number: u64) -> Option<Drawn> {
    let mut random = Random::new(seed ^ STREAM, number);
    let roll = random.between(0.0, 1.0);
    let draw = [rubber, pulse, springs, columns].into_iter();
    let (kind, _) = draw.zip(1..).find(|(_, k)| roll < SHARE * f64::from(*k))?;
    let mut drawn = kind(&mut random, seed, number);
    drawn.tree["title"] = json!(format!("model {number} of seed {seed}"));
    Some(drawn)
}

/// Buildings in a row, or before a wall, with rubber in a gap.
fn rubber(random: &mut Random, _seed: u64, _number: u64) -> Drawn {
    let height = digits(random.between(2.8, 4.0));
    let count = random.whole(1, 3);
    let plain = random.chance(0.7);
    let (buildings, period) = row(random, count, height, plain);
    let others: Vec<&str> = (0..count).map(|_| LAWS[random.below(LAWS.len())]).collect();
    let soft = random.below(count.max(2) - 1);
    let gaps = (1..count.max(2)).map(|k| {
        let right = format!("B{}", k + 1);
        let right = if count == 1 { "wall" } else { &right };
        let between = [&format!("B{k}"), right];
        if k - 1 != soft {
            return gap(random, between, others[k]);
        }
        let mut gap = gap(random, between, "rubber");
        gap["stiffness"] = json!(random.scaled(2e6, 2e8));
        gap["thickness"] = json!(random.scaled(0.01, 0.1));
        gap["exponent"] = json!(digits(random.between(1.5, 4.0)));
        if let Some(keys) = gap.as_object_mut() {
            keys.remove("restitution_is");
        }
        gap
    });
    let gaps: Vec<Value> = gaps.collect();
    let motion = motion(random, period, 20.0);
    whole("rubber", motion, buildings, gaps)
}

/// A usual model under a velocity pulse.
fn pulse(random: &mut Random, seed: u64, number: u64) -> Drawn {
    let mut drawn = usual(seed, number);
    drawn.kind = "pulse";
    let period = random.scaled(0.4, 3.0);
    let duration = digits(random.between(1.5, 4.0) * period + 3.0);
    if random.chance(0.3) {
        drawn.tree["motion"] = json!({
            "kind": "ricker", "amplitude": random.scaled(0.5, 6.0), "period": period, "duration": duration,
        });
        return drawn;
    }
    drawn.pulse = Some(Pulse {
        velocity: random.scaled(0.05, 1.0),
        period,
        oscillations: digits(random.between(1.1, 3.0)),
        phase: digits(random.between(0.0, 6.2)),
    });
    drawn.tree["motion"] = json!({
        "record": format!("seed{seed}_model{number}_pulse.txt"), "step": STEP, "unit": "m/s2", "duration": duration,
    });
    drawn
}

/// Frames whose feet rise and turn on springs.
fn springs(random: &mut Random, _seed: u64, _number: u64) -> Drawn {
    let height = digits(random.between(2.8, 4.0));
    let count = random.whole(1, 2);
    let (mut buildings, mut period) = (Vec::new(), 1.0);
    for k in 1..=count {
        let (mut tree, building_period) =
            building(random, &format!("B{k}"), height, 6, false, true);
        let mut base = Map::new();
        base.insert("vertical_stiffness".into(), json!(random.scaled(1e8, 3e9)));
        base.insert(
            "rotational_stiffness".into(),
            json!(random.scaled(5e7, 2e9)),
        );
        if random.chance(0.6) {
            base.insert("vertical_damping".into(), json!(random.scaled(3e5, 2e7)));
            base.insert("rotational_damping".into(), json!(random.scaled(1e5, 2e7)));
        }
        if random.chance(0.5) {
            base.insert(
                "horizontal_stiffness".into(),
                json!(random.scaled(1e8, 2e9)),
            );
            base.insert("horizontal_damping".into(), json!(random.scaled(1e5, 5e6)));
            base.insert("mass".into(), json!(random.scaled(2000.0, 20_000.0)));
        }
        tree["base"] = Value::Object(base);
        if tree.pointer("/damping/modes") == Some(&json!("all")) {
            tree["damping"]["modes"] = json!([1]);
        }
        buildings.push(tree);
        period = building_period;
    }
    let law = LAWS[random.below(LAWS.len())];
    let right = if count == 1 { "wall" } else { "B2" };
    let gaps = vec![gap(random, ["B1", right], law)];
    let motion = motion(random, period, 15.0);
    whole("springs", motion, buildings, gaps)
}

/// Two low frames whose floors strike columns of the other.
fn columns(random: &mut Random, _seed: u64, _number: u64) -> Drawn {
    let (mut buildings, mut period) = (Vec::new(), 1.0);
    for k in 1..=2 {
        let height = digits(random.between(2.8, 3.3) + 0.6 * f64::from(k - 1));
        let (tree, building_period) = building(random, &format!("B{k}"), height, 4, false, true);
        buildings.push(tree);
        period = building_period;
    }
    let law = LAWS[random.below(LAWS.len())];
    let mut gap = gap(random, ["B1", "B2"], law);
    gap["floors"] = json!("all");
    let motion = motion(random, period, 10.0);
    whole("columns", motion, buildings, vec![gap])
}

/// Buildings in a row and about the first period of the first \[s\].
fn row(random: &mut Random, count: usize, height: f64, plain: bool) -> (Vec<Value>, f64) {
    let mut first = None;
    let mut trees = Vec::new();
    for k in 1..=count {
        let shear = random.chance(0.65);
        let (mut tree, period) = building(random, &format!("B{k}"), height, 10, shear, plain);
        // Damping in all modes asks for modal stepping of all buildings.
        if !plain && tree.pointer("/damping/modes") == Some(&json!("all")) {
            tree["damping"]["modes"] = json!([1]);
        }
        first.get_or_insert(period);
        trees.push(tree);
    }
    (trees, first.unwrap_or(1.0))
}

fn whole(kind: &'static str, motion: Value, buildings: Vec<Value>, gaps: Vec<Value>) -> Drawn {
    Drawn {
        tree: json!({"motion": motion, "building": buildings, "gap": gaps}),
        kind,
        pulse: None,
    }
}
