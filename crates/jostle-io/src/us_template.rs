//! Templates in US customary units.

use jostle::statics::STANDARD_GRAVITY;

use crate::unit::Unit;

/// How a number is rounded.
#[derive(Clone, Copy)]
enum Rounding {
    /// Inches: whole ones, quarters below 6 and eighths below 1.
    Inches,
    /// To half a foot.
    Feet,
    /// To three digits.
    Digits,
}

/// SI units of templates with the unit in their place; a mass becomes its weight. Units that are missing here stay, such as `g`, `s` and
/// the `N/m^1.5` of contact laws, on which comments say more.
const UNITS: &[(&str, &str, Rounding)] = &[
    ("mm", "in", Rounding::Inches),
    ("m", "ft", Rounding::Feet),
    ("kN", "kip", Rounding::Digits),
    ("MN", "kip", Rounding::Digits),
    ("GN", "kip", Rounding::Digits),
    ("MN.m", "kip.ft", Rounding::Digits),
    ("MN.m2", "kip.ft2", Rounding::Digits),
    ("N.m/rad", "kip.ft/rad", Rounding::Digits),
    ("kN/m", "kip/ft", Rounding::Digits),
    ("MN/m", "kip/in", Rounding::Digits),
    ("kN.s/m", "kip.s/in", Rounding::Digits),
    ("MN.s/m", "kip.s/in", Rounding::Digits),
    ("MPa", "ksi", Rounding::Digits),
    ("GPa", "ksi", Rounding::Digits),
    ("kg/m", "lb/ft", Rounding::Digits),
    ("kg/m3", "pcf", Rounding::Digits),
    ("t", "kip", Rounding::Digits),
    ("m/s2", "ft/s2", Rounding::Digits),
    ("cm/s2", "in/s2", Rounding::Digits),
];

/// A template with its quoted quantities in US customary units, rounded, and results shown in them.
pub(crate) fn in_us_units(text: &str) -> String {
    let mut written: String = text.lines().map(|line| converted(line) + "\n").collect();
    const UNITS: &str = "units = \"us\"                    # texts and pages show in, ft and kip\n";
    match written.find("[output]\n") {
        Some(at) => written.insert_str(at + "[output]\n".len(), UNITS),
        None => written += &format!("\n[output]\n{UNITS}"),
    }
    written
}

/// A line with its quantities converted; a comment behind them stays in its column where it can.
fn converted(line: &str) -> String {
    let parts = line.split('"').enumerate();
    let parts = parts.map(|(index, part)| match index % 2 {
        1 => quantity(part).unwrap_or_else(|| part.to_owned()),
        _ => part.to_owned(),
    });
    let new = parts.collect::<Vec<_>>().join("\"");
    let Some((before, _)) = line.split_once("  #") else {
        return new;
    };
    let column = before.chars().count() + 2;
    let Some((code, comment)) = new.split_once("  #") else {
        return new;
    };
    let code = code.trim_end();
    format!(
        "{code:<width$}#{comment}",
        width = column.max(code.chars().count() + 2)
    )
}

/// A number and its unit in US units; `None` of other texts.
fn quantity(text: &str) -> Option<String> {
    let (number, unit) = text.split_once(' ')?;
    let number: f64 = number.parse().ok()?;
    let (_, us, rounding) = UNITS.iter().find(|candidate| candidate.0 == unit)?;
    let [from, to] = [unit, us].map(|unit| Unit::parse(unit).ok());
    let (from, to) = (from?, to?);
    let weight = match from.exponents == to.exponents {
        true => 1.0,
        false => STANDARD_GRAVITY,
    };
    let value = number * weight * from.factor / to.factor;
    Some(format!("{} {us}", rounded(value, *rounding)))
}

fn rounded(value: f64, rounding: Rounding) -> f64 {
    let to = |step: f64| (value / step).round() * step;
    match rounding {
        Rounding::Inches if value.abs() >= 6.0 => to(1.0),
        Rounding::Inches if value.abs() >= 1.0 => to(0.25),
        Rounding::Inches if value.abs() >= 0.125 => to(0.125),
        Rounding::Feet => to(0.5),
        Rounding::Inches | Rounding::Digits => {
            // Of a number with a power of ten.
            let digits = format!("{value:.2e}");
            digits.parse().unwrap_or(value)
        }
    }
}
