//! `[[building.frame]]`: plane frames at lines of a plan.

use std::collections::BTreeMap;

use jostle::{Frame, FrameHinges, Hinges, PlanFrame, PlanPoint};

use super::building::read_base;
use super::frame;
use super::hinges;
use super::joint;
use super::plan::pair;
use super::reinforced::{self, KnownMembers, Reinforced, ReinforcedMember};
use super::shear_failure;
use crate::keys::Section;
use crate::quantity::Dimension;
use crate::reader::{Field, Reader, View};

/// Most frames of a building.
const MOST_FRAMES: usize = 200;

/// Reads the frames of a building with these storeys, each with the sections of its members that have bars.
pub(super) fn read_all(
    reader: &mut Reader<'_>,
    view: &View<'_>,
    storey_heights: &[f64],
    loads: &BTreeMap<String, f64>,
) -> Vec<(PlanFrame, Reinforced)> {
    let entries = reader
        .get(view, "frame")
        .and_then(|field| field.entries().filter(|list| !list.is_empty()));
    let Some(entries) = entries else {
        reader.missing(
            view,
            "frame",
            "add [[building.frame]] with at, direction, spans, column and beam; or write kind = \"shear\" for storey springs",
        );
        return Vec::new();
    };
    let mut frames = Vec::new();
    for (index, entry) in entries.iter().enumerate() {
        let Some(view) = reader.open(entry, &[Section::PlanFrame]) else {
            continue;
        };
        frames.extend(read(reader, &view, index, storey_heights, loads));
        if frames.len() > MOST_FRAMES {
            reader.bad(
                entry,
                format!("is one too many; at most {MOST_FRAMES} frames are possible"),
            );
            break;
        }
    }
    frames
}

/// Reads the shear failure of the columns of frames, whose reinforced members are known now; `None` after faults elsewhere.
pub(super) fn read_shear_failure(
    reader: &mut Reader<'_>,
    view: &View<'_>,
    frames: &mut [PlanFrame],
    members: Option<&[ReinforcedMember]>,
) {
    let entries = reader.get(view, "frame").and_then(|field| field.entries());
    let mut frames = frames.iter_mut();
    for entry in entries.unwrap_or_default() {
        let Some(view) = reader.reopen(&entry, &[Section::PlanFrame]) else {
            continue;
        };
        let places = reader.get(&view, "at");
        let places = places.map(|field| reader.quietly(|reader| read_places(reader, &field)));
        let failure = reader.get(&view, "shear_failure");
        for frame in frames
            .by_ref()
            .take(places.map_or(0, |places| places.len()))
        {
            let Some(field) = &failure else { continue };
            let prefix = format!("{}.", frame.name);
            // A fault of one is that of all.
            match shear_failure::read(reader, field, &frame.frame, &prefix, members) {
                Some(shear) => frame.hinges.shear = shear,
                None => return,
            }
        }
    }
}

/// One frame, or equal ones at several places.
fn read(
    reader: &mut Reader<'_>,
    view: &View<'_>,
    index: usize,
    storey_heights: &[f64],
    loads: &BTreeMap<String, f64>,
) -> Vec<(PlanFrame, Reinforced)> {
    let name = reader
        .get(view, "name")
        .and_then(|field| reader.text(&field));
    let name = name.unwrap_or_else(|| (index + 1).to_string());
    let places = match reader.get(view, "at") {
        Some(field) => read_places(reader, &field),
        None => {
            reader.missing(view, "at", "add at = [\"0 m\", \"6 m\"]");
            Vec::new()
        }
    };
    let direction = reader
        .get(view, "direction")
        .map_or(Some([1.0, 0.0]), |field| read_direction(reader, &field));
    let most = storey_heights.len();
    let storeys = match reader.get(view, "storeys") {
        Some(field) => {
            let count = reader.count(&field).unwrap_or(most);
            if !(1..=most).contains(&count) {
                reader.bad(
                    &field,
                    format!("must lie between 1 and {most}, found {count}"),
                );
            }
            count.clamp(1, most)
        }
        None => most,
    };
    let frame = frame::read_in_plan(reader, view, &storey_heights[..storeys]);
    let noted = reader.count_faults();
    let reinforced = reinforced::read(reader, view, &frame);
    let is_sound = reader.count_faults() == noted;
    let base = read_base(reader, view, false);
    let single = places.len() == 1;
    let names = (1..=places.len()).map(|number| match single {
        true => name.clone(),
        false => format!("{name}.{number}"),
    });
    let names: Vec<String> = names.collect();
    // Equal frames differ by the loads of their columns alone.
    let count = if loads.is_empty() { 1 } else { names.len() };
    let mut hinges: Vec<FrameHinges> = Vec::new();
    for name in names.iter().take(count) {
        let noted = reader.count_faults();
        let members = is_sound.then(|| reinforced::loaded(&frame, &reinforced, name, loads));
        hinges.push(read_hinges(reader, view, &frame, &reinforced, members));
        if reader.count_faults() > noted {
            break;
        }
    }
    let lines = match reader.get(view, "lines") {
        Some(field) => {
            let names = read_lines(reader, &field);
            if places.len() > 1 {
                *reader.bad(&field, "names the columns of frames at several places") =
                    Some("give every place its own [[building.frame]], or leave lines out".into());
            }
            names
        }
        None => Vec::new(),
    };
    let places = names.into_iter().zip(places).enumerate();
    places
        .map(|(number, (name, at))| {
            let own = hinges.get(number).or(hinges.first());
            let frame = PlanFrame {
                name,
                at,
                direction: direction.unwrap_or([1.0, 0.0]),
                lines: lines.clone(),
                base,
                hinges: own.cloned().unwrap_or_default(),
                frame: frame.clone(),
            };
            (frame, reinforced.clone())
        })
        .collect()
}

/// Hinges of the members and connections of a frame; none after faults.
fn read_hinges(
    reader: &mut Reader<'_>,
    view: &View<'_>,
    frame: &Frame,
    reinforced: &Reinforced,
    members: Option<KnownMembers>,
) -> FrameHinges {
    let hinges = reader.get(view, "hinges").and_then(|field| {
        let table = reader.reopen(&field, &[Section::Hinges]);
        if let Some(from) = table.as_ref().and_then(|table| reader.get(table, "from")) {
            *reader.bad(&from, "is not possible for frames in plan yet") =
                Some("give the moments of column and beam".into());
            return None;
        }
        hinges::read_frame(reader, &field, frame, reinforced, members.as_ref())
    });
    match joint::with_hinge(reader, view, frame, hinges) {
        Some(Hinges::Frame(hinges)) => hinges,
        _ => FrameHinges::default(),
    }
}

/// One place, or a list of places.
fn read_places(reader: &mut Reader<'_>, field: &Field<'_>) -> Vec<PlanPoint> {
    let entries = field.entries().unwrap_or_default();
    let is_list = entries
        .first()
        .is_some_and(|entry| entry.entries().is_some());
    if !is_list {
        return pair(reader, field).into_iter().collect();
    }
    let places = entries.iter().map(|entry| pair(reader, entry));
    places.collect::<Vec<_>>().into_iter().flatten().collect()
}

/// `"x"`, `"y"`, or an angle from x, as a unit vector.
fn read_direction(reader: &mut Reader<'_>, field: &Field<'_>) -> Option<PlanPoint> {
    match field.as_text() {
        Some("x") => Some([1.0, 0.0]),
        Some("y") => Some([0.0, 1.0]),
        _ => {
            let angle = reader.quantity(field, Dimension::Dimensionless)?;
            Some([libm::cos(angle), libm::sin(angle)])
        }
    }
}

/// Names of column lines; an empty one names none.
fn read_lines(reader: &mut Reader<'_>, field: &Field<'_>) -> Vec<Option<String>> {
    let Some(entries) = field.entries() else {
        let found = field.node.describe();
        reader.bad(
            field,
            format!("expected a list of names, such as [\"A1\", \"\", \"C1\"]; found {found}"),
        );
        return Vec::new();
    };
    let names = entries.iter().map(|entry| reader.text(entry));
    let names: Vec<Option<String>> = names.collect();
    names
        .into_iter()
        .map(|name| name.filter(|name| !name.trim().is_empty()))
        .collect()
}
