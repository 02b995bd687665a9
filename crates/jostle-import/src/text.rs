//! Text of other programs: UTF-8 or Windows-1252, numbers with decimal points or commas, names compared without blanks.

use std::borrow::Cow;

/// The text of bytes: UTF-8, else Windows-1252, in which every byte is a character.
pub(crate) fn decode(bytes: &[u8]) -> Cow<'_, str> {
    match std::str::from_utf8(bytes) {
        Ok(text) => Cow::Borrowed(text.trim_start_matches('\u{feff}')),
        Err(_) => {
            encoding_rs::WINDOWS_1252
                .decode_without_bom_handling(bytes)
                .0
        }
    }
}

/// A finite number. A comma alone is a decimal comma; beside points, the last of the two separates decimals.
pub(crate) fn number(text: &str) -> Option<f64> {
    let text = text.trim();
    let plain = match (text.rfind(','), text.rfind('.')) {
        (None, _) => Cow::Borrowed(text),
        (Some(comma), point) if point.is_none_or(|point| point < comma) => {
            Cow::Owned(text.replace('.', "").replace(',', "."))
        }
        _ => Cow::Owned(text.replace(',', "")),
    };
    plain.parse().ok().filter(|value: &f64| value.is_finite())
}

/// Letters and digits in lower case, so that `Sum UX` is `SumUX`.
pub(crate) fn plain(text: &str) -> String {
    text.chars()
        .filter(|c| c.is_alphanumeric())
        .flat_map(char::to_lowercase)
        .collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_and_bytes() {
        assert_eq!(number("0,00254"), Some(0.00254));
        assert_eq!(number("1.234,5"), Some(1234.5));
        assert_eq!(number("1,234.5"), Some(1234.5));
        assert_eq!(number("-6e-06"), Some(-6e-6));
        for none in ["", "x", "inf", "NaN", "1,2,3"] {
            assert_eq!(number(none), None, "{none}");
        }
        assert_eq!(decode(b"A\x96B"), "A\u{2013}B");
        assert_eq!(plain("Load Case/Combo"), "loadcasecombo");
    }
}
