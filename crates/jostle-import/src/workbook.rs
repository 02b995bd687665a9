//! Tables of an Excel workbook, found by their title row or their columns, never by the name of a sheet.

use std::io::{Cursor, Read};

use calamine::{Data, DataRef, Reader, Xlsx};
use flate2::bufread::DeflateDecoder;
use rawzip::{CompressionMethod, ZipArchive};

use crate::text::{number, plain};
use crate::units;

/// Most bytes that a workbook may inflate to: forty times a workbook of a tower of 60 storeys.
const MOST_INFLATED: u64 = 256 << 20;
/// Most bytes that its cells may take: a short string may stand in millions of cells.
const MOST_TEXT: usize = 512 << 20;
/// Most sheets of a workbook.
const MOST_SHEETS: usize = 500;
/// Columns of the widest table.
const MOST_COLUMNS: u32 = 256;

/// A table of results.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Table {
    /// Title as written, or the name of the sheet in quotes where there is none.
    pub(crate) name: String,
    /// Names of columns in lower case without blanks, and the unit of each where a row says it.
    pub(crate) columns: Vec<(String, Option<String>)>,
    /// Whether a row of units was found.
    pub(crate) has_units: bool,
    /// Rows below, each with its number in the sheet.
    pub(crate) rows: Vec<(u32, Vec<String>)>,
}

impl Table {
    /// The column with one of these names.
    pub(crate) fn column(&self, names: &[&str]) -> Option<usize> {
        let of = |name: &&str| {
            self.columns
                .iter()
                .position(|(candidate, _)| candidate == name)
        };
        names.iter().find_map(of)
    }

    /// The text of a cell, empty where there is none.
    pub(crate) fn text(row: &[String], column: Option<usize>) -> &str {
        column
            .and_then(|at| row.get(at))
            .map_or("", |text| text.trim())
    }
}

/// Reads all tables.
///
/// # Errors
/// The problem in words.
pub(crate) fn read(bytes: &[u8]) -> Result<Vec<Table>, String> {
    bounded(bytes)?;
    let broken = |error: &dyn std::fmt::Display| {
        format!(
            "is no Excel workbook that can be read ({error}); export the tables from ETABS as .xlsx"
        )
    };
    let mut book = Xlsx::new(Cursor::new(bytes)).map_err(|e| broken(&e))?;
    let names: Vec<String> = book.sheet_names();
    let mut tables = Vec::new();
    if names.len() > MOST_SHEETS {
        return Err(format!(
            "has more than {MOST_SHEETS} sheets; export only the tables that are needed"
        ));
    }
    let mut left = MOST_TEXT;
    for name in names {
        // Charts have no cells.
        let Ok(mut reader) = book.worksheet_cells_reader(&name) else {
            continue;
        };
        let mut rows: Vec<(u32, Vec<String>)> = Vec::new();
        while let Some(cell) = reader.next_cell().map_err(|e| broken(&e))? {
            let (row, column) = cell.get_position();
            let text = written(cell.get_value());
            left = left.saturating_sub(text.len() + size_of::<String>());
            if column >= MOST_COLUMNS || text.is_empty() {
                continue;
            }
            if rows.last().is_none_or(|last| last.0 != row) {
                rows.push((row, Vec::new()));
            }
            if let Some((_, values)) = rows.last_mut() {
                let at = column as usize;
                // Places left empty take memory as well.
                left = left.saturating_sub(at.saturating_sub(values.len()) * size_of::<String>());
                if values.len() <= at {
                    values.resize(at + 1, String::new());
                }
                values[at] = text;
            }
            if left == 0 {
                return Err(
                    "has more cells than can be read; export only the tables that are needed"
                        .into(),
                );
            }
        }
        split(&name, rows, &mut tables);
    }
    Ok(tables)
}

/// Refuses an archive that inflates to more than can be read.
fn bounded(bytes: &[u8]) -> Result<(), String> {
    if bytes.starts_with(b"\xd0\xcf\x11\xe0") {
        return Err("is a workbook of Excel 97 (.xls); save it as .xlsx".into());
    }
    let broken = |error: &dyn std::fmt::Display| {
        format!("is no Excel workbook ({error}); export the tables from ETABS as .xlsx")
    };
    let archive = ZipArchive::from_slice(bytes).map_err(|e| broken(&e))?;
    let mut left = MOST_INFLATED;
    let mut entries = archive.entries();
    while let Some(entry) = entries.next_entry().map_err(|e| broken(&e))? {
        let local = archive
            .get_entry(entry.wayfinder())
            .map_err(|e| broken(&e))?;
        let inflated = match entry.compression_method() {
            CompressionMethod::DEFLATE => {
                let mut content = DeflateDecoder::new(local.data()).take(left);
                std::io::copy(&mut content, &mut std::io::sink()).map_err(|e| broken(&e))?
            }
            _ => local.data().len() as u64,
        };
        left = left.saturating_sub(inflated);
        if left == 0 {
            return Err(format!(
                "inflates to more than {} MiB, the most that is read of a workbook; export only the tables that are needed",
                MOST_INFLATED >> 20
            ));
        }
    }
    Ok(())
}

/// What a cell shows.
fn written(value: &DataRef<'_>) -> String {
    match value {
        DataRef::Float(value) => value.to_string(),
        DataRef::Int(value) => value.to_string(),
        DataRef::Empty => String::new(),
        DataRef::Error(_) => "#error".into(),
        other => Data::from(other.clone()).to_string(),
    }
}

/// Splits the rows of a sheet at titles.
fn split(sheet: &str, rows: Vec<(u32, Vec<String>)>, tables: &mut Vec<Table>) {
    let mut rows = rows.into_iter().peekable();
    let mut title = format!("sheet \"{sheet}\"");
    while let Some((_, row)) = rows.next() {
        let first = row.first().map_or("", |text| text.trim());
        let named = first
            .get(..6)
            .filter(|start| start.eq_ignore_ascii_case("TABLE:"));
        let header = match named {
            Some(_) => {
                title = first[6..].trim().trim_matches('"').to_owned();
                match rows.next() {
                    Some((_, header)) => header,
                    None => return,
                }
            }
            None => row,
        };
        let names: Vec<String> = header.iter().map(|name| plain(name)).collect();
        if names.iter().filter(|name| !name.is_empty()).count() < 2 {
            continue;
        }
        let units = rows.next_if(|(_, row)| is_units(row));
        let has_units = units.is_some();
        let of = |at: usize| {
            let unit = units.as_ref().and_then(|(_, row)| row.get(at));
            unit.map(|unit| unit.trim().to_owned())
                .filter(|unit| !unit.is_empty())
        };
        let columns = names
            .into_iter()
            .enumerate()
            .map(|(at, name)| (name, of(at)))
            .collect();
        let mut table = Table {
            name: title.clone(),
            columns,
            has_units,
            rows: Vec::new(),
        };
        while let Some((at, row)) = rows.next_if(|(_, row)| !is_title(row)) {
            table.rows.push((at + 1, row));
        }
        tables.push(table);
    }
}

fn is_title(row: &[String]) -> bool {
    let start = row.first().and_then(|text| text.trim().get(..6));
    start.is_some_and(|start| start.eq_ignore_ascii_case("TABLE:"))
}

/// Whether a row below the names holds units: no number, and at least one unit that is known.
fn is_units(row: &[String]) -> bool {
    let filled = || {
        row.iter()
            .map(|text| text.trim())
            .filter(|text| !text.is_empty())
    };
    filled().next().is_some()
        && filled().all(|text| number(text).is_none())
        && filled().any(|text| units::parse(text).is_some())
        && row
            .first()
            .is_none_or(|text| text.trim().is_empty() || units::parse(text).is_some())
}
