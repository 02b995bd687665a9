//! Histories as digests: of every quantity of every building over quarters of the run, and of all of them over short spans.

use std::collections::BTreeMap;

use jostle::history::SECTION_FORCES;
use jostle::{Column, Outcome};
use serde_json::{Value, json};

use super::digest::Bits;

/// Spans of a run that have a digest of all columns.
const SPANS: usize = 16;
/// Parts of a run in which every quantity has a digest.
const PARTS: usize = 4;

/// Digests of one quantity.
#[derive(Clone, Default)]
struct Kept {
    parts: [Bits; PARTS],
    last: f64,
}

impl Kept {
    fn add(&mut self, part: usize, value: f64) {
        self.parts[part].number(value);
        self.last = value;
    }

    fn tree(self) -> Value {
        let digests = self.parts.map(|part| part.short(2)).join(" ");
        json!({"digests": digests, "last": self.last})
    }
}

/// Digests of all columns together, span by span.
pub(super) fn describe_in_short(outcome: &Outcome) -> Value {
    let mut whole = describe(outcome);
    if let Some(keys) = whole.as_object_mut() {
        keys.remove("columns");
    }
    whole
}

/// Everything over time, shortened; `null` where nothing was recorded.
pub(super) fn describe(outcome: &Outcome) -> Value {
    let Some(history) = outcome
        .history
        .as_ref()
        .filter(|history| !history.is_empty())
    else {
        return Value::Null;
    };
    let names: Vec<String> = history
        .columns()
        .iter()
        .map(|column| name(*column))
        .collect();
    let mut sorted = names.clone();
    sorted.sort();
    sorted.dedup();
    let place = |name| sorted.binary_search(name).unwrap_or_default();
    let places: Vec<usize> = names.iter().map(place).collect();
    let time = history
        .columns()
        .iter()
        .position(|column| *column == Column::TIME);
    let at = |row: &[f64]| time.map_or(0.0, |time| row[time]);
    let end = at(&history.row(history.len() - 1));
    let mut spans: [Bits; SPANS] = Default::default();
    let mut kept = vec![Kept::default(); sorted.len()];
    for row in (0..history.len()).map(|row| history.row(row)) {
        let share = if end > 0.0 { at(&row) / end } else { 0.0 };
        let span = ((share * SPANS as f64) as usize).min(SPANS - 1);
        for (value, place) in row.iter().zip(&places) {
            spans[span].number(*value);
            kept[*place].add(span * PARTS / SPANS, *value);
        }
    }
    let columns: BTreeMap<String, Value> = sorted
        .into_iter()
        .zip(kept)
        .map(|(name, column)| (name, column.tree()))
        .collect();
    json!({
        "rows": history.len(),
        "span_s": end / SPANS as f64,
        "spans": spans.map(|span| span.short(3)),
        "columns": columns,
        "springs": springs(outcome),
        "members": members(outcome),
    })
}

/// Quantity and building, contact or link of a column.
fn name(column: Column) -> String {
    let recorded = column.recorded();
    match recorded.owner {
        "run" | "energy" => format!("{} {}", recorded.owner, recorded.name),
        "floor" => format!(
            "{} of floors of building {}",
            recorded.name,
            column.place()[0]
        ),
        owner => format!("{} of {owner} {}", recorded.name, column.place()[0]),
    }
}

/// Digest of the loops of springs that yield.
fn springs(outcome: &Outcome) -> Option<String> {
    let history = outcome.spring_history.as_ref()?;
    let mut bits = Bits::default();
    for spring in 0..outcome.state.springs.len() {
        for [deformation, force] in history.of_spring(spring) {
            bits.number(deformation.into());
            bits.number(force.into());
        }
    }
    Some(bits.short(4))
}

/// Forces of members over time, one after the other at every section; absent where none were asked for.
fn members(outcome: &Outcome) -> Option<Value> {
    let history = outcome.member_history.as_ref()?;
    let count = history
        .rows()
        .next()
        .map_or(0, |row| row.len() * SECTION_FORCES);
    let mut kept = vec![Kept::default(); count];
    let rows = history.times().len();
    for (index, row) in history.rows().enumerate() {
        for (force, value) in kept.iter_mut().zip(row.iter().flatten()) {
            force.add(index * PARTS / rows, *value);
        }
    }
    let forces: Vec<Value> = kept.into_iter().map(Kept::tree).collect();
    let sections: Vec<&[Value]> = forces.chunks(SECTION_FORCES).collect();
    let mut times = Bits::default();
    for time in history.times() {
        times.number(time);
    }
    Some(json!({"members": history.members(), "times": times.short(4), "sections": sections}))
}
