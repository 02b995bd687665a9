//! Braces and infill struts of frames beside shear buildings, against an integrator of eighth order.

use std::fmt::Write;
use std::ops::ControlFlow;

use jostle::{Plan, Run, Settings, Summary, System, simulate};
use serde_json::Value;

use crate::data::{document, entries, list, number, numbers};
use crate::files::model;
use crate::row::Row;

/// The references are good to 1e-6; the tolerance of the program, and of the comparison.
const RUNS: [(f64, f64); 2] = [(1e-3, 1e-3), (1e-5, 1e-5)];

/// The references take g as 9.80665 m/s², the built-in record 9.81 m/s².
pub(crate) const GRAVITY: f64 = 9.80665 / 9.81;

const CASES: [(&str, &str); 3] = [
    (
        "members/b1_brace_elastic",
        include_str!("../data/members/b1_brace_elastic.json"),
    ),
    (
        "members/b2_brace_bilinear",
        include_str!("../data/members/b2_brace_bilinear.json"),
    ),
    (
        "members/c1_infill_compression_struts",
        include_str!("../data/members/c1_infill_compression_struts.json"),
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
    rows
}

/// The model file of a case.
fn file(input: &Value, tolerance: f64) -> String {
    let list_of = |key: &str, table: &dyn Fn(usize, f64) -> String| {
        let own = numbers(input, key).into_iter().enumerate();
        own.map(|(index, value)| table(index, value))
            .collect::<Vec<_>>()
            .join(", ")
    };
    let rigidity = input["column_EA"].as_array().map(|own| own.to_vec());
    let column = list_of("/column_EI", &|index, value| match &rigidity {
        Some(own) => format!("{{ EI = {value:?}, EA = {} }}", own[index]),
        None => format!("{{ EI = {value:?} }}"),
    });
    let beam = list_of("/beam_EI", &|_, value| format!("{{ EI = {value:?} }}"));
    let axial = if rigidity.is_some() {
        "flexible"
    } else {
        "rigid"
    };
    let (heights, alpha) = (&input["storey_heights_m"], number(input, "/alpha"));
    let neighbour = &input["neighbour"];
    let mut text = format!(
        r#"motion = {{ record = "el-centro-1940-ns", scale = {scale:?}, duration = {duration:?} }}
analysis = {{ tolerance = {tolerance:?} }}
[[gap]]
between = ["F", "N"]
width = {gap:?}
law = "linear"
stiffness = {stiffness:?}
[[building]]
name = "F"
kind = "frame"
storey_height = {heights}
spans = [{span:?}]
column = [{column}]
beam = [{beam}]
density = 0
column_segments = 1
beam_segments = 1
floor_mass = {masses}
axial = "{axial}"
damping = {{ alpha = {alpha:?}, beta = 0 }}
"#,
        scale = GRAVITY * number(input, "/scale"),
        duration = number(input, "/duration_s"),
        gap = number(input, "/gap_m"),
        stiffness = number(input, "/k_contact"),
        span = number(input, "/span_m"),
        masses = input["floor_mass_kg"],
    );
    for (storey, brace) in input["brace"].as_array().into_iter().flatten().enumerate() {
        let direction = match brace["from"].as_str() {
            Some("left") => "up",
            _ => "down",
        };
        let _ = writeln!(
            text,
            "[[building.brace]]\nstoreys = {}\ndirection = \"{direction}\"\nstiffness = {}",
            storey + 1,
            brace["k"]
        );
        if input["elastic"] == Value::Bool(false) {
            let _ = writeln!(
                text,
                "hinge = {{ rule = \"bilinear\", yield = {}, post_yield = {} }}",
                brace["Fy"], brace["hardening"]
            );
        }
    }
    let struts = input["strut_k"].as_array().into_iter().flatten();
    for (storey, stiffness) in struts.enumerate().filter(|(_, own)| own.is_number()) {
        let _ = writeln!(
            text,
            "[[building.infill]]\nstoreys = {}\nstiffness = {stiffness}",
            storey + 1
        );
    }
    let _ = writeln!(
        text,
        "[[building]]\nname = \"N\"\nkind = \"shear\"\nstorey_height = {heights}\nstiffness = {}\nmass = {}\ndamping = {{ alpha = {alpha:?}, beta = 0 }}",
        neighbour["stiffness"], neighbour["mass_kg"]
    );
    text
}

/// The summary of a run of a model file.
pub(crate) fn summary_of(file: &str) -> Summary {
    let input = model(file);
    let system = System::assemble(&input.model).expect("a sound model");
    let motion = input.ground_motion().expect("the record is built in");
    let plan = Plan::choose(&system, &motion, &input.model.analysis).expect("a sound plan");
    let outcome = simulate(&system, &motion, &plan, Settings::default(), |_| {
        ControlFlow::Continue(())
    });
    let run = Run {
        model: &input.model,
        system: &system,
        motion: &motion,
        plan: &plan,
        outcome: &outcome,
        without_contact: None,
        wall: Default::default(),
    };
    Summary::new(&run)
}

fn compare(name: &str, case: &Value, tolerance: f64, close: f64) -> Vec<Row> {
    let summary = summary_of(&file(&case["input"], tolerance));
    let with = |what: &str| format!("{what}, tolerance {tolerance:e}");
    let mut rows = Vec::new();
    let (mut expected, mut got) = (Vec::new(), Vec::new());
    for building in &summary.buildings {
        for floor in &building.floors.above {
            let place = format!("/results/displacement/{}{}", building.name, floor.floor);
            expected.extend(["max_m", "min_m"].map(|key| number(case, &format!("{place}/{key}"))));
            got.extend([
                floor.response.displacement_max_m,
                floor.response.displacement_min_m,
            ]);
        }
    }
    let quantity = with("displacements of floors [m]");
    rows.push(Row::worst_of(name, quantity, &expected, &got, close));
    let (mut expected, mut got) = (Vec::new(), Vec::new());
    for (part, stored) in entries(case, "/results/force") {
        // "brace2" and "strut2.up" are parts of storey 2.
        let (storey, rise) = part.trim_start_matches(char::is_alphabetic).split_at(1);
        let mut parts = summary.buildings[0].parts.iter();
        let own = parts
            .find(|own| own.name.contains(&format!(".{storey}.1")) && own.name.ends_with(rise))
            .expect("a part of that name");
        expected.extend([number(stored, "/max"), number(stored, "/min")]);
        got.extend([own.force_max_n, own.force_min_n]);
    }
    if !expected.is_empty() {
        let quantity = with("axial forces [N]");
        rows.push(Row::worst_of(name, quantity, &expected, &got, close));
    }
    let contacts = &summary.gaps[0].contacts;
    let both = ["peak_n", "impulse_n_s"].map(|key| {
        let places = 1..=contacts.len();
        places
            .map(|place| number(case, &format!("/results/contact/contact{place}/{key}")))
            .collect::<Vec<f64>>()
    });
    let peaks: Vec<f64> = contacts.iter().map(|own| own.peak_force_n).collect();
    let impulses: Vec<f64> = contacts.iter().map(|own| own.impulse_n_s).collect();
    for (what, expected, got) in [
        ("contact forces [N]", &both[0], peaks),
        ("impulses of contacts [N·s]", &both[1], impulses),
    ] {
        rows.push(Row::worst_of(name, with(what), expected, &got, close));
    }
    let count = list(&case["input"], "/storey_heights_m").len();
    assert_eq!(count, summary.buildings[0].floors.above.len());
    rows
}
