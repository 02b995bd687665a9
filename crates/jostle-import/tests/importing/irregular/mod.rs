//! Text models that are no regular frame: their members as matrices, against OpenSees and against space frames.

use std::fmt::Write;

use jostle::System;
use jostle_import::{Direction, ImportOptions, Imported, Program, Way};
use jostle_testkit::files::sound;

use crate::book::{difference, imported, model, periods};
use crate::frames::{EXPECTED, e2k, log, out};
use crate::tables::MOTION;
use crate::workbooks::column;

/// Written by `write.py`, as is the flexibility.
const IRREGULAR: &str = include_str!("irregular.e2k");

/// Heights of floors above the datum, and their centres of mass \[m\].
const FLOORS: [[f64; 3]; 3] = [[3.0, 5.0, 4.0], [6.5, 5.2, 4.1], [10.0, 3.0, 4.0]];

/// The listing of an analysis with floors of 50 t and 250 t·m²: heights and centres of mass, in kN and m.
pub(crate) fn listing(floors: &[[f64; 3]]) -> String {
    let mut text = String::from(" ETABS\n File: model\n\n");
    for (index, [z, x, y]) in floors.iter().enumerate().rev() {
        let _ = write!(
            text,
            " {index}, CONSTR = RIGID, DOF = U1 U2 R3\n\n                     TRANSLATIONAL MASS AND MASS MOMENTS OF INERTIA\n                  U1          U2          U3          R1          R2          R3\n           50.000   50.000     .000000     .000000     .000000   250.0\n\n                     CENTER OF MASS\n  GLOBAL          U1          U2          U3\n     X      {x:.6}    {x:.6}    {x:.6}\n     Y      {y:.6}    {y:.6}    {y:.6}\n     Z     {z:.6}   {z:.6}   {z:.6}\n\n"
        );
    }
    text
}

fn irregular(options: &ImportOptions) -> Imported {
    let listing = listing(&FLOORS);
    let files = [
        ("A.e2k", IRREGULAR.as_bytes()),
        ("A.OUT", listing.as_bytes()),
    ];
    imported(Program::Etabs, &files, options)
}

/// The flexibility of a building in space, of its stiffness.
pub(crate) fn flexibility_in_space(imported: &Imported) -> Vec<Vec<f64>> {
    let system = System::assemble(&model(imported).model).expect("sound");
    let building = &system.buildings[0];
    let places = 0..3 * building.floors.len();
    places.map(|place| column(building, place)).collect()
}

/// The flexibility that stands in a model.
fn flexibility(imported: &Imported) -> Vec<Vec<f64>> {
    let (_, matrix) = imported
        .toml
        .split_once("flexibility = [")
        .expect("a matrix");
    let (_, rows) = matrix.split_once('\n').expect("rows");
    let rows = rows.lines().take_while(|line| !line.starts_with(']'));
    let number = |text: &str| text.trim().parse::<f64>().expect("a number");
    rows.map(|row| {
        row.trim()
            .trim_matches(['[', ']', ','])
            .split(',')
            .map(number)
            .collect()
    })
    .collect()
}

/// Rows of numbers between comments.
pub(crate) fn numbers(text: &str) -> Vec<Vec<f64>> {
    let lines = text.lines().filter(|line| !line.starts_with('#'));
    let number = |word: &str| word.parse().expect("a number");
    lines
        .map(|line| line.split_whitespace().map(number).collect())
        .collect()
}

fn by_opensees() -> Vec<Vec<f64>> {
    numbers(include_str!("flexibility.txt"))
}

/// Columns over two storeys, braces, hinges, pins, stiff ends, members off the axes, beams that meet between columns.
#[test]
fn an_irregular_frame_moves_as_in_opensees() {
    let imported = irregular(&ImportOptions::default());
    let (found, expected) = (flexibility_in_space(&imported), by_opensees());
    let mut worst = 0.0_f64;
    for i in 0..9 {
        for j in 0..9 {
            let size = (expected[i][i] * expected[j][j]).sqrt();
            worst = worst.max((found[i][j] - expected[i][j]).abs() / size);
        }
    }
    assert!(worst < 1e-8, "{worst:.1e}");
    assert_eq!(periods(&model(&imported), 9).len(), 9);
    let said = imported.remarks.join("\n");
    for word in [
        "not as a space frame, which could yield",
        "point \"3\" of storey \"Base\" is not fixed",
        "members with released ends",
        "connected to the end of another",
        "stiff end lengths",
    ] {
        assert!(said.contains(word), "no \"{word}\" in\n{said}");
    }
}

/// In one plane, floors still turn under a force: the same displacements.
#[test]
fn an_irregular_frame_in_one_plane() {
    let expected = by_opensees();
    for (axis, direction) in [Direction::X, Direction::Y].into_iter().enumerate() {
        let options = ImportOptions {
            direction: Some(direction),
            ..ImportOptions::default()
        };
        let found = flexibility(&irregular(&options));
        for (i, row) in found.iter().enumerate() {
            let opensee: Vec<f64> = (0..3)
                .map(|j| expected[3 * i + axis][3 * j + axis])
                .collect();
            assert!(difference(row, &opensee) < 1e-7, "{row:?} {opensee:?}");
        }
    }
}

/// Rectangles with factors and shear, turned columns, a corner that is missing: the space frame of a model file.
#[test]
fn members_of_a_regular_frame_are_the_space_frame() {
    // Lines that are straight: a space frame makes them so.
    let straight = e2k()
        .replace("6000.3 ", "6000 ")
        .replace("11000.3 ", "11000 ");
    let (text, out, log) = (straight.replace(" 0.3 ", " 0 "), out(), log());
    let files = [
        ("A.e2k", text.as_bytes()),
        ("A.OUT", out.as_bytes()),
        ("A.LOG", log.as_bytes()),
    ];
    let options = ImportOptions {
        way: Some(Way::Members),
        ..ImportOptions::default()
    };
    let imported = imported(Program::Etabs, &files, &options);
    let expected = periods(&sound(&format!("{MOTION}{EXPECTED}")), 6);
    let off = difference(&periods(&model(&imported), 6), &expected);
    // Ten digits of the matrix.
    assert!(off < 1e-8, "{off:.1e}");
}
