//! Plane frames as they are drawn, with braces, infill struts and walls, beside neighbours, against an integrator of eighth order.

mod fibres;
mod fibres_in_space;
pub(crate) mod files;
mod pendulums;
mod rocking;

use std::ops::ControlFlow;

use jostle::linear::StepMatrix;
use jostle::structure::StepEquations;
use jostle::{Plan, RiccatiFactor, RiccatiSweep, Run, Settings, Summary, System, simulate};
use serde_json::Value;

use crate::data::{document, entries, list, number, numbers};
use crate::files::model;
use crate::row::Row;

/// The references are good to 1e-6; the tolerance of the program, and of the comparison.
const RUNS: [(f64, f64); 2] = [(1e-3, 1e-3), (1e-5, 1e-5)];

/// What does not depend on time agrees with the digits that are stored.
const STATIC: f64 = 1e-7;

const CASES: [(&str, &str); 9] = [
    (
        "members/a_frame_lines_bays",
        include_str!("../data/members/a_frame_lines_bays.json"),
    ),
    (
        "members/f_podium",
        include_str!("../data/members/f_podium.json"),
    ),
    (
        "members/g_levels_slab_to_column",
        include_str!("../data/members/g_levels_slab_to_column.json"),
    ),
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
    (
        "members/c2_infill_pinched_softening",
        include_str!("../data/members/c2_infill_pinched_softening.json"),
    ),
    (
        "members/d1_coupled_wall_elastic",
        include_str!("../data/members/d1_coupled_wall_elastic.json"),
    ),
    (
        "members/d2_coupled_wall_base_hinges",
        include_str!("../data/members/d2_coupled_wall_base_hinges.json"),
    ),
];

/// All rows of this family.
#[must_use]
pub fn rows() -> Vec<Row> {
    let mut rows = Vec::new();
    for (name, text) in CASES {
        let case = document(text);
        for (tolerance, close) in RUNS {
            // One reference is less accurate than that.
            let close = close.max(number(&case, "/accuracy/claimed_relative_of_peaks"));
            rows.extend(compare(name, &case, tolerance, close));
        }
    }
    rows.extend(fibres::rows());
    rows.extend(fibres_in_space::rows());
    rows.extend(rocking::rows());
    rows.extend(pendulums::rows());
    rows
}

/// The summary of a run of a model file, and its system.
fn run(file: &str) -> (System, Summary) {
    let input = model(file);
    let system = System::assemble(&input.model).expect("a sound model");
    let motion = input.ground_motion().expect("the record is built in");
    let plan = Plan::choose(&system, &motion, &input.model.analysis).expect("a sound plan");
    let outcome = simulate(&system, &motion, &plan, Settings::default(), |_| {
        ControlFlow::Continue(())
    });
    let summary = Summary::new(&Run {
        model: &input.model,
        system: &system,
        motion: &motion,
        plan: &plan,
        outcome: &outcome,
        without_contact: None,
        wall: Default::default(),
    });
    (system, summary)
}

/// The summary of a run of a model file.
pub(crate) fn summary_of(file: &str) -> Summary {
    run(file).1
}

/// A brace, strut or wall by its name.
fn part<'a>(summary: &'a Summary, name: &str) -> &'a jostle::results::summary::PartSummary {
    let mut parts = summary
        .buildings
        .iter()
        .flat_map(|building| &building.parts);
    parts
        .find(|part| part.name == name)
        .expect("a part of that name")
}

/// Whether the model of a case is its mirror image.
fn is_from_behind(case: &Value) -> bool {
    case.pointer("/input/wall_EI").is_some()
}

fn compare(name: &str, case: &Value, tolerance: f64, close: f64) -> Vec<Row> {
    let (system, summary) = run(&files::file(&case["input"], tolerance));
    let with = |what: &str| format!("{what}, tolerance {tolerance:e}");
    let mut rows = Vec::new();
    let (mut expected, mut got) = (Vec::new(), Vec::new());
    let from_behind = is_from_behind(case);
    for building in &summary.buildings {
        for floor in &building.floors.above {
            let place = format!("/results/displacement/{}{}", building.name, floor.floor);
            expected.extend(["max_m", "min_m"].map(|key| number(case, &format!("{place}/{key}"))));
            let response = &floor.response;
            got.extend(match from_behind {
                false => [response.displacement_max_m, response.displacement_min_m],
                true => [-response.displacement_min_m, -response.displacement_max_m],
            });
        }
    }
    if let Some(risen) = case.pointer("/results/displacement/W4.left.rise") {
        // How far the top of the left wall rises is how much longer it becomes.
        let wall = part(&summary, "W.wall.2");
        expected.extend([number(risen, "/max_m"), number(risen, "/min_m")]);
        got.extend([wall.deformation_max, -wall.deformation_min]);
    }
    let quantity = with("displacements of floors [m]");
    rows.push(Row::worst_of(name, quantity, &expected, &got, close));
    let (mut expected, mut got) = (Vec::new(), Vec::new());
    for (part_name, stored) in entries(case, "/results/force") {
        expected.extend([number(stored, "/max"), number(stored, "/min")]);
        if let Some(wall) = part_name.strip_prefix("base") {
            let part = part(&summary, if wall == "1" { "W.wall.2" } else { "W.wall.1" });
            let both = [part.moment_min_n_m, part.moment_max_n_m];
            got.extend(both.map(|moment| -moment.unwrap_or_default()));
            continue;
        }
        // "brace2", "strut2.up" and "panel2" are parts of storey 2.
        let (storey, rise) = part_name
            .trim_start_matches(char::is_alphabetic)
            .split_at(1);
        let mut parts = summary.buildings[0].parts.iter();
        let part = parts
            .find(|part| part.name.contains(&format!(".{storey}.1")) && part.name.ends_with(rise))
            .expect("a part of that name");
        got.extend([part.force_max_n, part.force_min_n]);
    }
    if !expected.is_empty() {
        let is_wall = case.pointer("/results/force/base1").is_some();
        let quantity = match is_wall {
            true => with("moments at the feet of walls [N·m]"),
            false => with("axial forces [N]"),
        };
        rows.push(Row::worst_of(name, quantity, &expected, &got, close));
    }
    let contacts = &summary.gaps[0].contacts;
    let both = ["peak_n", "impulse_n_s"].map(|key| {
        let places = contacts.iter().enumerate();
        places
            .map(|(index, contact)| {
                // Those at different levels are named after their height.
                let by_number = format!("/results/contact/contact{}/{key}", index + 1);
                let by_height = format!("/results/contact/contact@{:.1}/{key}", contact.height_m);
                match case.pointer(&by_number) {
                    Some(_) => number(case, &by_number),
                    None => number(case, &by_height),
                }
            })
            .collect::<Vec<f64>>()
    });
    let peaks: Vec<f64> = contacts
        .iter()
        .map(|contact| contact.peak_force_n)
        .collect();
    let impulses: Vec<f64> = contacts.iter().map(|contact| contact.impulse_n_s).collect();
    for (what, expected, got) in [
        ("contact forces [N]", &both[0], peaks),
        ("impulses of contacts [N·s]", &both[1], impulses),
    ] {
        rows.push(Row::worst_of(name, with(what), expected, &got, close));
    }
    // Light impacts come and go with the tolerance.
    if from_behind && tolerance < RUNS[0].0 {
        let key = |index| format!("/results/contact/contact{}/impacts", index + 1);
        let expected: Vec<f64> = (0..contacts.len())
            .map(|index| number(case, &key(index)))
            .collect();
        let got: Vec<f64> = contacts
            .iter()
            .map(|contact| contact.impact_count as f64)
            .collect();
        rows.push(Row::worst_of(name, with("impacts"), &expected, &got, 0.0));
    }
    if case.pointer("/input/storey_heights_m").is_some() {
        let count = list(&case["input"], "/storey_heights_m").len();
        let frame = usize::from(from_behind);
        assert_eq!(count, summary.buildings[frame].floors.above.len());
    }
    if case.get("flexibility_m_per_n").is_some() {
        rows.extend(compare_statics(name, case, &system, &summary));
    }
    rows
}

/// Lateral periods of both buildings, and how far the floors of the frame give way under a unit force each.
fn compare_statics(name: &str, case: &Value, system: &System, summary: &Summary) -> [Row; 2] {
    let expected = numbers(case, "/periods_s_without_contact");
    let all = summary
        .buildings
        .iter()
        .flat_map(|building| &building.periods_s);
    let got: Vec<f64> = expected
        .iter()
        .filter_map(|period| {
            let away = |candidate: &&f64| (*candidate - period).abs();
            all.clone()
                .min_by(|a, b| away(a).total_cmp(&away(b)))
                .copied()
        })
        .collect();
    let periods = Row::worst_of(name, "periods without contact [s]", &expected, &got, STATIC);
    let frame = usize::from(is_from_behind(case));
    let building = &system.structures()[frame].structure;
    let sweep = RiccatiSweep::new(building);
    let mut factor = RiccatiFactor::default();
    sweep
        .factorize(
            &StepMatrix::STATIC,
            &building.equations.initial_tangents(),
            &mut factor,
        )
        .expect("it stands");
    let floors: Vec<usize> = building
        .discretization
        .floors
        .iter()
        .filter_map(|floor| building.equations.horizontal(*floor))
        .collect();
    let (mut expected, mut got) = (Vec::new(), Vec::new());
    for (row, pushed) in floors.iter().enumerate() {
        let mut moved = vec![0.0; building.equations.len()];
        moved[*pushed] = 1.0;
        sweep.solve(&factor, &mut moved, &mut Default::default());
        got.extend(floors.iter().map(|floor| moved[*floor]));
        expected.extend(numbers(case, &format!("/flexibility_m_per_n/matrix/{row}")));
    }
    let flexibility = Row::worst_of(name, "flexibility of floors [m/N]", &expected, &got, STATIC);
    [periods, flexibility]
}
