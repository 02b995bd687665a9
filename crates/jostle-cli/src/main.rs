//! Command line of jostle: parse, do, say how it went.

mod args;
mod check;
mod failure;
mod method;
mod modes;
mod numbers;
mod open;
mod run;
mod run_text;
mod starter;
mod terminal;

use std::process::ExitCode;

use clap::Parser;

use args::{Args, Command};

fn main() -> ExitCode {
    let done = match Args::parse().command {
        Command::Run(args) => run::run(&args),
        Command::Check(args) => check::check(&args),
        Command::Modes(args) => modes::modes(&args),
        Command::Method(args) => method::method(&args),
        Command::New(args) => starter::new(&args),
        Command::Schema => terminal::print(&jostle_io::model_schema()),
    };
    match done {
        Ok(()) => ExitCode::SUCCESS,
        Err(failure) => failure.report(),
    }
}
