//! What is kept and what is minimised: sums of named quantities, and conditions on them.

use jostle_io::{Dimension, Factor, FactorValues, nearest_name, parse_quantity};

use super::text::power_suffix;
use crate::layout::Layout;

/// A quantity of a trial.
#[derive(Clone, Debug, PartialEq)]
pub(super) enum Source {
    /// A varied key, by its number among those that vary.
    Input(usize),
    /// The greatest of some results, by their places in the layout.
    Results(Vec<usize>),
}

/// A sum of quantities with factors.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Expression {
    /// As typed.
    pub(super) text: String,
    /// Factors and indices into the list of quantities.
    pub(super) terms: Vec<(f64, usize)>,
    /// End of the names of its unit, such as `_m`; empty where terms differ or have none.
    pub(super) suffix: String,
}

/// How an expression is compared.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Relation {
    Below,
    AtMost,
    Equal,
    AtLeast,
    Above,
}

/// A condition that the solution keeps.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Condition {
    pub(super) left: Expression,
    pub(super) relation: Relation,
    /// In SI.
    pub(super) right: f64,
    /// As typed.
    pub(super) text: String,
}

/// Names that expressions may use, and those that they do.
pub(super) struct Names<'a> {
    factors: Vec<&'a Factor>,
    columns: Vec<&'a str>,
    layout: &'a Layout,
    /// Quantities in use: name and source, each once.
    pub(super) used: Vec<(String, Source)>,
}

/// The relations, the longer signs first.
const RELATIONS: [(&str, Relation); 5] = [
    ("<=", Relation::AtMost),
    (">=", Relation::AtLeast),
    ("==", Relation::Equal),
    ("<", Relation::Below),
    (">", Relation::Above),
];
/// Words that stand for all of a kind.
const KINDS: [&str; 5] = ["link", "gap", "contact", "building", "floor"];
/// Names in a message.
const MOST_NAMED: usize = 12;

/// Units of results by the ends of their names, the longer ones first.
pub(super) const SUFFIXES: [(&str, Dimension); 9] = [
    ("_m_s2", Dimension::Acceleration),
    ("_n_s_m", Dimension::Damping),
    ("_m_s", Dimension::Speed),
    ("_n_m", Dimension::Moment),
    ("_kg", Dimension::Mass),
    ("_hz", Dimension::Frequency),
    ("_m", Dimension::Length),
    ("_n", Dimension::Force),
    ("_s", Dimension::Time),
];

impl<'a> Names<'a> {
    /// Names of the varied keys, of their columns and of the results.
    pub(super) fn new(factors: Vec<&'a Factor>, layout: &'a Layout) -> Self {
        let inputs = layout.inputs.iter().map(|column| &column.name[..]);
        Self {
            columns: inputs.take(factors.len()).collect(),
            factors,
            layout,
            used: Vec::new(),
        }
    }

    /// Reads `a`, `2 * a + b`, `a - b`.
    pub(super) fn expression(&mut self, option: &str, text: &str) -> Result<Expression, String> {
        let wrong = |problem: &str| {
            format!(
                "{option} \"{text}\": {problem}; write a name, or a sum such as \"2 * link.force_peak_n + gap.width\", factors first"
            )
        };
        let mut terms: Vec<(f64, usize)> = Vec::new();
        let mut suffixes: Vec<String> = Vec::new();
        let mut sign = 1.0;
        let mut factor: Option<f64> = None;
        let mut after_term = false;
        // Blanks stand around operators, because names contain - and *.
        for word in text.split_whitespace() {
            match word {
                "+" | "-" if after_term => {
                    sign = if word == "+" { 1.0 } else { -1.0 };
                    after_term = false;
                }
                "*" if factor.is_some() && !after_term => {}
                _ if after_term => return Err(wrong(&format!("\"{word}\" was not expected"))),
                _ => {
                    if let (None, Ok(number)) = (factor, word.parse::<f64>()) {
                        factor = Some(number);
                        continue;
                    }
                    let (number, name) = match word.split_once('*') {
                        Some((number, name)) if number.parse::<f64>().is_ok() => {
                            (number.parse().ok(), name)
                        }
                        _ => (None, word),
                    };
                    let size = sign * number.or(factor).unwrap_or(1.0);
                    let (index, suffix) = self.find(option, name)?;
                    terms.push((size, index));
                    suffixes.push(suffix);
                    (sign, factor, after_term) = (1.0, None, true);
                }
            }
        }
        if terms.is_empty() || !after_term {
            return Err(wrong("a name is missing"));
        }
        if terms.iter().any(|(size, _)| !size.is_finite()) {
            return Err(wrong("a factor is not a usable number"));
        }
        let same = suffixes.windows(2).all(|pair| pair[0] == pair[1]);
        let suffix = suffixes.pop().filter(|_| same).unwrap_or_default();
        Ok(Expression {
            text: text.trim().to_owned(),
            terms,
            suffix,
        })
    }

    /// Reads `impact_count == 0`, `A.drift_peak <= 0.01`, `floor.total_acceleration_peak_m_s2 < 3 m/s2`.
    pub(super) fn condition(&mut self, text: &str) -> Result<Condition, String> {
        let option = "--keep";
        let found = RELATIONS
            .iter()
            .find_map(|(sign, relation)| Some((text.split_once(sign)?, *relation)));
        let Some(((left, right), relation)) = found else {
            return Err(format!(
                "{option} \"{text}\": a comparison is missing; write it like \"impact_count == 0\" or \"floor.displacement_max_m <= 50 mm\""
            ));
        };
        let left = self.expression(option, left)?;
        let right = right.trim();
        let dimension = dimension_of(&left.suffix);
        let number = match (right.parse::<f64>(), dimension) {
            (Ok(number), _) => Some(number),
            (Err(_), Some(dimension)) => {
                let parsed = parse_quantity(right, dimension);
                Some(parsed.map_err(|error| format!("{option} \"{text}\": {error}"))?)
            }
            (Err(_), None) => parse_quantity(right, Dimension::Dimensionless).ok(),
        };
        let right = number.filter(|number| number.is_finite()).ok_or_else(|| {
            format!("{option} \"{text}\": expected a number in SI on the right, found \"{right}\"")
        })?;
        Ok(Condition {
            left,
            relation,
            right,
            text: text.trim().to_owned(),
        })
    }

    /// Index of a quantity in use, and the end of its name.
    fn find(&mut self, option: &str, name: &str) -> Result<(usize, String), String> {
        let (source, suffix) = self
            .source(name)
            .ok_or_else(|| self.unknown(option, name))?;
        let known = self.used.iter().position(|(_, known)| *known == source);
        let index = known.unwrap_or_else(|| {
            self.used.push((name.to_owned(), source));
            self.used.len() - 1
        });
        Ok((index, suffix))
    }

    fn source(&self, name: &str) -> Option<(Source, String)> {
        let inputs = self.factors.iter().zip(&self.columns);
        let input = inputs
            .enumerate()
            .find(|(_, (factor, column))| factor.name == name || **column == name);
        if let Some((index, (factor, _))) = input {
            let power = match &factor.values {
                FactorValues::Drawn(drawn) => power_suffix(&drawn.unit),
                FactorValues::Listed(_) | FactorValues::Table(_) => None,
            };
            let suffix = match power {
                Some(power) => power,
                None if factor.unit.is_empty() => String::new(),
                None => format!("_{}", factor.unit),
            };
            return Some((Source::Input(index), suffix));
        }
        let suffix = || {
            let known = SUFFIXES.iter().find(|(suffix, _)| name.ends_with(suffix));
            known.map_or_else(String::new, |(suffix, _)| (*suffix).to_owned())
        };
        if let Some(place) = self.layout.place(name) {
            return Some((Source::Results(vec![place]), suffix()));
        }
        let (kind, quantity) = name.split_once('.')?;
        // The greatest magnitude of the history `….force_n` of links.
        let quantity = if (kind, quantity) == ("link", "force_n") {
            "force_peak_n"
        } else {
            quantity
        };
        let of_kind = |column: &str| {
            let Some(place) = column
                .strip_suffix(quantity)
                .and_then(|rest| rest.strip_suffix('.'))
            else {
                return false;
            };
            let (owner, last) = place.rsplit_once('.').unwrap_or((place, ""));
            let counted = |word: &str| {
                last.strip_prefix(word)
                    .is_some_and(|number| number.chars().all(|c| c.is_ascii_digit() || c == '-'))
            };
            let single =
                counted("floor") && !last.contains('-') && !last["floor".len()..].is_empty();
            match kind {
                "link" => counted("link"),
                "floor" => single,
                "contact" => !last.is_empty() && !counted("link") && !single,
                "gap" => last.is_empty() && self.is_gap(owner),
                "building" => last.is_empty() && !self.is_gap(owner),
                _ => false,
            }
        };
        let results = self.layout.results.iter().enumerate();
        let places: Vec<usize> = results
            .filter(|(_, column)| of_kind(&column.name))
            .map(|(place, _)| place)
            .collect();
        (!places.is_empty() && KINDS.contains(&kind)).then(|| (Source::Results(places), suffix()))
    }

    /// Whether results of this owner are those of a gap.
    fn is_gap(&self, owner: &str) -> bool {
        self.layout
            .place(&format!("{owner}.pounding_count"))
            .is_some()
    }

    fn unknown(&self, option: &str, name: &str) -> String {
        let results = self.layout.results.iter().map(|column| &column.name[..]);
        let inputs = self.factors.iter().map(|factor| &factor.name[..]);
        let all: Vec<&str> = inputs.chain(results).collect();
        let near = match nearest_name(name, all.iter().copied()) {
            Some(name) => format!("; did you mean \"{name}\"?"),
            None => ".".to_owned(),
        };
        let last = name.rsplit('.').next().unwrap_or(name);
        let similar: Vec<&str> = all
            .iter()
            .copied()
            .filter(|known| !last.is_empty() && known.contains(last))
            .take(MOST_NAMED)
            .collect();
        let similar = if similar.is_empty() {
            let shown: Vec<&str> = all.iter().copied().take(MOST_NAMED).collect();
            format!("{}, …", shown.join(", "))
        } else {
            similar.join(", ")
        };
        format!(
            "{option}: there is no quantity \"{name}\"{near} Varied keys and results have the names of a study; link, gap, contact, building and floor stand for the greatest of their kind, as in floor.displacement_max_m. Similar: {similar}"
        )
    }
}

fn dimension_of(suffix: &str) -> Option<Dimension> {
    let known = SUFFIXES.iter().find(|(known, _)| *known == suffix);
    known.map(|(_, dimension)| *dimension)
}

impl Expression {
    /// Its value from those of the quantities; `None` if one is absent.
    pub(super) fn value(&self, quantities: &[Option<f64>]) -> Option<f64> {
        let mut sum = 0.0;
        for (size, index) in &self.terms {
            sum += size * quantities.get(*index).copied().flatten()?;
        }
        Some(sum).filter(|sum| sum.is_finite())
    }
}

impl Condition {
    /// How far a value is from keeping the condition, relative to the right side or, if that is zero, as it is; 0 if it is
    /// kept \[–\].
    pub(super) fn violation(&self, value: f64) -> f64 {
        let scale = if self.right == 0.0 {
            1.0
        } else {
            self.right.abs()
        };
        let excess = (value - self.right) / scale;
        match self.relation {
            Relation::AtMost => excess.max(0.0),
            Relation::AtLeast => (-excess).max(0.0),
            Relation::Equal => excess.abs(),
            Relation::Below if value < self.right => 0.0,
            Relation::Above if value > self.right => 0.0,
            Relation::Below | Relation::Above => excess.abs().max(f64::MIN_POSITIVE),
        }
    }
}
