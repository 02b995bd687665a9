//! Physical quantities as a user writes them: a number and a unit, `"220 cm/s2"`, turned into SI.

use std::fmt;

use jostle::statics::STANDARD_GRAVITY;

use crate::unit::{self, Unit, UnitError};

/// Dimension of a quantity.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub enum Dimension {
    /// Length \[m\].
    Length,
    /// Mass \[kg\].
    Mass,
    /// Time \[s\].
    Time,
    /// Acceleration \[m/s²\].
    Acceleration,
    /// Speed \[m/s\].
    Speed,
    /// Force, and the axial rigidity EA \[N\].
    Force,
    /// Linear stiffness \[N/m\].
    Stiffness,
    /// Displacement per force \[m/N\].
    Flexibility,
    /// Stiffness of a Hertz contact \[N/m^1.5\].
    HertzStiffness,
    /// Modulus of elasticity \[Pa\].
    Modulus,
    /// Stress, strength or pressure \[Pa\].
    Stress,
    /// Mass per length \[kg/m\].
    LineMass,
    /// Mass per area \[kg/m²\].
    AreaMass,
    /// Mass per volume \[kg/m³\].
    Density,
    /// Bending moment \[N·m\].
    Moment,
    /// Rotational stiffness \[N·m/rad\].
    RotationalStiffness,
    /// Coefficient of a dashpot \[N·s/m\].
    Damping,
    /// Coefficient of a rotational dashpot \[N·m·s/rad\].
    RotationalDamping,
    /// Flexural rigidity EI \[N·m²\].
    FlexuralRigidity,
    /// Frequency, and mass-proportional damping \[1/s\].
    Frequency,
    /// Mass moment of inertia \[kg·m²\].
    PolarMass,
    /// Inverse of a speed \[s/m\].
    Slowness,
    /// Linear stiffness per length \[N/m/m\].
    StiffnessPerLength,
    /// Stiffness of a Hertz contact per length \[N/m^1.5/m\].
    HertzStiffnessPerLength,
    /// Area \[m²\].
    Area,
    /// A plain number; `%` is understood.
    Dimensionless,
}

impl Dimension {
    /// Every dimension.
    pub const ALL: [Self; 26] = [
        Self::Length,
        Self::Mass,
        Self::Time,
        Self::Acceleration,
        Self::Speed,
        Self::Force,
        Self::Stiffness,
        Self::Flexibility,
        Self::HertzStiffness,
        Self::Modulus,
        Self::Stress,
        Self::LineMass,
        Self::AreaMass,
        Self::Density,
        Self::Moment,
        Self::RotationalStiffness,
        Self::Damping,
        Self::RotationalDamping,
        Self::FlexuralRigidity,
        Self::Frequency,
        Self::PolarMass,
        Self::Slowness,
        Self::StiffnessPerLength,
        Self::HertzStiffnessPerLength,
        Self::Area,
        Self::Dimensionless,
    ];

    /// Name with its article, an example, the SI unit, and the exponents of metre, kilogram and second.
    #[rustfmt::skip]
    fn facts(self) -> (&'static str, &'static str, &'static str, [f64; 3]) {
        match self {
            Self::Length => ("a length", "3.2 m", "m", [1.0, 0.0, 0.0]),
            Self::Mass => ("a mass", "40 t", "kg", [0.0, 1.0, 0.0]),
            Self::Time => ("a time", "0.01 s", "s", [0.0, 0.0, 1.0]),
            Self::Acceleration => ("an acceleration", "220 cm/s2", "m/s2", [1.0, 0.0, -2.0]),
            Self::Speed => ("a speed", "0.5 m/s", "m/s", [1.0, 0.0, -1.0]),
            Self::Force => ("a force", "100 kN", "N", [1.0, 1.0, -2.0]),
            Self::Stiffness => ("a stiffness", "60 MN/m", "N/m", [0.0, 1.0, -2.0]),
            Self::Flexibility => ("a flexibility", "2.1e-8 m/N", "m/N", [0.0, -1.0, 2.0]),
            Self::HertzStiffness => ("a Hertz contact stiffness", "2e9 N/m^1.5", "N/m^1.5", [-0.5, 1.0, -2.0]),
            Self::Modulus => ("a modulus of elasticity", "30 GPa", "Pa", [-1.0, 1.0, -2.0]),
            Self::Stress => ("a stress", "25 MPa", "Pa", [-1.0, 1.0, -2.0]),
            Self::LineMass => ("a mass per length", "3600 kg/m", "kg/m", [-1.0, 1.0, 0.0]),
            Self::AreaMass => ("a mass per area", "1000 kg/m2", "kg/m2", [-2.0, 1.0, 0.0]),
            Self::Density => ("a density", "2500 kg/m3", "kg/m3", [-3.0, 1.0, 0.0]),
            Self::Moment => ("a moment", "400 kN.m", "N.m", [2.0, 1.0, -2.0]),
            Self::RotationalStiffness => ("a rotational stiffness", "2e8 N.m/rad", "N.m/rad", [2.0, 1.0, -2.0]),
            Self::Damping => ("a dashpot coefficient", "2 MN.s/m", "N.s/m", [0.0, 1.0, -1.0]),
            Self::RotationalDamping => ("a rotational dashpot coefficient", "5 MN.m.s/rad", "N.m.s/rad", [2.0, 1.0, -1.0]),
            Self::FlexuralRigidity => ("a flexural rigidity", "150 MN.m2", "N.m2", [3.0, 1.0, -2.0]),
            Self::Frequency => ("a frequency", "2 Hz", "1/s", [0.0, 0.0, -1.0]),
            Self::PolarMass => ("a polar mass", "1e7 kg.m2", "kg.m2", [2.0, 1.0, 0.0]),
            Self::Slowness => ("an inverse speed", "50 s/m", "s/m", [-1.0, 0.0, 1.0]),
            Self::StiffnessPerLength => ("a stiffness per length", "20 MN/m/m", "N/m/m", [-1.0, 1.0, -2.0]),
            Self::HertzStiffnessPerLength => ("a Hertz contact stiffness per length", "2e8 N/m^1.5/m", "N/m^1.5/m", [-1.5, 1.0, -2.0]),
            Self::Area => ("an area", "200 m2", "m2", [2.0, 0.0, 0.0]),
            Self::Dimensionless => ("a number without unit", "0.05", "1", [0.0; 3]),
        }
    }

    /// Name with its article, as in "expected a length".
    #[must_use]
    pub fn noun(self) -> &'static str {
        self.facts().0
    }

    /// A well-formed example.
    #[must_use]
    pub fn example(self) -> &'static str {
        self.facts().1
    }

    /// SI unit of a bare number.
    #[must_use]
    pub fn si_unit(self) -> &'static str {
        self.facts().2
    }

    pub(crate) fn exponents(self) -> [f64; 3] {
        self.facts().3
    }

    /// Whether a weight is accepted too, and divided by [`STANDARD_GRAVITY`].
    fn is_mass_like(self) -> bool {
        matches!(
            self,
            Self::Mass | Self::LineMass | Self::AreaMass | Self::Density
        )
    }
}

impl fmt::Display for Dimension {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.noun())
    }
}

/// Why a quantity could not be read.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[non_exhaustive]
pub enum QuantityError {
    /// The text does not begin with a number.
    #[error("expected {expected} (such as \"{}\"), found \"{found}\"", expected.example())]
    NotANumber {
        /// Expected dimension.
        expected: Dimension,
        /// The text.
        found: String,
    },
    /// The unit belongs to another kind of quantity.
    #[error("expected {expected} (such as \"{}\"), found \"{found}\"{}", expected.example(), hint(*expected, found))]
    WrongDimension {
        /// Expected dimension.
        expected: Dimension,
        /// The text.
        found: String,
    },
    /// A part of the unit has no meaning.
    #[error("unknown unit \"{unit}\" in \"{found}\"{}; expected {expected} (such as \"{}\")", suggestion(nearest), expected.example())]
    UnknownUnit {
        /// Expected dimension.
        expected: Dimension,
        /// The text.
        found: String,
        /// The part not understood.
        unit: String,
        /// A unit spelt similarly.
        nearest: Option<String>,
    },
    /// The unit is not spelt like one.
    #[error("cannot read the unit of \"{found}\"; expected {expected} (such as \"{}\")", expected.example())]
    MalformedUnit {
        /// Expected dimension.
        expected: Dimension,
        /// The text.
        found: String,
    },
    /// Decimal comma.
    #[error(
        "cannot read \"{found}\": write a decimal point instead of the comma, and no thousands separator"
    )]
    Comma {
        /// The text.
        found: String,
    },
    /// The value is not finite, or so large that nothing can be computed with it.
    #[error("expected {expected} (such as \"{}\"), found \"{found}\", which is not a usable number", expected.example())]
    NotFinite {
        /// Expected dimension.
        expected: Dimension,
        /// The text.
        found: String,
    },
}

fn suggestion(nearest: &Option<String>) -> String {
    nearest
        .as_ref()
        .map_or_else(String::new, |unit| format!(" (did you mean \"{unit}\"?)"))
}

/// Explains the one unit with two common meanings, and loads per area.
fn hint(expected: Dimension, found: &str) -> String {
    let (number, unit) = split_number(found).unwrap_or((0.0, ""));
    if expected.is_mass_like() && unit.trim().starts_with('g') {
        return "; g is the acceleration of gravity, write kg or t".to_owned();
    }
    let per_area = unit
        .trim()
        .strip_suffix("/m2")
        .or(unit.trim().strip_suffix("/m²"));
    match per_area.filter(|_| expected == Dimension::LineMass) {
        Some(load) => format!(
            "; multiply by the tributary width: \"{} {load}/m\" for a strip of 6 m",
            show_number(6.0 * number)
        ),
        None => String::new(),
    }
}

/// Magnitudes beyond this have no physical meaning and would overflow in products.
const LARGEST: f64 = 1e30;

/// Reads a quantity such as `"20 mm"` or `"0.35 g"` into SI. A bare number is in SI already.
///
/// Where a mass, a mass per length or a density is wanted, a weight (`"25 kN/m"`) is accepted too and divided
/// by [`STANDARD_GRAVITY`]. `g` is always the acceleration of gravity, `t` the tonne.
///
/// # Errors
/// If the text is not a number, the unit is unknown or of another dimension, or the value is not finite.
pub fn parse_quantity(text: &str, expected: Dimension) -> Result<f64, QuantityError> {
    let found = || shorten(text);
    let (number, rest) = split_number(text).ok_or_else(|| QuantityError::NotANumber {
        expected,
        found: found(),
    })?;
    if rest.starts_with(',') {
        return Err(QuantityError::Comma { found: found() });
    }
    let value = if rest.trim().is_empty() {
        number
    } else {
        number * unit_size(rest, text, expected)?
    };
    check_magnitude(value, expected).map_err(|_| QuantityError::NotFinite {
        expected,
        found: found(),
    })
}

/// Accepts a bare SI number if it is finite and of usable size.
///
/// # Errors
/// [`QuantityError::NotFinite`].
pub(crate) fn check_magnitude(value: f64, expected: Dimension) -> Result<f64, QuantityError> {
    if value.is_finite() && value.abs() <= LARGEST {
        Ok(value)
    } else {
        Err(QuantityError::NotFinite {
            expected,
            found: show_number(value),
        })
    }
}

/// Size in SI of a unit of the expected dimension; `whole` is quoted in errors.
pub(crate) fn unit_size(
    unit: &str,
    whole: &str,
    expected: Dimension,
) -> Result<f64, QuantityError> {
    let found = shorten(whole);
    let unit = Unit::parse(unit).map_err(|error| match error {
        UnitError::Unknown(unit) => QuantityError::UnknownUnit {
            nearest: nearest_unit(&unit),
            expected,
            found: found.clone(),
            unit,
        },
        UnitError::Malformed => QuantityError::MalformedUnit {
            expected,
            found: found.clone(),
        },
    })?;
    if unit.has_dimension(expected.exponents()) {
        return Ok(unit.factor);
    }
    let [length, mass, time] = expected.exponents();
    if expected.is_mass_like() && unit.has_dimension([length + 1.0, mass, time - 2.0]) {
        return Ok(unit.factor / STANDARD_GRAVITY);
    }
    Err(QuantityError::WrongDimension { expected, found })
}

/// A quantity in the unit of another one: `100 MN/m` beside `10 kN/m` is `100000 kN/m`. `None` if one of them has no unit or if
/// their dimensions differ.
#[must_use]
pub fn in_unit_of(other: &str, text: &str) -> Option<String> {
    let [(_, wanted), (number, unit)] = [split_number(other)?, split_number(text)?];
    let [wanted, unit] = [wanted.trim(), unit.trim()];
    let [to, from] = [Unit::parse(wanted).ok()?, Unit::parse(unit).ok()?];
    if wanted.is_empty() || unit.is_empty() || !from.has_dimension(to.exponents) {
        return None;
    }
    // Fifteen digits, so that no rounding of the factors shows.
    let value: f64 = format!("{:.14e}", number * (from.factor / to.factor))
        .parse()
        .ok()?;
    value.is_finite().then(|| format!("{value} {wanted}"))
}

/// The number at the start, and the rest.
pub(crate) fn split_number(text: &str) -> Option<(f64, &str)> {
    let text = text.trim();
    let bytes = text.as_bytes();
    let digit = |i: usize| bytes.get(i).is_some_and(u8::is_ascii_digit);
    let mut end = usize::from(matches!(bytes.first(), Some(b'+' | b'-')));
    let start = end;
    while digit(end) {
        end += 1;
    }
    let mut digits = end - start;
    if bytes.get(end) == Some(&b'.') {
        let point = end;
        end += 1;
        while digit(end) {
            end += 1;
        }
        digits += end - point - 1;
    }
    if digits == 0 {
        return None;
    }
    // The letter belongs to the number only if digits follow.
    if matches!(bytes.get(end), Some(b'e' | b'E')) {
        let sign = usize::from(matches!(bytes.get(end + 1), Some(b'+' | b'-')));
        if digit(end + 1 + sign) {
            end += 1 + sign;
            while digit(end) {
                end += 1;
            }
        }
    }
    let value = text.get(..end)?.parse().ok()?;
    Some((value, text.get(end..)?))
}

fn nearest_unit(unit: &str) -> Option<String> {
    unit::common_names()
        .filter(|name| name.len() > 1)
        .map(|name| (strsim::damerau_levenshtein(name, unit), name))
        .filter(|(distance, _)| *distance <= 1)
        .min_by_key(|(distance, _)| *distance)
        .map(|(_, name)| name.to_owned())
}

/// A number for a message, short also when it is huge.
pub(crate) fn show_number(value: f64) -> String {
    if value == 0.0 || !value.is_finite() || (1e-6..1e12).contains(&value.abs()) {
        value.to_string()
    } else {
        format!("{value:e}")
    }
}

/// The text for a message: of bounded length.
pub(crate) fn shorten(text: &str) -> String {
    const LONGEST: usize = 60;
    let clean: String = text
        .chars()
        .take(LONGEST)
        .map(|c| if c.is_control() { '\u{fffd}' } else { c })
        .collect();
    if text.chars().nth(LONGEST).is_some() {
        clean + "…"
    } else {
        clean
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn assert_reads(text: &str, dimension: Dimension, wanted: f64) {
        let value = parse_quantity(text, dimension).unwrap_or_else(|e| panic!("{text}: {e}"));
        assert!(
            (value - wanted).abs() <= 1e-12 * wanted.abs(),
            "{text} is {value}, not {wanted}"
        );
    }

    fn message(text: &str, dimension: Dimension) -> String {
        match parse_quantity(text, dimension) {
            Ok(value) => panic!("{text} should be refused, gave {value}"),
            Err(error) => error.to_string(),
        }
    }

    #[test]
    fn quantities_are_read_into_si() {
        use Dimension::*;
        assert_reads("20 mm", Length, 0.02);
        assert_reads("3.2 m", Length, 3.2);
        assert_reads("10 ft", Length, 3.048);
        assert_reads("220 cm/s2", Acceleration, 2.2);
        assert_reads("220 gal", Acceleration, 2.2);
        assert_reads("0.35 g", Acceleration, 0.35 * 9.80665);
        assert_reads("0.35g", Acceleration, 0.35 * 9.80665);
        assert_reads("2.75e9 N/m^1.5", HertzStiffness, 2.75e9);
        assert_reads("30 GPa", Modulus, 30e9);
        assert_reads("400 kN.m", Moment, 400e3);
        assert_reads("60 MN/m", Stiffness, 60e6);
        assert_reads("40 t", Mass, 40e3);
        assert_reads("3600 kg/m", LineMass, 3600.0);
        assert_reads("5 ms", Time, 5e-3);
        assert_reads("5 %", Dimensionless, 0.05);
        assert_reads("1e-3", Length, 1e-3);
        assert_reads("-2.5e+1 mm", Length, -0.025);
        for dimension in Dimension::ALL {
            assert!(
                parse_quantity(dimension.example(), dimension).is_ok(),
                "the example of {dimension} is read"
            );
            let unit = format!("1 {}", dimension.si_unit());
            assert_reads(&unit, dimension, 1.0);
        }
    }

    #[test]
    fn weight_where_mass_is_wanted_is_converted() {
        assert_reads("25 kN/m", Dimension::LineMass, 25e3 / 9.80665);
        assert_reads("400 kN", Dimension::Mass, 400e3 / 9.80665);
        assert_reads("25 kN/m3", Dimension::Density, 25e3 / 9.80665);
    }

    #[test]
    fn wrong_dimension_says_what_was_expected() {
        assert_eq!(
            message("3.2 kg", Dimension::Length),
            "expected a length (such as \"3.2 m\"), found \"3.2 kg\""
        );
        assert_eq!(
            message("60 MN/m", Dimension::HertzStiffness),
            "expected a Hertz contact stiffness (such as \"2e9 N/m^1.5\"), found \"60 MN/m\""
        );
        assert_eq!(
            message("500 g", Dimension::Mass),
            "expected a mass (such as \"40 t\"), found \"500 g\"; g is the acceleration of gravity, write kg or t"
        );
    }

    #[test]
    fn broken_text_is_explained() {
        assert_eq!(
            message("tall", Dimension::Length),
            "expected a length (such as \"3.2 m\"), found \"tall\""
        );
        assert_eq!(
            message("3 knn", Dimension::Force),
            "unknown unit \"knn\" in \"3 knn\"; expected a force (such as \"100 kN\")"
        );
        assert_eq!(
            message("3 Mpa", Dimension::Modulus),
            "unknown unit \"Mpa\" in \"3 Mpa\" (did you mean \"MPa\"?); expected a modulus of elasticity (such as \"30 GPa\")"
        );
        assert_eq!(
            message("3,2 m", Dimension::Length),
            "cannot read \"3,2 m\": write a decimal point instead of the comma, and no thousands separator"
        );
    }

    #[test]
    fn values_that_are_not_finite_are_refused() {
        for text in ["1e999 m", "nan m", "inf", "-inf m", "1e31", "1e29 km"] {
            message(text, Dimension::Length);
        }
    }
}
