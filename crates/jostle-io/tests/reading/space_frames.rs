//! Space frames: what a file says, and what is refused.

use jostle::hysteresis::{Hysteresis, Side};
use jostle::{SpaceFrame, SpacePlace, Structure, System, Tiers};
use jostle_testkit::files::{read, refusal};

const L_SHAPE: &str = r#"
[[building]]
name = "A"
kind = "space-frame"
storeys = 3
storey_height = "3.2 m"
lines_x = ["0 m", "6 m", "11 m"]
lines_y = ["0 m", "5 m", "9 m"]
plan = [["0 m", "0 m"], ["11 m", "0 m"], ["11 m", "5 m"], ["6 m", "5 m"], ["6 m", "9 m"], ["0 m", "9 m"]]
at = ["100 m", "50 m"]
mass = "90 t"
elastic_modulus = "30 GPa"
beam_x = { width = "0.3 m", depth = "0.6 m" }
beam_y = { width = "0.3 m", depth = "0.5 m" }

[[building.column]]
size = ["0.5 m", "0.4 m"]

[[building.column]]
x = [1, 2]
y = 1
storeys = 2
size = ["0.7 m", "0.5 m"]
"#;

fn tiers(text: &str) -> Tiers {
    let input = read(text).unwrap_or_else(|error| panic!("{error}"));
    match &input.model.buildings[0].structure {
        Structure::Tiers(tiers) => tiers.clone(),
        other => panic!("no plan: {other:?}"),
    }
}

fn frame(text: &str) -> SpaceFrame {
    tiers(text).space_frame.expect("a space frame")
}

fn count(frame: &SpaceFrame, of: fn(SpacePlace) -> bool) -> usize {
    frame
        .members
        .iter()
        .filter(|member| of(member.place))
        .count()
}

#[test]
fn members_outside_of_the_plan_do_not_exist() {
    let frame = frame(L_SHAPE);
    assert_eq!(frame.at, [100.0, 50.0]);
    let columns = count(&frame, |place| matches!(place, SpacePlace::Column { .. }));
    let along = count(&frame, |place| matches!(place, SpacePlace::BeamX { .. }));
    let across = count(&frame, |place| matches!(place, SpacePlace::BeamY { .. }));
    assert_eq!([columns, along, across], [3 * 8, 3 * 5, 3 * 5]);
    let size = |line, storey| {
        let place = SpacePlace::Column { line, storey };
        let member = frame.members.iter().find(|member| member.place == place);
        member.expect("a column").section.size
    };
    assert_eq!(size([1, 0], 1), [0.7, 0.5]);
    assert_eq!(size([1, 0], 0), [0.5, 0.4]);
    assert_eq!(size([2, 0], 1), [0.5, 0.4]);
    let system = System::assemble(&read(L_SHAPE).expect("sound").model).expect("sound");
    assert_eq!(system.buildings[0].modes.len(), 9);
    assert_eq!(system.buildings[0].equations.len(), 9);
}

#[test]
fn without_a_plan_it_is_that_of_the_outer_lines() {
    let plan = L_SHAPE
        .lines()
        .find(|line| line.starts_with("plan"))
        .expect("there");
    let text = L_SHAPE.replace(plan, "");
    let structure = tiers(&text);
    assert_eq!(
        structure.floors[0].plan,
        [[100.0, 50.0], [111.0, 50.0], [111.0, 59.0], [100.0, 59.0]]
    );
    assert_eq!(structure.floors[0].centre, [105.5, 54.5]);
    let turned = tiers(&text.replace("storeys = 3", "storeys = 3\nangle = \"90 deg\""));
    let [x, y] = turned.floors[0].plan[1];
    assert!(
        (x - 100.0).abs() < 1e-12 && (y - 61.0).abs() < 1e-12,
        "{x} {y}"
    );
}

#[test]
fn plans_from_the_ground_up_are_set_backs() {
    let plan = L_SHAPE
        .lines()
        .find(|line| line.starts_with("plan"))
        .expect("there");
    let text = L_SHAPE.replace(
        plan,
        "plan = [{ size = [\"11 m\", \"9 m\"] }, { size = [\"11 m\", \"9 m\"] }, { size = [\"6 m\", \"9 m\"] }]",
    );
    let space_frame = frame(&text);
    let columns = count(&space_frame, |place| {
        matches!(place, SpacePlace::Column { .. })
    });
    assert_eq!(columns, 9 + 9 + 6);
}

#[test]
fn members_may_be_omitted_and_rigid_or_sheared() {
    let text = format!("{L_SHAPE}\n[[building.column]]\nx = 3\ny = 1\nstoreys = 1\nomit = true\n");
    let space_frame = frame(&text);
    let columns = count(&space_frame, |place| {
        matches!(place, SpacePlace::Column { .. })
    });
    assert_eq!(columns, 3 * 8 - 1);
    assert!(space_frame.members[0].section.axial_rigidity.is_some());
    let rigid =
        frame(&L_SHAPE.replace("mass =", "axial = \"rigid\"\nshear = \"flexible\"\nmass ="));
    assert!(rigid.members[0].section.axial_rigidity.is_none());
    assert!(rigid.members[0].section.shear_rigidity.is_some());
    let soft = frame(&L_SHAPE.replace(
        "mass =",
        "stiffness_factor = { column = 0.7, beam = 0.35 }\ntorsion_factor = 0.1\nmass =",
    ));
    let full = frame(L_SHAPE);
    let last = full.members.len() - 1;
    for (member, factor) in [(0, 0.7), (last, 0.35)] {
        let [section, whole] = [&soft, &full].map(|frame| frame.members[member].section);
        let ratio = section.flexural_rigidity[0] / whole.flexural_rigidity[0];
        assert!((ratio - factor).abs() < 1e-12);
        let ratio = section.torsional_rigidity / whole.torsional_rigidity;
        assert!((ratio - 0.1).abs() < 1e-12);
    }
}

#[test]
fn what_does_not_fit_is_refused_with_the_remedy() {
    for (from, to, expected) in [
        ("kind = \"space-frame\"\n", "", "add kind = \"space-frame\""),
        (
            "lines_x = [\"0 m\", \"6 m\", \"11 m\"]\n",
            "",
            "add where the grid lines stand",
        ),
        (
            "\"6 m\", \"11 m\"]",
            "\"11 m\", \"6 m\"]",
            "must rise from line to line",
        ),
        ("elastic_modulus = \"30 GPa\"\n", "", "add elastic_modulus"),
        (
            "beam_x = { width = \"0.3 m\", depth = \"0.6 m\" }\n",
            "",
            "add beam_x",
        ),
        ("depth = \"0.6 m\"", "depth = \"0 m\"", "greater than zero"),
        ("x = [1, 2]", "x = [1, 4]", "within 1 to 3"),
        (
            "x = [1, 2]\ny = 1",
            "x = 3\ny = 3",
            "names no place within the plan",
        ),
        ("size = [\"0.7 m\", \"0.5 m\"]", "", "add the sizes"),
        (
            "mass = \"90 t\"",
            "mass = \"90 t\"\nhinges = { rule = \"bilinear\" }",
            "has no moments",
        ),
        (
            "mass = \"90 t\"",
            "mass = \"90 t\"\ngravity = true\naxial = \"rigid\"",
            "needs columns that shorten under the weight",
        ),
        (
            "mass = \"90 t\"",
            "mass = \"90 t\"\nangle = \"10 deg\"\nstiffness = \"90 MN/m\"",
            "leave out angle",
        ),
        (
            "mass = \"90 t\"",
            "mass = \"90 t\"\nspans = [\"6 m\"]",
            "spans",
        ),
    ] {
        assert!(L_SHAPE.contains(from), "{from}");
        let said = refusal(&L_SHAPE.replacen(from, to, 1));
        assert!(said.contains(expected), "{from} → {to}:\n{said}");
    }
    // A storey without columns, and one whose columns nothing carries.
    let all = format!("{L_SHAPE}\n[[building.column]]\nstoreys = 2\nomit = true\n");
    assert!(refusal(&all).contains("leaves storey 2 without columns"));
    let loose = L_SHAPE
        .replace("beam_x = {", "beam_x = { storeys = 3, ")
        .replace("beam_y = {", "beam_y = { storeys = 3, ")
        + "\n[[building.column]]\nx = 1\ny = 1\nstoreys = 1\nomit = true\n";
    // It hangs from the roof.
    assert!(read(&loose).is_ok());
    let loose = L_SHAPE
        .replace("beam_x = {", "beam_x = { storeys = 1, ")
        .replace("beam_y = {", "beam_y = { storeys = 1, ")
        + "\n[[building.column]]\nx = 1\ny = 1\nstoreys = 2\nomit = true\n";
    let said = refusal(&loose);
    assert!(
        said.contains("no column or beam joins to the ground"),
        "{said}"
    );
}

#[test]
fn histories_name_members_of_the_grid() {
    let output = |name: &str| format!("output = {{ members = [\"{name}\"] }}\n{L_SHAPE}");
    for name in ["A.column.3.1.2", "A.beam_x.3.2.1", "A.beam_y.1.1.2"] {
        assert!(read(&output(name)).is_ok(), "{name}");
    }
    for name in ["A.column.3.3.1", "A.beam.1.1", "A.column.1.1"] {
        let said = refusal(&output(name));
        assert!(said.contains("A.column.X.Y.STOREY"), "{said}");
    }
}

/// Rule, initial stiffness and moments are those of the plane of bending, of the member, and of its storey.
#[test]
fn hinges_are_those_of_members_and_planes() {
    let hinges = |text: &str| {
        L_SHAPE.replacen(
            "mass =",
            &format!("hinges = {{ rule = \"bilinear\", {text} }}\nmass ="),
            1,
        )
    };
    let column = |frame: &SpaceFrame, line: [usize; 2], storey: usize| {
        let place = SpacePlace::Column { line, storey };
        let mut members = frame.members.iter();
        let member = members
            .find(|member| member.place == place)
            .expect("a column");
        (member.section, member.hinges)
    };
    let yielding =
        |hysteresis: &Hysteresis| hysteresis.backbone().side(Side::Positive).yielding.force;
    let near = |a: f64, b: f64| (a / b - 1.0).abs() < 1e-12;
    let moments = "{ yield = \"200 kN.m\", post_yield = 0.02 }";
    let space_frame = frame(&hinges(&format!("initial = 50, column = {moments}")));
    for member in &space_frame.members {
        let is_column = matches!(member.place, SpacePlace::Column { .. });
        assert_eq!(member.may_yield(), is_column);
    }
    let (section, both) = column(&space_frame, [2, 0], 1);
    for (plane, hinge) in both.iter().enumerate() {
        let hinge = hinge.as_ref().expect("a hinge");
        assert!(near(yielding(hinge), 200e3));
        let stiffness = 50.0 * section.flexural_rigidity[plane] / 3.2;
        assert!(near(hinge.backbone().initial(), stiffness), "{stiffness}");
    }
    // What a plane does not say stands beside it; one plane alone leaves the other elastic.
    let space_frame = frame(&hinges(
        "column = { post_yield = 0.02, x = { yield = \"200 kN.m\" }, y = { yield = \"90 kN.m\" } }",
    ));
    let both = column(&space_frame, [0, 0], 0)
        .1
        .map(|column| yielding(&column.expect("a hinge")));
    assert!(near(both[0], 200e3) && near(both[1], 90e3), "{both:?}");
    let space_frame = frame(&hinges(
        "column = { y = { yield = \"90 kN.m\", post_yield = 0.02 } }",
    ));
    let [x, y] = column(&space_frame, [0, 0], 0).1;
    assert!(x.is_none() && y.is_some());
    // Storey by storey; places of their own.
    let storeys = hinges(&format!(
        "beam = [{moments}, {moments}, {{ yield = \"70 kN.m\", post_yield = 0.02 }}]"
    )) + "\n[[building.column]]\nsize = [\"0.7 m\", \"0.7 m\"]\nx = 1\ny = 1\nstoreys = 1\nhinge = { yield = \"900 kN.m\", post_yield = 0.01 }\n";
    let frame = frame(&storeys);
    for member in &frame.members {
        match member.place {
            SpacePlace::Column { line, storey } => {
                assert_eq!(member.may_yield(), line == [0, 0] && storey == 0);
            }
            SpacePlace::BeamX { floor, .. } | SpacePlace::BeamY { floor, .. } => {
                let wanted = if floor == 2 { 70e3 } else { 200e3 };
                assert!(near(yielding(&member.hinges[0].expect("a hinge")), wanted));
                assert!(member.hinges[1].is_none());
            }
        }
    }
    for (text, expected) in [
        ("from = \"section\"", "give the moments of column and beam"),
        ("beam = { x = { yield = 1 } }", "vertical plane only"),
        (
            "column = { x = { yield = 1e5, post_yield = 0.1 }, positive = { yield = 2e5 } }",
            "move positive into x and y",
        ),
        ("column = { yield = 1e5 }", "add post_yield"),
        ("column = { yield = -1e5, post_yield = 0.1 }", "yield"),
        ("column = [{ yield = 1e5, post_yield = 0.1 }]", "3"),
        ("colum = {}", "column"),
    ] {
        let said = refusal(&hinges(text));
        assert!(said.contains(expected), "{text}:\n{said}");
    }
    let without = L_SHAPE.to_owned()
        + "\n[[building.column]]\nsize = [\"0.7 m\", \"0.7 m\"]\nhinge = { yield = 1e5, post_yield = 0.1 }\n";
    assert!(refusal(&without).contains("add hinges = { rule"));
}
