//! Forces of columns and beams of space frames as linear forms of the motion.

use super::element::{THETA, X, Y, places};
use super::member_forces::{
    LinearForm, MemberForces, MemberPlace, MemberSection, MemberSections, SectionAt,
};
use super::space_frame::CondensedFrame;
use super::space_joints::{JointedFrame, JointedMember, JointedPart};
use super::spring_place::{MemberEnd, SpringPlace};
use super::wall_forces::WallForce;
use crate::linear::{Row, sort_by_key};
use crate::model::{PlanAxis, SpacePlace, SpaceWall};
use crate::structure::AssembledBuilding;

impl MemberForces {
    /// Adds the members of a space frame: their forces follow from the motions of the mat and of the floors.
    pub(super) fn add_space_frame(&mut self, building: &AssembledBuilding, frame: &CondensedFrame) {
        let floors = &building.discretization.floors;
        let dofs = motions_of(building, frame);
        let nothing = self.index_of(LinearForm::default());
        for member in &frame.members {
            // Every row occurs once.
            let mut add = |row: &[f64]| {
                let form = over(&dofs, row);
                if form.displacement.is_empty() {
                    return nothing;
                }
                self.forms.push(form);
                self.forms.len() - 1
            };
            let (axial, torsion) = (add(&member.axial), add(&member.torsion));
            let shear = add(&member.bending.shear);
            let shear_across = member.across.as_ref().map(|plane| add(&plane.shear));
            let place = MemberPlace::InSpace(member.place);
            let level = member.place.storey();
            let sections = [SectionAt::First, SectionAt::Last].into_iter().enumerate();
            let sections = sections.map(|(side, at)| {
                let moment = add(&member.bending.moments[side]);
                let across = member
                    .across
                    .as_ref()
                    .map(|plane| add(&plane.moments[side]));
                let floor = match (place.is_column(), side) {
                    (true, 0) => level.checked_sub(1),
                    _ => Some(level),
                };
                MemberSection {
                    at,
                    height: member.heights[side],
                    dofs: floor.map_or([None; 2], |floor| building.horizontal_dofs(floors[floor])),
                    forms: [axial, shear, moment],
                    across: Some([
                        shear_across.unwrap_or(nothing),
                        across.unwrap_or(nothing),
                        torsion,
                    ]),
                }
            });
            let sections = sections.collect();
            self.members.push(MemberSections {
                frame: None,
                place,
                sections,
                shared: None,
            });
        }
    }

    /// Adds forces at the feet of the walls of a space frame, which are always followed.
    pub(super) fn add_space_walls(&mut self, building: &AssembledBuilding) {
        let discretization = &building.discretization;
        let walls = discretization.space_walls.iter().enumerate();
        let walls = walls.filter_map(|(index, wall)| {
            let foot = wall.column(wall.storeys[0]);
            let rises = [wall.storeys[0].checked_sub(1), Some(wall.storeys[1])];
            let [axial, moment, elongation] = discretization
                .space_frame
                .as_deref()
                .and_then(|frame| of_condensed_wall(building, frame, foot, wall, rises))
                .or_else(|| {
                    let frame = discretization.jointed_frame.as_deref()?;
                    of_jointed_wall(building, frame, foot, wall, rises)
                })?;
            Some((index, wall, [axial, moment, elongation.tidy()]))
        });
        for (index, wall, forms) in walls.collect::<Vec<_>>() {
            let [axial, moment, elongation] = forms.map(|form| self.index_of(form));
            let hinge = |storey, end| SpringPlace::InSpace {
                place: wall.column(storey),
                end,
                axis: wall.along,
            };
            let foot = hinge(wall.storeys[0], MemberEnd::First);
            let storeys = wall.storeys[0]..=wall.storeys[1];
            let upper = storeys.flat_map(|storey| {
                [MemberEnd::First, MemberEnd::Last].map(|end| hinge(storey, end))
            });
            let sections: Vec<usize> = (0..discretization.sections.len())
                .filter(|section| match discretization.sections[*section].member {
                    MemberPlace::InSpace(place) => wall.has(place),
                    _ => false,
                })
                .collect();
            let at_foot = |section: &&usize| {
                let section = &discretization.sections[**section];
                let foot = MemberPlace::InSpace(wall.column(wall.storeys[0]));
                (section.member, section.end) == (foot, MemberEnd::First)
            };
            self.walls.push(WallForce {
                across: wall.along == PlanAxis::Y,
                frame: None,
                number: index + 1,
                hinge: foot,
                upper_hinges: upper.filter(|upper| *upper != foot).collect(),
                foot_section: sections.iter().find(at_foot).copied(),
                sections,
                sliding: None,
                axial,
                moment,
                elongation,
            });
        }
    }

    /// Adds the members of a space frame with hinges or points between floors. Moments at hinges are those of the hinges. `struck` tells
    /// whether a neighbour can strike the node with one of these displacements of the building.
    pub(super) fn add_jointed_frame(
        &mut self,
        building: &AssembledBuilding,
        frame: &JointedFrame,
        struck: impl Fn(usize) -> bool,
    ) {
        let cuts = JointedCuts { building, frame };
        let floors = &building.discretization.floors;
        let bending = cuts.all_bending();
        let axial = cuts.axial(&bending);
        for ((member, parts), axial) in frame.members.iter().zip(bending).zip(axial) {
            let torque = cuts.forces(member.torsion)[0].clone();
            let torque = self.index_of(torque);
            let axial: Vec<usize> = axial.into_iter().map(|form| self.index_of(form)).collect();
            let parts: Vec<_> = parts
                .into_iter()
                .map(|planes| {
                    planes.map(|plane| {
                        let plane = plane.unwrap_or_default();
                        let shear = self.index_of(plane.shear);
                        (shear, plane.moments.map(|form| self.index_of(form)))
                    })
                })
                .collect();
            // A column that can fail in shear has that of its springs, which bear its damping as well.
            let mut slide = |axis: PlanAxis, end: MemberEnd| {
                let place = SpringPlace::Shear {
                    frame: None,
                    member: MemberPlace::InSpace(member.place),
                    axis: Some(axis),
                    end,
                };
                let spring = building.discretization.spring_at(None, place)?;
                Some(self.index_of(LinearForm {
                    springs: Row::single(spring),
                    ..LinearForm::default()
                }))
            };
            let slides = PlanAxis::BOTH.map(|axis| {
                let [foot, head] = [MemberEnd::First, MemberEnd::Last].map(|end| slide(axis, end));
                [foot, head.or(foot.filter(|_| parts.len() == 1))]
            });
            let section = |at: SectionAt, part: usize, height: f64, dofs: [Option<usize>; 2]| {
                let side = usize::from(matches!(at, SectionAt::Last | SectionAt::Below));
                let [(shear, moments), (shear_across, moments_across)] = parts[part];
                let is_end = matches!(at, SectionAt::First | SectionAt::Last);
                let [shear, shear_across] = [(shear, slides[0]), (shear_across, slides[1])]
                    .map(|(whole, slides)| slides[side].filter(|_| is_end).unwrap_or(whole));
                MemberSection {
                    at,
                    height,
                    dofs,
                    forms: [axial[part], shear, moments[side]],
                    across: Some([shear_across, moments_across[side], torque]),
                }
            };
            let place = MemberPlace::InSpace(member.place);
            let level = member.place.storey();
            let below = match place.is_column() {
                true => level.checked_sub(1),
                false => Some(level),
            };
            let of_floor = |floor: Option<usize>| {
                let node = floor.map(|floor| floors[floor]);
                node.map_or([None; 2], |node| building.horizontal_dofs(node))
            };
            let [first, last] = member.heights;
            let mut sections = vec![
                section(SectionAt::First, 0, first, of_floor(below)),
                section(
                    SectionAt::Last,
                    parts.len() - 1,
                    last,
                    of_floor(Some(level)),
                ),
            ];
            for (index, part) in member.parts.iter().enumerate() {
                let Some(point) = part
                    .point
                    .map(|point| &building.discretization.points[point])
                else {
                    continue;
                };
                let dofs = building.horizontal_dofs(point.node);
                if dofs.into_iter().flatten().any(&struck) {
                    sections.push(section(SectionAt::Below, index, point.height, dofs));
                    sections.push(section(SectionAt::Above, index + 1, point.height, dofs));
                }
            }
            self.members.push(MemberSections {
                frame: None,
                place,
                sections,
                shared: None,
            });
        }
    }
}

impl AssembledBuilding {
    /// Displacements of a node along the row and, in plan, across.
    pub(super) fn horizontal_dofs(&self, node: usize) -> [Option<usize>; 2] {
        let second = &self.discretization.stick_model.nodes[node].influence[Y];
        let dof = |component| self.equations.dof((node, component));
        [dof(X), dof(Y).filter(|_| second.across != 0.0)]
    }
}

/// Degrees of freedom of the motions of a frame: along, across and turning of each of its nodes.
fn motions_of(building: &AssembledBuilding, frame: &CondensedFrame) -> Vec<Option<usize>> {
    let places = frame.nodes.iter();
    let places = places.flat_map(|node| [X, Y, THETA].map(|component| (*node, component)));
    places.map(|place| building.equations.dof(place)).collect()
}

/// A force by its shares of these motions.
fn over(dofs: &[Option<usize>], row: &[f64]) -> LinearForm {
    let entries = dofs.iter().zip(row);
    let entries = entries.filter_map(|(dof, share)| Some(((*dof)?, *share)));
    LinearForm {
        displacement: entries.filter(|(_, share)| *share != 0.0).collect(),
        ..LinearForm::default()
    }
}

/// Axial force and moment at the foot of a wall, and how much longer it becomes between two floors; `None` for its foot.
fn of_condensed_wall(
    building: &AssembledBuilding,
    frame: &CondensedFrame,
    foot: SpacePlace,
    wall: &SpaceWall,
    rises: [Option<usize>; 2],
) -> Option<[LinearForm; 3]> {
    let dofs = motions_of(building, frame);
    let member = frame.members.iter().find(|member| member.place == foot)?;
    let plane = match wall.along {
        PlanAxis::X => &member.bending,
        PlanAxis::Y => member.across.as_ref()?,
    };
    let [below, above] = rises.map(|floor| {
        let floor = floor?;
        let mut joints = frame.joints.iter();
        let joint = joints.find(|joint| joint.floor == floor && joint.crossing == wall.line)?;
        Some(over(&dofs, &joint.rows[0]))
    });
    let mut elongation = above.unwrap_or_default();
    elongation.add(-1.0, &below.unwrap_or_default());
    Some([
        over(&dofs, &member.axial),
        over(&dofs, &plane.moments[0]),
        elongation,
    ])
}

/// The same of a frame whose joints move by themselves.
fn of_jointed_wall(
    building: &AssembledBuilding,
    frame: &JointedFrame,
    foot: SpacePlace,
    wall: &SpaceWall,
    rises: [Option<usize>; 2],
) -> Option<[LinearForm; 3]> {
    let cuts = JointedCuts { building, frame };
    let bending = cuts.all_bending();
    let index = frame
        .members
        .iter()
        .position(|member| member.place == foot)?;
    let plane = bending[index][0][wall.along.index()].as_ref()?;
    let mut elongation = LinearForm::default();
    let node = |floor: usize| {
        let mut joints = frame.joints.iter();
        let joint = joints.find(|joint| joint.floor == floor && joint.crossing == wall.line);
        joint?.nodes[0]
    };
    for (floor, sign) in rises.into_iter().zip([-1.0, 1.0]) {
        let rise = match floor {
            Some(floor) => node(floor).and_then(|node| building.equations.dof((node, THETA))),
            None => None,
        };
        if let Some(dof) = rise {
            elongation.displacement.add(dof, sign);
        }
    }
    // What stands at the foot rises with a base that rocks.
    let base = &building.discretization.stick_model;
    if let (None, Some(node)) = (rises[0], node(0))
        && let Some(rise) = base.rise_with_base((node, THETA))
    {
        for &(dof, share) in building.equations.row(&base.carried_row(rise)).entries() {
            elongation.displacement.add(dof, -share);
        }
    }
    let axial = cuts.axial(&bending).swap_remove(index).swap_remove(0);
    Some([axial, plane.moments[0].clone(), elongation])
}

/// Shear and end moments in one plane.
#[derive(Clone, Default)]
struct PlaneForces {
    shear: LinearForm,
    moments: [LinearForm; 2],
}

/// Those in both planes of every part of a member.
type PartForces = Vec<[Option<PlaneForces>; 2]>;

/// A space frame with hinges, ready to be cut.
struct JointedCuts<'a> {
    building: &'a AssembledBuilding,
    frame: &'a JointedFrame,
}

impl JointedCuts<'_> {
    /// The forces that belong to the deformations of an element.
    fn forces(&self, element: usize) -> Vec<LinearForm> {
        let sticks = &self.building.discretization.stick_model;
        let element = &sticks.space_elements[element];
        let deformations = element.deformations().iter();
        let deformations: Vec<Row> = deformations.map(|row| sticks.carried_row(row)).collect();
        let force = |index: usize| {
            let mut form = LinearForm::default();
            for (at, deformation) in deformations.iter().enumerate() {
                let stiffness = element.entry(index, at);
                let entries = places(deformation).filter_map(|(place, share)| {
                    Some((self.building.equations.dof(place)?, stiffness * share))
                });
                form.displacement.extend(entries);
            }
            form.tidy()
        };
        (0..deformations.len()).map(force).collect()
    }

    /// Of every part of every member.
    fn all_bending(&self) -> Vec<PartForces> {
        let members = self.frame.members.iter();
        members.map(|member| self.bending(member)).collect()
    }

    fn bending(&self, member: &JointedMember) -> PartForces {
        let is_column = matches!(member.place, SpacePlace::Column { .. });
        let sign = if is_column { 1.0 } else { -1.0 };
        let places = &self.building.discretization.spring_places;
        let last_part = member.parts.len() - 1;
        let hinge = |part: usize, end: MemberEnd, plane: usize| {
            let axis = match (member.place, plane) {
                (SpacePlace::Column { .. }, 1) | (SpacePlace::BeamY { .. }, _) => PlanAxis::Y,
                _ => PlanAxis::X,
            };
            let struck = |point: usize| SpringPlace::Struck {
                frame: None,
                member: MemberPlace::InSpace(member.place),
                axis: Some(axis),
                point,
            };
            let space = match end {
                MemberEnd::First if part > 0 => struck(part),
                MemberEnd::Last if part < last_part => struck(part + 1),
                _ => SpringPlace::InSpace {
                    place: member.place,
                    end,
                    axis,
                },
            };
            places.iter().position(|place| *place == space)
        };
        let of_part = |(index, part): (usize, &JointedPart)| {
            [0, 1].map(|plane| {
                let forces = self.forces(part.bending[plane]?);
                let [first, last] = &forces[..] else {
                    return None;
                };
                let mut shear = LinearForm::default();
                for end_moment in [first, last] {
                    shear.add(-sign / part.length, end_moment);
                }
                let moment = |end: MemberEnd, end_moment: &LinearForm, sign: f64| {
                    let mut form = LinearForm::default();
                    match hinge(index, end, plane) {
                        Some(spring) => form.springs.add(spring, 1.0),
                        None => form.add(sign, end_moment),
                    }
                    form
                };
                Some(PlaneForces {
                    shear: shear.tidy(),
                    moments: [
                        moment(MemberEnd::First, first, sign),
                        moment(MemberEnd::Last, last, -sign),
                    ],
                })
            })
        };
        member.parts.iter().enumerate().map(of_part).collect()
    }

    /// Axial forces of all members, part by part. A column that keeps its length carries the one above it, the shears of the beams, the pull
    /// of the diagonals and its share of the weight of the floor at its head.
    fn axial(&self, bending: &[PartForces]) -> Vec<Vec<LinearForm>> {
        let members = &self.frame.members;
        let of_stretch = |part: &JointedPart| {
            let forces = part.axial.map(|element| self.forces(element));
            forces.map_or_else(LinearForm::default, |mut force| force.swap_remove(0))
        };
        let of_parts = |member: &JointedMember| member.parts.iter().map(of_stretch).collect();
        let mut axial: Vec<Vec<LinearForm>> = members.iter().map(of_parts).collect();
        let is_column = |place: SpacePlace| matches!(place, SpacePlace::Column { .. });
        let keeps_length = |member: &JointedMember| member.parts[0].axial.is_none();
        let mut rigid: Vec<usize> = (0..members.len())
            .filter(|index| is_column(members[*index].place) && keeps_length(&members[*index]))
            .collect();
        sort_by_key(&mut rigid, |index| {
            std::cmp::Reverse(members[*index].place.storey())
        });
        for column in rigid {
            let storey = members[column].place.storey();
            let [line, _] = members[column].place.crossings();
            let mut sum = LinearForm {
                carries: true,
                ..LinearForm::default()
            };
            for (index, other) in members.iter().enumerate() {
                let [first, last] = other.place.crossings();
                if is_column(other.place) {
                    if first == line && other.place.storey() == storey + 1 {
                        sum.add(1.0, &axial[index][0]);
                    }
                } else if other.place.storey() == storey
                    && let Some(plane) = &bending[index][0][0]
                {
                    if first == line {
                        sum.add(-1.0, &plane.shear);
                    } else if last == line {
                        sum.add(1.0, &plane.shear);
                    }
                }
            }
            for (index, part) in members[column].parts.iter().enumerate().rev() {
                for (diagonal, share) in part.diagonals.entries() {
                    sum.add(*share, &self.building.force_of_diagonal(*diagonal));
                }
                if part.point.is_none() {
                    sum.constant -= members[column].weight;
                }
                sum = sum.tidy();
                axial[column][index] = sum.clone();
            }
        }
        axial
    }
}
