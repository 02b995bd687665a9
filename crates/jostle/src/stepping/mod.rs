//! Time stepping, with event location of every impact.
//!
//! [`simulate`] runs a [`crate::System`] through a [`crate::GroundMotion`]. Each building is solved separately;
//! only `coupling` joins them. A step in which a contact closes is repeated so that it ends at first contact.

mod acceleration_parts;
mod band;
mod blow;
mod clock;
mod control;
mod coupling;
mod energy;
mod episode;
mod events;
mod expected_work;
mod factors;
mod impacts;
mod integrator;
mod joints;
mod kernels;
mod links;
pub mod modal;
mod outcome;
mod peak_change;
mod plan;
mod recorder;
mod sensitivity;
mod settle;
mod simulation;
mod springs;
mod step_matrix;
mod trial;
mod within_tolerance;

pub use integrator::Integrator;
pub use outcome::{Accuracy, Outcome, Pounding, Progress, RunEnd, Settings, StepError};
pub use plan::{ContactSteps, Plan};
pub use sensitivity::find_sensitivity;
pub use simulation::{simulate, simulate_from};
pub use step_matrix::StepMatrix;

use crate::system::BuildingSystem;

/// The equations of one step of one building, with the matrix given by a [`StepMatrix`], and their solver.
pub trait StepEquations: Sized {
    /// Data of a factorisation.
    type Factor: Default + Clone;

    /// Prepares data that do not depend on the step size.
    fn of(building: &BuildingSystem) -> Self;

    /// Factorises a matrix, reusing the memory of `factor`. `tangents` has the present stiffness of every spring
    /// that yields.
    ///
    /// # Errors
    /// [`NotPositive`] if the matrix is not positive definite.
    fn factorize(
        &self,
        matrix: &StepMatrix,
        tangents: &[f64],
        factor: &mut Self::Factor,
    ) -> Result<(), NotPositive>;

    /// Updates a factor after changes of the tangents of some springs. `factor` must belong to the same matrix
    /// apart from these tangents.
    ///
    /// # Errors
    /// [`NotPositive`]; the factor is then invalid until [`StepEquations::factorize`] succeeds.
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
    fn solve(&self, factor: &Self::Factor, load: &mut [f64]);
}

/// Displacements under one load, factorised for it alone: K̂⁻¹ `load`. Springs that yield have their initial
/// stiffness.
///
/// # Errors
/// [`NotPositive`] when K̂ is not positive definite.
pub fn solve_once<E: StepEquations>(
    building: &BuildingSystem,
    matrix: &StepMatrix,
    load: &[f64],
) -> Result<Vec<f64>, NotPositive> {
    let equations = E::of(building);
    let mut factor = E::Factor::default();
    let tangents = building.equations.initial_tangents();
    equations.factorize(matrix, &tangents, &mut factor)?;
    let mut answer = load.to_vec();
    equations.solve(&factor, &mut answer);
    Ok(answer)
}

/// A step matrix was not positive definite: the building is a mechanism.
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
#[error("the step equations are not positive definite at degree of freedom {dof}")]
pub struct NotPositive {
    /// Degree of freedom of the pivot.
    pub dof: usize,
}
