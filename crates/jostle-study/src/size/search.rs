//! The search: one key by brackets, several by generations of differential evolution; every trial is looked up among those that are
//! finished first.

use std::collections::HashMap;
use std::path::Path;
use std::sync::atomic::{AtomicBool, AtomicU64, Ordering};
use std::sync::{Arc, Mutex, MutexGuard, PoisonError};

use jostle::linear::sort_by;
use jostle_run::CaseCache;

use super::evaluate::{Evaluated, Merit, WORST};
use super::evolution::{self, Member};
use super::results::{SizeResults, Trial};
use super::trials::Store;
use super::{SizeProblem, SizeProgress, bracket};
use crate::study::StudyError;

/// Points nearer than this part of the bounds are one \[–\].
const SAME_POINT: f64 = 1e-9;

/// What all threads share.
struct Shared {
    problem: SizeProblem,
    cache: CaseCache,
    /// Finished trials, by the bits of their points.
    known: Mutex<Known>,
    generation: AtomicU64,
    stop: Arc<AtomicBool>,
    /// The search ends because a file cannot be written.
    failure: Mutex<Option<StudyError>>,
    progress: Box<dyn Fn(SizeProgress) + Send + Sync>,
}

struct Known {
    trials: HashMap<Vec<u64>, (Option<u64>, Evaluated)>,
    store: Option<Store>,
    /// Trials that this search has used.
    used: usize,
    best: Option<f64>,
}

fn lock<T>(mutex: &Mutex<T>) -> MutexGuard<'_, T> {
    mutex.lock().unwrap_or_else(PoisonError::into_inner)
}

fn bits(point: &[f64]) -> Vec<u64> {
    // One zero, not two.
    point.iter().map(|x| (x + 0.0).to_bits()).collect()
}

impl Shared {
    /// The merit of a point: that of the finished trial there, or of a run.
    fn trial(&self, point: &[f64]) -> Merit {
        let generation = self.generation.load(Ordering::SeqCst);
        let key = bits(point);
        {
            let mut known = lock(&self.known);
            let Known { trials, used, .. } = &mut *known;
            if let Some((first, found)) = trials.get_mut(&key) {
                let merit = self.problem.merit(found);
                if first.is_none() {
                    // From an earlier, interrupted search.
                    *first = Some(generation);
                    *used += 1;
                    self.note(&mut known, merit);
                }
                return merit;
            }
        }
        let stop = || self.stop.load(Ordering::Relaxed);
        if stop() || lock(&self.failure).is_some() {
            return WORST;
        }
        match self.problem.evaluate(&self.cache, point, &stop) {
            Ok(Some(found)) => {
                let merit = self.problem.merit(&found);
                let mut known = lock(&self.known);
                if let Some(store) = &mut known.store
                    && let Err(error) = store.append(point, &found)
                {
                    *lock(&self.failure) = Some(error);
                }
                // The same point twice in a generation is one trial.
                if known
                    .trials
                    .insert(key, (Some(generation), found))
                    .is_none()
                {
                    known.used += 1;
                }
                self.note(&mut known, merit);
                merit
            }
            Ok(None) => WORST,
            Err(error) => {
                *lock(&self.failure) = Some(error);
                WORST
            }
        }
    }

    fn note(&self, known: &mut Known, (missed, objective): Merit) {
        if missed == 0.0 && known.best.is_none_or(|best| objective < best) {
            known.best = Some(objective);
        }
        (self.progress)(SizeProgress {
            trials: known.used,
            most: self.problem.trials,
            generation: self.generation.load(Ordering::Relaxed),
            best: known.best,
        });
    }

    /// Whether the search is at its end: every member keeps the conditions and their objectives hardly differ, or all members
    /// stand at one point.
    fn converged(&self, members: &[Member]) -> bool {
        let spread = |axis: usize| {
            let values = members.iter().map(|(point, _)| point[axis]);
            let low = values.clone().fold(f64::INFINITY, f64::min);
            values.fold(f64::NEG_INFINITY, f64::max) - low
        };
        if (0..self.problem.variables.len()).all(|axis| spread(axis) < SAME_POINT) {
            return true;
        }
        if members.iter().any(|(_, (missed, _))| *missed > 0.0) {
            return false;
        }
        let objectives = members.iter().map(|(_, (_, objective))| *objective);
        let least = objectives.clone().fold(f64::INFINITY, f64::min);
        let most = objectives.fold(f64::NEG_INFINITY, f64::max);
        most - least <= self.problem.tolerance * least.abs()
    }
}

/// Runs a search to its end, to its most trials, or until it is stopped.
pub(super) fn search(
    problem: SizeProblem,
    folder: Option<&Path>,
    jobs: Option<usize>,
    stop: &Arc<AtomicBool>,
    progress: Box<dyn Fn(SizeProgress) + Send + Sync>,
) -> Result<SizeResults, StudyError> {
    let pool = rayon::ThreadPoolBuilder::new()
        .num_threads(jobs.unwrap_or(0))
        .build()
        .map_err(|error| StudyError::Output(error.to_string()))?;
    let mut trials = HashMap::new();
    let store = match folder {
        Some(folder) => {
            let (store, finished) = Store::open(folder, &problem)?;
            for (point, found) in finished {
                trials.insert(bits(&point), (None, found));
            }
            Some(store)
        }
        None => None,
    };
    let kept = trials.len();
    let count = problem.variables.len();
    let shared = Shared {
        cache: CaseCache::default(),
        known: Mutex::new(Known {
            trials,
            store,
            used: 0,
            best: None,
        }),
        generation: AtomicU64::new(0),
        stop: Arc::clone(stop),
        failure: Mutex::new(None),
        progress,
        problem,
    };
    let mut converged = false;
    let go_on = || {
        shared.generation.fetch_add(1, Ordering::SeqCst);
        !shared.stop.load(Ordering::Relaxed) && lock(&shared.failure).is_none()
    };
    let (most, tolerance) = (shared.problem.trials, shared.problem.tolerance);
    pool.install(|| match count {
        1 => {
            let trial = |point: f64| shared.trial(&[point]);
            converged = bracket::search(most, tolerance, trial, go_on);
        }
        keys => {
            let trial = |point: &[f64]| shared.trial(point);
            evolution::search(keys, shared.problem.seed, trial, |members| {
                converged = shared.converged(members);
                let used = lock(&shared.known).used;
                !converged && used + members.len() <= most.max(members.len()) && go_on()
            });
        }
    });
    if let Some(error) = lock(&shared.failure).take() {
        return Err(error);
    }
    let stopped = stop.load(Ordering::Relaxed);
    let known = std::mem::replace(
        &mut *lock(&shared.known),
        Known {
            trials: HashMap::new(),
            store: None,
            used: 0,
            best: None,
        },
    );
    let problem = &shared.problem;
    let mut trials: Vec<Trial> = known
        .trials
        .into_iter()
        .filter_map(|(key, (generation, found))| {
            let point: Vec<f64> = key.into_iter().map(f64::from_bits).collect();
            Some(Trial::new(problem, generation?, point, found))
        })
        .collect();
    sort_by(&mut trials, Trial::order);
    let mut results = SizeResults::new(problem, trials, converged && !stopped, stopped, kept);
    // Records have two signs, and no earthquake tells which one a site sees.
    if let Some(best) = results.best().filter(|_| !problem.has_both_signs()) {
        let (generation, point) = (best.generation, best.point.clone());
        let stop = || shared.stop.load(Ordering::Relaxed);
        let found = pool.install(|| problem.evaluate_reversed(&shared.cache, &point, &stop))?;
        results.reversed = found.map(|found| Trial::new(problem, generation, point, found));
    }
    if let Some(folder) = folder {
        results.write(folder)?;
    }
    Ok(results)
}
