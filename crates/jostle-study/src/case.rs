//! One case: from the values of its factors to a row.

use jostle::{RunEnd, StepError};
use jostle_run::{CaseCache, CaseError, Prepared, Ran};

use crate::design::value_of;
use crate::measures::measures;
use crate::row::{Row, Status};
use crate::study::Study;

impl Study {
    /// Reads a case, finds its system and its motion among those kept, and plans its steps.
    ///
    /// # Errors
    /// [`CaseError`] with the message of the reader of model files.
    pub fn prepare(&self, case_cache: &CaseCache, case: u64) -> Result<Prepared, CaseError> {
        let tree = self.tree(&self.design.choices(case, &self.file.factors))?;
        case_cache.assemble(tree.input()?)
    }
}

/// The row of a case without results.
pub(crate) fn blank(study: &Study, case: u64) -> Row {
    let choices = study.design.choices(case, &study.file.factors);
    let mut numbers = Vec::with_capacity(study.layout.count_numbers());
    let mut texts = Vec::new();
    let columns = study.layout.inputs.iter();
    for ((factor, choice), column) in study.file.factors.iter().zip(&choices).zip(columns) {
        let (_, number, label) = value_of(factor, choice);
        if column.kind == crate::layout::Kind::Text {
            texts.push(label);
        } else {
            numbers.push(number);
        }
    }
    texts.push(String::new());
    numbers.resize(study.layout.count_numbers(), None);
    Row {
        case,
        status: Status::Completed,
        reason: String::new(),
        numbers,
        texts,
    }
}

/// The row of a case that could not be computed.
pub(crate) fn failed(study: &Study, case: u64, reason: &str) -> Row {
    Row {
        status: Status::Failed,
        reason: one_line(reason),
        ..blank(study, case)
    }
}

/// A message of several lines without its excerpts of the file.
fn one_line(text: &str) -> String {
    let lines = text.lines().map(str::trim).filter(|line| !line.is_empty());
    let lines = lines.filter(|line| {
        let excerpt = line.split_once('|').is_some_and(|(number, _)| {
            number.trim().is_empty() || number.trim().parse::<usize>().is_ok()
        });
        !excerpt
            && !line.starts_with('|')
            && !line.contains(" fault in ")
            && !line.contains(" faults in ")
    });
    lines.collect::<Vec<_>>().join("; ")
}

/// The row of a case that ran.
pub(crate) fn row_of(study: &Study, case: u64, ran: &Ran) -> Row {
    let summary = ran.summary();
    let mut row = blank(study, case);
    if let Some(text) = row.texts.last_mut() {
        text.clone_from(&summary.motion.name);
    }
    row.status = match &ran.outcome.end {
        RunEnd::Completed | RunEnd::Stopped => Status::Completed,
        RunEnd::Failed(StepError::Collapse { .. }) => Status::Collapsed,
        RunEnd::Failed(_) => Status::Failed,
    };
    if let RunEnd::Failed(error) = &ran.outcome.end {
        row.reason = error.to_string();
    }
    let offset = row.numbers.len() - study.layout.results.len();
    let mut homeless: Vec<String> = Vec::new();
    let found = measures(&summary, &ran.prepared.motion, study.file.without_contact);
    for named in found {
        // Peaks up to a failure are not peaks of the whole case.
        let known_anyway = matches!(&named.name[..], "pga_m_s2")
            || named.name.ends_with(".width_m")
            || named.name.ends_with("_t1_m_s2")
            || named.name.ends_with(".period_s");
        if row.status == Status::Failed && !known_anyway {
            continue;
        }
        match study.layout.place(&named.name) {
            Some(place) => row.numbers[offset + place] = named.value,
            None => homeless.push(named.name),
        }
    }
    if row.reason.is_empty() {
        row.reason = summary.warnings.join("; ");
    }
    if !homeless.is_empty() {
        let more = format!("without a column: {}", homeless.join(", "));
        row.reason = if row.reason.is_empty() {
            more
        } else {
            format!("{}; {more}", row.reason)
        };
    }
    row
}
