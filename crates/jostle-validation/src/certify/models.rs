//! Random models of every kind that does not yield.

use std::f64::consts::PI;

use serde_json::{Map, Value, json};

use super::more_models::more;
use super::pulse::Pulse;
use super::random::{Random, digits};

/// A model as the tree of a model file, and what it is like.
#[derive(Clone, Debug)]
pub struct Drawn {
    /// The model file.
    pub tree: Value,
    /// Kind of the model.
    pub kind: &'static str,
    /// The pulse of which its record has the values.
    pub pulse: Option<Pulse>,
}

pub(crate) const LAWS: [&str; 11] = [
    "linear",
    "kelvin",
    "kelvin-no-tension",
    "modified-kelvin",
    "modified-kelvin mahmoud-jankowski",
    "hertz",
    "hertz-damp",
    "ye",
    "jankowski",
    "bilinear",
    "restitution",
];

pub(crate) fn gap(random: &mut Random, between: [&str; 2], law: &str) -> Value {
    let mut words = law.split(' ');
    let law = words.next().unwrap_or("linear");
    let mut gap = Map::new();
    gap.insert("between".into(), json!(between));
    let width = if random.chance(0.1) {
        0.0
    } else if random.chance(0.2) {
        random.scaled(0.05, 0.3)
    } else {
        random.scaled(0.0005, 0.05)
    };
    gap.insert("width".into(), json!(width));
    gap.insert("law".into(), json!(law));
    let hertzian = ["hertz", "hertz-damp", "ye", "jankowski", "bilinear"].contains(&law);
    let stiffness = if hertzian {
        random.scaled(6e8, 8e9)
    } else {
        random.scaled(3e7, 1e9)
    };
    gap.insert("stiffness".into(), json!(stiffness));
    if !["linear", "hertz"].contains(&law) {
        gap.insert(
            "restitution".into(),
            json!(digits(random.between(0.3, 0.95))),
        );
        if law != "restitution" && random.chance(0.5) {
            gap.insert("restitution_is".into(), json!("realised"));
        }
    }
    if let Some(variant) = words.next() {
        gap.insert("variant".into(), json!(variant));
    }
    Value::Object(gap)
}

/// Whether every mode may have the same damping.
#[derive(Clone, Copy, PartialEq)]
enum Modal {
    Yes,
    No,
}

fn damping(random: &mut Random, storeys: usize, period: f64, modal: Modal) -> Value {
    let ratio = random.scaled(0.005, 0.2);
    // Higher modes may move too little mass to be counted as lateral.
    let high = if storeys >= 5 { 3 } else { storeys.min(2) };
    match random.below(8) {
        0 | 1 => json!({"ratio": ratio, "modes": [1]}),
        2..=4 if high > 1 => json!({"ratio": ratio, "modes": [1, high]}),
        2..=4 => json!({"ratio": ratio}),
        5 if modal == Modal::Yes => json!({"ratio": ratio, "modes": "all"}),
        5 | 6 => json!({"ratio": ratio}),
        _ => {
            let omega = 2.0 * PI / period;
            let alpha = random.between(0.0, 1.0) * 2.0 * ratio * omega;
            let beta = if random.chance(0.5) {
                random.between(0.0, 0.3) * 2.0 * ratio / omega
            } else {
                0.0
            };
            json!({"alpha": digits(alpha), "beta": digits(beta)})
        }
    }
}

/// A building: its tree and about its first period \[s\].
pub(super) fn building(
    random: &mut Random,
    name: &str,
    height: f64,
    most: usize,
    shear: bool,
    plain: bool,
) -> (Value, f64) {
    let mut tree = Map::new();
    tree.insert("name".into(), json!(name));
    let mut storeys = random.whole(1, most);
    let modal = if plain { Modal::Yes } else { Modal::No };
    let p_delta = !plain && random.chance(0.35);
    let sprung = !plain && random.chance(0.5);
    tree.insert("storey_height".into(), json!(height));
    let period;
    if shear {
        period = digits((0.1 * storeys as f64 * random.scaled(0.5, 2.0)).clamp(0.08, 3.0));
        let mass = random.scaled(1e4, 3e5);
        let slowest = 2.0 * (PI / (4 * storeys + 2) as f64).sin();
        let stiffness = mass * (2.0 * PI / period / slowest).powi(2);
        let rough = random.chance(0.5);
        let taper = random.between(0.0, 0.6);
        let mut list = |value: f64, taper: f64| -> Vec<f64> {
            (0..storeys)
                .map(|k| {
                    let share = 1.0 - taper * k as f64 / storeys as f64;
                    let noise = if rough { random.between(0.8, 1.2) } else { 1.0 };
                    digits(value * share * noise)
                })
                .collect()
        };
        let (masses, springs) = (list(mass, 0.0), list(stiffness, taper));
        tree.insert("kind".into(), json!("shear"));
        tree.insert("mass".into(), json!(masses));
        tree.insert("stiffness".into(), json!(springs));
        if sprung {
            let spring = digits(stiffness * random.scaled(0.5, 10.0));
            let footing = digits(mass * random.between(0.2, 1.0));
            let dashpot =
                digits(2.0 * random.scaled(0.02, 0.3) * (spring * mass * storeys as f64).sqrt());
            tree.insert(
                "base".into(),
                json!({"horizontal_stiffness": spring, "horizontal_damping": dashpot, "mass": footing}),
            );
        }
    } else {
        storeys = storeys.min(10);
        let bays = random.whole(1, 3);
        let (mut columns, mut beams) = (random.whole(1, 4), random.whole(1, 4));
        while storeys * ((bays + 1) * columns + bays * beams) > 110 {
            (columns, beams) = (columns.max(2) - 1, beams.max(2) - 1);
            if columns + beams == 2 {
                break;
            }
        }
        let spans: Vec<f64> = (0..bays)
            .map(|_| digits(random.between(3.5, 7.5)))
            .collect();
        let depth = digits(random.between(0.35, 0.75));
        let beam = digits(random.between(0.4, 0.7));
        tree.insert("kind".into(), json!("frame"));
        tree.insert("storeys".into(), json!(storeys));
        tree.insert("spans".into(), json!(spans));
        tree.insert("column".into(), json!({"width": depth, "depth": depth}));
        tree.insert("beam".into(), json!({"width": 0.3, "depth": beam}));
        tree.insert("elastic_modulus".into(), json!(3e10));
        tree.insert("beam_mass".into(), json!(random.scaled(1000.0, 5000.0)));
        tree.insert("column_segments".into(), json!(columns));
        tree.insert("beam_segments".into(), json!(beams));
        // Stated, because the default depends on the height, and both should occur at any.
        let axial = if random.chance(0.15) {
            "flexible"
        } else {
            "rigid"
        };
        tree.insert("axial".into(), json!(axial));
        if random.chance(0.15) {
            tree.insert(
                "joint".into(),
                json!({"rotational_stiffness": random.scaled(2e7, 2e9)}),
            );
        }
        if sprung {
            let mut base = Map::new();
            base.insert(
                "rotational_stiffness".into(),
                json!(random.scaled(5e7, 2e9)),
            );
            if random.chance(0.5) {
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
            // A massless foot with a dashpot follows a law of its own only beside damped members.
            tree.insert("base".into(), Value::Object(base));
        }
        period = 0.12 * storeys as f64;
    }
    if p_delta {
        tree.insert("p_delta".into(), json!(true));
    }
    if !plain && random.chance(0.2) {
        tree.insert("gravity".into(), json!(true));
    }
    tree.insert("damping".into(), damping(random, storeys, period, modal));
    (Value::Object(tree), period)
}

pub(super) fn motion(random: &mut Random, period: f64, longest: f64) -> Value {
    let duration = digits(random.between(4.0, longest));
    let reverse = random.chance(0.3);
    match random.below(4) {
        0 | 1 => json!({
            "record": "el-centro-1940-ns", "pga": digits(9.81 * random.scaled(0.08, 0.8)),
            "duration": duration, "reverse": reverse,
        }),
        2 => json!({
            "record": "nanjing-artificial", "pga": digits(9.81 * random.scaled(0.08, 0.6)),
            "duration": duration, "reverse": reverse,
        }),
        _ => json!({
            "kind": "sine", "amplitude": random.scaled(0.3, 3.0),
            "period": digits(period * random.between(0.9, 1.1)), "duration": duration.min(12.0),
        }),
    }
}

/// Model `number` of a seed.
#[must_use]
pub fn draw(seed: u64, number: u64) -> Drawn {
    more(seed, number).unwrap_or_else(|| usual(seed, number))
}

/// A model of the kinds that most are of.
pub(super) fn usual(seed: u64, number: u64) -> Drawn {
    let mut random = Random::new(seed, number);
    let height = digits(random.between(2.8, 4.0));
    let roll = random.between(0.0, 1.0);
    let (kind, count) = if roll < 0.17 {
        ("alone", 1)
    } else if roll < 0.24 {
        ("wall", 1)
    } else if roll < 0.32 {
        ("links", 2)
    } else if roll < 0.93 {
        ("few", random.whole(2, 3))
    } else {
        let most = if random.chance(0.3) { 60 } else { 20 };
        ("row", random.whole(8, most))
    };
    let row = kind == "row";
    let plain = row || !random.chance(0.2);
    let mut buildings = Vec::new();
    let mut periods = Vec::new();
    for k in 0..count {
        let shear = row || random.chance(0.65);
        let most = if row { 3 } else { 15 };
        // Damping in all modes is no part of models with links.
        let unjoined = plain && kind != "links";
        let (tree, period) = building(
            &mut random,
            &format!("B{}", k + 1),
            height,
            most,
            shear,
            unjoined,
        );
        buildings.push(tree);
        periods.push(period);
    }
    // Damping in all modes asks for modal stepping of all buildings.
    if !plain {
        for tree in &mut buildings {
            if tree.pointer("/damping/modes") == Some(&json!("all")) {
                tree["damping"]["modes"] = json!([1]);
            }
        }
    }
    let law = LAWS[random.below(LAWS.len())];
    let mut gaps = Vec::new();
    for k in 1..count {
        // Rows have one law; others may have several.
        let gap_law = if row || random.chance(0.6) {
            law
        } else {
            LAWS[random.below(LAWS.len())]
        };
        gaps.push(gap(
            &mut random,
            [&format!("B{k}"), &format!("B{}", k + 1)],
            gap_law,
        ));
    }
    if kind == "wall" {
        gaps.push(gap(&mut random, ["B1", "wall"], law));
    }
    let mut tree = json!({
        "title": format!("model {number} of seed {seed}"),
        "motion": motion(&mut random, periods[0], if row { 8.0 } else { 25.0 }),
        "building": buildings,
        "gap": gaps,
    });
    if kind == "links" {
        tree["link"] = json!([{
            "between": ["B1", "B2"],
            "stiffness": if random.chance(0.7) { random.scaled(1e6, 1e8) } else { 0.0 },
            "damping": random.scaled(1e4, 2e6),
        }]);
    }
    Drawn {
        tree,
        kind,
        pulse: None,
    }
}
