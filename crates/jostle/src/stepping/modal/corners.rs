//! Greatest displacements of the corners of floors in plan.

use pulp::{Arch, NullaryFnOnce};

use super::peaks::{BEYOND, Watched};
use super::plan_rows::{PlanRow, RowTable, slot_of};
use super::reduced::ReducedBuilding;
use crate::history::Extreme;
use crate::linear::Row;
use crate::stepping::extremes::greatest_in_step;
use crate::system::BuildingSystem;

/// The greatest distance that a corner of every floor has moved.
#[derive(Clone, Debug, Default)]
pub(super) struct CornerPeaks {
    /// Displacements of corners along x and across.
    rows: [RowTable; 2],
    /// Index of the floor of every corner, in the order of the rows.
    floors: Vec<usize>,
    /// Greatest squared displacement of a corner of every floor, and its instant; the same value for every corner \[m²\].
    squares: Vec<Extreme>,
    limits: Vec<f64>,
    /// Places of displacements of floors along x, across and turning, and the greatest distance of a corner of every floor from
    /// its centre of mass \[m\].
    tracks: [usize; 3],
    arms: Vec<f64>,
    /// Displacements along x and across, then their rates, at the start and at the end of a step.
    ends: [[Vec<f64>; 4]; 2],
}

impl CornerPeaks {
    pub(super) fn new(building: &BuildingSystem, reduced_building: &ReducedBuilding) -> Self {
        let row = |row: &Row| {
            let mut sum = PlanRow {
                places: [reduced_building.watched.start; 6],
                weights: [0.0; 6],
            };
            for (dof, weight) in row.entries() {
                let mut tracks = building.tracks.iter();
                let track = tracks.position(|track| track.dof == dof + building.offset);
                // Every floor has its tracks.
                let track = track.unwrap_or(0);
                let slot = slot_of(building.tracks[track].direction);
                sum.places[slot] = reduced_building.watched.start + track;
                sum.weights[slot] = *weight;
            }
            // What does not count moves along, from floor to floor.
            for slot in 0..6 {
                if sum.weights[slot] == 0.0 {
                    sum.places[slot] = sum.places[2];
                }
            }
            sum
        };
        let rows = [0, 1].map(|axis| {
            let corners = building.corners.iter();
            let rows: Vec<PlanRow> = corners.map(|corner| row(&corner.rows[axis])).collect();
            RowTable::new(&rows)
        });
        let floors: Vec<usize> = rows[0]
            .order
            .iter()
            .map(|corner| building.corners[*corner].floor)
            .collect();
        debug_assert_eq!(rows[0].order, rows[1].order);
        let corners = floors.len();
        let count = building.floors.len();
        let mut arms = vec![0.0_f64; count];
        for corner in &building.corners {
            let arm = corner.rows.iter().map(|of| row(of).weights[2].powi(2));
            let arm = arm.sum::<f64>().sqrt();
            arms[corner.floor] = arms[corner.floor].max(arm);
        }
        Self {
            tracks: [0, 1, 2].map(|block| reduced_building.watched.start + block * count),
            arms,
            rows,
            floors,
            squares: vec![Extreme::default(); building.floors.len()],
            limits: vec![0.0; corners],
            ends: [(); 2].map(|()| [(); 4].map(|()| vec![0.0; corners])),
        }
    }

    /// Takes in a step \[s\] that began at `start` \[s\].
    pub(super) fn follow(&mut self, arch: Arch, ends: [Watched<'_>; 2], start: f64, step: f64) {
        if self.floors.is_empty() {
            return;
        }
        let far = arch.dispatch(MayReach {
            tracks: self.tracks,
            arms: &self.arms,
            ends: ends.map(|end| [end.u, end.rate]),
            squares: &self.squares,
            beyond: BEYOND * step,
        });
        if !far {
            return;
        }
        for (lists, end) in self.ends.iter_mut().zip(ends) {
            let [x, y, x_rate, y_rate] = lists;
            self.rows[0].fill(arch, end.u, x);
            self.rows[1].fill(arch, end.u, y);
            self.rows[0].fill(arch, end.rate, x_rate);
            self.rows[1].fill(arch, end.rate, y_rate);
        }
        let may = arch.dispatch(MayExceed {
            ends: &self.ends,
            limits: &self.limits,
            beyond: BEYOND * step,
        });
        if may {
            self.look(start, step);
        }
    }

    #[cold]
    fn look(&mut self, start: f64, step: f64) {
        for (corner, floor) in self.floors.iter().enumerate() {
            let [then, now] = self.ends.each_ref().map(|lists| square(lists, corner));
            let peak = &mut self.squares[*floor];
            if then.0.max(now.0) + BEYOND * step * (then.1.abs() + now.1.abs()) > peak.value {
                let greatest = greatest_in_step(then, now, start, step);
                if greatest.value > peak.value {
                    *peak = greatest;
                }
            }
        }
        for (limit, floor) in self.limits.iter_mut().zip(&self.floors) {
            *limit = self.squares[*floor].value;
        }
    }

    /// Greatest displacement of a corner of every floor \[m\].
    pub(super) fn finish(self) -> Vec<f64> {
        let squares = self.squares.into_iter();
        squares.map(|peak| peak.value.max(0.0).sqrt()).collect()
    }
}

/// |u|² of a corner and its rate 2 u·u̇.
#[inline(always)]
fn square([x, y, x_rate, y_rate]: &[Vec<f64>; 4], corner: usize) -> (f64, f64) {
    let (u, v) = ([x[corner], y[corner]], [x_rate[corner], y_rate[corner]]);
    (u[0] * u[0] + u[1] * u[1], 2.0 * (u[0] * v[0] + u[1] * v[1]))
}

/// Whether a corner of any floor may have moved further than before, from how far floors have moved and turned.
struct MayReach<'a> {
    tracks: [usize; 3],
    arms: &'a [f64],
    ends: [[&'a [f64]; 2]; 2],
    squares: &'a [Extreme],
    beyond: f64,
}

impl NullaryFnOnce for MayReach<'_> {
    type Output = bool;

    #[inline(always)]
    fn call(self) -> bool {
        let n = self.arms.len();
        let [[u0, v0], [u1, v1]] = self.ends;
        let most = |track: usize, floor: usize| {
            let at = track + floor;
            let reach = self.beyond * (v0[at].abs() + v1[at].abs());
            u0[at].abs().max(u1[at].abs()) + reach
        };
        let squares = self.squares.iter().take(n).enumerate();
        let mut squares = squares.map(|(floor, square)| {
            let [x, y, turned] = self.tracks.map(|track| most(track, floor));
            let moved = (x * x + y * y).sqrt() + turned * self.arms[floor];
            (moved * moved, square.value)
        });
        squares.any(|(moved, square)| moved > square)
    }
}

/// Whether a corner may have moved further than any of its floor before.
struct MayExceed<'a> {
    ends: &'a [[Vec<f64>; 4]; 2],
    limits: &'a [f64],
    beyond: f64,
}

impl NullaryFnOnce for MayExceed<'_> {
    type Output = bool;

    #[inline(always)]
    fn call(self) -> bool {
        let n = self.limits.len();
        let [then, now] = self.ends.each_ref().map(|lists| {
            let [x, y, x_rate, y_rate] = lists;
            [&x[..n], &y[..n], &x_rate[..n], &y_rate[..n]]
        });
        let square = |[x, y, x_rate, y_rate]: [&[f64]; 4], k: usize| {
            let rate = 2.0 * (x[k] * x_rate[k] + y[k] * y_rate[k]);
            (x[k] * x[k] + y[k] * y[k], rate.abs())
        };
        let mut most = f64::NEG_INFINITY;
        for k in 0..n {
            let (then, now) = (square(then, k), square(now, k));
            let greatest = then.0.max(now.0) + self.beyond * (then.1 + now.1);
            let over = greatest - self.limits[k];
            most = if over > most { over } else { most };
        }
        most > 0.0
    }
}
