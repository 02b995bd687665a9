//! Numbers of Parquet files that earlier steps wrote.

use std::collections::HashMap;
use std::path::Path;

use jostle_io::undamaged;
use parquet::column::reader::ColumnReader;
use parquet::file::reader::{FileReader, SerializedFileReader};

use crate::fault::CityError;

/// Columns of numbers of a table by their names, and the facts about it.
#[derive(Debug, Default)]
pub(crate) struct Table {
    numbers: HashMap<String, Vec<f64>>,
    pub(crate) facts: HashMap<String, String>,
    pub(crate) rows: usize,
}

impl Table {
    /// Reads a table. Absent numbers become NaN; other columns are left out.
    pub(crate) fn read(path: &Path) -> Result<Self, CityError> {
        undamaged(|| Self::read_whole(path)).map_err(|problem| {
            // Faults of the file name it already.
            let named = problem.starts_with(&path.display().to_string());
            if named {
                CityError::Input(problem)
            } else {
                CityError::of(path, problem)
            }
        })
    }

    fn read_whole(path: &Path) -> Result<Self, CityError> {
        let fault = |error: &dyn std::fmt::Display| CityError::of(path, error);
        let file = jostle_io::open_file(path).map_err(|error| fault(&error))?;
        let reader = SerializedFileReader::new(file).map_err(|error| fault(&error))?;
        let mut table = Self::default();
        let notes = reader
            .metadata()
            .file_metadata()
            .key_value_metadata()
            .cloned();
        for note in notes.into_iter().flatten() {
            table.facts.insert(note.key, note.value.unwrap_or_default());
        }
        for group in 0..reader.num_row_groups() {
            let group = reader.get_row_group(group).map_err(|error| fault(&error))?;
            let rows = usize::try_from(group.metadata().num_rows()).unwrap_or(0);
            table.rows += rows;
            for at in 0..group.num_columns() {
                let column = group.metadata().column(at).column_descr_ptr();
                let name = column.name().to_owned();
                let optional = column.max_def_level() > 0;
                let mut column = group.get_column_reader(at).map_err(|error| fault(&error))?;
                let mut levels = Vec::with_capacity(rows);
                macro_rules! read {
                    ($reader:expr) => {{
                        let mut values = Vec::with_capacity(rows);
                        let mut left = rows;
                        while left > 0 {
                            let level = optional.then_some(&mut levels);
                            let (read, _, _) = $reader
                                .read_records(left, level, None, &mut values)
                                .map_err(|error| fault(&error))?;
                            if read == 0 {
                                return Err(fault(&"is cut short"));
                            }
                            left -= read;
                        }
                        values
                    }};
                }
                match &mut column {
                    ColumnReader::DoubleColumnReader(reader) => {
                        let values = read!(reader);
                        let values = spread(values.into_iter(), &levels, optional);
                        table.numbers.entry(name).or_default().extend(values);
                    }
                    ColumnReader::Int32ColumnReader(reader) => {
                        let values = read!(reader).into_iter().map(f64::from);
                        let values = spread(values, &levels, optional);
                        table.numbers.entry(name).or_default().extend(values);
                    }
                    _ => {}
                }
            }
        }
        Ok(table)
    }

    /// A column of numbers.
    pub(crate) fn numbers(&self, path: &Path, name: &str) -> Result<&[f64], CityError> {
        let found = self
            .numbers
            .get(name)
            .filter(|number| number.len() == self.rows);
        found
            .map(Vec::as_slice)
            .ok_or_else(|| CityError::of(path, format!("has no column \"{name}\"")))
    }
}

/// Values at the rows that have one.
fn spread(mut values: impl Iterator<Item = f64>, levels: &[i16], optional: bool) -> Vec<f64> {
    if !optional {
        return values.collect();
    }
    levels
        .iter()
        .map(|level| {
            if *level > 0 {
                values.next().unwrap_or(f64::NAN)
            } else {
                f64::NAN
            }
        })
        .collect()
}
