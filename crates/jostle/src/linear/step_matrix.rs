//! The matrix to factorise.

/// K̂ = κ K + K′ + c C′ + g M of one building (theory, Eq. N2): members and joints, P-Delta and base springs,
/// dashpots, masses.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct StepMatrix {
    /// κ: weight of the stiffness with stiffness-proportional damping, 1 + β c in a step \[–\].
    pub stiffness: f64,
    /// g: weight of the masses \[1/s²\].
    pub mass: f64,
    /// c: weight of the dashpots \[1/s\].
    pub dashpots: f64,
}

impl StepMatrix {
    /// K + K′: the static stiffness.
    pub const STATIC: Self = Self {
        stiffness: 1.0,
        mass: 0.0,
        dashpots: 0.0,
    };

    /// κ K + K′ + g M, without dashpots.
    #[must_use]
    pub const fn new(stiffness: f64, mass: f64) -> Self {
        Self {
            stiffness,
            mass,
            dashpots: 0.0,
        }
    }
}
