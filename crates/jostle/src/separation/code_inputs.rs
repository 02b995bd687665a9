//! Codes, and what their rules need beyond a model.

use super::JointSystem;

/// Codes whose rules are known.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Code {
    /// UBC-97.
    Ubc97,
    /// GB 50011-2010 (2016).
    Gb50011,
    /// EN 1998-1:2004.
    En1998,
    /// ASCE 7-16.
    Asce7,
    /// TBDY 2018 (Turkey).
    Tbdy2018,
    /// IS 1893 (Part 1): 2016 (India).
    Is1893,
    /// NTC 2018 (Italy).
    Ntc2018,
    /// E.030 (Peru), editions 2018 and 2026.
    E030,
    /// NSR-10 (Colombia).
    Nsr10,
    /// Standard 2800, 4th edition (Iran).
    Iran2800,
}

impl Code {
    /// All codes, in the order of tables.
    pub const ALL: [Self; 10] = [
        Self::Ubc97,
        Self::Gb50011,
        Self::En1998,
        Self::Asce7,
        Self::Tbdy2018,
        Self::Is1893,
        Self::Ntc2018,
        Self::E030,
        Self::Nsr10,
        Self::Iran2800,
    ];

    /// Name in files and options.
    #[must_use]
    pub const fn name(self) -> &'static str {
        match self {
            Self::Ubc97 => "ubc97",
            Self::Gb50011 => "gb50011",
            Self::En1998 => "en1998",
            Self::Asce7 => "asce7",
            Self::Tbdy2018 => "tbdy2018",
            Self::Is1893 => "is1893",
            Self::Ntc2018 => "ntc2018",
            Self::E030 => "e030",
            Self::Nsr10 => "nsr10",
            Self::Iran2800 => "iran2800",
        }
    }

    /// The code of a name.
    #[must_use]
    pub fn named(name: &str) -> Option<Self> {
        Self::ALL.into_iter().find(|code| code.name() == name)
    }
}

/// What the displacements of a run belong to.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum MotionLevel {
    /// The design motion in full: displacements of elastic buildings are the elastic ones, those of yielding buildings
    /// the inelastic ones.
    #[default]
    Full,
    /// A motion divided by the behaviour factor q or R of the code.
    Reduced,
}

impl MotionLevel {
    /// Both, in the order of [`MotionLevel::NAMES`].
    pub const ALL: [Self; 2] = [Self::Full, Self::Reduced];
    /// Names in files.
    pub const NAMES: [&'static str; 2] = ["full", "reduced"];
}

/// Seismic hazard of the site, NSR-10.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum HazardZone {
    /// Low: NSR-10 requires no separation.
    Low,
    /// Intermediate.
    Intermediate,
    /// High.
    #[default]
    High,
}

impl HazardZone {
    /// All, in the order of [`HazardZone::NAMES`].
    pub const ALL: [Self; 3] = [Self::Low, Self::Intermediate, Self::High];
    /// Names in files.
    pub const NAMES: [&'static str; 3] = ["low", "intermediate", "high"];
}

/// What codes need to know about one building.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct BuildingCodes {
    /// Importance factor I or I_e, > 0; `None` is 1 \[–\].
    pub importance: Option<f64>,
    /// Behaviour factor q of EN 1998-1 and NTC 2018, ≥ 1 \[–\].
    pub behaviour_factor: Option<f64>,
    /// Response modification R of ASCE 7, TBDY 2018, IS 1893, E.030 and Standard 2800, ≥ 1 \[–\].
    pub response_modification: Option<f64>,
    /// Deflection amplification C_d of ASCE 7 and Standard 2800, > 0 \[–\].
    pub deflection_amplification: Option<f64>,
    /// Whether the structure is regular, for E.030; `None` is regular.
    pub is_regular: Option<bool>,
}

impl BuildingCodes {
    /// Values of `self`, and those of `other` where `self` has none.
    #[must_use]
    pub fn or(self, other: Self) -> Self {
        Self {
            importance: self.importance.or(other.importance),
            behaviour_factor: self.behaviour_factor.or(other.behaviour_factor),
            response_modification: self.response_modification.or(other.response_modification),
            deflection_amplification: self
                .deflection_amplification
                .or(other.deflection_amplification),
            is_regular: self.is_regular.or(other.is_regular),
        }
    }
}

/// What codes need to know beyond displacements and heights.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct CodeInputs {
    /// Codes whose rules are wanted; empty means all.
    pub shown: Vec<Code>,
    /// What the displacements belong to.
    pub motion: MotionLevel,
    /// Structural system for GB 50011; `None` is concrete frames.
    pub system: Option<JointSystem>,
    /// Fortification intensity for GB 50011, 6 to 9; `None` lists all four.
    pub intensity: Option<u32>,
    /// Whether all floors that face each other lie at equal height; `None` follows the model.
    pub floors_are_level: Option<bool>,
    /// a_g S of NTC 2018; `None` is the peak of the motion \[m/s²\].
    pub ground_acceleration: Option<f64>,
    /// Hazard of the site for NSR-10.
    pub hazard: HazardZone,
    /// Zone factor Z of E.030-2026 \[–\].
    pub zone_factor: Option<f64>,
    /// Soil factor S of E.030-2026 \[–\].
    pub soil_factor: Option<f64>,
    /// By building of the model; buildings beyond the end have no values of their own.
    pub buildings: Vec<BuildingCodes>,
}

impl CodeInputs {
    pub(super) fn shows(&self, code: Code) -> bool {
        self.shown.is_empty() || self.shown.contains(&code)
    }
}
