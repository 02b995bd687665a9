//! A part that is damaged, of another study, or another part is never used: it is set aside and computed again.

use std::collections::BTreeMap;
use std::path::{Path, PathBuf};
use std::sync::Mutex;

use jostle_io::{Format, StudyFile};
use jostle_study::dataset::{missing_parts, part_path, read_columns};
use jostle_study::{Done, RunSettings, Study, StudyError, of_folder, run, settle};

const MODEL: &str = r#"
[model.motion]
kind = "sine"
amplitude = "3 m/s2"
period = "0.5 s"
duration = "1 s"
[[model.building]]
name = "A"
kind = "shear"
mass = ["40 t"]
stiffness = ["20 MN/m"]
storey_height = "3 m"
[[model.building]]
name = "B"
kind = "shear"
mass = ["60 t"]
stiffness = ["90 MN/m"]
storey_height = "3 m"
[[model.gap]]
between = ["A", "B"]
width = "5 mm"
[model.analysis]
tolerance = 0.01
"#;

/// 50 cases in four parts, the last of two cases.
fn study(seed: u64) -> Study {
    let text = format!(
        r#"
[design]
kind = "random"
samples = 50
seed = {seed}
[[vary]]
name = "gap"
path = "gap[0].width"
distribution = {{ kind = "uniform", from = "1 mm", to = "9 mm" }}
{MODEL}"#
    );
    let file = StudyFile::parse("study.toml", &text, Format::Toml, Path::new(""), None);
    Study::new(file.expect("a study file")).expect("a study")
}

fn shard(shard: u64, shards: u64) -> RunSettings {
    RunSettings {
        jobs: Some(2),
        shard,
        shards,
        only: None,
    }
}

/// Runs what is missing, and returns the remarks.
fn go(study: &Study, folder: &Path, settings: &RunSettings) -> (Done, Vec<String>) {
    let remarks = Mutex::new(Vec::new());
    let remark = |text: &str| {
        if let Ok(mut remarks) = remarks.lock() {
            remarks.push(text.to_owned());
        }
    };
    let done = run(study, folder, settings, &|| false, &|_| {}, &remark).expect("the study runs");
    (done, remarks.into_inner().expect("remarks"))
}

fn files(folder: PathBuf) -> BTreeMap<String, Vec<u8>> {
    let entries = std::fs::read_dir(folder).into_iter().flatten().flatten();
    let file = |entry: std::fs::DirEntry| {
        let name = entry.file_name().to_string_lossy().into_owned();
        (name, std::fs::read(entry.path()).unwrap_or_default())
    };
    entries.map(file).collect()
}

/// A finished folder, its table, and the path of its second part.
fn finished(study: &Study) -> (tempfile::TempDir, BTreeMap<String, Vec<u8>>, PathBuf) {
    let folder = tempfile::tempdir().expect("a folder");
    assert!(go(study, folder.path(), &RunSettings::default()).0.complete);
    let table = files(folder.path().join("cases"));
    let second = folder.path().join("cases/part-0000000016.parquet");
    assert!(second.is_file());
    (folder, table, second)
}

#[test]
fn flipped_bytes_are_noticed_and_their_part_is_computed_again() {
    let study = study(7);
    let (folder, table, second) = finished(&study);
    let whole = std::fs::read(&second).expect("a part");
    assert!(missing_parts(&study, folder.path()).is_empty());
    let mut damaged = whole.clone();
    for at in (0..whole.len()).step_by(61) {
        damaged[at] ^= 0x20;
        std::fs::write(&second, &damaged).expect("written");
        assert_eq!(missing_parts(&study, folder.path()), [1], "byte {at}");
        damaged[at] ^= 0x20;
    }
    // Of some of them the whole way: set aside, said, computed again with the same bits.
    let step = whole.len() / 12;
    for (number, at) in (0..whole.len()).step_by(step).enumerate() {
        damaged[at] ^= 0x10;
        std::fs::write(&second, &damaged).expect("written");
        let read = read_columns(&study, folder.path(), &["peak_force_n"]);
        assert!(
            matches!(&read, Err(StudyError::Output(text)) if text.contains("is damaged")),
            "{read:?}"
        );
        let (done, remarks) = go(&study, folder.path(), &RunSettings::default());
        assert!(done.complete);
        assert_eq!(done.progress.computed, 16);
        assert_eq!(remarks.len(), 1, "{remarks:?}");
        for part in [
            "is damaged",
            "part-0000000016",
            "set-aside",
            "cases 16 to 31 are computed again",
        ] {
            assert!(remarks[0].contains(part), "{part}: {remarks:?}");
        }
        assert!(files(folder.path().join("cases")) == table, "byte {at}");
        let kept = files(folder.path().join("set-aside"));
        assert_eq!(kept.len(), number + 1, "nothing is deleted");
        assert!(kept.values().any(|bytes| *bytes == damaged));
        damaged[at] ^= 0x10;
    }
}

#[test]
fn a_part_cut_short_anywhere_is_computed_again() {
    let study = study(7);
    let (folder, table, second) = finished(&study);
    let whole = std::fs::read(&second).expect("a part");
    for length in (0..whole.len()).step_by(211) {
        std::fs::write(&second, &whole[..length]).expect("written");
        assert_eq!(missing_parts(&study, folder.path()), [1], "{length} bytes");
    }
    for length in [0, 4, whole.len() / 2, whole.len() - 1] {
        std::fs::write(&second, &whole[..length]).expect("written");
        let (done, remarks) = go(&study, folder.path(), &RunSettings::default());
        assert!(done.complete && remarks.len() == 1, "{length}: {remarks:?}");
        assert!(
            files(folder.path().join("cases")) == table,
            "{length} bytes"
        );
    }
}

#[test]
fn a_part_of_another_study_is_set_aside() {
    let (one, other) = (study(7), study(8));
    let (folder, table, second) = finished(&one);
    let (_keep, foreign, _) = finished(&other);
    let name = "part-0000000016.parquet";
    assert_ne!(foreign[name], table[name]);
    std::fs::write(&second, &foreign[name]).expect("written");
    let (done, remarks) = go(&one, folder.path(), &RunSettings::default());
    assert!(done.complete && done.progress.computed == 16);
    assert!(
        remarks.len() == 1 && remarks[0].contains("belongs to another study"),
        "{remarks:?}"
    );
    assert!(files(folder.path().join("cases")) == table);
    let kept = files(folder.path().join("set-aside"));
    assert!(kept["part-0000000016.other-study.parquet"] == foreign[name]);
}

#[test]
fn a_part_under_the_name_of_another_is_set_aside() {
    let study = study(7);
    let (folder, table, second) = finished(&study);
    let first = &table["part-0000000000.parquet"];
    std::fs::write(&second, first).expect("written");
    // A name that no part of this study has: readers of all files would count its cases twice.
    std::fs::write(folder.path().join("cases/part-0000000005.parquet"), first).expect("written");
    let (done, remarks) = go(&study, folder.path(), &RunSettings::default());
    assert!(done.complete && done.progress.computed == 16);
    let said = remarks.join("\n");
    for part in [
        "holds cases 0 to 15 of this study instead of cases 16 to 31",
        "is no part of this study",
    ] {
        assert!(said.contains(part), "{part}: {said}");
    }
    assert!(files(folder.path().join("cases")) == table);
    let kept = files(folder.path().join("set-aside"));
    let names: Vec<&str> = kept.keys().map(String::as_str).collect();
    assert_eq!(
        names,
        [
            "part-0000000005.no-part.parquet",
            "part-0000000016.other-cases.parquet"
        ]
    );
}

/// The share that finishes a study verifies the parts of the others too.
#[test]
fn parts_of_other_shares_are_verified_before_the_study_counts_as_complete() {
    let (one, other) = (study(7), study(8));
    let (_first, table, _) = finished(&one);
    let folder = tempfile::tempdir().expect("a folder");
    let foreign = tempfile::tempdir().expect("a folder");
    go(&one, folder.path(), &shard(0, 2));
    go(&other, foreign.path(), &shard(1, 2));
    for (name, bytes) in files(foreign.path().join("cases")) {
        std::fs::write(folder.path().join("cases").join(name), bytes).expect("written");
    }
    let (done, remarks) = go(&one, folder.path(), &shard(0, 2));
    assert!(!done.complete, "half of the parts are of another study");
    assert_eq!(remarks.len(), 2, "{remarks:?}");
    assert!(
        remarks
            .iter()
            .all(|text| text.contains("belongs to another study"))
    );
    assert!(remarks.iter().all(|text| text.contains("run the share")));
    let (done, remarks) = go(&one, folder.path(), &shard(1, 2));
    assert!(done.complete && remarks.is_empty(), "{remarks:?}");
    assert!(files(folder.path().join("cases")) == table);
    let left = files(folder.path().join("under-way"));
    assert!(left.is_empty(), "{:?}", left.keys());
}

/// A pipe, a folder or a link to a device in the place of a part, a journal or the manifest is never opened.
#[cfg(unix)]
#[test]
fn what_is_no_file_is_set_aside_or_refused() {
    let odd = |kind: &str, path: &Path| match kind {
        "pipe" => {
            let made = std::process::Command::new("mkfifo").arg(path).status();
            assert!(made.expect("mkfifo").success());
        }
        "link" => std::os::unix::fs::symlink("/dev/zero", path).expect("a link"),
        _ => std::fs::create_dir(path).expect("a folder"),
    };
    let study = study(1);
    let whole = tempfile::tempdir().expect("a folder");
    go(&study, whole.path(), &shard(0, 1));
    let expected = files(whole.path().join("cases"));
    for kind in ["pipe", "link", "folder"] {
        let folder = tempfile::tempdir().expect("a folder");
        for inner in ["cases", "under-way"] {
            std::fs::create_dir(folder.path().join(inner)).expect("a folder");
        }
        settle(&study, folder.path()).expect("a manifest");
        let part = part_path(folder.path(), 0);
        odd(kind, &part);
        odd(
            kind,
            &folder.path().join("under-way/part-0000000016.journal"),
        );
        let (done, remarks) = go(&study, folder.path(), &shard(0, 1));
        assert!(done.complete, "{kind}");
        assert_eq!(remarks.len(), 2, "{kind}: {remarks:?}");
        assert!(
            remarks.iter().all(|text| text.contains("not a file")),
            "{remarks:?}"
        );
        assert_eq!(files(folder.path().join("cases")), expected, "{kind}");

        let manifest = folder.path().join("manifest.json");
        std::fs::remove_file(&manifest).expect("gone");
        odd(kind, &manifest);
        let error = of_folder(folder.path())
            .map(|_| ())
            .expect_err("no manifest");
        assert!(error.to_string().contains("not a file"), "{kind}: {error}");
    }
}
