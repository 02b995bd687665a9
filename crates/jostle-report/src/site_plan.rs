//! Buildings in space seen from above: plans, faces with their forces, paths of roof corners, and peaks across and in
//! rotation.

use jostle::{Column, PlanPoint, Structure, Tiers};
use maud::{Markup, html};

use crate::document::colour;
use crate::static_plot::{Line, Plot};
use crate::{Page, format};

/// Width of the drawing, and the margin around the site.
const WIDTH: f64 = 760.0;
const MARGIN: f64 = 56.0;
/// Height of the arrows of the motion below it.
const ARROWS: f64 = 44.0;
/// Greatest height of the drawing.
const TALLEST: f64 = 560.0;
/// Length of the longest path of a corner in the drawing, as a part of the site.
const PATH: f64 = 0.12;
/// Points of a path.
const POINTS: usize = 600;

/// The section; `None` in one plane.
pub(crate) fn section(page: &Page) -> Option<Markup> {
    page.model.is_in_space().then(|| {
        html! {
            section #site.site-plan {
                h2 { "Seen from above" }
                (drawing(page))
                (faces(page))
                (peaks(page))
                (histories(page))
            }
        }
    })
}

fn tiers<'a>(page: &Page<'a>) -> impl Iterator<Item = (usize, &'a Tiers)> {
    let buildings = page.model.buildings.iter().enumerate();
    buildings.filter_map(|(index, building)| match &building.structure {
        Structure::Tiers(tiers) => Some((index, tiers)),
        _ => None,
    })
}

/// From the site to the drawing: y upwards.
struct Scale {
    from: PlanPoint,
    top: f64,
    factor: f64,
}

impl Scale {
    fn new(page: &Page) -> Option<(Self, f64)> {
        let corners =
            || tiers(page).flat_map(|(_, tiers)| tiers.floors.iter().flat_map(|f| &f.plan));
        let range = |axis: usize| {
            let values = corners().map(|corner| corner[axis]);
            values.fold([f64::INFINITY, f64::NEG_INFINITY], |[a, b], v| {
                [a.min(v), b.max(v)]
            })
        };
        let [x, y] = [range(0), range(1)];
        let (wide, deep) = (x[1] - x[0], y[1] - y[0]);
        if !(wide > 0.0 && deep > 0.0) {
            return None;
        }
        let factor = ((WIDTH - 2.0 * MARGIN) / wide).min((TALLEST - 2.0 * MARGIN) / deep);
        let height = factor * deep + 2.0 * MARGIN + ARROWS;
        let from = [x[0] - (WIDTH / factor - wide) / 2.0, y[0]];
        Some((
            Self {
                from,
                top: height - MARGIN - ARROWS,
                factor,
            },
            height,
        ))
    }

    fn place(&self, [x, y]: PlanPoint) -> [f64; 2] {
        [
            (x - self.from[0]) * self.factor,
            self.top - (y - self.from[1]) * self.factor,
        ]
    }

    fn path(&self, points: impl Iterator<Item = PlanPoint>) -> String {
        let list: Vec<String> = points
            .map(|point| {
                let [x, y] = self.place(point);
                format!("{x:.1},{y:.1}")
            })
            .collect();
        list.join(" ")
    }
}

fn drawing(page: &Page) -> Markup {
    let Some((scale, height)) = Scale::new(page) else {
        return html! {};
    };
    let paths = corner_paths(page, WIDTH / scale.factor);
    html! {
        figure.static-plot {
            figcaption {
                span.chart-title { "Site plan" }
                @if let Some((_, times)) = &paths { span.quiet { "  paths of roof corners " (format::plain(*times, 3)) " times as large" } }
            }
            svg viewBox=(format!("0 0 {WIDTH} {height:.0}")) role="img" aria-label="Plans of the buildings, faces that can touch, and paths of roof corners" {
                @for (index, tiers) in tiers(page) {
                    g style=(colour(index)) {
                        @for (floor, tier) in tiers.floors.iter().enumerate() {
                            // Equal floors are drawn once.
                            @if floor == 0 || tiers.floors[floor - 1].plan != tier.plan {
                                polygon.plan points=(scale.path(tier.plan.iter().copied())) {}
                            }
                        }
                        @for frame in &tiers.frames {
                            @let lines = (0..frame.column_lines()).map(|line| frame.line_at(line));
                            polyline.frame fill="none" points=(scale.path(lines.clone())) { title { "frame " (frame.name) } }
                            @for line in lines {
                                @let [x, y] = scale.place(line);
                                rect.column x=(format!("{:.1}", x - 2.5)) y=(format!("{:.1}", y - 2.5)) width="5" height="5" {}
                            }
                        }
                        @if let Some(tier) = tiers.floors.first() {
                            @let [x, y] = scale.place(tier.centre);
                            circle.mass cx=(format!("{x:.1}")) cy=(format!("{y:.1}")) r="4" { title { "centre of mass" } }
                            @if let Some(storey) = tiers.storeys.first() {
                                @let [sx, sy] = scale.place(storey.centre);
                                rect.stiffness x=(format!("{:.1}", sx - 3.5)) y=(format!("{:.1}", sy - 3.5)) width="7" height="7" { title { "centre of stiffness" } }
                            }
                            text x=(format!("{:.1}", x + 8.0)) y=(format!("{:.1}", y - 8.0)) { (page.model.buildings[index].name) }
                        }
                    }
                }
                @if let Some((paths, _)) = &paths {
                    @for (index, path) in paths {
                        g style=(colour(*index)) { polyline.path points=(scale.path(path.iter().copied())) {} }
                    }
                }
                (face_marks(page, &scale))
                (motion_marks(page, height))
            }
        }
        p.quiet { "Circles: centres of mass; squares: centres of stiffness of the lowest storey; bars: faces, as thick as their greatest force; dots: corners that can strike an edge." }
    }
}

/// All faces, as thick as their greatest force, and corners as dots.
fn face_marks(page: &Page, scale: &Scale) -> Markup {
    let contacts = || page.summary.gaps.iter().flat_map(|gap| &gap.contacts);
    let most = contacts()
        .map(|contact| contact.peak_force_n)
        .fold(1.0, f64::max);
    html! {
        @for contact in contacts() {
            @if let Some(plan) = contact.in_plan {
                @let half = 0.5 * plan.overlap_m;
                @let along = [-plan.normal[1] * half, plan.normal[0] * half];
                @let [x1, y1] = scale.place([plan.plan_m[0] - along[0], plan.plan_m[1] - along[1]]);
                @let [x2, y2] = scale.place([plan.plan_m[0] + along[0], plan.plan_m[1] + along[1]]);
                @let thick = 1.0 + 6.0 * contact.peak_force_n / most;
                @if half > 0.0 {
                    line.face x1=(format!("{x1:.1}")) y1=(format!("{y1:.1}")) x2=(format!("{x2:.1}")) y2=(format!("{y2:.1}")) stroke-width=(format!("{thick:.1}")) {
                        title { "floors " (pair(contact.floors)) ": peak " (format::force(contact.peak_force_n)) }
                    }
                } @else {
                    circle.face cx=(format!("{x1:.1}")) cy=(format!("{y1:.1}")) r="4" {}
                }
            }
        }
    }
}

/// Arrows of the motion and of the one across.
fn motion_marks(page: &Page, height: f64) -> Markup {
    let bearing = page.motion.bearing.as_ref();
    let angle = bearing.map_or(0.0, |bearing| bearing.angle);
    let across = bearing.is_some_and(|bearing| bearing.across.is_some());
    let (x, y) = (MARGIN, height - 34.0);
    let arrow = |angle: f64, name: &str| {
        let (sin, cos) = angle.sin_cos();
        let (tip_x, tip_y) = (x + 30.0 * cos, y - 30.0 * sin);
        html! {
            line.motion x1=(format!("{x:.1}")) y1=(format!("{y:.1}")) x2=(format!("{tip_x:.1}")) y2=(format!("{tip_y:.1}")) {}
            circle.motion cx=(format!("{tip_x:.1}")) cy=(format!("{tip_y:.1}")) r="2.5" {}
            text.quiet x=(format!("{:.1}", tip_x + 6.0)) y=(format!("{:.1}", tip_y + 4.0)) { (name) }
        }
    };
    html! {
        (arrow(angle, "motion"))
        @if across { (arrow(angle + std::f64::consts::FRAC_PI_2, "across")) }
    }
}

/// Building and path.
type CornerPaths = Vec<(usize, Vec<PlanPoint>)>;

/// Paths of the roof corners, exaggerated so that the longest is a given part of the site, and by how much.
fn corner_paths(page: &Page, site: f64) -> Option<(CornerPaths, f64)> {
    let mut all: Vec<(usize, PlanPoint, Vec<PlanPoint>)> = Vec::new();
    for (building, tiers) in tiers(page) {
        let floor = tiers.floors.len();
        let column = |column| page.history.column(column);
        let x = column(Column::Displacement { building, floor })?;
        let y = column(Column::DisplacementAcross { building, floor })?;
        let turn = column(Column::Rotation { building, floor })?;
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

fn pair(floors: [Option<usize>; 2]) -> String {
    let name = |floor: Option<usize>| floor.map_or("–".to_owned(), |floor| floor.to_string());
    format!("{} | {}", name(floors[0]), name(floors[1]))
}

fn faces(page: &Page) -> Markup {
    if page.summary.gaps.is_empty() {
        return html! {};
    }
    html! {
        h3 { "Faces and corners" }
        div.scroll { table {
            thead { tr {
                th scope="col" { "between" } th scope="col" { "floors" } th scope="col" { "kind" }
                th.number scope="col" { "length" br; span.unit { "[m]" } } th.number scope="col" { "gap" br; span.unit { "[mm]" } }
                th.number scope="col" { "normal" } th.number scope="col" { "impacts" }
                th.number scope="col" { "peak force" br; span.unit { "[kN]" } } th.number scope="col" { "centre of pressure" br; span.unit { "[m]" } }
            } }
            tbody {
                @for gap in &page.summary.gaps {
                    @for contact in &gap.contacts {
                        @if let Some(plan) = contact.in_plan {
                            @let hardest = contact.impacts.iter().max_by(|a, b| a.peak_force_n.total_cmp(&b.peak_force_n));
                            @let centre = hardest.and_then(|impact| impact.centre_m);
                            tr {
                                th scope="row" { (gap.between[0]) " ↔ " (gap.between[1]) }
                                td { (pair(contact.floors)) } td { (plan.kind) }
                                td.number { (format::fixed(plan.overlap_m, 2)) } td.number { (format::fixed(contact.width_m * 1e3, 1)) }
                                td.number { (format::fixed(plan.normal[0], 3)) ", " (format::fixed(plan.normal[1], 3)) }
                                td.number { (contact.impact_count) } td.number { (format::fixed(contact.peak_force_n * 1e-3, 1)) }
                                td.number { @match centre { Some([x, y]) => { (format::fixed(x, 2)) ", " (format::fixed(y, 2)) } None => { "–" } } }
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
        h3 { "Peaks across the row and in rotation" }
        div.scroll { table {
            thead { tr {
                th scope="col" { "building" } th.number scope="col" { "floor" }
                th.number scope="col" { "displacement across" br; span.unit { "[mm]" } } th.number scope="col" { "rotation" br; span.unit { "[mrad]" } }
                th.number scope="col" { "corner" br; span.unit { "[mm]" } } th.number scope="col" { "drift across" br; span.unit { "[%]" } }
                th.number scope="col" { "shear across" br; span.unit { "[kN]" } } th.number scope="col" { "torque" br; span.unit { "[kN·m]" } }
                th.number scope="col" { "acceleration across" br; span.unit { "[m/s²]" } }
            } }
            tbody {
                @for building in &page.summary.buildings {
                    @for floor in building.floors.iter().rev() {
                        @if let Some(plan) = floor.in_plan {
                            tr {
                                th scope="row" { (building.name) } td.number { (floor.floor) }
                                td.number { (format::fixed(plan.displacement_across_max_m * 1e3, 1)) " / " (format::fixed(plan.displacement_across_min_m * 1e3, 1)) }
                                td.number { (format::fixed(plan.rotation_max_rad * 1e3, 2)) " / " (format::fixed(plan.rotation_min_rad * 1e3, 2)) }
                                td.number { (format::fixed(plan.corner_displacement_peak_m * 1e3, 1)) }
                                td.number { (format::fixed(plan.storey_drift_across_peak * 100.0, 2)) }
                                td.number { (format::fixed(plan.storey_shear_across_peak_n * 1e-3, 1)) }
                                td.number { (format::fixed(plan.storey_torque_peak_n_m * 1e-3, 0)) }
                                td.number { (format::fixed(plan.total_acceleration_across_peak_m_s2, 2)) }
                            }
                        }
                    }
                }
            }
        } }
        p.quiet { "Drift, shear and torque are those of the storey below the floor; torques are about the centre of mass of the lowest floor." }
    }
}

/// Roof displacements across and rotations over time.
fn histories(page: &Page) -> Markup {
    let Some(times) = page.history.column(Column::Time) else {
        return html! {};
    };
    let lines = |of: fn(usize, usize) -> Column, factor: f64| -> Vec<Line> {
        let line = |(building, tiers): (usize, &Tiers)| {
            let values = page.history.column(of(building, tiers.floors.len()))?;
            let points = times.iter().zip(values);
            Some(Line {
                name: page.model.buildings[building].name.clone(),
                points: points
                    .map(|(time, value)| [*time, factor * value])
                    .collect(),
                colour: building,
                dashed: false,
            })
        };
        tiers(page).filter_map(line).collect()
    };
    let plot = |title: &str, y_label: &str, lines: Vec<Line>| Plot {
        title: title.to_owned(),
        x_label: "time [s]".to_owned(),
        y_label: y_label.to_owned(),
        logarithmic: false,
        aspect: 0.5,
        lines,
    };
    let across = lines(
        |building, floor| Column::DisplacementAcross { building, floor },
        1e3,
    );
    let turns = lines(|building, floor| Column::Rotation { building, floor }, 1e3);
    html! {
        div.static-plots {
            (plot("Roof displacement across", "displacement [mm]", across).figure())
            (plot("Roof rotation", "rotation [mrad]", turns).figure())
        }
    }
}
