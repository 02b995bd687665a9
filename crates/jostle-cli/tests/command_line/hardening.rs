//! The program under attack, and with things missing that it counts on: disks that are full, other processes, kills.

use std::path::Path;
use std::process::{Command, Stdio};
use std::time::Duration;

use crate::common::{complained, folder, jostle, printed};

const SMALL: &str = r#"
title = "small"
[motion]
kind = "sine"
amplitude = "3 m/s2"
period = "0.4 s"
duration = "0.8 s"
[[building]]
name = "A"
kind = "shear"
storey_height = "4 m"
mass = ["75 t"]
stiffness = ["2.0562 MN/m"]
[[building]]
name = "B"
kind = "shear"
storey_height = "4 m"
mass = ["3000 t"]
stiffness = ["1315.95 MN/m"]
[[gap]]
between = ["A", "B"]
width = "20 mm"
law = "linear"
stiffness = "300 MN/m"
"#;

const STUDY: &str = r#"
title = "small"
base = "m.toml"
[[vary]]
path = "gap[0].width"
range = { from = "1 mm", to = "30 mm", count = 40 }
"#;

fn write(folder: &Path, name: &str, text: &str) {
    std::fs::write(folder.join(name), text).expect("a file");
}

fn program(folder: &Path, arguments: &[&str]) -> Command {
    let mut command = Command::new(env!("CARGO_BIN_EXE_jostle"));
    command.args(arguments).current_dir(folder);
    command.stdin(Stdio::null()).stderr(Stdio::piped());
    command
}

/// Every command that prints says so when its output is lost, and ends with 1; a reader that goes away is no error.
#[cfg(target_os = "linux")]
#[test]
fn lost_output_is_an_error() {
    let held = folder();
    let folder = held.path();
    write(folder, "m.toml", SMALL);
    write(folder, "s.toml", STUDY);
    for arguments in [
        &["check", "m.toml"][..],
        &["run", "m.toml", "--json", "--no-report"],
        &["modes", "m.toml"],
        &["schema"],
        &["export", "m.toml", "--to", "openseespy"],
        &["study", "s.toml", "--check"],
        &["motion", "list"],
        &["motion", "show", "el-centro-1940-ns"],
        &["motion", "spectrum", "el-centro-1940-ns"],
        &["gap", "m.toml", "--json"],
        &[
            "size",
            "m.toml",
            "--vary",
            "gap.width=5 mm..50 mm",
            "--keep",
            "impact_count == 0",
            "--minimise",
            "gap.width",
            "--trials",
            "20",
            "--json",
        ],
        &["contact-advice", "m.toml"],
        &["method", "m.toml"],
        &[
            "section", "--width", "300mm", "--depth", "500mm", "--bars", "8 d20",
        ],
        &["live", "m.toml", "--no-open"],
        &["completions", "bash"],
        &["--help"],
        &["motion", "--help"],
        &["run", "--help"],
        &["--version"],
        &["help"],
        &[
            "collide", "--law", "hertz", "--m1", "1 t", "--m2", "1 t", "--speed", "1 m/s",
        ],
    ] {
        let full = std::fs::File::options()
            .write(true)
            .open("/dev/full")
            .expect("/dev/full");
        let output = program(folder, arguments).stdout(full).output();
        let output = output.expect("the program starts");
        let shown = complained(&output);
        assert_eq!(output.status.code(), Some(1), "{arguments:?}: {shown}");
        assert!(shown.contains("standard output"), "{arguments:?}: {shown}");
    }
    let mut gone = program(folder, &["schema"])
        .stdout(Stdio::piped())
        .spawn()
        .expect("the program starts");
    drop(gone.stdout.take());
    assert!(gone.wait().expect("its end").success());
}

/// Paths of thousands of parts are refused in words wherever one is taken.
#[test]
fn long_paths_are_refused() {
    let held = folder();
    let folder = held.path();
    write(folder, "m.toml", SMALL);
    let path = "a.".repeat(60_000) + "b";
    write(
        folder,
        "s.toml",
        &format!("base = \"m.toml\"\n[[vary]]\npath = \"{path}\"\nvalues = [1, 2]\n"),
    );
    let vary = format!("{}b=1..2", "a.".repeat(30_000));
    for arguments in [
        &["study", "s.toml", "--check"][..],
        &[
            "size",
            "m.toml",
            "--vary",
            &vary,
            "--keep",
            "impact_count == 0",
            "--minimise",
            "peak_force_n",
        ],
    ] {
        let output = jostle(folder, arguments);
        let shown = complained(&output);
        assert_eq!(output.status.code(), Some(2), "{shown:.300}");
        assert!(shown.contains("more than 64 parts"), "{shown:.300}");
        assert!(shown.len() < 2000, "{} bytes", shown.len());
    }
}

/// A folder holds the files of one run: another one at the same time is refused, and what a killed one left is removed.
#[test]
fn a_folder_holds_the_files_of_one_run() {
    let held = folder();
    let folder = held.path();
    write(folder, "m.toml", SMALL);
    let out = folder.join("out");
    std::fs::create_dir(&out).expect("a folder");
    let left = out.join(".jostle-4294967295-x.part");
    std::fs::create_dir(&left).expect("a folder");
    let claim = jostle_run::FolderClaim::new(&out).expect("free");
    let output = jostle(folder, &["run", "m.toml", "--out", "out"]);
    assert_eq!(output.status.code(), Some(2));
    assert!(complained(&output).contains("another run is writing into out"));
    drop(claim);
    let output = jostle(folder, &["run", "m.toml", "--out", "out"]);
    assert!(output.status.success(), "{}", complained(&output));
    let names: Vec<String> = std::fs::read_dir(&out)
        .expect("results")
        .flatten()
        .map(|entry| entry.file_name().to_string_lossy().into_owned())
        .collect();
    let hidden = names.iter().filter(|name| name.starts_with('.'));
    assert_eq!(hidden.count(), 0, "{names:?}");
}

/// Several processes on one folder all succeed, and their tables are those of one.
#[test]
fn processes_share_a_folder() {
    let held = folder();
    let folder = held.path();
    write(folder, "m.toml", SMALL);
    write(folder, "s.toml", STUDY);
    let alone = jostle(folder, &["study", "s.toml", "--out", "alone"]);
    assert!(alone.status.success(), "{}", complained(&alone));
    let arguments = ["study", "s.toml", "--out", "shared", "--jobs", "1"];
    let start = |_| {
        let mut command = program(folder, &arguments);
        command.stdout(Stdio::null()).spawn().expect("it starts")
    };
    let children: Vec<_> = (0..4).map(start).collect();
    for child in children {
        let output = child.wait_with_output().expect("its end");
        assert!(output.status.success(), "{}", complained(&output));
    }
    let cases = |name: &str| std::fs::read(folder.join(name).join("cases.csv")).expect("a table");
    assert_eq!(cases("alone"), cases("shared"));
    assert!(!folder.join("shared/under-way").exists());
    // Histories of single cases are made again where only the parts were copied.
    let kept = STUDY.replace("title = \"small\"", "title = \"small\"\nhistories = [3]");
    write(folder, "h.toml", &kept);
    let run = || jostle(folder, &["study", "h.toml", "--out", "kept", "--no-report"]);
    assert!(run().status.success());
    let kept = folder.join("kept/runs/case-0000000003/summary.json");
    let before = std::fs::read(&kept).expect("a run");
    std::fs::remove_dir_all(folder.join("kept/runs")).expect("gone");
    assert!(run().status.success());
    assert_eq!(std::fs::read(&kept).expect("a run"), before);
}

/// A process that hangs is named, and its part is computed by one that has nothing else to do.
#[cfg(target_os = "linux")]
#[test]
#[ignore = "takes a minute"]
fn a_hung_process_stops_nobody() {
    let held = folder();
    let folder = held.path();
    let slow = SMALL.replace("0.8 s", "200 s");
    write(folder, "m.toml", &slow);
    write(folder, "s.toml", STUDY);
    let arguments = [
        "study",
        "s.toml",
        "--out",
        "out",
        "--jobs",
        "1",
        "--no-report",
    ];
    let mut hung = program(folder, &arguments)
        .stdout(Stdio::null())
        .spawn()
        .expect("it starts");
    std::thread::sleep(Duration::from_secs(2));
    let signal = |name: &str| {
        let id = hung.id().to_string();
        let sent = Command::new("kill").args([name, &id]).status();
        assert!(sent.expect("kill").success());
    };
    signal("-STOP");
    let other = jostle(folder, &arguments);
    let shown = complained(&other);
    signal("-CONT");
    assert!(other.status.success(), "{shown}");
    assert!(shown.contains("waiting for process"), "{shown}");
    assert!(hung.wait().expect("its end").success());
}

/// Plans that have no area are faults of the plan, wherever else they show.
#[test]
fn small_mistakes_are_told() {
    let held = folder();
    let folder = held.path();
    let plan = |corners: &str| {
        SMALL.replacen(
            "stiffness = [\"2.0562 MN/m\"]",
            &format!("stiffness = [\"2.0562 MN/m\"]\nplan = {corners}"),
            1,
        )
    };
    let many: Vec<String> = (0..4000)
        .map(|at| {
            let angle = std::f64::consts::TAU * f64::from(at) / 4000.0;
            format!("[{}, {}]", 10.0 * angle.cos(), 10.0 * angle.sin())
        })
        .collect();
    for (corners, word) in [
        (
            "[[0, 0], [10, 8], [10, 0], [0, 8]]".to_owned(),
            "crosses itself",
        ),
        // Without area.
        (
            "[[0, 0], [10, 10], [10, 0], [0, 10]]".to_owned(),
            "crosses itself",
        ),
        ("[[0, 0], [10, 0]]".to_owned(), "at least three"),
        (format!("[{}]", many.join(", ")), "at most 300"),
    ] {
        write(folder, "m.toml", &plan(&corners));
        let output = jostle(folder, &["check", "m.toml"]);
        let shown = complained(&output);
        assert_eq!(output.status.code(), Some(2), "{shown:.400}");
        assert!(shown.contains(word), "{word}: {shown:.400}");
        assert!(!shown.contains("polar_mass"), "{shown:.400}");
        assert!(!shown.contains("NaN"), "{shown:.400}");
    }
    // Names of files that are no names of folders.
    write(folder, "...toml", SMALL);
    let output = jostle(folder, &["run", "...toml", "--no-report"]);
    assert!(output.status.success(), "{}", complained(&output));
    assert!(folder.join("jostle-out/paper/summary.json").exists());
    // Faults of meaning in a study have lines.
    write(folder, "m.toml", SMALL);
    let wrong = format!("{STUDY}\n[[ida]]\nintensity = \"pga_m_s2\"\ndemand = \"nothing\"\n");
    write(folder, "s.toml", &wrong);
    let output = jostle(folder, &["study", "s.toml", "--check"]);
    let shown = complained(&output);
    let line = 1 + wrong[..wrong.find("\"nothing\"").expect("there")]
        .matches('\n')
        .count();
    assert!(shown.contains(&format!("s.toml:{line}:")), "{shown}");
    // A key that does not exist is a fault of its factor alone, also while the others are tried.
    let wrong = format!("{STUDY}\n[[vary]]\npath = \"gap[0].widht\"\nvalues = [\"3 mm\"]\n");
    write(folder, "s.toml", &wrong);
    let shown = complained(&jostle(folder, &["study", "s.toml", "--check"]));
    assert!(
        shown.contains("s.toml:") && shown.contains("widht"),
        "{shown}"
    );
    assert!(!shown.contains("m.toml:"), "{shown}");
    // A model without a motion cannot be run, and the check does not say that it can.
    let still = &SMALL[SMALL.find("[[building]]").expect("there")..];
    write(folder, "m.toml", still);
    let shown = printed(&jostle(folder, &["check", "m.toml"]));
    assert!(shown.contains("valid, without a ground motion"), "{shown}");
}

/// `check` says what a run takes, dampers included; the bound on work counts them, and so much memory is refused with the
/// interval that fits.
#[test]
fn expected_work_is_told_and_bounded() {
    let held = folder();
    let folder = held.path();
    let damper = r#"
[[building.damper]]
floors = [[0, 1]]
law = "viscous"
damping = "18 kN.(s/m)^0.5"
exponent = 0.5
stiffness = "150 MN/m"
"#;
    let at = SMALL
        .find("[[building]]\nname = \"B\"")
        .expect("the second building");
    let with = |count: usize| {
        let (first, rest) = SMALL.split_at(at);
        format!("{first}{}\n{rest}", damper.repeat(count))
    };
    write(folder, "m.toml", &with(20));
    let told = printed(&jostle(folder, &["check", "m.toml"]));
    assert!(
        told.contains("20 links and dampers solved together in every step"),
        "{told}"
    );
    for part in [
        " of computing on this machine",
        " MB of memory, ",
        " rows of histories (history.parquet about ",
    ] {
        assert!(told.contains(part), "{part}: {told}");
    }
    // A run of 400 hours.
    let long = with(300).replace("duration = \"0.8 s\"", "duration = \"3000 s\"");
    write(folder, "long.toml", &long);
    let refused = complained(&jostle(folder, &["check", "long.toml"]));
    assert!(
        refused.contains("hours of computing: 300 links and dampers take")
            && refused.contains("long.toml:"),
        "{refused}"
    );
    let rows = "[output]\ninterval = \"0.02 ms\"\n[[building]]\nname = \"A\"";
    let much = SMALL.replace("duration = \"0.8 s\"", "duration = \"3600 s\"");
    let much = much.replacen("[[building]]\nname = \"A\"", rows, 1);
    write(folder, "much.toml", &much);
    for command in ["check", "run"] {
        let refused = complained(&jostle(folder, &[command, "much.toml"]));
        for part in [
            "much.toml:",
            "rows of histories make a history.parquet of ",
            "GB, more than 8.0 GB; write interval",
            "under [output] for fewer rows",
        ] {
            assert!(refused.contains(part), "{part}: {refused}");
        }
        let longer = refused
            .split("write interval = \"")
            .nth(1)
            .and_then(|rest| rest.split('"').next());
        let fits = much.replace("0.02 ms", longer.expect("an interval"));
        write(folder, "fits.toml", &fits);
        printed(&jostle(folder, &["check", "fits.toml"]));
    }
}

/// Histories that are too long for the memory need a disk: without one the run ends with 1, and says what helps.
#[cfg(target_os = "linux")]
#[test]
fn a_run_without_room_for_its_histories_says_so() {
    let held = folder();
    let folder = held.path();
    let rows = "[output]\ninterval = \"0.1 ms\"\n[[building]]\nname = \"A\"";
    let long = SMALL.replace("duration = \"0.8 s\"", "duration = \"60 s\"");
    write(
        folder,
        "m.toml",
        &long.replacen("[[building]]\nname = \"A\"", rows, 1),
    );
    let told = printed(&jostle(folder, &["check", "m.toml"]));
    assert!(told.contains("temporary files up to "), "{told}");
    let mut run = program(folder, &["run", "m.toml", "--no-report", "--out", "r"]);
    let output = run.env("TMPDIR", "missing").output().expect("it starts");
    assert_eq!(output.status.code(), Some(1));
    let told = complained(&output);
    for part in [
        "histories cannot be kept from t = ",
        "a temporary file in missing cannot be written: No such file or directory",
        "set TMPDIR to a folder with more, or write a longer interval under [output]",
        "results up to then are in r",
    ] {
        assert!(told.contains(part), "{part}: {told}");
    }
    let until = summary(&folder.join("r"))["ended_early"].to_string();
    assert!(until.contains("histories cannot be kept"), "{until}");
}

/// Names in a folder that begin with a dot: what is being written, and claims.
fn hidden(folder: &Path) -> Vec<String> {
    let entries = std::fs::read_dir(folder).into_iter().flatten().flatten();
    entries
        .map(|entry| entry.file_name().to_string_lossy().into_owned())
        .filter(|name| name.starts_with('.'))
        .collect()
}

/// The summary of a folder without the time that the run took.
fn summary(folder: &Path) -> serde_json::Value {
    let text = std::fs::read_to_string(folder.join("summary.json")).expect("a summary");
    let mut summary: serde_json::Value = serde_json::from_str(&text).expect("JSON");
    summary["work"]["wall_s"] = 0.into();
    summary
}

/// Runs at the same time into one folder: each writes all of its files or is refused, and the files are those of one run.
#[test]
fn runs_at_once_do_not_mix_their_files() {
    let held = folder();
    let folder = held.path();
    write(folder, "m.toml", SMALL);
    let gaps = ["10 mm", "15 mm", "20 mm"];
    for (index, gap) in gaps.iter().enumerate() {
        let out = format!("alone{index}");
        let output = jostle(folder, &["run", "m.toml", "--gap", gap, "--out", &out]);
        assert!(output.status.success(), "{}", complained(&output));
    }
    for _ in 0..3 {
        let start = |gap: &&str| {
            let arguments = ["run", "m.toml", "--gap", gap, "--out", "both"];
            let mut command = program(folder, &arguments);
            command.stdout(Stdio::null()).spawn().expect("it starts")
        };
        let children: Vec<_> = gaps.iter().map(start).collect();
        let mut finished = 0;
        for child in children {
            let output = child.wait_with_output().expect("its end");
            let refused = complained(&output).contains("another run is writing into both");
            assert!(
                output.status.success() || refused,
                "{}",
                complained(&output)
            );
            finished += usize::from(output.status.success());
        }
        assert!(finished > 0);
        let found = summary(&folder.join("both"));
        let position =
            (0..gaps.len()).find(|index| summary(&folder.join(format!("alone{index}"))) == found);
        let alone = folder.join(format!("alone{}", position.expect("one of the runs")));
        for name in ["history.parquet", "impacts.parquet", "floors.parquet"] {
            let [one, other] = [&alone, &folder.join("both")]
                .map(|f| std::fs::read(f.join(name)).expect("a table"));
            assert!(one == other, "{name}");
        }
        assert_eq!(hidden(&folder.join("both")), Vec::<String>::new());
    }
}

/// A run that is killed at any instant leaves nothing that stays: the next run removes it.
#[test]
fn killed_runs_leave_nothing() {
    let held = folder();
    let folder = held.path();
    write(folder, "m.toml", &SMALL.replace("0.8 s", "20 s"));
    let arguments = ["run", "m.toml", "--out", "out"];
    let mut left = 0;
    for delay in [10, 30, 60, 90, 120, 160, 200, 300] {
        let mut command = program(folder, &arguments);
        let mut child = command.stdout(Stdio::null()).spawn().expect("it starts");
        std::thread::sleep(Duration::from_millis(delay));
        child.kill().expect("a kill");
        child.wait().expect("its end");
        left += hidden(&folder.join("out")).len();
    }
    // Claims at least: otherwise nothing was tried.
    assert!(left > 0);
    let output = jostle(folder, &arguments);
    assert!(output.status.success(), "{}", complained(&output));
    assert_eq!(hidden(&folder.join("out")), Vec::<String>::new());
    assert!(folder.join("out/report.html").exists());
}

/// Ctrl-C in the second record of a curve keeps the curve of the first.
#[cfg(unix)]
#[test]
fn an_interrupted_curve_keeps_what_is_done() {
    let held = folder();
    let folder = held.path();
    let mut long = String::from("# unit = m/s2\n");
    for step in 0..400_000 {
        long += &format!(
            "{:.2},{}\n",
            0.01 * f64::from(step),
            if step % 40 < 20 { 2 } else { -2 }
        );
    }
    write(folder, "long.csv", &long);
    let start = SMALL.find("kind = \"sine\"").expect("the motion");
    let end = SMALL.find("[[building]]").expect("a building");
    let records = "record = [\"el-centro-1940-ns\", \"long.csv\"]\n";
    write(
        folder,
        "m.toml",
        &format!("{}{records}{}", &SMALL[..start], &SMALL[end..]),
    );
    let arguments = ["gap", "m.toml", "--curve", "12", "--out", "curve"];
    let mut child = program(folder, &arguments)
        .stdout(Stdio::null())
        .spawn()
        .expect("it starts");
    std::thread::sleep(Duration::from_secs(4));
    if let Some(status) = child.try_wait().expect("its state") {
        let output = child.wait_with_output().expect("its end");
        panic!("it ended early: {status}: {}", complained(&output));
    }
    let id = child.id().to_string();
    assert!(
        Command::new("kill")
            .args(["-INT", &id])
            .status()
            .expect("kill")
            .success()
    );
    let output = child.wait_with_output().expect("its end");
    assert_eq!(output.status.code(), Some(130), "{}", complained(&output));
    assert!(
        complained(&output).contains("stopped: what follows lacks the records"),
        "{}",
        complained(&output)
    );
    let table = std::fs::read_to_string(folder.join("curve/gap_curve.csv")).expect("a table");
    assert_eq!(table.lines().count(), 1 + 2 * 12, "{table:.300}");
}

/// Summaries, manifests and pages name the version, and the commit of builds that know theirs.
#[test]
fn results_name_the_build() {
    let held = folder();
    let folder = held.path();
    write(folder, "m.toml", SMALL);
    write(folder, "s.toml", STUDY);
    for arguments in [
        &["run", "m.toml", "--out", "run"][..],
        &["study", "s.toml", "--out", "study"],
    ] {
        let output = jostle(folder, arguments);
        assert!(output.status.success(), "{}", complained(&output));
    }
    let read = |name: &str| std::fs::read_to_string(folder.join(name)).expect("a file");
    let json =
        |name: &str| -> serde_json::Value { serde_json::from_str(&read(name)).expect("JSON") };
    let (run, study) = (json("run/summary.json"), json("study/manifest.json"));
    let version = env!("CARGO_PKG_VERSION");
    assert_eq!(
        (&run["jostle"], &study["jostle"]),
        (&version.into(), &version.into())
    );
    let shown = match run["build"].as_str() {
        Some(build) => {
            assert_eq!(study["builds"], serde_json::json!([build]));
            build.to_owned()
        }
        None => version.to_owned(),
    };
    for page in ["run/report.html", "study/report.html"] {
        assert!(read(page).contains(&shown), "{page}: {shown}");
    }
}

/// Results have the same bits on a processor without fused multiply-add, which the mathematical library of the system uses if it is
/// there.
#[cfg(all(target_os = "linux", target_env = "gnu", target_arch = "x86_64"))]
#[test]
fn bits_do_not_depend_on_the_processor() {
    let held = folder();
    let folder = held.path();
    let examples = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../examples");
    for name in ["two_towers_on_soil.toml", "yielding_space_frames.toml"] {
        let model = examples.join(name);
        let model = model.to_str().expect("a path");
        let [usual, masked] = ["", "glibc.cpu.hwcaps=-FMA,-FMA4,-AVX2"].map(|masked| {
            let out = if masked.is_empty() { "usual" } else { "masked" };
            let mut command = program(folder, &["run", model, "--out", out, "--no-report"]);
            command.env("GLIBC_TUNABLES", masked).stdout(Stdio::null());
            let output = command.output().expect("it starts");
            assert!(output.status.success(), "{}", complained(&output));
            summary(&folder.join(out))
        });
        assert!(usual == masked, "{name}");
    }
    let recipe = ["motion", "synth", "noise", "--seed", "3", "--pga", "0.2g"];
    let [usual, masked] = ["", "glibc.cpu.hwcaps=-FMA,-FMA4,-AVX2"].map(|masked| {
        let out = if masked.is_empty() {
            "usual.csv"
        } else {
            "masked.csv"
        };
        let mut command = program(folder, &[&recipe[..], &["--out", out]].concat());
        command.env("GLIBC_TUNABLES", masked).stdout(Stdio::null());
        let output = command.output().expect("it starts");
        assert!(output.status.success(), "{}", complained(&output));
        std::fs::read(folder.join(out)).expect("a wave")
    });
    assert!(usual == masked);
}

/// A file that is to go into a pipe or a device goes there, and does not take its place.
#[cfg(unix)]
#[test]
fn pipes_are_written_into_and_never_replaced() {
    let place = folder();
    write(place.path(), "m.toml", SMALL);
    let output = jostle(
        place.path(),
        &[
            "export",
            "m.toml",
            "--to",
            "openseespy",
            "-o",
            "/dev/stdout",
        ],
    );
    assert!(output.status.success(), "{}", complained(&output));
    assert!(printed(&output).contains("import openseespy"));
    // Root could replace it.
    use std::os::unix::fs::FileTypeExt;
    let null = std::fs::metadata("/dev/null").expect("there is one");
    let output = jostle(
        place.path(),
        &["export", "m.toml", "--to", "openseespy", "-o", "/dev/null"],
    );
    assert!(output.status.success(), "{}", complained(&output));
    let still = std::fs::metadata("/dev/null").expect("there is one");
    assert!(null.file_type().is_char_device() && still.file_type().is_char_device());
}
