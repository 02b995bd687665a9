//! Least gaps of the codes that a model names, in the summary of a run.

use std::fmt::Write;

use jostle::Model;
use jostle::separation::{Requirement, Requirements};
use jostle_io::shown::LENGTH;
use jostle_report::rows_of_rules;

/// Whether a gap is the moat of an isolated building, of which no code asks a width.
pub(crate) fn is_moat(model: &Model, gap: usize) -> bool {
    let sides = model.buildings_beside(model.gaps[gap].between);
    let isolated = |index: usize| model.buildings[index].base.isolation.is_some();
    matches!(sides, [Some(own), None] | [None, Some(own)] if isolated(own))
}

/// The least gaps of the codes that the model names, by the same rules as `jostle gap` and the report, with those left out and why;
/// whether they are less than what the run computed comes first.
pub(crate) fn write_codes(
    text: &mut String,
    required: &Requirements,
    computed: Option<f64>,
    has_impacts: bool,
) -> std::fmt::Result {
    let rules = required.rules.iter().filter(|rule| rule.code.is_some());
    let rules: Vec<&Requirement> = rules.collect();
    // Codes mean displacements without contact.
    if has_impacts {
        return writeln!(
            text,
            "  Minimum by codes: not known without the run without contact, which was left out; see jostle gap."
        );
    }
    let rows = rows_of_rules(&rules, |rule| (&rule.name, rule.width));
    let short = rows
        .iter()
        .filter(|(_, rule)| computed.is_some_and(|computed| rule.width < computed));
    let short: Vec<&str> = short.map(|(name, _)| &**name).collect();
    if let (Some(computed), false) = (computed, short.is_empty()) {
        let codes = short.join("; ");
        let computed = LENGTH.text(computed, 1);
        let (minimum, are) = match short.len() {
            1 => ("minimum gap", "is"),
            _ => ("minimum gaps", "are"),
        };
        writeln!(
            text,
            "  The {minimum} by {codes} {are} less than the {computed} computed."
        )?;
    }
    let widths = rows.iter();
    let widths = widths.map(|(name, rule)| format!("{name}: {}", LENGTH.rounded_up(rule.width)));
    let widths: Vec<String> = widths.collect();
    if !widths.is_empty() {
        write_list(
            text,
            &format!("  Minimum by codes [{}]: ", LENGTH.name()),
            &widths,
        )?;
    }
    let left_out = required.left_out.iter();
    let left_out = left_out.map(|rule| format!("{} needs {}", rule.name, rule.needs));
    let left_out: Vec<String> = left_out.collect();
    if !left_out.is_empty() {
        write_list(text, "  Left out: ", &left_out)?;
    }
    Ok(())
}

/// Widest line of a list \[characters\].
const WIDTH: usize = 120;

/// A list between commas, in lines that begin below each other.
fn write_list(text: &mut String, heading: &str, items: &[String]) -> std::fmt::Result {
    let mut line = heading.to_owned();
    for (index, item) in items.iter().enumerate() {
        let item = match index + 1 == items.len() {
            true => format!("{item}."),
            false => format!("{item}; "),
        };
        if line.trim_end() != heading.trim_end()
            && line.chars().count() + item.chars().count() > WIDTH
        {
            writeln!(text, "{}", line.trim_end())?;
            line = "    ".to_owned();
        }
        line += &item;
    }
    writeln!(text, "{line}")
}
