//! F = k δⁿ (1 + d δ̇/v₀): `hertz`, `hertz-damp` and `ye` with n = 3/2, `modified-kelvin` after Ye with n = 1.

use super::force_law::ContactResponse;
use super::root::bisect;

/// F = k δ^1.5 (1 + d δ̇/v) (docs/contact.md, H1).
#[inline]
pub(super) fn respond_hertz(
    stiffness: f64,
    damping: f64,
    indentation: f64,
    rate: f64,
    speed: f64,
) -> ContactResponse {
    let factor = 1.0 + damping / speed * rate;
    if indentation <= 0.0 || factor <= 0.0 {
        return ContactResponse::default();
    }
    let root = indentation.sqrt();
    ContactResponse {
        force: stiffness * indentation * root * factor,
        by_indentation: 1.5 * stiffness * root * factor,
        by_rate: stiffness * indentation * root * damping / speed,
    }
}

/// F = k δ (1 + d δ̇/v) (docs/contact.md, H1).
#[inline]
pub(super) fn respond_linear(
    stiffness: f64,
    damping: f64,
    indentation: f64,
    rate: f64,
    speed: f64,
) -> ContactResponse {
    let factor = 1.0 + damping / speed * rate;
    if indentation <= 0.0 || factor <= 0.0 {
        return ContactResponse::default();
    }
    ContactResponse {
        force: stiffness * indentation * factor,
        by_indentation: stiffness * factor,
        by_rate: stiffness * indentation * damping / speed,
    }
}

/// d = ¾(1 − e²) (Muthukumar & DesRoches 2006, after Lankarani & Nikravesh 1990).
pub(super) fn published_muthukumar(e: f64) -> f64 {
    0.75 * (1.0 - e * e)
}

/// d = 8/5 (1 − e)/e (Ye, Li & Zhu 2009).
pub(super) fn published_ye(e: f64) -> f64 {
    1.6 * (1.0 - e) / e
}

/// d = 3/2 (1 − e)/e (Ye, Li & Zhu 2009, linear spring).
pub(super) fn published_ye_linear(e: f64) -> f64 {
    1.5 * (1.0 - e) / e
}

/// Duration × impact speed ÷ greatest indentation of an elastic Hertz collision, (4√π/5) Γ(2/5)/Γ(9/10).
pub const HERTZ_DURATION: f64 = 2.943_275_184_324_704_7;

/// Greatest indentation of an elastic Hertz collision, (5 m v²/(4k))^(2/5) \[m\].
#[must_use]
pub fn hertz_indentation(stiffness: f64, effective_mass: f64, impact_speed: f64) -> f64 {
    libm::pow(
        1.25 * effective_mass * impact_speed * impact_speed / stiffness,
        0.4,
    )
}

/// The d with which free masses rebound with e, for any n, k and masses: ln[(1 + d)/(1 − e d)] = d (1 + e)
/// (docs/contact.md, H2).
#[must_use]
pub fn hertz_damping(e: f64) -> f64 {
    if e >= 1.0 {
        return 0.0;
    }
    let mismatch = |d: f64| libm::log((1.0 + d) / (1.0 - e * d)) - d * (1.0 + e);
    // d = 0 is a root as well; the required one lies between it and the pole 1/e, and near zero the residual is
    // −d²(1 − e²)/2.
    bisect(1e-3 * (1.0 - e), (1.0 - 1e-15) / e, mismatch)
}

/// Rebound of free masses for a given d (the inverse of [`hertz_damping`]).
#[must_use]
pub fn hertz_restitution(d: f64) -> f64 {
    if d <= 0.0 {
        return 1.0;
    }
    let energy = d - libm::log1p(d);
    // −w − ln(1 − w) = d − ln(1 + d) with w = e d.
    bisect(0.0, 1.0 - 1e-16, |w| -w - libm::log1p(-w) - energy) / d
}
