//! CWA (Central Weather Administration, Taiwan): `#Key: value` lines, then time and three components in columns.
//!
//! Layout: the header of the files. `#DataSequence: Time U(+); N(+); E(+)` names the columns, `#Data: 4F10.3` their
//! widths, `#AmplitudeMAX. U: 28.767~ -28.767` the extremes of a component.

use crate::quantity::shorten;
use crate::record::channel::Direction;
use crate::record::contents::{Contents, Peak, Scale, Trace, named_unit};
use crate::record::error::RecordError;
use crate::record::fixed::Fixed;
use crate::record::formats::{RecordFormat, Times};
use crate::record::header::{Header, malformed};
use crate::record::lines::{LineMap, Lines, number, printed};
use crate::record::units::wrong_unit;

const FORMAT: RecordFormat = RecordFormat::Cwa;
/// Header lines at most.
const MOST_LINES: usize = 40;
const LENGTH: &str = "RecordLength(sec)";
const RATE: &str = "SampleRate(Hz)";
const UNIT: &str = "AmplitudeUnit";
const SEQUENCE: &str = "DataSequence";
const FORMAT_OF_DATA: &str = "Data";

pub(crate) fn read(bytes: &[u8]) -> Result<Contents, RecordError> {
    let mut lines = Lines::new(bytes);
    let header = read_header(&mut lines)?;
    let (rate, _) = header.positive(RATE)?;
    let (length, length_line) = header.need(LENGTH)?;
    let bad_length = || header.bad(length_line, LENGTH, "a number above zero", length);
    let (length, digit) = printed(length).ok_or_else(bad_length)?;
    let unit = read_unit(&header)?;
    let names = read_names(&header)?;
    let fixed = read_format(&header, names.len() + 1)?;

    let mut times = Times::with_capacity(lines.lines_left(), 1.0);
    let mut columns: Vec<Vec<f64>> = vec![Vec::with_capacity(lines.lines_left()); names.len()];
    let mut map = LineMap::default();
    let mut ended = false;
    for line in lines {
        if line.text.trim().is_empty() {
            ended = true;
            continue;
        }
        if ended {
            return Err(malformed(
                FORMAT,
                line.number,
                "values behind an empty line",
            ));
        }
        let cells: Vec<&str> = fixed.cells(&line.text).ok_or_else(|| {
            let found = shorten(line.text.trim());
            let problem = format!(
                "expected {} numbers in columns of {}, found \"{found}\"",
                fixed.per_line, fixed.width
            );
            malformed(FORMAT, line.number, problem)
        })?;
        times.push(line.number, cells[0])?;
        for (column, cell) in columns.iter_mut().zip(&cells[1..]) {
            column.push(number(line.number, cell)?);
        }
        map.note(line.number, 1);
    }
    let found = columns.first().map_or(0, Vec::len);
    let step = 1.0 / rate;
    check_times(&header, &times, step)?;
    // The length is that of all intervals, or of all values, to the digits printed.
    let (intervals, rounding) = (length * rate, 0.5 * digit * rate + 1e-6);
    let rows = found as f64;
    if !(intervals - rounding..=intervals + 1.0 + rounding).contains(&rows) {
        return Err(RecordError::Count {
            line: length_line,
            stated: intervals.round().clamp(0.0, 1e15) as usize,
            found,
        });
    }

    let mut contents = Contents::new(FORMAT, Scale::Stated);
    contents.station = header.text("StationCode");
    contents.date = header.text("StartTime");
    for (name, values) in names.into_iter().zip(columns) {
        let peak = read_peak(&header, &name, &values)?;
        contents.traces.push(Trace {
            direction: Direction::parse(&name),
            name,
            unit: Some(unit.clone()),
            step: Some(step),
            values,
            lines: map.clone(),
            peak: Some(peak),
        });
    }
    Ok(contents)
}

fn read_header(lines: &mut Lines<'_>) -> Result<Header, RecordError> {
    let mut header = Header::new(FORMAT);
    let mut ahead = lines.clone();
    while let Some(line) = ahead.next() {
        let Some(text) = line.text.strip_prefix('#') else {
            break;
        };
        let (key, value) = text.split_once(':').ok_or_else(|| {
            let problem = format!(
                "expected \"#Key: value\", found \"{}\"",
                shorten(&line.text)
            );
            malformed(FORMAT, line.number, problem)
        })?;
        header.push(line.number, key, value);
        if header.len() > MOST_LINES {
            return Err(malformed(
                FORMAT,
                line.number,
                "no values after 40 header lines",
            ));
        }
        *lines = ahead.clone();
    }
    Ok(header)
}

/// The first word of `gal. DCoffset(corr)`.
fn read_unit(header: &Header) -> Result<(String, f64), RecordError> {
    let (text, line) = header.need(UNIT)?;
    let word = text
        .split_whitespace()
        .next()
        .unwrap_or(text)
        .trim_end_matches(['.', ',']);
    named_unit(word).ok_or_else(|| wrong_unit(line, word))
}

/// The names of `Time U(+); N(+); E(+)`.
fn read_names(header: &Header) -> Result<Vec<String>, RecordError> {
    let (text, line) = header.need(SEQUENCE)?;
    let bad = || {
        header.bad(
            line,
            SEQUENCE,
            "columns such as Time U(+); N(+); E(+)",
            text,
        )
    };
    let names = text.strip_prefix("Time").ok_or_else(bad)?;
    let name = |part: &str| {
        let name = part.trim().strip_suffix("(+)")?.trim();
        let known = Direction::parse(name) != Direction::Unknown;
        known.then(|| name.to_owned())
    };
    let names: Option<Vec<String>> = names.split(';').map(name).collect();
    let names = names.ok_or_else(bad)?;
    let differ = names
        .iter()
        .enumerate()
        .all(|(at, name)| !names[..at].contains(name));
    (differ && names.len() <= 3)
        .then_some(names)
        .ok_or_else(bad)
}

/// `4F10.3`: the times and every component.
fn read_format(header: &Header, columns: usize) -> Result<Fixed, RecordError> {
    let (text, line) = header.need(FORMAT_OF_DATA)?;
    let fixed = Fixed::parse(&format!("({text})")).filter(|fixed| fixed.per_line == columns);
    fixed.ok_or_else(|| {
        let expected = format!("a format of {columns} numbers such as {columns}F10.3");
        header.bad(line, FORMAT_OF_DATA, &expected, text)
    })
}

/// The times must have the step of the header.
fn check_times(header: &Header, times: &Times, step: f64) -> Result<(), RecordError> {
    let step_given = times.step_given(Some(step))?;
    if (step_given / step - 1.0).abs() <= 1e-3 {
        return Ok(());
    }
    let (_, line) = header.need(RATE)?;
    let problem = format!("the header states a step of {step} s, the times have {step_given} s");
    Err(malformed(FORMAT, line, problem))
}

/// Compares the values with the extremes `28.767~   -28.767` that the header states.
fn read_peak(header: &Header, name: &str, values: &[f64]) -> Result<Peak, RecordError> {
    let (key, text, line) = extremes(header, name)?;
    let bad = || header.bad(line, &key, "the greatest and the least value", text);
    let (greatest, least) = text.split_once('~').ok_or_else(bad)?;
    let greatest = printed(greatest.trim()).ok_or_else(bad)?;
    let least = printed(least.trim()).ok_or_else(bad)?;
    let most = values.iter().copied().fold(f64::NEG_INFINITY, f64::max);
    let fewest = values.iter().copied().fold(f64::INFINITY, f64::min);
    for ((stated, digit), found) in [(greatest, most), (least, fewest)] {
        if (stated - found).abs() > 1.001 * digit {
            return Err(RecordError::Peak {
                format: FORMAT,
                line,
                stated,
                found,
            });
        }
    }
    let (value, digit) = if least.0.abs() > greatest.0.abs() {
        least
    } else {
        greatest
    };
    Ok(Peak {
        value,
        digit,
        line,
        time: None,
    })
}

/// `#AmplitudeMAX. U: …`: the key holds the component.
fn extremes<'h>(header: &'h Header, name: &str) -> Result<(String, &'h str, usize), RecordError> {
    let key = format!("AmplitudeMAX. {name}");
    let (text, line) = header.need(&key)?;
    Ok((key, text, line))
}
