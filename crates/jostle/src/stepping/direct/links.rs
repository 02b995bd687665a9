//! Links: springs and dashpots between buildings, in every step (theory, Eqs. L1 to L3).

use super::Direct;
use crate::contact::ForceLaw;
use crate::history::{Extreme, LinkTotals};
use crate::interface::LinkElement;
use crate::linear::envelope::Envelope;
use crate::state::State;
use crate::stepping::coupling::{Closed, scaled_compliance};
use crate::stepping::runner::RunState;
use crate::structure::StepEquations;
use crate::system::System;

/// The factorised equations of all links at one step size, while no contact is closed.
#[derive(Clone, Debug, Default)]
pub(crate) struct LinkFactor {
    known: bool,
    /// I + S^½ W S^½ of the links, factorised.
    scaled: Envelope,
    /// S^½.
    roots: Vec<f64>,
}

impl LinkFactor {
    pub(super) fn is_known(&self) -> bool {
        self.known
    }

    /// The step equations have changed.
    pub(super) fn forget(&mut self) {
        self.known = false;
    }
}

/// Force and totals of every link.
#[derive(Clone, Debug, Default)]
pub(super) struct Links {
    /// Force now \[N\].
    pub(super) forces: Vec<f64>,
    pub(super) totals: Vec<LinkTotals>,
    /// z of S^½ z = F.
    unknowns: Vec<f64>,
}

impl Links {
    pub(super) fn starting_from(system: &System, state: &State) -> Self {
        let start = |link: &LinkElement| {
            let shortening = link.shortening(&state.displacement);
            let force = link.force(shortening, link.ports.closing(&state.velocity));
            let totals = LinkTotals {
                peak_force: Extreme {
                    value: force,
                    at: state.time,
                },
                peak_shortening: shortening.abs(),
                work: link.strain(shortening),
            };
            (force, totals)
        };
        let (forces, totals) = system.links.iter().map(start).unzip();
        Self {
            forces,
            totals,
            unknowns: Vec::with_capacity(system.links.len()),
        }
    }
}

/// The link as a contact that is always closed and may be in tension.
pub(super) fn law_of(link: &LinkElement) -> ForceLaw {
    ForceLaw::Kelvin {
        stiffness: link.stiffness,
        damping: link.damping,
        tension: true,
    }
}

impl<E: StepEquations> Direct<E> {
    /// Adds the forces of the links at the start of the step to its loads, as those of closed contacts.
    pub(super) fn add_link_loads(&mut self, run: &RunState<'_>) {
        for (link, force) in run.system.links.iter().zip(&self.links.forces) {
            link.ports.push_apart(-force, &mut self.increment);
        }
    }

    /// A link at the end of the tried step, as if nothing pushed.
    pub(super) fn link_in_step(&self, run: &RunState<'_>, index: usize, rate_gain: f64) -> Closed {
        let link = &run.system.links[index - self.joints.contacts];
        let trial = &run.trials[index];
        let law = law_of(link);
        Closed {
            contact: index,
            memory: law.touch(0.0),
            law,
            free: trial.indentation,
            free_rate: trial.rate,
            rate_gain,
            indentation: trial.indentation,
            force: 0.0,
            start_slope: 0.0,
            turn: None,
            start_acceleration: 0.0,
            friction: None,
        }
    }

    /// Forces of the links where no contact is closed: one linear system, factorised once per step size
    /// (theory, Eq. L2).
    pub(super) fn find_link_forces(&mut self, run: &mut RunState<'_>, slot: usize) {
        let factors = &mut self.factors[slot];
        let closed = &mut run.coupling.closed;
        let slope = |closed: &Closed| {
            let response = closed.law.follow(0.0, 0.0, &closed.memory);
            response.by_indentation + closed.rate_gain * response.by_rate
        };
        if !factors.links.known {
            let links = &mut factors.links;
            links.roots.clear();
            links
                .roots
                .extend(closed.iter().map(|link| slope(link).sqrt()));
            scaled_compliance(&run.coupling.compliance, &links.roots, &mut links.scaled);
            run.coupling.operations += links.scaled.factorize();
            links.known = true;
        }
        let links = &factors.links;
        let unknowns = &mut self.links.unknowns;
        unknowns.clear();
        for (link, root) in closed.iter().zip(&links.roots) {
            let free = link.law.follow(link.free, link.free_rate, &link.memory);
            unknowns.push(free.force / root);
        }
        links.scaled.solve(unknowns);
        run.coupling.operations += links.scaled.stored() as u64;
        for ((link, root), unknown) in closed.iter_mut().zip(&links.roots).zip(unknowns) {
            link.force = root * *unknown;
        }
    }

    /// Before the state moves on: work of the links over the step.
    pub(super) fn gather_links(&mut self, run: &RunState<'_>, step: f64) {
        for index in 0..run.system.links.len() {
            let link = &run.system.links[index];
            let trial = run.trials[self.joints.contacts + index];
            let start = link.shortening(&self.state.displacement);
            let before = self.links.forces[index];
            let work = 0.5 * (before + trial.force) * (trial.indentation - start);
            self.audit.links += work;
            let totals = &mut self.links.totals[index];
            totals.work += work;
            totals.peak_shortening = totals.peak_shortening.max(trial.indentation.abs());
            if trial.force.abs() > totals.peak_force.value.abs() {
                totals.peak_force = Extreme {
                    value: trial.force,
                    at: run.time + step,
                };
            }
            self.links.forces[index] = trial.force;
        }
    }

    /// Sudden changes of velocity of one building change the forces of the dashpots there, and these the accelerations of
    /// both ends.
    pub(super) fn jerk_links(&mut self, system: &System, building: usize) {
        let offset = system.buildings[building].offset;
        for (link, force) in system.links.iter().zip(&mut self.links.forces) {
            for (port, sign) in link.ports.sides() {
                if port.building != building {
                    continue;
                }
                let change = port.row.moved_down(offset).value(&self.jump.velocity);
                let jump = -sign * link.damping * change;
                if jump == 0.0 {
                    continue;
                }
                *force += jump;
                for (end, sign) in link.ports.sides() {
                    let own = &system.buildings[end.building];
                    for &(dof, share) in end.row.entries() {
                        let mass = own.equations.mass[dof - own.offset];
                        self.state.acceleration[dof] += share * sign * jump / mass;
                    }
                }
            }
        }
    }
}
