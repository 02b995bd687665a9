//! A spring and dashpot between two buildings, or a building and a wall.

use super::PortPair;

/// A linear spring and dashpot between two points.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct LinkElement {
    /// Index of the link in the model.
    pub link: usize,
    /// Its two ends.
    pub ports: PortPair,
    /// Height above the base \[m\].
    pub height: f64,
    /// Force per shortening, ≥ 0 \[N/m\].
    pub stiffness: f64,
    /// Force per rate of shortening, ≥ 0 \[N·s/m\].
    pub damping: f64,
    /// Closing of its ends when it is free of force \[m\].
    pub closing_at_rest: f64,
}

impl LinkElement {
    /// How much shorter it is than at rest \[m\].
    #[must_use]
    #[inline]
    pub fn shortening(&self, displacement: &[f64]) -> f64 {
        self.ports.closing(displacement) - self.closing_at_rest
    }

    /// Compression \[N\].
    #[must_use]
    #[inline]
    pub fn force(&self, shortening: f64, rate: f64) -> f64 {
        self.stiffness * shortening + self.damping * rate
    }

    /// Energy of the spring \[J\].
    #[must_use]
    #[inline]
    pub fn strain(&self, shortening: f64) -> f64 {
        0.5 * self.stiffness * shortening * shortening
    }
}
