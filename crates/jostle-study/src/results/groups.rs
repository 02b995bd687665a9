//! Cases that share the values of some factors.

use std::collections::BTreeMap;

use jostle_io::FactorValues;

use super::Results;
use crate::design::Choice;
use crate::key_words::{key_in_words, label_in_words};
use crate::layout::Kind;

impl Results<'_> {
    /// Cases by the entries of some listed factors, with the entries in words, in the order of the lists.
    pub(super) fn grouped(&self, factors: &[usize]) -> Vec<(String, Vec<usize>)> {
        let study = self.study;
        let mut groups: BTreeMap<Vec<usize>, Vec<usize>> = BTreeMap::new();
        for case in 0..self.table.rows {
            let choices = study
                .design
                .choices(self.sample.case(case), &study.file.factors);
            let key: Vec<usize> = factors
                .iter()
                .map(|factor| match choices[*factor] {
                    Choice::Listed(entry) => entry,
                    Choice::Drawn(_) => 0,
                })
                .collect();
            groups.entry(key).or_default().push(case);
        }
        let name = |key: &[usize]| {
            let parts = factors.iter().zip(key).map(|(factor, entry)| {
                let factor = &study.file.factors[*factor];
                match &factor.values {
                    FactorValues::Listed(levels) => {
                        let label = label_in_words(&levels[*entry].label);
                        let name = key_in_words(&factor.name);
                        if factor.name.ends_with("record") || factor.name == "motion" {
                            label.to_owned()
                        } else if factor.multiplies {
                            format!("{name} × {label}")
                        } else {
                            format!("{name} {label}")
                        }
                    }
                    FactorValues::Drawn(_) | FactorValues::Table(_) => key_in_words(&factor.name),
                }
            });
            parts.collect::<Vec<_>>().join(", ")
        };
        groups
            .into_iter()
            .map(|(key, cases)| (name(&key), cases))
            .collect()
    }

    /// Factors with a list of at least two values.
    pub(super) fn listed(&self) -> Vec<usize> {
        let factors = self.study.file.factors.iter().enumerate();
        let several = factors.filter(
            |(_, factor)| matches!(&factor.values, FactorValues::Listed(levels) if levels.len() > 1),
        );
        several.map(|(index, _)| index).collect()
    }

    /// Two factors that span a map, the one to the right first: numbers in lists, the shaking upwards.
    pub(super) fn plane(&self) -> Option<(usize, usize)> {
        let numeric: Vec<usize> = self
            .listed()
            .into_iter()
            .filter(|factor| self.study.layout.inputs[*factor].kind != Kind::Text)
            .collect();
        let ends = |factor: &usize, endings: &[&str]| {
            let paths = &self.study.file.factors[*factor].paths;
            paths
                .iter()
                .any(|path| endings.iter().any(|end| path.ends_with(end)))
        };
        let shaking = ["motion.pga", "motion.scale", "motion.match.value"];
        let up = numeric
            .iter()
            .copied()
            .find(|factor| ends(factor, &shaking));
        let right = numeric
            .iter()
            .copied()
            .filter(|factor| Some(*factor) != up)
            .max_by_key(|factor| ends(factor, &[".width"]));
        match (right, up) {
            (Some(right), Some(up)) => Some((right, up)),
            (Some(right), None) => {
                let other = numeric.into_iter().find(|factor| *factor != right)?;
                Some((right, other))
            }
            _ => None,
        }
    }

    /// The only factor with several numbers in a list, where no two span a map.
    pub(super) fn sweep(&self) -> Option<usize> {
        if self.plane().is_some() {
            return None;
        }
        let factors = self.listed().into_iter();
        // Roses show angles.
        let mut factors = factors.filter(|factor| !self.study.file.factors[*factor].is_angle());
        factors.find(|factor| self.numbers(*factor).len() > 1)
    }

    /// The distinct numbers of a factor, growing.
    pub(super) fn numbers(&self, factor: usize) -> Vec<f64> {
        let FactorValues::Listed(levels) = &self.study.file.factors[factor].values else {
            return Vec::new();
        };
        let mut numbers: Vec<f64> = levels.iter().filter_map(|level| level.number).collect();
        numbers.sort_by(f64::total_cmp);
        numbers.dedup();
        numbers
    }

    /// Factors in lists other than some.
    pub(super) fn others(&self, without: &[usize]) -> Vec<usize> {
        let mut others = self.listed();
        others.retain(|factor| !without.contains(factor));
        others
    }
}
