//! Which neighbouring buildings of a city collide in an earthquake.
//!
//! [`Inventory`] reads and mends footprints, [`Neighbours`] finds who stands within reach of whom, [`blocks`] and
//! [`rows`] put them in lines. [`City`] draws what nobody knows and shakes every row with and without contact, and
//! [`Answers`] says how often each building is struck and how its damage changes. All lengths are metres.

#![cfg_attr(not(test), deny(clippy::disallowed_methods))] // bits of results depend on no processor

mod answers;
mod blocks;
mod building;
mod case;
mod columns;
mod draw;
mod example;
mod fault;
mod footprints;
mod inventory;
mod mend;
mod model;
mod neighbours;
mod page;
mod plane;
mod run;
mod sample;
mod shaking;
mod structure;
mod tables;

pub use answers::{Answers, BuildingAnswer, Means, PairAnswer};
pub use blocks::{Block, Line, blocks, rows};
pub use building::Building;
pub use draw::{GapWidths, number_of};
pub use example::{EXAMPLE_FILE, example_city};
pub use fault::CityError;
pub use footprints::Footprints;
pub use inventory::{Attribute, Columns, Inventory, ReadOptions};
pub use mend::Mend;
pub use model::{PairModel, Runner};
pub use neighbours::{Neighbours, Pair, Position};
pub use plane::Plane;
pub use run::{City, Done, RunOptions};
pub use sample::Sampled;
pub use tables::write_tables;
