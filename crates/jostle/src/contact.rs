//! Contact laws: the force between two colliding floors as a function of indentation and its rate.
//!
//! A law sees numbers only. [`ContactLaw`] is what a user asks for; [`ContactLaw::between`] turns it into a
//! [`ForceLaw`] once the colliding masses are known. Indentation δ = u_left − u_right − gap is positive in
//! contact; the force is positive in compression and pushes the left building left.

use std::f64::consts::PI;

/// A contact law as described in a model.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ContactLaw {
    /// Which formula.
    pub kind: LawKind,
    /// Contact stiffness, > 0 \[N/m for the linear family, N/m^1.5 for the Hertz family\].
    pub stiffness: f64,
    /// Coefficient of restitution, 0 < e ≤ 1; elastic laws do not use it \[–\].
    pub restitution: f64,
    /// What the coefficient means.
    pub restitution_is: RestitutionIs,
}

/// The formula of a contact law.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum LawKind {
    /// F = k δ.
    Linear,
    /// F = k δ + c δ̇, held until δ = 0, so that it pulls just before release (Anagnostopoulos 1988).
    Kelvin,
    /// The same, cut at F = 0.
    KelvinNoTension,
    /// F = k δ^1.5.
    Hertz,
    /// F = k δ^1.5 (1 + ¾(1 − e²) δ̇/v₀) (Muthukumar & DesRoches 2006).
    HertzDamp,
}

/// What a coefficient of restitution stands for.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Default)]
pub enum RestitutionIs {
    /// It goes into the published formula; free masses may rebound otherwise.
    #[default]
    Input,
    /// The damping is calibrated so that two free masses rebound with exactly this ratio.
    Realised,
}

impl LawKind {
    /// Spelling in model files.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            Self::Linear => "linear",
            Self::Kelvin => "kelvin",
            Self::KelvinNoTension => "kelvin-no-tension",
            Self::Hertz => "hertz",
            Self::HertzDamp => "hertz-damp",
        }
    }

    /// Whether the stiffness is in N/m^1.5 rather than N/m.
    #[must_use]
    pub fn is_hertzian(self) -> bool {
        matches!(self, Self::Hertz | Self::HertzDamp)
    }

    /// Whether the law loses energy, so that the coefficient of restitution matters.
    #[must_use]
    pub fn is_dissipative(self) -> bool {
        !matches!(self, Self::Linear | Self::Hertz)
    }
}

/// A contact law with all its numbers; pure functions of indentation, rate and impact speed.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum ForceLaw {
    /// F = k δ + c δ̇ (theory, Eq. C1).
    Kelvin {
        /// k \[N/m\].
        stiffness: f64,
        /// c \[N·s/m\].
        damping: f64,
        /// Keep the pulling force before release.
        tension: bool,
    },
    /// F = k δ^1.5 (1 + d δ̇/v₀) (theory, Eq. C2).
    Hertz {
        /// k \[N/m^1.5\].
        stiffness: f64,
        /// d \[–\].
        damping: f64,
    },
}

/// Contact force and its partial derivatives.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct ContactResponse {
    /// Force, positive in compression \[N\].
    pub force: f64,
    /// ∂F/∂δ \[N/m\].
    pub by_indentation: f64,
    /// ∂F/∂δ̇ \[N·s/m\].
    pub by_rate: f64,
}

impl ContactLaw {
    /// The law between two bodies of the given masses \[kg\].
    ///
    /// Only the damping of the Kelvin family depends on the masses: c = 2ζ √(k m_e), with
    /// ζ = −ln e / √(π² + ln² e) (Anagnostopoulos 1988) and m_e = m₁m₂/(m₁ + m₂).
    #[must_use]
    pub fn between(&self, left_mass: f64, right_mass: f64) -> ForceLaw {
        let (k, e) = (self.stiffness, self.restitution);
        let realised = self.restitution_is == RestitutionIs::Realised;
        let kelvin = |ratio: f64, tension| ForceLaw::Kelvin {
            stiffness: k,
            damping: 2.0 * ratio * (k * effective_mass(left_mass, right_mass)).sqrt(),
            // Without damping there is nothing to pull with.
            tension: tension && ratio > 0.0,
        };
        match self.kind {
            LawKind::Linear => kelvin(0.0, false),
            LawKind::Kelvin => kelvin(kelvin_damping_ratio(e), true),
            LawKind::KelvinNoTension if realised => kelvin(clipped_kelvin_damping_ratio(e), false),
            LawKind::KelvinNoTension => kelvin(kelvin_damping_ratio(e), false),
            LawKind::Hertz => ForceLaw::Hertz {
                stiffness: k,
                damping: 0.0,
            },
            LawKind::HertzDamp if realised => ForceLaw::Hertz {
                stiffness: k,
                damping: hertz_damping(e),
            },
            LawKind::HertzDamp => ForceLaw::Hertz {
                stiffness: k,
                damping: 0.75 * (1.0 - e * e),
            },
        }
    }

    /// Separation speed ÷ impact speed of two free masses under this law \[–\] (theory, Eqs. C3–C5).
    #[must_use]
    pub fn free_restitution(&self) -> f64 {
        match self.between(1.0, 1.0) {
            ForceLaw::Kelvin {
                stiffness,
                damping,
                tension,
            } => {
                let ratio = damping / (2.0 * (0.5 * stiffness).sqrt());
                if tension {
                    kelvin_restitution(ratio)
                } else {
                    clipped_kelvin_restitution(ratio)
                }
            }
            ForceLaw::Hertz { damping, .. } => hertz_restitution(damping),
        }
    }
}

impl ForceLaw {
    /// Force and derivatives at indentation δ \[m\], rate δ̇ \[m/s\], for an impact that began at
    /// `impact_speed` v₀ > 0 \[m/s\]. Zero for δ ≤ 0, except for the pulling Kelvin law, which holds on
    /// until its contact is released.
    #[must_use]
    #[inline]
    pub fn respond(&self, indentation: f64, rate: f64, impact_speed: f64) -> ContactResponse {
        match *self {
            Self::Kelvin {
                stiffness: k,
                damping: c,
                tension,
            } => {
                let force = k * indentation + c * rate;
                if tension || (indentation > 0.0 && force > 0.0) {
                    ContactResponse {
                        force,
                        by_indentation: k,
                        by_rate: c,
                    }
                } else {
                    ContactResponse::default()
                }
            }
            Self::Hertz {
                stiffness: k,
                damping: d,
            } => {
                let factor = 1.0 + d / impact_speed * rate;
                if indentation <= 0.0 || factor <= 0.0 {
                    return ContactResponse::default();
                }
                let root = indentation.sqrt();
                ContactResponse {
                    force: k * indentation * root * factor,
                    by_indentation: 1.5 * k * root * factor,
                    by_rate: k * indentation * root * d / impact_speed,
                }
            }
        }
    }

    /// Force at the instant of touch, before any indentation, at the closing rate `rate` ≥ 0 \[N\].
    #[must_use]
    pub fn onset(&self, rate: f64) -> f64 {
        match *self {
            Self::Kelvin { damping, .. } => damping * rate,
            Self::Hertz { .. } => 0.0,
        }
    }

    /// Whether the force jumps when the contact opens, so that a step must end there.
    #[must_use]
    pub fn jumps_at_release(&self) -> bool {
        matches!(self, Self::Kelvin { damping, tension: true, .. } if *damping > 0.0)
    }

    /// Duration of the elastic collision of free bodies: the time scale of an impact \[s\].
    ///
    /// `effective_mass` m₁m₂/(m₁ + m₂) \[kg\], `impact_speed` > 0 \[m/s\]. Linear: π√(m/k). Hertz:
    /// 2.9432751843 δ_max/v₀ with δ_max = (5 m v₀²/(4k))^(2/5) (theory, Eq. C6).
    #[must_use]
    pub fn elastic_duration(&self, effective_mass: f64, impact_speed: f64) -> f64 {
        match *self {
            Self::Kelvin { stiffness, .. } => PI * (effective_mass / stiffness).sqrt(),
            Self::Hertz { stiffness, .. } => {
                HERTZ_DURATION * hertz_indentation(stiffness, effective_mass, impact_speed)
                    / impact_speed
            }
        }
    }
}

/// Duration × impact speed ÷ greatest indentation of an elastic Hertz collision, (4√π/5) Γ(2/5)/Γ(9/10).
pub const HERTZ_DURATION: f64 = 2.943_275_184_324_704_7;

/// m₁m₂/(m₁ + m₂) \[kg\].
#[must_use]
pub fn effective_mass(left_mass: f64, right_mass: f64) -> f64 {
    1.0 / (1.0 / left_mass + 1.0 / right_mass)
}

/// Greatest indentation of an elastic Hertz collision, (5 m v²/(4k))^(2/5) \[m\].
#[must_use]
pub fn hertz_indentation(stiffness: f64, effective_mass: f64, impact_speed: f64) -> f64 {
    (1.25 * effective_mass * impact_speed * impact_speed / stiffness).powf(0.4)
}

/// Damping ratio of the Kelvin law from e, −ln e/√(π² + ln² e); exact while tension is allowed.
fn kelvin_damping_ratio(e: f64) -> f64 {
    let ln = e.ln();
    -ln / (PI * PI + ln * ln).sqrt()
}

fn kelvin_restitution(ratio: f64) -> f64 {
    (-PI * ratio / (1.0 - ratio * ratio).sqrt()).exp()
}

/// Rebound of the Kelvin law cut at F = 0: the force vanishes at ω_d t = π − atan2(2ζ√(1−ζ²), 1−2ζ²).
fn clipped_kelvin_restitution(ratio: f64) -> f64 {
    let z = ratio;
    let root = (1.0 - z * z).sqrt();
    (-z / root * (PI - (2.0 * z * root).atan2(1.0 - 2.0 * z * z))).exp()
}

fn clipped_kelvin_damping_ratio(e: f64) -> f64 {
    // Falls from 1 at ζ = 0 to exp(−2) as ζ → 1.
    bisect(0.0, 1.0 - 1e-12, |ratio| {
        clipped_kelvin_restitution(ratio) - e
    })
}

/// Smallest rebound that the cut Kelvin law can realise with a damping ratio below one \[–\].
pub const CLIPPED_KELVIN_LEAST_RESTITUTION: f64 = 0.135_335_283_236_612_7;

/// The d of Eq. C2 with which free masses rebound with e: ln[(1 + d)/(1 − e d)] = d (1 + e).
#[must_use]
pub fn hertz_damping(e: f64) -> f64 {
    if e >= 1.0 {
        return 0.0;
    }
    let mismatch = |d: f64| ((1.0 + d) / (1.0 - e * d)).ln() - d * (1.0 + e);
    // d = 0 is a root as well; the wanted one lies between it and the pole 1/e, and the mismatch starts
    // out as −d²(1 − e²)/2.
    bisect(1e-3 * (1.0 - e), (1.0 - 1e-15) / e, mismatch)
}

/// Rebound of free masses for the d of Eq. C2 (the inverse of [`hertz_damping`]).
#[must_use]
pub fn hertz_restitution(d: f64) -> f64 {
    if d <= 0.0 {
        return 1.0;
    }
    let energy = d - d.ln_1p();
    // −w − ln(1 − w) = d − ln(1 + d) with w = e d.
    bisect(0.0, 1.0 - 1e-16, |w| -w - (-w).ln_1p() - energy) / d
}

/// Root of a function that changes sign once between `low` and `high`, to the last bit.
fn bisect(mut low: f64, mut high: f64, f: impl Fn(f64) -> f64) -> f64 {
    let rising = f(high) > 0.0;
    for _ in 0..200 {
        let middle = 0.5 * (low + high);
        if middle <= low || middle >= high {
            break;
        }
        if (f(middle) > 0.0) == rising {
            high = middle;
        } else {
            low = middle;
        }
    }
    0.5 * (low + high)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn law(kind: LawKind, e: f64, restitution_is: RestitutionIs) -> ContactLaw {
        ContactLaw {
            kind,
            stiffness: 2e9,
            restitution: e,
            restitution_is,
        }
    }

    #[test]
    fn calibrated_laws_rebound_as_asked() {
        for e in [0.2, 0.3, 0.5, 0.65, 0.8, 0.95, 0.99] {
            for kind in [
                LawKind::Kelvin,
                LawKind::KelvinNoTension,
                LawKind::HertzDamp,
            ] {
                let realised = law(kind, e, RestitutionIs::Realised).free_restitution();
                assert!(
                    (realised - e).abs() < 1e-10,
                    "{kind:?} should rebound with {e}, got {realised}"
                );
            }
        }
    }

    #[test]
    fn the_published_hertz_damp_rebounds_livelier_than_its_e() {
        // Integrated by DOP853 at rtol 3e-14 and by mpmath, see the validation data.
        let realised = law(LawKind::HertzDamp, 0.65, RestitutionIs::Input).free_restitution();
        assert!(
            (realised - 0.774_819_081_179_966_8).abs() < 1e-12,
            "{realised}"
        );
    }

    #[test]
    fn tangents_match_differences() {
        let laws = [
            ForceLaw::Kelvin {
                stiffness: 9e7,
                damping: 3e5,
                tension: false,
            },
            ForceLaw::Kelvin {
                stiffness: 9e7,
                damping: 3e5,
                tension: true,
            },
            ForceLaw::Hertz {
                stiffness: 2e9,
                damping: 0.4,
            },
        ];
        for law in laws {
            for (x, v) in [(1e-3, 0.3), (4e-3, -0.1), (2e-4, 0.0)] {
                let r = law.respond(x, v, 0.4);
                let dx = (law.respond(x + 1e-8, v, 0.4).force
                    - law.respond(x - 1e-8, v, 0.4).force)
                    / 2e-8;
                let dv = (law.respond(x, v + 1e-6, 0.4).force
                    - law.respond(x, v - 1e-6, 0.4).force)
                    / 2e-6;
                assert!(
                    (r.by_indentation - dx).abs() <= 1e-5 * dx.abs(),
                    "{law:?} at {x}, {v}"
                );
                assert!(
                    (r.by_rate - dv).abs() <= 1e-5 * dv.abs().max(1.0),
                    "{law:?} at {x}, {v}"
                );
            }
        }
    }

    #[test]
    fn only_the_pulling_kelvin_law_pulls() {
        for (x, v) in [(1e-4, -0.5), (1e-4, -50.0), (-1e-4, 0.5)] {
            for kind in [
                LawKind::Linear,
                LawKind::KelvinNoTension,
                LawKind::Hertz,
                LawKind::HertzDamp,
            ] {
                let force = law(kind, 0.3, RestitutionIs::Input)
                    .between(4e4, 6e4)
                    .respond(x, v, 0.5)
                    .force;
                assert!(force >= 0.0, "{kind:?} pulls with {force} N at {x}, {v}");
            }
        }
        let kelvin = law(LawKind::Kelvin, 0.3, RestitutionIs::Input).between(4e4, 6e4);
        assert!(
            kelvin.respond(1e-4, -0.5, 0.5).force < 0.0,
            "kelvin must pull near release"
        );
    }
}
