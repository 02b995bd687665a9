//! `[[wall]]`: walls that gaps and links can name.

use jostle::Wall;

use super::plan;
use crate::keys::Section;
use crate::quantity::Dimension;
use crate::reader::{Field, Reader};

/// Most walls.
const MOST_WALLS: usize = 1000;

/// Reads all walls; `None` if their number is unknown.
pub(super) fn read_all(reader: &mut Reader<'_>, field: &Field<'_>) -> Option<Vec<Wall>> {
    let Some(entries) = field.entries() else {
        let found = field.node.describe();
        *reader.bad(field, format!("expected a list of walls, found {found}")) =
            Some("write [[wall]] with double brackets; in JSON \"wall\": [{ … }]".into());
        return None;
    };
    if entries.len() > MOST_WALLS {
        let count = entries.len();
        reader.bad(
            field,
            format!("at most {MOST_WALLS} walls are possible, found {count}"),
        );
        return None;
    }
    let walls: Vec<_> = entries.iter().map(|entry| read(reader, entry)).collect();
    walls.into_iter().collect()
}

fn read(reader: &mut Reader<'_>, field: &Field<'_>) -> Option<Wall> {
    let view = reader.open(field, &[Section::Wall])?;
    let name = match reader.get(&view, "name") {
        Some(field) => reader.text(&field),
        None => {
            reader.missing(&view, "name", "add name = \"moat\"");
            None
        }
    };
    let mut end = |key| {
        reader
            .get(&view, key)
            .map(|field| plan::pair(reader, &field))
    };
    let line = match [end("from"), end("to")] {
        [None, None] => None,
        [Some(from), Some(to)] => Some([from?, to?]),
        [from, _] => {
            let key = if from.is_some() { "to" } else { "from" };
            reader.missing(&view, key, format!("add {key} = [\"21 m\", \"0 m\"]"));
            return None;
        }
    };
    let mut quantity = |key, dimension| match reader.get(&view, key) {
        Some(field) => reader.quantity(&field, dimension).map(Some),
        None => Some(None),
    };
    let stiffness = quantity("stiffness", Dimension::Stiffness);
    let damping = quantity("damping", Dimension::Damping);
    let mass = quantity("mass", Dimension::Mass);
    Some(Wall {
        name: name?,
        stiffness: stiffness?,
        damping: damping?.unwrap_or(0.0),
        mass: mass?.unwrap_or(0.0),
        line,
    })
}
