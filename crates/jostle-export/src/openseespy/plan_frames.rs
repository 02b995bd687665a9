//! Frames at lines of a plan: plane frames that stand upright in a model in space, whose joints move with the floors.
//!
//! A joint rises and turns in the plane of its frame by itself. Members have no stiffness across this plane and none in torsion, so a soft
//! spring that keeps joints from turning across it has no force.

use std::collections::BTreeMap;
use std::fmt::Write;

use jostle::structure::{Hinge, StickModel, Support, Turn};
use jostle::system::BuildingSystem;
use jostle::{PlanFrame, ProportionalDamping, Tiers};

use super::arms::{self, Stiffness};
use super::fibres::FibreEnd;
use super::panels::Panels;
use super::plan_base::DampedMass;
use super::script::{Script, python_damping, rounded};
use super::ties::{COMPONENTS, Ties, is_held, is_vertical, stiffnesses};

/// Stiffness of springs that join a member to its joint where it has no hinge, in units of the stiffest member \[–\].
const STIFF: f64 = 1e6;

/// Directions of OpenSees, along a line, upwards and about the axis across both, of the displacements in the plane of a frame.
const DIRECTIONS: [usize; COMPONENTS] = [1, 3, 5];

impl Script<'_> {
    /// Joints, members, hinges, fibres and diagonals of all frames of a building.
    pub(super) fn add_plan_frames(
        &mut self,
        index: usize,
        building: &BuildingSystem,
        tiers: &Tiers,
    ) -> Result<(), &'static str> {
        let discretization = &building.discretization;
        let stick_model = &discretization.stick_model;
        let frames: BTreeMap<usize, &PlanFrame> = (0..stick_model.nodes.len())
            .filter_map(|node| {
                let number = stick_model.turn(node).elevation.checked_sub(1)?;
                Some((node, tiers.frames.get(number)?))
            })
            .collect();
        let ties = Ties::new(stick_model);
        let held = |node: usize, component: usize| {
            is_held(stick_model, node, component) || ties.held.contains(&(node, component))
        };
        self.add_upright_joints(index, stick_model, &frames, held);
        let stiff = Stiffness::of(stick_model, |_| true).times(STIFF);
        for member in &stick_model.members {
            let [mut a, mut b] = member.ends;
            let Some(frame) = frames.get(&a) else {
                continue;
            };
            let nodes = &stick_model.nodes;
            if nodes[a].x + nodes[a].y > nodes[b].x + nodes[b].y {
                (a, b) = (b, a);
            }
            let vertical = is_vertical(stick_model, member.ends);
            if vertical && member.axial_rigidity.is_none() && !(held(a, 1) && held(b, 1)) {
                self.remark("Columns that keep their length are given EA = 1e4 * 12 EI / l^2.");
            }
            self.add_upright_member(
                [a, b].map(|node| self.tag(index, node)),
                (vertical, frame.direction),
                [
                    Some(member.flexural_rigidity),
                    member.axial_rigidity,
                    member.shear_rigidity,
                ],
            );
        }
        for hinge in &stick_model.hinges {
            let Some(frame) = frames.get(&hinge.ends[0]) else {
                continue;
            };
            if let Some(component) = arms::arm(stick_model, hinge) {
                let [joint, end] = hinge.ends.map(|node| stick_model.nodes[node]);
                let length = arms::length(stick_model, hinge.ends);
                let stiff = Stiffness::of_arm(stick_model, hinge);
                let rigidity = stiff.turning * length;
                let mut ends = hinge.ends;
                if end.x + end.y < joint.x + joint.y {
                    ends.reverse();
                }
                self.add_upright_member(
                    ends.map(|node| self.tag(index, node)),
                    (component == 0, frame.direction),
                    [Some(rigidity), Some(stiff.moving * length), None],
                );
                self.remark(arms::REMARK);
                continue;
            }
            self.add_upright_hinge(index, stick_model, hinge, frame, (&stiff, held))?;
        }
        self.add_upright_fibres(index, building, &frames)?;
        self.add_upright_slides(index, building, &frames)?;
        // Columns that fail in shear.
        for spring in &stick_model.springs {
            let Some(frame) = frames.get(&spring.ends[0]) else {
                continue;
            };
            let ends = spring.ends.map(|node| self.tag(index, node));
            for material in
                self.spring_materials(spring.stiffness, spring.hysteresis.as_ref(), spring.dashpot)?
            {
                let along = (DIRECTIONS[0], material);
                let damped = spring.proportional_damping;
                self.add_upright_spring(ends, frame.direction, along, damped);
            }
        }
        let mut panels = Panels::default();
        for diagonal in &discretization.diagonals {
            if diagonal.frame.is_some() {
                let ends = diagonal.ends.map(|node| self.tag(index, node));
                let first = self.next_element;
                self.add_diagonal(stick_model, diagonal, ends)?;
                panels.add(diagonal, first..self.next_element);
            }
        }
        self.add_panels(index, building, panels);
        Ok(())
    }

    fn add_upright_joints(
        &mut self,
        index: usize,
        stick_model: &StickModel,
        frames: &BTreeMap<usize, &PlanFrame>,
        held: impl Fn(usize, usize) -> bool,
    ) {
        for (number, frame) in frames {
            let node = stick_model.nodes[*number];
            let tag = self.tag(index, *number);
            let floor = floor_of(stick_model, *number);
            let on = floor.map_or_else(
                || "None".to_owned(),
                |floor| self.tag(index, floor).to_string(),
            );
            let [x, y] = frame.point_at(node.x).map(rounded);
            let [c, s] = frame.direction;
            if rides(stick_model, *number) {
                let _ = writeln!(self.riding, "    ({on}, {tag}),");
            }
            let holds = [0, 1, 2].map(|component| usize::from(held(*number, component)));
            let moving = node.support != Support::Fixed;
            let [mass, rising, turning] = match moving {
                true => node.inertia,
                false => [0.0; COMPONENTS],
            };
            let _ = writeln!(
                self.upright,
                "    ({tag}, {x:?}, {y:?}, {:?}, {on}, ({c:?}, {s:?}), ({}, {}, {}), {mass:?}, {turning:?}),",
                rounded(node.y),
                holds[0],
                holds[1],
                holds[2],
            );
            if moving {
                self.damped.push(DampedMass {
                    tag,
                    at: [x, y, node.y],
                    direction: frame.direction,
                    inertia: [mass, rising, turning],
                });
            }
            if holds[1] == 0 && (rising != 0.0 || node.load != 0.0) {
                let _ = writeln!(self.carried, "    ({tag}, {rising:?}, {:?}),", node.load);
            }
        }
    }

    /// A column or a beam: EI, EA and G As in the plane of its frame.
    fn add_upright_member(
        &mut self,
        [first, last]: [usize; 2],
        (vertical, [c, s]): (bool, [f64; 2]),
        rigidities: [Option<f64>; 3],
    ) {
        let towards = if vertical {
            [c, s, 0.0]
        } else {
            [0.0, 0.0, 1.0]
        };
        let element = self.element();
        let text = |value: Option<f64>| {
            value.map_or_else(|| "None".to_owned(), |value| format!("{value:?}"))
        };
        let [bending, axial, _] = rigidities.map(text);
        let shear = rigidities[2];
        let shear = shear.map_or_else(
            || "None".to_owned(),
            |value| format!("({value:?}, {value:?})"),
        );
        let _ = writeln!(
            self.space_members,
            "    ({element}, {first}, {last}, {bending}, 0.0, 0.0, {axial}, {shear}, ({:?}, {:?}, {:?})),",
            towards[0], towards[1], towards[2],
        );
    }

    fn add_upright_hinge(
        &mut self,
        index: usize,
        stick_model: &StickModel,
        hinge: &Hinge,
        frame: &PlanFrame,
        (stiff, held): (&Stiffness, impl Fn(usize, usize) -> bool),
    ) -> Result<(), &'static str> {
        // Rotations in the plane of the frame count the other way about the axis across it.
        let ends = hinge.ends;
        let tags = ends.map(|node| self.tag(index, node));
        for (component, stiffness) in stiffnesses(hinge).into_iter().enumerate() {
            let materials = match stiffness {
                None => {
                    let follow = |node: &usize| {
                        held(*node, component)
                            || component == 0 && floor_of(stick_model, *node).is_some()
                    };
                    if ends.iter().all(follow) {
                        continue;
                    }
                    let rigid = match component {
                        2 => stiff.turning,
                        _ => stiff.moving,
                    };
                    self.remark("Ends of members with hinges are joined to their joints by springs of 1e6 times the stiffest member where they have no hinge.");
                    vec![(
                        self.materials.elastic(rigid, 0.0),
                        ProportionalDamping::None,
                    )]
                }
                Some(stiffness) => {
                    let hysteresis = hinge.hysteresis.as_ref().filter(|_| component == 2);
                    let dashpot = hinge.dashpots[component];
                    let materials = self.spring_materials(stiffness, hysteresis, dashpot)?;
                    let damped = |material| (material, hinge.proportional_damping);
                    materials.into_iter().map(damped).collect()
                }
            };
            for (material, damped) in materials {
                self.add_upright_spring(
                    tags,
                    frame.direction,
                    (DIRECTIONS[component], material),
                    damped,
                );
            }
        }
        Ok(())
    }

    pub(super) fn add_upright_spring(
        &mut self,
        [first, last]: [usize; 2],
        [c, s]: [f64; 2],
        (direction, material): (usize, usize),
        damped: ProportionalDamping,
    ) {
        let element = self.element();
        let damped = python_damping(damped);
        let _ = writeln!(
            self.upright_springs,
            "    ({element}, {first}, {last}, {direction}, {material}, {damped}, ({c:?}, {s:?})),"
        );
    }

    fn add_upright_fibres(
        &mut self,
        index: usize,
        building: &BuildingSystem,
        frames: &BTreeMap<usize, &PlanFrame>,
    ) -> Result<(), &'static str> {
        for section in &building.discretization.sections {
            let mut nodes = [0; 2];
            let mut line = None;
            for (place, share) in section.elongation.entries() {
                let node = place / COMPONENTS;
                nodes[usize::from(*share > 0.0)] = self.tag(index, node);
                line = frames.get(&node);
            }
            if let Some(frame) = line {
                let end = FibreEnd {
                    section,
                    nodes,
                    direction: frame.direction,
                };
                self.add_fibre_end(building, &end)?;
            }
        }
        Ok(())
    }

    /// Walls that slide at their feet, and coupling beams that yield in shear.
    fn add_upright_slides(
        &mut self,
        index: usize,
        building: &BuildingSystem,
        frames: &BTreeMap<usize, &PlanFrame>,
    ) -> Result<(), &'static str> {
        let discretization = &building.discretization;
        for (number, element) in discretization.stick_model.yielding.iter().enumerate() {
            let mut sections = discretization.sections.iter();
            if sections.any(|section| section.elements.contains(&number)) {
                continue;
            }
            let [(a, share), (b, _)] = *element.row.entries() else {
                continue;
            };
            let [first, last] = if share < 0.0 { [a, b] } else { [b, a] };
            let Some(frame) = frames.get(&(first / COMPONENTS)) else {
                continue;
            };
            let nodes = [first, last].map(|place| self.tag(index, place / COMPONENTS));
            let material = self.materials.yielding(&element.hysteresis)?;
            let along = (DIRECTIONS[first % COMPONENTS], material);
            self.add_upright_spring(nodes, frame.direction, along, element.proportional_damping);
        }
        Ok(())
    }
}

/// Whether a node stands in a frame at a line of a plan.
fn stands_in_frame(stick_model: &StickModel, node: usize) -> bool {
    (1..Turn::FLOORS).contains(&stick_model.turn(node).elevation)
}

/// Whether feet of frames slide on a base that rocks.
pub(super) fn slides_on_rocking_base(stick_model: &StickModel) -> bool {
    let mut nodes = 0..stick_model.nodes.len();
    nodes.any(|node| {
        stands_in_frame(stick_model, node)
            && rides(stick_model, node)
            && floor_of(stick_model, node).is_none()
    })
}

/// Whether a node at the foot of a frame rises and turns with a base that rocks.
fn rides(stick_model: &StickModel, node: usize) -> bool {
    let follows = |component: &usize| {
        stick_model
            .ties
            .contains_key(&(COMPONENTS * node + component))
    };
    stick_model.nodes[node].y == 0.0 && [1, 2].iter().all(follows)
}

/// The floor or mat with which a node moves along the line of its frame. Rigid ends of columns follow the rotation of their joint as well.
fn floor_of(stick_model: &StickModel, node: usize) -> Option<usize> {
    let row = stick_model.ties.get(&(COMPONENTS * node))?;
    let mut nodes = row.entries().iter().map(|(place, _)| place / COMPONENTS);
    let floor = nodes.next()?;
    (!stands_in_frame(stick_model, floor) && nodes.all(|other| other == floor)).then_some(floor)
}
