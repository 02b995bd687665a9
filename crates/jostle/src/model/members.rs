//! Columns and beams whose forces are requested.

/// Which forces of columns and beams a run should give.
///
/// ```
/// use jostle::MemberRequest;
///
/// let request = MemberRequest::with_histories(&["J1.column.3.2"]);
/// assert!(request.envelopes); // the greatest forces of all members, too
/// ```
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct MemberRequest {
    /// Whether the greatest forces of all columns and beams of frames are asked for.
    pub envelopes: bool,
    /// Members whose forces are asked for over time as well: `J1.column.LINE.STOREY`, `J1.beam.FLOOR.SPAN`, counted
    /// from 1.
    pub histories: Vec<String>,
}

impl MemberRequest {
    /// The greatest forces of all members.
    #[must_use]
    pub fn all() -> Self {
        Self {
            envelopes: true,
            histories: Vec::new(),
        }
    }

    /// The greatest forces of all members, and histories of these.
    #[must_use]
    pub fn with_histories(names: &[&str]) -> Self {
        Self {
            envelopes: true,
            histories: names.iter().map(|name| (*name).to_owned()).collect(),
        }
    }
}
