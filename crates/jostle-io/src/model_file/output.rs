//! `[output]`: optional results.

use jostle::{Building, MemberRequest};

use super::capacity::{self, CapacityRequest};
use super::floor_spectra::{self, FloorSpectraRequest};
use super::reinforced::KnownMembers;
use crate::keys::{Section, UNIT_SYSTEMS};
use crate::quantity::Dimension;
use crate::reader::{Field, Reader};
use crate::shown::Units;
use crate::tree::Value;

/// Reads which forces of columns and beams, which spectra of floors and which capacities are asked for. `read`: buildings
/// and their members of known strength; `None` after faults.
pub(super) fn read(
    reader: &mut Reader<'_>,
    field: &Field<'_>,
    read: Option<(&[Building], &KnownMembers)>,
) -> (MemberRequest, Option<FloorSpectraRequest>, CapacityRequest) {
    let Some(view) = reader.open(field, &[Section::Output]) else {
        return Default::default();
    };
    let members = match reader.get(&view, "members") {
        Some(field) => read_members(reader, &field),
        None => MemberRequest::default(),
    };
    let spectra = reader.get(&view, "floor_spectra").and_then(|field| {
        floor_spectra::read(reader, &field, read.map(|(buildings, _)| buildings))
    });
    let capacity = capacity::read(reader, &view);
    if let Some(field) = reader.get(&view, "capacity") {
        capacity::check(reader, &field, &capacity, read.map(|(_, members)| members));
    }
    (members, spectra, capacity)
}

/// Whether strokes and speeds of links are asked for.
pub(super) fn link_motion(reader: &mut Reader<'_>, field: &Field<'_>) -> bool {
    let view = reader.reopen(field, &[Section::Output]);
    let links = view.and_then(|view| reader.get(&view, "links"));
    links.is_some_and(|field| reader.flag(&field).unwrap_or(false))
}

/// The system of units that texts and pages are asked for in.
pub(super) fn units(reader: &mut Reader<'_>, field: &Field<'_>) -> Option<Units> {
    let view = reader.reopen(field, &[Section::Output])?;
    let field = reader.get(&view, "units")?;
    let word = reader.choice(&field, UNIT_SYSTEMS, &[])?;
    Units::named(word)
}

/// Time between rows of histories \[s\], if it is given.
pub(super) fn interval(reader: &mut Reader<'_>, field: &Field<'_>) -> Option<f64> {
    let view = reader.reopen(field, &[Section::Output])?;
    let field = reader.get(&view, "interval")?;
    let interval = reader.quantity(&field, Dimension::Time)?;
    if interval < 0.0 {
        reader.bad(&field, format!("must not be negative, found {interval} s"));
        return None;
    }
    Some(interval)
}

fn read_members(reader: &mut Reader<'_>, field: &Field<'_>) -> MemberRequest {
    match (&field.node.value, field.entries()) {
        (Value::Flag(envelopes), _) => MemberRequest {
            envelopes: *envelopes,
            ..MemberRequest::default()
        },
        (_, Some(entries)) => MemberRequest {
            envelopes: true,
            histories: entries
                .iter()
                .filter_map(|entry| reader.text(entry))
                .collect(),
            ..MemberRequest::default()
        },
        _ => {
            let found = field.node.describe();
            reader.bad(
                field,
                format!("expected true, false or a list of members such as [\"J1.column.2.3\"], found {found}"),
            );
            MemberRequest::default()
        }
    }
}
