//! Columns and beams of a frame at their places.

use std::collections::BTreeMap;

use jostle::{FramePlace, Section};
use jostle_section::formula::Member;

use super::places::Layout;
use super::section::{Material, STAND_IN, read_sections};
use crate::reader::{Reader, View};

/// Sections of columns or beams by storey or floor, and those that differ.
pub(super) type Sections = (Vec<Section>, BTreeMap<FramePlace, Option<Section>>);

/// Sections by storey or floor and by line or bay; `None` where there is nothing.
type Grid = Vec<Vec<Option<Section>>>;

/// Columns and beams of a frame of so many bays, with their materials; after a fault, harmless ones.
pub(super) fn read(
    reader: &mut Reader<'_>,
    view: &View<'_>,
    storeys: Option<usize>,
    bays: usize,
    [column, beam]: [Material; 2],
) -> [Sections; 2] {
    let noted = reader.count_faults();
    let all_joints = |_, _| true;
    let columns = read_grid(
        reader,
        view,
        Member::Column,
        storeys,
        bays + 1,
        column,
        &all_joints,
    );
    let joints = |floor: usize, bay: usize| match &columns {
        Some(grid) => [bay, bay + 1]
            .iter()
            .all(|line| grid[floor][*line].is_some()),
        None => true,
    };
    let beams = read_grid(reader, view, Member::Beam, storeys, bays, beam, &joints);
    [&columns, &beams].map(|grid| match grid {
        Some(grid) if reader.count_faults() == noted => compact(grid),
        _ => (vec![STAND_IN; storeys.unwrap_or(1)], BTreeMap::new()),
    })
}

/// `stands`: whether a member finds its joints; beams stand only between joints, unless a table names their bay.
fn read_grid(
    reader: &mut Reader<'_>,
    view: &View<'_>,
    member: Member,
    storeys: Option<usize>,
    across: usize,
    material: Material,
    stands: &dyn Fn(usize, usize) -> bool,
) -> Option<Grid> {
    let layout = Layout::read(reader, view, member, storeys, across);
    let sections = read_sections(reader, view, member, layout.as_ref(), material);
    let layout = layout?;
    let mut grid = Vec::new();
    for (storey, row) in layout.holds.iter().enumerate() {
        let mut own = Vec::new();
        for (place, table) in row.iter().enumerate() {
            let stands = stands(storey, place);
            let Some(table) = *table else {
                if stands {
                    lacks_section(reader, view, member, [storey, place]);
                    return None;
                }
                own.push(None);
                continue;
            };
            let exists = stands || layout.tables[table].names_across;
            own.push(sections[table].filter(|_| exists));
        }
        grid.push(own);
    }
    (!grid.is_empty()).then_some(grid)
}

fn lacks_section(reader: &mut Reader<'_>, view: &View<'_>, member: Member, place: FramePlace) {
    let [storey, across] = place.map(|index| index + 1);
    let (key, problem, remedy) = match member {
        Member::Column => (
            "column",
            format!("says nothing of line {across} in storey {storey}"),
            "give a first table without line and storeys, which holds for all, or omit = true there",
        ),
        Member::Beam => (
            "beam",
            format!("says nothing of bay {across} at floor {storey}"),
            "give a first table without bay and floors, which holds for all, or omit = true there",
        ),
    };
    if let Some(field) = reader.get(view, key) {
        *reader.bad(&field, problem) = Some(remedy.into());
    }
}

/// The first section of every row, and what differs from it.
fn compact(grid: &Grid) -> Sections {
    let mut own = BTreeMap::new();
    let mut rows = Vec::new();
    for (storey, row) in grid.iter().enumerate() {
        let usual = row.iter().flatten().next().copied();
        for (place, section) in row.iter().enumerate() {
            // Without any, all are left out.
            if *section != usual || usual.is_none() {
                own.insert([storey, place], *section);
            }
        }
        rows.push(usual.unwrap_or(STAND_IN));
    }
    (rows, own)
}

/// Rows without holes: where there is no member, that of another of its storey, which has no part.
pub(super) fn filled<T: Clone>(rows: Vec<Vec<Option<T>>>) -> Vec<Vec<T>> {
    let rows = rows.into_iter().map(|row| {
        let other = row.iter().flatten().next().cloned();
        row.into_iter()
            .filter_map(|own| own.or_else(|| other.clone()))
            .collect()
    });
    rows.collect()
}
