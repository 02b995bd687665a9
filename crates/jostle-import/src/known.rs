//! What becomes of every key of the rows that are read: used, without effect, or missing from the building, with what that means.

use std::collections::BTreeMap;

/// A kind of row: a record of ETABS, or a table of SAP2000. Words are apart by blanks.
pub(crate) struct Kind {
    pub(crate) name: &'static str,
    /// Keys that are used.
    pub(crate) used: &'static str,
    /// Keys, and bare words behind keys, without effect on stiffness, geometry and mass of the building.
    pub(crate) harmless: &'static str,
    /// Keys that have an effect and are not used.
    pub(crate) missing: &'static [Missing],
}

/// Keys that have an effect, values with which they have none, and what it means that they are not used.
pub(crate) struct Missing {
    pub(crate) keys: &'static str,
    pub(crate) neutral: &'static [&'static str],
    pub(crate) meaning: &'static str,
}

/// What keys that nobody knows mean.
const UNKNOWN: &str = "keys that jostle does not know: what they say is not in the building; check them for misspelt ones";

/// Keys that are not used, by what that means.
#[derive(Default)]
pub(crate) struct Tally {
    found: BTreeMap<&'static str, BTreeMap<String, usize>>,
}

impl Tally {
    /// Notes a key of a row and its value.
    pub(crate) fn note(&mut self, kinds: &'static [Kind], kind: &str, key: &str, value: &str) {
        let of = kinds.iter().find(|candidate| candidate.name == kind);
        let has = |words: &str| words.split_whitespace().any(|word| word == key);
        if of.is_some_and(|kind| has(kind.used) || has(kind.harmless)) {
            return;
        }
        let missing = of.and_then(|kind| kind.missing.iter().find(|missing| has(missing.keys)));
        let is_neutral = |neutral: &&str| {
            neutral.eq_ignore_ascii_case(value)
                || crate::text::number(neutral)
                    .is_some_and(|neutral| crate::text::number(value) == Some(neutral))
        };
        if missing.is_some_and(|missing| missing.neutral.iter().any(is_neutral)) {
            return;
        }
        let meaning = missing.map_or(UNKNOWN, |missing| missing.meaning);
        let keys = self.found.entry(meaning).or_default();
        *keys.entry(format!("{key} of {kind}")).or_default() += 1;
    }

    /// One line for each meaning.
    pub(crate) fn lines(&self, file: &str) -> Vec<String> {
        let line = |(meaning, keys): (&&str, &BTreeMap<String, usize>)| {
            let keys: Vec<String> = keys
                .iter()
                .map(|(key, count)| match count {
                    1 => format!("{key} (once)"),
                    _ => format!("{key} ({count} times)"),
                })
                .collect();
            format!("{file}: {meaning}: {}", keys.join(", "))
        };
        self.found.iter().map(line).collect()
    }
}
