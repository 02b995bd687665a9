//! Reinforcing steel of GB 50010, EN 1992-1-1 and ASTM.

use crate::concrete::StrengthLevel;

/// Steel in numbers.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Steel {
    /// Yield strength, > 0 \[Pa\].
    pub yield_strength: f64,
    /// Modulus of elasticity, > 0 \[Pa\].
    pub modulus: f64,
    /// Modulus after yield over the modulus before, 0…1 \[–\].
    pub hardening: f64,
    /// Strain at which a bar breaks, > 0 \[–\].
    pub rupture_strain: f64,
}

/// Grades HRB335 … HRB500.
pub const STEEL_GRADES: [&str; 3] = ["HRB335", "HRB400", "HRB500"];

/// fyk (GB 50010-2010, table 4.2.2-1) and fy (4.2.3-1) \[MPa\].
const TABLE: [[f64; 2]; 3] = [[335.0, 300.0], [400.0, 360.0], [500.0, 435.0]];

/// Coefficient of variation of the yield strength; the code leaves it to tests (C.1.1). An assumption \[–\].
const VARIATION: f64 = 0.07;

/// Young's modulus of hot-rolled ribbed bars (GB 50010-2010, table 4.2.5) \[Pa\].
const MODULUS: f64 = 200e9;

/// Bars of EN 1992-1-1 and EN 10080: characteristic yield strength in MPa and ductility class; class B without a letter.
pub const EN_STEEL_GRADES: [&str; 12] = [
    "B400", "B400A", "B400B", "B400C", "B450", "B450A", "B450B", "B450C", "B500", "B500A", "B500B",
    "B500C",
];

/// Bars of ASTM A615 and A706: specified yield strength in ksi, or in MPa.
pub const ASTM_STEEL_GRADES: [&str; 10] = [
    "Grade 40",
    "Grade 60",
    "Grade 75",
    "Grade 80",
    "Grade 100",
    "Grade 280",
    "Grade 420",
    "Grade 520",
    "Grade 550",
    "Grade 690",
];

/// Partial factor of reinforcing steel, EN 1992-1-1, table 2.1N \[–\].
const EN_PARTIAL_FACTOR: f64 = 1.15;
/// Mean over characteristic yield strength of EN bars, f_ym = 1.1 f_yk (EN 1992-2, 5.7) \[–\].
const EN_MEAN: f64 = 1.1;
/// Expected over specified yield strength, ASCE 41-17, table 10-1 \[–\].
const EXPECTED_OVER_SPECIFIED: f64 = 1.25;
/// Greatest tensile strain of bars, ASCE 41-17, 10.3.3.1 \[–\].
const ASTM_LARGEST_STRAIN: f64 = 0.05;
/// One thousand pounds-force per square inch \[Pa\].
const KSI: f64 = 6_894_757.293_168;

impl Steel {
    /// A grade of [`STEEL_GRADES`], [`EN_STEEL_GRADES`] or [`ASTM_STEEL_GRADES`] at a level of strength.
    ///
    /// All have 200 GPa (EN 1992-1-1, 3.2.7(4); ACI 318-19, 20.2.2.2: 29 000 ksi). Of EN bars, design is f_yk/1.15, mean
    /// 1.1 f_yk; f_t/f_y and the strain at greatest force are the least of the class (Annex C: 1.05 and 2.5 % of A, 1.08 and
    /// 5 % of B, 1.15 and 7.5 % of C). Of ASTM bars, design is the specified strength, because ACI 318 reduces members, and
    /// mean 1.25 of it.
    #[must_use]
    pub fn grade(name: &str, level: StrengthLevel) -> Option<Self> {
        Self::gb_grade(name, level)
            .or_else(|| Self::en_grade(name, level))
            .or_else(|| Self::astm_grade(name, level))
    }

    fn en_grade(name: &str, level: StrengthLevel) -> Option<Self> {
        let name = EN_STEEL_GRADES.iter().find(|grade| **grade == name)?;
        let (figures, class) = name.get(1..4).zip(name.get(4..))?;
        let characteristic: f64 = figures.parse().ok()?;
        let (ratio, largest_strain) = match class {
            "A" => (1.05, 0.025),
            "C" => (1.15, 0.075),
            _ => (1.08, 0.05),
        };
        let yield_strength = 1e6
            * match level {
                StrengthLevel::Characteristic => characteristic,
                StrengthLevel::Mean => EN_MEAN * characteristic,
                StrengthLevel::Design => characteristic / EN_PARTIAL_FACTOR,
            };
        let plastic_strain = largest_strain - yield_strength / MODULUS;
        Some(Self {
            yield_strength,
            modulus: MODULUS,
            hardening: (ratio - 1.0) * yield_strength / (plastic_strain * MODULUS),
            rupture_strain: largest_strain,
        })
    }

    fn astm_grade(name: &str, level: StrengthLevel) -> Option<Self> {
        let name = ASTM_STEEL_GRADES.iter().find(|grade| **grade == name)?;
        let figures: f64 = name.strip_prefix("Grade ")?.parse().ok()?;
        // Grades in ksi end at 100, those in MPa begin at 280.
        let specified = figures * if figures <= 100.0 { KSI } else { 1e6 };
        let yield_strength = match level {
            StrengthLevel::Characteristic | StrengthLevel::Design => specified,
            StrengthLevel::Mean => EXPECTED_OVER_SPECIFIED * specified,
        };
        Some(Self {
            rupture_strain: ASTM_LARGEST_STRAIN,
            ..Self::of_strength(yield_strength)
        })
    }

    fn gb_grade(name: &str, level: StrengthLevel) -> Option<Self> {
        let index = STEEL_GRADES.iter().position(|grade| *grade == name)?;
        let [characteristic, design] = TABLE[index];
        Some(Self::of_strength(
            1e6 * match level {
                StrengthLevel::Characteristic => characteristic,
                StrengthLevel::Mean => characteristic / (1.0 - 1.645 * VARIATION),
                StrengthLevel::Design => design,
            },
        ))
    }

    /// From the yield strength alone \[Pa\]: 200 GPa, 1 % hardening, rupture at 7.5 % (the uniform elongation that
    /// GB 50010-2010, table 4.2.4, requires for HRB bars).
    #[must_use]
    pub fn of_strength(yield_strength: f64) -> Self {
        Self {
            yield_strength,
            modulus: MODULUS,
            hardening: 0.01,
            rupture_strain: 0.075,
        }
    }

    /// Strain at yield \[–\].
    #[must_use]
    pub fn yield_strain(&self) -> f64 {
        self.yield_strength / self.modulus
    }
}
