//! Buildings as the matrices of their equations, for other programs and for `kind = "given"`.

use std::fmt::Write;

use jostle::linear::SparseSymmetric;
use jostle::system::BuildingSystem;
use jostle::{ModelFault, Structure, Tiers};

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
/// Buildings that yield, those that start under their weight, and those in plan with masses apart from the floors.
pub fn export(export: &Export<'_>) -> Result<Vec<BuildingMatrices>, Vec<ModelFault>> {
    let mut faults = Vec::new();
    let mut found = Vec::new();
    for (index, building) in export.system.structures().iter().enumerate() {
        let tiers = match &export.model.buildings[index].structure {
            Structure::Tiers(tiers) => Some(tiers),
            Structure::Frame(_) | Structure::Shear(_) | Structure::Given(_) => None,
        };
        let refused = [
            (
                tiers.is_some() && building.plan_base.is_empty() && has_masses_apart(building),
                "frame",
                "has columns with mass between floors, which matrices of floors do not hold; give the mass to the floors",
            ),
            (
                !building.equations.springs.is_empty(),
                "hinges",
                "yields or lifts off; matrices are elastic: leave out hinges, braces that yield and infill panels",
            ),
            (
                !building.plan_base.is_empty(),
                "base",
                "has springs under a plan, whose motions matrices of floors do not hold; leave it out",
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
            found.push(of_building(building, tiers));
        }
    }
    if faults.is_empty() {
        Ok(found)
    } else {
        Err(faults)
    }
}

/// Displacements along x and across and rotation of a floor in plan.
fn dofs_in_plan(building: &BuildingSystem, floor: usize) -> [usize; 3] {
    let floors = building.floors.len();
    // Tracks count from the first building.
    [0, 1, 2].map(|component| building.tracks[component * floors + floor].dof - building.offset)
}

/// Whether a building in plan has masses that are not those of a floor, or that move one way alone.
fn has_masses_apart(building: &BuildingSystem) -> bool {
    let mass = &building.equations.mass;
    let floors: Vec<[usize; 3]> = (0..building.floors.len())
        .map(|floor| dofs_in_plan(building, floor))
        .collect();
    let mut others = (0..mass.len()).filter(|dof| floors.iter().all(|floor| !floor.contains(dof)));
    others.any(|dof| mass[dof] > 0.0) || floors.iter().any(|[x, y, _]| mass[*x] != mass[*y])
}

fn of_building(building: &BuildingSystem, tiers: Option<&Tiers>) -> BuildingMatrices {
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
    ];
    match tiers {
        // Ports say it.
        Some(tiers) => block.push_str(&plans(tiers)),
        None => arrays.extend([("r", vec![n], influence), ("h", vec![n], heights)]),
    }
    // Writing to a string cannot fail.
    match building.modal_damping {
        Some(ratio) => {
            let _ = writeln!(block, "damping = {{ ratio = {ratio:?}, modes = \"all\" }}");
        }
        None => arrays.insert(2, ("C", vec![n, n], damping)),
    }
    block.push_str("\n[building.ports]\n");
    for (floor, (dof, place)) in building.floor_dofs.iter().zip(&building.floors).enumerate() {
        let dofs = match (tiers, building.discretization.centres.get(floor)) {
            (Some(_), Some(centre)) => {
                let dofs = dofs_in_plan(building, floor).map(|dof| dof + 1);
                format!("dofs = {dofs:?}, at = {}", point(centre))
            }
            _ => format!("dof = {}", dof + 1),
        };
        let _ = writeln!(
            block,
            "\"{}\" = {{ {dofs}, height = \"{} m\" }}",
            floor + 1,
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

/// A point of the site in a model file.
fn point([x, y]: &[f64; 2]) -> String {
    format!("[\"{x:?} m\", \"{y:?} m\"]")
}

/// Where a building in plan stands, and its floors.
fn plans(tiers: &Tiers) -> String {
    let plans = tiers.floors.iter().map(|floor| {
        let corners: Vec<String> = floor.plan.iter().map(point).collect();
        format!("  {{ corners = [{}] }},\n", corners.join(", "))
    });
    format!(
        "at = [\"0 m\", \"0 m\"]\nplan = [\n{}]\n",
        plans.collect::<String>()
    )
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
