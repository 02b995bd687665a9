//! Space frames: the displacements of joints eliminated, so that motions of the floors remain.
//!
//! Joints carry no mass, so that K_jj u_j + K_jf u_f = 0 at all times: u_j = R u_f, R = −K_jj⁻¹ K_jf. Every deformation d of a member
//! then follows from u_f alone, d = (B_f + B_j R) u_f = D u_f, and K = Σ Dᵀ k D over all members. D has no rigid motions, and an error
//! of R counts twice in K, by its square. Forces of members are k D u_f.

use super::column_points::ColumnPoints;
use crate::linear::envelope::Envelope;
use crate::linear::{Row, sort_by_key};
use crate::model::{
    DiagonalPlace, LEVEL_TOLERANCE, LumpedFloor, PlanPoint, SpaceFrame, SpaceMember, SpacePlace,
    SpaceSection,
};

/// A space frame over the motions of the mat or the base under it, if there is one, and of its floors: u_x, u_y and θ of each at its
/// centre of mass, from the ground up.
#[derive(Clone, Debug, PartialEq)]
pub struct CondensedFrame {
    /// The nodes of these motions.
    pub nodes: Vec<usize>,
    /// Its columns and beams, in the order of the model.
    pub members: Vec<CondensedMember>,
    /// Displacements of every joint over those of the floors.
    pub joints: Vec<CondensedJoint>,
}

/// How a joint moves by itself with the floors.
#[derive(Clone, Debug, PartialEq)]
pub struct CondensedJoint {
    /// Lines at whose crossing it is, from 0.
    pub crossing: [usize; 2],
    /// Floor, from 0.
    pub floor: usize,
    /// Rise, and rotations about the axes of the lines along x and across, per motion of every floor \[m, rad\].
    pub rows: [Vec<f64>; 3],
}

/// Forces of a member per motion of the floors.
#[derive(Clone, Debug, PartialEq)]
pub struct CondensedMember {
    /// Where it is.
    pub place: SpacePlace,
    /// Heights of its ends above the base \[m\].
    pub heights: [f64; 2],
    /// Axial force, positive in tension; zero for beams, which rigid floors hold.
    pub axial: Vec<f64>,
    /// Torque, positive where it turns the last end counter-clockwise against the first, seen from the last end.
    pub torsion: Vec<f64>,
    /// Bending in the vertical plane along x of a column, in that of a beam.
    pub bending: Bending,
    /// Bending of a column in the vertical plane across; `None` for beams.
    pub across: Option<Bending>,
}

/// Shear and end moments of a member in one plane, per motion of the floors.
///
/// Shear is positive where the lower or left part pushes the other one back (column) or up (beam). A moment is positive where it
/// stretches the bottom of a beam, or the face of a column that looks to greater x, or further across.
#[derive(Clone, Debug, PartialEq)]
pub struct Bending {
    /// Shear.
    pub shear: Vec<f64>,
    /// Moments at the first and the last end.
    pub moments: [Vec<f64>; 2],
}

/// The lower triangle of the condensed stiffness, row by row.
pub(super) type LowerTriangle = Vec<Vec<f64>>;

/// A displacement on which a deformation depends.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Unknown {
    Joint(usize),
    Floor(usize),
    /// Rise or rotation of an end of a member beyond a hinge or fibres, about an axis of the lines.
    End(usize),
    /// Of a point of a column, by its number: displacements along the lines x and y, rise, and rotations about the same axes.
    Point(usize, usize),
    /// Rocking of the base along or across the lines, as a displacement of floors per height, and its rise.
    Rocking(usize),
}

/// A deformation as a sum of displacements.
pub(super) type Deformation = Vec<(Unknown, f64)>;

/// Displacements of one end of a member.
#[derive(Clone, Debug, Default)]
struct End {
    /// Along the lines x and y, and upwards.
    moved: [Deformation; 3],
    /// About the same axes.
    turned: [Deformation; 3],
}

/// Numbers of the displacements that a joint has by itself: rise and two rotations.
type JointUnknowns = [Option<usize>; 3];

/// The same that an end of a member has beyond hinges or fibres, and how far it slides along the lines x and y; `None` moves with its joint.
pub(super) type EndUnknowns = [Option<usize>; 5];

impl End {
    /// A point of the rigid body of the same end, so far from it: u + ω × r.
    fn at(mut self, arm: [f64; 3]) -> Self {
        for axis in 0..3 {
            let [next, last] = [(axis + 1) % 3, (axis + 2) % 3];
            for (share, about) in [(arm[last], next), (-arm[next], last)] {
                if share != 0.0 {
                    add(&mut self.moved[axis], share, &self.turned[about]);
                }
            }
        }
        self
    }

    /// The end beyond hinges or fibres. `sign`: of what it slides, positive where what is above moves further than what is below.
    fn beyond(mut self, unknowns: EndUnknowns, sign: f64) -> Self {
        let [about_x, about_y, _] = &mut self.turned;
        for (to, unknown) in [&mut self.moved[2], about_x, about_y]
            .into_iter()
            .zip(unknowns)
        {
            if let Some(number) = unknown {
                *to = vec![(Unknown::End(number), 1.0)];
            }
        }
        for (to, slid) in self.moved.iter_mut().zip(&unknowns[3..]) {
            to.extend(slid.map(|number| (Unknown::End(number), sign)));
        }
        self
    }
}

/// The unknowns of all joints.
pub(super) struct Joints {
    /// By floor, then by crossing; `None` where no member reaches it.
    pub(super) unknowns: Vec<Option<JointUnknowns>>,
    pub(super) count: usize,
    /// Crossings of a floor.
    pub(super) per_floor: usize,
    lines_x: usize,
}

impl Joints {
    /// Numbers them floor by floor, along the shorter side of the grid, so that what they couple stays close. A joint above a
    /// column that keeps its length rises with the one below.
    pub(super) fn new(frame: &SpaceFrame, floors: usize) -> Self {
        let (lines_x, lines_y) = (frame.lines_x.len(), frame.lines_y.len());
        let per_floor = lines_x * lines_y;
        let place = |[x, y]: [usize; 2]| y * lines_x + x;
        let mut reached = vec![false; floors * per_floor];
        let mut rigid = vec![false; floors * per_floor];
        for member in &frame.members {
            let storey = member.place.storey();
            let is_column = matches!(member.place, SpacePlace::Column { .. });
            for crossing in member.place.crossings() {
                let joint_index = storey * per_floor + place(crossing);
                reached[joint_index] = true;
                if is_column {
                    if let Some(below) = joint_index.checked_sub(per_floor) {
                        reached[below] = true;
                    }
                    rigid[joint_index] = member.section.axial_rigidity.is_none();
                }
            }
        }
        let mut order: Vec<usize> = (0..per_floor).collect();
        if lines_x > lines_y {
            sort_by_key(&mut order, |crossing| {
                (crossing % lines_x, crossing / lines_x)
            });
        }
        let mut unknowns: Vec<Option<JointUnknowns>> = vec![None; floors * per_floor];
        let mut count = 0;
        for floor in 0..floors {
            for crossing in &order {
                let joint_index = floor * per_floor + crossing;
                if !reached[joint_index] {
                    continue;
                }
                let mut next = || {
                    count += 1;
                    Some(count - 1)
                };
                let rise = match (rigid[joint_index], joint_index.checked_sub(per_floor)) {
                    (false, _) => next(),
                    (true, Some(below)) => unknowns[below].and_then(|joint| joint[0]),
                    (true, None) => None,
                };
                unknowns[joint_index] = Some([rise, next(), next()]);
            }
        }
        Self {
            unknowns,
            count,
            per_floor,
            lines_x,
        }
    }

    pub(super) fn at(&self, floor: usize, [x, y]: [usize; 2]) -> JointUnknowns {
        self.unknowns[floor * self.per_floor + y * self.lines_x + x].unwrap_or_default()
    }
}

/// One stiffness of a member, over one deformation or two that bend together.
enum Spring {
    Single(f64, Deformation),
    /// k_11 = k_22, k_12.
    Bending([f64; 2], [Deformation; 2]),
}

/// Direction of the deflection in a plane of bending, axis of rotation, and sign of the slope that a rotation about it is.
pub(super) type Plane = (usize, usize, f64);

/// A member as springs.
pub(super) struct SpringMember {
    pub(super) torsion: (f64, Deformation),
    /// Upwards, or from its first end to its last.
    pub(super) parts: Vec<SpringPart>,
}

/// A part of a member between points that move by themselves; the whole of most.
pub(super) struct SpringPart {
    pub(super) length: f64,
    pub(super) axial: Option<(f64, Deformation)>,
    pub(super) bending: ([f64; 2], [Deformation; 2]),
    pub(super) across: Option<([f64; 2], [Deformation; 2])>,
}

impl SpringMember {
    fn springs(&self) -> impl Iterator<Item = Spring> + '_ {
        let single = |(k, d): &(f64, Deformation)| Spring::Single(*k, d.clone());
        let bending = |(k, d): &([f64; 2], [Deformation; 2])| Spring::Bending(*k, d.clone());
        let axial = self
            .parts
            .iter()
            .filter_map(move |part| part.axial.as_ref());
        let bent = self.parts.iter().flat_map(move |part| {
            std::iter::once(bending(&part.bending)).chain(part.across.iter().map(bending))
        });
        axial
            .map(single)
            .chain(std::iter::once(single(&self.torsion)))
            .chain(bent)
    }
}

/// (4 + φ) EI/((1 + φ) l) and (2 − φ) EI/((1 + φ) l), φ = 12 EI/(GA_s l²): end moments per rotation of both ends against the chord
/// (J. S. Przemieniecki, Theory of Matrix Structural Analysis, section 5.6).
fn bending_stiffness(section: &SpaceSection, plane: usize, length: f64) -> [f64; 2] {
    let rigidity = section.flexural_rigidity[plane];
    let phi = section.shear_rigidity.map_or(0.0, |shear| {
        12.0 * rigidity / (shear[plane] * length * length)
    });
    let unit = rigidity / ((1.0 + phi) * length);
    [(4.0 + phi) * unit, (2.0 - phi) * unit]
}

/// Adds a share of displacements.
fn add(to: &mut Deformation, share: f64, of: &Deformation) {
    to.extend(of.iter().map(|(unknown, value)| (*unknown, share * value)));
}

/// The difference of two, times a factor.
fn difference(factor: f64, last: &Deformation, first: &Deformation) -> Deformation {
    let mut deformation = Deformation::new();
    add(&mut deformation, factor, last);
    add(&mut deformation, -factor, first);
    deformation
}

/// Rotation of one end against the chord: `slope` times its rotation, minus the difference of displacements over the length.
fn chord_rotation(slope: f64, turned: &Deformation, chord: &Deformation) -> Deformation {
    let mut deformation = Deformation::new();
    add(&mut deformation, slope, turned);
    add(&mut deformation, -1.0, chord);
    deformation
}

/// The frame between the ground or a mat and floors with these centres \[m\].
pub(super) struct Assembly<'a> {
    pub(super) frame: &'a SpaceFrame,
    pub(super) heights: &'a [f64],
    /// Centres of mass of all that moves in the axes of the lines, the mat first.
    centres: Vec<PlanPoint>,
    /// Whether the first of them is a mat.
    on_mat: bool,
    /// The point about which the mat rocks, if it does.
    rocks_about: Option<(PlanPoint, bool)>,
    pub(super) joints: Joints,
    /// Points of columns that move by themselves.
    pub(super) points: ColumnPoints,
}

/// The planes in which a member bends between joints: those along x and across of a column, that of a beam.
pub(super) fn planes(place: SpacePlace) -> &'static [Plane] {
    match place {
        SpacePlace::Column { .. } => &[(0, 1, 1.0), (1, 0, -1.0)],
        SpacePlace::BeamX { .. } => &[(2, 1, -1.0)],
        SpacePlace::BeamY { .. } => &[(2, 0, 1.0)],
    }
}

impl<'a> Assembly<'a> {
    pub(super) fn new(
        frame: &'a SpaceFrame,
        storey_heights: &'a [f64],
        mat: Option<&LumpedFloor>,
        lumped: &[LumpedFloor],
    ) -> Self {
        let centres = mat.into_iter().chain(lumped);
        let centres = centres.map(|floor| frame.from_site(floor.tier.centre));
        Self {
            frame,
            heights: storey_heights,
            centres: centres.collect(),
            on_mat: mat.is_some(),
            rocks_about: None,
            joints: Joints::new(frame, lumped.len()),
            points: ColumnPoints::default(),
        }
    }

    /// The same with points of columns that move by themselves.
    pub(super) fn with_points(self, points: ColumnPoints) -> Self {
        Self { points, ..self }
    }

    /// The same on a mat that rocks about a point of the site.
    pub(super) fn rocking_about(mut self, base: Option<(PlanPoint, bool)>) -> Self {
        self.rocks_about = base.map(|(point, rises)| (self.frame.from_site(point), rises));
        self
    }

    /// How the rocking of the mat raises and turns what stands on it at a crossing; nothing if it does not rock.
    pub(super) fn rocked(&self, crossing: [usize; 2]) -> [Deformation; 3] {
        let Some((middle, rises)) = self.rocks_about else {
            return [const { Deformation::new() }; 3];
        };
        let x = self.frame.lines_x[crossing[0]] - middle[0];
        let y = self.frame.lines_y[crossing[1]] - middle[1];
        let [along, across, rise] = [0, 1, 2].map(Unknown::Rocking);
        let mut raised = vec![(along, -x), (across, -y)];
        raised.extend(rises.then_some((rise, 1.0)));
        [raised, vec![(across, -1.0)], vec![(along, 1.0)]]
    }

    /// Centre of mass of a floor in the axes of the lines \[m\].
    pub(super) fn centre_of_floor(&self, floor: usize) -> PlanPoint {
        self.centres[floor + usize::from(self.on_mat)]
    }

    /// Place of a floor among all that moves; what is below the floors is `None`, and does not move without a mat.
    pub(super) fn moving(&self, floor: Option<usize>) -> Option<usize> {
        match floor {
            Some(floor) => Some(floor + usize::from(self.on_mat)),
            None => self.on_mat.then_some(0),
        }
    }

    /// Displacements of a joint; what is below the floors is `None`. A mat holds the feet of columns as the ground does, but moves and
    /// turns about its vertical axis.
    fn end(&self, floor: Option<usize>, crossing: [usize; 2]) -> End {
        let Some(moving) = self.moving(floor) else {
            return End::default();
        };
        let of_floor = |component: usize| Unknown::Floor(3 * moving + component);
        let [x, y] = [
            self.frame.lines_x[crossing[0]] - self.centres[moving][0],
            self.frame.lines_y[crossing[1]] - self.centres[moving][1],
        ];
        let joint = floor.map(|floor| self.joints.at(floor, crossing));
        let mut rocked = self.rocked(crossing).into_iter();
        let [rise, about_x, about_y] = joint.unwrap_or_default().map(|unknown| {
            // What has no displacement of its own moves with the mat: feet, and the rise of columns that keep their length.
            let rocked = rocked.next().unwrap_or_default();
            unknown.map_or(rocked, |index| vec![(Unknown::Joint(index), 1.0)])
        });
        End {
            moved: [
                vec![(of_floor(0), 1.0), (of_floor(2), -y)],
                vec![(of_floor(1), 1.0), (of_floor(2), x)],
                rise,
            ],
            turned: [about_x, about_y, vec![(of_floor(2), 1.0)]],
        }
    }

    /// Displacements of a point of a column with this number. `rise`: that of a column which keeps its length. Its twist is that of a
    /// straight line between the floors, and turns nothing.
    fn point(number: usize, rise: Option<&Deformation>) -> End {
        let own = |motion| vec![(Unknown::Point(number, motion), 1.0)];
        End {
            moved: [own(0), own(1), rise.cloned().unwrap_or_else(|| own(2))],
            turned: [own(3), own(4), Deformation::new()],
        }
    }

    /// End moments of a member per equal rotation of both ends against the chord.
    pub(super) fn double_curvature(&self, member: &SpaceMember, plane: usize) -> f64 {
        let length = self.frame.clear_length(member.place, self.heights);
        let stiffness = bending_stiffness(&member.section, plane, length);
        stiffness.iter().sum()
    }

    /// A member as springs. `unknowns`: what its first and last end have beyond hinges or fibres; `at_points`: what the parts above its
    /// points have at their feet beyond hinges, from the lowest up.
    pub(super) fn springs(
        &self,
        place: SpacePlace,
        section: &SpaceSection,
        unknowns: [EndUnknowns; 2],
        at_points: &[EndUnknowns],
    ) -> SpringMember {
        let storey = place.storey();
        let [first, last] = place.crossings();
        let length = self.frame.clear_length(place, self.heights);
        let planes = planes(place);
        let (below, axis) = match place {
            SpacePlace::Column { .. } => (storey.checked_sub(1), 2),
            SpacePlace::BeamX { .. } => (Some(storey), 0),
            SpacePlace::BeamY { .. } => (Some(storey), 1),
        };
        let ends = [self.end(below, first), self.end(Some(storey), last)];
        // Joints are rigid as far as these arms.
        let rigid = self.frame.rigid_ends(place);
        let arm = |length: f64| {
            let mut arm = [0.0; 3];
            arm[axis] = length;
            arm
        };
        let [first, last] = unknowns;
        let [a, b] = ends;
        let [a, b] = [
            a.at(arm(rigid[0])).beyond(first, 1.0),
            b.at(arm(-rigid[1])).beyond(last, -1.0),
        ];
        let is_column = planes.len() == 2;
        let stretch = section.axial_rigidity.filter(|_| is_column);
        let torsion = (
            section.torsional_rigidity / length,
            difference(1.0, &b.turned[axis], &a.turned[axis]),
        );
        let rise = (is_column && stretch.is_none()).then(|| a.moved[2].clone());
        let mut cuts = vec![(0.0, a)];
        let points = self.points.of(place);
        cuts.extend(
            points.map(|(number, at)| (at.above - rigid[0], Self::point(number, rise.as_ref()))),
        );
        cuts.push((length, b));
        let parts = cuts.windows(2).enumerate().map(|(part, ends)| {
            let ((from, a), (to, b)) = (&ends[0], &ends[1]);
            let beyond = part.checked_sub(1).and_then(|point| at_points.get(point));
            let a = &a.clone().beyond(beyond.copied().unwrap_or_default(), 1.0);
            let length = to - from;
            let bend = |plane: usize| {
                let (towards, about, slope) = planes[plane];
                let chord = difference(1.0 / length, &b.moved[towards], &a.moved[towards]);
                let rotations = [a, b].map(|end| chord_rotation(slope, &end.turned[about], &chord));
                (bending_stiffness(section, plane, length), rotations)
            };
            SpringPart {
                length,
                axial: stretch.map(|rigidity| {
                    let difference = difference(1.0, &b.moved[2], &a.moved[2]);
                    (rigidity / length, difference)
                }),
                bending: bend(0),
                across: is_column.then(|| bend(1)),
            }
        });
        SpringMember {
            torsion,
            parts: parts.collect(),
        }
    }

    /// How much longer a diagonal becomes: the difference of the displacements of its ends along it. `offsets`: how far from the joints
    /// these are.
    pub(super) fn elongation(&self, place: DiagonalPlace, offsets: [f64; 2]) -> Deformation {
        let Some((crossings, run)) = place.crossings().zip(self.frame.run(place)) else {
            return Deformation::new();
        };
        let [low, high] = place.floors();
        let joints = [low, high].map(|floor| floor.checked_sub(1));
        let joints = [0, 1].map(|end| self.end(joints[end], crossings[end]));
        let height: f64 = self.heights[low..high].iter().sum();
        let [lower, upper] = offsets;
        let above = [lower, height - upper];
        let ends: Vec<End> = (joints.into_iter().enumerate())
            .map(|(end, joint)| match offsets[end] == 0.0 {
                true => joint,
                // Struts stand in one storey.
                false => self.on_column(crossings[end], low, above[end]),
            })
            .collect();
        let way = [run[0], run[1], above[1] - above[0]];
        let length = libm::hypot(libm::hypot(way[0], way[1]), way[2]);
        let mut deformation = Deformation::new();
        for (axis, part) in way.into_iter().enumerate() {
            if part != 0.0 {
                let [a, b] = [&ends[0], &ends[1]];
                deformation.extend(difference(part / length, &b.moved[axis], &a.moved[axis]));
            }
        }
        deformation
    }

    /// The point of a column that a strut meets; it does not move where there is none, which is a fault of the model.
    fn on_column(&self, line: [usize; 2], storey: usize, above: f64) -> End {
        let column = SpacePlace::Column { line, storey };
        let mut members = self.frame.members.iter();
        let Some((number, member)) =
            (self.points.nearest(column, above)).zip(members.find(|member| member.place == column))
        else {
            return End::default();
        };
        let foot = self.end(storey.checked_sub(1), line);
        let keeps_length = member.section.axial_rigidity.is_none();
        Self::point(number, keeps_length.then_some(&foot.moved[2]))
    }

    /// K_jj, factorised, and columns of −K_jf replaced by those of R. `None` if joints move without resistance.
    fn joint_motions(&self, springs: &[Spring]) -> Option<Vec<Vec<f64>>> {
        let n = self.joints.count;
        let mut firsts: Vec<usize> = (0..n).collect();
        for_each_pair(springs, |a, b, _| {
            if let (Unknown::Joint(a), Unknown::Joint(b)) = (a, b) {
                firsts[a] = firsts[a].min(b);
            }
        });
        let mut matrix = Envelope::default();
        matrix.reset(firsts.into_iter());
        let mut sides = vec![vec![0.0; n]; 3 * self.centres.len()];
        for_each_pair(springs, |a, b, value| match (a, b) {
            (Unknown::Joint(a), Unknown::Joint(b)) if b <= a => {
                matrix.set(a, b, matrix.get(a, b) + value);
            }
            (Unknown::Joint(a), Unknown::Floor(b)) => sides[b][a] -= value,
            _ => {}
        });
        let before: Vec<f64> = (0..n).map(|row| matrix.get(row, row)).collect();
        matrix.factorize();
        let holds = |index: usize| matrix.get(index, index) > LEAST_PIVOT * before[index];
        if !(0..n).all(holds) {
            return None;
        }
        for side in &mut sides {
            matrix.solve(side);
        }
        Some(sides)
    }
}

/// Least pivot, relative to the entry on the diagonal, of a joint that is held \[–\].
const LEAST_PIVOT: f64 = 1e-13;

/// Calls `take` with every pair of displacements that a spring couples and its entry of K, both ways round.
fn for_each_pair(springs: &[Spring], mut take: impl FnMut(Unknown, Unknown, f64)) {
    let mut product = |k: f64, first: &Deformation, second: &Deformation| {
        for (a, x) in first {
            for (b, y) in second {
                take(*a, *b, k * x * y);
            }
        }
    };
    for spring in springs {
        match spring {
            Spring::Single(k, single) => product(*k, single, single),
            Spring::Bending([near, far], [first, last]) => {
                product(*near, first, first);
                product(*near, last, last);
                product(*far, first, last);
                product(*far, last, first);
            }
        }
    }
}

/// Replaces axes of the lines by those of the site in a row over the motions of the floors.
fn turn_row(row: &mut [f64], [c, s]: PlanPoint) {
    for motion in row.chunks_exact_mut(3) {
        (motion[0], motion[1]) = (c * motion[0] - s * motion[1], s * motion[0] + c * motion[1]);
    }
}

/// A frame whose joints follow the floors.
pub(super) struct Condensed {
    pub(super) stiffness: LowerTriangle,
    pub(super) frame: CondensedFrame,
    /// Elongations of its diagonals, in their order, over the motions of the mat and the floors.
    pub(super) elongations: Vec<Vec<f64>>,
}

/// Condenses a frame to the motions of the mat under it and of its floors; `None` if a joint moves without resistance.
pub(super) fn condense(
    frame: &SpaceFrame,
    storey_heights: &[f64],
    mat: Option<&LumpedFloor>,
    lumped: &[LumpedFloor],
    nodes: &[usize],
) -> Option<Condensed> {
    let assembly = Assembly::new(frame, storey_heights, mat, lumped);
    let springs: Vec<SpringMember> = frame
        .members
        .iter()
        .map(|member| assembly.springs(member.place, &member.section, Default::default(), &[]))
        .collect();
    let diagonals = frame.diagonals.iter();
    let diagonals = diagonals.map(|diagonal| {
        (
            diagonal.stiffness,
            assembly.elongation(diagonal.place, [0.0; 2]),
        )
    });
    let diagonals: Vec<(f64, Deformation)> = diagonals.collect();
    let all = springs.iter().flat_map(SpringMember::springs);
    let all = all.chain(diagonals.iter().map(|(k, d)| Spring::Single(*k, d.clone())));
    let motions = assembly.joint_motions(&all.collect::<Vec<_>>())?;
    let order = 3 * assembly.centres.len();
    // D in the axes of the site.
    let row = |deformation: &Deformation| -> Vec<f64> {
        let mut row = vec![0.0; order];
        for (unknown, share) in deformation {
            match unknown {
                Unknown::Floor(floor) => row[*floor] += share,
                Unknown::Joint(joint) => {
                    for (value, motion) in row.iter_mut().zip(&motions) {
                        *value += share * motion[*joint];
                    }
                }
                // Frames with hinges or points between floors, and those that rock, keep their joints.
                Unknown::End(_) | Unknown::Point(..) | Unknown::Rocking(_) => {}
            }
        }
        turn_row(&mut row, frame.direction);
        row
    };
    let mut stiffness: LowerTriangle = (0..order).map(|row| vec![0.0; row + 1]).collect();
    let mut add_product = |force: &[f64], deformation: &[f64]| {
        for (i, to) in stiffness.iter_mut().enumerate() {
            if force[i] != 0.0 {
                for (value, other) in to.iter_mut().zip(deformation) {
                    *value += force[i] * other;
                }
            }
        }
    };
    let mut heights = vec![0.0];
    for storey in storey_heights {
        heights.push(heights[heights.len() - 1] + storey);
    }
    let mut members = Vec::with_capacity(springs.len());
    for (member, spring) in frame.members.iter().zip(&springs) {
        let mut single = |k: f64, deformation: &Deformation| {
            let deformation = row(deformation);
            let force: Vec<f64> = deformation.iter().map(|d| k * d).collect();
            add_product(&force, &deformation);
            force
        };
        // It is one part where no point between floors moves by itself.
        let whole = &spring.parts[0];
        let axial = match &whole.axial {
            Some((k, stretch)) => single(*k, stretch),
            None => vec![0.0; order],
        };
        let torsion = single(spring.torsion.0, &spring.torsion.1);
        let is_column = whole.across.is_some();
        // Slopes at both ends against the chord, and the moments that go with them.
        let mut bend = |([near, far], rotations): &([f64; 2], [Deformation; 2])| {
            let [a, b] = rotations.each_ref().map(&row);
            let moment = |one: &[f64], other: &[f64]| -> Vec<f64> {
                let both = one.iter().zip(other);
                both.map(|(one, other)| near * one + far * other).collect()
            };
            let (first, last) = (moment(&a, &b), moment(&b, &a));
            add_product(&first, &a);
            add_product(&last, &b);
            let sign = if is_column { 1.0 } else { -1.0 };
            let sum = first.iter().zip(&last);
            Bending {
                shear: sum.map(|(a, b)| -sign * (a + b) / whole.length).collect(),
                moments: [
                    first.iter().map(|value| sign * value).collect(),
                    last.iter().map(|value| -sign * value).collect(),
                ],
            }
        };
        let bending = bend(&whole.bending);
        let across = whole.across.as_ref().map(&mut bend);
        let storey = member.place.storey();
        members.push(CondensedMember {
            place: member.place,
            heights: match is_column {
                true => [heights[storey], heights[storey + 1]],
                false => [heights[storey + 1]; 2],
            },
            axial,
            torsion,
            bending,
            across,
        });
    }
    let mut elongations = Vec::with_capacity(diagonals.len());
    for (k, deformation) in &diagonals {
        let elongation = row(deformation);
        let tension: Vec<f64> = elongation.iter().map(|elongation| k * elongation).collect();
        add_product(&tension, &elongation);
        elongations.push(elongation);
    }
    let frame = CondensedFrame {
        nodes: nodes.to_vec(),
        joints: joint_rows(&assembly, &row),
        members: carried_by_columns(&assembly, members, &elongations),
    };
    Some(Condensed {
        stiffness,
        frame,
        elongations,
    })
}

impl Assembly<'_> {
    /// Diagonals that end at a height of a column above its foot, or, at its whole height, at the joint at its head, and what the column
    /// bears below of the tension of each by vertical equilibrium.
    pub(super) fn diagonals_at(&self, place: SpacePlace, above: f64) -> Row {
        let [_, line] = place.crossings();
        let storey = place.storey() + 1;
        let height = self.heights[place.storey()];
        let is_here = |at: f64| (at - above).abs() <= LEVEL_TOLERANCE;
        let ends = self.frame.diagonals.iter().enumerate();
        let ends = ends.filter_map(|(index, diagonal)| {
            let [lower, upper] = diagonal.place.crossings()?;
            let [from, to] = diagonal.offsets;
            let [low, high] = diagonal.place.floors();
            // Ends at joints hang on the joint, those above it on the column above.
            let starts = match from == 0.0 {
                true => low == storey && is_here(height),
                false => low + 1 == storey && is_here(from),
            };
            let sign = match (lower == line, upper == line) {
                (true, _) if starts => 1.0,
                (_, true) if high == storey && is_here(height - to) => -1.0,
                _ => return None,
            };
            let [x, y] = self.frame.run(diagonal.place)?;
            let rise = self.heights[low..high].iter().sum::<f64>() - from - to;
            Some((index, sign * rise / libm::hypot(libm::hypot(x, y), rise)))
        });
        ends.collect()
    }
}

fn joint_rows(
    assembly: &Assembly<'_>,
    row: &impl Fn(&Deformation) -> Vec<f64>,
) -> Vec<CondensedJoint> {
    let joints = &assembly.joints;
    let all = joints.unknowns.iter().enumerate();
    let joints = all.filter_map(|(at, unknowns)| {
        let (floor, crossing) = (at / joints.per_floor, at % joints.per_floor);
        let rows = (*unknowns)?.map(|unknown| {
            let term = unknown.map(|index| (Unknown::Joint(index), 1.0));
            row(&term.into_iter().collect())
        });
        Some(CondensedJoint {
            crossing: [crossing % joints.lines_x, crossing / joints.lines_x],
            floor,
            rows,
        })
    });
    joints.collect()
}

/// Completes the axial forces of columns that keep their length, by vertical equilibrium of the joints from the top down: a column
/// carries the one above it, the shears of the beams and the pull of the diagonals at its head.
fn carried_by_columns(
    assembly: &Assembly<'_>,
    mut members: Vec<CondensedMember>,
    elongations: &[Vec<f64>],
) -> Vec<CondensedMember> {
    let frame = assembly.frame;
    let is_column = |member: &CondensedMember| matches!(member.place, SpacePlace::Column { .. });
    let mut rigid: Vec<usize> = (0..members.len())
        .filter(|index| is_column(&members[*index]))
        .filter(|index| frame.members[*index].section.axial_rigidity.is_none())
        .collect();
    sort_by_key(&mut rigid, |index| {
        std::cmp::Reverse(members[*index].place.storey())
    });
    for column in rigid {
        let SpacePlace::Column { line, storey } = members[column].place else {
            continue;
        };
        let mut axial = vec![0.0; members[column].axial.len()];
        for other in &members {
            let (sign, force) = match other.place {
                SpacePlace::Column {
                    line: place,
                    storey: above,
                } if place == line && above == storey + 1 => (1.0, &other.axial),
                SpacePlace::BeamX { .. } | SpacePlace::BeamY { .. }
                    if other.place.storey() == storey =>
                {
                    let [first, last] = other.place.crossings();
                    match (first == line, last == line) {
                        (true, _) => (-1.0, &other.bending.shear),
                        (_, true) => (1.0, &other.bending.shear),
                        _ => continue,
                    }
                }
                _ => continue,
            };
            for (sum, value) in axial.iter_mut().zip(force) {
                *sum += sign * value;
            }
        }
        let head = assembly.heights[members[column].place.storey()];
        let at_head = assembly.diagonals_at(members[column].place, head);
        for &(index, share) in at_head.entries() {
            let stiffness = share * frame.diagonals[index].stiffness;
            for (sum, value) in axial.iter_mut().zip(&elongations[index]) {
                *sum += stiffness * value;
            }
        }
        members[column].axial = axial;
    }
    members
}
