//! Artificial motions with a name.

use super::sines::{SineSettings, spectrum_compatible};
use super::{Envelope, MatchSettings, Matched};
use crate::MotionFault;
use crate::target::{Gb50011, GbGroup, GbIntensity, GbLevel, GbSite, TargetKind, TargetSpectrum};

/// A named artificial motion.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Recipe {
    /// Its name.
    pub name: &'static str,
    /// Description, one line.
    pub description: &'static str,
    /// Spectrum it follows.
    spectrum: Gb50011,
    duration: f64,
    step: f64,
    seed: u64,
}

/// All named artificial motions.
pub const RECIPES: &[Recipe] = &[Recipe {
    name: "nanjing-artificial",
    description: "artificial wave for Nanjing: GB 50011, intensity 7 (0.10 g), site II, group 1, frequent; 35 cm/s2, 40 s",
    spectrum: Gb50011 {
        intensity: GbIntensity::Seven,
        site: GbSite::II,
        group: GbGroup::First,
        level: GbLevel::Frequent,
    },
    duration: 40.0,
    step: 0.01,
    seed: 5,
}];

/// The recipe of a name.
#[must_use]
pub fn recipe(name: &str) -> Option<&'static Recipe> {
    RECIPES.iter().find(|recipe| recipe.name == name)
}

impl Recipe {
    /// The spectrum it follows.
    #[must_use]
    pub fn target(&self) -> TargetSpectrum {
        TargetSpectrum::new(TargetKind::Gb50011(self.spectrum))
    }

    /// Target: the full spectrum of the code from 0.05 s, with 5 % damping.
    #[must_use]
    pub fn matching(&self) -> MatchSettings {
        MatchSettings {
            periods: [0.05, 6.0],
            peak: Some(self.spectrum.time_history_peak()),
            ..MatchSettings::default()
        }
    }

    /// The motion: always the same.
    ///
    /// # Errors
    /// None for the recipes of this version.
    pub fn make(&self) -> Result<Matched, MotionFault> {
        let settings = SineSettings {
            step: self.step,
            envelope: Envelope::of_duration(self.duration),
            seed: self.seed,
            matching: self.matching(),
        };
        spectrum_compatible(&self.target(), &settings)
    }
}
