//! Forces of closed contacts over a step.

use super::super::phi::DEGREE;
use super::polynomial::{NODES, Poly, apply};
use super::{Pushes, Run};

impl Run<'_> {
    /// Finds the forces of the closed contacts over a step; the courses of closing and rate come along as polynomials. The
    /// error is relative to what is allowed.
    pub(super) fn forces(
        &mut self,
        level: usize,
        pushes: &mut Pushes,
        courses: &mut Vec<(usize, Poly, Poly)>,
    ) -> Option<f64> {
        let list: Vec<usize> = (0..self.closed.len())
            .filter(|contact| self.closed[*contact].is_some())
            .collect();
        let mut free: Vec<[Poly; 2]> = Vec::new();
        for &contact in &list {
            let by = self.by_ground(level, contact);
            let mut courses = [[0.0; NODES]; 2];
            let now = self.closing(contact, &self.q);
            (courses[0][0], courses[1][0]) = now;
            for side in 0..self.contact_states[contact].sides.len() {
                let component = self.contact_states[contact].sides[side].component;
                let (exp, _) = self.tables(level, component);
                let side = &self.contact_states[contact].sides[side];
                for (j, q) in self.q[component].iter().enumerate() {
                    let (u, v) = (side.row[j] * q, side.rate[j] * q);
                    for i in 1..NODES {
                        let e = exp[j][i];
                        courses[0][i] += u.re * e.re - u.im * e.im;
                        courses[1][i] += v.re * e.re - v.im * e.im;
                    }
                }
            }
            for i in 1..NODES {
                courses[0][i] +=
                    self.contact_states[contact].rest - self.contact_states[contact].width;
                for part in 0..2 {
                    for k in 0..=self.ground_degree {
                        courses[part][i] += by[part][i][k] * pushes.ground[k];
                    }
                }
            }
            free.push(courses);
        }
        let mut pairs = Vec::new();
        for (a, &contact) in list.iter().enumerate() {
            for (b, &other) in list.iter().enumerate() {
                if let Some(by) = self.by_force(level, contact, other) {
                    pairs.push((a, b, by));
                }
            }
        }
        let law = |a: usize, x: f64, v: f64| {
            self.closed[list[a]]
                .as_ref()
                .map_or(0.0, |closed| closed.force(x, v))
        };
        let mut forces: Vec<Poly> = (0..list.len())
            .map(|a| std::array::from_fn(|i| law(a, free[a][0][i], free[a][1][i])))
            .collect();
        let mut moved = free.clone();
        let allowed: Vec<f64> = list
            .iter()
            .map(|contact| {
                let contact_state = &self.contact_states[*contact];
                self.accuracy.force
                    * self.gap_force[contact_state.gap].max(contact_state.floor_force)
            })
            .collect();
        let mut settled = false;
        let mut before = f64::INFINITY;
        for round in 0..40 {
            moved.clone_from(&free);
            for (a, b, by) in &pairs {
                for part in 0..2 {
                    for i in 1..NODES {
                        let row = &by[part][i];
                        let sum: f64 = row.iter().zip(&forces[*b]).map(|(r, f)| r * f).sum();
                        moved[*a][part][i] += sum;
                    }
                }
            }
            let mut change: f64 = 0.0;
            for a in 0..list.len() {
                for i in 0..NODES {
                    let force = law(a, moved[a][0][i], moved[a][1][i]);
                    change = change.max((force - forces[a][i]).abs() / allowed[a]);
                    forces[a][i] = force;
                }
            }
            if !change.is_finite() {
                return None;
            }
            if change < 1e-2 || (change < 0.5 && change >= before) {
                settled = true;
                break;
            }
            if round > 12 && change > 0.7 * before && change > 1e3 {
                return None;
            }
            before = change;
        }
        if !settled {
            return None;
        }
        let mut error: f64 = 0.0;
        for (a, &contact) in list.iter().enumerate() {
            let terms = apply(&self.to_chebyshev, &forces[a]);
            let tail = terms[DEGREE].abs().max(0.3 * terms[DEGREE - 1].abs());
            error = error.max(tail / allowed[a]);
            pushes
                .forces
                .push((contact, apply(&self.to_monomials, &forces[a])));
            let [x, v] = &moved[a];
            courses.push((
                contact,
                apply(&self.to_monomials, x),
                apply(&self.to_monomials, v),
            ));
        }
        Some(error)
    }
}
