//! Walls of plane frames, and the beams that couple them.

use std::collections::BTreeMap;

use super::{ColumnFibres, Diagonal, Frame, FramePlace, Section};
use crate::hysteresis::Hysteresis;

/// A wall of a plane frame: it takes the place of a column line over some storeys, and beams meet its faces instead of its axis.
///
/// Its sections are columns of the frame ([`Frame::column`]). What is rigid is its cross-section: a floor there turns with the wall,
/// so that its faces rise and sink.
///
/// ```
/// use std::collections::BTreeMap;
/// use jostle::{Frame, FrameWall, Section};
///
/// // A wall of 250 mm × 3 m, E = 30 GPa, between two columns.
/// let (modulus, thickness, length) = (30e9, 0.25, 3.0_f64);
/// let section = Section {
///     flexural_rigidity: modulus * thickness * length.powi(3) / 12.0,
///     axial_rigidity: Some(modulus * thickness * length),
///     shear_rigidity: Some(5.0 / 6.0 * modulus / 2.4 * thickness * length),
///     line_mass: 2500.0 * thickness * length,
/// };
/// let wall = FrameWall {
///     line: 2,
///     storeys: [1, 4],
///     length,
///     hinges: Vec::new(),
///     fibres: BTreeMap::new(),
///     shear: None,
///     stiffness_factors: [1.0; 2],
/// };
/// let mut frame = Frame { spans: vec![6.0, 6.0], walls: vec![wall], ..Frame::default() };
/// frame.own_columns.extend((0..4).map(|storey| ([storey, 1], Some(section))));
/// assert_eq!(frame.clear_span([2, 0]), 6.0 - 1.5);
/// ```
#[derive(Clone, Debug, PartialEq)]
pub struct FrameWall {
    /// Column line of its axis, from 1.
    pub line: usize,
    /// Its first and its last storey, from 1.
    pub storeys: [usize; 2],
    /// Length along the frame, > 0 \[m\].
    pub length: f64,
    /// Hinges, if it yields in bending.
    pub hinges: Vec<WallHinge>,
    /// Ends of its storeys that are made of fibres, by storey from 1. They have no hinge in `hinges`.
    pub fibres: BTreeMap<usize, ColumnFibres>,
    /// Shear of its lowest storey, if that yields: force over sliding, positive where the wall slides to the right. Its initial
    /// stiffness takes the place of the shear rigidity of the section there \[N, m\].
    pub shear: Option<Hysteresis>,
    /// What its sections have of EI and of GA of the whole cross-section, > 0; for reports \[–\].
    pub stiffness_factors: [f64; 2],
}

/// A hinge of a wall.
///
/// ```
/// use jostle::WallHinge;
/// use jostle::hysteresis::{Backbone, Corners, Hysteresis, HysteresisRule};
///
/// let corners = Corners::bilinear(5e6, 0.02); // N·m
/// let backbone = Backbone::from_forces(60e9, corners, corners).expect("sound");
/// let hysteresis = Hysteresis::new(HysteresisRule::Bilinear, backbone).expect("sound");
/// let at_foot = WallHinge { storey: 1, at_head: false, hysteresis };
/// assert_eq!(at_foot.hysteresis.backbone().yield_force(), 5e6);
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct WallHinge {
    /// Its storey, from 1: one of those of the wall.
    pub storey: usize,
    /// Whether it is at the head of the storey, below its floor; otherwise at its foot.
    pub at_head: bool,
    /// Moment over rotation, positive where the right face is stretched \[N·m, rad\].
    pub hysteresis: Hysteresis,
}

impl FrameWall {
    /// The law of its hinge at the head or the foot of a storey, from 1; `None` where it is elastic.
    #[must_use]
    pub fn hinge_at(&self, storey: usize, at_head: bool) -> Option<Hysteresis> {
        let mut all = self.hinges.iter();
        let hinge = all.find(|hinge| hinge.storey == storey && hinge.at_head == at_head)?;
        Some(hinge.hysteresis)
    }
}

/// A beam between two walls of a plane frame. Its section is a beam of the frame ([`Frame::beam`]).
///
/// ```
/// let elastic = jostle::CouplingBeam { floor: 3, bay: 1, shear: None, stiffness_factors: [1.0; 2] };
/// assert!(elastic.shear.is_none());
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct CouplingBeam {
    /// Floor, from 1.
    pub floor: usize,
    /// Bay, from 1.
    pub bay: usize,
    /// Shear, if it yields: force over sliding, positive where the left wall pushes the beam up. Its initial stiffness takes the place
    /// of the shear rigidity of the section \[N, m\].
    pub shear: Option<Hysteresis>,
    /// What its section has of EI and of GA of the whole cross-section, > 0; for reports \[–\].
    pub stiffness_factors: [f64; 2],
}

impl Frame {
    /// The wall in a storey at a column line, both counted from 0.
    #[must_use]
    pub fn wall(&self, [storey, line]: FramePlace) -> Option<&FrameWall> {
        let stands = |wall: &&FrameWall| {
            wall.line == line + 1 && (wall.storeys[0]..=wall.storeys[1]).contains(&(storey + 1))
        };
        self.walls.iter().find(stands)
    }

    /// The coupling beam at a floor in a bay, both counted from 0.
    #[must_use]
    pub fn coupling_beam(&self, [floor, bay]: FramePlace) -> Option<&CouplingBeam> {
        let mut all = self.coupling_beams.iter();
        all.find(|coupling_beam| coupling_beam.floor == floor + 1 && coupling_beam.bay == bay + 1)
    }

    /// Section of the column in a storey at a line, both counted from 0; `None` where there is none, or a wall.
    #[must_use]
    pub fn bare_column(&self, storey: usize, line: usize) -> Option<&Section> {
        let column = self.column(storey, line);
        column.filter(|_| self.wall([storey, line]).is_none())
    }

    /// Section of the beam at a floor in a bay, both counted from 0; `None` where there is none, or a coupling beam.
    #[must_use]
    pub fn bare_beam(&self, floor: usize, bay: usize) -> Option<&Section> {
        let beam = self.beam(floor, bay);
        beam.filter(|_| self.coupling_beam([floor, bay]).is_none())
    }

    /// Number of columns without storeys of walls, and of beams without coupling beams.
    #[must_use]
    pub fn bare_members(&self) -> [usize; 2] {
        let columns = self.all_columns();
        let bare = columns.filter(|(place, _)| self.wall(*place).is_none());
        let beams = self.all_beams();
        let beams = beams.filter(|(place, _)| self.coupling_beam(*place).is_none());
        [bare.count(), beams.count()]
    }

    /// Distance from a column line, counted from 0, to where beams of a floor, counted from 0, begin to bend: half the length of the longer
    /// wall below and above; of a column, that of its [`Frame::rigid_zone`] \[m\].
    #[must_use]
    pub fn arm(&self, [floor, line]: FramePlace) -> f64 {
        let walls = [floor, floor + 1].map(|storey| self.wall([storey, line]));
        let lengths = walls.into_iter().flatten().map(|wall| wall.length);
        (0.5 * lengths.fold(0.0, f64::max)).max(self.rigid_zone([floor, line])[0])
    }

    /// Rigid zone of the joint at a floor and a line, both counted from 0: how far from the axes beams on either side, and columns
    /// below and above, are rigid \[m\].
    #[must_use]
    pub fn rigid_zone(&self, place: FramePlace) -> [f64; 2] {
        let stated = self.rigid_zones.get(&place);
        stated.copied().unwrap_or_default()
    }

    /// Lengths of the rigid ends of the column in a storey at a line, both counted from 0, at its foot and at its head; walls and feet on
    /// the ground have none \[m\].
    #[must_use]
    pub fn rigid_ends_of_column(&self, [storey, line]: FramePlace) -> [f64; 2] {
        if self.wall([storey, line]).is_some() {
            return [0.0; 2];
        }
        let foot = storey
            .checked_sub(1)
            .map(|floor| self.rigid_zone([floor, line])[1]);
        [foot.unwrap_or(0.0), self.rigid_zone([storey, line])[1]]
    }

    /// Length over which the column in a storey at a line, both counted from 0, bends \[m\].
    #[must_use]
    pub fn clear_height(&self, [storey, line]: FramePlace) -> f64 {
        let ends = self.rigid_ends_of_column([storey, line]);
        self.storey_heights[storey] - ends[0] - ends[1]
    }

    /// Heights above its lower joint at which struts meet the column in a storey at a line, both counted from 0 \[m\].
    pub(crate) fn ends_of_struts(
        &self,
        [storey, line]: FramePlace,
    ) -> impl Iterator<Item = f64> + '_ {
        let height = self.storey_heights[storey];
        let in_storey = move |diagonal: &&Diagonal| diagonal.place.storey == storey + 1;
        let ends = self
            .diagonals
            .iter()
            .filter(in_storey)
            .flat_map(move |diagonal| {
                let [lower, upper] = diagonal.place.lines();
                let [above, below] = diagonal.offsets;
                [(lower, above), (upper, height - below)]
            });
        let inside = move |(at, above): (usize, f64)| {
            (at == line && above > 0.0 && above < height).then_some(above)
        };
        ends.filter_map(inside)
    }

    /// Length over which the beam at a floor in a bay, both counted from 0, bends: between walls or the rigid zones of joints \[m\].
    #[must_use]
    pub fn clear_span(&self, [floor, bay]: FramePlace) -> f64 {
        self.spans[bay] - self.arm([floor, bay]) - self.arm([floor, bay + 1])
    }

    /// Whether walls or coupling beams yield.
    #[must_use]
    pub fn walls_yield(&self) -> bool {
        let yields = |wall: &FrameWall| {
            !wall.hinges.is_empty() || !wall.fibres.is_empty() || wall.shear.is_some()
        };
        self.walls.iter().any(yields)
            || self
                .coupling_beams
                .iter()
                .any(|coupling_beam| coupling_beam.shear.is_some())
    }

    /// Whether braces, struts, walls or coupling beams yield or lift off.
    #[must_use]
    pub fn has_yielding_parts(&self) -> bool {
        let mut diagonals = self.diagonals.iter();
        diagonals.any(|diagonal| diagonal.hysteresis.is_some()) || self.walls_yield()
    }
}
