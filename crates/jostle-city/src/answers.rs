//! How often buildings are struck, and what becomes of them.

use std::collections::BTreeMap;
use std::path::Path;

use jostle::linear::quantile;

use crate::case::{Case, read_cases};
use crate::draw::GapWidths;
use crate::fault::CityError;
use crate::run::City;
use crate::sample::Sampled;

/// Damage states: none, slight, moderate, extensive, complete.
pub(crate) const STATES: usize = 5;

/// Medians of gaps at which the probability of a strike is kept, over the median of the city file \[–\].
pub(crate) const MEDIANS: [f64; 9] = [0.125, 0.25, 0.375, 0.5, 0.75, 1.0, 1.5, 2.0, 4.0];
/// The place of the median itself.
pub(crate) const OWN: usize = 5;

/// What is known of a building after the run.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct BuildingAnswer {
    /// Draws times motions.
    pub samples: usize,
    /// Probability that a neighbour strikes it, at medians of the gaps from an eighth to four times that of the file.
    pub struck: [f64; 9],
    /// Probability that a slab strikes its columns or it strikes those of a neighbour \[–\].
    pub column: f64,
    /// Probabilities of the damage states alone and with neighbours \[–\].
    pub states: [[f64; STATES]; 2],
    /// Medians of the greatest drift ratio alone and with neighbours \[–\].
    pub drift: [f64; 2],
}

/// What is known of a pair after the run.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct PairAnswer {
    /// Draws times motions.
    pub samples: usize,
    /// Samples in which they hit each other.
    pub hits: usize,
    /// Probability that they hit each other, from the closing curve \[–\].
    pub struck: f64,
    /// Share of the samples in which a slab strikes columns \[–\].
    pub column: f64,
    /// Greatest closing of the free buildings: median and 90 % quantile \[m\].
    pub closing: [f64; 2],
    /// Force where they hit: median and 90 % quantile; 0 if they never do \[N\].
    pub force: [f64; 2],
    /// Share of samples in which contact brings either building to a worse state \[–\].
    pub worse: f64,
    /// Share in which it spares either one a state \[–\].
    pub better: f64,
    /// Draw and motion that show most: of those that worsen the states most, the one with the greatest force; `None` where
    /// they never hit.
    pub telling: Option<[usize; 2]>,
}

impl PairAnswer {
    /// How much a pair deserves a look: four times the share of worse states, twice that of strikes on columns, and the probability
    /// of a strike \[–\].
    #[must_use]
    pub fn concern(&self) -> f64 {
        2.0 * self.column + 4.0 * self.worse + self.struck
    }
}

/// The results of a run.
#[derive(Clone, Debug, Default)]
pub struct Answers {
    /// As the buildings; `None` for those without a neighbour.
    pub buildings: Vec<Option<BuildingAnswer>>,
    /// As the pairs.
    pub pairs: Vec<PairAnswer>,
    /// Shares of samples of buildings with neighbours whose state contact makes worse, and better \[–\].
    pub changed: [f64; 2],
    /// Drift ratio with contact over that alone, where neighbours hit: quantiles 5, 50, 95, 99 % \[–\].
    pub drift_ratios: [f64; 4],
    /// Share of pairs that stand in rows of more than two buildings, over all samples \[–\].
    pub in_rows: f64,
    /// Change of the drift of buildings in blocks that are cut otherwise: how many, median and 95 % quantile \[–\].
    pub cut: (usize, [f64; 2]),
    /// Runs in full.
    pub sampled: Sampled,
}

/// Means over the buildings with a neighbour \[–\].
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Means {
    /// Buildings with a neighbour.
    pub buildings: usize,
    /// Probability of being struck, at half the median of the gaps, at the median and at its double.
    pub struck: [f64; 3],
    /// Probability that a slab strikes columns.
    pub column: f64,
    /// Probability of moderate damage and worse, alone and with neighbours.
    pub moderate: [f64; 2],
}

impl Answers {
    /// Means over the buildings with a neighbour.
    #[must_use]
    pub fn means(&self) -> Means {
        let with: Vec<&BuildingAnswer> = self.buildings.iter().flatten().collect();
        let mean = |of: &dyn Fn(&BuildingAnswer) -> f64| {
            with.iter().map(|building| of(building)).sum::<f64>() / with.len().max(1) as f64
        };
        Means {
            buildings: with.len(),
            struck: [OWN - 2, OWN, OWN + 2].map(|at| mean(&|answer| answer.struck[at])),
            column: mean(&|answer| answer.column),
            moderate: [0, 1].map(|which| mean(&|answer| answer.states[which][2..].iter().sum())),
        }
    }
}

/// What accumulates of a building.
#[derive(Default)]
struct Tally {
    states: [[u32; STATES]; 2],
    struck: [f64; 9],
    column: u32,
    drift: [Vec<f32>; 2],
}

impl City {
    /// Reads all parts of a run and says what they mean.
    ///
    /// # Errors
    ///
    /// When parts are missing or of another run.
    pub fn answers(&self, folder: &Path) -> Result<Answers, CityError> {
        let mut answers = Answers {
            buildings: vec![None; self.inventory.buildings.len()],
            pairs: vec![PairAnswer::default(); self.neighbours.pairs.len()],
            ..Answers::default()
        };
        let mut ratios = Vec::new();
        let mut cut: Vec<f32> = Vec::new();
        let (mut worse, mut better, mut samples, mut in_rows, mut cases_seen) =
            (0_usize, 0_usize, 0_usize, 0_usize, 0_usize);
        for path in self.part_paths(folder) {
            if !path.exists() {
                return Err(CityError::lacks(&path, "run"));
            }
            let (cases, table) = read_cases(&path)?;
            self.same_run(&path, &table)?;
            answers
                .sampled
                .add_json(table.facts.get("sample").map_or("", String::as_str));
            let other: Option<Vec<f32>> = table
                .facts
                .get("cut")
                .and_then(|fact| serde_json::from_str(fact).ok());
            cut.extend(other.into_iter().flatten());
            cases_seen += cases.len();
            in_rows += cases.iter().filter(|case| case.row > 2).count();
            for case in &cases {
                if case.impacts > 0 {
                    let both = [0, 1].map(|side| (case.drift[1][side], case.drift[0][side]));
                    ratios.extend(
                        both.into_iter()
                            .filter(|candidate| candidate.1 > 0.0)
                            .map(|drifts| (drifts.0 / drifts.1) as f32),
                    );
                }
            }
            for of_pair in cases.chunk_by(|a, b| a.pair == b.pair) {
                answers.pairs[of_pair[0].pair] = self.pair_answer(of_pair);
            }
            let (found, [bad, good, all]) = self.building_answers(&cases);
            for (building, answer) in found {
                answers.buildings[building] = Some(answer);
            }
            worse += bad;
            better += good;
            samples += all;
        }
        let share = |part: usize, of: usize| part as f64 / of.max(1) as f64;
        answers.changed = [share(worse, samples), share(better, samples)];
        answers.in_rows = share(in_rows, cases_seen);
        cut.sort_by(f32::total_cmp);
        answers.cut = (cut.len(), [0.5, 0.95].map(|share| quantile_of(&cut, share)));
        ratios.sort_by(f32::total_cmp);
        answers.drift_ratios = [0.05, 0.5, 0.95, 0.99].map(|share| quantile_of(&ratios, share));
        Ok(answers)
    }

    fn gaps_at(&self, factor: f64) -> GapWidths {
        let gaps = self.gaps();
        GapWidths {
            median: factor * gaps.median,
            ..gaps
        }
    }

    fn pair_answer(&self, cases: &[Case]) -> PairAnswer {
        let pair = &self.neighbours.pairs[cases[0].pair];
        let count = cases.len() as f64;
        let gaps = self.gaps();
        let share = |of: &dyn Fn(&Case) -> bool| {
            cases.iter().filter(|case| of(case)).count() as f64 / count
        };
        let mut closings: Vec<f32> = cases.iter().map(|case| case.closing as f32).collect();
        closings.sort_by(f32::total_cmp);
        let mut forces: Vec<f32> = cases
            .iter()
            .filter(|case| case.impacts > 0)
            .map(|case| case.force as f32)
            .collect();
        forces.sort_by(f32::total_cmp);
        let two = |values: &[f32]| [0.5, 0.9].map(|share| quantile_of(values, share));
        PairAnswer {
            samples: cases.len(),
            hits: cases.iter().filter(|case| case.impacts > 0).count(),
            struck: cases
                .iter()
                .map(|case| gaps.probability_below(case.closing, pair.distance))
                .sum::<f64>()
                / count,
            column: share(&|case| case.column_impacts > 0),
            closing: two(&closings),
            force: two(&forces),
            worse: share(&|case| {
                [0, 1]
                    .iter()
                    .any(|side| case.state[1][*side] > case.state[0][*side])
            }),
            better: share(&|case| {
                [0, 1]
                    .iter()
                    .any(|side| case.state[1][*side] < case.state[0][*side])
            }),
            telling: cases
                .iter()
                .filter(|case| case.impacts > 0)
                .max_by(|a, b| {
                    worsened(a)
                        .cmp(&worsened(b))
                        .then(a.force.total_cmp(&b.force))
                })
                .map(|case| [case.draw, case.motion]),
        }
    }

    /// Answers of the buildings of a part, and how many of their samples get worse, get better, and are there.
    fn building_answers(&self, cases: &[Case]) -> (Vec<(usize, BuildingAnswer)>, [usize; 3]) {
        // A building may stand in several pairs: its sample is the worst of them.
        let mut of_building: BTreeMap<usize, Vec<(&Case, usize)>> = BTreeMap::new();
        for case in cases {
            for (side, building) in self.neighbours.pairs[case.pair]
                .buildings
                .into_iter()
                .enumerate()
            {
                of_building.entry(building).or_default().push((case, side));
            }
        }
        let medians = MEDIANS.map(|factor| self.gaps_at(factor));
        let mut changed = [0; 3];
        let mut found = Vec::with_capacity(of_building.len());
        for (building, mut building_cases) in of_building {
            building_cases.sort_by_key(|(case, _)| (case.draw, case.motion));
            let mut tally = Tally::default();
            let mut samples = 0;
            for sample in
                building_cases.chunk_by(|a, b| (a.0.draw, a.0.motion) == (b.0.draw, b.0.motion))
            {
                samples += 1;
                let greatest = |of: &dyn Fn(&(&Case, usize)) -> usize| {
                    sample.iter().map(of).max().unwrap_or(0)
                };
                let states = [0, 1].map(|which| greatest(&|(case, side)| case.state[which][*side]));
                for which in [0, 1] {
                    tally.states[which][states[which].min(STATES - 1)] += 1;
                    let drift = sample
                        .iter()
                        .map(|(case, side)| case.drift[which][*side])
                        .fold(0.0, f64::max);
                    tally.drift[which].push(drift as f32);
                }
                changed[0] += usize::from(states[1] > states[0]);
                changed[1] += usize::from(states[1] < states[0]);
                tally.column += u32::from(sample.iter().any(|(case, _)| case.column_impacts > 0));
                for (at, gaps) in medians.iter().enumerate() {
                    let free: f64 = sample
                        .iter()
                        .map(|(case, _)| {
                            let distance = self.neighbours.pairs[case.pair].distance;
                            1.0 - gaps.probability_below(case.closing, distance)
                        })
                        .product();
                    tally.struck[at] += 1.0 - free;
                }
            }
            changed[2] += samples;
            let count = samples as f64;
            let median = |drifts: &mut Vec<f32>| {
                drifts.sort_by(f32::total_cmp);
                quantile_of(drifts, 0.5)
            };
            let answer = BuildingAnswer {
                samples,
                struck: tally.struck.map(|struck| struck / count),
                column: f64::from(tally.column) / count,
                states: tally
                    .states
                    .map(|state| state.map(|number| f64::from(number) / count)),
                drift: [median(&mut tally.drift[0]), median(&mut tally.drift[1])],
            };
            found.push((building, answer));
        }
        (found, changed)
    }
}

/// States by which contact makes both buildings of a pair worse.
fn worsened(case: &Case) -> usize {
    let of = |side: usize| case.state[1][side].saturating_sub(case.state[0][side]);
    of(0) + of(1)
}

/// A quantile of sorted values; 0 of none.
fn quantile_of(sorted: &[f32], share: f64) -> f64 {
    if sorted.is_empty() {
        0.0
    } else {
        quantile(sorted, share)
    }
}
