//! Links: springs and dashpots between buildings, in every step (theory, Eqs. L1 to L3).

use super::{Direct, moved_by_grounds};
use crate::contact::ForceLaw;
use crate::history::Extreme;
use crate::interface::{LinkElement, LinkMemory};
use crate::linear::envelope::Envelope;
use crate::model::LinkLaw;
use crate::state::State;
use crate::stepping::coupling::{Closed, scaled_compliance};
use crate::stepping::events::{Crossing, Cubic};
use crate::stepping::runner::{LinkTouch, RunState};
use crate::stepping::step_link::StepLink;
use crate::stepping::totals::LinkTotals;
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
        let start = |(link, memory): (&LinkElement, LinkMemory)| {
            let shortening = link.shortening(&state.displacement);
            let rate = link.ports.closing(&state.velocity);
            let force = link.force_now(shortening, rate, &memory);
            let totals = LinkTotals {
                peak_force: Extreme {
                    value: force,
                    at: state.time,
                },
                peak_shortening: shortening.abs(),
                peak_rate: rate.abs(),
                work: link.recoverable(shortening, &memory),
            };
            (force, totals)
        };
        let memories = state.link_memories();
        let links = system.links.iter().zip(memories);
        let (forces, totals) = links.map(start).unzip();
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

impl Direct {
    /// Shortening of a link now, and its rate \[m, m/s\].
    fn link_motion(&self, run: &RunState<'_>, index: usize) -> [f64; 2] {
        let link = &run.system.links[index];
        let [moved, rate, _] = run.grounds.closing(self.joints.contacts + index, 0);
        [
            link.shortening(&self.state.displacement) + moved,
            link.ports.closing(&self.state.velocity) + rate,
        ]
    }

    /// Adds the forces of the links at the start of the step to its loads, as those of closed contacts.
    pub(super) fn add_link_loads(&mut self, run: &RunState<'_>) {
        for (link, force) in run.system.links.iter().zip(&self.links.forces) {
            link.ports.push_apart(-force, &mut self.increment);
        }
    }

    /// A link at the end of the tried step, as if nothing pushed.
    pub(super) fn link_in_step(
        &self,
        run: &mut RunState<'_>,
        index: usize,
        rate_gain: f64,
        step: f64,
    ) -> Closed {
        let link_index = index - self.joints.contacts;
        let link = &run.system.links[link_index];
        let trial = &run.trials[index];
        let [start, _] = self.link_motion(run, link_index);
        let nonlinear = (!link.is_linear()).then(|| {
            let memory = LinkMemory {
                force: self.links.forces[link_index],
                ..self.state.links[link_index]
            };
            let links = &mut run.coupling.links;
            links.push(StepLink::new(link, &memory, start, step));
            links.len() - 1
        });
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
            link: nonlinear,
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
            scaled_compliance(
                &run.coupling.compliance,
                &links.roots,
                |_| 1.0,
                &mut links.scaled,
            );
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
            let [start, _] = self.link_motion(run, index);
            let before = self.links.forces[index];
            let mean = 0.5 * (before + trial.force);
            let work = mean * (trial.indentation - start);
            self.audit.ground += mean * moved_by_grounds(run, self.joints.contacts + index);
            let totals = &mut self.links.totals[index];
            totals.work += work;
            totals.peak_rate = totals.peak_rate.max(trial.rate.abs());
            totals.peak_shortening = totals.peak_shortening.max(trial.indentation.abs());
            if trial.force.abs() > totals.peak_force.value.abs() {
                totals.peak_force = Extreme {
                    value: trial.force,
                    at: run.time + step,
                };
            }
            self.links.forces[index] = trial.force;
            if link.law.is_hysteretic() {
                self.audit.yielding_links += work;
            } else {
                self.audit.links += work;
            }
        }
        for closed in &run.coupling.closed {
            if let Some(link) = closed.link {
                let trial = run.trials[closed.contact];
                let memory = run.coupling.links[link].committed(trial.indentation, trial.force);
                self.state.links[closed.contact - self.joints.contacts] = memory;
            }
        }
    }

    /// The first link whose gap or slack closes or opens within the tried step.
    pub(super) fn first_link_touch(&self, run: &RunState<'_>, step: f64) -> Option<LinkTouch> {
        let mut first: Option<LinkTouch> = None;
        for (index, link) in run.system.links.iter().enumerate() {
            let [start, start_rate] = self.link_motion(run, index);
            let Some((start, sign)) = link.overlap(start) else {
                continue;
            };
            let [end, rate] = self.overlap_at_end(run, index);
            let crossing = match start > 0.0 {
                true if end < 0.0 => Crossing::Downwards,
                false if end > 0.0 || rate < 0.0 => Crossing::Upwards,
                true | false => continue,
            };
            let curve = Cubic::new(start, sign * start_rate, end, rate, step);
            if let Some(at) = curve.first_crossing(crossing)
                && first.is_none_or(|first| at < first.at)
            {
                first = Some(LinkTouch {
                    link: index,
                    crossing,
                    at,
                });
            }
        }
        first
    }

    /// By how much a gap or slack is closed at the end of the tried step, and its rate \[m, m/s\].
    pub(super) fn overlap_at_end(&self, run: &RunState<'_>, index: usize) -> [f64; 2] {
        let trial = run.trials[self.joints.contacts + index];
        let overlap = run.system.links[index].overlap(trial.indentation);
        overlap.map_or([0.0; 2], |(overlap, sign)| [overlap, sign * trial.rate])
    }

    /// Gives a stopper that touches now the force of its dashpot, which changes the accelerations of both ends; whether
    /// it had no force.
    pub(super) fn begin_dashpot(&mut self, run: &RunState<'_>, index: usize) -> bool {
        let link = &run.system.links[index];
        let [_, rate] = self.link_motion(run, index);
        let dashpot = match link.law {
            LinkLaw::Stopper { .. } => link.damping * rate.max(0.0),
            LinkLaw::Linear
            | LinkLaw::Viscous { .. }
            | LinkLaw::Maxwell
            | LinkLaw::Friction { .. }
            | LinkLaw::Yielding(_)
            | LinkLaw::Cable { .. } => 0.0,
        };
        let jump = dashpot - self.links.forces[index];
        if dashpot == 0.0 || self.links.forces[index] != 0.0 {
            return false;
        }
        self.links.forces[index] = dashpot;
        let totals = &mut self.links.totals[index];
        if dashpot > totals.peak_force.value.abs() {
            totals.peak_force = Extreme {
                value: dashpot,
                at: run.time,
            };
        }
        self.accelerate_ends(run.system, index, jump);
        true
    }

    /// A sudden change of the force of a link changes the accelerations of both ends.
    fn accelerate_ends(&mut self, system: &System, index: usize, jump: f64) {
        for (end, sign) in system.links[index].ports.sides() {
            let building = &system.buildings[end.building];
            for &(dof, share) in end.row.entries() {
                let mass = building.equations.mass[dof - building.offset];
                self.state.acceleration[dof] += share * sign * jump / mass;
            }
        }
    }

    /// Sudden changes of velocity of one building change the forces of the dashpots there, and these the accelerations of
    /// both ends.
    pub(super) fn jerk_links(&mut self, run: &RunState<'_>, building: usize) {
        let system = run.system;
        let offset = system.buildings[building].offset;
        for (index, link) in system.links.iter().enumerate() {
            for (port, sign) in link.ports.sides() {
                if port.building != building {
                    continue;
                }
                let jump = if link.is_linear() {
                    let change = port.row.moved_down(offset).value(&self.jump.velocity);
                    -sign * link.damping * change
                } else {
                    let [shortening, rate] = self.link_motion(run, index);
                    link.force_now(shortening, rate, &self.state.links[index])
                        - self.links.forces[index]
                };
                if jump == 0.0 {
                    continue;
                }
                self.links.forces[index] += jump;
                self.accelerate_ends(system, index, jump);
            }
        }
    }
}
