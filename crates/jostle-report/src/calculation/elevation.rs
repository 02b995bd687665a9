//! The buildings drawn to scale, with heights, spans and gaps.

use jostle::SpaceFrame;
use jostle::model::{Building, Structure};
use maud::{Markup, html};

use crate::drawn_members::{DiagonalData, MemberData, SeenAcross};
use crate::message;
use crate::static_plot::colour;
use crate::walls::{SceneWall, stands_on_site, walls};
use crate::{Page, format};

/// Size of the drawing, and room for dimensions around it.
const WIDTH: f64 = 760.0;
const TALLEST: f64 = 400.0;
const BELOW: f64 = 46.0;
const ABOVE: f64 = 20.0;
/// Room for the heights beside a building.
const BESIDE: f64 = 34.0;
/// Height of bearings as drawn, free space beside a mat, width of walls.
const PIT: f64 = 14.0;
const FREE: f64 = 7.0;
const WALL: f64 = 8.0;
/// Width of a building without spans, as a part of its height, and its least width \[m\].
const SLENDERNESS: f64 = 0.3;
const LEAST_WIDTH: f64 = 3.0;
/// Most runs of equal storeys whose heights are written.
const LISTED: usize = 30;

/// Column lines of a building from its left edge, and heights of its floors and of its base above the lowest base \[m\].
struct Outline {
    lines: Vec<f64>,
    floors: Vec<f64>,
    foot: f64,
    /// Storeys with a column from 1, by line, and the first and the last line of every floor.
    columns: Vec<Vec<usize>>,
    outer: Vec<[usize; 2]>,
}

impl Outline {
    /// `low`: elevation of the lowest base \[m\].
    fn new(building: &Building, low: f64) -> Self {
        let floors = building.floor_heights();
        let height = floors.last().copied().unwrap_or(0.0);
        let lines = match &building.structure {
            Structure::Frame(frame) => frame.line_positions(),
            Structure::Tiers(tiers) => SeenAcross::new(tiers).lines,
            Structure::Shear(_) | Structure::Given(_) => {
                vec![0.0, (SLENDERNESS * height).max(LEAST_WIDTH)]
            }
        };
        let (columns, outer) = match &building.structure {
            Structure::Frame(frame) => {
                let floors = 1..=floors.len();
                let outer = floors.map(|floor| frame.outer_lines(floor).unwrap_or_default());
                (frame.storeys_of_lines(), outer.collect())
            }
            Structure::Tiers(tiers) => {
                let seen = SeenAcross::new(tiers);
                let outer = seen.outer(floors.len());
                (seen.storeys, outer)
            }
            _ => (Vec::new(), Vec::new()),
        };
        let foot = building.base.elevation - low;
        Self {
            lines,
            floors: floors.into_iter().map(|floor| floor + foot).collect(),
            foot,
            columns,
            outer,
        }
    }

    fn width(&self) -> f64 {
        self.lines.last().copied().unwrap_or(0.0)
    }

    fn height(&self) -> f64 {
        self.floors.last().copied().unwrap_or(0.0)
    }
}

/// The figure. Gaps are drawn wide enough to be seen; their width is written.
pub(super) fn figure(page: &Page) -> Markup {
    let model = page.model;
    let isolated = |building: &Building| building.base.isolation.is_some();
    let pit = if model.buildings.iter().any(isolated) {
        PIT
    } else {
        0.0
    };
    let elevations = model
        .buildings
        .iter()
        .map(|building| building.base.elevation);
    let low = elevations.fold(f64::INFINITY, f64::min);
    let outlines = model
        .buildings
        .iter()
        .map(|building| Outline::new(building, low));
    let outlines: Vec<Outline> = outlines.collect();
    let walls = walls(page).into_iter().filter(|wall| !wall.on_site);
    let walls: Vec<SceneWall> = walls.collect();
    let count = outlines.len() as f64;
    let wide: f64 = outlines.iter().map(Outline::width).sum();
    let high = outlines.iter().map(Outline::height).fold(0.0, f64::max);
    if !(wide > 0.0 && high > 0.0) {
        return html! {};
    }
    let room = WIDTH - count * BESIDE - 30.0;
    let scale = (room / wide).min(TALLEST / high);
    let ground = ABOVE + scale * high;
    let height = ground + BELOW + pit;
    let used = scale * wide + count * BESIDE;
    let mut left = 0.5 * (WIDTH - used);
    let mut places = Vec::new();
    for outline in &outlines {
        left += BESIDE;
        places.push(left);
        left += scale * outline.width();
    }
    html! {
        @let dimensions = message::elevation_to_scale_dimensions(match format::units() {
            format::Units::Si => message::in_metres(),
            format::Units::Us => message::in_feet(),
        });
        figure.static-plot.elevation {
            figcaption { span.chart-title { (dimensions) } }
            svg viewBox=(format!("0 0 {WIDTH} {height:.0}")) role="img" aria-label=(dimensions) {
                path.ground d=(surface(&outlines, &places, low, [scale, ground])) fill="none" {}
                @for (index, (outline, left)) in outlines.iter().zip(&places).enumerate() {
                    @let own = ground - scale * outline.foot;
                    @if isolated(&model.buildings[index]) {
                        (bearings(index, *left, scale * outline.width(), own))
                    }
                    // Heights are written outside a wall that stands before the building.
                    @let walled = walls.iter().any(|wall| wall.beside == [None, Some(index)]);
                    @let beside = if walled { FREE + WALL } else { 0.0 };
                    (drawing(&model.buildings[index], index, outline, [*left, beside], [scale, ground, pit]))
                }
                @for wall in &walls {
                    (wall_mark(wall, model.buildings.iter().map(isolated).collect(), &outlines, &places, [scale, ground, low]))
                }
                @for (summary, link) in page.links() {
                    @for floor in &summary.floors {
                        (link_mark(link.between, floor.height_m - low, &outlines, &places, [scale, ground]))
                    }
                }
                @for (between, widths) in gaps_of_pairs(model) {
                    (gap_mark(between, &widths, &outlines, &places, scale, ground + pit))
                }
            }
        }
    }
}

/// The surface of the ground: the datum of elevations, down to the foundation below a building that reaches deeper, and as high
/// as the foundation around one that stands higher.
fn surface(outlines: &[Outline], places: &[f64], low: f64, [scale, ground]: [f64; 2]) -> String {
    let street = |outline: &Outline| ground - scale * outline.foot.max(-low);
    let mut path = String::new();
    let mut before = None;
    for (outline, left) in outlines.iter().zip(places) {
        let right = left + scale * outline.width();
        let level = street(outline);
        match before {
            None => path += &format!("M8,{level:.1}"),
            Some(end) => path += &format!("H{:.1}V{level:.1}", 0.5 * (end + left)),
        }
        let foot = ground - scale * outline.foot;
        path += &format!("H{left:.1}V{foot:.1}H{right:.1}V{level:.1}");
        before = Some(right);
    }
    path + &format!("H{:.1}", WIDTH - 8.0)
}

/// A mat on bearings in a pit.
fn bearings(index: usize, left: f64, width: f64, ground: f64) -> Markup {
    let (from, to) = (left - FREE, left + width + FREE);
    let half = (0.1 * width).min(6.0);
    let places = [left + half, left + 0.5 * width, left + width - half];
    let pit = format!("M{from:.1},{ground:.1}v{PIT}H{to:.1}v-{PIT}");
    let pads = places.map(|x| {
        format!(
            "M{:.1},{:.1}v-{PIT}h{:.1}v{PIT}z",
            x - half,
            ground + PIT,
            2.0 * half
        )
    });
    html! {
        rect.pit x=(round(from)) y=(round(ground - 1.0)) width=(round(to - from)) height=(round(PIT + 1.0)) {}
        path.ground d=(pit) {}
        g style=(colour(index)) {
            path.bearings d=(pads.concat()) {}
            line.slabs x1=(round(left)) x2=(round(left + width)) y1=(round(ground)) y2=(round(ground)) {}
        }
    }
}

/// A wall, up to its highest contact.
fn wall_mark(
    wall: &SceneWall,
    isolated: Vec<bool>,
    outlines: &[Outline],
    places: &[f64],
    [scale, ground, low]: [f64; 3],
) -> Markup {
    let [left, right] = wall.beside;
    let from = match (left, right) {
        (Some(left), _) => places[left] + scale * outlines[left].width() + FREE,
        (None, Some(right)) => places[right] - FREE - WALL,
        (None, None) => return html! {},
    };
    let beside = [left, right].into_iter().flatten();
    let foot = |index: usize| {
        let pit = if isolated[index] { PIT } else { 0.0 };
        ground - scale * outlines[index].foot + pit
    };
    let bottom = beside.map(foot).fold(f64::NEG_INFINITY, f64::max);
    let top = ground - scale * (wall.top - low) - 5.0;
    html! {
        rect.wall x=(round(from)) y=(round(top)) width=(WALL) height=(round(bottom - top)) {}
    }
}

fn drawing(
    building: &Building,
    index: usize,
    outline: &Outline,
    [left, beside]: [f64; 2],
    [scale, ground, pit]: [f64; 3],
) -> Markup {
    let is_frame = matches!(building.structure, Structure::Frame(_));
    let y = |height: f64| ground - scale * height;
    let x = |across: f64| left + scale * across;
    let (right, top) = (x(outline.width()), y(outline.height()));
    let middle = 0.5 * (left + right);
    // Equal storeys above each other: how many, their height, and where they begin and end.
    let mut runs: Vec<(usize, f64, [f64; 2])> = Vec::new();
    let mut below = outline.foot;
    for floor in &outline.floors {
        let storey = floor - below;
        match runs.last_mut() {
            Some((count, height, [_, end])) if (*height - storey).abs() < 1e-9 => {
                *count += 1;
                *end = *floor;
            }
            _ => runs.push((1, storey, [below, *floor])),
        }
        below = *floor;
    }
    if runs.len() > LISTED {
        runs.clear();
    }
    let written = runs.iter().map(|&(count, height, [from, to])| {
        let height = format::plain(format::HEIGHT.of(height), 4);
        // A lone 6 or 9 can be read upside down.
        let height = match height.contains('.') {
            true => height,
            false => format!("{height}.0"),
        };
        let text = match count {
            1 => height,
            _ => format!("{count} × {height}"),
        };
        (text, 0.5 * (from + to))
    });
    let written: Vec<(String, f64)> = written.collect();
    html! {
        g style=(colour(index)) {
            @if let Structure::Frame(frame) = &building.structure {
                @for wall in &frame.walls {
                    @let ([first, last], axis) = (wall.storeys, outline.lines[wall.line - 1]);
                    @let foot = first.checked_sub(2).map_or(outline.foot, |floor| outline.floors[floor]);
                    @let [up, down] = [outline.floors[last - 1], foot].map(y);
                    rect.shear-wall x=(round(x(axis - 0.5 * wall.length))) y=(round(up)) width=(round(scale * wall.length)) height=(round(down - up)) {}
                }
                @for own in &frame.diagonals {
                    @let ([from, to], [low, high]) = (own.place.lines(), own.place.floors());
                    @let ends = [(outline.lines[from], low), (outline.lines[to], high)].map(|(line, level)| {
                        let height = level.checked_sub(1).map_or(outline.foot, |floor| outline.floors[floor]);
                        [x(line), y(height)]
                    });
                    line.(own.place.kind.name()) x1=(round(ends[0][0])) x2=(round(ends[1][0])) y1=(round(ends[0][1])) y2=(round(ends[1][1])) {}
                }
                @for (line, storeys) in outline.lines.iter().zip(&outline.columns) {
                    @for run in storeys.chunk_by(|below, above| below + 1 == *above) {
                        @let foot = run[0].checked_sub(2).map_or(outline.foot, |floor| outline.floors[floor]);
                        @let top = outline.floors[run[run.len() - 1] - 1];
                        line.columns x1=(round(x(*line))) x2=(round(x(*line))) y1=(round(y(foot))) y2=(round(y(top))) {}
                    }
                }
                @for (floor, outer) in outline.floors.iter().zip(&outline.outer) {
                    @let [from, to] = outer.map(|line| x(outline.lines[line]));
                    line.beams x1=(round(from)) x2=(round(to)) y1=(round(y(*floor))) y2=(round(y(*floor))) {}
                }
            } @else if let Structure::Tiers(tiers) = &building.structure && let Some(frame) = &tiers.space_frame {
                (in_space(frame, tiers.extent_along()[0], outline, [left, scale, ground]))
            } @else {
                line.columns x1=(round(middle)) x2=(round(middle)) y1=(round(y(outline.foot))) y2=(round(top)) {}
                @for (level, floor) in outline.floors.iter().enumerate() {
                    @let [from, to] = outline.outer.get(level).map_or([left, right], |outer| outer.map(|line| x(outline.lines[line])));
                    line.slabs x1=(round(from)) x2=(round(to)) y1=(round(y(*floor))) y2=(round(y(*floor))) {}
                }
            }
        }
        @if let Some(foundation) = &building.base.foundation {
            @let half = 0.5 * scale * foundation.length;
            rect.footing x=(round(middle - half)) y=(round(y(outline.foot))) width=(round(2.0 * half)) height="5" {}
        }
        text.name x=(round(middle)) y=(round(top - 7.0)) text-anchor="middle" { (building.name) }
        @for (text, at) in &written {
            text transform=(format!("translate({:.1} {:.1}) rotate(-90)", left - beside - 9.0, y(*at))) text-anchor="middle" { (text) }
        }
        @if is_frame {
            @for pair in outline.lines.windows(2) {
                text x=(round(0.5 * (x(pair[0]) + x(pair[1])))) y=(round(ground + pit + 15.0)) text-anchor="middle" { (format::plain(format::HEIGHT.of(pair[1] - pair[0]), 4)) }
            }
        }
        text x=(round(middle)) y=(round(ground + pit + 30.0)) text-anchor="middle" { "H = " (format::plain(format::HEIGHT.of(outline.height() - outline.foot), 4)) }
    }
}

/// A space frame seen across the row: walls, panels, braces, columns and beams of all its frames, one behind the other.
fn in_space(
    frame: &SpaceFrame,
    from: f64,
    outline: &Outline,
    [left, scale, ground]: [f64; 3],
) -> Markup {
    let x = |across: f64| left + scale * (across - from);
    let level = |floors: usize| match floors.checked_sub(1) {
        Some(floor) => outline.floors.get(floor).copied().unwrap_or_default(),
        None => outline.foot,
    };
    let y = |floors: usize| ground - scale * level(floors);
    let members = MemberData::all_of(frame);
    let diagonals = frame.diagonals.iter();
    let diagonals = diagonals.map(|diagonal| DiagonalData::in_space(frame, diagonal));
    let ends_of = |member: &MemberData| {
        let floors = member
            .floors
            .map(|floor| floor.map_or(0, |floor| floor + 1));
        [0, 1].map(|end| [x(member.ends[end][0]), y(floors[end])])
    };
    html! {
        @for (member, half) in members.iter().filter_map(|member| Some((member, member.wall?[0].abs()))) {
            @let [[foot, below], [_, above]] = ends_of(member);
            // A wall across the row is seen from its end.
            @let half = (scale * half).max(2.0);
            rect.shear-wall x=(round(foot - half)) y=(round(above)) width=(round(2.0 * half)) height=(round(below - above)) {}
        }
        @for diagonal in diagonals {
            @if let Some([low, high]) = diagonal.ends {
                line.infill[diagonal.infill].brace[!diagonal.infill] x1=(round(x(low[0]))) x2=(round(x(high[0]))) y1=(round(y(diagonal.floors()[0]))) y2=(round(y(diagonal.floors()[1]))) {}
            }
        }
        @for member in members.iter().filter(|member| member.wall.is_none()) {
            @let [[x1, y1], [x2, y2]] = ends_of(member);
            line.columns[member.floors[0] != member.floors[1]].beams[member.floors[0] == member.floors[1]] x1=(round(x1)) x2=(round(x2)) y1=(round(y1)) y2=(round(y2)) {}
        }
    }
}

/// Whether both sides of a gap stand in the row of buildings.
fn in_a_row(model: &jostle::model::Model, gap: &jostle::Gap) -> bool {
    let sides = gap.between.into_iter().flatten();
    !sides.into_iter().any(|side| stands_on_site(model, side))
}

/// Pairs of neighbours with the least widths of the gaps between them, which share a label \[m\].
fn gaps_of_pairs(model: &jostle::model::Model) -> Vec<([Option<usize>; 2], Vec<f64>)> {
    let mut pairs: Vec<([Option<usize>; 2], Vec<f64>)> = Vec::new();
    for gap in model.gaps.iter().filter(|gap| in_a_row(model, gap)) {
        match pairs
            .iter_mut()
            .find(|(between, _)| *between == gap.between)
        {
            Some((_, widths)) => widths.push(gap.width()),
            None => pairs.push((gap.between, vec![gap.width()])),
        }
    }
    pairs
}

/// A link between two neighbours: a line with a pot half way.
fn link_mark(
    between: [Option<usize>; 2],
    height: f64,
    outlines: &[Outline],
    places: &[f64],
    [scale, ground]: [f64; 2],
) -> Markup {
    let side = |side: usize| {
        let building = between[side].filter(|index| *index < outlines.len())?;
        let outline = &outlines[building];
        let above = outline.floors.iter();
        let floor = above.take_while(|floor| **floor < height - 1e-6).count();
        let outer = outline.outer.get(floor);
        let lines = outer.copied().unwrap_or([0, outline.lines.len() - 1]);
        Some(places[building] + scale * outline.lines[lines[1 - side]])
    };
    let wall = |from: f64, sign: f64| from + sign * FREE;
    let [left, right] = match [side(0), side(1)] {
        _ if between[0] == between[1] => return html! {},
        [Some(left), Some(right)] => [left, right],
        [Some(left), None] => [left, wall(left, 1.0)],
        [None, Some(right)] => [wall(right, -1.0), right],
        [None, None] => return html! {},
    };
    let (y, middle) = (ground - scale * height, 0.5 * (left + right));
    html! {
        path.link d=(format!("M{left:.1},{y:.1}H{:.1}m0,-3v6M{:.1},{:.1}h-5m0,6h5M{:.1},{:.1}v6M{middle:.1},{y:.1}H{right:.1}", middle - 2.0, middle + 3.0, y - 3.0, middle + 3.0, y - 3.0)) {}
    }
}

/// The widths of the gaps of a pair, below it.
fn gap_mark(
    between: [Option<usize>; 2],
    widths: &[f64],
    outlines: &[Outline],
    places: &[f64],
    scale: f64,
    ground: f64,
) -> Markup {
    let [left, right] = between.map(|side| side.filter(|index| *index < outlines.len()));
    let at = match (left, right) {
        (Some(left), _) => places[left] + scale * outlines[left].width() + 0.5 * BESIDE,
        (None, Some(right)) => places[right] - 0.5 * BESIDE,
        (None, None) => return html! {},
    };
    let written = widths.iter().map(|width| format::millimetres(*width));
    let written: Vec<String> = written.collect();
    let text = match &written[..] {
        [width] => message::gap_width(width),
        several => message::gaps_of_widths(several.join(", ")),
    };
    html! {
        text x=(round(at)) y=(round(ground + 43.0)) text-anchor="middle" { (text) }
    }
}

fn round(value: f64) -> String {
    format!("{value:.1}")
}
