//! M⁻¹K, M⁻¹C and M⁻¹r of one building, by diagonals.

use super::power_series::padded;
use super::push::Push;
use crate::linear::{Row, SparseSymmetric};
use crate::structure::Equations;

/// Stiffness, damping and loads of a building per unit mass.
///
/// Matrices are stored by diagonals, from the lowest to the highest, row by row; all lists are filled up with zeros.
#[derive(Clone, Debug)]
pub(super) struct Operators {
    /// Number of degrees of freedom.
    pub(super) size: usize,
    /// Length of a diagonal and of every other list.
    length: usize,
    /// Diagonals on either side of the main one.
    pub(super) reach: usize,
    /// 1/M \[1/kg\].
    pub(super) inverse_mass: Vec<f64>,
    /// M \[kg\].
    pub(super) mass: Vec<f64>,
    /// M⁻¹r: share of the ground acceleration \[–\].
    pub(super) driven: Vec<f64>,
    /// M⁻¹(K + K′), without springs that yield \[1/s²\].
    elastic: Vec<f64>,
    /// The same with the present stiffness of the springs.
    pub(super) stiffness: Vec<f64>,
    /// M⁻¹C \[1/s\].
    pub(super) damping: Vec<f64>,
    /// α, where damping is αM alone \[1/s\].
    pub(super) uniform_damping: Option<f64>,
    /// M⁻¹C without the dashpots of springs, which change with their stiffness; empty if no spring has one \[1/s\].
    steady_damping: Vec<f64>,
    /// Dashpot of every spring over its present stiffness \[s\].
    delays: Vec<f64>,
    /// Deformations of the springs.
    pub(super) springs: Vec<Row>,
    /// Bound on the rate of the motion while no spring is stiffer than at first \[1/s\].
    pub(super) rate: f64,
}

impl Operators {
    /// Of a building whose degrees of freedom all have mass.
    pub(super) fn new(equations: &Equations) -> Self {
        let size = equations.len();
        let length = padded(size);
        let springs = equations.springs.iter().map(|spring| spring.row.clone());
        let springs: Vec<Row> = springs.collect();
        let matrices = [
            &equations.stiffness,
            &equations.undamped,
            &equations.dashpots,
        ];
        let all = matrices.into_iter().flat_map(entries);
        let across = all.map(|(row, column, _)| row.abs_diff(column));
        let across_springs = springs.iter().flat_map(|row| {
            let others = row.dofs();
            others.flat_map(|a| row.dofs().map(move |b| a.abs_diff(b)))
        });
        let reach = across.chain(across_springs).max().unwrap_or(0);
        let filled = |values: &mut dyn Iterator<Item = f64>| {
            let mut list: Vec<f64> = values.collect();
            list.resize(length, 0.0);
            list
        };
        let inverse_mass = filled(&mut equations.mass.iter().map(|mass| 1.0 / mass));
        let driven = equations.driven_mass.iter().zip(&inverse_mass);
        let blank = vec![0.0; (2 * reach + 1) * length];
        let mut built = Self {
            size,
            length,
            reach,
            driven: filled(&mut driven.map(|(driven, inverse)| driven * inverse)),
            mass: filled(&mut equations.mass.iter().copied()),
            inverse_mass,
            elastic: blank.clone(),
            stiffness: blank.clone(),
            damping: blank,
            uniform_damping: None,
            steady_damping: Vec::new(),
            delays: Vec::new(),
            springs,
            rate: 0.0,
        };
        for matrix in [&equations.stiffness, &equations.undamped] {
            for (row, column, value) in entries(matrix) {
                let place = built.place(row, column);
                built.elastic[place] += value * built.inverse_mass[row];
            }
        }
        for row in 0..size {
            let place = built.place(row, row);
            built.damping[place] += equations.alpha;
        }
        for (matrix, factor) in [
            (&equations.stiffness, equations.beta),
            (&equations.dashpots, 1.0),
        ] {
            for (row, column, value) in entries(matrix) {
                let place = built.place(row, column);
                built.damping[place] += factor * value * built.inverse_mass[row];
            }
        }
        let damped = equations.beta != 0.0 && !equations.stiffness.is_zero();
        let delays = equations.springs.iter();
        let delays = delays.map(|spring| equations.tangent_dashpot(spring, 1.0));
        if delays.clone().any(|delay| delay > 0.0) {
            built.delays = delays.collect();
            built.steady_damping.clone_from(&built.damping);
        } else if !damped && equations.dashpots.is_zero() {
            built.uniform_damping = Some(equations.alpha);
        }
        let initial = equations.springs.iter();
        built.set_tangents(initial.map(|spring| spring.hysteresis.backbone().initial()));
        built.rate = built
            .norm(&built.stiffness)
            .sqrt()
            .max(built.norm(&built.damping));
        built
    }

    #[inline]
    fn place(&self, row: usize, column: usize) -> usize {
        (self.reach + column - row) * self.length + row
    }

    /// Greatest sum of magnitudes of a row, which bounds every eigenvalue (S. Gershgorin, 1931).
    fn norm(&self, diagonals: &[f64]) -> f64 {
        let row_sum = |row: usize| -> f64 {
            let of_row = diagonals.iter().skip(row).step_by(self.length);
            of_row.map(|value| value.abs()).sum()
        };
        (0..self.size).map(row_sum).fold(0.0, f64::max)
    }

    /// Sets the stiffness of the springs \[N/m\], and what damping follows it.
    pub(super) fn set_tangents(&mut self, tangents: impl Iterator<Item = f64>) {
        self.stiffness.copy_from_slice(&self.elastic);
        self.damping[..self.steady_damping.len()].copy_from_slice(&self.steady_damping);
        for (spring, tangent) in tangents.enumerate() {
            let delay = self.delays.get(spring).copied().unwrap_or(0.0);
            let dashpot = delay * tangent.max(0.0);
            let entries = self.springs[spring].entries();
            for &(row, share) in entries {
                for &(column, other) in entries {
                    let place = self.place(row, column);
                    let by = share * other * self.inverse_mass[row];
                    self.stiffness[place] += by * tangent;
                    self.damping[place] += by * dashpot;
                }
            }
        }
    }

    /// M⁻¹ times the force of a spring on the building, added to accelerations.
    #[inline]
    pub(super) fn pull(&self, spring: usize, force: f64, acceleration: &mut [f64]) {
        for &(dof, share) in self.springs[spring].entries() {
            acceleration[dof] -= share * force * self.inverse_mass[dof];
        }
    }

    /// Accelerations for displacements and velocities, with forces of the springs and pushes at a time of the step.
    pub(super) fn accelerations(
        &self,
        [u, v]: [&[f64]; 2],
        ground: f64,
        spring_forces: impl Iterator<Item = f64>,
        pushes: &[Push],
        time: f64,
        accelerations: &mut [f64],
    ) {
        for (a, driven) in accelerations.iter_mut().zip(&self.driven) {
            *a = -driven * ground;
        }
        self.damp(v, accelerations);
        self.resist_elastically(u, accelerations);
        for (spring, force) in spring_forces.enumerate() {
            self.pull(spring, force, accelerations);
        }
        for push in pushes {
            let [force, _] = push.at(time);
            for &(dof, share) in push.row.entries() {
                accelerations[dof] += share * force * self.inverse_mass[dof];
            }
        }
    }

    /// Whether damping follows the stiffness of springs.
    pub(super) fn damping_changes(&self) -> bool {
        !self.delays.is_empty()
    }

    /// Adds −M⁻¹(K + K′) x, without springs that yield.
    pub(super) fn resist_elastically(&self, x: &[f64], sum: &mut [f64]) {
        self.subtract_product(&self.elastic, x, sum);
    }

    /// Adds −M⁻¹K x with the present stiffness of the springs.
    pub(super) fn resist(&self, x: &[f64], sum: &mut [f64]) {
        self.subtract_product(&self.stiffness, x, sum);
    }

    /// Adds −M⁻¹C x.
    #[inline(always)]
    pub(super) fn damp(&self, x: &[f64], sum: &mut [f64]) {
        if let Some(alpha) = self.uniform_damping {
            for (sum, x) in sum.iter_mut().zip(x) {
                *sum -= alpha * x;
            }
        } else {
            self.subtract_product(&self.damping, x, sum);
        }
    }

    #[inline(always)]
    fn subtract_product(&self, diagonals: &[f64], x: &[f64], sum: &mut [f64]) {
        let (n, reach) = (self.size, self.reach);
        for (number, diagonal) in diagonals.chunks_exact(self.length).enumerate() {
            // Row i meets column i + number − reach.
            let skipped = reach.saturating_sub(number).min(n);
            let ahead = number.saturating_sub(reach).min(n);
            let rows = sum[skipped..n].iter_mut().zip(&diagonal[skipped..n]);
            for ((sum, value), x) in rows.zip(&x[ahead..n]) {
                *sum -= value * x;
            }
        }
    }
}

/// Both triangles of a matrix.
fn entries(matrix: &SparseSymmetric) -> impl Iterator<Item = (usize, usize, f64)> + '_ {
    let diagonal = matrix.diagonal.iter().enumerate();
    let diagonal = diagonal.map(|(dof, value)| (dof, dof, *value));
    let below = (0..matrix.diagonal.len()).flat_map(move |column| {
        let places = matrix.starts[column]..matrix.starts[column + 1];
        places.flat_map(move |place| {
            let (row, value) = (matrix.rows[place] as usize, matrix.values[place]);
            [(row, column, value), (column, row, value)]
        })
    });
    diagonal.chain(below).filter(|(_, _, value)| *value != 0.0)
}
