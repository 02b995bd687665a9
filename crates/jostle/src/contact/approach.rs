//! Laws that dissipate in the approach only: `jankowski`, and `modified-kelvin` after Mahmoud and Jankowski.
//!
//! Both have the same closed form. With s = δ^(5/4) the phase plane of Jankowski's law, v dv/ds, is that of the
//! linear one at the damping ratio ζ = 2ξ/√5 (docs/contact.md, A3).

use std::f64::consts::PI;

use super::force_law::ContactResponse;
use super::root::bisect;

/// F = k δ + c δ̇ while δ̇ > 0, k δ afterwards (Mahmoud & Jankowski 2011; docs/contact.md, A1).
#[inline]
pub(super) fn respond_linear(
    stiffness: f64,
    damping: f64,
    indentation: f64,
    rate: f64,
) -> ContactResponse {
    if indentation <= 0.0 {
        return ContactResponse::default();
    }
    let damping = if rate > 0.0 { damping } else { 0.0 };
    ContactResponse {
        force: stiffness * indentation + damping * rate,
        by_indentation: stiffness,
        by_rate: damping,
    }
}

/// F = k δ^1.5 + c δ^¼ δ̇ while δ̇ > 0, k δ^1.5 afterwards (Jankowski 2005; docs/contact.md, A2).
#[inline]
pub(super) fn respond_jankowski(
    stiffness: f64,
    damping: f64,
    indentation: f64,
    rate: f64,
) -> ContactResponse {
    if indentation <= 0.0 {
        return ContactResponse::default();
    }
    let root = indentation.sqrt();
    let spring = ContactResponse {
        force: stiffness * indentation * root,
        by_indentation: 1.5 * stiffness * root,
        by_rate: 0.0,
    };
    if rate <= 0.0 {
        return spring;
    }
    let quarter = damping * root.sqrt();
    ContactResponse {
        force: spring.force + quarter * rate,
        by_indentation: spring.by_indentation + 0.25 * quarter / indentation * rate,
        by_rate: quarter,
    }
}

/// ξ = (1 − e²)/(e (e(π − 2) + 2)) (Mahmoud & Jankowski 2011).
pub(super) fn published_mahmoud_jankowski(e: f64) -> f64 {
    (1.0 - e * e) / (e * (e * (PI - 2.0) + 2.0))
}

/// ξ = (9√5/2)(1 − e²)/(e (e(9π − 16) + 16)) (Jankowski 2006).
pub(super) fn published_jankowski(e: f64) -> f64 {
    4.5 * 5.0_f64.sqrt() * (1.0 - e * e) / (e * (e * (9.0 * PI - 16.0) + 16.0))
}

/// Damping ratio ζ of the linear law in the phase plane of Jankowski's law with ξ.
pub(super) fn linear_ratio(jankowski: f64) -> f64 {
    2.0 / 5.0_f64.sqrt() * jankowski
}

/// The inverse of [`linear_ratio`].
pub(super) fn jankowski_ratio(linear: f64) -> f64 {
    0.5 * 5.0_f64.sqrt() * linear
}

/// Rebound of free masses for a damping ratio ζ in the approach: exp(−ζ arccos ζ/√(1 − ζ²)), continued beyond
/// ζ = 1 by exp(−ζ arcosh ζ/√(ζ² − 1)).
pub(super) fn approach_restitution(ratio: f64) -> f64 {
    let z = ratio;
    // arccos ζ/√(1 − ζ²) and its continuation; both are 1 + (1 − ζ)/3 + … at ζ = 1.
    let quotient = if (z - 1.0).abs() < 1e-6 {
        1.0 + (1.0 - z) / 3.0
    } else if z < 1.0 {
        libm::acos(z) / (1.0 - z * z).sqrt()
    } else {
        libm::acosh(z) / (z * z - 1.0).sqrt()
    };
    libm::exp(-z * quotient)
}

/// The damping ratio with which free masses rebound with e: the inverse of [`approach_restitution`].
pub(super) fn approach_damping_ratio(e: f64) -> f64 {
    if e >= 1.0 {
        return 0.0;
    }
    // e > 1/(2.72 ζ) for ζ ≥ 1 and beyond, so the root lies below 1 + 1/e.
    bisect(0.0, 1.0 + 1.0 / e, |ratio| approach_restitution(ratio) - e)
}
