//! Symmetric matrices over the displacements of floors in plan, as springs and dashpots between them.

use super::element::{Element, Part, Place, THETA, X, Y};
use super::tiers::motion_at;
use crate::model::{LumpedFloor, TierStorey};

/// Displacements of a floor.
const COMPONENTS: [usize; 3] = [X, Y, THETA];

/// Matrices to which an entry may belong.
const PARTS: [Part; 3] = [Part::Elastic, Part::Undamped, Part::Dashpot];

/// A symmetric matrix over three displacements of every floor, in parts; block tridiagonal without a space frame or given matrices.
pub(super) struct PlanMatrix {
    rows: Vec<Vec<[f64; 3]>>,
}

impl PlanMatrix {
    pub(super) fn new(order: usize) -> Self {
        Self {
            rows: (0..order).map(|row| vec![[0.0; 3]; row + 1]).collect(),
        }
    }

    /// Adds Bᵀ diag(k) B of a storey.
    pub(super) fn add_storey(
        &mut self,
        floors: &[LumpedFloor],
        index: usize,
        storey: &TierStorey,
        part: Part,
    ) {
        let upper = motion_at(storey.centre, floors[index].tier.centre);
        let mut places: Vec<(usize, [f64; 3])> = Vec::with_capacity(6);
        if index > 0 {
            let lower = motion_at(storey.centre, floors[index - 1].tier.centre);
            places.extend((0..3).map(|c| (3 * (index - 1) + c, [0, 1, 2].map(|r| -lower[r][c]))));
        }
        places.extend((0..3).map(|c| (3 * index + c, [0, 1, 2].map(|r| upper[r][c]))));
        for (i, (row, a)) in places.iter().enumerate() {
            for (column, b) in &places[..=i] {
                let value: f64 = (0..3).map(|r| storey.stiffness[r] * a[r] * b[r]).sum();
                self.rows[*row][*column][part as usize] += value;
            }
        }
    }

    /// Adds a lower triangle over all displacements.
    pub(super) fn add_triangle(&mut self, triangle: &[Vec<f64>], part: Part) {
        for (row, triangle) in self.rows.iter_mut().zip(triangle) {
            for (entry, value) in row.iter_mut().zip(triangle) {
                entry[part as usize] += value;
            }
        }
    }

    /// Adds Bᵀ A B, with the lower triangle of A over the motions of floors relative to what they stand on. That is the first of all that
    /// moves, if it is a mat, or else the ground, which leaves A. Nothing if A is empty.
    pub(super) fn add_above(
        &mut self,
        triangle: &[Vec<f64>],
        mat: Option<&LumpedFloor>,
        floors: &[LumpedFloor],
        part: Part,
    ) {
        let Some(mat) = mat.filter(|_| !triangle.is_empty()) else {
            return self.add_triangle(triangle, part);
        };
        let at = |row: usize, column: usize| triangle[row.max(column)][row.min(column)];
        let n = triangle.len();
        // A R, R being how a mat that turns moves the floors above.
        let carried = |row: usize, component: usize| -> f64 {
            let of_floor = floors.iter().enumerate().map(|(index, floor)| {
                let moved = motion_at(floor.tier.centre, mat.tier.centre);
                let products = (0..3).map(|r| at(row, 3 * index + r) * moved[r][component]);
                products.sum::<f64>()
            });
            of_floor.sum()
        };
        let taken: Vec<[f64; 3]> = (0..n)
            .map(|row| [0, 1, 2].map(|c| carried(row, c)))
            .collect();
        for component in 0..3 {
            for other in 0..=component {
                let terms = floors.iter().enumerate().map(|(index, floor)| {
                    let moved = motion_at(floor.tier.centre, mat.tier.centre);
                    let products =
                        (0..3).map(|r| moved[r][component] * taken[3 * index + r][other]);
                    products.sum::<f64>()
                });
                self.rows[component][other][part as usize] += terms.sum::<f64>();
            }
        }
        for (row, triangle) in triangle.iter().enumerate() {
            for (component, value) in taken[row].iter().enumerate() {
                self.rows[3 + row][component][part as usize] -= value;
            }
            for (column, value) in triangle.iter().enumerate() {
                self.rows[3 + row][3 + column][part as usize] += value;
            }
        }
    }

    /// As springs and dashpots between displacements, and between displacements and the ground.
    pub(super) fn elements(&self, ground: usize, floors: &[usize]) -> Vec<Element> {
        let place = |at: usize| (floors[at / 3], COMPONENTS[at % 3]);
        let mut list = Vec::new();
        let mut add = |ends: [Place; 2], values: [f64; 3]| {
            let values = PARTS.into_iter().zip(values);
            let values = values.filter(|(_, value)| *value != 0.0);
            list.extend(values.map(|(part, value)| Element::between(ends, part, value)));
        };
        let mut sums = vec![[0.0; 3]; self.rows.len()];
        for (row, values) in self.rows.iter().enumerate() {
            for (column, value) in values.iter().enumerate() {
                for part in 0..3 {
                    sums[row][part] += value[part];
                    if row != column {
                        sums[column][part] += value[part];
                    }
                }
                if row != column {
                    add([place(row), place(column)], value.map(|v| -v));
                }
            }
        }
        for (at, sum) in sums.into_iter().enumerate() {
            add([(ground, X), place(at)], sum);
        }
        list
    }
}
