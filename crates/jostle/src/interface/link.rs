//! A link between two points: springs, dashpots and sliders.

use super::PortPair;
use crate::hysteresis::HysteresisMemory;
use crate::model::LinkLaw;

/// A link between two points.
#[derive(Clone, Debug, PartialEq)]
pub struct LinkElement {
    /// Index of the link in the model.
    pub link: usize,
    /// Its two ends.
    pub ports: PortPair,
    /// Whether it joins two floors of one building; then `None` among its ends is the base of that building.
    pub inside: bool,
    /// Height above the base \[m\].
    pub height: f64,
    /// Force per shortening, ≥ 0 \[N/m\].
    pub stiffness: f64,
    /// Force per rate of shortening, ≥ 0; of viscous links per its power \[N·s/m, N·(s/m)^α\].
    pub damping: f64,
    /// Closing of its ends when it is free of force \[m\].
    pub closing_at_rest: f64,
    /// How its force follows from its change of length.
    pub law: LinkLaw,
}

/// State of a link that is not linear.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct LinkMemory {
    /// Force now, positive in compression \[N\].
    pub force: f64,
    /// Of a link that yields.
    pub hysteresis: HysteresisMemory,
}

impl LinkElement {
    /// How much shorter it is than at rest \[m\].
    #[must_use]
    #[inline]
    pub fn shortening(&self, displacement: &[f64]) -> f64 {
        self.ports.closing(displacement) - self.closing_at_rest
    }

    /// Whether its force is that of a spring and a dashpot side by side.
    #[must_use]
    pub fn is_linear(&self) -> bool {
        self.law == LinkLaw::Linear
    }

    /// Compression of a linear link \[N\].
    #[must_use]
    #[inline]
    pub fn force(&self, shortening: f64, rate: f64) -> f64 {
        self.stiffness * shortening + self.damping * rate
    }

    /// Compression where the shortening has a rate, which may have changed suddenly \[N\].
    #[must_use]
    pub fn force_now(&self, shortening: f64, rate: f64, memory: &LinkMemory) -> f64 {
        match self.law {
            LinkLaw::Linear => self.force(shortening, rate),
            LinkLaw::Viscous { exponent } if self.stiffness == 0.0 => {
                self.damping * libm::pow(rate.abs(), exponent).copysign(rate)
            }
            LinkLaw::Viscous { .. }
            | LinkLaw::Maxwell
            | LinkLaw::Friction { .. }
            | LinkLaw::Yielding(_) => memory.force,
            LinkLaw::Cable { slack } => -self.stiffness * (-shortening - slack).max(0.0),
            LinkLaw::Stopper { gap } if shortening > gap => {
                self.force(shortening - gap, rate).max(0.0)
            }
            LinkLaw::Stopper { .. } => 0.0,
        }
    }

    /// By how much a gap or a slack is closed, and 1 where a shortening closes it, otherwise −1; `None` for links without
    /// \[m\].
    #[must_use]
    pub fn overlap(&self, shortening: f64) -> Option<(f64, f64)> {
        match self.law {
            LinkLaw::Cable { slack } => Some((-shortening - slack, -1.0)),
            LinkLaw::Stopper { gap } => Some((shortening - gap, 1.0)),
            LinkLaw::Linear
            | LinkLaw::Viscous { .. }
            | LinkLaw::Maxwell
            | LinkLaw::Friction { .. }
            | LinkLaw::Yielding(_) => None,
        }
    }

    /// Energy of the spring of a linear link \[J\].
    #[must_use]
    #[inline]
    pub fn strain(&self, shortening: f64) -> f64 {
        0.5 * self.stiffness * shortening * shortening
    }

    /// Recoverable energy \[J\].
    #[must_use]
    pub fn recoverable(&self, shortening: f64, memory: &LinkMemory) -> f64 {
        let in_series = |stiffness: f64| 0.5 * memory.force * memory.force / stiffness;
        match &self.law {
            LinkLaw::Linear => self.strain(shortening),
            LinkLaw::Viscous { .. } if self.stiffness == 0.0 => 0.0,
            LinkLaw::Viscous { .. } | LinkLaw::Maxwell => in_series(self.stiffness),
            LinkLaw::Friction {
                stick_stiffness, ..
            } => in_series(*stick_stiffness),
            LinkLaw::Yielding(hysteresis) => hysteresis.recoverable_energy(&memory.hysteresis),
            LinkLaw::Cable { slack } => self.strain((-shortening - slack).max(0.0)),
            LinkLaw::Stopper { gap } => self.strain((shortening - gap).max(0.0)),
        }
    }
}
