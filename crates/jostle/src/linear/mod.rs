//! Matrices and vectors that every solver uses.

pub(crate) mod cholesky;
pub(crate) mod counting_sort;
pub(crate) mod diagonal_runs;
pub(crate) mod envelope;
pub(crate) mod full_matrix;
mod quantile;
mod row;
mod sorting;
pub(crate) mod sparse_cholesky;
mod sparse_symmetric;
mod step_matrix;

pub use quantile::quantile;
pub use row::Row;
pub use sorting::{sort_by, sort_by_key};
pub use sparse_symmetric::SparseSymmetric;
pub use step_matrix::StepMatrix;

/// A matrix was not positive definite: the building can move without resistance.
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
#[error("the step equations are not positive definite at degree of freedom {dof}")]
pub struct NotPositive {
    /// Where the pivot vanished.
    pub dof: usize,
}
