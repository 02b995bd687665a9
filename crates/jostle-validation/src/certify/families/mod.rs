//! Random models of the families whose reference is [`super::explicit`].

mod isolation;
mod links;
mod members;
mod plans;
mod soil;
mod yielding;

use std::f64::consts::PI;

use serde_json::{Map, Value, json};

use super::models::{Drawn, LAWS, gap, motion};
use super::random::{Random, digits};

/// A family, and how its models are drawn.
#[derive(Clone, Copy, Debug)]
pub struct Family {
    /// Its name.
    pub name: &'static str,
    draw: fn(&mut Random) -> Value,
}

/// All families.
pub const FAMILIES: [Family; 6] = [
    Family {
        name: "yielding",
        draw: yielding::draw,
    },
    Family {
        name: "plans",
        draw: plans::draw,
    },
    Family {
        name: "isolation",
        draw: isolation::draw,
    },
    Family {
        name: "links",
        draw: links::draw,
    },
    Family {
        name: "soil",
        draw: soil::draw,
    },
    Family {
        name: "members",
        draw: members::draw,
    },
];

impl Family {
    /// The family of a name.
    #[must_use]
    pub fn named(name: &str) -> Option<Self> {
        FAMILIES.into_iter().find(|family| family.name == name)
    }

    /// Its model of a number of a seed.
    #[must_use]
    pub fn model(&self, seed: u64, number: u64) -> Drawn {
        let fold = self.name.bytes().fold(0_u64, |sum, byte| {
            sum.wrapping_mul(0x0100_0000_01b3)
                .wrapping_add(u64::from(byte))
        });
        let mut random = Random::new(seed ^ fold, number);
        let mut tree = (self.draw)(&mut random);
        tree["title"] = json!(format!("{} {number} of seed {seed}", self.name));
        // Runs go on where storeys drift by more than a tenth.
        tree["analysis"] = json!({"collapse_drift": 0.25});
        Drawn {
            tree,
            kind: self.name,
            pulse: None,
        }
    }
}

/// Laws of contacts but the momentum law.
fn law(random: &mut Random) -> &'static str {
    LAWS[random.below(LAWS.len() - 1)]
}

/// A shear building without damping, and about its first period \[s\].
fn shear(random: &mut Random, name: &str, height: f64, most: usize) -> (Map<String, Value>, f64) {
    let storeys = random.whole(1, most);
    let period = digits((0.1 * storeys as f64 * random.scaled(0.6, 2.0)).clamp(0.1, 2.0));
    let mass = random.scaled(2e4, 3e5);
    let slowest = 2.0 * (PI / (4 * storeys + 2) as f64).sin();
    let stiffness = mass * (2.0 * PI / period / slowest).powi(2);
    let taper = random.between(0.0, 0.5);
    let mut list = |value: f64, taper: f64| -> Vec<f64> {
        let all = (0..storeys).map(|k| {
            let share = 1.0 - taper * k as f64 / storeys as f64;
            digits(value * share * random.between(0.85, 1.15))
        });
        all.collect()
    };
    let (masses, springs) = (list(mass, 0.0), list(stiffness, taper));
    let mut tree = Map::new();
    tree.insert("name".into(), json!(name));
    tree.insert("kind".into(), json!("shear"));
    tree.insert("storey_height".into(), json!(height));
    // Else what yields has P-Delta.
    tree.insert("p_delta".into(), json!(false));
    tree.insert("mass".into(), json!(masses));
    tree.insert("stiffness".into(), json!(springs));
    (tree, period)
}

/// Rayleigh damping.
fn damping(random: &mut Random, storeys: usize) -> Value {
    let ratio = random.scaled(0.005, 0.1);
    match random.below(3) {
        0 => json!({"ratio": ratio, "modes": [1]}),
        // Higher modes may move too little mass to be counted as lateral.
        1 if storeys >= 5 => json!({"ratio": ratio, "modes": [1, 3]}),
        _ => json!({"ratio": ratio}),
    }
}

fn storeys(tree: &Map<String, Value>) -> usize {
    tree["mass"].as_array().map_or(1, Vec::len)
}

/// Gaps of a row of buildings, and of the last to a wall.
fn gaps(random: &mut Random, count: usize, wall: bool) -> Vec<Value> {
    let mut all = Vec::new();
    for k in 1..count + usize::from(wall) {
        let (left, right) = (format!("B{k}"), format!("B{}", k + 1));
        let right = if k == count { "wall" } else { &right };
        let law = law(random);
        all.push(gap(random, [&left, right], law));
    }
    all
}

/// A rule of hysteresis with its parameters: keys of `hinges` or of `hinge` but corners.
fn rule(random: &mut Random) -> Map<String, Value> {
    const RULES: [&str; 6] = [
        "normal",
        "peak-oriented",
        "takeda",
        "d-tri",
        "pinched",
        "bilinear",
    ];
    let name = RULES[random.below(RULES.len())];
    let mut tree = Map::new();
    tree.insert("rule".into(), json!(name));
    match name {
        "takeda" if random.chance(0.5) => {
            tree.insert("gamma".into(), json!(digits(random.between(0.1, 0.6))));
        }
        "pinched" => {
            tree.insert(
                "pinching".into(),
                json!({"deformation": digits(random.between(0.2, 0.9)), "force": digits(random.between(0.1, 0.8))}),
            );
            if random.chance(0.4) {
                tree.insert(
                    "unloading_exponent".into(),
                    json!(digits(random.between(0.1, 0.6))),
                );
            }
            if random.chance(0.4) {
                tree.insert(
                    "damage".into(),
                    json!({"ductility": digits(random.between(0.005, 0.03)), "energy": digits(random.between(0.005, 0.03))}),
                );
            }
        }
        _ => {}
    }
    if name != "bilinear" {
        tree.insert(
            "post_cracking".into(),
            json!(digits(random.between(0.2, 0.7))),
        );
    }
    let hardens = random.chance(0.85);
    let post_yield = if hardens {
        random.scaled(0.005, 0.15)
    } else {
        0.0
    };
    tree.insert("post_yield".into(), json!(post_yield));
    tree
}

/// Storey hinges: yield at a share of the height.
fn hinges(random: &mut Random, height: f64) -> Value {
    let mut tree = rule(random);
    let yields = height * random.scaled(0.0006, 0.006);
    if tree["rule"] != json!("bilinear") {
        let share = random.between(0.15, 0.5);
        tree.insert("cracking".into(), json!(digits(share * yields)));
    }
    tree.insert("yield".into(), json!(digits(yields)));
    Value::Object(tree)
}
