//! The effect of a step of one length on modes and contacts.

use std::collections::HashMap;
use std::rc::Rc;

use crate::certify::C64;

use super::super::phi::{DEGREE, Phi, moments, phi};
use super::Run;
use super::contact_state::Side;
use super::polynomial::{NODES, Poly, ZERO};

/// By mode and node.
pub(super) type Exponentials = Vec<[C64; NODES]>;
/// By mode, node and power.
pub(super) type Moments = Vec<[[C64; NODES]; NODES]>;
/// Of closing and rate, by node and by power or node of what pushes.
pub(super) type Response = [[[f64; NODES]; NODES]; 2];

/// What a step of some length does.
pub(super) struct Level {
    pub(super) step: f64,
    /// By component: [mode][node] e^{λτ}.
    pub(super) exp: Vec<Option<Rc<Exponentials>>>,
    /// By component: [mode][node][k] moments.
    pub(super) moment: Vec<Option<Rc<Moments>>>,
    /// By contact: response of closing and rate to monomials of the ground.
    pub(super) ground: Vec<Option<Rc<Response>>>,
    pub(super) pairs: HashMap<(usize, usize), Rc<Response>>,
}

impl Run<'_> {
    pub(super) fn level_of(&mut self, level: usize, free_step: f64) {
        while self.levels.len() <= level {
            let n = self.levels.len();
            self.levels.push(Level {
                step: free_step * 0.5_f64.powi(n as i32),
                exp: vec![None; self.components.len()],
                moment: vec![None; self.components.len()],
                ground: vec![None; self.contact_states.len()],
                pairs: HashMap::new(),
            });
        }
    }

    /// e^{λτ} and moments at the nodes of a step for a component.
    pub(super) fn tables(
        &mut self,
        level: usize,
        component: usize,
    ) -> (Rc<Exponentials>, Rc<Moments>) {
        if let (Some(exp), Some(moment)) = (
            &self.levels[level].exp[component],
            &self.levels[level].moment[component],
        ) {
            return (exp.clone(), moment.clone());
        }
        let step = self.levels[level].step;
        let mut exps = Vec::new();
        let mut all = Vec::new();
        let mut work: Phi = [ZERO; DEGREE + 2];
        for l in &self.components[component].lambda {
            let mut exp = [C64::new(1.0, 0.0); NODES];
            let mut moment = [[ZERO; NODES]; NODES];
            for i in 1..NODES {
                phi(*l * (self.nodes[i] * step), DEGREE + 1, &mut work);
                exp[i] = work[0];
                moments(&work, self.nodes[i], step, DEGREE, &mut moment[i]);
            }
            exps.push(exp);
            all.push(moment);
        }
        let (exps, all) = (Rc::new(exps), Rc::new(all));
        self.levels[level].exp[component] = Some(exps.clone());
        self.levels[level].moment[component] = Some(all.clone());
        (exps, all)
    }

    /// Responses of the closing of a contact and of its rate to monomials of the ground.
    pub(super) fn by_ground(&mut self, level: usize, contact: usize) -> Rc<Response> {
        if let Some(known) = &self.levels[level].ground[contact] {
            return known.clone();
        }
        let mut response = [[[0.0; NODES]; NODES]; 2];
        for side in 0..self.contact_states[contact].sides.len() {
            let component = self.contact_states[contact].sides[side].component;
            let (_, moment) = self.tables(level, component);
            let side = &self.contact_states[contact].sides[side];
            let input = &self.components[component].ground;
            add_response(&mut response, side, input, &moment);
        }
        let response = Rc::new(response);
        self.levels[level].ground[contact] = Some(response.clone());
        response
    }

    /// Responses of the closing of a contact to the nodal values of the force of another; `None` where nothing joins them.
    pub(super) fn by_force(
        &mut self,
        level: usize,
        contact: usize,
        other: usize,
    ) -> Option<Rc<Response>> {
        if let Some(known) = self.levels[level].pairs.get(&(contact, other)) {
            return Some(known.clone());
        }
        let mut response = [[[0.0; NODES]; NODES]; 2];
        let mut any = false;
        for side in 0..self.contact_states[contact].sides.len() {
            for with in 0..self.contact_states[other].sides.len() {
                let component = self.contact_states[contact].sides[side].component;
                if self.contact_states[other].sides[with].component != component {
                    continue;
                }
                any = true;
                let (_, moment) = self.tables(level, component);
                let (contact_side, push) = (
                    &self.contact_states[contact].sides[side],
                    &self.contact_states[other].sides[with].push,
                );
                add_response(&mut response, contact_side, push, &moment);
            }
        }
        if !any {
            return None;
        }
        // From monomials to nodal values.
        for part in &mut response {
            for row in part.iter_mut() {
                let by: Poly = std::array::from_fn(|k| {
                    (0..NODES).map(|m| row[m] * self.to_monomials[m][k]).sum()
                });
                *row = by;
            }
        }
        let response = Rc::new(response);
        self.levels[level]
            .pairs
            .insert((contact, other), response.clone());
        Some(response)
    }
}

fn add_response(
    response: &mut Response,
    side: &Side,
    input: &[C64],
    moment: &[[[C64; NODES]; NODES]],
) {
    for j in 0..input.len() {
        let (x, v) = (side.row[j] * input[j], side.rate[j] * input[j]);
        for i in 1..NODES {
            for k in 0..NODES {
                let m = moment[j][i][k];
                response[0][i][k] += x.re * m.re - x.im * m.im;
                response[1][i][k] += v.re * m.re - v.im * m.im;
            }
        }
    }
}
