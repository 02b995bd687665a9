//! Modes and closings at a share of a step, exactly.

use crate::certify::C64;
use jostle::motion::Wave;

use super::super::linear::Component;
use super::super::phi::{DEGREE, moments, phi};
use super::polynomial::{NODES, Poly, ZERO, apply, real_dot};
use super::{Pushes, Run};

impl Run<'_> {
    /// The ground over a step as a polynomial of the share of it.
    pub(super) fn ground(&self, index: u64, inside: f64, step: f64) -> Poly {
        let mut poly = [0.0; NODES];
        match &self.motion.wave {
            Wave::Sampled {
                acceleration,
                step: record,
            } => {
                let at = |k: u64| acceleration.get(k as usize).copied();
                if let (Some(a), Some(b)) = (at(index), at(index + 1)) {
                    let rise = (b - a) / record;
                    poly[0] = self.motion.scale * (a + rise * inside);
                    poly[1] = self.motion.scale * rise * step;
                }
                poly
            }
            _ => {
                let start = index as f64 * self.piece + inside;
                for i in 0..NODES {
                    poly[i] = self.wave(start + self.nodes[i] * step);
                }
                apply(&self.to_monomials, &poly)
            }
        }
    }

    /// The analytic wave, going on beyond the end.
    fn wave(&self, t: f64) -> f64 {
        let mut longer = self.motion.clone();
        longer.duration = f64::INFINITY;
        longer.acceleration(t)
    }

    /// Closing less width, and its rate, of a contact.
    pub(super) fn closing(&self, contact: usize, q: &[Vec<C64>]) -> (f64, f64) {
        let contact_state = &self.contact_states[contact];
        let mut sum = (contact_state.rest - contact_state.width, 0.0);
        for side in &contact_state.sides {
            sum.0 += real_dot(&side.row, &q[side.component]);
            sum.1 += real_dot(&side.rate, &q[side.component]);
        }
        sum
    }

    /// The modes of a component at a share of the step.
    pub(super) fn at(&self, component: usize, s: f64, pushes: &Pushes, out: &mut Vec<C64>) {
        let inputs = self.inputs(component, pushes);
        let run_component = &self.components[component];
        let last = if inputs.is_empty() {
            self.ground_degree
        } else {
            DEGREE
        };
        let (mut work, mut moment) = ([ZERO; DEGREE + 2], [ZERO; NODES]);
        out.clear();
        for j in 0..run_component.lambda.len() {
            phi(
                run_component.lambda[j] * (s * pushes.step),
                last + 1,
                &mut work,
            );
            moments(&work, s, pushes.step, last, &mut moment);
            out.push(advance(
                self.q[component][j],
                work[0],
                &moment,
                j,
                run_component,
                &inputs,
                pushes,
                last,
            ));
        }
    }

    /// Pushes on a component and their polynomials.
    pub(super) fn inputs<'b>(
        &'b self,
        component: usize,
        pushes: &'b Pushes,
    ) -> Vec<(&'b [C64], &'b Poly)> {
        let forces = pushes.forces.iter();
        forces
            .flat_map(|(contact, poly)| {
                let sides = self.contact_states[*contact].sides.iter();
                sides
                    .filter(move |side| side.component == component)
                    .map(move |side| (&side.push[..], poly))
            })
            .collect()
    }

    /// All modes at the end of a whole step of a level, or at a share of it.
    pub(super) fn advanced(&mut self, level: usize, s: f64, pushes: &Pushes) -> Vec<Vec<C64>> {
        let mut all = Vec::with_capacity(self.components.len());
        for component in 0..self.components.len() {
            let mut out = Vec::with_capacity(self.q[component].len());
            if s == 1.0 {
                let (exp, moment) = self.tables(level, component);
                let inputs = self.inputs(component, pushes);
                let run_component = &self.components[component];
                let last = if inputs.is_empty() {
                    self.ground_degree
                } else {
                    DEGREE
                };
                for j in 0..run_component.lambda.len() {
                    out.push(advance(
                        self.q[component][j],
                        exp[j][DEGREE],
                        &moment[j][DEGREE],
                        j,
                        run_component,
                        &inputs,
                        pushes,
                        last,
                    ));
                }
            } else {
                self.at(component, s, pushes, &mut out);
            }
            all.push(out);
        }
        all
    }

    /// Closing and rate of a contact at a share of the step, exactly.
    pub(super) fn closing_at(&self, contact: usize, s: f64, pushes: &Pushes) -> (f64, f64) {
        let contact_state = &self.contact_states[contact];
        let mut sum = (contact_state.rest - contact_state.width, 0.0);
        let mut q = Vec::new();
        for side in &contact_state.sides {
            self.at(side.component, s, pushes, &mut q);
            sum.0 += real_dot(&side.row, &q);
            sum.1 += real_dot(&side.rate, &q);
        }
        sum
    }
}

/// q at the end of a step.
#[allow(clippy::too_many_arguments, reason = "the innermost loop")]
fn advance(
    q: C64,
    exp: C64,
    moment: &[C64; NODES],
    mode: usize,
    component: &Component,
    inputs: &[(&[C64], &Poly)],
    pushes: &Pushes,
    last: usize,
) -> C64 {
    let mut sum = exp * q;
    let ground = component.ground[mode];
    if inputs.is_empty() {
        let mut load = ZERO;
        for k in 0..=last {
            load += moment[k] * pushes.ground[k];
        }
        return sum + ground * load;
    }
    for k in 0..NODES {
        let mut load = ground * pushes.ground[k];
        for (push, poly) in inputs {
            load += push[mode] * poly[k];
        }
        sum += moment[k] * load;
    }
    sum
}
