//! Damaged inputs of every kind: none panics. `JOSTLE_SCAN` sets how many are tried, `JOSTLE_SEED` which.

use std::panic::{AssertUnwindSafe, catch_unwind};
use std::path::Path;

use jostle_io::{Format, StudyFile};
use jostle_study::{RunSettings, Study, run};
use jostle_testkit::scan::{Dice, scanned};

use crate::inputs;

const PATHS: &str = "building.J1.column[*].width";
const MAP: &str = r#"
table_acceleration = "A0"
reverse = true
low_pass = "20 Hz"
start = "1 s"
end = "9 s"
[[column]]
measured = "D1"
computed = "J1.floor5.displacement_m"
relative_to = "D0"
reverse = true
zero = "0.5 s"
[[column]]
measured = 3
computed = "J2.floor5.displacement_m"
[[impacts]]
acceleration = "A1"
above = "2 g"
contact = "J1-J2.floor5-5"
window = "20 ms"
separation = "50 ms"
[[impacts]]
sensor = "C1"
level = 2.5
[[impacts]]
closing = ["D1", "D2"]
width = "20 mm"
"#;
const EXPRESSION: &str = "gap[0].width=10mm..200mm\ngap0.width_m + 0.1*peak_force_n/1e6\nimpact_count == 0\nJ1.drift_peak <= 0.01\n";
const STUDY: &str = r#"
histories = [0, 2]
[[vary]]
name = "gap"
path = "gap[0].width"
range = { from = "5 mm", to = "200 mm", count = 3, spacing = "log" }
[[vary]]
path = ["building.J1.damping", "building.J2.damping"]
distribution = { kind = "lognormal", median = 0.04, dispersion = 0.3, low = 0.01, high = 0.2 }
[design]
samples = 2
seed = 1
correlation = []
[[fragility]]
intensity = "pga_m_s2"
demand = "peak_force_n"
threshold = "1 MN"
"#;
const SPECTRUM: &str =
    "# unit = g\n# damping = 0.05\n0.01, 0.4\n0.1, 0.9\n0.5, 0.9\n1.0, 0.45\n4.0, 0.05\n";

fn count() -> usize {
    scanned(300) / 6
}

fn scan(sequence: u64, seed: &[u8], share: usize, try_one: &dyn Fn(&[u8])) {
    let mut dice = Dice::new(sequence);
    for _ in 0..count() / share {
        let damaged = dice.damage(seed);
        let survived = catch_unwind(AssertUnwindSafe(|| try_one(&damaged)));
        assert!(
            survived.is_ok(),
            "a panic with\n{}",
            String::from_utf8_lossy(&damaged)
        );
    }
}

/// What is damaged is in order before.
#[test]
fn texts_are_in_order_before_they_are_damaged() {
    let map = jostle_io::ComparisonMap::parse("map.toml", MAP, Format::Toml);
    assert!(map.is_ok(), "{map:?}");
    let base = jostle_io::ModelTree::builtin("paper").expect("a model");
    let study = StudyFile::parse("s.toml", STUDY, Format::Toml, Path::new(""), Some(base));
    assert!(study.is_ok(), "{study:?}");
}

#[test]
fn damaged_texts_are_refused_or_used() {
    let paper = jostle_io::model_text("paper").expect("a model");
    let records = paper.replacen(
        "record = \"el-centro-1940-ns\"",
        "record = [\"el-centro-1940-ns\", \"taft.at2\"]",
        1,
    );
    let folder = tempfile::tempdir().expect("a folder");
    scan(1, PATHS.as_bytes(), 1, &inputs::path);
    scan(2, MAP.as_bytes(), 1, &inputs::map);
    scan(3, EXPRESSION.as_bytes(), 4, &inputs::expression);
    scan(4, STUDY.as_bytes(), 4, &inputs::study);
    scan(5, records.as_bytes(), 4, &inputs::suite);
    scan(6, SPECTRUM.as_bytes(), 1, &|bytes| {
        inputs::spectrum(folder.path(), bytes);
    });
}

/// Manifest, part and journal of a folder, one of them damaged.
#[test]
fn damaged_folders_are_refused_or_used() {
    let text = "base = \"paper\"\n[[vary]]\npath = \"gap[0].width\"\nvalues = [\"90 mm\", \"95 mm\"]\n[[vary]]\npath = \"motion.duration\"\nvalues = [\"1 s\", \"2 s\"]\n";
    let file =
        StudyFile::parse("study.toml", text, Format::Toml, Path::new(""), None).expect("a study");
    let study = Study::new(file).expect("a study");
    let held = tempfile::tempdir().expect("a folder");
    let folder = held.path();
    let done = run(
        &study,
        folder,
        &RunSettings::default(),
        &|| false,
        &|_| {},
        &|_| {},
    );
    assert!(done.expect("a run").complete);
    for (index, name) in ["manifest.json", "cases/part-0000000000.parquet"]
        .into_iter()
        .enumerate()
    {
        let whole = std::fs::read(folder.join(name)).expect("a file");
        scan(10 + index as u64, &whole, 8, &|bytes| {
            inputs::results(folder, name, bytes);
        });
        std::fs::write(folder.join(name), &whole).expect("a file");
    }
    let mut dice = Dice::new(12);
    for _ in 0..count() / 8 {
        std::fs::create_dir_all(folder.join("under-way")).expect("a folder");
        let bytes = dice.damage(&[7; 200]);
        inputs::results(folder, "under-way/part-0000000000.journal", &bytes);
        let again = run(
            &study,
            folder,
            &RunSettings::default(),
            &|| false,
            &|_| {},
            &|_| {},
        );
        assert!(again.expect("a run").complete);
    }
}
