//! A face that crushes and stays crushed: `linear` with `crush`.

use super::force_law::{ContactResponse, Memory};

/// User parameters of a face that crushes.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Crush {
    /// Force at which the virgin face begins to crush, > 0 \[N\].
    pub force: f64,
    /// Stiffness while it crushes ÷ contact stiffness, 0 ≤ η < 1 \[–\].
    pub hardening: f64,
}

/// F = min(k (d − p), F_y + η k (d − F_y/k)), never below zero, with d the indentation from the original face and p
/// the depth to which it is crushed: on the second branch p = d − F/k, and p never falls (docs/contact.md, L2).
///
/// An impact counts its indentation δ from the face as it found it, p₀ deep. Then F = min(k (δ − q),
/// (1 − η) F₀ + η k δ) with F₀ = F_y + η k p₀/(1 − η), and q is what this impact has crushed so far.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Crushing {
    /// k \[N/m\].
    pub stiffness: f64,
    /// F_y \[N\].
    pub force: f64,
    /// η \[–\].
    pub hardening: f64,
}

impl Crushing {
    pub(super) fn new(crush: Crush, stiffness: f64) -> Self {
        Self {
            stiffness,
            force: crush.force,
            hardening: crush.hardening,
        }
    }

    /// Force at which a face crushed to this depth \[m\] crushes on \[N\].
    fn force_at(&self, depth: f64) -> f64 {
        self.force + self.hardening * self.stiffness * depth / (1.0 - self.hardening)
    }

    /// Force of the second branch \[N\].
    fn crushing_force(&self, indentation: f64, memory: &Memory) -> f64 {
        (1.0 - self.hardening) * self.force_at(memory.crushed_before)
            + self.hardening * self.stiffness * indentation
    }

    #[inline]
    pub(super) fn respond(&self, indentation: f64, memory: &Memory) -> ContactResponse {
        let pressed = indentation - memory.crushed;
        if pressed <= 0.0 {
            return ContactResponse::default();
        }
        let elastic = self.stiffness * pressed;
        let crushing = self.crushing_force(indentation, memory);
        let (force, share) = if elastic <= crushing {
            (elastic, 1.0)
        } else {
            (crushing, self.hardening)
        };
        ContactResponse {
            force,
            by_indentation: share * self.stiffness,
            by_rate: 0.0,
        }
    }

    /// Memory after a step that ended at an indentation.
    pub(super) fn remember(&self, indentation: f64, memory: &mut Memory) {
        let crushed = indentation - self.crushing_force(indentation, memory) / self.stiffness;
        memory.crushed = memory.crushed.max(crushed);
    }

    /// Indentation at which the slope changes next, moving inwards; outwards the force ends first \[m\].
    pub(super) fn kink(&self, inwards: bool, memory: &Memory) -> f64 {
        if !inwards {
            return f64::INFINITY;
        }
        self.force_at(memory.crushed_before) / self.stiffness
            + memory.crushed / (1.0 - self.hardening)
    }

    /// Greatest force of the collision of free bodies with a virgin face \[N\].
    pub(super) fn greatest_force(&self, effective_mass: f64, impact_speed: f64) -> f64 {
        let elastic = impact_speed * (effective_mass * self.stiffness).sqrt();
        if elastic <= self.force {
            return elastic;
        }
        // F² grows along each branch by twice its stiffness times the work.
        let beyond = elastic * elastic - self.force * self.force;
        (self.force * self.force + self.hardening * beyond).sqrt()
    }
}
