//! How far a floor in plan moves against what is below it, line by vertical line.

use crate::linear::Row;
use crate::model::PlanPoint;

/// A storey of a building in plan. A rigid floor moves and turns against the one below, so that every vertical line has a drift of
/// its own.
#[derive(Clone, Debug, PartialEq)]
pub struct PlanStorey {
    /// Displacements along x and across and rotation of the floor above, among those of the building.
    pub above: [usize; 3],
    /// Of the floor or the mat below; `None` is the ground.
    pub below: Option<[Option<usize>; 3]>,
    /// If the building stands on springs: rocking of its base along and across, displacements per height that are no drift.
    pub base: Option<[Row; 2]>,
    /// Centre of mass above less the one below; zero over the ground \[m\].
    pub offset: [f64; 2],
    /// Corners of the smaller of both plans, from the centre of mass above \[m\].
    pub corners: Vec<[f64; 2]>,
    /// Its height \[m\].
    pub height: f64,
}

/// Displacements, centre of mass and plan of what is below.
type Below<'a> = ([Option<usize>; 3], PlanPoint, &'a [PlanPoint]);

impl PlanStorey {
    /// Between a floor, given by its displacements, its centre and its plan, and what is below.
    pub(super) fn new(
        (above, centre, plan): ([usize; 3], PlanPoint, &[PlanPoint]),
        below: Option<Below<'_>>,
        height: f64,
    ) -> Self {
        let smaller = match below {
            Some((.., other)) if area(other) < area(plan) => other,
            _ => plan,
        };
        let offset = below.map_or([0.0; 2], |(_, other, _)| {
            [centre[0] - other[0], centre[1] - other[1]]
        });
        Self {
            above,
            below: below.map(|(dofs, ..)| dofs),
            base: None,
            offset,
            corners: smaller
                .iter()
                .map(|at| [at[0] - centre[0], at[1] - centre[1]])
                .collect(),
            height,
        }
    }

    /// Whether the centres of mass of both floors lie above each other, so that differences of their displacements are the drift of
    /// one line.
    #[must_use]
    pub fn is_in_line(&self) -> bool {
        self.offset == [0.0; 2] && self.base.is_none()
    }

    /// Motion of the floor above against the vertical line through its centre of mass, along x and across, and its rotation against
    /// the floor below, from displacements or velocities of the building \[m, rad\].
    #[must_use]
    #[inline]
    pub fn apart(&self, values: &[f64]) -> [f64; 3] {
        let [x, y, turned] = self.above.map(|dof| values[dof]);
        let [below_x, below_y, below_turned] = match self.below {
            Some(dofs) => dofs.map(|dof| dof.map_or(0.0, |dof| values[dof])),
            None => [0.0; 3],
        };
        let [along, across] = self.offset;
        let [rocked_x, rocked_y] = match &self.base {
            Some([along, across]) => [along, across].map(|row| self.height * row.value(values)),
            None => [0.0; 2],
        };
        [
            x - (below_x - below_turned * across) - rocked_x,
            y - (below_y + below_turned * along) - rocked_y,
            turned - below_turned,
        ]
    }

    /// Greatest distance of a corner from the centre of mass above \[m\].
    pub(crate) fn reach(&self) -> f64 {
        let distances = self.corners.iter().map(|[x, y]| libm::hypot(*x, *y));
        distances.fold(0.0, f64::max)
    }
}

/// Area of a polygon \[m²\].
fn area(plan: &[PlanPoint]) -> f64 {
    let next = plan.iter().cycle().skip(1);
    let twice = plan
        .iter()
        .zip(next)
        .map(|(a, b)| a[0] * b[1] - b[0] * a[1]);
    0.5 * twice.sum::<f64>().abs()
}
