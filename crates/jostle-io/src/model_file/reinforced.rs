//! Columns and beams whose strength is known: their bars, or the yield strength of their profile.

use std::collections::BTreeMap;

use jostle::statics::compressions_of_members;
use jostle::{Building, Frame, PlanAxis, SpaceFrame, SpaceMember, SpacePlace, Structure};
use jostle_section::capacity::{ShearRule, SteelMember};
use jostle_section::formula::Member;
use jostle_section::{
    Axis, BarsError, Concrete, Reinforcement, Section, SectionFault, Steel, StrengthLevel, Ties,
};

use super::places::{Layout, sections};
use super::{section, steel_profile};
use crate::grade::ConcreteGrade;
use crate::keys::{self, SECTION_CONCRETES, STEELS, STRENGTHS};
use crate::quantity::Dimension;
use crate::reader::{Field, Grade, Reader, View};
use crate::tree::Value;

/// Concrete over the bars where nothing is said \[m\].
const DEFAULT_COVER: f64 = 0.035;

/// A reinforced member of a frame.
#[derive(Clone, Debug, PartialEq)]
pub struct ReinforcedMember {
    /// Index of the building.
    pub building: usize,
    /// Column or beam.
    pub member: Member,
    /// Storey of a column, floor of a beam, counted from 1.
    pub floor: usize,
    /// Column line or bay, counted from 1 at the left; in a space frame the number of the crossing at which it begins, line by line
    /// of `lines_y`.
    pub place: usize,
    /// Its name within the building, such as `column.1.2`, with that of its frame before where frames stand in a plan.
    pub name: String,
    /// The section.
    pub section: Section,
    /// Axial compression \[N\].
    pub compression: f64,
    /// Length between the axes \[m\].
    pub length: f64,
    /// E I as the frame has it, cracking factor included \[N·m²\].
    pub rigidity: f64,
    /// Length between the faces of adjacent members whose depth is known, otherwise between the axes \[m\].
    pub clear_length: f64,
    /// The same in the plane across, of a column of a space frame; `None` for others.
    pub clear_length_across: Option<f64>,
    /// Level of the strengths of the section.
    pub level: StrengthLevel,
    /// Rule for capacities of the country of its steel, if that has a grade, otherwise of its concrete.
    pub home_rule: Option<ShearRule>,
}

/// A column or beam of a steel profile whose yield strength is known.
#[derive(Clone, Debug, PartialEq)]
pub struct ProfiledMember {
    /// Index of the building.
    pub building: usize,
    /// Column or beam.
    pub member: Member,
    /// Storey and line of a column, floor and bay of a beam, from 1; as those of reinforced members.
    pub place: [usize; 2],
    /// Its name within the building, such as `column.1.2`.
    pub name: String,
    /// Its profile and steel.
    pub steel: SteelMember,
    /// Axial compression \[N\].
    pub compression: f64,
    /// Length between the axes \[m\].
    pub length: f64,
    /// E I as the frame has it \[N·m²\].
    pub rigidity: f64,
    /// Whether it bends in two planes.
    pub bends_across: bool,
}

impl ProfiledMember {
    /// Moment at which its ends yield \[N·m\].
    ///
    /// # Errors
    /// In words.
    pub(super) fn yield_moment(&self) -> Result<f64, String> {
        yield_moment(&self.steel, self.steel.axis, self.compression)
    }
}

/// Moment of a hinge of steel about an axis, under an axial compression \[N·m, N\].
///
/// # Errors
/// In words.
pub(super) fn yield_moment(
    steel: &SteelMember,
    axis: Axis,
    compression: f64,
) -> Result<f64, String> {
    steel.hinge_moment(axis, compression).ok_or_else(|| {
        let [load, most] = [compression, steel.yield_strength * steel.profile.area()];
        format!(
            "the axial load of {:.0} kN exceeds the {:.0} kN at which the whole profile yields; take a larger one",
            1e-3 * load,
            1e-3 * most
        )
    })
}

/// Members of known strength.
#[derive(Clone, Debug, Default)]
pub struct KnownMembers {
    /// Those with bars.
    pub reinforced: Vec<ReinforcedMember>,
    /// Those of steel profiles.
    pub profiled: Vec<ProfiledMember>,
}

impl KnownMembers {
    /// Adds those of another building.
    pub(super) fn append(&mut self, mut others: Self) {
        self.reinforced.append(&mut others.reinforced);
        self.profiled.append(&mut others.profiled);
    }
}

/// Sections of the columns and beams of a building, where their strength is known.
#[derive(Clone, Debug, Default)]
pub(super) struct Reinforced {
    /// By storey and line; `None` where the strength is unknown.
    pub(super) columns: Vec<Vec<Option<Laid>>>,
    /// By floor and bay.
    pub(super) beams: Vec<Vec<Option<Laid>>>,
    /// Depths of columns and walls by storey and line, then of beams by floor and bay; 0 where there is none or it is unknown \[m\].
    depths: [Vec<Vec<f64>>; 2],
}

/// By storey or floor and by line or bay.
type Grid<T> = Vec<Vec<Option<T>>>;

/// A section in a place of a frame.
#[derive(Clone, Debug)]
pub(super) struct Laid {
    known: KnownSection,
    axial: Axial,
}

/// A section of known strength.
#[derive(Clone, Debug)]
pub(super) enum KnownSection {
    Bars(ReadSection),
    Profile(SteelMember),
}

impl KnownSection {
    /// With its bars, if it has bars.
    pub(super) fn with_bars(&self) -> Option<&Section> {
        match self {
            Self::Bars(read) => Some(&read.section),
            Self::Profile(_) => None,
        }
    }
}

/// Sections of the columns and beams of a building with a plan, where they are reinforced.
#[derive(Clone, Debug, Default)]
pub(super) struct ReinforcedInPlan {
    /// Of every frame at lines of the plan.
    pub(super) frames: Vec<Reinforced>,
    /// Of a space frame.
    pub(super) members: BTreeMap<SpacePlace, KnownSection>,
}

/// Axial compression of a member.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Axial {
    FromGravity,
    /// \[N\]
    Given(f64),
}

/// The concrete of a building, whose faults are noted where the modulus is read.
pub(super) fn of_building(reader: &mut Reader<'_>, view: &View<'_>) -> Option<ConcreteGrade> {
    let field = reader.get(view, "concrete")?;
    reader.quietly(|reader| reader.concrete_name(&field, SECTION_CONCRETES))
}

/// Reads the reinforcement of all members of a frame; faults are noted.
pub(super) fn read(reader: &mut Reader<'_>, view: &View<'_>, frame: &Frame) -> Reinforced {
    let concrete = of_building(reader, view);
    let storeys = frame.storey_heights.len();
    let mut of = |member: Member| -> (Grid<Laid>, Grid<f64>) {
        let across = match member {
            Member::Column => frame.lines(),
            Member::Beam => frame.spans.len(),
        };
        let layout =
            reader.quietly(|reader| Layout::read(reader, view, member, Some(storeys), across));
        let Some(layout) = layout else {
            return (Vec::new(), Vec::new());
        };
        let tables = layout.tables.iter();
        let read: Vec<(Option<Laid>, Option<f64>)> = tables
            .map(|table| match table.omits {
                true => (None, None),
                false => (
                    read_one(reader, &table.field, member, concrete),
                    depth_in(reader, &table.field, member),
                ),
            })
            .collect();
        let rows = layout.holds.iter().enumerate().map(|(storey, row)| {
            let places = row.iter().enumerate().map(|(place, table)| {
                let exists = match member {
                    Member::Column => frame.bare_column(storey, place),
                    Member::Beam => frame.bare_beam(storey, place),
                };
                let here = table.filter(|_| exists.is_some());
                here.map_or((None, None), |table| read[table].clone())
            });
            places.unzip::<_, _, Vec<_>, Vec<_>>()
        });
        rows.unzip()
    };
    let (columns, depths_of_columns) = of(Member::Column);
    let (beams, depths_of_beams) = of(Member::Beam);
    let walls = |storey: usize, line: usize| frame.wall([storey, line]).map(|wall| wall.length);
    let depths = (0..storeys).map(|storey| {
        let column = |line: usize| *depths_of_columns.get(storey)?.get(line)?;
        let lines = 0..frame.lines();
        let depths = lines.map(|line| walls(storey, line).or(column(line)).unwrap_or(0.0));
        depths.collect()
    });
    let of_beams = depths_of_beams.into_iter();
    let of_beams = of_beams.map(|row| row.into_iter().map(Option::unwrap_or_default).collect());
    Reinforced {
        columns,
        beams,
        depths: [depths.collect(), of_beams.collect()],
    }
}

/// Depth in the table of a column or beam \[m\].
fn depth_in(reader: &mut Reader<'_>, field: &Field<'_>, member: Member) -> Option<f64> {
    let view = reader.reopen(field, sections(member))?;
    section::depth_of(reader, &view)
}

fn read_one(
    reader: &mut Reader<'_>,
    field: &Field<'_>,
    member: Member,
    of_building: Option<ConcreteGrade>,
) -> Option<Laid> {
    // Its keys were checked where the size was read.
    let view = reader.reopen(field, sections(member))?;
    let axial = if member == Member::Column {
        match reader.get(&view, "axial_load") {
            Some(field) if field.as_text() != Some("from gravity") => {
                reader.quantity(&field, Dimension::Force).map(Axial::Given)
            }
            _ => Some(Axial::FromGravity),
        }
    } else {
        Some(Axial::Given(0.0))
    };
    if let Some(steel) = steel_profile::strength_of(reader, &view) {
        return Some(Laid {
            known: KnownSection::Profile(steel),
            axial: axial?,
        });
    }
    let size = |reader: &mut Reader<'_>| {
        if !view.has("width")
            && !view.has("depth")
            && let Some(bars) = reader.get(&view, "bars")
        {
            *reader.bad(&bars, "needs the size of the section") =
                Some("give width and depth instead of EI".into());
        }
        ["width", "depth"].map(|key| {
            let field = reader.get(&view, key)?;
            reader.quietly(|reader| reader.positive(&field, Dimension::Length))
        })
    };
    let read = read_section(reader, &view, size, of_building)?;
    Some(Laid {
        known: KnownSection::Bars(read),
        axial: axial?,
    })
}

/// A section with its bars, and what its strengths are.
#[derive(Clone, Debug)]
pub(super) struct ReadSection {
    pub(super) section: Section,
    level: StrengthLevel,
    home_rule: Option<ShearRule>,
}

/// Concrete and steel of a section, the cover of its bars, and its ties.
pub(super) type Materials = (Concrete, Steel, f64, Option<Ties>);

/// Reads bars and materials of a table; `None` without bars, or after faults. `size`: width and depth, whose faults are noted elsewhere.
pub(super) fn read_section(
    reader: &mut Reader<'_>,
    view: &View<'_>,
    size: impl FnOnce(&mut Reader<'_>) -> [Option<f64>; 2],
    of_building: Option<ConcreteGrade>,
) -> Option<ReadSection> {
    let lay = |bars: Reinforcement, [width, depth]: [f64; 2], materials: Materials| {
        let (concrete, steel, cover, ties) = materials;
        Section::new(width, depth, concrete, steel, &bars, cover, ties)
    };
    let (section, level, home_rule) = read_laid(reader, view, size, of_building, read_bars, lay)?;
    Some(ReadSection {
        section,
        level,
        home_rule,
    })
}

/// The same of a section that is laid in another way.
pub(super) fn read_laid<B, S>(
    reader: &mut Reader<'_>,
    view: &View<'_>,
    size: impl FnOnce(&mut Reader<'_>) -> [Option<f64>; 2],
    of_building: Option<ConcreteGrade>,
    read_bars: impl FnOnce(&mut Reader<'_>, &Field<'_>) -> Option<B>,
    lay: impl FnOnce(B, [f64; 2], Materials) -> Result<S, Vec<SectionFault>>,
) -> Option<(S, StrengthLevel, Option<ShearRule>)> {
    let level = match reader.get(view, "strength") {
        Some(field) => StrengthLevel::named(reader.choice(&field, STRENGTHS, &[])?)?,
        None => StrengthLevel::default(),
    };
    let grade = reader
        .get(view, "concrete")
        .map(|field| reader.concrete(&field, SECTION_CONCRETES));
    // Steel that is a strength says no country, but its concrete may.
    let named = grade.flatten().or(of_building);
    let mut home_rule = named.and_then(ConcreteGrade::home_rule);
    let grade = grade.map(|grade| grade?.at(level));
    let steel = reader.get(view, "steel").map(|field| {
        let grade = reader.grade(&field, STEELS, "\"400 MPa\"")?;
        match grade {
            Grade::Named(name) => {
                home_rule = ShearRule::of_steel(name).or(home_rule);
                Steel::grade(name, level)
            }
            Grade::Strength(strength) => Some(Steel::of_strength(strength)),
        }
    });
    let cover = reader
        .get(view, "cover")
        .map_or(Some(DEFAULT_COVER), |field| {
            reader.quantity(&field, Dimension::Length)
        });
    let ties = reader.get(view, "ties").map(|field| {
        let text = reader.text(&field)?;
        understood(reader, &field, Ties::parse(&text))
    });
    let Some(bars_field) = reader.get(view, "bars") else {
        // Without bars nothing would use them.
        for key in ["steel", "ties", "cover"] {
            if let Some(field) = reader.get(view, key) {
                *reader.bad(&field, "needs bars") =
                    Some("add bars = \"12 d20\", or leave it out".into());
            }
        }
        return None;
    };
    let bars = read_bars(reader, &bars_field);
    let [width, depth] = size(reader);
    let concrete = match grade {
        Some(concrete) => concrete,
        None => {
            let concrete = of_building.and_then(|grade| grade.at(level));
            // A grade of the building that is not understood has its own fault.
            let building = view.path.split('.').next().unwrap_or_default();
            if concrete.is_none() && !reader.is_faulty(&format!("{building}.concrete")) {
                reader.missing(view, "concrete", "add concrete = \"C30\" (C20 to C60, \"C30/37\", \"f'c = 4 ksi\", or a strength such as \"30 MPa\") beside the bars");
            }
            concrete
        }
    };
    if steel.is_none() {
        reader.missing(
            view,
            "steel",
            "add steel = \"HRB400\" (or \"B500\", \"Grade 60\", or a yield strength such as \"400 MPa\") beside the bars",
        );
    }
    let ties = match ties {
        Some(ties) => Some(ties?),
        None => None,
    };
    let laid = lay(bars?, [width?, depth?], (concrete?, steel??, cover?, ties));
    match laid {
        Ok(section) => Some((section, level, home_rule)),
        Err(faults) => {
            for fault in faults {
                let field = view.has(fault.field).then(|| reader.get(view, fault.field));
                let field = field.flatten();
                reader.bad(field.as_ref().unwrap_or(&bars_field), fault.problem);
            }
            None
        }
    }
}

pub(super) fn read_bars(reader: &mut Reader<'_>, field: &Field<'_>) -> Option<Reinforcement> {
    if !matches!(field.node.value, Value::Table(_)) {
        let text = reader.text(field)?;
        return understood(reader, field, Reinforcement::parse(&text));
    }
    let view = reader.open(field, &[keys::Section::Bars])?;
    let mut row = |key: &'static str| {
        let found = reader.get(&view, key).map(|field| reader.text(&field));
        if found.is_none() && key != "sides" {
            reader.missing(&view, key, format!("add {key} = \"4 d25\""));
        }
        found
    };
    let (top, bottom, sides) = (row("top"), row("bottom"), row("sides"));
    let sides = match sides {
        Some(text) => Some(text?),
        None => None,
    };
    let laid = Reinforcement::rows(&top??, &bottom??, sides.as_deref());
    understood(reader, field, laid)
}

pub(super) fn understood<T>(
    reader: &mut Reader<'_>,
    field: &Field<'_>,
    parsed: Result<T, BarsError>,
) -> Option<T> {
    parsed
        .map_err(|error| {
            reader.bad(field, error.to_string());
        })
        .ok()
}

/// Every member of known strength of a sound frame, with its axial load.
///
/// # Errors
/// A text when columns take their load from gravity and the building cannot stand.
pub(super) fn members(
    index: usize,
    building: &Building,
    reinforced: &Reinforced,
) -> Result<KnownMembers, String> {
    let Structure::Frame(frame) = &building.structure else {
        return Ok(KnownMembers::default());
    };
    let carried = carried(building, reinforced.asks_gravity())?;
    Ok(of_frame(index, "", frame, reinforced, &carried))
}

/// Compression of the members of a building by name, empty where it is not asked for \[N\].
///
/// # Errors
/// A text when the building cannot stand.
fn carried(building: &Building, is_asked: bool) -> Result<BTreeMap<String, f64>, String> {
    if !is_asked {
        return Ok(BTreeMap::new());
    }
    let carried = compressions_of_members(building).map_err(|_| DOES_NOT_STAND.to_owned())?;
    Ok(carried.into_iter().collect())
}

/// Those of a frame in a plan. `loads`: compressions of columns by name, zero where there is none \[N\].
pub(super) fn loaded(
    frame: &Frame,
    reinforced: &Reinforced,
    name: &str,
    loads: &BTreeMap<String, f64>,
) -> KnownMembers {
    of_frame(0, &format!("{name}."), frame, reinforced, loads)
}

/// The same of a sound building with a plan: of its frames at lines of the plan, and of its space frame.
///
/// # Errors
/// As those of [`members`].
pub(super) fn members_in_plan(
    index: usize,
    building: &Building,
    reinforced: &ReinforcedInPlan,
) -> Result<KnownMembers, String> {
    let Structure::Tiers(tiers) = &building.structure else {
        return Ok(KnownMembers::default());
    };
    let frames = reinforced.frames.iter();
    let asks_gravity = frames.clone().any(Reinforced::asks_gravity);
    let carried = carried(building, asks_gravity || !reinforced.members.is_empty())?;
    let mut members = KnownMembers::default();
    for (frame, reinforcement) in tiers.frames.iter().zip(frames) {
        let name = format!("{}.", frame.name);
        members.append(of_frame(
            index,
            &name,
            &frame.frame,
            reinforcement,
            &carried,
        ));
    }
    if let Some(frame) = &tiers.space_frame {
        let places = frame.members.iter();
        let laid = places.filter_map(|place| Some((place, reinforced.members.get(&place.place)?)));
        for (member, known) in laid {
            let name = member.place.to_string();
            let compression = carried.get(&name).copied().unwrap_or(0.0);
            let heights = &tiers.storey_heights;
            match known {
                KnownSection::Bars(read) => {
                    let found = in_space(index, name, frame, (member, read), heights, compression);
                    members.reinforced.push(found);
                }
                KnownSection::Profile(steel) => {
                    let is_column = matches!(member.place, SpacePlace::Column { .. });
                    members.profiled.push(ProfiledMember {
                        building: index,
                        member: match is_column {
                            true => Member::Column,
                            false => Member::Beam,
                        },
                        place: place_of(frame, member.place),
                        name,
                        steel: *steel,
                        compression: if is_column { compression } else { 0.0 },
                        length: frame.length(member.place, heights),
                        rigidity: member.section.flexural_rigidity[0],
                        bends_across: is_column,
                    });
                }
            }
        }
    }
    Ok(members)
}

/// Storey and number of the crossing at which a member of a space frame begins, from 1.
fn place_of(frame: &SpaceFrame, place: SpacePlace) -> [usize; 2] {
    let [[x, y], _] = place.crossings();
    [place.storey() + 1, y * frame.lines_x.len() + x + 1]
}

/// A reinforced member of a space frame that bears a compression \[N\].
fn in_space(
    building: usize,
    name: String,
    frame: &SpaceFrame,
    (member, read): (&SpaceMember, &ReadSection),
    heights: &[f64],
    compression: f64,
) -> ReinforcedMember {
    let (place, storey) = (member.place, member.place.storey());
    let length = frame.length(place, heights);
    let is_column = matches!(place, SpacePlace::Column { .. });
    let meets = |at: usize, crossing: [usize; 2], other: SpacePlace| {
        other.storey() == at && other.crossings().contains(&crossing)
    };
    // The greatest size along an axis of what meets an end of it.
    let met = |floor: Option<usize>, crossing: [usize; 2], axis: PlanAxis| {
        let others = frame
            .members
            .iter()
            .filter(|other| floor.is_some_and(|floor| meets(floor, crossing, other.place)));
        let sizes = others.map(|other| match (is_column, other.place, axis) {
            (true, SpacePlace::BeamX { .. }, PlanAxis::X)
            | (true, SpacePlace::BeamY { .. }, PlanAxis::Y) => other.section.size[1],
            (false, SpacePlace::Column { .. }, _) => other.section.size[axis.index()],
            _ => 0.0,
        });
        sizes.fold(0.0, f64::max)
    };
    let [first, last] = place.crossings();
    let [floor, number] = place_of(frame, place);
    let clear_along = |axis: PlanAxis| {
        let below = match is_column {
            true => storey.checked_sub(1),
            false => Some(storey),
        };
        clear(
            length,
            [met(below, first, axis), met(Some(storey), last, axis)],
        )
    };
    let along = match place {
        SpacePlace::BeamY { .. } => PlanAxis::Y,
        SpacePlace::Column { .. } | SpacePlace::BeamX { .. } => PlanAxis::X,
    };
    ReinforcedMember {
        building,
        member: match is_column {
            true => Member::Column,
            false => Member::Beam,
        },
        floor,
        place: number,
        name,
        section: read.section.clone(),
        compression: if is_column { compression } else { 0.0 },
        length,
        rigidity: member.section.flexural_rigidity[0],
        clear_length: clear_along(along),
        clear_length_across: is_column.then(|| clear_along(PlanAxis::Y)),
        level: read.level,
        home_rule: read.home_rule,
    }
}

impl Reinforced {
    /// Whether a member of a kind is of a profile whose strength is known.
    pub(super) fn has_profile(&self, member: Member) -> bool {
        let list = match member {
            Member::Column => &self.columns,
            Member::Beam => &self.beams,
        };
        let mut laid = list.iter().flatten().flatten();
        laid.any(|laid| matches!(laid.known, KnownSection::Profile(_)))
    }

    /// Whether a column takes its load from gravity.
    pub(super) fn asks_gravity(&self) -> bool {
        let mut laid = self.columns.iter().flatten().flatten();
        laid.any(|laid| laid.axial == Axial::FromGravity)
    }
}

/// The members of known strength of a plane frame. `prefix`: what stands before their names; `carried`: compressions of columns by name, zero
/// where there is none \[N\].
fn of_frame(
    index: usize,
    prefix: &str,
    frame: &Frame,
    reinforced: &Reinforced,
    carried: &BTreeMap<String, f64>,
) -> KnownMembers {
    let [columns, beams] = &reinforced.depths;
    let depth = |depths: &[Vec<f64>], row: Option<usize>, place: Option<usize>| {
        let depth = row.zip(place);
        let depth = depth.and_then(|(row, place)| depths.get(row)?.get(place).copied());
        depth.unwrap_or(0.0)
    };
    let deeper_beam = |floor: Option<usize>, line: usize| {
        let [left, right] = [line.checked_sub(1), Some(line)].map(|bay| depth(beams, floor, bay));
        left.max(right)
    };
    let mut members = KnownMembers::default();
    let all_columns = frame.all_columns().map(|column| (Member::Column, column));
    let all_beams = frame.all_beams().map(|beam| (Member::Beam, beam));
    for (member, ([storey, place], section)) in all_columns.chain(all_beams) {
        let list = match member {
            Member::Column => &reinforced.columns,
            Member::Beam => &reinforced.beams,
        };
        let laid = list.get(storey).and_then(|row| row.get(place)?.as_ref());
        let Some(Laid { known, axial }) = laid else {
            continue;
        };
        let (floor, at) = (storey + 1, place + 1);
        let name = match member {
            Member::Column => format!("{prefix}column.{at}.{floor}"),
            Member::Beam => format!("{prefix}beam.{floor}.{at}"),
        };
        let (length, compression, met) = match member {
            Member::Column => (
                frame.storey_heights[storey],
                match axial {
                    Axial::Given(force) => *force,
                    Axial::FromGravity => carried.get(&name).copied().unwrap_or(0.0),
                },
                [storey.checked_sub(1), Some(storey)].map(|floor| deeper_beam(floor, place)),
            ),
            Member::Beam => (
                frame.spans[place],
                0.0,
                [place, place + 1].map(|line| depth(columns, Some(storey), Some(line))),
            ),
        };
        let read = match known {
            KnownSection::Bars(read) => read,
            KnownSection::Profile(steel) => {
                members.profiled.push(ProfiledMember {
                    building: index,
                    member,
                    place: [floor, at],
                    name,
                    steel: *steel,
                    compression,
                    length,
                    rigidity: section.flexural_rigidity,
                    bends_across: false,
                });
                continue;
            }
        };
        members.reinforced.push(ReinforcedMember {
            building: index,
            member,
            floor,
            place: at,
            name,
            section: read.section.clone(),
            compression,
            length,
            rigidity: section.flexural_rigidity,
            clear_length: clear(length, met),
            clear_length_across: None,
            level: read.level,
            home_rule: read.home_rule,
        });
    }
    members
}

/// Why columns have no load from gravity.
const DOES_NOT_STAND: &str =
    "cannot take its load from gravity: the building does not carry its own weight";

/// Length between the faces of what meets the two ends of a member, whether that has bars or not; never less than a fifth of that between
/// axes. `met`: the greatest depth at either end \[m\].
fn clear(length: f64, met: [f64; 2]) -> f64 {
    let [first, last] = met;
    (length - 0.5 * (first + last)).max(0.2 * length)
}
