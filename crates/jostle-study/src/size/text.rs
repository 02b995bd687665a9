//! A search on one screen.

use std::fmt::Write;
use std::path::Path;

use jostle_io::shown::{ACCELERATION, ENERGY, FORCE, LARGE_DASHPOT, LENGTH, MASS, MOMENT, SPEED};

use super::SizeResults;

/// Unit in which numbers with the end of such a name are shown, and its size.
pub(super) fn shown(suffix: &str) -> (&'static str, f64) {
    let own = match suffix {
        "_m" => LENGTH,
        "_n" => FORCE,
        "_n_m" => MOMENT,
        "_n_s_m" => LARGE_DASHPOT,
        "_j" => ENERGY,
        "_m_s" => SPEED,
        "_m_s2" => ACCELERATION,
        "_kg" => MASS,
        "_s" => return ("s", 1.0),
        "_hz" => return ("Hz", 1.0),
        _ => return ("", 1.0),
    };
    (own.name(), own.of(1.0))
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
                let texts: Vec<&str> = self.conditions.iter().map(|c| &c.text[..]).collect();
                format!(" with {}", texts.join(" and "))
            }
        };
        match self.best() {
            Some(best) => {
                let objective = best.objective.unwrap_or(f64::NAN);
                let inputs = self.inputs.iter().zip(&best.inputs);
                let inputs: Vec<String> = inputs
                    .map(|((name, _), (_, text))| format!("{name} = {}", rounded(text)))
                    .collect();
                // A search that did not end by itself has a best trial, not a least value.
                let least = if self.converged {
                    "Smallest"
                } else {
                    "Not converged; smallest so far of"
                };
                // An objective that is the only input has said where it lies.
                let is_input = self.inputs.len() == 1 && self.inputs[0].0 == self.objective.text;
                let at = if is_input {
                    String::new()
                } else {
                    format!(", at {}", inputs.join(", "))
                };
                sentences.push(format!(
                    "{least} {}{keeping}: {}{at}.",
                    self.objective.text,
                    number(objective, &self.objective.suffix),
                ));
            }
            None => sentences.push(format!(
                "None of the {} trials keeps {}; widen the bounds or relax a condition.",
                self.trials.len(),
                keeping.trim_start_matches(" with ")
            )),
        }
        sentences.push(if self.converged {
            format!("The search ended by itself after {} trials.", self.trials.len())
        } else if self.stopped {
            format!("The search was stopped after {} trials.", self.trials.len())
        } else {
            format!(
                "The search stopped at {} trials before it converged: the smallest may lie lower. Raise --trials.",
                self.trials.len()
            )
        });
        sentences
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
            for ((name, _), (_, value)) in self.inputs.iter().zip(&best.inputs) {
                let _ = writeln!(text, "  {name:<28} {}", rounded(value));
            }
            let is_key = self
                .inputs
                .iter()
                .any(|(name, _)| *name == self.objective.text);
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
                    "  {:<28} {left}   (kept: {})",
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
