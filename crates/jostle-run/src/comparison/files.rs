//! Files of a comparison: `compare.json`, `compare.parquet`, `compare.html`.

use std::path::Path;

use super::text::in_words;
use jostle_io::shown::ACCELERATION;
use jostle_io::{write_atomically, write_columns_parquet};
use jostle_report::{ComparedHistory, ComparedImpactTimes, ComparisonPage, render_comparison};
use serde_json::{Value, json};

use super::{Comparison, HistoryComparison, ImpactComparison};
use crate::error::RunError;
use crate::replace::{FileKind, may_write};

const NUMBERS: &str = "compare.json";
const HISTORIES: &str = "compare.parquet";
const PAGE: &str = "compare.html";

const FILES: [(&str, FileKind); 3] = [
    (NUMBERS, FileKind::COMPARISON_NUMBERS),
    (HISTORIES, FileKind::TABLE),
    (PAGE, FileKind::COMPARISON_PAGE),
];

/// Files of an earlier comparison in a folder, which another one replaces.
///
/// # Errors
/// [`RunError::Kept`] if jostle did not write one of them and `force` is false, [`RunError::Output`] if it cannot be read.
pub fn earlier_comparison(folder: &Path, force: bool) -> Result<Vec<&'static str>, RunError> {
    let mut earlier = Vec::new();
    for (name, kind) in FILES {
        if may_write(&folder.join(name), Some(kind), force)? {
            earlier.push(name);
        }
    }
    Ok(earlier)
}

impl Comparison {
    /// Writes the three files into a folder that exists; each is whole or not there.
    ///
    /// # Errors
    /// [`RunError::Output`] with path and reason.
    pub fn write(&self, folder: &Path) -> Result<(), RunError> {
        write_columns_parquet(&folder.join(HISTORIES), &self.title, self.table())?;
        write_atomically(&folder.join(PAGE), self.page().as_bytes())?;
        let text = format!("{:#}\n", self.json());
        write_atomically(&folder.join(NUMBERS), text.as_bytes())?;
        Ok(())
    }

    /// `compare.json`.
    #[must_use]
    pub fn json(&self) -> Value {
        let [data, data_title, map] = &self.files;
        let column = |column: &HistoryComparison| {
            json!({
                "measured": column.measured_name,
                "computed": column.computed_name,
                "unit": column.unit,
                "score": column.score,
            })
        };
        let impacts = |impacts: &ImpactComparison| {
            json!({
                "sign": impacts.sign,
                "contacts": impacts.contacts,
                "window_s": impacts.window,
                "separation_s": impacts.separation,
                "score": impacts.score,
                "measured_at_s": impacts.measured,
                "computed_at_s": impacts.computed,
                "pairs": impacts.pairs,
            })
        };
        json!({
            "title": self.title,
            "jostle": env!("CARGO_PKG_VERSION"),
            "data": {
                "file": data,
                "title": data_title,
                "map": map,
                "table_motion": self.table_column,
                "start_s": self.start,
                "step_s": self.step,
                "points": self.time.len(),
            },
            "motion": self.summary.motion,
            "columns": self.columns.iter().map(column).collect::<Vec<_>>(),
            "impacts": self.impacts.iter().map(impacts).collect::<Vec<_>>(),
            "promise": self.summary.promise,
            "warnings": self.summary.warnings,
            "notes": self.notes,
        })
    }

    /// Columns of `compare.parquet`: the time, and measured and computed values of every history.
    #[must_use]
    pub fn table(&self) -> Vec<(String, Vec<f64>)> {
        let mut columns = vec![("time_s".to_owned(), self.time.clone())];
        for compared in &self.columns {
            // The same result may be compared with several columns.
            let mut name = compared.computed_name.clone();
            let mut number = 1;
            while columns
                .iter()
                .any(|(known, _)| *known == format!("{name}.measured"))
            {
                number += 1;
                name = format!("{} ({number})", compared.computed_name);
            }
            columns.push((format!("{name}.measured"), compared.measured.clone()));
            columns.push((format!("{name}.computed"), compared.computed.clone()));
        }
        columns
    }

    /// The page: measured over computed histories, and their scores.
    #[must_use]
    pub fn page(&self) -> String {
        let [data, data_title, map] = &self.files;
        let names = self.columns.iter();
        let names: Vec<String> = names
            .map(|column| in_words(&column.computed_name))
            .collect();
        let columns = self.columns.iter().zip(&names);
        let histories: Vec<ComparedHistory<'_>> = columns
            .map(|(column, computed_name)| ComparedHistory {
                measured_name: &column.measured_name,
                computed_name,
                unit: column.unit,
                measured: &column.measured,
                computed: &column.computed,
                score: &column.score,
            })
            .collect();
        let impacts: Vec<ComparedImpactTimes<'_>> = self
            .impacts
            .iter()
            .map(|impacts| ComparedImpactTimes {
                sign: &impacts.sign,
                contacts: &impacts.contacts,
                window: impacts.window,
                measured: &impacts.measured,
                computed: &impacts.computed,
                pairs: &impacts.pairs,
                score: &impacts.score,
            })
            .collect();
        let mut facts = vec![
            ("data".to_owned(), data.clone()),
            ("map".to_owned(), map.clone()),
            ("table motion".to_owned(), self.table_column.clone()),
            (
                "peak of the table".to_owned(),
                ACCELERATION.text(self.summary.motion.pga_m_s2, 3),
            ),
            (
                "start in the data".to_owned(),
                format!("{:.3} s", self.start),
            ),
            (
                "length".to_owned(),
                format!(
                    "{:.3} s, {} instants",
                    self.step * (self.time.len() - 1) as f64,
                    self.time.len()
                ),
            ),
        ];
        if !data_title.is_empty() {
            facts.insert(1, ("title in the data".to_owned(), data_title.clone()));
        }
        render_comparison(&ComparisonPage {
            title: &self.title,
            headline: &self.headline(),
            warnings: &self.summary.warnings,
            facts: &facts,
            time: &self.time,
            histories: &histories,
            impacts: &impacts,
            notes: &self.notes,
        })
    }
}
