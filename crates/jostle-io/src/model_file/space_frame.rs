//! `kind = "space-frame"`: columns at the crossings of grid lines, beams along the lines.

use std::collections::{BTreeMap, BTreeSet};

use jostle::Section as CrossSection;
use jostle::{
    DiagonalPlace, PlanAxis, PlanPoint, SpaceFrame, SpaceMember, SpacePlace, SpaceSection,
};
use jostle_section::Span;
use jostle_section::capacity::SteelMember;

use super::brace::{self, Bays, Widths};
use super::building::per_storey;
use super::frame::{
    CONCRETE_DENSITY, flexible_members, read_density, read_poisson_ratio, stiffness_factors,
};
use super::places::{range, read_omit};
use super::plan::pair;
use super::reinforced::{self, KnownSection};
use super::section::{self, read_modulus, read_modulus_beside_bars};
use super::slab::{self, OnSlab};
use super::space_hinges::{Moments, SpaceHinges};
use super::steel_profile;
use super::{fibre_hinges, infill, joint, rigid_ends, space_walls};
use crate::keys::{AXIAL, SECTION_CONCRETES, Section};
use crate::quantity::Dimension;
use crate::reader::{Field, Reader, View};

/// Most lines in one direction.
const MOST_LINES: usize = 60;

/// Distance from a plan up to which columns and beams belong to it \[m\].
const BESIDE: f64 = 0.01;

/// The lines of a grid, and how it stands.
pub(super) struct Grid {
    pub(super) lines: [Vec<f64>; 2],
    /// Unit vector of its lines along x on the site.
    pub(super) direction: PlanPoint,
}

impl Grid {
    /// Reads `lines_x`, `lines_y` and `angle`.
    pub(super) fn read(reader: &mut Reader<'_>, view: &View<'_>) -> Self {
        let lines = ["lines_x", "lines_y"].map(|key| read_lines(reader, view, key));
        let angle = reader
            .get(view, "angle")
            .and_then(|field| reader.quantity(&field, Dimension::Dimensionless));
        let direction = angle.map_or([1.0, 0.0], |angle| [libm::cos(angle), libm::sin(angle)]);
        Self { lines, direction }
    }

    /// The rectangle of its outer lines.
    pub(super) fn rectangle(&self) -> Vec<PlanPoint> {
        let [[x0, x1], [y0, y1]] = self.lines.each_ref().map(|lines| {
            let first = lines.first().copied().unwrap_or(0.0);
            [first, lines.last().copied().unwrap_or(first)]
        });
        vec![[x0, y0], [x1, y0], [x1, y1], [x0, y1]]
    }

    /// Turns a point of the plan about its origin as the grid is turned.
    pub(super) fn turned(&self, [x, y]: PlanPoint) -> PlanPoint {
        let [c, s] = self.direction;
        [c * x - s * y, s * x + c * y]
    }
}

fn read_lines(reader: &mut Reader<'_>, view: &View<'_>, key: &'static str) -> Vec<f64> {
    const STAND_IN: [f64; 2] = [0.0, 6.0];
    let Some(field) = reader.get(view, key) else {
        let across = if key == "lines_x" { "x" } else { "y" };
        reader.missing(
            view,
            key,
            format!("add where the grid lines stand along {across}: {key} = [\"0 m\", \"6 m\", \"11 m\"]"),
        );
        return STAND_IN.to_vec();
    };
    let Some(entries) = field.entries().filter(|list| !list.is_empty()) else {
        let found = field.node.describe();
        *reader.bad(
            &field,
            format!("expected a list of places of lines, found {found}"),
        ) = Some(format!("write {key} = [\"0 m\", \"6 m\", \"11 m\"]"));
        return STAND_IN.to_vec();
    };
    if entries.len() > MOST_LINES {
        let count = entries.len();
        reader.bad(
            &field,
            format!("has {count} lines; at most {MOST_LINES} are possible"),
        );
        return STAND_IN.to_vec();
    }
    let mut lines = Vec::with_capacity(entries.len());
    for entry in &entries {
        let Some(line) = reader.quantity(entry, Dimension::Length) else {
            return STAND_IN.to_vec();
        };
        lines.push(line);
    }
    lines
}

/// Material and flexibility of columns or beams.
#[derive(Clone, Copy)]
pub(super) struct Material {
    pub(super) modulus: Option<f64>,
    /// Whether the building states a modulus in numbers.
    pub(super) modulus_is_stated: bool,
    /// Whether a fault of the modulus was noted.
    pub(super) modulus_is_bad: bool,
    /// Density of columns \[kg/m³\].
    pub(super) density: f64,
    pub(super) poisson_ratio: f64,
    /// Factor on EI, and on GJ.
    pub(super) factors: [f64; 2],
    pub(super) shears: bool,
}

/// Columns, beams along x, beams across.
#[derive(Clone, Copy, PartialEq)]
pub(super) enum Sort {
    Column,
    BeamX,
    BeamY,
}

impl Sort {
    const ALL: [Self; 3] = [Self::Column, Self::BeamX, Self::BeamY];

    fn key(self) -> &'static str {
        match self {
            Self::Column => "column",
            Self::BeamX => "beam_x",
            Self::BeamY => "beam_y",
        }
    }

    /// The place that begins at a crossing.
    pub(super) fn place(self, [x, y]: [usize; 2], storey: usize) -> SpacePlace {
        match self {
            Self::Column => SpacePlace::Column {
                line: [x, y],
                storey,
            },
            Self::BeamX => SpacePlace::BeamX {
                span: x,
                line: y,
                floor: storey,
            },
            Self::BeamY => SpacePlace::BeamY {
                line: x,
                span: y,
                floor: storey,
            },
        }
    }
}

/// A space frame, the sections of its members that have bars, and the masses of its panels on floors from 0, each at a point of the site.
pub(super) struct ReadFrame {
    pub(super) frame: SpaceFrame,
    pub(super) sections: BTreeMap<SpacePlace, KnownSection>,
    pub(super) panels: Vec<(usize, (f64, PlanPoint))>,
}

/// Reads columns and beams, and the sections of those that have bars. `plans`: those of the floors in the axes of the grid; what lies
/// outside of them does not exist. `loads`: compressions of columns by name, as far as they are known \[N\].
pub(super) fn read(
    reader: &mut Reader<'_>,
    view: &View<'_>,
    grid: Grid,
    plans: &[Vec<PlanPoint>],
    storey_heights: &[f64],
    loads: &BTreeMap<String, f64>,
) -> ReadFrame {
    let (modulus, modulus_is_bad) = read_modulus(reader, view);
    let (column_factor, beam_factor) = stiffness_factors(reader, view);
    let shears = flexible_members(reader, view, "shear", Section::ShearDeformation, false);
    let torsion = reader
        .get(view, "torsion_factor")
        .and_then(|field| reader.positive(&field, Dimension::Dimensionless));
    let poisson_ratio = read_poisson_ratio(reader, view);
    let density = read_density(reader, view, CONCRETE_DENSITY);
    let stretches = reader
        .get(view, "axial")
        .is_none_or(|field| reader.choice(&field, AXIAL, &[]) != Some("rigid"));
    let hinges = SpaceHinges::read(reader, view, plans.len());
    let mut members = Vec::new();
    let mut own_moments = Vec::new();
    let (mut sections, mut slabs) = (BTreeMap::new(), BTreeMap::new());
    let mut walls = Vec::new();
    for sort in Sort::ALL {
        let is_column = sort == Sort::Column;
        let material = Material {
            modulus,
            modulus_is_stated: view.has("elastic_modulus"),
            modulus_is_bad,
            density,
            poisson_ratio,
            factors: [
                if is_column {
                    column_factor
                } else {
                    beam_factor
                },
                torsion.unwrap_or(1.0),
            ],
            shears: if is_column { shears.0 } else { shears.1 },
        };
        let mut sort = read_sort(reader, view, sort, &grid, plans, material, hinges.as_ref());
        if is_column {
            let around = space_walls::Around {
                grid: &grid,
                plans,
                heights: storey_heights,
                material,
                hinges: hinges.as_ref(),
            };
            walls = space_walls::read_all(reader, view, around, &mut sort);
        }
        for (place, member) in sort {
            let mut section = member.section;
            if is_column && !stretches {
                section.axial_rigidity = None;
            }
            members.push(SpaceMember::elastic(place, section));
            own_moments.push(member.moments);
            slabs.extend(member.slab.map(|slab| (place, slab)));
            sections.extend(member.known.map(|section| (place, section)));
        }
    }
    let [lines_x, lines_y] = grid.lines.clone();
    let floor_load = reader
        .get(view, "floor_load")
        .and_then(|field| per_storey(reader, &field, Dimension::Force, Some(plans.len())));
    let mut frame = SpaceFrame {
        direction: grid.direction,
        lines_x,
        lines_y,
        members,
        floor_load: floor_load.unwrap_or_default(),
        ..SpaceFrame::default()
    };
    add_slabs(&slabs, &mut frame);
    frame.rigid_zones = rigid_ends::read_in_space(reader, view, &frame);
    space_walls::add_to(walls, &mut frame);
    let panels = add_diagonals(reader, view, &grid, plans, storey_heights, &mut frame);
    if let Some(hinges) = hinges {
        let strengths = Strengths {
            sections: &sections,
            loads,
        };
        add_hinges(
            reader,
            view,
            &hinges,
            (&own_moments, strengths),
            &mut frame,
            storey_heights,
        );
        add_fibres(reader, view, &hinges, &sections, &mut frame, storey_heights);
    }
    joint::read_in_space(reader, view, &mut frame);
    ReadFrame {
        frame,
        sections,
        panels,
    }
}

/// Lets slabs bend with beams: a beam that none continues on its line is an end span.
fn add_slabs(slabs: &BTreeMap<SpacePlace, OnSlab>, frame: &mut SpaceFrame) {
    let beams = frame.members.iter().map(|member| member.place);
    let ends: BTreeSet<SpacePlace> = beams.collect();
    let neighbours = |place: SpacePlace| match place {
        SpacePlace::Column { .. } => [None; 2],
        SpacePlace::BeamX { span, line, floor } => {
            let beside = |span| SpacePlace::BeamX { span, line, floor };
            [span.checked_sub(1).map(beside), Some(beside(span + 1))]
        }
        SpacePlace::BeamY { line, span, floor } => {
            let beside = |span| SpacePlace::BeamY { line, span, floor };
            [span.checked_sub(1).map(beside), Some(beside(span + 1))]
        }
    };
    for index in 0..frame.members.len() {
        let place = frame.members[index].place;
        let Some(slab) = slabs.get(&place) else {
            continue;
        };
        let goes_on = neighbours(place).into_iter().flatten();
        let goes_on = goes_on.filter(|beside| ends.contains(beside)).count();
        let span = Span {
            length: frame.length(place, &[]),
            outer_ends: 2 - goes_on,
        };
        let section = &mut frame.members[index].section;
        let tee = slab.with(
            CrossSection {
                flexural_rigidity: section.flexural_rigidity[0],
                axial_rigidity: section.axial_rigidity,
                shear_rigidity: None,
                line_mass: 0.0,
            },
            span,
        );
        section.flexural_rigidity[0] = tee.flexural_rigidity;
        section.axial_rigidity = tee.axial_rigidity;
    }
}

/// Adds braces and struts of infill panels; returns the masses of panels on floors. Half a panel hangs on the floor above, half stands on
/// the one below, in equal parts at both joints; what stands on the ground does not move with the building.
fn add_diagonals(
    reader: &mut Reader<'_>,
    view: &View<'_>,
    grid: &Grid,
    plans: &[Vec<PlanPoint>],
    storey_heights: &[f64],
    frame: &mut SpaceFrame,
) -> Vec<(usize, (f64, PlanPoint))> {
    let widths = PlanAxis::BOTH.map(|along| frame.bays(along));
    let column_rigidity = |place: DiagonalPlace| {
        let axis = place.line.map_or(0, |line| line.along.index());
        let crossings = place.crossings().unwrap_or_default();
        crossings.map(|line| {
            let storey = place.storey - 1;
            let column = SpacePlace::Column { line, storey };
            let mut members = frame.members.iter();
            let member = members.find(|member| member.place == column)?;
            Some(member.section.flexural_rigidity[axis])
        })
    };
    let has_joints = |place: DiagonalPlace| {
        let Some((line, [lower, upper])) = place.line.zip(place.crossings()) else {
            return false;
        };
        let beam = match line.along {
            PlanAxis::X => Sort::BeamX,
            PlanAxis::Y => Sort::BeamY,
        };
        let floor = place.storey - 1;
        let bay = beam.place(line.crossing(place.bay - 1), floor);
        lies_in(bay, grid, &plans[floor])
            && frame.has_joint(floor, lower)
            && frame.has_joint(floor + 1, upper)
    };
    let bays = Bays {
        heights: storey_heights,
        widths: Widths::OfGrid(&widths),
        column_rigidity: &column_rigidity,
        has_joint: &|(floor, crossing)| frame.has_joint(floor, crossing),
        has_joints: &has_joints,
    };
    let mut diagonals = brace::read_all(reader, view, bays);
    let (struts, panels) = infill::read_all(reader, view, bays);
    diagonals.extend(struts);
    frame.diagonals = diagonals;
    let mut masses = Vec::new();
    for (place, mass) in panels {
        let floors = place.floors().into_iter();
        for floor in floors.filter_map(|floor| floor.checked_sub(1)) {
            let ends = place.crossings().into_iter().flatten();
            masses.extend(ends.map(|crossing| (floor, (0.25 * mass, frame.point(crossing)))));
        }
    }
    masses
}

/// Gives columns the fibres or the surfaces of their sections.
fn add_fibres(
    reader: &mut Reader<'_>,
    view: &View<'_>,
    hinges: &SpaceHinges<'_>,
    sections: &BTreeMap<SpacePlace, KnownSection>,
    frame: &mut SpaceFrame,
    storey_heights: &[f64],
) {
    let Some(field) = reader.get(view, "hinges") else {
        return;
    };
    let places = frame.members.iter().map(|member| member.place);
    let is_wall = |place: &SpacePlace| frame.walls.iter().any(|wall| wall.has(*place));
    let columns = places.filter(|place| matches!(place, SpacePlace::Column { .. }));
    let columns: Vec<SpacePlace> = columns.filter(|place| !is_wall(place)).collect();
    if let Some(asked) = &hinges.surfaces {
        for place in columns {
            let members = frame.members.iter();
            let member = { members }.find(|member| member.place == place);
            let Some(member) = member.filter(|_| asked.stand_in(place.storey())) else {
                continue;
            };
            let height = frame.clear_length(place, storey_heights);
            let section = sections.get(&place).and_then(KnownSection::with_bars);
            match asked.of_column(&member.section, section, height) {
                Ok(column) => {
                    frame.fibres.insert(place, column);
                }
                Err([problem, remedy]) => {
                    *reader.bad(&field, format!("{place}: {problem}")) = Some(remedy);
                    return;
                }
            }
        }
        return;
    }
    let Some(asked) = &hinges.fibres else {
        return;
    };
    let laid = |place: &SpacePlace| sections.get(place).and_then(KnownSection::with_bars);
    if columns.iter().any(|place| laid(place).is_none()) {
        let none = columns.iter().all(|place| laid(place).is_none());
        fibre_hinges::say_without_bars(reader, &field, none);
        return;
    }
    for place in columns
        .into_iter()
        .filter(|column| asked.stand_in(column.storey()))
    {
        let Some(section) = laid(&place) else {
            continue;
        };
        let height = frame.clear_length(place, storey_heights);
        match asked.of_column(section, height, true) {
            Ok(column) => {
                frame.fibres.insert(place, column);
            }
            Err(problem) => {
                reader.bad(&field, format!("{place}: {problem}"));
                return;
            }
        }
    }
}

/// Gives members the hinges of their moments: their own, or those of all columns or beams of their storey.
fn add_hinges(
    reader: &mut Reader<'_>,
    view: &View<'_>,
    hinges: &SpaceHinges<'_>,
    (own_moments, strengths): (&[Option<Moments<'_>>], Strengths<'_>),
    frame: &mut SpaceFrame,
    storey_heights: &[f64],
) {
    let none_of_its_own = own_moments.iter().all(Option::is_none);
    if hinges.is_empty()
        && !hinges.follows_axial_force()
        && none_of_its_own
        && let Some(field) = reader.get(view, "hinges")
    {
        *reader.bad(&field, "has no moments") = Some("add column or beam = { yield = \"400 kN.m\", post_yield = 0.02 }, or hinge to some columns or beams".into());
        return;
    }
    for (index, own_moment) in own_moments.iter().enumerate() {
        let member = frame.members[index];
        let place = member.place;
        let is_column = matches!(place, SpacePlace::Column { .. });
        let usual = || hinges.usual(is_column, place.storey());
        let Some(moments) = own_moment.as_ref().or_else(usual) else {
            continue;
        };
        let length = frame.clear_length(place, storey_heights);
        // A fault of one is that of all alike.
        let steel = strengths.steel(place);
        match hinges.springs(reader, moments, &member, length, steel) {
            Ok(springs) => frame.members[index].hinges = springs,
            Err(()) => return,
        }
    }
}

/// Sections of members of known strength, and the compressions of columns by name \[N\].
struct Strengths<'a> {
    sections: &'a BTreeMap<SpacePlace, KnownSection>,
    loads: &'a BTreeMap<String, f64>,
}

impl Strengths<'_> {
    /// The profile of a member, and its compression \[N\].
    fn steel(&self, place: SpacePlace) -> Option<(&SteelMember, f64)> {
        let KnownSection::Profile(steel) = self.sections.get(&place)? else {
            return None;
        };
        let load = match place {
            SpacePlace::Column { .. } => self.loads.get(&place.to_string()),
            SpacePlace::BeamX { .. } | SpacePlace::BeamY { .. } => None,
        };
        Some((steel, load.copied().unwrap_or(0.0)))
    }
}

/// Section and hinges of a member.
#[derive(Clone)]
pub(super) struct Member<'n> {
    pub(super) section: SpaceSection,
    /// Slab that bends with a beam.
    pub(super) slab: Option<OnSlab>,
    /// Its section, if its strength is known.
    pub(super) known: Option<KnownSection>,
    /// Moments of its own.
    pub(super) moments: Option<Moments<'n>>,
}

/// Members of one sort: a table for all places, or a list of tables, each for the places that it names.
fn read_sort<'n>(
    reader: &mut Reader<'_>,
    view: &View<'n>,
    sort: Sort,
    grid: &Grid,
    plans: &[Vec<PlanPoint>],
    material: Material,
    hinges: Option<&SpaceHinges<'n>>,
) -> BTreeMap<SpacePlace, Member<'n>> {
    let mut found = BTreeMap::new();
    let [nx, ny] = grid.lines.each_ref().map(Vec::len);
    // Crossings at which a member begins.
    let counts = match sort {
        Sort::Column => [nx, ny],
        Sort::BeamX => [nx - 1, ny],
        Sort::BeamY => [nx, ny - 1],
    };
    let Some(field) = reader.get(view, sort.key()) else {
        if counts[0] * counts[1] > 0 {
            let example = match sort {
                Sort::Column => "size = [\"500 mm\", \"500 mm\"]",
                _ => "width = \"300 mm\", depth = \"600 mm\"",
            };
            reader.missing(
                view,
                sort.key(),
                format!("add {} = {{ {example} }}", sort.key()),
            );
        }
        return found;
    };
    let entries = field.entries().unwrap_or_else(|| vec![field.clone()]);
    for entry in &entries {
        let sections: &'static [Section] = match sort {
            Sort::Column => &[Section::SpaceColumn],
            _ => &[Section::SpaceBeam],
        };
        let Some(entry_view) = reader.open(entry, sections) else {
            continue;
        };
        let omit = read_omit(reader, &entry_view);
        let moments = read_hinge(reader, view, &entry_view, sort, hinges);
        let member = if omit {
            None
        } else {
            let section = read_section(reader, &entry_view, sort, material);
            let known = match steel_profile::strength_of(reader, &entry_view) {
                Some(steel) => Some(KnownSection::Profile(steel)),
                None => read_bars(reader, view, &entry_view, sort).map(KnownSection::Bars),
            };
            match section {
                Some((section, slab)) => Some(Member {
                    section,
                    slab,
                    known,
                    moments,
                }),
                None => continue,
            }
        };
        let most = [("x", counts[0]), ("y", counts[1]), ("storeys", plans.len())];
        let ranges = most.map(|(key, most)| range(reader, &entry_view, key, most));
        let [Some(x), Some(y), Some(storeys)] = ranges else {
            continue;
        };
        let mut matched = false;
        for storey in storeys[0] - 1..storeys[1] {
            for y in y[0] - 1..y[1] {
                for x in x[0] - 1..x[1] {
                    let place = sort.place([x, y], storey);
                    if !lies_in(place, grid, &plans[storey]) {
                        continue;
                    }
                    matched = true;
                    match &member {
                        Some(member) => found.insert(place, member.clone()),
                        None => found.remove(&place),
                    };
                }
            }
        }
        if !matched && counts[0] * counts[1] > 0 {
            *reader.bad(entry, "names no place within the plan") =
                Some("check x, y and storeys, or plan".into());
        }
    }
    found
}

/// The section of a member with bars; the depth of a column is along x, its width across.
fn read_bars(
    reader: &mut Reader<'_>,
    building: &View<'_>,
    view: &View<'_>,
    sort: Sort,
) -> Option<reinforced::ReadSection> {
    // Faults are noted where the modulus is read.
    let concrete = reader
        .get(building, "concrete")
        .and_then(|field| reader.quietly(|reader| reader.concrete_name(&field, SECTION_CONCRETES)));
    let size = |reader: &mut Reader<'_>| {
        let size = reader.quietly(|reader| read_size(reader, view, sort));
        let [first, second] = [0, 1].map(|side| size.map(|size| size[side]));
        match sort {
            Sort::Column => [second, first],
            Sort::BeamX | Sort::BeamY => [first, second],
        }
    };
    reinforced::read_section(reader, view, size, concrete)
}

/// Moments of the hinges of some members.
pub(super) fn read_hinge<'n>(
    reader: &mut Reader<'_>,
    building: &View<'_>,
    view: &View<'n>,
    sort: Sort,
    hinges: Option<&SpaceHinges<'n>>,
) -> Option<Moments<'n>> {
    let field = reader.get(view, "hinge")?;
    match hinges {
        Some(hinges) => hinges.of_entry(reader, view, &field, sort == Sort::Column),
        None => {
            if !building.has("hinges") {
                *reader.bad(&field, "needs a rule") =
                    Some("add hinges = { rule = \"bilinear\" } to the building".into());
            }
            None
        }
    }
}

/// Whether both ends of a member, and its middle, lie in a plan.
pub(super) fn lies_in(place: SpacePlace, grid: &Grid, plan: &[PlanPoint]) -> bool {
    let at = |[x, y]: [usize; 2]| [grid.lines[0][x], grid.lines[1][y]];
    let [a, b] = place.crossings().map(at);
    let middle = [0.5 * (a[0] + b[0]), 0.5 * (a[1] + b[1])];
    [a, middle, b].iter().all(|point| contains(plan, *point))
}

/// Whether a point lies in a polygon, or on its edge.
fn contains(plan: &[PlanPoint], [x, y]: PlanPoint) -> bool {
    let next = plan.iter().cycle().skip(1);
    let mut inside = false;
    for (a, b) in plan.iter().zip(next) {
        let along = [b[0] - a[0], b[1] - a[1]];
        let length = libm::hypot(along[0], along[1]);
        let from = [x - a[0], y - a[1]];
        let share = (from[0] * along[0] + from[1] * along[1]) / (length * length);
        let share = share.clamp(0.0, 1.0);
        let away = libm::hypot(from[0] - share * along[0], from[1] - share * along[1]);
        if away <= BESIDE {
            return true;
        }
        if (a[1] > y) != (b[1] > y) {
            let crossing = a[0] + (y - a[1]) / (b[1] - a[1]) * along[0];
            inside ^= x < crossing;
        }
    }
    inside
}

/// The section of a member, and the slab of a beam.
fn read_section(
    reader: &mut Reader<'_>,
    view: &View<'_>,
    sort: Sort,
    material: Material,
) -> Option<(SpaceSection, Option<OnSlab>)> {
    if let Some(field) = reader.get(view, "profile") {
        return read_profile(reader, view, &field, sort, material).map(|profile| (profile, None));
    }
    if let Some(field) = reader.get(view, "axis") {
        *reader.bad(&field, "is for a profile") = Some("leave it out, or add profile".into());
        return None;
    }
    let size = read_size(reader, view, sort);
    let (stated_modulus, own_is_bad) = match view.has("bars") {
        true => read_modulus_beside_bars(reader, view),
        false => read_modulus(reader, view),
    };
    let Some(modulus) = stated_modulus.or(material.modulus) else {
        if !material.modulus_is_bad && !own_is_bad {
            let place = view.span.clone();
            *reader.fault(&place, view.path.clone(), "needs a modulus of elasticity") = Some(
                "add elastic_modulus = \"30 GPa\" or concrete = \"C30\" to the building".into(),
            );
        }
        return None;
    };
    let (nu, shears) = (material.poisson_ratio, material.shears);
    let mut section = match sort {
        Sort::Column => SpaceSection::rectangle(size?, modulus, nu, shears),
        _ => SpaceSection::beam(size?, modulus, nu, shears),
    }?;
    let [bending, torsion] = material.factors;
    section.flexural_rigidity = section
        .flexural_rigidity
        .map(|flexural_rigidity| bending * flexural_rigidity);
    section.torsional_rigidity *= torsion;
    if sort == Sort::Column {
        section.line_mass = material.density * section.size[0] * section.size[1];
    }
    // Columns have no such key.
    let slab = (sort != Sort::Column && view.has("slab")).then(|| reader.get(view, "slab"));
    let slab = match slab.flatten() {
        Some(field) => {
            let of_beam = section::Material {
                modulus: Some(modulus),
                modulus_is_stated: true,
                modulus_is_bad: false,
                density: 0.0,
                factor: bending,
                shears,
                poisson_ratio: nu,
            };
            Some(slab::read(reader, view, &field, of_beam)?)
        }
        None => None,
    };
    Some((section, slab))
}

/// A steel profile, which does not crack, whatever concrete does.
fn read_profile(
    reader: &mut Reader<'_>,
    view: &View<'_>,
    field: &Field<'_>,
    sort: Sort,
    material: Material,
) -> Option<SpaceSection> {
    let is_column = sort == Sort::Column;
    let beside: &[&'static str] = match is_column {
        true => &["size", "concrete", "bars"],
        false => &["width", "depth", "concrete", "bars", "slab"],
    };
    if let Some(key) = beside.iter().find(|key| view.has(key)) {
        *reader.bad(field, format!("is given together with {key}")) =
            Some(format!("keep either profile or {key}"));
        return None;
    }
    let stated = reader.get(view, "elastic_modulus");
    let modulus = match stated {
        Some(field) => Some(reader.positive(&field, Dimension::Modulus)?),
        None => material.modulus.filter(|_| material.modulus_is_stated),
    };
    steel_profile::read_in_space(reader, view, field, modulus, material.shears, is_column)
}

/// Sizes along x and across of a column, width and depth of a beam.
fn read_size(reader: &mut Reader<'_>, view: &View<'_>, sort: Sort) -> Option<PlanPoint> {
    if sort == Sort::Column {
        match reader.get(view, "size") {
            Some(field) => pair(reader, &field).and_then(|size| {
                if size.iter().all(|side| *side > 0.0) {
                    return Some(size);
                }
                reader.bad(&field, "must be greater than 0 m");
                None
            }),
            None => {
                reader.missing(
                    view,
                    "size",
                    "add the sizes along x and across: size = [\"500 mm\", \"500 mm\"]; or profile, or omit = true",
                );
                None
            }
        }
    } else {
        let [width, depth] = [("width", "300 mm"), ("depth", "600 mm")].map(|(key, example)| {
            match reader.get(view, key) {
                Some(field) => reader.positive(&field, Dimension::Length),
                None => {
                    reader.missing(
                        view,
                        key,
                        format!("add {key} = \"{example}\"; or omit = true"),
                    );
                    None
                }
            }
        });
        width.zip(depth).map(|(width, depth)| [width, depth])
    }
}
