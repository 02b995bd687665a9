//! The tables that ETABS would print of a building in space that is known.

use jostle::system::BuildingSystem;
use jostle::{Structure, System, eigen};
use jostle_io::Input;

use crate::book::{Sheet, row};

/// Displacement of a floor in the equations: along x and across and rotation of the floors.
pub(crate) fn dof(system: &BuildingSystem, place: usize) -> usize {
    system.tracks[(place % 3) * system.floors.len() + place / 3].dof
}

/// Solves K u = unit force by Gauss' elimination.
pub(crate) fn column(system: &BuildingSystem, load: usize) -> Vec<f64> {
    let n = 3 * system.floors.len();
    let mut rows: Vec<Vec<f64>> = vec![vec![0.0; n + 1]; n];
    for place in 0..n {
        let (mut by, mut force) = (vec![0.0; n], vec![0.0; n]);
        by[dof(system, place)] = 1.0;
        system.equations.stiffness.multiply_add(&by, &mut force);
        for (row, values) in rows.iter_mut().enumerate() {
            values[place] = force[dof(system, row)];
        }
    }
    rows[load][n] = 1.0;
    for pivot in 0..n {
        let by = rows[pivot].clone();
        for (_, values) in rows.iter_mut().enumerate().filter(|(row, _)| *row != pivot) {
            let factor = values[pivot] / by[pivot];
            values
                .iter_mut()
                .zip(&by)
                .for_each(|(value, by)| *value -= factor * by);
        }
    }
    (0..n)
        .map(|place| rows[place][n] / rows[place][place])
        .collect()
}

/// Digits of a number, as a program prints them.
pub(crate) fn rounded(value: f64, digits: usize) -> f64 {
    format!("{value:.*e}", digits - 1)
        .parse()
        .expect("a number")
}

/// Columns of displacements.
pub(crate) const DISPLACEMENTS: [(&str, &str); 9] = [
    ("Story", ""),
    ("Diaphragm", ""),
    ("Output Case", ""),
    ("Case Type", ""),
    ("Step Type", ""),
    ("Step Number", ""),
    ("UX", "mm"),
    ("UY", "mm"),
    ("RZ", "rad"),
];
/// Columns of masses, whose units differ within a row.
pub(crate) const MASSES: [(&str, &str); 7] = [
    ("Story", ""),
    ("Diaphragm", ""),
    ("Mass X", "kg"),
    ("Mass Y", "kg"),
    ("Mass Moment of Inertia", "ton-m²"),
    ("X Mass Center", "m"),
    ("Y Mass Center", "m"),
];

/// Storeys, masses, joints, loads of 1000 kN and 1000 kN·m, displacements to so many digits, and modes.
pub(crate) fn tables_of(input: &Input, digits: usize) -> Vec<Sheet> {
    let system = System::assemble(&input.model).expect("sound");
    let building = &system.buildings[0];
    let Structure::Tiers(tiers) = &input.model.buildings[0].structure else {
        panic!("a building with a plan")
    };
    let floors = building.floors.len();
    let name = |floor: usize| format!("Story{}", floor + 1);
    let [
        mut stories,
        mut mass,
        mut joints,
        mut loads,
        mut rows,
        mut modes,
    ] = [const { Vec::new() }; 6];
    for floor in (0..floors).rev() {
        stories.push(row(
            &["T1", &name(floor)],
            &[rounded(tiers.storey_heights[floor] * 1e3, 9)],
        ));
        let [x, y] = building.discretization.centres[floor];
        let [m, _, j] = [0, 1, 2]
            .map(|component| building.equations.mass[dof(building, 3 * floor + component)]);
        mass.push(row(
            &[&name(floor), "D1"],
            &[rounded(m, 10), rounded(m, 10), rounded(j * 1e-3, 10), x, y],
        ));
        let mut z = 0.0;
        for storey in &tiers.storey_heights[..=floor] {
            z += storey;
        }
        for [x, y] in &tiers.floors[floor].plan {
            joints.push(row(
                &[&name(floor), "1", "Joint", "2"],
                &[*x, *y, rounded(z, 9)],
            ));
        }
    }
    for [x, y] in &tiers.floors[0].plan {
        joints.push(row(&["Base", "1", "Joint", "2"], &[*x, *y, 0.0]));
    }
    for load in 0..3 * floors {
        let case = format!("{} {}", ["PX", "PY", "T"][load % 3], load / 3 + 1);
        let mut sizes = [0.0; 3];
        sizes[load % 3] = 1e3;
        loads.push(row(&[&case, &name(load / 3), "D1"], &sizes));
        let by = column(building, load);
        for floor in (0..floors).rev() {
            let by = [1e9, 1e9, 1e6]
                .iter()
                .enumerate()
                .map(|(component, factor)| rounded(by[3 * floor + component] * factor, digits));
            let by: Vec<f64> = by.collect();
            rows.push(row(&[&name(floor), "D1", &case, "LinStatic", "", ""], &by));
        }
    }
    for (index, mode) in eigen::modes(building.alone(), 3 * floors)
        .expect("modes")
        .iter()
        .enumerate()
    {
        let shares = [
            mode.effective_mass_ratio_x,
            mode.effective_mass_ratio_across,
        ];
        let [x, y] = shares.map(|share| if share < 1e-9 { 0.0 } else { rounded(share, 4) });
        modes.push(row(
            &["Modal"],
            &[index as f64 + 1.0, rounded(mode.period(), 4), x, y],
        ));
    }
    let joint_columns = [
        ("Story", ""),
        ("Element Label", ""),
        ("Object Type", ""),
        ("Object Label", ""),
        ("Global X", "m"),
        ("Global Y", "m"),
        ("Global Z", "m"),
    ];
    let load_columns = [
        ("Load Pattern", ""),
        ("Story", ""),
        ("Diaphragm", ""),
        ("Fx", "kN"),
        ("Fy", "kN"),
        ("Mz", "kN-m"),
    ];
    let mode_columns = [
        ("Case", ""),
        ("Mode", ""),
        ("Period", "sec"),
        ("UX", ""),
        ("UY", ""),
    ];
    vec![
        Sheet::new(
            "Story Definitions",
            &[("Tower", ""), ("Name", ""), ("Height", "mm")],
            stories,
        ),
        Sheet::new("Objects and Elements - Joints", &joint_columns, joints),
        Sheet::new("Mass Summary by Diaphragm", &MASSES, mass),
        Sheet::new(
            "Load Pattern Definitions - Auto Seismic - User Loads",
            &load_columns,
            loads,
        ),
        Sheet::new(
            "Diaphragm Center of Mass Displacements",
            &DISPLACEMENTS,
            rows,
        ),
        Sheet::new("Modal Participating Mass Ratios", &mode_columns, modes),
    ]
}
