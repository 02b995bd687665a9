//! `jostle import`: two example workbooks become a pair that is checked and run; what is wrong exits with 2 and writes nothing.

use std::path::{Path, PathBuf};

use crate::common::{complained, folder, jostle, printed};

fn example(name: &str) -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR"))
        .join("../../examples")
        .join(name)
}

#[test]
fn two_workbooks_become_a_pair_that_runs() {
    let folder = folder();
    for name in ["hotel.xlsx", "annexe.xlsx"] {
        std::fs::copy(example(&format!("etabs/{name}")), folder.path().join(name)).expect("a copy");
    }
    let import = [
        "import",
        "etabs",
        "hotel.xlsx",
        "annexe.xlsx",
        "--gap",
        "50 mm",
        "--to",
        "pair.toml",
    ];
    let output = jostle(folder.path(), &import);
    let text = printed(&output);
    assert_eq!(
        output.status.code(),
        Some(0),
        "{text}{}",
        complained(&output)
    );
    // Periods of the model beside those of the tables, to their digits.
    let differences: Vec<f64> = text
        .lines()
        .filter(|line| line.contains(" s  ") && line.ends_with('%'))
        .filter_map(|line| {
            line.trim_end_matches('%')
                .split_whitespace()
                .last()?
                .parse()
                .ok()
        })
        .collect();
    assert_eq!(differences.len(), 12, "{text}");
    assert!(differences.iter().all(|own| own.abs() <= 0.05), "{text}");
    for words in ["Read", "Assumptions", "jostle check pair.toml"] {
        assert!(text.contains(words), "{text}");
    }
    for command in [
        &["check", "pair.toml"][..],
        &["run", "pair.toml", "--no-report", "--out", "r"],
    ] {
        let output = jostle(folder.path(), command);
        assert_eq!(
            output.status.code(),
            Some(0),
            "{}{}",
            printed(&output),
            complained(&output)
        );
    }
    // What jostle wrote it may replace; anything else only if it is asked to.
    assert_eq!(jostle(folder.path(), &import).status.code(), Some(0));
    std::fs::write(folder.path().join("pair.toml"), "mine = true\n").expect("a file");
    let output = jostle(folder.path(), &import);
    assert_eq!(output.status.code(), Some(2));
    assert!(
        complained(&output).contains("--force"),
        "{}",
        complained(&output)
    );
}

#[test]
fn wrong_files_exit_with_2_and_write_nothing() {
    let folder = folder();
    std::fs::copy(
        example("etabs/hotel.xlsx"),
        folder.path().join("hotel.xlsx"),
    )
    .expect("a copy");
    std::fs::write(folder.path().join("a.e2k"), "$ CONTROLS\n").expect("a file");
    let cases: [(&[&str], &str); 5] = [
        (&["etabs", "nothing.xlsx"], "nothing.xlsx cannot be read"),
        (&["etabs", "a.e2k"], "has no line UNITS"),
        (&["sap2000", "a.e2k"], "jostle import etabs"),
        (&["etabs", "hotel.xlsx", "--by", "modes"], "shapes of modes"),
        (
            &["etabs", "hotel.xlsx", "--by", "modes", "--direction", "x"],
            "has no stiffness",
        ),
    ];
    for (arguments, words) in cases {
        let all: Vec<&str> = ["import"]
            .iter()
            .chain(arguments)
            .chain(&["--to", "m.toml"])
            .copied()
            .collect();
        let output = jostle(folder.path(), &all);
        assert_eq!(
            output.status.code(),
            Some(2),
            "{arguments:?}: {}",
            printed(&output)
        );
        assert!(
            complained(&output).contains(words),
            "{}",
            complained(&output)
        );
        assert!(!folder.path().join("m.toml").exists());
    }
}

#[test]
fn a_text_model_of_sap2000_becomes_a_space_frame() {
    let folder = folder();
    std::fs::copy(
        example("sap2000/frame.s2k"),
        folder.path().join("frame.s2k"),
    )
    .expect("a copy");
    let output = jostle(
        folder.path(),
        &["import", "sap2000", "frame.s2k", "--to", "frame.toml"],
    );
    assert_eq!(output.status.code(), Some(0), "{}", complained(&output));
    assert!(
        printed(&output).contains("FRAME LOADS - DISTRIBUTED"),
        "{}",
        printed(&output)
    );
    let output = jostle(folder.path(), &["check", "frame.toml"]);
    assert_eq!(output.status.code(), Some(0), "{}", complained(&output));
}
