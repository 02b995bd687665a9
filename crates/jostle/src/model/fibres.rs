//! Ends of columns that are made of fibres.

use std::sync::Arc;

use super::PlanPoint;
use crate::hysteresis::Hysteresis;

/// Lengths at the ends of a column in which fibres stretch and bend together, so that what a section can bear follows its axial force
/// and, in space, its moment about the other axis: a hinge without length that also stretches.
///
/// The column keeps its full elastic length beside them. It must be able to change its length, or its axial force is not known.
///
/// ```
/// use std::sync::Arc;
/// use jostle::hysteresis::{ConcreteFall, Hysteresis};
/// use jostle::{ColumnFibres, Fibre};
///
/// // Ten layers of a section of 0.4 × 0.5 m, of concrete of 30 MPa, over a length of 0.4 m.
/// let (length, layer) = (0.4, 0.4 * 0.05);
/// let fall = ConcreteFall { residual: 0.2, ultimate: 6.0 };
/// let spring = Hysteresis::concrete(30e6 * layer, 0.002 * length, fall).expect("sound");
/// let fibre = |number: usize| Fibre { at: [-0.225 + 0.05 * number as f64, 0.0], spring };
/// let own = ColumnFibres { length, at_ends: [true, false], fibres: (0..10).map(fibre).collect::<Arc<[Fibre]>>() };
/// assert_eq!(own.fibres.len(), 10);
/// ```
#[derive(Clone, Debug, PartialEq)]
pub struct ColumnFibres {
    /// Length over which they share a deformation, > 0 \[m\]: strains are elongations over it.
    pub length: f64,
    /// Whether they stand at the foot, and at the head.
    pub at_ends: [bool; 2],
    /// The fibres of each end.
    pub fibres: Arc<[Fibre]>,
}

/// A part of the concrete, or bars.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Fibre {
    /// Distances from the axis of the column: to the right, or along x of a space frame, and across. A plane frame does not bend
    /// across and leaves the second without effect \[m\].
    pub at: PlanPoint,
    /// Its force over its elongation, positive in tension \[N, m\].
    pub spring: Hysteresis,
}
