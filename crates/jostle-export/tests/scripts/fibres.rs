//! Ends made of fibres, and what columns carry. That OpenSees gives the same answers is shown in docs/validation.md.

use jostle::System;
use jostle::hysteresis::Side;

use crate::script::{export, model, number, table};

const FRAME: &str = include_str!("../../../jostle-validation/data/opensees/fibres.toml");
const IN_SPACE: &str = include_str!("../../../jostle-validation/data/opensees/plan_fibres.toml");

/// Force of a material per elongation at rest, and what it bears in compression.
fn at_rest(materials: &[Vec<String>], tag: &str) -> [f64; 2] {
    let row = materials.iter().find(|row| row[1] == tag);
    let row = row.expect("the material is there");
    let value = |at: usize| number(&row[at]);
    match row[0].as_str() {
        "\"Concrete01\"" => [2.0 * value(2) / value(3), -value(2)],
        "\"Steel02\"" => [value(3), value(2)],
        "\"ElasticPP\"" => [value(2), -value(2) * value(4)],
        "\"Elastic\"" => [value(2), 0.0],
        "\"Parallel\"" => row[2..].iter().fold([0.0; 2], |[k, f], part| {
            let part = at_rest(materials, part);
            [k + part[0], f + part[1]]
        }),
        other => panic!("{other}"),
    }
}

/// Adds what a fibre gives to the stiffness and the strength of its section over 1, x, y, x², x y, y².
fn add(sums: &mut [f64; 12], [x, y]: [f64; 2], [stiffness, strength]: [f64; 2]) {
    for (at, share) in [1.0, x, y, x * x, x * y, y * y].into_iter().enumerate() {
        sums[at] += share * stiffness;
        sums[6 + at] += share * strength;
    }
}

/// The fibres of every end have the stiffness and the strength of the springs of the model, about both axes.
#[test]
fn fibres_of_a_script_are_those_of_the_model() {
    for text in [FRAME, IN_SPACE] {
        let input = model(text);
        let script = export(&input).expect("it can be exported").text;
        let system = System::assemble(&input.model).expect("sound");
        let tables = ["FIBRES", "FIBRE_ENDS", "MATERIALS"].map(|name| table(&script, name));
        let [fibres, ends, materials] = tables;
        let building = &system.buildings[0];
        let sections = &building.discretization.sections;
        assert_eq!(ends.len(), sections.len());
        for section in sections {
            let name = format!("\"{}\"", building.discretization.name_of_section(section));
            let end = ends.iter().find(|row| row[6] == name);
            let list = &end.expect("the end is there")[3];
            let (mut ours, mut theirs) = ([0.0; 12], [0.0; 12]);
            for fibre in section.fibres.iter() {
                let curve = fibre.spring.backbone();
                let strength = curve.side(Side::Negative).yielding.force;
                // What hardens of steel beside its slider bears nothing at rest.
                let hardening = curve.side(Side::Negative).post_yield / curve.initial();
                let [x, y] = fibre.at;
                let own = [curve.initial(), (1.0 - hardening) * strength];
                add(&mut ours, [x, y], own);
            }
            for row in fibres.iter().filter(|row| row[0] == *list) {
                let mut own = at_rest(&materials, &row[3]);
                let kind = materials.iter().find(|material| material[1] == row[3]);
                if let Some(steel) = kind.filter(|material| material[0] == "\"Steel02\"") {
                    own[1] *= 1.0 - number(&steel[4]);
                }
                add(&mut theirs, [1, 2].map(|at| number(&row[at])), own);
            }
            for (at, (a, b)) in ours.into_iter().zip(theirs).enumerate() {
                let scale = ours[at / 6 * 6];
                assert!((a - b).abs() < 1e-7 * scale, "{name}, {at}: {a} and {b}");
            }
        }
    }
}

/// An end stands between its joint and the end of a member, the upper node second.
#[test]
fn fibres_stand_between_joints_and_members() {
    for (text, members, joints) in [
        (FRAME, "MEMBERS", "NODES"),
        (IN_SPACE, "COLUMNS_AND_BEAMS", "JOINTS"),
    ] {
        let script = export(&model(text)).expect("it can be exported").text;
        let (members, ends) = (table(&script, members), table(&script, "FIBRE_ENDS"));
        let joints = table(&script, joints);
        assert!(!ends.is_empty());
        for row in ends {
            let [lower, upper] = [&row[1], &row[2]];
            // A column begins above its foot and ends below its head.
            let at = usize::from(row[6].contains("head"));
            let own = [upper, lower][at];
            let of_column = |member: &&Vec<String>| member[1 + at] == *own;
            assert_eq!(members.iter().filter(of_column).count(), 1, "{row:?}");
            let joint = [lower, upper][at];
            assert!(joints.iter().any(|known| known[0] == *joint), "{row:?}");
        }
    }
}

/// What columns carry is the load of floors, and in space their mass, which rises with the joints.
#[test]
fn columns_carry_what_stands_on_floors() {
    let sums = |text: &str| {
        let script = export(&model(text)).expect("it can be exported").text;
        let carried = table(&script, "CARRIED");
        [1, 2].map(|at| carried.iter().map(|row| number(&row[at])).sum::<f64>())
    };
    let [mass, load] = sums(FRAME);
    assert_eq!(mass, 0.0);
    assert!((load - 2.0 * 300e3).abs() < 1e-6, "{load}");
    let [mass, load] = sums(IN_SPACE);
    assert!((mass - 120e3).abs() < 1e-6, "{mass}");
    assert!((load - 400e3).abs() < 1e-6, "{load}");
}

#[test]
fn surfaces_are_refused_with_what_to_take_instead() {
    for text in [FRAME, IN_SPACE] {
        let (before, after) = text.split_once("rule = \"fibre\"").expect("fibres");
        let after = after.replacen(", steel = \"menegotto-pinto\"", "", 1);
        let after = after.replacen(", fibres = [10, 8]", "", 1);
        let faults = export(&model(&format!("{before}rule = \"surface\"{after}")));
        let faults = faults.expect_err("OpenSees has no such hinge");
        assert_eq!(faults.len(), 1, "{faults:?}");
        assert_eq!(faults[0].path, "building[0].hinges.rule");
        assert!(faults[0].problem.contains("rule = \"fibre\""));
    }
}
