//! Studies of many cases: rows of a table as inputs, parts that are computed alone, figures of sampled studies.

use std::path::Path;

use jostle_io::{StudyFile, Values, write_values_parquet};
use jostle_study::dataset::{missing_parts, part_path, read_columns};
use jostle_study::{RunSettings, Study, finish, run};

const MODEL: &str = r#"
[motion]
kind = "sine"
amplitude = "3 m/s2"
period = "0.5 s"
duration = "1 s"
[[building]]
name = "A"
kind = "shear"
mass = ["40 t"]
stiffness = ["20 MN/m"]
storey_height = "3 m"
[[building]]
name = "B"
kind = "shear"
mass = ["60 t"]
stiffness = ["90 MN/m"]
storey_height = "3 m"
[[gap]]
between = ["A", "B"]
width = "5 mm"
[analysis]
tolerance = 0.01
"#;

fn folder() -> tempfile::TempDir {
    let folder = tempfile::tempdir().expect("a folder");
    std::fs::write(folder.path().join("model.toml"), MODEL).expect("a file");
    folder
}

fn load(folder: &Path, text: &str) -> Result<Study, String> {
    let path = folder.join("study.toml");
    std::fs::write(&path, format!("base = \"model.toml\"\n{text}")).expect("a file");
    let file = StudyFile::load(&path, None).map_err(|error| error.to_string())?;
    Study::new(file).map_err(|error| error.to_string())
}

fn go(study: &Study, out: &Path, settings: &RunSettings) -> bool {
    run(study, out, settings, &|| false, &|_| {}, &|_| {})
        .expect("a run")
        .complete
}

fn numbers(study: &Study, out: &Path, column: &str) -> Vec<Option<f64>> {
    let table = read_columns(study, out, &[column]).expect("the table");
    table.column(column).to_vec()
}

const INVENTORY: &str = "gap[0].width,building.A.mass,building.B.name,motion.period
4 mm,40 t,B,0.5 s
0.006,,Hotel,0.4
0.009,55 t,\"Tower, east\",\"0.6 s\"
";

/// Each row of a table is a case: the same results as with lists beside each other, the same from CSV and from Parquet. An empty
/// cell keeps the value of the model.
#[test]
fn rows_of_a_table_are_cases() {
    let held = folder();
    let folder = held.path();
    std::fs::write(folder.join("inventory.csv"), INVENTORY).expect("a file");
    let texts = |list: [&str; 3]| Values::Text(list.map(str::to_owned).to_vec());
    let columns = vec![
        (
            "gap[0].width".to_owned(),
            Values::Real(vec![0.004, 0.006, 0.009]),
        ),
        (
            "building.A.mass".to_owned(),
            Values::Instant(vec![Some(40e3), None, Some(55e3)]),
        ),
        (
            "building.B.name".to_owned(),
            texts(["B", "Hotel", "Tower, east"]),
        ),
        (
            "motion.period".to_owned(),
            Values::Real(vec![0.5, 0.4, 0.6]),
        ),
        ("note".to_owned(), texts(["", "", ""])),
    ];
    write_values_parquet(&folder.join("inventory.parquet"), "inventory", &[], columns)
        .expect("a table");
    let lists = r#"
[design]
kind = "zipped"
[[vary]]
path = "gap[0].width"
values = [0.004, 0.006, 0.009]
[[vary]]
path = "building.A.mass"
values = [40e3, 40e3, 55e3]
[[vary]]
path = "motion.period"
values = [0.5, 0.4, 0.6]
"#;
    let from_csv = "[[vary]]\ntable = \"inventory.csv\"\ncolumns = [\"gap[0].width\", \"building.A.mass\", \"motion.period\"]\n";
    let from_parquet = from_csv.replace(".csv", ".parquet");
    let mut found = Vec::new();
    for (index, text) in [lists, from_csv, &from_parquet].into_iter().enumerate() {
        let study = load(folder, text).expect("a study");
        assert_eq!(study.design.cases, 3);
        let out = folder.join(format!("out{index}"));
        assert!(go(&study, &out, &RunSettings::default()));
        let inputs = [
            numbers(&study, &out, &study.layout.inputs[0].name),
            numbers(&study, &out, "motion.period_s"),
        ];
        found.push((
            inputs,
            numbers(&study, &out, "peak_force_n"),
            numbers(&study, &out, "closing_peak_m"),
        ));
        assert!(found[index].1.iter().flatten().any(|force| *force > 0.0));
        assert_eq!(found[index], found[0], "{text}");
    }
    // Crossed with a list, which varies fastest; a column of texts.
    let crossed = "[[vary]]\ntable = \"inventory.csv\"\ncolumns = [\"building.B.name\", \"gap[0].width\"]\n[[vary]]\npath = \"motion.amplitude\"\nvalues = [1.0, 2.0]\n";
    let study = load(folder, &crossed.replace("\"building.B.name\", ", "")).expect("a study");
    let out = folder.join("crossed");
    assert!(go(&study, &out, &RunSettings::default()));
    let widths = numbers(&study, &out, &study.layout.inputs[0].name);
    assert_eq!(widths, [0.004, 0.004, 0.006, 0.006, 0.009, 0.009].map(Some));
    // A change of the table is another study.
    std::fs::write(
        folder.join("inventory.csv"),
        INVENTORY.replace("0.009", "8 mm"),
    )
    .expect("a file");
    let other = load(folder, &crossed.replace("\"building.B.name\", ", "")).expect("a study");
    assert_ne!(other.fingerprint, study.fingerprint);
}

/// Faults of tables name the line of the study file and the remedy.
#[test]
fn faults_of_tables_are_told() {
    let held = folder();
    let folder = held.path();
    let vary = "[[vary]]\ntable = \"inventory.csv\"\n";
    let morris = format!("[design]\nkind = \"morris\"\nsamples = 4\n{vary}");
    for (table, study, parts) in [
        (
            None,
            vary,
            ["study.toml:3", "inventory.csv: cannot be read"],
        ),
        (
            Some("gap[0].width\n"),
            vary,
            ["study.toml:3", "has no rows"],
        ),
        (
            Some("gap[0].width\n1 mm\n"),
            &morris,
            ["study.toml:6", "cannot be moved one by one"],
        ),
        (
            Some("gap[0].breadth\n1 mm\n"),
            vary,
            ["study.toml:3", "breadth"],
        ),
        (
            Some("gap[0].width\n-1 mm\n"),
            vary,
            ["study.toml:3", "gap[0].width"],
        ),
        (
            Some("gap[0].width\n1 mm\n"),
            "[[vary]]\ntable = \"inventory.csv\"\ncolumns = [\"pga\"]\n",
            ["study.toml:4", "no column \"pga\""],
        ),
        (
            Some("gap[0].width\n1 mm\n"),
            "[[vary]]\ntable = \"inventory.csv\"\npath = \"gap[0].width\"\n",
            ["study.toml:4", "cannot be combined with table"],
        ),
    ] {
        let path = folder.join("inventory.csv");
        match table {
            Some(text) => std::fs::write(&path, text).expect("a file"),
            None => drop(std::fs::remove_file(&path)),
        }
        let problem = load(folder, study).err().expect("a fault");
        for part in parts {
            assert!(problem.contains(part), "{part}: {problem}");
        }
    }
}

const SAMPLED: &str = r#"
[design]
kind = "sobol"
samples = 64
seed = 3
[[vary]]
name = "gap"
path = "gap[0].width"
distribution = { kind = "uniform", from = "1 mm", to = "9 mm" }
[[vary]]
path = "building.A.mass"
multiply = true
distribution = { kind = "uniform", from = 0.8, to = 1.2 }
"#;

/// A part alone looks at no other file of the folder; the last run does. Rows are the same.
#[test]
fn a_part_is_computed_alone() {
    let held = folder();
    let study = load(held.path(), SAMPLED).expect("a study");
    let (whole, parts) = (held.path().join("whole"), held.path().join("parts"));
    assert!(go(&study, &whole, &RunSettings::default()));
    for part in (0..study.parts()).rev() {
        let only = RunSettings {
            only: Some(part),
            ..RunSettings::default()
        };
        assert!(go(&study, &parts, &only));
        if part == study.parts() - 1 {
            // It stays where it is until a run of the whole study comes by.
            std::fs::write(parts.join("cases/stranger.parquet"), "x").expect("a file");
        }
        assert!(parts.join("cases/stranger.parquet").exists());
        assert_eq!(missing_parts(&study, &parts).len() as u64, part);
    }
    assert!(go(&study, &parts, &RunSettings::default()));
    assert!(!parts.join("cases/stranger.parquet").exists());
    for part in 0..study.parts() {
        let [one, other] = [&whole, &parts].map(|folder| {
            std::fs::read(part_path(folder, study.part(part).start)).expect("a part")
        });
        assert!(one == other, "part {part}");
    }
}

/// What was verified is not read again, and every change of a file is noticed.
#[test]
fn parts_are_verified_once_and_again_after_a_change() {
    let held = folder();
    let study = load(held.path(), SAMPLED).expect("a study");
    let out = held.path().join("out");
    assert!(go(&study, &out, &RunSettings::default()));
    let path = part_path(&out, 0);
    let old = std::time::SystemTime::now() - std::time::Duration::from_secs(60);
    let set_time = || {
        let file = std::fs::File::options()
            .write(true)
            .open(&path)
            .expect("a part");
        file.set_modified(old).expect("a time");
    };
    set_time();
    let first = numbers(&study, &out, "peak_force_n");
    assert_eq!(numbers(&study, &out, "peak_force_n"), first);
    let mut bytes = std::fs::read(&path).expect("a part");
    let middle = bytes.len() / 2;
    bytes[middle] ^= 1;
    std::fs::write(&path, &bytes).expect("a part");
    assert!(read_columns(&study, &out, &["peak_force_n"]).is_err());
    assert_eq!(missing_parts(&study, &out), [0]);
}

/// A sampled study has dots, means and a ranking: of two inputs that of the gap matters to the number of impacts.
#[test]
fn sampled_studies_have_figures() {
    let held = folder();
    let study = load(held.path(), SAMPLED).expect("a study");
    let out = held.path().join("out");
    assert!(go(&study, &out, &RunSettings::default()));
    finish(&study, &out, false).expect("a page");
    let page = std::fs::read_to_string(out.join("report.html")).expect("a page");
    for text in [
        "Results against inputs",
        "16th to 84th percentile",
        "Rank correlation (Spearman)",
    ] {
        assert!(page.contains(text), "{text}");
    }
    let ranking = std::fs::read_to_string(out.join("sensitivity.csv")).expect("a table");
    assert!(
        ranking.starts_with("response,factor,first_order,"),
        "{ranking}"
    );
    assert!(
        ranking.contains("impact_count,gap,") && ranking.contains("rank_correlation"),
        "{ranking}"
    );
    assert!(out.join("cases.csv").exists());
}
