//! `[[link]]`: springs and dampers that join neighbours.

use jostle::{Building, FloorPairs, Link};

use super::between::{floors, neighbours, tolerance};
use crate::keys::Section;
use crate::quantity::Dimension;
use crate::reader::{Field, Reader};

/// Most links.
const MOST_LINKS: usize = 10_000;

/// Reads all links. Without buildings, names are unknown, and only the rest is checked.
pub(super) fn read_all(
    reader: &mut Reader<'_>,
    field: &Field<'_>,
    buildings: Option<&[Building]>,
) -> Vec<Link> {
    let Some(entries) = field.entries() else {
        let found = field.node.describe();
        *reader.bad(field, format!("expected a list of links, found {found}")) =
            Some("write [[link]] with double brackets; in JSON \"link\": [{ … }]".into());
        return Vec::new();
    };
    if entries.len() > MOST_LINKS {
        let count = entries.len();
        reader.bad(
            field,
            format!("at most {MOST_LINKS} links are possible, found {count}"),
        );
        return Vec::new();
    }
    entries
        .iter()
        .filter_map(|entry| read(reader, entry, buildings))
        .collect()
}

fn read(
    reader: &mut Reader<'_>,
    field: &Field<'_>,
    buildings: Option<&[Building]>,
) -> Option<Link> {
    let view = reader.open(field, &[Section::Link])?;
    let between = neighbours(reader, &view, buildings);
    let floors = floors(reader, &view);
    let level_tolerance = tolerance(reader, &view);
    let stiffness = reader.get(&view, "stiffness");
    let damping = reader.get(&view, "damping");
    if stiffness.is_none() && damping.is_none() {
        reader.missing(
            &view,
            "damping",
            "add damping = \"500 kN.s/m\" for a damper, stiffness = \"20 MN/m\" for a spring, or both",
        );
        return None;
    }
    let stiffness = stiffness.map(|field| reader.quantity(&field, Dimension::Stiffness));
    let damping = damping.map(|field| reader.quantity(&field, Dimension::Damping));
    Some(Link {
        between: between?,
        floors: floors.unwrap_or(FloorPairs::Common),
        level_tolerance,
        stiffness: stiffness.unwrap_or(Some(0.0))?,
        damping: damping.unwrap_or(Some(0.0))?,
    })
}
