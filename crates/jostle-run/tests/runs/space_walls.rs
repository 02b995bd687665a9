//! Walls of space frames: what they bear, against walls of frames at lines of a plan, and what a check says of them.

use jostle::results::summary::PartSummary;
use jostle_run::{Opened, Ran, check};
use jostle_testkit::files::sound;

use crate::support::ran;

const COMMON: &str =
    "storey_height = [4.0, 3.2, 3.2]\nmass = \"70 t\"\ndamping = { alpha = 0.3, beta = 0.002 }\n";
const BEAM: &str = "width = 0.3, depth = 0.6";

fn shaken(more: &str, building: &str) -> Ran {
    ran(&format!(
        "[motion]\nrecord = \"el-centro-1940-ns\"\npga = \"0.3 g\"\nduration = \"5 s\"\n{more}\n[analysis]\nsolver = \"riccati\"\nstep = \"2 ms\"\naccept_unusual = true\n[[building]]\nname = \"A\"\n{COMMON}{building}"
    ))
}

/// Two equal frames at lines of a plan, each with a wall at its first line, beside springs across.
fn at_lines(base: &str) -> Ran {
    let building = format!(
        "{base}kind = \"frame\"\nplan = [12, 7]\n[[building.element]]\nat = [6, 3.5]\nstiffness = {{ x = 0.01, y = 60e6 }}\n[[building.frame]]\nname = \"F\"\nat = [[0, 0], [0, 7]]\nspans = [6, 6]\nconcrete = \"C30\"\naxial = {{ columns = \"flexible\" }}\nbeam = {{ {BEAM} }}\ncolumn = {{ width = 0.5, depth = 0.5 }}\n[[building.frame.wall]]\nline = 1\nlength = 3\nthickness = 0.25\n"
    );
    shaken("", &building)
}

/// The same as a space frame, its walls along x, or turned by a quarter; and a motion that goes with it.
fn space_frame(turned: bool) -> (String, &'static str) {
    let (lines, wall, motion) = match turned {
        false => (
            "lines_x = [0, 6, 12]\nlines_y = [0, 7]",
            "along = \"x\"\nx = 1",
            "",
        ),
        true => (
            "lines_x = [0, 7]\nlines_y = [0, 6, 12]",
            "along = \"y\"\ny = 1",
            "angle = \"90 deg\"",
        ),
    };
    let building = format!(
        "kind = \"space-frame\"\nconcrete = \"C30\"\n{lines}\nbeam_x = {{ {BEAM} }}\nbeam_y = {{ {BEAM} }}\ncolumn = {{ size = [0.5, 0.5] }}\n[[building.wall]]\n{wall}\nlength = 3\nthickness = 0.25\n"
    );
    (building, motion)
}

fn in_space(turned: bool, base: &str) -> Ran {
    let (building, motion) = space_frame(turned);
    shaken(motion, &format!("{base}{building}"))
}

fn walls(ran: &Ran) -> Vec<PartSummary> {
    let parts = ran.summary().buildings.remove(0).parts;
    parts
        .into_iter()
        .filter(|part| part.kind == "wall")
        .collect()
}

/// On the ground, and on a base that rocks: walls do not become longer by what raises their feet.
#[test]
fn walls_bear_what_those_of_frames_at_lines_bear() {
    for base in ["", "base = { rotational_stiffness = \"9 GN.m/rad\" }\n"] {
        walls_agree_on(base);
    }
}

fn walls_agree_on(base: &str) {
    let due = walls(&at_lines(base));
    assert_eq!(due.len(), 2);
    for turned in [false, true] {
        let found = walls(&in_space(turned, base));
        assert_eq!(found.len(), 2);
        for (index, (found, due)) in found.iter().zip(&due).enumerate() {
            assert_eq!(found.name, format!("A.wall.{}", index + 1));
            for (found, due) in [
                (found.force_max_n, due.force_max_n),
                (found.force_min_n, due.force_min_n),
                (found.deformation_max, due.deformation_max),
                (found.deformation_min, due.deformation_min),
                (
                    found.moment_max_n_m.expect("a wall"),
                    due.moment_max_n_m.expect("a wall"),
                ),
                (
                    found.moment_min_n_m.expect("a wall"),
                    due.moment_min_n_m.expect("a wall"),
                ),
            ] {
                assert!(
                    due != 0.0 && (found / due - 1.0).abs() < 1e-7,
                    "{turned} {index}: {found} for {due}"
                );
            }
        }
    }
}

#[test]
fn a_check_names_walls_and_takes_their_arms_for_no_rigid_ends() {
    for (ends, is_said) in [("", false), ("rigid_ends = 0.5\n", true)] {
        let (building, _) = space_frame(false);
        let building = building.replace("[[building.wall]]", &format!("{ends}[[building.wall]]"));
        let opened = Opened::new(
            sound(&format!("[[building]]\nname = \"A\"\n{COMMON}{building}")),
            "model",
        );
        let opened = opened.unwrap_or_else(|error| panic!("{error}"));
        let text = check(&opened)
            .unwrap_or_else(|error| panic!("{error}"))
            .text;
        // Three storeys of four columns beside those of the walls.
        for due in [
            "3 storeys, 12 columns and 21 beams",
            "wall 1 along x at x = 0 m, y = 0 m, storeys 1–3, 3 m long",
            "wall 2 along x at x = 0 m, y = 7 m, storeys 1–3, 3 m long",
        ] {
            assert!(text.contains(due), "{due} in {text}");
        }
        assert_eq!(
            text.contains("rigid ends up to 125 mm of beams"),
            is_said,
            "{text}"
        );
        assert!(is_said || !text.contains("rigid ends"), "{text}");
    }
}
