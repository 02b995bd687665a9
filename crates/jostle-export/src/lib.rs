//! Models of jostle as scripts for other programs, so that anyone can check one with the other.
//!
//! Text comes out, nothing is run and no file is touched. What the other program cannot do is refused, field by
//! field; what it does a little differently is said in the head of the script and in [`Exported::remarks`].

pub mod openseespy;

use jostle::{GroundMotion, Model, System};

/// What is to be exported.
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
    /// Where the other program computes something else than jostle; they stand in the head of the script as well.
    pub remarks: Vec<String>,
}
