//! Suites: one model under several records, with the governing value by the rule of a code.
//!
//! [`Suite::new`] checks every record of a model, [`Suite::run`] runs what is not finished yet on all cores, each record into a
//! folder of its own with the files of a single run, and [`SuiteResults`] has the statistics. Every number depends on the
//! model and its records alone: not on threads, order or interruptions.

mod findings;
mod fingerprint;
mod page;
mod quantities;
mod results;
mod runner;
mod statistics;
mod text;

use std::path::PathBuf;
use std::sync::Arc;

use jostle_io::Input;
use jostle_motion::TargetKind;
use jostle_run::{Opened, Prepared, RunError};

pub use jostle_motion::GoverningRule;
pub use quantities::Quantity;
pub use results::{RecordResult, RecordStatus, SuiteResults};
pub use runner::{SuiteDone, SuiteOptions, SuiteProgress, earlier_suite_files};
pub use statistics::QuantityStatistics;

/// A model with several records, checked.
pub struct Suite {
    /// Title of the model.
    pub title: String,
    /// Its records, in the order of the file.
    pub records: Vec<SuiteRecord>,
    /// Rule for the governing values.
    pub rule: GoverningRule,
    /// Warnings of the model and its motions, each once.
    pub warnings: Vec<String>,
}

/// One record of a suite.
pub struct SuiteRecord {
    /// Name or path as written.
    pub label: String,
    /// Name of its folder: its number and the name of the motion.
    pub folder: String,
    /// The model with this record.
    opened: Opened,
}

impl Suite {
    /// Checks the model with every one of its records, of which there are two at least. `rule` takes the place of that of
    /// the model file; without either it is that of the code to whose spectrum the motions are matched, or else the
    /// greatest value.
    ///
    /// # Errors
    /// [`RunError::Input`] with the line of the record that cannot be used.
    pub fn new(opened: &Opened, rule: Option<GoverningRule>) -> Result<Self, RunError> {
        let input = &opened.input;
        let mut warnings = input.warnings.clone();
        let mut records = Vec::new();
        let names = input.records().iter();
        for (index, (label, one)) in names.zip(input.each_record()).enumerate() {
            // Its own assembly, so that shapes are those that a run of this record alone would find.
            let opened = Opened::new(one, opened.name.clone())?;
            let prepared = opened.prepare()?;
            prepared.check_digits(None)?;
            for warning in &prepared.input.warnings {
                if !warnings.contains(warning) {
                    warnings.push(warning.clone());
                }
            }
            records.push(SuiteRecord {
                label: label.clone(),
                folder: folder_name(index + 1, input.records().len(), &prepared.motion.name),
                opened,
            });
        }
        Ok(Self {
            title: input.model.title.clone(),
            records,
            rule: rule.unwrap_or_else(|| usual_rule(input)),
            warnings,
        })
    }

    /// Where the files of a record belong in a folder.
    fn place(&self, index: usize, folder: &std::path::Path) -> PathBuf {
        folder.join(&self.records[index].folder)
    }
}

impl SuiteRecord {
    fn prepare(&self) -> Result<Prepared, RunError> {
        self.opened.prepare()
    }

    /// The model with this record, as read.
    fn input(&self) -> &Arc<Input> {
        &self.opened.input
    }
}

/// The rule of the file, that of the code of the matched spectrum, or the greatest value.
fn usual_rule(input: &Input) -> GoverningRule {
    let matched = input.target().map(|(target, _)| match target.kind {
        TargetKind::Gb50011(_) => GoverningRule::Gb50011,
        TargetKind::En1998(_) => GoverningRule::En1998,
        TargetKind::Asce7(_) => GoverningRule::Asce7,
        TargetKind::Table(_) => GoverningRule::Maximum,
    });
    input
        .governing
        .or(matched)
        .unwrap_or(GoverningRule::Maximum)
}

/// `03-el-centro-1940-ns`: letters, digits, and hyphens for all else.
fn folder_name(number: usize, count: usize, motion: &str) -> String {
    let width = count.to_string().len().max(2);
    let mut name = String::new();
    for c in motion.chars().take(60) {
        let kept = c.is_alphanumeric() || matches!(c, '.' | '_');
        if kept {
            name.push(c);
        } else if !name.ends_with('-') {
            name.push('-');
        }
    }
    let name = name.trim_matches(['-', '.']);
    format!("{number:0width$}-{name}")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn folders_are_safe_names_in_order() {
        assert_eq!(
            folder_name(3, 7, "el-centro-1940-ns"),
            "03-el-centro-1940-ns"
        );
        assert_eq!(folder_name(12, 120, "../a b/c?.AT2"), "012-a-b-c-.AT2");
        assert_eq!(folder_name(1, 2, "南京"), "01-南京");
    }
}
