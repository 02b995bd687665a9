//! A beam condensed onto the joints at its ends, in stiffness form (theory, Eq. R3).

use super::layout::{BeamLine, Layout, Link};
use crate::linear::StepMatrix;
use crate::structure::element::{Part, X};
use crate::structure::stick_elements;

/// Displacements of the two joints: x, y, θ on the left, then on the right.
const ENDS: usize = 6;

/// One beam with its hinges and lumped masses, without the masses of its joints.
#[derive(Clone, Debug)]
pub(super) struct CondensedBeam {
    /// Left node, right node, nodes in between.
    nodes: Vec<usize>,
    /// Per node and component: number of the displacement; the joints have 0 to 5. Rigid connections share it.
    number: Vec<[usize; 3]>,
    inside: usize,
    stiffness: Vec<(Part, usize, usize, f64)>,
    mass: Vec<f64>,
    keeps_length: bool,
}

/// A condensed beam for one step size.
#[derive(Clone, Debug, Default)]
pub(super) struct BeamFactor {
    /// Forces at the joints per displacement there, x, y, θ left and right.
    pub(super) stiffness: [[f64; ENDS]; ENDS],
    /// Whether the joints share one x; the stiffness in x then belongs to the left one.
    pub(super) keeps_length: bool,
    /// Cholesky factor of the inside, by rows.
    lower: Vec<f64>,
    /// K_ii⁻¹ K_ie.
    carried: Vec<[f64; ENDS]>,
}

impl CondensedBeam {
    pub(super) fn new(layout: &Layout, beam: &BeamLine) -> Self {
        let stick_model = &layout.stick_model;
        let last = beam.nodes.len() - 1;
        let mut nodes = vec![beam.nodes[0], beam.nodes[last]];
        nodes.extend(&beam.nodes[1..last]);
        let place = |node: usize, component: usize| -> Option<usize> {
            Some(3 * nodes.iter().position(|other| *other == node)? + component)
        };
        let mut root: Vec<usize> = (0..3 * nodes.len()).collect();
        let mut tie = |a: usize, b: usize, component: usize| {
            if let (Some(a), Some(b)) = (place(a, component), place(b, component)) {
                // The joints have the smallest numbers and therefore remain.
                let (kept, gone) = (root[a].min(root[b]), root[a].max(root[b]));
                root.iter_mut()
                    .filter(|root| **root == gone)
                    .for_each(|root| *root = kept);
            }
        };
        for link in &beam.links {
            match link {
                Link::Member(index) => {
                    let member = &stick_model.members[*index];
                    if member.axial_rigidity.is_none() {
                        tie(member.ends[0], member.ends[1], X);
                    }
                }
                Link::Hinge(index) => {
                    let hinge = &stick_model.hinges[*index];
                    let [horizontal, vertical] = hinge.translational_stiffness;
                    for (component, stiffness) in [horizontal, vertical, hinge.rotational_stiffness]
                        .into_iter()
                        .enumerate()
                    {
                        if stiffness.is_none() {
                            tie(hinge.ends[0], hinge.ends[1], component);
                        }
                    }
                }
                Link::Spring(_) => {}
            }
        }
        let mut numbers: Vec<usize> = root.iter().copied().filter(|root| *root >= ENDS).collect();
        numbers.sort_unstable();
        numbers.dedup();
        let number = |place: usize| {
            let root = root[place];
            numbers
                .binary_search(&root)
                .map_or(root, |index| ENDS + index)
        };
        let mut stiffness = Vec::new();
        for link in &beam.links {
            let element = match link {
                Link::Member(index) => {
                    stick_elements::of_member(&stick_model.members[*index], &stick_model.nodes)
                }
                Link::Hinge(index) => stick_elements::of_hinge(&stick_model.hinges[*index]),
                Link::Spring(index) => {
                    stick_elements::of_spring(&stick_model.springs[*index], None)
                }
            };
            for (part, a, b, value) in element.entries {
                if let (Some(a), Some(b)) = (place(a.0, a.1), place(b.0, b.1)) {
                    stiffness.push((part, number(a), number(b), value));
                }
            }
        }
        let mut mass = vec![0.0; ENDS + numbers.len()];
        for (index, &node) in nodes.iter().enumerate().skip(2) {
            let node = &stick_model.nodes[node];
            for (component, value) in node.inertia.into_iter().enumerate() {
                mass[number(3 * index + component)] += value;
            }
        }
        Self {
            number: (0..nodes.len())
                .map(|node| std::array::from_fn(|component| number(3 * node + component)))
                .collect(),
            inside: numbers.len(),
            stiffness,
            mass,
            keeps_length: root[3] == root[0],
            nodes,
        }
    }

    /// Eliminates the interior; `None` if it is a mechanism.
    pub(super) fn condense(&self, matrix: &StepMatrix) -> Option<BeamFactor> {
        let (n, all) = (self.inside, ENDS + self.inside);
        let mut full = vec![0.0; all * all];
        for &(part, row, column, value) in &self.stiffness {
            full[row * all + column] += part.weight(matrix) * value;
        }
        for (k, mass) in self.mass.iter().enumerate() {
            full[k * all + k] += matrix.mass * mass;
        }
        let mut factor = BeamFactor {
            keeps_length: self.keeps_length,
            lower: vec![0.0; n * n],
            ..BeamFactor::default()
        };
        for row in 0..n {
            for column in 0..=row {
                let known: f64 = (0..column)
                    .map(|k| factor.lower[row * n + k] * factor.lower[column * n + k])
                    .sum();
                let rest = full[(ENDS + row) * all + ENDS + column] - known;
                if row == column {
                    if !(rest > 0.0 && rest.is_finite()) {
                        return None;
                    }
                    factor.lower[row * n + row] = rest.sqrt();
                } else {
                    factor.lower[row * n + column] = rest / factor.lower[column * n + column];
                }
            }
        }
        factor.carried = vec![[0.0; ENDS]; n];
        for end in 0..ENDS {
            let mut column: Vec<f64> = (0..n).map(|row| full[(ENDS + row) * all + end]).collect();
            factor.solve_inside(&mut column);
            for (row, value) in column.iter().enumerate() {
                factor.carried[row][end] = *value;
            }
        }
        for i in 0..ENDS {
            for k in 0..ENDS {
                let carried: f64 = (0..n)
                    .map(|p| full[i * all + ENDS + p] * factor.carried[p][k])
                    .sum();
                factor.stiffness[i][k] = full[i * all + k] - carried;
            }
        }
        Some(factor)
    }

    /// Loads of the nodes between the joints: those of the interior, and all of them condensed onto the joints.
    pub(super) fn loads(
        &self,
        factor: &BeamFactor,
        nodal: impl Fn(usize) -> [f64; 3],
    ) -> (Vec<f64>, [f64; ENDS]) {
        let (mut inside, mut ends) = (vec![0.0; self.inside], [0.0; ENDS]);
        for (index, &node) in self.nodes.iter().enumerate().skip(2) {
            for (number, load) in self.number[index].iter().zip(nodal(node)) {
                match number.checked_sub(ENDS) {
                    Some(number) => inside[number] += load,
                    None => ends[*number] += load,
                }
            }
        }
        for (carried, load) in factor.carried.iter().zip(&inside) {
            ends.iter_mut()
                .zip(carried)
                .for_each(|(end, carried)| *end -= carried * load);
        }
        (inside, ends)
    }

    /// Displacements between the joints from those of the joints and the loads in between.
    pub(super) fn recover(
        &self,
        factor: &BeamFactor,
        mut inside: Vec<f64>,
        displacements: &mut [[f64; 3]],
    ) {
        let [left, right] = [self.nodes[0], self.nodes[1]].map(|node| displacements[node]);
        let ends: [f64; ENDS] = std::array::from_fn(|k| if k < 3 { left[k] } else { right[k - 3] });
        factor.solve_inside(&mut inside);
        for (value, carried) in inside.iter_mut().zip(&factor.carried) {
            *value -= carried
                .iter()
                .zip(ends)
                .map(|(carried, end)| carried * end)
                .sum::<f64>();
        }
        for (index, &node) in self.nodes.iter().enumerate().skip(2) {
            displacements[node] = self.number[index].map(|number| match number.checked_sub(ENDS) {
                Some(number) => inside[number],
                None => ends[number],
            });
        }
    }
}

impl BeamFactor {
    fn solve_inside(&self, column: &mut [f64]) {
        let n = column.len();
        for row in 0..n {
            let known: f64 = (0..row).map(|k| self.lower[row * n + k] * column[k]).sum();
            column[row] = (column[row] - known) / self.lower[row * n + row];
        }
        for row in (0..n).rev() {
            let known: f64 = (row + 1..n)
                .map(|k| self.lower[k * n + row] * column[k])
                .sum();
            column[row] = (column[row] - known) / self.lower[row * n + row];
        }
    }
}
