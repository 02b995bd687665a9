//! EN 1998-1:2004, clause 3.2.2.2: horizontal elastic response spectrum with the recommended parameters.

/// Elastic spectrum of EN 1998-1, Eqs. (3.2) to (3.5), for periods up to 4 s.
///
/// ```text
/// T ≤ T_B   S_e = a_g S [1 + T/T_B (2.5 η − 1)]
/// T ≤ T_C   S_e = 2.5 a_g S η
/// T ≤ T_D   S_e = 2.5 a_g S η T_C/T
/// T ≤ 4 s   S_e = 2.5 a_g S η T_C T_D/T²,      η = √(10/(5 + 100 ζ)) ≥ 0.55
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct En1998 {
    /// Type of the spectrum.
    pub kind: EnType,
    /// Ground type.
    pub ground: EnGround,
    /// Design ground acceleration on ground A, importance factor included, > 0 \[m/s²\].
    pub ground_acceleration: f64,
}

/// Type of the spectrum.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum EnType {
    /// Strong earthquakes.
    One,
    /// Surface-wave magnitude not above 5.5.
    Two,
}

/// Ground type.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum EnGround {
    /// Rock.
    A,
    /// Very dense sand, gravel or very stiff clay.
    B,
    /// Deep deposits of dense sand, gravel or stiff clay.
    C,
    /// Loose or soft soil.
    D,
    /// Alluvium of 5 to 20 m over stiffer material.
    E,
}

impl En1998 {
    /// Soil factor and corner periods `[S, T_B, T_C, T_D]` \[–, s\]: Tables 3.2 and 3.3.
    #[must_use]
    pub fn parameters(&self) -> [f64; 4] {
        let rows = match self.kind {
            EnType::One => [
                [1.0, 0.15, 0.4, 2.0],
                [1.2, 0.15, 0.5, 2.0],
                [1.15, 0.20, 0.6, 2.0],
                [1.35, 0.20, 0.8, 2.0],
                [1.4, 0.15, 0.5, 2.0],
            ],
            EnType::Two => [
                [1.0, 0.05, 0.25, 1.2],
                [1.35, 0.05, 0.25, 1.2],
                [1.5, 0.10, 0.25, 1.2],
                [1.8, 0.10, 0.30, 1.2],
                [1.6, 0.05, 0.25, 1.2],
            ],
        };
        rows[self.ground as usize]
    }

    pub(super) fn acceleration(&self, t: f64, damping: f64) -> f64 {
        let [s, tb, tc, td] = self.parameters();
        let eta = (10.0 / (5.0 + 100.0 * damping)).sqrt().max(0.55);
        let shape = if t <= tb {
            1.0 + t / tb * (2.5 * eta - 1.0)
        } else if t <= tc {
            2.5 * eta
        } else if t <= td {
            2.5 * eta * tc / t
        } else {
            2.5 * eta * tc * td / (t * t)
        };
        self.ground_acceleration * s * shape
    }

    pub(super) fn name(&self) -> String {
        format!(
            "EN 1998-1, type {}, ground {:?}, a_g = {} m/s²",
            self.kind as usize + 1,
            self.ground,
            self.ground_acceleration
        )
    }
}
