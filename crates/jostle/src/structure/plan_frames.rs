//! Plane frames at lines of a plan, as lumped masses and massless elements tied to rigid floors.

use std::ops::Range;

use super::diagonals::FrameDiagonal;
use super::discretization::{Discretization, discretize_frame};
use super::element::{THETA, X, Y, index_of, over_nodes};
use super::member_forces::FrameMember;
use super::order::Turn;
use super::spring_place::SpringPlace;
use super::stick_model::{FrameNode, Node, StickModel, Support};
use crate::model::{Frame, LEVEL_TOLERANCE, LumpedFloor, PlanFrame, PlanPoint, Tiers};

/// Adds the frames of a building, whose ground, mat and floors are the nodes of the stick model so far. Feet are tied to the mat, if
/// there is one, as joints are to floors.
///
/// Frames are eliminated one beside the other, and a floor after all joints at its height.
pub(super) fn add_frames(
    tiers: &Tiers,
    lumped: &[LumpedFloor],
    mat: Option<(usize, &LumpedFloor)>,
    discretization: &mut Discretization,
) {
    if tiers.frames.is_empty() {
        return;
    }
    let floors = discretization.floors.clone();
    let sticks = &mut discretization.stick_model;
    // Hinges of a space frame come before.
    let first_place = sticks.hinges.len();
    sticks.frame_nodes.resize(sticks.nodes.len(), None);
    let shared = tiers.shared_columns();
    let (mut hinge_places, mut diagonal_places) = (Vec::new(), Vec::new());
    for (index, plan_frame) in tiers.frames.iter().enumerate() {
        let own = discretize(plan_frame, &plan_frame.frame);
        let mut without_columns = plan_frame.frame.clone();
        for column in without_columns.column_sections_mut() {
            column.line_mass = 0.0;
        }
        let light = discretize(plan_frame, &without_columns).stick_model;
        let doubled: Vec<f64> = (0..plan_frame.column_lines())
            .filter(|line| shared.iter().any(|own| own.lines[1] == [index, *line]))
            .map(|line| plan_frame.frame.spans.iter().take(line).sum())
            .collect();
        let place = Place {
            plan_frame,
            elevation: index + 1,
            floors: &floors,
            lumped,
            mat: mat.map(|(node, own)| (node, own.tier.centre)),
            doubled: &doubled,
            light: &light,
        };
        let (hinges, diagonals) = own.stick_model.split_places(own.spring_places);
        let in_frame = |place: SpringPlace| place.in_frame(index + 1);
        hinge_places.extend(hinges.into_iter().filter_map(in_frame));
        diagonal_places.extend(diagonals.into_iter().filter_map(in_frame));
        let first_node = sticks.nodes.len();
        let elements = sticks.append(own.stick_model, &place);
        let diagonals = own.diagonals.into_iter().map(|own| FrameDiagonal {
            frame: Some(index),
            ends: own.ends.map(|end| first_node + end),
            elongation: own.elongation.moved_up(index_of((first_node, X))),
            ..own
        });
        discretization.diagonals.extend(diagonals);
        let members = own.members.into_iter().map(|member| FrameMember {
            frame: Some(index),
            elements: elements.start + member.elements.start..elements.start + member.elements.end,
            ..member
        });
        discretization.members.extend(members);
    }
    let mat = mat.into_iter();
    let moving: Vec<_> = mat.chain(floors.iter().copied().zip(lumped)).collect();
    sticks.eliminate_after_joints(moving.iter().map(|(node, _)| *node), floors[0]);
    for (node, lumped) in &moving {
        for (component, mass) in [X, Y].into_iter().zip(lumped.one_way) {
            if mass > 0.0 {
                sticks.one_way_masses.push((*node, component, mass));
            }
        }
    }
    // Hinges come before springs.
    let before = first_place..first_place;
    discretization.spring_places.splice(before, hinge_places);
    discretization.spring_places.extend(diagonal_places);
    discretization.frames = tiers.frames.iter().map(|own| own.name.clone()).collect();
    discretization.shared_columns = shared;
}

fn discretize(plan_frame: &PlanFrame, frame: &Frame) -> Discretization {
    discretize_frame(frame, &plan_frame.base, &plan_frame.hinges, [&[], &[]])
}

/// Where a frame stands.
struct Place<'a> {
    plan_frame: &'a PlanFrame,
    /// Its number, from 1; what belongs to no plane frame comes before.
    elevation: usize,
    floors: &'a [usize],
    lumped: &'a [LumpedFloor],
    /// Node and centre of the mat on which it stands.
    mat: Option<(usize, PlanPoint)>,
    /// Column lines whose mass another frame counts, as distances from its first one \[m\].
    doubled: &'a [f64],
    /// The frame with columns that have no mass.
    light: &'a StickModel,
}

impl StickModel {
    /// Has floors, and the mat, follow all joints at their height: they couple all that stands on them.
    pub(super) fn eliminate_after_joints(
        &mut self,
        floors: impl Iterator<Item = usize>,
        lowest: usize,
    ) {
        let lowest = self.nodes[lowest].y;
        for floor in floors {
            let turn = Turn::of_floor(self.nodes[floor].y, lowest);
            self.turns.insert(floor, turn);
        }
    }

    /// Appends the nodes and elements of a frame; returns the range of its members.
    fn append(&mut self, frame: StickModel, place: &Place<'_>) -> Range<usize> {
        let (nodes, members) = (self.nodes.len(), self.members.len());
        for (index, node) in frame.nodes.into_iter().enumerate() {
            let (own, floor) = self.frame_node(index, &node, place);
            self.frame_nodes.push(Some(own));
            if let Some(floor) = floor {
                let components = [X, Y, THETA].map(|component| (floor, component));
                let moved = over_nodes(components.into_iter().zip(own.shares));
                self.ties.insert(index_of((self.nodes.len(), X)), moved);
            }
            let turn = Turn {
                stage: None,
                height: node.y,
                elevation: place.elevation,
                position: node.x,
            };
            self.turns.insert(self.nodes.len(), turn);
            self.nodes.push(node);
        }
        let moved = |ends: [usize; 2]| ends.map(|end| nodes + end);
        self.members
            .extend(frame.members.into_iter().map(|mut own| {
                own.ends = moved(own.ends);
                own
            }));
        self.hinges.extend(frame.hinges.into_iter().map(|mut own| {
            own.ends = moved(own.ends);
            own
        }));
        self.springs
            .extend(frame.springs.into_iter().map(|mut own| {
                own.ends = moved(own.ends);
                own
            }));
        // Rows count displacements of nodes.
        let before = index_of((nodes, X));
        self.elements
            .extend(frame.elements.into_iter().map(|own| own.moved_up(before)));
        self.yielding
            .extend(frame.yielding.into_iter().map(|mut own| {
                own.row = own.row.moved_up(before);
                own
            }));
        members..self.members.len()
    }

    /// Places of springs that yield, in their order: those of hinges and storeys, and those between any points.
    fn split_places(&self, mut places: Vec<SpringPlace>) -> (Vec<SpringPlace>, Vec<SpringPlace>) {
        let others = places.split_off(places.len() - self.yielding.len());
        (places, others)
    }

    /// A node of a frame, and the floor or the mat to which it belongs: its displacement along its line is that of the floor.
    fn frame_node(
        &self,
        index: usize,
        node: &Node,
        place: &Place<'_>,
    ) -> (FrameNode, Option<usize>) {
        let height = |floor: &usize| self.nodes[*floor].y;
        let mut floors = place.floors.iter();
        let level = floors.position(|floor| node.y <= height(floor) + LEVEL_TOLERANCE);
        let level = level.unwrap_or(place.floors.len() - 1);
        let floor = place.floors[level];
        let on_floor = (node.y - height(&floor)).abs() <= LEVEL_TOLERANCE;
        let is_doubled = place.doubled.contains(&node.x);
        let (carrier, centre) = match place.mat.filter(|_| node.y <= LEVEL_TOLERANCE) {
            Some((mat, centre)) => (Some(mat), centre),
            None => (
                Some(floor).filter(|_| on_floor && node.support != Support::Fixed),
                place.lumped[level].tier.centre,
            ),
        };
        let own = FrameNode {
            shares: place.plan_frame.shares(centre),
            at_mat: place
                .mat
                .map_or([0.0; 3], |(_, centre)| place.plan_frame.shares(centre)),
            level,
            counted_elsewhere: carrier.is_some() || on_floor || is_doubled,
            vertical_mass: match is_doubled {
                true => place.light.nodes[index].mass,
                false => node.mass,
            },
        };
        (own, carrier)
    }
}
