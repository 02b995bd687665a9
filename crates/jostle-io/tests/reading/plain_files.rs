//! What is no plain file, and what is larger than it says, is refused wherever a file is named, and at once.

#![cfg(unix)]

use std::path::{Path, PathBuf};
use std::process::Command;
use std::sync::mpsc;
use std::time::Duration;

use jostle_io::{
    ComparisonMap, Format, MeasuredTable, ModelTree, RecordOptions, StudyFile, numpy_archive,
    read_model_file, read_record, read_target_file,
};

const TOWERS: &str = r#"
[motion]
MOTION

[[building]]
name = "A"
kind = "shear"
mass = ["40 t"]
stiffness = ["30 MN/m"]
OWN
"#;

const GIVEN: &str = r#"
[motion]
record = "el-centro-1940-ns"

[[building]]
name = "A"
kind = "given"
matrices = MATRICES
ports = { "1" = { dof = 1, height = "3 m" } }
"#;

/// What is no plain file: a pipe that nobody writes to, a device without an end, a link to it, a folder, and a file that
/// states no bytes and has some.
fn oddities(folder: &Path) -> Vec<PathBuf> {
    let pipe = folder.join("pipe");
    let made = Command::new("mkfifo").arg(&pipe).status();
    assert!(made.expect("mkfifo").success());
    let link = folder.join("link");
    std::os::unix::fs::symlink("/dev/zero", &link).expect("a link");
    let inner = folder.join("inner");
    std::fs::create_dir(&inner).expect("a folder");
    let mut all = vec![pipe, link, inner, "/dev/zero".into()];
    if cfg!(target_os = "linux") {
        all.push("/proc/self/environ".into());
    }
    all
}

/// The error of a reader, which has five seconds.
fn refusal(what: &str, read: impl FnOnce() -> Result<(), String> + Send + 'static) -> String {
    let (send, answer) = mpsc::channel();
    std::thread::spawn(move || send.send(read()));
    match answer.recv_timeout(Duration::from_secs(5)) {
        Ok(Err(error)) => error,
        Ok(Ok(())) => panic!("{what} was read"),
        Err(_) => panic!("{what} was waited for"),
    }
}

fn words<T, E: std::fmt::Display>(read: Result<T, E>) -> Result<(), String> {
    read.map(|_| ()).map_err(|error| error.to_string())
}

/// Every way in which a file is named, by the error that it gives.
fn every_way(odd: &Path) -> Vec<(&'static str, String)> {
    let text = odd.to_str().expect("UTF-8").to_owned();
    let model = |motion: &str, keys: &str| TOWERS.replace("MOTION", motion).replace("OWN", keys);
    let given = |matrices: &str| GIVEN.replace("MATRICES", matrices);
    let models = [
        ("record", model(&format!("record = \"{text}\""), "")),
        (
            "across",
            model(
                &format!("record = \"el-centro-1940-ns\"\nacross = \"{text}\""),
                "plan = [\"8 m\", \"6 m\"]",
            ),
        ),
        (
            "own motion",
            model(
                "record = \"el-centro-1940-ns\"",
                &format!("motion = {{ record = \"{text}\" }}"),
            ),
        ),
        (
            "spectrum",
            model(
                &format!(
                    "record = \"el-centro-1940-ns\"\nmatch = {{ spectrum = \"{text}\", at = \"1 s\" }}"
                ),
                "",
            ),
        ),
        ("archive", given(&format!("\"{text}\""))),
        (
            "matrix",
            given(&format!("{{ stiffness = \"{text}\", mass = [1.0] }}")),
        ),
    ];
    let mut found = Vec::new();
    for (what, model) in models {
        let read = move || {
            let tree = ModelTree::parse("m", &model, Format::Toml, Path::new(""));
            let input = tree.and_then(|tree| tree.input());
            words(input.and_then(|input| input.ground_motion()))
        };
        found.push((what, refusal(what, read)));
    }
    type Read = fn(&Path) -> Result<(), String>;
    let readers: [(&str, Read); 6] = [
        ("model", |path| words(read_model_file(path))),
        ("record file", |path| {
            words(read_record(path, &RecordOptions::default()))
        }),
        ("target", |path| words(read_target_file(path))),
        ("data", |path| words(MeasuredTable::read(path))),
        ("map", |path| words(ComparisonMap::load(path))),
        ("study", |path| words(StudyFile::load(path, None))),
    ];
    for (what, read) in readers {
        let odd = odd.to_owned();
        found.push((what, refusal(what, move || read(&odd))));
    }
    found
}

#[test]
fn pipes_devices_and_folders_are_refused_wherever_a_file_is_named() {
    let folder = tempfile::tempdir().expect("a folder");
    for odd in oddities(folder.path()) {
        for (what, error) in every_way(&odd) {
            let says = ["named pipe", "device", "folder", "more bytes"];
            assert!(
                says.iter().any(|word| error.contains(word)),
                "{what} {}: {error}",
                odd.display()
            );
        }
    }
}

/// An archive whose header announces a matrix that no building can have is refused by the header; one that holds more
/// than its header announces, or a value that is no number, is refused as well.
#[test]
fn headers_of_archives_are_believed_for_refusing() {
    let folder = tempfile::tempdir().expect("a folder");
    let read = |arrays: &[(&str, &[usize], Vec<f64>)]| {
        let bytes = numpy_archive(arrays).expect("memory");
        std::fs::write(folder.path().join("a.npz"), bytes).expect("a file");
        let text = GIVEN.replace("MATRICES", "\"a.npz\"");
        let tree = ModelTree::parse("m", &text, Format::Toml, folder.path()).expect("TOML");
        tree.input().map(|_| ()).map_err(|error| error.to_string())
    };
    let one = |value: f64| [("K", &[1, 1][..], vec![value]), ("M", &[1][..], vec![1e3])];
    read(&one(1e6)).expect("a building");
    let error = read(&[("K", &[20_000, 20_000], vec![0.0; 8])]).expect_err("large");
    assert!(error.contains("20000") && error.contains("2000"), "{error}");
    let error = read(&[("K", &[1, 1], vec![1e6; 9]), ("M", &[1], vec![1e3])]).expect_err("more");
    assert!(error.contains("more numbers"), "{error}");
    for bad in [f64::NAN, f64::INFINITY] {
        let error = read(&one(bad)).expect_err("no number");
        assert!(error.contains("row 1, column 1"), "{error}");
        let mass = [("K", &[1, 1][..], vec![1e6]), ("M", &[1][..], vec![bad])];
        assert!(read(&mass).expect_err("no number").contains("no number"));
    }
}
