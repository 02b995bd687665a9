//! Axial force, shear and moment at the ends and struck points of columns and beams, as linear forms of the motion.

use std::ops::Range;

use crate::linear::Row;
use crate::model::{STANDARD_GRAVITY, SharedColumn, SpacePlace};
use crate::structure::element::{self, ElementStiffness, Part, THETA, X, Y, index_of};
use crate::structure::stick_elements;
use crate::structure::wall_forces::{AtRest, Coupling, CouplingForce, WallForce};
use crate::structure::{AssembledBuilding, Discretization, Member, MemberEnd, SpringPlace};

/// Where a column or a beam of a frame is; all count from 1.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum MemberPlace {
    /// A column, between two floors.
    Column {
        /// Column line, from the left.
        line: usize,
        /// Storey, from the ground up.
        storey: usize,
    },
    /// A beam, between two column lines.
    Beam {
        /// Floor, from the ground up.
        floor: usize,
        /// Span, from the left.
        span: usize,
    },
    /// A column or a beam of a space frame, whose place counts from 0.
    InSpace(SpacePlace),
}

impl MemberPlace {
    /// Whether it is a column.
    #[must_use]
    pub fn is_column(self) -> bool {
        matches!(
            self,
            Self::Column { .. } | Self::InSpace(SpacePlace::Column { .. })
        )
    }
}

impl std::fmt::Display for MemberPlace {
    fn fmt(&self, formatter: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        match self {
            Self::Column { line, storey } => write!(formatter, "column.{line}.{storey}"),
            Self::Beam { floor, span } => write!(formatter, "beam.{floor}.{span}"),
            Self::InSpace(place) => place.fmt(formatter),
        }
    }
}

/// A column or a beam of a frame, and the massless members of the stick model that it consists of.
#[derive(Clone, Debug, PartialEq)]
pub struct FrameMember {
    /// Index of its frame in [`crate::structure::Discretization::frames`]; `None` where the building is one frame.
    pub frame: Option<usize>,
    /// Where it is.
    pub place: MemberPlace,
    /// Its members of the stick model, upwards or from left to right.
    pub elements: Range<usize>,
}

/// Where along a member forces are taken.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum SectionAt {
    /// Lower end of a column, left end of a beam.
    First,
    /// Upper end of a column, right end of a beam.
    Last,
    /// Just below a point of a column where a neighbour can strike it.
    Below,
    /// Just above it.
    Above,
    /// The core of a beam–column joint.
    Core,
}

/// A cross-section of a member whose forces are followed.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct MemberSection {
    /// Where along the member.
    pub at: SectionAt,
    /// Height above the base \[m\].
    pub height: f64,
    /// Horizontal displacements of the node there along the row and, in space, across, in the vectors of the building; `None` at the ground.
    pub dofs: [Option<usize>; 2],
    /// Axial force, shear and moment: indices into [`MemberForces::forms`].
    pub forms: [usize; 3],
    /// Shear and moment in the plane across, and torque, of a member of a space frame.
    pub across: Option<[usize; 3]>,
}

impl MemberSection {
    /// All its forces by their kind: 0 axial, 1 shear, 2 moment or torque.
    pub(crate) fn by_kind(&self) -> impl Iterator<Item = (usize, usize)> + use<> {
        let forms = self.forms.into_iter().enumerate();
        let across = self.across.into_iter().flatten();
        forms.chain([1, 2, 2].into_iter().zip(across))
    }
}

/// The sections of one member: its two ends, then below and above every struck point, from the lowest up.
#[derive(Clone, Debug, PartialEq)]
pub struct MemberSections {
    /// Index of its frame in [`crate::structure::Discretization::frames`]; `None` where the building is one frame.
    pub frame: Option<usize>,
    /// Where the member is.
    pub place: MemberPlace,
    /// Its sections.
    pub sections: Vec<MemberSection>,
    /// Name of the column that two frames share: the axial forces are those of both frames together.
    pub shared: Option<String>,
}

impl MemberSections {
    /// Its name within the building: `column.LINE.STOREY` or `beam.FLOOR.SPAN`, with the name of its frame before where frames
    /// stand in a plan; `column.X.Y.STOREY`, `beam_x.FLOOR.X.Y` or `beam_y.FLOOR.X.Y` in a space frame, with the lines at which it
    /// begins. `frames`: names of frames in plan.
    #[must_use]
    pub fn local_name(&self, frames: &[String]) -> String {
        match self.frame.and_then(|frame| frames.get(frame)) {
            Some(frame) => format!("{frame}.{}", self.place),
            None => self.place.to_string(),
        }
    }
}

/// The core of a beam–column joint whose shear is followed.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct JointCore {
    /// Column line, from 1 at the left.
    pub line: usize,
    /// Floor, from 1.
    pub floor: usize,
    /// Its section: axial force of the column above and shear of the core; the moment is zero.
    pub section: MemberSection,
}

impl std::fmt::Display for JointCore {
    fn fmt(&self, formatter: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        write!(formatter, "joint.{}.{}", self.line, self.floor)
    }
}

/// How the forces of members follow from the motion of a building.
///
/// Forces are those of the elastic members: stiffness-proportional damping is no part of them. Axial forces are positive
/// in tension. Shear is positive where the lower or left part pushes the other one left or up: that of a column is
/// horizontal and positive when the building leans to the right, P-Delta included. A moment is positive where it
/// stretches the bottom of a beam or the right face of a column. At an end with a hinge that yields, it is that of the
/// hinge.
///
/// Members of a space frame have the same forces in the vertical plane along the lines x (columns) or in their own (beams), and in
/// the plane across, where further across takes the place of right. Their torque is positive where it turns the last end
/// counter-clockwise against the first, seen from the last end.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct MemberForces {
    /// Columns and beams, storey by storey from the ground up, columns first; empty unless asked for.
    pub members: Vec<MemberSections>,
    /// Joints, in the order in which they were asked for.
    pub joints: Vec<JointCore>,
    /// Braces and struts of frames, which are always followed.
    pub diagonals: Vec<DiagonalForce>,
    /// Ends of columns that are made of fibres, in the order of [`crate::structure::Discretization::sections`]: axial force, positive in tension, then
    /// moments, positive where they stretch the right side, and, in space, the side further across; indices into
    /// [`MemberForces::forms`]. They are always followed.
    pub sections: Vec<Vec<usize>>,
    /// Walls of frames, which are always followed.
    pub walls: Vec<WallForce>,
    /// Coupling beams of frames, which are always followed.
    pub coupling_beams: Vec<CouplingForce>,
    /// Moments at the base of coupled walls.
    pub coupling: Option<Coupling>,
    /// Every force once; members of one element have one shear.
    pub forms: Vec<LinearForm>,
}

/// The axial force of a brace or a strut, positive in tension.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct DiagonalForce {
    /// Index among [`crate::structure::Discretization::diagonals`].
    pub diagonal: usize,
    /// Index into [`MemberForces::forms`].
    pub form: usize,
}

/// A force as a sum over the motion of a building.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct LinearForm {
    /// The force per displacement \[N/m, N, N·m, N·m/rad\].
    pub(crate) displacement: Row,
    /// The same per velocity.
    pub(crate) velocity: Row,
    /// The same per acceleration relative to the ground.
    pub(crate) acceleration: Row,
    /// The same per force of a spring that yields.
    pub(crate) springs: Row,
    /// Force per ground acceleration \[kg\].
    pub(crate) ground: f64,
    /// Force of self weight beyond that of the displacements at rest \[N\].
    pub(crate) constant: f64,
    /// Whether it carries masses by vertical equilibrium; their vertical inertia is no part of it.
    pub(crate) carries: bool,
    /// Floor whose left face lies in the cut-off part, from 0: what pushes it reduces the force.
    pub(crate) left_face: Option<usize>,
    /// Contacts and links that push there, as indices of the system.
    pub(crate) contacts: Vec<usize>,
    pub(crate) links: Vec<usize>,
}

/// The motion of a building at an instant.
#[derive(Clone, Copy)]
pub(crate) struct Motion<'a> {
    pub(crate) displacement: &'a [f64],
    pub(crate) velocity: &'a [f64],
    pub(crate) acceleration: &'a [f64],
    /// Ground acceleration \[m/s²\].
    pub(crate) ground: f64,
}

impl LinearForm {
    /// The force; `spring`, `contact` and `link` return forces by index \[N, N·m\].
    #[inline]
    pub(crate) fn value(
        &self,
        motion: Motion<'_>,
        spring: impl Fn(usize) -> f64,
        contact: impl Fn(usize) -> f64,
        link: impl Fn(usize) -> f64,
    ) -> f64 {
        let mut sum = self.displacement.value(motion.displacement) + self.constant;
        if !self.follows_displacements() {
            sum += self.velocity.value(motion.velocity)
                + self.acceleration.value(motion.acceleration)
                + self.ground * motion.ground;
            sum += self.springs.value_of(spring);
            sum -= self
                .contacts
                .iter()
                .map(|index| contact(*index))
                .sum::<f64>();
            sum -= self.links.iter().map(|index| link(*index)).sum::<f64>();
        }
        sum
    }

    /// Whether displacements and self weight alone determine it.
    pub(crate) fn follows_displacements(&self) -> bool {
        self.velocity.is_empty()
            && self.acceleration.is_empty()
            && self.springs.is_empty()
            && self.contacts.is_empty()
            && self.links.is_empty()
            && self.ground == 0.0
    }
}

impl AssembledBuilding {
    /// Axial force of a diagonal, positive in tension.
    pub(super) fn force_of_diagonal(&self, diagonal: usize) -> LinearForm {
        let Discretization {
            stick_model,
            diagonals,
            ..
        } = &self.discretization;
        let diagonal = &diagonals[diagonal];
        let mut form = LinearForm::default();
        match self.discretization.spring_of_diagonal(diagonal) {
            Some(spring) if diagonal.spring.is_some() => form.springs = Row::single(spring),
            _ => {
                let elongation = stick_model.carried_row(&diagonal.elongation);
                form.displacement = self.equations.row(&elongation).times(diagonal.stiffness);
            }
        }
        form
    }
}

impl MemberForces {
    /// Forces that are followed always: those of braces, struts, walls and coupling beams, and of sections of fibres.
    pub(crate) fn followed_always(building: &AssembledBuilding, rest: AtRest<'_>) -> Self {
        let mut forces = Self::default();
        forces.add_diagonals(building);
        forces.add_walls(building, rest);
        forces.add_space_walls(building);
        forces.add_sections(&building.discretization);
        forces
    }

    fn add_sections(&mut self, discretization: &Discretization) {
        for section in &discretization.sections {
            let springs = discretization.springs_of_section(section);
            let mut sum = |share: &dyn Fn([f64; 2]) -> f64| {
                let fibres = springs.clone().zip(section.fibres.iter());
                self.index_of(LinearForm {
                    springs: fibres
                        .map(|(spring, fibre)| (spring, share(fibre.at)))
                        .collect(),
                    ..LinearForm::default()
                })
            };
            let mut forms = vec![sum(&|_| 1.0)];
            let axes = 0..section.rotations.len();
            forms.extend(axes.map(|axis| sum(&|at| at[axis])));
            self.sections.push(forms);
        }
    }

    fn add_diagonals(&mut self, building: &AssembledBuilding) {
        for diagonal in 0..building.discretization.diagonals.len() {
            let form = self.index_of(building.force_of_diagonal(diagonal));
            self.diagonals.push(DiagonalForce { diagonal, form });
        }
    }

    /// Forces of all members of a frame; none for a building without members. `struck` tells whether a neighbour can
    /// strike the node with this horizontal displacement of the building.
    pub(crate) fn new(
        building: &AssembledBuilding,
        rest: AtRest<'_>,
        struck: impl Fn(usize) -> bool,
    ) -> Self {
        let mut forces = Self::followed_always(building, rest);
        if let Some(frame) = &building.discretization.space_frame {
            forces.add_space_frame(building, frame);
        }
        if let Some(frame) = &building.discretization.jointed_frame {
            forces.add_jointed_frame(building, frame, &struck);
        }
        if building.discretization.members.is_empty() {
            return forces;
        }
        let cuts = Cuts::new(building, rest.gravity);
        let stick_model = &building.discretization.stick_model;
        for member in &building.discretization.members {
            let range = member.elements.clone();
            let mut places = vec![
                (SectionAt::First, range.start, 0),
                (SectionAt::Last, range.end - 1, 1),
            ];
            for element in range.start + 1..range.end {
                let node = cuts.elements[element].ends[0];
                let dof = building.equations.horizontal(node);
                let is_column = matches!(member.place, MemberPlace::Column { .. });
                // A column that two frames share is pushed along one, and bends in both.
                let mut points = building.discretization.points.iter();
                let is_point = points.any(|point| point.node == node);
                if is_column && (is_point || dof.is_some_and(&struck)) {
                    places.push((SectionAt::Below, element - 1, 1));
                    places.push((SectionAt::Above, element, 0));
                }
            }
            let sections = places.into_iter().map(|(at, element, side)| {
                let node = cuts.elements[element].ends[side];
                let forms = [
                    cuts.axial(element, side),
                    cuts.shear_at(member, at, element, side),
                    cuts.moment(member, at, element, side),
                ];
                MemberSection {
                    at,
                    height: stick_model.nodes[node].y,
                    dofs: [building.equations.horizontal(node), None],
                    forms: forms.map(|form| forces.index_of(form)),
                    across: None,
                }
            });
            let sections = sections.collect();
            forces.members.push(MemberSections {
                frame: member.frame,
                place: member.place,
                sections,
                shared: None,
            });
        }
        forces.share_columns(&building.discretization.shared_columns);
        forces
    }

    /// Adds up the axial forces that two frames give to one column.
    fn share_columns(&mut self, columns: &[SharedColumn]) {
        for column in columns {
            let storeys_of = |[frame, line]: [usize; 2]| -> Vec<usize> {
                let all = self.members.iter().enumerate();
                let members = all.filter(|(_, member)| {
                    let on_line = |place| matches!(place, MemberPlace::Column { line: on, .. } if on == line + 1);
                    member.frame == Some(frame) && on_line(member.place)
                });
                members.map(|(index, _)| index).collect()
            };
            let [first, second] = column.lines.map(storeys_of);
            for (a, b) in first.into_iter().zip(second) {
                for at in 0..self.members[a].sections.len() {
                    let [of_a, of_b] =
                        [a, b].map(|member| self.members[member].sections[at].forms[0]);
                    let sum = self.forms[of_a].plus(&self.forms[of_b]);
                    self.forms.push(sum);
                    for member in [a, b] {
                        self.members[member].sections[at].forms[0] = self.forms.len() - 1;
                    }
                }
                for member in [a, b] {
                    self.members[member].shared = Some(column.name.clone());
                }
            }
        }
    }

    /// Follows the shear of the core of a joint by equilibrium of its upper half: the beams' forces in their upper bars, which
    /// are their moments at the faces of the column over their lever arms, and the shear of the column above,
    ///
    /// ```text
    /// V = (M_left − V_left c)/z_left − (M_right + V_right c)/z_right + V_above
    /// ```
    /// with c half the depth of the column. Positive where the upper part is pushed right. `levers`: lever arms of the beams
    /// on the left and on the right; beams without one are left out. `None` if there is no column below the joint.
    pub(crate) fn add_joint(
        &mut self,
        [line, floor]: [usize; 2],
        half_depth: f64,
        levers: [Option<f64>; 2],
    ) -> Option<usize> {
        let end = |place: MemberPlace, at: SectionAt| {
            let member = self.members.iter().find(|member| member.place == place)?;
            let mut sections = member.sections.iter();
            sections.find(|section| section.at == at).copied()
        };
        let column = |storey| MemberPlace::Column { line, storey };
        let below = end(column(floor), SectionAt::Last)?;
        let above = end(column(floor + 1), SectionAt::First);
        let beams = [
            (line.checked_sub(1), SectionAt::Last, 1.0),
            (Some(line), SectionAt::First, -1.0),
        ];
        let mut shear = LinearForm::default();
        for ((span, at, sign), lever) in beams.into_iter().zip(levers) {
            let place = span.map(|span| MemberPlace::Beam { floor, span });
            let beam = place.and_then(|place| end(place, at));
            let (Some(beam), Some(lever)) = (beam, lever) else {
                continue;
            };
            let [_, force, moment] = beam.forms;
            shear.add(sign / lever, &self.forms[moment]);
            shear.add(-half_depth / lever, &self.forms[force]);
        }
        let axial = above.map_or_else(LinearForm::default, |above| {
            shear.add(1.0, &self.forms[above.forms[1]]);
            self.forms[above.forms[0]].clone()
        });
        let forms = [axial, shear.tidy(), LinearForm::default()];
        let section = MemberSection {
            at: SectionAt::Core,
            height: below.height,
            dofs: below.dofs,
            forms: forms.map(|form| self.index_of(form)),
            across: None,
        };
        self.joints.push(JointCore {
            line,
            floor,
            section,
        });
        Some(self.joints.len() - 1)
    }

    /// Where a form stands in the list, to which it is added if it is new.
    pub(super) fn index_of(&mut self, form: LinearForm) -> usize {
        // Those that are equal belong to one member or column line: look at the latest first.
        let known = self.forms.iter().rposition(|known| *known == form);
        known.unwrap_or_else(|| {
            self.forms.push(form);
            self.forms.len() - 1
        })
    }

    /// Whether none were asked for, or the building has none.
    #[must_use]
    pub fn is_empty(&self) -> bool {
        self.members.is_empty()
    }
}

/// The stick model of a building, ready to be cut.
pub(super) struct Cuts<'a> {
    building: &'a AssembledBuilding,
    gravity: f64,
    elements: Vec<Element>,
    /// Of every node and component: part of the stiffness, degree of freedom and force per displacement of all elements
    /// together.
    rows: Vec<[Vec<(Part, usize, f64)>; 3]>,
    /// Of every node and component: its force as a row over those of springs that yield.
    springs: Vec<[Row; 3]>,
}

/// A member of the stick model from its lower or left end on.
struct Element {
    ends: [usize; 2],
    vertical: bool,
    rigid: bool,
    compression: f64,
    stiffness: ElementStiffness,
}

/// Nodes closer than this lie on one column line or floor \[m\].
const SAME_LINE: f64 = 1e-6;

impl<'a> Cuts<'a> {
    pub(super) fn new(building: &'a AssembledBuilding, gravity: f64) -> Self {
        let stick_model = &building.discretization.stick_model;
        let nodes = &stick_model.nodes;
        let of_member = |member: &Member| {
            let vertical = member.is_vertical(nodes);
            let [a, b] = member.ends;
            let rises = if vertical {
                nodes[a].y <= nodes[b].y
            } else {
                nodes[a].x <= nodes[b].x
            };
            Element {
                ends: if rises { [a, b] } else { [b, a] },
                vertical,
                rigid: member.axial_rigidity.is_none(),
                compression: member.compression,
                stiffness: stick_elements::of_member(member, nodes),
            }
        };
        let mut rows = vec![[const { Vec::new() }; 3]; nodes.len()];
        for (part, a, b, value) in
            stick_elements::untied(stick_model).flat_map(|element| element.entries)
        {
            for (b, share) in element::places(&stick_model.carried(b)) {
                let value = value * share;
                if let Some(dof) = building.equations.dof(b) {
                    rows[a.0][a.1].push((part, dof, value));
                }
            }
        }
        let mut springs: Vec<[Row; 3]> = vec![Default::default(); nodes.len()];
        for (index, spring) in stick_model.single_springs().enumerate() {
            for ((node, component), share) in element::places(&spring.row) {
                springs[node][component].add(index, share);
            }
        }
        Self {
            building,
            gravity,
            springs,
            elements: stick_model.members.iter().map(of_member).collect(),
            rows,
        }
    }

    /// Axial force, shear and moment at the lower or left end of a member.
    pub(super) fn at_foot(&self, member: &FrameMember) -> [LinearForm; 3] {
        let element = member.elements.start;
        [
            self.axial(element, 0),
            self.shear(element, 0),
            self.moment(member, SectionAt::First, element, 0),
        ]
    }

    /// The node at its lower or left end.
    pub(super) fn first_node(&self, member: &FrameMember) -> usize {
        self.elements[member.elements.start].ends[0]
    }

    /// The node at its upper or right end.
    pub(super) fn last_node(&self, member: &FrameMember) -> usize {
        self.elements[member.elements.end - 1].ends[1]
    }

    /// What displacements do to one component of the force that bends or stretches an element at an end.
    fn end_force(&self, element: usize, side: usize, component: usize, sign: f64) -> LinearForm {
        let element = &self.elements[element];
        let place = (element.ends[side], component);
        let mut form = LinearForm::default();
        for (part, a, b, value) in &element.stiffness.entries {
            if *a != place || *part == Part::Dashpot {
                continue;
            }
            let stick_model = &self.building.discretization.stick_model;
            for (b, share) in element::places(&stick_model.carried(*b)) {
                if let Some(dof) = self.building.equations.dof(b) {
                    form.displacement.add(dof, sign * value * share);
                }
            }
        }
        form.displacement = form.displacement.merged();
        form
    }

    fn shear(&self, element: usize, side: usize) -> LinearForm {
        let outwards = [1.0, -1.0][side];
        if self.elements[element].vertical {
            self.end_force(element, side, X, -outwards)
        } else {
            self.end_force(element, side, Y, outwards)
        }
    }

    /// At an end of a column that can fail in shear, that of its spring, which bears the damping of the column as well. Without masses
    /// between, the head has that of the foot.
    fn shear_at(
        &self,
        member: &FrameMember,
        at: SectionAt,
        element: usize,
        side: usize,
    ) -> LinearForm {
        let discretization = &self.building.discretization;
        let spring_at = |end: MemberEnd| {
            let place = SpringPlace::Shear {
                frame: None,
                member: member.place,
                axis: None,
                end,
            };
            discretization.spring_at(member.frame, place)
        };
        let spring = match at {
            SectionAt::First => spring_at(MemberEnd::First),
            SectionAt::Last => {
                let foot = || spring_at(MemberEnd::First).filter(|_| member.elements.len() == 1);
                spring_at(MemberEnd::Last).or_else(foot)
            }
            SectionAt::Below | SectionAt::Above | SectionAt::Core => None,
        };
        match spring {
            Some(spring) => LinearForm {
                springs: Row::single(spring),
                ..LinearForm::default()
            },
            None => self.shear(element, side),
        }
    }

    fn moment(
        &self,
        member: &FrameMember,
        at: SectionAt,
        element: usize,
        side: usize,
    ) -> LinearForm {
        let end = match at {
            SectionAt::First => Some(MemberEnd::First),
            SectionAt::Last => Some(MemberEnd::Last),
            SectionAt::Below | SectionAt::Above | SectionAt::Core => None,
        };
        let place = match (member.place, end) {
            (MemberPlace::Column { line, storey }, Some(end)) => {
                Some(SpringPlace::Column { storey, line, end })
            }
            (column @ MemberPlace::Column { .. }, None) => Some(SpringPlace::Struck {
                frame: None,
                member: column,
                axis: None,
                point: self.hinges_up_to(member, element + side),
            }),
            (MemberPlace::Beam { floor, span: bay }, Some(end)) => {
                Some(SpringPlace::Beam { floor, bay, end })
            }
            _ => None,
        };
        let hinge =
            place.and_then(|place| self.building.discretization.spring_at(member.frame, place));
        match hinge {
            Some(spring) => LinearForm {
                springs: Row::single(spring),
                ..LinearForm::default()
            },
            None => self.end_force(element, side, THETA, [-1.0, 1.0][side]),
        }
    }

    /// How many hinges between its elements a member has below an element; none if its node is not hinged.
    fn hinges_up_to(&self, member: &FrameMember, element: usize) -> usize {
        let is_hinged = |at: usize| self.elements[at - 1].ends[1] != self.elements[at].ends[0];
        let below = member.elements.start + 1..=element;
        if is_hinged(element) {
            below.filter(|at| is_hinged(*at)).count()
        } else {
            0
        }
    }

    fn axial(&self, element: usize, side: usize) -> LinearForm {
        let cut = &self.elements[element];
        match (cut.rigid, cut.vertical) {
            (true, true) => self.carried_by_column(cut),
            // A rigid floor holds the beams of frames in plan, whatever their stiffness.
            (_, false) if self.is_part_of_a_floor(cut) => LinearForm::default(),
            (true, false) => self.passed_through_beam(cut),
            (false, vertical) => {
                let component = if vertical { Y } else { X };
                let mut form = self.end_force(element, side, component, [-1.0, 1.0][side]);
                if self.gravity == 0.0 {
                    form.constant = -cut.compression;
                }
                form
            }
        }
    }

    /// Whether both ends move along the frame with a floor in plan.
    fn is_part_of_a_floor(&self, cut: &Element) -> bool {
        let ties = &self.building.discretization.stick_model.ties;
        let mut ends = cut.ends.iter();
        ends.all(|end| ties.contains_key(&index_of((*end, X))))
    }

    /// By vertical equilibrium of the column line above: it carries the shears of its beams and its own masses.
    fn carried_by_column(&self, cut: &Element) -> LinearForm {
        let stick_model = &self.building.discretization.stick_model;
        let top = stick_model.nodes[cut.ends[1]];
        let line = stick_model.turn(cut.ends[1]);
        let equations = &self.building.equations;
        let mut form = LinearForm {
            carries: true,
            ..LinearForm::default()
        };
        for (index, node) in stick_model.nodes.iter().enumerate() {
            // Faces of a wall are on the line of its axis.
            let turn = stick_model.turn(index);
            let beside = turn.elevation != line.elevation
                || (turn.position - line.position).abs() > SAME_LINE;
            if beside || node.y < top.y - SAME_LINE {
                continue;
            }
            for (part, dof, value) in &self.rows[index][Y] {
                match part {
                    // Among them those that keep the damping of masses relative to a foundation.
                    Part::Dashpot => form.velocity.add(*dof, -value),
                    Part::Elastic | Part::Undamped => form.displacement.add(*dof, -value),
                }
            }
            form.springs.add_times(-1.0, &self.springs[index][Y]);
            let carried = stick_model.carried((index, Y));
            for (place, share) in element::places(&carried) {
                if let Some(dof) = equations.dof(place) {
                    let mass = node.inertia[Y] * share;
                    form.acceleration.add(dof, -mass);
                    form.velocity.add(dof, -equations.alpha * mass);
                }
            }
            form.constant -= self.gravity * (node.inertia[Y] + node.load / STANDARD_GRAVITY);
        }
        if self.gravity == 0.0 {
            form.constant = -cut.compression;
        }
        form.tidy()
    }

    /// By horizontal equilibrium of the floor to the left: columns, masses, damping, and what pushes the left face.
    fn passed_through_beam(&self, cut: &Element) -> LinearForm {
        let discretization = &self.building.discretization;
        let stick_model = &discretization.stick_model;
        // Ends of beams and columns stand at their joints.
        let left = stick_model.turn(cut.ends[0]);
        let equations = &self.building.equations;
        let floors = discretization.floors.iter();
        let mut form = LinearForm {
            left_face: floors
                .map(|node| stick_model.nodes[*node].y)
                .position(|height| (height - left.height).abs() <= SAME_LINE),
            ..LinearForm::default()
        };
        for (index, node) in stick_model.nodes.iter().enumerate() {
            let turn = stick_model.turn(index);
            if (turn.height - left.height).abs() > SAME_LINE
                || turn.position > left.position + SAME_LINE
            {
                continue;
            }
            for (part, dof, value) in &self.rows[index][X] {
                match part {
                    Part::Dashpot => form.velocity.add(*dof, *value),
                    Part::Undamped => form.displacement.add(*dof, *value),
                    Part::Elastic => {
                        form.displacement.add(*dof, *value);
                        form.velocity.add(*dof, equations.beta * value);
                    }
                }
            }
            form.springs.add_times(1.0, &self.springs[index][X]);
            if let Some(dof) = equations.dof((index, X)) {
                let mass = node.inertia[X];
                form.acceleration.add(dof, mass);
                form.velocity.add(dof, equations.alpha * mass);
                form.ground += mass;
            }
        }
        form.tidy()
    }
}

impl LinearForm {
    /// The sum of two forces.
    fn plus(&self, other: &Self) -> Self {
        Self {
            displacement: self.displacement.plus(&other.displacement),
            velocity: self.velocity.plus(&other.velocity),
            acceleration: self.acceleration.plus(&other.acceleration),
            springs: self.springs.plus(&other.springs),
            ground: self.ground + other.ground,
            constant: self.constant + other.constant,
            carries: self.carries || other.carries,
            ..Self::default()
        }
        .tidy()
    }

    /// Adds a share of a force on which neither contacts nor links act directly.
    pub(super) fn add(&mut self, share: f64, other: &Self) {
        let add = |to: &mut Row, row: &Row| to.add_times(share, row);
        add(&mut self.displacement, &other.displacement);
        add(&mut self.velocity, &other.velocity);
        add(&mut self.acceleration, &other.acceleration);
        add(&mut self.springs, &other.springs);
        self.ground += share * other.ground;
        self.constant += share * other.constant;
        self.carries |= other.carries;
    }

    pub(super) fn tidy(mut self) -> Self {
        self.displacement = self.displacement.merged();
        self.velocity = self.velocity.merged();
        self.acceleration = self.acceleration.merged();
        self.springs = self.springs.merged();
        self
    }
}
