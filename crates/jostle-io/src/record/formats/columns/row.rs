//! The lines of columns of text: their cells, and whether they hold numbers, units, text, or none of these.

use std::ops::Range;

use crate::quantity::Dimension;
use crate::record::clock::{Clock, day};
use crate::record::lines::number;
use crate::record::units::{acceleration_unit, time_unit};
use crate::record::widths::{Widths, is_glued};
use crate::unit::Unit;

/// How lines of numbers are divided into cells.
#[derive(Clone, Debug, Default)]
pub(super) struct Splitter {
    /// Widths of numbers that stand without separators.
    pub(super) widths: Option<Widths>,
    /// Whether commas are decimal points, not separators.
    pub(super) decimal_comma: bool,
}

/// What a line holds.
#[derive(Debug)]
pub(super) enum Row<'t> {
    /// Numbers; the first cell may be a time of day.
    Numbers(Vec<&'t str>),
    /// A unit in every cell.
    Units(Vec<&'t str>),
    /// Text that says something: names of columns, a title.
    Text(Vec<&'t str>),
    /// A ruled line, such as `-----`.
    Rule,
    /// Numbers without separators.
    Glued,
    /// Numbers that do not fit the stated widths.
    Misfit,
    /// Neither numbers nor text: the first cell that is no number.
    Unreadable(&'t str),
}

impl Splitter {
    /// The cells of a line of numbers.
    pub(super) fn cells<'t>(&self, line: &'t str) -> Vec<&'t str> {
        let fields = self.widths.as_ref().and_then(|widths| widths.fields(line));
        fields.unwrap_or_else(|| free_cells(line, self.decimal_comma))
    }

    /// Classifies a line.
    pub(super) fn row<'t>(&self, line: &'t str) -> Row<'t> {
        if let Some(widths) = &self.widths
            && let Some(fields) = widths.fields(line).filter(|fields| are_numbers(fields))
        {
            return Row::Numbers(fields);
        }
        let cells = free_cells(line, self.decimal_comma);
        if are_numbers(&cells) {
            return match self.widths {
                Some(_) => Row::Misfit,
                None => Row::Numbers(cells),
            };
        }
        let dated = |cell: &&str| Clock::parse(cell).is_some() || day(cell).is_some();
        if !cells.is_empty() && cells.iter().all(dated) {
            return Row::Text(name_cells(line));
        }
        if is_glued(line) {
            return match self.widths {
                Some(_) => Row::Misfit,
                None => Row::Glued,
            };
        }
        if line.len() >= 5
            && line
                .bytes()
                .all(|b| matches!(b, b'-' | b'=' | b'_' | b'+' | b' '))
        {
            return Row::Rule;
        }
        let named = name_cells(line);
        if are_units(&named) {
            return Row::Units(named);
        }
        // A single letter in place of a single number says nothing, except the name of the acceleration.
        let letter = cells.len() == 1 && cells[0].chars().count() == 1 && cells[0] != "a";
        if !letter && cells.iter().any(|cell| says_something(cell)) {
            return Row::Text(named);
        }
        let bad = cells.iter().find(|cell| !is_number(cell));
        Row::Unreadable(bad.copied().unwrap_or(line.trim()))
    }
}

/// Whether a cell is a finite number.
pub(super) fn is_number(cell: &str) -> bool {
    number(0, cell).is_ok()
}

/// Whether all cells are numbers, the first one possibly a time of day.
fn are_numbers(cells: &[&str]) -> bool {
    let Some((first, rest)) = cells.split_first() else {
        return false;
    };
    let timed = !rest.is_empty() && Clock::parse(first).is_some();
    (timed || is_number(first)) && rest.iter().all(|cell| is_number(cell))
}

/// Words for values that are missing.
const MISSING: &[&str] = &[
    "", "-", "--", "---", "na", "n/a", "n.a.", "nan", "null", "none", "nil", "missing", "nodata",
    "inf", "infinity", "ind", "qnan", "snan", "error", "err", "value!", "num!", "div/0!", "ref!",
    "name?",
];

/// Whether a cell stands for a missing value, as spreadsheets and programs write it: `NaN`, `#N/A`, `-1.#IND`.
pub(super) fn is_missing(cell: &str) -> bool {
    let plain = cell
        .trim()
        .trim_matches(['#', '"', '<', '>', '*'])
        .to_lowercase();
    let unsigned = plain.trim_start_matches(['-', '+']);
    let unsigned = unsigned.split('(').next().unwrap_or(unsigned);
    MISSING.contains(&plain.as_str())
        || MISSING.contains(&unsigned)
        || unsigned.starts_with("1.#")
        || !cell.is_empty() && cell.bytes().all(|b| b == b'*')
}

/// Whether a cell has a word: letters that do not follow a digit or a point, and are no missing value.
fn says_something(cell: &str) -> bool {
    if is_number(cell) || is_missing(cell) {
        return false;
    }
    let mut before = ' ';
    for c in cell.chars() {
        let continues = before.is_ascii_digit() || before == '.';
        if c.is_alphabetic() {
            if !continues {
                return true;
            }
            // The rest of this run belongs to the digits before it.
            continue;
        }
        before = c;
    }
    false
}

/// Whether every cell is a unit, one of them of time or acceleration.
fn are_units(cells: &[&str]) -> bool {
    let plain = |cell: &str| {
        let marks = ['(', ')', '[', ']', '{', '}', '"', ' '];
        cell.trim_matches(marks).to_lowercase().replace("sec", "s")
    };
    let telling = |cell: &&str| time_unit(cell).is_some() || acceleration_unit(cell).is_some();
    let known = |cell: &&str| {
        let plain = plain(cell);
        let dimensions = [
            Dimension::Length,
            Dimension::Speed,
            Dimension::Force,
            Dimension::Moment,
            Dimension::Frequency,
            Dimension::Dimensionless,
        ];
        telling(cell)
            || plain.is_empty()
            || Unit::parse(&plain).is_ok_and(|unit| {
                dimensions
                    .iter()
                    .any(|dimension| unit.has_dimension(dimension.exponents()))
            })
    };
    let alone = |cell: &&str| acceleration_unit(cell).is_some();
    match cells {
        [] => false,
        [one] => alone(one),
        _ => cells.iter().any(telling) && cells.iter().all(known),
    }
}

/// Cells of a row of names: between tabs, semicolons or commas, else behind brackets, else between blanks.
fn name_cells(line: &str) -> Vec<&str> {
    if line.contains('\t') && !line.contains(';') {
        let line = line.strip_suffix('\t').unwrap_or(line);
        return line.split('\t').map(unquoted).collect();
    }
    let marked = line.contains([',', ';']);
    if marked || !line.contains(['(', '[']) || line.starts_with(['(', '[']) {
        return free_cells(line, false);
    }
    // `time (s)  acc (g)`: the blanks before brackets separate nothing.
    line.split_inclusive([')', ']'])
        .map(unquoted)
        .filter(|name| !name.is_empty())
        .collect()
}

fn unquoted(cell: &str) -> &str {
    cell.trim().trim_matches('"').trim()
}

/// Cells of a line: between semicolons, else commas, else blanks; what stands in quotes is one cell.
fn free_cells(line: &str, decimal_comma: bool) -> Vec<&str> {
    let line = line.trim();
    let quoted = line.contains('"');
    let has = |mark: char| match quoted {
        true => split(line, |c| c == mark).len() > 1,
        false => line.contains(mark),
    };
    let mark = if has(';') {
        Some(';')
    } else if !decimal_comma && has(',') {
        Some(',')
    } else {
        None
    };
    let cell = |range: Range<usize>| unquoted(&line[range]);
    match mark {
        Some(mark) => {
            let mut cells: Vec<_> = split(line, |c| c == mark).into_iter().map(cell).collect();
            // A separator at the end begins no further cell.
            if line.ends_with(mark) {
                cells.pop();
            }
            cells
        }
        None => {
            let ranges = split(line, char::is_whitespace);
            let mut ranges: Vec<_> = ranges
                .into_iter()
                .filter(|range| !range.is_empty())
                .collect();
            // A date and a time of day are one instant.
            if let [date, time, ..] = &ranges[..]
                && day(&line[date.clone()]).is_some()
                && Clock::parse(&line[time.clone()]).is_some()
            {
                let both = date.start..time.end;
                ranges.splice(..2, [both]);
            }
            ranges.into_iter().map(cell).collect()
        }
    }
}

/// Parts of a line between separators outside quotes.
fn split(line: &str, is_mark: impl Fn(char) -> bool) -> Vec<Range<usize>> {
    let mut parts = Vec::new();
    let (mut start, mut in_quotes) = (0, false);
    for (at, c) in line.char_indices() {
        if c == '"' {
            in_quotes = !in_quotes;
        } else if !in_quotes && is_mark(c) {
            parts.push(start..at);
            start = at + c.len_utf8();
        }
    }
    parts.push(start..line.len());
    parts
}

/// Whether the commas of lines of numbers are decimal points although nothing but blanks separates the numbers.
///
/// `0,0123` could be two whole numbers. It is one if numbers stand between blanks, if digits behind commas begin
/// with zeros, or if only the part before the comma is ever negative.
pub(super) fn has_decimal_commas<'t>(lines: impl Iterator<Item = &'t str>) -> bool {
    let (mut between_blanks, mut zeros, mut commas) = (0, 0, 0);
    let (mut negative, mut positive) = (0, 0);
    let mut digits_behind = None;
    let mut uniform = true;
    for line in lines {
        if line.contains(';') {
            return false;
        }
        let mut words = 0;
        for word in line.split_whitespace() {
            words += 1;
            let (before, behind) = match word.split_once(',') {
                None => (word, None),
                Some((before, behind)) => (before, Some(behind)),
            };
            let whole = before.trim_start_matches(['-', '+']);
            let plain = |text: &str| !text.is_empty() && text.bytes().all(|b| b.is_ascii_digit());
            if !(plain(whole) || whole.is_empty() && behind.is_some()) {
                return false;
            }
            let Some(behind) = behind else { continue };
            let fraction = behind.split(['e', 'E']).next().unwrap_or(behind);
            if !plain(fraction) {
                return false;
            }
            commas += 1;
            zeros += usize::from(fraction.len() > 1 && fraction.starts_with('0'));
            if before.starts_with('-') {
                negative += 1;
            } else {
                positive += 1;
            }
            uniform &= *digits_behind.get_or_insert(fraction.len()) == fraction.len();
        }
        between_blanks += usize::from(words > 1);
    }
    commas > 0 && (between_blanks > 0 || zeros > 0 || uniform && negative >= 2 && positive >= 2)
}
