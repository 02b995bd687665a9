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
    /// What is wrong.
    pub problem: String,
    /// What to do about it.
    pub remedy: Option<String>,
}

/// Every fault of an input file. Displays them all, each with its line, and ends with their count.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct InputError {
    /// Name of the file.
    pub name: String,
    /// The faults in the order of the file, never empty.
    pub faults: Vec<Fault>,
}

/// Faults shown at most; the count at the end tells how many there are.
const SHOWN: usize = 100;

/// Longest part of a source line shown \[characters\].
const WIDTH: usize = 120;

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
        }
    }
}

impl std::error::Error for InputError {}

impl fmt::Display for InputError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        for fault in self.faults.iter().take(SHOWN) {
            write_fault(f, &self.name, fault)?;
        }
        if let Some(hidden @ 1..) = self.faults.len().checked_sub(SHOWN) {
            writeln!(f, "… and {hidden} more")?;
        }
        let plural = if self.faults.len() == 1 { "" } else { "s" };
        write!(f, "{} fault{plural} in {}", self.faults.len(), self.name)
    }
}

fn write_fault(f: &mut fmt::Formatter<'_>, name: &str, fault: &Fault) -> fmt::Result {
    write!(f, "{name}")?;
    if let Some(place) = &fault.place {
        write!(f, ":{}:{}", place.line, place.column)?;
    }
    if !fault.path.is_empty() {
        write!(f, ": {}", fault.path)?;
    }
    writeln!(f, ": {}", fault.problem)?;
    if let Some(place) = &fault.place {
        write_line(f, place)?;
    }
    match &fault.remedy {
        Some(remedy) => writeln!(f, "  help: {remedy}\n"),
        None => writeln!(f),
    }
}

/// The line and a caret below the offending part; a long line is cut around it.
fn write_line(f: &mut fmt::Formatter<'_>, place: &Place) -> fmt::Result {
    let column = place.column - 1;
    let cut = if column + place.length.min(WIDTH / 2) > WIDTH {
        column.saturating_sub(WIDTH / 4)
    } else {
        0
    };
    let shown: String = place
        .text
        .chars()
        .skip(cut)
        .take(WIDTH)
        .map(|c| match c {
            '\t' => ' ',
            c if c.is_control() => '\u{fffd}',
            c => c,
        })
        .collect();
    let margin = " ".repeat(place.line.to_string().len());
    let carets = place.length.min(WIDTH.saturating_sub(column - cut).max(1));
    writeln!(f, "  {} | {}", place.line, shown.trim_end())?;
    writeln!(
        f,
        "  {margin} | {}{}",
        " ".repeat(column - cut),
        "^".repeat(carets)
    )
}
