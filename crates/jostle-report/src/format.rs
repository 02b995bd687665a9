//! Number formats of the pages: few digits, suitable prefixes, never "NaN".

use jostle::quantity::Shown as Peak;
pub(crate) use jostle_io::shown::*;

/// Shown instead of a missing number.
pub(crate) const NOTHING: &str = "–";

/// `value` with `digits` significant digits.
pub(crate) fn significant(value: f64, digits: i32) -> String {
    if !value.is_finite() {
        return NOTHING.into();
    }
    if value == 0.0 {
        return "0".into();
    }
    // Rounding first: 999.96 with four digits has one digit more before the point.
    let rounded: f64 = format!("{:.*e}", digits.max(1) as usize - 1, value)
        .parse()
        .unwrap_or(value);
    let exponent = rounded.abs().log10().floor() as i32;
    if !(-4..7).contains(&exponent) {
        let mantissa = rounded / 10f64.powi(exponent);
        return format!(
            "{}\u{202f}×\u{202f}10{}",
            fixed(mantissa, (digits - 1).max(0) as usize),
            superscript(exponent)
        );
    }
    fixed(rounded, (digits - 1 - exponent).max(0) as usize)
}

/// `value` with at most `digits` significant digits and no trailing zeros: for what the user typed.
pub(crate) fn plain(value: f64, digits: i32) -> String {
    let text = significant(value, digits);
    match text.split_once("\u{202f}×") {
        Some((mantissa, power)) => format!("{}\u{202f}×{power}", without_zeros(mantissa)),
        None => without_zeros(&text).to_owned(),
    }
}

fn without_zeros(text: &str) -> &str {
    if text.contains('.') {
        text.trim_end_matches('0').trim_end_matches('.')
    } else {
        text
    }
}

/// `value` with a given number of decimals, a true minus sign and thin spaces between thousands.
pub(crate) fn fixed(value: f64, decimals: usize) -> String {
    if !value.is_finite() {
        return NOTHING.into();
    }
    let text = format!("{:.*}", decimals, value.abs());
    let (whole, fraction) = text.split_once('.').unwrap_or((&text, ""));
    let mut grouped = String::new();
    for (i, digit) in whole.chars().enumerate() {
        if i > 0 && (whole.len() - i) % 3 == 0 && whole.len() > 4 {
            grouped.push('\u{202f}');
        }
        grouped.push(digit);
    }
    let is_zero = text.bytes().all(|b| matches!(b, b'0' | b'.'));
    let sign = if value < 0.0 && !is_zero {
        "\u{2212}"
    } else {
        ""
    };
    match fraction {
        "" => format!("{sign}{grouped}"),
        _ => format!("{sign}{grouped}.{fraction}"),
    }
}

fn superscript(exponent: i32) -> String {
    exponent
        .to_string()
        .chars()
        .map(|c| match c {
            '-' => '⁻',
            '1' => '¹',
            '2' => '²',
            '3' => '³',
            '0' => '⁰',
            other => char::from_u32('⁰' as u32 + other as u32 - '0' as u32).unwrap_or(other),
        })
        .collect()
}

/// A value in the largest unit that leaves at least one digit before the point.
fn prefixed(value: f64, digits: i32, units: &[(f64, &str)]) -> String {
    if !value.is_finite() {
        return NOTHING.into();
    }
    let fitting = units
        .iter()
        .rev()
        .find(|(size, _)| value.abs() >= *size)
        .or(units.first());
    match fitting {
        Some((size, unit)) => format!("{}\u{a0}{unit}", significant(value / size, digits)),
        None => significant(value, digits),
    }
}

/// A stated value in the largest fitting unit, without trailing zeros.
fn prefixed_plain(value: f64, units: &[(f64, &str)]) -> String {
    let text = prefixed(value, 4, units);
    match text.split_once('\u{a0}') {
        Some((number, unit)) => format!("{}\u{a0}{unit}", without_zeros(number)),
        None => text,
    }
}

/// A number in the unit of what is shown, with so many decimals in SI units and enough in others.
pub(crate) fn in_unit(shown: Shown, si: f64, decimals: usize) -> String {
    fixed(shown.of(si), shown.decimals(decimals))
}

/// A value with significant digits and its unit.
pub(crate) fn short(shown: Shown, si: f64, digits: i32) -> String {
    unit(significant(shown.of(si), digits), shown.name())
}

/// The same without trailing zeros: for what the user typed.
fn stated(shown: Shown, si: f64) -> String {
    unit(plain(shown.of(si), 4), shown.name())
}

/// Unit of a peak in tables.
pub(crate) fn unit_of(peak: Peak) -> &'static str {
    Shown::named(peak.unit).map_or(peak.unit, Shown::name)
}

/// The number of a peak in tables.
pub(crate) fn shown_peak(peak: Peak, si: f64) -> String {
    match Shown::named(peak.unit) {
        Some(quantity) if is_us() => in_unit(quantity, si, peak.decimals),
        _ => fixed(peak.factor * si, peak.decimals),
    }
}

/// A stated number with its unit, which has this SI name.
pub(crate) fn exact(si: f64, unit: &str) -> String {
    let (factor, unit) = factor_of(unit);
    format!("{} {}", plain(si * factor, 3), typeset(unit))
}

/// Factor to the unit that is shown, and its name, of a unit without prefix.
pub(crate) fn factor_of(unit: &str) -> (f64, &str) {
    Shown::named(unit).map_or((1.0, unit), |quantity| (quantity.of(1.0), quantity.name()))
}

/// The constant of a dashpot whose force grows with a power of speed \[N·(s/m)^exponent\], and its unit.
pub(crate) fn dashpot(si: f64, exponent: f64) -> (f64, String) {
    if exponent == 1.0 {
        return (DASHPOT.of(si), DASHPOT.name().to_owned());
    }
    power_dashpot(si, exponent)
}

/// The same as a text.
pub(crate) fn dashpot_in_words(si: f64, exponent: f64) -> String {
    if exponent == 1.0 {
        return linear_dashpot(si);
    }
    let (value, unit) = dashpot(si, exponent);
    format!("{} {unit}", plain(value, 3))
}

/// The constant of a linear dashpot \[N·s/m\].
pub(crate) fn linear_dashpot(si: f64) -> String {
    if is_us() {
        return short(DASHPOT, si, 4);
    }
    prefixed_plain(
        si,
        &[
            (1.0, "N·s/m"),
            (1e3, "kN·s/m"),
            (1e6, "MN·s/m"),
            (1e9, "GN·s/m"),
        ],
    )
}

/// A written number with thin spaces between thousands, from ten thousand on, and what follows it as it is.
pub(crate) fn grouped(text: &str) -> String {
    let sign = text.len() - text.trim_start_matches(['-', '−']).len();
    let digits = text[sign..].bytes().take_while(u8::is_ascii_digit).count();
    let (whole, rest) = text[sign..].split_at(digits);
    match whole.parse::<f64>() {
        Ok(value) if digits > 4 => format!("{}{}{rest}", &text[..sign], fixed(value, 0)),
        _ => text.to_owned(),
    }
}

/// Typed quantities as they are printed: `1 m/s2 … 2e9 N/m^1.5` is `1 m/s² … 2 × 10⁹ N/m¹·⁵`, `30 deg` is `30°`.
#[must_use]
pub fn typeset(text: &str) -> String {
    let word = |word: &str| {
        let (number, end) = match word.strip_suffix(',') {
            Some(number) => (number, ","),
            None => (word, ""),
        };
        match number.parse::<f64>() {
            Ok(value) if number.contains(['e', 'E']) => format!("{}{end}", plain(value, 4)),
            Ok(_) => grouped(word),
            _ => word.to_owned(),
        }
    };
    let words: Vec<String> = text.split(' ').map(word).collect();
    let signs = [
        ("N.s/m", "N·s/m"),
        ("^1.5", "¹·⁵"),
        ("m/s2", "m/s²"),
        ("^2", "²"),
        (" deg", "°"),
    ];
    let joined = words.join(" ");
    signs.into_iter().fold(joined, |text, (typed, printed)| {
        text.replace(typed, printed)
    })
}

fn is_us() -> bool {
    units() == Units::Us
}

/// A force; kN up to a hundred meganewton \[N\].
pub(crate) fn force(newton: f64) -> String {
    if is_us() {
        return short(FORCE, newton, 4);
    }
    prefixed(newton, 4, &[(1.0, "N"), (1e3, "kN"), (1e8, "MN")])
}

/// An energy \[J\].
pub(crate) fn energy(joule: f64) -> String {
    if is_us() {
        return short(ENERGY, joule, 4);
    }
    prefixed(joule, 4, &[(1.0, "J"), (1e3, "kJ"), (1e6, "MJ")])
}

/// A length of the order of a gap, in millimetres or inches \[m\].
pub(crate) fn millimetres(metre: f64) -> String {
    if is_us() {
        let value = LENGTH.of(metre);
        let decimals = if value != 0.0 && value.abs() < 0.1 {
            4
        } else {
            2
        };
        let text = fixed(value, decimals);
        // A round width stays round: "4 in"; beside others "4.60 in".
        let text = text.strip_suffix(".00").unwrap_or(&text);
        return unit(text.to_owned(), LENGTH.name());
    }
    let value = metre * 1e3;
    let decimals = match value.abs() {
        v if v >= 1000.0 => 0,
        v if v >= 1.0 || v == 0.0 => 1,
        _ => 3,
    };
    let text = fixed(value, decimals);
    // A round width stays round: "100 mm", not "100.0 mm".
    unit(without_zeros(&text).to_owned(), "mm")
}

/// An instant, to the millisecond \[s\].
pub(crate) fn instant(second: f64) -> String {
    unit(fixed(second, 3), "s")
}

/// A duration in milliseconds \[s\].
pub(crate) fn milliseconds(second: f64) -> String {
    unit(plain(second * 1e3, 3), "ms")
}

/// A mass in tonnes, or its weight in kip \[kg\].
pub(crate) fn tonnes(kilogram: f64) -> String {
    stated(MASS, kilogram)
}

/// A flexural rigidity \[N·m²\].
pub(crate) fn rigidity(value: f64) -> String {
    if is_us() {
        return short(RIGIDITY, value, 4);
    }
    prefixed_plain(
        value,
        &[
            (1.0, "N·m²"),
            (1e3, "kN·m²"),
            (1e6, "MN·m²"),
            (1e9, "GN·m²"),
        ],
    )
}

/// A lateral stiffness \[N/m\].
pub(crate) fn stiffness(value: f64) -> String {
    if is_us() {
        return short(STIFFNESS, value, 4);
    }
    prefixed_plain(
        value,
        &[(1.0, "N/m"), (1e3, "kN/m"), (1e6, "MN/m"), (1e9, "GN/m")],
    )
}

/// An acceleration in m/s² and in percent of g \[m/s²\].
pub(crate) fn acceleration(value: f64) -> String {
    if !value.is_finite() {
        return NOTHING.into();
    }
    if is_us() {
        return short(ACCELERATION, value, 3);
    }
    format!(
        "{} ({}\u{a0}%\u{a0}g)",
        short(ACCELERATION, value, 3),
        significant(value / STANDARD_GRAVITY * 100.0, 3)
    )
}

/// A number with its unit, or a dash.
pub(crate) fn unit(number: String, unit: &str) -> String {
    if number == NOTHING {
        number
    } else {
        format!("{number}\u{a0}{unit}")
    }
}

pub(crate) use jostle::statics::STANDARD_GRAVITY;

/// A text as it begins a sentence.
/// A ratio in per cent.
pub(crate) fn percent(ratio: f64) -> String {
    unit(fixed(100.0 * ratio, 1), "%")
}

pub(crate) fn capital(text: &str) -> String {
    let mut letters = text.chars();
    let first = letters.next();
    let first = first.into_iter().flat_map(char::to_uppercase);
    first.chain(letters).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn digits_follow_the_size() {
        for (value, text) in [
            (1282.85, "1283"),
            (188.81, "188.8"),
            (999.96, "1000"),
            (0.012345, "0.01235"),
            (-0.5, "−0.5000"),
            (123_456.0, "123\u{202f}500"),
            (1.5e-9, "1.500\u{202f}×\u{202f}10⁻⁹"),
            (2e9, "2.000\u{202f}×\u{202f}10⁹"),
            (0.0, "0"),
            (f64::NAN, "–"),
            (f64::INFINITY, "–"),
        ] {
            assert_eq!(significant(value, 4), text, "{value} with four digits");
        }
    }

    #[test]
    fn stated_values_keep_no_zeros() {
        for (value, text) in [
            (3.2, "3.2"),
            (100.0, "100"),
            (2e9, "2\u{202f}×\u{202f}10⁹"),
            (0.002_13, "0.00213"),
        ] {
            assert_eq!(plain(value, 4), text, "{value} as stated");
        }
        assert_eq!(rigidity(81e6), "81\u{a0}MN·m²");
    }

    #[test]
    fn typed_quantities_are_typeset() {
        for (typed, printed) in [
            ("1 m/s2 … 220 cm/s2", "1 m/s² … 220 cm/s²"),
            (
                "2e9 N/m^1.5, 4e9 N/m^1.5",
                "2\u{202f}×\u{202f}10⁹ N/m¹·⁵, 4\u{202f}×\u{202f}10⁹ N/m¹·⁵",
            ),
            ("0 deg … 330 deg (12 values)", "0° … 330° (12 values)"),
            ("el-centro", "el-centro"),
        ] {
            assert_eq!(typeset(typed), printed);
        }
    }

    #[test]
    fn units_follow_the_size() {
        assert_eq!(force(1_282_850.0), "1283\u{a0}kN");
        assert_eq!(force(12.0), "12.00\u{a0}N");
        assert_eq!(energy(2.5e6), "2.500\u{a0}MJ");
        assert_eq!(millimetres(0.1), "100\u{a0}mm");
        assert_eq!(millimetres(-0.0135), "−13.5\u{a0}mm");
        assert_eq!(force(f64::NAN), "–");
    }
}
