//! Rankings: horizontal bars from a centre.

use maud::{Markup, html};

use super::{Axis, number};
use crate::format;
use crate::message;
use crate::scale::Scale;

/// A ranking.
#[derive(Clone, Debug, PartialEq)]
pub struct Bars {
    /// Heading.
    pub title: String,
    /// What the bars measure.
    pub value: Axis,
    /// Where bars begin.
    pub centre: f64,
    /// Bars, the longest first.
    pub bars: Vec<Bar>,
    /// Meaning of the first and the second bar of a row.
    pub legend: [String; 2],
}

/// One row of a ranking.
#[derive(Clone, Debug, PartialEq)]
pub struct Bar {
    /// Name.
    pub name: String,
    /// Ends of its one or two bars.
    pub ends: [f64; 2],
    /// Limits of uncertainty of these, if known.
    pub limits: Option<[[f64; 2]; 2]>,
}

const WIDTH: f64 = 520.0;
const LEFT: f64 = 170.0;
const RIGHT: f64 = 72.0;
const ROW: f64 = 40.0;
/// Room for the base value above, and for ticks and their title below.
const TOP: f64 = 20.0;
const BOTTOM: f64 = 40.0;
/// Greatest length of a base value in letters, times their width.
const LETTER: f64 = 6.2;

pub(super) fn figure(bars: &Bars) -> Markup {
    let all = || {
        let limits = bars.bars.iter().filter_map(|bar| bar.limits);
        let ends = bars.bars.iter().flat_map(|bar| bar.ends);
        ends.chain(limits.flatten().flatten())
    };
    let (low, high) = (
        all().fold(bars.centre, f64::min),
        all().fold(bars.centre, f64::max),
    );
    let span = if high > low { high - low } else { 1.0 };
    let x = Scale::new([low, low + span], [LEFT, WIDTH - RIGHT], 1.0, 5.0);
    let px = |value: f64| x.at(value);
    let below = TOP + ROW * bars.bars.len() as f64;
    let height = below + BOTTOM;
    let base = message::base_centre_value(number(bars.centre), &bars.value.unit);
    let base = base.trim_end();
    // Kept within the picture.
    let half = 0.5 * LETTER * base.chars().count() as f64;
    let base_at = px(bars.centre).clamp(half, WIDTH - half);
    html! {
        figure.study-chart {
            figcaption {
                span.chart-title { (bars.title) }
                span.legend {
                    @for (index, name) in bars.legend.iter().enumerate() {
                        span.key style=(format!("--c:var(--c{index})")) { span.swatch {} (name) }
                    }
                }
            }
            svg viewBox=(format!("0 0 {WIDTH} {height}")) role="img" aria-label=(bars.title) {
                g.grid {
                    (x.across([TOP, below]))
                }
                @for (row, bar) in bars.bars.iter().enumerate() {
                    @let y = TOP + ROW * row as f64 + 4.0;
                    text x=(LEFT - 8.0) y=(y + 19.0) text-anchor="end" { (short(&bar.name)) title { (bar.name) } }
                    @for (index, end) in bar.ends.iter().enumerate() {
                        @let (from, to) = (px(bars.centre.min(*end)), px(bars.centre.max(*end)));
                        @let top = y + 15.0 * index as f64;
                        rect.study-bar x=(format!("{from:.1}")) y=(top) width=(format!("{:.1}", (to - from).max(0.8))) height="13" style=(format!("--c:var(--c{index})")) { title { (bar.name) ", " (bars.legend[index]) ": " (number(*end)) " " (bars.value.unit) } }
                        @if let Some(limits) = bar.limits {
                            line.study-limits x1=(format!("{:.1}", px(limits[index][0]))) x2=(format!("{:.1}", px(limits[index][1]))) y1=(top + 6.5) y2=(top + 6.5) {}
                        }
                        text x=(WIDTH - RIGHT + 6.0) y=(top + 11.0) { (beside(*end, &bars.value.unit)) }
                    }
                }
                line.study-axis x1=(px(bars.centre)) x2=(px(bars.centre)) y1=(TOP - 4.0) y2=(below) {}
                @if bars.centre != 0.0 { text.study-base x=(format!("{base_at:.1}")) y="11" text-anchor="middle" { (base) } }
                text x=(LEFT + 0.5 * (WIDTH - LEFT - RIGHT)) y=(height - 6.0) text-anchor="middle" { (bars.value.label()) }
            }
        }
    }
}

/// A value beside its bar; shares have three decimals.
fn beside(value: f64, unit: &str) -> String {
    match unit.is_empty() && value.abs() < 1.0 && value != 0.0 {
        true => format::fixed(value, 3),
        false => number(value),
    }
}

/// A name that fits beside its bar.
fn short(name: &str) -> String {
    const FITS: usize = 26;
    if name.chars().count() <= FITS {
        return name.to_owned();
    }
    let tail: Vec<char> = name.chars().rev().take(FITS - 1).collect();
    format!("…{}", tail.into_iter().rev().collect::<String>())
}
