//! Models as scripts for other programs.

mod common;

use common::{complained, folder, jostle, printed};

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
fn links_and_walls_are_refused_with_their_lines() {
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
    for (more, place, field) in [
        (
            "[[link]]\nbetween = [\"A\", \"B\"]\nstiffness = \"5 MN/m\"\n",
            "model.toml:20:1",
            "link[0]",
        ),
        (
            "[[gap]]\nbetween = [\"wall\", \"A\"]\nwidth = \"20 mm\"\n",
            "model.toml:21:11",
            "gap[1].between",
        ),
    ] {
        std::fs::write(folder.path().join("model.toml"), storeys.clone() + more).expect("written");
        let output = jostle(
            folder.path(),
            &["export", "model.toml", "--to", "openseespy"],
        );
        assert_eq!(output.status.code(), Some(2));
        let complaint = complained(&output);
        assert!(
            complaint.contains(place) && complaint.contains(field),
            "{complaint}"
        );
        assert!(complaint.contains("leave"), "{complaint}");
        assert_eq!(printed(&output), "");
    }
}
