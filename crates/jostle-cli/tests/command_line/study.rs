//! `jostle study` and `jostle gap`: killed, stopped and out of disk, nothing is lost; wrong input is told.

use std::collections::BTreeMap;
use std::path::{Path, PathBuf};
use std::process::{Child, Command, Stdio};
use std::time::{Duration, Instant};

use crate::common::{self, folder as temporary, jostle};
use jostle_testkit::two_towers;

const TOWERS: &str = concat!(
    r#"
[motion]
record = "el-centro-1940-ns"
duration = "4 s"
"#,
    two_towers!(2, 2),
    "[analysis]\ntolerance = 0.01\n",
);

fn study(count: usize) -> String {
    format!(
        r#"
title = "Towers"
base = "towers.toml"
[[vary]]
name = "gap"
path = "gap[0].width"
range = {{ from = "1 mm", to = "40 mm", count = {count} }}
[[vary]]
path = "motion.pga"
values = ["1 m/s2", "2 m/s2", "3 m/s2", "4 m/s2"]
"#
    )
}

/// A folder with a study of four times `count` cases.
fn workplace(count: usize) -> tempfile::TempDir {
    let folder = temporary();
    for (name, text) in [
        ("towers.toml", TOWERS.to_owned()),
        ("study.toml", study(count)),
    ] {
        std::fs::write(folder.path().join(name), text).unwrap_or_else(|error| panic!("{error}"));
    }
    folder
}

fn to_folder(folder: &Path, out: &str) -> Command {
    let arguments = [
        "study",
        "study.toml",
        "--jobs",
        "2",
        "--no-report",
        "--out",
        out,
    ];
    let mut command = common::command(folder, &arguments);
    command.stdout(Stdio::null()).stderr(Stdio::null());
    command
}

fn start(folder: &Path, out: &str) -> Child {
    to_folder(folder, out)
        .spawn()
        .unwrap_or_else(|error| panic!("{error}"))
}

/// Every file of a finished table, byte for byte, and nothing else under way.
fn table(out: PathBuf) -> BTreeMap<String, Vec<u8>> {
    let files = |inner: &str| -> Vec<PathBuf> {
        let entries = std::fs::read_dir(out.join(inner)).unwrap_or_else(|error| panic!("{error}"));
        entries
            .map(|entry| entry.unwrap_or_else(|error| panic!("{error}")).path())
            .collect()
    };
    assert!(!out.join("under-way").exists());
    let all = files("cases").into_iter().filter(|path| {
        // What a killed process was writing stays under a name of its own, which no reader takes for a part.
        path.extension()
            .is_some_and(|extension| extension == "parquet")
    });
    all.map(|path| {
        let name = path
            .file_name()
            .unwrap_or_default()
            .to_string_lossy()
            .into_owned();
        (
            name,
            std::fs::read(path).unwrap_or_else(|error| panic!("{error}")),
        )
    })
    .collect()
}

#[test]
fn fifty_kills_at_random_moments_lose_nothing_and_double_nothing() {
    let folder = workplace(100);
    assert!(
        to_folder(folder.path(), "whole")
            .status()
            .is_ok_and(|status| status.success())
    );
    let expected = table(folder.path().join("whole"));
    assert_eq!(expected.len(), 25, "400 cases in parts of 16");
    // A fixed sequence of waits, different from kill to kill.
    let mut random = 12_345_u64;
    let (mut kills, mut round, mut finished) = (0, 0, 0);
    while kills < 50 {
        let out = format!("killed-{round}");
        let mut child = start(folder.path(), &out);
        random = random
            .wrapping_mul(6_364_136_223_846_793_005)
            .wrapping_add(1_442_695_040_888_963_407);
        std::thread::sleep(Duration::from_micros(20_000 + (random >> 33) % 250_000));
        let ended = child.try_wait().unwrap_or_else(|error| panic!("{error}"));
        if ended.is_none() {
            // SIGKILL on Unix.
            child.kill().unwrap_or_else(|error| panic!("{error}"));
            child.wait().unwrap_or_else(|error| panic!("{error}"));
            kills += 1;
            continue;
        }
        assert!(
            ended.is_some_and(|status| status.success()),
            "a resumed run fails"
        );
        assert!(
            table(folder.path().join(&out)) == expected,
            "after {kills} kills"
        );
        finished += 1;
        round += 1;
    }
    let last = format!("killed-{round}");
    assert!(
        to_folder(folder.path(), &last)
            .status()
            .is_ok_and(|status| status.success())
    );
    assert!(
        table(folder.path().join(&last)) == expected,
        "after {finished} finished rounds"
    );
}

#[test]
fn two_processes_one_of_which_is_killed_leave_one_whole_table() {
    let folder = workplace(60);
    assert!(
        to_folder(folder.path(), "whole")
            .status()
            .is_ok_and(|status| status.success())
    );
    let mut first = start(folder.path(), "shared");
    let mut second = start(folder.path(), "shared");
    wait_for_rows(&folder.path().join("shared"));
    first.kill().unwrap_or_else(|error| panic!("{error}"));
    first.wait().unwrap_or_else(|error| panic!("{error}"));
    assert!(second.wait().is_ok_and(|status| status.success()));
    let shared = table(folder.path().join("shared"));
    assert!(shared == table(folder.path().join("whole")));
}

/// Waits until a study has kept its first rows: a journal is longer than its head, or a part is finished.
fn wait_for_rows(out: &Path) {
    let begun = || {
        ["under-way", "cases"].iter().any(|inner| {
            let entries = std::fs::read_dir(out.join(inner))
                .into_iter()
                .flatten()
                .flatten();
            entries
                .filter_map(|entry| entry.metadata().ok())
                .any(|file| file.len() > 64)
        })
    };
    let started = Instant::now();
    while !begun() {
        assert!(
            started.elapsed() < Duration::from_secs(120),
            "the study does not begin"
        );
        std::thread::sleep(Duration::from_millis(5));
    }
}

#[cfg(unix)]
#[test]
fn ctrl_c_stops_a_study_and_the_rest_goes_on() {
    let folder = workplace(400);
    let mut child = start(folder.path(), "out");
    wait_for_rows(&folder.path().join("out"));
    let signalled = Command::new("kill")
        .args(["-INT", &child.id().to_string()])
        .status();
    assert!(signalled.is_ok_and(|status| status.success()));
    let status = child.wait().unwrap_or_else(|error| panic!("{error}"));
    assert_eq!(status.code(), Some(130));
    let finished = std::fs::read_dir(folder.path().join("out/cases"))
        .map(Iterator::count)
        .ok();
    assert!(
        finished < Some(100),
        "it stops before the end: {finished:?} of 100 parts"
    );
    assert!(
        to_folder(folder.path(), "out")
            .status()
            .is_ok_and(|status| status.success())
    );
    assert_eq!(table(folder.path().join("out")).len(), 100);
}

/// A limit on the size of files stands for a full disk: writing fails in the same way.
#[cfg(unix)]
#[test]
fn a_full_disk_is_told_and_what_is_finished_stays() {
    let folder = workplace(20);
    assert!(
        to_folder(folder.path(), "whole")
            .status()
            .is_ok_and(|status| status.success())
    );
    let binary = env!("CARGO_BIN_EXE_jostle");
    let script = format!(
        "trap '' XFSZ; ulimit -f 16; exec '{binary}' study study.toml --jobs 2 --no-report --out full"
    );
    let output = Command::new("bash")
        .current_dir(folder.path())
        .args(["-c", &script])
        .output();
    let output = output.unwrap_or_else(|error| panic!("{error}"));
    let said = String::from_utf8_lossy(&output.stderr);
    assert_eq!(output.status.code(), Some(1), "{said}");
    assert!(
        said.contains("part-") && said.contains("what is finished stays"),
        "{said}"
    );
    assert!(!said.contains("panicked"), "{said}");
    assert!(
        to_folder(folder.path(), "full")
            .status()
            .is_ok_and(|status| status.success())
    );
    assert!(table(folder.path().join("full")) == table(folder.path().join("whole")));
}

#[test]
fn a_study_leaves_table_report_and_text() {
    let folder = workplace(5);
    let run = |arguments: &[&str]| {
        let output = jostle(folder.path(), arguments);
        let said = String::from_utf8_lossy(&output.stderr).into_owned();
        assert!(output.status.success(), "{arguments:?}: {said}");
        String::from_utf8_lossy(&output.stdout).into_owned()
    };
    let said = run(&["study", "study.toml"]);
    assert!(said.contains("20 of 20 cases finished"), "{said}");
    let out = folder.path().join("jostle-out/study");
    for name in [
        "manifest.json",
        "report.html",
        "cases.csv",
        "cases/part-0000000000.parquet",
    ] {
        assert!(out.join(name).is_file(), "{name}");
    }
    let rows = std::fs::read_to_string(out.join("cases.csv")).unwrap_or_default();
    assert_eq!(rows.lines().count(), 21);
    let page = std::fs::read_to_string(out.join("report.html")).unwrap_or_default();
    assert!(
        page.contains("Gaps required by rules")
            && !page.contains("http://")
            && !page.contains("https://")
    );
    // The second time there is nothing to compute.
    let again = run(&["study", "study.toml"]);
    assert!(again.contains("20 of 20 cases finished\n"), "{again}");
    let case = run(&["study", "study.toml", "--case", "7"]);
    assert!(case.contains("report.html"), "{case}");
    assert!(out.join("runs/case-0000000007/history.parquet").is_file());
    let check = run(&["study", "study.toml", "--check"]);
    assert!(check.contains("peak_force_n"), "{check}");
}

#[test]
fn a_sweep_of_one_number_is_drawn_with_a_line_for_every_record() {
    let folder = workplace(1);
    let sweep = r#"base = "towers.toml"
[[vary]]
path = "gap[0].width"
values = ["5 mm", "10 mm", "20 mm"]
[[vary]]
path = "motion.record"
values = ["el-centro-1940-ns", "nanjing-artificial"]
"#;
    std::fs::write(folder.path().join("sweep.toml"), sweep).expect("written");
    let done = jostle(folder.path(), &["study", "sweep.toml", "--out", "out"]);
    assert!(done.status.success(), "{}", common::complained(&done));
    let page = std::fs::read_to_string(folder.path().join("out/report.html")).expect("a report");
    for shown in [
        "Over gap",
        "greatest force",
        "impacts",
        "nanjing-artificial",
    ] {
        assert!(page.contains(shown), "{shown}");
    }
}

#[test]
fn wrong_studies_are_refused_with_their_line() {
    let folder = workplace(5);
    let text = study(5).replace("gap[0].width", "gap[0].widht");
    std::fs::write(folder.path().join("wrong.toml"), text)
        .unwrap_or_else(|error| panic!("{error}"));
    for (arguments, expected) in [
        (&["study", "wrong.toml"][..], "wrong.toml:7:"),
        (&["study", "absent.toml"], "cannot be read"),
        (&["study", "study.toml", "--shard", "4/3"], "expected I/N"),
        (
            &["study", "study.toml", "--case", "20"],
            "there is no case 20",
        ),
        (
            &["gap", "towers.toml", "--tolerance", "1 kg"],
            "--tolerance",
        ),
        (
            &["gap", "towers.toml", "--record", "nowhere.at2"],
            "--record",
        ),
    ] {
        let output = jostle(folder.path(), arguments);
        let said = String::from_utf8_lossy(&output.stderr);
        assert_eq!(output.status.code(), Some(2), "{arguments:?}: {said}");
        assert!(said.contains(expected), "{arguments:?}: {said}");
    }
}

/// The gap that the command finds is one where the towers miss each other, and a tenth of a millimetre less is not.
#[test]
fn the_smallest_gap_is_free_and_a_narrower_one_is_not() {
    let folder = workplace(5);
    let json = |arguments: &[&str]| -> serde_json::Value {
        let output = jostle(folder.path(), arguments);
        assert!(
            output.status.success(),
            "{}",
            String::from_utf8_lossy(&output.stderr)
        );
        serde_json::from_slice(&output.stdout).unwrap_or_else(|error| panic!("{error}"))
    };
    let found = json(&["gap", "towers.toml", "--json"]);
    let gap = &found["gaps"][0];
    let number = |key: &str| gap[key].as_f64().unwrap_or(f64::NAN);
    let (free, hit) = (number("gap_m"), number("pounding_at_m"));
    assert!(hit < free && free - hit <= 1.001e-4, "{hit} {free}");
    assert!(
        (free - number("closing_without_contact_m")).abs() < 2e-4,
        "{gap}"
    );
    let impacts = |width: f64| {
        let width = format!("{width:?} m");
        let run = json(&[
            "run",
            "towers.toml",
            "--json",
            "--no-report",
            "--gap",
            &width,
        ]);
        run["gaps"][0]["impact_count"].as_u64()
    };
    assert_eq!(impacts(free), Some(0));
    assert!(impacts(hit).is_some_and(|count| count > 0));
    // The rules in their order, and what they would have led to.
    let rules = gap["rules"].as_array().cloned().unwrap_or_default();
    let width = |name: &str| {
        let rule = rules.iter().find(|rule| rule["rule"] == name);
        rule.and_then(|rule| rule["gap_m"].as_f64())
            .unwrap_or(f64::NAN)
    };
    assert!(
        width("DDC") <= width("SRSS") && width("SRSS") <= width("ABS"),
        "{rules:?}"
    );
    assert!((width("0.7 SRSS") - 0.7 * width("SRSS")).abs() < 1e-12);
    assert!((width("UBC-97") - 0.7 * width("SRSS")).abs() < 1e-12);
    assert_eq!(width("GB 50011, intensity 8"), 0.1);
    assert!(width("ABS") >= free, "the sum of peaks is never too narrow");
    for rule in &rules {
        let safe = rule["gap_m"].as_f64() >= Some(free);
        assert_eq!(rule["impact_count"] == 0, safe, "{rule}");
    }
    // Over a set: the greatest of its members.
    let set = json(&[
        "gap",
        "towers.toml",
        "--json",
        "--no-outcomes",
        "--record",
        "el-centro",
        "--record",
        "nanjing-artificial",
    ]);
    let each: Vec<f64> = set["gaps"]
        .as_array()
        .into_iter()
        .flatten()
        .filter_map(|gap| gap["gap_m"].as_f64())
        .collect();
    assert_eq!(each.len(), 2);
    assert_eq!(
        set["sets"][0]["gap_max_m"].as_f64(),
        Some(each[0].max(each[1]))
    );
}

#[test]
fn the_studies_that_come_with_the_program_are_valid() {
    let examples = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../examples");
    let folder = temporary();
    let mut count = 0;
    for entry in std::fs::read_dir(examples)
        .unwrap_or_else(|error| panic!("{error}"))
        .flatten()
    {
        let path = entry.path().display().to_string();
        if entry.file_name().to_string_lossy().starts_with("study_") {
            let checked = common::command(folder.path(), &["study", &path, "--check"])
                .output()
                .unwrap_or_else(|error| panic!("{error}"));
            let said = String::from_utf8_lossy(&checked.stderr);
            assert!(checked.status.success(), "{path}: {said}");
            count += 1;
        }
    }
    assert!(count >= 3, "{count} studies");
}

/// The names of the buildings in the summary of a case.
fn buildings_of(out: &Path, case: u64) -> Vec<String> {
    let path = out.join(format!("runs/case-{case:010}/summary.json"));
    let text = std::fs::read_to_string(&path).unwrap_or_else(|error| panic!("{path:?}: {error}"));
    let summary: serde_json::Value =
        serde_json::from_str(&text).unwrap_or_else(|error| panic!("{error}"));
    let buildings = summary["buildings"].as_array().cloned().unwrap_or_default();
    let names = buildings.iter().filter_map(|one| one["name"].as_str());
    names.map(str::to_owned).collect()
}

/// A single case belongs to the results in its folder: their model, not the one that the study file names.
#[test]
fn a_single_case_has_the_model_of_its_folder() {
    let folder = workplace(5);
    let other = TOWERS
        .replace("\"A\"", "\"North\"")
        .replace("\"B\"", "\"South\"");
    std::fs::write(folder.path().join("other.toml"), other).expect("written");
    let run = |arguments: &[&str]| {
        let output = jostle(folder.path(), arguments);
        let said = common::complained(&output);
        assert!(output.status.success(), "{arguments:?}: {said}");
    };
    run(&[
        "study",
        "study.toml",
        "--base",
        "other.toml",
        "--out",
        "my out",
    ]);
    run(&["study", "study.toml", "--out", "my out", "--case", "3"]);
    let out = folder.path().join("my out");
    assert_eq!(buildings_of(&out, 3), ["North", "South"]);

    // A ready-made study by its name, in the folder that it has by default.
    run(&["study", "tornado", "--base", "other.toml"]);
    run(&["study", "tornado", "--case", "2"]);
    let ready = folder.path().join("jostle-out/tornado");
    assert_eq!(buildings_of(&ready, 2), ["North", "South"]);

    // The command that the report prints works as it stands, also when the study file is gone.
    std::fs::remove_file(folder.path().join("study.toml")).expect("removed");
    let page = std::fs::read_to_string(out.join("report.html")).expect("a report");
    let command = page.split("<code>").find_map(|rest| {
        let (command, _) = rest.split_once("</code>")?;
        command
            .contains("--case NUMBER")
            .then(|| command.to_owned())
    });
    let command = command.expect("a command").replace("NUMBER", "17");
    let program = command.replacen("jostle", &format!("'{}'", env!("CARGO_BIN_EXE_jostle")), 1);
    let script = Command::new("sh")
        .current_dir(folder.path())
        .args(["-c", &program])
        .output()
        .expect("a shell");
    assert!(
        script.status.success(),
        "{command}: {}",
        common::complained(&script)
    );
    assert_eq!(buildings_of(&out, 17), ["North", "South"]);

    // Another model in the same folder is refused, and the refusal names the model of the folder.
    let refused = jostle(
        folder.path(),
        &["study", "tornado", "--base", "towers.toml", "--case", "2"],
    );
    assert_eq!(refused.status.code(), Some(2));
    let said = common::complained(&refused);
    assert!(
        said.contains("the model has changed") && said.contains("other.toml"),
        "{said}"
    );
}

/// A part of another study, and one that a power cut has emptied, are said on standard error and computed again.
#[test]
fn foreign_and_empty_parts_are_said_and_computed_again() {
    let folder = workplace(8);
    let run = |arguments: &[&str]| {
        let output = jostle(folder.path(), arguments);
        assert!(output.status.success(), "{}", common::complained(&output));
        (common::printed(&output), common::complained(&output))
    };
    let study = ["study", "study.toml", "--no-report", "--out"];
    run(&[&study[..], &["a"]].concat());
    let expected = table(folder.path().join("a"));
    let text = std::fs::read_to_string(folder.path().join("study.toml")).expect("a study");
    std::fs::write(
        folder.path().join("second.toml"),
        format!("{text}\n# another\n"),
    )
    .expect("written");
    run(&["study", "second.toml", "--no-report", "--out", "b"]);
    let part = "cases/part-0000000016.parquet";
    std::fs::copy(
        folder.path().join("b").join(part),
        folder.path().join("a").join(part),
    )
    .expect("copied");
    let (printed, said) = run(&[&study[..], &["a"]].concat());
    assert!(said.contains("belongs to another study"), "{said}");
    assert!(printed.contains("(16 now"), "{printed}");
    assert!(table(folder.path().join("a")) == expected);
    std::fs::write(folder.path().join("a").join(part), "").expect("written");
    let (_, said) = run(&[&study[..], &["a"]].concat());
    assert!(
        said.contains("is empty") && said.contains("computed again"),
        "{said}"
    );
    assert!(table(folder.path().join("a")) == expected);
    let (_, said) = run(&[&study[..], &["a"]].concat());
    assert!(!said.contains("computed again"), "{said}");
}

/// A ready-made study of shear buildings: every key and its range are listed, and its middle is a run of the model.
#[test]
fn a_ready_made_study_varies_around_the_model() {
    let folder = workplace(1);
    let done = jostle(
        folder.path(),
        &["study", "tornado", "--base", "towers.toml", "--out", "out"],
    );
    let said = common::complained(&done);
    assert!(done.status.success(), "{said}");
    let page = std::fs::read_to_string(folder.path().join("out/report.html")).expect("a report");
    // The terminal has the keys, the page their words.
    for (listed, words) in [
        (
            "gap[*].width: × 0.5 … 1.5 (uniform); in the model 20 mm",
            ">× 0.5 … 1.5 (uniform); in the model 20 mm<",
        ),
        ("building[0].stiffness: ×", ">Stiffness of "),
        ("building[1].mass: ×", ">Mass of "),
        ("building[*].damping.ratio: 0.0", ">Damping ratio<"),
    ] {
        assert!(said.contains(listed), "{listed} is missing in {said}");
        assert!(page.contains(words), "{words} is missing in the report");
    }
    let rows = std::fs::read_to_string(folder.path().join("out/cases.csv")).expect("a table");
    let mut lines = rows.lines();
    let heads: Vec<&str> = lines.next().expect("heads").split(',').collect();
    let middle: Vec<&str> = lines.next().expect("a row").split(',').collect();
    let number = |name: &str| {
        let at = heads.iter().position(|head| *head == name);
        middle[at.unwrap_or_else(|| panic!("no column {name}"))]
            .parse::<f64>()
            .ok()
    };
    let run = jostle(
        folder.path(),
        &["run", "towers.toml", "--json", "--no-report"],
    );
    let summary: serde_json::Value =
        serde_json::from_slice(&run.stdout).unwrap_or_else(|error| panic!("{error}"));
    let gap = &summary["gaps"][0];
    assert!(gap["impact_count"].as_u64() > Some(0));
    assert_eq!(number("impact_count"), gap["impact_count"].as_f64());
    let forces = (number("peak_force_n"), gap["peak_force_n"].as_f64());
    let (Some(found), Some(expected)) = forces else {
        panic!("{forces:?}");
    };
    assert!((found / expected - 1.0).abs() < 1e-9, "{found} {expected}");
}

/// A file of comma-separated values: rows of fields, without their quotes.
fn fields(text: &str) -> Vec<Vec<String>> {
    let (mut rows, mut row, mut field) = (Vec::new(), Vec::new(), String::new());
    let (mut quoted, mut letters) = (false, text.chars().peekable());
    while let Some(letter) = letters.next() {
        match letter {
            '"' if quoted && letters.peek() == Some(&'"') => {
                field.push('"');
                letters.next();
            }
            '"' => quoted = !quoted,
            ',' if !quoted => row.push(std::mem::take(&mut field)),
            '\n' if !quoted => {
                row.push(std::mem::take(&mut field));
                rows.push(std::mem::take(&mut row));
            }
            other => field.push(other),
        }
    }
    rows
}

/// Zero demands are said where they are left out, and kept by the modified cloud.
#[test]
fn a_cloud_says_which_demands_it_leaves_out() {
    let folder = workplace(1);
    let text = |method: &str| {
        format!(
            r#"base = "towers.toml"
[[vary]]
name = "gap"
path = "gap[0].width"
distribution = {{ kind = "uniform", from = "5 mm", to = "60 mm" }}
[[vary]]
name = "pga"
path = "motion.pga"
distribution = {{ kind = "lognormal", median = "2 m/s2", dispersion = 0.5 }}
[design]
kind = "sobol"
samples = 128
seed = 7
[[fragility]]
intensity = "pga_m_s2"
demand = "peak_force_n"
threshold = "0.5 MN"
method = "{method}"
"#
        )
    };
    let mut middle = Vec::new();
    for method in ["cloud", "modified-cloud"] {
        std::fs::write(folder.path().join("c.toml"), text(method)).expect("written");
        let done = jostle(folder.path(), &["study", "c.toml", "--out", method]);
        assert!(done.status.success(), "{}", common::complained(&done));
        let out = folder.path().join(method);
        let table = std::fs::read_to_string(out.join("fragility.csv")).expect("a table");
        let rows = fields(&table);
        let value = |name: &str| {
            let at = rows[0].iter().position(|head| head == name);
            rows[1][at.unwrap_or_else(|| panic!("no column {name}"))].clone()
        };
        let cases = std::fs::read_to_string(out.join("cases.csv")).expect("a table");
        let cases = fields(&cases);
        let force = cases[0].iter().position(|head| head == "peak_force_n");
        let zeros = cases[1..]
            .iter()
            .filter(|row| force.is_some_and(|at| row[at] == "0"))
            .count();
        assert!(zeros > 20, "{zeros}");
        assert_eq!(value("zero_demands"), zeros.to_string());
        assert_eq!(value("cases"), "128");
        middle.push(value("median_pga_m_s2").parse::<f64>().unwrap_or(f64::NAN));
        let page = std::fs::read_to_string(out.join("report.html")).expect("a report");
        let printed = common::printed(&done);
        let sentence = format!("{zeros} of 128 demands are zero");
        let said = method == "cloud";
        assert_eq!(printed.contains(&sentence), said, "{printed}");
        assert_eq!(page.contains(&sentence), said);
        assert_eq!(value("remark").contains("left out"), said, "{table}");
        assert_eq!(value("nonzero_alpha1").is_empty(), said, "{table}");
    }
    assert!(
        middle[1] > 1.05 * middle[0],
        "{middle:?}: without zeros the curve is too high"
    );
}

/// Names that a spreadsheet would take for formulas are texts in every file of comma-separated values.
#[test]
fn names_reach_no_spreadsheet_as_formulas() {
    let folder = temporary();
    let model = TOWERS
        .replace("\"A\"", "\"=HYPERLINK(1)\"")
        .replace("\"B\"", "\"@SUM(A1), B\"")
        .replace(
            "storey_height = \"3 m\"\n[[gap]]",
            "storey_height = \"3 m\"\nhinges = { rule = \"bilinear\", yield = [\"5 mm\", \"5 mm\"], post_yield = 0.1 }\n[[gap]]",
        );
    std::fs::write(folder.path().join("towers.toml"), model).expect("written");
    let study = r#"base = "towers.toml"
[[vary]]
name = "-1+1"
path = "gap[0].width"
values = ["5 mm", "10 mm", "20 mm"]
[[vary]]
name = "+cmd"
path = "title"
values = ["=1+1", "-2", "@x"]
[[fragility]]
intensity = "pga_m_s2"
by = ["+cmd"]
[[ida]]
intensity = "pga_m_s2"
demand = "peak_force_n"
"#;
    std::fs::write(folder.path().join("s.toml"), study).expect("written");
    for arguments in [
        &["study", "s.toml", "--out", "out"][..],
        &["pushover", "towers.toml", "--out", "out"],
        &["motion", "convert", "el-centro", "out/motion.csv"],
    ] {
        let done = jostle(folder.path(), arguments);
        assert!(
            done.status.success(),
            "{arguments:?}: {}",
            common::complained(&done)
        );
    }
    let mut seen = Vec::new();
    for entry in std::fs::read_dir(folder.path().join("out"))
        .into_iter()
        .flatten()
        .flatten()
    {
        let path = entry.path();
        if path.extension().is_none_or(|extension| extension != "csv") {
            continue;
        }
        let text = std::fs::read_to_string(&path).expect("a table");
        for field in fields(&text).iter().flatten() {
            let formula = field.starts_with(['=', '+', '-', '@', '\t', '\r']);
            assert!(
                !formula || field.parse::<f64>().is_ok(),
                "{path:?}: {field}"
            );
        }
        seen.push(entry.file_name().to_string_lossy().into_owned());
    }
    seen.sort();
    assert_eq!(
        seen,
        [
            "cases.csv",
            "fragility-curves.csv",
            "fragility.csv",
            "ida.csv",
            "motion.csv",
            "pushover.csv"
        ]
    );
    let cases = std::fs::read_to_string(folder.path().join("out/cases.csv")).expect("a table");
    assert!(
        cases.contains("'-1+1")
            && cases.contains("'=1+1")
            && cases.contains("\"'@SUM(A1), B.period_s\""),
        "{cases}"
    );
}
