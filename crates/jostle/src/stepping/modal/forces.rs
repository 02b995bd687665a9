//! Forces of closed contacts at the end of a step: by Newton's method on the forces, and their application.

use super::mode_kernels::AddUp;
use super::stepper::ModalStepper;
use crate::stepping::coupling::Closed;
use crate::stepping::outcome::StepError;
use crate::stepping::runner::RunState;

/// Iterations of Newton's method before a slower and safer method is used.
const QUICK_ROUNDS: u64 = 12;
/// Outer iterations between rates and forces of several contacts.
const ROUNDS: usize = 60;
/// Change of the forces, relative to the greatest, at convergence.
const SETTLED: f64 = 1e-13;
/// Change that counts as rounding if it no longer decreases.
const ROUNDING: f64 = 1e-11;

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

    /// How far and how fast end forces open the closed contacts.
    fn couple(&mut self, run: &RunState<'_>, slot: usize) {
        self.equations.openings.clear();
        let reduced = self.reduced;
        let closed = &run.coupling.closed;
        for column in closed {
            self.tables[slot].find_unit_response(column.contact, reduced);
        }
        for row in closed {
            let openings = closed.iter().map(|column| {
                let answer = self.tables[slot].answer(column.contact);
                answer.opening(row.contact, column.contact, reduced)
            });
            self.equations.openings.extend(openings);
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
            openings, forces, ..
        } = &mut self.equations;
        run.coupling.compliance.reset(n, n - 1);
        for row in 0..n {
            for column in 0..n {
                let [opening, _] = openings[row * n + column];
                run.coupling.compliance.set(row, column, opening);
            }
            let [own, own_rate] = openings[row * n + row];
            run.coupling.closed[row].rate_gain = own_rate / own;
        }
        run.coupling.press(|at| forces[at]);
        let mut last = f64::INFINITY;
        for _ in 0..ROUNDS {
            for row in 0..n {
                let closed = &mut run.coupling.closed[row];
                let gain = closed.rate_gain;
                let others = openings[row * n..].iter().zip(&*forces);
                let beyond: f64 = others
                    .map(|([opening, rate], force)| (gain * opening - rate) * force)
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

/// F = f(δ⁰ − W F, δ̇⁰ − V F) of the laws f of all closed contacts.
#[derive(Debug, Default)]
pub(super) struct ForceEquations {
    /// W and V, row by row: opening and opening rate of a contact due to a unit force of another \[m/N, m/(N s)\].
    pub(super) openings: Vec<[f64; 2]>,
    /// F of every closed contact \[N\].
    pub(super) forces: Vec<f64>,
    /// I + diag(∂f/∂δ) W + diag(∂f/∂δ̇) V.
    matrix: Vec<f64>,
    change: Vec<f64>,
    /// Multiply-adds spent so far.
    pub(super) operations: u64,
}

impl ForceEquations {
    /// Solves for the forces, starting from `forces`, and stores them and their indentations; returns the number of
    /// iterations, or `None` without convergence, as at corners of a law.
    pub(super) fn solve(&mut self, closed: &mut [Closed]) -> Option<u64> {
        let n = closed.len();
        let mut last = f64::INFINITY;
        for round in 1..=QUICK_ROUNDS {
            self.linearise(closed);
            eliminate(&mut self.matrix, &mut self.change)?;
            self.operations += (n * n * (n + 6) / 3) as u64;
            let (mut change, mut greatest) = (0.0_f64, 0.0_f64);
            for (force, step) in self.forces.iter_mut().zip(&self.change) {
                *force += step;
                change = change.max(step.abs());
                greatest = greatest.max(force.abs());
            }
            if !self.forces.iter().all(|force| force.is_finite()) {
                return None;
            }
            let rounding = change <= ROUNDING * greatest && change >= last;
            if change <= SETTLED * greatest || rounding {
                for (row, closed) in closed.iter_mut().enumerate() {
                    (closed.indentation, _) = self.pressed(row, closed);
                    closed.force = self.forces[row];
                }
                return Some(round);
            }
            last = change;
        }
        None
    }

    /// Indentation and its rate of one contact under the forces.
    fn pressed(&self, row: usize, closed: &Closed) -> (f64, f64) {
        let openings = &self.openings[row * self.forces.len()..];
        let (mut indentation, mut rate) = (closed.free, closed.free_rate);
        for ([opening, opening_rate], force) in openings.iter().zip(&self.forces) {
            indentation -= opening * force;
            rate -= opening_rate * force;
        }
        (indentation, rate)
    }

    /// The matrix of Newton's method, and the residual of the laws.
    fn linearise(&mut self, closed: &[Closed]) {
        self.matrix.clear();
        self.change.clear();
        for (row, closed) in closed.iter().enumerate() {
            let (indentation, rate) = self.pressed(row, closed);
            let response = closed.law.follow(indentation, rate, &closed.memory);
            self.change.push(response.force - self.forces[row]);
            let from = row * self.forces.len();
            let openings = &self.openings[from..from + self.forces.len()];
            let slopes = openings.iter().map(|[opening, opening_rate]| {
                response.by_indentation * opening + response.by_rate * opening_rate
            });
            self.matrix.extend(slopes);
            self.matrix[from + row] += 1.0;
        }
    }
}

/// Replaces the right-hand side by the solution, with row exchanges; `None` if the matrix is singular.
fn eliminate(matrix: &mut [f64], side: &mut [f64]) -> Option<()> {
    let n = side.len();
    for pivot in 0..n {
        let size = |row: &usize| matrix[row * n + pivot].abs();
        let best = (pivot..n).max_by(|a, b| size(a).total_cmp(&size(b)))?;
        if best != pivot {
            for column in pivot..n {
                matrix.swap(pivot * n + column, best * n + column);
            }
            side.swap(pivot, best);
        }
        let (above, below) = matrix.split_at_mut((pivot + 1) * n);
        let own = &above[pivot * n..];
        if own[pivot] == 0.0 {
            return None;
        }
        for (at, row) in below.chunks_exact_mut(n).enumerate() {
            let share = row[pivot] / own[pivot];
            if share == 0.0 {
                continue;
            }
            for column in pivot + 1..n {
                row[column] -= share * own[column];
            }
            side[pivot + 1 + at] -= share * side[pivot];
        }
    }
    for row in (0..n).rev() {
        let own = &matrix[row * n..(row + 1) * n];
        let known: f64 = (row + 1..n).map(|column| own[column] * side[column]).sum();
        side[row] = (side[row] - known) / own[row];
    }
    Some(())
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::contact::ForceLaw;

    fn closed(law: ForceLaw, free: f64, free_rate: f64) -> Closed {
        Closed {
            contact: 0,
            law,
            memory: law.touch(0.5),
            free,
            free_rate,
            rate_gain: 0.0,
            indentation: 0.0,
            force: 0.0,
            start_slope: 0.0,
            turn: None,
            start_acceleration: 0.0,
        }
    }

    /// A dashpot without tension separates the two sides, and no force keeps contact: the slower method handles
    /// this.
    #[test]
    fn a_force_that_jumps_does_not_settle() {
        let law = ForceLaw::Kelvin {
            stiffness: 1e8,
            damping: 4e6,
            tension: false,
        };
        let mut equations = ForceEquations {
            openings: vec![[1e-11, 1e-9]],
            forces: vec![0.0],
            ..ForceEquations::default()
        };
        assert!(equations.solve(&mut [closed(law, 1e-6, 0.4)]).is_none());
    }

    #[test]
    fn elimination_exchanges_rows() {
        // x = (2, −1, 3); the first pivot is zero.
        let mut matrix = vec![0.0, 2.0, 1.0, 1.0, -1.0, 2.0, 4.0, 1.0, -3.0];
        let mut side = vec![1.0, 9.0, -2.0];
        assert!(eliminate(&mut matrix, &mut side).is_some());
        for (found, exact) in side.iter().zip([2.0, -1.0, 3.0]) {
            assert!((found - exact).abs() < 1e-14, "{side:?}");
        }
        let mut singular = vec![1.0, 2.0, 2.0, 4.0];
        assert!(eliminate(&mut singular, &mut [1.0, 1.0]).is_none());
    }

    /// Three coupled contacts, one of which is open at the end: every force equals that of its law for the motion
    /// under all of them.
    #[test]
    fn forces_are_those_of_their_laws() {
        let law = ForceLaw::Hertz {
            stiffness: 2e9,
            damping: 0.4,
        };
        let mut contacts =
            [(4e-3, 0.3), (6e-3, -0.1), (-1e-3, -0.4)].map(|(free, rate)| closed(law, free, rate));
        let mut equations = ForceEquations {
            openings: vec![
                [2e-9, 3e-6],
                [-8e-10, -2e-6],
                [1e-10, 2e-7],
                [-7e-10, -1e-6],
                [3e-9, 5e-6],
                [-5e-10, -1e-6],
                [2e-10, 3e-7],
                [-6e-10, -2e-6],
                [2e-9, 4e-6],
            ],
            forces: vec![2e5, 2e5, 1e4],
            ..ForceEquations::default()
        };
        equations.solve(&mut contacts).expect("it settles");
        let forces = equations.forces.clone();
        for (row, contact) in contacts.iter().enumerate() {
            let (mut indentation, mut rate) = (contact.free, contact.free_rate);
            for (column, force) in forces.iter().enumerate() {
                let [opening, opening_rate] = equations.openings[3 * row + column];
                indentation -= opening * force;
                rate -= opening_rate * force;
            }
            let expected = law.follow(indentation, rate, &contact.memory).force;
            assert!(
                (contact.force - expected).abs() <= 1e-12 * 1e6,
                "{row}: {} against {expected}",
                contact.force
            );
            assert!((contact.indentation - indentation).abs() <= 1e-17);
        }
        assert!(contacts[0].force > 1e4 && contacts[2].force == 0.0);
        contacts[1].free = f64::NAN;
        assert!(equations.solve(&mut contacts).is_none());
    }
}
