//! Slips that are easily made, and what is said of them.

use std::path::Path;

use jostle_io::{Format, read_model_file, read_model_text};
use jostle_testkit::files::{read, refusal};

const MODEL: &str = r#"
[motion]
record = "el-centro-1940-ns"

[[building]]
name = "A"
kind = "frame"
storeys = 3
storey_height = "3.2 m"
spans = ["6 m"]
column = { width = "500 mm", depth = "500 mm" }
beam = { width = "300 mm", depth = "600 mm" }
concrete = "C30"
beam_mass = "36 kN/m"

[[building.infill]]
thickness = "150 mm"
width = "0.8 m"
modulus = "3 GPa"

[[building]]
name = "B"
kind = "shear"
mass = ["40 t", "40 t", "40 t"]
stiffness = ["60 MN/m", "60 MN/m", "60 MN/m"]
storey_height = "3.2 m"

[[gap]]
between = ["A", "B"]
width = "50 mm"
law = "hertz-damp"
"#;

fn with(from: &str, to: &str) -> String {
    assert!(MODEL.contains(from), "the model has no {from}");
    MODEL.replace(from, to)
}

#[test]
fn faults_say_what_to_write() {
    let section = |steel: &str| format!("\"500 mm\", bars = \"8 d20\", steel = {steel} }}");
    let cases: &[(&str, &str, &[&str])] = &[
        ("\"C30\"", "\"4 ksi\"", &["written \"f'c = 4 ksi\""]),
        ("\"C30\"", "\"fc28\"", &["written \"f'c = 4 ksi\""]),
        (
            "\"C30\"",
            "\"C31\"",
            &["did you mean \"C30\"?", "f'c = 4 ksi"],
        ),
        (
            "\"500 mm\" }",
            &section("\"235\""),
            &["235 has no unit", "write \"235 MPa\""],
        ),
        (
            "\"500 mm\" }",
            &section("235"),
            &["235 has no unit", "write \"235 MPa\""],
        ),
        (
            "\"36 kN/m\"",
            "\"5 kN/m2\"",
            &["multiply by the tributary width: \"30 kN/m\" for a strip of 6 m"],
        ),
        (
            "storeys = 3",
            "storeys = 0",
            &["a building of one floor has storeys = 1"],
        ),
        (
            "\"50 mm\"",
            "\"-50 mm\"",
            &["must not be negative, found \"-50 mm\"; touching"],
        ),
        (
            "\"150 mm\"",
            "150",
            &["a panel thickness of 150 m, expected 0.001 m to 10 m: is it 150 mm?"],
        ),
        (
            "name = \"A\"",
            "name = \u{201c}A\u{201d}",
            &["use straight ones"],
        ),
        (
            "[motion]",
            "units = \"us\"\n[motion]",
            &["units belongs under [output]"],
        ),
    ];
    for (from, to, parts) in cases {
        let shown = refusal(&with(from, to));
        for part in *parts {
            assert!(shown.contains(part), "{part} in\n{shown}");
        }
        let nonsense = ["did you mean \"C20\"", "did you mean \"title\""];
        assert!(!nonsense.iter().any(|text| shown.contains(text)), "{shown}");
    }
}

/// Gaps of one pair that join the same floors, by whatever keys, and such that do not.
#[test]
fn gaps_between_the_same_floors_are_warned_of() {
    let second = |keys: &str| {
        format!("{MODEL}\n[[gap]]\nbetween = [\"A\", \"B\"]\nwidth = \"10 mm\"\n{keys}\n")
    };
    let warnings = |text: &str| read(text).expect("valid").warnings.join("\n");
    for keys in [
        "",
        "floors = \"all\"",
        "floors = [[2, 2]]",
        "floors = [\"6.4 m\"]",
        "floors = [[2, \"6.4 m\"]]",
    ] {
        let shown = warnings(&second(keys));
        assert!(
            shown.contains("gap[1]: joins floors that the [[gap]] of line 28 joins as well"),
            "{keys}:\n{shown}"
        );
    }
    let bumper = "law = \"rubber\"\nthickness = \"25 mm\"\nstiffness = \"30 MN/m\"";
    assert!(
        !warnings(&second(bumper)).contains("joins floors"),
        "a bumper before the face"
    );
    let apart =
        second("floors = [[3, 3]]").replace("law = \"hertz-damp\"", "floors = [[1, 1], [2, 2]]");
    assert!(!warnings(&apart).contains("joins floors"), "other floors");
}

#[test]
fn stiffness_that_grows_upwards_is_warned_of() {
    let shear = "\"60 MN/m\", \"60 MN/m\", \"60 MN/m\"";
    let warned = |list: &str| read(&with(shear, list)).expect("valid").warnings;
    assert_eq!(
        warned("\"60 MN/m\", \"80 MN/m\", \"120 MN/m\""),
        [
            "building[1].stiffness: every storey is stiffer than the one below; lists begin at the ground"
        ]
    );
    // A soft ground storey.
    assert_eq!(
        warned("\"60 MN/m\", \"150 MN/m\", \"150 MN/m\""),
        Vec::<String>::new()
    );
}

/// The record has 3.13 m/s², of which 0.35 m/s² is a ninth.
#[test]
fn a_peak_in_g_without_unit_is_asked_about() {
    let asked = |pga: &str| {
        let input = read(&with("[motion]", &format!("[motion]\npga = {pga}"))).expect("valid");
        let motion = input.ground_motion().expect("resolved");
        input.unusual_motion(&motion)
    };
    let text = asked("0.35").expect("asked");
    assert!(
        text.starts_with("motion.pga: 0.35 m/s² is 0.112 "),
        "{text}"
    );
    assert!(
        text.ends_with("of the peak of the record; is it 0.35 g?"),
        "{text}"
    );
    assert_eq!(asked("\"0.35 m/s2\""), None);
    assert_eq!(asked("0.9"), None);
}

#[test]
fn a_missing_record_names_the_folder() {
    let text = with("el-centro-1940-ns", "no.at2");
    let missing = |folder: &str| {
        let input = read_model_text("m.toml", &text, Format::Toml, Path::new(folder));
        let motion = input.expect("valid").ground_motion();
        motion.expect_err("it is missing").to_string()
    };
    for (folder, words) in [("", "in the current folder"), ("sub", "in the folder sub")] {
        let shown = missing(folder);
        let wanted = format!("there is no record \"no.at2\" {words}; built-in records: ");
        assert!(shown.contains(&wanted), "{shown}");
    }
}

#[test]
fn warnings_have_the_line_of_their_key() {
    let input = read(&with("\"50 mm\"", "\"5 m\"")).expect("valid");
    let [warning] = &input.warnings[..] else {
        panic!("{:?}", input.warnings);
    };
    assert!(
        input
            .with_line(warning)
            .starts_with("model.toml:30: gap[0].width: a gap of 5 m"),
        "{}",
        input.with_line(warning)
    );
    let other = "there is no gap between \"A\" and \"B\": they pass through each other";
    assert_eq!(input.with_line(other), other);
}

#[test]
fn json_gets_advice_in_json() {
    let error = read_model_text("m.json", "{\"title\": \"x\"}", Format::Json, Path::new(""));
    let shown = error.expect_err("no buildings").to_string();
    assert!(
        shown.contains("help: add a \"building\": [{ … }]; \"jostle new\""),
        "{shown}"
    );
}

#[test]
fn a_missing_file_is_no_list_of_faults() {
    let shown = read_model_file(Path::new("/nowhere/m.toml"))
        .expect_err("it is missing")
        .to_string();
    assert!(
        shown.starts_with("/nowhere/m.toml: cannot be read: "),
        "{shown}"
    );
    assert!(!shown.contains("fault") && !shown.contains('\n'), "{shown}");
}
