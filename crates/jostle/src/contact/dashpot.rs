//! Kelvin laws whose dashpot is given: `damping` instead of `restitution`.

use super::root::bisect;
use super::{approach, kelvin};

/// The Kelvin laws that can have a given dashpot.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum DashpotLaw {
    /// `kelvin`.
    Kelvin,
    /// `kelvin-no-tension`.
    KelvinNoTension,
    /// `modified-kelvin` after Mahmoud and Jankowski.
    Approach,
}

/// A Kelvin law with the dashpot of a whole contact: the same whatever the masses.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Dashpot {
    /// The law.
    pub law: DashpotLaw,
    /// c ≥ 0 \[N·s/m\].
    pub damping: f64,
}

impl DashpotLaw {
    /// The coefficient of restitution from which the published formula of the law gives the damping ratio ζ \[–\]:
    /// exp(−πζ/√(1 − ζ²)) for both Kelvin laws, zero from ζ = 1 on.
    #[must_use]
    pub fn equivalent_restitution(self, ratio: f64) -> f64 {
        match self {
            Self::Kelvin | Self::KelvinNoTension if ratio >= 1.0 => 0.0,
            Self::Kelvin | Self::KelvinNoTension => kelvin::kelvin_restitution(ratio),
            // Falls from infinity at e = 0 to 0 at e = 1.
            Self::Approach => bisect(0.0, 1.0, |e| {
                approach::published_mahmoud_jankowski(e) - ratio
            }),
        }
    }

    /// Separation ÷ impact speed of two free masses at the damping ratio ζ \[–\].
    #[must_use]
    pub fn free_restitution(self, ratio: f64) -> f64 {
        match self {
            Self::Kelvin => self.equivalent_restitution(ratio),
            // The force is cut where it vanishes, twice the angle of the approach after first contact.
            Self::KelvinNoTension => approach::approach_restitution(ratio).powi(2),
            Self::Approach => approach::approach_restitution(ratio),
        }
    }
}
