//! Models, motions, runs, comparisons and pages in a browser that tests of several crates share. Not published.
//!
//! Unit tests of the core cannot use it: they would see two versions of its types.

#[cfg(feature = "browser")]
pub mod browser;
pub mod compare;
#[cfg(feature = "files")]
pub mod files;
pub mod imports;
pub mod models;
pub mod motions;
pub mod runs;
pub mod scan;
mod texts;
