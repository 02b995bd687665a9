//! Reading columns of a study back.

use std::collections::BTreeMap;
use std::path::Path;

use parquet::column::reader::ColumnReader;
use parquet::errors::ParquetError;
use parquet::file::reader::{ChunkReader, FileReader, SerializedFileReader};

use super::{PartFault, part_path, verify};
use crate::study::{Study, StudyError};

/// Columns of a study, case by case.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Table {
    /// Numbers by column; whole ones too.
    pub numbers: BTreeMap<String, Vec<Option<f64>>>,
    /// Texts by column.
    pub texts: BTreeMap<String, Vec<String>>,
    /// Number of rows.
    pub rows: usize,
}

impl Table {
    /// The numbers of a column; empty when it has none.
    #[must_use]
    pub fn column(&self, name: &str) -> &[Option<f64>] {
        self.numbers.get(name).map_or(&[], |values| values)
    }

    /// Adds some rows of another table.
    pub(crate) fn take_rows(&mut self, other: &Self, rows: &[usize]) {
        for (name, values) in &other.numbers {
            let numbers = self.numbers.entry(name.clone()).or_default();
            numbers.extend(rows.iter().map(|row| values.get(*row).copied().flatten()));
        }
        for (name, values) in &other.texts {
            let texts = self.texts.entry(name.clone()).or_default();
            texts.extend(
                rows.iter()
                    .map(|row| values.get(*row).cloned().unwrap_or_default()),
            );
        }
        self.rows += rows.len();
    }
}

/// Reads columns of all parts, in the order of the cases.
///
/// # Errors
/// [`StudyError::Output`] when a part is absent, damaged, or not of this study.
pub fn read_columns(study: &Study, folder: &Path, wanted: &[&str]) -> Result<Table, StudyError> {
    let mut table = Table::default();
    for part in 0..study.parts() {
        read_part(study, folder, part, wanted, &mut table)?;
    }
    Ok(table)
}

/// Reads columns part by part; `visit` is called with the first case of a part and its rows.
pub(crate) fn visit_parts(
    study: &Study,
    folder: &Path,
    wanted: &[&str],
    visit: &mut dyn FnMut(u64, Table),
) -> Result<(), StudyError> {
    for part in 0..study.parts() {
        let mut table = Table::default();
        read_part(study, folder, part, wanted, &mut table)?;
        visit(study.part(part).start, table);
    }
    Ok(())
}

/// Numbers of the parts that a folder does not hold: absent, damaged, or not of this study.
#[must_use]
pub fn missing_parts(study: &Study, folder: &Path) -> Vec<u64> {
    (0..study.parts())
        .filter(|part| verify(study, folder, *part).is_err())
        .collect()
}

/// Verifies a part and adds its rows to a table.
pub(crate) fn read_part(
    study: &Study,
    folder: &Path,
    part: u64,
    wanted: &[&str],
    table: &mut Table,
) -> Result<(), StudyError> {
    let path = part_path(folder, study.part(part).start);
    let wrong =
        |fault: &dyn std::fmt::Display| StudyError::Output(format!("{} {fault}", path.display()));
    verify(study, folder, part).map_err(|fault| wrong(&fault))?;
    // Only these columns are read.
    let file = jostle_io::open_file(&path).map_err(|error| wrong(&format!("{error}")))?;
    read_rows(file, wanted, table).map_err(|error| wrong(&PartFault::Damaged(error.to_string())))
}

/// Adds the rows of a Parquet file to a table.
pub(super) fn read_rows<R: ChunkReader + 'static>(
    file: R,
    wanted: &[&str],
    table: &mut Table,
) -> Result<(), ParquetError> {
    let reader = SerializedFileReader::new(file)?;
    for group in 0..reader.num_row_groups() {
        let group = reader.get_row_group(group)?;
        let rows = usize::try_from(group.metadata().num_rows()).unwrap_or(0);
        for index in 0..group.num_columns() {
            let description = group.metadata().column(index).column_descr();
            let name = description.name().to_owned();
            if !wanted.contains(&&name[..]) {
                continue;
            }
            let most = description.max_def_level();
            match group.get_column_reader(index)? {
                ColumnReader::DoubleColumnReader(mut reader) => {
                    let (mut levels, mut values) = (Vec::new(), Vec::new());
                    reader.read_records(rows, Some(&mut levels), None, &mut values)?;
                    let numbers = table.numbers.entry(name).or_default();
                    spread(rows, most, &levels, values.into_iter(), numbers);
                }
                ColumnReader::Int32ColumnReader(mut reader) => {
                    let (mut levels, mut values) = (Vec::new(), Vec::new());
                    reader.read_records(rows, Some(&mut levels), None, &mut values)?;
                    let numbers = table.numbers.entry(name).or_default();
                    let values = values.into_iter().map(f64::from);
                    spread(rows, most, &levels, values, numbers);
                }
                ColumnReader::ByteArrayColumnReader(mut reader) => {
                    let mut values = Vec::new();
                    reader.read_records(rows, None, None, &mut values)?;
                    let texts = table.texts.entry(name).or_default();
                    texts.extend(
                        values
                            .iter()
                            .map(|value| String::from_utf8_lossy(value.data()).into_owned()),
                    );
                }
                _ => {}
            }
        }
        table.rows += rows;
    }
    Ok(())
}

/// Inserts absent values according to the definition levels.
fn spread(
    rows: usize,
    most: i16,
    levels: &[i16],
    mut values: impl Iterator<Item = f64>,
    into: &mut Vec<Option<f64>>,
) {
    if most == 0 {
        into.extend(values.map(Some));
        return;
    }
    into.extend((0..rows).map(|row| {
        let present = levels.get(row).copied().unwrap_or(0) == most;
        if present { values.next() } else { None }
    }));
}
