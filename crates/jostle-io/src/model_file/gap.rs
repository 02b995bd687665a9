//! `[[gap]]`: the gap between two neighbours, or beside a wall, and its contact law.

use jostle::interface::narrowest_gap;
use jostle::{
    Building, ContactLaw, FloorPairs, Gap, LawKind, Level, Model, PlanContact, PlanPoint,
    RestitutionIs, Structure, Wall,
};

use super::between::{MOST_CONTACTS, floors, neighbours, tolerance};
use super::contact_law::{
    CONCRETE_RESTITUTION, CONCRETE_STIFFNESS, DEFAULT_LAW, contact_law, optional,
};
use crate::keys::Section;
use crate::quantity::Dimension;
use crate::reader::{Field, Reader, View};
use crate::tree::Value;

/// Most gaps.
const MOST_GAPS: usize = 10_000;

/// `between` of a gap for all neighbours.
const ALL: &str = "all";
/// Sides of a gap that names no buildings: it stands for all neighbours without one of their own.
const ALL_NEIGHBOURS: [Option<usize>; 2] = [None, None];

/// Puts a gap between every two buildings with plans that face each other within reach, in place of the one that names no
/// buildings; the buildings are in their places.
pub(super) fn for_all_neighbours(
    reader: &mut Reader<'_>,
    fields: &[Field<'_>],
    at: &[Option<PlanPoint>],
    model: &mut Model,
) {
    if !model.is_in_space() {
        return;
    }
    let is_general = |gap: &Gap| gap.between == ALL_NEIGHBOURS;
    let Some(place) = model.gaps.iter().position(is_general) else {
        return;
    };
    let general = model.gaps[place].clone();
    if let Some(field) = fields.get(place) {
        if place + 1 != model.gaps.len() {
            *reader.bad(field, "names no buildings, so it must be the last [[gap]]") =
                Some("move it to the end, or add between = [\"A\", \"B\"]".into());
        } else if at.iter().any(Option::is_none) {
            *reader.bad(
                field,
                "is for all neighbours, but not all buildings say where they stand",
            ) = Some("give every building its at, or add between = [\"A\", \"B\"]".into());
        }
    }
    model.gaps.retain(|gap| !is_general(gap));
    let found = facing(model, &general);
    model.gaps.extend(found);
    if model.gaps.len() == place
        && let Some(field) = fields.get(place)
    {
        let reach = general.in_plan.reach;
        *reader.bad(
            field,
            format!("finds no two buildings that face each other within {reach} m"),
        ) = Some("check at and plan, raise reach, or leave it out".into());
    }
}

/// Gaps like a general one between buildings with plans that face each other within its reach and have no gap.
fn facing(model: &Model, general: &Gap) -> Vec<Gap> {
    let count = model.buildings.len();
    let pairs = (0..count).flat_map(|a| (a + 1..count).map(move |b| [Some(a), Some(b)]));
    let is_free = |[a, b]: &[Option<usize>; 2]| {
        let mut gaps = model.gaps.iter();
        !gaps.any(|gap| gap.between == [*a, *b] || gap.between == [*b, *a])
    };
    let all: Vec<Gap> = pairs
        .filter(is_free)
        .map(|between| Gap {
            between,
            ..general.clone()
        })
        .collect();
    let tried = Model {
        gaps: all,
        ..model.clone()
    };
    let faces = (0..tried.gaps.len()).filter(|gap| narrowest_gap(&tried, *gap).is_some());
    faces.map(|gap| tried.gaps[gap].clone()).collect()
}

/// Buildings with plans that face each other within the reach of a usual gap and have none.
pub(super) fn neighbours_without(model: &Model) -> Vec<[usize; 2]> {
    let usual = ContactLaw {
        kind: DEFAULT_LAW,
        stiffness: CONCRETE_STIFFNESS,
        restitution: CONCRETE_RESTITUTION,
        restitution_is: RestitutionIs::Input,
    };
    let found = facing(model, &Gap::between(ALL_NEIGHBOURS, 0.0, usual));
    let pairs = found
        .iter()
        .filter_map(|gap| Some([gap.between[0]?, gap.between[1]?]));
    pairs.collect()
}

/// Reads all gaps. Without buildings, names are unknown, and only the rest is checked.
pub(super) fn read_all(
    reader: &mut Reader<'_>,
    field: &Field<'_>,
    buildings: Option<&[Building]>,
    walls: &[Wall],
) -> Vec<Gap> {
    let Some(entries) = field.entries() else {
        let found = field.node.describe();
        *reader.bad(field, format!("expected a list of gaps, found {found}")) =
            Some("write [[gap]] with double brackets; in JSON \"gap\": [{ … }]".into());
        return Vec::new();
    };
    if entries.len() > MOST_GAPS {
        let count = entries.len();
        reader.bad(
            field,
            format!("at most {MOST_GAPS} gaps are possible, found {count}"),
        );
        return Vec::new();
    }
    entries
        .iter()
        .filter_map(|entry| read(reader, entry, buildings, walls))
        .collect()
}

fn read(
    reader: &mut Reader<'_>,
    field: &Field<'_>,
    buildings: Option<&[Building]>,
    walls: &[Wall],
) -> Option<Gap> {
    let view = reader.open(field, &[Section::Gap])?;
    let has_plan = |building: &Building| matches!(building.structure, Structure::Tiers(_));
    let in_space = buildings.is_some_and(|list| list.iter().any(has_plan));
    let says_all = reader
        .get(&view, "between")
        .is_some_and(|field| matches!(&field.node.value, Value::Text(text) if text == ALL));
    let between = if in_space && (says_all || !view.has("between")) {
        Some(ALL_NEIGHBOURS)
    } else {
        neighbours(reader, &view, buildings, walls, false)
    };
    let widths = match reader.get(&view, "width") {
        Some(field) => widths(reader, &field),
        // Plans with their places say how wide the gap is.
        None if in_space => None,
        None => {
            reader.missing(&view, "width", "add width = \"100 mm\"");
            None
        }
    };
    let (in_plan, per_length) = plan_contact(reader, &view, in_space);
    let floors = floors(reader, &view);
    let level_tolerance = tolerance(reader, &view);
    let mut law = contact_law(reader, &view, in_plan.per_length);
    if let Some(stiffness) = per_length.and_then(|field| {
        let dimension = if law.kind.is_hertzian() {
            Dimension::HertzStiffnessPerLength
        } else {
            Dimension::StiffnessPerLength
        };
        reader.quantity(&field, dimension)
    }) {
        law.stiffness = stiffness;
    }
    let minimum_separation = optional(reader, &view, "minimum_separation", Dimension::Time);
    Some(Gap {
        between: between?,
        widths: widths.unwrap_or_else(|| vec![0.0]),
        floors: floors.unwrap_or(FloorPairs::Common),
        level_tolerance,
        law,
        minimum_separation: minimum_separation.unwrap_or(0.0),
        in_plan,
    })
}

/// How plans touch, and the stiffness per length, if it is given.
fn plan_contact<'n>(
    reader: &mut Reader<'_>,
    view: &View<'n>,
    in_space: bool,
) -> (PlanContact, Option<Field<'n>>) {
    let mut contact = PlanContact::default();
    if !in_space {
        for key in [
            "points",
            "reach",
            "stiffness_per_length",
            "friction",
            "tangential_stiffness",
        ] {
            if let Some(field) = reader.get(view, key) {
                *reader.bad(&field, "is for buildings with a plan") =
                    Some(format!("remove {key}, or give every building a plan"));
            }
        }
        return (contact, None);
    }
    if let Some(points) = reader
        .get(view, "points")
        .and_then(|field| reader.count(&field))
    {
        contact.points = points;
    }
    if let Some(field) = reader.get(view, "reach") {
        contact.reach = reader
            .quantity(&field, Dimension::Length)
            .unwrap_or(contact.reach);
    }
    let friction = optional(reader, view, "friction", Dimension::Dimensionless);
    contact.friction = friction.unwrap_or(contact.friction);
    contact.tangential_stiffness =
        optional(reader, view, "tangential_stiffness", Dimension::Stiffness);
    let per_length = reader.get(view, "stiffness_per_length");
    if let (Some(field), true) = (&per_length, view.has("stiffness")) {
        *reader.bad(field, "cannot be combined with stiffness") = Some("keep one of them".into());
    }
    contact.per_length = per_length.is_some();
    (contact, per_length)
}

/// One width, or one per contact.
fn widths(reader: &mut Reader<'_>, field: &Field<'_>) -> Option<Vec<f64>> {
    let Some(entries) = field.entries() else {
        return Some(vec![width(reader, field)?]);
    };
    if entries.len() > MOST_CONTACTS {
        let count = entries.len();
        reader.bad(
            field,
            format!("at most {MOST_CONTACTS} widths are possible, found {count}"),
        );
        return None;
    }
    let widths: Vec<_> = entries.iter().map(|entry| width(reader, entry)).collect();
    widths.into_iter().collect()
}

fn width(reader: &mut Reader<'_>, field: &Field<'_>) -> Option<f64> {
    let width = reader.quantity(field, Dimension::Length)?;
    if width < 0.0 {
        let found = field.node.describe();
        reader.bad(
            field,
            format!("must not be negative, found {found}; touching buildings have a gap of zero"),
        );
        return None;
    }
    Some(width)
}

/// Warns of gaps of one pair between the same floors: both push. A rubber bumper may stand out from a face.
pub(super) fn check_doubles(reader: &mut Reader<'_>, fields: &[Field<'_>], model: &Model) {
    let gaps: Vec<&Gap> = model.gaps.iter().take(fields.len()).collect();
    for (index, gap) in gaps.iter().enumerate() {
        let mut earlier = gaps[..index].iter();
        let Some(first) = earlier.position(|other| joins_the_same(other, gap, model)) else {
            continue;
        };
        let line = reader.line(&fields[first].node.span);
        reader.warn(
            &fields[index],
            &format!("joins floors that the [[gap]] of line {line} joins as well: when both are closed, their forces add"),
        );
    }
}

/// Whether two gaps of one pair have points in common.
fn joins_the_same(a: &Gap, b: &Gap, model: &Model) -> bool {
    let is_bumper = |gap: &Gap| matches!(gap.law.kind, LawKind::Rubber(_));
    if a.between != b.between || a.between == ALL_NEIGHBOURS || is_bumper(a) != is_bumper(b) {
        return false;
    }
    if a.floors == b.floors {
        return true;
    }
    let levels = a.between.map(|side| {
        let building = side.and_then(|index| model.buildings.get(index));
        building.map(Building::floor_levels).unwrap_or_default()
    });
    let height = |side: usize, level: &Level| match level {
        Level::Floor(floor) => floor
            .checked_sub(1)
            .and_then(|at| levels[side].get(at))
            .copied(),
        Level::Height(height) => Some(*height),
        Level::Wall => None,
    };
    // Heights of both points; `None` where a rule finds them.
    let points = |gap: &Gap| match &gap.floors {
        FloorPairs::Listed(pairs) => {
            // A wall is as high as what faces it.
            let both = |[left, right]: &[Level; 2]| match (height(0, left), height(1, right)) {
                (Some(left), Some(right)) => Some([left, right]),
                (one, other) => one.or(other).map(|at| [at; 2]),
            };
            Some(pairs.iter().filter_map(both).collect::<Vec<_>>())
        }
        FloorPairs::Heights(heights) => Some(heights.iter().map(|&at| [at; 2]).collect()),
        FloorPairs::Common | FloorPairs::All => None,
    };
    let near = |one: f64, other: f64| (one - other).abs() <= a.level_tolerance;
    let is_floor = |side: usize, at: f64| {
        levels[side].is_empty() || levels[side].iter().any(|&level| near(level, at))
    };
    match (points(a), points(b)) {
        (None, None) => true,
        (Some(one), Some(other)) => one.iter().any(|[left, right]| {
            let mut others = other.iter();
            others.any(|of_other| near(*left, of_other[0]) && near(*right, of_other[1]))
        }),
        // Every rule finds floors at equal height.
        (Some(listed), None) | (None, Some(listed)) => listed
            .iter()
            .any(|&[left, right]| near(left, right) && is_floor(0, left) && is_floor(1, right)),
    }
}
