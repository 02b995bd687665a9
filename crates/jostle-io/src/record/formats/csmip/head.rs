//! The header of a CSMIP channel.

use super::FORMAT;
use crate::quantity::shorten;
use crate::record::channel::Direction;
use crate::record::contents::{Peak, Trace, named_unit};
use crate::record::error::RecordError;
use crate::record::fixed::{Block, Fixed};
use crate::record::header::{find_phrase, malformed, word_after};
use crate::record::lines::{Line, Lines, printed};

/// Lines of text of a channel.
const TEXT_UNCORRECTED: usize = 13;
const TEXT_CORRECTED: usize = 25;

/// The text and the reals above the values of a channel.
pub(super) struct Head {
    pub(super) corrected: bool,
    pub(super) text: Vec<String>,
    pub(super) first_line: usize,
    pub(super) reals: Vec<f64>,
}

impl Head {
    pub(super) fn read(lines: &mut Lines<'_>, first: &Line<'_>) -> Result<Self, RecordError> {
        if find_phrase(&first.text, "amplitude spectra").is_some() {
            return Err(RecordError::NotAcceleration {
                format: FORMAT,
                found: "spectra (volume 3)".into(),
                remedy: "; take the corrected record (volume 2)",
            });
        }
        let uncorrected = find_phrase(&first.text, "uncorrected accelerogram").is_some();
        let corrected =
            !uncorrected && find_phrase(&first.text, "corrected accelerogram").is_some();
        if !uncorrected && !corrected {
            let problem = format!(
                "expected the first line of a channel, \"Corrected accelerogram …\", found \"{}\"",
                shorten(first.text.trim())
            );
            return Err(malformed(FORMAT, first.number, problem));
        }
        let (count, reals) = if corrected {
            (TEXT_CORRECTED, 100)
        } else {
            (TEXT_UNCORRECTED, 50)
        };
        let mut text = vec![first.text.clone().into_owned()];
        text.extend(lines.take(count - 1).map(|line| line.text.into_owned()));
        if text.len() < count {
            return Err(malformed(
                FORMAT,
                lines.number(),
                "the file ends in its lines of text",
            ));
        }
        // Header numbers are used only for the peak; some files print stars.
        Fixed::integers(16, 5).read(lines, 100, FORMAT)?;
        let reals = Fixed::reals(8, 10).read(lines, reals, FORMAT)?.values;
        Ok(Self {
            corrected,
            text,
            first_line: first.number,
            reals,
        })
    }

    /// Text line of an uncorrected record; corrected ones have one line before.
    pub(super) fn line(&self, number: usize) -> &str {
        let number = number + usize::from(self.corrected);
        self.text.get(number - 1).map_or("", |line| line.trim())
    }

    pub(super) fn station(&self) -> String {
        self.line(6).split("   ").next().unwrap_or("").to_owned()
    }

    pub(super) fn event(&self) -> String {
        self.line(2).split("   ").next().unwrap_or("").to_owned()
    }

    pub(super) fn date(&self) -> String {
        let line = self.line(4);
        find_phrase(line, "time:")
            .map_or("", |at| line[at..].trim())
            .to_owned()
    }

    /// `Chan  1: 360 Deg` as its name.
    pub(super) fn channel(&self) -> String {
        let line = self.line(7);
        let label = line.split_once(':').map_or(line, |(_, label)| label);
        label
            .split("   ")
            .find(|part| !part.trim().is_empty())
            .unwrap_or("")
            .trim()
            .to_owned()
    }

    /// The line of the text with a phrase, with its number in the file.
    pub(super) fn find(&self, phrase: &str) -> Option<(&str, usize)> {
        let at = self
            .text
            .iter()
            .position(|line| find_phrase(line, phrase).is_some())?;
        Some((&self.text[at], self.first_line + at))
    }

    /// A peak such as `Peak acceleration =    77.280    cm/sec/sec  at   30.585   sec.`
    pub(super) fn peak(&self, phrase: &str) -> Result<Peak, RecordError> {
        let missing = || {
            let problem =
                format!("the text states no peak, as in \"{phrase} 77.280 … at 30.585 sec\"");
            malformed(FORMAT, self.first_line, problem)
        };
        let (text, line) = self.find(phrase).ok_or_else(missing)?;
        let (value, digit) = word_after(text, phrase)
            .and_then(printed)
            .ok_or_else(missing)?;
        // Behind the phrase: "acceleration" has letters in common with "at".
        let behind = find_phrase(text, phrase).map_or("", |at| &text[at..]);
        let time = word_after(behind, "at").map(|word| word.trim_end_matches("sec."));
        Ok(Peak {
            value,
            digit,
            line,
            time: time.and_then(printed),
        })
    }

    pub(super) fn trace(&self, unit: (String, f64), step: f64, peak: Peak, block: Block) -> Trace {
        let name = self.channel();
        Trace {
            direction: Direction::parse(&name),
            name,
            unit: Some(unit),
            step: Some(step),
            values: block.values,
            lines: block.lines,
            peak: Some(peak),
        }
    }
}

/// `12000 points of accel data equally spaced at  .005 sec, in cm/sec2. (8f10.6)`.
pub(super) struct BlockHeader {
    pub(super) line: usize,
    pub(super) text: String,
    pub(super) count: usize,
    pub(super) step: f64,
    pub(super) fixed: Fixed,
}

impl BlockHeader {
    pub(super) fn read(
        lines: &mut Lines<'_>,
        phrase: &str,
        what: &str,
    ) -> Result<Self, RecordError> {
        let end = lines.number();
        let line = lines.next();
        let (line, text) = line.map_or((end, String::new()), |l| (l.number, l.text.into_owned()));
        let bad = |problem: String| malformed(FORMAT, line, problem);
        let expected = || {
            let found = shorten(text.trim());
            bad(format!(
                "expected the line above the {what}, such as \"12000 {phrase} equally spaced at .005 sec, in cm/sec2. (8f10.6)\", found \"{found}\""
            ))
        };
        find_phrase(&text, phrase).ok_or_else(expected)?;
        let count = text
            .split_whitespace()
            .next()
            .and_then(|word| word.parse().ok());
        let step = word_after(&text, "equally spaced at").and_then(|word| word.parse().ok());
        let (Some(count), Some(step)) = (count, step.filter(|step: &f64| *step > 0.0)) else {
            return Err(expected());
        };
        // Old files state (UNITS: …) and print eight numbers on a line; all others name their format.
        let old = find_phrase(&text, "(units:").is_some();
        let fixed = Fixed::parse(&text).or_else(|| old.then(|| eight_on(lines, count)));
        let fixed = fixed.ok_or_else(|| {
            bad("the line states no format of the values, such as (8f10.6)".into())
        })?;
        Ok(Self {
            line,
            text,
            count,
            step,
            fixed,
        })
    }

    pub(super) fn unit(&self) -> Result<(String, f64), RecordError> {
        let unit = word_after(&self.text, "units:").or_else(|| word_after(&self.text, "sec, in"));
        unit_of(unit.unwrap_or(""), self.line)
    }
}

/// Eight numbers on a line, in columns as wide as the next line shows: 10 for cm/s², 9 for g.
fn eight_on(lines: &Lines<'_>, count: usize) -> Fixed {
    let next = lines.clone().next();
    let length = next.map_or(0, |line| line.text.len());
    let on_line = count.clamp(1, 8);
    let width = length / on_line;
    if length.is_multiple_of(on_line) && (7..=15).contains(&width) {
        Fixed::reals(8, width)
    } else {
        Fixed::reals(8, 10)
    }
}

pub(super) fn unit_of(text: &str, line: usize) -> Result<(String, f64), RecordError> {
    let name = text.trim_matches(|c: char| matches!(c, '.' | ',' | '(' | ')'));
    named_unit(name).ok_or_else(|| RecordError::Unit {
        line,
        found: shorten(name),
    })
}
