//! Closed contacts and links: the forces that couple the buildings in a step (theory, Eqs. P1–P5, L2).

use crate::contact::{ContactResponse, ForceLaw, Memory};
use crate::history::Extreme;
use crate::linear::envelope::Envelope;
use crate::stepping::step_friction::StepFriction;
use crate::stepping::step_link::StepLink;

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
    /// A link that is not linear instead of the law: its place in [`ContactEquations::links`].
    pub(crate) link: Option<usize>,
}

impl Closed {
    /// The force at an indentation and its rate; friction is that under a known contact force.
    pub(crate) fn respond(
        &self,
        links: &[StepLink],
        indentation: f64,
        rate: f64,
    ) -> ContactResponse {
        match (&self.friction, self.link) {
            (Some(friction), _) => friction.respond(indentation, friction.pressed),
            (None, Some(link)) => links[link].respond(indentation, rate),
            (None, None) => self.law.follow(indentation, rate, &self.memory),
        }
    }

    /// Indentation and its rate at the end of the step \[m, m/s\].
    fn end(&self) -> [f64; 2] {
        let moved = self.indentation - self.free;
        [self.indentation, self.free_rate + self.rate_gain * moved]
    }

    /// The link whose force is the unknown, if it is one.
    pub(super) fn forced<'a>(&self, links: &'a [StepLink]) -> Option<&'a StepLink> {
        let link = &links[self.link?];
        link.force_is_unknown().then_some(link)
    }

    /// Change of the indentation from `free` under which a link has a given force, and the slope of the change
    /// \[m, m/N\].
    pub(super) fn change_for(&self, link: &StepLink, force: f64) -> [f64; 2] {
        let [rate, slope] = link.rate_of(force);
        [
            (rate - self.free_rate) / self.rate_gain,
            slope / self.rate_gain,
        ]
    }
}

/// Newton's method on the indentations: δ + W f(δ, δ̇) = δ_free. Dashpots with an exponent below 1 have their forces for
/// unknowns: their indentations δ(F) are smooth (theory, Eq. B9).
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
    /// Links that are not linear.
    pub(in crate::stepping) links: Vec<StepLink>,
    /// W.
    pub(in crate::stepping) compliance: Envelope,
    /// Multiply-adds spent so far.
    pub(crate) operations: u64,
    responses: Vec<ContactResponse>,
    residual: Vec<f64>,
    jacobian: Envelope,
    roots: Vec<f64>,
    /// Diagonal of the Jacobian beside that of S^½ W S^½.
    units: Vec<f64>,
    update: Vec<f64>,
    start: Vec<f64>,
}

const ITERATIONS: usize = 60;
/// How often limits of friction are found anew, and to what they agree, relative to the greatest contact force.
const MOST_LIMITS: usize = 100;
const LIMITS_AGREE: f64 = 1e-13;
/// In how many of these rounds the slip within the step is followed anew. Each leaves Wk/(1 + Wk) of what is missing; Wk is small in
/// contact steps.
const MOST_TURNS: usize = 12;
const ROUNDING: f64 = 1e-6;

impl ContactEquations {
    /// Removes all closed contacts.
    pub(super) fn clear(&mut self) {
        self.closed.clear();
        self.places.clear();
        self.links.clear();
    }

    /// Finds indentations and forces; returns the iterations, or `None` without convergence.
    pub(crate) fn solve(&mut self) -> Option<u64> {
        for closed in &mut self.closed {
            closed.indentation = closed.free;
            if let Some(link) = closed.forced(&self.links) {
                closed.force = link.start_force();
            }
        }
        self.solve_from_here()
    }

    /// The same, starting from given indentations.
    pub(in crate::stepping) fn solve_from_here(&mut self) -> Option<u64> {
        self.newton().or_else(|| self.settle())
    }

    /// The same as [`ContactEquations::solve`] with friction, whose limits follow from contact forces: they are held, and found anew from
    /// the forces, until both agree. With limits held the forces are unique, and what the limits change of contact forces falls with the
    /// square of the step. A slip that ends within the step is found anew with them.
    pub(in crate::stepping) fn solve_with_friction(&mut self) -> Option<u64> {
        let mut iterations = self.solve()?;
        let mut last = f64::INFINITY;
        for round in 0..MOST_LIMITS {
            let (mut change, mut greatest) = (0.0_f64, 0.0_f64);
            for index in 0..self.closed.len() {
                let Some(friction) = self.closed[index].friction else {
                    continue;
                };
                let normal = &self.closed[friction.normal];
                let pressed = normal.force;
                change = change.max((pressed - friction.pressed).abs());
                greatest = greatest.max(pressed.abs());
                let mut renewed = StepFriction {
                    pressed,
                    ..friction
                };
                if let Some(start) = friction.start.filter(|_| round < MOST_TURNS) {
                    let press =
                        |deep: f64, rate: f64| normal.law.follow(deep, rate, &normal.memory).force;
                    renewed.follow_from(&start, self.closed[index].end(), normal.end(), press);
                    let moved = renewed.origin - friction.origin;
                    change = change.max(friction.law.stiffness * moved.abs());
                }
                self.closed[index].friction = Some(renewed);
            }
            // Indentations have the rounding of slips, which may be a thousand times greater.
            let only_rounding = change >= 0.5 * last && change <= ROUNDING * greatest;
            if change <= LIMITS_AGREE * greatest || only_rounding {
                return Some(iterations);
            }
            last = change;
            iterations += self.solve_from_here()?;
        }
        None
    }

    /// Sets the indentations to those under known forces.
    pub(in crate::stepping) fn press(&mut self, force: impl Fn(usize) -> f64) {
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
            let moved = self.closed.iter().zip(&self.update);
            let change = moved
                .filter(|(closed, _)| closed.forced(&self.links).is_none())
                .fold(0.0, |largest: f64, (_, update)| largest.max(update.abs()));
            let change_of_forces = self.change_of_forces();
            self.start.clear();
            let links = &self.links;
            let unknowns = self.closed.iter().map(|c| match c.forced(links) {
                Some(_) => c.force,
                None => c.indentation,
            });
            self.start.extend(unknowns);
            let converged = change <= 1e-14 * scale && change_of_forces <= 1e-14;
            let mut share = 1.0;
            loop {
                for i in 0..n {
                    let value = self.start[i] + share * self.update[i];
                    let closed = &mut self.closed[i];
                    match closed.forced(&self.links) {
                        Some(_) => closed.force = value,
                        None => closed.indentation = value,
                    }
                }
                let new_size = self.evaluate();
                if converged || new_size <= size * (1.0 - 1e-4 * share) {
                    size = new_size;
                    break;
                }
                // Only rounding errors remain.
                let little = change <= 1e-11 * scale && change_of_forces <= 1e-11;
                if little && new_size <= 4.0 * size {
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

    /// Greatest update of a force that is an unknown, relative to the greatest of them \[–\].
    fn change_of_forces(&self) -> f64 {
        let (mut change, mut greatest) = (0.0_f64, 0.0_f64);
        for (closed, update) in self.closed.iter().zip(&self.update) {
            if closed.forced(&self.links).is_some() {
                change = change.max(update.abs());
                greatest = greatest.max(closed.force.abs()).max(update.abs());
            }
        }
        if greatest > 0.0 {
            change / greatest
        } else {
            0.0
        }
    }

    /// Forces and residual at the current unknowns; returns the largest residual.
    fn evaluate(&mut self) -> f64 {
        self.responses.clear();
        for closed in &mut self.closed {
            if let Some(link) = closed.forced(&self.links) {
                let [change, slope] = closed.change_for(link, closed.force);
                closed.indentation = closed.free + change;
                // The slope of the inverse law.
                self.responses.push(ContactResponse {
                    force: closed.force,
                    by_indentation: slope,
                    by_rate: 0.0,
                });
                continue;
            }
            let rate = closed.free_rate + closed.rate_gain * (closed.indentation - closed.free);
            let response = closed.respond(&self.links, closed.indentation, rate);
            closed.force = response.force;
            self.responses.push(response);
        }
        self.residual.clear();
        for (i, closed) in self.closed.iter().enumerate() {
            let opened = self.compliance.times(i, |j| self.responses[j].force);
            self.residual.push(match closed.forced(&self.links) {
                Some(link) => closed.change_for(link, closed.force)[0] + opened,
                None => closed.indentation + opened - closed.free,
            });
        }
        self.operations += self.compliance.stored() as u64;
        self.residual
            .iter()
            .fold(0.0, |largest, residual| largest.max(residual.abs()))
    }

    /// Solves (I + W S) update = −residual, S being the slopes of the forces, none of which is negative. With
    /// y = S^½ update the matrix I + S^½ W S^½ is symmetric and positive definite.
    ///
    /// A row whose force is the unknown has the slope s of the indentation by the force. It is divided by r = W_ii^½, its
    /// update is r⁻¹ y, and s/W_ii takes the place of 1.
    fn newton_update(&mut self) {
        let n = self.closed.len();
        self.roots.clear();
        self.units.clear();
        for (i, (closed, response)) in self.closed.iter().zip(&self.responses).enumerate() {
            if closed.forced(&self.links).is_some() {
                let compliance = self.compliance.get(i, i);
                self.roots.push(compliance.sqrt().recip());
                self.units.push(response.by_indentation / compliance);
                continue;
            }
            let slope = response.by_indentation + closed.rate_gain * response.by_rate;
            self.roots.push(slope.max(0.0).sqrt());
            self.units.push(1.0);
        }
        let units = |i: usize| self.units[i];
        scaled_compliance(&self.compliance, &self.roots, units, &mut self.jacobian);
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
            if self.closed[i].forced(&self.links).is_some() {
                self.start.push(root * self.update[i]);
                continue;
            }
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

/// I + S^½ W S^½ for the roots of the slopes S; `units` is the diagonal of I.
pub(super) fn scaled_compliance(
    compliance: &Envelope,
    roots: &[f64],
    units: impl Fn(usize) -> f64,
    scaled: &mut Envelope,
) {
    scaled.reset_like(compliance);
    for i in 0..compliance.size() {
        for j in compliance.columns(i).start..=i {
            // Rounding of symmetric entries of W may differ.
            let both = 0.5 * (compliance.get(i, j) + compliance.get(j, i));
            let unit = if i == j { units(i) } else { 0.0 };
            scaled.set(i, j, unit + roots[i] * both * roots[j]);
        }
    }
}
