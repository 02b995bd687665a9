//! Numbers in columns of fixed width without separators: Fortran formats such as `(8F10.6)`.

use super::error::RecordError;
use super::formats::RecordFormat;
use super::lines::{LineMap, Lines, number};
use crate::quantity::shorten;

/// A Fortran edit descriptor repeated along a line.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Fixed {
    /// Numbers on a line.
    pub(crate) per_line: usize,
    /// Columns of a number.
    pub(crate) width: usize,
    /// Whether numbers have a decimal point.
    pub(crate) real: bool,
    /// Blank columns after a number.
    gap: usize,
    /// Reals of this magnitude and above may stand without their point.
    whole_from: f64,
}

/// Numbers read in fixed columns.
pub(crate) struct Block {
    pub(crate) values: Vec<f64>,
    pub(crate) lines: LineMap,
}

impl Fixed {
    pub(crate) const fn reals(per_line: usize, width: usize) -> Self {
        Self {
            per_line,
            width,
            real: true,
            gap: 0,
            whole_from: f64::INFINITY,
        }
    }

    pub(crate) const fn integers(per_line: usize, width: usize) -> Self {
        Self {
            per_line,
            width,
            real: false,
            gap: 0,
            whole_from: f64::INFINITY,
        }
    }

    /// The same, with one blank column after every number.
    pub(crate) const fn blank_behind(self) -> Self {
        Self {
            width: self.width + 1,
            gap: 1,
            ..self
        }
    }

    /// The same, for programs that print reals from this magnitude on without decimals, so that they fit their
    /// columns.
    pub(crate) const fn whole_from(self, magnitude: f64) -> Self {
        Self {
            whole_from: magnitude,
            ..self
        }
    }

    /// The format in a text such as `(8f10.6)`, `(10I8)` or `(8(1PE10.4E1))`; the last bracket counts.
    pub(crate) fn parse(text: &str) -> Option<Self> {
        let upper = text.to_ascii_uppercase();
        let open = upper.rfind('(')?;
        let before = upper[..open].trim_end_matches([' ', '(']);
        let inner = &upper[open + 1..];
        let inner = &inner[..inner.find(')')?];
        // A scale factor only moves the printed decimal point.
        let inner = inner.split_once('P').map_or(inner, |(_, rest)| rest).trim();
        let letter = inner.find(['F', 'E', 'I', 'G', 'D'])?;
        let repeat = inner[..letter].trim();
        let per_line = if repeat.is_empty() {
            // A count before the bracket, as in 8(1PE10.4E1).
            let count = before.rsplit(|c: char| !c.is_ascii_digit()).next()?;
            if count.is_empty() {
                1
            } else {
                count.parse().ok()?
            }
        } else {
            repeat.parse().ok()?
        };
        let width = inner[letter + 1..].split(['.', ',', 'E']).next()?;
        let fixed = Self {
            per_line,
            width: width.trim().parse().ok()?,
            real: !inner[letter..].starts_with('I'),
            gap: 0,
            whole_from: f64::INFINITY,
        };
        let sane = (1..=40).contains(&fixed.per_line) && (1..=40).contains(&fixed.width);
        sane.then_some(fixed)
    }

    /// Reads `count` numbers from the next lines. Every line but the last must be full, every number must end
    /// where its column ends, and nothing may follow.
    pub(crate) fn read(
        self,
        lines: &mut Lines<'_>,
        count: usize,
        format: RecordFormat,
    ) -> Result<Block, RecordError> {
        let header = lines.number();
        let mut block = Block {
            // The count of a header never determines the memory used.
            values: Vec::with_capacity(count.min(lines.bytes_left() / self.width + 1)),
            lines: LineMap::default(),
        };
        while block.values.len() < count {
            let found = block.values.len();
            let short = RecordError::Count {
                line: header,
                stated: count,
                found,
            };
            let wanted = self.per_line.min(count - found);
            let Some(line) = lines.next() else {
                return Err(short);
            };
            let read = self.read_line(&line.text, line.number, &mut block.values)?;
            if read == 0 {
                return Err(short);
            }
            if read != wanted {
                return Err(RecordError::Malformed {
                    format,
                    line: line.number,
                    problem: format!(
                        "{wanted} numbers in columns of {} were expected, found {read}",
                        self.width
                    ),
                });
            }
            block.lines.note(line.number, read);
        }
        Ok(block)
    }

    /// The numbers of a full line, each ending where its columns end and with a point if it is a real.
    pub(crate) fn cells(self, line: &str) -> Option<Vec<&str>> {
        if !line.is_ascii() || line.len() != self.per_line * self.width {
            return None;
        }
        let cell = |at: usize| {
            let cell = &line[at * self.width..(at + 1) * self.width];
            let digits = cell.trim_start();
            let plain = |b: u8| b.is_ascii_digit() || matches!(b, b'+' | b'-' | b'.');
            let whole = !digits.is_empty() && digits.bytes().all(plain);
            (whole && digits.contains('.') == self.real).then_some(digits)
        };
        (0..self.per_line).map(cell).collect()
    }

    /// Appends the numbers of a line; none if the line does not consist of numbers.
    fn read_line(
        self,
        text: &str,
        line: usize,
        values: &mut Vec<f64>,
    ) -> Result<usize, RecordError> {
        let bad = |found: &str| RecordError::NotANumber {
            line,
            found: shorten(found),
        };
        if !text.is_ascii() {
            return Err(bad(text.trim()));
        }
        let mut read = 0;
        let mut rest = text;
        while !rest.is_empty() {
            let (field, after) = rest.split_at((self.width - self.gap).min(rest.len()));
            let (gap, after) = after.split_at(self.gap.min(after.len()));
            let digits = field.trim_start();
            let plain = |b: u8| {
                b.is_ascii_digit() || matches!(b, b'+' | b'-' | b'.' | b'E' | b'e' | b'D' | b'd')
            };
            let whole = field.len() == self.width - self.gap
                && digits.bytes().all(plain)
                && gap.trim().is_empty();
            if read == 0 && !whole && digits.contains(char::is_alphabetic) {
                // The text that follows the numbers.
                return Ok(0);
            }
            if !whole {
                return Err(bad(digits.trim()));
            }
            let value = number(line, digits)?;
            let pointed = digits.contains('.') == self.real;
            if !pointed && (!self.real || value.abs() < self.whole_from) {
                return Err(bad(digits.trim()));
            }
            values.push(value);
            read += 1;
            rest = after;
        }
        Ok(read)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn fortran_formats_are_understood() {
        for (text, wanted) in [
            ("in cm/sec2. (8f10.6)", Fixed::reals(8, 10)),
            ("Format= (10I8)", Fixed::integers(10, 8)),
            ("units=cm/sec2(04),Format=(1E15.6)", Fixed::reals(1, 15)),
            ("(8(1PE10.4E1))", Fixed::reals(8, 10)),
            ("(5F15.6)", Fixed::reals(5, 15)),
            ("(E15.6)", Fixed::reals(1, 15)),
            ("(1P5E14.6)", Fixed::reals(5, 14)),
            ("¶(E10.3)", Fixed::reals(1, 10)),
        ] {
            assert_eq!(Fixed::parse(text), Some(wanted), "{text}");
        }
        for text in [
            "(UNITS: CM/SEC/SEC)",
            "",
            "(8f)",
            "(f",
            "(999999999f10.3)",
            "(0F10.3)",
        ] {
            assert_eq!(Fixed::parse(text), None, "{text}");
        }
    }
}
