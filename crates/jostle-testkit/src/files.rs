//! Reading of model files.

use std::path::Path;

use jostle_io::{Format, Input, InputError, read_model_text};

/// Reads the text of a model file.
///
/// # Errors
/// The faults of the text.
pub fn read(text: &str) -> Result<Input, InputError> {
    read_model_text("model.toml", text, Format::Toml, Path::new(""))
}

/// Reads a text that must be sound.
///
/// # Panics
/// If it is not.
#[must_use]
#[track_caller]
pub fn sound(text: &str) -> Input {
    read(text).unwrap_or_else(|error| panic!("{error}\nin\n{text}"))
}

/// The message for a text that must be refused.
///
/// # Panics
/// If it is not.
#[must_use]
#[track_caller]
pub fn refusal(text: &str) -> String {
    match read(text) {
        Ok(_) => panic!("this should be refused:\n{text}"),
        Err(error) => error.to_string(),
    }
}
