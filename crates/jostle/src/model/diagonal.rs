//! Straight parts between joints of a frame that bear axial force alone: braces, and struts of infill panels.

use super::PlanAxis;
use crate::hysteresis::Hysteresis;

/// A brace, or a strut of an infill panel, between two joints of a frame: at opposite corners of a bay of a storey, or, of a brace in a
/// plane frame, farther apart.
///
/// ```
/// use jostle::{Diagonal, DiagonalKind, DiagonalPlace, Reach, Rise, StrutLine};
///
/// // A steel rod of 2000 mm² across a bay of 6 m and a storey of 3.5 m.
/// let length = 6.0_f64.hypot(3.5);
/// let rod = Diagonal {
///     place: DiagonalPlace { kind: DiagonalKind::Brace, line: None, storey: 1, bay: 1, rise: Rise::Right, reach: Reach::BAY, strut: StrutLine::Central },
///     stiffness: 210e9 * 2000e-6 / length,
///     hysteresis: None, // it stays elastic
///     offsets: [0.0; 2], // from joint to joint
///     across: None,
///     damage: None,
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
    /// How far its lower end lies above the joint there, and its upper end below the other joint, along the columns: both ≥ 0, at most a
    /// quarter of the storey \[m\].
    pub offsets: [f64; 2],
    /// What the panel of a strut bears across its plane, if that is compared; it has no part in the motion unless the panel falls.
    pub across: Option<PanelAcross>,
    /// How the panel of a strut is damaged, if that is judged; it has no part in the motion either.
    pub damage: Option<PanelDamage>,
}

/// Damage of an infill panel by the drift of its bay: how much its diagonal shortens, over the cosine of its angle and the storey height.
///
/// ```
/// // A panel 3 m high and 4 m long, whose diagonal of 5 m shortens by 16 mm: a drift of 0.67 %.
/// let panel = jostle::PanelDamage { drifts: [0.0018, 0.0046, 0.0105, 0.0188], drift_per_shortening: 5.0 / (4.0 * 3.0) };
/// assert_eq!(panel.state(panel.drift_per_shortening * 16e-3), 2);
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PanelDamage {
    /// Drifts at which the damage states 1 to 4 begin, > 0 and rising \[–\].
    pub drifts: [f64; 4],
    /// Drift over the shortening of the diagonal, > 0 \[1/m\].
    pub drift_per_shortening: f64,
}

impl PanelDamage {
    /// Drifts of four damage states of solid clay masonry by Sassun and others (2015).
    pub const SASSUN: [f64; 4] = [0.0018, 0.0046, 0.0105, 0.0188];

    /// Damage state under a drift, 0 to 4.
    #[must_use]
    pub fn state(&self, drift: f64) -> usize {
        self.drifts
            .iter()
            .filter(|candidate| drift >= **candidate)
            .count()
    }
}

/// What an infill panel bears across its plane.
///
/// ```
/// // 200 mm of masonry of 1400 kg/m³ that bears 5 kPa falls at an acceleration of 17.9 m/s².
/// let panel = jostle::PanelAcross { strength: 5e3, surface_mass: 0.2 * 1400.0, falls: false };
/// assert!((panel.ratio(17.9) - 1.0).abs() < 0.01);
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PanelAcross {
    /// Pressure that it bears, > 0 \[Pa\].
    pub strength: f64,
    /// Mass per area, > 0 \[kg/m²\].
    pub surface_mass: f64,
    /// Whether its struts leave the model once its inertia force has exceeded that.
    pub falls: bool,
}

impl PanelAcross {
    /// Acceleration at which its inertia force is what it bears \[m/s²\].
    #[must_use]
    pub fn limit(&self) -> f64 {
        self.strength / self.surface_mass
    }

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
    /// The grid line of a space frame to which its bay belongs, or on which its lower end lies; `None` in a plane frame.
    pub line: Option<GridLine>,
    /// Storey, the lowest that it crosses.
    pub storey: usize,
    /// Bay, the leftmost that it crosses; of one that crosses none the bay right of its line.
    pub bay: usize,
    /// Which way it rises.
    pub rise: Rise,
    /// How far it reaches from there.
    pub reach: Reach,
    /// Which of the parallel struts of a panel it is.
    pub strut: StrutLine,
}

/// How far a diagonal reaches.
///
/// ```
/// use jostle::{DiagonalKind, DiagonalPlace, Reach, Rise, StrutLine};
///
/// // From the foot of the first column line to floor 2 of the third.
/// let place = DiagonalPlace {
///     kind: DiagonalKind::Brace, line: None, storey: 1, bay: 1, rise: Rise::Right,
///     reach: Reach { storeys: 2, bays: 2, across: 0 }, strut: StrutLine::Central,
/// };
/// assert_eq!((place.floors(), place.lines()), ([0, 2], [0, 2]));
/// assert_eq!(place.to_string(), "brace.0.1.to.2.3");
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Reach {
    /// Storeys, ≥ 1; 1 of struts.
    pub storeys: usize,
    /// Bays along its line; 0 along a column line, 1 of struts.
    pub bays: usize,
    /// By how many lines of a grid its upper end lies further across than its lower one; 0 in a plane of the grid.
    pub across: isize,
}

impl Reach {
    /// From corner to corner of one bay of one storey.
    pub const BAY: Self = Self {
        storeys: 1,
        bays: 1,
        across: 0,
    };
}

/// Parallel struts of a panel, by where they end.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum StrutLine {
    /// From corner to corner; braces, and panels of one strut.
    #[default]
    Central,
    /// It meets the column at its lower end above the joint, and the joint at its upper end.
    Foot,
    /// It meets the joint at its lower end, and the column at its upper end below the joint.
    Head,
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
        let [lower, upper] = self.lines();
        let number = line.number.checked_add_signed(self.reach.across);
        let number = number.filter(|number| *number > 0)?;
        let upper_line = GridLine { number, ..line };
        Some([line.crossing(lower), upper_line.crossing(upper)])
    }

    /// Column lines of its lower and of its upper end, from 0; in a space frame lines that cross its own.
    #[must_use]
    pub fn lines(self) -> [usize; 2] {
        let (left, right) = (self.bay - 1, self.bay - 1 + self.reach.bays);
        match self.rise {
            Rise::Right => [left, right],
            Rise::Left => [right, left],
        }
    }

    /// Floors of its lower and of its upper end; 0 is the ground.
    #[must_use]
    pub fn floors(self) -> [usize; 2] {
        [self.storey - 1, self.storey - 1 + self.reach.storeys]
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

/// `brace.STOREY.BAY.RISE` in a plane frame, `brace_x.STOREY.X.Y.RISE` in a space frame, with the lines at which its bay begins; beyond one
/// bay of a storey `brace.FLOOR.LINE.to.FLOOR.LINE` and `brace.FLOOR.X.Y.to.FLOOR.X.Y`; all count from 1, and the ground is floor 0.
impl std::fmt::Display for DiagonalPlace {
    fn fmt(&self, formatter: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        let kind = self.kind.name();
        let rise = match self.strut {
            StrutLine::Central => self.rise.name().to_owned(),
            StrutLine::Foot => format!("{}.foot", self.rise.name()),
            StrutLine::Head => format!("{}.head", self.rise.name()),
        };
        let Some(line) = self.line else {
            if self.reach != Reach::BAY {
                let ([from, to], [low, high]) = (self.lines(), self.floors());
                return write!(formatter, "{kind}.{low}.{}.to.{high}.{}", from + 1, to + 1);
            }
            return write!(formatter, "{kind}.{}.{}.{rise}", self.storey, self.bay);
        };
        if self.reach != Reach::BAY
            && let Some([from, to]) = self.crossings()
        {
            let [low, high] = self.floors();
            let ([x, y], [to_x, to_y]) = (from.map(|line| line + 1), to.map(|line| line + 1));
            return write!(formatter, "{kind}.{low}.{x}.{y}.to.{high}.{to_x}.{to_y}");
        }
        let [x, y] = line.crossing(self.bay - 1).map(|crossing| crossing + 1);
        let along = line.along.name();
        write!(formatter, "{kind}_{along}.{}.{x}.{y}.{rise}", self.storey)
    }
}
