//! Concrete and steel as users write them: a grade of GB 50010 or EN 1992-1-1, f'c of ACI 318, bars of EN 10080 or ASTM, or a
//! strength.

use jostle_section::capacity::ShearRule;
use jostle_section::{
    ASTM_STEEL_GRADES, CONCRETE_GRADES, Concrete, EN_CONCRETE_GRADES, EN_STEEL_GRADES,
    STEEL_GRADES, Steel, StrengthLevel,
};

use crate::quantity::{Dimension, parse_quantity, shorten};

/// Cylinder strengths that f'c can have \[Pa\].
const CYLINDER_STRENGTHS: [f64; 2] = [10e6, 150e6];

/// Concrete of a member.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum ConcreteGrade {
    /// A grade of GB 50010 or EN 1992-1-1.
    Named(&'static str),
    /// Prismatic strength, as of GB 50010 \[Pa\].
    Prismatic(f64),
    /// Specified cylinder strength f'c of ACI 318 \[Pa\].
    Cylinder(f64),
}

impl ConcreteGrade {
    /// The rule for existing members of the country that names concrete like this; `None` of a strength.
    pub(crate) fn home_rule(self) -> Option<ShearRule> {
        match self {
            Self::Named(name) if name.contains('/') => Some(ShearRule::En1998),
            Self::Named(_) => Some(ShearRule::Gb50010),
            Self::Prismatic(_) => None,
            Self::Cylinder(_) => Some(ShearRule::Asce41),
        }
    }

    /// Numbers of a strength level; `None` of grades that are not in the tables of strengths.
    pub(crate) fn at(self, level: StrengthLevel) -> Option<Concrete> {
        match self {
            Self::Named(name) => Concrete::grade(name, level),
            Self::Prismatic(strength) => Some(Concrete::of_strength(strength)),
            Self::Cylinder(strength) => Some(Concrete::of_cylinder_strength(strength, level)),
        }
    }
}

/// A problem with a text, and its remedy.
pub(crate) type Trouble = (String, String);

/// The strength in a text such as `f'c = 4 ksi`; `None` if the text does not begin like that.
pub(crate) fn cylinder_strength(text: &str) -> Option<Result<f64, Trouble>> {
    let plain = text.trim().replace('\u{2019}', "'");
    let rest = ["f'c", "fc'"]
        .into_iter()
        .find_map(|symbol| plain.strip_prefix(symbol))?;
    let rest = rest.trim_start();
    let rest = rest.strip_prefix('=').unwrap_or(rest).trim();
    Some(strength_with_unit(rest))
}

fn strength_with_unit(text: &str) -> Result<f64, Trouble> {
    let remedy =
        "write the cylinder strength with its unit, such as \"f'c = 4 ksi\" or \"f'c = 28 MPa\"";
    if text.parse::<f64>().is_ok() {
        let problem = format!("f'c = {} has no unit", shorten(text));
        return Err((problem, remedy.to_owned()));
    }
    let strength = parse_quantity(text, Dimension::Stress)
        .map_err(|error| (format!("f'c: {error}"), remedy.to_owned()))?;
    let [least, most] = CYLINDER_STRENGTHS;
    if (least..=most).contains(&strength) {
        return Ok(strength);
    }
    let problem = format!(
        "f'c must lie between {} and {} MPa, found {}",
        1e-6 * least,
        1e-6 * most,
        shorten(text)
    );
    Err((problem, remedy.to_owned()))
}

/// Concrete as typed: a grade of GB 50010 or EN 1992-1-1, `f'c = 4 ksi`, or a prismatic strength such as `30 MPa`.
///
/// # Errors
/// What is wrong with the text, and what is possible.
pub fn parse_concrete(text: &str, level: StrengthLevel) -> Result<Concrete, String> {
    if let Some(concrete) = Concrete::grade(text, level) {
        return Ok(concrete);
    }
    if let Some(strength) = cylinder_strength(text) {
        return match strength {
            Ok(strength) => Ok(Concrete::of_cylinder_strength(strength, level)),
            Err((problem, remedy)) => Err(format!("{problem}; {remedy}")),
        };
    }
    positive_strength(text)
        .map(Concrete::of_strength)
        .ok_or_else(|| {
            format!(
                "\"{}\" is not known; available: {}, {}, \"f'c = 4 ksi\", or a strength such as 30MPa",
                shorten(text),
                CONCRETE_GRADES.join(", "),
                EN_CONCRETE_GRADES.join(", ")
            )
        })
}

/// Steel of bars as typed: a grade of GB 50010, EN 10080 or ASTM, or a yield strength such as `400 MPa`.
///
/// # Errors
/// What is possible.
pub fn parse_steel(text: &str, level: StrengthLevel) -> Result<Steel, String> {
    let of_strength = || positive_strength(text).map(Steel::of_strength);
    Steel::grade(text, level)
        .or_else(of_strength)
        .ok_or_else(|| {
            format!(
                "\"{}\" is not known; available: {}, {}, {}, or a strength such as 400MPa",
                shorten(text),
                STEEL_GRADES.join(", "),
                EN_STEEL_GRADES.join(", "),
                ASTM_STEEL_GRADES.join(", ")
            )
        })
}

fn positive_strength(text: &str) -> Option<f64> {
    let value = parse_quantity(text, Dimension::Stress).ok()?;
    (value > 0.0).then_some(value)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn cylinder_strengths_need_a_unit() {
        let read = |text| cylinder_strength(text).expect("it begins with f'c");
        for text in [
            "f'c = 4 ksi",
            "fc' = 4000 psi",
            "f'c 4ksi",
            "f\u{2019}c = 4 ksi",
        ] {
            let found = read(text).unwrap_or_else(|(problem, _)| panic!("{text}: {problem}"));
            assert!((found / 27.579e6 - 1.0).abs() < 1e-4, "{text}: {found}");
        }
        for (text, due) in [
            ("f'c = 4", "no unit"),
            ("f'c = 4000", "no unit"),
            ("f'c = 4 MPa", "between 10 and 150 MPa"),
            ("f'c = 4 kN", "f'c: "),
            ("f'c =", "f'c: "),
        ] {
            let problem = read(text).map_err(|(problem, _)| problem);
            assert!(
                problem.as_ref().is_err_and(|problem| problem.contains(due)),
                "{text}: {problem:?}"
            );
        }
        assert_eq!(cylinder_strength("C30"), None);
    }

    #[test]
    fn texts_of_the_command_line_are_read() {
        let level = StrengthLevel::Characteristic;
        let modulus = |text| parse_concrete(text, level).map(|c| (1e-8 * c.modulus).round() / 10.0);
        assert_eq!(modulus("C30"), Ok(30.0));
        assert_eq!(modulus("C30/37"), Ok(33.0));
        assert_eq!(modulus("f'c = 4 ksi"), Ok(24.9));
        for text in ["C30/35", "M30", "f'c = 30", "-3 MPa", ""] {
            assert!(parse_concrete(text, level).is_err(), "{text}");
        }
        for text in ["B500", "Grade 60", "HRB400", "420 MPa"] {
            assert!(parse_steel(text, level).is_ok(), "{text}");
        }
        for text in ["Grade 500", "B500X", "60", "Grade"] {
            let read = parse_steel(text, level);
            // A bare number is in pascals: 60 Pa is a strength, though hardly meant.
            assert_eq!(read.is_ok(), text == "60", "{text}");
        }
    }
}
