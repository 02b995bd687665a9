//! Greatest displacements of the corners of floors in plan.

use super::peaks::Watched;
use super::reduced::ReducedBuilding;
use crate::history::Extreme;
use crate::stepping::recorder::greatest_in_step;
use crate::system::BuildingSystem;

/// The greatest distance that a corner of every floor has moved.
#[derive(Clone, Debug, Default)]
pub(super) struct CornerPeaks {
    /// Index of the floor of every corner.
    floors: Vec<usize>,
    /// Greatest squared displacement of a corner of every floor, and its instant \[m²\].
    squares: Vec<Extreme>,
}

impl CornerPeaks {
    pub(super) fn new(building: &BuildingSystem) -> Self {
        let floors = building.corners.iter().map(|corner| corner.floor);
        Self {
            floors: floors.collect(),
            squares: vec![Extreme::default(); building.floors.len()],
        }
    }

    /// Takes in a step \[s\] that began at `start` \[s\].
    pub(super) fn follow(
        &mut self,
        own: &ReducedBuilding,
        ends: [Watched<'_>; 2],
        start: f64,
        step: f64,
    ) {
        for (corner, floor) in self.floors.iter().enumerate() {
            let at = own.corners.start + 2 * corner;
            // |u|² and its rate 2 u·u̇.
            let [then, now] = ends.map(|end| {
                let (u, v) = (&end.u[at..at + 2], &end.rate[at..at + 2]);
                (u[0] * u[0] + u[1] * u[1], 2.0 * (u[0] * v[0] + u[1] * v[1]))
            });
            let peak = &mut self.squares[*floor];
            if then.0.max(now.0) + 0.15 * step * (then.1.abs() + now.1.abs()) > peak.value {
                let greatest = greatest_in_step(then, now, start, step);
                if greatest.value > peak.value {
                    *peak = greatest;
                }
            }
        }
    }

    /// Greatest displacement of a corner of every floor \[m\].
    pub(super) fn finish(self) -> Vec<f64> {
        let squares = self.squares.into_iter();
        squares.map(|peak| peak.value.max(0.0).sqrt()).collect()
    }
}
