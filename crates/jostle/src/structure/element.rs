//! Stiffness of the massless elements between lumped masses, in global axes.

use super::stick_model::StickModel;
use crate::linear::{Row, StepMatrix};

/// Displacement of a node: horizontal, vertical, rotation.
pub(crate) const X: usize = 0;
pub(crate) const Y: usize = 1;
pub(crate) const THETA: usize = 2;

/// Node, and displacement component there.
pub(crate) type Place = (usize, usize);

/// Index of a displacement in rows over the displacements of nodes.
pub(crate) fn index_of((node, component): Place) -> usize {
    3 * node + component
}

/// Displacement of an index in these rows.
pub(crate) fn place_of(index: usize) -> Place {
    (index / 3, index % 3)
}

/// Displacements of nodes with their shares, as a row over these displacements.
pub(crate) fn over_nodes(entries: impl IntoIterator<Item = (Place, f64)>) -> Row {
    let entries = entries.into_iter();
    entries
        .map(|(place, share)| (index_of(place), share))
        .collect()
}

/// Displacements of nodes in such a row, with their shares.
pub(crate) fn places(row: &Row) -> impl Iterator<Item = (Place, f64)> + Clone {
    row.entries()
        .iter()
        .map(|(index, share)| (place_of(*index), *share))
}

/// The matrix of a building that an entry belongs to.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Part {
    /// K: stiffness that takes part in stiffness-proportional damping.
    Elastic,
    /// K′: stiffness that does not: P-Delta, and the springs of a base.
    Undamped,
    /// C′: separate dashpots.
    Dashpot,
}

impl Part {
    /// Weight of this part in a step matrix.
    pub(crate) fn weight(self, matrix: &StepMatrix) -> f64 {
        match self {
            Self::Elastic => matrix.stiffness,
            Self::Undamped => 1.0,
            Self::Dashpot => matrix.dashpots,
        }
    }
}

/// A massless element over displacements of nodes, 3 × node + (0 horizontal, 1 vertical, 2 rotation). Its stiffness may be
/// negative.
#[derive(Clone, Debug, PartialEq)]
pub enum Element {
    /// A spring or a dashpot between any points, in any direction.
    Spring {
        /// The matrix to which it belongs.
        part: Part,
        /// Force per deformation \[N/m, N·m/rad; times s for dashpots\].
        stiffness: f64,
        /// Its deformation.
        row: Row,
    },
    /// Several deformations that act on each other, such as the ends of a beam.
    Matrix {
        /// The matrix to which it belongs.
        part: Part,
        /// Its deformations.
        rows: Vec<Row>,
        /// Forces per deformation, symmetric: lower triangle, row by row \[N/m, N, N·m/rad; times s for dashpots\].
        lower: Vec<f64>,
    },
}

impl Element {
    /// A spring or a dashpot that the difference of two displacements stretches.
    pub(crate) fn between([a, b]: [Place; 2], part: Part, stiffness: f64) -> Self {
        Self::Spring {
            part,
            stiffness,
            row: over_nodes([(a, 1.0), (b, -1.0)]),
        }
    }

    /// The same element in a list of nodes with as many displacements before.
    pub(crate) fn moved_up(self, before: usize) -> Self {
        match self {
            Self::Spring {
                part,
                stiffness,
                row,
            } => Self::Spring {
                part,
                stiffness,
                row: row.moved_up(before),
            },
            Self::Matrix { part, rows, lower } => Self::Matrix {
                part,
                rows: rows.iter().map(|row| row.moved_up(before)).collect(),
                lower,
            },
        }
    }

    /// Its deformations.
    pub(crate) fn deformations(&self) -> &[Row] {
        match self {
            Self::Spring { row, .. } => std::slice::from_ref(row),
            Self::Matrix { rows, .. } => rows,
        }
    }

    /// Force of a deformation per another.
    pub(crate) fn entry(&self, row: usize, column: usize) -> f64 {
        match self {
            Self::Spring { stiffness, .. } => *stiffness,
            Self::Matrix { lower, .. } => {
                let (row, column) = (row.max(column), row.min(column));
                lower[row * (row + 1) / 2 + column]
            }
        }
    }
}

/// Symmetric matrix of an element between displacements of its ends.
#[derive(Clone, Debug, Default)]
pub(crate) struct ElementStiffness {
    /// Part, (node, component), (node, component), value \[N/m, N, N·m; times s for dashpots\]; both triangles.
    pub(crate) entries: Vec<(Part, Place, Place, f64)>,
    /// Whether it is the soil under a foundation.
    pub(crate) is_soil: bool,
}

impl ElementStiffness {
    /// Replaces displacements by those to which they are tied.
    pub(super) fn tie(&mut self, stick_model: &StickModel) {
        let entries = std::mem::take(&mut self.entries);
        for (part, a, b, value) in entries {
            for (a, of_a) in places(&stick_model.carried(a)) {
                for (b, of_b) in places(&stick_model.carried(b)) {
                    let value = value * of_a * of_b;
                    if value != 0.0 {
                        self.entries.push((part, a, b, value));
                    }
                }
            }
        }
    }

    fn add(&mut self, element: &Element) {
        match element {
            Element::Spring {
                part,
                stiffness,
                row,
            } => match *row.entries() {
                [(a, 1.0), (b, -1.0)] => {
                    self.couple(*part, place_of(a), place_of(b), *stiffness);
                }
                _ => self.combine(*part, row, row, *stiffness),
            },
            Element::Matrix { part, rows, .. } => {
                for (index, row) in rows.iter().enumerate() {
                    // Two that are coupled begin with their own: sums are rounded in this order.
                    let first = if rows.len() == 2 { index } else { 0 };
                    for other in (first..rows.len()).chain(0..first) {
                        let value = element.entry(index, other);
                        self.combine(*part, row, &rows[other], value);
                    }
                }
            }
        }
    }

    /// Forces along a row per value of another, both over displacements of nodes.
    fn combine(&mut self, part: Part, row: &Row, across: &Row, value: f64) {
        if value == 0.0 {
            return;
        }
        for (a, of_a) in places(row) {
            for (b, of_b) in places(across) {
                self.entries.push((part, a, b, value * of_a * of_b));
            }
        }
    }

    /// A spring between two displacements.
    fn couple(&mut self, part: Part, a: Place, b: Place, value: f64) {
        if value != 0.0 {
            self.entries.extend([
                (part, a, a, value),
                (part, b, b, value),
                (part, a, b, -value),
                (part, b, a, -value),
            ]);
        }
    }
}

impl FromIterator<Element> for ElementStiffness {
    fn from_iter<I: IntoIterator<Item = Element>>(elements: I) -> Self {
        let mut stiffness = Self::default();
        elements
            .into_iter()
            .for_each(|element| stiffness.add(&element));
        stiffness
    }
}

impl From<&Element> for ElementStiffness {
    fn from(element: &Element) -> Self {
        let mut stiffness = Self::default();
        stiffness.add(element);
        stiffness
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A brace at an angle between two points that move both ways: k c cᵀ with the direction c (theory of trusses).
    #[test]
    fn a_brace_at_any_angle_is_an_element() {
        let (stiffness, c, s) = (5e6, 0.8, 0.6);
        let brace = Element::Spring {
            part: Part::Elastic,
            stiffness,
            row: over_nodes([((1, X), c), ((1, Y), s), ((0, X), -c), ((0, Y), -s)]),
        };
        let moved = [[0.0, 0.0], [3e-3, -1e-3]];
        let at = |(node, component): Place| moved[node][component];
        let mut forces = [[0.0; 2]; 2];
        for (part, a, b, value) in ElementStiffness::from(&brace).entries {
            assert_eq!(part, Part::Elastic);
            forces[a.0][a.1] += value * at(b);
        }
        let tension = stiffness * (c * 3e-3 - s * 1e-3);
        for (force, expected) in forces[1].into_iter().zip([c * tension, s * tension]) {
            assert!(
                (force - expected).abs() < 1e-9 * tension,
                "{force} {expected}"
            );
        }
        assert_eq!(forces[0], forces[1].map(|force| -force));
    }

    /// A spring between the ends of two arms of rigid bodies is stretched by their turns as well.
    #[test]
    fn a_spring_between_any_two_points_is_an_element() {
        let row = over_nodes([
            ((1, X), 1.0),
            ((1, THETA), -2.0),
            ((0, X), -1.0),
            ((0, THETA), 0.5),
        ]);
        let dashpot = Element::Spring {
            part: Part::Dashpot,
            stiffness: 4.0,
            row,
        };
        let turned: f64 = ElementStiffness::from(&dashpot)
            .entries
            .iter()
            .filter(|(_, a, b, _)| (*a, *b) == ((1, THETA), (0, THETA)))
            .map(|(.., value)| value)
            .sum();
        assert_eq!(turned, 4.0 * -2.0 * 0.5);
    }
}
