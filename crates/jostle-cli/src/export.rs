//! `jostle export`: the model as a script for another program, or as matrices.

use std::path::PathBuf;

use jostle_run::{export_matrices, export_script, may_write_script};

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
    /// File for a script, or folder for matrices. Without a file, the script is printed
    #[arg(short, long, value_name = "FILE")]
    output: Option<PathBuf>,
    /// Replace the file even if jostle did not write it
    #[arg(long, requires = "output")]
    force: bool,
}

/// Programs that models can be exported to.
#[derive(Clone, Copy, Debug, PartialEq, Eq, clap::ValueEnum)]
enum Target {
    /// A Python script for OpenSeesPy
    Openseespy,
    /// NumPy archives with the matrices of every building, and a list of buildings for a model file
    Matrices,
}

pub(crate) fn export(args: &ExportArgs) -> Result<(), Failure> {
    match args.to {
        Target::Openseespy => script(args),
        Target::Matrices => archives(args),
    }
}

fn archives(args: &ExportArgs) -> Result<(), Failure> {
    let Some(folder) = &args.output else {
        return Err(Failure::Input(
            "--to matrices writes several files: add --output FOLDER".to_owned(),
        ));
    };
    let opened = args.model.open()?;
    for path in export_matrices(&opened, folder, args.force)? {
        terminal::remark(&format!("written: {}", path.display()));
    }
    Ok(())
}

fn script(args: &ExportArgs) -> Result<(), Failure> {
    let replaces = match &args.output {
        Some(path) => may_write_script(path, args.force)?,
        None => false,
    };
    let exported = export_script(&args.model.open()?)?;
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
