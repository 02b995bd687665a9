//! Storey shears and overturning moments as sums of the rows of the assembled matrices.

use jostle::linear::SparseSymmetric;
use jostle::system::BuildingSystem;

/// Nodes at most this far above a floor belong to it \[m\].
const LEVEL: f64 = 1e-3;

/// What one storey bears, by degree of freedom of the building.
pub(super) struct Storey {
    /// What every displacement adds to the horizontal restoring forces above the base of the storey \[N/m, N/rad\].
    pub(super) shear: Vec<f64>,
    /// What it adds to their moment about that base, less the moment at the base of the storey above and less the
    /// shear of this storey times its height; none without nodes between the floors \[N, N·m/rad\].
    pub(super) between: Option<Vec<f64>>,
}

/// The storeys of a building, from the ground up. A horizontal force at height y adds y − y_base to the moment of every
/// storey whose base is below it.
pub(super) fn storeys(building: &BuildingSystem) -> Vec<Storey> {
    let equations = &building.equations;
    let n = equations.len();
    // Height of every horizontal degree of freedom above the base.
    let mut heights: Vec<Option<f64>> = vec![None; n];
    for (index, node) in building.discretization.stick_model.nodes.iter().enumerate() {
        if let Some(dof) = equations.horizontal(index) {
            heights[dof] = Some(node.y).filter(|y| *y > LEVEL);
        }
    }
    let mut base = 0.0;
    let mut storeys = Vec::new();
    for floor in &building.floors {
        let (mut shear, mut between) = (vec![0.0; n], vec![0.0; n]);
        let mut any = false;
        for matrix in [&equations.stiffness, &equations.undamped] {
            for_each_entry(matrix, |row, column, value| {
                let Some(height) = heights[row].filter(|y| *y > base + LEVEL) else {
                    return;
                };
                shear[column] += value;
                if height < floor.height - LEVEL {
                    between[column] -= (floor.height - height) * value;
                    any = true;
                }
            });
        }
        storeys.push(Storey {
            shear,
            between: any.then_some(between),
        });
        base = floor.height;
    }
    storeys
}

/// Both halves of a symmetric matrix.
fn for_each_entry(matrix: &SparseSymmetric, mut take: impl FnMut(usize, usize, f64)) {
    for column in 0..matrix.diagonal.len() {
        take(column, column, matrix.diagonal[column]);
        for place in matrix.starts[column]..matrix.starts[column + 1] {
            let row = matrix.rows[place] as usize;
            take(row, column, matrix.values[place]);
            take(column, row, matrix.values[place]);
        }
    }
}
