//! Lumped masses (theory, Eq. T1) and masses where beams meet a column line (Eq. T2).

use super::{StateVector, Transfer};

/// A point mass. Within a time step its acceleration is affine in its displacement, so that it has a transfer
/// matrix.
///
/// ```text
/// qx_O = qx_I − M g x_I + f_x,   qy_O = qy_I − M g y_I + f_y,   m_O = m_I − J g θ_I + f_m            (T1)
/// ```
/// Discrete-time transfer matrix method: X. Rui et al.; for pounding frames Zhang et al. (2019),
/// doi:10.1155/2019/5706015.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct LumpedMass {
    /// M ≥ 0 \[kg\].
    pub mass: f64,
    /// J ≥ 0 \[kg·m²\].
    pub rotary_inertia: f64,
}

impl LumpedMass {
    /// Transfer with the coefficient g = A + αC of the step \[1/s²\] and all known forces f_x, f_y \[N\] and f_m
    /// \[N·m\], those that (T1) takes from the history included. With g = 0 the mass is a loaded point; with g =
    /// −ω² it vibrates harmonically.
    ///
    /// A mass on a column resonates at ω² = 3 EI/(l³ M): base and mass are in equilibrium without an external
    /// force.
    ///
    /// ```
    /// use jostle::transfer::{BeamSegment, Heading, LumpedMass, StateVector};
    /// let (length, rigidity, mass) = (3.0_f64, 1.2e7, 800.0);
    /// let squared_frequency = 3.0 * rigidity / (length.powi(3) * mass);
    /// let point = LumpedMass { mass, rotary_inertia: 0.0 };
    /// let line = BeamSegment::bending(length, rigidity)
    ///     .transfer(Heading::Up)
    ///     .then(&point.transfer(-squared_frequency, [0.0; 3]));
    /// let beyond = line.apply(StateVector::at_base([1e3 * length, -1e3, 0.0]));
    /// assert!(beyond.forces().iter().all(|force| force.abs() < 1e-9));
    /// assert!(beyond.x > 0.0);
    /// ```
    #[must_use]
    pub fn transfer(&self, mass_factor: f64, [f_x, f_y, f_m]: [f64; 3]) -> Transfer {
        let mut transfer = Transfer::identity();
        transfer.matrix[3][2] = -self.rotary_inertia * mass_factor;
        transfer.matrix[4][0] = -self.mass * mass_factor;
        transfer.matrix[5][1] = -self.mass * mass_factor;
        transfer.load = [0.0, 0.0, 0.0, f_m, f_x, f_y];
        transfer
    }
}

/// First column line: in from the column below, out to the column above and to the beam on the right, whose left
/// end has the state `right_beam`. Returns the state above (theory, Eq. T2).
///
/// `mass` is the transfer of the joint mass; the displacements of all ends must agree, see [`apart`].
#[must_use]
pub fn one_in_two_out(mass: &Transfer, below: StateVector, right_beam: StateVector) -> StateVector {
    mass.apply(below) - right_beam.forces_only()
}

/// Inner column lines: in from the column and from the right end of the beam on the left, out to the column above
/// and to the left end of the beam on the right. Returns the state above (theory, Eq. T2).
///
/// ```
/// use jostle::transfer::{StateVector, Transfer, two_in_two_out};
/// // Without a mass, forces simply add up: 5 + 3 − 2.
/// let pushed = |qx| StateVector { x: 0.01, qx, ..StateVector::default() };
/// let above = two_in_two_out(&Transfer::identity(), pushed(5.0), pushed(3.0), pushed(2.0));
/// assert_eq!((above.x, above.qx), (0.01, 6.0));
/// ```
#[must_use]
pub fn two_in_two_out(
    mass: &Transfer,
    below: StateVector,
    left_beam: StateVector,
    right_beam: StateVector,
) -> StateVector {
    mass.apply(below) + left_beam.forces_only() - right_beam.forces_only()
}

/// Last column line and roof joints without a beam on the right: in from the column and from the right end of the
/// beam on the left. Returns the state beyond (theory, Eq. T2).
#[must_use]
pub fn two_in_one_out(mass: &Transfer, below: StateVector, left_beam: StateVector) -> StateVector {
    mass.apply(below) + left_beam.forces_only()
}

/// Difference of the displacements of two ends, H z₁ − H z₂; zero at a common joint (theory, Eq. T2).
#[must_use]
pub fn apart(first: StateVector, second: StateVector) -> [f64; 3] {
    (first - second).displacements()
}
