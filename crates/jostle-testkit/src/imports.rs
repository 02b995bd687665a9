//! Which modules of its own crate a source file imports from.

use std::path::{Path, PathBuf};

/// Adds the source files below a folder, without those of unit tests.
pub fn collect(folder: &Path, files: &mut Vec<PathBuf>) {
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
pub fn imports(text: &str) -> impl Iterator<Item = String> {
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
