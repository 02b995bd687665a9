//! Modes excited by horizontal ground motion, by Lanczos' method.

use super::{LATERAL_SHARE, Mode, modes, tridiagonal};
use crate::linear::full_matrix::{FullMatrix, PivotedLu};
use crate::linear::sort_by;
use crate::linear::{NotPositive, Row, StepMatrix};
use crate::simd::{add, dot};
use crate::structure::StepEquations;
use crate::structure::{AssembledBuilding, InnerLink};
use crate::transfer::riccati::{RiccatiFactor, RiccatiScratch, RiccatiSweep};

/// Residual, relative to the eigenvalue, below which a mode counts as found; its frequency is then exact to rounding.
const CONVERGED: f64 = 1e-11;
/// Number of vectors between evaluations of the eigenvalues.
const LOOK_EVERY: usize = 4;

/// All lateral modes of a building, longest period first.
///
/// Lanczos' method on M^½ K⁻¹ M^½ from the start M^½ r contains only modes that take part in horizontal motion. Low
/// modes converge first, and for a double frequency it finds the shape with all of the mass. Its eigenvalues come
/// with weights, the effective masses once they have converged. Before that they are bounds: by the inequalities of
/// Chebyshev, Markov and Stieltjes the modes between two neighbouring eigenvalues, these included, carry no more
/// mass than the two weights together (theory, Eq. M4). The search ends when no interval can contain a missing mode
/// with 1 %.
///
/// # Errors
/// [`NotPositive`] when the building can move without deforming.
pub fn lateral_modes(building: &AssembledBuilding) -> Result<Vec<Mode>, NotPositive> {
    lateral_modes_along(building, &RiccatiSweep::new(building))
}

/// The same with a given recursion.
pub(crate) fn lateral_modes_along(
    building: &AssembledBuilding,
    sweep: &RiccatiSweep,
) -> Result<Vec<Mode>, NotPositive> {
    excited(building, sweep, &building.equations.driven_mass)
        .map(|modes| modes.into_iter().filter(Mode::is_lateral).collect())
}

/// The first modes of sway along the row, at most `count`, longest period first: lateral ones, and those that carry less than 1 % of
/// the mass but whose kinetic energy is mostly that of motion along the row, as of the higher modes above a soft storey.
///
/// # Errors
/// [`NotPositive`] when the building can move without deforming.
pub(crate) fn sway_modes(
    building: &AssembledBuilding,
    count: usize,
) -> Result<Vec<Mode>, NotPositive> {
    let equations = &building.equations;
    let masses = equations.mass.iter().filter(|mass| **mass > 0.0).count();
    let is_sway =
        |mode: &Mode| mode.is_along() || mode.moves_mostly(equations, &equations.driven_mass);
    let mut listed = 8 * count;
    loop {
        let mut found = modes(building, listed)?;
        found.retain(is_sway);
        if found.len() >= count || listed >= masses {
            found.truncate(count);
            return Ok(found);
        }
        listed *= 2;
    }
}

/// Modes that carry at least 1 % of the mass vertically, longest period first.
///
/// # Errors
/// [`NotPositive`] when the building can move without deforming.
pub(crate) fn vertical_modes_along(
    building: &AssembledBuilding,
    sweep: &RiccatiSweep,
) -> Result<Vec<Mode>, NotPositive> {
    let is_vertical = |mode: &Mode| mode.effective_mass_ratio_y >= LATERAL_SHARE;
    excited(building, sweep, &building.equations.vertical_mass)
        .map(|modes| modes.into_iter().filter(is_vertical).collect())
}

/// Modes that carry enough of a mass M r, longest period first.
fn excited(
    building: &AssembledBuilding,
    sweep: &RiccatiSweep,
    driven_mass: &[f64],
) -> Result<Vec<Mode>, NotPositive> {
    let mut flexibility = Flexibility::along(building, sweep)?;
    let equations = &building.equations;
    let start: Vec<f64> = flexibility
        .massive
        .iter()
        .zip(&flexibility.root)
        .map(|(&dof, root)| driven_mass[dof] / root)
        .collect();
    let mut krylov = Krylov::from(start);
    let hidden = LATERAL_SHARE * equations.total_mass();
    loop {
        let exhausted = krylov.extend(&mut flexibility);
        let due = krylov.diagonal.len().is_multiple_of(LOOK_EVERY);
        if exhausted || (due && krylov.may_hide() < hidden) {
            break;
        }
    }
    let n = krylov.diagonal.len();
    let mut vectors = vec![0.0; n * n];
    for k in 0..n {
        vectors[k * n + k] = 1.0;
    }
    let values = tridiagonal::eigen(&krylov.diagonal, &krylov.next, &mut vectors);
    let mut found: Vec<usize> = (0..n)
        .filter(|&k| krylov.mass * vectors[k * n].powi(2) >= 0.5 * hidden)
        .collect();
    sort_by(&mut found, |a, b| values[*b].total_cmp(&values[*a]));
    let modes = found.into_iter().map(|k| {
        let mut shape = vec![0.0; flexibility.len()];
        let parts = &vectors[k * n..][..n];
        for (vector, part) in krylov.basis.chunks_exact(flexibility.len()).zip(parts) {
            add(&mut shape, *part, vector);
        }
        let shape = flexibility.with_massless(&shape, values[k]);
        Mode::new(building, 1.0 / values[k], shape)
    });
    Ok(modes.collect())
}

/// M^½ (K⁻¹)_mm M^½ of one building, m being the degrees of freedom with mass (theory, Eq. M1).
pub(super) struct Flexibility<'a> {
    sweep: &'a RiccatiSweep,
    factor: RiccatiFactor,
    massive: Vec<usize>,
    root: Vec<f64>,
    full: Vec<f64>,
    scratch: RiccatiScratch,
    links: LinkSprings,
}

/// Springs of links between floors: (K + R S Rᵀ)⁻¹ = K⁻¹ − K⁻¹R (S⁻¹ + Rᵀ K⁻¹R)⁻¹ Rᵀ K⁻¹ (Sherman, Morrison and Woodbury; G. H.
/// Golub, C. F. Van Loan, Matrix Computations, section 2.1.4).
#[derive(Default)]
struct LinkSprings {
    /// Columns of R.
    shortenings: Vec<Row>,
    /// Columns of K⁻¹ R.
    displaced: Vec<Vec<f64>>,
    /// S⁻¹ + Rᵀ K⁻¹ R.
    flexibility: PivotedLu,
    shortened: Vec<f64>,
    forces: Vec<f64>,
}

impl LinkSprings {
    /// `solve` replaces a load by the displacement without links.
    fn new(building: &AssembledBuilding, mut solve: impl FnMut(&mut [f64])) -> Self {
        let links = building.inner_links.iter();
        let links: Vec<&InnerLink> = links.filter(|link| link.stiffness > 0.0).collect();
        let displaced: Vec<Vec<f64>> = links
            .iter()
            .map(|link| {
                let mut load = vec![0.0; building.equations.len()];
                link.shortening.push(1.0, &mut load);
                solve(&mut load);
                load
            })
            .collect();
        let mut flexibility = FullMatrix::zeros(links.len(), links.len());
        for (row, link) in links.iter().enumerate() {
            for (column, displaced) in displaced.iter().enumerate() {
                flexibility[(row, column)] = link.shortening.value(displaced);
            }
            flexibility[(row, row)] += 1.0 / link.stiffness;
        }
        Self {
            shortened: vec![0.0; links.len()],
            forces: Vec::with_capacity(links.len()),
            shortenings: links.iter().map(|link| link.shortening.clone()).collect(),
            displaced,
            flexibility: PivotedLu::new(flexibility),
        }
    }

    /// From the displacement without links to that with them.
    fn stiffen(&mut self, displacement: &mut [f64]) {
        if self.shortened.is_empty() {
            return;
        }
        for (shortened, shortening) in self.shortened.iter_mut().zip(&self.shortenings) {
            *shortened = shortening.value(displacement);
        }
        self.flexibility
            .solve_into(&self.shortened, &mut self.forces);
        for (force, displaced) in self.forces.iter().zip(&self.displaced) {
            add(displacement, -force, displaced);
        }
    }
}

impl<'a> Flexibility<'a> {
    pub(super) fn along(
        building: &AssembledBuilding,
        sweep: &'a RiccatiSweep,
    ) -> Result<Self, NotPositive> {
        let mass = &building.equations.mass;
        let mut factor = RiccatiFactor::default();
        sweep.factorize(
            &StepMatrix::STATIC,
            &building.equations.initial_tangents(),
            &mut factor,
        )?;
        let massive: Vec<usize> = (0..mass.len()).filter(|&dof| mass[dof] > 0.0).collect();
        let mut scratch = RiccatiScratch::default();
        let links = LinkSprings::new(building, |load| {
            sweep.solve(&factor, load, &mut scratch);
        });
        Ok(Self {
            links,
            root: massive.iter().map(|&dof| mass[dof].sqrt()).collect(),
            sweep,
            factor,
            massive,
            full: vec![0.0; mass.len()],
            scratch,
        })
    }

    /// Degrees of freedom with mass.
    pub(super) fn len(&self) -> usize {
        self.massive.len()
    }

    /// K⁻¹ M^½ x, over all degrees of freedom.
    fn deflect(&mut self, x: &[f64]) -> &[f64] {
        self.full.fill(0.0);
        for ((&dof, root), value) in self.massive.iter().zip(&self.root).zip(x) {
            self.full[dof] = root * value;
        }
        self.sweep
            .solve(&self.factor, &mut self.full, &mut self.scratch);
        self.links.stiffen(&mut self.full);
        &self.full
    }

    /// Appends M^½ K⁻¹ M^½ x for the last vector x of a list of vectors.
    fn append_product(&mut self, vectors: &mut Vec<f64>) {
        let last = vectors.len() - self.len();
        self.deflect(&vectors[last..]);
        let product = self.massive.iter().zip(&self.root);
        vectors.extend(product.map(|(&dof, root)| root * self.full[dof]));
    }

    /// A column of the matrix.
    pub(super) fn column(&mut self, index: usize) -> Vec<f64> {
        let mut vectors = vec![0.0; self.len()];
        vectors[index] = 1.0;
        self.append_product(&mut vectors);
        vectors.split_off(self.len())
    }

    /// The shape φ over all degrees of freedom that belongs to the eigenvector M^½ φ: K φ = ω² M φ holds for massless
    /// ones as well.
    pub(super) fn with_massless(&mut self, vector: &[f64], value: f64) -> Vec<f64> {
        let mut shape: Vec<f64> = self.deflect(vector).iter().map(|u| u / value).collect();
        for ((&dof, root), component) in self.massive.iter().zip(&self.root).zip(vector) {
            shape[dof] = component / root;
        }
        shape
    }
}

/// Orthonormal vectors in which the flexibility is tridiagonal.
struct Krylov {
    /// The vectors, one after the other; the last one has not been used yet.
    basis: Vec<f64>,
    diagonal: Vec<f64>,
    next: Vec<f64>,
    /// rᵀM r: the mass that the weights add up to \[kg\].
    mass: f64,
}

impl Krylov {
    fn from(mut start: Vec<f64>) -> Self {
        let mass = dot(&start, &start);
        scale(&mut start, 1.0 / mass.sqrt());
        Self {
            basis: start,
            diagonal: Vec::new(),
            next: Vec::new(),
            mass,
        }
    }

    /// Uses the last vector and computes the next one; true if there is none.
    fn extend(&mut self, flexibility: &mut Flexibility<'_>) -> bool {
        let n = flexibility.len();
        let used = self.basis.len() / n.max(1);
        if n == 0 || self.mass == 0.0 {
            self.basis.clear();
            return true;
        }
        flexibility.append_product(&mut self.basis);
        let (basis, vector) = self.basis.split_at_mut(used * n);
        let size = dot(vector, vector).sqrt();
        let (before, last) = basis.split_at((used - 1) * n);
        let along = dot(last, vector);
        self.diagonal.push(along);
        // In exact arithmetic two vectors suffice; rounding requires reorthogonalisation against all.
        add(vector, -along, last);
        if let Some((previous, factor)) = before.rchunks_exact(n).next().zip(self.next.last()) {
            add(vector, -factor, previous);
        }
        for earlier in basis.chunks_exact(n) {
            let part = dot(earlier, vector);
            add(vector, -part, earlier);
        }
        let norm = dot(vector, vector).sqrt();
        if used == n || norm <= 1e-15 * size {
            self.basis.truncate(used * n);
            return true;
        }
        scale(vector, 1.0 / norm);
        self.next.push(norm);
        false
    }

    /// Greatest mass that a mode not yet found can carry \[kg\].
    fn may_hide(&self) -> f64 {
        let n = self.diagonal.len();
        // First and last entry of each eigenvector.
        let mut ends = vec![0.0; 2 * n];
        (ends[0], ends[2 * n - 1]) = (1.0, 1.0);
        let values = tridiagonal::eigen(&self.diagonal, &self.next, &mut ends);
        let mut open: Vec<(f64, f64)> = (0..n)
            .map(|k| {
                let residual = self.next[n - 1] * ends[2 * k + 1].abs();
                let found = residual <= CONVERGED * values[k];
                let weight = if found { 0.0 } else { ends[2 * k].powi(2) };
                (values[k], self.mass * weight)
            })
            .collect();
        sort_by(&mut open, |a, b| b.0.total_cmp(&a.0));
        open.push((0.0, 0.0));
        let gaps = open.windows(2).map(|pair| pair[0].1 + pair[1].1);
        gaps.fold(0.0, f64::max)
    }
}

fn scale(vector: &mut [f64], factor: f64) {
    for value in vector {
        *value *= factor;
    }
}
