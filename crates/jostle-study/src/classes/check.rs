//! Some rows of the batches, run again in full.

use jostle_batch::Options;
use jostle_classes::both_ways;
use jostle_io::ClassesFile;
use rayon::prelude::*;

use super::ClassesError;
use super::cases::Motions;
use super::pair::{Draw, Pair};
use super::run::Case;

/// A case of the batches and the same in full.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Checked {
    /// Index of the case.
    pub case: usize,
    /// Greatest drift ratio of the class by the batch and in full \[–\].
    pub drift: [f64; 2],
    /// Greatest contact force \[N\].
    pub force: [f64; 2],
}

impl Checked {
    /// Relative differences of drift and force \[–\]; none of a force that is zero both times.
    #[must_use]
    pub fn deviations(&self) -> [f64; 2] {
        [self.drift, self.force].map(|[batch, full]| {
            let greatest = batch.abs().max(full.abs());
            if greatest > 0.0 {
                (batch - full).abs() / greatest
            } else {
                0.0
            }
        })
    }
}

/// Runs 0.1 % of the rows again, at least those that the file wants, evenly among cases with contact. `None` when it was
/// stopped.
pub(super) fn check(
    file: &ClassesFile,
    pairs: &[Pair],
    motions: &Motions,
    cases: &[Case],
    rows: usize,
    stop: &(dyn Fn() -> bool + Sync),
) -> Result<Option<Vec<Checked>>, ClassesError> {
    let touching: Vec<usize> = (0..cases.len())
        .filter(|at| cases[*at].impacts > 0)
        .collect();
    let wanted = if file.sample == 0 {
        0
    } else {
        file.sample.max(rows.div_ceil(1000)).min(touching.len())
    };
    let chosen = (0..wanted).map(|n| touching[n * touching.len() / wanted]);
    let chosen: Vec<usize> = chosen.collect();
    let runs = chosen
        .par_iter()
        .map(|&at| again(file, &pairs[cases[at].pair], motions, &cases[at], at, stop));
    runs.collect::<Result<Option<Vec<_>>, String>>()
        .map_err(ClassesError::Analysis)
}

/// Drift ratio \[–\] and contact force \[N\] of a case by a batch and in full.
fn again(
    file: &ClassesFile,
    pair: &Pair,
    motions: &Motions,
    case: &Case,
    at: usize,
    stop: &(dyn Fn() -> bool + Sync),
) -> Result<Option<Checked>, String> {
    let draw = Draw {
        number: case.draw as u64,
        motion: case.motion,
        scale: case.scale,
        gap: Some(case.gap),
    };
    let row = pair.row(file, draw);
    let options = Options::for_tolerance(file.tolerance);
    let found = both_ways(&row, &motions.all[case.motion], &options, stop).map_err(|problem| {
        format!(
            "{}, repeated with the standard solvers: {problem}",
            pair.name()
        )
    })?;
    let greatest = |values: &mut dyn Iterator<Item = f64>| values.fold(0.0, f64::max);
    Ok(found.map(|found| {
        let own_place = pair.own_place();
        let heights = row.buildings[own_place]
            .storeys
            .iter()
            .map(|storey| storey.height);
        let heights: Vec<f64> = heights.collect();
        let ratio = |drifts: &[f64]| {
            greatest(
                &mut drifts
                    .iter()
                    .zip(&heights)
                    .map(|(drift, height)| drift / height),
            )
        };
        let forces = found.batch.gaps.iter().flatten();
        Checked {
            case: at,
            drift: [
                ratio(&found.batch.buildings[own_place].drift),
                ratio(&found.drift[own_place]),
            ],
            force: [
                greatest(&mut forces.map(|force| force.force)),
                greatest(&mut found.force.iter().flatten().copied()),
            ],
        }
    }))
}
