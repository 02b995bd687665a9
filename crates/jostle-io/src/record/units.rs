//! Units of acceleration as record headers spell them.

use super::RecordOptions;
use super::error::RecordError;
use crate::quantity::{Dimension, parse_quantity, shorten};

/// Size of an acceleration unit in the many spellings of record headers: `G`, `CM/SEC/SEC`, `cm/sec**2`, `m_s2`,
/// `g/10`. `None` if it is not an acceleration.
pub(crate) fn acceleration_unit(text: &str) -> Option<f64> {
    let plain = text
        .trim()
        .trim_matches(|c: char| matches!(c, '(' | ')' | '[' | ']' | '.' | ',' | ';' | ':' | '"'))
        .to_lowercase()
        .replace("sec", "s")
        .replace("**", "^")
        .replace("m_s", "m/s")
        .replace("mps2", "m/s2")
        .replace("m/ss", "m/s/s");
    let (plain, part) = match plain.strip_suffix("/10") {
        Some(plain) => (plain.trim(), 0.1),
        None => (plain.as_str(), 1.0),
    };
    let size = parse_quantity(&format!("1 {plain}"), Dimension::Acceleration).ok()?;
    (!plain.is_empty() && size > 0.0).then_some(size * part)
}

/// The unit that the user adds, with its size.
pub(crate) fn option_unit(options: &RecordOptions) -> Result<Option<(String, f64)>, RecordError> {
    let Some(text) = &options.unit else {
        return Ok(None);
    };
    let size = acceleration_unit(text).ok_or_else(|| RecordError::OptionUnit {
        found: shorten(text),
    })?;
    Ok(Some((text.clone(), size)))
}
