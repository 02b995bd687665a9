//! The momentum law: `restitution`.

/// Impact speed below which lasting contact starts instead of an impact of the momentum law \[m/s\]. Otherwise
/// rebounds would never end: their speeds decrease as eⁿ, and so do the intervals.
pub(crate) const REST_SPEED: f64 = 1e-3;

/// Impulse that turns the closing speed v into −e v: (1 + e) v/(gᵀM⁻¹g) \[N·s\] (docs/contact.md, N1).
pub(crate) fn impulse(restitution: f64, effective_mass: f64, closing_speed: f64) -> f64 {
    (1.0 + restitution) * effective_mass * closing_speed
}
