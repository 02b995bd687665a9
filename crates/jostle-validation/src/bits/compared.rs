//! What moved in the results of a model, in words that name model and number.

use std::collections::HashMap;
use std::fmt;

use super::numbers::{DIGESTS, Entries};

/// Spans of histories, each with the digest of all that moved in it.
const SPANS: &str = ".history.spans[";
/// Quantities of histories.
const COLUMNS: &str = ".history.columns.";
/// Quantities of histories that a message names.
const NAMED: usize = 6;

/// A value that differs from the one on record.
#[derive(Clone, Debug, PartialEq)]
pub struct Change {
    /// Its place in the results.
    pub path: String,
    /// On record; `None` if it is new.
    pub old: Option<String>,
    /// Now; `None` if it is gone.
    pub new: Option<String>,
}

impl Change {
    /// Difference over the greater magnitude; `None` unless both are numbers \[–\].
    #[must_use]
    pub fn relative(&self) -> Option<f64> {
        let number = |value: &Option<String>| value.as_ref()?.parse::<f64>().ok();
        let (old, new) = (number(&self.old)?, number(&self.new)?);
        Some((new - old).abs() / old.abs().max(new.abs()))
    }
}

impl fmt::Display for Change {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let path = self.path.trim_start_matches('.');
        match (&self.old, &self.new) {
            (Some(old), Some(new)) => write!(f, "{path}: {old} → {new}"),
            (None, Some(new)) => write!(f, "{path}: new, {new}"),
            (Some(old), None) => write!(f, "{path}: gone, {old}"),
            (None, None) => write!(f, "{path}"),
        }
    }
}

/// What moved in one model.
#[derive(Clone, Debug, PartialEq)]
pub struct Moved {
    /// Model and solver.
    pub name: String,
    /// Values on record.
    pub recorded: usize,
    /// Numbers that moved.
    pub numbers: usize,
    /// Digests and texts that moved.
    pub texts: usize,
    /// Values that are new.
    pub added: usize,
    /// Values that are gone.
    pub gone: usize,
    /// The first number that moved; if none did, the first text, digest, or value that is new or gone.
    pub first: Change,
    /// The number that moved most, and its relative change.
    pub greatest: Option<(Change, f64)>,
    /// First span of time in which histories moved \[s\].
    pub span: Option<[f64; 2]>,
    /// Quantities of histories that moved, in the first quarter of the run in which any did.
    pub columns: Vec<String>,
}

impl Moved {
    /// Compares results with those on record; `None` if all are the same.
    #[must_use]
    pub(super) fn find(name: &str, old: &Entries, new: &Entries) -> Option<Self> {
        let recorded: HashMap<&str, &str> = old.iter().map(|(p, v)| (&p[..], &v[..])).collect();
        let computed: HashMap<&str, &str> = new.iter().map(|(p, v)| (&p[..], &v[..])).collect();
        let change = |path: &str| Change {
            path: path.to_owned(),
            old: recorded.get(path).map(ToString::to_string),
            new: computed.get(path).map(ToString::to_string),
        };
        let differs = new
            .iter()
            .filter(|(p, v)| recorded.get(&p[..]) != Some(&&v[..]));
        let lost = old.iter().filter(|(p, _)| !computed.contains_key(&p[..]));
        let changes: Vec<Change> = differs.chain(lost).map(|(path, _)| change(path)).collect();
        let is_number = |change: &&Change| change.relative().is_some();
        let both = |change: &&Change| change.old.is_some() && change.new.is_some();
        let first = changes.iter().find(is_number).or(changes.first())?.clone();
        let numbers = changes.iter().filter(is_number).count();
        let ratios = changes.iter().filter_map(|change| {
            // What is left of balances is rounding.
            let rounding = change.path.contains("imbalance");
            Some((change, change.relative()?)).filter(|_| !rounding)
        });
        let greatest = ratios.max_by(|a, b| a.1.total_cmp(&b.1));
        Some(Self {
            name: name.to_owned(),
            recorded: old.len(),
            numbers,
            texts: changes.iter().filter(both).count() - numbers,
            added: changes.iter().filter(|change| change.old.is_none()).count(),
            gone: changes.iter().filter(|change| change.new.is_none()).count(),
            greatest: greatest.map(|(change, ratio)| (change.clone(), ratio)),
            span: first_span(&changes, &computed),
            columns: first_columns(&changes),
            first,
        })
    }
}

/// First span of histories that moved \[s\].
fn first_span(changes: &[Change], computed: &HashMap<&str, &str>) -> Option<[f64; 2]> {
    let spans = changes
        .iter()
        .filter_map(|change| change.path.strip_prefix(SPANS)?.strip_suffix(']'));
    let first = spans.filter_map(|index| index.parse::<u32>().ok()).min()?;
    let length: f64 = computed.get(".history.span_s")?.parse().ok()?;
    Some([f64::from(first) * length, f64::from(first + 1) * length])
}

/// Quantities of histories that moved first.
fn first_columns(changes: &[Change]) -> Vec<String> {
    let moved = changes.iter().filter_map(|change| {
        let name = change.path.strip_prefix(COLUMNS)?.strip_suffix(DIGESTS)?;
        let (old, new) = (change.old.as_ref()?, change.new.as_ref()?);
        let parts = old.trim_matches('"').split(' ');
        let mut pairs = parts.zip(new.trim_matches('"').split(' '));
        Some((pairs.position(|(old, new)| old != new)?, name))
    });
    let moved: Vec<(usize, &str)> = moved.collect();
    let Some(first) = moved.iter().map(|(part, _)| *part).min() else {
        return Vec::new();
    };
    let those = moved.iter().filter(|(part, _)| *part == first);
    those.map(|(_, name)| (*name).to_owned()).collect()
}

impl fmt::Display for Moved {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}: ", self.name)?;
        if self.recorded == 0 {
            return write!(f, "not on record");
        }
        if self.gone == self.recorded && self.added == 0 {
            return write!(f, "no longer computed");
        }
        write!(f, "{} numbers", self.numbers)?;
        for (count, what) in [
            (self.texts, "texts and digests"),
            (self.added, "new values"),
            (self.gone, "lost values"),
        ] {
            if count > 0 {
                write!(f, ", {count} {what}")?;
            }
        }
        write!(f, " of {} moved\n  first: {}", self.recorded, self.first)?;
        if let Some((change, ratio)) = &self.greatest {
            write!(f, "\n  most, by {ratio:.1e}: {change}")?;
        }
        if let Some([from, to]) = self.span {
            write!(f, "\n  histories from t = {from:.3} … {to:.3} s on")?;
            if let Some((last, rest)) = self.columns.split_last() {
                let named: Vec<&str> = rest
                    .iter()
                    .chain([last])
                    .take(NAMED)
                    .map(String::as_str)
                    .collect();
                write!(f, ": {}", named.join(", "))?;
                if self.columns.len() > NAMED {
                    write!(f, " and {} more", self.columns.len() - NAMED)?;
                }
            }
        }
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    use serde_json::json;

    use super::super::numbers::entries;
    use super::{Change, Moved};

    fn find(old: &serde_json::Value, new: &serde_json::Value) -> Option<Moved> {
        Moved::find("towers modal", &entries(old), &entries(new))
    }

    #[test]
    fn the_first_and_the_greatest_change_are_named() {
        let history = |span: &str, digests: &str| {
            json!({"span_s": 0.5, "spans": ["aa", span, span],
                "columns": {"displacement": {"digests": digests, "last": 1.0}, "time": {"digests": "1 1"}}})
        };
        let old = json!({"buildings": [{"name": "A", "drift": 0.1, "shear": 2.5}], "notes": ["x"],
            "history": history("bb", "1 2 3 4")});
        let new = json!({"buildings": [{"name": "A", "drift": 0.100_000_000_000_000_02, "shear": 2.0}],
            "notes": ["y"], "history": history("cc", "1 2 0 0")});
        assert_eq!(find(&old, &old), None);
        let moved = find(&old, &new).expect("two numbers differ");
        assert_eq!((moved.numbers, moved.texts), (2, 4));
        assert_eq!(
            moved.first,
            Change {
                path: ".buildings[0].drift".into(),
                old: Some("0.1".into()),
                new: Some("0.10000000000000002".into()),
            }
        );
        let text = moved.to_string();
        assert!(
            text.starts_with("towers modal: 2 numbers, 4 texts and digests of 11 moved"),
            "{text}"
        );
        assert!(
            text.contains("most, by 2.0e-1: buildings[0].shear: 2.5 → 2.0"),
            "{text}"
        );
        assert!(
            text.contains("from t = 0.500 … 1.000 s on: displacement"),
            "{text}"
        );
    }

    #[test]
    fn zero_has_no_sign_and_new_values_are_named() {
        assert_eq!(find(&json!({"x": -0.0}), &json!({"x": 0.0})), None);
        let moved = find(&json!({"x": 1, "z": 2}), &json!({"x": 1, "y": 3})).expect("y is new");
        assert_eq!((moved.added, moved.gone, moved.numbers), (1, 1, 0));
        assert_eq!(moved.first.to_string(), "y: new, 3");
    }

    #[test]
    fn one_bit_in_a_long_list_moves_its_column() {
        let list = |value: f64| json!({"points": (0..40).map(|k| json!({"a": k, "b": if k == 30 { value } else { 0.5 }})).collect::<Vec<_>>()});
        let moved = find(&list(0.25), &list(0.250_000_000_000_000_06)).expect("one bit differs");
        assert_eq!((moved.numbers, moved.texts), (1, 1));
        assert_eq!(moved.first.path, ".points[].b.least");
    }
}
