//! Forces of closed contacts at the end of a step: by Newton's method on the forces, and their application.

use super::mode_kernels::AddUp;
use super::stepper::ModalStepper;
use crate::stepping::coupling::Closed;
use crate::stepping::force_equations::{ForceEquations, ROUNDING, SETTLED};
use crate::stepping::outcome::StepError;
use crate::stepping::runner::RunState;

/// Outer iterations between rates and forces of several contacts.
const ROUNDS: usize = 60;

impl ModalStepper<'_> {
    /// Solves for the forces of the closed contacts at the end of the tried step and lets them push.
    pub(super) fn find_contact_forces(
        &mut self,
        run: &mut RunState<'_>,
        slot: usize,
    ) -> Result<(), StepError> {
        if run.coupling.closed.is_empty() {
            return Ok(());
        }
        for closed in &mut run.coupling.closed {
            let trial = &run.trials[closed.contact];
            (closed.free, closed.free_rate) = (trial.indentation, trial.rate);
            closed.indentation = trial.indentation;
        }
        self.couple(run, slot);
        self.settle(run)?;
        self.press(run, slot);
        Ok(())
    }

    /// The same for buildings in space, whose monitored displacements follow.
    pub(super) fn find_forces_in_plan(
        &mut self,
        run: &mut RunState<'_>,
        slot: usize,
    ) -> Result<(), StepError> {
        let reduced = self.reduced;
        let Some(plan) = &reduced.plan else {
            return Ok(());
        };
        let (equations, table) = (&mut self.plan_equations, &self.tables[slot]);
        let grounds = &run.grounds;
        equations.set_free(reduced, plan, [&self.q[1], &self.v[1]], |port| {
            let [closing, rate, _] = grounds.closing(port, 1);
            [closing, rate]
        });
        equations.couple(reduced, plan, table);
        let predicted = &self.predicted;
        let closed = &mut run.coupling.closed;
        let found = equations.solve(closed, &run.widths, |port| predicted[port].end);
        if let Some(rounds) = found {
            run.work.iterations += rounds;
        } else {
            for (point, closed_contact) in closed.iter_mut().enumerate() {
                let [closing, rate] = equations.free_of(point);
                let width = match closed_contact.friction {
                    Some(_) => 0.0,
                    None => run.widths[closed_contact.contact],
                };
                (closed_contact.free, closed_contact.free_rate) = (closing - width, rate);
                closed_contact.indentation = closed_contact.free;
                run.trials[closed_contact.contact].rate = rate;
            }
            equations.spread(reduced, &run.coupling.places, &mut self.equations.openings);
            self.begin_with_foreseen(run);
            self.settle_in_rounds(run)?;
        }
        let [_, q] = &mut self.q;
        let [_, v] = &mut self.v;
        let [_, p] = &mut self.p;
        let to = [&mut q[..], v, p, &mut self.bend];
        let closed = &run.coupling.closed;
        self.plan_equations
            .push(reduced, plan, closed, &self.tables[slot], to);
        Ok(())
    }

    /// How far and how fast end forces open the closed contacts.
    fn couple(&mut self, run: &RunState<'_>, slot: usize) {
        let reduced = self.reduced;
        let closed = &run.coupling.closed;
        for column in closed {
            self.tables[slot].find_unit_response(column.contact, reduced);
        }
        let [openings, rates] = &mut self.equations.openings;
        openings.reset(reduced.graph.first_coupled(&run.coupling.places));
        rates.reset_like(openings);
        for (row, closed_contact) in closed.iter().enumerate() {
            for column in openings.columns(row) {
                let from = closed[column].contact;
                let answer = self.tables[slot].answer(from);
                let [opening, rate] = answer.opening(closed_contact.contact, from, reduced);
                openings.set(row, column, opening);
                rates.set(row, column, rate);
            }
        }
    }

    /// Forces with which indentations and rates agree, from those predicted.
    fn settle(&mut self, run: &mut RunState<'_>) -> Result<(), StepError> {
        self.begin_with_foreseen(run);
        if let Some(rounds) = self.equations.solve(&mut run.coupling.closed) {
            run.work.iterations += rounds;
            return Ok(());
        }
        self.begin_with_foreseen(run);
        self.settle_in_rounds(run)
    }

    fn begin_with_foreseen(&mut self, run: &RunState<'_>) {
        let predicted = |closed: &Closed| self.predicted[closed.contact].end;
        self.equations.forces.clear();
        self.equations
            .forces
            .extend(run.coupling.closed.iter().map(predicted));
    }

    /// The same where Newton's method on the forces does not settle. Every round takes a rate that goes with the
    /// indentation of its own contact, so that what is solved rises steadily; what the others add beyond that is put in from
    /// the round before, and is small where steps are short.
    fn settle_in_rounds(&mut self, run: &mut RunState<'_>) -> Result<(), StepError> {
        let n = run.coupling.closed.len();
        let diverged = StepError::ContactDiverged {
            time: run.time,
            closed: n,
        };
        let ForceEquations {
            openings: [openings, rates],
            forces,
            ..
        } = &mut self.equations;
        run.coupling.compliance.clone_from(openings);
        for row in 0..n {
            let gain = rates.get(row, row) / openings.get(row, row);
            run.coupling.closed[row].rate_gain = gain;
        }
        run.coupling.press(|at| forces[at]);
        let mut last = f64::INFINITY;
        for _ in 0..ROUNDS {
            for row in 0..n {
                let closed = &mut run.coupling.closed[row];
                if let Some(friction) = &mut closed.friction {
                    friction.pressed = forces[friction.normal];
                }
                let gain = closed.rate_gain;
                let others = openings.columns(row);
                let beyond: f64 = others
                    .map(|at| (gain * openings.get(row, at) - rates.get(row, at)) * forces[at])
                    .sum();
                closed.free_rate = run.trials[closed.contact].rate + beyond;
            }
            let iterations = run.coupling.solve_from_here();
            run.work.iterations += iterations.ok_or_else(|| diverged.clone())?;
            let (mut change, mut greatest) = (0.0_f64, 0.0_f64);
            for (force, closed) in forces.iter_mut().zip(&run.coupling.closed) {
                change = change.max((closed.force - *force).abs());
                greatest = greatest.max(closed.force.abs());
                *force = closed.force;
            }
            // Iterations that start near the solution may cycle in the last digits.
            let rounding = change <= ROUNDING * greatest && change >= last;
            if n == 1 || change <= SETTLED * greatest || rounding {
                return Ok(());
            }
            last = change;
        }
        Err(diverged)
    }

    /// Lets the forces push: what each does over the step is known.
    fn press(&mut self, run: &mut RunState<'_>, slot: usize) {
        let reduced = self.reduced;
        for closed in &run.coupling.closed {
            let push = &reduced.unit_forces[closed.contact];
            let answer = self.tables[slot].answer(closed.contact);
            let [modes, watched] = [&push.modes, &push.watched];
            let [q, v] = &answer.modal;
            let [p1, bends] = answer.loads(push);
            for (bend, by_force) in self.links.bends.iter_mut().zip(&answer.links) {
                *bend += closed.force * by_force[1];
            }
            reduced.arch().dispatch(AddUp {
                factor: closed.force,
                of: [q, v, p1, bends],
                to: [
                    &mut self.q[1][modes.clone()],
                    &mut self.v[1][modes.clone()],
                    &mut self.p[1][modes.clone()],
                    &mut self.bend[modes.clone()],
                ],
            });
            let [u, rate] = &answer.watched;
            reduced.arch().dispatch(AddUp {
                factor: closed.force,
                of: [u, rate],
                to: [
                    &mut self.u[1][watched.clone()],
                    &mut self.rate[1][watched.clone()],
                ],
            });
        }
        self.read_trials(run);
        for closed in &run.coupling.closed {
            run.trials[closed.contact].force = closed.force;
        }
    }
}
