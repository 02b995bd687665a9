//! Findings of checks, line by line.

use std::fmt::Write;

use jostle::results::summary::{Finding, Grade};
use jostle_io::in_shown_units;

use crate::style::{DIM, LOUD, styled};

/// Findings that a terminal shows at most.
const SHOWN: usize = 3;

/// The findings for a terminal: at most three notes and warnings, worst first. `rest`: where the others are.
///
/// # Errors
/// As the text that is written to.
pub fn write_findings(text: &mut impl Write, findings: &[Finding], rest: &str) -> std::fmt::Result {
    let shown = findings
        .iter()
        .filter(|finding| finding.grade >= Grade::Note);
    for finding in shown.clone().take(SHOWN) {
        writeln!(text, "{}", line(finding))?;
    }
    let more = shown.count().saturating_sub(SHOWN);
    if more > 0 {
        writeln!(text, "  … and {more} more in {rest}")?;
    }
    Ok(())
}

/// One finding with its remedy, for `jostle check`.
#[must_use]
pub fn finding_with_remedy(finding: &Finding) -> String {
    format!(
        "{}\n  {}",
        line(finding),
        styled(DIM, &in_shown_units(finding.remedy))
    )
}

fn line(finding: &Finding) -> String {
    let style = match finding.grade {
        Grade::Warning => LOUD,
        Grade::Note | Grade::Remark => DIM,
    };
    let label = format!("{}:", finding.grade.word());
    format!(
        "{} {} ({})",
        styled(style, &label),
        in_shown_units(&finding.text),
        finding.id
    )
}
