//! Columns and beams whose forces are requested.

use super::capacity::MemberCapacity;

/// Which forces of columns and beams a run should give.
///
/// ```
/// use jostle::MemberRequest;
///
/// let request = MemberRequest::with_histories(&["J1.column.3.2"]);
/// assert!(request.envelopes); // the greatest forces of all members, too
/// ```
#[derive(Clone, Debug, Default, PartialEq)]
pub struct MemberRequest {
    /// Whether the greatest forces of all columns and beams of frames are asked for.
    pub envelopes: bool,
    /// Members whose forces are asked for over time as well: `J1.column.LINE.STOREY`, `J1.beam.FLOOR.SPAN`, counted
    /// from 1.
    pub histories: Vec<String>,
    /// Members whose demand is compared with their capacity; needs `envelopes`.
    pub capacities: Vec<MemberCapacity>,
    /// Beam–column joints whose shear is compared with their capacity; needs `envelopes`.
    pub joints: Vec<JointRequest>,
}

/// A beam–column joint whose shear is compared with its capacity.
#[derive(Clone, Debug, PartialEq)]
pub struct JointRequest {
    /// Index of the building.
    pub building: usize,
    /// Column line, counted from 1 at the left.
    pub line: usize,
    /// Floor, counted from 1.
    pub floor: usize,
    /// Half the depth of the column beyond its rigid zone: distance from where the forces of beams are followed to its faces, ≥ 0
    /// \[m\].
    pub half_depth: f64,
    /// Distance between the upper and the lower bars of the beams on the left and on the right; `None` for beams that are
    /// left out, > 0 \[m\].
    pub levers: [Option<f64>; 2],
    /// Its capacity in shear against the compression of the column above, by name `J1.joint.LINE.FLOOR`.
    pub capacity: MemberCapacity,
}

impl MemberRequest {
    /// The greatest forces of all members.
    #[must_use]
    pub fn all() -> Self {
        Self {
            envelopes: true,
            ..Self::default()
        }
    }

    /// The greatest forces of all members, and histories of these.
    #[must_use]
    pub fn with_histories(names: &[&str]) -> Self {
        Self {
            envelopes: true,
            histories: names.iter().map(|name| (*name).to_owned()).collect(),
            ..Self::default()
        }
    }
}
