//! Separation rules of codes and advice on contacts, as a user meets them.

use std::path::Path;

use crate::common::{complained, folder, jostle, printed};
use serde_json::Value;

/// Two elastic shear buildings of three storeys, level floors.
const TOWERS: &str = r#"
[motion]
kind = "sine"
amplitude = "2 m/s2"
period = "0.7 s"
duration = "4 s"
[[building]]
name = "soft"
kind = "shear"
mass = ["40 t", "40 t", "30 t"]
stiffness = ["30 MN/m", "30 MN/m", "20 MN/m"]
storey_height = "3.2 m"
[[building]]
name = "stiff"
kind = "shear"
mass = ["60 t", "60 t", "50 t"]
stiffness = ["90 MN/m", "90 MN/m", "80 MN/m"]
storey_height = "3.2 m"
[[gap]]
between = ["soft", "stiff"]
width = "20 mm"
"#;

fn model(codes: &str) -> tempfile::TempDir {
    let folder = folder();
    let text = format!("{TOWERS}{codes}");
    std::fs::write(folder.path().join("towers.toml"), text).expect("the model is written");
    folder
}

fn good(folder: &Path, arguments: &[&str]) -> String {
    let output = jostle(folder, arguments);
    assert!(output.status.success(), "{}", complained(&output));
    printed(&output)
}

fn json(folder: &Path, arguments: &[&str]) -> Value {
    serde_json::from_str(&good(folder, arguments)).expect("JSON")
}

fn rules_of(found: &Value) -> impl Fn(&str) -> Value + '_ {
    |name| {
        let rules = found["gaps"][0]["rules"].as_array().expect("a list");
        let rule = rules.iter().find(|rule| rule["rule"] == name);
        rule.cloned().unwrap_or(Value::Null)
    }
}

/// Every rule follows from ABS, SRSS and the heights: floors are level, the roofs are 9.6 m high.
#[test]
fn the_gap_command_lists_every_code() {
    let folder = model("[codes]\ndeflection_amplification = 5.5\nresponse_modification = 8\n");
    let found = json(
        folder.path(),
        &["gap", "towers.toml", "--no-outcomes", "--json"],
    );
    let rule = rules_of(&found);
    let width = |name: &str| rule(name)["gap_m"].as_f64().unwrap_or(f64::NAN);
    let (sum, root) = (width("ABS"), width("SRSS"));
    assert!(root > 0.0 && root < sum, "{root} {sum}");
    let near = |name: &str, due: f64| {
        let found = width(name);
        assert!((found - due).abs() < 1e-12, "{name}: {found} for {due}");
    };
    near("EN 1998-1", 0.7 * root);
    near("ASCE 7-16", 5.5 / 8.0 * root);
    near("ASCE 7-16, line", 5.5 / 8.0 * sum);
    near("UBC-97", 0.7 * root);
    near("IS 1893", sum);
    // 9.6 m: 30 mm, and two times 10 mm for 3.6 m above 6 m.
    near("TBDY 2018", (0.25 * root).max(0.05));
    // The sine has 2 m/s².
    near("NTC 2018", sum.max(0.096 * 2.0 * 2.0 / 9.806_65));
    near("E.030-2018", (2.0 / 3.0 * 0.75 * sum).max(0.006 * 9.6));
    near("NSR-10", 0.0);
    near("Standard 2800", 2.0 * 0.005 * 9.6);
    near("GB 50011, intensity 8", 0.1);
    assert_eq!(rule("ASCE 7-16")["inputs"][0], "soft: C_d = 5.5, R = 8");
    assert_eq!(rule("ASCE 7-16")["code"], "asce7");
    let setbacks = &rule("ASCE 7-16, line")["setbacks_m"];
    let both = [0, 1].map(|side| setbacks[side].as_f64().unwrap_or(f64::NAN));
    assert!((both[0] + both[1] - width("ASCE 7-16, line")).abs() < 1e-12);
    let left_out = &found["gaps"][0]["left_out"];
    assert_eq!(left_out[0]["rule"], "E.030-2026");
    assert_eq!(left_out.as_array().map(Vec::len), Some(1));
}

#[test]
fn inputs_of_the_file_change_the_rules_and_are_printed() {
    let folder = model(
        "[codes]\nshow = [\"asce7\", \"e030\"]\ndeflection_amplification = 4\nresponse_modification = 5\nzone_factor = 0.45\nsoil_factor = 1.05\n",
    );
    let text = good(folder.path(), &["gap", "towers.toml", "--no-outcomes"]);
    for due in [
        "ASCE 7-16: soft: C_d = 4, R = 5; stiff: C_d = 4, R = 5",
        "from the property line",
        "E.030-2026: soft: regular (default); stiff: regular (default); Z = 0.45, S = 1.05",
    ] {
        assert!(text.contains(due), "{due} in\n{text}");
    }
    for absent in ["EN 1998-1", "GB 50011", "is left out"] {
        assert!(!text.contains(absent), "{absent} in\n{text}");
    }
    // An option comes before the file.
    let text = good(
        folder.path(),
        &[
            "gap",
            "towers.toml",
            "--no-outcomes",
            "--code",
            "gb50011",
            "--system",
            "steel-frame",
        ],
    );
    // All intensities require the same below 15 m.
    assert!(
        text.contains("GB 50011, every intensity    150 mm"),
        "{text}"
    );
    assert!(!text.contains("ASCE 7-16"), "{text}");
    let reduced = model("[codes]\nmotion = \"reduced\"\nshow = \"en1998\"\n");
    let text = good(reduced.path(), &["gap", "towers.toml", "--no-outcomes"]);
    let due = "EN 1998-1 is left out: it needs behaviour_factor of \"soft\"";
    assert!(text.contains(due), "{text}");
}

#[test]
fn wrong_codes_are_input_errors() {
    let folder = model("[codes]\nshow = \"eurocode\"\n");
    let output = jostle(folder.path(), &["gap", "towers.toml"]);
    assert_eq!(output.status.code(), Some(2));
    assert!(
        complained(&output).contains("towers.toml:"),
        "{}",
        complained(&output)
    );
    let folder = model("");
    let output = jostle(folder.path(), &["gap", "towers.toml", "--code", "eurocode"]);
    assert_eq!(output.status.code(), Some(2));
}

/// The report and the live page read the same list.
#[test]
fn the_report_shows_the_codes() {
    let folder = model(
        "[codes]\nshow = [\"en1998\", \"asce7\"]\ndeflection_amplification = 5.5\nresponse_modification = 8\n",
    );
    good(folder.path(), &["run", "towers.toml", "--out", "out"]);
    let page = std::fs::read_to_string(folder.path().join("out/report.html")).expect("a report");
    for due in [
        "ASCE 7-16, line",
        "EN 1998-1:2004 §4.4.2.7(2)b and (3)",
        "C_d = 5.5, R = 8",
        "Hertz, effective radius",
    ] {
        assert!(page.contains(due), "{due}");
    }
    assert!(!page.contains("TBDY 2018"));
}

/// Shares of heights count from the ground: a storey below the base of the neighbour is a basement.
#[test]
fn basements_are_no_part_of_the_height() {
    let folder = folder();
    let inputs = |elevation: &str| {
        let text = TOWERS.replacen(
            "kind = \"shear\"",
            &format!("kind = \"shear\"\nelevation = \"{elevation}\""),
            1,
        );
        std::fs::write(folder.path().join("base.toml"), text).expect("written");
        let found = json(
            folder.path(),
            &["gap", "base.toml", "--no-outcomes", "--json"],
        );
        rules_of(&found)("NSR-10")["inputs"].to_string()
    };
    for (elevation, storeys) in [("0 m", 3), ("-3.2 m", 2)] {
        let said = inputs(elevation);
        assert!(
            said.contains(&format!("soft: {storeys} storeys above ground")),
            "{said}"
        );
        assert!(said.contains("stiff: 3 storeys above ground"), "{said}");
    }
}

/// One building beside a wall: EN 1998-1 §4.4.2.7(2)a asks for its own displacement, without the 0.7 for level floors, and
/// NSR-10 for 1 % of the height of three storeys beside a neighbour with slabs at any height.
#[test]
fn codes_answer_at_a_property_line() {
    let folder = folder();
    let building = TOWERS
        .split("[[building]]\nname = \"stiff\"")
        .next()
        .expect("one");
    let text = format!("{building}[[gap]]\nbetween = [\"soft\", \"wall\"]\nwidth = \"20 mm\"\n");
    std::fs::write(folder.path().join("line.toml"), text).expect("written");
    let found = json(
        folder.path(),
        &["gap", "line.toml", "--no-outcomes", "--json"],
    );
    let rule = rules_of(&found);
    let width = |name: &str| rule(name)["gap_m"].as_f64().expect(name);
    assert!((width("EN 1998-1") / width("SRSS") - 1.0).abs() < 1e-12);
    assert!((width("NSR-10") - 0.01 * 9.6).abs() < 1e-12);
    assert!(
        rule("EN 1998-1")["source"]
            .as_str()
            .expect("a text")
            .contains("(2)a")
    );
    assert_eq!(rule("0.7 SRSS"), Value::Null);
    let left_out = found["gaps"][0]["left_out"].to_string();
    assert!(
        left_out.contains("no clause for property lines"),
        "{left_out}"
    );
}

/// The terminal, the report and `jostle gap` show the same widths, where floors do not align as well, and only those of the codes
/// that `show` names.
#[test]
fn every_page_shows_the_same_rules() {
    for (name, height, codes) in [
        ("aligned", "3.2 m", ""),
        (
            "aligned and chosen",
            "3.2 m",
            "[codes]\nshow = [\"en1998\", \"ntc2018\"]\n",
        ),
        (
            "between floors",
            "2.9 m",
            "[codes]\nshow = [\"en1998\", \"asce7\", \"ubc97\"]\n",
        ),
    ] {
        let folder = folder();
        let frame = |name: &str, height: &str| {
            format!(
                "[[building]]\nname = \"{name}\"\nkind = \"frame\"\nstoreys = 3\nstorey_height = \"{height}\"\nspans = [\"6 m\"]\n\
                 column = {{ EI = \"1e8 N.m2\", mass = \"500 kg/m\" }}\nbeam = {{ EI = \"2e8 N.m2\" }}\nbeam_mass = \"3000 kg/m\"\n"
            )
        };
        let motion = TOWERS.split("[[building]]").next().expect("a motion");
        let gap = "[[gap]]\nbetween = [\"left\", \"right\"]\nwidth = \"20 mm\"\nfloors = \"all\"\n";
        let text = format!(
            "{motion}{}{}{gap}{codes}",
            frame("left", "3.2 m"),
            frame("right", height)
        );
        std::fs::write(folder.path().join("pair.toml"), text).expect("written");
        let found = json(
            folder.path(),
            &["gap", "pair.toml", "--no-outcomes", "--json"],
        );
        let screen = good(folder.path(), &["run", "pair.toml", "--out", "out"]);
        let screen = screen.replace("\n    ", " ");
        let page =
            std::fs::read_to_string(folder.path().join("out/report.html")).expect("a report");
        let rules = found["gaps"][0]["rules"].as_array().expect("a list");
        let rules: Vec<(&str, f64)> = rules
            .iter()
            .filter(|rule| !rule["code"].is_null())
            .map(|rule| {
                let title = rule["rule"].as_str().expect("a name");
                (title, 1e3 * rule["gap_m"].as_f64().expect("a width"))
            })
            .collect();
        assert!(rules.len() >= 2, "{name}: {rules:?}");
        for (title, _) in &rules {
            // Intensities that require the same share a row.
            let title = title
                .strip_prefix("GB 50011")
                .map_or(*title, |_| "GB 50011");
            assert!(page.contains(title), "{name}: the report lacks {title}");
        }
        if codes.is_empty() {
            // Nobody chose a code: none is singled out.
            assert!(screen.contains("No code selected"), "{name}: {screen}");
            for (title, _) in &rules {
                assert!(!screen.contains(title), "{name}: {title} in\n{screen}");
            }
            continue;
        }
        for (title, width) in &rules {
            let due = format!("{title}: {:.0}", (width - 1e-6).ceil());
            assert!(screen.contains(&due), "{name}: {due} in\n{screen}");
        }
        for code in ["GB 50011", "TBDY 2018"] {
            assert!(!screen.contains(code), "{name}: {screen}");
        }
    }
}

#[test]
fn capacities_without_rules_take_all() {
    let folder = folder();
    let example =
        Path::new(env!("CARGO_MANIFEST_DIR")).join("../../examples/reinforced_frames.toml");
    let text = std::fs::read_to_string(example).expect("an example");
    let text = text.replace("pga = \"0.4 g\"", "pga = \"0.4 g\"\nduration = \"1 s\"");
    std::fs::write(folder.path().join("frames.toml"), text).expect("written");
    let found = json(
        folder.path(),
        &["run", "frames.toml", "--capacity", "--json", "--no-report"],
    );
    assert!(!found["buildings"][0]["capacity"].is_null());
}

#[test]
fn advice_comes_from_a_model_or_from_options() {
    let folder = model("");
    let found = json(
        folder.path(),
        &[
            "contact-advice",
            "towers.toml",
            "--concrete",
            "C30/37",
            "--json",
        ],
    );
    let one = &found["contacts"][0];
    assert_eq!(one["between"][0], "soft");
    // The second floors have 40 and 60 t, as the first; the highest of the heaviest pairs.
    assert_eq!(one["masses_kg"], serde_json::json!([40e3, 60e3]));
    assert_eq!(one["moduli_pa"][0], 33e9);
    assert_eq!(one["wave"], Value::Null);
    let slabs = [
        "--length",
        "12 m, 15 m",
        "--width",
        "10 m",
        "--thickness",
        "150 mm",
    ];
    let arguments = [&["contact-advice", "--mass", "40 t, 60 t"][..], &slabs].concat();
    let text = good(folder.path(), &arguments);
    for due in [
        "left ↔ right: 40.0 t against 60.0 t at 0.4 m/s",
        "waves, same peak force",
        "law = \"hertz-damp\"",
        "law = \"kelvin-no-tension\"",
        "jostle run --sensitivity",
        "E = 30 GPa is assumed",
    ] {
        assert!(text.contains(due), "{due} in\n{text}");
    }
    // What is recommended can be pasted into the gap.
    let lines: Vec<&str> = text
        .lines()
        .skip_while(|line| !line.starts_with("Recommended"))
        .skip(2)
        .take(4)
        .collect();
    let pasted = format!("{TOWERS}{}\n", lines.join("\n"));
    std::fs::write(folder.path().join("pasted.toml"), pasted).expect("the model is written");
    good(folder.path(), &["check", "pasted.toml"]);
}

#[test]
fn wrong_advice_options_are_input_errors() {
    let folder = model("");
    for (arguments, due) in [
        (&["contact-advice"][..], "--mass: is missing"),
        (&["contact-advice", "--mass", "40"], ""),
        (
            &["contact-advice", "--mass", "40 t", "--length", "12 m"],
            "give all three",
        ),
        (
            &["contact-advice", "--mass", "40 t", "--concrete", "f'c = 4"],
            "has no unit",
        ),
        (&["contact-advice", "nowhere.toml"], "nowhere.toml"),
    ] {
        let output = jostle(folder.path(), arguments);
        if due.is_empty() {
            // A bare number is in SI.
            assert!(output.status.success());
            continue;
        }
        assert_eq!(output.status.code(), Some(2), "{arguments:?}");
        assert!(
            complained(&output).contains(due),
            "{arguments:?}: {}",
            complained(&output)
        );
    }
}

#[test]
fn sections_take_the_names_of_codes() {
    let folder = folder();
    let section = |concrete: &str, steel: &str| {
        jostle(
            folder.path(),
            &[
                "section",
                "--width",
                "300mm",
                "--depth",
                "600mm",
                "--concrete",
                concrete,
                "--steel",
                steel,
                "--bars",
                "4 d25 top, 4 d25 bottom",
                "--json",
            ],
        )
    };
    for (concrete, steel) in [
        ("C30/37", "B500"),
        ("f'c = 4 ksi", "Grade 60"),
        ("C30", "HRB400"),
    ] {
        let output = section(concrete, steel);
        assert!(output.status.success(), "{}", complained(&output));
    }
    let output = section("C30/35", "B500");
    assert_eq!(output.status.code(), Some(2));
    assert!(complained(&output).contains("--concrete: \"C30/35\" is not known"));
}
