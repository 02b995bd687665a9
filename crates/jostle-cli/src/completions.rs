//! `jostle completions`: a script that completes commands and options in a shell.

use crate::args::CompletionsArgs;
use crate::failure::Failure;
use crate::terminal;

pub(crate) fn completions(
    args: &CompletionsArgs,
    mut command: clap::Command,
) -> Result<(), Failure> {
    let mut script = Vec::new();
    clap_complete::generate(args.shell, &mut command, "jostle", &mut script);
    terminal::print(&String::from_utf8_lossy(&script))
}
