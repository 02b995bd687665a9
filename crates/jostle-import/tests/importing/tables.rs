//! Result workbooks: storey stiffness, flexibility in plane and in space, modes.

use jostle::System;
use jostle::eigen;
use jostle_import::{Direction, ImportOptions, Program, Way};
use jostle_io::Input;
use jostle_testkit::files::sound;
use jostle_testkit::runs::run_and_summary;

use crate::book::{Layout, Sheet, book, difference, imported, model, periods, row};
use crate::workbooks::{DISPLACEMENTS, MASSES, column, dof, rounded, tables_of};

const FLOORS: usize = 10;
/// Of a building of ten storeys \[N/m\].
const STIFFNESS: [f64; FLOORS] = [14e7, 14e7, 13e7, 12e7, 12e7, 11e7, 10e7, 9e7, 8e7, 6e7];
/// \[kg\]
const MASS: f64 = 8e4;

pub(crate) const MOTION: &str =
    "[motion]\nrecord = \"el-centro-1940-ns\"\npga = \"0.3 g\"\nduration = \"8 s\"\n";

fn storeys() -> String {
    format!(
        "[[building]]\nname = \"A\"\nkind = \"shear\"\nstorey_height = \"3 m\"\nstoreys = {FLOORS}\nmass = {MASS}\nstiffness = {STIFFNESS:?}\n"
    )
}

fn name(floor: usize) -> String {
    format!("Story{}", floor + 1)
}

/// Storeys from the top down, in mm.
pub(crate) fn definitions(floors: usize) -> Sheet {
    let rows = (0..floors)
        .rev()
        .map(|floor| row(&["T1", &name(floor)], &[3000.0]))
        .collect();
    Sheet::new(
        "Story Definitions",
        &[("Tower", ""), ("Name", ""), ("Height", "mm")],
        rows,
    )
}

/// Masses in kg beside inertias in ton-m².
pub(crate) fn masses(floors: usize) -> Sheet {
    let rows = (0..floors)
        .rev()
        .map(|floor| row(&[&name(floor), "D1"], &[MASS, MASS, 500.0, 4.0, 3.0]))
        .collect();
    Sheet::new("Mass Summary by Diaphragm", &MASSES, rows)
}

fn story_stiffness(names: [&'static str; 2]) -> Sheet {
    let rows = (0..FLOORS)
        .rev()
        .map(|floor| {
            row(
                &[&name(floor), "EX", "LinStatic"],
                &[STIFFNESS[floor] * 1e-3, 1.0],
            )
        })
        .collect();
    Sheet::new(
        "Story Stiffness",
        &[
            ("Story", ""),
            ("Output Case", ""),
            ("Case Type", ""),
            (names[0], "kN/m"),
            (names[1], "kN/m"),
        ],
        rows,
    )
}

fn along_x() -> ImportOptions {
    ImportOptions {
        direction: Some(Direction::X),
        stem: "a".into(),
        ..ImportOptions::default()
    }
}

/// Displacements of the ten storeys under 1000 kN at every floor.
fn unit_forces(digits: usize) -> Sheet {
    let mut rows = Vec::new();
    for floor in (0..FLOORS).rev() {
        for force in 0..FLOORS {
            let by: f64 = STIFFNESS[..=floor.min(force)].iter().map(|k| 1.0 / k).sum();
            let case = format!("FX {}", name(force));
            rows.push(row(
                &[&name(floor), "D1", &case, "LinStatic", "", ""],
                &[rounded(by * 1e6 * 1e3, digits), 0.0, 0.0],
            ));
        }
    }
    Sheet::new(
        "Diaphragm Center Of Mass Displacements",
        &DISPLACEMENTS,
        rows,
    )
}

fn unit() -> ImportOptions {
    ImportOptions {
        unit_force: Some(1e6),
        ..along_x()
    }
}

fn expected(count: usize) -> Vec<f64> {
    periods(&sound(&format!("{MOTION}{}", storeys())), count)
}

/// The same shear building in the three layouts, with blanks and cases of names that vary, and with decimal commas.
#[test]
fn storey_stiffnesses_are_the_shear_building_in_every_layout() {
    let expected = expected(FLOORS);
    for (layout, names, commas) in [
        (Layout::Titled, ["Stiff X", "Stiff Y"], false),
        (Layout::Quoted, ["StiffX", "StiffY"], true),
        (Layout::Titled, ["STIFF X", "stiff y"], true),
    ] {
        let bytes = book(
            &[story_stiffness(names), masses(FLOORS), definitions(FLOORS)],
            layout,
            commas,
        );
        let found = imported(Program::Etabs, &[("A.xlsx", &bytes)], &along_x());
        let off = difference(&periods(&model(&found), FLOORS), &expected);
        assert!(off < 1e-9, "{layout:?}: {off:.1e}");
    }
    // Without units in the file they are stated: kN and m, so mass in t and inertia in t·m².
    let mut sheets = [
        story_stiffness(["Stiff X", "Stiff Y"]),
        masses(FLOORS),
        definitions(FLOORS),
    ];
    for (sheet, columns, factor) in [(1, 2..4, 1e-3), (2, 2..3, 1e-3)] {
        for row in &mut sheets[sheet].rows {
            for cell in &mut row[columns.clone()] {
                *cell = (cell.parse::<f64>().expect("a number") * factor).to_string();
            }
        }
    }
    sheets[2].columns.push(("Similar To", ""));
    let bytes = book(&sheets, Layout::Bare, false);
    let options = ImportOptions {
        units: Some("kN, m, C".into()),
        ..along_x()
    };
    let found = imported(Program::Etabs, &[("A.xlsx", &bytes)], &options);
    let off = difference(&periods(&model(&found), FLOORS), &expected);
    assert!(off < 1e-9, "{off:.1e}");
}

/// Ten digits of the displacements under unit loads are the building; five move its periods by 0.07 % at most.
#[test]
fn unit_forces_are_the_building() {
    let expected = expected(FLOORS);
    for (digits, allowed) in [(12, 1e-6), (5, 7e-4)] {
        let bytes = book(
            &[definitions(FLOORS), masses(FLOORS), unit_forces(digits)],
            Layout::Titled,
            false,
        );
        let found = imported(Program::Etabs, &[("A.xlsx", &bytes)], &unit());
        let off = difference(&periods(&model(&found), FLOORS), &expected);
        assert!(off < allowed, "{digits} digits: {off:.1e}");
    }
}

/// Modes of the ten storeys along X beside modes along Y, in units of the workbook.
fn modes(count: usize) -> Vec<Sheet> {
    let system = System::assemble(&sound(&format!("{MOTION}{}", storeys())).model).expect("sound");
    let modes = eigen::modes(system.buildings[0].alone(), count).expect("modes");
    let mut rows = Vec::new();
    let mut table = Vec::new();
    for (index, mode) in modes.iter().enumerate() {
        let period = std::f64::consts::TAU / mode.circular_frequency;
        // Odd modes of the source are those along Y.
        for (step, axis) in [(2 * index + 1, 1), (2 * index + 2, 0)] {
            let factor = if axis == 0 { 1.0 } else { 1.01 };
            table.push(row(&["Modal"], &[step as f64, period * factor]));
            for floor in 0..FLOORS {
                let mut by = [0.0; 3];
                by[axis] = mode.floors[floor] * 1e3;
                rows.push(row(
                    &[
                        &name(floor),
                        "D1",
                        "Modal",
                        "LinModEigen",
                        "Mode",
                        &step.to_string(),
                    ],
                    &by,
                ));
            }
        }
    }
    vec![
        Sheet::new(
            "Modal Periods And Frequencies",
            &[("Case", ""), ("Mode", ""), ("Period", "sec")],
            table,
        ),
        Sheet::new(
            "Diaphragm Center Of Mass Displacements",
            &DISPLACEMENTS,
            rows,
        ),
    ]
}

/// The building beside one of five storeys.
fn force_of_pair(building: &str) -> f64 {
    let pair = format!(
        "{building}\n[[building]]\nname = \"B\"\nkind = \"shear\"\nstoreys = 5\nmass = \"60 t\"\nstiffness = \"160 MN/m\"\nstorey_height = \"3 m\"\n[[gap]]\nbetween = [\"A\", \"B\"]\nwidth = \"30 mm\"\nlaw = \"kelvin\"\nstiffness = \"500 MN/m\"\nrestitution = 0.65\n[analysis]\ntolerance = 1e-5\n"
    );
    let input = sound(&pair);
    let motion = input.ground_motion().expect("built in");
    run_and_summary(&input.model, &motion).2.gaps[0].peak_force_n
}

/// With the displacement under one unit load, five modes find the contact force to 1.5 % and seven to 0.2 %.
#[test]
fn modes_are_the_building_as_far_as_they_go() {
    let all = expected(FLOORS);
    // Damped as the source damps its modes.
    let damped = storeys().replacen(
        "kind =",
        "damping = { ratio = 0.05, modes = \"all\" }\nkind =",
        1,
    );
    let whole = force_of_pair(&format!("{MOTION}{damped}"));
    for (count, allowed) in [(5, 0.015), (7, 0.002)] {
        let mut sheets = vec![definitions(FLOORS), masses(FLOORS)];
        sheets.extend(modes(count));
        let mut hit = unit_forces(12);
        hit.rows.retain(|row| row[2] == "FX Story5");
        sheets[3].rows.extend(hit.rows);
        let bytes = book(&sheets, Layout::Titled, false);
        let found = imported(Program::Etabs, &[("A.xlsx", &bytes)], &unit());
        assert!(found.toml.contains("contact_floor = 5"), "{}", found.toml);
        let off = difference(&periods(&model(&found), count), &all[..count]);
        assert!(off < 1e-6, "{count} modes: {off:.1e}");
        let split_once = found
            .toml
            .split("[motion]")
            .nth(1)
            .and_then(|text| text.split_once("[[building]]"))
            .expect("a building")
            .1;
        let off = force_of_pair(&format!("{MOTION}[[building]]{split_once}")) / whole - 1.0;
        assert!(off.abs() < allowed, "{count} modes: {off:.2e}");
    }
}

const FRAME: &str = r#"
[[building]]
name = "A"
kind = "space-frame"
lines_x = ["0 m", "6 m", "11 m"]
lines_y = ["0 m", "5 m", "9 m"]
storey_height = ["4 m", "3.2 m", "3.2 m"]
mass = ["95 t", "92 t", "80 t"]
mass_centre = [["5.5 m", "4.5 m"], ["5.4 m", "4.6 m"], ["5.5 m", "4.5 m"]]
elastic_modulus = "30 GPa"
beam_x = { width = "0.3 m", depth = "0.6 m" }
beam_y = { width = "0.3 m", depth = "0.5 m" }
[[building.column]]
size = ["0.5 m", "0.5 m"]
[[building.column]]
x = 1
y = 2
size = ["0.5 m", "0.8 m"]
"#;

/// An asymmetric frame by a unit force along X, one along Y and a unit moment at every floor: torsion included. Storeys follow from
/// the heights of joints where no table has them. Five digits move no period by more than 0.07 %.
#[test]
fn unit_loads_are_the_building_in_space() {
    let input = sound(&format!("{MOTION}{FRAME}"));
    let options = ImportOptions {
        stem: "a".into(),
        ..ImportOptions::default()
    };
    for (digits, skipped, allowed) in [(12, 0, 1e-6), (12, 1, 1e-6), (5, 0, 7e-4)] {
        let sheets = &tables_of(&input, digits)[skipped..];
        let bytes = book(sheets, Layout::Titled, false);
        let found = imported(Program::Etabs, &[("A.xlsx", &bytes)], &options);
        let off = difference(&periods(&model(&found), 9), &periods(&input, 9));
        assert!(off < allowed, "{digits} digits: {off:.1e}\n{}", found.toml);
        // In plane along y: the same stiffness, floors free to turn without inertia.
        let found = imported(
            Program::Etabs,
            &[("A.xlsx", &bytes)],
            &ImportOptions {
                direction: Some(Direction::Y),
                ..options.clone()
            },
        );
        assert!(
            found.toml.contains("dof = 3") && !found.toml.contains("plan ="),
            "{}",
            found.toml
        );
    }
}

/// The tables of a building in space with so many of its modes in place of unit loads.
fn modes_in_space(input: &Input, count: usize) -> Vec<u8> {
    book(&sheets_of_modes(input, count), Layout::Titled, false)
}

fn sheets_of_modes(input: &Input, count: usize) -> Vec<Sheet> {
    let mut sheets = tables_of(input, 12);
    let system = System::assemble(&input.model).expect("sound");
    let building = &system.buildings[0];
    let (mut rows, mut table) = (Vec::new(), Vec::new());
    for (index, mode) in eigen::modes(building.alone(), count)
        .expect("modes")
        .iter()
        .enumerate()
    {
        let step = (index + 1).to_string();
        table.push(row(
            &["Modal"],
            &[index as f64 + 1.0, rounded(mode.period(), 12)],
        ));
        for floor in 0..building.floors.len() {
            // mm, mm, rad.
            let by = [1e3, 1e3, 1.0].iter().enumerate();
            let by: Vec<f64> = by
                .map(|(component, unit)| {
                    rounded(unit * mode.shape[dof(building, 3 * floor + component)], 12)
                })
                .collect();
            let name = format!("Story{}", floor + 1);
            rows.push(row(
                &[&name, "D1", "Modal", "LinModEigen", "Mode", &step],
                &by,
            ));
        }
    }
    sheets.truncate(3);
    sheets.push(Sheet::new(
        "Diaphragm Center of Mass Displacements",
        &DISPLACEMENTS,
        rows,
    ));
    let columns = [("Case", ""), ("Mode", ""), ("Period", "sec")];
    sheets.push(Sheet::new("Modal Periods And Frequencies", &columns, table));
    sheets
}

/// All modes of an eccentric frame are the frame; some of them keep their periods, and give way under a force about as it does.
#[test]
fn modes_that_turn_are_the_building_in_space() {
    let input = sound(&format!("{MOTION}{FRAME}"));
    let way = ImportOptions {
        way: Some(Way::Modes),
        ..ImportOptions::default()
    };
    for (count, options) in [
        (9, &ImportOptions::default()),
        (9, &way),
        (6, &way),
        (4, &way),
    ] {
        let bytes = modes_in_space(&input, count);
        let found = imported(Program::Etabs, &[("A.xlsx", &bytes)], options);
        let off = difference(&periods(&model(&found), count), &periods(&input, count));
        assert!(off < 1e-8, "{count} modes: {off:.1e}");
        let [column, all] = [&model(&found), &input].map(|input| {
            let system = System::assemble(&input.model).expect("sound");
            let building = &system.buildings[0];
            [0, 3, 6].map(|place| column(building, place)[place])
        });
        let off = difference(&column, &all);
        let allowed = if count == 9 { 1e-7 } else { 0.01 };
        assert!(count < 6 || off < allowed, "{count} modes: {off:.1e}");
    }
    let bytes = modes_in_space(&input, 2);
    let error =
        crate::book::tried(Program::Etabs, &[("A.xlsx", &bytes)], &way).expect_err("no torsion");
    assert!(
        error.contains("no mode is one of torsion") && error.contains("more modes"),
        "{error}"
    );
}

/// Two workbooks are a pair with a gap, which runs.
#[test]
fn two_workbooks_are_a_pair() {
    let bytes = book(
        &[
            story_stiffness(["Stiff X", "Stiff Y"]),
            masses(FLOORS),
            definitions(FLOORS),
        ],
        Layout::Titled,
        false,
    );
    let options = ImportOptions {
        gap: Some(0.05),
        ..along_x()
    };
    let files: [(&str, &[u8]); 2] = [("A.xlsx", &bytes), ("B.xlsx", &bytes)];
    let found = imported(Program::Etabs, &files, &options);
    let input = model(&found);
    assert_eq!(input.model.buildings.len(), 2);
    assert!(found.toml.contains("width = \"50 mm\""), "{}", found.toml);
    let error = crate::book::tried(Program::Etabs, &files, &along_x()).expect_err("no gap");
    assert!(error.contains("--gap"), "{error}");
}

/// Rows in another order, of another diaphragm and of another case.
#[test]
fn rows_of_tables_are_those_that_are_meant() {
    let input = sound(&format!("{MOTION}{FRAME}"));
    let expected = periods(&input, 9);
    let tried = |sheets: &[Sheet], options: &ImportOptions| {
        let bytes = book(sheets, Layout::Titled, false);
        crate::book::tried(Program::Etabs, &[("A.xlsx", &bytes)], options)
    };
    let is_the_frame = |found: Result<jostle_import::Imported, String>| {
        let found = found.unwrap_or_else(|error| panic!("{error}"));
        let off = difference(&periods(&model(&found), 9), &expected);
        assert!(off < 1e-6, "{off:.1e}");
    };
    let plain = ImportOptions::default();
    // Storeys from the ground up: by elevations, or refused by the heights of their joints.
    let mut sheets = tables_of(&input, 12);
    let is = |title: &'static str| {
        move |sheet: &&mut Sheet| sheet.title.to_lowercase().starts_with(title)
    };
    let mut stories = sheets
        .iter_mut()
        .find(is("story definitions"))
        .expect("storeys");
    stories.rows.reverse();
    let error = tried(&sheets, &plain).expect_err("upside down");
    assert!(error.contains("its joints are lower"), "{error}");
    stories = sheets
        .iter_mut()
        .find(is("story definitions"))
        .expect("storeys");
    stories.columns.push(("Elevation", "mm"));
    let mut z = 0.0;
    for row in &mut stories.rows {
        z += row[2].parse::<f64>().expect("a height");
        row.push(z.to_string());
    }
    is_the_frame(tried(&sheets, &plain));
    let stories = sheets
        .iter_mut()
        .find(is("story definitions"))
        .expect("storeys");
    stories.rows[1][2] = "100".into();
    let error = tried(&sheets, &plain).expect_err("heights that do not fit");
    assert!(error.contains("by its elevation"), "{error}");
    // Displacements of another diaphragm first, twice as large.
    let mut sheets = tables_of(&input, 12);
    let moved = sheets
        .iter_mut()
        .find(is("diaphragm center"))
        .expect("displacements");
    let mut others = moved.rows.clone();
    for row in &mut others {
        row[1] = "D2".into();
        for cell in &mut row[6..9] {
            *cell = (2.0 * cell.parse::<f64>().expect("a number")).to_string();
        }
    }
    others.append(&mut moved.rows);
    moved.rows = others;
    is_the_frame(tried(&sheets, &plain));
    let mass = sheets.iter_mut().find(is("mass summary")).expect("masses");
    for row in &mut mass.rows {
        row[1] = "D3".into();
    }
    let error = tried(&sheets, &plain).expect_err("masses of a third");
    assert!(
        error.contains("d1 and d2") && error.contains("--diaphragm"),
        "{error}"
    );
    // Modes of two cases, the other softer.
    let mut sheets = sheets_of_modes(&input, 9);
    for title in ["diaphragm center", "modal periods"] {
        let sheet = sheets.iter_mut().find(is(title)).expect("modes");
        let mut others = sheet.rows.clone();
        for row in &mut others {
            for cell in row.iter_mut().filter(|cell| *cell == "Modal") {
                *cell = "Soft".into();
            }
            if title == "modal periods" {
                row[2] = (1.3 * row[2].parse::<f64>().expect("a period")).to_string();
            }
        }
        sheet.rows.append(&mut others);
    }
    let way = ImportOptions {
        way: Some(Way::Modes),
        ..plain
    };
    let error = tried(&sheets, &way).expect_err("two cases");
    assert!(
        error.contains("several cases, Modal, Soft") && error.contains("--case"),
        "{error}"
    );
    is_the_frame(tried(
        &sheets,
        &ImportOptions {
            case: Some("modal".into()),
            ..way
        },
    ));
}
