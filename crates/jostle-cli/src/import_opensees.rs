//! `jostle import opensees`: a building by the matrices of an OpenSeesPy script, which Python runs.

use std::io::ErrorKind;
use std::path::PathBuf;
use std::process::Command;

use crate::failure::Failure;
use crate::terminal;

#[derive(Debug, clap::Args)]
#[command(
    after_help = "The script is a program and runs with your permissions. Data that are not imported are printed and listed in the model file.\n\
                  JOSTLE_PYTHON names the interpreter [default: python3]"
)]
pub(crate) struct ImportOpenseesArgs {
    /// OpenSeesPy script that builds the model
    script: PathBuf,
    /// Model file to write, .toml; the matrices are written next to it, .npz
    #[arg(long, value_name = "MODEL")]
    to: PathBuf,
    /// Name of the building [default: that of the script]
    #[arg(long)]
    name: Option<String>,
    /// Horizontal direction of the script along which the buildings are arranged
    #[arg(long, default_value = "x", value_parser = ["x", "y"])]
    direction: String,
    /// Side of the neighbour, for buildings without a plan
    #[arg(long, default_value = "right", value_parser = ["left", "right"])]
    side: String,
    /// Force and length units of the script, such as "kN, m" or "kip, in"; mass is force·s²/length
    #[arg(long, value_name = "UNITS", default_value = "N, m")]
    units: String,
    /// Node in contact, instead of the outermost node of a floor; repeat for every floor
    #[arg(long, value_name = "NODE")]
    port: Vec<u32>,
    /// Replace files that jostle did not write
    #[arg(long)]
    force: bool,
}

/// Module that does the work.
const MODULE: &str = "jostle._opensees_file";

pub(crate) fn import(args: &ImportOpenseesArgs) -> Result<(), Failure> {
    let python = std::env::var_os("JOSTLE_PYTHON").unwrap_or_else(|| "python3".into());
    let shown = python.to_string_lossy().into_owned();
    let missing = |error: std::io::Error| {
        let problem = match error.kind() {
            ErrorKind::NotFound => "was not found".to_owned(),
            _ => format!("cannot be started: {error}"),
        };
        Failure::Input(format!(
            "import opensees runs the script by Python, and {shown} {problem}; install Python 3.10 or later, or name it in JOSTLE_PYTHON"
        ))
    };
    // Python's own message for a missing module names neither package nor remedy.
    let found = Command::new(&python)
        .args(["-c", "import jostle._opensees"])
        .output()
        .map_err(missing)?;
    if !found.status.success() {
        let said = String::from_utf8_lossy(&found.stderr);
        let last = said
            .trim_end()
            .lines()
            .last()
            .unwrap_or_default()
            .to_owned();
        return Err(Failure::Input(format!(
            "import opensees needs the Python package of jostle, and {shown} cannot import it ({last}); \
             {shown} -m pip install jostle openseespy"
        )));
    }
    let mut command = Command::new(&python);
    command.args(["-m", MODULE]).arg(&args.script);
    command.arg("--to").arg(&args.to);
    command.args(["--direction", &args.direction, "--side", &args.side]);
    // A value that begins with a dash is no option.
    command.arg(format!("--units={}", args.units));
    if let Some(name) = &args.name {
        command.arg(format!("--name={name}"));
    }
    for node in &args.port {
        command.arg(format!("--port={node}"));
    }
    if args.force {
        command.arg("--force");
    }
    let done = command.output().map_err(missing)?;
    // OpenSees takes its leave on standard error.
    let said = String::from_utf8_lossy(&done.stderr);
    let said: Vec<&str> = said
        .lines()
        .filter(|line| !line.trim().is_empty() && !line.starts_with("Process 0 Terminating"))
        .collect();
    if done.status.success() {
        for line in said {
            terminal::remark(line);
        }
        return terminal::print(&String::from_utf8_lossy(&done.stdout));
    }
    let text = said.join("\n");
    match done.status.code() {
        Some(2) => Err(Failure::Input(
            text.strip_prefix("error: ").unwrap_or(&text).to_owned(),
        )),
        code => Err(Failure::Analysis(format!(
            "Python ended with {}:\n{text}",
            code.map_or_else(|| "a signal".to_owned(), |code| format!("exit code {code}"))
        ))),
    }
}
