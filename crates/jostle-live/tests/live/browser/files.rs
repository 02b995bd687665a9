//! Files of the page.

use super::{open, short};
use std::path::Path;

#[test]
fn files_are_kept() {
    let Some(page) = open(short(), 1400, 1000) else {
        return;
    };
    page.value("window.files = []; URL.createObjectURL = (blob) => { blob.text().then((text) => window.files.push(text)); return 'about:blank#'; }; HTMLAnchorElement.prototype.click = function () { window.files.name = this.download; }");
    page.type_into("gap[0].width", "55 mm");
    page.click("save-model");
    page.wait("window.files.length === 1");
    let model = page.text("window.files[0]");
    assert!(
        model.contains("width = \"55 mm\"") && model.contains('#'),
        "comments stay"
    );
    assert!(
        jostle_io::read_model_text("saved", &model, jostle_io::Format::Toml, Path::new("")).is_ok()
    );
    page.value("document.getElementById('save-study').click()");
    page.wait("window.files.length === 2");
    let study = page.text("window.files[1]");
    let base = jostle_io::ModelTree::parse("paper", &model, jostle_io::Format::Toml, Path::new(""))
        .unwrap();
    let rest = study
        .lines()
        .filter(|line| !line.starts_with("base ="))
        .collect::<Vec<_>>()
        .join("\n");
    let read = jostle_io::StudyFile::parse(
        "study",
        &rest,
        jostle_io::Format::Toml,
        Path::new(""),
        Some(base),
    );
    assert!(
        read.is_ok(),
        "{study}\n{:?}",
        read.err().map(|e| e.to_string())
    );
    page.value("document.getElementById('save-report').click()");
    page.wait("window.files.length === 3");
    let report = page.text("window.files[2]");
    assert!(report.starts_with("<!DOCTYPE html>") && report.contains("Seismic pounding report"));
    page.assert_content();
}
