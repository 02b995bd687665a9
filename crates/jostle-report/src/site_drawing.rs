//! The site from above: plans with numbered corners, gaps, the direction of shaking and a scale.

use jostle::interface::PlanContactKind;
use jostle::{
    Building, GroundMotion, Model, PlanPoint, SpaceFrame, SpaceMember, SpacePlace, Structure,
    System, Tiers,
};
use maud::{Markup, PreEscaped, html};

use crate::document::colour;
use crate::format;
use crate::message;
use crate::site_places::SitePlace;

/// Width of the drawing, and the margin around the site.
pub(crate) const WIDTH: f64 = 760.0;
const MARGIN: f64 = 46.0;
/// Greatest height of the site in the drawing.
const TALLEST: f64 = 480.0;
/// Height of the strip with axes, motion and scale below it.
const STRIP: f64 = 84.0;
/// Size of a letter: width and height.
const LETTER: [f64; 2] = [7.2, 15.0];
/// Distance of a number from its corner.
const INSIDE: f64 = 19.0;

/// Style of a drawing in a file of its own; on a page the style sheet has it.
pub(crate) const SITE_STYLE: &str = include_str!("../assets/site.css");
/// Colours of buildings on white, as in the style sheet of pages.
const ON_WHITE: [&str; 7] = [
    "#0072b2", "#d55e00", "#00865f", "#b0568a", "#ac591a", "#3f9bd0", "#555b63",
];

/// The buildings with plans, with their indices.
pub(crate) fn tiers(model: &Model) -> impl Iterator<Item = (usize, &Building, &Tiers)> {
    let buildings = model.buildings.iter().enumerate();
    buildings.filter_map(|(index, building)| match &building.structure {
        Structure::Tiers(tiers) => Some((index, building, tiers)),
        _ => None,
    })
}

/// From the site to the drawing: y upwards.
pub(crate) struct Scale {
    from: PlanPoint,
    top: f64,
    /// Units of the drawing in a metre.
    pub(crate) factor: f64,
    height: f64,
}

impl Scale {
    /// That of a model; `None` if no building has a plan.
    pub(crate) fn new(model: &Model) -> Option<Self> {
        let corners = || {
            let plans =
                tiers(model).flat_map(|(.., tiers)| tiers.floors.iter().flat_map(|f| &f.plan));
            plans.chain(
                model
                    .walls
                    .iter()
                    .filter_map(|wall| wall.line.as_ref())
                    .flatten(),
            )
        };
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
        let height = factor * deep + 2.0 * MARGIN + STRIP;
        Some(Self {
            from: [x[0] - (WIDTH / factor - wide) / 2.0, y[0]],
            top: height - MARGIN - STRIP,
            factor,
            height,
        })
    }

    pub(crate) fn place(&self, [x, y]: PlanPoint) -> [f64; 2] {
        [
            (x - self.from[0]) * self.factor,
            self.top - (y - self.from[1]) * self.factor,
        ]
    }

    pub(crate) fn path(&self, points: impl Iterator<Item = PlanPoint>) -> String {
        let list: Vec<String> = points
            .map(|point| {
                let [x, y] = self.place(point);
                format!("{x:.1},{y:.1}")
            })
            .collect();
        list.join(" ")
    }
}

/// The drawing of a model as a file of its own; `None` if no building has a plan. `north`: angle from x to north,
/// counter-clockwise; `None` to draw none \[rad\].
#[must_use]
pub fn site_svg(
    model: &Model,
    system: &System,
    motion: Option<&GroundMotion>,
    north: Option<f64>,
) -> Option<String> {
    let scale = Scale::new(model)?;
    let places = SitePlace::of_system(model, system);
    let style = html! { style { (PreEscaped(without_variables(SITE_STYLE))) } };
    let title = html! { text.title x="14" y="22" { (model.title) } };
    let picture = drawing(
        model,
        &scale,
        &places,
        (motion, north),
        &html! { (style) (title) },
    );
    let mut text = picture.into_string();
    for (number, colour) in ON_WHITE.iter().enumerate() {
        let of_page = format!("--c:var(--c{number})");
        text = text.replace(&of_page, &format!("color:{colour}"));
    }
    // A file of its own names the language of its elements.
    Some(text.replacen("<svg ", "<svg xmlns=\"http://www.w3.org/2000/svg\" ", 1))
}

/// A style sheet with the fallbacks of its variables: many programs that show drawings know no variables.
fn without_variables(style: &str) -> String {
    let mut text = String::new();
    let mut rest = style;
    while let Some((before, after)) = rest.split_once("var(--") {
        text += before;
        let (inner, beyond) = after.split_once(')').unwrap_or((after, ""));
        text += inner.split_once(", ").map_or("", |(_, fallback)| fallback);
        rest = beyond;
    }
    text + rest
}

/// The drawing; `beneath` lies below the marks of faces.
pub(crate) fn drawing(
    model: &Model,
    scale: &Scale,
    places: &[SitePlace],
    (motion, north): (Option<&GroundMotion>, Option<f64>),
    beneath: &Markup,
) -> Markup {
    let height = scale.height;
    let mut taken: Vec<[f64; 4]> = Vec::new();
    let names = names(model, scale, &mut taken);
    let numbers = corner_numbers(model, scale, &mut taken);
    html! {
        svg.site viewBox=(format!("0 0 {WIDTH} {height:.0}")) role="img" aria-label=(message::the_site_from_above_plans()) {
            rect.sheet x="0" y="0" width=(WIDTH) height=(format!("{height:.0}")) {}
            @for (index, _, tiers) in tiers(model) {
                g style=(colour(index)) {
                    @for (floor, tier) in tiers.floors.iter().enumerate() {
                        // Equal floors are drawn once.
                        @if floor == 0 || tiers.floors[floor - 1].plan != tier.plan {
                            polygon.plan points=(scale.path(tier.plan.iter().copied())) {}
                        }
                    }
                    @for frame in &tiers.frames {
                        @let lines = (0..frame.column_lines()).map(|line| frame.line_at(line));
                        polyline.frame points=(scale.path(lines.clone())) { title { (message::frame_name(&frame.name)) } }
                        @for line in lines {
                            @let [x, y] = scale.place(line);
                            rect.column x=(format!("{:.1}", x - 2.5)) y=(format!("{:.1}", y - 2.5)) width="5" height="5" {}
                        }
                        @for wall in frame.frame.walls.iter().filter(|wall| wall.storeys[0] == 1) {
                            @let axis = frame.frame.line_positions()[wall.line - 1];
                            @let ends = [-0.5, 0.5].map(|share| frame.point_at(axis + share * wall.length));
                            polyline.wide points=(scale.path(ends.into_iter())) { title { (message::wall_of_frame(&frame.name)) } }
                        }
                    }
                    @if let Some(frame) = &tiers.space_frame { (grid(frame, scale)) }
                    @for (at, name) in yielding_walls(tiers) {
                        @let [x, y] = scale.place(at);
                        rect.column x=(format!("{:.1}", x - 2.5)) y=(format!("{:.1}", y - 2.5)) width="5" height="5" { title { (message::wall_can_yield(name)) } }
                    }
                    @if let Some(tier) = tiers.floors.first() {
                        @let [x, y] = scale.place(tier.centre);
                        @if let Some(storey) = tiers.initial_storey(0) {
                            @let [sx, sy] = scale.place(storey.centre);
                            rect.stiffness x=(format!("{:.1}", sx - 4.0)) y=(format!("{:.1}", sy - 4.0)) width="8" height="8" { title { (message::centre_of_stiffness()) } }
                        }
                        circle.mass cx=(format!("{x:.1}")) cy=(format!("{y:.1}")) r="3.5" { title { (message::centre_of_mass()) } }
                    }
                }
            }
            @for wall in &model.walls {
                @if let Some(line) = wall.line {
                    polyline.wall points=(scale.path(line.into_iter())) { title { (message::wall_name(&wall.name)) } }
                    path.solid d=(hatching(scale, line)) {}
                }
            }
            (beneath)
            (names)
            (numbers)
            (marks(scale, places))
            (labels(scale, places, &mut taken))
            (strip(scale, motion, north))
        }
    }
}

/// Grid lines of a space frame, and columns and beams of its lowest storey.
fn grid(frame: &SpaceFrame, scale: &Scale) -> Markup {
    let ends = |lines: &[f64]| [lines[0], lines[lines.len() - 1]];
    let ([x0, x1], [y0, y1]) = (ends(&frame.lines_x), ends(&frame.lines_y));
    let of_x = frame
        .lines_x
        .iter()
        .map(|x| ([[*x, y0], [*x, y1]], "x", *x));
    let of_y = frame
        .lines_y
        .iter()
        .map(|y| ([[x0, *y], [x1, *y]], "y", *y));
    let numbered = of_x.enumerate().chain(of_y.enumerate());
    let path = |points: &[PlanPoint]| {
        let on_site = points.iter().map(|point| frame.on_site(*point));
        scale.path(on_site)
    };
    let lowest = || {
        frame
            .members
            .iter()
            .filter(|member| member.place.storey() == 0)
    };
    let at = |[x, y]: [usize; 2]| [frame.lines_x[x], frame.lines_y[y]];
    let column = |member: &SpaceMember| {
        let [x, y] = at(member.place.crossings()[0]);
        let [a, b] = member.section.size.map(|side| 0.5 * side);
        path(&[
            [x - a, y - b],
            [x + a, y - b],
            [x + a, y + b],
            [x - a, y + b],
        ])
    };
    let is_column = |member: &SpaceMember| matches!(member.place, SpacePlace::Column { .. });
    html! {
        @for (number, (line, name, place)) in numbered {
            polyline.axis stroke-dasharray="6 3 1 3" points=(path(&line)) { title { (message::grid_line(name, number + 1, format::plain(format::HEIGHT.of(place), 4))) } }
        }
        @for own in lowest() {
            @if is_column(own) {
                polygon.column points=(column(own)) {}
            } @else {
                polyline.frame points=(path(&own.place.crossings().map(at))) {}
            }
        }
    }
}

/// Places and names of the columns and walls of the lowest storey that can yield.
fn yielding_walls(tiers: &Tiers) -> Vec<([f64; 2], String)> {
    let lowest = tiers.yielding.iter().filter(|spring| spring.storey == 0);
    let mut walls: Vec<(usize, [f64; 2])> = lowest
        .filter_map(|spring| Some((spring.element?, spring.at)))
        .collect();
    walls.dedup_by_key(|(element, _)| *element);
    let named = walls.into_iter().map(|(element, at)| {
        let name = tiers.element_names.get(element).cloned().flatten();
        (
            at,
            name.unwrap_or_else(|| message::element_number(element + 1)),
        )
    });
    named.collect()
}

/// The box of a text with its anchor in the middle.
pub(crate) fn box_of(text: &str, [x, y]: [f64; 2]) -> [f64; 4] {
    let half = 0.5 * LETTER[0] * text.chars().count() as f64 + 2.0;
    [x - half, y - 0.5 * LETTER[1], x + half, y + 0.5 * LETTER[1]]
}

fn overlaps(a: &[f64; 4], b: &[f64; 4]) -> bool {
    a[0] < b[2] && b[0] < a[2] && a[1] < b[3] && b[1] < a[3]
}

/// A text with its middle at a point.
fn centred(class: &str, text: &str, [x, y]: [f64; 2]) -> Markup {
    html! { text class=(class) x=(format!("{x:.1}")) y=(format!("{:.1}", y + 4.5)) text-anchor="middle" { (text) } }
}

/// Names of the buildings, beside their centres of mass.
fn names(model: &Model, scale: &Scale, taken: &mut Vec<[f64; 4]>) -> Markup {
    let all = tiers(model).filter_map(|(index, building, tiers)| {
        let floors = tiers.floors.len();
        let words = format!(
            "{}, {floors} {}",
            building.name,
            if floors == 1 {
                message::floor()
            } else {
                message::floors()
            }
        );
        let [x, y] = scale.place(tiers.floors.first()?.centre);
        // Frames at lines of the plan have no centre of stiffness of their own.
        let sy = tiers
            .initial_storey(0)
            .map_or(y, |storey| scale.place(storey.centre)[1]);
        // Away from the centre of stiffness.
        let at = [x, if sy > y { y - 16.0 } else { y + 18.0 }];
        taken.push(box_of(&words, at));
        Some(html! { g style=(colour(index)) { (centred("building-name", &words, at)) } })
    });
    let all: Vec<Markup> = all.collect();
    html! { @for name in &all { (name) } }
}

/// Numbers of the corners of the lowest floors, inside of them.
fn corner_numbers(model: &Model, scale: &Scale, taken: &mut Vec<[f64; 4]>) -> Markup {
    let mut all: Vec<Markup> = Vec::new();
    for (index, _, tiers) in tiers(model) {
        let Some(floor) = tiers.floors.first() else {
            continue;
        };
        let plan: Vec<[f64; 2]> = floor.plan.iter().map(|p| scale.place(*p)).collect();
        let count = plan.len();
        for (corner, at) in plan.iter().enumerate() {
            let away = |other: [f64; 2]| {
                let d = [other[0] - at[0], other[1] - at[1]];
                let length = d[0].hypot(d[1]).max(1e-9);
                d.map(|value| value / length)
            };
            let (before, after) = (
                plan[(corner + count - 1) % count],
                plan[(corner + 1) % count],
            );
            let (a, b) = (away(before), away(after));
            // The bisector points inside at convex corners and outside at others; the picture turns y round.
            let turn = a[0] * b[1] - a[1] * b[0];
            let sign = if turn > 0.0 { 1.0 } else { -1.0 };
            let sum = [a[0] + b[0], a[1] + b[1]];
            let length = sum[0].hypot(sum[1]);
            let inward = if length > 1e-6 {
                sum.map(|value| sign * value / length)
            } else {
                [-a[1], a[0]]
            };
            let place = [at[0] + INSIDE * inward[0], at[1] + INSIDE * inward[1]];
            let words = (corner + 1).to_string();
            taken.push(box_of(&words, place));
            all.push(
                html! { g style=(colour(index)) { (centred("corner-number", &words, place)) } },
            );
        }
    }
    html! { @for number in &all { (number) } }
}

/// Faces as bars, as thick as their greatest force, with their normals; corners as dots.
fn marks(scale: &Scale, places: &[SitePlace]) -> Markup {
    let most = places
        .iter()
        .map(|place| place.peak_force)
        .fold(0.0, f64::max);
    let slips = places.iter().filter_map(|place| place.slip);
    let longest = slips.fold(0.0, f64::max);
    html! {
        @for place in places {
            @let half = 0.5 * place.overlap;
            @let along = [-place.normal[1] * half, place.normal[0] * half];
            @let [x1, y1] = scale.place([place.middle[0] - along[0], place.middle[1] - along[1]]);
            @let [x2, y2] = scale.place([place.middle[0] + along[0], place.middle[1] + along[1]]);
            @let [x, y] = scale.place(place.middle);
            @let tip = [x + 15.0 * place.normal[0], y - 15.0 * place.normal[1]];
            @let share = if most > 0.0 { place.peak_force / most } else { 0.4 };
            g {
                title { (message::floors_floors_in_words(place.floors_in_words())) @if place.peak_force > 0.0 { (message::peak_peak_force(format::force(place.peak_force))) } }
                (arrow("normal", [x, y], tip))
                @if let Some(slip) = place.slip.filter(|slip| *slip > 0.0) { (slipped(place, [x, y], slip / longest)) }
                @match place.kind {
                    PlanContactKind::Face | PlanContactKind::Column => {
                        line.face x1=(format!("{x1:.1}")) y1=(format!("{y1:.1}")) x2=(format!("{x2:.1}")) y2=(format!("{y2:.1}")) stroke-width=(format!("{:.1}", 2.0 + 5.0 * share)) {}
                    }
                    PlanContactKind::Corner => {
                        circle.face cx=(format!("{x:.1}")) cy=(format!("{y:.1}")) r=(format!("{:.1}", 3.0 + 2.5 * share)) {}
                    }
                }
            }
        }
    }
}

/// Strokes on the solid side of a wall, the right one of its direction.
fn hatching(scale: &Scale, line: [PlanPoint; 2]) -> String {
    let [from, to] = line.map(|point| scale.place(point));
    let [dx, dy] = [to[0] - from[0], to[1] - from[1]];
    let length = dx.hypot(dy).max(1e-9);
    // The drawing counts y downwards.
    let [tx, ty] = [dx / length, dy / length];
    let [rx, ry] = [-ty, tx];
    let count = (length / HATCH) as usize;
    let strokes = (0..count).map(|index| {
        let along = (index as f64 + 0.75) * HATCH;
        format!(
            "M{:.1} {:.1}l{:.1} {:.1}",
            from[0] + along * tx,
            from[1] + along * ty,
            0.6 * HATCH * (rx - tx),
            0.6 * HATCH * (ry - ty)
        )
    });
    strokes.collect()
}

/// Slip in both directions along a face, beside it on the side of the second building.
fn slipped(place: &SitePlace, [x, y]: [f64; 2], share: f64) -> Markup {
    let [nx, ny] = [place.normal[0], -place.normal[1]];
    let [tx, ty] = [ny, -nx];
    let from = [x + SLIP_BESIDE * nx, y + SLIP_BESIDE * ny];
    let reach = SLIP_LEAST + SLIP_MORE * share;
    html! {
        (arrow("slip", from, [from[0] + reach * tx, from[1] + reach * ty]))
        (arrow("slip", from, [from[0] - reach * tx, from[1] - reach * ty]))
    }
}

/// Number and gap of every place, where nothing else is written.
fn labels(scale: &Scale, places: &[SitePlace], taken: &mut Vec<[f64; 4]>) -> Markup {
    let mut all: Vec<Markup> = Vec::new();
    for (index, place) in places.iter().enumerate() {
        let mut words = format!("{}: {}", index + 1, place.gap_in_words());
        if let Some(slip) = place.slip {
            words += &message::and_slip(format::millimetres(slip));
        }
        let [x, y] = scale.place(place.middle);
        let [nx, ny] = [place.normal[0], -place.normal[1]];
        let half = 0.5 * LETTER[0] * words.chars().count() as f64 + 4.0;
        // Farther away than the arrows of slip.
        let beside = place.slip.map_or(0.0, |_| 12.0);
        let tries = [1.0, -1.0].into_iter().flat_map(|side| {
            (0..9).map(move |k| {
                // Along the face, alternately to either side.
                let slide = 16.0 * f64::from((k + 1) / 2) * if k % 2 == 0 { 1.0 } else { -1.0 };
                let away = side * ((24.0 + beside) * ny.abs() + (half + 20.0 + beside) * nx.abs());
                [x + away * nx - slide * ny, y + away * ny + slide * nx]
            })
        });
        let inside = |b: &[f64; 4]| b[0] > 2.0 && b[2] < WIDTH - 2.0 && b[1] > 28.0;
        let free = |at: &[f64; 2]| {
            let rectangle = box_of(&words, *at);
            inside(&rectangle) && !taken.iter().any(|other| overlaps(&rectangle, other))
        };
        let tries: Vec<[f64; 2]> = tries.collect();
        let at = tries
            .iter()
            .copied()
            .find(|at| free(at))
            .unwrap_or(tries[0]);
        taken.push(box_of(&words, at));
        all.push(centred("gap-label", &words, at));
    }
    html! { @for label in &all { (label) } }
}

/// An arrow with a head.
fn arrow(class: &str, from: [f64; 2], to: [f64; 2]) -> Markup {
    let d = [to[0] - from[0], to[1] - from[1]];
    let length = d[0].hypot(d[1]).max(1e-9);
    let u = d.map(|value| value / length);
    let back = [to[0] - 7.0 * u[0], to[1] - 7.0 * u[1]];
    let wing = [-3.2 * u[1], 3.2 * u[0]];
    let head = format!(
        "{:.1},{:.1} {:.1},{:.1} {:.1},{:.1}",
        to[0],
        to[1],
        back[0] + wing[0],
        back[1] + wing[1],
        back[0] - wing[0],
        back[1] - wing[1]
    );
    html! {
        line class=(class) x1=(format!("{:.1}", from[0])) y1=(format!("{:.1}", from[1])) x2=(format!("{:.1}", back[0])) y2=(format!("{:.1}", back[1])) {}
        polygon class=(class) points=(head) {}
    }
}

/// Axes, direction of the motion and of the one across, and the scale.
fn strip(scale: &Scale, motion: Option<&GroundMotion>, north: Option<f64>) -> Markup {
    let base = scale.height - 26.0;
    let axes = [42.0, base];
    html! {
        (arrow("axis", axes, [axes[0] + 38.0, axes[1]]))
        (arrow("axis", axes, [axes[0], axes[1] - 38.0]))
        text.axis-name x=(format!("{:.1}", axes[0] + 43.0)) y=(format!("{:.1}", axes[1] + 4.0)) { "x" }
        text.axis-name x=(format!("{:.1}", axes[0] - 3.0)) y=(format!("{:.1}", axes[1] - 43.0)) { "y" }
        @if let Some(motion) = motion { (shaking(motion, north, [200.0, base - 16.0])) }
        @if let Some(north) = north { (north_arrow(north, [118.0, base - 16.0])) }
        (scale_bar(scale, base))
    }
}

/// Arrows of slip: distance from the face, least length, and that of the greatest slip beyond it.
const SLIP_BESIDE: f64 = 20.0;
const SLIP_LEAST: f64 = 9.0;
const SLIP_MORE: f64 = 30.0;
/// Distance of the strokes on the solid side of a wall.
const HATCH: f64 = 11.0;
/// Half the length of the arrow to north.
const NORTH: f64 = 20.0;
/// Length of the arrows of the motion.
const SHAKING: f64 = 30.0;

/// An arrow to north, with its letter.
fn north_arrow(north: f64, [x, y]: [f64; 2]) -> Markup {
    let (sin, cos) = north.sin_cos();
    let end = |length: f64| [x + length * cos, y - length * sin];
    let letter = end(NORTH + 11.0);
    html! {
        (arrow("north", end(-NORTH), end(NORTH)))
        text.north-name x=(format!("{:.1}", letter[0])) y=(format!("{:.1}", letter[1] + 4.5)) text-anchor="middle" { (message::letter_of_north()) }
    }
}

/// Compass bearing of a direction, clockwise from north, 0 to 360; both angles counter-clockwise from x \[°\].
pub(crate) fn compass_bearing(angle: f64, north: f64) -> f64 {
    let bearing = (north - angle).rem_euclid(360.0);
    // What rounding makes of a direction just left of north.
    if bearing > 360.0 - 1e-6 { 0.0 } else { bearing }
}

fn shaking(motion: &GroundMotion, north: Option<f64>, [x, y]: [f64; 2]) -> Markup {
    let angle = motion.bearing.as_ref().map_or(0.0, |bearing| bearing.angle);
    let has_across = motion.across().is_some();
    let tip = |angle: f64| {
        let (sin, cos) = angle.sin_cos();
        [x + SHAKING * cos, y - SHAKING * sin]
    };
    let back = |angle: f64| {
        let [tx, ty] = tip(angle);
        [2.0 * x - tx, 2.0 * y - ty]
    };
    let across = angle + std::f64::consts::FRAC_PI_2;
    let degrees = format::plain((angle.to_degrees() * 1e6).round() / 1e6, 4);
    html! {
        @if has_across { (arrow("across", back(across), tip(across))) }
        (arrow("motion", back(angle), tip(angle)))
        text.motion-name x=(format!("{:.1}", x + SHAKING + 16.0)) y=(format!("{:.1}", y - 2.0)) { (shaking_in_words(angle, north, &degrees, &motion.name)) }
        @if let Some(other) = motion.across() {
            text.across-name x=(format!("{:.1}", x + SHAKING + 16.0)) y=(format!("{:.1}", y + 15.0)) { (message::across_it_thin(&other.name)) }
        }
    }
}

fn shaking_in_words(angle: f64, north: Option<f64>, degrees: &str, name: &str) -> String {
    let Some(north) = north else {
        return message::shaking_at_from_x(degrees, name);
    };
    let bearing = compass_bearing(angle.to_degrees(), north.to_degrees());
    message::shaking_at_with_bearing(degrees, format::plain(bearing, 4), name)
}

/// A round number of metres or feet, about a seventh of the drawing.
fn scale_bar(scale: &Scale, base: f64) -> Markup {
    let unit = scale.factor * format::HEIGHT.size();
    let rough = WIDTH / unit / 7.0;
    let power = 10f64.powf(rough.log10().floor());
    let steps = [5.0, 2.0, 1.0].map(|step| step * power);
    let shown = steps.into_iter().find(|step| *step <= rough);
    let shown = shown.unwrap_or(power);
    let length = shown * unit;
    let from = WIDTH - 30.0 - length;
    let half = 0.5 * length;
    html! {
        rect.bar-dark x=(format!("{from:.1}")) y=(format!("{:.1}", base - 3.0)) width=(format!("{half:.1}")) height="6" {}
        rect.bar-light x=(format!("{:.1}", from + half)) y=(format!("{:.1}", base - 3.0)) width=(format!("{half:.1}")) height="6" {}
        text.axis-name x=(format!("{from:.1}")) y=(format!("{:.1}", base - 8.0)) text-anchor="middle" { "0" }
        text.axis-name x=(format!("{:.1}", from + length)) y=(format!("{:.1}", base - 8.0)) text-anchor="middle" { (format::plain(shown, 3)) " " (format::HEIGHT.name()) }
    }
}
