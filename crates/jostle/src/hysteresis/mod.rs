//! Restoring forces with memory: trilinear hysteresis of hinges and storeys.
//!
//! A [`Hysteresis`] is a rule on a [`Backbone`] and never changes. The state of a hinge is a [`HysteresisMemory`],
//! a plain value. [`Hysteresis::respond`] goes from the committed state to a trial deformation, through all corners
//! between, and returns force, tangent, work and the state to commit if the trial is accepted. It is a pure
//! function: a repeated step starts from the same state.
//!
//! Deformations and forces are rotation \[rad\] and moment \[N·m\] of a hinge, or displacement \[m\] and force
//! \[N\] of a storey.
//!
//! ```
//! use jostle::hysteresis::{Backbone, Corners, Hysteresis, HysteresisMemory, HysteresisRule};
//!
//! let corners = Corners { cracking: 100e3, yielding: 250e3, post_cracking: 0.3, post_yield: 0.02 };
//! let backbone = Backbone::from_forces(100e6, corners, corners).expect("a sound backbone");
//! let hinge = Hysteresis::new(HysteresisRule::PeakOriented, backbone).expect("the rule fits");
//! let mut memory = HysteresisMemory::default();
//! for rotation in [0.004, -0.002, 0.008] {
//!     let response = hinge.respond(&memory, rotation);
//!     memory = response.memory; // the step is taken
//! }
//! assert!(memory.force() > 250e3);
//! ```

mod backbone;
mod buckling;
mod circular;
mod compression;
mod concrete;
mod degrading;
mod failing;
mod friction;
mod memory;
mod menegotto_pinto;
mod oriented;
mod pendulums;
mod pinched;
mod rule;
mod sliders;
mod stages_in_plan;
mod surface;
mod surface_in_space;

pub use backbone::{Backbone, BackboneSide, Corner, Corners, Quantity, Side, SpringFault};
pub use buckling::{Buckling, BucklingBrace};
pub use circular::{CircularLaw, ForceRow};
pub use concrete::ConcreteFall;
pub use failing::FallingBranch;
pub use friction::Rates;
pub use memory::{HysteresisMemory, Response, Stage};
pub use menegotto_pinto::MenegottoPinto;
pub use pendulums::SlidingStage;
pub use pinched::{GREATEST_DAMAGE, Pinching, energy_to_yield};
pub use rule::{DEFAULT_TAKEDA_EXPONENT, Hysteresis, HysteresisRule};
pub(crate) use surface::{Flow, Surface};
pub use surface::{KeptCorners, MOST_CORNERS};
pub(crate) use surface_in_space::{SpaceFlow, SpaceSurface, stated_in_space};
