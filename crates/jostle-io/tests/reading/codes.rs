//! Inputs of codes, and materials by the names of codes, in model files.

use jostle::Structure;
use jostle::separation::{BuildingCodes, Code, CodeInputs, HazardZone, JointSystem, MotionLevel};
use jostle_io::Input;
use jostle_testkit::files::{self, sound};

fn read(text: &str) -> Result<Input, String> {
    files::read(text).map_err(|e| e.to_string())
}

/// Two shear buildings; `own` are keys of the first.
fn towers(keys: &str, codes: &str) -> String {
    let tower = "[[building]]\nkind = \"shear\"\nmass = [\"40 t\", \"40 t\"]\nstiffness = [\"60 MN/m\", \"50 MN/m\"]\nstorey_height = \"3 m\"\n";
    format!("{tower}{keys}\n{tower}{codes}\n")
}

fn frame(concrete: &str, column: &str) -> String {
    format!(
        "[[building]]\nstoreys = 1\nstorey_height = \"3 m\"\nspans = [\"6 m\"]\n\
         column = {{ width = \"500 mm\", depth = \"500 mm\"{column} }}\nbeam = {{ width = \"300 mm\", depth = \"600 mm\" }}\n\
         {concrete}\nbeam_mass = \"3600 kg/m\"\n"
    )
}

#[test]
fn a_file_without_codes_has_the_defaults() {
    let codes = sound(&towers("", "")).codes;
    let due = CodeInputs {
        buildings: vec![BuildingCodes::default(); 2],
        ..CodeInputs::default()
    };
    assert_eq!(codes, due);
}

#[test]
fn values_of_a_building_come_before_those_of_all() {
    let text = towers(
        "codes = { importance = 1.25, behaviour_factor = 3.9 }",
        "[codes]\nshow = [\"en1998\", \"asce7\"]\nmotion = \"reduced\"\nfloor_levels = \"different\"\nsystem = \"wall\"\nintensity = 8\n\
         ground_acceleration = \"0.25 g\"\nhazard = \"low\"\nzone_factor = 0.45\nsoil_factor = 1.05\nimportance = 1.5\n\
         response_modification = 8\ndeflection_amplification = 5.5\nregular = false",
    );
    let codes = sound(&text).codes;
    assert_eq!(codes.shown, [Code::En1998, Code::Asce7]);
    assert_eq!(codes.motion, MotionLevel::Reduced);
    assert_eq!(codes.floors_are_level, Some(false));
    assert_eq!(codes.system, Some(JointSystem::Wall));
    assert_eq!(codes.intensity, Some(8));
    assert_eq!(codes.hazard, HazardZone::Low);
    let acceleration = codes.ground_acceleration.expect("it is given");
    assert!((acceleration - 2.451_662_5).abs() < 1e-9);
    assert_eq!(
        (codes.zone_factor, codes.soil_factor),
        (Some(0.45), Some(1.05))
    );
    let all = BuildingCodes {
        importance: Some(1.5),
        behaviour_factor: None,
        response_modification: Some(8.0),
        deflection_amplification: Some(5.5),
        is_regular: Some(false),
    };
    let first = BuildingCodes {
        importance: Some(1.25),
        behaviour_factor: Some(3.9),
        ..all
    };
    assert_eq!(codes.buildings, [first, all]);
    let one = sound(&towers("", "[codes]\nshow = \"tbdy2018\"")).codes;
    assert_eq!(one.shown, [Code::Tbdy2018]);
}

#[test]
fn wrong_codes_are_named_all_at_once() {
    let text = towers(
        "codes = { response_modification = 0.5, q = 3 }",
        "[codes]\nshow = [\"en1998\", \"eurocode\"]\nmotion = \"half\"\nimportance = -1\nzone_factor = \"1 m\"\nhazard = 3",
    );
    let error = read(&text).expect_err("it is wrong");
    for due in [
        "building[0].codes.response_modification: must be at least 1, found 0.5",
        "building[0].codes.q: unknown key \"q\"",
        "codes.show[1]: \"eurocode\" is not known; available: ubc97",
        "codes.motion: \"half\" is not known; available: full, reduced",
        "codes.importance: must be greater than zero",
        "codes.zone_factor: ",
        "codes.hazard: expected one of low, intermediate, high",
    ] {
        assert!(error.contains(due), "{due} in\n{error}");
    }
}

/// E of GB 50010 table 4.1.5, EN 1992-1-1 table 3.1 and ACI 318-19 19.2.2: 30, 33 and 57 000 √4000 psi = 24.86 GPa.
#[test]
fn concrete_has_the_modulus_of_its_code() {
    let rigidity = |concrete: &str| {
        let input = sound(&frame(&format!("concrete = \"{concrete}\""), ""));
        let Structure::Frame(frame) = &input.model.buildings[0].structure else {
            panic!("a frame");
        };
        frame.columns[0].flexural_rigidity / (0.5_f64.powi(4) / 12.0)
    };
    for (concrete, gigapascals) in [
        ("C30", 30.0),
        ("C80", 38.0),
        ("C30/37", 33.0),
        ("C90/105", 44.0),
        ("f'c = 4 ksi", 24.856),
        ("f'c = 4000 psi", 24.856),
    ] {
        let found = 1e-9 * rigidity(concrete);
        assert!(
            (found / gigapascals - 1.0).abs() < 1e-4,
            "{concrete}: {found} GPa"
        );
    }
}

#[test]
fn ambiguous_materials_are_refused_with_the_remedy() {
    for (concrete, due) in [
        ("C30/35", "did you mean \"C30/37\"?"),
        ("f'c = 4", "has no unit"),
        ("f'c = 4", "\"f'c = 4 ksi\""),
        ("f'c = 4 MPa", "must lie between 10 and 150 MPa"),
        ("M30", "is not known; available: C20"),
    ] {
        let error = read(&frame(&format!("concrete = \"{concrete}\""), "")).expect_err(concrete);
        assert!(error.contains(due), "{concrete}: {due} in\n{error}");
        assert_eq!(
            error.matches("building[0].concrete: ").count(),
            1,
            "{error}"
        );
    }
    let bars = ", bars = \"8 d20\", steel = \"Grade 500\", concrete = \"f'c = 30\"";
    let error = read(&frame("concrete = \"C30\"", bars)).expect_err("both are wrong");
    assert!(
        error.contains("\"Grade 500\" is not known; available: HRB335"),
        "{error}"
    );
    assert!(
        error.contains("column.concrete: f'c = 30 has no unit"),
        "{error}"
    );
}

#[test]
fn sections_take_materials_of_any_code() {
    let strengths = |concrete: &str, keys: &str, steel: &str| {
        let bars = format!(", bars = \"8 d20\", steel = \"{steel}\"{keys}");
        let input = sound(&frame(&format!("concrete = \"{concrete}\""), &bars));
        let section = &input.members.reinforced[0].section;
        [section.concrete.strength, section.steel.yield_strength].map(|p| 1e-6 * p)
    };
    let near = |found: [f64; 2], due: [f64; 2]| {
        for (found, due) in found.into_iter().zip(due) {
            assert!((found / due - 1.0).abs() < 1e-4, "{found} for {due}");
        }
    };
    near(strengths("C30", "", "HRB400"), [20.1, 400.0]);
    near(strengths("C30/37", "", "B500"), [30.0, 500.0]);
    near(strengths("f'c = 4 ksi", "", "Grade 60"), [27.579, 413.685]);
    near(
        strengths(
            "C30",
            ", strength = \"mean\", concrete = \"C25/30\"",
            "B450C",
        ),
        [33.0, 495.0],
    );
    near(
        strengths("C30/37", ", concrete = \"f'c = 28 MPa\"", "Grade 420"),
        [28.0, 420.0],
    );
}
