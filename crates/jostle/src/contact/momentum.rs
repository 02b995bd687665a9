//! The momentum law: `restitution`.

/// Touches slower than this are no impacts of the momentum law but the beginning of a lasting contact \[m/s\].
/// Bounces that follow each other would otherwise never end: their speeds fall as eⁿ, and so do the times between.
pub(crate) const REST_SPEED: f64 = 1e-3;

/// Impulse that turns the closing speed v into −e v: (1 + e) v/(gᵀM⁻¹g) \[N·s\] (docs/contact.md, N1).
pub(crate) fn impulse(restitution: f64, effective_mass: f64, closing_speed: f64) -> f64 {
    (1.0 + restitution) * effective_mass * closing_speed
}
