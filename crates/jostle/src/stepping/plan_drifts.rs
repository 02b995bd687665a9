//! Greatest drifts of the storeys of a building in plan, step by step.

use super::extremes::{BEYOND, greatest_in_step};
use crate::linear::Row;
use crate::system::{BuildingSystem, PlanStorey};

/// Motion and its rate.
type Motion = (f64, f64);

/// Drifts of the lines through centres of mass that do not lie above each other, and of the corners of every storey.
#[derive(Clone, Debug, Default)]
pub(super) struct PlanDrifts {
    /// With displacements at the places where the lists of a run hold them.
    storeys: Vec<Drifts>,
    /// Motion of every storey at the start of the step.
    before: Vec<[Motion; 3]>,
}

#[derive(Clone, Debug)]
struct Drifts {
    storey: PlanStorey,
    reach: f64,
    /// Greatest distance of a line from where it was, along x and across, and squared in all directions \[m, m²\].
    centre: [f64; 2],
    corner: f64,
}

impl PlanDrifts {
    /// Of a building whose displacement `dof` stands at `place(dof)` of the lists of a run.
    pub(super) fn new(building: &BuildingSystem, place: impl Fn(usize) -> usize) -> Self {
        let moved = |row: &Row| -> Row {
            let entries = row.entries().iter();
            entries.map(|(dof, share)| (place(*dof), *share)).collect()
        };
        let drifts = |storey: &PlanStorey| Drifts {
            reach: storey.reach(),
            storey: PlanStorey {
                above: storey.above.map(&place),
                below: storey.below.map(|dofs| dofs.map(|dof| dof.map(&place))),
                base: storey.base.as_ref().map(|rows| rows.each_ref().map(moved)),
                ..storey.clone()
            },
            centre: [0.0; 2],
            corner: 0.0,
        };
        let storeys: Vec<_> = building.plan_storeys.iter().map(drifts).collect();
        Self {
            before: Vec::with_capacity(storeys.len()),
            storeys,
        }
    }

    /// Stores displacements and velocities at the start of a step.
    pub(super) fn before_step(&mut self, u: &[f64], v: &[f64]) {
        self.before.clear();
        let storeys = self.storeys.iter();
        self.before
            .extend(storeys.map(|storey| storey.motion(u, v)));
    }

    /// Takes in a step \[s\] that ends with displacements and velocities.
    pub(super) fn after_step(&mut self, u: &[f64], v: &[f64], step: f64) {
        for (storey, then) in self.storeys.iter_mut().zip(&self.before) {
            let now = storey.motion(u, v);
            storey.take(*then, now, step);
        }
    }

    /// Calls `give` with the places of tracks and the drift ratios of lines through centres of mass that do not lie above each other.
    pub(super) fn give_to(&self, mut give: impl FnMut(usize, f64)) {
        let n = self.storeys.len();
        let storeys = self.storeys.iter().enumerate();
        for (index, drifts) in storeys.filter(|(_, drifts)| !drifts.storey.is_in_line()) {
            for (block, most) in drifts.centre.iter().enumerate() {
                give(block * n + index, most / drifts.storey.height);
            }
        }
    }

    /// Greatest drift ratio of a corner of every storey, both directions combined.
    pub(super) fn corners(&self) -> impl Iterator<Item = f64> + '_ {
        let storeys = self.storeys.iter();
        storeys.map(|storey| storey.corner.sqrt() / storey.storey.height)
    }
}

impl Drifts {
    #[inline]
    fn motion(&self, u: &[f64], v: &[f64]) -> [Motion; 3] {
        let (u, v) = (self.storey.apart(u), self.storey.apart(v));
        std::array::from_fn(|k| (u[k], v[k]))
    }

    #[inline]
    fn take(&mut self, then: [Motion; 3], now: [Motion; 3], step: f64) {
        // No further than this in the step.
        let [x, y, turned] = std::array::from_fn(|k| {
            let (then, now) = (then[k], now[k]);
            then.0.abs().max(now.0.abs()) + BEYOND * step * (then.1.abs() + now.1.abs())
        });
        let [along, across] = self.centre;
        if !self.storey.is_in_line() && (x > along || y > across) {
            for (k, most) in self.centre.iter_mut().enumerate() {
                for sign in [1.0, -1.0] {
                    let [then, now] = [then[k], now[k]].map(|(u, v)| (sign * u, sign * v));
                    *most = most.max(greatest_in_step(then, now, 0.0, step).value);
                }
            }
        }
        let furthest = (x * x + y * y).sqrt() + turned * self.reach;
        if furthest * furthest > self.corner {
            for at in &self.storey.corners {
                let [then, now] = [then, now].map(|motion| squared(motion, *at));
                self.corner = self
                    .corner
                    .max(greatest_in_step(then, now, 0.0, step).value);
            }
        }
    }
}

/// Squared motion of a point from the centre of mass above, and its rate.
#[inline]
fn squared([x, y, turned]: [Motion; 3], at: [f64; 2]) -> Motion {
    let along = (x.0 - turned.0 * at[1], x.1 - turned.1 * at[1]);
    let across = (y.0 + turned.0 * at[0], y.1 + turned.1 * at[0]);
    let square = along.0 * along.0 + across.0 * across.0;
    (square, 2.0 * (along.0 * along.1 + across.0 * across.1))
}
