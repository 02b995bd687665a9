//! The grounds of a run: one under all buildings, or one under each.
//!
//! Joints are counted as contacts, then links, then friction along contacts, then ends of edges.

use super::{Direction, System};
use crate::interface::PortPair;
use crate::motion::{Ground, GroundMotion, GroundPath, GroundPoint, Side};

/// How the grounds of a run move, now and at the end of the tried step.
#[derive(Clone, Debug, Default)]
pub(crate) struct RunGrounds<'a> {
    /// Of the buildings of the system, then of its walls; empty where one ground is under all.
    paths: Vec<GroundPath<'a>>,
    points: [Vec<GroundPoint>; 2],
    /// Numbers of buildings and of walls of the model.
    structures: usize,
    walls: usize,
    /// Of every joint between grounds that move apart.
    sides: Vec<Option<JointGrounds>>,
    in_space: bool,
    /// Whether any of them do.
    pub(crate) part: bool,
}

/// The grounds of the two sides of a joint.
#[derive(Clone, Copy, Debug)]
struct JointGrounds {
    /// Among the paths.
    grounds: [usize; 2],
    /// In which direction their distance counts: along the row and across it \[–\].
    direction: [f64; 2],
}

impl JointGrounds {
    /// A difference of both grounds, of the first less the second, in the direction of the joint.
    #[inline]
    fn apart(&self, of: impl Fn(usize) -> [f64; 2]) -> f64 {
        let [first, second] = self.grounds.map(of);
        let [along, across] = self.direction;
        along * (first[0] - second[0]) + across * (first[1] - second[1])
    }
}

/// In which direction in plan a joint closes: the sums of its row over displacements along and across \[–\].
fn direction_of(system: &System, ports: &PortPair) -> [f64; 2] {
    let mut direction = [1.0, 0.0];
    if !system.is_in_space() {
        return direction;
    }
    if let Some(port) = ports.0.iter().flatten().next() {
        direction = [0.0; 2];
        let building = &system.buildings[port.building];
        if let (Some(wall), None) = (&building.support, building.discretization.mat) {
            return wall.direction.map(|share| share * port.row.entries()[0].1);
        }
        let mat = building.mat_in_plan.as_ref().map(|mat| mat.dofs);
        for &(dof, weight) in port.row.entries() {
            let mut tracks = building.tracks.iter();
            let track = tracks.find(|track| track.dof == dof);
            let moves = |axis: usize, direction: Direction| {
                mat.is_some_and(|mat| mat[axis] == dof)
                    || track.is_some_and(|track| track.direction == direction)
            };
            if moves(0, Direction::Along) {
                direction[0] += weight;
            } else if moves(1, Direction::Across) {
                direction[1] += weight;
            }
        }
    }
    direction
}

/// Ground accelerations at one instant.
#[derive(Clone, Copy, Debug)]
pub(crate) struct GroundsAt<'a> {
    /// Of the common motion \[m/s²\].
    pub(crate) common: Ground,
    own: &'a [GroundPoint],
}

impl GroundsAt<'_> {
    /// One ground under all buildings.
    pub(crate) fn common(ground: Ground) -> Self {
        Self {
            common: ground,
            own: &[],
        }
    }

    /// Ground acceleration of a building of the system \[m/s²\].
    #[inline]
    pub(crate) fn of(&self, building: usize) -> Ground {
        self.own
            .get(building)
            .map_or(self.common, |point| point.acceleration)
    }

    /// Whether buildings have grounds of their own.
    pub(crate) fn is_split(&self) -> bool {
        !self.own.is_empty()
    }
}

impl<'a> RunGrounds<'a> {
    pub(crate) fn new(system: &System, motion: &'a GroundMotion) -> Self {
        if motion.grounds.is_none() {
            return Self::default();
        }
        let structures = system.structures().len();
        // Grounds are listed by building and wall of the model, paths by building of the system, then by wall.
        let of_wall = |wall: usize| structures + wall;
        let of_building = |building: usize| {
            let mut walls = system.walls.iter();
            let wall = walls.position(|wall| wall.building == Some(building));
            wall.map_or(building, of_wall)
        };
        let listed: Vec<usize> = (0..system.buildings.len())
            .map(of_building)
            .chain((0..system.walls.len()).map(of_wall))
            .collect();
        let paths: Vec<GroundPath<'_>> =
            listed.iter().map(|ground| motion.under(*ground)).collect();
        let side = |ports: &PortPair, walls: [Option<usize>; 2], side: usize| {
            let wall = walls[side].map(|wall| system.buildings.len() + wall);
            ports.buildings()[side].or(wall)
        };
        let joint = |ports: &PortPair, walls: [Option<usize>; 2]| {
            let grounds = [side(ports, walls, 0)?, side(ports, walls, 1)?];
            let [left, right] = grounds.map(|ground| listed[ground]);
            (!motion.moves_alike(left, right)).then(|| JointGrounds {
                grounds,
                direction: direction_of(system, ports),
            })
        };
        let rigid = |index: usize| system.rigid_walls.get(index).copied().unwrap_or_default();
        let first_link = system.contacts.len();
        let contacts = system.contacts.iter().enumerate();
        let rubbing = contacts.clone().filter_map(|(index, contact)| {
            let friction = contact.friction.as_ref()?;
            Some(joint(&friction.ports, rigid(index)))
        });
        let contacts = contacts.map(|(index, contact)| joint(&contact.ports, rigid(index)));
        let links = system.links.iter().enumerate();
        let links = links.map(|(index, link)| joint(&link.ports, rigid(first_link + index)));
        let ends = system.edge_ends.iter();
        let ends = ends.map(|end| joint(&end.ports, rigid(end.contact)));
        let sides: Vec<_> = contacts.chain(links).chain(rubbing).chain(ends).collect();
        let start: Vec<GroundPoint> = paths.iter().map(|path| path.at(0.0)).collect();
        Self {
            part: sides.iter().any(Option::is_some),
            points: [start.clone(), start],
            structures,
            walls: system.walls.len(),
            paths,
            sides,
            in_space: system.is_in_space(),
        }
    }

    /// Moves the end of the tried step to an instant \[s\].
    pub(crate) fn try_end(&mut self, t: f64) {
        for (point, path) in self.points[1].iter_mut().zip(&self.paths) {
            *point = path.on_side(t, Side::Before);
        }
    }

    /// The tried step has been accepted. Until the next is tried, (1) is its start.
    pub(crate) fn accept(&mut self) {
        self.points.swap(0, 1);
    }

    /// What the ground acceleration of a building jumps by now, which is `t` \[m/s²\].
    pub(crate) fn jump(&self, building: usize, t: f64) -> Ground {
        match (self.paths.get(building), self.points[0].get(building)) {
            (Some(path), Some(point)) => {
                let after = path.at(t).acceleration;
                [0, 1, 2].map(|axis| after[axis] - point.acceleration[axis])
            }
            _ => [0.0; 3],
        }
    }

    /// Moves past a jump of the accelerations at `t`.
    pub(crate) fn pass_jump(&mut self, t: f64) {
        for (point, path) in self.points[0].iter_mut().zip(&self.paths) {
            *point = path.at(t);
        }
    }

    /// The first corner of any ground after `t`; only jumps of accelerations unless `corners` are asked for \[s\].
    pub(crate) fn next_corner(&self, t: f64, corners: bool) -> Option<f64> {
        let all = self.paths.iter();
        let first = all.filter_map(|path| path.next_corner(t, corners));
        let first = first.fold(f64::INFINITY, f64::min);
        first.is_finite().then_some(first)
    }

    /// Accelerations now (0), or at the end of the tried step (1).
    pub(crate) fn at(&self, time: usize, common: Ground) -> GroundsAt<'_> {
        GroundsAt {
            common,
            own: &self.points[time],
        }
    }

    /// How much closer the grounds of a joint have moved, and the rate and the acceleration of that; now (0), or at the end of
    /// the tried step (1) \[m, m/s, m/s²\].
    #[inline]
    pub(crate) fn closing(&self, joint: usize, time: usize) -> [f64; 3] {
        let Some(Some(joint)) = self.sides.get(joint) else {
            return [0.0; 3];
        };
        let points = &self.points[time];
        [
            joint.apart(|ground| points[ground].displacement),
            joint.apart(|ground| points[ground].velocity),
            joint.apart(|ground| {
                let [along, across, _] = points[ground].acceleration;
                [along, across]
            }),
        ]
    }

    /// How much closer the grounds of a joint have moved at an instant \[m\].
    pub(crate) fn closing_at(&self, joint: usize, t: f64) -> f64 {
        let Some(Some(joint)) = self.sides.get(joint) else {
            return 0.0;
        };
        joint.apart(|ground| self.paths[ground].at(t).displacement)
    }

    /// Displacement of the ground of every building and wall of the model now, in its order: along the row, then those across
    /// of buildings in space \[m\].
    pub(crate) fn displacements(&self) -> impl Iterator<Item = f64> {
        let (buildings, others) = self.points[0].split_at(self.structures);
        let walls = &others[others.len() - self.walls.min(others.len())..];
        let axes = 0..1 + usize::from(self.in_space);
        axes.flat_map(move |axis| {
            let all = buildings.iter().chain(walls);
            all.map(move |point| point.displacement[axis])
        })
    }

    /// Number of buildings and walls of the model.
    pub(crate) fn places(&self) -> usize {
        self.structures + self.walls
    }

    /// Number of joints whose grounds may move apart: none, or all.
    pub(crate) fn joints(&self) -> usize {
        if self.part { self.sides.len() } else { 0 }
    }

    /// How the grounds of a joint move over the tried step, whose length is `step` \[s\].
    pub(crate) fn over_step(&self, joint: usize, step: f64) -> OverStep {
        let [d, v, a] = self.closing(joint, 0);
        let [end, _, last] = self.closing(joint, 1);
        let (h, rise) = (step, last - a);
        OverStep {
            ends: [d, end],
            area: h * (d + h * (v / 2.0 + h * (a / 6.0 + rise / 24.0))),
            moment: h * (d / 2.0 + h * (v / 3.0 + h * (a / 8.0 + rise / 30.0))),
        }
    }
}

/// How much closer two grounds are over a step: a cubic D.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct OverStep {
    ends: [f64; 2],
    /// ∫ D dt \[m·s\].
    pub(crate) area: f64,
    /// ∫ τ D dt, with τ from 0 to 1 over the step \[m·s\].
    pub(crate) moment: f64,
}

impl OverStep {
    /// ∫ F Ḋ dt of a force F₀ + (F₁ − F₀)τ + b(τ² − τ), by parts \[J\].
    pub(crate) fn work(&self, [first, last]: [f64; 2], bend: f64, step: f64) -> f64 {
        let leaning = 2.0 * self.moment - self.area;
        last * self.ends[1]
            - first * self.ends[0]
            - (last - first) * self.area / step
            - bend * leaning / step
    }
}
