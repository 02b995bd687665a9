//! Where a file's values stand, for faults that only come to light after reading.

use std::sync::Arc;

use crate::fault::{Fault, InputError};
use crate::source::{Source, Span};
use crate::tree::{Node, Value};

/// The text of a file and its tree, to point at its lines later.
#[derive(Clone, Debug)]
pub(crate) struct Origin {
    pub(crate) source: Arc<Source>,
    pub(crate) root: Node,
}

impl Origin {
    /// The value at a path, if it is there.
    pub(crate) fn at(&self, path: &str) -> Option<&Value> {
        let parts = path
            .split(['.', '['])
            .map(|part| part.trim_end_matches(']'));
        parts.into_iter().try_fold(&self.root.value, |value, part| {
            let node = match value {
                Value::Table(table) => table.get(part)?,
                Value::List(list) => list.get(part.parse::<usize>().ok()?)?,
                _ => return None,
            };
            Some(&node.value)
        })
    }

    /// A fault of the value at a path, at its line; of the file if the path is empty.
    pub(crate) fn fault(&self, path: &str, problem: impl Into<String>) -> InputError {
        let (span, path) = locate(&self.root, path);
        InputError {
            name: self.source.name.clone(),
            faults: vec![Fault {
                place: (span != (0..0)).then(|| self.source.place(&span)),
                path,
                problem: problem.into(),
                remedy: None,
            }],
            more: 0,
        }
    }
}

/// The position of a field in the file, and its path as written: a single value for a list has no index. A field
/// that is absent is shown at the table that lacks it.
pub(crate) fn locate(root: &Node, path: &str) -> (Span, String) {
    let mut node = root;
    let mut spelt = String::new();
    let parts = path
        .split(['.', '['])
        .map(|part| part.trim_end_matches(']'));
    let mut lost = false;
    for part in parts {
        match (&node.value, part.parse::<usize>()) {
            (Value::List(list), Ok(index)) if !lost => {
                // One gap may stand for several, of which it is the first.
                let last = list.len().saturating_sub(1);
                let index = if spelt == "gap" {
                    index.min(last)
                } else {
                    index
                };
                spelt = format!("{spelt}[{index}]");
                match list.get(index) {
                    Some(entry) => node = entry,
                    None => lost = true,
                }
            }
            (_, Ok(_)) => {}
            (Value::Table(table), Err(_)) if !lost => {
                spelt = crate::reader::join(&spelt, part);
                match table.get(part) {
                    Some(entry) => node = entry,
                    None => lost = true,
                }
            }
            (_, Err(_)) => {
                spelt = crate::reader::join(&spelt, part);
                lost = true;
            }
        }
    }
    (node.span.clone(), spelt)
}
