//! CSMIP and CDMG volumes: 1 (uncorrected) and 2 (corrected), with several channels in a file.
//!
//! A channel has 13 or 25 lines of text, 100 integers, 50 or 100 reals, then blocks of values. Uncorrected film
//! records have pairs of time and acceleration instead. Volume 3 holds spectra and is refused.
//!
//! Layout: Shakal and Huang (1985), "Standard tape format for CSMIP strong-motion data tapes", report OSMS 85-03.

mod head;

use crate::quantity::shorten;
use crate::record::RecordOptions;
use crate::record::contents::{Contents, Peak, Scale, Trace};
use crate::record::error::RecordError;
use crate::record::film::Film;
use crate::record::fixed::Fixed;
use crate::record::formats::RecordFormat;
use crate::record::header::{agree, find_phrase, malformed, word_after};
use crate::record::lines::{Line, Lines};

use head::{BlockHeader, Head, unit_of};

const FORMAT: RecordFormat = RecordFormat::Csmip;
/// Five pairs of time and acceleration on a line of film.
const FILM: Fixed = Fixed::reals(10, 7);
const MOST_CHANNELS: usize = 256;

pub(crate) fn read(bytes: &[u8], options: &RecordOptions) -> Result<Contents, RecordError> {
    let mut lines = Lines::new(bytes);
    let mut contents = Contents::new(FORMAT, Scale::Stated);
    let mut next = lines.find(|line| !line.text.is_empty());
    while let Some(first) = next {
        if contents.traces.len() == MOST_CHANNELS {
            let problem = format!("more than {MOST_CHANNELS} channels");
            return Err(malformed(FORMAT, first.number, problem));
        }
        let head = Head::read(&mut lines, &first)?;
        if contents.traces.is_empty() {
            contents.station = head.station();
            contents.event = head.event();
            contents.date = head.date();
        }
        let trace = if head.corrected {
            corrected(&mut lines, &head)?
        } else {
            uncorrected(&mut lines, &head, options)?
        };
        contents.traces.push(trace);
        next = end(&mut lines)?;
    }
    if contents.traces.is_empty() {
        return Err(malformed(FORMAT, 0, "the file is empty"));
    }
    Ok(contents)
}

/// Skips the end mark; the first line of the next channel, if there is one.
fn end<'t>(lines: &mut Lines<'t>) -> Result<Option<Line<'t>>, RecordError> {
    let next = lines.find(|line| !line.text.is_empty());
    match next {
        Some(line) if line.text.trim_start().starts_with("/&") => {
            Ok(lines.find(|line| !line.text.is_empty()))
        }
        Some(line) if find_phrase(&line.text, "accelerogram").is_none() => {
            let found = shorten(line.text.trim());
            let problem =
                format!("expected \"/& End of data\" behind the values, found \"{found}\"");
            Err(malformed(FORMAT, line.number, problem))
        }
        next => Ok(next),
    }
}

/// Above equally spaced accelerations.
const EQUAL_POINTS: &str = "points of accel data";

/// The three blocks of a corrected record; velocities and displacements are only checked to be there.
fn corrected(lines: &mut Lines<'_>, head: &Head) -> Result<Trace, RecordError> {
    let accelerations = BlockHeader::read(lines, EQUAL_POINTS, "accelerations")?;
    let unit = accelerations.unit()?;
    let peak = head.peak("Peak acceleration =")?;
    let step = accelerations.step;
    if let Some((text, line)) = head.find("equally-spaced intervals of") {
        let stated = word_after(text, "equally-spaced intervals of").and_then(|w| w.parse().ok());
        agree(
            FORMAT,
            line,
            "the time step",
            stated.unwrap_or(f64::NAN),
            step,
            1e-6 * step,
        )?;
    }
    if let Some(stated) = head.reals.get(60).filter(|stated| **stated > 0.0) {
        let line = accelerations.line - 1;
        agree(FORMAT, line, "the time step", *stated, step, 1e-3 * step)?;
    }
    let block = accelerations
        .fixed
        .read(lines, accelerations.count, FORMAT)?;
    for (phrase, what) in [
        ("points of veloc data", "velocities"),
        ("points of displ data", "displacements"),
    ] {
        let header = BlockHeader::read(lines, phrase, what)?;
        header.fixed.read(lines, header.count, FORMAT)?;
    }
    Ok(head.trace(unit, step, peak, block))
}

/// Equally spaced values below `13200 Accelerogram points at 200 pts/sec in units of g . Format: (8f9.6)` or
/// `12001 POINTS OF ACCEL DATA EQUALLY SPACED AT .005 SEC.  (UNITS: G)`, or pairs of time and acceleration without
/// such a line.
fn uncorrected(
    lines: &mut Lines<'_>,
    head: &Head,
    options: &RecordOptions,
) -> Result<Trace, RecordError> {
    let peak = head.peak("Max =")?;
    let (text, text_line) = head
        .find("no. of points =")
        .unwrap_or(("", head.first_line));
    let count = word_after(text, "no. of points =").and_then(|word| word.parse::<usize>().ok());
    let count = count.ok_or_else(|| {
        malformed(
            FORMAT,
            head.first_line,
            "expected \"No. of points = …\" in the text",
        )
    })?;
    let length = word_after(text, "record length =").and_then(|word| word.parse::<f64>().ok());

    let mut ahead = lines.clone();
    let line = ahead.next();
    let (number, title) = line.map_or((0, String::new()), |l| (l.number, l.text.into_owned()));
    if find_phrase(&title, "accelerogram points at").is_some() {
        *lines = ahead;
        let bad = |problem: &str| malformed(FORMAT, number, problem);
        let stated = title
            .split_whitespace()
            .next()
            .and_then(|word| word.parse::<usize>().ok());
        let stated = stated.ok_or_else(|| bad("expected the number of points"))?;
        agree(
            FORMAT,
            number,
            "the number of values",
            count as f64,
            stated as f64,
            0.0,
        )?;
        let rate = word_after(&title, "points at").and_then(|word| word.parse::<f64>().ok());
        let rate = rate
            .filter(|r| *r > 0.0)
            .ok_or_else(|| bad("expected points per second"))?;
        let fixed = Fixed::parse(&title)
            .ok_or_else(|| bad("the line states no format of the values, such as (8f9.6)"))?;
        let unit = unit_of(word_after(&title, "units of").unwrap_or(""), number)?;
        if let Some(length) = length {
            check_length(text_line, length, count, 1.0 / rate)?;
        }
        let block = fixed.read(lines, count, FORMAT)?;
        let peak = peak_in(peak, &unit);
        return Ok(head.trace(unit, 1.0 / rate, peak, block));
    }

    if find_phrase(&title, EQUAL_POINTS).is_some() {
        let header = BlockHeader::read(lines, EQUAL_POINTS, "accelerations")?;
        let (points, stated) = (count as f64, header.count as f64);
        agree(
            FORMAT,
            header.line,
            "the number of values",
            points,
            stated,
            0.0,
        )?;
        if let Some(length) = length {
            check_length(text_line, length, count, header.step)?;
        }
        let unit = header.unit()?;
        let block = header.fixed.read(lines, count, FORMAT)?;
        let peak = peak_in(peak, &unit);
        return Ok(head.trace(unit, header.step, peak, block));
    }

    let (units, units_line) = head.find("units of").unwrap_or(("", head.first_line));
    let unit = unit_of(word_after(units, "sec and").unwrap_or(""), units_line)?;
    let film = Film::read(lines, count, FILM, FORMAT)?;
    if let Some(length) = length {
        agree(
            FORMAT,
            text_line,
            "the record length in s",
            length,
            film.end(),
            0.02 + 0.001 * length,
        )?;
    }
    let peak = peak_in(peak, &unit);
    film.check_peak(peak, FORMAT)?;
    let (step, block) = film.equally_spaced(options)?;
    let mut trace = head.trace(unit, step, peak, block);
    // Interpolation may cut the peak; it has been compared above.
    trace.peak = None;
    Ok(trace)
}

/// The stated length is that of all values, or of the intervals between them, in thousandths of a second.
fn check_length(line: usize, stated: f64, count: usize, step: f64) -> Result<(), RecordError> {
    let whole = count as f64 * step;
    let between = whole - step;
    let found = if (stated - between).abs() < (stated - whole).abs() {
        between
    } else {
        whole
    };
    agree(
        FORMAT,
        line,
        "the record length in s",
        stated,
        found,
        1.1e-3,
    )
}

/// The maximum of the text is in g, also where the values are in g/10.
fn peak_in(peak: Peak, unit: &(String, f64)) -> Peak {
    let to_unit = jostle::statics::STANDARD_GRAVITY / unit.1;
    Peak {
        value: peak.value * to_unit,
        digit: peak.digit * to_unit,
        ..peak
    }
}
