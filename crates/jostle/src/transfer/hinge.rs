//! Planar elastic hinges (theory, Eq. T5).

use super::Transfer;

/// Elastic connection of two coincident ends. A direction that is `None` is rigid.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct PlanarHinge {
    /// K_θ > 0 \[N·m/rad\].
    pub rotational_stiffness: Option<f64>,
    /// K_x > 0 \[N/m\].
    pub horizontal_stiffness: Option<f64>,
    /// K_y > 0 \[N/m\].
    pub vertical_stiffness: Option<f64>,
}

impl PlanarHinge {
    /// Transfer through the hinge.
    ///
    /// ```text
    /// x_O = x_I − qx/K_x,   y_O = y_I − qy/K_y,   θ_O = θ_I − m/K_θ,   forces unchanged              (T5)
    /// ```
    /// ```
    /// use jostle::transfer::{PlanarHinge, StateVector};
    /// let hinge = PlanarHinge { rotational_stiffness: Some(2e6), ..PlanarHinge::default() };
    /// let beyond = hinge.transfer().apply(StateVector { m: 1e4, qy: 7e3, ..StateVector::default() });
    /// assert_eq!((beyond.theta, beyond.y, beyond.m), (-0.005, 0.0, 1e4));
    /// ```
    #[must_use]
    pub fn transfer(&self) -> Transfer {
        let mut transfer = Transfer::identity();
        let directions = [
            (0, 4, self.horizontal_stiffness),
            (1, 5, self.vertical_stiffness),
            (2, 3, self.rotational_stiffness),
        ];
        for (displacement, force, stiffness) in directions {
            transfer.matrix[displacement][force] = stiffness.map_or(0.0, |k| -1.0 / k);
        }
        transfer
    }

    /// The hinge with every stiffness multiplied by κ (theory, Eq. D2).
    #[must_use]
    pub fn stiffened(&self, factor: f64) -> Self {
        let times = |stiffness: Option<f64>| stiffness.map(|k| factor * k);
        Self {
            rotational_stiffness: times(self.rotational_stiffness),
            horizontal_stiffness: times(self.horizontal_stiffness),
            vertical_stiffness: times(self.vertical_stiffness),
        }
    }

    /// Transfer of a nonlinear hinge near a known point of its curve: `moment` m_r at the relative rotation
    /// `rotation` δ_r = θ_I − θ_O, with the tangent k_t ≠ 0.
    ///
    /// ```text
    /// m = m_r + k_t (δ − δ_r)   ⇒   θ_O = θ_I − m/k_t + (m_r/k_t − δ_r)
    /// ```
    /// Its translations are those of this hinge; its rotational stiffness is not used.
    ///
    /// ```
    /// use jostle::transfer::{PlanarHinge, StateVector};
    /// // A hinge at 250 N·m and 0.006 rad, 30 N·m further along a slope of 2000 N·m/rad: δ = 0.021 rad.
    /// let hinge = PlanarHinge::default().incremental(2000.0, 250.0, 0.006);
    /// let beyond = hinge.apply(StateVector { m: 280.0, ..StateVector::default() });
    /// assert!((beyond.theta + 0.021).abs() < 1e-15);
    /// ```
    #[must_use]
    pub fn incremental(&self, tangent: f64, moment: f64, rotation: f64) -> Transfer {
        let mut transfer = Self {
            rotational_stiffness: Some(tangent),
            ..*self
        }
        .transfer();
        transfer.load[2] = moment / tangent - rotation;
        transfer
    }
}
