//! `jostle import opensees`: what is missing is said. Models are read in the tests of the Python package.
#![cfg(unix)]
#![allow(
    clippy::unwrap_used,
    reason = "a test stops at the first surprise, helpers included"
)]

use std::os::unix::fs::PermissionsExt;

use crate::common::{command, complained, folder, printed};

#[test]
fn python_and_packages_that_are_missing_are_named() {
    let folder = folder();
    let run = |python: &str| {
        command(
            folder.path(),
            &["import", "opensees", "frame.py", "--to", "a.toml"],
        )
        .env("JOSTLE_PYTHON", python)
        .output()
        .unwrap()
    };
    let absent = run("/nowhere/python3");
    assert_eq!(absent.status.code(), Some(2));
    let said = complained(&absent);
    assert!(
        said.contains("/nowhere/python3 was not found") && said.contains("JOSTLE_PYTHON"),
        "{said}"
    );
    let script = |text: &str| {
        let path = folder.path().join("python");
        std::fs::write(&path, format!("#!/bin/sh\n{text}\n")).unwrap();
        std::fs::set_permissions(&path, std::fs::Permissions::from_mode(0o755)).unwrap();
        path.display().to_string()
    };
    let python = script("echo \"ModuleNotFoundError: No module named 'jostle'\" >&2; exit 1");
    let said = complained(&run(&python));
    assert!(
        said.contains("No module named 'jostle'")
            && said.contains("-m pip install jostle openseespy"),
        "{said}"
    );
    // Its own message, and its exit code.
    let python = script("[ \"$1\" = -c ] && exit 0; echo \"error: $*\" >&2; exit 2");
    let refused = run(&python);
    assert_eq!(refused.status.code(), Some(2));
    let said = complained(&refused);
    assert!(said.contains("error: -m jostle._opensees_file frame.py --to a.toml --direction x --side right --units=N, m"), "{said}");
    let python = script(
        "[ \"$1\" = -c ] && exit 0; echo 'written: a.toml'; echo 'warning: tangent' >&2; echo 'Process 0 Terminating' >&2",
    );
    let done = run(&python);
    assert!(done.status.success());
    assert_eq!(printed(&done), "written: a.toml\n");
    assert_eq!(complained(&done), "warning: tangent\n");
}
