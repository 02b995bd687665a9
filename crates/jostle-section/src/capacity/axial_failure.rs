//! Drift at which a column that failed in shear loses its axial load.

use crate::law;
use crate::section::Section;

/// Angle of the shear crack to the horizontal \[°\].
const CRACK_ANGLE: f64 = 65.0;

/// Drift ratio at axial failure of a column after shear failure:
///
/// ```text
/// (Δ/L) = 4/100 (1 + tan²θ) / (tan θ + P s/(Ast fyt dc tan θ)),  θ = 65°
/// ```
/// with the compression P \[N\] and the depth dc of the core between the centres of the ties. `None` without ties.
///
/// K. J. Elwood and J. P. Moehle (2005), ACI Struct. J. 102, 578–587.
#[must_use]
pub fn drift_at_axial_failure(section: &Section, compression: f64) -> Option<f64> {
    let ties = section.ties?;
    let (_, core) = law::core(section);
    let tangent = libm::tan(CRACK_ANGLE.to_radians());
    let friction = ties.area() * section.steel.yield_strength * core / ties.spacing;
    let load = compression.max(0.0) / (friction * tangent);
    Some(0.04 * (1.0 + tangent * tangent) / (tangent + load))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{Concrete, Reinforcement, Steel, StrengthLevel, Ties};

    #[test]
    fn elwood_and_moehle_by_hand() {
        let concrete = Concrete::grade("C30", StrengthLevel::Characteristic).expect("known");
        let steel = Steel::grade("HRB400", StrengthLevel::Characteristic).expect("known");
        let bars = Reinforcement::parse("12 d20").expect("understood");
        let ties = Ties::parse("d10 @ 150 mm").ok();
        let section = Section::new(0.5, 0.5, concrete, steel, &bars, 0.03, ties).expect("sound");
        // The core is 500 − 2 (30 − 5) = 450 mm deep; Ast fyt dc/s = 157.08 · 400 · 450/150 = 188 496 N.
        // tan 65° = 2.14451. P = 1000 kN: 1 000 000/(188 496 · 2.14451) = 2.47383;
        // 0.04 · 5.59891/(2.14451 + 2.47383) = 0.048494.
        let drift = drift_at_axial_failure(&section, 1e6).expect("ties");
        assert!((drift / 0.048494 - 1.0).abs() < 1e-4, "{drift}");
        // The same relation solved for the load, as OpenSees' limit curve has it:
        // P = ((1 + tan²θ)/(25 Δ/L) − tan θ) Fsw tan θ.
        let tangent = 65.0_f64.to_radians().tan();
        let load = ((1.0 + tangent * tangent) / (25.0 * drift) - tangent) * 188_495.559 * tangent;
        assert!((load / 1e6 - 1.0).abs() < 1e-6, "{load}");
    }
}
