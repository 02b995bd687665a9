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
    /// To a thousandth of a foot: differences of such lengths are gaps.
    Places,
}

/// SI units of templates with the unit in their place; a mass becomes its weight. Units that are missing here stay, such as `g`
/// and `s`.
const UNITS: &[(&str, &str, Rounding)] = &[
    ("mm", "in", Rounding::Inches),
    ("m", "ft", Rounding::Feet),
    ("mm²", "in²", Rounding::Digits),
    ("m²", "ft²", Rounding::Digits),
    ("kN", "kip", Rounding::Digits),
    ("MN", "kip", Rounding::Digits),
    ("GN", "kip", Rounding::Digits),
    ("MN.m", "kip.ft", Rounding::Digits),
    ("MN.m2", "kip.ft2", Rounding::Digits),
    ("N.m/rad", "kip.ft/rad", Rounding::Digits),
    ("kN/m", "kip/ft", Rounding::Digits),
    ("MN/m", "kip/in", Rounding::Digits),
    ("N/m^1.5", "kip/in^1.5", Rounding::Digits),
    ("kN.s/m", "kip.s/in", Rounding::Digits),
    ("MN.s/m", "kip.s/in", Rounding::Digits),
    ("MPa", "ksi", Rounding::Digits),
    ("GPa", "ksi", Rounding::Digits),
    ("kg/m", "lb/ft", Rounding::Digits),
    ("kg/m3", "pcf", Rounding::Digits),
    ("t", "kip", Rounding::Digits),
    ("m/s", "in/s", Rounding::Digits),
    ("m/s2", "ft/s2", Rounding::Digits),
    ("cm/s2", "in/s2", Rounding::Digits),
];

/// Grades and bars of templates with what a US engineer would write in their place.
const NAMES: &[(&str, &str)] = &[
    ("C20", "f'c = 3 ksi"),
    ("C25", "f'c = 3.5 ksi"),
    ("C30", "f'c = 4 ksi"),
    ("C35", "f'c = 5 ksi"),
    ("d6", "#3"),
    ("d20", "#6"),
    ("d22", "#7"),
    ("d25", "#8"),
];

/// Keys of lengths that place something.
const PLACING: [&str; 4] = ["at", "plan", "lines_x", "lines_y"];

/// A template with its quantities, grades and bars in US customary units, rounded, and results shown in them.
pub(crate) fn in_us_units(text: &str) -> String {
    let mut table = "";
    let mut written = String::new();
    for line in text.lines() {
        if line.starts_with('[') {
            table = line.split([' ', '#']).next().unwrap_or_default();
        }
        written += &converted(line, table);
        written.push('\n');
    }
    const UNITS: &str = "units = \"us\"                    # texts and pages show in, ft and kip\n";
    match written.find("[output]\n") {
        Some(at) => written.insert_str(at + "[output]\n".len(), UNITS),
        None => written += &format!("\n[output]\n{UNITS}"),
    }
    written
}

/// A line of a table with its quantities converted; a comment behind them stays in its column where it can.
fn converted(line: &str, table: &str) -> String {
    let key = line.split([' ', '=']).next().unwrap_or_default();
    let rounding = match key {
        "width" if table == "[[gap]]" => Some(Rounding::Digits),
        _ if PLACING.contains(&key) => Some(Rounding::Places),
        _ => None,
    };
    let mut commented = line.starts_with('#');
    let parts = line.split('"').enumerate();
    let parts = parts.map(|(index, part)| {
        if index % 2 == 0 {
            commented |= part.contains(" #");
        }
        match index % 2 {
            1 => with_names(&with_quantities(part, rounding)),
            _ if commented => with_quantities(part, None),
            _ => part.to_owned(),
        }
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

/// A text with its grades and bars in US spelling.
fn with_names(text: &str) -> String {
    let words = text.split(' ').map(|word| {
        let known = NAMES.iter().find(|name| name.0 == word);
        known.map_or(word, |name| name.1)
    });
    words.collect::<Vec<_>>().join(" ")
}

/// A text with every number and its unit in US units; of "2 to 3 m", both numbers.
fn with_quantities(text: &str, rounding: Option<Rounding>) -> String {
    const CLOSING: [char; 4] = [',', ';', ':', ')'];
    let words: Vec<&str> = text.split(' ').collect();
    let mut converted: Vec<String> = words.iter().map(|&word| word.to_owned()).collect();
    for (index, pair) in words.windows(2).enumerate() {
        let unit = pair[1].trim_end_matches(CLOSING).trim_end_matches('.');
        let number = pair[0].trim_start_matches('(');
        let opening = &pair[0][..pair[0].len() - number.len()];
        let Some((value, us)) = quantity(number, unit, rounding) else {
            continue;
        };
        converted[index] = format!("{opening}{value}");
        converted[index + 1] = format!("{us}{}", &pair[1][unit.len()..]);
        if let Some(first) = index.checked_sub(2).filter(|_| words[index - 1] == "to")
            && let Some((value, _)) = quantity(words[first], unit, rounding)
        {
            converted[first] = value;
        }
    }
    converted.join(" ")
}

/// A number and its unit in US units; `None` of other texts.
fn quantity(
    number: &str,
    unit: &str,
    rounding: Option<Rounding>,
) -> Option<(String, &'static str)> {
    let number: f64 = number.parse().ok()?;
    let (_, us, usual) = UNITS.iter().find(|candidate| candidate.0 == unit)?;
    let [from, to] = [unit, us].map(|unit| Unit::parse(unit).ok());
    let (from, to) = (from?, to?);
    let weight = match from.exponents == to.exponents {
        true => 1.0,
        false => STANDARD_GRAVITY,
    };
    let value = number * weight * from.factor / to.factor;
    let rounding = match unit {
        "m" | "mm" => rounding.unwrap_or(*usual),
        _ => *usual,
    };
    Some((rounded(value, rounding).to_string(), us))
}

fn rounded(value: f64, rounding: Rounding) -> f64 {
    // A division by a whole number rounds once.
    let to = |parts: f64| (value * parts).round() / parts;
    match rounding {
        Rounding::Inches if value.abs() >= 6.0 => to(1.0),
        Rounding::Inches if value.abs() >= 1.0 => to(4.0),
        Rounding::Inches if value.abs() >= 0.125 => to(8.0),
        Rounding::Feet => to(2.0),
        Rounding::Places => to(1000.0),
        Rounding::Inches | Rounding::Digits => {
            // Of a number with a power of ten.
            let digits = format!("{value:.2e}");
            digits.parse().unwrap_or(value)
        }
    }
}
