//! Batches of every pair: without contact first, then with those gaps that close.

use std::ops::ControlFlow;

use jostle_batch::{Motion, Options, Peaks, Row, run};
use jostle_io::ClassesFile;
use rayon::ThreadPoolBuilder;

use super::ClassesError;
use super::cases::Motions;
use super::check::{Checked, check};
use super::curves::{Fragility, curves};
use super::pair::{Draw, Pair, pairs, types};
use super::shared::{Shared, shared};

/// Factors on records beyond which their shape is doubtful.
const USUAL_FACTORS: std::ops::RangeInclusive<f64> = 0.1..=10.0;

/// Greatest response of the class.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Demand {
    /// Drift over the height of the storey \[–\].
    pub drift: f64,
    /// Total acceleration of a floor \[m/s²\].
    pub acceleration: f64,
}

/// A pair under a motion, with one gap.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Case {
    /// Index of the pair.
    pub pair: usize,
    /// Index of the motion.
    pub motion: usize,
    /// Intensity \[m/s²\].
    pub intensity: f64,
    /// Factor on the motion \[–\].
    pub scale: f64,
    /// Number of the draw.
    pub draw: usize,
    /// Width of the gap \[m\].
    pub gap: f64,
    /// Greatest closing without contact \[m\].
    pub closing: f64,
    /// Without contact.
    pub alone: Demand,
    /// With contact.
    pub with: Demand,
    /// Greatest force of a contact \[N\].
    pub force: f64,
    /// Impacts of all contacts.
    pub impacts: u32,
    /// Whether a slab struck columns.
    pub column: bool,
}

/// Results of a classes file.
#[derive(Debug)]
pub struct ClassesResults {
    /// Where capacities and damage drifts come from.
    pub(crate) sources: [String; 2],
    pub(crate) pairs: Vec<Pair>,
    pub(crate) motions: Vec<String>,
    /// Every case, by pair, motion, intensity, draw and gap.
    pub cases: Vec<Case>,
    /// Rows that were stepped.
    pub rows: usize,
    /// Curves without contact and with every gap.
    pub curves: Vec<Fragility>,
    /// Curves of one dispersion for every pair and gap, in the order of `curves`, or why there are none.
    pub(crate) shared: Vec<Result<Shared, String>>,
    /// Rows that were run again in full.
    pub checked: Vec<Checked>,
    /// What a reader must know.
    pub warnings: Vec<String>,
}

/// Runs all pairs of a file. `None` when it was stopped: nothing is kept then. `progress` receives finished and all
/// pairs. Numbers do not depend on `jobs`, the number of threads.
///
/// # Errors
/// [`ClassesError`] when a type, a motion or a row is wrong.
pub fn run_classes(
    file: &ClassesFile,
    jobs: Option<usize>,
    stop: &(dyn Fn() -> bool + Sync),
    progress: &(dyn Fn(usize, usize) + Sync),
) -> Result<Option<ClassesResults>, ClassesError> {
    let pool = ThreadPoolBuilder::new().num_threads(jobs.unwrap_or(0));
    let pool = pool
        .build()
        .map_err(|error| ClassesError::Analysis(format!("no threads can be started: {error}")))?;
    pool.install(|| run_here(file, stop, progress))
}

/// Rows without contact of a file: pairs × motions × intensities × draws.
///
/// # Errors
/// [`ClassesError`] when a type or a motion is wrong.
pub fn count_rows(file: &ClassesFile) -> Result<usize, ClassesError> {
    let types = types(file)?;
    let pairs = pairs(file, &types)?;
    let motions = Motions::new(file)?;
    Ok(pairs.len() * motions.all.len() * file.levels.len().max(1) * file.draws)
}

fn run_here(
    file: &ClassesFile,
    stop: &(dyn Fn() -> bool + Sync),
    progress: &(dyn Fn(usize, usize) + Sync),
) -> Result<Option<ClassesResults>, ClassesError> {
    let types = types(file)?;
    let pairs = pairs(file, &types)?;
    let motions = Motions::new(file)?;
    let mut warnings = file.warnings.clone();
    warn_of_storeys(&pairs, &mut warnings);
    let options = Options::for_tolerance(file.tolerance);
    let (mut cases, mut rows) = (Vec::new(), 0);
    let mut factors = [f64::INFINITY, 0.0_f64];
    for (at, pair) in pairs.iter().enumerate() {
        let draws = draws_of(file, pair, &motions, &mut factors)?;
        let mut batch = Batch {
            file,
            pair,
            motions: &motions.all,
            options: &options,
            stop,
        };
        let Some(alone) = batch.peaks(draws.iter().map(|draw| draw.1))? else {
            return Ok(None);
        };
        rows += alone.len();
        let first = cases.len();
        let mut touching = Vec::new();
        for ((intensity, draw), peaks) in draws.iter().zip(&alone) {
            let closing = closing(peaks);
            let demand = demand(pair, peaks);
            for gap in &file.gaps {
                if closing > *gap {
                    let gap = Some(*gap);
                    touching.push((cases.len(), Draw { gap, ..*draw }));
                }
                cases.push(Case {
                    pair: at,
                    motion: draw.motion,
                    intensity: *intensity,
                    scale: draw.scale,
                    draw: draw.number as usize,
                    gap: *gap,
                    closing,
                    alone: demand,
                    // A gap that never closes changes nothing.
                    with: demand,
                    force: 0.0,
                    impacts: 0,
                    column: false,
                });
            }
        }
        debug_assert_eq!(cases.len() - first, draws.len() * file.gaps.len());
        let Some(with) = batch.peaks(touching.iter().map(|touching| touching.1))? else {
            return Ok(None);
        };
        rows += with.len();
        for ((case, _), peaks) in touching.iter().zip(&with) {
            let case = &mut cases[*case];
            case.with = demand(pair, peaks);
            let contacts = || peaks.gaps.iter().flatten();
            case.force = contacts().map(|contact| contact.force).fold(0.0, f64::max);
            case.impacts = contacts().map(|contact| contact.impacts).sum();
            case.column = contacts().any(|contact| contact.column && contact.impacts > 0);
        }
        progress(at + 1, pairs.len());
    }
    if !(USUAL_FACTORS.contains(&factors[0]) && USUAL_FACTORS.contains(&factors[1])) {
        warnings.push(format!(
            "records are scaled by {:.3} to {:.3}; outside 0.1 to 10 the shape of a record rarely fits its intensity",
            factors[0], factors[1]
        ));
    }
    let Some(checked) = check(file, &pairs, &motions, &cases, rows, stop)? else {
        return Ok(None);
    };
    let Some(curves) = curves(file, &pairs, &cases, stop) else {
        return Ok(None);
    };
    let shared = shared(file, &curves, &cases, pairs.len());
    Ok(Some(ClassesResults {
        shared,
        sources: types.sources().map(str::to_owned),
        pairs,
        motions: motions.names,
        cases,
        rows,
        curves,
        checked,
        warnings,
    }))
}

fn warn_of_storeys(pairs: &[Pair], warnings: &mut Vec<String>) {
    for pair in pairs {
        for building in [&pair.own, &pair.neighbour] {
            let text = format!(
                "{}: {} storeys lie outside {} to {}, for which the table means the type",
                building.class.name,
                building.storeys,
                building.class.storeys.start(),
                building.class.storeys.end()
            );
            if !building.is_usual() && !warnings.contains(&text) {
                warnings.push(text);
            }
        }
    }
}

/// Intensity \[m/s²\] and draw of every row without contact.
fn draws_of(
    file: &ClassesFile,
    pair: &Pair,
    motions: &Motions,
    factors: &mut [f64; 2],
) -> Result<Vec<(f64, Draw)>, ClassesError> {
    let unscaled = motions.intensities(file.measure, pair.own.period());
    let unscaled = unscaled.map_err(|problem| file.fault("intensity", problem))?;
    let mut draws = Vec::new();
    for (motion, unscaled) in unscaled.into_iter().enumerate() {
        if !(unscaled.is_finite() && unscaled > 0.0) {
            let name = &motions.names[motion];
            return Err(file
                .fault("motion.record", format!("\"{name}\" has no intensity"))
                .into());
        }
        let scaled: Vec<(f64, f64)> = if file.levels.is_empty() {
            vec![(unscaled, 1.0)]
        } else {
            let scale = |level: &f64| (*level, level / unscaled);
            file.levels.iter().map(scale).collect()
        };
        for (intensity, scale) in scaled {
            factors[0] = factors[0].min(scale);
            factors[1] = factors[1].max(scale);
            draws.extend((0..file.draws as u64).map(|number| {
                let draw = Draw {
                    number,
                    motion,
                    scale,
                    gap: None,
                };
                (intensity, draw)
            }));
        }
    }
    Ok(draws)
}

/// What rows of one pair share.
struct Batch<'a> {
    file: &'a ClassesFile,
    pair: &'a Pair,
    motions: &'a [Motion],
    options: &'a Options,
    stop: &'a (dyn Fn() -> bool + Sync),
}

impl Batch<'_> {
    /// Peaks of draws, in order; `None` when it was stopped.
    fn peaks(
        &mut self,
        draws: impl Iterator<Item = Draw>,
    ) -> Result<Option<Vec<Peaks>>, ClassesError> {
        let mut all = Vec::new();
        let mut stopped = (self.stop)();
        let rows = draws.map(|draw| -> Row { self.pair.row(self.file, draw) });
        let sink = |_, peaks| {
            all.push(peaks);
            stopped |= (self.stop)();
            if stopped {
                ControlFlow::Break(())
            } else {
                ControlFlow::Continue(())
            }
        };
        run(self.motions, rows, self.options, sink).map_err(|error| {
            ClassesError::Analysis(format!("{}: {}", self.pair.name(), error.fault))
        })?;
        Ok((!stopped).then_some(all))
    }
}

/// Greatest closing of any contact \[m\].
fn closing(peaks: &Peaks) -> f64 {
    let contacts = peaks.gaps.iter().flatten();
    contacts
        .map(|contact| contact.closing)
        .fold(f64::NEG_INFINITY, f64::max)
}

/// Greatest response of the class of a pair.
pub(super) fn demand(pair: &Pair, peaks: &Peaks) -> Demand {
    let building = &peaks.buildings[pair.own_place()];
    let greatest = |values: &[f64]| values.iter().copied().fold(0.0, f64::max);
    Demand {
        drift: greatest(&building.drift) / pair.own.class.storey_height,
        acceleration: greatest(&building.acceleration),
    }
}
