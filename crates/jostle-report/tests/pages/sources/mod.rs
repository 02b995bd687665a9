//! Sources of pages as text: their literals, the messages that they ask for, and the words of a page.

use std::collections::BTreeSet;
use std::path::{Path, PathBuf};

/// A string literal.
#[derive(Debug, PartialEq)]
pub(crate) struct Literal {
    /// What stands between its quotes, without values in braces.
    pub(crate) text: String,
    /// Its line, from 1.
    pub(crate) line: usize,
    /// Whether it is content of an element in markup.
    content: bool,
}

impl Literal {
    /// Whether it reads like a text: two words beside each other, a capitalised word, or any word as content of an element.
    pub(crate) fn is_text(&self) -> bool {
        let text = self.text.trim();
        if text.contains(['=', ';', '<', '>', '#']) || text.contains("--") || text.contains("../") {
            return false;
        }
        // An outline.
        let mut begin = text.chars();
        if begin.next() == Some('M') && begin.next().is_some_and(|c| c.is_ascii_digit()) {
            return false;
        }
        let shown = without_values(text);
        let words: Vec<&str> = shown.split_whitespace().collect();
        let letters = |word: &str| word.chars().filter(char::is_ascii_alphabetic).count();
        let pair = words
            .windows(2)
            .any(|pair| letters(pair[0]) > 2 && letters(pair[1]) > 1);
        let starts = text.chars().next().is_some_and(char::is_uppercase);
        let lone = text.len() > 2 && text.chars().all(|c| c.is_ascii_lowercase());
        let capitalised = starts
            && text.len() > 2
            && text.chars().skip(1).take(2).all(|c| c.is_ascii_lowercase());
        pair || capitalised || (lone && self.content)
    }
}

fn without_values(text: &str) -> String {
    let mut shown = String::new();
    let mut depth = 0;
    for c in text.chars() {
        match c {
            '{' => depth += 1,
            '}' => depth -= 1,
            c if depth == 0 => shown.push(c),
            _ => {}
        }
    }
    shown
}

fn root() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("..")
}

fn collect(folder: &Path, ending: &str, files: &mut Vec<PathBuf>) {
    let mut entries: Vec<PathBuf> = std::fs::read_dir(folder)
        .unwrap()
        .map(|entry| entry.unwrap().path())
        .collect();
    entries.sort();
    for path in entries {
        if path.is_dir() {
            collect(&path, ending, files);
        } else if path.extension().is_some_and(|found| found == ending) {
            files.push(path);
        }
    }
}

/// Name and text of the sources that write pages, without their tests.
pub(crate) fn pages() -> Vec<(String, String)> {
    let mut files = Vec::new();
    collect(&root().join("jostle-report/src"), "rs", &mut files);
    files.retain(|file| !file.components().any(|part| part.as_os_str() == "message"));
    files.extend(
        [
            "jostle-live/src/page.rs",
            "jostle-run/src/gap_page.rs",
            "jostle-study/src/size/page.rs",
            "jostle-study/src/suite/page.rs",
        ]
        .map(|file| root().join(file)),
    );
    collect(&root().join("jostle-study/src/results"), "rs", &mut files);
    named(&files)
}

/// Name and text of the scripts of pages.
pub(crate) fn scripts() -> Vec<(String, String)> {
    let mut files = Vec::new();
    collect(&root().join("jostle-report/assets"), "js", &mut files);
    collect(&root().join("jostle-live/assets"), "js", &mut files);
    named(&files)
}

/// Texts of all Rust sources of crates that write pages, but the table itself.
pub(crate) fn all_sources() -> Vec<String> {
    let mut files = Vec::new();
    for name in [
        "jostle-report",
        "jostle-run",
        "jostle-live",
        "jostle-study",
        "jostle-cli",
    ] {
        collect(&root().join(name).join("src"), "rs", &mut files);
    }
    files.retain(|file| !file.ends_with("message/english.rs"));
    named(&files).into_iter().map(|(_, text)| text).collect()
}

fn named(files: &[PathBuf]) -> Vec<(String, String)> {
    let read = |file: &PathBuf| {
        let text = std::fs::read_to_string(file).unwrap();
        let code = text.split("#[cfg(test)]\nmod ").next().unwrap().to_owned();
        let name = file.strip_prefix(root()).unwrap();
        (name.display().to_string(), code)
    };
    files.iter().map(read).collect()
}

/// String literals of Rust, without those of attributes of items and of remarks.
pub(crate) fn rust_literals(source: &str) -> Vec<Literal> {
    let code: Vec<char> = source.chars().collect();
    let mut found = Vec::new();
    let (mut i, mut line, mut attribute) = (0, 1, false);
    while i < code.len() {
        match code[i] {
            '\n' => {
                line += 1;
                attribute = false;
                i += 1;
            }
            '/' if code.get(i + 1) == Some(&'/') => {
                while i < code.len() && code[i] != '\n' {
                    i += 1;
                }
            }
            '#' if code.get(i + 1) == Some(&'[') => {
                attribute = true;
                i += 1;
            }
            '\'' => i += character(&code[i..]),
            '"' => {
                let begin = i + 1;
                i = begin;
                while i < code.len() && code[i] != '"' {
                    i += if code[i] == '\\' { 2 } else { 1 };
                }
                let text: String = code[begin..i.min(code.len())].iter().collect();
                i += 1;
                let before = code[..begin - 1].iter().rev().find(|c| !c.is_whitespace());
                let after = code[i.min(code.len())..]
                    .iter()
                    .find(|c| !c.is_whitespace());
                let content = matches!(before, Some('{' | '}' | ';'))
                    && matches!(after, Some('}' | '(' | 'b' | 's'));
                let lines = text.matches('\n').count();
                if !attribute {
                    found.push(Literal {
                        text,
                        line,
                        content,
                    });
                }
                line += lines;
            }
            _ => i += 1,
        }
    }
    found
}

/// Length of a character literal, or of the tick of a lifetime.
fn character(code: &[char]) -> usize {
    match code {
        ['\'', '\\', ..] => code.iter().skip(2).position(|c| *c == '\'').unwrap_or(0) + 3,
        ['\'', _, '\'', ..] => 3,
        _ => 1,
    }
}

/// String and template literals of a script, line by line, without values.
pub(crate) fn script_literals(source: &str) -> Vec<Literal> {
    let mut found = Vec::new();
    for (number, line) in source.lines().enumerate() {
        if line.trim_start().starts_with(['*', '/']) {
            continue;
        }
        let line = line.split(" // ").next().unwrap();
        for quote in ['"', '`'] {
            for text in line.split(quote).skip(1).step_by(2) {
                found.push(Literal {
                    text: without_values(&text.replace('$', "")),
                    line: number + 1,
                    content: false,
                });
            }
        }
    }
    found
}

/// Names in braces of a message.
pub(crate) fn names(text: &str) -> Vec<&str> {
    text.split('{')
        .skip(1)
        .filter_map(|after| Some(after.split_once('}')?.0))
        .collect()
}

/// Keys that a script asks for, with the names of the values that it gives.
pub(crate) fn asked(source: &str) -> Vec<(String, Vec<String>)> {
    let mut found = Vec::new();
    for after in source.split("say(\"").skip(1) {
        let (key, rest) = after.split_once('"').unwrap();
        let mut values = Vec::new();
        if let Some(inside) = rest.strip_prefix(", {") {
            let (mut depth, mut name, mut naming) = (0, String::new(), true);
            for c in inside.chars() {
                match c {
                    '}' if depth == 0 => break,
                    '(' | '[' | '{' => depth += 1,
                    ')' | ']' | '}' => depth -= 1,
                    ':' if depth == 0 => naming = false,
                    ',' if depth == 0 => {
                        values.push(std::mem::take(&mut name));
                        naming = true;
                    }
                    c if naming && (c.is_alphanumeric() || c == '_') => name.push(c),
                    _ => {}
                }
            }
            values.push(name);
            values.retain(|name| !name.is_empty());
        }
        found.push((key.to_owned(), values));
    }
    found
}

/// Keys that Rust asks for.
pub(crate) fn called(source: &str) -> BTreeSet<String> {
    let calls = source.split("message::").skip(1);
    calls
        .map(|after| {
            after
                .chars()
                .take_while(|c| c.is_alphanumeric() || *c == '_')
                .collect()
        })
        .collect()
}

/// What a reader of a page sees or hears: contents of elements, titles and labels, without entities.
pub(crate) fn shown(page: &str) -> Vec<String> {
    let mut nodes = Vec::new();
    let mut rest = page;
    while let Some((before, after)) = rest.split_once('<') {
        nodes.push(before.trim().to_owned());
        let (tag, after) = after.split_once('>').unwrap_or((after, ""));
        for attribute in ["title=\"", "aria-label=\"", "placeholder=\""] {
            if let Some((_, value)) = tag.split_once(attribute) {
                nodes.push(value.split('"').next().unwrap().trim().to_owned());
            }
        }
        let hidden = ["style", "script", "pre", "code"]
            .into_iter()
            .find(|name| tag.split_whitespace().next() == Some(*name));
        rest = match hidden {
            Some(name) => after
                .split_once(&format!("</{name}>"))
                .map_or("", |(_, after)| after),
            None => after,
        };
    }
    nodes.retain(|node| !node.is_empty());
    nodes
}
