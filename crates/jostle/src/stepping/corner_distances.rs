//! Greatest displacements of the corners of floors in plan, step by step.

use super::recorder::greatest_in_step;
use crate::history::Extreme;
use crate::state::State;
use crate::system::{Corner, System};

/// The greatest distance that a corner of every floor has moved.
///
/// It may be greatest where neither of its two displacements is, so |u|² and its rate 2 u·u̇ are followed.
pub(super) struct CornerDistances {
    /// Greatest squared displacement of a corner of every floor, building by building \[m²\].
    squares: Vec<Vec<Extreme>>,
    /// |u|² of every corner of all buildings and its rate at the start of the step.
    before: Vec<(f64, f64)>,
}

impl CornerDistances {
    pub(super) fn new(system: &System) -> Self {
        let buildings = system.buildings.iter();
        let corners = buildings.clone().map(|building| building.corners.len());
        Self {
            squares: buildings
                .map(|building| match building.corners.is_empty() {
                    true => Vec::new(),
                    false => vec![Extreme::default(); building.floors.len()],
                })
                .collect(),
            before: Vec::with_capacity(corners.sum()),
        }
    }

    /// Stores the motions at the start of a step.
    pub(super) fn before_step(&mut self, system: &System, state: &State) {
        self.before.clear();
        for building in &system.buildings {
            let range = building.range();
            let (u, v) = (&state.displacement[range.clone()], &state.velocity[range]);
            let corners = building.corners.iter();
            self.before
                .extend(corners.map(|corner| square(corner, u, v)));
        }
    }

    /// Updates the greatest distances with a step \[s\] that began at `start` \[s\] and ended in `state`.
    pub(super) fn after_step(&mut self, system: &System, state: &State, start: f64, step: f64) {
        let mut before = self.before.iter();
        for (squares, building) in self.squares.iter_mut().zip(&system.buildings) {
            let range = building.range();
            let (u, v) = (&state.displacement[range.clone()], &state.velocity[range]);
            for corner in &building.corners {
                let Some(&then) = before.next() else { return };
                let greatest = greatest_in_step(then, square(corner, u, v), start, step);
                let peak = &mut squares[corner.floor];
                if greatest.value > peak.value {
                    *peak = greatest;
                }
            }
        }
    }

    /// Greatest displacement of a corner of every floor of a building; empty in one plane \[m\].
    pub(super) fn finish(&mut self, building: usize) -> Vec<f64> {
        let squares = std::mem::take(&mut self.squares[building]).into_iter();
        squares.map(|peak| peak.value.max(0.0).sqrt()).collect()
    }
}

/// |u|² of a corner and its rate, from displacements and velocities of its building.
fn square(corner: &Corner, displacement: &[f64], velocity: &[f64]) -> (f64, f64) {
    let [x, y] = corner.rows.each_ref().map(|row| row.value(displacement));
    let [x_rate, y_rate] = corner.rows.each_ref().map(|row| row.value(velocity));
    (x * x + y * y, 2.0 * (x * x_rate + y * y_rate))
}
