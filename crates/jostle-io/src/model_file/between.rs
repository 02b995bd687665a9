//! Common parts of gaps and links: two neighbours and pairs of points.

use jostle::model::LEVEL_TOLERANCE;
use jostle::{Building, FloorPairs, Level, Structure, Wall};

use crate::nearest::nearest;
use crate::quantity::{Dimension, shorten};
use crate::reader::{Field, Reader, View};

/// Most contacts of a gap.
pub(super) const MOST_CONTACTS: usize = 10_000;

/// How a file names a rigid wall.
const WALL: &str = "wall";

/// Indices of the left and the right neighbour under `between`; `None` inside is a rigid wall, and walls with names are counted
/// on from the buildings. `or_one`: one building may be named twice.
pub(super) fn neighbours(
    reader: &mut Reader<'_>,
    view: &View<'_>,
    buildings: Option<&[Building]>,
    walls: &[Wall],
    or_one: bool,
) -> Option<[Option<usize>; 2]> {
    let Some(field) = reader.get(view, "between") else {
        reader.missing(
            view,
            "between",
            "name the left and the right neighbour: between = [\"A\", \"B\"]; \"wall\" is a rigid wall",
        );
        return None;
    };
    let entries = field.entries().unwrap_or_default();
    let [left, right] = &entries[..] else {
        *reader.bad(
            &field,
            "expected the names of two neighbours, such as [\"A\", \"B\"]",
        ) = Some("before a rigid wall: the building and \"wall\"".into());
        return None;
    };
    let (left_name, right_name) = (reader.text(left), reader.text(right));
    let buildings = buildings?;
    let mut index = |field: &Field<'_>, name: &str| {
        if name == WALL {
            return Some(None);
        }
        let names = || {
            let walls = walls.iter().map(|wall| wall.name.as_str());
            let buildings = buildings.iter().map(|building| building.name.as_str());
            buildings.chain(walls)
        };
        let found = names().position(|candidate| candidate == name);
        if found.is_none() {
            let remedy = match nearest(name, names().chain([WALL])) {
                Some(name) => format!("did you mean \"{name}\"?"),
                None => format!("the buildings are {}", listed(names())),
            };
            *reader.bad(field, format!("there is no building \"{}\"", shorten(name))) =
                Some(remedy);
        }
        found.map(Some)
    };
    let left_index = left_name.and_then(|name| index(left, &name));
    let right_index = right_name.and_then(|name| index(right, &name));
    let between = [left_index?, right_index?];
    if or_one && between[0].is_some() && between[0] == between[1] {
        return Some(between);
    }
    let last = buildings.len().checked_sub(1);
    let in_space = |building: &Building| matches!(building.structure, Structure::Tiers(_));
    if buildings.iter().any(in_space) {
        return in_any_order(reader, &field, between);
    }
    let is_wall = between.map(|side| side.is_some_and(|index| index >= buildings.len()));
    let is_building = between.map(|side| side.is_some_and(|index| index < buildings.len()));
    if is_wall[0] && is_building[1] || is_building[0] && is_wall[1] {
        return Some(between);
    }
    if is_wall.contains(&true) {
        *reader.bad(&field, "names no building") =
            Some("a wall stands beside a building: name one on the other side".into());
        return None;
    }
    let problem = match between {
        [Some(left), Some(right)] if right == left + 1 => return Some(between),
        [None, Some(0)] => return Some(between),
        [Some(left), None] if Some(left) == last => return Some(between),
        [Some(left), Some(right)] if right + 1 == left => "names the right neighbour first",
        [Some(_), Some(_)] => "names two buildings that are not neighbours",
        [None, None] => "names no building",
        [None, Some(_)] => "puts a wall left of a building that is not the first",
        [Some(_), None] => "puts a wall right of a building that is not the last",
    };
    let order = listed(buildings.iter().map(|building| building.name.as_str()));
    *reader.bad(&field, problem) =
        Some(format!("the buildings stand, from left to right: {order}"));
    None
}

/// Any two buildings with plans.
fn in_any_order(
    reader: &mut Reader<'_>,
    field: &Field<'_>,
    between: [Option<usize>; 2],
) -> Option<[Option<usize>; 2]> {
    match between {
        [Some(a), Some(b)] if a != b => Some(between),
        [Some(_), Some(_)] => {
            reader.bad(field, "names the same building twice");
            None
        }
        _ => {
            *reader.bad(
                field,
                "names \"wall\", the wall at an end of a row of buildings without a plan",
            ) = Some("name two buildings, or add [[wall]] with name, from and to, and give its name here".into());
            None
        }
    }
}

/// Quoted names, the first twenty of them.
fn listed<'a>(names: impl Iterator<Item = &'a str>) -> String {
    let mut quoted: Vec<String> = names
        .take(21)
        .map(|name| format!("\"{}\"", shorten(name)))
        .collect();
    if quoted.len() == 21 {
        quoted[20] = "…".into();
    }
    quoted.join(", ")
}

/// `level_tolerance`, or the usual one \[m\].
pub(super) fn tolerance(reader: &mut Reader<'_>, view: &View<'_>) -> f64 {
    let field = reader.get(view, "level_tolerance");
    field
        .and_then(|field| reader.positive(&field, Dimension::Length))
        .unwrap_or(LEVEL_TOLERANCE)
}

/// `floors`: `"common"`, `"all"`, pairs of points, or heights; `None` if it cannot be used.
pub(super) fn floors(reader: &mut Reader<'_>, view: &View<'_>) -> Option<FloorPairs> {
    let Some(field) = reader.get(view, "floors") else {
        return Some(FloorPairs::Common);
    };
    match field.as_text() {
        Some("common") => return Some(FloorPairs::Common),
        Some("all") => return Some(FloorPairs::All),
        _ => {}
    }
    let Some(entries) = field.entries() else {
        let found = field.node.describe();
        reader.bad(
            &field,
            format!("expected \"common\", \"all\", pairs such as [[5, 5], [4, \"12.8 m\"]], or heights such as [\"3.2 m\"]; found {found}"),
        );
        return None;
    };
    if entries.len() > MOST_CONTACTS {
        let count = entries.len();
        reader.bad(
            &field,
            format!("at most {MOST_CONTACTS} contacts are possible, found {count}"),
        );
        return None;
    }
    let pairs = entries
        .iter()
        .filter(|entry| entry.entries().is_some())
        .count();
    if pairs == 0 {
        let heights: Vec<_> = entries
            .iter()
            .map(|entry| reader.quantity(entry, Dimension::Length))
            .collect();
        let heights: Option<Vec<_>> = heights.into_iter().collect();
        return heights.map(|heights| match heights.is_empty() {
            true => FloorPairs::Listed(Vec::new()),
            false => FloorPairs::Heights(heights),
        });
    }
    let pairs: Vec<_> = entries
        .iter()
        .map(|entry| point_pair(reader, entry))
        .collect();
    pairs
        .into_iter()
        .collect::<Option<_>>()
        .map(FloorPairs::Listed)
}

fn point_pair(reader: &mut Reader<'_>, field: &Field<'_>) -> Option<[Level; 2]> {
    let entries = field.entries().unwrap_or_default();
    let [left, right] = &entries[..] else {
        reader.bad(
            field,
            "expected a pair of points, left and right, such as [5, 5] or [5, \"12.8 m\"]",
        );
        return None;
    };
    let (left, right) = (level(reader, left), level(reader, right));
    Some([left?, right?])
}

/// A floor by its number, a height by its quantity, or the wall.
fn level(reader: &mut Reader<'_>, field: &Field<'_>) -> Option<Level> {
    match field.as_text() {
        Some(WALL) => Some(Level::Wall),
        Some(_) => reader.quantity(field, Dimension::Length).map(Level::Height),
        None => reader.count(field).map(Level::Floor),
    }
}
