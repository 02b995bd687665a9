//! A face that crushes and stays crushed: `linear` or `hertz` with `crush`.

use super::force_law::{ContactResponse, Memory};

/// User parameters of a face that crushes.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Crush {
    /// Force at which the virgin face begins to crush, > 0 \[N\].
    pub force: f64,
    /// Stiffness while it crushes ÷ that where it begins to crush, 0 ≤ η < 1, or < 2/3 under the law of Hertz \[–\].
    pub hardening: f64,
    /// Whether it is pressed by the law of Hertz, F = k δ^1.5, instead of F = k δ.
    pub hertzian: bool,
}

/// F = min(f(d − p), F_y + η s (d − d_y)), never below zero, with f(x) = k x or k x^1.5, d the indentation from the original face and p
/// the depth to which it is crushed: on the second branch f(d − p) = F, and p never falls (docs/contact.md, L2). The face yields at
/// f(d_y) = F_y, where f has the slope s.
///
/// An impact counts its indentation δ from the face as it found it, p₀ deep. Then F = min(f(δ − q), F_y + η s (δ + p₀ − d_y)), and q is
/// what this impact has crushed so far. With f(x) = k x the second is (1 − η) F₀ + η k δ, F₀ = F_y + η k p₀/(1 − η).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Crushing {
    /// k \[N/m, N/m^1.5\].
    pub stiffness: f64,
    /// F_y \[N\].
    pub force: f64,
    /// η \[–\].
    pub hardening: f64,
    /// Whether f(x) = k x^1.5.
    pub hertzian: bool,
}

impl Crushing {
    pub(super) fn new(crush: Crush, stiffness: f64) -> Self {
        Self {
            stiffness,
            force: crush.force,
            hardening: crush.hardening,
            hertzian: crush.hertzian,
        }
    }

    /// Force at which a face crushed to this depth \[m\], pressed by the linear law, crushes on \[N\].
    fn force_at(&self, depth: f64) -> f64 {
        self.force + self.hardening * self.stiffness * depth / (1.0 - self.hardening)
    }

    /// Indentation at which a virgin face bears a force \[m\].
    fn pressed_by(&self, force: f64) -> f64 {
        match self.hertzian {
            true => {
                let root = libm::cbrt(force / self.stiffness);
                root * root
            }
            false => force / self.stiffness,
        }
    }

    /// Slope of the second branch \[N/m\].
    fn crushing_stiffness(&self) -> f64 {
        let slope = match self.hertzian {
            true => 1.5 * self.stiffness * self.pressed_by(self.force).sqrt(),
            false => self.stiffness,
        };
        self.hardening * slope
    }

    /// Force of the second branch \[N\].
    fn crushing_force(&self, indentation: f64, memory: &Memory) -> f64 {
        if self.hertzian {
            let beyond = indentation + memory.crushed_before - self.pressed_by(self.force);
            return self.force + self.crushing_stiffness() * beyond;
        }
        (1.0 - self.hardening) * self.force_at(memory.crushed_before)
            + self.hardening * self.stiffness * indentation
    }

    #[inline]
    pub(super) fn respond(&self, indentation: f64, memory: &Memory) -> ContactResponse {
        let pressed = indentation - memory.crushed;
        if pressed <= 0.0 {
            return ContactResponse::default();
        }
        let (elastic, slope) = match self.hertzian {
            true => {
                let root = pressed.sqrt();
                (self.stiffness * pressed * root, 1.5 * self.stiffness * root)
            }
            false => (self.stiffness * pressed, self.stiffness),
        };
        let crushing = self.crushing_force(indentation, memory);
        let (force, by_indentation) = if elastic <= crushing {
            (elastic, slope)
        } else {
            (crushing, self.crushing_stiffness())
        };
        ContactResponse {
            force,
            by_indentation,
            by_rate: 0.0,
        }
    }

    /// Memory after a step that ended at an indentation.
    pub(super) fn remember(&self, indentation: f64, memory: &mut Memory) {
        let crushed = indentation - self.pressed_by(self.crushing_force(indentation, memory));
        memory.crushed = memory.crushed.max(crushed);
    }

    /// Indentation at which the slope changes next, moving inwards; outwards the force ends first \[m\].
    pub(super) fn kink(&self, inwards: bool, memory: &Memory) -> f64 {
        if !inwards {
            return f64::INFINITY;
        }
        if self.hertzian {
            // Where k s³ = L + c s², s² being how far the face is pressed, L and c force and slope of the second branch at its surface.
            // Newton's method falls to the root from the right.
            let (k, c) = (self.stiffness, self.crushing_stiffness());
            let at_surface = self.crushing_force(memory.crushed, memory);
            let mut root = libm::cbrt(at_surface / k) + c / k;
            loop {
                let left = (k * root - c) * root * root - at_surface;
                let next = root - left / ((3.0 * k * root - 2.0 * c) * root);
                if next.is_nan() || next >= root {
                    break;
                }
                root = next;
            }
            return memory.crushed + root * root;
        }
        self.force_at(memory.crushed_before) / self.stiffness
            + memory.crushed / (1.0 - self.hardening)
    }

    /// Greatest force of the collision of free bodies with a virgin face \[N\].
    pub(super) fn greatest_force(&self, effective_mass: f64, impact_speed: f64) -> f64 {
        if self.hertzian {
            let energy = 0.5 * effective_mass * impact_speed * impact_speed;
            let pressed = libm::pow(2.5 * energy / self.stiffness, 0.4);
            let elastic = self.stiffness * pressed * pressed.sqrt();
            if elastic <= self.force {
                return elastic;
            }
            // The work to yield is 2/5 of force times indentation.
            let beyond = energy - 0.4 * self.force * self.pressed_by(self.force);
            let squared = self.force * self.force + 2.0 * self.crushing_stiffness() * beyond;
            return squared.sqrt();
        }
        let elastic = impact_speed * (effective_mass * self.stiffness).sqrt();
        if elastic <= self.force {
            return elastic;
        }
        // F² grows along each branch by twice its stiffness times the work.
        let beyond = elastic * elastic - self.force * self.force;
        (self.force * self.force + self.hardening * beyond).sqrt()
    }
}
