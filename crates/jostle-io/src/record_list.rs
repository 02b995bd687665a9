//! `record = ["a", "b.AT2"]`: several records of one model, one to a run, with their components across and vertical.

use crate::tree::{Node, Value};

/// The records that a model file lists; empty if it names one, or none.
pub(crate) fn listed(root: &Node) -> Vec<String> {
    let Value::Table(table) = &root.value else {
        return Vec::new();
    };
    let Some(Value::Table(motion)) = table.get("motion").map(|node| &node.value) else {
        return Vec::new();
    };
    let Some(Value::List(entries)) = motion.get("record").map(|node| &node.value) else {
        return Vec::new();
    };
    let name = |node: &Node| match &node.value {
        Value::Text(name) => Some(name.clone()),
        _ => None,
    };
    // The reader of the model reports anything that is not a name.
    entries
        .iter()
        .map(name)
        .collect::<Option<_>>()
        .unwrap_or_default()
}

/// Puts an entry of the list in its place, so that faults show the line of that entry; likewise of lists of motions across and
/// vertical.
pub(crate) fn keep(root: &mut Node, index: usize) {
    let Some(motion) = child(root, "motion") else {
        return;
    };
    for key in COMPONENTS {
        let Some(mut component) = child(motion, key) else {
            continue;
        };
        if matches!(component.value, Value::Table(_)) {
            let Some(record) = child(component, "record") else {
                continue;
            };
            component = record;
        }
        let entry = match &component.value {
            Value::List(entries) => entries.get(index).cloned(),
            _ => None,
        };
        if let Some(entry) = entry {
            *component = entry;
        }
    }
}

/// Keys of `[motion]` that may have an entry for each record.
const COMPONENTS: [&str; 4] = ["record", "across", "vertical", "scale"];

fn child<'n>(node: &'n mut Node, key: &str) -> Option<&'n mut Node> {
    let Value::Table(table) = &mut node.value else {
        return None;
    };
    let mut entries = table.entries.iter_mut();
    entries
        .find(|entry| entry.key == key)
        .map(|entry| &mut entry.node)
}
