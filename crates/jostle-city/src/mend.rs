//! Outlines that are no simple polygons, and buildings that are listed twice.

use std::collections::HashMap;

use geo::{Area, BooleanOps, Centroid, MultiPolygon, Orient, Polygon, Validation};

use crate::building::Building;

/// Corners above which an outline is mended without asking whether it must be.
const LONG: usize = 1000;

/// What was changed of a row.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Mend {
    /// Building.
    pub id: String,
    /// Row of the inventory, from 1.
    pub row: usize,
    /// `mended`, `left out`, `repeat`, `assumed` or `no outline`.
    pub what: &'static str,
    /// How, and why.
    pub detail: String,
}

/// The largest part of an outline with its courts, valid, anticlockwise; and how it was mended, if it was.
pub(crate) fn whole(parts: Vec<Polygon>) -> (Option<Polygon>, Option<String>) {
    let count = parts.len();
    let mut how = Vec::new();
    let largest = |parts: Vec<Polygon>| {
        parts
            .into_iter()
            .max_by(|a, b| a.unsigned_area().total_cmp(&b.unsigned_area()))
    };
    if count > 1 {
        how.push(format!("the largest of {count} parts is kept"));
    }
    // Several parts may overlap each other; each alone is what matters.
    let mut mended = Vec::new();
    let mut invalid = false;
    for part in parts {
        let outline = part;
        // The check compares every wall with every other; the rule below does not.
        let courts = outline.interiors().iter().map(|court| court.0.len());
        let long = outline.exterior().0.len() + courts.sum::<usize>() > LONG;
        if !long && outline.is_valid() {
            mended.push(outline);
            continue;
        }
        invalid |= !long;
        // The even–odd rule gives what the ring encloses.
        let empty = MultiPolygon::<f64>::new(Vec::new());
        mended.extend(MultiPolygon::new(vec![outline]).union(&empty).0);
    }
    if invalid {
        how.push(
            "a ring that crosses or touches itself: the largest part that it encloses is kept"
                .to_owned(),
        );
    }
    let Some(chosen) = largest(mended) else {
        return (None, None);
    };
    if chosen.unsigned_area() <= 0.0 {
        return (None, None);
    }
    let chosen = chosen.orient(geo::orient::Direction::Default);
    (Some(chosen), (!how.is_empty()).then(|| how.join("; ")))
}

/// Removes buildings that stand where one before them stands: same middle and area within a centimetre.
pub(crate) fn repeats(buildings: &mut Vec<Building>) -> Vec<Mend> {
    let mut seen: HashMap<[i64; 3], String> = HashMap::new();
    let mut mends = Vec::new();
    buildings.retain(|building| {
        let Some(middle) = building.outline.centroid() else {
            return true;
        };
        let key =
            [middle.x(), middle.y(), building.area].map(|value| (value * 100.0).round() as i64);
        if let Some(first) = seen.get(&key) {
            mends.push(Mend {
                id: building.id.clone(),
                row: building.row,
                what: "repeat",
                detail: format!("the same outline as {first}"),
            });
            return false;
        }
        seen.insert(key, building.id.clone());
        true
    });
    mends
}

/// Gives buildings that have the name of one before them names of their own, as draws go by names.
pub(crate) fn renamed(buildings: &mut [Building]) -> Vec<Mend> {
    let mut rows: HashMap<String, usize> = HashMap::new();
    let mut mends = Vec::new();
    for building in buildings {
        let Some(first) = rows.get(&building.id).copied() else {
            rows.insert(building.id.clone(), building.row);
            continue;
        };
        let name = format!("{} (row {})", building.id, building.row);
        mends.push(Mend {
            id: name.clone(),
            row: building.row,
            what: "mended",
            detail: format!("renamed: row {first} has the name {} too", building.id),
        });
        rows.insert(name.clone(), building.row);
        building.id = name;
    }
    mends
}
