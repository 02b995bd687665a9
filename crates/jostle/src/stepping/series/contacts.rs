//! Forces of closed contacts over a tried step.

use super::push::Push;
use super::stepper::SeriesStepper;
use crate::state::ContactPhase;
use crate::stepping::coupling::Closed;
use crate::stepping::outcome::StepError;
use crate::stepping::predicted_force::{AHEAD, Drift, PredictedForce};
use crate::stepping::runner::RunState;

/// Rounds between the forces and the motion under them.
const MOST_ROUNDS: usize = 20;
/// Change of the forces, relative to the greatest, at convergence.
const SETTLED: f64 = 1e-12;
/// Change that counts as nothing, relative to the greatest force of the gaps so far.
const NOTHING: f64 = 1e-15;
/// Change that counts as rounding if it no longer decreases.
const ROUNDING: f64 = 1e-7;

impl SeriesStepper {
    /// Lists the closed contacts, with what their forces will be over the step as far as its start tells.
    pub(super) fn predict_forces(&mut self, run: &mut RunState<'_>, step: f64) {
        run.coupling.clear();
        self.equations.forces.clear();
        let any = run
            .phases
            .iter()
            .any(|phase| matches!(phase, ContactPhase::Closed(_)));
        if !any {
            return;
        }
        self.find_jerks(run, step);
        for (place, &index) in self.graph.order.iter().enumerate() {
            let ContactPhase::Closed(episode) = &run.phases[index] else {
                continue;
            };
            let contact = &run.system.contacts[index];
            let drift = Drift {
                start: contact.ports.closing(&self.state.displacement) - run.widths[index],
                rate: contact.ports.closing(&self.state.velocity),
                acceleration: contact.ports.closing(&self.state.acceleration),
                jerk: contact.ports.closing(&self.jerk),
            };
            let predicted = PredictedForce::of_contact(contact, episode, drift, [run.time, step]);
            run.coupling.closed.push(Closed {
                contact: index,
                law: contact.law,
                memory: episode.memory,
                free: 0.0,
                free_rate: 0.0,
                rate_gain: 0.0,
                indentation: 0.0,
                force: 0.0,
                start_slope: predicted.slope,
                turn: None,
                start_acceleration: 0.0,
                friction: None,
                link: None,
            });
            run.coupling.places.push(place);
            self.predicted[index] = predicted;
            self.equations.forces.push(predicted.end);
        }
    }

    /// Rates of the accelerations now, into `jerk`.
    fn find_jerks(&mut self, run: &RunState<'_>, step: f64) {
        let slope = (run.ground[1][0] - run.ground[0][0]) / step;
        self.jerk.fill(0.0);
        for (building, motion) in run.system.buildings.iter().zip(&mut self.motions) {
            let range = building.range();
            let [v, a] =
                [&self.state.velocity, &self.state.acceleration].map(|list| &list[range.clone()]);
            motion.jerks([v, a], slope, &mut self.jerk[range.clone()]);
        }
        for (index, phase) in run.phases.iter().enumerate() {
            let ContactPhase::Closed(episode) = phase else {
                continue;
            };
            let contact = &run.system.contacts[index];
            if contact.law.starts_steeply() && episode.since == run.time {
                // No cubic follows a root of the time.
                continue;
            }
            let closing = |list: &[f64]| contact.ports.closing(list);
            let acceleration = closing(&self.state.acceleration);
            let ahead = AHEAD * step;
            let rate = closing(&self.state.velocity) + acceleration * ahead;
            let indentation = closing(&self.state.displacement) - run.widths[index] + rate * ahead;
            let response = contact.law.follow(indentation, rate, &episode.memory);
            let slope = response.by_indentation * rate + response.by_rate * acceleration;
            for (port, sign) in contact.ports.sides() {
                let building = &run.system.buildings[port.building];
                for &(dof, share) in port.row.entries() {
                    let mass = building.equations.mass[dof - building.offset];
                    self.jerk[dof] += sign * share * slope / mass;
                }
            }
        }
    }

    /// Moves all buildings under the predicted forces and corrects these until they agree with the motion.
    pub(super) fn move_with_contacts(
        &mut self,
        run: &mut RunState<'_>,
        step: f64,
    ) -> Result<(), StepError> {
        self.couple(run, step);
        let closed = run.coupling.closed.len();
        let diverged = StepError::ContactDiverged {
            time: run.time,
            closed,
        };
        let mut last = f64::INFINITY;
        for round in 0..MOST_ROUNDS {
            self.lay_pushes(run, step);
            self.move_buildings(run, step, round > 0)?;
            self.read_trials(run);
            if closed == 0 {
                return Ok(());
            }
            let forces = &self.equations.forces;
            self.tried_forces.clone_from(forces);
            let [openings, rates] = &self.equations.openings;
            for (row, closed) in run.coupling.closed.iter_mut().enumerate() {
                let trial = &run.trials[closed.contact];
                let opened = openings.times(row, |column| forces[column]);
                let slowed = rates.times(row, |column| forces[column]);
                closed.free = trial.indentation + opened;
                closed.free_rate = trial.rate + slowed;
            }
            let rounds = self.equations.solve(&mut run.coupling.closed);
            let rounds = rounds.or_else(|| self.settle_slowly(run, step));
            run.work.iterations += rounds.ok_or_else(|| diverged.clone())?;
            let (mut change, mut greatest) = (0.0_f64, 0.0_f64);
            for (now, before) in self.equations.forces.iter().zip(&self.tried_forces) {
                change = change.max((now - before).abs());
                greatest = greatest.max(now.abs());
            }
            // Rounding of displacements moves forces of stiff contacts in their last digits.
            let rounding = change <= ROUNDING * greatest && change >= last;
            last = change;
            let strongest = run.coupling.closed.iter().map(|closed| {
                let gap = run.system.contacts[closed.contact].gap;
                run.strongest[gap]
            });
            let strongest = strongest.fold(0.0, f64::max);
            if change <= SETTLED * greatest || change <= NOTHING * strongest || rounding {
                for (closed, force) in run.coupling.closed.iter_mut().zip(&self.tried_forces) {
                    closed.force = *force;
                    run.trials[closed.contact].force = *force;
                }
                return Ok(());
            }
        }
        Err(diverged)
    }

    /// The forces where Newton's method on them does not settle, as at corners of a law: by the indentations, which rise
    /// steadily with the forces.
    fn settle_slowly(&mut self, run: &mut RunState<'_>, step: f64) -> Option<u64> {
        let coupling = &mut run.coupling;
        coupling.compliance.clone_from(&self.equations.openings[0]);
        for closed in &mut coupling.closed {
            // An end force moves by h²/12 what it speeds up by h/3.
            closed.rate_gain = 4.0 / step;
        }
        coupling.press(|at| self.tried_forces[at]);
        let rounds = coupling.solve_from_here()?;
        let forces = self.equations.forces.iter_mut().zip(&coupling.closed);
        forces.for_each(|(force, closed)| *force = closed.force);
        Some(rounds)
    }

    /// How far and how fast end forces that grow with the square of time open the closed contacts, as far as the masses
    /// that they push directly go.
    fn couple(&mut self, run: &RunState<'_>, step: f64) {
        let closed = &run.coupling.closed;
        let [openings, rates] = &mut self.equations.openings;
        openings.reset(self.graph.first_coupled(&run.coupling.places));
        rates.reset_like(openings);
        for (row, closed_contact) in closed.iter().enumerate() {
            for column in openings.columns(row) {
                let mut by_force = 0.0;
                let other = closed[column].contact;
                for (shown, own_sign) in run.system.contacts[closed_contact.contact].ports.sides() {
                    for (pushed, sign) in run.system.contacts[other].ports.sides() {
                        if shown.building != pushed.building {
                            continue;
                        }
                        let building = &run.system.buildings[shown.building];
                        for &(dof, share) in shown.row.entries() {
                            for &(same, own_share) in pushed.row.entries() {
                                if same == dof {
                                    let mass = building.equations.mass[dof - building.offset];
                                    by_force += own_sign * sign * share * own_share / mass;
                                }
                            }
                        }
                    }
                }
                openings.set(row, column, by_force * step * step / 12.0);
                rates.set(row, column, by_force * step / 3.0);
            }
        }
    }

    /// Parabolas of the contact forces, building by building.
    fn lay_pushes(&mut self, run: &RunState<'_>, step: f64) {
        self.pushes.iter_mut().for_each(Vec::clear);
        for (closed, end) in run.coupling.closed.iter().zip(&self.equations.forces) {
            let start = run.phases[closed.contact].force();
            let bend = self.predicted[closed.contact].bend(start, *end);
            let force = [start, (end - start - bend) / step, bend / (step * step)];
            for (port, sign) in run.system.contacts[closed.contact].ports.sides() {
                let offset = run.system.buildings[port.building].offset;
                self.pushes[port.building].push(Push {
                    row: port.row.moved_down(offset),
                    force: force.map(|value| sign * value),
                });
            }
        }
    }
}
