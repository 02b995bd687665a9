//! Usual ranges of quantities: every reader of models warns outside the usual range, and refuses values that only a
//! wrong unit can explain. This file has all the numbers.

use crate::keys::Section::{self as S};
use crate::quantity::Dimension::{self as D};
use crate::quantity::{parse_quantity, show_number, split_number, unit_size};
use crate::record::GREATEST_ACCELERATION;
use crate::tree::{Node, Value};

/// The key that accepts unusual values, for remedies.
const REMEDY: &str =
    "accept_unusual = true under [analysis], or --accept-unusual, accepts it as it is";

/// Usual and possible range of a quantity.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Range {
    /// Section of the key.
    pub(crate) sections: &'static [S],
    pub(crate) key: &'static str,
    /// Name of the quantity with its article.
    pub(crate) noun: &'static str,
    pub(crate) dimension: D,
    /// Outside, there is a warning; in SI.
    pub(crate) usual: [f64; 2],
    /// Outside, the value is refused; in SI.
    pub(crate) possible: [f64; 2],
    /// Units that were probably meant, most likely first.
    units: &'static [&'static str],
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
const LENGTHS: &[&str] = &["mm", "cm", "m"];
const ACCELERATIONS: &[&str] = &["cm/s2", "g", "m/s2"];
const MOMENTS: &[&str] = &["kN.m", "MN.m"];

/// Peak of a ground motion \[m/s²\].
pub(crate) const PEAK_ACCELERATION: Range = Range {
    sections: &[S::Motion, S::Selection],
    key: "pga",
    noun: "a peak ground acceleration",
    dimension: D::Acceleration,
    usual: [0.01, 50.0],
    possible: [0.0, GREATEST_ACCELERATION],
    units: ACCELERATIONS,
};

/// Width of a gap \[m\].
pub(crate) const GAP: Range = Range {
    sections: &[S::Gap],
    key: "width",
    noun: "a gap",
    dimension: D::Length,
    usual: [0.0, 2.0],
    possible: [0.0, 20.0],
    units: LENGTHS,
};

/// First lateral period of a building \[s\].
pub(crate) const FIRST_PERIOD: [f64; 2] = [0.05, 15.0];
/// Impact speed at which a contact is compared with a storey \[m/s\].
pub(crate) const IMPACT_SPEED: f64 = 0.5;

/// Ranges of the keys of a model file.
#[rustfmt::skip]
pub(crate) const RANGES: &[Range] = &[
    PEAK_ACCELERATION,
    Range { key: "amplitude", noun: "an amplitude", sections: &[S::Motion], ..PEAK_ACCELERATION },
    of(&[S::Building], "storey_height", "a storey height", D::Length, [1.5, 30.0], [0.01, 1000.0], LENGTHS),
    of(&[S::Frame, S::PlanFrame], "spans", "a span", D::Length, [0.5, 60.0], [0.01, 1000.0], LENGTHS),
    of(&[S::Column, S::Beam, S::SpaceBeam], "width", "a section width", D::Length, [0.05, 5.0], [0.005, 10.0], LENGTHS),
    of(&[S::Column, S::Beam, S::SpaceBeam], "depth", "a section depth", D::Length, [0.05, 5.0], [0.005, 10.0], LENGTHS),
    of(&[S::Column, S::Beam], "cover", "a concrete cover", D::Length, [0.005, 0.2], [0.0005, 1.0], LENGTHS),
    of(&[S::Column, S::Beam], "EI", "a flexural rigidity", D::FlexuralRigidity, [1e3, 1e14], NO_LIMIT, &["kN.m2", "MN.m2", "N.m2"]),
    of(&[S::Column], "mass", "a mass per length of a column", D::LineMass, [1.0, 1e5], [0.0, 1e7], &["t/m", "kN/m", "kg/m"]),
    of(&[S::Frame, S::PlanFrame, S::SpaceFrame], "elastic_modulus", "a modulus of elasticity", D::Modulus, [1e9, 1e12], [1e6, 1e14], &["GPa", "MPa", "kPa", "Pa"]),
    of(&[S::Frame, S::PlanFrame, S::SpaceFrame], "stiffness_factor", "a stiffness factor", D::Dimensionless, [0.01, 10.0], [1e-6, 1e6], &["%"]),
    of(&[S::StiffnessFactor], "column", "a stiffness factor", D::Dimensionless, [0.01, 10.0], [1e-6, 1e6], &["%"]),
    of(&[S::StiffnessFactor], "beam", "a stiffness factor", D::Dimensionless, [0.01, 10.0], [1e-6, 1e6], &["%"]),
    of(&[S::Frame, S::PlanFrame], "density", "a density", D::Density, [100.0, 2e4], [0.0, 1e6], &["kN/m3", "t/m3", "kg/m3"]),
    of(&[S::Frame, S::PlanFrame], "beam_mass", "a beam mass", D::LineMass, [100.0, 1e5], [0.0, 1e6], &["kN/m", "t/m", "kg/m"]),
    of(&[S::Frame], "floor_mass", "a floor mass", D::Mass, [100.0, 1e8], NO_LIMIT, &["t", "kg"]),
    of(&[S::Shear], "mass", "a floor mass", D::Mass, [100.0, 1e8], NO_LIMIT, &["t", "kg"]),
    of(&[S::Shear], "stiffness", "a storey stiffness", D::Stiffness, [1e3, 1e13], NO_LIMIT, &["MN/m", "kN/m", "N/m"]),
    of(&[S::StoreyHinges, S::StoreyHingesOfAxis], "cracking", "a storey displacement at cracking", D::Length, [1e-6, 1.0], NO_LIMIT, LENGTHS),
    of(&[S::StoreyHinges, S::StoreyHingesOfAxis], "yield", "a storey displacement at yield", D::Length, [1e-6, 1.0], NO_LIMIT, LENGTHS),
    of(&[S::Hinge, S::HingeSide], "cracking", "a cracking moment", D::Moment, [1e3, f64::INFINITY], NO_LIMIT, MOMENTS),
    of(&[S::Hinge, S::HingeSide], "yield", "a yield moment", D::Moment, [1e3, f64::INFINITY], NO_LIMIT, MOMENTS),
    GAP,
    of(&[S::Gap, S::Link], "level_tolerance", "a tolerance of levels", D::Length, [0.0, 1.0], [0.0, 20.0], LENGTHS),
    of(&[S::Gap], "thickness", "a bumper thickness", D::Length, [0.001, 1.0], [0.0, 10.0], LENGTHS),
    of(&[S::Foundation], "length", "a side of a foundation", D::Length, [1.0, 200.0], [0.0, 2e3], LENGTHS),
    of(&[S::Foundation], "width", "a side of a foundation", D::Length, [1.0, 200.0], [0.0, 2e3], LENGTHS),
    of(&[S::Foundation], "embedment", "a depth of a foundation", D::Length, [0.0, 30.0], [0.0, 200.0], LENGTHS),
    of(&[S::Foundation], "mass", "a mass of a foundation", D::Mass, [100.0, 1e9], NO_LIMIT, &["t", "kg"]),
    of(&[S::Soil], "shear_wave_velocity", "a shear wave velocity", D::Speed, [50.0, 3000.0], [1.0, 10e3], &["m/s", "km/s"]),
    of(&[S::Soil], "density", "a density of soil", D::Density, [1000.0, 3000.0], [100.0, 10e3], &["kg/m3", "t/m3"]),
    of(&[S::Isolation], "mat_mass", "a mass of a mat", D::Mass, [100.0, 1e9], NO_LIMIT, &["t", "kg"]),
    of(&[S::Isolation], "stiffness", "a stiffness of bearings", D::Stiffness, [1e3, 1e13], NO_LIMIT, &["MN/m", "kN/m", "N/m"]),
    of(&[S::Isolation], "radius", "a radius of a pendulum", D::Length, [0.1, 20.0], NO_LIMIT, LENGTHS),
    of(&[S::Isolation], "limit", "a displacement of bearings", D::Length, [0.01, 3.0], NO_LIMIT, LENGTHS),
    of(&[S::Wall], "stiffness", "a stiffness of a wall", D::Stiffness, [1e3, 1e13], NO_LIMIT, &["MN/m", "kN/m", "N/m"]),
    of(&[S::Wall], "mass", "a mass of a wall", D::Mass, [10.0, 1e8], NO_LIMIT, &["t", "kg"]),
    of(&[S::LinkLaw], "stiffness", "a link stiffness", D::Stiffness, [1e3, 1e16], NO_LIMIT, &["MN/m", "kN/m"]),
    of(&[S::LinkLaw], "damping", "a dashpot coefficient", D::Damping, [1e2, 1e12], NO_LIMIT, &["kN.s/m", "MN.s/m"]),
];

const fn of(
    sections: &'static [S],
    key: &'static str,
    noun: &'static str,
    dimension: D,
    usual: [f64; 2],
    possible: [f64; 2],
    units: &'static [&'static str],
) -> Range {
    Range {
        sections,
        key,
        noun,
        dimension,
        usual,
        possible,
        units,
    }
}

/// The range of a key of one of some sections.
pub(crate) fn range_of(sections: &[S], key: &str) -> Option<&'static Range> {
    RANGES
        .iter()
        .find(|range| range.key == key && range.sections.iter().any(|s| sections.contains(s)))
}

impl Range {
    /// Compares a value in SI with the range. Zero means absent and is never unusual; signs are checked elsewhere.
    pub(crate) fn judge(&self, value: f64, written: Written) -> Verdict {
        let size = value.abs();
        let within = |[low, high]: [f64; 2]| (low..=high).contains(&size);
        if size == 0.0 || within(self.usual) {
            return Verdict::Usual;
        }
        let found = format!("{} of {}", self.noun, self.show(value));
        let meant = self.meant(written.number);
        if within(self.possible) {
            // A value with an explicit unit is probably intended.
            let meant = meant.filter(|_| written.is_bare);
            let meant = meant.map_or_else(String::new, |meant| format!("; is it {meant}?"));
            return Verdict::Unusual(format!(
                "{found} is unusual: {}{meant}",
                self.limits(self.usual)
            ));
        }
        let limits = self.limits(self.possible);
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
    fn meant(&self, written: f64) -> Option<String> {
        let unit = self.likely_units(written).next()?;
        Some(format!("{} {unit}", show_number(written)))
    }

    /// Units with which a number would be usual, the likeliest first.
    fn likely_units(&self, written: f64) -> impl Iterator<Item = &'static str> {
        let [low, high] = self.usual;
        let fits = move |unit: &&&str| {
            unit_size(unit, unit, self.dimension).is_ok_and(|size| {
                let value = (written * size).abs();
                2.0 * low <= value && 2.0 * value <= high && value > 0.0
            })
        };
        self.units.iter().filter(fits).copied()
    }

    fn show(&self, value: f64) -> String {
        match self.dimension {
            D::Dimensionless => short(value),
            _ => format!("{} {}", short(value), self.dimension.si_unit()),
        }
    }

    /// The limits in words for a message.
    fn limits(&self, limits: [f64; 2]) -> String {
        format!("expected {}", self.span(limits))
    }

    /// The limits in words.
    pub(crate) fn span(&self, [low, high]: [f64; 2]) -> String {
        match (low > 0.0, high.is_finite()) {
            (true, true) => format!("{} to {}", self.show(low), self.show(high)),
            (true, false) => format!("at least {}", self.show(low)),
            (false, true) => format!("at most {}", self.show(high)),
            (false, false) => "any".to_owned(),
        }
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
        .likely_units(value)
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
