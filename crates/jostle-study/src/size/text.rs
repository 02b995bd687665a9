//! A search on one screen.

use std::fmt::Write;
use std::path::Path;

use jostle_io::shown::{ACCELERATION, ENERGY, FORCE, LARGE_DASHPOT, LENGTH, MASS, MOMENT, SPEED};

use super::SizeResults;
use super::expression::SUFFIXES;
use crate::key_words::key_in_words;

/// Before the exponent in the suffix of a dashpot whose force is a power of the speed.
const POWER: &str = "_n_(s/m)^";

/// The suffix of a number in a unit such as `kN.(s/m)^0.5`; `None` for other units, whose names say their suffix.
pub(super) fn power_suffix(text: &str) -> Option<String> {
    let (_, exponent) = text.split_once("(s/m)^")?;
    Some(format!("{POWER}{}", exponent.trim()))
}

/// Unit in which numbers with the end of such a name are shown, and its size.
pub(super) fn shown(suffix: &str) -> (String, f64) {
    if let Some(exponent) = suffix.strip_prefix(POWER) {
        let unit = format!("{}·(s/m)^{exponent}", FORCE.name());
        return (unit, FORCE.of(1.0));
    }
    let unit = match suffix {
        "_m" => LENGTH,
        "_n" => FORCE,
        "_n_m" => MOMENT,
        "_n_s_m" => LARGE_DASHPOT,
        "_j" => ENERGY,
        "_m_s" => SPEED,
        "_m_s2" => ACCELERATION,
        "_kg" => MASS,
        "_s" => return ("s".to_owned(), 1.0),
        "_hz" => return ("Hz".to_owned(), 1.0),
        _ => return (String::new(), 1.0),
    };
    (unit.name().to_owned(), unit.of(1.0))
}

/// A number with its unit, five digits.
pub(super) fn number(value: f64, suffix: &str) -> String {
    let (unit, size) = shown(suffix);
    let value = size * value;
    let text = if value == 0.0 {
        "0".to_owned()
    } else {
        let magnitude = libm::log10(value.abs()).floor() as i32;
        if (-4..7).contains(&magnitude) {
            let decimals = usize::try_from(4 - magnitude).unwrap_or(0);
            let text = format!("{value:.decimals$}");
            if text.contains('.') {
                text.trim_end_matches('0').trim_end_matches('.').to_owned()
            } else {
                text
            }
        } else {
            format!("{value:.4e}")
        }
    };
    if unit.is_empty() {
        text
    } else {
        format!("{text} {unit}")
    }
}

/// A least value in words: rounded up, so that what it meets is met, to one decimal or three digits.
pub(super) fn rounded_up(value: f64, suffix: &str) -> String {
    let (unit, size) = shown(suffix);
    let shown_value = size * value;
    let decimals = if shown_value == 0.0 || shown_value.abs() >= 1.0 {
        1
    } else {
        (2 - libm::log10(shown_value.abs()).floor() as i32).clamp(1, 9)
    };
    let steps = libm::pow(10.0, f64::from(decimals));
    let up = (shown_value * steps - 1e-6).ceil() / steps;
    format!("{up:.*} {unit}", decimals as usize)
        .trim_end()
        .to_owned()
}

/// A key, a result or a condition in words: `gap.width` is the gap, `impact_count == 0` no impact.
pub(super) fn in_words(text: &str) -> String {
    const WORDS: [(&str, &str); 12] = [
        ("impact_count == 0", "no impact"),
        ("impact_count <= 0", "no impact"),
        ("impact_count < 1", "no impact"),
        ("impact_count", "number of impacts"),
        ("gap.width", "gap"),
        ("peak_force_n", "peak force"),
        ("closing_peak_m", "peak closing"),
        ("base_shear_peak_n", "peak base shear"),
        ("drift_peak", "peak drift"),
        ("<=", "≤"),
        (">=", "≥"),
        ("==", "="),
    ];
    // The gap, where there is one.
    let text = text.replace("gap[0].", "gap.");
    let replaced = WORDS
        .iter()
        .fold(text, |text, (name, words)| text.replace(name, words));
    // Keys among numbers and signs.
    let is_key = |word: &&str| word.contains(char::is_alphabetic);
    let words = replaced
        .split(' ')
        .map(|word| match Some(word).filter(is_key) {
            Some(key) => result_in_words(key),
            None => word.to_owned(),
        });
    words.collect::<Vec<_>>().join(" ")
}

/// A key or a result in words: `floor.displacement_max_m` is "greatest displacement of a floor".
fn result_in_words(key: &str) -> String {
    const ENDS: [(&str, &str); 3] = [("_peak", "peak"), ("_max", "greatest"), ("_min", "least")];
    let suffixes = SUFFIXES.iter().map(|(suffix, _)| *suffix);
    let known = suffixes.filter(|suffix| key.ends_with(suffix));
    let longest = known.max_by_key(|suffix| suffix.len());
    let Some((quantity, words)) = longest.and_then(|suffix| {
        let plain = key.strip_suffix(suffix)?;
        ENDS.iter()
            .find_map(|(end, words)| Some((plain.strip_suffix(end)?, words)))
    }) else {
        return key_in_words(key);
    };
    let spaced = |text: &str| text.replace('_', " ");
    match quantity.rsplit_once('.') {
        Some((owner @ ("floor" | "building" | "gap" | "link" | "contact"), quantity)) => {
            format!("{words} {} of a {owner}", spaced(quantity))
        }
        Some((owner, quantity)) => format!("{words} {} of {owner}", spaced(quantity)),
        None => format!("{words} {}", spaced(quantity)),
    }
}

/// A value as written into the model, with five digits.
pub(super) fn rounded(text: &str) -> String {
    let end = text.find(' ').unwrap_or(text.len());
    match text[..end].parse::<f64>() {
        Ok(value) => format!("{}{}", number(value, ""), &text[end..]),
        Err(_) => text.to_owned(),
    }
}

impl SizeResults {
    /// The result in sentences.
    #[must_use]
    pub fn headline(&self) -> Vec<String> {
        let mut sentences = Vec::new();
        let keeping = match self.conditions.len() {
            0 => String::new(),
            _ => {
                let texts: Vec<String> =
                    self.conditions.iter().map(|c| in_words(&c.text)).collect();
                format!(" with {}", texts.join(" and "))
            }
        };
        match self.best() {
            Some(best) => {
                let objective = best.objective.unwrap_or(f64::NAN);
                let inputs = self.inputs.iter().zip(&best.inputs);
                let inputs: Vec<String> = inputs
                    .map(|((name, _), (_, text))| format!("{} {}", in_words(name), rounded(text)))
                    .collect();
                // A search that did not end by itself has a best trial, not a least value.
                let (least, so_far) = if self.converged {
                    ("Smallest", "")
                } else {
                    ("Not converged; smallest", " so far")
                };
                // An objective that is the only input has said where it lies.
                let is_input = self.inputs.len() == 1 && self.inputs[0].0 == self.objective.text;
                let at = if is_input {
                    String::new()
                } else {
                    format!(", at {}", inputs.join(", "))
                };
                sentences.push(format!(
                    "{least} {}{keeping}{so_far}: {}{at}.",
                    in_words(&self.objective.text),
                    rounded_up(objective, &self.objective.suffix),
                ));
            }
            None => sentences.push(format!(
                "None of the {} trials meets {}; widen the bounds or relax a condition.",
                self.trials.len(),
                keeping.trim_start_matches(" with ")
            )),
        }
        sentences.extend(self.under_the_other_sign());
        if self.motions.len() == 1 {
            sentences.push(jostle_report::message::one_record_is_no_design_value().to_owned());
        }
        sentences.push(if self.converged {
            format!("Converged after {} trials.", self.trials.len())
        } else if self.stopped {
            format!("Stopped after {} trials.", self.trials.len())
        } else {
            let lower = match self.best() {
                Some(_) => " The true minimum may be lower; raise --trials.",
                None => "",
            };
            format!(
                "Stopped after {} trials before converging: the next round would exceed --trials.{lower}",
                self.trials.len()
            )
        });
        sentences
    }

    /// What the best trial leads to under the motions with the other sign.
    fn under_the_other_sign(&self) -> Option<String> {
        let trial = self.reversed.as_ref()?;
        if trial.keeps() {
            return (!self.conditions.is_empty())
                .then(|| "Also met with the motion reversed.".to_owned());
        }
        let violated = self.conditions.iter().zip(&trial.kept);
        let violated = violated
            .filter(|(condition, left)| left.is_none_or(|left| condition.violation(left) > 0.0));
        let violated = violated.map(|(condition, left)| {
            let left = left.map_or_else(|| "–".into(), |left| number(left, &condition.left.suffix));
            format!("{} {left}", in_words(&condition.left.text))
        });
        Some(format!(
            "Violated with the motion reversed: {}. --both-signs searches for both.",
            violated.collect::<Vec<_>>().join(", ")
        ))
    }

    /// The results as text. `page` is named at the end.
    #[must_use]
    pub fn describe(&self, page: Option<&Path>) -> String {
        let mut text = format!("{}\n\n", jostle_run::styled(jostle_run::BOLD, &self.title));
        for sentence in self.headline() {
            // Writing to a string cannot fail.
            let _ = writeln!(text, "  {sentence}");
        }
        if let Some(best) = self.best() {
            text.push('\n');
            // A minimised key stands in the first sentence.
            let (inputs, objective) = (self.inputs.iter(), &self.objective.text);
            let others = inputs
                .zip(&best.inputs)
                .filter(|((name, _), _)| name != objective);
            for ((name, _), (_, value)) in others {
                let _ = writeln!(text, "  {name:<28} {}", rounded(value));
            }
            let is_key = self.inputs.iter().any(|(name, _)| name == objective);
            if !is_key {
                let objective = best.objective.unwrap_or(f64::NAN);
                let objective = number(objective, &self.objective.suffix);
                let _ = writeln!(text, "  {:<28} {objective}", self.objective.text);
            }
            for (condition, left) in self.conditions.iter().zip(&best.kept) {
                let left =
                    left.map_or_else(|| "–".into(), |left| number(left, &condition.left.suffix));
                let _ = writeln!(
                    text,
                    "  {:<28} {left}   (met: {})",
                    condition.left.text, condition.text
                );
            }
        }
        for (index, condition) in self.conditions.iter().enumerate() {
            let front = self.trade_off(index);
            if front.len() > 1 {
                let _ = writeln!(
                    text,
                    "\n  {:<28} least {}",
                    condition.left.text, self.objective.text
                );
                let step = front.len().div_ceil(8).max(1);
                for pair in front.iter().step_by(step) {
                    let _ = writeln!(
                        text,
                        "  {:<28} {}",
                        number(pair[0], &condition.left.suffix),
                        number(pair[1], &self.objective.suffix)
                    );
                }
            }
        }
        if let Some(page) = page {
            let _ = write!(text, "\n  {}", page.display());
        }
        text
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn dashpots_of_a_power_of_the_speed_have_their_unit() {
        let suffix = power_suffix("50 kN.(s/m)^0.5").expect("a power");
        assert_eq!(rounded_up(411_957.558, &suffix), "412.0 kN·(s/m)^0.5");
        assert_eq!(number(411_957.558, &suffix), "411.96 kN·(s/m)^0.5");
        assert_eq!(shown(&suffix).0, "kN·(s/m)^0.5");
        assert_eq!(power_suffix("100 kN.s/m"), None);
        assert_eq!(rounded_up(483.6e3, "_n_s_m"), "483.6 kN·s/m");
    }
}
