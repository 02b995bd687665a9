//! Shear buildings from what a city knows of them, by the formulas of Lu and Guan, and any row of them as a model
//! file.

mod class;
mod gem;
mod in_full;
mod level;
mod mdof_lu;
mod model;
mod types;
mod variability;

pub use class::Class;
pub use gem::GemFacts;
pub use in_full::{BothWays, IN_FULL, both_ways};
pub use level::Level;
pub use mdof_lu::{Capacity, Coefficients};
pub use model::{at_floors, model};
pub use types::Types;
pub use variability::{lognormal, uniform};
