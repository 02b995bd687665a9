//! Contact laws with constants as papers print them, against an integrator of eighth order and given paths.

use jostle::contact::{BilinearConstants, Crush, ForceLaw};
use jostle::{ContactLaw, LawKind, RestitutionIs};
use serde_json::Value;

use crate::data::{document, list, number, numbers};
use crate::members::files::GRAVITY;
use crate::members::summary_of;
use crate::row::Row;

/// The tolerance of the program, and of the comparison: peaks of the references at corners of the force are those of
/// parabolas through samples 0.1 ms apart, 4·10⁻⁶ off.
const RUNS: [(f64, f64); 2] = [(1e-3, 1e-3), (1e-6, 1e-5)];

const CASES: [(&str, &str); 4] = [
    (
        "members/i1_impact_material",
        include_str!("../data/members/i1_impact_material.json"),
    ),
    (
        "members/i2_kelvin_c",
        include_str!("../data/members/i2_kelvin_c.json"),
    ),
    (
        "members/i3_kelvin_no_tension_c",
        include_str!("../data/members/i3_kelvin_no_tension_c.json"),
    ),
    (
        "members/j_crushing_gap",
        include_str!("../data/members/j_crushing_gap.json"),
    ),
];

/// All rows of this family.
#[must_use]
pub fn rows() -> Vec<Row> {
    let mut rows = Vec::new();
    for (name, text) in CASES {
        let case = document(text);
        for (tolerance, close) in RUNS {
            rows.extend(compare(name, &case, tolerance, close));
        }
    }
    let paths = document(include_str!("../data/members/contact_laws_static.json"));
    rows.extend(["crushing_gap", "impact_K1_K2"].map(|key| along_path(key, &paths[key])));
    rows
}

/// Keys of the law of a gap.
fn law(law: &Value) -> String {
    let value = |key: &str| number(law, key);
    match law["kind"].as_str() {
        Some("impact") => format!(
            "law = \"bilinear\"\nstiffness = {:?}\nsecond_stiffness = {:?}\nyield = {:?}",
            value("/K1"),
            value("/K2"),
            value("/dy")
        ),
        Some("crush") => format!(
            "law = \"linear\"\nstiffness = {:?}\ncrush = {{ force = {:?}, hardening = {:?} }}",
            value("/k"),
            value("/Fy"),
            value("/eta")
        ),
        _ => format!(
            "law = \"{}\"\nstiffness = {:?}\ndamping = {:?}",
            match law["tension"] {
                Value::Bool(true) => "kelvin",
                _ => "kelvin-no-tension",
            },
            value("/k"),
            value("/c")
        ),
    }
}

/// The model file of a case.
fn file(input: &Value, tolerance: f64) -> String {
    let alpha = number(input, "/alpha");
    let [stiffness, mass] = ["/k", "/m"].map(|key| numbers(input, key));
    let buildings = [0, 1].map(|side| {
        format!(
            "[[building]]\nname = \"{}\"\nkind = \"shear\"\nstorey_height = 3\nstiffness = [{:?}]\nmass = [{:?}]\ndamping = {{ alpha = {alpha:?}, beta = 0 }}\n",
            ["L", "R"][side], stiffness[side], mass[side]
        )
    });
    format!(
        r#"motion = {{ record = "el-centro-1940-ns", scale = {scale:?}, duration = {duration:?} }}
analysis = {{ tolerance = {tolerance:?} }}
[[gap]]
between = ["L", "R"]
width = {gap:?}
{law}
{buildings}"#,
        scale = GRAVITY * number(input, "/scale"),
        duration = number(input, "/duration_s"),
        gap = number(input, "/gap_m"),
        law = law(&input["law"]),
        buildings = buildings.concat(),
    )
}

fn compare(name: &str, case: &Value, tolerance: f64, close: f64) -> Vec<Row> {
    let summary = summary_of(&file(&case["input"], tolerance));
    let contact = &summary.gaps[0].contacts[0];
    let with = |what: &str| format!("{what}, tolerance {tolerance:e}");
    let (mut expected, mut got) = (Vec::new(), Vec::new());
    for building in &summary.buildings {
        let floor = &building.floors.above[0].response;
        let place = format!("/results/displacement/{}", building.name);
        expected.extend(["max_m", "min_m"].map(|key| number(case, &format!("{place}/{key}"))));
        got.extend([floor.displacement_max_m, floor.displacement_min_m]);
    }
    let known = |key: &str| number(case, &format!("/results/contact/contact/{key}"));
    let mut rows = vec![
        Row::worst_of(
            name,
            with("displacements of floors [m]"),
            &expected,
            &got,
            close,
        ),
        Row::worst_of(
            name,
            with("contact force [N]"),
            &[known("peak_n")],
            &[contact.peak_force_n],
            close,
        ),
        Row::worst_of(
            name,
            with("impulse of the contact [N·s]"),
            &[known("impulse_n_s")],
            &[contact.impulse_n_s],
            close,
        ),
    ];
    let law = &case["input"]["law"];
    if law["kind"] == "crush" {
        // What a face that hardens is crushed by follows from the greatest force.
        let [k, yields, share] = ["/k", "/Fy", "/eta"].map(|key| number(law, key));
        let depth = (known("peak_n") - yields) * (1.0 - share) / (share * k);
        let found = contact.crushed_depth_m.unwrap_or(f64::NAN);
        // The force beyond yield is an eighth of the whole.
        rows.push(Row::worst_of(
            name,
            with("depth of the crushed face [m]"),
            &[depth],
            &[found],
            10.0 * close,
        ));
    }
    rows
}

/// Forces of a law under given indentations; faces that crush open where their force ends.
fn along_path(name: &str, path: &Value) -> Row {
    let value = |key: &str| number(path, key);
    let (kind, stiffness) = if name == "crushing_gap" {
        let crush = Crush {
            force: value("/Fy"),
            hardening: value("/eta"),
            hertzian: false,
        };
        (LawKind::Crushing(crush), value("/k"))
    } else {
        let constants = BilinearConstants {
            second_stiffness: value("/K2"),
            yield_indentation: value("/delta_y_m"),
        };
        (LawKind::BilinearGiven(constants), value("/K1"))
    };
    let law = ContactLaw {
        kind,
        stiffness,
        restitution: 1.0,
        restitution_is: RestitutionIs::Input,
    };
    let law: ForceLaw = law.between(1.0, 1.0);
    let [between, every] = ["/steps_between", "/every"].map(|key| value(key) as u32);
    let (mut at, mut depth, mut memory) = (0.0, 0.0, law.touch(0.1));
    let mut got = Vec::new();
    for to in numbers(path, "/reversals") {
        for step in 1..=between {
            let elongation = at + (to - at) * f64::from(step) / f64::from(between);
            let indentation = -(elongation + value("/gap_m")) - depth;
            let force = law.follow(indentation, 0.0, &memory).force;
            law.remember(indentation, 0.0, &mut memory);
            if indentation <= memory.crushed {
                depth += memory.crushed;
                memory = law.touch(0.1);
                memory.crushed_before = depth;
            }
            if step % every == 0 {
                got.push(force);
            }
        }
        at = to;
    }
    let expected: Vec<f64> = list(path, "/d_F")
        .iter()
        .map(|pair| number(pair, "/1"))
        .collect();
    let quantity = "forces along a path of indentations [N]";
    Row::worst_of(name, quantity, &expected, &got, 1e-9)
}
