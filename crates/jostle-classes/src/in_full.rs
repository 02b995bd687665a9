//! A row by a batch and by the standard solvers: how far a batch is from what `jostle run` says.

use std::ops::ControlFlow;
use std::path::Path;

use jostle::{GroundMotion, Plan, RunEnd, Settings, System, simulate};
use jostle_batch::{Motion, Options, Peaks, Row};
use jostle_io::{Format, read_model_text};

use crate::model::{at_floors, model};

/// Tolerance of the runs in full \[–\].
pub const IN_FULL: f64 = 1e-4;

/// Peaks of a row by a batch and in full.
#[derive(Clone, Debug, PartialEq)]
pub struct BothWays {
    /// By the batch.
    pub batch: Peaks,
    /// In full: of every building the drifts of its storeys \[m\].
    pub drift: Vec<Vec<f64>>,
    /// Of every building the accelerations of its floors \[m/s²\].
    pub acceleration: Vec<Vec<f64>>,
    /// Of every gap the forces of its contacts \[N\]; zero in gaps without a law.
    pub force: Vec<Vec<f64>>,
}

/// Runs a row by a batch and in full; `None` when it is told to stop. Where slabs strike columns, both strike the nearest
/// floors: the program's shear buildings have no columns between floors.
///
/// # Errors
/// What is wrong with the row, or how the run in full ended.
pub fn both_ways(
    row: &Row,
    motion: &Motion,
    options: &Options,
    stop: &dyn Fn() -> bool,
) -> Result<Option<BothWays>, String> {
    let row = &Row {
        motion: 0,
        ..at_floors(row)
    };
    let mut batch = None;
    let one = [row.clone()];
    jostle_batch::run(std::slice::from_ref(motion), one, options, |_, peaks| {
        batch = Some(peaks);
        ControlFlow::Continue(())
    })
    .map_err(|error| error.to_string())?;
    let Some(batch) = batch else { return Ok(None) };
    // The motion of the text is not used. Draws may leave what is usual, and batches go on at drifts at which a run would
    // end as collapsed.
    let text = model(row, "record = \"el-centro-1940-ns\"", IN_FULL);
    let keys = "[analysis]\naccept_unusual = true\ncollapse_drift = 1\n";
    let text = text.replacen("[analysis]\n", keys, 1);
    let input = read_model_text("row.toml", &text, Format::Toml, Path::new(""))
        .map_err(|error| error.to_string())?;
    let wave = motion
        .acceleration
        .iter()
        .map(|acceleration| acceleration * row.scale);
    let motion = GroundMotion::sampled("motion", motion.step, wave.collect());
    let shown = |faults: Vec<jostle::ModelFault>| {
        faults.first().map_or_else(String::new, ToString::to_string)
    };
    let system = System::assemble(&input.model).map_err(shown)?;
    let plan = Plan::choose(&system, &motion, &input.model.analysis).map_err(shown)?;
    let settings = Settings {
        record_interval: None,
        ..Settings::default()
    };
    let outcome = simulate(&system, &motion, &plan, settings, |_| {
        if stop() {
            ControlFlow::Break(())
        } else {
            ControlFlow::Continue(())
        }
    });
    match outcome.end_of_all() {
        RunEnd::Completed => {}
        RunEnd::Stopped => return Ok(None),
        RunEnd::Failed(error) => return Err(error.to_string()),
    }
    let (mut drift, mut acceleration) = (Vec::new(), Vec::new());
    for (building, floors) in row.buildings.iter().zip(outcome.peaks.buildings()) {
        // There drifts are ratios.
        let heights = building.storeys.iter().map(|storey| storey.height);
        let drifts = floors.iter().zip(heights);
        drift.push(
            drifts
                .map(|(floor, height)| floor.storey_drift() * height)
                .collect(),
        );
        acceleration.push(
            floors
                .iter()
                .map(|floor| floor.total_acceleration())
                .collect(),
        );
    }
    // Contacts of gaps without a law are not in the model.
    let mut contact = 0;
    let mut force = Vec::with_capacity(row.gaps.len());
    for (gap, found) in row.gaps.iter().zip(&batch.gaps) {
        if gap.law.is_none() {
            force.push(vec![0.0; found.len()]);
            continue;
        }
        let fold = (contact..contact + found.len()).map(|at| {
            let impacts = outcome.impacts.iter().filter(|impact| impact.contact == at);
            impacts.map(|impact| impact.peak_force).fold(0.0, f64::max)
        });
        force.push(fold.collect());
        contact += found.len();
    }
    Ok(Some(BothWays {
        batch,
        drift,
        acceleration,
        force,
    }))
}

impl BothWays {
    /// Differences of drifts, accelerations and forces, each over the greatest of its kind in the building or gap in full
    /// \[–\].
    #[must_use]
    pub fn deviations(&self) -> [Vec<f64>; 3] {
        let buildings = &self.batch.buildings;
        let drift = buildings.iter().zip(&self.drift);
        let acceleration = buildings.iter().zip(&self.acceleration);
        let force = self.batch.gaps.iter().zip(&self.force);
        [
            drift
                .flat_map(|(building, full)| over_greatest(building.drift.iter().copied(), full))
                .collect(),
            acceleration
                .flat_map(|(building, full)| {
                    over_greatest(building.acceleration.iter().copied(), full)
                })
                .collect(),
            force
                .flat_map(|(contacts, full)| {
                    over_greatest(contacts.iter().map(|contact| contact.force), full)
                })
                .collect(),
        ]
    }
}

fn over_greatest(values: impl Iterator<Item = f64>, full: &[f64]) -> Vec<f64> {
    let greatest = full.iter().copied().fold(0.0, f64::max);
    if greatest <= 0.0 {
        return Vec::new();
    }
    values
        .zip(full)
        .map(|(a, b)| (a - b).abs() / greatest)
        .collect()
}
