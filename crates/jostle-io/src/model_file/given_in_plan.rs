//! `kind = "given"` with a plan: floors that move along x and across and turn.

use jostle::model::MatrixEntry;
use jostle::{Damping, GivenFloor, GivenInPlan, PlanArea, PlanPoint, Tier, Tiers};

use super::given::{Port, Read, Stated, rayleigh, read_dof, read_ports, read_stated, stiffness_of};
use super::plan::{Planned, pair, read_plans};
use super::reinforced::ReinforcedInPlan;
use super::shear::DEFAULT_STOREY_HEIGHT;
use crate::files::Files;
use crate::matrices::{Matrices, Matrix};
use crate::quantity::Dimension;
use crate::reader::{Reader, View};

/// Displacements of a floor, from 0, and the point that they move, from the origin of the plan \[m\]; by default its middle.
struct PlanPort {
    dofs: [usize; 3],
    at: Option<PlanPoint>,
}

/// Reads the keys of a given building that has a plan; after a fault, harmless values are used.
pub(super) fn read(reader: &mut Reader<'_>, view: &View<'_>, files: &Files) -> Read<Planned> {
    for key in ["periods", "shapes"] {
        if let Some(field) = reader.get(view, key) {
            *reader.bad(
                &field,
                "cannot be combined with plan: modes of one direction do not turn",
            ) = Some(
                "give matrices with x, y and rotation of every floor, or leave out plan".into(),
            );
        }
    }
    let at = reader
        .get(view, "at")
        .and_then(|field| pair(reader, &field));
    let angle = reader
        .get(view, "angle")
        .and_then(|field| reader.quantity(&field, Dimension::Dimensionless));
    let read = from_matrices(reader, view, files, angle.unwrap_or(0.0));
    let (tiers, damping) = read.unwrap_or_else(|| (stand_in(), None));
    Read {
        given: Planned {
            tiers,
            at,
            reinforced: ReinforcedInPlan::default(),
        },
        damping,
    }
}

/// One floor, where nothing is known.
fn stand_in() -> Tiers {
    let plan = vec![[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0]];
    Tiers {
        floors: Tier::uniform(1.0, plan).into_iter().collect(),
        storey_heights: vec![DEFAULT_STOREY_HEIGHT],
        ..Tiers::default()
    }
}

fn from_matrices(
    reader: &mut Reader<'_>,
    view: &View<'_>,
    files: &Files,
    angle: f64,
) -> Option<(Tiers, Option<Damping>)> {
    let stated = read_stated(reader, view, files);
    let example = "add ports = { \"1\" = { dofs = [1, 2, 3], height = \"3 m\" }, … }, with the displacements along x and across and the rotation of every floor, counted from 1";
    let ports = read_ports(reader, view, example, read_port);
    let count = ports.as_ref().map(Vec::len);
    let plans = reader
        .get(view, "plan")
        .and_then(|field| read_plans(reader, &field, count?));
    let Stated {
        field,
        matrices,
        units,
    } = stated?;
    let floors = floors_of(ports?, plans?, angle);
    match assemble(&matrices?, floors, angle, units) {
        Ok(read) => Some(read),
        Err(problem) => {
            reader.bad(&field, format!("the matrices: {problem}"));
            None
        }
    }
}

fn read_port(reader: &mut Reader<'_>, view: &View<'_>) -> Option<PlanPort> {
    const REMEDY: &str = "add dofs = [1, 2, 3], the rows of its displacements along x and across and of its rotation in the matrices, counted from 1";
    if let Some(field) = reader.get(view, "dof") {
        *reader.bad(
            &field,
            "is that of a building without a plan; with one, a floor has three displacements",
        ) = Some(REMEDY.into());
        return None;
    }
    let Some(field) = reader.get(view, "dofs") else {
        reader.missing(view, "dofs", REMEDY);
        return None;
    };
    let entries = field.entries().unwrap_or_default();
    let [x, y, rotation] = &entries[..] else {
        let found = match entries.len() {
            0 => field.node.describe().to_string(),
            count => format!("{count} numbers"),
        };
        *reader.bad(&field, format!("must be three numbers, found {found}")) = Some(REMEDY.into());
        return None;
    };
    let dofs = [x, y, rotation].map(|entry| read_dof(reader, entry));
    let at = match reader.get(view, "at") {
        Some(field) => Some(pair(reader, &field)?),
        None => None,
    };
    let [Some(x), Some(y), Some(rotation)] = dofs else {
        return None;
    };
    if x == y || y == rotation || x == rotation {
        *reader.bad(&field, "names a displacement twice") =
            Some("give three different rows: along x, across, and the rotation".into());
        return None;
    }
    Some(PlanPort {
        dofs: [x, y, rotation],
        at,
    })
}

/// Floors on the site, turned with the building.
fn floors_of(
    ports: Vec<Port<PlanPort>>,
    plans: Vec<Vec<PlanPoint>>,
    angle: f64,
) -> Vec<GivenFloor> {
    let (c, s) = (libm::cos(angle), libm::sin(angle));
    let turned = |[x, y]: PlanPoint| [c * x - s * y, s * x + c * y];
    let floors = ports.into_iter().zip(plans);
    floors
        .map(|(port, plan)| {
            let middle = || PlanArea::new(&plan).centroid;
            GivenFloor {
                dofs: port.dof.dofs,
                at: turned(port.dof.at.unwrap_or_else(middle)),
                height: port.height,
                plan: plan.into_iter().map(turned).collect(),
            }
        })
        .collect()
}

/// The building of matrices in units with these factors, of a force per length and of a length.
fn assemble(
    matrices: &Matrices,
    floors: Vec<GivenFloor>,
    angle: f64,
    [factor, length]: [f64; 2],
) -> Result<(Tiers, Option<Damping>), String> {
    for (name, found) in [("r", &matrices.influence), ("h", &matrices.heights)] {
        if found.is_some() {
            return Err(format!(
                "have {name}, which follows from the ports of a building with a plan; leave it out"
            ));
        }
    }
    let named = |name: &str, problem: String| format!("{name} {problem}");
    let stiffness = stiffness_of(matrices)?;
    let n = stiffness.rows;
    let stiffness = stiffness.lower_triangle(n).map_err(|p| named("K", p))?;
    let mass = matrices.mass.as_ref().ok_or("have no mass matrix M")?;
    let mass = mass_entries(mass, n).map_err(|p| named("M", p))?;
    let damping = match &matrices.damping {
        Some(matrix) => matrix.lower_triangle(n).map_err(|p| named("C", p))?,
        None => Vec::new(),
    };
    let rayleigh = (!damping.is_empty())
        .then(|| rayleigh(n, &mass, &stiffness, &damping))
        .flatten();
    let stated = !damping.is_empty();
    // Rows of rotations are lengths times forces.
    let mut scales = vec![1.0; n];
    for floor in &floors {
        if let Some(scale) = scales.get_mut(floor.dofs[2]) {
            *scale = length;
        }
    }
    let in_si = |mut entries: Vec<MatrixEntry>| {
        for (row, column, value) in &mut entries {
            *value *= factor * scales[*row] * scales[*column];
        }
        entries
    };
    let tiers = GivenInPlan {
        mass: in_si(mass),
        stiffness: in_si(stiffness),
        damping: match rayleigh {
            Some(_) => Vec::new(),
            None => in_si(damping),
        },
        angle,
        floors,
    }
    .tiers()?;
    let [alpha, beta] = rayleigh.unwrap_or_default();
    Ok((tiers, stated.then_some(Damping::Rayleigh { alpha, beta })))
}

/// The mass matrix, or a list of its diagonal.
fn mass_entries(mass: &Matrix, n: usize) -> Result<Vec<MatrixEntry>, String> {
    if mass.rows.min(mass.columns) > 1 || n == 1 {
        return mass.lower_triangle(n);
    }
    let diagonal = mass.diagonal(n)?;
    Ok(diagonal
        .into_iter()
        .enumerate()
        .map(|(i, m)| (i, i, m))
        .collect())
}
