//! Buildings with plans: what a file says, and what is refused.

use jostle::{PlanAxis, PlanPoint, Structure, System, Tiers};
use jostle_io::Input;
use jostle_testkit::files::{read, refusal};

const A: &str = r#"
[[building]]
name = "A"
kind = "shear"
plan = ["20 m", "12 m"]
mass = "250 t"
stiffness = { x = "60 MN/m", y = "85 MN/m" }
eccentricity = ["1 m", "-0.5 m"]
"#;

const B: &str = r#"
[[building]]
name = "B"
kind = "shear"
plan = [["0 m", "0 m"], ["9 m", "0 m"], ["9 m", "8 m"], ["0 m", "8 m"]]
mass = "100 t"
stiffness = "90 MN/m"
"#;

const GAP: &str = r#"
[[gap]]
between = ["A", "B"]
width = "20 mm"
"#;

fn tiers(input: &Input, building: usize) -> &Tiers {
    match &input.model.buildings[building].structure {
        Structure::Tiers(tiers) => tiers,
        other => panic!("no plan: {other:?}"),
    }
}

#[test]
fn north_is_an_angle_of_a_site_with_plans() {
    let with = |site: &str| format!("{A}{B}{GAP}{site}");
    let north = |site: &str| read(&with(site)).expect("a sound model").north;
    assert_eq!(north(""), None);
    assert_eq!(north("[site]\nnorth = 0.5"), Some(0.5));
    let degrees = north("[site]\nnorth = \"-90 deg\"").expect("an angle");
    assert!((degrees + std::f64::consts::FRAC_PI_2).abs() < 1e-15);
    for (site, what) in [
        ("[site]", "site.north"),
        ("[site]\nnorth = \"3 m\"", "site.north"),
        ("[site]\nnorth = 90", "\"90 deg\" for degrees"),
    ] {
        let error = refusal(&with(site));
        assert!(error.contains(what), "{what} in {error}");
    }
    let plane = "[[building]]\nkind = \"shear\"\nmass = [\"40 t\"]\nstiffness = \"60 MN/m\"\nstorey_height = \"3 m\"\n[site]\nnorth = 1\n";
    assert!(refusal(plane).contains("is for buildings with a plan"));
}

#[test]
fn defaults_follow_from_the_plan() {
    let input = read(&format!("{A}{B}{GAP}")).expect("a sound model");
    let (a, b) = (tiers(&input, 0), tiers(&input, 1));
    // Even mass, and torsion of even stiffness: (k_x b² + k_y a²)/12.
    let polar = 250e3 * (400.0 + 144.0) / 12.0;
    assert!((a.floors[0].polar_mass / polar - 1.0).abs() < 1e-12);
    let torsion = (60e6 * 144.0 + 85e6 * 400.0) / 12.0;
    assert!((a.storeys[0].stiffness[2] / torsion - 1.0).abs() < 1e-12);
    assert_eq!(a.floors[0].centre, [10.0, 6.0]);
    assert_eq!(a.storeys[0].centre, [11.0, 5.5]);
    // A bare stiffness counts in both directions, and buildings stand in a row, as far apart as the gap is wide.
    assert_eq!(b.storeys[0].stiffness[..2], [90e6, 90e6]);
    assert!((b.floors[0].plan[0][0] - 20.02).abs() < 1e-12);
    assert_eq!(b.floors[0].plan[0][1], 0.0);
    let system = System::assemble(&input.model).expect("a sound model");
    assert_eq!(system.contacts.len(), 5);
    assert!(
        system
            .contacts
            .iter()
            .all(|c| (c.width - 0.02).abs() < 1e-12)
    );
}

#[test]
fn elements_give_stiffness_and_its_centre() {
    let text = r#"
[[building]]
name = "A"
kind = "shear"
storeys = 2
plan = ["10 m", "6 m"]
at = ["100 m", "50 m"]
mass = "100 t"
[[building.element]]
at = ["1 m", "1 m"]
stiffness = { x = "10 MN/m", y = "20 MN/m" }
[[building.element]]
at = ["9 m", "4 m"]
stiffness = { x = "30 MN/m", y = "20 MN/m" }
[[building.element]]
at = ["5 m", "3 m"]
stiffness = "5 MN/m"
storeys = [2, 2]
"#;
    let input = read(text).expect("a sound model");
    let [lower, upper] = &tiers(&input, 0).storeys[..] else {
        panic!("two storeys")
    };
    // c_y by k_x, c_x by k_y.
    assert!((lower.centre[0] - 105.0).abs() < 1e-9);
    assert!((lower.centre[1] - (50.0 + (10.0 + 120.0) / 40.0)).abs() < 1e-9);
    let y = 3.25;
    let torsion = 10e6 * (1.0_f64 - y).powi(2) + 30e6 * (4.0_f64 - y).powi(2) + 40e6 * 16.0;
    assert!((lower.stiffness[2] / torsion - 1.0).abs() < 1e-12);
    assert_eq!(lower.stiffness[..2], [40e6, 40e6]);
    assert_eq!(upper.stiffness[..2], [45e6, 45e6]);
    // A list from the ground up is one element for every storey.
    let apart = |storey: u32, stiffness: &str| {
        format!(
            "[[building.element]]\nat = [\"9 m\", \"4 m\"]\nstiffness = {stiffness}\nstoreys = {storey}\n"
        )
    };
    let (first, second) = ("{ x = \"12 MN/m\", y = \"14 MN/m\" }", "\"8 MN/m\"");
    let listed = format!(
        "{text}[[building.element]]\nat = [\"9 m\", \"4 m\"]\nstiffness = [{first}, {second}]\n"
    );
    let single = format!("{text}{}{}", apart(1, first), apart(2, second));
    let [listed, single] = [listed, single].map(|text| read(&text).expect("a sound model"));
    assert_eq!(tiers(&listed, 0).storeys, tiers(&single, 0).storeys);
    assert_eq!(tiers(&listed, 0).storeys[0].stiffness[..2], [52e6, 54e6]);
    let short =
        format!("{text}[[building.element]]\nat = [\"9 m\", \"4 m\"]\nstiffness = [{first}]\n");
    let faults = read(&short).expect_err("one of two storeys");
    assert!(
        format!("{faults}").contains("element[3].stiffness"),
        "{faults}"
    );
}

#[test]
fn set_backs_have_plans_of_their_own() {
    let text = r#"
[[building]]
name = "A"
kind = "shear"
plan = [{ size = ["20 m", "12 m"] }, { corners = [["0 m", "0 m"], ["10 m", "0 m"], ["10 m", "12 m"], ["0 m", "12 m"]] }]
mass = ["250 t", "120 t"]
stiffness = [{ x = "60 MN/m", y = "85 MN/m", torsion = "5.5 GN.m/rad" }, "40 MN/m"]
polar_mass = ["1e7 kg.m2", "2e6 kg.m2"]
"#;
    let input = read(text).expect("a sound model");
    let tiers = tiers(&input, 0);
    assert_eq!(tiers.floors[1].centre, [5.0, 6.0]);
    assert_eq!(
        [tiers.floors[0].polar_mass, tiers.floors[1].polar_mass],
        [1e7, 2e6]
    );
    assert_eq!(tiers.storeys[0].stiffness[2], 5.5e9);
    // The spring acts where the floor above has its mass.
    assert_eq!(tiers.storeys[1].centre, [5.0, 6.0]);
}

#[test]
fn a_pair_of_records_is_scaled_together() {
    let motion = r#"
[motion]
record = "el-centro-1940-ns"
pga = "0.2 g"
angle = "30 deg"
across = "el-centro-1940-ns"
"#;
    let input = read(&format!("{motion}{A}")).expect("a sound model");
    let motion = input.ground_motion().expect("a motion");
    let [x, y, _] = motion.components(2.0);
    let a = motion.acceleration(2.0);
    let (sin, cos) = 30.0_f64.to_radians().sin_cos();
    assert!((x - a * (cos - sin)).abs() < 1e-12 && (y - a * (sin + cos)).abs() < 1e-12);
    assert!(a.abs() > 0.01);
}

/// A motion that states an amplitude or a scaling keeps it; a record without one has the factor of the motion beside it.
#[test]
fn what_states_its_size_keeps_it() {
    let peak_across = |across: &str| {
        let text = format!(
            "[motion]\nrecord = \"el-centro-1940-ns\"\nscale = 1.1\nacross = {across}\n{A}"
        );
        let motion = read(&text).expect("sound").ground_motion().expect("one");
        motion.across().expect("a motion across").peak()
    };
    let sine = "kind = \"sine\", amplitude = \"1.2 m/s2\", period = \"0.5 s\", duration = \"8 s\"";
    assert!((peak_across(&format!("{{ {sine} }}")) - 1.2).abs() < 1e-3);
    assert!((peak_across(&format!("{{ {sine}, scale = 2 }}")) - 2.4).abs() < 2e-3);
    let ricker = "{ kind = \"ricker\", amplitude = \"1.2 m/s2\", period = \"0.5 s\", centre = \"1 s\", duration = \"8 s\" }";
    assert!((peak_across(ricker) - 1.2).abs() < 1e-3);
    let record = "record = \"el-centro-1940-ns\"";
    assert!((peak_across(&format!("{{ {record}, pga = \"1 m/s2\" }}")) - 1.0).abs() < 1e-9);
    let whole = peak_across(&format!("{{ {record}, scale = 1 }}"));
    assert!((peak_across(&format!("{{ {record} }}")) / whole - 1.1).abs() < 1e-9);
}

#[test]
fn stiffness_per_length_follows_the_overlap() {
    let gap = "[[gap]]\nbetween = [\"A\", \"B\"]\nwidth = \"20 mm\"\nlaw = \"linear\"\nstiffness_per_length = \"20 MN/m/m\"\npoints = 3\n";
    let input = read(&format!("{A}{B}{gap}")).expect("a sound model");
    let system = System::assemble(&input.model).expect("a sound model");
    let stiffness: f64 = system.contacts.iter().map(|c| c.law.stiffness()).sum();
    assert_eq!(system.contacts.len(), 3);
    assert!(
        (stiffness / (8.0 * 20e6) - 1.0).abs() < 1e-12,
        "{stiffness}"
    );
}

#[test]
fn what_does_not_fit_is_refused_with_its_place() {
    let with = |a: &str, b: &str| format!("{}{B}{GAP}", A.replace(a, b));
    for (text, wanted) in [
        (
            with("plan = [\"20 m\", \"12 m\"]", "plan = [\"20 m\"]"),
            "building[0].plan: expected a width and a depth, or corners",
        ),
        (
            with(
                "plan = [\"20 m\", \"12 m\"]",
                "plan = [[\"0 m\", \"0 m\"], [\"0 m\", \"8 m\"], [\"9 m\", \"8 m\"], [\"9 m\", \"0 m\"]]",
            ),
            "building[0].plan: has clockwise corners; give them counter-clockwise: [[\"9 m\", \"0 m\"]",
        ),
        (
            with("x = \"60 MN/m\", ", "x = \"0 MN/m\", "),
            "building[0].stiffness.x: must be greater than 0 N/m, found 0",
        ),
        (
            with(
                "mass = \"250 t\"",
                "mass = \"250 t\"\nmass_centre = [\"30 m\", \"6 m\"]",
            ),
            "building[0].mass_centre: lies outside the plan",
        ),
        (
            with(
                "mass = \"250 t\"",
                "mass = \"250 t\"\npolar_mass = \"1e10 kg.m2\"",
            ),
            "building[0].polar_mass: is 1.0000e10 kg.m2, more than",
        ),
        (
            with("plan = [\"20 m\", \"12 m\"]\n", ""),
            "building[0].eccentricity: needs a plan",
        ),
        (
            with(
                "mass = \"250 t\"",
                "mass = \"250 t\"\nhinges = { rule = \"bilinear\", yield = \"20 mm\" }",
            ),
            "building[0].hinges.post_yield: is missing",
        ),
        (
            format!(
                "{A}{}{GAP}",
                B.replace("plan", "at = [\"20.5 m\", \"0 m\"]\nplan")
            ),
            "gap[0].width: is 20.0 mm, but at and plan put the buildings 500.0 mm apart",
        ),
        (
            format!(
                "{A}{}{GAP}",
                B.replace("plan", "at = [\"19 m\", \"0 m\"]\nplan")
            ),
            "building[1].at: puts floor 1 into that of \"A\": their plans overlap",
        ),
        (
            format!("{A}{B}[[gap]]\nbetween = [\"A\", \"wall\"]\nwidth = \"20 mm\"\n"),
            "gap[0].between: names \"wall\", the wall at an end of a row of buildings without a plan",
        ),
        (
            format!("{A}{B}{GAP}points = 1\n"),
            "gap[0].points: must lie between 2 and 9, found 1",
        ),
    ] {
        let said = refusal(&text);
        assert!(said.contains(wanted), "{said}\ninstead of\n{wanted}");
        assert!(said.starts_with("model.toml:"), "{said}");
    }
}

#[test]
fn friction_has_its_keys_and_limits() {
    let gap = |more: &str| format!("{A}{B}{GAP}{more}");
    let input = read(&gap(
        "friction = 0.4\ntangential_stiffness = \"180 MN/m\"\n",
    ));
    let input = input.expect("a sound model");
    let system = System::assemble(&input.model).expect("a sound model");
    let law = |index: usize| {
        system.contacts[index]
            .friction
            .as_ref()
            .expect("friction")
            .law
    };
    let sum: f64 = (0..5).map(|index| law(index).stiffness).sum();
    assert!((sum / 180e6 - 1.0).abs() < 1e-12, "{sum}");
    assert_eq!(law(0).coefficient, 0.4);
    // Without a stiffness: 2(1 − ν)/(2 − ν) with ν = 0.2 of that against pressing.
    let input = read(&gap(
        "friction = 0.4\nlaw = \"linear\"\nstiffness = \"900 MN/m\"\n",
    ));
    let system = System::assemble(&input.expect("a sound model").model).expect("a sound model");
    let sum: f64 = system
        .contacts
        .iter()
        .map(|contact| contact.friction.as_ref().expect("friction").law.stiffness)
        .sum();
    assert!((sum / 800e6 - 1.0).abs() < 1e-12, "{sum}");
    let system = System::assemble(&read(&gap("")).expect("a sound model").model);
    let system = system.expect("a sound model");
    assert!(
        system
            .contacts
            .iter()
            .all(|contact| contact.friction.is_none())
    );
    for (more, expected) in [
        ("friction = 1.0\n", "must lie between 0 and 1"),
        ("friction = -0.1\n", "must lie between 0 and 1"),
        (
            "tangential_stiffness = \"180 MN/m\"\n",
            "is for faces with friction",
        ),
        (
            "friction = 0.4\nlaw = \"restitution\"\n",
            "needs a contact force",
        ),
        (
            "friction = 0.4\nlaw = \"rubber\"\nstiffness = \"2 MN/m^2.65\"\nthickness = \"50 mm\"\n",
            "has no usual value for rubber",
        ),
    ] {
        assert!(
            refusal(&gap(more)).contains(expected),
            "{}",
            refusal(&gap(more))
        );
    }
    let flat = |building: &str| {
        building
            .lines()
            .filter(|line| !line.starts_with("plan"))
            .collect::<Vec<_>>()
            .join("\n")
    };
    let plane = "stiffness = \"90 MN/m\"";
    let a = flat(A).replace("stiffness = { x = \"60 MN/m\", y = \"85 MN/m\" }", plane);
    let a = a.replace("eccentricity = [\"1 m\", \"-0.5 m\"]", "");
    let said = refusal(&format!("{a}\n{}\n{GAP}friction = 0.4\n", flat(B)));
    assert!(
        said.contains("gap[0].friction: is for buildings with a plan"),
        "{said}"
    );
}

#[test]
fn an_angle_needs_plans() {
    let text = r#"
[motion]
record = "el-centro-1940-ns"
angle = "30 deg"
[[building]]
name = "A"
kind = "shear"
mass = "40 t"
stiffness = "60 MN/m"
"#;
    let input = read(text).expect("a sound model");
    let system = System::assemble(&input.model).expect("a sound model");
    let motion = input.ground_motion().expect("a motion");
    let faults = jostle::Plan::choose(&system, &motion, &input.model.analysis);
    let faults = faults.expect_err("a fault");
    assert_eq!(faults[0].path, "motion.angle");
}

/// A, B right of it and C behind both, all in their places.
fn around() -> String {
    let c = B.replace("\"B\"", "\"C\"");
    format!(
        "{A}at = [\"0 m\", \"0 m\"]\n{B}at = [\"20.02 m\", \"1 m\"]\n{c}at = [\"11 m\", \"12.03 m\"]\n"
    )
}

#[test]
fn one_gap_stands_for_all_neighbours() {
    for between in ["", "between = \"all\"\n"] {
        let input = read(&format!("{}[[gap]]\nfriction = 0.2\n{between}", around()));
        let input = input.expect("a sound model");
        let gaps = &input.model.gaps;
        let pairs: Vec<_> = gaps.iter().map(|gap| gap.between).collect();
        // B and C do not face each other: C stands behind A, and left of B's right edge but above it.
        assert_eq!(pairs[0], [Some(0), Some(1)]);
        assert_eq!(pairs[1], [Some(0), Some(2)]);
        for (gap, width) in gaps.iter().zip([0.02, 0.03]) {
            assert!((gap.width() - width).abs() < 1e-12, "{}", gap.width());
            assert_eq!(gap.in_plan.friction, 0.2);
        }
        let silent = !input
            .warnings
            .iter()
            .any(|text| text.contains("pass through"));
        assert!(silent, "{:?}", input.warnings);
    }
    // A gap of its own counts more.
    let gap_tables = "[[gap]]\nbetween = [\"C\", \"A\"]\nfriction = 0.5\n[[gap]]\n";
    let input = read(&format!("{}{gap_tables}", around())).expect("a sound model");
    let frictions: Vec<_> = input
        .model
        .gaps
        .iter()
        .map(|gap| gap.in_plan.friction)
        .collect();
    assert_eq!(frictions[..2], [0.5, 0.0]);
    assert!(
        !input.model.gaps[1..]
            .iter()
            .any(|gap| gap.between.contains(&Some(2)) && gap.between.contains(&Some(0)))
    );
}

#[test]
fn neighbours_without_a_gap_are_named() {
    let only = "[[gap]]\nbetween = [\"A\", \"B\"]\n";
    let input = read(&format!("{}{only}", around())).expect("a sound model");
    let named = |a: &str, b: &str| format!("there is no gap between \"{a}\" and \"{b}\"");
    assert!(
        input
            .warnings
            .iter()
            .any(|text| text.starts_with(&named("A", "C"))),
        "{:?}",
        input.warnings
    );
    assert!(
        !input
            .warnings
            .iter()
            .any(|text| text.starts_with(&named("A", "B")))
    );
}

#[test]
fn a_gap_for_all_neighbours_says_what_it_lacks() {
    let wrong = |gaps: &str| refusal(&format!("{}{gaps}", around()));
    let early = wrong("[[gap]]\n[[gap]]\nbetween = [\"A\", \"B\"]\n");
    assert!(
        early.contains("gap[0]: names no buildings, so it must be the last [[gap]]"),
        "{early}"
    );
    let narrow = wrong("[[gap]]\nreach = \"5 mm\"\n");
    assert!(
        narrow.contains("gap[0]: finds no two buildings that face each other within 0.005 m"),
        "{narrow}"
    );
    let width = wrong("[[gap]]\nwidth = \"20 mm\"\n");
    assert!(
        width.contains("gap[0].width: is 20.0 mm, but at and plan put the buildings 30.0 mm apart"),
        "{width}"
    );
    let homeless = refusal(&format!("{A}{B}[[gap]]\nwidth = \"20 mm\"\n"));
    assert!(
        homeless.contains("give every building its at"),
        "{homeless}"
    );
    let plane = refusal(
        "[[building]]\nkind = \"shear\"\nname = \"A\"\nmass = \"1 t\"\nstiffness = \"1 MN/m\"\n[[gap]]\nwidth = \"20 mm\"\n",
    );
    assert!(
        plane.contains("name the left and the right neighbour"),
        "{plane}"
    );
}

const FRAMES: &str = r#"
[[building]]
name = "A"
kind = "frame"
storeys = 3
plan = ["12 m", "10 m"]
mass = "150 t"
at = ["100 m", "50 m"]

[[building.frame]]
name = "1"
at = ["0 m", "0 m"]
lines = ["A1", "", "C1"]
spans = ["6 m", "6 m"]
column = { width = "500 mm", depth = "500 mm" }
beam = { width = "300 mm", depth = "600 mm" }
concrete = "C30"

[[building.frame]]
name = "y"
at = [["0 m", "0 m"], ["12 m", "0 m"]]
direction = "y"
spans = ["5 m", "5 m"]
column = { width = "500 mm", depth = "500 mm" }
beam = { width = "300 mm", depth = "600 mm" }
elastic_modulus = "30 GPa"

[[building.frame]]
at = ["1 m", "2 m"]
direction = "30 deg"
storeys = 2
spans = ["4 m"]
column = { EI = "150 MN.m2" }
beam = { EI = "160 MN.m2" }
base = { rotational_stiffness = "400 MN.m/rad" }
"#;

#[test]
fn frames_stand_where_the_file_says() {
    let input = read(FRAMES).expect("a sound model");
    let structure = tiers(&input, 0);
    let names: Vec<&str> = structure
        .frames
        .iter()
        .map(|frame| &frame.name[..])
        .collect();
    assert_eq!(names, ["1", "y.1", "y.2", "3"]);
    assert!(structure.storeys.is_empty());
    assert_eq!(structure.frames[2].at, [112.0, 50.0]);
    assert_eq!(structure.frames[2].direction, [0.0, 1.0]);
    assert_eq!(structure.frames[2].line_at(2), [112.0, 60.0]);
    let askew = &structure.frames[3];
    assert!((askew.direction[0] - 0.75_f64.sqrt()).abs() < 1e-12);
    assert_eq!(askew.frame.storey_heights.len(), 2);
    assert_eq!(askew.base.rotational_stiffness, Some(4e8));
    assert_eq!(structure.frames[0].lines[0].as_deref(), Some("A1"));
    assert_eq!(structure.frames[0].lines[1], None);
    // Without density the mass of the floors is all.
    let system = System::assemble(&input.model).expect("a sound model");
    assert_eq!(system.buildings[0].equations.total_mass(), 450e3);
    assert_eq!(system.buildings[0].modes.len(), 9);
}

#[test]
fn frames_in_plan_that_do_not_fit_are_refused_with_the_remedy() {
    let changed = |from: &str, to: &str| {
        assert!(FRAMES.contains(from), "{from}");
        refusal(&FRAMES.replacen(from, to, 1))
    };
    for (from, to, expected) in [
        ("kind = \"frame\"", "kind = \"shear\"", "kind = \"frame\""),
        ("plan = [\"12 m\", \"10 m\"]\n", "", "plan"),
        ("direction = \"y\"", "direction = \"z\"", "direction"),
        ("storeys = 2", "storeys = 4", "between 1 and 3"),
        (
            "lines = [\"A1\", \"\", \"C1\"]",
            "lines = [\"A1\"]",
            "1 names for 3 column lines",
        ),
        (
            "name = \"y\"",
            "name = \"y\"\nlines = [\"A1\", \"\", \"A3\"]",
            "several places",
        ),
        ("name = \"1\"", "name = \"3\"", "another frame is called"),
        (
            "storeys = 2",
            "storeys = 2\ndensity = 2500\ncolumn_segments = 2",
            "column_segments",
        ),
        (
            "mass = \"150 t\"",
            "mass = \"150 t\"\nhinges = { rule = \"bilinear\" }",
            "hinges",
        ),
        (
            "mass = \"150 t\"",
            "mass = \"150 t\"\neccentricity = [0, 0]",
            "eccentricity",
        ),
        ("at = [\"0 m\", \"0 m\"]", "", "add at"),
        (
            "base = {",
            "base = { horizontal_hinge = { rule = \"bilinear\", yield = \"10 kN\", post_yield = 0.1 }, horizontal_stiffness = \"1 MN/m\",",
            "cannot yield",
        ),
    ] {
        let said = changed(from, to);
        assert!(said.contains(expected), "{from} → {to}:\n{said}");
    }
    // Two frames in one direction alone hold no floor.
    let end = FRAMES
        .find("[[building.frame]]\nname = \"y\"")
        .expect("there");
    let single = refusal(&FRAMES[..end]);
    assert!(single.contains("do not hold floor 1"), "{single}");
    // A column line that two frames name differently stands elsewhere.
    let apart = FRAMES.replacen(
        "at = [[\"0 m\", \"0 m\"], [\"12 m\", \"0 m\"]]",
        "at = [\"1 m\", \"0 m\"]\nlines = [\"A1\", \"\", \"A3\"]",
        1,
    );
    let said = refusal(&apart);
    assert!(said.contains("puts column \"A1\""), "{said}");
}

#[test]
fn walls_stand_on_the_site() {
    let text = |wall: &str| {
        format!(
            "{A}at = [\"0 m\", \"0 m\"]\n[[wall]]\nname = \"boundary\"\n{wall}\n[[gap]]\nbetween = [\"A\", \"boundary\"]\n"
        )
    };
    let sound = text("from = [\"20.03 m\", \"0 m\"]\nto = [\"20.03 m\", \"9 m\"]");
    let input = read(&sound).expect("a sound model");
    assert_eq!(
        input.model.walls[0].line,
        Some([[20.03, 0.0], [20.03, 9.0]])
    );
    // The width follows from the places.
    assert!((input.model.gaps[0].width() - 0.03).abs() < 1e-12);
    let system = System::assemble(&input.model).expect("a sound model");
    assert_eq!(system.contacts.len(), 5);
    for (wall, expected) in [
        ("from = [\"20.03 m\", \"0 m\"]", "add to = "),
        ("", "add from and to"),
        (
            "from = [\"20.03 m\", \"9 m\"]\nto = [\"20.03 m\", \"0 m\"]",
            "inside of the wall",
        ),
    ] {
        let said = refusal(&text(wall));
        assert!(said.contains(expected), "{wall}:\n{said}");
    }
}

const WALLS: &str = r#"
[[building]]
name = "A"
kind = "shear"
storeys = 3
plan = ["20 m", "12 m"]
at = ["100 m", "50 m"]
mass = "250 t"

[[building.element]]
name = "core"
at = ["4 m", "3 m"]
stiffness = { x = "50 MN/m", y = "70 MN/m" }
storeys = [1, 2]
hinges = { rule = "bilinear", post_yield = 0.05, x = { yield = ["8 mm", "6 mm"] }, y = { yield = "5 mm", post_yield = 0.02 } }

[[building.element]]
at = ["18 m", "2 m"]
stiffness = { x = "40 MN/m", y = "30 MN/m" }
hinges = { rule = "bilinear", post_yield = 0.05, y = { yield = "7 mm" } }

[[building.element]]
at = ["10 m", "11 m"]
stiffness = "20 MN/m"
"#;

/// Each wall yields in its own directions and storeys; what stays elastic makes the springs of the storey.
#[test]
fn walls_yield_by_storey_and_direction() {
    let input = read(WALLS).expect("a sound model");
    let tiers = tiers(&input, 0);
    let found: Vec<(Option<usize>, usize, PlanAxis, PlanPoint)> = tiers
        .yielding
        .iter()
        .map(|yielding| {
            (
                yielding.element,
                yielding.storey,
                yielding.axis,
                yielding.at,
            )
        })
        .collect();
    let (core, wall) = ([104.0, 53.0], [118.0, 52.0]);
    assert_eq!(
        found,
        [
            (Some(0), 0, PlanAxis::X, core),
            (Some(0), 0, PlanAxis::Y, core),
            (Some(1), 0, PlanAxis::Y, wall),
            (Some(0), 1, PlanAxis::X, core),
            (Some(0), 1, PlanAxis::Y, core),
            (Some(1), 1, PlanAxis::Y, wall),
            (Some(1), 2, PlanAxis::Y, wall),
        ]
    );
    let yielding = |index: usize| {
        let side = tiers.yielding[index].hysteresis;
        side.backbone()
            .side(jostle::hysteresis::Side::Positive)
            .yielding
    };
    assert!((yielding(0).force / 50e6 - 8e-3).abs() < 1e-12);
    assert!((yielding(3).deformation - 6e-3).abs() < 1e-15);
    assert_eq!(tiers.element_names, [Some("core".to_owned()), None, None]);
    // The second wall along x and the third in both directions.
    assert_eq!(tiers.storeys[0].stiffness[..2], [60e6, 20e6]);
    assert_eq!(tiers.storeys[2].stiffness[..2], [60e6, 20e6]);
    let together = tiers.initial_storey(0).expect("springs");
    assert!((together.stiffness[0] / 110e6 - 1.0).abs() < 1e-12);
    assert!((together.stiffness[1] / 120e6 - 1.0).abs() < 1e-12);
    let system = System::assemble(&input.model).expect("a sound model");
    let building = &system.buildings[0];
    assert_eq!(building.equations.springs.len(), 7);
    let places: Vec<String> = building
        .discretization
        .spring_places
        .iter()
        .map(|place| place.named(&building.discretization.element_names, &[]))
        .collect();
    assert_eq!(places[0], "core, storey 1, x");
    assert_eq!(places[6], "element 2, storey 3, y");
}

/// A yielding storey is elastic in torsion alone.
#[test]
fn storeys_in_plan_yield_along_both_directions_or_one() {
    let with = |hinges: &str| {
        A.replace(
            "mass = \"250 t\"",
            &format!("mass = \"250 t\"\nhinges = {hinges}"),
        )
    };
    let both = "{ rule = \"bilinear\", yield = \"20 mm\", post_yield = 0.05 }";
    let input = read(&with(both)).expect("a sound model");
    let structure = tiers(&input, 0);
    assert_eq!(structure.yielding.len(), 2);
    assert_eq!(structure.storeys[0].stiffness[..2], [0.0, 0.0]);
    assert_eq!(structure.yielding[1].at, [11.0, 5.5]);
    let one = "{ rule = \"bilinear\", x = { yield = \"20 mm\", post_yield = 0.05 } }";
    let input = read(&with(one)).expect("a sound model");
    let structure = tiers(&input, 0);
    assert_eq!(
        (structure.yielding.len(), structure.yielding[0].axis),
        (1, PlanAxis::X)
    );
    assert_eq!(structure.storeys[0].stiffness[..2], [0.0, 85e6]);
}

#[test]
fn hinges_in_plan_that_do_not_fit_are_refused_with_the_remedy() {
    let changed = |from: &str, to: &str| {
        assert!(WALLS.contains(from), "{from}");
        refusal(&WALLS.replacen(from, to, 1))
    };
    for (from, to, expected) in [
        ("post_yield = 0.05, x", "x", "add post_yield"),
        (
            "[\"8 mm\", \"6 mm\"]",
            "[\"8 mm\"]",
            "1 entry for 2 storeys",
        ),
        (
            "{ x = \"50 MN/m\", y",
            "{ x = \"0 MN/m\", y",
            "without stiffness along x",
        ),
        (
            "mass = \"250 t\"",
            "mass = \"250 t\"\nhinges = { rule = \"bilinear\" }",
            "move hinges into the elements",
        ),
        (
            "at = [\"18 m\", \"2 m\"]",
            "name = \"core\"\nat = [\"18 m\", \"2 m\"]",
            "another element",
        ),
    ] {
        let said = changed(from, to);
        assert!(said.contains(expected), "{from} → {to}:\n{said}");
    }
    let plane = "[[building]]\nkind = \"shear\"\nmass = \"1 t\"\nstiffness = \"1 MN/m\"\nhinges = { rule = \"bilinear\", yield = \"9 mm\", post_yield = 0.1, x = { yield = \"9 mm\" } }\n";
    assert!(
        refusal(plane).contains("needs a plan"),
        "{}",
        refusal(plane)
    );
}

/// Hinges of frames in plan come before springs, and are named after their frame.
#[test]
fn frames_in_plan_yield_at_their_members() {
    let hinges = "name = \"1\"\nhinges = { rule = \"bilinear\", column = { yield = \"300 kN.m\", post_yield = 0.02 } }";
    let text = FRAMES.replacen("name = \"1\"", hinges, 1);
    let input = read(&text).unwrap_or_else(|error| panic!("{error}"));
    let system = System::assemble(&input.model).expect("a sound model");
    let building = &system.buildings[0];
    let frame = &tiers(&input, 0).frames[0];
    let count = 2 * frame.frame.storey_heights.len() * frame.column_lines();
    assert_eq!(building.equations.springs.len(), count);
    assert_eq!(building.discretization.spring_places.len(), count);
    let first =
        building.discretization.spring_places[0].named(&[], &building.discretization.frames);
    assert!(first.starts_with("frame 1, column 1, storey 1"), "{first}");
    let from = text.replacen(
        "column = { yield = \"300 kN.m\", post_yield = 0.02 }",
        "from = \"section\"",
        1,
    );
    assert!(
        refusal(&from).contains("give the moments"),
        "{}",
        refusal(&from)
    );
}

/// What `across` leaves out is as along x, and "rigid" says that it is not.
#[test]
fn a_base_differs_across_where_it_says_so() {
    let base = r#"base = { horizontal_stiffness = "900 MN/m", horizontal_damping = "20 MN.s/m", rotational_stiffness = "40 GN.m/rad", torsional_stiffness = "50 GN.m/rad", mass = "150 t", across = { rotational_stiffness = "25 GN.m/rad" } }"#;
    let input = read(&format!("{A}{base}\n")).expect("a sound model");
    let plan_base = &input.model.buildings[0].base;
    let [along, across] = plan_base.in_plan();
    assert_eq!(along.horizontal_stiffness, Some(9e8));
    assert_eq!(across.horizontal_stiffness, Some(9e8));
    assert_eq!(across.horizontal_damping, 2e7);
    assert_eq!(along.rotational_stiffness, Some(4e10));
    assert_eq!(across.rotational_stiffness, Some(2.5e10));
    assert_eq!(
        (plan_base.torsional_stiffness, plan_base.mass),
        (Some(5e10), 1.5e5)
    );
    let one_way = base.replace("\"25 GN.m/rad\"", "\"rigid\"");
    let error = refusal(&format!("{A}{one_way}\n"));
    assert!(error.contains("rigid in one direction only"), "{error}");
    let lifts = "base = { vertical_stiffness = \"900 MN/m\" }\n";
    assert!(refusal(&format!("{A}{lifts}")).contains("vertical_stiffness"));
}

/// A foundation on soil may state its springs in torsion; it does not lift off, and foundations in plan do not act on each other.
#[test]
fn a_foundation_stands_under_a_plan() {
    let soil = "[soil]\nshear_wave_velocity = \"200 m/s\"\ndensity = 1900\npoisson_ratio = 0.33\n";
    let plate = r#"foundation = { length = "18 m", width = "12 m", mass = "400 t", torsional_stiffness = "120 GN.m/rad", torsional_damping = "900 MN.m.s/rad" }"#;
    let input = read(&format!("{soil}{A}{plate}\n")).expect("a sound model");
    let foundation = input.model.buildings[0].base.foundation;
    let foundation = foundation.expect("it stands on one");
    assert_eq!(
        [foundation.length, foundation.width, foundation.mass],
        [18.0, 12.0, 4e5]
    );
    assert_eq!(foundation.torsional_stiffness, Some(1.2e11));
    assert_eq!(foundation.torsional_damping, Some(9e8));
    let plain = "foundation = { length = \"18 m\", width = \"12 m\", mass = \"400 t\" }";
    let input = read(&format!("{soil}{A}{plain}\n")).expect("a sound model");
    let foundation = input.model.buildings[0].base.foundation.expect("one");
    assert_eq!(
        (foundation.torsional_stiffness, foundation.torsional_damping),
        (None, None)
    );
    let negative = plate.replace("\"900 MN.m.s/rad\"", "-1");
    let error = refusal(&format!("{soil}{A}{negative}\n"));
    assert!(error.contains("torsional_damping"), "{error}");
    let lifts = plain.replace(" }", ", uplift = true, springs = 5 }");
    let error = refusal(&format!("{soil}{A}{lifts}\n"));
    assert!(error.contains("write gravity = true"), "{error}");
    let more = lifts.replace(" }", ", springs_across = 3 }");
    let sound_model = read(&format!("{soil}{A}gravity = true\n{more}\n")).expect("a sound model");
    let foundation = sound_model.model.buildings[0].base.foundation.expect("one");
    let uplift = foundation.uplift.expect("it lifts");
    assert_eq!((uplift.springs, uplift.springs_across), (5, Some(3)));
    let one = more.replace("springs_across = 3", "springs_across = 1");
    let error = refusal(&format!("{soil}{A}gravity = true\n{one}\n"));
    assert!(
        error.contains("springs_across: must lie between 2"),
        "{error}"
    );
}
