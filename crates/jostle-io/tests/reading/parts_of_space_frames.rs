//! Braces, panels, walls, profiles, slabs and rigid ends of space frames: what a file says, and the same in plane frames.

use jostle::{
    DiagonalKind, GroundMotion, PlanAxis, SpaceFrame, SpacePlace, SpaceSection, Structure,
};
use jostle_testkit::compare::close;
use jostle_testkit::files::{read, refusal};
use jostle_testkit::motions::fading;
use jostle_testkit::runs;

const SPACE: &str = r#"
[[building]]
name = "A"
kind = "space-frame"
storeys = 2
storey_height = "3.2 m"
lines_x = ["0 m", "6 m", "11 m"]
lines_y = ["0 m", "5 m", "9 m"]
plan = [["0 m", "0 m"], ["11 m", "0 m"], ["11 m", "5 m"], ["6 m", "5 m"], ["6 m", "9 m"], ["0 m", "9 m"]]
mass = "90 t"
elastic_modulus = "30 GPa"
stiffness_factor = 0.5
column = { size = ["0.5 m", "0.4 m"] }
beam_x = { width = "0.3 m", depth = "0.6 m" }
beam_y = { width = "0.3 m", depth = "0.5 m" }
"#;

fn frame(text: &str) -> SpaceFrame {
    let input = read(text).unwrap_or_else(|error| panic!("{error}"));
    match &input.model.buildings[0].structure {
        Structure::Tiers(tiers) => tiers.space_frame.clone().expect("a space frame"),
        other => panic!("no plan: {other:?}"),
    }
}

fn with(more: &str) -> SpaceFrame {
    frame(&format!("{SPACE}{more}"))
}

fn refused(more: &str) -> String {
    refusal(&format!("{SPACE}{more}"))
}

fn section(frame: &SpaceFrame, place: SpacePlace) -> SpaceSection {
    let mut members = frame.members.iter();
    let member = members.find(|member| member.place == place);
    member.expect("a member").section
}

const CORNER: SpacePlace = SpacePlace::Column {
    line: [0, 0],
    storey: 0,
};

#[test]
fn braces_stand_in_the_bays_that_are_named() {
    let names = |more: &str| -> Vec<String> {
        let frame = with(more);
        frame
            .diagonals
            .iter()
            .map(|diagonal| diagonal.place.to_string())
            .collect()
    };
    // The L has no bay from x = 2 on line y = 3.
    let all = names("brace = [{ along = \"x\", storeys = 1, EA = \"300 MN\" }]\n");
    assert_eq!(
        all,
        [
            "brace_x.1.1.1.up",
            "brace_x.1.2.1.up",
            "brace_x.1.1.2.up",
            "brace_x.1.2.2.up",
            "brace_x.1.1.3.up"
        ]
    );
    let named =
        "brace = [{ along = \"y\", x = 3, y = 1, direction = \"both\", EA = \"300 MN\" }]\n";
    assert_eq!(
        names(named),
        [
            "brace_y.1.3.1.up",
            "brace_y.1.3.1.down",
            "brace_y.2.3.1.up",
            "brace_y.2.3.1.down"
        ]
    );
    for diagonal in with(named).diagonals {
        assert_eq!(diagonal.place.line.expect("a line").along, PlanAxis::Y);
        close(
            diagonal.stiffness,
            300e6 / 5_f64.hypot(3.2),
            1e8,
            1e-14,
            "EA/l",
        );
    }
    let yielding = with(
        "brace = [{ along = \"x\", y = 1, profile = \"HEB160\", hinge = { rule = \"buckling\", curve = \"c\", yield_strength = \"355 MPa\" } }]\n",
    );
    assert_eq!(yielding.diagonals.len(), 4);
    assert!(
        yielding
            .diagonals
            .iter()
            .all(|own| own.hysteresis.is_some())
    );
    // Bays of 6 m and 5 m: the longer strut buckles first.
    let buckling = |index: usize| {
        let hysteresis = yielding.diagonals[index].hysteresis.expect("it buckles");
        hysteresis
            .backbone()
            .side(jostle::hysteresis::Side::Negative)
            .yielding
            .force
    };
    assert!(buckling(0) < buckling(1));
}

/// With floors = "all" a slab before the bay of the neighbour is not left without a contact in silence.
#[test]
fn a_slab_that_meets_no_column_is_told() {
    let building = |name: &str, at: &str, lines_y: &str, heights: &str| {
        format!(
            "[[building]]\nname = \"{name}\"\nkind = \"space-frame\"\nat = {at}\nstorey_height = {heights}\nlines_x = [0, 6]\nlines_y = {lines_y}\nmass = \"60 t\"\nelastic_modulus = \"30 GPa\"\ncolumn = {{ size = [0.5, 0.4] }}\nbeam_x = {{ width = 0.3, depth = 0.5 }}\nbeam_y = {{ width = 0.3, depth = 0.5 }}\n"
        )
    };
    let text = format!(
        "{}{}[[gap]]\nbetween = [\"A\", \"B\"]\nfloors = \"all\"\nlaw = \"hertz\"\nstiffness = 2e9\n",
        building("A", "[0, 0]", "[0, 5]", "[4, 3.6]"),
        building("B", "[6.02, 1]", "[0, 3]", "[2.7, 3.4]")
    );
    let warnings = read(&text)
        .unwrap_or_else(|error| panic!("{error}"))
        .warnings;
    let told = warnings.iter().any(|warning| {
        warning.contains(
            "gap[0].floors: floors 1, 2 of \"B\", from 2.700 m to 6.100 m, meet no column of \"A\"",
        ) && warning.contains("none of its columns stands within the common width")
    });
    assert!(told, "{warnings:?}");
}

/// Panels of 4 t on the first line: 4 t on floor 1 and 2 t on floor 2, at both joints, beside 90 t spread over the L.
#[test]
fn panels_have_mass_at_their_joints() {
    let floors = |more: &str| {
        let panel =
            format!("infill = [{{ along = \"x\", x = 1, y = 1, stiffness = 8e7{more} }}]\n");
        let input = read(&format!("{SPACE}{panel}")).unwrap_or_else(|error| panic!("{error}"));
        match &input.model.buildings[0].structure {
            Structure::Tiers(tiers) => tiers.floors.clone(),
            other => panic!("no plan: {other:?}"),
        }
    };
    let (plain, heavy) = (floors(""), floors(", mass = \"4 t\""));
    for (panels, (plain, heavy)) in [4e3, 2e3].into_iter().zip(plain.iter().zip(&heavy)) {
        assert_eq!(plain.mass, 90e3);
        close(heavy.mass, 90e3 + panels, 1e5, 1e-14, "mass");
        let centre = [
            (90e3 * plain.centre[0] + panels * 3.0) / heavy.mass,
            90e3 * plain.centre[1] / heavy.mass,
        ];
        let about = |mass: f64, at: [f64; 2]| {
            mass * ((at[0] - centre[0]).powi(2) + (at[1] - centre[1]).powi(2))
        };
        let polar = plain.polar_mass
            + about(90e3, plain.centre)
            + about(0.5 * panels, [0.0, 0.0])
            + about(0.5 * panels, [6.0, 0.0]);
        close(heavy.centre[0], centre[0], 5.0, 1e-13, "centre");
        close(heavy.centre[1], centre[1], 5.0, 1e-13, "centre");
        close(heavy.polar_mass, polar, polar, 1e-13, "polar mass");
    }
}

/// Connections of beams yield as those of plane frames at the same lines, shaken along x and across.
#[test]
fn connections_yield_as_in_plane_frames() {
    let joint = "joint = { rotational_stiffness = \"40 MN.m/rad\", hinge = { rule = \"bilinear\", yield = \"60 kN.m\", post_yield = 0.03 } }\n";
    let weaker = "joint = { rotational_stiffness = \"30 MN.m/rad\", hinge = { rule = \"bilinear\", yield = \"45 kN.m\", post_yield = 0.03 } }\n";
    let usual = "storeys = 2\nstorey_height = \"3.2 m\"\nmass = \"60 t\"\naxial = \"rigid\"\np_delta = false\ndamping = { alpha = 0.4, beta = 0.0 }\n";
    let plane = |name: &str, direction: &str, at: &str, spans: &str, column: &str, joint: &str| {
        format!(
            "[[building.frame]]\nname = \"{name}\"\nat = {at}\ndirection = \"{direction}\"\nspans = {spans}\nelastic_modulus = \"30 GPa\"\ncolumn = {column}\nbeam = {{ width = 0.3, depth = 0.5 }}\naxial = \"rigid\"\n{joint}"
        )
    };
    let frames = [
        plane(
            "a",
            "x",
            "[[0, 0], [0, 5]]",
            "[6, 5]",
            "{ width = 0.4, depth = 0.5 }",
            joint,
        ),
        plane(
            "b",
            "y",
            "[[0, 0], [6, 0], [11, 0]]",
            "[5]",
            "{ width = 0.5, depth = 0.4 }",
            weaker,
        ),
    ];
    let at_lines = format!(
        "[[building]]\nname = \"A\"\nkind = \"frame\"\nplan = [11, 5]\n{}{}{}",
        usual.replace("axial = \"rigid\"\n", ""),
        frames[0],
        frames[1]
    );
    let inner = |joint: &str| {
        let table = joint.trim().trim_start_matches("joint = ");
        table.to_owned()
    };
    let in_space = format!(
        "[[building]]\nname = \"A\"\nkind = \"space-frame\"\nlines_x = [0, 6, 11]\nlines_y = [0, 5]\nelastic_modulus = \"30 GPa\"\ncolumn = {{ size = [0.5, 0.4] }}\nbeam_x = {{ width = 0.3, depth = 0.5 }}\nbeam_y = {{ width = 0.3, depth = 0.5 }}\n{usual}joint = {{ x = {}, y = {} }}\n",
        inner(joint),
        inner(weaker)
    );
    // Beams twist with the joints of the other direction: they hardly resist here.
    let in_space = in_space.replace("elastic_modulus", "torsion_factor = 1e-9\nelastic_modulus");
    for angle in [0.0, std::f64::consts::FRAC_PI_2] {
        let peaks = [&at_lines, &in_space].map(|text| {
            let mut input = read(text).unwrap_or_else(|error| panic!("{error}"));
            input.model.analysis.step = Some(2e-3);
            let motion = GroundMotion {
                bearing: Some(Box::new(jostle::Bearing {
                    angle,
                    across: None,
                })),
                ..fading("along", 9.0, [2.0, 3.0], 150)
            };
            let (_, outcome) = runs::run(&input.model, &motion, Some(0.02));
            assert!(
                outcome.energy.hysteretic > 1e3,
                "{}",
                outcome.energy.hysteretic
            );
            let floors = outcome.peaks.floors(0);
            let moved = floors.iter();
            moved
                .map(|floor| {
                    [
                        floor.displacement().size(),
                        floor.across().displacement().size(),
                    ]
                })
                .collect::<Vec<_>>()
        });
        for (one, other) in peaks[0].iter().zip(&peaks[1]) {
            let scale = one[0].max(one[1]);
            close(other[0], one[0], scale, 1e-6, "along x");
            close(other[1], one[1], scale, 1e-6, "across");
        }
    }
    for (key, problem) in [
        (
            "joint = { hinge = { rule = \"bilinear\", yield = 6e4, post_yield = 0.03 } }\n",
            "rotational_stiffness: is missing",
        ),
        (
            "joint = { rotational_stiffness = 4e7 }\n",
            "hinge: is missing",
        ),
        (
            "joint = { rotational_stiffness = 4e7, hinge = { rule = \"bilinear\", yield = 6e4, post_yield = 0.03 }, x = {} }\n",
            "cannot be combined with x and y",
        ),
        (
            "joint = { rotational_stiffness = 4e7, hinge = { rule = \"bilinear\", yield = 6e4, post_yield = 0.03 } }\nhinges = { rule = \"bilinear\", beam = { yield = 6e4, post_yield = 0.02 } }\n",
            "cannot be combined with hinges of beams",
        ),
    ] {
        let said = refused(key);
        assert!(said.contains(problem), "{problem}: {said}");
    }
}

/// Between any two joints of the grid: from below, whichever is named first, with EA over the length between them.
#[test]
fn a_brace_joins_two_joints_by_name() {
    let found =
        |ends: &str| with(&format!("brace = [{{ {ends}, EA = \"500 MN\" }}]\n")).diagonals[0];
    for (ends, crossings, length, name) in [
        (
            "from = \"0.1.1\", to = \"2.2.3\"",
            [[0, 0], [1, 2]],
            (36.0_f64 + 81.0 + 6.4 * 6.4).sqrt(),
            "brace.0.1.1.to.2.2.3",
        ),
        (
            "from = \"2.1.1\", to = \"1.3.2\"",
            [[2, 1], [0, 0]],
            (121.0_f64 + 25.0 + 3.2 * 3.2).sqrt(),
            "brace.1.3.2.to.2.1.1",
        ),
        (
            "from = \"0.2.3\", to = \"2.2.1\"",
            [[1, 2], [1, 0]],
            9.0_f64.hypot(6.4),
            "brace.0.2.3.to.2.2.1",
        ),
        (
            "from = \"0.1.2\", to = \"2.1.2\"",
            [[0, 1], [0, 1]],
            6.4,
            "brace.0.1.2.to.2.1.2",
        ),
        (
            "from = \"1.1.2\", to = \"0.1.1\"",
            [[0, 0], [0, 1]],
            5_f64.hypot(3.2),
            "brace_y.1.1.1.up",
        ),
    ] {
        let brace = found(ends);
        assert_eq!(brace.place.crossings(), Some(crossings), "{ends}");
        assert_eq!(brace.place.to_string(), name);
        close(brace.stiffness, 500e6 / length, 1e8, 1e-13, name);
    }
    for (ends, problem) in [
        (
            "from = \"0.1\", to = \"2.2.3\"",
            "write FLOOR.X.Y, such as \"0.1.1\"",
        ),
        (
            "from = \"0.1.4\", to = \"2.2.3\"",
            "lines of lines_x from 1 to 3 and of lines_y from 1 to 3",
        ),
        ("from = \"0.1.1\"", "to: is missing"),
        ("from = \"0.1.1\", to = \"0.1.2\"", "is at floor 0 as well"),
        (
            "from = \"0.1.1\", to = \"2.2.3\", along = \"x\"",
            "along: cannot be combined with from and to",
        ),
        // Outside of the L.
        (
            "from = \"0.1.1\", to = \"2.3.3\"",
            "the nearest joint is \"2.3.2\"",
        ),
    ] {
        let said = refused(&format!("brace = [{{ {ends}, EA = 5e8 }}]\n"));
        assert!(said.contains(problem), "{problem}: {said}");
    }
    let upright = "brace = [{ from = \"0.1.1\", to = \"2.1.1\", EA = 5e8 }]\naxial = \"rigid\"\n";
    let said = refused(upright);
    assert!(said.contains("next to axially rigid columns"), "{said}");
}

#[test]
fn wrong_places_are_refused() {
    let missing = refused("brace = [{ EA = 3e8 }]\n");
    assert!(
        missing.contains("along = \"x\" or along = \"y\""),
        "{missing}"
    );
    let outside = refused("brace = [{ along = \"x\", x = 2, y = 3, EA = 3e8 }]\n");
    assert!(
        outside.contains("brace_x.1.2.3.up ends at x = 3, y = 3 of floor 1"),
        "{outside}"
    );
    let beyond = refused("brace = [{ along = \"x\", x = 3, EA = 3e8 }]\n");
    assert!(
        beyond.contains("must be within 1 to 2, found 3"),
        "{beyond}"
    );
    let bay = refused("brace = [{ along = \"x\", bay = 1, EA = 3e8 }]\n");
    assert!(bay.contains("unknown key \"bay\""), "{bay}");
    let twice = refused(
        "brace = [{ along = \"x\", y = 1, EA = 3e8 }, { along = \"x\", x = 1, EA = 3e8 }]\n",
    );
    assert!(
        twice.contains("gives brace_x.1.1.1.up a second time"),
        "{twice}"
    );
    let beams = refused("coupling_beam = [{ bay = 1, EI = 1 }]\n");
    assert!(beams.contains("are those of beam_x and beam_y"), "{beams}");
    let walls = refused(
        "wall = [{ along = \"x\", x = 1, y = 1, length = 2, thickness = 0.2 }, { along = \"y\", y = 1, length = 2, thickness = 0.2 }]\n",
    );
    assert!(
        walls.contains("stands where another wall stands: at column.1.1.1"),
        "{walls}"
    );
    let long =
        refused("wall = [{ along = \"x\", x = 1, y = 1, length = \"12 m\", thickness = 0.2 }]\n");
    assert!(
        long.contains("leaves no length between the joints of the beam from x = 1"),
        "{long}"
    );
}

#[test]
fn profiles_bend_about_both_axes_and_do_not_crack() {
    let swap = |column: &str| {
        frame(
            &SPACE
                .replace("column = { size = [\"0.5 m\", \"0.4 m\"] }", column)
                .replace("elastic_modulus = \"30 GPa\"", "concrete = \"C30\""),
        )
    };
    let strong = section(&swap("column = { profile = \"HEB300\" }"), CORNER);
    // Tables of ArcelorMittal: 25 170 and 8563 cm⁴, 149.1 cm², I_t = 185 cm⁴.
    let due = [25_170e-8, 8563e-8].map(|inertia| 210e9 * inertia);
    for (flexural_rigidity, due) in strong.flexural_rigidity.into_iter().zip(due) {
        close(flexural_rigidity, due, due, 1e-3, "EI");
    }
    let axial = 210e9 * 149.1e-4;
    close(strong.axial_rigidity.expect("EA"), axial, axial, 1e-3, "EA");
    let torsion = 210e9 / 2.6 * 185e-8;
    close(strong.torsional_rigidity, torsion, torsion, 5e-3, "GJ");
    let weak = section(
        &swap("column = { profile = \"HEB300\", axis = \"weak\" }"),
        CORNER,
    );
    assert_eq!(weak.flexural_rigidity[0], strong.flexural_rigidity[1]);
    assert_eq!(weak.flexural_rigidity[1], strong.flexural_rigidity[0]);
    let text = SPACE.replace(
        "size = [\"0.5 m\", \"0.4 m\"]",
        "size = [1, 1], profile = \"HEB300\"",
    );
    assert!(refusal(&text).contains("is given together with size"));
    let text = SPACE.replace(
        "size = [\"0.5 m\", \"0.4 m\"]",
        "size = [1, 1], axis = \"weak\"",
    );
    assert!(refusal(&text).contains("is for a profile"));
}

#[test]
fn rigid_ends_follow_the_sizes_that_meet() {
    let frame = with("rigid_ends = 0.5\n");
    // Half of the half sizes: columns 0.5 and 0.4, beams 0.6 deep.
    assert_eq!(frame.rigid_zones[&[0, 0, 0]], [0.125, 0.1, 0.15]);
    let beam = SpacePlace::BeamX {
        span: 0,
        line: 0,
        floor: 0,
    };
    close(
        frame.clear_length(beam, &[3.2, 3.2]),
        6.0 - 0.25,
        1.0,
        1e-14,
        "beam",
    );
    close(
        frame.clear_length(CORNER, &[3.2, 3.2]),
        3.2 - 0.15,
        1.0,
        1e-14,
        "column",
    );
    let frame = with("rigid_ends = { beams = \"0.2 m\", columns = \"0.3 m\" }\n");
    assert!(
        frame
            .rigid_zones
            .values()
            .all(|frame| *frame == [0.2, 0.2, 0.3])
    );
    assert!(refused("rigid_ends = 2\n").contains("must lie between 0 and 1"));
}

/// Halves of EI and GA by EN 1998-1; E A/4 of a core given in numbers; the weak plane keeps length and thickness.
#[test]
fn walls_of_space_frames_have_factors_and_rigidities() {
    let place = SpacePlace::Column {
        line: [0, 1],
        storey: 0,
    };
    let of = |more: &str| {
        let explicit = with(&format!(
            "wall = [{{ along = \"y\", x = 1, y = 2, length = \"3 m\", thickness = \"0.25 m\"{more} }}]\n"
        ));
        section(&explicit, place)
    };
    let (whole, half) = (
        of(", stiffness_factor = 1"),
        of(", stiffness_factor = \"en1998\""),
    );
    let [shear, halved] = [whole, half].map(|section| section.shear_rigidity.expect("it shears"));
    for axis in [0, 1] {
        let due = 0.5 * whole.flexural_rigidity[axis];
        close(half.flexural_rigidity[axis], due, due, 1e-14, "EI");
        close(halved[axis], 0.5 * shear[axis], shear[axis], 1e-14, "GA");
    }
    // The factor of the building holds where the wall has none.
    assert_eq!(of("").flexural_rigidity, half.flexural_rigidity);
    let given = of(", stiffness_factor = 0.5, EI = \"800 GN.m2\", EA = \"60 GN\", GA = \"13 GN\"");
    assert_eq!(given.flexural_rigidity[1], 400e9);
    assert_eq!(given.flexural_rigidity[0], half.flexural_rigidity[0]);
    assert_eq!(given.axial_rigidity, Some(60e9));
    assert_eq!(given.shear_rigidity, Some([shear[0], 13e9]));
    let refused = refused(
        "wall = [{ along = \"y\", x = 1, length = 3, thickness = 0.2, stiffness_factor = \"aci\" }]\n",
    );
    assert!(refused.contains("stiffness_factor"), "{refused}");
}

#[test]
fn walls_are_wide_columns_with_arms() {
    let frame = with(
        "wall = [{ along = \"x\", x = 1, y = 2, length = \"3 m\", thickness = \"0.25 m\" }]\nrigid_ends = 1\n",
    );
    let place = SpacePlace::Column {
        line: [0, 1],
        storey: 1,
    };
    let wall = section(&frame, place);
    assert_eq!(wall.size, [3.0, 0.25]);
    let due = 0.5 * 30e9 * 0.25 * 27.0 / 12.0;
    close(wall.flexural_rigidity[0], due, due, 1e-14, "EI");
    assert!(wall.shear_rigidity.is_some());
    assert!(section(&frame, CORNER).shear_rigidity.is_none());
    assert_eq!(frame.rigid_zones[&[0, 0, 1]], [1.5, 0.125, 0.0]);
    assert_eq!(frame.rigid_zones[&[1, 0, 1]], [1.5, 0.125, 0.0]);
    assert_eq!(frame.rigid_zones[&[0, 0, 0]][2], 0.3);
}

/// Two equal faces along x, with all that can stand in them.
const FACE: &str = r#"
axial = "flexible"
shear = "flexible"
stiffness_factor = { column = 0.7, beam = 0.5 }
rigid_ends = 1
"#;

const PANEL: &str = "modulus = \"4 GPa\", thickness = \"0.2 m\", width = \"mainstone\", strength = { rule = \"bertoldi\", compression = \"4 MPa\", shear = \"0.3 MPa\", sliding = \"0.2 MPa\" }";

/// A space frame of two faces along x moves along x as two plane frames that the same words describe: columns, a steel column, beams with
/// slabs, a wall, braces, panels, rigid ends.
#[test]
fn two_faces_are_two_plane_frames() {
    let slab = "slab = { depth = \"150 mm\", width = \"en1992\", spacing = \"4.7 m\" }";
    let head = "[[building]]\nname = \"A\"\nstoreys = 3\nstorey_height = \"3.2 m\"\nmass = \"90 t\"\nplan = [\"17 m\", \"5 m\"]\ndamping = { alpha = 0.4, beta = 0 }\n";
    let space = format!(
        r#"{head}
kind = "space-frame"
concrete = "C30"
lines_x = ["0 m", "6 m", "11 m", "17 m"]
lines_y = ["0 m", "5 m"]
{FACE}
beam_x = {{ width = "0.3 m", depth = "0.6 m", {slab} }}
beam_y = {{ width = "0.3 m", depth = "0.5 m" }}
brace = [{{ along = "x", x = 1, profile = "HEB120", direction = "down" }}]
infill = [{{ along = "x", x = 2, storeys = [1, 2], {PANEL} }}]
wall = [{{ along = "x", x = 4, length = "3 m", thickness = "0.25 m" }}]
[[building.column]]
size = ["0.5 m", "0.4 m"]
[[building.column]]
x = 1
profile = "HEB300"
"#
    );
    let plane = format!(
        r#"{head}
kind = "frame"
[[building.frame]]
at = [[0, 0], [0, 5]]
direction = "x"
spans = ["6 m", "5 m", "6 m"]
concrete = "C30"
{FACE}
beam = {{ width = "0.3 m", depth = "0.6 m", {slab} }}
brace = [{{ bay = 1, profile = "HEB120", direction = "down" }}]
infill = [{{ bay = 2, storeys = [1, 2], {PANEL} }}]
wall = [{{ line = 4, length = "3 m", thickness = "0.25 m" }}]
[[building.frame.column]]
line = [2, 3]
width = "0.4 m"
depth = "0.5 m"
[[building.frame.column]]
line = 1
profile = "HEB300"
mass = 0
[[building.frame]]
at = [[1, 0], [16, 0]]
direction = "y"
spans = ["5 m"]
concrete = "C30"
column = {{ width = "0.4 m", depth = "0.4 m" }}
beam = {{ width = "0.3 m", depth = "0.5 m" }}
"#
    );
    let motion: GroundMotion = fading("along", 9.0, [2.0, 3.0], 150);
    let [a, b] = [space, plane].map(|text| {
        let mut model = read(&text).unwrap_or_else(|error| panic!("{error}")).model;
        model.analysis.solver = Some(jostle::Solver::Riccati);
        model.analysis.step = Some(2e-3);
        runs::run(&model, &motion, None)
    });
    let kinds = |system: &jostle::System| {
        let all = system.buildings[0].discretization.diagonals.iter();
        let places = all.map(|diagonal| {
            (
                diagonal.place.kind,
                diagonal.place.storey,
                diagonal.place.bay,
                diagonal.place.rise.name(),
            )
        });
        let mut places: Vec<_> = places
            .map(|(kind, storey, bay, rise)| (kind == DiagonalKind::Brace, storey, bay, rise))
            .collect();
        places.sort_unstable();
        places
    };
    assert_eq!(kinds(&a.0), kinds(&b.0));
    assert!(b.1.energy.hysteretic > 1e2, "{}", b.1.energy.hysteretic);
    close(
        a.1.energy.hysteretic,
        b.1.energy.hysteretic,
        b.1.energy.hysteretic,
        1e-7,
        "energy",
    );
    for (floor, other) in a.1.peaks.floors(0).iter().zip(b.1.peaks.floors(0)) {
        let [size, other] = [floor, &other].map(|floor| floor.displacement().size());
        close(size, other, other, 1e-9, "displacement");
    }
}
