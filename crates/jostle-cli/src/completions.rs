//! `jostle completions`: commands and options for the Tab key.

use clap::CommandFactory;

use crate::args::{Args, CompletionsArgs};
use crate::failure::Failure;
use crate::terminal;

pub(crate) fn completions(args: &CompletionsArgs) -> Result<(), Failure> {
    let mut script = Vec::new();
    clap_complete::generate(args.shell, &mut Args::command(), "jostle", &mut script);
    terminal::print(&String::from_utf8_lossy(&script))
}
