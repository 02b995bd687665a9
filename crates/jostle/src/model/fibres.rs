//! Ends of columns that are made of fibres.

use std::collections::BTreeMap;
use std::sync::Arc;

use serde::Serialize;

use super::PlanPoint;
use crate::hysteresis::{Hysteresis, Side};

/// Lengths at the ends of a column in which fibres stretch and bend together, so that what a section can bear follows its axial force
/// and, in space, its moment about the other axis: a hinge without length that also stretches.
///
/// The column keeps its full elastic length beside them. It must be able to change its length, or its axial force is not known.
///
/// ```
/// use std::sync::Arc;
/// use jostle::hysteresis::{ConcreteFall, Hysteresis};
/// use jostle::{ColumnFibres, Fibre, FibreLimit, FibreMaterial};
///
/// // Ten layers of a section of 0.4 × 0.5 m, of concrete of 30 MPa, over a length of 0.4 m.
/// let (length, layer) = (0.4, 0.4 * 0.05);
/// let fall = ConcreteFall { residual: 0.2, ultimate: 6.0 };
/// let spring = Hysteresis::concrete(30e6 * layer, 0.002 * length, fall).expect("sound");
/// let fibre = |number: usize| Fibre { at: [-0.225 + 0.05 * number as f64, 0.0], spring, material: FibreMaterial::Cover };
/// let own = ColumnFibres {
///     length,
///     at_ends: [true, false],
///     fibres: (0..10).map(fibre).collect::<Arc<[Fibre]>>(),
///     limits: [(FibreLimit::Spalling, 0.0033)].into(), // its cover spalls from then on
/// };
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
    /// Strains that are judged, each > 0; they have no part in the motion \[–\].
    pub limits: BTreeMap<FibreLimit, f64>,
}

/// A part of the concrete, or bars.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Fibre {
    /// Distances from the axis of the column: to the right, or along x of a space frame, and across. A plane frame does not bend
    /// across and leaves the second without effect \[m\].
    pub at: PlanPoint,
    /// Its force over its elongation, positive in tension \[N, m\].
    pub spring: Hysteresis,
    /// What it is made of, which says by which limits it is judged.
    pub material: FibreMaterial,
}

/// What a fibre is made of.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum FibreMaterial {
    /// Concrete that no ties confine: the cover, or all of a section without ties.
    Cover,
    /// Concrete within ties.
    Core,
    /// Bars.
    Bar,
}

/// What happens to a section at a strain of its fibres.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash, Serialize)]
#[serde(rename_all = "kebab-case")]
pub enum FibreLimit {
    /// The cover spalls, in compression.
    Spalling,
    /// The confined core is crushed, in compression.
    Crushing,
    /// Bars stretch so far that they buckle when the load turns back.
    Buckling,
    /// Bars break, in tension.
    Fracture,
}

impl FibreLimit {
    /// All, in the order in which they usually happen.
    pub const ALL: [Self; 4] = [
        Self::Spalling,
        Self::Crushing,
        Self::Buckling,
        Self::Fracture,
    ];

    /// Name in model files and results.
    #[must_use]
    pub const fn name(self) -> &'static str {
        match self {
            Self::Spalling => "spalling",
            Self::Crushing => "crushing",
            Self::Buckling => "buckling",
            Self::Fracture => "fracture",
        }
    }

    /// Of which fibres: bars in tension, concrete in compression.
    #[must_use]
    pub const fn material(self) -> FibreMaterial {
        match self {
            Self::Spalling => FibreMaterial::Cover,
            Self::Crushing => FibreMaterial::Core,
            Self::Buckling | Self::Fracture => FibreMaterial::Bar,
        }
    }

    /// On which side of a fibre it lies.
    #[must_use]
    pub const fn side(self) -> Side {
        match self.material() {
            FibreMaterial::Bar => Side::Positive,
            FibreMaterial::Cover | FibreMaterial::Core => Side::Negative,
        }
    }
}
