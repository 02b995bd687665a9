//! The solver of the step equations of one building, as the plan names it.

use crate::linear::{NotPositive, StepMatrix};
use crate::model::Solver;
use crate::stiffness::{DirectFactor, DirectStiffness};
use crate::structure::{AssembledBuilding, StepEquations};
use crate::transfer::riccati::{RiccatiFactor, RiccatiScratch, RiccatiSweep};
use crate::transfer::{ProductEquations, ProductFactor};

/// The step equations of one building. One type for all solvers, so that stepping is compiled once: the choice costs one
/// branch per solution.
#[allow(
    clippy::large_enum_variant,
    reason = "one for each building of a run, and never moved while stepping"
)]
pub(super) enum SolverEquations {
    Riccati(RiccatiSweep),
    Stiffness(DirectStiffness),
    Product(ProductEquations),
}

/// A factorised step matrix; the parts of other solvers are empty.
#[derive(Clone, Debug, Default)]
pub(super) struct SolverFactor {
    riccati: RiccatiFactor,
    stiffness: DirectFactor,
    product: ProductFactor,
}

impl SolverEquations {
    /// The equations of a building for a solver that steps all degrees of freedom; the recursion for any other.
    pub(super) fn new(solver: Solver, building: &AssembledBuilding) -> Self {
        match solver {
            Solver::Stiffness => Self::Stiffness(DirectStiffness::new(building)),
            Solver::Product => Self::Product(ProductEquations::new(building)),
            Solver::Riccati | Solver::Modal | Solver::Series => {
                Self::Riccati(RiccatiSweep::new(building))
            }
        }
    }

    /// As [`StepEquations::factorize`].
    pub(super) fn factorize(
        &self,
        matrix: &StepMatrix,
        tangents: &[f64],
        factor: &mut SolverFactor,
    ) -> Result<(), NotPositive> {
        match self {
            Self::Riccati(riccati) => riccati.factorize(matrix, tangents, &mut factor.riccati),
            Self::Stiffness(stiffness) => {
                stiffness.factorize(matrix, tangents, &mut factor.stiffness)
            }
            Self::Product(product) => product.factorize(matrix, tangents, &mut factor.product),
        }
    }

    /// As [`StepEquations::update`].
    pub(super) fn update(
        &self,
        matrix: &StepMatrix,
        tangents: &[f64],
        changed: &[usize],
        factor: &mut SolverFactor,
    ) -> Result<(), NotPositive> {
        match self {
            Self::Riccati(riccati) => {
                riccati.update(matrix, tangents, changed, &mut factor.riccati)
            }
            Self::Stiffness(stiffness) => {
                stiffness.update(matrix, tangents, changed, &mut factor.stiffness)
            }
            Self::Product(product) => {
                product.update(matrix, tangents, changed, &mut factor.product)
            }
        }
    }

    /// As [`StepEquations::solve`].
    pub(super) fn solve(
        &self,
        factor: &SolverFactor,
        load: &mut [f64],
        scratch: &mut RiccatiScratch,
    ) {
        match self {
            Self::Riccati(riccati) => riccati.solve(&factor.riccati, load, scratch),
            Self::Stiffness(stiffness) => stiffness.solve(&factor.stiffness, load, &mut ()),
            Self::Product(product) => product.solve(&factor.product, load, &mut ()),
        }
    }
}
