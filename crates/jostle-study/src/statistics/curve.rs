//! Fragility curves of any kind.

use super::fragility::Lognormal;
use super::modified_cloud::MixedCurve;

/// The probability of an event over an intensity.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Curve {
    /// Lognormal.
    Lognormal(Lognormal),
    /// Of a modified cloud analysis.
    Mixed(MixedCurve),
}

impl Curve {
    /// Probability of the event at an intensity ≥ 0.
    #[must_use]
    pub fn probability(&self, intensity: f64) -> f64 {
        match self {
            Self::Lognormal(curve) => curve.probability(intensity),
            Self::Mixed(curve) => curve.probability(intensity),
        }
    }

    /// Median and dispersion, of other curves those of the equivalent lognormal one.
    #[must_use]
    pub fn equivalent(&self) -> Lognormal {
        match self {
            Self::Lognormal(curve) => *curve,
            Self::Mixed(curve) => curve.equivalent,
        }
    }
}

impl From<Lognormal> for Curve {
    fn from(curve: Lognormal) -> Self {
        Self::Lognormal(curve)
    }
}

impl From<MixedCurve> for Curve {
    fn from(curve: MixedCurve) -> Self {
        Self::Mixed(curve)
    }
}
