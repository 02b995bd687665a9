//! Some rows run again by the program's own stepping, to see how good the batches are.

use std::ops::ControlFlow;
use std::path::Path;

use jostle::{GroundMotion, Plan, Settings, System, simulate};
use jostle_batch::{Motion, Options, Row};
use jostle_classes::{at_floors, model};
use jostle_io::{Format, read_model_text};
use serde_json::{Value, json};

use crate::fault::CityError;

/// Tolerance of the runs in full.
const TOLERANCE: f64 = 1e-4;

/// Deviations of peaks, each over the greatest of its kind in the building or gap.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Sampled {
    /// Rows run in full.
    pub rows: usize,
    /// Deviations \[–\], unordered.
    pub deviations: Vec<f64>,
}

impl Sampled {
    /// Runs a row both ways and keeps how far its peaks are apart. Where slabs strike columns, both strike the nearest floors.
    pub(crate) fn add(
        &mut self,
        row: &Row,
        motion: &Motion,
        options: &Options,
        title: &str,
    ) -> Result<(), CityError> {
        let fault =
            |problem: String| CityError::Analysis(format!("{title}, run again in full: {problem}"));
        let row = &Row {
            motion: 0,
            ..at_floors(row)
        };
        let mut peaks = None;
        jostle_batch::run(
            std::slice::from_ref(motion),
            [row.clone()],
            options,
            |_, own| {
                peaks = Some(own);
                ControlFlow::Continue(())
            },
        )
        .map_err(|error| fault(error.to_string()))?;
        let Some(peaks) = peaks else { return Ok(()) };
        // The motion of the text is not used. Batches go on at drifts at which a run would end as collapsed.
        let text = model(row, "record = \"el-centro-1940-ns\"", TOLERANCE);
        let keys = "[analysis]\naccept_unusual = true\ncollapse_drift = 1\n";
        let text = text.replacen("[analysis]\n", keys, 1);
        let input = read_model_text("sample.toml", &text, Format::Toml, Path::new(""))
            .map_err(|error| fault(error.to_string()))?;
        let wave = motion
            .acceleration
            .iter()
            .map(|own| own * row.scale)
            .collect();
        let motion = GroundMotion::sampled("motion", motion.step, wave);
        let shown = |faults: Vec<jostle::ModelFault>| {
            fault(faults.first().map_or_else(String::new, ToString::to_string))
        };
        let system = System::assemble(&input.model).map_err(&shown)?;
        let plan = Plan::choose(&system, &motion, &input.model.analysis).map_err(&shown)?;
        let settings = Settings {
            record_interval: None,
            ..Settings::default()
        };
        let outcome = simulate(&system, &motion, &plan, settings, |_| {
            ControlFlow::Continue(())
        });
        self.rows += 1;
        let buildings = peaks.buildings.iter().zip(&row.buildings);
        for ((own, building), floors) in buildings.zip(outcome.peaks.buildings()) {
            // There drifts are ratios, here metres.
            let ratios: Vec<f64> = own
                .drift
                .iter()
                .zip(&building.storeys)
                .map(|(drift, storey)| drift / storey.height)
                .collect();
            let drifts: Vec<f64> = floors.iter().map(|own| own.storey_drift()).collect();
            let accelerations: Vec<f64> =
                floors.iter().map(|own| own.total_acceleration()).collect();
            self.compare(&ratios, &drifts);
            self.compare(&own.acceleration, &accelerations);
        }
        // Contacts of gaps without a law are not in the model.
        let held = peaks
            .gaps
            .iter()
            .zip(&row.gaps)
            .filter(|own| own.1.law.is_some());
        let mut contact = 0;
        for (own, _) in held {
            let forces: Vec<f64> = own.iter().map(|own| own.force).collect();
            let full = (contact..contact + own.len()).map(|at| {
                let impacts = outcome.impacts.iter().filter(|own| own.contact == at);
                impacts.map(|own| own.peak_force).fold(0.0, f64::max)
            });
            self.compare(&forces, &full.collect::<Vec<_>>());
            contact += own.len();
        }
        Ok(())
    }

    fn compare(&mut self, own: &[f64], full: &[f64]) {
        let greatest = full.iter().copied().fold(0.0, f64::max);
        if greatest > 0.0 {
            self.deviations
                .extend(own.iter().zip(full).map(|(a, b)| (a - b).abs() / greatest));
        }
    }

    /// As text of a table's facts.
    pub(crate) fn to_json(&self) -> String {
        json!({ "rows": self.rows, "deviations": self.deviations }).to_string()
    }

    /// Adds what a part keeps.
    pub(crate) fn add_json(&mut self, text: &str) {
        let Ok(value) = serde_json::from_str::<Value>(text) else {
            return;
        };
        self.rows += value["rows"].as_u64().unwrap_or(0) as usize;
        let own = value["deviations"]
            .as_array()
            .into_iter()
            .flatten()
            .filter_map(Value::as_f64);
        self.deviations.extend(own);
    }

    /// Share of peaks within a tolerance, and the worst \[–\]; `None` without any.
    #[must_use]
    pub fn within(&self, tolerance: f64) -> Option<(f64, f64)> {
        let within = self
            .deviations
            .iter()
            .filter(|own| **own <= tolerance)
            .count();
        let worst = self.deviations.iter().copied().fold(0.0, f64::max);
        (!self.deviations.is_empty()).then(|| (within as f64 / self.deviations.len() as f64, worst))
    }
}
