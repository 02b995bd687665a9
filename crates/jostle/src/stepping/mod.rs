//! Stepping: from one instant to the next, with every impact found and none counted twice.
//!
//! [`simulate`] walks a [`crate::System`] through a [`crate::GroundMotion`]. Each building is solved alone;
//! they meet only in `coupling`. A step in which a contact closes is repeated so that it ends on the touch.

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
mod member_peaks;
pub mod modal;
mod outcome;
mod peak_change;
mod plan;
mod recorder;
mod sensitivity;
mod settle;
mod simulation;
mod springs;
mod trial;
mod within_tolerance;

pub use outcome::{Accuracy, Outcome, Pounding, Progress, RunEnd, Settings, StepError};
pub use plan::{ContactSteps, Plan};
pub use sensitivity::find_sensitivity;
pub use simulation::{simulate, simulate_from};
