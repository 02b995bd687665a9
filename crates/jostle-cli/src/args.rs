//! Arguments as typed.

use std::path::PathBuf;

use clap::{Parser, Subcommand};

/// What happens when neighbouring buildings hit each other in an earthquake.
#[derive(Debug, Parser)]
#[command(
    name = "jostle",
    version,
    about = "What happens when neighbouring buildings hit each other in an earthquake",
    after_help = "Quantities carry units: --pga 220cm/s2, --pga 0.35g, --gap 100mm.\n\
                  Exit codes: 0 done, 1 the analysis failed, 2 the input is wrong, 130 stopped by Ctrl-C."
)]
pub(crate) struct Args {
    #[command(subcommand)]
    pub(crate) command: Command,
}

#[derive(Debug, Subcommand)]
pub(crate) enum Command {
    /// Analyse a model and write summary, histories, impacts and a report
    Run(RunArgs),
    /// Validate a model and show what it amounts to, without running it
    Check(ModelArgs),
    /// Natural periods, participation and shapes
    Modes(ModesArgs),
    /// Size and accuracy of the step equations in every form, on your own buildings
    Method(MethodArgs),
    /// Write a commented starter file
    New(NewArgs),
    /// Print the JSON Schema of model files
    Schema,
}

/// A model, and what to change of it.
#[derive(Debug, clap::Args)]
pub(crate) struct ModelArgs {
    /// Model file (TOML or JSON), or the name of a built-in example; without it, the built-in "paper"
    pub(crate) model: Option<PathBuf>,
    /// Scale the motion to this peak ground acceleration
    #[arg(long, value_name = "QUANTITY")]
    pub(crate) pga: Option<String>,
    /// Width of every gap
    #[arg(long, value_name = "QUANTITY", allow_hyphen_values = true)]
    pub(crate) gap: Option<String>,
    /// Another ground motion: a built-in name or a file
    #[arg(long, value_name = "RECORD")]
    pub(crate) record: Option<String>,
}

#[derive(Debug, clap::Args)]
pub(crate) struct RunArgs {
    #[command(flatten)]
    pub(crate) model: ModelArgs,
    /// Folder for the results [default: jostle-out/MODEL; with --json, none]
    #[arg(long, value_name = "DIR")]
    pub(crate) out: Option<PathBuf>,
    /// Neither a report nor the second run without contact that it compares with
    #[arg(long)]
    pub(crate) no_report: bool,
    /// Print summary.json and nothing else
    #[arg(long)]
    pub(crate) json: bool,
    /// Run even where solver = "product" is expected to lose its digits
    #[arg(long)]
    pub(crate) force: bool,
}

#[derive(Debug, clap::Args)]
pub(crate) struct ModesArgs {
    /// Model file, or the name of a built-in example; without it, the built-in "paper"
    pub(crate) model: Option<PathBuf>,
    /// Modes to list for every building
    #[arg(long, default_value_t = 10, value_parser = clap::value_parser!(u32).range(1..=10_000))]
    pub(crate) count: u32,
    /// Print JSON and nothing else
    #[arg(long)]
    pub(crate) json: bool,
}

#[derive(Debug, clap::Args)]
pub(crate) struct MethodArgs {
    /// Model file, or the name of a built-in example; without it, the built-in "paper"
    pub(crate) model: Option<PathBuf>,
    /// Folder for a page with tables and plots, method.html
    #[arg(long, value_name = "DIR")]
    pub(crate) out: Option<PathBuf>,
}

#[derive(Debug, clap::Args)]
pub(crate) struct NewArgs {
    /// Name of the file to write; ".toml" is added when it has no extension
    pub(crate) name: PathBuf,
    /// What to start from
    #[arg(long, value_name = "TEMPLATE", default_value = jostle_io::TEMPLATE_NAMES[0], value_parser = jostle_io::TEMPLATE_NAMES)]
    pub(crate) template: String,
}
