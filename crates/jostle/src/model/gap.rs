//! Gaps between neighbours, and the points at which they can touch.

use crate::contact::ContactLaw;

/// The gap between two neighbours, or between the building at an end of the row and a rigid wall. A pair may have
/// several gaps, such as bumpers at some floors and bare concrete at others.
///
/// ```
/// use jostle::{ContactLaw, FloorPairs, Gap, LawKind, RestitutionIs};
///
/// let law = ContactLaw {
///     kind: LawKind::Hertz,
///     stiffness: 2e9,
///     restitution: 1.0,
///     restitution_is: RestitutionIs::Input,
/// };
/// let mut gap = Gap::after(0, 0.04, law); // 40 mm between the first building and the second
/// gap.widths = vec![0.04, 0.04, 2.0]; // the third contact is set back
/// gap.floors = FloorPairs::listed(&[(1, 1), (2, 2), (3, 3)]);
/// gap.set_width(0.05); // the smallest width; all others shift by the same amount
/// assert_eq!(gap.width(), 0.05);
/// assert!((gap.width_of(2) - 2.01).abs() < 1e-12);
/// ```
#[derive(Clone, Debug, PartialEq)]
pub struct Gap {
    /// Indices of the left and of the right building, the one after it; `None` is a rigid wall that moves with the
    /// ground, left of the first or right of the last building.
    pub between: [Option<usize>; 2],
    /// Widths at rest, ≥ 0: one between the edges of the buildings, to which the set-back of a face is added ([`Building::set_back`]), or one
    /// of each contact in the order of `floors`, from the lowest up if those are not listed \[m\].
    ///
    /// [`Building::set_back`]: crate::Building::set_back
    pub widths: Vec<f64>,
    /// Contact locations.
    pub floors: FloorPairs,
    /// Floors whose heights differ by no more than this can touch, > 0 \[m\].
    pub level_tolerance: f64,
    /// Contact law of every contact of this gap.
    pub law: ContactLaw,
    /// Impacts of one contact closer in time than this count as one, ≥ 0 \[s\].
    pub minimum_separation: f64,
    /// How plans of buildings in space touch; not used in one plane.
    pub in_plan: PlanContact,
}

/// How the plans of two buildings touch.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PlanContact {
    /// Lobatto points of every face, 2 to 9 \[–\].
    pub points: usize,
    /// Greatest distance of edges that can touch, > 0 \[m\].
    pub reach: f64,
    /// Whether the stiffness of the law is per metre of face rather than that of a whole face.
    pub per_length: bool,
    /// Coefficient of friction along faces, 0 ≤ μ < 1 \[–\].
    pub friction: f64,
    /// Stiffness of a whole face against sliding while it sticks, > 0; `None` for that of [`sticking_stiffness`] \[N/m\].
    ///
    /// [`sticking_stiffness`]: crate::sticking_stiffness
    pub tangential_stiffness: Option<f64>,
}

impl Default for PlanContact {
    fn default() -> Self {
        Self {
            points: 5,
            reach: 0.5,
            per_length: false,
            friction: 0.0,
            tangential_stiffness: None,
        }
    }
}

impl Gap {
    /// A gap of one width \[m\] between building `left` and the next, with contacts at floors of equal height.
    #[must_use]
    pub fn after(left: usize, width: f64, law: ContactLaw) -> Self {
        Self::between([Some(left), Some(left + 1)], width, law)
    }

    /// A gap of one width \[m\] between two neighbours, or a building and a wall, with contacts at common floors.
    #[must_use]
    pub fn between(between: [Option<usize>; 2], width: f64, law: ContactLaw) -> Self {
        Self {
            between,
            widths: vec![width],
            floors: FloorPairs::Common,
            level_tolerance: LEVEL_TOLERANCE,
            law,
            minimum_separation: 0.0,
            in_plan: PlanContact::default(),
        }
    }

    /// The least width \[m\].
    #[must_use]
    pub fn width(&self) -> f64 {
        self.widths.iter().copied().fold(f64::INFINITY, f64::min)
    }

    /// Width of the contact at this index of the list \[m\].
    #[must_use]
    pub fn width_of(&self, contact: usize) -> f64 {
        let only = self.widths.first().copied().unwrap_or(0.0);
        self.widths.get(contact).copied().unwrap_or(only)
    }

    /// Sets the smallest width \[m\]; all others shift by the same amount.
    pub fn set_width(&mut self, width: f64) {
        let least = self.width();
        for gap_width in &mut self.widths {
            *gap_width = width + (*gap_width - least);
        }
    }
}

/// Default tolerance for equal floor heights \[m\].
pub const LEVEL_TOLERANCE: f64 = 1e-3;

/// Points of two neighbours that can touch, or are joined.
///
/// ```
/// use jostle::{FloorPairs, Level};
///
/// let pairs = FloorPairs::Listed(vec![
///     [Level::Floor(4), Level::Floor(5)],
///     [Level::Floor(3), Level::Height(9.6)], // against a column
/// ]);
/// assert_ne!(pairs, FloorPairs::Common);
/// ```
#[derive(Clone, Debug, PartialEq)]
pub enum FloorPairs {
    /// Every pair of floors at equal height; all floors beside a wall.
    Common,
    /// Every floor of either building: against the floor of the other at that height, or against its column.
    All,
    /// Pairs of points, left and right.
    Listed(Vec<[Level; 2]>),
    /// Heights above the common datum, at floors or between them \[m\].
    Heights(Vec<f64>),
}

/// A point on a side of a building.
///
/// ```
/// use jostle::{FloorPairs, Level};
///
/// // Floor 4 against floor 5, and floor 3 against the column at 9.6 m.
/// let pairs = FloorPairs::Listed(vec![
///     [Level::Floor(4), Level::Floor(5)],
///     [Level::Floor(3), Level::Height(9.6)],
/// ]);
/// assert_ne!(pairs, FloorPairs::All);
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Level {
    /// A floor, counted from 1.
    Floor(usize),
    /// A height above the common datum, at a floor or at a column between floors \[m\].
    Height(f64),
    /// The wall, opposite the other point of the pair.
    Wall,
}

impl FloorPairs {
    /// Pairs (left floor, right floor), floors counted from 1.
    #[must_use]
    pub fn listed(pairs: &[(usize, usize)]) -> Self {
        let levels = pairs.iter();
        Self::Listed(
            levels
                .map(|&(left, right)| [Level::Floor(left), Level::Floor(right)])
                .collect(),
        )
    }
}
