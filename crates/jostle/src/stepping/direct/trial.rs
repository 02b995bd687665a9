//! A trial step.

use super::Direct;
use super::kernels::Loads;
use crate::interface::PortPair;
use crate::simd;
use crate::state::ContactPhase;
use crate::stepping::clock::Clock;
use crate::stepping::coupling::Closed;
use crate::stepping::outcome::StepError;
use crate::stepping::runner::RunState;
use crate::stepping::step_friction::StepFriction;

impl Direct {
    /// Solves the step to `end` without accepting it: fills `increment` and `trials`.
    pub(super) fn solve_step(
        &mut self,
        run: &mut RunState<'_>,
        slot: usize,
        end: Clock,
    ) -> Result<(), StepError> {
        run.move_grounds(end.time());
        self.fill_loads(run, slot);
        if self.yielding.is_empty() {
            self.factors[slot].solve(
                run.system,
                &self.equations,
                &mut self.increment,
                &mut self.scratch,
                &mut run.work,
            );
            self.solve_contacts(run, slot)
        } else {
            self.find_spring_forces(run, slot)
        }
    }

    /// Lets the closed contacts and the links push on the solution without them that stands in `increment`.
    pub(super) fn solve_contacts(
        &mut self,
        run: &mut RunState<'_>,
        slot: usize,
    ) -> Result<(), StepError> {
        self.follow_joints(run, slot);
        if run
            .trials
            .iter()
            .any(|trial| !trial.indentation.is_finite())
        {
            return Err(StepError::NotFinite { time: run.time });
        }
        self.list_closed(run, slot);
        if run.coupling.closed.is_empty() {
            Ok(())
        } else {
            self.find_forces(run, slot)
        }
    }

    /// Loads of the incremental step, contacts of its end not yet pushing (theory, Eq. N3).
    fn fill_loads(&mut self, run: &RunState<'_>, slot: usize) {
        let [now, end] = [0, 1].map(|time| run.grounds_at(time));
        for (index, (building, coefficients)) in run
            .system
            .buildings
            .iter()
            .zip(&self.factors[slot].buildings)
            .enumerate()
        {
            let (range, equations) = (building.range(), &building.equations);
            let change = end.of(index)[0] - now.of(index)[0];
            let loads = Loads {
                equations,
                own: coefficients,
                change,
                velocity: &self.state.velocity[range.clone()],
                acceleration: &self.state.acceleration[range.clone()],
                out: &mut self.increment[range.clone()],
            };
            simd::in_wide_registers(range.len(), loads);
            let (now, end) = (now.of(index), end.of(index));
            let change = [0, 1, 2].map(|axis| end[axis] - now[axis]);
            equations.add_across_and_up(-1.0, change, &mut self.increment[range]);
        }
        self.add_undamped_loads(run, slot);
        let weight = self.factors[slot].coefficients.unbalanced;
        for (load, missing) in self.increment.iter_mut().zip(&self.unbalanced) {
            *load += weight * missing;
        }
        for (contact, phase) in run.system.contacts.iter().zip(&run.phases) {
            let force = phase.force();
            if force != 0.0 {
                contact.ports.push_apart(-force, &mut self.increment);
            }
            if let (Some(friction), ContactPhase::Closed(episode)) = (&contact.friction, phase) {
                let rubbed = -episode.friction.force;
                friction.ports.push_apart(rubbed, &mut self.increment);
            }
        }
        self.add_link_loads(run);
    }

    /// s K′ D′ − (1 − s c) C′ D′ of the buildings that have such parts (theory, Eq. N3).
    fn add_undamped_loads(&mut self, run: &RunState<'_>, slot: usize) {
        let factors = &self.factors[slot];
        let k = factors.coefficients;
        for (building, coefficients) in run.system.buildings.iter().zip(&factors.buildings) {
            let (range, equations) = (building.range(), &building.equations);
            if equations.plain {
                continue;
            }
            let rate_term = &mut self.rate_term[..range.len()];
            let load = &mut self.increment[range.clone()];
            let motion = self.state.velocity[range.clone()]
                .iter()
                .zip(&self.state.acceleration[range]);
            let weighted =
                |weight: f64| move |(v, a): (&f64, &f64)| weight * (k.d_v * v + k.d_a * a);
            for (rate_term, motion) in rate_term.iter_mut().zip(motion.clone()) {
                *rate_term = weighted(coefficients.shift)(motion);
            }
            equations.undamped.multiply_add(rate_term, load);
            for (rate_term, motion) in rate_term.iter_mut().zip(motion) {
                *rate_term = weighted(-coefficients.dashpot_load)(motion);
            }
            equations.dashpots.multiply_add(rate_term, load);
        }
    }

    /// Indentations and rates of contacts and links at the end of the tried step.
    fn follow_joints(&mut self, run: &mut RunState<'_>, slot: usize) {
        let factors = &self.factors[slot];
        let k = &factors.coefficients;
        let (u, v, a) = (
            &self.state.displacement,
            &self.state.velocity,
            &self.state.acceleration,
        );
        let contacts = run.system.contacts.iter().zip(&run.widths);
        let contacts = contacts.map(|(contact, width)| (&contact.ports, *width));
        let links = run.system.links.iter();
        let links = links.map(|link| (&link.ports, link.closing_at_rest));
        let friction = run
            .system
            .frictions()
            .map(|friction| (&friction.ports, 0.0));
        let joints = contacts.chain(links).chain(friction);
        let joints = joints.zip(&mut run.trials).enumerate();
        let moved = |ports: &PortPair| {
            let mut closed_by = 0.0;
            for (port, sign) in ports.sides() {
                let shift = factors.buildings[port.building].shift;
                for &(dof, share) in port.row.entries() {
                    let rate_term = k.d_v * v[dof] + k.d_a * a[dof];
                    let increment = self.increment[dof] - shift * rate_term;
                    closed_by -= sign * share * increment;
                }
            }
            let rate =
                k.c * closed_by + (1.0 + k.d_v) * ports.closing(v) + k.d_a * ports.closing(a);
            [closed_by, rate]
        };
        for (index, ((ports, at_rest), trial)) in joints {
            let [closed_by, rate] = moved(ports);
            trial.indentation = ports.closing(u) - at_rest + closed_by;
            trial.rate = rate;
            trial.force = 0.0;
            if run.grounds.part {
                let [moved, rate, _] = run.grounds.closing(index, 1);
                trial.indentation += moved;
                trial.rate += rate;
            }
        }
        let ends = run.system.edge_ends.iter().zip(&mut self.edge_ends);
        for (index, (end, tried)) in ends.enumerate() {
            let [closed_by, rate] = moved(&end.ports);
            *tried = [end.inside + end.ports.closing(u) + closed_by, rate];
            if run.grounds.part {
                let [moved, rate, _] = run.grounds.closing(self.joints.of_end(index), 1);
                tried[0] += moved;
                tried[1] += rate;
            }
        }
    }

    /// Lists the closed contacts and the links, with the indentations they would have if none pushed.
    fn list_closed(&mut self, run: &mut RunState<'_>, slot: usize) {
        run.coupling.clear();
        let coefficients = &self.factors[slot].coefficients;
        let (rate_gain, step) = (coefficients.c, coefficients.step);
        for (place, &index) in self.joints.graph.order.iter().enumerate() {
            let closed = if self.joints.is_link(index) {
                self.link_in_step(run, index, rate_gain, step)
            } else if let Some(contact) = self.joints.rubbed(index) {
                match self.friction_in_step(run, index, contact, rate_gain, step) {
                    Some(closed) => closed,
                    None => continue,
                }
            } else if let ContactPhase::Closed(episode) = &run.phases[index] {
                let trial = &run.trials[index];
                Closed {
                    contact: index,
                    law: run.system.contacts[index].law,
                    memory: episode.memory,
                    free: trial.indentation,
                    free_rate: trial.rate,
                    rate_gain,
                    indentation: trial.indentation,
                    force: 0.0,
                    start_slope: 0.0,
                    turn: None,
                    start_acceleration: 0.0,
                    friction: None,
                    link: None,
                }
            } else {
                continue;
            };
            run.coupling.closed.push(closed);
            run.coupling.places.push(place);
        }
        for index in 0..run.coupling.closed.len() {
            if let Some(friction) = run.coupling.closed[index].friction {
                let mut all = run.coupling.closed.iter();
                let normal = all.position(|closed| closed.contact == friction.contact);
                run.coupling.closed[index].friction =
                    normal.map(|normal| StepFriction { normal, ..friction });
            }
        }
    }

    /// Solves for the forces of closed contacts and links and lets them push (theory, Eqs. P1–P5, L2).
    fn find_forces(&mut self, run: &mut RunState<'_>, slot: usize) -> Result<(), StepError> {
        if run.in_contact() || !run.coupling.links.is_empty() {
            self.fill_compliance(run, slot);
            let time = run.time;
            let closed = run.coupling.closed.len();
            run.work.iterations += run
                .coupling
                .solve_with_friction()
                .ok_or(StepError::ContactDiverged { time, closed })?;
        } else {
            if !self.factors[slot].links.is_known() {
                self.fill_compliance(run, slot);
            }
            self.find_link_forces(run, slot);
        }
        for closed in &run.coupling.closed {
            if closed.force != 0.0 {
                self.factors[slot].push_apart(
                    closed.contact,
                    closed.force,
                    run.system,
                    &self.joints,
                    &mut self.increment,
                );
            }
        }
        self.follow_joints(run, slot);
        for closed in &run.coupling.closed {
            run.trials[closed.contact].force = closed.force;
        }
        Ok(())
    }

    /// W of the closed contacts and the links (theory, Eq. P1).
    fn fill_compliance(&mut self, run: &mut RunState<'_>, slot: usize) {
        let (factors, coupling) = (&mut self.factors[slot], &mut run.coupling);
        for closed in &coupling.closed {
            factors.prepare(
                closed.contact,
                run.system,
                &self.joints,
                &self.equations,
                &mut self.scratch,
                &mut run.work,
            );
        }
        let firsts = self.joints.graph.first_coupled(&coupling.places);
        coupling.compliance.reset(firsts);
        for row in 0..coupling.closed.len() {
            for column in coupling.compliance.columns(row) {
                let [contact, other] = [row, column].map(|i| coupling.closed[i].contact);
                let value = factors.compliance(contact, other, run.system, &self.joints);
                coupling.compliance.set(row, column, value);
            }
        }
    }
}
