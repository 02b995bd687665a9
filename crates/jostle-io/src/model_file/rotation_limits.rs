//! `[[building.rotation_limit]]`: rotations of hinges at which members reach levels of performance.

use std::collections::BTreeMap;

use jostle::model::{LimitedMembers, RotationLevel, RotationLimit, RotationMeasure};

use crate::keys::{LIMITED_MEMBERS, ROTATION_MEASURES, Section};
use crate::quantity::Dimension;
use crate::reader::{Field, Reader, View};

/// Keys of the levels, in rising order.
const LEVELS: [(&str, RotationLevel); 3] = [
    ("io", RotationLevel::ImmediateOccupancy),
    ("ls", RotationLevel::LifeSafety),
    ("cp", RotationLevel::CollapsePrevention),
];

/// Reads all tables of a building; those with faults are left out.
pub(super) fn read_all(reader: &mut Reader<'_>, view: &View<'_>) -> Vec<RotationLimit> {
    let Some(field) = reader.get(view, "rotation_limit") else {
        return Vec::new();
    };
    let Some(entries) = field.entries() else {
        reader.bad(&field, "is a list of tables, [[building.rotation_limit]]");
        return Vec::new();
    };
    let all = entries.iter().map(|entry| read(reader, entry));
    let all: Vec<_> = all.collect();
    all.into_iter().flatten().collect()
}

fn read(reader: &mut Reader<'_>, entry: &Field<'_>) -> Option<RotationLimit> {
    let view = reader.open(entry, &[Section::RotationLimit])?;
    let Some(of) = reader.get(&view, "of") else {
        reader.missing(&view, "of", "add of = \"columns\", or \"beams\"");
        return None;
    };
    let columns = reader.choice(&of, LIMITED_MEMBERS, &[])? == "columns";
    let [lines, storeys, no_lines, no_storeys] = match columns {
        true => ["line", "storeys", "bay", "floors"],
        false => ["bay", "floors", "line", "storeys"],
    };
    for (key, instead) in [(no_lines, lines), (no_storeys, storeys)] {
        if let Some(field) = reader.get(&view, key) {
            let whose = if columns { "beams" } else { "columns" };
            *reader.bad(&field, format!("is a key of {whose}")) = Some(format!("write {instead}"));
            return None;
        }
    }
    let mut range = |key: &'static str| match reader.get(&view, key) {
        None => Some(None),
        Some(field) => from_to(reader, &field).map(Some),
    };
    let (lines, storeys) = (range(lines)?, range(storeys)?);
    let measure = match reader.get(&view, "measure") {
        Some(field) => match reader.choice(&field, ROTATION_MEASURES, &[])? {
            "chord" => RotationMeasure::Chord,
            _ => RotationMeasure::Plastic,
        },
        None => RotationMeasure::Plastic,
    };
    let Some(stated) = reader.get(&view, "limits") else {
        let remedy = "add limits = { io = \"5 mrad\", ls = \"15 mrad\", cp = \"20 mrad\" }";
        reader.missing(&view, "limits", remedy);
        return None;
    };
    let table = reader.open(&stated, &[Section::RotationLevels])?;
    let mut limits = BTreeMap::new();
    for (key, level) in LEVELS {
        if let Some(field) = reader.get(&table, key) {
            let limit = reader.positive(&field, Dimension::Dimensionless)?;
            if let Some(before) = limits
                .values()
                .next_back()
                .filter(|next_back| **next_back >= limit)
            {
                *reader.bad(&field, format!("must exceed the limit of the level before it, {before} rad; found {limit} rad")) =
                    Some("levels rise: io < ls < cp".into());
                return None;
            }
            limits.insert(level, limit);
        }
    }
    if limits.is_empty() {
        *reader.bad(&stated, "names no level") =
            Some("give one of io, ls and cp, such as cp = \"20 mrad\"".into());
        return None;
    }
    Some(RotationLimit {
        of: match columns {
            true => LimitedMembers::Columns,
            false => LimitedMembers::Beams,
        },
        lines,
        storeys,
        measure,
        limits,
    })
}

/// A number, or the first and the last.
fn from_to(reader: &mut Reader<'_>, field: &Field<'_>) -> Option<[usize; 2]> {
    let Some(entries) = field.entries() else {
        return reader.count(field).map(|whole_number| [whole_number; 2]);
    };
    let [first, last] = &entries[..] else {
        *reader.bad(field, "expected a number, or the first and the last") =
            Some("write 2 or [1, 3]".into());
        return None;
    };
    Some([reader.count(first)?, reader.count(last)?])
}
