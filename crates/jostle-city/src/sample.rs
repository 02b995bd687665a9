//! Some rows repeated with the standard solvers, to see how good the batches are.

use jostle_batch::{Motion, Options, Row};
use jostle_classes::both_ways;
use serde_json::{Value, json};

use crate::fault::CityError;

/// Deviations of peaks, each over the greatest of its kind in the building or gap.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Sampled {
    /// Rows run in full.
    pub rows: usize,
    /// Deviations \[–\], unordered.
    pub deviations: Vec<f64>,
}

impl Sampled {
    /// Runs a row both ways and keeps how far its peaks are apart; `stop` ends it.
    pub(crate) fn add(
        &mut self,
        row: &Row,
        motion: &Motion,
        options: &Options,
        title: &str,
        stop: &dyn Fn() -> bool,
    ) -> Result<(), CityError> {
        let found = both_ways(row, motion, options, stop).map_err(|problem| {
            CityError::Analysis(format!(
                "{title}, repeated with the standard solvers: {problem}"
            ))
        })?;
        let found = found.ok_or(CityError::Stopped)?;
        self.rows += 1;
        self.deviations.extend(found.deviations().concat());
        Ok(())
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
        let deviations = value["deviations"]
            .as_array()
            .into_iter()
            .flatten()
            .filter_map(Value::as_f64);
        self.deviations.extend(deviations);
    }

    /// Share of peaks within a tolerance, and the worst \[–\]; `None` without any.
    #[must_use]
    pub fn within(&self, tolerance: f64) -> Option<(f64, f64)> {
        let within = self
            .deviations
            .iter()
            .filter(|deviation| **deviation <= tolerance)
            .count();
        let worst = self.deviations.iter().copied().fold(0.0, f64::max);
        (!self.deviations.is_empty()).then(|| (within as f64 / self.deviations.len() as f64, worst))
    }
}
