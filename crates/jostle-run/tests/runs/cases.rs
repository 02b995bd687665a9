//! Cases that follow each other share what they have in common, and nothing else.

use std::path::Path;
use std::sync::Arc;

use jostle::{Analysis, Model};
use jostle_io::{Format, Input, ModelTree, template};
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

/// What a system is made of: all of a model but its title and its steps.
fn made_of(input: &Input) -> Model {
    Model {
        title: String::new(),
        analysis: Analysis {
            members: input.model.analysis.members.clone(),
            link_motion: input.model.analysis.link_motion,
            ..Analysis::default()
        },
        ..input.model.clone()
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

/// Models of the reader.
const MODELS: [&str; 7] = [
    "bearings.toml",
    "embedded.toml",
    "foundations.toml",
    "frames_of_many_parts.toml",
    "lifting.toml",
    "plans.toml",
    "vertical.toml",
];

/// Every number of some models, changed alone after the model as it is: what cases share makes no difference.
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
    for name in MODELS {
        let text = std::fs::read_to_string(folder.join(name)).expect("a text");
        texts.push((name.to_owned(), text));
    }
    let mut compared = 0;
    for (name, text) in texts {
        let parse = || ModelTree::parse(&name, &text, Format::Toml, folder);
        let tree = parse().unwrap_or_else(|error| panic!("{error}"));
        let shared = CaseCache::default();
        let Ok(Ok(base)) = tree.input().map(|input| shared.assemble(input)) else {
            continue;
        };
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
            if made_of(&input) != made_of(&base.input) {
                let kept = Arc::ptr_eq(&after.system, &base.system);
                assert!(!kept, "{name}: {path} has the system of the model as it is");
            }
            // Other gaps between the same buildings.
            if path.starts_with("gap") && TEMPLATES.contains(&&name[..]) {
                let alone = CaseCache::default().assemble(input);
                let alone = alone.unwrap_or_else(|error| panic!("{error}"));
                assert!(facts(&alone) == facts(&after), "{name}: {path}");
            }
            compared += 1;
        }
    }
    assert!(compared > 80, "{compared} numbers");
}

/// A page that stays open runs the record that is there now.
#[test]
fn a_record_that_was_written_again_is_read_again() {
    let folder = tempfile::tempdir().expect("a folder");
    let text = "motion = { record = \"r.csv\" }\n[[building]]\nname = \"A\"\nkind = \"shear\"\nmass = \"40 t\"\nstiffness = \"60 MN/m\"\nstoreys = 2\n";
    let cache = CaseCache::default();
    let peak_of = |values: &[f64]| {
        let lines: Vec<String> = values.iter().map(f64::to_string).collect();
        let record = format!("# unit = m/s2\n# step = 0.01\n{}\n", lines.join("\n"));
        std::fs::write(folder.path().join("r.csv"), record).expect("written");
        let tree = ModelTree::parse("m", text, Format::Toml, folder.path());
        let input = tree.expect("a model").input().expect("sound");
        cache.assemble(input).map(|case| case.motion.peak()).ok()
    };
    let wave = [0.0, 1.0, -0.5, 0.2, 0.1, -0.1, 0.0];
    assert_eq!(peak_of(&wave), Some(1.0));
    // Longer, so that clocks that count in seconds do not matter.
    let higher: Vec<f64> = wave.iter().map(|value| 2.25 * value).collect();
    assert_eq!(peak_of(&higher), Some(2.25));
}
