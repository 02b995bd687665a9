//! Derivatives of peaks with respect to numbers of the model file, and how far a straight line holds.

use std::ops::ControlFlow;
use std::path::Path;
use std::sync::atomic::{AtomicUsize, Ordering};

use jostle::RunEnd;
use jostle::results::gradient::Gradient;
use jostle_io::{ModelTree, Overrides, TreeValue};
use rayon::prelude::*;
use serde_json::Value;

use crate::case_cache::CaseCache;
use crate::error::RunError;

/// Step of the central differences, and its half \[–\].
const STEPS: [f64; 2] = [2e-3, 1e-3];
/// Changes with which the straight line is compared \[–\].
const TRIED: [f64; 9] = [0.001, 0.002, 0.005, 0.01, 0.02, 0.05, 0.1, 0.2, 0.5];
/// Distance from the straight line that is accepted, over the peak \[–\].
const ACCEPTED: f64 = 0.01;
/// Tolerance of these runs: differences of peaks are small \[–\].
const TOLERANCE: f64 = 1e-6;

/// A number of the model file.
#[derive(Clone, Debug, PartialEq)]
struct Number {
    path: String,
    /// Its value in SI.
    value: f64,
}

/// What to differentiate by.
#[derive(Clone, Debug)]
pub struct GradientRequest {
    tree: ModelTree,
    numbers: Vec<Number>,
}

impl GradientRequest {
    /// Numbers of a model file by their paths, such as `gap[0].width`; `overrides` are made beforehand.
    ///
    /// # Errors
    /// [`RunError::Argument`] for a path that leads to no number other than zero, with the remedy.
    pub fn new(
        mut tree: ModelTree,
        paths: &[String],
        overrides: &Overrides,
    ) -> Result<Self, RunError> {
        let wrong = |path: &str, problem: String| {
            RunError::Argument(format!("--gradients {path}: {problem}"))
        };
        let changes = [
            ("motion.pga", overrides.pga.map(TreeValue::Number)),
            ("gap[*].width", overrides.gap.map(TreeValue::Number)),
            ("motion.record", overrides.record.as_deref().map(here)),
            ("motion.angle", overrides.angle.map(TreeValue::Number)),
        ];
        for (path, value) in changes {
            if let Some(value) = value {
                tree.set(path, &value)
                    .map_err(|error| wrong(path, error.to_string()))?;
            }
        }
        let number = |path: &String| {
            let mut trial = tree.clone();
            let known = trial.multiply(path, 1.0);
            match (known, tree.number(path)) {
                (Ok(()), Some(value)) if value != 0.0 => Ok(Number {
                    path: path.clone(),
                    value,
                }),
                (Ok(()), Some(_)) => Err(wrong(
                    path,
                    "is zero, and steps are shares of the value; give it a value".to_owned(),
                )),
                (Ok(()), None) => Err(wrong(
                    path,
                    "is not one number; write one value instead of a list, or choose another key"
                        .to_owned(),
                )),
                (Err(error), _) => Err(wrong(
                    path,
                    format!(
                        "{error}; write the number into the model file, by paths such as gap[0].width"
                    ),
                )),
            }
        };
        let numbers = paths.iter().map(number).collect::<Result<Vec<_>, _>>()?;
        Ok(Self { tree, numbers })
    }

    /// Runs the model with every number a little less and a little more; `None` if it was stopped. `note` hears how many runs
    /// of how many are done.
    ///
    /// # Errors
    /// [`RunError`] if the model itself cannot run, or ends early.
    pub fn gradients(
        &self,
        stop: &(dyn Fn() -> bool + Sync),
        note: &(dyn Fn(usize, usize) + Sync),
    ) -> Result<Option<Vec<Gradient>>, RunError> {
        let mut factors = vec![1.0];
        for change in STEPS.into_iter().chain(TRIED) {
            factors.extend([1.0 - change, 1.0 + change]);
        }
        // The model itself once, whatever the number.
        let runs: Vec<(usize, f64)> = (0..self.numbers.len())
            .flat_map(|number| factors[1..].iter().map(move |factor| (number, *factor)))
            .collect();
        let cache = CaseCache::default();
        let done = AtomicUsize::new(0);
        let of = runs.len() + 1;
        let counted = |found: Trial| {
            let done = done.fetch_add(1, Ordering::Relaxed) + 1;
            note(done, of);
            found
        };
        let Some(base) = counted(self.run(&cache, None, stop)).into_peaks()? else {
            return Ok(None);
        };
        let found: Vec<Trial> = runs
            .par_iter()
            .map(|par_iter| counted(self.run(&cache, Some(*par_iter), stop)))
            .collect();
        if stop() {
            return Ok(None);
        }
        let each = factors.len() - 1;
        let mut all = Vec::new();
        for (number, found) in self.numbers.iter().zip(found.chunks(each)) {
            // Beyond the steps a run may fail: the line ends there.
            for (trial, factor) in found.iter().zip(&factors[1..]).take(2 * STEPS.len()) {
                if let Trial::Failed(error) = trial {
                    return Err(RunError::Analysis(format!(
                        "--gradients {}: the model does not run with {factor} times its value: {error}",
                        number.path
                    )));
                }
            }
            for (at, (of, peak)) in base.iter().enumerate() {
                let peaks: Vec<Option<f64>> = found.iter().map(|trial| trial.peak(at)).collect();
                all.extend(gradient(number, of, *peak, &peaks));
            }
        }
        Ok(Some(all))
    }

    fn run(
        &self,
        cache: &CaseCache,
        change: Option<(usize, f64)>,
        stop: &(dyn Fn() -> bool + Sync),
    ) -> Trial {
        let mut tree = self.tree.clone();
        if let Some((number, factor)) = change
            && let Err(error) = tree.multiply(&self.numbers[number].path, factor)
        {
            return Trial::Failed(RunError::Argument(error.to_string()));
        }
        let prepared = tree.input().map_err(RunError::from).and_then(|mut input| {
            let analysis = &mut input.model.analysis;
            analysis.tolerance = analysis.tolerance.min(TOLERANCE);
            cache
                .assemble(input)
                .map_err(|error| RunError::Argument(error.to_string()))
        });
        let prepared = match prepared {
            Ok(prepared) => prepared,
            Err(error) => return Trial::Failed(error),
        };
        let outcome = prepared.step(prepared.settings(false), |_| {
            if stop() {
                ControlFlow::Break(())
            } else {
                ControlFlow::Continue(())
            }
        });
        match outcome.end_of_all() {
            RunEnd::Completed => {}
            RunEnd::Stopped => return Trial::Stopped,
            RunEnd::Failed(error) => return Trial::Failed(RunError::Analysis(error.to_string())),
        }
        let summary = prepared.summary(&outcome, None, 0.0);
        Trial::Peaks(peaks_of(
            &serde_json::to_value(&summary).unwrap_or_default(),
        ))
    }
}

/// A record by its built-in name, or from the current folder.
fn here(record: &str) -> TreeValue {
    let path = Path::new(record);
    let file = path
        .exists()
        .then(|| std::path::absolute(path).ok())
        .flatten();
    TreeValue::Text(file.map_or_else(|| record.to_owned(), |file| file.display().to_string()))
}

/// A run with one number changed.
enum Trial {
    Peaks(Vec<(String, f64)>),
    Failed(RunError),
    Stopped,
}

impl Trial {
    fn into_peaks(self) -> Result<Option<Vec<(String, f64)>>, RunError> {
        match self {
            Self::Peaks(peaks) => Ok(Some(peaks)),
            Self::Failed(error) => Err(error),
            Self::Stopped => Ok(None),
        }
    }

    fn peak(&self, at: usize) -> Option<f64> {
        match self {
            Self::Peaks(peaks) => peaks.get(at).map(|pair| pair.1),
            _ => None,
        }
    }
}

/// The derivative of one peak; `None` if a run of the steps lacks it.
fn gradient(number: &Number, of: &str, peak: f64, peaks: &[Option<f64>]) -> Option<Gradient> {
    let difference = |at: usize| {
        let change = 2.0 * STEPS[at] * number.value;
        Some((peaks[2 * at + 1]? - peaks[2 * at]?) / change)
    };
    // Richardson's rule takes the error of second order away.
    let [whole, half] = [difference(0)?, difference(1)?];
    let value = (4.0 * half - whole) / 3.0;
    let near = |share: f64, found: Option<f64>| {
        let straight = peak + value * share * number.value;
        found.is_some_and(|trial_peak| (trial_peak - straight).abs() <= ACCEPTED * peak.abs())
    };
    let tried = peaks[2 * STEPS.len()..].chunks(2).zip(TRIED);
    let holds = tried.take_while(|(pair, share)| near(-share, pair[0]) && near(*share, pair[1]));
    let share = holds.last().map_or(0.0, |(_, share)| share);
    Some(Gradient {
        of: of.to_owned(),
        by: number.path.clone(),
        peak,
        at: number.value,
        value,
        error: (half - whole).abs(),
        valid_within: share * number.value.abs(),
    })
}

/// Every peak of gaps, contacts, buildings and floors, by its path.
fn peaks_of(summary: &Value) -> Vec<(String, f64)> {
    let mut all = Vec::new();
    let mut list = |path: &str, value: &Value, inner: &[&str]| {
        let mut open = vec![(path.to_owned(), value, inner.to_vec())];
        while let Some((path, value, inner)) = open.pop() {
            for (at, element) in value.as_array().into_iter().flatten().enumerate() {
                let path = format!("{path}[{at}]");
                for (key, value) in element.as_object().into_iter().flatten() {
                    let is_peak = key.contains("_peak") && !key.ends_with("_at_s")
                        || key.starts_with("peak_") && !key.ends_with("_at_s")
                        || ["displacement_max_m", "displacement_min_m"].contains(&&key[..]);
                    if let (true, Some(number)) = (is_peak, value.as_f64()) {
                        all.push((format!("{path}.{key}"), number));
                    }
                    if inner.contains(&&key[..]) {
                        open.push((format!("{path}.{key}"), value, Vec::new()));
                    }
                }
            }
        }
    };
    list("gaps", &summary["gaps"], &["contacts"]);
    list("buildings", &summary["buildings"], &["floors"]);
    all
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_cubic_has_its_slope_and_the_line_holds_as_far_as_it_does() {
        let number = Number {
            path: "x".into(),
            value: 2.0,
        };
        // x³ + x at x = 2: 10, slope 13; a change of 5 % leaves the line by 0.061, one of 10 % by 0.25, and 1 % of 10 is 0.1.
        // Plain central differences would be wrong by 4e-6.
        let of = |x: f64| x * x * x + x;
        let mut peaks = Vec::new();
        for change in STEPS.into_iter().chain(TRIED) {
            peaks.extend([
                Some(of(2.0 * (1.0 - change))),
                Some(of(2.0 * (1.0 + change))),
            ]);
        }
        let found = gradient(&number, "y", 10.0, &peaks).expect("a slope");
        assert!((found.value - 13.0).abs() < 1e-9, "{found:?}");
        assert_eq!(found.valid_within, 0.1);
        assert!(found.error > 1e-6 && found.error < 1e-4, "{found:?}");
    }
}
