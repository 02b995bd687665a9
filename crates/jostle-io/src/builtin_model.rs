//! Models that come with the program.

use crate::fault::InputError;
use crate::model_file::{Input, read_model_text};
use crate::tree::Format;

/// Names and texts of the built-in models.
const MODELS: &[(&str, &str)] = &[
    ("paper", include_str!("../data/paper.toml")),
    (
        "paper-inelastic",
        include_str!("../data/paper-inelastic.toml"),
    ),
];

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
/// If the name is unknown.
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
