//! Closed contacts and links: the forces that couple the buildings in a step (theory, Eqs. P1–P5, L2).

use crate::contact::{ContactResponse, ForceLaw, Memory};
use crate::history::Extreme;
use crate::linear::envelope::Envelope;
use crate::stepping::step_friction::StepFriction;

/// One closed contact, or one link, in the step to be solved.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Closed {
    /// Index in the system; links follow the contacts.
    pub(crate) contact: usize,
    pub(crate) law: ForceLaw,
    pub(crate) memory: Memory,
    /// Indentation and rate at the end of the step without these forces.
    pub(crate) free: f64,
    pub(crate) free_rate: f64,
    /// The rate is `free_rate` + `rate_gain`·(indentation − free).
    pub(crate) rate_gain: f64,
    /// Indentation and force at the end of the step.
    pub(crate) indentation: f64,
    pub(crate) force: f64,
    /// dF/dt at the start of the step \[N/s\].
    pub(crate) start_slope: f64,
    /// Instant of the greatest indentation, if the motion reverses in the step.
    pub(crate) turn: Option<Extreme>,
    /// Relative acceleration of the two points at the start of the step \[m/s²\].
    pub(crate) start_acceleration: f64,
    /// Friction along the face of a contact instead of the law.
    pub(crate) friction: Option<StepFriction>,
}

impl Closed {
    /// The force at an indentation and its rate; friction is that under a known contact force.
    pub(crate) fn respond(&self, indentation: f64, rate: f64) -> ContactResponse {
        match &self.friction {
            Some(friction) => friction.respond(indentation, friction.pressed),
            None => self.law.follow(indentation, rate, &self.memory),
        }
    }
}

/// Newton's method on the indentations: δ + W f(δ, δ̇) = δ_free.
///
/// The left side increases monotonically with δ for every law, so the solution is unique; corrections that do not
/// reduce the residual are halved. Only forces on the same building are coupled: in the order of
/// [`InterfaceGraph`](crate::interface::InterfaceGraph), W has a small envelope.
#[derive(Clone, Debug, Default)]
pub(crate) struct ContactEquations {
    /// In the order of the graph of contacts and links.
    pub(crate) closed: Vec<Closed>,
    /// Their places in that order.
    pub(in crate::stepping) places: Vec<usize>,
    /// W.
    pub(super) compliance: Envelope,
    /// Multiply-adds spent so far.
    pub(crate) operations: u64,
    responses: Vec<ContactResponse>,
    residual: Vec<f64>,
    jacobian: Envelope,
    roots: Vec<f64>,
    update: Vec<f64>,
    start: Vec<f64>,
}

const ITERATIONS: usize = 60;

impl ContactEquations {
    /// Removes all closed contacts.
    pub(super) fn clear(&mut self) {
        self.closed.clear();
        self.places.clear();
    }

    /// Finds indentations and forces; returns the iterations, or `None` without convergence.
    pub(crate) fn solve(&mut self) -> Option<u64> {
        for closed in &mut self.closed {
            closed.indentation = closed.free;
        }
        self.solve_from_here()
    }

    /// The same, starting from given indentations.
    pub(super) fn solve_from_here(&mut self) -> Option<u64> {
        self.newton().or_else(|| self.settle())
    }

    /// Sets the indentations to those under known forces.
    pub(super) fn press(&mut self, force: impl Fn(usize) -> f64) {
        for (i, closed) in self.closed.iter_mut().enumerate() {
            closed.indentation = closed.free - self.compliance.times(i, &force);
        }
    }

    fn newton(&mut self) -> Option<u64> {
        let n = self.closed.len();
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
                // Only rounding errors remain.
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
            let response = closed.respond(closed.indentation, rate);
            closed.force = response.force;
            self.responses.push(response);
        }
        self.residual.clear();
        for (i, closed) in self.closed.iter().enumerate() {
            let opened = self.compliance.times(i, |j| self.responses[j].force);
            self.residual
                .push(closed.indentation + opened - closed.free);
        }
        self.operations += self.compliance.stored() as u64;
        self.residual
            .iter()
            .fold(0.0, |largest, residual| largest.max(residual.abs()))
    }

    /// Solves (I + W S) update = −residual, S being the slopes of the forces, none of which is negative. With
    /// y = S^½ update the matrix I + S^½ W S^½ is symmetric and positive definite.
    fn newton_update(&mut self) {
        let n = self.closed.len();
        self.roots.clear();
        let slopes = self.closed.iter().zip(&self.responses);
        self.roots.extend(slopes.map(|(closed, response)| {
            let slope = response.by_indentation + closed.rate_gain * response.by_rate;
            slope.max(0.0).sqrt()
        }));
        scaled_compliance(&self.compliance, &self.roots, &mut self.jacobian);
        self.operations += self.jacobian.factorize();
        self.update.clear();
        let scaled = self.residual.iter().zip(&self.roots);
        self.update
            .extend(scaled.map(|(residual, root)| -root * residual));
        self.jacobian.solve(&mut self.update);
        self.operations += self.compliance.stored() as u64;
        // Back from y: by division where the force is stiff, otherwise by −residual − W S^½ y.
        self.start.clear();
        for i in 0..n {
            let root = self.roots[i];
            let stiff = root * root * self.compliance.get(i, i) > 1.0;
            self.start.push(if stiff {
                self.update[i] / root
            } else {
                -self.residual[i] - self.compliance.times(i, |j| self.roots[j] * self.update[j])
            });
        }
        std::mem::swap(&mut self.start, &mut self.update);
    }
}

/// I + S^½ W S^½ for the roots of the slopes S.
pub(super) fn scaled_compliance(compliance: &Envelope, roots: &[f64], scaled: &mut Envelope) {
    scaled.reset_like(compliance);
    for i in 0..compliance.size() {
        for j in compliance.columns(i).start..=i {
            // Rounding of symmetric entries of W may differ.
            let both = 0.5 * (compliance.get(i, j) + compliance.get(j, i));
            let unit = if i == j { 1.0 } else { 0.0 };
            scaled.set(i, j, unit + roots[i] * both * roots[j]);
        }
    }
}
