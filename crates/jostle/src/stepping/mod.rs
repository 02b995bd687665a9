//! Stepping: from one instant to the next, with every impact found and none counted twice.
//!
//! [`simulate`] walks a [`crate::System`] through a [`crate::GroundMotion`]. Each building is solved alone;
//! they meet only in `coupling`. A step in which a contact closes is repeated so that it ends on the touch.

mod clock;
mod coupling;
mod energy;
mod events;
mod factors;
mod impacts;
mod lanes;
mod newmark;
mod outcome;
mod plan;
mod recorder;
mod simulation;
mod trial;

pub use newmark::Newmark;
pub use outcome::{Outcome, Pounding, Progress, RunEnd, Settings, StepError};
pub use plan::{ContactSteps, Plan};
pub use simulation::{simulate, simulate_from};

use crate::system::BuildingSystem;

/// The equations of one step of one building, K̂ = κ K + g M, and how to solve them.
pub trait StepEquations: Sized {
    /// What is kept of a factorisation.
    type Factor: Default + Clone;

    /// Prepares whatever does not depend on the step size.
    fn of(building: &BuildingSystem) -> Self;

    /// Factorises `stiffness_factor`·K + `mass_factor`·M, reusing the memory of `factor`.
    ///
    /// # Errors
    /// [`NotPositive`] when the matrix is not positive definite.
    fn factorize(
        &self,
        stiffness_factor: f64,
        mass_factor: f64,
        factor: &mut Self::Factor,
    ) -> Result<(), NotPositive>;

    /// Replaces a load by the displacement it causes.
    fn solve(&self, factor: &Self::Factor, load: &mut [f64]);
}

/// Displacements under one load, factorised for it alone: K̂⁻¹ `load` with K̂ = κ K + g M.
///
/// # Errors
/// [`NotPositive`] when K̂ is not positive definite.
pub fn solve_once<E: StepEquations>(
    building: &BuildingSystem,
    stiffness_factor: f64,
    mass_factor: f64,
    load: &[f64],
) -> Result<Vec<f64>, NotPositive> {
    let equations = E::of(building);
    let mut factor = E::Factor::default();
    equations.factorize(stiffness_factor, mass_factor, &mut factor)?;
    let mut answer = load.to_vec();
    equations.solve(&factor, &mut answer);
    Ok(answer)
}

/// A step matrix was not positive definite: the building can move without resistance.
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
#[error("the step equations are not positive definite at degree of freedom {dof}")]
pub struct NotPositive {
    /// Where the pivot vanished.
    pub dof: usize,
}
