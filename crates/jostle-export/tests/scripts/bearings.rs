//! Scripts of bearings, read back as tables. That OpenSees gives the same answers is shown in docs/validation.md.

use crate::script::{export, model, number, table};
use jostle::System;
use jostle::hysteresis::HysteresisRule;

/// Stages of a pendulum stand one above the other: together they are as stiff as the bearing before it slides, they slide at their
/// friction, and each then follows its bowl.
#[test]
fn stages_of_pendulums_stand_one_above_the_other() {
    const MODEL: &str = include_str!("../../../jostle-validation/data/opensees/pendulums.toml");
    let input = model(MODEL);
    let text = export(&input).expect("it can be exported").text;
    let materials = table(&text, "MATERIALS");
    let system = System::assemble(&input.model).expect("a sound model");
    let sticks = &system.buildings[0].discretization.stick_model;
    let bearing = sticks.springs.iter().find_map(|spring| spring.hysteresis);
    let hysteresis = bearing.expect("a bearing");
    let HysteresisRule::Pendulums(stages) = hysteresis.rule() else {
        panic!("a pendulum");
    };
    let chain: Vec<Vec<String>> = table(&text, "SPRINGS")
        .into_iter()
        .filter(|row| row[1].starts_with('1') && row[3] == "1")
        .filter(|row| row[row.len() - 1] == "None")
        .take(3)
        .collect();
    let mut flexibility = 0.0;
    for (place, row) in chain.iter().enumerate() {
        let tags = row[3..row.len() - 1]
            .iter()
            .filter(|cell| !cell.is_empty())
            .skip(1)
            .step_by(2);
        let parts = tags.map(|tag| {
            materials
                .iter()
                .find(|row| row[1] == *tag)
                .expect("a material")
        });
        let parts: Vec<&Vec<String>> = parts.collect();
        let stiffness = |row: &Vec<String>| number(&row[2]);
        let sum: f64 = parts.iter().take(2).map(|row| stiffness(row)).sum();
        flexibility += 1.0 / sum;
        if place == 2 {
            break;
        }
        let stage = stages[place];
        let slips = number(&parts[0][3]);
        assert!((sum * slips / stage.friction - 1.0).abs() < 1e-9, "{row:?}");
        // A stage and what is elastic of it follow the bowl.
        let bowl = 1.0 / (1.0 / stiffness(parts[1]) - 1.0 / sum);
        assert!((bowl / stage.stiffness - 1.0).abs() < 1e-9);
        assert_eq!(parts.len(), 4);
    }
    let elastic = hysteresis.backbone().initial();
    assert!((flexibility * elastic - 1.0).abs() < 1e-9, "{flexibility}");
}
