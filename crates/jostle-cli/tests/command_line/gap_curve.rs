//! Files of `jostle gap`: the page, numbers and rules, and with `--curve` force and impacts over the width.

use std::path::Path;

use crate::common::{complained, folder, jostle, printed};

const MODEL: &str = r#"title = "pair"
motion = { kind = "sine", amplitude = "2 m/s2", period = "0.7 s", duration = "4 s" }
[[building]]
name = "A"
kind = "shear"
mass = "40 t"
stiffness = "20 MN/m"
storeys = 2
[[building]]
name = "B"
kind = "shear"
mass = "40 t"
stiffness = "60 MN/m"
storeys = 2
[[gap]]
between = ["A", "B"]
width = "20 mm"
law = "kelvin"
stiffness = "50 MN/m"
restitution = 0.6
"#;

const CURVE: [&str; 6] = ["gap", "pair.toml", "--no-outcomes", "--curve", "9", "--out"];

fn with_model() -> tempfile::TempDir {
    let folder = folder();
    std::fs::write(folder.path().join("pair.toml"), MODEL).expect("written");
    folder
}

/// Rows of the table by name of the column.
fn rows(path: &Path) -> Vec<std::collections::HashMap<String, String>> {
    let text = std::fs::read_to_string(path).expect("a table");
    let mut lines = text.lines().filter(|line| !line.starts_with('#'));
    let names: Vec<&str> = lines.next().expect("a header").split(',').collect();
    let named = |line: &str| {
        let values = line.split(',').map(str::to_owned);
        names
            .iter()
            .map(|name| (*name).to_owned())
            .zip(values)
            .collect()
    };
    lines.map(named).collect()
}

#[test]
fn a_point_of_the_curve_is_the_run_with_its_gap() {
    let folder = with_model();
    let output = jostle(folder.path(), &[&CURVE[..], &["curve"]].concat());
    assert!(output.status.success(), "{}", complained(&output));
    assert!(printed(&output).contains("→ curve"), "{}", printed(&output));
    let curve = folder.path().join("curve");
    let page = std::fs::read_to_string(curve.join("gap.html")).expect("a page");
    assert!(page.contains("pair") && page.trim_end().ends_with("</html>"));

    let rows = rows(&curve.join("gap_curve.csv"));
    let signs = rows.iter().filter(|row| row["reversed"] == "true");
    assert_eq!((rows.len(), signs.count()), (18, 9));
    let number = |row: usize, name: &str| -> f64 { rows[row][name].parse().expect(name) };
    assert_eq!(number(0, "width_m"), 0.0);
    assert!(number(8, "impact_count") == 0.0 && number(7, "impact_count") > 0.0);
    let width = number(3, "width_m");
    let gap = format!("{width} m");
    let run = jostle(
        folder.path(),
        &["run", "pair.toml", "--gap", &gap, "--json"],
    );
    assert!(run.status.success(), "{}", complained(&run));
    let summary: serde_json::Value = serde_json::from_str(&printed(&run)).expect("JSON");
    let summary = &summary["gaps"][0];
    assert_eq!(
        summary["impact_count"].as_f64(),
        Some(number(3, "impact_count"))
    );
    assert_eq!(
        summary["peak_force_n"].as_f64(),
        Some(number(3, "peak_force_n"))
    );
}

#[test]
fn a_curve_replaces_its_own_files_and_nothing_else() {
    let folder = with_model();
    let (out, page) = ("curve", folder.path().join("curve/gap.html"));
    std::fs::create_dir(folder.path().join(out)).expect("made");
    std::fs::write(&page, "mine\n").expect("written");
    let refused = jostle(folder.path(), &[&CURVE[..], &[out]].concat());
    assert_eq!(refused.status.code(), Some(2));
    let complaint = complained(&refused);
    assert!(
        complaint.contains("gap.html") && complaint.contains("--force"),
        "{complaint}"
    );
    assert_eq!(std::fs::read_to_string(&page).expect("kept"), "mine\n");

    let forced = jostle(folder.path(), &[&CURVE[..], &[out, "--force"]].concat());
    assert!(forced.status.success(), "{}", complained(&forced));
    let again = jostle(folder.path(), &[&CURVE[..], &[out]].concat());
    assert!(again.status.success(), "{}", complained(&again));
    assert!(
        complained(&again).contains("holds results of an earlier search"),
        "{}",
        complained(&again)
    );
}

#[test]
fn every_search_writes_its_page_numbers_and_rules() {
    let folder = with_model();
    let searched = |more: &[&str]| {
        let output = jostle(folder.path(), &[&["gap", "pair.toml"], more].concat());
        assert!(output.status.success(), "{}", complained(&output));
        printed(&output)
    };
    let names = |out: &str| {
        let files = std::fs::read_dir(folder.path().join(out)).expect("a folder");
        let mut names: Vec<String> = files
            .map(|file| file.expect("a file").file_name().display().to_string())
            .collect();
        names.sort();
        names
    };
    assert!(searched(&["--curve", "9"]).contains("→ jostle-out"));
    let default = "jostle-out/pair-gap";
    assert_eq!(
        names(default),
        ["gap.csv", "gap.html", "gap.json", "gap_curve.csv"]
    );
    // A curve of an earlier search does not stay beside the numbers of this one.
    searched(&[]);
    assert_eq!(names(default), ["gap.csv", "gap.html", "gap.json"]);

    let printed = searched(&["--json", "--out", "files"]);
    let written = std::fs::read_to_string(folder.path().join("files/gap.json")).expect("numbers");
    assert_eq!(printed.trim(), written.trim());
    let numbers: serde_json::Value = serde_json::from_str(&written).expect("JSON");
    let rules = numbers["gaps"][0]["rules"].as_array().expect("rules");
    let table = rows(&folder.path().join("files/gap.csv"));
    assert_eq!(table.len(), rules.len());
    // Names without a comma, which would be quoted.
    let rules = rules.iter().zip(&table);
    let plain = rules.filter(|(_, row)| !row["rule"].starts_with('"'));
    for (rule, row) in plain {
        assert_eq!(row["rule"], rule["rule"].as_str().expect("a name"));
        assert_eq!(row["gap_m"].parse().ok(), rule["gap_m"].as_f64());
        assert_eq!(
            row["peak_force_n"].parse().ok(),
            rule["peak_force_n"].as_f64()
        );
    }
    let page = std::fs::read_to_string(folder.path().join("files/gap.html")).expect("a page");
    assert!(page.contains("greatest contact force") && page.contains("ABS"));

    searched(&["--json"]);
    assert!(!folder.path().join("jostle-out/pair-gap/other").exists());
}

/// Of two gaps the page begins with the one that is too narrow, whichever is first in the file.
#[test]
fn the_page_begins_with_the_gap_that_is_too_narrow() {
    let folder = folder();
    let third = "[[building]]\nname = \"C\"\nkind = \"shear\"\nmass = \"40 t\"\nstiffness = \"80 MN/m\"\nstoreys = 2\n\
                 [[gap]]\nbetween = [\"B\", \"C\"]\nwidth = \"1 m\"\nlaw = \"kelvin\"\nstiffness = \"50 MN/m\"\nrestitution = 0.6\n";
    let wide = MODEL.replace("width = \"20 mm\"", "width = \"1 m\"");
    for (name, text, widths, narrow) in [
        (
            "first.toml",
            format!("{MODEL}{third}"),
            [0.02, 1.0],
            "A and B",
        ),
        (
            "second.toml",
            format!("{wide}{}", third.replace("1 m", "2 mm")),
            [1.0, 0.002],
            "B and C",
        ),
    ] {
        std::fs::write(folder.path().join(name), text).expect("written");
        let arguments = ["gap", name, "--no-outcomes", "--out", "out"];
        let output = jostle(folder.path(), &arguments);
        assert!(output.status.success(), "{}", complained(&output));
        let found: serde_json::Value = serde_json::from_slice(
            &std::fs::read(folder.path().join("out/gap.json")).expect("numbers"),
        )
        .expect("JSON");
        let gaps = found["gaps"].as_array().into_iter().flatten();
        let lacks = gaps.zip(widths).map(|(gap, width)| {
            let number = |key: &str| gap[key].as_f64().unwrap_or(0.0);
            number("gap_m").max(number("reversed_gap_m")) - width
        });
        let lacks: Vec<f64> = lacks.filter(|lacks| *lacks > 0.0).collect();
        assert_eq!(lacks.len(), 1, "{found}");
        let page = std::fs::read_to_string(folder.path().join("out/gap.html")).expect("a page");
        let after = page.split("class=\"verdict\"").nth(1);
        let headline = after
            .and_then(|after| after.split("</p>").next())
            .expect("a headline");
        let due = format!(
            "The gap between {narrow} is {:.0} mm too narrow.",
            (1e3 * lacks[0]).ceil()
        );
        assert!(headline.contains(&due), "{due}: {headline}");
        assert!(page.contains("A ↔ B: rules under") && page.contains("B ↔ C: rules under"));
        assert!(!page.contains("greatest force ["), "columns without values");
    }
}
