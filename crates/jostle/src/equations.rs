//! Mass and stiffness of one building in the order of its transfer path.

use pulp::NullaryFnOnce;

use crate::element::{self, Part, X, Y};
use crate::hysteresis::Hysteresis;
use crate::lanes;
use crate::skeleton::{Skeleton, Support};
use crate::small_keys::in_order;
use crate::stretches::Stretches;
use crate::transfer::path::Path;

/// M ü + (α M + β K + C′) u̇ + (K + K′) u = −M r a_g + contact forces, for one building.
///
/// M is diagonal; massless degrees of freedom have zeros there. K, K′ and C′ are symmetric.
#[derive(Clone, Debug)]
pub struct Equations {
    /// Mass of every degree of freedom \[kg, kg·m²\].
    pub mass: Vec<f64>,
    /// M r: the mass on which horizontal ground acceleration acts \[kg\].
    pub driven_mass: Vec<f64>,
    /// M r for vertical motion; used for participation only \[kg\].
    pub vertical_mass: Vec<f64>,
    /// K: stiffness of members and joints, which takes part in stiffness-proportional damping.
    pub stiffness: SparseSymmetric,
    /// K′: stiffness without stiffness-proportional damping: P-Delta, and base springs.
    pub undamped: SparseSymmetric,
    /// C′: base dashpots.
    pub dashpots: SparseSymmetric,
    /// Springs that yield: hinges first, then storey springs, each in the order of the skeleton. They are not part of
    /// K, and stiffness-proportional damping does not act on them.
    pub springs: Vec<YieldingSpring>,
    /// Mass-proportional damping α \[1/s\].
    pub alpha: f64,
    /// Stiffness-proportional damping β \[s\].
    pub beta: f64,
    /// Whether K′ and C′ are zero.
    pub(crate) plain: bool,
    path: Path,
    base_shear: Vec<(usize, f64)>,
    total_mass: f64,
}

/// A spring between two displacements that yields.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct YieldingSpring {
    /// The deformation is the first minus the second; `None` moves with the ground.
    pub dofs: [Option<usize>; 2],
    /// Rule and backbone.
    pub hysteresis: Hysteresis,
    /// Whether its force is part of the base shear.
    pub(crate) carries_base_shear: bool,
}

impl YieldingSpring {
    /// Deformation under displacements of the building \[rad or m\].
    #[must_use]
    #[inline]
    pub fn deformation(&self, displacement: &[f64]) -> f64 {
        let at = |dof: Option<usize>| dof.map_or(0.0, |dof| displacement[dof]);
        at(self.dofs[0]) - at(self.dofs[1])
    }

    /// Adds a force conjugate to the deformation to loads of the building.
    #[inline]
    pub(crate) fn push(&self, force: f64, load: &mut [f64]) {
        if let Some(dof) = self.dofs[0] {
            load[dof] += force;
        }
        if let Some(dof) = self.dofs[1] {
            load[dof] -= force;
        }
    }
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
    /// The same entries in a layout for long loops.
    stretches: Stretches,
    laid: Vec<f64>,
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
        let mut triplets = [Vec::new(), Vec::new(), Vec::new()];
        let mut base_shear = Vec::new();
        for (part, a, b, value) in
            element::stiffnesses(skeleton).flat_map(|element| element.entries)
        {
            match (path.dof(a.0, a.1), path.dof(b.0, b.1)) {
                (Some(row), Some(column)) if row >= column => {
                    triplets[part as usize].push((row, column, value));
                }
                // Forces of the supports on the building.
                (None, Some(column)) if a.1 == X && part != Part::Dashpot => {
                    base_shear.push((column, -value));
                }
                _ => {}
            }
        }
        let [stiffness, undamped, dashpots] =
            triplets.map(|triplets| SparseSymmetric::from_triplets(n, &triplets));
        Self {
            plain: undamped.is_zero() && dashpots.is_zero(),
            mass,
            driven_mass,
            vertical_mass,
            springs: yielding_springs(skeleton, &path),
            stiffness,
            undamped,
            dashpots,
            alpha: 0.0,
            beta: 0.0,
            path,
            base_shear,
            total_mass,
        }
    }

    /// Initial stiffness of every spring that yields \[N·m/rad, N/m\].
    pub fn initial_tangents(&self) -> Vec<f64> {
        let springs = self.springs.iter();
        springs
            .map(|spring| spring.hysteresis.backbone().initial())
            .collect()
    }

    /// xᵀ (K + K′) x: twice the strain energy, P-Delta included \[J\].
    #[must_use]
    pub fn strain(&self, x: &[f64]) -> f64 {
        let strained = self.stiffness.quadratic_form(x);
        if self.plain {
            strained
        } else {
            strained + self.undamped.quadratic_form(x)
        }
    }

    /// Number of degrees of freedom.
    #[must_use]
    pub fn len(&self) -> usize {
        self.mass.len()
    }

    /// Whether there are no degrees of freedom.
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

    /// Degree of freedom of the vertical displacement of a node; `None` if it is restrained.
    #[must_use]
    pub fn vertical(&self, node: usize) -> Option<usize> {
        self.path.dof(node, Y)
    }

    /// Degree of freedom of the rotation of a node; `None` if it is restrained.
    #[must_use]
    pub fn rotation(&self, node: usize) -> Option<usize> {
        self.path.dof(node, element::THETA)
    }

    /// Mass of the nodes that are not fixed \[kg\].
    #[must_use]
    pub fn total_mass(&self) -> f64 {
        self.total_mass
    }

    /// Base shear for a displacement, without that of yielding springs, positive when the building leans to the
    /// right \[N\].
    #[must_use]
    pub fn base_shear(&self, displacement: &[f64]) -> f64 {
        self.base_shear
            .iter()
            .map(|(dof, stiffness)| stiffness * displacement[*dof])
            .sum()
    }
}

fn yielding_springs(skeleton: &Skeleton, path: &Path) -> Vec<YieldingSpring> {
    let spring = |[first, second]: [usize; 2], component: usize, hysteresis: Hysteresis| {
        let dofs = [first, second].map(|node| path.dof(node, component));
        YieldingSpring {
            dofs,
            hysteresis,
            carries_base_shear: component == X && dofs.contains(&None),
        }
    };
    let hinges = skeleton.hinges.iter().filter_map(|hinge| {
        let hysteresis = hinge.hysteresis?;
        Some(spring(hinge.ends, element::THETA, hysteresis))
    });
    // A storey is positive when its upper floor is to the right of its lower one.
    let storeys = skeleton.springs.iter().filter_map(|storey| {
        let [lower, upper] = storey.ends;
        Some(spring([upper, lower], X, storey.hysteresis?))
    });
    hinges.chain(storeys).collect()
}

/// xᵀ A x, compiled for the available registers.
struct QuadraticForm<'a> {
    matrix: &'a SparseSymmetric,
    x: &'a [f64],
}

impl NullaryFnOnce for QuadraticForm<'_> {
    type Output = f64;

    #[inline(always)]
    fn call(self) -> f64 {
        let Self { matrix, x } = self;
        let below = matrix.stretches.bilinear(&matrix.laid, x);
        lanes::weighted_square(&matrix.diagonal, x) + 2.0 * below
    }
}

/// `product` += A x, compiled for the available registers.
struct Product<'a> {
    matrix: &'a SparseSymmetric,
    x: &'a [f64],
    product: &'a mut [f64],
}

impl NullaryFnOnce for Product<'_> {
    type Output = ();

    #[inline(always)]
    fn call(self) {
        let Self { matrix, x, product } = self;
        for ((product, diagonal), x) in product.iter_mut().zip(&matrix.diagonal).zip(x) {
            *product += diagonal * x;
        }
        matrix.stretches.multiply_add(&matrix.laid, x, product);
    }
}

impl SparseSymmetric {
    /// Whether every entry is zero.
    #[must_use]
    pub fn is_zero(&self) -> bool {
        self.rows.is_empty() && self.diagonal.iter().all(|value| *value == 0.0)
    }

    /// Adds up entries of the lower triangle (row ≥ column), in a fixed order.
    fn from_triplets(n: usize, triplets: &[(usize, usize, f64)]) -> Self {
        let by_row = in_order(triplets, n, |entry| entry.0);
        let mut matrix = Self {
            diagonal: vec![0.0; n],
            starts: vec![0; n + 1],
            ..Self::default()
        };
        let mut previous = None;
        for (row, column, value) in in_order(&by_row, n, |entry| entry.1) {
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
        let mut entries = Vec::with_capacity(matrix.rows.len());
        for column in 0..n {
            for place in matrix.starts[column]..matrix.starts[column + 1] {
                entries.push((matrix.rows[place], column as u32, place as u32));
            }
        }
        matrix.stretches = Stretches::of(entries, n);
        matrix.stretches.lay_out(&matrix.values, &mut matrix.laid);
        matrix
    }

    /// xᵀ A x.
    #[must_use]
    pub fn quadratic_form(&self, x: &[f64]) -> f64 {
        lanes::in_wide_registers(x.len(), QuadraticForm { matrix: self, x })
    }

    /// `product` += A x.
    pub fn multiply_add(&self, x: &[f64], product: &mut [f64]) {
        let product = Product {
            matrix: self,
            x,
            product,
        };
        lanes::in_wide_registers(x.len(), product);
    }
}
