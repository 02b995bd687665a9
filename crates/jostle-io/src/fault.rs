//! Faults of an input file, each with its place, the offending line and a remedy.

use std::fmt;

use crate::source::Place;

/// One fault of an input file.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Fault {
    /// The field, spelt as in the file: `building[0].storey_height`; empty for the file as a whole.
    pub path: String,
    /// Where; `None` when the fault belongs to no line.
    pub place: Option<Place>,
    /// The problem.
    pub problem: String,
    /// Remedy.
    pub remedy: Option<String>,
}

/// Every fault of an input file. Displays them all, each with its line, and ends with their count.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct InputError {
    /// Name of the file.
    pub name: String,
    /// The faults in the order of the file, never empty.
    pub faults: Vec<Fault>,
    /// Number of further faults, of a file that has hundreds.
    pub more: usize,
}

impl InputError {
    /// An error without place: the file as a whole.
    pub(crate) fn whole(name: &str, problem: impl Into<String>, remedy: Option<String>) -> Self {
        Self {
            name: name.to_owned(),
            faults: vec![Fault {
                path: String::new(),
                place: None,
                problem: problem.into(),
                remedy,
            }],
            more: 0,
        }
    }
}

impl std::error::Error for InputError {}

impl fmt::Display for InputError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        if let [fault] = &self.faults[..]
            && fault.place.is_none()
            && fault.path.is_empty()
            && self.more == 0
        {
            // The file as a whole.
            return match &fault.remedy {
                Some(remedy) => write!(f, "{}\n  help: {remedy}", headline(&self.name, fault)),
                None => f.write_str(&headline(&self.name, fault)),
            };
        }
        for fault in &self.faults {
            write_fault(f, &self.name, fault)?;
        }
        if self.more > 0 {
            writeln!(f, "… and {} more", self.more)?;
        }
        let count = self.faults.len() + self.more;
        let plural = if count == 1 { "" } else { "s" };
        write!(f, "{count} fault{plural} in {}", self.name)
    }
}

/// The file with line and column, the field and the problem.
fn headline(name: &str, fault: &Fault) -> String {
    let place = fault.place.as_ref();
    let place = place.map_or_else(String::new, |at| format!(":{}:{}", at.line, at.column));
    let path = match fault.path.is_empty() {
        true => String::new(),
        false => format!(": {}", fault.path),
    };
    format!("{name}{place}{path}: {}", fault.problem)
}

fn write_fault(f: &mut fmt::Formatter<'_>, name: &str, fault: &Fault) -> fmt::Result {
    writeln!(f, "{}", headline(name, fault))?;
    if let Some(place) = &fault.place {
        write_line(f, place)?;
    }
    match &fault.remedy {
        Some(remedy) => writeln!(f, "  help: {remedy}\n"),
        None => writeln!(f),
    }
}

/// The line and a caret below the offending part.
fn write_line(f: &mut fmt::Formatter<'_>, place: &Place) -> fmt::Result {
    let shown: String = place
        .text
        .chars()
        .map(|c| match c {
            '\t' => ' ',
            c if c.is_control() => '\u{fffd}',
            c => c,
        })
        .collect();
    let shown = shown.trim_end();
    let indent = place.column.saturating_sub(1 + place.skipped);
    let room = shown.chars().count().saturating_sub(indent).max(1);
    let margin = " ".repeat(place.line.to_string().len());
    writeln!(f, "  {} | {shown}", place.line)?;
    writeln!(
        f,
        "  {margin} | {}{}",
        " ".repeat(indent),
        "^".repeat(place.length.min(room))
    )
}
