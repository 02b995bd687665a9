//! Parts of drawn models.

use serde_json::{Value, json};

use crate::certify::{LAWS, Random, digits, gap};

/// Height of a storey \[m\].
pub(super) const STOREY: f64 = 3.2;
/// Every rule of springs that yield.
pub(super) const RULES: [&str; 7] = [
    "normal",
    "peak-oriented",
    "takeda",
    "d-tri",
    "pinched",
    "bilinear",
    "elastic",
];
/// Contact laws of faces and corners in plan.
const LAWS_IN_PLAN: [&str; 8] = [
    "linear",
    "kelvin",
    "kelvin-no-tension",
    "modified-kelvin",
    "hertz",
    "hertz-damp",
    "ye",
    "jankowski",
];

/// Random numbers of a model of a family.
pub(super) fn random(family: u64, number: usize) -> Random {
    Random::new(0x7069_6e73 + family, number as u64)
}

/// A strong motion of this length \[s\].
pub(super) fn shaking(random: &mut Random, duration: f64) -> Value {
    match random.below(3) {
        0 => json!({
            "record": "el-centro-1940-ns", "pga": digits(random.between(4.0, 8.0)), "duration": duration,
            "reverse": random.chance(0.5),
        }),
        1 => json!({
            "kind": "sine", "amplitude": digits(random.between(2.0, 5.0)),
            "period": digits(random.between(0.3, 0.9)), "duration": duration,
        }),
        _ => json!({
            "kind": "ricker", "amplitude": digits(random.between(4.0, 9.0)),
            "period": digits(random.between(0.4, 0.9)), "centre": 0.9, "duration": duration,
        }),
    }
}

/// The same in both directions of a plan.
pub(super) fn shaking_in_plan(random: &mut Random, duration: f64) -> Value {
    let mut motion = shaking(random, duration);
    motion["angle"] = json!(digits(random.between(0.1, 1.3)));
    motion["across"] = json!({
        "kind": "sine", "amplitude": digits(random.between(1.0, 4.0)),
        "period": digits(random.between(0.3, 0.8)), "duration": duration,
    });
    motion
}

/// Floor masses \[kg\] and storey stiffnesses \[N/m\] from the ground up.
fn storeys(random: &mut Random, storeys: usize) -> (Vec<f64>, Vec<f64>) {
    let mass = random.scaled(4e4, 2e5);
    let stiffness = mass * random.scaled(600.0, 2500.0);
    let mut vary = |value: f64| digits(value * random.between(0.8, 1.2));
    (0..storeys).map(|_| (vary(mass), vary(stiffness))).unzip()
}

fn damping(random: &mut Random) -> Value {
    if random.chance(0.5) {
        json!({"ratio": digits(random.between(0.02, 0.06)), "modes": [1]})
    } else {
        json!({"alpha": digits(random.between(0.2, 0.8)), "beta": digits(random.between(0.001, 0.004))})
    }
}

/// A shear building in one plane.
pub(super) fn shear(random: &mut Random, name: &str, count: usize) -> Value {
    let (masses, springs) = storeys(random, count);
    json!({
        "name": name, "kind": "shear", "mass": masses, "stiffness": springs, "storey_height": STOREY,
        "damping": damping(random),
    })
}

/// A frame in one plane.
pub(super) fn frame(random: &mut Random, name: &str, count: usize) -> Value {
    let spans = random.whole(1, 2);
    let spans: Vec<f64> = (0..spans)
        .map(|_| digits(random.between(4.0, 6.5)))
        .collect();
    let column = digits(random.between(0.4, 0.6));
    json!({
        "name": name, "kind": "frame", "storeys": count, "storey_height": STOREY, "spans": spans,
        "column": {"width": column, "depth": column}, "beam": {"width": 0.3, "depth": digits(random.between(0.45, 0.6))},
        "elastic_modulus": 3e10, "beam_mass": random.scaled(3000.0, 9000.0),
        "column_segments": 2, "beam_segments": 2, "damping": damping(random),
    })
}

/// A building with a rectangular plan at a place of the site, its storeys as springs with a centre beside that of mass.
pub(super) fn in_plan(
    random: &mut Random,
    name: &str,
    count: usize,
    size: [f64; 2],
    at: [f64; 2],
) -> Value {
    let (masses, springs) = storeys(random, count);
    let mut along =
        |stiffness: f64| json!({"x": stiffness, "y": digits(stiffness * random.between(0.7, 1.3))});
    let springs: Vec<Value> = springs.into_iter().map(&mut along).collect();
    let off = [0, 1].map(|_| digits(random.between(-0.08, 0.08) * size[0]));
    json!({
        "name": name, "kind": "shear", "plan": size, "at": at, "mass": masses, "stiffness": springs,
        "eccentricity": off, "storey_height": STOREY, "damping": damping(random),
    })
}

/// Shortens the motion of a model that has contacts of the momentum law, whose buildings may come to rest against each other
/// in very many impacts.
pub(super) fn shorten_if_lasting(tree: &mut Value, duration: f64) {
    let gaps = tree["gap"].as_array();
    let lasting =
        gaps.is_some_and(|gaps| gaps.iter().any(|gap| gap["law"] == json!("restitution")));
    if lasting {
        tree["motion"]["duration"] = json!(duration);
    }
}

/// A gap between neighbours in one plane, with any law.
pub(super) fn gap_in_plane(random: &mut Random, between: [&str; 2]) -> Value {
    let law = LAWS[random.below(LAWS.len())];
    let mut gap = gap(random, between, law);
    gap["width"] = json!(random.scaled(0.002, 0.03));
    gap
}

/// A gap between neighbours with plans, whose width follows from their places.
pub(super) fn gap_in_plan(random: &mut Random, between: [&str; 2]) -> Value {
    let law = LAWS_IN_PLAN[random.below(LAWS_IN_PLAN.len())];
    let mut gap = gap(random, between, law);
    if let Some(keys) = gap.as_object_mut() {
        keys.remove("width");
    }
    gap
}

/// A spring that yields at `force` after `deformation`, with its rule; in the unit that the place asks for.
pub(super) fn hinge(random: &mut Random, rule: &str, yields: f64) -> Value {
    let mut hinge =
        json!({"rule": rule, "yield": yields, "post_yield": digits(random.between(0.01, 0.1))});
    if rule != "bilinear" {
        hinge["cracking"] = json!(digits(yields * random.between(0.25, 0.5)));
        hinge["post_cracking"] = json!(digits(random.between(0.3, 0.6)));
    }
    match rule {
        "takeda" => hinge["gamma"] = json!(digits(random.between(0.2, 0.6))),
        "pinched" => {
            hinge["pinching"] =
                json!({"deformation": 0.8, "force": digits(random.between(0.2, 0.5))});
            hinge["unloading_exponent"] = json!(0.3);
            hinge["damage"] = json!({"ductility": 0.02, "energy": 0.05});
        }
        _ => {}
    }
    hinge
}

/// Hinges of a shear building that yields after some millimetres.
pub(super) fn storey_hinges(random: &mut Random, rule: &str) -> Value {
    let yields = digits(random.between(0.004, 0.012));
    hinge(random, rule, yields)
}

/// Hinges of a frame; `rule` stands once for columns and beams.
pub(super) fn frame_hinges(random: &mut Random, rule: &str) -> Value {
    let mut of = |yields: f64| {
        let yields = digits(yields * random.between(0.8, 1.3));
        let mut hinge = hinge(random, rule, yields);
        let shared = ["rule", "gamma", "pinching", "unloading_exponent", "damage"];
        let keys = hinge.as_object_mut();
        let shared = keys.map(|keys| shared.map(|key| Some((key, keys.remove(key)?))));
        (hinge, shared)
    };
    let (column, shared) = of(2e5);
    let (beam, _) = of(1.2e5);
    let mut hinges = json!({"column": column, "beam": beam});
    for (key, value) in shared.into_iter().flatten().flatten() {
        hinges[key] = value;
    }
    hinges
}
