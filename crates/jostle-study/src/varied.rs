//! Description of the varied keys: every key, its range, and its value in the model.

use jostle_io::{DesignKind, Distribution, FactorValues, Level, Shape, TreeValue};

use jostle_report::{message, typeset};

use crate::key_words::label_in_words;
use crate::sampling::quantile;
use crate::study::Study;

/// Entries of a list or values of a model that are written out.
const MOST_SHOWN: usize = 4;
/// Digits up to which a value is written as it stands.
const MOST_DIGITS: usize = 6;
/// Between these probabilities lies what is called the range of a distribution without ends.
const RANGE: [f64; 2] = [0.05, 0.95];

/// A factor in words.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Varied {
    /// Its name.
    pub name: String,
    /// The keys of the model, separated by commas.
    pub keys: String,
    /// Its values: `10 mm … 30 mm, 5 values`, or `× 0.5 … 1.5 (uniform)`.
    pub range: String,
    /// Its value in the base model; empty if absent.
    pub own: String,
}

impl Varied {
    /// Its values and the value of the model, of a factor that is named already.
    #[must_use]
    pub fn values_in_words(&self) -> String {
        let range = match &self.range[..] {
            "false, true" => format!("{}, {}", message::no(), message::yes()),
            other => typeset(other),
        };
        match &self.own[..] {
            "" => message::values_not_stated(range),
            own => message::values_in_model(range, typeset(label_in_words(own))),
        }
    }

    /// Keys, values, and the value of the model, in one line.
    #[must_use]
    pub fn text(&self) -> String {
        let model_value = if self.own.is_empty() {
            "not stated in the model".to_owned()
        } else {
            format!("in the model {}", self.own)
        };
        let keys = match &self.keys[..] {
            "motion.pga" => "peak ground acceleration (motion.pga)",
            "motion.scale" => "factor on the record (motion.scale)",
            other => other,
        };
        format!("{keys}: {}; {model_value}", self.range)
    }
}

/// The varied keys of a study, by factor.
#[must_use]
pub fn varied(study: &Study) -> Vec<Varied> {
    let file = &study.file;
    let ends = match file.design.kind {
        DesignKind::OneAtATime => file.design.quantiles,
        _ => RANGE,
    };
    let one = |factor: &jostle_io::Factor| {
        let values = match &factor.values {
            FactorValues::Listed(levels) => listed(levels),
            FactorValues::Drawn(drawn) => distributed(drawn, ends),
            FactorValues::Table(column) => format!(
                "column of {} ({} rows)",
                column.table.path().display(),
                column.table.rows()
            ),
        };
        let mut model_values: Vec<String> = Vec::new();
        for value in factor.paths.iter().flat_map(|path| file.base.values(path)) {
            let text = match &value {
                TreeValue::List(list) => {
                    let all: Vec<String> = list.iter().map(ToString::to_string).collect();
                    format!("[{}]", shortened(&all, ", "))
                }
                other => other.to_string(),
            };
            if !model_values.contains(&text) {
                model_values.push(text);
            }
        }
        Varied {
            name: factor.name.clone(),
            keys: shortened(&factor.paths, ", "),
            range: if factor.multiplies {
                format!("× {values}")
            } else {
                values
            },
            own: shortened(&model_values, ", "),
        }
    };
    file.factors.iter().map(one).collect()
}

fn listed(levels: &[Level]) -> String {
    let labels: Vec<String> = levels.iter().map(|level| rounded(&level.label)).collect();
    match &labels[..] {
        [first, .., last] if labels.len() > MOST_SHOWN => {
            format!("{first} … {last} ({} values)", labels.len())
        }
        _ => labels.join(", "),
    }
}

/// A label whose number has no more than four digits, with its unit.
fn rounded(label: &str) -> String {
    let (number, unit) = label.split_once(' ').unwrap_or((label, ""));
    let digits = number.chars().filter(char::is_ascii_digit).count();
    match number.parse::<f64>() {
        Ok(value) if digits > MOST_DIGITS => {
            format!("{} {unit}", short(value)).trim_end().to_owned()
        }
        Ok(_) | Err(_) => label.to_owned(),
    }
}

fn distributed(drawn: &Distribution, ends: [f64; 2]) -> String {
    let unit = &drawn.unit;
    let [from, to] = ends.map(|p| quantile(drawn, p));
    let [low, high] = ends.map(|p| 100.0 * p);
    let shares = format!("{low:.0} to {high:.0} %");
    let text = match drawn.shape {
        Shape::Uniform { from, to } => format!("{from} … {to} {unit} (uniform)"),
        Shape::Normal { mean, deviation } => format!(
            "{} … {} {unit} ({shares} of a normal distribution, {} ± {})",
            short(from),
            short(to),
            short(mean),
            short(deviation)
        ),
        Shape::LogNormal { median, dispersion } => format!(
            "{} … {} {unit} ({shares} of a lognormal distribution, median {}, β {})",
            short(from),
            short(to),
            short(median),
            short(dispersion)
        ),
    };
    text.replace("  ", " ")
}

/// A number of any size with four digits.
fn short(number: f64) -> String {
    let text = format!("{number:.3e}");
    let plain = text.parse::<f64>().unwrap_or(number);
    if (1e-3..1e5).contains(&plain.abs()) {
        plain.to_string()
    } else {
        text.replace(".000e", "e")
    }
}

/// The first of several texts, and the last.
fn shortened(texts: &[String], between: &str) -> String {
    match texts {
        [first, second, .., last] if texts.len() > MOST_SHOWN => {
            format!("{first}{between}{second} … {last}")
        }
        _ => texts.join(between),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn long_fractions_are_rounded_and_units_kept() {
        let all = [
            "0.23333333333333334 g",
            "0.05 g",
            "120 mm",
            "hertz-damp",
            "0.41666666666666663",
        ];
        let texts = all.map(rounded);
        assert_eq!(
            texts,
            ["0.2333 g", "0.05 g", "120 mm", "hertz-damp", "0.4167"]
        );
    }
}
