//! A tree of results as a list of paths and values, exact to the bit and short enough to be kept.

use std::collections::BTreeMap;

use serde_json::{Number, Value};

use super::digest::Bits;

/// Lists longer than this are recorded column by column.
const LONG: usize = 8;
/// Parts of a long list that have a digest each.
const PARTS: usize = 4;
/// Key of the digests of a column, part by part.
pub(super) const DIGESTS: &str = ".digests";

/// Paths with their values: numbers as the shortest decimals that give their bits back, texts in quotation marks.
pub(super) type Entries = Vec<(String, String)>;

/// Every number and text of a tree.
pub(super) fn entries(tree: &Value) -> Entries {
    let mut entries = Vec::new();
    add(&mut String::new(), tree, &mut entries);
    entries
}

fn add(path: &mut String, value: &Value, entries: &mut Entries) {
    let length = path.len();
    match value {
        Value::Object(map) => {
            for (key, value) in map {
                path.push('.');
                path.push_str(key);
                add(path, value, entries);
                path.truncate(length);
            }
        }
        Value::Array(list) if list.len() > LONG => add_long(path, list, entries),
        Value::Array(list) => {
            for (index, value) in list.iter().enumerate() {
                path.push_str(&format!("[{index}]"));
                add(path, value, entries);
                path.truncate(length);
            }
        }
        Value::Number(number) => entries.push((path.clone(), decimal(number))),
        Value::Bool(_) | Value::Null | Value::String(_) => {
            entries.push((path.clone(), value.to_string()));
        }
    }
}

/// A number as it is recorded; −0 as 0.
fn decimal(number: &Number) -> String {
    if number.as_f64() == Some(0.0) {
        "0".into()
    } else {
        number.to_string()
    }
}

/// Values at the same place of every entry of a long list.
#[derive(Default)]
struct ListColumn {
    parts: [Bits; PARTS],
    extremes: Option<[(f64, String); 2]>,
}

impl ListColumn {
    fn add(&mut self, index: usize, part: usize, value: String) {
        self.parts[part].text(&index.to_string());
        self.parts[part].text(&value);
        let Ok(number) = value.parse::<f64>() else {
            return;
        };
        let new = (number, value);
        let [least, greatest] = self
            .extremes
            .get_or_insert_with(|| [new.clone(), new.clone()]);
        if new.0 < least.0 {
            *least = new;
        } else if new.0 > greatest.0 {
            *greatest = new;
        }
    }
}

fn add_long(path: &str, list: &[Value], entries: &mut Entries) {
    let mut columns: BTreeMap<String, ListColumn> = BTreeMap::new();
    for (index, value) in list.iter().enumerate() {
        let mut found = Vec::new();
        add(&mut String::new(), value, &mut found);
        for (place, value) in found {
            let column = columns.entry(place).or_default();
            column.add(index, index * PARTS / list.len(), value);
        }
    }
    entries.push((format!("{path}.length"), list.len().to_string()));
    for (place, column) in columns {
        let path = format!("{path}[]{place}");
        let digests = column.parts.map(|part| part.short(2)).join(" ");
        entries.push((format!("{path}{DIGESTS}"), format!("\"{digests}\"")));
        if let Some([(_, least), (_, greatest)]) = column.extremes {
            entries.push((format!("{path}.least"), least));
            entries.push((format!("{path}.greatest"), greatest));
        }
    }
}
