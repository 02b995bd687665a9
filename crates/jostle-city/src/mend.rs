//! Outlines that are no simple polygons, and buildings that are listed twice.

use std::collections::{HashMap, HashSet};

use geo::{
    Area, BooleanOps, Centroid, CoordsIter, LineString, MultiPolygon, Orient, Polygon, Validation,
};

use crate::building::{Building, STOREYS};

/// Corners above which an outline is mended without asking whether it must be.
const LONG: usize = 1000;

/// What was changed of a row.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Mend {
    /// Building.
    pub id: String,
    /// Row of the inventory, from 1.
    pub row: usize,
    /// `mended`, `left out`, `repeat`, `renamed`, `no year`, `no height`, `assumed` or `no outline`.
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
        // The check compares every wall with every other; the rule below does not.
        let long = part.coords_count() > LONG;
        if !long && part.is_valid() {
            mended.push(part);
            continue;
        }
        invalid |= !long;
        // The even–odd rule gives what a ring encloses; courts are taken away from it, wherever they lie.
        let (exterior, courts) = part.into_inner();
        let enclosed = |ring: LineString| {
            let empty = MultiPolygon::<f64>::new(Vec::new());
            MultiPolygon::new(vec![Polygon::new(ring, Vec::new())]).union(&empty)
        };
        let courts = courts.into_iter().map(enclosed);
        let built = courts.fold(enclosed(exterior), |built, court| built.difference(&court));
        mended.extend(built.0);
    }
    if invalid {
        how.push(
            "a ring that crosses or touches itself or another: the largest part that it encloses is kept"
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

/// Gives a building with the name of one before it a name of its own: tables, pairs and draws go by names.
pub(crate) fn named_apart(buildings: &mut [Building]) -> Vec<Mend> {
    let mut all: HashSet<String> = buildings.iter().map(|one| one.id.clone()).collect();
    let mut first: HashMap<String, usize> = HashMap::new();
    let mut mends = Vec::new();
    for building in buildings {
        let Some(known) = first.get(&building.id) else {
            first.insert(building.id.clone(), building.row);
            continue;
        };
        let mut name = format!("{}#{}", building.id, building.row);
        while !all.insert(name.clone()) {
            name.push('#');
        }
        let detail = format!("\"{}\" is the id of row {known} too", building.id);
        building.id = name;
        mends.push(Mend {
            id: building.id.clone(),
            row: building.row,
            what: "renamed",
            detail,
        });
    }
    mends
}

/// Leaves out heights that give no storey, such as those in feet: neither floors nor pairs can go by them.
pub(crate) fn unlikely_heights(buildings: &mut [Building]) -> Vec<Mend> {
    let mut mends = Vec::new();
    for building in buildings {
        let storeys = building.likely_storeys();
        let Some(height) = building.height else {
            continue;
        };
        let storey = height / storeys as f64;
        if STOREYS.contains(&storey) {
            continue;
        }
        building.height = None;
        building.storeys = Some(storeys);
        let [least, most] = [STOREYS.start(), STOREYS.end()];
        mends.push(Mend {
            id: building.id.clone(),
            row: building.row,
            what: "no height",
            detail: format!(
                "{height} m for {storeys} storey{} give {storey:.2} m each, not {least} m to {most} m: the height is left out; \
                 heights must be in m",
                if storeys == 1 { "" } else { "s" }
            ),
        });
    }
    mends
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
