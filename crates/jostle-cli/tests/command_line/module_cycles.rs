//! Modules of a crate do not import each other in a ring.

use std::collections::{BTreeMap, BTreeSet};
use std::path::Path;

use jostle_testkit::imports::{collect, imports};

/// Modules, each with those that it imports from.
type Imports = BTreeMap<String, BTreeSet<String>>;

#[test]
fn no_crate_has_a_ring_of_modules() {
    let crates = Path::new(env!("CARGO_MANIFEST_DIR")).join("..");
    let entries = std::fs::read_dir(crates).expect("the folder of crates can be read");
    let mut found = Vec::new();
    let mut read = 0;
    for entry in entries {
        let root = entry.expect("an entry can be read").path();
        let name = root.file_name().expect("a crate has a name");
        let name = name.to_string_lossy().into_owned();
        if !root.join("src").is_dir() {
            continue;
        }
        read += 1;
        for ring in rings(&modules(&root.join("src"))) {
            found.push(format!("{name}: {}", ring.join(", ")));
        }
    }
    assert!(read > 5, "{read} crates");
    assert!(found.is_empty(), "rings of modules:\n{}", found.join("\n"));
}

#[test]
fn a_ring_is_found_and_named() {
    let imports = |list: &[(&str, &[&str])]| -> Imports {
        let names_of = |names: &[&str]| names.iter().map(|name| (*name).to_owned()).collect();
        list.iter()
            .map(|(name, names)| ((*name).to_owned(), names_of(names)))
            .collect()
    };
    let chain = imports(&[("a", &["b", "c"]), ("b", &["c"]), ("c", &[])]);
    assert!(rings(&chain).is_empty());
    let ring = imports(&[("a", &["b"]), ("b", &["c"]), ("c", &["a"]), ("d", &["a"])]);
    assert_eq!(rings(&ring), [["a", "b", "c"]]);
}

/// The top-level modules of a crate, files or folders.
fn modules(root: &Path) -> Imports {
    let mut files = Vec::new();
    collect(root, &mut files);
    let mut found = Imports::new();
    for file in &files {
        let inside = file.strip_prefix(root).expect("it was found there");
        let first = inside.iter().next().expect("a file has a name");
        let module = first.to_string_lossy().replace(".rs", "");
        if matches!(&module[..], "lib" | "main" | "bin") {
            continue;
        }
        let text = std::fs::read_to_string(file).expect("a source file can be read");
        let names = found.entry(module.clone()).or_default();
        names.extend(imports(&text).filter(|name| *name != module));
    }
    found
}

/// Groups of modules that reach each other.
fn rings(modules: &Imports) -> Vec<Vec<String>> {
    let reached: BTreeMap<&String, BTreeSet<&String>> = modules
        .keys()
        .map(|module| (module, reach(modules, module)))
        .collect();
    let mut found: Vec<Vec<String>> = Vec::new();
    for (module, others) in &reached {
        let known = found.iter().any(|ring| ring.contains(module));
        if known || !others.contains(*module) {
            continue;
        }
        let ring = others
            .iter()
            .filter(|other| reached[**other].contains(*module));
        found.push(ring.map(|other| (*other).clone()).collect());
    }
    found
}

/// Modules that one reaches by imports of imports; itself only if there is a ring.
fn reach<'a>(modules: &'a Imports, from: &str) -> BTreeSet<&'a String> {
    let mut seen = BTreeSet::new();
    let mut next: Vec<&String> = modules[from].iter().collect();
    while let Some(module) = next.pop() {
        // Functions and types at the root are no modules.
        if let Some((name, imports)) = modules.get_key_value(module)
            && seen.insert(name)
        {
            next.extend(imports);
        }
    }
    seen
}
