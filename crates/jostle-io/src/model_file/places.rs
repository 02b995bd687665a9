//! Tables of a list that each hold for some places of a frame: later ones replace earlier ones.

use std::collections::BTreeMap;

use jostle::{Frame, FramePlace, Model, Section as CrossSection, Structure};
use jostle_section::formula::Member;

use super::building::has_length;
use super::frame_walls::table_of_beam;
use crate::keys::{Section, keys_of};
use crate::reader::{Field, Reader, View, join};
use crate::tree::{Node, Value};

/// Keys of a table that say where it holds.
const PLACE_KEYS: [&str; 5] = ["line", "bay", "storeys", "floors", "omit"];

/// Which table holds for which columns or beams of a plane frame.
pub(super) struct Layout<'n> {
    /// The tables, in the order of the file.
    pub(super) tables: Vec<Table<'n>>,
    /// Index of the table by storey or floor and by line or bay, from 0; `None` where no table holds. Empty after a fault.
    pub(super) holds: Vec<Vec<Option<usize>>>,
}

/// One table for columns or beams.
pub(super) struct Table<'n> {
    pub(super) field: Field<'n>,
    /// Whether there is nothing at its places.
    pub(super) omits: bool,
    /// Whether it names lines or bays.
    pub(super) names_across: bool,
}

/// The key of columns or beams, and those of their lines or bays and of their storeys or floors.
fn keys(member: Member) -> [&'static str; 3] {
    match member {
        Member::Column => ["column", "line", "storeys"],
        Member::Beam => ["beam", "bay", "floors"],
    }
}

pub(super) fn sections(member: Member) -> &'static [Section] {
    match member {
        Member::Column => &[Section::Column],
        Member::Beam => &[Section::Beam],
    }
}

impl<'n> Layout<'n> {
    /// Reads where tables hold; `None` without the key. `across`: number of lines or bays.
    pub(super) fn read(
        reader: &mut Reader<'_>,
        view: &View<'n>,
        member: Member,
        storeys: Option<usize>,
        across: usize,
    ) -> Option<Self> {
        let [key, across_key, up_key] = keys(member);
        let field = reader.get(view, key)?;
        let entries = field.entries().unwrap_or_else(|| vec![field.clone()]);
        // A single [[building.column]] holds for all.
        let is_list = matches!(field.node.value, Value::List(_)) && entries.len() != 1;
        let names_places = name_places(field.node);
        let mut sound = !is_list
            || names_places
            || has_length(reader, &field, entries.len(), storeys).is_some();
        let rows = storeys.unwrap_or(1);
        let mut holds = vec![vec![(!is_list && !names_places).then_some(0); across]; rows];
        let mut tables = Vec::new();
        for (index, field) in entries.into_iter().enumerate() {
            let member_view = reader.reopen(&field, sections(member));
            let place = member_view.map(|member_view| {
                let omits = omits(reader, &member_view, &field);
                let names_across = member_view.has(across_key);
                let ranges = [(up_key, rows), (across_key, across)]
                    .map(|(key, most)| range(reader, &member_view, key, most));
                (omits, names_across, ranges)
            });
            let (omits, names_across, ranges) = place.unwrap_or((false, false, [None; 2]));
            if names_places {
                match ranges {
                    [Some(up), Some(along)] => {
                        for row in &mut holds[up[0] - 1..up[1]] {
                            row[along[0] - 1..along[1]].fill(Some(index));
                        }
                    }
                    _ => sound = false,
                }
            } else if is_list && let Some(row) = holds.get_mut(index) {
                row.fill(Some(index));
            }
            tables.push(Table {
                field,
                omits,
                names_across,
            });
        }
        if !sound || storeys.is_none() {
            holds.clear();
        }
        Some(Self { tables, holds })
    }
}

impl Layout<'_> {
    /// The first of some places whose table names it by line or bay.
    pub(super) fn named_twice(
        &self,
        places: &BTreeMap<FramePlace, CrossSection>,
    ) -> Option<FramePlace> {
        let names = |[storey, across]: &&FramePlace| {
            let table = self.holds.get(*storey).and_then(|row| *row.get(*across)?);
            table.is_some_and(|table| self.tables[table].names_across)
        };
        places.keys().find(names).copied()
    }
}

/// Whether a table of a list, or the table itself, names places.
pub(crate) fn name_places(node: &Node) -> bool {
    match &node.value {
        Value::List(list) => list.iter().any(name_places),
        Value::Table(table) => PLACE_KEYS.iter().any(|key| table.get(key).is_some()),
        _ => false,
    }
}

/// Whether a list names its places in a building's table, so that its length is not the number of storeys.
pub(super) fn is_by_place(reader: &mut Reader<'_>, view: &View<'_>, key: &'static str) -> bool {
    matches!(key, "column" | "beam")
        && reader
            .get(view, key)
            .is_some_and(|field| name_places(field.node))
}

/// Whether a table says that there is nothing at its places; a section beside it is a fault.
fn omits(reader: &mut Reader<'_>, view: &View<'_>, table: &Field<'_>) -> bool {
    if !read_omit(reader, view) {
        return false;
    }
    let other = keys_of(view.sections())
        .map(|key| key.name)
        .find(|key| !PLACE_KEYS.contains(key) && view.has(key));
    if let Some(key) = other {
        *reader.bad(table, format!("has both omit and {key}")) = Some(format!(
            "leave out {key} where there is nothing, or omit where there is a section"
        ));
    }
    true
}

/// The flag `omit` of a table.
pub(super) fn read_omit(reader: &mut Reader<'_>, view: &View<'_>) -> bool {
    reader
        .get(view, "omit")
        .is_some_and(|field| reader.flag(&field).unwrap_or(false))
}

/// The first and the last that a key of a table names, counted from 1; all without it, `None` after a fault.
pub(super) fn range(
    reader: &mut Reader<'_>,
    view: &View<'_>,
    key: &'static str,
    most: usize,
) -> Option<[usize; 2]> {
    match reader.get(view, key) {
        Some(field) => read_range(reader, &field, most),
        None => Some([1, most]),
    }
}

/// A number, or the first and the last of a range, counted from 1.
fn read_range(reader: &mut Reader<'_>, field: &Field<'_>, most: usize) -> Option<[usize; 2]> {
    let range = match field.entries() {
        None => {
            let single = reader.count(field)?;
            [single, single]
        }
        Some(entries) => {
            let [from, to] = &entries[..] else {
                reader.bad(
                    field,
                    "expected a number, or the first and the last, such as [1, 3]",
                );
                return None;
            };
            [reader.count(from)?, reader.count(to)?]
        }
    };
    if range[0] == 0 || range[1] < range[0] || range[1] > most {
        *reader.bad(
            field,
            match range {
                [one, other] if one == other => {
                    format!("must be within 1 to {most}, found {one}")
                }
                [first, last] => {
                    format!("must be ascending, within 1 to {most}, found {first} to {last}")
                }
            },
        ) = Some("count lines, bays and storeys from 1; a beam has the number of the line at which it begins".into());
        return None;
    }
    Some(range)
}

/// Turns `building[0].column[2][1]`, the column of the third storey at the second line, into the path of the table that holds there.
pub(super) fn rename(reader: &mut Reader<'_>, root: &Node, model: &Model, path: &mut String) {
    if path.contains(COUPLING_BEAM) {
        if let Some(renamed) = rename_coupling_beam(reader, root, model, path) {
            *path = renamed;
        }
        return;
    }
    let found = |member: Member| {
        let key = format!(".{}[", keys(member)[0]);
        let (owner, rest) = path.split_once(&key)?;
        let (storey, rest) = rest.split_once(']')?;
        let (line, rest) = match rest
            .strip_prefix('[')
            .and_then(|strip_prefix| strip_prefix.split_once(']'))
        {
            Some((line, rest)) => (Some(line.parse::<usize>().ok()?), rest),
            None => (None, rest),
        };
        Some((member, owner, storey.parse::<usize>().ok()?, line, rest))
    };
    let place = found(Member::Column).or_else(|| found(Member::Beam));
    let Some((member, owner, storey, line, rest)) = place else {
        return;
    };
    let (Some(frame), Some(node)) = (frame_at(model, owner), node_at(root, owner)) else {
        return;
    };
    let Some(view) = reader.reopen(&Field::root(node), &[Section::Frame]) else {
        return;
    };
    let across = frame.lines() - usize::from(member == Member::Beam);
    let storeys = Some(frame.storey_heights.len());
    let layout = reader.quietly(|reader| Layout::read(reader, &view, member, storeys, across));
    let Some(layout) = layout else {
        return;
    };
    // Without one, it is the first line.
    let first = frame.outer_lines(storey + 1).map_or(0, |[first, _]| first);
    let row = layout.holds.get(storey);
    let table = row.and_then(|row| *row.get(line.unwrap_or(first))?);
    let is_list = layout
        .tables
        .iter()
        .any(|table| table.field.path.ends_with(']'));
    let entry = match table {
        Some(table) if is_list => format!("{}[{table}]", keys(member)[0]),
        _ => keys(member)[0].to_owned(),
    };
    *path = format!("{}{rest}", join(owner, &entry));
}

/// Before the number of a coupling beam in a path.
const COUPLING_BEAM: &str = ".coupling_beam[";

/// The path of the table that gives a coupling beam, which may give one at every floor.
fn rename_coupling_beam(
    reader: &mut Reader<'_>,
    root: &Node,
    model: &Model,
    path: &str,
) -> Option<String> {
    let (owner, rest) = path.split_once(COUPLING_BEAM)?;
    let (beam, rest) = rest.split_once(']')?;
    let beam = beam.parse().ok()?;
    let frame = frame_at(model, owner)?;
    let field = Field::root(node_at(root, owner)?);
    let view = reader.reopen(&field, &[Section::Frame])?;
    let table = reader.quietly(|reader| table_of_beam(reader, &view, frame, beam))?;
    Some(format!("{owner}{COUPLING_BEAM}{table}]{rest}"))
}

/// The frame of a path such as `building[0]` or `building[0].frame[1]`.
fn frame_at<'m>(model: &'m Model, owner: &str) -> Option<&'m Frame> {
    let mut numbers = owner
        .split(['[', ']'])
        .filter_map(|part| part.parse::<usize>().ok());
    match &model.buildings.get(numbers.next()?)?.structure {
        Structure::Frame(frame) => Some(frame),
        Structure::Tiers(tiers) => Some(&tiers.frames.get(numbers.next()?)?.frame),
        Structure::Shear(_) | Structure::Given(_) => None,
    }
}

/// The value at a path such as `building[0].frame[1]`.
fn node_at<'n>(root: &'n Node, path: &str) -> Option<&'n Node> {
    let mut parts = path
        .split(['.', '['])
        .map(|part| part.trim_end_matches(']'));
    parts.try_fold(root, |node, part| match &node.value {
        Value::List(list) => list.get(part.parse::<usize>().ok()?),
        Value::Table(table) => table.get(part),
        _ => None,
    })
}
