//! Concrete grades of GB 50010 and EN 1992-1-1, and concrete by the specified strength of ACI 318.

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
    /// Strain at the compressive strength and strain at which the concrete is crushed, where its standard states them;
    /// `None` takes those of GB 50010 \[–\].
    pub strains: Option<[f64; 2]>,
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

/// Strength classes of EN 1992-1-1: cylinder and cube strength in MPa.
pub const EN_CONCRETE_GRADES: [&str; 14] = [
    "C12/15", "C16/20", "C20/25", "C25/30", "C30/37", "C35/45", "C40/50", "C45/55", "C50/60",
    "C55/67", "C60/75", "C70/85", "C80/95", "C90/105",
];

/// A row of EN 1992-1-1:2004, table 3.1: fck, fctm, fctk,0.05 in MPa, Ecm in GPa, εc1 and εcu1 in ‰.
const EN_TABLE: [[f64; 6]; 14] = [
    [12.0, 1.6, 1.1, 27.0, 1.8, 3.5],
    [16.0, 1.9, 1.3, 29.0, 1.9, 3.5],
    [20.0, 2.2, 1.5, 30.0, 2.0, 3.5],
    [25.0, 2.6, 1.8, 31.0, 2.1, 3.5],
    [30.0, 2.9, 2.0, 33.0, 2.2, 3.5],
    [35.0, 3.2, 2.2, 34.0, 2.25, 3.5],
    [40.0, 3.5, 2.5, 35.0, 2.3, 3.5],
    [45.0, 3.8, 2.7, 36.0, 2.4, 3.5],
    [50.0, 4.1, 2.9, 37.0, 2.45, 3.5],
    [55.0, 4.2, 3.0, 38.0, 2.5, 3.2],
    [60.0, 4.4, 3.1, 39.0, 2.6, 3.0],
    [70.0, 4.6, 3.2, 41.0, 2.7, 2.8],
    [80.0, 4.8, 3.4, 42.0, 2.8, 2.8],
    [90.0, 5.0, 3.5, 44.0, 2.8, 2.8],
];

/// Partial factor of concrete, EN 1992-1-1, table 2.1N \[–\].
const EN_PARTIAL_FACTOR: f64 = 1.5;

/// Expected over specified compressive strength, ASCE 41-17, table 10-1 \[–\].
const EXPECTED_OVER_SPECIFIED: f64 = 1.5;

/// One pound-force per square inch \[Pa\].
const PSI: f64 = 6_894.757_293_168;

impl Concrete {
    /// A grade of [`CONCRETE_GRADES`] (GB 50010-2010, tables 4.1.3 to 4.1.5 and C.2.1) or of [`EN_CONCRETE_GRADES`]
    /// (EN 1992-1-1, table 3.1) at a level of strength.
    ///
    /// Of EN 1992-1-1, characteristic are fck and fctk,0.05; mean fcm = fck + 8 MPa and fctm; design both characteristic
    /// values over 1.5, with α_cc = 1.
    #[must_use]
    pub fn grade(name: &str, level: StrengthLevel) -> Option<Self> {
        Self::gb_grade(name, level).or_else(|| Self::en_grade(name, level))
    }

    fn en_grade(name: &str, level: StrengthLevel) -> Option<Self> {
        let index = EN_CONCRETE_GRADES.iter().position(|grade| *grade == name)?;
        let [fck, fctm, fctk, modulus, peak, crushing] = EN_TABLE[index];
        let (strength, tensile) = match level {
            StrengthLevel::Characteristic => (fck, fctk),
            StrengthLevel::Mean => (fck + 8.0, fctm),
            StrengthLevel::Design => (fck / EN_PARTIAL_FACTOR, fctk / EN_PARTIAL_FACTOR),
        };
        Some(Self {
            strength: 1e6 * strength,
            tensile_strength: 1e6 * tensile,
            modulus: 1e9 * modulus,
            strains: Some([1e-3 * peak, 1e-3 * crushing]),
        })
    }

    /// Normalweight concrete of a specified cylinder strength f'c > 0 \[Pa\] by ACI 318-19: E = 57 000 √f'c (19.2.2.1b) and
    /// modulus of rupture 7.5 √f'c (19.2.3.1), both in psi; crushed at 0.003 (22.2.2.1), at its peak at 2 f'c/E.
    ///
    /// Mean is 1.5 f'c (ASCE 41-17, table 10-1); ACI 318 reduces members, not materials, so design is f'c. E stays that of
    /// the specified strength.
    #[must_use]
    pub fn of_cylinder_strength(specified: f64, level: StrengthLevel) -> Self {
        let root = (specified / PSI).sqrt() * PSI;
        let strength = match level {
            StrengthLevel::Characteristic | StrengthLevel::Design => specified,
            StrengthLevel::Mean => EXPECTED_OVER_SPECIFIED * specified,
        };
        let modulus = 57_000.0 * root;
        let peak_strain = 2.0 * strength / modulus;
        Self {
            strength,
            tensile_strength: 7.5 * (strength / PSI).sqrt() * PSI,
            modulus,
            strains: Some([peak_strain, peak_strain.max(0.003)]),
        }
    }

    fn gb_grade(name: &str, level: StrengthLevel) -> Option<Self> {
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
            strains: None,
        })
    }

    /// From the prismatic compressive strength alone \[Pa\]: tensile strength 0.395 fcu^0.55 and modulus
    /// 10¹¹ / (2.2 + 34.7 / fcu) with fcu = fck / 0.67, in MPa (GB 50010-2010, commentary to 4.1.3 and 4.1.5).
    #[must_use]
    pub fn of_strength(strength: f64) -> Self {
        let cube = 1e-6 * strength / 0.67;
        Self {
            strength,
            tensile_strength: 1e6 * 0.309 * libm::pow(cube, 0.55),
            modulus: 1e11 / (2.2 + 34.7 / cube),
            strains: None,
        }
    }

    /// Strain at the compressive strength \[–\]: that of its standard, or (700 + 172 √fc) 10⁻⁶ with fc in MPa (GB 50010-2010,
    /// C.2.4).
    #[must_use]
    pub fn peak_strain(&self) -> f64 {
        match self.strains {
            Some([peak, _]) => peak,
            None => (700.0 + 172.0 * (1e-6 * self.strength).sqrt()) * 1e-6,
        }
    }

    /// Compressive strain at which plain concrete is crushed \[–\]: that of its standard, or 0.0033, less above C50
    /// (GB 50010-2010, 6.2.1).
    #[must_use]
    pub fn crushing_strain(&self) -> f64 {
        match self.strains {
            Some([_, crushing]) => crushing,
            None => 0.0033 - (1e-6 * self.strength / 0.67 - 50.0).clamp(0.0, 100.0) * 1e-5,
        }
    }
}
