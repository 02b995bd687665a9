//! `kind = "frame"`: columns, beams and their masses.

use jostle::{Axial, DiagonalPlace, Frame};

use super::brace::{self, Bays, Widths};
use super::building::{per_storey, storeys};
use super::section::{Material, read_modulus};
use super::{frame_members, frame_walls, infill, joint, reinforced, rigid_ends};
use crate::keys::{AXIAL, Section};
use crate::quantity::Dimension;
use crate::reader::{Field, Reader, View};
use crate::tree::Value;

/// Most spans of a frame.
const MOST_SPANS: usize = 50;

/// Density of reinforced concrete \[kg/m³\].
pub(super) const CONCRETE_DENSITY: f64 = 2500.0;

/// Poisson's ratio of concrete \[–\] (GB 50010-2010, clause 4.1.8).
const CONCRETE_POISSON_RATIO: f64 = 0.2;

/// Reads the keys of a frame; after a fault, harmless values are used.
pub(super) fn read(reader: &mut Reader<'_>, view: &View<'_>) -> Frame {
    let count = storeys(
        reader,
        view,
        &["storey_height", "column", "beam", "beam_mass", "floor_mass"],
    );
    let height = match reader.get(view, "storey_height") {
        Some(field) => per_storey(reader, &field, Dimension::Length, count),
        None => {
            reader.missing(
                view,
                "storey_height",
                "add storey_height = \"3.2 m\", or a list from the ground up",
            );
            None
        }
    };
    let storey_heights = height.unwrap_or_else(|| vec![3.0; count.unwrap_or(1)]);
    let masses = |reader: &mut Reader<'_>| masses(reader, view, count);
    read_members(reader, view, count, storey_heights, masses, &PLANE)
}

/// Reads the keys of a frame at a line of a plan, which has these storeys.
pub(super) fn read_in_plan(
    reader: &mut Reader<'_>,
    view: &View<'_>,
    storey_heights: &[f64],
) -> Frame {
    let count = storey_heights.len();
    let masses = |reader: &mut Reader<'_>| {
        let field = reader.get(view, "beam_mass");
        let per_storey =
            field.and_then(|field| per_storey(reader, &field, Dimension::LineMass, Some(count)));
        (
            per_storey.unwrap_or_else(|| vec![0.0; count]),
            vec![0.0; count],
        )
    };
    let heights = storey_heights.to_vec();
    read_members(reader, view, Some(count), heights, masses, &IN_PLAN)
}

/// What is absent from a file.
struct Defaults {
    density: f64,
    segments: usize,
    /// Whether the faces of columns matter: they stand before the edge of a plan or behind it.
    knows_depths: bool,
}

/// Of a plane frame.
const PLANE: Defaults = Defaults {
    density: CONCRETE_DENSITY,
    segments: 4,
    knows_depths: false,
};

/// Of a frame in a plan: the masses of the floors include it.
const IN_PLAN: Defaults = Defaults {
    density: 0.0,
    segments: 1,
    knows_depths: true,
};

fn read_members(
    reader: &mut Reader<'_>,
    view: &View<'_>,
    count: Option<usize>,
    storey_heights: Vec<f64>,
    masses: impl FnOnce(&mut Reader<'_>) -> (Vec<f64>, Vec<f64>),
    defaults: &Defaults,
) -> Frame {
    let spans = read_spans(reader, view);

    let (modulus, modulus_is_bad) = read_modulus(reader, view);
    let density = read_density(reader, view, defaults.density);
    let (column_factor, beam_factor) = stiffness_factors(reader, view);
    let shears = flexible_members(reader, view, "shear", Section::ShearDeformation, false);
    let poisson_ratio = read_poisson_ratio(reader, view);
    let material = |factor, shears| Material {
        modulus,
        modulus_is_stated: view.has("elastic_modulus"),
        modulus_is_bad,
        density,
        factor,
        shears,
        poisson_ratio,
    };
    let materials = [
        material(column_factor, shears.0),
        material(beam_factor, shears.1),
    ];
    let bays = frame_walls::Bays {
        heights: &storey_heights,
        spans: &spans,
        materials,
        concrete: reinforced::of_building(reader, view),
    };
    let walls = frame_walls::read(reader, view, bays);
    let members = frame_members::read(reader, view, count, &spans, materials, &walls);
    let (columns, own_columns) = members.columns;
    let (beams, own_beams) = members.beams;
    let (beam_mass, floor_mass) = masses(reader);
    // Frames in plan have no such key.
    let floor_load = view
        .has("floor_load")
        .then(|| reader.get(view, "floor_load"))
        .flatten()
        .and_then(|field| per_storey(reader, &field, Dimension::Force, count));
    let column_segments = match reader.get(view, "column_segments") {
        Some(field) => reader.count(&field).unwrap_or(1),
        None => defaults.segments,
    };
    let mut frame = Frame {
        beam_segments: beam_segments(reader, view, spans.len(), defaults.segments),
        storey_heights,
        spans,
        columns,
        beams,
        own_columns,
        own_beams,
        beam_mass,
        floor_mass,
        floor_load: floor_load.unwrap_or_default(),
        column_segments,
        joint: joint::read(reader, view),
        walls: walls.walls,
        coupling_beams: walls.beams,
        ..Frame::default()
    };
    frame.rigid_zones = rigid_ends::read(reader, view, &frame, &members.depths);
    if defaults.knows_depths {
        let rows = members.depths[0].iter().enumerate();
        let depths = rows.flat_map(|(storey, row)| {
            let row = row.iter().enumerate();
            row.filter_map(move |(line, depth)| Some(([storey, line], (*depth)?)))
        });
        frame.column_depths = depths.collect();
    }
    let has_joints = |place: DiagonalPlace| {
        let [lower, upper] = place.lines();
        let mut lines = place.lines().into_iter();
        // Walls leave no corner of the bay.
        let is_beside_wall = lines.any(|line| frame.wall([place.storey - 1, line]).is_some());
        !is_beside_wall
            && frame.has_joint(place.storey - 1, lower)
            && frame.has_joint(place.storey, upper)
    };
    let bays = Bays {
        heights: &frame.storey_heights,
        widths: Widths::OfFrame(&frame.spans),
        column_rigidity: &|place| {
            let column = |line| frame.column(place.storey - 1, line);
            place
                .lines()
                .map(|line| Some(column(line)?.flexural_rigidity))
        },
        has_joint: &|(floor, [line, _])| frame.has_joint(floor, line),
        has_joints: &has_joints,
    };
    let mut diagonals = brace::read_all(reader, view, bays);
    let (struts, panels) = infill::read_all(reader, view, bays);
    diagonals.extend(struts);
    frame.diagonals = diagonals;
    // Half a panel hangs on the floor above, half stands on the one below; what stands on the ground does not move with the building.
    for (place, mass) in panels {
        for floor in place
            .floors()
            .into_iter()
            .filter_map(|floor| floor.checked_sub(1))
        {
            frame.floor_mass[floor] += 0.5 * mass;
        }
    }
    // Columns on foundations keep their length unless asked, and columns that shorten need their EA. Coupled walls do by their axial
    // forces.
    let shortens = (frame.tallness() > 1.0 || !frame.walls.is_empty())
        && !view.has("foundation")
        && frame
            .all_columns()
            .all(|(_, column)| column.axial_rigidity.is_some());
    let axial = flexible_members(reader, view, "axial", Section::Axial, shortens);
    frame.axial = Axial {
        columns_flexible: axial.0,
        beams_flexible: axial.1,
    };
    frame
}

/// Density of the columns \[kg/m³\].
pub(super) fn read_density(reader: &mut Reader<'_>, view: &View<'_>, usual: f64) -> f64 {
    let Some(field) = reader.get(view, "density") else {
        return usual;
    };
    match reader.quantity(&field, Dimension::Density) {
        Some(density) if density < 0.0 => {
            reader.bad(&field, "must not be negative");
            usual
        }
        density => density.unwrap_or(usual),
    }
}

fn read_spans(reader: &mut Reader<'_>, view: &View<'_>) -> Vec<f64> {
    const STAND_IN: f64 = 6.0;
    let Some(field) = reader.get(view, "spans") else {
        reader.missing(
            view,
            "spans",
            "add the bay widths from left to right: spans = [\"6 m\", \"6 m\"]",
        );
        return vec![STAND_IN];
    };
    let Some(entries) = field.entries() else {
        let found = field.node.describe();
        *reader.bad(
            &field,
            format!("expected a list of bay widths, found {found}"),
        ) = Some("write spans = [\"6 m\"] for a single bay".into());
        return vec![STAND_IN];
    };
    if entries.len() > MOST_SPANS {
        let count = entries.len();
        reader.bad(
            &field,
            format!("at most {MOST_SPANS} spans are possible, found {count}"),
        );
        return vec![STAND_IN];
    }
    entries
        .iter()
        .map(|entry| {
            reader
                .quantity(entry, Dimension::Length)
                .unwrap_or(STAND_IN)
        })
        .collect()
}

/// Factors on EI of columns and of beams.
pub(super) fn stiffness_factors(reader: &mut Reader<'_>, view: &View<'_>) -> (f64, f64) {
    let Some(field) = reader.get(view, "stiffness_factor") else {
        return (1.0, 1.0);
    };
    if !matches!(field.node.value, Value::Table(_)) {
        let factor = reader
            .positive(&field, Dimension::Dimensionless)
            .unwrap_or(1.0);
        return (factor, factor);
    }
    let Some(view) = reader.open(&field, &[Section::StiffnessFactor]) else {
        return (1.0, 1.0);
    };
    let mut factor = |key| match reader.get(&view, key) {
        Some(field) => reader
            .positive(&field, Dimension::Dimensionless)
            .unwrap_or(1.0),
        None => 1.0,
    };
    (factor("column"), factor("beam"))
}

/// Mass on the beams, and further mass of the floors.
fn masses(reader: &mut Reader<'_>, view: &View<'_>, count: Option<usize>) -> (Vec<f64>, Vec<f64>) {
    let storeys = count.unwrap_or(1);
    let floor_mass = reader
        .get(view, "floor_mass")
        .map(|field| per_storey(reader, &field, Dimension::Mass, count));
    let beam_mass = match reader.get(view, "beam_mass") {
        Some(field) => per_storey(reader, &field, Dimension::LineMass, count),
        None => {
            if floor_mass.is_none() {
                reader.missing(
                    view,
                    "beam_mass",
                    "add the mass that the beams carry, with slab and their self weight: beam_mass = \"3600 kg/m\"; or floor_mass = \"40 t\"",
                );
            }
            None
        }
    };
    (
        beam_mass.unwrap_or_else(|| vec![0.0; storeys]),
        floor_mass.flatten().unwrap_or_else(|| vec![0.0; storeys]),
    )
}

fn beam_segments(
    reader: &mut Reader<'_>,
    view: &View<'_>,
    spans: usize,
    usual: usize,
) -> Vec<usize> {
    let Some(field) = reader.get(view, "beam_segments") else {
        return vec![usual; spans];
    };
    match field.entries() {
        Some(entries) => entries
            .iter()
            .take(MOST_SPANS + 1)
            .map(|entry| reader.count(entry).unwrap_or(1))
            .collect(),
        None => vec![reader.count(&field).unwrap_or(1); spans],
    }
}

/// Whether columns and beams are flexible in some way: a word for all, or a table. Columns are as `usual` where the file does not say.
pub(super) fn flexible_members(
    reader: &mut Reader<'_>,
    view: &View<'_>,
    key: &'static str,
    section: Section,
    usual: bool,
) -> (bool, bool) {
    let Some(field) = reader.get(view, key) else {
        return (usual, false);
    };
    if !matches!(field.node.value, Value::Table(_)) {
        let flexible = is_flexible(reader, &field);
        // Axial deformation in a word is that of columns: floors stay rigid.
        return (flexible, flexible && section != Section::Axial);
    }
    let sections: &'static [Section] = match section {
        Section::Axial => &[Section::Axial],
        _ => &[Section::ShearDeformation],
    };
    let Some(view) = reader.open(&field, sections) else {
        return (false, false);
    };
    let mut flexible = |key, usual| match reader.get(&view, key) {
        Some(field) => is_flexible(reader, &field),
        None => usual,
    };
    (flexible("columns", usual), flexible("beams", false))
}

pub(super) fn read_poisson_ratio(reader: &mut Reader<'_>, view: &View<'_>) -> f64 {
    let Some(field) = reader.get(view, "poisson_ratio") else {
        return CONCRETE_POISSON_RATIO;
    };
    let ratio = reader.quantity(&field, Dimension::Dimensionless);
    if ratio.is_some_and(|ratio| !(0.0..0.5).contains(&ratio)) {
        *reader.bad(&field, "must lie between 0 and 0.5") =
            Some("0.2 is usual for concrete, 0.3 for steel".into());
    }
    ratio.unwrap_or(CONCRETE_POISSON_RATIO)
}

fn is_flexible(reader: &mut Reader<'_>, field: &Field<'_>) -> bool {
    reader.choice(field, AXIAL, &[]) == Some("flexible")
}
