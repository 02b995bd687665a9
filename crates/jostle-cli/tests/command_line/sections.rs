//! `jostle section`, and models with hinges.

use crate::common::{complained, folder, jostle, printed};
use serde_json::Value;

const COLUMN: [&str; 7] = [
    "section", "--width", "500mm", "--depth", "500mm", "--bars", "12 d20",
];

const MODEL: &str = r#"
title = "Two storeys"
[motion]
record = "el-centro-1940-ns"
[[building]]
name = "A"
storeys = 2
storey_height = "3 m"
spans = ["6 m"]
column = { width = "500 mm", depth = "500 mm", steel = "HRB400", bars = "12 d20" }
beam = { width = "300 mm", depth = "600 mm", steel = "HRB400", bars = "4 d25 top, 4 d25 bottom" }
concrete = "C30"
beam_mass = "3600 kg/m"
hinges = { rule = "peak-oriented", from = "section" }
"#;

#[test]
fn a_section_is_described_by_both_methods() {
    let folder = folder();
    let arguments = [
        &COLUMN[..],
        &[
            "--axial-load",
            "800kN",
            "--length",
            "3.2m",
            "--html",
            "page.html",
        ],
    ]
    .concat();
    let output = jostle(folder.path(), &arguments);
    assert!(output.status.success(), "{}", complained(&output));
    let text = printed(&output);
    for part in ["formula", "fibre", "tension bars yield", "page.html"] {
        assert!(text.contains(part), "\"{part}\" should stand in:\n{text}");
    }
    let page = std::fs::read_to_string(folder.path().join("page.html")).expect("the page");
    assert!(
        page.contains("id=\"theme\"") && page.contains("<script"),
        "light or dark"
    );
    for part in ["<svg", "<circle", "Sugano", "curvature"] {
        assert!(page.contains(part), "{part}");
    }
    assert!(!page.contains("NaN") && !page.contains("http://") && !page.contains("https://"));
}

/// More than concrete and bars carry together: there is no yield moment, and no ratio of it.
#[test]
fn a_section_does_not_yield_beyond_its_axial_strength() {
    let folder = folder();
    let load = ["--axial-load", "20000kN", "--html", "page.html"];
    let output = jostle(folder.path(), &[&COLUMN[..], &load[..]].concat());
    assert!(output.status.success(), "{}", complained(&output));
    let text = printed(&output);
    let page = std::fs::read_to_string(folder.path().join("page.html")).expect("the page");
    for shown in [&text, &page] {
        assert!(shown.contains("exceeds its strength"), "{shown}");
        assert!(!shown.contains("NaN"), "{shown}");
    }
    let output = jostle(
        folder.path(),
        &[&COLUMN[..], &["--axial-load", "20000kN", "--json"]].concat(),
    );
    let value: Value = serde_json::from_str(&printed(&output)).expect("nothing but JSON");
    let ratio = value.pointer("/sections/0/formula/positive/secant_ratio");
    assert_eq!(ratio, Some(&Value::Null));
}

#[test]
fn json_has_both_sides_and_the_curve() {
    let folder = folder();
    let output = jostle(
        folder.path(),
        &[&COLUMN[..], &["--axial-load", "800kN", "--json"]].concat(),
    );
    let value: Value = serde_json::from_str(&printed(&output)).expect("nothing but JSON");
    let at = |path: &str| {
        value
            .pointer(&format!("/sections/0/{path}"))
            .and_then(Value::as_f64)
            .expect(path)
    };
    assert_eq!(at("axial_load_n"), 800e3);
    for method in ["formula", "fibre"] {
        let [positive, negative] =
            ["positive", "negative"].map(|side| at(&format!("{method}/{side}/yield_moment_nm")));
        assert!((positive / negative - 1.0).abs() < 1e-9);
        assert!((300e3..500e3).contains(&positive), "{positive}");
        assert!(at(&format!("{method}/positive/cracking_moment_nm")) < 0.5 * positive);
    }
    assert!(
        value
            .pointer("/sections/0/fibre/positive/curvature_1_m/20")
            .is_some()
    );
}

#[test]
fn a_model_with_hinges_is_checked_and_run() {
    let folder = folder();
    std::fs::write(folder.path().join("two.toml"), MODEL).expect("written");
    let output = jostle(folder.path(), &["check", "two.toml"]);
    assert!(output.status.success(), "{}", complained(&output));
    let text = printed(&output);
    assert!(
        text.contains("hinges peak-oriented, columns: crack at"),
        "{text}"
    );
    assert!(text.contains("The model is valid."));
    let output = jostle(folder.path(), &["section", "two.toml"]);
    let text = printed(&output);
    for part in [
        "A: column, storey 1, lines 1, 2",
        "A: beam, storeys 1 to 2, bay 1",
    ] {
        assert!(text.contains(part), "\"{part}\" should stand in:\n{text}");
    }
    let output = jostle(folder.path(), &["run", "two.toml"]);
    assert_eq!(output.status.code(), Some(0), "{}", complained(&output));
}

#[test]
fn mistakes_name_the_option() {
    let folder = folder();
    for (more, word) in [
        (
            &["--concrete", "C33"][..],
            "--concrete: \"C33\" is not known",
        ),
        (&["--cover", "300mm"], "--cover: leaves no room"),
        (&["--axial-load", "8t"], "--axial-load: expected a force"),
        (&["--ties", "many"], "--ties: \"many\" is not understood"),
        (&["--length", "0"], "--length: must lie"),
    ] {
        let output = jostle(folder.path(), &[&COLUMN[..], more].concat());
        assert_eq!(output.status.code(), Some(2), "{more:?}");
        assert!(
            complained(&output).contains(word),
            "{}",
            complained(&output)
        );
    }
    let output = jostle(folder.path(), &["section", "paper"]);
    assert!(
        complained(&output).contains("no reinforced members"),
        "{}",
        complained(&output)
    );
}
