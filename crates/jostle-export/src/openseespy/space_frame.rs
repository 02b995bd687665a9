//! Space frames: joints, columns and beams as nodes and elements in space.

use std::collections::BTreeMap;
use std::fmt::Write;

use jostle::structure::{MemberEnd, MemberPlace, SpringPlace};
use jostle::system::BuildingSystem;
use jostle::{
    Building, PlanAxis, ProportionalDamping, ShearEnds, SpaceFrame, SpaceMember, SpacePlace,
    Structure,
};

use super::fibres::FibreEnd;
use super::panels::Panels;
use super::plan_base::DampedMass;
use super::script::{Script, python_damping, rounded};

/// Stiffness of springs that join a member to its joint where it has no hinge, in units of the stiffest member \[–\].
const STIFF: f64 = 1e6;

/// Most joints of the space frame of a building, its feet and the ends of members beyond hinges included.
pub(super) fn joints_of(building: &Building) -> usize {
    let Structure::Tiers(tiers) = &building.structure else {
        return 0;
    };
    let frame = tiers.space_frame.as_ref();
    let crossings = frame.map_or(0, |frame| frame.lines_x.len() * frame.lines_y.len());
    let hinged = frame.map_or(0, |frame| {
        let members = frame.members.iter();
        members.filter(|member| has_ends(frame, member)).count()
    });
    crossings * (tiers.floors.len() + 1) + 2 * hinged
}

/// Whether hinges or fibres of a member stand at the end of a rigid arm.
pub(super) fn has_hinges_on_arms(frame: &SpaceFrame) -> bool {
    let mut members = frame.members.iter();
    members.any(|member| has_ends(frame, member) && frame.rigid_ends(member.place) != [0.0; 2])
}

/// Whether a member has ends of its own beside its joints.
fn has_ends(frame: &SpaceFrame, member: &SpaceMember) -> bool {
    let mut axes = PlanAxis::BOTH.into_iter();
    member.may_yield()
        || frame.fibres.contains_key(&member.place)
        || axes.any(|axis| frame.shear.contains_key(&(member.place, axis)))
}

impl Script<'_> {
    pub(super) fn add_space_frame(
        &mut self,
        index: usize,
        building: &BuildingSystem,
        frame: &SpaceFrame,
        storey_heights: &[f64],
    ) -> Result<(), &'static str> {
        let mut heights = vec![0.0];
        for storey in storey_heights {
            heights.push(heights[heights.len() - 1] + storey);
        }
        let floors = &building.discretization.floors;
        let mat = building.discretization.mat.map(|mat| mat.node);
        let plan_base = building.discretization.stick_model.plan_base;
        let mat = mat.or(plan_base.map(|base| base.footing));
        let rocks = plan_base.is_some_and(|base| base.rocking.is_some());
        let stiff = stiffest(frame, storey_heights);
        // Level 0 is the ground or the mat.
        let mut tags: BTreeMap<(usize, [usize; 2]), usize> = BTreeMap::new();
        let (c, s) = (frame.direction[0], frame.direction[1]);
        for member in &frame.members {
            let level = member.place.storey() + 1;
            let (levels, towards) = match member.place {
                SpacePlace::Column { .. } => ([level - 1, level], [c, s, 0.0]),
                SpacePlace::BeamX { .. } | SpacePlace::BeamY { .. } => {
                    ([level; 2], [0.0, 0.0, 1.0])
                }
            };
            let crossings = member.place.crossings();
            let mut ends = [0; 2];
            for side in 0..2 {
                let place = (levels[side], crossings[side]);
                ends[side] = match tags.get(&place) {
                    Some(tag) => *tag,
                    None => {
                        let tag = self.tag(index, self.next_point[index]);
                        self.next_point[index] += 1;
                        tags.insert(place, tag);
                        let [x, y] = frame.point(place.1).map(rounded);
                        let moving = place
                            .0
                            .checked_sub(1)
                            .map_or(mat, |floor| Some(floors[floor]));
                        let floor = match moving {
                            Some(node) => self.tag(index, node).to_string(),
                            None => "None".to_owned(),
                        };
                        let z = rounded(heights[place.0]);
                        let _ = writeln!(
                            self.space_joints,
                            "    ({tag}, {x:?}, {y:?}, {z:?}, {floor}),"
                        );
                        if let (0, true) = (place.0, rocks) {
                            let _ = writeln!(self.riding, "    ({floor}, {tag}),");
                        }
                        tag
                    }
                };
            }
            if has_ends(frame, member) {
                for (end, tag) in [MemberEnd::First, MemberEnd::Last]
                    .into_iter()
                    .zip(&mut ends)
                {
                    let hinges = Hinges {
                        place: member.place,
                        end,
                        stiff,
                    };
                    *tag = self.add_hinged_end(index, building, frame, *tag, &hinges)?;
                }
            }
            let section = &member.section;
            let axial = section
                .axial_rigidity
                .map_or_else(|| "None".to_owned(), |value| format!("{value:?}"));
            if section.axial_rigidity.is_none() {
                self.remark("Columns that keep their length are given EA = 1e4 * 12 EI / l^2.");
            }
            let shear = match section.shear_rigidity {
                Some([first, second]) => format!("({first:?}, {second:?})"),
                None => "None".to_owned(),
            };
            let element = self.element();
            let [bending, sideways] = section.flexural_rigidity;
            let _ = writeln!(
                self.space_members,
                "    ({element}, {}, {}, {bending:?}, {sideways:?}, {:?}, {axial}, {shear}, ({:?}, {:?}, {:?})),",
                ends[0], ends[1], section.torsional_rigidity, towards[0], towards[1], towards[2],
            );
            let rigid = frame.rigid_ends(member.place);
            if rigid != [0.0; 2] {
                let [first, last] = rigid;
                let _ = writeln!(self.rigid_ends, "    ({element}, {first:?}, {last:?}),");
            }
        }
        self.add_carried(building, frame, &tags);
        let mut panels = Panels::default();
        let of_frame = building.discretization.diagonals.iter();
        let mut of_frame = of_frame.filter(|diagonal| diagonal.frame.is_none());
        for diagonal in &frame.diagonals {
            let placed = of_frame.next();
            let before = self.next_element;
            let Some(crossings) = diagonal.place.crossings() else {
                continue;
            };
            let levels = diagonal.place.floors().into_iter();
            let joints = levels.zip(crossings).map(|place| tags.get(&place).copied());
            let [Some(first), Some(last)] = joints.collect::<Vec<_>>()[..] else {
                return Err("has a brace without a joint");
            };
            let Some(placed) = placed else {
                return Err("has a brace without a spring");
            };
            self.add_diagonal(&building.discretization.stick_model, placed, [first, last])?;
            panels.add(placed, before..self.next_element);
        }
        self.add_panels(index, building, panels);
        Ok(())
    }

    /// Masses and loads of floors that columns carry.
    fn add_carried(
        &mut self,
        building: &BuildingSystem,
        frame: &SpaceFrame,
        tags: &BTreeMap<(usize, [usize; 2]), usize>,
    ) {
        let nodes = &building.discretization.stick_model.nodes;
        let joints = building.discretization.jointed_frame.iter();
        // Joints on columns that keep their length rise by one node.
        let mut carried = BTreeMap::new();
        for joint in joints.flat_map(|frame| &frame.joints) {
            let tag = tags.get(&(joint.floor + 1, joint.crossing));
            if let (Some(node), Some(tag)) = (joint.nodes[0], tag) {
                carried.insert(node, (*tag, joint.crossing));
            }
        }
        for (node, (tag, crossing)) in carried {
            let (mass, load) = (nodes[node].inertia[2], nodes[node].load);
            if mass != 0.0 || load != 0.0 {
                let _ = writeln!(self.carried, "    ({tag}, {mass:?}, {load:?}),");
                let point = frame.point(crossing);
                self.damped.push(DampedMass {
                    tag,
                    at: [point[0], point[1], nodes[node].y],
                    direction: [1.0, 0.0],
                    inertia: [0.0, mass, 0.0],
                });
            }
        }
    }

    /// A node for an end of a member with hinges, and the springs between it and its joint; returns the node.
    fn add_hinged_end(
        &mut self,
        index: usize,
        building: &BuildingSystem,
        frame: &SpaceFrame,
        joint: usize,
        hinges: &Hinges,
    ) -> Result<usize, &'static str> {
        let tag = self.tag(index, self.next_point[index]);
        self.next_point[index] += 1;
        let sticks = &building.discretization.stick_model;
        let mut sections = building.discretization.sections.iter();
        let place = MemberPlace::InSpace(hinges.place);
        let fibres = sections.find(|section| (section.member, section.end) == (place, hinges.end));
        if let Some(section) = fibres {
            let nodes = match hinges.end {
                MemberEnd::First => [joint, tag],
                MemberEnd::Last => [tag, joint],
            };
            let end = FibreEnd {
                section,
                nodes,
                direction: frame.direction,
            };
            self.add_fibre_end(building, &end)?;
        }
        // Rises, and turns about x and about y of the lines.
        let [stiff, turning] = hinges.stiff;
        let rigid = ProportionalDamping::None;
        let mut springs = self.shear_springs(frame, [joint, tag], hinges)?;
        if fibres.is_some() {
            self.add_springs_of_end(frame, [joint, tag], springs);
            return Ok(tag);
        }
        springs.push((joint, tag, 3, self.materials.elastic(stiff, 0.0), rigid));
        let places = &building.discretization.spring_places;
        for axis in PlanAxis::BOTH {
            let wanted = SpringPlace::InSpace {
                place: hinges.place,
                end: hinges.end,
                axis,
            };
            // Bending along x turns about y.
            let direction = 5 - axis.index();
            let found = places.iter().position(|place| *place == wanted);
            let hinge = found.map(|at| &sticks.hinges[at]);
            springs.push(
                match hinge.and_then(|hinge| Some((hinge, hinge.ends, hinge.hysteresis?))) {
                    Some((hinge, ends, hysteresis)) => {
                        let material = self.materials.yielding(&hysteresis)?;
                        // Strain is that of the second node against the first; the rotation of a hinge counts the other way.
                        let [first, last] = match sticks.space_ends.contains(&ends[0]) {
                            true => [joint, tag],
                            false => [tag, joint],
                        };
                        let damped = hinge.proportional_damping;
                        (first, last, direction, material, damped)
                    }
                    None => {
                        let material = self.materials.elastic(turning, 0.0);
                        (joint, tag, direction, material, rigid)
                    }
                },
            );
        }
        self.add_springs_of_end(frame, [joint, tag], springs);
        self.remark("Ends of members with hinges are joined to their joints by springs of 1e6 times the stiffest member where they have no hinge.");
        Ok(tag)
    }
}

/// A spring at the end of a member: its nodes, direction, material and damping.
type EndSpring = (usize, usize, usize, usize, ProportionalDamping);

impl Script<'_> {
    /// Springs sideways at the end of a column that can fail in shear, and what holds it otherwise in plan; none at other ends, which move
    /// with their joints.
    fn shear_springs(
        &mut self,
        frame: &SpaceFrame,
        [joint, tag]: [usize; 2],
        hinges: &Hinges,
    ) -> Result<Vec<EndSpring>, &'static str> {
        let of_axis = |axis: PlanAxis| {
            let column = frame.shear.get(&(hinges.place, axis))?;
            let fails = hinges.end == MemberEnd::First || column.ends == ShearEnds::Both;
            fails.then_some(&column.spring)
        };
        let found = PlanAxis::BOTH.map(of_axis);
        if found == [None; 2] {
            return Ok(Vec::new());
        }
        let [stiff, turning] = hinges.stiff;
        let rigid = ProportionalDamping::None;
        let mut springs = Vec::new();
        let [first, last] = match hinges.end {
            MemberEnd::First => [joint, tag],
            MemberEnd::Last => [tag, joint],
        };
        for (axis, spring) in PlanAxis::BOTH.into_iter().zip(found) {
            let material = match spring {
                Some(hysteresis) => self.materials.yielding(hysteresis)?,
                None => self.materials.elastic(stiff, 0.0),
            };
            springs.push((first, last, 1 + axis.index(), material, rigid));
        }
        springs.push((first, last, 6, self.materials.elastic(turning, 0.0), rigid));
        Ok(springs)
    }

    fn add_springs_of_end(
        &mut self,
        frame: &SpaceFrame,
        [joint, tag]: [usize; 2],
        springs: Vec<EndSpring>,
    ) {
        let [c, s] = frame.direction;
        let rows = springs
            .into_iter()
            .map(|(first, last, direction, material, damped)| {
                let element = self.element();
                let damped = python_damping(damped);
                format!("({element}, {first}, {last}, {direction}, {material}, {damped})")
            });
        let rows = rows.collect::<Vec<_>>().join(", ");
        let _ = writeln!(
            self.space_hinges,
            "    ({tag}, {joint}, ({c:?}, {s:?}), ({rows})),"
        );
    }
}

/// An end of a member with hinges, and the stiffness of springs that hold it otherwise: vertically, and in rotation.
struct Hinges {
    place: SpacePlace,
    end: MemberEnd,
    stiff: [f64; 2],
}

/// Of springs that stand for a rigid connection \[N/m, N·m/rad\].
fn stiffest(frame: &SpaceFrame, storey_heights: &[f64]) -> [f64; 2] {
    let mut most = [0.0_f64; 2];
    for member in &frame.members {
        let length = frame.length(member.place, storey_heights);
        let section = &member.section;
        let [a, b] = section.flexural_rigidity;
        let bending = a.max(b) / length;
        let axial = section
            .axial_rigidity
            .map_or(0.0, |axial_rigidity| axial_rigidity / length);
        most[0] = most[0].max(axial).max(12.0 * bending / (length * length));
        most[1] = most[1].max(4.0 * bending);
    }
    most.map(|stiffness| STIFF * stiffness)
}
