//! Scripts of buildings on grounds of their own, read back as tables. That OpenSees gives the same answers is shown in docs/validation.md.

use crate::script::{export, model, number, table};
use jostle::System;
use jostle::structure::Support;

const GROUNDS: &str = include_str!("../../../jostle-validation/data/opensees/grounds.toml");
const UPWARDS: &str = include_str!("../../../jostle-validation/data/opensees/upwards.toml");
const PLAN: &str = include_str!("../../../jostle-validation/data/opensees/plan_symmetric.toml");

/// What a script says after a name.
fn line<'a>(text: &'a str, name: &str) -> &'a str {
    let start = format!("{name} = ");
    let mut lines = text.lines();
    lines
        .find_map(|line| line.strip_prefix(&start))
        .expect("a line")
}

/// Every building, and the wall on the ground of the one before it, has its arrival; motions that are not the common one are written once.
#[test]
fn grounds_and_their_arrivals_are_written() {
    let text = export(&model(GROUNDS)).expect("it can be exported").text;
    assert_eq!(
        line(&text, "GROUNDS"),
        "[(None, 0.0), (None, 0.04), (GROUND_1, 0.053), (None, 0.0)]"
    );
    assert_eq!(line(&text, "VERTICAL"), "[]");
    let class = text.split("class GROUND_1:").nth(1).expect("a class");
    assert!(class.contains("    RICKER = (3.5, 0.7, 1.5)"));
    assert!(!text.contains("class GROUND_2"));
}

/// Damping of masses acts on motion relative to the ground of the building: dashpots α m to a point of it.
#[test]
fn masses_are_damped_relative_to_their_ground() {
    let input = model(GROUNDS);
    let text = export(&input).expect("it can be exported").text;
    let system = System::assemble(&input.model).expect("sound");
    let (springs, materials) = (table(&text, "SPRINGS"), table(&text, "MATERIALS"));
    let (nodes, supports) = (table(&text, "NODES"), table(&text, "SUPPORTS"));
    assert_eq!(text.matches("\"alpha\": 0.0, ").count(), 4);
    for (index, building) in system.buildings.iter().enumerate().take(3) {
        // The last node of a building is a point of its ground.
        let block = (index + 1).to_string();
        let mut rows = nodes.iter().filter(|row| row[0].starts_with(&block));
        let ground = &rows.next_back().expect("nodes")[0];
        let held = ["1"; 3].map(str::to_owned);
        assert!(
            supports
                .iter()
                .any(|row| row[0] == *ground && row[1..] == held)
        );
        let mut sum = 0.0;
        for row in springs.iter().filter(|row| row[1] == *ground) {
            let mut all = materials.iter();
            let dashpot = all
                .find(|material| material[1] == row[4])
                .expect("a material");
            assert_eq!([&row[3][..], &dashpot[2]], ["1", "0.0"]);
            sum += number(&dashpot[3]);
        }
        let nodes = building.discretization.stick_model.nodes.iter();
        let moving = nodes.filter(|node| node.support != Support::Fixed);
        let mass: f64 = moving.map(|node| node.mass()).sum();
        let expected = building.equations.alpha * mass;
        assert!((sum / expected - 1.0).abs() < 1e-9, "{sum} {expected}");
    }
}

/// One motion upwards under both buildings; the ground does not part, so that the row is shaken as ever.
#[test]
fn vertical_shaking_is_written_for_every_building() {
    let text = export(&model(UPWARDS)).expect("it can be exported").text;
    assert_eq!(line(&text, "GROUNDS"), "[]");
    assert_eq!(
        line(&text, "VERTICAL"),
        "[(GROUND_1, 0.0), (GROUND_1, 0.0)]"
    );
    let class = text.split("class GROUND_1:").nth(1).expect("a class");
    let factor = class
        .lines()
        .find_map(|line| line.trim().strip_prefix("MOTION_FACTOR = "));
    let factor = number(
        factor
            .and_then(|rest| rest.split(' ').next())
            .expect("a factor"),
    );
    let common = line(&text, "MOTION_FACTOR")
        .split(' ')
        .next()
        .expect("a factor");
    assert!((factor / number(common) - 0.67).abs() < 1e-12);
    assert!(!text.contains("\"alpha\": 0.0, "));
}

#[test]
fn grounds_under_buildings_with_plans_are_refused() {
    let text = PLAN.replacen(
        "[motion]\n",
        "[motion]\napparent_velocity = \"300 m/s\"\n",
        1,
    );
    let faults = export(&model(&text)).expect_err("not by ties of Transformation");
    assert_eq!(faults.len(), 1, "{faults:?}");
    assert_eq!(faults[0].path, "motion");
    assert!(
        faults[0].problem.contains("Transformation") && faults[0].problem.contains("leave out")
    );
}

/// Heads of scripts name the rules that the model has, and no others.
#[test]
fn remarks_concern_the_model_at_hand() {
    const RULES: [&str; 4] = [
        "peak-oriented",
        "normal and bilinear",
        "pinched",
        "fail in shear",
    ];
    let named = |text: &str| {
        let remarks = export(&model(text)).expect("it can be exported").remarks;
        RULES.map(|rule| remarks.iter().any(|remark| remark.contains(rule)))
    };
    assert_eq!(named(GROUNDS), [true, true, false, false]);
    assert_eq!(named(UPWARDS), [false, true, false, false]);
    assert_eq!(named(PLAN), [false; 4]);
    const IN_PLAN: &str =
        include_str!("../../../jostle-validation/data/opensees/plan_isolated.toml");
    assert_eq!(named(IN_PLAN), [false; 4]);
    const FAILING: &str = include_str!("../../../jostle-validation/data/opensees/failing.toml");
    assert!(named(FAILING)[3]);
}
