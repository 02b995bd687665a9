//! Plane frames standing at lines of a plan, tied together by rigid floors.

use std::collections::BTreeMap;

use super::cuts::halves_of_segments;
use super::{
    Base, Frame, FrameHinges, PlanArea, PlanColumn, PlanPoint, PointsOnColumns, Tier, Tiers,
};

/// Column lines closer than this stand at one point \[m\].
const SAME_POINT: f64 = 0.01;

/// Sines of angles below this count as zero: frames along x or across.
const PARALLEL: f64 = 1e-9;

/// A plane frame that stands at a line of a plan.
///
/// Its floors move as far along its line as the rigid floors of the building do: u = d · u(c), c being a point of the line and d its
/// direction. Everything between floors, and every joint, keeps displacements of its own. It has no stiffness out of its plane
/// (E. L. Wilson, H. H. Dovey, Three dimensional analysis of building systems: TABS, UCB/EERC 72-8, 1972).
///
/// ```
/// use jostle::{Axial, Base, Frame, FrameHinges, Joint, PlanFrame, Section};
///
/// let section = |width: f64, depth: f64| Section {
///     flexural_rigidity: 30e9 * width * depth.powi(3) / 12.0,
///     axial_rigidity: None,
///     shear_rigidity: None,
///     line_mass: 0.0, // the masses of the floors count all
/// };
/// let frame = PlanFrame {
///     name: "2".to_owned(),
///     at: [0.0, 6.0],
///     direction: [1.0, 0.0],
///     lines: vec![Some("A2".to_owned()), None, Some("C2".to_owned())],
///     base: Base::default(),
///     hinges: FrameHinges::default(), // elastic
///     frame: Frame {
///         storey_heights: vec![3.2; 2],
///         spans: vec![6.0, 5.0],
///         columns: vec![section(0.5, 0.5); 2],
///         beams: vec![section(0.3, 0.6); 2],
///         beam_mass: vec![0.0; 2],
///         floor_mass: vec![0.0; 2],
///         column_segments: 1,
///         beam_segments: vec![1, 1],
///         ..Frame::default()
///     },
/// };
/// assert_eq!(frame.line_at(2), [11.0, 6.0]);
/// ```
#[derive(Clone, Debug, PartialEq)]
pub struct PlanFrame {
    /// Name, unique among the frames of a building.
    pub name: String,
    /// Foot of its first column line on the site \[m\].
    pub at: PlanPoint,
    /// Unit vector along its line, from its first column line to its last \[–\].
    pub direction: PlanPoint,
    /// Names of its column lines, or none: lines of the same name in two frames are one column, whose axial forces add. Empty, or
    /// one entry per column line.
    pub lines: Vec<Option<String>>,
    /// Springs and dashpots under every column.
    pub base: Base,
    /// Hinges at the ends of columns and beams; empty lists are elastic.
    pub hinges: FrameHinges,
    /// Columns, beams and masses; its storeys are the lowest ones of the building.
    pub frame: Frame,
}

/// A column that belongs to two frames.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct SharedColumn {
    /// Its name.
    pub name: String,
    /// Frame and column line of both, from 0.
    pub lines: [[usize; 2]; 2],
}

/// A floor with everything that moves with it.
#[derive(Clone, Debug, PartialEq)]
pub struct LumpedFloor {
    /// Mass that moves with it in both directions, polar mass about the centre, centre and plan.
    pub tier: Tier,
    /// Mass that moves with it along x alone, and across alone: columns between floors in the frames of the other direction
    /// \[kg\].
    pub one_way: [f64; 2],
}

impl LumpedFloor {
    /// Mass that resists a push in the direction of a unit vector \[kg\].
    #[must_use]
    pub fn mass_along(&self, direction: PlanPoint) -> f64 {
        if self.one_way == [0.0; 2] {
            return self.tier.mass;
        }
        1.0 / self.inverse_mass(direction, direction)
    }

    /// Acceleration of the centre along one unit vector by a unit force along another, without rotation \[1/kg\].
    #[must_use]
    pub fn inverse_mass(&self, [x, y]: PlanPoint, [along_x, along_y]: PlanPoint) -> f64 {
        let masses = self.one_way.map(|extra| self.tier.mass + extra);
        x * along_x / masses[0] + y * along_y / masses[1]
    }
}

impl PlanFrame {
    /// Where a column line stands on the site, counted from 0 \[m\].
    #[must_use]
    pub fn line_at(&self, line: usize) -> PlanPoint {
        let along: f64 = self.frame.spans.iter().take(line).sum();
        self.point_at(along)
    }

    /// The point of its line at a distance from the first column line \[m\].
    #[must_use]
    pub fn point_at(&self, along: f64) -> PlanPoint {
        [0, 1].map(|axis| self.at[axis] + along * self.direction[axis])
    }

    /// Number of column lines.
    #[must_use]
    pub fn column_lines(&self) -> usize {
        self.frame.lines()
    }

    /// Whether columns have lumped masses between floors.
    #[must_use]
    pub fn has_masses_between_floors(&self) -> bool {
        let storeys = self.frame.storey_heights.len();
        let columns = self.frame.all_columns();
        let mut columns =
            columns.filter(|([storey, _], column)| *storey < storeys && column.line_mass > 0.0);
        columns.any(|(place, _)| {
            let cuts = self.frame.column_cuts(place, std::iter::empty());
            !cuts.is_empty()
        })
    }

    /// Whether columns, beams or walls may crack or yield, or diagonals yield or lift off.
    #[must_use]
    pub fn may_yield(&self) -> bool {
        self.hinges != FrameHinges::default() || self.frame.has_yielding_parts()
    }

    /// Whether it stands along x or across.
    #[must_use]
    pub fn is_along_an_axis(&self) -> bool {
        self.direction.iter().any(|part| part.abs() <= PARALLEL)
    }

    /// How far a displacement of a floor moves its line, the centre of the floor being at `centre`: along x, across, and by
    /// rotation.
    #[must_use]
    pub fn shares(&self, centre: PlanPoint) -> [f64; 3] {
        let [dx, dy] = self.direction.map(rounded);
        let arm = [self.at[0] - centre[0], self.at[1] - centre[1]];
        [dx, dy, arm[0] * dy - arm[1] * dx]
    }
}

/// A component of a direction; exactly zero along the axes.
fn rounded(part: f64) -> f64 {
    if part.abs() <= PARALLEL { 0.0 } else { part }
}

impl Tiers {
    /// Columns that two frames share by name, in the order of the frames.
    #[must_use]
    pub fn shared_columns(&self) -> Vec<SharedColumn> {
        let named: Vec<([usize; 2], &str)> = self
            .frames
            .iter()
            .enumerate()
            .flat_map(|(index, frame)| {
                let lines = frame.lines.iter().enumerate();
                lines.filter_map(move |(line, name)| Some(([index, line], name.as_deref()?)))
            })
            .collect();
        let mut shared = Vec::new();
        for (at, (place, name)) in named.iter().enumerate() {
            let first = named[..at].iter().find(|(_, other)| other == name);
            shared.extend(first.map(|(other, _)| SharedColumn {
                name: (*name).to_owned(),
                lines: [*other, *place],
            }));
        }
        shared
    }

    /// Whether the two column lines of a shared column stand at one point.
    #[must_use]
    pub fn stands_at_one_point(&self, column: &SharedColumn) -> bool {
        let [a, b] = column
            .lines
            .map(|[frame, line]| self.frames[frame].line_at(line));
        libm::hypot(a[0] - b[0], a[1] - b[1]) <= SAME_POINT
    }

    /// Floors with the masses of the frames. Their centres are those that leave no coupling between the masses.
    ///
    /// Joints and beams move with the floor in both directions. Columns between floors have displacements of their own in the
    /// plane of their frame; out of it they move with the two floors, in proportion to the distance from them. A column that two
    /// frames share counts once.
    #[must_use]
    pub fn lumped_floors(&self) -> Vec<LumpedFloor> {
        self.lumped_floors_with(&BTreeMap::new())
    }

    /// The same with points of columns that neighbours push, at these heights above the joints at their feet, and that move by themselves.
    pub(crate) fn lumped_floors_with(
        &self,
        struck: &BTreeMap<PlanColumn, Vec<f64>>,
    ) -> Vec<LumpedFloor> {
        let masses = self.level_masses(struck);
        let floors = self.floors.iter().zip(&masses[1..]);
        floors.map(|(floor, masses)| masses.on(floor)).collect()
    }

    /// A mat with the masses of the feet of frames that stand on it. As floors, they take half of the lowest segments of columns, and
    /// their share of what columns move out of the plane of their frame.
    pub(super) fn with_feet(
        &self,
        mat: &Tier,
        struck: &BTreeMap<PlanColumn, Vec<f64>>,
    ) -> LumpedFloor {
        self.level_masses(struck)[0].on(mat)
    }

    /// Point masses of frames on what they stand, then on every floor.
    fn level_masses(&self, struck: &BTreeMap<PlanColumn, Vec<f64>>) -> Vec<FloorMasses> {
        let shared = self.shared_columns();
        let mut masses = vec![FloorMasses::default(); 1 + self.floors.len()];
        for (index, frame) in self.frames.iter().enumerate() {
            let doubled = |line: usize| {
                let mut columns = shared.iter();
                columns.any(|column| column.lines[1] == [index, line])
            };
            let crossed = |line: usize| {
                let mut columns = shared.iter();
                columns.any(|column| column.lines.contains(&[index, line]))
            };
            let points = self.points_in_frame(struck, index);
            frame.add_masses(&mut masses, &points, doubled, crossed);
        }
        masses
    }

    /// Sum over the frames of a storey, counted from 0, of rᵀr, r being the motion of a line by a displacement of the floor, with
    /// torsion about `about` in units of `length`: positive definite if the frames hold the floor in every direction.
    #[must_use]
    pub fn held(&self, storey: usize, about: PlanPoint, length: f64) -> [[f64; 3]; 3] {
        let mut sum = [[0.0; 3]; 3];
        for frame in &self.frames {
            if storey >= frame.frame.storey_heights.len() {
                continue;
            }
            let [x, y, turn] = frame.shares(about);
            let row = [x, y, turn / length];
            for (i, a) in row.iter().enumerate() {
                for (j, b) in row.iter().enumerate() {
                    sum[i][j] += a * b;
                }
            }
        }
        sum
    }
}

/// Point masses that a floor or a mat carries: both ways, along x alone, across alone.
#[derive(Clone, Debug, Default)]
struct FloorMasses([Vec<(f64, PlanPoint)>; 3]);

/// Lists of [`FloorMasses`].
const BOTH_WAYS: usize = 0;

impl PlanFrame {
    /// Adds its lumped masses to those of the levels, the first of which is what it stands on. `points`: of its columns, that move by
    /// themselves; `doubled`: column lines that another frame counts; `crossed`: those that another frame holds out of the plane of this one.
    fn add_masses(
        &self,
        levels: &mut [FloorMasses],
        points: &PointsOnColumns,
        doubled: impl Fn(usize) -> bool,
        crossed: impl Fn(usize) -> bool,
    ) {
        let frame = &self.frame;
        let lines = frame.line_positions();
        // Out of the plane of a frame along x is across.
        let out_of_plane = if self.direction[0].abs() > self.direction[1].abs() {
            2
        } else {
            1
        };
        for storey in 0..frame.storey_heights.len().min(levels.len() - 1) {
            let (below, above) = (storey, storey + 1);
            let columns = frame.columns_in(storey);
            for (line, along) in lines.iter().enumerate() {
                let Some(column) = frame.column(storey, line) else {
                    continue;
                };
                // Rigid ends move with their joints; what is between them is lumped at the ends of its parts.
                let [foot, head] = frame.rigid_ends_of_column([storey, line]);
                let [foot_mass, head_mass] = [foot, head].map(|length| length * column.line_mass);
                let height = frame.storey_heights[storey];
                let column = column.line_mass * (height - foot - head);
                let points = points.get(&[storey, line]).into_iter().flatten();
                let cuts = frame.column_cuts([storey, line], points.map(|point| point.above));
                let halves = halves_of_segments(0.5 * column, &cuts);
                let at = self.point_at(*along);
                let mut add = |level: usize, kind: usize, mass: f64| {
                    if mass > 0.0 {
                        levels[level].0[kind].push((mass, at));
                    }
                };
                if !doubled(line) {
                    add(below, BOTH_WAYS, halves[0] + foot_mass);
                    add(above, BOTH_WAYS, halves[cuts.len()] + head_mass);
                }
                let floor_mass = frame.floor_mass.get(storey).copied();
                let joint = floor_mass.unwrap_or(0.0) / columns as f64;
                add(above, BOTH_WAYS, joint);
                if !crossed(line) {
                    for (share, mass) in cuts.iter().zip(halves.windows(2)) {
                        let share = share + (foot - share * (foot + head)) / height;
                        let mass = mass[0] + mass[1];
                        add(below, out_of_plane, (1.0 - share) * mass);
                        add(above, out_of_plane, share * mass);
                    }
                }
            }
            for (bay, span) in frame.spans.iter().enumerate() {
                if frame.beam(storey, bay).is_none() {
                    continue;
                }
                let segments = frame.beam_segments.get(bay).copied().unwrap_or(1).max(1);
                let mass = frame.beam_mass.get(storey).copied().unwrap_or(0.0) * span;
                for cut in 0..=segments {
                    let ends = if cut == 0 || cut == segments {
                        0.5
                    } else {
                        1.0
                    };
                    let along = lines[bay] + cut as f64 / segments as f64 * span;
                    let point_mass = ends * mass / segments as f64;
                    if point_mass > 0.0 {
                        levels[above].0[BOTH_WAYS].push((point_mass, self.point_at(along)));
                    }
                }
            }
        }
    }
}

impl FloorMasses {
    /// With the mass of the floor itself.
    fn on(&self, floor: &Tier) -> LumpedFloor {
        if self.0.iter().all(Vec::is_empty) {
            return LumpedFloor {
                tier: floor.clone(),
                one_way: [0.0; 2],
            };
        }
        let [both, along, across] = &self.0;
        let mass = floor.mass + both.iter().map(|(mass, _)| mass).sum::<f64>();
        let one_way = [along, across].map(|list| list.iter().map(|(mass, _)| mass).sum::<f64>());
        // What moves along x decides the centre across, and the other way round.
        let centre = [0, 1].map(|axis| {
            let moving = [across, along][axis];
            let points = both.iter().chain(moving.iter());
            let moment: f64 = points
                .map(|(mass, at)| mass * (at[axis] - floor.centre[axis]))
                .sum();
            floor.centre[axis] + moment / (mass + one_way[1 - axis])
        });
        let squared = |at: &PlanPoint, axis: usize| (at[axis] - centre[axis]).powi(2);
        let about = |list: &[(f64, PlanPoint)], axis: usize| -> f64 {
            list.iter().map(|(mass, at)| mass * squared(at, axis)).sum()
        };
        let polar_mass = floor.polar_mass
            + floor.mass * (squared(&floor.centre, 0) + squared(&floor.centre, 1))
            + about(both, 0)
            + about(both, 1)
            + about(along, 1)
            + about(across, 0);
        LumpedFloor {
            tier: Tier {
                mass,
                polar_mass,
                centre,
                plan: floor.plan.clone(),
            },
            one_way,
        }
    }
}

impl Tier {
    /// The floor with further masses at points, which move its centre and add to its polar mass \[kg, m\].
    #[must_use]
    pub fn with_masses(&self, points: &[(f64, PlanPoint)]) -> Self {
        FloorMasses([points.to_vec(), Vec::new(), Vec::new()])
            .on(self)
            .tier
    }

    /// A length of the size of its plan: the polar radius of gyration \[m\].
    #[must_use]
    pub fn plan_radius(&self) -> f64 {
        PlanArea::new(&self.plan).gyration().sqrt()
    }
}
