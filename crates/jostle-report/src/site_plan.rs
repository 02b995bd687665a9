//! Buildings in space seen from above: plans, faces with their forces, paths of roof corners, and peaks across and in
//! rotation.

use jostle::interface::PlanContactKind;
use jostle::results::summary::ContactSummary;
use jostle::{Column, PlanPoint, Tiers};
use maud::{Markup, html};

use crate::document::colour;
use crate::message;
use crate::site_drawing::{self, Scale, WIDTH, tiers};
use crate::site_places::SitePlace;
use crate::static_plot::{Line, Plot, thinned_to};
use crate::{Page, face_pressure, format};

/// Length of the longest path of a corner in the drawing, as a part of the site.
const PATH: f64 = 0.12;
/// Points of a path.
const POINTS: usize = 300;
/// Points of a history; with all of several buildings the page would be large.
const IN_HISTORY: usize = 500;

/// The section; `None` in one plane.
pub(crate) fn section(page: &Page) -> Option<Markup> {
    page.model.is_in_space().then(|| {
        html! {
            section #site.site-plan {
                h2 { (message::seen_from_above()) }
                (drawing(page))
                (faces(page))
                (face_pressure::figures(page))
                @if page.history.len() > 1 { (orbits(page)) }
                (peaks(page))
                (histories(page))
            }
        }
    })
}

fn drawing(page: &Page) -> Markup {
    let Some(scale) = Scale::new(page.model) else {
        return html! {};
    };
    let paths = corner_paths(page, WIDTH / scale.factor);
    let beneath = html! {
        @if let Some((paths, _)) = &paths {
            @for (index, path) in paths {
                g style=(colour(*index)) { polyline.path points=(scale.path(path.iter().copied())) {} }
            }
        }
    };
    let places = SitePlace::of_run(page.model, page.summary);
    html! {
        figure.static-plot {
            figcaption {
                span.chart-title { (message::site_plan()) }
                @if let Some((_, times)) = &paths { span.quiet { "  " (message::paths_of_roof_corners_times(format::plain(*times, 3))) } }
            }
            (site_drawing::drawing(page.model, &scale, &places, (Some(page.motion), page.north), &beneath))
        }
        p.quiet {
            (message::filled_circles_centres_of_mass())
            @if tiers(page.model).any(|(.., tiers)| tiers.initial_storey(0).is_some()) { " " (message::open_squares_centres_of_stiffness()) }
            @if tiers(page.model).any(|(.., tiers)| !tiers.frames.is_empty() || tiers.space_frame.is_some() || !tiers.yielding.is_empty()) { " " (message::columns_and_lines_of_the_lowest_storey()) }
            @if tiers(page.model).any(|(.., tiers)| tiers.space_frame.is_some()) { " " (message::dash_and_dot_grid_lines()) }
            @if places.iter().any(|place| place.slip.is_some()) { " " (message::arrows_beside_faces()) }
        }
    }
}

/// Building and path.
type CornerPaths = Vec<(usize, Vec<PlanPoint>)>;

/// Paths of the roof corners, exaggerated so that the longest is a given part of the site, and by how much.
fn corner_paths(page: &Page, site: f64) -> Option<(CornerPaths, f64)> {
    let mut all: Vec<(usize, PlanPoint, Vec<PlanPoint>)> = Vec::new();
    for (building, _, tiers) in tiers(page.model) {
        let floor = tiers.floors.len();
        let column = |column| page.history.column(column);
        let x = column(Column::displacement(building, floor))?;
        let y = column(Column::displacement(building, floor).across())?;
        let turn = column(Column::displacement(building, floor).turning())?;
        let roof = tiers.floors.last()?;
        let every = (x.len() / POINTS).max(1);
        for corner in &roof.plan {
            let arm = [corner[0] - roof.centre[0], corner[1] - roof.centre[1]];
            let moved = (0..x.len())
                .step_by(every)
                .map(|i| [x[i] - turn[i] * arm[1], y[i] + turn[i] * arm[0]]);
            all.push((building, *corner, moved.collect()));
        }
    }
    let moved = all.iter().flat_map(|(.., path)| path);
    let most = moved.map(|[x, y]| x.hypot(*y)).fold(0.0, f64::max);
    if most <= 0.0 {
        return None;
    }
    let times = (0.5 * PATH * site / most).max(1.0);
    // A round number.
    let digits = 10.0_f64.powf(times.log10().floor());
    let times = (times / digits).floor() * digits;
    let paths = all.into_iter().map(|(building, corner, path)| {
        let shifted = path
            .into_iter()
            .map(|[x, y]| [corner[0] + times * x, corner[1] + times * y]);
        (building, shifted.collect())
    });
    Some((paths.collect(), times))
}

/// Where the scripts draw orbits of corners.
fn orbits(page: &Page) -> Markup {
    html! {
        h3 { (message::paths_of_corners()) }
        p.quiet {
            (message::displacement_of_a_corner_relative())
            @if page.without_contact.is_some() { " " (message::dashed_the_same_buildings_without()) }
        }
        div #orbits.multiples {}
    }
}

/// The scene in three dimensions, which the scripts draw.
pub(crate) fn space_section(page: &Page) -> Option<Markup> {
    (page.model.is_in_space() && page.history.len() > 1).then(scene)
}

/// The scene, still empty.
pub(crate) fn scene() -> Markup {
    html! {
        // Shown by the script once buildings in space are there.
        section #in-space hidden {
            h2 { (message::how_they_move_in_space()) }
            div #space.stage {}
            div.controls {
                button #space-play type="button" { (message::play()) }
                span.buttons role="group" aria-label=(message::view()) {
                    button #space-oblique type="button" { (message::oblique_view()) }
                    button #space-side type="button" { (message::from_the_side()) }
                    button #space-above type="button" { (message::from_above()) }
                }
                label { (message::exaggeration()) " "
                    input #space-exaggeration type="range" min="0" max="2.5" step="0.01" value="1";
                    output #space-exaggeration-value for="space-exaggeration" { "10×" }
                }
                label { input #space-names type="checkbox" checked; " " (message::forces_in_kn()) }
            }
            p.quiet {
                span.screen { (message::drag_to_turn_the_view()) " " }
                (message::the_scene_in_space())
            }
        }
    }
}

fn pair(floors: [Option<usize>; 2]) -> String {
    let name = |floor: Option<usize>| floor.map_or("–".to_owned(), |floor| floor.to_string());
    format!("{} | {}", name(floors[0]), name(floors[1]))
}

fn faces(page: &Page) -> Markup {
    if page.summary.gaps.is_empty() {
        return html! {};
    }
    html! {
        h3 { (message::faces_and_corners()) }
        div.scroll { table {
            thead { tr {
                th scope="col" { (message::between()) } th scope="col" { (message::floors()) } th scope="col" { (message::kind()) }
                th.number scope="col" { (message::length()) br; span.unit { (format::HEIGHT.bracketed()) } } th.number scope="col" { (message::gap()) br; span.unit { (format::LENGTH.bracketed()) } }
                th.number scope="col" { (message::normal()) } th.number scope="col" { (message::impacts()) }
                th.number scope="col" { (message::peak_force()) br; span.unit { (format::FORCE.bracketed()) } } th.number scope="col" { (message::centre_of_pressure()) br; span.unit { (format::HEIGHT.bracketed()) } }
            } }
            tbody {
                @for gap in &page.summary.gaps {
                    @for contact in &gap.contacts {
                        @if let Some(plan) = contact.in_plan {
                            @let hardest = contact.impacts.iter().max_by(|a, b| a.peak_force_n.total_cmp(&b.peak_force_n));
                            @let centre = hardest.and_then(|impact| impact.centre_m);
                            tr {
                                th scope="row" { (gap.between[0]) " ↔ " (gap.between[1]) }
                                td { (pair(contact.floors)) } td { (kind_in_words(contact, plan.kind)) }
                                td.number { (format::in_unit(format::HEIGHT, plan.overlap_m, 2)) } td.number { (format::in_unit(format::LENGTH, contact.width_m, 1)) }
                                td.number { (format::fixed(plan.normal[0], 3)) ", " (format::fixed(plan.normal[1], 3)) }
                                td.number { (contact.impact_count) } td.number { (format::significant(format::FORCE.of(contact.peak_force_n), 4)) }
                                td.number { @match centre { Some([x, y]) => { (format::in_unit(format::HEIGHT, x, 2)) ", " (format::in_unit(format::HEIGHT, y, 2)) } None => { "–" } } }
                            }
                        }
                    }
                }
            }
        } }
    }
}

fn peaks(page: &Page) -> Markup {
    html! {
        h3 { (message::peaks_across_the_row()) }
        div.scroll { table {
            thead { tr {
                th scope="col" { (message::building()) } th.number scope="col" { (message::floor()) }
                th.number scope="col" { (message::displacement_across()) br; span.unit { (format::LENGTH.bracketed()) } } th.number scope="col" { (message::rotation()) br; span.unit { "[mrad]" } }
                th.number scope="col" { (message::corner()) br; span.unit { (format::LENGTH.bracketed()) } } th.number scope="col" { (message::drift_across()) br; span.unit { "[%]" } }
                th.number scope="col" { (message::drift_at_a_corner()) br; span.unit { "[%]" } }
                th.number scope="col" { (message::shear_across()) br; span.unit { (format::FORCE.bracketed()) } } th.number scope="col" { (message::torque()) br; span.unit { (format::MOMENT.bracketed()) } }
                th.number scope="col" { (message::acceleration_across()) br; span.unit { (format::ACCELERATION.bracketed()) } }
            } }
            tbody {
                @for building in &page.summary.buildings {
                    @for floor in building.floors.iter().rev() {
                        @if let Some(plan) = floor.in_plan {
                            tr {
                                th scope="row" { (building.name) } td.number { (floor.floor) }
                                td.number { (format::in_unit(format::LENGTH, plan.displacement_across_max_m, 1)) " / " (format::in_unit(format::LENGTH, plan.displacement_across_min_m, 1)) }
                                td.number { (format::fixed(plan.rotation_max_rad * 1e3, 2)) " / " (format::fixed(plan.rotation_min_rad * 1e3, 2)) }
                                td.number { (format::in_unit(format::LENGTH, plan.corner_displacement_peak_m, 1)) }
                                td.number { (format::fixed(plan.storey_drift_across_peak * 100.0, 2)) }
                                td.number { (format::fixed(plan.storey_drift_corner_peak * 100.0, 2)) }
                                td.number { (format::in_unit(format::FORCE, plan.storey_shear_across_peak_n, 1)) }
                                td.number { (format::in_unit(format::MOMENT, plan.storey_torque_peak_n_m, 0)) }
                                td.number { (format::in_unit(format::ACCELERATION, plan.total_acceleration_across_peak_m_s2, 2)) }
                            }
                        }
                    }
                }
            }
        } }
        p.quiet { (message::drift_shear_and_torque()) }
    }
}

/// Roof displacements across and rotations over time.
fn histories(page: &Page) -> Markup {
    let lines = |of: fn(usize, usize) -> Column, factor: f64| -> Vec<Line> {
        let of_run = |history: &jostle::History, free: bool| -> Vec<Line> {
            let Some(times) = history.column(Column::TIME) else {
                return Vec::new();
            };
            let line = |(building, _, tiers): (usize, &jostle::Building, &Tiers)| {
                let values = history.column(of(building, tiers.floors.len()))?;
                let points = times.iter().zip(values);
                let name = &page.model.buildings[building].name;
                Some(Line {
                    name: match free {
                        true => message::name_without_contact(name),
                        false => name.clone(),
                    },
                    points: thinned_to(
                        &points
                            .map(|(time, value)| [*time, factor * value])
                            .collect::<Vec<_>>(),
                        IN_HISTORY,
                    ),
                    colour: building,
                    dashed: free,
                })
            };
            tiers(page.model).filter_map(line).collect()
        };
        let mut lines = of_run(page.history, false);
        let without = page.without_contact.filter(|_| !page.model.gaps.is_empty());
        lines.extend(
            without
                .into_iter()
                .flat_map(|history| of_run(history, true)),
        );
        lines
    };
    let plot = |title: &str, y_label: &str, lines: Vec<Line>| Plot {
        title: title.to_owned(),
        x_label: message::time_s().to_owned(),
        y_label: y_label.to_owned(),
        logarithmic: false,
        aspect: 0.5,
        lines,
    };
    let across = lines(
        |building, floor| Column::displacement(building, floor).across(),
        format::LENGTH.of(1.0),
    );
    let turns = lines(
        |building, floor| Column::displacement(building, floor).turning(),
        1e3,
    );
    html! {
        div.static-plots {
            (plot(message::roof_displacement_across(), message::displacement_mm(), across).figure())
            (plot(message::roof_rotation(), message::rotation_mrad(), turns).figure())
        }
    }
}

fn kind_in_words(contact: &ContactSummary, kind: PlanContactKind) -> String {
    match (kind, &contact.struck_column) {
        (_, Some(line)) => message::column_at_line(line),
        (PlanContactKind::Corner, None) => message::corner().to_owned(),
        (PlanContactKind::Face | PlanContactKind::Column, None) => message::face().to_owned(),
    }
}
