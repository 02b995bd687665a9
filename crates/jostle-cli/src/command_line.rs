//! Commands and their arguments, as typed.

use std::ffi::OsString;
use std::io::Write as _;

use clap::error::ContextKind;
use clap::{Parser, Subcommand};

use crate::args::{
    CheckArgs, CollideArgs, CompletionsArgs, MethodArgs, ModesArgs, NewArgs, PushoverArgs, RunArgs,
    SchemaArgs, SectionArgs,
};
use crate::terminal;

/// Simulates neighbouring buildings that hit each other during an earthquake.
#[derive(Debug, Parser)]
#[command(
    name = "jostle",
    version,
    long_version = jostle_report::version(),
    about = "Simulates neighbouring buildings that hit each other during an earthquake",
    after_help = "Quantities carry units: --pga 220cm/s2, --pga 0.35g, --gap 100mm.\n\
                  Exit codes: 0 done, 1 the analysis failed or a set of motions does not meet its code,\n\
                  2 the input is wrong, 130 stopped by Ctrl-C."
)]
pub(crate) struct Args {
    #[command(subcommand)]
    pub(crate) command: Command,
    /// Units of texts and pages: si for mm and kN, us for in and kip; by default those of the model
    #[arg(long, global = true, value_name = "SYSTEM", value_parser = ["si", "us"])]
    pub(crate) units: Option<String>,
}

impl Args {
    /// Parses the arguments, or prints the error (or the help for `--help`) and returns the exit code.
    pub(crate) fn from_arguments(
        arguments: impl IntoIterator<Item = OsString>,
    ) -> Result<Self, u8> {
        Self::try_parse_from(arguments).map_err(|mut error| {
            // A code that is spelt similarly is that of another country.
            let option = error.get(ContextKind::InvalidArg).map(ToString::to_string);
            if option.is_some_and(|option| option.starts_with("--code")) {
                error.remove(ContextKind::SuggestedValue);
            }
            let printed = error.print().and_then(|()| std::io::stdout().flush());
            match terminal::unless_gone(printed) {
                Err(failure) if !error.use_stderr() => crate::report(failure),
                _ => u8::try_from(error.exit_code()).unwrap_or(2),
            }
        })
    }
}

#[derive(Debug, Subcommand)]
pub(crate) enum Command {
    /// Analyse a model and write summary, histories, impacts and a report
    Run(RunArgs),
    /// Check a model and print masses, periods, contacts and expected work, without running it
    Check(CheckArgs),
    /// Print natural periods, participation and mode shapes
    Modes(ModesArgs),
    /// Collide two free masses under one contact law, or under all laws
    Collide(Box<CollideArgs>),
    /// Run a model with the recorded motion of a shake table and compare it with the measurements
    Compare(crate::compare::CompareArgs),
    /// Estimate contact stiffness and restitution from slabs, material and colliding masses
    ContactAdvice(Box<crate::contact_advice::ContactAdviceArgs>),
    /// Write the model as a script for another program, to compare results
    Export(crate::export::ExportArgs),
    /// Convert files of another program to a model file
    #[command(subcommand)]
    Import(Box<crate::import::ImportCommand>),
    /// Print how accurate each solver formulation is on your model
    Method(MethodArgs),
    /// Compute cracking and yield of reinforced-concrete sections, by formulas and by fibre analysis
    Section(SectionArgs),
    /// Find which neighbouring buildings of a city collide, from footprints to a map
    #[command(subcommand)]
    City(Box<crate::city::CityCommand>),
    /// Show, convert, generate and select ground motions
    #[command(subcommand)]
    Motion(Box<crate::motion::MotionCommand>),
    /// Run many cases of one model; any key of the model file can vary
    Study(crate::study::StudyArgs),
    /// Compute fragility of building classes (HAZUS, GEM) with and without pounding
    Classes(crate::classes::ClassesArgs),
    /// Find the gap needed to avoid pounding, and compare it with rules and codes
    Gap(crate::gap::GapArgs),
    /// Find the smallest damper, gap or other input that meets given conditions, such as no impact
    Size(Box<crate::size::SizeArgs>),
    /// Open a local page that runs the model after every change
    Live(crate::live::LiveArgs),
    /// Serve check, run, gap, study, explain and schema to an assistant, with the Model Context Protocol over standard input and output
    Mcp(crate::mcp::McpArgs),
    /// Run a pushover analysis to a target drift or loss of strength
    Pushover(PushoverArgs),
    /// Write a commented starter file
    New(NewArgs),
    /// Print the JSON Schema of model files, or a page that explains every key
    Schema(SchemaArgs),
    /// Print a script that completes commands and options in a shell
    Completions(CompletionsArgs),
    /// Write manual pages for `man`
    Man(crate::man::ManArgs),
}
