//! `jostle motion`: ground motions.

mod args;
mod convert;
mod list;
mod select;
mod show;
mod source;
mod spectrum;
mod synth;

pub(crate) use args::MotionCommand;

use crate::failure::Failure;

pub(crate) fn run(command: &MotionCommand) -> Result<(), Failure> {
    match command {
        MotionCommand::List => list::list(),
        MotionCommand::Show(args) => show::show(args),
        MotionCommand::Spectrum(args) => spectrum::spectrum(args),
        MotionCommand::Convert(args) => convert::convert(args),
        MotionCommand::Synth(command) => synth::synth(command),
        MotionCommand::Select(args) => select::select(args),
    }
}
