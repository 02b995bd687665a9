//! One record of miniSEED: its header, in both versions.

use super::crc32c::crc32c;

/// A record begins with a sequence number and a quality letter (2), or with `MS` and 3.
pub(crate) fn is_miniseed(bytes: &[u8]) -> bool {
    is_version_3(bytes) || is_version_2(bytes)
}

pub(super) fn is_version_3(bytes: &[u8]) -> bool {
    bytes.starts_with(b"MS\x03")
}

pub(super) fn is_version_2(bytes: &[u8]) -> bool {
    let sequence = |byte: &u8| byte.is_ascii_digit() || matches!(byte, b' ' | 0);
    bytes.len() >= 48
        && bytes[..6].iter().all(sequence)
        && matches!(bytes[6], b'D' | b'R' | b'Q' | b'M')
        && matches!(bytes[7], b' ' | 0)
        // A text can begin so too, but it has no bytes of zero further on.
        && bytes[8..48].iter().any(|byte| *byte < b' ')
}

/// How values are stored.
#[derive(Clone, Copy, PartialEq)]
pub(super) enum Encoding {
    Int16,
    Int32,
    Float32,
    Float64,
    Steim1,
    Steim2,
}

/// One record.
pub(super) struct Block<'b> {
    /// Network, station, location and channel, with points between.
    pub(super) source: String,
    /// Nanoseconds since an arbitrary epoch.
    pub(super) start: i128,
    /// Date of the first value, for messages.
    pub(super) date: String,
    pub(super) rate: f64,
    pub(super) count: usize,
    pub(super) encoding: Encoding,
    pub(super) big_endian: bool,
    pub(super) data: &'b [u8],
    /// Where the data begin in the record, where a channel keeps to one place.
    pub(super) offset: usize,
    /// Length of the whole record.
    pub(super) length: usize,
}

impl Block<'_> {
    /// Data that all records of a channel share; without checksums a difference reveals a damaged header.
    pub(super) fn layout(&self) -> Layout {
        Layout {
            encoding: self.encoding,
            big_endian: self.big_endian,
            offset: self.offset,
            length: if self.offset == 0 { 0 } else { self.length },
        }
    }
}

/// Layout of the records of a channel.
#[derive(PartialEq)]
pub(super) struct Layout {
    pub(super) encoding: Encoding,
    pub(super) big_endian: bool,
    pub(super) offset: usize,
    pub(super) length: usize,
}

fn encoding(code: u8) -> Result<Encoding, String> {
    Ok(match code {
        1 => Encoding::Int16,
        3 => Encoding::Int32,
        4 => Encoding::Float32,
        5 => Encoding::Float64,
        10 => Encoding::Steim1,
        11 => Encoding::Steim2,
        0 => return Err("the record holds text, no values".into()),
        _ => {
            return Err(format!(
                "values in encoding {code} are not read; convert the file to Steim-2 or to integers"
            ));
        }
    })
}

/// Sampling rate that cannot be used.
fn check_rate(rate: f64) -> Result<f64, String> {
    if (0.1..=1e6).contains(&rate) {
        Ok(rate)
    } else {
        Err(format!("a sampling rate of {rate} Hz is not usable"))
    }
}

/// Nanoseconds, with years of 366 days: only differences within a record matter, and those across a new year.
fn nanoseconds(
    year: u16,
    day: u16,
    hour: u8,
    minute: u8,
    second: u8,
    nano: u32,
) -> Result<i128, String> {
    let fits = (1900..=2200).contains(&year)
        && (1..=366).contains(&day)
        && hour < 24
        && minute < 60
        && second <= 60
        && nano < 1_000_000_000;
    if !fits {
        return Err("the start time is impossible".into());
    }
    let before = i128::from(year) - 1;
    let days = 365 * before + before / 4 - before / 100 + before / 400 + i128::from(day);
    let seconds =
        86_400 * days + 3600 * i128::from(hour) + 60 * i128::from(minute) + i128::from(second);
    Ok(1_000_000_000 * seconds + i128::from(nano))
}

fn date(year: u16, day: u16, hour: u8, minute: u8, second: u8) -> String {
    format!("{year}-{day:03} {hour:02}:{minute:02}:{second:02}")
}

fn word(bytes: &[u8]) -> String {
    String::from_utf8_lossy(bytes)
        .trim_matches(|c: char| c.is_whitespace() || c == '\0')
        .to_owned()
}

/// A record of version 2: 48 bytes, blockettes, data.
pub(super) fn version_2(bytes: &[u8]) -> Result<Block<'_>, String> {
    let year = u16::from_be_bytes([bytes[20], bytes[21]]);
    // Headers have either byte order; the year shows which.
    let big_header = (1900..=2200).contains(&year);
    let short = |at: usize| -> Result<u16, String> {
        let pair: [u8; 2] = bytes
            .get(at..at + 2)
            .and_then(|pair| pair.try_into().ok())
            .ok_or("the file ends in a header")?;
        Ok(if big_header {
            u16::from_be_bytes(pair)
        } else {
            u16::from_le_bytes(pair)
        })
    };
    let (year, day) = (short(20)?, short(22)?);
    // Ten-thousandths of a second.
    let fraction = u32::from(short(28)?.min(10_000)) * 100_000;
    let mut start = nanoseconds(year, day, bytes[24], bytes[25], bytes[26], fraction)?;
    let factor = f64::from(short(32)?.cast_signed());
    let multiplier = f64::from(short(34)?.cast_signed());
    let mut rate = match (factor > 0.0, multiplier > 0.0) {
        (true, true) => factor * multiplier,
        (true, false) => -factor / multiplier,
        (false, true) => -multiplier / factor,
        (false, false) => 1.0 / (factor * multiplier),
    };
    // Apply the clock correction unless it has been applied already.
    if bytes[36] & 2 == 0 {
        let correction: [u8; 4] = [bytes[40], bytes[41], bytes[42], bytes[43]];
        let correction = if big_header {
            i32::from_be_bytes(correction)
        } else {
            i32::from_le_bytes(correction)
        };
        start += i128::from(correction) * 100_000;
    }

    let (mut storage, mut end_of_header) = (None, 48);
    let mut at = usize::from(short(46)?);
    while at != 0 {
        let (kind, next) = (short(at)?, usize::from(short(at + 2)?));
        let body = |length: usize| {
            bytes
                .get(at + 4..at + 4 + length)
                .ok_or("a blockette is cut")
        };
        match kind {
            1000 => {
                let body = body(3)?;
                storage = Some((encoding(body[0])?, body[1], body[2]));
            }
            1001 => start += i128::from(body(2)?[1].cast_signed()) * 1000,
            100 => {
                let actual: [u8; 4] = body(4)?.try_into().map_err(|_| "a blockette is cut")?;
                let bits = if big_header {
                    u32::from_be_bytes(actual)
                } else {
                    u32::from_le_bytes(actual)
                };
                rate = f64::from(f32::from_bits(bits));
            }
            _ => {}
        }
        end_of_header = at + 4;
        if next != 0 && next <= at {
            return Err("the chain of blockettes runs back".into());
        }
        at = next;
    }
    let (encoding, order, exponent) = storage.ok_or("there is no blockette 1000")?;
    if !(7..=28).contains(&exponent) {
        return Err(format!(
            "a record length of 2^{exponent} bytes is not possible"
        ));
    }
    let length = 1 << exponent;
    let record = bytes.get(..length).ok_or("the file ends in this record")?;
    let count = usize::from(short(30)?);
    let offset = usize::from(short(44)?);
    let data = record
        .get(offset..)
        .filter(|_| offset >= end_of_header || count == 0);
    let names = [
        word(&bytes[18..20]),
        word(&bytes[8..13]),
        word(&bytes[13..15]),
        word(&bytes[15..18]),
    ];
    Ok(Block {
        source: names.join("."),
        start,
        date: date(year, day, bytes[24], bytes[25], bytes[26]),
        rate: if count == 0 { 1.0 } else { check_rate(rate)? },
        count,
        encoding,
        big_endian: order != 0,
        data: data.ok_or("the data begin outside the record")?,
        offset,
        length,
    })
}

/// A record of version 3: 40 bytes, identifier, further headers, data; little-endian, with a checksum.
pub(super) fn version_3(bytes: &[u8]) -> Result<Block<'_>, String> {
    let fixed: &[u8; 40] = bytes.first_chunk().ok_or("the file ends in a header")?;
    let short = |at: usize| u16::from_le_bytes([fixed[at], fixed[at + 1]]);
    let long =
        |at: usize| u32::from_le_bytes([fixed[at], fixed[at + 1], fixed[at + 2], fixed[at + 3]]);
    let (identifier, extra, data) = (
        usize::from(fixed[33]),
        usize::from(short(34)),
        long(36) as usize,
    );
    let length = 40 + identifier + extra + data;
    let record = bytes.get(..length).ok_or("the file ends in this record")?;
    if crc32c(record, 28..32) != long(28) {
        return Err("the checksum is wrong".into());
    }
    let rate: [u8; 8] = [16, 17, 18, 19, 20, 21, 22, 23].map(|at| fixed[at]);
    let rate = f64::from_le_bytes(rate);
    // Negative numbers are periods.
    let rate = if rate < 0.0 { -1.0 / rate } else { rate };
    let count = long(24) as usize;
    let encoding = encoding(fixed[15])?;
    let steim = matches!(encoding, Encoding::Steim1 | Encoding::Steim2);
    let (year, day) = (short(8), short(10));
    Ok(Block {
        source: source_name(&word(&record[40..40 + identifier])),
        start: nanoseconds(year, day, fixed[12], fixed[13], fixed[14], long(4))?,
        date: date(year, day, fixed[12], fixed[13], fixed[14]),
        rate: if count == 0 { 1.0 } else { check_rate(rate)? },
        count,
        encoding,
        big_endian: steim,
        data: &record[40 + identifier + extra..],
        // Records have any length, and a checksum.
        offset: 0,
        length,
    })
}

/// `FDSN:NET_STA_LOC_H_N_E` as `NET.STA.LOC.HNE`.
fn source_name(identifier: &str) -> String {
    let plain = identifier.strip_prefix("FDSN:").unwrap_or(identifier);
    let parts: Vec<_> = plain.split('_').collect();
    match parts.as_slice() {
        [network, station, location, band, source, subsource] => {
            format!("{network}.{station}.{location}.{band}{source}{subsource}")
        }
        _ => plain.to_owned(),
    }
}
