//! `jostle motion select`: whether a set of motions is suitable for time-history analysis.

use std::fmt::Write;

use jostle_io::Dimension;
use jostle_motion::SelectionCheck;
use jostle_run::{FileKind, NamedMotion, Selection, SelectionRequest};

use super::args::SelectArgs;
use super::source::{open, quantities, quantity};
use crate::failure::Failure;
use crate::replace::Target;
use crate::terminal;

pub(super) fn select(args: &SelectArgs) -> Result<(), Failure> {
    let page = Target::of_option(args.html.as_ref(), FileKind::REPORT, args.force)?;
    let selection = Selection::new(args.target.open()?, args.request()?)?;
    if let Some(file) = &page {
        file.write(&selection.page()?)?;
    }
    if args.json {
        terminal::print(&format!("{:#}", selection.json()))?;
        return verdict(&selection.check);
    }
    let mut text = selection.text();
    if let Some(path) = &args.html {
        // Writing to a string cannot fail.
        let _ = writeln!(text, "\n{}", path.display());
    }
    terminal::print(&text)?;
    verdict(&selection.check)
}

impl SelectArgs {
    fn request(&self) -> Result<SelectionRequest, Failure> {
        let read = |names: &[String]| -> Result<Vec<NamedMotion>, Failure> {
            names.iter().map(|name| open(name)).collect()
        };
        let pga = self.pga.as_ref();
        let pga = pga.map(|text| quantity("--pga", text, Dimension::Acceleration));
        Ok(SelectionRequest {
            damping: quantity("--damping", &self.damping, Dimension::Dimensionless)?,
            pga: pga.transpose()?,
            unscaled: self.unscaled,
            periods: quantities("--periods", &self.periods, Dimension::Time)?,
            mass_ratios: quantities("--mass-ratios", &self.mass_ratios, Dimension::Dimensionless)?,
            natural: read(&self.natural)?,
            artificial: read(&self.artificial)?,
        })
    }
}

/// A set that does not meet its code gives the exit code of a failed analysis.
fn verdict(check: &SelectionCheck) -> Result<(), Failure> {
    if check.passes() {
        return Ok(());
    }
    let unmet = check.rules.iter().filter(|rule| !rule.met).count();
    Err(Failure::Analysis(format!(
        "the set fails {unmet} of {} rules of {}",
        check.rules.len(),
        check.code.clause()
    )))
}
