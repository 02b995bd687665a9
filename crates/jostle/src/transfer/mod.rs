//! The transfer room: the path from the free ends of a frame to its base, and the Riccati recursion along it.
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

pub(crate) mod path;
pub(crate) mod riccati;
