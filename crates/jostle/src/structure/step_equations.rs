//! How the equations of a step of one building are solved.

use super::AssembledBuilding;
use crate::linear::{NotPositive, StepMatrix};

/// The equations of one step of one building, with the matrix a [`StepMatrix`] asks for, and how to solve them.
pub trait StepEquations: Sized {
    /// What is kept of a factorisation.
    type Factor: Default + Clone;

    /// Memory that a solution needs and that holds nothing between solutions.
    type Scratch: Default;

    /// Prepares what does not depend on the step size.
    fn new(building: &AssembledBuilding) -> Self;

    /// Factorises a matrix, reusing the memory of `factor`. `tangents` has the present stiffness of every spring
    /// that yields.
    ///
    /// # Errors
    /// [`NotPositive`] when the matrix is not positive definite.
    fn factorize(
        &self,
        matrix: &StepMatrix,
        tangents: &[f64],
        factor: &mut Self::Factor,
    ) -> Result<(), NotPositive>;

    /// Factorises anew what the tangents of some springs have changed. `factor` must be one of the same matrix that
    /// differs in nothing else.
    ///
    /// # Errors
    /// [`NotPositive`]; the factor is then of no use until [`StepEquations::factorize`] succeeds.
    fn update(
        &self,
        matrix: &StepMatrix,
        tangents: &[f64],
        changed: &[usize],
        factor: &mut Self::Factor,
    ) -> Result<(), NotPositive> {
        let _ = changed;
        self.factorize(matrix, tangents, factor)
    }

    /// Replaces a load by the displacement it causes.
    fn solve(&self, factor: &Self::Factor, load: &mut [f64], scratch: &mut Self::Scratch);
}

/// Displacements under one load, factorised for it alone: K̂⁻¹ `load`. Springs that yield have their initial
/// stiffness.
///
/// # Errors
/// [`NotPositive`] when K̂ is not positive definite.
pub fn solve_once<E: StepEquations>(
    building: &AssembledBuilding,
    matrix: &StepMatrix,
    load: &[f64],
) -> Result<Vec<f64>, NotPositive> {
    let equations = E::new(building);
    let mut factor = E::Factor::default();
    let tangents = building.equations.initial_tangents();
    equations.factorize(matrix, &tangents, &mut factor)?;
    let mut answer = load.to_vec();
    equations.solve(&factor, &mut answer, &mut E::Scratch::default());
    Ok(answer)
}
