//! Walls and coupling beams of frames.

use jostle::hysteresis::Side;
use jostle::{Frame, FrameWall, Structure};
use jostle_testkit::files::{refusal, sound};

const FRAME: &str = r#"
motion = { record = "el-centro-1940-ns" }
[[building]]
name = "A"
storeys = 4
storey_height = 3
spans = [5, 6]
elastic_modulus = "30 GPa"
beam_mass = 3000
"#;

const COLUMNS: &str = "[[building.column]]\nwidth = 0.4\ndepth = 0.4\n";
const BEAMS: &str = "[[building.beam]]\nwidth = 0.3\ndepth = 0.5\n";

fn file(more: &str) -> String {
    format!("{FRAME}{COLUMNS}{BEAMS}{more}")
}

fn frame(text: &str) -> Frame {
    match &sound(text).model.buildings[0].structure {
        Structure::Frame(frame) => frame.clone(),
        other => panic!("{other:?}"),
    }
}

fn wall(more: &str) -> (Frame, FrameWall) {
    let frame = frame(&file(&format!(
        "[[building.wall]]\nlength = 3\nthickness = 0.25\n{more}"
    )));
    let wall = frame.walls[0].clone();
    (frame, wall)
}

/// E t L³/12, E t L, 5/6 of G t L, and the mass of its storeys.
#[test]
fn a_wall_takes_the_place_of_a_column_line() {
    let (frame, wall) = wall("at = 5\nstoreys = [1, 2]\n");
    assert_eq!((wall.line, wall.storeys, wall.length), (2, [1, 2], 3.0));
    let section = frame.column(1, 1).expect("the wall");
    let (e, t, l) = (30e9, 0.25, 3.0_f64);
    for (got, expected) in [
        (section.flexural_rigidity, e * t * l.powi(3) / 12.0),
        (section.axial_rigidity.unwrap_or_default(), e * t * l),
        (
            section.shear_rigidity.unwrap_or_default(),
            5.0 / 6.0 * e / 2.4 * t * l,
        ),
        (section.line_mass, 2500.0 * t * l),
        (frame.arm([0, 1]), 1.5),
        (frame.arm([1, 1]), 1.5),
        (frame.arm([2, 1]), 0.0),
        (frame.clear_span([0, 0]), 3.5),
    ] {
        if expected == 0.0 {
            assert_eq!(got, 0.0);
        } else {
            assert!(
                (got / expected - 1.0).abs() < 1e-12,
                "{got}, not {expected}"
            );
        }
    }
    assert!(frame.wall([2, 1]).is_none() && frame.bare_column(2, 1).is_some());
    // Columns of frames with walls shorten unless the file says otherwise.
    assert!(frame.axial.columns_flexible);
}

/// ACI 369.1-22 and EN 1998-1, or a number, which is that of EI alone as elsewhere.
#[test]
fn stiffness_factors_are_rules_or_numbers() {
    let gross = wall("line = 2\n").0;
    let gross = gross.column(0, 1).expect("the wall");
    for (factor, bending, shear) in [
        ("\"asce41-23\"", 0.25, 0.15 * 2.4 / (5.0 / 6.0)),
        ("\"en1998\"", 0.5, 0.5),
        ("0.35", 0.35, 1.0),
    ] {
        let (frame, wall) = wall(&format!("line = 2\nstiffness_factor = {factor}\n"));
        let column = frame.column(0, 1).expect("the wall");
        let ratio = |rigidity: Option<f64>, gross: Option<f64>| {
            rigidity.unwrap_or_default() / gross.unwrap_or_default()
        };
        for (got, expected) in [
            (column.flexural_rigidity / gross.flexural_rigidity, bending),
            (ratio(column.shear_rigidity, gross.shear_rigidity), shear),
            (ratio(column.axial_rigidity, gross.axial_rigidity), 1.0),
            (wall.stiffness_factors[0], bending),
            (wall.stiffness_factors[1], shear),
        ] {
            assert!(
                (got - expected).abs() < 1e-12,
                "{factor}: {got}, not {expected}"
            );
        }
    }
    // Clear length over depth: (5 − 1.5 − 1) / 0.5 of a coupling beam is 5, and 0.05 of it more than 0.2.
    let two = "[[building.wall]]\nline = 1\nlength = 3\nthickness = 0.25\n[[building.wall]]\nline = 2\nlength = 2\nthickness = 0.25\n";
    for (depth, expected) in [(0.5, 0.2), (1.25, 0.1)] {
        let frame = frame(&file(&format!(
            "{two}[[building.coupling_beam]]\nbetween = [1, 2]\nwidth = 0.3\ndepth = {depth}\nstiffness_factor = \"asce41-23\"\n"
        )));
        assert_eq!(frame.coupling_beams.len(), 4);
        let factors = frame.coupling_beams[0].stiffness_factors;
        assert!((factors[0] - expected).abs() < 1e-12, "{factors:?}");
    }
}

/// Nothing but walls and coupling beams makes a frame as well.
#[test]
fn walls_and_coupling_beams_need_no_columns() {
    let text = format!(
        "{FRAME}{}",
        (1..=3)
            .map(|line| format!(
                "[[building.wall]]\nline = {line}\nlength = 2\nEI = \"2 GN.m2\"\nEA = \"5 GN\"\nGA = \"2 GN\"\nmass = 0\n"
            ))
            .chain([
                "[[building.coupling_beam]]\nbay = [1, 2]\nEI = \"30 MN.m2\"\nEA = \"2 GN\"\nGA = \"0.6 GN\"\nhinge = { rule = \"bilinear\", yield = \"300 kN\", post_yield = 0.02 }\n"
                    .to_owned()
            ])
            .collect::<String>()
    );
    let frame = frame(&text);
    assert_eq!(frame.coupling_beams.len(), 8);
    // Its shear deformation yields: GA over the clear length.
    let shear = frame.coupling_beams[0].shear.expect("it yields");
    assert!((shear.backbone().initial() / (0.6e9 / 3.0) - 1.0).abs() < 1e-12);
    assert_eq!(frame.bare_members(), [0, 0]);
}

/// Stiffness in numbers, in units of EI/h, or of what bends over a length: then moment over rotation after yield is that of a section whose
/// EI falls to its ratio over that length, of which the wall itself has the elastic part.
#[test]
fn hinges_have_a_stiffness_or_a_length() {
    let ei = 30e9 * 0.25 * 27.0 / 12.0;
    let hinge = |more: &str| {
        let text = format!(
            "line = 2\n[building.wall.hinge]\nrule = \"bilinear\"\nyield = \"5 MN.m\"\npost_yield = 0.02\n{more}\n"
        );
        wall(&text).1.hinges[0].hysteresis
    };
    let stated = hinge("stiffness = \"60 GN.m/rad\"");
    assert!((stated.backbone().initial() / 60e9 - 1.0).abs() < 1e-12);
    let times = hinge("initial = 50");
    assert!((times.backbone().initial() / (50.0 * ei / 3.0) - 1.0).abs() < 1e-12);
    for (text, length) in [
        ("length = \"1.2 m\"", 1.2),
        ("length = \"paulay-priestley\"", 0.2 * 3.0 + 0.044 * 8.0),
    ] {
        let hinge = hinge(text);
        let slope = hinge.backbone().side(Side::Positive).post_yield;
        // Beyond yield a moment m turns the section over the length by m L/(0.02 EI), of which m L/EI is the wall's.
        let added = length / (0.02 * ei) - length / ei;
        assert!((slope * added - 1.0).abs() < 1e-9, "{slope} {added}");
    }
}

/// Above floors that are named, or at both ends of every storey; a hinge is in units of EI over the height of its storey.
#[test]
fn walls_yield_where_the_file_says() {
    let places = |more: &str| {
        let text = format!(
            "line = 2\n[building.wall.hinge]\nrule = \"bilinear\"\nyield = \"5 MN.m\"\npost_yield = 0.02\ninitial = 50\n{more}\n"
        );
        let hinges = wall(&text).1.hinges;
        hinges
            .iter()
            .map(|hinge| (hinge.storey, hinge.at_head))
            .collect::<Vec<_>>()
    };
    assert_eq!(places(""), [(1, false)]);
    assert_eq!(places("floors = [0, 2]"), [(1, false), (3, false)]);
    let all = places("ends = \"all\"");
    assert_eq!(all.len(), 8);
    assert!(all.contains(&(2, true)) && all.contains(&(3, false)));
}

/// Moments by level stand where the list says; those of one storey hold at both of its ends.
#[test]
fn walls_have_moments_by_level() {
    let moments = |more: &str| {
        let text = format!(
            "line = 2\n[building.wall.hinge]\nrule = \"takeda\"\npost_cracking = 0.5\npost_yield = 0.02\ninitial = 50\n{more}\n"
        );
        let hinges = wall(&text).1.hinges;
        let corners = hinges.iter().map(|hinge| {
            let curve = hinge.hysteresis.backbone().side(Side::Positive);
            (
                hinge.storey,
                [curve.cracking.force / 1e6, curve.yielding.force / 1e6],
            )
        });
        corners.collect::<Vec<_>>()
    };
    let two = "floors = [0, 2]\ncracking = \"2 MN.m\"\nyield = [\"5 MN.m\", \"3.5 MN.m\"]";
    assert_eq!(moments(two), [(1, [2.0, 5.0]), (3, [2.0, 3.5])]);
    let all = "ends = \"all\"\ncracking = [2e6, 1.8e6, 1.6e6, 1.4e6]\nyield = [5e6, 4e6, 3e6, 2e6]";
    let all = moments(all);
    assert_eq!(all[2..4], [(2, [1.8, 4.0]); 2]);
    assert_eq!(all[7], (4, [1.4, 2.0]));
}

/// Each fault names key and remedy.
#[test]
fn walls_that_do_not_fit_are_refused() {
    let one = "[[building.wall]]\nline = 2\nlength = 3\nthickness = 0.25\n";
    let two = "[[building.wall]]\nline = 1\nlength = 3\nthickness = 0.25\n[[building.wall]]\nline = 2\nlength = 2\nthickness = 0.25\n";
    let beam = "[[building.coupling_beam]]\nwidth = 0.3\ndepth = 0.6\n";
    for (more, expected) in [
        ("[[building.wall]]\nline = 2\nlength = 0.2\nthickness = 3\n".to_owned(), &["thickness", "more than the length", "across"][..]),
        ("[[building.wall]]\nat = 4.9\nlength = 3\nthickness = 0.25\n".to_owned(), &["wall[0].at", "no column line", "0, 5, 11 m"]),
        ("[[building.wall]]\nline = 4\nlength = 3\nthickness = 0.25\n".to_owned(), &["wall[0].line", "between 1 and 3", "counted from 1"]),
        ("[[building.wall]]\nat = 5\nline = 2\nlength = 3\nthickness = 0.25\n".to_owned(), &["at", "both given"]),
        ("[[building.wall]]\nlength = 3\nthickness = 0.25\n".to_owned(), &["wall[0]", "add at ="]),
        ("[[building.wall]]\nline = 2\nthickness = 0.25\n".to_owned(), &["wall[0]", "add length ="]),
        ("[[building.wall]]\nline = 2\nlength = 3\n".to_owned(), &["wall[0]", "add thickness ="]),
        ("[[building.wall]]\nline = 2\nlength = 3\nEI = 1e9\nEA = 1e9\nmass = 0\n".to_owned(), &["GA", "shear = \"rigid\""]),
        ("[[building.wall]]\nline = 1\nlength = 6\nthickness = 0.25\n[[building.wall]]\nline = 2\nlength = 5\nthickness = 0.25\n".to_owned(), &["wall", "no clear span", "shorter"]),
        ("[[building.wall]]\nline = 2\nlength = 10\nthickness = 0.25\n".to_owned(), &["no clear span", "bay 1"]),
        (format!("{one}[[building.wall]]\nline = 2\nstoreys = 2\nlength = 2\nthickness = 0.25\n"), &["wall[1]", "stands already"]),
        (format!("{one}[[building.column]]\nline = 2\nstoreys = [2, 3]\nEI = 1e8\nmass = 0\n"), &["column[1]", "line 2 in storey 2", "where a wall stands"]),
        (format!("{two}{beam}between = [1, 3]\n"), &["coupling_beam[0].between", "wall 3, but there are 2"]),
        (format!("{beam}between = [1, 2]\n"), &["coupling_beam[0].between", "but there are 0"]),
        (format!("{two}{beam}bay = 2\n"), &["coupling_beam", "line 3", "no wall stands"]),
        (format!("{two}{beam}between = [1, 2]\n{beam}bay = 2\n"), &["coupling_beam[1]", "line 3", "no wall stands"]),
        (format!("{two}{beam}bay = 1\nhinge = {{ rule = \"normal\", cracking = \"300 kN\", yield = \"250 kN\", post_cracking = 0.3, post_yield = 0.02 }}\n"), &["coupling_beam[0].hinge.yield", "less than cracking, found 0.8333 times it"]),
        (format!("{two}{beam}"), &["coupling_beam[0]", "add between ="]),
        (format!("{two}{beam}between = [1, 2]\n{beam}bay = 1\nfloors = 2\n"), &["coupling_beam[1]", "second time"]),
        (format!("{two}{beam}between = [1, 2]\n[[building.beam]]\nbay = 1\nwidth = 0.3\ndepth = 0.5\n"), &["beam[1]", "where a coupling beam is"]),
        (format!("{two}[[building.coupling_beam]]\nbay = 1\nEI = 1e8\nshear = \"rigid\"\nhinge = {{ rule = \"bilinear\", yield = 1e5, post_yield = 0.02 }}\n"), &["hinge", "stiffness", "GA"]),
        (format!("{two}[[building.coupling_beam]]\nbay = 1\nEI = 1e8\nGA = 1e9\nstiffness_factor = \"asce41-23\"\n"), &["stiffness_factor", "depth"]),
        (format!("{one}hinge = {{ rule = \"bilinear\", yield = \"5 MN.m\", post_yield = 0.02 }}\n"), &["hinge", "stiffness =", "paulay-priestley"]),
        (format!("{one}hinge = {{ rule = \"bilinear\", stiffness = 1e10, initial = 3, yield = \"5 MN.m\", post_yield = 0.02 }}\n"), &["stiffness", "both given"]),
        (format!("{one}hinge = {{ rule = \"bilinear\", length = 4, yield = \"5 MN.m\", post_yield = 0.02 }}\n"), &["hinge.length", "height of its storey"]),
        (format!("{one}hinge = {{ rule = \"bilinear\", floors = [4], initial = 50, yield = \"5 MN.m\", post_yield = 0.02 }}\n"), &["hinge.floors", "between 0 and 3", "foot"]),
        (format!("{one}hinge = {{ rule = \"bilinear\", floors = [1], ends = \"all\", initial = 50, yield = \"5 MN.m\", post_yield = 0.02 }}\n"), &["floors", "both given"]),
        (format!("{one}hinge = {{ rule = \"bilinear\", floors = [0, 1], initial = 50, yield = [5e6, 4e6, 3e6], post_yield = 0.02 }}\n"), &["hinge.yield", "3 moments for 2 floors", "one for each"]),
        (format!("{one}hinge = {{ rule = \"bilinear\", floors = [0, 1], initial = 50, yield = [5e6, \"4 MN\"], post_yield = 0.02 }}\n"), &["hinge.yield", "moment"]),
        (format!("{one}hinge = {{ rule = \"bilinear\", stiffness = 1e10, yield = \"500 kN\", post_yield = 0.02 }}\n"), &["hinge.yield", "moment"]),
        (format!("{one}shear = \"rigid\"\nshear_hinge = {{ rule = \"bilinear\", yield = 1e6, post_yield = 0.02 }}\n"), &["shear_hinge", "stiffness"]),
        (format!("{one}stiffness_factor = \"asce\"\n"), &["stiffness_factor", "asce41-23"]),
        (format!("{one}[[building.brace]]\nbay = 1\nstoreys = 1\nEA = 1e8\n"), &["brace", "wall at line 2", "leave it out"]),
        ("wall = 3\n".to_owned(), &["wall"]),
    ] {
        let text = file(&more);
        let text = if more.starts_with("wall =") {
            format!("{FRAME}{more}{COLUMNS}{BEAMS}")
        } else {
            text
        };
        let message = refusal(&text);
        for word in expected {
            assert!(message.contains(word), "{word} is not in\n{message}\nof\n{more}");
        }
    }
}

/// A table gives a coupling beam at every floor: its fault is told once, at the table.
#[test]
fn a_fault_of_coupling_beams_is_told_once() {
    let two = "[[building.wall]]\nline = 1\nlength = 3\nthickness = 0.25\n[[building.wall]]\nline = 2\nlength = 2\nthickness = 0.25\n";
    let beam = "[[building.coupling_beam]]\nwidth = 0.3\ndepth = 0.6\nbay = 2\n";
    let told = refusal(&file(&format!("{two}{beam}")));
    assert_eq!(told.matches("where no wall stands").count(), 1, "{told}");
    // Nor does a wall that leaves no room make a fault of the hinge.
    let long = two.replace("length = 3", "length = 9");
    let hinged = "[[building.coupling_beam]]\nwidth = 0.3\ndepth = 0.6\nbay = 1\nhinge = { rule = \"bilinear\", yield = \"250 kN\", post_yield = 0.02 }\n";
    let told = refusal(&file(&format!("{long}{hinged}")));
    assert!(
        told.contains("no clear span") && !told.contains("hinge"),
        "{told}"
    );
}
