//! Files are read by one function, which refuses what is no plain file and what is too large.

use std::path::{Path, PathBuf};

/// Words that open a file for reading.
const WORDS: [&str; 5] = [
    "File::open",
    "fs::read(",
    "read_to_string(&",
    "fs::read_to_string",
    "OpenOptions::new",
];

/// Files that may contain them: the opener itself; the ends of results that are to be replaced, whose kind was looked at;
/// claims and journals, which are locked; what the tests of the workspace read.
const MAY: [&str; 4] = [
    "jostle-run/src/claim.rs",
    "jostle-io/src/files.rs",
    "jostle-run/src/replace.rs",
    "jostle-study/src/dataset/journal.rs",
];

fn sources(folder: &Path, into: &mut Vec<PathBuf>) {
    for entry in std::fs::read_dir(folder).expect("a folder").flatten() {
        let path = entry.path();
        if path.is_dir() {
            sources(&path, into);
        } else if path.extension().is_some_and(|end| end == "rs") {
            into.push(path);
        }
    }
}

#[test]
fn nothing_else_opens_files() {
    let crates = Path::new(env!("CARGO_MANIFEST_DIR")).join("..");
    let mut found = Vec::new();
    for entry in std::fs::read_dir(&crates).expect("the crates").flatten() {
        let name = entry.file_name().to_string_lossy().into_owned();
        if matches!(&name[..], "jostle-testkit" | "jostle-validation") {
            continue;
        }
        let mut files = Vec::new();
        sources(&entry.path().join("src"), &mut files);
        for file in files {
            let text = std::fs::read_to_string(&file).expect("a source");
            // Unit tests stand at the end.
            let code = text.split("#[cfg(test)]\nmod ").next().unwrap_or_default();
            let shown = file
                .strip_prefix(&crates)
                .expect("inside")
                .display()
                .to_string();
            if MAY.contains(&&shown[..]) {
                continue;
            }
            let lines = code.lines().enumerate();
            let opens = lines.filter(|(_, line)| WORDS.iter().any(|word| line.contains(word)));
            found.extend(opens.map(|(at, line)| format!("{shown}:{}: {}", at + 1, line.trim())));
        }
    }
    assert!(
        found.is_empty(),
        "use jostle_io::read_file or Files:\n{}",
        found.join("\n")
    );
}
