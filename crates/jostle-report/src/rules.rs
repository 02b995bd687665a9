//! Rules of required gaps as people read them: names, and one row where all intensities require the same.

use jostle_io::shown::LENGTH;

use crate::message;

/// What the name of a rule of GB 50011 begins with; its intensity follows.
const GB: &str = "GB 50011, intensity ";

/// Name of a rule in the language of the page.
#[must_use]
pub fn rule_name(name: &str) -> String {
    match name.strip_prefix(GB) {
        Some(intensity) => message::gb50011_of_intensity(intensity),
        None => name.to_owned(),
    }
}

/// Rules with their names, in their order. Where GB 50011 requires the same width at every intensity, one row holds for all.
///
/// `name_and_width` gives the name of a rule and the gap that it requires \[m\].
pub fn rows_of_rules<T>(
    rules: &[T],
    name_and_width: impl Fn(&T) -> (&str, f64),
) -> Vec<(String, &T)> {
    let of_gb = |rule: &T| name_and_width(rule).0.starts_with(GB);
    let mut widths = rules.iter().filter(|rule| of_gb(rule));
    let first = widths.next().map(|rule| name_and_width(rule).1);
    let rest: Vec<f64> = widths.map(|rule| name_and_width(rule).1).collect();
    let all_alike = !rest.is_empty() && rest.iter().all(|width| Some(*width) == first);
    let mut rows = Vec::new();
    let mut is_named = false;
    for rule in rules {
        if !(all_alike && of_gb(rule)) {
            rows.push((rule_name(name_and_width(rule).0), rule));
        } else if !is_named {
            rows.push((message::gb50011_of_every_intensity().to_owned(), rule));
            is_named = true;
        }
    }
    rows
}

/// A required width in words: whole millimetres, or hundredths of an inch, rounded up, with the unit; of zero that none is required.
#[must_use]
pub fn required_width(metres: f64) -> String {
    if metres <= 0.0 {
        return message::none_required().to_owned();
    }
    format!("{} {}", LENGTH.rounded_up(metres), LENGTH.name())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn equal_intensities_share_a_row() {
        let names = |rules: &[(&str, f64)]| -> Vec<String> {
            let rows = rows_of_rules(rules, |rule| (rule.0, rule.1));
            rows.into_iter().map(|(name, _)| name).collect()
        };
        assert_eq!(
            names(&[
                ("ABS", 0.1),
                ("GB 50011, intensity 6", 0.1),
                ("GB 50011, intensity 7", 0.1)
            ]),
            ["ABS", "GB 50011, every intensity"]
        );
        assert_eq!(
            names(&[
                ("GB 50011, intensity 6", 0.128),
                ("GB 50011, intensity 7", 0.135)
            ]),
            ["GB 50011, intensity 6", "GB 50011, intensity 7"]
        );
        assert_eq!(
            names(&[("GB 50011, intensity 6", 0.1)]),
            ["GB 50011, intensity 6"]
        );
    }

    /// 37.1 mm is 38 mm to build; 100 mm with rounding errors is not 101 mm.
    #[test]
    fn required_widths_are_rounded_up() {
        assert_eq!(required_width(0.0371), "38 mm");
        assert_eq!(required_width(0.1 + 1e-12), "100 mm");
        assert_eq!(required_width(0.0), "none required");
    }
}
