//! The envelope over the bounds of bearings, in every place where a run shows it, and whether `jostle check` says what columns do.

use std::path::Path;

use crate::common::{complained, folder, jostle, printed};
use serde_json::Value;

#[test]
fn a_run_shows_the_envelope_on_the_terminal_in_the_report_and_as_json() {
    let folder = folder();
    let example =
        Path::new(env!("CARGO_MANIFEST_DIR")).join("../../examples/isolated_hospital.toml");
    let example = example.to_str().expect("a path");
    for (more, is_reported) in [(&["--no-report"][..], false), (&[], true)] {
        let arguments = [&["run", example, "--out", "out", "--force"], more].concat();
        let output = jostle(folder.path(), &arguments);
        assert!(output.status.success(), "{}", complained(&output));
        let read = |name: &str| {
            let path = folder.path().join("out").join(name);
            std::fs::read_to_string(path).expect("a result")
        };
        let summary: Value = serde_json::from_str(&read("summary.json")).expect("JSON");
        let stroke = &summary["isolation_bounds"]["buildings"][0]["stroke_m"];
        let of = |key: &str| stroke[key].as_f64().expect("a number");
        let greatest = ["nominal", "lower", "upper"]
            .map(of)
            .into_iter()
            .fold(0.0, f64::max);
        assert!(of("envelope") == greatest && of("lower") > of("upper"));
        let shown = format!("envelope {:.1} mm", 1e3 * greatest);
        assert!(printed(&output).contains(&shown), "{}", printed(&output));
        if is_reported {
            let report = read("report.html");
            let section = report.split("id=\"bounds\"").nth(1).expect("the section");
            let section = section.split("</section>").next().unwrap_or_default();
            assert!(
                section.contains(&format!("<b>{:.1}</b>", 1e3 * greatest)),
                "{section}"
            );
        }
    }
}

#[test]
fn check_says_whether_columns_shorten_and_why() {
    let folder = folder();
    let says = |storeys: usize, column: &str, axial: &str| {
        let text = format!(
            "[motion]\nrecord = \"el-centro-1940-ns\"\n[[building]]\nname = \"A\"\nstoreys = {storeys}\nstorey_height = 3\nspans = [12]\nconcrete = \"C30\"\nbeam_mass = 5000\ncolumn = {column}\nbeam = {{ width = 0.3, depth = 0.6 }}\n{axial}\n"
        );
        std::fs::write(folder.path().join("a.toml"), text).expect("a file");
        let output = jostle(folder.path(), &["check", "a.toml"]);
        assert!(output.status.success(), "{}", complained(&output));
        let printed = printed(&output);
        let line = printed.lines().find(|line| line.starts_with("  columns"));
        line.expect("a line").trim().to_owned()
    };
    let square = "{ width = 0.5, depth = 0.5 }";
    for (storeys, column, axial, due) in [
        (
            4,
            square,
            "",
            "columns axially rigid (default up to 3 times as high as wide and 10 storeys); 1.0 times as high as wide",
        ),
        (
            12,
            square,
            "",
            "columns axially flexible (default above 3 times as high as wide or 10 storeys); 3.0 times as high as wide",
        ),
        (
            12,
            square,
            "axial = \"rigid\"",
            "columns axially rigid, as given; 3.0 times as high as wide",
        ),
        (
            4,
            square,
            "axial = \"flexible\"",
            "columns axially flexible, as given; 1.0 times as high as wide",
        ),
        (
            12,
            "{ EI = 1e8, mass = 600 }",
            "",
            "columns axially rigid: no EA; 3.0 times as high as wide",
        ),
    ] {
        assert_eq!(says(storeys, column, axial), due);
    }
}
