//! A space frame through a model file, against members of 6 degrees of freedom assembled by other programs.

use jostle::linear::StepMatrix;
use jostle::structure::solve_once;
use jostle::{RiccatiSweep, System};
use serde_json::Value;

use crate::data::{at, document, list, number, numbers};
use crate::files::model;
use crate::row::Row;

const MODEL: &str = include_str!("../data/space/S8_space_frame.toml");

/// Both references agree with OpenSees to 2·10⁻¹⁴; what is left is the rounding of the condensation.
const EXACT: f64 = 1e-12;

/// Rotations of 10⁻⁵ beside displacements of 10⁻³ m; couplings that nearly cancel.
const COUPLED: f64 = 1e-11;

/// All rows of this family.
#[must_use]
pub fn rows() -> Vec<Row> {
    let mut rows = Vec::new();
    for (name, text, shear) in [
        (
            "space/S8a_space_frame",
            include_str!("../data/space/S8a_space_frame.json"),
            "shear = \"rigid\"",
        ),
        (
            "space/S8b_space_frame_shear",
            include_str!("../data/space/S8b_space_frame_shear.json"),
            "shear = \"flexible\"",
        ),
    ] {
        let replace = MODEL.replace("shear = \"rigid\"", shear);
        rows.extend(compare(name, &replace, &document(text)));
    }
    rows
}

fn compare(name: &str, text: &str, case: &Value) -> Vec<Row> {
    let input = model(text);
    let system = System::assemble(&input.model).expect("a sound model");
    let building = &system.buildings[0];
    let expected = at(case, "/expected");
    let mut rows = Vec::new();
    let periods: Vec<f64> = building
        .modes
        .iter()
        .map(jostle::eigen::Mode::period)
        .collect();
    rows.push(Row::worst_of(
        name,
        "periods [s]",
        &numbers(expected, "/periods_s"),
        &periods,
        EXACT,
    ));
    type Ratio = fn(&jostle::eigen::Mode) -> f64;
    let ratios: [(&str, &str, Ratio); 2] = [
        ("x", "along x", |mode| mode.effective_mass_ratio_x),
        ("y", "across", |mode| mode.effective_mass_ratio_across),
    ];
    for (key, direction, of) in ratios {
        rows.push(Row::worst_of(
            name,
            format!("effective masses {direction} over the mass"),
            &numbers(expected, &format!("/effective_mass_ratio_{key}")),
            &building.modes.iter().map(of).collect::<Vec<f64>>(),
            COUPLED,
        ));
    }
    // u_x, u_y and θ, floor by floor.
    let n = building.floors.len();
    let dof = |place: usize| building.tracks[(place % 3) * n + place / 3].dof;
    let stored = list(expected, "/condensed_floor_stiffness");
    // Forces per displacement, couplings with rotations, and torques per rotation.
    let mut parts = [const { (Vec::new(), Vec::new()) }; 3];
    for (column, stored) in stored.iter().enumerate() {
        let mut unit = vec![0.0; building.equations.len()];
        unit[dof(column)] = 1.0;
        let mut force = vec![0.0; unit.len()];
        building.equations.stiffness.multiply_add(&unit, &mut force);
        for (row, wanted) in numbers(stored, "").into_iter().enumerate() {
            let turns = |place: usize| usize::from(place % 3 == 2);
            let (expected, got) = &mut parts[turns(row) + turns(column)];
            expected.push(wanted);
            got.push(force[dof(row)]);
        }
    }
    for ((wanted, got), what) in parts.iter().zip([
        "forces per displacement [N/m]",
        "torques per displacement [N]",
        "torques per rotation [N·m]",
    ]) {
        let what = format!("condensed stiffness, {what}");
        rows.push(Row::worst_of(name, what, wanted, got, EXACT));
    }
    for (index, stored) in list(expected, "/static").iter().enumerate() {
        let mut load = vec![0.0; building.equations.len()];
        for floor in 0..n {
            let Some(forces) = at(stored, "/loads").get((floor + 1).to_string()) else {
                continue;
            };
            for (component, force) in numbers(forces, "").iter().enumerate() {
                load[dof(3 * floor + component)] = *force;
            }
        }
        let answer =
            solve_once::<RiccatiSweep>(building, &StepMatrix::STATIC, &load).expect("it stands");
        let wanted = numbers(stored, "/displacement");
        for (what, components) in [("displacements", 0..2), ("rotations", 2..3)] {
            let places = (0..3 * n).filter(|place| components.contains(&(place % 3)));
            let places: Vec<usize> = places.collect();
            let of = |of: &dyn Fn(usize) -> f64| -> Vec<f64> {
                places.iter().map(|place| of(*place)).collect()
            };
            rows.push(Row::worst_of(
                name,
                format!("{what} under loads {}", index + 1),
                &of(&|place| wanted[place]),
                &of(&|place| answer[dof(place)]),
                COUPLED,
            ));
        }
    }
    debug_assert!(number(case, "/tolerance/relative") >= COUPLED);
    rows
}
