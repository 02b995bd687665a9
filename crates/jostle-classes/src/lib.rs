//! Shear buildings from what a city knows of them, by the formulas of Lu and Guan, and any row of them as a model
//! file.

mod class;
mod in_full;
mod mdof_lu;
mod model;
mod variability;

pub use class::{Class, Level};
pub use in_full::{BothWays, IN_FULL, both_ways};
pub use mdof_lu::{Capacity, Coefficients};
pub use model::{at_floors, model};
pub use variability::{lognormal, uniform};
