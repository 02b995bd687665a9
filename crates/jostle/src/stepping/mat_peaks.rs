//! Peaks of mats of isolated buildings in plan, step by step.

use super::recorder::{greatest_in_step, take_extremes};
use crate::history::{Extreme, MatPeaks};
use crate::linear::Row;
use crate::state::State;
use crate::system::{GroundsAt, MatInPlan, System};

/// Peaks of all mats in plan, and their motions at the start of the step.
#[derive(Default)]
pub(super) struct MatRecorder {
    own: Vec<Followed>,
}

struct Followed {
    building: usize,
    peaks: MatPeaks,
    /// Displacement across and rotation with their rates.
    before: [(f64, f64); 2],
    /// Displacements of the bearings along x and across, |u|² and its rate.
    bearings: Vec<([f64; 2], (f64, f64))>,
    corners: Vec<(f64, f64)>,
    /// Greatest |u|² of a bearing and of a corner \[m²\].
    squares: [Extreme; 2],
}

impl MatRecorder {
    pub(super) fn new(system: &System) -> Self {
        let buildings = system.buildings.iter().enumerate();
        let own = buildings.filter_map(|(building, own)| {
            let mat = own.mat_in_plan.as_ref()?;
            Some(Followed {
                building,
                peaks: MatPeaks::default(),
                before: [(0.0, 0.0); 2],
                bearings: vec![([0.0; 2], (0.0, 0.0)); mat.rows.len()],
                corners: vec![(0.0, 0.0); mat.corners.len()],
                squares: [Extreme::default(); 2],
            })
        });
        Self { own: own.collect() }
    }

    /// Stores the motions at the start of a step.
    pub(super) fn before_step(&mut self, system: &System, state: &State) {
        for own in &mut self.own {
            let Some((mat, motion)) = parts(system, own.building, state) else {
                continue;
            };
            own.before = [1, 2].map(|c| at(state, mat.dofs[c]));
            for (place, rows) in own.bearings.iter_mut().zip(&mat.rows) {
                *place = (
                    rows.each_ref().map(|row| row.value(motion[0])),
                    square(rows, motion),
                );
            }
            for (place, rows) in own.corners.iter_mut().zip(&mat.corners) {
                *place = square(rows, motion);
            }
        }
    }

    /// Updates the peaks with a step \[s\] that began at `start` \[s\] and ended in `state`.
    pub(super) fn after_step(
        &mut self,
        system: &System,
        state: &State,
        grounds: GroundsAt<'_>,
        start: f64,
        step: f64,
    ) {
        for own in &mut self.own {
            let building = &system.buildings[own.building];
            let Some((mat, motion)) = parts(system, own.building, state) else {
                continue;
            };
            let peaks = &mut own.peaks;
            let extremes = [&mut peaks.across, &mut peaks.rotation];
            for ((extremes, then), dof) in extremes.into_iter().zip(own.before).zip(&mat.dofs[1..])
            {
                take_extremes(extremes.each_mut(), [then, at(state, *dof)], start, step);
            }
            for (index, (rows, (moved, then))) in mat.rows.iter().zip(&own.bearings).enumerate() {
                let greatest = greatest_in_step(*then, square(rows, motion), start, step);
                if greatest.value > own.squares[0].value {
                    own.squares[0] = greatest;
                    peaks.bearing = index;
                }
                for (row, moved) in rows.iter().zip(moved) {
                    let by = row.value(motion[0]) - moved;
                    peaks.damped += mat.damping * by * by / step;
                }
            }
            for (rows, then) in mat.corners.iter().zip(&own.corners) {
                let greatest = greatest_in_step(*then, square(rows, motion), start, step);
                if greatest.value > own.squares[1].value {
                    own.squares[1] = greatest;
                }
            }
            let ground = grounds.of(own.building)[1];
            let total = (state.acceleration[mat.dofs[1]] + ground).abs();
            peaks.total_acceleration_across = peaks.total_acceleration_across.max(total);
            if let Some([_, across, _]) = building.bearing_forces(state) {
                peaks.force_across = peaks.force_across.max(across.abs());
            }
            if let Some([_, shear, torque]) = building.base_forces_in_plan(state) {
                peaks.base_shear_across = peaks.base_shear_across.max(shear.abs());
                peaks.base_torque = peaks.base_torque.max(torque.abs());
            }
            if let Some([x, y]) = building.ring_force(state) {
                peaks.ring_force = peaks.ring_force.max(libm::hypot(x, y));
            }
        }
    }

    /// Peaks of all mats with the index of their building.
    pub(super) fn finish(&mut self) -> impl Iterator<Item = (usize, MatPeaks)> + '_ {
        self.own.drain(..).map(|own| {
            let [stroke, corner] = own.squares.map(|square| Extreme {
                value: square.value.max(0.0).sqrt(),
                at: square.at,
            });
            let peaks = MatPeaks {
                stroke,
                corner: corner.value,
                ..own.peaks
            };
            (own.building, peaks)
        })
    }
}

fn at(state: &State, dof: usize) -> (f64, f64) {
    (state.displacement[dof], state.velocity[dof])
}

/// A mat, and displacements and velocities of its building.
fn parts<'a>(
    system: &'a System,
    building: usize,
    state: &'a State,
) -> Option<(&'a MatInPlan, [&'a [f64]; 2])> {
    let own = &system.buildings[building];
    let range = own.range();
    let motion = [&state.displacement[range.clone()], &state.velocity[range]];
    Some((own.mat_in_plan.as_ref()?, motion))
}

/// |u|² of a point and its rate.
fn square(rows: &[Row; 2], [displacement, velocity]: [&[f64]; 2]) -> (f64, f64) {
    let [x, y] = [0, 1].map(|axis: usize| rows[axis].value(displacement));
    let [x_rate, y_rate] = [0, 1].map(|axis: usize| rows[axis].value(velocity));
    (x * x + y * y, 2.0 * (x * x_rate + y * y_rate))
}
