//! Concrete grades of GB 50010.

/// Strength level of a material.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Default)]
pub enum StrengthLevel {
    /// Exceeded by 95 % of the material; the default, as codes use it to check existing or inelastic structures.
    #[default]
    Characteristic,
    /// Expected strength: characteristic / (1 − 1.645 δ) with the coefficient of variation δ.
    Mean,
    /// Characteristic strength over the partial factor: for design, too low for analysis.
    Design,
}

impl StrengthLevel {
    /// Names in files and options, in the order of the variants.
    pub const NAMES: [&'static str; 3] = ["characteristic", "mean", "design"];

    /// The level of a name.
    #[must_use]
    pub fn named(name: &str) -> Option<Self> {
        let levels = [Self::Characteristic, Self::Mean, Self::Design];
        Self::NAMES
            .iter()
            .position(|known| *known == name)
            .map(|index| levels[index])
    }

    /// Name in files and options.
    #[must_use]
    pub fn name(self) -> &'static str {
        Self::NAMES[self as usize]
    }
}

/// Concrete in numbers.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Concrete {
    /// Prismatic compressive strength, > 0 \[Pa\].
    pub strength: f64,
    /// Tensile strength, ≥ 0 \[Pa\].
    pub tensile_strength: f64,
    /// Modulus of elasticity, > 0 \[Pa\].
    pub modulus: f64,
}

/// Grades C20 … C60.
pub const CONCRETE_GRADES: [&str; 9] = [
    "C20", "C25", "C30", "C35", "C40", "C45", "C50", "C55", "C60",
];

/// A row of GB 50010-2010: fck (table 4.1.3-1), ftk (4.1.3-2), fc (4.1.4-1), ft (4.1.4-2) in MPa, Ec (4.1.5) in
/// GPa, coefficient of variation (C.2.1).
const TABLE: [[f64; 6]; 9] = [
    [13.4, 1.54, 9.6, 1.10, 25.5, 0.206],
    [16.7, 1.78, 11.9, 1.27, 28.0, 0.189],
    [20.1, 2.01, 14.3, 1.43, 30.0, 0.172],
    [23.4, 2.20, 16.7, 1.57, 31.5, 0.164],
    [26.8, 2.39, 19.1, 1.71, 32.5, 0.156],
    [29.6, 2.51, 21.1, 1.80, 33.5, 0.156],
    [32.4, 2.64, 23.1, 1.89, 34.5, 0.149],
    [35.5, 2.74, 25.3, 1.96, 35.5, 0.149],
    [38.5, 2.85, 27.5, 2.04, 36.0, 0.141],
];

impl Concrete {
    /// A grade of [`CONCRETE_GRADES`] at a level of strength (GB 50010-2010, tables 4.1.3 to 4.1.5 and C.2.1).
    #[must_use]
    pub fn grade(name: &str, level: StrengthLevel) -> Option<Self> {
        let index = CONCRETE_GRADES.iter().position(|grade| *grade == name)?;
        let [fck, ftk, fc, ft, modulus, variation] = TABLE[index];
        let (strength, tensile) = match level {
            StrengthLevel::Characteristic => (fck, ftk),
            StrengthLevel::Mean => {
                let factor = 1.0 - 1.645 * variation;
                (fck / factor, ftk / factor)
            }
            StrengthLevel::Design => (fc, ft),
        };
        Some(Self {
            strength: 1e6 * strength,
            tensile_strength: 1e6 * tensile,
            modulus: 1e9 * modulus,
        })
    }

    /// From the prismatic compressive strength alone \[Pa\]: tensile strength 0.395 fcu^0.55 and modulus
    /// 10¹¹ / (2.2 + 34.7 / fcu) with fcu = fck / 0.67, in MPa (GB 50010-2010, commentary to 4.1.3 and 4.1.5).
    #[must_use]
    pub fn of_strength(strength: f64) -> Self {
        let cube = 1e-6 * strength / 0.67;
        Self {
            strength,
            tensile_strength: 1e6 * 0.309 * cube.powf(0.55),
            modulus: 1e11 / (2.2 + 34.7 / cube),
        }
    }

    /// Strain at the compressive strength, (700 + 172 √fc) 10⁻⁶ with fc in MPa (GB 50010-2010, C.2.4) \[–\].
    #[must_use]
    pub fn peak_strain(&self) -> f64 {
        (700.0 + 172.0 * (1e-6 * self.strength).sqrt()) * 1e-6
    }
}
