//! Mass and stiffness of one building in the order of its transfer path.

use crate::element::{self, X, Y};
use crate::skeleton::{Skeleton, Support};
use crate::transfer::path::Path;

/// M ü + (α M + β K) u̇ + K u = −M r a_g + contact forces, for one building.
///
/// M is diagonal; massless degrees of freedom have zeros there. K is symmetric.
#[derive(Clone, Debug)]
pub struct Equations {
    /// Mass of every degree of freedom \[kg, kg·m²\].
    pub mass: Vec<f64>,
    /// M r: the mass that horizontal ground acceleration acts on \[kg\].
    pub driven_mass: Vec<f64>,
    /// M r for vertical motion; used for participation only \[kg\].
    pub vertical_mass: Vec<f64>,
    /// Stiffness matrix.
    pub stiffness: SparseSymmetric,
    /// Mass-proportional damping α \[1/s\].
    pub alpha: f64,
    /// Stiffness-proportional damping β \[s\].
    pub beta: f64,
    path: Path,
    base_shear: Vec<(usize, f64)>,
    total_mass: f64,
}

/// Symmetric sparse matrix: diagonal and strict lower triangle by columns, rows rising.
#[derive(Clone, Debug, Default)]
pub struct SparseSymmetric {
    /// Diagonal.
    pub diagonal: Vec<f64>,
    /// Start of every column in `rows` and `values`; one longer than the diagonal.
    pub starts: Vec<usize>,
    /// Row of every entry below the diagonal.
    pub rows: Vec<u32>,
    /// Value of every entry below the diagonal.
    pub values: Vec<f64>,
}

impl Equations {
    /// Assembles an undamped building.
    #[must_use]
    pub fn assemble(skeleton: &Skeleton) -> Self {
        let path = Path::through(skeleton);
        let n = path.len();
        let (mut mass, mut driven_mass, mut vertical_mass) =
            (vec![0.0; n], vec![0.0; n], vec![0.0; n]);
        let mut total_mass = 0.0;
        for (index, node) in skeleton.nodes.iter().enumerate() {
            for (component, value) in [node.mass, node.mass, node.rotary_inertia]
                .into_iter()
                .enumerate()
            {
                let Some(dof) = path.dof(index, component) else {
                    continue;
                };
                mass[dof] += value;
                match component {
                    X => driven_mass[dof] += value,
                    Y => vertical_mass[dof] += value,
                    _ => {}
                }
            }
            if node.support != Support::Fixed {
                total_mass += node.mass;
            }
        }
        let mut triplets = Vec::new();
        let mut base_shear = Vec::new();
        for (a, b, value) in element::stiffnesses(skeleton).flat_map(|element| element.entries) {
            match (path.dof(a.0, a.1), path.dof(b.0, b.1)) {
                (Some(row), Some(column)) if row >= column => triplets.push((row, column, value)),
                // What the displacements pull at the supports, seen from the building.
                (None, Some(column))
                    if a.1 == X && skeleton.nodes[a.0].support == Support::Fixed =>
                {
                    base_shear.push((column, -value));
                }
                _ => {}
            }
        }
        Self {
            mass,
            driven_mass,
            vertical_mass,
            stiffness: SparseSymmetric::from_triplets(n, triplets),
            alpha: 0.0,
            beta: 0.0,
            path,
            base_shear,
            total_mass,
        }
    }

    /// Number of degrees of freedom.
    #[must_use]
    pub fn len(&self) -> usize {
        self.mass.len()
    }

    /// Whether nothing can move.
    #[must_use]
    pub fn is_empty(&self) -> bool {
        self.mass.is_empty()
    }

    /// Degree of freedom of (node, component).
    pub(crate) fn dof(&self, place: element::Place) -> Option<usize> {
        self.path.dof(place.0, place.1)
    }

    /// Degree of freedom of the horizontal displacement of a node; `None` at supports.
    #[must_use]
    pub fn horizontal(&self, node: usize) -> Option<usize> {
        self.path.dof(node, X)
    }

    /// Degree of freedom of the vertical displacement of a node; `None` where it cannot rise.
    #[must_use]
    pub fn vertical(&self, node: usize) -> Option<usize> {
        self.path.dof(node, Y)
    }

    /// Degree of freedom of the rotation of a node; `None` where it cannot turn.
    #[must_use]
    pub fn rotation(&self, node: usize) -> Option<usize> {
        self.path.dof(node, element::THETA)
    }

    /// Mass of the nodes that are not fixed \[kg\].
    #[must_use]
    pub fn total_mass(&self) -> f64 {
        self.total_mass
    }

    /// Elastic base shear for a displacement, positive when the building leans to the right \[N\].
    #[must_use]
    pub fn base_shear(&self, displacement: &[f64]) -> f64 {
        self.base_shear
            .iter()
            .map(|(dof, stiffness)| stiffness * displacement[*dof])
            .sum()
    }
}

impl SparseSymmetric {
    /// Adds up entries of the lower triangle (row ≥ column), in a fixed order.
    fn from_triplets(n: usize, mut triplets: Vec<(usize, usize, f64)>) -> Self {
        triplets.sort_by_key(|&(row, column, _)| (column, row));
        let mut matrix = Self {
            diagonal: vec![0.0; n],
            starts: vec![0; n + 1],
            rows: Vec::new(),
            values: Vec::new(),
        };
        let mut previous = None;
        for (row, column, value) in triplets {
            if row == column {
                matrix.diagonal[row] += value;
            } else if previous == Some((row, column)) {
                if let Some(last) = matrix.values.last_mut() {
                    *last += value;
                }
            } else {
                matrix.rows.push(row as u32);
                matrix.values.push(value);
                matrix.starts[column + 1] += 1;
                previous = Some((row, column));
            }
        }
        for column in 0..n {
            matrix.starts[column + 1] += matrix.starts[column];
        }
        matrix
    }

    /// xᵀ A x.
    #[must_use]
    pub fn quadratic_form(&self, x: &[f64]) -> f64 {
        let mut sum = 0.0;
        for (column, (diagonal, value)) in self.diagonal.iter().zip(x).enumerate() {
            let entries = self.starts[column]..self.starts[column + 1];
            let below: f64 = self.rows[entries.clone()]
                .iter()
                .zip(&self.values[entries])
                .map(|(row, a)| a * x[*row as usize])
                .sum();
            sum += value * (diagonal * value + 2.0 * below);
        }
        sum
    }

    /// `product` += A x.
    pub fn multiply_add(&self, x: &[f64], product: &mut [f64]) {
        for column in 0..self.diagonal.len() {
            let mut sum = self.diagonal[column] * x[column];
            for entry in self.starts[column]..self.starts[column + 1] {
                let row = self.rows[entry] as usize;
                sum += self.values[entry] * x[row];
                product[row] += self.values[entry] * x[column];
            }
            product[column] += sum;
        }
    }
}
