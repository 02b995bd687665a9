//! Heat map: a quantity over two others.

use maud::{Markup, html};

use super::{Axis, number};
use crate::scale::Scale;
use crate::{format, message};

/// A quantity over two others.
#[derive(Clone, Debug, PartialEq)]
pub struct HeatMap {
    /// Quantity shown by colour.
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

const WIDTH: f64 = 460.0;
const LEFT: f64 = 52.0;
/// Room for the colour bar.
const RIGHT: f64 = 78.0;
const BOTTOM: f64 = 44.0;
/// Room for the title of the upward axis.
const TOP: f64 = 24.0;
/// Width of a letter of the numbers in cells, and of smaller ones where these do not fit.
const LETTERS: [f64; 2] = [7.0, 6.0];
/// Widest cell.
const WIDEST: f64 = 90.0;
/// Steps of the colour bar.
const SHADES: usize = 24;

/// Cells along an axis, as far apart as their values.
struct Spacing {
    /// Ends of the cells, one more than there are values.
    edges: Vec<f64>,
    /// Places of the values.
    places: Vec<f64>,
    /// Place of the number zero and length of one, unless they are spaced by logarithms.
    linear: Option<[f64; 2]>,
}

impl Spacing {
    /// Cells on a length. Values that grow by ratios, so that the first cells would be too narrow to see, are spaced by
    /// their logarithms.
    fn new(values: &[f64], length: f64) -> Self {
        let spaced = |by: fn(f64) -> f64| -> Vec<f64> {
            let at: Vec<f64> = values.iter().map(|value| by(*value)).collect();
            match at[..] {
                [] => vec![0.0, 1.0],
                [one] => vec![one - 0.5, one + 0.5],
                [first, second, ..] => {
                    let n = at.len();
                    let mut edges = vec![1.5 * first - 0.5 * second];
                    edges.extend(at.windows(2).map(|pair| 0.5 * (pair[0] + pair[1])));
                    edges.push(1.5 * at[n - 1] - 0.5 * at[n - 2]);
                    edges
                }
            }
        };
        let narrowest = |edges: &[f64]| {
            let whole = edges[edges.len() - 1] - edges[0];
            let cells = edges.windows(2).map(|pair| (pair[1] - pair[0]) / whole);
            cells.fold(f64::INFINITY, f64::min)
        };
        let linear = spaced(|value| value);
        let few = 0.35 / values.len().max(1) as f64;
        let by_ratio = values.iter().all(|value| *value > 0.0) && narrowest(&linear) < few;
        let by: fn(f64) -> f64 = if by_ratio { f64::ln } else { |value| value };
        let edges = spaced(by);
        let (from, whole) = (edges[0], edges[edges.len() - 1] - edges[0]);
        let place = |at: f64| (at - from) / whole * length;
        Self {
            places: values.iter().map(|value| place(by(*value))).collect(),
            linear: (!by_ratio).then(|| [place(0.0), length / whole]),
            edges: edges.into_iter().map(place).collect(),
        }
    }

    /// Numbers along the axis with their places: the values, or round numbers where not all values have room.
    fn ticks(&self, values: &[f64], apart: f64) -> Vec<(f64, String)> {
        let labelled = self.labelled(apart);
        let end = self.edges.last().copied().unwrap_or(0.0);
        match self.linear {
            Some([zero, unit]) if labelled.len() < values.len() && end > 0.0 => {
                let ends = [0.0, end].map(|place| (place - zero) / unit);
                let scale = Scale::new(ends, [0.0, end], 1.0, end / (1.5 * apart));
                let placed = scale.placed();
                placed.map(|(_, place, text)| (place, text)).collect()
            }
            _ => {
                let value = |at: usize| (self.places[at], number(values[at]));
                labelled.into_iter().map(value).collect()
            }
        }
    }

    /// Indices of the values whose labels do not touch each other.
    fn labelled(&self, apart: f64) -> Vec<usize> {
        let mut last = f64::NEG_INFINITY;
        let mut labelled = Vec::new();
        for (index, place) in self.places.iter().enumerate() {
            if place - last >= apart {
                last = *place;
                labelled.push(index);
            }
        }
        labelled
    }
}

pub(super) fn figure(map: &HeatMap) -> Markup {
    let (nx, ny) = (map.columns.len().max(1), map.rows.len().max(1));
    let length = (WIDTH - LEFT - RIGHT).min(WIDEST * nx as f64);
    let tall = ny as f64 * (220.0 / ny as f64).clamp(8.0, 34.0);
    let height = TOP + tall + BOTTOM;
    let (across, up) = (
        Spacing::new(&map.columns, length),
        Spacing::new(&map.rows, tall),
    );
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
    let label = message::one_over_two(&map.value.name, &map.x.name, &map.y.name);
    let bar = LEFT + length + 14.0;
    // Numbers stand in all cells or in none.
    let longest = present().map(|value| number(value).chars().count()).max();
    let narrowest = across.edges.windows(2).map(|pair| pair[1] - pair[0]);
    let narrowest = narrowest.fold(f64::INFINITY, f64::min);
    let [fits, fits_small] =
        LETTERS.map(|letter| narrowest >= letter * longest.unwrap_or(0) as f64);
    html! {
        figure.study-map {
            figcaption { span.chart-title { (format::capital(&map.value.name)) } @if !map.value.unit.is_empty() { span.unit { " [" (map.value.unit) "]" } } }
            svg viewBox=(format!("0 0 {WIDTH} {height}")) role="img" aria-label=(label) {
                @for (index, one) in map.cells.iter().enumerate() {
                    @let (column, row) = (index % nx, index / nx);
                    @let (left, right) = (across.edges[column], across.edges[column + 1]);
                    @let (low_edge, high_edge) = (up.edges[row], up.edges[row + 1]);
                    @let (x, y) = (LEFT + left, TOP + tall - high_edge);
                    @let size = [right - left, high_edge - low_edge];
                    @let place = format!("{} {} {}, {} {} {}", map.x.name, number(map.columns[column]), map.x.unit, map.y.name, number(map.rows[row]), map.y.unit);
                    @let said = one.value.map_or_else(|| map.nothing.clone(), |value| format!("{} {}", number(value), map.value.unit));
                    @let shade = one.value.map_or(0.0, share);
                    @if let Some(link) = &one.link {
                        a href=(link) { (rect(x, y, size, one, shade, true, &format!("{place}: {said} ({})", one.cases))) }
                    } @else {
                        (rect(x, y, size, one, shade, false, &format!("{place}: {said} ({})", one.cases)))
                    }
                    @if fits_small && size[1] >= 13.0 {
                        @if let Some(value) = one.value {
                            text.study-number.small[!fits].on-dark[shade > 0.5] x=(x + 0.5 * size[0]) y=(y + 0.5 * size[1] + 4.0) text-anchor="middle" { (number(value)) }
                        }
                    }
                }
                @for (place, text) in across.ticks(&map.columns, 34.0) {
                    text x=(LEFT + place) y=(height - BOTTOM + 15.0) text-anchor="middle" { (text) }
                }
                @for (place, text) in up.ticks(&map.rows, 14.0) {
                    text x=(LEFT - 6.0) y=(TOP + tall - place + 4.0) text-anchor="end" { (text) }
                }
                text x=(LEFT + 0.5 * length) y=(height - 10.0) text-anchor="middle" { (map.x.label()) }
                text x="0" y="12" { (map.y.label()) }
                @if high > low {
                    g.colour-bar {
                        @for step in 0..SHADES {
                            @let part = tall / SHADES as f64;
                            rect.study-cell x=(bar) y=(format!("{:.2}", TOP + tall - part * (step + 1) as f64)) width="12" height=(format!("{:.2}", part + 0.3)) style=(format!("--s:{:.1}%", 100.0 * (step as f64 + 0.5) / SHADES as f64)) {}
                        }
                        @for value in [low, 0.5 * (low + high), high] {
                            text x=(bar + 16.0) y=(format!("{:.1}", TOP + tall * (1.0 - share(value)) + 4.0)) { (number(value)) }
                        }
                    }
                }
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

#[cfg(test)]
mod tests {
    use super::*;

    /// 0.1 to 0.5 g in 60 steps: not every value has room, and every fifth would be 0.134, 0.168 …
    #[test]
    fn many_values_get_round_numbers() {
        let values: Vec<f64> = (0..60).map(|i| 0.1 + 0.4 * f64::from(i) / 59.0).collect();
        let spacing = Spacing::new(&values, 400.0);
        let ticks = spacing.ticks(&values, 30.0);
        let texts: Vec<&str> = ticks.iter().map(|(_, text)| &**text).collect();
        assert_eq!(
            texts,
            [
                "0.10", "0.15", "0.20", "0.25", "0.30", "0.35", "0.40", "0.45", "0.50"
            ]
        );
        // In the middle of its cell, as the value would be.
        assert!((ticks[0].0 - spacing.places[0]).abs() < 1e-9);
        assert!((ticks[8].0 - spacing.places[59]).abs() < 1e-9);
        let few = Spacing::new(&values[..3], 400.0).ticks(&values[..3], 30.0);
        assert_eq!(few.len(), 3);
    }

    #[test]
    fn cells_are_as_far_apart_as_their_values() {
        let even = Spacing::new(&[10.0, 20.0, 30.0], 300.0);
        assert_eq!(even.edges, [0.0, 100.0, 200.0, 300.0]);
        assert_eq!(even.places, [50.0, 150.0, 250.0]);
        // Edges at −5, 5, 25 and 55.
        let uneven = Spacing::new(&[0.0, 10.0, 40.0], 60.0);
        assert_eq!(uneven.edges, [0.0, 10.0, 30.0, 60.0]);
        assert_eq!(uneven.places, [5.0, 15.0, 45.0]);
        // Doublings are equally wide.
        let ratios = Spacing::new(&[1.0, 2.0, 4.0, 8.0, 16.0, 32.0, 64.0], 70.0);
        for pair in ratios.edges.windows(2) {
            assert!(
                (pair[1] - pair[0] - 10.0).abs() < 1e-9,
                "{:?}",
                ratios.edges
            );
        }
        assert_eq!(Spacing::new(&[5.0], 90.0).edges, [0.0, 90.0]);
        assert_eq!(even.labelled(120.0), [0, 2]);
    }
}
