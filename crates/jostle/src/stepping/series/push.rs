//! The force of a contact over a step.

use crate::linear::Row;

/// The force of a contact on a building over a step, positive to the right: a parabola of time.
#[derive(Clone, Debug)]
pub(super) struct Push {
    /// Over the degrees of freedom of the building.
    pub(super) row: Row,
    /// Coefficients of the powers of the time since the start of the step \[N, N/s, N/s²\].
    pub(super) force: [f64; 3],
}

impl Push {
    /// Force and its rate at a time since the start of the step \[N, N/s\].
    #[inline]
    pub(super) fn at(&self, time: f64) -> [f64; 2] {
        let [c0, c1, c2] = self.force;
        [c0 + time * (c1 + time * c2), c1 + 2.0 * time * c2]
    }
}
