//! The energy balance of modal stepping (theory, Eq. E1): sums over steps that balance if every step is exact.

use super::stepper::ModalStepper;
use crate::history::Energy;
use crate::motion::Ground;
use crate::simd;
use crate::state::ContactPhase;
use crate::stepping::energy::Imbalance;
use crate::stepping::runner::RunState;

/// Energies of all modes over a step \[J\].
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct StepEnergy {
    pub(super) damped: f64,
    /// ∫ Σ Γ q̇ a_g dt, negative.
    pub(super) input: f64,
}

/// Sums that must balance; every one is exact for loads that are parabolas over a step.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Audit {
    pub(super) input: f64,
    pub(super) damped: f64,
    pub(super) contact: f64,
    /// Work of the grounds on contacts and links.
    pub(super) ground: f64,
    pub(super) friction: f64,
    imbalance: Imbalance,
}

impl Audit {
    /// The balance with these energies of the buildings.
    pub(super) fn balance(&mut self, kinetic: f64, strain: f64) -> Energy {
        self.balance_with_links(kinetic, strain, [0.0; 2])
    }

    /// The same with what links have taken, and what damping that couples modes has \[J\].
    fn balance_with_links(
        &mut self,
        kinetic: f64,
        strain: f64,
        [links, damped]: [f64; 2],
    ) -> Energy {
        self.imbalance.watch(Energy {
            input: self.input,
            ground: self.ground,
            kinetic,
            strain,
            damped: self.damped + damped + links,
            links,
            hysteretic: 0.0,
            contact: self.contact,
            friction: self.friction,
            worst_imbalance: 0.0,
        })
    }
}

impl ModalStepper<'_> {
    /// What the ground put in and damping took; with closed contacts their work as well.
    pub(super) fn step_energy(
        &mut self,
        run: &mut RunState<'_>,
        slot: usize,
        was_closed: bool,
    ) -> StepEnergy {
        let table = &self.tables[slot];
        let [p0, p1] = &self.p;
        let of = [&self.q[0][..], &self.v[0], p0, p1, &self.bend];
        let arch = self.reduced.arch();
        table.area(arch, of, &mut self.scratch);
        let linked = !self.reduced.links.is_empty();
        if was_closed || linked {
            table.moment(arch, of, &mut self.moment);
        }
        let end = [&self.q[1][..], &self.v[1]];
        let damped = table.damped(self.reduced, of, end, [&self.scratch, &self.moment]);
        let step = table.step;
        let input = self.input_over_step(run, step);
        if was_closed {
            self.contact_work(run, step);
        }
        if linked {
            self.work_of_links(&run.grounds, step);
        }
        StepEnergy { damped, input }
    }

    /// ∫ Σ Γ q̇ a_g dt by parts, negative; ∫q stands in `scratch`.
    fn input_over_step(&self, run: &RunState<'_>, step: f64) -> f64 {
        let by_parts = |grounds: [Ground; 2], moved: [Ground; 2], area: Ground| {
            let ([then, now], [before, after]) = (grounds, moved);
            let mut input = 0.0;
            for axis in 0..3 {
                let slope = (now[axis] - then[axis]) / step;
                input += slope * area[axis] - (now[axis] * after[axis] - then[axis] * before[axis]);
            }
            input
        };
        let grounds = [0, 1].map(|time| run.grounds_at(time));
        if !grounds[0].is_split() {
            let moved = [0, 1].map(|time| self.reduced.driven(&self.q[time]));
            return by_parts(run.ground, moved, self.reduced.driven(&self.scratch));
        }
        let parts = |building: usize| {
            let driven = |list: &[f64]| self.reduced.driven_of(building, list);
            let moved = [0, 1].map(|time| driven(&self.q[time]));
            let grounds = grounds.map(|all| all.of(building));
            by_parts(grounds, moved, driven(&self.scratch))
        };
        (0..self.reduced.buildings.len()).map(parts).sum()
    }

    /// ∫ F δ̇ dt of every closed contact, by parts; ∫q stands in `scratch` and ∫τq in `moment`.
    fn contact_work(&mut self, run: &mut RunState<'_>, step: f64) {
        let reduced = self.reduced;
        if let Some(plan) = &reduced.plan {
            let modal = [&self.scratch[..], &self.moment];
            self.plan_equations.show_ends(reduced, plan, modal);
        }
        for (place, closed) in run.coupling.closed.iter().enumerate() {
            let index = closed.contact;
            let [area, moment] = match &reduced.plan {
                Some(_) => {
                    let point = &self.plan_equations.points[place];
                    self.plan_equations
                        .sums
                        .each_ref()
                        .map(|list| point.value(list))
                }
                None => {
                    [&self.scratch, &self.moment].map(|list| reduced.closing_of_modes(index, list))
                }
            };
            let contact = closed.friction.map_or(index, |friction| friction.contact);
            let ContactPhase::Closed(episode) = &mut run.phases[contact] else {
                continue;
            };
            let (width, first) = match closed.friction {
                Some(_) => (0.0, episode.friction.force),
                None => (run.widths[index], episode.force),
            };
            let grounds = run.grounds.over_step(reduced.joint_of_port(index), step);
            let closing = area + grounds.area;
            let leaning = 2.0 * (moment + grounds.moment) - closing;
            let before = self.reduced.closing(index, &self.u[0]) - width;
            let last = run.trials[index].force;
            let bent = self.predicted[index].bend(first, last);
            let work = last * run.trials[index].indentation
                - first * before
                - (last - first) * (closing / step - width)
                - bent * leaning / step;
            self.energy.ground += grounds.work([first, last], bent, step);
            if closed.friction.is_some() {
                episode.friction.work += work;
                self.energy.friction += work;
            } else {
                episode.work += work;
                self.energy.contact += work;
            }
        }
    }

    /// The balance now.
    pub(super) fn balance(&mut self) -> Energy {
        let kinetic = 0.5 * simd::dot(&self.v[0], &self.v[0]);
        let strain = 0.5 * simd::weighted_square(&self.reduced.stiffness, &self.q[0]);
        if self.reduced.links.is_empty() {
            return self.energy.balance(kinetic, strain);
        }
        let stored = self.strain_of_links();
        let taken = [self.links.work - stored, self.links.damped];
        self.energy
            .balance_with_links(kinetic, strain + stored, taken)
    }
}
