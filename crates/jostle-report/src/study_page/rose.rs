//! Polar plots over the angle of incidence.

use maud::{Markup, html};

use super::{Axis, number, peak};
use crate::message;
use crate::site_drawing::compass_bearing;

/// A quantity over the angle of incidence.
#[derive(Clone, Debug, PartialEq)]
pub struct Rose {
    /// Heading.
    pub title: String,
    /// What the distance from the middle measures.
    pub value: Axis,
    /// Curves.
    pub petals: Vec<Petal>,
    /// Angle from x to north, counter-clockwise; `None` to draw no north \[°\].
    pub north: Option<f64>,
}

/// One curve of a rose.
#[derive(Clone, Debug, PartialEq)]
pub struct Petal {
    /// Name; curves without one have no place in the legend.
    pub name: String,
    /// Angle from x, counter-clockwise \[°\], and value ≥ 0, by growing angle.
    pub points: Vec<[f64; 2]>,
    /// Number of its colour.
    pub colour: usize,
    /// Whether it is dashed and without dots.
    pub dashed: bool,
}

impl Rose {
    /// One without curves.
    #[must_use]
    pub const fn new(title: String, value: Axis) -> Self {
        Self {
            title,
            value,
            petals: Vec::new(),
            north: None,
        }
    }
}

impl Petal {
    /// Whether the last point is next to the first: gaps between neighbours are about equal, all around.
    fn is_closed(&self) -> bool {
        let steps = self.points.windows(2).map(|pair| pair[1][0] - pair[0][0]);
        let widest = steps.fold(0.0, f64::max);
        match &self.points[..] {
            [first, .., last] => first[0] + 360.0 - last[0] <= 1.5 * widest,
            _ => false,
        }
    }

    /// The first of the greatest points.
    fn worst(&self) -> Option<[f64; 2]> {
        let points = self.points.iter().rev();
        points.max_by(|a, b| a[1].total_cmp(&b[1])).copied()
    }
}

/// Side of the picture, and radius of the outermost ring.
const SIDE: f64 = 400.0;
const RADIUS: f64 = 150.0;
/// Direction of the labels of the rings \[°\].
const RINGS: f64 = 75.0;
/// Colours of the style sheet.
const COLOURS: usize = 7;

/// Round numbers above 0 that divide 0..=`reach` into three to five parts, the last at or above `reach`.
fn rings(reach: f64) -> Vec<f64> {
    if !(reach.is_finite() && reach > 0.0) {
        return vec![1.0];
    }
    let rough = reach / 3.5;
    let power = 10f64.powf(rough.log10().floor());
    let steps = [1.0, 2.0, 2.5, 5.0, 10.0].map(|step| step * power);
    let step = steps.into_iter().find(|step| *step >= rough);
    let step = step.unwrap_or(rough);
    let count = (reach / step - 1e-9).ceil() as usize;
    (1..=count).map(|index| step * index as f64).collect()
}

pub(super) fn figure(rose: &Rose) -> Markup {
    let points = || rose.petals.iter().flat_map(|petal| &petal.points);
    let most = points().map(|point| point[1]).fold(0.0, f64::max);
    let all = rings(most);
    let end = all.last().copied().unwrap_or(1.0);
    let middle = 0.5 * SIDE;
    let place = |angle: f64, radius: f64| {
        let (sin, cos) = angle.to_radians().sin_cos();
        [middle + radius * cos, middle - radius * sin]
    };
    let path = |petal: &Petal| {
        let mut text = String::new();
        for [angle, value] in &petal.points {
            let [x, y] = place(*angle, RADIUS * value / end);
            let letter = if text.is_empty() { 'M' } else { 'L' };
            text += &format!("{letter}{x:.1} {y:.1}");
        }
        if petal.is_closed() {
            text.push('Z');
        }
        text
    };
    let colour = |number: usize| format!("--c:var(--c{})", number % COLOURS);
    html! {
        figure.study-rose {
            figcaption {
                span.chart-title { (rose.title) @if !rose.value.unit.is_empty() { " [" (rose.value.unit) "]" } }
                span.legend {
                    @for petal in rose.petals.iter().filter(|petal| !petal.name.is_empty() && !petal.dashed) {
                        span.key style=(colour(petal.colour)) { span.swatch {} (petal.name) }
                    }
                    @if rose.petals.iter().any(|petal| petal.dashed) {
                        span.key { span.swatch.dashed {} (message::without_contact()) }
                    }
                }
            }
            svg viewBox=(format!("0 0 {SIDE} {SIDE}")) role="img" aria-label=(message::over_the_angle_of_incidence(&rose.title)) {
                g.grid {
                    @for ring in &all { circle cx=(middle) cy=(middle) r=(format!("{:.1}", RADIUS * ring / end)) {} }
                    @for spoke in 0..12 {
                        @let angle = 30.0 * f64::from(spoke);
                        @let [x, y] = place(angle, RADIUS);
                        line x1=(middle) y1=(middle) x2=(format!("{x:.1}")) y2=(format!("{y:.1}")) {}
                    }
                }
                @for spoke in 0..12 {
                    @let angle = 30.0 * f64::from(spoke);
                    @let [x, y] = place(angle, RADIUS + 19.0);
                    @let name = match spoke { 0 => "0° x".to_owned(), 3 => "90° y".to_owned(), _ => format!("{angle}°") };
                    text.study-spoke x=(format!("{x:.1}")) y=(format!("{:.1}", y + 4.0)) text-anchor="middle" { (name) }
                }
                @if let Some(north) = rose.north {
                    @let [x, y] = place(north, RADIUS + 38.0);
                    @let [from, tip] = [RADIUS - 8.0, RADIUS + 8.0].map(|radius| place(north, radius));
                    line.study-north x1=(format!("{:.1}", from[0])) y1=(format!("{:.1}", from[1])) x2=(format!("{:.1}", tip[0])) y2=(format!("{:.1}", tip[1])) {}
                    text.study-north x=(format!("{x:.1}")) y=(format!("{:.1}", y + 4.0)) text-anchor="middle" { (message::letter_of_north()) }
                }
                @for petal in &rose.petals {
                    path.petal.dashed[petal.dashed] d=(path(petal)) style=(colour(petal.colour)) { title { (petal.name) } }
                }
                @for petal in rose.petals.iter().filter(|petal| !petal.dashed) {
                    @for [angle, value] in &petal.points {
                        @let [x, y] = place(*angle, RADIUS * value / end);
                        circle.dot cx=(format!("{x:.1}")) cy=(format!("{y:.1}")) r="2" style=(colour(petal.colour)) {
                            title { (petal.name) " " (number(*angle)) "°: " (peak(*value)) " " (rose.value.unit) }
                        }
                    }
                }
                @for ring in &all {
                    @let [x, y] = place(RINGS, RADIUS * ring / end);
                    text.study-ring x=(format!("{x:.1}")) y=(format!("{:.1}", y + 4.0)) text-anchor="middle" { (number(*ring)) }
                }
                @if most > 0.0 {
                    @for petal in rose.petals.iter().filter(|petal| !petal.dashed) {
                        @if let Some([angle, value]) = petal.worst() {
                            @let [x, y] = place(angle, RADIUS * value / end);
                            circle.study-worst cx=(format!("{x:.1}")) cy=(format!("{y:.1}")) r="5" style=(colour(petal.colour)) {
                                title { (message::worst_angle(&petal.name, number(angle), peak(value), &rose.value.unit)) }
                            }
                        }
                    }
                } @else {
                    text.study-ring x=(middle) y=(middle) text-anchor="middle" { (message::zero_at_every_angle()) }
                }
            }
            p.quiet.study-worst-words {
                @for petal in rose.petals.iter().filter(|petal| !petal.dashed && most > 0.0) {
                    @if let Some([angle, value]) = petal.worst() {
                        span { @if !petal.name.is_empty() { (petal.name) ": " } (worst_in_words(rose, value, angle)) }
                    }
                }
            }
        }
    }
}

/// A greatest value and its angle; with its compass bearing where north is known.
fn worst_in_words(rose: &Rose, value: f64, angle: f64) -> String {
    let unit = &rose.value.unit;
    match rose.north {
        None => message::value_at_angle(peak(value), unit, number(angle)),
        Some(north) => message::value_at_bearing(
            peak(value),
            unit,
            number(angle),
            number(compass_bearing(angle, north)),
        ),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn petal(angles: impl Iterator<Item = f64>) -> Petal {
        Petal {
            name: "A".into(),
            points: angles
                .map(|angle| [angle, 1.0 + (angle / 90.0).floor()])
                .collect(),
            colour: 0,
            dashed: false,
        }
    }

    #[test]
    fn only_full_circles_are_closed() {
        assert!(petal((0..36).map(|k| 10.0 * f64::from(k))).is_closed());
        assert!(!petal((0..=9).map(|k| 10.0 * f64::from(k))).is_closed());
        assert!(!petal(std::iter::once(30.0)).is_closed());
    }

    #[test]
    fn the_first_of_equal_greatest_values_is_marked() {
        let petal = petal((0..36).map(|k| 10.0 * f64::from(k)));
        assert_eq!(petal.worst(), Some([270.0, 4.0]));
    }

    #[test]
    fn rings_reach_the_greatest_value() {
        assert_eq!(rings(1572.1), [500.0, 1000.0, 1500.0, 2000.0]);
        assert_eq!(rings(0.0), [1.0]);
        for reach in [1e-3, 0.3, 7.0, 4321.0] {
            let all = rings(reach);
            assert!((2..=5).contains(&all.len()), "{all:?}");
            assert!(all.last().is_some_and(|last| *last >= reach * 0.999_999));
        }
    }
}
