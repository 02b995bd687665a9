//! What a text model says of columns, beams and floors, in SI.

use std::collections::BTreeMap;

/// A column or beam from its lower or first end to the other.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Member {
    /// For messages: `column "C1" of storey "Story2"`.
    pub(crate) shown: String,
    /// Ends \[m\], Z above the datum of the model.
    pub(crate) ends: [[f64; 3]; 2],
    pub(crate) section: String,
    /// Turn of its local axes \[degrees\].
    pub(crate) angle: f64,
    pub(crate) released: bool,
    /// Offsets or insertion points that shorten or move it.
    pub(crate) offset: bool,
}

/// A section.
#[derive(Clone, Debug, Default, PartialEq)]
pub(crate) struct SectionFacts {
    pub(crate) shape: String,
    pub(crate) material: String,
    /// Depth and width of a rectangle \[m\].
    pub(crate) size: [Option<f64>; 2],
    /// Factors on I33, I22 and torsion.
    pub(crate) factors: [f64; 3],
    /// Factors on area and shear areas that are not 1.
    pub(crate) others: bool,
}

impl SectionFacts {
    pub(crate) fn new() -> Self {
        Self {
            factors: [1.0; 3],
            ..Self::default()
        }
    }
}

/// A text model.
#[derive(Clone, Debug, Default)]
pub(crate) struct TextModel {
    pub(crate) file: String,
    pub(crate) members: Vec<Member>,
    pub(crate) sections: BTreeMap<String, SectionFacts>,
    /// Modulus of elasticity \[Pa\] and Poisson's ratio.
    pub(crate) materials: BTreeMap<String, [f64; 2]>,
    /// Walls, for messages; braces are members.
    pub(crate) walls: Vec<String>,
    /// Floor slabs that bend in the source, for messages.
    pub(crate) bending_slabs: Vec<String>,
    /// Diaphragms that are not rigid.
    pub(crate) semirigid: Vec<String>,
    /// Supported joints that are not fixed in every direction, or stand on springs.
    pub(crate) loose_feet: Vec<String>,
}
