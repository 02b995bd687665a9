//! Files that exist already, and completions.

use crate::common::{complained, folder, jostle, printed};

const SMALL: &str = r#"title = "small"
motion = { kind = "sine", amplitude = "1 m/s2", period = "0.5 s", duration = "1 s" }
[[building]]
name = "A"
kind = "shear"
mass = "40 t"
stiffness = "60 MN/m"
storeys = 2
"#;

const EXPORT: [&str; 6] = [
    "export",
    "small.toml",
    "--to",
    "openseespy",
    "-o",
    "small.py",
];

fn with_model() -> tempfile::TempDir {
    let folder = folder();
    std::fs::write(folder.path().join("small.toml"), SMALL).expect("written");
    folder
}

#[test]
fn export_replaces_its_own_scripts_and_nothing_else() {
    let folder = with_model();
    let path = folder.path().join("small.py");
    std::fs::write(&path, "print('mine')\n").expect("written");
    let output = jostle(folder.path(), &EXPORT);
    assert_eq!(output.status.code(), Some(2));
    let complaint = complained(&output);
    assert!(complaint.contains("small.py exists already"), "{complaint}");
    assert!(complaint.contains("--force"), "{complaint}");
    let kept = std::fs::read_to_string(&path).expect("kept");
    assert_eq!(kept, "print('mine')\n");

    let output = jostle(folder.path(), &[&EXPORT[..], &["--force"]].concat());
    assert!(output.status.success(), "{}", complained(&output));
    assert!(complained(&output).contains("replaced: small.py"));

    let output = jostle(folder.path(), &EXPORT);
    assert!(output.status.success(), "{}", complained(&output));
    assert!(complained(&output).contains("replaced: small.py"));
}

#[test]
fn export_fills_an_empty_file() {
    let folder = with_model();
    std::fs::write(folder.path().join("small.py"), "").expect("written");
    let output = jostle(folder.path(), &EXPORT);
    assert!(output.status.success(), "{}", complained(&output));
    assert!(complained(&output).contains("written: small.py"));
}

#[test]
fn a_second_run_says_that_it_replaces_the_first() {
    let folder = with_model();
    let arguments = ["run", "small.toml", "--out", "results", "--json"];
    let first = jostle(folder.path(), &arguments);
    assert!(first.status.success(), "{}", complained(&first));
    assert!(!complained(&first).contains("earlier run"));
    let second = jostle(folder.path(), &arguments);
    assert!(second.status.success(), "{}", complained(&second));
    let remark = complained(&second);
    for part in [
        "results holds results of an earlier run",
        "summary.json, history.parquet, buildings.parquet, floors.parquet, impacts.parquet, report.html",
    ] {
        assert!(remark.contains(part), "\"{part}\" in: {remark}");
    }
    let summary: serde_json::Value =
        serde_json::from_str(&printed(&second)).expect("nothing but JSON");
    assert_eq!(summary["title"], "small");
}

#[test]
fn a_run_does_not_replace_files_of_others() {
    for name in ["summary.json", "history.parquet", "report.html"] {
        let folder = with_model();
        let results = folder.path().join("results");
        std::fs::create_dir(&results).expect("made");
        let mine = "{\"title\": \"my thesis\", \"chapters\": 7}\n";
        std::fs::write(results.join(name), mine).expect("written");
        let arguments = ["run", "small.toml", "--out", "results", "--json"];
        let output = jostle(folder.path(), &arguments);
        assert_eq!(output.status.code(), Some(2), "{}", complained(&output));
        assert_eq!(printed(&output), "");
        let complaint = complained(&output);
        assert!(complaint.contains(name), "{complaint}");
        assert!(complaint.contains("--force"), "{complaint}");
        let kept = std::fs::read_to_string(results.join(name)).expect("kept");
        assert_eq!(kept, mine);
        let files = std::fs::read_dir(&results).expect("a folder").count();
        assert_eq!(files, 1, "nothing beside it");
        let output = jostle(folder.path(), &[&arguments[..], &["--force"]].concat());
        assert!(output.status.success(), "{}", complained(&output));
        assert!(complained(&output).contains("replaced: "));
    }
}

#[test]
fn motions_are_replaced_only_when_asked() {
    let folder = folder();
    let arguments = ["motion", "convert", "el-centro-1940-ns", "new.csv"];
    let output = jostle(folder.path(), &arguments);
    assert!(output.status.success(), "{}", complained(&output));
    let output = jostle(folder.path(), &arguments);
    assert_eq!(output.status.code(), Some(2));
    assert!(complained(&output).contains("new.csv exists already"));
    let output = jostle(folder.path(), &[&arguments[..], &["--force"]].concat());
    assert!(output.status.success(), "{}", complained(&output));
    assert!(complained(&output).contains("replaced: new.csv"));
}

#[test]
fn completions_know_the_commands_of_every_shell() {
    let folder = folder();
    for shell in ["bash", "zsh", "fish", "powershell", "elvish"] {
        let output = jostle(folder.path(), &["completions", shell]);
        assert!(output.status.success(), "{}", complained(&output));
        let script = printed(&output);
        for part in ["pushover", "completions", "no-report"] {
            assert!(script.contains(part), "{shell}: {part}");
        }
    }
    let wrong = jostle(folder.path(), &["completions", "cmd"]);
    assert_eq!(wrong.status.code(), Some(2));
    assert!(complained(&wrong).contains("powershell"));
}

#[test]
fn manual_pages_cover_every_command() {
    let folder = folder();
    let output = jostle(folder.path(), &["man", "new/man1"]);
    assert!(output.status.success(), "{}", complained(&output));
    let page = |name: &str| {
        let path = folder.path().join("new/man1").join(name);
        std::fs::read_to_string(path).unwrap_or_else(|error| panic!("{name}: {error}"))
    };
    assert!(page("jostle.1").contains("jostle\\-pushover(1)"));
    assert!(page("jostle-run.1").contains("no\\-report"));
    // Commands of commands have theirs.
    assert!(page("jostle-motion-spectrum.1").contains("damping"));
    // Every page begins with its title and its name.
    for entry in std::fs::read_dir(folder.path().join("new/man1")).expect("a folder") {
        let name = entry.expect("an entry").file_name();
        let name = name.to_string_lossy();
        let text = page(&name);
        let stem = name.trim_end_matches(".1");
        assert!(
            text.contains(&format!(".TH {} 1", stem.to_uppercase())),
            "{name}"
        );
        assert!(text.contains(&stem.replace('-', "\\-")), "{name}");
    }
}

#[test]
fn completions_for_bash_are_a_sound_script() {
    let folder = folder();
    let output = jostle(folder.path(), &["completions", "bash"]);
    let path = folder.path().join("jostle.bash");
    std::fs::write(&path, &output.stdout).expect("written");
    let Ok(checked) = std::process::Command::new("bash")
        .arg("-n")
        .arg(&path)
        .output()
    else {
        return;
    };
    assert!(checked.status.success(), "{}", complained(&checked));
    assert!(checked.stderr.is_empty(), "{}", complained(&checked));
}

const COLLIDE: [&str; 13] = [
    "collide",
    "--m1",
    "40 t",
    "--m2",
    "60 t",
    "--speed",
    "0.5 m/s",
    "--law",
    "kelvin",
    "--stiffness",
    "60 MN/m",
    "--restitution",
    "0.65",
];

const SECTION: [&str; 7] = [
    "section", "--width", "500mm", "--depth", "500mm", "--bars", "12 d20",
];

/// Every other command that writes a file: the file, and whether a second call replaces it without being asked.
#[test]
fn every_command_keeps_files_that_it_did_not_write() {
    let cases: [(&[&str], &[&str], &str); 10] = [
        (&COLLIDE, &["--csv", "a.csv"], "a.csv"),
        (&COLLIDE, &["--html", "a.html"], "a.html"),
        (&SECTION, &["--html", "b.html"], "b.html"),
        (&["pushover", "small.toml"], &["--out", "."], "pushover.csv"),
        (
            &["pushover", "small.toml"],
            &["--out", "."],
            "pushover.json",
        ),
        (
            &["pushover", "small.toml"],
            &["--out", "."],
            "pushover.html",
        ),
        (&["method", "small.toml"], &["--out", "."], "method.html"),
        (
            &["motion", "show", "el-centro-1940-ns"],
            &["--html", "c.html"],
            "c.html",
        ),
        (
            &["motion", "spectrum", "el-centro-1940-ns"],
            &["--csv", "d.csv", "--parquet", "d.parquet"],
            "d.parquet",
        ),
        (&SELECT, &["--html", "e.html"], "e.html"),
    ];
    for (command, option, name) in cases {
        let folder = with_model();
        let path = folder.path().join(name);
        let arguments = [command, option].concat();
        std::fs::write(&path, "the user's own\n").expect("written");
        let output = jostle(folder.path(), &arguments);
        let complaint = complained(&output);
        assert_eq!(output.status.code(), Some(2), "{arguments:?}: {complaint}");
        assert!(complaint.contains("--force"), "{arguments:?}: {complaint}");
        let kept = std::fs::read_to_string(&path).expect("kept");
        assert_eq!(kept, "the user's own\n", "{arguments:?}");
        let files = std::fs::read_dir(folder.path()).expect("a folder").count();
        assert_eq!(
            files, 2,
            "{arguments:?} wrote another file before it refused"
        );

        let forced = jostle(folder.path(), &[&arguments[..], &["--force"]].concat());
        // A set of one motion fails its code: exit code 1, after its page is written.
        let done = |code| matches!(code, Some(0 | 1));
        assert!(done(forced.status.code()), "{}", complained(&forced));
        assert!(complained(&forced).contains("replaced: "), "{arguments:?}");
        let again = jostle(folder.path(), &arguments);
        assert!(
            done(again.status.code()),
            "{arguments:?} refuses its own file: {}",
            complained(&again)
        );
        assert!(complained(&again).contains("replaced: "), "{arguments:?}");
    }
}

const SELECT: [&str; 16] = [
    "motion",
    "select",
    "--natural",
    "el-centro-1940-ns",
    "--periods",
    "1",
    "--code",
    "gb50011",
    "--intensity",
    "7",
    "--site",
    "II",
    "--group",
    "1",
    "--damping",
    "0.05",
];

#[test]
fn a_run_leaves_no_file_of_an_earlier_run_of_another_model() {
    let folder = with_model();
    let hinged = SMALL.to_owned()
        + "hinges = { rule = \"bilinear\", yield = \"2 mm\", post_yield = 0.05 }\n";
    std::fs::write(folder.path().join("hinged.toml"), hinged).expect("written");
    let results = folder.path().join("results");
    let run = |arguments: &[&str]| {
        let output = jostle(
            folder.path(),
            &[&["run", "--out", "results"], arguments].concat(),
        );
        assert!(output.status.success(), "{}", complained(&output));
    };
    run(&["hinged.toml"]);
    assert!(results.join("hinges.parquet").exists() && results.join("report.html").exists());
    std::fs::write(results.join("notes.txt"), "mine").expect("written");
    run(&["small.toml"]);
    assert!(!results.join("hinges.parquet").exists() && results.join("report.html").exists());
    run(&["small.toml", "--no-report"]);
    assert!(!results.join("report.html").exists() && results.join("notes.txt").exists());
}
