//! Space frames with hinges or fibres: joints and ends of members keep displacements of their own.
//!
//! Where a hinge yields, the motion of joints no longer follows from that of the floors by constant shares. So the rise and both
//! rotations of every joint are unknowns of the equations, and so are the rotations of member ends beyond their hinges. Each is a node of
//! the stick model without mass that only turns; a hinge joins the rotation of a joint with that of a member end about the same axis.
//! Ends of columns beyond fibres rise as well; a fibre is a spring over the rise and both rotations of an end against its joint.
//! Members are the same springs over deformations as in a frame without hinges.

use std::ops::Range;

use super::column_ends::FibreSection;
use super::column_points::PointNode;
use super::element::{Element, Part, Place, THETA, X, Y, index_of, over_nodes};
use super::member_forces::MemberPlace;
use super::order::{Stage, Turn};
use super::space_frame::{Assembly, Deformation, EndUnknowns, SpringMember, Unknown, planes};
use super::spring_place::{MemberEnd, SpringPlace};
use super::stick_model::{Hinge, Influence, Node, StickModel, Support, YieldingElement};
use crate::linear::Row;
use crate::model::{
    ColumnLine, PlanAxis, PlanColumn, ProportionalDamping, STANDARD_GRAVITY, ShearEnds, SpaceFrame,
    SpaceMember, SpacePlace,
};

/// A column or a beam of a space frame with hinges, and its elements in the stick model.
#[derive(Clone, Debug, PartialEq)]
pub struct JointedMember {
    /// Where it is.
    pub place: SpacePlace,
    /// Heights of its ends above the base \[m\].
    pub heights: [f64; 2],
    /// Its element of torsion.
    pub torsion: usize,
    /// Its parts between points that move by themselves, upwards or from its first end to its last; the whole of most.
    pub parts: Vec<JointedPart>,
    /// Share of the weight of its floor at the head of a column which keeps its length; zero unless the building stands under its
    /// weight \[N\].
    pub weight: f64,
}

/// A part of a member.
#[derive(Clone, Debug, PartialEq)]
pub struct JointedPart {
    /// The point of the column at its upper end, as an index of [`crate::structure::Discretization::points`]; `None` at a joint.
    pub point: Option<usize>,
    /// Its length, without rigid ends \[m\].
    pub length: f64,
    /// Its element of axial force; `None` where it keeps its length.
    pub axial: Option<usize>,
    /// Its elements of bending in the vertical plane along x of a column, in that of a beam, and in the plane across of a column.
    pub bending: [Option<usize>; 2],
    /// Diagonals that end at the upper end of a part which keeps its length, and what it bears of the tension of each.
    pub diagonals: Row,
}

/// A joint of a space frame with hinges.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct JointNodes {
    /// Lines at whose crossing it is, from 0.
    pub crossing: [usize; 2],
    /// Floor, from 0.
    pub floor: usize,
    /// Nodes whose rotations are its rise, and its rotations about the axes of the lines along x and across; `None` does not move.
    pub nodes: [Option<usize>; 3],
}

/// A space frame with hinges, as it stands in the stick model.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct JointedFrame {
    /// Its columns and beams, in the order of the model.
    pub members: Vec<JointedMember>,
    /// Its joints, floor by floor.
    pub joints: Vec<JointNodes>,
}

/// A space frame in a stick model, with the places of its hinges and fibres.
#[derive(Default)]
pub(super) struct AddedJoints {
    pub(super) frame: JointedFrame,
    pub(super) points: Vec<PointNode>,
    pub(super) places: Vec<SpringPlace>,
    pub(super) sections: Vec<FibreSection>,
    /// Elongations of its diagonals, in their order, and of the lines between the joints of their bays.
    pub(super) elongations: Vec<[Row; 2]>,
}

/// Adds a frame to a stick model in which the `ground` and all that moves, the mat and the floors, are nodes already. `carried`: masses
/// of the floors that its columns carry in equal shares, and their loads; none unless it stands under its weight or rocks \[kg, N\].
/// `bears_weight`: whether it stands under it.
pub(super) fn add_space_joints(
    assembly: Assembly<'_>,
    sticks: &mut StickModel,
    ground: usize,
    moving: &[usize],
    carried: &[[f64; 2]],
    bears_weight: bool,
) -> AddedJoints {
    let (frame, storey_heights) = (assembly.frame, assembly.heights);
    let floors = &moving[moving.len() - storey_heights.len()..];
    let joint_nodes = add_joints(&assembly, sticks, floors);
    carry_floors(&assembly, sticks, (joint_nodes.start, floors), carried);
    sticks.eliminate_after_joints(moving.iter().copied(), floors[0]);
    let points = add_points(&assembly, sticks, floors);
    let mut builder = Builder {
        assembly,
        sticks,
        ground,
        moving,
        joints: joint_nodes,
        points,
        ends: Vec::new(),
        places: Vec::new(),
        sections: Vec::new(),
        shear: Vec::new(),
    };
    let first_end = builder.sticks.nodes.len();
    let members = frame
        .members
        .iter()
        .map(|member| builder.add_member(member, frame.direction));
    let mut members: Vec<JointedMember> = members.collect();
    for member in &mut members {
        let storey = member.place.storey();
        let top = builder.sticks.nodes[floors[storey]].y;
        member.heights = match member.place {
            SpacePlace::Column { .. } => {
                let below = storey.checked_sub(1).map_or(ground, |below| floors[below]);
                [builder.sticks.nodes[below].y, top]
            }
            SpacePlace::BeamX { .. } | SpacePlace::BeamY { .. } => [top; 2],
        };
        let keeps_length =
            matches!(member.place, SpacePlace::Column { .. }) && member.parts[0].axial.is_none();
        if let Some([mass, load]) = carried.get(storey).filter(|_| keeps_length && bears_weight) {
            let count = columns_of(frame, storey).count();
            member.weight = (mass * STANDARD_GRAVITY + load) / count as f64;
        }
    }
    let joints = builder.joint_list(frame);
    let elongations = frame.diagonals.iter().map(|diagonal| {
        [diagonal.offsets, [0.0; 2]].map(|offsets| {
            let elongation = builder.assembly.elongation(diagonal.place, offsets);
            builder.over_nodes(&elongation, frame.direction)
        })
    });
    let elongations = elongations.collect();
    let points = builder.point_list();
    let (mut places, sections) = (builder.places, builder.sections);
    // Hinges come before all else that yields.
    let fibres = sections.iter().filter(|section| !section.is_surface());
    places.extend(fibres.flat_map(FibreSection::places));
    let (shear_places, shear): (Vec<_>, Vec<_>) = builder.shear.into_iter().unzip();
    places.extend(shear_places);
    builder.sticks.yielding.extend(shear);
    sticks.space_ends = first_end..sticks.nodes.len();
    AddedJoints {
        frame: JointedFrame { members, joints },
        points,
        places,
        sections,
        elongations,
    }
}

/// Adds a node for every unknown of a joint; returns them.
fn add_joints(assembly: &Assembly<'_>, sticks: &mut StickModel, floors: &[usize]) -> Range<usize> {
    let joints = &assembly.joints;
    // Columns that keep their length share their rise: it belongs to the highest floor.
    let mut highest = vec![0; joints.count];
    for (at, unknowns) in joints.unknowns.iter().enumerate() {
        for unknown in unknowns.iter().flatten().flatten() {
            highest[*unknown] = highest[*unknown].max(at / joints.per_floor);
        }
    }
    let first = sticks.nodes.len();
    for (unknown, floor) in highest.into_iter().enumerate() {
        let height = sticks.nodes[floors[floor]].y;
        sticks.add_turning(Stage::Joints, unknown, height);
    }
    first..sticks.nodes.len()
}

/// Nodes of a point of a column.
#[derive(Clone, Copy)]
struct PointNodes {
    /// Of its displacements along and across.
    moving: usize,
    /// Of its rise, unless the column keeps its length.
    rising: Option<usize>,
    /// Of its rotations about the lines.
    turning: [usize; 2],
}

/// Adds the nodes of every point of a column.
fn add_points(
    assembly: &Assembly<'_>,
    sticks: &mut StickModel,
    floors: &[usize],
) -> Vec<PointNodes> {
    let mut found = Vec::with_capacity(assembly.points.all.len());
    for point in &assembly.points.all {
        let [line, _] = point.column.crossings();
        let floor = floors[point.column.storey()];
        let top = sticks.nodes[floor].y;
        let height = top - assembly.heights[point.column.storey()] + point.above;
        let number = sticks.nodes.len();
        // About the centre of the floor above, along the axes of the site.
        let [at, centre] = [
            assembly.frame.point(line),
            assembly
                .frame
                .on_site(assembly.centre_of_floor(point.column.storey())),
        ];
        let [x, y] = [0, 1].map(|axis| at[axis] - centre[axis]);
        let [along, across, _] = Influence::OF_FLOOR;
        sticks.nodes.push(Node {
            mass: point.mass,
            inertia: [point.mass, point.mass, 0.0],
            influence: [
                Influence {
                    turning: -y,
                    ..along
                },
                Influence {
                    turning: x,
                    ..across
                },
                Influence::NONE,
            ],
            ..Node::at(0.0, height).held(Support::Swaying)
        });
        let turn = Turn {
            stage: Some(Stage::Joints),
            height,
            // Its mass moves with those of floors.
            elevation: Turn::FLOORS,
            position: number as f64,
        };
        sticks.turns.insert(number, turn);
        let mut members = assembly.frame.members.iter();
        let column = members.find(|member| member.place == point.column);
        let stretches = column.is_some_and(|column| column.section.axial_rigidity.is_some());
        let mut turning = || sticks.add_turning(Stage::Joints, sticks.nodes.len(), height);
        found.push(PointNodes {
            moving: number,
            rising: stretches.then(&mut turning),
            turning: [turning(), turning()],
        });
    }
    found
}

/// Crossings at which columns stand below a floor, from 0.
fn columns_of(frame: &SpaceFrame, floor: usize) -> impl Iterator<Item = [usize; 2]> {
    let places = frame.members.iter().map(|member| member.place);
    places.filter_map(move |place| match place {
        SpacePlace::Column { line, storey } if storey == floor => Some(line),
        _ => None,
    })
}

/// Lets joints on columns carry the masses and loads of floors, in equal shares.
fn carry_floors(
    assembly: &Assembly<'_>,
    sticks: &mut StickModel,
    (first, floors): (usize, &[usize]),
    carried: &[[f64; 2]],
) {
    for (floor, [mass, load]) in carried.iter().enumerate() {
        let columns: Vec<[usize; 2]> = columns_of(assembly.frame, floor).collect();
        for line in &columns {
            let [rise, ..] = assembly.joints.at(floor, *line);
            let height = sticks.nodes[floors[floor]].y;
            let node = match rise {
                Some(rise) => Some(first + rise),
                None => sticks.add_foot_motion(assembly, *line, 0, height),
            };
            let Some(node) = node else { continue };
            let at = assembly.frame.point(*line);
            sticks.note_rise((node, THETA), at);
            let node = &mut sticks.nodes[node];
            node.inertia[THETA] += mass / columns.len() as f64;
            node.load += load / columns.len() as f64;
            node.influence[THETA] = Influence::UP;
        }
    }
}

impl StickModel {
    /// Adds a node without mass that has a single displacement, its rotation, and that moves nothing else.
    fn add_turning(&mut self, stage: Stage, number: usize, height: f64) -> usize {
        let index = self.nodes.len();
        let node = Node::at(0.0, height).held(Support::Turning);
        self.nodes.push(Node {
            influence: [Influence::NONE; 3],
            ..node
        });
        let turn = Turn {
            stage: Some(stage),
            height,
            elevation: 0,
            position: number as f64,
        };
        self.turns.insert(index, turn);
        index
    }
}

impl StickModel {
    /// Adds a node that follows the rise, or a rotation, with which a rocking mat moves what stands at a crossing; `None` if it does not
    /// rock.
    fn add_foot_motion(
        &mut self,
        assembly: &Assembly<'_>,
        crossing: [usize; 2],
        motion: usize,
        height: f64,
    ) -> Option<usize> {
        let rocking = self.plan_base.and_then(|plan_base| plan_base.rocking)?;
        let [c, s] = assembly.frame.direction;
        let rocked = assembly.rocked(crossing);
        let shares = rocked[motion].iter().flat_map(|term| {
            let shares = match term.0 {
                Unknown::Rocking(direction) => rocked_on_site(direction, [c, s]),
                _ => [0.0; 3],
            };
            let places = [X, Y, THETA].map(|component| (rocking, component));
            places.into_iter().zip(shares.map(|share| share * term.1))
        });
        let row = over_nodes(shares.filter(|(_, share)| *share != 0.0)).merged();
        let node = self.add_turning(Stage::Joints, self.nodes.len(), height);
        self.ties.insert(index_of((node, THETA)), row);
        Some(node)
    }
}

/// Rocking along x and across, and the rise of the base, in a rocking along or across the lines of a frame, or in that rise.
fn rocked_on_site(motion: usize, [c, s]: [f64; 2]) -> [f64; 3] {
    match motion {
        0 => [c, s, 0.0],
        1 => [-s, c, 0.0],
        _ => [0.0, 0.0, 1.0],
    }
}

struct Builder<'a> {
    assembly: Assembly<'a>,
    sticks: &'a mut StickModel,
    ground: usize,
    /// Nodes of the mat and of the floors.
    moving: &'a [usize],
    /// Nodes of the unknowns of joints.
    joints: Range<usize>,
    /// Nodes of points of columns, by their numbers.
    points: Vec<PointNodes>,
    /// Nodes of member ends, by their numbers.
    ends: Vec<usize>,
    places: Vec<SpringPlace>,
    sections: Vec<FibreSection>,
    shear: Vec<(SpringPlace, YieldingElement)>,
}

impl Builder<'_> {
    fn add_member(&mut self, member: &SpaceMember, direction: [f64; 2]) -> JointedMember {
        let mut ends = [EndUnknowns::default(); 2];
        self.add_shear(member.place, &mut ends);
        for plane in [0, 1] {
            self.add_hinges(member, plane, &mut ends);
        }
        self.add_fibres(member.place, &mut ends);
        if self.assembly.points.of(member.place).next().is_some() {
            for (plane, (_, axis, _)) in planes(member.place).iter().enumerate() {
                let whole = self.assembly.double_curvature(member, plane);
                let numbers = ends.iter().filter_map(|end| end[1 + axis]);
                let nodes = numbers.map(|number| (self.ends[number], whole));
                self.sticks.double_curvature.extend(nodes);
            }
        }
        let at_points = self.add_struck_hinges(member);
        let springs = self
            .assembly
            .springs(member.place, &member.section, ends, &at_points);
        let SpringMember { torsion, parts } = springs;
        let row = |deformation: &Deformation| self.over_nodes(deformation, direction);
        let single = |(stiffness, deformation): &(f64, Deformation)| Element::Spring {
            part: Part::Elastic,
            stiffness: *stiffness,
            row: row(deformation),
        };
        let bend = |([one, other], ends): &([f64; 2], [Deformation; 2])| Element::Matrix {
            part: Part::Elastic,
            rows: ends.iter().map(row).collect(),
            lower: vec![*one, *other, *one],
        };
        let is_column = matches!(member.place, SpacePlace::Column { .. });
        let storey_height = self.assembly.heights[member.place.storey()];
        let points = self.assembly.points.of(member.place);
        let tops = points.map(|(number, point)| (Some(number), point.above));
        let tops: Vec<(Option<usize>, f64)> = tops.chain([(None, storey_height)]).collect();
        let axial: Vec<Option<Element>> = parts
            .iter()
            .map(|part| part.axial.as_ref().map(single))
            .collect();
        let torsion = single(&torsion);
        let bending: Vec<[Option<Element>; 2]> = parts
            .iter()
            .map(|part| [Some(bend(&part.bending)), part.across.as_ref().map(bend)])
            .collect();
        let mut add = |element: Element| {
            self.sticks.space_elements.push(element);
            self.sticks.space_elements.len() - 1
        };
        let axial: Vec<Option<usize>> = axial
            .into_iter()
            .map(|element| element.map(&mut add))
            .collect();
        let torsion = add(torsion);
        let bending: Vec<[Option<usize>; 2]> = bending
            .into_iter()
            .map(|planes| planes.map(|element| element.map(&mut add)))
            .collect();
        let parts = parts.iter().zip(tops).zip(axial.into_iter().zip(bending));
        let parts = parts.map(|((part, (point, above)), (axial, bending))| JointedPart {
            point,
            length: part.length,
            axial,
            bending,
            diagonals: match is_column && axial.is_none() {
                true => self.assembly.diagonals_at(member.place, above),
                false => Row::default(),
            },
        });
        JointedMember {
            place: member.place,
            heights: [0.0; 2],
            parts: parts.collect(),
            torsion,
            weight: 0.0,
        }
    }

    /// Lets ends of a column slide against their joints, by springs that can fail.
    fn add_shear(&mut self, place: SpacePlace, ends: &mut [EndUnknowns; 2]) {
        for axis in PlanAxis::BOTH {
            let Some(shear) = self.assembly.frame.shear.get(&(place, axis)) else {
                continue;
            };
            for end in [MemberEnd::First, MemberEnd::Last] {
                if end == MemberEnd::Last && shear.ends == ShearEnds::Foot {
                    continue;
                }
                let number = self.ends.len();
                let height = self.height(place, end);
                let node = self.sticks.add_turning(Stage::Beams, number, height);
                self.ends.push(node);
                ends[end as usize][3 + axis.index()] = Some(number);
                let place = SpringPlace::Shear {
                    frame: None,
                    member: MemberPlace::InSpace(place),
                    axis: Some(axis),
                    end,
                };
                let element = YieldingElement {
                    row: over_nodes([((node, THETA), 1.0)]),
                    hysteresis: shear.spring,
                    proportional_damping: ProportionalDamping::None,
                };
                self.shear.push((place, element));
            }
        }
    }

    /// Floor on which an end of a member lies; what is below the floors is `None`.
    fn floor(place: SpacePlace, end: MemberEnd) -> Option<usize> {
        match (place, end) {
            (SpacePlace::Column { storey, .. }, MemberEnd::First) => storey.checked_sub(1),
            _ => Some(place.storey()),
        }
    }

    /// Height of an end of a member above the base \[m\].
    fn height(&self, place: SpacePlace, end: MemberEnd) -> f64 {
        let moving = self.assembly.moving(Self::floor(place, end));
        self.sticks.nodes[moving.map_or(self.ground, |moving| self.moving[moving])].y
    }

    /// Adds the ends of a member in a plane of bending, and the hinges between them and its joints.
    ///
    /// A hinge is positive where a moment stretches the bottom of a beam, or the face of a column on the side of the plane: at the
    /// first end of a column, and the last of a beam, where the joint is turned further along the slope than the member.
    fn add_hinges(&mut self, member: &SpaceMember, plane: usize, ends: &mut [EndUnknowns; 2]) {
        let Some((hysteresis, &(_, axis, slope))) =
            member.hinges[plane].zip(planes(member.place).get(plane))
        else {
            return;
        };
        let is_column = matches!(member.place, SpacePlace::Column { .. });
        for end in [MemberEnd::First, MemberEnd::Last] {
            // Rotations about x and across stand after the rise.
            let (joint, node) = self.add_end(member.place, end, 1 + axis, ends);
            let joint_leads = (is_column == (end == MemberEnd::First)) == (slope > 0.0);
            let both = if joint_leads {
                [joint, node]
            } else {
                [node, joint]
            };
            self.sticks.hinges.push(Hinge::yielding(both, hysteresis));
            self.places.push(SpringPlace::InSpace {
                place: member.place,
                end,
                axis: match (member.place, plane) {
                    (SpacePlace::Column { .. }, 1) | (SpacePlace::BeamY { .. }, _) => PlanAxis::Y,
                    _ => PlanAxis::X,
                },
            });
        }
    }

    /// Adds hinges where a column is struck, in the planes in which its ends have some, and returns what the parts above have beyond them.
    fn add_struck_hinges(&mut self, member: &SpaceMember) -> Vec<EndUnknowns> {
        let points = self.assembly.points.of(member.place);
        let points: Vec<(usize, bool)> = points
            .map(|(number, point)| (number, point.is_struck))
            .collect();
        let mut all = Vec::with_capacity(points.len());
        for (index, (number, is_struck)) in points.into_iter().enumerate() {
            let mut beyond = EndUnknowns::default();
            let planes = planes(member.place).iter().enumerate();
            for (plane, &(_, axis, slope)) in planes.filter(|_| is_struck) {
                let Some(hysteresis) = member.hinges[plane] else {
                    continue;
                };
                let below = self.points[number].turning[axis];
                let height = self.sticks.nodes[below].y;
                let above = self
                    .sticks
                    .add_turning(Stage::Beams, self.ends.len(), height);
                beyond[1 + axis] = Some(self.ends.len());
                self.ends.push(above);
                // As at the foot of a column.
                let both = match slope > 0.0 {
                    true => [below, above],
                    false => [above, below],
                };
                self.sticks.hinges.push(Hinge::yielding(both, hysteresis));
                self.places.push(SpringPlace::Struck {
                    frame: None,
                    member: MemberPlace::InSpace(member.place),
                    axis: Some(PlanAxis::BOTH[plane]),
                    point: index + 1,
                });
            }
            all.push(beyond);
        }
        all
    }

    /// Adds the ends of a column beyond its fibres, and these.
    fn add_fibres(&mut self, place: SpacePlace, ends: &mut [EndUnknowns; 2]) {
        let Some(fibre) = self.assembly.frame.fibres.get(&place) else {
            return;
        };
        for end in [MemberEnd::First, MemberEnd::Last] {
            if !fibre.at_ends[end as usize] {
                continue;
            }
            // What is above moves away from what is below.
            let [rise, about_x, about_y] = [0, 1, 2].map(|motion| {
                let (joint, node) = self.add_end(place, end, motion, ends);
                let [lower, upper] = match end {
                    MemberEnd::First => [joint, node],
                    MemberEnd::Last => [node, joint],
                };
                over_nodes([((upper, THETA), 1.0), ((lower, THETA), -1.0)])
            });
            // A turn about x lifts what lies further across, one about y lowers what lies further along.
            let rotations = vec![about_y.times(-1.0), about_x];
            let member = MemberPlace::InSpace(place);
            let section = self.sticks.add_section(fibre, member, end, rise, rotations);
            self.sections.push(section);
        }
    }

    /// Adds a displacement of an end of a member beside that of its joint: rise, rotation about x, about y. Returns the nodes of both.
    fn add_end(
        &mut self,
        place: SpacePlace,
        end: MemberEnd,
        motion: usize,
        ends: &mut [EndUnknowns; 2],
    ) -> (usize, usize) {
        let crossing = place.crossings()[end as usize];
        let joint = Self::floor(place, end)
            .and_then(|floor| self.assembly.joints.at(floor, crossing)[motion]);
        let height = self.height(place, end);
        let joint = match joint {
            Some(unknown) => self.joints.start + unknown,
            None => {
                let (assembly, sticks) = (&self.assembly, &mut *self.sticks);
                let moved = sticks.add_foot_motion(assembly, crossing, motion, height);
                moved.unwrap_or(self.ground)
            }
        };
        let number = self.ends.len();
        let node = self.sticks.add_turning(Stage::Beams, number, height);
        self.ends.push(node);
        ends[end as usize][motion] = Some(number);
        (joint, node)
    }

    /// A deformation over displacements of nodes; those of floors are along the axes of the site.
    fn over_nodes(&self, deformation: &Deformation, [c, s]: [f64; 2]) -> Row {
        let mut list = Vec::with_capacity(deformation.len() + 2);
        let mut add =
            |place: Place, share: f64| match list.iter_mut().find(|(known, _)| *known == place) {
                Some((_, sum)) => *sum += share,
                None => list.push((place, share)),
            };
        for (unknown, share) in deformation {
            match *unknown {
                Unknown::Joint(index) => add((self.joints.start + index, THETA), *share),
                Unknown::End(index) => add((self.ends[index], THETA), *share),
                Unknown::Point(number, motion) => {
                    let PointNodes {
                        moving,
                        rising,
                        turning,
                    } = self.points[number];
                    match motion {
                        0 => {
                            add((moving, X), c * share);
                            add((moving, Y), s * share);
                        }
                        1 => {
                            add((moving, X), -s * share);
                            add((moving, Y), c * share);
                        }
                        2 => rising
                            .into_iter()
                            .for_each(|rising| add((rising, THETA), *share)),
                        _ => add((turning[motion - 3], THETA), *share),
                    }
                }
                Unknown::Rocking(direction) => {
                    let rocking = self
                        .sticks
                        .plan_base
                        .and_then(|plan_base| plan_base.rocking);
                    let shares = rocked_on_site(direction, [c, s]);
                    for (component, component_share) in [X, Y, THETA].into_iter().zip(shares) {
                        if let Some(node) = rocking {
                            add((node, component), component_share * share);
                        }
                    }
                }
                Unknown::Floor(motion) => {
                    let floor = self.moving[motion / 3];
                    match motion % 3 {
                        0 => {
                            add((floor, X), c * share);
                            add((floor, Y), s * share);
                        }
                        1 => {
                            add((floor, X), -s * share);
                            add((floor, Y), c * share);
                        }
                        _ => add((floor, THETA), *share),
                    }
                }
            }
        }
        over_nodes(list.into_iter().filter(|(_, share)| *share != 0.0))
    }

    fn point_list(&self) -> Vec<PointNode> {
        let all = self.assembly.points.all.iter().zip(&self.points);
        let points = all.map(|(point, nodes)| PointNode {
            column: PlanColumn {
                line: ColumnLine::Crossing(point.column.crossings()[0]),
                storey: point.column.storey(),
            },
            height: self.sticks.nodes[nodes.moving].y,
            mass: point.mass,
            moved: [X, Y].map(|component| Row::single(index_of((nodes.moving, component)))),
            node: nodes.moving,
        });
        points.collect()
    }

    fn joint_list(&self, frame: &SpaceFrame) -> Vec<JointNodes> {
        let joints = &self.assembly.joints;
        let lines_x = frame.lines_x.len();
        let all = joints.unknowns.iter().enumerate();
        let nodes = all.filter_map(|(at, unknowns)| {
            let crossing = at % joints.per_floor;
            Some(JointNodes {
                crossing: [crossing % lines_x, crossing / lines_x],
                floor: at / joints.per_floor,
                nodes: (*unknowns)?.map(|unknown| unknown.map(|index| self.joints.start + index)),
            })
        });
        nodes.collect()
    }
}
