//! The end of the edge that a corner touches.

use super::PortPair;

/// How far a corner is inside of an end of the edge that it can touch: where this falls to zero, the corner slides off.
///
/// Of two corners that pass each other it is the indentation along the other of their two normals.
#[derive(Clone, Debug, PartialEq)]
pub struct EdgeEnd {
    /// Index of the contact.
    pub contact: usize,
    /// Displacements in the direction that leads further inside.
    pub ports: PortPair,
    /// Distance from the end at rest; negative where the corner is beyond it \[m\].
    pub inside: f64,
}
