//! The search: one key by brackets, several by generations of differential evolution; every trial is looked up among those that are
//! finished first.

use std::collections::HashMap;
use std::path::Path;
use std::sync::atomic::{AtomicBool, AtomicU64, Ordering};
use std::sync::{Arc, Mutex, MutexGuard, PoisonError};

use jostle::linear::sort_by;
use jostle_run::CaseCache;
use metaheuristics_nature::methods::de::{De, Strategy};
use metaheuristics_nature::{Bounded, ObjFunc, Solver};

use super::bracket;
use super::evaluate::{Evaluated, Merit, WORST};
use super::results::{SizeResults, Trial};
use super::trials::Store;
use super::{SizeProblem, SizeProgress};
use crate::study::StudyError;

/// Weight of differences and probability of a crossed coordinate, as Storn and Price suggest \[–\].
const WEIGHT: f64 = 0.6;
const CROSSED: f64 = 0.9;
/// Members of a generation: these, and so many more for every varied key.
const MEMBERS: [usize; 2] = [6, 6];
/// Points nearer than this part of the bounds are one \[–\].
const SAME_POINT: f64 = 1e-9;

/// What all threads share.
struct Shared {
    problem: SizeProblem,
    bounds: Vec<[f64; 2]>,
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

/// The function that is minimised.
struct Objective(Arc<Shared>);

impl Bounded for Objective {
    fn bound(&self) -> &[[f64; 2]] {
        &self.0.bounds
    }
}

impl ObjFunc for Objective {
    type Ys = Merit;

    fn fitness(&self, point: &[f64]) -> Merit {
        self.0.trial(point)
    }
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
    fn converged(&self, points: &[Vec<f64>], merits: &[Merit]) -> bool {
        let spread = |axis: usize| {
            let values = points.iter().map(|point| point[axis]);
            let low = values.clone().fold(f64::INFINITY, f64::min);
            values.fold(f64::NEG_INFINITY, f64::max) - low
        };
        if (0..self.bounds.len()).all(|axis| spread(axis) < SAME_POINT) {
            return true;
        }
        if merits.iter().any(|(missed, _)| *missed > 0.0) {
            return false;
        }
        let objectives = merits.iter().map(|(_, objective)| *objective);
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
    let members = MEMBERS[0] + MEMBERS[1] * count;
    let shared = Arc::new(Shared {
        bounds: vec![[0.0, 1.0]; count],
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
    });
    let mut converged = false;
    let go_on = || {
        shared.generation.fetch_add(1, Ordering::SeqCst);
        !shared.stop.load(Ordering::Relaxed) && lock(&shared.failure).is_none()
    };
    let single = count == 1;
    if single {
        let (trials, tolerance) = (shared.problem.trials, shared.problem.tolerance);
        let trial = |point: f64| shared.trial(&[point]);
        converged = pool.install(|| bracket::search(trials, tolerance, trial, go_on));
    }
    pool.install(|| {
        if single {
            return;
        }
        let watched = Arc::clone(&shared);
        let converged = &mut converged;
        let method = De::new().strategy(Strategy::C2F3).f(WEIGHT).cross(CROSSED);
        let _ = Solver::build(method, Objective(Arc::clone(&shared)))
            .seed(shared.problem.seed)
            .pop_num(members)
            .task(move |state| {
                *converged = watched.converged(&state.pool, &state.pool_y);
                let used = lock(&watched.known).used;
                watched.generation.fetch_add(1, Ordering::SeqCst);
                *converged
                    || used + members > watched.problem.trials.max(members)
                    || watched.stop.load(Ordering::Relaxed)
                    || lock(&watched.failure).is_some()
            })
            .solve();
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
    let results = SizeResults::new(problem, trials, converged && !stopped, stopped, kept);
    if let Some(folder) = folder {
        results.write(folder)?;
    }
    Ok(results)
}
