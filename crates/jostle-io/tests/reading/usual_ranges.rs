//! Values outside their usual ranges: slips of units are refused with the likely meaning, the rest is warned of.

use std::path::Path;

use jostle::judgement::{Known, judge};
use jostle_io::{Format, ModelTree, Overrides, TreeValue, read_model_text};
use jostle_testkit::files::{read, refusal};

const MODEL: &str = r#"
[motion]
record = "el-centro-1940-ns"
pga = "2 m/s2"

[[building]]
name = "A"
storeys = 3
storey_height = "3.2 m"
spans = ["6 m", "4 m"]
column = { width = "500 mm", depth = "500 mm" }
beam = { width = "300 mm", depth = "600 mm" }
elastic_modulus = "30 GPa"
beam_mass = "3600 kg/m"

[[building]]
name = "B"
kind = "shear"
mass = ["40 t", "40 t", "40 t"]
stiffness = "60 MN/m"
storey_height = "3.2 m"

[[gap]]
between = ["A", "B"]
width = "50 mm"
law = "hertz-damp"
"#;

/// The model with one text replaced by another.
fn with(from: &str, to: &str) -> String {
    assert!(MODEL.contains(from), "the model has no \"{from}\"");
    MODEL.replace(from, to)
}

/// Warnings of a text that must be valid, those of the assembled model included.
fn warnings(text: &str) -> Vec<String> {
    let mut input = read(text).unwrap_or_else(|error| panic!("{error}\nin\n{text}"));
    let system = jostle::System::assemble(&input.model)
        .unwrap_or_else(|faults| panic!("{}", input.faults(faults)));
    input.note_system(&system);
    input.warnings
}

#[test]
fn usual_values_are_not_warned_of() {
    assert_eq!(warnings(MODEL), Vec::<String>::new());
}

#[test]
fn slips_of_units_are_refused_at_their_line_with_the_likely_meaning() {
    let cases: &[(&str, &str, &str, &str)] = &[
        (
            "width = \"500 mm\"",
            "width = 500",
            "building[0].column.width",
            "is it 500 mm?",
        ),
        (
            "width = \"500 mm\"",
            "width = \"500 m\"",
            "building[0].column.width",
            "is it 500 mm?",
        ),
        (
            "width = \"500 mm\"",
            "width = \"0.5 mm\"",
            "building[0].column.width",
            "is it 0.5 m?",
        ),
        (
            "depth = \"600 mm\"",
            "depth = 60",
            "building[0].beam.depth",
            "is it 60 cm?",
        ),
        (
            "[\"6 m\", \"4 m\"]",
            "[6, 6000]",
            "building[0].spans[1]",
            "is it 6000 mm?",
        ),
        (
            "\"3.2 m\"\nspans",
            "3200\nspans",
            "building[0].storey_height",
            "is it 3200 mm?",
        ),
        (
            "\"30 GPa\"",
            "30",
            "building[0].elastic_modulus",
            "is it 30 GPa?",
        ),
        (
            "\"30 GPa\"",
            "30000",
            "building[0].elastic_modulus",
            "is it 30000 MPa?",
        ),
        (
            "\"3600 kg/m\"",
            "\"3600 t/m\"",
            "building[0].beam_mass",
            "is it 3600 kg/m?",
        ),
        (
            "width = \"50 mm\"",
            "width = 50",
            "gap[0].width",
            "is it 50 mm?",
        ),
        ("\"2 m/s2\"", "220", "motion.pga", "is it 220 cm/s2?"),
    ];
    for (from, to, path, meaning) in cases {
        let text = with(from, to);
        let shown = refusal(&text);
        let line = 1 + text[..MODEL.find(from).expect("the change")]
            .matches('\n')
            .count();
        let first = shown.lines().next().unwrap_or_default();
        assert!(first.starts_with(&format!("model.toml:{line}:")), "{shown}");
        assert!(first.contains(path), "{path} in\n{shown}");
        assert!(first.contains(meaning), "{meaning} in\n{shown}");
        assert!(shown.contains("accept_unusual = true"), "{shown}");
        assert!(shown.ends_with("1 fault in model.toml"), "{shown}");
    }
}

#[test]
fn what_is_merely_unusual_is_warned_of_and_valid() {
    let cases: &[(&str, &str, &str, &str)] = &[
        (
            "[\"6 m\", \"4 m\"]",
            "[6, \"70 m\"]",
            "building[0].spans[1]",
            "a span of 70 m",
        ),
        (
            "[\"6 m\", \"4 m\"]",
            "[600, 4]",
            "building[0].spans[0]",
            "is it 600 cm?",
        ),
        (
            "storey_height = \"3.2 m\"",
            "storey_height = \"40 m\"",
            "building[0].storey_height",
            "40 m is unusual",
        ),
        (
            "\"3600 kg/m\"",
            "30",
            "building[0].beam_mass",
            "is it 30 kN/m?",
        ),
        (
            "width = \"50 mm\"",
            "width = \"3 m\"",
            "gap[0].width",
            "a gap of 3 m",
        ),
        ("\"2 m/s2\"", "\"6 g\"", "motion.pga", "58.8399 m/s2"),
        ("\"2 m/s2\"", "\"0.5 cm/s2\"", "motion.pga", "0.005 m/s2"),
        (
            "[\"40 t\", \"40 t\", \"40 t\"]",
            "[40, 40, 40]",
            "building[1].mass[0]",
            "is it 40 t? (and 2 more entries)",
        ),
        (
            "\"60 MN/m\"",
            "60",
            "building[1].stiffness",
            "is it 60 MN/m?",
        ),
        (
            "\"60 MN/m\"",
            "\"2 kN/m\"",
            "building[1]",
            "the first period of \"B\" is 63.1 s",
        ),
        (
            "\"60 MN/m\"",
            "\"6e12 N/m\"",
            "building[1]",
            "the first period of \"B\" is 0.00115 s",
        ),
        (
            "law = \"hertz-damp\"",
            "law = \"linear\"\nstiffness = 500",
            "gap[0].stiffness",
            "softer than a storey",
        ),
    ];
    for (from, to, path, part) in cases {
        let found = warnings(&with(from, to));
        let wanted =
            |warning: &String| warning.starts_with(&format!("{path}: ")) && warning.contains(part);
        assert!(found.iter().any(wanted), "{path}: {part} in {found:#?}");
    }
}

#[test]
fn what_is_meant_is_accepted_as_a_whole_or_by_field() {
    let unusual = with("width = \"50 mm\"", "width = 50").replace("\"3600 kg/m\"", "30");
    let all = format!("{unusual}\n[analysis]\naccept_unusual = true\n");
    assert_eq!(warnings(&all), Vec::<String>::new());
    let one = format!("{unusual}\n[analysis]\naccept_unusual = [\"gap[0].width\"]\n");
    let found = warnings(&one);
    assert!(
        matches!(&found[..], [one] if one.starts_with("building[0].beam_mass")),
        "{found:#?}"
    );
    let building = format!("{unusual}\n[analysis]\naccept_unusual = [\"building[0]\"]\n");
    assert!(refusal(&building).contains("gap[0].width"));
    let wrong = format!("{MODEL}\n[analysis]\naccept_unusual = \"yes\"\n");
    assert!(refusal(&wrong).contains("expected true, false or a list of fields"));
}

#[test]
fn json_studies_and_changes_are_judged_alike() {
    let json = r#"{ "building": [ { "name": "A", "kind": "shear", "mass": ["40 t"], "stiffness": "60 MN/m", "storey_height": 3200 } ] }"#;
    let from_json = read_model_text("model.json", json, Format::Json, Path::new(""));
    let shown = from_json.map(|_| ()).expect_err("a slip").to_string();
    assert!(
        shown.contains("building[0].storey_height") && shown.contains("is it 3200 mm?"),
        "{shown}"
    );

    let mut tree =
        ModelTree::parse("model.toml", MODEL, Format::Toml, Path::new("")).expect("a tree");
    tree.set("building[0].column.width", &TreeValue::Integer(500))
        .expect("a place");
    let shown = tree.input().map(|_| ()).expect_err("a slip").to_string();
    assert!(shown.contains("is it 500 mm?"), "{shown}");

    let change = |gap: Option<f64>, pga: Option<f64>| {
        let mut input = read(MODEL).expect("valid");
        input
            .apply(&Overrides {
                pga,
                gap,
                record: None,
                angle: None,
            })
            .map(|()| input.warnings)
    };
    let shown = change(Some(100.0), None).expect_err("a slip").to_string();
    assert!(
        shown.contains("a gap of 100 m") && shown.contains("is it 100 mm?"),
        "{shown}"
    );
    let shown = change(None, Some(220.0)).expect_err("a slip").to_string();
    assert!(shown.contains("is it 220 cm/s2?"), "{shown}");
    let found = change(Some(3.0), None).expect("unusual");
    assert!(
        matches!(&found[..], [one] if one.starts_with("gap: a gap of 3 m")),
        "{found:#?}"
    );
    assert_eq!(
        change(Some(0.1), Some(3.0)).expect("usual"),
        Vec::<String>::new()
    );
}

#[test]
fn a_changed_width_takes_its_warning_with_it() {
    let mut input = read(&with("width = \"50 mm\"", "width = \"3 m\"")).expect("valid");
    assert_eq!(input.warnings.len(), 1);
    let change = Overrides {
        gap: Some(0.05),
        ..Overrides::default()
    };
    input.apply(&change).expect("usual");
    assert_eq!(input.warnings, Vec::<String>::new());
}

#[test]
fn a_record_scaled_out_of_the_usual_range_is_warned_of() {
    let peak = |text: &str| {
        let input = read(text).expect("only the scaled record shows it");
        let motion = input.ground_motion().expect("below the greatest");
        input.unusual_motion(&motion)
    };
    assert_eq!(peak(MODEL), None);
    let strong = with("pga = \"2 m/s2\"", "scale = 20");
    let warning = peak(&strong).expect("68 m/s2");
    assert!(
        warning.starts_with("motion: a peak ground acceleration of 6"),
        "{warning}"
    );
    assert_eq!(
        peak(&format!(
            "{strong}\n[analysis]\naccept_unusual = [\"motion\"]\n"
        )),
        None
    );
}

#[test]
fn academic_models_stay_valid() {
    for (mass, stiffness) in [
        ("1", "1e-6"),
        ("\"40 t\"", "4e9"),
        ("1", "1e5"),
        ("\"1000 t\"", "1e5"),
        ("\"40 t\"", "1e-3"),
    ] {
        let text = format!(
            "[motion]\nkind = \"sine\"\namplitude = 1e-4\nperiod = \"1 s\"\nduration = \"5 s\"\n[[building]]\nname = \"A\"\nkind = \"shear\"\nmass = [{mass}]\nstiffness = [{stiffness}]\nstorey_height = 1\n"
        );
        warnings(&text);
        read(&text)
            .expect("valid")
            .ground_motion()
            .expect("a weak sine");
    }
}

const HINGES: &str = "hinges = { rule = \"peak-oriented\", column = { cracking = \"120 kN.m\", yield = \"400 kN.m\", post_cracking = 0.3, post_yield = 0.02 } }";
const BILINEAR: &str =
    "hinges = { rule = \"bilinear\", column = { yield = \"400 kN.m\", post_yield = 0.02 } }";

#[test]
fn cracking_that_counts_twice_is_found() {
    let twice = |factor: &str, hinges: &str| {
        let lines = format!("beam_mass = \"3600 kg/m\"\nstiffness_factor = {factor}\n{hinges}");
        let input = read(&with("beam_mass = \"3600 kg/m\"", &lines)).expect("valid");
        let system = jostle::System::assemble(&input.model).expect("sound");
        let found = judge(&Known {
            model: &input.model,
            system: &system,
            motion: None,
            stated: &input.stated,
            results: None,
        });
        let found = found
            .iter()
            .filter(|finding| finding.text.contains("counted twice"));
        found.count()
    };
    assert_eq!(twice("0.7", HINGES), 1);
    assert_eq!(twice("{ column = 0.7 }", HINGES), 1);
    assert_eq!(twice("{ beam = 0.35 }", HINGES), 0, "beams have no hinges");
    assert_eq!(twice("1", HINGES), 0);
    assert_eq!(twice("0.7", BILINEAR), 0);
}

/// Two frames; the storeys of the second above the first are shifted by 0.4 m.
fn shifted(floors: &str) -> String {
    let second = r#"
[[building]]
name = "B"
storey_height = ["3.2 m", "3.6 m", "3.2 m"]
spans = ["6 m"]
column = { width = "500 mm", depth = "500 mm" }
beam = { width = "300 mm", depth = "600 mm" }
elastic_modulus = "30 GPa"
beam_mass = "3600 kg/m"
"#;
    let (first, rest) = MODEL.split_at(MODEL.find("[[building]]\nname = \"B\"").expect("B"));
    let gap = &rest[rest.find("[[gap]]").expect("a gap")..];
    format!("{first}{second}{gap}{floors}\n")
}

#[test]
fn floors_that_match_in_part_are_named() {
    let found = warnings(&shifted(""));
    let [warning] = &found[..] else {
        panic!("one warning expected: {found:#?}");
    };
    for part in [
        "gap[0].floors: floors 2, 3 of \"A\" and floor 2 of \"B\" stand beside the other building",
        "The only contact joins floors at equal height",
        "impacts of floors against columns are left out",
        "floors = \"all\"",
    ] {
        assert!(warning.contains(part), "\"{part}\" in {warning}");
    }
    assert_eq!(warnings(&shifted("floors = \"all\"")), Vec::<String>::new());
    // Whoever lists the pairs has said which floors can touch.
    assert_eq!(
        warnings(&shifted("floors = [[1, 1]]")),
        Vec::<String>::new()
    );
    // A second gap may bring the others into contact.
    let second = "[[gap]]\nbetween = [\"A\", \"B\"]\nwidth = \"50 mm\"\nfloors = [[2, \"6.4 m\"], [3, \"9.6 m\"], [\"6.8 m\", 2]]";
    assert_eq!(warnings(&shifted(second)), Vec::<String>::new());
}

#[test]
fn floors_beside_a_shear_building_get_a_remedy_that_works() {
    let shear = with(
        "storey_height = \"3.2 m\"\n\n[[gap]]",
        "storey_height = [\"3.2 m\", \"3.6 m\", \"3.2 m\"]\n\n[[gap]]",
    );
    let found = warnings(&shear);
    let [warning] = &found[..] else {
        panic!("one warning expected: {found:#?}");
    };
    assert!(
        warning.contains("list the pairs that can touch as [[\"6.800 m\", 2], …]"),
        "{warning}"
    );
    let listed = format!("{shear}floors = [[1, 1], [\"6.800 m\", 2]]\n");
    assert_eq!(warnings(&listed), Vec::<String>::new());
}

#[test]
fn unnamed_damping_modes_go_by_lateral_modes_not_by_floors() {
    let one_storey = r#"
[[building]]
name = "A"
storeys = 1
storey_height = "3.2 m"
spans = ["6 m"]
column = { width = "500 mm", depth = "500 mm" }
beam = { width = "300 mm", depth = "600 mm" }
elastic_modulus = "30 GPa"
beam_mass = "100 kg/m"
"#;
    let coefficients = |damping: &str| {
        let input = read(&format!("{one_storey}{damping}")).expect("valid");
        let system = jostle::System::assemble(&input.model).expect("sound");
        let building = &system.buildings[0];
        let lateral = building.lateral_modes().count();
        (building.equations.alpha, building.equations.beta, lateral)
    };
    let (alpha, beta, lateral) = coefficients("");
    assert!(
        lateral >= 3,
        "masses of the columns make lateral modes of their own: {lateral}"
    );
    let named = coefficients("damping = { ratio = 0.05, modes = [1, 3] }");
    assert_eq!((alpha, beta), (named.0, named.1));
    let light = "column_segments = 1\n";
    let (_, beta, lateral) = coefficients(light);
    assert_eq!(lateral, 1);
    assert!(beta == 0.0, "one lateral mode: proportional to mass");
    let page = jostle_io::model_reference();
    let said = "[1, 3]; [1, 2] with two lateral modes, [1] with one";
    assert!(
        page.contains(said) && !page.contains("fewer floors"),
        "the page says so"
    );
}
