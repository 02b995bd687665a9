//! The part of a script that runs the analysis, with a stand-in for OpenSees that does not converge when it is told to.

use std::path::Path;
use std::process::{Command, Output};

use jostle::System;
use jostle_export::{Export, openseespy};
use jostle_io::{Format, read_model_text};

/// Hinges far stiffer than their members, under their own weight.
const MODEL: &str = r#"
title = "rigid hinges"
motion = { kind = "sine", amplitude = 1.0, period = 0.5, duration = 0.1 }
[[building]]
name = "frame"
kind = "frame"
storeys = 1
storey_height = 3.0
spans = [4.0]
column = { width = 0.4, depth = 0.4 }
beam = { width = 0.3, depth = 0.5 }
elastic_modulus = 3e10
beam_mass = 30000
gravity = true
hinges = { rule = "bilinear", initial = "rigid", column = { yield = 150e3, post_yield = 0.02 } }
"#;

/// Counts time and load; steps longer than LONGEST do not converge from BEGIN to END. `Transformation` does not take back
/// a step that failed, and nothing converges after it.
const STAND_IN: &str = r#"
import os
LONGEST, BEGIN, END = (float(os.environ[name]) for name in ("LONGEST", "BEGIN", "END"))
now, loaded, part, handler, spoilt = 0.0, 0.0, None, None, False

def constraints(name):
    global handler
    handler = name

def integrator(name, *arguments):
    global part
    part = arguments[0] if name == "LoadControl" else None

def analyze(count, step=None):
    global now, loaded, spoilt
    for _ in range(count):
        size = part if step is None else step
        where = loaded if step is None else now
        if spoilt or (BEGIN <= where < END and size > LONGEST):
            spoilt = handler == "Transformation"
            return -3
        if step is None:
            loaded += size
        else:
            now += size
    return 0

def loadConst(*arguments):
    assert abs(loaded - 1.0) < 1e-12, loaded

def getTime():
    return now

def recorder(kind, _, path, *arguments):
    with open(path, "w") as file:
        file.write("0\n" * 3)

def nodeDisp(*arguments):
    return 0.0

nodeVel = nodeDisp

def testIter():
    return 1

def systemSize():
    return 1

def version():
    return "stand-in"

def __getattr__(name):
    if name.startswith("__"):
        raise AttributeError(name)
    return lambda *arguments: 0
"#;

/// Runs the script of the model; `None` where there is no Python.
fn run(folder: &Path, longest: f64, [begin, end]: [f64; 2]) -> Option<Output> {
    let input = read_model_text("test", MODEL, Format::Toml, "".as_ref()).expect("a sound model");
    let system = System::assemble(&input.model).expect("sound");
    let exported = openseespy::export(&Export {
        model: &input.model,
        system: &system,
        motion: &input.ground_motion().expect("a motion"),
    });
    let script = folder.join("model.py");
    std::fs::write(&script, exported.expect("it can be exported").text).expect("written");
    let package = folder.join("openseespy");
    std::fs::create_dir_all(&package).expect("made");
    std::fs::write(package.join("__init__.py"), "").expect("written");
    std::fs::write(package.join("opensees.py"), STAND_IN).expect("written");
    let mut command = Command::new("python3");
    command.arg(&script).env("PYTHONDONTWRITEBYTECODE", "1");
    for (name, value) in [("LONGEST", longest), ("BEGIN", begin), ("END", end)] {
        command.env(name, value.to_string());
    }
    command.output().ok()
}

/// Both streams of a script that ran.
fn told(output: &Output) -> (String, String) {
    let text = |bytes: &[u8]| String::from_utf8_lossy(bytes).into_owned();
    (text(&output.stdout), text(&output.stderr))
}

#[test]
fn a_step_that_does_not_converge_is_taken_in_ever_smaller_parts() {
    let folder = tempfile::tempdir().expect("a folder");
    let Some(output) = run(folder.path(), 1e-6, [0.05, 0.0500001]) else {
        return;
    };
    let (printed, complained) = told(&output);
    assert!(output.status.success(), "{printed}\n{complained}");
    assert!(printed.contains("\"complete\": true"), "{printed}");
    assert!(printed.contains("\"failed_steps\": 1"), "{printed}");
}

#[test]
fn weight_that_cracks_hinges_is_applied_in_smaller_parts() {
    let folder = tempfile::tempdir().expect("a folder");
    let Some(output) = run(folder.path(), 1e-2, [0.5, 0.51]) else {
        return;
    };
    let (printed, complained) = told(&output);
    assert!(output.status.success(), "{printed}\n{complained}");
}

#[test]
fn a_script_that_stops_says_when_and_what_to_try() {
    let folder = tempfile::tempdir().expect("a folder");
    let Some(output) = run(folder.path(), 0.0, [0.05, 0.0999]) else {
        return;
    };
    let (printed, complained) = told(&output);
    assert_eq!(output.status.code(), Some(1), "{printed}\n{complained}");
    assert!(printed.contains("\"complete\": false"), "{printed}");
    assert!(complained.contains("stopped at 0.05"), "{complained}");
    assert!(
        complained.contains("--free") && complained.contains("--log"),
        "{complained}"
    );
}
