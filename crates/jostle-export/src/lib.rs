//! Models of jostle as scripts for other programs, so that anyone can check one with the other.
//!
//! The result is text; nothing is run and no file is opened. Features that the other program lacks are refused,
//! field by field; what it does a little differently is said in the head of the script and in
//! [`Exported::remarks`].

pub mod matrices;
pub mod openseespy;

use jostle::{GroundMotion, Model, System};

/// Input of an export.
#[derive(Clone, Copy, Debug)]
pub struct Export<'a> {
    /// The model.
    pub model: &'a Model,
    /// The same, assembled.
    pub system: &'a System,
    /// The ground motion, scaled.
    pub motion: &'a GroundMotion,
}

/// A script and what a reader must know about it.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Exported {
    /// The script.
    pub text: String,
    /// Differences between the other program and jostle; the head of the script lists them as well.
    pub remarks: Vec<String>,
}
