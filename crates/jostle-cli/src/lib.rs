//! Command line of jostle: parses arguments, runs commands, reports results. The program itself is `bin/jostle`.

mod args;
mod check;
mod city;
mod classes;
mod collide;
mod combinations;
mod command_line;
mod command_list;
mod compare;
mod completions;
mod contact_advice;
mod export;
mod failure;
mod gap;
mod import;
mod import_opensees;
mod live;
mod man;
mod mcp;
mod method;
mod modes;
mod motion;
mod open;
mod printer;
mod progress;
mod pushover;
mod pushover_text;
mod replace;
mod run;
mod section;
mod size;
mod starter;
mod stop;
mod study;
mod suite;
mod terminal;

pub use command_list::command_list;

use clap::{CommandFactory, Parser};
use command_line::{Args, Command};
use failure::Failure;
use jostle_io::{Units, shown};

/// Runs the command given by the arguments, of which the first is the program name, and returns the exit code.
pub fn run(arguments: impl IntoIterator<Item = std::ffi::OsString>) -> u8 {
    let args = match Args::from_arguments(arguments) {
        Ok(args) => args,
        Err(code) => return code,
    };
    let units = args.units.as_deref().and_then(Units::named);
    if let Some(units) = units {
        shown::choose_for_all_threads(units);
    }
    match shown::in_units(units, || run_command(args.command)) {
        Ok(()) => 0,
        Err(failure) => report(failure),
    }
}

fn run_command(command: Command) -> Result<(), Failure> {
    match command {
        Command::Run(args) => run::run(&args),
        Command::Check(args) => check::check(&args),
        Command::Modes(args) => modes::modes(&args),
        Command::City(command) => city::city(&command),
        Command::Collide(args) => collide::collide(&args),
        Command::Compare(args) => compare::compare(&args),
        Command::ContactAdvice(args) => contact_advice::contact_advice(&args),
        Command::Export(args) => export::export(&args),
        Command::Import(command) => import::import(&command),
        Command::Method(args) => method::method(&args),
        Command::Pushover(args) => pushover::pushover(&args),
        Command::Study(args) => study::study(&args),
        Command::Gap(args) => gap::gap(&args),
        Command::Live(args) => live::live(&args),
        Command::Mcp(args) => mcp::mcp(&args),
        Command::Motion(command) => motion::run(&command),
        Command::Classes(args) => classes::classes(&args),
        Command::Section(args) => section::section(&args),
        Command::Size(args) => size::size(&args),
        Command::New(args) => starter::new(&args),
        Command::Completions(args) => completions::completions(&args, Args::command()),
        Command::Man(args) => man::man(&args, Args::command()),
        Command::Schema(args) => terminal::print(&schema(args.list(), args.markdown)),
    }
}

/// What `jostle schema` describes.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Described {
    /// Keys of the model file.
    Model,
    /// Quantities of the results.
    Results,
    /// Checks.
    Checks,
    /// Kinds of building and their features, always in Markdown.
    Combinations,
}

/// The text of `jostle schema`: JSON, or a page in Markdown.
#[must_use]
pub fn schema(what: Described, markdown: bool) -> String {
    match (what, markdown) {
        (Described::Model, false) => jostle_io::model_schema(),
        (Described::Model, true) => jostle_io::model_reference(),
        (Described::Results, false) => jostle_io::quantity_list(),
        (Described::Results, true) => jostle_io::quantity_reference(),
        (Described::Checks, false) => jostle_io::check_list(),
        (Described::Checks, true) => jostle_io::check_reference(),
        (Described::Combinations, _) => combinations::table(),
    }
}

/// Imports files of ETABS or SAP2000 as `jostle import` does, with its arguments from the program on; returns what it prints.
///
/// # Errors
/// What is wrong with the arguments or the files.
pub fn import(arguments: impl IntoIterator<Item = String>) -> Result<String, String> {
    let words = ["jostle", "import"].map(str::to_owned);
    let args = Args::try_parse_from(words.into_iter().chain(arguments));
    match args.map_err(|error| error.to_string())?.command {
        Command::Import(command) => import::imported(&command)
            .map(|text| jostle_run::plain(&text))
            .map_err(|error| error.to_string()),
        _ => Err("expected a program to import from".to_owned()),
    }
}

/// Prints why a command failed and returns the exit code.
fn report(failure: Failure) -> u8 {
    match failure {
        Failure::Input(text) => {
            terminal::error(&text);
            2
        }
        Failure::Analysis(text) => {
            terminal::error(&text);
            1
        }
        Failure::Stopped => 130,
    }
}
