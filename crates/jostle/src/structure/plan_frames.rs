//! Plane frames at lines of a plan, as lumped masses and massless elements tied to rigid floors.

use std::collections::BTreeMap;
use std::ops::Range;

use super::column_ends::FibreSection;
use super::column_points::PointNode;
use super::diagonals::FrameDiagonal;
use super::discretization::{Discretization, discretize_frame};
use super::element::{THETA, X, Y, index_of, over_nodes};
use super::foundation::followers;
use super::member_forces::FrameMember;
use super::order::Turn;
use super::spring_place::SpringPlace;
use super::stick_model::{Influence, Node, RigidEnd, StickModel, Support};
use super::tiers::motion_at;
use crate::linear::Row;
use crate::model::{
    ColumnLine, Frame, LEVEL_TOLERANCE, LumpedFloor, PlanColumn, PlanFrame, PlanPoint,
    PointsOnColumns, SharedColumn, Tiers,
};

/// Cosines of angles below this count as zero: frames at right angles \[–\].
const PARALLEL: f64 = 1e-9;

/// Adds the frames of a building, whose ground, mat and floors are the nodes of the stick model so far. Feet are tied to the mat, if
/// there is one, as joints are to floors.
///
/// Frames are eliminated one beside the other, and a floor after all joints at its height. `carry_weight`: their columns carry the
/// floors' own masses. `struck`: heights on columns above their feet at which neighbours push them.
pub(super) fn add_frames(
    tiers: &Tiers,
    struck: &BTreeMap<PlanColumn, Vec<f64>>,
    lumped: &[LumpedFloor],
    mat: Option<(usize, &LumpedFloor)>,
    carry_weight: bool,
    discretization: &mut Discretization,
) {
    if tiers.frames.is_empty() {
        return;
    }
    let floors = discretization.floors.clone();
    let sticks = &mut discretization.stick_model;
    // Hinges of a space frame come before.
    let first_place = sticks.hinges.len();
    let shared = tiers.shared_columns();
    let (mut hinge_places, mut shear_places) = (Vec::new(), Vec::new());
    let (mut diagonal_places, mut struck_points) = (Vec::new(), Vec::new());
    for (index, plan_frame) in tiers.frames.iter().enumerate() {
        let points = tiers.points_in_frame(struck, index);
        let mut discretized = discretize(plan_frame, &plan_frame.frame, &points);
        if carry_weight {
            carry_floors(tiers, &shared, index, &mut discretized.stick_model);
        }
        let mut without_columns = plan_frame.frame.clone();
        for column in without_columns.column_sections_mut() {
            column.line_mass = 0.0;
        }
        let light = discretize(plan_frame, &without_columns, &points).stick_model;
        let doubled: Vec<f64> = (0..plan_frame.column_lines())
            .filter(|line| {
                shared
                    .iter()
                    .any(|shared_column| shared_column.lines[1] == [index, *line])
            })
            .map(|line| plan_frame.frame.spans.iter().take(line).sum())
            .collect();
        let place = Place {
            plan_frame,
            elevation: index + 1,
            floors: &floors,
            lumped,
            mat: mat.map(|(node, floor)| (node, floor.tier.centre)),
            doubled: &doubled,
            light: &light,
        };
        let (hinges, diagonals) = discretized
            .stick_model
            .split_places(discretized.spring_places);
        let in_frame = |place: SpringPlace| place.in_frame(index + 1);
        let hinges = hinges.into_iter().filter_map(in_frame);
        let (shear, hinges): (Vec<_>, Vec<_>) = hinges.partition(SpringPlace::is_shear);
        hinge_places.extend(hinges);
        shear_places.extend(shear);
        diagonal_places.extend(diagonals.into_iter().filter_map(in_frame));
        let first_node = sticks.nodes.len();
        let levels: Vec<_> = std::iter::once(mat)
            .chain(floors.iter().copied().zip(lumped).map(Some))
            .map(|level| level.map(|(node, floor)| (node, floor.tier.centre)))
            .collect();
        let nodes = (&discretized.stick_model.nodes[..], first_node);
        struck_points.extend(points_of((index, plan_frame), &points, nodes, &levels));
        let before = [sticks.yielding.len(), sticks.surfaces.len()];
        let elements = sticks.append(discretized.stick_model, &place);
        let [along, across, _] = plan_frame.shares(plan_frame.at);
        let direction = [along, across];
        let diagonals = discretized
            .diagonals
            .into_iter()
            .map(|diagonal| FrameDiagonal {
                frame: Some(index),
                ends: diagonal.ends.map(|end| first_node + end),
                direction,
                elongation: diagonal.elongation.moved_up(index_of((first_node, X))),
                between_joints: diagonal.between_joints.moved_up(index_of((first_node, X))),
                ..diagonal
            });
        discretization.diagonals.extend(diagonals);
        let up = index_of((first_node, X));
        let sections = discretized.sections.into_iter().map(|section| {
            let before = before[usize::from(section.is_surface())];
            let rotations = section.rotations.iter().map(|row| row.moved_up(up));
            FibreSection {
                frame: Some(index),
                elements: before + section.elements.start..before + section.elements.end,
                elongation: section.elongation.moved_up(up),
                rotations: rotations.collect(),
                ..section
            }
        });
        discretization.sections.extend(sections);
        let walls = discretized
            .walls
            .into_iter()
            .map(|wall| wall.in_plan(index));
        discretization.walls.extend(walls);
        let beams = discretized.coupling_beams.into_iter();
        let beams = beams.map(|beam| beam.in_plan(index));
        discretization.coupling_beams.extend(beams);
        let members = discretized.members.into_iter().map(|member| FrameMember {
            frame: Some(index),
            elements: elements.start + member.elements.start..elements.start + member.elements.end,
            ..member
        });
        discretization.members.extend(members);
    }
    let moving = mat.into_iter().map(|(node, _)| node);
    sticks.eliminate_after_joints(moving.chain(floors.iter().copied()), floors[0]);
    // Hinges come before springs, and these before what yields between any points.
    let before = first_place..first_place;
    let places = hinge_places.into_iter().chain(shear_places);
    discretization.spring_places.splice(before, places);
    discretization.spring_places.extend(diagonal_places);
    discretization.frames = tiers
        .frames
        .iter()
        .map(|frame| frame.name.clone())
        .collect();
    discretization
        .points
        .extend(joined(&struck_points, &shared));
    discretization.shared_columns = shared;
}

fn discretize(plan_frame: &PlanFrame, frame: &Frame, points: &PointsOnColumns) -> Discretization {
    discretize_frame(frame, &plan_frame.base, &plan_frame.hinges, points)
}

/// A point of a column of a frame at a line that moves by itself.
struct Point {
    column: [usize; 2],
    storey: usize,
    height: f64,
    mass: f64,
    /// Direction of the frame.
    direction: [f64; 2],
    node: usize,
    /// How it moves at a right angle to the frame, counter-clockwise, if no other frame holds it: with the floors, in proportion to the
    /// distance from them.
    with_floors: Row,
}

/// Points of the columns of a frame. `nodes`: those of the frame, the first of which becomes `first_node`; `levels`: nodes and centres of
/// what it stands on and of all floors.
fn points_of(
    (index, plan_frame): (usize, &PlanFrame),
    points: &PointsOnColumns,
    (nodes, first_node): (&[Node], usize),
    levels: &[Option<(usize, PlanPoint)>],
) -> Vec<Point> {
    let [d_x, d_y, _] = plan_frame.shares(plan_frame.at);
    let heights = &plan_frame.frame.storey_heights;
    let lines = plan_frame.frame.line_positions();
    let all = points.iter().flat_map(|(place, points)| {
        let heights = points.iter().map(|point| point.above);
        heights.map(move |above| (*place, above))
    });
    let found = all.filter_map(|([storey, line], above)| {
        let height = heights[..storey].iter().sum::<f64>() + above;
        // What stands beside it beyond a hinge comes later.
        let node = nodes.iter().position(|node| {
            (node.x - lines[line]).abs() + (node.y - height).abs() <= LEVEL_TOLERANCE
        })?;
        let at = plan_frame.line_at(line);
        let share = above / heights[storey];
        let shares = [(levels[storey], 1.0 - share), (levels[storey + 1], share)];
        let shares = shares
            .into_iter()
            .filter_map(|(level, share)| Some((level?, share)));
        let with_floors = shares.flat_map(|((floor, centre), share)| {
            let [x, y, _] = motion_at(at, centre);
            [X, Y, THETA].map(|component| {
                let moved = d_x * y[component] - d_y * x[component];
                ((floor, component), share * moved)
            })
        });
        Some(Point {
            column: [index, line],
            storey,
            height,
            mass: nodes[node].inertia[X],
            direction: [d_x, d_y],
            node: first_node + node,
            with_floors: over_nodes(with_floors.filter(|(_, share)| *share != 0.0)),
        })
    });
    found.collect()
}

/// Points as they move in plan: along their frame as their nodes, across it with the other frame that has the column, or with the floors.
fn joined(points: &[Point], shared: &[SharedColumn]) -> Vec<PointNode> {
    let along = |point: &Point| Row::single(index_of((point.node, X)));
    let moved = |point: &Point| {
        let [d_x, d_y] = point.direction;
        let other = points.iter().find(|other| {
            let mut columns = shared.iter();
            let is_one = columns.any(|column| {
                column.lines == [point.column, other.column]
                    || column.lines == [other.column, point.column]
            });
            let turned = d_x * other.direction[0] + d_y * other.direction[1];
            is_one
                && turned.abs() <= PARALLEL
                && other.storey == point.storey
                && (other.height - point.height).abs() <= LEVEL_TOLERANCE
        });
        let across = match other {
            Some(other) => along(other).times(d_x * other.direction[1] - d_y * other.direction[0]),
            None => point.with_floors.clone(),
        };
        let along = along(point);
        [
            sum([(d_x, &along), (-d_y, &across)]),
            sum([(d_y, &along), (d_x, &across)]),
        ]
    };
    let nodes = points.iter().map(|point| PointNode {
        column: PlanColumn {
            line: ColumnLine::OfFrame(point.column),
            storey: point.storey,
        },
        height: point.height,
        mass: point.mass,
        moved: moved(point),
        node: point.node,
    });
    nodes.collect()
}

/// Rows times factors, which may be zero.
fn sum(parts: [(f64, &Row); 2]) -> Row {
    let parts = parts.into_iter().filter(|(factor, _)| *factor != 0.0);
    let parts = parts.map(|(factor, row)| row.times(factor));
    parts.reduce(|a, b| a.plus(&b)).unwrap_or_default()
}

/// Lets the joints of a frame carry the floors' own masses: every column that reaches a floor has an equal share. What frames carry by
/// themselves, on beams and at joints, stands in them already.
fn carry_floors(tiers: &Tiers, shared: &[SharedColumn], frame: usize, sticks: &mut StickModel) {
    let is_doubled = |place: [usize; 2]| shared.iter().any(|column| column.lines[1] == place);
    let columns_of = |index: usize, storey: usize| {
        let frame = &tiers.frames[index].frame;
        let reaches = move |line: &usize| frame.column(storey, *line).is_some();
        (0..frame.lines()).filter(move |line| reaches(line) && !is_doubled([index, *line]))
    };
    let tier_frame = &tiers.frames[frame];
    let mut height = 0.0;
    for (storey, storey_height) in tier_frame.frame.storey_heights.iter().enumerate() {
        height += storey_height;
        let all = (0..tiers.frames.len()).map(|index| columns_of(index, storey).count());
        let share = tiers.floors[storey].mass / all.sum::<usize>() as f64;
        for line in columns_of(frame, storey) {
            let along = tier_frame.frame.line_positions()[line];
            // Joints come before what stands beside them beyond hinges.
            let mut nodes = sticks.nodes.iter_mut();
            let joint = nodes
                .find(|node| (node.x - along).abs() + (node.y - height).abs() <= LEVEL_TOLERANCE);
            if let Some(joint) = joint {
                joint.inertia[Y] += share;
            }
        }
    }
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
        let turns: Vec<Turn> = (0..frame.nodes.len())
            .map(|node| frame.turn(node))
            .collect();
        // Rows count displacements of nodes.
        let before = index_of((nodes, X));
        let faces = frame.ties.iter();
        let faces = faces.map(|(index, row)| (before + index, row.moved_up(before)));
        let faces: Vec<(usize, Row)> = faces.collect();
        self.ties.extend(faces.iter().cloned());
        self.rigid_ends
            .extend(frame.rigid_ends.iter().map(|rigid_end| RigidEnd {
                joint: nodes + rigid_end.joint,
                member: members + rigid_end.member,
                ..*rigid_end
            }));
        let origin = place.plan_frame.at;
        let [along, across, _] = place.plan_frame.shares(origin);
        let direction = [along, across];
        let mut feet = Vec::new();
        for (index, node) in frame.nodes.into_iter().enumerate() {
            let (node, floor) = self.node_in_plan(index, &node, place);
            // What slides has the mass of its joint with it, but not its displacement.
            if let Some(floor) = floor.filter(|_| !frame.slides.contains(&index)) {
                let components = [X, Y, THETA].map(|component| (floor, component));
                let shares = node.influence[X].horizontal();
                let moved = over_nodes(components.into_iter().zip(shares));
                self.ties.insert(index_of((self.nodes.len(), X)), moved);
            }
            let turn = Turn {
                elevation: place.elevation,
                ..turns[index]
            };
            let foot = node.support == Support::Fixed;
            let mut node = node;
            if foot && self.rocks() {
                // Its mass rises with the base.
                node.support = Support::Free;
            }
            let number = self.nodes.len();
            let at = [0, 1].map(|axis| origin[axis] + node.x * direction[axis]);
            self.turns.insert(number, turn);
            self.nodes.push(node);
            self.note_rise((number, Y), at);
            feet.extend(foot.then_some(number));
        }
        let moved = |ends: [usize; 2]| ends.map(|end| nodes + end);
        self.members
            .extend(frame.members.into_iter().map(|mut member| {
                member.ends = moved(member.ends);
                member
            }));
        self.hinges
            .extend(frame.hinges.into_iter().map(|mut hinge| {
                hinge.ends = moved(hinge.ends);
                hinge
            }));
        self.springs
            .extend(frame.springs.into_iter().map(|mut spring| {
                spring.ends = moved(spring.ends);
                spring
            }));
        self.elements.extend(
            frame
                .elements
                .into_iter()
                .map(|element| element.moved_up(before)),
        );
        self.yielding
            .extend(frame.yielding.into_iter().map(|mut yielding| {
                yielding.row = yielding.row.moved_up(before);
                yielding
            }));
        self.surfaces
            .extend(frame.surfaces.into_iter().map(|mut element| {
                element.row = element.row.moved_up(before);
                element
            }));
        if self.rocks() {
            for component in [Y, THETA] {
                let followers = followers(self, &feet, component).into_iter().enumerate();
                for (node, _) in followers.filter(|(_, foot)| foot.is_some()) {
                    match component {
                        Y => self.raise((node, Y)),
                        _ => self.turn_foot(node, direction),
                    }
                }
            }
        }
        // Ends of columns follow joints, which now follow floors, or rise with a base that rocks.
        for (index, row) in faces {
            let carried = self.carried_row(&row);
            self.ties.insert(index, carried);
        }
        members..self.members.len()
    }

    /// Places of springs that yield, in their order: those of hinges and storeys, and those between any points.
    fn split_places(&self, mut places: Vec<SpringPlace>) -> (Vec<SpringPlace>, Vec<SpringPlace>) {
        let others = places.split_off(places.len() - self.yielding.len());
        (places, others)
    }

    /// A node of a frame as it stands in the plan, and the floor or the mat with which it moves along its line.
    fn node_in_plan(&self, index: usize, node: &Node, place: &Place<'_>) -> (Node, Option<usize>) {
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
        let [along, across, turning] = place.plan_frame.shares(centre);
        let in_line = Influence {
            along,
            across,
            turning,
            up: 0.0,
        };
        let is_counted_elsewhere = carrier.is_some() || on_floor || is_doubled;
        let node = Node {
            mass: match is_counted_elsewhere {
                true => 0.0,
                false => node.mass,
            },
            // The floor has the mass of what moves with it along the line; each of two frames that share a column moves all of it.
            inertia: [
                if carrier.is_some() { 0.0 } else { node.mass },
                match is_doubled {
                    true => place.light.nodes[index].inertia[Y],
                    false => node.inertia[Y],
                },
                node.inertia[THETA],
            ],
            influence: [in_line, Influence::UP, Influence::NONE],
            ..*node
        };
        (node, carrier)
    }
}
