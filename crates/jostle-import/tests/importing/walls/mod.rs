//! Walls of text models as wide columns: against closed forms, and against shells of OpenSees.

use std::fmt::Write;

use jostle_import::{ImportOptions, Imported, Program};

use crate::book::{imported, tried};
use crate::irregular::{flexibility_in_space, listing, numbers};

fn building(text: &str, floors: &[[f64; 3]]) -> Imported {
    let listing = listing(floors);
    let files = [("A.e2k", text.as_bytes()), ("A.OUT", listing.as_bytes())];
    imported(Program::Etabs, &files, &ImportOptions::default())
}

/// The greatest difference on the diagonal, and beside it in parts of √(F_ii F_jj).
fn differences(found: &[Vec<f64>], expected: &[Vec<f64>]) -> [f64; 2] {
    let mut worst = [0.0_f64; 2];
    for i in 0..expected.len() {
        for j in 0..expected.len() {
            let size = (expected[i][i] * expected[j][j]).sqrt();
            let off = (found[i][j] - expected[i][j]).abs() / size;
            let greatest = &mut worst[usize::from(i != j)];
            *greatest = greatest.max(off);
        }
    }
    worst
}

/// A wall of one panel a storey: H³/3EI + H/GA along it. Its factors and thickness are those of its property, or of its areas.
#[test]
fn a_wall_is_a_cantilever() {
    let property =
        "WALLTHICKNESS 0.25\n  SHELLPROP \"W\" F22MOD 0.5 F12MOD 0.4 M22MOD 1E-4 M12MOD 1E-4";
    cantilever(property, "PANEL", "");
    let half = "WALLTHICKNESS 0.1\n  SHELLPROP \"W\" F22MOD 2 F12MOD 0.4";
    let own = "AREATHICKNESSOVERWRITE 0.25 0.25 0.25 0.25 PROPMODF22 0.25 PROPMODM22 1E-4 PROPMODM12 1E-4";
    cantilever(half, "PANEL", own);
    cantilever(half, "AREA", own);
    let opening = building_of_walls(property, "PANEL", "OPENING \"Yes\"");
    let error = tried(
        Program::Etabs,
        &[("A.e2k", opening.as_bytes())],
        &ImportOptions::default(),
    );
    let error = error.map(|found| found.toml).expect_err("an opening");
    assert!(
        error.contains("wall \"W1\" of storey \"S1\"") && error.contains("is an opening in a wall"),
        "{error}"
    );
    let uneven = building_of_walls(property, "PANEL", "AREATHICKNESSOVERWRITE 0.25 0.3");
    let error = tried(
        Program::Etabs,
        &[("A.e2k", uneven.as_bytes())],
        &ImportOptions::default(),
    );
    let error = error
        .map(|found| found.toml)
        .expect_err("a thickness that changes");
    assert!(error.contains("thickness that changes"), "{error}");
}

const STOREYS: usize = 6;
const HEIGHT: f64 = 3.0;

fn building_of_walls(property: &str, drawn: &str, own: &str) -> String {
    let (storeys, height) = (STOREYS, HEIGHT);
    let mut text =
        String::from("$ CONTROLS\n  UNITS \"N\" \"M\" \"C\"\n$ STORIES - IN SEQUENCE FROM TOP\n");
    for story in (1..=storeys).rev() {
        let _ = writeln!(text, "  STORY \"S{story}\" HEIGHT {height}");
    }
    text += &format!(
        "  STORY \"Base\" ELEV 0\n$ DIAPHRAGM NAMES\n  DIAPHRAGM \"D1\" TYPE RIGID\n$ MATERIAL PROPERTIES\n  MATERIAL \"C\" TYPE \"Concrete\"\n  MATERIAL \"C\" E 3E10 U 0.2\n$ WALL PROPERTIES\n  SHELLPROP \"W\" PROPTYPE \"Wall\" MATERIAL \"C\" MODELINGTYPE \"ShellThin\" {property}\n$ POINT COORDINATES\n  POINT \"1\" 0 0\n  POINT \"2\" 3 4\n  POINT \"3\" 8 0\n  POINT \"4\" 8 5\n$ AREA CONNECTIVITIES\n  AREA \"W1\" {drawn} 4 \"1\" \"2\" \"2\" \"1\" 1 1 0 0\n  AREA \"W2\" {drawn} 4 \"3\" \"4\" \"4\" \"3\" 1 1 0 0\n$ POINT ASSIGNS\n"
    );
    for point in 1..=4 {
        let _ = writeln!(
            text,
            "  POINTASSIGN \"{point}\" \"Base\" RESTRAINT \"UX UY UZ RX RY RZ\""
        );
    }
    text += "$ AREA ASSIGNS\n";
    for story in 1..=storeys {
        for wall in ["W1", "W2"] {
            let _ = writeln!(
                text,
                "  AREAASSIGN \"{wall}\" \"S{story}\" SECTION \"W\" {own}"
            );
        }
    }
    text
}

#[track_caller]
fn cantilever(property: &str, drawn: &str, own: &str) {
    let (storeys, height, length, thickness) = (STOREYS, HEIGHT, 5.0_f64, 0.25_f64);
    let text = building_of_walls(property, drawn, own);
    let centre = |story: usize| [height * story as f64, 4.0, 2.5];
    let floors: Vec<[f64; 3]> = (1..=storeys).map(centre).collect();
    let imported = building(&text, &floors);
    let found = flexibility_in_space(&imported);
    let bend = 0.5 * 3e10 * thickness * length.powi(3) / 12.0;
    let shear = 0.4 * 5.0 / 6.0 * 3e10 / 2.4 * length * thickness;
    // Along X, only the wall that is turned acts, by 0.6² of its stiffness; across walls have next to none here.
    let alone = |story: usize| {
        let h = height * story as f64;
        h.powi(3) / (3.0 * bend) + h / shear
    };
    let roof = storeys - 1;
    let [x, y, turn] = [3 * roof, 3 * roof + 1, 3 * roof + 2];
    // Stiffness of the roof alone, if nothing else moves, is that of the walls: by the flexibility of the floor.
    let f = |i: usize, j: usize| found[i][j];
    let determinant = f(x, x) * (f(y, y) * f(turn, turn) - f(y, turn).powi(2))
        - f(x, y) * (f(x, y) * f(turn, turn) - f(y, turn) * f(x, turn))
        + f(x, turn) * (f(x, y) * f(y, turn) - f(y, y) * f(x, turn));
    let stiffness_x = (f(y, y) * f(turn, turn) - f(y, turn).powi(2)) / determinant;
    let expected = 0.36 / alone(storeys);
    assert!(
        (stiffness_x / expected - 1.0).abs() < 1e-5,
        "{stiffness_x} {expected}"
    );
}

/// Cores that warp, a core closed by beams, and coupled walls. Shells of a third of a metre are themselves within 2 % (coupled) and 4 %
/// (core). The first storey is least like a beam.
#[test]
fn cores_and_coupled_walls_are_near_to_shells() {
    for (name, text, expected, storeys, centre) in [
        (
            "coupled",
            include_str!("coupled.e2k"),
            include_str!("coupled.txt"),
            5,
            [4.0, 3.0],
        ),
        (
            "core",
            include_str!("core.e2k"),
            include_str!("core.txt"),
            6,
            [2.0, 2.5],
        ),
        (
            "closed",
            include_str!("closed.e2k"),
            include_str!("closed.txt"),
            6,
            [2.0, 2.5],
        ),
    ] {
        let [x, y] = centre;
        let floors: Vec<[f64; 3]> = (1..=storeys)
            .map(|story| [3.0 * f64::from(story), x, y])
            .collect();
        let imported = building(text, &floors);
        let (found, expected) = (flexibility_in_space(&imported), numbers(expected));
        let [difference, beside] = differences(&found, &expected);
        assert!(
            difference < 0.12 && beside < 0.07,
            "{name}: {difference:.3} {beside:.3}"
        );
        for place in 3 * (storeys as usize - 1)..3 * storeys as usize {
            let off = found[place][place] / expected[place][place] - 1.0;
            assert!(off.abs() < 0.07, "{name}, {place}: {off:.3}");
        }
        assert!(
            imported
                .remarks
                .iter()
                .any(|difference| difference.contains("wide columns")),
            "{:?}",
            imported.remarks
        );
    }
}
