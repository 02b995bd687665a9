//! Ground motions and models that come with the program.

use jostle::GroundMotion;

use crate::fault::InputError;
use crate::model_file::{Input, read_model_text};
use crate::record::{RecordOptions, parse_record};
use crate::tree::Format;

/// El Centro 1940, component NS, digitisation of Peknold.
const EL_CENTRO: &str = include_str!("../data/el-centro-1940-ns.csv");

/// Names and texts of the built-in models.
const MODELS: &[(&str, &str)] = &[("paper", include_str!("../data/paper.toml"))];

/// Names of the built-in ground motions.
#[must_use]
pub fn record_names() -> Vec<&'static str> {
    vec!["el-centro-1940-ns"]
}

/// A built-in ground motion, unscaled; `None` if there is none of that name.
#[must_use]
pub fn record(name: &str) -> Option<GroundMotion> {
    let name = name.trim().to_ascii_lowercase();
    if !matches!(name.as_str(), "el-centro-1940-ns" | "el-centro") {
        return None;
    }
    let record = parse_record(EL_CENTRO.as_bytes(), &RecordOptions::default()).ok()?;
    Some(GroundMotion::sampled(
        "el-centro-1940-ns",
        record.step,
        record.acceleration,
    ))
}

/// Names of the built-in models.
#[must_use]
pub fn model_names() -> Vec<&'static str> {
    MODELS.iter().map(|(name, _)| *name).collect()
}

/// Text of a built-in model.
#[must_use]
pub fn model_text(name: &str) -> Option<&'static str> {
    MODELS
        .iter()
        .find(|(known, _)| *known == name)
        .map(|(_, text)| *text)
}

/// Reads a built-in model.
///
/// # Errors
/// When there is none of that name.
pub fn builtin_model(name: &str) -> Result<Input, InputError> {
    let text = model_text(name).ok_or_else(|| {
        let names = model_names().join(", ");
        InputError::whole(
            name,
            "there is no built-in model of this name",
            Some(format!("built in: {names}")),
        )
    })?;
    read_model_text(name, text, Format::Toml, "".as_ref())
}
