//! Results of a run as numbers to report.

mod capacity;
pub mod comparison;
mod contact_constants;
pub mod contact_sensitivity;
mod counted_impact;
pub mod floor_spectra;
mod foundation;
mod friction;
pub mod gradient;
mod ground;
pub mod in_plan;
mod isolation;
pub mod isolation_bounds;
mod members;
mod parts;
pub mod registry;
mod required;
pub mod response;
mod rotation_levels;
mod sections;
mod shear_failure;
mod summarise;
pub mod summary;
mod walls_beyond_plan;

pub use contact_constants::overdamped_contacts;
pub use counted_impact::{CountedImpact, counted, find_simultaneous};
pub use foundation::foundation_warnings;
pub use friction::friction_warnings;
pub use members::{member_name, section_name};
pub use summarise::{Run, springs_of};
pub use walls_beyond_plan::wall_warnings;
