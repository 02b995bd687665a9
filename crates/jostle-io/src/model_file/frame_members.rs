//! Columns and beams of a frame at their places.

use std::collections::BTreeMap;

use jostle::{FramePlace, Section};
use jostle_section::Span;
use jostle_section::formula::Member;

use super::frame_walls::Walls;
use super::places::Layout;
use super::section::{Material, STAND_IN, read_sections};
use crate::reader::{Field, Reader, View};

/// Sections of columns or beams by storey or floor, and those that differ.
pub(super) type Sections = (Vec<Section>, BTreeMap<FramePlace, Option<Section>>);

/// Sections by storey or floor and by line or bay, with their depths \[m\]; `None` where there is nothing, or no depth.
type Grid = Vec<Vec<Option<(Section, Option<f64>)>>>;

/// Columns and beams of a frame.
pub(super) struct FrameMembers {
    pub(super) columns: Sections,
    pub(super) beams: Sections,
    /// Depths of columns by storey and line, then of beams by floor and bay; empty after a fault \[m\].
    pub(super) depths: [Vec<Vec<Option<f64>>>; 2],
}

/// Columns and beams of a frame of such bays \[m\], with their materials; after a fault, harmless ones.
pub(super) fn read(
    reader: &mut Reader<'_>,
    view: &View<'_>,
    storeys: Option<usize>,
    spans: &[f64],
    [column, beam]: [Material; 2],
    walls: &Walls,
) -> FrameMembers {
    let noted = reader.count_faults();
    let all_joints = |_, _| true;
    let bays = spans.len();
    let no_span = |_| None;
    let span = |bay: usize| {
        let outer_ends = usize::from(bay == 0) + usize::from(bay + 1 == bays);
        Some(Span {
            length: spans[bay],
            outer_ends,
        })
    };
    let columns = read_grid(
        reader,
        view,
        Member::Column,
        storeys,
        bays + 1,
        column,
        &all_joints,
        &no_span,
        walls,
    );
    // Beams are continuous over lines without a column.
    let between_columns = |floor: usize, bay: usize| match &columns {
        Some(grid) => {
            let stands = |column: &Option<_>| column.is_some();
            grid[floor][..=bay].iter().any(stands) && grid[floor][bay + 1..].iter().any(stands)
        }
        None => true,
    };
    let beams = read_grid(
        reader,
        view,
        Member::Beam,
        storeys,
        bays,
        beam,
        &between_columns,
        &span,
        walls,
    );
    let [columns, beams] = [&columns, &beams].map(|grid| {
        grid.as_ref()
            .filter(|_| !walls.incomplete && reader.count_faults() == noted)
    });
    let sections = |grid: Option<&Grid>| match grid {
        Some(grid) => compact(grid),
        None => (vec![STAND_IN; storeys.unwrap_or(1)], BTreeMap::new()),
    };
    let depths = |grid: Option<&Grid>| {
        let rows = grid.into_iter().flatten();
        let depth = |cell: &Option<(Section, Option<f64>)>| cell.and_then(|(_, depth)| depth);
        rows.map(|row| row.iter().map(depth).collect()).collect()
    };
    FrameMembers {
        columns: sections(columns),
        beams: sections(beams),
        depths: [depths(columns), depths(beams)],
    }
}

/// Walls and coupling beams take the places of others. `stands`: whether a member finds its joints; beams stand only between columns, unless a table names their bay.
#[expect(
    clippy::too_many_arguments,
    reason = "columns and beams differ in each of them"
)]
fn read_grid(
    reader: &mut Reader<'_>,
    view: &View<'_>,
    member: Member,
    storeys: Option<usize>,
    across: usize,
    material: Material,
    stands: &dyn Fn(usize, usize) -> bool,
    span: &dyn Fn(usize) -> Option<Span>,
    walls: &Walls,
) -> Option<Grid> {
    let wall_section = &walls.sections[usize::from(member == Member::Beam)];
    let layout = Layout::read(reader, view, member, storeys, across);
    // A stick has no beams.
    if layout.is_none() && (walls.incomplete || !wall_section.is_empty() || across == 0) {
        let rows = (0..storeys.unwrap_or(1)).map(|storey| {
            let places =
                (0..across).map(|place| Some((*wall_section.get(&[storey, place])?, None)));
            places.collect::<Vec<_>>()
        });
        let grid: Grid = rows.collect();
        let is_full = |(storey, row): (usize, &Vec<Option<_>>)| {
            let mut row = row.iter().enumerate();
            row.all(|(place, section)| section.is_some() || !stands(storey, place))
        };
        if walls.incomplete || grid.iter().enumerate().all(is_full) {
            return Some(grid);
        }
    }
    let sections = read_sections(reader, view, member, layout.as_ref(), material);
    let layout = layout?;
    if let Some(place) = layout.named_twice(wall_section) {
        let table = &layout.tables[layout.holds[place[0]][place[1]]?];
        taken(reader, &table.field, member, place);
        return None;
    }
    let mut grid = Vec::new();
    for (storey, row) in layout.holds.iter().enumerate() {
        let mut row_of_sections = Vec::new();
        for (place, table) in row.iter().enumerate() {
            if let Some(section) = wall_section.get(&[storey, place]) {
                row_of_sections.push(Some((*section, None)));
                continue;
            }
            let stands = stands(storey, place);
            let Some(table) = *table else {
                if stands {
                    lacks_section(reader, view, member, [storey, place]);
                    return None;
                }
                row_of_sections.push(None);
                continue;
            };
            let exists = stands || layout.tables[table].names_across;
            let section = sections[table].filter(|_| exists);
            row_of_sections.push(section.map(|section| (section.at(span(place)), section.depth)));
        }
        grid.push(row_of_sections);
    }
    (!grid.is_empty()).then_some(grid)
}

/// A table names the place of a wall or of a coupling beam.
fn taken(reader: &mut Reader<'_>, field: &Field<'_>, member: Member, place: FramePlace) {
    let [storey, across] = place.map(|index| index + 1);
    let (problem, remedy) = match member {
        Member::Column => (
            format!("names line {across} in storey {storey}, where a wall stands"),
            "leave that line or storey out here, or make the wall end below by storeys",
        ),
        Member::Beam => (
            format!("names bay {across} at floor {storey}, where a coupling beam is"),
            "leave that bay or floor out here, or in [[building.coupling_beam]]",
        ),
    };
    *reader.bad(field, problem) = Some(remedy.into());
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
    let mut exceptions = BTreeMap::new();
    let mut rows = Vec::new();
    for (storey, row) in grid.iter().enumerate() {
        let row: Vec<Option<Section>> = row.iter().map(|row| Some(row.as_ref()?.0)).collect();
        let usual = row.iter().flatten().next().copied();
        for (place, section) in row.iter().enumerate() {
            // Without any, all are left out.
            if *section != usual || usual.is_none() {
                exceptions.insert([storey, place], *section);
            }
        }
        rows.push(usual.unwrap_or(STAND_IN));
    }
    (rows, exceptions)
}

/// Rows without holes: where there is no member, that of another of its storey, which has no part.
pub(super) fn filled<T: Clone>(rows: Vec<Vec<Option<T>>>) -> Vec<Vec<T>> {
    let rows = rows.into_iter().map(|row| {
        let other = row.iter().flatten().next().cloned();
        row.into_iter()
            .filter_map(|row| row.or_else(|| other.clone()))
            .collect()
    });
    rows.collect()
}
