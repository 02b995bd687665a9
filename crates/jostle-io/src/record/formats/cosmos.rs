//! COSMOS strong-motion data format, version 1.20 (V1c, V2c): text lines, integers, reals and comments, all
//! counted in the file, then one block of values; several channels may follow each other.
//!
//! Layout: COSMOS Strong Motion Programs Board (2001), "COSMOS strong motion data format", version 1.20.

use crate::quantity::shorten;
use crate::record::channel::Direction;
use crate::record::contents::{Contents, Peak, Scale, Trace, named_unit};
use crate::record::error::RecordError;
use crate::record::fixed::Fixed;
use crate::record::formats::RecordFormat;
use crate::record::header::{agree, find_phrase, malformed, word_after};
use crate::record::lines::Lines;

const FORMAT: RecordFormat = RecordFormat::Cosmos;
const MOST_CHANNELS: usize = 256;
/// Text lines, or header numbers, at most.
const MOST: usize = 2000;

pub(crate) fn read(bytes: &[u8]) -> Result<Contents, RecordError> {
    let mut lines = Lines::new(bytes);
    let mut contents = Contents::new(FORMAT, Scale::Stated);
    let mut other = None;
    while let Some(first) = lines.find(|line| !line.text.is_empty()) {
        let (number, first) = (first.number, first.text.into_owned());
        let header = Header::read(&mut lines, number, &first)?;
        if contents.traces.len() == MOST_CHANNELS {
            let problem = format!("more than {MOST_CHANNELS} channels");
            return Err(malformed(FORMAT, number, problem));
        }
        if contents.station.is_empty() {
            contents.station = word_after(header.line(4), "code:").unwrap_or("").to_owned();
            contents.event = header.line(1).to_owned();
            let date = header.line(7).split_once(':').map_or("", |(_, date)| date);
            date.split('(')
                .next()
                .unwrap_or(date)
                .trim()
                .clone_into(&mut contents.date);
        }
        match header.block(&mut lines)? {
            Found::Acceleration(trace, scale) => {
                contents.scale = scale;
                contents.traces.push(trace);
            }
            Found::Other(what) => other = Some(what),
        }
    }
    match other {
        Some(found) if contents.traces.is_empty() => Err(RecordError::NotAcceleration {
            format: FORMAT,
            found,
            remedy: "; take the file whose name has .acc.",
        }),
        _ if contents.traces.is_empty() => Err(RecordError::TooFew { found: 0 }),
        _ => Ok(contents),
    }
}

/// Quantity of a block of values.
enum Found {
    Acceleration(Trace, Scale),
    Other(String),
}

struct Header {
    text: Vec<String>,
    integers: Vec<f64>,
    reals: Vec<f64>,
    reals_line: usize,
    /// Value for "not stated".
    unknown: f64,
    comments: Vec<String>,
}

impl Header {
    fn read(lines: &mut Lines<'_>, number: usize, first: &str) -> Result<Self, RecordError> {
        let count = counted(number, first, "with", "(Format v01.20 with 13 text lines)")?;
        let mut text = vec![first.to_owned()];
        text.extend(
            lines
                .take(count.saturating_sub(1))
                .map(|line| line.text.into_owned()),
        );
        if find_phrase(first, "text lines)").is_none() || text.len() != count || count < 13 {
            let problem = "expected \"(Format v01.20 with 13 text lines)\" and these lines";
            return Err(malformed(FORMAT, number, problem));
        }
        let unknown = text[count - 1].rsplit([',', ':']).next().unwrap_or("");
        let unknown = unknown.trim().parse().unwrap_or(-999.0);
        let integers = numbers(lines, "Integer-header values follow")?;
        let reals_line = lines.number() + 1;
        let reals = numbers(lines, "Real-header values follow")?;
        let (line, comments) = next(lines)?;
        let count = counted(line, &comments, "", "6 Comment line(s) follow")?;
        let mut found = Vec::with_capacity(count.min(64));
        for _ in 0..count {
            let (line, comment) = next(lines)?;
            if !comment.trim_start().starts_with('|') {
                return Err(malformed(
                    FORMAT,
                    line,
                    "expected a comment beginning with |",
                ));
            }
            found.push(comment);
        }
        Ok(Self {
            text,
            integers,
            reals,
            reals_line,
            unknown,
            comments: found,
        })
    }

    fn line(&self, at: usize) -> &str {
        self.text.get(at).map_or("", String::as_str)
    }

    /// A real by its number in the specification, unless it is unknown.
    fn real(&self, number: usize) -> Option<f64> {
        let value = self.reals.get(number - 1).copied()?;
        (value != self.unknown && value != -999.0).then_some(value)
    }

    /// Reads `42000 acceleration pts, approx  210 secs, units=cm/sec2(04),Format=(1E15.6)` and the values.
    fn block(&self, lines: &mut Lines<'_>) -> Result<Found, RecordError> {
        let (line, text) = next(lines)?;
        let expected =
            "42000 acceleration pts, approx 210 secs, units=cm/sec2(04), Format=(8F10.5)";
        let count = counted(line, &text, "", expected)?;
        let bad = || {
            malformed(
                FORMAT,
                line,
                format!("expected a line such as \"{expected}\""),
            )
        };
        let kind = text
            .split_whitespace()
            .nth(1)
            .ok_or_else(bad)?
            .to_lowercase();
        find_phrase(&text, "pts").ok_or_else(bad)?;
        let unit = word_after(&text, "units=").ok_or_else(bad)?;
        let unit = unit.split('(').next().unwrap_or(unit).to_owned();
        let format = find_phrase(&text, "format=").and_then(|at| Fixed::parse(&text[at..]));
        let format = format.ok_or_else(|| {
            malformed(
                FORMAT,
                line,
                "the line states no format of the values, such as Format=(8F10.5)",
            )
        })?;
        let step = self.step(line, &text, count)?;
        let block = format.read(lines, count, FORMAT)?;
        self.end(lines)?;
        if !kind.starts_with("accel") {
            return Ok(Found::Other(format!(
                "{} in {}",
                shorten(&kind),
                shorten(&unit)
            )));
        }
        let named = named_unit(&unit);
        let counts = unit.to_lowercase().starts_with("count");
        if named.is_none() && !counts {
            return Err(RecordError::Unit {
                line,
                found: shorten(&unit),
            });
        }
        // Counts may happen to be that number.
        if let Some(at) = block
            .values
            .iter()
            .position(|value| !counts && *value == self.unknown)
        {
            let problem = format!("a value of {} means that it is unknown", self.unknown);
            return Err(malformed(FORMAT, block.lines.line_of(at), problem));
        }
        let peak = self.real(64).map(|value| Peak {
            value,
            // The digits in which reals and values are printed.
            digit: 1e-5 * value.abs() + 1e-6,
            line: self.reals_line,
            time: self.real(65).map(|time| (time, 0.001)),
        });
        let scale = if counts { Scale::Counts } else { Scale::Stated };
        let (name, direction) = self.direction();
        let trace = Trace {
            name,
            direction,
            unit: named,
            step: Some(step),
            values: block.values,
            lines: block.lines,
            peak: peak.filter(|_| !counts),
        };
        Ok(Found::Acceleration(trace, scale))
    }

    /// Real 62 is the step of the values in milliseconds; real 34 is that of the raw record.
    fn step(&self, line: usize, text: &str, count: usize) -> Result<f64, RecordError> {
        let step = self
            .real(62)
            .map(|step| 1e-3 * step)
            .filter(|step| *step > 0.0);
        let step = step.ok_or_else(|| {
            let problem = "real 62, the time step of the values in milliseconds, is not stated";
            malformed(FORMAT, self.reals_line, problem)
        })?;
        let length = count as f64 * step;
        // "approx" rounds to whole seconds.
        if let Some(approx) = word_after(text, "approx").and_then(|word| word.parse::<f64>().ok()) {
            agree(FORMAT, line, "the length in s", approx, length, 1.0 + step)?;
        }
        if let Some(stated) = self.real(63) {
            let allowed = 1.01 * step + 1e-3 * length;
            agree(
                FORMAT,
                self.reals_line,
                "the length in s",
                stated,
                length,
                allowed,
            )?;
        }
        Ok(step)
    }

    /// `End-of-data for …` or `/&`; the last line of a file may lack.
    fn end(&self, lines: &mut Lines<'_>) -> Result<(), RecordError> {
        let Some(line) = lines.find(|line| !line.text.is_empty()) else {
            let problem = "the file ends without its line \"End-of-data\"";
            return Err(malformed(FORMAT, lines.number(), problem));
        };
        let text = line.text.trim_start();
        if find_phrase(text, "end-of-data").is_some() || text.starts_with("/&") {
            return Ok(());
        }
        let problem = format!(
            "expected \"End-of-data\" behind the values, found \"{}\"",
            shorten(text)
        );
        Err(malformed(FORMAT, line.number, problem))
    }

    /// Integer 54 is the azimuth or a code; otherwise the SEED channel code in the comments is used.
    fn direction(&self) -> (String, Direction) {
        let code = self.comments.iter().find_map(|comment| {
            let scnl = comment.split_once("<SCNL>")?.1.split_whitespace().next()?;
            Some(scnl.split('.').nth(1)?.to_owned())
        });
        let azimuth = self.integers.get(53).copied().unwrap_or(self.unknown);
        let direction = match azimuth {
            a if (1.0..=360.0).contains(&a) => Direction::Azimuth(a % 360.0),
            400.0..=402.0 => Direction::Vertical,
            500.0..=703.0 => Direction::Horizontal,
            _ => code
                .as_deref()
                .map_or(Direction::Unknown, Direction::of_channel_code),
        };
        let name = match code {
            Some(code) => code,
            None => {
                // `Sta Cha:  1: 340 deg (Rcrdr Chan  1) Location: …`
                let line = self.line(8).split('(').next().unwrap_or("");
                line.rsplit(':').next().unwrap_or("").trim().to_owned()
            }
        };
        (name, direction)
    }
}

fn next(lines: &mut Lines<'_>) -> Result<(usize, String), RecordError> {
    let end = lines.number();
    let line = lines.next();
    line.map(|line| (line.number, line.text.into_owned()))
        .ok_or_else(|| malformed(FORMAT, end, "the file ends in its header"))
}

/// The whole number after a phrase, or at the start of a line.
fn counted(line: usize, text: &str, phrase: &str, expected: &str) -> Result<usize, RecordError> {
    let word = match phrase {
        "" => text.split_whitespace().next(),
        _ => word_after(text, phrase),
    };
    word.and_then(|word| word.parse().ok())
        .filter(|count| *count <= 1_000_000_000)
        .ok_or_else(|| {
            let found = shorten(text);
            let problem = format!("expected a line such as \"{expected}\", found \"{found}\"");
            malformed(FORMAT, line, problem)
        })
}

/// A header line such as `100 Real-header values follow on  20 lines, Format= (5F15.6)`, and the numbers.
fn numbers(lines: &mut Lines<'_>, phrase: &str) -> Result<Vec<f64>, RecordError> {
    let (line, text) = next(lines)?;
    let expected = format!("100 {phrase} on 10 lines, Format= (10I8)");
    let count = counted(line, &text, "", &expected)?;
    let format = find_phrase(&text, phrase).and_then(|_| Fixed::parse(&text));
    let (Some(format), true) = (format, count <= MOST) else {
        let problem = format!("expected a line such as \"{expected}\"");
        return Err(malformed(FORMAT, line, problem));
    };
    Ok(format.read(lines, count, FORMAT)?.values)
}
