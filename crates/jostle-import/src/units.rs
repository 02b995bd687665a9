//! Units as ETABS and SAP2000 print them: `kN-s²/m`, `ton-m²`, `kip/in`, `sec`.

/// Pound-force, N.
const POUND: f64 = 4.448_221_615_260_5;
/// Standard gravity, m/s².
const GRAVITY: f64 = 9.806_65;

/// What a number measures: exponents of mass, length and time.
pub(crate) type Size = [i32; 3];
pub(crate) const NUMBER: Size = [0, 0, 0];
pub(crate) const LENGTH: Size = [0, 1, 0];
pub(crate) const MASS: Size = [1, 0, 0];
pub(crate) const TIME: Size = [0, 0, 1];
pub(crate) const FORCE: Size = [1, 1, -2];
pub(crate) const MOMENT: Size = [1, 2, -2];
pub(crate) const STIFFNESS: Size = [1, 0, -2];
pub(crate) const INERTIA: Size = [1, 2, 0];
pub(crate) const PRESSURE: Size = [1, -1, -2];

/// Factors to SI of the force and the length of a model.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Units {
    /// N.
    pub(crate) force: f64,
    /// m.
    pub(crate) length: f64,
}

impl Units {
    /// The units of these words, such as `KN` and `MM`.
    pub(crate) fn new(force: &str, length: &str) -> Option<Self> {
        match (base(force)?, base(length)?) {
            ((force, FORCE), (length, LENGTH)) => Some(Self { force, length }),
            _ => None,
        }
    }

    /// Name of the unit of length.
    pub(crate) fn length_name(&self) -> Option<&'static str> {
        ["m", "cm", "mm", "in", "ft"]
            .into_iter()
            .find(|name| base(name).is_some_and(|(size, _)| size == self.length))
    }

    /// `"kN, m, C"`.
    pub(crate) fn parse(text: &str) -> Option<Self> {
        let mut words = text.split(',').map(str::trim);
        Self::new(words.next()?, words.next()?)
    }

    /// Factor to SI of a quantity of this size; time is in seconds.
    pub(crate) fn factor(&self, [mass, length, _]: Size) -> f64 {
        // Mass = force × s²/length.
        self.force.powi(mass) * self.length.powi(length - mass)
    }
}

/// Factor and size of a single unit. `lb` is a force, as in `lb-s²/ft`.
fn base(word: &str) -> Option<(f64, Size)> {
    let lower = word.to_lowercase();
    let found = match lower.as_str() {
        "n" => (1.0, FORCE),
        "kn" => (1e3, FORCE),
        "mn" => (1e6, FORCE),
        "kgf" => (GRAVITY, FORCE),
        "tonf" | "tf" => (1e3 * GRAVITY, FORCE),
        "lb" | "lbf" => (POUND, FORCE),
        "kip" | "kips" => (1e3 * POUND, FORCE),
        "m" => (1.0, LENGTH),
        "cm" => (1e-2, LENGTH),
        "mm" => (1e-3, LENGTH),
        "in" | "inch" => (0.0254, LENGTH),
        "ft" => (0.3048, LENGTH),
        "kg" => (1.0, MASS),
        "ton" | "t" | "tonne" => (1e3, MASS),
        "s" | "sec" => (1.0, TIME),
        "rad" | "1" => (1.0, NUMBER),
        "deg" => (std::f64::consts::PI / 180.0, NUMBER),
        _ => return None,
    };
    Some(found)
}

/// Factor to SI and size of a product of units.
pub(crate) fn parse(text: &str) -> Option<(f64, Size)> {
    let (mut factor, mut size) = (1.0, NUMBER);
    for (index, part) in text.trim().split('/').enumerate() {
        let sign = if index == 0 { 1 } else { -1 };
        for word in part
            .split(['-', '·', '*', ' '])
            .filter(|word| !word.is_empty())
        {
            let (name, power) = split_power(word)?;
            let (unit, of_unit) = base(name)?;
            factor *= unit.powi(sign * power);
            for (size, more) in size.iter_mut().zip(of_unit) {
                *size += sign * power * more;
            }
        }
    }
    Some((factor, size))
}

/// `m²`, `m2` and `m^2` as a name and a power of at most 9.
fn split_power(word: &str) -> Option<(&str, i32)> {
    let digits = |c: char| c.is_ascii_digit() || "²³⁴⁵⁶".contains(c);
    let name = word.trim_end_matches(digits);
    if name.is_empty() {
        return (word == "1").then_some((word, 1));
    }
    let power = match &word[name.len()..] {
        "" => 1,
        "²" => 2,
        "³" => 3,
        "⁴" => 4,
        "⁵" => 5,
        "⁶" => 6,
        other => other.parse().ok().filter(|power| *power < 10)?,
    };
    Some((name.trim_end_matches('^'), power))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn units_of_tables() {
        let near = |text: &str, factor: f64, size: Size| {
            let (found, of) = parse(text).unwrap_or_else(|| panic!("{text}"));
            assert!(
                (found / factor - 1.0).abs() < 1e-12 && of == size,
                "{text}: {found} {of:?}"
            );
        };
        near("kg", 1.0, MASS);
        near("ton-m²", 1e3, INERTIA);
        near("kN-s²/m", 1e3, MASS);
        near("lb-s²/ft", 14.593_902_937_206_364, MASS);
        near("kip-in-s2", 112.984_829_027_616_7, INERTIA);
        near("Kgf-s^2/cm", 980.665, MASS);
        near("kN/m²", 1e3, PRESSURE);
        near("mm", 1e-3, LENGTH);
        assert_eq!(parse("parsec"), None);
        let kip = Units::parse("KIP, in, F").expect("units");
        assert!((kip.factor(MASS) / 175_126.835_246_477_4 - 1.0).abs() < 1e-12);
        assert!((kip.factor(MOMENT) / 112.984_829_027_616_7 - 1.0).abs() < 1e-12);
        assert_eq!(Units::parse("m, kN"), None);
    }
}
