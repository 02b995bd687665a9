//! All results of a suite, and its files.

use std::path::Path;

use jostle::results::summary::{Finding, PromiseSummary};
use jostle_io::{Values, write_atomically, write_values_parquet};
use jostle_motion::Governing;
use serde::Serialize;
use serde_json::{Value, json};

use super::findings::findings;
use super::quantities::quantities;
use super::statistics::QuantityStatistics;
use super::{Suite, SuiteRecord};
use crate::study::StudyError;

/// One record that was run.
#[derive(Clone, Debug, PartialEq)]
pub struct RecordResult {
    /// Name or path as written.
    pub label: String,
    /// Folder of its files, beside those of the suite.
    pub folder: String,
    /// Whether it reached its end.
    pub status: RecordStatus,
    /// Why it did not.
    pub reason: Option<String>,
    /// Its `summary.json`.
    pub summary: Value,
    /// The text of that file.
    pub text: String,
}

/// How the run of a record ended.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
#[serde(rename_all = "lowercase")]
pub enum RecordStatus {
    /// At the end of the motion.
    Completed,
    /// A building collapsed.
    Collapsed,
    /// A step failed.
    Failed,
}

/// All results of a suite.
#[derive(Clone, Debug, PartialEq)]
pub struct SuiteResults {
    /// Title of the model.
    pub title: String,
    /// What the rule says about this number of records.
    pub governing: Governing,
    /// One for every record, in the order of the model file.
    pub records: Vec<RecordResult>,
    /// Every quantity that a record has.
    pub quantities: Vec<QuantityStatistics>,
    /// Warnings about the governing values.
    pub warnings: Vec<String>,
    /// Checks that records did not pass, each by its worst record; the most severe first.
    pub checks: Vec<Finding>,
}

impl RecordResult {
    pub(super) fn new(record: &SuiteRecord, text: String) -> Self {
        // It was written, or checked, by jostle.
        let summary: Value = serde_json::from_str(&text).unwrap_or_default();
        let reason = summary["ended_early"].as_str().map(str::to_owned);
        let status = match &reason {
            None => RecordStatus::Completed,
            Some(reason) if reason.contains(" collapses at ") => RecordStatus::Collapsed,
            Some(_) => RecordStatus::Failed,
        };
        Self {
            label: record.label.clone(),
            folder: record.folder.clone(),
            status,
            reason,
            summary,
            text,
        }
    }

    /// Name of the motion.
    #[must_use]
    pub fn motion(&self) -> &str {
        self.summary["motion"]["name"]
            .as_str()
            .unwrap_or(&self.label)
    }
}

impl SuiteResults {
    pub(super) fn new(suite: &Suite, records: Vec<RecordResult>) -> Self {
        let governing = suite.rule.for_motions(records.len());
        let lists: Vec<Vec<_>> = records
            .iter()
            .map(|record| match record.status {
                RecordStatus::Completed => quantities(&record.summary),
                RecordStatus::Collapsed | RecordStatus::Failed => Vec::new(),
            })
            .collect();
        let mut names: Vec<&str> = Vec::new();
        for quantity in lists.iter().flatten() {
            if !names.contains(&&quantity.name[..]) {
                names.push(&quantity.name);
            }
        }
        let value = |list: &Vec<super::Quantity>, name: &str| {
            list.iter().find(|q| q.name == name).map(|q| q.value)
        };
        let quantities = names.iter().filter_map(|name| {
            let values = lists.iter().map(|list| value(list, name)).collect();
            QuantityStatistics::new((*name).to_owned(), values, governing.statistic)
        });
        let quantities = quantities.collect();
        let mut warnings = Vec::new();
        if !governing.met {
            warnings.push(governing.in_words(records.len()));
        }
        for record in &records {
            if let Some(reason) = &record.reason {
                warnings.push(format!(
                    "{} did not reach its end ({reason}): mean, maximum and governing values are those of the other records and do not count as the values of a code",
                    record.motion()
                ));
            }
        }
        let checks = findings(&records);
        Self {
            title: suite.title.clone(),
            governing,
            records,
            quantities,
            warnings,
            checks,
        }
    }

    /// Statistics of a quantity by its name.
    #[must_use]
    pub fn quantity(&self, name: &str) -> Option<&QuantityStatistics> {
        self.quantities.iter().find(|q| q.name == name)
    }

    /// The accuracy of the record that is worst, in one line; `None` without records that reached their end.
    #[must_use]
    pub fn accuracy_in_words(&self) -> Option<String> {
        let done = |record: &&RecordResult| record.status == RecordStatus::Completed;
        let promises = self.records.iter().filter(done).map(|record| {
            let promise = &record.summary["promise"];
            let known = PromiseSummary {
                tolerance: promise["tolerance"].as_f64().unwrap_or(f64::NAN),
                met: promise["met"].as_bool(),
                met_until_s: promise["met_until_s"].as_f64(),
                residual: promise["residual"].as_f64(),
                sensitive_from_s: promise["sensitive_from_s"].as_f64(),
            };
            (record, known)
        });
        let rank = |promise: &PromiseSummary| {
            let is_missed = promise.met != Some(true);
            let is_cut = promise.met_until_s.is_some();
            let is_sensitive = promise.sensitive_from_s.is_some();
            (is_missed, is_cut, is_sensitive)
        };
        let (worst, promise) = promises.max_by(|(_, a), (_, b)| {
            let residual = |promise: &PromiseSummary| promise.residual.unwrap_or(f64::INFINITY);
            let order = rank(a).cmp(&rank(b));
            order.then(residual(a).total_cmp(&residual(b)))
        })?;
        Some(format!(
            "{} ({}, the worst record)",
            promise.in_words(),
            worst.motion()
        ))
    }

    /// Text of `suite.json`, with a final line break.
    #[must_use]
    pub fn json(&self) -> String {
        let records: Vec<Value> = self
            .records
            .iter()
            .map(|record| {
                json!({
                    "record": record.label,
                    "motion": record.summary["motion"],
                    "folder": record.folder,
                    "status": record.status,
                    "reason": record.reason,
                    "promise": record.summary["promise"],
                    "warnings": record.summary["warnings"],
                })
            })
            .collect();
        let count = self.records.len();
        let value = json!({
            "title": self.title,
            "jostle": env!("CARGO_PKG_VERSION"),
            "governing": {
                "rule": self.governing.rule.name(),
                "clause": self.governing.rule.clause(),
                "statistic": self.governing.statistic.name(),
                "met": self.governing.met,
                "text": self.governing.in_words(count),
            },
            "records": records,
            "quantities": self.quantities,
            "warnings": self.warnings,
            "checks": self.checks,
        });
        format!("{value:#}\n")
    }

    /// Columns of the table: one row per record.
    #[must_use]
    pub fn columns(&self) -> Vec<(String, Values)> {
        let text = |of: &dyn Fn(&RecordResult) -> String| {
            Values::Text(self.records.iter().map(of).collect())
        };
        let number = |key: &'static str| {
            let values = self.records.iter();
            Values::Instant(values.map(|r| r.summary["motion"][key].as_f64()).collect())
        };
        let status = |record: &RecordResult| {
            let status = serde_json::to_value(record.status).unwrap_or_default();
            status.as_str().unwrap_or_default().to_owned()
        };
        let mut columns = vec![
            ("record".to_owned(), text(&|record| record.label.clone())),
            (
                "motion".to_owned(),
                text(&|record| record.motion().to_owned()),
            ),
            ("folder".to_owned(), text(&|record| record.folder.clone())),
            ("status".to_owned(), text(&status)),
            (
                "reason".to_owned(),
                text(&|record| record.reason.clone().unwrap_or_default()),
            ),
            ("pga_m_s2".to_owned(), number("pga_m_s2")),
            ("scale".to_owned(), number("scale")),
            ("duration_s".to_owned(), number("duration_s")),
        ];
        for quantity in &self.quantities {
            columns.push((
                quantity.name.clone(),
                Values::Instant(quantity.values.clone()),
            ));
        }
        columns
    }

    /// Columns of the statistics: one row per quantity.
    #[must_use]
    pub fn statistics_columns(&self) -> Vec<(String, Values)> {
        let real = |of: fn(&QuantityStatistics) -> f64| {
            Values::Real(self.quantities.iter().map(of).collect())
        };
        let names = self.quantities.iter().map(|q| q.name.clone());
        let worst = self.quantities.iter();
        let worst = worst.map(|q| self.records[q.maximum_record].motion().to_owned());
        let deviation = self.quantities.iter().map(|q| q.standard_deviation);
        vec![
            ("quantity".to_owned(), Values::Text(names.collect())),
            ("mean".to_owned(), real(|q| q.mean)),
            (
                "standard_deviation".to_owned(),
                Values::Instant(deviation.collect()),
            ),
            ("minimum".to_owned(), real(|q| q.minimum)),
            ("p16".to_owned(), real(|q| q.p16)),
            ("median".to_owned(), real(|q| q.median)),
            ("p84".to_owned(), real(|q| q.p84)),
            ("maximum".to_owned(), real(|q| q.maximum)),
            ("maximum_record".to_owned(), Values::Text(worst.collect())),
            ("governing".to_owned(), real(|q| q.governing)),
        ]
    }

    /// Writes `suite.json`, `suite.parquet` and the page.
    pub(super) fn write(
        &self,
        suite: &Suite,
        folder: &Path,
        links: bool,
    ) -> Result<(), StudyError> {
        let page = self.page(suite, links);
        write_atomically(&folder.join("suite.html"), page.as_bytes())?;
        write_values_parquet(
            &folder.join("suite.parquet"),
            &self.title,
            &[],
            self.columns(),
        )?;
        write_atomically(&folder.join("suite.json"), self.json().as_bytes())?;
        Ok(())
    }
}
