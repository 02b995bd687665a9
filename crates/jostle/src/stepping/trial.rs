//! A step tried but not yet taken.

use super::StepEquations;
use super::clock::Clock;
use super::coupling::Closed;
use super::events::Cubic;
use super::outcome::StepError;
use super::simulation::Simulation;
use crate::state::ContactPhase;

/// What a tried step would do at a contact.
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

    /// Lets the closed contacts push on the solution without them that stands in `rise`.
    pub(super) fn solve_contacts(&mut self, slot: usize) -> Result<(), StepError> {
        self.follow_contacts(slot);
        if self
            .trials
            .iter()
            .any(|trial| !trial.indentation.is_finite())
        {
            return Err(StepError::NotFinite {
                time: self.state.time,
            });
        }
        self.list_closed_contacts(slot);
        if self.coupling.closed.is_empty() {
            Ok(())
        } else {
            self.find_contact_forces(slot)
        }
    }

    /// Loads of the incremental step, contacts of its end not yet pushing (theory, Eq. N3).
    fn fill_loads(&mut self, slot: usize) {
        let change = self.ground[1] - self.ground[0];
        for (building, own) in self
            .system
            .buildings
            .iter()
            .zip(&self.factors[slot].buildings)
        {
            let (range, equations) = (building.range(), &building.equations);
            let motion = self.state.velocity[range.clone()]
                .iter()
                .zip(&self.state.acceleration[range.clone()]);
            let masses = equations.mass.iter().zip(&equations.driven_mass);
            for ((load, (v, a)), (mass, driven)) in
                self.rise[range].iter_mut().zip(motion).zip(masses)
            {
                *load = -mass * (own.l_v * v + own.l_a * a) - driven * change;
            }
        }
        self.add_undamped_loads(slot);
        let weight = self.factors[slot].coefficients.unbalanced;
        for (load, missing) in self.rise.iter_mut().zip(&self.unbalanced) {
            *load += weight * missing;
        }
        for (contact, phase) in self.system.contacts.iter().zip(&self.state.contacts) {
            let force = phase.force();
            if force != 0.0 {
                self.rise[contact.dofs[0]] += force;
                self.rise[contact.dofs[1]] -= force;
            }
        }
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

    /// Indentations and rates at the end of the tried step.
    fn follow_contacts(&mut self, slot: usize) {
        let factors = &self.factors[slot];
        let k = &factors.coefficients;
        let (u, v, a) = (
            &self.state.displacement,
            &self.state.velocity,
            &self.state.acceleration,
        );
        for (contact, trial) in self.system.contacts.iter().zip(&mut self.trials) {
            let [i, j] = contact.dofs;
            let rise = |side: usize| {
                let dof = contact.dofs[side];
                self.rise[dof]
                    - factors.buildings[contact.buildings[side]].shift
                        * (k.d_v * v[dof] + k.d_a * a[dof])
            };
            let closed_by = rise(0) - rise(1);
            trial.indentation = u[i] - u[j] - contact.width + closed_by;
            trial.rate = k.c * closed_by + (1.0 + k.d_v) * (v[i] - v[j]) + k.d_a * (a[i] - a[j]);
            trial.force = 0.0;
        }
    }

    /// Lists the closed contacts, with the indentations they would have if they did not push.
    fn list_closed_contacts(&mut self, slot: usize) {
        self.coupling.closed.clear();
        for (index, phase) in self.state.contacts.iter().enumerate() {
            if let ContactPhase::Closed(episode) = phase {
                let trial = &self.trials[index];
                self.coupling.closed.push(Closed {
                    contact: index,
                    law: self.system.contacts[index].law,
                    memory: episode.memory,
                    free: trial.indentation,
                    free_rate: trial.rate,
                    rate_gain: self.factors[slot].coefficients.c,
                    indentation: trial.indentation,
                    force: 0.0,
                    start_slope: 0.0,
                    turn: None,
                    start_acceleration: 0.0,
                });
            }
        }
    }

    /// Solves for the forces of the closed contacts and lets them push (theory, Eqs. P1–P3).
    fn find_contact_forces(&mut self, slot: usize) -> Result<(), StepError> {
        let factors = &mut self.factors[slot];
        for closed in &self.coupling.closed {
            factors.prepare_contact(closed.contact, self.system, &self.equations, &mut self.work);
        }
        self.coupling.compliance.clear();
        for row in &self.coupling.closed {
            for column in &self.coupling.closed {
                let compliance = factors.compliance(
                    &self.system.contacts[row.contact],
                    column.contact,
                    self.system,
                );
                self.coupling.compliance.push(compliance);
            }
        }
        let time = self.state.time;
        let closed = self.coupling.closed.len();
        self.work.iterations += self
            .coupling
            .solve()
            .ok_or(StepError::ContactDiverged { time, closed })?;
        for closed in &self.coupling.closed {
            if closed.force != 0.0 {
                factors.push_apart(closed.contact, closed.force, self.system, &mut self.rise);
            }
        }
        self.follow_contacts(slot);
        for closed in &self.coupling.closed {
            self.trials[closed.contact].force = closed.force;
        }
        Ok(())
    }

    /// Motion of contact `index` over the tried step.
    pub(super) fn indentation_curve(&self, index: usize, step: f64) -> Cubic {
        let contact = &self.system.contacts[index];
        let [i, j] = contact.dofs;
        let (u, v) = (&self.state.displacement, &self.state.velocity);
        let trial = &self.trials[index];
        Cubic::new(
            u[i] - u[j] - contact.width,
            v[i] - v[j],
            trial.indentation,
            trial.rate,
            step,
        )
    }
}
