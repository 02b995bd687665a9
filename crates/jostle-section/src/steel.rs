//! Reinforcing steel of GB 50010.

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

impl Steel {
    /// A grade of [`STEEL_GRADES`] at a level of strength.
    #[must_use]
    pub fn grade(name: &str, level: StrengthLevel) -> Option<Self> {
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
