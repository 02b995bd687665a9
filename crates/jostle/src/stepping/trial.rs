//! A trial step.

use super::StepEquations;
use super::clock::Clock;
use super::coupling::Closed;
use super::events::Cubic;
use super::kernels::Loads;
use super::outcome::StepError;
use super::simulation::Simulation;
use crate::lanes;
use crate::state::ContactPhase;

/// Result of a trial step at a contact.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct ContactTrial {
    pub(super) indentation: f64,
    pub(super) rate: f64,
    pub(super) force: f64,
}

impl<E: StepEquations> Simulation<'_, E> {
    /// Solves the step to `end` without accepting it: fills `rise` and `trials`.
    pub(super) fn try_step(&mut self, slot: usize, end: Clock) -> Result<(), StepError> {
        self.ground[1] = self.motion.acceleration(end.time());
        self.fill_loads(slot);
        if self.yielding.is_empty() {
            self.factors[slot].solve(self.system, &self.equations, &mut self.rise, &mut self.work);
            self.solve_contacts(slot)
        } else {
            self.find_spring_forces(slot)
        }
    }

    /// Adds the forces of closed contacts and links to the solution without them in `rise`.
    pub(super) fn solve_contacts(&mut self, slot: usize) -> Result<(), StepError> {
        self.follow_joints(slot);
        if self
            .trials
            .iter()
            .any(|trial| !trial.indentation.is_finite())
        {
            return Err(StepError::NotFinite {
                time: self.state.time,
            });
        }
        self.list_closed(slot);
        if self.coupling.closed.is_empty() {
            Ok(())
        } else {
            self.find_forces(slot)
        }
    }

    /// Whether the trial step has a closed contact.
    pub(super) fn in_contact(&self) -> bool {
        let mut closed = self.coupling.closed.iter();
        closed.any(|closed| !self.joints.is_link(closed.contact))
    }

    /// Loads of the incremental step, without contact forces at its end (theory, Eq. N3).
    fn fill_loads(&mut self, slot: usize) {
        let change = self.ground[1] - self.ground[0];
        for (building, own) in self
            .system
            .buildings
            .iter()
            .zip(&self.factors[slot].buildings)
        {
            let (range, equations) = (building.range(), &building.equations);
            let loads = Loads {
                equations,
                own,
                change,
                velocity: &self.state.velocity[range.clone()],
                acceleration: &self.state.acceleration[range.clone()],
                out: &mut self.rise[range.clone()],
            };
            lanes::in_wide_registers(range.len(), loads);
        }
        self.add_undamped_loads(slot);
        let weight = self.factors[slot].coefficients.unbalanced;
        for (load, missing) in self.rise.iter_mut().zip(&self.unbalanced) {
            *load += weight * missing;
        }
        for (contact, phase) in self.system.contacts.iter().zip(&self.state.contacts) {
            let force = phase.force();
            if force != 0.0 {
                contact.faces.push_apart(-force, &mut self.rise);
            }
        }
        self.add_link_loads();
    }

    /// s K′ D′ − (1 − s c) C′ D′ of the buildings that have such parts (theory, Eq. N3).
    fn add_undamped_loads(&mut self, slot: usize) {
        let factors = &self.factors[slot];
        let k = factors.coefficients;
        for (building, own) in self.system.buildings.iter().zip(&factors.buildings) {
            let (range, equations) = (building.range(), &building.equations);
            if equations.plain {
                continue;
            }
            let drift = &mut self.drift[..range.len()];
            let load = &mut self.rise[range.clone()];
            let motion = self.state.velocity[range.clone()]
                .iter()
                .zip(&self.state.acceleration[range]);
            let weighted =
                |weight: f64| move |(v, a): (&f64, &f64)| weight * (k.d_v * v + k.d_a * a);
            for (drift, motion) in drift.iter_mut().zip(motion.clone()) {
                *drift = weighted(own.shift)(motion);
            }
            equations.undamped.multiply_add(drift, load);
            for (drift, motion) in drift.iter_mut().zip(motion) {
                *drift = weighted(-own.dashpot_load)(motion);
            }
            equations.dashpots.multiply_add(drift, load);
        }
    }

    /// Indentations and rates of contacts and links at the end of the trial step.
    fn follow_joints(&mut self, slot: usize) {
        let factors = &self.factors[slot];
        let k = &factors.coefficients;
        let (u, v, a) = (
            &self.state.displacement,
            &self.state.velocity,
            &self.state.acceleration,
        );
        let contacts = self.system.contacts.iter();
        let contacts = contacts.map(|contact| (&contact.faces, contact.width));
        let links = self.system.links.iter();
        let links = links.map(|link| (&link.faces, link.closing_at_rest));
        for ((faces, at_rest), trial) in contacts.chain(links).zip(&mut self.trials) {
            let mut closed_by = 0.0;
            for (face, sign) in faces.sides() {
                let dof = face.dof;
                let drift = k.d_v * v[dof] + k.d_a * a[dof];
                let rise = self.rise[dof] - factors.buildings[face.building].shift * drift;
                closed_by -= sign * rise;
            }
            trial.indentation = faces.closing(u) - at_rest + closed_by;
            trial.rate =
                k.c * closed_by + (1.0 + k.d_v) * faces.closing(v) + k.d_a * faces.closing(a);
            trial.force = 0.0;
        }
    }

    /// Lists the closed contacts and the links from left to right, with their indentations without these forces.
    fn list_closed(&mut self, slot: usize) {
        self.coupling.clear();
        let rate_gain = self.factors[slot].coefficients.c;
        for (place, &index) in self.joints.order.iter().enumerate() {
            let closed = if self.joints.is_link(index) {
                self.link_in_step(index, rate_gain)
            } else if let ContactPhase::Closed(episode) = &self.state.contacts[index] {
                let trial = &self.trials[index];
                Closed {
                    contact: index,
                    law: self.system.contacts[index].law,
                    memory: episode.memory,
                    free: trial.indentation,
                    free_rate: trial.rate,
                    rate_gain,
                    indentation: trial.indentation,
                    force: 0.0,
                    start_slope: 0.0,
                    turn: None,
                    start_acceleration: 0.0,
                }
            } else {
                continue;
            };
            self.coupling.closed.push(closed);
            self.coupling.places.push(place);
        }
    }

    /// Solves for the forces of closed contacts and links and applies them (theory, Eqs. P1–P5, L2).
    fn find_forces(&mut self, slot: usize) -> Result<(), StepError> {
        if self.in_contact() {
            self.fill_compliance(slot);
            let time = self.state.time;
            let closed = self.coupling.closed.len();
            self.work.iterations += self
                .coupling
                .solve()
                .ok_or(StepError::ContactDiverged { time, closed })?;
        } else {
            if !self.factors[slot].links.is_known() {
                self.fill_compliance(slot);
            }
            self.find_link_forces(slot);
        }
        for closed in &self.coupling.closed {
            if closed.force != 0.0 {
                self.factors[slot].push_apart(
                    closed.contact,
                    closed.force,
                    self.system,
                    &self.joints,
                    &mut self.rise,
                );
            }
        }
        self.follow_joints(slot);
        for closed in &self.coupling.closed {
            self.trials[closed.contact].force = closed.force;
        }
        Ok(())
    }

    /// W of the closed contacts and the links (theory, Eq. P1).
    fn fill_compliance(&mut self, slot: usize) {
        let (factors, coupling) = (&mut self.factors[slot], &mut self.coupling);
        for closed in &coupling.closed {
            factors.prepare(
                closed.contact,
                self.system,
                &self.joints,
                &self.equations,
                &mut self.work,
            );
        }
        let reach = self.joints.reach(&coupling.places);
        coupling.compliance.reset(coupling.closed.len(), reach);
        for row in 0..coupling.closed.len() {
            for column in coupling.compliance.columns(row) {
                let [own, other] = [row, column].map(|i| coupling.closed[i].contact);
                let value = factors.compliance(own, other, self.system, &self.joints);
                coupling.compliance.set(row, column, value);
            }
        }
    }

    /// Motion of contact `index` over the trial step.
    pub(super) fn indentation_curve(&self, index: usize, step: f64) -> Cubic {
        let contact = &self.system.contacts[index];
        let trial = &self.trials[index];
        Cubic::new(
            contact.faces.closing(&self.state.displacement) - contact.width,
            contact.faces.closing(&self.state.velocity),
            trial.indentation,
            trial.rate,
            step,
        )
    }
}
