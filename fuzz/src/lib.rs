//! What every fuzz target does: read, and check that what is accepted can be used.

use std::path::Path;
use std::sync::LazyLock;

use jostle_io::{
    Format, RecordContent, RecordFormat, RecordLayout, RecordOptions, parse_info, parse_record,
    read_model_text,
};

/// Options that complete what a file may leave open, so that fuzzing reaches behind these questions.
fn completing(format: Option<RecordFormat>) -> [RecordOptions; 3] {
    let bare = RecordOptions {
        format,
        ..RecordOptions::default()
    };
    let full = RecordOptions {
        unit: Some("gal".into()),
        step: Some(0.01),
        column: Some(2),
        component: Some("1".into()),
        scale: Some(1e-3),
        remove_mean: Some(true),
        format,
        ..RecordOptions::default()
    };
    let lines = RecordOptions {
        column: None,
        layout: RecordLayout {
            skip: Some(1),
            content: Some(RecordContent::Values),
            ..RecordLayout::default()
        },
        ..full.clone()
    };
    [bare, full, lines]
}

fn read(bytes: &[u8], format: Option<RecordFormat>) {
    for options in completing(format) {
        match parse_record(bytes, &options) {
            Ok(record) => {
                assert!((1e-6..=10.0).contains(&record.step));
                assert!(record.acceleration.len() >= 2);
                assert!(record.acceleration.iter().all(|a| a.abs() <= 100.0));
            }
            Err(error) => assert!(error.to_string().starts_with(':')),
        }
        if let Ok(info) = parse_info(bytes, &options) {
            assert!(info.channels.iter().all(|channel| channel.largest.is_finite()));
        }
    }
}

/// Reads a record in one format.
pub fn read_as(key: &str, bytes: &[u8]) {
    read(bytes, RecordFormat::from_key(key).ok());
}

/// Reads a record in the format that its content tells.
pub fn read_any(bytes: &[u8]) {
    read(bytes, None);
}

/// Reads a model file in both syntaxes.
pub fn read_model(bytes: &[u8]) {
    let text = String::from_utf8_lossy(bytes);
    for format in [Format::Toml, Format::Json] {
        if let Err(error) = read_model_text("m", &text, format, Path::new("/nonexistent")) {
            assert!(!error.faults.is_empty());
        }
    }
}

#[path = "../../crates/jostle-study/tests/studies/inputs.rs"]
mod inputs;

/// One of the kinds of [`inputs`]: path, map, expression, study, suite or spectrum.
pub fn read_input(kind: &str, bytes: &[u8]) {
    match kind {
        "path" => inputs::path(bytes),
        "map" => inputs::map(bytes),
        "expression" => inputs::expression(bytes),
        "study" => inputs::study(bytes),
        "suite" => inputs::suite(bytes),
        _ => inputs::spectrum(folder(), bytes),
    }
}

/// A folder that the targets of files write into.
fn folder() -> &'static Path {
    static FOLDER: LazyLock<tempfile::TempDir> =
        LazyLock::new(|| tempfile::tempdir().expect("a temporary folder"));
    FOLDER.path()
}

/// Damages one of the files of a folder of results.
pub fn read_results(bytes: &[u8]) {
    let Some((which, bytes)) = bytes.split_first() else {
        return;
    };
    let folder = folder();
    for inside in ["cases", "under-way"] {
        let _ = std::fs::create_dir_all(folder.join(inside));
    }
    let files = [
        "manifest.json",
        "cases/part-0000000000.parquet",
        "under-way/part-0000000000.journal",
    ];
    inputs::results(folder, files[usize::from(*which) % files.len()], bytes);
}
