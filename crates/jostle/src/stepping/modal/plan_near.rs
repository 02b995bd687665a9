//! Contacts of buildings in space that a step can concern: near touching, or with a closing beyond all before.

use pulp::{Arch, NullaryFnOnce};

use super::peaks::{BEYOND, Watched};
use super::plan_rows::PlanRows;
use crate::history::Extreme;
use crate::interface::Contact;

/// Rows looked at together.
const CHUNK: usize = 8;

/// Bounds of the closings of all contacts, in the order of the rows.
#[derive(Clone, Debug)]
pub(super) struct PlanNear {
    /// Rows of all closings in lists of monitored quantities.
    first: usize,
    /// Contact of every row; `None` for friction and ends of edges.
    contacts: Vec<Option<usize>>,
    /// Closing from which a contact is near touching, and greatest closing so far \[m\].
    near: Vec<f64>,
    greatest: Vec<f64>,
    /// Gap, wider by what is crushed, and how far a contact has opened since it was closed \[m\].
    widths: Vec<f64>,
    clearance: Vec<f64>,
    tolerance: f64,
    /// Rows and contacts just found.
    rows: Vec<usize>,
    found: Vec<usize>,
}

impl PlanNear {
    pub(super) fn new(plan: &PlanRows, contacts: &[Contact], tolerance: f64) -> Self {
        let rows = plan.end - plan.first;
        let mut plan_near = Self {
            first: plan.first,
            contacts: vec![None; rows],
            near: vec![f64::INFINITY; rows],
            greatest: vec![f64::INFINITY; rows],
            widths: vec![0.0; rows],
            clearance: vec![f64::INFINITY; rows],
            tolerance,
            rows: Vec::with_capacity(rows),
            found: Vec::with_capacity(rows),
        };
        for (index, contact) in contacts.iter().enumerate() {
            let row = plan.place(index);
            plan_near.contacts[row] = Some(index);
            plan_near.widths[row] = contact.touches_at();
            plan_near.set_greatest(row, Extreme::default().value);
        }
        plan_near
    }

    fn set_greatest(&mut self, row: usize, closing: f64) {
        self.greatest[row] = closing;
        // Contacts made or missed within the tolerance are near as well.
        let doubt = self.tolerance * self.widths[row].max(closing);
        self.near[row] = self.widths[row] - doubt;
    }

    /// Contacts that a step can bring near touching, in rising order.
    pub(super) fn find_near(&mut self, arch: Arch, ends: [[&[f64]; 2]; 2], step: f64) -> &[usize] {
        let (near, rows) = (&self.near, &mut self.rows);
        find(arch, near, self.first, ends, step, rows);
        self.found.clear();
        let contacts = self.rows.iter().filter_map(|row| self.contacts[*row]);
        self.found.extend(contacts);
        self.found.sort_unstable();
        &self.found
    }

    /// Raises the greatest closings of all contacts by a step that began at `start` \[s\].
    pub(super) fn raise(
        &mut self,
        arch: Arch,
        [then, now]: [Watched<'_>; 2],
        raised: impl Fn(usize, &mut Extreme),
        step: f64,
        closings: &mut [Extreme],
    ) {
        let ends = [[then.u, then.rate], [now.u, now.rate]];
        let (greatest, mut rows) = (&self.greatest, std::mem::take(&mut self.rows));
        find(arch, greatest, self.first, ends, step, &mut rows);
        for &row in &rows {
            if let Some(contact) = self.contacts[row] {
                let closing = &mut closings[contact];
                raised(contact, closing);
                self.set_greatest(row, closing.value);
            }
        }
        self.rows = rows;
    }

    /// Notes how far contacts have opened.
    pub(super) fn open(&mut self, arch: Arch, closings: &[f64]) {
        arch.dispatch(Open {
            widths: &self.widths,
            closings: &closings[self.first..],
            clearance: &mut self.clearance,
        });
    }

    /// How far a contact has opened since it was closed \[m\].
    pub(super) fn clearance(&self, plan: &PlanRows, contact: usize) -> f64 {
        self.clearance[plan.place(contact)]
    }

    /// A contact has opened, with a gap of this width from now on \[m\].
    pub(super) fn after_release(&mut self, plan: &PlanRows, contact: usize, width: f64) {
        let row = plan.place(contact);
        self.clearance[row] = 0.0;
        if width != self.widths[row] {
            self.widths[row] = width;
            self.set_greatest(row, self.greatest[row]);
        }
    }
}

/// Rows whose cubic over a step, from values and slopes at its ends, can exceed a bound.
fn find(
    arch: Arch,
    bounds: &[f64],
    first: usize,
    ends: [[&[f64]; 2]; 2],
    step: f64,
    rows: &mut Vec<usize>,
) {
    rows.clear();
    arch.dispatch(Find {
        bounds,
        ends: ends.map(|end| end.map(|list| &list[first..first + bounds.len()])),
        beyond: BEYOND * step,
        rows,
    });
}

struct Find<'a> {
    bounds: &'a [f64],
    ends: [[&'a [f64]; 2]; 2],
    beyond: f64,
    rows: &'a mut Vec<usize>,
}

impl NullaryFnOnce for Find<'_> {
    type Output = ();

    #[inline(always)]
    fn call(self) {
        let n = self.bounds.len();
        let [[u0, v0], [u1, v1]] = self.ends.map(|end| end.map(|list| &list[..n]));
        let over = |k: usize| {
            let most = if u0[k] > u1[k] { u0[k] } else { u1[k] };
            most + self.beyond * (v0[k].abs() + v1[k].abs()) - self.bounds[k]
        };
        let whole = n - n % CHUNK;
        for from in (0..whole).step_by(CHUNK) {
            let mut all = [0.0; CHUNK];
            for (lane, value) in all.iter_mut().enumerate() {
                *value = over(from + lane);
            }
            let mut most = all;
            for width in [4, 2, 1] {
                for lane in 0..width {
                    let other = most[lane + width];
                    most[lane] = if other > most[lane] {
                        other
                    } else {
                        most[lane]
                    };
                }
            }
            if most[0] >= 0.0 {
                let lanes = all.iter().enumerate();
                let found = lanes.filter(|(_, value)| **value >= 0.0);
                self.rows.extend(found.map(|(lane, _)| from + lane));
            }
        }
        self.rows.extend((whole..n).filter(|k| over(*k) >= 0.0));
    }
}

struct Open<'a> {
    widths: &'a [f64],
    closings: &'a [f64],
    clearance: &'a mut [f64],
}

impl NullaryFnOnce for Open<'_> {
    type Output = ();

    #[inline(always)]
    fn call(self) {
        let n = self.widths.len();
        let (closings, clearance) = (&self.closings[..n], &mut self.clearance[..n]);
        for k in 0..n {
            let clear = self.widths[k] - closings[k];
            clearance[k] = if clear > clearance[k] {
                clear
            } else {
                clearance[k]
            };
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Just those rows whose cubic bound exceeds their limit are found, in any place of a chunk.
    #[test]
    fn rows_beyond_their_bounds_are_found() {
        let list = |n: usize, seed: f64| -> Vec<f64> {
            (0..n).map(|i| (seed + 1.7 * i as f64).sin()).collect()
        };
        for n in [1, 7, 8, 9, 50] {
            let (first, step) = (3, 0.2);
            let lists: [Vec<f64>; 4] = [0.1, 0.7, 1.3, 2.9].map(|seed| list(first + n, seed));
            let [u0, v0, u1, v1] = lists.each_ref().map(|list| &list[..]);
            let most = |k: usize| {
                let at = first + k;
                u0[at].max(u1[at]) + BEYOND * step * (v0[at].abs() + v1[at].abs())
            };
            for beyond in 0..n {
                let bound = |k: usize| most(k) + if k == beyond { -1e-9 } else { 1e-9 };
                let bounds: Vec<f64> = (0..n).map(bound).collect();
                let mut rows = Vec::new();
                let ends = [[u0, v0], [u1, v1]];
                find(Arch::new(), &bounds, first, ends, step, &mut rows);
                assert_eq!(rows, [beyond], "of {n}");
            }
        }
    }
}
