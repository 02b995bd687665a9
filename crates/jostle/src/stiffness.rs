//! Direct stiffness, an independent check. Assembled from element matrices and factorised by a general sparse
//! elimination with its own ordering; it shares no elimination with the Riccati recursion.

use crate::linear::sparse_cholesky::{NoPivot, Pattern, SparseFactor};
use crate::linear::{NotPositive, Row, StepMatrix};
use crate::structure::AssembledBuilding;
use crate::structure::StepEquations;
use crate::structure::element::Part;
use crate::structure::stick_elements;

/// Element entries of the step matrix of one building.
#[derive(Clone, Debug)]
pub struct DirectStiffness {
    stiffness: Vec<(Part, f64)>,
    mass: Vec<f64>,
    /// Rows, columns and factors of the entries of every spring, one triangle.
    springs: Vec<Vec<(usize, usize, f64)>>,
    /// Of the stiffnesses, the masses and the springs, in this order.
    pattern: Pattern,
}

/// A factorised step matrix.
#[derive(Clone, Debug, Default)]
pub struct DirectFactor(SparseFactor);

impl DirectStiffness {
    /// With more springs, such as those between floors further apart; a row is the deformation of one. Their tangents follow those of the springs of the building.
    pub(crate) fn with_rows(building: &AssembledBuilding, rows: &[Row]) -> Self {
        let equations = &building.equations;
        let entries = stick_elements::stiffnesses(&building.discretization.stick_model)
            .flat_map(|element| element.entries);
        let (mut places, mut stiffness) = (Vec::new(), Vec::new());
        for (part, a, b, value) in entries {
            if let (Some(row), Some(column)) = (equations.dof(a), equations.dof(b))
                && row >= column
            {
                places.push((row, column));
                stiffness.push((part, value));
            }
        }
        places.extend((0..equations.len()).map(|dof| (dof, dof)));
        let springs = equations.springs.iter();
        let springs = springs.map(|spring| entries_of(&spring.row));
        let springs: Vec<_> = springs.chain(rows.iter().map(entries_of)).collect();
        places.extend(
            springs
                .iter()
                .flatten()
                .map(|(row, column, _)| (*row, *column)),
        );
        Self {
            pattern: Pattern::new(equations.len(), &places),
            stiffness,
            mass: equations.mass.clone(),
            springs,
        }
    }
}

impl StepEquations for DirectStiffness {
    type Factor = DirectFactor;
    type Scratch = ();

    fn new(building: &AssembledBuilding) -> Self {
        Self::with_rows(building, &[])
    }

    fn factorize(
        &self,
        matrix: &StepMatrix,
        tangents: &[f64],
        factor: &mut DirectFactor,
    ) -> Result<(), NotPositive> {
        let members = self.stiffness.iter();
        let members = members.map(|(part, value)| part.weight(matrix) * value);
        let inertia = self.mass.iter().map(|mass| matrix.mass * mass);
        let springs = self.springs.iter().zip(tangents);
        let springs = springs.flat_map(|(entries, tangent)| {
            entries.iter().map(move |(_, _, factor)| factor * tangent)
        });
        self.pattern
            .factorize(members.chain(inertia).chain(springs), &mut factor.0)
            .map_err(|NoPivot(dof)| NotPositive { dof })
    }

    fn solve(&self, factor: &DirectFactor, load: &mut [f64], (): &mut ()) {
        self.pattern.solve(&factor.0, load);
    }
}

/// Entries of a spring of stiffness one, one triangle.
fn entries_of(row: &Row) -> Vec<(usize, usize, f64)> {
    let row = row.entries();
    let pairs = row.iter().enumerate();
    pairs
        .flat_map(|(index, (dof, share))| {
            let others = row[..=index].iter();
            others.enumerate().map(move |(before, (other, factor))| {
                // Both triangles fall together on the diagonal.
                let times = if dof == other && before != index {
                    2.0
                } else {
                    1.0
                };
                (*dof, *other, times * share * factor)
            })
        })
        .collect()
}
