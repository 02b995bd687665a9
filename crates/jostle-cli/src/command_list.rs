//! All commands with their arguments, for programs that wrap this one.

use clap::{Arg, Command, CommandFactory};
use serde_json::{Value, json};

use crate::command_line::Args;

/// Every command as JSON: its name (`motion synth noise`), and the names of its options (`--pga`) and of what stands
/// without one (`MODEL`).
#[must_use]
pub fn command_list() -> Value {
    let mut list = Vec::new();
    collect(&Args::command(), "", &mut list);
    Value::Array(list)
}

fn collect(command: &Command, above: &str, list: &mut Vec<Value>) {
    for subcommand in command.get_subcommands() {
        let name = format!("{above} {}", subcommand.get_name())
            .trim()
            .to_owned();
        if subcommand.has_subcommands() {
            collect(subcommand, &name, list);
            continue;
        }
        let shown = |arg: &&Arg| arg.get_id() != "help";
        let arguments = subcommand
            .get_arguments()
            .filter(shown)
            .map(|arg| match arg.get_long() {
                Some(long) => format!("--{long}"),
                None => arg.get_id().as_str().to_uppercase(),
            });
        list.push(json!({ "command": name, "arguments": arguments.collect::<Vec<_>>() }));
    }
}
