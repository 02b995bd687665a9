//! Widths of seismic joints required by codes, to compare with the computed closing.
//!
//! [`required_gaps`] lists what every rule requires of two neighbours; the rules themselves are functions of numbers.

mod code_inputs;
mod codes;
mod rules;

pub use code_inputs::{BuildingCodes, Code, CodeInputs, HazardZone, MotionLevel};
pub use codes::{
    IRAN2800_MOST_STOREYS, Nsr10Neighbour, asce7_displacement, e030_2018_joint, e030_2026_joint,
    e030_share, en1998_joint, iran2800_setback, is1893_joint, nsr10_setback, ntc2018_joint,
    tbdy2018_joint, tbdy2018_least_joint,
};
pub use rules::{
    LeftOut, Neighbours, Place, Requirement, Requirements, Side, floors_are_level, peak_at_height,
    required_gaps,
};

/// Width of the seismic joint between concrete frame structures, GB 50011-2010 (2016) §6.1.4 \[m\].
///
/// 100 mm up to a height of 15 m; above that 20 mm more for every further 5, 4, 3 or 2 m at intensity 6, 7, 8 or 9,
/// interpolated linearly: 100 + 20 (H − 15)/(11 − I).
///
/// `height` of the lower building \[m\]; `intensity` 6 to 9, `None` outside.
#[must_use]
pub fn gb50011_frame_joint(height: f64, intensity: u32) -> Option<f64> {
    if !(6..=9).contains(&intensity) {
        return None;
    }
    let per_metre = 0.02 / f64::from(11 - intensity);
    Some(0.1 + per_metre * (height - 15.0).max(0.0))
}

/// Structural systems of GB 50011-2010 (2016) §6.1.4 and §8.1.4.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum JointSystem {
    /// Concrete frames.
    #[default]
    Frame,
    /// Concrete frames with walls: 0.7 of the frame's width, at least 100 mm.
    FrameWall,
    /// Concrete walls: 0.5 of it, at least 100 mm.
    Wall,
    /// Steel frames: 1.5 of it.
    SteelFrame,
}

impl JointSystem {
    /// All systems.
    pub const ALL: [Self; 4] = [Self::Frame, Self::FrameWall, Self::Wall, Self::SteelFrame];

    /// Name in files and options.
    #[must_use]
    pub const fn name(self) -> &'static str {
        match self {
            Self::Frame => "frame",
            Self::FrameWall => "frame-wall",
            Self::Wall => "wall",
            Self::SteelFrame => "steel-frame",
        }
    }

    /// The system of a name.
    #[must_use]
    pub fn named(name: &str) -> Option<Self> {
        Self::ALL.into_iter().find(|system| system.name() == name)
    }
}

/// Width of the seismic joint by GB 50011-2010 (2016) for a structural system \[m\]; the rest as
/// [`gb50011_frame_joint`]. Between different systems the one that needs the wider joint counts.
#[must_use]
pub fn gb50011_joint(height: f64, intensity: u32, system: JointSystem) -> Option<f64> {
    let frame = gb50011_frame_joint(height, intensity)?;
    Some(match system {
        JointSystem::Frame => frame,
        JointSystem::FrameWall => (0.7 * frame).max(0.1),
        JointSystem::Wall => (0.5 * frame).max(0.1),
        JointSystem::SteelFrame => 1.5 * frame,
    })
}

/// Square root of the sum of squares of two peak displacements, the separation of ASCE 7-16 §12.12.3 and
/// EN 1998-1 §4.4.2.7 when the displacements are the design ones \[m\].
#[must_use]
pub fn srss(left: f64, right: f64) -> f64 {
    libm::hypot(left, right)
}

/// Sum of two peak displacements, the widest of the usual rules \[m\].
#[must_use]
pub fn absolute_sum(left: f64, right: f64) -> f64 {
    left.abs() + right.abs()
}

/// Correlation of the responses of two oscillators to the same broad-band motion,
///
/// ```text
/// ρ = 8 √(ξ_A ξ_B) (ξ_A + ξ_B r) r^1.5 / [(1 − r²)² + 4 ξ_A ξ_B r (1 + r²) + 4 (ξ_A² + ξ_B²) r²],   r = T_A/T_B   (SP1)
/// ```
/// that of the complete quadratic combination (Der Kiureghian 1981) as Jeng, Kasai and Maison (1992) and Penzien
/// (1997) use it for neighbouring buildings. `periods` > 0 \[s\]; `damping` ratios > 0 \[–\].
#[must_use]
pub fn ddc_coefficient(periods: [f64; 2], damping: [f64; 2]) -> f64 {
    let [a, b] = damping;
    let r = periods[0] / periods[1];
    let square = r * r;
    8.0 * (a * b).sqrt() * (a + b * r) * r * r.sqrt()
        / ((1.0 - square).powi(2)
            + 4.0 * a * b * r * (1.0 + square)
            + 4.0 * (a * a + b * b) * square)
}

/// Double difference combination of two peak displacements, √(δ_A² + δ_B² − 2ρ δ_A δ_B): buildings with similar
/// motion need a smaller gap (Jeng, Kasai and Maison 1992) \[m\].
#[must_use]
pub fn double_difference(left: f64, right: f64, correlation: f64) -> f64 {
    // Rounding may give a value slightly below zero.
    let square = left * left + right * right - 2.0 * correlation * (left * right).abs();
    square.max(0.0).sqrt()
}

/// Fraction of the SRSS required by EN 1998-1 §4.4.2.7(3) if the floors of both buildings lie at equal height.
pub const EN1998_ALIGNED_FLOORS: f64 = 0.7;

/// Maximum inelastic displacement over the elastic one, UBC-97 §1630.9.2: Δ_M = 0.7 R Δ_S, where Δ_S belongs to forces
/// divided by R \[–\].
pub const UBC97_OF_ELASTIC: f64 = 0.7;

#[cfg(test)]
mod tests {
    use super::*;

    /// Values computed independently, to five digits.
    #[test]
    fn ddc_coefficients_are_the_published_form() {
        for (periods, damping, expected) in [
            ([0.6, 1.0], [0.05, 0.05], 0.035_00),
            ([0.9, 1.0], [0.05, 0.02], 0.282_40),
            ([1.0, 0.5], [0.02, 0.10], 0.024_08),
        ] {
            let rho = ddc_coefficient(periods, damping);
            assert!((rho - expected).abs() < 5e-6, "{periods:?}: {rho}");
            // The result does not depend on which building is on the left.
            let [t, u] = periods;
            let [x, y] = damping;
            let other = ddc_coefficient([u, t], [y, x]);
            assert!((rho - other).abs() < 1e-15, "{rho} {other}");
        }
        assert!((ddc_coefficient([0.7, 0.7], [0.05, 0.05]) - 1.0).abs() < 1e-15);
    }

    #[test]
    fn stiffer_systems_need_less_but_never_under_100_mm() {
        let at = |system| gb50011_joint(45.0, 8, system).map(|w| (w * 1e3).round());
        assert_eq!(at(JointSystem::Frame), Some(300.0));
        assert_eq!(at(JointSystem::FrameWall), Some(210.0));
        assert_eq!(at(JointSystem::Wall), Some(150.0));
        assert_eq!(at(JointSystem::SteelFrame), Some(450.0));
        assert_eq!(gb50011_joint(15.0, 8, JointSystem::Wall), Some(0.1));
    }

    #[test]
    fn double_difference_lies_between_twins_and_strangers() {
        assert_eq!(double_difference(0.1, 0.1, 1.0), 0.0);
        assert!((double_difference(0.3, -0.4, 0.0) - 0.5).abs() < 1e-15);
        assert!(double_difference(0.3, 0.4, 0.3) < srss(0.3, 0.4));
    }

    #[test]
    fn joint_of_a_16_m_frame_by_intensity() {
        let joint = |i| gb50011_frame_joint(16.0, i).map(|width| (width * 1e4).round() / 10.0);
        assert_eq!(
            [joint(6), joint(7), joint(8), joint(9)],
            [Some(104.0), Some(105.0), Some(106.7), Some(110.0)]
        );
        assert_eq!(joint(5), None);
        assert_eq!(gb50011_frame_joint(9.0, 8), Some(0.1));
    }
}
