//! Texts that were written in SI units, in those that hold: what `jostle` finds has no other unit.

use std::borrow::Cow;

use crate::shown::{ALL_SHOWN, Shown, Units, units};

/// What may stand between two numbers of one unit.
const BETWEEN: [&str; 3] = [" to ", " and ", " or "];

/// A sentence with its numbers in the units that hold: "the gap of 25.4 mm" becomes "the gap of 1.00 in". What stands in
/// quotation marks stays, and so do all sentences in SI units.
#[must_use]
pub fn in_shown_units(sentence: &str) -> Cow<'_, str> {
    if units() == Units::Si {
        return Cow::Borrowed(sentence);
    }
    let (mut converted, mut rest, mut quoted) = (String::new(), sentence, false);
    while let Some(next) = rest.chars().next() {
        quoted ^= next == '"';
        let begins =
            !converted.ends_with(|before: char| before.is_alphanumeric() || "._[".contains(before));
        if let Some((text, length)) = Some(rest)
            .filter(|_| !quoted && begins && next.is_ascii_digit())
            .and_then(quantity)
        {
            converted.push_str(&text);
            rest = &rest[length..];
            continue;
        }
        converted.push(next);
        rest = &rest[next.len_utf8()..];
    }
    Cow::Owned(converted)
}

/// The quantity that a text begins with, converted, and its length: one number or two of them with their unit.
fn quantity(text: &str) -> Option<(String, usize)> {
    let first = number(text)?;
    let after = &text[first.len()..];
    if let Some(shown) = unit(after) {
        let length = first.len() + 1 + shown.si_name().len();
        return Some((
            format!("{} {}", convert(first, shown), shown.name()),
            length,
        ));
    }
    let word = BETWEEN.into_iter().find(|word| after.starts_with(word))?;
    let second = number(&after[word.len()..])?;
    let shown = unit(&after[word.len() + second.len()..])?;
    let numbers = [first, second].map(|number| convert(number, shown));
    let length = first.len() + word.len() + second.len() + 1 + shown.si_name().len();
    Some((format!("{} {}", numbers.join(word), shown.name()), length))
}

/// The number that a text begins with.
fn number(text: &str) -> Option<&str> {
    let digits =
        |text: &str| text.len() - text.trim_start_matches(|c: char| c.is_ascii_digit()).len();
    let mut length = digits(text);
    if text[length..].starts_with('.') && digits(&text[length + 1..]) > 0 {
        length += 1 + digits(&text[length + 1..]);
    }
    if text[length..].starts_with('e') && digits(&text[length + 1..]) > 0 {
        length += 1 + digits(&text[length + 1..]);
    }
    (length > 0).then_some(&text[..length])
}

/// The unit of a number that such a text follows.
fn unit(text: &str) -> Option<Shown> {
    let name = text.strip_prefix(' ')?;
    let fits = |shown: &&Shown| {
        name.strip_prefix(shown.si_name()).is_some_and(|after| {
            !after.starts_with(|next: char| next.is_alphanumeric() || "·/²³^".contains(next))
        })
    };
    ALL_SHOWN.iter().find(fits).copied()
}

/// A number as it is written, in the unit that holds.
fn convert(number: &str, shown: Shown) -> String {
    let si = number.parse::<f64>().unwrap_or(f64::NAN) * shown.si_size();
    let (mantissa, power) = number.split_once('e').unwrap_or((number, ""));
    let decimals = mantissa
        .split_once('.')
        .map_or(0, |(_, decimals)| decimals.len());
    match power {
        "" => shown.number(si, decimals),
        _ => format!("{:.decimals$e}", shown.of(si)),
    }
}

#[cfg(test)]
mod tests {
    use super::in_shown_units;
    use crate::shown::{Units, in_units};

    fn us(sentence: &str) -> String {
        in_units(Some(Units::Us), || in_shown_units(sentence).into_owned())
    }

    #[test]
    fn numbers_of_sentences_follow_the_units() {
        let gap = "J1 ↔ J2: a near miss: the gap of 25.4 mm closes by 2.5 mm without impact";
        assert_eq!(
            us(gap),
            "J1 ↔ J2: a near miss: the gap of 1.00 in closes by 0.10 in without impact"
        );
        assert_eq!(in_shown_units(gap), gap);
        assert_eq!(
            us("at 3.048 m, 4.448222e3 N"),
            "at 10.000 ft, 1.000000e0 kip"
        );
        assert_eq!(us("between 445 and 890 kN"), "between 100.0 and 200.1 kip");
        assert_eq!(
            us("floors have 400 to 2000 kg/m²."),
            "floors have 82 to 410 psf."
        );
        assert_eq!(us("12.0 t on 100 m²"), "26.5 kip on 1076 ft²");
    }

    #[test]
    fn what_is_no_quantity_stays() {
        for sentence in [
            "write \"gap 12 mm\"; storey 3 of 4, 5.0 % in 2.5 s",
            "f12 mm, level_tolerance = 4",
            "30 more and 5 metres",
            "12 mmm, 3 m⁴ and 0.5",
        ] {
            assert_eq!(us(sentence), sentence);
        }
    }
}
