//! Line plots without scripts, the same on screen and on paper.

use jostle::linear::sort_by;
use maud::{Markup, html};

use crate::format;
use crate::message;

/// A plot of lines over a common axis.
pub(crate) struct Plot {
    /// Caption: what is shown.
    pub(crate) title: String,
    /// Quantity and unit to the right.
    pub(crate) x_label: String,
    /// Quantity and unit upwards.
    pub(crate) y_label: String,
    /// Whether the horizontal axis is logarithmic.
    pub(crate) logarithmic: bool,
    /// Height over width \[–\].
    pub(crate) aspect: f64,
    pub(crate) lines: Vec<Line>,
}

/// One line.
pub(crate) struct Line {
    /// Name; lines without one have no place in the legend.
    pub(crate) name: String,
    pub(crate) points: Vec<[f64; 2]>,
    /// Number of its colour.
    pub(crate) colour: usize,
    pub(crate) dashed: bool,
}

/// Width of the picture, its margins.
const WIDTH: f64 = 520.0;
const LEFT: f64 = 52.0;
const RIGHT: f64 = 12.0;
const TOP: f64 = 8.0;
const BOTTOM: f64 = 36.0;
/// Points of a line at most; of more, the extremes of equal parts are kept.
const POINTS: usize = 1400;

impl Plot {
    /// The figure; without points only the caption.
    pub(crate) fn figure(&self) -> Markup {
        let height = WIDTH * self.aspect;
        let points = || self.lines.iter().flat_map(|line| &line.points);
        let usable = |p: &&[f64; 2]| !self.logarithmic || p[0] > 0.0;
        let range = |axis: usize| {
            let values = points().filter(usable).map(|p| p[axis]);
            let low = values.clone().fold(f64::INFINITY, f64::min);
            [low, values.fold(f64::NEG_INFINITY, f64::max)]
        };
        let [x, y] = [range(0), range(1)];
        if !(x[0] < x[1] && y[0].is_finite() && y[1].is_finite()) {
            return html! { figure.static-plot { figcaption { (message::nothing_to_show(&self.title)) } } };
        }
        let ys = ticks(y[0].min(0.0), y[1].max(0.0), 5.0);
        let y = [ys.first(), ys.last()].map(|end| end.copied().unwrap_or(0.0));
        let xs = match self.logarithmic {
            true => decades(x[0], x[1]),
            false => ticks(x[0], x[1], 7.0),
        };
        let along = |value: f64| match self.logarithmic {
            true => (value / x[0]).ln() / (x[1] / x[0]).ln(),
            false => (value - x[0]) / (x[1] - x[0]),
        };
        let px = |value: f64| LEFT + (WIDTH - LEFT - RIGHT) * along(value);
        let py = |value: f64| {
            let share = (value - y[0]) / (y[1] - y[0]);
            height - BOTTOM - (height - TOP - BOTTOM) * share
        };
        let path = |line: &Line| {
            let mut text = String::new();
            for [x, y] in thinned(&line.points) {
                if !self.logarithmic || x > 0.0 {
                    let letter = if text.is_empty() { 'M' } else { 'L' };
                    text += &format!("{letter}{:.1} {:.1}", px(x), py(y));
                }
            }
            text
        };
        let inside = |value: &&f64| (-1e-9..=1.0 + 1e-9).contains(&along(**value));
        html! {
            figure.static-plot {
                figcaption {
                    span.chart-title { (self.title) }
                    span.legend {
                        @for line in self.lines.iter().filter(|line| !line.name.is_empty()) {
                            span.key style=(colour(line.colour)) { span.swatch.dashed[line.dashed] {} (line.name) }
                        }
                    }
                }
                svg viewBox=(format!("0 0 {WIDTH} {height:.0}")) role="img" aria-label=(self.title) {
                    g.grid {
                        @for y in &ys { line.zero[*y == 0.0] x1=(LEFT) x2=(WIDTH - RIGHT) y1=(round(py(*y))) y2=(round(py(*y))) {} }
                        @for x in xs.iter().filter(inside) { line x1=(round(px(*x))) x2=(round(px(*x))) y1=(TOP) y2=(round(height - BOTTOM)) {} }
                    }
                    @for y in &ys { text x=(LEFT - 6.0) y=(round(py(*y) + 4.0)) text-anchor="end" { (number(*y)) } }
                    @for x in xs.iter().filter(inside) { text x=(round(px(*x))) y=(round(height - BOTTOM + 14.0)) text-anchor="middle" { (number(*x)) } }
                    @for line in &self.lines {
                        path.line.dashed[line.dashed] d=(path(line)) style=(colour(line.colour)) { title { (line.name) } }
                    }
                    text x=(LEFT) y=(round(height - 5.0)) { "→ " (self.x_label) "   ↑ " (self.y_label) }
                }
            }
        }
    }
}

/// The style attribute with a colour by its number, as buildings have them.
pub(crate) fn colour(number: usize) -> String {
    format!("--c:var(--c{})", number % 7)
}

fn round(value: f64) -> String {
    format!("{value:.1}")
}

/// A number of an axis.
fn number(value: f64) -> String {
    if value == 0.0 {
        return "0".into();
    }
    format::plain(value, 4)
}

/// Round numbers from at or below `low` to at or above `high`, in about `parts` parts.
fn ticks(low: f64, high: f64, parts: f64) -> Vec<f64> {
    let usable = high > low;
    if !usable {
        return vec![low, low + 1.0];
    }
    let rough = (high - low) / parts;
    let power = 10f64.powf(rough.log10().floor());
    let steps = [1.0, 2.0, 5.0, 10.0].map(|step| step * power);
    let step = steps
        .into_iter()
        .find(|step| *step >= rough)
        .unwrap_or(rough);
    let (first, last) = ((low / step + 1e-9).floor(), (high / step - 1e-9).ceil());
    let count = (last - first) as usize;
    (0..=count)
        .map(|index| step * (first + index as f64))
        .collect()
}

/// 1, 2 and 5 in every decade within a range.
fn decades(low: f64, high: f64) -> Vec<f64> {
    let first = low.log10().floor() as i32;
    let last = high.log10().ceil() as i32;
    let all = (first..=last).flat_map(|power| [1.0, 2.0, 5.0].map(|one| one * 10f64.powi(power)));
    all.filter(|value| (low * (1.0 - 1e-9)..=high * (1.0 + 1e-9)).contains(value))
        .collect()
}

/// A line thinned to a number of points that paper can show.
fn thinned(points: &[[f64; 2]]) -> Vec<[f64; 2]> {
    thinned_to(points, POINTS)
}

/// A line of at most `most` points: of every part the least and the greatest.
pub(crate) fn thinned_to(points: &[[f64; 2]], most: usize) -> Vec<[f64; 2]> {
    if points.len() <= most {
        return points.to_vec();
    }
    let part = points.len().div_ceil(most / 2);
    let extremes = points.chunks(part).flat_map(|part| {
        let value = |p: &&[f64; 2]| p[1];
        let low = part.iter().min_by(|a, b| value(a).total_cmp(&value(b)));
        let high = part.iter().max_by(|a, b| value(a).total_cmp(&value(b)));
        let mut both = [low, high].map(|p| p.copied().unwrap_or_default());
        sort_by(&mut both, |a, b| a[0].total_cmp(&b[0]));
        both
    });
    extremes.collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn axes_have_round_numbers() {
        assert_eq!(ticks(-3.1, 4.2, 5.0), [-4.0, -2.0, 0.0, 2.0, 4.0, 6.0]);
        assert_eq!(ticks(0.0, 10.0, 5.0), [0.0, 2.0, 4.0, 6.0, 8.0, 10.0]);
        assert_eq!(decades(0.02, 4.0), [0.02, 0.05, 0.1, 0.2, 0.5, 1.0, 2.0]);
    }

    #[test]
    fn thinning_keeps_the_peaks() {
        let points: Vec<[f64; 2]> = (0..50_000)
            .map(|i| {
                [
                    f64::from(i),
                    if i == 31_415 { 9.0 } else { f64::from(i % 7) },
                ]
            })
            .collect();
        let thin = thinned(&points);
        assert!(thin.len() <= POINTS + 2, "{}", thin.len());
        assert!(thin.iter().any(|p| p[1] == 9.0));
        assert!(thin.windows(2).all(|pair| pair[0][0] <= pair[1][0]));
    }
}
