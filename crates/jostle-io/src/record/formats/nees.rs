//! NEES `.asc`, as shake-table laboratories publish their tests: six header rows, then one row per instant.
//!
//! One of the six rows names the columns and begins with `Time`; one states their units and begins with a unit of time.
//! The other four are free text, such as the test, the date, the numbers of sensors and their places. Cells are separated
//! by tabs, else by commas or semicolons, else by blanks. The rows may come in any order, and numbers begin in line 7.

use crate::quantity::Dimension;
use crate::record::channel::Direction;
use crate::record::contents::{Contents, Scale, Trace};
use crate::record::error::RecordError;
use crate::record::formats::RecordFormat;
use crate::record::header::malformed;
use crate::record::lines::{LineMap, Lines};
use crate::record::measured::MeasuredTable;

const FORMAT: RecordFormat = RecordFormat::Nees;
/// Rows above the numbers.
pub(crate) const HEADER_ROWS: usize = 6;

/// Reads the accelerations of a table of measurements as channels.
pub(crate) fn read(bytes: &[u8]) -> Result<Contents, RecordError> {
    let table = MeasuredTable::parse(bytes)?;
    let step = table.step;
    let mut contents = Contents::new(FORMAT, Scale::Stated);
    contents.event = table.title.clone();
    let mut map = LineMap::default();
    for row in 0..table.points() {
        map.note(HEADER_ROWS + 1 + row, 1);
    }
    for column in table.columns {
        let Some((Dimension::Acceleration, size)) = column.size else {
            continue;
        };
        contents.traces.push(Trace {
            direction: Direction::parse(&column.name),
            name: column.name,
            unit: Some((column.unit, size)),
            step: Some(step),
            values: column.values,
            lines: map.clone(),
            peak: None,
        });
    }
    if contents.traces.is_empty() {
        let problem = "no column has a unit of acceleration, such as g or m/s2";
        return Err(malformed(FORMAT, table.unit_row, problem));
    }
    Ok(contents)
}

/// Whether the file has the whole layout: six header rows, names and units among them, and numbers from line 7 on.
pub(crate) fn is_nees(bytes: &[u8]) -> bool {
    let first = Lines::new(bytes).nth(HEADER_ROWS);
    let header = crate::record::measured::find_header(bytes);
    header.is_ok_and(|header| first.is_some_and(|row| header.begins_with(&row.text)))
}
