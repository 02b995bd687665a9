//! Modal loads of contact forces, and their response over a step.

use std::ops::Range;

use super::links::{LinkTable, closings};
use super::plan_rows::PlanRows;
use super::reduced::{Reduced, Shown};
use crate::simd;

/// A force that pushes the faces of a contact apart, as the modes of the buildings on both sides feel it.
pub(super) struct UnitForce {
    /// These buildings, their modes and what is watched of them, among all.
    buildings: Range<usize>,
    pub(super) modes: Range<usize>,
    pub(super) watched: Range<usize>,
    /// Modal loads of a unit force \[kg^−½\].
    pub(super) loads: Vec<f64>,
}

impl UnitForce {
    /// Of a contact, over all buildings that links join with its own.
    pub(super) fn new(reduced: &Reduced, contact: usize) -> Self {
        if let Some(plan) = &reduced.plan {
            return Self::in_plan(reduced, plan, contact);
        }
        let ports = reduced.ports[contact];
        let mut linked = 0..0;
        for port in ports.into_iter().flatten() {
            let group = reduced.linked_with(port.building);
            linked = if linked.is_empty() {
                group
            } else {
                linked.start.min(group.start)..linked.end.max(group.end)
            };
        }
        Self::between(reduced, ports, linked)
    }

    /// Of a contact of buildings in space.
    fn in_plan(reduced: &Reduced, plan: &PlanRows, contact: usize) -> Self {
        let sides = || plan.sides_of(contact).map(|(_, side)| side.building);
        let first = sides().min().unwrap_or(0);
        let mut force = Self::over(reduced, first..sides().max().map_or(first, |last| last + 1));
        for (share, side) in plan.sides_of(contact) {
            let loads = &mut force.loads[side.modes.start - force.modes.start..];
            simd::add(&mut loads[..side.modes.len()], share, &side.loads);
        }
        force
    }

    /// Without loads yet, over some buildings.
    fn over(reduced: &Reduced, buildings: Range<usize>) -> Self {
        let joined = &reduced.buildings[buildings.clone()];
        let from = joined
            .first()
            .map_or([0; 2], |b| [b.modes.start, b.watched.start]);
        let to = joined
            .last()
            .map_or([0; 2], |b| [b.modes.end, b.watched.end]);
        Self {
            buildings,
            modes: from[0]..to[0],
            watched: from[1]..to[1],
            loads: vec![0.0; to[0] - from[0]],
        }
    }

    /// Between two monitored points, over at least these buildings.
    pub(super) fn between(
        reduced: &Reduced,
        [left, right]: [Option<Shown>; 2],
        at_least: Range<usize>,
    ) -> Self {
        let sides = [left.map(|port| (port, -1.0)), right.map(|port| (port, 1.0))];
        let sides = || sides.into_iter().flatten();
        let touched = || {
            sides()
                .map(|(port, _)| port.building)
                .chain(at_least.clone())
        };
        let first = touched().min().unwrap_or(0);
        let buildings = first..touched().max().map_or(first, |last| last + 1);
        let mut force = Self::over(reduced, buildings);
        for (port, sign) in sides() {
            let modes = reduced.buildings[port.building].modes.clone();
            let start = force.modes.start;
            for (mode, load) in force.loads[modes.start - start..modes.end - start]
                .iter_mut()
                .enumerate()
            {
                *load += sign * reduced.shape(port, mode);
            }
        }
        force
    }
}

/// Response at the end of a step to a force that grows as the square of time to unity.
#[derive(Clone, Debug, Default)]
pub(super) struct UnitResponse {
    known: bool,
    /// Displacements and velocities of the modes of its [`UnitForce`].
    pub(super) modal: [Vec<f64>; 2],
    /// Monitored displacements and velocities there \[m/N, m/(N s)\].
    pub(super) watched: [Vec<f64>; 2],
    /// What links do then: force at the end and bend of every link per unit force, and the end values and bends of modal
    /// loads of the contact and the links together; empty without links.
    pub(super) links: Vec<[f64; 2]>,
    with_links: [Vec<f64>; 2],
    /// Scratch space: both sides of the equations of the links.
    equations: [Vec<f64>; 2],
}

impl UnitForce {
    /// Adds the modal loads of a force to a list of all modes.
    pub(super) fn add(&self, force: f64, loads: &mut [f64]) {
        for (value, load) in loads[self.modes.clone()].iter_mut().zip(&self.loads) {
            *value += force * load;
        }
    }
}

impl UnitResponse {
    /// The step has changed.
    pub(super) fn forget(&mut self) {
        self.known = false;
    }

    /// Computes it, if necessary, from the responses of displacements and velocities to linear loads and to
    /// curvature terms.
    pub(super) fn find(
        &mut self,
        contact: usize,
        ends: [[&[f64]; 2]; 2],
        links: &LinkTable,
        reduced: &Reduced,
    ) {
        if self.known {
            return;
        }
        self.known = true;
        let push = &reduced.unit_forces[contact];
        for (list, factors) in self.modal.iter_mut().zip(ends) {
            let [line, bend] = factors.map(|list| &list[push.modes.clone()]);
            let factors = line.iter().zip(bend).zip(&push.loads);
            list.clear();
            list.extend(factors.map(|((line, bend), load)| (line + bend) * load));
        }
        if !reduced.links.is_empty() {
            self.add_links(contact, links, reduced);
        }
        let [u, rate] = &mut self.watched;
        u.resize(push.watched.len(), 0.0);
        rate.resize(push.watched.len(), 0.0);
        let [q, v] = &self.modal;
        reduced.show_of(push.buildings.clone(), [q, v], [u, rate]);
    }

    /// Adds the answer of all links to that of the modes.
    fn add_links(&mut self, contact: usize, table: &LinkTable, reduced: &Reduced) {
        let push = &reduced.unit_forces[contact];
        let [q, v] = &mut self.modal;
        let [right, unknowns] = &mut self.equations;
        right.clear();
        for link in &reduced.links {
            let end = closings(reduced, link, [q, v], Some(&push.loads), &push.modes);
            right.extend(link.unknowns(end, table.step()));
        }
        table.solve(right, unknowns);
        for list in &mut self.with_links {
            list.clone_from(&push.loads);
        }
        let [p1, bends] = &mut self.with_links;
        self.links.clear();
        for (index, link) in reduced.links.iter().enumerate() {
            let found = [unknowns[2 * index], unknowns[2 * index + 1]];
            self.links.push(found);
            if link
                .buildings()
                .any(|building| push.buildings.contains(&building))
            {
                let lists = [&mut q[..], &mut v[..], &mut p1[..], &mut bends[..]];
                table.add(reduced, index, found, push.modes.start, lists);
            }
        }
    }

    /// End values and bends of modal loads.
    pub(super) fn loads<'a>(&'a self, push: &'a UnitForce) -> [&'a [f64]; 2] {
        if self.links.is_empty() {
            [&push.loads, &push.loads]
        } else {
            self.with_links.each_ref().map(|list| &list[..])
        }
    }

    /// Opening and opening rate of a contact due to the force at contact `from` \[m/N, m/(N s)\].
    pub(super) fn opening(&self, contact: usize, from: usize, reduced: &Reduced) -> [f64; 2] {
        let seen = &reduced.unit_forces[from].watched;
        let [left, right] = reduced.ports[contact];
        self.watched.each_ref().map(|list| {
            let at = |port: Option<Shown>| {
                port.filter(|port| seen.contains(&port.watched))
                    .map_or(0.0, |port| list[port.watched - seen.start])
            };
            at(right) - at(left)
        })
    }
}
