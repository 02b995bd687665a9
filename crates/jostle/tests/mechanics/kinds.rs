//! Few files of the mechanics ask whether a building has a plan, or which kind it is.

use std::path::Path;

use jostle_testkit::imports::collect;

/// Files that ask whether a building, a model or a system has a plan. A smaller number replaces it; a greater one is a fault of design:
/// what differs belongs into the data of its nodes ([`jostle::structure::Influence`]) or of its list of peaks.
const ASK_FOR_A_PLAN: usize = 20;

/// Files that name a kind of building.
const NAME_A_KIND: usize = 26;

fn files_with(words: &[&str]) -> Vec<String> {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("src");
    let mut files = Vec::new();
    collect(&root, &mut files);
    let asks = files.into_iter().filter_map(|file| {
        let text = std::fs::read_to_string(&file).expect("a source file can be read");
        let code = text.split("#[cfg(test)]").next().unwrap_or_default();
        let lines = code
            .lines()
            .filter(|line| !line.trim_start().starts_with("//"));
        let found = lines.flat_map(|line| words.iter().filter(|word| line.contains(**word)));
        let inside = file.strip_prefix(&root).expect("it was found there");
        (found.count() > 0).then(|| inside.display().to_string())
    });
    let mut asks: Vec<String> = asks.collect();
    asks.sort();
    asks
}

#[test]
fn few_files_ask_for_a_plan() {
    let found = files_with(&["is_in_space", "moves_across", "stick_model.in_plan"]);
    assert!(found.len() <= ASK_FOR_A_PLAN, "{}: {found:?}", found.len());
    assert!(found.iter().any(|file| file.ends_with("building.rs")));
}

#[test]
fn few_files_name_kinds_of_buildings() {
    let kinds = ["Frame", "Shear", "Given", "Tiers"].map(|kind| format!("Structure::{kind}"));
    let kinds: Vec<&str> = kinds.iter().map(String::as_str).collect();
    let found = files_with(&kinds);
    assert!(found.len() <= NAME_A_KIND, "{}: {found:?}", found.len());
}
