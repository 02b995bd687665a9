//! USGS SMC: a line with the kind of data, ten lines of text, 48 integers, 50 reals, comments, values.
//!
//! Layout: USGS National Strong-Motion Program, "SMC- and BBF-format data files". Accelerations are in cm/s² by
//! definition; values fill columns of ten and run together.

use crate::quantity::shorten;
use crate::record::RecordOptions;
use crate::record::channel::Direction;
use crate::record::contents::{Contents, Peak, Scale, Trace, named_unit};
use crate::record::error::RecordError;
use crate::record::film::Film;
use crate::record::fixed::Fixed;
use crate::record::formats::RecordFormat;
use crate::record::header::{malformed, word_after};
use crate::record::lines::{Lines, printed};

const FORMAT: RecordFormat = RecordFormat::Smc;
/// Lines of text, with the first.
const TEXT_LINES: usize = 11;
/// Reals above this are not stated.
const UNKNOWN: f64 = 1e38;

pub(crate) fn read(bytes: &[u8], options: &RecordOptions) -> Result<Contents, RecordError> {
    let mut lines = Lines::new(bytes);
    let text: Vec<String> = (&mut lines)
        .take(TEXT_LINES)
        .map(|line| line.text.trim().to_owned())
        .collect();
    if text.len() < TEXT_LINES {
        return Err(malformed(
            FORMAT,
            text.len(),
            "the file ends in its lines of text",
        ));
    }
    check_kind(&text[0])?;
    let integers = Fixed::integers(8, 10).read(&mut lines, 48, FORMAT)?.values;
    let reals_line = lines.number() + 1;
    let reals = Fixed::reals(5, 15).read(&mut lines, 50, FORMAT)?.values;
    let integer = |number: usize| integers[number - 1];
    let real = |number: usize| Some(reals[number - 1]).filter(|value| value.abs() < UNKNOWN);
    let count = |number: usize, what: &str| {
        let value = integer(number);
        let fits = (0.0..1e9).contains(&value);
        fits.then_some(value as usize).ok_or_else(|| {
            let problem = format!("integer {number}, {what}, is {value}");
            malformed(FORMAT, TEXT_LINES + 1, problem)
        })
    };

    for _ in 0..count(16, "the number of comments")? {
        let line = lines.next();
        let number = line.as_ref().map_or(lines.number(), |line| line.number);
        if !line.is_some_and(|line| line.text.starts_with('|')) {
            let problem = "expected a comment beginning with |, as integer 16 announces";
            return Err(malformed(FORMAT, number, problem));
        }
    }
    let points = count(17, "the number of values")?;
    let extremes = [(real(29), real(30)), (real(31), real(32))];
    let mut peak = peak(&text, extremes, reals_line + 5);
    let fixed = Fixed::reals(8, 10);
    let (step, block) = match real(2).filter(|rate| *rate > 0.0) {
        Some(rate) => (1.0 / rate, fixed.read(&mut lines, points, FORMAT)?),
        // Without samples per second, the values are pairs of time and acceleration.
        None => {
            if points % 2 == 1 {
                let problem = "real 2 states no samples per second, and the number of values is odd: these are no pairs of time and acceleration";
                return Err(malformed(FORMAT, reals_line, problem));
            }
            let film = Film::read(&mut lines, points / 2, fixed, FORMAT)?;
            // Interpolation may cut the peak.
            if let Some(peak) = peak.take() {
                film.check_peak(peak, FORMAT)?;
            }
            film.equally_spaced(options)?
        }
    };
    if let Some(line) = lines.find(|line| !line.text.is_empty()) {
        let problem = "more values than integer 17 announces";
        return Err(malformed(FORMAT, line.number, problem));
    }

    let mut contents = Contents::new(FORMAT, Scale::Stated);
    contents.station = station(&text);
    contents.event = text[3]
        .split_whitespace()
        .skip(4)
        .collect::<Vec<_>>()
        .join(" ");
    contents.date = text[3]
        .split_whitespace()
        .take(4)
        .collect::<Vec<_>>()
        .join(" ");
    let azimuth = integer(14);
    contents.traces.push(Trace {
        direction: direction(integer(13), azimuth),
        name: word_after(&text[5], "component")
            .map_or_else(|| format!("{azimuth:.0}"), str::to_owned),
        unit: named_unit("cm/s2"),
        step: Some(step),
        values: block.values,
        lines: block.lines,
        peak,
    });
    Ok(contents)
}

/// Only accelerations are a record.
fn check_kind(first: &str) -> Result<(), RecordError> {
    let kind = first.split_whitespace().next().unwrap_or("");
    let found = match kind {
        "1" | "2" => return Ok(()),
        "3" => "velocities",
        "4" => "displacements",
        "5" | "6" => "spectra",
        _ => {
            let problem = format!(
                "expected a kind of data such as \"2 CORRECTED ACCELEROGRAM\", found \"{}\"",
                shorten(first)
            );
            return Err(malformed(FORMAT, 1, problem));
        }
    };
    Err(RecordError::NotAcceleration {
        format: FORMAT,
        found: found.into(),
        remedy: "; take the file of the corrected accelerogram",
    })
}

/// The larger extreme of the reals, each a time and a value, or the peak of the text.
fn peak(text: &[String], extremes: [(Option<f64>, Option<f64>); 2], line: usize) -> Option<Peak> {
    if let [(at_greatest, Some(greatest)), (at_least, Some(least))] = extremes {
        let (time, value) = if least.abs() > greatest.abs() {
            (at_least, least)
        } else {
            (at_greatest, greatest)
        };
        return Some(Peak {
            value,
            // Seven digits in the header, five in the values.
            digit: 1e-4 * value.abs(),
            line,
            time: time.map(|time| (time, 1e-5 * time)),
        });
    }
    let stated = text.get(6).and_then(|line| word_after(line, "pk"));
    stated.and_then(printed).map(|(value, digit)| Peak {
        value,
        digit,
        line: 7,
        time: None,
    })
}

fn station(text: &[String]) -> String {
    let line = text.get(5).map_or("", String::as_str);
    let name = line.split_once('=').map_or(line, |(_, rest)| rest);
    let name = name.split("component").next().unwrap_or(name);
    let name: Vec<_> = name.split_whitespace().collect();
    name.join(" ").trim_end_matches(',').to_owned()
}

/// Angle from the vertical, and azimuth from north.
fn direction(vertical: f64, azimuth: f64) -> Direction {
    if vertical == 0.0 || vertical == 180.0 {
        Direction::Vertical
    } else if (0.0..=360.0).contains(&azimuth) {
        Direction::Azimuth(azimuth % 360.0)
    } else {
        Direction::Unknown
    }
}
