//! Columns that fail in shear.

use super::CapacityLine;
use crate::hysteresis::Hysteresis;

/// Shear of a column that can fail: a horizontal spring in series with it.
#[derive(Clone, Debug, PartialEq)]
pub struct ShearSpring {
    /// The spring, [`Hysteresis::failing`]: elastic to the shear strength, then falling \[m, N\].
    pub spring: Hysteresis,
    /// Where it stands.
    pub ends: ShearEnds,
    /// Strength against the greatest ductility of the hinges of the column so far, if that lowers it; empty if it does not
    /// \[N, –\].
    pub by_ductility: CapacityLine,
}

/// Ends of a column with a shear spring.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum ShearEnds {
    /// At the foot: the shear is the same along the column.
    #[default]
    Foot,
    /// At both ends: an impact between the floors makes the shear below it differ from that above.
    Both,
}
