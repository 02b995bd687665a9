//! A rubber bumper between the buildings: `rubber`.

use super::force_law::ContactResponse;
use super::root::bisect;

/// User parameters of a bumper.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct RubberBumper {
    /// Thickness, > 0 \[m\].
    pub thickness: f64,
    /// Exponent n of the compression, 1 ≤ n ≤ 6 \[–\].
    pub exponent: f64,
}

impl RubberBumper {
    /// 50 mm thick, exponent 2.65.
    pub const USUAL: Self = Self {
        thickness: 0.05,
        exponent: 2.65,
    };
}

/// Fraction of the thickness beyond which the force follows the tangent.
const LIMIT_SHARE: f64 = 0.8;

/// F = K δ_u (δ/δ_u)ⁿ up to δ_u = 0.8 of the thickness, beyond along the tangent; in restitution times (1 + d δ̇/v₀)
/// (after Polycarpou, Komodromos & Polycarpou 2013; docs/contact.md, R1).
///
/// The approach is elastic, so free masses rebound with e if −e d − ln(1 − e d) = ½ d², for any compression law.
/// The damping always realises e.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Rubber {
    /// Secant stiffness at the limit K \[N/m\].
    pub stiffness: f64,
    /// δ_u \[m\].
    pub limit: f64,
    /// n \[–\].
    pub exponent: f64,
    /// d \[–\].
    pub damping: f64,
}

impl Rubber {
    pub(super) fn new(bumper: RubberBumper, stiffness: f64, e: f64) -> Self {
        Self {
            stiffness,
            limit: LIMIT_SHARE * bumper.thickness,
            exponent: bumper.exponent,
            damping: rubber_damping(e),
        }
    }

    /// Force without damping, and its slope.
    #[inline]
    fn backbone(&self, indentation: f64) -> (f64, f64) {
        let share = indentation / self.limit;
        if share >= 1.0 {
            let slope = self.exponent * self.stiffness;
            let force = self.stiffness * self.limit + slope * (indentation - self.limit);
            (force, slope)
        } else {
            let power = libm::pow(share, self.exponent - 1.0);
            (
                self.stiffness * indentation * power,
                self.exponent * self.stiffness * power,
            )
        }
    }

    #[inline]
    pub(super) fn respond(&self, indentation: f64, rate: f64, speed: f64) -> ContactResponse {
        let factor = 1.0 + self.damping / speed * rate.min(0.0);
        if indentation <= 0.0 || factor <= 0.0 {
            return ContactResponse::default();
        }
        let (force, slope) = self.backbone(indentation);
        ContactResponse {
            force: force * factor,
            by_indentation: slope * factor,
            by_rate: if rate < 0.0 {
                force * self.damping / speed
            } else {
                0.0
            },
        }
    }

    /// Duration of the elastic collision \[s\]: 2 δ_m/v ∫₀¹ dx/√(1 − xⁿ⁺¹), or that of the tangent if it is
    /// compressed beyond the limit.
    pub(super) fn elastic_duration(&self, effective_mass: f64, impact_speed: f64) -> f64 {
        let p = self.exponent + 1.0;
        let energy = 0.5 * effective_mass * impact_speed * impact_speed;
        let depth = self.limit
            * libm::pow(
                p * energy / (self.stiffness * self.limit * self.limit),
                1.0 / p,
            );
        if depth > self.limit {
            let tangent = self.exponent * self.stiffness;
            return std::f64::consts::PI * (effective_mass / tangent).sqrt();
        }
        // x = 1 − s² makes the integrand smooth; the midpoint rule is accurate enough for a time scale.
        const PARTS: u32 = 24;
        let sum: f64 = (0..PARTS)
            .map(|i| {
                let s = (f64::from(i) + 0.5) / f64::from(PARTS);
                2.0 * s / (1.0 - libm::pow(1.0 - s * s, p)).sqrt()
            })
            .sum();
        2.0 * depth / impact_speed * sum / f64::from(PARTS)
    }

    /// Greatest force of the elastic collision, compressed beyond the limit or not \[N\].
    pub(super) fn elastic_force(&self, effective_mass: f64, impact_speed: f64) -> f64 {
        let p = self.exponent + 1.0;
        let energy = 0.5 * effective_mass * impact_speed * impact_speed;
        let most = self.stiffness * self.limit;
        let stored = most * self.limit / p;
        if energy <= stored {
            return most * libm::pow(energy / stored, self.exponent / p);
        }
        let slope = self.exponent * self.stiffness;
        (most * most + 2.0 * slope * (energy - stored)).sqrt()
    }

    pub(super) fn free_restitution(&self) -> f64 {
        if self.damping <= 0.0 {
            return 1.0;
        }
        let energy = 0.5 * self.damping * self.damping;
        bisect(0.0, 1.0 - 1e-16, |w| -w - libm::log1p(-w) - energy) / self.damping
    }
}

/// The d with which free masses rebound with e: −e d − ln(1 − e d) = ½ d².
fn rubber_damping(e: f64) -> f64 {
    if e >= 1.0 {
        return 0.0;
    }
    // Besides d = 0 there is a root before the pole 1/e; near zero the residual is −d²(1 − e²)/2.
    bisect(1e-3 * (1.0 - e), (1.0 - 1e-15) / e, |d| {
        -e * d - libm::log1p(-e * d) - 0.5 * d * d
    })
}
