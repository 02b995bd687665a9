//! Modules import from the layers below them only.

use std::collections::BTreeSet;
use std::path::Path;

use jostle_testkit::imports::{collect, imports};

/// From the bottom up. A module may import from those above it in this list, never from those below.
const LAYERS: [&str; 23] = [
    "simd",
    "quantity",
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
    "judgement",
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
