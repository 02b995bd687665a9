//! Names by which a file silences checks.

use super::CHECKS;

/// The parts of checks of a name: an identifier such as `A2` stands for all its parts, a name for one. `None` if there is none.
#[must_use]
pub fn named(name: &str) -> Option<Vec<&'static str>> {
    let found = CHECKS
        .iter()
        .filter(|check| check.name == name || check.id.eq_ignore_ascii_case(name));
    let found: Vec<&'static str> = found.map(|check| check.name).collect();
    (!found.is_empty()).then_some(found)
}

/// All names and identifiers.
#[must_use]
pub fn names() -> Vec<&'static str> {
    let mut names: Vec<&'static str> = CHECKS.iter().flat_map(|c| [c.id, c.name]).collect();
    names.dedup();
    names
}
