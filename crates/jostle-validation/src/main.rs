//! Writes `docs/validation.md`, or only looks whether every number agrees.

use std::path::{Path, PathBuf};
use std::process::ExitCode;

use jostle_io::write_atomically;
use jostle_validation::{Extent, document, families, misses, paper};

const USAGE: &str = "\
usage: jostle-validation [--full] [--check] [--reference]
  --full        small steps as well; takes minutes
  --check       writes nothing; exits with 1 if a number misses
  --reference   makes the reference runs of the built-in model anew; takes minutes";

fn main() -> ExitCode {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    let asked = |option: &str| arguments.iter().any(|argument| argument == option);
    if let Some(unknown) = arguments
        .iter()
        .find(|a| !["--full", "--check", "--reference"].contains(&a.as_str()))
    {
        say(&format!("unknown option {unknown}\n{USAGE}"));
        return ExitCode::from(2);
    }
    if asked("--reference") {
        let reference =
            serde_json::to_string_pretty(&paper::reference()).unwrap_or_default() + "\n";
        return written(&in_crate("data/paper/reference.json"), &reference);
    }
    let extent = if asked("--full") {
        Extent::Full
    } else {
        Extent::Reduced
    };
    let families = families(extent);
    for (family, row) in misses(&families) {
        say(&document::missed_line(family, row));
    }
    let compared: usize = families.iter().map(|family| family.rows.len()).sum();
    say(&format!(
        "{compared} numbers compared, {} miss",
        misses(&families).count()
    ));
    let page = in_crate("../../docs/validation.md");
    if !asked("--check") && written(&page, &document::page(&families, extent)) == ExitCode::FAILURE
    {
        return ExitCode::FAILURE;
    }
    if misses(&families).next().is_some() {
        ExitCode::FAILURE
    } else {
        ExitCode::SUCCESS
    }
}

fn in_crate(path: &str) -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join(path)
}

fn written(path: &Path, text: &str) -> ExitCode {
    match write_atomically(path, text.as_bytes()) {
        Ok(()) => ExitCode::SUCCESS,
        Err(error) => {
            say(&error.to_string());
            ExitCode::FAILURE
        }
    }
}

#[allow(clippy::print_stderr, reason = "this is a command")]
fn say(text: &str) {
    eprintln!("{text}");
}
