//! `jostle export`: the model as a script for another program.

use std::path::PathBuf;

use jostle_export::{Export, openseespy};
use jostle_run::{FileKind, may_write};

use crate::args::ModelArgs;
use crate::failure::Failure;
use crate::terminal;

/// Model and target program.
#[derive(Debug, clap::Args)]
pub(crate) struct ExportArgs {
    #[command(flatten)]
    model: ModelArgs,
    /// Program to write for
    #[arg(long, value_enum)]
    to: Target,
    /// File to write; without it, the script is printed
    #[arg(short, long, value_name = "FILE")]
    output: Option<PathBuf>,
    /// Replace the file even if jostle did not write it
    #[arg(long, requires = "output")]
    force: bool,
}

/// First lines of every script.
const SCRIPT: FileKind = FileKind {
    name: "script that jostle exported",
    marks: &[
        "#!/usr/bin/env python3",
        "# The same model for OpenSeesPy, written by jostle ",
    ],
};

/// Programs that models can be exported to.
#[derive(Clone, Copy, Debug, PartialEq, Eq, clap::ValueEnum)]
enum Target {
    /// A Python script for OpenSeesPy
    Openseespy,
}

pub(crate) fn export(args: &ExportArgs) -> Result<(), Failure> {
    let replaces = match &args.output {
        Some(path) => may_write(path, Some(SCRIPT), args.force)?,
        None => false,
    };
    let opened = args.model.open()?;
    let (motion, _) = opened.plan()?;
    let export = Export {
        model: &opened.input.model,
        system: &opened.system,
        motion: &motion,
    };
    let exported = match args.to {
        Target::Openseespy => openseespy::export(&export),
    };
    let exported = exported.map_err(|faults| opened.input.faults(faults))?;
    for remark in &exported.remarks {
        terminal::remark(&format!(
            "{} {remark}",
            jostle_run::styled(jostle_run::LOUD, "difference:")
        ));
    }
    match &args.output {
        None => terminal::print(&exported.text),
        Some(path) => {
            jostle_io::write_atomically(path, exported.text.as_bytes())?;
            let done = if replaces { "replaced" } else { "written" };
            terminal::remark(&format!("{done}: {}", path.display()));
            Ok(())
        }
    }
}
