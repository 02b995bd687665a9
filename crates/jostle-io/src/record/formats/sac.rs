//! SAC, binary: 632 bytes of header (70 reals, 40 integers, 192 letters), then 32-bit reals, of either byte order.
//!
//! Source: SAC manual, "SAC data file format" (IRIS/EarthScope), header versions 6 and 7.

use crate::record::RecordOptions;
use crate::record::channel::Direction;
use crate::record::contents::{Contents, Scale, Trace};
use crate::record::error::RecordError;
use crate::record::formats::RecordFormat;
use crate::record::header::{agree, malformed};
use crate::record::lines::{LineMap, simplest};

const FORMAT: RecordFormat = RecordFormat::Sac;
const HEADER: usize = 632;
/// Doubles after the data in version 7.
const FOOTER: usize = 8 * 22;
/// Value for "not stated".
const UNKNOWN: f32 = -12345.0;
const UNKNOWN_INTEGER: i32 = -12345;

/// Header words, counted in words of four bytes.
mod word {
    pub(super) const DELTA: usize = 0;
    pub(super) const LEAST: usize = 1;
    pub(super) const GREATEST: usize = 2;
    pub(super) const SCALE: usize = 3;
    pub(super) const BEGIN: usize = 5;
    pub(super) const END: usize = 6;
    pub(super) const MEAN: usize = 56;
    pub(super) const AZIMUTH: usize = 57;
    pub(super) const INCLINATION: usize = 58;
    pub(super) const YEAR: usize = 70;
    pub(super) const VERSION: usize = 76;
    pub(super) const POINTS: usize = 79;
    pub(super) const FILE_TYPE: usize = 85;
    pub(super) const QUANTITY: usize = 86;
    pub(super) const EVEN: usize = 105;
}

/// Letters of the header: byte and length.
const STATION: (usize, usize) = (440, 8);
const EVENT: (usize, usize) = (448, 16);
const COMPONENT: (usize, usize) = (600, 8);
const NETWORK: (usize, usize) = (608, 8);

/// The version shows the byte order.
pub(crate) fn is_sac(bytes: &[u8]) -> bool {
    big_endian(bytes).is_some()
}

fn big_endian(bytes: &[u8]) -> Option<bool> {
    let version = word_at(bytes, word::VERSION)?;
    // Further on in the header, numbers must look like SAC too.
    bytes.get(..HEADER)?;
    match (u32::from_be_bytes(version), u32::from_le_bytes(version)) {
        (6 | 7, _) => Some(true),
        (_, 6 | 7) => Some(false),
        _ => None,
    }
}

fn word_at(bytes: &[u8], word: usize) -> Option<[u8; 4]> {
    bytes.get(4 * word..4 * word + 4)?.try_into().ok()
}

struct Header<'b> {
    bytes: &'b [u8],
    big: bool,
}

impl Header<'_> {
    fn integer(&self, word: usize) -> i32 {
        let bytes = word_at(self.bytes, word).unwrap_or_default();
        if self.big {
            i32::from_be_bytes(bytes)
        } else {
            i32::from_le_bytes(bytes)
        }
    }

    /// A real, unless it is not stated.
    fn real(&self, word: usize) -> Option<f64> {
        let bytes = word_at(self.bytes, word).unwrap_or_default();
        let value = if self.big {
            f32::from_be_bytes(bytes)
        } else {
            f32::from_le_bytes(bytes)
        };
        (value != UNKNOWN).then(|| shortest(value))
    }

    fn letters(&self, (at, length): (usize, usize)) -> String {
        let letters = self.bytes.get(at..at + length).unwrap_or_default();
        let text = String::from_utf8_lossy(letters);
        let text = text.split('\0').next().unwrap_or("").trim();
        if text.starts_with("-12345") {
            String::new()
        } else {
            text.to_owned()
        }
    }
}

/// The shortest decimal number of a 32-bit real: 0.01, not 0.009999999776.
fn shortest(value: f32) -> f64 {
    value
        .to_string()
        .parse()
        .unwrap_or_else(|_| f64::from(value))
}

pub(crate) fn read(bytes: &[u8], options: &RecordOptions) -> Result<Contents, RecordError> {
    let bad = |problem: String| malformed(FORMAT, 0, problem);
    let big =
        big_endian(bytes).ok_or_else(|| bad("there is no SAC header of version 6 or 7".into()))?;
    let header = Header { bytes, big };
    check_kind(&header)?;
    let points = header.integer(word::POINTS);
    let points = usize::try_from(points).map_err(|_| bad(format!("NPTS is {points}")))?;
    let data = &bytes[HEADER..];
    let footer = if header.integer(word::VERSION) == 7 {
        FOOTER
    } else {
        0
    };
    let length = points
        .checked_mul(4)
        .and_then(|length| length.checked_add(footer));
    if length != Some(data.len()) {
        return Err(RecordError::Count {
            line: 0,
            stated: points,
            found: data.len().saturating_sub(footer) / 4,
        });
    }
    let step = header.real(word::DELTA).filter(|step| *step > 0.0);
    let step = step.ok_or_else(|| bad("the header states no step (DELTA)".into()))?;
    let mut step = freed_from_rounding(&header, points, step);
    if footer > 0 {
        // Version 7 repeats the step with sixteen digits.
        let at = data.len() - FOOTER;
        let exact = data
            .get(at..at + 8)
            .and_then(|b| b.try_into().ok())
            .unwrap_or_default();
        let exact = if big {
            f64::from_be_bytes(exact)
        } else {
            f64::from_le_bytes(exact)
        };
        agree(FORMAT, 0, "the time step", exact, step, 1e-5 * step)?;
        step = exact;
    }
    let values = values(&data[..4 * points], big)?;
    check(&header, &values, step)?;
    if let (Some(stated), None) = (header.real(word::SCALE), options.scale)
        && stated != 1.0
    {
        return Err(RecordError::HeaderScale { stated });
    }

    let mut contents = Contents::new(FORMAT, Scale::Counts);
    let (network, station) = (header.letters(NETWORK), header.letters(STATION));
    contents.station = if network.is_empty() {
        station
    } else {
        format!("{network}.{station}")
    };
    contents.event = header.letters(EVENT);
    let date: Vec<_> = (0..5).map(|at| header.integer(word::YEAR + at)).collect();
    if date.iter().all(|part| *part != UNKNOWN_INTEGER) {
        let [year, day, hour, minute, second] = [date[0], date[1], date[2], date[3], date[4]];
        contents.date = format!("{year}-{day:03} {hour:02}:{minute:02}:{second:02}");
    }
    let name = header.letters(COMPONENT);
    let direction = match (header.real(word::INCLINATION), header.real(word::AZIMUTH)) {
        (Some(inclination), _) if inclination == 0.0 || inclination == 180.0 => Direction::Vertical,
        (Some(90.0), Some(azimuth)) if azimuth.is_finite() => {
            Direction::Azimuth(azimuth.rem_euclid(360.0))
        }
        _ => Direction::of_channel_code(&name),
    };
    contents.traces.push(Trace {
        name,
        direction,
        unit: None,
        step: Some(step),
        values,
        lines: LineMap::default(),
        peak: None,
    });
    Ok(contents)
}

/// The step of B, E and NPTS where DELTA differs from it by no more than the rounding of one 32-bit time: programs
/// that keep times compute DELTA as the difference of two of them. Over many steps that rounding is divided by their
/// number.
fn freed_from_rounding(header: &Header<'_>, points: usize, step: f64) -> f64 {
    let (Some(begin), Some(end), true) = (
        header.real(word::BEGIN),
        header.real(word::END),
        points >= 2,
    ) else {
        return step;
    };
    let intervals = (points - 1) as f64;
    let mean = (end - begin) / intervals;
    let rounding = f64::from(f32::EPSILON) * begin.abs().max(end.abs());
    let agrees = (step - mean).abs() <= rounding / intervals + f64::from(f32::EPSILON) * step;
    let rounded = (step - mean).abs() <= 1.01 * rounding;
    if agrees || !rounded {
        step
    } else {
        simplest(mean, rounding / intervals)
    }
}

/// Only evenly spaced accelerations, or what may be such, are a record.
fn check_kind(header: &Header<'_>) -> Result<(), RecordError> {
    let other = |found: &str| RecordError::NotAcceleration {
        format: FORMAT,
        found: found.into(),
        remedy: "",
    };
    if header.integer(word::FILE_TYPE) != 1 {
        return Err(other("no time series (IFTYPE is not ITIME)"));
    }
    if header.integer(word::EVEN) != 1 {
        return Err(other("values at unequal times (LEVEN is false)"));
    }
    match header.integer(word::QUANTITY) {
        6 => Err(other("displacements (IDEP is IDISP)")),
        7 => Err(other("velocities (IDEP is IVEL)")),
        _ => Ok(()),
    }
}

fn values(data: &[u8], big: bool) -> Result<Vec<f64>, RecordError> {
    let mut values = Vec::with_capacity(data.len() / 4);
    for (at, item) in data.chunks_exact(4).enumerate() {
        let item: [u8; 4] = item.try_into().unwrap_or_default();
        let value = if big {
            f32::from_be_bytes(item)
        } else {
            f32::from_le_bytes(item)
        };
        if !value.is_finite() {
            let problem = format!("value {} is not a number", at + 1);
            return Err(malformed(FORMAT, 0, problem));
        }
        values.push(f64::from(value));
    }
    Ok(values)
}

/// Times and extremes of the header, where they are stated, must be those of the values.
fn check(header: &Header<'_>, values: &[f64], step: f64) -> Result<(), RecordError> {
    if let (Some(begin), Some(end), false) = (
        header.real(word::BEGIN),
        header.real(word::END),
        values.is_empty(),
    ) {
        let intervals = (values.len() - 1) as f64;
        let allowed = 1e-4 * intervals * step + 2e-7 * (begin.abs() + end.abs());
        let stated = end - begin;
        // Some programs count one interval more.
        if (stated - (intervals + 1.0) * step).abs() > allowed {
            let what = "the length in s (B, E, NPTS, DELTA)";
            agree(FORMAT, 0, what, stated, intervals * step, allowed)?;
        }
    }
    let least = values.iter().copied().fold(f64::INFINITY, f64::min);
    let greatest = values.iter().copied().fold(f64::NEG_INFINITY, f64::max);
    let swing = crate::record::contents::largest(values);
    let extremes = [(word::LEAST, least, 1e-5), (word::GREATEST, greatest, 1e-5)];
    let mean = (word::MEAN, crate::record::contents::mean(values), 1e-3);
    for (word, found, part) in extremes.into_iter().chain([mean]) {
        if let Some(stated) = header.real(word)
            && (stated.is_nan() || (stated - found).abs() > part * swing)
        {
            return Err(RecordError::Peak {
                format: FORMAT,
                line: 0,
                stated,
                found,
            });
        }
    }
    Ok(())
}
