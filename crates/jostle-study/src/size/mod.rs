//! The least of something, such as a damper force, that keeps conditions, such as no impact: a seeded search over varied keys.
//!
//! [`SizeProblem::new`] checks keys, bounds and expressions; [`SizeProblem::run`] searches on all cores: one key between the
//! neighbours of the best of its points, again and again, several by differential evolution (R. Storn and K. Price, 1997, J. Global Optimization 11, 341–359) with the ranking of K. Deb (2000, Comput.
//! Methods Appl. Mech. Engrg. 186, 311–338): a trial that keeps all conditions is better than one that does not, of two that
//! do not the one that misses them by less, of two that do the one with the lesser objective. Every number depends on the
//! problem and the seed alone: not on threads, order or interruptions.

mod bracket;
mod evaluate;
mod evolution;
mod expression;
mod page;
mod results;
mod search;
mod text;
mod trials;
mod variables;

use std::path::Path;

use jostle_io::{FactorValues, Format, ModelTree, StudyFile, TreeValue};
use sha2::{Digest, Sha256};

use crate::study::{Study, StudyError};
use expression::{Condition, Expression, Names, Source};
use variables::Variable;

pub use results::{SizeResults, Trial};
pub use trials::earlier_size_files;

/// How values of several records become one.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Over {
    /// The worst record: the greatest objective, and of every condition the value that misses it most.
    Worst,
    /// Their mean.
    Mean,
}

impl Over {
    /// Names on the command line.
    pub const NAMES: [&'static str; 2] = ["worst", "mean"];

    /// The rule of this name.
    #[must_use]
    pub fn from_name(name: &str) -> Option<Self> {
        match name {
            "worst" => Some(Self::Worst),
            "mean" => Some(Self::Mean),
            _ => None,
        }
    }

    fn name(self) -> &'static str {
        match self {
            Self::Worst => "worst",
            Self::Mean => "mean",
        }
    }
}

/// What is asked for, as typed.
#[derive(Clone, Debug, PartialEq)]
pub struct SizeRequest {
    /// Varied keys, `NAME=LOW..HIGH` or `NAME`.
    pub vary: Vec<String>,
    /// Conditions.
    pub keep: Vec<String>,
    /// What is minimised.
    pub minimise: String,
    /// Records instead of those of the model; none keeps these.
    pub records: Vec<String>,
    /// Peak ground acceleration instead of that of the model, as typed.
    pub pga: Option<String>,
    /// Whether every motion counts with either sign, as another record.
    pub both_signs: bool,
    /// How values of several records become one.
    pub over: Over,
    /// Seed of the search.
    pub seed: u64,
    /// Most trials.
    pub trials: usize,
    /// The search ends when all members of a generation keep the conditions and their objectives differ by less than this part
    /// of the least, > 0 \[–\].
    pub tolerance: f64,
}

impl Default for SizeRequest {
    fn default() -> Self {
        Self {
            vary: Vec::new(),
            keep: Vec::new(),
            minimise: String::new(),
            records: Vec::new(),
            pga: None,
            both_signs: false,
            over: Over::Worst,
            seed: 0,
            trials: 600,
            tolerance: 1e-4,
        }
    }
}

/// A checked problem.
pub struct SizeProblem {
    study: Study,
    variables: Vec<Variable>,
    objective: Expression,
    conditions: Vec<Condition>,
    /// Quantities in use: name and source.
    quantities: Vec<(String, Source)>,
    /// Position of every variable among the factors of the study.
    places: Vec<usize>,
    /// Motions of a trial.
    shaking: Vec<Shaking>,
    over: Over,
    seed: u64,
    trials: usize,
    tolerance: f64,
    /// Identity of the problem: 64 characters.
    fingerprint: String,
}

/// One motion of a trial.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Shaking {
    /// Its name, with its sign where both are run; empty if there is one motion.
    name: String,
    /// Its record.
    record: usize,
    /// Whether it has the other sign.
    reversed: bool,
}

/// Motions of a trial: every record, and then every record reversed if both signs are wanted.
fn shaking(records: &[String], both_signs: bool) -> Vec<Shaking> {
    let signs: &[bool] = if both_signs { &[false, true] } else { &[false] };
    let all = signs.iter().flat_map(|&reversed| {
        records
            .iter()
            .enumerate()
            .map(move |(record, name)| Shaking {
                name: match (reversed, &name[..]) {
                    (false, name) => name.to_owned(),
                    (true, "") => "reversed".to_owned(),
                    (true, name) => format!("{name} reversed"),
                },
                record,
                reversed,
            })
    });
    all.collect()
}

/// Where a search stands.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SizeProgress {
    /// Trials that are finished.
    pub trials: usize,
    /// Most trials.
    pub most: usize,
    /// Generations.
    pub generation: u64,
    /// The least objective that keeps all conditions.
    pub best: Option<f64>,
}

/// Least number of trials.
const FEWEST: usize = 10;

impl SizeProblem {
    /// Checks a request against its model: names, units, and the model at both ends of every key.
    ///
    /// # Errors
    /// [`StudyError`] that names the option.
    pub fn new(mut base: ModelTree, request: &SizeRequest) -> Result<Self, StudyError> {
        let wrong = StudyError::Column;
        if request.vary.is_empty() {
            return Err(wrong(
                "--vary: name a key, such as --vary \"gap.width=10 mm..200 mm\"".into(),
            ));
        }
        if request.trials < FEWEST {
            return Err(wrong(format!(
                "--trials: must be at least {FEWEST}, found {}",
                request.trials
            )));
        }
        let usable = request.tolerance > 0.0 && request.tolerance < 1.0;
        if !usable {
            return Err(wrong(format!(
                "--tolerance: must lie between 0 and 1, found {}",
                request.tolerance
            )));
        }
        let set = |base: &mut ModelTree, path: &str, value: TreeValue| {
            base.set(path, &value)
                .map_err(|error| wrong(error.to_string()))
        };
        match &request.records[..] {
            [] => {}
            [one] => set(&mut base, "motion.record", TreeValue::Text(one.clone()))?,
            several => {
                let list = several.iter().cloned().map(TreeValue::Text).collect();
                set(&mut base, "motion.record", TreeValue::List(list))?;
            }
        }
        if let Some(pga) = &request.pga {
            set(&mut base, "motion.pga", TreeValue::Text(pga.clone()))?;
        }
        let variables: Vec<Variable> = request
            .vary
            .iter()
            .map(|text| variables::read(&base, text).map_err(wrong))
            .collect::<Result<_, _>>()?;
        for (index, variable) in variables.iter().enumerate() {
            if variables[..index]
                .iter()
                .any(|known| known.name == variable.name)
            {
                return Err(wrong(format!("--vary: {} is named twice", variable.name)));
            }
        }
        // Faults of the model itself, with their lines.
        let input = base.input()?;
        let title = input.model.title.clone();
        let folder = base.base().to_owned();
        let text = variables::study_text(&title, &variables);
        let moved = |error| variables::at_options(error, &variables);
        let file = StudyFile::parse(variables::NAME, &text, Format::Toml, &folder, Some(base));
        let file = file.map_err(|error| moved(error.into()))?;
        let places: Vec<usize> = (0..file.factors.len())
            .filter(|index| !file.factors[*index].from_model)
            .collect();
        let records = file.factors.iter().find(|factor| factor.from_model);
        let records = records.map_or_else(
            || vec![String::new()],
            |factor| match &factor.values {
                FactorValues::Listed(levels) => levels.iter().map(|l| l.label.clone()).collect(),
                FactorValues::Drawn(_) | FactorValues::Table(_) => vec![String::new()],
            },
        );
        let study = Study::new(file).map_err(moved)?;
        let (objective, conditions, quantities) = {
            let factors = places.iter().map(|at| &study.file.factors[*at]).collect();
            let mut names = Names::new(factors, &study.layout);
            let objective = names
                .expression("--minimise", &request.minimise)
                .map_err(wrong)?;
            let conditions = request.keep.iter().map(|text| names.condition(text));
            let conditions = conditions.collect::<Result<Vec<_>, _>>().map_err(wrong)?;
            (objective, conditions, names.used)
        };
        let mut problem = Self {
            fingerprint: String::new(),
            variables,
            objective,
            conditions,
            quantities,
            places,
            shaking: shaking(&records, request.both_signs),
            over: request.over,
            seed: request.seed,
            trials: request.trials,
            tolerance: request.tolerance,
            study,
        };
        problem.check_ends()?;
        problem.fingerprint = problem.identity(request);
        Ok(problem)
    }

    /// Whether every motion is run with both signs.
    fn has_both_signs(&self) -> bool {
        self.shaking.iter().any(|shaking| shaking.reversed)
    }

    /// Things the user should know about the model.
    #[must_use]
    pub fn warnings(&self) -> &[String] {
        &self.study.warnings
    }

    /// Title of the model.
    #[must_use]
    pub fn title(&self) -> &str {
        &self.study.file.title
    }

    /// The model must be sound with every key at its lower and at its upper bound; the study tried the middle.
    fn check_ends(&self) -> Result<(), StudyError> {
        let count = self.variables.len();
        for variable in 0..count {
            for end in [0.0, 1.0] {
                let mut point = vec![0.5; count];
                point[variable] = end;
                let read = self.tree(&point, 0).map_err(|error| error.to_string());
                let read = read.and_then(|tree| tree.input().map_err(|error| error.to_string()));
                if let Err(problem) = read {
                    let bound = if end == 0.0 { "lower" } else { "upper" };
                    return Err(StudyError::Column(format!(
                        "--vary {}: the model is wrong at its {bound} bound: {problem}",
                        self.variables[variable].name
                    )));
                }
            }
        }
        Ok(())
    }

    fn identity(&self, request: &SizeRequest) -> String {
        let mut all = Sha256::new();
        let seed = request.seed.to_string();
        let (over, tolerance) = (request.over.name(), request.tolerance.to_string());
        let mut texts = vec![
            self.study.fingerprint.as_str(),
            request.minimise.trim(),
            over,
            &seed,
            &tolerance,
            request.pga.as_deref().unwrap_or_default(),
        ];
        texts.extend(request.both_signs.then_some("both signs"));
        texts.extend(request.records.iter().map(String::as_str));
        texts.extend(request.keep.iter().map(String::as_str));
        for text in texts {
            all.update((text.len() as u64).to_le_bytes());
            all.update(text.as_bytes());
        }
        all.finalize()
            .iter()
            .map(|byte| format!("{byte:02x}"))
            .collect()
    }

    /// Searches, and keeps every trial in the folder if one is given; trials that are there already are not run again. `stop`
    /// ends the search after the trials under way; the results are those until then.
    ///
    /// # Errors
    /// [`StudyError`] if the folder holds another search or files cannot be written.
    pub fn run(
        self,
        folder: Option<&Path>,
        jobs: Option<usize>,
        stop: &std::sync::Arc<std::sync::atomic::AtomicBool>,
        progress: Box<dyn Fn(SizeProgress) + Send + Sync>,
    ) -> Result<SizeResults, StudyError> {
        search::search(self, folder, jobs, stop, progress)
    }
}
