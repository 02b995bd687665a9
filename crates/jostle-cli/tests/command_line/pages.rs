//! What README and pages show is what the program prints. `docs/commands --write` and `docs/numbers` bring them up to date.
//!
//! The commands of the pages use bash, sed and cut as Linux has them, and the scripts Python.
#![cfg(target_os = "linux")]

use std::path::Path;
use std::process::Command;

/// Runs a script of `docs` with the program under test; what it complains about is the failure.
fn check(script: &str, more: &[&str]) {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("../..");
    let python = Command::new("python3")
        .args(["-c", "import sys; sys.exit(sys.version_info < (3, 10))"])
        .status();
    if !python.is_ok_and(|status| status.success()) {
        // Without Python 3.10 there is nothing to run the scripts with.
        return;
    }
    let output = Command::new("python3")
        .arg(root.join("docs").join(script))
        .arg("--check")
        .args(more)
        .env("JOSTLE", env!("CARGO_BIN_EXE_jostle"))
        .output()
        .expect("the script starts");
    assert!(
        output.status.success(),
        "{}{}",
        String::from_utf8_lossy(&output.stdout),
        String::from_utf8_lossy(&output.stderr)
    );
}

#[test]
fn pages_show_what_commands_print() {
    check("commands", &["--quick"]);
}

#[test]
fn pages_show_the_numbers_on_record() {
    check("numbers", &[]);
}
