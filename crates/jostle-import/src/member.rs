//! What a text model says of columns, beams, braces, floors and supports, in SI.

use std::collections::BTreeMap;

/// Heights nearer than this are one level \[m\].
pub(crate) const ONE_HEIGHT: f64 = 0.01;

/// A column, beam or brace. Axis 1 runs from its first to its other end; axis 2 stands upright, or along X in a vertical member, turned
/// by `angle`.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Member {
    /// For messages: `column "C1" of storey "Story2"`.
    pub(crate) shown: String,
    /// Ends \[m\], Z above the datum of the model.
    pub(crate) ends: [[f64; 3]; 2],
    pub(crate) section: String,
    /// Turn of its local axes \[degrees\].
    pub(crate) angle: f64,
    /// What each end does not pass on: along the axes 1, 2, 3, and about them.
    pub(crate) releases: [[bool; 6]; 2],
    /// Stiff lengths at both ends, which do not bend \[m\].
    pub(crate) stiff_ends: [f64; 2],
    /// Whether it is moved aside of its joints, or has end lengths that the source finds from the sizes of other members.
    pub(crate) moved: bool,
    /// Its own factors on the six numbers of its section.
    pub(crate) factors: [f64; 6],
    /// Its own material in place of that of its section.
    pub(crate) material: Option<String>,
}

impl Member {
    /// Names of what an end may not pass on, in the order of `releases`.
    pub(crate) const RELEASES: [&'static str; 6] = ["P", "V2", "V3", "T", "M2", "M3"];

    pub(crate) fn new(shown: String, ends: [[f64; 3]; 2]) -> Self {
        Self {
            shown,
            ends,
            section: String::new(),
            angle: 0.0,
            releases: [[false; 6]; 2],
            stiff_ends: [0.0; 2],
            moved: false,
            factors: [1.0; 6],
            material: None,
        }
    }

    /// Factors on the six numbers of its section, the member's times the section's.
    pub(crate) fn factors_with(&self, section: &SectionFacts) -> [f64; 6] {
        std::array::from_fn(|index| self.factors[index] * section.factors[index])
    }

    /// Name of its material.
    pub(crate) fn material<'a>(&'a self, section: &'a SectionFacts) -> &'a str {
        self.material.as_deref().unwrap_or(&section.material)
    }

    pub(crate) fn is_released(&self) -> bool {
        self.releases.as_flattened().contains(&true)
    }
}

/// A section. Six numbers are area, shear areas along 2 and 3, torsion constant, second moments of area about 2 and 3.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct SectionFacts {
    pub(crate) shape: String,
    pub(crate) material: String,
    /// Depth along axis 2 and width along axis 3 \[m\].
    pub(crate) size: [Option<f64>; 2],
    /// Thickness of flanges and of webs \[m\].
    pub(crate) plates: [Option<f64>; 2],
    /// Width and thickness of the bottom flange, where it differs \[m\].
    pub(crate) bottom: [Option<f64>; 2],
    /// Material inside of a filled section.
    pub(crate) fill: Option<String>,
    /// The six numbers that the file states \[m², m⁴\].
    pub(crate) stated: [Option<f64>; 6],
    /// Product of inertia I23, of sections whose axes 2 and 3 are not principal ones \[m⁴\].
    pub(crate) product: f64,
    /// Factors on them.
    pub(crate) factors: [f64; 6],
}

impl Default for SectionFacts {
    /// Without numbers, and with factors of 1.
    fn default() -> Self {
        Self {
            shape: String::new(),
            material: String::new(),
            size: [None; 2],
            plates: [None; 2],
            bottom: [None; 2],
            fill: None,
            stated: [None; 6],
            product: 0.0,
            factors: [1.0; 6],
        }
    }
}

/// A joint that the ground holds.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Support {
    /// For messages: `point "4" of storey "Base"`.
    pub(crate) shown: String,
    pub(crate) at: [f64; 3],
    /// Along X, Y, Z, and about them.
    pub(crate) held: [bool; 6],
}

/// An upright panel of a wall between two levels.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Wall {
    /// For messages: `wall "W1" of storey "Story2"`.
    pub(crate) shown: String,
    /// In the order of the file \[m\].
    pub(crate) corners: Vec<[f64; 3]>,
    pub(crate) property: String,
    /// Its own factors, in the order of its property's.
    pub(crate) factors: [f64; 4],
    /// Its own thickness in place of its property's \[m\].
    pub(crate) thickness: Option<f64>,
    /// Its own material in place of its property's.
    pub(crate) material: Option<String>,
}

/// Thickness and material of walls.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct WallFacts {
    pub(crate) material: String,
    /// \[m\]
    pub(crate) thickness: Option<f64>,
    /// Factors on stiffness along the height, in shear, in bending across the wall and in twisting.
    pub(crate) factors: [f64; 4],
}

impl Default for WallFacts {
    fn default() -> Self {
        Self {
            material: String::new(),
            thickness: None,
            factors: [1.0; 4],
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
    pub(crate) walls: Vec<Wall>,
    pub(crate) wall_properties: BTreeMap<String, WallFacts>,
    /// Floor slabs that bend in the source, for messages.
    pub(crate) bending_slabs: Vec<String>,
    /// Diaphragms that are not rigid.
    pub(crate) semirigid: Vec<String>,
    pub(crate) supports: Vec<Support>,
    /// Joints on springs, for messages.
    pub(crate) on_springs: Vec<String>,
    /// Joints that do not move with their floor.
    pub(crate) disconnected: Vec<[f64; 3]>,
    /// Rigid floors by name, and the joints that each holds at one height.
    pub(crate) diaphragms: Vec<Diaphragm>,
    /// Corners of floor areas, which connect what stands on them.
    pub(crate) floor_areas: Vec<Vec<[f64; 3]>>,
}

/// A rigid floor at one height.
#[derive(Clone, Debug, Default, PartialEq)]
pub(crate) struct Diaphragm {
    pub(crate) name: String,
    /// Joints and corners of areas that it holds \[m\].
    pub(crate) joints: Vec<[f64; 3]>,
}

impl TextModel {
    /// Adds a joint to a diaphragm, one for each name and height.
    pub(crate) fn hold(&mut self, name: &str, at: [f64; 3]) {
        let is = |floor: &&mut Diaphragm| {
            floor.name == name && (floor.joints[0][2] - at[2]).abs() < ONE_HEIGHT
        };
        match self.diaphragms.iter_mut().find(is) {
            Some(floor) => floor.joints.push(at),
            None => self.diaphragms.push(Diaphragm {
                name: name.to_owned(),
                joints: vec![at],
            }),
        }
    }
}
