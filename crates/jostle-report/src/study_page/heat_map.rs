//! A quantity over two others, as coloured cells.

use maud::{Markup, html};

use super::{Axis, number};

/// A quantity over two others.
#[derive(Clone, Debug, PartialEq)]
pub struct HeatMap {
    /// What the colour says.
    pub value: Axis,
    /// To the right.
    pub x: Axis,
    /// Upwards.
    pub y: Axis,
    /// Places to the right, in order.
    pub columns: Vec<f64>,
    /// Places upwards, in order.
    pub rows: Vec<f64>,
    /// Cells, row by row from the bottom.
    pub cells: Vec<Cell>,
    /// What a cell without a value stands for.
    pub nothing: String,
}

/// One cell.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Cell {
    /// The value, if there is one.
    pub value: Option<f64>,
    /// Cases in it, in words.
    pub cases: String,
    /// The report of one of them.
    pub link: Option<String>,
}

const WIDTH: f64 = 420.0;
const LEFT: f64 = 52.0;
const BOTTOM: f64 = 44.0;
const TOP: f64 = 6.0;
/// Numbers are written into cells at least this wide.
const ROOM: f64 = 30.0;
/// Labels on an axis at most.
const LABELS: usize = 9;

pub(super) fn figure(map: &HeatMap) -> Markup {
    let (nx, ny) = (map.columns.len().max(1), map.rows.len().max(1));
    let cell = ((WIDTH - LEFT - 8.0) / nx as f64).min(90.0);
    let tall = (220.0 / ny as f64).clamp(8.0, 34.0);
    let height = TOP + tall * ny as f64 + BOTTOM;
    let present = || map.cells.iter().filter_map(|cell| cell.value);
    let (low, high) = (
        present().fold(f64::INFINITY, f64::min).min(0.0),
        present().fold(0.0, f64::max),
    );
    let share = |value: f64| {
        if high > low {
            (value - low) / (high - low)
        } else {
            0.0
        }
    };
    let every = |count: usize| count.div_ceil(LABELS).max(1);
    let label = format!("{} over {} and {}", map.value.name, map.x.name, map.y.name);
    html! {
        figure.study-map {
            figcaption { span.chart-title { (map.value.name) } @if !map.value.unit.is_empty() { span.unit { " [" (map.value.unit) "]" } } }
            svg viewBox=(format!("0 0 {WIDTH} {height}")) role="img" aria-label=(label) {
                @for (index, one) in map.cells.iter().enumerate() {
                    @let (column, row) = (index % nx, index / nx);
                    @let (x, y) = (LEFT + cell * column as f64, TOP + tall * (ny - 1 - row) as f64);
                    @let place = format!("{} {} {}, {} {} {}", map.x.name, number(map.columns[column]), map.x.unit, map.y.name, number(map.rows[row]), map.y.unit);
                    @let said = one.value.map_or_else(|| map.nothing.clone(), |value| format!("{} {}", number(value), map.value.unit));
                    @let shade = one.value.map_or(0.0, share);
                    @if let Some(link) = &one.link {
                        a href=(link) { (rect(x, y, [cell, tall], one, shade, true, &format!("{place}: {said} ({})", one.cases))) }
                    } @else {
                        (rect(x, y, [cell, tall], one, shade, false, &format!("{place}: {said} ({})", one.cases)))
                    }
                    @if cell >= ROOM && tall >= 13.0 {
                        @if let Some(value) = one.value {
                            text.study-number.on-dark[shade > 0.5] x=(x + 0.5 * cell) y=(y + 0.5 * tall + 4.0) text-anchor="middle" { (number(value)) }
                        }
                    }
                }
                @for (column, value) in map.columns.iter().enumerate() {
                    @if column % every(nx) == 0 {
                        text x=(LEFT + cell * (column as f64 + 0.5)) y=(height - BOTTOM + 15.0) text-anchor="middle" { (number(*value)) }
                    }
                }
                @for (row, value) in map.rows.iter().enumerate() {
                    @if row % every(ny) == 0 {
                        text x=(LEFT - 6.0) y=(TOP + tall * (ny as f64 - row as f64 - 0.5) + 4.0) text-anchor="end" { (number(*value)) }
                    }
                }
                text x=(LEFT) y=(height - 8.0) { "→ " (map.x.label()) "   ↑ " (map.y.label()) }
            }
        }
    }
}

fn rect(
    x: f64,
    y: f64,
    [width, height]: [f64; 2],
    cell: &Cell,
    shade: f64,
    linked: bool,
    title: &str,
) -> Markup {
    let style = format!("--s:{:.1}%", 100.0 * shade);
    html! {
        rect.study-cell.empty[cell.value.is_none()].linked[linked] x=(x + 0.5) y=(y + 0.5) width=(format!("{:.2}", width - 1.0)) height=(format!("{:.2}", height - 1.0)) style=(style) {
            title { (title) }
        }
    }
}
