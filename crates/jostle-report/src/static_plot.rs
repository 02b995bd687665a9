//! Line plots without scripts, the same on screen and on paper.

use jostle::linear::sort_by;
use maud::{Markup, html};

use crate::message;
use crate::scale::{Scale, place};

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
    /// Whether a line is dashed.
    pub(crate) fn has_dashes(&self) -> bool {
        self.lines.iter().any(|line| line.dashed)
    }

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
        let across = [LEFT, WIDTH - RIGHT];
        let x = match self.logarithmic {
            true => Scale::logarithmic(x, across),
            false => Scale::new(x, across, 1.0, 7.0),
        };
        let y = [y[0].min(0.0), y[1].max(0.0)];
        let y = Scale::rounded(y, [height - BOTTOM, TOP], 1.0, 5.0);
        let path = |line: &Line| {
            let mut text = String::new();
            for [along, value] in thinned(&line.points) {
                if !self.logarithmic || along > 0.0 {
                    let letter = if text.is_empty() { 'M' } else { 'L' };
                    text += &format!("{letter}{:.1} {:.1}", x.at(along), y.at(value));
                }
            }
            text
        };
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
                        (y.up(across))
                        (x.across([TOP, height - BOTTOM]))
                    }
                    @for line in &self.lines {
                        path.line.dashed[line.dashed] d=(path(line)) style=(colour(line.colour)) { title { (line.name) } }
                    }
                    text x=(LEFT) y=(place(height - 5.0)) { "→ " (self.x_label) "   ↑ " (self.y_label) }
                }
            }
        }
    }
}

/// The style attribute with a colour by its number, as buildings have them.
pub(crate) fn colour(number: usize) -> String {
    format!("--c:var(--c{})", number % 7)
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
