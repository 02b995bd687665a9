//! Transfer matrices of elements, the path from the free ends of a frame to its base, and solvers of a step along
//! it.
//!
//! ```text
//!   y,qy ↑   θ,m ↺                 roof  ●──∿──○──○──∿──●       ● joint   ○ lumped mass
//!        └──→ x,qx                       │              │       ∿ hinge   ─ massless beam
//!                                        ○              ○
//!   state  z = [x, y, θ, m, qx, qy]      │   beams are  │       1. along every beam, left to right
//!   m, q: what the input side exerts     ○   traversed  ○       2. up every column between floors
//!   on the output side                   │   to the     │       3. floor by floor, upwards
//!                                        ●── right  ────●
//!                                        │              │
//!                                       ▔▔▔            ▔▔▔
//! ```

//!
//! *Elements*: [`LumpedMass`], [`BeamSegment`] and [`PlanarHinge`] give a [`Transfer`], which maps the
//! [`StateVector`] of one cut to the next (theory, Eqs. T1 to T5).
//!
//! *Solvers*, all for K̂ y = r with K̂ = κ K + g M of one building: [`crate::RiccatiSweep`], used in runs;
//! [`ElementwiseRiccati`], the same recursion element by element, as published by Horner and Pilkey;
//! [`ProductEquations`], the total transfer equation as published for pounding frames; [`digits_left`] estimates
//! its accuracy.

mod batched_chains;
mod beam;
mod condensed_beam;
mod digits;
mod elementwise;
mod hinge;
mod joint_band;
mod layout;
mod lumped_mass;
mod product;
mod state_vector;
mod transfer_matrix;

mod packed_factor;
pub(crate) mod riccati;

pub use beam::{BeamSegment, Heading};
pub use digits::digits_left;
pub use elementwise::{ElementwiseFactor, ElementwiseRiccati};
pub use hinge::PlanarHinge;
pub use layout::NotAFrame;
pub use lumped_mass::{LumpedMass, apart, one_in_two_out, two_in_one_out, two_in_two_out};
pub use product::{ProductEquations, ProductFactor, ProductRefusal, measured_loss};
pub use state_vector::StateVector;
pub use transfer_matrix::Transfer;
