//! Names the commit that is built, so that results and pages can say it. Builds for tests do without, because every commit would
//! compile them again.

#![allow(clippy::print_stdout, reason = "Cargo reads what is printed")]

use std::process::Command;

fn main() {
    println!("cargo:rerun-if-changed=build.rs");
    println!("cargo:rerun-if-env-changed=JOSTLE_BUILD");
    let given = std::env::var("JOSTLE_BUILD").ok();
    let is_release = std::env::var("PROFILE").is_ok_and(|profile| profile == "release");
    let commit = given.or_else(|| is_release.then(commit).flatten());
    println!(
        "cargo:rustc-env=JOSTLE_COMMIT={}",
        commit.unwrap_or_default()
    );
}

/// The commit of the clone, if this is one.
fn commit() -> Option<String> {
    let git = |arguments: &[&str]| {
        let output = Command::new("git").args(arguments).output().ok()?;
        let text = String::from_utf8(output.stdout).ok()?;
        output.status.success().then(|| text.trim().to_owned())
    };
    if let Some(log) = git(&["rev-parse", "--git-path", "logs/HEAD"]) {
        println!("cargo:rerun-if-changed={log}");
    }
    git(&[
        "describe",
        "--always",
        "--dirty",
        "--exclude",
        "*",
        "--abbrev=12",
    ])
}
