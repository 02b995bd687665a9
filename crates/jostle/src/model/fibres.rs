//! Ends of columns that are made of fibres.

use std::collections::BTreeMap;
use std::sync::Arc;

use serde::Serialize;

use super::PlanPoint;
use crate::hysteresis::{Hysteresis, Side, SpringFault, Surface, stated_in_space};

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

impl ColumnFibres {
    /// Ends whose axial force and moment are bounded by a surface instead: their fibres are the three rows of
    /// [`Hysteresis::surface`], of which two stand at its radius from the axis.
    ///
    /// ```
    /// use jostle::ColumnFibres;
    ///
    /// // EA and EI over a length of 0.4 m; axial forces, positive in tension, and moments.
    /// let stiffness = [7.5e9 / 0.4, 156e6 / 0.4];
    /// let corners = [[-6e6, 0.0], [-2e6, 0.5e6], [1.2e6, 0.0]];
    /// let own = ColumnFibres::on_surface(0.4, [true, true], stiffness, &corners, 0.01).expect("sound");
    /// assert!(own.is_surface());
    /// ```
    ///
    /// # Errors
    /// Those of [`Hysteresis::surface`].
    pub fn on_surface(
        length: f64,
        at_ends: [bool; 2],
        stiffness: [f64; 2],
        corners: &[[f64; 2]],
        post_yield: f64,
    ) -> Result<Self, Vec<SpringFault>> {
        let (rows, radius) = Hysteresis::surface(stiffness, corners, post_yield)?;
        let places = [radius, -radius, 0.0];
        let fibre = |(spring, at)| Fibre {
            at: [at, 0.0],
            spring,
            material: FibreMaterial::Section,
        };
        Ok(Self {
            length,
            at_ends,
            fibres: rows.into_iter().zip(places).map(fibre).collect(),
            limits: BTreeMap::new(),
        })
    }

    /// The same of a column in space, whose axial force and both moments are bounded together: its fibres are the six rows of
    /// [`Hysteresis::surface_in_space`], of which three stand about the axis.
    ///
    /// ```
    /// use jostle::ColumnFibres;
    ///
    /// let stiffness = [7.5e9 / 0.4, 156e6 / 0.4, 100e6 / 0.4];
    /// let along = [[-6e6, 0.0], [-2e6, 0.5e6], [1.2e6, 0.0]];
    /// let across = [[-6e6, 0.0], [-2e6, 0.4e6], [1.2e6, 0.0]];
    /// let own = ColumnFibres::on_surface_in_space(0.4, [true, true], stiffness, [&along, &across], 1.5, 0.01);
    /// assert_eq!(own.expect("sound").corners().len(), 2);
    /// ```
    ///
    /// # Errors
    /// Those of [`Hysteresis::surface_in_space`].
    pub fn on_surface_in_space(
        length: f64,
        at_ends: [bool; 2],
        stiffness: [f64; 3],
        corners: [&[[f64; 2]]; 2],
        exponent: f64,
        post_yield: f64,
    ) -> Result<Self, Vec<SpringFault>> {
        let (rows, points) =
            Hysteresis::surface_in_space(stiffness, corners, exponent, post_yield)?;
        let places = points.into_iter().chain([[0.0; 2]; 3]);
        let fibre = |(spring, at)| Fibre {
            at,
            spring,
            material: FibreMaterial::Section,
        };
        Ok(Self {
            length,
            at_ends,
            fibres: rows.into_iter().zip(places).map(fibre).collect(),
            limits: BTreeMap::new(),
        })
    }

    /// Axial forces, positive in tension, and moments at the corners of its surface, in space of both planes of bending; empty for fibres
    /// \[N, N·m\].
    #[must_use]
    pub fn corners(&self) -> Vec<Vec<[f64; 2]>> {
        let springs = self.fibres.iter().map(|fibre| &fibre.spring);
        if let [x, y, between] = &self.fibres[..] {
            let rows = [x, y, between].map(|fibre| &fibre.spring);
            let stated = Surface::of(rows).map(|law| law.stated(x.at[0]));
            return stated.into_iter().collect();
        }
        let points = [0, 1].map(|point| self.fibres.get(point).map_or([0.0; 2], |own| own.at));
        stated_in_space(springs, points).map_or_else(Vec::new, Vec::from)
    }

    /// Whether a surface bounds its axial force and moment.
    #[must_use]
    pub fn is_surface(&self) -> bool {
        let first = self.fibres.first();
        first.is_some_and(|first| first.spring.is_on_surface())
    }
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
    /// The whole section, which yields on a surface.
    Section,
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
            FibreMaterial::Cover | FibreMaterial::Core | FibreMaterial::Section => Side::Negative,
        }
    }
}
