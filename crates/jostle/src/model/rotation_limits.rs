//! Rotations of hinges at which members reach levels of performance, as the user states them.

use std::collections::BTreeMap;

use serde::Serialize;

use super::RotationMeasure;

/// A level of performance of a member.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash, Serialize)]
pub enum RotationLevel {
    /// Immediate occupancy.
    #[serde(rename = "IO")]
    ImmediateOccupancy,
    /// Life safety.
    #[serde(rename = "LS")]
    LifeSafety,
    /// Collapse prevention.
    #[serde(rename = "CP")]
    CollapsePrevention,
}

impl RotationLevel {
    /// All, in rising order.
    pub const ALL: [Self; 3] = [
        Self::ImmediateOccupancy,
        Self::LifeSafety,
        Self::CollapsePrevention,
    ];

    /// `IO`, `LS` or `CP`.
    #[must_use]
    pub const fn name(self) -> &'static str {
        match self {
            Self::ImmediateOccupancy => "IO",
            Self::LifeSafety => "LS",
            Self::CollapsePrevention => "CP",
        }
    }
}

/// Members of a building by their kind.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum LimitedMembers {
    /// Columns and walls.
    Columns,
    /// Beams, in space along both directions.
    Beams,
}

/// Limits of the rotations of hinges of some members. Where several name a hinge, the last one holds.
///
/// ```
/// use jostle::model::{LimitedMembers, RotationLevel, RotationLimit, RotationMeasure};
///
/// let columns = RotationLimit {
///     of: LimitedMembers::Columns,
///     lines: None,
///     storeys: Some([1, 2]),
///     measure: RotationMeasure::Plastic,
///     limits: [(RotationLevel::ImmediateOccupancy, 5e-3), (RotationLevel::LifeSafety, 15e-3)].into(),
/// };
/// assert!(columns.holds_for(LimitedMembers::Columns, 3, 2));
/// assert!(!columns.holds_for(LimitedMembers::Columns, 3, 4));
/// ```
#[derive(Clone, Debug, PartialEq)]
pub struct RotationLimit {
    /// Which kind.
    pub of: LimitedMembers,
    /// First and last column line, or bay, of plane frames, from 1; `None` are all. Space frames have none.
    pub lines: Option<[usize; 2]>,
    /// First and last storey of columns, or floor of beams, from 1; `None` are all.
    pub storeys: Option<[usize; 2]>,
    /// Which rotation.
    pub measure: RotationMeasure,
    /// Greatest rotation of each level, > 0 and rising \[rad\].
    pub limits: BTreeMap<RotationLevel, f64>,
}

impl RotationLimit {
    /// Whether it holds for a member of a kind at a line or bay, and in a storey or at a floor, from 1; line 0 has no number.
    #[must_use]
    pub fn holds_for(&self, of: LimitedMembers, line: usize, storey: usize) -> bool {
        let within = |range: Option<[usize; 2]>, at: usize| {
            range.is_none_or(|[first, last]| (first..=last).contains(&at))
        };
        self.of == of && within(self.lines, line) && within(self.storeys, storey)
    }
}
