//! What the checks found: assumptions and limits of the result.

use jostle::results::summary::{Finding, Grade};
use jostle_io::in_shown_units;
use maud::{Markup, html};

use crate::{Page, format, message};

/// The section on the first page.
pub(crate) fn section(page: &Page) -> Markup {
    let summary = page.summary;
    found(&summary.checks, &summary.silenced_checks, &summary.notes)
}

/// The section of these findings and notes.
pub(crate) fn found(checks: &[Finding], silenced: &[String], notes: &[String]) -> Markup {
    html! {
        section #checks.checks {
            h2 { (message::assumptions_and_limits()) }
            @if checks.is_empty() {
                p.quiet { (message::all_checks_are_passed()) }
            }
            @if !checks.is_empty() || !notes.is_empty() {
                ul {
                    @for finding in checks { (item(finding)) }
                    @for text in notes { (note(text)) }
                }
            }
            @if !silenced.is_empty() {
                p.quiet { (message::silenced_checks(silenced.join(", "))) }
            }
        }
    }
}

/// What the run says beside the checks.
fn note(text: &str) -> Markup {
    html! { li data-grade=(Grade::Note.word()) { b { (message::note()) } " " (format::capital(&in_shown_units(text))) } }
}

fn item(finding: &Finding) -> Markup {
    let grade = match finding.grade {
        Grade::Remark => message::remark(),
        Grade::Note => message::note(),
        Grade::Warning => message::warning(),
    };
    html! {
        li data-grade=(finding.grade.word()) {
            b { (grade) } " " (message::what_was_found(in_shown_units(&finding.text), finding.id)) " "
            span.quiet { (message::what_to_do(format::capital(&in_shown_units(finding.remedy)))) }
        }
    }
}
