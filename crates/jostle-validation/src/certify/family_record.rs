//! The part of the page on random models that the families with a reference of their own have.

use std::collections::BTreeMap;
use std::fmt::Write;

use super::families::FAMILIES;
use super::record::{Marks, Record, Shares, around, close, table};

/// Marks between which a page holds what is written here.
const MARKS: Marks = [
    "<!-- Families, written by `jostle-validation --certify-report`; do not edit up to the end mark. -->\n",
    "<!-- End of the families that `jostle-validation --certify-report` writes. -->\n",
];

impl Record {
    /// The family of its models, if they are of one with a reference of its own.
    #[must_use]
    pub fn family(&self) -> Option<&'static str> {
        let kind = &self.runs.first()?.kind;
        let family = FAMILIES.iter().find(|family| family.name == *kind)?;
        Some(family.name)
    }
}

/// A family in one row.
#[derive(Default)]
struct Row {
    models: usize,
    runs: usize,
    false_alarms: usize,
    cut: usize,
    shares: Shares,
}

/// A page with the tables of families between their marks.
///
/// # Errors
/// The page lacks the marks.
pub fn families_page(old: &str, records: &[Record]) -> Result<String, String> {
    let [before, after] = around(old, &MARKS)?;
    let mut text = before.to_owned();
    let mut rows: BTreeMap<&str, Row> = BTreeMap::new();
    let mut seeds = BTreeMap::<u64, ()>::new();
    for record in records {
        let Some(family) = record.family() else {
            continue;
        };
        seeds.insert(record.seed, ());
        let row = rows.entry(family).or_default();
        row.models += record.models;
        row.runs += record.runs.len();
        for run in &record.runs {
            row.false_alarms += usize::from(run.false_alarm);
            row.cut += usize::from(run.cut_s.is_some());
            for number in &run.numbers {
                row.shares.add(run, number.ratio);
            }
        }
    }
    let models: usize = rows.values().map(|row| row.models).sum();
    let seeds: Vec<String> = seeds.keys().map(ToString::to_string).collect();
    let _ = writeln!(
        text,
        "\n{models} models with the seeds {}. A false alarm is a run that warns, or reports `sensitive_from_s`, although all its numbers are certain and within the tolerance.\n",
        seeds.join(", ")
    );
    let _ = writeln!(
        text,
        "| family | models | runs | numbers | within 1× | within 3× | beyond 1×, warned | beyond 3×, not warned | reference uncertain | worst | cut before a sensitive instant | false alarms |\n\
         |---|---|---|---|---|---|---|---|---|---|---|---|"
    );
    for (name, row) in &rows {
        let shares = &row.shares;
        let share = |part: usize| 100.0 * part as f64 / shares.all.max(1) as f64;
        let _ = writeln!(
            text,
            "| {name} | {} | {} | {} | {:.2} % | {:.2} % | {} | {} | {} | {:.3}× | {} | {} ({:.1} %) |",
            row.models,
            row.runs,
            shares.all,
            share(shares.within),
            share(shares.within_thrice),
            shares.warned,
            shares.silent,
            shares.uncertain,
            shares.worst,
            row.cut,
            row.false_alarms,
            100.0 * row.false_alarms as f64 / row.runs.max(1) as f64,
        );
    }
    text.push('\n');
    table(
        &mut text,
        "family, solver and tolerance",
        records,
        |run, _| format!("{}, {} at {:.0e}", run.kind, run.solver, run.tolerance),
    );
    table(&mut text, "quantity of families", records, |run, kind| {
        format!("{kind}, {}", run.solver)
    });
    close(&mut text, records);
    text.push_str(after);
    Ok(text)
}

#[cfg(test)]
mod tests {
    use super::super::record::{NumberRecord, RunRecord};
    use super::*;

    #[test]
    fn a_family_has_a_row_with_its_false_alarms() {
        let run = |false_alarm: bool| RunRecord {
            model: 1,
            kind: "soil".to_owned(),
            laws: "none".to_owned(),
            solver: "riccati".to_owned(),
            tolerance: 1e-3,
            warned: false_alarm,
            false_alarm,
            cut_s: None,
            numbers: vec![NumberRecord {
                kind: "drift".to_owned(),
                name: "A floor 1".to_owned(),
                ratio: Some(0.25),
            }],
        };
        let record = Record {
            seed: 7,
            models: 1,
            runs: vec![run(true), run(false)],
            failures: Vec::new(),
        };
        assert_eq!(record.family(), Some("soil"));
        let old = format!("before\n{}old\n{}after\n", MARKS[0], MARKS[1]);
        let new = families_page(&old, &[record]).expect("a page");
        let row =
            "| soil | 1 | 2 | 2 | 100.00 % | 100.00 % | 0 | 0 | 0 | 0.250× | 0 | 1 (50.0 %) |";
        assert!(new.contains(row), "{new}");
        assert!(new.starts_with("before\n") && new.ends_with("after\n"));
    }
}
