//! Bearings, links, dampers and walls: loops of force over displacement, and a table of what they went through.

use std::f64::consts::TAU;

use jostle::history::Column;
use jostle::hysteresis::Side;
use jostle::linear::sort_by;
use jostle::model::{Isolation, Link, LinkLaw, Model};
use jostle::results::summary::{IsolationSummary, LinkFloorSummary, LinkSummary};
use maud::{Markup, html};

use crate::hinges::outline;
use crate::message;
use crate::{Page, format};

/// Loops shown.
const MOST_LOOPS: usize = 9;
/// Rows of the table.
const MOST_ROWS: usize = 100;

/// Bearings of a building, or one link.
pub(crate) struct Device<'a> {
    /// What it is and where.
    pub(crate) name: String,
    /// Index of its building, or of the left one.
    pub(crate) building: usize,
    /// Peak displacement and dissipated energy, in words.
    pub(crate) note: String,
    /// Force of first loading, as (displacement, force); empty where it has none.
    pub(crate) outline: Vec<[f64; 2]>,
    /// Displacements of stops and limits \[m\].
    pub(crate) marks: Vec<f64>,
    /// Whether its force is shown over time: loops of cables and stoppers are single lines.
    pub(crate) over_time: bool,
    /// Whether it is a path in plan: displacement across over that along x.
    pub(crate) is_path: bool,
    source: Source<'a>,
}

/// Where the history has it.
#[derive(Clone, Copy)]
enum Source<'a> {
    Bearings(usize),
    /// The same across.
    BearingsAcross(usize),
    /// The path of the mat in plan.
    Path(usize),
    /// Index among all links.
    Link(usize, &'a Link, [Option<usize>; 2]),
}

impl Device<'_> {
    /// Displacement and force at every instant of the history; `None` where it has them not \[m, N\].
    pub(crate) fn points(&self, page: &Page) -> Option<Vec<[f32; 2]>> {
        let (moved, force) = match self.source {
            Source::Bearings(building) => (
                page.history.column(Column::displacement(building, 0))?,
                page.history.column(Column::support_force(building))?,
            ),
            Source::BearingsAcross(building) => (
                page.history
                    .column(Column::displacement(building, 0).across())?,
                page.history
                    .column(Column::support_force(building).across())?,
            ),
            Source::Path(building) => (
                page.history.column(Column::displacement(building, 0))?,
                page.history
                    .column(Column::displacement(building, 0).across())?,
            ),
            Source::Link(index, link, floors) => (
                stroke(page, index, link, floors)?,
                page.history.column(Column::link_force(index))?,
            ),
        };
        let pairs = moved.iter().zip(&force);
        Some(pairs.map(|(u, f)| [*u as f32, *f as f32]).collect())
    }
}

/// Shortening of a link at every instant \[m\].
fn stroke(page: &Page, index: usize, link: &Link, floors: [Option<usize>; 2]) -> Option<Vec<f64>> {
    if let Some(recorded) = page.history.column(Column::link_stroke(index)) {
        return Some(recorded);
    }
    let mut moved = vec![0.0; page.history.len()];
    for (side, sign) in [(0, 1.0), (1, -1.0)] {
        let Some(column) = side_column(page.model, link.between[side], floors[side])? else {
            continue;
        };
        for (sum, u) in moved.iter_mut().zip(page.history.column(column)?) {
            *sum += sign * u;
        }
    }
    // Weight may have moved both sides before the run.
    let rest = moved.first().copied().unwrap_or(0.0);
    moved.iter_mut().for_each(|value| *value -= rest);
    Some(moved)
}

/// Column with the displacement of a side; `Some(None)` moves with the ground, `None` is a point between floors.
pub(crate) fn side_column(
    model: &Model,
    side: Option<usize>,
    floor: Option<usize>,
) -> Option<Option<Column>> {
    let Some(index) = side else {
        return Some(None);
    };
    if let Some(building) = model.buildings.get(index) {
        let floor = floor?;
        let on_ground = floor == 0 && building.base.isolation.is_none();
        return Some((!on_ground).then_some(Column::displacement(index, floor)));
    }
    let walls = &model.walls[..=index - model.buildings.len()];
    let moving = walls.iter().filter(|wall| !wall.is_rigid()).count();
    let rigid = walls.last().is_some_and(|wall| wall.is_rigid());
    Some((!rigid).then(|| Column::displacement(model.buildings.len() + moving - 1, 0)))
}

/// All of them: bearings first, then links by dissipated energy.
pub(crate) fn devices<'a>(page: &Page<'a>) -> Vec<Device<'a>> {
    let mut devices = Vec::new();
    for (index, isolation, result) in isolated(page) {
        let name = message::name_kind_bearings(&page.summary.buildings[index].name, result.kind);
        let device = |name: String, moved: f64, source: Source<'a>| Device {
            name,
            building: index,
            note: note(moved, result.hysteretic_j + result.damped_j),
            outline: first_loading(isolation, result),
            marks: marks(isolation),
            over_time: false,
            is_path: false,
            source,
        };
        let along = result.displacement_max_m.max(-result.displacement_min_m);
        let Some(in_plan) = &result.in_plan else {
            devices.push(device(name, along, Source::Bearings(index)));
            continue;
        };
        let across = in_plan
            .displacement_across_max_m
            .max(-in_plan.displacement_across_min_m);
        devices.push(device(
            message::bearings_along(&name),
            along,
            Source::Bearings(index),
        ));
        devices.push(device(
            message::bearings_across(&name),
            across,
            Source::BearingsAcross(index),
        ));
        devices.push(Device {
            note: message::path_of_mat(format::millimetres(in_plan.stroke_peak_m)),
            outline: circle(isolation),
            marks: Vec::new(),
            is_path: true,
            ..device(message::path_in_plan(&name), along, Source::Path(index))
        });
    }
    let mut links: Vec<(usize, &LinkSummary, &Link, &LinkFloorSummary)> = Vec::new();
    for (summary, link) in page.links() {
        for floor in &summary.floors {
            links.push((links.len(), summary, link, floor));
        }
    }
    links.retain(|(_, _, link, _)| link.law != LinkLaw::Linear || link.damping > 0.0);
    sort_by(&mut links, |a, b| {
        b.3.dissipated_j.total_cmp(&a.3.dissipated_j)
    });
    for (index, summary, link, floor) in links {
        let building = link.between.into_iter().flatten();
        let reach = 1.1 * floor.peak_stroke_m;
        devices.push(Device {
            name: name(summary, floor),
            building: building.min().unwrap_or(0),
            note: note(floor.peak_stroke_m, floor.dissipated_j),
            outline: match &link.law {
                LinkLaw::Friction {
                    slip_force,
                    stick_stiffness,
                } => symmetric(
                    slip_force / stick_stiffness,
                    *slip_force,
                    [reach, *slip_force],
                ),
                LinkLaw::Yielding(hysteresis) => outline(hysteresis.backbone(), [reach; 2]),
                LinkLaw::Linear
                | LinkLaw::Viscous { .. }
                | LinkLaw::Maxwell
                | LinkLaw::Cable { .. }
                | LinkLaw::Stopper { .. } => Vec::new(),
            },
            marks: Vec::new(),
            over_time: matches!(link.law, LinkLaw::Cable { .. } | LinkLaw::Stopper { .. }),
            is_path: false,
            source: Source::Link(index, link, floor.floors),
        });
    }
    devices
}

/// Those whose loops are shown.
pub(crate) fn shown<'a>(page: &Page<'a>) -> Vec<(Device<'a>, Vec<[f32; 2]>)> {
    let devices = devices(page).into_iter();
    let known = devices.filter_map(|device| {
        let points = device.points(page)?;
        Some((device, points))
    });
    known.take(MOST_LOOPS).collect()
}

/// Buildings on bearings: index, input, results.
pub(crate) fn isolated<'a>(
    page: &Page<'a>,
) -> impl Iterator<Item = (usize, &'a Isolation, &'a IsolationSummary)> {
    let buildings = page.model.buildings.iter().zip(&page.summary.buildings);
    buildings
        .enumerate()
        .filter_map(|(index, (building, summary))| {
            let isolation = building.base.isolation.as_ref()?;
            Some((index, isolation, summary.isolation.as_ref()?))
        })
}

fn note(moved: f64, dissipated: f64) -> String {
    message::moved_dissipated_dissipated(
        format::millimetres(moved),
        format::energy(without_rounding(dissipated)),
    )
}

/// Energy dissipated, without what springs without dashpot dissipate by rounding \[J\].
fn without_rounding(dissipated: f64) -> f64 {
    if dissipated.abs() < 1e-6 {
        0.0
    } else {
        dissipated
    }
}

fn name(summary: &LinkSummary, floor: &LinkFloorSummary) -> String {
    let [left, right] = &summary.between;
    let pair = if left == right {
        left.clone()
    } else {
        format!("{left} ↔ {right}")
    };
    let place = match floor.floors {
        [Some(left), Some(right)] => message::floors_left_right(left, right),
        [Some(one), None] | [None, Some(one)] => message::floor_one(one),
        [None, None] => {
            let unit = format::HEIGHT;
            format!(
                "{} {}",
                format::plain(unit.of(floor.height_m), 3),
                unit.name()
            )
        }
    };
    format!("{pair}, {place}, {}", summary.law)
}

/// Force of bearings of first loading to both sides, friction at high speed.
fn first_loading(isolation: &Isolation, result: &IsolationSummary) -> Vec<[f64; 2]> {
    let (isolator, weight) = (&isolation.isolator, result.weight_n);
    let yielding = isolator.yielding(weight).map_or(0.0, |[_, _, at]| at);
    let reach = 1.1 * result.displacement_peak_m().max(yielding);
    let points = isolator.first_loading(weight, reach);
    let right = points.iter().skip(1);
    let left = right.clone().rev().map(|point| point.map(|value| -value));
    left.chain(right.copied()).collect()
}

/// A line through zero, a corner and an end, and the same on the other side.
fn symmetric(deformation: f64, force: f64, [reach, end]: [f64; 2]) -> Vec<[f64; 2]> {
    vec![
        [-reach, -end],
        [-deformation, -force],
        [deformation, force],
        [reach, end],
    ]
}

/// The ring that stops a mat in plan, or else the limit of its bearings; empty without both \[m\].
fn circle(isolation: &Isolation) -> Vec<[f64; 2]> {
    let ring = isolation.stops[0].map(|stop| stop.at);
    let Some(radius) = ring.or(isolation.reach()) else {
        return Vec::new();
    };
    let corners = (0..=CORNERS).map(|corner| TAU * f64::from(corner) / f64::from(CORNERS));
    corners
        .map(|angle| [radius * angle.cos(), radius * angle.sin()])
        .collect()
}

/// Corners of a drawn circle.
const CORNERS: u32 = 72;

/// Displacements of stops and limits \[m\].
fn marks(isolation: &Isolation) -> Vec<f64> {
    let stops = Side::BOTH.into_iter().zip(isolation.stops);
    let stops = stops.filter_map(|(side, stop)| Some(side.sign() * stop?.at));
    let limits = isolation.reach().into_iter().flat_map(|at| [-at, at]);
    stops.chain(limits).collect()
}

/// The section of the page, if the model has any of them.
pub(crate) fn section(page: &Page) -> Option<Markup> {
    if isolated(page).next().is_none()
        && page.summary.links.is_empty()
        && page.summary.walls.is_empty()
    {
        return None;
    }
    let loops = page.history.len() > 1 && !shown(page).is_empty();
    let (rows, all) = rows(page);
    Some(html! {
        section #devices {
            h2 { (title(page)) }
            @for (index, isolation, result) in isolated(page) {
                p { (sentence(&page.summary.buildings[index].name, isolation, result)) }
            }
            @if loops {
                p.quiet {
                    (message::force_over_displacement_bearings())
                }
                div #device-loops.multiples {}
            }
            div.scroll {
                table {
                    thead { tr {
                        th scope="col" { (message::where_word()) }
                        @for (name, unit) in columns() {
                            th.number scope="col" { (name) @if !unit.is_empty() { br; span.unit { "[" (unit) "]" } } }
                        }
                    } }
                    tbody {
                        @for (place, cells) in rows {
                            tr { td { (place) } @for cell in cells { td.number { (cell) } } }
                        }
                    }
                }
            }
            @if all > MOST_ROWS {
                p.quiet { (message::the_that_dissipate_most(MOST_ROWS, all)) }
            }
        }
    })
}

fn columns() -> [(&'static str, &'static str); 7] {
    [
        (message::peak_force(), format::FORCE.name()),
        (message::stroke(), format::LENGTH.name()),
        (message::capacity(), format::LENGTH.name()),
        (message::used(), "%"),
        (message::peak_speed(), format::SPEED.name()),
        (message::residual(), format::LENGTH.name()),
        (message::dissipated(), format::ENERGY.name()),
    ]
}

fn title(page: &Page) -> String {
    let mut parts = Vec::new();
    if isolated(page).next().is_some() {
        parts.push(message::bearings());
    }
    if !page.summary.links.is_empty() {
        parts.push(message::links_and_dampers());
    }
    if !page.summary.walls.is_empty() {
        parts.push(message::walls());
    }
    format::capital(&parts.join(", "))
}

fn sentence(name: &str, isolation: &Isolation, result: &IsolationSummary) -> String {
    let moved = result.displacement_peak_m();
    let mut text = message::moves_on_its_bearings(name, format::millimetres(moved));
    if let Some(limit) = isolation.reach() {
        let used = format::fixed(100.0 * moved / limit, 0);
        text.push_str(&message::share_of_limit(&used, format::millimetres(limit)));
    }
    let residual = match &result.in_plan {
        Some(plan) => plan.residual_stroke_m,
        None => result.residual_m.abs(),
    };
    text.push_str(&message::they_dissipate_residual_displacement(
        format::energy(result.hysteretic_j + result.damped_j),
        format::millimetres(residual),
    ));
    if let Some(plan) = &result.in_plan {
        text.push_str(&message::worst_bearing(
            plan.stroke_bearing,
            plan.bearings,
            format::force(result.force_peak_n),
            format::force(plan.force_across_peak_n),
        ));
    }
    if let Some(force) = result.stop_force_peak_n.filter(|force| *force > 0.0) {
        text.push_str(&message::a_stop_is_hit(format::force(force)));
    }
    let stages: Vec<_> = result
        .stages
        .iter()
        .map(|stage| {
            let [went, travel] = [stage.travel_peak_m, stage.travel_m].map(format::millimetres);
            message::travel_of(stage.name, went, travel)
        })
        .collect();
    if !stages.is_empty() {
        text.push_str(&message::stages_slide(stages.join(", ")));
    }
    if result.reached_rims() {
        text.push_str(message::the_bearings_stood_at_their_rims());
    }
    text
}

type Row = (String, [String; 7]);

/// Rows of the table, and how many there would be.
fn rows(page: &Page) -> (Vec<Row>, usize) {
    let milli = |value: f64| format::significant(format::LENGTH.of(value), 3);
    let kilo = |value: f64| format::significant(format::FORCE.of(value), 3);
    let none = || format::NOTHING.to_owned();
    let mut rows = Vec::new();
    for (index, isolation, result) in isolated(page) {
        let moved = result.displacement_peak_m();
        rows.push((
            message::name_kind_bearings(&page.summary.buildings[index].name, result.kind),
            [
                kilo(result.in_plan.map_or(result.force_peak_n, |plan| {
                    plan.force_across_peak_n.max(result.force_peak_n)
                })),
                milli(moved),
                isolation.reach().map_or_else(none, milli),
                isolation
                    .reach()
                    .map_or_else(none, |limit| format::fixed(100.0 * moved / limit, 0)),
                none(),
                milli(match result.in_plan {
                    Some(plan) => plan.residual_stroke_m,
                    None => result.residual_m,
                }),
                kilo(result.hysteretic_j + result.damped_j),
            ],
        ));
    }
    for wall in &page.summary.walls {
        rows.push((
            wall.name.clone(),
            [
                kilo(wall.force_peak_n),
                milli(wall.displacement_peak_m),
                none(),
                none(),
                none(),
                none(),
                kilo(wall.dissipated_j),
            ],
        ));
    }
    let mut links = Vec::new();
    for (summary, link) in page.links() {
        for floor in &summary.floors {
            links.push((links.len(), summary, link, floor));
        }
    }
    sort_by(&mut links, |a, b| {
        b.3.dissipated_j.total_cmp(&a.3.dissipated_j)
    });
    let all = rows.len() + links.len();
    links.truncate(MOST_ROWS.saturating_sub(rows.len()));
    for (index, summary, link, floor) in links {
        let residual = stroke(page, index, link, floor.floors);
        let residual = residual.and_then(|stroke| stroke.last().copied());
        rows.push((
            name(summary, floor),
            [
                kilo(floor.peak_force_n.abs()),
                milli(floor.peak_stroke_m),
                none(),
                none(),
                format::significant(floor.peak_speed_m_s, 3),
                residual.map_or_else(none, milli),
                kilo(without_rounding(floor.dissipated_j)),
            ],
        ));
    }
    (rows, all)
}
