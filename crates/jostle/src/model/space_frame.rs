//! Space frames: columns at the crossings of a grid of lines, beams along the lines, rigid floors.

use std::collections::BTreeMap;

use super::{ColumnFibres, Diagonal, DiagonalPlace, PlanAxis, PlanPoint, ShearSpring};
use crate::hysteresis::Hysteresis;

/// Columns and beams in space, tied together by rigid floors.
///
/// Every crossing of a line of `lines_x` with a line of `lines_y` that a member reaches is a joint at every floor. Joints rise and turn
/// about both horizontal axes by themselves, and share u_x, u_y and θ of their floor. They carry no mass. Members have 6 degrees of
/// freedom at each end and run from joint to joint; columns of the lowest storey are fixed at the base.
///
/// ```
/// use jostle::{SpaceFrame, SpaceMember, SpacePlace, SpaceSection};
///
/// // One storey, one bay each way.
/// let column = SpaceSection::rectangle([0.5, 0.5], 30e9, 0.2, false).expect("sizes above zero");
/// let beam = SpaceSection::beam([0.3, 0.6], 30e9, 0.2, false).expect("sizes above zero");
/// let corners = [[0, 0], [1, 0], [0, 1], [1, 1]];
/// let columns = corners.map(|line| (SpacePlace::Column { line, storey: 0 }, column));
/// let along = [0, 1].map(|y| (SpacePlace::BeamX { span: 0, line: y, floor: 0 }, beam));
/// let across = [0, 1].map(|x| (SpacePlace::BeamY { line: x, span: 0, floor: 0 }, beam));
/// let all = columns.into_iter().chain(along).chain(across);
/// let frame = SpaceFrame {
///     at: [0.0, 0.0],
///     direction: [1.0, 0.0],
///     lines_x: vec![0.0, 6.0],
///     lines_y: vec![0.0, 5.0],
///     members: all.map(|(place, section)| SpaceMember::elastic(place, section)).collect(),
///     ..SpaceFrame::default()
/// };
/// assert_eq!(frame.point([1, 1]), [6.0, 5.0]);
/// ```
///
/// The default has no lines and no members, so that the check refuses it; its axes are those of the site.
#[derive(Clone, Debug, PartialEq)]
pub struct SpaceFrame {
    /// Where the origin of the lines stands on the site \[m\].
    pub at: PlanPoint,
    /// Unit vector of the x axis of the lines on the site \[–\].
    pub direction: PlanPoint,
    /// Distances of the lines that run across, from the origin along x, rising \[m\].
    pub lines_x: Vec<f64>,
    /// Distances of the lines that run along x, from the origin across, rising \[m\].
    pub lines_y: Vec<f64>,
    /// Columns and beams, each place at most once.
    pub members: Vec<SpaceMember>,
    /// Columns whose ends are made of fibres; they have no hinges.
    pub fibres: BTreeMap<SpacePlace, ColumnFibres>,
    /// Shear of columns that can fail, in the vertical plane along x and in that across: each by itself, whatever the other bears.
    pub shear: BTreeMap<(SpacePlace, PlanAxis), ShearSpring>,
    /// Braces, and struts of infill panels, in the bays of its lines.
    pub diagonals: Vec<Diagonal>,
    /// Rigid zones of joints, by floor and by line of `lines_x` and of `lines_y`, from 0: how far from its axis beams along x, beams across,
    /// and columns below and above are rigid, ≥ 0; none where there is no entry \[m\].
    pub rigid_zones: BTreeMap<[usize; 3], [f64; 3]>,
    /// Walls: which of its columns they are, each storey of a wall once.
    pub walls: Vec<SpaceWall>,
    /// Weight of every floor that its columns carry in equal shares beyond that of its mass, and that does not sway; negative where
    /// others carry part of that. Empty for none \[N\].
    pub floor_load: Vec<f64>,
}

impl Default for SpaceFrame {
    fn default() -> Self {
        Self {
            at: [0.0, 0.0],
            direction: [1.0, 0.0],
            lines_x: Vec::new(),
            lines_y: Vec::new(),
            members: Vec::new(),
            fibres: BTreeMap::new(),
            shear: BTreeMap::new(),
            diagonals: Vec::new(),
            rigid_zones: BTreeMap::new(),
            walls: Vec::new(),
            floor_load: Vec::new(),
        }
    }
}

/// A wall of a space frame, whose sections are those of the columns at its axis; their rigid zones are its half length.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SpaceWall {
    /// Lines at whose crossing its axis stands, from 0.
    pub line: [usize; 2],
    /// Its first and its last storey, from 0.
    pub storeys: [usize; 2],
    /// Direction of its length.
    pub along: PlanAxis,
    /// Its length, > 0 \[m\].
    pub length: f64,
    /// Factors that its EI and its GA contain, for texts \[–\].
    pub stiffness_factors: [f64; 2],
}

impl SpaceWall {
    /// Its column in a storey, from 0.
    #[must_use]
    pub fn column(&self, storey: usize) -> SpacePlace {
        let line = self.line;
        SpacePlace::Column { line, storey }
    }

    /// Whether a column is a part of it.
    #[must_use]
    pub fn has(&self, place: SpacePlace) -> bool {
        let [first, last] = self.storeys;
        (first..=last).contains(&place.storey()) && place == self.column(place.storey())
    }
}

/// A column or a beam of a space frame.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SpaceMember {
    /// Where it is.
    pub place: SpacePlace,
    /// Its section.
    pub section: SpaceSection,
    /// Hinges at both of its ends, in rotation \[rad\] and moment \[N·m\], by plane of bending: in the vertical planes along x and
    /// across of a column, in the vertical plane of a beam; `None` stays elastic. A beam has no second one. Positive is tension at
    /// the bottom of a beam, and on the face of a column to greater x, or further across, at either end. The two planes of a column
    /// yield independently of each other and of its axial force, unlike [fibres](SpaceFrame::fibres).
    pub hinges: [Option<Hysteresis>; 2],
}

impl SpaceMember {
    /// A member without hinges.
    #[must_use]
    pub fn elastic(place: SpacePlace, section: SpaceSection) -> Self {
        Self {
            place,
            section,
            hinges: [None; 2],
        }
    }

    /// Whether it has a hinge.
    #[must_use]
    pub fn may_yield(&self) -> bool {
        self.hinges.iter().any(Option::is_some)
    }
}

/// Where a column or a beam is in the grid; all count from 0.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum SpacePlace {
    /// A column at the crossing of a line of `lines_x` with one of `lines_y`.
    Column {
        /// Both lines.
        line: [usize; 2],
        /// Storey, from the ground up.
        storey: usize,
    },
    /// A beam along x, from one line of `lines_x` to the next.
    BeamX {
        /// The line of `lines_x` at its left end.
        span: usize,
        /// Its line of `lines_y`.
        line: usize,
        /// Floor, from the ground up.
        floor: usize,
    },
    /// A beam across, from one line of `lines_y` to the next.
    BeamY {
        /// Its line of `lines_x`.
        line: usize,
        /// The line of `lines_y` at its lower end.
        span: usize,
        /// Floor, from the ground up.
        floor: usize,
    },
}

impl SpacePlace {
    /// Storey of a column; that below the floor of a beam.
    #[must_use]
    pub fn storey(self) -> usize {
        match self {
            Self::Column { storey, .. } => storey,
            Self::BeamX { floor, .. } | Self::BeamY { floor, .. } => floor,
        }
    }

    /// Crossings at both of its ends: lower and upper of a column, left and right, or lower and upper in plan, of a beam.
    #[must_use]
    pub fn crossings(self) -> [[usize; 2]; 2] {
        match self {
            Self::Column { line, .. } => [line; 2],
            Self::BeamX { span, line, .. } => [[span, line], [span + 1, line]],
            Self::BeamY { line, span, .. } => [[line, span], [line, span + 1]],
        }
    }
}

/// `column.X.Y.STOREY`, `beam_x.FLOOR.X.Y` or `beam_y.FLOOR.X.Y`, with the lines at which a beam begins; all count from 1.
impl std::fmt::Display for SpacePlace {
    fn fmt(&self, formatter: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        let [[x, y], _] = self.crossings();
        let (x, y, level) = (x + 1, y + 1, self.storey() + 1);
        match self {
            Self::Column { .. } => write!(formatter, "column.{x}.{y}.{level}"),
            Self::BeamX { .. } => write!(formatter, "beam_x.{level}.{x}.{y}"),
            Self::BeamY { .. } => write!(formatter, "beam_y.{level}.{x}.{y}"),
        }
    }
}

/// Cross-section of a member of a space frame.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SpaceSection {
    /// Along x and across of a column; width and depth of a beam. It is drawn; the rigidities decide \[m\].
    pub size: [f64; 2],
    /// EI, > 0: of a column for bending along x and across, of a beam for bending in the vertical plane and sideways. Rigid floors
    /// leave the last without effect \[N·m²\].
    pub flexural_rigidity: [f64; 2],
    /// GJ, > 0 \[N·m²\].
    pub torsional_rigidity: f64,
    /// EA, > 0; `None` keeps the length. Rigid floors leave that of beams without effect \[N\].
    pub axial_rigidity: Option<f64>,
    /// GA_s of the same two planes; `None` neglects shear deformation \[N\].
    pub shear_rigidity: Option<[f64; 2]>,
    /// Mass per length of a column, ≥ 0, which the floors at its ends include. Points between floors that can be struck, or that struts
    /// meet, carry their share of it instead of the floors \[kg/m\].
    pub line_mass: f64,
}

/// Share of a rectangle that resists shear \[–\].
const SHEAR_SHARE: f64 = 5.0 / 6.0;

impl SpaceSection {
    /// A rectangular column, its sizes along x and across, of a material with modulus E and Poisson's ratio ν; `shears`: whether shear
    /// deforms it. `None` unless sizes and E are greater than zero.
    ///
    /// J = a b³ (1/3 − 0.21 (b/a)(1 − b⁴/(12 a⁴))) with a ≥ b (R. J. Roark, Formulas for Stress and Strain), A_s = 5/6 A.
    #[must_use]
    pub fn rectangle(
        size: [f64; 2],
        modulus: f64,
        poisson_ratio: f64,
        shears: bool,
    ) -> Option<Self> {
        let usable = [size[0], size[1], modulus, 1.0 + poisson_ratio];
        if !usable.iter().all(|value| *value > 0.0) {
            return None;
        }
        let area = size[0] * size[1];
        let shear_modulus = modulus / (2.0 * (1.0 + poisson_ratio));
        let (a, b) = (size[0].max(size[1]), size[0].min(size[1]));
        let ratio = b / a;
        let torsion = a * b.powi(3) * (1.0 / 3.0 - 0.21 * ratio * (1.0 - ratio.powi(4) / 12.0));
        Some(Self {
            size,
            flexural_rigidity: size.map(|side| modulus * area * side * side / 12.0),
            torsional_rigidity: shear_modulus * torsion,
            axial_rigidity: Some(modulus * area),
            shear_rigidity: shears.then_some([SHEAR_SHARE * shear_modulus * area; 2]),
            line_mass: 0.0,
        })
    }

    /// A rectangular beam of some width and depth; see [`SpaceSection::rectangle`].
    #[must_use]
    pub fn beam(size: [f64; 2], modulus: f64, poisson_ratio: f64, shears: bool) -> Option<Self> {
        let [width, depth] = size;
        let rectangle = Self::rectangle([depth, width], modulus, poisson_ratio, shears)?;
        Some(Self { size, ..rectangle })
    }
}

impl SpaceFrame {
    /// Whether any member has a hinge or fibres, a column can fail in shear, or a diagonal yields or lifts off.
    #[must_use]
    pub fn may_yield(&self) -> bool {
        let mut diagonals = self.diagonals.iter();
        !self.fibres.is_empty()
            || !self.shear.is_empty()
            || self.members.iter().any(SpaceMember::may_yield)
            || diagonals.any(|diagonal| diagonal.hysteresis.is_some())
    }

    /// Whether a member ends at a crossing of lines at a floor, counted from 1; whether a column stands there, for floor 0.
    #[must_use]
    pub fn has_joint(&self, floor: usize, crossing: [usize; 2]) -> bool {
        let ends = |member: &SpaceMember| {
            let level = member.place.storey() + 1;
            let is_column = matches!(member.place, SpacePlace::Column { .. });
            let reaches = level == floor || (is_column && level == floor + 1);
            reaches && member.place.crossings().contains(&crossing)
        };
        self.members.iter().any(ends)
    }

    /// Bays of a line of its grid from 1, in that line's direction, and their widths \[m\].
    #[must_use]
    pub fn bays(&self, along: PlanAxis) -> Vec<f64> {
        let lines = [&self.lines_x, &self.lines_y][along.index()];
        lines.windows(2).map(|pair| pair[1] - pair[0]).collect()
    }

    /// Where the crossing of two lines stands on the site \[m\].
    #[must_use]
    pub fn point(&self, [x, y]: [usize; 2]) -> PlanPoint {
        self.on_site([self.lines_x[x], self.lines_y[y]])
    }

    /// A point in the axes of the lines, on the site \[m\].
    #[must_use]
    pub fn on_site(&self, [x, y]: PlanPoint) -> PlanPoint {
        let [c, s] = self.direction;
        [self.at[0] + c * x - s * y, self.at[1] + s * x + c * y]
    }

    /// A point of the site in the axes of the lines \[m\].
    #[must_use]
    pub fn from_site(&self, [x, y]: PlanPoint) -> PlanPoint {
        let [c, s] = self.direction;
        let (x, y) = (x - self.at[0], y - self.at[1]);
        [c * x + s * y, c * y - s * x]
    }

    /// How far the upper end of a diagonal lies from its lower one, along the lines x and y; `None` in no grid \[m\].
    #[must_use]
    pub fn run(&self, place: DiagonalPlace) -> Option<PlanPoint> {
        let [from, to] = place
            .crossings()?
            .map(|[x, y]| [self.lines_x[x], self.lines_y[y]]);
        Some([to[0] - from[0], to[1] - from[1]])
    }

    /// Length of a member between the axes of its joints, in a building with these storey heights \[m\].
    #[must_use]
    pub fn length(&self, place: SpacePlace, storey_heights: &[f64]) -> f64 {
        match place {
            SpacePlace::Column { storey, .. } => storey_heights[storey],
            SpacePlace::BeamX { span, .. } => self.lines_x[span + 1] - self.lines_x[span],
            SpacePlace::BeamY { span, .. } => self.lines_y[span + 1] - self.lines_y[span],
        }
    }

    /// Lengths of the rigid ends of a member inside its first and its last joint; feet on the ground have none \[m\].
    #[must_use]
    pub fn rigid_ends(&self, place: SpacePlace) -> [f64; 2] {
        let storey = place.storey();
        let (first, axis) = match place {
            SpacePlace::Column { .. } => (storey.checked_sub(1), 2),
            SpacePlace::BeamX { .. } => (Some(storey), 0),
            SpacePlace::BeamY { .. } => (Some(storey), 1),
        };
        let crossings = place.crossings();
        let rigid = |floor: Option<usize>, [x, y]: [usize; 2]| {
            let zone = floor.and_then(|floor| self.rigid_zones.get(&[floor, x, y]));
            zone.map_or(0.0, |zone| zone[axis])
        };
        [
            rigid(first, crossings[0]),
            rigid(Some(storey), crossings[1]),
        ]
    }

    /// Columns that struts meet between floors, and how far above the joint at the foot of the column, in a building with these storey
    /// heights \[m\].
    pub fn ends_of_struts(
        &self,
        storey_heights: &[f64],
    ) -> impl Iterator<Item = (SpacePlace, f64)> {
        self.diagonals.iter().flat_map(move |diagonal| {
            let storey = diagonal.place.storey.wrapping_sub(1);
            let height = storey_heights.get(storey).copied().unwrap_or(0.0);
            let [lower, upper] = diagonal.offsets;
            let crossings = diagonal.place.crossings().into_iter().flatten();
            let ends = crossings.zip([(lower, lower), (upper, height - upper)]);
            ends.filter(|(_, (offset, _))| *offset != 0.0)
                .map(move |(line, (_, above))| (SpacePlace::Column { line, storey }, above))
        })
    }

    /// Length of a member between its rigid ends \[m\].
    #[must_use]
    pub fn clear_length(&self, place: SpacePlace, storey_heights: &[f64]) -> f64 {
        let [first, last] = self.rigid_ends(place);
        self.length(place, storey_heights) - first - last
    }
}
