//! Line charts with bands, dots and horizontal lines.

use maud::{Markup, html};

use super::{Axis, number};
use crate::scale::{Scale, name_upwards};
use crate::{format, message};

/// Lines over an axis.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Chart {
    /// Heading; may be empty.
    pub title: String,
    /// To the right.
    pub x: Axis,
    /// Upwards.
    pub y: Axis,
    /// Lines and dots.
    pub series: Vec<Series>,
    /// Horizontal lines.
    pub levels: Vec<Level>,
    /// Vertical lines.
    pub marks: Vec<Level>,
    /// The least that the vertical axis reaches up to.
    pub reach: f64,
    /// Whether the series are levels of one quantity from low to high, such as intensities, and not things of their own.
    pub ordered: bool,
    /// Whether the vertical axis has a logarithmic scale; only points above zero are drawn then.
    pub logarithmic: bool,
}

/// A horizontal or vertical line with its name.
#[derive(Clone, Debug, PartialEq)]
pub struct Level {
    /// Name.
    pub name: String,
    /// Where.
    pub value: f64,
}

/// One line, or dots.
#[derive(Clone, Debug, PartialEq)]
pub struct Series {
    /// Name; series without one have no place in the legend.
    pub name: String,
    /// Points in order.
    pub points: Vec<[f64; 2]>,
    /// Lower and upper limits at the points, if there are any.
    pub band: Vec<[f64; 2]>,
    /// How it is drawn.
    pub stroke: Stroke,
    /// Number of its colour; series that belong together share one.
    pub colour: usize,
}

/// How a series is drawn.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Stroke {
    /// A line.
    Line,
    /// A line with a dot at every point.
    Dotted,
    /// A thin, pale line among many.
    Thin,
    /// A heavy line.
    Heavy,
    /// A dashed line.
    Dashed,
    /// Dots alone.
    Dots,
}

const WIDTH: f64 = 520.0;
const HEIGHT: f64 = 300.0;
const LEFT: f64 = 78.0;
const RIGHT: f64 = 28.0;
const TOP: f64 = 10.0;
const BOTTOM: f64 = 40.0;
/// Colours of the style sheet that many lines tell apart, in this order.
const COLOURS: [&str; 7] = ["c0", "c1", "c2", "c3", "f2", "f0", "c6"];
/// Series in a legend at most.
const LEGEND: usize = 14;

/// Height of a line of names, and width of a letter, about.
const LINE: f64 = 15.0;
const LETTER: f64 = 8.0;

/// The letter of a dot that stands alone, or the name of a vertical line, and where it is written.
struct DotName {
    name: String,
    dot: [f64; 2],
    at: [f64; 2],
}

impl Series {
    /// Whether it is one dot, which has a letter beside it.
    fn is_alone(&self) -> bool {
        self.stroke == Stroke::Dots && self.points.len() == 1
    }
}

/// Names of vertical lines, one below the other, on the side that has more room.
fn mark_names(chart: &Chart, px: &dyn Fn(f64) -> f64) -> Vec<DotName> {
    let named = chart.marks.iter().enumerate().map(|(row, mark)| {
        let at = px(mark.value);
        let width = LETTER * mark.name.chars().count() as f64;
        let x = match at > 0.6 * WIDTH {
            true => at - 4.0 - width,
            false => at + 4.0,
        };
        DotName {
            name: mark.name.clone(),
            dot: [at, TOP],
            at: [x, TOP + LINE * (row as f64 + 1.0)],
        }
    });
    named.collect()
}

/// The letter of a dot; its name is in the legend.
fn letter(index: usize) -> String {
    char::from(b'a' + (index % 26) as u8).to_string()
}

/// Letters beside their dots, moved up or down until none covers another one.
fn dot_names(chart: &Chart, px: &dyn Fn(f64) -> f64, py: &dyn Fn(f64) -> f64) -> Vec<DotName> {
    let mut names = mark_names(chart, px);
    let marks = names.len();
    for (index, series) in chart.series.iter().filter(|own| own.is_alone()).enumerate() {
        let dot = [px(series.points[0][0]), py(series.points[0][1])];
        let width = |name: &str| LETTER * name.chars().count() as f64;
        let x = (dot[0] + 6.0).min(WIDTH - LETTER);
        let is_free = |y: f64| {
            let inside = (TOP + LINE..HEIGHT - BOTTOM).contains(&y);
            let covers = |other: &DotName| {
                (other.at[1] - y).abs() < LINE
                    && other.at[0] < x + LETTER
                    && x < other.at[0] + width(&other.name)
            };
            inside && !names.iter().any(covers)
        };
        let steps = (0..2 * names.len() + 2).map(|step| {
            let away = step.div_ceil(2) as f64 * LINE;
            dot[1] - 4.0 + if step % 2 == 0 { away } else { -away }
        });
        let y = steps.into_iter().find(|y| is_free(*y));
        names.push(DotName {
            name: letter(index),
            dot,
            at: [x, y.unwrap_or(dot[1] - 4.0)],
        });
    }
    names.split_off(marks)
}

pub(super) fn figure(chart: &Chart) -> Markup {
    let points = || {
        let all = chart.series.iter().flat_map(|series| &series.points);
        all.filter(|p| !chart.logarithmic || p[1] > 0.0)
    };
    let bands = || chart.series.iter().flat_map(|series| &series.band);
    let marked = chart.marks.iter().map(|mark| mark.value);
    let most_x = points().map(|p| p[0]).chain(marked).fold(0.0, f64::max);
    let most_y = points()
        .map(|p| p[1])
        .chain(bands().map(|band| band[1]))
        .chain(chart.levels.iter().map(|level| level.value))
        .fold(chart.reach, f64::max);
    let x = Scale::rounded([0.0, most_x], [LEFT, WIDTH - RIGHT], 1.0, 4.5);
    let up = [HEIGHT - BOTTOM, TOP];
    let least_y = points().map(|p| p[1]).fold(f64::INFINITY, f64::min);
    let y = match chart.logarithmic && least_y.is_finite() {
        true => Scale::logarithmic([least_y / 1.2, most_y.max(least_y) * 1.2], up),
        false => Scale::rounded([0.0, most_y], up, 1.0, 4.5),
    };
    let (px, py) = (|value: f64| x.at(value), |value: f64| y.at(value));
    let path = |points: &[[f64; 2]]| {
        let mut text = String::new();
        let drawn = points.iter().filter(|p| !chart.logarithmic || p[1] > 0.0);
        for (index, [x, y]) in drawn.enumerate() {
            let letter = if index == 0 { 'M' } else { 'L' };
            text += &format!("{letter}{:.1} {:.1}", px(*x), py(*y));
        }
        text
    };
    let area = |series: &Series| {
        let upper = series.points.iter().zip(&series.band);
        let upper: Vec<[f64; 2]> = upper.map(|(p, band)| [p[0], band[1]]).collect();
        let lower = series.points.iter().zip(&series.band).rev();
        let lower: Vec<[f64; 2]> = lower.map(|(p, band)| [p[0], band[0]]).collect();
        format!("{}Z", path(&[upper, lower].concat()))
    };
    // Levels are a sequence from low to high; other series differ by hue.
    let last = chart.series.iter().map(|series| series.colour).max();
    let colour = |number: usize| match last {
        Some(last) if chart.ordered => {
            let share = 200.0 * number as f64 / last.max(1) as f64;
            let (to, from, share) = if share > 100.0 {
                ("high", "middle", share - 100.0)
            } else {
                ("middle", "low", share)
            };
            format!("--c:color-mix(in oklab, var(--{to}) {share:.0}%, var(--{from}))")
        }
        _ => format!("--c:var(--{})", COLOURS[number % COLOURS.len()]),
    };
    let named: Vec<&Series> = chart
        .series
        .iter()
        .filter(|series| !series.name.is_empty() && !series.is_alone())
        .collect();
    let label = message::one_over_other(&chart.y.name, &chart.x.name);
    html! {
        figure.study-chart {
            figcaption {
                @if !chart.title.is_empty() { span.chart-title { (format::capital(&chart.title)) } }
                span.legend {
                    @for series in named.iter().take(LEGEND) {
                        span.key style=(colour(series.colour)) { span.swatch.dashed[series.stroke == Stroke::Dashed].dots[series.stroke == Stroke::Dots] {} (series.name) }
                    }
                    @for (index, series) in chart.series.iter().filter(|own| own.is_alone()).enumerate() {
                        span.key style=(colour(series.colour)) { span.swatch.dots {} (letter(index)) " " (series.name) }
                    }
                    @if named.len() > LEGEND { span.key { (message::and_more(named.len() - LEGEND)) } }
                }
            }
            svg viewBox=(format!("0 0 {WIDTH} {HEIGHT}")) role="img" aria-label=(label) {
                g.grid {
                    (y.up([LEFT, WIDTH - RIGHT]))
                    (x.across([TOP, HEIGHT - BOTTOM]))
                }
                @for series in &chart.series {
                    @if series.band.len() == series.points.len() && series.points.len() > 1 {
                        path.study-band d=(area(series)) style=(colour(series.colour)) {}
                    }
                }
                @for mark in &chart.marks {
                    line.study-level x1=(px(mark.value)) x2=(px(mark.value)) y1=(TOP) y2=(HEIGHT - BOTTOM) {}
                }
                @for level in &chart.levels {
                    line.study-level x1=(LEFT) x2=(WIDTH - RIGHT) y1=(py(level.value)) y2=(py(level.value)) {}
                }
                @for series in &chart.series {
                    @if series.stroke != Stroke::Dots && series.points.len() > 1 {
                        path.line.thin[series.stroke == Stroke::Thin].heavy[series.stroke == Stroke::Heavy].dashed[series.stroke == Stroke::Dashed] d=(path(&series.points)) style=(colour(series.colour)) { title { (series.name) } }
                    }
                    @if matches!(series.stroke, Stroke::Dots | Stroke::Dotted) {
                        @for [x, y] in series.points.iter().filter(|p| !chart.logarithmic || p[1] > 0.0) {
                            circle.dot cx=(format!("{:.1}", px(*x))) cy=(format!("{:.1}", py(*y))) r="3" style=(colour(series.colour)) {
                                title { (series.name) " " (number(*x)) " " (chart.x.unit) ": " (number(*y)) " " (chart.y.unit) }
                            }
                        }
                    }
                }
                @for DotName { name, dot, at } in dot_names(chart, &px, &py) {
                    @if (at[1] - dot[1]).abs() > LINE {
                        line style="stroke:var(--ink-2);stroke-width:.6" x1=(format!("{:.1}", dot[0])) y1=(format!("{:.1}", dot[1])) x2=(format!("{:.1}", at[0] - 2.0)) y2=(format!("{:.1}", at[1] - 4.0)) {}
                    }
                    text.study-level-name x=(format!("{:.1}", at[0])) y=(format!("{:.1}", at[1])) { (name) }
                }
                // Above the lines, which would cross them.
                @for DotName { name, at, .. } in mark_names(chart, &px) {
                    text.study-level-name x=(format!("{:.1}", at[0])) y=(format!("{:.1}", at[1])) { (name) }
                }
                @for level in &chart.levels {
                    text.study-level-name x=(WIDTH - RIGHT - 4.0) y=(py(level.value) - 4.0) text-anchor="end" { (level.name) }
                }
                text x=(0.5 * (LEFT + WIDTH - RIGHT)) y=(HEIGHT - 6.0) text-anchor="middle" { (chart.x.label()) }
                (name_upwards(chart.y.label(), 12.0, 0.5 * (TOP + HEIGHT - BOTTOM)))
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_of_dots_do_not_cover_each_other() {
        let dot = |at: usize| Series {
            name: format!("GB 50011, intensity {at}"),
            points: vec![[100.0 + 0.1 * at as f64, 50.0 - 0.1 * at as f64]],
            band: Vec::new(),
            stroke: Stroke::Dots,
            colour: 0,
        };
        let axis = || Axis {
            name: String::new(),
            unit: String::new(),
        };
        let chart = Chart {
            title: String::new(),
            x: axis(),
            y: axis(),
            series: (0..8).map(dot).collect(),
            ..Chart::default()
        };
        let names = dot_names(&chart, &|x| LEFT + 2.0 * x, &|y| HEIGHT - BOTTOM - 4.0 * y);
        assert_eq!(names.len(), 8);
        for (index, one) in names.iter().enumerate() {
            assert!((TOP..HEIGHT - BOTTOM).contains(&one.at[1]), "{}", one.name);
            for other in &names[..index] {
                assert!(
                    (one.at[1] - other.at[1]).abs() >= LINE - 1e-9,
                    "{}",
                    one.name
                );
            }
        }
    }
}
