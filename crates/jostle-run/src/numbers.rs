//! Number formats.

use jostle_io::shown::{FORCE, LENGTH, Shown};

/// A whole number with thin spaces between thousands.
#[must_use]
pub fn grouped(number: u64) -> String {
    let digits = number.to_string();
    let mut text = String::new();
    for (index, digit) in digits.chars().enumerate() {
        if index > 0 && (digits.len() - index).is_multiple_of(3) {
            text.push('\u{202f}');
        }
        text.push(digit);
    }
    text
}

/// Metres as millimetres with one decimal, or as inches; [`LENGTH`] names the unit.
#[must_use]
pub fn mm(metres: f64) -> String {
    LENGTH.number(metres, 1)
}

/// Newtons as kilonewtons or kip with one decimal; [`FORCE`] names the unit.
#[must_use]
pub fn kn(newtons: f64) -> String {
    FORCE.number(newtons, 1)
}

/// A number with at most `digits` digits and the prefix of its unit, such as `400 MN/m`; outside of SI in the unit that is shown for this SI
/// unit. Very large and very small numbers, and units of broken powers such as `N/m^1.5`, have a power of ten.
pub(crate) fn prefixed(si: f64, unit: &str, digits: usize) -> String {
    let power = |value: f64, unit: &str| format!("{value:.*e} {unit}", digits - 1);
    let shown = Shown::named(unit).filter(|candidate| candidate.name() != candidate.si_name());
    let (value, unit) = shown.map_or((si, unit), |shown_unit| {
        (shown_unit.of(si), shown_unit.name())
    });
    let exponent = format!("{value:.*e}", digits - 1);
    let exponent = exponent
        .split_once('e')
        .and_then(|(_, exponent)| exponent.parse::<i32>().ok());
    let thousands = match (shown.is_some(), exponent) {
        _ if unit.contains('^') => return power(value, unit),
        (true, Some(-2..=5)) => 0,
        (false, Some(exponent @ 0..=12)) => (exponent / 3).min(3),
        _ => return power(value, unit),
    };
    let exponent = exponent.unwrap_or(0) - 3 * thousands;
    let decimals = (digits as i32 - 1 - exponent).max(0) as usize;
    let text = format!("{:.decimals$}", value / 1e3_f64.powi(thousands));
    let text = match text.contains('.') {
        true => text.trim_end_matches('0').trim_end_matches('.'),
        false => &text,
    };
    format!("{text} {}{unit}", ["", "k", "M", "G"][thousands as usize])
}

/// One thing or several.
#[must_use]
pub fn counted(count: usize, thing: &str) -> String {
    if count == 1 {
        format!("1 {thing}")
    } else {
        format!("{count} {thing}s")
    }
}

/// The same for large counts.
#[must_use]
pub fn counted_grouped(count: u64, thing: &str) -> String {
    let plural = if count == 1 { "" } else { "s" };
    format!("{} {thing}{plural}", grouped(count))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn units_have_prefixes() {
        assert_eq!(prefixed(4e8, "N/m", 4), "400 MN/m");
        assert_eq!(prefixed(1.8944e9, "N/m", 4), "1.894 GN/m");
        assert_eq!(prefixed(9.999e5, "N·s/m", 3), "1 MN·s/m");
        assert_eq!(prefixed(5.75e12, "N·m/rad", 3), "5750 GN·m/rad");
        assert_eq!(prefixed(2e10, "N/m^1.5", 4), "2.000e10 N/m^1.5");
        assert_eq!(prefixed(6e27, "N/m", 3), "6.00e27 N/m");
    }

    #[test]
    fn thousands_are_set_apart() {
        assert_eq!(grouped(7), "7");
        assert_eq!(grouped(1234), "1\u{202f}234");
        assert_eq!(grouped(1_000_000), "1\u{202f}000\u{202f}000");
        assert_eq!(
            counted(1, "impact") + &counted(0, "impact"),
            "1 impact0 impacts"
        );
    }
}
