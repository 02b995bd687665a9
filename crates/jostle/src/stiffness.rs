//! Direct stiffness, an independent check. Assembled from element matrices and factorised by a general sparse
//! elimination with its own ordering; it shares no elimination with the Riccati recursion.

use crate::linear::sparse_cholesky::{NoPivot, Pattern, SparseFactor};
use crate::linear::{NotPositive, StepMatrix};
use crate::structure::AssembledBuilding;
use crate::structure::StepEquations;
use crate::structure::element::{self, Part};

/// Element entries of the step matrix of one building.
#[derive(Clone, Debug)]
pub struct DirectStiffness {
    stiffness: Vec<(Part, f64)>,
    mass: Vec<f64>,
    springs: Vec<SpringPlace>,
    /// Of the stiffnesses, the masses and the springs, in this order.
    pattern: Pattern,
}

/// A factorised step matrix.
#[derive(Clone, Debug, Default)]
pub struct DirectFactor(SparseFactor);

impl StepEquations for DirectStiffness {
    type Factor = DirectFactor;
    type Scratch = ();

    fn new(building: &AssembledBuilding) -> Self {
        let equations = &building.equations;
        let entries = element::stiffnesses(&building.discretization.stick_model)
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
        let springs: Vec<_> = springs.map(|spring| (spring.dofs, spring.levers)).collect();
        let of_springs = springs.iter().flat_map(|spring| spring_entries(*spring));
        places.extend(of_springs.map(|(row, column, _)| (row, column)));
        Self {
            pattern: Pattern::new(equations.len(), &places),
            stiffness,
            mass: equations.mass.clone(),
            springs,
        }
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
        let springs = springs.flat_map(|(spring, tangent)| {
            spring_entries(*spring).map(move |(_, _, sign)| sign * tangent)
        });
        self.pattern
            .factorize(members.chain(inertia).chain(springs), &mut factor.0)
            .map_err(|NoPivot(dof)| NotPositive { dof })
    }

    fn solve(&self, factor: &DirectFactor, load: &mut [f64], (): &mut ()) {
        self.pattern.solve(&factor.0, load);
    }
}

/// A spring between two degrees of freedom, and the rotations that add to its deformation, with their arms.
type SpringPlace = ([Option<usize>; 2], [Option<(usize, f64)>; 2]);

/// Rows, columns and factors of the entries of a spring, one triangle.
fn spring_entries((dofs, levers): SpringPlace) -> impl Iterator<Item = (usize, usize, f64)> {
    let own = |dof: Option<usize>| dof.map(|dof| (dof, dof, 1.0));
    let between = dofs[0].zip(dofs[1]).map(|(a, b)| (a, b, -1.0));
    let of_lever = move |lever: Option<(usize, f64)>| {
        let turning = lever.map(|(turning, arm)| (turning, turning, arm * arm));
        let beside = |dof: Option<usize>, sign: f64| {
            let (turning, arm) = lever?;
            Some((dof?, turning, sign * arm))
        };
        [turning, beside(dofs[0], 1.0), beside(dofs[1], -1.0)]
    };
    let both = levers[0].zip(levers[1]);
    let both = both.map(|((a, arm), (b, other))| (a, b, arm * other));
    [own(dofs[0]), own(dofs[1]), between]
        .into_iter()
        .chain(of_lever(levers[0]))
        .chain(of_lever(levers[1]))
        .chain([both])
        .flatten()
}
