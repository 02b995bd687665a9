//! Direct stiffness: the independent second path. Assembled from element matrices and factorised by a general
//! sparse library with its own ordering; it shares no elimination with the Riccati recursion.

use faer::linalg::solvers::Solve;
use faer::sparse::linalg::solvers::{Llt, SymbolicLlt};
use faer::sparse::{SparseColMat, Triplet};
use faer::{MatMut, Side};

use crate::element;
use crate::stepping::{NotPositive, StepEquations};
use crate::system::BuildingSystem;

/// Element entries of K̂ = κ K + g M of one building.
#[derive(Clone, Debug)]
pub struct DirectStiffness {
    order: usize,
    stiffness: Vec<(usize, usize, f64)>,
    mass: Vec<f64>,
}

/// A factorised step matrix.
#[derive(Clone, Debug, Default)]
pub struct DirectFactor(Option<Llt<usize, f64>>);

impl StepEquations for DirectStiffness {
    type Factor = DirectFactor;

    fn of(building: &BuildingSystem) -> Self {
        let equations = &building.equations;
        let entries = element::stiffnesses(&building.idealisation.skeleton)
            .flat_map(|element| element.entries);
        let stiffness = entries
            .filter_map(|(a, b, value)| Some((equations.dof(a)?, equations.dof(b)?, value)))
            .filter(|(row, column, _)| row >= column)
            .collect();
        Self {
            order: equations.len(),
            stiffness,
            mass: equations.mass.clone(),
        }
    }

    fn factorize(
        &self,
        stiffness_factor: f64,
        mass_factor: f64,
        factor: &mut DirectFactor,
    ) -> Result<(), NotPositive> {
        let members = self.stiffness.iter().map(|&(row, col, value)| Triplet {
            row,
            col,
            val: stiffness_factor * value,
        });
        let inertia = self.mass.iter().enumerate().map(|(dof, mass)| Triplet {
            row: dof,
            col: dof,
            val: mass_factor * mass,
        });
        let triplets: Vec<_> = members.chain(inertia).collect();
        let failed = NotPositive { dof: 0 };
        let matrix =
            SparseColMat::<usize, f64>::try_new_from_triplets(self.order, self.order, &triplets)
                .map_err(|_| failed)?;
        let symbolic = SymbolicLlt::try_new(matrix.symbolic(), Side::Lower).map_err(|_| failed)?;
        factor.0 = Some(
            Llt::try_new_with_symbolic(symbolic, matrix.as_ref(), Side::Lower)
                .map_err(|_| failed)?,
        );
        Ok(())
    }

    fn solve(&self, factor: &DirectFactor, load: &mut [f64]) {
        if let Some(llt) = &factor.0 {
            llt.solve_in_place(MatMut::from_column_major_slice_mut(load, self.order, 1));
        }
    }
}
