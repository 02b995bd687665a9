//! Space frames: what a file says, and what is refused.

use std::path::Path;

use jostle::{SpaceFrame, SpacePlace, Structure, System, Tiers};
use jostle_io::{Format, Input, read_model_text};

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

fn read(text: &str) -> Result<Input, jostle_io::InputError> {
    read_model_text("model.toml", text, Format::Toml, Path::new(""))
}

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

fn said(text: &str) -> String {
    let error = read(text).err();
    let error = error.unwrap_or_else(|| panic!("this should be refused:\n{text}"));
    error.to_string()
}

fn count(frame: &SpaceFrame, of: fn(SpacePlace) -> bool) -> usize {
    frame.members.iter().filter(|own| of(own.place)).count()
}

#[test]
fn members_outside_of_the_plan_do_not_exist() {
    let own = frame(L_SHAPE);
    assert_eq!(own.at, [100.0, 50.0]);
    let columns = count(&own, |place| matches!(place, SpacePlace::Column { .. }));
    let along = count(&own, |place| matches!(place, SpacePlace::BeamX { .. }));
    let across = count(&own, |place| matches!(place, SpacePlace::BeamY { .. }));
    assert_eq!([columns, along, across], [3 * 8, 3 * 5, 3 * 5]);
    let size = |line, storey| {
        let place = SpacePlace::Column { line, storey };
        let own = own.members.iter().find(|member| member.place == place);
        own.expect("a column").section.size
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
    let own = tiers(&text);
    assert_eq!(
        own.floors[0].plan,
        [[100.0, 50.0], [111.0, 50.0], [111.0, 59.0], [100.0, 59.0]]
    );
    assert_eq!(own.floors[0].centre, [105.5, 54.5]);
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
    let own = frame(&text);
    let columns = count(&own, |place| matches!(place, SpacePlace::Column { .. }));
    assert_eq!(columns, 9 + 9 + 6);
}

#[test]
fn members_may_be_omitted_and_rigid_or_sheared() {
    let text = format!("{L_SHAPE}\n[[building.column]]\nx = 3\ny = 1\nstoreys = 1\nomit = true\n");
    let own = frame(&text);
    let columns = count(&own, |place| matches!(place, SpacePlace::Column { .. }));
    assert_eq!(columns, 3 * 8 - 1);
    assert!(own.members[0].section.axial_rigidity.is_some());
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
        let [own, whole] = [&soft, &full].map(|frame| frame.members[member].section);
        let ratio = own.flexural_rigidity[0] / whole.flexural_rigidity[0];
        assert!((ratio - factor).abs() < 1e-12);
        let ratio = own.torsional_rigidity / whole.torsional_rigidity;
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
        ("x = [1, 2]", "x = [1, 4]", "between 1 and 3"),
        (
            "x = [1, 2]\ny = 1",
            "x = 3\ny = 3",
            "names no place within the plan",
        ),
        ("size = [\"0.7 m\", \"0.5 m\"]", "", "add the sizes"),
        (
            "mass = \"90 t\"",
            "mass = \"90 t\"\nhinges = { rule = \"bilinear\" }",
            "it stays elastic",
        ),
        (
            "mass = \"90 t\"",
            "mass = \"90 t\"\ngravity = true",
            "p_delta alone",
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
        let said = said(&L_SHAPE.replacen(from, to, 1));
        assert!(said.contains(expected), "{from} → {to}:\n{said}");
    }
    // A storey without columns, and one whose columns nothing carries.
    let all = format!("{L_SHAPE}\n[[building.column]]\nstoreys = 2\nomit = true\n");
    assert!(said(&all).contains("leaves storey 2 without columns"));
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
    let said = said(&loose);
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
        let said = said(&output(name));
        assert!(said.contains("A.column.X.Y.STOREY"), "{said}");
    }
}
