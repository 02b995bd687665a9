//! Inputs beside models and records that come from outside: what is accepted can be used, the rest is refused in words. Fuzz targets use
//! the same functions.

use std::path::Path;

use jostle_io::{ComparisonMap, Format, ModelTree, StudyFile, TreeValue, read_target_file};
use jostle_study::dataset::read_columns;
use jostle_study::size::{SizeProblem, SizeRequest};
use jostle_study::{Study, of_folder, settle};

fn tree() -> ModelTree {
    ModelTree::builtin("paper").expect("the built-in model")
}

/// A path into a model.
pub(crate) fn path(bytes: &[u8]) {
    let text = String::from_utf8_lossy(bytes);
    let mut model = tree();
    for value in [TreeValue::Number(0.02), TreeValue::Text("20 mm".into())] {
        match model.set(&text, &value) {
            Ok(()) => drop(model.input()),
            Err(error) => assert!(!error.to_string().is_empty()),
        }
    }
    let _ = (model.multiply(&text, 2.0), model.values(&text));
}

/// The map of a comparison with measured histories.
pub(crate) fn map(bytes: &[u8]) {
    let text = String::from_utf8_lossy(bytes);
    for format in [Format::Toml, Format::Json] {
        if let Err(error) = ComparisonMap::parse("map.toml", &text, format) {
            assert!(!error.faults.is_empty());
        }
    }
}

/// Varied keys, conditions and the objective of a search, a line each.
pub(crate) fn expression(bytes: &[u8]) {
    let text = String::from_utf8_lossy(bytes);
    let mut lines = text.lines().map(str::to_owned);
    let request = SizeRequest {
        vary: vec![lines.next().unwrap_or_default()],
        minimise: lines.next().unwrap_or_default(),
        keep: lines.collect(),
        ..SizeRequest::default()
    };
    if let Err(error) = SizeProblem::new(tree(), &request) {
        assert!(!error.to_string().is_empty());
    }
}

/// A study file.
pub(crate) fn study(bytes: &[u8]) {
    let text = String::from_utf8_lossy(bytes);
    for format in [Format::Toml, Format::Json] {
        let base = Some(tree());
        match StudyFile::parse("study.toml", &text, format, Path::new("/nonexistent"), base) {
            Ok(file) => {
                if let Ok(study) = Study::new(file) {
                    for case in [0, study.design.cases / 2, study.design.cases - 1] {
                        let choices = study.design.choices(case, &study.file.factors);
                        let _ = study.tree(&choices).map(|tree| tree.input().is_ok());
                    }
                }
            }
            Err(error) => assert!(!error.faults.is_empty()),
        }
    }
}

/// A model of several records.
pub(crate) fn suite(bytes: &[u8]) {
    let text = String::from_utf8_lossy(bytes);
    let read = jostle_io::read_model_text("m.toml", &text, Format::Toml, Path::new("/nonexistent"));
    let Ok(input) = read else { return };
    if let Ok(opened) = jostle_run::Opened::new(input, "m") {
        let _ = jostle_study::suite::Suite::new(&opened, None).map_err(|error| error.to_string());
    }
}

/// A file of a design spectrum, in a folder that may be written.
pub(crate) fn spectrum(folder: &Path, bytes: &[u8]) {
    let path = folder.join("spectrum.csv");
    std::fs::write(&path, bytes).expect("a file");
    match read_target_file(&path) {
        Ok(target) => {
            for period in [0.0, 0.01, 0.5, 10.0] {
                if let Ok(value) = target.acceleration(period, 0.05) {
                    assert!(value.is_finite() && value >= 0.0, "{period}: {value}");
                }
            }
        }
        Err(error) => assert!(!error.to_string().is_empty()),
    }
}

/// A folder of results, one of whose files has these bytes.
pub(crate) fn results(folder: &Path, file: &str, bytes: &[u8]) {
    std::fs::write(folder.join(file), bytes).expect("a file");
    match of_folder(folder) {
        Ok(Some(study)) => {
            let _ = settle(&study, folder).map_err(|error| error.to_string());
            if let Ok(table) = read_columns(&study, folder, &["case", "peak_force_n", "status"]) {
                assert_eq!(table.rows as u64, study.design.cases);
            }
        }
        Ok(None) => {}
        Err(error) => assert!(!error.to_string().is_empty()),
    }
}
