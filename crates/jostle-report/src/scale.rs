//! Axes of drawings without scripts: what places values, and lines with round numbers.

use maud::{Markup, html};

use crate::format;

/// An axis between two positions of a drawing.
pub(crate) struct Scale {
    /// Values at its ends, in the unit shown.
    ends: [f64; 2],
    /// Positions of its ends.
    along: [f64; 2],
    /// SI value of the unit shown.
    unit: f64,
    logarithmic: bool,
    /// Round numbers within its ends, in the unit shown.
    numbers: Vec<f64>,
    /// Decimals that they need.
    decimals: usize,
}

impl Scale {
    /// From the least to the greatest value, in a unit of this SI value, with about `count` parts.
    pub(crate) fn new(ends: [f64; 2], along: [f64; 2], unit: f64, count: f64) -> Self {
        let ends = ends.map(|end| end / unit);
        let (step, decimals) = step(ends, count);
        let [first, last] = [(ends[0] / step).ceil(), (ends[1] / step + 1e-9).floor()];
        Self {
            numbers: multiples(first, last, step),
            ends,
            along,
            unit,
            logarithmic: false,
            decimals,
        }
    }

    /// The same with ends that are round numbers: at or below the least, at or above the greatest.
    pub(crate) fn rounded(ends: [f64; 2], along: [f64; 2], unit: f64, count: f64) -> Self {
        let (step, decimals) = step(ends.map(|end| end / unit), count);
        let first = (ends[0] / unit / step + 1e-9).floor();
        let last = (ends[1] / unit / step - 1e-9).ceil().max(first + 1.0);
        Self {
            ends: [first, last].map(|number| number * step),
            numbers: multiples(first, last, step),
            along,
            unit,
            logarithmic: false,
            decimals,
        }
    }

    /// With 1, 2 and 5 of every decade; both ends are positive.
    pub(crate) fn logarithmic(ends: [f64; 2], along: [f64; 2]) -> Self {
        let [low, high] = ends;
        let decades = low.log10().floor() as i32..=high.log10().ceil() as i32;
        let numbers = decades.flat_map(|power| [1.0, 2.0, 5.0].map(|one| one * 10f64.powi(power)));
        let within = low * (1.0 - 1e-9)..=high * (1.0 + 1e-9);
        Self {
            numbers: numbers.filter(|number| within.contains(number)).collect(),
            ends,
            along,
            unit: 1.0,
            logarithmic: true,
            decimals: 0,
        }
    }

    /// Position of an SI value.
    pub(crate) fn at(&self, value: f64) -> f64 {
        let ([low, high], [from, to]) = (self.ends, self.along);
        let value = value / self.unit;
        let share = match self.logarithmic {
            true => (value / low).ln() / (high / low).ln(),
            false => (value - low) / (high - low),
        };
        from + share * (to - from)
    }

    /// Drawing units per SI unit of a straight axis.
    pub(crate) fn per_unit(&self) -> f64 {
        (self.at(self.unit) - self.at(0.0)) / self.unit
    }

    /// Text of a number of the axis.
    fn text(&self, number: f64) -> String {
        match self.logarithmic {
            true => format::plain(number, 4),
            false => format::fixed(number, self.decimals),
        }
    }

    /// Numbers with their positions.
    pub(crate) fn placed(&self) -> impl Iterator<Item = (f64, f64, String)> + '_ {
        let placed = |number: &f64| (*number, self.at(*number * self.unit), self.text(*number));
        self.numbers.iter().map(placed)
    }

    /// An axis to the right: lines from `top` to `bottom`, and their numbers below.
    pub(crate) fn across(&self, [top, bottom]: [f64; 2]) -> Markup {
        html! {
            @for (number, at, _) in self.placed() {
                line.zero[number == 0.0 && !self.logarithmic] x1=(place(at)) x2=(place(at)) y1=(place(top)) y2=(place(bottom)) {}
            }
            (self.numbers_at(bottom + 15.0))
        }
    }

    /// Numbers of an axis to the right, at a height of the drawing.
    pub(crate) fn numbers_at(&self, height: f64) -> Markup {
        html! {
            @for (_, at, text) in self.placed() {
                text x=(place(at)) y=(place(height)) text-anchor="middle" { (text) }
            }
        }
    }

    /// An axis upwards: lines from `left` to `right`, and their numbers to the left.
    pub(crate) fn up(&self, [left, right]: [f64; 2]) -> Markup {
        html! {
            @for (number, at, _) in self.placed() {
                line.zero[number == 0.0 && !self.logarithmic] x1=(place(left)) x2=(place(right)) y1=(place(at)) y2=(place(at)) {}
            }
            (self.numbers_beside(left - 6.0, "end"))
        }
    }

    /// Numbers of an axis upwards, beside a position of the drawing.
    pub(crate) fn numbers_beside(&self, position: f64, anchor: &str) -> Markup {
        html! {
            @for (_, at, text) in self.placed() {
                text x=(place(position)) y=(place(at + 4.0)) text-anchor=(anchor) { (text) }
            }
        }
    }
}

/// A name along an axis upwards, around a height of the drawing.
pub(crate) fn name_upwards(name: impl maud::Render, at: f64, middle: f64) -> Markup {
    html! {
        text x="0" y="0" transform={ "translate(" (at) " " (middle) ") rotate(-90)" } text-anchor="middle" { (name) }
    }
}

/// A position of a drawing as text.
pub(crate) fn place(value: f64) -> String {
    format!("{value:.1}")
}

/// Round step of about `count` parts between two ends, and the decimals of its multiples.
fn step([low, high]: [f64; 2], count: f64) -> (f64, usize) {
    let raw = (high - low) / count;
    if !(raw.is_finite() && raw > 0.0) {
        return (1.0, 0);
    }
    let power = 10f64.powf(raw.log10().floor());
    let steps = [1.0, 2.0, 5.0, 10.0].map(|one| one * power);
    let step = steps.into_iter().find(|step| *step >= raw * 0.999);
    let step = step.unwrap_or(10.0 * power);
    (step, (-(step.log10() + 1e-9).floor()).max(0.0) as usize)
}

fn multiples(first: f64, last: f64, step: f64) -> Vec<f64> {
    let count = (last - first).max(0.0) as usize;
    (0..=count)
        .map(|index| step * (first + index as f64))
        .collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn numbers(axis: &Scale) -> Vec<String> {
        axis.placed().map(|(.., text)| text).collect()
    }

    #[test]
    fn numbers_are_round_and_within_the_ends() {
        let straight = |ends: [f64; 2], count: f64| Scale::new(ends, [0.0, 100.0], 1.0, count);
        assert_eq!(
            numbers(&straight([-0.12, 0.1], 5.0)),
            ["−0.10", "−0.05", "0.00", "0.05", "0.10"]
        );
        assert_eq!(
            numbers(&straight([0.0, 320.0], 7.0)),
            ["0", "50", "100", "150", "200", "250", "300"]
        );
        assert_eq!(numbers(&straight([0.0, 0.0], 5.0)), ["0"]);
        assert_eq!(numbers(&straight([0.0, f64::NAN], 5.0)), ["0"]);
        let millimetres = Scale::new([0.0, 0.4], [50.0, 450.0], 1e-3, 5.0);
        assert_eq!(numbers(&millimetres), ["0", "100", "200", "300", "400"]);
        assert_eq!([millimetres.at(0.1), millimetres.per_unit()], [150.0, 1e3]);
    }

    #[test]
    fn round_ends_hold_all_values() {
        let rounded = |ends: [f64; 2]| numbers(&Scale::rounded(ends, [0.0, 1.0], 1.0, 5.0));
        assert_eq!(rounded([-3.1, 4.2]), ["−4", "−2", "0", "2", "4", "6"]);
        assert_eq!(rounded([0.0, 10.0]), ["0", "2", "4", "6", "8", "10"]);
        assert_eq!(rounded([0.0, 0.0]), ["0", "1"]);
    }

    #[test]
    fn decades_have_three_numbers() {
        let axis = Scale::logarithmic([0.02, 4.0], [0.0, 1.0]);
        assert_eq!(
            numbers(&axis),
            ["0.02", "0.05", "0.1", "0.2", "0.5", "1", "2"]
        );
        assert!((axis.at(0.02), axis.at(4.0)) == (0.0, 1.0));
    }
}
