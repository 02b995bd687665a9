//! Data of the page's scripts: geometry, impacts and thinned histories as one JSON text.

use jostle::history::{Column, EnergyTerm, History, Kind, Owner};
use jostle::linear::sort_by;
use jostle::model::{Building, Gap, LumpedFloor, Model, Structure};
use jostle::motion::{GroundMotion, Wave};
use jostle::results::summary::{BuildingSummary, ContactSummary, SpringSummary, Summary};
use jostle::structure::SpringPlace;
use jostle::system::Direction;
use serde::Serialize;

use crate::Page;
use crate::damage::strut_stages;
use crate::devices::{self, side_column};
use crate::drawn_members::{DiagonalData, MemberData, SeenAcross, WallData};
use crate::encode::{Packed, Packer, thin_impacts, thin_rows};
use crate::hinges::{self, Place};
use crate::plan_motion::face_indentation;
use crate::thin_loop::thin_loop;
use crate::verdict::place;
use crate::walls::{self, SceneWall};

/// How much of a run goes into a page.
pub(crate) struct Budget {
    /// Numbers of the histories of the run.
    run: usize,
    /// Numbers of the histories of the run without contact.
    without: usize,
    /// Numbers of the contact forces.
    forces: usize,
    /// Numbers of all loops of hinges.
    loops: usize,
    /// Most instants of either run: finer would not be seen.
    rows: usize,
    /// Most points of the ground motion.
    ground: usize,
}

/// A page in one file, below 1 MB.
const FILE: Budget = Budget {
    run: 124_000,
    without: 64_000,
    forces: 50_000,
    loops: 37_000,
    rows: 6000,
    ground: 8000,
};

/// A frame of a page that shows run after run.
const LIVE: Budget = Budget {
    run: 60_000,
    without: 30_000,
    forces: 20_000,
    loops: 20_000,
    rows: 2500,
    ground: 3000,
};

/// Most impacts the player can jump to.
const MOST_IMPACTS: usize = 2000;

#[derive(Serialize)]
struct Payload<'a> {
    duration: f64,
    buildings: Vec<Outline<'a>>,
    gaps: Vec<GapData>,
    links: Vec<LinkData>,
    ground: Series,
    run: Table,
    without: Option<Table>,
    forces: Vec<ForceData>,
    impacts: Vec<ImpactData>,
    hysteretic: bool,
    hinges: Vec<HingeData>,
    loops: Vec<LoopData>,
    devices: Vec<DeviceData>,
    walls: Vec<SceneWall>,
    #[serde(skip_serializing_if = "Option::is_none")]
    bearing: Option<BearingData>,
}

/// Building, kind (`c`, `b`, `s`; `d` with the lines of both ends, `m` with thousandths of the storey), level, line, end, when it cracked and yielded \[s\], its greatest ductility \[–\], and
/// whether it is a brace that buckles.
type HingeData = (
    usize,
    char,
    usize,
    usize,
    usize,
    Option<f64>,
    Option<f64>,
    f64,
    bool,
);

/// The loop of one hinge.
#[derive(Serialize)]
struct LoopData {
    name: String,
    building: usize,
    storey: bool,
    ductility: f64,
    dissipated: f64,
    backbone: Vec<[f64; 2]>,
    time: Packed,
    deformation: Packed,
    force: Packed,
}

/// The loop of bearings or of a link.
#[derive(Serialize)]
struct DeviceData {
    name: String,
    building: usize,
    note: String,
    outline: Vec<[f64; 2]>,
    marks: Vec<f64>,
    over_time: bool,
    is_path: bool,
    time: Packed,
    deformation: Packed,
    force: Packed,
}

/// Shape of a building at rest.
#[derive(Serialize)]
struct Outline<'a> {
    /// Plans of the floors, of buildings in space.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    plans: Vec<PlanData>,
    /// The mat of an isolated building in space.
    #[serde(skip_serializing_if = "Option::is_none")]
    mat: Option<PlanData>,
    /// Columns and beams of a space frame.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    members: Vec<MemberData>,
    name: &'a str,
    frame: bool,
    /// Heights of the floors \[m\].
    heights: Vec<f64>,
    /// Bay widths \[m\].
    spans: Vec<f64>,
    /// Storeys with a column from 1, by column line, of a frame that lacks some; in space, storeys whose floor ends there as well.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    standing: Vec<Vec<usize>>,
    /// Height of the base above the datum, if it is not zero \[m\].
    #[serde(skip_serializing_if = "Option::is_none")]
    elevation: Option<f64>,
    /// Braces and struts of a frame in one plane, or of a space frame.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    diagonals: Vec<DiagonalData>,
    /// Walls of a frame in one plane.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    walls: Vec<WallData>,
    /// Whether it stands on bearings.
    isolated: bool,
    /// Length \[m\] and number of contact springs of a foundation that lifts off.
    #[serde(skip_serializing_if = "Option::is_none")]
    footing: Option<(f64, usize)>,
}

/// A floor from above.
#[derive(Serialize)]
struct PlanData {
    /// Corners on the site, counter-clockwise \[m\].
    corners: Vec<[f64; 2]>,
    /// Centre of mass \[m\].
    centre: [f64; 2],
}

#[derive(Serialize)]
struct GapData {
    /// Left and right building; `null` is a wall.
    between: [Option<usize>; 2],
    /// Walls of the scene on its sides.
    walls: [Option<usize>; 2],
    width: f64,
    contacts: Vec<ContactData>,
}

#[derive(Serialize)]
struct ContactData {
    /// Index into the histories.
    index: usize,
    label: String,
    floors: [Option<usize>; 2],
    height: f64,
    width: f64,
    peak: f64,
    impacts: usize,
    /// Where it is in plan.
    #[serde(skip_serializing_if = "Option::is_none")]
    plan: Option<ContactPlan>,
}

/// A face or a corner from above.
#[derive(Serialize)]
struct ContactPlan {
    /// Middle \[m\].
    at: [f64; 2],
    /// Unit normal from the first building to the second.
    normal: [f64; 2],
    /// Length; zero for a corner \[m\].
    length: f64,
}

/// Ground motion in plan.
#[derive(Serialize)]
struct BearingData {
    /// From x to the motion \[rad\].
    angle: f64,
    across: Option<Series>,
}

/// A spring or damper between two points.
#[derive(Serialize)]
struct LinkData {
    between: [Option<usize>; 2],
    walls: [Option<usize>; 2],
    /// Floors that it joins, inside one building.
    inside: Option<[usize; 2]>,
    height: f64,
    spring: bool,
    dashpot: bool,
}

#[derive(Serialize)]
struct ImpactData {
    contact: usize,
    start: f64,
    end: f64,
    peak: f64,
    at: f64,
    /// Centre of pressure at the peak, of faces \[m\].
    #[serde(skip_serializing_if = "Option::is_none")]
    centre: Option<[f64; 2]>,
}

/// One quantity on instants of its own.
#[derive(Serialize)]
struct Series {
    time: Packed,
    values: Packed,
}

/// Force of a contact during its impacts.
#[derive(Serialize)]
struct ForceData {
    #[serde(flatten)]
    force: Series,
    /// Indentation at the same instants; `null` where the history does not hold it.
    indentation: Option<Packed>,
}

/// Quantities on common instants, named `u:building:floor`, `c:contact` and `e:term`.
#[derive(Serialize)]
struct Table {
    time: Packed,
    columns: Vec<(String, Packed)>,
}

/// The JSON text, safe inside a script element.
pub(crate) fn payload(page: &Page) -> String {
    text(page, &FILE, &mut Packer::Text)
        .replace('<', "\\u003c")
        .replace('\u{2028}', "\\u2028")
        .replace('\u{2029}', "\\u2029")
}

/// The JSON text and the numbers that it refers to.
pub(crate) fn frame(page: &Page) -> (String, Vec<f32>) {
    let mut pack = Packer::Floats(Vec::new());
    let text = text(page, &LIVE, &mut pack);
    match pack {
        Packer::Floats(floats) => (text, floats),
        Packer::Text => (text, Vec::new()),
    }
}

fn text(page: &Page, budget: &Budget, pack: &mut Packer) -> String {
    let time = page.history.column(Column::TIME).unwrap_or_default();
    let closed = rows_in_contact(page);
    let places = hinges::places(page);
    let walls = walls::walls(page);
    let payload = Payload {
        duration: duration(page, &time),
        buildings: outlines(page),
        gaps: gaps(page, &walls),
        links: links(page, &walls),
        ground: ground(page.motion, budget.ground, pack),
        run: table(
            page,
            page.history,
            &closed,
            [budget.run, budget.rows],
            true,
            pack,
        ),
        without: page.without_contact.map(|history| {
            table(
                page,
                history,
                &[],
                [budget.without, budget.rows],
                false,
                pack,
            )
        }),
        forces: force_data(page, &time, budget.forces, pack),
        impacts: impacts(page.summary),
        hysteretic: page.summary.energy.hysteretic_j.abs()
            > 1e-6 * page.summary.energy.input_j.abs(),
        hinges: hinge_data(page, &places),
        loops: loops(page, &places, &time, budget.loops, pack),
        devices: devices(page, &time, budget.loops, pack),
        walls,
        bearing: page.model.is_in_space().then(|| BearingData {
            angle: page
                .motion
                .bearing
                .as_ref()
                .map_or(0.0, |bearing| bearing.angle),
            across: page
                .motion
                .across()
                .map(|across| ground(across, budget.ground, pack)),
        }),
    };
    // Finite numbers and strings only: this cannot fail.
    serde_json::to_string(&payload).unwrap_or_else(|_| "{}".into())
}

/// Number of the member of a space frame at whose end a place is, in the order of [`MemberData::all_of`], from 1.
fn member_number(page: &Page, place: &Place) -> Option<usize> {
    let SpringPlace::InSpace {
        place: space_place, ..
    } = place.at
    else {
        return None;
    };
    let Structure::Tiers(tiers) = &page.model.buildings[place.building].structure else {
        return None;
    };
    let mut members = tiers.space_frame.as_ref()?.members.iter();
    members
        .position(|member| member.place == space_place)
        .map(|index| index + 1)
}

fn hinge_data(page: &Page, places: &[Place]) -> Vec<HingeData> {
    let order = hinges::in_order(page, places);
    let mut data: Vec<HingeData> = places
        .iter()
        .map(|place| {
            let (kind, level, line, end) = hinges::coordinates(page, place);
            let line = member_number(page, place).unwrap_or(line);
            (
                place.building,
                kind,
                level,
                line,
                end,
                None,
                None,
                0.0,
                place.buckles(),
            )
        })
        .collect();
    let short = |t: f64| (t * 1e4).round() / 1e4;
    for (place, spring) in order {
        // Springs shown elsewhere are counted, but have no entry.
        let Some(index) = places
            .iter()
            .position(|candidate| candidate.spring == place.spring)
        else {
            continue;
        };
        let entry = &mut data[index];
        entry.5 = spring.cracked_s.filter(|_| !entry.8).map(short);
        entry.6 = spring.yielded_s.map(short);
        entry.7 = (spring.ductility * 1e3).round() / 1e3;
    }
    data
}

fn loops(
    page: &Page,
    places: &[Place],
    time: &[f64],
    budget: usize,
    pack: &mut Packer,
) -> Vec<LoopData> {
    let Some(springs) = page.springs else {
        return Vec::new();
    };
    let order = hinges::in_order(page, places);
    let chosen = hinges::worst(&order);
    // Two values and an instant of twice their size in a row.
    let budget = budget / 4 / chosen.len().max(1);
    let of_place = |(place, spring): &(Place, &SpringSummary)| {
        let points: Vec<[f32; 2]> = springs.of_spring(place.spring).collect();
        let rows = thin_loop(time, &points, budget);
        let instants: Vec<f64> = rows.iter().map(|row| time[*row]).collect();
        let values = |part: usize, pack: &mut Packer| {
            let rows = rows.iter();
            pack.values(rows.map(|row| f64::from(points[*row][part])))
        };
        let reach = [spring.deformation_max, spring.deformation_min];
        LoopData {
            name: hinges::name(page, place),
            building: place.building,
            storey: hinges::slides(place.at),
            ductility: spring.ductility,
            dissipated: spring.dissipated_j,
            backbone: hinges::outline(place.hysteresis.backbone(), reach),
            time: pack.instants(&instants),
            deformation: values(0, pack),
            force: values(1, pack),
        }
    };
    chosen.iter().map(of_place).collect()
}

fn devices(page: &Page, time: &[f64], budget: usize, pack: &mut Packer) -> Vec<DeviceData> {
    let shown = devices::shown(page);
    // As for loops of hinges.
    let budget = budget / 4 / shown.len().max(1);
    let data = shown.into_iter().map(|(device, points)| {
        let rows = thin_loop(time, &points, budget);
        let instants: Vec<f64> = rows.iter().map(|row| time[*row]).collect();
        let values = |part: usize, pack: &mut Packer| {
            let rows = rows.iter();
            pack.values(rows.map(|row| f64::from(points[*row][part])))
        };
        DeviceData {
            time: pack.instants(&instants),
            deformation: values(0, pack),
            force: values(1, pack),
            name: device.name,
            building: device.building,
            note: device.note,
            outline: device.outline,
            marks: device.marks,
            over_time: device.over_time,
            is_path: device.is_path,
        }
    });
    data.collect()
}

fn duration(page: &Page, time: &[f64]) -> f64 {
    let reached = time.last().copied().unwrap_or(0.0);
    if reached > 0.0 {
        reached
    } else {
        page.motion.duration.max(1e-3)
    }
}

fn outlines<'a>(page: &Page<'a>) -> Vec<Outline<'a>> {
    let buildings = page.model.buildings.iter().enumerate();
    let summary = |index: usize| page.summary.buildings.get(index);
    buildings
        .map(|(index, building)| outline(building, summary(index)))
        .collect()
}

fn outline<'a>(building: &'a Building, summary: Option<&BuildingSummary>) -> Outline<'a> {
    /// Drawn width of a shear building, which has none \[m\].
    const NOMINAL_WIDTH: f64 = 6.0;
    let (frame, spans, standing) = match &building.structure {
        Structure::Frame(frame) => {
            let standing = match frame.is_regular() {
                true => Vec::new(),
                false => frame.storeys_of_lines(),
            };
            (true, frame.spans.clone(), standing)
        }
        Structure::Tiers(tiers) => {
            let seen = SeenAcross::new(tiers);
            let spans = seen.lines.windows(2).map(|pair| pair[1] - pair[0]);
            let spans = spans.collect();
            let standing = match seen.is_regular(tiers.floors.len()) {
                true => Vec::new(),
                false => seen.storeys,
            };
            (false, spans, standing)
        }
        Structure::Shear(_) | Structure::Given(_) => (false, vec![NOMINAL_WIDTH], Vec::new()),
    };
    let plans = match &building.structure {
        Structure::Tiers(tiers) => {
            // Motions are those of the centre of all masses.
            let plan = |floor: LumpedFloor| PlanData {
                corners: floor.tier.plan,
                centre: floor.tier.centre,
            };
            tiers.lumped_floors().into_iter().map(plan).collect()
        }
        Structure::Frame(_) | Structure::Shear(_) | Structure::Given(_) => Vec::new(),
    };
    let mat = match (&building.structure, building.base.isolation) {
        (Structure::Tiers(tiers), Some(isolation)) => {
            let mat = tiers.mat(isolation.mat_mass).tier;
            Some(PlanData {
                corners: mat.plan,
                centre: mat.centre,
            })
        }
        _ => None,
    };
    let in_space = match &building.structure {
        Structure::Tiers(tiers) => tiers.space_frame.as_ref(),
        _ => None,
    };
    let members = in_space.map(MemberData::all_of);
    let plane = match &building.structure {
        Structure::Frame(frame) => Some(frame),
        _ => None,
    };
    let of_plane = plane.into_iter().flat_map(|plane| &plane.diagonals);
    let of_space = in_space.into_iter().flat_map(|frame| {
        let diagonals = frame.diagonals.iter();
        diagonals.map(|diagonal| DiagonalData::in_space(frame, diagonal))
    });
    let stages = summary.map(|summary| strut_stages(building, summary));
    let mut stages = stages.into_iter().flatten();
    let parts = summary.into_iter().flat_map(|summary| &summary.parts);
    let struts = parts.filter(|part| matches!(part.kind, "brace" | "infill"));
    let mut fallen = struts.map(|part| part.fallen_s);
    let diagonals = of_plane.map(DiagonalData::of).chain(of_space);
    let diagonals = diagonals.map(|diagonal| {
        let mut diagonal = diagonal.until(fallen.next().flatten());
        if diagonal.infill {
            diagonal.stage = stages.next().flatten();
        }
        diagonal
    });
    let footing = building.base.foundation;
    Outline {
        plans,
        mat,
        members: members.unwrap_or_default(),
        name: &building.name,
        frame,
        heights: building.floor_heights(),
        spans,
        standing,
        elevation: Some(building.base.elevation).filter(|elevation| *elevation != 0.0),
        diagonals: diagonals.collect(),
        walls: plane
            .map(|plane| plane.walls.iter().map(WallData::of).collect())
            .unwrap_or_default(),
        isolated: building.base.isolation.is_some(),
        footing: footing.and_then(|footing| Some((footing.length, footing.uplift?.springs))),
    }
}

/// All contacts in the order of their indices in the histories.
pub(crate) fn contacts(summary: &Summary) -> impl Iterator<Item = &ContactSummary> {
    summary.gaps.iter().flat_map(|gap| &gap.contacts)
}

fn gaps(page: &Page, walls: &[SceneWall]) -> Vec<GapData> {
    let mut index = 0;
    page.gaps()
        .map(|(summary, gap)| GapData {
            between: page.model.buildings_beside(gap.between),
            walls: SceneWall::index_of(walls, page.model, gap.between),
            width: gap.width(),
            contacts: summary
                .contacts
                .iter()
                .map(|contact| {
                    index += 1;
                    ContactData {
                        index: index - 1,
                        label: place(page.summary, summary, contact),
                        floors: contact.floors,
                        height: contact.height_m,
                        width: contact.width_m,
                        peak: contact.peak_force_n,
                        impacts: contact.impact_count,
                        plan: contact.in_plan.map(|plan| ContactPlan {
                            at: plan.plan_m,
                            normal: plan.normal,
                            length: plan.overlap_m,
                        }),
                    }
                })
                .collect(),
        })
        .collect()
}

fn links(page: &Page, walls: &[SceneWall]) -> Vec<LinkData> {
    let all = page.links().flat_map(|(summary, link)| {
        summary.floors.iter().map(|floor| LinkData {
            between: page.model.buildings_beside(link.between),
            walls: SceneWall::index_of(walls, page.model, link.between),
            inside: match floor.floors {
                [Some(low), Some(high)] if link.is_inside() => Some([low, high]),
                _ => None,
            },
            height: floor.height_m,
            spring: link.stiffness > 0.0 || link.law.is_hysteretic(),
            dashpot: link.damping > 0.0,
        })
    });
    all.collect()
}

fn ground(motion: &GroundMotion, most: usize, pack: &mut Packer) -> Series {
    let step = match &motion.wave {
        Wave::Sampled { step, .. } => *step,
        Wave::Sine { period, .. } | Wave::Ricker { period, .. } => period / 40.0,
    };
    let count = (motion.duration / step).floor().max(1.0);
    let points = if count <= 1e6 {
        count as usize
    } else {
        1_000_000
    };
    let step = if points < 1_000_000 {
        step
    } else {
        motion.duration / 1e6
    };
    let rows: Vec<usize> = if points <= most {
        (0..=points).collect()
    } else {
        extremes(points, most, |i| motion.acceleration(i as f64 * step))
    };
    let time: Vec<f64> = rows.iter().map(|i| *i as f64 * step).collect();
    Series {
        values: pack.values(time.iter().map(|t| motion.acceleration(*t))),
        time: pack.instants(&time),
    }
}

/// The least and the greatest of every bucket, in order.
fn extremes(points: usize, most: usize, value: impl Fn(usize) -> f64) -> Vec<usize> {
    let bucket = (2 * points).div_ceil(most).max(2);
    let mut rows = vec![0];
    for start in (0..points).step_by(bucket) {
        let mut pair = [start, start];
        for i in start..(start + bucket).min(points) {
            if value(i) < value(pair[0]) {
                pair[0] = i;
            }
            if value(i) > value(pair[1]) {
                pair[1] = i;
            }
        }
        pair.sort_unstable();
        rows.extend(pair);
    }
    rows.push(points);
    rows.dedup();
    rows
}

/// Force of a contact in every row \[N\].
fn force(page: &Page, contact: usize) -> Vec<f64> {
    let column = Column::contact_force(contact);
    page.history.column(column).unwrap_or_default()
}

/// Whether any contact has a force in a row.
fn rows_in_contact(page: &Page) -> Vec<bool> {
    let mut closed = vec![false; page.history.len()];
    for contact in 0..contacts(page.summary).count() {
        for (closed, force) in closed.iter_mut().zip(force(page, contact)) {
            *closed |= force != 0.0;
        }
    }
    closed
}

fn force_data(page: &Page, time: &[f64], budget: usize, pack: &mut Packer) -> Vec<ForceData> {
    let count = contacts(page.summary).count();
    let kept = thin_impacts(count, |contact| force(page, contact), budget / 2);
    let closed = page.gaps().flat_map(|(summary, gap)| {
        let contacts = summary.contacts.iter();
        contacts.map(move |contact| (gap, contact))
    });
    let all = kept.into_iter().zip(closed).enumerate();
    all.map(|(index, (rows, (gap, contact)))| {
        let instants: Vec<f64> = rows
            .iter()
            .filter_map(|(row, _)| time.get(*row).copied())
            .collect();
        let depths = if rows.is_empty() {
            None
        } else {
            indentation(page.model, page.history, gap, contact, index)
        };
        ForceData {
            force: Series {
                time: pack.instants(&instants),
                values: pack.values(rows.iter().map(|(_, force)| *force)),
            },
            indentation: depths
                .map(|depths| pack.values(rows.iter().map(|(row, _)| depths[*row].max(0.0)))),
        }
    })
    .collect()
}

/// Indentation of a contact in every row of a history, negative while it is open; `None` where the history holds neither
/// its closing nor its floors \[m\].
fn indentation(
    model: &Model,
    history: &History,
    gap: &Gap,
    contact: &ContactSummary,
    index: usize,
) -> Option<Vec<f64>> {
    if let Some(closing) = history.column(Column::closing(index)) {
        return Some(closing.iter().map(|u| u - contact.width_m).collect());
    }
    if contact.in_plan.is_some() {
        return face_indentation(model, history, gap, contact);
    }
    let mut depths = vec![-contact.width_m; history.len()];
    for (side, sign) in [(0, 1.0), (1, -1.0)] {
        let Some(column) = side_column(model, gap.between[side], contact.floors[side])? else {
            // A rigid wall moves with the ground.
            continue;
        };
        for (depth, moved) in depths.iter_mut().zip(history.column(column)?) {
            *depth += sign * moved;
        }
    }
    Some(depths)
}

/// What a table shows of a history.
enum Shown<'a> {
    Recorded(Column),
    /// Closing of a face: its greatest indentation and the least gap of its points together \[m\].
    Face(&'a Gap, &'a ContactSummary),
}

impl Shown<'_> {
    /// Its values in every row; `None` where the history has none.
    fn values(&self, page: &Page, history: &History) -> Option<Vec<f64>> {
        match *self {
            Self::Recorded(column) => {
                let mut values = history.column(column)?;
                if column == Column::energy(EnergyTerm::Input)
                    && let Some(of_grounds) = history.column(Column::energy(EnergyTerm::Ground))
                {
                    // What the other energies add up to.
                    let both = values.iter_mut().zip(&of_grounds);
                    both.for_each(|(input, ground)| *input += ground);
                }
                Some(values)
            }
            Self::Face(gap, contact) => {
                let depths = face_indentation(page.model, history, gap, contact)?;
                let closing = depths.into_iter().map(|depth| depth + contact.width_m);
                Some(closing.collect())
            }
        }
    }
}

/// Displacements, and energies if asked for, on thinned instants that hit every peak displacement. Columns of long rows are large: they are
/// read twice, once for their peaks, and only one is in memory at a time.
fn table(
    page: &Page,
    history: &History,
    closed: &[bool],
    [numbers, most_rows]: [usize; 2],
    energies: bool,
    pack: &mut Packer,
) -> Table {
    let time = history.column(Column::TIME).unwrap_or_default();
    let recorded = wanted(page, history, energies).into_iter();
    let recorded = recorded.map(|(name, column)| (name, Shown::Recorded(column)));
    let faces = page.gaps().flat_map(|(summary, gap)| {
        let contacts = summary.contacts.iter();
        contacts.map(move |contact| Shown::Face(gap, contact))
    });
    let faces = faces.enumerate();
    let faces = faces.filter(|(index, _)| !history.columns().contains(&Column::closing(*index)));
    let faces = faces.map(|(index, face)| (format!("c:{index}"), face));
    let mut columns: Vec<(String, Shown)> = recorded.chain(faces).collect();
    let mut always: Vec<usize> = Vec::new();
    columns.retain(|(name, shown)| {
        let values = shown.values(page, history);
        let peaked = values
            .as_deref()
            .filter(|_| name.starts_with(['u', 'v', 'r', 'c']));
        always.extend(peaked.into_iter().flat_map(peaks));
        values.is_some()
    });
    // An instant takes as much as two values.
    let budget = (numbers / (columns.len() + 2)).min(most_rows);
    let rows = thin_rows(&time, closed, &always, budget);
    let kept: Vec<f64> = rows.iter().map(|row| time[*row]).collect();
    let time = pack.instants(&kept);
    let packed = columns.into_iter().map(|(name, shown)| {
        let values = shown.values(page, history).unwrap_or_default();
        (name, pack.values(rows.iter().map(|row| values[*row])))
    });
    Table {
        time,
        columns: packed.collect(),
    }
}

fn peaks(values: &[f64]) -> impl Iterator<Item = usize> {
    let by = |a: &(usize, &f64), b: &(usize, &f64)| a.1.total_cmp(b.1);
    let least = values.iter().enumerate().min_by(by);
    let greatest = values.iter().enumerate().max_by(by);
    least.into_iter().chain(greatest).map(|(row, _)| row)
}

fn wanted(page: &Page, history: &History, energies: bool) -> Vec<(String, Column)> {
    let mut wanted = Vec::new();
    for (building, shape) in page.model.buildings.iter().enumerate() {
        for floor in 1..=shape.floors() {
            wanted.push((
                format!("u:{building}:{floor}"),
                Column::displacement(building, floor),
            ));
        }
    }
    // Floors across and in rotation, then mats and walls, then closings.
    let prefix = |column: &Column| match (column.owner, column.kind, column.direction) {
        (Owner::Floor { .. }, Kind::Displacement, Direction::Across) => "v",
        (Owner::Floor { .. }, Kind::Displacement, Direction::Turning) => "r",
        (Owner::Floor { floor: 0, .. }, Kind::Displacement, Direction::Along) => "u",
        (Owner::Contact(_), Kind::Closing, _) => "c",
        _ => "",
    };
    for prefixes in [&["v", "r"][..], &["u"], &["c"]] {
        let columns = history.columns().iter();
        let columns = columns.filter(|column| prefixes.contains(&prefix(column)));
        wanted.extend(columns.map(|column| {
            let (prefix, [index, floor]) = (prefix(column), column.place());
            let name = match column.owner {
                Owner::Contact(_) => format!("{prefix}:{index}"),
                _ => format!("{prefix}:{index}:{floor}"),
            };
            (name, *column)
        }));
    }
    if energies {
        let all = EnergyTerm::ALL.into_iter().chain([EnergyTerm::Friction]);
        let named = all.map(|term| (format!("e:{}", energy_name(term)), Column::energy(term)));
        // Friction is recorded only where faces have it.
        wanted.extend(named.filter(|(_, column)| history.columns().contains(column)));
    }
    wanted
}

fn energy_name(term: EnergyTerm) -> &'static str {
    match term {
        EnergyTerm::Input => "input",
        EnergyTerm::Ground => "ground",
        EnergyTerm::Kinetic => "kinetic",
        EnergyTerm::Strain => "strain",
        EnergyTerm::Damped => "damped",
        EnergyTerm::Hysteretic => "hysteretic",
        EnergyTerm::Contact => "contact",
        EnergyTerm::Friction => "friction",
    }
}

/// The strongest impacts, in order of time.
fn impacts(summary: &Summary) -> Vec<ImpactData> {
    let mut impacts: Vec<ImpactData> = contacts(summary)
        .enumerate()
        .flat_map(|(index, contact)| {
            contact.impacts.iter().map(move |impact| ImpactData {
                contact: index,
                start: impact.start_s,
                end: impact.end_s,
                peak: impact.peak_force_n,
                at: impact.peak_force_at_s,
                centre: impact.centre_m,
            })
        })
        .collect();
    sort_by(&mut impacts, |a, b| b.peak.total_cmp(&a.peak));
    impacts.truncate(MOST_IMPACTS);
    sort_by(&mut impacts, |a, b| a.start.total_cmp(&b.start));
    impacts
}
