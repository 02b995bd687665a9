//! From a design to the values of every case, each case by itself.

use jostle_io::{DesignKind, Factor, FactorValues, Sampling, StudyFile, TreeValue};

use crate::sampling::{Copula, CopulaError, LatinHypercube, SobolSequence, Stream, quantile};

/// The cases of a study: any of them can be asked for without the others.
pub struct CaseDesign {
    /// Number of cases.
    pub cases: u64,
    kind: DesignKind,
    /// Lengths of the crossed lists, or one for zipped ones and another for records of the model; the last varies
    /// fastest, after it the draws.
    lists: Vec<u64>,
    /// Draws for each combination of the lists, 1 where nothing is drawn.
    draws: u64,
    points: Points,
    copula: Copula,
    quantiles: [f64; 2],
    dimensions: usize,
    /// For every factor its list among `lists`; those of one table share theirs.
    places: Vec<usize>,
    /// For every factor the one whose coordinate chooses its value: the first of its table, or itself.
    leaders: Vec<usize>,
    seed: u64,
}

/// Where points between 0 and 1 come from.
enum Points {
    None,
    LatinHypercube(LatinHypercube),
    Sequence(SobolSequence),
    Random(u64),
}

/// The value of a factor in a case.
#[derive(Clone, Debug, PartialEq)]
pub enum Choice {
    /// An entry of its list.
    Listed(usize),
    /// A number drawn from its distribution, in the unit of the distribution.
    Drawn(f64),
}

/// Why a design makes no cases.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
pub enum DesignError {
    /// More cases than tables can number.
    #[error("the design has {0} cases; at most 2147483647 are possible")]
    TooMany(u128),
    /// Correlations.
    #[error(transparent)]
    Correlations(#[from] CopulaError),
    /// More factors than the sequence has dimensions.
    #[error("a Sobol sequence has at most 100 dimensions, and {0} are needed")]
    TooManyDimensions(usize),
}

/// Levels of a Morris design on the unit interval.
const MORRIS_LEVELS: u64 = 4;
const RANDOM: u64 = 4;
const TRAJECTORY: u64 = 5;

impl CaseDesign {
    /// Prepares the design of a study.
    ///
    /// # Errors
    /// [`DesignError`].
    pub fn new(file: &StudyFile) -> Result<Self, DesignError> {
        let (design, factors) = (&file.design, &file.factors);
        let k = factors.len();
        let samples = design.samples.unwrap_or(1);
        let leaders: Vec<usize> = (factors.iter().enumerate())
            .map(|(index, factor)| {
                let same = |other: &Factor| other.entry == factor.entry && !other.from_model;
                let first = factors.iter().position(same);
                first.filter(|_| !factor.from_model).unwrap_or(index)
            })
            .collect();
        let zipped = design.kind == DesignKind::Zipped;
        let mut places = vec![0; k];
        let mut listed: Vec<(bool, u64)> = Vec::new();
        for (index, factor) in factors.iter().enumerate() {
            let Some(count) = factor.values.count() else {
                continue;
            };
            if leaders[index] != index {
                places[index] = places[leaders[index]];
                continue;
            }
            // Zipped lists are the first, records of the model the last.
            places[index] = match (zipped, factor.from_model) {
                (true, false) => 0,
                (true, true) => usize::MAX,
                (false, _) => listed.len(),
            };
            listed.push((factor.from_model, count as u64));
        }
        let lengths = |from_model: bool| {
            let same = listed.iter().filter(move |list| list.0 == from_model);
            same.map(|list| list.1)
        };
        let (lists, draws, dimensions) = match design.kind {
            DesignKind::Factorial => (listed.iter().map(|list| list.1).collect(), samples, k),
            DesignKind::Zipped => {
                let zipped = lengths(false).take(1).chain(lengths(true));
                (zipped.collect(), samples, k)
            }
            DesignKind::Saltelli => (Vec::new(), samples, 2 * k),
            _ => (Vec::new(), samples, k),
        };
        let product = |numbers: &[u64]| numbers.iter().map(|n| u128::from(*n)).product::<u128>();
        let cases = match design.kind {
            DesignKind::Saltelli => u128::from(samples) * (k as u128 + 2),
            DesignKind::Morris => u128::from(samples) * (k as u128 + 1),
            DesignKind::OneAtATime => 2 * k as u128 + 1,
            _ => product(&lists) * u128::from(draws),
        };
        if cases > i32::MAX as u128 {
            return Err(DesignError::TooMany(cases));
        }
        let sampling = match design.kind {
            DesignKind::LatinHypercube => Some(Sampling::LatinHypercube),
            DesignKind::Sobol | DesignKind::Saltelli => Some(Sampling::Sobol),
            DesignKind::Random => Some(Sampling::Random),
            DesignKind::Morris | DesignKind::OneAtATime => None,
            DesignKind::Factorial | DesignKind::Zipped => {
                design.samples.is_some().then_some(design.sampling)
            }
        };
        let points = match sampling {
            None => Points::None,
            Some(Sampling::LatinHypercube) => {
                Points::LatinHypercube(LatinHypercube::new(draws, dimensions, design.seed))
            }
            Some(Sampling::Sobol) => {
                if dimensions > crate::sampling::MOST_DIMENSIONS {
                    return Err(DesignError::TooManyDimensions(dimensions));
                }
                Points::Sequence(SobolSequence::new(dimensions, design.seed))
            }
            Some(Sampling::Random) => Points::Random(design.seed),
        };
        let pairs: Vec<_> = design
            .correlations
            .iter()
            .map(|correlation| (correlation.between, correlation.value))
            .collect();
        Ok(Self {
            cases: cases as u64,
            kind: design.kind,
            lists,
            draws,
            points,
            copula: Copula::new(k, &pairs)?,
            quantiles: design.quantiles,
            dimensions,
            places,
            leaders,
            seed: design.seed,
        })
    }

    /// Lengths of the crossed lists, and draws for each of their combinations.
    pub(crate) fn lists_and_draws(&self) -> (&[u64], u64) {
        (&self.lists, self.draws)
    }

    /// The values of a case, factor by factor.
    #[must_use]
    pub fn choices(&self, case: u64, factors: &[Factor]) -> Vec<Choice> {
        match self.kind {
            DesignKind::Factorial | DesignKind::Zipped => self.listed(case, factors),
            DesignKind::LatinHypercube | DesignKind::Sobol | DesignKind::Random => {
                let point = self.point(case);
                self.chosen(factors, &point)
            }
            DesignKind::Saltelli => self.chosen(factors, &self.saltelli(case, factors.len())),
            DesignKind::Morris => self.chosen(factors, &self.morris(case, factors.len())),
            DesignKind::OneAtATime => {
                let mut point = vec![0.5; factors.len()];
                if case > 0 {
                    let at = (case - 1) as usize;
                    if let Some(u) = point.get_mut(at / 2) {
                        *u = self.quantiles[at % 2];
                    }
                }
                self.chosen(factors, &point)
            }
        }
    }

    /// Values at the coordinates of a point; the entries of a list share the unit interval equally.
    fn chosen(&self, factors: &[Factor], point: &[f64]) -> Vec<Choice> {
        let choice = |(factor, leader): (&Factor, &usize)| {
            let u = point.get(*leader).copied().unwrap_or(0.5);
            match &factor.values {
                FactorValues::Drawn(distribution) => Choice::Drawn(quantile(distribution, u)),
                values @ (FactorValues::Listed(_) | FactorValues::Table(_)) => {
                    let count = values.count().unwrap_or(1);
                    Choice::Listed(((u * count as f64) as usize).min(count - 1))
                }
            }
        };
        factors.iter().zip(&self.leaders).map(choice).collect()
    }

    fn listed(&self, case: u64, factors: &[Factor]) -> Vec<Choice> {
        let draw = case % self.draws;
        let mut rest = case / self.draws;
        let mut levels = vec![0; self.lists.len()];
        for (level, length) in levels.iter_mut().zip(&self.lists).rev() {
            *level = (rest % length) as usize;
            rest /= length;
        }
        let mut point = self.point(draw);
        point.resize(factors.len(), 0.5);
        let pick = |((factor, u), place): ((&Factor, f64), &usize)| match &factor.values {
            FactorValues::Listed(_) | FactorValues::Table(_) => {
                let at = (*place).min(levels.len().saturating_sub(1));
                Choice::Listed(levels.get(at).copied().unwrap_or(0))
            }
            FactorValues::Drawn(distribution) => Choice::Drawn(quantile(distribution, u)),
        };
        factors
            .iter()
            .zip(point)
            .zip(&self.places)
            .map(pick)
            .collect()
    }

    /// A point of the sample, correlated.
    fn point(&self, sample: u64) -> Vec<f64> {
        let mut point = match &self.points {
            Points::None => Vec::new(),
            Points::LatinHypercube(cube) => cube.point(sample),
            Points::Sequence(sequence) => sequence.point(sample),
            Points::Random(seed) => {
                let mut stream = Stream::new(*seed, RANDOM, sample);
                (0..self.dimensions)
                    .map(|_| stream.open_uniform())
                    .collect()
            }
        };
        self.copula.apply(&mut point);
        point
    }

    /// Of base sample j the points A, B and A with one coordinate of B, in this order (Saltelli et al. 2010).
    fn saltelli(&self, case: u64, k: usize) -> Vec<f64> {
        let block = (case % (k as u64 + 2)) as usize;
        let both = match &self.points {
            Points::Sequence(sequence) => sequence.point(case / (k as u64 + 2)),
            _ => Vec::new(),
        };
        let (a, b) = both.split_at(k.min(both.len()));
        match block {
            0 => a.to_vec(),
            1 => b.to_vec(),
            mixed => {
                let mut point = a.to_vec();
                if let (Some(u), Some(other)) = (point.get_mut(mixed - 2), b.get(mixed - 2)) {
                    *u = *other;
                }
                point
            }
        }
    }

    /// The coordinates of a Morris trajectory after some of its steps (Morris 1991).
    fn morris(&self, case: u64, k: usize) -> Vec<f64> {
        let taken = (case % (k as u64 + 1)) as usize;
        let steps = morris_steps(self.seed, case / (k as u64 + 1), k);
        let mut point = steps.start;
        for (factor, end) in steps.moves.iter().take(taken) {
            point[*factor] = *end;
        }
        // The ends of the interval are infinitely far away in unbounded distributions.
        point.iter().map(|u| 0.01 + 0.98 * u).collect()
    }
}

/// A trajectory of a Morris design.
pub(crate) struct MorrisSteps {
    /// Where it begins, on a grid of four levels.
    pub(crate) start: Vec<f64>,
    /// Which factor moves, and to where, step by step.
    pub(crate) moves: Vec<(usize, f64)>,
}

/// The trajectory of a number: Δ = p / (2 (p − 1)) with p levels.
pub(crate) fn morris_steps(seed: u64, trajectory: u64, k: usize) -> MorrisSteps {
    let mut stream = Stream::new(seed, TRAJECTORY, trajectory);
    let last = (MORRIS_LEVELS - 1) as f64;
    let step = MORRIS_LEVELS as f64 / (2.0 * last);
    let start: Vec<f64> = (0..k)
        .map(|_| stream.below(MORRIS_LEVELS) as f64 / last)
        .collect();
    let mut order: Vec<usize> = (0..k).collect();
    for end in (1..k).rev() {
        order.swap(end, stream.below(end as u64 + 1) as usize);
    }
    let moves = order.into_iter().map(|factor| {
        let from = start[factor];
        // On this grid exactly one of the two directions stays inside.
        let to = if from + step > 1.0 + 1e-12 {
            from - step
        } else {
            from + step
        };
        (factor, to)
    });
    MorrisSteps {
        moves: moves.collect(),
        start,
    }
}

/// Value for the model, and its number in SI if it is one.
pub(crate) fn value_of(factor: &Factor, choice: &Choice) -> (TreeValue, Option<f64>, String) {
    match (&factor.values, choice) {
        (FactorValues::Listed(levels), Choice::Listed(index)) => {
            let level = &levels[*index];
            (level.value.clone(), level.number, level.label.clone())
        }
        (FactorValues::Drawn(distribution), Choice::Drawn(number)) => {
            let value = distribution.value(*number);
            let label = value.to_string();
            (value, Some(number * distribution.unit_size), label)
        }
        (FactorValues::Table(column), Choice::Listed(row)) => match column.level(*row) {
            Ok(Some(level)) => (level.value, level.number, level.label),
            _ => (TreeValue::Flag(false), None, String::new()),
        },
        // Choices are made for these very factors.
        _ => (TreeValue::Flag(false), None, String::new()),
    }
}
