//! `jostle motion convert`: reads any format, processes the motion and writes AT2 or CSV.

use jostle_io::Dimension;
use jostle_motion::{Accelerogram, Butterworth, butterworth};

use super::args::ConvertArgs;
use super::source::{in_short, quantity, write, wrong};
use crate::failure::Failure;
use crate::terminal;

pub(super) fn convert(args: &ConvertArgs) -> Result<(), Failure> {
    let source = args.record.open()?;
    let motion = processed(args, source.motion)?;
    write(&args.out, args.force, &source.name, &motion)?;
    terminal::print(&format!("{}: {}", args.out.display(), in_short(&motion)))
}

fn processed(args: &ConvertArgs, mut motion: Accelerogram) -> Result<Accelerogram, Failure> {
    let optional = |option: &str, text: &Option<String>, dimension| {
        text.as_ref()
            .map(|text| quantity(option, text, dimension))
            .transpose()
    };
    let time = |option: &str, text: &Option<String>| optional(option, text, Dimension::Time);
    let (from, to) = (time("--from", &args.from)?, time("--to", &args.to)?);
    if from.is_some() || to.is_some() {
        let end = to.unwrap_or(motion.duration());
        motion = motion.cut(from.unwrap_or(0.0), end).map_err(wrong)?;
    }
    if let Some(degree) = args.detrend {
        motion = motion.without_polynomial(degree).map_err(wrong)?;
    }
    if let Some(degree) = args.detrend_velocity {
        motion = motion.without_velocity_trend(degree).map_err(wrong)?;
    }
    let low = optional("--high-pass", &args.high_pass, Dimension::Frequency)?;
    let high = optional("--low-pass", &args.low_pass, Dimension::Frequency)?;
    if low.is_some() || high.is_some() {
        let order = args.order;
        motion = butterworth(&motion, &Butterworth { low, high, order }).map_err(wrong)?;
    }
    if let Some(step) = time("--resample", &args.resample)? {
        motion = motion.resampled(step).map_err(wrong)?;
    }
    let before = time("--pad-before", &args.pad_before)?;
    let after = time("--pad-after", &args.pad_after)?;
    if before.is_some() || after.is_some() {
        motion = motion
            .padded(before.unwrap_or(0.0), after.unwrap_or(0.0))
            .map_err(wrong)?;
    }
    if args.at_rest {
        motion = motion.ending_at_rest();
    }
    if let Some(factor) = optional("--scale", &args.scale, Dimension::Dimensionless)? {
        motion = motion.scaled(factor).map_err(wrong)?;
    }
    if let Some(pga) = optional("--pga", &args.pga, Dimension::Acceleration)? {
        if pga <= 0.0 {
            return Err(Failure::Input("--pga must be greater than zero".to_owned()));
        }
        motion = motion.scaled_to_peak(pga).map_err(wrong)?;
    }
    Ok(motion)
}
