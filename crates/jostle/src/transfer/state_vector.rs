//! The state of a cut (theory, Eq. S1).

use std::ops::{Add, Sub};

/// Displacements and forces at a cut, relative to the ground and in global axes; for the signs see the figure in
/// [`crate::transfer`].
///
/// ```text
/// z = [x, y, θ, m, qx, qy]ᵀ                                                                          (S1)
/// ```
/// The forces are those of the input side on the output side: a column traversed upwards is compressed when qy > 0,
/// a beam traversed to the right when qx > 0.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct StateVector {
    /// Displacement to the right \[m\].
    pub x: f64,
    /// Displacement upwards \[m\].
    pub y: f64,
    /// Rotation, counter-clockwise \[rad\].
    pub theta: f64,
    /// Moment, counter-clockwise \[N·m\].
    pub m: f64,
    /// Force to the right \[N\].
    pub qx: f64,
    /// Force upwards \[N\].
    pub qy: f64,
}

impl StateVector {
    /// From x, y, θ, m, qx, qy.
    #[must_use]
    pub fn from_array([x, y, theta, m, qx, qy]: [f64; 6]) -> Self {
        Self {
            x,
            y,
            theta,
            m,
            qx,
            qy,
        }
    }

    /// x, y, θ, m, qx, qy.
    #[must_use]
    pub fn to_array(self) -> [f64; 6] {
        [self.x, self.y, self.theta, self.m, self.qx, self.qy]
    }

    /// At a fixed base: forces m, qx, qy, no displacement.
    #[must_use]
    pub fn at_base([m, qx, qy]: [f64; 3]) -> Self {
        Self {
            m,
            qx,
            qy,
            ..Self::default()
        }
    }

    /// **a** = (x, y, θ): H z in the notation of the theory.
    #[must_use]
    pub fn displacements(self) -> [f64; 3] {
        [self.x, self.y, self.theta]
    }

    /// **b** = (m, qx, qy).
    #[must_use]
    pub fn forces(self) -> [f64; 3] {
        [self.m, self.qx, self.qy]
    }

    /// The same forces without displacements: E z in the notation of the theory.
    #[must_use]
    pub fn forces_only(self) -> Self {
        Self::at_base(self.forces())
    }
}

impl Add for StateVector {
    type Output = Self;

    fn add(self, other: Self) -> Self {
        let (a, b) = (self.to_array(), other.to_array());
        Self::from_array(std::array::from_fn(|k| a[k] + b[k]))
    }
}

impl Sub for StateVector {
    type Output = Self;

    fn sub(self, other: Self) -> Self {
        let (a, b) = (self.to_array(), other.to_array());
        Self::from_array(std::array::from_fn(|k| a[k] - b[k]))
    }
}
