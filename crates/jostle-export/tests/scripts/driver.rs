//! The part of a script that runs the analysis, with a stand-in for OpenSees that does not converge when it is told to.

use std::path::Path;
use std::process::{Command, Output};

use jostle::System;
use jostle_export::{Export, openseespy};
use jostle_io::Input;
use jostle_testkit::files::sound;

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

def region(number, *arguments):
    with open(os.environ["REGIONS"], "a") as file:
        file.write(" ".join(map(str, arguments)) + "\n")

def setNodeDisp(tag, direction, value, *_):
    if "MOVED" in os.environ:
        with open(os.environ["MOVED"], "a") as file:
            file.write(f"{now!r} {tag} {direction} {value!r}\n")

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
fn run(folder: &Path, longest: f64, span: [f64; 2]) -> Option<Output> {
    let input = sound(MODEL);
    run_model(folder, &input, longest, span)
}

fn run_model(folder: &Path, input: &Input, longest: f64, [begin, end]: [f64; 2]) -> Option<Output> {
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
    command.env("MOVED", folder.join("moved"));
    command.env("REGIONS", folder.join("regions"));
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

/// Motions of every kind, delayed; one is turned round, and one ends before the run.
const APART: &str = r#"
title = "grounds"
[motion]
COMMON
duration = "9 s"
baseline = "as-recorded"
[[building]]
name = "A"
kind = "shear"
mass = 1e5
stiffness = 1e8
storey_height = 3.0
[[building]]
name = "B"
kind = "shear"
mass = 1e5
stiffness = 1e8
storey_height = 3.0
motion = { record = "el-centro-1940-ns", scale = 0.5, reverse = true, arrival = "0.137 s" }
[[building]]
name = "C"
kind = "shear"
mass = 1e5
stiffness = 1e8
storey_height = 3.0
motion = { kind = "ricker", amplitude = 2.0, period = 0.6, centre = 0.9, arrival = "0.21 s" }
[[building]]
name = "D"
kind = "shear"
mass = 1e5
stiffness = 1e8
storey_height = 3.0
motion = { arrival = "0.313 s" }
"#;

/// Supports are moved before every step to where jostle has the ground at its end.
#[test]
fn supports_move_with_the_exact_integrals() {
    for common in [
        "record = \"el-centro-1940-ns\"\npga = \"0.3 g\"",
        "kind = \"sine\"\namplitude = 2.0\nperiod = 0.6",
    ] {
        supports_move_with(&APART.replace("COMMON", common));
    }
}

fn supports_move_with(text: &str) {
    let folder = tempfile::tempdir().expect("a folder");
    let input = sound(text);
    let Some(output) = run_model(folder.path(), &input, 1.0, [9e9, 9e9]) else {
        return;
    };
    let (printed, complained) = told(&output);
    assert!(output.status.success(), "{printed}\n{complained}");
    let step = printed
        .lines()
        .find_map(|line| line.trim().strip_prefix("\"free_s\": "));
    let step: f64 = step
        .expect("a step")
        .trim_end_matches(',')
        .parse()
        .expect("a number");
    let motion = input.ground_motion().expect("a motion");
    let paths: Vec<_> = (0..4).map(|index| motion.under(index)).collect();
    let text = std::fs::read_to_string(folder.path().join("moved")).expect("supports moved");
    let mut greatest = [0.0_f64; 4];
    for line in text.lines() {
        let words: Vec<&str> = line.split(' ').collect();
        let number = |at: usize| words[at].parse::<f64>().expect("a number");
        let (index, direction) = (number(1) as usize / 1000 - 1, words[2]);
        assert_eq!(direction, "1");
        let expected = paths[index].at(number(0) + step).displacement[0];
        assert!((number(3) - expected).abs() < 1e-12, "{line}, {expected}");
        greatest[index] = greatest[index].max(expected.abs());
    }
    assert!(greatest.iter().all(|moved| *moved > 1e-2), "{greatest:?}");
}

/// A brace that is damped by its tangent is in a region of its own, with beta on the stiffness of the last step.
#[test]
fn braces_damped_by_their_tangents_are_regions() {
    let brace = "\n[[building.brace]]\nEA = \"200 MN\"\nhinge = { rule = \"bilinear\", yield = \"60 kN\", post_yield = 0.02 }\n";
    let text = MODEL.replace(
        "[[building]]",
        "[[building]]\ndamping = { beta = 0.003, yielding = \"tangent\" }",
    );
    let hinges = text.find("hinges =").expect("hinges");
    let input = sound(&format!("{}{brace}", &text[..hinges]));
    let folder = tempfile::tempdir().expect("a folder");
    let Some(output) = run_model(folder.path(), &input, 1.0, [9e9, 9e9]) else {
        return;
    };
    let (printed, complained) = told(&output);
    assert!(output.status.success(), "{printed}\n{complained}");
    let script = std::fs::read_to_string(folder.path().join("model.py")).expect("a script");
    let rows = crate::script::table(&script, "DIAGONALS");
    assert_eq!(rows.len(), 1);
    let regions = std::fs::read_to_string(folder.path().join("regions")).expect("regions");
    let due = format!("-eleOnly {} -rayleigh 0.0 0.0 0.0 0.003", rows[0][0]);
    assert!(regions.lines().any(|region| region == due), "{regions}");
}
