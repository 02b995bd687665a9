//! Units of acceleration as record headers spell them.

use super::RecordOptions;
use super::error::RecordError;
use crate::quantity::{Dimension, parse_quantity, shorten};
use crate::unit::Unit;
use jostle::statics::STANDARD_GRAVITY;

/// A unit without quotes, brackets and marks around it.
fn bare(text: &str) -> &str {
    let marks = |c: char| {
        c.is_whitespace()
            || matches!(
                c,
                '(' | ')' | '[' | ']' | '{' | '}' | '.' | ',' | ';' | ':' | '"' | '\''
            )
    };
    text.trim_matches(marks)
}

/// Size of an acceleration unit in the many spellings of record headers: `G`, `CM/SEC/SEC`, `cm/sec**2`, `m_s2`,
/// `g/10`, `mg`, `g's`, `gals`. `None` if it is not an acceleration.
pub(crate) fn acceleration_unit(text: &str) -> Option<f64> {
    let plain = bare(text)
        .to_lowercase()
        .replace('’', "'")
        .replace("sec", "s")
        .replace("**", "^")
        .replace("m_s", "m/s")
        .replace("mps2", "m/s2")
        .replace("m/ss", "m/s/s");
    if let Some(size) = in_gravity(&plain) {
        return Some(size * STANDARD_GRAVITY);
    }
    let plain = plain.strip_suffix("'s").unwrap_or(&plain);
    let (plain, part) = match plain.strip_suffix("/10") {
        Some(plain) => (plain.trim(), 0.1),
        None => (plain, 1.0),
    };
    let plain = match plain {
        "gals" => "gal",
        "gs" => "g",
        other => other,
    };
    let size = parse_quantity(&format!("1 {plain}"), Dimension::Acceleration).ok()?;
    (!plain.is_empty() && size > 0.0).then_some(size * part)
}

/// Parts of g that are no units of their own: the letter stands for gravity, not for gram.
fn in_gravity(plain: &str) -> Option<f64> {
    let squeezed: String = plain
        .chars()
        .filter(|c| !matches!(c, ' ' | '-' | '_'))
        .collect();
    let squeezed = squeezed.strip_suffix("'s").unwrap_or(&squeezed);
    match squeezed {
        "mg" | "mgs" | "millig" | "milligs" => Some(1e-3),
        "µg" | "μg" | "ug" | "microg" => Some(1e-6),
        "%g" | "%ofg" | "percentg" => Some(1e-2),
        _ => None,
    }
}

/// Whether a text is a unit of another quantity, such as `cm/s`.
pub(crate) fn is_other_unit(text: &str) -> bool {
    let plain = bare(text).to_lowercase().replace("sec", "s");
    !plain.is_empty()
        && acceleration_unit(text).is_none()
        && Unit::parse(&plain).is_ok_and(|unit| !unit.has_dimension([0.0; 3]))
}

/// Size of a unit of time in its spellings; `None` if it is none \[s\].
pub(crate) fn time_unit(text: &str) -> Option<f64> {
    let plain = bare(text).to_lowercase();
    match plain.as_str() {
        "s" | "sec" | "secs" | "second" | "seconds" | "sn" => Some(1.0),
        "ms" | "msec" | "millisecond" | "milliseconds" => Some(1e-3),
        "" => None,
        other => parse_quantity(&format!("1 {other}"), Dimension::Time).ok(),
    }
}

/// An error about a unit in the file: of another quantity, or unknown.
pub(crate) fn wrong_unit(line: usize, text: &str) -> RecordError {
    let found = shorten(text);
    if is_other_unit(text) {
        RecordError::Unit { line, found }
    } else {
        RecordError::UnknownUnit { line, found }
    }
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

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn units_are_understood_in_many_spellings() {
        let g = STANDARD_GRAVITY;
        for (text, size) in [
            ("g", g),
            ("G", g),
            ("(g)", g),
            ("g's", g),
            ("G’s", g),
            ("gs", g),
            ("[g]", g),
            ("\"g\"", g),
            ("mg", 1e-3 * g),
            ("milli-g", 1e-3 * g),
            ("millig", 1e-3 * g),
            ("milli g", 1e-3 * g),
            ("MG", 1e-3 * g),
            ("µg", 1e-6 * g),
            ("ug", 1e-6 * g),
            ("micro-g", 1e-6 * g),
            ("%g", 1e-2 * g),
            ("g/10", 0.1 * g),
            ("gal", 0.01),
            ("gals", 0.01),
            ("Gal", 0.01),
            ("gal's", 0.01),
            ("mgal", 1e-5),
            ("\"cm/s^2\"", 0.01),
            ("cm/s/s", 0.01),
            ("cm/sec**2", 0.01),
            ("CM/SEC/SEC", 0.01),
            ("cm/s²", 0.01),
            ("m/s/s", 1.0),
            ("m/s^2", 1.0),
            ("m/s²", 1.0),
            ("mm/s/s", 1e-3),
            ("in/sec^2", 0.0254),
            ("ft/s2", 0.3048),
        ] {
            let found =
                acceleration_unit(text).unwrap_or_else(|| panic!("{text} is not understood"));
            assert!(
                (found / size - 1.0).abs() < 1e-12,
                "{text}: {found}, not {size}"
            );
        }
        for text in ["", "cm/s", "cm", "s", "acc", "mgh", "%"] {
            assert_eq!(acceleration_unit(text), None, "{text}");
        }
        assert!(is_other_unit("cm/sec") && is_other_unit("(mm)"));
        assert!(!is_other_unit("ch 1") && !is_other_unit("mg") && !is_other_unit("raw"));
    }
}
