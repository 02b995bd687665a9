//! Results of a search: its trials, the best of them, what it costs to keep more or less.

use std::cmp::Ordering;
use std::path::Path;

use jostle::linear::sort_by;
use jostle_io::{Values, write_atomically, write_values_parquet};
use serde_json::{Value, json};

use super::SizeProblem;
use super::evaluate::Evaluated;
use super::expression::{Condition, Expression, Relation};
use super::trials::{NUMBERS, PAGE, TABLE};
use crate::row::Status;
use crate::study::StudyError;

/// One trial.
#[derive(Clone, Debug, PartialEq)]
pub struct Trial {
    /// Generation of the search, from 0.
    pub generation: u64,
    /// Place between the bounds of every varied key, from 0 to 1.
    pub point: Vec<f64>,
    /// Values of the varied keys, in SI, and as written into the model.
    pub inputs: Vec<(Option<f64>, String)>,
    /// How its runs ended.
    pub status: Status,
    /// Why one of them did not complete.
    pub reason: String,
    /// Objective, over all records; `None` if a run did not complete.
    pub objective: Option<f64>,
    /// Left sides of the conditions, over all records.
    pub kept: Vec<Option<f64>>,
    /// Sum by which conditions are missed, each relative to its right side; 0 if all are kept.
    pub missed: f64,
    /// Values of the quantities in use, record after record.
    quantities: Vec<Option<f64>>,
}

/// All results of a search.
#[derive(Clone, Debug, PartialEq)]
pub struct SizeResults {
    /// Title of the model.
    pub title: String,
    /// Trials by generation, then by place.
    pub trials: Vec<Trial>,
    /// The best trial that keeps all conditions.
    pub best: Option<usize>,
    /// Whether the search came to its own end.
    pub converged: bool,
    /// Whether it was stopped before.
    pub stopped: bool,
    /// Trials of earlier searches that were found on disk.
    pub earlier: usize,
    pub(super) objective: Expression,
    pub(super) conditions: Vec<Condition>,
    /// Names of the varied keys as typed, and of their columns.
    pub(super) inputs: Vec<(String, String)>,
    /// Names of the quantities in use.
    quantities: Vec<String>,
    pub(super) motions: Vec<String>,
    /// Records and peak of the model in words, and bounds of the varied keys; for the page.
    pub(super) shaken: [String; 2],
    pub(super) bounds: Vec<[String; 2]>,
    /// The best trial under all motions with the other sign; `None` where both signs were searched, or no trial keeps the conditions.
    pub reversed: Option<Trial>,
    pub(super) over: &'static str,
    pub(super) seed: u64,
    fingerprint: String,
}

impl Trial {
    pub(super) fn new(
        problem: &SizeProblem,
        generation: u64,
        point: Vec<f64>,
        found: Evaluated,
    ) -> Self {
        let (objective, kept, missed) = problem.judge(&found);
        Self {
            generation,
            inputs: problem.inputs(&point),
            point,
            status: found.status,
            reason: found.reason,
            objective,
            kept,
            missed,
            quantities: found.quantities,
        }
    }

    /// By generation, then by place.
    pub(super) fn order(a: &Self, b: &Self) -> Ordering {
        let places = a.point.iter().zip(&b.point).map(|(a, b)| a.total_cmp(b));
        let place = places.fold(Ordering::Equal, Ordering::then);
        a.generation.cmp(&b.generation).then(place)
    }

    /// Whether it keeps all conditions.
    #[must_use]
    pub fn keeps(&self) -> bool {
        self.missed == 0.0 && self.objective.is_some()
    }
}

impl SizeResults {
    pub(super) fn new(
        problem: &SizeProblem,
        trials: Vec<Trial>,
        converged: bool,
        stopped: bool,
        earlier: usize,
    ) -> Self {
        let keeping = trials.iter().enumerate().filter(|(_, trial)| trial.keeps());
        let best = keeping.min_by(|(_, a), (_, b)| {
            let value = |trial: &Trial| trial.objective.unwrap_or(f64::INFINITY);
            value(a).total_cmp(&value(b))
        });
        let best = best.map(|(index, _)| index);
        let columns = problem.study.layout.inputs.iter();
        let columns: Vec<String> = columns.map(|column| column.name.clone()).collect();
        let names = problem.variables.iter().zip(&problem.places);
        Self {
            title: problem.title().to_owned(),
            best,
            converged,
            stopped,
            earlier,
            objective: problem.objective.clone(),
            conditions: problem.conditions.clone(),
            inputs: names
                .map(|(variable, place)| (variable.name.clone(), columns[*place].clone()))
                .collect(),
            quantities: problem
                .quantities
                .iter()
                .map(|(name, _)| name.clone())
                .collect(),
            motions: (problem.shaking.iter())
                .map(|shaking| shaking.name.clone())
                .collect(),
            shaken: ["motion.record", "motion.pga"].map(|key| {
                let values = problem.study.file.base.values(key);
                let values: Vec<String> = values.iter().map(ToString::to_string).collect();
                values.join(", ")
            }),
            bounds: (problem.variables.iter())
                .map(|variable| variable.bounds.clone())
                .collect(),
            reversed: None,
            over: problem.over.name(),
            seed: problem.seed,
            fingerprint: problem.fingerprint.clone(),
            trials,
        }
    }

    /// The best trial.
    #[must_use]
    pub fn best(&self) -> Option<&Trial> {
        self.trials.get(self.best?)
    }

    /// The trial that misses least, where none keeps all conditions.
    #[must_use]
    pub fn nearest(&self) -> Option<&Trial> {
        let known = self.trials.iter().filter(|trial| trial.objective.is_some());
        known.min_by(|a, b| a.missed.total_cmp(&b.missed))
    }

    /// Trials that no other beats in both the objective and the left side of a condition: what it costs to keep more of it.
    /// In order of the left side.
    #[must_use]
    pub fn trade_off(&self, condition: usize) -> Vec<[f64; 2]> {
        let Some(wanted) = self.conditions.get(condition) else {
            return Vec::new();
        };
        // The lesser the better.
        let cost = |left: f64| match wanted.relation {
            Relation::Below | Relation::AtMost => left,
            Relation::AtLeast | Relation::Above => -left,
            Relation::Equal => (left - wanted.right).abs(),
        };
        let completed = self
            .trials
            .iter()
            .filter(|trial| trial.status == Status::Completed);
        let pairs = completed.filter_map(|trial| Some([trial.kept[condition]?, trial.objective?]));
        let mut pairs: Vec<[f64; 2]> = pairs.collect();
        sort_by(&mut pairs, |a, b| {
            cost(a[0])
                .total_cmp(&cost(b[0]))
                .then(a[1].total_cmp(&b[1]))
        });
        let mut front: Vec<[f64; 2]> = Vec::new();
        for pair in pairs {
            if front.last().is_none_or(|last| pair[1] < last[1]) {
                front.push(pair);
            }
        }
        sort_by(&mut front, |a, b| a[0].total_cmp(&b[0]));
        front
    }

    /// Columns of `trials.parquet`: one row per trial.
    #[must_use]
    pub fn columns(&self) -> Vec<(String, Values)> {
        let number = |of: &dyn Fn(&Trial) -> Option<f64>| {
            Values::Instant(self.trials.iter().map(of).collect())
        };
        let whole = |of: &dyn Fn(usize, &Trial) -> Option<i32>| {
            let trials = self.trials.iter().enumerate();
            Values::Whole(trials.map(|(index, trial)| of(index, trial)).collect())
        };
        let text =
            |of: &dyn Fn(&Trial) -> String| Values::Text(self.trials.iter().map(of).collect());
        let mut columns = vec![
            (
                "trial".to_owned(),
                whole(&|index, _| i32::try_from(index).ok()),
            ),
            (
                "generation".into(),
                whole(&|_, trial| i32::try_from(trial.generation).ok()),
            ),
            (
                "status".into(),
                text(&|trial| trial.status.name().to_owned()),
            ),
            ("reason".into(), text(&|trial| trial.reason.clone())),
        ];
        for (index, (_, column)) in self.inputs.iter().enumerate() {
            let values = number(&|trial| trial.inputs.get(index)?.0);
            columns.push((column.clone(), values));
        }
        columns.push(("objective".into(), number(&|trial| trial.objective)));
        for (index, _) in self.conditions.iter().enumerate() {
            let values = number(&|trial| *trial.kept.get(index)?);
            columns.push((format!("keep{}", index + 1), values));
        }
        columns.push((
            "missed".into(),
            number(&|trial| Some(trial.missed).filter(|missed| *missed < f64::MAX)),
        ));
        columns.push((
            "keeps".into(),
            whole(&|_, trial| Some(i32::from(trial.keeps()))),
        ));
        for (record, label) in self.motions.iter().enumerate() {
            for (index, name) in self.quantities.iter().enumerate() {
                let place = record * self.quantities.len() + index;
                let values = number(&|trial| *trial.quantities.get(place)?);
                let mut name = match &label[..] {
                    "" => name.clone(),
                    label => format!("{name}.{label}"),
                };
                while columns.iter().any(|(known, _)| *known == name) {
                    name.insert_str(0, "quantity.");
                }
                columns.push((name, values));
            }
        }
        columns
    }

    /// `size.json`.
    #[must_use]
    pub fn json(&self) -> Value {
        let values = |trial: &Trial| {
            let inputs = self.inputs.iter().zip(&trial.inputs);
            let inputs = inputs.map(|((name, column), (number, text))| {
                json!({ "key": name, "column": column, "value": number, "text": text })
            });
            json!({
                "generation": trial.generation,
                "inputs": inputs.collect::<Vec<_>>(),
                "objective": trial.objective,
                "kept": trial.kept,
            })
        };
        let fronts = (0..self.conditions.len()).map(
            |index| json!({ "keep": self.conditions[index].text, "points": self.trade_off(index) }),
        );
        json!({
            "title": self.title,
            "jostle": env!("CARGO_PKG_VERSION"),
            "minimise": self.objective.text,
            "keep": self.conditions.iter().map(|c| &c.text).collect::<Vec<_>>(),
            "vary": self.inputs.iter().map(|(name, _)| name).collect::<Vec<_>>(),
            "records": self.motions.iter().filter(|name| !name.is_empty()).collect::<Vec<_>>(),
            "over": self.over,
            "seed": self.seed,
            "trials": self.trials.len(),
            "converged": self.converged,
            "best": self.best().map(values),
            "reversed": self.reversed.as_ref().map(|trial| json!({
                "objective": trial.objective,
                "kept": trial.kept,
                "keeps": trial.keeps(),
            })),
            "trade_off": fronts.collect::<Vec<_>>(),
        })
    }

    /// Writes `trials.parquet`, `size.html` and `size.json`; each is whole or not there.
    pub(super) fn write(&self, folder: &Path) -> Result<(), StudyError> {
        let facts = [("search", self.fingerprint.clone())];
        write_values_parquet(&folder.join(TABLE), &self.title, &facts, self.columns())?;
        write_atomically(&folder.join(PAGE), self.page().as_bytes())?;
        let text = format!("{:#}\n", self.json());
        write_atomically(&folder.join(NUMBERS), text.as_bytes())?;
        Ok(())
    }
}
