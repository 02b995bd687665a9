//! What tests of several crates need. Not published.

pub mod browser;
