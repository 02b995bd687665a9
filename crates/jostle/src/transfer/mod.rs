//! Elements as transfer matrices, the path from the free ends of a frame to its base, and
//! the ways to solve a step along it.
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
//! *Elements*: [`LumpedMass`], [`BeamSegment`] and [`PlanarHinge`] make a [`Transfer`], which takes the
//! [`StateVector`] of one cut to the next (theory, Eqs. T1 to T5).
//!
//! *Solvers*, all for K̂ y = r with K̂ = κ K + g M of one building: [`crate::RiccatiSweep`], the one that runs
//! use; [`ElementwiseRiccati`], the same recursion as Horner and Pilkey wrote it, element by element;
//! [`ProductEquations`], the total transfer equation as published for pounding frames, whose digits
//! [`digits_left`] counts.

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
