//! Time stepping, with event location of every impact.
//!
//! [`simulate`] runs a [`crate::System`] through a [`crate::GroundMotion`]. Each building is solved separately;
//! only `coupling` joins them. A step in which a contact closes is repeated so that it ends at first contact.

mod acceleration_parts;
mod clock;
mod collapse;
mod contact_parabola;
mod control;
mod coupling;
mod direct;
mod energy;
mod episode;
mod events;
mod expected_work;
mod extremes;
mod face_forces;
mod floor_peaks;
mod force_equations;
mod gap_forces;
mod member_peaks;
mod member_ratios;
pub mod modal;
mod near_contacts;
mod observe;
mod outcome;
mod peak_change;
mod plan;
mod plan_drifts;
mod predicted_force;
mod recorder;
mod refined;
mod runner;
mod sensitivity;
pub mod series;
mod settle;
mod sharp_peaks;
mod simulate;
mod step_friction;
mod step_link;
mod totals;

pub use expected_work::HistorySize;
pub use outcome::{Accuracy, Outcome, Pounding, Progress, RunEnd, Settings, StepError};
pub use plan::{ContactSteps, Plan};
pub use sensitivity::find_sensitivity;
pub use simulate::{simulate, simulate_from};
