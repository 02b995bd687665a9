//! `[[building.damper]]`: links between two floors of one building, in short.

use jostle::model::LEVEL_TOLERANCE;
use jostle::{FloorPairs, Level, Link};

use super::link::{MOST_LINKS, Parameters, ends, read_law};
use crate::keys::Section;
use crate::reader::{Field, Reader};

/// Dampers, read as links.
pub(super) struct Damper {
    pub(super) link: Link,
    /// Path of its table in the file.
    pub(super) path: String,
    /// Whether `floors` is one pair, rather than a list of pairs.
    pub(super) is_single: bool,
}

/// Reads the dampers of a building, whose index is given.
pub(super) fn read_all(reader: &mut Reader<'_>, building: &Field<'_>, index: usize) -> Vec<Damper> {
    let Some(view) = reader.reopen(building, &[Section::Building]) else {
        return Vec::new();
    };
    let Some(field) = reader.get(&view, "damper") else {
        return Vec::new();
    };
    let Some(entries) = field.entries() else {
        let found = field.node.describe();
        *reader.bad(&field, format!("expected a list of dampers, found {found}")) = Some(
            "write [[building.damper]] with double brackets; in JSON \"damper\": [{ … }]".into(),
        );
        return Vec::new();
    };
    if entries.len() > MOST_LINKS {
        let count = entries.len();
        reader.bad(
            &field,
            format!("at most {MOST_LINKS} dampers are possible, found {count}"),
        );
        return Vec::new();
    }
    entries
        .iter()
        .filter_map(|entry| read(reader, entry, index))
        .collect()
}

fn read(reader: &mut Reader<'_>, field: &Field<'_>, index: usize) -> Option<Damper> {
    let view = reader.open(field, &[Section::Damper, Section::LinkLaw])?;
    let pairs = match reader.get(&view, "floors") {
        Some(field) => pairs(reader, &field),
        None => {
            reader.missing(
                &view,
                "floors",
                "name the two floors that it joins: floors = [0, 1]; 0 is the base or the mat",
            );
            None
        }
    };
    let at = ends(reader, &view);
    let Parameters {
        law,
        stiffness,
        damping,
    } = read_law(reader, &view)?;
    let (pairs, is_single) = pairs?;
    Some(Damper {
        link: Link {
            between: [Some(index); 2],
            floors: FloorPairs::Listed(pairs),
            level_tolerance: LEVEL_TOLERANCE,
            stiffness,
            damping,
            law,
            at,
        },
        path: field.path.clone(),
        is_single,
    })
}

/// One pair of floors, or a list of pairs; `true` for one pair.
fn pairs(reader: &mut Reader<'_>, field: &Field<'_>) -> Option<(Vec<[Level; 2]>, bool)> {
    let entries = field.entries().unwrap_or_default();
    let are_pairs = entries.iter().any(|entry| entry.entries().is_some());
    if !are_pairs {
        return pair(reader, field).map(|pair| (vec![pair], true));
    }
    let pairs: Vec<_> = entries.iter().map(|entry| pair(reader, entry)).collect();
    let pairs: Option<Vec<_>> = pairs.into_iter().collect();
    pairs.map(|pairs| (pairs, false))
}

fn pair(reader: &mut Reader<'_>, field: &Field<'_>) -> Option<[Level; 2]> {
    let entries = field.entries().unwrap_or_default();
    let [low, high] = &entries[..] else {
        let found = field.node.describe();
        *reader.bad(
            field,
            format!("expected two floors, such as [0, 1], found {found}"),
        ) = Some("a list of such pairs stands for several dampers: [[0, 1], [1, 2]]".into());
        return None;
    };
    let (low, high) = (reader.count(low), reader.count(high));
    Some([Level::Floor(low?), Level::Floor(high?)])
}

/// Where the file has the links that are dampers, which follow all others.
pub(super) struct DamperPaths {
    /// Number of links before the first.
    first: usize,
    /// Path of each, and whether its floors are one pair.
    paths: Vec<(String, bool)>,
}

impl DamperPaths {
    pub(super) fn new(first: usize, dampers: &[Damper]) -> Self {
        let paths = dampers.iter();
        let paths = paths.map(|damper| (damper.path.clone(), damper.is_single));
        Self {
            first,
            paths: paths.collect(),
        }
    }

    /// Number of links before the first damper.
    pub(super) fn first(&self) -> usize {
        self.first
    }

    /// Turns the path of a link, as the check of a model has it, into that of the damper in the file.
    pub(super) fn rename(&self, path: &mut String) {
        let Some(rest) = path.strip_prefix("link") else {
            return;
        };
        if rest.is_empty() {
            if let (0, Some((first, _))) = (self.first, self.paths.first()) {
                path.clone_from(first);
            }
            return;
        }
        let numbered = rest
            .strip_prefix('[')
            .and_then(|rest| rest.split_once(']'))
            .and_then(|(index, key)| Some((index.parse::<usize>().ok()?, key)));
        let Some((index, key)) = numbered else { return };
        let damper = index.checked_sub(self.first);
        if let Some((entry_path, is_single)) = damper.and_then(|index| self.paths.get(index)) {
            let key = if *is_single && key.starts_with(".floors[") {
                ".floors"
            } else {
                key
            };
            *path = format!("{entry_path}{key}");
        }
    }
}
