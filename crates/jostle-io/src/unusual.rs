//! Usual ranges of quantities: every reader of models warns outside the usual range, and refuses values that only a
//! wrong unit can explain. The numbers stand beside the keys.

use crate::quantity::Dimension::{self as D};
use crate::quantity::{parse_quantity, show_number, split_number, unit_size};
use crate::record::GREATEST_ACCELERATION;
use crate::tree::{Node, Value};

/// The key that accepts unusual values, for remedies.
const REMEDY: &str =
    "accept_unusual = true under [analysis], or --accept-unusual, accepts it as it is";

/// Usual and possible range of a quantity, in SI. Ranges are of magnitudes.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Range {
    /// Name of the quantity with its article.
    pub(crate) noun: &'static str,
    /// Outside, there is a warning.
    pub(crate) usual: [f64; 2],
    /// Outside, the value is refused.
    pub(crate) possible: [f64; 2],
    /// Whether a negative value means something. Such values come from arithmetic, whose rounding is no value of its own.
    pub(crate) signed: bool,
}

/// What values of a key are usual.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum Usual {
    /// The key is no quantity.
    NoQuantity,
    /// None is unusual, for this reason.
    Any(&'static str),
    Within(Range),
}

/// Result of comparing a value with a range.
#[derive(Debug, PartialEq)]
pub(crate) enum Verdict {
    Usual,
    /// The warning.
    Unusual(String),
    /// The fault and its remedy.
    Refused(String, String),
}

const NO_LIMIT: [f64; 2] = [0.0, f64::INFINITY];
/// Magnitudes of signed quantities that are rounding.
const ROUNDING: f64 = 1e-12;

/// Peak of a ground motion \[m/s²\].
pub(crate) const PEAK_ACCELERATION: Range =
    Range::new("a peak ground acceleration", 0.01, 50.0).possible(0.0, GREATEST_ACCELERATION);

/// Width of a gap \[m\].
pub(crate) const GAP: Range = Range::new("a gap", 1e-5, 2.0).possible(0.0, 20.0);

/// First lateral period of a building \[s\].
pub(crate) const FIRST_PERIOD: [f64; 2] = [0.05, 15.0];
/// Impact speed at which a contact is compared with a storey \[m/s\].
pub(crate) const IMPACT_SPEED: f64 = 0.5;

/// Units of a dimension that are written most, the likeliest first.
fn usual_units(dimension: D) -> &'static [&'static str] {
    match dimension {
        D::Length => &["mm", "cm", "m"],
        D::Acceleration => &["cm/s2", "g", "m/s2"],
        D::Moment => &["kN.m", "MN.m"],
        D::FlexuralRigidity => &["kN.m2", "MN.m2", "N.m2"],
        D::LineMass => &["kN/m", "t/m", "kg/m"],
        D::AreaMass => &["kN/m2", "t/m2", "kg/m2"],
        D::Modulus => &["GPa", "MPa", "kPa", "Pa"],
        D::Dimensionless => &["%"],
        D::Density => &["kN/m3", "t/m3", "kg/m3"],
        D::Mass => &["t", "kg"],
        D::Stiffness => &["MN/m", "kN/m", "N/m"],
        D::Force => &["kN", "MN", "N"],
        D::Speed => &["m/s", "km/s"],
        D::Damping => &["kN.s/m", "MN.s/m"],
        D::Time => &["ms", "s"],
        _ => &[],
    }
}

impl Range {
    /// Values from `low` to `high` are usual, and all are possible.
    pub(crate) const fn new(noun: &'static str, low: f64, high: f64) -> Self {
        Self {
            noun,
            usual: [low, high],
            possible: NO_LIMIT,
            signed: false,
        }
    }

    /// The same, of which only values from `low` to `high` are possible.
    pub(crate) const fn possible(self, low: f64, high: f64) -> Self {
        Self {
            possible: [low, high],
            ..self
        }
    }

    /// Compares a value in SI with the range. Zero means absent and is never unusual; signs are checked elsewhere.
    pub(crate) fn judge(&self, value: f64, dimension: D, written: Written) -> Verdict {
        let size = value.abs();
        let within = |[low, high]: [f64; 2]| (low..=high).contains(&size);
        let is_zero = size == 0.0 || self.signed && size < ROUNDING;
        if is_zero || within(self.usual) {
            return Verdict::Usual;
        }
        let found = format!("{} of {}", self.noun, show(value, dimension));
        let meant = self.meant(written.number, dimension);
        if within(self.possible) {
            // A value with an explicit unit is probably intended.
            let meant = meant.filter(|_| written.is_bare);
            let meant = meant.map_or_else(String::new, |meant| format!("; is it {meant}?"));
            return Verdict::Unusual(format!(
                "{found} is unusual: expected {}{meant}",
                span(self.usual, dimension)
            ));
        }
        let limits = format!("expected {}", span(self.possible, dimension));
        match meant {
            Some(meant) => Verdict::Refused(
                format!("{found}, {limits}: is it {meant}?"),
                format!("write the unit, as in \"{meant}\"; {REMEDY}"),
            ),
            None => Verdict::Refused(
                format!("{found}, {limits}"),
                format!("check the unit; {REMEDY}"),
            ),
        }
    }

    /// The number as written with the unit that makes it usual, well inside the range.
    fn meant(&self, written: f64, dimension: D) -> Option<String> {
        let unit = self.likely_units(written, dimension).next()?;
        Some(format!("{} {unit}", show_number(written)))
    }

    /// Units with which a number would be usual, the likeliest first.
    fn likely_units(&self, written: f64, dimension: D) -> impl Iterator<Item = &'static str> {
        let [low, high] = self.usual;
        let fits = move |unit: &&&str| {
            unit_size(unit, unit, dimension).is_ok_and(|size| {
                let value = (written * size).abs();
                2.0 * low <= value && 2.0 * value <= high && value > 0.0
            })
        };
        usual_units(dimension).iter().filter(fits).copied()
    }
}

fn show(value: f64, dimension: D) -> String {
    match dimension {
        D::Dimensionless => short(value),
        _ => format!("{} {}", short(value), dimension.si_unit()),
    }
}

/// Limits in words.
pub(crate) fn span([low, high]: [f64; 2], dimension: D) -> String {
    match (low > 0.0, high.is_finite()) {
        (true, true) => format!("{} to {}", show(low, dimension), show(high, dimension)),
        (true, false) => format!("at least {}", show(low, dimension)),
        (false, true) => format!("at most {}", show(high, dimension)),
        (false, false) => "any".to_owned(),
    }
}

/// Reads a length or an acceleration given as an option of the command line: a number there needs its unit, except zero.
///
/// # Errors
/// A message that names the option; without a unit it lists the likely spellings.
pub fn parse_option(option: &str, text: &str, expected: D) -> Result<f64, String> {
    let value = parse_quantity(text, expected).map_err(|error| format!("{option}: {error}"))?;
    let number = text.trim();
    let is_bare = split_number(number).is_some_and(|(_, rest)| rest.trim().is_empty());
    if !is_bare || value == 0.0 {
        return Ok(value);
    }
    let range = if expected == D::Acceleration {
        &PEAK_ACCELERATION
    } else {
        &GAP
    };
    let mut spellings: Vec<String> = range
        .likely_units(value, expected)
        .map(|unit| format!("{option} {number}{unit}"))
        .collect();
    if spellings.is_empty() {
        let example = expected.example().replace(' ', "");
        spellings.push(format!("for example {option} {example}"));
    }
    Err(format!(
        "{option}: \"{number}\" has no unit; write {}",
        spellings.join(" or ")
    ))
}

/// The number of a quantity, before its unit.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Written {
    number: f64,
    is_bare: bool,
}

impl Written {
    /// A number in SI.
    pub(crate) fn bare(number: f64) -> Self {
        Self {
            number,
            is_bare: true,
        }
    }

    /// The number, if it was written without unit.
    pub(crate) fn without_unit(self) -> Option<f64> {
        self.is_bare.then_some(self.number)
    }

    /// As written in the file; `value` is the same in SI.
    pub(crate) fn from_node(node: &Node, value: f64) -> Self {
        match &node.value {
            Value::Text(text) => {
                split_number(text).map_or(Self::bare(value), |(number, unit)| Self {
                    number,
                    is_bare: unit.trim().is_empty(),
                })
            }
            _ => Self::bare(value),
        }
    }
}

/// Unusual values that the user accepts.
#[derive(Clone, Debug, Default, PartialEq)]
pub(crate) enum Accepted {
    #[default]
    Nothing,
    Everything,
    /// Fields, and everything below them.
    Paths(Vec<String>),
}

impl Accepted {
    /// Whether unusual values of this field are accepted.
    pub(crate) fn covers(&self, path: &str) -> bool {
        match self {
            Self::Nothing => false,
            Self::Everything => true,
            Self::Paths(paths) => paths.iter().any(|accepted| is_within(path, accepted)),
        }
    }
}

/// Whether a path is another one or below it.
pub(crate) fn is_within(path: &str, other: &str) -> bool {
    path.strip_prefix(other)
        .is_some_and(|rest| rest.is_empty() || rest.starts_with(['.', '[']))
}

/// A number with at most six significant digits, without zeros at its end.
fn short(value: f64) -> String {
    let rounded: f64 = format!("{value:.5e}").parse().unwrap_or(value);
    if (1e-3..1e6).contains(&rounded.abs()) {
        rounded.to_string()
    } else {
        format!("{rounded:e}")
    }
}
