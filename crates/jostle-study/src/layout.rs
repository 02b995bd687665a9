//! The columns of the table of a study.

use std::collections::HashMap;

use jostle_io::{StudyFile, Values};
use serde::Serialize;

use crate::row::Row;

/// Content of a column.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
#[serde(rename_all = "lowercase")]
pub enum Kind {
    /// Numbers, possibly absent.
    Real,
    /// Whole numbers, possibly absent.
    Whole,
    /// Texts.
    Text,
}

/// A column.
#[derive(Clone, Debug, PartialEq, Eq, Serialize)]
pub struct Column {
    /// Name, with its unit at the end.
    pub name: String,
    /// Its content.
    pub kind: Kind,
}

/// The columns of a study after `case`, `status` and `reason`: first the inputs, then the results.
#[derive(Clone, Debug, PartialEq)]
pub struct Layout {
    /// Columns of what varies, factor by factor.
    pub inputs: Vec<Column>,
    /// Columns of the results, all numeric; the name of the motion precedes them.
    pub results: Vec<Column>,
    places: HashMap<String, usize>,
}

/// One result of a case.
#[derive(Clone, Debug, PartialEq)]
pub struct Named {
    /// Name of its column.
    pub name: String,
    /// Whole or real.
    pub kind: Kind,
    /// The number.
    pub value: Option<f64>,
}

/// Name of the column with the name of the motion.
pub(crate) const MOTION: &str = "motion";
/// Columns before the inputs.
const LEADING: [&str; 3] = ["case", "status", "reason"];

impl Layout {
    /// Columns for the inputs of a study and for the results that its models have, each list in its own order.
    #[must_use]
    pub fn new(file: &StudyFile, results: &[Vec<Named>]) -> Self {
        let mut merged: Vec<Column> = Vec::new();
        for list in results {
            let mut at = 0;
            for named in list {
                match merged.iter().position(|column| column.name == named.name) {
                    Some(index) => at = index + 1,
                    None => {
                        let column = Column {
                            name: named.name.clone(),
                            kind: named.kind,
                        };
                        merged.insert(at, column);
                        at += 1;
                    }
                }
            }
        }
        let taken = |name: &str| {
            LEADING.contains(&name) || name == MOTION || merged.iter().any(|c| c.name == name)
        };
        let mut inputs: Vec<Column> = Vec::new();
        for factor in &file.factors {
            let mut name = input_name(&factor.name, &factor.unit);
            while taken(&name) || inputs.iter().any(|column| column.name == name) {
                name.insert_str(0, "input.");
            }
            let numeric = match &factor.values {
                jostle_io::FactorValues::Listed(levels) => {
                    levels.iter().all(|level| level.number.is_some())
                }
                jostle_io::FactorValues::Drawn(_) => true,
                jostle_io::FactorValues::Table(column) => column.is_numeric,
            };
            let kind = if numeric { Kind::Real } else { Kind::Text };
            inputs.push(Column { name, kind });
        }
        let places = merged.iter().enumerate();
        let places = places.map(|(index, column)| (column.name.clone(), index));
        Self {
            inputs,
            places: places.collect(),
            results: merged,
        }
    }

    /// Index of a result among the results.
    #[must_use]
    pub fn place(&self, name: &str) -> Option<usize> {
        self.places.get(name).copied()
    }

    /// Names of all columns, in order.
    #[must_use]
    pub fn names(&self) -> Vec<&str> {
        let columns = |columns: &'static [&'static str]| columns.iter().copied();
        let inputs = self.inputs.iter().map(|column| &column.name[..]);
        let results = self.results.iter().map(|column| &column.name[..]);
        columns(&LEADING)
            .chain(inputs)
            .chain(std::iter::once(MOTION))
            .chain(results)
            .collect()
    }

    /// Rows as columns: numbers of inputs and of results are in `numbers`, texts of inputs and the name of the
    /// motion in `texts`.
    #[must_use]
    pub fn columns(&self, rows: &[Row]) -> Vec<(String, Values)> {
        let whole = |value: Option<f64>| value.map(|value| value as i32);
        let text = |of: &dyn Fn(&Row) -> String| Values::Text(rows.iter().map(of).collect());
        let mut columns = vec![
            (
                "case".to_owned(),
                Values::Whole(
                    rows.iter()
                        .map(|row| i32::try_from(row.case).ok())
                        .collect(),
                ),
            ),
            ("status".into(), text(&|row| row.status.name().to_owned())),
            ("reason".into(), text(&|row| row.reason.clone())),
        ];
        let (mut number, mut word) = (0, 0);
        let motion = Column {
            name: MOTION.to_owned(),
            kind: Kind::Text,
        };
        let all = self.inputs.iter().chain(std::iter::once(&motion));
        for column in all.chain(&self.results) {
            let name = column.name.clone();
            let at = |row: &Row| row.numbers.get(number).copied().flatten();
            let values = match column.kind {
                Kind::Text => text(&|row| row.texts.get(word).cloned().unwrap_or_default()),
                Kind::Real => Values::Instant(rows.iter().map(at).collect()),
                Kind::Whole => Values::Whole(rows.iter().map(|row| whole(at(row))).collect()),
            };
            if column.kind == Kind::Text {
                word += 1;
            } else {
                number += 1;
            }
            columns.push((name, values));
        }
        columns
    }

    /// How many numbers a row has.
    #[must_use]
    pub fn count_numbers(&self) -> usize {
        let inputs = self
            .inputs
            .iter()
            .filter(|column| column.kind != Kind::Text);
        inputs.count() + self.results.len()
    }
}

/// `gap[0].width` in metres becomes `gap0.width_m`, `gap[*].width` becomes `gap.width_m`.
fn input_name(name: &str, unit: &str) -> String {
    let name = name.replace("[*]", "").replace(['[', ']'], "");
    let name: String = name
        .chars()
        .map(|c| {
            if c.is_whitespace() || c.is_control() || c == ',' || c == '"' {
                '_'
            } else {
                c
            }
        })
        .collect();
    if unit.is_empty() || name.ends_with(&format!("_{unit}")) {
        name
    } else {
        format!("{name}_{unit}")
    }
}
