//! Closed contacts: the few forces that join the buildings in a step (theory, Eqs. P1–P3).

use crate::contact::{ContactResponse, ForceLaw, Memory};
use crate::history::Extreme;

/// One closed contact in the step to be solved.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Closed {
    /// Index in the system.
    pub(crate) contact: usize,
    pub(crate) law: ForceLaw,
    pub(crate) memory: Memory,
    /// Indentation and rate at the end of the step if no closed contact pushed.
    pub(crate) free: f64,
    pub(crate) free_rate: f64,
    /// The rate is `free_rate` + `rate_gain`·(indentation − free).
    pub(crate) rate_gain: f64,
    /// Indentation and force at the end of the step.
    pub(crate) indentation: f64,
    pub(crate) force: f64,
    /// dF/dt at the start of the step \[N/s\].
    pub(crate) start_slope: f64,
    /// Where the indentation is greatest, if the motion turns in the step.
    pub(crate) turn: Option<Extreme>,
    /// Relative acceleration of the faces at the start of the step \[m/s²\].
    pub(crate) start_acceleration: f64,
}

/// Newton's method on the indentations of the closed contacts: δ + W f(δ, δ̇) = δ_free.
///
/// The left side rises monotonically in δ for every law, so that the solution is unique; steps that do not
/// reduce the residual are halved.
#[derive(Clone, Debug, Default)]
pub(crate) struct ContactEquations {
    pub(crate) closed: Vec<Closed>,
    /// W by rows.
    pub(crate) compliance: Vec<f64>,
    responses: Vec<ContactResponse>,
    residual: Vec<f64>,
    jacobian: Vec<f64>,
    update: Vec<f64>,
    start: Vec<f64>,
}

const ITERATIONS: usize = 60;

impl ContactEquations {
    /// Finds indentations and forces; returns the iterations, or `None` when they do not converge.
    pub(crate) fn solve(&mut self) -> Option<u64> {
        self.newton().or_else(|| self.settle())
    }

    fn newton(&mut self) -> Option<u64> {
        let n = self.closed.len();
        for closed in &mut self.closed {
            closed.indentation = closed.free;
        }
        let mut size = self.evaluate();
        for iteration in 1..=ITERATIONS {
            self.newton_update();
            let scale = self
                .closed
                .iter()
                .map(|c| c.indentation.abs().max(c.free.abs()))
                .fold(0.0, f64::max);
            let change = self
                .update
                .iter()
                .fold(0.0, |largest: f64, update| largest.max(update.abs()));
            self.start.clear();
            self.start.extend(self.closed.iter().map(|c| c.indentation));
            let converged = change <= 1e-14 * scale;
            let mut share = 1.0;
            loop {
                for i in 0..n {
                    self.closed[i].indentation = self.start[i] + share * self.update[i];
                }
                let new_size = self.evaluate();
                if converged || new_size <= size * (1.0 - 1e-4 * share) {
                    size = new_size;
                    break;
                }
                // Nothing is left to gain but rounding.
                if change <= 1e-11 * scale && new_size <= 4.0 * size {
                    return Some(iteration as u64);
                }
                share *= 0.5;
                if share < 1e-6 {
                    return None;
                }
            }
            if converged || size == 0.0 {
                return Some(iteration as u64);
            }
        }
        None
    }

    /// Forces and residual at the current indentations; returns the largest residual.
    fn evaluate(&mut self) -> f64 {
        self.responses.clear();
        for closed in &mut self.closed {
            let rate = closed.free_rate + closed.rate_gain * (closed.indentation - closed.free);
            let response = closed.law.follow(closed.indentation, rate, &closed.memory);
            closed.force = response.force;
            self.responses.push(response);
        }
        let n = self.closed.len();
        self.residual.clear();
        for (i, closed) in self.closed.iter().enumerate() {
            let opened: f64 = (0..n)
                .map(|j| self.compliance[i * n + j] * self.responses[j].force)
                .sum();
            self.residual
                .push(closed.indentation + opened - closed.free);
        }
        self.residual
            .iter()
            .fold(0.0, |largest, residual| largest.max(residual.abs()))
    }

    /// Solves (I + W ∂f/∂δ) update = −residual by elimination with row exchange.
    fn newton_update(&mut self) {
        let n = self.closed.len();
        self.jacobian.clear();
        for i in 0..n {
            for j in 0..n {
                let slope = self.responses[j].by_indentation
                    + self.closed[j].rate_gain * self.responses[j].by_rate;
                let unit = if i == j { 1.0 } else { 0.0 };
                self.jacobian
                    .push(unit + self.compliance[i * n + j] * slope);
            }
        }
        self.update.clear();
        self.update
            .extend(self.residual.iter().map(|residual| -residual));
        let (jacobian, update) = (&mut self.jacobian, &mut self.update);
        for column in 0..n {
            let best = (column..n).max_by(|&a, &b| {
                jacobian[a * n + column]
                    .abs()
                    .total_cmp(&jacobian[b * n + column].abs())
            });
            let best = best.unwrap_or(column);
            if best != column {
                (0..n).for_each(|k| jacobian.swap(best * n + k, column * n + k));
                update.swap(best, column);
            }
            for row in column + 1..n {
                let factor = jacobian[row * n + column] / jacobian[column * n + column];
                for k in column..n {
                    jacobian[row * n + k] -= factor * jacobian[column * n + k];
                }
                update[row] -= factor * update[column];
            }
        }
        for row in (0..n).rev() {
            let known: f64 = (row + 1..n)
                .map(|k| jacobian[row * n + k] * update[k])
                .sum();
            update[row] = (update[row] - known) / jacobian[row * n + row];
        }
    }
}
