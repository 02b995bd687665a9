//! Rolled steel profiles: their properties from their sizes.

mod american;
mod european;
mod hollow;
mod i_section;

pub use hollow::{Pipe, Tube};
pub use i_section::ISection;

/// Modulus of elasticity of structural steel (EN 1993-1-1, 3.2.6) \[Pa\].
pub const STEEL_MODULUS: f64 = 210e9;

/// The same of AISC 360, 29 000 ksi \[Pa\].
pub const AISC_STEEL_MODULUS: f64 = 29e3 * 6.894_757_293e6;

/// Density of structural steel (EN 1991-1-1, table A.4) \[kg/m³\].
pub const STEEL_DENSITY: f64 = 7850.0;

/// A steel profile that is symmetric about both axes.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Profile {
    /// Of I shape.
    I(ISection),
    /// A rectangular tube.
    Tube(Tube),
    /// A round tube.
    Pipe(Pipe),
}

/// Which axis a profile bends about.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Axis {
    /// Over its depth: the usual way.
    Strong,
    /// Over its width: flanges bend.
    Weak,
}

impl Profile {
    /// A profile by its name; `None` if it is not known. European ones of I shape, such as `HEB 300`, `IPE400` or `hea-200`; American W
    /// shapes, `W14X90`; American tubes, `HSS8X6X3/8` or `HSS6.625X0.280`, by the sizes in their names.
    #[must_use]
    pub fn named(name: &str) -> Option<Self> {
        let plain = plain(name);
        let european = european::named(&plain.replace('-', "")).map(Self::I);
        european.or_else(|| american::named(&plain))
    }

    /// Modulus of elasticity of the steel of a named profile: that of its country \[Pa\].
    #[must_use]
    pub fn modulus_of(name: &str) -> f64 {
        match american::named(&plain(name)) {
            Some(_) => AISC_STEEL_MODULUS,
            None => STEEL_MODULUS,
        }
    }

    /// Names of all that are known, without tubes.
    pub fn names() -> impl Iterator<Item = &'static str> {
        european::names().chain(american::names())
    }

    /// Size in the direction of bending about an axis \[m\].
    #[must_use]
    pub fn depth(&self, axis: Axis) -> f64 {
        let [depth, width] = match self {
            Self::I(profile) => [profile.depth, profile.width],
            Self::Tube(tube) => [tube.depth, tube.width],
            Self::Pipe(pipe) => [pipe.diameter; 2],
        };
        match axis {
            Axis::Strong => depth,
            Axis::Weak => width,
        }
    }

    /// Area \[m²\].
    #[must_use]
    pub fn area(&self) -> f64 {
        match self {
            Self::I(profile) => profile.area(),
            Self::Tube(tube) => tube.area(),
            Self::Pipe(pipe) => pipe.area(),
        }
    }

    /// Second moment of area \[m⁴\].
    #[must_use]
    pub fn inertia(&self, axis: Axis) -> f64 {
        match self {
            Self::I(profile) => profile.inertia(axis),
            Self::Tube(tube) => tube.inertia(axis),
            Self::Pipe(pipe) => pipe.inertia(),
        }
    }

    /// Plastic section modulus \[m³\].
    #[must_use]
    pub fn plastic_modulus(&self, axis: Axis) -> f64 {
        match self {
            Self::I(profile) => profile.plastic_modulus(axis),
            Self::Tube(tube) => tube.plastic_modulus(axis),
            Self::Pipe(pipe) => pipe.plastic_modulus(),
        }
    }

    /// Torsion constant J, of twist that nothing keeps from warping \[m⁴\].
    ///
    /// Of an I shape ⅔ b t_f³ (1 − 0.63 t_f/b) + ⅓ (d − 2 t_f) t_w³ + 2 α D⁴, as in the tables of ArcelorMittal, after G. W. Trayer and
    /// H. W. March (NACA report 334, 1930): α = t_w/t_f (0.145 + 0.1 r/t_f), and D is the diameter of the circle in the joint of web and
    /// flange. Of a tube t³ s/3 + 4 A² t/s along the middle of its wall (EN 10210-2, annex A); of a round one twice its second moment of
    /// area.
    #[must_use]
    pub fn torsion_constant(&self) -> f64 {
        match self {
            Self::I(profile) => profile.torsion_constant(),
            Self::Tube(tube) => tube.torsion_constant(),
            Self::Pipe(pipe) => 2.0 * pipe.inertia(),
        }
    }

    /// Area that resists shear: webs between the middles of the flanges, of an I shape about its weak axis 5/6 of both flanges, half of a
    /// round tube \[m²\].
    #[must_use]
    pub fn shear_area(&self, axis: Axis) -> f64 {
        match self {
            Self::I(profile) => profile.shear_area(axis),
            Self::Tube(tube) => tube.shear_area(axis),
            Self::Pipe(pipe) => 0.5 * pipe.area(),
        }
    }
}

/// A name in capitals, without spaces.
fn plain(name: &str) -> String {
    let letters = name.chars().filter(|c| !c.is_whitespace());
    letters.map(|c| c.to_ascii_uppercase()).collect()
}
