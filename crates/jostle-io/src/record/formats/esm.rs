//! ESM ASCII (Engineering Strong-Motion database; also ITACA and AFAD-TADAS): `KEY: value` lines, one value a line.
//!
//! Layout: Luzi et al. (2016), Seismological Research Letters 87(4), and the DYNA header that files carry.

use crate::record::channel::Direction;
use crate::record::contents::{Contents, Peak, Scale, Trace};
use crate::record::error::RecordError;
use crate::record::formats::RecordFormat;
use crate::record::header::{Header, agree, malformed};
use crate::record::lines::{LineMap, Lines, check_end, number, printed};
use crate::record::units::acceleration_unit;

const FORMAT: RecordFormat = RecordFormat::Esm;
/// Lines of header at most; files have 64.
const MOST_LINES: usize = 100;

pub(crate) fn read(bytes: &[u8]) -> Result<Contents, RecordError> {
    let mut lines = Lines::new(bytes);
    let mut header = Header::new(FORMAT);
    let mut first = None;
    for line in &mut lines {
        let Some((key, value)) = line.text.split_once(':') else {
            first = Some((line.number, line.text.trim().to_owned()));
            break;
        };
        header.push(line.number, key, value);
        if header.len() > MOST_LINES {
            let problem = "no values after 100 header lines";
            return Err(malformed(FORMAT, line.number, problem));
        }
    }
    let (kind, _) = header.find("DATA_TYPE").unwrap_or(("ACCELERATION", 0));
    if kind != "ACCELERATION" {
        return Err(RecordError::NotAcceleration {
            format: FORMAT,
            found: crate::quantity::shorten(&kind.to_lowercase()),
            remedy: "; take the file whose name ends in ACC.ASC",
        });
    }
    let (unit, line) = header.need("UNITS")?;
    let size = acceleration_unit(unit).ok_or_else(|| RecordError::Unit {
        line,
        found: crate::quantity::shorten(unit),
    })?;
    let (step, _) = header.positive("SAMPLING_INTERVAL_S")?;
    let (stated, stated_line) = header.count("NDATA")?;
    check_duration(&header, stated, step)?;

    let mut values = Vec::with_capacity(stated.min(lines.lines_left() + 1));
    let mut map = LineMap::default();
    let rest = lines.map(|line| (line.number, line.text.trim().to_owned()));
    for (line, text) in first.into_iter().chain(rest) {
        if !text.is_empty() {
            values.push(number(line, &text)?);
            map.note(line, 1);
        }
    }
    if values.len() != stated {
        return Err(RecordError::Count {
            line: stated_line,
            stated,
            found: values.len(),
        });
    }
    check_end(bytes)?;
    let peak = read_peak(&header, unit, size)?;

    let stream = header.text("STREAM");
    let mut contents = Contents::new(FORMAT, Scale::Stated);
    contents.station = [header.text("NETWORK"), header.text("STATION_CODE")].join(".");
    contents.event = header.text("EVENT_NAME");
    contents.date = header.text("DATE_TIME_FIRST_SAMPLE_YYYYMMDD_HHMMSS");
    contents.traces.push(Trace {
        direction: Direction::of_channel_code(&stream),
        name: stream,
        unit: Some((unit.to_owned(), size)),
        step: Some(step),
        values,
        lines: map,
        peak,
    });
    Ok(contents)
}

/// The stated duration is that of all values, or of the intervals between them, to the digits printed.
fn check_duration(header: &Header, count: usize, step: f64) -> Result<(), RecordError> {
    let (Some((text, line)), Some((step_text, _))) = (
        header.find("DURATION_S"),
        header.find("SAMPLING_INTERVAL_S"),
    ) else {
        return Ok(());
    };
    let (duration, digit) =
        printed(text).ok_or_else(|| header.bad(line, "DURATION_S", "a number", text))?;
    let step_digit = printed(step_text).map_or(0.0, |(_, digit)| digit);
    let count = count as f64;
    let allowed = 0.6 * digit + 0.5 * count * step_digit;
    if (duration - (count - 1.0) * step).abs() <= allowed {
        return Ok(());
    }
    agree(
        FORMAT,
        line,
        "the duration",
        duration,
        count * step,
        allowed,
    )
}

/// The key of the peak contains its unit, `PGA_CM/S^2`.
fn read_peak(header: &Header, unit: &str, size: f64) -> Result<Option<Peak>, RecordError> {
    let Some((text, line)) = header.find("PGA_CM/S^2") else {
        return Ok(None);
    };
    let (value, digit) =
        printed(text).ok_or_else(|| header.bad(line, "PGA_CM/S^2", "a number", text))?;
    let to_unit = 0.01 / size;
    if !to_unit.is_finite() {
        return Err(header.bad(line, "UNITS", "a unit", unit));
    }
    Ok(Some(Peak {
        value: value * to_unit,
        digit: digit * to_unit,
        line,
        time: header
            .find("TIME_PGA_S")
            .and_then(|(text, _)| printed(text)),
    }))
}
