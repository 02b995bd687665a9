//! `hinge` of a wall with `rule = "fibre"`: ends of its storeys made of the bars and the concrete of its section.

use std::collections::BTreeMap;

use jostle::ColumnFibres;
use jostle_section::{FibreOptions, SectionFault, WallReinforcement, WallSection};

use super::fibre_hinges::{self, FibreLaws};
use super::frame_walls::{HINGE, fits, hinge_length, read_floors};
use super::reinforced::{self, Materials, understood};
use crate::grade::ConcreteGrade;
use crate::keys::Section;
use crate::quantity::Dimension;
use crate::reader::{Field, Reader, View};
use crate::tree::Value;

/// Keys of a wall that only fibres use; of a plane frame, `concrete` as well.
const OF_SECTION: [&str; 6] = ["bars", "steel", "strength", "cover", "ties", "concrete"];

/// Keys of moment hinges.
const OF_MOMENTS: [&str; 10] = [
    "gamma",
    "pinching",
    "unloading_exponent",
    "damage",
    "cracking",
    "yield",
    "post_cracking",
    "post_yield",
    "stiffness",
    "initial",
];

/// Layers of concrete over the length of a wall where nothing is said.
const USUAL_LAYERS: usize = 40;

/// Parts of the thickness of a wall of a space frame where nothing is said.
const USUAL_ACROSS: usize = 4;

/// Keys of a hinge of a wall of a space frame with fibres.
const HINGE_IN_SPACE: &[Section] = &[Section::SpaceWallHinge, Section::WallEnds];

/// A wall that can have fibres.
#[derive(Clone, Copy)]
pub(super) struct OfWall<'a> {
    /// Its thickness and its length \[m\].
    pub(super) size: [Option<f64>; 2],
    /// Its lowest storey, from 1, and the heights of its storeys \[m\].
    pub(super) storeys: (usize, &'a [f64]),
    /// Concrete of the building.
    pub(super) concrete: Option<ConcreteGrade>,
    /// Whether it bends across as well.
    pub(super) in_space: bool,
}

impl OfWall<'_> {
    fn keys(&self) -> &'static [Section] {
        match self.in_space {
            true => HINGE_IN_SPACE,
            false => HINGE,
        }
    }
}

/// Whether a hinge of a wall asks for fibres.
pub(super) fn asked(reader: &mut Reader<'_>, field: &Field<'_>) -> bool {
    let view = reader.quietly(|reader| reader.reopen(field, HINGE));
    view.is_some_and(|view| fibre_hinges::asked(reader, &view))
}

/// The same of a wall of a space frame, whose hinges with moments have no rule of their own; `None` after a fault.
pub(super) fn asked_in_space(reader: &mut Reader<'_>, field: &Field<'_>) -> Option<bool> {
    let view = reader.quietly(|reader| reader.reopen(field, HINGE_IN_SPACE))?;
    let Some(rule) = reader.get(&view, "rule") else {
        return Some(false);
    };
    if fibre_hinges::asked(reader, &view) {
        return Some(true);
    }
    *reader.bad(
        &rule,
        "must be \"fibre\" where a wall of a space frame has a rule of its own",
    ) = Some("leave it out: hinges with moments have the rule of hinges of the building".into());
    None
}

/// Notes keys that have no meaning without fibres.
pub(super) fn refuse(reader: &mut Reader<'_>, wall: &View<'_>, in_space: bool) {
    let own = if in_space { 5 } else { 6 };
    for key in OF_SECTION.into_iter().take(own) {
        if let Some(field) = reader.get(wall, key) {
            *reader.bad(&field, "has no meaning without fibres") = Some(format!(
                "remove {key}, or add hinge = {{ rule = \"fibre\", length = \"paulay-priestley\" }}"
            ));
        }
    }
    let hinge = reader.get(wall, "hinge").filter(|_| !in_space);
    if let Some(view) = hinge.and_then(|field| reader.reopen(&field, HINGE)) {
        fibre_hinges::refuse_laws(reader, &view);
    }
}

/// Fibres of a wall by storey, from 1, with its left end first; `None` after faults.
pub(super) fn read(
    reader: &mut Reader<'_>,
    wall: &View<'_>,
    field: &Field<'_>,
    of_wall: OfWall<'_>,
) -> Option<BTreeMap<usize, ColumnFibres>> {
    let view = reader.open(field, of_wall.keys())?;
    let (first, heights) = of_wall.storeys;
    let of_moments = OF_MOMENTS.into_iter().filter(|_| !of_wall.in_space);
    for key in of_moments {
        if let Some(field) = reader.get(&view, key) {
            *reader.bad(&field, "cannot be combined with rule = \"fibre\"") = Some(format!(
                "remove {key}: fibres follow from the bars of the wall"
            ));
        }
    }
    let lowest = first - 1;
    let places = read_floors(reader, &view, lowest..lowest + heights.len());
    let laws = FibreLaws::read(reader, &view, "0.2 l + 0.044 h", of_wall.in_space);
    let section = read_section(reader, wall, field, of_wall.size, of_wall.concrete);
    let ((floors, everywhere), laws, section) = (places?, laws?, section?);
    let usual = hinge_length(of_wall.size[1]?, heights.iter().sum());
    let options = FibreOptions {
        across: of_wall.in_space.then(|| laws.across(USUAL_ACROSS)),
        ..laws.options(usual, USUAL_LAYERS)
    };
    let mut limits = section.strain_limits();
    limits.extend(laws.limits());
    let fibres = match section.fibres(&options) {
        Ok(fibres) => fibres,
        Err(faults) => {
            let problem = faults.into_iter().next().map(|fault| fault.problem);
            reader.bad(field, problem.unwrap_or_default());
            return None;
        }
    };
    let stated = reader.get(&view, "length")?;
    let own = ColumnFibres {
        length: options.length,
        at_ends: [true, everywhere],
        fibres,
        limits,
    };
    let mut all = BTreeMap::new();
    for floor in floors {
        if !fits(reader, &stated, own.length, heights[floor - lowest]) {
            return None;
        }
        all.insert(floor + 1, own.clone());
    }
    Some(all)
}

/// The section of a wall with its bars; `None` after faults.
fn read_section(
    reader: &mut Reader<'_>,
    wall: &View<'_>,
    hinge: &Field<'_>,
    size: [Option<f64>; 2],
    of_building: Option<ConcreteGrade>,
) -> Option<WallSection> {
    if !wall.has("bars") {
        *reader.bad(hinge, "takes fibres from the section, but the wall has no bars") = Some(
            "add steel = \"HRB400\" and bars = { edges = \"8 d20\", edge_length = \"500 mm\", web = \"16 d10\" } to the wall".into(),
        );
    } else if !wall.has("thickness")
        && let Some(bars) = reader.get(wall, "bars")
    {
        *reader.bad(&bars, "needs the size of the section") =
            Some("give thickness instead of EI, EA and GA".into());
    }
    let lay = |bars: WallReinforcement, [thickness, length]: [f64; 2], materials: Materials| {
        let (concrete, steel, cover, ties) = materials;
        let laid = WallSection::new(thickness, length, concrete, steel, &bars, cover, ties);
        laid.map_err(|faults| {
            // Words of a wall.
            let renamed = faults.into_iter().map(|fault| SectionFault {
                field: match fault.field {
                    "width" => "thickness",
                    "depth" => "length",
                    other => other,
                },
                ..fault
            });
            renamed.collect::<Vec<_>>()
        })
    };
    let read = reinforced::read_laid(reader, wall, |_| size, of_building, read_bars, lay)?;
    Some(read.0)
}

/// Bars of a whole section as those of columns, or of edges and a web.
fn read_bars(reader: &mut Reader<'_>, field: &Field<'_>) -> Option<WallReinforcement> {
    if !matches!(field.node.value, Value::Table(_)) {
        return reinforced::read_bars(reader, field).map(WallReinforcement::Whole);
    }
    let view = reader.open(field, &[Section::WallBars])?;
    let edge = match reader.get(&view, "edges") {
        Some(field) => reader.text(&field),
        None => {
            reader.missing(
                &view,
                "edges",
                "add edges = \"8 d20\", the bars of each edge",
            );
            None
        }
    };
    let length = match reader.get(&view, "edge_length") {
        Some(field) => reader.positive(&field, Dimension::Length),
        None => {
            reader.missing(
                &view,
                "edge_length",
                "add edge_length = \"500 mm\", along the wall",
            );
            None
        }
    };
    let web = reader.get(&view, "web").map(|field| reader.text(&field));
    let web = match web {
        Some(text) => Some(text?),
        None => None,
    };
    let bars = WallReinforcement::with_edges(&edge?, length?, web.as_deref());
    understood(reader, field, bars)
}
