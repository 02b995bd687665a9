//! `[output]`: optional results.

use jostle::{Building, MemberRequest};

use super::floor_spectra::{self, FloorSpectraRequest};
use crate::keys::Section;
use crate::reader::{Field, Reader};
use crate::tree::Value;

/// Reads which forces of columns and beams, and which spectra of floors are asked for.
pub(super) fn read(
    reader: &mut Reader<'_>,
    field: &Field<'_>,
    buildings: Option<&[Building]>,
) -> (MemberRequest, Option<FloorSpectraRequest>) {
    let Some(view) = reader.open(field, &[Section::Output]) else {
        return Default::default();
    };
    let members = match reader.get(&view, "members") {
        Some(field) => read_members(reader, &field),
        None => MemberRequest::default(),
    };
    let spectra = reader.get(&view, "floor_spectra");
    let spectra = spectra.and_then(|field| floor_spectra::read(reader, &field, buildings));
    (members, spectra)
}

fn read_members(reader: &mut Reader<'_>, field: &Field<'_>) -> MemberRequest {
    match (&field.node.value, field.entries()) {
        (Value::Flag(envelopes), _) => MemberRequest {
            envelopes: *envelopes,
            histories: Vec::new(),
        },
        (_, Some(entries)) => MemberRequest {
            envelopes: true,
            histories: entries
                .iter()
                .filter_map(|entry| reader.text(entry))
                .collect(),
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
