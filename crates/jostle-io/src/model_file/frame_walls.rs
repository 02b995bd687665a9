//! `[[building.wall]]` and `[[building.coupling_beam]]`: walls at column lines of a frame, and the beams between them.

use std::collections::BTreeMap;
use std::ops::Range;

use jostle::hysteresis::{Backbone, Corners, Hysteresis, HysteresisRule, Side};
use jostle::{CouplingBeam, Frame, FramePlace, FrameWall, Section as CrossSection, WallHinge};

use super::brace::tables;
use super::hinges::read_spring;
use super::places::range;
use super::section::{Material, STAND_IN, Sides, own_mass, rectangle, rigidities};
use super::wall_fibres::{self, OfWall};
use crate::grade::ConcreteGrade;
use crate::keys::{AXIAL, Section, WALL_HINGES, WALL_STIFFNESS};
use crate::quantity::Dimension;
use crate::reader::{Field, Reader, View};
use crate::tree::{Node, Value};

/// Keys of a hinge of a wall.
pub(super) const HINGE: &[Section] = &[Section::WallHinge, Section::WallEnds];

/// Walls stand at a column line that is no farther from their place \[m\].
const SAME_LINE: f64 = 1e-3;

/// Initial stiffness of a hinge at the foot of a wall in units of EI over the height of its storey, as of columns \[–\].
const HINGE_INITIAL: f64 = 100.0;

/// The effective height of a wall over its height: the resultant of forces that grow linearly with height \[–\].
const EFFECTIVE_HEIGHT: f64 = 2.0 / 3.0;

/// Stands in after a fault, so that those of hinges are found as well.
const UNREAD: CrossSection = CrossSection {
    shear_rigidity: Some(1.0),
    ..STAND_IN
};

/// The frame in which walls stand.
#[derive(Clone, Copy)]
pub(super) struct Bays<'a> {
    pub(super) heights: &'a [f64],
    pub(super) spans: &'a [f64],
    /// Of columns and of beams.
    pub(super) materials: [Material; 2],
    /// Of the building, for walls with bars.
    pub(super) concrete: Option<ConcreteGrade>,
}

/// Walls and coupling beams of a frame.
#[derive(Default)]
pub(super) struct Walls {
    pub(super) walls: Vec<FrameWall>,
    pub(super) beams: Vec<CouplingBeam>,
    /// Sections by storey and line, and by floor and bay, from 0.
    pub(super) sections: [BTreeMap<FramePlace, CrossSection>; 2],
    /// Whether some could not be read, so that their places seem empty.
    pub(super) incomplete: bool,
}

impl Bays<'_> {
    fn lines(&self) -> Vec<f64> {
        let ends = self.spans.iter().scan(0.0, |x, span| {
            *x += span;
            Some(*x)
        });
        std::iter::once(0.0).chain(ends).collect()
    }
}

/// Reads the walls and the coupling beams of a frame.
pub(super) fn read(reader: &mut Reader<'_>, view: &View<'_>, bays: Bays<'_>) -> Walls {
    let mut all = Walls::default();
    // One per table, so that coupling beams can name them.
    let mut of_tables = Vec::new();
    for entry in tables(reader, view, "wall") {
        let found = read_wall(reader, &entry, bays);
        all.incomplete |= found.is_none();
        of_tables.push(found.as_ref().map(|(wall, _)| wall.clone()));
        let Some((wall, section)) = found else {
            continue;
        };
        for storey in wall.storeys[0]..=wall.storeys[1] {
            all.sections[0].insert([storey - 1, wall.line - 1], section);
        }
        all.walls.push(wall);
    }
    for entry in tables(reader, view, "coupling_beam") {
        let found = read_beams(reader, &entry, bays, &of_tables);
        all.incomplete |= found.is_none();
        for (beam, section) in found.unwrap_or_default() {
            let place = [beam.floor - 1, beam.bay - 1];
            if all.sections[1].insert(place, section).is_some() {
                *reader.bad(
                    &entry,
                    format!(
                        "gives bay {} at floor {} a second time",
                        beam.bay, beam.floor
                    ),
                ) = Some("leave it out here, or name other bays and floors".into());
                break;
            }
            all.beams.push(beam);
        }
    }
    all
}

fn read_wall(
    reader: &mut Reader<'_>,
    entry: &Field<'_>,
    bays: Bays<'_>,
) -> Option<(FrameWall, CrossSection)> {
    let view = reader.open(entry, &[Section::FrameWall])?;
    let line = read_line(reader, &view, bays);
    let storeys = range(reader, &view, "storeys", bays.heights.len());
    let sides: Sides = [
        ("thickness", "\"250 mm\""),
        ("length", "\"3 m\", along the frame"),
    ];
    let length = match reader.get(&view, "length") {
        Some(field) => reader.positive(&field, Dimension::Length),
        None => {
            reader.missing(
                &view,
                "length",
                "add length = \"3 m\", along the frame: beams span between the faces of walls",
            );
            None
        }
    };
    let thickness = reader.get(&view, "thickness").map(|field| {
        let thickness = reader.quietly(|reader| reader.positive(&field, Dimension::Length));
        (field, thickness)
    });
    if let (Some(length), Some((field, Some(thickness)))) = (length, &thickness)
        && *thickness > length
    {
        *reader.bad(field, format!("is more than the length of the wall, {length} m")) =
            Some("length is measured along the frame and thickness across; a column stands in [[building.column]]".into());
        return None;
    }
    let [material, _] = bays.materials;
    let by_size = thickness.is_some();
    let section = read_section(reader, &view, entry, sides, by_size, material);
    let line_mass = match reader.get(&view, "mass") {
        Some(field) => reader.quantity(&field, Dimension::LineMass),
        None => own_mass(reader, &view, section, !by_size, material),
    };
    let stiffness_factors = read_factors(
        reader,
        &view,
        [material.factor, material.poisson_ratio],
        None,
    );
    let stand_in = reduced(
        section.unwrap_or(UNREAD),
        stiffness_factors.unwrap_or([1.0; 2]),
    );
    let [first, last] = storeys.unwrap_or([1, 1]);
    let heights = &bays.heights[first - 1..last];
    let foot = Foot {
        rigidity: stand_in.flexural_rigidity,
        storey: heights[0],
        height: heights.iter().sum(),
        length: length.unwrap_or(1.0),
    };
    let hinge = reader.get(&view, "hinge");
    let (hinges, fibres) = match hinge.filter(|hinge| wall_fibres::asked(reader, hinge)) {
        Some(field) => {
            let of_wall = OfWall {
                size: [thickness.and_then(|(_, thickness)| thickness), length],
                storeys: (first, heights),
                concrete: bays.concrete,
                in_space: false,
            };
            let fibres = wall_fibres::read(reader, &view, &field, of_wall);
            (Some(Vec::new()), fibres)
        }
        None => {
            wall_fibres::refuse(reader, &view, false);
            let hinges = reader.get(&view, "hinge");
            let hinges = hinges.map(|field| read_hinges(reader, &field, &foot, first, heights));
            (hinges.unwrap_or(Some(Vec::new())), Some(BTreeMap::new()))
        }
    };
    let shear = reader.get(&view, "shear_hinge");
    let shear = shear.map(|field| read_sliding(reader, &field, stand_in, heights[0]));
    let stiffness_factors = stiffness_factors?;
    let section = CrossSection {
        line_mass: line_mass?,
        ..reduced(section?, stiffness_factors)
    };
    let wall = FrameWall {
        line: line?,
        storeys: storeys?,
        length: length?,
        hinges: hinges?,
        fibres: fibres?,
        shear: match shear {
            Some(shear) => Some(shear?),
            None => None,
        },
        stiffness_factors,
    };
    Some((wall, section))
}

/// The column line of a wall, from 1.
fn read_line(reader: &mut Reader<'_>, view: &View<'_>, bays: Bays<'_>) -> Option<usize> {
    let lines = bays.lines();
    match (reader.get(view, "at"), reader.get(view, "line")) {
        (Some(field), Some(_)) => {
            *reader.bad(&field, "and line are both given") = Some("leave out one of them".into());
            None
        }
        (Some(field), None) => {
            let at = reader.quantity(&field, Dimension::Length)?;
            let found = lines.iter().position(|line| (line - at).abs() <= SAME_LINE);
            if found.is_none() {
                let known: Vec<String> = lines.iter().map(|line| format!("{line}")).collect();
                *reader.bad(&field, format!("{at} m is at no column line")) = Some(format!(
                    "column lines stand at {} m; add one by spans, or name one by line",
                    known.join(", ")
                ));
            }
            Some(found? + 1)
        }
        (None, Some(field)) => {
            let line = reader.count(&field)?;
            if !(1..=lines.len()).contains(&line) {
                *reader.bad(
                    &field,
                    format!("must lie between 1 and {}, found {line}", lines.len()),
                ) = Some(
                    "column lines are counted from 1 at the left; there is one more than spans"
                        .into(),
                );
                return None;
            }
            Some(line)
        }
        (None, None) => {
            reader.missing(view, "at", "add at = \"4.5 m\", where its axis stands from the first column line on; or line = 2");
            None
        }
    }
}

/// A rectangle of these sides, or rigidities. Shear deforms it unless the table says otherwise.
fn read_section(
    reader: &mut Reader<'_>,
    view: &View<'_>,
    entry: &Field<'_>,
    sides: Sides,
    by_size: bool,
    material: Material,
) -> Option<CrossSection> {
    let shears = match reader.get(view, "shear") {
        Some(field) => reader.choice(&field, AXIAL, &[])? == "flexible",
        None => true,
    };
    let by_rigidity = view.has("EI") || view.has("EA") || view.has("GA");
    match (by_size, by_rigidity) {
        (true, true) => {
            *reader.bad(entry, "has both a size and rigidities") =
                Some(format!("keep either {}, or EI, EA and GA", sides[0].0));
            None
        }
        (false, true) => rigidities(reader, view, shears),
        _ => rectangle(reader, view, Material { shears, ..material }, sides),
    }
}

/// Factors on EI and GA of walls, or of coupling beams with their clear length over their depth if that is known; `None` after a fault.
/// `usual`: the factor where none is stated, and Poisson's ratio.
pub(super) fn read_factors(
    reader: &mut Reader<'_>,
    view: &View<'_>,
    usual: [f64; 2],
    slenderness: Option<Option<f64>>,
) -> Option<[f64; 2]> {
    let Some(field) = reader.get(view, "stiffness_factor") else {
        return Some([usual[0], 1.0]);
    };
    let is_word = field
        .as_text()
        .is_some_and(|text| text.trim().parse::<f64>().is_err());
    if !is_word {
        let factor = reader.positive(&field, Dimension::Dimensionless)?;
        return Some([factor, 1.0]);
    }
    if reader.choice(&field, WALL_STIFFNESS, &[])? == "en1998" {
        // EN 1998-1, 4.3.1(7): half of bending and shear.
        return Some([0.5, 0.5]);
    }
    // ACI 369.1-22 as ASCE 41-23 has it: rigidities in shear are parts of E A, where the full one is 5/6 G A.
    let full = 5.0 / 6.0 / (2.0 * (1.0 + usual[1]));
    match slenderness {
        None => Some([0.25, 0.15 / full]),
        Some(Some(slenderness)) => Some([(0.05 * slenderness).min(0.2), 0.2 / full]),
        Some(None) => {
            *reader.bad(
                &field,
                "needs the depth of the beam: its factor on EI follows from length over depth",
            ) = Some("give width and depth instead of EI, or stiffness_factor = 0.1".into());
            None
        }
    }
}

fn reduced(section: CrossSection, [bending, shear]: [f64; 2]) -> CrossSection {
    CrossSection {
        flexural_rigidity: bending * section.flexural_rigidity,
        shear_rigidity: section.shear_rigidity.map(|rigidity| shear * rigidity),
        ..section
    }
}

/// A wall that yields: EI, height of the storey of the hinge, its height and its length \[N·m², m\].
pub(super) struct Foot {
    rigidity: f64,
    storey: f64,
    height: f64,
    length: f64,
}

/// L_p = 0.2 l_w + 0.044 h_e of a wall by its length and its height (Paulay and Priestley 1992) \[m\].
pub(super) fn hinge_length(length: f64, height: f64) -> f64 {
    0.2 * length + 0.044 * EFFECTIVE_HEIGHT * height
}

/// Floors above which a wall yields, and whether it does so at the heads of their storeys as well. `within`: those at the feet of its
/// storeys.
pub(super) fn read_floors(
    reader: &mut Reader<'_>,
    view: &View<'_>,
    within: Range<usize>,
) -> Option<(Vec<usize>, bool)> {
    let everywhere = match reader.get(view, "ends") {
        Some(field) => reader.choice(&field, WALL_HINGES, &[])? == "all",
        None => false,
    };
    let lowest = within.start;
    let floors = match reader.get(view, "floors") {
        None if everywhere => within.collect(),
        None => vec![lowest],
        Some(stated) if view.has("ends") => {
            *reader.bad(&stated, "and ends are both given") = Some("leave out one of them".into());
            return None;
        }
        Some(stated) => {
            let mut floors = Vec::new();
            for entry in stated.entries().unwrap_or_else(|| vec![stated.clone()]) {
                let floor = reader.count(&entry)?;
                if !within.contains(&floor) || floors.contains(&floor) {
                    *reader.bad(
                        &entry,
                        format!(
                            "must lie between {lowest} and {} and be named once, found {floor}",
                            within.end - 1
                        ),
                    ) = Some(format!(
                        "floor {lowest} is the foot of the wall, which yields above each floor; ends = \"all\" are both ends of every storey"
                    ));
                    return None;
                }
                floors.push(floor);
            }
            floors
        }
    };
    Some((floors, everywhere))
}

/// Hinges of a wall: at its foot, above floors that the file names, or at both ends of every storey. `first`: its lowest storey, from 1.
fn read_hinges(
    reader: &mut Reader<'_>,
    field: &Field<'_>,
    foot: &Foot,
    first: usize,
    heights: &[f64],
) -> Option<Vec<WallHinge>> {
    let view = reader.reopen(field, HINGE)?;
    let lowest = first - 1;
    let (floors, everywhere) = read_floors(reader, &view, lowest..lowest + heights.len())?;
    for key in ["cracking", "yield"] {
        let stated = reader.get(&view, key);
        let Some(count) = stated
            .as_ref()
            .and_then(|field| Some(field.entries()?.len()))
        else {
            continue;
        };
        if let Some(stated) = stated.filter(|_| count != floors.len()) {
            let (levels, what) = (floors.len(), if everywhere { "storeys" } else { "floors" });
            *reader.bad(
                &stated,
                format!("has {count} moments for {levels} {what} with hinges"),
            ) = Some(
                "give one moment for all, or a list with one for each, from the lowest up".into(),
            );
            return None;
        }
    }
    let mut hinges = Vec::new();
    for (level, floor) in floors.into_iter().enumerate() {
        let foot = Foot {
            storey: heights[floor - lowest],
            ..*foot
        };
        let own = at_level(field.node, level);
        let hysteresis = read_hinge(reader, &field.holding(&own), &foot)?;
        for at_head in [false, true] {
            if everywhere || !at_head {
                hinges.push(WallHinge {
                    storey: floor + 1,
                    at_head,
                    hysteresis,
                });
            }
        }
    }
    Some(hinges)
}

/// Whether a hinge is no longer than its storey.
pub(super) fn fits(reader: &mut Reader<'_>, field: &Field<'_>, length: f64, storey: f64) -> bool {
    if length > storey {
        *reader.bad(
            field,
            format!("{length:.3} m is more than the height of its storey, {storey} m"),
        ) = Some("give a shorter length".into());
    }
    length <= storey
}

/// The table of hinges with the moments of one level in place of lists.
fn at_level(hinges: &Node, level: usize) -> Node {
    let mut own = hinges.clone();
    if let Value::Table(table) = &mut own.value {
        for entry in &mut table.entries {
            let is_moment = ["cracking", "yield"].contains(&&*entry.key);
            let Value::List(list) = &entry.node.value else {
                continue;
            };
            if let Some(of_level) = list.get(level).filter(|_| is_moment).cloned() {
                entry.node = of_level;
            }
        }
    }
    own
}

/// A hinge of a wall in a storey.
fn read_hinge(reader: &mut Reader<'_>, field: &Field<'_>, foot: &Foot) -> Option<Hysteresis> {
    const KEYS: &[Section] = HINGE;
    let view = reader.reopen(field, KEYS)?;
    let usual = foot.rigidity / foot.storey;
    let initial = match (reader.get(&view, "stiffness"), reader.get(&view, "initial")) {
        (Some(field), Some(_)) => {
            *reader.bad(&field, "and initial are both given") =
                Some("leave out one of them: stiffness is initial times EI over the height of the lowest storey".into());
            None
        }
        (Some(field), None) => reader.positive(&field, Dimension::RotationalStiffness),
        (None, Some(field)) => {
            let times = reader.positive(&field, Dimension::Dimensionless);
            times.map(|times| times * usual)
        }
        (None, None) => Some(HINGE_INITIAL * usual),
    };
    let Some(stated) = reader.get(&view, "length") else {
        if !view.has("stiffness") && !view.has("initial") && view.has("yield") {
            reader.missing(&view, "stiffness", "post_cracking and post_yield are parts of it: add stiffness = \"60 GN.m/rad\", initial = 100 (in units of EI over the height of the lowest storey), or length = \"paulay-priestley\"");
            return None;
        }
        return read_spring(reader, field, KEYS, initial, Dimension::Moment);
    };
    let length = match stated.as_text() {
        Some("paulay-priestley") => hinge_length(foot.length, foot.height),
        _ => reader.positive(&stated, Dimension::Length)?,
    };
    if !fits(reader, &stated, length, foot.storey) {
        return None;
    }
    // As a moment over curvature times that length.
    let curvature = foot.rigidity / length;
    let given = read_spring(reader, field, KEYS, Some(curvature), Dimension::Moment)?;
    let (rule, initial) = (given.rule(), initial?);
    let corners = Side::BOTH.map(|side| {
        let side = given.backbone().side(side);
        // The wall itself bends elastically over its whole height; the hinge adds what is beyond.
        let beyond = |slope: f64| slope / (1.0 - slope / curvature) / initial;
        match rule {
            HysteresisRule::Elastic => Corners::bilinear(1.0, 1.0),
            HysteresisRule::Bilinear => {
                Corners::bilinear(side.yielding.force, beyond(side.post_yield))
            }
            _ => Corners {
                cracking: side.cracking.force,
                yielding: side.yielding.force,
                post_cracking: beyond(side.post_cracking),
                post_yield: beyond(side.post_yield),
            },
        }
    });
    let hinge = Backbone::from_forces(initial, corners[0], corners[1])
        .and_then(|backbone| Hysteresis::new(rule, backbone));
    match hinge {
        Ok(hinge) => Some(hinge),
        Err(faults) => {
            let problem = faults
                .first()
                .map_or_else(String::new, |fault| fault.problem.clone());
            *reader.bad(
                field,
                format!("has no sound curve over a length of {length:.3} m: {problem}"),
            ) = Some(
                "give smaller post_cracking and post_yield, which are parts of EI there".into(),
            );
            None
        }
    }
}

/// Shear of a wall or a coupling beam of this length that yields: initially that of GA, or stated.
fn read_sliding(
    reader: &mut Reader<'_>,
    field: &Field<'_>,
    section: CrossSection,
    length: f64,
) -> Option<Hysteresis> {
    const KEYS: &[Section] = &[Section::LinkHinge, Section::Sliding];
    let view = reader.reopen(field, KEYS)?;
    let stiffness = match (reader.get(&view, "stiffness"), section.shear_rigidity) {
        (Some(field), _) => reader.positive(&field, Dimension::Stiffness)?,
        (None, Some(rigidity)) => rigidity / length,
        (None, None) => {
            reader.missing(&view, "stiffness", "add stiffness = \"500 MN/m\", force over sliding before it yields; or let shear be \"flexible\", with GA");
            return None;
        }
    };
    read_spring(reader, field, KEYS, Some(stiffness), Dimension::Force)
}

/// Coupling beams of a table, with their section.
fn read_beams(
    reader: &mut Reader<'_>,
    entry: &Field<'_>,
    bays: Bays<'_>,
    walls: &[Option<FrameWall>],
) -> Option<Vec<(CouplingBeam, CrossSection)>> {
    let view = reader.open(entry, &[Section::CouplingBeam])?;
    let places = beam_places(reader, &view, [bays.heights.len(), bays.spans.len()], walls);
    let bay = places.map_or(1, |([first, _], _)| first);
    // Between the faces of the walls.
    let half = |line: usize| {
        let walls = walls.iter().flatten().filter(|wall| wall.line == line);
        walls.map(|wall| 0.5 * wall.length).fold(0.0, f64::max)
    };
    let span = bays.spans.get(bay - 1);
    let clear = span.map_or(1.0, |span| span - half(bay) - half(bay + 1));
    let sides: Sides = [("width", "\"300 mm\""), ("depth", "\"600 mm\"")];
    let by_size = view.has("width") || view.has("depth");
    let [_, material] = bays.materials;
    let section = read_section(reader, &view, entry, sides, by_size, material);
    let depth = reader.get(&view, "depth");
    let depth =
        depth.and_then(|field| reader.quietly(|reader| reader.positive(&field, Dimension::Length)));
    let slenderness = depth.map(|depth| clear / depth);
    let stiffness_factors = read_factors(
        reader,
        &view,
        [material.factor, material.poisson_ratio],
        Some(slenderness),
    );
    let stand_in = reduced(
        section.unwrap_or(UNREAD),
        stiffness_factors.unwrap_or([1.0; 2]),
    );
    // Without a clear length, a fault of the walls noted elsewhere, any stands in.
    let length = if clear > 0.0 { clear } else { 1.0 };
    let shear = reader.get(&view, "hinge");
    let shear = shear.map(|field| read_sliding(reader, &field, stand_in, length));
    let ([first, last], floors) = places?;
    let stiffness_factors = stiffness_factors?;
    let section = CrossSection {
        line_mass: 0.0,
        ..reduced(section?, stiffness_factors)
    };
    let shear = match shear {
        Some(shear) => Some(shear?),
        None => None,
    };
    let bays = first..=last;
    let all = bays.flat_map(|bay| (floors[0]..=floors[1]).map(move |floor| (floor, bay)));
    let beams = all.map(|(floor, bay)| {
        let beam = CouplingBeam {
            floor,
            bay,
            shear,
            stiffness_factors,
        };
        (beam, section)
    });
    Some(beams.collect())
}

/// First and last bay, and first and last floor, of the coupling beams of a table; `None` after a fault. `most`: storeys and bays.
fn beam_places(
    reader: &mut Reader<'_>,
    view: &View<'_>,
    most: [usize; 2],
    walls: &[Option<FrameWall>],
) -> Option<([usize; 2], [usize; 2])> {
    let [storeys, bays] = most;
    let places = match (reader.get(view, "between"), reader.get(view, "bay")) {
        (Some(field), Some(_)) => {
            *reader.bad(&field, "and bay are both given") = Some("leave out one of them".into());
            None
        }
        (Some(field), None) => between(reader, &field, walls),
        (None, Some(_)) => {
            let named = range(reader, view, "bay", bays);
            named.map(|named| (named, [1, storeys]))
        }
        (None, None) => {
            reader.missing(view, "between", "add between = [1, 2], the numbers of two walls in the order of the file; or bay = 1");
            None
        }
    };
    let stated = reader.get(view, "floors");
    let stated = stated.map(|_| range(reader, view, "floors", storeys));
    let (bays, floors) = places?;
    Some((bays, stated.unwrap_or(Some(floors))?))
}

/// The table, from 0, of a coupling beam that is counted over all of them.
pub(super) fn table_of_beam(
    reader: &mut Reader<'_>,
    view: &View<'_>,
    frame: &Frame,
    beam: usize,
) -> Option<usize> {
    let walls: Vec<_> = frame.walls.iter().cloned().map(Some).collect();
    let most = [frame.storey_heights.len(), frame.spans.len()];
    let mut before = 0;
    for (table, entry) in tables(reader, view, "coupling_beam").iter().enumerate() {
        let view = reader.reopen(entry, &[Section::CouplingBeam])?;
        let (bays, floors) = beam_places(reader, &view, most, &walls)?;
        before += (1 + bays[1] - bays[0]) * (1 + floors[1] - floors[0]);
        if beam < before {
            return Some(table);
        }
    }
    None
}

/// The bay between two walls, and the floors at which both stand.
fn between(
    reader: &mut Reader<'_>,
    field: &Field<'_>,
    walls: &[Option<FrameWall>],
) -> Option<([usize; 2], [usize; 2])> {
    let numbers = match field.entries().as_deref() {
        Some([first, last]) => [reader.count(first)?, reader.count(last)?],
        _ => {
            reader.bad(field, "expected the numbers of two walls, such as [1, 2]");
            return None;
        }
    };
    let missing = numbers
        .iter()
        .find(|number| !(1..=walls.len()).contains(*number));
    if let Some(number) = missing {
        *reader.bad(field, format!("names wall {number}, but there are {}", walls.len())) = Some(
            "walls are counted from 1 in the order of [[building.wall]]; add the wall, or name a bay".into(),
        );
        return None;
    }
    // Faults of walls stand there.
    let [Some(mut left), Some(mut right)] = numbers.map(|number| walls[number - 1].as_ref()) else {
        return None;
    };
    if left.line > right.line {
        (left, right) = (right, left);
    }
    if left.line + 1 != right.line {
        *reader.bad(
            field,
            format!(
                "names walls at lines {} and {}, which are no neighbours",
                left.line, right.line
            ),
        ) = Some("a coupling beam crosses one bay; name walls at neighbouring lines".into());
        return None;
    }
    let first = left.storeys[0]
        .max(right.storeys[0])
        .saturating_sub(1)
        .max(1);
    let last = left.storeys[1].min(right.storeys[1]);
    if last < first {
        *reader.bad(field, "names walls that share no storey") =
            Some("name walls that stand beside each other".into());
        return None;
    }
    Some(([left.line; 2], [first, last]))
}
