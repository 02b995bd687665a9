//! Two stiffnesses and a yield indentation: `bilinear`.

use super::force_law::{ContactResponse, Memory};

/// User parameters of the bilinear law.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct BilinearShape {
    /// Yield indentation ÷ greatest design indentation, 0 < a < ½ \[–\].
    pub yield_share: f64,
    /// Impact speed for which the stiffnesses are computed, > 0; `None`: that of each impact \[m/s\].
    pub design_speed: Option<f64>,
}

impl BilinearShape {
    /// A yield indentation of a tenth; the speed of each impact.
    pub const USUAL: Self = Self {
        yield_share: 0.1,
        design_speed: None,
    };

    /// Smallest rebound that a calibrated law of this shape can realise: the second stiffness must stay positive.
    #[must_use]
    pub fn least_restitution(&self) -> f64 {
        (self.yield_share / (2.0 - self.yield_share)).sqrt()
    }
}

/// Constants of the bilinear law as many papers state them, beside K₁; they hold at every impact speed.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct BilinearConstants {
    /// K₂, 0 < K₂ < K₁ \[N/m\].
    pub second_stiffness: f64,
    /// δ_y > 0 \[m\].
    pub yield_indentation: f64,
}

/// Loading along K₁ up to the yield indentation, then along K₂; unloading along K₁ down to the line K₂ δ, then
/// along it (Muthukumar & DesRoches; docs/contact.md, B1). Equivalent to a spring K₂ in parallel with an
/// elasto-plastic one of stiffness K₁ − K₂ that is never in tension; the memory holds the force of the latter.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Bilinear {
    /// K₁ at `reference_speed` \[N/m\].
    pub first_stiffness: f64,
    /// K₂ at `reference_speed`, > 0 \[N/m\].
    pub second_stiffness: f64,
    /// Yield indentation at `reference_speed` \[m\].
    pub yield_indentation: f64,
    /// The design speed, or 1 m/s if every impact uses its own speed \[m/s\].
    pub reference_speed: f64,
    /// Whether the coefficients depend on the impact speed: stiffnesses as v^0.4, indentations as v^0.8.
    pub follows_speed: bool,
    /// m₁m₂/(m₁ + m₂) of the contact \[kg\].
    effective_mass: f64,
}

/// If every impact has its own stiffnesses, slower impacts use those of this speed \[m/s\].
const SLOWEST_DESIGN: f64 = 1e-2;

impl Bilinear {
    /// From a Hertz stiffness \[N/m^1.5\], the effective mass \[kg\] and e.
    ///
    /// Published: D is the greatest indentation of the elastic Hertz collision and ΔE = ⅖ k D^2.5 (1 − e²).
    /// Realised: D = (m v²(1 + e²)/(2k))^0.4 and ΔE = ½ m v²(1 − e²), with which free masses rebound with e.
    /// In both K = k√D, K₁ = K + ΔE/(aD²), K₂ = K − ΔE/((1 − a)D²), yield indentation aD.
    #[must_use]
    pub(super) fn new(
        shape: BilinearShape,
        stiffness: f64,
        effective_mass: f64,
        e: f64,
        realised: bool,
    ) -> Self {
        let speed = shape.design_speed.unwrap_or(1.0);
        let energy = effective_mass * speed * speed;
        let share = if realised { 0.5 * (1.0 + e * e) } else { 1.25 };
        let depth = libm::pow(share * energy / stiffness, 0.4);
        let loss = if realised {
            0.5 * energy * (1.0 - e * e)
        } else {
            0.4 * stiffness * libm::pow(depth, 2.5) * (1.0 - e * e)
        };
        let secant = stiffness * depth.sqrt();
        let a = shape.yield_share;
        let spread = loss / (depth * depth);
        Self {
            first_stiffness: secant + spread / a,
            second_stiffness: secant - spread / (1.0 - a),
            yield_indentation: a * depth,
            reference_speed: speed,
            follows_speed: shape.design_speed.is_none(),
            effective_mass,
        }
    }

    /// From K₁ \[N/m\], the other constants and the effective mass \[kg\].
    #[must_use]
    pub(super) fn of_constants(
        constants: BilinearConstants,
        first_stiffness: f64,
        effective_mass: f64,
    ) -> Self {
        Self {
            first_stiffness,
            second_stiffness: constants.second_stiffness,
            yield_indentation: constants.yield_indentation,
            reference_speed: 1.0,
            follows_speed: false,
            effective_mass,
        }
    }

    /// Ratio of the stiffnesses of an impact to those at the reference speed: (v/v_ref)^0.4.
    #[must_use]
    pub(super) fn scale(&self, impact_speed: f64) -> f64 {
        if self.follows_speed {
            libm::pow(impact_speed.max(SLOWEST_DESIGN), 0.4)
        } else {
            1.0
        }
    }

    /// Force of the elasto-plastic spring after moving to an indentation, and whether it slips.
    fn slip(&self, indentation: f64, memory: &Memory) -> (f64, bool) {
        let stiffness = (self.first_stiffness - self.second_stiffness) * memory.scale;
        let limit = stiffness * self.yield_indentation * memory.scale * memory.scale;
        let tried = memory.slip + stiffness * (indentation - memory.indentation);
        (tried.clamp(0.0, limit), tried <= 0.0 || tried >= limit)
    }

    #[inline]
    pub(super) fn respond(&self, indentation: f64, memory: &Memory) -> ContactResponse {
        if indentation <= 0.0 {
            return ContactResponse::default();
        }
        let (slip, slips) = self.slip(indentation, memory);
        let (first, second) = (
            self.first_stiffness * memory.scale,
            self.second_stiffness * memory.scale,
        );
        ContactResponse {
            force: second * indentation + slip,
            by_indentation: if slips { second } else { first },
            by_rate: 0.0,
        }
    }

    /// Memory after a step that ended at an indentation.
    pub(super) fn remember(&self, indentation: f64, memory: &mut Memory) {
        let (slip, _) = self.slip(indentation, memory);
        memory.slip = slip;
        memory.indentation = indentation;
    }

    /// Indentation at which the slope changes next, moving inwards or outwards \[m\].
    pub(super) fn kink(&self, inwards: bool, memory: &Memory) -> f64 {
        let stiffness = (self.first_stiffness - self.second_stiffness) * memory.scale;
        if stiffness <= 0.0 {
            return f64::INFINITY;
        }
        let limit = stiffness * self.yield_indentation * memory.scale * memory.scale;
        let target = if inwards { limit } else { 0.0 };
        memory.indentation + (target - memory.slip) / stiffness
    }

    /// Rebound of free masses at the reference speed, from the areas under loading and unloading.
    pub(super) fn free_restitution(&self) -> f64 {
        let (k1, k2, y) = (
            self.first_stiffness,
            self.second_stiffness,
            self.yield_indentation,
        );
        let energy = 0.5 * self.effective_mass * self.reference_speed * self.reference_speed;
        let slip = (k1 - k2) * y;
        if 0.5 * k1 * y * y >= energy {
            return 1.0;
        }
        // ½K₂x² + s(x − y/2) = energy.
        let right = energy + 0.5 * slip * y;
        let depth = 2.0 * right / (slip + (slip * slip + 2.0 * k2 * right).sqrt());
        (1.0 - slip * (depth - y) / energy).max(0.0).sqrt()
    }
}
