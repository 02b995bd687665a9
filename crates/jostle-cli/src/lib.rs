//! Command line of jostle: parses arguments, runs commands, reports results. The program itself is `bin/jostle`.

mod args;
mod check;
mod collide;
mod completions;
mod export;
mod failure;
mod gap;
mod live;
mod man;
mod method;
mod modes;
mod motion;
mod numbers;
mod open;
mod progress;
mod pushover;
mod pushover_text;
mod replace;
mod run;
mod run_text;
mod section;
mod starter;
mod study;
mod terminal;

use args::{Args, Command};

pub use collide::collisions;
pub use modes::modes_json;
pub use motion::spectrum_json;
pub use pushover::pushover_json;
pub use run_text::summary_text;

/// Refuses to replace a file that jostle did not write as a report; everything may be replaced with `force`.
///
/// # Errors
/// Why the file must stay.
pub fn may_replace_report(path: &std::path::Path, force: bool) -> Result<(), String> {
    let kind = replace::Kind::REPORT;
    let asked = replace::may_write(path, Some(kind), force);
    asked.map(drop).map_err(|failure| failure.to_string())
}

/// Refuses to replace files in a folder that are not results of a run, except with `force`.
///
/// # Errors
/// Which file must stay.
pub fn may_replace_run(folder: &std::path::Path, force: bool) -> Result<(), String> {
    let asked = run::replaced_by_a_run(folder, force);
    asked.map(drop).map_err(|failure| failure.to_string())
}

/// Runs the command given by the arguments, of which the first is the program name, and returns the exit code.
pub fn run(arguments: impl IntoIterator<Item = std::ffi::OsString>) -> u8 {
    let args = match Args::of(arguments) {
        Ok(args) => args,
        Err(code) => return code,
    };
    let done = match args.command {
        Command::Run(args) => run::run(&args),
        Command::Check(args) => check::check(&args),
        Command::Modes(args) => modes::modes(&args),
        Command::Collide(args) => collide::collide(&args),
        Command::Export(args) => export::export(&args),
        Command::Method(args) => method::method(&args),
        Command::Pushover(args) => pushover::pushover(&args),
        Command::Study(args) => study::study(&args),
        Command::Gap(args) => gap::gap(&args),
        Command::Live(args) => live::live(&args),
        Command::Motion(command) => motion::run(&command),
        Command::Section(args) => section::section(&args),
        Command::New(args) => starter::new(&args),
        Command::Completions(args) => completions::completions(&args),
        Command::Man(args) => man::man(&args),
        Command::Schema(args) => terminal::print(&if args.markdown {
            jostle_io::model_reference()
        } else {
            jostle_io::model_schema()
        }),
    };
    match done {
        Ok(()) => 0,
        Err(failure) => failure.report(),
    }
}
