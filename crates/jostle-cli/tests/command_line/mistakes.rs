//! What the program says to wrong input: place, problem, remedy, exit code 2, and nothing written.

use crate::common::{complained, folder, jostle, printed};

const MODEL: &str = r#"title = "Mistaken"

[motion]
record = "el-centro-1940-ns"
pga = "220 cm/s2"

[[building]]
name = "A"
kind = "shear"
mass = ["40 t", "40 t"]
stiffness = ["60 MN/m", "60 MN/m"]
storey_height = "3 m"

[[building]]
name = "B"
kind = "shear"
mass = "60 t"
stiffness = ["90 MN/m", "90 MN/m"]
storey_height = "3 m"

[[gap]]
between = ["A", "B"]
width = "20 mm"
law = "linear"
stiffness = "93.5 MN/m"
"#;

/// Exit code and complaint for a model with one text replaced by another.
fn complaint(from: &str, to: &str) -> String {
    let folder = folder();
    assert!(MODEL.contains(from), "the model has no \"{from}\"");
    std::fs::write(folder.path().join("m.toml"), MODEL.replace(from, to)).expect("a file");
    let output = jostle(folder.path(), &["run", "m.toml", "--out", "r"]);
    assert_eq!(
        output.status.code(),
        Some(2),
        "{}{}",
        printed(&output),
        complained(&output)
    );
    assert_eq!(printed(&output), "");
    assert!(
        !folder.path().join("r").exists(),
        "nothing is written for wrong input"
    );
    complained(&output)
}

#[test]
fn the_model_itself_is_fine() {
    let folder = folder();
    std::fs::write(folder.path().join("m.toml"), MODEL).expect("a file");
    let output = jostle(folder.path(), &["run", "m.toml"]);
    assert!(output.status.success(), "{}", complained(&output));
}

#[test]
fn every_mistake_is_named_with_its_line_and_a_remedy() {
    let cases: &[(&str, &str, &[&str])] = &[
        (
            "storey_height = \"3 m\"\n\n[[gap]]",
            "storey_height = \"3 kg\"\n\n[[gap]]",
            &[
                "m.toml:19:",
                "building[1].storey_height",
                "expected a length (such as \"3.2 m\"), found \"3 kg\"",
            ],
        ),
        (
            "width = \"20 mm\"",
            "width = \"-20 mm\"",
            &["m.toml:23:", "gap[0].width", "must not be negative"],
        ),
        (
            "law = \"linear\"",
            "law = \"lineal\"",
            &["m.toml:24:", "gap[0].law", "linear"],
        ),
        (
            "law = \"linear\"",
            "lav = \"linear\"",
            &["m.toml:24:", "lav", "law"],
        ),
        (
            "[\"A\", \"B\"]",
            "[\"A\", \"C\"]",
            &["m.toml:22:", "gap[0].between", "\"C\""],
        ),
        (
            "record = \"el-centro-1940-ns\"",
            "record = \"el-centro\"\nscale = 2",
            &["m.toml:", "motion", "pga", "scale"],
        ),
        (
            "record = \"el-centro-1940-ns\"",
            "record = \"nowhere.at2\"",
            &["m.toml:4:", "motion.record", "nowhere.at2"],
        ),
        (
            "mass = \"60 t\"",
            "mass = \"-60 t\"",
            &["m.toml:17:", "building[1].mass", "greater than zero"],
        ),
        (
            "mass = \"60 t\"",
            "mass = nan",
            &["m.toml:17:", "building[1].mass"],
        ),
        (
            "title = \"Mistaken\"",
            "title = \"Mistaken\"\n[analysis]\nstep = \"50 ms\"",
            &["m.toml:3:", "analysis.step", "too large"],
        ),
        (
            "title = \"Mistaken\"",
            "title = \"Mistaken\"\n[analysis]\ncontact_step = \"20 ms\"",
            &["m.toml:3:", "analysis.contact_step", "too large"],
        ),
        ("title = \"Mistaken\"", "title = \"Mistaken", &["m.toml:1:"]),
    ];
    for (from, to, parts) in cases {
        let text = complaint(from, to);
        for part in *parts {
            assert!(
                text.contains(part),
                "\"{part}\" should stand in the complaint about {to:?}:\n{text}"
            );
        }
    }
}

#[test]
fn all_mistakes_are_reported_at_once() {
    let text = complaint(
        "mass = \"60 t\"\nstiffness = [\"90 MN/m\", \"90 MN/m\"]",
        "mass = \"60 m\"\nstiffness = [\"90 MN\", \"90 MN/m\"]\ncolour = \"red\"",
    );
    for part in [
        "building[1].mass",
        "building[1].stiffness[0]",
        "colour",
        "3 faults",
    ] {
        assert!(text.contains(part), "\"{part}\" should stand in:\n{text}");
    }
}

#[test]
fn options_are_checked_too() {
    let folder = folder();
    for (arguments, part) in [
        (["run", "--gap", "5 kg"], "--gap: expected a length"),
        (["run", "--gap", "-5 mm"], "the gap must not be negative"),
        (["run", "--pga", "0 g"], "greater than zero"),
        (["run", "--record", "nowhere.at2"], "nowhere.at2"),
        (["modes", "--count", "0"], "--count"),
    ] {
        let output = jostle(folder.path(), &arguments);
        assert_eq!(output.status.code(), Some(2), "{arguments:?}");
        assert!(
            complained(&output).contains(part),
            "{arguments:?}: {}",
            complained(&output)
        );
    }
    let missing = jostle(folder.path(), &["run", "nowhere.toml"]);
    assert_eq!(missing.status.code(), Some(2));
    assert!(
        complained(&missing).contains("nowhere.toml"),
        "{}",
        complained(&missing)
    );
}
