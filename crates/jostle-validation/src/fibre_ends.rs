//! Forces of ends of members that are made of fibres, against those of OpenSees.

use jostle::{Outcome, System};
use serde_json::Value;

use crate::data::{at, list, number};
use crate::row::Row;

/// Rows of a building: greatest and least axial forces and moments over all its ends; none without fibres.
pub(crate) fn rows(
    source: &str,
    (system, outcome): (&System, &Outcome),
    index: usize,
    stored: &Value,
    tolerance: f64,
) -> Vec<Row> {
    if stored.get("sections").is_none() {
        return Vec::new();
    }
    let (building, stored) = (&system.buildings[index], list(stored, "/sections"));
    let sections = &building.discretization.sections;
    assert_eq!(stored.len(), sections.len(), "as many ends");
    let forces = sections.iter().zip(&building.members.sections);
    let mut rows = Vec::new();
    for (kind, key, unit, what) in [
        (0, "axial", "n", "axial forces [N]"),
        (1, "moment", "n_m", "moments along [N·m]"),
        (2, "moment_across", "n_m", "moments across [N·m]"),
    ] {
        if building.members.sections[0].len() <= kind {
            continue;
        }
        let (mut wanted, mut got) = (Vec::new(), Vec::new());
        for (section, forms) in forces.clone() {
            let name = building.discretization.name_of_section(section);
            let mut named = stored.iter();
            let stored = named.find(|stored| at(stored, "/name").as_str() == Some(&name));
            let stored = stored.expect("the end is there");
            wanted.extend(
                ["max", "min"].map(|side| number(stored, &format!("/{key}_{side}_{unit}"))),
            );
            got.extend(outcome.members[index][forms[kind]]);
        }
        let quantity = format!("{}, ends of fibres, {what}", building.name);
        rows.push(Row::worst_of(source, quantity, &wanted, &got, tolerance));
    }
    rows
}
