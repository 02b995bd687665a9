//! What a valid model assumes: gross sections, and beams without mass between their ends.

use jostle_testkit::files::sound;

const FRAME: &str = r#"
[[building]]
name = "A"
storeys = 3
storey_height = "3.2 m"
spans = ["6 m", "4 m"]
column = { width = "500 mm", depth = "500 mm" }
beam = { width = "300 mm", depth = "600 mm" }
elastic_modulus = "30 GPa"
beam_mass = "3600 kg/m"
"#;

fn assumptions(text: &str) -> Vec<String> {
    sound(text).assumptions()
}

fn with(more: &str) -> Vec<String> {
    assumptions(&format!("{FRAME}{more}\n"))
}

fn replaced(from: &str, to: &str) -> Vec<String> {
    assert!(FRAME.contains(from), "the frame has no \"{from}\"");
    assumptions(&FRAME.replace(from, to))
}

/// The only assumption, which must begin and end like this.
fn assert_one(found: &[String], start: &str, remedy: &str) {
    let [text] = found else {
        panic!("one is expected, found {found:?}");
    };
    assert!(text.starts_with(start), "{text}");
    assert!(text.contains(remedy), "{text}");
}

#[test]
fn gross_sections_are_named_until_they_are_cracked() {
    let both = "stiffness_factor = { column = 0.7, beam = 0.35 }";
    assert_one(
        &with(""),
        "\"A\": columns and beams have the stiffness of the gross section",
        both,
    );
    assert_one(
        &with("stiffness_factor = 1.0"),
        "\"A\": columns and beams",
        both,
    );
    assert_one(
        &with("stiffness_factor = { column = 0.7 }"),
        "\"A\": beams have the stiffness of the gross section",
        "stiffness_factor = { beam = 0.35 }",
    );
    assert_one(
        &with("stiffness_factor = { beam = \"50 %\" }"),
        "\"A\": columns have",
        "stiffness_factor = { column = 0.7 }",
    );
    for cracked in [
        "stiffness_factor = 0.5",
        "stiffness_factor = \"50 %\"",
        both,
    ] {
        assert_eq!(with(cracked), Vec::<String>::new(), "{cracked}");
    }
}

#[test]
fn hinges_that_crack_and_other_materials_need_no_factor() {
    let crack = |kind| {
        format!(
            "{kind} = {{ cracking = \"120 kN.m\", yield = \"400 kN.m\", post_cracking = 0.3, post_yield = 0.02 }}"
        )
    };
    let hinges = format!(
        "hinges = {{ rule = \"takeda\", initial = \"rigid\", {}, {} }}",
        crack("column"),
        crack("beam")
    );
    assert_eq!(with(&hinges), Vec::<String>::new());
    // Steel, and members given by their rigidities.
    assert_eq!(replaced("\"30 GPa\"", "\"210 GPa\""), Vec::<String>::new());
    let rigidities = FRAME
        .replace(
            "{ width = \"500 mm\", depth = \"500 mm\" }",
            "{ EI = \"150 MN.m2\", mass = \"600 kg/m\" }",
        )
        .replace(
            "{ width = \"300 mm\", depth = \"600 mm\" }",
            "{ EI = \"160 MN.m2\" }",
        );
    assert_eq!(assumptions(&rigidities), Vec::<String>::new());
}

#[test]
fn beams_without_mass_between_their_ends_are_named() {
    let cracked = "stiffness_factor = 0.5\n";
    let massless = "\"A\": beams have no mass between their ends";
    let frame = FRAME.replace("beam_mass = \"3600 kg/m\"", "floor_mass = \"40 t\"");
    assert_one(
        &assumptions(&format!("{frame}{cracked}")),
        massless,
        "as beam_mass",
    );
    assert_one(
        &with(&format!("{cracked}beam_segments = 1")),
        massless,
        "leave beam_segments out",
    );
    assert_eq!(
        with(&format!("{cracked}beam_segments = [1, 3]")),
        Vec::<String>::new()
    );
}

#[test]
fn buildings_that_share_an_assumption_share_its_line() {
    let two = format!("{FRAME}{}", FRAME.replace("\"A\"", "\"B\""));
    assert_one(
        &assumptions(&two),
        "\"A\", \"B\": columns and beams have",
        "stiffness_factor = {",
    );
}

/// Bars and ties are there to be compared with: whoever does not ask is told, for plane frames and space frames alike.
#[test]
fn bars_without_a_comparison_are_named() {
    let bars = "steel = \"HRB400\", concrete = \"C30\", bars = \"12 d20\", ties = \"d10 @ 100 mm\"";
    let plane = FRAME.replace(
        "depth = \"500 mm\" }",
        &format!("depth = \"500 mm\", {bars} }}"),
    );
    let space = format!(
        r#"
[[building]]
name = "A"
kind = "space-frame"
storeys = 1
storey_height = "3.2 m"
lines_x = ["0 m", "6 m"]
lines_y = ["0 m", "5 m"]
elastic_modulus = "30 GPa"
column = {{ size = ["500 mm", "500 mm"], {bars} }}
beam_x = {{ width = "300 mm", depth = "600 mm" }}
beam_y = {{ width = "300 mm", depth = "600 mm" }}
mass = "30 t"
"#
    );
    // On soil as well, which is read after the bars.
    let soil = "[building.foundation]\nlength = \"14 m\"\nwidth = \"8 m\"\nmass = \"120 t\"\n\
        [soil]\nshear_wave_velocity = \"250 m/s\"\ndensity = \"1900 kg/m3\"\npoisson_ratio = 0.33\n";
    let grounded = |model: &str| {
        let damped = "damping = { ratio = 0.05, relative_to = \"ground\" }\n";
        [format!("{model}{soil}"), format!("{model}{damped}{soil}")]
    };
    let on_soil = [grounded(&plane), grounded(&space)].concat();
    for model in [vec![plane, space], on_soil].concat() {
        let is_named = |more: &str| {
            let found = assumptions(&format!("{model}{more}"));
            found.iter().any(|text| text.contains("members = true"))
        };
        assert!(is_named(""));
        for asked in ["members = true", "capacity = true", "capacity = false"] {
            assert!(!is_named(&format!("\n[output]\n{asked}\n")), "{asked}");
        }
    }
}
