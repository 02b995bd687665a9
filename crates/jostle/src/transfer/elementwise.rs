//! The Riccati transfer matrix method as published: **a** = S **b** + **ε**, element by element from the base up
//! (G. C. Horner, W. D. Pilkey 1978, J. Mech. Design 100).
//!
//! The cut goes through all column lines: **a** and **b** hold the displacements and forces of each of them. An
//! element of one line changes the rows of that line (theory, Eq. R2). At a floor the beams branch off. They are
//! condensed beforehand, in stiffness form, onto the joints at their ends, because a product of their transfer
//! matrices would lose digits again. An axially rigid beam ties two joints; its axial force is an additional
//! unknown of the floor.
//!
//! Slower than [`crate::RiccatiSweep`] and used as its check: S is a flexibility, so the two eliminate in opposite
//! senses and share only the elements.

use super::condensed_beam::{BeamFactor, CondensedBeam};
use super::layout::{Layout, Link, NotAFrame};
use super::{Heading, Transfer};
use crate::linear::full_matrix::{FullMatrix, PivotedLu};
use crate::linear::sort_by;
use crate::linear::{NotPositive, StepMatrix};
use crate::structure::AssembledBuilding;
use crate::structure::StepEquations;

/// Index of the force conjugate to the displacements x, y, θ, among m, qx, qy.
const FORCE: [usize; 3] = [1, 2, 0];

/// Heights closer than this belong to one floor \[m\].
const SAME_LEVEL: f64 = 1e-6;

/// The recursion in flexibility form through one building.
#[derive(Clone, Debug)]
pub struct ElementwiseRiccati {
    layout: Result<Layout, NotAFrame>,
    order: usize,
    passes: Vec<Pass>,
    beams: Vec<CondensedBeam>,
}

/// One move of the cut.
#[derive(Clone, Debug)]
enum Pass {
    /// Up a link of a column line.
    Link { column: usize, link: Link },
    /// Past the lumped mass of a node.
    Mass { column: usize, node: usize },
    /// Past the beams of a floor.
    Floor { beams: Vec<usize> },
}

/// Data stored for every move of the cut.
#[derive(Clone, Debug, Default)]
pub struct ElementwiseFactor {
    passes: Vec<Kept>,
    beams: Vec<BeamFactor>,
}

#[derive(Clone, Debug)]
enum Kept {
    Element(Box<KeptElement>),
    Floor(Box<KeptFloor>),
}

/// b_j = Δ⁻¹ (b_j′ − U_ba S_jo b_o) + t, with o all other column lines.
#[derive(Clone, Debug)]
struct KeptElement {
    column: usize,
    /// The node whose displacements are those of the cut.
    node: Option<usize>,
    element: Transfer,
    inverse: [[f64; 3]; 3],
    /// Rows of S of this column line, before the pass.
    rows: Vec<[f64; 3]>,
    /// ∂a′/∂b_j: columns of S of this column line, its own rows replaced by U_aa S_jj + U_ab.
    spread: Vec<[f64; 3]>,
}

/// \[Δ P; G S 0\] \[b; λ\] = \[b′ + K_f ε − r; −G ε\].
#[derive(Clone, Debug)]
struct KeptFloor {
    beams: Vec<usize>,
    /// Beams that tie their joints, with the scale of their equations.
    ties: Vec<(usize, f64)>,
    solver: PivotedLu,
    flexibility: FullMatrix,
    stiffness: FullMatrix,
}

impl StepEquations for ElementwiseRiccati {
    type Factor = ElementwiseFactor;
    type Scratch = ();

    fn new(building: &AssembledBuilding) -> Self {
        let layout = Layout::new(building);
        let (mut passes, mut beams) = (Vec::new(), Vec::new());
        if let Ok(layout) = &layout {
            passes = moves(layout);
            beams = layout
                .beams
                .iter()
                .map(|beam| CondensedBeam::new(layout, beam))
                .collect();
        }
        Self {
            layout,
            order: building.equations.len(),
            passes,
            beams,
        }
    }

    /// Fails for a building that is not a frame, or if a beam is a mechanism.
    fn factorize(
        &self,
        matrix: &StepMatrix,
        _tangents: &[f64],
        factor: &mut ElementwiseFactor,
    ) -> Result<(), NotPositive> {
        let Ok(layout) = &self.layout else {
            return Err(NotPositive { dof: 0 });
        };
        factor.beams.clear();
        for beam in &self.beams {
            let condensed = beam.condense(matrix);
            factor.beams.push(condensed.ok_or(NotPositive { dof: 0 })?);
        }
        factor.passes.clear();
        let size = 3 * layout.columns.len();
        let mut s = FullMatrix::zeros(size, size);
        for pass in &self.passes {
            let kept = match pass {
                Pass::Link { column, link } => {
                    let element = layout.transfer(*link, Heading::Up, matrix);
                    Kept::Element(Box::new(KeptElement::pass(*column, None, element, &mut s)))
                }
                Pass::Mass { column, node } => {
                    let element = layout.mass(*node, matrix.mass);
                    Kept::Element(Box::new(KeptElement::pass(
                        *column,
                        Some(*node),
                        element,
                        &mut s,
                    )))
                }
                Pass::Floor { beams } => Kept::Floor(Box::new(KeptFloor::pass(
                    layout,
                    beams,
                    &factor.beams,
                    &mut s,
                ))),
            };
            factor.passes.push(kept);
        }
        Ok(())
    }

    /// Allocates memory; not optimised.
    fn solve(&self, factor: &ElementwiseFactor, load: &mut [f64], (): &mut ()) {
        let load = &mut load[..self.order];
        let Ok(layout) = &self.layout else {
            load.fill(f64::NAN);
            return;
        };
        let nodal = |node: usize| -> [f64; 3] {
            layout.carried[node].map(|dof| dof.map_or(0.0, |dof| load[dof]))
        };
        // Loads of beams: on their interiors, and condensed onto their joints.
        let inside: Vec<(Vec<f64>, [f64; 6])> = self
            .beams
            .iter()
            .zip(&factor.beams)
            .map(|(beam, condensed)| beam.loads(condensed, nodal))
            .collect();
        // Up: ε, and the contribution of every move to b.
        let size = 3 * layout.columns.len();
        let mut epsilon = vec![0.0; size];
        let mut kept = Vec::with_capacity(factor.passes.len());
        for pass in &factor.passes {
            kept.push(match pass {
                Kept::Element(element) => {
                    let before = std::array::from_fn(|k| epsilon[3 * element.column + k]);
                    let load = element.node.map_or([0.0; 3], nodal);
                    (before, element.lift(&mut epsilon, load))
                }
                Kept::Floor(floor) => ([0.0; 3], floor.lift(layout, &inside, &mut epsilon)),
            });
        }
        // Down from the free heads: b = 0.
        let mut b = vec![0.0; size];
        let mut displacements = vec![[0.0; 3]; layout.carried.len()];
        for (pass, (epsilon, constant)) in factor.passes.iter().zip(&kept).rev() {
            match pass {
                Kept::Element(element) => {
                    element.lower(&mut b, constant);
                    if let Some(node) = element.node {
                        let from_forces = element.behind(&b, size);
                        displacements[node] = std::array::from_fn(|k| from_forces[k] + epsilon[k]);
                    }
                }
                Kept::Floor(floor) => floor.lower(&mut b, constant),
            }
        }
        for ((beam, condensed), (inner, _)) in self.beams.iter().zip(&factor.beams).zip(inside) {
            beam.recover(condensed, inner, &mut displacements);
        }
        for (carried, displacement) in layout.carried.iter().zip(&displacements) {
            for (dof, value) in carried.iter().zip(displacement) {
                if let Some(dof) = dof {
                    load[*dof] = *value;
                }
            }
        }
    }
}

/// Links and masses from the lowest up; the beams of a floor once all its joints are passed.
fn moves(layout: &Layout) -> Vec<Pass> {
    let mut places: Vec<(f64, usize, usize)> = Vec::new();
    for (column, line) in layout.columns.iter().enumerate() {
        for place in 1..line.nodes.len() {
            places.push((layout.height(line.nodes[place]), column, place));
        }
    }
    sort_by(&mut places, |a, b| a.0.total_cmp(&b.0).then(a.1.cmp(&b.1)));
    let mut passes = Vec::new();
    for (index, &(height, column, place)) in places.iter().enumerate() {
        let line = &layout.columns[column];
        passes.push(Pass::Link {
            column,
            link: line.links[place - 1],
        });
        passes.push(Pass::Mass {
            column,
            node: line.nodes[place],
        });
        let level = |other: f64| (other - height).abs() <= SAME_LEVEL;
        if places.get(index + 1).is_some_and(|next| level(next.0)) {
            continue;
        }
        let beams: Vec<usize> = (0..layout.beams.len())
            .filter(|&beam| level(layout.height(layout.beams[beam].nodes[0])))
            .collect();
        if !beams.is_empty() {
            passes.push(Pass::Floor { beams });
        }
    }
    passes
}

impl KeptElement {
    /// Passes an element of one column line (theory, Eq. R2).
    fn pass(column: usize, node: Option<usize>, element: Transfer, s: &mut FullMatrix) -> Self {
        let (size, first) = (s.rows(), 3 * column);
        let u = &element.matrix;
        let rows: Vec<[f64; 3]> = (0..size)
            .map(|k| std::array::from_fn(|i| s[(first + i, k)]))
            .collect();
        // U_aa S_j and U_ba S_j, column by column.
        let through = |block: usize, k: usize, i: usize| -> f64 {
            (0..3).map(|p| u[block + i][p] * rows[k][p]).sum()
        };
        let mut delta = [[0.0; 3]; 3];
        for (i, row) in delta.iter_mut().enumerate() {
            for (k, value) in row.iter_mut().enumerate() {
                *value = through(3, first + k, i) + u[3 + i][3 + k];
            }
        }
        let inverse = inverse(&delta);
        let spread: Vec<[f64; 3]> = (0..size)
            .map(|row| {
                std::array::from_fn(|k| {
                    if (first..first + 3).contains(&row) {
                        through(0, first + k, row - first) + u[row - first][3 + k]
                    } else {
                        s[(row, first + k)]
                    }
                })
            })
            .collect();
        let spread_inverse: Vec<[f64; 3]> = spread
            .iter()
            .map(|row| std::array::from_fn(|k| (0..3).map(|p| row[p] * inverse[p][k]).sum()))
            .collect();
        for k in 0..size {
            let is_own = (first..first + 3).contains(&k);
            let pushed: [f64; 3] = std::array::from_fn(|i| through(3, k, i));
            let carried: [f64; 3] = std::array::from_fn(|i| through(0, k, i));
            for row in 0..size {
                s[(row, k)] = if is_own {
                    spread_inverse[row][k - first]
                } else {
                    let before = if (first..first + 3).contains(&row) {
                        carried[row - first]
                    } else {
                        s[(row, k)]
                    };
                    before
                        - (0..3)
                            .map(|p| spread_inverse[row][p] * pushed[p])
                            .sum::<f64>()
                };
            }
        }
        Self {
            column,
            node,
            element,
            inverse,
            rows,
            spread,
        }
    }

    /// Replaces ε behind the element by ε ahead of it; returns t.
    fn lift(&self, epsilon: &mut [f64], [f_x, f_y, f_m]: [f64; 3]) -> Vec<f64> {
        let (first, u) = (3 * self.column, &self.element.matrix);
        let behind: [f64; 3] = std::array::from_fn(|k| epsilon[first + k]);
        let force = [f_m, f_x, f_y];
        let forced: [f64; 3] = std::array::from_fn(|i| {
            force[i] + (0..3).map(|p| u[3 + i][p] * behind[p]).sum::<f64>()
        });
        let t: [f64; 3] =
            std::array::from_fn(|i| -(0..3).map(|p| self.inverse[i][p] * forced[p]).sum::<f64>());
        for i in 0..3 {
            epsilon[first + i] = (0..3).map(|p| u[i][p] * behind[p]).sum();
        }
        for (value, row) in epsilon.iter_mut().zip(&self.spread) {
            *value += (0..3).map(|p| row[p] * t[p]).sum::<f64>();
        }
        t.to_vec()
    }

    /// Replaces b ahead of the element by b behind it.
    fn lower(&self, b: &mut [f64], t: &[f64]) {
        let (first, u) = (3 * self.column, &self.element.matrix);
        // S_jo b_o
        let mut moved = [0.0; 3];
        for (k, row) in self.rows.iter().enumerate() {
            if !(first..first + 3).contains(&k) {
                (0..3).for_each(|i| moved[i] += row[i] * b[k]);
            }
        }
        let ahead: [f64; 3] = std::array::from_fn(|i| {
            b[first + i] - (0..3).map(|p| u[3 + i][p] * moved[p]).sum::<f64>()
        });
        for i in 0..3 {
            b[first + i] = t[i] + (0..3).map(|p| self.inverse[i][p] * ahead[p]).sum::<f64>();
        }
    }

    /// S_j b behind the element.
    fn behind(&self, b: &[f64], size: usize) -> [f64; 3] {
        std::array::from_fn(|i| (0..size).map(|k| self.rows[k][i] * b[k]).sum())
    }
}

impl KeptFloor {
    fn pass(
        layout: &Layout,
        beams: &[usize],
        condensed: &[BeamFactor],
        s: &mut FullMatrix,
    ) -> Self {
        let size = s.rows();
        // K_f, rows in the order of the forces.
        let mut stiffness = FullMatrix::zeros(size, size);
        for &beam in beams {
            let bay = 3 * layout.beams[beam].bay;
            for i in 0..6 {
                for k in 0..6 {
                    let row = bay + 3 * (i / 3) + FORCE[i % 3];
                    stiffness[(row, bay + k)] += condensed[beam].stiffness[i][k];
                }
            }
        }
        let stretch = |s: &FullMatrix, bay: usize, k: usize| s[(3 * bay, k)] - s[(3 * bay + 3, k)];
        let mut ties = Vec::new();
        for &beam in beams.iter().filter(|&&beam| condensed[beam].keeps_length) {
            let bay = layout.beams[beam].bay;
            let largest = (0..size).fold(0.0_f64, |most, k| most.max(stretch(s, bay, k).abs()));
            ties.push((beam, if largest > 0.0 { 1.0 / largest } else { 1.0 }));
        }
        let taken = stiffness.times(s);
        let total = size + ties.len();
        let mut matrix = FullMatrix::zeros(total, total);
        for row in 0..size {
            for k in 0..size {
                matrix[(row, k)] = f64::from(u8::from(row == k)) - taken[(row, k)];
            }
        }
        for (index, &(beam, scale)) in ties.iter().enumerate() {
            let bay = layout.beams[beam].bay;
            // λ is the force of the left joint on the beam.
            matrix[(3 * bay + FORCE[0], size + index)] = -1.0;
            matrix[(3 * bay + 3 + FORCE[0], size + index)] = 1.0;
            for k in 0..size {
                matrix[(size + index, k)] = scale * stretch(s, bay, k);
            }
        }
        let solver = PivotedLu::new(matrix);
        let mut inverse = FullMatrix::zeros(total, size);
        let mut unit = vec![0.0; total];
        for column in 0..size {
            unit[column] = 1.0;
            for (row, value) in solver.solve(&unit).into_iter().enumerate() {
                inverse[(row, column)] = value;
            }
            unit[column] = 0.0;
        }
        let next = s.times(&inverse);
        let flexibility = std::mem::replace(s, next);
        Self {
            beams: beams.to_vec(),
            ties,
            solver,
            flexibility,
            stiffness,
        }
    }

    /// Replaces ε below the floor by ε above it; returns x₀, the part of b due to loads.
    fn lift(
        &self,
        layout: &Layout,
        inside: &[(Vec<f64>, [f64; 6])],
        epsilon: &mut [f64],
    ) -> Vec<f64> {
        let size = epsilon.len();
        let mut right = vec![0.0; size + self.ties.len()];
        for row in 0..size {
            right[row] = (0..size)
                .map(|k| self.stiffness[(row, k)] * epsilon[k])
                .sum();
        }
        for &beam in &self.beams {
            let bay = 3 * layout.beams[beam].bay;
            for (i, load) in inside[beam].1.iter().enumerate() {
                right[bay + 3 * (i / 3) + FORCE[i % 3]] -= load;
            }
        }
        for (index, &(beam, scale)) in self.ties.iter().enumerate() {
            let bay = 3 * layout.beams[beam].bay;
            right[size + index] = -scale * (epsilon[bay] - epsilon[bay + 3]);
        }
        let right = self.solver.solve(&right);
        for (row, value) in epsilon.iter_mut().enumerate() {
            *value += (0..size)
                .map(|k| self.flexibility[(row, k)] * right[k])
                .sum::<f64>();
        }
        right
    }

    /// Replaces b above the floor by b below it.
    fn lower(&self, b: &mut [f64], constant: &[f64]) {
        let size = b.len();
        let mut right = b.to_vec();
        right.resize(size + self.ties.len(), 0.0);
        for (k, value) in self.solver.solve(&right)[..size].iter().enumerate() {
            b[k] = value + constant[k];
        }
    }
}

/// Inverse of a 3×3 matrix by elimination with partial pivoting.
fn inverse(matrix: &[[f64; 3]; 3]) -> [[f64; 3]; 3] {
    let mut wide: [[f64; 6]; 3] = std::array::from_fn(|row| {
        std::array::from_fn(|k| {
            if k < 3 {
                matrix[row][k]
            } else {
                f64::from(u8::from(k == row + 3))
            }
        })
    });
    for step in 0..3 {
        let mut pivot = step;
        for row in step + 1..3 {
            if wide[row][step].abs() > wide[pivot][step].abs() {
                pivot = row;
            }
        }
        wide.swap(step, pivot);
        let top = wide[step].map(|value| value / wide[step][step]);
        wide[step] = top;
        for (row, entries) in wide.iter_mut().enumerate() {
            if row != step {
                let times = entries[step];
                entries
                    .iter_mut()
                    .zip(top)
                    .for_each(|(entry, top)| *entry -= times * top);
            }
        }
    }
    wide.map(|row| [row[3], row[4], row[5]])
}
