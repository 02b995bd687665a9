//! Reinforcing bars: notation and positions.

/// A bar of the cross-section.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Bar {
    /// Distance from the left face \[m\].
    pub x: f64,
    /// Depth below the top face \[m\].
    pub depth: f64,
    /// Diameter \[m\].
    pub diameter: f64,
}

impl Bar {
    /// Cross-section \[m²\].
    #[must_use]
    pub fn area(&self) -> f64 {
        0.25 * std::f64::consts::PI * self.diameter * self.diameter
    }
}

/// Some bars of one diameter.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Group {
    pub(crate) count: usize,
    pub(crate) diameter: f64,
}

/// Reinforcement as written, before placement in a section.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Reinforcement {
    around: Vec<Group>,
    top: Vec<Group>,
    bottom: Vec<Group>,
    sides: Vec<Group>,
}

/// Ties or stirrups: they confine the core.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Ties {
    /// Diameter, > 0 \[m\].
    pub diameter: f64,
    /// Distance along the member, > 0 \[m\].
    pub spacing: f64,
    /// Legs in either direction, ≥ 2 \[–\].
    pub legs: usize,
}

/// An error in a description of bars.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[error("{0}")]
pub struct BarsError(String);

impl BarsError {
    /// In words.
    pub(crate) fn new(problem: &str) -> Self {
        Self(problem.to_owned())
    }
}

/// How bars are written.
const EXAMPLE: &str = "write \"12 d20\" for twelve bars of 20 mm around the section, \"8 #6\" for eight of No. 6, or \"4 d25 top, 3 d25 bottom\"";

/// Most bars of a section.
const MOST_BARS: usize = 400;
/// Most legs of ties in one direction.
const MOST_LEGS: usize = 12;

impl Reinforcement {
    /// Reads `"12 d20"`, `"8 #8"`, `"4 d25 top, 4 d25 bottom"`, `"2 d25 + 2 d20 top, 4 d20 bottom, 4 d12 sides"`. A place may
    /// stand in brackets: `"12 d20 (around)"`.
    ///
    /// Bars without a place go around the section, evenly, with one in each corner. Diameters are in mm. Bars at
    /// the sides lie evenly between top and bottom, half on either face.
    ///
    /// # Errors
    /// [`BarsError`] with the part that is not understood.
    pub fn parse(text: &str) -> Result<Self, BarsError> {
        let mut read = Self::default();
        for part in text.split(',') {
            let part = part.trim();
            let (groups, place) = match part.rsplit_once(char::is_whitespace) {
                Some((groups, place)) => {
                    let inside = place
                        .strip_prefix('(')
                        .and_then(|place| place.strip_suffix(')'));
                    (groups, inside.unwrap_or(place))
                }
                None => (part, "around"),
            };
            let (groups, place) = match place.chars().all(char::is_alphabetic) {
                true => (groups, place),
                false => (part, "around"),
            };
            let groups = parse_groups(groups)?;
            read.place(place, groups)?;
        }
        read.checked()
    }

    /// The same in parts, each such as `"4 d25"`.
    ///
    /// # Errors
    /// [`BarsError`] with the part that is not understood.
    pub fn rows(top: &str, bottom: &str, sides: Option<&str>) -> Result<Self, BarsError> {
        Self {
            around: Vec::new(),
            top: parse_groups(top)?,
            bottom: parse_groups(bottom)?,
            sides: sides.map_or(Ok(Vec::new()), parse_groups)?,
        }
        .checked()
    }

    fn place(&mut self, place: &str, groups: Vec<Group>) -> Result<(), BarsError> {
        match place {
            "around" => self.around.extend(groups),
            "top" => self.top.extend(groups),
            "bottom" => self.bottom.extend(groups),
            "sides" => self.sides.extend(groups),
            other => {
                return Err(BarsError(format!(
                    "\"{other}\" is no place for bars; available: top, bottom, sides, or none for all around"
                )));
            }
        }
        Ok(())
    }

    fn checked(self) -> Result<Self, BarsError> {
        let count = |groups: &[Group]| groups.iter().map(|group| group.count).sum::<usize>();
        let around = count(&self.around);
        if around + count(&self.top) + count(&self.bottom) + count(&self.sides) > MOST_BARS {
            return Err(BarsError(format!(
                "more than {MOST_BARS} bars in a section"
            )));
        }
        let rows = !self.top.is_empty() || !self.bottom.is_empty() || !self.sides.is_empty();
        if around > 0 {
            if rows {
                return Err(BarsError("some bars go around the section, others to the top, the bottom or the sides; write one or the other".to_owned()));
            }
            if self.around.len() > 1 {
                return Err(BarsError("bars around a section have one diameter; give top, bottom and sides for several".to_owned()));
            }
            if around < 4 || !around.is_multiple_of(2) {
                return Err(BarsError(format!(
                    "bars around a section are an even number, at least four; found {around}"
                )));
            }
        } else if count(&self.top) < 2 || count(&self.bottom) < 2 {
            return Err(BarsError(format!(
                "top and bottom need two bars each; {EXAMPLE}"
            )));
        }
        if !count(&self.sides).is_multiple_of(2) {
            return Err(BarsError(
                "the bars at the sides are an even number, half of them on either face".to_owned(),
            ));
        }
        Ok(self)
    }

    /// Largest diameter \[m\].
    #[must_use]
    pub fn largest_diameter(&self) -> f64 {
        [&self.around, &self.top, &self.bottom, &self.sides]
            .into_iter()
            .flatten()
            .fold(0.0, |largest, group| group.diameter.max(largest))
    }

    /// The bars in a rectangle, `cover` \[m\] of concrete over their surfaces.
    #[must_use]
    pub fn lay(&self, width: f64, depth: f64, cover: f64) -> Vec<Bar> {
        let mut bars = Vec::new();
        let mut row = |groups: &[Group], at: f64, from_top: bool| {
            let diameters: Vec<f64> = spread(groups);
            let last = diameters.len().saturating_sub(1).max(1) as f64;
            for (index, &diameter) in diameters.iter().enumerate() {
                let inset = cover + 0.5 * diameter;
                let inner = cover + 0.5 * at.max(diameter);
                let x = inset + (width - 2.0 * inset) * index as f64 / last;
                let depth = if from_top {
                    inset.max(inner)
                } else {
                    depth - inset.max(inner)
                };
                bars.push(Bar { x, depth, diameter });
            }
        };
        if let [group] = self.around[..] {
            let between = (group.count - 4) / 2;
            let across = (between as f64 * width / (width + depth)).round() as usize;
            let level = Group {
                count: across + 2,
                ..group
            };
            row(&[level], 0.0, true);
            row(&[level], 0.0, false);
            at_sides(
                &mut bars,
                between - across,
                group.diameter,
                width,
                depth,
                cover,
            );
        } else {
            row(&self.top, 0.0, true);
            row(&self.bottom, 0.0, false);
            for group in &self.sides {
                at_sides(
                    &mut bars,
                    group.count / 2,
                    group.diameter,
                    width,
                    depth,
                    cover,
                );
            }
        }
        bars
    }
}

/// Bars of one row: the thickest in the corners, the others between.
fn spread(groups: &[Group]) -> Vec<f64> {
    let mut diameters: Vec<f64> = groups
        .iter()
        .flat_map(|group| std::iter::repeat_n(group.diameter, group.count))
        .collect();
    diameters.sort_by(|a, b| b.total_cmp(a));
    let mut row = std::collections::VecDeque::new();
    for (index, diameter) in diameters.into_iter().rev().enumerate() {
        if index % 2 == 0 {
            row.push_back(diameter);
        } else {
            row.push_front(diameter);
        }
    }
    row.into()
}

/// `levels` pairs of bars, evenly between the rows at top and bottom.
fn at_sides(bars: &mut Vec<Bar>, levels: usize, diameter: f64, width: f64, depth: f64, cover: f64) {
    let inset = cover + 0.5 * diameter;
    for level in 1..=levels {
        let share = level as f64 / (levels + 1) as f64;
        for x in [inset, width - inset] {
            bars.push(Bar {
                x,
                depth: inset + (depth - 2.0 * inset) * share,
                diameter,
            });
        }
    }
}

/// Reads `"2 d25 + 2 d20"`.
pub(crate) fn parse_groups(text: &str) -> Result<Vec<Group>, BarsError> {
    text.split('+')
        .map(|part| parse_group(part.trim()))
        .collect()
}

/// What a diameter in millimetres begins with, and the number of a US bar.
const MARKS: [char; 7] = ['d', 'D', 'φ', 'Φ', 'Ø', 'ø', '#'];

/// Numbers of US bars and their diameters \[in\] (ASTM A615).
const US_BARS: [(&str, f64); 11] = [
    ("3", 0.375),
    ("4", 0.5),
    ("5", 0.625),
    ("6", 0.75),
    ("7", 0.875),
    ("8", 1.0),
    ("9", 1.128),
    ("10", 1.27),
    ("11", 1.41),
    ("14", 1.693),
    ("18", 2.257),
];

/// An inch \[mm\].
const INCH: f64 = 25.4;

/// Size of a bar as it is ordered: `"#8"` if its diameter is that of a US bar, otherwise its millimetres, `"d25"`. `diameter`: in m.
///
/// ```
/// assert_eq!([0.0254, 0.025].map(jostle_section::bar_size), ["#8", "d25"]);
/// ```
#[must_use]
pub fn bar_size(diameter: f64) -> String {
    let millimetres = 1e3 * diameter;
    let is = |(_, inches): &&(&str, f64)| (INCH * inches - millimetres).abs() < 1e-6;
    match US_BARS.iter().find(is) {
        Some((number, _)) => format!("#{number}"),
        None => format!("d{}", (1e6 * millimetres).round() / 1e6),
    }
}

/// Reads `"d25"` or `"#8"`: its diameter \[mm\]; `None` if it is neither.
fn parse_diameter(text: &str) -> Result<Option<f64>, BarsError> {
    if let Some(number) = text.strip_prefix('#') {
        let number = number.trim();
        let known = US_BARS.iter().find(|(name, _)| *name == number);
        return match known {
            Some((_, inches)) => Ok(Some(INCH * inches)),
            None => Err(BarsError(format!(
                "\"{text}\": expected a US bar from #3 to #11, #14 or #18"
            ))),
        };
    }
    let number = text.strip_prefix(MARKS).map(str::trim);
    let number = number.map(|number| number.strip_suffix("mm").unwrap_or(number).trim());
    Ok(number.and_then(|number| number.parse().ok()))
}

/// Reads `"4 d25"` or `"4 #8"`.
fn parse_group(text: &str) -> Result<Group, BarsError> {
    let fault = || {
        let shown: String = text.chars().take(40).collect();
        BarsError(format!("\"{shown}\" is not understood; {EXAMPLE}"))
    };
    let at = text.find(MARKS).ok_or_else(fault)?;
    let (count, bar) = text.split_at(at);
    let count: usize = count.trim().parse().map_err(|_| fault())?;
    let millimetres = parse_diameter(bar)?.ok_or_else(fault)?;
    if count == 0 || count > MOST_BARS || !(4.0..=80.0).contains(&millimetres) {
        return Err(BarsError(format!(
            "\"{text}\": expected 1 to {MOST_BARS} bars of 4 to 80 mm; {EXAMPLE}"
        )));
    }
    Ok(Group {
        count,
        diameter: 1e-3 * millimetres,
    })
}

impl Ties {
    /// Reads `"d10 @ 100 mm"`, `"d10 @100"` or `"#4 @ 4 in"`: two legs in either direction; `"4 d10 @ 100 mm"` has four.
    ///
    /// # Errors
    /// [`BarsError`] with the part that is not understood.
    pub fn parse(text: &str) -> Result<Self, BarsError> {
        let fault = || {
            let shown: String = text.chars().take(40).collect();
            BarsError(format!(
                "\"{shown}\" is not understood; write \"d10 @ 100 mm\" for ties of 10 mm every 100 mm, \"4 d10 @ 100 mm\" with four legs"
            ))
        };
        let (bar, spacing) = text.split_once('@').ok_or_else(fault)?;
        let bar = bar.trim();
        let digits = bar.len() - bar.trim_start_matches(|c: char| c.is_ascii_digit()).len();
        let (legs, bar) = bar.split_at(digits);
        let legs = if legs.is_empty() {
            2
        } else {
            legs.parse::<usize>().map_err(|_| fault())?
        };
        let diameter = parse_diameter(bar.trim())?.ok_or_else(fault)?;
        let spacing = spacing.trim();
        let (spacing, unit) = match spacing.strip_suffix("in") {
            Some(inches) => (inches, INCH),
            None => (spacing.strip_suffix("mm").unwrap_or(spacing), 1.0),
        };
        let spacing = unit * spacing.trim().parse::<f64>().map_err(|_| fault())?;
        if !(4.0..=40.0).contains(&diameter) || !(20.0..=1000.0).contains(&spacing) {
            return Err(BarsError(format!(
                "\"{text}\": expected ties of 4 to 40 mm every 20 to 1000 mm"
            )));
        }
        if !(2..=MOST_LEGS).contains(&legs) {
            return Err(BarsError(format!(
                "\"{text}\": expected 2 to {MOST_LEGS} legs, found {legs}"
            )));
        }
        Ok(Self {
            diameter: 1e-3 * diameter,
            spacing: 1e-3 * spacing,
            legs,
        })
    }

    /// Cross-section of all legs in one direction \[m²\].
    #[must_use]
    pub fn area(&self) -> f64 {
        self.legs as f64 * (0.25 * std::f64::consts::PI * self.diameter * self.diameter)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn bars_around_a_square_lie_evenly() {
        let bars = Reinforcement::parse("12 d20")
            .expect("understood")
            .lay(0.5, 0.5, 0.03);
        assert_eq!(bars.len(), 12);
        for written in ["12 d20 around", "12 d20 (around)"] {
            let same = Reinforcement::parse(written).expect("understood");
            assert_eq!(same.lay(0.5, 0.5, 0.03), bars, "{written}");
        }
        assert!(Reinforcement::parse("12 d20 (round)").is_err());
        assert!(Reinforcement::parse("12 d20 (around").is_err());
        let levels = [0.04, 0.18, 0.32, 0.46];
        for (level, due) in levels.into_iter().zip([4, 2, 2, 4]) {
            let here = bars.iter().filter(|bar| (bar.depth - level).abs() < 1e-12);
            assert_eq!(here.count(), due, "at {level}");
        }
    }

    #[test]
    fn rows_hold_what_they_are_given() {
        let written = Reinforcement::parse("2 d25 + 2 d20 top, 4 d20 bottom, 4 d12 sides");
        let bars = written.expect("understood").lay(0.3, 0.6, 0.03);
        assert_eq!(bars.len(), 12);
        let area = |low: f64, high: f64| -> f64 {
            let within = bars.iter().filter(|bar| (low..high).contains(&bar.depth));
            within.map(Bar::area).sum()
        };
        let circle = |d: f64| 0.25 * std::f64::consts::PI * d * d;
        assert!((area(0.0, 0.1) - 2.0 * circle(0.025) - 2.0 * circle(0.02)).abs() < 1e-12);
        assert!((area(0.5, 0.6) - 4.0 * circle(0.02)).abs() < 1e-12);
        assert!((area(0.1, 0.5) - 4.0 * circle(0.012)).abs() < 1e-12);
        // The thick bars of the top row are its outermost.
        assert_eq!(bars[0].diameter, 0.025);
        assert_eq!(bars[3].diameter, 0.025);
    }

    /// A No. 8 bar has a diameter of one inch; areas of ASTM A615 are rounded to 0.01 in².
    #[test]
    fn us_bars_have_the_areas_of_their_standard() {
        let inch = 0.0254;
        for (number, area) in [
            (3, 0.11),
            (4, 0.20),
            (8, 0.79),
            (9, 1.0),
            (11, 1.56),
            (18, 4.0),
        ] {
            let bars = Reinforcement::parse(&format!("8 #{number}")).expect("understood");
            let lay = bars.lay(0.6, 0.6, 0.04);
            assert_eq!(lay.len(), 8);
            assert!(
                (lay[0].area() / (inch * inch) - area).abs() < 0.006,
                "#{number}"
            );
        }
        let ties = Ties::parse("4 #4 @ 4 in").expect("understood");
        assert_eq!(ties.legs, 4);
        assert!(
            (ties.diameter - 0.5 * inch).abs() < 1e-15 && (ties.spacing - 4.0 * inch).abs() < 1e-15
        );
        for text in ["8 #2", "8 #12", "8 #"] {
            let error = Reinforcement::parse(text).expect_err(text).to_string();
            assert!(error.contains("#3 to #11"), "{text}: {error}");
        }
    }

    #[test]
    fn mistakes_are_explained() {
        for (text, word) in [
            ("", "not understood"),
            ("12", "not understood"),
            ("5 d20", "even number"),
            ("4 d20 left", "no place"),
            ("4 d20 top", "two bars each"),
            ("4 d20, 4 d20 top", "one or the other"),
            ("4 d200", "4 to 80 mm"),
            ("999999999999999999999 d20", "not understood"),
        ] {
            let error = Reinforcement::parse(text).expect_err(text).to_string();
            assert!(error.contains(word), "{text}: {error}");
        }
        assert!(Ties::parse("d10 @ 100 mm").is_ok());
        assert!(Ties::parse("10/100").is_err());
        let four = Ties::parse("4 d10 @ 100 mm").expect("understood");
        assert_eq!(four.legs, 4);
        assert_eq!(Ties::parse("4d10@100").ok(), Some(four));
        for text in ["1 d10 @ 100 mm", "0 d10 @ 100 mm", "99 d10 @ 100 mm"] {
            let error = Ties::parse(text).expect_err(text).to_string();
            assert!(error.contains("legs"), "{error}");
        }
    }
}
