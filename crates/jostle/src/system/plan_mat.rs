//! The mat of an isolated building in plan, as runs follow it.

use super::building::{BuildingSystem, Direction};
use crate::linear::Row;
use crate::model::PlanPoint;
use crate::structure::element::{THETA, Y};
use crate::structure::{AssembledBuilding, Mat, PlanMat, motion_at};

/// A mat that moves in both horizontal directions and turns, and what stands under it.
#[derive(Clone, Debug, PartialEq)]
pub struct MatInPlan {
    /// Displacements along x and across, and the rotation, in the vectors of a [`crate::State`].
    pub dofs: [usize; 3],
    /// Centre of mass on the site \[m\].
    pub centre: PlanPoint,
    /// Places of the bearings on the site \[m\].
    pub bearings: Vec<PlanPoint>,
    /// Their displacements along x and across, over the displacements of the building.
    pub(crate) rows: Vec<[Row; 2]>,
    /// Those of the corners of the mat.
    pub(crate) corners: Vec<[Row; 2]>,
    /// Elastic stiffness of one bearing beside what yields or slides \[N/m\].
    pub(crate) stiffness: f64,
    /// Dashpot of one bearing \[N·s/m\].
    pub(crate) damping: f64,
    /// First row of its sliders among the springs of the building, if it has some.
    pub(crate) sliders: Option<usize>,
    /// First row of the ring that stops it, if it has one.
    pub(crate) ring: Option<usize>,
}

impl MatInPlan {
    pub(super) fn new(structure: &AssembledBuilding) -> Option<Self> {
        let discretization = &structure.discretization;
        let PlanMat {
            node,
            centre,
            bearings,
            slider,
            ring,
        } = discretization.stick_model.plan_mat.as_ref()?;
        let Mat {
            stiffness, dashpot, ..
        } = discretization.mat?;
        let equations = &structure.equations;
        let dofs = [
            equations.horizontal(*node)?,
            equations.vertical(*node)?,
            equations.rotation(*node)?,
        ];
        let share = 1.0 / bearings.len() as f64;
        let first = equations.single_springs;
        let sliders = slider.map(|_| first);
        let after = sliders.map_or(first, |first| first + 3 * bearings.len());
        let mut plan = Self {
            dofs,
            centre: *centre,
            bearings: bearings.clone(),
            rows: Vec::new(),
            corners: Vec::new(),
            stiffness: share * stiffness,
            damping: share * dashpot,
            sliders,
            ring: ring.map(|_| after),
        };
        plan.rows = bearings.iter().map(|at| plan.point(*at)).collect();
        Some(plan)
    }

    /// Displacements of a point of the mat along x and across, over the displacements at which its own stand.
    fn point(&self, at: PlanPoint) -> [Row; 2] {
        let [x, y, _] = motion_at(at, self.centre);
        [x, y].map(|shares| self.dofs.into_iter().zip(shares).collect())
    }

    /// The displacement of a point of the mat in a direction, over the vectors of a [`crate::State`].
    pub(crate) fn row_at(&self, at: PlanPoint, direction: [f64; 2]) -> Row {
        let [x, y, _] = motion_at(at, self.centre);
        let shares = [0, 1, 2].map(|c| direction[0] * x[c] + direction[1] * y[c]);
        self.dofs.into_iter().zip(shares).collect()
    }

    /// Follows the corners of its plan; its displacements are still those of the building alone.
    pub(super) fn place_corners(&mut self, plan: &[PlanPoint]) {
        self.corners = plan.iter().map(|at| self.point(*at)).collect();
    }

    pub(super) fn move_to(&mut self, from: usize, to: usize) {
        self.dofs = self.dofs.map(|dof| dof - from + to);
    }

    /// Mean squared displacement of the bearings in a shape of the building.
    pub(crate) fn mean_square(&self, shape: &[f64]) -> f64 {
        let squares = self
            .rows
            .iter()
            .flatten()
            .map(|row| row.value(shape).powi(2));
        squares.sum::<f64>() / self.rows.len() as f64
    }
}

impl BuildingSystem {
    /// Degree of freedom of what stands below its lowest floor in a direction, in the vectors of a [`crate::State`]; `None` on the ground.
    pub(crate) fn dof_below_lowest(&self, direction: Direction) -> Option<usize> {
        let base = self.discretization.stick_model.plan_base;
        let of_base = |component: usize| {
            let dof = self.equations.dof((base?.footing, component))?;
            Some(dof + self.offset)
        };
        match (direction, &self.mat_in_plan) {
            (Direction::Along, _) => self.foot,
            (Direction::Up, _) => None,
            (Direction::Across, None) => of_base(Y),
            (Direction::Turning, None) => of_base(THETA),
            (Direction::Across, Some(mat)) => Some(mat.dofs[1]),
            (Direction::Turning, Some(mat)) => Some(mat.dofs[2]),
        }
    }
}
