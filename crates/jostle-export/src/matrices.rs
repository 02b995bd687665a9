//! Buildings as the matrices of their equations, for other programs and for `kind = "given"`.

use std::fmt::Write;

use jostle::ModelFault;
use jostle::linear::SparseSymmetric;
use jostle::system::BuildingSystem;

use crate::Export;

/// Matrices of one building, row by row, and how a model file names them.
#[derive(Clone, Debug, PartialEq)]
pub struct BuildingMatrices {
    /// Name of the building.
    pub name: String,
    /// Name, sizes and numbers of every array: K, M, C, r and h, in N, m, kg and s.
    pub arrays: Vec<(&'static str, Vec<usize>, Vec<f64>)>,
    /// Its `[[building]]` in a model file; `FILE` stands for the name of the archive.
    pub block: String,
}

/// The matrices of every building.
///
/// # Errors
/// Buildings that yield, and those that start under their weight.
pub fn export(export: &Export<'_>) -> Result<Vec<BuildingMatrices>, Vec<ModelFault>> {
    let mut faults = Vec::new();
    let mut found = Vec::new();
    for (index, building) in export.system.structures().iter().enumerate() {
        let refused = [
            (
                !building.equations.springs.is_empty(),
                "hinges",
                "yields; matrices are elastic: leave out its hinges",
            ),
            (
                building.support.is_some(),
                "isolation",
                "stands on bearings, which matrices do not hold; leave it out",
            ),
            (
                building.foundation.is_some(),
                "foundation",
                "stands on soil, whose dashpots matrices do not hold; leave it out",
            ),
            (
                !building.rest.displacement.is_empty(),
                "gravity",
                "starts under its weight, which matrices do not hold: leave out gravity",
            ),
        ];
        let refused: Vec<_> = refused.into_iter().filter(|(found, ..)| *found).collect();
        faults.extend(refused.iter().map(|(_, key, problem)| ModelFault {
            path: format!("building[{index}].{key}"),
            problem: (*problem).to_owned(),
        }));
        if refused.is_empty() {
            found.push(of_building(building));
        }
    }
    if faults.is_empty() {
        Ok(found)
    } else {
        Err(faults)
    }
}

fn of_building(building: &BuildingSystem) -> BuildingMatrices {
    let equations = &building.equations;
    let n = equations.len();
    let mut stiffness = full(&equations.stiffness, n);
    let mut damping = full(&equations.dashpots, n);
    for (c, k) in damping.iter_mut().zip(&stiffness) {
        *c += equations.beta * k;
    }
    for (dof, mass) in equations.mass.iter().enumerate() {
        damping[dof * n + dof] += equations.alpha * mass;
    }
    for (k, more) in stiffness.iter_mut().zip(full(&equations.undamped, n)) {
        *k += more;
    }
    let (mut influence, mut heights) = (vec![0.0; n], vec![0.0; n]);
    for (node, place) in building.discretization.stick_model.nodes.iter().enumerate() {
        if let Some(dof) = equations.horizontal(node) {
            influence[dof] = 1.0;
            heights[dof] = place.y;
        }
    }
    let mut block = format!(
        "[[building]]\nname = {:?}\nkind = \"given\"\nmatrices = \"FILE\"\n",
        building.name
    );
    let mut arrays = vec![
        ("K", vec![n, n], stiffness),
        ("M", vec![n], equations.mass.clone()),
        ("r", vec![n], influence),
        ("h", vec![n], heights),
    ];
    // Writing to a string cannot fail.
    match building.modal_damping {
        Some(ratio) => {
            let _ = writeln!(block, "damping = {{ ratio = {ratio:?}, modes = \"all\" }}");
        }
        None => arrays.insert(2, ("C", vec![n, n], damping)),
    }
    block.push_str("\n[building.ports]\n");
    for (floor, (dof, place)) in building.floor_dofs.iter().zip(&building.floors).enumerate() {
        let _ = writeln!(
            block,
            "\"{}\" = {{ dof = {}, height = \"{} m\" }}",
            floor + 1,
            dof + 1,
            // Sums of storey heights have rounding errors.
            (place.height * 1e9).round() / 1e9
        );
    }
    BuildingMatrices {
        name: building.name.clone(),
        arrays,
        block,
    }
}

/// A symmetric matrix row by row.
fn full(matrix: &SparseSymmetric, n: usize) -> Vec<f64> {
    let mut rows = vec![0.0; n * n];
    for (dof, value) in matrix.diagonal.iter().enumerate() {
        rows[dof * n + dof] = *value;
    }
    for (column, bounds) in matrix.starts.windows(2).enumerate() {
        for place in bounds[0]..bounds[1] {
            let row = matrix.rows[place] as usize;
            rows[row * n + column] = matrix.values[place];
            rows[column * n + row] = matrix.values[place];
        }
    }
    rows
}
