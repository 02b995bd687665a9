//! One trial: from a point of the search to its values.

use jostle::{RunEnd, StepError};
use jostle_io::{FactorValues, ModelTree, PathError};
use jostle_run::{CaseCache, CaseError};

use super::expression::{Expression, Relation, Source};
use super::{Over, Shaking, SizeProblem};
use crate::design::{Choice, value_of};
use crate::measures::measures;
use crate::row::Status;
use crate::study::StudyError;

/// What a trial gave.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Evaluated {
    pub(super) status: Status,
    /// Why it did not complete.
    pub(super) reason: String,
    /// Values of the quantities in use, record after record.
    pub(super) quantities: Vec<Option<f64>>,
}

/// How good a trial is: by how much it misses the conditions, and its objective. The lesser in this order is better.
pub(super) type Merit = (f64, f64);

/// The worst merit.
pub(super) const WORST: Merit = (f64::MAX, f64::MAX);

impl SizeProblem {
    /// The model file at a point between the bounds, with one of the records.
    pub(super) fn tree(&self, point: &[f64], record: usize) -> Result<ModelTree, PathError> {
        self.study.tree(&self.choices(point, record))
    }

    fn choices(&self, point: &[f64], record: usize) -> Vec<Choice> {
        let mut choices = vec![Choice::Listed(record); self.study.file.factors.len()];
        for (variable, share) in point.iter().enumerate() {
            let place = self.places[variable];
            if let FactorValues::Drawn(distribution) = &self.study.file.factors[place].values {
                choices[place] = Choice::Drawn(super::variables::at(distribution, *share));
            }
        }
        choices
    }

    /// Values of the varied keys at a point: in SI, and as texts with units.
    pub(super) fn inputs(&self, point: &[f64]) -> Vec<(Option<f64>, String)> {
        let choices = self.choices(point, 0);
        let one = |place: &usize| {
            let (_, number, label) = value_of(&self.study.file.factors[*place], &choices[*place]);
            (number, label)
        };
        self.places.iter().map(one).collect()
    }

    /// Runs one trial under all motions; `None` if it was stopped.
    pub(super) fn evaluate(
        &self,
        cache: &CaseCache,
        point: &[f64],
        stop: &(dyn Fn() -> bool + Sync),
    ) -> Result<Option<Evaluated>, StudyError> {
        self.under_all(cache, point, &self.shaking, stop)
    }

    /// Runs one trial under every motion with its sign changed.
    pub(super) fn evaluate_reversed(
        &self,
        cache: &CaseCache,
        point: &[f64],
        stop: &(dyn Fn() -> bool + Sync),
    ) -> Result<Option<Evaluated>, StudyError> {
        let other = self.shaking.iter().map(|shaking| Shaking {
            reversed: !shaking.reversed,
            ..shaking.clone()
        });
        self.under_all(cache, point, &other.collect::<Vec<_>>(), stop)
    }

    fn under_all(
        &self,
        cache: &CaseCache,
        point: &[f64],
        shaking: &[Shaking],
        stop: &(dyn Fn() -> bool + Sync),
    ) -> Result<Option<Evaluated>, StudyError> {
        use rayon::prelude::*;
        let found: Vec<_> = shaking
            .par_iter()
            .map(|shaking| self.under(cache, point, shaking, stop))
            .collect();
        let mut all = Evaluated {
            status: Status::Completed,
            reason: String::new(),
            quantities: Vec::new(),
        };
        for (one, shaking) in found.into_iter().zip(shaking) {
            let Some(one) = one? else { return Ok(None) };
            if one.status != Status::Completed && all.status == Status::Completed {
                all.status = one.status;
                all.reason = match &shaking.name[..] {
                    "" => one.reason,
                    name => format!("{name}: {}", one.reason),
                };
            }
            all.quantities.extend(one.quantities);
        }
        Ok(Some(all))
    }

    fn under(
        &self,
        cache: &CaseCache,
        point: &[f64],
        shaking: &Shaking,
        stop: &(dyn Fn() -> bool + Sync),
    ) -> Result<Option<Evaluated>, StudyError> {
        let failed = |reason: String| Evaluated {
            status: Status::Failed,
            reason,
            quantities: vec![None; self.quantities.len()],
        };
        let tree = self.tree(point, shaking.record).map_err(CaseError::from);
        let input = tree.and_then(|tree| tree.input().map_err(CaseError::from));
        let mut prepared = match input.and_then(|input| cache.assemble(input)) {
            Ok(prepared) => prepared,
            Err(error) => {
                let line = error.to_string();
                let line = line.lines().find(|line| !line.trim().is_empty());
                return Ok(Some(failed(line.unwrap_or_default().trim().to_owned())));
            }
        };
        if shaking.reversed {
            prepared.motion = prepared.motion.reversed();
        }
        let outcome = prepared.step(prepared.settings(false), |_| {
            if stop() {
                std::ops::ControlFlow::Break(())
            } else {
                std::ops::ControlFlow::Continue(())
            }
        });
        let (status, reason) = match outcome.end_of_all() {
            RunEnd::Stopped => return Ok(None),
            RunEnd::Completed => (Status::Completed, String::new()),
            RunEnd::Failed(error @ StepError::Collapse { .. }) => {
                (Status::Collapsed, error.to_string())
            }
            RunEnd::Failed(error) => (Status::Failed, error.to_string()),
        };
        if status == Status::Failed {
            return Ok(Some(failed(reason)));
        }
        let summary = prepared.summary(&outcome, None, 0.0);
        let named = measures(&summary, &prepared.motion, false);
        let layout = &self.study.layout;
        let mut results = vec![None; layout.results.len()];
        for named in named {
            if let Some(place) = layout.place(&named.name) {
                results[place] = named.value;
            }
        }
        let inputs = self.inputs(point);
        let value = |source: &Source| match source {
            Source::Input(variable) => inputs.get(*variable).and_then(|(number, _)| *number),
            Source::Results(places) => {
                let values = places.iter().filter_map(|place| results[*place]);
                values.reduce(f64::max)
            }
        };
        let quantities = self.quantities.iter().map(|(_, source)| value(source));
        Ok(Some(Evaluated {
            status,
            reason,
            quantities: quantities.collect(),
        }))
    }

    /// The value of an expression over all motions; `worst` says which of two values is worse.
    fn over_all(
        &self,
        expression: &Expression,
        quantities: &[Option<f64>],
        worse: impl Fn(f64, f64) -> bool,
    ) -> Option<f64> {
        let count = self.quantities.len();
        let values = quantities
            .chunks(count.max(1))
            .map(|record| expression.value(record));
        let values: Vec<f64> = values.collect::<Option<_>>()?;
        match self.over {
            Over::Mean => Some(values.iter().sum::<f64>() / values.len() as f64),
            Over::Worst => values
                .into_iter()
                .reduce(|a, b| if worse(b, a) { b } else { a }),
        }
    }

    /// Objective, left sides of the conditions, and the sum by which these are missed.
    pub(super) fn judge(&self, found: &Evaluated) -> (Option<f64>, Vec<Option<f64>>, f64) {
        let objective = self.over_all(&self.objective, &found.quantities, |a, b| a > b);
        let lefts: Vec<Option<f64>> = self
            .conditions
            .iter()
            .map(|condition| {
                let worse = |a: f64, b: f64| match condition.relation {
                    Relation::Below | Relation::AtMost => a > b,
                    Relation::AtLeast | Relation::Above => a < b,
                    Relation::Equal => condition.violation(a) > condition.violation(b),
                };
                self.over_all(&condition.left, &found.quantities, worse)
            })
            .collect();
        let mut missed = 0.0;
        for (condition, left) in self.conditions.iter().zip(&lefts) {
            missed += left.map_or(f64::MAX, |left| condition.violation(left));
        }
        if found.status != Status::Completed || objective.is_none() {
            missed = f64::MAX;
        }
        (objective, lefts, missed.min(f64::MAX))
    }

    /// How good a trial is.
    pub(super) fn merit(&self, found: &Evaluated) -> Merit {
        let (objective, _, missed) = self.judge(found);
        match objective {
            Some(objective) if missed < f64::MAX => (missed, objective),
            _ => WORST,
        }
    }
}
