//! `jostle motion convert`: reads any format, processes the motion and writes AT2 or CSV.

use std::path::Path;

use jostle_io::Dimension;
use jostle_run::{Processing, motion_in_short};

use super::args::ConvertArgs;
use super::source::{quantity, write};
use crate::failure::Failure;
use crate::terminal;

pub(super) fn convert(args: &ConvertArgs) -> Result<(), Failure> {
    let source = args.record.open()?;
    let motion = args.processing()?.apply(source.motion)?;
    // One of them is required.
    let out = args
        .out
        .as_deref()
        .or(args.output.as_deref())
        .unwrap_or(Path::new(""));
    write(out, args.force, &source.name, &motion)?;
    let line = motion_in_short(&motion);
    terminal::print(&format!("{}: {line}", out.display()))
}

impl ConvertArgs {
    fn processing(&self) -> Result<Processing, Failure> {
        let optional = |option: &str, text: &Option<String>, dimension| {
            text.as_ref()
                .map(|text| quantity(option, text, dimension))
                .transpose()
        };
        let time = |option: &str, text: &Option<String>| optional(option, text, Dimension::Time);
        let frequency =
            |option: &str, text: &Option<String>| optional(option, text, Dimension::Frequency);
        Ok(Processing {
            from: time("--from", &self.from)?,
            to: time("--to", &self.to)?,
            detrend: self.detrend,
            detrend_velocity: self.detrend_velocity,
            high_pass: frequency("--high-pass", &self.high_pass)?,
            low_pass: frequency("--low-pass", &self.low_pass)?,
            order: self.order,
            resample: time("--resample", &self.resample)?,
            pad_before: time("--pad-before", &self.pad_before)?,
            pad_after: time("--pad-after", &self.pad_after)?,
            at_rest: self.at_rest,
            scale: optional("--scale", &self.scale, Dimension::Dimensionless)?,
            pga: optional("--pga", &self.pga, Dimension::Acceleration)?,
        })
    }
}
