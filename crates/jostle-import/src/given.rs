//! Buildings by flexibility, of tables or of the members of a text model, by modes, or by storey stiffness.

use std::collections::{BTreeMap, BTreeSet};
use std::f64::consts::PI;
use std::fmt::Write;

use jostle_io::InputError;

use crate::assembled::assemble;
use crate::facts::{Facts, Floor, Point, key};
use crate::left_out::softer;
use crate::matrix::{positive_definite, symmetrise};
use crate::member::TextModel;
use crate::options::{Direction, ImportOptions, Way};
use crate::text::plain;

/// Largest matrices that stand in the model file itself.
const MOST_ROWS_INLINE: usize = 12;
/// Greatest product of two shapes of unit mass, which are orthogonal.
const ORTHOGONAL: f64 = 0.05;
/// Least share of a mode's kinetic energy in the direction of a model in plane.
const LEAST_SHARE: f64 = 0.7;
const FORCES: [&str; 3] = ["F_x", "F_y", "M_z"];

/// Arrays of a file beside the model: name, sizes, numbers.
pub(crate) type Arrays = Vec<(&'static str, Vec<usize>, Vec<f64>)>;

/// A building of a model file.
pub(crate) struct Built {
    /// Its `[[building]]`.
    pub(crate) block: String,
    /// Arrays of its archive, whose name stands in the block as `FILE`.
    pub(crate) arrays: Option<Arrays>,
    pub(crate) remarks: Vec<String>,
    pub(crate) in_space: bool,
    /// 0 or 1 for a model in plane along X or Y.
    pub(crate) axis: usize,
}

/// A number with ten digits.
pub(crate) fn digits(value: f64) -> String {
    let rounded: f64 = format!("{value:.9e}").parse().unwrap_or(value);
    match rounded.abs() {
        size if size != 0.0 && !(1e-4..1e9).contains(&size) => format!("{rounded:e}"),
        _ => format!("{rounded}"),
    }
}

/// A text of TOML.
pub(crate) fn quoted(text: &str) -> String {
    let clean: String = text.chars().filter(|c| !c.is_control()).collect();
    format!("\"{}\"", clean.replace('\\', "\\\\").replace('"', "\\\""))
}

/// Quantities of one unit.
pub(crate) fn quantities(values: impl Iterator<Item = f64>, unit: &str) -> String {
    let values: Vec<String> = values
        .map(|value| format!("\"{} {unit}\"", digits(value)))
        .collect();
    format!("[{}]", values.join(", "))
}

/// A point of a plan.
pub(crate) fn point([x, y]: Point) -> String {
    quantities([x, y].into_iter(), "m")
}

/// The head of a building, with the height of its base.
pub(crate) fn head(facts: &Facts, kind: &str) -> String {
    let mut block = format!(
        "[[building]]\nname = {}\nkind = \"{kind}\"\n",
        quoted(&facts.name)
    );
    if kind == "given" {
        block.push_str(
            "damping = { ratio = 0.05, modes = \"all\" } # as modal damping of the source\n",
        );
    }
    if facts.base_height() != 0.0 {
        // Writing to a string cannot fail.
        let _ = writeln!(
            block,
            "elevation = \"{} m\"              # of the base, as in the source",
            digits(facts.base_height())
        );
    }
    block
}

/// Plans of all floors from an origin at their lower left, and that origin.
pub(crate) fn plans(facts: &Facts, floors: &[Floor]) -> Option<(String, Point)> {
    let outlines: Option<Vec<Vec<Point>>> = floors
        .iter()
        .map(|floor| facts.outline(&floor.name))
        .collect();
    let outlines = outlines?;
    let least = |axis: usize| {
        outlines
            .iter()
            .flatten()
            .map(|corner| corner[axis])
            .fold(f64::INFINITY, f64::min)
    };
    let origin = [least(0), least(1)];
    let corners = |outline: &Vec<Point>| {
        let corners: Vec<String> = outline
            .iter()
            .map(|[x, y]| point([x - origin[0], y - origin[1]]))
            .collect();
        format!("[{}]", corners.join(", "))
    };
    let same = outlines.windows(2).all(|pair| pair[0] == pair[1]);
    let text = match same {
        true => format!("plan = {}\n", corners(&outlines[0])),
        false => {
            let lines: String = outlines
                .iter()
                .map(|outline| format!("  {{ corners = {} }},\n", corners(outline)))
                .collect();
            format!("plan = [                          # from the ground up\n{lines}]\n")
        }
    };
    Some((text, origin))
}

/// Makes a building of the members of a text model, in space or, with a direction, in one plane.
///
/// # Errors
/// What the model lacks, or masses do.
pub(crate) fn assembled(
    facts: &mut Facts,
    model: &TextModel,
    axis: Option<usize>,
) -> Result<Built, InputError> {
    let floors = facts.floors()?;
    if let Some(lacks) = floors.iter().find_map(|floor| floor_lacks(facts, floor)) {
        return Err(facts.fault("", lacks.0, lacks.1));
    }
    let found = assemble(facts, model, &floors)?;
    softer(facts, model);
    Ok(match axis {
        None => in_space(facts, &floors, &found.flexibility, found.remarks)?,
        Some(axis) => {
            let matrix_of = |matrix: &[f64]| matrix.iter().skip(axis).step_by(3).copied().collect();
            let rows = found.flexibility.iter().skip(axis).step_by(3);
            let matrix: Vec<Vec<f64>> = rows.map(|row| matrix_of(row)).collect();
            in_plane(facts, &floors, &matrix, axis, found.remarks)
        }
    })
}

/// Makes a building of the facts.
///
/// # Errors
/// What is missing for each of the ways.
pub(crate) fn build(facts: &mut Facts, options: &ImportOptions) -> Result<Built, InputError> {
    let floors = facts.floors()?;
    facts.choose_displacements(&floors)?;
    let cases = unit_cases(facts, options)?;
    let in_both = options
        .direction
        .is_none_or(|direction| direction == Direction::Both);
    let has_modes = facts
        .displacements
        .iter()
        .any(|displacement| displacement.step.is_some());
    let by_modes_alone = options.way.is_none() && cases.is_empty() && has_modes;
    if in_both && (options.way == Some(Way::Modes) || by_modes_alone) {
        if let Some(lacks) = floors.iter().find_map(|floor| floor_lacks(facts, floor)) {
            return Err(facts.fault(
                "",
                lacks.0,
                format!(
                    "{}; or add --direction x or --direction y for a model in one plane",
                    lacks.1
                ),
            ));
        }
        let mut remarks = Vec::new();
        return match by_modes_in_space(facts, &floors, options, &mut remarks)? {
            Some(matrix) => in_space(facts, &floors, &matrix, remarks),
            None => Err(facts.fault("", "has no shapes of modes", "select the modal case for output and export Diaphragm Center Of Mass Displacements and Modal Periods And Frequencies")),
        };
    }
    if options.way.is_none_or(|way| way == Way::Flexibility) && in_both {
        match space_lacks(facts, &floors, &cases) {
            None => {
                let mut remarks = Vec::new();
                let matrix = flexibility(facts, &floors, &cases, &[0, 1, 2], &mut remarks)?;
                return in_space(facts, &floors, &matrix, remarks);
            }
            Some(lacks) if options.direction == Some(Direction::Both) => {
                return Err(facts.fault(
                    "--direction both",
                    format!("a model in space is not possible: {}", lacks.0),
                    lacks.1,
                ));
            }
            // Neither of the planes can be guessed.
            Some(lacks) => {
                return Err(facts.fault(
                    "",
                    format!("a model in space is not possible: {}", lacks.0),
                    format!(
                        "add --direction x or --direction y for a model in one plane; or {}",
                        lacks.1
                    ),
                ));
            }
        }
    }
    let axis = match options.direction {
        Some(Direction::Y) => 1,
        Some(Direction::X) => 0,
        _ => {
            return Err(facts.fault(
                "",
                "modes and storey stiffness give a model in one plane",
                "add --direction x or --direction y",
            ));
        }
    };
    let complete = floors
        .iter()
        .all(|floor| cases.contains_key(&(key(&floor.name), axis)));
    let wants = |way: Way| options.way.is_none_or(|choice| choice == way);
    if wants(Way::Flexibility) && complete {
        let mut remarks = Vec::new();
        let matrix = flexibility(facts, &floors, &cases, &[axis], &mut remarks)?;
        return Ok(in_plane(facts, &floors, &matrix, axis, remarks));
    }
    if wants(Way::Modes)
        && let Some(built) = by_modes(facts, &floors, &cases, axis, options)?
    {
        return Ok(built);
    }
    if wants(Way::Stiffness)
        && let Some(built) = by_stiffness(facts, &floors, axis, options.case.as_deref())?
    {
        return Ok(built);
    }
    let force = FORCES[axis];
    Err(facts.fault(
        "",
        format!("has no stiffness: neither a unit {force} at every floor, nor modes, nor storey stiffness among its tables ({})", facts.tables.join(", ")),
        format!("export one of these: Diaphragm Center Of Mass Displacements of load cases with a unit {force} each (best); the same of the modal case, with Modal Periods And Frequencies; or Story Stiffness of an earthquake case along {}", ["X", "Y"][axis]),
    ))
}

type Cases = BTreeMap<(String, usize), (String, f64)>;

/// Load cases with one load, by storey and component.
fn unit_cases(facts: &Facts, options: &ImportOptions) -> Result<Cases, InputError> {
    let mut found = Cases::new();
    let mut loads: BTreeMap<&str, Vec<usize>> = BTreeMap::new();
    for (index, load) in facts.unit_loads.iter().enumerate() {
        loads.entry(&load.case).or_default().push(index);
    }
    for (case, indices) in loads {
        // Cases with several loads are no unit loads.
        if let [index] = indices[..] {
            let load = &facts.unit_loads[index];
            found.insert((key(&load.story), load.component), (key(case), load.size));
        }
    }
    // By name, as "FX Story5".
    let cases: BTreeSet<&str> = facts
        .displacements
        .iter()
        .map(|displacement| displacement.case.as_str())
        .collect();
    for case in cases {
        for (component, start) in ["fx", "fy", "mz"].into_iter().enumerate() {
            let case_name = plain(case);
            let Some(rest) = case_name.strip_prefix(start) else {
                continue;
            };
            let Some(story) = facts
                .stories
                .iter()
                .find(|story| plain(&story.name) == rest)
            else {
                continue;
            };
            let place = (key(&story.name), component);
            if found.contains_key(&place) {
                continue;
            }
            let (size, key_of) = match component {
                2 => (options.unit_moment, "--unit-moment \"1000 kN.m\""),
                _ => (options.unit_force, "--unit-force \"1000 kN\""),
            };
            let Some(size) = size else {
                return Err(facts.fault(
                    format!("case \"{case}\""),
                    "does not say how great its load is",
                    format!("add {key_of}, or export the table of user loads as well"),
                ));
            };
            found.insert(place, (key(case), size));
        }
    }
    Ok(found)
}

/// Displacement of a floor in a case without steps.
fn response(facts: &Facts, case: &str, story: &str) -> Option<[f64; 3]> {
    let matching = |displacement: &&crate::facts::Displacement| {
        key(&displacement.case) == case && key(&displacement.story) == key(story)
    };
    facts
        .displacements
        .iter()
        .find(matching)
        .map(|displacement| displacement.by)
}

/// What a model in space lacks, and what helps.
fn space_lacks(facts: &Facts, floors: &[Floor], cases: &Cases) -> Option<(String, String)> {
    for floor in floors {
        let lacks = floor_lacks(facts, floor);
        if lacks.is_some() {
            return lacks;
        }
        if let Some(component) =
            (0..3).find(|component| !cases.contains_key(&(key(&floor.name), *component)))
        {
            return Some((
                format!(
                    "no load case has a unit {} on storey \"{}\" alone",
                    FORCES[component], floor.name
                ),
                format!(
                    "make a load case with a unit force along X, one along Y and one with a unit moment for every diaphragm, named \"FX {0}\", \"FY {0}\", \"MZ {0}\", and export their Diaphragm Center Of Mass Displacements",
                    floor.name
                ),
            ));
        }
    }
    None
}

/// What a floor in space lacks, and what helps.
fn floor_lacks(facts: &Facts, floor: &Floor) -> Option<(String, String)> {
    if floor.inertia.is_none() || floor.centre.is_none() {
        return Some((format!("storey \"{}\" has no mass moment of inertia or centre of mass", floor.name), "export Mass Summary by Diaphragm with all of its columns, or name the .OUT file of the analysis".into()));
    }
    facts.outline(&floor.name).is_none().then(|| {
        ("there is no outline of the floors".into(), "name the .e2k or $et file of the model beside the workbook, or export the table Objects and Elements - Joints (Point Object Connectivity)".into())
    })
}

/// Flexibility over these components of every floor, symmetric.
fn flexibility(
    facts: &Facts,
    floors: &[Floor],
    cases: &Cases,
    components: &[usize],
    remarks: &mut Vec<String>,
) -> Result<Vec<Vec<f64>>, InputError> {
    let mut columns = Vec::new();
    for floor in floors {
        for component in components {
            let (case, size) = &cases[&(key(&floor.name), *component)];
            let mut column = Vec::new();
            for other in floors {
                let Some(by) = response(facts, case, &other.name) else {
                    return Err(facts.fault(format!("case \"{case}\", storey \"{}\"", other.name), "has no displacement", "select this case for output and export Diaphragm Center Of Mass Displacements again, with all storeys"));
                };
                column.extend(components.iter().map(|component| by[*component] / size));
            }
            columns.push(column);
        }
    }
    let n = columns.len();
    let mut matrix: Vec<Vec<f64>> = (0..n)
        .map(|i| columns.iter().map(|column| column[i]).collect())
        .collect();
    let difference = symmetrise(&mut matrix);
    let text = |difference: f64| format!("{:.1e}", difference);
    if difference > 0.05 {
        return Err(facts.fault("Diaphragm Center Of Mass Displacements", format!("the flexibility is not symmetric, by {}: a floor must move under a force at another as that one under a force at it", text(difference)), "check that each case has one load alone at the centre of mass, that all are linear, and their sizes"));
    }
    if !positive_definite(&matrix) {
        return Err(facts.fault("Diaphragm Center Of Mass Displacements", "the flexibility is not positive definite: its digits do not suffice to invert it", "set the length of tables to mm and the number of decimals high (Options, Display units), take unit loads of 1000 kN or more, and export again"));
    }
    let rounding = match difference > 1e-9 {
        true => format!(
            "; F_ij and F_ji differ by at most {} of √(F_ii F_jj)",
            text(difference)
        ),
        false => String::new(),
    };
    remarks.push(format!(
        "flexibility of {n} displacements by unit loads{rounding}"
    ));
    Ok(matrix)
}

/// Matrices in the block, or beside it where they are large.
fn matrices(
    block: &mut String,
    matrix: &[Vec<f64>],
    mass: &[f64],
    floors: Vec<String>,
) -> Option<Arrays> {
    let n = matrix.len();
    let ports = format!("\n[building.ports]\n{}", floors.concat());
    if n > MOST_ROWS_INLINE {
        let _ = write!(
            block,
            "matrices = \"FILE\"                 # F: displacements under unit loads; M: masses; in N, m, kg\n{ports}"
        );
        return Some(vec![
            ("F", vec![n, n], matrix.concat()),
            ("M", vec![n], mass.to_vec()),
        ]);
    }
    let list = |values: &[f64]| {
        let values: Vec<String> = values.iter().map(|value| digits(*value)).collect();
        format!("[{}]", values.join(", "))
    };
    let rows: String = matrix
        .iter()
        .map(|row| format!("  {},\n", list(row)))
        .collect();
    let _ = write!(
        block,
        "{ports}\n[building.matrices]               # in N, m, kg and rad\nmass = {}\nflexibility = [                   # displacements under unit loads\n{rows}]\n",
        list(mass)
    );
    None
}

/// A building in space by displacements along X and Y and turns of all floors under unit loads at their centres of mass.
fn in_space(
    facts: &Facts,
    floors: &[Floor],
    matrix: &[Vec<f64>],
    mut remarks: Vec<String>,
) -> Result<Built, InputError> {
    let mut block = head(facts, "given");
    let Some((plan, origin)) = plans(facts, floors) else {
        return Err(facts.fault(
            "",
            "has no outline of its floors",
            "name the .e2k file of the model beside the workbook",
        ));
    };
    remarks.push("outline of floors: convex hull of their joints, without projecting slabs and re-entrant corners: correct plan where a neighbour is near".into());
    block.push_str(&plan);
    let mut mass = Vec::new();
    let mut ports = Vec::new();
    for (index, floor) in floors.iter().enumerate() {
        let [x, y] = floor.mass;
        if (x - y).abs() > 1e-6 * x {
            return Err(facts.fault(format!("storey \"{}\"", floor.name), "has different masses along X and Y", "a floor in space has one mass: give it the same along both in the source, or add --direction x"));
        }
        let (Some(inertia), Some([cx, cy])) = (floor.inertia, floor.centre) else {
            continue;
        };
        mass.extend([x, x, inertia]);
        let row = 3 * index + 1;
        ports.push(format!(
            "\"{}\" = {{ dofs = [{row}, {}, {}], at = {}, height = \"{} m\" }} # {}\n",
            index + 1,
            row + 1,
            row + 2,
            point([cx - origin[0], cy - origin[1]]),
            digits(floor.height),
            floor.name
        ));
    }
    let arrays = matrices(&mut block, matrix, &mass, ports);
    Ok(Built {
        block,
        arrays,
        remarks,
        in_space: true,
        axis: 0,
    })
}

/// A building in one plane by displacements of all floors under unit forces along it.
fn in_plane(
    facts: &Facts,
    floors: &[Floor],
    matrix: &[Vec<f64>],
    axis: usize,
    mut remarks: Vec<String>,
) -> Built {
    remarks.insert(0, PLANE.to_owned());
    let mut block = head(facts, "given");
    let mass: Vec<f64> = floors.iter().map(|floor| floor.mass[axis]).collect();
    let ports = floors.iter().enumerate().map(|(index, floor)| {
        format!(
            "\"{0}\" = {{ dof = {0}, height = \"{1} m\" }} # {2}\n",
            index + 1,
            digits(floor.height),
            floor.name
        )
    });
    let arrays = matrices(&mut block, matrix, &mass, ports.collect());
    Built {
        block,
        arrays,
        remarks,
        in_space: false,
        axis,
    }
}

const PLANE: &str = "in one plane: floors do not turn, and what moves across is left out";

/// Storey heights and masses of a block.
fn floors_of(block: &mut String, floors: &[Floor], axis: usize) {
    let mut below = 0.0;
    let heights = floors
        .iter()
        .map(|floor| floor.height - std::mem::replace(&mut below, floor.height));
    let heights: Vec<f64> = heights.collect();
    let names: Vec<&str> = floors.iter().map(|floor| floor.name.as_str()).collect();
    let _ = writeln!(block, "# Floors from the ground up: {}.", names.join(", "));
    let _ = writeln!(
        block,
        "storey_height = {}",
        quantities(heights.into_iter(), "m")
    );
    let _ = writeln!(
        block,
        "mass = {}",
        quantities(floors.iter().map(|floor| floor.mass[axis] * 1e-3), "t")
    );
}

/// A mode of the source with its shape.
struct Shape {
    mode: usize,
    /// > 0 \[s\]
    period: f64,
    /// Of every floor along X and Y, and its turn.
    shape: Vec<[f64; 3]>,
    /// Twice the kinetic energy at a unit frequency, of these three.
    energies: [f64; 3],
}

/// Modes of one case whose shape is known at every floor, longest period first.
///
/// # Errors
/// Several modal cases, none of which is named.
fn shapes(
    facts: &Facts,
    floors: &[Floor],
    options: &ImportOptions,
) -> Result<Vec<Shape>, InputError> {
    let mut found: Vec<Shape> = Vec::new();
    let mut cases: Vec<&str> = Vec::new();
    let of_case = |case: &str| {
        let named = options.case.as_deref();
        case.is_empty() || named.is_none_or(|named| key(named) == key(case))
    };
    let periods = facts.periods.iter().filter(|period| period.period > 0.0);
    for period in periods.filter(|period| of_case(&period.case)) {
        let of_floor = |floor: &Floor| {
            let is = |row: &&crate::facts::Displacement| {
                row.step == Some(period.mode)
                    && key(&row.story) == key(&floor.name)
                    && (period.case.is_empty() || key(&row.case) == key(&period.case))
            };
            facts.displacements.iter().find(is).map(|row| row.by)
        };
        let Some(shape) = floors.iter().map(of_floor).collect::<Option<Vec<_>>>() else {
            continue;
        };
        if !cases.contains(&period.case.as_str()) {
            cases.push(&period.case);
        }
        let energies = [0, 1, 2].map(|component| {
            let energy = |(by, floor): (&[f64; 3], &Floor)| {
                by[component].powi(2) * mass_of(floor)[component]
            };
            shape.iter().zip(floors).map(energy).sum()
        });
        found.push(Shape {
            mode: period.mode,
            period: period.period,
            shape,
            energies,
        });
    }
    if cases.len() > 1 {
        return Err(facts.fault(
            "",
            format!("has modes of several cases, {}", cases.join(", ")),
            format!("name one, such as --case \"{}\"", cases[0]),
        ));
    }
    found.sort_by(|a, b| b.period.total_cmp(&a.period));
    Ok(found)
}

/// Masses along X and Y and moment of inertia of a floor \[kg, kg·m²\].
fn mass_of(floor: &Floor) -> [f64; 3] {
    [floor.mass[0], floor.mass[1], floor.inertia.unwrap_or(0.0)]
}

/// Flexibility in space of modes, Σ φφᵀ/ω² with φᵀMφ = 1, and of what they leave out, (M⁻¹ − Σ φφᵀ)/ω_r²; `None` without modes.
///
/// ω_r is that of the modes that a uniform shear building would have left; the modes keep their periods and shapes whatever it is.
fn by_modes_in_space(
    facts: &Facts,
    floors: &[Floor],
    options: &ImportOptions,
    remarks: &mut Vec<String>,
) -> Result<Option<Vec<Vec<f64>>>, InputError> {
    let mut modes = shapes(facts, floors, options)?;
    modes.retain(|mode| mode.energies.iter().sum::<f64>() > 0.0);
    modes.truncate(3 * floors.len());
    let table = "Diaphragm Center Of Mass Displacements of modes";
    let more = "let the modal case find more modes, three for every floor if it can, and select it for output";
    if modes.is_empty() {
        return Ok(None);
    }
    let mass: Vec<f64> = floors.iter().flat_map(mass_of).collect();
    let mut shapes: Vec<Vec<f64>> = Vec::new();
    for mode in &modes {
        let size = mode.energies.iter().sum::<f64>().sqrt();
        let shape: Vec<f64> = mode
            .shape
            .as_flattened()
            .iter()
            .map(|by| by / size)
            .collect();
        for (other, before) in shapes.iter().zip(&modes) {
            let shared: f64 = (0..mass.len()).map(|i| shape[i] * mass[i] * other[i]).sum();
            if shared.abs() > ORTHOGONAL {
                return Err(facts.fault(table, format!("modes {} and {} are not orthogonal with the floor masses (their product is {shared:.3}): storeys without mass or semi-rigid floors carry mass that the floors do not have", before.mode, mode.mode), "model it by unit loads: export displacements under a unit force along X, along Y and a unit moment on every diaphragm"));
            }
        }
        shapes.push(shape);
    }
    let count = floors.len();
    let mut left = Vec::new();
    for component in 0..3 {
        let is_most = |shape: &&Shape| {
            shape
                .energies
                .iter()
                .all(|other| *other <= shape.energies[component])
        };
        let modes: Vec<&Shape> = modes.iter().filter(is_most).collect();
        let Some(last) = modes.last() else {
            return Err(facts.fault(
                table,
                format!(
                    "no mode is one of {}",
                    ["sway along X", "sway along Y", "torsion"][component]
                ),
                more,
            ));
        };
        if modes.len() < count {
            left.push(remainder_period(last.period, modes.len(), count));
        }
    }
    let square = left.iter().map(|period| period * period).sum::<f64>() / left.len().max(1) as f64;
    let flexible = |period_squared: f64| period_squared / (4.0 * PI * PI);
    let n = mass.len();
    let matrix = (0..n).map(|i| {
        (0..n)
            .map(|j| {
                let of_modes = |weight: &dyn Fn(&Shape) -> f64| -> f64 {
                    modes
                        .iter()
                        .zip(&shapes)
                        .map(|(mode, shape)| weight(mode) * shape[i] * shape[j])
                        .sum()
                };
                let rest = match i == j {
                    true => 1.0 / mass[i],
                    false => 0.0,
                } - of_modes(&|_| 1.0);
                let rest = if modes.len() < n {
                    rest * flexible(square)
                } else {
                    0.0
                };
                of_modes(&|mode| flexible(mode.period * mode.period)) + rest
            })
            .collect()
    });
    remarks.push(format!("{} modes of {n} in space", modes.len()));
    if modes.len() < n {
        remarks.push("what the modes leave out: as of a uniform building, which sets the stiffness of floors that are struck; more modes, or unit loads, make it better".into());
    }
    Ok(Some(matrix.collect()))
}

/// Period of what `known` modes of a uniform shear building of so many floors leave out, by that of the last one \[s\].
fn remainder_period(last: f64, known: usize, floors: usize) -> f64 {
    let sine = |mode: usize| {
        let angle = (2 * mode - 1) as f64 * PI / (4 * floors + 2) as f64;
        angle.sin()
    };
    let rest = (known + 1..=floors).map(|mode| sine(mode).powi(-2));
    let mean = rest.clone().sum::<f64>() / rest.count() as f64;
    // Real buildings are a little stiffer in their higher modes, as for `given` by modes.
    0.85 * last * sine(known) * mean.sqrt()
}

/// By the modes of one direction; `None` where there are none.
fn by_modes(
    facts: &Facts,
    floors: &[Floor],
    cases: &Cases,
    axis: usize,
    options: &ImportOptions,
) -> Result<Option<Built>, InputError> {
    let mut remarks = vec![PLANE.to_owned()];
    let mut found: Vec<(usize, f64, Vec<f64>)> = Vec::new();
    let mut least_share = 1.0_f64;
    for shape in shapes(facts, floors, options)? {
        let all: f64 = shape.energies.iter().sum();
        let share = shape.energies[axis] / all;
        if !(all > 0.0 && share > 0.5) {
            continue;
        }
        least_share = least_share.min(share);
        found.push((
            shape.mode,
            shape.period,
            shape.shape.iter().map(|by| by[axis]).collect(),
        ));
    }
    if found.is_empty() {
        return Ok(None);
    }
    let table = "Diaphragm Center Of Mass Displacements of modes";
    if least_share < LEAST_SHARE {
        return Err(facts.fault(table, format!("the building turns as it sways: only {:.0} % of the kinetic energy of one of its modes is along {}", least_share * 100.0, ["X", "Y"][axis]), "model it in space: export displacements under a unit force along X, along Y and a unit moment on every diaphragm"));
    }
    if least_share < 0.95 {
        remarks.push(format!("modes along {} turn a little: at least {:.0} % of their kinetic energy is in this direction", ["X", "Y"][axis], least_share * 100.0));
    }
    found.sort_by(|a, b| b.1.total_cmp(&a.1));
    found.truncate(floors.len());
    let product = |a: &[f64], b: &[f64]| -> f64 {
        a.iter()
            .zip(b)
            .zip(floors)
            .map(|((a, b), floor)| a * b * floor.mass[axis])
            .sum()
    };
    for (index, one) in found.iter().enumerate() {
        for other in &found[..index] {
            let shared = product(&one.2, &other.2)
                / (product(&one.2, &one.2) * product(&other.2, &other.2)).sqrt();
            if shared.abs() > ORTHOGONAL {
                return Err(facts.fault(table, format!("modes {} and {} are not orthogonal with the floor masses (their product is {shared:.3}): storeys without mass, semi-rigid floors or torsion carry mass that the floors do not have", other.0, one.0), "model it by unit loads, in space if it turns: export displacements under a unit force on every diaphragm"));
            }
        }
    }
    let mut block = head(facts, "given");
    floors_of(&mut block, floors, axis);
    let _ = writeln!(
        block,
        "periods = {}",
        quantities(found.iter().map(|own| own.1), "s")
    );
    let _ = writeln!(block, "shapes = [");
    for (mode, _, shape) in &found {
        let most = shape
            .iter()
            .fold(0.0_f64, |most, shape| most.max(shape.abs()));
        let shape: Vec<String> = shape.iter().map(|shape| digits(shape / most)).collect();
        let _ = writeln!(block, "  [{}], # mode {mode}", shape.join(", "));
    }
    block.push_str("]\n");
    remarks.push(format!("{} modes of {} floors", found.len(), floors.len()));
    // The highest floor with a unit load alone.
    let struck = floors.iter().enumerate().rev().find_map(|(index, floor)| {
        let (case, size) = cases.get(&(key(&floor.name), axis))?;
        Some((index, response(facts, case, &floor.name)?[axis] / size))
    });
    match struck.filter(|_| found.len() < floors.len()) {
        Some((index, flexibility)) => {
            let _ = writeln!(
                block,
                "contact_flexibility = \"{} m/N\"   # under a unit load there\ncontact_floor = {}",
                digits(flexibility),
                index + 1
            );
            remarks.push(format!(
                "what the modes leave out: from the displacement of floor {} under a unit load",
                index + 1
            ));
        }
        None if found.len() < floors.len() => {
            remarks.push("what the modes leave out: as of a uniform building, which sets the stiffness of floors that are struck; one load case with a unit force on the floor that a neighbour reaches makes it exact".into());
        }
        None => {}
    }
    Ok(Some(Built {
        block,
        arrays: None,
        remarks,
        in_space: false,
        axis,
    }))
}

/// A shear building by storey stiffness; `None` where there is none.
fn by_stiffness(
    facts: &Facts,
    floors: &[Floor],
    axis: usize,
    wanted: Option<&str>,
) -> Result<Option<Built>, InputError> {
    let cases: BTreeSet<&str> = facts
        .stiffness
        .iter()
        .filter(|stiffness| stiffness.stiffness[axis] > 0.0)
        .map(|stiffness| stiffness.case.as_str())
        .collect();
    let case = match (wanted, &cases.iter().collect::<Vec<_>>()[..]) {
        (_, []) => return Ok(None),
        (Some(wanted), _) if cases.iter().any(|case| key(case) == key(wanted)) => wanted,
        (None, [one]) => **one,
        (_, several) => {
            let several: Vec<&str> = several.iter().map(|several| **several).collect();
            return Err(facts.fault(
                "table Story Stiffness",
                format!("depends on the load case; there are {}", several.join(", ")),
                format!(
                    "name one with --case \"{}\": the earthquake case along {}",
                    several[0],
                    ["X", "Y"][axis]
                ),
            ));
        }
    };
    let mut springs = Vec::new();
    let mut flexibility = 0.0;
    let mut floor = floors.iter().peekable();
    for story in &facts.stories {
        let is = |stiffness: &&crate::facts::StoryStiffness| {
            key(&stiffness.case) == key(case)
                && stiffness.stiffness[axis] > 0.0
                && key(&stiffness.story) == key(&story.name)
        };
        let Some(stiffness) = facts.stiffness.iter().find(is) else {
            return Err(facts.fault(
                format!(
                    "table Story Stiffness, case \"{case}\", storey \"{}\"",
                    story.name
                ),
                "has no stiffness",
                "export Story Stiffness with all storeys",
            ));
        };
        // Storeys without mass stand in series with those above.
        flexibility += 1.0 / stiffness.stiffness[axis];
        if floor
            .next_if(|floor| key(&floor.name) == key(&story.name))
            .is_some()
        {
            springs.push(1.0 / std::mem::take(&mut flexibility));
        }
    }
    if flexibility > 0.0 {
        // Above the highest floor with mass.
        springs.truncate(floors.len());
    }
    let mut block = head(facts, "shear");
    floors_of(&mut block, floors, axis);
    let _ = writeln!(
        block,
        "stiffness = {}",
        quantities(springs.iter().map(|own| own * 1e-6), "MN/m")
    );
    let remarks = vec![
        PLANE.to_owned(),
        format!(
            "storey stiffness of case \"{case}\": it depends on the load, so that periods differ by some percent; if the second one differs by more than 10 %, the building bends as a whole (walls, tall frames) and wants unit loads or modes"
        ),
    ];
    Ok(Some(Built {
        block,
        arrays: None,
        remarks,
        in_space: false,
        axis,
    }))
}
