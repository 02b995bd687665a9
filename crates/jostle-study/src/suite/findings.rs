//! Checks that records of a suite did not pass, each once.

use jostle::judgement::CHECKS;
use jostle::results::summary::{Finding, Grade};
use serde_json::Value;

use super::quantities::list;
use super::results::RecordResult;

/// Speaks of the number of records, of which the rule of the suite speaks itself.
const NUMBER_OF_RECORDS: &str = "A12";

/// A finding of one record.
struct Found<'a> {
    finding: Finding,
    motion: &'a str,
    /// How far it is beyond its limit, as a logarithm \[–\].
    beyond: f64,
}

/// Findings of all records, those of one check at one place as the most severe of them; the most severe first.
pub(super) fn findings(records: &[RecordResult]) -> Vec<Finding> {
    let all: Vec<Found<'_>> = records.iter().flat_map(of_record).collect();
    let mut merged: Vec<Finding> = Vec::new();
    for found in &all {
        let is_same = |finding: &Finding| {
            finding.name == found.finding.name && finding.place == found.finding.place
        };
        if merged.iter().any(is_same) {
            continue;
        }
        let same: Vec<&Found<'_>> = all.iter().filter(|other| is_same(&other.finding)).collect();
        let mut worst = same[0];
        for other in &same[1..] {
            let order = other.finding.grade.cmp(&worst.finding.grade);
            if order.then(other.beyond.total_cmp(&worst.beyond)).is_gt() {
                worst = other;
            }
        }
        let mut finding = worst.finding.clone();
        let differ = same.iter().any(|other| other.finding.text != finding.text);
        // What is said of a record names it.
        let is_named = same.len() == 1 && finding.text.contains(worst.motion);
        if !is_named && (differ || same.len() < records.len()) {
            let (count, of) = (same.len(), records.len());
            finding.text += &format!(" ({}; in {count} of {of} records)", worst.motion);
        }
        merged.push(finding);
    }
    merged.sort_by_key(|finding| std::cmp::Reverse(finding.grade));
    merged
}

fn of_record(record: &RecordResult) -> impl Iterator<Item = Found<'_>> {
    let checks = list(&record.summary, "checks");
    checks.filter_map(|check| {
        let finding = read(check).filter(|finding| finding.id != NUMBER_OF_RECORDS)?;
        let beyond = libm::log((finding.value / finding.limit).abs()).abs();
        Some(Found {
            finding,
            motion: record.motion(),
            beyond: if beyond.is_finite() { beyond } else { 0.0 },
        })
    })
}

/// A finding of a `summary.json`; `None` for a check that this version does not know.
fn read(check: &Value) -> Option<Finding> {
    let text = |key: &str| check[key].as_str();
    let known = CHECKS
        .iter()
        .find(|known| Some(known.id) == text("id") && Some(known.name) == text("name"))?;
    let grade = [Grade::Remark, Grade::Note, Grade::Warning]
        .into_iter()
        .find(|grade| Some(grade.word()) == text("grade"))?;
    Some(Finding {
        id: known.id,
        name: known.name,
        grade,
        value: check["value"].as_f64().unwrap_or(f64::NAN),
        limit: check["limit"].as_f64().unwrap_or(f64::NAN),
        unit: known.unit,
        place: text("where").unwrap_or_default().to_owned(),
        text: text("text")?.to_owned(),
        remedy: known.remedy,
    })
}

#[cfg(test)]
mod tests {
    use serde_json::json;

    use super::*;
    use crate::suite::results::RecordStatus;

    fn record(motion: &str, checks: Value) -> RecordResult {
        RecordResult {
            label: motion.into(),
            folder: motion.into(),
            status: RecordStatus::Completed,
            reason: None,
            summary: json!({"motion": {"name": motion}, "checks": checks}),
            text: String::new(),
        }
    }

    fn check(name: &str, grade: &str, value: f64, place: &str) -> Value {
        let known = CHECKS.iter().find(|known| known.name == name);
        let id = known.expect("a check").id;
        json!({"id": id, "name": name, "grade": grade, "value": value, "limit": 1.0, "where": place,
            "text": format!("{place} {value}"), "unit": "–", "remedy": ""})
    }

    /// What all records say alike is said once; else the worst of them, with its record and their number.
    #[test]
    fn every_finding_is_said_once_by_its_worst_record() {
        let drift = "drift";
        let records = [
            record(
                "a",
                json!([
                    check(drift, "note", 2.0, "J1"),
                    check("records", "note", 1.0, "")
                ]),
            ),
            record(
                "b",
                json!([
                    check(drift, "note", 3.0, "J1"),
                    check(drift, "warning", 9.0, "J2")
                ]),
            ),
            record("c", json!([check("modal-damping", "remark", 1.5, "J1")])),
        ];
        let texts: Vec<String> = findings(&records).into_iter().map(|f| f.text).collect();
        assert_eq!(
            texts,
            [
                "J2 9 (b; in 1 of 3 records)",
                "J1 3 (b; in 2 of 3 records)",
                "J1 1.5 (c; in 1 of 3 records)"
            ]
        );
        let alike = [0, 1].map(|_| record("a", json!([check(drift, "note", 2.0, "J1")])));
        assert_eq!(findings(&alike)[0].text, "J1 2");
    }
}
