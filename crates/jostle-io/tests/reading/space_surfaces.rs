//! Columns of space frames that yield on a surface of axial force and both moments: the plane frame with the same columns, quarter turns,
//! both solvers, a column that is pushed, what a file says, and refusals. Plastic rotations and their limits, in a plane and in space.

use jostle::pushover::{PushDirection, PushSettings, pushover};
use jostle::results::summary::{BuildingSummary, RotationLevelsSummary};
use jostle::statics::STANDARD_GRAVITY;
use jostle::{ColumnFibres, Solver, SpaceFrame, Structure, Summary};
use jostle_testkit::compare::{close, near};
use jostle_testkit::files::{refusal, sound};
use jostle_testkit::runs::{assembled, run_and_summary};

const HINGES: &str = "hinges = { rule = \"surface\", length = \"0.4 m\", post_yield = 0.02, beam_rule = \"bilinear\", beam = { yield = \"260 kN.m\", post_yield = 0.02 } }";

const BARS: &str =
    "concrete = \"30 MPa\", steel = \"400 MPa\", bars = \"12 d20\", elastic_modulus = \"30 GPa\"";

/// What buildings have in common. `motion`: more of it.
fn head(motion: &str, kind: &str) -> String {
    format!(
        r#"motion = {{ record = "el-centro-1940-ns", pga = "0.9 g", duration = "6 s"{motion} }}
analysis = {{ solver = "riccati", step = "1 ms", accept_unusual = true }}
[[building]]
name = "A"
kind = "{kind}"
storeys = 2
storey_height = 3
density = 0
elastic_modulus = "30 GPa"
gravity = true
p_delta = false
damping = {{ alpha = 0.5, beta = 0 }}
"#
    )
}

fn plane() -> String {
    let (head, bars) = (
        head("", "frame"),
        BARS.replace(", elastic_modulus = \"30 GPa\"", ""),
    );
    format!(
        r#"{head}
spans = [5]
floor_mass = "40 t"
floor_load = "300 kN"
column_segments = 1
axial = {{ columns = "flexible", beams = "rigid" }}
column = {{ width = 0.5, depth = 0.5, {bars} }}
beam = {{ width = 0.3, depth = 0.5 }}
{HINGES}
"#
    )
}

/// Two such frames side by side, along x or across, with the mass of both.
fn in_space(along: &str, motion: &str) -> String {
    let across = if along == "x" { "y" } else { "x" };
    let head = head(motion, "space-frame");
    format!(
        r#"{head}
lines_{along} = [0, 5]
lines_{across} = [0, 6]
mass = "80 t"
floor_load = "600 kN"
column = {{ size = [0.5, 0.5], {BARS} }}
beam_x = {{ width = 0.3, depth = 0.5 }}
beam_y = {{ width = 0.3, depth = 0.5 }}
{HINGES}
"#
    )
}

fn shaken(file: &str, solver: Option<Solver>) -> Summary {
    shaken_until(file, solver, f64::INFINITY)
}

/// The same of a motion that ends at an instant \[s\].
fn shaken_until(file: &str, solver: Option<Solver>, end: f64) -> Summary {
    let mut input = sound(file);
    input.model.analysis.solver = solver.or(input.model.analysis.solver);
    let mut motion = input.ground_motion().expect("the record is built in");
    motion.duration = motion.duration.min(end);
    let (_, outcome, summary) = run_and_summary(&input.model, &motion);
    let imbalance = outcome.energy.worst_imbalance;
    assert!(imbalance < 1e-6, "{imbalance:e}");
    summary
}

fn only(summary: &Summary) -> &BuildingSummary {
    &summary.buildings[0]
}

/// Two frames that move in their plane are twice the plane frame.
#[test]
fn columns_that_move_in_one_plane_are_those_of_plane_frames() {
    let (plane, space) = (shaken(&plane(), None), shaken(&in_space("x", ""), None));
    let (a, b) = (only(&plane), only(&space));
    for (a, b) in a.floors.above.iter().zip(&b.floors.above) {
        let (a, b) = (&a.response, &b.response);
        near(b.displacement_max_m, a.displacement_max_m, 1e-6, "floor");
        near(b.displacement_min_m, a.displacement_min_m, 1e-6, "floor");
        let (a, b) = (a.storey_shear_peak_n, b.storey_shear_peak_n);
        near(b, 2.0 * a, 1e-6, "storey shear");
    }
    // Ends of the plane frame by storey and line; those in space stand in pairs.
    let yielded = a.sections.iter().filter(|end| end.yielded_s.is_some());
    assert!(yielded.count() >= 3);
    assert_eq!(b.sections.len(), 2 * a.sections.len());
    for due in &a.sections {
        // A.column.LINE.STOREY.END is A.column.LINE.Y.STOREY.END.
        let parts: Vec<&str> = due.name.split('.').collect();
        for y in ["1", "2"] {
            let name = format!("A.column.{}.{y}.{}.{}", parts[2], parts[3], parts[4]);
            let found = b.sections.iter().find(|end| end.name == name);
            let found = found.unwrap_or_else(|| panic!("no {name}"));
            let moment = due.moment_max_n_m.abs().max(due.moment_min_n_m.abs());
            for (got, expected, scale) in [
                (found.axial_max_n, due.axial_max_n, due.axial_min_n.abs()),
                (found.axial_min_n, due.axial_min_n, due.axial_min_n.abs()),
                (found.moment_max_n_m, due.moment_max_n_m, moment),
                (found.moment_min_n_m, due.moment_min_n_m, moment),
                (found.rotation_max_rad, due.rotation_max_rad, 1e-2),
                (found.rotation_min_rad, due.rotation_min_rad, 1e-2),
                (found.elongation_max_m, due.elongation_max_m, 1e-3),
                (found.dissipated_j, due.dissipated_j, 1e4),
            ] {
                close(got, expected, scale, 1e-6, &name);
            }
            assert_eq!(found.yielded_s.is_some(), due.yielded_s.is_some());
            let across = found.across.as_ref().expect("it bends across");
            assert!(across.rotation_across_max_rad < 1e-9);
        }
    }
}

/// Frames along y that are shaken along y are frames along x that are shaken along x.
#[test]
fn a_quarter_turn_exchanges_the_planes_of_columns() {
    let x = shaken(&in_space("x", ""), None);
    let y = shaken(&in_space("y", ", angle = \"90 deg\""), None);
    let end = |summary: &Summary, name: &str| {
        let name = format!("A.column.{name}");
        let found = only(summary).sections.iter().find(|end| end.name == name);
        found.cloned().unwrap_or_else(|| panic!("no {name}"))
    };
    for (a, b) in [
        ("1.1.1.foot", "1.1.1.foot"),
        ("2.1.1.foot", "1.2.1.foot"),
        ("2.2.1.head", "2.2.1.head"),
    ] {
        let (foot, turned) = (end(&x, a), end(&y, b));
        let across = turned.across.as_ref().expect("it bends across");
        for (got, due, scale) in [
            (turned.axial_min_n, foot.axial_min_n, 1e6),
            (across.moment_across_max_n_m, foot.moment_max_n_m, 3e5),
            (across.moment_across_min_n_m, foot.moment_min_n_m, 3e5),
            (across.rotation_across_max_rad, foot.rotation_max_rad, 1e-2),
            (across.rotation_across_min_rad, foot.rotation_min_rad, 1e-2),
        ] {
            close(
                got,
                due,
                scale,
                1e-7,
                &format!("{} {}", foot.name, turned.name),
            );
        }
    }
}

const BOTH: &str =
    ", across = { record = \"el-centro-1940-ns\", pga = \"0.5 g\", duration = \"6 s\" }";

/// Riccati's recursion and the stiffness matrix share nothing but the elements; moved in both directions, columns yield on both moments.
#[test]
fn both_solvers_agree_while_columns_yield_in_both_directions() {
    let file = in_space("x", BOTH);
    let all = [Solver::Riccati, Solver::Stiffness].map(|solver| shaken(&file, Some(solver)));
    let [a, b] = [only(&all[0]), only(&all[1])];
    let mut biaxial = 0;
    for (a, b) in a.sections.iter().zip(&b.sections) {
        let (x, y) = (a.across.as_ref().unwrap(), b.across.as_ref().unwrap());
        for (a, b, scale) in [
            (a.axial_min_n, b.axial_min_n, 1e6),
            (a.moment_max_n_m, b.moment_max_n_m, 3e5),
            (x.moment_across_max_n_m, y.moment_across_max_n_m, 3e5),
            (a.rotation_max_rad, b.rotation_max_rad, 1e-2),
            (x.rotation_across_min_rad, y.rotation_across_min_rad, 1e-2),
        ] {
            close(a, b, scale, 1e-6, "solvers");
        }
        let turned = a.rotation_max_rad.min(x.rotation_across_max_rad);
        biaxial += usize::from(a.yielded_s.is_some() && turned > 1e-3);
    }
    assert!(biaxial >= 2, "{biaxial}");
}

/// Two cantilevers in space with a stated surface, under a load each; what joins them is soft.
fn cantilever(load: f64, exponent: f64, angle: &str) -> String {
    let load = 2.0 * load;
    format!(
        r#"[[building]]
name = "A"
kind = "space-frame"
storeys = 1
storey_height = 3.2
lines_x = [0, 4]
lines_y = [0]
plan = [["-0.2 m", "-0.2 m"], ["4.2 m", "-0.2 m"], ["4.2 m", "0.2 m"], ["-0.2 m", "0.2 m"]]
density = 0
elastic_modulus = "30 GPa"
mass = "40 t"
floor_load = {load:?}
beam_x = {{ width = 0.005, depth = 0.005 }}
gravity = true
p_delta = false{angle}
column = {{ size = [0.5, 0.4] }}
hinges = {{ rule = "surface", length = 0.4, post_yield = 0.0, ends = "base", exponent = {exponent:?}, surface = {{ axial = ["-3 MN", "-1.2 MN", "0.8 MN"], moment = ["0 kN.m", "360 kN.m", "0 kN.m"], across = ["0 kN.m", "240 kN.m", "0 kN.m"] }} }}
"#
    )
}

/// A cantilever that is pushed bears the moment of its surface under its weight: along its lines that of either plane, and obliquely that
/// of the curve between both, which the planes of the surface follow within 1 %.
#[test]
fn a_column_that_is_pushed_bears_its_surface() {
    for load in [2e5, 9e5, 2.2e6] {
        let weight = load + 20e3 * STANDARD_GRAVITY;
        let share = match weight {
            n if n < 1.2e6 => (n + 0.8e6) / 2e6,
            n => (3e6 - n) / 1.8e6,
        };
        let bears = [3.6e5 * share, 2.4e5 * share];
        for exponent in [1.5, 2.0] {
            for (degrees, tolerance) in [(0.0_f64, 1e-6), (25.0, 1e-2), (50.0, 1e-2), (90.0, 1e-6)]
            {
                // The lines of the frame are turned against the push.
                let angle = format!("\nangle = \"{degrees} deg\"");
                let model = sound(&cantilever(load, exponent, &angle)).model;
                let system = assembled(&model);
                for direction in [PushDirection::Right, PushDirection::Left] {
                    let settings = PushSettings {
                        direction,
                        drift: 0.03,
                        ..PushSettings::default()
                    };
                    let pushed = pushover(&system.buildings[0], settings).expect("it bears");
                    let last = pushed.points.last().expect("points");
                    // Nothing holds it across, so that the moment has the direction of the push.
                    let [s, c] = [degrees.to_radians().sin(), degrees.to_radians().cos()];
                    let sum =
                        (c / bears[0]).abs().powf(exponent) + (s / bears[1]).abs().powf(exponent);
                    let capacity = sum.powf(-1.0 / exponent);
                    close(
                        1.6 * last.base_shear,
                        capacity,
                        capacity,
                        tolerance,
                        "moment",
                    );
                    assert!(last.roof > 0.9 * 0.03 * 3.2, "{}", last.roof);
                    // An end is one hinge, of whatever number of springs.
                    let equations = &system.buildings[0].equations;
                    assert_eq!(pushed.counts(equations.springs.len()), [2, 2]);
                    assert_eq!(equations.yielding_places(), 2);
                }
            }
        }
    }
}

fn frame(file: &str) -> SpaceFrame {
    match sound(file).model.buildings.remove(0).structure {
        Structure::Tiers(tiers) => tiers.space_frame.expect("a space frame"),
        other => panic!("no plan: {other:?}"),
    }
}

/// EA and EI over the length, and corners, by hand; walls beside them stay elastic.
#[test]
fn a_file_says_how_columns_yield() {
    let own = frame(&cantilever(1e5, 2.0, ""));
    let column: &ColumnFibres = own.fibres.values().next().expect("a column");
    assert_eq!((column.length, column.at_ends), (0.4, [true, false]));
    assert_eq!(own.fibres.len(), 2);
    let initial = column.fibres[0].spring.backbone().initial();
    near(3.0 * initial, 30e9 * 0.2 / 0.4, 1e-12, "EA");
    let sums = column.fibres.iter().take(3).fold([0.0; 2], |sum, fibre| {
        let initial = fibre.spring.backbone().initial();
        [0, 1].map(|axis| sum[axis] + initial * fibre.at[axis].powi(2))
    });
    near(
        sums[0],
        30e9 * 0.4 * 0.125 / 12.0 / 0.4,
        1e-12,
        "EI along x",
    );
    near(sums[1], 30e9 * 0.5 * 0.064 / 12.0 / 0.4, 1e-12, "EI across");
    let corners = column.corners();
    for (plane, greatest) in corners.iter().zip([3.6e5, 2.4e5]) {
        assert_eq!(plane.len(), 3);
        near(plane[1][1], greatest, 1e-12, "corner");
        near(plane[1][0], -1.2e6, 1e-12, "corner");
    }
    let own = frame(&in_space("x", ""));
    assert_eq!(own.fibres.len(), 8);
    assert!(own.fibres.values().all(ColumnFibres::is_surface));
    let wall = "[[building.wall]]\nalong = \"x\"\nx = 1\nlength = 2\nthickness = 0.3\n";
    let own = frame(&format!("{}{wall}", in_space("x", "")));
    assert_eq!(own.fibres.len(), 4);
}

/// The diagrams of both planes are summed over layers of their own, whose last digits differ.
#[test]
fn rectangles_of_all_sizes_have_a_surface() {
    for size in ["[0.6, 0.5]", "[0.5, 0.6]", "[0.4, 0.35]", "[0.7, 0.4]"] {
        let text = in_space("x", "").replace("size = [0.5, 0.5]", &format!("size = {size}"));
        let frame = frame(&text);
        assert!(
            frame.fibres.values().all(ColumnFibres::is_surface),
            "{size}"
        );
    }
}

#[test]
fn faults_of_surfaces_in_space_are_named() {
    let stated = cantilever(2e5, 1.5, "");
    let of_bars = in_space("x", "");
    for (good, from, to, problem) in [
        (
            &stated,
            "exponent = 1.5",
            "exponent = 1.0",
            "exponent between 1.05 and 10",
        ),
        (
            &stated,
            "gravity = true",
            "gravity = false",
            "needs the weight of the building",
        ),
        (
            &stated,
            "gravity = true",
            "gravity = true\naxial = \"rigid\"",
            "needs columns that change their length",
        ),
        (
            &stated,
            "across = [\"0 kN.m\", \"240 kN.m\", \"0 kN.m\"]",
            "across = [\"0 kN.m\", \"240 kN.m\"]",
            "as many moments as axial forces",
        ),
        (
            &stated,
            "moment = [\"0 kN.m\", \"360 kN.m\", \"0 kN.m\"], ",
            "",
            "add moment = ",
        ),
        (&stated, "length = 0.4, ", "", "add length = "),
        (&of_bars, "bars = \"12 d20\", ", "", "steel"),
        (
            &of_bars,
            ", steel = \"400 MPa\", bars = \"12 d20\"",
            "",
            "has no bars",
        ),
        (
            &of_bars,
            "bars = \"12 d20\"",
            "bars = \"4 d20 top, 4 d25 bottom\"",
            "other bars at one face",
        ),
        (
            &of_bars,
            "rule = \"surface\"",
            "rule = \"fibre\"",
            "post_yield: has no meaning without a surface",
        ),
        (
            &of_bars,
            "length = \"0.4 m\"",
            "length = \"0.4 m\", fibres = 12",
            "fibres: has no meaning without fibres",
        ),
        (
            &of_bars,
            "length = \"0.4 m\"",
            "length = \"0.4 m\", column = { yield = 1e5 }",
            "cannot be combined with rule = \"surface\"",
        ),
    ] {
        assert!(good.contains(from), "{from}");
        let said = refusal(&good.replace(from, to));
        assert!(said.contains(problem), "{problem}: {said}");
    }
}

const LIMITS: &str = "[[building.rotation_limit]]\nof = \"columns\"\nlimits = { io = \"2 mrad\", ls = \"8 mrad\", cp = \"150 mrad\" }\n";

fn levels(summary: &Summary) -> &RotationLevelsSummary {
    let levels = only(summary).rotation_levels.as_ref();
    levels.expect("it has limits")
}

const MOTION: &str = "motion = { record = \"el-centro-1940-ns\", pga = \"1.2 g\", duration = \"6 s\" }\nanalysis = { solver = \"riccati\", step = \"1 ms\", accept_unusual = true }\n";

/// Of a cantilever under its weight the plastic rotation is its displacement without the elastic one, over its height. In space about
/// either axis.
#[test]
fn plastic_rotations_are_displacements_without_their_elastic_part() {
    let load = 2e5;
    // The moment does not depend on the axial force, so that the end does not stretch as it turns.
    let flat = |file: &str| {
        let file = file.replace(
            "\"-3 MN\", \"-1.2 MN\", \"0.8 MN\"",
            "\"-3 MN\", \"-2.9 MN\", \"0.7 MN\", \"0.8 MN\"",
        );
        ["360", "240"].into_iter().fold(file, |file, moment| {
            let [one, two] =
                [1, 2].map(|count| vec![format!("\"{moment} kN.m\""); count].join(", "));
            file.replace(&one, &two)
        })
    };
    let plane = format!(
        r#"{MOTION}[[building]]
name = "A"
kind = "frame"
storeys = 1
storey_height = 3.2
spans = []
density = 0
elastic_modulus = "30 GPa"
floor_mass = "20 t"
floor_load = {load:?}
column_segments = 1
axial = {{ columns = "flexible", beams = "rigid" }}
gravity = true
p_delta = false
column = {{ width = 0.4, depth = 0.5 }}
hinges = {{ rule = "surface", length = 0.4, post_yield = 0.0, ends = "base", surface = {{ axial = ["-3 MN", "-1.2 MN", "0.8 MN"], moment = ["0 kN.m", "360 kN.m", "0 kN.m"] }} }}
{LIMITS}"#
    );
    let space = |motion: &str| {
        let motion = MOTION.replace("\"6 s\"", &format!("\"6 s\"{motion}"));
        format!("{motion}{}{LIMITS}", cantilever(load, 1.5, ""))
    };
    let [along, across] = [0.4 * 0.125, 0.5 * 0.064].map(|cubes| 30e9 * cubes / 12.0);
    let hard = |file: &str| file.replace("post_yield = 0.0", "post_yield = 0.03");
    for (file, moment, rigidity, hardening) in [
        (hard(&plane), 3.6e5, along, 0.03),
        (plane, 3.6e5, along, 0.0),
        (space(""), 3.6e5, along, 0.0),
        (hard(&space("")), 3.6e5, along, 0.03),
        (space(", angle = \"90 deg\""), 2.4e5, across, 0.0),
    ] {
        let file = flat(&file);
        let summary = shaken(&file, None);
        let floor = &only(&summary).floors.above[0];
        let ends = match (&floor.in_plan, moment == 2.4e5) {
            (Some(plan), true) => [
                plan.displacement_across_max_m,
                plan.displacement_across_min_m,
            ],
            _ => [
                floor.response.displacement_max_m,
                floor.response.displacement_min_m,
            ],
        };
        // θ h = u − M h²/3EI with M = M_y + r k θ; the end has yielded at M_y/(1 − r) k.
        let (k, give) = (rigidity / 0.4, 3.2 * 3.2 / (3.0 * rigidity));
        let turned = (ends[0].max(-ends[1]) - moment * give) / (3.2 + hardening * k * give);
        let due = turned - moment / ((1.0 - hardening) * k);
        let found = levels(&summary);
        assert!(due > 8e-3, "{due}");
        assert_eq!(found.members, found.beyond_ls, "{found:?}");
        assert_eq!(found.beyond_cp, 0);
        for member in &found.list {
            assert_eq!((member.at, member.measure), ("foot", "plastic"));
            near(member.rotation_rad, due, 1e-3, &member.member);
            // A run that ends a step before has not passed the level.
            for level in &member.limits[..2] {
                let at = level.beyond_s.expect("passed");
                let rotation = |end: f64| {
                    let summary = shaken_until(&file, None, end);
                    let found = levels(&summary).list.iter();
                    let own = { found }.find(|own| own.member == member.member);
                    own.expect("listed").rotation_rad
                };
                assert!(rotation(at - 1e-3) < level.limit_rad);
                assert!(rotation(at) >= level.limit_rad);
            }
        }
    }
}

/// The plane frame of twice the space frame, and frames at lines of a plan.
#[test]
fn rotations_in_space_and_at_lines_are_those_of_plane_frames() {
    let summary = |file: String| shaken(&format!("{file}{LIMITS}"), None);
    let due = summary(plane());
    let due = levels(&due);
    // Members that yield: the others only differ by rounding.
    assert!(due.members == 4 && due.beyond_io >= 2, "{due:?}");
    let space = summary(in_space("x", ""));
    let names =
        |line: &str, storey: &str| ["1", "2"].map(|y| format!("A.column.{line}.{y}.{storey}"));
    for member in &due.list {
        let parts: Vec<&str> = member.member.split('.').collect();
        for name in names(parts[2], parts[3]) {
            let found = levels(&space).list.iter().find(|own| own.member == name);
            let found = found.unwrap_or_else(|| panic!("no {name}"));
            close(found.rotation_rad, member.rotation_rad, 1e-2, 1e-6, &name);
            assert_eq!(found.at, member.at);
            assert_eq!(found.beyond, member.beyond);
        }
    }
    assert_eq!(levels(&space).members, 8);
    // Frames at lines carry no load without inertia.
    let plane = plane().replace("floor_load = \"300 kN\"\n", "");
    let (_, members) = plane.split_once("column_segments").expect("members");
    let lines = format!(
        "{}mass = \"80 t\"\nplan = [5, 6]\nstiffness = {{ x = 1, y = \"60 MN/m\" }}\n[[building.frame]]\nname = \"F\"\nat = [[0, 0], [0, 6]]\nspans = [5]\ndensity = 0\nelastic_modulus = \"30 GPa\"\ncolumn_segments{members}",
        head("", "frame").replace("density = 0\nelastic_modulus = \"30 GPa\"\n", ""),
    );
    let (due, found) = (summary(plane), summary(lines));
    let due = levels(&due);
    assert!(due.beyond_io >= 2, "{due:?}");
    assert_eq!(levels(&found).members, 8);
    for member in &due.list {
        let own = member.member.replace("A.", "");
        for place in ["F.1", "F.2"] {
            let name = format!("A.{place}.{own}");
            let mut list = levels(&found).list.iter();
            let found = list.find(|own| own.member == name);
            let found = found.unwrap_or_else(|| panic!("no {name}"));
            close(found.rotation_rad, member.rotation_rad, 1e-2, 1e-5, &name);
        }
    }
}

#[test]
fn limits_of_ends_on_surfaces_that_cannot_be_say_why() {
    let chord = LIMITS.replace("limits =", "measure = \"chord\"\nlimits =");
    let model = sound(&format!("{}{chord}", plane())).model;
    let faults = jostle::System::assemble(&model).expect_err("chord rotations");
    assert!(
        faults[0].problem.contains("measure = \"plastic\"")
            && faults[0].path.contains("rotation_limit"),
        "{faults:?}"
    );
}
