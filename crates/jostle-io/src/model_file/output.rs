//! `[output]`: optional results.

use jostle::MemberRequest;

use crate::keys::Section;
use crate::reader::{Field, Reader};
use crate::tree::Value;

/// Reads which forces of columns and beams are asked for.
pub(super) fn read(reader: &mut Reader<'_>, field: &Field<'_>) -> MemberRequest {
    let Some(view) = reader.open(field, &[Section::Output]) else {
        return MemberRequest::default();
    };
    let Some(field) = reader.get(&view, "members") else {
        return MemberRequest::default();
    };
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
                &field,
                format!("expected true, false or a list of members such as [\"J1.column.2.3\"], found {found}"),
            );
            MemberRequest::default()
        }
    }
}
