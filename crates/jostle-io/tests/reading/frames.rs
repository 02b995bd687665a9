//! Plane frames whose columns differ by line and beams by bay, members left out, and bases at different levels.

use jostle::{Frame, Structure, Summary};
use jostle_testkit::compare::close;
use jostle_testkit::files::{read, refusal, sound};
use jostle_testkit::runs::{assembled, run_and_summary};

const MOTION: &str = "motion = { kind = \"sine\", amplitude = 3, period = 0.6, duration = 2.5 }\nanalysis = { tolerance = 1e-5 }\n";

/// Three bays below, the middle one above.
const PODIUM: &str = r#"
[[building]]
name = "A"
kind = "frame"
storeys = 4
storey_height = "3 m"
spans = ["6 m", "5 m", "4 m"]
elastic_modulus = "30 GPa"
beam_mass = "3 t/m"

[[building.column]]
width = "0.5 m"
depth = "0.5 m"

[[building.column]]
line = 1
storeys = [3, 4]
omit = true

[[building.column]]
line = 4
storeys = [3, 4]
omit = true

[[building.column]]
line = [2, 3]
storeys = [3, 4]
width = "0.4 m"
depth = "0.4 m"

[[building.beam]]
width = "0.3 m"
depth = "0.6 m"
"#;

const NEIGHBOUR: &str = r#"
[[building]]
name = "B"
kind = "shear"
storeys = 4
storey_height = "3 m"
mass = "40 t"
stiffness = "60 MN/m"
"#;

const GAP: &str = "[[gap]]\nbetween = [\"A\", \"B\"]\nwidth = \"10 mm\"\n";

fn frame(text: &str) -> Frame {
    match &sound(text).model.buildings[0].structure {
        Structure::Frame(frame) => frame.clone(),
        other => panic!("{other:?}"),
    }
}

fn summary(text: &str) -> Summary {
    let input = sound(text);
    let motion = input.ground_motion().expect("a sine");
    run_and_summary(&input.model, &motion).2
}

#[test]
fn later_tables_replace_earlier_ones() {
    let frame = frame(&format!("{MOTION}{PODIUM}"));
    let depth = |storey, line| {
        let section = frame.column(storey, line)?;
        Some((section.line_mass / 2500.0).sqrt())
    };
    assert_eq!(depth(0, 0), Some(0.5));
    assert_eq!(depth(1, 3), Some(0.5));
    assert_eq!(depth(2, 0), None);
    assert!(depth(3, 2).is_some_and(|depth| (depth - 0.4).abs() < 1e-12));
    assert_eq!(
        (
            frame.all_columns().count(),
            frame.columns_in(1),
            frame.columns_in(2)
        ),
        (12, 4, 2)
    );
    // Beams stand between joints.
    assert_eq!(frame.all_beams().count(), 8);
    assert!(frame.beam(2, 0).is_none() && frame.beam(2, 1).is_some());
    assert_eq!(
        (frame.set_back(2), frame.set_back(3)),
        ([0.0; 2], [6.0, 4.0])
    );
    let all = |top| (1..=top).collect::<Vec<_>>();
    assert_eq!(frame.storeys_of_lines(), [2, 4, 4, 2].map(all));
}

/// A single table, whether in double brackets or not, a list of one table per storey, and a list that names places are the same model, and
/// so the same run to the last bit.
#[test]
fn equal_sections_are_one_frame_however_they_are_written() {
    let column = "width = 0.5, depth = 0.5";
    let with = |columns: &str, beams: &str| {
        let head = &PODIUM[..PODIUM.find("[[building.column]]").expect("columns")];
        format!("{MOTION}{head}{columns}{beams}{NEIGHBOUR}{GAP}")
    };
    let beam = "beam = { width = 0.3, depth = 0.6 }\n";
    let one = with(&format!("column = {{ {column} }}\n"), beam);
    let expected = summary(&one);
    assert!(expected.gaps[0].impact_count > 3);
    let table = "\n[[building.column]]\nwidth = 0.5\ndepth = 0.5\n";
    let of_beams = "[[building.beam]]\nbay = [1, 2]\nwidth = 0.3\ndepth = 0.6\n[[building.beam]]\nbay = 3\nfloors = [1, 4]\nwidth = 0.3\ndepth = 0.6\n";
    for other in [
        with(table, "[[building.beam]]\nwidth = 0.3\ndepth = 0.6\n"),
        with(
            &table.repeat(4),
            "[[building.beam]]\nwidth = 0.3\ndepth = 0.6\n",
        ),
        with(
            &format!("{table}line = [1, 4]\nstoreys = [1, 4]\n{table}line = 2\nstoreys = 3\n"),
            of_beams,
        ),
    ] {
        assert_eq!(sound(&one).model, sound(&other).model, "{other}");
        assert_eq!(summary(&other), expected);
    }
}

/// Seen from behind, and shaken the other way, a frame does the same.
#[test]
fn a_mirrored_frame_gives_mirrored_results() {
    let brace = "[[building.brace]]\nbay = 1\nstoreys = 1\nEA = \"300 MN\"\n";
    let one = format!("{MOTION}{PODIUM}{brace}{NEIGHBOUR}{GAP}");
    let flipped = PODIUM.replace("[\"6 m\", \"5 m\", \"4 m\"]", "[\"4 m\", \"5 m\", \"6 m\"]");
    let brace = "[[building.brace]]\nbay = 3\nstoreys = 1\nEA = \"300 MN\"\ndirection = \"down\"\n";
    let gap = "[[gap]]\nbetween = [\"B\", \"A\"]\nwidth = \"10 mm\"\n";
    let motion = MOTION.replace("amplitude = 3", "amplitude = -3");
    let other = format!("{motion}{NEIGHBOUR}{flipped}{brace}{gap}");
    let [one, other] = [summary(&one), summary(&other)];
    assert!(one.gaps[0].impact_count > 3);
    let greatest = one.gaps[0].peak_force_n;
    let of = |summary: &Summary| {
        summary
            .buildings
            .iter()
            .position(|building| building.name == "A")
    };
    let [a, b] = [&one, &other].map(|summary| &summary.buildings[of(summary).expect("A")]);
    for (a, b) in a.floors.above.iter().zip(&b.floors.above) {
        let [a, b] = [a, b].map(|floor| floor.response);
        let top = a.displacement_max_m.abs().max(a.displacement_min_m.abs());
        close(
            b.displacement_min_m,
            -a.displacement_max_m,
            top,
            1e-6,
            "sway to the right",
        );
        close(
            b.displacement_max_m,
            -a.displacement_min_m,
            top,
            1e-6,
            "sway to the left",
        );
    }
    let [p, q] = [&a.parts[0], &b.parts[0]];
    let pairs = [
        [p.force_max_n, q.force_max_n],
        [p.force_min_n, q.force_min_n],
    ];
    for [a, b] in pairs {
        close(b, a, a.abs(), 1e-6, "force of the brace");
    }
    for (a, b) in one.gaps[0].contacts.iter().zip(&other.gaps[0].contacts) {
        assert_eq!(a.impact_count, b.impact_count);
        assert_eq!(a.width_m, b.width_m);
        close(
            b.peak_force_n,
            a.peak_force_n,
            greatest,
            1e-5,
            "contact force",
        );
    }
}

/// A lintel that is not there carries no force, and its names are no names.
#[test]
fn members_that_are_left_out_are_absent_from_results() {
    let output = "output = { members = true }\n";
    let names: Vec<String> = summary(&format!("{output}{MOTION}{PODIUM}")).buildings[0]
        .members
        .iter()
        .map(|member| member.name.clone())
        .collect();
    assert_eq!(names.len(), 12 + 8);
    for name in ["A.column.2.4", "A.column.4.2", "A.beam.4.2", "A.beam.2.1"] {
        assert!(names.iter().any(|own| own == name), "{name}");
    }
    for name in ["A.column.1.3", "A.beam.3.1"] {
        assert!(!names.iter().any(|own| own == name), "{name}");
        let said = refusal(&format!(
            "output = {{ members = [\"{name}\"] }}\n{MOTION}{PODIUM}"
        ));
        assert!(said.contains("as far as they are not omitted"), "{said}");
    }
    // Hinges of members that do not exist have no part.
    let hinges = "hinges = { rule = \"bilinear\", column = { yield = \"300 kN.m\", post_yield = 0.01 }, beam = { yield = \"200 kN.m\", post_yield = 0.01 } }\nbeam_mass";
    let yielding = sound(&format!("{MOTION}{}", PODIUM.replace("beam_mass", hinges)));
    let system = assembled(&yielding.model);
    assert_eq!(system.buildings[0].equations.springs.len(), 2 * (12 + 8));
}

/// Edge to edge the gap has its width; a face that is set back is farther away by its set-back.
#[test]
fn faces_that_stand_back_have_wider_gaps() {
    let widths = |gap: &str| -> Vec<f64> {
        let model = sound(&format!("{MOTION}{PODIUM}{NEIGHBOUR}{gap}")).model;
        let contacts = assembled(&model).contacts;
        contacts.iter().map(|contact| contact.width).collect()
    };
    assert_eq!(widths(GAP), [0.01, 0.01, 4.01, 4.01]);
    let listed = format!("{GAP}floors = [[2, 2], [4, 4]]\n");
    assert_eq!(widths(&listed), [0.01, 4.01]);
    // A width of every contact is that of its faces.
    let each = GAP.replace("\"10 mm\"", "[0.01, 0.02, 0.03, 0.04]");
    assert_eq!(widths(&each), [0.01, 0.02, 0.03, 0.04]);
}

/// A line without a column below: its beams are continuous, braces meet there, and a column above may stand on them.
#[test]
fn beams_are_continuous_where_a_column_is_missing() {
    let missing = "[[building.column]]\nline = 2\nstoreys = 1\nomit = true\n";
    let braces = "[[building.brace]]\nbay = 1\nstoreys = 1\nEA = \"300 MN\"\n[[building.brace]]\nbay = 2\nstoreys = 1\ndirection = \"down\"\nEA = \"300 MN\"\n";
    let text = format!("{MOTION}{PODIUM}{missing}{braces}")
        .replace("beam_mass", "axial = \"flexible\"\nbeam_mass");
    let chevron = frame(&text);
    assert!(chevron.column(0, 1).is_none() && chevron.column(1, 1).is_some());
    assert!((0..3).all(|bay| chevron.beam(0, bay).is_some()));
    assert!(chevron.has_joint(1, 1) && !chevron.has_joint(0, 1) && !chevron.is_continuous(1, 1));
    assert_eq!(chevron.diagonals.len(), 2);
    // Both braces take the storey's shear, one in compression and one in tension.
    let summary = summary(&text);
    let parts = &summary.buildings[0].parts;
    let [up, down] = &parts[..] else {
        panic!("{parts:?}");
    };
    for brace in [up, down] {
        assert!(
            brace.force_max_n > 1e4 && brace.force_min_n < -1e4,
            "{brace:?}"
        );
    }
    // Panels fill bays between columns, those of whole storeys too.
    let infill = "[[building.infill]]\nstiffness = \"80 MN/m\"\n";
    let filled = frame(&format!("{MOTION}{PODIUM}{missing}{infill}"));
    assert_eq!(filled.diagonals.len(), 2 * (1 + 3 + 1 + 1));
    let named = format!("{MOTION}{PODIUM}{missing}{infill}bay = 1\nstoreys = 1\n");
    let said = refusal(&named);
    assert!(
        said.contains("fills a bay without a column at line 2"),
        "{said}"
    );
    // A wall has no place on a beam.
    let wall =
        "[[building.wall]]\nline = 2\nstoreys = [2, 4]\nlength = \"1 m\"\nthickness = \"0.2 m\"\n";
    let podium = PODIUM.replace("line = [2, 3]", "line = 3");
    let said = refusal(&format!("{MOTION}{podium}{missing}{wall}"));
    assert!(said.contains("a wall cannot start on a beam"), "{said}");
}

#[test]
fn what_does_not_stand_is_refused_with_the_remedy() {
    let beam = "[[building.beam]]\nwidth = 0.3\ndepth = 0.6\n";
    for (from, to, expected) in [
        (
            "line = 4\nstoreys = [3, 4]",
            "line = 4\nstoreys = 3",
            "line 4 has a column in storey 4 but none in storey 3; a column that starts on a beam needs beams in the bays on both sides of it: add the column below, add the beams, or omit this one",
        ),
        (
            "line = [2, 3]\nstoreys = [3, 4]\nwidth = \"0.4 m\"\ndepth = \"0.4 m\"",
            "storeys = 3\nomit = true",
            "leaves storey 3 without any column",
        ),
        ("line = 4", "line = 5", "must be within 1 to 4, found 5"),
        ("line = [2, 3]", "line = [3, 2]", "must be ascending"),
        (
            "storeys = [3, 4]",
            "storeys = [3, 5]",
            "within 1 to 4, found 3 to 5",
        ),
        (
            "line = 4",
            "line = 0",
            "count lines, bays and storeys from 1",
        ),
        ("line = 4", "bay = 4", "unknown key \"bay\""),
        (
            "omit = true",
            "omit = true\nwidth = 0.4",
            "has both omit and width",
        ),
        (
            "[[building.column]]\nwidth = \"0.5 m\"",
            "[[building.column]]\nline = [1, 3]\nwidth = \"0.5 m\"",
            "says nothing of line 4 in storey 1",
        ),
        (
            "[[building.beam]]\n",
            "[[building.beam]]\nbay = [1, 2]\n",
            "says nothing of bay 3 at floor 1",
        ),
    ] {
        assert!(PODIUM.contains(from), "{from}");
        let said = refusal(&format!("{MOTION}{}", PODIUM.replacen(from, to, 1)));
        assert!(said.contains(expected), "{from} → {to}:\n{said}");
    }
    for (more, expected) in [
        (
            format!("{beam}bay = 1\nfloors = 4\n"),
            "bay 1 has a beam at floor 4 but line 1 no joint there",
        ),
        (
            "[[building.beam]]\nbay = 2\nfloors = 4\nomit = true\n".to_owned(),
            "floor 4 is in two parts, as no beam crosses bay 2",
        ),
        (
            format!("{beam}floors = [4, 5]\n"),
            "within 1 to 4, found 4 to 5",
        ),
        (
            "[[building.brace]]\nbay = 1\nstoreys = 4\nEA = \"300 MN\"\n".to_owned(),
            "brace.4.1.up ends at floor 3 of line 1, where there is no joint",
        ),
    ] {
        let said = refusal(&format!("{MOTION}{PODIUM}{more}"));
        assert!(said.contains(expected), "{more}:\n{said}");
    }
    // The fault is shown at the table that holds there.
    let omitted = format!("{MOTION}{PODIUM}[[building.beam]]\nbay = 2\nfloors = 4\nomit = true\n");
    assert!(refusal(&omitted).contains("building[0].beam[1]: floor 4"));
    let stretches = PODIUM
        .replace("beam_mass", "axial = \"flexible\"\nbeam_mass")
        .replace(
            "width = \"0.4 m\"\ndepth = \"0.4 m\"",
            "EI = \"60 MN.m2\"\nmass = 500",
        );
    let said = refusal(&format!("{MOTION}{stretches}"));
    assert!(said.contains("building[0].column[3].EA"), "{said}");
    // Braces without bays of their own stand where there are joints.
    let braces = frame(&format!(
        "{MOTION}{PODIUM}[[building.brace]]\nEA = \"300 MN\"\n"
    ));
    assert_eq!(braces.diagonals.len(), 3 + 3 + 2 + 1);
}

/// Floors and heights are compared above the datum, and so are heights of contacts.
#[test]
fn buildings_stand_at_their_elevations() {
    let low = PODIUM.replace("name = \"A\"", "name = \"A\"\nelevation = \"-3 m\"");
    let contacts = |text: &str| -> Vec<(f64, [Option<usize>; 2])> {
        let contacts = assembled(&sound(text).model).contacts;
        let places = contacts
            .iter()
            .map(|contact| (contact.height, contact.ports.floors()));
        places.collect()
    };
    let found = contacts(&format!("{MOTION}{low}{NEIGHBOUR}{GAP}"));
    assert_eq!(
        found,
        [
            (3.0, [Some(2), Some(1)]),
            (6.0, [Some(3), Some(2)]),
            (9.0, [Some(4), Some(3)])
        ]
    );
    let half = low.replace("-3 m", "1.25 m");
    let between = format!("{MOTION}{half}{NEIGHBOUR}{GAP}floors = [[\"3 m\", 1], [\"9 m\", 3]]\n");
    assert_eq!(
        contacts(&between),
        [(3.0, [None, Some(1)]), (9.0, [None, Some(3)])]
    );
    let model = sound(&between).model;
    assert_eq!(model.points_between_floors(0), [vec![], vec![1.75, 7.75]]);
    // Shear buildings have no columns to hit.
    for (gap, expected) in [
        ("", "lie at equal height"),
        (
            "floors = [[2, 2]]\n",
            "floor 2 of \"A\" is at 7.250 m and floor 2 of \"B\" is at 6.000 m",
        ),
        ("floors = [[\"1.2 m\", 1]]\n", "below its base"),
    ] {
        let said = refusal(&format!("{MOTION}{half}{NEIGHBOUR}{GAP}{gap}"));
        assert!(said.contains(expected), "{gap}:\n{said}");
    }
    assert!(
        read(&format!(
            "{MOTION}{half}{NEIGHBOUR}{GAP}floors = [[2, 2]]\nlevel_tolerance = \"1.3 m\"\n"
        ))
        .is_ok()
    );
}

/// A row moves as a whole: the same elevation of all changes nothing but the heights of contacts.
#[test]
fn an_elevation_of_all_is_that_of_none() {
    let flat = summary(&format!("{MOTION}{PODIUM}{NEIGHBOUR}{GAP}"));
    let lift = |text: &str| text.replace("kind =", "elevation = \"2 m\"\nkind =");
    let high = summary(&format!("{MOTION}{}{}{GAP}", lift(PODIUM), lift(NEIGHBOUR)));
    assert_eq!(flat.buildings, high.buildings);
    for (flat, high) in flat.gaps[0].contacts.iter().zip(&high.gaps[0].contacts) {
        assert_eq!(flat.peak_force_n, high.peak_force_n);
        assert_eq!(flat.height_m + 2.0, high.height_m);
    }
}

/// Shares of half depths, or lengths; the deeper of two members counts, and a profile about its axis.
#[test]
fn rigid_ends_follow_depths_or_lengths() {
    let frame = |more: &str| {
        let input = sound(&format!(
            r#"
motion = {{ record = "el-centro-1940-ns" }}
[[building]]
name = "A"
storeys = 2
storey_height = 3
spans = [5]
concrete = "C30"
beam_mass = 3000
beam = [{{ width = 0.3, depth = 0.6 }}, {{ profile = "IPE300" }}]
column = [{{ width = 0.4, depth = 0.5 }}, {{ profile = "HEB200", axis = "weak" }}]
{more}
"#
        ));
        match &input.model.buildings[0].structure {
            Structure::Frame(frame) => (frame.clone(), input.model.buildings[0].hinges.clone()),
            other => panic!("{other:?}"),
        }
    };
    let (structure, _) = frame("rigid_ends = 0.5");
    let near = |found: [f64; 2], wanted: [f64; 2]| {
        let mut both = found.into_iter().zip(wanted);
        assert!(
            both.all(|(a, b)| (a - b).abs() < 1e-12),
            "{found:?} {wanted:?}"
        );
    };
    for line in 0..2 {
        near(structure.rigid_zone([0, line]), [0.125, 0.15]);
        near(structure.rigid_zone([1, line]), [0.05, 0.075]);
    }
    near(
        [structure.clear_span([0, 0]), structure.clear_height([1, 0])],
        [4.75, 2.775],
    );
    near([structure.clear_height([0, 1]), 0.0], [2.85, 0.0]);
    let (structure, hinges) = frame(
        "rigid_ends = { beams = \"20 cm\" }\njoint = { rotational_stiffness = \"40 MN.m/rad\", hinge = { rule = \"bilinear\", yield = \"180 kN.m\", post_yield = 0.03 } }",
    );
    near(structure.rigid_zone([1, 1]), [0.2, 0.0]);
    assert_eq!(structure.joint.rotational_stiffness, None);
    let Some(jostle::Hinges::Frame(hinges)) = hinges else {
        panic!("{hinges:?}");
    };
    let law = hinges.beams[1][0];
    assert_eq!(law.backbone().initial(), 40e6);
    assert_eq!(law.backbone().yield_force(), 180e3);
    // Hinges given in EI/L take the length that bends.
    let hinged = "hinges = { rule = \"bilinear\", initial = 100, beam = { yield = \"180 kN.m\", post_yield = 0.03 } }\n";
    let stiffness = |more: &str| match frame(&format!("{hinged}{more}")).1 {
        Some(jostle::Hinges::Frame(hinges)) => hinges.beams[0][0].backbone().initial(),
        other => panic!("{other:?}"),
    };
    let ratio = stiffness("rigid_ends = 1") / stiffness("");
    assert!((ratio - 5.0 / 4.5).abs() < 1e-12, "{ratio}");
}

#[test]
fn rigid_ends_that_do_not_fit_are_refused() {
    let refused = |sections: &str, more: &str| {
        refusal(&format!(
            "motion = {{ record = \"el-centro-1940-ns\" }}\n[[building]]\nname = \"A\"\nstoreys = 1\nstorey_height = 3\nspans = [5]\nfloor_mass = 1e5\n{sections}\n{more}\n"
        ))
    };
    let stiff = "column = { EI = \"60 MN.m2\", mass = 500 }\nbeam = { EI = \"60 MN.m2\" }";
    for (more, part) in [
        ("rigid_ends = 0.5", "no column or beam has a depth"),
        ("rigid_ends = 1.5", "must lie between 0 and 1"),
        (
            "rigid_ends = { beams = \"2.6 m\" }",
            "leaves nothing of the beam of bay 1",
        ),
        (
            "rigid_ends = { columns = \"3.5 m\" }",
            "leaves nothing of the column at line 1",
        ),
        (
            "joint = { hinge = { rule = \"bilinear\", yield = 1e5, post_yield = 0.03 } }",
            "needs the stiffness of the connection",
        ),
        (
            "joint = { rotational_stiffness = 1e7, hinge = { rule = \"bilinear\", yield = 1e5, post_yield = 0.03 } }\nhinges = { rule = \"bilinear\", beam = { yield = 1e5, post_yield = 0.03 } }",
            "keep either joint.hinge",
        ),
    ] {
        let text = refused(stiff, more);
        assert!(text.contains(part), "{more}: {text}");
    }
}
