//! `[output]`: what results hold beyond the usual.

use jostle::MemberRequest;

use super::capacity::{self, CapacityRequest};
use super::reinforced::ReinforcedMember;
use crate::keys::Section;
use crate::reader::{Field, Reader, View};
use crate::tree::Value;

/// Reads which forces of columns and beams are asked for, and the rules for their capacity. `members`: those that are
/// reinforced; `None` after faults.
pub(super) fn read(
    reader: &mut Reader<'_>,
    field: &Field<'_>,
    members: Option<&[ReinforcedMember]>,
) -> (MemberRequest, CapacityRequest) {
    let Some(view) = reader.open(field, &[Section::Output]) else {
        return Default::default();
    };
    let capacity = capacity::read(reader, &view);
    if let Some(field) = reader.get(&view, "capacity") {
        capacity::check(reader, &field, &capacity, members);
    }
    (read_members(reader, &view), capacity)
}

fn read_members(reader: &mut Reader<'_>, view: &View<'_>) -> MemberRequest {
    let Some(field) = reader.get(view, "members") else {
        return MemberRequest::default();
    };
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
                &field,
                format!("expected true, false or a list of members such as [\"J1.column.2.3\"], found {found}"),
            );
            MemberRequest::default()
        }
    }
}
