//! `shear_failure`: from keys to shear springs of columns, and what is refused.

use jostle::structure::SpringPlace;
use jostle::{Hinges, PlanAxis, ShearEnds, ShearSpring, Structure, System};
use jostle_testkit::files::{self, refusal, sound};

const MODEL: &str = r#"
[motion]
kind = "sine"
amplitude = "1 m/s2"
period = "0.6 s"
duration = "3 s"
[[building]]
name = "A"
kind = "frame"
storeys = 2
storey_height = ["4 m", "3.2 m"]
spans = ["6 m", "5 m"]
column = { width = "500 mm", depth = "500 mm", concrete = "C30", steel = "HRB400", bars = "12 d20", cover = "30 mm"AXIALTIES }
beam = { width = "300 mm", depth = "600 mm", concrete = "C30", steel = "HRB400", bars = "4 d20 top, 4 d20 bottom" }
beam_mass = "3600 kg/m"
KEY
[[building]]
name = "B"
kind = "shear"
mass = ["40 t", "40 t"]
stiffness = ["60 MN/m", "60 MN/m"]
storey_height = HEIGHTS
[[gap]]
between = ["A", "B"]
width = "10 mm"
floors = FLOORS
law = "hertz"
stiffness = "2e9 N/m^1.5"
"#;

/// Floors of B that strike columns of A.
const STRUCK: &str = "[[\"3.000 m\", 1], [\"6.000 m\", 2]]";
const TIES: &str = ", ties = \"d10 @ 150 mm\"";

fn read(key: &str, ties: &str, floors: &str) -> Result<Vec<Vec<ShearSpring>>, String> {
    let heights = if floors == STRUCK {
        "\"3.0 m\""
    } else {
        "[\"4 m\", \"3.2 m\"]"
    };
    let text = MODEL
        .replace("HEIGHTS", heights)
        .replace("KEY", key)
        .replace("AXIAL", ", axial_load = \"1000 kN\"")
        .replace("TIES", ties)
        .replace("FLOORS", floors);
    let input = files::read(&text);
    let input = input.map_err(|error| error.to_string())?;
    match &input.model.buildings[0].hinges {
        Some(Hinges::Frame(hinges)) => Ok(hinges.shear.clone()),
        _ => Ok(Vec::new()),
    }
}

#[track_caller]
fn close(value: f64, due: f64) {
    assert!((value / due - 1.0).abs() < 3e-4, "{value} instead of {due}");
}

#[test]
fn a_rule_gives_strength_and_slope() {
    let rows = read(
        "shear_failure = { rule = \"sezen-moehle\" }",
        TIES,
        "\"common\"",
    );
    let rows = rows.unwrap_or_else(|error| panic!("{error}"));
    assert_eq!([rows.len(), rows[0].len()], [2, 3]);
    // Storey 2: 3.2 m between axes, 2.6 m clear; a/d = 1300/460 = 2.82609. By hand as in the test of the rule:
    // 2.24165/2.82609 · 1.66865 · 200 000 = 264 717 N, ties 192 685 N.
    let row = &rows[1][0];
    let curve = row
        .spring
        .backbone()
        .side(jostle::hysteresis::Side::Positive);
    close(curve.yielding.force, 457_402.0);
    // δs = 0.03 + 0.0083776 − (457 402/230 000)/4.48330/40 − 0.199005/40 = 0.0223131; δa = 0.048494.
    // Kdeg = 457 402/(0.0261809 · 2.6) = 6.7196 MN/m; the column 12 · 30 GPa · 0.5⁴/12/3.2³ = 57.22 MN/m.
    let falling = row.spring.falling_branch().expect("it fails");
    close(falling.slope, 1.0 / (1.0 / 6.7196e6 + 1.0 / 57.220e6));
    assert_eq!(falling.residual, 0.0);
    close(row.spring.backbone().initial(), 1e4 * 57.220e6);
    // k falls from 1 at ductility 2 to 0.7 at 6.
    close(row.by_ductility.at(4.0), 0.85 * 457_402.0);
    assert_eq!(row.ends, ShearEnds::Foot);
    // GB 50010 does not fall with ductility.
    let rows = read(
        "shear_failure = { rule = \"gb50010\", slope = \"8 MN/m\", residual = 0.2 }",
        TIES,
        "\"common\"",
    );
    let rows = rows.unwrap_or_else(|error| panic!("{error}"));
    let row = &rows[0][1];
    assert!(row.by_ductility.points().is_empty());
    let falling = row.spring.falling_branch().expect("it fails");
    close(falling.slope, 1.0 / (1.0 / 8e6 + 64.0 / (12.0 * 1.5625e8)));
    close(falling.residual, 0.2 * row.spring.backbone().yield_force());
}

/// Light ties under 1000 kN: the axial limit comes before shear failure. The column loses its strength V over δa Ln − V/K.
#[test]
fn columns_that_lose_their_axial_load_first_can_fall_to_the_axial_limit() {
    let key = "shear_failure = { rule = \"sezen-moehle\", axial_first = \"axial-limit\" }";
    let ties = ", ties = \"d6 @ 400 mm\"";
    let rows = read(key, ties, "\"common\"");
    let rows = rows.unwrap_or_else(|error| panic!("{error}"));
    let row = &rows[1][0];
    let strength = row.spring.backbone().yield_force();
    // Two legs d6, 56.549 mm²; core 500 − 2 (30 − 3) = 446 mm; 56.549 · 400 · 446/400 = 25 220.7 N.
    // tan 65° = 2.144507; 1 000 000/(25 220.7 · 2.144507) = 18.48906; 0.04 · 5.598911/20.63357 = 0.010854.
    let limit = 0.010_854 * 2.6;
    let column = 12.0 * 1.5625e8 / (3.2 * 3.2 * 3.2);
    let lost = limit - strength / column;
    let falling = row.spring.falling_branch().expect("it fails");
    // Column and spring together: the spring falls while the column unloads.
    close(1.0 / falling.slope, lost / strength + 1.0 / column);
    // A slope serves every column.
    let key = "shear_failure = { rule = \"sezen-moehle\", slope = \"8 MN/m\" }";
    let rows = read(key, ties, "\"common\"");
    let rows = rows.unwrap_or_else(|error| panic!("{error}"));
    let row = &rows[1][0];
    close(row.spring.backbone().yield_force(), strength);
    let falling = row.spring.falling_branch().expect("it fails");
    close(1.0 / falling.slope, 1.0 / 8e6 + 1.0 / column);
}

#[test]
fn columns_struck_between_floors_have_a_spring_above_and_one_below() {
    let key = "shear_failure = { strength = [\"300 kN\", \"200 kN\"], slope = \"5 MN/m\" }";
    let rows = read(key, "", STRUCK).unwrap_or_else(|error| panic!("{error}"));
    // B stands to the right: its floors at 3 and 6 m strike line 3 in both storeys.
    for (storey, row) in rows.iter().enumerate() {
        let ends: Vec<ShearEnds> = row.iter().map(|row| row.ends).collect();
        assert_eq!(
            ends,
            [ShearEnds::Foot, ShearEnds::Foot, ShearEnds::Both],
            "{storey}"
        );
        close(row[0].spring.backbone().yield_force(), [3e5, 2e5][storey]);
    }
    for (word, due) in [("foot", ShearEnds::Foot), ("both", ShearEnds::Both)] {
        let key = key.replace(" }", &format!(", ends = \"{word}\" }}"));
        let rows = read(&key, "", STRUCK).unwrap_or_else(|error| panic!("{error}"));
        assert!(rows.iter().flatten().all(|own| own.ends == due));
    }
}

/// A wall is no column: beside one, the other columns fail by the same strengths as without it, and the wall keeps its shear strength.
#[test]
fn columns_beside_a_wall_fail_by_their_rule() {
    let failure = "shear_failure = { rule = \"sezen-moehle\", axial_first = \"axial-limit\" }\n";
    let wall = "[[building.wall]]\nline = 2\nlength = \"2 m\"\nthickness = \"250 mm\"\n";
    let rows = |wall: &str| {
        let key = format!("{failure}axial = \"flexible\"\nconcrete = \"C30\"\n{wall}");
        let rows = read(&key, TIES, "\"common\"");
        rows.unwrap_or_else(|error| panic!("{error}"))
    };
    let (alone, beside) = (rows(""), rows(wall));
    for (alone, beside) in alone.iter().zip(&beside) {
        for line in [0, 2] {
            let [alone, beside] =
                [alone, beside].map(|row| row[line].spring.backbone().yield_force());
            close(beside, alone);
        }
    }
    // Walls of the model take no shear spring.
    let key = format!("{failure}axial = \"flexible\"\nconcrete = \"C30\"\n{wall}");
    let text = MODEL
        .replace("HEIGHTS", "[\"4 m\", \"3.2 m\"]")
        .replace("KEY", &key)
        .replace("AXIAL", ", axial_load = \"1000 kN\"")
        .replace("TIES", TIES)
        .replace("FLOORS", "\"common\"");
    let system = System::assemble(&sound(&text).model).expect("a sound model");
    let places = &system.buildings[0].discretization.spring_places;
    let failing = places
        .iter()
        .filter(|place| matches!(place, SpringPlace::Shear { .. }));
    assert_eq!(failing.count(), 4, "{places:?}");
}

#[test]
fn what_is_missing_or_contradicts_is_named() {
    for (key, ties, said) in [
        (
            "shear_failure = { }",
            TIES,
            "shear_failure.rule: is missing",
        ),
        (
            "shear_failure = { rule = \"gb50010\" }",
            "",
            "needs bars and ties of every column",
        ),
        (
            "shear_failure = { strength = \"300 kN\" }",
            "",
            "shear_failure.slope: is missing",
        ),
        (
            "shear_failure = { rule = \"asce41\", strength = \"300 kN\" }",
            TIES,
            "cannot be combined with strength",
        ),
        (
            "shear_failure = { strength = \"300 kN\", slope = \"-5 MN/m\" }",
            "",
            "slope: must be greater than zero",
        ),
        (
            "shear_failure = { strength = \"300 kN\", slope = \"5 MN/m\", residual = 1 }",
            "",
            "residual: must be at least 0 and less than 1",
        ),
        (
            "shear_failure = { rule = \"sezen-moehle\" }",
            ", ties = \"d6 @ 400 mm\"",
            "it loses its axial load at a drift of",
        ),
        (
            "shear_failure = { rule = \"sezen-moehle\" }",
            ", ties = \"d6 @ 400 mm\"",
            "add axial_first = \"axial-limit\"",
        ),
        (
            "shear_failure = { strength = \"300 kN\", slope = \"5 MN/m\", axial_first = \"axial-limit\" }",
            "",
            "axial_first: has no effect without rule",
        ),
    ] {
        let found = read(key, ties, "\"common\"").expect_err(key);
        assert!(found.contains(said), "{key}\n{found}");
    }
}

/// A column along x and across has the strengths of plane frames in which it bends so, under its share of the weight.
#[test]
fn columns_of_space_frames_have_the_strengths_of_plane_ones() {
    let bars = "steel = \"HRB400\", bars = \"4 d20 top, 4 d20 bottom, 2 d20 sides\", ties = \"d10 @ 150 mm\"";
    let turned = "steel = \"HRB400\", bars = \"3 d20 top, 3 d20 bottom, 4 d20 sides\", ties = \"d10 @ 150 mm\"";
    let beam = "width = 0.3, depth = 0.6, steel = \"HRB400\", bars = \"4 d25 top, 3 d25 bottom\"";
    let failure = "shear_failure = { rule = \"sezen-moehle\", slope = \"8 MN/m\", residual = 0.2 }";
    let space = format!(
        "[[building]]\nname = \"A\"\nkind = \"space-frame\"\nstorey_height = 3.2\nlines_x = [0, 6]\nlines_y = [0, 6]\nmass = \"60 t\"\nconcrete = \"C30\"\ncolumn = {{ size = [0.5, 0.4], {turned} }}\nbeam_x = {{ {beam} }}\nbeam_y = {{ {beam} }}\n{failure}\n"
    );
    let input = sound(&space);
    let Structure::Tiers(tiers) = &input.model.buildings[0].structure else {
        panic!("in plan");
    };
    let shear = &tiers.space_frame.as_ref().expect("a frame").shear;
    assert_eq!(shear.len(), 8);
    let weight = 60e3 * 9.806_65 / 4.0;
    for (axis, [width, depth], bars) in [
        (PlanAxis::X, [0.4, 0.5], turned),
        (PlanAxis::Y, [0.5, 0.4], bars),
    ] {
        let plane = format!(
            "[[building]]\nname = \"A\"\nstoreys = 1\nstorey_height = 3.2\nspans = [6]\nfloor_mass = \"30 t\"\nconcrete = \"C30\"\ncolumn = {{ width = {width}, depth = {depth}, axial_load = {weight}, {bars} }}\nbeam = {{ {beam} }}\n{failure}\n"
        );
        let input = sound(&plane);
        let Some(Hinges::Frame(hinges)) = &input.model.buildings[0].hinges else {
            panic!("hinges");
        };
        let due = &hinges.shear[0][0];
        let strength = |spring: &ShearSpring| {
            spring
                .spring
                .backbone()
                .side(jostle::hysteresis::Side::Positive)
                .yielding
                .force
        };
        for (_, spring) in shear.iter().filter(|((_, own), _)| *own == axis) {
            let (found, due_strength) = (strength(spring), strength(due));
            assert!(
                (found / due_strength - 1.0).abs() < 1e-9,
                "{axis:?}: {found}, not {due_strength}"
            );
            let falls =
                |spring: &ShearSpring| spring.spring.falling_branch().expect("it falls").slope;
            assert!((falls(spring) / falls(due) - 1.0).abs() < 1e-9);
            for ductility in [2.0, 4.0, 7.0] {
                let [own, due] = [spring, due].map(|spring| spring.by_ductility.at(ductility));
                assert!((own / due - 1.0).abs() < 1e-9, "{own}, not {due}");
            }
        }
    }
    let refused = |failure: &str| {
        refusal(&space.replace(
            "shear_failure = { rule = \"sezen-moehle\", slope = \"8 MN/m\", residual = 0.2 }",
            failure,
        ))
    };
    let ends = refused("shear_failure = { strength = 3e5, slope = 5e6, ends = \"both\" }");
    assert!(
        ends.contains("ends: is for frames without a plan"),
        "{ends}"
    );
    let bare = refusal(&space.replace(", ties = \"d10 @ 150 mm\"", ""));
    assert!(
        bare.contains("needs bars and ties of every column"),
        "{bare}"
    );
}

/// Frames at several lines have it all, and columns of a space frame that a slab can hit a second spring at their heads.
#[test]
fn frames_in_plan_fail_and_struck_columns_at_both_ends() {
    let failure = "shear_failure = { strength = [\"300 kN\", \"200 kN\"], slope = \"5 MN/m\" }\n";
    let lines = format!(
        "[[building]]\nname = \"A\"\nkind = \"frame\"\nstorey_height = [4, 3.2]\nplan = [6, 5]\nmass = \"60 t\"\n[[building.frame]]\nat = [[0, 0], [0, 5]]\nspans = [6]\nconcrete = \"C30\"\ncolumn = {{ width = 0.4, depth = 0.4 }}\nbeam = {{ width = 0.3, depth = 0.5 }}\n{failure}[[building.frame]]\nname = \"across\"\nat = [[0, 0], [6, 0]]\ndirection = \"y\"\nspans = [5]\nconcrete = \"C30\"\ncolumn = {{ width = 0.4, depth = 0.4 }}\nbeam = {{ width = 0.3, depth = 0.5 }}\n"
    );
    let input = sound(&lines);
    let Structure::Tiers(tiers) = &input.model.buildings[0].structure else {
        panic!("in plan");
    };
    let counts = tiers
        .frames
        .iter()
        .map(|frame| frame.hinges.shear.iter().flatten().count());
    assert_eq!(counts.collect::<Vec<_>>(), [4, 4, 0, 0]);
    let space = |name: &str, at: f64, heights: &str, failure: &str| {
        format!(
            "[[building]]\nname = \"{name}\"\nkind = \"space-frame\"\nat = [{at}, 0]\nstorey_height = {heights}\nlines_x = [0, 6]\nlines_y = [0, 5]\nmass = \"60 t\"\nconcrete = \"C30\"\ncolumn = {{ size = [0.5, 0.4] }}\nbeam_x = {{ width = 0.3, depth = 0.6 }}\nbeam_y = {{ width = 0.3, depth = 0.6 }}\n{failure}"
        )
    };
    let text = format!(
        "{}{}[[gap]]\nbetween = [\"A\", \"B\"]\nfloors = \"all\"\nlaw = \"hertz\"\nstiffness = 2e9\n",
        space("A", 0.0, "[4.0, 3.2]", failure),
        space("B", 6.02, "[2.8, 3.2]", "")
    );
    let input = sound(&text);
    let Structure::Tiers(tiers) = &input.model.buildings[0].structure else {
        panic!("in plan");
    };
    let shear = &tiers.space_frame.as_ref().expect("a frame").shear;
    assert_eq!(shear.len(), 16);
    for ((place, _), spring) in shear {
        let is_struck = place.crossings()[0][0] == 1;
        let due = if is_struck {
            ShearEnds::Both
        } else {
            ShearEnds::Foot
        };
        assert_eq!(spring.ends, due, "{place}");
    }
}
