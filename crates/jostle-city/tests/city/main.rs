//! Cities from footprints to neighbours.

#![allow(clippy::unwrap_used, reason = "a test that fails here says where")]

mod mends;
mod neighbours;
mod runs;
mod scan;
mod shaking;
