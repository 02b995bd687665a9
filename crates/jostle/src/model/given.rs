//! A building described by its matrices.

use crate::linear::cholesky::Cholesky;

/// Row and column of the lower triangle of a symmetric matrix, counted from 0, row ≥ column, and the value; values given
/// several times are summed.
pub type MatrixEntry = (usize, usize, f64);

/// A building described by the matrices of M ü + C u̇ + K u = −M r a_g, as another program has them.
///
/// Displacements may be floors alone, to which a model was condensed, or all of a model, rotations and vertical
/// displacements included. The building stays elastic; its base and its gravity are what the matrices hold.
///
/// ```
/// use jostle::Given;
///
/// // Two floors of 40 t on storeys of 60 MN/m.
/// let rows = vec![vec![120e6, -60e6], vec![-60e6, 60e6]];
/// let given = Given::condensed(vec![40e3; 2], &rows, vec![3.0; 2]);
/// assert_eq!(given.floors, [0, 1]);
/// ```
#[derive(Clone, Debug, PartialEq)]
pub struct Given {
    /// M, diagonal: mass of every displacement, ≥ 0; > 0 at floors \[kg, kg·m²\].
    pub mass: Vec<f64>,
    /// K: symmetric, positive definite \[N/m, N, N·m\].
    pub stiffness: Vec<MatrixEntry>,
    /// C: symmetric; empty where [`Building::damping`](super::Building::damping) describes all damping. Both add up
    /// \[N·s/m, N·s, N·m·s\].
    pub damping: Vec<MatrixEntry>,
    /// r: every displacement if the ground moves by 1 and nothing deforms; 1 at floors, 0 for rotations and vertical
    /// displacements \[–\].
    pub influence: Vec<f64>,
    /// Height above the base of every displacement that moves with the ground, for storey shears and overturning moments;
    /// those of floors follow from `storey_heights` \[m\].
    pub heights: Vec<f64>,
    /// The displacement of every floor, from the ground up, counted from 0.
    pub floors: Vec<usize>,
    /// Storey heights from the ground up, > 0 \[m\].
    pub storey_heights: Vec<f64>,
}

impl Given {
    /// Most displacements of a building given by matrices.
    pub const MOST_DISPLACEMENTS: usize = 2000;

    /// A building whose matrices were condensed at its floors: masses from the ground up, and rows of the stiffness
    /// matrix, of which the lower triangle counts \[kg, N/m, m\].
    #[must_use]
    pub fn condensed(mass: Vec<f64>, stiffness: &[Vec<f64>], storey_heights: Vec<f64>) -> Self {
        let lower = stiffness.iter().enumerate().flat_map(|(row, values)| {
            let columns = values.iter().take(row + 1).enumerate();
            columns.map(move |(column, value)| (row, column, *value))
        });
        let floors = mass.len();
        let heights = storey_heights.iter().scan(0.0, |height, storey| {
            *height += storey;
            Some(*height)
        });
        Self {
            stiffness: lower.collect(),
            damping: Vec::new(),
            influence: vec![1.0; floors],
            heights: heights.collect(),
            floors: (0..floors).collect(),
            mass,
            storey_heights,
        }
    }

    /// The stiffness matrix of floors whose displacements under a unit force at each are known, by the rows of its lower triangle
    /// \[m/N\]: the inverse, all of its rows \[N/m\]. `None` if that matrix is not positive definite.
    ///
    /// ```
    /// // Two storeys of 60 MN/m.
    /// let rows = jostle::Given::stiffness_of(vec![vec![1.0 / 60e6], vec![1.0 / 60e6, 2.0 / 60e6]]);
    /// assert!((rows.expect("definite")[1][0] + 60e6).abs() < 1.0);
    /// ```
    #[must_use]
    pub fn stiffness_of(flexibility: Vec<Vec<f64>>) -> Option<Vec<Vec<f64>>> {
        let n = flexibility.len();
        let factor = Cholesky::new(flexibility)?;
        let unit = |row: usize| (0..n).map(|k| if k == row { 1.0 } else { 0.0 }).collect();
        let mut columns: Vec<Vec<f64>> = (0..n).map(unit).collect();
        factor.solve(&mut columns);
        let mean = |i: usize, j: usize| 0.5 * (columns[i][j] + columns[j][i]);
        Some(
            (0..n)
                .map(|i| (0..n).map(|j| mean(i, j)).collect())
                .collect(),
        )
    }

    /// Number of displacements.
    #[must_use]
    pub fn len(&self) -> usize {
        self.mass.len()
    }

    /// Whether there are none.
    #[must_use]
    pub fn is_empty(&self) -> bool {
        self.mass.is_empty()
    }

    /// Factor on every displacement with which those that move with the ground move by 1.
    pub(crate) fn scale(&self, dof: usize) -> f64 {
        match self.influence[dof] {
            0.0 => 1.0,
            share => share,
        }
    }
}
