//! Walls of space frames whose feet are fibres: the plane frame with the same wall, a quarter turn, the section that is laid, refusals.

use jostle::hysteresis::{HysteresisRule, Side};
use jostle::{ColumnFibres, Fibre, FibreMaterial, SpaceFrame, SpacePlace, Structure, Summary};
use jostle_testkit::compare::{close, near};
use jostle_testkit::files::{refusal, sound};
use jostle_testkit::runs::run_and_summary;

/// Bars and ties of a section of 0.4 × 1.5 m: 30 mm lie outside of the ties, as much as one of 50 layers.
const BARS: &str = "concrete = \"30 MPa\"\nsteel = \"400 MPa\"\nbars = { edges = \"6 d25\", edge_length = \"0.3 m\", web = \"8 d16\" }\nties = \"d10 @ 100 mm\"\n";

const BEAM: &str = "{ width = 0.3, depth = 0.5 }";

fn motion(angle: &str) -> String {
    format!(
        "motion = {{ record = \"el-centro-1940-ns\", pga = \"0.5 g\", duration = \"6 s\"{angle} }}\nanalysis = {{ solver = \"riccati\", step = \"1 ms\", accept_unusual = true }}\n"
    )
}

/// Two storeys with a wall on the first line and a column on the second one.
fn plane() -> String {
    let motion = motion("");
    format!(
        r#"{motion}
[[building]]
name = "A"
kind = "frame"
storeys = 2
storey_height = 3
spans = [5]
density = 0
elastic_modulus = "30 GPa"
floor_mass = "100 t"
floor_load = "300 kN"
gravity = true
p_delta = false
column_segments = 1
axial = {{ columns = "flexible", beams = "rigid" }}
damping = {{ alpha = 0.5, beta = 0 }}
column = {{ width = 0.4, depth = 0.4 }}
beam = {BEAM}
[[building.wall]]
line = 1
length = 1.5
thickness = 0.4
{BARS}hinge = {{ rule = "fibre", length = "0.5 m", fibres = 50 }}
"#
    )
}

/// Two such frames side by side, along x or across, with the mass of both. `hinge`: more of the wall.
fn in_space(along: &str, hinge: &str) -> String {
    let (across, angle) = match along {
        "x" => ("y", ""),
        _ => ("x", ", angle = \"90 deg\""),
    };
    let motion = motion(angle);
    format!(
        r#"{motion}
[[building]]
name = "A"
kind = "space-frame"
storeys = 2
storey_height = 3
lines_{along} = [0, 5]
lines_{across} = [0, 6]
density = 0
elastic_modulus = "30 GPa"
mass = "200 t"
floor_load = "600 kN"
gravity = true
p_delta = false
damping = {{ alpha = 0.5, beta = 0 }}
column = {{ size = [0.4, 0.4] }}
beam_x = {BEAM}
beam_y = {BEAM}
[[building.wall]]
along = "{along}"
{along} = 1
length = 1.5
thickness = 0.4
elastic_modulus = "30 GPa"
{BARS}{hinge}
"#
    )
}

const HINGE: &str = "hinge = { rule = \"fibre\", length = \"0.5 m\", fibres = [50, 4] }";

fn shaken(file: &str) -> Summary {
    let input = sound(file);
    let motion = input.ground_motion().expect("the record is built in");
    let (_, outcome, summary) = run_and_summary(&input.model, &motion);
    let imbalance = outcome.energy.worst_imbalance;
    assert!(imbalance < 1e-6, "{imbalance:e}");
    summary
}

/// Two walls that move along their length are twice the wall of the plane frame.
#[test]
fn walls_that_move_in_their_plane_are_those_of_plane_frames() {
    let (plane, space) = (shaken(&plane()), shaken(&in_space("x", HINGE)));
    let [a, b] = [&plane, &space].map(|summary| &summary.buildings[0]);
    for (a, b) in a.floors.above.iter().zip(&b.floors.above) {
        near(
            b.response.displacement_max_m,
            a.response.displacement_max_m,
            1e-6,
            "floor",
        );
        near(
            b.response.displacement_min_m,
            a.response.displacement_min_m,
            1e-6,
            "floor",
        );
    }
    near(
        b.floors.above[0].response.storey_shear_peak_n,
        2.0 * a.floors.above[0].response.storey_shear_peak_n,
        1e-6,
        "base shear",
    );
    let due = &a.sections[0];
    // Bars yield and concrete passes its strength.
    assert!(due.yielded_s.is_some() && due.crushed_s.is_some());
    let names: Vec<&str> = b.sections.iter().map(|foot| foot.name.as_str()).collect();
    assert_eq!(names, ["A.column.1.1.1.foot", "A.column.1.2.1.foot"]);
    for foot in &b.sections {
        for (got, due) in [
            (foot.axial_max_n, due.axial_max_n),
            (foot.axial_min_n, due.axial_min_n),
            (foot.moment_max_n_m, due.moment_max_n_m),
            (foot.moment_min_n_m, due.moment_min_n_m),
            (foot.rotation_max_rad, due.rotation_max_rad),
            (foot.rotation_min_rad, due.rotation_min_rad),
            (foot.elongation_max_m, due.elongation_max_m),
            (
                foot.steel_strain.expect("bars"),
                due.steel_strain.expect("bars"),
            ),
            (
                foot.concrete_strain.expect("concrete"),
                due.concrete_strain.expect("concrete"),
            ),
            (foot.dissipated_j, due.dissipated_j),
        ] {
            near(got, due, 1e-6, "foot");
        }
        let across = foot.across.as_ref().expect("it bends across");
        assert!(across.rotation_across_max_rad < 1e-9);
    }
    // The walls among the parts say the same.
    let due = &a.parts[0];
    for part in &b.parts {
        for (got, due) in [
            (part.force_min_n, due.force_min_n),
            (part.deformation_max, due.deformation_max),
            (part.moment_max_n_m.unwrap(), due.moment_max_n_m.unwrap()),
            (
                part.rotation_max_rad.unwrap(),
                due.rotation_max_rad.unwrap(),
            ),
            (
                part.rotation_min_rad.unwrap(),
                due.rotation_min_rad.unwrap(),
            ),
            (part.dissipated_j, due.dissipated_j),
        ] {
            near(got, due, 1e-6, "part");
        }
    }
}

/// Walls along y that are shaken along y are walls along x that are shaken along x.
#[test]
fn a_quarter_turn_exchanges_the_planes_of_a_wall() {
    let [x, y] = ["x", "y"].map(|along| shaken(&in_space(along, HINGE)));
    let [x, y] = [&x, &y].map(|summary| &summary.buildings[0]);
    let (foot, turned) = (&x.sections[0], &y.sections[0]);
    let across = turned.across.as_ref().expect("it bends across");
    for (got, due) in [
        (turned.axial_max_n, foot.axial_max_n),
        (turned.axial_min_n, foot.axial_min_n),
        (across.moment_across_max_n_m, foot.moment_max_n_m),
        (across.moment_across_min_n_m, foot.moment_min_n_m),
        (across.rotation_across_max_rad, foot.rotation_max_rad),
        (across.rotation_across_min_rad, foot.rotation_min_rad),
        (
            y.parts[0].rotation_max_rad.unwrap(),
            x.parts[0].rotation_max_rad.unwrap(),
        ),
        (
            y.parts[0].rotation_min_rad.unwrap(),
            x.parts[0].rotation_min_rad.unwrap(),
        ),
    ] {
        near(got, due, 1e-7, "foot");
    }
    assert!(foot.rotation_max_rad > 1e-3);
}

fn frame(file: &str) -> SpaceFrame {
    match sound(file).model.buildings.remove(0).structure {
        Structure::Tiers(tiers) => tiers.space_frame.expect("a space frame"),
        other => panic!("no plan: {other:?}"),
    }
}

fn strength(fibre: &Fibre) -> f64 {
    fibre.spring.backbone().side(Side::Negative).yielding.force
}

/// Area and second moments of the concrete about both axes, and places of bars, by hand; the cells have their own inertia besides.
#[test]
fn the_section_lies_along_the_wall() {
    for (along, hinge, across) in [
        ("x", "[50, 8]", 8.0_f64),
        ("y", "[50, 8]", 8.0),
        ("y", "50", 4.0),
    ] {
        let hinge = format!("hinge = {{ rule = \"fibre\", length = \"0.5 m\", fibres = {hinge} }}");
        let text = in_space(along, &hinge).replace("ties = \"d10 @ 100 mm\"\n", "");
        let frame = frame(&text);
        let place = SpacePlace::Column {
            line: [0, 0],
            storey: 0,
        };
        assert_eq!(frame.fibres.len(), 2);
        let own: &ColumnFibres = &frame.fibres[&place];
        assert_eq!((own.length, own.at_ends), (0.5, [true, false]));
        let concrete: Vec<&Fibre> = own
            .fibres
            .iter()
            .filter(|fibre| matches!(fibre.spring.rule(), HysteresisRule::Concrete(_)))
            .collect();
        let axes = if along == "x" { [0, 1] } else { [1, 0] };
        let sum = |of: &dyn Fn(&Fibre) -> f64| -> f64 {
            let all = concrete.iter();
            all.map(|fibre| strength(fibre) / 30e6 * of(fibre)).sum()
        };
        near(sum(&|_| 1.0), 0.4 * 1.5, 1e-12, "area");
        for (axis, sides, parts) in [(axes[0], [1.5, 0.4], 50.0), (axes[1], [0.4, 1.5], across)] {
            let [high, wide]: [f64; 2] = sides;
            close(sum(&|fibre| fibre.at[axis]), 0.0, 1.0, 1e-12, "first");
            let inertia = wide * high.powi(3) / 12.0 * (1.0 - f64::powi(parts, -2));
            near(
                sum(&|fibre| fibre.at[axis].powi(2)),
                inertia,
                1e-12,
                "second",
            );
        }
        // Four corner bars of each edge, and two between them at its faces; web bars at both faces.
        let bars = own
            .fibres
            .iter()
            .filter(|fibre| fibre.material == FibreMaterial::Bar);
        assert_eq!(bars.clone().count(), 2 * 6 + 8);
        let outer = 0.75 - 0.035 - 0.0125;
        let corner = |fibre: &&Fibre| {
            (fibre.at[axes[0]].abs() - outer).abs() < 1e-9
                && (fibre.at[axes[1]].abs() - (0.2 - 0.0475)).abs() < 1e-9
        };
        assert_eq!(bars.filter(corner).count(), 4);
    }
}

/// Walls beside columns of fibres keep to their own table, and stay elastic without one.
#[test]
fn columns_of_fibres_stand_beside_walls() {
    let columns = "column = { size = [0.4, 0.4], concrete = \"C30\", steel = \"HRB400\", bars = \"8 d20\" }\nhinges = { rule = \"fibre\", length = 0.4, ends = \"base\" }";
    let plain = "column = { size = [0.4, 0.4] }";
    for (hinge, of_walls) in [("", 0), (HINGE, 2)] {
        let mut text = in_space("x", hinge).replace(plain, columns);
        if hinge.is_empty() {
            text = text.replace(BARS, "");
        }
        let frame = frame(&text);
        let walls = frame
            .fibres
            .keys()
            .filter(|place| frame.walls.iter().any(|wall| wall.has(**place)));
        assert_eq!(walls.count(), of_walls);
        assert_eq!(frame.fibres.len(), 2 + of_walls);
    }
}

#[test]
fn faults_of_walls_of_fibres_in_space_are_named() {
    let good = in_space("x", HINGE);
    for (from, to, problem) in [
        (
            "rule = \"fibre\"",
            "rule = \"fibre\", yield = \"2 MN.m\"",
            "unknown key \"yield\"",
        ),
        (
            "rule = \"fibre\"",
            "rule = \"takeda\"",
            "rule: must be \"fibre\"",
        ),
        (
            "fibres = [50, 4]",
            "fibers = [50, 4]",
            "unknown key \"fibers\"",
        ),
        (
            "fibres = [50, 4]",
            "fibres = [50, 1]",
            "must lie between 2 and 100",
        ),
        (
            "bars = { edges = \"6 d25\", edge_length = \"0.3 m\", web = \"8 d16\" }",
            "",
            "but the wall has no bars",
        ),
        (
            "length = \"0.5 m\", ",
            "",
            "add length = \"paulay-priestley\" (0.2 l + 0.044 h)",
        ),
        (
            "length = \"0.5 m\"",
            "length = \"3.5 m\"",
            "is more than the height of its storey",
        ),
        (
            "gravity = true",
            "gravity = false",
            "needs the weight of the building",
        ),
        (
            "gravity = true",
            "gravity = true\naxial = \"rigid\"",
            "needs columns that change their length",
        ),
        (HINGE, "", "has no meaning without fibres"),
    ] {
        assert!(good.contains(from), "{from}");
        let said = refusal(&good.replace(from, to));
        assert!(said.contains(problem), "{problem}: {said}");
    }
    // Misspelt keys of walls of plane frames are found as well.
    let said = refusal(&plane().replace("fibres = 50", "fibers = 50"));
    assert!(said.contains("unknown key \"fibers\""), "{said}");
}
