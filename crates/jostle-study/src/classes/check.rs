//! Some rows of the batches, run again in full.

use std::path::Path;

use jostle::{GroundMotion, RunEnd};
use jostle_io::{ClassesFile, Format, MotionSource, MotionSpec, read_model_text};
use jostle_run::Opened;
use rayon::prelude::*;

use super::ClassesError;
use super::cases::Motions;
use super::pair::{Draw, Pair};
use super::run::Case;
use crate::single::run_until;

/// Tolerance of runs in full \[–\].
const TOLERANCE: f64 = 1e-4;

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

/// Runs 0.1 % of the rows again, at least those that the file wants, evenly among cases with contact. Pairs whose slabs
/// strike columns are left out: shear buildings of model files have no columns between floors. `None` when it was
/// stopped.
pub(super) fn check(
    file: &ClassesFile,
    pairs: &[Pair],
    motions: &Motions,
    cases: &[Case],
    rows: usize,
    stop: &(dyn Fn() -> bool + Sync),
) -> Result<Option<Vec<Checked>>, ClassesError> {
    let even: Vec<bool> = pairs
        .iter()
        .map(|own| own.has_common_floors(file))
        .collect();
    let touching: Vec<usize> = (0..cases.len())
        .filter(|at| cases[*at].impacts > 0 && even[cases[*at].pair])
        .collect();
    let wanted = if file.sample == 0 {
        0
    } else {
        file.sample.max(rows.div_ceil(1000)).min(touching.len())
    };
    let chosen = (0..wanted).map(|n| touching[n * touching.len() / wanted]);
    let chosen: Vec<usize> = chosen.collect();
    let runs = chosen.par_iter().map(|&at| {
        let case = &cases[at];
        again(file, &pairs[case.pair], motions, case, stop).map(|full| {
            full.map(|[drift, force]| Checked {
                case: at,
                drift: [case.with.drift, drift],
                force: [case.force, force],
            })
        })
    });
    runs.collect::<Result<Option<Vec<_>>, String>>()
        .map_err(ClassesError::Analysis)
}

/// Drift ratio \[–\] and contact force \[N\] of a case in full.
fn again(
    file: &ClassesFile,
    pair: &Pair,
    motions: &Motions,
    case: &Case,
    stop: &(dyn Fn() -> bool + Sync),
) -> Result<Option<[f64; 2]>, String> {
    let name = pair.name();
    let draw = Draw {
        number: case.draw as u64,
        motion: case.motion,
        scale: case.scale,
        gap: Some(case.gap),
    };
    let text = model_text(file, pair, draw);
    let wrong = |problem: String| format!("{name}, run again in full: {problem}");
    let input = read_model_text(&name, &text, Format::Toml, Path::new(""));
    let mut input = input.map_err(|error| wrong(error.to_string()))?;
    let record = &motions.all[case.motion];
    let acceleration = record.acceleration.iter().map(|own| own * case.scale);
    let motion = GroundMotion::sampled(
        &motions.names[case.motion],
        record.step,
        acceleration.collect(),
    );
    let mut spec = MotionSpec::record("");
    spec.source = MotionSource::Given(motion);
    input.replace_motion(spec);
    let opened = Opened::new(input, name.as_str()).map_err(|error| wrong(error.to_string()))?;
    let prepared = opened.prepare().map_err(|error| wrong(error.to_string()))?;
    let settings = prepared.settings(false);
    let Some(ran) = run_until(prepared, settings, stop) else {
        return Ok(None);
    };
    if ran.outcome.end != RunEnd::Completed {
        return Err(wrong(format!("{:?}", ran.outcome.end)));
    }
    let summary = ran.summary();
    let floors = &summary.buildings[pair.own_place()].floors.above;
    let drift = floors.iter().map(|own| own.response.storey_drift_peak);
    let force = summary.gaps.iter().map(|own| own.peak_force_n);
    Ok(Some([drift.fold(0.0, f64::max), force.fold(0.0, f64::max)]))
}

/// The model file of a draw.
fn model_text(file: &ClassesFile, pair: &Pair, draw: Draw) -> String {
    let row = pair.row(file, draw);
    let text = jostle_classes::model(&row, "record = \"el-centro-1940-ns\"", TOLERANCE);
    // Draws may leave what is usual, and batches go on at drifts at which a run would end as collapsed.
    let keys = "[analysis]\naccept_unusual = true\ncollapse_drift = 1\n";
    text.replacen("[analysis]\n", keys, 1)
}
