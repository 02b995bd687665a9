//! Fragility curves of cases.

use jostle_io::ClassesFile;
use rayon::prelude::*;

use super::pair::Pair;
use super::run::Case;
use crate::statistics::{Band, FitError, Lognormal, bootstrap_band, fit_lognormal};

/// Damage states of HAZUS, in order.
pub const STATES: [&str; 4] = ["slight", "moderate", "extensive", "complete"];

/// Confidence of intervals \[–\].
const CONFIDENCE: f64 = 0.9;

/// Probability that the class reaches a damage state, over the intensity.
#[derive(Clone, Debug, PartialEq)]
pub struct Fragility {
    /// Index of the pair.
    pub pair: usize,
    /// Width of the gap \[m\]; `None` without contact.
    pub gap: Option<f64>,
    /// Index of the state in [`STATES`].
    pub state: usize,
    /// Drift ratio at which the state begins \[–\].
    pub threshold: f64,
    /// Median \[m/s²\] and dispersion of greatest likelihood, or why there are none.
    pub fit: Result<Lognormal, FitError>,
    /// 90 % intervals of median and dispersion, by resampling records.
    pub band: Option<Band>,
    /// Intensity \[m/s²\], cases, and cases in the state, by rising intensity; empty for motions as they are.
    pub counts: Vec<(f64, usize, usize)>,
    /// Greatest difference of observed share and curve at these intensities \[–\].
    pub misfit: Option<f64>,
    /// Cases.
    pub cases: usize,
    /// Cases in the state or a worse one.
    pub reached: usize,
}

/// All curves, by pair, gap (without contact first) and state; `None` when it was stopped.
pub(super) fn curves(
    file: &ClassesFile,
    pairs: &[Pair],
    cases: &[Case],
    stop: &(dyn Fn() -> bool + Sync),
) -> Option<Vec<Fragility>> {
    let mut asked = Vec::new();
    for pair in 0..pairs.len() {
        let gaps = file.gaps.iter().map(|gap| Some(*gap));
        for gap in std::iter::once(None).chain(gaps) {
            asked.extend((0..STATES.len()).map(|state| (pair, gap, state)));
        }
    }
    // Cases lie pair by pair.
    let of_pair = cases.len() / pairs.len().max(1);
    let fits = asked.par_iter().map(|&(pair, gap, state)| {
        let cases = &cases[pair * of_pair..(pair + 1) * of_pair];
        (!stop()).then(|| curve(file, &pairs[pair], cases, (pair, gap, state)))
    });
    fits.collect()
}

fn curve(
    file: &ClassesFile,
    pair: &Pair,
    cases: &[Case],
    (number, gap, state): (usize, Option<f64>, usize),
) -> Fragility {
    let threshold = pair.own.class.drifts[state];
    let mut groups: Vec<Vec<(f64, bool)>> = Vec::new();
    // Without contact every gap has the same numbers: take those of the first.
    let width = gap.unwrap_or(file.gaps[0]);
    for case in cases.iter().filter(|case| case.gap == width) {
        let demand = if gap.is_some() { case.with } else { case.alone };
        groups.resize(groups.len().max(case.motion + 1), Vec::new());
        groups[case.motion].push((case.intensity, demand.drift >= threshold));
    }
    let outcomes: Vec<(f64, bool)> = groups.iter().flatten().copied().collect();
    let fit = fit_lognormal(&outcomes);
    let band = if fit.is_ok() && groups.len() > 1 && file.resamples > 0 {
        bootstrap_band(
            &groups,
            file.resamples,
            CONFIDENCE,
            1,
            &file.levels,
            fit_lognormal,
        )
    } else {
        None
    };
    let counts: Vec<(f64, usize, usize)> = file
        .levels
        .iter()
        .map(|level| {
            let at = outcomes.iter().filter(|outcome| outcome.0 == *level);
            let reached = at.clone().filter(|outcome| outcome.1).count();
            (*level, at.count(), reached)
        })
        .collect();
    let misfit = fit.as_ref().ok().and_then(|fit| {
        let apart = counts.iter().map(|&(level, cases, reached)| {
            (fit.probability(level) - reached as f64 / cases as f64).abs()
        });
        apart.reduce(f64::max)
    });
    Fragility {
        pair: number,
        gap,
        state,
        threshold,
        fit,
        band,
        counts,
        misfit,
        cases: outcomes.len(),
        reached: outcomes.iter().filter(|outcome| outcome.1).count(),
    }
}
