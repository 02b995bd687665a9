//! Modules import from the layers below them only.

use std::collections::BTreeSet;
use std::path::{Path, PathBuf};

/// From the bottom up. A module may import from those above it in this list, never from those below.
const LAYERS: [&str; 21] = [
    "simd",
    "linear",
    "contact",
    "hysteresis",
    "motion",
    "model",
    "structure",
    "transfer",
    "stiffness",
    "eigen",
    "statics",
    "interface",
    "check",
    "system",
    "history",
    "state",
    "stepping",
    "pushover",
    "separation",
    "method",
    "results",
];

#[test]
fn no_import_runs_up_the_layers() {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("src");
    let mut files = Vec::new();
    collect(&root, &mut files);
    let mut upward = Vec::new();
    let mut seen = BTreeSet::new();
    for file in files {
        let inside = file.strip_prefix(&root).expect("it was found there");
        let first = inside.iter().next().expect("a file has a name");
        let module = first.to_string_lossy().replace(".rs", "");
        if module == "lib" {
            continue;
        }
        let level = layer(&module);
        seen.insert(module.clone());
        let text = std::fs::read_to_string(&file).expect("a source file can be read");
        for imported in imports(&text) {
            if imported != module && layer(&imported) >= level {
                upward.push(format!("{} imports {imported}", inside.display()));
            }
        }
    }
    assert!(upward.is_empty(), "{}", upward.join("\n"));
    assert_eq!(
        seen.len(),
        LAYERS.len(),
        "every layer is a module: {seen:?}"
    );
}

#[test]
fn imports_are_read_from_code() {
    let text = "//! [`crate::stepping`]\nuse crate::{linear::{A, B}, motion::C};\nlet x = crate::model::WALL;\n\
                #[cfg(test)]\nmod tests {\n    use crate::results::Run;\n}\n";
    let found: Vec<String> = imports(text).collect();
    assert_eq!(found, ["linear", "motion", "model"]);
}

fn layer(module: &str) -> usize {
    let found = LAYERS.iter().position(|layer| *layer == module);
    found.unwrap_or_else(|| panic!("\"{module}\" has no place among the layers; give it one"))
}

fn collect(folder: &Path, files: &mut Vec<PathBuf>) {
    for entry in std::fs::read_dir(folder).expect("a source folder can be read") {
        let path = entry.expect("an entry can be read").path();
        let test_code = ["tests.rs", "testkit.rs"]
            .iter()
            .any(|name| path.ends_with(name));
        if path.is_dir() {
            collect(&path, files);
        } else if path.extension().is_some_and(|ending| ending == "rs") && !test_code {
            files.push(path);
        }
    }
}

/// Modules of this crate that a file names outside of comments and tests. Names that begin with a capital letter or
/// are functions stand at the root of the crate, which no file may import from.
fn imports(text: &str) -> impl Iterator<Item = String> {
    let code = text.split("#[cfg(test)]\nmod tests {").next().unwrap_or("");
    let lines = code
        .lines()
        .filter(|line| !line.trim_start().starts_with("//"));
    let code = lines.collect::<Vec<_>>().join("\n");
    let mut found = Vec::new();
    for (start, name) in code.match_indices("crate::") {
        let after = &code[start + name.len()..];
        if let Some(list) = after.strip_prefix('{') {
            let mut depth = 0;
            let mut item = String::new();
            for letter in list.chars() {
                match letter {
                    '{' => depth += 1,
                    '}' if depth == 0 => break,
                    '}' => depth -= 1,
                    ',' if depth == 0 => found.push(first_name(&std::mem::take(&mut item))),
                    _ => item.push(letter),
                }
            }
            found.push(first_name(&item));
        } else {
            found.push(first_name(after));
        }
    }
    found.into_iter().filter(|name| !name.is_empty())
}

fn first_name(path: &str) -> String {
    let name = path.trim_start().chars();
    name.take_while(|letter| letter.is_alphanumeric() || *letter == '_')
        .collect()
}
