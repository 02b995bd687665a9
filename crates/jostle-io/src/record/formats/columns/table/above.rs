//! The rows above the numbers of a text: names, units, and rows that may be data with a value missing.

use super::{First, Table};
use crate::record::RecordOptions;
use crate::record::error::RecordError;
use crate::record::formats::columns::header::{HeaderRow, bad_number, read_columns};
use crate::record::formats::columns::row::is_number;
use crate::record::lines::number;

/// Lines of text accepted before the data.
const MOST_HEADER_ROWS: usize = 50;

/// The rows above the numbers.
#[derive(Default)]
pub(super) struct Above {
    names: Option<HeaderRow>,
    units: Option<HeaderRow>,
    rows: usize,
    /// Rows of numbers and words.
    suspects: Vec<Suspect>,
}

/// A row above the data that may be a row of data with a value missing.
struct Suspect {
    line: usize,
    cells: usize,
    first: Option<f64>,
    bad: String,
    letters: usize,
}

impl Above {
    pub(super) fn is_empty(&self) -> bool {
        self.rows == 0
    }

    pub(super) fn units(&mut self, row: HeaderRow) {
        self.rows += 1;
        self.units = Some(row);
    }

    /// The row nearest to the numbers names the columns, or the one above a row of units.
    pub(super) fn text(&mut self, row: HeaderRow, cells: &[&str]) -> Result<(), RecordError> {
        self.rows += 1;
        if self.rows > MOST_HEADER_ROWS {
            return Err(bad_number(row.line, cells.first().unwrap_or(&"")));
        }
        let bad = cells.iter().find(|cell| !is_number(cell));
        if let (Some(bad), true) = (bad, cells.iter().any(|cell| is_number(cell))) {
            let letters = cells.iter().flat_map(|cell| cell.chars());
            self.suspects.push(Suspect {
                line: row.line,
                cells: cells.len(),
                first: cells.first().and_then(|first| number(0, first).ok()),
                bad: (*bad).to_owned(),
                letters: letters.filter(|c| c.is_alphabetic()).count(),
            });
        }
        self.names = Some(row);
        self.units = None;
        Ok(())
    }

    /// Reads names and units of the columns.
    pub(super) fn read(
        &self,
        table: &mut Table,
        columns: usize,
        options: &RecordOptions,
    ) -> Result<(), RecordError> {
        let (names, units) = (self.names.as_ref(), self.units.as_ref());
        read_columns(&mut table.header, names, units, columns, options)?;
        if table.header.names == columns {
            let by_number = options.column.and_then(|column| column.checked_sub(1));
            let read = by_number.or(table.header.acceleration_column);
            table.needed = read.map(|read| vec![table.header.time_column.unwrap_or(0), read]);
        }
        Ok(())
    }

    /// Whether a row is the first of a table with names, whose cells of time and acceleration are numbers although
    /// others are not.
    pub(super) fn begins(
        &self,
        table: &mut Table,
        cells: &[&str],
        options: &RecordOptions,
    ) -> Result<bool, RecordError> {
        let named = self
            .names
            .as_ref()
            .is_some_and(|row| row.cells.len() == cells.len());
        if !named || !cells.first().is_some_and(|cell| is_number(cell)) {
            return Ok(false);
        }
        let mut tried = Table {
            header: table.header.clone(),
            ..Table::default()
        };
        self.read(&mut tried, cells.len(), options)?;
        let begins = tried.needed.as_ref().is_some_and(|needed| {
            needed
                .iter()
                .all(|at| cells.get(*at).is_some_and(|cell| is_number(cell)))
        });
        if begins {
            table.needed = tried.needed;
            table.header = tried.header;
        }
        Ok(begins)
    }

    /// Refuses a row above the data that has as many cells, begins with a number that continues the times below, or
    /// has hardly a letter: a value is missing in it.
    pub(super) fn check_suspects(&self, table: &Table) -> Result<(), RecordError> {
        let first = |row: Option<&First>| row?.cells.first().and_then(|cell| number(0, cell).ok());
        let times = first(table.firsts.first()).zip(first(table.firsts.get(1)));
        let continues = |time: f64| {
            times.is_some_and(|(one, two)| {
                let steps = (one - time) / (two - one);
                two > one && (0.5..1e6).contains(&steps) && (steps - steps.round()).abs() < 0.05
            })
        };
        for suspect in self
            .suspects
            .iter()
            .filter(|row| row.cells == table.columns())
        {
            if suspect.first.is_some_and(continues) || suspect.letters < 3 {
                return Err(bad_number(suspect.line, &suspect.bad));
            }
        }
        Ok(())
    }
}
