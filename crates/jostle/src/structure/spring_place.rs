//! Places of the springs of a building that yield.

use crate::hysteresis::Side;

/// Which end of a member a hinge is at.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum MemberEnd {
    /// The lower end of a column, the left end of a beam.
    First,
    /// The upper end of a column, the right end of a beam.
    Last,
}

/// Where a spring that yields sits; floors, storeys, column lines and bays count from 1, from the ground up and from
/// the left.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum SpringPlace {
    /// At an end of a column.
    Column {
        /// Storey.
        storey: usize,
        /// Column line.
        line: usize,
        /// Which end.
        end: MemberEnd,
    },
    /// At an end of a beam.
    Beam {
        /// Floor.
        floor: usize,
        /// Bay.
        bay: usize,
        /// Which end.
        end: MemberEnd,
    },
    /// Shear of a column, at its end.
    Shear {
        /// Storey.
        storey: usize,
        /// Column line.
        line: usize,
        /// Which end.
        end: MemberEnd,
    },
    /// A whole storey of a shear building.
    Storey {
        /// Storey.
        storey: usize,
    },
    /// Between a column, or a whole shear building, and the ground.
    Base {
        /// Column line; 1 for a shear building.
        line: usize,
        /// Which way it gives.
        motion: BaseMotion,
    },
    /// The bearings of an isolated building, all together.
    Bearings,
    /// A stop of its mat.
    Stop {
        /// The direction of motion in which it is reached: right is positive.
        side: Side,
    },
}

impl SpringPlace {
    /// Whether it belongs to the isolation of a building rather than to its structure.
    #[must_use]
    pub fn is_isolation(&self) -> bool {
        matches!(self, Self::Bearings | Self::Stop { .. })
    }

    /// Whether it is the shear of a column, which fails rather than yields.
    #[must_use]
    pub fn is_shear(&self) -> bool {
        matches!(self, Self::Shear { .. })
    }
}

/// Which way a base gives.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum BaseMotion {
    /// It turns.
    Rocking,
    /// It moves sideways.
    Sliding,
}

impl std::fmt::Display for SpringPlace {
    fn fmt(&self, formatter: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        match self {
            Self::Column { storey, line, end } => {
                let end = match end {
                    MemberEnd::First => "foot",
                    MemberEnd::Last => "head",
                };
                write!(formatter, "column {line}, storey {storey}, {end}")
            }
            Self::Beam { floor, bay, end } => {
                let end = match end {
                    MemberEnd::First => "left",
                    MemberEnd::Last => "right",
                };
                write!(formatter, "beam {bay}, floor {floor}, {end}")
            }
            Self::Shear { storey, line, end } => {
                let end = match end {
                    MemberEnd::First => "foot",
                    MemberEnd::Last => "head",
                };
                write!(
                    formatter,
                    "column {line}, storey {storey}, shear at the {end}"
                )
            }
            Self::Storey { storey } => write!(formatter, "storey {storey}"),
            Self::Base { line, motion } => {
                let motion = match motion {
                    BaseMotion::Rocking => "rocking",
                    BaseMotion::Sliding => "sliding",
                };
                write!(formatter, "base {line}, {motion}")
            }
            Self::Bearings => formatter.write_str("bearings"),
            Self::Stop {
                side: Side::Positive,
            } => formatter.write_str("right stop"),
            Self::Stop {
                side: Side::Negative,
            } => formatter.write_str("left stop"),
        }
    }
}
