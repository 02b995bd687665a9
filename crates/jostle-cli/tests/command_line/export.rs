//! Models as scripts for other programs.

use crate::common::{complained, folder, jostle, printed};

#[test]
fn a_script_is_printed_or_written() {
    let folder = folder();
    let output = jostle(
        folder.path(),
        &["export", "--to", "openseespy", "--gap", "60 mm"],
    );
    assert!(output.status.success(), "{}", complained(&output));
    let script = printed(&output);
    assert!(script.starts_with("#!/usr/bin/env python3"), "{script:.80}");
    assert!(script.contains("\"Hertzdamp\", "), "the law of the example");
    assert!(
        script.contains(", -0.06, 1.5)"),
        "the gap that was asked for"
    );
    assert!(complained(&output).contains("difference:"));
    let arguments = [
        "export",
        "--to",
        "openseespy",
        "--gap",
        "60 mm",
        "-o",
        "model.py",
    ];
    let output = jostle(folder.path(), &arguments);
    assert!(output.status.success(), "{}", complained(&output));
    assert_eq!(printed(&output), "");
    let written = std::fs::read_to_string(folder.path().join("model.py")).expect("it is there");
    assert_eq!(written.trim_end(), script.trim_end());
}

#[test]
fn what_cannot_be_exported_is_refused_with_its_line() {
    let folder = folder();
    let model = r#"title = "bumper"
motion = { record = "el-centro-1940-ns" }
[[building]]
name = "A"
kind = "shear"
mass = "40 t"
stiffness = "60 MN/m"
storeys = 2
storey_height = "3 m"
[[building]]
name = "B"
kind = "shear"
mass = "80 t"
stiffness = "60 MN/m"
storeys = 2
storey_height = "3 m"
[[gap]]
between = ["A", "B"]
width = "20 mm"
law = "restitution"
stiffness = "60 MN/m"
restitution = 0.6
"#;
    std::fs::write(folder.path().join("model.toml"), model).expect("written");
    let output = jostle(
        folder.path(),
        &["export", "model.toml", "--to", "openseespy", "-o", "x.py"],
    );
    assert_eq!(output.status.code(), Some(2));
    let complaint = complained(&output);
    assert!(complaint.contains("model.toml:20"), "{complaint}");
    assert!(
        complaint.contains("gap[0].law") && complaint.contains("hertz-damp"),
        "{complaint}"
    );
    assert!(!folder.path().join("x.py").exists());
}

#[test]
fn rigid_walls_are_refused_with_their_lines() {
    const PAIR: &str = r#"title = "pair"
motion = { record = "el-centro-1940-ns" }
[[building]]
name = "A"
kind = "shear"
mass = "40 t"
stiffness = "60 MN/m"
[[building]]
name = "B"
kind = "shear"
mass = "80 t"
stiffness = "60 MN/m"
[[gap]]
between = ["A", "B"]
width = "20 mm"
"#;
    let folder = folder();
    let storeys = PAIR.replace(
        "\"60 MN/m\"\n",
        "\"60 MN/m\"\nstoreys = 2\nstorey_height = \"3 m\"\n",
    );
    let more = "[[gap]]\nbetween = [\"wall\", \"A\"]\nwidth = \"20 mm\"\n";
    std::fs::write(folder.path().join("model.toml"), storeys + more).expect("written");
    let output = jostle(
        folder.path(),
        &["export", "model.toml", "--to", "openseespy"],
    );
    assert_eq!(output.status.code(), Some(2));
    let complaint = complained(&output);
    for part in ["model.toml:21:11", "gap[1].between", "leave"] {
        assert!(complaint.contains(part), "{complaint}");
    }
    assert_eq!(printed(&output), "");
}

/// The built-in example, but its buildings are read from their matrices.
fn given_example(folder: &std::path::Path) -> String {
    let output = jostle(folder, &["export", "--to", "matrices", "-o", "."]);
    assert!(output.status.success(), "{}", complained(&output));
    let blocks = std::fs::read_to_string(folder.join("buildings.toml")).expect("it is there");
    let example = include_str!("../../../jostle-io/data/paper.toml");
    let (before, buildings) = example.split_once("[[building]]").expect("buildings");
    let (_, gap) = buildings.split_once("[[gap]]").expect("a gap");
    format!("{before}\n{blocks}\n[[gap]]{gap}")
}

/// Numbers of a summary by their paths, without what depends on rounding and on the machine.
fn numbers(value: &serde_json::Value, path: &str, found: &mut Vec<(String, f64)>) {
    match value {
        serde_json::Value::Object(map) => {
            for (key, value) in map {
                if !["work", "promise", "imbalance", "worst_imbalance"].contains(&key.as_str()) {
                    numbers(value, &format!("{path}.{key}"), found);
                }
            }
        }
        serde_json::Value::Array(list) => {
            for (index, value) in list.iter().enumerate() {
                numbers(value, &format!("{path}[{index}]"), found);
            }
        }
        serde_json::Value::Number(number) => {
            found.push((path.to_owned(), number.as_f64().unwrap_or(f64::NAN)));
        }
        _ => {}
    }
}

#[test]
fn buildings_given_by_their_matrices_have_the_same_numbers() {
    let folder = folder();
    let model = given_example(folder.path());
    std::fs::write(folder.path().join("given.toml"), model).expect("a file");
    let run = |arguments: &[&str]| {
        let output = jostle(folder.path(), arguments);
        assert!(output.status.success(), "{}", complained(&output));
        let summary = serde_json::from_str(&printed(&output)).expect("JSON");
        let mut found = Vec::new();
        numbers(&summary, "", &mut found);
        found
    };
    for solver in ["modal", "riccati"] {
        let solver = ["--json", "--solver", solver];
        let expected = run(&[
            &["run", "--pga", "220 cm/s2", "--gap", "100 mm"],
            &solver[..],
        ]
        .concat());
        let found = run(&[&["run", "given.toml"], &solver[..]].concat());
        assert!(found.len() > 300 && found.len() == expected.len());
        for ((path, found), (_, expected)) in found.iter().zip(&expected) {
            // A residual at rest is rounding.
            let scale = expected.abs().max(1e-12);
            assert!(
                (found - expected).abs() <= 1e-9 * scale,
                "{path}: {found} for {expected}"
            );
        }
    }
    // jostle replaces its own archives and nobody else's.
    let again = jostle(folder.path(), &["export", "--to", "matrices", "-o", "."]);
    assert!(again.status.success(), "{}", complained(&again));
    std::fs::write(folder.path().join("J1.npz"), "mine").expect("a file");
    let kept = jostle(folder.path(), &["export", "--to", "matrices", "-o", "."]);
    assert!(!kept.status.success() && complained(&kept).contains("J1.npz"));
    let fault = jostle(folder.path(), &["check", "given.toml"]);
    assert_eq!(fault.status.code(), Some(2));
    assert!(
        complained(&fault).contains("numpy.savez"),
        "{}",
        complained(&fault)
    );
}

/// A space frame and storeys with a plan, and the same two read from their matrices.
#[test]
fn buildings_in_space_given_by_their_matrices_have_the_same_numbers() {
    let folder = folder();
    let before = r#"
[motion]
record = "el-centro"
pga = "0.4 g"
angle = "25 deg"
duration = "5 s"
[analysis]
solver = "modal"
step = "2 ms"
contact_step = "0.2 ms"
"#;
    let buildings = r#"
[[building]]
name = "A"
kind = "space-frame"
lines_x = ["0 m", "6 m", "11 m"]
lines_y = ["0 m", "5 m"]
storeys = 2
mass = "60 t"
mass_centre = ["5.2 m", "2.4 m"]
elastic_modulus = "30 GPa"
column = { size = ["0.4 m", "0.4 m"] }
beam_x = { width = "0.3 m", depth = "0.6 m" }
beam_y = { width = "0.3 m", depth = "0.5 m" }
[[building]]
name = "B"
kind = "shear"
storeys = 2
plan = ["7 m", "5 m"]
mass = "50 t"
stiffness = { x = "150 MN/m", y = "90 MN/m" }
eccentricity = ["0.7 m", "0.4 m"]
"#;
    let gap = "\n[[gap]]\nbetween = [\"A\", \"B\"]\nwidth = \"12 mm\"\nlaw = \"kelvin\"\nstiffness = \"300 MN/m\"\nrestitution = 0.65\n";
    let write = |name: &str, text: &str| {
        std::fs::write(folder.path().join(name), text).expect("a file");
    };
    write("members.toml", &format!("{before}{buildings}{gap}"));
    let arguments = ["export", "members.toml", "--to", "matrices", "-o", "."];
    let output = jostle(folder.path(), &arguments);
    assert!(output.status.success(), "{}", complained(&output));
    let blocks = std::fs::read_to_string(folder.path().join("buildings.toml"));
    let blocks = blocks.expect("it is there");
    assert!(blocks.contains("dofs = [") && blocks.contains("corners"));
    write("given.toml", &format!("{before}{blocks}{gap}"));
    let run = |model: &str| {
        let output = jostle(folder.path(), &["run", model, "--json"]);
        assert!(output.status.success(), "{}", complained(&output));
        let summary: serde_json::Value = serde_json::from_str(&printed(&output)).expect("JSON");
        let mut found = Vec::new();
        for part in ["buildings", "gaps"] {
            numbers(&summary[part], part, &mut found);
        }
        found
    };
    let (expected, found) = (run("members.toml"), run("given.toml"));
    assert!(found.len() > 100, "{}", found.len());
    let impacts = expected
        .iter()
        .find(|(path, _)| path == "gaps[0].impact_count");
    assert!(impacts.is_some_and(|(_, count)| *count > 0.0));
    for (path, expected) in &expected {
        let same = found.iter().find(|(other, _)| other == path);
        let (_, found) = same.unwrap_or_else(|| panic!("{path}"));
        let scale = expected.abs().max(1e-6);
        assert!(
            (found - expected).abs() <= 1e-8 * scale,
            "{path}: {found} for {expected}"
        );
    }
    let output = jostle(folder.path(), &["check", "given.toml"]);
    assert!(printed(&output).contains("given by matrices, 2 floors in plan"));
    let output = jostle(
        folder.path(),
        &[
            "export",
            "given.toml",
            "--to",
            "openseespy",
            "-o",
            "given.py",
        ],
    );
    assert!(complained(&output).contains("building[0].matrices"));
}

#[test]
fn faults_of_matrices_name_line_and_remedy() {
    let folder = folder();
    let check = |building: &str| {
        let text = format!("[[building]]\nkind = \"given\"\n{building}\n");
        std::fs::write(folder.path().join("model.toml"), text).expect("a file");
        let output = jostle(folder.path(), &["check", "model.toml"]);
        assert_eq!(output.status.code(), Some(2), "{}", printed(&output));
        complained(&output)
    };
    let two = "ports = { a = { dof = 1, height = 3 }, b = { dof = 2, height = 6 } }";
    let matrices = "matrices = { stiffness = [[2, -1], [-1, 1]], mass = [1e4, 1e4]";
    let scaled = "matrices = { stiffness = [[2e7, -1e7], [-1e7, 1e7]], mass = [1e4, 1e4]";
    for (building, expected) in [
        ("ports = {}", "add matrices = \"model.npz\""),
        (
            "matrices = \"none.npz\"\nports = {}",
            "\"none.npz\" cannot be read",
        ),
        (&format!("{matrices} }}"), "add ports ="),
        (
            &format!("matrices = {{ stiffness = [[2, 1], [0, 1]], mass = [1, 1] }}\n{two}"),
            "K must be symmetric",
        ),
        (
            &format!("matrices = {{ stiffness = [[1, -2], [-2, 1]], mass = [1, 1] }}\n{two}"),
            "must be positive definite: displacement 2",
        ),
        (
            &format!(
                "matrices = {{ stiffness = [[2, -1], [-1, 1]], mass = [[1, 0.1], [0.1, 1]] }}\n{two}"
            ),
            "lump them",
        ),
        (
            &format!("matrices = {{ stiffness = [[2, -1], [-1, 1]] }}\n{two}"),
            "have no mass matrix M",
        ),
        (
            &format!("{scaled} }}\nports = {{ a = {{ dof = 3, height = 3 }} }}"),
            "port \"a\" is displacement 3",
        ),
        (
            &format!("{scaled} }}\nports = {{ a = {{ dof = 1, height = 3 }} }}"),
            "add the vector r",
        ),
        (
            &format!(
                "{scaled}, influence = [1, 1] }}\nports = {{ a = {{ dof = 1, height = 3 }} }}"
            ),
            "add the vector h",
        ),
        (
            &format!(
                "{scaled} }}\nports = {{ \"2\" = {{ dof = 1, height = 3 }}, \"1\" = {{ dof = 2, height = 6 }} }}"
            ),
            "number ports so",
        ),
        (
            &format!("{scaled} }}\n{two}\nstorey_height = 3"),
            "ports say how high",
        ),
        (&format!("{scaled} }}\n{two}\nunits = \"kg\""), "kN, m"),
        (
            &format!(
                "{scaled}, damping = [[1, 0], [0, 1]] }}\n{two}\ndamping = {{ ratio = 0.02 }}"
            ),
            "leave out damping, or the matrix C",
        ),
        (
            &format!("{scaled} }}\n{two}\np_delta = true"),
            "make P-Delta part",
        ),
        (
            "mass = [1e4, 1e4]\nperiods = [0.5]\nshapes = [[1, 2], [1, -1]]",
            "give one shape for each period",
        ),
        (
            "mass = [1e4, 1e4]\nperiods = [0.5, 0.2]\nshapes = [[1, 2], [1, -1]]",
            "are not orthogonal",
        ),
        (
            "mass = [1e4, 1e4]\nperiods = [0.5]\nshapes = [[1, 2, 3]]",
            "has 3 values for 2 floors",
        ),
        ("mass = [1e4, 1e4]\nshapes = [[1, 2]]", "add periods"),
    ] {
        let found = check(building);
        assert!(found.contains(expected), "{building}\n{found}");
        assert!(found.contains("model.toml:"), "{found}");
    }
}

/// Two floors of a shear building, by Matrix Market files in kN and t and by their modes: the same periods.
#[test]
fn every_way_to_give_a_building_gives_its_periods() {
    let folder = folder();
    let write =
        |name: &str, text: &str| std::fs::write(folder.path().join(name), text).expect("a file");
    write(
        "k.mtx",
        "%%MatrixMarket matrix coordinate real symmetric\n2 2 3\n1 1 110e3\n2 1 -50e3\n2 2 50e3\n",
    );
    write(
        "m.mtx",
        "%%MatrixMarket matrix array real general\n2 1\n40\n30\n",
    );
    write(
        "c.mtx",
        "%%MatrixMarket matrix coordinate real symmetric\n2 2 3\n1 1 130\n2 1 -50\n2 2 65\n",
    );
    let shear =
        "kind = \"shear\"\nmass = [40e3, 30e3]\nstiffness = [60e6, 50e6]\nstorey_height = 3\n";
    let matrices = "kind = \"given\"\nunits = \"kN, m\"\nmatrices = { stiffness = \"k.mtx\", mass = \"m.mtx\", damping = \"c.mtx\" }\nports = { \"1\" = { dof = 1, height = 3 }, \"2\" = { dof = 2, height = 6 } }\n";
    let periods = |building: &str| -> Vec<f64> {
        write("model.toml", &format!("[[building]]\n{building}"));
        let output = jostle(folder.path(), &["modes", "model.toml", "--json"]);
        assert!(output.status.success(), "{}", complained(&output));
        let modes: serde_json::Value = serde_json::from_str(&printed(&output)).expect("JSON");
        let list = modes["buildings"][0]["periods_s"]
            .as_array()
            .expect("a list");
        list.iter().filter_map(serde_json::Value::as_f64).collect()
    };
    let expected = periods(shear);
    assert_eq!(expected.len(), 2);
    // By hand: 4 ω⁴ · 3 − (11 · 3 + 5 · 4) ω² · 10³ + (11 · 5 − 25) · 10⁶ = 0.
    for period in &expected {
        let square = (std::f64::consts::TAU / period).powi(2);
        let sum = 12.0 * square * square - 53e3 * square + 30e6;
        assert!(sum.abs() < 1e-6 * 30e6, "{sum}");
    }
    let check = jostle(folder.path(), &["check", "model.toml"]);
    assert!(check.status.success());
    for found in [
        periods(matrices),
        // Shapes of these periods to four digits, of any scale.
        periods(&format!(
            "kind = \"given\"\nmass = [40e3, 30e3]\nperiods = [{}, {}]\nshapes = [[{}, 1], [{}, 1]]\n",
            expected[0],
            expected[1],
            1.0 - 30e3 / 50e6 * (std::f64::consts::TAU / expected[0]).powi(2),
            1.0 - 30e3 / 50e6 * (std::f64::consts::TAU / expected[1]).powi(2),
        )),
    ] {
        for (found, expected) in found.iter().zip(&expected) {
            assert!((found / expected - 1.0).abs() < 1e-9, "{found} {expected}");
        }
    }
    // C = 0.5 M + 0.001 K is recognised, so that modes stay apart.
    write("model.toml", &format!("[[building]]\n{matrices}"));
    let check = jostle(folder.path(), &["check", "model.toml"]);
    let text = printed(&check);
    assert!(
        text.contains("modal") || text.contains("0.50000 1/s"),
        "{text}"
    );
}
