//! Lines of a text file, and numbers in them.

use std::borrow::Cow;

use super::error::RecordError;
use crate::quantity::shorten;

/// A line without its end and without blanks at the end.
pub(crate) struct Line<'t> {
    /// From 1.
    pub(crate) number: usize,
    pub(crate) text: Cow<'t, str>,
}

/// The lines of a text; old files end lines with `\r` alone or with `\r\r\n`.
///
/// Station names come in many encodings: a line that is not UTF-8 is read as Latin-1.
#[derive(Clone, Debug)]
pub(crate) struct Lines<'t> {
    rest: Option<&'t [u8]>,
    end: u8,
    number: usize,
}

impl<'t> Lines<'t> {
    pub(crate) fn new(bytes: &'t [u8]) -> Self {
        let bytes = bytes.strip_prefix(b"\xef\xbb\xbf").unwrap_or(bytes);
        Self {
            rest: Some(bytes),
            end: if bytes.contains(&b'\n') { b'\n' } else { b'\r' },
            number: 0,
        }
    }

    /// The first line of a text.
    pub(crate) fn first(bytes: &'t [u8]) -> Cow<'t, str> {
        Self::new(bytes)
            .next()
            .map_or(Cow::Borrowed(""), |l| l.text)
    }

    /// Bytes not yet read; bounds what can still follow.
    pub(crate) fn bytes_left(&self) -> usize {
        self.rest.map_or(0, <[u8]>::len)
    }

    /// Lines not yet read.
    pub(crate) fn lines_left(&self) -> usize {
        let ends = |rest: &[u8]| rest.iter().filter(|byte| **byte == self.end).count() + 1;
        self.rest.map_or(0, ends)
    }

    /// Number of the line read last.
    pub(crate) fn number(&self) -> usize {
        self.number
    }
}

impl<'t> Iterator for Lines<'t> {
    type Item = Line<'t>;

    fn next(&mut self) -> Option<Line<'t>> {
        let rest = self.rest?;
        let line = match rest.iter().position(|byte| *byte == self.end) {
            Some(at) => {
                self.rest = Some(&rest[at + 1..]);
                &rest[..at]
            }
            None => {
                self.rest = None;
                rest
            }
        };
        self.number += 1;
        let text = match std::str::from_utf8(line) {
            Ok(text) => Cow::Borrowed(text.trim_end()),
            Err(_) => {
                let text: String = line.iter().map(|byte| char::from(*byte)).collect();
                Cow::Owned(text.trim_end().to_owned())
            }
        };
        Some(Line {
            number: self.number,
            text,
        })
    }
}

/// A text without the bytes that old systems appended: Ctrl-Z (0x1A) marks the end of a DOS file, NUL fills its
/// last block. Such bytes anywhere else are kept and rejected.
pub(crate) fn without_fill(bytes: &[u8]) -> &[u8] {
    let is_fill = |byte: &u8| matches!(byte, 0 | 0x1a);
    let text = |byte: &u8| !is_fill(byte) && !byte.is_ascii_whitespace();
    let end = bytes.iter().rposition(text).map_or(0, |last| last + 1);
    let fill = bytes[end..].iter().position(is_fill);
    fill.map_or(bytes, |at| &bytes[..end + at])
}

/// A finite number; Fortran exponents (`1.5D-3`) and decimal commas are understood.
pub(crate) fn number(line: usize, text: &str) -> Result<f64, RecordError> {
    let parsed = text.parse::<f64>();
    match parsed.or_else(|_| text.replace(['D', 'd'], "e").replace(',', ".").parse()) {
        Ok(value) if value.is_finite() => Ok(value),
        _ => Err(RecordError::NotANumber {
            line,
            found: shorten(text),
        }),
    }
}

/// Unit of the last printed digit: 0.01 for `1.25`, 1e-4 for `1.25e-2`.
pub(crate) fn last_digit(text: &str) -> f64 {
    let mantissa_end = text.find(['e', 'E', 'd', 'D']).unwrap_or(text.len());
    let (mantissa, exponent) = text.split_at(mantissa_end);
    let decimals = mantissa
        .find(['.', ','])
        .map_or(0, |at| mantissa.len() - at - 1);
    let exponent: i32 = exponent.get(1..).and_then(|e| e.parse().ok()).unwrap_or(0);
    let decimals = i32::try_from(decimals).unwrap_or(i32::MAX);
    10f64.powi(exponent.saturating_sub(decimals).clamp(-300, 300))
}

/// Number with its last printed digit, from text such as `-6.852`, for values quoted in headers.
pub(crate) fn printed(text: &str) -> Option<(f64, f64)> {
    let value = text.parse::<f64>().ok().filter(|value| value.is_finite())?;
    Some((value, last_digit(text)))
}

/// The number of fewest digits within `uncertainty` of a value: 0.02 for 0.019999999.
pub(crate) fn simplest(value: f64, uncertainty: f64) -> f64 {
    (0..15)
        .filter_map(|digits| format!("{value:.digits$e}").parse::<f64>().ok())
        .find(|rounded| (rounded - value).abs() <= uncertainty)
        .unwrap_or(value)
}

/// Line of each value, stored as runs of lines with equally many values.
#[derive(Clone, Debug, Default)]
pub(crate) struct LineMap {
    /// First value, first line, values per line.
    runs: Vec<(usize, usize, usize)>,
    values: usize,
    last_line: usize,
}

impl LineMap {
    /// Notes that `count` further values stand on `line`.
    pub(crate) fn note(&mut self, line: usize, count: usize) {
        if count == 0 {
            return;
        }
        let continues = self
            .runs
            .last()
            .is_some_and(|(_, _, per_line)| *per_line == count && line == self.last_line + 1);
        if !continues {
            self.runs.push((self.values, line, count));
        }
        self.values += count;
        self.last_line = line;
    }

    /// Inserts a first value without a line.
    pub(crate) fn prepend(&mut self) {
        self.runs.iter_mut().for_each(|(first, ..)| *first += 1);
        self.values += 1;
    }

    /// Line of a value; 0 for binary formats.
    pub(crate) fn line_of(&self, value: usize) -> usize {
        let after = self.runs.partition_point(|(first, ..)| *first <= value);
        let run = after.checked_sub(1).and_then(|at| self.runs.get(at));
        run.map_or(0, |(first, line, per_line)| {
            line + (value - first) / per_line
        })
    }
}

/// Numbers, or lines, that are read to find whether all numbers have the same format.
const ALIKE: usize = 12;

/// Refuses a text that ends inside its last number: no line end, and a number that the layout of those before it,
/// or of those above it, does not allow.
pub(crate) fn check_end(bytes: &[u8]) -> Result<(), RecordError> {
    let ended = bytes.last().is_none_or(|last| last.is_ascii_whitespace());
    if ended {
        return Ok(());
    }
    let is_end = |byte: &u8| matches!(byte, b'\n' | b'\r');
    // A line may hold the whole record; its end is enough.
    let tail = &bytes[bytes.len().saturating_sub(4000)..];
    let mut lines = tail.rsplit(is_end).filter(|line| !line.is_empty());
    let last_line = lines.next().unwrap_or_default();
    let column = words(last_line).count().saturating_sub(1);
    let last = words(last_line).next_back().unwrap_or_default();
    // Up to the names of the columns.
    let is_number = |word: &[u8]| {
        let first = word.iter().find(|byte| **byte != b'"').copied();
        first.is_some_and(|first| first.is_ascii_digit() || matches!(first, b'+' | b'-' | b'.'))
    };
    let above: Vec<&[u8]> = lines
        .take(ALIKE)
        .take_while(|line| words(line).nth(column).is_some_and(is_number))
        .collect();
    let in_column = || above.iter().filter_map(|line| words(line).nth(column));
    let before = tail.rsplit(is_gap).filter(|word| !word.is_empty());
    let before: Vec<_> = before.skip(1).take(ALIKE).collect();
    let cut = is_shorter(last, &in_column().collect::<Vec<_>>(), 2)
        || is_shorter(last, &before, 3)
        || is_left_of(last_line, column, &above)
        || is_stub(last, &before);
    if cut {
        let line = Lines::new(bytes).count();
        return Err(RecordError::CutShort { line });
    }
    Ok(())
}

fn is_gap(byte: &u8) -> bool {
    byte.is_ascii_whitespace() || matches!(byte, b',' | b';')
}

fn words(line: &[u8]) -> impl DoubleEndedIterator<Item = &[u8]> {
    line.split(is_gap).filter(|word| !word.is_empty())
}

/// Characters from the decimal point on, those of an exponent included.
fn decimals(word: &[u8]) -> Option<usize> {
    let point = word.iter().position(|byte| *byte == b'.')?;
    Some(word.len() - point)
}

/// Whether a number has fewer decimals than all of several others, which have equally many.
fn is_shorter(last: &[u8], others: &[&[u8]], least: usize) -> bool {
    let usual = others.first().and_then(|word| decimals(word));
    usual.is_some_and(|usual| {
        others.len() >= least
            && others.iter().all(|word| decimals(word) == Some(usual))
            && decimals(last).unwrap_or(0) < usual
    })
}

/// Whether a line ends before the place where numbers of different lengths end on all lines above.
fn is_left_of(last_line: &[u8], column: usize, above: &[&[u8]]) -> bool {
    let ends = |line: &[u8]| {
        let mut ends = Vec::new();
        let mut lengths = Vec::new();
        let mut start = 0;
        for word in line.split(is_gap) {
            start += word.len() + 1;
            if !word.is_empty() {
                ends.push(start - 1);
                lengths.push(word.len());
            }
        }
        (ends.get(column).copied(), lengths.get(column).copied())
    };
    let Some(first) = above.first() else {
        return false;
    };
    let (usual, length) = ends(first);
    // Indented numbers of one length are aligned to the right as well.
    let mut differ = last_line.starts_with(b" ");
    let aligned = above.len() >= 3
        && above.iter().all(|line| {
            let (end, other) = ends(line);
            differ |= other != length;
            end == usual
        });
    aligned && differ && usual.is_some_and(|usual| last_line.len() < usual)
}

/// Whether a number lacks what all others have: an exponent, its digits, digits behind the point; or ends in a zero
/// that none of the others has.
fn is_stub(last: &[u8], others: &[&[u8]]) -> bool {
    if others.len() < ALIKE / 2 {
        return false;
    }
    let exponent = |word: &[u8]| {
        let at = word
            .iter()
            .position(|byte| matches!(byte, b'e' | b'E' | b'd' | b'D'))?;
        Some(
            word[at + 1..]
                .iter()
                .filter(|byte| byte.is_ascii_digit())
                .count(),
        )
    };
    let exponents: Vec<_> = others.iter().filter_map(|word| exponent(word)).collect();
    let is_zero = last
        .iter()
        .all(|byte| matches!(byte, b'0' | b'.' | b'-' | b'+'));
    match exponent(last) {
        Some(digits) if exponents.iter().min().is_some_and(|least| digits < *least) => return true,
        None if exponents.len() == others.len() && !is_zero => return true,
        _ => {}
    }
    let ends_in = |word: &[u8], mark: u8| word.contains(&b'.') && word.last() == Some(&mark);
    let alone = |mark: u8| ends_in(last, mark) && !others.iter().any(|word| ends_in(word, mark));
    alone(b'.') || others.len() >= ALIKE && alone(b'0')
}
