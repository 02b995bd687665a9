//! K-NET and KiK-net ASCII (NIED, Japan): 17 header lines with keys in columns 1 to 18, then counts, 8 on a line.
//!
//! Layout: NIED, "Data format of K-NET and KiK-net ASCII". The published peak is that of the record minus its mean,
//! so the mean is removed here, before the scale factor.

use crate::record::channel::Direction;
use crate::record::contents::{Contents, Peak, Scale, Trace, mean, named_unit};
use crate::record::error::RecordError;
use crate::record::fixed::Fixed;
use crate::record::formats::RecordFormat;
use crate::record::header::{Header, agree, malformed};
use crate::record::lines::{Lines, printed};

const FORMAT: RecordFormat = RecordFormat::Knet;

/// The keys required in the first columns, in this order.
const KEYS: [&str; 17] = [
    "Origin Time",
    "Lat.",
    "Long.",
    "Depth. (km)",
    "Mag.",
    "Station Code",
    "Station Lat.",
    "Station Long.",
    "Station Height(m)",
    "Record Time",
    "Sampling Freq(Hz)",
    "Duration Time(s)",
    "Dir.",
    "Scale Factor",
    "Max. Acc. (gal)",
    "Last Correction",
    "Memo.",
];

pub(crate) fn read(bytes: &[u8]) -> Result<Contents, RecordError> {
    let mut lines = Lines::new(bytes);
    let header = read_header(&mut lines)?;

    let (frequency, line) = header.need("Sampling Freq(Hz)")?;
    let frequency: f64 = frequency
        .trim_end_matches("Hz")
        .trim()
        .parse()
        .ok()
        .filter(|f| *f > 0.0 && f64::is_finite(*f))
        .ok_or_else(|| {
            header.bad(
                line,
                "Sampling Freq(Hz)",
                "a frequency such as 100Hz",
                frequency,
            )
        })?;
    let (duration, line) = header.positive("Duration Time(s)")?;
    let points = frequency * duration;
    if points.fract() != 0.0 || points > 1e9 {
        return Err(header.bad(
            line,
            "Duration Time(s)",
            "whole samples",
            &duration.to_string(),
        ));
    }
    let (factor, unit) = scale_factor(&header)?;
    let (text, line) = header.need("Max. Acc. (gal)")?;
    let (value, digit) =
        printed(text).ok_or_else(|| header.bad(line, "Max. Acc. (gal)", "a number", text))?;

    let block = integers(&mut lines, points as usize)?;
    if let Some(more) = lines.find(|line| !line.text.is_empty()) {
        agree(
            FORMAT,
            more.number,
            "the number of values",
            points,
            points + 1.0,
            0.0,
        )?;
    }
    let mut values = block.values;
    let zero = mean(&values);
    values
        .iter_mut()
        .for_each(|value| *value = (*value - zero) * factor);

    let (dir, _) = header.need("Dir.")?;
    let mut contents = Contents::new(FORMAT, Scale::Stated);
    contents.station = header.text("Station Code");
    contents.date = header.text("Record Time");
    contents.event = format!(
        "M {} of {}",
        header.text("Mag."),
        header.text("Origin Time")
    );
    contents.traces.push(Trace {
        name: dir.to_owned(),
        direction: direction(dir),
        unit: named_unit(&unit),
        step: Some(1.0 / frequency),
        values,
        lines: block.lines,
        peak: Some(Peak {
            value,
            digit,
            line,
            time: None,
        }),
    });
    Ok(contents)
}

fn read_header(lines: &mut Lines<'_>) -> Result<Header, RecordError> {
    let mut header = Header::new(FORMAT);
    for key in KEYS {
        let line = lines.next();
        let number = line.as_ref().map_or(header.last_line, |line| line.number);
        let value = line.as_ref().and_then(|line| line.text.strip_prefix(key));
        let Some(value) = value else {
            let problem = format!("expected the header line \"{key}\"");
            return Err(malformed(FORMAT, number, problem));
        };
        header.push(number, key, value);
    }
    Ok(header)
}

/// Counts of eight columns, each followed by a blank.
fn integers(
    lines: &mut Lines<'_>,
    count: usize,
) -> Result<crate::record::fixed::Block, RecordError> {
    Fixed::integers(8, 8)
        .blank_behind()
        .read(lines, count, FORMAT)
}

/// `3920(gal)/6182761` as gal per count.
fn scale_factor(header: &Header) -> Result<(f64, String), RecordError> {
    let (text, line) = header.need("Scale Factor")?;
    let parse = || {
        let (full, counts) = text.split_once('/')?;
        let (full, unit) = full.split_once('(')?;
        let full: f64 = full.trim().parse().ok()?;
        let counts: f64 = counts.trim().parse().ok()?;
        let factor = full / counts;
        let unit = unit.trim_end_matches(')');
        named_unit(unit)?;
        (factor.is_finite() && factor > 0.0).then_some((factor, unit.to_owned()))
    };
    parse().ok_or_else(|| {
        header.bad(
            line,
            "Scale Factor",
            "a factor such as 3920(gal)/6182761",
            text,
        )
    })
}

/// KiK-net numbers directions: 1 to 3 in the borehole, 4 to 6 at the surface.
fn direction(dir: &str) -> Direction {
    match dir {
        "1" | "4" => Direction::Azimuth(0.0),
        "2" | "5" => Direction::Azimuth(90.0),
        "3" | "6" => Direction::Vertical,
        _ => Direction::parse(dir),
    }
}
