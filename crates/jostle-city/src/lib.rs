//! Which neighbouring buildings of a city collide in an earthquake.
//!
//! [`Inventory`] reads and mends footprints, [`Neighbours`] finds who stands within reach of whom, [`blocks`] and
//! [`rows`] put them in lines. All lengths are metres.

#![cfg_attr(not(test), deny(clippy::disallowed_methods))] // bits of results depend on no processor

mod blocks;
mod example;
mod fault;
mod inventory;
mod mend;
mod neighbours;
mod plane;

pub use blocks::{Block, Line, blocks, rows};
pub use example::example_city;
pub use fault::CityError;
pub use inventory::{Attribute, Building, Columns, Inventory, ReadOptions};
pub use mend::Mend;
pub use neighbours::{Neighbours, Pair, Position};
pub use plane::Plane;
