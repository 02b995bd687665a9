//! Cases that follow each other share what they have in common, and nothing else.

use std::path::Path;

use jostle_io::{Format, ModelTree, template};
use jostle_run::{CaseCache, Prepared};
use toml::Value;

/// Paths of everything in a table that is a number, with a unit or without.
fn numbers(value: &Value, path: &str, found: &mut Vec<String>) {
    match value {
        Value::Table(table) => {
            for (key, value) in table {
                let dot = if path.is_empty() { "" } else { "." };
                numbers(value, &format!("{path}{dot}{key}"), found);
            }
        }
        Value::Array(list) => {
            for (index, value) in list.iter().enumerate() {
                numbers(value, &format!("{path}[{index}]"), found);
            }
        }
        Value::Integer(_) | Value::Float(_) => found.push(path.to_owned()),
        Value::String(text) if text.starts_with(|first: char| first.is_ascii_digit()) => {
            found.push(path.to_owned());
        }
        _ => {}
    }
}

/// All that steps depend on.
fn facts(prepared: &Prepared) -> String {
    let Prepared {
        system,
        motion,
        plan,
        ..
    } = prepared;
    format!("{system:?}\n{motion:?}\n{plan:?}")
}

/// Templates with what models of the reader lack: contact laws, links, walls of a site.
const TEMPLATES: [&str; 3] = ["towers", "heritage", "isolated-moat"];

/// Every number of many models, changed alone after the model as it is: what cases share makes no difference.
#[test]
fn every_number_changes_what_it_changes_without_other_cases() {
    let folder = Path::new(concat!(
        env!("CARGO_MANIFEST_DIR"),
        "/../jostle-io/tests/reading/models"
    ));
    let mut texts: Vec<(String, String)> = TEMPLATES
        .into_iter()
        .map(|name| {
            let text = template(name, "title").expect("it is there");
            (name.to_owned(), text)
        })
        .collect();
    for entry in std::fs::read_dir(folder).expect("the folder") {
        let path = entry.expect("an entry").path();
        if path.extension().is_some_and(|ending| ending == "toml") {
            let text = std::fs::read_to_string(&path).expect("a text");
            texts.push((path.display().to_string(), text));
        }
    }
    let mut compared = 0;
    for (name, text) in texts {
        let parse = || ModelTree::parse(&name, &text, Format::Toml, folder);
        let tree = parse().unwrap_or_else(|error| panic!("{error}"));
        let shared = CaseCache::default();
        let Ok(Ok(base)) = tree.input().map(|input| shared.assemble(input)) else {
            continue;
        };
        let before = facts(&base);
        let table: toml::Table = text.parse().expect("a table");
        let mut paths = Vec::new();
        numbers(&Value::Table(table), "", &mut paths);
        for path in paths {
            let mut changed = tree.clone();
            if changed.multiply(&path, 1.0009765625).is_err() {
                continue;
            }
            let Ok(input) = changed.input() else { continue };
            let Ok(after) = shared.assemble(input.clone()) else {
                continue;
            };
            // What differs from the model as it is was made anew, or has other gaps.
            let after = facts(&after);
            if after == before || input.model.gaps != base.input.model.gaps {
                let alone = CaseCache::default().assemble(input);
                let alone = alone.unwrap_or_else(|error| panic!("{error}"));
                assert!(facts(&alone) == after, "{name}: {path}");
            }
            compared += 1;
        }
    }
    assert!(compared > 400, "{compared} numbers");
}
