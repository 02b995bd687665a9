//! Spring and dashpot in parallel: `linear`, `kelvin`, `kelvin-no-tension`, and lasting contact of the momentum
//! law.

use std::f64::consts::PI;

use super::force_law::ContactResponse;
use super::root::bisect;

/// F = k δ + c δ̇ (Anagnostopoulos 1988; docs/contact.md, K1). With `tension` the force acts until the contact is
/// released; otherwise it is cut at zero.
#[inline]
pub(super) fn respond(
    stiffness: f64,
    damping: f64,
    tension: bool,
    indentation: f64,
    rate: f64,
) -> ContactResponse {
    let force = stiffness * indentation + damping * rate;
    if tension || (indentation > 0.0 && force > 0.0) {
        ContactResponse {
            force,
            by_indentation: stiffness,
            by_rate: damping,
        }
    } else {
        ContactResponse::default()
    }
}

/// Damping ratio of the Kelvin law from e, −ln e/√(π² + ln² e); exact while tension is allowed.
pub(super) fn kelvin_damping_ratio(e: f64) -> f64 {
    let ln = libm::log(e);
    -ln / (PI * PI + ln * ln).sqrt()
}

pub(super) fn kelvin_restitution(ratio: f64) -> f64 {
    libm::exp(-PI * ratio / (1.0 - ratio * ratio).sqrt())
}

/// Rebound of the Kelvin law cut at F = 0: the force vanishes at ω_d t = π − atan2(2ζ√(1−ζ²), 1−2ζ²).
pub(super) fn clipped_kelvin_restitution(ratio: f64) -> f64 {
    let z = ratio;
    let root = (1.0 - z * z).sqrt();
    libm::exp(-z / root * (PI - libm::atan2(2.0 * z * root, 1.0 - 2.0 * z * z)))
}

pub(super) fn clipped_kelvin_damping_ratio(e: f64) -> f64 {
    // Falls from 1 at ζ = 0 to exp(−2) as ζ → 1.
    bisect(0.0, 1.0 - 1e-12, |ratio| {
        clipped_kelvin_restitution(ratio) - e
    })
}

/// Smallest rebound that the cut Kelvin law can realise with a damping ratio below one \[–\].
pub const CLIPPED_KELVIN_LEAST_RESTITUTION: f64 = 0.135_335_283_236_612_7;
