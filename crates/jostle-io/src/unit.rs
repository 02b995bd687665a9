//! Unit algebra: `kN.m`, `N/m^1.5`, `cm/s2` as a factor to SI and exponents of metre, kilogram and second.

use jostle::statics::STANDARD_GRAVITY;

/// A unit: its size in SI and its dimension.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Unit {
    /// Size in SI units.
    pub(crate) factor: f64,
    /// Exponents of metre, kilogram and second; not whole for Hertz stiffnesses (N/m^1.5).
    pub(crate) exponents: [f64; 3],
}

/// Why a unit could not be read.
#[derive(Clone, Debug, PartialEq)]
pub(crate) enum UnitError {
    /// No unit of this name.
    Unknown(String),
    /// The spelling does not follow the grammar.
    Malformed,
}

const ONE: Unit = Unit {
    factor: 1.0,
    exponents: [0.0; 3],
};

/// Longest unit text accepted; also bounds the nesting of parentheses.
const LONGEST: usize = 64;

const LENGTH: [f64; 3] = [1.0, 0.0, 0.0];
const MASS: [f64; 3] = [0.0, 1.0, 0.0];
const TIME: [f64; 3] = [0.0, 0.0, 1.0];
const FREQUENCY: [f64; 3] = [0.0, 0.0, -1.0];
const SPEED: [f64; 3] = [1.0, 0.0, -1.0];
const ACCELERATION: [f64; 3] = [1.0, 0.0, -2.0];
const FORCE: [f64; 3] = [1.0, 1.0, -2.0];
const PRESSURE: [f64; 3] = [-1.0, 1.0, -2.0];
const LINE_LOAD: [f64; 3] = [0.0, 1.0, -2.0];
const DENSITY: [f64; 3] = [-3.0, 1.0, 0.0];
const ENERGY: [f64; 3] = [2.0, 1.0, -2.0];
const NONE: [f64; 3] = [0.0; 3];

pub(crate) const INCH: f64 = 0.0254;
pub(crate) const FOOT: f64 = 0.3048;
pub(crate) const POUND: f64 = 0.453_592_37;
pub(crate) const POUND_FORCE: f64 = POUND * STANDARD_GRAVITY;

/// Units that take no prefix. `g` is gravity, never gram.
#[rustfmt::skip]
const PLAIN: &[(&str, f64, [f64; 3])] = &[
    ("kg", 1.0, MASS), ("lb", POUND, MASS), ("lbm", POUND, MASS), ("slug", POUND_FORCE / FOOT, MASS),
    ("g", STANDARD_GRAVITY, ACCELERATION), ("G", STANDARD_GRAVITY, ACCELERATION),
    ("in", INCH, LENGTH), ("inch", INCH, LENGTH), ("ft", FOOT, LENGTH), ("yd", 3.0 * FOOT, LENGTH),
    ("sec", 1.0, TIME), ("min", 60.0, TIME), ("h", 3600.0, TIME),
    ("lbf", POUND_FORCE, FORCE), ("kip", 1e3 * POUND_FORCE, FORCE), ("kips", 1e3 * POUND_FORCE, FORCE),
    ("kgf", STANDARD_GRAVITY, FORCE), ("tf", 1e3 * STANDARD_GRAVITY, FORCE), ("dyn", 1e-5, FORCE),
    ("psi", POUND_FORCE / (INCH * INCH), PRESSURE), ("ksi", 1e3 * POUND_FORCE / (INCH * INCH), PRESSURE),
    ("psf", POUND_FORCE / (FOOT * FOOT), PRESSURE), ("ksf", 1e3 * POUND_FORCE / (FOOT * FOOT), PRESSURE),
    ("plf", POUND_FORCE / FOOT, LINE_LOAD), ("klf", 1e3 * POUND_FORCE / FOOT, LINE_LOAD),
    ("pcf", POUND / (FOOT * FOOT * FOOT), DENSITY),
    ("bar", 1e5, PRESSURE),
    ("kph", 1.0 / 3.6, SPEED), ("mph", 5280.0 * FOOT / 3600.0, SPEED),
    ("deg", std::f64::consts::PI / 180.0, NONE), ("°", std::f64::consts::PI / 180.0, NONE),
    ("%", 0.01, NONE), ("-", 1.0, NONE),
];

/// Units that take the prefixes below.
#[rustfmt::skip]
const PREFIXED: &[(&str, f64, [f64; 3])] = &[
    ("m", 1.0, LENGTH), ("s", 1.0, TIME), ("t", 1e3, MASS), ("N", 1.0, FORCE), ("Pa", 1.0, PRESSURE),
    ("J", 1.0, ENERGY), ("Hz", 1.0, FREQUENCY), ("rad", 1.0, NONE),
    ("gal", 0.01, ACCELERATION), ("Gal", 0.01, ACCELERATION),
];

const PREFIXES: &[(&str, f64)] = &[
    ("n", 1e-9),
    ("µ", 1e-6),
    ("μ", 1e-6),
    ("u", 1e-6),
    ("m", 1e-3),
    ("c", 1e-2),
    ("d", 1e-1),
    ("k", 1e3),
    ("M", 1e6),
    ("G", 1e9),
];

/// Names worth suggesting for a misspelt unit.
pub(crate) fn common_names() -> impl Iterator<Item = &'static str> {
    let derived = [
        "mm", "cm", "km", "ms", "kN", "MN", "GN", "kPa", "MPa", "GPa",
    ];
    PLAIN
        .iter()
        .chain(PREFIXED)
        .map(|(name, ..)| *name)
        .chain(derived)
}

impl Unit {
    /// Reads a unit; nothing at all is dimensionless.
    pub(crate) fn parse(text: &str) -> Result<Self, UnitError> {
        let text = text.trim();
        if text.len() > LONGEST {
            return Err(UnitError::Malformed);
        }
        if text.is_empty() {
            return Ok(ONE);
        }
        if let Some(unit) = named(text) {
            return Ok(unit);
        }
        let mut scanner = Scanner {
            rest: spell_out_superscripts(text),
        };
        let unit = scanner.product()?;
        match scanner.peek() {
            None => Ok(unit),
            Some(_) => Err(UnitError::Malformed),
        }
    }

    /// Whether the exponents agree to rounding.
    pub(crate) fn has_dimension(&self, exponents: [f64; 3]) -> bool {
        self.exponents
            .iter()
            .zip(exponents)
            .all(|(a, b)| (a - b).abs() < 1e-9)
    }

    fn times(self, other: Self, power: f64) -> Self {
        let mut exponents = self.exponents;
        for (mine, others) in exponents.iter_mut().zip(other.exponents) {
            *mine += power * others;
        }
        Self {
            factor: self.factor * libm::pow(other.factor, power),
            exponents,
        }
    }
}

/// A unit by name, with its prefix.
fn named(name: &str) -> Option<Unit> {
    let find = |list: &[(&str, f64, [f64; 3])], name: &str| {
        list.iter()
            .find(|(known, ..)| *known == name)
            .map(|(_, factor, exponents)| Unit {
                factor: *factor,
                exponents: *exponents,
            })
    };
    find(PLAIN, name)
        .or_else(|| find(PREFIXED, name))
        .or_else(|| {
            PREFIXES.iter().find_map(|(prefix, size)| {
                let unit = find(PREFIXED, name.strip_prefix(prefix)?)?;
                Some(Unit {
                    factor: size * unit.factor,
                    ..unit
                })
            })
        })
}

/// `m/s²` as `m/s2`.
fn spell_out_superscripts(text: &str) -> String {
    text.chars()
        .map(|c| match c {
            '⁰' => '0',
            '¹' => '1',
            '²' => '2',
            '³' => '3',
            '⁴' => '4',
            '⁵' => '5',
            '⁶' => '6',
            '⁷' => '7',
            '⁸' => '8',
            '⁹' => '9',
            '⁻' | '−' => '-',
            other => other,
        })
        .collect()
}

/// Recursive descent over
/// `product = power { ("." | "*" | "·" | "-" | " " | "/") power }`, `power = name | "1" | "(" product ")"`,
/// each with an optional exponent.
struct Scanner {
    rest: String,
}

impl Scanner {
    fn peek(&self) -> Option<char> {
        self.rest.chars().next()
    }

    fn skip(&mut self, count: usize) {
        self.rest = self.rest.chars().skip(count).collect();
    }

    fn accept(&mut self, wanted: &[char]) -> bool {
        let found = self.peek().is_some_and(|c| wanted.contains(&c));
        if found {
            self.skip(1);
        }
        found
    }

    fn skip_spaces(&mut self) -> bool {
        let before = self.rest.len();
        self.rest = self.rest.trim_start().to_owned();
        self.rest.len() < before
    }

    fn product(&mut self) -> Result<Unit, UnitError> {
        self.skip_spaces();
        let (first, power) = self.power()?;
        let mut unit = ONE.times(first, power);
        loop {
            let spaced = self.skip_spaces();
            let divide = match self.peek() {
                None | Some(')') => return Ok(unit),
                Some('/') => true,
                Some('.' | '*' | '·' | '⋅' | '×' | '-') => false,
                // A space alone multiplies, as in `m s-2`.
                Some(_) if spaced => {
                    let (next, power) = self.power()?;
                    unit = unit.times(next, power);
                    continue;
                }
                Some(_) => return Err(UnitError::Malformed),
            };
            self.skip(1);
            self.skip_spaces();
            let (next, power) = self.power()?;
            unit = unit.times(next, if divide { -power } else { power });
        }
    }

    fn power(&mut self) -> Result<(Unit, f64), UnitError> {
        let unit = if self.accept(&['(']) {
            let unit = self.product()?;
            if !self.accept(&[')']) {
                return Err(UnitError::Malformed);
            }
            unit
        } else if self.accept(&['1']) {
            ONE
        } else {
            let name: String = self
                .rest
                .chars()
                .take_while(|c| c.is_alphabetic() || matches!(c, '%' | '°'))
                .collect();
            if name.is_empty() {
                return Err(UnitError::Malformed);
            }
            self.skip(name.chars().count());
            named(&name).ok_or(UnitError::Unknown(name))?
        };
        Ok((unit, self.exponent()?))
    }

    /// `^2`, `^-1.5`, `^(3/2)`, `**2`, or digits directly after the name; 1 when there is none.
    fn exponent(&mut self) -> Result<f64, UnitError> {
        let marked = if self.rest.starts_with("**") {
            self.skip(2);
            true
        } else {
            self.accept(&['^'])
        };
        if marked && self.accept(&['(']) {
            let mut value = self.number().ok_or(UnitError::Malformed)?;
            if self.accept(&['/']) {
                value /= self.number().ok_or(UnitError::Malformed)?;
            }
            if !self.accept(&[')']) {
                return Err(UnitError::Malformed);
            }
            return bounded(value);
        }
        match self.number() {
            Some(value) => bounded(value),
            None if marked => Err(UnitError::Malformed),
            None => Ok(1.0),
        }
    }

    /// A decimal number; a full stop or minus sign belongs to it only when a digit follows.
    fn number(&mut self) -> Option<f64> {
        let chars: Vec<char> = self.rest.chars().collect();
        let digit = |i: usize| chars.get(i).is_some_and(char::is_ascii_digit);
        let mut end = usize::from(matches!(chars.first(), Some('-' | '+')));
        if !digit(end) {
            return None;
        }
        while digit(end) {
            end += 1;
        }
        if chars.get(end) == Some(&'.') && digit(end + 1) {
            end += 1;
            while digit(end) {
                end += 1;
            }
        }
        let text: String = chars[..end].iter().collect();
        self.skip(end);
        text.parse().ok()
    }
}

fn bounded(exponent: f64) -> Result<f64, UnitError> {
    if exponent.abs() <= 12.0 {
        Ok(exponent)
    } else {
        Err(UnitError::Malformed)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn assert_unit(text: &str, factor: f64, exponents: [f64; 3]) {
        let unit = Unit::parse(text).unwrap_or_else(|e| panic!("{text}: {e:?}"));
        assert!(
            (unit.factor / factor - 1.0).abs() < 1e-12,
            "{text} has factor {}, not {factor}",
            unit.factor
        );
        assert!(
            unit.has_dimension(exponents),
            "{text} has exponents {:?}, not {exponents:?}",
            unit.exponents
        );
    }

    #[test]
    fn spellings_of_the_same_unit_agree() {
        for text in [
            "m/s2",
            "m/s^2",
            "m/s²",
            "m.s-2",
            "m s^-2",
            "m/s/s",
            "m/(s.s)",
            "m·s⁻²",
            "m/s**2",
        ] {
            assert_unit(text, 1.0, ACCELERATION);
        }
        for text in ["kN.m", "kN*m", "kN·m", "kN-m", "kN m", "kN.m/rad"] {
            assert_unit(text, 1e3, ENERGY);
        }
        for text in ["N/m^1.5", "N/m1.5", "N/m^(3/2)", "N.m^-1.5"] {
            assert_unit(text, 1.0, [-0.5, 1.0, -2.0]);
        }
    }

    #[test]
    fn prefixes_and_customary_units_have_their_size() {
        assert_unit("mm", 1e-3, LENGTH);
        assert_unit("µm", 1e-6, LENGTH);
        assert_unit("gal", 0.01, ACCELERATION);
        assert_unit("kip", 4_448.221_615_260_5, FORCE);
        assert_unit("ksi", 6_894_757.293_168_36, PRESSURE);
        assert_unit("N/mm2", 1e6, PRESSURE);
        assert_unit("plf", 14.593_902_937_206_4, LINE_LOAD);
        assert_unit("klf", 14_593.902_937_206_4, LINE_LOAD);
        assert_unit("psf", 47.880_258_980_335_8, PRESSURE);
        assert_unit("pcf", 16.018_463_373_960_14, DENSITY);
        assert_unit("m2.kg", 1.0, [2.0, 1.0, 0.0]);
        assert_unit("1/s", 1.0, FREQUENCY);
        assert_unit("", 1.0, NONE);
    }

    #[test]
    fn ambiguous_or_broken_units_are_refused() {
        for text in [
            "m^3/2", "m^", "m//s", "/s", "(m", "m)", "m..s", "m^99", "2", "m,s",
        ] {
            assert!(
                Unit::parse(text).is_err(),
                "{text:?} should not be understood"
            );
        }
        assert_eq!(Unit::parse("foo"), Err(UnitError::Unknown("foo".into())));
    }
}
