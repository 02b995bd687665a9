//! Straight parts between joints of a frame that bear axial force alone: braces, and struts of infill panels.

use super::PlanAxis;
use crate::hysteresis::Hysteresis;

/// A brace, or a strut of an infill panel, between two joints of a frame at opposite corners of a bay of a storey.
///
/// ```
/// use jostle::{Diagonal, DiagonalKind, DiagonalPlace, Rise};
///
/// // A steel rod of 2000 mm² across a bay of 6 m and a storey of 3.5 m.
/// let length = 6.0_f64.hypot(3.5);
/// let rod = Diagonal {
///     place: DiagonalPlace { kind: DiagonalKind::Brace, line: None, storey: 1, bay: 1, rise: Rise::Right },
///     stiffness: 210e9 * 2000e-6 / length,
///     hysteresis: None, // it stays elastic
///     across: None,
/// };
/// assert_eq!(rod.place.to_string(), "brace.1.1.up");
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Diagonal {
    /// What it is, and where.
    pub place: DiagonalPlace,
    /// Axial force per elongation, > 0 \[N/m\].
    pub stiffness: f64,
    /// Its force if it yields, positive in tension; its initial stiffness then takes the place of `stiffness`.
    pub hysteresis: Option<Hysteresis>,
    /// What the panel of a strut bears across its plane, if that is compared; it has no part in the motion.
    pub across: Option<PanelAcross>,
}

/// What an infill panel bears across its plane.
///
/// ```
/// // 200 mm of masonry of 1400 kg/m³ that bears 5 kPa falls at an acceleration of 17.9 m/s².
/// let panel = jostle::PanelAcross { strength: 5e3, surface_mass: 0.2 * 1400.0 };
/// assert!((panel.ratio(17.9) - 1.0).abs() < 0.01);
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PanelAcross {
    /// Pressure that it bears, > 0 \[Pa\].
    pub strength: f64,
    /// Mass per area, > 0 \[kg/m²\].
    pub surface_mass: f64,
}

impl PanelAcross {
    /// Inertia force under an acceleration \[m/s²\] over what the panel bears \[–\].
    #[must_use]
    pub fn ratio(&self, acceleration: f64) -> f64 {
        self.surface_mass * acceleration / self.strength
    }
}

/// What a diagonal is, and where; storeys and bays count from 1, from the ground up and from the left.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct DiagonalPlace {
    /// What it is.
    pub kind: DiagonalKind,
    /// The grid line of a space frame to which its bay belongs; `None` in a plane frame.
    pub line: Option<GridLine>,
    /// Storey.
    pub storey: usize,
    /// Bay.
    pub bay: usize,
    /// Which way it rises.
    pub rise: Rise,
}

/// A line of the grid of a space frame, with the bays between the lines that cross it.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct GridLine {
    /// Its direction.
    pub along: PlanAxis,
    /// Its number among the lines of that direction, from 1.
    pub number: usize,
}

/// What a diagonal is.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum DiagonalKind {
    /// A brace.
    Brace,
    /// A strut of an infill panel.
    Infill,
}

/// Which way a diagonal rises.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Rise {
    /// From the lower left to the upper right corner of its bay.
    Right,
    /// From the lower right to the upper left corner.
    Left,
}

impl DiagonalKind {
    /// Name in results.
    #[must_use]
    pub const fn name(self) -> &'static str {
        match self {
            Self::Brace => "brace",
            Self::Infill => "infill",
        }
    }
}

impl Rise {
    /// Both.
    pub const BOTH: [Self; 2] = [Self::Right, Self::Left];

    /// Name in model files and results: seen from left to right.
    #[must_use]
    pub const fn name(self) -> &'static str {
        match self {
            Self::Right => "up",
            Self::Left => "down",
        }
    }
}

impl DiagonalPlace {
    /// Crossings of the grid of a space frame at its lower and its upper end, from 0; `None` in a plane frame.
    #[must_use]
    pub fn crossings(self) -> Option<[[usize; 2]; 2]> {
        let line = self.line?;
        Some(self.lines().map(|own| line.crossing(own)))
    }

    /// Column lines of its lower and of its upper end, from 0; in a space frame lines that cross its own.
    #[must_use]
    pub fn lines(self) -> [usize; 2] {
        match self.rise {
            Rise::Right => [self.bay - 1, self.bay],
            Rise::Left => [self.bay, self.bay - 1],
        }
    }
}

impl GridLine {
    /// Where lines of `lines_x` and `lines_y` cross, of which one crosses this line; both counted from 0.
    #[must_use]
    pub fn crossing(self, line: usize) -> [usize; 2] {
        match self.along {
            PlanAxis::X => [line, self.number - 1],
            PlanAxis::Y => [self.number - 1, line],
        }
    }
}

/// `brace.STOREY.BAY.RISE` in a plane frame, `brace_x.STOREY.X.Y.RISE` in a space frame, with the lines at which its bay begins; all
/// count from 1.
impl std::fmt::Display for DiagonalPlace {
    fn fmt(&self, formatter: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        let (kind, rise) = (self.kind.name(), self.rise.name());
        let Some(line) = self.line else {
            return write!(formatter, "{kind}.{}.{}.{rise}", self.storey, self.bay);
        };
        let [x, y] = line.crossing(self.bay - 1).map(|own| own + 1);
        let along = line.along.name();
        write!(formatter, "{kind}_{along}.{}.{x}.{y}.{rise}", self.storey)
    }
}
