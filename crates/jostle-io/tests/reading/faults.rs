//! What a user sees when a model file is wrong: every fault, with its line and what to do.

use std::path::Path;

use jostle_io::{Format, Input, read_model_text};
use jostle_testkit::files::refusal;

fn read(text: &str, format: Format) -> Result<Input, jostle_io::InputError> {
    read_model_text("model.toml", text, format, Path::new(""))
}

/// Asserts that a text has exactly one fault, whose first line is as given.
fn assert_single(text: &str, wanted: &str) {
    let shown = refusal(text);
    assert_eq!(shown.lines().next(), Some(wanted), "in\n{shown}");
    assert!(
        shown.ends_with("1 fault in model.toml"),
        "only one fault in\n{shown}"
    );
}

const SHEAR: &str = r#"
[[building]]
name = "A"
kind = "shear"
storey_height = "3 m"
mass = ["40 t", "40 t"]
stiffness = "60 MN/m"
"#;

const FRAME: &str = r#"
[[building]]
name = "B"
storeys = 2
storey_height = "3 m"
spans = ["6 m"]
column = { width = "500 mm", depth = "500 mm" }
beam = { width = "300 mm", depth = "600 mm" }
concrete = "C30"
beam_mass = "3600 kg/m"
"#;

const GAP: &str = r#"
[[gap]]
between = ["A", "B"]
width = "20 mm"
"#;

#[test]
fn plain_model_is_accepted() {
    read(&format!("{SHEAR}{FRAME}{GAP}"), Format::Toml).unwrap_or_else(|error| panic!("{error}"));
}

#[test]
fn all_faults_come_at_once_with_their_lines() {
    let text = r#"titel = "Two houses"

[motion]
record = "el-centro-1940-ns"
pga = "220 cm"

[[building]]
name = "A"
storeys = 5
storey_height = "3.2 kg"
spans = ["2.4 m", "-6 m"]
column = { width = "500 mm", hight = "500 mm", depth = "500 mm" }
beam = [{ width = "300 mm", depth = "600 mm" }, { EI = 1e8 }]
concrete = "C33"
beam_mass = "25 kN/m"
hinges = { rule = "norml", column = { yield = "400 kN" } }

[[building]]
name = "B"
kind = "shear"
mass = ["40 t", "40 t"]
stiffness = "60 MN/m"

[[gap]]
between = ["B", "A"]
law = "yea"
"#;
    let wanted = r#"model.toml:1:1: titel: unknown key "titel"
  1 | titel = "Two houses"
    | ^^^^^
  help: did you mean "title"?

model.toml:5:7: motion.pga: expected an acceleration (such as "220 cm/s2"), found "220 cm"
  5 | pga = "220 cm"
    |       ^^^^^^^^

model.toml:10:17: building[0].storey_height: expected a length (such as "3.2 m"), found "3.2 kg"
  10 | storey_height = "3.2 kg"
     |                 ^^^^^^^^

model.toml:11:19: building[0].spans[1]: must be greater than zero, found -6 m
  11 | spans = ["2.4 m", "-6 m"]
     |                   ^^^^^^

model.toml:12:30: building[0].column.hight: unknown key "hight"
  12 | column = { width = "500 mm", hight = "500 mm", depth = "500 mm" }
     |                              ^^^^^
  help: known here: width, depth, profile, axis, yield_strength, EI, EA, GA, mass, line, storeys, omit, concrete, steel, strength, bars, cover, ties, axial_load

model.toml:13:8: building[0].beam: has 2 entries for 5 storeys; give one value, or one per storey from the ground up
  13 | beam = [{ width = "300 mm", depth = "600 mm" }, { EI = 1e8 }]
     |        ^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^

model.toml:14:12: building[0].concrete: "C33" is not known; available: C20, C25, C30, C35, C40, C45, C50, C55, C60, C65, C70, C75, C80, C12/15, C16/20, C20/25, C25/30, C30/37, C35/45, C40/50, C45/55, C50/60, C55/67, C60/75, C70/85, C80/95, C90/105
  14 | concrete = "C33"
     |            ^^^^^
  help: did you mean "C30"? Or a cylinder strength is written "f'c = 4 ksi"

model.toml:16:19: building[0].hinges.rule: "norml" is not known; available: normal, peak-oriented, takeda, d-tri, pinched, bilinear, elastic
  16 | hinges = { rule = "norml", column = { yield = "400 kN" } }
     |                   ^^^^^^^
  help: did you mean "normal"?

model.toml:16:47: building[0].hinges.column.yield: expected a moment (such as "400 kN.m"), found "400 kN"
  16 | hinges = { rule = "norml", column = { yield = "400 kN" } }
     |                                               ^^^^^^^^

model.toml:24:1: gap[0].width: is missing
  24 | [[gap]]
     | ^^^^^^^
  help: add width = "100 mm"

model.toml:25:11: gap[0].between: names the right neighbour first
  25 | between = ["B", "A"]
     |           ^^^^^^^^^^
  help: the buildings stand, from left to right: "A", "B"

model.toml:26:7: gap[0].law: "yea" is not known; available: linear, kelvin, kelvin-no-tension, modified-kelvin, hertz, hertz-damp, ye, jankowski, bilinear, restitution, rubber, formula
  26 | law = "yea"
     |       ^^^^^
  help: did you mean "ye"?

12 faults in model.toml"#;
    assert_eq!(refusal(text), wanted);
}

#[test]
fn faults_of_the_model_point_at_the_file() {
    let text = format!(
        "{SHEAR}damping = {{ ratio = 5, modes = [2, 1] }}\n{FRAME}{GAP}restitution = 1.5\n"
    );
    let wanted = r#"model.toml:8:21: building[0].damping.ratio: must lie between 0 and 1 (0.05 is 5 % of critical), found 5
  8 | damping = { ratio = 5, modes = [2, 1] }
    |                     ^

model.toml:8:32: building[0].damping.modes: takes one lateral mode, or two different ones in rising order, counted from 1; found [2, 1]
  8 | damping = { ratio = 5, modes = [2, 1] }
    |                                ^^^^^^

model.toml:23:15: gap[0].restitution: must be greater than 0 and at most 1, found 1.5
  23 | restitution = 1.5
     |               ^^^

3 faults in model.toml"#;
    assert_eq!(refusal(&text), wanted);
}

#[test]
fn one_value_for_all_storeys_is_one_fault() {
    let text = SHEAR.replace("\"60 MN/m\"", "\"-60 MN/m\"");
    assert_single(
        &text,
        "model.toml:7:13: building[0].stiffness: must be greater than zero, found -60000000 N/m",
    );
}

#[test]
fn syntax_errors_have_line_and_column() {
    let text = "title = \"x\n[motion\nrecord = \"el-centro\"\n";
    let wanted = r#"model.toml:1:11: invalid basic string, expected `"`
  1 | title = "x
    |           ^

model.toml:2:8: unclosed table, expected `]`
  2 | [motion
    |        ^

2 faults in model.toml"#;
    assert_eq!(refusal(text), wanted);
}

#[test]
fn json_gives_the_same_model_and_the_same_faults() {
    let text = r#"{ "building": [ { "name": "A", "kind": "shear", "storey_height": "3 m",
  "mass": ["40 t", "40 t"], "stiffness": "60 MN/m" } ] }"#;
    let json = read(text, Format::Json).unwrap_or_else(|error| panic!("{error}"));
    let toml = read(SHEAR, Format::Toml).unwrap_or_else(|error| panic!("{error}"));
    assert_eq!(json.model, toml.model);

    let wrong = text.replace("60 MN/m", "60 MN");
    let error = read(&wrong, Format::Json)
        .expect_err("a force is no stiffness")
        .to_string();
    assert!(
        error.starts_with("model.toml:2:42: building[0].stiffness: expected a stiffness (such as \"60 MN/m\"), found \"60 MN\"\n"),
        "{error}"
    );
    for (wrong, wanted) in [
        (
            text.replace("] }", "], }"),
            "model.toml:2:55: trailing commas are not allowed",
        ),
        (
            text.replace("\"name\"", "\"kind\""),
            "model.toml:1:32: the key \"kind\" appears here twice",
        ),
        (
            "[]".into(),
            "model.toml:1:1: a model file must be an object: { \"building\": [ … ] }",
        ),
        (
            String::new(),
            "model.toml:1:1: a model file must be an object: { \"building\": [ … ] }",
        ),
    ] {
        let shown = read(&wrong, Format::Json)
            .expect_err("broken JSON")
            .to_string();
        assert_eq!(shown.lines().next(), Some(wanted), "in\n{shown}");
    }
}

#[test]
fn neighbours_must_exist_and_touch() {
    let third = SHEAR.replace("\"A\"", "\"C\"");
    let gap = |names: &str| format!("{SHEAR}{FRAME}{third}[[gap]]\nbetween = {names}\nwidth = 0\n");
    assert_single(
        &gap("[\"A\", \"b\"]"),
        "model.toml:26:17: gap[0].between[1]: there is no building \"b\"",
    );
    assert_single(
        &gap("[\"A\", \"C\"]"),
        "model.toml:26:11: gap[0].between: names two buildings that are not neighbours",
    );
    assert_single(
        &gap("\"A-B\""),
        "model.toml:26:11: gap[0].between: expected the names of two neighbours, such as [\"A\", \"B\"]",
    );
    let shown = refusal(&gap("[\"A\", \"C\"]"));
    assert!(
        shown.contains("the buildings stand, from left to right: \"A\", \"B\", \"C\""),
        "the order is told:\n{shown}"
    );
}

#[test]
fn walls_stand_at_the_ends_of_the_row() {
    let gap = |names: &str| format!("{SHEAR}{FRAME}[[gap]]\nbetween = {names}\nwidth = 0\n");
    for good in ["[\"wall\", \"A\"]", "[\"B\", \"wall\"]"] {
        read(&gap(good), Format::Toml).unwrap_or_else(|error| panic!("{error}"));
    }
    for (names, problem) in [
        (
            "[\"wall\", \"B\"]",
            "puts a wall left of a building that is not the first",
        ),
        (
            "[\"A\", \"wall\"]",
            "puts a wall right of a building that is not the last",
        ),
        ("[\"wall\", \"wall\"]", "names no building"),
    ] {
        assert_single(
            &gap(names),
            &format!("model.toml:19:11: gap[0].between: {problem}"),
        );
    }
    assert_single(
        &gap("[\"wal\", \"A\"]"),
        "model.toml:19:12: gap[0].between[0]: there is no building \"wal\"",
    );
    assert!(refusal(&gap("[\"wal\", \"A\"]")).contains("did you mean \"wall\"?"));
}

#[test]
fn remedies_for_unequal_floors_work() {
    let shear = |name: &str, height: &str| {
        format!(
            "[[building]]\nname = \"{name}\"\nkind = \"shear\"\nmass = [\"40 t\", \"40 t\"]\nstiffness = [\"60 MN/m\", \"60 MN/m\"]\nstorey_height = \"{height}\"\n"
        )
    };
    let gap =
        |names: &str, rest: &str| format!("[[gap]]\nbetween = {names}\nwidth = 0.01\n{rest}\n");
    let taller = FRAME.replace("\"3 m\"", "\"3.6 m\"");
    assert_ne!(taller, FRAME);
    let refused = |buildings: &str, names: &str, rest: &str, remedy: &str| {
        let text = refusal(&format!("{buildings}{}", gap(names, rest)));
        assert!(text.contains(remedy), "{text}");
    };
    let accepted = |buildings: &str, names: &str, rest: &str| {
        let text = format!("{buildings}{}", gap(names, rest));
        read(&text, Format::Toml).unwrap_or_else(|error| panic!("{rest}: {error}"));
    };
    let left = format!("{}{taller}", shear("A", "3.3 m"));
    for rest in ["", "floors = \"all\""] {
        refused(
            &left,
            "[\"A\", \"B\"]",
            rest,
            "floors of \"A\" can hit columns of \"B\": list the pairs, as floors = [[1, \"3.300 m\"], …]; or describe \"A\" as a frame",
        );
    }
    accepted(&left, "[\"A\", \"B\"]", "floors = [[1, \"3.300 m\"]]");
    let right = format!("{taller}{}", shear("C", "3.3 m"));
    refused(
        &right,
        "[\"B\", \"C\"]",
        "",
        "as floors = [[\"3.300 m\", 1], …]",
    );
    accepted(&right, "[\"B\", \"C\"]", "floors = [[\"3.300 m\", 1]]");
    let frames = format!("{taller}{}", FRAME.replace("\"B\"", "\"C\""));
    refused(
        &frames,
        "[\"B\", \"C\"]",
        "",
        "write floors = \"all\" for floors against columns, list the pairs that can touch, as floors = [[1, \"3.600 m\"], …], or raise",
    );
    accepted(&frames, "[\"B\", \"C\"]", "floors = \"all\"");
    accepted(&frames, "[\"B\", \"C\"]", "floors = [[1, \"3.600 m\"]]");
    // A tolerance equal to the difference counts, although 3.6 − 3.3 is a little more than 0.3 in binary numbers.
    let shears = format!("{}{}", shear("A", "3.3 m"), shear("C", "3.6 m"));
    let names = "[\"A\", \"C\"]";
    refused(
        &shears,
        names,
        "",
        "shear buildings and given ones have no columns to hit: raise level_tolerance",
    );
    refused(
        &shears,
        names,
        "level_tolerance = \"299 mm\"",
        "equal height",
    );
    accepted(&shears, names, "level_tolerance = \"300 mm\"");
    accepted(
        &shears,
        names,
        "level_tolerance = \"300 mm\"\nfloors = [[1, 1]]",
    );
}

#[test]
fn points_and_widths_of_a_gap_are_checked_one_by_one() {
    let gap = |rest: &str| format!("{SHEAR}{FRAME}[[gap]]\nbetween = [\"A\", \"B\"]\n{rest}\n");
    for good in [
        "width = \"1 cm\"\nfloors = \"all\"\nlevel_tolerance = \"20 cm\"",
        "width = [\"1 cm\", \"2 m\"]",
        "width = [0.01, 0.02]\nfloors = [[2, \"6 m\"], [1, 1]]",
    ] {
        read(&gap(good), Format::Toml).unwrap_or_else(|error| panic!("{error}"));
    }
    for (bad, shown) in [
        (
            "width = [0.01, 0.02, 0.03]",
            "20:9: gap[0].width: has 3 entries for 2 contacts",
        ),
        (
            "width = [0.01, \"3 kg\"]",
            "20:16: gap[0].width[1]: expected a length",
        ),
        (
            "width = 0\nfloors = [[1, \"4 m\"]]",
            "21:11: gap[0].floors[0]: floor 1 of \"A\" is at 3.000 m and the point of \"B\" is at 4.000 m",
        ),
        (
            "width = 0\nfloors = [[\"4 m\", \"4 m\"]]",
            "21:11: gap[0].floors[0]: \"A\" has no floor at 4.000 m (nearest: 3.000 m), and no columns that can be hit between floors",
        ),
        (
            "width = 0\nfloors = [[\"wall\", 1]]",
            "21:11: gap[0].floors[0]: names the wall where \"A\" stands",
        ),
        (
            "width = 0\nfloors = \"none\"",
            "21:10: gap[0].floors: expected \"common\", \"all\"",
        ),
        (
            "width = 0\nlevel_tolerance = 0",
            "21:19: gap[0].level_tolerance: must be greater than zero",
        ),
    ] {
        let shown = format!("model.toml:{shown}");
        let text = refusal(&gap(bad));
        assert!(text.contains(&shown), "{bad}: {text}");
    }
}

#[test]
fn links_are_checked_as_gaps_are() {
    let link = |rest: &str| format!("{SHEAR}{FRAME}[[link]]\nbetween = [\"A\", \"B\"]\n{rest}\n");
    let good = read(
        &link("damping = \"500 kN.s/m\"\nfloors = [[2, 2]]"),
        Format::Toml,
    )
    .unwrap_or_else(|error| panic!("{error}"));
    let [found] = &good.model.links[..] else {
        panic!("one link")
    };
    assert_eq!((found.stiffness, found.damping), (0.0, 5e5));
    for (bad, shown) in [
        ("", "18:1: link[0].damping: is missing"),
        (
            "stiffness = \"1 kN\"",
            "20:13: link[0].stiffness: expected a stiffness",
        ),
        (
            "damping = -1",
            "20:11: link[0].damping: must not be negative, found -1 N.s/m",
        ),
        (
            "damping = 1\nfloors = [[3, 3]]",
            "21:11: link[0].floors[0]: floor 3 does not exist",
        ),
        (
            "damping = 1\nwidth = 0",
            "21:1: link[0].width: unknown key \"width\"",
        ),
    ] {
        let shown = format!("model.toml:{shown}");
        let text = refusal(&link(bad));
        assert!(text.contains(&shown), "{bad}: {text}");
    }
}

#[test]
fn contact_stiffness_must_suit_the_law() {
    let gap = |rest: &str| format!("{SHEAR}{FRAME}{GAP}{rest}\n");
    assert_single(
        &gap("stiffness = \"60 MN/m\""),
        "model.toml:22:13: gap[0].stiffness: expected a Hertz contact stiffness (such as \"2e9 N/m^1.5\"), found \"60 MN/m\"",
    );
    assert_single(
        &gap("law = \"linear\""),
        "model.toml:19:1: gap[0].stiffness: is missing",
    );
    assert_single(
        &gap("law = \"hertz_damp\""),
        "model.toml:22:7: gap[0].law: \"hertz_damp\" is not known; available: linear, kelvin, kelvin-no-tension, modified-kelvin, hertz, hertz-damp, ye, jankowski, bilinear, restitution, rubber, formula",
    );
}

#[test]
fn sections_by_rigidity_need_a_mass() {
    let column =
        |section: &str| FRAME.replace("{ width = \"500 mm\", depth = \"500 mm\" }", section);
    assert_single(
        &column("{ EI = \"150 MN.m2\" }"),
        "model.toml:7:10: building[0].column.mass: is missing",
    );
    assert_single(
        &column("{ EI = \"150 MN.m2\", width = \"1 m\", mass = 0 }"),
        "model.toml:7:10: building[0].column: has both a size and rigidities",
    );
    for good in [
        "{ EI = \"150 MN.m2\", mass = \"1500 kg/m\" }",
        "{ EI = \"150 MN.m2\", EA = \"7500 MN\" }",
    ] {
        read(&column(good), Format::Toml).unwrap_or_else(|error| panic!("{error}"));
    }
    assert_single(
        &FRAME
            .replace("concrete = \"C30\"\n", "")
            .replace("beam = {", "beam = { EI = 1e8 } #"),
        "model.toml:7:10: building[0].column: needs a modulus of elasticity",
    );
}

#[test]
fn a_misspelt_kind_is_one_fault() {
    assert_single(
        &SHEAR.replace("\"shear\"", "\"sheer\""),
        "model.toml:4:8: building[0].kind: \"sheer\" is not known; available: frame, shear, space-frame, given",
    );
    assert_single(
        &SHEAR.replace("kind = \"shear\"\n", ""),
        "model.toml:2:1: building[0].kind: is missing",
    );
}

#[test]
fn sizes_are_limited() {
    assert_single(
        &FRAME.replace("storeys = 2", "storeys = 1000000000"),
        "model.toml:4:11: building[0].storeys: must lie between 1 and 200, found 1000000000",
    );
    assert_single(
        &FRAME.replace("[\"6 m\"]", &format!("{:?}", vec![6.0; 51])),
        "model.toml:6:9: building[0].spans: at most 50 spans are possible, found 51",
    );
    assert_single(
        &FRAME.replace("\"3 m\"", "1e300"),
        "model.toml:5:17: building[0].storey_height: expected a length (such as \"3.2 m\"), found \"1e300\", which is not a usable number",
    );
}

#[test]
fn motion_faults_are_explained() {
    let motion = |keys: &str| format!("{SHEAR}[motion]\n{keys}\n");
    assert_single(
        &motion("record = \"el-centro\"\npga = 1\nscale = 2"),
        "model.toml:11:9: motion.scale: cannot be combined with pga",
    );
    assert_single(
        &motion("kind = \"sine\"\nperiod = \"1 s\"\nduration = \"8 s\""),
        "model.toml:8:1: motion.amplitude: is missing",
    );
    assert_single(
        &motion("pga = 1"),
        "model.toml:8:1: motion.record: is missing",
    );

    let input = read(&motion("record = \"el-zentro-1940-ns\""), Format::Toml)
        .unwrap_or_else(|error| panic!("{error}"));
    let wanted = r#"model.toml:9:10: motion.record: there is no record "el-zentro-1940-ns" in the current folder (did you mean "el-centro-1940-ns"?); built-in records: el-centro-1940-ns, nanjing-artificial
  9 | record = "el-zentro-1940-ns"
    |          ^^^^^^^^^^^^^^^^^^^

1 fault in model.toml"#;
    let error = input.ground_motion().expect_err("there is no such record");
    assert_eq!(error.to_string(), wanted);

    // Paths of Windows: `\r` and `\n` are escapes, `\d` is none.
    let input = read(&motion(r#"record = "C:\records\new.at2""#), Format::Toml)
        .unwrap_or_else(|error| panic!("{error}"));
    let error = input.ground_motion().expect_err("there is no such record");
    let told = error.to_string();
    let remedy = "a backslash inside \"…\" starts an escape; in a path write / instead";
    assert!(
        told.contains(r#"there is no record "C:\records\new.at2""#),
        "{told}"
    );
    assert!(told.contains(remedy), "{told}");
    let told = refusal(&motion(r#"record = "C:\dir\a.at2""#));
    assert!(told.starts_with("model.toml:9:"), "{told}");
    assert!(told.contains(remedy), "{told}");

    let still = read(SHEAR, Format::Toml).unwrap_or_else(|error| panic!("{error}"));
    let error = still.ground_motion().expect_err("there is no motion");
    assert_eq!(
        error.to_string(),
        "model.toml: motion: the model has no ground motion; add [motion] with a record, such as \"el-centro-1940-ns\"\n\n1 fault in model.toml"
    );
}

#[test]
fn long_lines_are_cut_around_the_fault() {
    let text = format!("title = \"{}\"; x", "ä".repeat(500));
    let shown = refusal(&text);
    assert!(
        shown.lines().all(|line| line.chars().count() < 140),
        "{shown}"
    );
    let lines: Vec<&str> = shown.lines().collect();
    let caret = lines[2].chars().position(|c| c == '^').expect("a caret");
    assert_eq!(
        lines[1].chars().nth(caret),
        Some(';'),
        "the caret stands below the fault:\n{shown}"
    );
}

#[test]
fn text_that_is_not_utf_8_is_refused() {
    let folder = std::env::temp_dir().join(format!("jostle-io-{}", std::process::id()));
    std::fs::create_dir_all(&folder).expect("a folder");
    let path = folder.join("latin.toml");
    std::fs::write(&path, b"title = \"x\"\nname = \"Stra\xdfe\"\n").expect("a file");
    let shown = jostle_io::read_model_file(&path)
        .expect_err("not UTF-8")
        .to_string();
    assert!(
        shown.contains("the text is not UTF-8 (first seen in line 2)"),
        "{shown}"
    );
    std::fs::write(
        &path,
        [b"\xef\xbb\xbf".as_slice(), SHEAR.as_bytes()].concat(),
    )
    .expect("a file");
    jostle_io::read_model_file(&path).unwrap_or_else(|error| panic!("{error}"));
    std::fs::remove_dir_all(&folder).expect("the folder is ours");
}

#[test]
fn hundreds_of_faults_are_counted() {
    let text: String = (0..700).map(|i| format!("key{i} = 1\n")).collect();
    let shown = refusal(&text);
    assert!(
        shown.ends_with("… and 201 more\n701 faults in model.toml"),
        "{}",
        &shown[shown.len() - 200..]
    );
}

#[test]
fn single_values_make_one_floor_and_say_so() {
    let text = "title = \"t\"\n[motion]\nrecord = \"el-centro\"\n[[building]]\nname = \"a\"\nkind = \"shear\"\nmass = \"75 t\"\nstiffness = \"2 MN/m\"\nstorey_height = \"3 m\"\n";
    let input =
        read_model_text("m.toml", text, Format::Toml, Path::new("")).expect("a valid model");
    assert_eq!(input.model.buildings[0].floors(), 1);
    assert!(
        input
            .warnings
            .iter()
            .any(|warning| warning.contains("has one floor")),
        "{:?}",
        input.warnings
    );
}

#[test]
fn parameters_belong_to_their_law() {
    let model = |gap: &str| {
        format!(
            "[[building]]\nname = \"A\"\nkind = \"shear\"\nmass = [\"40 t\"]\nstiffness = [\"60 MN/m\"]\n\
             [[building]]\nname = \"B\"\nkind = \"shear\"\nmass = [\"40 t\"]\nstiffness = [\"20 MN/m\"]\n\
             [[gap]]\nbetween = [\"A\", \"B\"]\nwidth = \"10 mm\"\n{gap}\n"
        )
    };
    let read = |gap: &str| read_model_text("model.toml", &model(gap), Format::Toml, "".as_ref());
    for gap in [
        "law = \"modified-kelvin\"\nstiffness = \"90 MN/m\"\nvariant = \"mahmoud-jankowski\"",
        "law = \"bilinear\"\nyield_share = 0.2\ndesign_speed = \"0.5 m/s\"",
        "law = \"rubber\"\nstiffness = \"30 MN/m\"\nthickness = \"60 mm\"\nexponent = 2",
        "law = \"restitution\"\nrestitution = 0.4\nminimum_separation = \"20 ms\"",
        "law = \"jankowski\"",
        "law = \"ye\"",
        "law = \"kelvin\"\nstiffness = \"90 MN/m\"\ndamping = \"1.1 MN.s/m\"",
        "law = \"kelvin-no-tension\"\nstiffness = \"90 MN/m\"\ndamping = 0",
        "law = \"modified-kelvin\"\nvariant = \"mahmoud-jankowski\"\nstiffness = \"90 MN/m\"\ndamping = \"200 kN.s/m\"",
        "law = \"bilinear\"\nstiffness = \"400 MN/m\"\nsecond_stiffness = \"120 MN/m\"\nyield = \"1.5 mm\"",
        "law = \"linear\"\nstiffness = \"200 MN/m\"\ncrush = { force = \"600 kN\", hardening = 0.05 }",
        "law = \"linear\"\nstiffness = \"200 MN/m\"\ncrush = { force = \"600 kN\" }",
        "law = \"hertz\"\nstiffness = \"2e9 N/m^1.5\"\ncrush = { force = \"600 kN\", hardening = 0.05 }",
    ] {
        if let Err(error) = read(gap) {
            panic!("{gap}: {error}");
        }
    }
    for (gap, expected) in [
        (
            "law = \"hertz\"\nthickness = \"60 mm\"",
            "gap[0].thickness: belongs to the law rubber, not to hertz",
        ),
        (
            "law = \"rubber\"\nstiffness = \"30 MN/m\"",
            "gap[0].thickness: is missing",
        ),
        (
            "law = \"bilinear\"\nyield_share = 0.7",
            "gap[0].yield_share: must lie between 0 and 0.5, found 0.7",
        ),
        (
            "law = \"bilinear\"\nrestitution = 0.1\nrestitution_is = \"realised\"",
            "cannot be realised by bilinear below 0.2294",
        ),
        (
            "law = \"modified-kelvin\"\nstiffness = \"90 MN/m\"\nvariant = \"me\"",
            "gap[0].variant: \"me\" is not known; available: ye, mahmoud-jankowski",
        ),
        (
            "law = \"kelvin\"\nstiffness = \"90 MN/m\"\ndamping = \"1 MN.s/m\"\nrestitution = 0.6",
            "gap[0].restitution: cannot be combined with damping",
        ),
        (
            "law = \"kelvin\"\nstiffness = \"90 MN/m\"\ndamping = \"1 MN.s/m\"\nrestitution_is = \"realised\"",
            "gap[0].restitution_is: cannot be combined with damping",
        ),
        (
            "law = \"kelvin\"\nstiffness = \"90 MN/m\"\ndamping = \"-1 MN.s/m\"",
            "gap[0].damping: must not be negative, found -1000000 N.s/m",
        ),
        (
            "law = \"hertz-damp\"\ndamping = \"1 MN.s/m\"",
            "gap[0].damping: belongs to the law kelvin, kelvin-no-tension and modified-kelvin with variant = \"mahmoud-jankowski\", not to hertz-damp",
        ),
        (
            "law = \"modified-kelvin\"\nstiffness = \"90 MN/m\"\ndamping = \"1 MN.s/m\"",
            "not to modified-kelvin (ye)",
        ),
        (
            "law = \"bilinear\"\nstiffness = \"400 MN/m\"\nsecond_stiffness = \"400 MN/m\"\nyield = \"1.5 mm\"",
            "gap[0].second_stiffness: must be less than stiffness, 400000000 N/m, found 400000000 N/m; a contact that does not yield is law = \"linear\"",
        ),
        (
            "law = \"bilinear\"\nstiffness = \"400 MN/m\"\nsecond_stiffness = \"120 MN/m\"\nyield = 0",
            "gap[0].yield: must be greater than zero, found 0 m",
        ),
        (
            "law = \"bilinear\"\nstiffness = \"400 MN/m\"\nsecond_stiffness = \"120 MN/m\"",
            "gap[0].yield: is missing",
        ),
        (
            "law = \"bilinear\"\nstiffness = \"400 MN/m\"\nyield = \"1.5 mm\"",
            "gap[0].second_stiffness: is missing",
        ),
        (
            "law = \"bilinear\"\nsecond_stiffness = \"120 MN/m\"\nyield = \"1.5 mm\"",
            "gap[0].stiffness: is missing",
        ),
        (
            "law = \"bilinear\"\nstiffness = \"400 MN/m\"\nsecond_stiffness = \"120 MN/m\"\nyield = \"1.5 mm\"\nyield_share = 0.1",
            "gap[0].yield_share: cannot be combined with second_stiffness and yield",
        ),
        (
            "law = \"bilinear\"\nstiffness = \"400 MN/m\"\nsecond_stiffness = \"120 MN/m\"\nyield = \"1.5 mm\"\nrestitution = 0.6",
            "gap[0].restitution: cannot be combined with second_stiffness and yield",
        ),
        (
            "law = \"kelvin\"\nstiffness = \"400 MN/m\"\nyield = \"1.5 mm\"",
            "gap[0].yield: belongs to the law bilinear, not to kelvin",
        ),
        (
            "law = \"formula\"\nstiffness = 2e9",
            "gap[0].formula: is missing",
        ),
        (
            "law = \"formula\"\nstiffness = 2e9\nformula = \"k*d*(1 + rate)\"",
            "gap[0].formula: \"rate\" is no name of a formula; use d, v, v0, k, e or m",
        ),
        (
            "law = \"formula\"\nstiffness = \"90 MN/m\"\nformula = \"k*d*(1 - v/v0)\"",
            "gap[0].formula: \"k*d*(1 - v/v0)\" must not fall as v grows",
        ),
        (
            "law = \"formula\"\nformula = \"k*d*(1 + 0.5*v/v0)\"",
            "gap[0].stiffness: is missing",
        ),
        (
            "law = \"formula\"\nstiffness = \"90 MN/m\"\nformula = \"k*d^1.5*(1 + 0.5*v/v0)\"",
            "gap[0].stiffness: expected a Hertz contact stiffness",
        ),
        (
            "law = \"formula\"\nstiffness = \"90 MN/m\"\nrestitution = 0.6\nformula = \"k*d\"",
            "gap[0].restitution: cannot be combined with a formula without e",
        ),
        (
            "law = \"kelvin\"\nstiffness = \"90 MN/m\"\nformula = \"k*d\"",
            "gap[0].formula: belongs to the law formula, not to kelvin",
        ),
        (
            "law = \"hertz-damp\"\ncrush = { force = \"600 kN\" }",
            "gap[0].crush: belongs to the law linear and hertz, not to hertz-damp",
        ),
        (
            "law = \"linear\"\nstiffness = \"200 MN/m\"\ncrush = { hardening = 0.05 }",
            "gap[0].crush.force: is missing",
        ),
        (
            "law = \"linear\"\nstiffness = \"200 MN/m\"\ncrush = { force = 0 }",
            "gap[0].crush.force: must be greater than zero, found 0 N",
        ),
        (
            "law = \"hertz\"\nstiffness = \"2e9 N/m^1.5\"\ncrush = { force = \"600 kN\", hardening = 0.7 }",
            "gap[0].crush.hardening: must be at least 0 and below 2/3 for the law hertz, found 0.7; it is the stiffness while crushing over that where the face begins to crush",
        ),
        (
            "law = \"linear\"\nstiffness = \"200 MN/m\"\ncrush = { force = \"600 kN\", hardening = 1 }",
            "gap[0].crush.hardening: must be at least 0 and below 1, found 1; it is the stiffness while crushing over the contact stiffness",
        ),
        (
            "law = \"linear\"\nstiffness = \"200 MN/m\"\ncrush = { force = \"600 kN\" }\nrestitution = 0.6",
            "gap[0].restitution: cannot be combined with crush",
        ),
        (
            "law = \"linear\"\nstiffness = \"200 MN/m\"\ncrush = \"600 kN\"",
            "gap[0].crush: expected a table such as { force = … }",
        ),
        (
            "law = \"hertz\"\nminimum_separation = \"-1 s\"",
            "gap[0].minimum_separation: must not be negative, found -1 s",
        ),
    ] {
        let error = read(gap).err().map(|error| error.to_string());
        assert!(
            error.as_ref().is_some_and(|text| text.contains(expected)),
            "{gap}: {error:?}"
        );
    }
}

/// What other programs have between floors is named where it is missed.
#[test]
fn braces_and_infills_of_storeys_are_dampers_without_dashpot() {
    for key in ["brace", "infill", "wall"] {
        let shown = refusal(&format!("{SHEAR}{key} = {{ stiffness = \"80 MN/m\" }}\n"));
        assert!(shown.contains("[[building.damper]]"), "{shown}");
        assert!(!shown.contains("did you mean"), "{shown}");
    }
}

/// A list of tables cannot follow a single one of the same name.
#[test]
fn single_tables_and_lists_of_one_name_exclude_each_other() {
    let text = "[[building]]\nname = \"A\"\ncolumn = { width = 0.5, depth = 0.5 }\n[[building.column]]\nline = 1\nomit = true\n";
    let shown = refusal(text);
    assert!(
        shown.contains("duplicate key: write the first one as a table in double brackets too"),
        "{shown}"
    );
}

/// Keys of the building after a header of one of its tables say where they belong.
#[test]
fn keys_of_the_building_below_a_header_are_sent_back() {
    let frame = "[[building]]\nname = \"A\"\nstoreys = 2\nstorey_height = 3\nspans = [5]\ncolumn = { width = 0.4, depth = 0.4 }\nbeam = { width = 0.3, depth = 0.5 }\nelastic_modulus = 3e10\nfloor_mass = 3e4\n[[building.infill]]\nmodulus = \"4 GPa\"\nthickness = 0.2\nwidth = \"mainstone\"\n";
    for (key, value) in [("base", "{ rotation = 1e8 }"), ("gravity", "true")] {
        let told = refusal(&format!("{frame}{key} = {value}\n"));
        let said =
            format!("{key} belongs to the building: write it above the first [[building.infill]]");
        assert!(told.contains(&said), "{told}");
        assert!(!told.contains("did you mean"), "{told}");
    }
}

/// Columns stand in storeys and at lines, beams on floors and in bays.
#[test]
fn places_of_the_other_members_are_named() {
    let base = "[[building]]\nname = \"A\"\nstoreys = 2\nstorey_height = \"3 m\"\nspans = [\"5 m\"]\nconcrete = \"C30\"\nbeam_mass = \"2 t/m\"\n";
    let side = "width = \"0.4 m\", depth = \"0.5 m\"";
    for (key, other) in [("storeys", "floors"), ("line", "bay")] {
        let wrong_beam = format!(
            "{base}column = {{ {side} }}\nbeam = [{{ {side} }}, {{ {side}, {key} = 1 }}]\n"
        );
        let wrong_column = format!(
            "{base}beam = {{ {side} }}\ncolumn = [{{ {side} }}, {{ {side}, {other} = 1 }}]\n"
        );
        for (text, found, wanted) in [(wrong_beam, key, other), (wrong_column, other, key)] {
            let said = refusal(&text);
            let remedy = format!("write {wanted} instead of {found}");
            assert!(said.contains(&remedy), "{said}");
        }
    }
}
