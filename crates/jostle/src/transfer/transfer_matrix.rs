//! Transfer of a state through an element, z_O = U z_I + e (theory, section 3).

use super::StateVector;

/// Transfer of the state of a cut through an element: z_O = U z_I + e, rows and columns in the order x, y, θ, m,
/// qx, qy.
///
/// A cantilever column of one segment under a force at its tip. Base forces follow from the free tip; the tip
/// deflects by F l³/(3 EI).
///
/// ```
/// use jostle::transfer::{BeamSegment, Heading, StateVector};
/// let (force, length, rigidity) = (1e5, 3.2, 1.5625e8);
/// let column = BeamSegment::bending(length, rigidity).transfer(Heading::Up);
/// // Forces exerted by the base: −F, and the moment that balances F at the tip.
/// let tip = column.apply(StateVector::at_base([force * length, -force, 0.0]));
/// assert!(tip.m.abs() < 1e-9 && tip.qx == -force);
/// assert!((tip.x - force * length.powi(3) / (3.0 * rigidity)).abs() < 1e-15);
/// assert!((tip.theta + force * length.powi(2) / (2.0 * rigidity)).abs() < 1e-15);
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Transfer {
    /// U.
    pub matrix: [[f64; 6]; 6],
    /// e.
    pub load: [f64; 6],
}

impl Transfer {
    /// The identity.
    #[must_use]
    pub fn identity() -> Self {
        let mut matrix = [[0.0; 6]; 6];
        for (k, row) in matrix.iter_mut().enumerate() {
            row[k] = 1.0;
        }
        Self {
            matrix,
            load: [0.0; 6],
        }
    }

    /// State at the output end for a state at the input end.
    #[must_use]
    pub fn apply(&self, input: StateVector) -> StateVector {
        let z = input.to_array();
        StateVector::from_array(std::array::from_fn(|row| {
            dot(&self.matrix[row], &z) + self.load[row]
        }))
    }

    /// This element followed by the next one: U = U₂ U₁, e = U₂ e₁ + e₂.
    ///
    /// Two halves of a member make the whole:
    ///
    /// ```
    /// use jostle::transfer::{BeamSegment, Heading};
    /// let half = BeamSegment::bending(2.0, 1e7).transfer(Heading::Right);
    /// let whole = BeamSegment::bending(4.0, 1e7).transfer(Heading::Right);
    /// for (joined, direct) in half.then(&half).matrix.iter().flatten().zip(whole.matrix.iter().flatten()) {
    ///     assert!((joined - direct).abs() < 1e-12);
    /// }
    /// ```
    #[must_use]
    pub fn then(&self, next: &Self) -> Self {
        let column = |k: usize| -> [f64; 6] { std::array::from_fn(|row| self.matrix[row][k]) };
        let columns: [[f64; 6]; 6] = std::array::from_fn(column);
        Self {
            matrix: std::array::from_fn(|row| {
                std::array::from_fn(|k| dot(&next.matrix[row], &columns[k]))
            }),
            load: std::array::from_fn(|row| dot(&next.matrix[row], &self.load) + next.load[row]),
        }
    }

    /// The extended form: U and e in one 7×7 matrix that acts on (z, 1).
    #[must_use]
    pub fn extended(&self) -> [[f64; 7]; 7] {
        std::array::from_fn(|row| {
            std::array::from_fn(|column| match (row, column) {
                (6, 6) => 1.0,
                (6, _) => 0.0,
                (_, 6) => self.load[row],
                _ => self.matrix[row][column],
            })
        })
    }
}

/// Σ aₖ bₖ.
fn dot(a: &[f64; 6], b: &[f64; 6]) -> f64 {
    a.iter().zip(b).map(|(a, b)| a * b).sum()
}
