//! The lines of numbers of a text: where they are, how many numbers they have, and what stands above them.

mod above;

use crate::quantity::shorten;
use crate::record::RecordOptions;
use crate::record::error::RecordError;
use crate::record::layout::RecordContent;
use crate::record::lines::{Line, Lines, number};
use crate::record::widths::Widths;

use above::Above;

use super::header::{Header, HeaderRow, bad_number, read_comment};
use super::row::{Row, Splitter, has_decimal_commas, is_missing, is_number};

/// Changes of the number of cells from line to line that are followed.
const MOST_RUNS: usize = 64;

/// The lines of a file that are read.
pub(super) struct Window<'t> {
    lines: Lines<'t>,
    skip: usize,
    last: usize,
    count: usize,
}

impl<'t> Window<'t> {
    pub(super) fn new(bytes: &'t [u8], options: &RecordOptions) -> Result<Self, RecordError> {
        options.layout.check()?;
        let lines = Lines::new(bytes);
        let count = lines.lines_left();
        let skip = options.layout.skip.unwrap_or(0);
        if skip > 0 && skip >= count {
            return Err(RecordError::Layout {
                problem: format!("skip = {skip}, but the file has {count} lines"),
            });
        }
        Ok(Self {
            lines,
            skip,
            last: options.layout.last.unwrap_or(usize::MAX),
            count,
        })
    }

    /// Whether the last line of the file is read.
    pub(super) fn reaches_end(&self) -> bool {
        self.last >= self.count
    }

    fn lines(&self) -> impl Iterator<Item = Line<'t>> + Clone {
        let last = self.last;
        let skip = self.skip;
        self.lines
            .clone()
            .skip(skip)
            .take_while(move |line| line.number <= last)
    }

    /// Lines from a number on that are neither blank nor comments.
    fn data(&self, first: usize) -> impl Iterator<Item = Line<'t>> + Clone {
        let from = self.lines().skip_while(move |line| line.number < first);
        from.filter(|line| !line.text.trim().is_empty() && comment(line.text.trim()).is_none())
    }
}

/// The content of a comment; errors of spreadsheets are none.
fn comment(line: &str) -> Option<&str> {
    let content = ["#", "%", "//", "!"]
        .iter()
        .find_map(|mark| line.strip_prefix(mark))?;
    (content.is_empty() || !is_missing(content)).then_some(content)
}

/// Consecutive lines with equally many numbers.
#[derive(Clone, Copy, Debug)]
struct Run {
    cells: usize,
    rows: usize,
    line: usize,
}

/// How the numbers below the first ones are printed.
#[derive(Clone, Copy, Default)]
struct Kinds {
    count: usize,
    /// Numbers other than zero without a decimal point.
    whole: usize,
    /// Decimals of the first number.
    decimals: Option<usize>,
    /// Whether all have as many.
    mixed: bool,
}

impl Kinds {
    fn note(&mut self, cell: &str, value: f64) {
        self.count += 1;
        self.whole += usize::from(value != 0.0 && decimals(cell) == 0);
        self.mixed |= *self.decimals.get_or_insert(decimals(cell)) != decimals(cell);
    }
}

/// Decimals of a printed number; beyond any for one with an exponent.
fn decimals(cell: &str) -> usize {
    if cell.contains(['e', 'E', 'd', 'D']) {
        return usize::MAX;
    }
    cell.find(['.', ','])
        .map_or(0, |at| (cell.len() - at).max(2) - 1)
}

/// A first line of numbers, as printed.
struct First {
    line: usize,
    cells: Vec<String>,
}

/// The number of values and the step above the values.
pub(super) struct Head {
    /// Lines of numbers that they take.
    pub(super) lines: usize,
    pub(super) step: Option<f64>,
    /// Content that the number shows.
    pub(super) content: Option<RecordContent>,
}

/// The lines of numbers of a text.
#[derive(Default)]
pub(super) struct Table {
    pub(super) header: Header,
    splitter: Splitter,
    runs: Vec<Run>,
    /// Numbers of all lines.
    pub(super) numbers: usize,
    firsts: Vec<First>,
    /// How the numbers below the first line and below the second one are printed.
    below: [Kinds; 2],
    /// First line of numbers that is data.
    start: usize,
    /// Cells that must be numbers; all of them if the columns have no names.
    needed: Option<Vec<usize>>,
}

impl Table {
    /// Reads all lines once.
    pub(super) fn scan(window: &Window<'_>, options: &RecordOptions) -> Result<Self, RecordError> {
        let sample: Vec<_> = window.data(0).filter(is_digits).take(COMMA_LINES).collect();
        let decimal_comma = has_decimal_commas(sample.iter().map(|line| line.text.trim()));
        let splitter = Splitter {
            widths: Widths::stated(&options.layout.widths),
            decimal_comma,
        };
        drop(sample);
        match Self::scan_with(window, options, splitter.clone())? {
            Scanned::Table(table) => Ok(*table),
            Scanned::Glued(first) => {
                let widths = Widths::shown(window.data(first))?;
                let splitter = Splitter {
                    widths: Some(widths),
                    ..splitter
                };
                match Self::scan_with(window, options, splitter)? {
                    Scanned::Table(table) => Ok(*table),
                    Scanned::Glued(line) => Err(bad_number(line, "")),
                }
            }
        }
    }

    fn scan_with(
        window: &Window<'_>,
        options: &RecordOptions,
        splitter: Splitter,
    ) -> Result<Scanned, RecordError> {
        let mut table = Self {
            splitter: splitter.clone(),
            ..Self::default()
        };
        let mut above = Above::default();
        // First line of numbers, for numbers without separators.
        let mut first = None;
        for line in window.lines() {
            let (at, text) = (line.number, line.text.trim());
            if let Some(comment) = comment(text) {
                table.check_comment(at, text, comment)?;
                read_comment(&mut table.header, at, comment)?;
                continue;
            }
            if text.is_empty() {
                continue;
            }
            // Widths count from the begin of the line.
            let row = splitter.row(if splitter.widths.is_some() {
                &line.text
            } else {
                text
            });
            match row {
                Row::Glued => return Ok(Scanned::Glued(first.unwrap_or(at))),
                Row::Misfit => {
                    return Err(RecordError::Widths {
                        line: at,
                        widths: options.layout.widths.clone(),
                    });
                }
                Row::Numbers(cells) => {
                    if table.runs.is_empty() {
                        first = Some(at);
                        above.read(&mut table, cells.len(), options)?;
                    }
                    table.push(at, &cells)?;
                }
                Row::Rule if table.runs.is_empty() => {}
                _ if !table.runs.is_empty() => {
                    let cells = splitter.cells(text);
                    match table.bad_cell(&cells) {
                        None => table.push(at, &cells)?,
                        Some(bad) => {
                            let text = matches!(row, Row::Text(_)) && table.runs.len() == 1;
                            let few = table.runs.iter().map(|run| run.rows).sum::<usize>() <= 3;
                            let header = text
                                && few
                                && above.is_empty()
                                && !cells.iter().any(|cell| is_number(cell));
                            return Err(match header {
                                true => RecordError::TextBelowNumbers {
                                    line: at,
                                    found: shorten(bad),
                                },
                                false => bad_number(at, bad),
                            });
                        }
                    }
                }
                Row::Units(cells) => above.units(HeaderRow::new(at, &cells)),
                Row::Text(names) => {
                    let cells = splitter.cells(text);
                    if above.begins(&mut table, &cells, options)? {
                        table.push(at, &cells)?;
                    } else {
                        above.text(HeaderRow::new(at, &names), &cells)?;
                    }
                }
                Row::Rule | Row::Unreadable(_) => {
                    let found = match row {
                        Row::Unreadable(found) => found,
                        _ => text,
                    };
                    let cells = splitter.cells(text);
                    if !above.begins(&mut table, &cells, options)? {
                        return Err(bad_number(at, found));
                    }
                    table.push(at, &cells)?;
                }
            }
        }
        above.check_suspects(&table)?;
        Ok(Scanned::Table(Box::new(table)))
    }

    /// Behind the first numbers, a mark in place of a digit is damage.
    fn check_comment(&self, line: usize, text: &str, comment: &str) -> Result<(), RecordError> {
        let begins = comment.starts_with(|c: char| c.is_ascii_digit() || matches!(c, '.' | '-'));
        let cells = self.runs.last().map(|run| run.cells);
        if begins && cells == Some(self.splitter.cells(comment).len()) {
            let cells = self.splitter.cells(text);
            return Err(bad_number(line, cells.first().unwrap_or(&text)));
        }
        Ok(())
    }

    /// The first cell that must be a number and is none.
    fn bad_cell<'c>(&self, cells: &[&'c str]) -> Option<&'c str> {
        let must = |at: usize| match &self.needed {
            Some(needed) => needed.contains(&at),
            None => true,
        };
        let known = self.runs.last().is_some_and(|run| run.cells == cells.len());
        let bad = |(at, cell): &(usize, &&str)| (must(*at) || !known) && !is_number(cell);
        cells.iter().enumerate().find(bad).map(|(_, cell)| *cell)
    }

    fn push(&mut self, line: usize, cells: &[&str]) -> Result<(), RecordError> {
        let rows = self.firsts.len();
        if rows < 2 {
            let cells = cells.iter().map(|cell| (*cell).to_owned()).collect();
            self.firsts.push(First { line, cells });
        }
        for (at, kinds) in self.below.iter_mut().enumerate() {
            if rows > at {
                for cell in cells {
                    kinds.note(cell, number(line, cell).unwrap_or(0.0));
                }
            }
        }
        self.numbers += cells.len();
        let is_full = self.runs.len() == MOST_RUNS;
        match self.runs.last_mut() {
            Some(run) if run.cells == cells.len() => run.rows += 1,
            _ if is_full => {}
            _ => self.runs.push(Run {
                cells: cells.len(),
                rows: 1,
                line,
            }),
        }
        self.start = self.start.max(self.firsts[0].line);
        Ok(())
    }

    /// Numbers on a line.
    pub(super) fn columns(&self) -> usize {
        self.runs.first().map_or(0, |run| run.cells)
    }

    /// The first line of data.
    pub(super) fn first_line(&self) -> usize {
        self.start
    }

    /// Lines of data.
    pub(super) fn row_count(&self) -> usize {
        self.runs.iter().map(|run| run.rows).sum()
    }

    /// Calls `read` with the number and the cells of every line of data.
    pub(super) fn rows(
        &self,
        window: &Window<'_>,
        mut read: impl FnMut(usize, &[&str]) -> Result<(), RecordError>,
    ) -> Result<(), RecordError> {
        for line in window.data(self.start) {
            read(line.number, &self.splitter.cells(&line.text))?;
        }
        Ok(())
    }

    /// The number of values, and possibly the step, if a first line states exactly the number that follow.
    pub(super) fn count_and_step(&self, options: &RecordOptions) -> Option<Head> {
        if options.layout.skip.is_some() || self.runs.len() == MOST_RUNS {
            return None;
        }
        let first: Vec<&str> = self
            .firsts
            .first()?
            .cells
            .iter()
            .map(String::as_str)
            .collect();
        let second = self.firsts.get(1).map(|row| &row.cells[..]);
        match (&first[..], second) {
            ([one, two], _) => self
                .head(1, one, Some(two))
                .or_else(|| self.head(1, two, Some(one))),
            ([one], Some([two])) => {
                let two = two.as_str();
                let both = self
                    .head(2, one, Some(two))
                    .or_else(|| self.head(2, two, Some(one)));
                both.or_else(|| self.head(1, one, None))
            }
            ([one], _) => self.head(1, one, None),
            _ => None,
        }
    }

    fn head(&self, lines: usize, count: &str, step: Option<&str>) -> Option<Head> {
        let count: usize = count
            .trim_end_matches('.')
            .parse()
            .ok()
            .filter(|count| *count >= 2)?;
        let step = match step {
            Some(text) => {
                let step = number(0, text).ok();
                Some(step.filter(|step| (1e-6..=10.0).contains(step))?)
            }
            None => None,
        };
        let taken = 1 + usize::from(step.is_some());
        let rows = self.row_count().checked_sub(lines)?;
        let numbers = self.numbers.checked_sub(taken)?;
        let content = if numbers == count && rows == count {
            None
        } else if numbers == count {
            Some(RecordContent::Values)
        } else if rows == count && numbers > count {
            Some(RecordContent::Columns)
        } else if numbers == 2 * count {
            Some(RecordContent::Pairs)
        } else {
            return None;
        };
        Some(Head {
            lines,
            step,
            content,
        })
    }

    /// Leaves first lines out.
    pub(super) fn leave_out(&mut self, lines: usize) {
        for _ in 0..lines {
            let Some(run) = self.runs.first_mut() else {
                return;
            };
            self.numbers -= run.cells;
            run.rows -= 1;
            run.line += 1;
            if run.rows == 0 {
                self.runs.remove(0);
            }
        }
        let last = self.firsts.get(lines - 1).map_or(0, |first| first.line);
        self.start = last + 1;
        self.firsts.clear();
    }

    /// Refuses lines with another number of values than stated; the last may have fewer.
    pub(super) fn check_per_line(&self, stated: usize) -> Result<(), RecordError> {
        let last = self.runs.len().saturating_sub(1);
        for (at, run) in self.runs.iter().enumerate() {
            let is_rest = at == last && at > 0 && run.rows == 1 && run.cells < stated;
            if run.cells != stated && !is_rest {
                return Err(RecordError::PerLine {
                    line: run.line,
                    found: run.cells,
                    stated,
                });
            }
        }
        Ok(())
    }

    /// Refuses lines of different length in a table of columns. `may_continue` says that a shorter last line can be
    /// the end of values that continue from line to line.
    pub(super) fn check_rows(
        &self,
        header: &Header,
        may_continue: bool,
    ) -> Result<(), RecordError> {
        let has_names = header.names == self.columns();
        let [first, second, rest @ ..] = &self.runs[..] else {
            return Ok(());
        };
        let ends = rest.is_empty() && second.rows == 1 && second.cells < first.cells;
        if ends && may_continue && !has_names && first.rows >= 2 {
            return Err(RecordError::Continued {
                line: second.line,
                count: first.cells,
                last: Some(second.cells),
            });
        }
        if first.rows == 1 && second.rows >= 2 && !has_names {
            return Err(RecordError::FirstLine {
                line: first.line,
                found: first.cells,
                below: second.cells,
            });
        }
        Err(RecordError::Ragged {
            line: second.line,
            found: second.cells,
            expected: first.cells,
        })
    }

    /// Asks about a first number that may be a count or a step.
    pub(super) fn check_first_number(
        &self,
        header: &Header,
        options: &RecordOptions,
    ) -> Result<(), RecordError> {
        let counted = header
            .points
            .is_some_and(|(points, _)| points == self.numbers);
        let (Some(first), None, false) = (self.firsts.first(), options.layout.skip, counted) else {
            return Ok(());
        };
        let Some(cell) = first.cells.first() else {
            return Ok(());
        };
        let [below, further] = &self.below;
        let value = number(first.line, cell)?;
        if below.count < 3 || value <= 0.0 {
            return Ok(());
        }
        let digits = |kinds: &Kinds, cell: &str| {
            !kinds.mixed && kinds.decimals.is_some_and(|usual| usual != decimals(cell))
        };
        let difference = if decimals(cell) == 0 && below.whole == 0 {
            "has no decimal point, and all numbers below have one"
        } else if digits(below, cell)
            && header
                .step
                .is_some_and(|step| (step / value - 1.0).abs() < 1e-9)
        {
            "is the time step, and has other digits than all numbers below"
        } else if digits(below, cell) {
            "has other digits than all numbers below"
        } else {
            return Ok(());
        };
        let mut skip = first.line;
        if let Some(second) = self.firsts.get(1)
            && let [cell] = &second.cells[..]
            && digits(further, cell)
            && number(second.line, cell)? > 0.0
        {
            skip = second.line;
        }
        Err(RecordError::FirstNumber {
            line: first.line,
            found: shorten(cell),
            difference: difference.to_owned(),
            skip,
        })
    }
}

/// Lines in which commas are looked at.
const COMMA_LINES: usize = 2000;

/// Whether a line has digits, and no letters but those of exponents.
fn is_digits(line: &Line<'_>) -> bool {
    let letter = |c: char| c.is_alphabetic() && !matches!(c, 'e' | 'E');
    line.text.contains(|c: char| c.is_ascii_digit()) && !line.text.contains(letter)
}

enum Scanned {
    Table(Box<Table>),
    /// Numbers without separators; from this line on.
    Glued(usize),
}
