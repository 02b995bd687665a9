//! Shears and moments of columns and beams against OpenSees, step for step. `data/member_forces.py` computes the numbers anew
//! from the exported script.

use std::collections::BTreeMap;

use jostle::MemberRequest;
use jostle::results::{member_name, section_name};
use jostle_testkit::files::sound;
use jostle_testkit::runs::run;

/// Instant, then shear and moment at one end and at the other, as forces on the ends \[s, N, N·m\].
type Row = [f64; 5];

fn stored() -> BTreeMap<&'static str, Vec<Row>> {
    let text = include_str!("data/frame_member_forces.csv");
    let mut members: BTreeMap<&str, Vec<Row>> = BTreeMap::new();
    for line in text.lines().filter(|line| !line.starts_with('#')).skip(1) {
        let (name, numbers) = line.split_once(',').expect("a name first");
        let numbers: Vec<f64> = numbers
            .split(',')
            .map(|number| number.parse().expect("a number"))
            .collect();
        let row = Row::try_from(numbers).expect("five numbers");
        members.entry(name).or_default().push(row);
    }
    members
}

#[test]
fn opensees_finds_the_same_forces() {
    let due = stored();
    let text = include_str!("data/frame.toml");
    let mut input = sound(text);
    let names: Vec<&str> = due.keys().copied().collect();
    input.model.analysis.members = MemberRequest::with_histories(&names);
    let motion = input.ground_motion().expect("a motion");
    let (system, outcome) = run(&input.model, &motion, Some(0.0));
    let history = outcome.member_history.as_ref().expect("asked for");
    assert_eq!(history.members().len(), due.len());
    let (rows, times): (Vec<_>, _) = (history.rows().collect(), history.times());
    let (mut first, mut worst, mut compared) = (0, 0.0_f64, 0);
    for [building, member] in history.members() {
        let building = &system.buildings[*building];
        let member = &building.members.members[*member];
        assert!(["foot", "left"].contains(&section_name(member.place, member.sections[0].at)));
        let due = &due[&member_name(building, member)[..]];
        for value in 0..4 {
            let sizes = due.iter().map(|row| row[1 + value].abs());
            let scale = sizes.fold(0.0, f64::max);
            // Local forces act on the member: the signs of its two ends differ.
            let sign = [1.0, -1.0, -1.0, 1.0][value];
            for row in due {
                let mut times = times.iter();
                let at = times.position(|time| (time - row[0]).abs() < 1e-9);
                let forces = rows[at.expect("recorded")][first + value / 2];
                let found = forces[1 + value % 2];
                worst = worst.max((found - sign * row[1 + value]).abs() / scale);
                compared += 1;
            }
        }
        first += member.sections.len();
    }
    assert_eq!(compared, 5 * 4 * 20);
    // The stored numbers carry a tenth of a millinewton.
    assert!(worst < 1e-7, "{worst:e}");
}
