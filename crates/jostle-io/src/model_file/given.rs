//! `kind = "given"`: a building by the matrices of another program.

use jostle::linear::sort_by;
use jostle::model::MatrixEntry;
use jostle::{Damping, Given};

use super::given_modes;
use super::shear::DEFAULT_STOREY_HEIGHT;
use crate::files::Files;
use crate::keys::{MATRIX_UNITS, Section};
use crate::matrices::{ARRAYS, Matrices, Matrix, read_archive, read_matrix_market};
use crate::quantity::Dimension;
use crate::reader::{Field, Reader, View};

/// Factors from the units of [`MATRIX_UNITS`] to SI: of a force per length and a mass alike, and of a length. Where lengths
/// are not metres, all displacements must be lengths.
const UNITS: [[f64; 2]; MATRIX_UNITS.len()] = [
    [1.0, 1.0],
    [1e3, 1.0],
    [1e3, 1e-3],
    [1e6, 1e-3],
    [4_448.221_615_260_5 / 0.3048, 0.3048],
    [4_448.221_615_260_5 / 0.0254, 0.0254],
];

/// A building, and its damping if its matrices say it.
pub(super) struct Read<T = Given> {
    pub(super) given: T,
    pub(super) damping: Option<Damping>,
}

/// What a file says of matrices.
pub(super) struct Stated<'n> {
    /// The field that names them.
    pub(super) field: Field<'n>,
    /// `None` after a fault.
    pub(super) matrices: Option<Matrices>,
    /// Factors from their units to SI: of a force per length and a mass alike, and of a length.
    pub(super) units: [f64; 2],
}

/// Reads the keys of a given building; after a fault, harmless values are used.
pub(super) fn read(reader: &mut Reader<'_>, view: &View<'_>, files: &Files) -> Read {
    let by_modes = view.has("periods") || view.has("shapes");
    let read = if by_modes {
        given_modes::read(reader, view).map(|given| Read {
            given,
            damping: None,
        })
    } else {
        from_matrices(reader, view, files)
    };
    read.unwrap_or_else(|| Read {
        given: Given::condensed(vec![1.0], &[vec![1.0]], vec![DEFAULT_STOREY_HEIGHT]),
        damping: None,
    })
}

fn from_matrices(reader: &mut Reader<'_>, view: &View<'_>, files: &Files) -> Option<Read> {
    for key in ["at", "angle", "isolation"] {
        if let Some(field) = reader.get(view, key) {
            *reader.bad(&field, "needs a plan") =
                Some("add plan = [\"20 m\", \"12 m\"], or corners, and dofs to the ports".into());
        }
    }
    let stated = read_stated(reader, view, files)?;
    let example = "add ports = { \"1\" = { dof = 1, height = \"3 m\" }, … }, with the displacement of every floor, counted from 1";
    let ports = read_ports(reader, view, example, read_port);
    let (matrices, ports) = (stated.matrices?, ports?);
    match assemble(&matrices, &ports, stated.units) {
        Ok(read) => Some(read),
        Err(problem) => {
            reader.bad(&stated.field, format!("the matrices: {problem}"));
            None
        }
    }
}

/// What a file says of the matrices of a building, with or without a plan.
pub(super) fn read_stated<'n>(
    reader: &mut Reader<'_>,
    view: &View<'n>,
    files: &Files,
) -> Option<Stated<'n>> {
    for key in [
        "mass",
        "remainder_period",
        "contact_flexibility",
        "contact_floor",
    ] {
        if let Some(field) = reader.get(view, key) {
            *reader.bad(&field, "belongs to a building given by its modes") =
                Some("keep either matrices and ports, or mass, periods and shapes".into());
        }
    }
    for key in ["storeys", "floors", "storey_height"] {
        if let Some(field) = reader.get(view, key) {
            *reader.bad(&field, "is not for a building given by matrices") =
                Some("leave it out; ports say how high the floors are".into());
        }
    }
    let unit = match reader.get(view, "units") {
        Some(field) => {
            let word = reader.choice(&field, MATRIX_UNITS, &[])?;
            MATRIX_UNITS.iter().position(|known| *known == word)?
        }
        None => 0,
    };
    let Some(field) = reader.get(view, "matrices") else {
        reader.missing(
            view,
            "matrices",
            "add matrices = \"model.npz\" with the arrays K and M, or the mass, periods and shapes of its modes",
        );
        return None;
    };
    let matrices = read_matrices(reader, &field, files);
    Some(Stated {
        field,
        matrices,
        units: UNITS[unit],
    })
}

/// One file for all matrices, one for each, or lists of numbers.
fn read_matrices(reader: &mut Reader<'_>, field: &Field<'_>, files: &Files) -> Option<Matrices> {
    if let Some(name) = field.as_text() {
        let found = read_archive(files, name);
        return match found {
            Ok(matrices) => Some(matrices),
            Err(problem) => {
                *reader.bad(field, format!("\"{name}\" {problem}")) = Some(
                    "paths are relative to the model file; Matrix Market files stand in a table, matrices = { stiffness = \"k.mtx\", mass = \"m.mtx\" }".into(),
                );
                None
            }
        };
    }
    let view = reader.open(field, &[Section::Matrices])?;
    let mut matrices = Matrices::default();
    let mut sound = true;
    for ([_, key], place) in ARRAYS.into_iter().zip(matrices.places()) {
        let Some(field) = reader.get(&view, key) else {
            continue;
        };
        if field.entries().is_some() {
            *place = read_lists(reader, &field);
            sound &= place.is_some();
            continue;
        }
        let Some(name) = reader.text(&field) else {
            sound = false;
            continue;
        };
        match read_matrix_market(files, &name) {
            Ok(matrix) => *place = Some(matrix),
            Err(problem) => {
                reader.bad(&field, format!("\"{name}\" {problem}"));
                sound = false;
            }
        }
    }
    sound.then_some(matrices)
}

/// A matrix as a list of rows, or a list of numbers.
fn read_lists(reader: &mut Reader<'_>, field: &Field<'_>) -> Option<Matrix> {
    let entries = field.entries()?;
    let rows: Vec<Vec<Field<'_>>> = match entries.iter().map(Field::entries).collect() {
        Some(rows) => rows,
        None => vec![entries],
    };
    let columns = rows.first().map_or(0, Vec::len);
    if columns == 0 || rows.iter().any(|row| row.len() != columns) {
        reader.bad(
            field,
            "must be a list of rows of one length, or a list of numbers",
        );
        return None;
    }
    let mut matrix = Matrix::new(rows.len(), columns);
    let mut sound = true;
    for (row, values) in rows.iter().enumerate() {
        for (column, value) in values.iter().enumerate() {
            let read = reader.quantity(value, Dimension::Dimensionless);
            sound &= read.is_some_and(|value| matrix.add(row, column, value).is_ok());
        }
    }
    sound.then_some(matrix)
}

/// A floor: its name in the file, its displacement from 0, or what moves it, and its height \[m\].
pub(super) struct Port<T = usize> {
    pub(super) name: String,
    pub(super) dof: T,
    pub(super) height: f64,
}

/// Floors from the ground up.
pub(super) fn read_ports<'n, T>(
    reader: &mut Reader<'_>,
    view: &View<'n>,
    example: &str,
    read_port: impl Fn(&mut Reader<'_>, &View<'n>) -> Option<T>,
) -> Option<Vec<Port<T>>> {
    let Some(field) = reader.get(view, "ports") else {
        reader.missing(view, "ports", example);
        return None;
    };
    let field = &field;
    let Some(entries) = field.named_entries() else {
        let found = field.node.describe();
        *reader.bad(field, format!("expected a table of floors, found {found}")) =
            Some("write ports = { \"1\" = { dof = 1, height = \"3 m\" } }".into());
        return None;
    };
    let mut ports = Vec::with_capacity(entries.len());
    let mut sound = true;
    for (name, entry) in &entries {
        let port = reader.open(entry, &[Section::Port]).and_then(|view| {
            let dof = read_port(reader, &view);
            let height = read_height(reader, &view);
            Some(Port {
                name: (*name).to_owned(),
                dof: dof?,
                height: height?,
            })
        });
        sound &= port.is_some();
        ports.extend(port);
    }
    if entries.is_empty() {
        reader.bad(field, "names no floor");
    }
    sort_by(&mut ports, |a, b| a.height.total_cmp(&b.height));
    for pair in ports.windows(2) {
        if pair[0].height == pair[1].height {
            let [a, b] = [&pair[0].name, &pair[1].name];
            reader.bad(
                field,
                format!(
                    "\"{a}\" and \"{b}\" lie at one height; a building has one floor at a height"
                ),
            );
            return None;
        }
    }
    for (index, port) in ports.iter().enumerate() {
        let number = port.name.parse::<usize>();
        if sound && number.is_ok_and(|number| number != index + 1) {
            *reader.bad(
                field,
                format!("\"{}\" is floor {} from the ground up", port.name, index + 1),
            ) = Some("floors count from the lowest port; number ports so, or give them names such as \"roof\"".into());
            return None;
        }
    }
    (sound && !ports.is_empty()).then_some(ports)
}

/// Its displacement, from 0.
fn read_port(reader: &mut Reader<'_>, view: &View<'_>) -> Option<usize> {
    for key in ["dofs", "at"] {
        if let Some(field) = reader.get(view, key) {
            *reader.bad(&field, "needs a plan") = Some(
                "add plan = [\"20 m\", \"12 m\"] to the building, or write dof = 1, the row of its horizontal displacement".into(),
            );
            return None;
        }
    }
    match reader.get(view, "dof") {
        Some(field) => read_dof(reader, &field),
        None => {
            reader.missing(view, "dof", "add dof = 1, the row of its horizontal displacement in the matrices, counted from 1");
            None
        }
    }
}

/// A displacement, from 0.
pub(super) fn read_dof(reader: &mut Reader<'_>, field: &Field<'_>) -> Option<usize> {
    match reader.count(field)? {
        0 => {
            reader.bad(field, "displacements count from 1");
            None
        }
        count => Some(count - 1),
    }
}

fn read_height(reader: &mut Reader<'_>, view: &View<'_>) -> Option<f64> {
    let Some(field) = reader.get(view, "height") else {
        reader.missing(view, "height", "add height = \"3 m\", above the base");
        return None;
    };
    reader.positive(&field, Dimension::Length)
}

/// The stiffness matrix, or the inverse of a flexibility matrix.
///
/// # Errors
/// The problem in words.
pub(super) fn stiffness_of(matrices: &Matrices) -> Result<std::borrow::Cow<'_, Matrix>, String> {
    match (&matrices.stiffness, &matrices.flexibility) {
        (Some(_), Some(_)) => Err("have both K and F, its inverse; keep one of them".into()),
        (Some(stiffness), None) => Ok(std::borrow::Cow::Borrowed(stiffness)),
        // In units of the file: one over those of K.
        (None, Some(flexibility)) => {
            let inverse = flexibility.inverse().map_err(|p| format!("F {p}"))?;
            Ok(std::borrow::Cow::Owned(inverse))
        }
        (None, None) => Err("have no stiffness matrix K, nor its inverse F".into()),
    }
}

/// The building of matrices in units with these factors.
fn assemble(
    matrices: &Matrices,
    ports: &[Port],
    [factor, length]: [f64; 2],
) -> Result<Read, String> {
    let named = |name: &str, problem: String| format!("{name} {problem}");
    let missing = |name: &str| format!("have no {name}");
    let stiffness = stiffness_of(matrices)?;
    let mass = matrices
        .mass
        .as_ref()
        .ok_or_else(|| missing("mass matrix M"))?;
    let n = stiffness.rows;
    let scaled = |mut entries: Vec<(usize, usize, f64)>| {
        entries.iter_mut().for_each(|entry| entry.2 *= factor);
        entries
    };
    let stiffness = stiffness.lower_triangle(n).map_err(|p| named("K", p))?;
    let mass = mass.diagonal(n).map_err(|p| named("M", p))?;
    let damping = match &matrices.damping {
        Some(matrix) => matrix.lower_triangle(n).map_err(|p| named("C", p))?,
        None => Vec::new(),
    };
    if let Some(port) = ports.iter().find(|port| port.dof >= n) {
        return Err(format!(
            "have {n} rows, and port \"{}\" is displacement {}",
            port.name,
            port.dof + 1
        ));
    }
    let influence = match &matrices.influence {
        Some(matrix) => matrix.diagonal(n).map_err(|p| named("r", p))?,
        None if ports.len() == n => vec![1.0; n],
        None => {
            return Err(format!(
                "have {n} displacements and {} ports; add the vector r: 1 for displacements that move with the ground, 0 for rotations and vertical ones",
                ports.len()
            ));
        }
    };
    let mut heights = match &matrices.heights {
        Some(matrix) => {
            let heights = matrix.diagonal(n).map_err(|p| named("h", p))?;
            heights.into_iter().map(|height| height * length).collect()
        }
        None => {
            let carried = (0..n).find(|dof| {
                mass[*dof] > 0.0 && influence[*dof] != 0.0 && ports.iter().all(|p| p.dof != *dof)
            });
            if let Some(dof) = carried {
                return Err(format!(
                    "have a mass at displacement {}, which moves with the ground and is no port; add the vector h, the height of every displacement, for storey shears",
                    dof + 1
                ));
            }
            vec![0.0; n]
        }
    };
    for port in ports {
        heights[port.dof] = port.height;
    }
    let mut below = 0.0;
    let storey_heights = ports
        .iter()
        .map(|port| port.height - std::mem::replace(&mut below, port.height))
        .collect();
    let rayleigh = (!damping.is_empty())
        .then(|| {
            let mass: Vec<MatrixEntry> = mass.iter().enumerate().map(|(i, m)| (i, i, *m)).collect();
            rayleigh(n, &mass, &stiffness, &damping)
        })
        .flatten();
    let stated = !damping.is_empty();
    let [alpha, beta] = rayleigh.unwrap_or_default();
    Ok(Read {
        damping: stated.then_some(Damping::Rayleigh { alpha, beta }),
        given: Given {
            mass: mass.into_iter().map(|mass| factor * mass).collect(),
            stiffness: scaled(stiffness),
            damping: if rayleigh.is_some() {
                Vec::new()
            } else {
                scaled(damping)
            },
            influence,
            heights,
            floors: ports.iter().map(|port| port.dof).collect(),
            storey_heights,
        },
    })
}

/// α and β if C = α M + β K, both ≥ 0: modes then stay apart, which is many times faster. Least squares of entries, each in
/// parts of √(K_ii K_jj), so that units do not matter.
pub(super) fn rayleigh(
    n: usize,
    mass: &[MatrixEntry],
    stiffness: &[MatrixEntry],
    damping: &[MatrixEntry],
) -> Option<[f64; 2]> {
    /// Greatest remainder, in parts of the greatest entry.
    const REMAINDER: f64 = 1e-9;
    let mut sizes = vec![0.0; n];
    for (row, column, value) in stiffness {
        if row == column {
            sizes[*row] = value.sqrt();
        }
    }
    let mut entries: std::collections::BTreeMap<(usize, usize), [f64; 3]> =
        std::collections::BTreeMap::new();
    for (place, list) in [(0, mass), (1, stiffness), (2, damping)] {
        for (row, column, value) in list {
            entries.entry((*row, *column)).or_default()[place] += value;
        }
    }
    let mut sums = [[0.0; 3]; 2];
    let weighted: Vec<[f64; 3]> = entries
        .iter()
        .map(|((row, column), values)| values.map(|value| value / (sizes[*row] * sizes[*column])))
        .collect();
    for values in &weighted {
        for i in 0..2 {
            for j in 0..3 {
                sums[i][j] += values[i] * values[j];
            }
        }
    }
    let [[mm, mk, mc], [_, kk, kc]] = sums;
    let determinant = mm * kk - mk * mk;
    let alpha = (mc * kk - mk * kc) / determinant;
    let beta = (mm * kc - mk * mc) / determinant;
    // Coefficients that are rounding.
    let alpha = if alpha.abs() * mm.sqrt() < REMAINDER * (kk.sqrt() * beta).abs() {
        0.0
    } else {
        alpha
    };
    let beta = if beta.abs() * kk.sqrt() < REMAINDER * (mm.sqrt() * alpha).abs() {
        0.0
    } else {
        beta
    };
    let greatest = weighted
        .iter()
        .fold(0.0_f64, |most, value| most.max(value[2].abs()));
    let fits = weighted
        .iter()
        .all(|[m, k, c]| (c - alpha * m - beta * k).abs() <= REMAINDER * greatest);
    (fits && alpha >= 0.0 && beta >= 0.0).then_some([alpha, beta])
}
