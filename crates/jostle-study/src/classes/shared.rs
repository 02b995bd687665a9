//! Curves of the four states of one pair and gap with one dispersion, so that they never cross: what damage states of other
//! programs need.

use jostle_io::ClassesFile;
use rayon::prelude::*;

use super::curves::{Fragility, STATES};
use super::run::Case;
use crate::sampling::normal_cdf;
use crate::statistics::FitError;

/// Dispersions that are searched \[–\].
const DISPERSIONS: [f64; 2] = [0.02, 3.0];
/// Medians are searched this far beyond the intensities.
const BEYOND: f64 = 20.0;

/// Medians \[m/s²\] and the dispersion of greatest likelihood for all states together.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Shared {
    pub(crate) medians: [f64; 4],
    pub(crate) dispersion: f64,
}

/// One for every pair and gap, in the order of `curves`, or why there is none.
pub(super) fn shared(
    file: &ClassesFile,
    curves: &[Fragility],
    cases: &[Case],
    pairs: usize,
) -> Vec<Result<Shared, String>> {
    let of_pair = cases.len() / pairs.max(1);
    let groups = curves.par_chunks(STATES.len()).map(|states| {
        let first = &states[0];
        let cases = &cases[first.pair * of_pair..(first.pair + 1) * of_pair];
        let width = first.gap.unwrap_or(file.gaps[0]);
        let demands: Vec<(f64, f64)> = cases
            .iter()
            .filter(|case| case.gap == width)
            .map(|case| {
                let demand = if first.gap.is_some() {
                    case.with
                } else {
                    case.alone
                };
                (libm::log(case.intensity), demand.drift)
            })
            .collect();
        let one_sided = states
            .iter()
            .find(|state| state.reached == 0 || state.reached == state.cases);
        if let Some(state) = one_sided {
            let (cases, add) = match state.reached {
                0 => ("none", "higher"),
                _ => ("all", "lower"),
            };
            return Err(format!(
                "{} damage in {cases} of {} cases: add {add} intensities",
                STATES[state.state], state.cases
            ));
        }
        fit(&demands, states)
    });
    groups.collect()
}

/// Greatest likelihood over the dispersion, and for each dispersion over every median.
fn fit(demands: &[(f64, f64)], states: &[Fragility]) -> Result<Shared, String> {
    if states
        .iter()
        .all(|state| is_a_step(demands, state.threshold))
    {
        return Err(FitError::NoMaximum.to_string());
    }
    let low = demands
        .iter()
        .map(|demand| demand.0)
        .fold(f64::INFINITY, f64::min);
    let high = demands
        .iter()
        .map(|demand| demand.0)
        .fold(f64::NEG_INFINITY, f64::max);
    let span = [low - libm::log(BEYOND), high + libm::log(BEYOND)];
    let likelihood = |threshold: f64, median: f64, dispersion: f64| -> f64 {
        let one = |&(intensity, drift): &(f64, f64)| {
            let z = (intensity - median) / dispersion;
            let chance = if drift >= threshold {
                normal_cdf(z)
            } else {
                normal_cdf(-z)
            };
            libm::log(chance.max(1e-300))
        };
        demands.iter().map(one).sum()
    };
    let medians = |dispersion: f64| {
        let each = states.iter().map(|state| {
            let of = |median: f64| likelihood(state.threshold, median, dispersion);
            let at = greatest(span, of);
            (at, of(at))
        });
        each.collect::<Vec<_>>()
    };
    let bounds = DISPERSIONS.map(libm::log);
    let best = greatest(bounds, |log| {
        medians(libm::exp(log)).iter().map(|median| median.1).sum()
    });
    if (best - bounds[0]).abs() < 1e-3 || (best - bounds[1]).abs() < 1e-3 {
        return Err("no scatter to fit a dispersion".into());
    }
    let dispersion = libm::exp(best);
    let mut all = [0.0; 4];
    for (to, (median, _)) in all.iter_mut().zip(medians(dispersion)) {
        *to = libm::exp(median);
    }
    Ok(Shared {
        medians: all,
        dispersion,
    })
}

/// Whether curves with ever smaller dispersion fit a state as well as its observed shares do: it occurs nowhere below one intensity and
/// everywhere above it.
fn is_a_step(demands: &[(f64, f64)], threshold: f64) -> bool {
    let of = |reached: bool| {
        let some = demands
            .iter()
            .filter(move |demand| (demand.1 >= threshold) == reached);
        some.map(|demand| demand.0)
    };
    let first_with = of(true).fold(f64::INFINITY, f64::min);
    let last_without = of(false).fold(f64::NEG_INFINITY, f64::max);
    last_without <= first_with
}

/// Where a function with one peak is greatest, by the golden section.
fn greatest([mut low, mut high]: [f64; 2], of: impl Fn(f64) -> f64) -> f64 {
    const GOLDEN: f64 = 0.618_033_988_749_894_9;
    let (mut a, mut b) = (high - GOLDEN * (high - low), low + GOLDEN * (high - low));
    let (mut at_a, mut at_b) = (of(a), of(b));
    while high - low > 1e-7 {
        if at_a > at_b {
            (high, b, at_b) = (b, a, at_a);
            a = high - GOLDEN * (high - low);
            at_a = of(a);
        } else {
            (low, a, at_a) = (a, b, at_b);
            b = low + GOLDEN * (high - low);
            at_b = of(b);
        }
    }
    0.5 * (low + high)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::sampling::normal_quantile;

    fn state(threshold: f64) -> Fragility {
        Fragility {
            pair: 0,
            gap: None,
            state: 0,
            threshold,
            fit: Err(FitError::NoMaximum),
            band: None,
            counts: Vec::new(),
            misfit: None,
            cases: 0,
            reached: 0,
        }
    }

    /// Shares of a half at one intensity, none below and all above: every small dispersion fits them.
    #[test]
    fn steps_have_no_dispersion() {
        let drifts = |low: f64, high: f64| [(0.0, 0.1), (1.0, low), (1.0, high), (2.0, 9.0)];
        let states = [1.0, 2.0].map(state);
        assert!(fit(&drifts(0.1, 9.0), &states).is_err());
        // A demand at a lower intensity above one at a higher intensity is scatter.
        let scattered = [(0.0, 0.1), (1.0, 3.0), (2.0, 0.1), (3.0, 9.0)];
        assert!(fit(&scattered, &states).is_ok());
    }

    #[test]
    fn a_common_dispersion_is_found_again() {
        // Drift = intensity × a lognormal factor of 0.4: a state at drift d has the median d and the dispersion 0.4.
        let mut demands = Vec::new();
        for level in 1..=12 {
            let log = libm::log(0.25 * f64::from(level));
            for n in 0..200 {
                let z = normal_quantile((f64::from(n) + 0.5) / 200.0);
                demands.push((log, libm::exp(log + 0.4 * z)));
            }
        }
        let thresholds = [0.5, 0.8, 1.2, 2.0];
        let found = fit(&demands, &thresholds.map(state)).unwrap_or_else(|error| panic!("{error}"));
        assert!((found.dispersion - 0.4).abs() < 0.01, "{found:?}");
        for (median, wanted) in found.medians.iter().zip(thresholds) {
            assert!((median / wanted - 1.0).abs() < 0.01, "{found:?}");
        }
        // One state alone has the curve of the probit regression.
        let outcomes: Vec<(f64, bool)> = demands
            .iter()
            .map(|demand| (libm::exp(demand.0), demand.1 >= 0.8))
            .collect();
        let probit =
            crate::statistics::fit_lognormal(&outcomes).unwrap_or_else(|error| panic!("{error}"));
        let single = fit(&demands, &[state(0.8)]).unwrap_or_else(|error| panic!("{error}"));
        assert!(
            (single.dispersion / probit.dispersion - 1.0).abs() < 1e-4,
            "{single:?} {probit:?}"
        );
        assert!(
            (single.medians[0] / probit.median - 1.0).abs() < 1e-4,
            "{single:?} {probit:?}"
        );
    }
}
